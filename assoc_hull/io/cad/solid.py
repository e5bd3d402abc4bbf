"""The closed solid of a hull: its shell of both sides, with deck and transom ruled across it.

What a shell leaves open to port is a line that its image to starboard answers. Between the two a
ruled face is drawn, straight across the ship, as the closed mesh has it: a plane where deck or
transom is one. The camber of a deck is not there.

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.cad.check_file import volume_of
>>> from assoc_hull.io.cad.faces import sew_surfaces
>>> from assoc_hull.io.cad.kernel import quiet_kernel
>>> from assoc_hull.io.cad.solid import closed_solid
>>> from assoc_hull.io.cad.write import both_sides
>>> side = SplineSurface.bezier([[[0, 0, 0], [0, 2, 3]], [[6, 0, 0], [6, 2, 3]]], "side")
>>> with quiet_kernel():
...     solid = closed_solid(sew_surfaces(both_sides([side])))
...     print(round(volume_of(solid), 6))
36.0
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.check_file import free_edges, is_closed_solid
from assoc_hull.io.cad.faces import SEWN, SewnShell, face_of
from assoc_hull.io.cad.kernel import MILLIMETRES

__all__ = ["closed_solid"]

_MIRROR = np.array([1.0, -1.0, 1.0])
_ASIDE = 1e-3
"""An edge whose middle is so far from the centre plane (mm) is to port."""


def closed_solid(sewn: SewnShell) -> Any | None:
    """Give the solid that a shell of both sides encloses; None where deck and transom do not close.

    Parameters
    ----------
    sewn : SewnShell
        Both sides, joined on the centre plane.
    """
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
    from OCP.BRepLib import BRepLib
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    sewing = BRepBuilderAPI_Sewing(SEWN)
    for face in sewn.faces:
        sewing.Add(face)
    for cap in _caps(free_edges(sewn.shell)[0]):
        sewing.Add(face_of(cap))
    sewing.Perform()
    shell = sewing.SewedShape()
    if shell.IsNull() or shell.ShapeType() != TopAbs_ShapeEnum.TopAbs_SHELL:
        return None
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell(shell)).Solid()
    BRepLib.OrientClosedSolid_s(solid)
    return solid if is_closed_solid(solid) else None


def _caps(edges: Sequence[Any]) -> list[SplineSurface]:
    """Rule a surface across the ship from each free edge to port."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve

    found = []
    for edge in edges:
        curve = BRepAdaptor_Curve(edge)
        middle = 0.5 * (curve.FirstParameter() + curve.LastParameter())
        if curve.Value(middle).Y() > _ASIDE:
            found.append(_ruled(edge))
    return found


def _ruled(edge: Any) -> SplineSurface:
    """Rule a surface from an edge to its image; called by what it closes."""
    degree, knots, points = _curve_of(edge)
    net = np.stack([points, points * _MIRROR], axis=1)
    chord = points[-1] - points[0]
    name = "transom" if abs(chord[2]) > np.hypot(chord[0], 1e-9) else "deck"
    return SplineSurface(name, (degree, 1), knots, np.array([0.0, 0.0, 1.0, 1.0]), net)


def _curve_of(edge: Any) -> tuple[int, FloatArray, FloatArray]:
    """Give degree, knots and control points (n, 3), m, of an edge."""
    from OCP.BRep import BRep_Tool
    from OCP.Geom import Geom_TrimmedCurve
    from OCP.GeomConvert import GeomConvert

    first, last = BRep_Tool.Range_s(edge)
    curve = BRep_Tool.Curve_s(edge, first, last)
    spline = GeomConvert.CurveToBSplineCurve_s(Geom_TrimmedCurve(curve, first, last))
    poles = (spline.Pole(i) for i in range(1, spline.NbPoles() + 1))
    points = np.array([(each.X(), each.Y(), each.Z()) for each in poles]) / MILLIMETRES
    places = range(1, spline.NbKnots() + 1)
    knots = np.repeat(
        np.array([spline.Knot(i) for i in places]), [spline.Multiplicity(i) for i in places]
    )
    return int(spline.Degree()), knots, points

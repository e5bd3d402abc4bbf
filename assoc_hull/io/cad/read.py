"""Faces of STEP and of trimmed IGES files through OpenCASCADE, as surfaces and their triangles.

Every face is made a spline surface first, so that its triangles tell parameters on that.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.cad.faces import sewn
>>> from assoc_hull.io.cad.read import read_faces
>>> from assoc_hull.io.cad.step_write import step_bytes
>>> side = SplineSurface.bezier([[[0, 1, 0], [0, 1, 2]], [[5, 1, 0], [5, 1, 2]]], "side")
>>> with tempfile.TemporaryDirectory() as folder:
...     path = Path(folder) / "side.step"
...     written = path.write_bytes(step_bytes(sewn([side]), ["side"], "mm", "hull"))
...     faces = read_faces(path, "step", "mm", None)
>>> faces.surfaces[0].domain, len(faces.facets(0.01, 1.0).mesh.face)
(((0.0, 1.0), (0.0, 1.0)), 2)
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.facets import Facets, joined_facets
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.faces import faces_in, spline_of
from assoc_hull.io.cad.hull_faces import Faces
from assoc_hull.io.cad.kernel import MILLIMETRES, quiet
from assoc_hull.io.units import METRES, unit_note

__all__ = ["read_faces", "read_shape"]

_TURN = 0.35
"""Triangles of a face turn by at most so much (rad) from one to the next."""


def read_faces(path: Path, kind: str, told: str | None, unit: str | None) -> Faces:
    """Read the faces of a file.

    Parameters
    ----------
    path : Path
        The file.
    kind : {"step", "iges"}
        What it is.
    told : str or None
        The unit that the file tells.
    unit : str or None
        The unit of its lengths; None: as told.

    Raises
    ------
    BadInputError
        OpenCASCADE reads no face, or the file tells no unit.
    MissingExtraError
        OpenCASCADE is not installed.
    """
    with quiet():
        shape = _splines(read_shape(path, kind))
        faces = faces_in(shape)
        if not faces:
            raise BadInputError(
                "there is no surface", f"in {path.name}", "export the surfaces of the hull"
            )
        surfaces = [_surface(face, f"face {i}") for i, face in enumerate(faces, 1)]
    used = unit or told
    if used is None:
        what = "the file tells no unit of length that is known"
        raise BadInputError(what, f"in {path.name}", f"give unit: {', '.join(METRES)}")
    factor = METRES[used] / METRES[told] if told else 1.0
    if factor != 1.0:
        surfaces = [each and attrs.evolve(each, net=each.net * factor) for each in surfaces]
    notes = (*unit_note(path.name, told, used), *_unheld(surfaces, path.name))

    def facets(deflection: float, longest: float) -> Facets:
        with quiet():
            return _meshed(shape, faces, deflection, factor)

    return Faces(tuple(surfaces), used, notes, facets)


def read_shape(path: Path, kind: str) -> Any:
    """Give the shape that OpenCASCADE reads, in mm whatever the file's unit; within `quiet`.

    Raises
    ------
    BadInputError
        It reads nothing.
    """
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.IGESControl import IGESControl_Reader
    from OCP.STEPControl import STEPControl_Reader

    reader = STEPControl_Reader() if kind == "step" else IGESControl_Reader()
    status = reader.ReadFile(str(path))
    if status == IFSelect_ReturnStatus.IFSelect_RetDone and reader.TransferRoots():
        return reader.OneShape()
    what = f"OpenCASCADE reads no surface ({status.name})"
    raise BadInputError(what, f"in {path.name}", "see that the file is whole, and holds surfaces")


def _splines(shape: Any) -> Any:
    """Make every face lie on a spline surface."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

    return BRepBuilderAPI_NurbsConvert(shape, True).Shape()


def _unheld(surfaces: Sequence[SplineSurface | None], source: str) -> tuple[str, ...]:
    count = sum(each is None for each in surfaces)
    if not count:
        return ()
    what = "are cut as triangles: they are no splines of degree 7 or less"
    return (f"{count} of {len(surfaces)} faces of {source} {what}.",)


def _surface(face: Any, name: str) -> SplineSurface | None:
    """Give the surface of a face, m, with the parameters it has; None if it cannot be held."""
    from OCP.BRep import BRep_Tool
    from OCP.Geom import Geom_BSplineSurface

    found = BRep_Tool.Surface_s(face)
    if not isinstance(found, Geom_BSplineSurface):
        return None
    if found.IsUPeriodic():
        found.SetUNotPeriodic()
    if found.IsVPeriodic():
        found.SetVNotPeriodic()
    try:
        return spline_of(found, name)
    except BadInputError:  # of a higher degree, or torn
        return None


def _meshed(shape: Any, faces: Sequence[Any], deflection: float, factor: float) -> Facets:
    """Give the triangles of all faces; `factor` is m of the ship over m of OpenCASCADE."""
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools

    BRepTools.Clean_s(shape)
    BRepMesh_IncrementalMesh(shape, deflection / factor * MILLIMETRES, False, _TURN, False)
    parts = [_triangles(face) for face in faces]
    return joined_facets([(xyz * (factor / MILLIMETRES), tri, uv) for xyz, tri, uv in parts])


def _triangles(face: Any) -> tuple[FloatArray, IntArray, FloatArray]:
    """Give vertices (mm), triangles and parameters of a face; none where it has no triangles."""
    from OCP.BRep import BRep_Tool
    from OCP.TopLoc import TopLoc_Location

    place = TopLoc_Location()
    found = BRep_Tool.Triangulation_s(face, place)
    if found is None or not found.HasUVNodes():
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64), np.zeros((0, 2))
    motion = place.Transformation()
    nodes = [found.Node(i).Transformed(motion) for i in range(1, found.NbNodes() + 1)]
    xyz = np.array([(each.X(), each.Y(), each.Z()) for each in nodes])
    pairs = [found.UVNode(i) for i in range(1, found.NbNodes() + 1)]
    uv = np.array([(each.X(), each.Y()) for each in pairs])
    every = [found.Triangle(i) for i in range(1, found.NbTriangles() + 1)]
    tri = np.array([[each.Value(k) for k in (1, 2, 3)] for each in every], np.int64)
    return xyz, tri.reshape(-1, 3) - 1, uv

"""Spline surfaces as faces of OpenCASCADE, sewn to a shell; and faces of a file as a hull's.

Sides of surfaces that run along one another become one edge. Where the side of one runs along a
part of another's, the edge of the longer is cut at the corner: its face stays whole, with the
control points it had.

Surfaces of a hull as a file has them, and their triangles at full scale: sewn, outward.

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.cad.faces import face_of, surface_of
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> surface_of(face_of(plate), "back").net[1].tolist()
[[2.0, 0.0, 0.0], [2.0, 1.0, 0.0]]
>>> import numpy as np
>>> from assoc_hull.io.reports import Notebook
>>> from assoc_hull.io.cad.faces import hull_size, HullFaces
>>> faces = HullFaces.of([SplineSurface.bezier(2.5 * np.eye(3).reshape(3, 1, 3)[:, [0, 0]])], "m")
>>> hull_size(faces, 40.0, Notebook())
100.0
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.triangulation import (
    Facets,
    facets_of,
    kept_facets,
    outward_parts,
    stitch_facets,
)
from assoc_hull.io.cad.kernel import MILLIMETRES, require_opencascade
from assoc_hull.io.reports import Notebook
from assoc_hull.io.units import METRES

__all__ = [
    "FINE",
    "SEWN",
    "HullFaces",
    "SewnShell",
    "face_of",
    "faces_in",
    "facets_at_scale",
    "hull_size",
    "sew_surfaces",
    "solids_apart",
    "spline_of",
    "surface_of",
]

_WELD = 2e-3
"""Borders at most this far apart (m), of a hull under 100 m less in proportion, are one."""

_LONGEST, _SHORTEST = 600.0, 1.0
"""Lengths (m) between which a hull may lie. Absolute: others show a wrong unit."""

FINE = 2e-5
"""Triangles lie off their surface by at most this part of the length of the hull."""

_COARSE, _ROUGH = 1e-3, 100.0
"""Triangles this part of the nets off their surface tell how long it is; nets of this size, m."""

_LONG = 1.0 / 150.0
"""Their sides along the parameters are at most this part of it."""


@attrs.frozen(eq=False)
class HullFaces:
    """Surfaces of a hull as a file has them.

    Attributes
    ----------
    surfaces : tuple of SplineSurface or None
        m, at the scale of the file; a face may be a part of its surface. None where it lies on
        what is no spline of ours: its lines are those of its triangles.
    unit : str
        The unit of the file.
    notes : tuple of str
        What reading it told.
    facets : callable
        Gives the triangles of the faces, within a deflection and no longer than a length, m.
    """

    surfaces: tuple[SplineSurface | None, ...]
    unit: str
    notes: tuple[str, ...]
    facets: Callable[[float, float], Facets]

    @classmethod
    def of(
        cls, surfaces: Sequence[SplineSurface], unit: str, notes: tuple[str, ...] = ()
    ) -> HullFaces:
        """Take whole surfaces."""
        return cls(tuple(surfaces), unit, notes, lambda fine, long: facets_of(surfaces, fine, long))


def hull_size(faces: HullFaces, scale: float, book: Notebook) -> float:
    """Give the longest side of the hull at full scale, m; refuse what is no ship's.

    Parameters
    ----------
    faces : HullFaces
        As read.
    scale : float
        Full scale over that of the file.
    book : Notebook
        Takes unit and length.

    Raises
    ------
    BadInputError
        Less than 1 m or more than 600 m: a unit was taken for another.
    """
    size = _extent(faces) * scale
    said = f"the surfaces are {size:.4g} m long in {faces.unit}, the unit of the file"
    where = f"at scale {scale:g}"
    if not size <= _LONGEST:
        remedy = f"are these millimetres? give scale={METRES['mm'] / METRES[faces.unit]:g}"
        raise BadInputError(said, where, f"{remedy}, or the scale that they have")
    if size < _SHORTEST:
        times = METRES["m"] / METRES[faces.unit]
        remedy = f"are these metres? give scale={times:g}, or the scale of the model"
        raise BadInputError(said, where, remedy)
    book.assume("unit", "the surfaces", f"{faces.unit}: the hull is {size:.6g} m long", size)
    return size


def _extent(faces: HullFaces) -> float:
    """Give the longest side at the scale of the file, m: of faces, not of whole surfaces."""
    nets = [each.net.reshape(-1, 3) for each in faces.surfaces if each is not None]
    box = max((float(np.ptp(net, axis=0).max()) for net in nets), default=_ROUGH)
    found = faces.facets(_COARSE * box, box).mesh.xyz
    return float(np.ptp(found, axis=0).max()) if len(found) else 0.0


def facets_at_scale(
    faces: HullFaces, scale: float, size: float, book: Notebook, factor: float = 1.0
) -> Facets:
    """Give triangles at full scale, each once, sewn, and each part outward.

    Parameters
    ----------
    faces : HullFaces
        As read.
    scale : float
        Full scale over that of the file.
    size : float, m
        The longest side of the hull at full scale.
    book : Notebook
        Takes what was there twice.
    factor : float
        Of lengths, by the size of the hull.
    """
    deflection = FINE * size
    found = faces.facets(deflection / scale, _LONG * size / scale)
    if not len(found.mesh.face):
        raise BadInputError("all surfaces are points or lines", "in the file", "export the hull")
    mesh = found.mesh.moved(found.mesh.xyz * scale)
    whole = _once(Facets(mesh, found.surface, found.uv), book)
    return outward_parts(stitch_facets(whole, max(factor * _WELD, 2.0 * deflection)))


def _once(facets: Facets, book: Notebook) -> Facets:
    """Keep of triangles that are there twice the first: of a surface that is in the file twice."""
    corners = np.sort(facets.mesh.face, axis=1)
    kept = np.sort(np.unique(corners, axis=0, return_index=True)[1])
    if len(kept) == len(corners):
        return facets
    names = f"{len(corners) - len(kept)} of {len(corners)} triangles of the surfaces"
    book.repair("duplicate", "the surfaces", f"{names} occur twice; each is kept once")
    mesh = facets.mesh
    return kept_facets(mesh.xyz, mesh.face[kept], facets.surface[kept], facets.uv[kept])


_DEGENERATE = 1e-6
"""A side of a face shorter than this (mm) is a point."""

SEWN = 1e-2
"""Sides nearer than this (mm) are one."""


@attrs.frozen(eq=False)
class SewnShell:
    """Faces that share edges.

    Attributes
    ----------
    shell : TopoDS_Shape
        The shell; mm.
    faces : list of TopoDS_Face
        Its faces, in the order of the surfaces.
    """

    shell: Any
    faces: list[Any]


def face_of(surface: SplineSurface) -> Any:
    """Give a surface as a face, bounded by its parameters; mm.

    Parameters
    ----------
    surface : SplineSurface
        The surface, m; rational ones too.

    Raises
    ------
    MissingExtraError
        OpenCASCADE is not there.
    BadInputError
        OpenCASCADE makes no face of it.
    """
    require_opencascade()
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace

    made = BRepBuilderAPI_MakeFace(_geometry(_clamped(surface)), _DEGENERATE)
    if not made.IsDone():
        what = f"OpenCASCADE makes no face of it ({made.Error().name})"
        raise BadInputError(what, surface.where, "see that no part of it is a point or a line")
    return made.Face()


def _clamped(surface: SplineSurface) -> SplineSurface:
    """Give a surface whose first and last knots are repeated, as readers of STEP expect."""
    for knots, degree in zip((surface.knots_u, surface.knots_v), surface.degrees, strict=True):
        if knots[0] != knots[degree] or knots[-1] != knots[-1 - degree]:
            return surface.restricted(*surface.domain)
    return surface


def _geometry(surface: SplineSurface) -> Any:
    from OCP.collections import Array1_double, Array1_int, Array2_double, Array2_gp_Pnt
    from OCP.Geom import Geom_BSplineSurface
    from OCP.gp import gp_Pnt

    rows, columns = surface.net.shape[:2]
    poles = Array2_gp_Pnt(1, rows, 1, columns)
    for i, row in enumerate((surface.net * MILLIMETRES).tolist(), start=1):
        for j, point in enumerate(row, start=1):
            poles.SetValue(i, j, gp_Pnt(*point))
    knots, counts = [], []
    for each in (surface.knots_u, surface.knots_v):
        values, repeated = np.unique(each, return_counts=True)
        knots.append(_filled(Array1_double(1, len(values)), values))
        counts.append(_filled(Array1_int(1, len(values)), repeated))
    if surface.weights is None:
        return Geom_BSplineSurface(poles, *knots, *counts, *surface.degrees)
    weights = Array2_double(1, rows, 1, columns)
    for i, row in enumerate(surface.weights.tolist(), start=1):
        for j, weight in enumerate(row, start=1):
            weights.SetValue(i, j, weight)
    return Geom_BSplineSurface(poles, weights, *knots, *counts, *surface.degrees)


def _filled(array: Any, values: np.typing.NDArray[Any]) -> Any:
    for place, value in enumerate(values.tolist(), start=1):
        array.SetValue(place, value)
    return array


def sew_surfaces(surfaces: Sequence[SplineSurface]) -> SewnShell:
    """Sew surfaces to one shell.

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        At least one; m.

    Raises
    ------
    MissingExtraError
        OpenCASCADE is not there.
    BadInputError
        They do not hang together.
    """
    given = [face_of(each) for each in surfaces]
    if len(given) == 1:
        return SewnShell(_shell_of(given), given)
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Sewing
    from OCP.TopAbs import TopAbs_ShapeEnum

    sewing = BRepBuilderAPI_Sewing(SEWN)
    for each in given:
        sewing.Add(each)
    sewing.Perform()
    shell = sewing.SewedShape()
    if shell.IsNull() or shell.ShapeType() != TopAbs_ShapeEnum.TopAbs_SHELL:
        raise _apart(surfaces, _parts(shell))
    # Sewing puts them in another order; as they stand in the shell they look to one side.
    turned, made = faces_in(shell), [sewing.ModifiedSubShape(each) for each in given]
    faces = [next(each for each in turned if each.IsSame(one)) for one in made]
    return SewnShell(_shell_of(faces), faces)


def _shell_of(faces: Sequence[Any]) -> Any:
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell

    shell, builder = TopoDS_Shell(), BRep_Builder()
    builder.MakeShell(shell)
    for face in faces:
        builder.Add(shell, face)
    return shell


def _parts(shape: Any) -> int:
    """Count the parts that a shape is in: the shells, and the faces of none."""
    from OCP.TopoDS import TopoDS_Iterator

    if shape.IsNull():
        return 0
    count, walk = 0, TopoDS_Iterator(shape)
    while walk.More():
        count += 1
        walk.Next()
    return count


def _apart(surfaces: Sequence[SplineSurface], parts: int) -> BadInputError:
    names = ", ".join(repr(each.name) for each in surfaces[:6])
    what = f"{len(surfaces)} surfaces ({names}) do not hang together: they are in {parts} parts"
    return BadInputError(what, "in write_cad", "join the sides they have in common")


def faces_in(shape: Any) -> list[Any]:
    """Give the faces of a shape, in its order, each once."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    found, walk = [], TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while walk.More():
        found.append(TopoDS.Face(walk.Current()))
        walk.Next()
    return found


def surface_of(face: Any, name: str) -> SplineSurface:
    """Give the whole spline surface that a face lies on, in m.

    Parameters
    ----------
    face : TopoDS_Face
        The face; mm.
    name : str
        What to call it.

    Raises
    ------
    BadInputError
        It lies on a surface of another kind, or one that closes on itself smoothly.
    """
    from OCP.BRep import BRep_Tool
    from OCP.Geom import Geom_BSplineSurface

    found = BRep_Tool.Surface_s(face)
    if not isinstance(found, Geom_BSplineSurface) or found.IsUPeriodic() or found.IsVPeriodic():
        what = f"face {name!r} lies on a {type(found).__name__}"
        raise BadInputError(what, "in the file", "only clamped spline surfaces are written")
    return spline_of(found, name)


def spline_of(found: Any, name: str) -> SplineSurface:
    """Give a spline surface of OpenCASCADE that does not close on itself, in m.

    Raises
    ------
    BadInputError
        It is torn, or of a degree over 7.
    """
    rows, columns = range(1, found.NbUPoles() + 1), range(1, found.NbVPoles() + 1)
    net = np.array([[_place(found.Pole(i, j)) for j in columns] for i in rows])
    weights: FloatArray | None = None
    if found.IsURational() or found.IsVRational():
        weights = np.array([[found.Weight(i, j) for j in columns] for i in rows])
    degrees = (found.UDegree(), found.VDegree())
    knots_u = _knots(found.UKnot, found.UMultiplicity, found.NbUKnots())
    knots_v = _knots(found.VKnot, found.VMultiplicity, found.NbVKnots())
    return SplineSurface(name, degrees, knots_u, knots_v, net / MILLIMETRES, weights)


def _knots(knot: Callable[[int], float], times: Callable[[int], int], count: int) -> FloatArray:
    places = range(1, count + 1)
    return np.repeat(np.array([knot(i) for i in places]), [times(i) for i in places])


def _place(point: Any) -> tuple[float, float, float]:
    return point.X(), point.Y(), point.Z()


def solids_apart(shape: Any) -> tuple[Any, list[Any]]:
    """Part a shape into what lies in no solid, and the solids that repeat faces of it.

    A solid none of whose faces stands beside it stays with the rest.
    """
    from OCP.BRep import BRep_Builder
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS_Compound

    shells = _found(shape, TopAbs_ShapeEnum.TopAbs_SHELL, avoid=TopAbs_ShapeEnum.TopAbs_SOLID)
    solids = _found(shape, TopAbs_ShapeEnum.TopAbs_SOLID)
    beside = {_poles(face) for shell in shells for face in faces_in(shell)}
    twice = [each for each in solids if beside and beside <= set(map(_poles, faces_in(each)))]
    if not twice:
        return shape, []
    rest, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(rest)
    for each in (*shells, *(solid for solid in solids if solid not in twice)):
        builder.Add(rest, each)
    return rest, twice


def _found(shape: Any, kind: Any, avoid: Any = None) -> list[Any]:
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    found, avoided = [], TopAbs_ShapeEnum.TopAbs_SHAPE if avoid is None else avoid
    walk = TopExp_Explorer(shape, kind, avoided)
    while walk.More():
        found.append(walk.Current())
        walk.Next()
    return found


def _poles(face: Any) -> tuple[float, ...]:
    """Tell a spline surface by its corners and its middle, 1e-6 mm; of another kind, by nothing."""
    from OCP.BRep import BRep_Tool
    from OCP.Geom import Geom_BSplineSurface

    found = BRep_Tool.Surface_s(face)
    if not isinstance(found, Geom_BSplineSurface):
        return (float(id(face)),)
    rows, columns = found.NbUPoles(), found.NbVPoles()
    places = ((1, 1), (rows, 1), (1, columns), (rows, columns), (rows // 2, columns // 2))
    poles = (found.Pole(*each) for each in places)
    return rows, columns, *(round(x, 6) for p in poles for x in (p.X(), p.Y(), p.Z()))

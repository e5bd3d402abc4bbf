"""Whether a CAD file holds what was to be written, as OpenCASCADE reads it back.

Areas, control points, free edges and seams that nobody sewed are measured (`measure_file`) and
compared with the surfaces (`faults_of`); a file that fails is refused. OpenCASCADE counts in mm,
what is compared is in m.
"""

from __future__ import annotations

import math
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise, permutations
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.patches.area_integrals import elements_on_grid
from assoc_hull.geometry.patches.bezier_patches import patch_normals, patch_points
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.faces import faces_in, solids_apart, surface_of
from assoc_hull.io.cad.kernel import MILLIMETRES, quiet_kernel
from assoc_hull.io.cad.read import read_shape, step_unit
from assoc_hull.io.iges.file import UNITS, IgesFile

__all__ = [
    "WrittenFile",
    "area_of",
    "breadth_flux",
    "control_point_error",
    "declared_unit",
    "faults_of",
    "free_edges",
    "is_closed_solid",
    "lie_along",
    "measure_file",
    "require_written",
    "shape_in",
    "volume_of",
]

# --------------------------------------------------------------------------------------
# Free edges, of one face alone. Of a hull these are the deck edge, the rim of a transom and, of a
# half, the centre line. Where one free edge lies along another, two faces touch and are not joined.

_NEAR = 0.1
"""Edges nearer than this (mm) run along one another."""

_PLACES = (0.2, 0.45, 0.7)
"""Where on an edge it is looked whether another is there."""


def free_edges(shape: Any) -> tuple[list[Any], int]:
    """Give the free edges of a shape, and how many edges join two faces; none that are points."""
    from OCP.BRep import BRep_Tool
    from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    known, count = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher(), Counter[int]()
    faces = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while faces.More():
        edges = TopExp_Explorer(faces.Current(), TopAbs_ShapeEnum.TopAbs_EDGE)
        while edges.More():
            edge = TopoDS.Edge(edges.Current())
            if not BRep_Tool.Degenerated_s(edge):
                count[known.Add(edge)] += 1
            edges.Next()
        faces.Next()
    free = [TopoDS.Edge(known.FindKey(key)) for key, times in count.items() if times == 1]
    return free, len(count) - len(free)


def lie_along(edges: Sequence[Any]) -> int:
    """Count the free edges that run along another one, wholly or over most of their length."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    boxes = []
    for edge in edges:
        box = Bnd_Box()
        BRepBndLib.Add_s(edge, box)
        box.Enlarge(_NEAR)
        boxes.append(box)
    found = {
        one
        for one, other in permutations(range(len(edges)), 2)
        if not boxes[one].IsOut(boxes[other]) and _lies_along(edges[one], edges[other])
    }
    return len(found)


def _lies_along(edge: Any, other: Any) -> bool:
    """Tell whether points within an edge lie on another; ends are shared by edges anyway."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.Extrema import Extrema_ExtPC

    curve, target = BRepAdaptor_Curve(edge), BRepAdaptor_Curve(other)
    first, length = curve.FirstParameter(), curve.LastParameter() - curve.FirstParameter()
    for place in _PLACES:
        feet = Extrema_ExtPC(curve.Value(first + place * length), target)
        squares = [feet.SquareDistance(i) for i in range(1, feet.NbExt() + 1)]
        if min(squares, default=_NEAR**2) >= _NEAR**2:
            return False
    return True


# --------------------------------------------------------------------------------------
# Measuring a file.

_AREA_TOLERANCE, _SPANS = 1e-8, 12
"""The part to which areas are integrated, and the least spans: OpenCASCADE leaves 1e-5 else."""

_ENDINGS = {"step": ".step", "iges": ".igs"}


@attrs.frozen(eq=False)
class WrittenFile:
    """A file as it is read back.

    Attributes
    ----------
    unit : str
        The unit that the file declares; empty if it is none that is known.
    surfaces : tuple of SplineSurface
        The surfaces of its faces, whole, in the order of the file; m.
    shells : int
        Shells; 0 where the form has none.
    turned : tuple of int
        Numbers of faces, from 0, whose normal is not that of their surface.
    free, joined : int
        Edges of one face, and of two.
    seams : int
        Free edges that lie along another free edge: where faces touch without being joined.
    area : float, m2
        Of all faces.
    valid : bool
        Whether OpenCASCADE finds the topology sound.
    solids : tuple of float, m3
        Volumes of the solids beside the shell; nan of one that is not closed.
    """

    unit: str
    surfaces: tuple[SplineSurface, ...]
    shells: int
    turned: tuple[int, ...]
    free: int
    joined: int
    seams: int
    area: float
    valid: bool
    solids: tuple[float, ...] = ()


def declared_unit(data: bytes, kind: str) -> str:
    """Give the unit of length that a file ("step", "iges") declares; empty if not known."""
    if kind == "step":
        return step_unit(data.decode("latin-1")) or ""
    return UNITS.get(IgesFile.of_text(data.decode("latin-1"), "the file").unit, ("",))[0]


def shape_in(data: bytes, kind: str) -> Any:
    """Give the shape that OpenCASCADE reads, in mm whatever the file's unit.

    Raises
    ------
    BadInputError
        It reads nothing.
    """
    with quiet_kernel(), tempfile.TemporaryDirectory() as folder:
        # A stream will not do: OpenCASCADE reads IGES from files only.
        path = Path(folder) / f"surfaces{_ENDINGS[kind]}"
        path.write_bytes(data)
        return read_shape(path, kind)


def measure_file(data: bytes, kind: str) -> WrittenFile:
    """Read a file ("step", "iges") and measure what it holds.

    Raises
    ------
    BadInputError
        It cannot be read, or holds faces on other than spline surfaces.
    MissingExtraError
        OpenCASCADE is not there.
    """
    shape, solids = solids_apart(shape_in(data, kind))
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.TopAbs import TopAbs_Orientation

    faces = faces_in(shape)
    turned = (
        number
        for number, face in enumerate(faces)
        if face.Orientation() != TopAbs_Orientation.TopAbs_FORWARD
    )
    free, joined = free_edges(shape)
    valid = bool(BRepCheck_Analyzer(shape).IsValid())
    return WrittenFile(
        declared_unit(data, kind),
        tuple(surface_of(face, str(number)) for number, face in enumerate(faces)),
        _shells(shape),
        tuple(turned),
        len(free),
        joined,
        lie_along(free),
        _shape_area(shape, faces),
        valid,
        tuple(volume_of(each) if is_closed_solid(each) else math.nan for each in solids),
    )


def is_closed_solid(solid: Any) -> bool:
    """Tell whether OpenCASCADE finds a solid sound, and no edge of it free."""
    from OCP.BRepCheck import BRepCheck_Analyzer

    return bool(BRepCheck_Analyzer(solid).IsValid()) and not free_edges(solid)[0]


def volume_of(solid: Any) -> float:
    """Give the volume that a solid encloses, m3; above 0 where its faces look outward."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    found = GProp_GProps()
    # Without a tolerance it leaves 2e-4 of the volume of a hull.
    BRepGProp.VolumeProperties_s(solid, found, _AREA_TOLERANCE)
    return float(found.Mass()) / MILLIMETRES**3


def _shells(shape: Any) -> int:
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    count, walk = 0, TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SHELL)
    while walk.More():
        count += 1
        walk.Next()
    return count


def _shape_area(shape: Any, faces: Sequence[Any]) -> float:
    """Integrate the area; surfaces of few spans get more, between which it is integrated."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    for face in faces:
        surface = BRep_Tool.Surface_s(face)
        _refine(surface.InsertUKnot, surface.UKnot, surface.NbUKnots())
        _refine(surface.InsertVKnot, surface.VKnot, surface.NbVKnots())
    found = GProp_GProps()
    BRepGProp.SurfaceProperties_s(shape, found, _AREA_TOLERANCE)
    return float(found.Mass()) / MILLIMETRES**2


def _refine(insert: Callable[..., None], knot: Callable[[int], float], count: int) -> None:
    """Split each span, so that there are enough of them."""
    knots = [knot(i) for i in range(1, count + 1)]
    parts = -(-_SPANS // (count - 1))
    for low, high in pairwise(knots):
        for part in range(1, parts):
            insert(low + (high - low) * part / parts, 1, 0.0)


# --------------------------------------------------------------------------------------
# Comparing it with what was to be written.

_POINT_DIFFERENCE = 1e-8
"""Control points come back to this (m): 1e-5 mm."""

_AREA_DIFFERENCE = 1e-6
"""Areas come back to this part."""

_NODES = 16


def area_of(surface: SplineSurface) -> float:
    """Give the area of a surface, m2, by Gauss's rule on each of its patches."""
    nodes, weights = gauss(_NODES)
    element = elements_on_grid(surface.patches(), nodes, nodes)
    return float((element @ weights @ weights).sum())


def breadth_flux(surface: SplineSurface) -> float:
    """Give the integral of y n_y over a surface, m3, roughly; above 0 where normals point out."""
    patches = surface.patches()
    row, middle = np.arange(len(patches)), np.full((len(patches), 2), 0.5)
    normal = patch_normals(patches, row, middle)
    return float((patch_points(patches, row, middle)[:, 1] * normal[:, 1]).sum())


def control_point_error(found: Sequence[SplineSurface], surfaces: Sequence[SplineSurface]) -> float:
    """Give the largest distance of control points, m; inf where nets are of other sizes."""
    if len(found) != len(surfaces):
        return float("inf")
    return max(_net_error(one, other) for one, other in zip(found, surfaces, strict=True))


def _net_error(one: SplineSurface, other: SplineSurface) -> float:
    if one.net.shape != other.net.shape or one.degrees != other.degrees:
        return float("inf")
    return float(np.linalg.norm(one.net - other.net, axis=-1).max())


def faults_of(
    found: WrittenFile, surfaces: Sequence[SplineSurface], unit: str, *, shell: bool
) -> list[str]:
    """List what is wrong with a file, one sentence a fault.

    `surfaces` (m) is what was to be written, in this order, in `unit`. With `shell` faces share
    edges: then there must be one shell, and no seam within it.
    """
    return [
        *_faults_of_surfaces(found, surfaces, unit),
        *(_faults_of_shell(found) if shell else ()),
    ]


def _faults_of_surfaces(
    found: WrittenFile, surfaces: Sequence[SplineSurface], unit: str
) -> Iterator[str]:
    if found.unit != unit:
        yield f"the unit is {found.unit or 'not told'} instead of {unit}"
    if len(found.surfaces) != len(surfaces):
        yield f"there are {len(found.surfaces)} faces instead of {len(surfaces)}"
        return
    for one, other in zip(found.surfaces, surfaces, strict=True):
        error = _net_error(one, other)
        if not error <= _POINT_DIFFERENCE:
            yield f"control points of {other.name!r} are off by {1e3 * error:.6g} mm"
    wanted = sum(map(area_of, surfaces))
    if not abs(found.area - wanted) <= _AREA_DIFFERENCE * wanted:
        yield f"the area is {found.area:.6f} m2 instead of {wanted:.6f} m2"
    if not found.valid:
        yield "OpenCASCADE finds its topology unsound"
    if not all(volume > 0.0 for volume in found.solids):
        yield "the solid beside the shell is not closed"


def _faults_of_shell(found: WrittenFile) -> Iterator[str]:
    if found.shells != 1:
        yield f"there are {found.shells} shells instead of one"
    if found.seams:
        yield f"{found.seams} edges within the shell are not joined"
    if found.turned:
        yield f"{len(found.turned)} faces have their normals turned"


def require_written(
    found: WrittenFile, surfaces: Sequence[SplineSurface], unit: str, *, shell: bool
) -> None:
    """Refuse a file that does not hold what was to be written; arguments as of `faults_of`.

    Raises
    ------
    BadInputError
        All faults, in one line.
    """
    faults = faults_of(found, surfaces, unit, shell=shell)
    if faults:
        what = f"the file does not hold what was to be written: {'; '.join(faults)}"
        raise BadInputError(what, "as it is read back", "nothing is kept of it; write another form")

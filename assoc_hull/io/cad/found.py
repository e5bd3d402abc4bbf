"""What OpenCASCADE finds in a file of surfaces, as numbers to compare with what was written.

Examples
--------
>>> from assoc_hull.io.cad.found import told_unit
>>> told_unit(b"#5=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));", "step")
'mm'
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import attrs

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.faces import faces_in, surface_of
from assoc_hull.io.cad.free_edges import free_edges, lie_along
from assoc_hull.io.cad.kernel import MILLIMETRES, quiet
from assoc_hull.io.cad.read import read_shape
from assoc_hull.io.cad.step_text import step_unit
from assoc_hull.io.iges.file import UNITS, IgesFile

__all__ = ["Found", "find_in", "shape_in", "told_unit"]

_AREA, _SPANS = 1e-8, 12
"""The part to which areas are integrated, and the least spans: OpenCASCADE leaves 1e-5 else."""

_ENDINGS = {"step": ".step", "iges": ".igs"}


@attrs.frozen(eq=False)
class Found:
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
        Free edges that lie along another free edge: where faces meet without being joined.
    area : float, m2
        Of all faces.
    valid : bool
        Whether OpenCASCADE finds the topology sound.
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


def told_unit(data: bytes, kind: str) -> str:
    """Give the unit of length that a file declares; empty if it is none that is known.

    Parameters
    ----------
    data : bytes
        The file.
    kind : {"step", "iges"}
        What it is.
    """
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
    with quiet(), tempfile.TemporaryDirectory() as folder:
        # A stream will not do: OpenCASCADE reads IGES from files only.
        path = Path(folder) / f"surfaces{_ENDINGS[kind]}"
        path.write_bytes(data)
        return read_shape(path, kind)


def find_in(data: bytes, kind: str) -> Found:
    """Read a file and measure what it holds.

    Parameters
    ----------
    data : bytes
        The file.
    kind : {"step", "iges"}
        What it is.

    Raises
    ------
    BadInputError
        It cannot be read, or holds faces on other than spline surfaces.
    MissingExtraError
        OpenCASCADE is not there.
    """
    shape = shape_in(data, kind)
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
    return Found(
        told_unit(data, kind),
        tuple(surface_of(face, str(number)) for number, face in enumerate(faces)),
        _shells(shape), tuple(turned), len(free), joined, lie_along(free), _area(shape, faces),
        valid,
    )  # fmt: skip


def _shells(shape: Any) -> int:
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    count, walk = 0, TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SHELL)
    while walk.More():
        count += 1
        walk.Next()
    return count


def _area(shape: Any, faces: Sequence[Any]) -> float:
    """Integrate the area; surfaces of few spans get more, between which it is integrated."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    for face in faces:
        surface = BRep_Tool.Surface_s(face)
        _refine(surface.InsertUKnot, surface.UKnot, surface.NbUKnots())
        _refine(surface.InsertVKnot, surface.VKnot, surface.NbVKnots())
    found = GProp_GProps()
    BRepGProp.SurfaceProperties_s(shape, found, _AREA)
    return float(found.Mass()) / MILLIMETRES**2


def _refine(insert: Callable[..., None], knot: Callable[[int], float], count: int) -> None:
    """Part each span, so that there are enough of them."""
    knots = [knot(i) for i in range(1, count + 1)]
    parts = -(-_SPANS // (count - 1))
    for low, high in pairwise(knots):
        for part in range(1, parts):
            insert(low + (high - low) * part / parts, 1, 0.0)

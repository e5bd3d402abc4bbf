"""Reading STEP and trimmed IGES through OpenCASCADE: surfaces and their triangles.

The text of a STEP file is checked first, since OpenCASCADE ends the process on some damaged files.
Every face is made a spline surface, so that its triangles have parameters on it. OpenCASCADE counts
in mm; results are in m.

Source: ISO 10303-21 (2016), sections 5 to 11: the exchange structure and its tokens.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import regular_file
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.triangulation import Facets, joined_facets
from assoc_hull.io.cad.faces import HullFaces, faces_in, solids_apart, spline_of
from assoc_hull.io.cad.kernel import MILLIMETRES, quiet_kernel, require_installed
from assoc_hull.io.child_process import ChildSession, limits_for
from assoc_hull.io.units import METRES, refuse_other_unit

__all__ = [
    "CadFaces",
    "read_faces",
    "read_shape",
    "require_sound_step",
    "step_unit",
]

# --------------------------------------------------------------------------------------
# Is the text of a STEP file sound? OpenCASCADE ends the process, or does not come to an end, on
# some files with a number that is none or a reference to nothing. So the words of the data section
# are looked at first.

_AGAIN = "export or copy it again, whole"
_STRING = re.compile(r"'(?:[^']|'')*'|/\*.*?\*/|\"[0-9A-F]*\"", re.S)
_DATA = re.compile(r"\bDATA\s*(?:\([^;]*\))?\s*;(.*?)\bENDSEC\s*;", re.S)
_PLAIN = (
    (re.compile(r"\.[A-Za-z0-9_]+\."), "*"),
    (re.compile(r"#[0-9]+"), "@"),
    (re.compile(r"!?[A-Za-z_][A-Za-z0-9_]*(?=\s*\()"), "@"),
    (re.compile(r"[-+]?[0-9]+(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?"), "0"),
)
"""Words of a statement: enumerations, references, keywords, numbers; what is left is marks."""

_STRANGE = re.compile(r"[^@0*$'(),=;\s]|,\s*[,)]|\(\s*,")
"""A mark or a word that is none, or a value that is left out."""

# Numbers over 1e100, by their exponent: OpenCASCADE hangs on them.
_LARGE = re.compile(r"[0-9.][eE]\+?0*(?:[2-9][0-9]{2,}|1[0-9]{3,}|10[1-9]|1[1-9][0-9])\b")

_PREFIX = {"$": "m", "": "m", ".MILLI.": "mm", ".CENTI.": "cm"}
_CONVERTED = {"INCH": "in", "IN": "in", "FOOT": "ft", "FEET": "ft", "FT": "ft"}


def require_sound_step(text: str, source: str) -> None:
    """Refuse a STEP file that is cut short, or whose statements are none.

    Raises
    ------
    BadInputError
        It does not end as it must, has no data, a word that is none, brackets that do not
        close, a reference to nothing, or a number over 1e100.
    """
    where = f"in {source}"
    if not re.search(r"END-ISO-10303-21\s*;\s*\Z", text):
        raise BadInputError("the file is cut short", where, _AGAIN)
    bare = _STRING.sub(lambda found: " " if found[0].startswith("/*") else "''", text)
    data = "".join(_DATA.findall(bare))
    if not data.strip():
        raise BadInputError("there is no data", where, _AGAIN)
    large = _LARGE.search(data)
    if large:
        raise BadInputError(f"a number is too large ({large[0]})", where, _AGAIN)
    known = set(re.findall(r"#([0-9]+)\s*=", data))
    missing = set(re.findall(r"#([0-9]+)", data)) - known
    if missing:
        first = min(missing, key=int)
        raise BadInputError(f"there is no entity #{first}, which others use", where, _AGAIN)
    plain = data
    for pattern, mark in _PLAIN:
        plain = pattern.sub(mark, plain)
    for statement, given in zip(plain.split(";"), data.split(";"), strict=True):
        _require_statement(statement, given, where)


def _require_statement(plain: str, given: str, where: str) -> None:
    strange = _STRANGE.search(plain)
    closed = plain.count("(") == plain.count(")")
    whole = not plain.strip() or re.match(r"\s*@\s*=\s*[@(]", plain)
    if strange or not closed or not whole:
        shown = " ".join(given.split())
        shown = shown if len(shown) < 80 else f"{shown[:77]}..."
        raise BadInputError(f"this is no statement: {shown!r}", where, _AGAIN)


def step_unit(text: str) -> str | None:
    """Give the unit of length of a STEP file; None if it is none that is known.

    Examples
    --------
    >>> from assoc_hull.io.cad.read import step_unit
    >>> step_unit("#7=(CONVERSION_BASED_UNIT('INCH',#8)LENGTH_UNIT()NAMED_UNIT(#9));")
    'in'
    """
    for entity in re.finditer(r"=\s*\(([^;]*)\)\s*;", text):
        body = entity[1]
        if not re.search(r"\bLENGTH_UNIT\s*\(", body):
            continue
        base = re.search(r"CONVERSION_BASED_UNIT\s*\(\s*'([^']*)'", body)
        if base:
            return _CONVERTED.get(base[1].strip().upper())
        metric = re.search(r"SI_UNIT\s*\(\s*([$.A-Z]*)\s*,\s*\.METRE\.", body)
        if metric:
            return _PREFIX.get(metric[1].strip())
    return None


# --------------------------------------------------------------------------------------
# Faces as surfaces and triangles.

_TURN = 0.35
"""Triangles of a face turn by at most so much (rad) from one to the next."""


def read_faces(path: Path, kind: str, told: str | None, unit: str | None) -> HullFaces:
    """Read the faces of a file ("step", "iges") as surfaces, m.

    `told` is the unit that the file declares, `unit` one that is given; they may not differ. The
    library works in a process of its own, with limits of memory and time.

    Raises
    ------
    BadInputError
        OpenCASCADE reads no face, breaks down or takes more than the limits, or the file tells no
        unit, or another than is given.
    MissingExtraError
        OpenCASCADE is not installed.
    """
    regular_file(path)
    require_installed()
    session = ChildSession(
        f"{__name__}:CadFaces", (str(path), kind), limits_for(path), f"at {path}",
        (__name__, f"{quiet_kernel.__module__}:warm_up"),
    )  # fmt: skip
    raw = session.call("surfaces")
    surfaces = [
        None if each is None else SplineSurface(f"face {i}", *each) for i, each in enumerate(raw, 1)
    ]
    refuse_other_unit(path.name, told, unit)
    used = unit or told
    if used is None:
        what = "the file tells no unit of length that is known"
        raise BadInputError(what, f"in {path.name}", f"give unit: {', '.join(METRES)}")
    factor = METRES[used] / METRES[told] if told else 1.0
    if factor != 1.0:
        surfaces = [each and attrs.evolve(each, net=each.net * factor) for each in surfaces]
    notes = _unheld(surfaces, path.name)

    def facets(deflection: float, longest: float) -> Facets:
        # The session lives as long as this function does.
        return joined_facets(session.call("facets", deflection, factor))

    return HullFaces(tuple(surfaces), used, notes, facets)


class CadFaces:
    """The faces of a file, where OpenCASCADE is: made in a child."""

    def __init__(self, name: str, kind: str) -> None:
        path = Path(name)
        with quiet_kernel():
            # A solid beside its shell has the same faces once more, and a deck.
            self.shape = _splines(solids_apart(read_shape(path, kind))[0])
            self.faces = faces_in(self.shape)
            if not self.faces:
                raise BadInputError(
                    "there is no surface", f"in {path.name}", "export the surfaces of the hull"
                )

    def surfaces(self) -> list[tuple[Any, ...] | None]:
        """Give what makes a `SplineSurface` of each face, but its name; None of what is none."""
        with quiet_kernel():
            found = [_surface(face, f"face {i}") for i, face in enumerate(self.faces, 1)]
        return [
            None
            if each is None
            else (each.degrees, each.knots_u, each.knots_v, each.net, each.weights)
            for each in found
        ]

    def facets(
        self, deflection: float, factor: float
    ) -> list[tuple[FloatArray, IntArray, FloatArray]]:
        """Give vertices (m), triangles and parameters of each face; factor as for `_meshed`."""
        with quiet_kernel():
            return _meshed(self.shape, self.faces, deflection, factor)


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
    """Report the faces that cannot be held as splines."""
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


def _meshed(
    shape: Any, faces: Sequence[Any], deflection: float, factor: float
) -> list[tuple[FloatArray, IntArray, FloatArray]]:
    """Give the triangles of all faces; `factor` is m of the ship over m of OpenCASCADE."""
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools

    BRepTools.Clean_s(shape)
    BRepMesh_IncrementalMesh(shape, deflection / factor * MILLIMETRES, False, _TURN, False)
    parts = [_triangles(face) for face in faces]
    return [(xyz * (factor / MILLIMETRES), tri, uv) for xyz, tri, uv in parts]


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

"""Surfaces of a hull for CAD programs: STEP or IGES, read back and compared before it is kept.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.cad.write import write_cad
>>> side = SplineSurface.bezier([[[5, 0, 0], [5, 1, 2]], [[0, 0, 0], [0, 1, 2]]], "side")
>>> with tempfile.TemporaryDirectory() as folder:
...     report = write_cad([side], Path(folder) / "hull.step", unit="m")
>>> report.faces, report.shells, report.joined_edges, report.free_edges
(2, 1, 1, 6)
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from types import MappingProxyType

import attrs

from assoc_hull.arguments import all_of, choice, flag, text
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.both_sides import both_sides, off_centre
from assoc_hull.io.cad.check import area_of, breadth_flux, control_point_error, require_written
from assoc_hull.io.cad.faces import sewn
from assoc_hull.io.cad.found import find_in
from assoc_hull.io.cad.iges_write import iges_bytes
from assoc_hull.io.cad.kernel import quiet
from assoc_hull.io.cad.step_write import step_bytes
from assoc_hull.io.iges.read import surfaces_of_iges
from assoc_hull.io.iges.write import iges_text
from assoc_hull.io.write_file import form_by_ending, write_whole

__all__ = ["CAD_ENDINGS", "CAD_FORMS", "CAD_UNITS", "CadReport", "cad_bytes", "write_cad"]

CAD_FORMS: Mapping[str, str] = MappingProxyType({
    "step": "STEP (AP214): one shell of faces that share their edges",
    "iges": "IGES: trimmed surfaces (144), each by itself",
    "iges-brep": "IGES: one shell of faces that share their edges (514)",
    "iges-surfaces": "IGES: bare spline surfaces (128), by our own writer",
})  # fmt: skip
"""The forms, and what each holds."""

CAD_ENDINGS: Mapping[str, str] = MappingProxyType(
    {".step": "step", ".stp": "step", ".iges": "iges", ".igs": "iges"}
)
"""The form that the ending of a file means."""

CAD_UNITS = ("mm", "m")
"""Units of length that files are written in."""

_CENTRED = 4e-6
"""Sides nearer to the centre plane than this (m) are joined to their images."""

_WHERE = "in write_cad"


@attrs.frozen
class CadReport:
    """What was written, as it was read back.

    Attributes
    ----------
    path, form, unit : str
        Where, in which of `CAD_FORMS`, and in which unit of length.
    half : bool
        Whether it is the half y >= 0 alone.
    faces, shells : int
        How many; a form without shells has none.
    joined_edges, free_edges : int
        Edges that two faces share, and those of one face: of a hull the deck edge, the rim of a
        transom and, of a half, the centre line. 0 where the form knows no edges.
    area : float, m2
        Of all faces.
    control_point_error : float, m
        The largest distance between a control point as written and as read back.
    size : int
        Bytes.
    """

    path: str
    form: str
    unit: str
    half: bool
    faces: int
    shells: int
    joined_edges: int
    free_edges: int
    area: float
    control_point_error: float
    size: int


def write_cad(
    surfaces: Sequence[SplineSurface],
    path: str | os.PathLike[str],
    form: str | None = None,
    *,
    unit: str = "mm",
    half: bool = False,
    name: str = "hull",
) -> CadReport:
    """Write surfaces for CAD programs, and see that the file holds them.

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        Of the half y >= 0, m; borders that two of them share run through the same points.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : str or None
        One of `CAD_FORMS`; None: by the ending of the name.
    unit : {"mm", "m"}
        Of the lengths in the file.
    half : bool
        Whether to write the half alone; else its image to starboard too, joined to it on the
        centre plane.
    name : str
        What the file calls the part.

    Returns
    -------
    CadReport

    Raises
    ------
    BadInputError
        Another form or unit, no surface, surfaces that do not hang together, a file that cannot
        be written, or that is not what was to be written when it is read back.
    MissingExtraError
        OpenCASCADE is not there, for a form that needs it.

    Notes
    -----
    The same surfaces give the same bytes. A surface beside two others keeps its one face, whose
    edge is cut where these meet.
    """
    chosen = form_by_ending(path, form, tuple(CAD_FORMS), CAD_ENDINGS, _WHERE)
    data, report = cad_bytes(surfaces, chosen, unit=unit, half=half, name=name)
    write_whole(path, data)
    return attrs.evolve(report, path=os.fspath(path))


def cad_bytes(
    surfaces: Sequence[SplineSurface],
    form: str,
    *,
    unit: str = "mm",
    half: bool = False,
    name: str = "hull",
) -> tuple[bytes, CadReport]:
    """Lay out surfaces as the bytes of a file that has been read back; as `write_cad`."""
    given = all_of(surfaces, SplineSurface, "surfaces", _WHERE)
    if not given:
        raise BadInputError("there are no surfaces", _WHERE, "give one or more")
    choice(form, "form", tuple(CAD_FORMS), _WHERE)
    choice(unit, "unit", CAD_UNITS, _WHERE)
    called = text(name, "name", _WHERE)
    alone = flag(half, "half", _WHERE)
    _require_outward(given)
    if not alone and form != "iges-surfaces":
        _require_centred(given)
    whole = list(given) if alone else both_sides(given)
    if form == "iges-surfaces":
        return _bare(whole, unit, alone)
    return _by_opencascade(whole, form, unit, called, alone)


def _require_outward(surfaces: Sequence[SplineSurface]) -> None:
    """Refuse a half whose normals point to the centre plane."""
    if sum(map(breadth_flux, surfaces)) < 0.0:
        what, remedy = "normals point into the hull", "turn u or v of all surfaces"
        raise BadInputError(what, _WHERE, remedy)


def _require_centred(surfaces: Sequence[SplineSurface]) -> None:
    """Refuse a half that does not reach its image."""
    off, name = off_centre(surfaces)
    if off > _CENTRED:
        what = f"no side lies on the centre plane: the nearest, of {name!r}, is {1e3 * off:.4g} mm"
        raise BadInputError(f"{what} off it", _WHERE, "write the half alone, or close the keel")


def _bare(surfaces: list[SplineSurface], unit: str, half: bool) -> tuple[bytes, CadReport]:
    """Write with our own hands, and read so."""
    data = iges_text(surfaces, unit)
    found = surfaces_of_iges(data, "the file")[0]
    error = control_point_error(found, surfaces)
    return data.encode(), CadReport(
        "", "iges-surfaces", unit, half, len(found), 0, 0, 0, sum(map(area_of, found)), error,
        len(data),
    )  # fmt: skip


def _by_opencascade(
    surfaces: list[SplineSurface], form: str, unit: str, name: str, half: bool
) -> tuple[bytes, CadReport]:
    names, shell = [each.name for each in surfaces], form != "iges"
    with quiet():
        joined = sewn(surfaces)
        if form == "step":
            data = step_bytes(joined, names, unit, name)
        else:
            data = iges_bytes(joined, names, unit, name, shell=shell)
        found = find_in(data, "step" if form == "step" else "iges")
        require_written(found, surfaces, unit, shell=shell)
        error = control_point_error(found.surfaces, surfaces)
    edges = (found.joined, found.free) if shell else (0, 0)
    return data, CadReport(
        "", form, unit, half, len(surfaces), found.shells, *edges, found.area, error, len(data)
    )

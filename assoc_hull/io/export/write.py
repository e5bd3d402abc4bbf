"""Writing a hull in the forms of other programs: one file, whole or not at all, and a report.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.export.write import export_hull
>>> with tempfile.TemporaryDirectory() as folder:
...     report = export_hull(wigley(), Path(folder) / "wigley.bri")
>>> report.form, report.lines, report.rounding
('britfair', 21, 5e-06)
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from types import MappingProxyType

import attrs

from assoc_hull.arguments import choice, file_path
from assoc_hull.errors import BadInputError
from assoc_hull.io.dxf.lines import DXF_UNITS, lines_drawing
from assoc_hull.io.dxf.lines_plan import plan_drawing
from assoc_hull.io.export.britfair import dumps_britfair
from assoc_hull.io.export.delftship import dumps_delftship, dumps_delftship_offsets
from assoc_hull.io.export.ghs_geometry import FOOT, dumps_gf
from assoc_hull.io.export.offset_table import offsets_csv, offsets_of, offsets_xlsx
from assoc_hull.io.export.sections import sections_to_export
from assoc_hull.io.hull_json import readable_text
from assoc_hull.io.iges.write import iges_of_lines
from assoc_hull.io.lines.line_points import lines_as_points
from assoc_hull.io.lines.own_lines import tell_losses
from assoc_hull.io.reports import ExportBook, ExportReport
from assoc_hull.io.rhino.write import rhino_file
from assoc_hull.io.write_file import form_by_ending, write_whole
from assoc_hull.model.tables import HullState

__all__ = ["ENDINGS", "FORMS", "ExportForm", "export_form", "export_hull"]


_EXACT = 17
"""Digits with which a number is told from its neighbours."""

_UNITS = tuple(DXF_UNITS)

_SURFACE_ENDINGS = (".step", ".stp", ".igs", ".iges", ".stl", ".obj", ".ply", ".glb")


@attrs.frozen
class ExportForm:
    """A form a hull can be written in.

    Attributes
    ----------
    about : str
        What it is, in a few words.
    endings : tuple of str
        Names of files that mean it.
    write : callable
        Gives the bytes of the file and the report.
    decimals : int
        Digits after the point; those that tell a number from its neighbours if nothing is rounded.
    scale : float
        Units of the file in a metre.
    units : tuple of str
        Units that may be chosen; empty if the form has one of its own.
    on_paper : bool
        Whether letters have a size on paper.
    """

    about: str
    endings: tuple[str, ...]
    write: Callable[[HullState, ExportBook], bytes]
    decimals: int
    scale: float = 1.0
    units: tuple[str, ...] = ()
    on_paper: bool = False


def _hull(state: HullState, book: ExportBook) -> bytes:
    book.lines = len(state.live("lines"))
    book.curves = len(state.live("curves"))
    book.points = len(state.live("rows"))
    return readable_text(state).encode()


def _csv(state: HullState, book: ExportBook) -> bytes:
    return offsets_csv(offsets_of(state, book)).encode()


def _xlsx(state: HullState, book: ExportBook) -> bytes:
    return offsets_xlsx(offsets_of(state, book))


def _britfair(state: HullState, book: ExportBook) -> bytes:
    return dumps_britfair(state.particulars.name, sections_to_export(state, book), book).encode(
        "ascii"
    )


def _delftship(state: HullState, book: ExportBook) -> bytes:
    return dumps_delftship(sections_to_export(state, book), book).encode("ascii")


def _delftship_offsets(state: HullState, book: ExportBook) -> bytes:
    families = ("sections", "buttocks", "waterlines", "boundary")
    others = lines_as_points(state, ("diagonals",))
    if others:
        what = f"{len(others)} lines are left out"
        book.leave_out("lines", "diagonals", what, len(others))
    return dumps_delftship_offsets(lines_as_points(state, families), book).encode("ascii")


def _gf(state: HullState, book: ExportBook) -> bytes:
    ship = state.particulars
    lines = sections_to_export(state, book)
    return dumps_gf(ship.name, ship.length, ship.breadth, lines, book).encode("ascii")


def _dxf(state: HullState, book: ExportBook) -> bytes:
    return lines_drawing(state, book).encode()


def _dxf_polylines(state: HullState, book: ExportBook) -> bytes:
    return lines_drawing(state, book, polylines=True).encode()


def _dxf_plan(state: HullState, book: ExportBook) -> bytes:
    return plan_drawing(state, book, book.paper).encode()


def _iges_lines(state: HullState, book: ExportBook) -> bytes:
    text, report = iges_of_lines(state, unit=book.unit)
    book.lines, book.curves, book.points = report.lines, report.curves, report.points
    tell_losses(state, book)
    return text.encode()


FORMS: Mapping[str, ExportForm] = MappingProxyType(
    {
        "hull": ExportForm("the hull itself as canonical text", (".hull.json",), _hull, _EXACT),
        "csv": ExportForm("table of offsets", (".csv",), _csv, 4),
        "xlsx": ExportForm("table of offsets as a workbook", (".xlsx",), _xlsx, 4),
        "britfair": ExportForm("sections, BRITFAIR", (".bri",), _britfair, 5),
        "delftship": ExportForm(
            "sections as DELFTship and FREE!ship import them", (".txt",), _delftship, 5
        ),
        "delftship-offsets": ExportForm(
            "all lines as DELFTship and FREE!ship list them", (), _delftship_offsets, 4
        ),
        "gf": ExportForm("sections, GHS geometry file", (".gf",), _gf, 4, 1.0 / FOOT),
        "dxf": ExportForm(
            "all lines in their places as splines, DXF", (".dxf",), _dxf, _EXACT, units=_UNITS
        ),
        "dxf-polylines": ExportForm(
            "all lines in their places as polylines, DXF", (), _dxf_polylines, _EXACT, units=_UNITS
        ),
        "dxf-plan": ExportForm(
            "lines plan in three views, DXF", (), _dxf_plan, _EXACT, units=_UNITS, on_paper=True
        ),
        "3dm": ExportForm(
            "lines, surface and closed mesh for Rhino", (".3dm",), rhino_file, _EXACT, units=_UNITS
        ),
        "iges-lines": ExportForm(
            "all lines in their places as splines, IGES 126", (), _iges_lines, _EXACT, units=_UNITS
        ),
    }
)
"""The forms by name."""

ENDINGS: Mapping[str, str] = MappingProxyType(
    {ending: name for name, form in FORMS.items() for ending in form.endings}
)
"""The form that the ending of a file means."""


def export_form(path: str | os.PathLike[str], form: str | None = None) -> str:
    """Tell in which form a file is to be written: the one asked for, else by its ending.

    Raises
    ------
    BadInputError
        Neither says one.

    Examples
    --------
    >>> from assoc_hull.io.export.write import export_form
    >>> export_form("hull.GF"), export_form("sections.dat", "britfair")
    ('gf', 'britfair')
    """
    name = os.fspath(file_path(path, "in export"))
    if form is None and name.lower().endswith(_SURFACE_ENDINGS):
        raise BadInputError(
            "the ending is that of a surface or a mesh, and these are lines", f"at {name}",
            "write those with hull.surface().write(path), or choose the format",
        )  # fmt: skip
    return form_by_ending(path, form, tuple(FORMS), ENDINGS, "in export")


def export_hull(
    state: HullState,
    path: str | os.PathLike[str],
    form: str | None = None,
    unit: str | None = None,
    *,
    scale: float | None = None,
    accept: bool = False,
) -> ExportReport:
    """Write a hull in a form.

    Parameters
    ----------
    state : HullState
        The hull.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : str or None
        One of `FORMS`; by the ending of the file if None.
    unit : {"m", "mm"} or None
        Of a drawing, m if None; the other forms have units of their own.
    scale : float or None
        Of a lines plan: denominator of the scale at which it is to be printed, such as 200. It
        changes letters, not lines, which are drawn at full size. None fits a sheet of A1.
    accept : bool
        Write a surface too that crosses the centre plane or leaves its residual limits.

    Returns
    -------
    ExportReport
        How much was written, how it was rounded, and what the form cannot hold.

    Raises
    ------
    BadInputError, MissingExtraError
        A form that is not known or cannot hold this hull, or a file that cannot be written; a unit
        that the form does not have.
    """
    name = export_form(path, form)
    chosen = FORMS[name]
    book = _book(chosen, name, unit)
    if scale is not None and not chosen.on_paper:
        what = f"the form {name} has no scale on paper"
        raise BadInputError(what, "in export", "leave the scale out")
    book.paper, book.accept = scale, accept
    written = chosen.write(state, book)
    write_whole(path, written)
    # Files of Rhino hold the closed mesh too, which has them.
    but = ", but for the closed mesh" if name == "3dm" else ""
    for kind, what, held in (
        ("tunnels", "its tunnels", state.tunnels),
        ("bodies", "bodies beside its net", state.bodies),
    ):
        if held and name != "hull":
            names = ", ".join(each.name for each in held)
            book.leave_out(kind, "the hull", f"{what} ({names}){but}", len(held))
    report = book.report(os.fspath(path), name)
    return attrs.evolve(report, rounding=0.0) if chosen.decimals == _EXACT else report


def _book(form: ExportForm, name: str, unit: str | None) -> ExportBook:
    """Begin the notes on an export, in the unit that was asked for."""
    if unit is None:
        return ExportBook(form.decimals, form.scale)
    if not form.units:
        what = f"the form {name} has a unit of its own"
        raise BadInputError(what, "in export", "leave the unit out")
    scale = DXF_UNITS[choice(unit, "unit", form.units, "in export")].scale
    return ExportBook(form.decimals, scale, unit)

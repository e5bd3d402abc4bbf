"""Digitised lines as text: CSV points, curves of IGES, or a form of another program.

The form is recognised by the content. `parse_lines` hands the text to its reader; readers of DXF,
BRITFAIR, DELFTship and GHS stand in modules of their own. Points stay in the unit of the file.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterator

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.patches.spline_curve import SplineCurve
from assoc_hull.io.digitised.dxf import parse_dxf
from assoc_hull.io.export.britfair import is_britfair, parse_britfair
from assoc_hull.io.export.delftship import (
    is_delftship,
    is_delftship_offsets,
    parse_delftship,
    parse_delftship_offsets,
)
from assoc_hull.io.export.ghs_geometry import is_gf, parse_gf
from assoc_hull.io.iges.curves import curves_of_iges
from assoc_hull.io.iges.file import IgesFile, looks_like_iges
from assoc_hull.io.lines.raw_lines import (
    BOUNDARIES,
    OTHER_FAMILIES,
    RawLines,
    RawPiece,
    boundary_name,
    read_number,
)
from assoc_hull.io.reports import Notebook
from assoc_hull.io.units import METRES

__all__ = [
    "is_digitised",
    "parse_iges",
    "parse_lines",
]

# --------------------------------------------------------------------------------------
# Curves of IGES, each by the name of its entity.

_CHORD = 1e-6
"""Points leave curves by this part of the size of all: 0.3 mm on a ship of 300 m."""

_FLAT = 1e-4
"""Curves that leave a plane by more than this part of the size lie in none."""

_FAMILIES = ("ST", "SECTION", "FRAME", "FR", "WL", "WATERLINE", "BTK", "BUTTOCK")


def parse_iges(text: str, source: str, book: Notebook) -> RawLines:
    """Read the curves of a file without surfaces; the name of a curve is that of its line.

    Raises
    ------
    BadInputError
        The file is damaged, or holds no curve.
    """
    file = IgesFile.of_text(text, source)
    # Points are handed on in the unit of the file; where it tells none, size or the user will.
    curves, name, notes = curves_of_iges(text, source, None if file.metres else "m")
    unit = name if file.metres and name in METRES else None
    length = METRES[unit] if unit else 1.0
    for note in notes:
        book.suspect("iges", "the file", note)
    size = max(float(np.ptp(curve.points, axis=0).max()) for curve in curves)
    lines = [curve for curve in curves if _is_line(curve, size)]
    others = [curve for curve in curves if not _is_line(curve, size)]
    _report_others(others, book)
    if not lines:
        what = f"none of {len(curves)} curves lies in a plane"
        raise BadInputError(what, f"in {source}", "export sections, waterlines or buttocks")
    pieces = [
        RawPiece(
            curve.name, curve.polyline(_CHORD * size) / length, f"{curve.name!r} of {source}",
            curve.knuckles() / length,
        )
        for curve in lines
    ]  # fmt: skip
    return RawLines(pieces, unit, told=False)


def _is_line(curve: SplineCurve, size: float) -> bool:
    """Tell whether a curve is a boundary, named as a line, or lies in a plane as a line does."""
    if boundary_name(curve.name) is not None:
        return True
    word = curve.name.split()[0].upper() if curve.name.split() else ""
    if word.lower().removesuffix(":") in OTHER_FAMILIES:
        return False
    flat = bool(np.ptp(curve.points, axis=0).min() <= _FLAT * size)
    return word in _FAMILIES or flat


def _report_others(curves: list[SplineCurve], book: Notebook) -> None:
    """Report which curves are left out; of our own families nothing is missed."""
    every = list(dict.fromkeys(curve.name for curve in curves))
    own = [name for name in every if name.partition(":")[0] in OTHER_FAMILIES]
    names = [name for name in every if name not in own]
    if own:
        what = "left out, its like is found anew or cut again"
        book.assume("lines", ", ".join(own[:6]), what, len(own))
    if names:
        known = ", ".join(BOUNDARIES)
        what = f"no section, waterline or buttock, and none of {known}: left out"
        book.suspect("curve", ", ".join(names[:6]), what, len(names))


# --------------------------------------------------------------------------------------
# Recognising the form, and CSV.

_COLUMNS = ("line", "x", "y", "z")

Parse = Callable[[str, str, Notebook], RawLines]


def is_digitised(text: str) -> bool:
    r"""Tell whether a text holds digitised lines rather than a table of offsets.

    Examples
    --------
    >>> from assoc_hull.io.digitised.text import is_digitised
    >>> is_digitised("line,x,y,z\nST 1,0,0,0\n"), is_digitised("station,wl_0,wl_1\n")
    (True, False)
    """
    return _parser(text) is not None


def parse_lines(text: str, source: str, book: Notebook) -> RawLines:
    """Read the pieces of all lines.

    Parameters
    ----------
    text : str
        CSV with the columns line, x, y, z and optionally piece, comma-, semicolon- or
        tab-separated, a blank row beginning another piece; DXF, the layer of a polyline
        naming its line; BRITFAIR; curves or offsets of DELFTship; or a GHS geometry file.
    source : str
        Name of the file, for messages.
    book : Notebook
        Takes what a form holds and polylines do not.

    Raises
    ------
    BadInputError
        None of these forms, a cell that is no number, or no points.
    """
    parse = _parser(text)
    if parse is None:
        raise BadInputError(
            "there are no columns line, x, y, z", f"at {source}",
            "give them in the first row, or a DXF file with polylines",
        )  # fmt: skip
    found = parse(text, source, book)
    if not found.pieces:
        told = "".join(f"; {note.what}" for note in book.suspicions)
        raise BadInputError(
            f"there are no points{told}", f"at {source}", "give two or more per line"
        )  # fmt: skip
    return found


def _parser(text: str) -> Parse | None:
    """Choose by the content what reads a text; None if it holds no digitised lines."""
    forms: tuple[tuple[Callable[[str], bool], Parse], ...] = (
        (_is_csv, _parse_csv), (_is_dxf, parse_dxf), (is_britfair, parse_britfair),
        (is_delftship, parse_delftship), (is_gf, parse_gf),
        (looks_like_iges, parse_iges),
        (is_delftship_offsets, parse_delftship_offsets),  # tells by one row: a title may look alike
    )  # fmt: skip
    return next((parse for is_form, parse in forms if is_form(text)), None)


def _is_dxf(text: str) -> bool:
    return re.search(r"^\s*0\s*\r?\n\s*SECTION\s*$", text[:2000], re.MULTILINE) is not None


def _is_csv(text: str) -> bool:
    first = next((row for row in text.splitlines() if row.strip() and row.lstrip()[0] != "#"), "")
    names = {
        word.strip().lower().strip('"') for word in re.split(r"[,;\t]", first.lstrip("\ufeff"))
    }
    return set(_COLUMNS) <= names


def _parse_csv(text: str, source: str, book: Notebook) -> RawLines:
    """Read points by line and piece; without a column of pieces a blank row begins another."""
    # Spreadsheets begin a file with a byte order mark.
    rows = text.lstrip("\ufeff").splitlines()
    # There is such a row: `_is_csv` has read it.
    head = next(i for i, row in enumerate(rows) if row.strip() and row.lstrip()[0] != "#")
    # The comma comes last: between semicolons or tabs it is a decimal sign.
    mark = next((each for each in ";\t" if each in rows[head]), ",")
    # The head does not go through `csv`, which takes quotes off the other rows.
    names = [word.strip().lower().strip('"') for word in rows[head].split(mark)]
    for name in _COLUMNS:
        if name not in names:
            raise BadInputError(
                f"the separator is {mark!r}, and there is no column {name}",
                f"row {head + 1} of {source}", "separate all columns in one way",
            )  # fmt: skip
    at = [names.index(name) for name in _COLUMNS]
    piece_at = names.index("piece") if "piece" in names else -1
    found: dict[tuple[str, str, int], list[tuple[float, ...]]] = {}
    first: dict[tuple[str, str, int], int] = {}
    part = 0
    for number, cells in _cells(rows, head + 1, mark, source):
        if not any(cell.strip() for cell in cells):
            part += 1
            continue
        if cells[0].lstrip().startswith("#"):
            continue
        where = f"row {number} of {source}"
        # Cells behind these may be missing: of `piece`, or of columns that are not read.
        if len(cells) <= max(at):
            raise BadInputError(f"{len(cells)} cells", where, f"give {len(names)}")
        name = cells[at[0]].strip()
        label = cells[piece_at].strip() if 0 <= piece_at < len(cells) else ""
        key = (name, label, part if piece_at < 0 else 0)
        first.setdefault(key, number)
        found.setdefault(key, []).append(
            tuple(read_number(cells[i], where, comma=mark != ",") for i in at[1:])
        )
    return RawLines(
        [
            RawPiece(key[0], np.array(points), f"row {first[key]} of {source}")
            for key, points in found.items()
        ]
    )


def _cells(rows: list[str], first: int, mark: str, source: str) -> Iterator[tuple[int, list[str]]]:
    """Give the cells of each row, with its number in the file."""
    reader = csv.reader(io.StringIO("\n".join(rows[first:])), delimiter=mark)
    try:
        yield from enumerate(reader, start=first + 1)
    except csv.Error as error:
        where = f"row {first + reader.line_num} of {source}"
        raise BadInputError(f"the row cannot be read ({error})", where, "correct it") from None

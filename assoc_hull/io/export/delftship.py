r"""Curves for DELFTship and FREE!ship: the text that their import of a surface reads.

The first line is the unit: 0 metres, 1 feet. Each curve is one point ``x y z`` a line, from the
bottom up, and ends with an empty line; the curves stand from aft forward; the last line is
``EOF``. x = 0 is the after perpendicular, y is to port, z = 0 the base. Two curves in one plane
are an error there: a section in several curves is written as one, through the centre plane, and
read as several again. The form knows no names and no knuckles.

Reference: FREE!ship manual, section 3.5.4 "Surface"; FREE!ship source (GPL),
``TFreeEdit.File_ImportSurface``.

Examples
--------
>>> from assoc_hull.io.export.delftship import is_delftship, parse_delftship
>>> from assoc_hull.io.offset_report import Notebook
>>> text = "0\n50.0 0.0 0.0\n50.0 4.0 1.0\n\n60.0 0.0 0.5\n60.0 3.0 1.0\nEOF\n"
>>> raw = parse_delftship(text, "text", Notebook())
>>> is_delftship(text), raw.unit, [piece.line for piece in raw.pieces]
(True, 'm', ['ST 50', 'ST 60'])
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.export.sections import CENTRE, on_centre, take_down
from assoc_hull.io.export_book import ExportBook
from assoc_hull.io.lines.digitised_piece import RawPiece, read_number
from assoc_hull.io.lines.line_points import DrawnLine
from assoc_hull.io.lines.raw_lines import RawLines, plane_name
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.offset_report import Notebook

__all__ = ["dumps_delftship", "is_delftship", "name_of", "parse_delftship"]

_UNITS = {"0": "m", "1": "ft"}
_FLAT = 1e-3
"""A curve this flat (in the unit of the file) lies in a plane."""


def is_delftship(text: str) -> bool:
    """Tell by its first lines whether a text holds curves for DELFTship."""
    rows = [row for row in text.lstrip("\ufeff").splitlines()[:8] if row.strip()]
    if len(rows) < 2 or rows[0].strip() not in _UNITS:
        return False
    cells = rows[1].split()
    return len(cells) == 3 and all(any(c.isdigit() for c in cell) for cell in cells)


def dumps_delftship(lines: Sequence[DrawnLine], book: ExportBook) -> str:
    """Write sections.

    Parameters
    ----------
    lines : sequence of DrawnLine
        The sections, from aft.
    book : ExportBook
        Takes what is written, what is mended and what is left out.
    """
    rows = ["0"]
    knuckles, joined, apart = 0, [], []
    for line in lines:
        take_down(line, book)
        knuckles += sum(int(piece.knuckle.sum()) for piece in line.pieces)
        curves = [piece.points for piece in line.pieces]
        if len(curves) > 1 and _on_centre(curves):
            curves = [np.concatenate(curves)]
            joined.append(line.name)
        elif len(curves) > 1:
            apart.append(line.name)
        for points in curves:
            rows += [*(" ".join(row) for row in book.rows(points)), ""]
    if joined:
        what = f"{', '.join(joined)}: their curves are joined along the centre plane"
        book.mend("several curves", f"{len(joined)} sections", what, len(joined))
    if apart:
        what = f"{', '.join(apart)}: several curves in one plane, which the program does not take"
        book.mend("several curves", f"{len(apart)} sections", what, len(apart))
    if knuckles:
        what = f"{knuckles} are written as points like others"
        book.leave_out("knuckles", "the sections", what, knuckles)
    return "\n".join([*rows, "EOF", ""])


def _on_centre(curves: list[FloatArray]) -> bool:
    """Tell whether curves can follow one another along the centre plane."""
    return all(on_centre(one, -1) and on_centre(other, 0) for one, other in pairwise(curves))


def parse_delftship(text: str, source: str, book: Notebook) -> RawLines:
    """Read the curves.

    Parameters
    ----------
    text : str
        The file.
    source : str
        Its name, for messages.
    book : Notebook
        Takes curves in no plane, which are left out, and curves that were split.

    Raises
    ------
    BadInputError
        A line that is no point, no unit, or a file that ends before ``EOF``.
    """
    rows = text.lstrip("\ufeff").splitlines()
    head = next((k for k, row in enumerate(rows) if row.strip()), 0)
    unit = _UNITS.get(rows[head].strip() if rows else "")
    if unit is None:
        raise BadInputError("the unit is unknown", f"line 1 of {source}", "give 0 (m) or 1 (ft)")
    pieces: list[RawPiece] = []
    split = 0
    for first, points in _curves(rows, head + 1, source):
        where = f"line {first} of {source}"
        name = name_of(points)
        parts = [points] if name == "profile" else _apart(points)
        if name is None or not parts:
            how = "in no plane" if name is None else "in the centre plane, across the ship,"
            book.suspect("curve", where, f"the curve lies {how} and is left out")
            continue
        split += len(parts) - 1
        pieces += [RawPiece(name, part, where) for part in parts]
    if split:
        what = f"{split} stretches along the centre plane are taken to join several curves"
        book.repair("several curves", source, what, split)
    return RawLines(pieces, unit)


def _curves(rows: list[str], first: int, source: str) -> list[tuple[int, FloatArray]]:
    """Read the points of all curves, each with the line it begins on."""
    found: list[tuple[int, FloatArray]] = []
    points: list[list[float]] = []
    for number, row in enumerate(rows[first:], start=first + 1):
        word = row.strip().upper()
        if word and word != "EOF":
            points.append(_point(row, f"line {number} of {source}"))
            continue
        if len(points) > 1:
            found.append((number - len(points), np.array(points)))
        points = []
        if word == "EOF":
            return found
    raise BadInputError(
        "the text ends before EOF", f"at line {len(rows)} of {source}", "take a whole file"
    )


def _point(row: str, where: str) -> list[float]:
    cells = row.replace(",", " ").split()
    if len(cells) != 3:
        raise BadInputError(f"a point has {len(cells)} number(s)", f"at {where}", "give x, y and z")
    return [read_number(cell, f"at {where}") for cell in cells]


def name_of(points: FloatArray) -> str | None:
    """Name a curve by the plane it lies in, sections first; None if it lies in none.

    Parameters
    ----------
    points : (n, 3)
        The curve.
    """
    spread = np.ptp(points, axis=0)
    for group in ("sections", "waterlines", "buttocks"):
        if spread[AXES[group]] < _FLAT:
            offset = float(np.median(points[:, AXES[group]]))
            centre = group == "buttocks" and abs(offset) < _FLAT
            return "profile" if centre else plane_name(group, offset)
    return None


def _apart(points: FloatArray) -> list[FloatArray]:
    """Split a curve where it runs along the centre plane."""
    centre = np.abs(points[:, 1]) < CENTRE
    cuts = np.flatnonzero(centre[1:] & centre[:-1]) + 1
    return [part for part in np.split(points, cuts) if len(part) > 1]

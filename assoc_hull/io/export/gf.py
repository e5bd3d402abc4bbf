r"""GHS geometry files (.GF): the sections of the hull as one displacing part; writing.

The form is in feet, x positive aft, y positive to starboard, z up. A shape is a list of at most
255 sections from forward aft, each at most 255 points of a closed outline that runs
counterclockwise as seen from abaft: of a symmetric hull the starboard half from the bottom up,
the rest being implied. A point is ``y, z``, and may have a surface code (2: the stretch to the
next point is not on the hull), a radius and a line code (``DK``: edge of the deck). The hull is
one shape, one component of side 0 and one part. Here x = 0 stays at the after perpendicular, so
that the hull lies at negative x.

Reference: Creative Systems, Inc., GHS User's Manual, appendix A "Geometry File Format"; it is
quoted in the public source of pymeshup, ``ghs_import.py``.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.export_book import ExportBook
>>> from assoc_hull.io.export.gf import dumps_gf, FOOT
>>> from assoc_hull.io.export.sections import sections_of
>>> book = ExportBook(decimals=4, scale=1.0 / FOOT)
>>> text = dumps_gf("Wigley", 100.0, 10.0, sections_of(wigley(), book), book)
>>> text.splitlines()[10:14]
['*', 'HULL', '19', '-311.6798,32']
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.io.export.sections import CENTRE, take_down
from assoc_hull.io.export_book import ExportBook
from assoc_hull.io.lines.line_points import DrawnLine

__all__ = ["FOOT", "MOST", "dumps_gf"]

FOOT = 0.3048
MOST = 255
"""Sections of a shape, and points of a section."""

_NEAR = 0.01 * FOOT
"""Sections closer than this (m) are not allowed."""

_OFF, _DECK = "2", "0,0,DK"
"""Behind the coordinates: the stretch to the next point is off the hull; the edge of the deck."""


def dumps_gf(
    name: str, length: float, breadth: float, lines: Sequence[DrawnLine], book: ExportBook
) -> str:
    """Write sections.

    Parameters
    ----------
    name : str
        Of the ship.
    length, breadth : float, m
        Overall.
    lines : sequence of DrawnLine
        The sections, from aft.
    book : ExportBook
        With a scale of feet in a metre; takes what is written and what is mended.

    Raises
    ------
    BadInputError
        More sections than the form holds, or more points in one.
    """
    wanted = _spaced(list(lines)[::-1], book)
    if len(wanted) > MOST:
        raise BadInputError(
            f"there are {len(wanted)} sections", "in the export as GF",
            f"the form holds {MOST}: leave some out, or choose another form",
        )  # fmt: skip
    shape: list[str] = ["*", "HULL", str(len(wanted))]
    for line in wanted:
        take_down(line, book)
        shape += _section(line, book)
    _tell(wanted, book)
    title = book.name(name, " -)+-[\\]-~", 58, "HULL").lstrip("*\\") or "HULL"
    [[long, broad]] = book.rows(np.array([[length, breadth]]))
    head = [
        title, r"\Sections of a net of lines; half of a symmetric hull", f"L:{long}", f"W:{broad}",
        "P:M", "OL:AFTER PERPENDICULAR", "OT:CENTERPLANE", "OV:BASELINE", "N:1",
        r"\Forward is negative; surface code 2: not on the hull",
    ]  # fmt: skip
    tail = [
        "0,0,0", "**", "HULL.C", "0", "1.000", "0,0,0", "HULL",
        "***", "HULL", "SEA WATER", "1", "1.025", "0,0,0", "1", "HULL.C", "****", "",
    ]  # fmt: skip
    return "\n".join([*head, *shape, *tail])


def _spaced(lines: list[DrawnLine], book: ExportBook) -> list[DrawnLine]:
    """Leave out sections that lie too close behind the one before."""
    kept: list[DrawnLine] = []
    for line in lines:
        if kept and kept[-1].offset - line.offset < _NEAR:
            what = f"it lies less than {1e3 * _NEAR:.1f} mm from {kept[-1].name}"
            book.leave_out("twin", line.name, what, line.offset)
        else:
            kept.append(line)
    return kept


def _section(line: DrawnLine, book: ExportBook) -> list[str]:
    count = sum(len(piece.points) for piece in line.pieces)
    if count > MOST:
        raise BadInputError(
            f"{line.name} has {count} points", "in the export as GF",
            f"the form holds {MOST}: give a larger chord",
        )  # fmt: skip
    [[x]] = book.rows(np.array([[-line.offset]]))
    found = [f"{x},{count}"]
    for piece in line.pieces:
        rows = [",".join(row) for row in book.rows(piece.points[:, 1:])]
        last = piece is line.pieces[-1]
        if not last:
            rows[-1] += f",{_OFF}"
        elif piece.points[-1, 1] > CENTRE:
            rows[-1] += f",{_DECK}"
        found += rows
    return found


def _tell(lines: list[DrawnLine], book: ExportBook) -> None:
    several = [line.name for line in lines if len(line.pieces) > 1]
    if several:
        what = f"{', '.join(several)}: their curves are joined by stretches off the hull (code 2)"
        book.mend("several curves", f"{len(several)} sections", what, len(several))
    knuckles = sum(int(piece.knuckle.sum()) for line in lines for piece in line.pieces)
    if knuckles:
        what = f"{knuckles} are points like others: between points the form is straight"
        book.leave_out("knuckles", "the sections", what, knuckles)

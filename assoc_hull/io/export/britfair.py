r"""BRITFAIR: the sections, buttocks or waterlines of a hull as points, one family per file.

Line 1 is the ship's name (six letters and digits at most), line 2 the family: 1 sections,
2 buttocks, 3 waterlines. Then come curves: a line with the number of points, a number of the
curve and the place of its plane; the points, two coordinates a line; a line with 0, or with
1 to 3 and then one line of tangents. A place of -999 continues the curve before behind a
knuckle. ``0 0 0`` ends the file. The form has no unit; metres are written.

References: AVEVA, "Britfair File", Hull and Outfitting user documentation (2023); readers of
KTH's course in ship design agree on it.

Examples
--------
>>> from assoc_hull.io.export.britfair import is_britfair, parse_britfair
>>> from assoc_hull.io.reports import Notebook
>>> text = "SHIP\n1\n2 1 50.0\n0.0 0.0\n4.0 1.0\n0\n2 1 -999.0\n4.0 1.0\n4.0 6.0\n0\n0 0 0\n"
>>> raw = parse_britfair(text, "text", Notebook())
>>> is_britfair(text), raw.pieces[0].line, raw.pieces[0].points.tolist()
(True, 'ST 50', [[50.0, 0.0, 0.0], [50.0, 4.0, 1.0], [50.0, 4.0, 6.0]])
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.export.sections import count_line
from assoc_hull.io.lines.line_points import CurvePolyline, LinePolylines
from assoc_hull.io.lines.raw_lines import (
    RawLines,
    RawPiece,
    TextRows,
    plane_name,
    read_number,
    whole_number,
)
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.reports import ExportBook, Notebook

__all__ = ["dumps_britfair", "is_britfair", "parse_britfair"]

_TYPES = {1: "sections", 2: "buttocks", 3: "waterlines"}
_AGAIN = -999.0
"""In place of a plane: the curve goes on behind a knuckle."""

_APART = 0.02
"""Where parts of one curve lie farther apart than this (m or the file's unit), it is told."""

_END = "0 0 0"
_FIRST = re.compile(r"\s*[0-9]{1,6}\s+\S+\s+[-+.0-9eE]+\s*")


def is_britfair(text: str) -> bool:
    """Tell by its second and third line whether a text is a BRITFAIR file."""
    rows = text.lstrip("\ufeff").splitlines()[:4]
    return (
        len(rows) > 2
        and rows[1].strip() in ("1", "2", "3")
        and _FIRST.fullmatch(rows[2]) is not None
    )


def dumps_britfair(name: str, lines: Sequence[LinePolylines], book: ExportBook) -> str:
    """Write sections.

    Parameters
    ----------
    name : str
        Of the ship.
    lines : sequence of LinePolylines
        The sections, from aft.
    book : ExportBook
        Takes what is written and what is mended.
    """
    rows = [book.name(name, "A-Za-z0-9", 6, "SHIP"), "1"]
    number = 0
    for line in lines:
        count_line(line, book)
        for piece in line.pieces:
            number += 1
            rows += _curve(line.offset, number, piece, book)
    several = [line.name for line in lines if len(line.pieces) > 1]
    if several:
        what = f"{', '.join(several)}: each curve is written as one of its own, in the same plane"
        book.mend("several curves", f"{len(several)} sections", what, len(several))
    return "\n".join([*rows, _END, ""])


def _curve(offset: float, number: int, piece: CurvePolyline, book: ExportBook) -> list[str]:
    """Write a curve, anew behind each knuckle."""
    found: list[str] = []
    breaks = [0, *np.flatnonzero(piece.knuckle).tolist(), len(piece.points) - 1]
    for first, last in pairwise(breaks):
        [[place]] = [[f"{_AGAIN:.1f}"]] if first else book.rows(np.array([[offset]]))
        points = book.rows(piece.points[first : last + 1, 1:])
        found.append(f"{len(points)} {number} {place}")
        found += [f"{y} {z}" for y, z in points] + ["0"]
    return found


def parse_britfair(text: str, source: str, book: Notebook) -> RawLines:
    """Read the curves.

    Parameters
    ----------
    text : str
        The file.
    source : str
        Its name, for messages.
    book : Notebook
        Takes tangents that are not read, and parts that do not meet.

    Raises
    ------
    BadInputError
        A line that is not as the form has it, or a file that ends before ``0 0 0``.
    """
    _, _, rest = text.lstrip("\ufeff").partition("\n")
    rows = TextRows.of(rest, source, _END)
    rows.lines = [(k + 1, line) for k, line in rows.lines]
    group = _TYPES.get(whole_number(rows.next("the type of the file"), f"at {rows.where}"), "")
    if not group:
        raise BadInputError("the type of the file is unknown", f"at {rows.where}", "give 1, 2 or 3")
    pieces: list[RawPiece] = []
    while True:
        where = f"line {rows.lines[rows.at][0]} of {source}" if rows.left else rows.where
        count, place = _head(rows)
        if count == 0:
            break
        points = rows.points(count)
        _tangents(rows, book)
        if place != _AGAIN:
            pieces.append(_piece(group, place, points, where))
            continue
        if not pieces:
            raise BadInputError(
                "the first curve continues another", f"at {where}", "give the place of its plane"
            )
        pieces[-1] = _continued(pieces[-1], group, points, where, book)
    return RawLines(pieces)


def _head(rows: TextRows) -> tuple[int, float]:
    """Read the number of points and the place of a curve; no points end the file."""
    cells = rows.next("a curve").split()
    if len(cells) < 3:
        raise BadInputError(
            f"a curve begins with {len(cells)} number(s)", f"at {rows.where}",
            "give points, number and place",
        )  # fmt: skip
    count = whole_number(cells[0], f"at {rows.where}")
    if count < 0:
        raise BadInputError(f"{count} points", f"at {rows.where}", "correct the line")
    return count, read_number(cells[2], f"at {rows.where}")


def _tangents(rows: TextRows, book: Notebook) -> None:
    """Pass over tangents at the ends of a curve."""
    kind = whole_number(rows.next("the kind of tangents").split()[0], f"at {rows.where}")
    if kind not in range(4):
        raise BadInputError(f"{kind} is no kind of tangents", f"at {rows.where}", "give 0 to 3")
    if kind:
        rows.numbers("tangents", 2 if kind == 3 else 1)
        if "tangents" not in {note.kind for note in book.assumptions}:
            book.assume("tangents", rows.where, "tangents at ends of curves are not read")


def _in_space(group: str, place: float, points: FloatArray) -> FloatArray:
    axis = AXES[group]
    return np.asarray(np.insert(points, axis, place, axis=1))


def _piece(group: str, place: float, points: FloatArray, where: str) -> RawPiece:
    return RawPiece(plane_name(group, place), _in_space(group, place, points), where)


def _continued(
    piece: RawPiece, group: str, points: FloatArray, where: str, book: Notebook
) -> RawPiece:
    """Put the part of a curve behind a knuckle behind the part before it."""
    more = _in_space(group, float(piece.points[0, AXES[group]]), points)
    away = float(np.linalg.norm(more[0] - piece.points[-1]))
    if away > _APART:
        what = f"its parts lie {away:.4g} apart at a knuckle ({where}) and were joined"
        book.suspect("knuckle", piece.line, what, away)
    same = 1 if away < 1e-9 else 0
    points = np.concatenate([piece.points, more[same:]])
    return RawPiece(piece.line, points, piece.where, np.vstack([piece.knuckles, more[:1]]))

r"""Offsets as 3D points: the list that FREE!ship and DELFTship write of all their lines.

Each line begins with its family and place (``Station  50.000``); one in several curves tells
how many (``2 segments.``) and begins each with ``SEGMENT 1``; points ``x y z`` follow, indented,
four digits after the point, with the word ``KNUCKLE`` where there is one. Boundary curves stand
at the end, each under the word ``CONTROLCURVE``, without a name. The list has no unit; metres
are written.

Reference: FREE!ship manual, section 3.6.9 "Offsets"; FREE!ship source (GPL),
``TFreeEdit.File_ExportOffsets``.

Examples
--------
>>> from assoc_hull.io.export.delftship_offsets import is_delftship_offsets, parse_delftship_offsets
>>> from assoc_hull.io.offset_report import Notebook
>>> text = "Station  50.000\n   50.0 0.0 0.0\n   50.0 4.0 1.0  KNUCKLE\n   50.0 4.0 6.0\n"
>>> raw = parse_delftship_offsets(text, "text", Notebook())
>>> is_delftship_offsets(text), raw.pieces[0].line, len(raw.pieces[0].points)
(True, 'ST 50', 3)
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import arc_length, foot_on
from assoc_hull.io.export.delftship import name_of
from assoc_hull.io.export.sections import take_down
from assoc_hull.io.export_book import ExportBook
from assoc_hull.io.lines.digitised_piece import RawPiece, read_number
from assoc_hull.io.lines.line_points import DrawnLine, DrawnPiece
from assoc_hull.io.lines.raw_lines import RawLines
from assoc_hull.io.offset_report import Notebook

__all__ = ["dumps_delftship_offsets", "is_delftship_offsets", "parse_delftship_offsets"]

_WORDS = {"sections": "Station", "buttocks": "Buttock", "waterlines": "Waterline"}
_HEAD = re.compile(r"(Station|Buttock|Waterline|Diagonal|Free)\s+-?[0-9.]+\s*", re.IGNORECASE)
_SEGMENTS = re.compile(r"\s*[0-9]+ segments\.\s*", re.IGNORECASE)
_SEGMENT = re.compile(r"\s*SEGMENT\s+[0-9]+\s*", re.IGNORECASE)
_CURVE = "controlcurve"
_CONTROL = re.compile(r"\s*CONTROLCURVE\s*", re.IGNORECASE)


_NEAR = 1e-3
_REACH = 0.02
_MOST = 0.8
"""The curve on which more than this part of the stations end is the edge of the deck."""


@attrs.frozen(eq=False)
class _Run:
    """One curve: word of its head, first line in the file, points, and which are knuckles."""

    head: str
    first: int
    points: FloatArray
    knuckles: list[int]


def is_delftship_offsets(text: str) -> bool:
    """Tell by its first line whether a text is a list of offsets as 3D points."""
    rows = text.lstrip("\ufeff").split("\n", 1)
    return _HEAD.fullmatch(rows[0]) is not None and "," not in rows[0]


def dumps_delftship_offsets(lines: Sequence[DrawnLine], book: ExportBook) -> str:
    """Write lines.

    Parameters
    ----------
    lines : sequence of DrawnLine
        Sections, buttocks, waterlines and boundary curves.
    book : ExportBook
        Takes what is written and what is mended.
    """
    rows: list[str] = []
    ordered = [line for group in _WORDS for line in lines if line.group == group]
    for line in ordered:
        take_down(line, book)
        rows.append(f"{_WORDS[line.group]} {line.offset + 0.0:7.3f}")
        several = len(line.pieces) > 1
        rows += [f"{len(line.pieces)} segments."] if several else []
        for k, piece in enumerate(line.pieces, start=1):
            rows += [f"SEGMENT {k}"] if several else []
            rows += _points(piece, book)
    borders = [line for line in lines if line.group == "boundary"]
    for line in borders:
        take_down(line, book)
        for piece in line.pieces:
            rows += ["CONTROLCURVE", *_points(piece, book)]
    if borders:
        names = ", ".join(line.name for line in borders)
        what = f"{names}: written as control curves, which have no names"
        book.mend("boundary", f"{len(borders)} boundary curves", what, len(borders))
    return "\n".join([*rows, ""])


def _points(piece: DrawnPiece, book: ExportBook) -> list[str]:
    rows = book.rows(piece.points)
    marks = ["    KNUCKLE" if each else "" for each in piece.knuckle.tolist()]
    return [
        "        " + " ".join(f"{cell:>10}" for cell in row) + mark
        for row, mark in zip(rows, marks, strict=True)
    ]


def parse_delftship_offsets(text: str, source: str, book: Notebook) -> RawLines:
    """Read the lines.

    Parameters
    ----------
    text : str
        The file.
    source : str
        Its name, for messages.
    book : Notebook
        Takes the curves that are left out.

    Raises
    ------
    BadInputError
        A row that is neither a head nor a point.
    """
    runs = _runs(text, source)
    pieces: list[RawPiece] = []
    left: dict[str, int] = {}
    for run in runs:
        name = _border(run.points, runs) if run.head == _CURVE else name_of(run.points)
        if run.head in ("diagonal", "free") or name is None:
            left[run.head] = left.get(run.head, 0) + 1
        else:
            where = f"line {run.first} of {source}"
            pieces.append(RawPiece(name, run.points, where, run.points[run.knuckles]))
    for head, count in left.items():
        what = f"{count} curves under {head!r} are left out: nothing tells what lines they are"
        book.suspect("curve", source, what, count)
    return RawLines(pieces)


def _border(points: FloatArray, runs: list[_Run]) -> str | None:
    """Tell a boundary curve: the profile, a transom, or the deck edge; None if it is another."""
    if np.abs(points[:, 1]).max() < _NEAR:
        return "profile"
    aft = min(float(run.points[:, 0].min()) for run in runs)
    if float(points[:, 0].max()) - aft < _NEAR:
        return "transom"
    stations = [run.points for run in runs if run.head == "station"]
    tops = [each[int(each[:, 2].argmax())] for each in stations]
    length = arc_length(points)
    away = [foot_on(points, length, top)[1] for top in tops]
    at_deck = [each < _REACH for each in away]
    return "deck edge" if tops and sum(at_deck) > _MOST * len(tops) else None


def _runs(text: str, source: str) -> list[_Run]:
    """Give the curves."""
    found: list[_Run] = []
    head, first = "", 0
    marks: list[int] = []
    points: list[list[float]] = []
    rows = text.lstrip("\ufeff").splitlines()
    for number, row in enumerate([*rows, ""], start=1):
        begins = _HEAD.fullmatch(row) or _CONTROL.fullmatch(row)
        if begins or _SEGMENT.fullmatch(row) or _SEGMENTS.fullmatch(row) or not row.strip():
            if len(points) > 1:
                found.append(_Run(head, first, np.array(points), marks))
            head = row.split()[0].lower() if begins else head
            first, marks, points = number + 1, [], []
            continue
        cells = row.split()
        marks += [len(points)] if len(cells) == 4 else []
        points.append(_point(cells, f"at line {number} of {source}"))
    return found


def _point(cells: list[str], where: str) -> list[float]:
    if len(cells) not in (3, 4) or (len(cells) == 4 and cells[3].upper() != "KNUCKLE"):
        raise BadInputError(
            f"{len(cells)} words are no point", where, "give x, y, z and maybe KNUCKLE"
        )
    return [read_number(cell, where) for cell in cells[:3]]

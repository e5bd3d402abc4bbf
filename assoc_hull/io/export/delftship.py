"""DELFTship and FREE!ship: curves that their import reads, and offsets as 3D points.

Both forms are written and read. x = 0 is the after perpendicular, y is to port, z = 0 the base.
Neither form knows knuckles as the hull does; what is lost is in the report. Source of both: the
FREE!ship manual and FREE!ship's code (GPL).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import cumulative_lengths, project_on_polyline
from assoc_hull.io.export.sections import CENTRE, count_line, on_centre
from assoc_hull.io.lines.line_points import CurvePolyline, LinePolylines
from assoc_hull.io.lines.raw_lines import RawLines, RawPiece, plane_name, read_number
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.reports import ExportBook, Notebook

__all__ = [
    "dumps_delftship",
    "dumps_delftship_offsets",
    "is_delftship",
    "is_delftship_offsets",
    "parse_delftship",
    "parse_delftship_offsets",
    "plane_name_of",
]

# --------------------------------------------------------------------------------------
# Curves. The first line is the unit: 0 metres, 1 feet. Each curve is one point ``x y z`` a line,
# from the bottom up, and ends with an empty line; the curves stand from aft forward; the last line
# is ``EOF``. Two curves in one plane are an error there: a section in several curves is written as
# one, through the centre plane, and read as several again. The form has no names and no knuckles.
# Source: FREE!ship manual, section 3.5.4 "Surface"; ``TFreeEdit.File_ImportSurface``.

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


def dumps_delftship(lines: Sequence[LinePolylines], book: ExportBook) -> str:
    """Write sections, given from aft; `book` takes what is written, changed and left out."""
    rows = ["0"]
    knuckles, joined, apart = 0, [], []
    for line in lines:
        count_line(line, book)
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
    """Read the curves; `book` takes curves in no plane, which are left out, and those split.

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
        name = plane_name_of(points)
        # A plumb end post lies in the centre plane whole.
        whole = name == "profile" or bool((np.abs(points[:, 1]) < CENTRE).all())
        parts = [points] if whole else _split_at_centre(points)
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
            points.append(_curve_point(row, f"line {number} of {source}"))
            continue
        if len(points) > 1:
            found.append((number - len(points), np.array(points)))
        points = []
        if word == "EOF":
            return found
    raise BadInputError(
        "the text ends before EOF", f"at line {len(rows)} of {source}", "take a whole file"
    )


def _curve_point(row: str, where: str) -> list[float]:
    cells = row.replace(",", " ").split()
    if len(cells) != 3:
        raise BadInputError(f"a point has {len(cells)} number(s)", f"at {where}", "give x, y and z")
    return [read_number(cell, f"at {where}") for cell in cells]


def plane_name_of(points: FloatArray) -> str | None:
    """Name a curve (n, 3) by the plane it lies in, sections first; None if it lies in none."""
    spread = np.ptp(points, axis=0)
    for group in ("sections", "waterlines", "buttocks"):
        if spread[AXES[group]] < _FLAT:
            offset = float(np.median(points[:, AXES[group]]))
            centre = group == "buttocks" and abs(offset) < _FLAT
            return "profile" if centre else plane_name(group, offset)
    return None


def _split_at_centre(points: FloatArray) -> list[FloatArray]:
    """Split a curve where it runs along the centre plane."""
    centre = np.abs(points[:, 1]) < CENTRE
    cuts = np.flatnonzero(centre[1:] & centre[:-1]) + 1
    return [part for part in np.split(points, cuts) if len(part) > 1]


# --------------------------------------------------------------------------------------
# Offsets as 3D points. Each line begins with its family and place (``Station  50.000``); one in
# several curves says how many (``2 segments.``) and begins each with ``SEGMENT 1``; points ``x y
# z`` follow, indented, four digits after the point, with the word ``KNUCKLE`` where there is one.
# Boundary curves stand at the end, each under the word ``CONTROLCURVE``, without a name. The list
# has no unit; metres are written. Source: FREE!ship manual, section 3.6.9 "Offsets";
# ``TFreeEdit.File_ExportOffsets``.

_WORDS = {"sections": "Station", "buttocks": "Buttock", "waterlines": "Waterline"}
_HEAD = re.compile(r"(Station|Buttock|Waterline|Diagonal|Free)\s+-?[0-9.]+\s*", re.IGNORECASE)
_SEGMENTS = re.compile(r"\s*[0-9]+ segments\.\s*", re.IGNORECASE)
_SEGMENT = re.compile(r"\s*SEGMENT\s+[0-9]+\s*", re.IGNORECASE)
_CURVE = "controlcurve"
_CONTROL = re.compile(r"\s*CONTROLCURVE\s*", re.IGNORECASE)

_NEAR = 1e-3
_REACH = 0.02
"""The top of a station this near (m) to a control curve lies on it."""

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


def dumps_delftship_offsets(lines: Sequence[LinePolylines], book: ExportBook) -> str:
    """Write sections, buttocks, waterlines and boundary curves."""
    rows: list[str] = []
    ordered = [line for group in _WORDS for line in lines if line.group == group]
    for line in ordered:
        count_line(line, book)
        rows.append(f"{_WORDS[line.group]} {line.offset + 0.0:7.3f}")
        several = len(line.pieces) > 1
        rows += [f"{len(line.pieces)} segments."] if several else []
        for k, piece in enumerate(line.pieces, start=1):
            rows += [f"SEGMENT {k}"] if several else []
            rows += _points(piece, book)
    borders = [line for line in lines if line.group == "boundary"]
    for line in borders:
        count_line(line, book)
        for piece in line.pieces:
            rows += ["CONTROLCURVE", *_points(piece, book)]
    if borders:
        names = ", ".join(line.name for line in borders)
        what = f"{names}: written as control curves, which have no names"
        book.mend("boundary", f"{len(borders)} boundary curves", what, len(borders))
    return "\n".join([*rows, ""])


def _points(piece: CurvePolyline, book: ExportBook) -> list[str]:
    rows = book.rows(piece.points)
    marks = ["    KNUCKLE" if each else "" for each in piece.knuckle.tolist()]
    return [
        "        " + " ".join(f"{cell:>10}" for cell in row) + mark
        for row, mark in zip(rows, marks, strict=True)
    ]


def parse_delftship_offsets(text: str, source: str, book: Notebook) -> RawLines:
    """Read the lines; `book` takes the curves that are left out.

    Raises
    ------
    BadInputError
        A row that is neither a head nor a point.
    """
    runs = _runs(text, source)
    pieces: list[RawPiece] = []
    left: dict[str, int] = {}
    for run in runs:
        name = _border(run.points, runs) if run.head == _CURVE else plane_name_of(run.points)
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
    """Recognise a boundary curve: profile, transom or deck edge; None if it is another."""
    if np.abs(points[:, 1]).max() < _NEAR:
        return "profile"
    aft = min(float(run.points[:, 0].min()) for run in runs)
    if float(points[:, 0].max()) - aft < _NEAR:
        return "transom"
    stations = [run.points for run in runs if run.head == "station"]
    tops = [each[int(each[:, 2].argmax())] for each in stations]
    length = cumulative_lengths(points)
    away = [project_on_polyline(points, length, top)[1] for top in tops]
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
        points.append(_offset_point(cells, f"at line {number} of {source}"))
    return found


def _offset_point(cells: list[str], where: str) -> list[float]:
    if len(cells) not in (3, 4) or (len(cells) == 4 and cells[3].upper() != "KNUCKLE"):
        raise BadInputError(
            f"{len(cells)} words are no point", where, "give x, y, z and maybe KNUCKLE"
        )
    return [read_number(cell, where) for cell in cells[:3]]

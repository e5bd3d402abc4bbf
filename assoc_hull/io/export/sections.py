"""The sections of a hull as forms want them that hold sections and little more.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.reports import ExportBook
>>> from assoc_hull.io.export.sections import sections_to_export
>>> book = ExportBook(decimals=4)
>>> [section.name for section in sections_to_export(wigley(), book)][:2]
['stern post', 'ST 1']
>>> [str(note) for note in book.left_out][0]
'lines: waterlines: 10 lines are left out: the form holds sections'
"""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.io.lines.line_points import CHORD, CurvePolyline, LinePolylines, lines_as_points
from assoc_hull.io.reports import ExportBook
from assoc_hull.model.tables import HullState

__all__ = ["CENTRE", "count_line", "on_centre", "sections_to_export"]

CENTRE = 1e-4
"""A point this close (m) to the centre plane lies in it."""

_SAME = 1e-6
"""Planes closer than this (m) are one."""

_AHEAD = 1e-3
"""Less of the hull (m) before the first or abaft the last section is not worth a word."""


def sections_to_export(
    state: HullState, book: ExportBook, chord: float = CHORD
) -> list[LinePolylines]:
    """Give the sections of a hull from aft, with a transom in a plane across and plumb end posts.

    Parameters
    ----------
    state : HullState
        The hull.
    book : ExportBook
        Takes what is left out: other lines, boundary curves, the ends beyond the sections.
    chord : float, m
        How far polylines may leave the curves.

    Raises
    ------
    BadInputError
        A hull with fewer than two sections, or one whose curve has failed.
    """
    found = _distinct(lines_as_points(state, ("sections",), chord), book)
    if len(found) < 2:
        raise BadInputError(
            f"there are {len(found)} sections", f"in {state.particulars.name}",
            "cut two or more, or choose another form",
        )  # fmt: skip
    others = lines_as_points(state, ("waterlines", "buttocks", "diagonals", "boundary"), chord)
    ends = [each for each in map(_across, others) if each and _is_outside(each, found)]
    written = {each.name for each in ends}
    for each in ends:
        what = f"written as a section at x = {each.offset:.6g} m"
        book.mend("boundary", each.name, what, each.offset)
    _tell_lines([each for each in others if each.name not in written], book)
    found = sorted([*found, *ends], key=lambda each: each.offset)
    found = _with_posts(found, others, book)
    _tell_ends(found, others, book)
    _tell_parts(found, book)
    _tell_tangents(state, book)
    return found


def _distinct(lines: list[LinePolylines], book: ExportBook) -> list[LinePolylines]:
    """Keep one of the sections that lie in one plane."""
    kept: list[LinePolylines] = []
    for line in lines:
        if kept and line.offset - kept[-1].offset < _SAME:
            what = f"it lies in the plane of {kept[-1].name}, which is written"
            book.leave_out("twin", line.name, what, line.offset)
        else:
            kept.append(line)
    return kept


def _across(line: LinePolylines) -> LinePolylines | None:
    """Give a boundary curve in a plane across the ship as a section."""
    every = np.concatenate([piece.points for piece in line.pieces])
    if line.group != "boundary" or np.ptp(every[:, 0]) > _SAME or not np.ptp(every[:, 2]):
        return None
    upward = [_upward(piece) for piece in line.pieces]
    return LinePolylines("sections", line.name, float(every[0, 0]), tuple(upward))


def _upward(piece: CurvePolyline) -> CurvePolyline:
    if piece.points[-1, 2] >= piece.points[0, 2]:
        return piece
    return CurvePolyline(piece.points[::-1].copy(), piece.knuckle[::-1].copy(), piece.chord)


def _is_outside(end: LinePolylines, sections: list[LinePolylines]) -> bool:
    """Tell whether an end lies beyond all sections: else it is not all of the hull there."""
    return not sections[0].offset - _SAME <= end.offset <= sections[-1].offset + _SAME


def _tell_lines(others: list[LinePolylines], book: ExportBook) -> None:
    for family in ("waterlines", "buttocks", "diagonals"):
        count = sum(each.group == family for each in others)
        if count:
            what = f"{count} lines are left out: the form holds sections"
            book.leave_out("lines", family, what, count)
    names = [each.name for each in others if each.group == "boundary"]
    if names:
        what = f"{', '.join(names)}: the form holds sections; their ends lie on these"
        book.leave_out("boundary", f"{len(names)} boundary curves", what, len(names))


_WHOLE = 0.95
"""An end post is plumb over at least this part of the height of the section beside it."""


def _with_posts(
    sections: list[LinePolylines], others: list[LinePolylines], book: ExportBook
) -> list[LinePolylines]:
    """Put plumb ends of the hull before and behind the sections, as sections of no breadth."""
    parts = [piece.points for line in others for piece in line.pieces]
    every = np.concatenate(parts) if parts else np.zeros((0, 3))
    aft = _post(every, sections[0], -1.0)
    fore = _post(every, sections[-1], 1.0)
    for post in (aft, fore):
        if post is not None:
            what = f"plumb at x = {post.offset:.6g} m: written as a section of half-breadth 0"
            book.mend("end post", post.name, what, post.offset)
    return [each for each in (aft, *sections, fore) if each is not None]


def _post(every: FloatArray, beside: LinePolylines, side: float) -> LinePolylines | None:
    """Give the end of the hull aft (-1) or forward (1) of a section if it stands plumb."""
    beyond = every[side * (every[:, 0] - beside.offset) > _SAME]
    if not len(beyond):
        return None
    end = beyond[np.argmax(side * beyond[:, 0]), 0]
    at = beyond[np.abs(beyond[:, 0] - end) < _SAME]
    own = np.concatenate([piece.points[:, 2] for piece in beside.pieces])
    # A rake below the deck, or a breadth, is no post: of these the last section must do.
    if np.abs(at[:, 1]).max() > CENTRE or np.ptp(at[:, 2]) < _WHOLE * np.ptp(own):
        return None
    points = np.array([[end, 0.0, at[:, 2].min()], [end, 0.0, at[:, 2].max()]])
    piece = CurvePolyline(points, np.zeros(2, np.bool_), 0.0)
    name = "stern post" if side < 0.0 else "stem"
    return LinePolylines("sections", name, float(end), (piece,))


def _tell_ends(
    sections: list[LinePolylines], others: list[LinePolylines], book: ExportBook
) -> None:
    """Say how much of the hull lies beyond the first and the last section."""
    x = [piece.points[:, 0] for line in others for piece in line.pieces]
    if not x:
        return
    every = np.concatenate(x)
    for where, last, most in (
        ("the stern", sections[0].offset, sections[0].offset - every.min()),
        ("the bow", sections[-1].offset, every.max() - sections[-1].offset),
    ):
        if most > _AHEAD:
            what = f"{most:.4g} m beyond the section at x = {last:.6g} m are left out"
            book.leave_out("end", where, what, float(most))


def _tell_parts(sections: list[LinePolylines], book: ExportBook) -> None:
    """Say where sections alone leave the hull open: a bulb ends between two of them."""
    several = [line.name for line in sections if len(line.pieces) > 1]
    if several:
        what = (
            f"{', '.join(several)}: where their curves part and end between two sections the form "
            "cannot say, so that a hull read from it is open there; a drawing (DXF, IGES, 3DM) can"
        )
        book.leave_out("parting", f"{len(several)} sections", what, len(several))


def _tell_tangents(state: HullState, book: ExportBook) -> None:
    rows = state.rows
    live = state.live("rows")
    count = int((rows.kind[live] == PointKind.TANGENT).any(axis=1).sum())
    if count:
        what = f"{count} points with a given direction are written as points like others"
        book.leave_out("tangents", "the lines", what, count)


def on_centre(points: np.typing.NDArray[np.float64], end: int) -> bool:
    """Tell whether an end of a polyline, 0 or -1, lies in the centre plane."""
    return bool(abs(points[end, 1]) < CENTRE)


def count_line(line: LinePolylines, book: ExportBook) -> None:
    """Count a line that is written."""
    book.lines += 1
    book.curves += len(line.pieces)
    book.points += sum(len(piece.points) for piece in line.pieces)
    book.chord = max(book.chord, *(piece.chord for piece in line.pieces))

"""Digitised lines of both sides of a hull: cut at the centre plane, one side kept.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.digitised.sides import one_side
>>> from assoc_hull.io.lines.digitised_piece import RawPiece
>>> from assoc_hull.io.offset_report import Notebook
>>> book = Notebook()
>>> whole = np.array([[5.0, 3, 4], [5, 2, 1], [5, 0, 0], [5, -2, 1], [5, -3, 4]])
>>> one_side([RawPiece("ST 5", whole, "row 2")], book)[0].points.tolist()
[[5.0, 3.0, 4.0], [5.0, 2.0, 1.0], [5.0, 0.0, 0.0]]
>>> print(book.report().repairs[0])
both sides: the lines: 1 lines lie on both sides, as ST 5: cut at y = 0 and the port side kept
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import arc_length
from assoc_hull.io.lines.digitised_piece import RawPiece
from assoc_hull.io.offset_report import Notebook

__all__ = ["one_side"]

_FLIP = np.array([1.0, -1.0, 1.0])

_CENTRE = 1e-3
"""Points this close (m) to the centre plane lie in it."""

_ACROSS = 0.02
"""A piece that lies farther than this (m) on each side is drawn on both sides."""

_IMAGE = 0.1
"""A piece whose mirror image is passed by no more than this (m) is drawn twice."""

_SYMMETRIC = 5e-3
"""Sides that differ by more than this (m) are told."""

_AGAIN = 0.05
"""A side that begins this close (m) to where the other began is drawn from its beginning again."""


@attrs.define(eq=False)
class _Sides:
    """The pieces of one line: to port, and to starboard brought to port."""

    port: list[RawPiece] = attrs.field(factory=list)
    starboard: list[RawPiece] = attrs.field(factory=list)
    cut: bool = False


def one_side(raw: list[RawPiece], book: Notebook) -> list[RawPiece]:
    """Bring all pieces to port, those that lie on both sides once.

    Parameters
    ----------
    raw : list of RawPiece
        Points in m, y to port.
    book : Notebook
        Takes what was cut, left out and mirrored, and lines whose sides differ.

    Returns
    -------
    list of RawPiece
        Pieces of a line stand together, the lines in the order in which they come first.
    """
    lines: dict[str, _Sides] = {}
    for each in raw:
        _sort(each, lines.setdefault(each.line, _Sides()))
    kept: list[RawPiece] = []
    cut: list[str] = []
    images = turned = 0
    for name, sides in lines.items():
        again, others = _drawn_twice(sides)
        _tell_difference(name, sides.port, again, book)
        cut += [name] if sides.cut else []
        images += 0 if sides.cut else len(again)
        turned += len(others)
        kept += [*sides.port, *others]
    _tell(cut, images, turned, book)
    return kept


def _tell(cut: list[str], images: int, turned: int, book: Notebook) -> None:
    if cut:
        what = f"{len(cut)} lines lie on both sides, as {cut[0]}: cut at y = 0"
        book.repair("both sides", "the lines", f"{what} and the port side kept", len(cut))
    if images:
        what = f"{images} pieces at negative y are mirror images of others and left out"
        book.repair("both sides", "the lines", what, images)
    if turned:
        what = f"{turned} pieces at negative y brought to port"
        book.repair("mirrored", "the lines", what, turned)


def _sort(piece: RawPiece, sides: _Sides) -> None:
    """Put a piece, or its parts, on the side where it lies."""
    y = piece.points[:, 1]
    across = min(float(y.max()), -float(y.min())) > _ACROSS
    sides.cut |= across
    for points in _cut(piece.points) if across else [piece.points]:
        if points[:, 1].mean() < -1e-6:
            turned = points * _FLIP + 0.0
            sides.starboard.append(RawPiece(piece.line, turned, piece.where))
        else:
            sides.port.append(RawPiece(piece.line, points, piece.where))


def _cut(points: FloatArray) -> list[FloatArray]:
    """Cut a piece where it goes from one side to the other."""
    points = points.copy()
    points[np.abs(points[:, 1]) < _CENTRE, 1] = 0.0
    side = np.sign(points[:, 1])
    off = np.flatnonzero(side)
    found: list[FloatArray] = []
    head = points[: off[0]]
    begin = int(off[0])
    for last, first in zip(off[:-1].tolist(), off[1:].tolist(), strict=True):
        if side[last] != side[first]:
            run = np.concatenate([head, points[begin : last + 1]])
            tail, head = _between(run, points[last + 1 : first], points[first])
            found.append(np.concatenate([run, tail]))
            begin = first
    found.append(np.concatenate([head, points[begin:]]))
    return [each for each in found if len(each) > 1]


def _between(
    run: FloatArray, centre: FloatArray, after: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Share the points in the centre plane between the run before and the run after them."""
    half = len(centre) // 2
    again = any(
        np.linalg.norm(each * _FLIP - run[0]) < _AGAIN for each in (*centre[half:][:1], after)
    )
    if len(centre) == 1 and again:
        nearer = np.linalg.norm(centre[0] - run[-1]) < np.linalg.norm(centre[0] - after)
        return (centre, centre[:0]) if nearer else (centre[:0], centre)
    if len(centre) or again:
        return centre[: (len(centre) + 1) // 2], centre[half:]
    before = run[-1]
    place = before + before[1] / (before[1] - after[1]) * (after - before)
    place[1] = 0.0
    return place[None], place[None]


def _drawn_twice(sides: _Sides) -> tuple[list[RawPiece], list[RawPiece]]:
    """Give the pieces to starboard that port has too, and the others."""
    if not sides.port or not sides.starboard:
        return [], sides.starboard
    if sides.cut:
        if 2.0 * _length(sides.port) < _length(sides.starboard):
            sides.port, sides.starboard = sides.starboard, sides.port
        return sides.starboard, []
    again = [_away(each.points, sides.port) < _IMAGE for each in sides.starboard]
    pairs = list(zip(sides.starboard, again, strict=True))
    return [each for each, twice in pairs if twice], [each for each, twice in pairs if not twice]


def _length(pieces: list[RawPiece]) -> float:
    return sum(float(arc_length(each.points)[-1]) for each in pieces)


def _away(points: FloatArray, pieces: list[RawPiece]) -> float:
    """Give how far the farthest of some points lies off the polylines of pieces, m."""
    nearest = np.full(len(points), np.inf)
    for piece in pieces:
        start, step = piece.points[:-1], np.diff(piece.points, axis=0)
        if not len(step):
            start, step = piece.points, np.zeros_like(piece.points)
        square = np.maximum((step * step).sum(axis=1), 1e-12)
        for i in range(0, len(points), 500):
            off = points[i : i + 500, None] - start
            part = np.clip((off * step).sum(axis=2) / square, 0.0, 1.0)
            far = np.linalg.norm(off - part[:, :, None] * step, axis=2).min(axis=1)
            nearest[i : i + 500] = np.minimum(nearest[i : i + 500], far)
    return float(nearest.max())


def _tell_difference(
    name: str, kept: list[RawPiece], dropped: list[RawPiece], book: Notebook
) -> None:
    away = max((_away(each.points, kept) for each in dropped), default=0.0)
    if away > _SYMMETRIC:
        what = f"its sides differ by up to {1e3 * away:.0f} mm; one is left out"
        book.suspect("both sides", name, what, away)

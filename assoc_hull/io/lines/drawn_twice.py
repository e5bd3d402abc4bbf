"""Lines that are drawn twice over, or in pieces that overlap: each part of a line is kept once.

Drawings hold copies of a line on one another, and pieces that go on for some points beside the
next one. Two curves in one place are no net: what lies along other pieces of its line is left out,
or cut off where the other begins. Points are (n, 3), m; pieces of one side of the hull.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import cumulative_lengths
from assoc_hull.io.lines.raw_lines import RawPiece
from assoc_hull.io.reports import Notebook

__all__ = ["distances_off", "drawn_once"]

# Lengths of this module are those of hulls of 100 m and more, and less in proportion for others.

_AGAIN = 0.1
"""A piece that passes others of its line by no more than this (m) is drawn again."""

_SHARE = 0.25
"""A short one by no more than this part of its length: it may close a gap beside them."""

_MOST = 24
"""Lines in more pieces are not looked at: each is compared with each."""

_ALIKE = 5e-3
"""Pieces that differ by more than this (m) where they are drawn twice are suspected."""


def drawn_once(raw: list[RawPiece], book: Notebook, small: float) -> list[RawPiece]:
    """Give the pieces without what others of their line have too; `small` is that of lengths."""
    lines: dict[str, list[RawPiece]] = {}
    for each in raw:
        lines.setdefault(each.line, []).append(each)
    twice, over = list[str](), list[str]()
    unlike: dict[str, float] = {}
    found: list[RawPiece] = []
    for name, pieces in lines.items():
        if not 1 < len(pieces) <= _MOST:
            found += pieces
            continue
        kept, covered = _without_covered(pieces, small)
        twice += [name] * (len(pieces) - len(kept))
        kept, cut, overlapped = _without_overlaps(kept, small)
        over += [name] * cut
        found += kept
        unlike[name] = max(covered, overlapped)
    _report(book, twice, "are drawn on others of their line and left out")
    _report(book, over, "overlap the next one of their line and are cut there")
    worst = max(unlike, key=lambda name: unlike[name], default="")
    if (off := unlike.get(worst, 0.0)) > small * _ALIKE:
        many = sum(each > small * _ALIKE for each in unlike.values())
        what = f"{many} lines differ where they are drawn twice, by up to {1e3 * off:.3g} mm"
        what += f" ({worst}): one was left out; leave out the one that is wrong"
        book.suspect("drawn twice", "the lines", what, off)
    return found


def _report(book: Notebook, names: list[str], what: str) -> None:
    if names:
        what = f"{len(names)} pieces, as of {names[0]}, {what}"
        book.repair("drawn twice", "the lines", what, len(names))


def _without_covered(pieces: list[RawPiece], small: float) -> tuple[list[RawPiece], float]:
    """Leave out pieces that lie along longer ones; gives the farthest that one lies off, m."""
    kept, worst = list(pieces), 0.0
    sizes = [_length(each.points) for each in pieces]
    for i in np.argsort(sizes, kind="stable").tolist():
        others = [each for each in kept if each is not pieces[i]]
        near = min(small * _AGAIN, _SHARE * sizes[i])
        ends = pieces[i].points[[0, -1]]
        if not others or distances_off(ends, others).max() > near:
            continue
        points = pieces[i].points
        middles = 0.5 * (points[1:] + points[:-1])
        off = float(distances_off(np.concatenate([points, middles]), others).max())
        if off <= near:
            kept, worst = others, max(worst, off)
    return kept, worst


def _without_overlaps(pieces: list[RawPiece], small: float) -> tuple[list[RawPiece], int, float]:
    """Cut pieces off where another goes on; gives how many, and how far they lie apart, m."""
    kept, cut, worst = list(pieces), 0, 0.0
    for i in range(len(kept)):
        for j in range(len(kept)):
            if i == j:
                continue
            off = _overlap(kept[i].points, kept[j].points, small)
            if off is not None:
                points, apart = off
                kept[j] = attrs.evolve(kept[j], points=points)
                cut, worst = cut + 1, max(worst, apart)
    return kept, cut, worst


def _overlap(one: FloatArray, other: FloatArray, small: float) -> tuple[FloatArray, float] | None:
    """Give the other without what it has beside the one, and how far these lie apart there, m.

    An end of each lies beside the other, away from its ends: so one goes on as the other begins.
    """
    near = small * _AGAIN
    if min(len(one), len(other)) < 2:
        return None  # a point lies along nothing
    for end in (one[-1], one[0]):
        place, off = _along(other, end)
        for turned in (other, other[::-1]):
            at = place if turned is other else _length(other) - place
            # The part that is drawn twice is longer than what its ends may be off.
            if off > near or not 2.0 * near < at < _length(other) - near:
                continue
            run = cumulative_lengths(turned)
            double, rest = turned[run < at], turned[run > at + near]
            apart = float(distances_off(double, [RawPiece("", one, "")]).max())
            if apart <= near and len(rest):
                return np.concatenate([end[None], rest]), apart
    return None


def _along(points: FloatArray, place: FloatArray) -> tuple[float, float]:
    """Give how far along a polyline the place of it nearest to another lies, and how near, m."""
    start, step = points[:-1], np.diff(points, axis=0)
    square = np.maximum((step * step).sum(axis=1), 1e-12)
    part = np.clip(((place - start) * step).sum(axis=1) / square, 0.0, 1.0)
    away = np.linalg.norm(start + part[:, None] * step - place, axis=1)
    best = int(away.argmin())
    leg = float(np.sqrt(square[best]))
    return float(cumulative_lengths(points)[best]) + float(part[best]) * leg, float(away[best])


def _length(points: FloatArray) -> float:
    return float(cumulative_lengths(points)[-1])


def distances_off(points: FloatArray, pieces: list[RawPiece]) -> FloatArray:
    """Give how far points lie off the polylines of pieces, (n,), m."""
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
    return nearest

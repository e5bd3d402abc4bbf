"""Holes of boundary curves: ends of their pieces that meet nothing, and what closes them.

A net of a hull closes only where profile, deck edge and transom run on without a break. A piece may
end on another boundary curve or on another piece; two ends that meet nothing leave a hole.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.lines.boundary_holes import polyline_distance
>>> float(polyline_distance(np.array([[0.0, 0, 0], [4, 0, 0]]), np.array([1.0, 0, 3])))
3.0
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.lines.mend_lines import SAME_POINT, join_width_text
from assoc_hull.io.lines.slices import LinePiece
from assoc_hull.io.reports import Notebook

__all__ = ["HOLE", "polyline_distance", "report_holes", "with_met_ends"]

HOLE = "open boundary"
"""The kind of what `report_holes` tells: a net with such a hole does not close."""


def polyline_distance(points: FloatArray, place: FloatArray) -> float:
    """Give how far (m) a place lies off a polyline (n, 3)."""
    start, step = points[:-1], np.diff(points, axis=0)
    part = ((place - start) * step).sum(axis=1) / np.maximum((step * step).sum(axis=1), 1e-12)
    foot = start + np.clip(part, 0.0, 1.0)[:, None] * step
    return float(np.linalg.norm(foot - place, axis=1).min())


def with_met_ends(
    pieces: list[LinePiece], others: Sequence[tuple[str, FloatArray]], reach: float
) -> list[LinePiece]:
    """Name what lies under the ends of the pieces of a boundary curve; "loose" where nothing does.

    `others` are polylines of other boundary curves with their names; `reach` (m) is how near an end
    lies to one that it is on. An end in the very place of another piece of its own is met by it.
    """
    found = []
    for number, piece in enumerate(pieces):
        rest = [each.points for k, each in enumerate(pieces) if k != number]
        first, last = (_under(piece.points[-end], rest, others, reach) for end in (0, 1))
        found.append(attrs.evolve(piece, ends=(first, last)))
    return found


def _under(
    place: FloatArray,
    own: Sequence[FloatArray],
    others: Sequence[tuple[str, FloatArray]],
    reach: float,
) -> str:
    for name, points in others:
        if polyline_distance(points, place) < reach:
            return name
    return (
        "itself" if any(polyline_distance(each, place) <= SAME_POINT for each in own) else "loose"
    )


_WIDEST = 1.0
"""Of a hull of 100 m, of shorter ones less in proportion: ends farther apart (m) than this may end
on a part that the file does not hold, as the end of a bossing."""


def report_holes(
    name: str, pieces: Sequence[LinePiece], book: Notebook, factor: float = 1.0
) -> None:
    """Report ends of pieces that face one another across a hole, the narrowest first.

    `factor` is that of lengths, by the size of the hull.
    """
    free = [
        (number, piece.points[-end])
        for number, piece in enumerate(pieces)
        for end in (0, 1)
        if not piece.closed and piece.ends[end] == "loose"
    ]
    pairs = sorted(
        (float(np.linalg.norm(free[i][1] - free[j][1])), i, j)
        for i in range(len(free))
        for j in range(i + 1, len(free))
        if free[i][0] != free[j][0]
    )
    used, holes = set[int](), 0
    for gap, i, j in pairs:
        # So many holes part so many pieces: the ends that are left are those of the whole curve.
        if used & {i, j} or holes == len(pieces) - 1 or gap > factor * _WIDEST:
            continue
        used |= {i, j}
        holes += 1
        (x, y, z), width = (0.5 * (free[i][1] + free[j][1])).tolist(), join_width_text(gap)
        what = (
            f"a hole of {1e3 * gap:.4g} mm at ({x:.5g}, {y:.5g}, {z:.5g}) m, where two of its "
            f"pieces end: no net closes; draw the curve on, or give join= of {width} m or more"
        )
        book.suspect(HOLE, name, what, gap)

"""Mending lines of points: gaps joined, order found, doubles dropped, holes of boundaries closed.

Both cut and digitised lines come as pieces with loose ends. Ends within `Gaps.join` are joined,
wider gaps up to `Gaps.refuse` are an error. Lines that turn back or cross themselves are put in
order where one order is plain, and reported else. Points are (n, 3), m.

Lines that are drawn twice over, or in pieces that overlap: each part of a line is kept once.

Drawings hold copies of a line on one another, and pieces that go on for some points beside the
next one. Two curves in one place are no net: what lies along other pieces of its line is left out,
or cut off where the other begins. Points are (n, 3), m; pieces of one side of the hull.

Holes of boundary curves: ends of their pieces that meet nothing, and what closes them.

A net of a hull closes only where profile, deck edge and transom run on without a break. A piece may
end on another boundary curve or on another piece; two ends that meet nothing leave a hole.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.lines.mend_lines import polyline_distance
>>> float(polyline_distance(np.array([[0.0, 0, 0], [4, 0, 0]]), np.array([1.0, 0, 3])))
3.0
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import (
    cumulative_lengths,
    distinct_points,
    order_paths,
    self_crossings,
)
from assoc_hull.io.lines.raw_lines import RawPiece
from assoc_hull.io.lines.slices import GapJoin, Gaps, LinePiece
from assoc_hull.io.reports import Notebook

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = [
    "HOLE",
    "distances_off",
    "drawn_once",
    "join_pieces",
    "join_width_text",
    "nearest_ends",
    "polyline_distance",
    "put_in_order",
    "put_pieces_in_order",
    "report_crossings",
    "report_holes",
    "report_joins",
    "with_met_ends",
]

# Lengths of this module are those of hulls of 100 m and more, and less in proportion for others.

_AGAIN = 0.1
"""A piece that passes others of its line by no more than this (m) is drawn again."""

_SHARE = 0.25
"""A short one by no more than this part of its length: it may close a gap beside them."""

_MOST_COMPARED = 24
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
        if not 1 < len(pieces) <= _MOST_COMPARED:
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


# --------------------------------------------------------------------------------------
# Gaps.

SAME_POINT = 1e-6
"""Points as near as this (m) are one. Absolute: micrometres are the best that files hold."""


def join_pieces(
    name: str, pieces: list[LinePiece], gaps: Gaps
) -> tuple[list[LinePiece], list[GapJoin]]:
    """Join loose ends across gaps, the nearest first; gives the pieces, and a record per join.

    Raises
    ------
    BadInputError
        Two loose ends face one another across more than `gaps.join`.
    """
    done: list[GapJoin] = []
    pieces = list(pieces)
    while True:
        near = nearest_ends(pieces)
        if near is None or near[0] > gaps.refuse:
            return pieces, done
        gap, (i, end), (j, other) = near
        place = 0.5 * (_end(pieces[i], end) + _end(pieces[j], other))
        x, y, z = place.tolist()
        if gap > gaps.join:
            raise BadInputError(
                f"the pieces do not chain: two ends {1e3 * gap:.3g} mm apart at "
                f"({x:.4g}, {y:.4g}, {z:.4g}) m", f"in {name}",
                f"mend the mesh there, or give join= of {join_width_text(gap)} m or more",
            )  # fmt: skip
        done.append(GapJoin(name, (x, y, z), gap))
        joined = _join(pieces[i], end, pieces[j], other) if i != j else _close(pieces[i])
        pieces = [each for k, each in enumerate(pieces) if k not in (i, j)] + [joined]


def join_width_text(gap: float) -> str:
    """Write the width (m) that closes a gap, rounded up to millimetres; under 10 mm to 2 digits.

    Examples
    --------
    >>> from assoc_hull.io.lines.mend_lines import join_width_text
    >>> join_width_text(0.1201)
    '0.121'
    """
    digits = 3 if gap >= 1e-2 or gap <= 0.0 else 1 - int(np.floor(np.log10(gap)))
    return f"{np.ceil(10.0**digits * gap) / 10.0**digits:.{digits}f}"


def _end(piece: LinePiece, end: int) -> FloatArray:
    return np.asarray(piece.points[-end])


def nearest_ends(pieces: list[LinePiece]) -> tuple[float, tuple[int, int], tuple[int, int]] | None:
    """Give the two loose ends that lie closest: their gap (m), and piece and end of each."""
    loose = [
        (i, end)
        for i, piece in enumerate(pieces)
        for end in (0, 1)
        if not piece.closed and piece.ends[end] == "loose"
    ]
    if len(loose) < 2:
        return None
    place = np.array([_end(pieces[i], end) for i, end in loose])
    owner = np.array([i for i, _ in loose])
    # The two ends of one piece are compared too, to close it, unless it has too few points.
    short = np.array([len(pieces[i].points) < 4 for i, _ in loose])
    first, second = np.triu_indices(len(loose), 1)
    apart = (owner[first] != owner[second]) | ~short[first]
    first, second = first[apart], second[apart]
    if not len(first):
        return None
    step = place[first] - place[second]
    gaps = np.sqrt((step * step).sum(axis=1))
    best = int(gaps.argmin())
    return float(gaps[best]), loose[int(first[best])], loose[int(second[best])]


def _join(first: LinePiece, end: int, second: LinePiece, other: int) -> LinePiece:
    """Put the second behind the first, each turned so that the given ends face."""
    a, b = first if end else first.reversed(), second.reversed() if other else second
    points = np.concatenate([a.points, b.points])
    kept = distinct_points(points, SAME_POINT)
    sine: FloatArray | None = None
    owner: IntArray | None = None
    if a.sine is not None and b.sine is not None:
        sine = np.concatenate([a.sine, b.sine])[kept]
    if a.owner is not None and b.owner is not None:
        owner = np.concatenate([a.owner, b.owner])[kept]
    return LinePiece(points[kept], (a.ends[0], b.ends[1]), sine=sine, owner=owner)


def _close(piece: LinePiece) -> LinePiece:
    points = np.concatenate([piece.points, piece.points[:1]])
    kept = distinct_points(points, SAME_POINT)
    sine = None if piece.sine is None else np.append(piece.sine, piece.sine[0])[kept]
    owner = None if piece.owner is None else np.append(piece.owner, piece.owner[0])[kept]
    return LinePiece(points[kept], closed=True, sine=sine, owner=owner)


_WIDE = 5e-3
"""Joins wider than this (m), of a short hull less in proportion, are counted by themselves."""

# --------------------------------------------------------------------------------------
# Order.

_BACK = np.cos(np.deg2rad(135.0))
"""A line that turns by more than this between two points turns back."""

_STEP = 1e-4
"""Steps shorter than this part of the extent may turn back by noise."""

_MOST = 3000
"""Longer pieces are not put in order: their points are too many to be compared in pairs."""


_JUMPS = 2
"""A line drawn on both sides, each from the keel, turns back twice and is in order."""

_WANDERS = 4.0
"""A polyline this many times as long as the shortest tree of its points runs to and fro."""


def put_pieces_in_order(pieces: list[RawPiece], book: Notebook) -> list[RawPiece]:
    """Put pieces (m) whose points are shuffled in order, before hulls or sides are told apart.

    Raises
    ------
    BadInputError
        The points of a line are shuffled, and no one order is plain.
    """
    found = []
    for each in pieces:
        back, points = _turns_back(each.points), each.points
        across = points[:, 1].min() < 0.0 < points[:, 1].max()
        if not len(back) or (across and len(back) <= _JUMPS):
            found.append(each)
            continue
        order = _plain_order(points)
        orders = _orders_of_sides(points) if order is None and across else [order]
        if any(one is None for one in orders):
            _refuse_shuffled(each, back)
            found.append(each)
            continue
        runs = [points[one] for one in orders if one is not None]
        _report_order(each.line, each.points, back, runs, book)
        found += [attrs.evolve(each, points=run) for run in runs]
    return found


def _orders_of_sides(points: FloatArray) -> list[IntArray | None]:
    """Give the order of the points on each side, which at a narrow end lie close to one another."""
    found: list[IntArray | None] = []
    for side in (1.0, -1.0):
        mine = np.flatnonzero(side * points[:, 1] >= 0.0)
        order = _plain_order(points[mine])
        found.append(None if order is None else mine[order])
    # A side that does not begin in the centre plane would lose what lies between.
    return found if (points[:, 1] == 0.0).any() else [None]


def _refuse_shuffled(piece: RawPiece, back: IntArray) -> None:
    """Refuse a line whose points run to and fro; one that only goes back somewhere is let be."""
    points = piece.points[np.unique(np.linspace(0, len(piece.points) - 1, _MOST).astype(int))]
    run = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    if len(back) <= _JUMPS or run < _WANDERS * float(_tree(points).sum()):
        return
    x, y, z = piece.points[back[0]].tolist()
    raise BadInputError(
        f"the points of {piece.line} are in no order: it turns back at {len(back)} of "
        f"{len(piece.points)} points, first at ({x:.4g}, {y:.4g}, {z:.4g}) m, and no one order "
        "is plain",
        f"in {piece.where}", "give the points in order along the line, and a piece for each branch",
    )  # fmt: skip


def put_in_order(name: str, points: FloatArray, book: Notebook) -> FloatArray:
    """Put the points of a piece in order where the line turns back and one order is plain.

    It is plain where joining each point with its nearest ones gives a single path that turns back
    nowhere. No point may come twice in a row. `book` takes what was repaired, or where it turns
    back.
    """
    back = _turns_back(points)
    if not len(back):
        return points
    order = _plain_order(points)
    if order is not None:
        _report_order(name, points, back, [points[order]], book)
        return np.asarray(points[order])
    what = (
        f"{_first_turn(points, back)} and at {len(back) - 1} places more; no one order is plain, "
        "left as it is: give the points in order along the line, and a piece for each branch"
    )
    book.suspect("order", name, what, len(back))
    return points


def _first_turn(points: FloatArray, back: IntArray) -> str:
    x, y, z = points[back[0]].tolist()
    return f"turned back at ({x:.4g}, {y:.4g}, {z:.4g}) m"


def _report_order(
    name: str, points: FloatArray, back: IntArray, runs: list[FloatArray], book: Notebook
) -> None:
    ordered = np.concatenate(runs)[: len(points)]
    # What was left out as it came twice counts as moved.
    moved = int((ordered != points[: len(ordered)]).any(axis=1).sum()) + len(points) - len(ordered)
    what = f"{_first_turn(points, back)}; {moved} of {len(points)} points put in order"
    book.repair("order", name, f"{what} along the line", moved)


def _plain_order(points: FloatArray) -> IntArray | None:
    """Give the order in which points are a line that turns back nowhere; None if none is plain.

    Points that come twice are kept once, but for the end of a closed line.
    """
    if len(points) > _MOST:
        return None
    closed = bool((points[0] == points[-1]).all())
    once = np.sort(np.unique(points, axis=0, return_index=True)[1])
    once = np.arange(len(points)) if closed else once
    path = _path(points[once])
    order = None if path is None else once[path]
    return order if order is not None and not len(_turns_back(points[order])) else None


def _turns_back(points: FloatArray) -> IntArray:
    """Give the points at which a line turns back."""
    step = np.diff(points, axis=0)
    length = np.sqrt((step * step).sum(axis=1))
    least = _STEP * float(np.ptp(points, axis=0).max(initial=0.0))
    ahead = step / np.maximum(length, 1e-300)[:, None]
    cosine = (ahead[1:] * ahead[:-1]).sum(axis=1)
    long = np.minimum(length[1:], length[:-1]) > least
    return np.asarray(np.flatnonzero((cosine < _BACK) & long) + 1)


def _path(points: FloatArray) -> IntArray | None:
    """Give the order along the shortest tree that joins all points, if it does not branch."""
    tree = _tree(points).tocoo()
    edges = np.column_stack([tree.row, tree.col]).astype(np.int64)
    if len(edges) != len(points) - 1 or np.bincount(edges.ravel()).max() > 2:
        return None
    ((order, _),) = order_paths(edges, len(points))
    return order if np.flatnonzero(order == 0)[0] < 0.5 * len(order) else order[::-1].copy()


def _tree(points: FloatArray) -> csr_array:
    """Give the lengths of the shortest tree that joins all points, by pairs of them."""
    from scipy.sparse.csgraph import minimum_spanning_tree
    from scipy.spatial.distance import cdist

    return minimum_spanning_tree(cdist(points, points))


def report_crossings(name: str, pieces: list[LinePiece], axis: int, book: Notebook) -> None:
    """Report a line that crosses itself in its plane, that of constant coordinate `axis`."""
    plane = [other for other in range(3) if other != axis]
    start = np.concatenate([piece.points[:-1, plane] for piece in pieces])
    end = np.concatenate([piece.points[1:, plane] for piece in pieces])
    places = self_crossings(start, end)
    if len(places):
        letters = " ".join(f"{'xyz'[a]} = {v:.4g}" for a, v in zip(plane, places[0], strict=True))
        what = f"the line crosses itself {len(places)} times, first at {letters} m"
        book.suspect("self-crossing", name, what, len(places))


def report_joins(joins: list[GapJoin], book: Notebook, factor: float = 1.0) -> None:
    """Report how many ends were joined across gaps, and the widest of these, as one repair."""
    wide = [join for join in joins if join.gap > factor * _WIDE]
    if joins:
        widest = max(joins, key=lambda each: each.gap)
        what = (
            f"{len(joins)} joins, {len(wide)} of them over {5.0 * factor:.3g} mm, the widest "
            f"{1e3 * widest.gap:.3g} mm in {widest.line}"
        )
        book.repair("join", "the lines", what, widest.gap)


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

"""Mending lines of points: gaps between loose ends joined, points put in order.

Both cut and digitised lines come as pieces with loose ends. Ends within `Gaps.join` are joined,
wider gaps up to `Gaps.refuse` are an error. Lines that turn back or cross themselves are put in
order where one order is plain, and reported else. Points are (n, 3), m.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import distinct_points, order_paths, self_crossings
from assoc_hull.io.lines.raw_lines import RawPiece
from assoc_hull.io.lines.slices import GapJoin, Gaps, LinePiece
from assoc_hull.io.reports import Notebook

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = [
    "join_pieces",
    "join_width_text",
    "nearest_ends",
    "put_in_order",
    "put_pieces_in_order",
    "report_crossings",
    "report_joins",
]

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

"""Nodes of a net: where its curves cross, and crossings that the table of the hull does not hold.

Two curves meet where the table says, not where places are near one another.
Places are compared along one curve only; crossings at one parameter of it are one node.
Borders of flats are found on some lines and drawn through, so the lines between may know nothing of
them; elsewhere a missing crossing is a fault of the net, reported by name.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.splines.distance import closest_points_each
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.geometry.splines.segments import evaluate

__all__ = [
    "RANK",
    "REACH",
    "Stops",
    "UnlistedCrossings",
    "find_stops",
    "merge_linked",
    "merge_stops",
    "unlisted_crossings",
]


REACH = 80e-3 / 300.0
"""Curves that pass one another so near cross, in lengths of the hull."""

_BESIDE = 1e-3
"""A row so near along the curve is the crossing, in lengths of the hull."""


@attrs.frozen(eq=False)
class UnlistedCrossings:
    """Crossings without a row.

    Attributes
    ----------
    pair : (j, 2) int
        The two curves of the net.
    t : (j, 2), m
        Where on them.
    xyz : (j, 3), m
        The place on the first.
    gap : (j,), m
        How far from the second it is.
    """

    pair: IntArray
    t: FloatArray
    xyz: FloatArray
    gap: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.pair, self.t, self.xyz, self.gap)


def unlisted_crossings(
    net: CurveNet, keep: NDArray[np.bool_], curves: IntArray, reach: float = REACH
) -> UnlistedCrossings:
    """Find crossings without a row, where `curves` (c,) intersect the planes of other lines.

    Lines of `keep` (m,) cross that are no farther away there than `reach`, in lengths of the hull:
    80 mm on 300 m.
    """
    length = float(np.ptp(net.batch.xyz[:, 0]))
    lines = keep & np.isfinite(net.normal).all(axis=1) & (np.array(net.family) != "boundary")
    found = [(np.empty((0, 2), np.int64), np.empty((0, 2)), np.empty((0, 3)), np.empty(0))]
    for normal in np.unique(net.normal[lines], axis=0):
        own = np.flatnonzero(lines & (net.normal == normal).all(axis=1))
        others = np.setdiff1d(curves, own)
        if len(others):
            found.append(_of_planes(net, own, others, (length, reach)))
    return UnlistedCrossings(*(np.concatenate([each[i] for each in found]) for i in range(4)))


def _of_planes(
    net: CurveNet, lines: IntArray, curves: IntArray, scale: tuple[float, float]
) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
    """Find those with lines in parallel planes; `scale` is the length, m, and the reach in it."""
    length, reach = scale
    normal = net.normal[lines[0]]
    height = net.batch.xyz[net.batch.start[lines]] @ normal
    offset, plane = np.unique(height.round(9), return_inverse=True)
    number = np.full(net.batch.count, -1, np.int64)
    number[lines] = plane
    batch = SplineBatch.join([net.batch.part(c, c + 1) for c in curves.tolist()])
    met = intersect_planes(batch, normal, offset)
    own = curves[met.curve]
    lost = np.flatnonzero(~_held(net, number, own, met.plane, met.t, _BESIDE * length))
    which, line = np.nonzero(met.plane[lost][:, None] == plane)
    at, other = lost[which], lines[line]
    t, _, distance = closest_points_each(net.batch, other, met.xyz[at])
    good = distance <= reach * length
    pair = np.column_stack([own[at], other])[good]
    return pair, np.column_stack([met.t[at], t])[good], met.xyz[at][good], distance[good]


def _held(
    net: CurveNet, number: IntArray, own: IntArray, plane: IntArray, t: FloatArray, near: float
) -> NDArray[np.bool_]:
    """Tell which meetings of curves with planes are crossings of the net."""
    every, other = net.meets.ravel(), net.meets[:, ::-1].ravel()
    chosen = number[other] >= 0
    # Curve, plane and place in one number: places on one curve and plane stay together.
    width = 4.0 * float(net.batch.knot.max())
    count = int(number.max()) + 1
    held = (every * count + number[other])[chosen] * width + net.place.ravel()[chosen]
    held = np.concatenate([[-np.inf], np.sort(held), [np.inf]])
    asked = (own * count + plane) * width + t
    after = np.searchsorted(held, asked)
    return np.asarray(np.minimum(asked - held[after - 1], held[after] - asked) <= near)


# --------------------------------------------------------------------------------------
# Nodes. Boundary curves end on one another without a row; only their ends are searched for.

_SAME = 1e-5
"""Places on one curve this part of the length of the hull apart are one node."""

_CORNER = 0.985
"""A curve that turns at a point by an angle of a smaller cosine (10 degrees) has a corner there."""

RANK = {name: i for i, name in enumerate(("boundary", "sections", "waterlines", "buttocks"))}
"""Where lines pass one another by a gap, the node lies on that of the lowest rank."""


@attrs.frozen(eq=False)
class Stops:
    """The nodes of a net, and the curves that pass them.

    Attributes
    ----------
    curve : (s,) int
        Curves of the net, ascending.
    t : (s,), m
        Where on them, ascending on each.
    node : (s,) int
        The node there; on one curve each node once, but where a ring closes.
    place : (n, 3), m
        The nodes: on the curve of lowest rank, where curves pass one another.
    row_node : (k,) int
        The node of each crossing of the net; -1 of those that are left out.
    """

    curve: IntArray
    t: FloatArray
    node: IntArray
    place: FloatArray
    row_node: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.t, self.node, self.place, self.row_node)

    def loose_ends(self, net: CurveNet, curves: IntArray) -> IntArray:
        """Give the ends of curves at which no other begins, ends or passes, (l, 2).

        A curve, and 0 for its beginning or 1 for its end.
        """
        near = _near(net)
        first = np.searchsorted(self.curve, curves, side="left")
        after = np.searchsorted(self.curve, curves, side="right")
        length = net.batch.knot[net.batch.start[curves + 1] - 1]
        stops = np.append(self.t, np.inf)
        begins = (after > first) & (stops[np.minimum(first, len(self.t))] <= near)
        ends = (after > first) & (stops[after - 1] >= length - near)
        lost = [
            np.column_stack([curves[~met], np.full((~met).sum(), i)])
            for i, met in enumerate((begins, ends))
        ]
        return np.concatenate(lost)


@attrs.frozen(eq=False)
class _Crossings:
    """Pairs of curves that meet: rows of the table first, then what has no row.

    Attributes
    ----------
    pair : (j, 2) int
        The curves.
    t : (j, 2), m
        Where on them.
    rows : (r,) int
        Which crossings of the net the first ones are.
    """

    pair: IntArray
    t: FloatArray
    rows: IntArray


def find_stops(net: CurveNet, keep: NDArray[np.bool_], search: NDArray[np.bool_]) -> Stops:
    """Find the nodes of a net, numbered along the curves, the first curve first.

    Crossings with curves that are not in `keep` (m,) are left out; along those of `search` (m,)
    crossings without a row are looked for.
    """
    near = _near(net)
    every = _crossings(net, keep, search, near)
    curve, t = every.pair.T.ravel(), every.t.T.ravel()
    crossing = np.tile(np.arange(len(every.pair)), 2)
    order = np.lexsort((crossing, t, curve))
    curve, t, crossing = curve[order], t[order], crossing[order]
    close = np.flatnonzero((np.diff(curve) == 0) & (np.diff(t) <= near))
    one = merge_linked(len(every.pair), np.column_stack([crossing[close], crossing[close + 1]]))
    return _numbered(net, every.rows, one, (curve, t, one[crossing]))


def _near(net: CurveNet) -> float:
    return _SAME * float(np.ptp(net.batch.xyz[:, 0]))


def merge_stops(net: CurveNet, stops: Stops, pairs: IntArray) -> Stops:
    """Make nodes one, pair by pair, (p, 2)."""
    one = merge_linked(len(stops.place), pairs)
    rows = np.flatnonzero(stops.row_node >= 0)
    return _numbered(net, rows, one[stops.row_node[rows]], (stops.curve, stops.t, one[stops.node]))


def _numbered(
    net: CurveNet, rows: IntArray, of_rows: IntArray, found: tuple[IntArray, FloatArray, IntArray]
) -> Stops:
    """Put stops together: no node twice in a row on a curve, numbers in their order."""
    curve, t, node = found
    # A ring passes the node at which it closes twice.
    again = (np.diff(curve, prepend=-1) == 0) & (np.diff(node, prepend=-1) == 0)
    curve, t, node = curve[~again], t[~again], node[~again]
    numbers, node = _in_order(node)
    row_node = np.full(len(net.meets), -1, np.int64)
    row_node[rows] = numbers[of_rows[: len(rows)]]
    return Stops(curve, t, node, _places(net, curve, t, node), row_node)


def _crossings(
    net: CurveNet, keep: NDArray[np.bool_], search: NDArray[np.bool_], near: float
) -> _Crossings:
    """Give all that meets: rows, ends without a row, borders of flats; and corners of curves."""
    rows = np.flatnonzero(keep[net.meets].all(axis=1))
    joint, joint_t = _joints(net, keep, near)
    lost = unlisted_crossings(net, keep, np.flatnonzero(keep & search))
    corner, corner_t = _corners(net, keep)
    return _Crossings(
        np.concatenate([net.meets[rows], joint, lost.pair, corner]),
        np.concatenate([net.place[rows], joint_t, lost.t, corner_t]),
        rows,
    )


def _corners(net: CurveNet, keep: NDArray[np.bool_]) -> tuple[IntArray, FloatArray]:
    """Give corners of curves as crossings of each with itself, so that no edge has one."""
    batch = net.batch
    before, after = (
        each / np.sqrt(dot(each, each))[:, None] for each in (batch.arrive, batch.leave)
    )
    curve = np.repeat(np.arange(batch.count), np.diff(batch.start))
    bent = (dot(before, after) < _CORNER) & keep[curve]
    bent[batch.start[:-1]] = bent[batch.start[1:] - 1] = False
    return np.column_stack([curve, curve])[bent], np.column_stack([batch.knot, batch.knot])[bent]


def _joints(net: CurveNet, keep: NDArray[np.bool_], near: float) -> tuple[IntArray, FloatArray]:
    """Give where ends of curves without a row lie on other curves, or on their own beginning.

    Curves, (j, 2), and parameters on them, (j, 2), m.
    """
    ends = np.array(_bare_ends(net, keep, near), np.int64).reshape(-1, 2)
    hosts = np.flatnonzero(keep)
    own, host = ends.repeat(len(hosts), axis=0), np.tile(hosts, len(ends))
    apart = own[:, 0] != host
    own, host = own[apart], host[apart]
    knot = net.batch.start[own[:, 0] + own[:, 1]] - own[:, 1]
    t, _, distance = closest_points_each(net.batch, host, net.batch.xyz[knot])
    good = distance <= near
    ring = _rings(net, keep, near)
    length = net.batch.knot[net.batch.start[ring + 1] - 1]
    return (
        np.concatenate([np.column_stack([own[:, 0], host])[good], np.column_stack([ring, ring])]),
        np.concatenate(
            [
                np.column_stack([net.batch.knot[knot], t])[good],
                np.column_stack([0.0 * length, length]),
            ]
        ),
    )


def _rings(net: CurveNet, keep: NDArray[np.bool_], near: float) -> IntArray:
    """Give the curves that end where they begin."""
    start = net.batch.start
    away = net.batch.xyz[start[1:] - 1] - net.batch.xyz[start[:-1]]
    return np.flatnonzero(keep & (np.sqrt(dot(away, away)) <= near))


def _bare_ends(net: CurveNet, keep: NDArray[np.bool_], near: float) -> list[tuple[int, int]]:
    """Give ends of curves at which the table holds no crossing: a curve, and 0 or 1."""
    length = net.batch.knot[net.batch.start[1:] - 1]
    bare = np.ones((net.batch.count, 2), bool)
    held = keep[net.meets].all(axis=1)
    for side in (0, 1):
        curve, t = net.meets[held, side], net.place[held, side]
        bare[curve[t <= near], 0] = False
        bare[curve[t >= length[curve] - near], 1] = False
    return [(c, end) for c, end in np.argwhere(bare & keep[:, None]).tolist()]


def merge_linked(count: int, pairs: IntArray) -> IntArray:
    """Give each of some things the least number of those it is linked with, link by link."""
    root = list(range(count))

    def top(i: int) -> int:
        while root[i] != i:
            root[i] = root[root[i]]
            i = root[i]
        return i

    for a, b in pairs.tolist():
        low, high = sorted((top(a), top(b)))
        root[high] = low
    return np.array([top(i) for i in range(count)], np.int64)


def _in_order(node: IntArray) -> tuple[IntArray, IntArray]:
    """Give nodes new numbers as they occur; and each stop that of its node."""
    old, first, back = np.unique(node, return_index=True, return_inverse=True)
    rank = np.empty(len(old), np.int64)
    rank[np.argsort(first, kind="stable")] = np.arange(len(old))
    numbers = np.full(int(old.max(initial=-1)) + 1, -1, np.int64)
    numbers[old] = rank
    return numbers, rank[back]


def _places(net: CurveNet, curve: IntArray, t: FloatArray, node: IntArray) -> FloatArray:
    """Give each node the place on the curve of the lowest rank that passes it, (n, 3), m."""
    rank = np.array([RANK.get(each, len(RANK)) for each in net.family], np.int64)[curve]
    order = np.lexsort((curve, rank, node))
    lowest = order[np.diff(node[order], prepend=-1) != 0]
    return np.array(evaluate(net.batch, curve[lowest], t[lowest]))

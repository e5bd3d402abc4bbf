"""The lines of a hull as a graph: nodes where they cross, edges between neighbouring nodes.

Edges are pieces of curves with points at equal steps; two that are one line are merged first.
Each node has a unit normal, outward, from the directions of the lines that meet there.
Half-edge 2 e runs along edge e, half-edge 2 e + 1 against it.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from functools import cached_property
from itertools import combinations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.surface.cells.net_nodes import RANK, Stops, find_stops, merge_stops

__all__ = [
    "WIDE_CORNER",
    "EdgePieces",
    "Lenses",
    "NetGraph",
    "edge_angles",
    "find_lenses",
    "measure_pieces",
    "net_graph",
    "node_normals",
]


_CHORDS = 24
"""Chords by which the length along a piece of a curve is measured."""


@attrs.frozen(eq=False)
class EdgePieces:
    """Pieces of curves between nodes, measured along their chords.

    Curves that pass one another by a gap have their node on one of them only; pieces of the
    others are moved there, by less and less towards their other end.

    Attributes
    ----------
    batch : SplineBatch
        The curves.
    curve : (e,) int
        The curve of each piece.
    at : (e, s), m
        Parameters on it, at even steps from one end to the other.
    along : (e, s), m
        How far along the piece they lie.
    shift : (e, 2, 3), m
        From the ends of the pieces to their nodes.
    """

    batch: SplineBatch
    curve: IntArray
    at: FloatArray
    along: FloatArray
    shift: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.at, self.along, self.shift)

    @property
    def length(self) -> FloatArray:
        """The length of each piece, (e,), m."""
        return self.along[:, -1]

    def chosen(self, which: IntArray) -> EdgePieces:
        """Give some of the pieces."""
        curve, at, along, shift = self.curve, self.at, self.along, self.shift
        return EdgePieces(self.batch, curve[which], at[which], along[which], shift[which])

    def points(self, part: FloatArray) -> FloatArray:
        """Give points (e, k, 3), m, at parts of the length of each piece, 0 to 1, (k,) or (e, k).

        The ends are the nodes but for rounding.
        """
        part = np.broadcast_to(part, (len(self.curve), np.shape(part)[-1]))
        t = self._parameters(part)
        place = evaluate(self.batch, self.curve.repeat(t.shape[1]), t.ravel())
        first, last = (1.0 - part)[..., None], part[..., None]
        moved = first * self.shift[:, None, 0] + last * self.shift[:, None, 1]
        return np.asarray(place.reshape(*t.shape, 3) + moved)

    def _parameters(self, part: FloatArray) -> FloatArray:
        """Give the parameters at parts of the length of each piece, (e, k), m."""
        wanted = part * self.along[:, -1:]
        after = (self.along[:, None, :] <= wanted[:, :, None]).sum(axis=2)
        after = np.clip(after, 1, self.along.shape[1] - 1)
        row = np.arange(len(part))[:, None]
        low, high = self.along[row, after - 1], self.along[row, after]
        share = np.divide(wanted - low, high - low, out=np.zeros_like(low), where=high > low)
        # The end of a chord to the bit, not by rounding.
        begin, finish = self.at[row, after - 1], self.at[row, after]
        return np.asarray(np.where(share >= 1.0, finish, begin + (finish - begin) * share))


def measure_pieces(
    batch: SplineBatch, curve: IntArray, t: FloatArray, ends: FloatArray
) -> EdgePieces:
    """Measure pieces of curves.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    curve : (e,) int
        The curve of each piece.
    t : (e, 2), m
        Where it begins and ends on it.
    ends : (e, 2, 3), m
        The nodes that it runs between.

    Returns
    -------
    EdgePieces
        Lengths are those of 24 chords.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.surface.cells.net_graph import measure_pieces
    >>> xyz = np.array([[0.0, 0, 0], [4, 0, 0]])
    >>> along = np.array([[1.0, 0, 0], [1, 0, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 4]), xyz, along, along.copy())
    >>> end = np.array([[[1.0, 0, 0], [3, 0, 0]]])
    >>> piece = measure_pieces(line, np.array([0]), np.array([[1.0, 3.0]]), end)
    >>> piece.length.tolist(), piece.points(np.array([0.5])).tolist()
    ([2.0], [[[2.0, 0.0, 0.0]]])
    """
    at = t[:, :1] + (t[:, 1:] - t[:, :1]) * np.linspace(0.0, 1.0, _CHORDS + 1)
    at[:, -1] = t[:, 1]
    place = evaluate(batch, curve.repeat(at.shape[1]), at.ravel()).reshape(*at.shape, 3)
    step = np.diff(place, axis=1)
    along = np.zeros(at.shape)
    np.cumsum(np.sqrt(dot(step, step)), axis=1, out=along[:, 1:])
    return EdgePieces(batch, curve.copy(), at, along, ends - place[:, [0, -1]])


# --------------------------------------------------------------------------------------
# Lenses: two edges between the same two nodes, of lines that lie on one another, or nearly meet.

_SHORT = 2e-4
"""Nodes so near (lengths of the hull) that two lines connect are one: three lines pass there."""

_THIN = 1e-5
"""Pieces of lines nowhere farther apart (lengths of the hull) lie on one another."""

_PARTS = np.linspace(0.0, 1.0, 9)


@attrs.frozen(eq=False)
class Lenses:
    """What is to be done about pairs of edges.

    Attributes
    ----------
    unite : (k, 2) int
        Nodes that are one.
    drop : (d,) int
        Edges that lie on another, and on themselves.
    """

    unite: IntArray
    drop: IntArray


def find_lenses(edge: IntArray, rank: IntArray, pieces: EdgePieces, length: float) -> Lenses:
    """Find pairs of edges that are one.

    Of two that lie on one another that of the lower rank stays. `edge` (e, 2) are the nodes at the
    ends of the edges, `length`, m, is that of the hull.
    """
    first, second = _pairs(edge, rank)
    short = np.maximum(pieces.length[first], pieces.length[second]) <= _SHORT * length
    rings = np.flatnonzero(edge[:, 0] == edge[:, 1])
    rest = np.flatnonzero(~short)
    own, other = _same_way(edge, pieces, first[rest], second[rest])
    away = np.sqrt(dot(own - other, own - other)).max(axis=1, initial=0.0)
    thin = second[rest][away <= _THIN * length]
    return Lenses(edge[first[short]], np.union1d(rings, thin))


def _pairs(edge: IntArray, rank: IntArray) -> tuple[IntArray, IntArray]:
    """Give pairs of edges between the same nodes, that of the lower rank first."""
    low, high = np.sort(edge, axis=1).T
    order = np.lexsort((rank, high, low))
    ends = np.column_stack([low, high])[order]
    at = np.flatnonzero((ends[1:] == ends[:-1]).all(axis=1) & (ends[1:, 0] != ends[1:, 1]))
    return order[at], order[at + 1]


def _same_way(
    edge: IntArray, pieces: EdgePieces, first: IntArray, second: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Give points along both of each pair, from the same node on."""
    own, other = (pieces.chosen(each).points(_PARTS) for each in (first, second))
    turned = edge[first, 0] != edge[second, 0]
    other[turned] = other[turned, ::-1]
    return own, other


# --------------------------------------------------------------------------------------
# Normals at the nodes.

_TANGENT = 0.02
"""Lines whose directions have a smaller cross product do not tell a normal."""

_ALONG = 1.0 - 0.5 * _TANGENT**2
"""Cosine from which an edge runs along a normal: how it lies around that is chance."""

WIDE_CORNER = 0.98
"""The same (11 degrees) for a second look, where the first normals lead to no cells: at the corner
of a raked keel the side leaves a few degrees off the normal of the keel's flat."""

_CROWDED = 0.02
"""Edges that leave a node with so small an angle between them (radians) lie on one another, seen
along its normal: at the foot of a stem the keel does, and the border of a flat bottom."""


def node_normals(
    place: FloatArray, edge: IntArray, leave: FloatArray, along: float = _ALONG
) -> FloatArray:
    """Give unit normals (n, 3) at the nodes (n, 3), m, all to one side of the surface, outward.

    For edges between nodes (e, 2), which leave them in unit directions (e, 2, 3). The mean of the
    neighbours is taken where all lines are tangent to one another, and where some lie on one
    another as seen along the normal of the others, or one leaves along it (the cosine between them
    is above `along`): at corners of the hull.
    """
    if not len(place):
        return np.empty((0, 3))
    normal, size = _widest(len(place), edge, leave)
    ridge = _on_ridge(normal, edge, leave, along)
    good = (size >= _TANGENT) & ~ridge
    sign = _one_side(normal, good, edge, leave, ridge)
    normal = normal * sign[:, None]
    normal = _from_neighbours(normal, good, edge)
    corner = _crowded(edge_angles(normal, edge, leave), edge.ravel(), len(place))
    normal = _from_neighbours(normal, ~corner, edge)
    return normal if _outward(place, normal) else -normal


def edge_angles(normal: FloatArray, edge: IntArray, leave: FloatArray) -> FloatArray:
    """Give angles of edges in the tangent planes of their nodes, (2 e,), radians.

    Both ends of an edge one after the other; counter-clockwise as seen against the normal.
    """
    node, away = edge.ravel(), leave.reshape(-1, 3)
    # The axis that is least along the normal: its cross product with that is longest.
    least = np.abs(normal).argmin(axis=1)
    first = np.cross(np.eye(3)[least], normal)
    first /= np.sqrt(dot(first, first))[:, None]
    second = np.cross(normal, first)
    return np.arctan2(dot(away, second[node]), dot(away, first[node]))


def _on_ridge(
    normal: FloatArray, edge: IntArray, leave: FloatArray, along: float
) -> NDArray[np.bool_]:
    """Tell which nodes an edge leaves along the normal of two others: square corners, (n,)."""
    node, away = edge.ravel(), leave.reshape(-1, 3)
    found = np.zeros(len(normal), np.bool_)
    found[node[np.abs(dot(away, normal[node])) > along]] = True
    return found


def _crowded(angle: FloatArray, node: IntArray, count: int) -> NDArray[np.bool_]:
    """Tell at which nodes two edges lie on one another, (n,)."""
    order = np.lexsort((angle, node))
    first = np.append(True, np.diff(node[order]) != 0)
    after = np.append(angle[order][1:], 0.0)
    start = np.flatnonzero(first)
    last = np.append(start[1:], len(order)) - 1
    after[last] = angle[order][start] + 2.0 * np.pi
    found = np.zeros(count, bool)
    found[node[order][after - angle[order] < _CROWDED]] = True
    return found


def _widest(count: int, edge: IntArray, leave: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give at each node the normal of the two edges that stand most squarely, and their sine."""
    node, away = edge.ravel(), leave.reshape(-1, 3)
    order = np.argsort(node, kind="stable")
    degree = np.bincount(node, minlength=count)
    start = np.concatenate([[0], np.cumsum(degree)])
    best, size = np.zeros((count, 3)), np.zeros(count)
    for i in range(int(degree.max(initial=0))):
        for j in range(i):
            own = np.flatnonzero(degree > i)
            cross = np.cross(away[order[start[own] + j]], away[order[start[own] + i]])
            sine = np.sqrt(dot(cross, cross))
            better = sine > size[own]
            size[own[better]] = sine[better]
            best[own[better]] = cross[better] / sine[better, None]
    return best, size


def _one_side(
    normal: FloatArray,
    good: NDArray[np.bool_],
    edge: IntArray,
    leave: FloatArray,
    ridge: NDArray[np.bool_],
) -> FloatArray:
    """Give signs that turn all normals to one side: along edges, the surest first.

    Over a `ridge`, which has no normal of its own, they go from the edges to one another.
    """
    # From one end of an edge to the other the normal turns as the edge does.
    carried = _turned(normal[edge[:, 0]], leave[:, 0], -leave[:, 1])
    alike = dot(carried, normal[edge[:, 1]])
    alike[~good[edge].all(axis=1)] = 0.0
    beside: list[list[tuple[float, int, float]]] = [[] for _ in range(len(normal))]
    for (a, b), each in zip(edge.tolist(), alike.tolist(), strict=True):
        beside[a].append((-abs(each), b, each))
        beside[b].append((-abs(each), a, each))
    for a, b, each in _over_ridges(normal, good, edge, leave, ridge):
        beside[a].append((-abs(each), b, each))
        beside[b].append((-abs(each), a, each))
    sign = np.zeros(len(normal))
    for seed in np.flatnonzero(good).tolist():
        if sign[seed]:
            continue
        waiting = [(-2.0, seed, 1.0)]
        while waiting:
            _, node, own = heapq.heappop(waiting)
            if sign[node]:
                continue
            sign[node] = own
            for rank, other, each in beside[node]:
                if not sign[other] and good[other]:
                    heapq.heappush(waiting, (rank, other, own if each >= 0.0 else -own))
    return sign


def _over_ridges(
    normal: FloatArray,
    good: NDArray[np.bool_],
    edge: IntArray,
    leave: FloatArray,
    ridge: NDArray[np.bool_],
) -> Iterator[tuple[int, int, float]]:
    """Give the pairs of nodes beside one on a ridge, and how alike their normals are.

    The normal turns as the way from the one to the other does: along the edges, and at the ridge.
    """
    for node in np.flatnonzero(ridge).tolist():
        rows, ends = np.nonzero(edge == node)
        far = edge[rows, 1 - ends]
        out, back = leave[rows, ends], leave[rows, 1 - ends]
        for i, j in combinations(np.flatnonzero(good[far]).tolist(), 2):
            vector = normal[far[i]][None]
            steps = ((back[i], -out[i]), (-out[i], out[j]), (out[j], -back[j]))
            for before, after in steps:
                vector = _turned(vector, before[None], after[None])
            yield int(far[i]), int(far[j]), float(vector[0] @ normal[far[j]])


def _turned(vector: FloatArray, before: FloatArray, after: FloatArray) -> FloatArray:
    """Turn vectors as `before` is turned to `after` by the shortest way."""
    axis = np.cross(before, after)
    cosine = dot(before, after)[:, None]
    once = np.cross(axis, vector)
    share = 1.0 / np.maximum(1.0 + cosine, 1e-9)
    found: FloatArray = vector + once + np.cross(axis, once) * share
    return found


def _from_neighbours(normal: FloatArray, good: NDArray[np.bool_], edge: IntArray) -> FloatArray:
    """Give nodes without a normal the mean of those beside them, ring after ring."""
    normal, known = normal.copy(), good.copy()
    while not known.all():
        total = np.zeros_like(normal)
        for a, b in ((0, 1), (1, 0)):
            own = known[edge[:, b]] & ~known[edge[:, a]]
            np.add.at(total, edge[own, a], normal[edge[own, b]])
        size = np.sqrt(dot(total, total))
        new = (size > 1e-9) & ~known
        if not new.any():
            break
        normal[new] = total[new] / size[new, None]
        known |= new
    return normal


def _outward(place: FloatArray, normal: FloatArray) -> bool:
    """Tell whether normals point away from the middle of the ship on the whole."""
    return float((normal[:, 1] * place[:, 1]).sum()) >= 0.0


# --------------------------------------------------------------------------------------
# The graph.

_NEAR = 0.05
"""So far from a node (m, on a hull of 300 m) the direction of an edge is taken ..."""

_PART = 0.3
"""... but no farther than this part of the edge."""

_SHIP = 300.0


@attrs.frozen(eq=False)
class NetGraph:
    """Crossings of a net and the pieces of lines between them.

    Attributes
    ----------
    net : CurveNet
        Its curves and crossings.
    place : (n, 3), m
        The nodes.
    normal : (n, 3)
        Unit normals of the hull there, outward.
    edge : (e, 2) int
        The nodes that an edge runs between, in the sense of its curve.
    curve : (e,) int
        The curve of the net that it is a piece of; -1 for a straight line that closes a gap.
    t : (e, 2), m
        Where on it the edge begins and ends.
    leave : (e, 2, 3)
        Unit directions in which it leaves its first and its last node.
    row_node : (k,) int
        The node of each crossing of the net; -1 of those that are left out.
    pieces : EdgePieces
        The edges as pieces of curves, to take points from.
    loose : (l, 2) int
        Curves that end on no other, and at which end: 0 the first, 1 the last. Borders of flats
        and knuckles may end anywhere.
    """

    net: CurveNet
    place: FloatArray
    normal: FloatArray
    edge: IntArray
    curve: IntArray
    t: FloatArray
    leave: FloatArray
    row_node: IntArray
    pieces: EdgePieces
    loose: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.place, self.normal, self.edge, self.curve, self.t, self.leave, self.row_node)
        freeze(self.loose)

    @property
    def length(self) -> FloatArray:
        """The length of each edge, (e,), m."""
        return self.pieces.length

    @cached_property
    def degree(self) -> IntArray:
        """How many edges meet at each node, (n,)."""
        return np.bincount(self.edge.ravel(), minlength=len(self.place))

    def points(self, steps: int) -> FloatArray:
        """Give points at equal steps along every edge, (e, steps + 1, 3), m; ends are the nodes."""
        found = self.pieces.points(np.linspace(0.0, 1.0, steps + 1))
        found[:, [0, -1]] = self.place[self.edge]
        return found

    def stops(self, curve: int) -> tuple[IntArray, FloatArray]:
        """Give the nodes along one curve, (j,), and their parameters on it, (j,), m."""
        own = np.flatnonzero(self.curve == curve)
        node = np.concatenate([self.edge[own].ravel()])
        t = np.concatenate([self.t[own].ravel()])
        t, first = np.unique(t, return_index=True)
        return node[first], t


def net_graph(
    net: CurveNet, *, leave_out: NDArray[np.bool_] | None = None, search: bool = False
) -> NetGraph:
    """Make the graph of a net.

    Parameters
    ----------
    net : CurveNet
        Curves and crossings.
    leave_out : (m,) bool or None
        Curves to do without; what they cross loses these nodes.
    search : bool
        Look for crossings that the tables do not hold along all lines, not only along borders of
        flats and knuckles.

    Returns
    -------
    NetGraph
        Every node has two edges or more; pieces of lines that end nowhere are left out.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.curve_net import gather_net
    >>> from assoc_hull.surface.cells.net_graph import net_graph
    >>> found = net_graph(gather_net(ah.examples.wigley().state))
    >>> found.place.shape, found.edge.shape, found.points(4).shape
    ((252, 3), (471, 2), (471, 5, 3))
    """
    keep = np.ones(net.batch.count, bool) if leave_out is None else ~leave_out
    along = keep if search else net.flat | net.knuckle
    found = _settled(net, find_stops(net, keep, along))
    edge, node = _numbered(found.edge, len(found.stops.place))
    place = found.stops.place[node >= 0]
    row_node = np.append(node, -1)[found.stops.row_node]
    leave = _directions(found.pieces, place[edge], _size(net) / _SHIP)
    normal = node_normals(place, edge, leave)
    strict = np.flatnonzero(keep & ~net.flat & ~net.knuckle)
    return NetGraph(
        net, place, normal, edge, found.curve, found.t, leave, row_node, found.pieces,
        found.stops.loose_ends(net, strict),
    )  # fmt: skip


@attrs.frozen(eq=False)
class _Edges:
    """Edges on the nodes of stops."""

    stops: Stops
    edge: IntArray
    curve: IntArray
    t: FloatArray
    pieces: EdgePieces


def _size(net: CurveNet) -> float:
    return float(np.ptp(net.batch.xyz[:, 0]))


def _settled(net: CurveNet, stops: Stops) -> _Edges:
    """Give the edges, after nodes and edges that are one have been made so."""
    rank = np.array([RANK.get(each, len(RANK)) for each in net.family], np.int64)
    while True:
        edge, curve, t = _pieces(stops)
        pieces = measure_pieces(net.batch, curve, t, stops.place[edge])
        found = find_lenses(edge, rank[curve], pieces, _size(net))
        if not len(found.unite):
            break
        stops = merge_stops(net, stops, found.unite)
    stay = np.setdiff1d(np.arange(len(edge)), found.drop)
    kept = stay[_lasting(edge[stay], len(stops.place))]
    return _Edges(stops, edge[kept], curve[kept], t[kept], pieces.chosen(kept))


def _pieces(stops: Stops) -> tuple[IntArray, IntArray, FloatArray]:
    """Give the pieces of curves between neighbouring nodes."""
    own = np.flatnonzero(stops.curve[1:] == stops.curve[:-1])
    edge = np.column_stack([stops.node[own], stops.node[own + 1]])
    return edge, stops.curve[own], np.column_stack([stops.t[own], stops.t[own + 1]])


def _lasting(edge: IntArray, count: int) -> IntArray:
    """Give the edges that stay when ends that lead nowhere are taken off again and again."""
    kept = np.arange(len(edge))
    while True:
        degree = np.bincount(edge[kept].ravel(), minlength=count)
        stay = (degree[edge[kept]] > 1).all(axis=1)
        if stay.all():
            return kept
        kept = kept[stay]


def _numbered(edge: IntArray, count: int) -> tuple[IntArray, IntArray]:
    """Give nodes that have edges new numbers; -1 to the others."""
    node = np.full(count, -1, np.int64)
    used = np.unique(edge)
    node[used] = np.arange(len(used))
    return node[edge], node


def _directions(pieces: EdgePieces, ends: FloatArray, scale: float) -> FloatArray:
    """Give the directions in which edges leave their nodes, (e, 2, 3)."""
    length = np.where(pieces.length > 0.0, pieces.length, 1.0)
    part = np.minimum(_NEAR * scale / length, _PART)
    beside = pieces.points(np.column_stack([part, 1.0 - part]))
    away = beside - ends
    size = np.sqrt(dot(away, away))[..., None]
    found: FloatArray = np.divide(away, size, out=np.zeros_like(away), where=size > 0.0)
    return found

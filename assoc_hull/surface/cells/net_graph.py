"""The lines of a hull as a graph: nodes where they cross, edges between neighbouring nodes."""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.surface.cells.edge_points import Pieces, measured_pieces
from assoc_hull.surface.cells.lenses import find_lenses
from assoc_hull.surface.cells.normals import node_normals
from assoc_hull.surface.cells.stops import RANK, Stops, find_stops, united_stops

__all__ = ["NetGraph", "net_graph"]

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
    net : Net
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
    pieces : Pieces
        The edges as pieces of curves, to take points from.
    loose : (l, 2) int
        Curves that end on no other, and at which end: 0 the first, 1 the last. Borders of flats
        and knuckles may end anywhere.
    """

    net: Net
    place: FloatArray
    normal: FloatArray
    edge: IntArray
    curve: IntArray
    t: FloatArray
    leave: FloatArray
    row_node: IntArray
    pieces: Pieces
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
    net: Net, *, leave_out: NDArray[np.bool_] | None = None, search: bool = False
) -> NetGraph:
    """Make the graph of a net.

    Parameters
    ----------
    net : Net
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
    >>> from assoc_hull.analysis.net.gather import gather
    >>> from assoc_hull.surface.cells.net_graph import net_graph
    >>> found = net_graph(gather(ah.examples.wigley().state))
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
    pieces: Pieces


def _size(net: Net) -> float:
    return float(np.ptp(net.batch.xyz[:, 0]))


def _settled(net: Net, stops: Stops) -> _Edges:
    """Give the edges, after nodes and edges that are one have been made so."""
    rank = np.array([RANK.get(each, len(RANK)) for each in net.family], np.int64)
    while True:
        edge, curve, t = _pieces(stops)
        pieces = measured_pieces(net.batch, curve, t, stops.place[edge])
        found = find_lenses(edge, rank[curve], pieces, _size(net))
        if not len(found.unite):
            break
        stops = united_stops(net, stops, found.unite)
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


def _directions(pieces: Pieces, ends: FloatArray, scale: float) -> FloatArray:
    """Give the directions in which edges leave their nodes, (e, 2, 3)."""
    length = np.where(pieces.length > 0.0, pieces.length, 1.0)
    part = np.minimum(_NEAR * scale / length, _PART)
    beside = pieces.points(np.column_stack([part, 1.0 - part]))
    away = beside - ends
    size = np.sqrt(dot(away, away))[..., None]
    found: FloatArray = np.divide(away, size, out=np.zeros_like(away), where=size > 0.0)
    return found

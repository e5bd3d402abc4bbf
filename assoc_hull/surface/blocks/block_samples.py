"""Points on the lines of a block, with the parameters that its map gives them."""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.surface.blocks.block_map import BlockMap
from assoc_hull.surface.blocks.quad import SIDES
from assoc_hull.surface.blocks.region import BRIDGE
from assoc_hull.surface.blocks.run_slopes import slopes_along
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = ["block_samples"]

_ACROSS, _ALONG = 0.25, 0.6
"""Distance of points, m, on a hull of 300 m; the latter on lines along the body."""
_SHIP = 300.0
_BORDER = 3.5
"""Points on borders weigh so many times more."""


_FAINT = 0.1
"""Points on a bridge, whose place is a guess, weigh so much of what others do."""


@attrs.frozen(eq=False)
class _Edges:
    """Edges of a block, those of its bays too, each once."""

    edge: IntArray
    uv: FloatArray
    held: NDArray[np.bool_]
    border: NDArray[np.bool_]
    inside: NDArray[np.bool_]


def block_samples(
    found: BlockMap, length: float, cuts: IntArray
) -> tuple[Samples, NDArray[np.bool_]]:
    """Give points on the lines of a block and of its bays; also which lie on the block.

    Parameters
    ----------
    found : BlockMap
        The block, laid out.
    length : float, m
        Of the ship.
    cuts : (k,) int
        Edges along which blocks meet: points there hold both parameters, in both blocks.

    Returns
    -------
    Samples
        Points at even steps along every edge, its ends among them.
    (k,) bool
        Those of the block itself.
    """
    graph = found.core.quad.region.graph
    edges = _edges(found, cuts)
    family = np.array(graph.net.family)[graph.curve[edges.edge]]
    coarse = (family != "sections") & (found.plan.kind == "body")
    step = np.where(coarse, _ALONG, _ACROSS) * (length / _SHIP)
    count = np.maximum(np.ceil(graph.length[edges.edge] / step).astype(np.int64), 2)
    owner = np.repeat(np.arange(len(count)), count + 1)
    first = np.append(0, np.cumsum(count + 1))
    rank = np.arange(len(owner)) - first[owner]
    part = rank / count[owner]
    point = _points(graph, edges.edge, count, first)
    uv = _parameters(graph, edges, owner, part)
    weight = graph.length[edges.edge][owner] / count[owner]
    weight = np.where((rank == 0) | (rank == count[owner]), 0.5 * weight, weight)
    weight = np.where(edges.border[owner], _BORDER * weight, weight)
    bridge = family == BRIDGE
    weight = np.where(bridge[owner], _FAINT * weight, weight)
    line = _lines(graph)[graph.curve[edges.edge]][owner]
    inside = edges.inside & ~bridge
    good = weight > 0.0
    low, high = found.reach.T
    uv = np.clip(uv, low, high)
    samples = Samples.of(uv[good], point[good], weight[good], line[good], edges.held[owner][good])
    return samples, inside[owner][good]


def _edges(found: BlockMap, cuts: IntArray) -> _Edges:
    """Gather the edges of the block and its bays with the parameters of their ends."""
    graph = found.core.quad.region.graph
    count = len(graph.edge)
    uv = np.full((count, 2, 2), np.nan)
    held = np.zeros((count, 2), np.bool_)
    border, seen = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    core = found.core.quad.region
    left = core.left.copy()
    for laid in found.bays.values():
        left |= laid.quad.region.left
    outer = left[0::2] ^ left[1::2]
    cut = core.left[0::2] ^ core.left[1::2]
    for laid in (found.core, *found.bays.values()):
        own = laid.quad.region.edges & ~seen
        uv[own] = laid.uv[graph.edge[own]]
        seen |= own
        for side in SIDES:
            edge = laid.quad.side(side) >> 1
            edge = edge[outer[edge] | cut[edge]]
            held[edge, 0 if side[0] == "u" else 1] = True
            border[edge] = True
    held[cut & ~outer] = True
    for rail in found.plan.rails:
        held[rail.half >> 1, 0] = True
    chosen = np.flatnonzero(seen)
    held[cuts[core.edges[cuts]]] = True
    return _Edges(chosen, uv[chosen], held[chosen], border[chosen], core.edges[chosen])


def _lines(graph: NetGraph) -> IntArray:
    """Give the line that points of each curve count as of: a bridge goes with its waterline."""
    first = {name: i for i, name in reversed(list(enumerate(graph.net.name)))}
    return np.array(
        [
            first[name] if family == BRIDGE else i
            for i, (name, family) in enumerate(zip(graph.net.name, graph.net.family, strict=True))
        ],
        np.int64,
    )


def _points(graph: NetGraph, edge: IntArray, count: IntArray, first: IntArray) -> FloatArray:
    """Give the points, edges of one number of steps at a time, (k, 3), m."""
    found = np.empty((int(first[-1]), 3))
    for steps in np.unique(count).tolist():
        own = np.flatnonzero(count == steps)
        place = graph.pieces.chosen(edge[own]).points(np.linspace(0.0, 1.0, steps + 1))
        place[:, [0, -1]] = graph.place[graph.edge[edge[own]]]
        found[first[own][:, None] + np.arange(steps + 1)] = place
    return found


def _parameters(graph: NetGraph, edges: _Edges, owner: IntArray, part: FloatArray) -> FloatArray:
    """Give parameters along the edges: cubics through the nodes, straight on borders, (k, 2), m."""
    length = graph.length[edges.edge]
    leave, arrive = slopes_along(
        graph.curve[edges.edge], graph.edge[edges.edge], graph.t[edges.edge, 0], length, edges.uv,
        edges.border,
    )  # fmt: skip
    p = part[:, None]
    a, b = edges.uv[owner, 0], edges.uv[owner, 1]
    da, db = (each[owner] * length[owner, None] for each in (leave, arrive))
    q = 1.0 - p
    cubic = a + (b - a) * p * p * (3.0 - 2.0 * p) + p * q * (q * da - p * db)
    return np.asarray(np.where(edges.border[owner, None], a + (b - a) * p, cubic))

"""Nodes at the knuckles of boundary curves, where no line of the net need pass."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.vectors import dot
from assoc_hull.surface.cells.edge_points import measured_pieces
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = ["with_kinks"]

_KINK = np.cos(np.radians(20.0))


def with_kinks(graph: NetGraph) -> NetGraph:
    """Give the same graph with the edges of boundary curves parted at knuckles.

    Parameters
    ----------
    graph : NetGraph
        Of a net.
    """
    curve, t = _kinks(graph)
    edge, at = list[int](), list[float]()
    for i in range(len(curve)):
        own = np.flatnonzero(
            (graph.curve == curve[i]) & (graph.t[:, 0] + 1e-9 < t[i]) & (graph.t[:, 1] - 1e-9 > t[i])
        )
        edge += own.tolist()
        at += [float(t[i])] * len(own)
    while edge:
        once = np.unique(edge, return_index=True)[1].tolist()
        graph = _parted(graph, np.array(edge)[once], np.array(at)[once])
        return with_kinks(graph)
    return graph


def _kinks(graph: NetGraph) -> tuple[IntArray, FloatArray]:
    """Give the knuckles of boundary curves: the curve, and where on it, m."""
    net = graph.net
    batch = net.batch
    owner = np.repeat(np.arange(len(net.name)), np.diff(batch.start))
    size = np.sqrt(dot(batch.arrive, batch.arrive) * dot(batch.leave, batch.leave))
    bent = dot(batch.arrive, batch.leave) < _KINK * size
    bent[batch.start[:-1]] = bent[batch.start[1:] - 1] = False
    found = np.flatnonzero(bent & net.end[owner])
    return owner[found], batch.knot[found]


def _parted(graph: NetGraph, edge: IntArray, t: FloatArray) -> NetGraph:
    """Give a graph with a node within some edges, at most one each."""
    batch = graph.net.batch
    knot = [
        int(batch.start[c]) + int(np.abs(batch.knot[batch.start[c] : batch.start[c + 1]] - at).argmin())
        for c, at in zip(graph.curve[edge].tolist(), t.tolist(), strict=True)
    ]
    count = len(graph.place)
    new = count + np.arange(len(edge))
    place = np.concatenate([graph.place, batch.xyz[knot]])
    ends, span, leave = graph.edge.copy(), graph.t.copy(), graph.leave.copy()
    second = np.column_stack([new, ends[edge, 1]])
    second_t = np.column_stack([t, span[edge, 1]])
    towards = _unit(batch.leave[knot]), -_unit(batch.arrive[knot])
    second_leave = np.stack([towards[0], leave[edge, 1]], axis=1)
    ends[edge, 1], span[edge, 1], leave[edge, 1] = new, t, towards[1]
    ends = np.concatenate([ends, second])
    curve = np.concatenate([graph.curve, graph.curve[edge]])
    span = np.concatenate([span, second_t])
    normal = np.concatenate([graph.normal, graph.normal[graph.edge[edge]].mean(axis=1)])
    return attrs.evolve(
        graph, place=place, normal=_unit(normal), edge=ends, curve=curve, t=span,
        leave=np.concatenate([leave, second_leave]),
        pieces=measured_pieces(batch, curve, span, place[ends]),
    )  # fmt: skip


def _unit(vector: FloatArray) -> FloatArray:
    return np.asarray(vector / np.sqrt(dot(vector, vector))[:, None])

"""Nodes at the knuckles of boundary curves, where no line of the net need pass."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.vectors import dot
from assoc_hull.surface.cells.edge_points import measured_pieces
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = ["with_kinks"]

_SNAP = 1e-9
_KINK = np.cos(np.radians(20.0))


def with_kinks(graph: NetGraph) -> NetGraph:
    """Give the same graph with the edges of boundary curves parted at knuckles.

    Parameters
    ----------
    graph : NetGraph
        Of a net.
    """
    curve, t = _kinks(graph)
    for number, at in zip(curve.tolist(), t.tolist(), strict=True):
        low, high = graph.t.T
        within = (graph.curve == number) & (low + _SNAP < at) & (high - _SNAP > at)
        for edge in np.flatnonzero(within).tolist():
            graph = _parted(graph, edge, at)
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


def _parted(graph: NetGraph, edge: int, t: float) -> NetGraph:
    """Give a graph with a node at a knuckle within an edge."""
    batch, curve = graph.net.batch, int(graph.curve[edge])
    first = int(batch.start[curve])
    knot = first + int(np.abs(batch.knot[first : int(batch.start[curve + 1])] - t).argmin())
    new = len(graph.place)
    place = np.concatenate([graph.place, batch.xyz[knot][None]])
    ends, span, leave = graph.edge.copy(), graph.t.copy(), graph.leave.copy()
    second = np.array([[new, ends[edge, 1]]])
    second_t = np.array([[t, span[edge, 1]]])
    second_leave = np.stack([_unit(batch.leave[knot]), leave[edge, 1]])[None]
    ends[edge, 1], span[edge, 1], leave[edge, 1] = new, t, -_unit(batch.arrive[knot])
    ends, span = np.concatenate([ends, second]), np.concatenate([span, second_t])
    curves = np.append(graph.curve, curve)
    normal = _unit(graph.normal[graph.edge[edge]].sum(axis=0))
    return attrs.evolve(
        graph, place=place, normal=np.concatenate([graph.normal, normal[None]]), edge=ends,
        curve=curves, t=span, leave=np.concatenate([leave, second_leave]),
        pieces=measured_pieces(batch, curves, span, place[ends]),
    )  # fmt: skip


def _unit(vector: FloatArray) -> FloatArray:
    return np.asarray(vector / np.sqrt(dot(vector, vector)))

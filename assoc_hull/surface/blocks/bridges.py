"""From a waterline to a sharp corner of the profile beside its end: a straight edge in one cell.

An aperture has its corner where the drawing has it, and no waterline need end there. If the cut
ended beside it, one block would keep a corner of more than 180 degrees in its border, and fold.
So the cut leaves the waterline at its last crossing and runs straight to the corner. The edge is
no line of the hull: nothing is sampled on it.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.surface.blocks.cuts import EndCut
from assoc_hull.surface.blocks.outline import course, turns
from assoc_hull.surface.blocks.region import BRIDGE, Region
from assoc_hull.surface.cells.edge_points import measured_pieces
from assoc_hull.surface.cells.faces import Cells, cells
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = ["bridged"]

_NEAR = 0.01
"""The corner is no farther from the end of the waterline than this part of the ship's length."""
_TIP, _SHARP = 0.002, 40.0
"""It turns by so many degrees over so small a part of the length."""


def bridged(found: Cells, ends: tuple[EndCut | None, ...], length: float) -> Cells:
    """Give the cells with the edges that cuts of ends want.

    Parameters
    ----------
    found : Cells
        The cells of the half hull.
    ends : tuple of EndCut or None
        How the ends are to be cut.
    length : float, m
        Of the ship.

    Returns
    -------
    Cells
        The same, or with one cell more for each edge; numbers of nodes and edges stay.
    """
    whole = Region.whole(found)
    pairs = [_bridge(whole, end, length) for end in ends if end is not None and end.along]
    wanted = [pair for pair in pairs if pair is not None]
    return cells(_with_edges(found.graph, wanted)) if wanted else found


def _bridge(whole: Region, end: EndCut, length: float) -> tuple[int, int] | None:
    """Give the nodes that an edge is to join: the last on the waterline, and the corner."""
    line = end.along[0]
    outline = course(whole)
    at = int(np.flatnonzero(outline.node == line.last)[0])
    away = np.abs(outline.start[:-1] - outline.start[at])
    away = np.minimum(away, outline.length - away)
    sharp = turns(outline, outline.start[:-1], _TIP * length)
    near = np.flatnonzero((away <= _NEAR * length) & (sharp >= _SHARP))
    if not len(near) or at in near or len(line.half) < 2:
        return None
    i = int(near[np.argmax(sharp[near])])
    corner, last = int(outline.node[i]), int(whole.begin(line.half[-1:])[0])
    cell = int(whole.cells.cell_of[whole.loop[i]])
    around = whole.cells.nodes(cell).tolist()
    return (last, corner) if last in around and corner in around else None


def _with_edges(graph: NetGraph, pairs: list[tuple[int, int]]) -> NetGraph:
    """Give a graph with straight edges between pairs of nodes."""
    net = graph.net
    for pair in pairs:
        net = _with_line(net, graph.place[list(pair)])
    first = len(graph.net.name)
    edge = np.concatenate([graph.edge, np.array(pairs, np.int64)])
    curve = np.concatenate([graph.curve, first + np.arange(len(pairs))])
    away = graph.place[edge[-len(pairs) :, 1]] - graph.place[edge[-len(pairs) :, 0]]
    size = np.sqrt((away * away).sum(axis=1))
    t = np.concatenate([graph.t, np.column_stack([np.zeros(len(pairs)), size])])
    unit = away / size[:, None]
    leave = np.concatenate([graph.leave, np.stack([unit, -unit], axis=1)])
    return attrs.evolve(
        graph, net=net, edge=edge, curve=curve, t=t, leave=leave,
        pieces=measured_pieces(net.batch, curve, t, graph.place[edge]),
    )  # fmt: skip


def _with_line(net: Net, ends: FloatArray) -> Net:
    """Give a net with one straight curve more, that is no line of the hull."""
    step = ends[1] - ends[0]
    size = float(np.sqrt((step * step).sum()))
    unit = np.stack([step, step]) / size
    line = SplineBatch(np.array([0, 2]), np.array([0.0, size]), ends.copy(), unit, unit.copy())
    no = np.zeros(1, np.bool_)
    return attrs.evolve(
        net, batch=SplineBatch.join([net.batch, line]), curve=np.append(net.curve, -1),
        name=(*net.name, BRIDGE), family=(*net.family, BRIDGE), end=np.append(net.end, no),
        flat=np.append(net.flat, no), knuckle=np.append(net.knuckle, no),
        x=np.append(net.x, np.nan), centre=np.append(net.centre, no),
        normal=np.concatenate([net.normal, np.full((1, 3), np.nan)]),
    )  # fmt: skip

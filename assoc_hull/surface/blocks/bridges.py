"""From a waterline to a sharp corner of the profile beside its end: an edge through one cell.

An aperture has its corner where the drawing has it, and no waterline need end there. If the cut
ended beside it, one block would keep a corner of more than 180 degrees in its border, and fold.
So the cut leaves the waterline at its last crossing and runs to the corner, in the shape that the
waterline has there, moved along by less and less. The edge is no line of the hull: its points
count for little, and residuals are not taken on them.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.surface.blocks.cuts import EndCut
from assoc_hull.surface.blocks.outline import course, turns
from assoc_hull.surface.blocks.region import BRIDGE, Region
from assoc_hull.surface.cells.edge_points import measured_pieces
from assoc_hull.surface.cells.faces import Cells, cells
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = ["bridged"]

_STEPS = 8
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
    every = [_bridge(whole, end, length) for end in ends if end is not None and end.along]
    wanted = [each for each in every if each is not None]
    return cells(_with_edges(found.graph, wanted)) if wanted else found


@attrs.frozen(eq=False)
class _Bridge:
    """An edge: its nodes, the last on the waterline and the corner; points on it; the waterline."""

    nodes: tuple[int, int]
    place: FloatArray
    curve: int


def _bridge(whole: Region, end: EndCut, length: float) -> _Bridge | None:
    """Give the edge that the cut of an end wants, if it does."""
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
    if last not in around or corner not in around:
        return None
    place = whole.path(line.half[-1:], _STEPS)
    part = np.linspace(0.0, 1.0, _STEPS + 1)[:, None]
    return _Bridge(
        (last, corner), place + part * (whole.graph.place[corner] - place[-1]), line.curve
    )


def _with_edges(graph: NetGraph, bridges: list[_Bridge]) -> NetGraph:
    """Give a graph with more edges."""
    net = graph.net
    for each in bridges:
        net = _with_line(net, each)
    pairs = [each.nodes for each in bridges]
    first = len(graph.net.name)
    edge = np.concatenate([graph.edge, np.array(pairs, np.int64)])
    curve = np.concatenate([graph.curve, first + np.arange(len(pairs))])
    away = graph.place[edge[-len(pairs) :, 1]] - graph.place[edge[-len(pairs) :, 0]]
    size = np.sqrt((away * away).sum(axis=1))
    most = net.batch.knot[net.batch.start[first + 1 :] - 1]
    t = np.concatenate([graph.t, np.column_stack([np.zeros(len(pairs)), most])])
    unit = away / size[:, None]
    leave = np.concatenate([graph.leave, np.stack([unit, -unit], axis=1)])
    return attrs.evolve(
        graph, net=net, edge=edge, curve=curve, t=t, leave=leave,
        pieces=measured_pieces(net.batch, curve, t, graph.place[edge]),
    )  # fmt: skip


def _with_line(net: Net, bridge: _Bridge) -> Net:
    """Give a net with one curve more, that is no line of the hull."""
    no = np.zeros(1, np.bool_)
    line = loft(CurveData.single(bridge.place))
    return attrs.evolve(
        net, batch=SplineBatch.join([net.batch, line]), curve=np.append(net.curve, -1),
        name=(*net.name, net.name[bridge.curve]), family=(*net.family, BRIDGE),
        end=np.append(net.end, no), flat=np.append(net.flat, no),
        knuckle=np.append(net.knuckle, no), x=np.append(net.x, np.nan),
        centre=np.append(net.centre, no),
        normal=np.concatenate([net.normal, np.full((1, 3), np.nan)]),
    )  # fmt: skip

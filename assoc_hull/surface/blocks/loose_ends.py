"""Ends of lines beyond their last crossing: they bound no cell, but are fitted to as well.

The map of a block knows nodes and edges of cells only. A point of a loose end gets the parameters
that its nearest neighbours on the block's lines tell it, by a plane through theirs; as with all
points, the fit corrects them.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.surface.blocks.block import Block
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = ["LooseEnds", "loose_ends", "with_loose_ends"]

_LEAST = 0.01
"""Ends that are shorter, m on a hull of 300 m, are none."""
_SHIP = 300.0
_STEP = 0.25
"""Distance of points, m, on a hull of 300 m."""
_NEIGHBOURS = 24
"""Points on the lines of a block that tell the parameters of a point."""


@attrs.frozen(eq=False)
class LooseEnds:
    """Points on pieces of lines that are no edges of a graph.

    Attributes
    ----------
    point : (k, 3), m
        The points, at even steps; not those where the pieces begin at a crossing.
    weight : (k,), m
        The length of line that each stands for.
    line : (k,) int
        The curve of the net that it is on.
    """

    point: FloatArray
    weight: FloatArray
    line: IntArray


def loose_ends(graph: NetGraph, length: float) -> LooseEnds:
    """Give points on what of the lines of a graph lies before their first or after their last edge.

    Parameters
    ----------
    graph : NetGraph
        The lines; those without any edge are not looked at.
    length : float, m
        Of the ship.
    """
    net, scale = graph.net, length / _SHIP
    parts = []
    for curve in np.unique(graph.curve[graph.curve >= 0]).tolist():
        t = graph.t[graph.curve == curve]
        for begin, end in ((float(t.min()), 0.0), (float(t.max()), net.length(curve))):
            if abs(end - begin) > _LEAST * scale:
                parts.append(_points(net, curve, begin, end, _STEP * scale))
    if not parts:
        return LooseEnds(np.zeros((0, 3)), np.zeros(0), np.zeros(0, np.int64))
    return LooseEnds(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def _points(
    net: Net, curve: int, begin: float, end: float, step: float
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Give points of a piece, the lengths they stand for, and its number as often."""
    count = max(int(np.ceil(abs(end - begin) / step)), 1)
    t = np.linspace(begin, end, count + 1)
    place = evaluate(net.batch, np.full(count + 1, curve), t)
    step_length = np.linalg.norm(np.diff(place, axis=0), axis=1)
    weight = 0.5 * (step_length + np.append(step_length[1:], 0.0))
    return place[1:], weight, np.full(count, curve, np.int64)


def with_loose_ends(blocks: Sequence[Block], found: LooseEnds, grid: float) -> tuple[Block, ...]:
    """Give blocks their nearest loose ends.

    Parameters
    ----------
    blocks : sequence of Block
        The blocks.
    found : LooseEnds
        The points.
    grid : float, m
        To which parameters are rounded.
    """
    if not len(found.point):
        return tuple(blocks)
    near = [_nearest(found.point, block, 1) for block in blocks]
    home = np.stack([away[:, 0] for away, _ in near]).argmin(axis=0)
    return tuple(
        _with_points(block, found, np.flatnonzero(home == i), grid)
        for i, block in enumerate(blocks)
    )


def _nearest(point: FloatArray, block: Block, count: int) -> tuple[FloatArray, IntArray]:
    """Give the nearest points of the lines of a block, and how far they are, (k, count) each."""
    from scipy.spatial import cKDTree

    inside = np.flatnonzero(block.inside)
    away, at = cKDTree(block.samples.point[inside]).query(point, [*range(1, count + 1)])
    return np.asarray(away, np.float64), np.asarray(inside[at], np.int64)


def _with_points(block: Block, found: LooseEnds, mine: IntArray, grid: float) -> Block:
    if not len(mine):
        return block
    old, point = block.samples, found.point[mine]
    uv = np.round(_parameters(block, point) / grid) * grid
    uv = np.clip(uv, *block.extent.T)
    samples = Samples(
        np.concatenate([old.uv, uv]),
        np.concatenate([old.point, point]),
        np.concatenate([old.weight, found.weight[mine]]),
        np.concatenate([old.line, found.line[mine]]),
        np.concatenate([old.held, np.zeros((len(mine), 2), np.bool_)]),
    )
    inside = np.concatenate([block.inside, np.ones(len(mine), np.bool_)])
    return attrs.evolve(block, samples=samples, inside=inside)


def _parameters(block: Block, point: FloatArray) -> FloatArray:
    """Give parameters by the plane that fits those of the neighbours best, (k, 2), m."""
    away, at = _nearest(point, block, min(_NEIGHBOURS, int(block.inside.sum())))
    weight = 1.0 / (away + away[:, -1:] * 0.1)
    uv, place = block.samples.uv[at], block.samples.point[at] - point[:, None]
    share = weight[..., None] / weight.sum(axis=1)[:, None, None]
    middle, centre = (uv * share).sum(axis=1), (place * share).sum(axis=1)
    slope = np.linalg.pinv((place - centre[:, None]) * weight[..., None], rcond=0.05) @ (
        (uv - middle[:, None]) * weight[..., None]
    )
    return np.asarray(middle - np.einsum("ki,kij->kj", centre, slope))

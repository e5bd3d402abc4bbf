"""From the net of a hull to blocks with samples: what a surface is fitted to.

The half hull is parted into cells of its net (`plan`), each block is laid out on a rectangle
(`block_map`), and points are taken along its lines (`block_samples`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.surface.blocks.block import Block, Stretch
from assoc_hull.surface.blocks.block_map import GRID, BlockMap, Laid, block_map
from assoc_hull.surface.blocks.block_samples import block_samples
from assoc_hull.surface.blocks.loose_ends import loose_ends, with_loose_ends
from assoc_hull.surface.blocks.plan import block_plans
from assoc_hull.surface.blocks.quad import SIDES
from assoc_hull.surface.cells.sound_cells import sound_cells

__all__ = ["lay_out"]

_TANGENT = 25.0
"""A border that turns by fewer degrees at a corner has its sides tangent there."""


def lay_out(
    net: Net, length: float, leave_out: NDArray[np.bool_] | None = None
) -> tuple[Block, ...]:
    """Part a half hull into blocks and sample their lines.

    Parameters
    ----------
    net : Net
        Curves and crossings.
    length : float, m
        Of the ship.
    leave_out : (m,) bool or None
        Curves to do without.

    Returns
    -------
    tuple of Block
        Masters before those that follow them.

    Raises
    ------
    BadInputError
        The lines bound no half hull, or a part of it is no disc with four corners.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.gather import gather
    >>> from assoc_hull.surface.blocks.layout import lay_out
    >>> hull = ah.examples.series60()
    >>> [block.name for block in lay_out(gather(hull.state), hull.particulars.length)]
    ['body', 'stern counter']
    """
    found = sound_cells(net, leave_out)
    maps = dict[str, BlockMap]()
    for plan in block_plans(found, length):
        maps[plan.name] = block_map(plan, length, maps)
    halves = [half for each in maps.values() for seam in each.plan.seams for half in seam.half]
    cuts = np.array(halves, np.int64) >> 1
    blocks = [_block(each, maps, length, cuts) for each in maps.values()]
    return with_loose_ends(blocks, loose_ends(found.graph, length), GRID * length)


def _block(found: BlockMap, every: dict[str, BlockMap], length: float, cuts: IntArray) -> Block:
    samples, inside = block_samples(found, length, cuts)
    plan, box = found.plan, found.core.box
    place = found.core.quad.region.graph.place
    ends = ((0, 0), (1, 0), (1, 1), (0, 1))
    singular = tuple(
        (float(box[0, i]), float(box[1, j]))
        for (i, j), turn in zip(ends, plan.turns, strict=True)
        if turn < _TANGENT
    )
    return Block(
        plan.name, plan.kind, box.copy(), found.reach, samples, inside,
        {side: _stretches(found, side, every) for side in SIDES},
        _means(found, 0, GRID * length), _means(found, 1, GRID * length),
        place[list(plan.core.corner)], np.array(plan.turns), singular, plan.notes,
    )  # fmt: skip


def _stretches(found: BlockMap, side: str, every: dict[str, BlockMap]) -> tuple[Stretch, ...]:
    """Give the parts of a side: those that follow a block, and those on the centreline."""
    quad, graph = found.core.quad, found.core.quad.region.graph
    master = {half: seam for seam in found.plan.seams if seam.side == side for half in seam.half}
    half = quad.side(side).tolist()
    axis = 1 if side[0] == "u" else 0
    at = found.core.uv[quad.nodes(side), axis]
    keys = [
        (master[h].master if h in master else master[h ^ 1].master if h ^ 1 in master else "",
         bool(graph.net.centre[graph.curve[h >> 1]]))
        for h in half
    ]  # fmt: skip
    parts = []
    begin = 0
    for i in range(1, len(half) + 1):
        if i < len(half) and keys[i] == keys[begin]:
            continue
        name, centre = keys[begin]
        low, high = float(at[begin]), float(at[i])
        if name:
            nodes = quad.nodes(side)[[begin, i]]
            parts.append(_following(every[name].core, low, high, nodes, name))
        else:
            parts.append(Stretch(low, high, centre))
        begin = i
    return tuple(parts)


def _following(master: Laid, low: float, high: float, nodes: IntArray, name: str) -> Stretch:
    """Find the side of a master on which two nodes lie, and where."""
    for side in SIDES:
        own = master.quad.nodes(side).tolist()
        if all(node in own for node in nodes.tolist()):
            at = master.uv[nodes, 1 if side[0] == "u" else 0]
            return Stretch(low, high, False, name, side, float(at[0]), float(at[1]))
    raise AssertionError(name)


def _means(found: BlockMap, axis: int, grid: float) -> FloatArray:
    """Give the mean parameter of each line that runs across an axis, rising, (n,), m."""
    graph, core = found.core.quad.region.graph, found.core
    family = np.array(graph.net.family)
    wanted = family == "sections" if axis == 0 else np.isin(family, ["waterlines", "buttocks"])
    edge = np.flatnonzero(core.quad.region.interior & wanted[graph.curve])
    middle = core.uv[graph.edge[edge], axis].mean(axis=1)
    curves, index = np.unique(graph.curve[edge], return_inverse=True)
    weight = graph.length[edge]
    total = np.bincount(index, weight, len(curves))
    mean = np.bincount(index, weight * middle, len(curves)) / np.maximum(total, 1e-12)
    return np.sort(np.round(mean / grid) * grid)

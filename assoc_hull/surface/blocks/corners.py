"""The four corners of a region: where its border really turns.

Corners at the ends of a section that bounds it come first, then sharp ones of the hull, then the
ends of other cuts, and where a smooth border turns most.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.surface.blocks.outline import Course, course, turns
from assoc_hull.surface.blocks.region import Region

__all__ = ["four_corners"]

_WINDOW = 0.02
_TIP, _SHARP = 0.002, 40.0
"""A border that turns by so many degrees over so small a part of the ship has a corner."""
_EASED = 10.0
"""Over the window of smooth borders it may turn by so many degrees less."""
_ROUND = 1.0
"""A smooth border has none where it turns by fewer degrees over the window."""
_APART = 0.02
"""Corners lie no nearer to one another than this part of the border."""


def four_corners(
    region: Region,
    length: float,
    first: Sequence[int],
    second: Sequence[int] = (),
    never: Sequence[int] = (),
) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """Choose four nodes round a region, counter-clockwise; also give the turns there.

    Parameters
    ----------
    region : Region
        A disc.
    length : float, m
        Of the ship.
    first : sequence of int
        Nodes that are corners whatever the border does.
    second : sequence of int
        Nodes that are if there are too few sharp ones.
    never : sequence of int
        Nodes that are none: the hull runs on there.

    Returns
    -------
    tuple of int
        Nodes, in their order round the region.
    tuple of float, degrees
        By how much the border turns at each.
    """
    found = course(region)
    node = found.node.tolist()
    turn = turns(found, found.start[:-1], min(_WINDOW * length, 0.1 * found.length))
    sharp = turns(found, found.start[:-1], _TIP * length)
    rank = np.array([
        3 if each in first else 1 if each in second else 2 if sharp[i] >= _SHARP <= turn[i] + _EASED else 0
        for i, each in enumerate(node)
    ])  # fmt: skip
    chosen = list[int]()
    rank[np.isin(node, never)] = -1
    order = np.lexsort((np.arange(len(node)), -turn, -rank))
    for i in order[rank[order] > 0].tolist():
        if len(chosen) < 4 and (rank[i] == 3 or _apart(found, i, chosen)):
            chosen.append(i)
    chosen += _smooth(found, np.where(rank == 0, turn, 0.0), chosen)
    chosen.sort()
    return tuple(node[i] for i in chosen), tuple(float(turn[i]) for i in chosen)


def _apart(found: Course, i: int, chosen: Sequence[int]) -> bool:
    """Tell whether a node is far enough round the border from others."""
    gaps = [abs(float(found.start[i] - found.start[j])) for j in chosen]
    return all(min(gap, found.length - gap) >= _APART * found.length for gap in gaps)


def _smooth(found: Course, turn: FloatArray, chosen: Sequence[int]) -> list[int]:
    """Choose the corners that a smooth border lacks: it turns there, and sides stay in proportion."""
    lack = 4 - len(chosen)
    good = [
        i
        for i in range(len(turn))
        if turn[i] >= _ROUND and i not in chosen and _apart(found, i, chosen)
    ]
    best, value = (), 0.0
    for extra in itertools.combinations(good, lack):
        if lack > 1 and not all(_apart(found, i, [j for j in extra if j != i]) for i in extra):
            continue
        where = np.sort(found.start[[*chosen, *extra]])
        side = np.diff(np.append(where, where[0] + found.length))
        shape = min(side[0], side[2]) * min(side[1], side[3]) / (max(side[0], side[2]) * max(side[1], side[3]))
        worth = float(np.prod(turn[list(extra)]) * shape)
        if worth > value:
            best, value = extra, worth
    return list(best)

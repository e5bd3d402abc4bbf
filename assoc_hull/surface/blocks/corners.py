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
"""Over a larger part it may turn by so many degrees less."""
_ROUND = 1.0
"""A smooth border has none where it turns by fewer degrees over the window."""
_APART, _BESIDE = 0.02, 0.003
"""Corners lie no nearer to one another than this part of the border, nor, than the other, to where
the hull runs on."""


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
        Nodes that are none, nor any near them: the hull runs on there.

    Returns
    -------
    tuple of int
        Nodes, in their order round the region.
    tuple of float, degrees
        By how much the border turns at each, over a short way: little at those of round borders.
    """
    found = course(region)
    node = found.node.tolist()
    normal = region.graph.normal[found.node]
    window = min(_WINDOW * length, 0.1 * found.length)
    turn = turns(found, found.start[:-1], window, normal)
    sharp = turns(found, found.start[:-1], _TIP * length, normal)
    rank = np.where((sharp >= _SHARP) & (turn >= _SHARP - _EASED), 2, 0)
    rank[[not _apart(found, i, _at(node, never), _BESIDE) for i in range(len(node))]] = -1
    rank[np.isin(node, second)] = 1
    rank[np.isin(node, first)] = 3
    chosen = np.flatnonzero(rank == 3).tolist()
    for level in (2, 1, 0):
        chosen += _best(found, turn, np.flatnonzero(rank == level).tolist(), chosen)
    chosen.sort()
    return tuple(node[i] for i in chosen), tuple(float(sharp[i]) for i in chosen)


def _at(node: Sequence[int], which: Sequence[int]) -> list[int]:
    return [i for i, each in enumerate(node) if each in which]


def _apart(found: Course, i: int, chosen: Sequence[int], part: float = _APART) -> bool:
    """Tell whether a node is a part of the border away from others."""
    gaps = [abs(float(found.start[i] - found.start[j])) for j in chosen]
    return all(min(gap, found.length - gap) >= part * found.length for gap in gaps)


def _best(found: Course, turn: FloatArray, of: Sequence[int], chosen: Sequence[int]) -> list[int]:
    """Choose from nodes the corners that lack: they turn most, and sides stay in proportion."""
    lack = 4 - len(chosen)
    good = [i for i in of if turn[i] >= _ROUND and _apart(found, i, chosen)]
    if len(good) <= lack:
        return good
    best, value = tuple[int, ...](), 0.0
    for extra in itertools.combinations(good, lack):
        apart = (_apart(found, i, extra[:k]) for k, i in enumerate(extra))
        worth = float(np.prod(turn[list(extra)])) * _shape(found, [*chosen, *extra])
        if worth > value and all(apart):
            best, value = extra, worth
    return list(best)


def _shape(found: Course, corner: Sequence[int]) -> float:
    """Give how alike opposite sides are, 1 for a rectangle."""
    where = np.sort(found.start[list(corner)])
    side = np.diff(np.append(where, where[0] + found.length))
    pairs = ((side[0], side[2]), (side[1], side[3]))
    return float(np.prod([min(pair) / max(pair) for pair in pairs]))

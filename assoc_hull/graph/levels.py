"""Levels of a directed graph by longest path, and the ring that forbids them.

Examples
--------
>>> from assoc_hull.graph.levels import levels
>>> levels(4, [0, 1, 0], [1, 2, 2], str).tolist()
[0, 1, 2, 0]
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import RingError
from assoc_hull.geometry.curves import IntArray

__all__ = ["find_ring", "levels"]


def levels(
    count: int, source: ArrayLike, reader: ArrayLike, name: Callable[[int], str]
) -> IntArray:
    """Give each node the length of the longest path that leads to it.

    Parameters
    ----------
    count : int
        Number of nodes.
    source, reader : (e,) int
        The edges: `reader[i]` is made from `source[i]`.
    name : callable
        Names a node, for the error.

    Returns
    -------
    (count,) int
        0 for a node that reads nothing. Kahn's algorithm, one level a round.

    Raises
    ------
    RingError
        With the path of a ring, beginning at its lowest node.
    """
    edges = np.unique(np.column_stack([source, reader]).astype(np.int64).reshape(-1, 2), axis=0)
    tails, heads = edges[:, 0], edges[:, 1]
    level = np.zeros(count, np.int64)
    waiting = np.bincount(heads, minlength=count)
    ready = np.flatnonzero(waiting == 0)
    first = np.searchsorted(tails, np.arange(count + 1))
    done = 0
    while len(ready):
        done += len(ready)
        spans = [np.arange(first[node], first[node + 1]) for node in ready]
        out = np.concatenate(spans) if spans else np.zeros(0, np.int64)
        np.maximum.at(level, heads[out], level[tails[out]] + 1)
        freed, times = np.unique(heads[out], return_counts=True)
        waiting[freed] -= times
        ready = freed[waiting[freed] == 0]
    if done < count:
        stuck = waiting > 0
        raise RingError(tuple(name(node) for node in find_ring(tails, heads, stuck)))
    return level


def find_ring(tails: IntArray, heads: IntArray, stuck: np.typing.NDArray[np.bool_]) -> list[int]:
    """Walk backward among the stuck nodes, lowest first, until one comes again."""
    inside = stuck[tails] & stuck[heads]
    before: dict[int, int] = {}
    for tail, head in zip(tails[inside].tolist(), heads[inside].tolist(), strict=True):
        before[head] = min(tail, before.get(head, tail))
    node = min(before)
    walk: list[int] = []
    while node not in walk:
        walk.append(node)
        node = before[node]
    ring = walk[walk.index(node) :][::-1]
    turn = ring.index(min(ring))
    ring = ring[turn:] + ring[:turn]
    return [*ring, ring[0]]

"""Two edges between the same two nodes: lines that lie on one another, or nearly meet."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.surface.cells.edge_points import Pieces

__all__ = ["Lenses", "find_lenses"]

_SHORT = 2e-4
"""Nodes so near (lengths of the hull) that two lines connect are one: three lines pass there."""
_THIN = 1e-5
"""Pieces of lines nowhere farther apart (lengths of the hull) lie on one another."""

_PARTS = np.linspace(0.0, 1.0, 9)


@attrs.frozen(eq=False)
class Lenses:
    """What is to be done about pairs of edges.

    Attributes
    ----------
    unite : (k, 2) int
        Nodes that are one.
    drop : (d,) int
        Edges that lie on another, and on themselves.
    """

    unite: IntArray
    drop: IntArray


def find_lenses(edge: IntArray, rank: IntArray, pieces: Pieces, length: float) -> Lenses:
    """Find pairs of edges that are one.

    Parameters
    ----------
    edge : (e, 2) int
        The nodes at the ends of the edges.
    rank : (e,) int
        Of two edges that lie on one another that of the lower rank stays.
    pieces : Pieces
        The edges as pieces of curves.
    length : float, m
        Of the hull.
    """
    first, second = _pairs(edge, rank)
    short = np.maximum(pieces.length[first], pieces.length[second]) <= _SHORT * length
    rings = np.flatnonzero(edge[:, 0] == edge[:, 1])
    rest = np.flatnonzero(~short)
    own, other = _same_way(edge, pieces, first[rest], second[rest])
    away = np.sqrt(dot(own - other, own - other)).max(axis=1, initial=0.0)
    thin = second[rest][away <= _THIN * length]
    return Lenses(edge[first[short]], np.union1d(rings, thin))


def _pairs(edge: IntArray, rank: IntArray) -> tuple[IntArray, IntArray]:
    """Give pairs of edges between the same nodes, that of the lower rank first."""
    low, high = np.sort(edge, axis=1).T
    order = np.lexsort((rank, high, low))
    ends = np.column_stack([low, high])[order]
    at = np.flatnonzero((ends[1:] == ends[:-1]).all(axis=1) & (ends[1:, 0] != ends[1:, 1]))
    return order[at], order[at + 1]


def _same_way(
    edge: IntArray, pieces: Pieces, first: IntArray, second: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Give points along both of each pair, from the same node on."""
    own, other = (pieces.chosen(each).points(_PARTS) for each in (first, second))
    turned = edge[first, 0] != edge[second, 0]
    other[turned] = other[turned, ::-1]
    return own, other

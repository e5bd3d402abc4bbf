"""The parts of curves across a hull that lie below a plane, exactly cut."""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves, freeze
from assoc_hull.geometry.numeric.polynomials import horner, unit_roots
from assoc_hull.geometry.splines.arc_length import CubicChains
from assoc_hull.geometry.splines.paths import restrict_cubics

__all__ = ["WetRuns", "wet_runs"]

_ON = 1e-9
"""What lies so near to the plane (m) lies on it."""

_SLIVER = 1e-13
"""Shorter parts of a tile are none."""


@attrs.frozen(eq=False)
class WetRuns:
    """Runs of curves below a plane.

    Attributes
    ----------
    curve : (r,) int
        The curve of each run; the runs of one curve follow one another from keel to deck.
    bottom, top : (r,) bool
        The run begins with its curve, ends with it; else it begins or ends on the plane.
    chains : CubicChains
        The runs themselves.
    deck : (s,) bool
        The cubic is closed deck.
    """

    curve: IntArray
    bottom: NDArray[np.bool_]
    top: NDArray[np.bool_]
    chains: CubicChains
    deck: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.bottom, self.top, self.deck)

    @cached_property
    def knuckle(self) -> FloatArray:
        """By how much each run turns where a cubic begins, (s,), degrees; 0 at its beginning."""
        cubic, start = self.chains.cubic, self.chains.start
        arrive = cubic[:, 1] + 2.0 * cubic[:, 2] + 3.0 * cubic[:, 3]
        into, out = arrive[:-1], cubic[1:, 1]
        size = np.sqrt((into**2).sum(axis=1) * (out**2).sum(axis=1))
        cosine = np.divide((into * out).sum(axis=1), size, out=np.ones(len(size)), where=size > 0.0)
        turn = np.zeros(len(cubic))
        turn[1:] = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
        turn[start[:-1]] = 0.0
        return turn


def wet_runs(curves: IsoCurves, height: float, tan_trim: float, tan_heel: float) -> WetRuns:
    """Cut curves at a plane, and keep what lies below it.

    Parameters
    ----------
    curves : IsoCurves
        The curves.
    height, tan_trim, tan_heel : float
        The plane ``z = height + tan_trim x - tan_heel y``, m.

    Returns
    -------
    WetRuns
        In the order of the curves, from keel to deck.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import IsoCurves
    >>> from assoc_hull.geometry.floating.wetted_curves import wet_runs
    >>> wedge = np.zeros((1, 4, 3))
    >>> wedge[0, 1] = [0.0, 2.0, 4.0]
    >>> curves = IsoCurves(np.array([0, 1]), wedge, np.zeros((1, 4, 3)), np.array([False]))
    >>> wet_runs(curves, 1.0, 0.0, 0.0).chains.ends[1].tolist()
    [[0.0, 0.5, 1.0]]
    """
    x, y, z = (curves.point[:, :, axis] for axis in range(3))
    over = z - tan_trim * x + tan_heel * y
    over[:, 0] -= height
    edge = np.zeros((len(over), 5))
    edge[:, 1:4], edge[:, 4] = np.sort(unit_roots(over), axis=1), 1.0
    tile, part = np.nonzero(np.diff(edge, axis=1) > _SLIVER)
    low, high = edge[tile, part], edge[tile, part + 1]
    depth = horner(over, 0.5 * (edge[:, 1:] + edge[:, :-1]))[tile, part]
    owner = np.arange(curves.count).repeat(np.diff(curves.start))[tile]
    first, last = _runs(owner, depth <= _ON)
    deepest = np.minimum.reduceat(depth, first) if len(first) else np.zeros(0)
    kept = (depth[first] <= _ON) & (deepest < -_ON)
    first, last = first[kept], last[kept]
    new = np.append(True, np.diff(owner) != 0)
    bottom, top = new[first], np.append(new[1:], True)[last]
    chains, which = _chains(curves, tile, low, high, first, last)
    return WetRuns(owner[first], bottom, top, chains, curves.deck[which])


def _runs(owner: IntArray, wet: NDArray[np.bool_]) -> tuple[IntArray, IntArray]:
    """Give the first and last parts of runs that belong to one curve and are all wet, or dry."""
    if not len(owner):
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    first = np.flatnonzero(np.append(True, (np.diff(owner) != 0) | (wet[1:] != wet[:-1])))
    return first, np.append(first[1:], len(owner)) - 1


def _chains(
    curves: IsoCurves,
    tile: IntArray,
    low: FloatArray,
    high: FloatArray,
    first: IntArray,
    last: IntArray,
) -> tuple[CubicChains, IntArray]:
    """Put the runs together; also give the tile of each of their cubics."""
    size = tile[last] - tile[first] + 1
    start = np.append(0, np.cumsum(size)).astype(np.int64)
    run = np.arange(len(first)).repeat(size)
    which = tile[first][run] + np.arange(len(run)) - start[:-1][run]
    begin, finish = np.zeros(len(run)), np.ones(len(run))
    begin[start[:-1]] = low[first]
    finish[start[1:] - 1] = high[last]
    return CubicChains(start, restrict_cubics(curves.point[which], begin, finish)), which

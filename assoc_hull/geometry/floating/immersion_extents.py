"""How far a waterplane reaches: the extents of the cuts, and its breadth between curves.

The greatest half breadth usually lies between two of the curves that are integrated. There
the cubic through both cuts, with the slopes of the waterline at them, is taken: its error
goes with the fourth power of the distance of the curves.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion_roots import Tilted
from assoc_hull.geometry.floating.tiles import Tiles, powers
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.geometry.numeric.generic_sums import root

__all__ = ["Places", "extent", "slopes", "waterline_rate", "wider", "widest"]

_FLAT = 1e-12  # of a slope: less is rounding
_TIE = 1e-9  # m: cuts of one point on two strips are as far out as each other


@attrs.frozen(eq=False)
class Places:
    """Cuts of curves by d planes, all (k,) but `most`.

    Attributes
    ----------
    plane, tile : int
        Which plane cuts which tile,
    u : from 0 to 1
        and where on it.
    y : m
        Half breadth there.
    most : (d,), m
        The greatest half breadth of each plane, plain.
    """

    plane: IntArray
    tile: IntArray
    u: FloatArray
    y: FloatArray
    most: FloatArray


def extent(x: FloatArray, y: FloatArray, plane: IntArray, count: int) -> FloatArray:
    """Give the extents of points.

    Parameters
    ----------
    x, y : (k,), m
        The points.
    plane : (k,) int
        The plane of each, from 0 to count - 1.
    count : int
        Number of planes.

    Returns
    -------
    (4, count), m
        Least and greatest x, least and greatest y; infinite where there is no point.
    """
    rows = [-most_of(-x, plane, count), most_of(x, plane, count)]
    return np.stack([*rows, -most_of(-y, plane, count), most_of(y, plane, count)])


def wider(one: FloatArray, other: FloatArray) -> FloatArray:
    """Join extents (4, d)."""
    sign = np.array([[-1.0], [1.0], [-1.0], [1.0]])
    joined: FloatArray = np.where(real(one) * sign >= real(other) * sign, one, other)
    return joined


def slopes(point: FloatArray, u: FloatArray) -> FloatArray:
    """Give P_u of cubics (3, 4, k) at one place each, (3, k)."""
    slope: FloatArray = point[:, 1] + u * (2.0 * point[:, 2] + u * (3.0 * point[:, 3]))
    return slope


def waterline_rate(tilted: Tilted, slope: FloatArray, across: FloatArray) -> FloatArray:
    """Give -du/dv along the waterline, q_v / q_u, of P_u and P_v (3, k).

    It is nil where the plane touches the curve, as nothing passes there.
    """
    steep = slope[2] - tilted.trim * slope[0] + tilted.heel * slope[1]
    climb = across[2] - tilted.trim * across[0] + tilted.heel * across[1]
    flat = np.abs(real(steep)) <= _FLAT * np.abs(real(slope)).sum(axis=0)
    rate: FloatArray = np.where(flat, 0.0, climb / np.where(flat, 1.0, steep))
    return rate


def widest(
    tiles: Tiles, tilted: Tilted, cuts: Places, v: FloatArray, strip: IntArray
) -> FloatArray:
    """Give the greatest half breadths between curves, where they are greater than at curves.

    Parameters
    ----------
    tiles, tilted : Tiles, Tilted
        The curves.
    cuts : Places
        All cuts of these curves.
    v, strip : (c,)
        Where each curve lies.

    Returns
    -------
    (d,), m
        Half breadths; minus infinity where there is none between curves.
    """
    times, where = _table(tiles, cuts)
    outer = np.flatnonzero(real(cuts.y) >= cuts.most[cuts.plane] - _TIE)
    rate = _rate(tiles, tilted, cuts, outer)
    curve = tiles.curve[cuts.tile[outer]]
    beside = np.clip(curve + np.where(real(rate) > 0.0, 1, -1), 0, tiles.curves - 1)
    row = cuts.plane[outer]
    fit = (strip[beside] == strip[curve]) & (times[row, beside] == 1) & (times[row, curve] == 1)
    fit = np.flatnonzero(fit)
    beside, outer = beside[fit], outer[fit]
    other, length = where[row[fit], beside], v[beside] - v[curve[fit]]
    out, into = np.take(rate, fit) * length, _rate(tiles, tilted, cuts, other) * length
    best = _summit(np.take(cuts.y, outer), np.take(cuts.y, other), out, into)
    return most_of(best, cuts.plane[outer], len(cuts.most))


def _table(tiles: Tiles, cuts: Places) -> tuple[IntArray, IntArray]:
    """Say for planes and curves how often they are cut, and which cut is the last."""
    planes = len(cuts.most)
    key = cuts.plane * tiles.curves + tiles.curve[cuts.tile]
    times = np.bincount(key, minlength=planes * tiles.curves)
    where = np.zeros(planes * tiles.curves, np.int64)
    where[key] = np.arange(len(key))
    return times.reshape(planes, -1), where.reshape(planes, -1)


def _rate(tiles: Tiles, tilted: Tilted, cuts: Places, rows: IntArray) -> FloatArray:
    """Give dy/dv along the waterline at some cuts."""
    u = np.take(cuts.u, rows)
    coefficients = np.take(tiles.coefficients, cuts.tile[rows], axis=2)
    slope, across = slopes(coefficients[:3], u), (coefficients[3:] * powers(u)).sum(axis=1)
    rate: FloatArray = across[1] - slope[1] * waterline_rate(tilted, slope, across)
    return rate


def _summit(begin: FloatArray, end: FloatArray, out: FloatArray, into: FloatArray) -> FloatArray:
    """Give the first greatest value of cubics from 0 to 1 that begin upward."""
    rise = end - begin
    second, third = 3.0 * rise - 2.0 * out - into, out + into - 2.0 * rise
    under = second * second - 3.0 * third * out
    below = root(np.where(real(under) > 0.0, under, 0.0)) - second
    some = real(below) > 0.0
    t = np.where(some, out / np.where(some, below, 1.0), 0.0)
    t = np.where(real(t) < 1.0, t, 0.0)
    summit: FloatArray = begin + t * (out + t * (second + t * third))
    return summit


def most_of(values: FloatArray, plane: IntArray, count: int) -> FloatArray:
    """Give the greatest value of each plane, minus infinity where there is none."""
    most = np.full(count, -np.inf)
    if is_plain(values):
        if count == 1:
            most[0] = values.max(initial=-np.inf)
        else:
            np.maximum.at(most, plane, values)
        return most
    if not len(plane):
        return most
    order = np.lexsort((real(values), plane))
    last = np.searchsorted(plane[order], np.arange(count), "right") - 1
    some = np.bincount(plane, minlength=count) > 0
    return np.where(some, np.take(values, order[np.maximum(last, 0)]), most)

"""Strips in which something happens below a plane: where, and how finely to integrate.

From one curve of a strip to the next the immersed part may change its kind: the keel comes
out of the water, the deck edge goes under, a piece appears, the waterline passes a knuckle.
The place along v is found by bisection, and either side of it gets a rule of its own.

A strip in which nothing happens *yet* counts too, in part: as such a place leaves the strip
through an end, the share of the fine rule falls from one to nil over the next strip's worth
of change. So every integral changes continuously with the plane.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.bernstein import stationary, value
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.immersion_places import CLOSE, Brackets, places
from assoc_hull.geometry.immersion_roots import Tilted, tilt
from assoc_hull.geometry.immersion_strips import Prepared
from assoc_hull.geometry.immersion_tiles import Tiles
from assoc_hull.geometry.quadrature import bunched
from assoc_hull.geometry.tile_sums import real

__all__ = ["Parts", "parts_of"]


@attrs.frozen(eq=False)
class Parts:
    """Curves of the fine rule, and those of the plain rule whose place they take.

    Attributes
    ----------
    plane, strip : (n,) int
        For which plane, across which strip.
    v, weight : (n,)
        Where, and the share in the integrals; nil for curves that only tell extents.
    instead, replaced : (m,) int
        For which plane, which curve of the plain rule.
    share : (m,)
        How much of it is replaced.
    """

    plane: IntArray
    strip: IntArray
    v: FloatArray
    weight: FloatArray
    instead: IntArray
    replaced: IntArray
    share: FloatArray


def parts_of(
    prepared: Prepared, trim: FloatArray, heel: FloatArray, levels: FloatArray, state: IntArray
) -> Parts | None:
    """Find the strips in which something happens, and rules for them.

    Parameters
    ----------
    prepared : Prepared
        The body.
    trim, heel : (1,)
        Inclination of the planes.
    levels : (d,), m
        Their heights.
    state : (d, k) int
        What `states` says of the curves of the plain rule.

    Returns
    -------
    Parts or None
        None if nothing happens anywhere.
    """
    changed = (state[:, 1:] != state[:, :-1]) & (prepared.strip[1:] == prepared.strip[:-1])
    plane, curve = np.nonzero(changed)
    at, share = _near(prepared, trim, heel, levels)
    count = prepared.strips.count
    key = plane * count + prepared.strip[curve]
    keys = np.unique(np.concatenate([key, at]))
    if not len(keys):
        return None
    found = places(
        prepared.strips, real(trim), real(heel), _brackets(prepared, levels, state, plane, curve)
    )
    return _rules(prepared, keys, _shares(keys, key, at, share), found)


def _brackets(
    prepared: Prepared, levels: FloatArray, state: IntArray, plane: IntArray, curve: IntArray
) -> Brackets:
    """Bracket the changes of state between neighbouring curves."""
    strip = prepared.strip[curve]
    return Brackets(
        row=plane * prepared.strips.count + strip,
        strip=strip,
        level=real(levels)[plane],
        low=prepared.v[curve],
        high=prepared.v[curve + 1],
        below=state[plane, curve],
        above=state[plane, curve + 1],
    )


def _shares(keys: IntArray, happens: IntArray, near: IntArray, share: FloatArray) -> FloatArray:
    """Give the share of the fine rule for each pair of a plane and a strip."""
    ones = np.ones(len(keys))
    if not len(near):
        return ones
    row = np.minimum(np.searchsorted(near, keys), len(near) - 1)
    within = np.isin(keys, happens)
    return np.where(within, ones, np.take(share, row))


def _rules(prepared: Prepared, keys: IntArray, shares: FloatArray, found: Brackets) -> Parts:
    """Lay the fine rule between all places of one strip and plane."""
    count = prepared.strips.count
    ends, at_end = np.concatenate([found.low, found.high]), np.concatenate([found.row, found.row])
    edge = np.concatenate([np.zeros(len(keys)), np.ones(len(keys)), ends])
    owner = np.concatenate([keys, keys, at_end])
    order = np.lexsort((edge, owner))
    edge, owner = edge[order], owner[order]
    inside = np.flatnonzero((owner[1:] == owner[:-1]) & (edge[1:] > edge[:-1] + 4.0 * CLOSE))
    begin, length, of = edge[inside], edge[inside + 1] - edge[inside], owner[inside]
    v, weight, whose = [], [], []
    points = prepared.fine[of % count]
    for number in np.unique(points):
        some = np.flatnonzero(points == number)
        nodes, weights = bunched(int(number))
        v.append((begin[some, None] + length[some, None] * nodes).ravel())
        weight.append((length[some, None] * weights).ravel())
        whose.append(np.repeat(of[some], number))
    # The places themselves have no share, but there a waterplane may end.
    v, weight, whose = [*v, ends], [*weight, 0.0 * ends], [*whose, at_end]
    line = np.concatenate(whose)
    row = np.searchsorted(keys, line)
    first = np.searchsorted(prepared.strip, keys % count)
    sizes = np.searchsorted(prepared.strip, keys % count, "right") - first
    again = np.repeat(np.arange(len(keys)), sizes)
    within = np.arange(len(again)) - (np.cumsum(sizes) - sizes)[again]
    return Parts(
        plane=line // count,
        strip=line % count,
        v=np.concatenate(v),
        weight=np.concatenate(weight) * np.take(shares, row),
        instead=(keys // count)[again],
        replaced=first[again] + within,
        share=np.take(shares, again),
    )


def _near(
    prepared: Prepared, trim: FloatArray, heel: FloatArray, levels: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Find strips into which something may come soon: plane and strip as one key, the share."""
    strip, tiles = prepared.ends
    tilted = tilt(tiles, trim, heel)
    tile, u = _critical(tiles, tilted)
    origin, first, second, third = np.take(tilted.height, tile, axis=1)
    height = value(origin, first, second, third, u)
    across = np.take(tiles.coefficients[3:], tile, axis=2)
    x_v, y_v, z_v = value(across[:, 0], across[:, 1], across[:, 2], across[:, 3], u)
    change = z_v - trim * x_v + heel * y_v
    far = np.abs(real(height) - real(levels)[:, None])
    plane, point = np.nonzero(far < np.abs(real(change)))
    key = plane * prepared.strips.count + strip[tiles.curve[tile[point]]]
    gap, most = levels[plane] - height[point], change[point]
    part = 1.0 - gap * gap / (most * most)
    order = np.lexsort((real(part), key))
    order = order[np.append(key[order][1:] != key[order][:-1], True)] if len(order) else order
    part = np.take(part, order)
    return key[order], part * part * (3.0 - 2.0 * part)


def _critical(tiles: Tiles, tilted: Tilted) -> tuple[IntArray, FloatArray]:
    """Give the places of curves where a piece may appear: ends, knuckles, turning points."""
    step = tilted.control[1:] - tilted.control[:-1]
    first, last = tiles.start[:-1], tiles.start[1:] - 1
    turn = np.flatnonzero(
        (step[2, :-1] * step[0, 1:] < 0.0) & (tiles.curve[1:] == tiles.curve[:-1])
    )
    wavy = np.flatnonzero(~((step >= 0.0).all(axis=0) | (step <= 0.0).all(axis=0)))
    lower, upper = stationary(*real(tilted.height)[1:, wavy])
    low, high = lower > 0.0, upper < 1.0
    tile = np.concatenate([first, last, tiles.knuckle, turn + 1, wavy[low], wavy[high]])
    none = np.zeros(len(first) + len(tiles.knuckle) + len(turn))
    u = [none[: len(first)], none[: len(last)] + 1.0, none[len(first) :], lower[low], upper[high]]
    return tile, np.concatenate(u)

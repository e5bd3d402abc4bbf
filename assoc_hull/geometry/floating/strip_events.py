"""Strips in which something happens below a plane: where, and how finely to integrate.

From one curve of a strip to the next the immersed part may change its kind: the keel comes out of
the water, the deck edge goes under, a piece appears. Either side of such a place gets a rule of
its own. As a place leaves the strip through an end, the share of the fine rule falls from one to
zero over the next strip's worth of change: so every integral changes continuously with the plane.
Places are found among plain numbers and given their derivatives afterwards.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, Strips
from assoc_hull.geometry.floating.immersed_strips import (
    DECK,
    KEEL,
    LEVEL,
    Inclination,
    PreparedStrips,
    StateBrackets,
    cut_counts,
    find_state_changes,
    join_brackets,
    rounding_flickers,
    strip_states,
)
from assoc_hull.geometry.floating.tiles import (
    CriticalPoints,
    CurveTiles,
    TiltedTiles,
    critical_points_at,
    find_critical_points,
    nearest_critical_point,
    tiles_of_curves,
    tilt_tiles,
)
from assoc_hull.geometry.floating.waterplane_cuts import point_extents
from assoc_hull.geometry.numeric.dual import is_plain, real, safe_sqrt
from assoc_hull.geometry.numeric.quadrature import bunched_rule

__all__ = [
    "RefinedCurves",
    "differentiate_brackets",
    "refine_strips",
    "waterplane_tips",
]

# --------------------------------------------------------------------------------------
# Derivatives of places along strips, which are found among plain numbers.
#
# The point that passes the plane there has the height q(v) over planes of the inclination, so a
# change of q - level moves the place by -1/q_v times that.

STILL = 1e-9
"""m along a whole strip: what rises less lies level, and has no place to move to."""

_NEAR = 1e-7
"""m: if no point is so near to the plane, none passes it: a knuckle begins or ends there, or
two pieces of a section join. The integrands go on smoothly there."""


def differentiate_brackets(
    prepared: PreparedStrips, tilted: TiltedTiles, levels: FloatArray, found: StateBrackets
) -> StateBrackets:
    """Carry derivatives through places that were found among plain numbers.

    `found.row` is the plane times the number of strips, plus the strip; levels are (d,), m. Only
    `low` and `high` change, into the arithmetic that results; all stays as it is if that is plain.
    """
    numbers = (prepared.tiles.coefficients, levels, tilted.trim, tilted.heel)
    if not len(found) or all(map(is_plain, numbers)):
        return found
    strips = prepared.strips
    tiles = tiles_of_curves(strips.curves(found.strip, 0.5 * (found.low + found.high)))
    height, change = _passing_points(tiles, tilt_tiles(tiles, tilted.trim, tilted.heel), found)
    over = height - np.take(levels, found.row // strips.count)
    passes = (np.abs(real(change)) > STILL) & (np.abs(real(over)) < _NEAR)
    # The value of `over` is rounding: only its derivative moves the place.
    move = np.where(passes, (real(over) - over) / np.where(passes, real(change), 1.0), 0.0)
    return attrs.evolve(found, low=found.low + move, high=found.high + move)


def _passing_points(
    tiles: CurveTiles, tilted: TiltedTiles, found: StateBrackets
) -> tuple[FloatArray, FloatArray]:
    """Give height and q_v of the point of each curve that passes the plane."""
    kind = found.below ^ found.above
    points = find_critical_points(tiles, tilted)
    inner = nearest_critical_point(points, found.level, tiles.curves)
    height, change = np.take(points.height, inner), np.take(points.change, inner)
    for bit, tile, u in ((DECK, tiles.start[1:] - 1, 1.0), (KEEL, tiles.start[:-1], 0.0)):
        end = critical_points_at(tiles, tilted, tile, np.full(tiles.curves, u))
        chosen = (kind & bit) > 0
        height = np.where(chosen, end.height, height)
        change = np.where(chosen, end.change, change)
    return height, change


# --------------------------------------------------------------------------------------
# Strips in which something happens, and their rules.

LADDER = 7  # curves, ever closer to the end of a strip
# Of a strip's depth: the least change of height over which the share of the fine rule goes from
# one to zero. Both rules differ, so a sudden change would be an error of the derivative.
REACH = 0.02


@attrs.frozen(eq=False)
class NearbyCriticalPoints:
    """Critical points at the ends of strips that are close to planes, all (n,).

    Attributes
    ----------
    plane, curve : int
        Which plane, and which curve of the plain rule.
    share : from 0 to 1
        How much of the fine rule the strip takes because of it.
    nearer : bool
        Into the strip, the point comes nearer to the plane.
    """

    plane: IntArray
    curve: IntArray
    share: FloatArray
    nearer: NDArray[np.bool_]


@attrs.frozen(eq=False)
class RefinedCurves:
    """Curves of the fine rule, and those of the plain rule whose place they take.

    Attributes
    ----------
    plane, strip : (n,) int
        For which plane, across which strip.
    v, weight : (n,)
        Where, and the share in the integrals.
    instead, replaced : (m,) int
        For which plane, which curve of the plain rule.
    share : (m,)
        How much of it is replaced.
    places : StateBrackets
        Where the immersed part changes its kind.
    """

    plane: IntArray
    strip: IntArray
    v: FloatArray
    weight: FloatArray
    instead: IntArray
    replaced: IntArray
    share: FloatArray
    places: StateBrackets


def refine_strips(
    prepared: PreparedStrips, tilted: TiltedTiles, levels: FloatArray, state: IntArray
) -> RefinedCurves | None:
    """Find the strips in which something happens, and rules for them; None if nothing does.

    Levels are (d,), m; state is (d, k), from `curve_states`, of the curves of the plain rule.
    """
    soon = _nearby_critical_points(prepared, tilted, levels)
    plane, curve = _changes(prepared, tilted, real(levels), state)
    if not len(plane) and not len(soon.plane):
        return None
    inclination = real(tilted.trim), real(tilted.heel)
    brackets = join_brackets(
        _brackets(prepared, levels, state, plane, curve),
        _hidden_pieces(prepared, inclination, levels, state, soon),
    )
    found = find_state_changes(prepared.plain, inclination, brackets)
    found = differentiate_brackets(prepared, tilted, levels, found)
    near = soon.plane * prepared.strips.count + prepared.strip[soon.curve]
    keys, row = np.unique(np.concatenate([found.row, near]), return_inverse=True)
    shares = _greatest_shares(soon.share, row[len(found) :], len(keys))
    known = np.isin(keys, found.row)
    return _rules(prepared, keys, np.where(known, 1.0, shares), found)


def _changes(
    prepared: PreparedStrips, tilted: TiltedTiles, levels: FloatArray, state: IntArray
) -> tuple[IntArray, IntArray]:
    """Find planes and curves after which the state changes, and not only by rounding."""
    changed = (state[:, 1:] != state[:, :-1]) & (prepared.strip[1:] == prepared.strip[:-1])
    plane, curve = np.nonzero(changed)
    if not len(plane):
        return plane, curve
    least = LEVEL * prepared.depth[prepared.strip[curve]]
    change = state[plane, curve] ^ state[plane, curve + 1]
    pair = np.stack([curve, curve + 1])
    real_ones = ~rounding_flickers(prepared.tiles, tilted, pair, levels[plane], change, least)
    return plane[real_ones], curve[real_ones]


def _brackets(
    prepared: PreparedStrips, levels: FloatArray, state: IntArray, plane: IntArray, curve: IntArray
) -> StateBrackets:
    """Bracket the changes of state between neighbouring curves."""
    strip = prepared.strip[curve]
    return StateBrackets(
        row=plane * prepared.strips.count + strip,
        strip=strip,
        level=real(levels)[plane],
        low=prepared.v[curve],
        high=prepared.v[curve + 1],
        below=state[plane, curve],
        above=state[plane, curve + 1],
    )


def _greatest_shares(share: FloatArray, row: IntArray, count: int) -> FloatArray:
    """Give the greatest share of each row, zero where there is none."""
    if not len(row):
        return np.zeros(count)
    order = np.lexsort((real(share), row))
    last = np.searchsorted(row[order], np.arange(count), "right") - 1
    some = np.bincount(row, minlength=count) > 0
    return np.where(some, np.take(share, order[np.maximum(last, 0)]), 0.0)


def _rules(
    prepared: PreparedStrips, keys: IntArray, shares: FloatArray, found: StateBrackets
) -> RefinedCurves:
    """Lay the fine rule between all places of one strip and plane."""
    count = prepared.strips.count
    v, weight, owner = _fine_points(prepared, keys, found)
    first = np.searchsorted(prepared.strip, keys % count)
    sizes = np.searchsorted(prepared.strip, keys % count, "right") - first
    again = np.repeat(np.arange(len(keys)), sizes)
    within = np.arange(len(again)) - (np.cumsum(sizes) - sizes)[again]
    return RefinedCurves(
        plane=owner // count,
        strip=owner % count,
        v=v,
        weight=weight * np.take(shares, np.searchsorted(keys, owner)),
        instead=(keys // count)[again],
        replaced=first[again] + within,
        share=np.take(shares, again),
        places=found,
    )


def _fine_points(
    prepared: PreparedStrips, keys: IntArray, found: StateBrackets
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Give places along v, their weights, and the keys to which they belong."""
    begin, length, owner = _intervals(keys, found)
    points = prepared.fine[owner % prepared.strips.count]
    v, weight, whose = [np.zeros(0)], [np.zeros(0)], [np.zeros(0, np.int64)]
    for number in np.unique(points):
        some = np.flatnonzero(points == number)
        nodes, weights = bunched_rule(int(number))
        v.append((begin[some, None] + length[some, None] * nodes).ravel())
        weight.append((length[some, None] * weights).ravel())
        whose.append(np.repeat(owner[some], number))
    return np.concatenate(v), np.concatenate(weight), np.concatenate(whose)


def _intervals(keys: IntArray, found: StateBrackets) -> tuple[FloatArray, FloatArray, IntArray]:
    """Give begin and length of what lies between the places, and its key; nothing that is dry."""
    none = np.full(len(keys), -1)
    edge = np.concatenate([np.zeros(len(keys)), 0.5 * (found.low + found.high), np.ones(len(keys))])
    owner = np.concatenate([keys, found.row, keys])
    order = np.lexsort((real(edge), owner))
    edge, owner = edge[order], owner[order]
    after = np.concatenate([none, found.above, none])[order][:-1]
    before = np.concatenate([none, found.below, none])[order][1:]
    wet = np.where(after >= 0, after, before) != 0
    inside = np.flatnonzero((owner[1:] == owner[:-1]) & wet & (np.diff(real(edge)) > 0.0))
    return edge[inside], edge[inside + 1] - edge[inside], owner[inside]


def _nearby_critical_points(
    prepared: PreparedStrips, tilted: TiltedTiles, levels: FloatArray
) -> NearbyCriticalPoints:
    """Find critical points at the ends of strips that a strip's worth of change may wet or dry."""
    ends = prepared.critical(tilted)
    over = real(ends.height) - real(levels)[:, None]
    depth = prepared.depth[prepared.strip[ends.curve]]
    reach = safe_sqrt(ends.change * ends.change + (REACH * depth) ** 2)
    plane, point = np.nonzero(np.abs(over) < real(reach))
    gap = (np.take(levels, plane) - np.take(ends.height, point)) / np.take(reach, point)
    part = 1.0 - gap * gap
    curve, change = ends.curve[point], real(ends.change)[point]
    inward = np.where(prepared.v[curve] == 0.0, change, -change)
    # From 0 to 1 without a kink at either end, so that derivatives are continuous, too.
    share = part * part * (3.0 - 2.0 * part)
    return NearbyCriticalPoints(plane, curve, share, over[plane, point] * inward < 0.0)


def _hidden_pieces(
    prepared: PreparedStrips,
    inclination: Inclination,
    levels: FloatArray,
    state: IntArray,
    soon: NearbyCriticalPoints,
) -> StateBrackets:
    """Look for pieces that begin and end before the first curve inside a strip.

    A critical point at the end of a strip that comes nearer to the plane may pass it and
    come back: as it does so at the very end, the piece must be found however short it is.
    """
    inner = soon.curve + np.where(prepared.v[soon.curve] == 0.0, 1, -1)
    hidden = soon.nearer & (state[soon.plane, soon.curve] == state[soon.plane, inner])
    count = len(prepared.strip)
    key = np.unique((soon.plane * count + soon.curve)[hidden])
    plane, curve = key // count, key % count
    inner = curve + np.where(prepared.v[curve] == 0.0, 1, -1)
    begin, end = prepared.v[curve, None], prepared.v[inner, None]
    trial = begin + (end - begin) * 0.5 ** np.arange(LADDER, 0, -1)
    seen = strip_states(
        prepared.plain,
        inclination,
        np.repeat(prepared.strip[curve], LADDER),
        trial.ravel(),
        np.repeat(real(levels)[plane], LADDER),
    ).reshape(-1, LADDER)
    v = np.concatenate([begin, trial, end], axis=1)
    kinds = np.concatenate([state[plane, curve, None], seen, state[plane, inner, None]], axis=1)
    one, rung = np.nonzero(kinds[:, 1:] != kinds[:, :-1])
    forward = (v[:, 0] == 0.0)[one]
    low, high = np.where(forward, rung, rung + 1), np.where(forward, rung + 1, rung)
    strip = prepared.strip[curve[one]]
    return StateBrackets(
        row=plane[one] * prepared.strips.count + strip,
        strip=strip,
        level=real(levels)[plane[one]],
        low=v[one, low],
        high=v[one, high],
        below=kinds[one, low],
        above=kinds[one, high],
    )


# --------------------------------------------------------------------------------------
# Where waterplanes end inside a strip: at critical points of curves that lie in the plane.


def waterplane_tips(
    strips: Strips, inclined: TiltedTiles, levels: FloatArray, found: StateBrackets
) -> FloatArray:
    """Give the extents of the points at which waterplanes end, (4, d), m, as in `point_extents`.

    `found.row` is the plane times the number of strips, plus the strip; levels are (d,), m.
    """
    # Where no curve is cut on either side, no waterplane ends.
    some = np.flatnonzero((cut_counts(found.below) > 0) | (cut_counts(found.above) > 0))
    plane, v = found.row[some] // strips.count, 0.5 * (found.low + found.high)[some]
    tiles = tiles_of_curves(strips.curves(found.strip[some], v))
    points = find_critical_points(tiles, tilt_tiles(tiles, inclined.trim, inclined.heel))
    passing = nearest_critical_point(points, found.level[some], tiles.curves)
    x, y = _passing_places(points, passing, np.take(levels, plane))
    return point_extents(x, y, plane, len(levels))


def _passing_places(
    points: CriticalPoints, point: IntArray, level: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give x and y of points where they pass their levels, one Newton step away."""
    change = np.take(points.change, point)
    steep = np.abs(real(change)) > STILL
    step = (level - np.take(points.height, point)) / np.where(steep, change, 1.0)
    step = np.where(steep, step, 0.0)
    place, rate = np.take(points.place, point, axis=1), np.take(points.rate, point, axis=1)
    moved = place + rate * step
    return moved[0], moved[1]

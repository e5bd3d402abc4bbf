"""Integrals of one side of a Coons surface below planes, compiled.

`integrate_curves_of_strips` takes any curves across strips, `find_events` looks where between the
curves of the plain rule the immersed part changes its kind, and lays a finer rule there. The steps
are those of `immersion`, `immersed_strips` and `strip_events`, one curve after the other: no table
of all curves is made. Values differ from those of numpy by rounding.

Examples
--------
>>> from assoc_hull.geometry.floating.compiled_strips import find_events
>>> callable(find_events)
True
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.compiled_curves import (
    count_cuts,
    critical_points,
    critical_value,
    integrate_curve,
    set_bows,
    set_component,
    set_curve,
    set_decks,
    set_heights,
    set_level_x,
    set_whole,
)
from assoc_hull.geometry.numeric.jit import jit, jit_part

__all__ = ["find_events", "greatest_breadth", "integrate_curves_of_strips"]

Flags = NDArray[np.bool_]
Surface = tuple[
    IntArray, IntArray, IntArray, IntArray, Flags, Flags, IntArray, IntArray, FloatArray,
    FloatArray, FloatArray, FloatArray, FloatArray, FloatArray,
]  # fmt: skip
"""The arguments of `integrate_curves_of_strips` from `anchor_start` to `blend`."""


@jit_part
def _state(size: int, edge: int, times: int, level: float, over: FloatArray) -> int:
    """Give the state of a curve as `curve_states` does."""
    state = 4 * times
    if over[4, 0] <= level:
        state += 2
    if over[7, size - 1] <= level:
        state += 1
    if edge >= 0 and over[4, max(edge, 0)] <= level:
        state += 1024
    return state


# --------------------------------------------------------------------------------------
# Integrals of curves.


@jit
def integrate_curves_of_strips(
    anchor_start: IntArray, anchor: IntArray, tile_start: IntArray, first: IntArray, plane: Flags,
    deck: Flags, edge: IntArray, path_start: IntArray, cubic: FloatArray, begin: FloatArray,
    finish: FloatArray, aft: FloatArray, span: FloatArray, blend: FloatArray,
    gauss_node: FloatArray, gauss_weight: FloatArray, whole: IntArray, limits: FloatArray,
    levels: FloatArray, trims: FloatArray, heels: FloatArray, strip_of: IntArray, v: FloatArray,
    planes: IntArray, columns: FloatArray, extents: FloatArray, states: IntArray,
    cuts: FloatArray, heights: FloatArray, reach: FloatArray, points: FloatArray, known: IntArray,
) -> None:  # fmt: skip
    """Integrate curves below planes, each as a strip of weight 1.

    Parameters
    ----------
    anchor_start, anchor, tile_start, first, plane, deck
        Of `CoonsCells`.
    edge : (n,) int
        The tile of each strip with which its deck begins; -1 where there is none.
    path_start, cubic, begin, finish
        Of `PathShapes`.
    aft, span : (12, t); blend : (16, t)
        Of `CoonsStrips`; rows are the coefficients of x, of y, of z; and of each power of u.
    gauss_node, gauss_weight, whole, limits
        The rule along tiles, and numbers that steps keep to.
    levels, trims, heels : (h,)
        The planes, m.
    strip_of, v : (k,); planes : (k, 2) int
        The curves, and from which to before which plane each is wanted.
    columns : (k, d, 17); extents : (h, 4)
        Get what `HalfIntegrals` has; of each curve for its first plane, the next, ...; extents are
        widened.
    states : (h, k) int; cuts : (h, k, 2); heights : (h, k, 3), m
        Get the states; y and dy/dv at the last cut; heights of keel, end and deck's edge.
    reach : (n, 2), m
        Is widened by the heights of each strip.
    points : (h, n, 2, m, 2); known : (h, n, 2) int
        Get height, and its change by v, of the critical points of curves at v = 0 and 1, and how
        many there are; nothing if m is zero.
    """
    most, wide, deep = _greatest(tile_start), _greatest(anchor_start), _longest(strip_of)
    count = len(levels)
    near, rows, work = np.empty((8, most)), np.empty((24, deep * most)), np.empty((12, deep * most))
    bow, sums, found = np.zeros((wide + 3, 6)), np.empty((11, deep * most)), np.empty((3, 4))
    over = np.empty((deep, count, 10, most))
    tiles, u = np.empty(3 * most + 3, np.int64), np.empty(3 * most + 3)
    cut, size_of, start = np.empty(2), np.empty((deep, count), np.int64), np.empty(deep, np.int64)
    x_axis, y_axis, z_axis = tile_start[0], tile_start[0] + 1, tile_start[0] + 2
    last = x_axis
    for k in range(len(v)):
        # The curves of one strip together: what runs over all their tiles runs the longer.
        if k < last:
            continue
        strip, any_heel = strip_of[k], False
        flat, tile, end = plane[strip], tile_start[strip], edge[strip]
        size = tile_start[strip + 1] - tile
        at = k - k
        while last < len(v) and strip_of[last] == strip and last - k < deep:
            w, own, from_plane, to_plane = v[last], last - k, planes[last, 0], planes[last, 1]
            everywhere = points.shape[3] > 0 and (w == 0.0 or w == 1.0)
            heeled = (heels[from_plane:to_plane] != 0.0).any()
            trimmed = (trims[from_plane:to_plane] != 0.0).any()
            any_heel = any_heel or heeled
            set_bows(
                w, anchor_start[strip], anchor_start[strip + 1], flat, anchor, path_start, cubic,
                begin, finish, whole[0], limits[3], bow,
            )  # fmt: skip
            # All of a curve where all is wanted; else what is dry takes its heights only.
            set_component(z_axis, w, tile, size, at, first, aft, span, blend, bow, near, rows)
            far_y = size if heeled or everywhere else size - size
            far_x = size if trimmed or everywhere else size - size
            for turn in range(2):
                if turn == 1:
                    wet = size - size
                    for h in range(from_plane, to_plane):
                        size_of[own, h] = set_heights(
                            size, at, trims[h], heels[h], levels[h], rows, over[own, h]
                        )
                        wet = max(wet, size_of[own, h])
                    far_x = wet if far_x == 0 else size - size
                    far_y = wet if far_y == 0 else size - size
                if flat:
                    set_level_x(w, tile, far_x, at, aft, span, rows)
                else:
                    set_component(
                        x_axis, w, tile, far_x, at, first, aft, span, blend, bow, near, rows
                    )
                set_component(y_axis, w, tile, far_y, at, first, aft, span, blend, bow, near, rows)
                set_decks(tile, far_y, at, deck, rows)
            _widen(size, at, strip, rows, reach)
            for h in range(from_plane, to_plane if everywhere else from_plane):
                side = 0 if w == 0.0 else 1
                known[h, strip, side] = critical_points(size, end, over[own, h], tiles, u)
                for i in range(known[h, strip, side]):
                    s = at + tiles[i]
                    x_v = critical_value(rows[12:16], s, u[i])
                    y_v = critical_value(rows[16:20], s, u[i])
                    z_v = critical_value(rows[20:24], s, u[i])
                    points[h, strip, side, i, 0] = critical_value(over[own, h], tiles[i], u[i])
                    points[h, strip, side, i, 1] = z_v - trims[h] * x_v + heels[h] * y_v
            start[own] = at
            at += wet
            last += 1
        set_whole(at, flat, any_heel, gauss_node, gauss_weight, rows, work, sums)
        for j in range(k, last):
            own = j - k
            for h in range(planes[j, 0], planes[j, 1]):
                level, trim, heel = levels[h], trims[h], heels[h]
                times = integrate_curve(
                    level, trim, heel, tile, size_of[own, h], start[own], heel != 0.0, deck,
                    gauss_node, gauss_weight, limits, whole[1], whole[2], rows, over[own, h], sums,
                    found, columns[j, h - planes[j, 0]], extents[h], cut,
                )  # fmt: skip
                cuts[h, j, 0], cuts[h, j, 1] = cut[0], cut[1]
                states[h, j] = _state(size, end, times, level, over[own, h])
                heights[h, j, 0] = over[own, h, 4, 0]
                heights[h, j, 1] = over[own, h, 7, size - 1]
                heights[h, j, 2] = over[own, h, 4, end] if end >= 0 else np.inf


@jit_part
def _greatest(start: IntArray) -> int:
    """Give the size of the greatest part, at least 1."""
    most: int = start[0] + 1
    for i in range(len(start) - 1):
        most = max(most, start[i + 1] - start[i])
    return most


@jit_part
def _longest(number: IntArray) -> int:
    """Give how many equal numbers follow one another at most; no more than 16."""
    most, first = number[0] - number[0] + 1, number[0] - number[0]
    for i in range(len(number)):
        if number[i] != number[first]:
            first = first - first + i
        most = max(most, i - first + 1)
    found: int = min(most, 16)
    return found


@jit_part
def _widen(size: int, at: int, strip: int, rows: FloatArray, reach: FloatArray) -> None:
    """Widen the heights of a strip by the Bernstein coefficients of z of the tiles of a curve."""
    z0, z1, z2, z3 = rows[8, at:], rows[9, at:], rows[10, at:], rows[11, at:]
    low, high = reach[strip, 0], reach[strip, 1]
    for s in range(size):
        one = z0[s] + z1[s] / 3.0
        two = one + (z1[s] + z2[s]) / 3.0
        low, high = min(low, z0[s], one, two), max(high, z0[s], one, two)
    last = size - 1
    end = z0[last] + z1[last] + z2[last] + z3[last]
    reach[strip, 0], reach[strip, 1] = min(low, end), max(high, end)


@jit_part
def _summit(begin: float, end: float, out: float, into: float) -> float:
    """Give the first greatest value of a cubic from 0 to 1 that begins upward."""
    rise = end - begin
    second, third = 3.0 * rise - 2.0 * out - into, out + into - 2.0 * rise
    below = sqrt(max(second * second - 3.0 * third * out, 0.0)) - second
    t = out / below if below > 0.0 else 0.0
    t = t if t < 1.0 else 0.0
    return begin + t * (out + t * (second + t * third))


@jit
def greatest_breadth(
    cuts: FloatArray, states: IntArray, strip_of: IntArray, v: FloatArray, most: float, tie: float
) -> float:  # fmt: skip
    """Give the greatest half breadth between curves, as `greatest_breadths` below one plane."""
    best, last = -np.inf, len(v) - 1
    for k in range(last + 1):
        if states[k] % 1024 // 4 != 1 or cuts[k, 0] < most - tie:
            continue
        beside = min(max(k + 1 if cuts[k, 1] > 0.0 else k - 1, 0), last)
        if strip_of[beside] != strip_of[k] or states[beside] % 1024 // 4 != 1:
            continue
        length = v[beside] - v[k]
        best = max(
            best,
            _summit(cuts[k, 0], cuts[beside, 0], cuts[k, 1] * length, cuts[beside, 1] * length),
        )
    return best


# --------------------------------------------------------------------------------------
# Where along strips the immersed part changes its kind.


@jit_part
def _sort(values: FloatArray, count: int) -> None:
    """Sort the first few of some numbers."""
    for i in range(1, count):
        value, j = values[i], i
        while j > 0 and values[j - 1] > value:
            values[j] = values[j - 1]
            j -= 1
        values[j] = value


@jit_part
def _inspect(
    strip: int, w: float, trim: float, heel: float, level: float, surface: Surface,
    whole: IntArray, limits: FloatArray, bow: FloatArray, rows: FloatArray, over: FloatArray,
    found: FloatArray, tiles: IntArray, u: FloatArray, seen: FloatArray,
) -> int:  # fmt: skip
    """Give the state of a curve anywhere across a strip.

    `seen` (16,) gets how far what decides it is over the plane, as `CurveStates.over`, and where
    the critical point nearest to the plane passes it, x and y.
    """
    (
        anchor_start,
        anchor,
        tile_start,
        first,
        plane,
        deck,
        edges,
        path_start,
        cubic,
        begin,
        finish,
        aft,
        span,
        blend,
    ) = surface
    flat, tile, edge = plane[strip], tile_start[strip], edges[strip]
    size = tile_start[strip + 1] - tile
    set_bows(
        w, anchor_start[strip], anchor_start[strip + 1], flat, anchor, path_start, cubic, begin,
        finish, whole[0], limits[3], bow,
    )  # fmt: skip
    set_curve(w, tile, size, flat, first, deck, aft, span, blend, bow, rows[24:], rows)
    set_heights(size, size - size, trim, heel, level, rows, over)
    most = whole[4]
    seen[2:most] = np.inf
    seen[0], seen[1] = over[4, 0] - level, over[7, size - 1] - level
    count = critical_points(size, edge, over, tiles, u)
    least, s, t = np.inf, tiles[0], u[0]
    # `rows` has more rows than a curve needs.
    heights = rows[32]
    for i in range(count):
        heights[i] = critical_value(over, tiles[i], u[i]) - level
        # A level deck is as high at its edge as at the end of the curve: the waterplane ends there.
        tie = limits[8] if i == 2 and edge >= 0 else 0.0
        if abs(heights[i]) < least + tie:
            least, s, t = min(least, abs(heights[i])), tiles[i], u[i]
    x_v, y_v = critical_value(rows[12:16], s, t), critical_value(rows[16:20], s, t)
    change = critical_value(rows[20:24], s, t) - trim * x_v + heel * y_v
    step = 0.0
    if abs(change) > limits[9]:
        step = (level - critical_value(over, s, t)) / change
    seen[most] = critical_value(rows[0:4], s, t) + x_v * step
    seen[most + 1] = critical_value(rows[4:8], s, t) + y_v * step
    _sort(heights, count)
    for i in range(min(count, most - 2)):
        seen[2 + i] = heights[i]
    return _state(size, edge, count_cuts(over, size, level, found), level, over)


@jit_part
def _share(before: FloatArray, after: FloatArray, most: int, change: int) -> float:
    """Give where between two curves the chord says that the plane is passed; -1 if it says nothing.

    `before` and `after` are as `CurveStates.over`.
    """
    wet = max((before[2:most] <= 0.0).sum(), (after[2:most] <= 0.0).sum())
    point = min(wet + 1, most - 1)
    if change & 1:
        point = wet - wet + 1
    if change & 2:
        point = wet - wet
    one, other = before[point], after[point]
    if np.isfinite(one - other) and one * other < 0.0:
        return float(one / (one - other))
    return -1.0


@jit_part
def _set_trials(low: float, high: float, share: float, close: float, trial: FloatArray) -> None:
    """Set three places in a bracket as `_trials` of `immersed_strips` does."""
    length = high - low
    chord = share >= 0.0
    if not chord:
        share = 0.5
    half = min(0.25, 0.25 * length + 0.3 * close / length) if chord else 0.25
    before, after = max(share - half, 0.25 * share), min(share + half, share + 0.75 * (1.0 - share))
    far = 0.5
    if chord:
        far = 0.5 * before if share > 0.5 else 0.5 * (1.0 + after)
    trial[0], trial[1], trial[2] = before, after, far
    _sort(trial, len(trial))
    for i in range(3):
        trial[i] = low + length * trial[i]


@jit_part
def _flickers(change: int, one: FloatArray, other: FloatArray, level: float, least: float) -> bool:
    """Say whether two states differ only by rounding: as `rounding_flickers`."""
    some, all_in = False, True
    for i in range(3):
        if change & (2, 1, 1024)[i]:
            some = True
            within = abs(one[i] - level) <= least and abs(other[i] - level) <= least
            all_in = all_in and within
    return some and all_in


@jit_part
def _is_level(height: float, least: float, others: FloatArray, count: int) -> bool:
    """Say whether the other end of a strip has a critical point of the same height."""
    step = np.rint(height / least)
    found = False
    for i in range(count):
        found = found or np.rint(others[i, 0] / least) == step
    return found


@jit
def find_events(
    anchor_start: IntArray, anchor: IntArray, tile_start: IntArray, first: IntArray, plane: Flags,
    deck: Flags, edge: IntArray, path_start: IntArray, cubic: FloatArray, begin: FloatArray,
    finish: FloatArray, aft: FloatArray, span: FloatArray, blend: FloatArray,
    rule_start: IntArray, node: FloatArray, weight: FloatArray,
    fine_start: IntArray, fine_node: FloatArray, fine_weight: FloatArray,
    whole: IntArray, limits: FloatArray, levels: FloatArray, trims: FloatArray, heels: FloatArray,
    states: IntArray, heights: FloatArray, reach: FloatArray, points: FloatArray, known: IntArray,
    extents: FloatArray, shares: FloatArray, strip_of: IntArray, v: FloatArray, share: FloatArray,
    planes: IntArray,
) -> int:  # fmt: skip
    """Lay finer rules in strips in which something happens; give how many curves they have.

    Parameters
    ----------
    anchor_start, ..., blend, whole, limits, levels, trims, heels, states, heights, reach, points, \
    known, extents
        As in `integrate_curves_of_strips`, of the curves of the plain rule.
    rule_start, node, weight, fine_start, fine_node, fine_weight
        Rules along each strip: the plain one, and that for stretches in which something happens.
    shares : (h, n)
        Get the share of the finer rule below each plane, along each strip.
    strip_of, v, share : (k,); planes : (k, 2) int
        Get its curves, as many as there is room for: strips, places, shares in the integral, and
        from which to before which plane they are wanted.
    """
    surface = (
        anchor_start, anchor, tile_start, first, plane, deck, edge, path_start, cubic, begin,
        finish, aft, span, blend,
    )  # fmt: skip
    most = _greatest(tile_start)
    rows, over = np.empty((33, 3 * most + 3)), np.empty((10, 3 * most + 3))
    bow, found = np.zeros((_greatest(anchor_start) + 3, 6)), np.empty((3, 4))
    tiles, u = np.empty(3 * most + 3, np.int64), np.empty(3 * most + 3)
    seen, trial = np.empty((5, whole[4] + 2)), np.empty(3)
    places, kinds = np.empty(5), np.empty(5, np.int64)
    deep = _greatest(rule_start)
    ends = np.empty((deep + 2 * whole[3] + 2, 2))
    pair = np.empty((len(ends), 2), np.int64)
    middle, sides = np.empty(len(ends) * whole[6]), np.empty((len(ends) * whole[6], 2), np.int64)
    total: int = rule_start[0] - rule_start[0]
    for h in range(len(levels)):
        level, trim, heel = levels[h], trims[h], heels[h]
        for strip in range(len(plane)):
            from_curve, to_curve = rule_start[strip], rule_start[strip + 1]
            depth = reach[strip, 1] - reach[strip, 0]
            if not depth > limits[5]:
                depth = 1.0
            least, part = limits[4] * depth, 0.0
            brackets = total - total
            # A change of state between two curves, if it is more than rounding.
            for k in range(from_curve, to_curve - 1):
                change = states[h, k] ^ states[h, k + 1]
                if change == 0 or _flickers(change, heights[h, k], heights[h, k + 1], level, least):
                    continue
                ends[brackets, 0], ends[brackets, 1] = node[k], node[k + 1]
                pair[brackets, 0], pair[brackets, 1] = states[h, k], states[h, k + 1]
                brackets += 1
            # Critical points at the ends that a strip's worth of change may wet or dry.
            for side in range(2):
                here, there = points[h, strip, side], points[h, strip, 1 - side]
                nearer = False
                for i in range(known[h, strip, side]):
                    height, change_of = here[i, 0], here[i, 1]
                    if abs(change_of) <= least and _is_level(
                        height, least, there, known[h, strip, 1 - side]
                    ):
                        continue
                    far = sqrt(change_of * change_of + (limits[6] * depth) ** 2)
                    if not abs(height - level) < far:
                        continue
                    gap = (level - height) / far
                    close = 1.0 - gap * gap
                    part = max(part, close * close * (3.0 - 2.0 * close))
                    inward = change_of if side == 0 else -change_of
                    nearer = nearer or (height - level) * inward < 0.0
                end = from_curve if side == 0 else to_curve - 1
                inner = from_curve + 1 if side == 0 else to_curve - 2
                if not nearer or states[h, end] != states[h, inner]:
                    continue
                # Pieces that begin and end before the first curve inside the strip.
                was, state = node[end], states[h, end]
                for rung in range(whole[3] + 1):
                    to, kind = node[inner], states[h, inner]
                    if rung < whole[3]:
                        to = node[end] + (node[inner] - node[end]) * 0.5 ** (whole[3] - rung)
                        kind = _inspect(
                            strip, to, trim, heel, level, surface, whole, limits, bow, rows, over,
                            found, tiles, u, seen[0],
                        )  # fmt: skip
                    if kind != state:
                        back = int(was > to)
                        ends[brackets, back], ends[brackets, 1 - back] = was, to
                        pair[brackets, back], pair[brackets, 1 - back] = state, kind
                        brackets += 1
                    was, state = to, kind
            count = total - total
            for b in range(brackets):
                low, high, below, above = ends[b, 0], ends[b, 1], pair[b, 0], pair[b, 1]
                for _ in range(whole[6]):
                    # Closed on the first change of state in it.
                    places[0], places[4], kinds[4] = low, high, above
                    for trials in range(whole[5] + 1):
                        # First both ends are looked at, then three places between them.
                        for i in range(1 if trials > 0 else 0, 5, 1 if trials > 0 else 4):
                            if trials > 0 and i == 4:
                                break
                            kind = _inspect(
                                strip, places[i], trim, heel, level, surface, whole, limits, bow,
                                rows, over, found, tiles, u, seen[i],
                            )  # fmt: skip
                            if trials > 0:
                                kinds[i] = kind
                                if kind != below:
                                    break
                        if trials > 0:
                            kept = total - total
                            while kept < 3 and kinds[kept + 1] == below:
                                kept += 1
                            seen[0] = seen[kept]
                            if kept < 3:
                                seen[4] = seen[kept + 1]
                            places[0], places[4] = places[kept], places[kept + 1]
                            kinds[4] = kinds[kept + 1]
                        if not places[4] - places[0] > limits[7]:
                            break
                        chord = _share(seen[0], seen[4], whole[4], below ^ kinds[4])
                        _set_trials(places[0], places[4], chord, limits[7], trial)
                        places[1], places[2], places[3] = trial[0], trial[1], trial[2]
                    middle[count] = 0.5 * (places[0] + places[4])
                    sides[count, 0], sides[count, 1] = below, kinds[4]
                    if below % 1024 >= 4 or kinds[4] % 1024 >= 4:
                        _inspect(
                            strip, middle[count], trim, heel, level, surface, whole, limits, bow,
                            rows, over, found, tiles, u, seen[0],
                        )  # fmt: skip
                        x, y = seen[0, whole[4]], seen[0, whole[4] + 1]
                        extents[h, 0], extents[h, 1] = min(extents[h, 0], x), max(extents[h, 1], x)
                        extents[h, 2], extents[h, 3] = min(extents[h, 2], y), max(extents[h, 3], y)
                    count += 1
                    if not (kinds[4] != above and places[4] < high):
                        break
                    low, below = places[4], kinds[4]
            if count > 0:
                part = 1.0
            shares[h, strip] = part
            if part == 0.0:
                continue
            _order(middle, sides, count)
            for i in range(count + 1):
                low = middle[i - 1] if i > 0 else 0.0
                high = middle[i] if i < count else 1.0
                # What is dry has no share.
                if count > 0 and (sides[i - 1, 1] if i > 0 else sides[0, 0]) == 0:
                    continue
                if not high - low > 0.0:
                    continue
                for j in range(fine_start[strip], fine_start[strip + 1]):
                    if total < len(v):
                        strip_of[total], v[total] = strip, low + (high - low) * fine_node[j]
                        share[total] = part * (high - low) * fine_weight[j]
                        planes[total, 0], planes[total, 1] = h, h + 1
                    total += 1
    return total


@jit_part
def _order(middle: FloatArray, sides: IntArray, count: int) -> None:
    """Sort places along a strip, and the states on both their sides."""
    for i in range(1, count):
        for j in range(i, 0, -1):
            if not middle[j - 1] > middle[j]:
                break
            middle[j - 1], middle[j] = middle[j], middle[j - 1]
            for k in range(2):
                sides[j - 1, k], sides[j, k] = sides[j, k], sides[j - 1, k]

"""Curves across a Coons surface and what planes make of them, compiled: one curve at a time.

The tiles of a curve lie in rows, `rows` (24, t): the coefficients of x, y, z, x_v, y_v, z_v in 1,
u, u^2, u^3. What runs over all tiles does so in short loops without decisions, which become vector
instructions. The arithmetic is that of `coons`, `tiles` and `waterplane_cuts`; sums have another
order, so that values differ by rounding. In strips of sections x is taken as constant along a
curve, as it is but for rounding.

Examples
--------
>>> from assoc_hull.geometry.floating.compiled_curves import set_curve
>>> callable(set_curve)
True
"""

from __future__ import annotations

from math import copysign, sqrt

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.compiled_roots import safe_root
from assoc_hull.geometry.numeric.jit import jit_part

__all__ = [
    "count_cuts",
    "critical_points",
    "critical_value",
    "integrate_curve",
    "set_bows",
    "set_component",
    "set_curve",
    "set_decks",
    "set_heights",
    "set_level_x",
    "set_whole",
]

Flags = NDArray[np.bool_]


# --------------------------------------------------------------------------------------
# The tiles of a curve.


@jit_part
def _place(cubic: FloatArray, target: float, steps: int, small: float) -> float:
    """Find where x of a monotone cubic reaches a value: Newton's rule, else within a bracket."""
    c0, c1, c2, c3 = cubic[0, 0] - target, cubic[1, 0], cubic[2, 0], cubic[3, 0]
    slope = c1 + c2 + c3
    u = -c0 / (1.0 if slope == 0.0 else slope)
    for _ in range(steps):
        step = (((c3 * u + c2) * u + c1) * u + c0) / ((3.0 * c3 * u + 2.0 * c2) * u + c1)
        u -= step
        if abs(step) <= small:
            break
    if not (abs(step) <= small and -small <= u <= 1.0 + small):
        u = safe_root(c0, c1, c2, c3, 0.0, 1.0, slope >= 0.0, 0.0, 200)
    inside: float = min(max(u, 0.0), 1.0)
    return inside


@jit_part
def set_bows(
    w: float, begin_anchor: int, end_anchor: int, flat: bool, anchor: IntArray,
    path_start: IntArray, cubic: FloatArray, begin: FloatArray, finish: FloatArray,
    steps: int, small: float, bow: FloatArray,
) -> None:  # fmt: skip
    """Set by what the anchors of a strip leave their chords at w, and the derivatives by w."""
    for k in range(begin_anchor, end_anchor + 3):
        row = bow[k - begin_anchor]
        p = anchor[k] if k < end_anchor else -1
        if p < 0:
            # No line is drawn, or the rows behind the last anchor, which have no weight.
            row[:] = 0.0
            continue
        first, last = path_start[p], path_start[p + 1] - 1
        bit = first
        if w == 0.0 or w == 1.0:
            bit = first if w == 0.0 else last
            u, share = w, 1.0 / (finish[bit] - begin[bit])
            if flat:
                rate = (3.0 * cubic[bit, 3, 0] * u + 2.0 * cubic[bit, 2, 0]) * u + cubic[bit, 1, 0]
                end = cubic[last]
                along = end[0, 0] + end[1, 0] + end[2, 0] + end[3, 0] - cubic[first, 0, 0]
                share = along / rate
        elif flat:
            x_0 = cubic[first, 0, 0]
            end = cubic[last]
            along = end[0, 0] + end[1, 0] + end[2, 0] + end[3, 0] - x_0
            target, rising = x_0 + w * along, along >= 0.0
            while bit < last and ((cubic[bit + 1, 0, 0] <= target) == rising):
                bit += 1
            u = _place(cubic[bit], target, steps, small)
            rate = (3.0 * cubic[bit, 3, 0] * u + 2.0 * cubic[bit, 2, 0]) * u + cubic[bit, 1, 0]
            share = along / rate
        else:
            while bit < last and begin[bit + 1] <= w:
                bit += 1
            length = finish[bit] - begin[bit]
            u, share = (w - begin[bit]) / length, 1.0 / length
        here, end = cubic[bit], cubic[last]
        for c in range(3):
            origin = cubic[first, 0, c]
            chord = end[0, c] + end[1, c] + end[2, c] + end[3, c] - origin
            place = ((here[3, c] * u + here[2, c]) * u + here[1, c]) * u + here[0, c]
            slope = (3.0 * here[3, c] * u + 2.0 * here[2, c]) * u + here[1, c]
            # An anchor begins and ends on its chord.
            row[c] = 0.0 if w == 0.0 or w == 1.0 else place - (origin + w * chord)
            row[3 + c] = slope * share - chord


@jit_part
def set_component(
    c: int, w: float, tile: int, size: int, at: int, first: IntArray, aft: FloatArray,
    span: FloatArray, blend: FloatArray, bow: FloatArray, near: FloatArray, rows: FloatArray,
) -> None:  # fmt: skip
    """Set one of x, y, z, and its derivative by v, on `size` tiles from `tile` on.

    They come into the rows from column `at` on.
    """
    inside = w != 0.0 and w != 1.0
    for j in range(4):
        one, other = near[j], near[4 + j]
        for s in range(size):
            a = first[tile + s] + j
            one[s], other[s] = bow[a, c], bow[a, 3 + c]
    n0, n1, n2, n3 = near[0], near[1], near[2], near[3]
    m0, m1, m2, m3 = near[4], near[5], near[6], near[7]
    for i in range(4):
        low, way = aft[4 * c + i, tile:], span[4 * c + i, tile:]
        b0, b1, b2, b3 = (
            blend[4 * i, tile:], blend[4 * i + 1, tile:], blend[4 * i + 2, tile:],
            blend[4 * i + 3, tile:],
        )  # fmt: skip
        point, across = rows[4 * c + i, at:], rows[12 + 4 * c + i, at:]
        for s in range(size):
            point[s] = low[s] + w * way[s]
        if inside:
            for s in range(size):
                point[s] += b0[s] * n0[s] + b1[s] * n1[s] + b2[s] * n2[s] + b3[s] * n3[s]
        for s in range(size):
            across[s] = b0[s] * m0[s] + b1[s] * m1[s] + b2[s] * m2[s] + b3[s] * m3[s]
        for s in range(size):
            across[s] += way[s]


@jit_part
def set_level_x(
    w: float, tile: int, size: int, at: int, aft: FloatArray, span: FloatArray, rows: FloatArray
) -> None:
    """Set x and its derivative where they are the same all along, in strips of sections."""
    low, way, x, x_v = aft[0, tile:], span[0, tile:], rows[0, at:], rows[12, at:]
    for s in range(size):
        x[s] = low[s] + w * way[s]
    for s in range(size):
        x_v[s] = way[s]
    for i in range(1, 4):
        point, across = rows[i, at:], rows[12 + i, at:]
        for s in range(size):
            point[s] = 0.0
        for s in range(size):
            across[s] = 0.0


@jit_part
def set_decks(tile: int, size: int, at: int, deck: Flags, rows: FloatArray) -> None:
    """Let the tiles of decks run in from where they begin, to the centre plane."""
    for s in range(size):
        if deck[tile + s]:
            rows[5, at + s], rows[17, at + s] = -rows[4, at + s], -rows[16, at + s]


@jit_part
def set_curve(
    w: float, tile: int, size: int, flat: bool, first: IntArray, deck: Flags, aft: FloatArray,
    span: FloatArray, blend: FloatArray, bow: FloatArray, near: FloatArray, rows: FloatArray,
) -> None:  # fmt: skip
    """Set all tiles of a curve."""
    at = size - size
    for c in range(3):
        if flat and c == 0:
            set_level_x(w, tile, size, at, aft, span, rows)
        else:
            set_component(c, w, tile, size, at, first, aft, span, blend, bow, near, rows)
    set_decks(tile, size, at, deck, rows)


# --------------------------------------------------------------------------------------
# Heights over a plane: rows 0 to 3 of `over` are the cubic, 4 to 7 its Bernstein coefficients,
# 8 and 9 the least and the greatest of these; 10 is 1 where a tile may run up and down.


@jit_part
def set_heights(
    size: int, at: int, trim: float, heel: float, level: float, rows: FloatArray, over: FloatArray
) -> int:
    """Measure the tiles of a curve over planes of an inclination; count them up to the last wet."""
    for i in range(4):
        height, x, y, z = over[i], rows[i, at:], rows[4 + i, at:], rows[8 + i, at:]
        if trim != 0.0 and heel != 0.0:
            for s in range(size):
                height[s] = z[s] - trim * x[s] + heel * y[s]
        elif trim != 0.0:
            for s in range(size):
                height[s] = z[s] - trim * x[s]
        elif heel != 0.0:
            for s in range(size):
                height[s] = z[s] + heel * y[s]
        else:
            for s in range(size):
                height[s] = z[s]
    q0, q1, q2, q3 = over[0], over[1], over[2], over[3]
    c0, c1, c2, c3 = over[4], over[5], over[6], over[7]
    low, high = over[8], over[9]
    for s in range(size):
        c0[s] = q0[s]
        c1[s] = q0[s] + q1[s] / 3.0
    for s in range(size):
        c2[s] = c1[s] + (q1[s] + q2[s]) / 3.0
    # The first of the next tile, not the sum of the own coefficients: neighbours agree to the bit.
    for s in range(size - 1):
        c3[s] = q0[s + 1]
    last = size - 1
    c3[last] = q0[last] + q1[last] + q2[last] + q3[last]
    for s in range(size):
        low[s] = min(min(c0[s], c1[s]), min(c2[s], c3[s]))
    for s in range(size):
        high[s] = max(max(c0[s], c1[s]), max(c2[s], c3[s]))
    for s in range(size - 1, -1, -1):
        if low[s] <= level:
            return s + 1
    return 0


@jit_part
def _wavy(over: FloatArray, s: int) -> bool:
    """Tell whether by its Bernstein coefficients a tile may run up and down."""
    one, two, three = over[5, s] - over[4, s], over[6, s] - over[5, s], over[7, s] - over[6, s]
    falls = one < 0.0 or two < 0.0 or three < 0.0
    rises = one > 0.0 or two > 0.0 or three > 0.0
    both: bool = falls and rises
    return both


@jit_part
def _stationary(first: float, second: float, third: float) -> tuple[float, float]:
    """Cut a cubic into monotone parts: as `stationary_fractions`."""
    root = sqrt(max(second * second - 3.0 * (third * first), 0.0))
    if second * second - 3.0 * (third * first) < 0.0:
        return 0.0, 1.0
    total = -(second + copysign(root, second))
    one, other = total / (3.0 * third), first / total
    one = one if 0.0 < one < 1.0 else 0.0
    other = other if 0.0 < other < 1.0 else 0.0
    lower, upper = min(one, other), max(one, other)
    return lower, upper if upper > 0.0 else 1.0


@jit_part
def _brackets(over: FloatArray, s: int, level: float, found: FloatArray) -> int:
    """Bracket the changes of sign of a tile over a level: from, to, and the heights there."""
    at_0, at_1 = over[4, s] - level, over[7, s] - level
    if not _wavy(over, s):
        if (at_0 <= 0.0) == (at_1 <= 0.0):
            return 0
        found[0, 0], found[0, 1], found[0, 2], found[0, 3] = 0.0, 1.0, at_0, at_1
        return 1
    c0, c1, c2, c3 = over[0, s] - level, over[1, s], over[2, s], over[3, s]
    lower, upper = _stationary(c1, c2, c3)
    at_lower = ((c3 * lower + c2) * lower + c1) * lower + c0 if lower > 0.0 else at_0
    at_upper = ((c3 * upper + c2) * upper + c1) * upper + c0 if upper < 1.0 else at_1
    edge, height = (0.0, lower, upper, 1.0), (at_0, at_lower, at_upper, at_1)
    count = 0
    for i in range(3):
        if (height[i] <= 0.0) != (height[i + 1] <= 0.0):
            found[count, 0], found[count, 1] = edge[i], edge[i + 1]
            found[count, 2], found[count, 3] = height[i], height[i + 1]
            count += 1
    return count


@jit_part
def count_cuts(over: FloatArray, size: int, level: float, found: FloatArray) -> int:
    """Count how often a curve is cut."""
    count = 0
    for s in range(size):
        if over[8, s] <= level < over[9, s]:
            count += _brackets(over, s, level, found)
    return count


@jit_part
def _cut(
    over: FloatArray, s: int, level: float, bracket: FloatArray, limits: FloatArray,
    steps: int, trials: int,
) -> float:  # fmt: skip
    """Find the root in a bracket, from that of the parabola through its ends and the middle."""
    c0, c1, c2, c3 = over[0, s] - level, over[1, s], over[2, s], over[3, s]
    low: float = bracket[0]
    high: float = bracket[1]
    at_low, at_high = bracket[2], bracket[3]
    if at_low == 0.0:
        return low
    if at_high == 0.0:
        return high
    half = low + 0.5 * (high - low)
    middle = ((c3 * half + c2) * half + c1) * half + c0
    rise = at_high - at_low
    bend = 2.0 * (at_low + at_high - 2.0 * middle)
    begin = rise - bend
    slope = begin + copysign(sqrt(max(begin * begin - 4.0 * bend * at_low, 0.0)), rise)
    share = -2.0 * at_low / slope if slope * rise > 0.0 else 0.5
    u: float = low + (high - low) * min(max(share, 0.0), 1.0)
    for _ in range(steps):
        height = ((c3 * u + c2) * u + c1) * u + c0
        bend = 3.0 * c3 * u + c2
        slope = (bend + c2) * u + c1
        u -= (height * slope) / (slope * slope - bend * height)
    height = ((c3 * u + c2) * u + c1) * u + c0
    limit = limits[0] + limits[1] * (abs(at_low) + abs(at_high))
    if abs(height) <= limit and low <= u <= high:
        return u
    return safe_root(c0, c1, c2, c3, low, high, at_low < 0.0, limit, trials)


# --------------------------------------------------------------------------------------
# Integrals of whole tiles and up to cuts.


@jit_part
def _set_values(cubic: FloatArray, u: float, size: int, value: FloatArray) -> None:
    c0, c1, c2, c3 = cubic[0], cubic[1], cubic[2], cubic[3]
    for s in range(size):
        value[s] = ((c3[s] * u + c2[s]) * u + c1[s]) * u + c0[s]


@jit_part
def _set_slopes(cubic: FloatArray, u: float, size: int, slope: FloatArray) -> None:
    c1, c2, c3 = cubic[1], cubic[2], cubic[3]
    for s in range(size):
        slope[s] = (3.0 * u * c3[s] + 2.0 * c2[s]) * u + c1[s]


@jit_part
def set_whole(
    size: int, flat: bool, heeled: bool, node: FloatArray, weight: FloatArray,
    rows: FloatArray, room: FloatArray, whole: FloatArray,
) -> None:  # fmt: skip
    """Integrate tiles: the rows of `integrate_tiles`, but for decks."""
    whole[:, :size] = 0.0
    y, y_u, z, z_u, y_v, z_v = room[0], room[1], room[2], room[3], room[4], room[5]
    x, x_u, x_v = room[6], room[7], room[8]
    flux, normal, round_about = room[9], room[10], room[11]
    for g in range(len(node)):
        u, share = node[g], weight[g]
        _set_values(rows[4:8], u, size, y)
        _set_values(rows[8:12], u, size, z)
        _set_values(rows[16:20], u, size, y_v)
        _set_values(rows[20:24], u, size, z_v)
        _set_slopes(rows[4:8], u, size, y_u)
        _set_slopes(rows[8:12], u, size, z_u)
        for s in range(size):
            normal[s] = y_u[s] * z_v[s] - z_u[s] * y_v[s]
        if flat:
            x, x_v = rows[0], rows[12]
            for s in range(size):
                flux[s] = x_v[s] * z_u[s]
            for s in range(size):
                round_about[s] = (x_v[s] * x_v[s]) * (y_u[s] * y_u[s] + z_u[s] * z_u[s])
        else:
            _set_values(rows[0:4], u, size, x)
            _set_values(rows[12:16], u, size, x_v)
            _set_slopes(rows[0:4], u, size, x_u)
            for s in range(size):
                flux[s] = z_u[s] * x_v[s] - x_u[s] * z_v[s]
            for s in range(size):
                round_about[s] = x_u[s] * y_v[s] - y_u[s] * x_v[s]
            for s in range(size):
                round_about[s] = flux[s] * flux[s] + round_about[s] * round_about[s]
        _add_fluxes(share, size, x, y, z, flux, whole[:4])
        size_row, girth = whole[4], whole[5]
        for s in range(size):
            size_row[s] += share * sqrt(normal[s] * normal[s] + round_about[s])
        for s in range(size):
            girth[s] += share * sqrt(round_about[s])
        if heeled:
            if flat:
                for s in range(size):
                    flux[s] = -x_v[s] * y_u[s]
            else:
                for s in range(size):
                    flux[s] = x_u[s] * y_v[s] - y_u[s] * x_v[s]
            _add_fluxes(share, size, x, y, z, flux, whole[7:])


@jit_part
def _add_fluxes(
    share: float, size: int, x: FloatArray, y: FloatArray, z: FloatArray, normal: FloatArray,
    sums: FloatArray,
) -> None:  # fmt: skip
    """Add y N, x y N, y^2/2 N and y z N at one place of each tile; `normal` becomes the first."""
    one, two, three, four = sums[0], sums[1], sums[2], sums[3]
    for s in range(size):
        normal[s] = share * y[s] * normal[s]
    for s in range(size):
        one[s] += normal[s]
    for s in range(size):
        two[s] += x[s] * normal[s]
    for s in range(size):
        three[s] += 0.5 * y[s] * normal[s]
    for s in range(size):
        four[s] += z[s] * normal[s]


@jit_part
def integrate_curve(
    level: float, trim: float, heel: float, tile: int, size: int, at: int, heeled: bool,
    deck: Flags, node: FloatArray, weight: FloatArray, limits: FloatArray, steps: int, trials: int,
    rows: FloatArray, over: FloatArray, whole: FloatArray, found: FloatArray, column: FloatArray,
    extent: FloatArray, cut: FloatArray,
) -> int:  # fmt: skip
    """Integrate a curve below a plane, as if it were a strip of weight 1; count its cuts.

    `size` tiles, which stand in the rows from column `at` on, reach up to the last wet one.
    `column` (17,) is as in `HalfIntegrals`, `extent` (4,) is widened; `cut` gets y and dy/dv at the
    last cut.
    """
    column[:] = 0.0
    count = 0
    v0 = v1 = v2 = v3 = shell = girth = top = h0 = h1 = h2 = h3 = 0.0
    for s in range(size):
        if over[7, s] <= level:
            v0 += whole[0, at + s]
            v1 += whole[1, at + s]
            v2 += whole[2, at + s]
            v3 += whole[3, at + s]
            if deck[tile + s]:
                top += whole[4, at + s]
            else:
                shell += whole[4, at + s]
                girth += whole[5, at + s]
            if heeled:
                h0 += whole[7, at + s]
                h1 += whole[8, at + s]
                h2 += whole[9, at + s]
                h3 += whole[10, at + s]
    column[0], column[1], column[2], column[3] = v0, v1, v2, v3
    column[4], column[5], column[6] = shell, girth, top
    column[7], column[8], column[9], column[10] = h0, h1, h2, h3
    for s in range(size):
        if not over[8, s] <= level < over[9, s]:
            continue
        for k in range(_brackets(over, s, level, found)):
            u = _cut(over, s, level, found[k], limits, steps, trials)
            sign = 1.0 if found[k, 2] <= 0.0 else -1.0
            _part(u, sign, at + s, deck[tile + s], heeled, node, weight, rows, column)
            _add_cut(u, sign, at + s, trim, heel, limits[2], rows, column, extent, cut)
            count += 1
    return count


@jit_part
def _part(
    share: float, sign: float, s: int, deck: bool, heeled: bool, node: FloatArray,
    weight: FloatArray, rows: FloatArray, column: FloatArray,
) -> None:  # fmt: skip
    """Add the integrals of a tile from its beginning up to `share` of it: rows as `set_whole`."""
    shell = 0.0
    girth = 0.0
    for g in range(len(node)):
        u = share * node[g]
        x = ((rows[3, s] * u + rows[2, s]) * u + rows[1, s]) * u + rows[0, s]
        y = ((rows[7, s] * u + rows[6, s]) * u + rows[5, s]) * u + rows[4, s]
        z = ((rows[11, s] * u + rows[10, s]) * u + rows[9, s]) * u + rows[8, s]
        x_v = ((rows[15, s] * u + rows[14, s]) * u + rows[13, s]) * u + rows[12, s]
        y_v = ((rows[19, s] * u + rows[18, s]) * u + rows[17, s]) * u + rows[16, s]
        z_v = ((rows[23, s] * u + rows[22, s]) * u + rows[21, s]) * u + rows[20, s]
        x_u = (3.0 * u * rows[3, s] + 2.0 * rows[2, s]) * u + rows[1, s]
        y_u = (3.0 * u * rows[7, s] + 2.0 * rows[6, s]) * u + rows[5, s]
        z_u = (3.0 * u * rows[11, s] + 2.0 * rows[10, s]) * u + rows[9, s]
        n_x, n_y, n_z = y_u * z_v - z_u * y_v, z_u * x_v - x_u * z_v, x_u * y_v - y_u * x_v
        part = weight[g] * share
        flux = sign * part * y * n_y
        column[0] += flux
        column[1] += x * flux
        column[2] += 0.5 * y * flux
        column[3] += z * flux
        if heeled:
            flux = sign * part * y * n_z
            column[7] += flux
            column[8] += x * flux
            column[9] += 0.5 * y * flux
            column[10] += z * flux
        round_about = n_y * n_y + n_z * n_z
        shell += part * sqrt(n_x * n_x + round_about)
        girth += part * sqrt(round_about)
    if deck:
        column[6] += sign * shell
    else:
        column[4] += sign * shell
        column[5] += sign * girth


@jit_part
def _add_cut(
    u: float, sign: float, s: int, trim: float, heel: float, least: float, rows: FloatArray,
    column: FloatArray, extent: FloatArray, cut: FloatArray,
) -> None:  # fmt: skip
    """Add the waterline at a cut."""
    x = ((rows[3, s] * u + rows[2, s]) * u + rows[1, s]) * u + rows[0, s]
    y = ((rows[7, s] * u + rows[6, s]) * u + rows[5, s]) * u + rows[4, s]
    x_v = ((rows[15, s] * u + rows[14, s]) * u + rows[13, s]) * u + rows[12, s]
    y_v = ((rows[19, s] * u + rows[18, s]) * u + rows[17, s]) * u + rows[16, s]
    z_v = ((rows[23, s] * u + rows[22, s]) * u + rows[21, s]) * u + rows[20, s]
    x_u = rows[1, s] + u * (2.0 * rows[2, s] + u * (3.0 * rows[3, s]))
    y_u = rows[5, s] + u * (2.0 * rows[6, s] + u * (3.0 * rows[7, s]))
    z_u = rows[9, s] + u * (2.0 * rows[10, s] + u * (3.0 * rows[11, s]))
    steep, climb = z_u - trim * x_u + heel * y_u, z_v - trim * x_v + heel * y_v
    level = abs(steep) <= least * (abs(x_u) + abs(y_u) + abs(z_u))
    rate = 0.0 if level else climb / steep
    forward = x_v - x_u * rate
    area = y * forward
    half, along = 0.5 * y * area, x * area
    column[11] += sign * area
    column[12] += sign * along
    column[13] += sign * half
    column[14] += sign * (x * along)
    column[15] += sign * (x * half)
    column[16] += sign * ((2.0 / 3.0) * y * half)
    extent[0], extent[1] = min(extent[0], x), max(extent[1], x)
    extent[2], extent[3] = min(extent[2], y), max(extent[3], y)
    cut[0], cut[1] = y, y_v - y_u * rate


# --------------------------------------------------------------------------------------
# Critical points: ends of curves, the deck's edge, and where heights are stationary.


@jit_part
def critical_points(size: int, edge: int, over: FloatArray, tiles: IntArray, u: FloatArray) -> int:
    """Set tile and u of the critical points of a curve: first its beginning, then its end."""
    tiles[0], u[0], tiles[1], u[1] = 0, 0.0, size - 1, 1.0
    count = 2
    if edge >= 0:
        tiles[count], u[count] = edge, 0.0
        count += 1
    for s in range(size):
        if s > 0:
            into, out = over[7, s - 1] - over[6, s - 1], over[5, s] - over[4, s]
            if into * out < 0.0:
                tiles[count], u[count] = s, 0.0
                count += 1
        if _wavy(over, s):
            lower, upper = _stationary(over[1, s], over[2, s], over[3, s])
            if lower > 0.0:
                tiles[count], u[count] = s, lower
                count += 1
            if upper < 1.0:
                tiles[count], u[count] = s, upper
                count += 1
    return count


@jit_part
def critical_value(row: FloatArray, s: int, u: float) -> float:
    """Evaluate one cubic of four rows."""
    value: float = ((row[3, s] * u + row[2, s]) * u + row[1, s]) * u + row[0, s]
    return value

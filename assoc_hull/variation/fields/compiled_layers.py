"""Layers of a map, compiled: the bits of the numpy of layers, fields and functions.

The numbers of a map are those of a `FlatMap`, which see for what stands where. Places are taken in
blocks, and what needs no decision runs over a block in short loops, which the compiler turns into
vector instructions (these change no bit). A block is held by coordinates: (3, b). As for
`compiled_program`, arrays come in one by one, and read-only where they are read only.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.jit import jit
from assoc_hull.model.program.compiled_program import read_only

__all__ = ["blend", "blend_slope", "clipped", "map_layers", "set_slopes", "set_values"]

_BLOCK = 256

# --------------------------------------------------------------------------------------
# Blends, and functions of one coordinate. Comparisons are such that what is no number stays none.


@jit
def _within(s: float) -> float:
    if s <= 0.0:
        return 0.0
    return 1.0 if s >= 1.0 else s


@jit
def clipped(s: float, low: float, high: float) -> float:
    """Give what `np.clip` gives: a negative zero stays one."""
    if s < low:
        return low
    return high if s > high else s


@jit
def blend(kind: int, s: float) -> float:
    """Give a cubic (0) or quintic (1) blend, as `Blend.value`."""
    s = _within(s)
    if kind == 0:
        return s * s * (3.0 - 2.0 * s)
    return s * s * s * (10.0 + s * (6.0 * s - 15.0))


@jit
def blend_slope(kind: int, s: float) -> float:
    """Give the slope of a cubic (0) or quintic (1) blend, as `Blend.slope`."""
    s = _within(s)
    part = s * (1.0 - s)
    return 6.0 * part if kind == 0 else 30.0 * part * part


@jit
def _ramp(kind: int, t: float) -> float:
    s = _within(t)
    if kind == 0:
        rise = s * s * s * (1.0 - 0.5 * s)
    else:
        rise = s * s * s * s * (2.5 + s * (s - 3.0))
    return t - 0.5 if t > 1.0 else rise


@jit
def _power(x: float, m: int) -> float:
    """Give a power from 0 to 3."""
    if m == 0:
        return 1.0
    if m == 1:
        return x
    return x * x if m == 2 else x * x * x


@jit
def _set_horner(
    number: FloatArray, begin: int, count: int, x: FloatArray, out: FloatArray, n: int
) -> None:
    for i in range(n):
        out[i] = 0.0 + number[begin + count - 1]
    for k in range(begin + count - 2, begin - 1, -1):
        c = number[k]
        for i in range(n):
            out[i] = out[i] * x[i] + c


@jit
def set_values(
    code: IntArray, number: FloatArray, f: int, x: FloatArray, out: FloatArray, n: int
) -> None:
    """Set the values of a function at the first n of some places."""
    kind, count, choice, begin = code[f], code[f + 1], code[f + 2], code[f + 3]
    last = begin + count - 1
    if kind == 0:
        value = number[begin]
        for i in range(n):
            out[i] = value
    elif kind == 1 and count == 2:
        first, end, value, beyond = (
            number[begin],
            number[begin + 1],
            number[begin + 2],
            number[begin + 3],
        )
        width, rise = number[begin + 4], number[begin + 5]
        for i in range(n):
            inner = value + rise * blend(choice, (x[i] - first) / width)
            out[i] = beyond if x[i] >= end else inner
    elif kind == 1:
        for i in range(n):
            j = begin
            while j < last - 1 and not x[i] < number[j + 1]:
                j += 1
            s = (x[i] - number[j]) / number[j + 2 * count]
            inner = number[j + count] + number[j + 3 * count - 1] * blend(choice, s)
            out[i] = number[last + count] if x[i] >= number[last] else inner
    elif kind == 2:
        for i in range(n):
            j = begin
            while j < last - 1 and not x[i] < number[j + 1]:
                j += 1
            within = clipped(x[i], number[begin], number[last])
            inner = number[j + count] + (within - number[j]) * number[j + 2 * count]
            inner = number[begin + count] if x[i] <= number[begin] else inner
            out[i] = number[last + count] if x[i] >= number[last] else inner
    elif kind == 3:
        _set_horner(number, begin, count, x, out, n)
    elif kind == 4:
        for i in range(n):
            t = (x[i] - number[begin]) / number[begin + 1]
            out[i] = number[begin + 3] * _ramp(choice, t)
    else:
        for i in range(n):
            xi = clipped((x[i] - number[begin]) / number[begin + 1], 0.0, 1.0)
            rise = number[begin + 3] * _power(xi, count) * _power(1.0 - xi, choice)
            out[i] = number[begin + 2] * rise


@jit
def set_slopes(
    code: IntArray, number: FloatArray, f: int, x: FloatArray, out: FloatArray, n: int
) -> None:
    """Set the slopes of a function at the first n of some places."""
    kind, count, choice, begin = code[f], code[f + 1], code[f + 2], code[f + 3]
    last = begin + count - 1
    if kind == 0:
        for i in range(n):
            out[i] = 0.0
    elif kind == 1 and count == 2:
        first, width, rise = number[begin], number[begin + 4], number[begin + 5]
        for i in range(n):
            out[i] = rise * blend_slope(choice, (x[i] - first) / width) / width
    elif kind == 1:
        for i in range(n):
            j = begin
            while j < last - 1 and not x[i] < number[j + 1]:
                j += 1
            width = number[j + 2 * count]
            rise = number[j + 3 * count - 1] * blend_slope(choice, (x[i] - number[j]) / width)
            out[i] = rise / width
    elif kind == 2:
        for i in range(n):
            j = begin
            while j < last - 1 and not x[i] < number[j + 1]:
                j += 1
            inside = x[i] >= number[begin] and x[i] < number[last]
            out[i] = number[j + 2 * count] if inside else 0.0
    elif kind == 3:
        _set_horner(number, begin + count, choice, x, out, n)
    elif kind == 4:
        for i in range(n):
            s = (x[i] - number[begin]) / number[begin + 1]
            out[i] = number[begin + 2] * blend(choice, s)
    else:
        for i in range(n):
            xi = clipped((x[i] - number[begin]) / number[begin + 1], 0.0, 1.0)
            rise = _power(xi, count - 1) * _power(1.0 - xi, choice - 1)
            rise = number[begin + 4] * (rise * (count * (1.0 - xi) - choice * xi))
            out[i] = rise if xi > 0.0 and xi < 1.0 else 0.0


# --------------------------------------------------------------------------------------
# Fields. `room` (16, b) has rows to work in, `index` (2, b) which places of the block lie in the
# region, and the boundary next below each of them.


@jit
def _gather(
    number: FloatArray, begin: int, p: FloatArray, m: int, q: FloatArray, index: IntArray
) -> int:
    """Set which places of a block lie in the region of a field; an infinite end bounds nothing."""
    from_x, to_x, from_z, to_z = (
        number[begin],
        number[begin + 1],
        number[begin + 2],
        number[begin + 3],
    )
    no_x, no_end, no_z, no_top = (
        not from_x > -np.inf,
        not to_x < np.inf,
        not from_z > -np.inf,
        not to_z < np.inf,
    )
    n = 0
    for i in range(m):
        x, z = p[0, i], p[2, i]
        if (
            (no_x or x >= from_x) and (no_end or x <= to_x)
            and (no_z or z >= from_z) and (no_top or z <= to_z)
        ):  # fmt: skip
            index[0, n] = i
            q[0, n], q[1, n], q[2, n] = x, p[1, i], z
            n += 1
    return n


@jit
def _set_own(
    number: FloatArray, begin: int, tube: int, c: FloatArray, own: FloatArray, slope: FloatArray,
    n: int,
) -> None:  # fmt: skip
    """Set the coordinate that pieces act on, and its slope by the place's; c may be `own`."""
    if tube < 0:
        for i in range(n):
            own[i], slope[i] = c[i], 1.0
        return
    radius, more, wide = number[begin + 4], number[begin + 5], number[begin + 6]
    for i in range(n):
        out = abs(c[i])
        s = (out / radius - 1.0) / more
        left = 1.0 - blend(tube, s)
        slope[i] = left - blend_slope(tube, s) * out / wide
        own[i] = c[i] * left


@jit
def _set_strips(
    code: IntArray, number: FloatArray, f: int, q: FloatArray, height: FloatArray, low: IntArray,
    s: FloatArray, n: int,
) -> None:  # fmt: skip
    """Set the heights of all boundaries, the one next below, and the part of the strip."""
    count, z = code[f + 2], q[2]
    for i in range(n):
        low[i] = 0
    for k in range(count):
        h = height[k]
        set_values(code, number, code[f + 5 + 3 * k], q[0], h, n)
        for i in range(n):
            low[i] += h[i] <= z[i]
    for i in range(n):
        below = max(low[i] - 1, 0)
        low[i] = below
        foot, top = height[below, i], height[min(below + 1, count - 1), i]
        s[i] = clipped((z[i] - foot) / (top - foot), 0.0, 1.0) if top > foot else 0.0


@jit
def _add_stacked(
    code: IntArray, number: FloatArray, f: int, p: FloatArray, m: int, moved: FloatArray,
    room: FloatArray, height: FloatArray, index: IntArray,
) -> None:  # fmt: skip
    """Add the displacement of a field with boundaries."""
    axis, count = code[f + 1], code[f + 2]
    begin = code[f + 5 + 3 * count]
    q, where, low = room[:3], index[0], index[1]
    n = _gather(number, begin, p, m, q, index)
    if n == 0:
        return
    c, weight, u, a, d, aside = room[3], room[4], room[5], room[6], room[7], room[8]
    _set_own(number, begin, code[f + 4], q[axis], c, aside, n)
    _set_strips(code, number, f, q, height, low, weight, n)
    kind = code[f + 3]
    for i in range(n):
        weight[i] = blend(kind, weight[i])
    for k in range(count):
        used = 0
        for i in range(n):
            used += (low[i] == k) | ((low[i] == k - 1) & (weight[i] > 0.0))
        if used == 0:
            continue
        set_values(code, number, code[f + 6 + 3 * k], q[0], a, n)
        set_values(code, number, code[f + 7 + 3 * k], q[0], d, n)
        pivot = number[begin + 7 + k]
        for i in range(n):
            e = a[i] * (c[i] - pivot) + d[i]
            if low[i] == k:
                u[i] = e
            elif low[i] == k - 1 and weight[i] > 0.0:
                u[i] = u[i] + (e - u[i]) * weight[i]
    to = moved[axis]
    for i in range(n):
        to[where[i]] += u[i]


@jit
def _add_stacked_slopes(
    code: IntArray, number: FloatArray, f: int, p: FloatArray, m: int, found: FloatArray,
    room: FloatArray, height: FloatArray, index: IntArray,
) -> None:  # fmt: skip
    """Add the derivatives of a field with boundaries to rows of Jacobians (9, b)."""
    axis, count = code[f + 1], code[f + 2]
    begin = code[f + 5 + 3 * count]
    q, where, low = room[:3], index[0], index[1]
    n = _gather(number, begin, p, m, q, index)
    if n == 0:
        return
    c, s, a, d, a_x, d_x, by_own = room[3], room[4], room[5], room[6], room[7], room[8], room[9]
    e, f_ = room[10:13], room[13:16]
    h_x, g_x = room[16], room[17]
    _set_own(number, begin, code[f + 4], q[axis], c, by_own, n)
    _set_strips(code, number, f, q, height, low, s, n)
    for k in range(count):
        used = 0
        for i in range(n):
            used += (low[i] == k) | (min(low[i] + 1, count - 1) == k)
        if used == 0:
            continue
        set_values(code, number, code[f + 6 + 3 * k], q[0], a, n)
        set_values(code, number, code[f + 7 + 3 * k], q[0], d, n)
        set_slopes(code, number, code[f + 6 + 3 * k], q[0], a_x, n)
        set_slopes(code, number, code[f + 7 + 3 * k], q[0], d_x, n)
        pivot = number[begin + 7 + k]
        for i in range(n):
            lever = c[i] - pivot
            d[i] = a[i] * lever + d[i]
            d_x[i] = a_x[i] * lever + d_x[i]
        set_slopes(code, number, code[f + 5 + 3 * k], q[0], a_x, n)
        for i in range(n):
            if low[i] == k:
                e[0, i], e[1, i], e[2, i], h_x[i] = d[i], d_x[i], a[i], a_x[i]
            if min(low[i] + 1, count - 1) == k:
                f_[0, i], f_[1, i], f_[2, i], g_x[i] = d[i], d_x[i], a[i], a_x[i]
    kind, row = code[f + 3], 3 * axis
    for i in range(n):
        high = min(low[i] + 1, count - 1)
        g = height[high, i] - height[low[i], i] if high > low[i] else 1.0
        b, turn = blend(kind, s[i]), blend_slope(kind, s[i]) * (f_[0, i] - e[0, i])
        own = e[2, i] + (f_[2, i] - e[2, i]) * b
        along = e[1, i] + (f_[1, i] - e[1, i]) * b
        along = along - turn * (h_x[i] + s[i] * (g_x[i] - h_x[i])) / g
        j = where[i]
        found[row, j] += along + (own if axis == 0 else 0.0)
        if axis == 1:
            found[row + 1, j] += own * by_own[i]
        found[row + 2, j] += turn / g + (own if axis == 2 else 0.0)


# --------------------------------------------------------------------------------------
# Layers.


@jit
def _set_skew(
    number: FloatArray, begin: int, p: FloatArray, eta: FloatArray, zeta: FloatArray, m: int
) -> None:
    """Set the coordinates of places from the corner of a corner layer."""
    for i in range(m):
        inward = number[begin] - abs(p[1, i])
        eta[i] = inward / number[begin + 2]
        zeta[i] = p[2, i] - number[begin + 1] + inward * number[begin + 4]


@jit
def _set_keel_ramp(
    code: IntArray, number: FloatArray, layer: int, y: FloatArray, ramp: FloatArray,
    rise: FloatArray, m: int,
) -> None:  # fmt: skip
    """Set the ramp of a deadrise layer, and its derivative by the half-breadth."""
    begin, kind = code[layer + 4], code[layer + 3]
    keel, width = number[begin + 1], number[begin + 2]
    for i in range(m):
        out = abs(y[i]) - keel
        if width == 0.0:
            ramp[i] = 0.0 if out <= 0.0 else out
            rise[i] = 1.0 if out >= 0.0 else 0.0
        else:
            t = out / width
            ramp[i] = width * _ramp(kind, t)
            rise[i] = blend(kind, t)


@jit
def _set_three(
    code: IntArray, number: FloatArray, three: int, p: FloatArray, out: FloatArray,
    room: FloatArray, m: int,
) -> None:  # fmt: skip
    """Set the values of three functions, of x, the half-breadth and z."""
    half = room[0]
    for i in range(m):
        half[i] = abs(p[1, i])
    set_values(code, number, code[three], p[0], out[0], m)
    set_values(code, number, code[three + 1], half, out[1], m)
    set_values(code, number, code[three + 2], p[2], out[2], m)


@jit
def _move(
    code: IntArray, number: FloatArray, layer: int, p: FloatArray, m: int, moved: FloatArray,
    room: FloatArray, height: FloatArray, index: IntArray,
) -> None:  # fmt: skip
    """Move the places of a block, (3, b), by a layer."""
    for k in range(3):
        for i in range(m):
            moved[k, i] = 0.0
    kind = code[layer]
    if kind == 0:
        for k in range(code[layer + 1]):
            f = code[layer + 2 + k]
            if code[f] == 0:
                _add_stacked(code, number, f, p, m, moved, room, height, index)
                continue
            begin, a = code[f + 4], room[0]
            set_values(code, number, code[f + 2], p[0], a, m)
            for i in range(m):
                t = (p[2, i] - number[begin + 1]) / number[begin + 2]
                moved[0, i] += a[i] * number[begin + 3] * _ramp(code[f + 3], t)
    elif kind == 1:
        begin = code[layer + 3]
        eta, zeta, a, c, e = room[0], room[1], room[2], room[3], room[4]
        _set_skew(number, begin, p, eta, zeta, m)
        set_values(code, number, code[layer + 1], p[0], a, m)
        set_values(code, number, code[layer + 2], eta, c, m)
        set_values(code, number, code[layer + 2], zeta, e, m)
        for i in range(m):
            side = -1.0 if p[1, i] < 0.0 else 1.0
            weight = a[i] * c[i] * e[i]
            along = number[begin + 5] * weight * eta[i]
            moved[1, i] = -side * along * number[begin + 2]
            moved[2, i] = number[begin + 6] * weight * zeta[i] - along * number[begin + 3]
    elif kind == 2:
        begin = code[layer + 4]
        ramp, rise, a, c = room[0], room[1], room[2], room[3]
        _set_keel_ramp(code, number, layer, p[1], ramp, rise, m)
        set_values(code, number, code[layer + 1], p[0], a, m)
        set_values(code, number, code[layer + 2], p[2], c, m)
        for i in range(m):
            moved[2, i] = a[i] * number[begin] * ramp[i] * c[i]
    else:
        if code[layer + 1] >= 0:
            set_values(code, number, code[layer + 1], p[0], moved[0], m)
        three = room[1:4]
        for axis in range(1, 3):
            if code[layer + 3 * axis - 1] < 0:
                continue
            _set_three(code, number, layer + 3 * axis - 1, p, three, room, m)
            for i in range(m):
                u = three[0, i] * three[1, i] * three[2, i]
                moved[axis, i] = (-1.0 if p[1, i] < 0.0 else 1.0) * u if axis == 1 else u
    for k in range(3):
        for i in range(m):
            p[k, i] = p[k, i] + moved[k, i]


@jit
def _add_corner_slopes(
    code: IntArray, number: FloatArray, layer: int, p: FloatArray, m: int, found: FloatArray,
    room: FloatArray,
) -> None:  # fmt: skip
    """Add what a corner layer does to rows of Jacobians (9, b)."""
    begin = code[layer + 3]
    cos, sin, tan = number[begin + 2], number[begin + 3], number[begin + 4]
    eta, zeta, a, c, k, a_x, c_eta, k_zeta = (
        room[0], room[1], room[2], room[3], room[4], room[5], room[6], room[7]
    )  # fmt: skip
    _set_skew(number, begin, p, eta, zeta, m)
    set_values(code, number, code[layer + 1], p[0], a, m)
    set_values(code, number, code[layer + 2], eta, c, m)
    set_values(code, number, code[layer + 2], zeta, k, m)
    set_slopes(code, number, code[layer + 1], p[0], a_x, m)
    set_slopes(code, number, code[layer + 2], eta, c_eta, m)
    set_slopes(code, number, code[layer + 2], zeta, k_zeta, m)
    for i in range(m):
        side = -1.0 if p[1, i] < 0.0 else 1.0
        for turn in range(2):
            first = turn == 0
            size, lever = number[begin + 5 + turn], eta[i] if first else zeta[i]
            u, v = -side * cos if first else 0.0 * side, -sin if first else 1.0
            by_x = size * a_x[i] * c[i] * k[i] * lever
            by_eta = size * a[i] * k[i] * (c_eta[i] * lever + (c[i] if first else 0.0))
            by_zeta = size * a[i] * c[i] * (k_zeta[i] * lever + (0.0 if first else k[i]))
            by_y = -side * (by_eta / cos + by_zeta * tan)
            found[3, i] += u * by_x
            found[4, i] += u * by_y
            found[5, i] += u * by_zeta
            found[6, i] += v * by_x
            found[7, i] += v * by_y
            found[8, i] += v * by_zeta


@jit
def _set_layer_slopes(
    code: IntArray, number: FloatArray, layer: int, p: FloatArray, m: int, found: FloatArray,
    room: FloatArray, height: FloatArray, index: IntArray, unit: float,
) -> None:  # fmt: skip
    """Set the Jacobians of a layer at the places of a block, by rows: (9, b).

    The diagonal begins at `unit`: 1, or 0 for the derivatives of displacements alone.
    """
    for k in range(9):
        for i in range(m):
            found[k, i] = unit if k % 4 == 0 else 0.0
    kind = code[layer]
    if kind == 0:
        for k in range(code[layer + 1]):
            f = code[layer + 2 + k]
            if code[f] == 0:
                _add_stacked_slopes(code, number, f, p, m, found, room, height, index)
                continue
            begin, a, a_x = code[f + 4], room[0], room[1]
            set_values(code, number, code[f + 2], p[0], a, m)
            set_slopes(code, number, code[f + 2], p[0], a_x, m)
            for i in range(m):
                t = (p[2, i] - number[begin + 1]) / number[begin + 2]
                found[0, i] += a_x[i] * number[begin + 3] * _ramp(code[f + 3], t)
                found[2, i] += a[i] * number[begin] * blend(code[f + 3], t)
    elif kind == 1:
        _add_corner_slopes(code, number, layer, p, m, found, room)
    elif kind == 2:
        q = number[code[layer + 4]]
        ramp, rise, a, c, a_x, c_z = room[0], room[1], room[2], room[3], room[4], room[5]
        _set_keel_ramp(code, number, layer, p[1], ramp, rise, m)
        set_values(code, number, code[layer + 1], p[0], a, m)
        set_values(code, number, code[layer + 2], p[2], c, m)
        set_slopes(code, number, code[layer + 1], p[0], a_x, m)
        set_slopes(code, number, code[layer + 2], p[2], c_z, m)
        for i in range(m):
            found[6, i] += a_x[i] * q * ramp[i] * c[i]
            found[7, i] += a[i] * q * (-rise[i] if p[1, i] < 0.0 else rise[i]) * c[i]
            found[8, i] += a[i] * q * ramp[i] * c_z[i]
    else:
        v, slope = room[1:4], room[4:7]
        if code[layer + 1] >= 0:
            set_slopes(code, number, code[layer + 1], p[0], slope[0], m)
            for i in range(m):
                found[0, i] += slope[0, i]
        for axis in range(1, 3):
            three = layer + 3 * axis - 1
            if code[three] < 0:
                continue
            _set_three(code, number, three, p, v, room, m)
            set_slopes(code, number, code[three], p[0], slope[0], m)
            set_slopes(code, number, code[three + 1], room[0], slope[1], m)
            set_slopes(code, number, code[three + 2], p[2], slope[2], m)
            for i in range(m):
                side = -1.0 if p[1, i] < 0.0 else 1.0
                outer, inner = (side, 1.0) if axis == 1 else (1.0, side)
                found[3 * axis, i] += slope[0, i] * v[1, i] * v[2, i] * outer
                found[3 * axis + 1, i] += v[0, i] * slope[1, i] * v[2, i] * inner
                found[3 * axis + 2, i] += v[0, i] * v[1, i] * slope[2, i] * outer


# --------------------------------------------------------------------------------------
# Maps.


@jit
def _chain(own: FloatArray, whole: FloatArray, m: int) -> None:
    """Multiply Jacobians of a layer by those of all before it, by rows; numpy's sums begin at 0."""
    for k in range(3):
        for i in range(m):
            a, b, c = whole[k, i], whole[k + 3, i], whole[k + 6, i]
            whole[k, i] = 0.0 + own[0, i] * a + own[1, i] * b + own[2, i] * c
            whole[k + 3, i] = 0.0 + own[3, i] * a + own[4, i] * b + own[5, i] * c
            whole[k + 6, i] = 0.0 + own[6, i] * a + own[7, i] * b + own[8, i] * c


@jit
def map_layers(
    code: IntArray, number: FloatArray, xyz: FloatArray, image: FloatArray, slope: FloatArray
) -> None:
    """Set where layers take places (n, 3), m, and their Jacobians, (n, 3, 3).

    What is not asked for has no rows.
    """
    size = max(min(len(xyz), _BLOCK), 1)
    p, moved, room = np.empty((3, size)), np.empty((3, size)), np.empty((18, size))
    height, index = np.empty((code[6], size)), np.empty((2, size), np.int64)
    wanted, sloped = len(image) > 0, len(slope) > 0
    rows = 9 if sloped else 0
    own, whole = np.empty((rows, size)), np.empty((rows, size))
    for begin in range(0, len(xyz), size):
        m = min(size, len(xyz) - begin)
        for i in range(m):
            p[0, i], p[1, i], p[2, i] = xyz[begin + i, 0], xyz[begin + i, 1], xyz[begin + i, 2]
        for k in range(rows):
            for i in range(m):
                whole[k, i] = 1.0 if k % 4 == 0 else 0.0
        for n in range(code[0]):
            layer = code[code[1] + n]
            if sloped:
                _set_layer_slopes(code, number, layer, p, m, own, room, height, index, 1.0)
                _chain(own, whole, m)
            if wanted or n + 1 < code[0]:
                _move(code, number, layer, p, m, moved, room, height, index)
        if wanted:
            for i in range(m):
                for k in range(3):
                    image[begin + i, k] = p[k, i]
        if sloped:
            for i in range(m):
                for k in range(9):
                    slope[begin + i, k // 3, k % 3] = whole[k, i]


@jit
def set_displacement_slopes(
    code: IntArray, number: FloatArray, xyz: FloatArray, slope: FloatArray
) -> None:
    """Set the derivatives of what the first layer adds to places (n, 3), as (n, 3, 3)."""
    slope[:] = 0.0
    if code[0] == 0:
        return
    size = max(min(len(xyz), _BLOCK), 1)
    p, room, own = np.empty((3, size)), np.empty((18, size)), np.empty((9, size))
    height, index = np.empty((code[6], size)), np.empty((2, size), np.int64)
    for begin in range(0, len(xyz), size):
        m = min(size, len(xyz) - begin)
        for i in range(m):
            p[0, i], p[1, i], p[2, i] = xyz[begin + i, 0], xyz[begin + i, 1], xyz[begin + i, 2]
        _set_layer_slopes(code, number, code[code[1]], p, m, own, room, height, index, 0.0)
        for i in range(m):
            for k in range(9):
                slope[begin + i, k // 3, k % 3] = own[k, i]


def displacement_slopes_at(code: IntArray, number: FloatArray, xyz: FloatArray) -> FloatArray:
    """Give the derivatives of what the first layer adds to places (n, 3), as (n, 3, 3)."""
    found = np.empty((*xyz.shape, 3))
    set_displacement_slopes(code, number, read_only(np.ascontiguousarray(xyz, np.float64)), found)
    return found

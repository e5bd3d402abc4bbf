"""Maps with their bilges and circles, compiled: the bits of the numpy of layers and features.

All is done place by place, in the order of operations of `variation.fields`, `BilgeMap` and
`FeatureMap`. Sines, cosines and angles of bilges come from numpy, which has its own: what a place
needs of them is gathered first, and used afterwards. As for `compiled_program`, arrays come in one
by one and read-only; the numbers of a map are those of a `FlatMap`.
"""

from __future__ import annotations

from math import sqrt

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.jit import jit, was_loaded
from assoc_hull.model.program.compiled_program import read_only
from assoc_hull.variation.features.flat_map import FlatMap

__all__ = ["CompiledMap", "warm"]

Vector = tuple[float, float, float]

# --------------------------------------------------------------------------------------
# Blends, and functions of one coordinate. Comparisons are such that what is no number stays none.


@jit
def _within(s: float) -> float:
    if s <= 0.0:
        return 0.0
    return 1.0 if s >= 1.0 else s


@jit
def _clipped(s: float, low: float, high: float) -> float:
    """Give what `np.clip` gives: a negative zero stays one."""
    if s < low:
        return low
    return high if s > high else s


@jit
def _blend(kind: int, s: float) -> float:
    s = _within(s)
    if kind == 0:
        return s * s * (3.0 - 2.0 * s)
    return s * s * s * (10.0 + s * (6.0 * s - 15.0))


@jit
def _blend_slope(kind: int, s: float) -> float:
    s = _within(s)
    part = s * (1.0 - s)
    return 6.0 * part if kind == 0 else 30.0 * part * part


@jit
def _ramp(kind: int, t: float) -> float:
    if t > 1.0:
        return t - 0.5
    s = _within(t)
    if kind == 0:
        return s * s * s * (1.0 - 0.5 * s)
    return s * s * s * s * (2.5 + s * (s - 3.0))


@jit
def _power(x: float, m: int) -> float:
    """Give a power from 0 to 3."""
    if m == 0:
        return 1.0
    if m == 1:
        return x
    return x * x if m == 2 else x * x * x


@jit
def _piece(number: FloatArray, first: int, last: int, x: float) -> int:
    """Give how many of some rising nodes are no greater than x; all, where x is no number."""
    low, high = first, last
    while low < high:
        middle = (low + high) // 2
        if x < number[middle]:
            high = middle
        else:
            low = middle + 1
    return low - first


@jit
def _at(code: IntArray, number: FloatArray, f: int, x: float) -> float:
    """Give the value of a function; level ones are told at once."""
    kind, count, begin = code[f], code[f + 1], code[f + 3]
    if kind == 0:
        return number[begin]
    if kind == 1:
        if x >= number[begin + count - 1]:
            return number[begin + 2 * count - 1]
        i = begin + _piece(number, begin + 1, begin + count - 1, x)
        s = (x - number[i]) / number[i + 2 * count]
        return number[i + count] + number[i + 3 * count - 1] * _blend(code[f + 2], s)
    if kind == 2:
        if x >= number[begin + count - 1]:
            return number[begin + 2 * count - 1]
        if x <= number[begin]:
            return number[begin + count]
        i = begin + min(max(_piece(number, begin, begin + count, x) - 1, 0), count - 2)
        within = _clipped(x, number[begin], number[begin + count - 1])
        return number[i + count] + (within - number[i]) * number[i + 2 * count]
    if kind == 3:
        return _horner(number, begin, count, x)
    if kind == 4:
        t = (x - number[begin]) / number[begin + 1]
        return number[begin + 3] * _ramp(code[f + 2], t)
    xi = _clipped((x - number[begin]) / number[begin + 1], 0.0, 1.0)
    rise = number[begin + 3] * _power(xi, count) * _power(1.0 - xi, code[f + 2])
    return number[begin + 2] * rise


@jit
def _slope(code: IntArray, number: FloatArray, f: int, x: float) -> float:
    """Give the slope of a function."""
    kind, count, begin = code[f], code[f + 1], code[f + 3]
    if kind == 0:
        return 0.0
    if kind == 1:
        i = begin + _piece(number, begin + 1, begin + count - 1, x)
        width = number[i + 2 * count]
        s = (x - number[i]) / width
        return number[i + 3 * count - 1] * _blend_slope(code[f + 2], s) / width
    if kind == 2:
        if not (x >= number[begin] and x < number[begin + count - 1]):
            return 0.0
        return number[begin + 2 * count + _piece(number, begin, begin + count, x) - 1]
    if kind == 3:
        return _horner(number, begin + count, code[f + 2], x)
    if kind == 4:
        return number[begin + 2] * _blend(code[f + 2], (x - number[begin]) / number[begin + 1])
    xi = _clipped((x - number[begin]) / number[begin + 1], 0.0, 1.0)
    if not (xi > 0.0 and xi < 1.0):
        return 0.0
    m, n = count, code[f + 2]
    rise = _power(xi, m - 1) * _power(1.0 - xi, n - 1) * (m * (1.0 - xi) - n * xi)
    return number[begin + 4] * rise


@jit
def _horner(number: FloatArray, begin: int, count: int, x: float) -> float:
    value = 0.0 + number[begin + count - 1]
    for k in range(count - 2, -1, -1):
        value = value * x + number[begin + k]
    return value


# --------------------------------------------------------------------------------------
# Fields.


@jit
def _own(code: IntArray, number: FloatArray, f: int, begin: int, c: float) -> float:
    """Give the coordinate that pieces act on."""
    if code[f + 4] < 0:
        return c
    s = (abs(c) / number[begin + 4] - 1.0) / number[begin + 5]
    return c * (1.0 - _blend(code[f + 4], s))


@jit
def _own_slope(code: IntArray, number: FloatArray, f: int, begin: int, c: float) -> float:
    if code[f + 4] < 0:
        return 1.0
    s = (abs(c) / number[begin + 4] - 1.0) / number[begin + 5]
    fade = _blend_slope(code[f + 4], s) * abs(c) / number[begin + 6]
    return 1.0 - _blend(code[f + 4], s) - fade


@jit
def _touched(number: FloatArray, begin: int, x: float, z: float) -> bool:
    """Tell whether a place lies in the region; an end at infinity bounds nothing."""
    found = not number[begin] > -np.inf or x >= number[begin]
    found = found and (not number[begin + 1] < np.inf or x <= number[begin + 1])
    found = found and (not number[begin + 2] > -np.inf or z >= number[begin + 2])
    return found and (not number[begin + 3] < np.inf or z <= number[begin + 3])


@jit
def _strip(
    code: IntArray, number: FloatArray, f: int, x: float, z: float
) -> tuple[int, float, float, float]:
    """Give the boundary next below, the part of the strip, and the heights of both boundaries."""
    count = code[f + 2]
    below = 0
    for k in range(count):
        below += _at(code, number, code[f + 5 + 3 * k], x) <= z
    low = max(below - 1, 0)
    high = min(low + 1, count - 1)
    foot = _at(code, number, code[f + 5 + 3 * low], x)
    top = _at(code, number, code[f + 5 + 3 * high], x)
    if not top > foot:
        return low, 0.0, foot, top
    return low, _clipped((z - foot) / (top - foot), 0.0, 1.0), foot, top


@jit
def _stacked(code: IntArray, number: FloatArray, f: int, p: Vector) -> float:
    """Give the displacement of a field with boundaries."""
    count = code[f + 2]
    begin = code[f + 5 + 3 * count]
    x, y, z = p
    if not _touched(number, begin, x, z):
        return 0.0
    c = _own(code, number, f, begin, x if code[f + 1] == 0 else (y if code[f + 1] == 1 else z))
    low, s, _, _ = _strip(code, number, f, x, z)
    weight = _blend(code[f + 3], s)
    piece = f + 6 + 3 * low
    a, d = _at(code, number, code[piece], x), _at(code, number, code[piece + 1], x)
    u = a * (c - number[begin + 7 + low]) + d
    if weight > 0.0 and low + 1 < count:
        a, d = _at(code, number, code[piece + 3], x), _at(code, number, code[piece + 4], x)
        e = a * (c - number[begin + 8 + low]) + d
        u = u + (e - u) * weight
    return u


@jit
def _chosen(
    code: IntArray, number: FloatArray, f: int, begin: int, k: int, x: float, c: float
) -> Vector:
    """Give a piece and its derivatives by x and by its coordinate."""
    piece = f + 6 + 3 * k
    lever = c - number[begin + 7 + k]
    by_c = _at(code, number, code[piece], x)
    e = by_c * lever + _at(code, number, code[piece + 1], x)
    by_x = _slope(code, number, code[piece], x) * lever + _slope(code, number, code[piece + 1], x)
    return e, by_x, by_c


@jit
def _stacked_gradient(code: IntArray, number: FloatArray, f: int, p: Vector) -> Vector:
    """Give the derivatives of a field with boundaries."""
    count, axis = code[f + 2], code[f + 1]
    begin = code[f + 5 + 3 * count]
    x, y, z = p
    if not _touched(number, begin, x, z):
        return 0.0, 0.0, 0.0
    at = x if axis == 0 else (y if axis == 1 else z)
    c = _own(code, number, f, begin, at)
    low, s, h, top = _strip(code, number, f, x, z)
    high = min(low + 1, count - 1)
    e, e_x, e_c = _chosen(code, number, f, begin, low, x, c)
    g, e2, e2_x, e2_c = 1.0, e, e_x, e_c
    h_x = _slope(code, number, code[f + 5 + 3 * low], x)
    g_x = h_x - h_x
    if high > low:
        e2, e2_x, e2_c = _chosen(code, number, f, begin, high, x, c)
        g = top - h
        g_x = _slope(code, number, code[f + 5 + 3 * high], x) - h_x
    b, turn = _blend(code[f + 3], s), _blend_slope(code[f + 3], s) * (e2 - e)
    own = e_c + (e2_c - e_c) * b
    along = e_x + (e2_x - e_x) * b - turn * (h_x + s * g_x) / g
    by_x = along + (own if axis == 0 else 0.0)
    by_z = turn / g + (own if axis == 2 else 0.0)
    if axis == 1:
        return by_x, own * _own_slope(code, number, f, begin, at), by_z
    return by_x, 0.0, by_z


@jit
def _field(code: IntArray, number: FloatArray, f: int, p: Vector) -> float:
    """Give the displacement of a field."""
    if code[f] == 0:
        return _stacked(code, number, f, p)
    begin = code[f + 4]
    t = (p[2] - number[begin + 1]) / number[begin + 2]
    return _at(code, number, code[f + 2], p[0]) * number[begin + 3] * _ramp(code[f + 3], t)


@jit
def _field_gradient(code: IntArray, number: FloatArray, f: int, p: Vector) -> Vector:
    """Give the derivatives of a field."""
    if code[f] == 0:
        return _stacked_gradient(code, number, f, p)
    begin = code[f + 4]
    t = (p[2] - number[begin + 1]) / number[begin + 2]
    by_x = _slope(code, number, code[f + 2], p[0]) * number[begin + 3] * _ramp(code[f + 3], t)
    by_z = _at(code, number, code[f + 2], p[0]) * number[begin] * _blend(code[f + 3], t)
    return by_x, 0.0, by_z


# --------------------------------------------------------------------------------------
# Layers.


@jit
def _keel_ramp(code: IntArray, number: FloatArray, layer: int, y: float) -> tuple[float, float]:
    """Give the ramp of a deadrise layer, and its derivative by the half-breadth."""
    begin = code[layer + 4]
    out, width = abs(y) - number[begin + 1], number[begin + 2]
    if width == 0.0:
        return (0.0 if out <= 0.0 else out), (1.0 if out >= 0.0 else 0.0)
    t = out / width
    return width * _ramp(code[layer + 3], t), _blend(code[layer + 3], t)


@jit
def _product(code: IntArray, number: FloatArray, three: int, x: float, y: float, z: float) -> float:
    """Give the product of three functions whose places stand behind one another."""
    first, second = _at(code, number, code[three], x), _at(code, number, code[three + 1], y)
    return first * second * _at(code, number, code[three + 2], z)


@jit
def _product_slopes(
    code: IntArray, number: FloatArray, three: int, x: float, y: float, z: float
) -> Vector:
    first, second = _at(code, number, code[three], x), _at(code, number, code[three + 1], y)
    third = _at(code, number, code[three + 2], z)
    return (
        _slope(code, number, code[three], x) * second * third,
        first * _slope(code, number, code[three + 1], y) * third,
        first * second * _slope(code, number, code[three + 2], z),
    )


@jit
def _displacement(code: IntArray, number: FloatArray, layer: int, p: Vector) -> Vector:
    """Give by how much a layer moves a place."""
    dx, dy, dz = 0.0, 0.0, 0.0
    x, y, z = p
    side = -1.0 if y < 0.0 else 1.0
    if code[layer] == 0:
        for k in range(code[layer + 1]):
            f = code[layer + 2 + k]
            u = _field(code, number, f, p)
            if code[f + 1] == 0:
                dx += u
            elif code[f + 1] == 1:
                dy += u
            else:
                dz += u
    elif code[layer] == 1:
        begin = code[layer + 3]
        cos, sin, tan = number[begin + 2], number[begin + 3], number[begin + 4]
        inward = number[begin] - abs(y)
        eta, zeta = inward / cos, z - number[begin + 1] + inward * tan
        weight = _at(code, number, code[layer + 1], x) * _at(code, number, code[layer + 2], eta)
        weight = weight * _at(code, number, code[layer + 2], zeta)
        along = number[begin + 5] * weight * eta
        dy = -side * along * cos
        dz = number[begin + 6] * weight * zeta - along * sin
    elif code[layer] == 2:
        ramp, _ = _keel_ramp(code, number, layer, y)
        dz = _at(code, number, code[layer + 1], x) * number[code[layer + 4]] * ramp
        dz = dz * _at(code, number, code[layer + 2], z)
    else:
        if code[layer + 1] >= 0:
            dx = _at(code, number, code[layer + 1], x)
        if code[layer + 2] >= 0:
            dy = side * _product(code, number, layer + 2, x, abs(y), z)
        if code[layer + 5] >= 0:
            dz = _product(code, number, layer + 5, x, abs(y), z)
    return dx, dy, dz


@jit
def _set_corner_slopes(
    code: IntArray, number: FloatArray, layer: int, p: Vector, found: FloatArray
) -> None:
    """Add to the unit matrix what a corner layer does."""
    begin = code[layer + 3]
    cos, sin, tan = number[begin + 2], number[begin + 3], number[begin + 4]
    x, y, z = p
    side = -1.0 if y < 0.0 else 1.0
    inward = number[begin] - abs(y)
    eta, zeta = inward / cos, z - number[begin + 1] + inward * tan
    a, a_x = _at(code, number, code[layer + 1], x), _slope(code, number, code[layer + 1], x)
    c, c_eta = _at(code, number, code[layer + 2], eta), _slope(code, number, code[layer + 2], eta)
    k = _at(code, number, code[layer + 2], zeta)
    k_zeta = _slope(code, number, code[layer + 2], zeta)
    for turn in range(2):
        first = turn == 0
        size, lever = number[begin + 5 + turn], eta if first else zeta
        u, v = (-side * cos, -sin) if first else (0.0 * side, 1.0)
        by_x = size * a_x * c * k * lever
        by_eta = size * a * k * (c_eta * lever + (c if first else 0.0))
        by_zeta = size * a * c * (k_zeta * lever + (0.0 if first else k))
        by_y = -side * (by_eta / cos + by_zeta * tan)
        for row in range(1, 3):
            part = u if row == 1 else v
            found[row, 0] += part * by_x
            found[row, 1] += part * by_y
            found[row, 2] += part * by_zeta


@jit
def _set_slopes(
    code: IntArray, number: FloatArray, layer: int, p: Vector, found: FloatArray
) -> None:
    """Set the Jacobian of a layer at a place."""
    for i in range(3):
        for j in range(3):
            found[i, j] = 1.0 if i == j else 0.0
    x, y, z = p
    side = -1.0 if y < 0.0 else 1.0
    if code[layer] == 0:
        for n in range(code[layer + 1]):
            f = code[layer + 2 + n]
            by_x, by_y, by_z = _field_gradient(code, number, f, p)
            found[code[f + 1], 0] += by_x
            found[code[f + 1], 1] += by_y
            found[code[f + 1], 2] += by_z
    elif code[layer] == 1:
        _set_corner_slopes(code, number, layer, p, found)
    elif code[layer] == 2:
        q = number[code[layer + 4]]
        ramp, rise = _keel_ramp(code, number, layer, y)
        a, c = _at(code, number, code[layer + 1], x), _at(code, number, code[layer + 2], z)
        found[2, 0] += _slope(code, number, code[layer + 1], x) * q * ramp * c
        found[2, 1] += a * q * (-rise if y < 0.0 else rise) * c
        found[2, 2] += a * q * ramp * _slope(code, number, code[layer + 2], z)
    else:
        if code[layer + 1] >= 0:
            found[0, 0] += _slope(code, number, code[layer + 1], x)
        if code[layer + 2] >= 0:
            by_x, by_y, by_z = _product_slopes(code, number, layer + 2, x, abs(y), z)
            found[1, 0] += by_x * side
            found[1, 1] += by_y
            found[1, 2] += by_z * side
        if code[layer + 5] >= 0:
            by_x, by_y, by_z = _product_slopes(code, number, layer + 5, x, abs(y), z)
            found[2, 0] += by_x
            found[2, 1] += by_y * side
            found[2, 2] += by_z


@jit
def _image(code: IntArray, number: FloatArray, p: Vector) -> Vector:
    """Give where all layers take a place."""
    x, y, z = p
    for k in range(code[0]):
        dx, dy, dz = _displacement(code, number, code[code[1] + k], (x, y, z))
        x, y, z = x + dx, y + dy, z + dz
    return x, y, z


@jit
def _set_jacobian(
    code: IntArray, number: FloatArray, p: Vector, found: FloatArray, room: FloatArray
) -> None:
    """Set the Jacobian of all layers at a place; `room` is (2, 3, 3)."""
    for i in range(3):
        for j in range(3):
            found[i, j] = 1.0 if i == j else 0.0
    x, y, z = p
    for n in range(code[0]):
        layer = code[code[1] + n]
        _set_slopes(code, number, layer, (x, y, z), room[0])
        for i in range(3):
            for k in range(3):
                # numpy sums so, beginning at zero
                first = 0.0 + room[0, i, 0] * found[0, k]
                room[1, i, k] = first + room[0, i, 1] * found[1, k] + room[0, i, 2] * found[2, k]
        found[:] = room[1]
        dx, dy, dz = _displacement(code, number, layer, (x, y, z))
        x, y, z = x + dx, y + dy, z + dz


@jit
def map_places(code: IntArray, number: FloatArray, xyz: FloatArray, found: FloatArray) -> None:
    """Set where the layers take places (n, 3), m."""
    for i in range(len(xyz)):
        found[i, 0], found[i, 1], found[i, 2] = _image(
            code, number, (xyz[i, 0], xyz[i, 1], xyz[i, 2])
        )


@jit
def map_slopes(code: IntArray, number: FloatArray, xyz: FloatArray, found: FloatArray) -> None:
    """Set the Jacobians of the layers at places, (n, 3, 3)."""
    room = np.empty((2, 3, 3))
    for i in range(len(xyz)):
        _set_jacobian(code, number, (xyz[i, 0], xyz[i, 1], xyz[i, 2]), found[i], room)


# --------------------------------------------------------------------------------------
# Bilges: which places an arc reaches, at which angles, and what it does to them. The numbers of an
# arc are x; of both circles centre, radius, angle at the floor, that times the radius, floor, side;
# both reaches, the direction to the floor, and how near to the arc a place lies on it.

_OLD, _NEW, _REACH, _DOWN, _ON = 1, 10, 19, 21, 23


@jit
def gather_bilges(
    code: IntArray, number: FloatArray, xyz: FloatArray, pair: IntArray, away: FloatArray
) -> int:
    """Set arc and place of each pair that has to do with one another, (2 n, 2), arc by arc.

    No place lies between more than two arcs. `away` (2, 2 n), m, is y and z from the old centre.
    """
    count = 0
    for k in range(code[2]):
        arc = code[code[3] + k]
        begin = code[arc + 1]
        for i in range(len(xyz)):
            if _at(code, number, code[arc], xyz[i, 0]) != 0.0:
                pair[count, 0], pair[count, 1] = arc, i
                away[0, count] = abs(xyz[i, 1]) - number[begin + _OLD]
                away[1, count] = xyz[i, 2] - number[begin + _OLD + 1]
                count += 1
    return count


@jit
def _inward(number: FloatArray, begin: int, y: float, z: float) -> float:
    """Give how far a place lies inward of the tangent point on the floor."""
    return 0.0 + y * number[begin + _DOWN + 1] + z * -number[begin + _DOWN]


@jit
def set_angles(
    code: IntArray, number: FloatArray, pair: IntArray, away: FloatArray, angle: FloatArray,
    part: FloatArray, turned: FloatArray,
) -> None:  # fmt: skip
    """Set the parts of arcs (k,) at which pairs are, and the angles there, old and new, (2, k)."""
    for p in range(len(pair)):
        begin = code[pair[p, 0] + 1]
        if _inward(number, begin, away[0, p], away[1, p]) > 0.0:
            t = 0.0
        elif away[1, p] > 0.0:
            t = 1.0
        else:
            t = _clipped(1.0 - angle[p] / number[begin + _OLD + 3], 0.0, 1.0)
        part[p] = t
        turned[0, p] = number[begin + _OLD + 3] * (1.0 - t)
        turned[1, p] = number[begin + _NEW + 3] * (1.0 - t)


@jit
def _on_arc(number: FloatArray, arc: int, t: float, cos: float, sin: float) -> tuple[float, float]:
    """Give y and z of an arc at a part of it."""
    if t == 1.0:
        return number[arc + 7], number[arc + 8]
    if t == 0.0:
        return number[arc + 5], number[arc + 6]
    return cos * number[arc + 2] + number[arc], sin * number[arc + 2] + number[arc + 1]


@jit
def _fade(away: float, reach: float) -> tuple[float, float]:
    t = away / reach
    return 1.0 - _blend(1, t), -_blend_slope(1, t) / reach


@jit
def _fades(number: FloatArray, begin: int, y: float, z: float) -> tuple[
    int, float, float, float, float, float, float, float, float
]:  # fmt: skip
    """Give the zone (1 floor, 2 side, 0 arc), direction, distance, how far off, and the fades."""
    size = sqrt(0.0 + y * y + z * z)
    over = size if size > 0.0 else 1.0
    unit_y, unit_z = y / over, z / over
    inward = _inward(number, begin, y, z)
    zone, past, reach = 0, 0.0, number[begin + _REACH + 1]
    across_y, across_z = unit_y, unit_z
    if inward > 0.0:
        zone, past, reach = 1, inward, number[begin + _REACH]
        across_y, across_z = number[begin + _DOWN], number[begin + _DOWN + 1]
    elif z > 0.0:
        zone, past = 2, z
        across_y, across_z = 1.0, 0.0
    off = (0.0 + y * across_y + z * across_z) - number[begin + _OLD + 2]
    near, sink = _fade(abs(off), number[begin + _OLD + 2])
    left, fall = _fade(past, reach)
    return zone, unit_y, unit_z, size, off, near, sink, left, fall


@jit
def _arc_step(
    code: IntArray, number: FloatArray, begin: int, y: float, z: float, on: bool, t: float,
    cos: FloatArray, sin: FloatArray, p: int,
) -> tuple[float, float]:  # fmt: skip
    """Give y and z from the image to the new arc: of the place itself, if that is on the arc."""
    if not on:
        y, z = _on_arc(number, begin + _OLD, t, cos[0, p], sin[0, p])
    new_y, new_z = _on_arc(number, begin + _NEW, t, cos[1, p], sin[1, p])
    _, image_y, image_z = _image(code, number, (number[begin], y, z))
    return new_y - image_y, new_z - image_z


@jit
def add_bilges(
    code: IntArray, number: FloatArray, xyz: FloatArray, pair: IntArray, away: FloatArray,
    part: FloatArray, cos: FloatArray, sin: FloatArray, found: FloatArray,
) -> None:  # fmt: skip
    """Add the corrections of bilges to images (n, 3); what has none keeps its bits."""
    for p in range(len(pair)):
        arc, i = pair[p, 0], pair[p, 1]
        begin = code[arc + 1]
        zone, _, _, _, off, near, _, left, _ = _fades(number, begin, away[0, p], away[1, p])
        on = zone == 0 and abs(off) <= number[begin + _ON]
        y, z = _arc_step(
            code, number, begin, abs(xyz[i, 1]), xyz[i, 2], on, part[p], cos, sin, p
        )  # fmt: skip
        weight, share = near * left, _at(code, number, code[arc], xyz[i, 0])
        y, z = share * (weight * y), share * (weight * z)
        if xyz[i, 1] < 0.0:
            y = -y
        if y != 0.0:
            found[i, 1] += y
        if z != 0.0:
            found[i, 2] += z


@jit
def add_bilge_slopes(
    code: IntArray, number: FloatArray, xyz: FloatArray, pair: IntArray, away: FloatArray,
    part: FloatArray, cos: FloatArray, sin: FloatArray, found: FloatArray,
) -> None:  # fmt: skip
    """Add the derivatives of the corrections of bilges to Jacobians (n, 3, 3)."""
    room, slope = np.empty((2, 3, 3)), np.empty((3, 3))
    more, step, turn, grow = np.zeros((3, 3)), np.empty(2), np.empty(2), np.empty(2)
    spin = np.empty(2)
    for p in range(len(pair)):
        arc, i, t = pair[p, 0], pair[p, 1], part[p]
        begin = code[arc + 1]
        zone, unit_y, unit_z, size, off, near, sink, left, fall = _fades(
            number, begin, away[0, p], away[1, p]
        )
        on = zone == 0 and abs(off) <= number[begin + _ON]
        step[0], step[1] = _arc_step(
            code, number, begin, abs(xyz[i, 1]), xyz[i, 2], on, t, cos, sin, p
        )  # fmt: skip
        y, z = _on_arc(number, begin + _OLD, t, cos[0, p], sin[0, p])
        _set_jacobian(code, number, (number[begin], y, z), slope, room)
        old, new = number[begin + _OLD + 4], number[begin + _NEW + 4]
        for k in range(2):
            ahead = 0.0 + slope[1 + k, 1] * (old * sin[0, p])
            ahead = ahead + slope[1 + k, 2] * (old * -cos[0, p])
            turn[k] = new * (sin[1, p] if k == 0 else -cos[1, p]) - ahead
        spin[:] = 0.0
        if zone == 0:
            over = size if size > 0.0 else np.inf
            spin[0] = -unit_z / over / -number[begin + _OLD + 3]
            spin[1] = unit_y / over / -number[begin + _OLD + 3]
        sense = 1.0 if off > 0.0 else (-1.0 if off < 0.0 else (0.0 if off == 0.0 else off))
        along, over = near * fall, left * sink * sense
        below, beside = number[begin + _DOWN], number[begin + _DOWN + 1]
        if zone == 1:
            grow[0], grow[1] = along * beside + over * below, along * -below + over * beside
        elif zone == 2:
            grow[0], grow[1] = along * 0.0 + over * 1.0, along * 1.0 + over * 0.0
        else:
            grow[0], grow[1] = along * 0.0 + over * unit_y, along * 0.0 + over * unit_z
        weight, share = near * left, _at(code, number, code[arc], xyz[i, 0])
        share_slope = _slope(code, number, code[arc], xyz[i, 0])
        for k in range(2):
            more[1 + k, 0] = share_slope * (weight * step[k])
            for j in range(2):
                more[1 + k, 1 + j] = share * (weight * turn[k] * spin[j] + step[k] * grow[j])
        side = -1.0 if xyz[i, 1] < 0.0 else 1.0
        for k in range(3):
            for j in range(3):
                one, two = side if k == 1 else 1.0, side if j == 1 else 1.0
                found[i, k, j] += one * more[k, j] * two


# --------------------------------------------------------------------------------------
# Circles. The numbers of each are centre, normal and radius before; centre and radius after; gap
# and reach.


@jit
def _from_axis(number: FloatArray, c: int, p: Vector) -> tuple[float, float, float, float]:
    """Give the direction in which a place lies from the axis, and how far."""
    a, b, d = p[0] - number[c], p[1] - number[c + 1], p[2] - number[c + 2]
    u, v, w = number[c + 3], number[c + 4], number[c + 5]
    dot = 0.0 + a * u + b * v + d * w
    a, b, d = a - dot * u, b - dot * v, d - dot * w
    size = sqrt(0.0 + a * a + b * b + d * d)
    over = size if size > 0.0 else 1.0
    return a / over, b / over, d / over, size


@jit
def _from_foot(number: FloatArray, c: int, p: Vector) -> tuple[float, float, float, float]:
    """Give the step from the place of a circle next to a place, and how far away that is."""
    a, b, d, _ = _from_axis(number, c, p)
    r = number[c + 6]
    a, b = p[0] - (number[c] + r * a), p[1] - (number[c + 1] + r * b)
    d = p[2] - (number[c + 2] + r * d)
    away = sqrt(0.0 + a * a + b * b + d * d)
    return a, b, d, (0.0 if away <= number[c + 11] else away)


@jit
def _set_away(code: IntArray, number: FloatArray, p: Vector, away: FloatArray) -> bool:
    """Set how far a place lies from all circles; tell whether any reaches it."""
    near = False
    for k in range(code[4]):
        begin = code[code[code[5] + k] + 1]
        away[k] = _from_foot(number, begin, p)[3]
        near = near or away[k] < number[begin + 12]
    return near


@jit
def _set_parts(
    code: IntArray, number: FloatArray, k: int, away: FloatArray, part: FloatArray
) -> float:
    """Set what each circle leaves to one of them, and give the product."""
    whole = 1.0
    for j in range(code[4]):
        if j == k:
            part[j] = 1.0 - _blend(1, away[k] / number[code[code[code[5] + k] + 1] + 12])
        else:
            both = away[k] + away[j]
            part[j] = _blend(1, away[j] / (1.0 if both == 0.0 else both))
        whole = whole * part[j]
    return whole


@jit
def _product_without(part: FloatArray, j: int) -> float:
    whole = 1.0
    for m in range(len(part)):
        if m != j:
            whole = whole * part[m]
    return whole


@jit
def _set_correction(
    code: IntArray, number: FloatArray, c: int, unit: Vector, step: FloatArray
) -> Vector:
    """Set the step from the image to the new circle in a direction; give the old place there."""
    r = number[c + 6]
    old = number[c] + r * unit[0], number[c + 1] + r * unit[1], number[c + 2] + r * unit[2]
    image = _image(code, number, old)
    step[0] = number[c + 7] + number[c + 10] * unit[0] - image[0]
    step[1] = number[c + 8] + number[c + 10] * unit[1] - image[1]
    step[2] = number[c + 9] + number[c + 10] * unit[2] - image[2]
    return old


@jit
def add_circles(code: IntArray, number: FloatArray, xyz: FloatArray, found: FloatArray) -> None:
    """Add the corrections of circles to images (n, 3); put what is on them onto the new ones."""
    count = code[4]
    away, whole, part, step = np.empty(count), np.empty(count), np.empty(count), np.empty(3)
    for i in range(len(xyz)):
        p = xyz[i, 0], xyz[i, 1], xyz[i, 2]
        if not _set_away(code, number, p, away):
            continue
        total, gone = 0.0, 1.0
        for k in range(count):
            whole[k] = _set_parts(code, number, k, away, part)
            total = total + whole[k]
            gone = gone * _blend(1, away[k] / number[code[code[code[5] + k] + 1] + 12])
        total = 1.0 if total == 0.0 else total
        for k in range(count):
            circle = code[code[5] + k]
            c = code[circle + 1]
            if not away[k] < number[c + 12]:
                continue
            a, b, d, size = _from_axis(number, c, p)
            if code[circle] == 0:
                share = (1.0 - gone) * (whole[k] / total)
                _set_correction(code, number, c, (a, b, d), step)
                for j in range(3):
                    found[i, j] = found[i, j] + share * step[j]
            if away[k] == 0.0:
                found[i, 0] = number[c + 7] + number[c + 10] * a
                found[i, 1] = number[c + 8] + number[c + 10] * b
                found[i, 2] = number[c + 9] + number[c + 10] * d
            level = 0.0 + (p[0] - number[c]) * number[c + 3]
            level = level + (p[1] - number[c + 1]) * number[c + 4]
            level = abs(level + (p[2] - number[c + 2]) * number[c + 5])
            if size <= number[c + 11] and level <= number[c + 11]:
                for j in range(3):
                    found[i, j] = number[c + 7 + j]


@jit
def _set_turns(
    code: IntArray, number: FloatArray, k: int, away: FloatArray, part: FloatArray, turn: FloatArray
) -> float:
    """Set the slopes of the part of a circle by all distances; give the part."""
    whole = _set_parts(code, number, k, away, part)
    own, reach = away[k], number[code[code[code[5] + k] + 1] + 12]
    turn[k] = 0.0
    for j in range(len(part)):
        rest = _product_without(part, j)
        if j == k:
            turn[k] += -_blend_slope(1, own / reach) / reach * rest
            continue
        both = own + away[j]
        both = 1.0 if both == 0.0 else both
        share = away[j] / both
        by = _blend_slope(1, share) / both * rest
        turn[j] = 0.0 + by * (1.0 - share)
        turn[k] -= by * share
    return whole


@jit
def add_circle_slopes(
    code: IntArray, number: FloatArray, xyz: FloatArray, found: FloatArray
) -> None:
    """Add the derivatives of the corrections of circles to Jacobians (n, 3, 3)."""
    count = code[4]
    away, whole, part, gone = np.empty(count), np.empty(count), np.empty(count), np.empty(count)
    turn, rise, step = np.empty((count, count)), np.empty(count), np.empty(3)
    slope, room = np.empty((3, 3)), np.empty((2, 3, 3))
    about, grow = np.empty((3, 3)), np.empty(3)
    for i in range(len(xyz)):
        p = xyz[i, 0], xyz[i, 1], xyz[i, 2]
        if not _set_away(code, number, p, away):
            continue
        total = 0.0
        for k in range(count):
            reach = number[code[code[code[5] + k] + 1] + 12]
            gone[k] = _blend(1, away[k] / reach)
            rise[k] = _blend_slope(1, away[k] / reach) / reach
            whole[k] = _set_turns(code, number, k, away, part, turn[k])
            total = total + whole[k]
        total = 1.0 if total == 0.0 else total
        left = 1.0 - _product_without(gone, -1)
        for k in range(count):
            circle = code[code[5] + k]
            c = code[circle + 1]
            if code[circle] != 0 or not away[k] < number[c + 12]:
                continue
            share = whole[k] / total
            grow[:] = 0.0
            for j in range(count):
                sum_ = 0.0
                for m in range(count):
                    sum_ = sum_ + turn[m, j]
                bend = (turn[k, j] - share * sum_) / total
                by = -rise[j] * _product_without(gone, j) * share + left * bend
                a, b, d, _ = _from_foot(number, code[code[code[5] + j] + 1], p)
                over = away[j] if away[j] > 0.0 else np.inf
                grow[0] += by * (a / over)
                grow[1] += by * (b / over)
                grow[2] += by * (d / over)
            a, b, d, size = _from_axis(number, c, p)
            unit = a, b, d
            over = size if size > 0.0 else np.inf
            old = _set_correction(code, number, c, unit, step)
            _set_jacobian(code, number, old, slope, room)
            for j in range(3):
                for m in range(3):
                    one = 1.0 if j == m else 0.0
                    about[j, m] = one - number[c + 3 + j] * number[c + 3 + m]
                    about[j, m] = (about[j, m] - unit[j] * unit[m]) / over
                    slope[j, m] = number[c + 10] * one - number[c + 6] * slope[j, m]
            weight = left * share
            for j in range(3):
                for m in range(3):
                    spin = 0.0 + slope[j, 0] * about[0, m]
                    spin = spin + slope[j, 1] * about[1, m] + slope[j, 2] * about[2, m]
                    found[i, j, m] += weight * spin
                    found[i, j, m] += step[j] * grow[m]


# --------------------------------------------------------------------------------------
# The map.


@attrs.frozen(eq=False)
class CompiledMap:
    """A map as it is called: places (n, 3), m, to where they come, and its Jacobian.

    Attributes
    ----------
    flat : FlatMap
        Its numbers.
    """

    flat: FlatMap

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places (n, 3), m."""
        code, number = self.flat.code, self.flat.number
        at = read_only(np.ascontiguousarray(xyz, np.float64))
        found = np.empty(at.shape)
        map_places(code, number, at, found)
        if self.flat.arcs:
            add_bilges(code, number, at, *self._bilges(at), found)
        if self.flat.circles:
            add_circles(code, number, at, found)
        return found

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        code, number = self.flat.code, self.flat.number
        at = read_only(np.ascontiguousarray(xyz, np.float64))
        found = np.empty((*at.shape, 3))
        map_slopes(code, number, at, found)
        if self.flat.arcs:
            add_bilge_slopes(code, number, at, *self._bilges(at), found)
        if self.flat.circles:
            add_circle_slopes(code, number, at, found)
        return found

    def _bilges(
        self, at: FloatArray
    ) -> tuple[IntArray, FloatArray, FloatArray, FloatArray, FloatArray]:
        """Give pairs of arc and place, from where, at which part, with cosines and sines."""
        code, number = self.flat.code, self.flat.number
        pair, away = np.empty((2 * len(at), 2), np.int64), np.empty((2, 2 * len(at)))
        count = gather_bilges(code, number, at, pair, away)
        pair, away = pair[:count], np.ascontiguousarray(away[:, :count])
        angle, part, turned = np.arctan2(away[1], away[0]), np.empty(count), np.empty((2, count))
        set_angles(code, number, pair, away, angle, part, turned)
        return pair, away, part, np.cos(turned), np.sin(turned)


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded."""
    code, number = np.zeros(6, np.int64), np.zeros(0)
    code.setflags(write=False)
    number.setflags(write=False)
    every = CompiledMap(FlatMap(code, number, True, True))
    every(np.zeros((0, 3)))
    every.jacobian(np.zeros((0, 3)))
    return all(
        was_loaded(each)
        for each in (
            map_places, map_slopes, gather_bilges, set_angles, add_bilges, add_bilge_slopes,
            add_circles, add_circle_slopes,
        )
    )  # fmt: skip

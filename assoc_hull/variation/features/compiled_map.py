"""Maps with their bilges and circles, compiled: the bits of the numpy of layers and features.

All is done place by place, in the order of operations of `variation.fields`, `BilgeMap` and
`FeatureMap`. Sines, cosines and angles of bilges come from numpy, which has its own: what a place
needs of them is gathered first, and used afterwards. As for `compiled_program`, arrays come in one
by one and read-only; the numbers of a map are those of a `FlatMap`.
"""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.jit import jit, was_loaded
from assoc_hull.model.program.compiled_program import read_only
from assoc_hull.variation.features.flat_map import FlatMap
from assoc_hull.variation.fields.compiled_layers import (
    blend,
    blend_slope,
    clipped,
    displacement_slopes_at,
    map_layers,
    set_displacement_slopes,
    set_slopes,
    set_values,
)

__all__ = ["CompiledMap", "kernels", "warm"]

Vector = tuple[float, float, float]

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

    No place lies between more than two arcs. `away` (4, 2 n) is y and z from the old centre (m),
    how much the arc counts there, and the slope of that along the ship.
    """
    n, count = len(xyz), 0
    x, share, slope = np.empty(n), np.empty(n), np.empty(n)
    for i in range(n):
        x[i] = xyz[i, 0]
    for k in range(code[2]):
        arc = code[code[3] + k]
        begin = code[arc + 1]
        set_values(code, number, code[arc], x, share, n)
        set_slopes(code, number, code[arc], x, slope, n)
        for i in range(n):
            if share[i] != 0.0:
                pair[count, 0], pair[count, 1] = arc, i
                away[0, count] = abs(xyz[i, 1]) - number[begin + _OLD]
                away[1, count] = xyz[i, 2] - number[begin + _OLD + 1]
                away[2, count], away[3, count] = share[i], slope[i]
                count += 1
    return count


@jit
def _inward(number: FloatArray, begin: int, y: float, z: float) -> float:
    """Give how far a place lies inward of the tangent point on the floor."""
    found: float = 0.0 + y * number[begin + _DOWN + 1] + z * -number[begin + _DOWN]
    return found


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
            t = clipped(1.0 - angle[p] / number[begin + _OLD + 3], 0.0, 1.0)
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
    return 1.0 - blend(1, t), -blend_slope(1, t) / reach


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
def set_arc_places(
    code: IntArray, number: FloatArray, xyz: FloatArray, pair: IntArray, away: FloatArray,
    part: FloatArray, cos: FloatArray, sin: FloatArray, place: FloatArray,
) -> None:  # fmt: skip
    """Set places of old arcs whose images are asked for, (2, k, 3).

    The second one of a pair is on the arc at its part; so is the first one, but what lies on the
    arc itself stays where it is.
    """
    for p in range(len(pair)):
        i, begin = pair[p, 1], code[pair[p, 0] + 1]
        zone, _, _, _, off, _, _, _, _ = _fades(number, begin, away[0, p], away[1, p])
        y, z = _on_arc(number, begin + _OLD, part[p], cos[0, p], sin[0, p])
        place[0, p, 0], place[0, p, 1], place[0, p, 2] = number[begin], y, z
        place[1, p, 0], place[1, p, 1], place[1, p, 2] = number[begin], y, z
        if zone == 0 and abs(off) <= number[begin + _ON]:
            place[0, p, 1], place[0, p, 2] = abs(xyz[i, 1]), xyz[i, 2]


@jit
def add_bilges(
    code: IntArray, number: FloatArray, xyz: FloatArray, pair: IntArray, away: FloatArray,
    part: FloatArray, cos: FloatArray, sin: FloatArray, image: FloatArray, found: FloatArray,
) -> None:  # fmt: skip
    """Add the corrections of bilges to images (n, 3); what has none keeps its bits."""
    for p in range(len(pair)):
        i, begin = pair[p, 1], code[pair[p, 0] + 1]
        _, _, _, _, _, near, _, left, _ = _fades(number, begin, away[0, p], away[1, p])
        y, z = _on_arc(number, begin + _NEW, part[p], cos[1, p], sin[1, p])
        weight, share = near * left, away[2, p]
        y, z = share * (weight * (y - image[p, 1])), share * (weight * (z - image[p, 2]))
        if xyz[i, 1] < 0.0:
            y = -y
        if y != 0.0:
            found[i, 1] += y
        if z != 0.0:
            found[i, 2] += z


@jit
def add_bilge_slopes(
    code: IntArray, number: FloatArray, xyz: FloatArray, pair: IntArray, away: FloatArray,
    part: FloatArray, cos: FloatArray, sin: FloatArray, image: FloatArray, slope: FloatArray,
    found: FloatArray,
) -> None:  # fmt: skip
    """Add the derivatives of the corrections of bilges to Jacobians (n, 3, 3)."""
    more, step, turn, grow = np.zeros((3, 3)), np.empty(2), np.empty(2), np.empty(2)
    spin = np.empty(2)
    for p in range(len(pair)):
        i, begin = pair[p, 1], code[pair[p, 0] + 1]
        zone, unit_y, unit_z, size, off, near, sink, left, fall = _fades(
            number, begin, away[0, p], away[1, p]
        )
        y, z = _on_arc(number, begin + _NEW, part[p], cos[1, p], sin[1, p])
        step[0], step[1] = y - image[p, 1], z - image[p, 2]
        old, new = number[begin + _OLD + 4], number[begin + _NEW + 4]
        for k in range(2):
            ahead = 0.0 + slope[p, 1 + k, 1] * (old * sin[0, p])
            ahead = ahead + slope[p, 1 + k, 2] * (old * -cos[0, p])
            turn[k] = new * (sin[1, p] if k == 0 else -cos[1, p]) - ahead
        spin[0], spin[1] = 0.0, 0.0
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
        weight, share = near * left, away[2, p]
        for k in range(2):
            more[1 + k, 0] = away[3, p] * (weight * step[k])
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
def find_near(
    code: IntArray, number: FloatArray, xyz: FloatArray, wide: float, near: IntArray
) -> int:
    """Set which places any circle reaches, (n,); give how many there are.

    Farther from a centre than radius and reach together, a little more by the factor `wide`, none
    is reached.
    """
    away, count = np.empty(code[4]), 0
    for i in range(len(xyz)):
        perhaps = False
        for k in range(code[4]):
            c = code[code[code[5] + k] + 1]
            x, y, z = xyz[i, 0] - number[c], xyz[i, 1] - number[c + 1], xyz[i, 2] - number[c + 2]
            most = (number[c + 12] + number[c + 6]) * wide
            perhaps = perhaps or x * x + y * y + z * z < most * most
        if perhaps and _set_away(code, number, (xyz[i, 0], xyz[i, 1], xyz[i, 2]), away):
            near[count] = i
            count += 1
    return count


@jit
def set_circle_places(
    code: IntArray, number: FloatArray, xyz: FloatArray, near: IntArray, place: FloatArray
) -> int:
    """Set the places of circles whose images are asked for: of each that is corrected, next to."""
    count = 0
    for n in range(len(near)):
        p = xyz[near[n], 0], xyz[near[n], 1], xyz[near[n], 2]
        for k in range(code[4]):
            circle = code[code[5] + k]
            c = code[circle + 1]
            if code[circle] == 0 and _from_foot(number, c, p)[3] < number[c + 12]:
                unit = _from_axis(number, c, p)
                for j in range(3):
                    place[count, j] = number[c + j] + number[c + 6] * unit[j]
                count += 1
    return count


@jit
def _set_parts(
    code: IntArray, number: FloatArray, k: int, away: FloatArray, part: FloatArray
) -> float:
    """Set what each circle leaves to one of them, and give the product."""
    whole = 1.0
    for j in range(code[4]):
        if j == k:
            part[j] = 1.0 - blend(1, away[k] / number[code[code[code[5] + k] + 1] + 12])
        else:
            both = away[k] + away[j]
            part[j] = blend(1, away[j] / (1.0 if both == 0.0 else both))
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
def add_circles(
    code: IntArray, number: FloatArray, xyz: FloatArray, near: IntArray, image: FloatArray,
    found: FloatArray,
) -> None:  # fmt: skip
    """Add the corrections of circles to images (n, 3); put what is on them onto the new ones."""
    count, asked = code[4], 0
    away, whole, part = np.empty(count), np.empty(count), np.empty(count)
    for n in range(len(near)):
        i = near[n]
        p = xyz[i, 0], xyz[i, 1], xyz[i, 2]
        _set_away(code, number, p, away)
        total, gone = 0.0, 1.0
        for k in range(count):
            whole[k] = _set_parts(code, number, k, away, part)
            total = total + whole[k]
            gone = gone * blend(1, away[k] / number[code[code[code[5] + k] + 1] + 12])
        total = 1.0 if total == 0.0 else total
        for k in range(count):
            circle = code[code[5] + k]
            c = code[circle + 1]
            if not away[k] < number[c + 12]:
                continue
            a, b, d, size = _from_axis(number, c, p)
            if code[circle] == 0:
                share, unit = (1.0 - gone) * (whole[k] / total), (a, b, d)
                for j in range(3):
                    step = number[c + 7 + j] + number[c + 10] * unit[j] - image[asked, j]
                    found[i, j] = found[i, j] + share * step
                asked += 1
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
            turn[k] += -blend_slope(1, own / reach) / reach * rest
            continue
        both = own + away[j]
        both = 1.0 if both == 0.0 else both
        share = away[j] / both
        by = blend_slope(1, share) / both * rest
        turn[j] = 0.0 + by * (1.0 - share)
        turn[k] -= by * share
    return whole


@jit
def add_circle_slopes(
    code: IntArray, number: FloatArray, xyz: FloatArray, near: IntArray, image: FloatArray,
    slope: FloatArray, found: FloatArray,
) -> None:  # fmt: skip
    """Add the derivatives of the corrections of circles to Jacobians (n, 3, 3)."""
    count, asked = code[4], 0
    away, whole, part, gone = np.empty(count), np.empty(count), np.empty(count), np.empty(count)
    turn, rise, step = np.empty((count, count)), np.empty(count), np.empty(3)
    about, swing, grow = np.empty((3, 3)), np.empty((3, 3)), np.empty(3)
    for n in range(len(near)):
        i = near[n]
        p = xyz[i, 0], xyz[i, 1], xyz[i, 2]
        _set_away(code, number, p, away)
        total = 0.0
        for k in range(count):
            reach = number[code[code[code[5] + k] + 1] + 12]
            gone[k] = blend(1, away[k] / reach)
            rise[k] = blend_slope(1, away[k] / reach) / reach
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
            for j in range(3):
                step[j] = number[c + 7 + j] + number[c + 10] * unit[j] - image[asked, j]
                for m in range(3):
                    one = 1.0 if j == m else 0.0
                    about[j, m] = one - number[c + 3 + j] * number[c + 3 + m]
                    about[j, m] = (about[j, m] - unit[j] * unit[m]) / over
                    swing[j, m] = number[c + 10] * one - number[c + 6] * slope[asked, j, m]
            weight = left * share
            for j in range(3):
                for m in range(3):
                    spin = 0.0 + swing[j, 0] * about[0, m]
                    spin = spin + swing[j, 1] * about[1, m] + swing[j, 2] * about[2, m]
                    found[i, j, m] += weight * spin
                    found[i, j, m] += step[j] * grow[m]
            asked += 1


# --------------------------------------------------------------------------------------
# The map.


_set_arc_places: Callable[..., None] = set_arc_places
_add_bilges: Callable[..., None] = add_bilges
_add_bilge_slopes: Callable[..., None] = add_bilge_slopes


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
        at = _plain(xyz)
        found = self._images(at)
        if self.flat.arcs:
            place, given = self._bilges(at)
            _add_bilges(*self._numbers, at, *given, self._images(_plain(place[0])), found)
        if self.flat.circles:
            near, place = self._near_circles(at)
            if len(near):
                add_circles(*self._numbers, at, near, self._images(place), found)
        return found

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        at = _plain(xyz)
        found = self._slopes(at)
        if self.flat.arcs:
            place, given = self._bilges(at)
            image, slope = self._images(_plain(place[0])), self._slopes(_plain(place[1]))
            _add_bilge_slopes(*self._numbers, at, *given, image, slope, found)
        if self.flat.circles:
            near, place = self._near_circles(at)
            if len(near):
                image, slope = self._images(place), self._slopes(place)
                add_circle_slopes(*self._numbers, at, near, image, slope, found)
        return found

    @property
    def _numbers(self) -> tuple[IntArray, FloatArray]:
        return self.flat.code, self.flat.number

    def _images(self, at: FloatArray) -> FloatArray:
        """Give where the layers take places."""
        found = np.empty(at.shape)
        map_layers(*self._numbers, at, found, np.empty((0, 3, 3)))
        return found

    def _slopes(self, at: FloatArray) -> FloatArray:
        """Give the Jacobians of the layers."""
        found = np.empty((*at.shape, 3))
        map_layers(*self._numbers, at, np.empty((0, 3)), found)
        return found

    def _bilges(self, at: FloatArray) -> tuple[FloatArray, tuple[FloatArray | IntArray, ...]]:
        """Give places of old arcs, and pairs, from where, at which part, cosines and sines."""
        pair, away = np.empty((2 * len(at), 2), np.int64), np.empty((4, 2 * len(at)))
        count = gather_bilges(*self._numbers, at, pair, away)
        pair, away = pair[:count], np.ascontiguousarray(away[:, :count])
        angle, part, turned = np.arctan2(away[1], away[0]), np.empty(count), np.empty((2, count))
        set_angles(*self._numbers, pair, away, angle, part, turned)
        given, place = (pair, away, part, np.cos(turned), np.sin(turned)), np.empty((2, count, 3))
        _set_arc_places(*self._numbers, at, *given, place)
        return place, given

    def _near_circles(self, at: FloatArray) -> tuple[IntArray, FloatArray]:
        """Give which places circles reach, and the places of old circles next to these."""
        near = np.empty(len(at), np.int64)
        near = near[: find_near(*self._numbers, at, _WIDE, near)]
        place = np.empty((len(near) * int(self.flat.code[4]), 3))
        return near, _plain(place[: set_circle_places(*self._numbers, at, near, place)])


_WIDE = 1.001
"""So much farther, as a factor, a place must be for that no circle reaches it to be told so."""


def _plain(xyz: FloatArray) -> FloatArray:
    """Give places in the one form for which all is compiled."""
    return read_only(np.ascontiguousarray(xyz, np.float64))


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded."""
    code, number = np.zeros(7, np.int64), np.zeros(0)
    freeze(code, number)
    every, flat = CompiledMap(FlatMap(code, number, True, True)), (code, number)
    at = np.zeros((0, 3))
    every(at)
    every.jacobian(at)
    displacement_slopes_at(*flat, at)
    near, slope = np.zeros(0, np.int64), np.zeros((0, 3, 3))
    add_circles(*flat, _plain(at), near, at, at)
    add_circle_slopes(*flat, _plain(at), near, at, slope, slope)
    return all(was_loaded(each) for each in kernels())


def kernels() -> tuple[Callable[..., object], ...]:
    """Give all that is compiled for maps."""
    return (
        map_layers, gather_bilges, set_angles, set_arc_places, add_bilges, add_bilge_slopes,
        find_near, set_circle_places, add_circles, add_circle_slopes, set_displacement_slopes,
    )  # fmt: skip

"""Whether the lines of a hull are plainly sound, compiled: one quick look at all that may be odd.

Importing this module imports numba. What is told sound here is told so by numpy as well; of what is
not, numpy says whether it is odd, where and by how much: limits are a little closer here.

Examples
--------
>>> from assoc_hull.geometry.floating.compiled_doubts import DoubtLimits
>>> DoubtLimits(0.1, 0.1, 1.0, 0.3, 2.6, 6).places
6
"""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, sqrt

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.floating.compiled_immersion import read_only
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.numeric.jit import jit, was_loaded

__all__ = ["DoubtLimits", "are_plainly_sound", "warm"]

Flags = NDArray[np.bool_]
Kinds = NDArray[np.int8]

_LESS = 1.0 - 1e-9
_NEAR = 1e-9


@attrs.frozen
class DoubtLimits:
    """What is odd.

    Attributes
    ----------
    open_, gap : float, m
        A section that ends so far off the centre plane, lines that pass by so much.
    turn, back, hairpin : float, rad
        A smooth section that turns by so much, and back by so much; or that turns by more.
    places : int
        On each segment, between which sections are taken as straight.
    """

    open_: float
    gap: float
    turn: float
    back: float
    hairpin: float
    places: int


@jit
def _turn(xyz: FloatArray, i: int) -> float:
    """Give by which angle a polyline of y and z turns at a point."""
    a, b = xyz[1, i] - xyz[1, i - 1], xyz[2, i] - xyz[2, i - 1]
    c, d = xyz[1, i + 1] - xyz[1, i], xyz[2, i + 1] - xyz[2, i]
    return atan2(a * d - b * c, a * c + b * d)


@jit
def _kinks(
    first: int, last: int, xyz: FloatArray, kind: Kinds, turn: float, back: float, hairpin: float
) -> bool:
    """Tell whether a section turns sharply at a smooth point."""
    for i in range(first + 2, last - 1):
        if kind[i] != 0:
            continue
        a, b = xyz[1, i] - xyz[1, i - 1], xyz[2, i] - xyz[2, i - 1]
        c, d = xyz[1, i + 1] - xyz[1, i], xyz[2, i + 1] - xyz[2, i]
        # most points turn by far less than 60 degrees
        if a * c + b * d > 0.6 * sqrt((a * a + b * b) * (c * c + d * d)):
            continue
        here = _turn(xyz, i)
        sense = 1.0 if here > 0.0 else -1.0
        away = max(-sense * _turn(xyz, i - 1), -sense * _turn(xyz, i + 1))
        if abs(here) > hairpin or (abs(here) > turn and away > back):
            return True
    return False


@jit
def _goes_onward(
    first: int, last: int, knot: FloatArray, xyz: FloatArray, leave: FloatArray,
    arrive: FloatArray, places: int,
) -> bool:  # fmt: skip
    """Tell whether a section goes one way throughout, and so cannot cross itself."""
    up, down = np.ones(4, np.bool_), np.ones(4, np.bool_)
    y, z = xyz[1, first], xyz[2, first]
    c = np.empty((2, 4))
    for f in range(first, last):
        size = knot[f + 1] - knot[f]
        for k in range(2):
            chord = xyz[k + 1, f + 1] - xyz[k + 1, f]
            begin, end = leave[k + 1, f] * size, arrive[k + 1, f + 1] * size
            c[k, 0], c[k, 1] = xyz[k + 1, f], begin
            c[k, 2] = 3.0 * (chord - begin) + (begin - end)
            c[k, 3] = (begin - chord) + (end - chord)
        for q in range(1, places + 1):
            if q < places:
                u = q / places
                y_1 = ((c[0, 3] * u + c[0, 2]) * u + c[0, 1]) * u + c[0, 0]
                z_1 = ((c[1, 3] * u + c[1, 2]) * u + c[1, 1]) * u + c[1, 0]
            else:
                y_1, z_1 = xyz[1, f + 1], xyz[2, f + 1]
            dy, dz = y_1 - y, z_1 - z
            y, z = y_1, z_1
            some = False
            for way in range(4):
                step = dz if way == 0 else (dy if way == 3 else (dz + dy if way == 1 else dz - dy))
                up[way] = up[way] and step > 0.0
                down[way] = down[way] and step < 0.0
                some = some or up[way] or down[way]
            if not some:
                return False
    return True


@jit
def _is_open(
    first: int, last: int, xyz: FloatArray, height: FloatArray, tan_trim: FloatArray,
    tan_heel: FloatArray, most: float,
) -> bool:  # fmt: skip
    """Tell whether a section may begin off the centre plane below one of the planes."""
    swept, size = 0.0, 0.0
    for f in range(first, last):
        part = (xyz[1, f] + xyz[1, f + 1]) * (xyz[2, f + 1] - xyz[2, f])
        swept += part
        size += abs(part)
    for end in range(2):
        # The lower end is that from which the area inside lies to port.
        if (end == 0 and swept < -_NEAR * size) or (end == 1 and swept > _NEAR * size):
            continue
        i = first if end == 0 else last
        if abs(xyz[1, i]) <= most * _LESS:
            continue
        for d in range(len(height)):
            level = height[d] + tan_trim[d] * xyz[0, i] + abs(tan_heel[d]) * abs(xyz[1, i])
            if xyz[2, i] < level + _NEAR:
                return True
    return False


@jit
def _gap(
    k: int, meets: IntArray, place: FloatArray, start: IntArray, knot: FloatArray, xyz: FloatArray,
    leave: FloatArray, arrive: FloatArray,
) -> float:  # fmt: skip
    """Give by how much two lines pass one another where they cross, m; infinite if not known."""
    away, p = 0.0, np.empty((2, 3))
    for side in range(2):
        t, low, high = place[k, side], start[meets[k, side]], start[meets[k, side] + 1] - 2
        if not (t >= knot[low] and t <= knot[high + 1]):
            return np.inf
        while low < high:
            middle = (low + high + 1) // 2
            if knot[middle] <= t:
                low = middle
            else:
                high = middle - 1
        size = knot[low + 1] - knot[low]
        u = 1.0 if t == knot[low + 1] else (t - knot[low]) / size
        for i in range(3):
            chord = xyz[i, low + 1] - xyz[i, low]
            begin, end = leave[i, low] * size, arrive[i, low + 1] * size
            bend = 3.0 * (chord - begin) + (begin - end)
            last = (begin - chord) + (end - chord)
            p[side, i] = ((last * u + bend) * u + begin) * u + xyz[i, low]
    for i in range(3):
        away += (p[0, i] - p[1, i]) ** 2
    return sqrt(away)


@jit
def look_for_doubts(
    start: IntArray, knot: FloatArray, xyz: FloatArray, leave: FloatArray, arrive: FloatArray,
    kind: Kinds, section: IntArray, shut: Flags, meets: IntArray, place: FloatArray,
    watched: Flags, height: FloatArray, tan_trim: FloatArray, tan_heel: FloatArray,
    limits: FloatArray, places: int,
) -> bool:  # fmt: skip
    """Tell whether nothing is odd: sections (k,), of which some are `shut` by a transom."""
    for n in range(len(section)):
        first, last = start[section[n]], start[section[n] + 1] - 1
        if not shut[n] and _is_open(first, last, xyz, height, tan_trim, tan_heel, limits[0]):
            return False
        if _kinks(first, last, xyz, kind, limits[2], limits[3], limits[4]):
            return False
        if not _goes_onward(first, last, knot, xyz, leave, arrive, places):
            return False
    most = limits[1] * _LESS
    for k in range(len(meets)):
        if watched[k]:
            continue
        if not _gap(k, meets, place, start, knot, xyz, leave, arrive) <= most:
            return False
    return True


_look: Callable[..., bool] = look_for_doubts


def are_plainly_sound(
    batch: SplineBatch, kinds: Kinds, sections: IntArray, shut: Flags,
    crossings: tuple[IntArray, FloatArray, Flags], planes: FloatingPlanes, limits: DoubtLimits,
) -> bool:  # fmt: skip
    """Tell whether nothing is odd about lines; False: it is not known.

    Parameters
    ----------
    batch : SplineBatch
        The m lines, through n points.
    kinds : (n,) int8
        The `PointKind` of each point; 0 is smooth.
    sections : (k,) int
        Which of them are sections.
    shut : (k,) bool
        Those that a transom closes below.
    crossings : meets (c, 2) int, place (c, 2), watched (c,)
        Which lines cross, where on either (m), and whether they only pass one another.
    planes : FloatingPlanes
        Of plain numbers.
    limits : DoubtLimits
    """
    vectors = (each.T for each in (batch.xyz, batch.leave, batch.arrive))
    asked = planes.height, planes.tan_trim, planes.tan_heel
    given = batch.start, batch.knot, *vectors, kinds, sections, shut, *crossings, *asked
    closer = np.array([
        limits.open_, limits.gap, limits.turn * _LESS, limits.back * _LESS, limits.hairpin * _LESS
    ])  # fmt: skip
    arrays = (read_only(np.ascontiguousarray(each)) for each in given)
    return bool(_look(*arrays, closer, limits.places))


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded."""
    one = np.zeros((2, 3))
    one[1] = 0.0, 1.0, 1.0
    line = SplineBatch(np.array([0, 2]), np.array([0.0, 1.0]), one, one.copy(), one.copy())
    none, flag = np.zeros((0, 2), np.int64), np.zeros(0, np.bool_)
    planes = FloatingPlanes(np.ones(1), np.zeros(1), np.zeros(1))
    are_plainly_sound(
        line, np.zeros(2, np.int8), np.zeros(1, np.int64), np.zeros(1, np.bool_),
        (none, np.zeros((0, 2)), flag), planes, DoubtLimits(1.0, 1.0, 1.0, 1.0, 1.0, 6),
    )  # fmt: skip
    return was_loaded(look_for_doubts)

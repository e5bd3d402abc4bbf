"""`plane_intersections`, compiled: same operations in the same order, same bits.

Constants come in as arguments: numba's cache misses the change of one in another module.

Examples
--------
>>> from assoc_hull.geometry.splines.compiled_intersections import meet_curves
>>> callable(meet_curves)
True
"""

from __future__ import annotations

from math import copysign, sqrt

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.jit import jit

__all__ = ["meet_curves", "place_meetings", "stationary"]

Flags = NDArray[np.int8]
PLAIN, BENT, LYING = 0, 1, 2
SEGMENT, ORDER, BELOW_BEGIN, BELOW_END = 0, 1, 2, 3
LOWER, UPPER, BEGIN, END = 0, 1, 2, 3


@jit
def _not_above(offsets: FloatArray, height: float) -> int:
    """Give the number of planes that do not lie above a height."""
    low, high = 0, len(offsets)
    while low < high:
        middle = (low + high) // 2
        if offsets[middle] <= height:
            low = middle + 1
        else:
            high = middle
    return low


@jit
def _below(offsets: FloatArray, height: float) -> int:
    """Give the number of planes that lie below a height."""
    low, high = 0, len(offsets)
    while low < high:
        middle = (low + high) // 2
        if offsets[middle] < height:
            low = middle + 1
        else:
            high = middle
    return low


@jit
def _set_along(vectors: FloatArray, normal: FloatArray, axis: int, result: FloatArray) -> None:
    """Set the components of vectors along the normal."""
    if axis >= 0:
        for i in range(vectors.shape[1]):
            result[i] = vectors[axis, i]
        return
    for i in range(vectors.shape[1]):
        first = vectors[0, i] * normal[0] + vectors[1, i] * normal[1]
        result[i] = first + vectors[2, i] * normal[2]


@jit
def _set_courses(knot: FloatArray, courses: FloatArray) -> None:
    """Turn heights and derivatives at the knots into rise and derivatives of segments."""
    for i in range(len(knot) - 1):
        length = knot[i + 1] - knot[i]
        courses[1, i] = courses[0, i + 1] - courses[0, i]
        courses[2, i] *= length
    for i in range(len(knot) - 1):
        courses[3, i] = courses[3, i + 1] * (knot[i + 1] - knot[i])


@jit
def _set_kinds(courses: FloatArray, contact: float, kinds: Flags) -> None:
    """Tell bent segments, and those that may lie in a plane, from the others."""
    for i in range(len(kinds) - 1):
        rise, first, last = courses[1, i], courses[2, i], courses[3, i]
        middle = 3.0 * rise - first - last
        most, least = first, first
        most = last if last > most else most
        most = middle if middle > most else most
        least = last if last < least else least
        least = middle if middle < least else least
        kind = BENT if (least < 0.0) & (most > 0.0) else PLAIN
        kinds[i] = kind + (LYING if most - least <= 12.0 * contact else 0)


@jit
def _set_ranks(
    start: IntArray,
    courses: FloatArray,
    offsets: FloatArray,
    contact: float,
    below: IntArray,
    kinds: Flags,
) -> int:
    """Count the planes not above each knot; give a bound for the number of parts."""
    rank = 0
    for i in range(len(below)):
        height = courses[0, i]
        # From the rank of the knot before: as many steps as there are meetings.
        while rank < len(offsets) and offsets[rank] <= height:
            rank += 1
        while rank > 0 and not offsets[rank - 1] <= height:
            rank -= 1
        below[i] = rank
    bound = 0
    for curve in range(len(start) - 1):
        for i in range(start[curve], start[curve + 1] - 1):
            if kinds[i] >= LYING:
                lies = _count_flat(courses, i, offsets, contact, below)
                kinds[i] = LYING if lies else kinds[i] - LYING
            if kinds[i] != PLAIN:
                # Knots that lie may now count otherwise: the neighbours too may pass planes.
                bound += 3
            elif below[i] != below[i + 1]:
                bound += 1
    return bound


@jit
def _count_flat(
    courses: FloatArray, i: int, offsets: FloatArray, contact: float, below: IntArray
) -> bool:
    """Say whether a segment lies in a plane; its knots then count as on it."""
    begin, end = courses[0, i], courses[0, i + 1]
    one, other = begin + courses[2, i] / 3.0, end - courses[3, i] / 3.0
    most, least = max(max(begin, end), max(one, other)), min(min(begin, end), min(one, other))
    first = _below(offsets, most - contact)
    behind = _not_above(offsets, least + contact)
    if first >= behind:
        return False
    below[i] = max(below[i], behind)
    below[i + 1] = max(below[i + 1], behind)
    return True


@jit
def _powers(courses: FloatArray, i: int) -> tuple[float, float, float]:
    """Give the coefficients of u, u**2, u**3 of the height of a segment."""
    rise, first = courses[1, i], courses[2, i]
    both = first + courses[3, i]
    return first, (3.0 * rise - first) - both, both - 2.0 * rise


@jit
def stationary(first: float, second: float, third: float) -> tuple[float, float]:
    """Give the fractions where the derivative is nil, 0 or 1 where not needed."""
    inside = second * second - 3.0 * (third * first)
    if not inside >= 0.0:
        return 0.0, 1.0
    sum_ = -(second + copysign(sqrt(inside), second))
    one, other = sum_ / (3.0 * third), first / sum_
    if not 0.0 < one < 1.0:
        one = 0.0
    if not 0.0 < other < 1.0:
        other = 0.0
    lower, upper = min(one, other), max(one, other)
    return lower, (upper if upper > 0.0 else 1.0)


@jit
def _add_bent(
    courses: FloatArray,
    i: int,
    offsets: FloatArray,
    below: IntArray,
    places: IntArray,
    numbers: FloatArray,
    count: int,
) -> int:
    """Add the monotone parts of a segment that pass planes."""
    first, second, third = _powers(courses, i)
    origin = courses[0, i]
    lower, upper = stationary(first, second, third)
    fraction, height, rank = np.empty(4), np.empty(4), np.empty(4, np.int64)
    fraction[0], fraction[1], fraction[2], fraction[3] = 0.0, lower, upper, 1.0
    height[0], height[3] = origin, courses[0, i + 1]
    height[1] = ((third * lower + second) * lower + first) * lower + origin
    height[2] = height[3]
    if upper != 1.0:
        height[2] = ((third * upper + second) * upper + first) * upper + origin
    rank[0], rank[3] = below[i], below[i + 1]
    rank[1], rank[2] = _not_above(offsets, height[1]), _not_above(offsets, height[2])
    for j in range(3):
        if rank[j] != rank[j + 1]:
            places[SEGMENT, count], places[ORDER, count] = i, 3 * i + j
            places[BELOW_BEGIN, count], places[BELOW_END, count] = rank[j], rank[j + 1]
            numbers[LOWER, count], numbers[UPPER, count] = fraction[j], fraction[j + 1]
            numbers[BEGIN, count], numbers[END, count] = height[j], height[j + 1]
            count += 1
    return count


@jit
def _set_parts(
    start: IntArray,
    courses: FloatArray,
    below: IntArray,
    kinds: Flags,
    offsets: FloatArray,
    places: IntArray,
    numbers: FloatArray,
    part_start: IntArray,
) -> int:
    """Collect the parts of all curves, in order; give the number of meetings."""
    count = 0
    for curve in range(len(start) - 1):
        part_start[curve] = count
        for i in range(start[curve], start[curve + 1] - 1):
            if kinds[i] == BENT:
                count = _add_bent(courses, i, offsets, below, places, numbers, count)
            elif below[i] != below[i + 1]:
                places[SEGMENT, count], places[ORDER, count] = i, 3 * i
                places[BELOW_BEGIN, count], places[BELOW_END, count] = below[i], below[i + 1]
                numbers[LOWER, count], numbers[UPPER, count] = 0.0, 1.0
                numbers[BEGIN, count], numbers[END, count] = courses[0, i], courses[0, i + 1]
                count += 1
    part_start[len(start) - 1] = count
    total = 0
    for part in range(count):
        total += abs(places[BELOW_END, part] - places[BELOW_BEGIN, part])
    return total


@jit
def _sort(
    part_start: IntArray, places: IntArray, free: IntArray, owner: IntArray, plane: IntArray
) -> None:
    """Order the meetings by curve, plane and part: one counting sort per curve."""
    total = 0
    for curve in range(len(part_start) - 1):
        begin, end = part_start[curve], part_start[curve + 1]
        low, high = len(free), 0
        for part in range(begin, end):
            one, other = places[BELOW_BEGIN, part], places[BELOW_END, part]
            low, high = min(low, one, other), max(high, one, other)
        free[low:high] = 0
        for part in range(begin, end):
            one, other = places[BELOW_BEGIN, part], places[BELOW_END, part]
            for index in range(min(one, other), max(one, other)):
                free[index] += 1
        for index in range(low, high):
            count = free[index]
            free[index] = total
            total += count
        for part in range(begin, end):
            one, other = places[BELOW_BEGIN, part], places[BELOW_END, part]
            for index in range(min(one, other), max(one, other)):
                owner[free[index]], plane[free[index]] = part, index
                free[index] += 1


@jit
def _set_cubics(
    courses: FloatArray,
    places: IntArray,
    numbers: FloatArray,
    offsets: FloatArray,
    owner: IntArray,
    plane: IntArray,
    cubics: FloatArray,
) -> None:
    """Set powers, bracket and values at its ends for every meeting."""
    for m in range(len(owner)):
        part, offset = owner[m], offsets[plane[m]]
        i = places[SEGMENT, part]
        cubics[0, m] = courses[0, i] - offset
        cubics[1, m], cubics[2, m], cubics[3, m] = _powers(courses, i)
        cubics[4, m], cubics[5, m] = numbers[LOWER, part], numbers[UPPER, part]
        at_lower, at_upper = numbers[BEGIN, part] - offset, numbers[END, part] - offset
        falling = places[BELOW_END, part] < places[BELOW_BEGIN, part]
        if falling and at_lower < 0.0:
            at_lower = 0.0
        if not falling and at_upper < 0.0:
            at_upper = 0.0
        cubics[6, m], cubics[7, m] = at_lower, at_upper


@jit
def meet_curves(
    start: IntArray,
    knot: FloatArray,
    xyz: FloatArray,
    leave: FloatArray,
    arrive: FloatArray,
    normal: FloatArray,
    axis: int,
    offsets: FloatArray,
    contact: float,
    courses: FloatArray,
) -> tuple[IntArray, FloatArray, IntArray, IntArray, FloatArray]:
    """Find all meetings: tables of the parts, owner, plane and cubic of each.

    `courses` is scratch memory for (4, n) numbers. A cubic has eight rows: its powers, the
    ends of the bracket and the values there.
    """
    below, kinds = np.empty(len(knot), np.int64), np.empty(len(knot), np.int8)
    _set_along(xyz, normal, axis, courses[0])
    _set_along(leave, normal, axis, courses[2])
    _set_along(arrive, normal, axis, courses[3])
    _set_courses(knot, courses)
    _set_kinds(courses, contact, kinds)
    bound = _set_ranks(start, courses, offsets, contact, below, kinds)
    places, numbers = np.empty((4, bound), np.int64), np.empty((4, bound))
    part_start = np.empty(len(start), np.int64)
    total = _set_parts(start, courses, below, kinds, offsets, places, numbers, part_start)
    owner, plane = np.empty(total, np.int64), np.empty(total, np.int64)
    _sort(part_start, places, np.empty(len(offsets), np.int64), owner, plane)
    cubics = np.empty((8, total))
    _set_cubics(courses, places, numbers, offsets, owner, plane, cubics)
    return places, numbers, owner, plane, cubics


@jit
def _tell_meetings(
    start: IntArray,
    places: IntArray,
    numbers: FloatArray,
    offsets: FloatArray,
    owner: IntArray,
    plane: IntArray,
    contact: float,
    tables: IntArray,
    sign: Flags,
) -> bool:
    """Set segment and curve, the rows of `tables`, and sign of each meeting.

    Gives whether between any two neighbours of one curve and plane a part ends near it.
    """
    near, curve = False, 0
    for m in range(len(owner)):
        part, segment = owner[m], places[SEGMENT, owner[m]]
        while segment >= start[curve + 1]:
            curve += 1
        tables[0, m], tables[1, m] = segment, curve
        sign[m] = -1 if places[BELOW_END, part] < places[BELOW_BEGIN, part] else 1
        if m > 0 and plane[m] == plane[m - 1] and tables[1, m - 1] == curve:
            near |= abs(numbers[END, owner[m - 1]] - offsets[plane[m]]) < contact
    return near


@jit
def _place_points(
    knot: FloatArray,
    xyz: FloatArray,
    leave: FloatArray,
    arrive: FloatArray,
    segment: IntArray,
    roots: FloatArray,
    t: FloatArray,
    points: FloatArray,
) -> None:
    """Set parameters (k,) and points (3, k) of meetings at fractions `roots` of segments."""
    for m in range(len(roots)):
        i, u = segment[m], roots[m]
        length = knot[i + 1] - knot[i]
        t[m] = knot[i + 1] if u == 1.0 else min(length * u + knot[i], knot[i + 1])
        for k in range(3):
            origin, end = xyz[k, i], xyz[k, i + 1]
            step = end - origin
            first = leave[k, i] * length
            both = first + arrive[k, i + 1] * length
            second = 3.0 * step - first - both
            inside = (((both - 2.0 * step) * u + second) * u + first) * u + origin
            points[k, m] = end if u == 1.0 else inside


@jit
def place_meetings(
    start: IntArray,
    knot: FloatArray,
    xyz: FloatArray,
    leave: FloatArray,
    arrive: FloatArray,
    places: IntArray,
    numbers: FloatArray,
    offsets: FloatArray,
    owner: IntArray,
    plane: IntArray,
    roots: FloatArray,
    contact: float,
) -> tuple[IntArray, Flags, FloatArray, FloatArray, bool]:
    """Give segment and curve in one table, sign, parameter (k,) and point (3, k) of meetings.

    `roots` are fractions of segments. Last comes what `_tell_meetings` gives.
    """
    count = len(roots)
    told, sign = np.empty((2, count), np.int64), np.empty(count, np.int8)
    near = _tell_meetings(start, places, numbers, offsets, owner, plane, contact, told, sign)
    t, points = np.empty(count), np.empty((3, count))
    _place_points(knot, xyz, leave, arrive, told[0], roots, t, points)
    return told, sign, t, points, near

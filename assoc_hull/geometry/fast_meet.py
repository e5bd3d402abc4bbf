"""The meetings of `crossing`, compiled: same operations in the same order, curve by curve.

All constants come in as arguments: a compiled function in the cache of numba does not
notice when a constant of another module changes.

Examples
--------
>>> from assoc_hull.geometry.fast_meet import meet_curves
>>> callable(meet_curves)
True
"""

from __future__ import annotations

from math import copysign, sqrt

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.jit import jit

__all__ = ["meet_curves"]

Flags = NDArray[np.int8]
PLAIN, BENT, LYING = 0, 1, 2
SEGMENT, ORDER, BELOW_BEGIN, BELOW_END = 0, 1, 2, 3
LOWER, UPPER, BEGIN, END = 0, 1, 2, 3


@jit
def _along(vectors: FloatArray, i: int, normal: FloatArray, axis: int) -> float:
    """Give the component of a vector along the normal."""
    result: float = vectors[axis, i]
    if axis < 0:
        result = vectors[0, i] * normal[0] + vectors[1, i] * normal[1] + vectors[2, i] * normal[2]
    return result


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
def _value(origin: float, first: float, second: float, third: float, u: float) -> float:
    """Evaluate a cubic by Horner's rule."""
    return ((third * u + second) * u + first) * u + origin


@jit
def _set_courses(
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
    below: IntArray,
    kinds: Flags,
) -> int:
    """Set height, rise and end derivatives of segments; give a bound for the number of parts."""
    bound = 0
    for curve in range(len(start) - 1):
        begin, end = start[curve], start[curve + 1]
        rank = 0
        for i in range(begin, end):
            height = _along(xyz, i, normal, axis)
            courses[0, i] = height
            # From the rank of the knot before: as many steps as there are meetings.
            while rank < len(offsets) and offsets[rank] <= height:
                rank += 1
            while rank > 0 and not offsets[rank - 1] <= height:
                rank -= 1
            below[i] = rank
        for i in range(begin, end - 1):
            length = knot[i + 1] - knot[i]
            rise = courses[0, i + 1] - courses[0, i]
            first = _along(leave, i, normal, axis) * length
            last = _along(arrive, i + 1, normal, axis) * length
            courses[1, i], courses[2, i], courses[3, i] = rise, first, last
            middle = 3.0 * rise - first - last
            most, least = max(max(first, last), middle), min(min(first, last), middle)
            kinds[i] = BENT if least < 0.0 < most else PLAIN
            if most - least <= 12.0 * contact and _count_flat(courses, i, offsets, contact, below):
                kinds[i] = LYING
            bound += 3 if kinds[i] == BENT else 1
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
def _stationary(first: float, second: float, third: float) -> tuple[float, float]:
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
    lower, upper = _stationary(first, second, third)
    fraction, height, rank = np.empty(4), np.empty(4), np.empty(4, np.int64)
    fraction[0], fraction[1], fraction[2], fraction[3] = 0.0, lower, upper, 1.0
    height[0], height[3] = origin, courses[0, i + 1]
    height[1] = _value(origin, first, second, third, lower)
    height[2] = height[3]
    if upper != 1.0:
        height[2] = _value(origin, first, second, third, upper)
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
def _safe_root(
    origin: float,
    first: float,
    second: float,
    third: float,
    lower: float,
    upper: float,
    rising: bool,
    limit: float,
    most_trials: int,
) -> float:
    """Find a root by Newton's rule, every third trial and whenever it fails by bisection."""
    root = 0.5 * (lower + upper)
    for trial in range(most_trials):
        height = _value(origin, first, second, third, root)
        if (height >= 0.0) == rising:
            upper = root
        else:
            lower = root
        middle = 0.5 * (lower + upper)
        if not (abs(height) > limit and lower < middle < upper):
            break
        slope = first + root * (2.0 * second + root * (3.0 * third))
        newton = root - height / slope
        root = newton if lower < newton < upper and trial % 3 != 2 else middle
    return root


@jit
def _root(
    origin: float,
    first: float,
    second: float,
    third: float,
    lower: float,
    upper: float,
    at_lower: float,
    at_upper: float,
    steps: int,
    floor: float,
    relative: float,
    most_trials: int,
) -> float:
    """Give the one root in a bracket, as in `roots`."""
    if at_upper == 0.0:
        return upper
    if at_lower == 0.0:
        return lower
    limit = floor + relative * (abs(at_lower) + abs(at_upper))
    root = lower + (upper - lower) * (at_lower / (at_lower - at_upper))
    steep = 3.0 * third
    for _ in range(steps):
        height = _value(origin, first, second, third, root)
        bend = steep * root + second
        slope = (bend + second) * root + first
        root -= (height * slope) / (slope * slope - bend * height)
    residual = abs(_value(origin, first, second, third, root))
    if residual <= limit and lower <= root <= upper:
        return root
    rising = at_lower < 0.0
    return _safe_root(origin, first, second, third, lower, upper, rising, limit, most_trials)


@jit
def _fraction(
    courses: FloatArray,
    places: IntArray,
    numbers: FloatArray,
    part: int,
    offset: float,
    steps: int,
    floor: float,
    relative: float,
    most_trials: int,
) -> float:
    """Where in its segment a meeting lies."""
    first, second, third = _powers(courses, places[SEGMENT, part])
    origin = courses[0, places[SEGMENT, part]] - offset
    at_lower, at_upper = numbers[BEGIN, part] - offset, numbers[END, part] - offset
    falling = places[BELOW_END, part] < places[BELOW_BEGIN, part]
    if falling and at_lower < 0.0:
        at_lower = 0.0
    if not falling and at_upper < 0.0:
        at_upper = 0.0
    return _root(
        origin, first, second, third, numbers[LOWER, part], numbers[UPPER, part],
        at_lower, at_upper, steps, floor, relative, most_trials,
    )  # fmt: skip


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
    steps: int,
    floor: float,
    relative: float,
    most_trials: int,
) -> tuple[IntArray, FloatArray, IntArray, IntArray, FloatArray, FloatArray]:
    """Find all meetings: tables of the parts, owner and plane of each, parameters, points."""
    courses, below = np.empty((4, len(knot))), np.empty(len(knot), np.int64)
    kinds = np.empty(len(knot), np.int8)
    bound = _set_courses(
        start, knot, xyz, leave, arrive, normal, axis, offsets, contact, courses, below, kinds
    )
    places, numbers = np.empty((4, bound), np.int64), np.empty((4, bound))
    part_start = np.empty(len(start), np.int64)
    total = _set_parts(start, courses, below, kinds, offsets, places, numbers, part_start)
    owner, plane = np.empty(total, np.int64), np.empty(total, np.int64)
    _sort(part_start, places, np.empty(len(offsets), np.int64), owner, plane)
    t, points = np.empty(total), np.empty((3, total))
    for k in range(total):
        u = _fraction(
            courses, places, numbers, owner[k], offsets[plane[k]],
            steps, floor, relative, most_trials,
        )  # fmt: skip
        i = places[SEGMENT, owner[k]]
        length = knot[i + 1] - knot[i]
        if u == 1.0:
            t[k] = knot[i + 1]
            for coordinate in range(3):
                points[coordinate, k] = xyz[coordinate, i + 1]
            continue
        t[k] = min(length * u + knot[i], knot[i + 1])
        for coordinate in range(3):
            origin = xyz[coordinate, i]
            step = xyz[coordinate, i + 1] - origin
            first = leave[coordinate, i] * length
            both = first + arrive[coordinate, i + 1] * length
            second = 3.0 * step - first - both
            points[coordinate, k] = _value(origin, first, second, both - 2.0 * step, u)
    return places, numbers, owner, plane, t, points

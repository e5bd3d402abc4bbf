"""A run of the program of a net, compiled: the same bits and the same answer as `run_program`.

One call does all: it moves riding points, lofts, cuts, writes computed points and checks, curve by
curve in their order. Arrays come in one by one, as numba reads tuples of arrays fifteen times as
slowly, and constants come in as arguments, as its cache misses the change of one elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
from typing import TypeVar

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.numeric.compiled_roots import find_roots, safe_root
from assoc_hull.geometry.numeric.jit import jit, was_loaded
from assoc_hull.geometry.numeric.polynomials import FLOOR, MOST_TRIALS, RELATIVE, STEPS
from assoc_hull.geometry.numeric.tridiagonal import MOST_LEVELS
from assoc_hull.geometry.splines.compiled_intersections import (
    meet_curves,
    place_meetings,
    stationary,
)
from assoc_hull.geometry.splines.compiled_loft import loft_curves
from assoc_hull.geometry.splines.loft_rules import LEAST_COSINE, NO_DIRECTION
from assoc_hull.geometry.splines.plane_heights import CONTACT
from assoc_hull.model.program.run_program import Doubt, NetEffect, ProgramRun, begins
from assoc_hull.model.program.structure import CompiledFeatures, Program, Values
from assoc_hull.tolerance import Tolerances

__all__ = ["CompiledProgram", "read_only", "tangent_at", "warm"]

Scalar = TypeVar("Scalar", bound=np.generic)
Flags = NDArray[np.int8]

NOTHING, UNSURE, NOT_MADE, MEETINGS, SENSE, GAP, FOLD, BEYOND, LATENT, FEATURE = range(10)
CIRCLE, FLAT, STRAIGHT = 0, 1, 2
TO_LOFT, TO_RIDE = 1, 2
"""What is to be done with a curve: it is made anew, or points of it ride."""

_NUMBERS = (
    Tolerances().coincident, LEAST_COSINE, NO_DIRECTION, CONTACT, FLOOR, RELATIVE, 1e-6, 1.0 - 1e-9,
)  # fmt: skip
"""Nearest points, least cosine of an end, least direction, contact, floor and relative error of a
root, how far a curve may lie beyond the centre plane, what a feature's limit is multiplied by."""


@jit
def _differs(one: float, other: float) -> bool:
    """Tell whether a bit differs; none of the two is not a number."""
    if one != other:
        return True
    return one == 0.0 and np.copysign(1.0, one) != np.copysign(1.0, other)


@jit
def _doubt(told: IntArray, code: int, where: int) -> None:
    """Raise a doubt; of several the one of the lowest number is told, at its first place."""
    if told[3] == NOTHING or code < told[3]:
        told[3], told[4] = code, where


@jit
def _mark(
    row: int, reader: IntArray, rider_start: IntArray, rider: IntArray, rider_on: IntArray,
    changed: Flags, dirty: Flags, due: Flags, moved: IntArray, count: int,
) -> int:  # fmt: skip
    """Note that a point has changed; give how many have."""
    if changed[row] == 0:
        changed[row] = 1
        moved[count] = row
        count += 1
    for side in range(2):
        if reader[row, side] >= 0:
            dirty[reader[row, side]] |= TO_LOFT
    for i in range(rider_start[row], rider_start[row + 1]):
        due[rider[i]] = 1
        if rider_on[rider[i]] >= 0:
            dirty[rider_on[rider[i]]] |= TO_RIDE
    return count


@jit
def _loft(
    c: int, start: IntArray, row: IntArray, kind: Flags, direction: FloatArray, end_kind: Flags,
    end_vector: FloatArray, xyz: FloatArray, knot: FloatArray, block: FloatArray,
    points: FloatArray, span: IntArray, scratch: FloatArray, numbers: FloatArray, levels: int,
) -> bool:  # fmt: skip
    """Make one curve through its points; tell whether it could be made and is finite."""
    b, e = start[c], start[c + 1]
    size = e - b
    for i in range(size):
        for k in range(3):
            points[i, k] = xyz[row[b + i], k]
    span[1] = size
    mine = block[9 * b : 9 * e].reshape(9, size)
    done = loft_curves(
        span, points[:size], kind[b:e], direction[b:e], end_kind[c : c + 1], end_vector[c : c + 1],
        numbers[0], numbers[1], numbers[2], levels, scratch, knot[b:e], mine,
    )  # fmt: skip
    if not done:
        return False
    for k in range(3, 6):
        for i in range(size):
            if not abs(mine[k, i]) < np.inf:
                return False
    return True


@jit
def _folds(mine: FloatArray, size: int) -> int:
    """Count the points at which a curve turns back on itself."""
    found = 0
    for i in range(size):
        folds = False
        if i < size - 1:
            along = 0.0
            for k in range(3):
                part = mine[3 + k, i] * (mine[k, i + 1] - mine[k, i])
                along = part if k == 0 else along + part
            folds = not along > 0.0
        if i > 0:
            along = 0.0
            for k in range(3):
                part = mine[6 + k, i] * (mine[k, i] - mine[k, i - 1])
                along = part if k == 0 else along + part
            folds = folds or not along > 0.0
        if 0 < i < size - 1 and not folds:
            smooth = True
            along = 0.0
            for k in range(3):
                smooth = smooth and mine[3 + k, i] == mine[6 + k, i]
                part = (mine[k, i] - mine[k, i - 1]) * (mine[k, i + 1] - mine[k, i])
                along = part if k == 0 else along + part
            folds = smooth and not along >= 0.0
        found += folds
    return found


@jit
def _root(
    origin: float, first: float, second: float, third: float, lower: float, upper: float,
    at_lower: float, at_upper: float, steps: int, floor: float, relative: float, trials: int,
) -> float:  # fmt: skip
    """Find the root of a cubic in a bracket, as `find_roots` does."""
    if at_upper == 0.0:
        return upper
    if at_lower == 0.0:
        return lower
    u = lower + (upper - lower) * (at_lower / (at_lower - at_upper))
    for _ in range(steps):
        height = ((third * u + second) * u + first) * u + origin
        bend = 3.0 * third * u + second
        slope = (bend + second) * u + first
        u = u - (height * slope) / (slope * slope - bend * height)
    height = ((third * u + second) * u + first) * u + origin
    limit = floor + relative * (abs(at_lower) + abs(at_upper))
    if abs(height) <= limit and u >= lower and u <= upper:
        return u
    return safe_root(origin, first, second, third, lower, upper, at_lower < 0.0, limit, trials)


@jit
def _height(vectors: FloatArray, i: int, normal: FloatArray, s: int, straight: int) -> float:
    """Give the component of a vector along a normal, in one fixed order of operations."""
    if straight >= 0:
        return float(vectors[straight, i])
    two = vectors[0, i] * normal[s, 0] + vectors[1, i] * normal[s, 1]
    return float(two + vectors[2, i] * normal[s, 2])


@jit
def _pass(rank: int, height: float, offset: FloatArray, begin: int, end: int) -> int:
    """Give the number of planes not above a height, from that at a place near by."""
    while rank < end - begin and offset[begin + rank] <= height:
        rank += 1
    while rank > 0 and not offset[begin + rank - 1] <= height:
        rank -= 1
    return rank


@jit
def _meet_set(
    c: int, s: int, cells: int, start: IntArray, normal: FloatArray, axis: IntArray,
    first: IntArray, offset: FloatArray, own_axis: IntArray, own_offset: FloatArray,
    cell: IntArray, meet_sign: Flags, knot: FloatArray, block: FloatArray, at: FloatArray,
    place: FloatArray, segment: IntArray, taken: IntArray, numbers: FloatArray, steps: int,
    trials: int, factor: float,
) -> int:  # fmt: skip
    """Meet one set of planes: 1 if as before, 0 if not, -1 if a segment may lie in a plane."""
    b, size = start[c], start[c + 1] - start[c]
    mine = block[9 * b : 9 * (b + size)].reshape(9, size)
    leave, arrive = mine[3:6], mine[6:]
    begin, end = first[s], first[s + 1]
    along = axis[s]
    straight = along if along >= 0 and normal[s, along] == 1.0 else -1
    for p in range(end - begin):
        taken[p] = cell[cells + p]
    total = 0
    h1 = _height(mine, 0, normal, s, straight)
    rank = _pass(0, h1, offset, begin, end)
    for i in range(size - 1):
        length = knot[b + i + 1] - knot[b + i]
        h0, h1 = h1, _height(mine, i + 1, normal, s, straight)
        one = _height(leave, i, normal, s, straight) * length
        last = _height(arrive, i + 1, normal, s, straight) * length
        rise = h1 - h0
        middle = 3.0 * rise - one - last
        most, least = one, one
        most = last if last > most else most
        most = middle if middle > most else most
        least = last if last < least else least
        least = middle if middle < least else least
        if most - least <= 12.0 * numbers[3]:
            return -1
        after = _pass(rank, h1, offset, begin, end)
        bent = least < 0.0 and most > 0.0
        if not bent and after == rank:
            continue
        both = one + last
        second, third = (3.0 * rise - one) - both, both - 2.0 * rise
        low, high = 0.0, 1.0
        if bent:
            low, high = stationary(one, second, third)
        here, r0 = h0, rank
        for part in range(3 if bent else 1):
            lower, upper = 0.0, 1.0
            there, r1 = h1, after
            if bent:
                lower = 0.0 if part == 0 else (low if part == 1 else high)
                upper = low if part == 0 else (high if part == 1 else 1.0)
                if part == 0:
                    there = ((third * low + second) * low + one) * low + h0
                elif part == 1 and high != 1.0:
                    there = ((third * high + second) * high + one) * high + h0
                if part < 2:
                    r1 = _pass(r0, there, offset, begin, end)
            falls = r1 < r0
            for p in range(min(r0, r1), max(r0, r1)):
                m = taken[p]
                if m >= cell[cells + p + 1] or meet_sign[m] != (-1 if falls else 1):
                    return 0
                taken[p] = m + 1
                total += 1
                plane = offset[begin + p]
                at_lower, at_upper = here - plane, there - plane
                if falls and at_lower < 0.0:
                    at_lower = 0.0
                if not falls and at_upper < 0.0:
                    at_upper = 0.0
                u = _root(
                    h0 - plane, one, second, third, lower, upper, at_lower, at_upper, steps,
                    factor * numbers[4], numbers[5], trials,
                )  # fmt: skip
                at[m] = knot[b + i + 1]
                if u != 1.0:
                    at[m] = min(length * u + knot[b + i], knot[b + i + 1])
                segment[m] = i
                for k in range(3):
                    origin, tip = mine[k, i], mine[k, i + 1]
                    step = tip - origin
                    f = leave[k, i] * length
                    sum_ = f + arrive[k, i + 1] * length
                    bend = 3.0 * step - f - sum_
                    inside = (((sum_ - 2.0 * step) * u + bend) * u + f) * u + origin
                    place[m, k] = tip if u == 1.0 else inside
                if along >= 0:
                    place[m, along] = plane * normal[s, along]
                if own_axis[c] >= 0:
                    place[m, own_axis[c]] = own_offset[c]
            here, r0 = there, r1
        rank = after
    return 1 if total == cell[cells + end - begin] - cell[cells] else 0


@jit
def _cut(
    c: int, start: IntArray, set_start: IntArray, sets: IntArray, normal: FloatArray,
    axis: IntArray, first: IntArray, offset: FloatArray, own_axis: IntArray,
    own_offset: FloatArray, cell_start: IntArray, cell: IntArray, meet_sign: Flags,
    knot: FloatArray, block: FloatArray, at: FloatArray, place: FloatArray, segment: IntArray,
    span: IntArray, courses: FloatArray, taken: IntArray, numbers: FloatArray, steps: int,
    trials: int, factor: float,
) -> bool:  # fmt: skip
    """Meet the planes of one curve; tell whether it meets those it did, in the same senses."""
    for q in range(set_start[c], set_start[c + 1]):
        same = _meet_set(
            c, sets[q], cell_start[q], start, normal, axis, first, offset, own_axis, own_offset,
            cell, meet_sign, knot, block, at, place, segment, taken, numbers, steps, trials,
            factor,
        )  # fmt: skip
        if same < 0:
            same = _meet_lying(
                c, sets[q], cell_start[q], start, normal, axis, first, offset, own_axis,
                own_offset, cell, meet_sign, knot, block, at, place, segment, span, courses,
                numbers, steps, trials, factor,
            )  # fmt: skip
        if same == 0:
            return False
    return True


@jit
def _meet_lying(
    c: int, s: int, cells: int, start: IntArray, normal: FloatArray, axis: IntArray,
    first: IntArray, offset: FloatArray, own_axis: IntArray, own_offset: FloatArray,
    cell: IntArray, meet_sign: Flags, knot: FloatArray, block: FloatArray, at: FloatArray,
    place: FloatArray, segment: IntArray, span: IntArray, courses: FloatArray,
    numbers: FloatArray, steps: int, trials: int, factor: float,
) -> int:  # fmt: skip
    """Meet one set of planes with a curve of which segments may lie in some; as `_meet_set`."""
    b, size = start[c], start[c + 1] - start[c]
    span[1] = size
    mine = block[9 * b : 9 * (b + size)].reshape(9, size)
    knots = knot[b : b + size]
    begin, end = first[s], first[s + 1]
    along = axis[s]
    straight = along if along >= 0 and normal[s, along] == 1.0 else -1
    planes = offset[begin:end]
    places, parts, owner, plane, cubics = meet_curves(
        span, knots, mine[:3], mine[3:6], mine[6:], normal[s], straight, planes, numbers[3],
        courses,
    )  # fmt: skip
    m, stop = cell[cells], cell[cells + end - begin]
    if len(owner) != stop - m:
        return 0
    roots = find_roots(cubics, steps, factor * numbers[4], numbers[5], trials)
    told, sign, t, points, _ = place_meetings(
        span, knots, mine[:3], mine[3:6], mine[6:], places, parts, planes, owner, plane, roots,
        numbers[3],
    )  # fmt: skip
    for i in range(len(owner)):
        p = plane[i]
        if m < cell[cells + p] or m >= cell[cells + p + 1] or meet_sign[m] != sign[i]:
            return 0
        at[m], segment[m] = t[i], told[0, i]
        for k in range(3):
            place[m, k] = points[k, i]
        if along >= 0:
            place[m, along] = planes[p] * normal[s, along]
        if own_axis[c] >= 0:
            place[m, own_axis[c]] = own_offset[c]
        m += 1
    return 1


@jit
def tangent_at(
    m: int, curve: int, start: IntArray, knot: FloatArray, block: FloatArray, at: FloatArray,
    segment: IntArray,
) -> tuple[float, float, float]:  # fmt: skip
    """Give the unit tangent of a curve where it meets a plane; at a knot that after it."""
    b = start[curve]
    count = start[curve + 1] - b
    i = segment[m]
    if knot[b + i + 1] <= at[m] and i + 2 < count:
        i += 1
    begin, end = knot[b + i], knot[b + i + 1]
    length = end - begin
    u = 1.0 if at[m] == end else (at[m] - begin) / length
    here = 9 * b + i
    x = _slope(here, count, block, length, u)
    y = _slope(here + count, count, block, length, u)
    z = _slope(here + 2 * count, count, block, length, u)
    size = sqrt(x * x + y * y + z * z)
    return x / size, y / size, z / size


@jit
def _slope(here: int, count: int, block: FloatArray, length: float, u: float) -> float:
    """Give the derivative of one coordinate of a segment."""
    step = block[here + 1] - block[here]
    first = block[here + 3 * count] * length
    both = first + block[here + 6 * count + 1] * length
    second = 3.0 * step - first - both
    third = both - step * 2.0
    return float((first + u * (2.0 * second + u * (3.0 * third))) / length)


@jit
def _gap(
    w: int, watch_a: IntArray, watch_b: IntArray, meet_curve: IntArray, start: IntArray,
    knot: FloatArray, block: FloatArray, at: FloatArray, place: FloatArray, segment: IntArray,
) -> float:  # fmt: skip
    """Measure a watched crossing along the normal of its two curves, m."""
    one, other = watch_a[w], watch_b[w]
    f = tangent_at(one, meet_curve[one], start, knot, block, at, segment)
    s = tangent_at(other, meet_curve[other], start, knot, block, at, segment)
    x = f[1] * s[2] - f[2] * s[1]
    y = f[2] * s[0] - f[0] * s[2]
    z = f[0] * s[1] - f[1] * s[0]
    length = sqrt(x * x + y * y + z * z)
    if not length > 1e-12:
        return 0.0
    x, y, z = x / length, y / length, z / length
    product = (place[one, 0] - place[other, 0]) * x + (place[one, 1] - place[other, 1]) * y
    return float(abs(product + (place[one, 2] - place[other, 2]) * z))


@jit
def _off_feature(
    f: int, start: IntArray, point: IntArray, shape: Flags, numbers: FloatArray, xyz: FloatArray
) -> float:
    """Give how far the farthest point of a feature lies off it, m; nan if that is not known."""
    worst = 0.0
    begin, end = start[f], start[f + 1]
    head, tail = point[begin], point[end - 1]
    square = 0.0
    if shape[f] == STRAIGHT:
        for k in range(3):
            square += (xyz[tail, k] - xyz[head, k]) ** 2
        if square == 0.0:
            square = 1.0
    for i in range(begin, end):
        row = point[i]
        off = 0.0
        if shape[f] == CIRCLE:
            beside = 0.0
            for k in range(3):
                beside += (xyz[row, k] - numbers[f, k]) * numbers[f, 4 + k]
            inside = 0.0
            for k in range(3):
                inside += ((xyz[row, k] - numbers[f, k]) - beside * numbers[f, 4 + k]) ** 2
            radial = sqrt(inside) - numbers[f, 3]
            off = sqrt(radial * radial + beside * beside)
        elif shape[f] == FLAT:
            beside = 0.0
            for k in range(3):
                beside += xyz[row, k] * numbers[f, 4 + k]
            off = abs(beside - numbers[f, 3])
        elif shape[f] == STRAIGHT:
            along = 0.0
            for k in range(3):
                along += (xyz[row, k] - xyz[head, k]) * (xyz[tail, k] - xyz[head, k])
            along /= square
            for k in range(3):
                across = (xyz[row, k] - xyz[head, k]) - along * (xyz[tail, k] - xyz[head, k])
                off += across * across
            off = sqrt(off)
        worst = off if not off <= worst else worst
    return worst


@jit
def _ride(
    c: int, riding_start: IntArray, riding: IntArray, anchor: IntArray, weight: FloatArray,
    xyz: FloatArray, base: FloatArray, anchor_from: FloatArray, reader: IntArray,
    rider_start: IntArray, rider: IntArray, rider_on: IntArray, held: Flags, changed: Flags,
    dirty: Flags, due: Flags, moved: IntArray, count: int,
) -> int:  # fmt: skip
    """Move the points that ride on a curve; give how many points have changed."""
    for i in range(riding_start[c], riding_start[c + 1]):
        row = riding[i]
        if due[row] == 0 or held[row] != 0:
            continue
        odd = False
        one, other, w = anchor[row, 0], anchor[row, 1], weight[row]
        for k in range(3):
            first = xyz[one, k] - anchor_from[row, 0, k] if one >= 0 else 0.0
            second = xyz[other, k] - anchor_from[row, 1, k] if other >= 0 else 0.0
            value = base[row, k] + ((1.0 - w) * first + w * second)
            if _differs(value, xyz[row, k]):
                xyz[row, k] = value
                odd = True
        if odd:
            count = _mark(
                row, reader, rider_start, rider, rider_on, changed, dirty, due, moved, count
            )
    return count


@jit
def run(
    # The structure.
    start: IntArray, row: IntArray, kind: Flags, direction: FloatArray, end_kind: Flags,
    end_vector: FloatArray, own_axis: IntArray, own_offset: FloatArray, reader: IntArray,
    rider_start: IntArray, rider: IntArray, rider_on: IntArray, riding_start: IntArray,
    riding: IntArray, anchor: IntArray, weight: FloatArray, normal: FloatArray, axis: IntArray,
    first: IntArray, offset: FloatArray, set_start: IntArray, sets: IntArray, cell_start: IntArray,
    cell: IntArray, meet_curve: IntArray, meet_row: IntArray, meet_sign: Flags,
    drive_start: IntArray, drive: IntArray, watch: IntArray, watch_a: IntArray, watch_b: IntArray,
    limit: FloatArray, watch_start: IntArray, watched: IntArray, pair_a: IntArray,
    pair_b: IntArray, pair_start: IntArray, paired: IntArray, sense_start: IntArray,
    sense: IntArray, unsure: Flags, unsure_row: Flags, f_owner_start: IntArray, f_owner: IntArray,
    f_start: IntArray, f_point: IntArray, f_shape: Flags, f_numbers: FloatArray,
    f_limit: FloatArray, numbers: FloatArray, limits: IntArray, near: float, factor: float,
    # The numbers, and two columns of the published ones.
    xyz: FloatArray, base: FloatArray, anchor_from: FloatArray, knot: FloatArray,
    block: FloatArray, at: FloatArray, place: FloatArray, segment: IntArray, gap: FloatArray,
    folds: IntArray, lowest: FloatArray, old_folds: IntArray, old_lowest: FloatArray,
    # Room to work in, and what is answered.
    points: FloatArray, span: IntArray, scratch: FloatArray, courses: FloatArray,
    taken: IntArray, held: Flags, changed: Flags, dirty: Flags, due: Flags,
    seen: Flags, moved: IntArray, lofted: IntArray, measured: IntArray, told: IntArray, whole: int,
) -> None:  # fmt: skip
    """Bring all numbers up to date.

    The first `told[0]` of `moved` are points that were written. `told` becomes the number of
    points that moved, of curves lofted, of crossings measured, the doubt and where it is.
    """
    count, curves, crossings = told[0], 0, 0
    told[3], told[4] = NOTHING, -1
    for i in range(count):
        _mark(moved[i], reader, rider_start, rider, rider_on, changed, dirty, due, moved, i)
    for i in range(count):
        if unsure_row[moved[i]] != 0:
            told[3] = UNSURE
    for c in range(len(start) - 1):
        if told[3] != NOTHING:
            break
        if dirty[c] == 0:
            continue  # most curves of a large hull: at once
        if dirty[c] & TO_RIDE:
            count = _ride(
                c, riding_start, riding, anchor, weight, xyz, base, anchor_from, reader,
                rider_start, rider, rider_on, held, changed, dirty, due, moved, count,
            )  # fmt: skip
        if not dirty[c] & TO_LOFT:
            continue
        lofted[curves] = c
        curves += 1
        told[4] = c
        if unsure[c] != 0 and whole == 0:
            told[3] = UNSURE
        elif not _loft(
            c, start, row, kind, direction, end_kind, end_vector, xyz, knot, block, points, span,
            scratch, numbers, limits[0],
        ):  # fmt: skip
            told[3] = NOT_MADE
        elif not _cut(
            c, start, set_start, sets, normal, axis, first, offset, own_axis, own_offset,
            cell_start, cell, meet_sign, knot, block, at, place, segment, span, courses, taken,
            numbers, limits[1], limits[2], factor,
        ):  # fmt: skip
            told[3] = MEETINGS
        if told[3] != NOTHING:
            break
        for i in range(drive_start[c], drive_start[c + 1]):
            m = drive[i]
            r = meet_row[m]
            odd = False
            for k in range(3):
                if _differs(place[m, k], xyz[r, k]):
                    xyz[r, k] = place[m, k]
                    odd = True
            if odd:
                count = _mark(
                    r, reader, rider_start, rider, rider_on, changed, dirty, due, moved, count
                )
    told[0], told[1] = count, curves
    if told[3] == NOTHING:
        told[4] = -1
        for i in range(count):
            if unsure_row[moved[i]] != 0 and whole == 0:
                told[3] = UNSURE
        for i in range(curves):
            c = lofted[i]
            b, size = start[c], start[c + 1] - start[c]
            mine = block[9 * b : 9 * (b + size)].reshape(9, size)
            folds[c] = _folds(mine, size)
            least = mine[1, 0]
            for j in range(1, size):
                least = mine[1, j] if mine[1, j] < least else least
            lowest[c] = least
            if folds[c] > old_folds[c]:
                _doubt(told, FOLD, c)
            edge = numbers[6] * factor
            if least < -edge and least < old_lowest[c] - edge:
                _doubt(told, BEYOND, c)
            for j in range(sense_start[c], sense_start[c + 1]):
                m = sense[j]
                r = meet_row[m]
                for k in range(3):
                    if abs(place[m, k] - xyz[r, k]) > numbers[0]:
                        _doubt(told, SENSE, c)
            for j in range(pair_start[c], pair_start[c + 1]):
                one, other = pair_a[paired[j]], pair_b[paired[j]]
                apart = 0.0
                for k in range(3):
                    apart += (place[one, k] - place[other, k]) ** 2
                if apart <= near * near:
                    _doubt(told, LATENT, c)
            for j in range(watch_start[c], watch_start[c + 1]):
                w = watched[j]
                if seen[w] != 0:
                    continue
                seen[w] = 1
                measured[crossings] = w
                crossings += 1
                gap[w] = _gap(
                    w, watch_a, watch_b, meet_curve, start, knot, block, at, place, segment
                )
                for k in range(3):
                    xyz[watch[w], k] = place[watch_a[w], k]
                if not gap[w] <= limit[w]:
                    _doubt(told, GAP, c)
        for i in range(count):
            r = moved[i]
            for j in range(f_owner_start[r], f_owner_start[r + 1]):
                f = f_owner[j]
                off = _off_feature(f, f_start, f_point, f_shape, f_numbers, xyz)
                if not off <= f_limit[f] * numbers[7]:
                    _doubt(told, FEATURE, f)
    told[2] = crossings
    # The masks are wiped for the next run.
    for i in range(count):
        changed[moved[i]] = 0
        for j in range(rider_start[moved[i]], rider_start[moved[i] + 1]):
            due[rider[j]] = 0
            if rider_on[rider[j]] >= 0:
                dirty[rider_on[rider[j]]] = 0
        for side in range(2):
            if reader[moved[i], side] >= 0:
                dirty[reader[moved[i], side]] = 0
    for i in range(curves):
        dirty[lofted[i]] = 0
    for i in range(crossings):
        seen[measured[i]] = 0


@jit
def restore(
    start: IntArray, meet_start: IntArray, watch: IntArray,
    xyz: FloatArray, knot: FloatArray, block: FloatArray, at: FloatArray, place: FloatArray,
    segment: IntArray, gap: FloatArray, folds: IntArray, lowest: FloatArray,
    xyz_0: FloatArray, knot_0: FloatArray, block_0: FloatArray, at_0: FloatArray,
    place_0: FloatArray, segment_0: IntArray, gap_0: FloatArray, folds_0: IntArray,
    lowest_0: FloatArray, moved: IntArray, lofted: IntArray, measured: IntArray,
) -> None:  # fmt: skip
    """Copy what a run has written from the second numbers to the first."""
    for i in range(len(moved)):
        for k in range(3):
            xyz[moved[i], k] = xyz_0[moved[i], k]
    for i in range(len(lofted)):
        c = lofted[i]
        for j in range(start[c], start[c + 1]):
            knot[j] = knot_0[j]
        for j in range(9 * start[c], 9 * start[c + 1]):
            block[j] = block_0[j]
        for j in range(meet_start[c], meet_start[c + 1]):
            at[j], segment[j] = at_0[j], segment_0[j]
            for k in range(3):
                place[j, k] = place_0[j, k]
        folds[c], lowest[c] = folds_0[c], lowest_0[c]
    for i in range(len(measured)):
        w = measured[i]
        gap[w] = gap_0[w]
        for k in range(3):
            xyz[watch[w], k] = xyz_0[watch[w], k]


@jit
def gather(
    start: IntArray, curves: IntArray, begin: IntArray, knot: FloatArray, block: FloatArray,
    block_0: FloatArray, knots: FloatArray, blocks: FloatArray, odd: Flags,
) -> None:  # fmt: skip
    """Put curves one behind the other, and tell which have other points or slopes than before."""
    for i in range(len(curves)):
        b, e = start[curves[i]], start[curves[i] + 1]
        size, differs = e - b, False
        for j in range(size):
            knots[begin[i] + j] = knot[b + j]
        for k in range(9):
            first = 9 * b + k * size
            for j in range(size):
                blocks[k, begin[i] + j] = block[first + j]
            if k < 6:
                for j in range(size):
                    differs = differs or block[first + j] != block_0[first + j]
        odd[i] = 1 if differs else 0


@jit
def compare(
    meet_start: IntArray, rows: IntArray, watched: IntArray, curves: IntArray, xyz: IntArray,
    gap: IntArray, at: IntArray, place: IntArray, xyz_0: IntArray, gap_0: IntArray,
    at_0: IntArray, place_0: IntArray, row: IntArray, row_bits: IntArray, crossing: IntArray,
    crossing_bits: IntArray, curve: IntArray, curve_bits: IntArray, told: IntArray,
) -> None:  # fmt: skip
    """Put what differs in front, with the exclusive or of the bits; `told` becomes how many.

    That is: of points, of crossings, of curves and of their meetings.
    """
    count = 0
    for r in rows:
        some = 0
        for k in range(3):
            row_bits[count, k] = xyz[r, k] ^ xyz_0[r, k]
            some |= row_bits[count, k]
        if some != 0:
            row[count] = r
            count += 1
    told[0], count = count, 0
    for w in watched:
        if gap[w] != gap_0[w]:
            crossing[count], crossing_bits[count, 0] = w, gap[w] ^ gap_0[w]
            count += 1
    told[1], count, meetings = count, 0, 0
    for c in curves:
        some, first = 0, meetings
        for m in range(meet_start[c], meet_start[c + 1]):
            curve_bits[meetings, 0] = at[m] ^ at_0[m]
            some |= curve_bits[meetings, 0]
            for k in range(3):
                curve_bits[meetings, 1 + k] = place[m, k] ^ place_0[m, k]
                some |= curve_bits[meetings, 1 + k]
            meetings += 1
        if some != 0:
            curve[count] = c
            count += 1
        else:
            meetings = first
    told[2], told[3] = count, meetings


_run: Callable[..., None] = run
_compare: Callable[..., None] = compare
_restore: Callable[..., None] = restore
_gather: Callable[..., None] = gather
"""They are called with the arrays of a program, in the order above."""


class CompiledProgram:
    """The compiled form of a program, with room to work in: for one thread at a time."""

    def __init__(self, program: Program) -> None:
        self.program = program
        features, points = program.features, len(program.reader)
        most = int(np.diff(program.start).max()) + 2
        limits = np.array([MOST_LEVELS, STEPS, MOST_TRIALS], np.int64)
        begin, rider_on = program.riding_start, np.full(points, -1)
        rider_on[program.riding[begin[0] : begin[-1]]] = np.repeat(
            np.arange(len(begin) - 1), np.diff(begin)
        )
        self._structure = (
            program.start, program.row, program.kind, program.direction, program.end_kind,
            program.end_vector, program.own_axis, program.own_offset, program.reader,
            program.rider_start, program.rider, rider_on, program.riding_start, program.riding,
            program.anchor, program.weight, program.normal, program.axis, program.first,
            program.offset, program.set_start, program.sets, program.cell_start, program.cell,
            program.meet_curve, program.meet_row, program.meet_sign,
            program.drive_start, program.drive, program.watch, program.watch_a, program.watch_b,
            program.limit, program.watch_start, program.watched, program.pair_a, program.pair_b,
            program.pair_start, program.paired, program.sense_start, program.sense,
            program.unsure, program.unsure_row, features.owner_start, features.owner,
            features.start, features.point, features.shape, features.numbers, features.limit,
            np.array(_NUMBERS), limits, program.near, program.factor,
        )  # fmt: skip
        self._dirty, self._held = np.zeros(program.curves, np.int8), np.zeros(points, np.int8)
        self._moved, self._lofted = np.zeros(points, np.int64), np.zeros(program.curves, np.int64)
        self._measured, self._told = np.zeros(len(program.watch), np.int64), np.zeros(5, np.int64)
        self._room = (
            np.zeros((most, 3)), np.zeros(2, np.int64), np.zeros((9, most)), np.zeros((4, most)),
            np.zeros(len(program.offset) + 1, np.int64), self._held,
            np.zeros(points, np.int8), self._dirty, np.zeros(points, np.int8),
            np.zeros(len(program.watch), np.int8), self._moved, self._lofted, self._measured,
            self._told,
        )  # fmt: skip

    def run(
        self, values: Values, before: Values, rows: IntArray, held: IntArray,
        curves: IntArray | None = None,
    ) -> ProgramRun:  # fmt: skip
        """Bring all numbers up to date with points that were written: as `run_program`."""
        self._moved[: len(rows)] = rows
        self._told[0] = len(rows)
        if curves is not None:
            self._dirty[curves] = TO_LOFT
        self._held[held] = 1
        _run(
            *self._structure, *_columns(values), read_only(before.folds),
            read_only(before.lowest), *self._room, int(curves is not None),
        )  # fmt: skip
        if curves is not None:
            self._dirty[:] = 0
        self._held[held] = 0
        moved, lofted, measured, doubt, where = self._told.tolist()
        return ProgramRun(
            Doubt(doubt), where, self._lofted[:lofted].copy(), np.sort(self._moved[:moved]),
            np.sort(self._measured[:measured]),
        )  # fmt: skip

    def restore(self, values: Values, before: Values, run: ProgramRun) -> None:
        """Put back what a run has written, from numbers as they were."""
        program = self.program
        here, there = _columns(values), [read_only(each) for each in _columns(before)]
        _restore(
            program.start, program.meet_start, program.watch, here[0], *here[3:], there[0],
            *there[3:], run.rows, run.curves, run.watched,
        )  # fmt: skip

    def splines(
        self, values: Values, before: Values, curves: IntArray
    ) -> tuple[SplineBatch, NDArray[np.bool_]]:
        """Give curves, and which differ from before: as `NumpyProgram.splines`."""
        begin = begins(self.program.start, curves)
        knots, blocks = np.empty(int(begin[-1])), np.empty((9, int(begin[-1])))
        odd = np.empty(len(curves), np.int8)
        arrays = curves, begin, values.knot, values.block, before.block
        _gather(self.program.start, *map(read_only, arrays), knots, blocks, odd)
        batch = SplineBatch(begin, knots, blocks[:3].T, blocks[3:6].T, blocks[6:].T)
        return batch, odd.view(np.bool_)

    def compare(
        self, values: Values, before: Values, rows: IntArray, watched: IntArray, curves: IntArray
    ) -> NetEffect:
        """Tell what differs from before: as `NumpyProgram.compare`."""
        start = self.program.meet_start
        meetings = int((start.take(curves + 1) - start.take(curves)).sum())
        k, w, c, told = len(rows), len(watched), len(curves), np.empty(4, np.int64)
        row, crossing, curve = np.empty(k, np.int64), np.empty(w, np.int64), np.empty(c, np.int64)
        xyz, gap, met = (
            np.empty((k, 3), np.int64), np.empty((w, 1), np.int64),
            np.empty((meetings, 4), np.int64),
        )  # fmt: skip
        bits = [
            read_only(each.view(np.int64)) for of in (values, before)
            for each in (of.xyz, of.gap, of.at, of.place)
        ]  # fmt: skip
        _compare(
            start, read_only(rows), read_only(watched), read_only(curves), *bits, row, xyz,
            crossing, gap, curve, met, told,
        )  # fmt: skip
        k, w, c, meetings = told.tolist()
        return NetEffect(row[:k], xyz[:k], crossing[:w], gap[:w], curve[:c], met[:meetings])


def _columns(values: Values) -> tuple[NDArray[np.generic], ...]:
    return (
        values.xyz, values.base, values.anchor_from, values.knot, values.block, values.at,
        values.place, values.segment, values.gap, values.folds, values.lowest,
    )  # fmt: skip


def read_only(array: NDArray[Scalar]) -> NDArray[Scalar]:
    """Give a view that cannot be written to: numba compiles anew for one that can."""
    if not array.flags.writeable:
        return array
    view = array.view()
    view.setflags(write=False)
    return view


_SHAPES = {
    "direction": (2, 3), "end_kind": (2, 2), "end_vector": (2, 2, 3), "reader": (2, 2),
    "anchor": (2, 2), "normal": (2, 3), "numbers": (2, 7),
}  # fmt: skip
"""Of the arrays of a program that have more than one axis."""


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded.

    The kinds of the arrays are those of every program; there is nothing in them.
    """
    blank = {each.name: _blank(each.name, str(each.type)) for each in attrs.fields(Program)}
    features = {
        each.name: _blank(each.name, str(each.type)) for each in attrs.fields(CompiledFeatures)
    }
    program = Program(**blank | {"features": CompiledFeatures(**features)})  # type: ignore[arg-type]
    wide, deep, none = np.zeros((2, 3)), np.zeros((2, 2, 3)), np.zeros(0, np.int64)
    values = Values(
        wide, wide.copy(), deep, np.zeros(2), np.zeros(18), np.zeros(2), wide.copy(),
        np.zeros(2, np.int64), np.zeros(2), np.zeros(2, np.int64), np.zeros(2),
    )  # fmt: skip
    compiled = CompiledProgram(program)
    compiled.restore(values, values.copy(), compiled.run(values, values.copy(), none, none))
    compiled.splines(values, values, none)
    compiled.compare(values, values, none, none, none)
    return all([was_loaded(each) for each in (run, restore, gather, compare)])


def _blank(name: str, kind: str) -> object:
    """Give nothing, in an array of the kind of a part of a program; or a plain number."""
    if kind == "float":
        return 1.0
    dtype = {"Flags": np.int8, "IntArray": np.int64}.get(kind, np.float64)
    return read_only(np.zeros(_SHAPES.get(name, (2,)), dtype))

"""`loft`, compiled: same operations in the same order, same bits.

What needs no decision runs over all points at once, in short loops that the compiler turns
into vector instructions (these change no bit); the rest runs curve by curve. All constants
come in as arguments: a compiled function in the cache of numba does not notice when a
constant of another module changes.

Examples
--------
>>> from assoc_hull.geometry.splines.compiled_loft import loft_curves
>>> callable(loft_curves)
True
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.jit import jit

__all__ = ["loft_curves"]

Flags = NDArray[np.int8]


@jit
def _set_chords(points: FloatArray, chord: FloatArray, slope: FloatArray) -> None:
    """Set length and direction of the chord before each point, across curves too."""
    size = points.shape[1]
    x, y, z = points[0], points[1], points[2]
    for i in range(1, size):
        step_x, step_y, step_z = x[i] - x[i - 1], y[i] - y[i - 1], z[i] - z[i - 1]
        chord[i] = sqrt(step_x * step_x + step_y * step_y + step_z * step_z)
    for k in range(3):
        line, result = points[k], slope[k]
        for i in range(1, size):
            result[i] = (line[i] - line[i - 1]) / chord[i]


@jit
def _set_rows(chord: FloatArray, slope: FloatArray, rows: FloatArray) -> None:
    """Set the rows of continuous curvature of all points, as if all were smooth."""
    size = rows.shape[1]
    before, after = rows[0], rows[4]
    for i in range(size):
        total = chord[i] + chord[i + 1]
        before[i] = chord[i + 1] / total
        after[i] = chord[i] / total
    for k in range(3):
        line, right = slope[k], rows[1 + k]
        for i in range(size):
            right[i] = (before[i] * line[i] + after[i] * line[i + 1]) * 1.5
    for i in range(size):
        before[i] *= -0.5
        after[i] *= -0.5


@jit
def _set_states(
    curve: int,
    begin: int,
    end: int,
    kind: Flags,
    end_kind: Flags,
    end_vector: FloatArray,
    state: Flags,
) -> int:
    """Set what fixes each derivative, as `loft_rules.states_of` does.

    Gives -1 if that is not known, 0 if all points between the ends are smooth, else 1.
    """
    unknown = 0
    for i in range(begin, end):
        unknown += (kind[i] < 0) | (kind[i] > 2)
        state[i] = kind[i]
    if unknown:
        return -1
    bound = 0
    for i in range(begin + 1, end - 1):
        bound += kind[i] != 0
    for side in range(2):
        given = end_kind[curve, side]
        if given < 0 or given > 2:
            return -1
        # Free, tangent, curvature: loose, given, curved.
        state[begin if side == 0 else end - 1] = (2, 1, 3)[given]
        for k in range(3):
            if given == 2 and not abs(end_vector[curve, side, k]) < np.inf:
                return -1
    return 1 if bound else 0


@jit
def _set_unit(x: float, y: float, z: float, i: int, leave: FloatArray, arrive: FloatArray) -> bool:
    """Set a given direction, normalised; False if it is nil or not finite."""
    length = sqrt(x * x + y * y + z * z)
    if not (length > 0.0 and length < np.inf):
        return False
    leave[0, i], leave[1, i], leave[2, i] = x / length, y / length, z / length
    for k in range(3):
        arrive[k, i] = leave[k, i]
    return True


@jit
def _set_end_derivative(
    near: int,
    beyond: int,
    neighbour: int,
    state: Flags,
    chord: FloatArray,
    slope: FloatArray,
    given: FloatArray,
    least_cosine: float,
    no_direction: float,
    result: FloatArray,
    i: int,
) -> None:
    """Set the derivative of a knuckle side or a free end at point i."""
    x, y, z = slope[0, near], slope[1, near], slope[2, near]
    result[0, i], result[1, i], result[2, i] = x, y, z
    if state[neighbour] >= 2:
        return
    if state[neighbour] == 1:
        e_x, e_y, e_z = given[0, neighbour], given[1, neighbour], given[2, neighbour]
    else:
        far, close = chord[beyond], chord[near]
        e_x = far * x + close * slope[0, beyond]
        e_y = far * y + close * slope[1, beyond]
        e_z = far * z + close * slope[2, beyond]
        squared = e_x * e_x + e_y * e_y + e_z * e_z
        if squared < no_direction:
            return
        length = sqrt(squared)
        e_x, e_y, e_z = e_x / length, e_y / length, e_z / length
    cosine = x * e_x + y * e_y + z * e_z
    if cosine <= least_cosine:
        cosine = 1.0
    result[0, i] = (3.0 * x - cosine * e_x) * 0.5
    result[1, i] = (3.0 * y - cosine * e_y) * 0.5
    result[2, i] = (3.0 * z - cosine * e_z) * 0.5


@jit
def _set_known(
    curve: int,
    begin: int,
    end: int,
    bound: int,
    state: Flags,
    direction: FloatArray,
    end_vector: FloatArray,
    chord: FloatArray,
    slope: FloatArray,
    least_cosine: float,
    no_direction: float,
    leave: FloatArray,
    arrive: FloatArray,
) -> bool:
    """Set the known derivatives of one curve, and the others nil.

    Without `bound` only the ends are looked at.
    """
    last = end - 1
    step = 1 if bound else last - begin
    for k in range(3):
        for i in range(begin, end, step):
            leave[k, i], arrive[k, i] = 0.0, 0.0
    for i in range(begin, end, step):
        if state[i] == 1:
            x, y, z = direction[i, 0], direction[i, 1], direction[i, 2]
            if i in (begin, last):
                side = 0 if i == begin else 1
                x, y, z = (
                    end_vector[curve, side, 0],
                    end_vector[curve, side, 1],
                    end_vector[curve, side, 2],
                )
            if not _set_unit(x, y, z, i, leave, arrive):
                return False
    for i in range(begin, end, step):
        if state[i] != 2:
            continue
        if i < last:
            _set_end_derivative(
                i + 1, i + 2, i + 1, state, chord, slope, leave,
                least_cosine, no_direction, leave, i,
            )  # fmt: skip
        if i > begin:
            _set_end_derivative(
                i, i - 1, i - 1, state, chord, slope, leave,
                least_cosine, no_direction, arrive, i,
            )  # fmt: skip
    for k in range(3):
        arrive[k, begin] = leave[k, begin]
        leave[k, last] = arrive[k, last]
    return True


@jit
def _set_curved_end(
    curve: int, i: int, near: int, end_vector: FloatArray, chord: FloatArray,
    slope: FloatArray, rows: FloatArray,
) -> None:  # fmt: skip
    """Set the row of an end whose second derivative is given."""
    first = near > i
    side = 0 if first else 1
    rows[0, i] = 0.0 if first else -0.5
    rows[4, i] = -0.5 if first else 0.0
    weight = (-0.25 if first else 0.25) * chord[near]
    for k in range(3):
        rows[1 + k, i] = slope[k, near] * 1.5 + weight * end_vector[curve, side, k]


@jit
def _detach_known(
    begin: int,
    end: int,
    bound: int,
    state: Flags,
    leave: FloatArray,
    arrive: FloatArray,
    rows: FloatArray,
) -> None:
    """Move what is known to the right-hand sides of its neighbours."""
    for i in range(begin, end):
        if not bound and begin + 1 < i < end - 2:
            continue
        if state[i] == 1 or state[i] == 2:
            for k in range(5):
                rows[k, i] = 0.0
            continue
        if i > begin and (state[i - 1] == 1 or state[i - 1] == 2):
            for k in range(3):
                rows[1 + k, i] += rows[0, i] * leave[k, i - 1]
            rows[0, i] = 0.0
        if i < end - 1 and (state[i + 1] == 1 or state[i + 1] == 2):
            for k in range(3):
                rows[1 + k, i] += rows[4, i] * arrive[k, i + 1]
            rows[4, i] = 0.0


@jit
def _reduce(tables: FloatArray, level: int, size: int) -> None:
    """Eliminate the rows of even place; the row after the last must be nil.

    Everything is indexed in full: a view of a row costs more than the work on it.
    """
    more = level + 1
    for j in range(size // 2):
        left, kept, right = 2 * j, 2 * j + 1, 2 * j + 2
        before, after = tables[level, kept, 0], tables[level, kept, 4]
        from_left, from_right = before * tables[level, left, 4], after * tables[level, right, 0]
        scale = 1.0 / (1.0 - (from_left + from_right))
        for k in range(1, 4):
            sum_ = before * tables[level, left, k] + tables[level, kept, k]
            sum_ = sum_ + after * tables[level, right, k]
            tables[more, j, k] = sum_ * scale
        tables[more, j, 0] = before * tables[level, left, 0] * scale
        tables[more, j, 4] = after * tables[level, right, 4] * scale
    for k in range(5):
        tables[more, size // 2, k] = 0.0


@jit
def _restore(tables: FloatArray, level: int, size: int) -> None:
    """Put the solutions of the kept rows back between those that follow from them."""
    more = level + 1
    for k in range(1, 4):
        first = tables[level, 0, 4] * tables[more, 0, k]
        tables[level, 0, k] = first + tables[level, 0, k]
    for j in range(1, (size + 1) // 2):
        before, after = tables[level, 2 * j, 0], tables[level, 2 * j, 4]
        for k in range(1, 4):
            even = after * tables[more, j, k] + tables[level, 2 * j, k]
            tables[level, 2 * j, k] = even + before * tables[more, j - 1, k]
    for j in range(size // 2):
        for k in range(1, 4):
            tables[level, 2 * j + 1, k] = tables[more, j, k]


@jit
def _solve_curve(
    begin: int, end: int, bound: int, rows: FloatArray, tables: FloatArray, most_levels: int,
    leave: FloatArray, arrive: FloatArray,
) -> None:  # fmt: skip
    """Solve one curve by cyclic reduction and add the solution to its derivatives.

    Without `bound` those between the ends are taken as nil. In `tables` the five numbers
    of a row lie together, in a line of the cache.
    """
    size = end - begin
    for i in range(size):
        for k in range(5):
            tables[0, i, k] = rows[k, begin + i]
    for k in range(5):
        tables[0, size, k] = 0.0
    level, count = 0, size
    while level < most_levels and count > 1:
        _reduce(tables, level, count)
        count //= 2
        level += 1
    while level > 0:
        level -= 1
        _restore(tables, level, size >> level)
    step = 1 if bound else size - 1
    for k in range(3):
        # The sums turn -0.0 into 0.0.
        for i in range(0, size, step):
            leave[k, begin + i] = 0.0 + (leave[k, begin + i] + tables[0, i, 1 + k])
            arrive[k, begin + i] = 0.0 + (arrive[k, begin + i] + tables[0, i, 1 + k])
        for i in range(1, 0 if bound else size - 1):
            leave[k, begin + i] = 0.0 + tables[0, i, 1 + k]
            arrive[k, begin + i] = 0.0 + tables[0, i, 1 + k]


@jit
def _set_knots(begin: int, end: int, chord: FloatArray, knot: FloatArray) -> None:
    """Sum the chords of one curve, one after the other."""
    total = 0.0
    knot[begin] = 0.0
    for i in range(begin + 1, end):
        total += chord[i]
        knot[i] = total


@jit
def loft_curves(
    start: IntArray,
    xyz: FloatArray,
    kind: Flags,
    direction: FloatArray,
    end_kind: Flags,
    end_vector: FloatArray,
    coincident: float,
    least_cosine: float,
    no_direction: float,
    most_levels: int,
    scratch: FloatArray,
    knot: FloatArray,
    block: FloatArray,
) -> bool:
    """Loft all curves into `knot` (n,) and `block` (9, n): points, derivatives.

    `scratch` has (9, n + 2) numbers.
    """
    size, most = len(xyz), 0
    chord, slope, rows = scratch[0], scratch[1:4], scratch[4:, :size]
    # All between is set with the chords.
    chord[0], chord[size:] = 1.0, 1.0
    slope[:, 0], slope[:, size:] = 0.0, 0.0
    state = np.empty(size, np.int8)
    points, leave, arrive = block[:3], block[3:6], block[6:]
    for k in range(3):
        for i in range(size):
            points[k, i] = xyz[i, k]
    _set_chords(points, chord, slope)
    for curve in range(len(start) - 1):
        begin, end = start[curve], start[curve + 1]
        most = max(most, end - begin)
        if end - begin < 2:
            return False
        chord[begin] = 1.0
    wrong = 0
    for i in range(len(chord)):
        wrong += not ((chord[i] >= coincident) & (chord[i] < np.inf))
    if wrong:
        return False
    _set_rows(chord, slope, rows)
    tables = np.empty((most_levels + 1, most + 1, 8))
    for curve in range(len(start) - 1):
        begin, end = start[curve], start[curve + 1]
        bound = _set_states(curve, begin, end, kind, end_kind, end_vector, state)
        if bound < 0:
            return False
        if not _set_known(
            curve, begin, end, bound, state, direction, end_vector, chord, slope,
            least_cosine, no_direction, leave, arrive,
        ):  # fmt: skip
            return False
        if state[begin] == 3:
            _set_curved_end(curve, begin, begin + 1, end_vector, chord, slope, rows)
        if state[end - 1] == 3:
            _set_curved_end(curve, end - 1, end - 1, end_vector, chord, slope, rows)
        _detach_known(begin, end, bound, state, leave, arrive, rows)
        _solve_curve(begin, end, bound, rows, tables, most_levels, leave, arrive)
        _set_knots(begin, end, chord, knot)
    return True

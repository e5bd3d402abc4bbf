"""How lofted curves change when their points move: the loft itself, differentiated exactly.

Everything varies: chord lengths, and with them the parameters; the directions of the local
rule; the solution of the tridiagonal rows. Where the loft decides (a knuckle side that would
fold back, a parabola without a direction), it decides here as it did there. Chord-length
parameters kept as they were would give an area that is wrong in the third digit.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.loft_tangents import loft_tangents
>>> line = CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]]))
>>> stretched = np.array([[[0.0, 0, 0], [1, 0, 0]]])  # one tangent: the second point, forward
>>> loft_tangents(line, stretched).knot.dot.tolist()
[[0.0, 1.0]]
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.dual import Dual, as_array
from assoc_hull.geometry.loft_rules import (
    OPEN,
    add_curvature,
    curved_weights,
    is_curved,
    set_known,
    states_of,
)
from assoc_hull.geometry.spline import loft
from assoc_hull.geometry.tridiagonal import Slots, accumulate, slots_of, solve
from assoc_hull.geometry.workspace import Workspace

__all__ = ["DualSplines", "loft_tangents"]


@attrs.frozen(eq=False)
class DualSplines:
    """Lofted curves with tangents; the fields are those of a `SplineBatch`.

    Attributes
    ----------
    start : (m + 1,) int
        Where each curve's knots begin.
    knot : Dual (n,), m
        Chord-length parameter.
    xyz : Dual (n, 3), m
        The defining points.
    leave, arrive : Dual (n, 3)
        Derivative after and before each knot with respect to the chord-length parameter.
    """

    start: IntArray
    knot: Dual
    xyz: Dual
    leave: Dual
    arrive: Dual

    def __attrs_post_init__(self) -> None:
        for each in (self.knot, self.xyz, self.leave, self.arrive):
            each.setflags(write=False)

    @property
    def count(self) -> int:
        """Number of curves."""
        return len(self.start) - 1

    def batch(self) -> SplineBatch:
        """Give it as a batch, for functions that compute with its arrays alike.

        Returns
        -------
        SplineBatch
            Its arrays are `Dual`, and so is what `assoc_hull.geometry.segments.power` and
            `assoc_hull.geometry.integrals.section_area` give of it.
        """
        knot, xyz = as_array(self.knot), as_array(self.xyz)
        return SplineBatch(self.start, knot, xyz, as_array(self.leave), as_array(self.arrive))


_FEW = 0.4
"""If tangents move fewer of their points than this part, each curve is taken for itself."""

Tangents = tuple[FloatArray, FloatArray, FloatArray]
"""Three arrays of k tangents each."""


def loft_tangents(
    data: CurveData,
    xyz: FloatArray,
    direction: FloatArray | None = None,
    end_vector: FloatArray | None = None,
) -> DualSplines:
    """Loft curves, and differentiate the result with respect to k parameters.

    Parameters
    ----------
    data : CurveData
        Points (n, 3) in m, kinds and end conditions of m curves.
    xyz : (k, n, 3), m per unit of its parameter
        How the points move with each parameter.
    direction : (k, n, 3) or None
        How the given directions of tangent points change; not at all if None.
    end_vector : (k, m, 2, 3) or None
        How the vectors of the end conditions change; not at all if None.

    Returns
    -------
    DualSplines
        The splines of `loft`, bit for bit, with tangents.

    Raises
    ------
    TooFewPointsError, CoincidentPointsError, BadInputError
        As for `loft`; or tangents of another shape or that are not finite.

    Notes
    -----
    A curve costs as much as about two lofts of it for every tangent that moves it; curves
    that a tangent leaves alone cost nothing.
    """
    spline = loft(data)
    moved = _checked("the points", xyz, data.xyz, len(xyz))
    turned = _checked("directions", direction, data.direction, len(xyz))
    ended = _checked("end vectors", end_vector, data.end_vector, len(xyz))
    knot, leave, arrive = _differentiated(data, spline, (moved, turned, ended))
    return DualSplines(
        spline.start,
        Dual(spline.knot, knot),
        Dual(spline.xyz, moved),
        Dual(spline.leave, leave),
        Dual(spline.arrive, arrive),
    )


def _checked(name: str, given: FloatArray | None, value: FloatArray, count: int) -> FloatArray:
    """Give tangents of an array; views, as they are going to be read-only."""
    shape = (count, *value.shape)
    dot = np.zeros(shape) if given is None else np.asarray(given, np.float64)[...]
    if dot.shape != shape or not np.isfinite(dot).all():
        raise BadInputError(
            f"tangents of {name} of shape {dot.shape}, or not finite",
            "in loft_tangents",
            f"give {shape}",
        )
    return dot


def _differentiated(data: CurveData, spline: SplineBatch, dots: Tangents) -> Tangents:
    """Give tangents of knots (k, n) and of the derivatives after and before, (k, n, 3)."""
    touched = _touched(data, dots)
    if (touched @ np.diff(data.start)).sum() < _FEW * dots[0].shape[0] * dots[0].shape[1]:
        return _by_pairs(data, spline, dots, *np.nonzero(touched))
    arrays = (data.xyz, data.direction, data.end_vector)
    xyz, direction, ends = (as_array(Dual(*each)) for each in zip(arrays, dots, strict=True))
    moved = CurveData(data.start, xyz, data.kind, direction, data.end_kind, ends)
    knot, leave, arrive = _derived(moved, spline.leave.T)
    return knot, leave.swapaxes(1, 2), arrive.swapaxes(1, 2)


def _by_pairs(
    data: CurveData, spline: SplineBatch, dots: Tangents, tangent: IntArray, curve: IntArray
) -> Tangents:
    """Differentiate every curve for those tangents only that move it, in one batch of them."""
    counts = np.diff(data.start)[curve]
    start = np.concatenate([[0], np.cumsum(counts)])
    rows = np.arange(start[-1]) + np.repeat(data.start[curve] - start[:-1], counts)
    which = np.repeat(tangent, counts)
    knot, leave, arrive = np.zeros(dots[0].shape[:2]), *np.zeros((2, *dots[0].shape))
    if len(rows):
        pairs = CurveData(
            start,
            _paired(data.xyz, dots[0], rows, which),
            data.kind[rows],
            _paired(data.direction, dots[1], rows, which),
            data.end_kind[curve],
            _paired(data.end_vector, dots[2], curve, tangent),
        )
        found = _derived(pairs, spline.leave[rows].T)
        for whole, part in zip((knot, leave, arrive), found, strict=True):
            whole[which, rows] = part[0].T
    return knot, leave, arrive


def _touched(data: CurveData, dots: Tangents) -> NDArray[np.bool_]:
    """Tell which curves vary with which tangents, (k, m)."""
    xyz, direction, end_vector = ((each != 0.0).any(axis=-1) for each in dots)
    inside = np.logical_or.reduceat(xyz | direction, data.start[:-1], axis=1)
    return np.asarray(inside | end_vector.any(axis=2))


def _paired(value: FloatArray, dot: FloatArray, rows: IntArray, which: IntArray) -> FloatArray:
    """Give rows of values, each with one tangent."""
    return as_array(Dual(value[rows], dot[which, rows][None]))


def _derived(data: CurveData, solution: FloatArray) -> Tangents:
    """Differentiate the loft of curves whose points carry tangents.

    Returns tangents of knots (k, n) and of the derivatives after and before them, (k, 3, n).
    """
    slots, points = slots_of(data.start), data.xyz.T
    chord, slope = _chords(points, slots)
    state = states_of(data, slots)
    leave: Any = np.zeros_like(points)
    arrive: Any = np.zeros_like(points)
    set_known(data, slots, state, chord, slope, None, leave, arrive)
    before, right, after = _rows(data, slots, state, chord, slope)
    right[:, 1:] += before[1:] * leave[:, :-1]
    right[:, :-1] += after[:-1] * arrive[:, 1:]
    solved = _solved(slots, OPEN.take(state), before, right, after, solution)
    steps = chord.dot
    steps[:, slots.first] = 0.0
    return accumulate(slots, steps), leave.dot + solved, arrive.dot + solved


def _chords(points: Any, slots: Slots) -> tuple[Any, Any]:
    """Give length (n + 1,) and direction (3, n + 1) of the chord before each point."""
    step = points[:, 1:] - points[:, :-1]
    squares = np.where(slots.is_first[1:], 1.0, (step**2).sum(axis=0))
    length, edge = np.sqrt(squares), np.zeros((3, 1))
    slope = np.concatenate([edge, step / length, edge], axis=1)
    return np.concatenate([np.ones(1), length, np.ones(1)]), slope


def _rows(
    data: CurveData, slots: Slots, state: NDArray[np.int8], chord: Any, slope: Any
) -> tuple[Any, Any, Any]:
    """Set up the rows of continuous curvature: weights before (n,), right (3, n), and after."""
    total = chord[:-1] + chord[1:]
    before, after = chord[1:] / total, chord[:-1] / total
    if is_curved(state):
        curved_weights(slots, state, before, after)
    right = 1.5 * (before * slope[:, :-1] + after * slope[:, 1:])
    if is_curved(state):
        add_curvature(data, slots, state, chord, right)
    return -0.5 * before, right, -0.5 * after


def _solved(
    slots: Slots, open_: FloatArray, before: Dual, right: Dual, after: Dual, solution: FloatArray
) -> FloatArray:
    """Give the tangents (k, 3, n) of the solution of the rows, nil where it is known.

    The rows of the tangents are those of the solution; on the right stands also what the
    solution makes of the tangents of the weights.
    """
    count, size = before.dot.shape
    unknown = open_ * solution
    rows = np.zeros((2 + 3 * count, size + 1))
    inner = rows[1:-1, :size].reshape(count, 3, size)
    inner += right.dot
    inner[:, :, 1:] += before.dot[:, None, 1:] * unknown[:, :-1]
    inner[:, :, :-1] += after.dot[:, None, :-1] * unknown[:, 1:]
    rows[0, :size], rows[-1, :size] = before.value, after.value
    rows[:, :size] *= open_
    rows[0, 1:size] *= open_[:-1]
    rows[-1, : size - 1] *= open_[1:]
    with Workspace() as workspace:
        return solve(slots, rows, workspace).reshape(count, 3, size).copy()

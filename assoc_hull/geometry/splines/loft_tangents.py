"""The derivative of the loft: how splines change when the points change that they are made from.

`loft_tangents` lofts curves and differentiates the result by k parameters, exactly: chord lengths,
and with them the knots, directions of the local rule and the solution of the tridiagonal rows all
vary. (Knots kept as they were give an area that is wrong in the third digit.) Only right-hand
sides differ from tangent to tangent, so `LinearisedLoft` solves for all of them together. Where
the loft decides (a knuckle side that would fold back, a parabola without a direction), the
derivative takes the same branch.
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.numeric.dual import Dual, as_array
from assoc_hull.geometry.numeric.tridiagonal import (
    Slots,
    Workspace,
    running_sums,
    slots_of,
    solve_tridiagonal,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.loft_rules import (
    OPEN,
    add_curvature,
    curved_weights,
    set_known,
    states_of,
)

__all__ = [
    "CurveDataTangents",
    "DualSplines",
    "LinearisedLoft",
    "Tangents",
    "loft_tangents",
]

_BLOCK = 1 << 15
"""So many points are differentiated at once: what is computed stays in the fast memory."""

Tangents = tuple[FloatArray, FloatArray, FloatArray]
"""Of knots (k, n) and of the derivatives after and before each knot, (k, 3, n)."""


@attrs.frozen(eq=False)
class CurveDataTangents:
    """How what curves are made of changes: (k, n, 3), (k, n, 3) or None, (k, m, 2, 3) or None."""

    xyz: FloatArray
    direction: FloatArray | None
    end_vector: FloatArray | None

    def touched(self, start: IntArray) -> NDArray[np.bool_]:
        """Say which curves vary with which tangents, (k, m)."""
        moved = (self.xyz != 0.0).any(axis=2)
        if self.direction is not None:
            moved |= (self.direction != 0.0).any(axis=2)
        found = np.logical_or.reduceat(moved, start[:-1], axis=1)
        if self.end_vector is not None:
            found |= (self.end_vector != 0.0).any(axis=(2, 3))
        return np.asarray(found)

    def take(self, tangent: Any, rows: Any, curve_tangent: Any, curves: Any) -> CurveDataTangents:
        """Give the moves of some rows and some curves, for some tangents."""
        turned = None if self.direction is None else self.direction[tangent, rows]
        ended = None if self.end_vector is None else self.end_vector[curve_tangent, curves]
        return CurveDataTangents(self.xyz[tangent, rows], turned, ended)


@attrs.frozen(eq=False)
class LinearisedLoft:
    """What the loft of curves computed, and how that changes.

    Attributes
    ----------
    data : CurveData
        The curves.
    slots : Slots
        Their layout.
    state : (n,) int8
        What fixes the derivative at each point.
    chord, slope : (n + 1,), m; (3, n + 1)
        Length and direction of the chord before each point; 1 and zero between two curves.
    before, after : (n,)
        Weights of the rows of continuous curvature.
    turn : (3, n)
        How the right-hand sides change with the weights before.
    fixed : (n,) bool
        Where a weight cannot change: at an end with a given curvature.
    """

    data: CurveData
    slots: Slots
    state: NDArray[np.int8]
    chord: FloatArray
    slope: FloatArray
    before: FloatArray
    after: FloatArray
    turn: FloatArray
    fixed: NDArray[np.bool_]

    @classmethod
    def of(cls, data: CurveData, leave: FloatArray, arrive: FloatArray) -> LinearisedLoft:
        """Set it up for curves and the derivatives (3, n) that their loft has found."""
        slots, size = slots_of(data.start), len(data.xyz)
        state = states_of(data, slots)
        slope, chord = np.zeros((3, size + 1)), np.ones(size + 1)
        step = np.where(slots.is_first[1:], 0.0, np.diff(data.xyz.T))
        chord[1:-1] = np.where(slots.is_first[1:], 1.0, np.sqrt((step**2).sum(axis=0)))
        slope[:, 1:-1] = step / chord[1:-1]
        total = chord[:-1] + chord[1:]
        before, after = chord[1:] / total, chord[:-1] / total
        unknown = before.copy()
        curved_weights(slots, state, before, after)
        turn = 1.5 * (slope[:, :-1] - slope[:, 1:])
        turn[:, 1:] -= 0.5 * leave[:, :-1]
        turn[:, :-1] += 0.5 * arrive[:, 1:]
        return cls(data, slots, state, chord, slope, before, after, turn, before != unknown)

    def tangents(self, moves: CurveDataTangents) -> Tangents:
        """Differentiate knots (k, n) and the derivatives after and before, (k, 3, n)."""
        chord, slope = self._chords(moves.xyz)
        leave, arrive = self._known(moves, chord, slope)
        count, size = moves.xyz.shape[:2]
        together = max(1, _BLOCK // size)
        for first in range(0, count, together):
            part = slice(first, first + together)
            right = self._right(
                moves.take(part, slice(None), part, slice(None)),
                chord[part], slope[part], leave[part], arrive[part],
            )  # fmt: skip
            solved = self._solved(right)
            leave[part] += solved
            arrive[part] += solved
        return running_sums(self.slots, chord), leave, arrive

    def _chords(self, xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Differentiate length (k, n + 1) and direction (k, 3, n + 1) of the chords.

        Directions between two curves mean nothing: no row and no rule that counts sees them.
        """
        count, size = xyz.shape[:2]
        points = np.ascontiguousarray(xyz.swapaxes(1, 2))
        chord, slope = np.zeros((count, size + 1)), np.zeros((count, 3, size + 1))
        step = points[:, :, 1:] - points[:, :, :-1]
        along = self.slope[:, 1:-1]
        longer = chord[:, 1:-1]
        longer += (along * step).sum(axis=1)
        step -= along * longer[:, None]
        np.divide(step, self.chord[1:-1], out=slope[:, :, 1:-1])
        return chord, slope

    def _known(
        self, moves: CurveDataTangents, chord: FloatArray, slope: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Differentiate what is not solved for: given directions and the local rule."""
        zero = np.zeros((3, len(self.state)))
        leave, arrive = (Dual.constant(zero, len(slope)) for _ in range(2))
        set_known(
            self._moved(moves),
            self.slots,
            self.state,
            as_array(Dual(self.chord, chord)),
            as_array(Dual(self.slope, slope)),
            None,
            as_array(leave),
            as_array(arrive),
        )
        return leave.dot, arrive.dot

    def _moved(self, moves: CurveDataTangents) -> CurveData:
        """Give the curves with directions and end vectors that carry tangents, if they change."""
        data = self.data
        if moves.direction is not None:
            direction = as_array(Dual(data.direction, moves.direction))
            data = attrs.evolve(data, direction=direction)
        if moves.end_vector is not None:
            end_vector = as_array(Dual(data.end_vector, moves.end_vector))
            data = attrs.evolve(data, end_vector=end_vector)
        return data

    def _right(
        self,
        moves: CurveDataTangents,
        chord: FloatArray,
        slope: FloatArray,
        leave: FloatArray,
        arrive: FloatArray,
    ) -> FloatArray:
        """Differentiate the right-hand sides, (k, 3, n), and what the solution adds to them."""
        total = self.chord[:-1] + self.chord[1:]
        weight = chord[:, 1:] - self.before * (chord[:, :-1] + chord[:, 1:])
        weight /= np.where(
            self.fixed, np.inf, total
        )  # by infinity: a fixed weight has no derivative
        right = self.before * slope[:, :, :-1]
        right += self.after * slope[:, :, 1:]
        right *= 1.5
        right += weight[:, None] * self.turn
        known = np.flatnonzero(OPEN.take(self.state) == 0.0)
        ahead, behind = known[~self.slots.is_last[known]], known[~self.slots.is_first[known]]
        right[:, :, ahead + 1] -= 0.5 * self.before[ahead + 1] * leave[:, :, ahead]
        right[:, :, behind - 1] -= 0.5 * self.after[behind - 1] * arrive[:, :, behind]
        if self.fixed.any():
            both = as_array(Dual(np.zeros(right.shape[1:]), right))
            lengths = as_array(Dual(self.chord, chord))
            add_curvature(self._moved(moves), self.slots, self.state, lengths, both)
        return right

    def _solved(self, right: FloatArray) -> FloatArray:
        """Give the tangents (k, 3, n) of the solution of the rows, zero where it is known."""
        open_, size = OPEN.take(self.state), right.shape[2]
        rows = np.zeros((2 + 3 * len(right), size + 1))
        np.multiply(right.reshape(-1, size), open_, out=rows[1:-1, :size])
        rows[0, :size], rows[-1, :size] = -0.5 * self.before * open_, -0.5 * self.after * open_
        rows[0, 1:size] *= open_[:-1]
        rows[-1, : size - 1] *= open_[1:]
        with Workspace() as workspace:
            return solve_tridiagonal(self.slots, rows, workspace).reshape(right.shape).copy()


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
        """Give it as a batch whose arrays are `Dual`, for functions that compute with them."""
        knot, xyz = as_array(self.knot), as_array(self.xyz)
        return SplineBatch(self.start, knot, xyz, as_array(self.leave), as_array(self.arrive))


_FEW = 0.4
"""If tangents move fewer of their points than this part, each curve is taken for itself."""


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
    Where there are many tangents, each costs about as much as lofting the curves that it moves;
    curves that it leaves alone cost next to nothing.
    """
    spline = loft(data)
    moves = CurveDataTangents(
        _checked("the points", xyz, data.xyz, len(xyz)),
        None if direction is None else _checked("directions", direction, data.xyz, len(xyz)),
        None
        if end_vector is None
        else _checked("end vectors", end_vector, data.end_vector, len(xyz)),
    )
    knot, leave, arrive = _differentiated(data, spline, moves)
    return DualSplines(
        spline.start,
        Dual(spline.knot, knot),
        Dual(spline.xyz, moves.xyz),
        Dual(spline.leave, leave.swapaxes(1, 2)),
        Dual(spline.arrive, arrive.swapaxes(1, 2)),
    )


def _checked(name: str, given: FloatArray, value: FloatArray, count: int) -> FloatArray:
    """Give tangents of an array; views, as they are going to be read-only."""
    shape, dot = (count, *value.shape), np.asarray(given, np.float64)[...]
    if dot.shape != shape or not np.isfinite(dot).all():
        raise BadInputError(
            f"tangents of {name} of shape {dot.shape}, or not finite",
            "in loft_tangents",
            f"give {shape}",
        )
    return dot


def _differentiated(data: CurveData, spline: SplineBatch, moves: CurveDataTangents) -> Tangents:
    """Choose the way: all tangents of all curves, or each curve for those that move it."""
    touched = moves.touched(data.start)
    if (touched @ np.diff(data.start)).sum() < _FEW * moves.xyz[..., 0].size:
        tangent, curve = np.nonzero(touched)
        return _by_pairs(data, spline, moves, tangent, curve)
    return LinearisedLoft.of(data, spline.leave.T, spline.arrive.T).tangents(moves)


def _by_pairs(
    data: CurveData,
    spline: SplineBatch,
    moves: CurveDataTangents,
    tangent: IntArray,
    curve: IntArray,
) -> Tangents:
    """Differentiate curves for the tangents that move them, side by side in one batch."""
    counts = np.diff(data.start)[curve]
    start = np.concatenate([[0], np.cumsum(counts)])
    rows = np.arange(start[-1]) + np.repeat(data.start[curve] - start[:-1], counts)
    which = np.repeat(tangent, counts)
    count, size = moves.xyz.shape[:2]
    found = np.zeros((count, size)), *np.zeros((2, count, 3, size))
    if len(rows):
        pairs = CurveData(
            start,
            data.xyz[rows],
            data.kind[rows],
            data.direction[rows],
            data.end_kind[curve],
            data.end_vector[curve],
        )
        mine = moves.take(which[None], rows[None], tangent[None], curve[None])
        loft_at = LinearisedLoft.of(pairs, spline.leave[rows].T, spline.arrive[rows].T)
        for whole, dot in zip(found, loft_at.tangents(mine), strict=True):
            whole[which, ..., rows] = dot[0].T
    return found

"""What the loft of curves has computed, and how that changes when the curves are moved.

Only the right-hand sides of the tridiagonal rows change from tangent to tangent, so the
tangents of many parameters are solved for together.
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray
from assoc_hull.geometry.numeric.dual import Dual, as_array
from assoc_hull.geometry.numeric.tridiagonal import Slots, accumulate, slots_of, solve
from assoc_hull.geometry.numeric.workspace import Workspace
from assoc_hull.geometry.splines.loft_rules import (
    OPEN,
    add_curvature,
    curved_weights,
    set_known,
    states_of,
)

__all__ = ["LoftAt", "Moves", "Tangents"]

_BLOCK = 1 << 15
"""So many points are differentiated at once: what is computed stays in the fast memory."""

Tangents = tuple[FloatArray, FloatArray, FloatArray]
"""Of knots (k, n) and of the derivatives after and before each knot, (k, 3, n)."""


@attrs.frozen(eq=False)
class Moves:
    """How what curves are made of changes: (k, n, 3), (k, n, 3) or None, (k, m, 2, 3) or None."""

    xyz: FloatArray
    direction: FloatArray | None
    end_vector: FloatArray | None

    def touched(self, start: IntArray) -> NDArray[np.bool_]:
        """Tell which curves vary with which tangents, (k, m)."""
        moved = (self.xyz != 0.0).any(axis=2)
        if self.direction is not None:
            moved |= (self.direction != 0.0).any(axis=2)
        found = np.logical_or.reduceat(moved, start[:-1], axis=1)
        if self.end_vector is not None:
            found |= (self.end_vector != 0.0).any(axis=(2, 3))
        return np.asarray(found)

    def take(self, tangent: Any, rows: Any, curve_tangent: Any, curves: Any) -> Moves:
        """Give the moves of some rows and some curves, for some tangents."""
        turned = None if self.direction is None else self.direction[tangent, rows]
        ended = None if self.end_vector is None else self.end_vector[curve_tangent, curves]
        return Moves(self.xyz[tangent, rows], turned, ended)


@attrs.frozen(eq=False)
class LoftAt:
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
        Length and direction of the chord before each point; 1 and nil between two curves.
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
    def of(cls, data: CurveData, leave: FloatArray, arrive: FloatArray) -> LoftAt:
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

    def tangents(self, moves: Moves) -> Tangents:
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
        return accumulate(self.slots, chord), leave, arrive

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
        self, moves: Moves, chord: FloatArray, slope: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Differentiate what is not solved for: given directions and the local rule."""
        nil = np.zeros((3, len(self.state)))
        leave, arrive = (Dual.constant(nil, len(slope)) for _ in range(2))
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

    def _moved(self, moves: Moves) -> CurveData:
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
        moves: Moves,
        chord: FloatArray,
        slope: FloatArray,
        leave: FloatArray,
        arrive: FloatArray,
    ) -> FloatArray:
        """Differentiate the right-hand sides, (k, 3, n), and what the solution adds to them."""
        total = self.chord[:-1] + self.chord[1:]
        weight = chord[:, 1:] - self.before * (chord[:, :-1] + chord[:, 1:])
        weight /= np.where(self.fixed, np.inf, total)
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
        """Give the tangents (k, 3, n) of the solution of the rows, nil where it is known."""
        open_, size = OPEN.take(self.state), right.shape[2]
        rows = np.zeros((2 + 3 * len(right), size + 1))
        np.multiply(right.reshape(-1, size), open_, out=rows[1:-1, :size])
        rows[0, :size], rows[-1, :size] = -0.5 * self.before * open_, -0.5 * self.after * open_
        rows[0, 1:size] *= open_[:-1]
        rows[-1, : size - 1] *= open_[1:]
        with Workspace() as workspace:
            return solve(self.slots, rows, workspace).reshape(right.shape).copy()

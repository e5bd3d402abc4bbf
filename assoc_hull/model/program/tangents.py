"""Forward derivatives of the program of a net: how all its numbers change with moves of points.

A move goes the way of a run, level by level: riding points, knots and derivatives of curves (chord
lengths vary too), meetings by the implicit rule, points computed from them. It is the derivative of
`run_program` where that keeps the structure; where a run decides by a sign (a knuckle side that
would fold back) the derivative takes the branch that the numbers take.
"""

from __future__ import annotations

import itertools

import attrs
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.loft_tangents import DualSplines, loft_tangents
from assoc_hull.model.program.run_program import curve_data, ranges, spans
from assoc_hull.model.program.structure import Program, Values

__all__ = ["ValueTangents", "jacobian", "tangents"]

_TOGETHER = 32
"""Moves that are followed at once for a Jacobian, so that dense arrays stay small."""


@attrs.frozen(eq=False)
class ValueTangents:
    """How the numbers of a net change with each of k moves, per unit of it.

    Attributes
    ----------
    xyz : (k, rows, 3)
        Places of points.
    knot : (k, n)
        Chord parameters of defining points.
    block : (k, 9 n)
        Points of curves and their derivatives after and before them, as in `Values`.
    at, place : (k, q), (k, q, 3)
        Meetings: chord parameter, and place.
    curves : (k, m) bool
        Which curves each move reaches; all of the others is zero.
    """

    xyz: FloatArray
    knot: FloatArray
    block: FloatArray
    at: FloatArray
    place: FloatArray
    curves: NDArray[np.bool_]


def tangents(
    program: Program, values: Values, rows: IntArray, moves: FloatArray, held: IntArray
) -> ValueTangents:
    """Differentiate all numbers of a net with respect to k moves of points.

    Parameters
    ----------
    program : Program
        The structure.
    values : Values
        Its numbers, of a run that keeps the structure; only read.
    rows : (r,) int
        The points that are moved. One that is computed from a curve, or that rides, goes where
        these lead it as soon as the move reaches them.
    moves : (k, r, 3)
        Where each move leads them, m per unit of the move.
    held : (h,) int
        Riding points that stay where they were put.

    Returns
    -------
    ValueTangents
        Not finite at a meeting where the curve touches its plane and the move leads it away.

    Raises
    ------
    BadInputError
        If such a meeting gives a point of another curve.
    """
    work = _Moves.of(program, values, rows, moves, held)
    for first, stop in itertools.pairwise(program.level.tolist()):
        work.ride(first, stop)
        curves = np.flatnonzero(work.reached[:, first:stop].any(axis=0)) + first
        if len(curves):
            work.evaluate(curves)
    work.watch()
    return work.found


def jacobian(program: Program, values: Values, rows: IntArray) -> csr_array:
    """Give how all curves change with the coordinates of points, (9 n, 3 r).

    Rows are those of `Values.block`; the columns of a point are its x, y and z. Points that ride
    are moved too, and stay where they were put.
    """
    columns, parts = 3 * len(rows), list[tuple[FloatArray, IntArray, IntArray]]()
    for first in range(0, columns, _TOGETHER):
        column = np.arange(first, min(first + _TOGETHER, columns))
        mine, place = np.unique(column // 3, return_inverse=True)
        moves = np.zeros((len(column), len(mine), 3))
        moves[np.arange(len(column)), place, column % 3] = 1.0
        dot = tangents(program, values, rows[mine], moves, rows[mine]).block
        move, number = np.nonzero(dot)
        parts.append((dot[move, number], number, column[move]))
    nothing = np.zeros(0), np.zeros(0, np.int64), np.zeros(0, np.int64)
    entry, number, column = (np.concatenate(each) for each in zip(nothing, *parts, strict=True))
    shape = len(values.block), columns
    return csr_array(coo_array((entry, (number, column)), shape))


@attrs.frozen(eq=False)
class _Moves:
    """Derivatives under way: what each move has reached."""

    program: Program
    values: Values
    found: ValueTangents
    moved: NDArray[np.bool_]
    held: NDArray[np.bool_]

    @property
    def reached(self) -> NDArray[np.bool_]:
        return self.found.curves

    @classmethod
    def of(
        cls, program: Program, values: Values, rows: IntArray, moves: FloatArray, held: IntArray
    ) -> _Moves:
        count, points = len(moves), len(values.xyz)
        found = ValueTangents(
            np.zeros((count, points, 3)), np.zeros((count, len(values.knot))),
            np.zeros((count, len(values.block))), np.zeros((count, len(values.at))),
            np.zeros((count, len(values.at), 3)), np.zeros((count, program.curves), np.bool_),
        )  # fmt: skip
        stays = np.zeros(points, np.bool_)
        stays[held] = True
        work = cls(program, values, found, np.zeros((count, points), np.bool_), stays)
        found.xyz[:, rows] = moves
        work.mark(rows, (found.xyz[:, rows] != 0.0).any(axis=2))
        return work

    def mark(self, rows: IntArray, moved: NDArray[np.bool_]) -> None:
        """Note which moves (k, r) reach points, and so the curves made through these."""
        self.moved[:, rows] |= moved
        for side in range(2):
            reader = self.program.reader[rows, side]
            move, row = np.nonzero(moved & (reader >= 0))
            self.reached[move, reader[row]] = True

    def publish(self, rows: IntArray, dot: FloatArray, moves: NDArray[np.bool_]) -> None:
        """Set how points (r,) move, for the moves (k, r) that reach what they are made of."""
        self.found.xyz[:, rows] = np.where(moves[:, :, None], dot, self.found.xyz[:, rows])
        self.mark(rows, moves)

    def ride(self, first: int, stop: int) -> None:
        """Let the points that ride on the curves of a level move with their anchors."""
        program = self.program
        rows = program.riding[program.riding_start[first] : program.riding_start[stop]]
        rows = rows[~self.held[rows]]
        anchor = program.anchor[rows]
        there = anchor >= 0
        due = np.asarray((self.moved[:, anchor] & there).any(axis=2))
        shift = np.where(there[:, :, None], self.found.xyz[:, anchor], 0.0)
        weight = program.weight[rows][:, None]
        self.publish(rows, (1.0 - weight) * shift[:, :, 0] + weight * shift[:, :, 1], due)

    def evaluate(self, curves: IntArray) -> None:
        """Differentiate curves of one level, their meetings, and what is computed from them."""
        program, found = self.program, self.found
        knots = spans(program.start, curves)
        splines = loft_tangents(
            curve_data(program, self.values, curves), found.xyz[:, program.row[knots]]
        )
        found.knot[:, knots] = splines.knot.dot
        for a, b, c in zip(splines.start[:-1], splines.start[1:], curves.tolist(), strict=True):
            first, stop = 9 * program.start[c], 9 * program.start[c + 1]
            block = found.block[:, first:stop].reshape(len(found.block), 3, 3, b - a)
            for part, dual in enumerate((splines.xyz, splines.leave, splines.arrive)):
                block[:, part] = dual.dot[:, a:b].swapaxes(1, 2)
        meetings = spans(program.meet_start, curves)
        if len(meetings):
            found.at[:, meetings], found.place[:, meetings] = _meetings(
                program, self.values, splines, curves, meetings
            )
        driving = ranges(program.drive_start, program.drive, curves)
        self.publish(
            program.meet_row[driving],
            found.place[:, driving],
            self.reached[:, program.meet_curve[driving]],
        )

    def watch(self) -> None:
        """Let watched crossings move with their place on the first of their curves."""
        program = self.program
        both = program.meet_curve[np.stack([program.watch_a, program.watch_b])]
        reached = np.asarray(self.reached[:, both].any(axis=1))
        self.publish(program.watch, self.found.place[:, program.watch_a], reached)


def _meetings(
    program: Program, values: Values, splines: DualSplines, curves: IntArray, meetings: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Differentiate where curves meet planes: chord parameter (k, q) and place (k, q, 3).

    With the place P(u) at a fraction u of a segment, ``n . P`` does not change:
    ``du = -n . dP / (n . P')``.
    """
    curve = program.meet_curve[meetings]
    local = np.searchsorted(curves, curve)
    begin = splines.start[local] + values.segment[meetings]
    low, high = splines.knot.value[begin], splines.knot.value[begin + 1]
    length, at = high - low, values.at[meetings]
    # At a knot the fraction is 1 to the bit, whatever a division would give.
    u = np.where(at == high, 1.0, (at - low) / length)
    slope, partial = _on_segments(splines, begin, length, u)
    sets = np.searchsorted(program.first, program.meet_plane[meetings], "right") - 1
    normal = program.normal[sets]
    away = (partial * normal).sum(axis=2)
    # What is not led away from the plane stays where it is, also where the curve only touches it.
    with np.errstate(divide="ignore", invalid="ignore"):
        du = np.where(away == 0.0, 0.0, -away / (slope * normal).sum(axis=1))
    place = partial + slope * du[:, :, None]
    for fixed in (program.axis[sets], program.own_axis[curve]):
        flat = np.flatnonzero(fixed >= 0)
        place[:, flat, fixed[flat]] = 0.0
    knot = splines.knot.dot
    d_low, d_high = knot[:, begin], knot[:, begin + 1]
    return d_low + (d_high - d_low) * u + length * du, place


def _on_segments(
    splines: DualSplines, begin: IntArray, length: FloatArray, u: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give P'(u) on segments, (q, 3), and how P changes at a fixed u with each move, (k, q, 3)."""
    end, one = begin + 1, length[:, None]
    u = u[:, None]
    knot = splines.knot.dot
    longer = (knot[:, end] - knot[:, begin])[:, :, None]
    leave, arrive = splines.leave, splines.arrive
    slope = (
        6.0 * u * (1.0 - u) * (splines.xyz.value[end] - splines.xyz.value[begin])
        + (1.0 - u) * (1.0 - 3.0 * u) * one * leave.value[begin]
        + u * (3.0 * u - 2.0) * one * arrive.value[end]
    )
    rest = (1.0 - u) * (1.0 - u)
    partial = (
        rest * (1.0 + 2.0 * u) * splines.xyz.dot[:, begin]
        + u * u * (3.0 - 2.0 * u) * splines.xyz.dot[:, end]
        + u * rest * (longer * leave.value[begin] + one * leave.dot[:, begin])
        - u * u * (1.0 - u) * (longer * arrive.value[end] + one * arrive.dot[:, end])
    )
    return slope, partial

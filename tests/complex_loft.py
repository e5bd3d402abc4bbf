"""A loft of one curve in plain complex arithmetic, from its rule, for derivatives by complex step.

Piece by piece between the points where curvature may jump; each piece is a dense system of the
conditions themselves: equal second derivatives inside, what is given at its ends. The end of
a piece where nothing is given minimises the integral of the squared second derivative over
its first interval while the direction at the neighbour is kept.
"""

from __future__ import annotations

import itertools
from typing import Any

import attrs
import numpy as np

from assoc_hull.geometry.curves import CurveData, EndKind, PointKind, SplineBatch

__all__ = ["ComplexLoft", "as_batch", "complex_loft"]

Complex = np.typing.NDArray[np.complex128]
TURNED_BACK = 0.2
NO_DIRECTION = 1e-20


@attrs.frozen
class ComplexLoft:
    """Knots (n,), points and derivatives after and before them (n, 3) of one curve."""

    knot: Complex
    xyz: Complex
    leave: Complex
    arrive: Complex


def length(vector: Complex) -> Any:
    """The analytic length: no conjugate."""
    return np.sqrt((vector * vector).sum())


@attrs.frozen
class Problem:
    """One curve: points, what is given at each, and the chords between them."""

    xyz: Complex
    kind: list[str]
    vector: Complex
    chord: Complex

    @property
    def slope(self) -> Complex:
        """Direction of each chord; its lengths are those given."""
        return np.asarray(np.diff(self.xyz, axis=0) / self.chord[:, None])

    def turned(self) -> Problem:
        """The same curve run through from its end; directions turn, second derivatives stay."""
        turn = np.array([[1.0] if kind == "curvature" else [-1.0] for kind in self.kind])
        vector = (turn * self.vector)[::-1]
        return Problem(self.xyz[::-1], self.kind[::-1], vector, self.chord[::-1])


def complex_loft(
    xyz: Complex,
    kind: list[int],
    direction: Any,
    end_kind: tuple[int, int],
    end_vector: Any,
    chord: Any = None,
) -> ComplexLoft:
    """Loft one curve; with chord lengths that are given instead of measured if asked."""
    names = {PointKind.SMOOTH: "smooth", PointKind.TANGENT: "tangent", PointKind.KNUCKLE: "loose"}
    ends = {EndKind.FREE: "loose", EndKind.TANGENT: "tangent", EndKind.CURVATURE: "curvature"}
    told = [names[PointKind(each)] for each in kind]
    told[0], told[-1] = (ends[EndKind(each)] for each in end_kind)
    vector = np.array(direction, complex)
    vector[0], vector[-1] = end_vector
    measured = np.array([length(step) for step in np.diff(xyz, axis=0)])
    problem = Problem(
        np.asarray(xyz, complex), told, vector, measured if chord is None else np.asarray(chord)
    )
    leave, arrive = np.zeros(xyz.shape, complex), np.zeros(xyz.shape, complex)
    breaks = [i for i, each in enumerate(told) if each != "smooth"]
    for first, last in itertools.pairwise(breaks):
        found = piece(problem, first, last)
        leave[first:last], arrive[first + 1 : last + 1] = found[:-1], found[1:]
    arrive[0], leave[-1] = leave[0], arrive[-1]
    knot = np.concatenate([[0.0], np.cumsum(problem.chord)])
    return ComplexLoft(knot, problem.xyz, leave, arrive)


def piece(problem: Problem, first: int, last: int) -> Complex:
    """The derivatives at the points of one piece."""
    count = last - first + 1
    matrix, right = np.zeros((count, count), complex), np.zeros((count, 3), complex)
    for row in range(1, count - 1):
        i = first + row
        before, after = problem.chord[i - 1], problem.chord[i]
        matrix[row, row - 1 : row + 2] = after, 2.0 * (before + after), before
        right[row] = 3.0 * (after * problem.slope[i - 1] + before * problem.slope[i])
    matrix[0, :2], right[0] = end_row(problem, first)
    back = len(problem.xyz) - 1 - last
    matrix[-1, :-3:-1], given = end_row(problem.turned(), back)
    right[-1] = -given
    found: Any = np.linalg.solve(matrix, right)
    return np.asarray(found, complex)


def end_row(problem: Problem, i: int) -> tuple[Any, Any]:
    """What is known of the derivative after point i, and of the one at the next point."""
    chord, slope = problem.chord[i], problem.slope[i]
    if problem.kind[i] == "tangent":
        return (1.0, 0.0), problem.vector[i] / length(problem.vector[i])
    if problem.kind[i] == "curvature":
        return (2.0, 1.0), 3.0 * slope - 0.5 * chord * problem.vector[i]
    return (1.0, 0.0), straightest(slope, neighbour_direction(problem, i))


def neighbour_direction(problem: Problem, i: int) -> Any:
    """The direction at the next point, as far as it is known: given, or of a parabola."""
    if problem.kind[i + 1] == "tangent":
        return problem.vector[i + 1] / length(problem.vector[i + 1])
    if problem.kind[i + 1] != "smooth":
        return None
    near, far = problem.chord[i], problem.chord[i + 1]
    parabola = far * problem.slope[i] + near * problem.slope[i + 1]
    if float((parabola.real**2).sum()) < NO_DIRECTION:
        return None
    return parabola / length(parabola)


def straightest(slope: Complex, towards: Any) -> Any:
    """The derivative at the start for which the integral of the squared second one is least.

    With end derivatives d and m t on a unit interval the integral is
    ``4 (d.d + m d.t + m m - 3 s.(d + m t) + 3 s.s)``; both derivatives of it are nil where
    ``2 d + m t = 3 s`` and ``t.d + 2 m = 3 s.t``. Where the neighbour looks away from the
    chord, m is 1.
    """
    if towards is None:
        return slope
    if (slope * towards).sum().real <= TURNED_BACK:
        return 1.5 * slope - 0.5 * towards
    matrix = np.zeros((4, 4), complex)
    matrix[:3, :3], matrix[:3, 3] = 2.0 * np.eye(3), towards
    matrix[3, :3], matrix[3, 3] = towards, 2.0
    right = np.append(3.0 * slope, 3.0 * (slope * towards).sum())
    return np.linalg.solve(matrix, right)[:3]


def as_batch(
    data: CurveData,
    xyz: Complex,
    direction: Complex | None = None,
    end_vector: Complex | None = None,
    chord: Any = None,
) -> SplineBatch:
    """Loft the curves of a batch whose points, directions and end vectors are complex."""
    turned = data.direction if direction is None else direction
    ended = data.end_vector if end_vector is None else end_vector
    parts = []
    for curve in range(data.count):
        rows = slice(int(data.start[curve]), int(data.start[curve + 1]))
        kinds = [int(each) for each in data.kind[rows]]
        first, last = (int(each) for each in data.end_kind[curve])
        parts.append(
            complex_loft(xyz[rows], kinds, turned[rows], (first, last), ended[curve], chord)
        )
    arrays: list[Any] = [
        np.concatenate([getattr(each, name) for each in parts])
        for name in ("knot", "xyz", "leave", "arrive")
    ]
    return SplineBatch(data.start, *arrays)

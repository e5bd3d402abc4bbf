"""What fixes the derivative at each point of a curve, and the rules for what is not solved.

The arithmetic is that of numpy's functions and operators, so it runs alike on plain arrays,
for the loft itself, and on `assoc_hull.geometry.numeric.dual.Dual`, for its derivatives.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.loft_rules import states_of
>>> from assoc_hull.geometry.numeric.tridiagonal import slots_of
>>> line = CurveData.single(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), kind=[0, 2, 0])
>>> states_of(line, slots_of(line.start)).tolist()
[2, 2, 2]
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray, IntArray, PointKind
from assoc_hull.geometry.numeric.dual import real
from assoc_hull.geometry.numeric.tridiagonal import Slots

__all__ = [
    "LEAST_COSINE",
    "NO_DIRECTION",
    "OPEN",
    "add_curvature",
    "curve_name",
    "curved_weights",
    "is_curved",
    "set_known",
    "states_of",
]

_SOLVED, _GIVEN, _LOOSE, _CURVED = 0, 1, 2, 3
"""What fixes the derivative at a point: the tridiagonal rows (continuous curvature), a
given direction, the local rule for knuckle sides and free ends, a given curvature."""

OPEN = np.array([1.0, 0.0, 0.0, 1.0])
"""Whether the derivative of each state is an unknown of the tridiagonal rows."""

_STATE_OF_KIND = np.zeros(3, np.int8)
_STATE_OF_KIND[[PointKind.SMOOTH, PointKind.TANGENT, PointKind.KNUCKLE]] = _SOLVED, _GIVEN, _LOOSE
_STATE_OF_END = np.zeros(3, np.int8)
_STATE_OF_END[[EndKind.FREE, EndKind.TANGENT, EndKind.CURVATURE]] = _LOOSE, _GIVEN, _CURVED

LEAST_COSINE = 0.2
"""Below this cosine of neighbour direction and chord the local rule would fold back."""

NO_DIRECTION = 1e-20
"""Squared relative length of a parabola's derivative that is taken as no direction at all."""


def states_of(data: CurveData, slots: Slots) -> NDArray[np.int8]:
    """Say for each point what fixes its derivative.

    Parameters
    ----------
    data : CurveData
        The curves.
    slots : Slots
        Their layout.

    Returns
    -------
    (n,) int8
        States.

    Raises
    ------
    BadInputError
        If a kind is unknown.
    """
    try:
        state = _STATE_OF_KIND.take(data.kind)
        ends = _STATE_OF_END.take(data.end_kind)
    except IndexError:
        raise BadInputError(
            "a point kind or end kind is not 0, 1 or 2",
            "in the curve data",
            "use PointKind and EndKind",
        ) from None
    state[slots.first] = ends[:, 0]
    state[slots.last] = ends[:, 1]
    return state


def set_known(
    data: CurveData,
    slots: Slots,
    state: NDArray[np.int8],
    chord: FloatArray,
    slope: FloatArray,
    names: Sequence[str] | None,
    leave: FloatArray,
    arrive: FloatArray,
) -> None:
    """Set the derivatives after and before each point, zero where still to be solved.

    Parameters
    ----------
    data : CurveData
        The curves; directions and end vectors may be `Dual`, and so may what follows.
    slots : Slots
        Their layout.
    state : (n,) int8
        From `states_of`.
    chord : (n + 1,), m
        Length of the chord before each point.
    slope : (3, n + 1)
        Its direction, a unit vector.
    names : sequence of str or None
        What error messages call the curves.
    leave, arrive : (3, n)
        Zero; written to.

    Raises
    ------
    BadInputError
        If a needed direction is nil or not finite.
    """
    tangents = np.flatnonzero(state == _GIVEN)
    if len(tangents):
        leave[:, tangents] = arrive[:, tangents] = _unit_directions(data, slots, tangents, names)
    loose = np.flatnonzero(state == _LOOSE)
    if len(loose):
        ahead, behind = loose[~slots.is_last[loose]], loose[~slots.is_first[loose]]
        ends = _end_derivatives(ahead, behind, state, chord, slope, leave)
        leave[:, ahead], arrive[:, behind] = ends[:, : len(ahead)], ends[:, len(ahead) :]
        # The outer side of a curve's end has no meaning of its own: repeat the inner one.
        arrive[:, slots.first] = leave[:, slots.first]
        leave[:, slots.last] = arrive[:, slots.last]


def _unit_directions(
    data: CurveData, slots: Slots, tangents: IntArray, names: Sequence[str] | None
) -> FloatArray:
    curve, first, last = (each[tangents] for each in (slots.curve, slots.is_first, slots.is_last))
    ends = data.end_vector[curve]
    vectors = np.where(first[:, None], ends[:, 0], data.direction[tangents])
    given = np.where(last[:, None], ends[:, 1], vectors).T
    squares = given * given
    length = np.sqrt(squares[0] + squares[1] + squares[2])
    size = real(length)
    if not size.min() > 0.0 or not size.max() < np.inf:
        place = int(np.flatnonzero(~((size > 0.0) & (size < np.inf)))[0])
        worst, vector = int(tangents[place]), real(given)[:, place].tolist()
        raise BadInputError(
            f"the direction {vector} given at point {worst} is nil or not finite",
            f"in {curve_name(int(slots.curve[worst]), names)}",
            "give a direction, or make the point smooth or the end free",
        )
    units: FloatArray = given / length
    return units


def _end_derivatives(
    ahead: IntArray,
    behind: IntArray,
    state: NDArray[np.int8],
    chord: FloatArray,
    slope: FloatArray,
    given: FloatArray,
) -> FloatArray:
    """Apply the local rule after the points `ahead` and before the points `behind`.

    Traversed backwards both directions change sign and the rule stays as it is, so one
    formula serves both sides.
    """
    near = np.concatenate([ahead + 1, behind])
    beyond = np.concatenate([ahead + 2, behind - 1])
    neighbour = np.concatenate([ahead + 1, behind - 1])
    along = slope.take(near, axis=1)
    parabola = chord.take(beyond) * along + chord.take(near) * slope.take(beyond, axis=1)
    squares = parabola * parabola
    squared = squares[0] + squares[1] + squares[2]
    nil = squared < NO_DIRECTION
    squared[nil] = 1.0
    towards = parabola / np.sqrt(squared)
    fixed = state.take(neighbour)
    towards = np.where(fixed == _GIVEN, given.take(neighbour, axis=1), towards)
    products = along * towards
    cosine = products[0] + products[1] + products[2]
    cosine[cosine <= LEAST_COSINE] = 1.0
    result: FloatArray = (3.0 * along - cosine * towards) * 0.5
    # Nothing is known at the neighbour: a straight interval.
    return np.where((fixed >= _LOOSE) | (nil & (fixed == _SOLVED)), along, result)


def curved_weights(
    slots: Slots, state: NDArray[np.int8], before: FloatArray, after: FloatArray
) -> None:
    """At an end with a given curvature put all weight on the one interval there is.

    Parameters
    ----------
    slots : Slots
        The layout.
    state : (n,) int8
        From `states_of`.
    before, after : (n,)
        Weights of the intervals before and after each point; written to.
    """
    first = slots.first[state[slots.first] == _CURVED]
    last = slots.last[state[slots.last] == _CURVED]
    before[first], after[first] = 0.0, 1.0
    before[last], after[last] = 1.0, 0.0


def add_curvature(
    data: CurveData, slots: Slots, state: NDArray[np.int8], chord: FloatArray, right: FloatArray
) -> None:
    """Add given end curvatures to the right-hand sides.

    Parameters
    ----------
    data : CurveData
        The curves; end vectors may be `Dual`, and so may what follows.
    slots : Slots
        Their layout.
    state : (n,) int8
        From `states_of`.
    chord : (n + 1,), m
        Length of the chord before each point.
    right : (3, n)
        Written to.

    Raises
    ------
    BadInputError
        If a curvature is not finite.
    """
    for side, ends, shift, sign in ((0, slots.first, 1, -0.25), (1, slots.last, 0, 0.25)):
        curves = np.flatnonzero(state[ends] == _CURVED)
        vector = data.end_vector[curves, side].T
        if not np.isfinite(vector).all():
            raise BadInputError(
                "a given end curvature is not finite", "in the curve data", "correct or free it"
            )
        right[:, ends[curves]] += (sign * chord[ends[curves] + shift]) * vector


def curve_name(curve: int, names: Sequence[str] | None) -> str:
    """Give what error messages call a curve of a batch."""
    return f"curve {curve} of the batch" if names is None else names[curve]


def is_curved(state: NDArray[np.int8]) -> bool:
    """Say whether any end has a given curvature."""
    return bool((state == _CURVED).any())

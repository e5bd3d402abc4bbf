"""Aiming: the amplitudes of free parameters at which outputs of a hull are what is asked for.

`docs/aiming.md` has the equations.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    DependentTargetsError,
    TooFewFreeError,
    UnreachableError,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.aiming.newton_iteration import NewtonIteration, StoppingRule, iterate
from assoc_hull.variation.aiming.quadratic_program import RANK
from assoc_hull.variation.aiming.report import AimReport, make_report
from assoc_hull.variation.aiming.scaled_problem import Problem, ScaledProblem

__all__ = ["solve_targets"]

_WHERE = "in aiming"

_TOGETHER = 1e6
"""Targets that were missed with a larger condition than this cannot be told apart."""

_UNMOVED = 1e-5
"""A target that was missed, and that usual changes move by less than this part of its size, is
moved by the loft only."""


def solve_targets(
    problem: Problem,
    targets: ArrayLike,
    *,
    start: ArrayLike,
    scales_free: ArrayLike,
    scales_out: ArrayLike,
    bounds: ArrayLike | None = None,
    exact: bool = True,
    units: tuple[str, ...] = (),
    before: ArrayLike | None = None,
    rule: StoppingRule | None = None,
) -> AimReport:
    """Find amplitudes at which outputs have their targets, by Newton's method.

    With as many free parameters as targets the answer is the solution; with more, the one with the
    least total change: the root of the sum of squares of (amplitude - start) / scale. No hull
    is returned that the problem has not certified.

    Parameters
    ----------
    problem : Problem
        Outputs and derivatives at amplitudes, k of them.
    targets : (m,) float
        What outputs are to be, in their units.
    start : (k,) float
        Amplitudes of the present hull, from which changes are counted. Outside the bounds, the
        search begins at the nearest place within.
    scales_free : (k,) float
        Usual changes of amplitudes, above nil.
    scales_out : (m,) float
        Sizes of outputs, above nil, in their units: the residual is (value - target) / size.
    bounds : (k, 2) float, optional
        Least and greatest amplitudes; may be infinite.
    exact : bool
        Whether every target must be met. Otherwise the best compromise is returned where they
        cannot be: the least sum of squared residuals.
    units : tuple of str, optional
        Of the outputs, for messages.
    before : (m,) float, optional
        Values of the parent, which shortfalls refer to; those at the start if not given.
    rule : StoppingRule, optional
        When to end.

    Raises
    ------
    TooFewFreeError
        There are more targets than free parameters.
    DependentTargetsError
        Free parameters move some targets only together, or one not at all.
    UnreachableError
        A target lies beyond what bounds, or certified hulls, allow.
    BadInputError
        Numbers that are not finite, scales that are not above nil, bounds that exclude each
        other, arrays of another length.
    AssocHullError
        What the problem raises at the start.

    Examples
    --------
    A box hull of 100 m x 20 m x 6 m is to have 1 % more volume and the same waterplane:

    >>> import attrs, numpy as np
    >>> from assoc_hull.variation.aiming.target_solver import solve_targets
    >>> @attrs.frozen
    ... class Box:
    ...     free, outputs = ("breadth", "draught"), ("volume", "waterplane_area")
    ...     def at(self, change):
    ...         b, t = np.array([20.0, 6.0]) + change
    ...         values, jacobian = [100 * b * t, 100 * b], [[100 * t, 100 * b], [100, 0]]
    ...         return Hull(np.array(values), np.array(jacobian))
    >>> @attrs.frozen
    ... class Hull:
    ...     values: object
    ...     jacobian: object
    >>> found = solve_targets(
    ...     Box(), [12120, 2000], start=[0, 0], scales_free=[1, 1], scales_out=[12000, 2000]
    ... )
    >>> found.amplitudes.round(9).tolist(), len(found.steps) - 1
    ([0.0, 0.06], 1)
    """
    scaled = _scaled(problem, targets, start, scales_free, scales_out, bounds)
    counts = len(scaled.targets), len(scaled.origin)
    if exact and counts[0] > counts[1]:
        raise TooFewFreeError(*counts)
    first = scaled.start()
    was = np.array(first.hull.values) if before is None else _row(before, counts[0], "before")
    spoken = units or ("",) * counts[0]
    if exact and _torn(first.jacobian, first.misses):
        raise _dependent(make_report(NewtonIteration((), first, "nearest"), was, spoken))
    end = iterate(first, rule or StoppingRule())
    found = make_report(end, was, spoken)
    if exact and not found.reached:
        raise _refusal(found, scaled, end)
    return found


def _scaled(
    problem: Problem, targets: ArrayLike, start: ArrayLike, scales_free: ArrayLike,
    scales_out: ArrayLike, bounds: ArrayLike | None,
) -> ScaledProblem:  # fmt: skip
    """Check what is given, and take it together."""
    free, outputs = len(problem.free), len(problem.outputs)
    if not free or not outputs:
        raise BadInputError(
            f"{outputs} targets and {free} free parameters", _WHERE, "give one of each or more"
        )
    sizes = _row(scales_out, outputs, "scales_out", above_nil=True)
    usual = _row(scales_free, free, "scales_free", above_nil=True)
    wanted, origin = _row(targets, outputs, "targets"), _row(start, free, "start")
    return ScaledProblem(problem, wanted, sizes, origin, usual, *_bounds(bounds, free))


def _row(given: ArrayLike, count: int, name: str, *, above_nil: bool = False) -> FloatArray:
    """Take so many finite numbers, above nil if they must be."""
    try:
        found = np.array(given, np.float64)
    except (TypeError, ValueError):
        found = np.full(count, np.nan)
    kind = "numbers above 0" if above_nil else "finite numbers"
    right = np.isfinite(found).all() and not (above_nil and (found <= 0.0).any())
    if found.shape != (count,) or not right:
        raise BadInputError(f"{name} is {shown(given)}", _WHERE, f"give {kind}, {count} of them")
    return found


def _bounds(given: ArrayLike | None, count: int) -> tuple[FloatArray, FloatArray]:
    """Take bounds: low below high, no nan."""
    if given is None:
        return np.full(count, -np.inf), np.full(count, np.inf)
    try:
        found = np.array(given, np.float64)
    except (TypeError, ValueError):
        found = np.full(1, np.nan)
    if found.shape != (count, 2) or not (found[:, 0] <= found[:, 1]).all():
        raise BadInputError(
            f"bounds are {shown(given)}", _WHERE, f"give (low, high), {count} of them"
        )
    return found[:, 0].copy(), found[:, 1].copy()


def _torn(jacobian: FloatArray, misses: FloatArray) -> bool:
    """Tell whether a combination of targets that nothing moves is missed."""
    left, values, _ = np.linalg.svd(jacobian, full_matrices=True)
    rank = int((values > RANK * values.max(initial=0.0)).sum())
    stuck = left[:, rank:].T @ misses
    return bool(len(stuck)) and float(np.abs(stuck).max()) > 1e-9 * float(np.abs(misses).max())


def _dependent(found: AimReport) -> DependentTargetsError:
    return DependentTargetsError(found.together, found.condition)


def _refusal(found: AimReport, scaled: ScaledProblem, end: NewtonIteration) -> AssocHullError:
    """Say why not all targets are met."""
    worst = int(np.abs(found.misses / scaled.sizes).argmax())
    if not found.active and np.abs(end.place.jacobian[worst]).max() < _UNMOVED:
        return DependentTargetsError((found.outputs[worst],), found.condition)
    if not found.active and found.condition > _TOGETHER:
        return _dependent(found)
    return UnreachableError(
        found.outputs[worst], found.units[worst], float(found.targets[worst]),
        float(found.values[worst]), float(found.before[worst]), found.active, _why(end),
    )  # fmt: skip


def _why(end: NewtonIteration) -> str:
    """Say what is in the way where no bound is."""
    if end.why:
        return f"no certified hull beyond: {end.why}"
    return f"no answer after {len(end.steps) - 1} steps" if end.end == "spent" else ""

"""Displacements that make a net fairer, each the least of something within bounds, and the solver.

What is made least is

    E(d) = sum_k (d_k / (sigma |U^T n|_k))^2 + sum_i log(1 + (r_i / s)^2),    s = sigma / 2

with sigma the noise along the freedom of the points: a sum of squares for what noise does, and for
the residuals a measure that lets a few stay large (a bilge, a shoulder). It is solved by weighting
anew, w = 1 / (s^2 + r^2), each round one sparse system; bounds by an active set.

The least change of a net that keeps its curvature within bounds.

With residuals A d + b of a net, d the displacements of points along the normal, and curvatures
k_0 + K d of its lines that are not to pass bounds k,

    E(d) = sum over residuals i of v_i (A d)_i^2 / (s^2 + b_i^2)
         + sum over points j of (d_j / T_j)^2
         + sum over bounds l of w_l max(0, (k_0 + K d - k)_l)^2

is least within how far each point may go. As below it is the change of the residuals
that is small, weighed by what was there; what is asked for is not a place but the sign of a
curvature. [own]: fairing by a noise, or towards the residuals of another hull, adds sign changes.

The least change of batten residuals that some asked displacements make.

With residuals A d + b of a net, d the displacements of its free points along the normal, those
that are asked for are held, and all others answer so that

    E(d) = sum over residuals i of v_i (A d)_i^2 / (s^2 + b_i^2)
         + sum over points k of (d_k / (T D F_k))^2,      D = the largest |d| that is asked

is least within bounds. It is the *change* of the residual that is small, weighed by what was there:
a bilge bends freely, a straight run does not. F fades with the distance from what is asked; the
second term is a tether, without which the answer swings on beyond it as a batten does, and so are
the bounds: nothing goes farther than a tenth more than is asked, nor more than a tenth the other
way. [own], measured on three hulls: the residual itself in place of its change fairs what nobody
asked for, and fairing after a dent leaves it, for a dent is signal and no noise.

The least of a quadratic function within bounds, for sparse matrices.

A set of unknowns stands at its bounds, the others are solved for, and forces and bounds say which
set is next (Hintermueller, Ito & Kunisch, SIAM J. Optim. 13 (2002), pp. 865-888: the primal-dual
active set). Two to five factorisations were needed on nets of ships. Where sets go round in a ring,
as they do among hundreds of stiff unknowns, a method from within the bounds finds the set in 10 to
20 (Mehrotra, SIAM J. Optim. 2 (1992), pp. 575-601: predictor and corrector).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Literal

import attrs
import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse import csc_array, csr_array, diags_array
from scipy.sparse.linalg import SuperLU, splu
from threadpoolctl import ThreadpoolController

from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "BoxSolution",
    "FairSolution",
    "KeptSigns",
    "LeastChange",
    "elimination_order",
    "estimate_noise",
    "factorise",
    "first_factors",
    "hold_sums",
    "linear_algebra",
    "solve_battens",
    "solve_few",
    "solve_in_box",
]

_ACTIVE_SETS = 30
"""Sets that are tried, and again so many from within."""

_PATIENCE = 3
"""So many sets may have no fewer unknowns on the wrong side than the best one before them."""

_STEPS, _CLOSE, _WITHIN, _LEAST_FORCE = 60, 1e-7, 0.9995, 1e-3
"""Steps from within; the part of the room between its bounds by which each unknown may miss its
condition at the end; the part of the way to the nearest bound that a step goes; the least force of
a bound at first, of the largest."""


@attrs.frozen(eq=False)
class BoxSolution:
    """What makes a quadratic function least.

    Attributes
    ----------
    values : (n,)
        The unknowns.
    side : (n,) int
        1 or -1 where one stands at its upper or lower bound, else 0.
    factors : SuperLU or None
        Of the rows and columns of those that stand at none: `free` (k,) int; None without any.
    """

    values: FloatArray
    side: IntArray
    factors: SuperLU | None
    free: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.values, self.side, self.free)


Order = Literal["NATURAL", "MMD_AT_PLUS_A"]
"""In which unknowns are eliminated: as they stand, or so that the factors stay sparse."""


def factorise(matrix: csr_array | csc_array, order: Order = "MMD_AT_PLUS_A") -> SuperLU:
    """Factorise a symmetric positive matrix."""
    found: SuperLU = splu(
        csc_array(matrix), permc_spec=order, diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )
    return found


def solve_in_box(
    matrix: csr_array, gradient: FloatArray, low: FloatArray, high: FloatArray,
    side: IntArray | None = None, order: Order = "MMD_AT_PLUS_A",
) -> BoxSolution:  # fmt: skip
    """Make x H x / 2 + g x least for low <= x <= high; H is symmetric and positive.

    `side` (n,) says where unknowns stood in a problem like this one: that set is tried first.
    """
    problem = _Box(matrix, gradient, low, high, order)
    tried = problem.try_sets(np.zeros(len(gradient), np.int64) if side is None else side)
    if not tried.settled:
        # a ring of sets, or too many: who comes from within does not go round
        inner = problem.from_within()
        tried = problem.try_sets(problem.sides(inner))
        if not tried.settled:
            # unknowns that rounding alone holds at their bounds: the nearest of these sets with its
            # own values, or the first of them with the values from within
            first = tried.first
            within = attrs.evolve(first, values=problem.at_sides(inner, first.side))
            return min(within, tried.nearest, key=lambda each: problem.miss(each.values))
    return tried.nearest


@attrs.frozen(eq=False)
class _Tried:
    """The first of the sets that were tried, the nearest to the least, and whether that is it."""

    first: BoxSolution
    nearest: BoxSolution
    settled: bool


@attrs.frozen(eq=False)
class _Box:
    """A problem of `solve_in_box`."""

    matrix: csr_array
    gradient: FloatArray
    low: FloatArray
    high: FloatArray
    order: Order
    columns: csc_array = attrs.field(init=False)

    @columns.default
    def _columns(self) -> csc_array:
        return csc_array(self.matrix)

    def try_sets(self, side: IntArray) -> _Tried:
        """Go from set to set until one is right, or they come no nearer, or there were too many."""
        first = nearest = None
        least, fewest, patience = np.inf, len(self.gradient) + 1, _PATIENCE
        for _ in range(_ACTIVE_SETS):
            free = np.flatnonzero(side == 0)
            found = np.where(side < 0, self.low, np.where(side > 0, self.high, 0.0))
            factors = self.factors(free) if len(free) else None
            if factors is not None:
                found[free] = factors.solve(-(self.gradient[free] + (self.matrix @ found)[free]))
            new = self.sides(found)
            now = BoxSolution(np.clip(found, self.low, self.high), side.copy(), factors, free)
            wrong = int((new != side).sum())
            first = now if first is None else first
            if not wrong:
                return _Tried(first, now, True)
            miss = self.miss(now.values)
            if nearest is None or miss < least:
                nearest, least = now, miss
            fewest, patience = (wrong, patience) if wrong < fewest else (fewest, patience - 1)
            if patience == 0:
                break
            side = new
        assert first is not None, "one set at least is tried"
        assert nearest is not None, "one set at least is tried"
        return _Tried(first, nearest, False)

    def at_sides(self, found: FloatArray, side: IntArray) -> FloatArray:
        """Put unknowns at the bounds at which they stand, the others within."""
        at = np.where(side < 0, self.low, np.where(side > 0, self.high, found))
        inside: FloatArray = np.clip(at, self.low, self.high)
        return inside

    def factors(self, free: IntArray) -> SuperLU:
        """Factorise the rows and columns of some unknowns, ascending."""
        every, count = self.columns, len(self.gradient)
        mine = np.zeros(count, np.bool_)
        mine[free] = True
        column = np.repeat(np.arange(count), np.diff(every.indptr))
        kept = mine[every.indices] & mine[column]
        height = np.bincount(column[kept], minlength=count)[free]
        number = np.cumsum(mine) - 1
        part = csc_array(
            (every.data[kept], number[every.indices[kept]], np.append(0, np.cumsum(height))),
            (len(free), len(free)),
        )
        return factorise(part, self.order)

    def from_within(self) -> FloatArray:
        """Find the least by steps that keep off the bounds, to `_CLOSE` of the room between."""
        found, room = np.where(self.high > self.low, 0.0, self.low), self.high > self.low
        order = np.flatnonzero(room)
        if self.order != "NATURAL":
            # found once: the same places are filled at each step
            order = order[np.argsort(self.factors(order).perm_c)]
        part = csr_array(self.columns[order][:, order])
        gradient = (self.gradient + self.matrix @ found)[order]
        inside = _Box(part, gradient, self.low[order], self.high[order], "NATURAL")
        found[order] = inside._steps()
        return found

    def _steps(self) -> FloatArray:
        """Go to the least from the middle; there is room between all bounds."""
        # one row for each bound there is: the unknown, and whether it is kept above or below
        which = np.concatenate(
            [np.flatnonzero(np.isfinite(each)) for each in (self.low, self.high)]
        )
        lower = int(np.isfinite(self.low).sum())
        sign = np.where(np.arange(len(which)) < lower, 1.0, -1.0)
        at, count = self._middle(), len(self.gradient)
        bound = np.where(sign > 0.0, self.low[which], self.high[which])
        room, slope = sign * (at[which] - bound), self.matrix @ at + self.gradient
        force = np.maximum(np.abs(slope), _LEAST_FORCE * np.abs(slope).max())[which]
        for _ in range(_STEPS):
            if self.miss(at) <= _CLOSE:
                break
            mean = float(room @ force) / len(which)
            stiff = np.bincount(which, force / room, count)
            factors = factorise(self.matrix + diags_array(stiff), self.order)
            rest = self.matrix @ at + self.gradient
            target = np.zeros(len(which))
            for corrected in (False, True):
                pushed = np.bincount(which, sign * target / room, count)
                step = factors.solve(pushed - rest)
                closer = sign * step[which]
                more = target / room - force - force / room * closer
                part = min(_reach(room, closer), _reach(force, more))
                if not corrected:
                    # what the linear step leaves of the products tells how far they can be asked to
                    # fall, and its own second order is taken back
                    left = float((room + part * closer) @ (force + part * more)) / len(which)
                    target = (left / mean) ** 3 * mean - closer * more
            part *= _WITHIN
            at, room, force = at + part * step, room + part * closer, force + part * more
        return at

    def sides(self, found: FloatArray) -> IntArray:
        """Tell which unknowns their slopes press beyond a bound."""
        aim = found - (self.matrix @ found + self.gradient) / self.matrix.diagonal()
        at: IntArray = (aim > self.high).astype(np.int64) - (aim < self.low)
        return at

    def miss(self, found: FloatArray) -> float:
        """Tell how far the worst unknown is from its condition, of the room between its bounds."""
        aim = found - (self.matrix @ found + self.gradient) / self.matrix.diagonal()
        room = self.high - self.low
        wide = np.where(np.isfinite(room) & (room > 0.0), room, 1.0)
        return float((np.abs(found - np.clip(aim, self.low, self.high)) / wide).max())

    def _middle(self) -> FloatArray:
        """Give what lies well within all bounds."""
        low = np.where(np.isfinite(self.low), self.low, np.minimum(self.high - 1.0, 0.0))
        high = np.where(np.isfinite(self.high), self.high, np.maximum(self.low + 1.0, 0.0))
        middle: FloatArray = 0.5 * (low + high)
        return middle


def _reach(now: FloatArray, step: FloatArray) -> float:
    """Tell how much of a step leaves all of these positive; the whole at most."""
    falls = step < 0.0
    return min(1.0, float((-now[falls] / step[falls]).min(initial=np.inf)))


_SETS = 12
"""Sets of passed bounds that are tried: they may come in turns."""


@attrs.frozen(eq=False)
class KeptSigns:
    """Points that may move, and what their moves cost by themselves.

    Attributes
    ----------
    problem : BattenProblem
        The residuals of the net as it is.
    scale : float, m
        s.
    tether : (k,), m
        T of each point.
    low, high : (k,), m
        How far each may go.
    """

    problem: BattenProblem
    scale: float
    tether: FloatArray
    low: FloatArray
    high: FloatArray

    def answer(
        self, stiffer: FloatArray, rate: csr_array, beyond: FloatArray, weight: FloatArray,
        start: FloatArray,
    ) -> FloatArray:  # fmt: skip
        """Give the displacements (k,), m, found from those at the start.

        Parameters
        ----------
        stiffer : (r,)
            v: by what the residuals weigh more.
        rate : (l, k) sparse, 1/m2
            K: how curvatures change with displacements.
        beyond : (l,), 1/m
            By how much they pass their bounds without any; negative where they keep them.
        weight : (l,), m2
            What it costs to pass them.
        start : (k,), m
            Displacements that tell which are passed at first.
        """
        problem = self.problem
        a, was = problem.matrix, problem.residual
        stiff = diags_array(stiffer / (self.scale * self.scale + was * was))
        tether = diags_array(1.0 / (self.tether * self.tether))
        alone = csr_array(a.T @ (stiff @ a) + tether)
        found, before, side = start, None, None
        for _ in range(_SETS):
            passed = np.flatnonzero(rate @ found + beyond > 0.0)
            if before is not None and np.array_equal(passed, before):
                break
            before, k = passed, csr_array(rate[passed])
            matrix = csr_array(alone + k.T @ (diags_array(weight[passed]) @ k))
            gradient = k.T @ (weight[passed] * beyond[passed])
            solved = solve_in_box(matrix, gradient, self.low, self.high, side)
            found, side = solved.values, solved.side
        return found


_TETHER = 0.3
"""Times the largest displacement asked for: what a free point goes at the price of one."""

_BEYOND = 0.1
"""Times the same: how far one goes beyond what is asked, and how far the other way."""

_OUT = 1e-3
"""Where the fade is less, points stay."""


@attrs.frozen(eq=False)
class LeastChange:
    """Displacements that are asked of a net.

    Attributes
    ----------
    problem : BattenProblem
        The residuals of the net as it is.
    asked : (p,) int
        Which of its unknowns are asked for.
    amount : (p,), m
        How far, along the normal.
    """

    problem: BattenProblem
    asked: IntArray
    amount: FloatArray

    def answer(
        self, fade: FloatArray, scale: float, weight: FloatArray, side: IntArray | None = None
    ) -> tuple[FloatArray, IntArray]:
        """Give the displacements of all unknowns, (n,), m, and at which bounds they stand, (n,).

        `fade` (n,) is how far each may go, of 1; `scale` s, m; `weight` (r,) the v of residuals;
        `side` (n,) the bounds of an answer with the same fade, to begin with.
        """
        problem, largest = self.problem, float(np.abs(self.amount).max())
        held = np.zeros(len(fade))
        held[self.asked] = self.amount
        free = fade > _OUT
        free[self.asked] = False
        points = np.flatnonzero(free)
        bounds = np.zeros(len(fade), np.int64)
        if not len(points):
            return held, bounds
        # Rows of residuals that no free point has a part in change as they must.
        part = csr_array(problem.matrix[:, points])
        touched = np.flatnonzero(np.diff(part.indptr) > 0)
        part = part[touched]
        was = problem.residual[touched]
        stiff = weight[touched] / (scale * scale + was * was)
        forced = (problem.matrix @ held)[touched]
        slack = 1.0 / (_TETHER * largest * fade[points]) ** 2
        matrix = csr_array(part.T @ (diags_array(stiff) @ part) + diags_array(slack))
        low, high = (np.full(len(points), bound) for bound in _bounds(self.amount, largest))
        start = None if side is None else side[points]
        found = solve_in_box(matrix, part.T @ (stiff * forced), low, high, start)
        held[points], bounds[points] = found.values, found.side
        return held, bounds


def _bounds(amount: FloatArray, largest: float) -> tuple[float, float]:
    """Give how far points may go inwards and outwards, m."""
    beyond, other = 1.0 + _BEYOND, _BEYOND * largest
    # What is asked for the other way by a hair is no bound.
    return min(beyond * float(amount.min()), -other), max(beyond * float(amount.max()), other)


@cache
def linear_algebra() -> ThreadpoolController:
    """Give what holds linear algebra to a thread: small fronts gain nothing by more of them."""
    return ThreadpoolController()


_ROUNDS, _BOUNDED = 6, 2
"""Rounds of weights, and those of them that keep the bounds."""

_SHARE = 0.5
"""s = sigma / 2: within .03 of the best ratio of errors on nets of ships whose truth is known."""

_SIGNS, _SURPLUS, _START, _SAME, _MOST = 12, 1.3, 1e-3, 0.03, 15
"""Of the estimate of noise: vectors of signs, factor, first value (m), change, rounds."""

_SLOW, _FARTHEST = (0.3, 0.95), 3.0
"""Ratios of two steps of the logarithm after which one leads to their limit, by 3 at most."""

_SMALLEST = 1e-6
"""Less noise (m) is none."""


@attrs.frozen(eq=False)
class FairSolution:
    """Displacements of the points of a problem.

    Attributes
    ----------
    displacement : (k,), m
        Along the normal of the hull.
    side : (k,) int
        1 or -1 where a point ended at its upper or lower bound, else 0.
    noise : float, m
        sigma, along the freedom.
    solve : callable
        Gives H^-1 g for right-hand sides (k, m) that are zero at points on a bound.
    """

    displacement: FloatArray
    side: IntArray
    noise: float
    solve: Callable[[FloatArray], FloatArray] = attrs.field(repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(self.displacement, self.side)


@attrs.frozen(eq=False)
class _Weighted:
    """The quadratic problem of one round: H d = -g."""

    matrix: csr_array
    gradient: FloatArray

    @classmethod
    def of(cls, problem: BattenProblem, spread: FloatArray, s: float, d: FloatArray) -> _Weighted:
        """Weigh the residuals as they are at d; `spread` (k,), m, is sigma |U^T n|."""
        a, b = problem.matrix, problem.residual
        r = a @ d + b
        weight = 1.0 / (s * s + r * r)
        weighted = csr_array(diags_array(weight) @ a)
        matrix = csr_array(a.T @ weighted + diags_array(1.0 / (spread * spread)))
        return cls(matrix, weighted.T @ b)

    def within(self, limit: FloatArray, side: IntArray) -> BoxSolution:
        """Solve within -limit .. limit; `side` (k,) says which points are put at bounds first."""
        return solve_in_box(self.matrix, self.gradient, -limit, limit, side, "NATURAL")


def elimination_order(problem: BattenProblem) -> IntArray:
    """Give an order of the points in which sparse factors stay sparse."""
    ones = np.ones(len(problem.rows))
    weighted = _Weighted.of(problem, ones, 1.0, np.zeros(len(problem.rows)))
    found: IntArray = np.argsort(factorise(weighted.matrix).perm_c)
    return found.astype(np.int64)


def first_factors(problem: BattenProblem, noise: float) -> SuperLU:
    """Factorise the system of a first round, its order found anew: the unit of time of all else."""
    spread = noise * problem.freedom
    weighted = _Weighted.of(problem, spread, _SHARE * noise, np.zeros(len(spread)))
    return factorise(weighted.matrix)


def solve_battens(
    problem: BattenProblem, noise: float, share: FloatArray | None = None,
    limit: FloatArray | None = None, order: IntArray | None = None,
) -> FairSolution:  # fmt: skip
    """Find the displacements that take a stated noise out of a net.

    Parameters
    ----------
    problem : BattenProblem
        About the given places.
    noise : float, m
        sigma: the standard deviation of the noise, along the freedom of the points.
    share : (k,) or None
        By what each point's own noise is multiplied: below 1 it moves less, above it is let go.
    limit : (k,) or None, m
        How far each may move along the normal; as far as it is drawn if None.
    order : (k,) int or None
        In which the points are eliminated; found anew if None.
    """
    order = elimination_order(problem) if order is None else order
    spread = (noise * problem.freedom * (1.0 if share is None else share))[order]
    within = None if limit is None else limit[order]
    ordered = attrs.evolve(problem, matrix=csr_array(problem.matrix[:, order]))
    s, d = _SHARE * noise, np.zeros(len(order))
    for _ in range(_ROUNDS if within is None else _ROUNDS - _BOUNDED):
        weighted = _Weighted.of(ordered, spread, s, d)
        whole = factorise(weighted.matrix, "NATURAL")
        d = whole.solve(-weighted.gradient)
    side, free = np.zeros(len(d), np.int64), np.arange(len(d))
    factors: SuperLU | None = whole
    if within is not None:
        for _ in range(_BOUNDED):
            weighted = _Weighted.of(ordered, spread, s, d)
            bounded = weighted.within(within, side)
            d, side, free, factors = bounded.values, bounded.side, bounded.free, bounded.factors
    place = order[free]

    def solve(right: FloatArray) -> FloatArray:
        found = np.zeros_like(right)
        if factors is not None:
            found[place] = factors.solve(np.ascontiguousarray(right[place]))
        return found

    back = np.argsort(order)
    return FairSolution(d[back], side[back], noise, solve)


def solve_few(
    problem: BattenProblem, noise: float, share: FloatArray | None, limit: FloatArray
) -> FloatArray:
    """Give the displacements that `solve_battens` finds, of a few points: by dense factors.

    Parameters
    ----------
    problem : BattenProblem
        About the given places, of some two hundred points at most.
    noise, share, limit
        As there; a solution that passes its limits is found there.
    """
    spread = noise * problem.freedom * (1.0 if share is None else share)
    a, b, s = problem.matrix.toarray(), problem.residual, _SHARE * noise
    diagonal, d = np.diag(1.0 / (spread * spread)), np.zeros(len(spread))
    for _ in range(_ROUNDS):
        r = a @ d + b
        weighted = a.T / (s * s + r * r)
        d = -cho_solve(cho_factor(weighted @ a + diagonal, check_finite=False), weighted @ b,
                       check_finite=False)  # fmt: skip
    if (np.abs(d) > limit).any():
        return solve_battens(problem, noise, share, limit).displacement
    return d


def estimate_noise(problem: BattenProblem, factor: float = 1.0) -> float:
    """Estimate the noise of a net along the freedom of its points, m.

    The noise is that at which what is taken out is as large as it: per degree of freedom that the
    solution leaves to the data, and 1.3 times, as the weights let large residuals go.

    Parameters
    ----------
    problem : BattenProblem
        About the given places.
    factor : float
        Of lengths, by the size of the hull.
    """
    count, signs = len(problem.rows), _signs(len(problem.rows))
    order = elimination_order(problem)
    noise, steps = factor * _START, list[float]()
    for _ in range(_MOST):
        spread = noise * problem.freedom
        found = solve_battens(problem, noise, order=order)
        trace = (signs * found.solve(signs / (spread * spread)[:, None])).sum() / _SIGNS
        square = float(((found.displacement / spread) ** 2).sum())
        new = _SURPLUS * noise * float(np.sqrt(square / max(count - trace, 1.0)))
        steps.append(float(np.log(max(new, factor * _SMALLEST) / noise)))
        if abs(steps[-1]) < _SAME:
            return noise * float(np.exp(steps[-1]))
        noise = max(noise * float(np.exp(_further(steps))), factor * _SMALLEST)
    return noise


def _further(steps: list[float]) -> float:
    """Give how far to go, in logarithms: where steps shrink slowly, to where they lead."""
    shrinks = steps[-1] / steps[-2] if len(steps) > 1 else 0.0
    if not _SLOW[0] < shrinks < _SLOW[1]:
        return steps[-1]
    whole = steps[-1] / (1.0 - shrinks)
    steps.clear()
    return float(np.clip(whole, -_FARTHEST, _FARTHEST))


def _signs(count: int) -> FloatArray:
    """Give fixed vectors of 1 and -1, (count, 12): bits of the numbers, well mixed."""
    number = np.arange(1, count * _SIGNS + 1, dtype=np.uint64)
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        number = (number ^ (number >> np.uint64(shift))) * np.uint64(factor)
    number ^= number >> np.uint64(31)
    found: FloatArray = np.where(number & np.uint64(1), 1.0, -1.0).reshape(count, _SIGNS)
    return found


def hold_sums(solution: FairSolution, sums: FloatArray, errors: FloatArray) -> FairSolution:
    """Move the solution, as little as it is stiff, so that sums of displacements change.

    Parameters
    ----------
    solution : FairSolution
        What was found.
    sums : (m, k)
        By how much each sum grows with each displacement.
    errors : (m,)
        By how much the sums are to be less than they are.
    """
    free = solution.side == 0
    inside = sums * free
    answer = solution.solve(inside.T) * free[:, None]
    # Of sums that nothing here changes, nothing is asked.
    force = np.linalg.lstsq(inside @ answer, errors)[0]
    return attrs.evolve(solution, displacement=solution.displacement - answer @ force)

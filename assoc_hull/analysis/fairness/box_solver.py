"""The least of a quadratic function within bounds, for sparse matrices.

A set of unknowns stands at its bounds, the others are solved for, and forces and bounds say which
set is next (Hintermueller, Ito & Kunisch, SIAM J. Optim. 13 (2002), pp. 865-888: the primal-dual
active set). Two to five factorisations were needed on nets of ships. Where sets go round in a ring,
as they do among hundreds of stiff unknowns, a method from within the bounds finds the set in 10 to
20 (Mehrotra, SIAM J. Optim. 2 (1992), pp. 575-601: predictor and corrector).
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array
from scipy.sparse.linalg import SuperLU, splu

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["BoxSolution", "factorise", "solve_in_box"]

_SETS = 30
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
        for _ in range(_SETS):
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

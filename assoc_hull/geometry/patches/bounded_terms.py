"""Polynomials of curvature together with what each of their coefficients may be off by.

A coefficient is off by at most (number of roundings) x 2**-53 x its amount, and by what its formula
gains in size where the control points may be off by delta; both as in `curvature_terms`.
The number of roundings follows from the degrees; for bicubic patches 200, 120 and 350 cover A,
|S|**2 and |S|**4. In exact arithmetic rounding was found to use less than 3 % of these bounds, and
uncertain points to reach theirs.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.bounded_terms import BoundedTerms
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
>>> found = BoundedTerms(Patches.single(net), 0.0).gauss()
>>> found.b[0, 0, 0].item(), bool(0.0 < found.err[0, 0, 0] < 1e-12)
(-1.0, True)
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches import curvature_terms
from assoc_hull.geometry.patches.algebra import degrees, elevated, multiply
from assoc_hull.geometry.patches.curvature_terms import Delta, Steps
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.running_bounds import EPS, Running

__all__ = ["Bounded", "BoundedTerms", "less", "margin"]

_ELEVATION = 60.0
"""Roundings of raising A to the degrees of |S|**4, and of the difference: for degree 7 about 50."""


@attrs.frozen(eq=False)
class Bounded:
    """Coefficients with their amounts: as the control points are, and as they may be.

    Attributes
    ----------
    b : (k, M + 1, N + 1)
        The coefficients.
    amount, wide : (k, M + 1, N + 1)
        The amount, and the amount with what control points off by delta do to the coefficient; the
        same array if all are exact.
    steps : float
        The roundings, with a margin.
    share : (k, 1, 1)
        What roundings count: 1 for exact control points, 3 for others, as then the difference of
        both amounts is rounded too.
    """

    b: FloatArray
    amount: FloatArray
    wide: FloatArray
    steps: float
    share: FloatArray

    @property
    def err(self) -> FloatArray:
        """What each coefficient may be off by."""
        rounding = self.share * (self.steps * EPS) * self.wide
        return rounding if self.wide is self.amount else rounding + (self.wide - self.amount)

    def times(self, other: Bounded, steps: float) -> Bounded:
        """Give the product, with the roundings it has."""
        amount = multiply(self.amount, other.amount)
        exact = self.wide is self.amount
        wide = amount if exact else multiply(self.wide, other.wide)
        return Bounded(multiply(self.b, other.b), amount, wide, steps, self.share)


def margin(steps: Steps, least: float) -> float:
    """Give the factor of a rounding bound: a little above the count, at least that given.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.bounded_terms import margin
    >>> from assoc_hull.geometry.patches.curvature_terms import steps
    >>> margin(steps(3, 3)["gauss"], 200.0), round(margin(steps(5, 5)["gauss"], 200.0))
    (200.0, 401)
    """
    return max(least, 1.15 * steps.count)


class BoundedTerms:
    """The terms of polynomial patches: values, amounts, and amounts of what may be wrong.

    Parameters
    ----------
    patches : Patches
        The patches, polynomial.
    delta : float or (k,), m
        How far each coordinate of a control point may be off.
    """

    def __init__(self, patches: Patches, delta: Delta) -> None:
        self.values = curvature_terms.values(patches)
        self.amounts = curvature_terms.amounts(self.values)
        self.sizes = self.wide = None
        if np.any(delta):
            self.sizes = curvature_terms.reaches(self.values, 0.0)
            self.wide = curvature_terms.reaches(self.values, delta)
        self.steps = curvature_terms.steps(*patches.degrees)
        self.share = np.where(np.reshape(delta, (-1, 1, 1)) > 0.0, 3.0, 1.0)

    def bounded(self, rule: Callable[..., FloatArray], name: str, least: float) -> Bounded:
        """Run a formula on values and amounts."""
        b, amount = rule(self.values), rule(self.amounts)
        wide = amount
        if self.wide is not None:
            wide = amount + np.maximum(rule(self.wide) - rule(self.sizes), 0.0)
        return Bounded(b, amount, wide, margin(self.steps[name], least), self.share)

    def gauss(self) -> Bounded:
        """Give A."""
        return self.bounded(curvature_terms.gauss_numerator, "gauss", 200.0)

    def area(self) -> Bounded:
        """Give |S|**2."""
        return self.bounded(curvature_terms.area_squared, "area", 120.0)

    def mean(self) -> Bounded:
        """Give B."""
        return self.bounded(curvature_terms.mean_numerator, "mean", 200.0)

    def quartic(self, area: Bounded) -> Bounded:
        """Give |S|**4 of |S|**2."""
        steps = self.steps["area"]
        return area.times(area, margin(steps.times(steps), 350.0))


def less(
    a: Bounded | Running, factor: float, b: Bounded | Running
) -> tuple[FloatArray, FloatArray]:
    """Give a - factor b, where b is of the higher degrees, and what it may be off by.

    Parameters
    ----------
    a, b : Bounded or Running
        The polynomials.
    factor : float
        Taken as exact.

    Returns
    -------
    (k, M + 1, N + 1), (k, M + 1, N + 1)
        Coefficients, and their errors.
    """
    m, n = degrees(b.b)
    off = elevated(a.err, m, n) + _ELEVATION * EPS * elevated(np.abs(a.b), m, n)
    return elevated(a.b, m, n) - factor * b.b, off + abs(factor) * b.err

"""Polynomials with the sign of a curvature less a level, with bounds of their errors.

`gauss_functions` and `mean_function` give one `IsoFunction` a level: a polynomial for every patch.
Polynomial patches take the counted bounds of `BoundedTerms`; rational ones carry running bounds.
Whatever reads a sign from these coefficients must respect their bound `err`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Self

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches import curvature_terms
from assoc_hull.geometry.patches.bernstein_polynomials import (
    EPS,
    BoundedPolynomial,
    degrees,
    elevated,
    multiply,
)
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.curvature_terms import Delta, RoundingSteps

__all__ = [
    "BoundedTerms",
    "CountedPolynomial",
    "IsoFunction",
    "RationalTerms",
    "bounded_difference",
    "gauss_function",
    "gauss_functions",
    "mean_function",
    "rounding_margin",
    "umbilic_function",
]

# Polynomial patches: a coefficient is off by at most (number of roundings) x 2**-53 x its amount,
# and by what its formula gains in size where control points may be off by delta
# (`curvature_terms`). For bicubic patches 200, 120 and 350 roundings cover A, |S|**2 and |S|**4. In
# exact arithmetic rounding used less than 3 % of these bounds; uncertain points reach theirs.

_ELEVATION = 60.0
"""Roundings of raising A to the degrees of |S|**4, and of the difference: for degree 7 about 50."""


@attrs.frozen(eq=False)
class CountedPolynomial:
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

    def times(self, other: CountedPolynomial, steps: float) -> CountedPolynomial:
        """Give the product, with the roundings it has."""
        amount = multiply(self.amount, other.amount)
        exact = self.wide is self.amount
        wide = amount if exact else multiply(self.wide, other.wide)
        return CountedPolynomial(multiply(self.b, other.b), amount, wide, steps, self.share)


def rounding_margin(steps: RoundingSteps, least: float) -> float:
    """Give the factor of a rounding bound: a little above the count, at least that given.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.curvature_functions import rounding_margin
    >>> from assoc_hull.geometry.patches.curvature_terms import steps
    >>> (
    ...     rounding_margin(steps(3, 3)["gauss"], 200.0),
    ...     round(rounding_margin(steps(5, 5)["gauss"], 200.0)),
    ... )
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

    def bounded(
        self, rule: Callable[..., FloatArray], name: str, least: float
    ) -> CountedPolynomial:
        """Run a formula on values and amounts."""
        b, amount = rule(self.values), rule(self.amounts)
        wide = amount
        if self.wide is not None:
            wide = amount + np.maximum(rule(self.wide) - rule(self.sizes), 0.0)
        return CountedPolynomial(
            b, amount, wide, rounding_margin(self.steps[name], least), self.share
        )

    def gauss(self) -> CountedPolynomial:
        """Give A."""
        return self.bounded(curvature_terms.gauss_numerator, "gauss", 200.0)

    def area(self) -> CountedPolynomial:
        """Give |S|**2."""
        return self.bounded(curvature_terms.area_squared, "area", 120.0)

    def mean(self) -> CountedPolynomial:
        """Give B."""
        return self.bounded(curvature_terms.mean_numerator, "mean", 200.0)

    def quartic(self, area: CountedPolynomial) -> CountedPolynomial:
        """Give |S|**4 of |S|**2."""
        steps = self.steps["area"]
        return area.times(area, rounding_margin(steps.times(steps), 350.0))


def bounded_difference(
    a: CountedPolynomial | BoundedPolynomial,
    factor: float,
    b: CountedPolynomial | BoundedPolynomial,
) -> tuple[FloatArray, FloatArray]:
    """Give a - factor b, where b is of the higher degrees, and the errors, (k, M + 1, N + 1) each.

    The factor counts as exact.
    """
    m, n = degrees(b.b)
    off = elevated(a.err, m, n) + _ELEVATION * EPS * elevated(np.abs(a.b), m, n)
    return elevated(a.b, m, n) - factor * b.b, off + abs(factor) * b.err


# --------------------------------------------------------------------------------------
# Rational patches: minors of differing weights are small sums of large terms, so errors are carried
# from operation to operation (`BoundedPolynomial`).

_FIRST, _SECOND = [0, 0, 0, 1, 1, 2], [1, 2, 3, 2, 3, 3]
"""The pairs of rows of the 2 x 2 minors of [H_u, H_v]."""

_EXPANSION = (
    ([1, 0, 0, 0], [5, 5, 4, 3], 1.0),
    ([2, 2, 1, 1], [4, 2, 2, 1], -1.0),
    ([3, 3, 3, 2], [3, 1, 0, 0], 1.0),
)
"""How T is summed: components of H, minors, and the sign of the first component; they alternate."""

_ALTERNATING = np.array([1.0, -1.0, 1.0, -1.0]).reshape(4, 1, 1)


@attrs.frozen(eq=False)
class RationalTerms:
    """Derivatives of weighted points, and tangent planes, with their errors.

    With the weighted points H = (w x, w y, w z, w), of degrees (m, n), the tangent plane is the
    vector of 3 x 3 minors T of [H, H_u, H_v], T = w**3 (S, -r.S) with S = r_u x r_v, and

        L* = T.H_uu = w**4 L      M* = T.H_uv = w**4 M      N* = T.H_vv = w**4 N

    are determinants of order 4. So A* = L* N* - M***2 = w**8 A has the sign of K, its degrees are
    (8m - 4, 8n - 4), and with S*, the first three components of T, K = A* w**4 / |S*|**4 of degrees
    (12m - 4, 12n - 4) above and below.

    Attributes
    ----------
    weight : BoundedPolynomial, (k, m + 1, n + 1)
        The weights, which are exact.
    huu, huv, hvv : BoundedPolynomial, (k, 4, ...), m
        Second derivatives of (w x, w y, w z, w); None where the degree is 1.
    plane : BoundedPolynomial, (k, 4, 3m, 3n)
        The minors T.
    """

    weight: BoundedPolynomial
    huu: BoundedPolynomial | None
    huv: BoundedPolynomial
    hvv: BoundedPolynomial | None
    plane: BoundedPolynomial

    @classmethod
    def of(cls, patches: Patches, delta: Delta) -> Self:
        """Give the terms of rational patches, with coordinates off by `delta`, one or (k,), m."""
        weight = np.ones(patches.net.shape[:3]) if patches.weight is None else patches.weight
        off = np.asarray(delta, np.float64).reshape(-1, 1, 1, 1)
        h, hu, hv = _weighted(patches, weight[:, None], off)
        m, n = patches.degrees
        huu = hu.derivative(-2) if m > 1 else None
        hvv = hv.derivative(-1) if n > 1 else None
        exact = BoundedPolynomial(weight, np.zeros_like(weight))
        return cls(exact, huu, hu.derivative(-1), hvv, _plane(h, hu, hv))

    def gauss(self) -> BoundedPolynomial:
        """Give A* = L* N* - M***2, (k, 8m - 3, 8n - 3), m6."""
        middle = self.plane.dot(self.huv)
        square = middle.times(middle)
        if self.huu is None or self.hvv is None:
            return BoundedPolynomial(0.0 - square.b, square.err)
        product = self.plane.dot(self.huu).times(self.plane.dot(self.hvv))
        return product.plus(square, -1.0)

    def weighted(self, a: BoundedPolynomial) -> BoundedPolynomial:
        """Give A* times w**4, (k, 12m - 3, 12n - 3), m6."""
        square = self.weight.times(self.weight)
        return a.times(square.times(square))

    def area(self) -> BoundedPolynomial:
        """Give |S*|**2, (k, 6m - 1, 6n - 1), m4."""
        s = self.plane[:3]
        return s.dot(s)

    def quartic(self, area: BoundedPolynomial) -> BoundedPolynomial:
        """Give |S*|**4 of |S*|**2, (k, 12m - 3, 12n - 3), m8."""
        return area.times(area)


def _weighted(
    patches: Patches, weight: FloatArray, off: FloatArray
) -> tuple[BoundedPolynomial, BoundedPolynomial, BoundedPolynomial]:
    """Give H, H_u and H_v with coordinates that are off by so much.

    Points are taken from a corner of the patch, which changes no minor. A difference of weighted
    points is w_1 (P_1 - P_0) + (w_1 - w_0) P_0, both exact but for their last digit.
    """
    points = patches.components
    place = points - points[..., :1, :1]
    place_off = off + EPS * np.abs(place)
    exact = np.zeros_like(weight)
    point = weight * place
    found = [_joined(point, weight * place_off + EPS * np.abs(point), weight, exact)]
    for axis, degree in zip((-2, -1), patches.degrees, strict=True):
        low, high = (np.arange(degree) + i for i in (0, 1))
        step, rise = np.diff(points, axis=axis), np.diff(weight, axis=axis)
        rise_off = EPS * np.abs(rise)
        first, second = weight.take(high, axis) * step, rise * place.take(low, axis)
        err = weight.take(high, axis) * (2.0 * off + EPS * np.abs(step))
        err = err + (np.abs(rise) + rise_off) * place_off.take(low, axis)
        err = err + 5.0 * EPS * (np.abs(first) + np.abs(second))
        found.append(
            _joined(degree * (first + second), degree * err, degree * rise, 2 * degree * rise_off)
        )
    return found[0], found[1], found[2]


def _joined(
    point: FloatArray, err: FloatArray, weight: FloatArray, weight_err: FloatArray
) -> BoundedPolynomial:
    """Put three components and the fourth together, (k, 4, m + 1, n + 1)."""
    return BoundedPolynomial(
        np.concatenate([point, weight], axis=1), np.concatenate([err, weight_err], axis=1)
    )


def _plane(h: BoundedPolynomial, hu: BoundedPolynomial, hv: BoundedPolynomial) -> BoundedPolynomial:
    """Give the minors of [H, H_u, H_v]."""
    minors = hu[_FIRST].times(hv[_SECOND]).plus(hu[_SECOND].times(hv[_FIRST]), -1.0)
    parts = []
    for rows, pairs, sign in _EXPANSION:
        part = h[rows].times(minors[pairs])
        parts.append(BoundedPolynomial(sign * _ALTERNATING * part.b, part.err))
    return parts[0].plus(parts[1]).plus(parts[2])


# --------------------------------------------------------------------------------------
# The functions whose zero sets are searched.
# Source: the idea of iso-curves of curvature on the patches of a plate is that of "Curvature Region
# Analysis for Application of Plates Forming", J. SNAK; degrees and bounds are our own.

Pair = tuple[FloatArray, FloatArray]
"""Coefficients, and what each may be off by."""

_CHUNK = 64
"""So many patches at once keep all coefficients in the cache of a processor."""


@attrs.frozen(eq=False)
class IsoFunction:
    """Polynomials, one a patch, whose zero sets are wanted.

    With A, B and S of `curvature_terms`, K = A / |S|**4 and H = B / (2 |S|**3) on polynomial
    patches of degrees (m, n), so the sign of

        K                is that of  A                      degrees (6m - 4, 6n - 4)
        K - K0           is that of  A - K0 |S|**4          (8m - 4, 8n - 4)
        H                is that of  B                      (5m - 3, 5n - 3)
        |H| - |H0|       is that of  B**2 - 4 H0**2 |S|**6  (10m - 6 and 12m - 6 in u)
        k1 - k2 (>= 0)   is that of  B**2 - 4 A |S|**2      (10m - 6, 10n - 6)

    The true degrees of A are one less each way; reducing them saves no work. On rational patches
    (`RationalTerms`) K has the sign of A*, (8m - 4, 8n - 4), and K - K0 that of
    A* w**4 - K0 |S*|**4, (12m - 4, 12n - 4).

    Attributes
    ----------
    b : (k, M + 1, N + 1)
        Bernstein coefficients; positive where the curvature lies above the level.
    err : (k, M + 1, N + 1)
        What each coefficient may be off by: rounding, and the uncertainty of the control points.
    """

    b: FloatArray
    err: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.b, self.err)


def _chunks(
    patches: Patches,
    delta: Delta,
    rule: Callable[[Patches, FloatArray], list[Pair]],
) -> tuple[IsoFunction, ...]:
    """Run a rule on so many patches at once as fit the cache, and put the results together."""
    each = np.broadcast_to(np.asarray(delta, np.float64), len(patches))
    parts = [slice(low, low + _CHUNK) for low in range(0, len(patches), _CHUNK)] or [slice(0)]
    found = [rule(patches[part], each[part]) for part in parts]
    return tuple(
        IsoFunction(*(np.concatenate([pair[i] for pair in column]) for i in (0, 1)))
        for column in zip(*found, strict=True)
    )


def _gauss_terms(
    patches: Patches, delta: FloatArray, banded: bool
) -> tuple[
    Pair, tuple[CountedPolynomial | BoundedPolynomial, CountedPolynomial | BoundedPolynomial] | None
]:
    """Give A; where a level is asked for, A and |S|**4 too, whose quotient is K."""
    if patches.weight is None:
        terms = BoundedTerms(patches, delta)
        a = terms.gauss()
        return (a.b, a.err), (a, terms.quartic(terms.area())) if banded else None
    rational = RationalTerms.of(patches, delta)
    found = rational.gauss()
    both = (rational.weighted(found), rational.quartic(rational.area())) if banded else None
    return (found.b, found.err), both


def gauss_functions(
    patches: Patches, levels: Sequence[float], delta: Delta = 0.0
) -> tuple[IsoFunction, ...]:
    """Give polynomials that are positive where the Gaussian curvature exceeds levels.

    Parameters
    ----------
    patches : Patches
        The patches.
    levels : sequence of float, 1/m2
        The curvatures K0. A and |S|**4 are found once for all of them.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much: one for all or each patch.

    Returns
    -------
    tuple of IsoFunction
        One a level: A, of degrees (6m - 4, 6n - 4), for 0; else A - K0 |S|**4, of degrees
        (8m - 4, 8n - 4); for rational patches (8m - 4, 8n - 4) and (12m - 4, 12n - 4). What is
        found for a patch does not depend on the others, to the last bit.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.curvature_functions import gauss_functions
    >>> from assoc_hull.geometry.patches.bezier_patches import Patches
    >>> net = np.zeros((2, 2, 3))
    >>> net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
    >>> zero, below = gauss_functions(Patches.single(net), (0.0, -2.0))
    >>> zero.b.max().item(), below.b[0, 0, 0].item()
    (-1.0, 1.0)
    """

    def rule(part: Patches, off: FloatArray) -> list[Pair]:
        a, both = _gauss_terms(part, off, any(levels))
        return [
            bounded_difference(both[0], level, both[1]) if both and level else a for level in levels
        ]

    return _chunks(patches, delta, rule)


def gauss_function(patches: Patches, level: float, delta: Delta = 0.0) -> IsoFunction:
    """Give the polynomial that is positive where K exceeds a level, 1/m2; see `gauss_functions`."""
    return gauss_functions(patches, (level,), delta)[0]


def _require_polynomial(patches: Patches) -> None:
    if patches.weight is not None:
        raise BadInputError(
            "patches have weights", "in mean curvature",
            "take polynomial patches, or values at points by `curvatures`",
        )  # fmt: skip


def mean_function(patches: Patches, level: float = 0.0, delta: Delta = 0.0) -> IsoFunction:
    """Give a polynomial with the zero set of the mean curvature less a level.

    Parameters
    ----------
    patches : Patches
        The patches.
    level : float, 1/m
        The curvature H0, in the sense of r_u x r_v.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much.

    Returns
    -------
    IsoFunction
        For 0 it is B, positive where H is. Else it is B**2 - 4 H0**2 |S|**6, positive where
        |H| > |H0|: of its zero set only the branch where B has the sign of H0 is wanted, the
        other one is H = -H0.

    Raises
    ------
    BadInputError
        Rational patches.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.curvature_functions import mean_function
    >>> from assoc_hull.geometry.patches.bezier_patches import Patches
    >>> net = np.zeros((4, 4, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
    >>> mean_function(Patches.single(net)).b.shape
    (1, 13, 13)
    """
    _require_polynomial(patches)

    def rule(part: Patches, off: FloatArray) -> list[Pair]:
        terms = BoundedTerms(part, off)
        b = terms.mean()
        if level == 0.0:
            return [(b.b, b.err)]
        area, steps = terms.area(), terms.steps
        square = b.times(b, rounding_margin(steps["mean"].times(steps["mean"]), 500.0))
        four = steps["area"].times(steps["area"])
        sextic = terms.quartic(area).times(area, rounding_margin(four.times(steps["area"]), 600.0))
        return [bounded_difference(square, 4.0 * level**2, sextic)]

    return _chunks(patches, delta, rule)[0]


def umbilic_function(patches: Patches, delta: Delta = 0.0) -> IsoFunction:
    """Give B**2 - 4 A |S|**2, which is zero where both principal curvatures are equal.

    Parameters
    ----------
    patches : Patches
        The patches.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much.

    Returns
    -------
    IsoFunction
        Of degrees (10m - 6, 10n - 6); 4 (H**2 - K) |S|**6, so never below zero but by `err`.

    Raises
    ------
    BadInputError
        Rational patches.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.curvature_functions import umbilic_function
    >>> from assoc_hull.geometry.patches.bezier_patches import Patches
    >>> net = np.zeros((4, 4, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
    >>> umbilic_function(Patches.single(net)).b.shape
    (1, 25, 25)
    """
    _require_polynomial(patches)

    def rule(part: Patches, off: FloatArray) -> list[Pair]:
        terms = BoundedTerms(part, off)
        b, steps = terms.mean(), terms.steps
        square = b.times(b, rounding_margin(steps["mean"].times(steps["mean"]), 500.0))
        both = steps["gauss"].times(steps["area"])
        product = terms.gauss().times(terms.area(), rounding_margin(both, 500.0))
        return [bounded_difference(square, 4.0, product)]

    return _chunks(patches, delta, rule)[0]

"""Polynomials that have the sign of Gaussian or mean curvature less a level, with error bounds.

With A, B and S of `curvature_terms`, K = A / |S|**4 and H = B / (2 |S|**3) on polynomial patches,
so the sign of

    K                is that of  A                                (6m - 4, 6n - 4)
    K - K0           is that of  A - K0 |S|**4                    (8m - 4, 8n - 4)
    H                is that of  B                                (5m - 3, 5n - 3)
    |H| - |H0|       is that of  B**2 - 4 H0**2 |S|**6            (10m - 6 and 12m - 6 in u)
    k1 - k2 (>= 0)   is that of  B**2 - 4 A |S|**2                (10m - 6, 10n - 6)

for patches of degrees (m, n), which stand at the right. The true degrees of A are one less each
way; reducing them saves no work. On rational patches, with A*, S* and w of `rational_terms`, K has
the sign of A*, (8m - 4, 8n - 4), and K - K0 that of A* w**4 - K0 |S*|**4, (12m - 4, 12n - 4).

Beside the coefficients stand bounds of what each may be off by: rounding, with the control points
taken as exact, and their uncertainty `delta`.

Source: the idea of iso-curves of curvature on the patches of a plate is that of "Curvature Region
Analysis for Application of Plates Forming", J. SNAK; degrees and bounds are our own.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.curvature_functions import gauss_function
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((4, 4, 3))
>>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
>>> found = gauss_function(Patches.single(net), 0.0)
>>> found.b.shape, bool((found.b == 0.0).all())
((1, 15, 15), True)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches import curvature_terms, rational_terms
from assoc_hull.geometry.patches.algebra import degrees, elevated, multiply
from assoc_hull.geometry.patches.curvature_terms import Delta, Steps
from assoc_hull.geometry.patches.patches import Patches

__all__ = [
    "IsoFunction", "gauss_function", "gauss_functions", "mean_function", "umbilic_function",
]  # fmt: skip

_EPS = 2.0**-53
_CHUNK = 64
"""So many patches at once keep all coefficients in the cache of a processor."""

_ELEVATION = 60.0
"""Roundings of raising A to the degrees of |S|**4, and of the difference: for degree 7 about 50."""


@attrs.frozen(eq=False)
class IsoFunction:
    """Polynomials, one a patch, whose zero sets are wanted.

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


@attrs.frozen(eq=False)
class _Bounded:
    """Coefficients with their amounts: as the control points are, and as they may be.

    Attributes
    ----------
    b : (k, M + 1, N + 1)
        The coefficients.
    amount, wide : (k, M + 1, N + 1)
        The amounts for control points that are exact, and that are off by delta; the same array
        if all are exact.
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
        rounding = self.share * (self.steps * _EPS) * self.wide
        return rounding if self.wide is self.amount else rounding + (self.wide - self.amount)

    def times(self, other: _Bounded, steps: float) -> _Bounded:
        """Give the product, with the roundings it has."""
        amount = multiply(self.amount, other.amount)
        exact = self.wide is self.amount
        wide = amount if exact else multiply(self.wide, other.wide)
        return _Bounded(multiply(self.b, other.b), amount, wide, steps, self.share)


def _margin(steps: Steps, least: float) -> float:
    """Give the factor of the rounding bound: a little above the count, at least that given."""
    return max(least, 1.15 * steps.count)


class _Bases:
    """The terms of some patches: values, amounts, and amounts of what may be wrong."""

    def __init__(self, patches: Patches, delta: Delta) -> None:
        self.kind = curvature_terms if patches.weight is None else rational_terms
        self.values = self.kind.values(patches)
        self.amounts = self.kind.amounts(patches, 0.0)
        self.wide = self.kind.amounts(patches, delta) if np.any(delta) else self.amounts
        self.steps = self.kind.steps(*patches.degrees)
        self.share = np.where(np.reshape(delta, (-1, 1, 1)) > 0.0, 3.0, 1.0)

    def bounded(self, rule: Callable[..., FloatArray], name: str, least: float) -> _Bounded:
        """Run a formula on values and amounts."""
        b, amount = rule(self.values), rule(self.amounts)
        wide = amount if self.wide is self.amounts else rule(self.wide)
        return _Bounded(b, amount, wide, _margin(self.steps[name], least), self.share)

    def gauss(self) -> _Bounded:
        return self.bounded(self.kind.gauss_numerator, "gauss", 200.0)

    def weighted(self, a: _Bounded) -> _Bounded:
        """Give A times what |S|**4 has as its factor: w**4 on rational patches."""
        if self.kind is curvature_terms:
            return a
        fourth = self.bounded(rational_terms.weight_fourth, "weight", 0.0)
        return a.times(fourth, _margin(self.steps["gauss"].times(self.steps["weight"]), 0.0))

    def area(self) -> _Bounded:
        return self.bounded(self.kind.area_squared, "area", 120.0)

    def mean(self) -> _Bounded:
        return self.bounded(curvature_terms.mean_numerator, "mean", 200.0)

    def quartic(self, area: _Bounded) -> _Bounded:
        """Give |S|**4 of |S|**2."""
        steps = self.steps["area"]
        return area.times(area, _margin(steps.times(steps), 350.0))


def _less(a: _Bounded, factor: float, b: _Bounded) -> tuple[FloatArray, FloatArray]:
    """Give a - factor b, where b is of the higher degrees, and what it may be off by."""
    m, n = degrees(b.b)
    off = elevated(a.err, m, n) + _ELEVATION * _EPS * elevated(np.abs(a.b), m, n)
    return elevated(a.b, m, n) - factor * b.b, off + abs(factor) * b.err


def _chunks(
    patches: Patches, delta: Delta, rule: Callable[[_Bases], list[tuple[FloatArray, FloatArray]]]
) -> tuple[IsoFunction, ...]:
    """Run a rule on so many patches at once as fit the cache, and put the results together."""
    each = np.broadcast_to(np.asarray(delta, np.float64), len(patches))
    parts = [slice(low, low + _CHUNK) for low in range(0, len(patches), _CHUNK)] or [slice(0)]
    found = [rule(_Bases(patches[part], each[part])) for part in parts]
    return tuple(
        IsoFunction(*(np.concatenate([pair[i] for pair in column]) for i in (0, 1)))
        for column in zip(*found, strict=True)
    )


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
    >>> from assoc_hull.geometry.patches.patches import Patches
    >>> net = np.zeros((2, 2, 3))
    >>> net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
    >>> zero, below = gauss_functions(Patches.single(net), (0.0, -2.0))
    >>> zero.b.max().item(), below.b[0, 0, 0].item()
    (-1.0, 1.0)
    """

    def rule(bases: _Bases) -> list[tuple[FloatArray, FloatArray]]:
        a = bases.gauss()
        if not any(levels):
            return [(a.b, a.err)] * len(levels)
        raised, quartic = bases.weighted(a), bases.quartic(bases.area())
        return [_less(raised, level, quartic) if level else (a.b, a.err) for level in levels]

    return _chunks(patches, delta, rule)


def gauss_function(patches: Patches, level: float, delta: Delta = 0.0) -> IsoFunction:
    """Give the polynomial that is positive where the Gaussian curvature exceeds a level.

    Parameters
    ----------
    patches : Patches
        The patches.
    level : float, 1/m2
        The curvature K0.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much.

    Returns
    -------
    IsoFunction
        As `gauss_functions` gives for one level.
    """
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
    >>> from assoc_hull.geometry.patches.patches import Patches
    >>> net = np.zeros((4, 4, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
    >>> mean_function(Patches.single(net)).b.shape
    (1, 13, 13)
    """
    _require_polynomial(patches)

    def rule(bases: _Bases) -> list[tuple[FloatArray, FloatArray]]:
        b = bases.mean()
        if level == 0.0:
            return [(b.b, b.err)]
        area, steps = bases.area(), bases.steps
        square = b.times(b, _margin(steps["mean"].times(steps["mean"]), 500.0))
        four = steps["area"].times(steps["area"])
        sextic = bases.quartic(area).times(area, _margin(four.times(steps["area"]), 600.0))
        return [_less(square, 4.0 * level**2, sextic)]

    return _chunks(patches, delta, rule)[0]


def umbilic_function(patches: Patches, delta: Delta = 0.0) -> IsoFunction:
    """Give B**2 - 4 A |S|**2, which is nil where both principal curvatures are equal.

    Parameters
    ----------
    patches : Patches
        The patches.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much.

    Returns
    -------
    IsoFunction
        Of degrees (10m - 6, 10n - 6); 4 (H**2 - K) |S|**6, so never below nil but by `err`.

    Raises
    ------
    BadInputError
        Rational patches.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.curvature_functions import umbilic_function
    >>> from assoc_hull.geometry.patches.patches import Patches
    >>> net = np.zeros((4, 4, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
    >>> umbilic_function(Patches.single(net)).b.shape
    (1, 25, 25)
    """
    _require_polynomial(patches)

    def rule(bases: _Bases) -> list[tuple[FloatArray, FloatArray]]:
        b, steps = bases.mean(), bases.steps
        square = b.times(b, _margin(steps["mean"].times(steps["mean"]), 500.0))
        both = steps["gauss"].times(steps["area"])
        product = bases.gauss().times(bases.area(), _margin(both, 500.0))
        return [_less(square, 4.0, product)]

    return _chunks(patches, delta, rule)[0]

"""What curvature is made of: derivatives, the normal S = r_u x r_v, and products of them.

With E = r_u.r_u, F = r_u.r_v, G = r_v.r_v and L = S.r_uu, M = S.r_uv, N = S.r_vv

    A = L N - M**2           |S|**2 = E G - F**2           B = E N - 2 F M + G L

of degrees (6m - 4, 6n - 4), (4m - 2, 4n - 2) and (5m - 3, 5n - 3) for a patch of degrees (m, n).

The same formulas are run twice: on values, and on amounts. An amount bounds the sum of the sizes of
all terms that a coefficient is summed of: every difference becomes a sum, every coefficient its
size. What rounding does to a coefficient is at most (number of roundings one after the other) x
2**-53 x its amount. What a change of the control points does to it is at most the formula of the
sizes of all differences, enlarged by it, less that of the sizes. These two bounds are our own.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.curvature_terms import amounts, area_squared, values
>>> from assoc_hull.geometry.patches.bezier_patches import Patches
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 1.0
>>> patch = Patches.single(net)
>>> area_squared(values(patch)).ravel(), area_squared(amounts(values(patch))).ravel()
(array([4., 4., 4., 4., 4., 4., 4., 4., 4.]), array([4., 4., 4., 4., 4., 4., 4., 4., 4.]))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bernstein_polynomials import (
    add_polynomials,
    dot_polynomials,
    multiply,
    subtract,
    u_derivative,
    v_derivative,
)  # fmt: skip
from assoc_hull.geometry.patches.bezier_patches import Patches

__all__ = [
    "Delta",
    "RoundingSteps",
    "Terms",
    "amounts",
    "area_squared",
    "difference",
    "gauss_numerator",
    "mean_numerator",
    "reaches",
    "steps",
    "sums",
    "values",
]  # fmt: skip

Delta = float | FloatArray
"""An uncertainty, m: one for all patches, or one for each, (k,)."""


@attrs.frozen(eq=False)
class Terms:
    """Derivatives and the normal of patches: values, or amounts.

    Attributes
    ----------
    signed : bool
        Whether these are values.
    ru, rv : (k, 3, m, n + 1) and (k, 3, m + 1, n), m
        First derivatives.
    ruu, ruv, rvv : (k, 3, ...), m
        Second derivatives; None where the degree is 1 and the derivative nil.
    s : (k, 3, 2m, 2n), m2
        The normal r_u x r_v, as long as the surface is stretched.
    """

    signed: bool
    ru: FloatArray
    rv: FloatArray
    ruu: FloatArray | None
    ruv: FloatArray
    rvv: FloatArray | None
    s: FloatArray


def difference(a: FloatArray, b: FloatArray, signed: bool) -> FloatArray:
    """Give a - b; of amounts a + b."""
    return subtract(a, b) if signed else add_polynomials(a, b)


def _normal(ru: FloatArray, rv: FloatArray, signed: bool) -> FloatArray:
    """Give the vector product; of amounts, the sums of sizes."""
    after, last = [1, 2, 0], [2, 0, 1]
    return difference(
        multiply(ru[:, after], rv[:, last]), multiply(ru[:, last], rv[:, after]), signed
    )


def values(patches: Patches) -> Terms:
    """Give the terms of polynomial patches.

    Parameters
    ----------
    patches : Patches
        The patches.

    Returns
    -------
    Terms
        Values.
    """
    r = patches.components
    ru, rv = u_derivative(r), v_derivative(r)
    m, n = patches.degrees
    ruu = u_derivative(ru) if m > 1 else None
    rvv = v_derivative(rv) if n > 1 else None
    return Terms(True, ru, rv, ruu, v_derivative(ru), rvv, _normal(ru, rv, True))


def sums(a: FloatArray, axis: int) -> FloatArray:
    """Bound the sizes of differences of neighbours, times the degree."""
    degree = a.shape[axis] - 1
    low, high = a.take(range(degree), axis), a.take(range(1, degree + 1), axis)
    return np.asarray(degree * (low + high))


def amounts(exact: Terms) -> Terms:
    """Give the amounts of terms, for bounds of rounding.

    Parameters
    ----------
    exact : Terms
        Values.

    Returns
    -------
    Terms
        Amounts; those of second derivatives are sums of the amounts of first ones, since these
        are what rounding goes into.
    """
    ru, rv = np.abs(exact.ru), np.abs(exact.rv)
    ruu = None if exact.ruu is None else sums(ru, -2)
    rvv = None if exact.rvv is None else sums(rv, -1)
    return Terms(False, ru, rv, ruu, sums(ru, -1), rvv, _normal(ru, rv, False))


def reaches(exact: Terms, delta: Delta) -> Terms:
    """Give how large terms may be in size, with control points that may be wrong.

    A formula of these sizes, less the same formula with a delta of nil, is what uncertain points
    do to its coefficients: in every product at least one factor is a change.

    Parameters
    ----------
    exact : Terms
        Values.
    delta : float or (k,), m
        How far each coordinate of a control point may be off.

    Returns
    -------
    Terms
        Amounts; second derivatives are differences before their size is taken, as a change of
        points adds to these and no more: on flat plates they are far less than sums.
    """
    m, n = exact.rv.shape[-2] - 1, exact.ru.shape[-1] - 1
    off = np.asarray(delta, np.float64).reshape(-1, 1, 1, 1)
    ru, rv = np.abs(exact.ru) + 2 * m * off, np.abs(exact.rv) + 2 * n * off
    ruu = None if exact.ruu is None else np.abs(exact.ruu) + 4 * m * (m - 1) * off
    rvv = None if exact.rvv is None else np.abs(exact.rvv) + 4 * n * (n - 1) * off
    ruv = np.abs(exact.ruv) + 4 * m * n * off
    return Terms(False, ru, rv, ruu, ruv, rvv, _normal(ru, rv, False))


def gauss_numerator(terms: Terms) -> FloatArray:
    """Give A = L N - M**2, (k, 6m - 3, 6n - 3), m6; K = A / |S|**4."""
    m = dot_polynomials(terms.s, terms.ruv)
    square = multiply(m, m)
    if terms.ruu is None or terms.rvv is None:
        return 0.0 - square if terms.signed else square
    product = multiply(dot_polynomials(terms.s, terms.ruu), dot_polynomials(terms.s, terms.rvv))
    return difference(product, square, terms.signed)


def area_squared(terms: Terms) -> FloatArray:
    """Give |S|**2, (k, 4m - 1, 4n - 1), m4: the square of the area of a unit of parameters."""
    return dot_polynomials(terms.s, terms.s)


def mean_numerator(terms: Terms) -> FloatArray:
    """Give B = E N - 2 F M + G L, (k, 5m - 2, 5n - 2), m5; H = B / (2 |S|**3)."""
    ru, rv, s = terms.ru, terms.rv, terms.s
    cross = 2.0 * multiply(dot_polynomials(ru, rv), dot_polynomials(s, terms.ruv))
    found = -cross if terms.signed else cross
    if terms.rvv is not None:
        found = found + multiply(dot_polynomials(ru, ru), dot_polynomials(s, terms.rvv))
    if terms.ruu is not None:
        found = found + multiply(dot_polynomials(rv, rv), dot_polynomials(s, terms.ruu))
    return found


@attrs.frozen
class RoundingSteps:
    """How many roundings lie one behind the other in a coefficient, at most.

    Attributes
    ----------
    degrees : (int, int)
        The degrees of the polynomial.
    count : int
        The roundings.
    """

    degrees: tuple[int, int]
    count: int

    def times(self, other: RoundingSteps, sums: int = 0) -> RoundingSteps:
        """Give those of a product: both factors, weights, a sum of terms, and `sums` after it."""
        (m, n), (p, q) = self.degrees, other.degrees
        terms = (min(m, p) + 1) * (min(n, q) + 1)
        return RoundingSteps((m + p, n + q), self.count + other.count + terms + 6 + sums)


def steps(m: int, n: int) -> dict[str, RoundingSteps]:
    """Give the roundings of A, |S|**2 and B for patches of degrees m and n.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.curvature_terms import steps
    >>> {name: each.count for name, each in steps(3, 3).items()}
    {'gauss': 153, 'area': 84, 'mean': 107}
    """
    ru, rv = RoundingSteps((m - 1, n), 2), RoundingSteps((m, n - 1), 2)
    s = ru.times(rv, 1)
    ruu, ruv = RoundingSteps((max(m - 2, 0), n), 4), RoundingSteps((m - 1, n - 1), 4)
    rvv = RoundingSteps((m, max(n - 2, 0)), 4)
    l, middle, right = s.times(ruu, 2), s.times(ruv, 2), s.times(rvv, 2)
    e, f, g = ru.times(ru, 2), ru.times(rv, 2), rv.times(rv, 2)
    gauss = max(l.times(right, 1), middle.times(middle, 1), key=_count)
    mean = max(e.times(right, 2), f.times(middle, 2), g.times(l, 2), key=_count)
    return {"gauss": gauss, "area": s.times(s, 2), "mean": mean}


def _count(steps: RoundingSteps) -> int:
    return steps.count

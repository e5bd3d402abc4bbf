"""Curvature polynomials of Bezier patches in whole numbers: no rounding, no Bernstein algebra.

Polynomials are arrays of Python integers, the coefficients of u**i v**j. Control points are floats,
so whole numbers of some power of two; `unit` says of which.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray

Exact = NDArray[Any]


def _powers(coefficients: Exact) -> Exact:
    """Turn Bernstein coefficients along the first axis into those of powers."""
    n = len(coefficients) - 1
    differences = [
        sum((-1) ** (k - i) * math.comb(k, i) * coefficients[i] for i in range(k + 1))
        for k in range(n + 1)
    ]
    return np.array([math.comb(n, k) * each for k, each in enumerate(differences)])


def product(a: Exact, b: Exact) -> Exact:
    """The product of two polynomials."""
    found = np.zeros((a.shape[0] + b.shape[0] - 1, a.shape[1] + b.shape[1] - 1), object)
    for i, j in np.argwhere(a != 0):
        found[i : i + b.shape[0], j : j + b.shape[1]] += a[i, j] * b
    return found


def total(*terms: Exact) -> Exact:
    """The sum of polynomials."""
    shape = np.array([term.shape for term in terms]).max(axis=0)
    found = np.zeros(shape, object)
    for term in terms:
        found[: term.shape[0], : term.shape[1]] += term
    return found


def _dot(a: list[Exact], b: list[Exact]) -> Exact:
    return total(*(product(x, y) for x, y in zip(a, b, strict=True)))


def _du(a: Exact) -> Exact:
    return (a[1:] * np.arange(1, len(a))[:, None]) if len(a) > 1 else np.zeros((1, 1), object)


def _dv(a: Exact) -> Exact:
    return np.ascontiguousarray(_du(a.T).T)


def degrees(a: Exact) -> tuple[int, int]:
    """The highest powers of u and v that are there."""
    found = np.argwhere(a != 0).max(axis=0)
    return int(found[0]), int(found[1])


@attrs.frozen(eq=False)
class ExactPatch:
    """The polynomials of a patch, times a power of `unit`: as many as there are lengths in it."""

    unit: int
    s: list[Exact]
    l: Exact
    m: Exact
    n: Exact
    e: Exact
    f: Exact
    g: Exact

    @property
    def a(self) -> Exact:
        """The numerator of K."""
        return total(product(self.l, self.n), -product(self.m, self.m))

    @property
    def area(self) -> Exact:
        """The square of the normal."""
        return _dot(self.s, self.s)

    @property
    def quartic(self) -> Exact:
        """Its fourth power."""
        return product(self.area, self.area)

    @property
    def b(self) -> Exact:
        """The numerator of H."""
        cross = product(self.f, self.m)
        return total(product(self.e, self.n), -2 * cross, product(self.g, self.l))


def exact_patch(net: FloatArray) -> ExactPatch:
    """The polynomials of a control net (m + 1, n + 1, 3)."""
    fractions = [[[Fraction(float(x)) for x in point] for point in row] for row in net]
    unit = max(x.denominator for row in fractions for point in row for x in point)
    whole = np.array([[[int(x * unit) for x in p] for p in row] for row in fractions], object)
    r = [_powers(_powers(whole[..., axis]).T).T for axis in range(3)]
    ru, rv = [_du(x) for x in r], [_dv(x) for x in r]
    s = [total(product(ru[i], rv[j]), -product(ru[j], rv[i])) for i, j in ((1, 2), (2, 0), (0, 1))]
    second = [_du(x) for x in ru], [_dv(x) for x in ru], [_dv(x) for x in rv]
    l, m, n = (_dot(s, each) for each in second)
    return ExactPatch(unit, s, l, m, n, _dot(ru, ru), _dot(ru, rv), _dot(rv, rv))


def _to_bernstein(powers: Exact, degree: int) -> Exact:
    return np.array([
        sum(Fraction(math.comb(i, k), math.comb(degree, k)) * powers[k]
            for k in range(min(i + 1, len(powers))))
        for i in range(degree + 1)
    ])  # fmt: skip


def bernstein(powers: Exact, m: int, n: int) -> Exact:
    """Fractions: the Bernstein coefficients, of degrees m and n, of a polynomial in powers."""
    m_true, n_true = degrees(powers) if (powers != 0).any() else (0, 0)
    kept = powers[: m_true + 1, : n_true + 1]
    return _to_bernstein(_to_bernstein(kept, m).T, n).T

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


def _whole(points: FloatArray) -> tuple[Exact, int]:
    """Floats (m + 1, n + 1, d) as whole numbers of 1 / unit, and unit."""
    fractions = [[[Fraction(float(x)) for x in point] for point in row] for row in points]
    unit = max(x.denominator for row in fractions for point in row for x in point)
    return np.array([[[int(x * unit) for x in p] for p in row] for row in fractions], object), unit


def _components(whole: Exact) -> list[Exact]:
    return [_powers(_powers(whole[..., i]).T).T for i in range(whole.shape[-1])]


def exact_patch(net: FloatArray) -> ExactPatch:
    """The polynomials of a control net (m + 1, n + 1, 3)."""
    whole, unit = _whole(net)
    r = _components(whole)
    ru, rv = [_du(x) for x in r], [_dv(x) for x in r]
    s = [total(product(ru[i], rv[j]), -product(ru[j], rv[i])) for i, j in ((1, 2), (2, 0), (0, 1))]
    second = [_du(x) for x in ru], [_dv(x) for x in ru], [_dv(x) for x in rv]
    l, m, n = (_dot(s, each) for each in second)
    return ExactPatch(unit, s, l, m, n, _dot(ru, ru), _dot(ru, rv), _dot(rv, rv))


def _determinant(columns: list[list[Exact]]) -> Exact:
    """A determinant of polynomials, by its first column."""
    if len(columns) == 1:
        return columns[0][0]
    parts = []
    for i, entry in enumerate(columns[0]):
        rest = [[x for j, x in enumerate(column) if j != i] for column in columns[1:]]
        parts.append((-1) ** i * product(entry, _determinant(rest)))
    return total(*parts)


def exact_rational(net: FloatArray, weight: FloatArray) -> tuple[Exact, Exact, Exact, int]:
    """A*, |S*|**4 and w**4 of a rational patch, each of 8, 8 and 4 factors of 1 / unit; unit.

    By determinants of order 4 and 3, from the origin. Both A* and |S*|**4 hold coordinates times
    weights: the caller's points and weights must be such that their products are floats.
    """
    weighted = np.concatenate([net * weight[..., None], weight[..., None]], axis=-1)
    whole, unit = _whole(weighted)
    h = _components(whole)
    hu, hv = [_du(x) for x in h], [_dv(x) for x in h]
    seconds = [_du(x) for x in hu], [_dv(x) for x in hu], [_dv(x) for x in hv]
    l, m, n = (_determinant([h, hu, hv, each]) for each in seconds)
    s = [
        _determinant([[each[i] for i in rows] for each in (h, hu, hv)])
        for rows in ((1, 2, 3), (0, 2, 3), (0, 1, 3))
    ]
    area, square = _dot(s, s), product(h[3], h[3])
    a = total(product(l, n), -product(m, m))
    return a, product(area, area), product(square, square), unit


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

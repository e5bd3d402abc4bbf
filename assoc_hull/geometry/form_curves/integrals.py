"""Integrals under form-parameter curves, exactly, and how they depend on the middle vertex.

Area and moment are sums of products of the vertices and of integrals of their basis functions N_i
on [0, 4]. Since N_3 vanishes at both ends of a curve, the area is affine in the middle vertex and
the moment has two quadratic terms only (`MiddleTerms`). `area_table` and `moment_table` have the
integrals of basis functions as fractions: tests compare with them.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "VERTICES",
    "FormIntegrals",
    "MiddleTerms",
    "area_table",
    "form_basis",
    "form_integrals",
    "middle_terms",
    "moment_table",
    "power_form",
]

# --------------------------------------------------------------------------------------
# Integrals of products of basis functions, as fractions: they give the numbers of `MiddleTerms`.
#
#     A  = sum y_i x_j a_ij          a_ij  = int N_i N_j' dt        denominators divide 720
#     My = sum y_i x_j x_k b_ijk     b_ijk = int N_i N_j N_k' dt    denominators divide 181440

VERTICES = 7
_SEGMENTS = 4
_PARTS = ((1, -3, 3, -1), (4, 0, -6, 3), (1, 3, 3, -3), (0, 0, 0, 1))
"""Six times the basis functions of a segment, in ascending powers of u."""

Power = tuple[Fraction, ...]
"""A polynomial in ascending powers."""


def form_basis(vertex: int, segment: int) -> Power:
    """Give the basis function of a vertex on a segment, in ascending powers of u = t - segment."""
    part = vertex - segment
    inside = 0 <= part < len(_PARTS)
    return tuple(Fraction(each, 6) for each in _PARTS[part]) if inside else (Fraction(0),)


def _times(one: Power, other: Power) -> Power:
    found = [Fraction(0)] * (len(one) + len(other) - 1)
    for i, left in enumerate(one):
        for j, right in enumerate(other):
            found[i + j] += left * right
    return tuple(found)


def _slope(power: Power) -> Power:
    return tuple(n * each for n, each in enumerate(power))[1:] or (Fraction(0),)


def _integral(power: Power) -> Fraction:
    """Integrate from 0 to 1."""
    return sum((each / (n + 1) for n, each in enumerate(power)), Fraction(0))


@lru_cache(maxsize=1)
def area_table() -> tuple[tuple[Fraction, ...], ...]:
    """Give a_ij = int N_i N_j' dt, 7 rows of 7."""
    return tuple(
        tuple(
            sum(
                (
                    _integral(_times(form_basis(i, s), _slope(form_basis(j, s))))
                    for s in range(_SEGMENTS)
                    if 0 <= i - s < 4 and 0 <= j - s < 4
                ),
                Fraction(0),
            )
            for j in range(VERTICES)
        )
        for i in range(VERTICES)
    )


@lru_cache(maxsize=1)
def moment_table() -> tuple[tuple[tuple[Fraction, ...], ...], ...]:
    """Give b_ijk = int N_i N_j N_k' dt, 7 tables of 7 rows of 7."""
    found = [[[Fraction(0)] * VERTICES for _ in range(VERTICES)] for _ in range(VERTICES)]
    for s in range(_SEGMENTS):
        for i in range(s, s + 4):
            for j in range(s, s + 4):
                both = _times(form_basis(i, s), form_basis(j, s))
                for k in range(s, s + 4):
                    found[i][j][k] += _integral(_times(both, _slope(form_basis(k, s))))
    return tuple(tuple(tuple(row) for row in table) for table in found)


# --------------------------------------------------------------------------------------
# Integrals of curves, segment by segment, with the middle vertex (x3, y3) set apart:
#
#     A  = A0 + D_x y3 - D_y x3
#     My = M0 + m1 x3 + m2 y3 + x3 (C_x y3 - C_y x3) / 2
#
# In this form they keep their digits where the middle vertex lies far away.


def power_form(vertices: FloatArray) -> FloatArray:
    """Give the segments in powers of u = t - s: (n, 7, 2) to (n, 4 segments, 4 powers, 2).

    In the matrix of the paper (Kim & Kang 1992) the number for the second power of the second
    vertex is -6: with +6, as a scan of it reads, the basis functions would not add up to 1.
    """
    a, b, c, d = (vertices[:, part : part + 4] for part in range(4))
    found = np.empty((len(vertices), 4, 4, 2))
    found[:, :, 0] = (a + 4.0 * b + c) / 6.0
    found[:, :, 1] = (c - a) / 2.0
    found[:, :, 2] = (a - 2.0 * b + c) / 2.0
    found[:, :, 3] = (d - a + 3.0 * (b - c)) / 6.0
    return found


_MIDDLE = power_form(np.repeat(np.eye(7)[3, :, None], 2, axis=1)[None])[..., 0]
"""N_3 in powers, (1, 4 segments, 4 powers)."""

_BLOCK = 256
"""So many curves at once: what lies between their powers and their sums stays near at hand."""


def _shares(powers: int) -> FloatArray:
    """Give what y^p and the slope of z^m contribute, m / (p + m) for m from 1: (4, powers)."""
    p, m = np.arange(4.0)[:, None], np.arange(1.0, powers + 1.0)
    return np.asarray(m / (p + m))


_AREA, _MOMENT = _shares(3), _shares(6)


def _under(y: FloatArray, z: FloatArray, shares: FloatArray) -> FloatArray:
    """Give int y z' dt along curves, (n,); both in powers, (n, 4, .)."""
    parts = y[:, :, :, None] * (z[:, :, None, 1:] * shares)
    sums = parts.reshape(len(parts), 4, shares.size).sum(axis=2)
    return np.asarray(((sums[:, 0] + sums[:, 1]) + sums[:, 2]) + sums[:, 3])


def _product(one: FloatArray, other: FloatArray) -> FloatArray:
    """Multiply cubics in powers: (n, 4, 7)."""
    found = np.zeros((len(one), 4, 7))
    for power in range(4):
        found[:, :, power : power + 4] += one[:, :, power, None] * other
    return found


@attrs.frozen(eq=False)
class MiddleTerms:
    """How area and moment of curves depend on their middle vertices.

    Attributes
    ----------
    area : (n,)
        A0, the area with the middle vertex in the origin.
    lever : (n, 2)
        D.
    moment : (n,)
        M0.
    slope : (n, 2)
        m1 and m2.
    twist : (n, 2)
        C.
    """

    area: FloatArray
    lever: FloatArray
    moment: FloatArray
    slope: FloatArray
    twist: FloatArray

    def area_at(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Give the areas with middle vertices, (n,) each."""
        return np.asarray(self.area + (self.lever[:, 0] * y - self.lever[:, 1] * x))

    def moment_at(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Give the moments with middle vertices, (n,) each."""
        square = 0.5 * x * (self.twist[:, 0] * y - self.twist[:, 1] * x)
        return np.asarray(self.moment + (self.slope[:, 0] * x + self.slope[:, 1] * y) + square)


def middle_terms(ends: FloatArray) -> MiddleTerms:
    """Give how area and moment depend on the middle vertices; ends (n, 6, 2) without P3."""
    if len(ends) <= _BLOCK:
        return _terms(ends)
    parts = [_terms(ends[row : row + _BLOCK]) for row in range(0, len(ends), _BLOCK)]
    names = [field.name for field in attrs.fields(MiddleTerms)]
    return MiddleTerms(*(np.concatenate([getattr(p, name) for p in parts]) for name in names))


def _terms(ends: FloatArray) -> MiddleTerms:
    vertices = np.zeros((len(ends), 7, 2))
    vertices[:, :3], vertices[:, 4:] = ends[:, :3], ends[:, 3:]
    power = power_form(vertices)
    x, y = power[..., 0], power[..., 1]
    four, five, six = ends[:, 3] - ends[:, 2], ends[:, 4] - ends[:, 1], ends[:, 5] - ends[:, 0]
    half_square, by_middle = 0.5 * _product(x, x), _product(x, _MIDDLE + 0.0 * x)
    return MiddleTerms(
        _under(y, x, _AREA),
        49.0 / 144.0 * four + 7.0 / 90.0 * five + six / 720.0,
        _under(y, half_square, _MOMENT),
        np.stack([_under(y, by_middle, _MOMENT), _under(_MIDDLE, half_square, _MOMENT)], axis=1),
        5947.0 / 30240.0 * four + 3.0 / 140.0 * five + six / 18144.0,
    )


@attrs.frozen(eq=False)
class FormIntegrals:
    """Integrals under curves.

    Attributes
    ----------
    area : (n,)
        int y dx.
    moment : (n,)
        int x y dx.
    moment_y : (n,)
        1/2 int y^2 dx.
    """

    area: FloatArray
    moment: FloatArray
    moment_y: FloatArray


def form_integrals(vertices: FloatArray) -> FormIntegrals:
    """Integrate under curves (n, 7, 2), exactly: each segment is a cubic."""
    ends, x, y = vertices[:, [0, 1, 2, 4, 5, 6]], vertices[:, 3, 0], vertices[:, 3, 1]
    terms, turned = middle_terms(ends), middle_terms(ends[:, :, ::-1])
    # By parts: half the integral of y^2 dx is half of y^2 x at the ends less that of x y dy.
    first, last = (vertices[:, k] + 4.0 * vertices[:, k + 1] + vertices[:, k + 2] for k in (0, 4))
    at_ends = (last[:, 1] * last[:, 1] * last[:, 0] - first[:, 1] * first[:, 1] * first[:, 0]) / 432
    return FormIntegrals(
        terms.area_at(x, y), terms.moment_at(x, y), at_ends - turned.moment_at(y, x)
    )

"""Form-parameter curves in whole numbers: what area and moment are, and whether there is a root.

Every float is a whole number of 2^-160; the integrals come from the tables of the basis functions,
so nothing here is rounded and nothing is shared with the code that solves for the middle vertex.
"""

from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from assoc_hull.geometry.form_curves.integrals import area_table, moment_table

_BITS = 160
_AREA, _MOMENT = 720, 181440


class Whole(NamedTuple):
    """The moment on the line of the middle vertices of an area: m0 + c1 s + c2 s^2."""

    m0: Fraction
    c1: Fraction
    c2: Fraction

    def discriminant(self, moment: Fraction) -> Fraction:
        """Below 0 where no vertex has the moment."""
        return self.c1 * self.c1 - 4 * self.c2 * (self.m0 - moment)


def whole(values: np.ndarray) -> list[int]:
    """Give floats as whole numbers of 2^-160."""
    found = [Fraction(float(each)) * 2**_BITS for each in values]
    assert all(each.denominator == 1 for each in found)
    return [int(each) for each in found]


@lru_cache(maxsize=1)
def _tables() -> tuple[list[tuple[int, int, int]], list[tuple[int, int, int, int]]]:
    """The entries of both tables that are not nil, as whole numbers."""
    area = [
        (i, j, int(each * _AREA))
        for i, row in enumerate(area_table())
        for j, each in enumerate(row)
    ]
    moment = [
        (i, j, k, int(each * _MOMENT))
        for i, table in enumerate(moment_table())
        for j, row in enumerate(table)
        for k, each in enumerate(row)
    ]
    return [each for each in area if each[-1]], [each for each in moment if each[-1]]


def _area(x: list[int], y: list[int]) -> Fraction:
    total = sum(each * y[i] * x[j] for i, j, each in _tables()[0])
    return Fraction(total, _AREA * 2 ** (2 * _BITS))


def _moment(x: list[int], y: list[int]) -> Fraction:
    total = sum(each * y[i] * x[j] * x[k] for i, j, k, each in _tables()[1])
    return Fraction(total, _MOMENT * 2 ** (3 * _BITS))


def integrals(vertices: np.ndarray) -> tuple[Fraction, Fraction]:
    """Give area and moment of a curve, (7, 2)."""
    x, y = whole(vertices[:, 0]), whole(vertices[:, 1])
    return _area(x, y), _moment(x, y)


def on_the_line(ends: np.ndarray, area: float) -> Whole:
    """Give the moment along the middle vertices of an area, by three of them; ends (6, 2)."""
    x, y = (whole(np.insert(ends[:, axis], 3, 0.0)) for axis in (0, 1))
    one = 2**_BITS
    at = _area(x, y)
    up = _area(x, [*y[:3], one, *y[4:]]) - at
    along = _area([*x[:3], one, *x[4:]], y) - at
    share = (Fraction(area) - at) / (up * up + along * along)
    moments = []
    for s in (-1, 0, 1):
        # Vertices are rational here: numerators over one denominator keep whole numbers.
        x3, y3 = along * share + s * up, up * share - s * along
        moments.append(_moment_with(x, y, x3, y3))
    low, middle, high = moments
    return Whole(middle, (high - low) / 2, (high + low) / 2 - middle)


def _moment_with(x: list[int], y: list[int], x3: Fraction, y3: Fraction) -> Fraction:
    common = x3.denominator * y3.denominator
    xs, ys = [each * common for each in x], [each * common for each in y]
    xs[3], ys[3] = int(x3 * common * 2**_BITS), int(y3 * common * 2**_BITS)
    return _moment(xs, ys) / common**3

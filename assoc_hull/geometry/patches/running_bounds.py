"""Polynomials with bounds of their errors that are carried through every operation.

With a true a' within e of the computed a, coefficient by coefficient, and b' within f of b, the
product is off by at most |a| f + e (|b| + f), and by its own roundings: (number of terms + 6) x
2**-53 x |a| |b|. Sizes are those of the computed coefficients, after all that cancelled in them,
so these bounds stay close where terms are large and their sum is small. They hold rounding and
uncertain control points at once.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.running_bounds import Running
>>> x = Running(np.array([[0.0], [1.0]]), np.full((2, 1), 1e-3))
>>> (1e3 * x.times(x).err).ravel().round(2)
array([0.  , 1.01, 2.02])
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.algebra import degrees, multiply

__all__ = ["EPS", "Running"]

EPS = 2.0**-53

_MARGIN = 1.01
"""For the roundings of the bounds themselves, which are as many, and of products of them."""


@attrs.frozen(eq=False)
class Running:
    """Coefficients, and what each may be off by.

    Attributes
    ----------
    b, err : (..., m + 1, n + 1)
        Both; vectors have their components as the third axis from the end.
    """

    b: FloatArray
    err: FloatArray

    def __getitem__(self, components: list[int] | slice) -> Self:
        """Take some components of vectors (k, d, m + 1, n + 1)."""
        return type(self)(self.b[:, components], self.err[:, components])

    def times(self, other: Running) -> Self:
        """Multiply."""
        (m, n), (p, q) = degrees(self.b), degrees(other.b)
        steps = _MARGIN * EPS * ((min(m, p) + 1) * (min(n, q) + 1) + 6)
        size, others = np.abs(self.b), np.abs(other.b)
        err = multiply(size, other.err + steps * others)
        err = err + multiply(self.err, others + other.err)
        return type(self)(multiply(self.b, other.b), _MARGIN * err)

    def plus(self, other: Running, sign: float = 1.0) -> Self:
        """Add what is of the same degrees; subtract it with the sign -1."""
        found = self.b + sign * other.b
        return type(self)(found, self.err + other.err + EPS * np.abs(found))

    def dot(self, other: Running) -> Self:
        """Multiply vectors and add their components, in one order."""
        found = self.times(other)
        total = type(self)(found.b[:, 0], found.err[:, 0])
        for i in range(1, found.b.shape[1]):
            total = total.plus(type(self)(found.b[:, i], found.err[:, i]))
        return total

    def derivative(self, axis: int) -> Self:
        """Differentiate with respect to u (axis -2) or v (-1); the degree is 1 at least."""
        degree = self.b.shape[axis] - 1
        low, high = (self.err.take(np.arange(degree) + i, axis) for i in (0, 1))
        found = degree * np.diff(self.b, axis=axis)
        return type(self)(found, degree * (low + high) + 2.0 * EPS * np.abs(found))

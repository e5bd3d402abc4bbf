"""Further functions of one coordinate: ramps and polynomials, with exact bounds.

Both are a `Course` as a chain is, so that a layer can be made of any of them.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import numbers
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.variation.fields.blend import QUINTIC, Blend

__all__ = ["Polynomial", "Ramp"]

_NEGLIGIBLE = 1e-60
"""A coefficient so much smaller than the others means nothing anywhere on a ship."""


@attrs.frozen
class Ramp:
    """Nil up to a place, then going over into a straight line.

    Attributes
    ----------
    begin : float, m
        Up to here it is exactly nil.
    width : float, m
        Over so much it becomes straight; negative for a ramp that runs the other way.
    slope : float
        Of the straight line, by the coordinate.
    blend : Blend

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.ramps_and_polynomials import Ramp
    >>> Ramp(10.0, 2.0, 0.5).at(np.array([9.0, 10.0, 14.0])).tolist()
    [0.0, 0.0, 1.5]
    """

    begin: float
    width: float
    slope_: float = attrs.field(default=1.0, alias="slope")
    blend: Blend = QUINTIC

    def __attrs_post_init__(self) -> None:
        if not np.isfinite([self.begin, self.width, self.slope_]).all() or self.width == 0.0:
            raise BadInputError(
                f"a ramp from {self.begin:g} m, {self.width:g} m wide, slope {self.slope_:g}",
                "in vary", "give finite numbers and a width other than nil",
            )  # fmt: skip

    @property
    def nodes(self) -> FloatArray:
        """Where it begins and where it is straight, rising."""
        return np.sort(np.array([self.begin, self.begin + self.width]))

    @property
    def degree(self) -> int:
        """That of the blend's integral."""
        return self.blend.degree + 1

    def scaled(self, factor: float) -> Ramp:
        """Give the ramp times a factor."""
        return Ramp(self.begin, self.width, self.slope_ * factor, self.blend)

    def at(self, x: FloatArray) -> FloatArray:
        """Give values."""
        t = (x - self.begin) / self.width
        value: FloatArray = (self.slope_ * self.width) * self.blend.ramp(t)
        return value

    def slope(self, x: FloatArray) -> FloatArray:
        """Give first derivatives."""
        slope: FloatArray = self.slope_ * self.blend.value((x - self.begin) / self.width)
        return slope

    def bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest value on intervals: it is monotone."""
        first, last = self.at(np.asarray(low)), self.at(np.asarray(high))
        return np.minimum(first, last), np.maximum(first, last)

    def slope_bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest slope on intervals: it is monotone as well."""
        first, last = self.slope(np.asarray(low)), self.slope(np.asarray(high))
        return np.minimum(first, last), np.maximum(first, last)


@attrs.frozen(eq=False)
class Polynomial:
    """A polynomial.

    Attributes
    ----------
    c : (k,)
        Coefficients of 1, x, x^2 ..; x in m.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.ramps_and_polynomials import Polynomial
    >>> low, high = Polynomial.of([0, 0, 1]).bounds(np.array(-1.0), np.array(2.0))
    >>> float(low), float(high)
    (0.0, 4.0)
    """

    c: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.c)

    @classmethod
    def of(cls, c: ArrayLike) -> Polynomial:
        """Take coefficients as a designer gives them.

        Raises
        ------
        BadInputError
            None, or not finite.
        """
        given = numbers(c, "coefficients", "in vary")
        if not len(given):
            raise BadInputError("a polynomial without coefficients", "in vary", "give one or more")
        return cls(given.copy())

    @property
    def nodes(self) -> FloatArray:
        """No places: it is of one piece."""
        return np.zeros(0)

    @cached_property
    def _derivative(self) -> Polynomial:
        return Polynomial(
            self.c[1:] * np.arange(1.0, len(self.c)) if len(self.c) > 1 else np.zeros(1)
        )

    @cached_property
    def _turns(self) -> FloatArray:
        """Where its slope is nil, and more places.

        A leading coefficient near nil spoils all roots, so that the roots without it are taken as
        well; values at further places do no harm to a bound.
        """
        slope = self._derivative.c
        least = _NEGLIGIBLE * np.abs(slope).max()
        ends = [k for k in range(1, len(slope)) if np.abs(slope[k]) > least]
        return np.concatenate([[0.0], *(np.real(np.roots(slope[k::-1])) for k in ends)])

    @property
    def degree(self) -> int:
        """Its own."""
        return len(self.c) - 1

    def scaled(self, factor: float) -> Polynomial:
        """Give the polynomial times a factor."""
        return Polynomial(self.c * factor)

    def at(self, x: FloatArray) -> FloatArray:
        """Give values."""
        value: FloatArray = np.zeros(np.shape(x)) + self.c[-1]
        for each in self.c[-2::-1].tolist():
            value = value * x + each
        return np.asarray(value)

    def slope(self, x: FloatArray) -> FloatArray:
        """Give first derivatives."""
        return self._derivative.at(x)

    def bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest value on intervals: at their ends or where the slope is nil."""
        low, high = np.asarray(low, np.float64), np.asarray(high, np.float64)
        first, last = self.at(low), self.at(high)
        least, most = np.minimum(first, last), np.maximum(first, last)
        for place in self._turns.tolist():
            # beyond an end of the interval this is the value at that end, which counts already
            value = self.at(np.clip(place, low, high))
            least, most = np.minimum(least, value), np.maximum(most, value)
        return least, most

    def slope_bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest slope on intervals."""
        return self._derivative.bounds(low, high)

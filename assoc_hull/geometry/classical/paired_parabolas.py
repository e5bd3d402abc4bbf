"""The curve that Simpson's first rule integrates: a parabola on each pair of equal steps.

On the nodes 2j, 2j + 1, 2j + 2 and with t from 0 to 2 the curve is
f0 (t - 1)(t - 2) / 2 - f1 t (t - 2) + f2 t (t - 1) / 2. It passes all nodes and bends at those of
even number, where two parabolas meet. Its exact integral is Simpson's value; over a first step
alone it is s (5 f0 + 8 f1 - f2) / 12. A last step without a partner has the parabola of the last
three nodes. Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for
Design and Production", J. SNAK.

Examples
--------
>>> from assoc_hull.geometry.classical.paired_parabolas import PairedParabolas
>>> curve = PairedParabolas.make("areas", 0.0, 8.0, [120, 160, 185, 190, 178])
>>> round(curve.integral(), 6), round(curve.moment() / curve.integral(), 8)
(5514.666667, 16.91295938)
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["PairedParabolas"]

_PLACES, _WEIGHTS = (0.5 * part for part in np.polynomial.legendre.leggauss(3))
"""Three places over a step are exact to the fifth degree: squares of parabolas, times x."""

_SLACK = 1e-9
"""So far beyond an end, in steps, is the end by rounding."""


@attrs.frozen(eq=False)
class PairedParabolas:
    """A curve over equally spaced places, by parabolas on pairs of steps.

    Attributes
    ----------
    name : str
        For messages.
    first, step : float, m
        The first place and the spacing.
    values : (n,)
        At the places, n >= 3.
    """

    name: str
    first: float
    step: float
    values: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.values)

    @classmethod
    def make(cls, name: str, first: float, step: float, values: ArrayLike) -> Self:
        """Check what is handed in; arguments as the attributes.

        Raises
        ------
        GeometryError
            Numbers that are not finite, a spacing that is not above 0, fewer than three values.
        """
        found = finite(values, name, (None,))
        start, spacing = (float(finite(each, name, ())) for each in (first, step))
        if spacing <= 0.0:
            what = f"{name}: spacing {figure(spacing)} is not above 0"
            raise GeometryError(what, "give a spacing above 0", {"step": spacing})
        if len(found) < 3:
            what = f"{name}: at least 3 values, got {len(found)}"
            raise GeometryError(what, "a parabola needs three", {"count": len(found)})
        return cls(name, start, spacing, found)

    @property
    def places(self) -> FloatArray:
        """Where the values stand, (n,), m."""
        found: FloatArray = self.first + self.step * np.arange(len(self.values), dtype=np.float64)
        return found

    @property
    def last(self) -> float:
        """The last place, m."""
        return float(self.places[-1])

    def coefficients(self) -> FloatArray:
        """Give c0, c1, c2 of each step: f = c0 + c1 u + c2 u^2, u from 0 to 1; (n - 1, 3)."""
        step = np.arange(len(self.values) - 1)
        begin = np.minimum(step - step % 2, len(self.values) - 3)
        f0, f1, f2 = (self.values[begin + k] for k in range(3))
        bend = 0.5 * (f0 - 2.0 * f1 + f2)
        slope = f1 - f0 + bend * (2.0 * (step - begin) - 1.0)
        return np.stack([self.values[:-1], slope, bend], axis=1)

    def at(self, x: ArrayLike) -> FloatArray:
        """Give values at places, of the shape of `x`.

        Raises
        ------
        GeometryError
            A place outside; nothing is extrapolated.
        """
        place = inside(x, self.name, self.first, self.last, _SLACK * self.step)
        u = (place - self.first) / self.step
        step = np.clip(np.floor(u).astype(np.int64), 0, len(self.values) - 2)
        c0, c1, c2 = np.moveaxis(self.coefficients()[step], -1, 0)
        u = u - step
        return np.asarray(c0 + u * (c1 + u * c2))

    def slopes(self) -> FloatArray:
        """Give the slope before and after each place, (n, 2); they differ at corners.

        Before the first and after the last place they are those of the one side there is.
        """
        _, c1, c2 = self.coefficients().T
        after, before = c1 / self.step, (c1 + 2.0 * c2) / self.step
        return np.stack(
            [np.concatenate([after[:1], before]), np.concatenate([after, before[-1:]])], axis=1
        )

    def quadrature(
        self, first: float | None = None, last: float | None = None
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Give places, values there and weights that integrate polynomials of degree 5 exactly.

        Parameters
        ----------
        first, last : float or None, m
            Limits within the curve; its ends if None.

        Raises
        ------
        GeometryError
            A limit outside.
        """
        least = self.first if first is None else first
        most = self.last if last is None else last
        limits = inside([least, most], self.name, self.first, self.last, _SLACK * self.step)
        nodes = np.clip(self.places, *limits)
        size = np.diff(nodes)
        used = np.flatnonzero(size > 0.0)
        x = 0.5 * (nodes[used] + nodes[used + 1])[:, None] + size[used, None] * _PLACES
        u = (x - self.places[used, None]) / self.step
        c0, c1, c2 = self.coefficients()[used].T[:, :, None]
        weight = size[used, None] * _WEIGHTS
        return x.ravel(), (c0 + u * (c1 + u * c2)).ravel(), weight.ravel()

    def integral(self, first: float | None = None, last: float | None = None) -> float:
        """Integrate the curve between two places, its ends if None; exact."""
        _, value, weight = self.quadrature(first, last)
        return float(weight @ value)

    def moment(self, first: float | None = None, last: float | None = None) -> float:
        """Integrate place times value between two places, its ends if None; exact."""
        x, value, weight = self.quadrature(first, last)
        return float(weight @ (x * value))

    def simpson(self) -> float:
        """Integrate by Simpson's first rule, which is the same number for an odd count.

        Raises
        ------
        GeometryError
            An even number of values.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.paired_parabolas import PairedParabolas
        >>> PairedParabolas.make("areas", 0.0, 1.0, [1, 4, 9]).simpson()
        8.666666666666666
        """
        if len(self.values) % 2 == 0:
            what = f"{self.name}: Simpson's first rule needs an odd number, got {len(self.values)}"
            raise GeometryError(what, "leave one out", {"count": len(self.values)})
        weights = np.full(len(self.values), 2.0)
        weights[1::2], weights[[0, -1]] = 4.0, 1.0
        return float(self.step / 3.0 * (weights @ self.values))

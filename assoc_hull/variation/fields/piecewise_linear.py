"""Functions of one coordinate that lay out a field: chains, contours, bumps.

A chain goes from node to node by a blend and is constant outside. At a node and outside, the
node's own value is given without arithmetic: that is what keeps a hull outside a variation's
region the same to the last bit.
"""

from __future__ import annotations

from functools import cached_property
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from assoc_hull.arguments import numbers
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.variation.fields.blend import QUINTIC, Blend

__all__ = ["Chain", "Contour", "Course"]


class Course(Protocol):
    """A function of one coordinate with exact bounds.

    Between its nodes it is a polynomial; `scaled` gives it times a factor.
    """

    @property
    def degree(self) -> int:
        """Highest degree of the polynomials between nodes."""
        ...

    @property
    def nodes(self) -> FloatArray:
        """Where pieces join, rising."""
        ...

    def at(self, x: FloatArray) -> FloatArray:
        """Give values."""
        ...

    def slope(self, x: FloatArray) -> FloatArray:
        """Give first derivatives."""
        ...

    def bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest value on intervals."""
        ...

    def slope_bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest slope on intervals."""
        ...

    def scaled(self, factor: float) -> Course:
        """Give the function times a factor."""
        ...


def rising(values: ArrayLike, name: str) -> FloatArray:
    """Take nodes, which must rise strictly.

    Raises
    ------
    BadInputError
        They do not; or not finite.
    """
    x = numbers(values, name, "in vary")
    step = np.diff(x)
    if not len(x) or (step <= 0.0).any():
        at = int(np.argmax(step <= 0.0)) + 1 if len(x) else 0
        found = f"x[{at}]={x[at]:g} after {x[at - 1]:g}" if len(x) else "there are none"
        raise BadInputError(
            f"nodes of '{name}' must rise: {found}", "in vary", "give them in order, each once"
        )
    return x


@attrs.frozen(eq=False)
class Chain:
    """Values at nodes, joined by a blend, constant outside.

    Attributes
    ----------
    x : (k,), m
        Nodes, rising.
    v : (k,)
        Values there.
    blend : Blend

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.blend import CUBIC
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> chain = Chain.through([0, 10, 40], [1, 1.3, 0.9], CUBIC)
    >>> chain.at(np.array([-5.0, 3.0, 25.0])).round(10).tolist()
    [1.0, 1.0648, 1.1]
    """

    x: FloatArray
    v: FloatArray
    blend: Blend = QUINTIC

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.v)

    @classmethod
    def through(
        cls, x: ArrayLike, v: ArrayLike, blend: Blend = QUINTIC, name: str = "chain"
    ) -> Chain:
        """Take nodes and values as a designer gives them.

        Raises
        ------
        BadInputError
            Nodes that do not rise, or as many values as there are not nodes; not finite.
        """
        nodes, values = rising(x, name), numbers(v, name, "in vary")
        if len(nodes) != len(values):
            raise BadInputError(
                f"'{name}' has {len(nodes)} nodes and {len(values)} values", "in vary",
                "give one value a node",
            )  # fmt: skip
        return cls(nodes.copy(), values.copy(), blend)

    @classmethod
    def constant(cls, value: float) -> Chain:
        """Give the same value everywhere."""
        return cls(np.zeros(1), np.array([float(value)]))

    @property
    def nodes(self) -> FloatArray:
        """Where pieces join, rising."""
        return self.x

    @cached_property
    def level(self) -> bool:
        """Whether it is the same everywhere; most are, and those are evaluated at once."""
        return bool((self.v == self.v[0]).all())

    @property
    def degree(self) -> int:
        """That of the blend; 0 if it is level."""
        return 0 if self.level else self.blend.degree

    def scaled(self, factor: float) -> Chain:
        """Give the chain times a factor."""
        return Chain(self.x.copy(), self.v * factor, self.blend)

    def _piece(self, x: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Give place within, width, first value and rise of the pieces that x lie in."""
        inner, widths, rises = self._pieces
        i = np.searchsorted(inner, x, side="right")
        width = widths[i]
        return (x - self.x[i]) / width, width, self.v[i], rises[i]

    @cached_property
    def _pieces(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Inner nodes; width and rise of each piece."""
        return self.x[1:-1], np.diff(self.x), np.diff(self.v)

    def at(self, x: FloatArray) -> FloatArray:
        """Give values; a node's own value at the node and outside, to the last bit."""
        if self.level:
            return np.full(np.shape(x), self.v[0])
        s, _, first, rise = self._piece(x)
        inner = first + rise * self.blend.value(s)
        return np.asarray(np.where(x >= self.x[-1], self.v[-1], inner))

    def slope(self, x: FloatArray) -> FloatArray:
        """Give first derivatives."""
        if self.level:
            return np.zeros(np.shape(x))
        s, width, _, rise = self._piece(x)
        return np.asarray(rise * self.blend.slope(s) / width)

    def second(self, x: FloatArray) -> FloatArray:
        """Give second derivatives."""
        if self.level:
            return np.zeros(np.shape(x))
        s, width, _, rise = self._piece(x)
        return np.asarray(rise * self.blend.second(s) / (width * width))

    def bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest value on intervals: of both ends and the nodes between."""
        low, high = np.asarray(low, np.float64), np.asarray(high, np.float64)
        first, last = self.at(low), self.at(high)
        least, most = np.minimum(first, last), np.maximum(first, last)
        for node, value in zip(self.x.tolist(), self.v.tolist(), strict=True):
            inside = (low <= node) & (node <= high)
            least = np.where(inside, np.minimum(least, value), least)
            most = np.where(inside, np.maximum(most, value), most)
        return least, most

    def slope_bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest slope on intervals: ends, middles of pieces, level nodes."""
        low, high = np.asarray(low, np.float64), np.asarray(high, np.float64)
        first, last = self.slope(low), self.slope(high)
        least, most = np.minimum(first, last), np.maximum(first, last)
        width, rise = np.diff(self.x), np.diff(self.v)
        steep = self.blend.steepest * rise / width
        places = np.concatenate([self.x, 0.5 * (self.x[1:] + self.x[:-1])])
        slopes = np.concatenate([np.zeros(len(self.x)), steep])
        for place, slope in zip(places.tolist(), slopes.tolist(), strict=True):
            inside = (low <= place) & (place <= high)
            least = np.where(inside, np.minimum(least, slope), least)
            most = np.where(inside, np.maximum(most, slope), most)
        return least, most


@attrs.frozen(eq=False)
class Contour:
    """A boundary that follows a contour: a cubic spline through nodes, level outside.

    Between more than two nodes a chain would make a staircase; a spline does not. Its slope
    is nil at both ends, so that it goes over smoothly into the constants outside.

    Attributes
    ----------
    x, v : (k,), m
        Nodes, rising, and values there.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.piecewise_linear import Contour
    >>> counter = Contour(np.array([0.0, 10.0, 30.0]), np.array([9.0, 6.0, 0.0]))
    >>> counter.at(np.array([-1.0, 10.0, 31.0])).tolist()
    [9.0, 6.0, 0.0]
    """

    x: FloatArray
    v: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.v)

    @cached_property
    def _spline(self) -> CubicSpline:
        return CubicSpline(self.x, self.v, bc_type="clamped")

    @property
    def nodes(self) -> FloatArray:
        """Where pieces join, rising."""
        return self.x

    @property
    def degree(self) -> int:
        """That of a cubic spline."""
        return 3

    def scaled(self, factor: float) -> Contour:
        """Give the contour times a factor."""
        return Contour(self.x.copy(), self.v * factor)

    def at(self, x: FloatArray) -> FloatArray:
        """Give values."""
        inner = self._spline(np.clip(x, self.x[0], self.x[-1]))
        outer = np.where(x <= self.x[0], self.v[0], self.v[-1])
        return np.where((x > self.x[0]) & (x < self.x[-1]), inner, outer)

    def slope(self, x: FloatArray) -> FloatArray:
        """Give first derivatives."""
        inner = self._spline(np.clip(x, self.x[0], self.x[-1]), 1)
        return np.where((x > self.x[0]) & (x < self.x[-1]), inner, 0.0)

    def bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest value on intervals."""
        return self._within(low, high, 0)

    def slope_bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest slope on intervals."""
        return self._within(low, high, 1)

    def _within(
        self, low: FloatArray, high: FloatArray, order: int
    ) -> tuple[FloatArray, FloatArray]:
        low, high = np.asarray(low, np.float64), np.asarray(high, np.float64)
        give = self.slope if order else self.at
        first, last = give(low), give(high)
        least, most = np.minimum(first, last), np.maximum(first, last)
        turns = np.concatenate([self._turns(order), self.x])
        for place in turns.tolist():
            value = float(give(np.array(place)))
            inside = (low <= place) & (place <= high)
            least = np.where(inside, np.minimum(least, value), least)
            most = np.where(inside, np.maximum(most, value), most)
        return least, most

    def _turns(self, order: int) -> FloatArray:
        found = self._spline.derivative(order + 1).roots(extrapolate=False)
        places: FloatArray = found[np.isfinite(found)]
        return places

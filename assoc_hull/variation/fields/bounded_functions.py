"""Functions of one coordinate with exact bounds: blends, chains, contours, ramps, polynomials.

Fields are laid out by such functions along the ship and up the hull. Each of them gives its value,
its slope, and exact bounds of both on any interval, which the fold check works on; where a bound
is sought at inner places too, these are the roots of the derivative. At a node and outside all
nodes a chain gives the node's value without arithmetic, to the last bit: that keeps a hull the
same outside the region of a variation.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Literal, Protocol

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import numbers
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

__all__ = [
    "BLENDS",
    "CUBIC",
    "QUINTIC",
    "Blend",
    "BlendChain",
    "BoundedFunction",
    "Contour",
    "Polynomial",
    "Ramp",
]

# --------------------------------------------------------------------------------------
# A blend b rises from 0 at s = 0 to 1 at s = 1 with level ends. The cubic one has continuous
# slope, the quintic one continuous curvature as well. A ramp is the integral of a blend: it leaves
# 0 as smoothly and ends in a straight line of slope 1.


@attrs.frozen
class Blend:
    """A blend and its derivatives, elementwise on arrays of any shape.

    Attributes
    ----------
    name : {"cubic", "quintic"}
    steepest : float
        Largest slope, at s = 1/2: 3/2 or 15/8.

    Examples
    --------
    >>> from assoc_hull.variation.fields.bounded_functions import CUBIC, QUINTIC
    >>> import numpy as np
    >>> [round(float(each.value(np.array(0.3))), 10) for each in (CUBIC, QUINTIC)]
    [0.216, 0.16308]
    """

    name: Literal["cubic", "quintic"]
    steepest: float

    @property
    def degree(self) -> int:
        """Degree of b between 0 and 1."""
        return 3 if self.name == "cubic" else 5

    def value(self, s: FloatArray) -> FloatArray:
        """Give b(s); exactly 0 below s = 0 and exactly 1 above s = 1."""
        s = _within(s)
        if self.name == "cubic":
            return np.asarray(s * s * (3.0 - 2.0 * s))
        return np.asarray(s * s * s * (10.0 + s * (6.0 * s - 15.0)))

    def slope(self, s: FloatArray) -> FloatArray:
        """Give b'(s), zero outside 0 <= s <= 1."""
        s = _within(s)
        part = s * (1.0 - s)
        return np.asarray(6.0 * part if self.name == "cubic" else 30.0 * part * part)

    def second(self, s: FloatArray) -> FloatArray:
        """Give b''(s), zero outside 0 <= s <= 1.

        The cubic's jumps at both ends; there its inner value is given.
        """
        inside = (s >= 0.0) & (s <= 1.0)
        s = _within(s)
        bend = 6.0 - 12.0 * s
        if self.name == "quintic":
            bend = 10.0 * s * (1.0 - s) * bend
        return np.where(inside, bend, 0.0)

    def ramp(self, t: FloatArray) -> FloatArray:
        """Give the integral of b from 0 to t: zero below 0, t - 1/2 above 1."""
        s = _within(t)
        if self.name == "cubic":
            rise = s * s * s * (1.0 - 0.5 * s)
        else:
            rise = s * s * s * s * (2.5 + s * (s - 3.0))
        return np.asarray(np.where(t > 1.0, t - 0.5, rise))

    def value_range(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest b on intervals: b is monotone."""
        return self.value(low), self.value(high)

    def slope_range(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest b' on intervals: b' rises to s = 1/2 and falls from there."""
        first, last = self.slope(low), self.slope(high)
        peak = (np.asarray(low) <= 0.5) & (np.asarray(high) >= 0.5)
        most = np.where(peak, self.steepest, np.maximum(first, last))
        return np.minimum(first, last), most


def _within(s: FloatArray) -> FloatArray:
    """Bring numbers into 0 to 1; `np.clip` is slow where arrays are short, as most are here."""
    return np.asarray(np.minimum(np.maximum(s, 0.0), 1.0))


CUBIC = Blend("cubic", 1.5)
QUINTIC = Blend("quintic", 1.875)
BLENDS = {"cubic": CUBIC, "quintic": QUINTIC}


# --------------------------------------------------------------------------------------
# Functions that fields are laid out by.


class BoundedFunction(Protocol):
    """A function of one coordinate with exact bounds: a polynomial between its nodes.

    Values, slopes and bounds are elementwise on arrays of any shape; x in m.
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

    def scaled(self, factor: float) -> BoundedFunction:
        """Give the function times a factor."""
        ...


def rising_nodes(values: ArrayLike, name: str) -> FloatArray:
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
class BlendChain:
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
    >>> from assoc_hull.variation.fields.bounded_functions import CUBIC
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> chain = BlendChain.through([0, 10, 40], [1, 1.3, 0.9], CUBIC)
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
    ) -> BlendChain:
        """Take nodes and values as a designer gives them.

        Raises
        ------
        BadInputError
            Nodes that do not rise, or as many values as there are not nodes; not finite.
        """
        nodes, values = rising_nodes(x, name), numbers(v, name, "in vary")
        if len(nodes) != len(values):
            raise BadInputError(
                f"'{name}' has {len(nodes)} nodes and {len(values)} values", "in vary",
                "give one value a node",
            )  # fmt: skip
        return cls(nodes.copy(), values.copy(), blend)

    @classmethod
    def constant(cls, value: float) -> BlendChain:
        """Give the same value everywhere."""
        return cls(np.zeros(1), np.array([float(value)]))

    @property
    def nodes(self) -> FloatArray:
        """Where pieces join, rising."""
        return self.x

    @cached_property
    def level(self) -> bool:
        """Whether the value is the same everywhere: most chains are, and need no pieces."""
        return bool((self.v == self.v[0]).all())

    @property
    def degree(self) -> int:
        """Degree of the blend; 0 if the chain is level."""
        return 0 if self.level else self.blend.degree

    def scaled(self, factor: float) -> BlendChain:
        """Give the chain times a factor."""
        return BlendChain(self.x.copy(), self.v * factor, self.blend)

    def _piece(self, x: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Give the part s (0 to 1) of the piece at each x, and its width, first value and rise."""
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
        """Give least and greatest value on intervals: pieces are monotone, so ends and nodes do."""
        low, high = np.asarray(low, np.float64), np.asarray(high, np.float64)
        first, last = self.at(low), self.at(high)
        least, most = np.minimum(first, last), np.maximum(first, last)
        for node, value in zip(self.x.tolist(), self.v.tolist(), strict=True):
            inside = (low <= node) & (node <= high)
            least = np.where(inside, np.minimum(least, value), least)
            most = np.where(inside, np.maximum(most, value), most)
        return least, most

    def slope_bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest slope on intervals: of ends, nodes (0) and middles of pieces."""
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

    Between more than two nodes a chain would make a staircase; a spline does not. Its slope is
    zero at both ends, so that it goes over smoothly into the constants outside.

    Attributes
    ----------
    x, v : (k,), m
        Nodes, rising, and values there.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import Contour
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
        # Few variations have a contour: the others do not wait for scipy's interpolation.
        from scipy.interpolate import CubicSpline

        return CubicSpline(self.x, self.v, bc_type="clamped")

    @property
    def nodes(self) -> FloatArray:
        """Where pieces join, rising."""
        return self.x

    @property
    def degree(self) -> int:
        """Degree of a cubic spline."""
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
        """Give bounds of the value (order 0) or the slope (order 1) on intervals."""
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
        """Give where value (order 0) or slope (order 1) has an extreme between nodes, m."""
        found = self._spline.derivative(order + 1).roots(extrapolate=False)
        places: FloatArray = found[np.isfinite(found)]
        return places


_NEGLIGIBLE = 1e-60
"""A coefficient smaller than the largest by this factor changes nothing anywhere on a ship."""


@attrs.frozen
class Ramp:
    """Zero up to a place, then going over into a straight line.

    Attributes
    ----------
    begin : float, m
        Up to here it is exactly zero.
    width : float, m
        Over so much it becomes straight; negative for a ramp that runs the other way.
    slope : float
        Of the straight line, by the coordinate.
    blend : Blend

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import Ramp
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
                "in vary", "give finite numbers and a width other than 0",
            )  # fmt: skip

    @property
    def nodes(self) -> FloatArray:
        """Where it begins and where it is straight, rising."""
        return np.sort(np.array([self.begin, self.begin + self.width]))

    @property
    def degree(self) -> int:
        """Degree of the integral of the blend."""
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
    """A polynomial of x in m.

    Attributes
    ----------
    c : (k,)
        Coefficients of 1, x, x^2 ...

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import Polynomial
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
        """None: it is of one piece."""
        return np.zeros(0)

    @cached_property
    def _derivative(self) -> Polynomial:
        return Polynomial(
            self.c[1:] * np.arange(1.0, len(self.c)) if len(self.c) > 1 else np.zeros(1)
        )

    @cached_property
    def _turns(self) -> FloatArray:
        """Where its slope is zero, and more places.

        A leading coefficient near zero spoils all roots, so the roots without it are taken as
        well; values at further places do no harm to a bound.
        """
        slope = self._derivative.c
        least = _NEGLIGIBLE * np.abs(slope).max()
        ends = [k for k in range(1, len(slope)) if np.abs(slope[k]) > least]
        return np.concatenate([[0.0], *(np.real(np.roots(slope[k::-1])) for k in ends)])

    @property
    def degree(self) -> int:
        """Its degree."""
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
        """Give least and greatest value on intervals: at their ends or where the slope is zero."""
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

"""Shapes of shifts along the ship: bumps, and straight lines from node to node.

Both are a `BoundedFunction` of x (m from AP). A bump rises from zero and comes back to zero between
two terminals; straight lines are the classical shift by 1 - CP. Shifts of sections, raw fields and
the named parameters `fore_shift` and `aft_shift` are made of them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "BUMP_SHAPES",
    "Bump",
    "BumpShape",
    "Polyline",
]

_Give = Callable[[FloatArray], FloatArray]

BumpShape = Literal["c1", "c2", "end", "half", "lackenby"]

BUMP_SHAPES: dict[str, tuple[float, int, int]] = {
    "c1": (16.0, 2, 2),
    "c2": (64.0, 3, 3),
    "end": (6.75, 1, 2),
    "half": (6.75, 2, 1),
    "lackenby": (1.0, 1, 1),
}
"""Factor, and powers of xi and of 1 - xi; all but Lackenby's reach 1."""


@attrs.frozen(eq=False)
class Bump:
    """A shape f xi^m (1 - xi)^n between two terminals, exactly zero outside.

    Attributes
    ----------
    begin, end : float, m
        Where xi = 0 and xi = 1; `begin` may be the larger one.
    size : float
        Factor of the shape.
    shape : {"c1", "c2", "end", "half", "lackenby"}
        ``c2`` has slope and curvature zero at both terminals.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.shift_shapes import Bump
    >>> Bump(100.0, 200.0, 2.0, "c2").at(np.array([100.0, 150.0, 250.0])).tolist()
    [0.0, 2.0, 0.0]
    """

    begin: float
    end: float
    size: float = 1.0
    shape: BumpShape = "c2"

    def __attrs_post_init__(self) -> None:
        if self.shape not in BUMP_SHAPES or self.begin == self.end:
            raise BadInputError(
                f"shape {self.shape!r} from {self.begin:g} to {self.end:g} m", "in vary",
                f"give one of {', '.join(BUMP_SHAPES)} between two places",
            )  # fmt: skip

    @property
    def nodes(self) -> FloatArray:
        """Both terminals, rising."""
        return np.sort(np.array([self.begin, self.end]))

    @property
    def degree(self) -> int:
        """Degree m + n of the shape."""
        _, m, n = BUMP_SHAPES[self.shape]
        return m + n

    @property
    def top(self) -> float:
        """Where it is fullest, m."""
        _, m, n = BUMP_SHAPES[self.shape]
        return self.begin + (self.end - self.begin) * m / (m + n)

    def scaled(self, factor: float) -> Bump:
        """Give the bump times a factor."""
        return attrs.evolve(self, size=self.size * factor)

    def _xi(self, x: FloatArray) -> FloatArray:
        """Give the place between the terminals, 0 to 1."""
        xi: FloatArray = np.clip((x - self.begin) / (self.end - self.begin), 0.0, 1.0)
        return xi

    def _at(self, xi: FloatArray) -> FloatArray:
        factor, m, n = BUMP_SHAPES[self.shape]
        value: FloatArray = self.size * (factor * _power(xi, m) * _power(1.0 - xi, n))
        return value

    def _slope(self, xi: FloatArray) -> FloatArray:
        factor, m, n = BUMP_SHAPES[self.shape]
        rise = _power(xi, m - 1) * _power(1.0 - xi, n - 1) * (m * (1.0 - xi) - n * xi)
        slope: FloatArray = self.size * factor / (self.end - self.begin) * rise
        return slope

    def at(self, x: FloatArray) -> FloatArray:
        """Give values."""
        return self._at(self._xi(x))

    def slope(self, x: FloatArray) -> FloatArray:
        """Give first derivatives, zero outside the terminals and at them."""
        xi = self._xi(x)
        return np.where((xi > 0.0) & (xi < 1.0), self._slope(xi), 0.0)

    def bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest value on intervals: the top lies at m / (m + n)."""
        _, m, n = BUMP_SHAPES[self.shape]
        return self._within(low, high, self.at, np.array([m / (m + n)]), self._at)

    def slope_bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest slope on intervals, those at the terminals from inside."""
        _, m, n = BUMP_SHAPES[self.shape]
        total = m + n
        # xi^(m-2) (1-xi)^(n-2) times this quadratic is the second derivative
        roots = np.roots([total * (total - 1), -2 * m * (total - 1), m * (m - 1)])
        turns = np.concatenate([np.real(roots[np.abs(np.imag(roots)) == 0.0]), [0.0, 1.0]])
        turns = turns[(turns >= 0.0) & (turns <= 1.0)]
        return self._within(low, high, self.slope, turns, self._slope)

    def _within(
        self, low: FloatArray, high: FloatArray, give: _Give, turns: FloatArray, value: _Give
    ) -> tuple[FloatArray, FloatArray]:
        """Give bounds over the ends of intervals and the values at turns (places of xi) within."""
        low, high = np.asarray(low, np.float64), np.asarray(high, np.float64)
        first, last = give(low), give(high)
        least, most = np.minimum(first, last), np.maximum(first, last)
        # a place as near to a terminal as this may round to it, where the slope jumps
        near = 4.0 * float(np.finfo(np.float64).eps) * (abs(self.begin) + abs(self.end))
        for xi in turns.tolist():
            place = self.begin + xi * (self.end - self.begin)
            found = float(value(np.array(xi)))
            inside = (low <= place + near) & (place - near <= high)
            least = np.where(inside, np.minimum(least, found), least)
            most = np.where(inside, np.maximum(most, found), most)
        return least, most


def _power(x: FloatArray, m: int) -> FloatArray:
    """Give a power from 0 to 3 by products: those of a library differ between processors."""
    found = np.ones_like(x)
    for _ in range(m):
        found = found * x
    return found


@attrs.frozen(eq=False)
class Polyline:
    """Straight lines from node to node, level outside; the slope jumps at the nodes.

    Attributes
    ----------
    x : (k,), m
        Nodes, rising.
    v : (k,)
        Values there.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.shift_shapes import Polyline
    >>> Polyline(np.array([0.0, 10.0]), np.array([1.0, 0.0])).at(np.array([-1.0, 4.0])).tolist()
    [1.0, 0.6]
    """

    x: FloatArray
    v: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.v)

    @property
    def nodes(self) -> FloatArray:
        """Where lines join, rising."""
        return self.x

    @property
    def degree(self) -> int:
        """1, that of straight lines."""
        return 1

    def scaled(self, factor: float) -> Polyline:
        """Give the function times a factor."""
        return Polyline(self.x.copy(), self.v * factor)

    def _piece(self, x: FloatArray) -> np.typing.NDArray[np.int64]:
        """Give the line that each x lies on; at a node that forward of it."""
        return np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.x) - 2)

    def at(self, x: FloatArray) -> FloatArray:
        """Give values; those of the ends outside, to the last bit."""
        i = self._piece(x)
        within = np.clip(x, self.x[0], self.x[-1])
        inner = self.v[i] + (within - self.x[i]) * self._slopes[i]
        below = np.where(x <= self.x[0], self.v[0], inner)
        return np.where(x >= self.x[-1], self.v[-1], below)

    @property
    def _slopes(self) -> FloatArray:
        return np.asarray(np.diff(self.v) / np.diff(self.x))

    def slope(self, x: FloatArray) -> FloatArray:
        """Give first derivatives, at a node that of the line forward of it; zero outside."""
        inside = (x >= self.x[0]) & (x < self.x[-1])
        return np.where(inside, self._slopes[self._piece(x)], 0.0)

    def bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest value on intervals: of both ends and the nodes between."""
        return self._within(low, high, self.at(low), self.at(high), self.x, self.x, self.v)

    def slope_bounds(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest slope on intervals: of all lines that they touch."""
        ends = self.slope(np.asarray(low)), self.slope(np.asarray(high))
        return self._within(low, high, *ends, self.x[:-1], self.x[1:], self._slopes)

    def _within(
        self, low: FloatArray, high: FloatArray, first: FloatArray, last: FloatArray,
        begin: FloatArray, end: FloatArray, values: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        """Give bounds over the ends (first, last) and the stretches (begin, end) with values."""
        low, high = np.asarray(low, np.float64), np.asarray(high, np.float64)
        least, most = np.minimum(first, last), np.maximum(first, last)
        for i, value in enumerate(values.tolist()):
            met = (low <= end[i]) & (begin[i] <= high)
            least = np.where(met, np.minimum(least, value), least)
            most = np.where(met, np.maximum(most, value), most)
        return least, most

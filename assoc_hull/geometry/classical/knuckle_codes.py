"""A deck side or knuckle line through points, each interval with its own way to interpolate.

With h the length of interval i, c the straight line over it, and d- and d+ the divided
differences over points i-1, i, i+1 and i, i+1, i+2:

==== =============================================================
code value at x
==== =============================================================
0    that of point i; a step at the end of the interval
1    c
2    c + d+ (x - x_i) (x - x_i+1): the parabola with the next point
3    c + d- (x - x_i) (x - x_i+1): with the one before
4    c + (d- + d+)/2 (x - x_i) (x - x_i+1): the mean of the two
==== =============================================================

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK. Two decisions: a step falls at the end of its interval, and code 4 is the
mean parabola, the same rule as on frames. ``blend="overhauser"`` is ours: it weighs d- and d+ of
code 4 by the distance from either end, which makes neighbouring intervals meet in one tangent.

Examples
--------
>>> from assoc_hull.geometry.classical.knuckle_codes import KnuckleLine
>>> line = KnuckleLine.make([0, 10, 25, 40], [5, 8, 9.5, 9], [1, 4, 1])
>>> line.at([5, 16]).round(9).tolist()
[6.5, 8.936]
"""

from __future__ import annotations

from typing import Literal, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["KnuckleLine"]


@attrs.frozen(eq=False)
class KnuckleLine:
    """A line over x: half-breadths, heights, or both.

    Attributes
    ----------
    x : (n,), m
        Not decreasing; two may be equal at a step.
    v : (n, k), m
        Values, a column each.
    code : (n - 1,) int
        Of each interval.
    blend : None or "overhauser"
        How code 4 is taken.
    single : bool
        Values were handed in as (n,), and are given back without the column.
    """

    x: FloatArray
    v: FloatArray
    code: IntArray
    blend: str | None
    single: bool

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.v, self.code)

    @classmethod
    def make(
        cls, x: ArrayLike, v: ArrayLike, code: ArrayLike,
        blend: Literal["overhauser"] | None = None,
    ) -> Self:  # fmt: skip
        """Check what is handed in.

        Parameters
        ----------
        x : (n,) array_like, m
            Not decreasing, n >= 2.
        v : (n,) or (n, 2) array_like, m
            Half-breadths or heights, or both.
        code : (n - 1,) array_like of int
            From 0 to 4.
        blend : None or "overhauser"
            How code 4 is taken.

        Raises
        ------
        GeometryError
            ``"knuckle line: code {c} at interval {i} not in 0..4"``, ``"... needs point {i+2}; use
            code 3"``, ``"... needs point {i-1}; use code 2"``, ``"knuckle line: zero-length
            interval {i} allowed only with code 0"``, ``"... reaches across a step"``; x that
            decreases, fewer than two points, another `blend`.
        """
        places = finite(x, "knuckle line", (None,))
        values = _columns(v, len(places))
        single = values.ndim == 1
        codes = finite(code, "knuckle line", (max(len(places) - 1, 0),))
        if len(places) < 2:
            what = f"knuckle line: {len(places)} point(s)"
            raise GeometryError(what, "give two or more", {"points": len(places)})
        if blend is not None:
            one_of(blend, ("overhauser",), "knuckle line: blend is")
        _check(places, codes)
        columns = values[:, None] if single else values
        return cls(places, columns, codes.astype(np.int64), blend, single)

    @property
    def ends(self) -> tuple[float, float]:
        """The least and the greatest x, m."""
        return float(self.x[0]), float(self.x[-1])

    def at(self, x: ArrayLike, side: Literal["left", "right"] = "right") -> FloatArray:
        """Give values at x.

        Parameters
        ----------
        x : array_like, m
            Of any shape.
        side : {"right", "left"}
            Which limit counts at a step.

        Returns
        -------
        array, m
            Of the shape of `x`, with a last axis of two if values were handed in as (n, 2).

        Raises
        ------
        GeometryError
            ``"knuckle line: x={x} outside [{a}, {b}]"``.
        """
        one_of(side, ("left", "right"), "knuckle line: side is")
        place = inside(x, "knuckle line", *self.ends)
        found = self._interval_values(place, self._interval(place, side))
        beyond = place == (self.x[-1] if side == "right" else self.x[0])
        end = self.v[-1] if side == "right" else self.v[0]
        return self._give(np.where(beyond[..., None], end, found))

    def slopes(self, x: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Give slopes at x from the left and from the right, shapes as of `at`.

        At an end the one there is stands for both.
        """
        place = inside(x, "knuckle line", *self.ends)
        sides: tuple[Literal["left", "right"], ...] = ("left", "right")
        found = [self._interval_slopes(place, self._interval(place, each)) for each in sides]
        return self._give(found[0]), self._give(found[1])

    def slope_jumps(self) -> FloatArray:
        """Give the slope after each inner point less that before it, (n - 2,) or (n - 2, 2)."""
        before, after = self.slopes(self.x[1:-1])
        return np.asarray(after - before)

    def _give(self, found: FloatArray) -> FloatArray:
        return np.asarray(found[..., 0] if self.single else found)

    def _interval(self, place: FloatArray, side: Literal["left", "right"]) -> IntArray:
        """Tell the interval that a limit is taken in; never one of no length."""
        number = np.searchsorted(self.x, place, side=side) - 1
        long = np.flatnonzero(np.diff(self.x) > 0.0)
        if not len(long):
            return np.zeros(place.shape, np.int64)
        return np.asarray(np.clip(number, long[0], long[-1]), np.int64)

    def _bend(self, number: IntArray, place: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the factor of (x - x_i)(x - x_i+1), and its slope over x, (..., k)."""
        code, last = self.code[number], len(self.x) - 1
        before = _second_difference(self.x, self.v, np.clip(number - 1, 0, max(last - 2, 0)))
        after = _second_difference(self.x, self.v, np.clip(number, 0, max(last - 2, 0)))
        h = self.x[number + 1] - self.x[number]
        part = ((place - self.x[number]) / np.where(h > 0.0, h, 1.0))[..., None]
        weight = part if self.blend else np.full_like(part, 0.5)
        kind = code[..., None]
        factor = np.where(
            kind == 2, after, np.where(kind == 3, before, (1.0 - weight) * before + weight * after)
        )
        slope = (after - before) / np.where(h > 0.0, h, 1.0)[..., None] if self.blend else 0.0
        bends = kind >= 2
        return np.where(bends, factor, 0.0), np.where(kind == 4, slope, 0.0)

    def _interval_values(self, place: FloatArray, number: IntArray) -> FloatArray:
        x, v, code = self.x, self.v, self.code[number]
        one, two = place - x[number], place - x[number + 1]
        h = np.where(code == 0, 1.0, one - two)
        rise = np.where((code == 0)[..., None], 0.0, v[number + 1] - v[number])
        factor, _ = self._bend(number, place)
        return np.asarray(v[number] + rise * (one / h)[..., None] + factor * (one * two)[..., None])

    def _interval_slopes(self, place: FloatArray, number: IntArray) -> FloatArray:
        x, v, code = self.x, self.v, self.code[number]
        one, two = place - x[number], place - x[number + 1]
        h = np.where(code == 0, 1.0, one - two)
        rise = np.where((code == 0)[..., None], 0.0, v[number + 1] - v[number])
        factor, slope = self._bend(number, place)
        found = rise / h[..., None] + factor * (one + two)[..., None]
        return np.asarray(found + slope * (one * two)[..., None])


def _columns(v: ArrayLike, count: int) -> FloatArray:
    """Take values in one column or in two."""
    try:
        return finite(v, "knuckle line", (count,))
    except GeometryError:
        return finite(v, "knuckle line", (count, 2))


def _second_difference(x: FloatArray, v: FloatArray, first: IntArray) -> FloatArray:
    """Give [x_i, x_i+1, x_i+2] v; what a line of two points has stands for nothing."""
    if len(x) < 3:
        return np.zeros((*np.shape(first), v.shape[1]))
    a, b, c = (x[first + k][..., None] for k in range(3))
    with np.errstate(divide="ignore", invalid="ignore"):
        one = (v[first + 1] - v[first]) / (b - a)
        two = (v[first + 2] - v[first + 1]) / (c - b)
        found = (two - one) / (c - a)
    return np.where(np.isfinite(found), found, 0.0)


def _check(x: FloatArray, code: FloatArray) -> None:
    """Refuse codes that no value comes of."""
    step = np.diff(x)
    if (step < 0.0).any():
        row = int(np.argmax(step < 0.0)) + 1
        what = f"knuckle line: x must be non-decreasing (row {row})"
        raise GeometryError(what, "put the points in order from aft", {"row": row})
    for i, c in enumerate(code.tolist()):
        told = {"interval": i, "code": c}
        name = f"knuckle line: code {figure(c)} at interval {i}"
        if c not in range(5):
            raise GeometryError(f"{name} not in 0..4", "give one of these", told)
        if step[i] == 0.0 and c != 0:
            what = f"knuckle line: zero-length interval {i} allowed only with code 0"
            raise GeometryError(what, "give code 0 or move a point", told)
        ahead, behind = c in (2, 4), c in (3, 4)
        if ahead and i == len(code) - 1:
            what = f"{name} needs point {i + 2}; use code 3"
            raise GeometryError(what, "it is the last interval", told)
        if behind and i == 0:
            what = f"{name} needs point {i - 1}; use code 2"
            raise GeometryError(what, "it is the first interval", told)
        if (ahead and step[i + 1] == 0.0) or (behind and step[i - 1] == 0.0):
            remedy = "use the parabola of the other side, or a straight line"
            raise GeometryError(f"{name} reaches across a step", remedy, told)

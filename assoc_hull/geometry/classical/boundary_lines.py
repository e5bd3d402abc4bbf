"""Lines along a ship that bound or part its sections, given by points.

`KeelOutline` is the contour in the centre plane with the flat of bottom, `CodedKnuckleLine` a deck
side or knuckle over x whose intervals say how they are interpolated (both SEAKING). `SpaceCurve` is
a polyline or natural spline in space (PRELIKON). None needs another. x forward, z up from the base
line, m. Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design
and Production", J. SNAK.
"""

from __future__ import annotations

from typing import Literal, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline, PPoly

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, finite_array, one_of, within_range
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "CodedKnuckleLine",
    "KeelOutline",
    "SpaceCurve",
]

# --------------------------------------------------------------------------------------
# Keel. The contour is given abaft and ahead of the level keel; over the level keel the flat of
# bottom has a half-width. All run in straight lines between given points. Part III of the source is
# taken for the second of the two that have a contour.

_SAME = 1e-9
"""Places (m) that differ by less are one."""


@attrs.frozen(eq=False)
class KeelOutline:
    """Contour and flat of bottom; x forward, z up from the base line, m.

    Attributes
    ----------
    x_a, x_b : float, m
        Where the level keel begins and ends.
    aft, forward : (n, 2), m
        Rows (x, z), x not decreasing; they come to the level keel at `x_a` and leave it at `x_b`.
        Upright pieces only at an end.
    tangent : (n, 2), m
        Rows (x, b): half-widths of the flat of bottom.
    notes : tuple of str
        A flat of bottom that begins or ends with a step.
    """

    x_a: float
    x_b: float
    aft: FloatArray
    forward: FloatArray
    tangent: FloatArray
    notes: tuple[str, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.aft, self.forward, self.tangent)

    @classmethod
    def make(
        cls, x_a: float, x_b: float, aft: ArrayLike, forward: ArrayLike, tangent: ArrayLike
    ) -> Self:
        """Check the arguments, which are as the attributes.

        Raises
        ------
        GeometryError
            ``"contour: x must be non-decreasing (row {i})"``, ``"contour: part {p} must end at
            x={x} with z=0, got z={z}"``, ``"bottom tangent line: negative half-width at row
            {i}"``, ``"bottom tangent line: must cover [{x_a}, {x_b}]"``; an upright piece that is
            not at an end, limits in the wrong order.
        """
        first, last = (float(finite_array(each, "contour", ())) for each in (x_a, x_b))
        if not first < last:
            raise GeometryError(
                f"contour: the level keel runs from x={digits(first)} to {digits(last)}",
                "give limits in ascending order", {"x_a": first, "x_b": last},
            )  # fmt: skip
        stern = _contour(aft, 1, first)
        stem = _contour(forward, 3, last)
        line = _tangent(tangent, first, last)
        return cls(first, last, stern, stem, line, _steps(line, first, last))

    @property
    def ends(self) -> tuple[float, float]:
        """The least and the greatest x, m."""
        return float(self.aft[0, 0]), float(self.forward[-1, 0])

    def part(self, x: ArrayLike) -> IntArray:
        """Tell the part of each x (m): 1 abaft the level keel, 2 on it, 3 ahead of it.

        Raises
        ------
        GeometryError
            ``"contour: x={x} outside [{a}, {b}]"``, as from all of these.
        """
        place = within_range(x, "contour", *self.ends)
        # Both limits belong to the level keel.
        return np.asarray(1 + (place >= self.x_a) + (place > self.x_b), np.int64)

    def height(self, x: ArrayLike) -> FloatArray:
        """Give heights of the keel (m) at x (m); the lower one where it is upright."""
        place, part = within_range(x, "contour", *self.ends), self.part(x)
        stern = np.interp(place, *_graph(self.aft, outer=0).T)
        stem = np.interp(place, *_graph(self.forward, outer=-1).T)
        return np.where(part == 1, stern, np.where(part == 3, stem, 0.0))

    def flat(self, x: ArrayLike) -> FloatArray:
        """Give half-widths of the flat of bottom (m) at x (m), 0 off the level keel."""
        place, part = within_range(x, "contour", *self.ends), self.part(x)
        return np.where(part == 2, np.interp(place, *self.tangent.T), 0.0)


def _contour(rows: ArrayLike, part: int, end: float) -> FloatArray:
    """Take a contour that comes to the level keel at `end`, its last row aft, its first forward."""
    given = finite_array(rows, f"contour: part {part}", (None, 2))
    if not len(given):
        raise GeometryError(
            f"contour: part {part} has {len(given)} row(s)", "give one or more", {"part": part}
        )
    step = np.diff(given[:, 0])
    if (step < 0.0).any():
        row = int(np.argmax(step < 0.0)) + 1
        what = f"contour: x must be non-decreasing (row {row})"
        raise GeometryError(what, "put the rows in order from aft", {"row": row, "part": part})
    x, z = given[-1 if part == 1 else 0]
    if abs(x - end) > _SAME or abs(z) > _SAME:
        raise GeometryError(
            f"contour: part {part} must end at x={digits(end)} with z=0, got z={digits(z)}"
            + (f" at x={digits(x)}" if abs(x - end) > _SAME else ""),
            "let it come to the level keel", {"part": part, "x": float(x), "z": float(z)},
        )  # fmt: skip
    upright = (step == 0.0) & (given[1:, 0] != given[0, 0]) & (given[1:, 0] != given[-1, 0])
    if upright.any():
        row = int(np.argmax(upright)) + 1
        what = f"contour: part {part} is upright at row {row}, x={digits(given[row, 0])}"
        raise GeometryError(what, "let it be upright at an end only", {"row": row, "part": part})
    return given


def _graph(contour: FloatArray, outer: int) -> FloatArray:
    """Give the rows that make height a function of x: one row for each upright end.

    At the outer end that is the lowest; at the inner one the highest, as the keel there has the
    level keel for its lower end.
    """
    x, low, high = contour[:, 0], contour[outer, 0], contour[-1 - outer, 0]
    inner = contour[(x > min(low, high)) & (x < max(low, high))]
    ends = [
        (low, contour[x == low, 1].min()), (high, contour[x == high, 1].max()),
    ]  # fmt: skip
    return np.concatenate([[min(ends)], inner, [max(ends)]])


def _tangent(rows: ArrayLike, first: float, last: float) -> FloatArray:
    given = finite_array(rows, "bottom tangent line", (None, 2))
    negative = np.flatnonzero(given[:, 1] < 0.0)
    if len(negative):
        row = int(negative[0])
        what = f"bottom tangent line: negative half-width at row {row}"
        raise GeometryError(what, "give 0 or more", {"row": row, "b": float(given[row, 1])})
    back = np.flatnonzero(np.diff(given[:, 0]) <= 0.0)
    if len(back):
        row = int(back[0]) + 1
        what = f"bottom tangent line: x must be increasing (row {row})"
        raise GeometryError(what, "put the rows in order from aft", {"row": row})
    if not len(given) or given[0, 0] > first + _SAME or given[-1, 0] < last - _SAME:
        raise GeometryError(
            f"bottom tangent line: must cover [{digits(first)}, {digits(last)}]",
            "give rows from one end of the level keel to the other", {"x_a": first, "x_b": last},
        )  # fmt: skip
    return given


def _steps(tangent: FloatArray, first: float, last: float) -> tuple[str, ...]:
    """Report steps in the flat of bottom, where it should close."""
    return tuple(
        f"bottom tangent line: b={digits(width)} at x={digits(x)}, where the level keel {does}: "
        "the flat of bottom has a step there"
        for x, does in ((first, "begins"), (last, "ends"))
        if (width := float(np.interp(x, *tangent.T))) > _SAME
    )


# --------------------------------------------------------------------------------------
# Deck sides and knuckle lines. With h the length of interval i, c the straight line over it, and d-
# and d+ the divided differences over points i-1, i, i+1 and i, i+1, i+2:
#
# ==== =============================================================
# code value at x
# ==== =============================================================
# 0    that of point i; a step at the end of the interval
# 1    c
# 2    c + d+ (x - x_i) (x - x_i+1): the parabola with the next point
# 3    c + d- (x - x_i) (x - x_i+1): with the one before
# 4    c + (d- + d+)/2 (x - x_i) (x - x_i+1): the mean of the two
# ==== =============================================================
#
# Two decisions: a step falls at the end of its interval, and code 4 is the mean parabola, the same
# rule as on frames. ``blend="overhauser"`` is ours: it weighs d- and d+ of code 4 by the distance
# from either end, which makes neighbouring intervals meet in one tangent.


@attrs.frozen(eq=False)
class CodedKnuckleLine:
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
        """Check the arguments.

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
        places = finite_array(x, "knuckle line", (None,))
        values = _columns(v, len(places))
        single = values.ndim == 1
        codes = finite_array(code, "knuckle line", (max(len(places) - 1, 0),))
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
        place = within_range(x, "knuckle line", *self.ends)
        found = self._interval_values(place, self._interval(place, side))
        beyond = place == (self.x[-1] if side == "right" else self.x[0])
        end = self.v[-1] if side == "right" else self.v[0]
        return self._give(np.where(beyond[..., None], end, found))

    def slopes(self, x: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Give slopes at x from the left and from the right, shapes as of `at`.

        At an end the one there is stands for both.
        """
        place = within_range(x, "knuckle line", *self.ends)
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
        # Limits at a step or an end fall in the neighbour that has a length.
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
        return finite_array(v, "knuckle line", (count,))
    except GeometryError:
        return finite_array(v, "knuckle line", (count, 2))


def _second_difference(x: FloatArray, v: FloatArray, first: IntArray) -> FloatArray:
    """Give [x_i, x_i+1, x_i+2] v, (..., k), 1/m; 0 for a line of two points and across a step."""
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
        name = f"knuckle line: code {digits(c)} at interval {i}"
        # Codes come as floats: `in range` refuses fractions too.
        if c not in range(5):
            raise GeometryError(f"{name} not in 0..4", "give one of these", told)
        # All others divide by the length of the interval.
        if step[i] == 0.0 and c != 0:
            what = f"knuckle line: zero-length interval {i} allowed only with code 0"
            raise GeometryError(what, "give code 0 or move a point", told)
        # By the next point (2), by the one before (3), by both (4).
        ahead, behind = c in (2, 4), c in (3, 4)
        if ahead and i == len(code) - 1:
            what = f"{name} needs point {i + 2}; use code 3"
            raise GeometryError(what, "it is the last interval", told)
        if behind and i == 0:
            what = f"{name} needs point {i - 1}; use code 2"
            raise GeometryError(what, "it is the first interval", told)
        # The divided difference would be over a length of nil.
        if (ahead and step[i + 1] == 0.0) or (behind and step[i - 1] == 0.0):
            remedy = "use the parabola of the other side, or a straight line"
            raise GeometryError(f"{name} reaches across a step", remedy, told)


# --------------------------------------------------------------------------------------
# Curves in space.

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)


@attrs.frozen(eq=False)
class SpaceCurve:
    """A polyline (C0), or a natural cubic spline per coordinate over the chord length (C2).

    The space curve of the PRELIKON system in Kim & Chang, "Some Representations of Ship Hulls
    by Mathematical Method for Design and Production", J. SNAK.

    Attributes
    ----------
    points : (n, 3), m
        Given points.
    kind : {"polyline", "spline"}
        How it runs between them.
    t : (n,), m
        Chord length at each, from 0.
    pieces : scipy.interpolate.PPoly
        All three coordinates over `t`.
    name : str
        For messages and tables.
    """

    points: FloatArray
    kind: str
    t: FloatArray
    pieces: PPoly
    name: str = "space curve"

    def __attrs_post_init__(self) -> None:
        freeze(self.points, self.t)

    @classmethod
    def make(cls, points: ArrayLike, *, kind: str = "polyline", name: str = "space curve") -> Self:
        """Check the arguments, which are as the attributes.

        Raises
        ------
        GeometryError
            ``"space curve: repeated point {i}"``; fewer than two points, another kind.
        """
        given = finite_array(points, "space curve", (None, 3))
        if len(given) < 2:
            what = f"space curve: expected shape (n >= 2, 3), got {given.shape}"
            raise GeometryError(what, "give two points or more", {"got": given.shape})
        if shown(kind) not in ("'polyline'", "'spline'"):
            what = f"space curve: kind is {shown(kind)}"
            raise GeometryError(what, 'use "polyline" or "spline"')
        chord = np.linalg.norm(np.diff(given, axis=0), axis=1)
        same = np.flatnonzero(chord == 0.0)
        if len(same):
            index = int(same[0]) + 1
            what = f"space curve: repeated point {index}"
            raise GeometryError(what, "leave it out", {"index": index})
        t = np.concatenate([[0.0], np.cumsum(chord)])
        return cls(given, kind, t, _pieces(given, t, kind), str(name))

    @property
    def length(self) -> float:
        """Along the curve, m; of a spline by 20 Gauss points an interval."""
        if self.kind == "polyline":
            return float(self.t[-1])
        half = 0.5 * np.diff(self.t)
        at = self.t[:-1, None] + half[:, None] * (1.0 + _NODES)
        speed = np.linalg.norm(self.pieces(at, 1), axis=-1)
        return float((speed @ _WEIGHTS * half).sum())

    def at(self, t: ArrayLike) -> FloatArray:
        """Give points (..., 3), m, at chord lengths (m).

        Raises
        ------
        GeometryError
            ``"space curve: x={x} outside [{a}, {b}]"``, where x is the chord length.
        """
        asked = within_range(
            t, "space curve", 0.0, float(self.t[-1]), slack=1e-9 * float(self.t[-1])
        )
        return np.asarray(self.pieces(asked))

    def where(self, axis: int, value: float) -> FloatArray:
        """Give all points (k, 3), m, at which a coordinate has a value, in order along the curve.

        Parameters
        ----------
        axis : int
            0, 1 or 2: which coordinate.
        value : float, m
            Its value. An interval that lies in the plane gives both its ends.

        Raises
        ------
        GeometryError
            Another axis, or a value that is no finite number.
        """
        asked = float(finite_array(value, "space curve", ()))
        if shown(axis) not in ("0", "1", "2"):
            what = f"space curve: axis is {shown(axis)}"
            raise GeometryError(what, "use 0, 1 or 2", {"axis": axis})
        slack = 1e-9 * float(np.linalg.norm(np.ptp(self.points, axis=0)))
        one = PPoly(self.pieces.c[:, :, axis], self.pieces.x, extrapolate=False)
        roots = np.asarray(one.solve(asked, discontinuity=False, extrapolate=False))
        given = self.t[np.abs(self.points[:, axis] - asked) <= slack]
        t = np.sort(np.concatenate([roots[np.isfinite(roots)], given]))
        new = np.ones(len(t), bool)
        new[1:] = np.diff(t) > 4.0 * slack
        points = self.at(t[new])
        points[:, axis] = asked
        return points

    def moved(self, by: float) -> Self:
        """Give the same curve with `by` (m) added to every x."""
        step = float(finite_array(by, "space curve", ()))
        return type(self).make(
            self.points + np.array([step, 0.0, 0.0]), kind=self.kind, name=self.name
        )


def _pieces(points: FloatArray, t: FloatArray, kind: str) -> PPoly:
    if kind == "spline":
        return CubicSpline(t, points, bc_type="natural")
    slope = np.diff(points, axis=0) / np.diff(t)[:, None]
    return PPoly(np.stack([slope, points[:-1]]), t)

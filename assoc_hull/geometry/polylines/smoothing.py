"""The smoothest curves within a tolerance of polylines, one by one or joined with one another.

A cubic spline is fitted with a penalty on the change of curvature, as large as the tolerance
allows: the curve has the shape of the data and not their scatter. Curves that were cut from one
noisy surface no longer intersect once each is smoothed for itself; `join_fits` solves them as one
system, in which each place of intersection adds the square of their distance along the normal.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.polylines.operations import cumulative_lengths, drop_repeats, resample

__all__ = [
    "FitTie",
    "PenalisedFit",
    "PolylineFit",
    "SmoothedPolyline",
    "fit_polyline",
    "join_fits",
    "local_scatter",
    "smooth_polyline",
    "straight_polyline",
]

# --------------------------------------------------------------------------------------
# One cubic spline with a penalty on the change of curvature.

_HOLD = 1e5
"""Weight of what is given at an end, against the data."""

_STIFFEST = 12.0
"""Logarithm of the largest penalty over that which weighs as the data do: of a stiffer curve the
equations are so ill-conditioned that rounding moves it by millimetres."""


class PenalisedFit:
    """The fits of one curve on given knots.

    Everything is measured in spans, so that long flat and short round parts count alike.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.smoothing import PenalisedFit
    >>> at = np.linspace(0.0, 4.0, 41)
    >>> line = np.column_stack([at, 0.5 * at])
    >>> fit = PenalisedFit(at, line, np.full(41, 1e-3), np.linspace(0.0, 4.0, 5))
    >>> bool(fit.off(fit.solve(1.0)).max() < 1e-9)
    True
    """

    def __init__(
        self,
        at: FloatArray,
        data: FloatArray,
        allowed: FloatArray,
        knots: FloatArray,
        first: FloatArray | None = None,
        last: FloatArray | None = None,
    ) -> None:
        """Set up the equations.

        Parameters
        ----------
        at, data, allowed : (n,), (n, d), (n,), m
            Lengths along the curve, places there, and how far the fit may pass them.
        knots : (k + 1,), m
            From the first to the last length.
        first, last : (d,) or None
            Given directions at the ends, along the curve.
        """
        from scipy.interpolate import BSpline

        self.at, self.data, self.allowed, self.knots = at, data, allowed, knots
        self.full = full = np.concatenate([[knots[0]] * 3, knots, [knots[-1]] * 3])
        span = np.diff(knots)
        mine = span[np.clip(np.searchsorted(knots, at, "right") - 1, 0, len(span) - 1)]
        weight = np.gradient(at) / mine * (allowed.mean() / allowed) ** 2
        weight[[0, -1]] = _HOLD * weight.mean()
        lower = [_differences(full, 3 - order, order) for order in range(3)]
        self.basis = BSpline.design_matrix(at, full, 3)
        self.slope = BSpline.design_matrix(at, full[1:-1], 2) @ lower[0]
        third = lower[2] @ lower[1] @ lower[0]
        self.normal = _bands(self.basis.T @ self.basis.multiply(weight[:, None]))
        self.right = np.asarray(self.basis.T @ (weight[:, None] * data))
        self.penalty = _bands(third.T @ third.multiply((span**6)[:, None]))
        for row, given in ((0, first), (-1, last)):
            if given is not None:
                # Lengths are the parameter, so the derivative is the unit direction.
                unit = np.asarray(given, np.float64) / np.linalg.norm(given)
                one = self.slope[[row]]
                size = _HOLD * weight[1:-1].mean() * (span.min() if len(span) else 1.0) ** 2
                self.normal = self.normal + size * _bands(one.T @ one)
                self.right = self.right + size * np.asarray(one.T @ unit[None, :])

    def solve(self, size: float) -> FloatArray:
        """Give the control points for a size of the penalty, (m, d)."""
        return self.respond(size, self.right)

    def respond(self, size: float, right: FloatArray) -> FloatArray:
        """Solve the equations with a size of the penalty for another right side, (m, k)."""
        from scipy.linalg import solveh_banded

        found: FloatArray = solveh_banded(
            self.normal + size * self.penalty, right, lower=True, check_finite=False
        )
        return found

    def scale(self) -> float:
        """Give the size at which penalty and data weigh the same."""
        return float(self.normal[0].sum() / max(float(self.penalty[0].sum()), 1e-300))

    def off(self, control: FloatArray) -> FloatArray:
        """Give the distance of each sample across the curve, (n,), m."""
        away, slope = self.basis @ control - self.data, self.slope @ control
        along = (away * slope).sum(axis=1) / np.maximum((slope * slope).sum(axis=1), 1e-24)
        across = away - along[:, None] * slope
        return np.asarray(np.sqrt((across * across).sum(axis=1)))

    def misfit(self, control: FloatArray) -> float:
        """Give the distance of the samples as a part of what is allowed."""
        part = self.off(control) / self.allowed
        return max(float(np.percentile(part, 98)), 0.5 * float(part.max()))

    def too_coarse(self) -> np.typing.NDArray[np.bool_]:
        """Say which spans to halve: those too far off, and those far longer than a neighbour."""
        off = self.off(self.solve(1e-9 * self.scale()))
        number = np.clip(np.searchsorted(self.knots, self.at, "right") - 1, 0, len(self.knots) - 2)
        worst = np.zeros(len(self.knots) - 1)
        np.maximum.at(worst, number, off / self.allowed)
        span = np.diff(self.knots)
        split = (worst > 1.0) & (np.bincount(number, minlength=len(span)) >= 4)
        after = np.where(split, 0.5 * span, span)
        shorter = np.minimum(np.append(after[1:], np.inf), np.append(np.inf, after[:-1]))
        return np.asarray(split | (span > 3.9 * shorter))

    def largest(self) -> float:
        """Give the largest penalty with which the fit stays as near as allowed."""
        low, high = np.log(self.scale()) - 18.0, np.log(self.scale()) + 25.0
        for _ in range(14):
            middle = 0.5 * (low + high)
            if self.misfit(self.solve(float(np.exp(middle)))) <= 1.0:
                low = middle
            else:
                high = middle
        return float(np.exp(min(low, np.log(self.scale()) + _STIFFEST)))

    def rows(self, at: FloatArray) -> Any:
        """Give the sparse matrix from control points to places at lengths within the ends."""
        from scipy.interpolate import BSpline

        return BSpline.design_matrix(np.clip(at, self.knots[0], self.knots[-1]), self.full, 3)


def _differences(full: FloatArray, degree: int, order: int) -> Any:
    """Give the sparse matrix from control points to those of the derivative."""
    from scipy.sparse import csr_array

    knots = full[order : len(full) - order]
    count = len(knots) - degree - 1
    gap = knots[degree + 1 : degree + count] - knots[1:count]
    size = degree / np.where(gap > 0.0, gap, np.inf)
    # The rows as they are stored: made from diagonals they take three times as long.
    first = np.arange(count - 1, dtype=np.int32)
    column = np.stack([first, first + 1], axis=1).ravel()
    value = np.stack([-size, size], axis=1).ravel()
    start = np.arange(0, 2 * count, 2, dtype=np.int32)
    found: Any = csr_array((value, column, start), shape=(count - 1, count))
    if not size.all():
        found.eliminate_zeros()
    return found


def _bands(matrix: Any) -> FloatArray:
    """Give the diagonal and the three below it, (4, m)."""
    out = np.zeros((4, matrix.shape[0]))
    for i in range(min(4, matrix.shape[0])):
        below = matrix.diagonal(-i)
        out[i, : len(below)] = below
    return out


# --------------------------------------------------------------------------------------
# The smoothest curve within a tolerance.

_LEAST_SPANS, _MOST_SPANS = 8, 300


@attrs.frozen(eq=False)
class SmoothedPolyline:
    """A smooth curve as points and directions.

    Attributes
    ----------
    points : (k, d), m
        Close enough that a cubic spline through them is the curve.
    at : (k,), m
        Lengths along the polyline to which they belong.
    first, last : (d,)
        Unit directions at the ends, along the curve.
    residual : float, m
        Largest distance of a place of the polyline from the curve.
    spans : int
        Cubics it was made of.
    """

    points: FloatArray
    at: FloatArray
    first: FloatArray
    last: FloatArray
    residual: float
    spans: int

    def __attrs_post_init__(self) -> None:
        freeze(self.points, self.at, self.first, self.last)


@attrs.frozen(eq=False)
class PolylineFit:
    """The fit of a polyline with the size of the penalty, before it is drawn.

    Attributes
    ----------
    fit : PenalisedFit
        The equations.
    size : float
        Of the penalty.
    control : (m, d), m
        Control points.
    """

    fit: PenalisedFit
    size: float
    control: FloatArray

    def draw(self) -> SmoothedPolyline:
        """Give the curve as points."""
        return _result(self.fit, self.control)


def smooth_polyline(
    points: FloatArray,
    tolerance: float | FloatArray,
    first: FloatArray | None = None,
    last: FloatArray | None = None,
) -> SmoothedPolyline:
    """Fit the smoothest curve that stays within a tolerance of a polyline.

    Parameters
    ----------
    points : (n, d), m
        In order; both ends are kept.
    tolerance : float or (n,), m
        How far 49 of 50 places of the polyline may lie off, and half of how far any may, if
        that can be had; for all points or for each.
    first, last : (d,) or None
        Given directions at the ends, along the curve.
    """
    fitted = fit_polyline(points, tolerance, first, last)
    return straight_polyline(points) if fitted is None else fitted.draw()


def straight_polyline(points: FloatArray, count: int = 2) -> SmoothedPolyline:
    """Give the straight line between the ends of a polyline, as points."""
    part = np.linspace(0.0, 1.0, count)
    step = points[-1] - points[0]
    length = float(np.sqrt((step * step).sum()))
    ahead = step / max(length, 1e-12)
    drawn = points[0] + part[:, None] * step
    return SmoothedPolyline(drawn, part * length, ahead, ahead.copy(), 0.0, 1)


def fit_polyline(
    points: FloatArray,
    tolerance: float | FloatArray,
    first: FloatArray | None = None,
    last: FloatArray | None = None,
    *,
    curved: bool = False,
) -> PolylineFit | None:
    """Fit as `smooth_polyline` does, but do not draw; None for fewer than three places.

    `curved` says that the line between wide-apart points is as they bend, not their chord, which
    lies inside the hull where a curved line was digitised by few points.
    """
    near = np.zeros(len(points)) + tolerance
    line = drop_repeats(points, 1e-6)
    near = near if len(line) == len(points) else np.full(len(line), near.max())
    length = cumulative_lengths(line)
    if len(line) < 3:
        return None
    at, data = _samples(line, curved=curved)
    allowed = np.interp(at, length, near)
    knots = np.linspace(0.0, length[-1], min(_LEAST_SPANS, max(2, len(at) // 3)) + 1)
    fit = PenalisedFit(at, data, allowed, knots, first, last)
    # Fewest spans: only those are halved that pass the points too far off.
    for _ in range(12):
        split = fit.too_coarse()
        if not split.any() or len(knots) > _MOST_SPANS:
            break
        middle = 0.5 * (knots[1:] + knots[:-1])
        knots = np.sort(np.concatenate([knots, middle[split]]))
        fit = PenalisedFit(at, data, allowed, knots, first, last)
    size = fit.largest()
    return PolylineFit(fit, size, fit.solve(size))


_CURVED = 4
"""Fewer points than this do not tell how a line bends between them."""


def _samples(line: FloatArray, *, curved: bool = False) -> tuple[FloatArray, FloatArray]:
    """Give the points and more between those that lie wide apart, on chords or on a curve."""
    at = cumulative_lengths(line)
    most = float(at[-1]) / 80.0
    step = np.diff(at)
    many = np.maximum(np.ceil(step / most - 1e-9), 1.0).astype(np.int64)
    start = np.repeat(at[:-1], many)
    part = np.arange(len(start)) - np.repeat(np.cumsum(many) - many, many)
    place = np.append(start + part * np.repeat(step / many, many), at[-1])
    if not curved or len(line) < _CURVED or not (many > 1).any():
        return place, resample(line, place)
    from scipy.interpolate import Akima1DInterpolator

    # Makima: it keeps straight runs straight and does not swing beside a short step.
    there, led = _led_on(at, line)
    found: FloatArray = Akima1DInterpolator(there, led, method="makima")(place)
    found[-1] = line[-1]
    return place, found


def _led_on(at: FloatArray, line: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give a line with a point more before and behind, as far off as the first and the last step.

    It bends on there as at its ends, but less as the step at the end is longer than the next: a
    flat of one step does not bend against the bilge behind it.
    """
    beyond = []
    for end, mid, inner in ((0, 1, 2), (-1, -2, -3)):
        step, other = at[mid] - at[end], at[inner] - at[mid]
        slope, after = (line[mid] - line[end]) / step, (line[inner] - line[mid]) / other
        beyond.append(line[end] - step * (slope - (after - slope) * min(1.0, other / step)))
    ends = 2.0 * at[0] - at[1], 2.0 * at[-1] - at[-2]
    return (
        np.concatenate([[ends[0]], at, [ends[1]]]),
        np.concatenate([[beyond[0]], line, [beyond[1]]]),
    )


def _result(fit: PenalisedFit, control: FloatArray) -> SmoothedPolyline:
    """Give points at the knots and half-way between them."""
    from scipy.interpolate import BSpline

    knots = fit.knots
    full = np.concatenate([[knots[0]] * 3, knots, [knots[-1]] * 3])
    curve = BSpline(full, control, 3)
    middle = 0.5 * (knots[1:] + knots[:-1])
    # Closer at the ends, where a spline through the points is less sure of its direction.
    near = np.array([0.06, 0.22])
    first, last = knots[1] - knots[0], knots[-1] - knots[-2]
    ends = np.concatenate([knots[0] + near * first, knots[-1] - near * last])
    at = np.sort(np.concatenate([knots, middle, ends]))
    points = curve(at)
    points[0], points[-1] = fit.data[0], fit.data[-1]
    ends = curve(knots[[0, -1]], 1)
    ends = ends / np.linalg.norm(ends, axis=1)[:, None]
    return SmoothedPolyline(
        points, at, ends[0], ends[1], float(fit.off(control).max()), len(knots) - 1
    )


def local_scatter(points: FloatArray, per_span: int = 8) -> FloatArray:
    """Estimate at each point how far the points around it scatter about a curve, (n,), m.

    The curve is a cubic spline with a span to every `per_span` points; what waves within two
    spans counts as scatter.

    Parameters
    ----------
    points : (n, d), m
        In order, each once.
    per_span : int
        Points per span.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.smoothing import local_scatter
    >>> x = np.linspace(0.0, 20.0, 201)
    >>> y = np.random.default_rng(1).normal(0.0, 1e-3, 201)
    >>> bool(abs(local_scatter(np.column_stack([x, y])).mean() - 1e-3) < 2e-4)
    True
    """
    from scipy.ndimage import uniform_filter1d

    if len(points) < 5:
        return np.zeros(len(points))
    at, data = _samples(points)
    spans = max(4, len(at) // per_span)
    number = np.round(np.linspace(0, len(at) - 1, spans + 1)).astype(np.int64)
    fit = PenalisedFit(at, data, np.ones(len(at)), at[np.unique(number)])
    off = fit.off(fit.solve(1e-6 * fit.scale()))
    mean = np.sqrt(np.maximum(uniform_filter1d(off * off, 2 * per_span + 1), 0.0))
    return np.asarray(np.interp(cumulative_lengths(points), at, mean))


# --------------------------------------------------------------------------------------
# The fits of many polylines, solved as one.
#
# Each curve keeps its data and its penalty. Two curves are tied along the normal of the surface
# only: along the surface a curve may slide at will, there a distance means nothing. All is linear,
# hence one system of equations.


@attrs.frozen(eq=False)
class FitTie:
    """A place where two curves ought to intersect: ``way_a . a - way_b . b = offset``.

    Attributes
    ----------
    a, b : int
        Numbers of the fits; -1 for b where it may not move.
    at_a, at_b : float, m
        Lengths along their polylines.
    way_a, way_b : (d,)
        The normal of the surface in the coordinates of each fit.
    offset : float, m
        What the coordinates that a fit has not, or a curve that may not move, add.
    """

    a: int
    at_a: float
    way_a: FloatArray
    b: int
    at_b: float
    way_b: FloatArray
    offset: float


_ROUNDS = 3
"""How often the penalties of curves that pass their data too far off are lowered."""

_WIDE = 1.5
"""Data passed by more than this part of what is allowed are passed too far off."""

_LESS = 0.15
"""Factor by which they are lowered."""


def join_fits(
    fits: Sequence[PolylineFit], ties: Sequence[FitTie], near: float
) -> list[PolylineFit]:
    """Fit all curves at once so that they intersect at ties; fits come in the order given.

    The sizes of their penalties are lowered only where a curve would else pass its data farther off
    than it may. A distance of two curves of `near` (m) weighs as much as a datum that lies off by
    what is allowed.
    """
    if not ties:
        return list(fits)
    held = _held(len(fits), ties)
    offset = np.array([tie.offset for tie in ties])
    found = list(fits)
    for turn in range(_ROUNDS):
        controls = _solve(found, held, offset, near)
        found = [
            attrs.evolve(each, control=control)
            for each, control in zip(found, controls, strict=True)
        ]
        wide = [each.fit.misfit(each.control) > _WIDE for each in found]
        if turn == _ROUNDS - 1 or not any(wide):
            break
        found = [
            attrs.evolve(each, size=each.size * _LESS) if far else each
            for each, far in zip(found, wide, strict=True)
        ]
    return found


@attrs.frozen(eq=False)
class _Held:
    """The ties of one fit: their numbers, lengths and normals, positive toward it."""

    tie: IntArray
    at: FloatArray
    way: FloatArray


def _held(count: int, ties: Sequence[FitTie]) -> list[_Held | None]:
    """Sort the ends of ties by fit."""
    mine: list[list[tuple[int, float, FloatArray]]] = [[] for _ in range(count)]
    for i, tie in enumerate(ties):
        mine[tie.a].append((i, tie.at_a, tie.way_a))
        if tie.b >= 0:
            mine[tie.b].append((i, tie.at_b, -tie.way_b))
    return [
        _Held(*(np.array(column) for column in zip(*each, strict=True))) if each else None
        for each in mine
    ]


def _solve(
    fits: Sequence[PolylineFit], held: Sequence[_Held | None], offset: FloatArray, near: float
) -> list[FloatArray]:
    """Solve for the control points of all fits.

    The fits are banded and the ties few, so the forces that the ties exert are solved for
    first: a dense system with a row to each tie.
    """
    matrix, away = np.diag(np.full(len(offset), near * near)), -offset
    free = [each.fit.solve(each.size) for each in fits]
    answers: list[FloatArray | None] = []
    for each, control, mine in zip(fits, free, held, strict=True):
        answer = None if mine is None else _answer(each, mine)
        answers.append(answer)
        if mine is not None and answer is not None:
            rows = each.fit.rows(mine.at)
            matrix[np.ix_(mine.tie, mine.tie)] += (rows @ answer) * (mine.way @ mine.way.T)
            away[mine.tie] += ((rows @ control) * mine.way).sum(axis=1)
    force = np.linalg.solve(matrix, away)
    return [
        control
        if mine is None or answer is None
        else control - answer @ (force[mine.tie][:, None] * mine.way)
        for control, mine, answer in zip(free, held, answers, strict=True)
    ]


def _answer(each: PolylineFit, mine: _Held) -> FloatArray:
    """Give how control points give way to a unit force at each tie, (m, k), m2."""
    # Each curve counts in parts of what it is allowed.
    weight = 1.0 / float(each.fit.allowed.mean()) ** 2
    return each.fit.respond(each.size, each.fit.rows(mine.at).toarray().T) / weight

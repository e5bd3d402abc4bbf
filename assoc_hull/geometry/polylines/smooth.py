"""The smoothest curve within a tolerance of a polyline.

A cubic spline is fitted with a penalty on the change of its curvature; the penalty is made as
large as the tolerance allows. So the curve has the shape of the data and not their scatter.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.smooth import smooth
>>> t = np.linspace(0.0, 3.0, 200)
>>> noise = np.random.default_rng(1).normal(0.0, 1e-3, (200, 2))
>>> fit = smooth(10.0 * np.column_stack([np.cos(t), np.sin(t)]) + noise, 3e-3)
>>> radius = np.sqrt((fit.points**2).sum(axis=1))
>>> bool(np.abs(radius - 10.0).max() < 3e-3), bool(fit.residual < 6e-3)
(True, True)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.polylines.operations import arc_length, drop_repeats, resample
from assoc_hull.geometry.polylines.penalised import PenalisedFit

__all__ = ["Fitted", "Smooth", "fit_line", "local_scatter", "smooth", "straight"]

_LEAST_SPANS, _MOST_SPANS = 8, 300


@attrs.frozen(eq=False)
class Smooth:
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
class Fitted:
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

    def draw(self) -> Smooth:
        """Give the curve as points."""
        return _result(self.fit, self.control)


def smooth(
    points: FloatArray,
    tolerance: float | FloatArray,
    first: FloatArray | None = None,
    last: FloatArray | None = None,
) -> Smooth:
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
    fitted = fit_line(points, tolerance, first, last)
    return straight(points) if fitted is None else fitted.draw()


def straight(points: FloatArray, count: int = 2) -> Smooth:
    """Give the straight line between the ends of a polyline, as points."""
    part = np.linspace(0.0, 1.0, count)
    step = points[-1] - points[0]
    length = float(np.sqrt((step * step).sum()))
    ahead = step / max(length, 1e-12)
    drawn = points[0] + part[:, None] * step
    return Smooth(drawn, part * length, ahead, ahead.copy(), 0.0, 1)


def fit_line(
    points: FloatArray,
    tolerance: float | FloatArray,
    first: FloatArray | None = None,
    last: FloatArray | None = None,
) -> Fitted | None:
    """Fit as `smooth` does, but do not draw; None for fewer than three places."""
    near = np.zeros(len(points)) + tolerance
    line = drop_repeats(points, 1e-6)
    near = near if len(line) == len(points) else np.full(len(line), near.max())
    length = arc_length(line)
    if len(line) < 3:
        return None
    at, data = _samples(line)
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
    return Fitted(fit, size, fit.solve(size))


def _samples(line: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the points and more between those that lie wide apart."""
    at = arc_length(line)
    most = float(at[-1]) / 80.0
    step = np.diff(at)
    many = np.maximum(np.ceil(step / most - 1e-9), 1.0).astype(np.int64)
    start = np.repeat(at[:-1], many)
    part = np.arange(len(start)) - np.repeat(np.cumsum(many) - many, many)
    place = np.append(start + part * np.repeat(step / many, many), at[-1])
    return place, resample(line, place)


def _result(fit: PenalisedFit, control: FloatArray) -> Smooth:
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
    return Smooth(points, at, ends[0], ends[1], float(fit.off(control).max()), len(knots) - 1)


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
    >>> from assoc_hull.geometry.polylines.smooth import local_scatter
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
    return np.asarray(np.interp(arc_length(points), at, mean))

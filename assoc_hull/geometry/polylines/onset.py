"""Where a curve leaves a straight line: the zero of sqrt(deviation), as a fit.

Two shapes are fitted to the deviation u: an arc that begins at t0, and a curvature that grows
from nil, u = c (t - t0)^3. The arc is taken where it fits plainly better. Else there is no place:
what is given lies between where the two begin, with a doubt that reaches from where the arc
begins to where u = c (t - t0)^4 does.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.onset import fit_onset
>>> t = np.linspace(0.0, 12.0, 121)
>>> u = np.where(t > 10.0, 3.0 - np.sqrt(9.0 - np.clip(t - 10.0, 0.0, 2.0) ** 2), 0.0)
>>> found = fit_onset(t, u, 101, 1e-3, 1e-4, 6.0)
>>> round(found.zero, 3), round(found.radius, 3)
(10.0, 3.0)
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["FittedOnset", "fit_onset"]


@attrs.frozen
class FittedOnset:
    """Where a curve leaves a line.

    Attributes
    ----------
    zero : float, m
        Along the line.
    radius : float or None, m
        Of the arc; None where the curvature grows from nil.
    uncertainty : float, m
        Standard deviation of `zero`; of a gradual one the farthest it may lie off.
    """

    zero: float
    radius: float | None
    uncertainty: float


def fit_onset(
    t: FloatArray, u: FloatArray, last: int, within: float, noise: float, confidence: float
) -> FittedOnset:
    """Fit the beginning of a curve after a straight run.

    Parameters
    ----------
    t, u : (n,), m
        Along the line of the run and off it, to the side of the curve.
    last : int
        The last point within the tolerance.
    within, noise : float, m
        The tolerance of the run, and the scatter of its points.
    confidence : float
        As `RunRule.confidence`.
    """
    best: FittedOnset | None = None
    # The farther the curve is followed the sharper the answer, as long as it is one arc.
    for reach in (300.0, 150.0, 75.0, 36.0, 18.0, 9.0):
        stop = _stop(t, u, last, reach * within)
        start = max(0, last - 2 * (stop - last) - 6)
        if stop - last < 4:
            break
        tt, uu = t[start:stop], u[start:stop]
        arc = _fit(tt, uu, _first(tt, uu, within), _arc)
        cubic = _fit(tt, uu, _first(tt, uu, within), _cubic)
        allowed = noise * noise * max(len(tt) - 2, 1)
        low, high = min(arc[2], cubic[2]), abs(arc[2] - cubic[2]) / (noise * noise)
        if arc[2] <= cubic[2] and high >= confidence:
            drift = _drift(t, u, last, 0.25 * reach * within, within, noise, arc[0])
            best = FittedOnset(arc[0], arc[1], max(arc[3] * noise, drift, 1e-6))
        else:
            # As far as the shape that begins earliest, or latest, and the scatter of both.
            quartic = _fit(tt, uu, _first(tt, uu, within), _quartic)
            zero, ends = 0.5 * (arc[0] + cubic[0]), (arc, quartic)
            doubt = max(abs(zero - end[0]) + 2.0 * end[3] * noise for end in ends)
            best = FittedOnset(zero, None, doubt)
        best = attrs.evolve(best, uncertainty=min(best.uncertainty, arc[4]))
        if low <= 2.0 * allowed:
            return best
    if best is None:
        return FittedOnset(float(t[last]), None, 2.0 * float(t[min(last + 1, len(t) - 1)] - t[last])
                           + within)  # fmt: skip
    return FittedOnset(best.zero, None, max(best.uncertainty, 0.05))


def _drift(
    t: FloatArray, u: FloatArray, last: int, most: float, within: float, noise: float, zero: float
) -> float:
    """Give by how much the zero of an arc moves, beyond chance, when it is followed half as far.

    It does where the curve is no arc all along, and then its zero is less sure than scatter says.
    """
    stop = _stop(t, u, last, most)
    if stop - last < 4:
        return 0.0
    start = max(0, last - 2 * (stop - last) - 6)
    tt, uu = t[start:stop], u[start:stop]
    near = _fit(tt, uu, _first(tt, uu, within), _arc)
    return max(abs(near[0] - zero) - 2.0 * near[3] * noise, 0.0)


def _stop(t: FloatArray, u: FloatArray, last: int, most: float) -> int:
    """Give the number of points until the deviation is `most` or the line turns back."""
    bad = np.flatnonzero((u[last:] > most) | (np.diff(t[last:], append=np.inf) <= 0.0))
    return last + (int(bad[0]) if len(bad) else len(u) - last)


def _first(t: FloatArray, u: FloatArray, within: float) -> tuple[float, float]:
    """Give zero and slope of a straight line through sqrt(u) where u is plainly above nil."""
    out = u > within
    if out.sum() < 2:
        return float(t[-1]), 1.0
    slope, offset = np.polyfit(t[out], np.sqrt(u[out]), 1)
    slope = max(float(slope), 1e-6)
    return float(np.clip(-offset / slope, t[0], t[-1])), slope


def _arc(t: FloatArray, p: FloatArray) -> FloatArray:
    """Give the deviation of a circle that begins at p[0], the logarithm of 1 / radius p[1]."""
    away, size = np.maximum(t - p[0], 0.0), np.exp(min(max(float(p[1]), -30.0), 30.0))
    part = np.minimum(size * away, 0.999)
    return np.asarray(size * away * away / (1.0 + np.sqrt(1.0 - part * part)))


def _cubic(t: FloatArray, p: FloatArray) -> FloatArray:
    """Give the deviation of a curvature that grows from nil at p[0]."""
    size = np.exp(min(max(float(p[1]), -30.0), 30.0))
    return np.asarray(size * np.maximum(t - p[0], 0.0) ** 3)


def _quartic(t: FloatArray, p: FloatArray) -> FloatArray:
    """Give the deviation of a curvature that grows as a square from nil at p[0]."""
    size = np.exp(min(max(float(p[1]), -30.0), 30.0))
    return np.asarray(size * np.maximum(t - p[0], 0.0) ** 4)


_Shape = Callable[[FloatArray, FloatArray], FloatArray]


def _fit(
    t: FloatArray, u: FloatArray, first: tuple[float, float], shape: _Shape
) -> tuple[float, float, float, float, float]:
    """Give zero, radius, squared residual, deviation of zero per unit noise, and reach."""
    zero, slope = first
    if shape is _arc:
        size = 2.0 * slope * slope
    else:
        away = max(float(t[-1]) - zero, 1e-3)
        zero -= 0.3 * away
        zero -= 0.3 * away * (shape is _quartic)
        power = 4 if shape is _quartic else 3
        size = max(float(u[-1]), 1e-9) / (float(t[-1]) - zero) ** power
    p = np.array([zero, np.log(max(size, 1e-9))])
    off, damping = shape(t, p) - u, 1e-3
    cost = float(off @ off)
    slopes = _slopes(t, p, shape)
    for _ in range(40):
        normal = slopes.T @ slopes
        step = np.linalg.solve(normal + np.diag(damping * normal.diagonal() + 1e-18),
                               -(slopes.T @ off))  # fmt: skip
        trial = p + np.clip(step, -1.0, 1.0)
        new = shape(t, trial) - u
        less = float(new @ new)
        if less > cost:
            damping *= 8.0
            if damping > 1e8:
                break
            continue
        done = cost - less < 1e-9 * cost + 1e-24
        p, off, cost, damping = trial, new, less, max(damping / 8.0, 1e-9)
        slopes = _slopes(t, p, shape)
        if done:
            break
    normal = slopes.T @ slopes
    determinant = float(normal[0, 0] * normal[1, 1] - normal[0, 1] ** 2)
    spread = float(np.sqrt(normal[1, 1] / determinant)) if determinant > 0.0 else np.inf
    return float(p[0]), float(np.exp(-p[1])), cost, spread, float(t[-1] - t[0])


def _slopes(t: FloatArray, p: FloatArray, shape: _Shape) -> FloatArray:
    """Give the derivatives of a shape to its zero and to the logarithm of its size."""
    h = 1e-5
    columns = [(shape(t, p + h * unit) - shape(t, p - h * unit)) / (2.0 * h) for unit in np.eye(2)]
    return np.column_stack(columns)

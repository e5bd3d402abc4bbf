"""Straight runs of plane polylines, and where a curve leaves them.

A run that ends in an arc of radius R leaves it by (s - s0)^2 / 2R: the square root of the deviation
is a straight line whose zero is the end of the run. Where the curvature grows from zero the
deviation begins with a higher power, and no such place can be given; then only the stretch is given
in which the end must lie. `fit_onset` is used for the ends of circular arcs, too. All is in m.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.polylines.operations import cumulative_lengths

__all__ = [
    "FittedOnset",
    "Onset",
    "StraightRun",
    "StraightRunRule",
    "find_straight_runs",
    "fit_onset",
]

# --------------------------------------------------------------------------------------
# Where a curve leaves a straight line.
#
# Two shapes are fitted to the deviation u: an arc that begins at t0, and a curvature that grows
# from zero, u = c (t - t0)^3. The arc is taken where it fits plainly better. Else there is no
# place: what is given lies between where the two begin, with an uncertainty that reaches from where
# the arc begins to where u = c (t - t0)^4 does.


@attrs.frozen
class FittedOnset:
    """Where a curve leaves a line.

    Attributes
    ----------
    zero : float, m
        Along the line.
    radius : float or None, m
        Of the arc; None where the curvature grows from zero.
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

    `t` lies along the line of the run, `u` off it to the side of the curve, (n,), m. `last` is the
    last point within the tolerance `within`; `noise` is the scatter of the points. `confidence` is
    that of `StraightRunRule`.
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
    """Give zero and slope of a straight line through sqrt(u) where u is plainly above zero."""
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
    """Give the deviation of a curvature that grows from zero at p[0]."""
    size = np.exp(min(max(float(p[1]), -30.0), 30.0))
    return np.asarray(size * np.maximum(t - p[0], 0.0) ** 3)


def _quartic(t: FloatArray, p: FloatArray) -> FloatArray:
    """Give the deviation of a curvature that grows as a square from zero at p[0]."""
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


# --------------------------------------------------------------------------------------
# Straight runs.

OnsetKind = Literal["arc", "gradual", "end", "border"]


@attrs.frozen
class StraightRunRule:
    """What counts as a straight run.

    Attributes
    ----------
    within : float, m
        Points of a run lie this close to its line, or within `scatters` times the noise.
    scatters : float
        See `within`.
    least : float, m
        Least length.
    least_part : float
        Least length as a part of the length of the polyline.
    growth : float
        A run may grow by less than this part of its length when `within` is quadrupled.
    confidence : float
        How much better (in the squared residual over the noise squared) one shape of the
        beginning curve must fit than the other to be taken.
    """

    within: float = 1e-3
    scatters: float = 3.0
    least: float = 1.0
    least_part: float = 0.03
    growth: float = 0.3
    confidence: float = 6.0


@attrs.frozen(eq=False)
class Onset:
    """How a straight run ends.

    Attributes
    ----------
    kind : {"arc", "gradual", "end", "border"}
        In an arc; with a curvature that grows from zero; with the polyline; or without a radius
        of its own, at a place taken from the border of a flat.
    at : float, m
        Length along the polyline, of a gradual one the likeliest.
    place : (2,), m
        The tangent point on the line of the run; nan for a gradual onset.
    radius : float, m
        Of the arc, nan if there is none.
    uncertainty : float, m
        Standard deviation of `at` for an arc; for a gradual onset the farthest that it may lie
        off, whether the curvature grows at once or as slowly as a square.
    """

    kind: OnsetKind
    at: float
    place: FloatArray
    radius: float
    uncertainty: float

    def __attrs_post_init__(self) -> None:
        freeze(self.place)


@attrs.frozen(eq=False)
class StraightRun:
    """A straight run.

    Attributes
    ----------
    begin, end : float, m
        Lengths along the polyline.
    origin, direction : (2,)
        A place (m) on its line, and the unit direction along the polyline.
    residual : float, m
        Root of the mean squared distance of its points from the line.
    growth : float
        By which part it grows when the tolerance is quadrupled.
    before, after : Onset
        How it begins and ends.
    """

    begin: float
    end: float
    origin: FloatArray
    direction: FloatArray
    residual: float
    growth: float
    before: Onset
    after: Onset

    def __attrs_post_init__(self) -> None:
        freeze(self.origin, self.direction)


def find_straight_runs(
    points: FloatArray, noise: float, rule: StraightRunRule | None = None
) -> list[StraightRun]:
    """Find the straight runs of a polyline (n, 2), m, in order along it.

    Corners must not be among the inner points; `noise` (m) is the scatter of the points.
    """
    wanted = rule or StraightRunRule()
    at = cumulative_lengths(points)
    least = max(wanted.least, wanted.least_part * float(at[-1]))
    within = max(wanted.within, wanted.scatters * noise)
    found: list[StraightRun] = []
    for seed in _seeds(points, at, least, within):
        if any(run.begin < at[seed[0]] + 0.3 * least and at[seed[1]] - 0.3 * least < run.end
               for run in found):  # fmt: skip
            continue
        run = _run(points, at, seed, least, within, noise, wanted)
        if run is not None and all(run.begin > each.end - 1e-9 or run.end < each.begin + 1e-9
                                   for each in found):  # fmt: skip
            found.append(run)
    return sorted(found, key=lambda run: run.begin)


def _seeds(
    points: FloatArray, at: FloatArray, least: float, within: float
) -> list[tuple[int, int]]:
    """Give (first, last) of windows that may lie in a run, the straightest first."""
    starts = np.arange(0.0, max(float(at[-1]) - 0.8 * least, 0.0) + 1e-9, 0.2 * least)
    first = np.searchsorted(at, starts - 1e-9)
    last = np.searchsorted(at, starts + 0.8 * least + 1e-9, "right") - 1
    good = last - first >= 3
    pairs = np.unique(np.column_stack([first, last])[good], axis=0)
    scored: list[tuple[float, int, int]] = []
    for i, j in pairs.tolist():
        _, _, off = _fit_line(points[i : j + 1])
        worst = float(np.abs(off).max())
        if worst <= within:
            scored.append((worst, i, j))
    return [(i, j) for _, i, j in sorted(scored)]


def _fit_line(points: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give a place, the unit direction and the signed distances of a fitted line."""
    origin = points.sum(axis=0) / len(points)
    local = points - origin
    x, y = local[:, 0], local[:, 1]
    sxx, syy, sxy = (x * x).sum(), (y * y).sum(), (x * y).sum()
    angle = 0.5 * np.arctan2(2.0 * sxy, sxx - syy)
    ahead = np.array([np.cos(angle), np.sin(angle)])
    if ahead @ (points[-1] - points[0]) < 0.0:
        ahead = -ahead
    return origin, ahead, local @ np.array([-ahead[1], ahead[0]])


def _grow(off: FloatArray, first: int, last: int, within: float) -> tuple[int, int]:
    """Give the ends of the stretch around a seed whose points all lie within a tolerance."""
    out = np.ones(len(off) + 2, bool)
    np.greater(np.abs(off), within, out=out[1:-1])
    # A single wild point does not end a run.
    far = np.flatnonzero(out[1:-1] & (out[:-2] | out[2:]))
    before, after = far[far < first], far[far > last]
    return (int(before[-1]) + 1 if len(before) else 0,
            int(after[0]) - 1 if len(after) else len(off) - 1)  # fmt: skip


def _distances(points: FloatArray, origin: FloatArray, ahead: FloatArray) -> FloatArray:
    return np.asarray((points - origin) @ np.array([-ahead[1], ahead[0]]))


def _run(
    points: FloatArray,
    at: FloatArray,
    seed: tuple[int, int],
    least: float,
    within: float,
    noise: float,
    rule: StraightRunRule,
) -> StraightRun | None:
    first, last = seed
    for _ in range(4):
        origin, ahead, _ = _fit_line(points[first : last + 1])
        off = _distances(points, origin, ahead)
        grown = _grow(off, (first + last) // 2, (first + last) // 2, within)
        if grown[1] - grown[0] < 3:
            return None
        if grown == (first, last):
            break
        first, last = grown
    length = float(at[last] - at[first])
    wide = _grow(off, first, last, 4.0 * within)
    growth = float(at[wide[1]] - at[wide[0]]) / max(length, 1e-12) - 1.0
    if length < least or growth >= rule.growth or last - first < 4:
        return None
    # The line is fitted again without its ends, which an arc may have drawn aside already.
    margin = 0.1 * length
    core = (at >= at[first] + margin) & (at <= at[last] - margin)
    if core.sum() >= 4:
        origin, ahead, _ = _fit_line(points[core])
        if _bends((points[core] - origin) @ ahead, _distances(points[core], origin, ahead), noise):
            return None
        off = _distances(points, origin, ahead)
        tight, loose = (_grow(off, first + 2, last - 2, size * within) for size in (1.0, 4.0))
        ratio = (at[loose[1]] - at[loose[0]]) / max(float(at[tight[1]] - at[tight[0]]), 1e-12)
        growth = max(growth, float(ratio) - 1.0)
        if growth >= rule.growth:
            return None
    along = (points - origin) @ ahead
    residual = float(np.sqrt((off[first : last + 1] ** 2).mean()))
    scale = max(noise, 0.3 * residual, 1e-6)
    after = _onset(along, off, at, last, within, scale, rule, origin, ahead)
    # The same run the other way: lengths change their sign, and what was first comes last.
    before = _onset(-along[::-1], off[::-1], -at[::-1], len(at) - 1 - first, within, scale, rule,
                    origin, -ahead)  # fmt: skip
    before = attrs.evolve(before, at=-before.at)
    begin = max(before.at, 0.0)
    end = min(after.at, float(at[-1]))
    if end - begin < 0.8 * least:
        return None
    return StraightRun(begin, end, origin, ahead, residual, growth, before, after)


def _bends(t: FloatArray, u: FloatArray, noise: float) -> bool:
    """Say whether points bend by more than their scatter explains."""
    if len(t) < 6:
        return False
    middle, half = 0.5 * (t[0] + t[-1]), 0.5 * (t[-1] - t[0])
    if half <= 0.0:  # they come back to where they began
        return True
    quadratic = np.polyfit((t - middle) / half, u, 2)
    spread = max(noise, float(np.std(np.polyval(quadratic, (t - middle) / half) - u)))
    return bool(abs(quadratic[0]) > 4.0 * 3.4 * spread / np.sqrt(len(t)))


def _onset(
    along: FloatArray,
    off: FloatArray,
    at: FloatArray,
    last: int,
    within: float,
    noise: float,
    rule: StraightRunRule,
    origin: FloatArray,
    ahead: FloatArray,
) -> Onset:
    """Say how a run ends after point `last`, whose polyline goes on forward."""
    end = float(at[-1])
    beyond = len(at) - 1 - last
    if beyond < 4:
        return Onset("end", end if beyond < 2 else float(at[last]),
                     origin + ahead * along[-1 if beyond < 2 else last], np.nan, 0.0)  # fmt: skip
    sign = 1.0 if off[last + 1] > 0.0 else -1.0
    fitted = fit_onset(along, sign * off, last, within, noise, rule.confidence)
    zero = float(np.interp(fitted.zero, along, at)) if _rising(along) else float(
        at[last] + fitted.zero - along[last])  # fmt: skip
    if fitted.radius is None:
        return Onset("gradual", zero, np.full(2, np.nan), np.nan, fitted.uncertainty)
    place = origin + ahead * fitted.zero
    return Onset("arc", zero, place, fitted.radius, fitted.uncertainty)


def _rising(along: FloatArray) -> bool:
    return bool((np.diff(along) > 0.0).all())

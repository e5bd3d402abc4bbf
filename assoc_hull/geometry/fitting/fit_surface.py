"""A smooth surface through points of lines: solve, correct the parameters, refine the knots.

Each round solves for the control points and moves the parameters to the nearest places.
Spans whose points stay further off than the tolerance are halved; the fit goes on from there.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import not_negative, positive
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.fitting.basis import DEGREE, clamped_knots
from assoc_hull.geometry.fitting.fit_input import HeldControls, Samples
from assoc_hull.geometry.fitting.foot_points import STEPS, foot_points
from assoc_hull.geometry.fitting.least_squares import solve_controls
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = [
    "SurfaceFit",
    "checked_breaks",
    "even_breaks",
    "fit_refined",
    "fit_surface",
    "halve_spans",
    "solve_once",
    "spans_to_halve",
    "subdivide_bays",
]


_SHARE = 0.95
"""The part of the points of a span that must be within the tolerance."""

_NEAR = 1e-9
"""Spans shorter than this part of the domain are an error of the caller."""


def checked_breaks(values: FloatArray, name: str, where: str) -> FloatArray:
    """Take breaks, or say what is wrong with them.

    Raises
    ------
    BadInputError
        Fewer than two, not finite, falling, repeated more than three times within or at all at
        the ends, or so close that only rounding keeps them apart.
    """
    found = np.array(values, np.float64)
    if found.ndim != 1 or len(found) < 2 or not np.isfinite(found).all():
        raise BadInputError(f"{name} is of shape {found.shape}", where, "give two numbers or more")
    steps, room = np.diff(found), _NEAR * abs(found[-1] - found[0])
    if steps[0] <= 0.0 or steps[-1] <= 0.0 or ((steps != 0.0) & (steps < room)).any():
        least = float(steps.min())
        raise BadInputError(f"a span of {name} is {least:g} m long", where, "give rising places")
    if len(found) > 4 and (found[3:] == found[:-3]).any():
        raise BadInputError(f"{name} repeats a place four times", where, "repeat it three times")
    return found


def even_breaks(low: float, high: float, spans: int) -> FloatArray:
    """Give equal spans, (spans + 1,), m."""
    return np.linspace(low, high, spans + 1)


def subdivide_bays(places: FloatArray, parts: int | IntArray) -> FloatArray:
    """Divide each bay between rising places (b,), m, in equal parts, one number or (b - 1,).

    The places are among the breaks to the last bit.
    """
    counts = np.broadcast_to(np.asarray(parts, np.int64), len(places) - 1)
    bay = np.repeat(np.arange(len(counts)), counts)
    part = np.arange(len(bay)) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.append(places[bay] + part / counts[bay] * np.diff(places)[bay], places[-1])


def halve_spans(breaks: FloatArray, which: NDArray[np.bool_]) -> FloatArray:
    """Halve chosen spans (b - 1,) of breaks (b,); the others stay to the last bit."""
    return subdivide_bays(breaks, np.where(which & (np.diff(breaks) > 0.0), 2, 1))


def spans_to_halve(
    breaks: FloatArray, at: FloatArray, residual: FloatArray, tolerance: float
) -> NDArray[np.bool_]:
    """Say which spans (b - 1,) of breaks (b,), m, do not follow their points.

    That is where they have points in both halves and more than 5 % of the points, `residual` (k,) m
    off at parameters `at` (k,), are off by more than the tolerance, m.
    """
    count = len(breaks) - 1
    span = np.clip(np.searchsorted(breaks, at, "right") - 1, 0, count - 1)
    off = np.bincount(span, residual > tolerance, count)
    number = np.bincount(span, minlength=count)
    middle = 0.5 * (breaks[:-1] + breaks[1:])
    right = np.bincount(span, at > middle[span], count)
    spread = (right > 0) & (right < number)
    return np.asarray((off > (1.0 - _SHARE) * number) & spread)


# --------------------------------------------------------------------------------------
# The fit on given breaks.

ROUNDS = 4
"""How often a fit solves and then corrects the parameters."""

START = 30.0
STIFF = 2
"""In so many first rounds the penalty is `START` times as large."""


@attrs.frozen(eq=False)
class SurfaceFit:
    """A surface, and the points that it was fitted to.

    Attributes
    ----------
    surface : SplineSurface
        A bicubic B-spline.
    samples : Samples
        The points, with parameters of the places of the surface nearest to them.
    residual : (k,), m
        How far they lie from these.
    smoothing : float, m3
        The factor of the penalty.
    """

    surface: SplineSurface
    samples: Samples
    residual: FloatArray
    smoothing: float

    def __attrs_post_init__(self) -> None:
        freeze(self.residual)

    @property
    def spans(self) -> tuple[int, int]:
        """How many spans of knots there are in u and in v."""
        knots = self.surface.knots_u, self.surface.knots_v
        return len(np.unique(knots[0])) - 1, len(np.unique(knots[1])) - 1


def fit_surface(
    name: str,
    samples: Samples,
    breaks_u: FloatArray,
    breaks_v: FloatArray,
    smoothing: float,
    *,
    held: HeldControls | None = None,
    rounds: int = ROUNDS,
    start: float = START,
    stiff: int = STIFF,
) -> SurfaceFit:
    """Fit a bicubic B-spline to points of lines.

    Parameters
    ----------
    name : str
        What messages and tables call the surface.
    samples : Samples
        The points, with parameters to start from and weights.
    breaks_u, breaks_v : (b,), m
        Where spans meet, with both ends.
    smoothing : float, m3
        The factor of the penalty: as all parameters are lengths, it is a volume.
    held : HeldControls, optional
        Coordinates of control points that are given.
    rounds : int
        How often to solve and then to correct the parameters, at least once.
    start, stiff : float, int
        In the first `stiff` rounds, but not the last, the penalty is `start` times as large, so
        that bad parameters do not lock in.

    Returns
    -------
    SurfaceFit
        The surface and the corrected points; the same bits for the same bits given.

    Raises
    ------
    BadInputError
        Breaks that do not rise, parameters beyond them, a penalty below 0, or points
        that leave control points free.
    """
    where = f"in the fit of {name!r}"
    breaks = (
        checked_breaks(breaks_u, "breaks_u", where),
        checked_breaks(breaks_v, "breaks_v", where),
    )
    _check(samples, breaks, smoothing, where)
    factors = [start] * min(stiff, rounds - 1) + [1.0] * (rounds - min(stiff, rounds - 1))
    found = solve_once(name, samples, breaks, smoothing * factors[0], held)
    for factor in factors[1:]:
        found = solve_once(name, found.samples, breaks, smoothing * factor, held)
    return found


def _check(
    samples: Samples, breaks: tuple[FloatArray, FloatArray], smoothing: float, where: str
) -> None:
    """Refuse points that lie beyond the breaks, and a penalty that is none."""
    not_negative(smoothing, "smoothing", where)
    if not len(samples):
        raise BadInputError("there are no points", where, "give points of lines")
    for axis, each in enumerate(breaks):
        at = samples.uv[:, axis]
        bad = at[~((at >= each[0]) & (at <= each[-1]))]
        if len(bad):
            raise BadInputError(
                f"{'uv'[axis]} of a point is {bad[0]:g}",
                where, f"give parameters from {each[0]:g} to {each[-1]:g}",
            )  # fmt: skip


def solve_once(
    name: str,
    samples: Samples,
    breaks: tuple[FloatArray, FloatArray],
    smoothing: float,
    held: HeldControls | None = None,
    steps: int = STEPS,
) -> SurfaceFit:
    """Solve once with the parameters as they are, then correct them; see `fit_surface`.

    `breaks` are those of both parameters, `steps` those of the correction.
    """
    knots = clamped_knots(breaks[0]), clamped_knots(breaks[1])
    where = f"in the fit of {name!r}"
    net = solve_controls(samples, knots[0], knots[1], smoothing, held, where)
    surface = SplineSurface(name, (DEGREE, DEGREE), knots[0], knots[1], net)
    uv, away = foot_points(surface, samples.point, samples.uv, held=samples.held, steps=steps)
    return SurfaceFit(surface, attrs.evolve(samples, uv=uv), away, smoothing)


# --------------------------------------------------------------------------------------
# More knots where it does not follow its points.

PASSES = 4
"""How often spans are halved at most."""

Breaks = tuple[FloatArray, FloatArray]


def fit_refined(
    name: str,
    samples: Samples,
    breaks_u: FloatArray,
    breaks_v: FloatArray,
    smoothing: float,
    tolerance: float,
    *,
    held: Callable[[FloatArray, FloatArray], HeldControls] | None = None,
    rounds: int = ROUNDS,
    start: float = START,
    stiff: int = STIFF,
    passes: int = PASSES,
    enough: Callable[[SurfaceFit], bool] | None = None,
) -> SurfaceFit:
    """Fit, halve spans whose points stay further off than the tolerance, and fit again.

    Parameters
    ----------
    name, samples, breaks_u, breaks_v, smoothing, rounds, start, stiff
        As of `fit_surface`.
    tolerance : float, m
        What 95 % of the points of a span, right across the surface, may be off.
    held : callable, optional
        Gives what is held for breaks in u and in v.
    passes : int
        How often to halve at most: spans of u or spans of v, whichever leaves less beyond the
        tolerance. There are never more control points than points.
    enough : callable, optional
        Says whether a fit will do as it is: no spans are halved then.

    Returns
    -------
    SurfaceFit
        The last fit; some spans may still be off, as its residuals tell.

    Raises
    ------
    BadInputError
        As of `fit_surface`.
    """
    tolerance = positive(tolerance, "tolerance", f"in the fit of {name!r}")
    breaks = np.array(breaks_u, np.float64), np.array(breaks_v, np.float64)
    holding = held if held is not None else _nothing
    found = fit_surface(
        name, samples, *breaks, smoothing,
        held=holding(*breaks), rounds=rounds, start=start, stiff=stiff,
    )  # fmt: skip
    for _ in range(passes):
        if enough is not None and enough(found):
            break
        best = min(
            (
                (_excess(trial, tolerance), axis, finer, trial)
                for axis in (0, 1)
                if (finer := _finer(found, breaks, tolerance, axis)) is not None
                for trial in [solve_once(name, found.samples, finer, smoothing, holding(*finer))]
            ),
            key=lambda each: each[:2],
            default=None,
        )
        if best is None:
            break
        _, _, breaks, found = best
        for _ in range(max(rounds // 2 - 1, 0)):
            found = solve_once(name, found.samples, breaks, smoothing, holding(*breaks))
    return found


def _nothing(breaks_u: FloatArray, breaks_v: FloatArray) -> None:
    """Hold nothing."""


def _excess(found: SurfaceFit, tolerance: float) -> float:
    """Give by how much points are off beyond the tolerance, times the lengths they stand for."""
    return float((found.samples.weight * np.maximum(found.residual - tolerance, 0.0)).sum())


def _finer(found: SurfaceFit, breaks: Breaks, tolerance: float, axis: int) -> Breaks | None:
    """Halve spans of one parameter that do not follow; None if none is, or points are too few."""
    at = found.samples.uv[:, axis]
    which = spans_to_halve(breaks[axis], at, found.residual, tolerance)
    both = list(breaks)
    both[axis] = halve_spans(breaks[axis], which)
    count = (len(both[0]) + DEGREE - 1) * (len(both[1]) + DEGREE - 1)
    return (both[0], both[1]) if which.any() and count <= len(found.samples) else None

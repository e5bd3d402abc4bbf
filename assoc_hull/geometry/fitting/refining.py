"""More knots where a fitted surface does not follow its points.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.fitting.breaks import even
>>> from assoc_hull.geometry.fitting.refining import fit_refined
>>> from assoc_hull.geometry.fitting.samples import Samples
>>> x, y = (each.ravel() for each in np.meshgrid(np.linspace(0, 8, 81), np.linspace(0, 2, 9)))
>>> wave = np.where(x > 6, 0.3 * np.sin(1.5 * (x - 6)) ** 3, 0.0)
>>> samples = Samples.of(np.column_stack([x, y]), np.column_stack([x, y, wave]))
>>> found = fit_refined("wave", samples, even(0, 8, 4), even(0, 2, 1), 1e-9, 0.01)
>>> found.spans[0] > 6, bool(np.percentile(found.residual, 95) < 0.01)
(True, True)
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from assoc_hull.arguments import positive
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.basis import DEGREE
from assoc_hull.geometry.fitting.breaks import halved, to_halve
from assoc_hull.geometry.fitting.fit import ROUNDS, START, STIFF, Fit, fit_surface, solved
from assoc_hull.geometry.fitting.held_controls import HeldControls
from assoc_hull.geometry.fitting.samples import Samples

__all__ = ["fit_refined"]

PASSES = 4

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
    enough: Callable[[Fit], bool] | None = None,
) -> Fit:
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
    Fit
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
                for trial in [solved(name, found.samples, finer, smoothing, holding(*finer))]
            ),
            key=lambda each: each[:2],
            default=None,
        )
        if best is None:
            break
        _, _, breaks, found = best
        for _ in range(max(rounds // 2 - 1, 0)):
            found = solved(name, found.samples, breaks, smoothing, holding(*breaks))
    return found


def _nothing(breaks_u: FloatArray, breaks_v: FloatArray) -> None:
    """Hold nothing."""


def _excess(found: Fit, tolerance: float) -> float:
    """Give by how much points are off beyond the tolerance, times the lengths they stand for."""
    return float((found.samples.weight * np.maximum(found.residual - tolerance, 0.0)).sum())


def _finer(found: Fit, breaks: Breaks, tolerance: float, axis: int) -> Breaks | None:
    """Halve spans of one parameter that do not follow; None if none is, or points are too few."""
    at = found.samples.uv[:, axis]
    which = to_halve(breaks[axis], at, found.residual, tolerance)
    both = list(breaks)
    both[axis] = halved(breaks[axis], which)
    count = (len(both[0]) + DEGREE - 1) * (len(both[1]) + DEGREE - 1)
    return (both[0], both[1]) if which.any() and count <= len(found.samples) else None

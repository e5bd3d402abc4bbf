"""More knots where a fitted surface does not follow its points.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.fitting.breaks import even
>>> from assoc_hull.geometry.fitting.refining import fit_refined
>>> from assoc_hull.geometry.fitting.samples import Samples
>>> x, y = (each.ravel() for each in np.meshgrid(np.linspace(0, 8, 81), np.linspace(0, 2, 9)))
>>> wave = np.where(x > 6, np.sin(3 * (x - 6)) ** 3, 0.0)
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
        How often to halve at most. There are never more control points than points.

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
    found = fit_surface(
        name, samples, *breaks, smoothing,
        held=held(*breaks) if held else None, rounds=rounds, start=start, stiff=stiff,
    )  # fmt: skip
    for _ in range(passes):
        finer = _finer(found, breaks, tolerance)
        if finer is None:
            break
        breaks = finer
        holds = held(*breaks) if held else None
        for _ in range(max(rounds // 2, 1)):
            found = solved(name, found.samples, breaks, smoothing, holds)
    return found


def _finer(found: Fit, breaks: Breaks, tolerance: float) -> Breaks | None:
    """Halve spans that do not follow; None if there are none, or points are too few."""
    both = [
        halved(each, to_halve(each, found.samples.uv[:, axis], found.residual, tolerance))
        for axis, each in enumerate(breaks)
    ]
    counts = [len(each) + DEGREE - 1 for each in both]
    same = all(len(new) == len(old) for new, old in zip(both, breaks, strict=True))
    return None if same or counts[0] * counts[1] > len(found.samples) else (both[0], both[1])

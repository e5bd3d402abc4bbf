"""Second derivatives of misses, learnt from the exact first ones on the way.

Each miss has a symmetric matrix B_i that follows the change y_i of its gradient over a step s by
the least change of itself (Powell 1970, "A new algorithm for unconstrained optimization": the
symmetric form of Broyden's rule),

    B_i <- B_i + (e s' + s e') / s's - (e's) s s' / (s's)^2        e = y_i - B_i s
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["no_curvature", "updated_curvature"]

_SHORT = 1e-7
"""A shorter scaled step tells nothing: the change of gradients is rounding."""


def no_curvature(targets: int, free: int) -> FloatArray:
    """Give what is known before a step, (m, k, k)."""
    return np.zeros((targets, free, free))


def updated_curvature(curvature: FloatArray, step: FloatArray, change: FloatArray) -> FloatArray:
    """Give the matrices after a step.

    Parameters
    ----------
    curvature : (m, k, k) float
        Before.
    step : (k,) float
        Scaled changes.
    change : (m, k) float
        Of the gradients of the misses.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.aiming.broyden_update import no_curvature, updated_curvature
    >>> step = np.array([0.5, 0.0])
    >>> updated_curvature(no_curvature(1, 2), step, np.array([[1.0, 0.25]])).tolist()
    [[[2.0, 0.5], [0.5, 0.0]]]
    """
    square = float(step @ step)
    if square < _SHORT**2:
        return curvature
    error = change - curvature @ step
    half = error[:, :, None] * step / square
    along = (error @ step / square**2)[:, None, None]
    found: FloatArray = curvature + half + half.transpose(0, 2, 1) - along * np.outer(step, step)
    return found

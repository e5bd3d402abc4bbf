"""What holds a change where it is: the conditions of Karush, Kuhn and Tucker."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.aiming.quadratic_program import split
from assoc_hull.variation.aiming.scaled_problem import Iterate

__all__ = ["multipliers", "release_slope", "unbalanced"]


def unbalanced(place: Iterate) -> float:
    """Tell by how much a change is not the least one with these misses.

    It is the size of what is left of mu beside the gradients of misses and of bounds that hold it:
    the residual of the conditions of Karush, Kuhn and Tucker.
    """
    _, null = split(place.jacobian)
    return float(np.linalg.norm(null.T @ _pull(place)))


def release_slope(place: Iterate) -> float:
    """Give the slope of half the squared misses along which bounds let go."""
    slope = place.jacobian.T @ place.misses
    return float(np.linalg.norm(np.where(place.shut, 0.0, slope)))


def _pull(place: Iterate) -> FloatArray:
    """Give mu without what bounds take up of it best: they push inward only, (k,)."""
    from scipy.optimize import nnls

    _, null = split(place.jacobian)
    unit = np.eye(len(place.changes))
    walls = np.concatenate([unit[place.at_high], -unit[place.at_low]])
    if not len(walls) or not null.shape[1]:
        return place.changes
    forces, _ = nnls(null.T @ walls.T, -(null.T @ place.changes))
    found: FloatArray = place.changes + forces @ walls
    return found


def multipliers(place: Iterate) -> FloatArray:
    """Give the multipliers of the equations that balance mu best, (m,)."""
    inverse, _ = split(place.jacobian)
    found: FloatArray = -inverse.T @ _pull(place)
    return found

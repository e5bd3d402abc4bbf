"""Integrals over stations from values at them.

`integrate_by_simpson` is Simpson's rule in runs of equal spacing, as published tables of section
areas were made with it: it is here to reproduce such tables.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "checked_stations",
    "integrate_by_simpson",
    "simpson_weights",
]


def checked_stations(x: ArrayLike, values: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Take positions of stations and their values, ascending, with one value each."""
    place, value = np.asarray(x, np.float64), np.asarray(values, np.float64)
    if place.ndim != 1 or len(place) < 2 or value.shape[:1] != place.shape:
        raise BadInputError(
            f"stations of shape {place.shape} with values of shape {value.shape}",
            "in an integral over stations",
            "give two stations or more, with one value each",
        )
    if not (np.isfinite(value).all() and np.isfinite(place).all() and (np.diff(place) > 0).all()):
        raise BadInputError(
            "positions that do not ascend, or numbers that are not finite",
            "in an integral over stations",
            "sort the stations and leave out repeated ones",
        )
    return place, value


_EQUAL = 1e-6
"""Steps that differ by this part are equal: tables print few digits."""


def integrate_by_simpson(x: ArrayLike, values: ArrayLike) -> FloatArray:
    """Integrate over stations by Simpson's rule, in runs of equal spacing.

    Parameters
    ----------
    x : (n,), m
        Positions of the stations, ascending; each run of equal steps has an even number of them.
    values : (n, ...)
        Values at the stations.

    Returns
    -------
    (...)
        The integrals, in the unit of the values times m.

    Raises
    ------
    BadInputError
        Stations that do not ascend, not one value each, or a run with an odd number of steps.

    Examples
    --------
    >>> from assoc_hull.geometry.integrals.stations import integrate_by_simpson
    >>> round(float(integrate_by_simpson([0, 1, 2, 4, 6], [0, 1, 8, 64, 216])), 9)  # x^3
    324.0
    """
    place, value = checked_stations(x, values)
    total: FloatArray = np.asarray(np.tensordot(simpson_weights(place), value, axes=1))
    freeze(total)
    return total


def simpson_weights(x: FloatArray) -> FloatArray:
    """Give the weight of each station in Simpson's rule, run by run, (n,) in m.

    Raises
    ------
    BadInputError
        A run of equal steps has an odd number of them: its ends are told.
    """
    step = np.diff(x)
    new = np.abs(np.diff(step)) > _EQUAL * np.minimum(step[1:], step[:-1])
    edge = np.concatenate([[0], np.flatnonzero(new) + 1, [len(step)]])
    odd = np.flatnonzero(np.diff(edge) % 2)
    if len(odd):
        begin, end = edge[odd[0]], edge[odd[0] + 1]
        raise BadInputError(
            f"{end - begin} equal step(s) from x = {x[begin]:.6g} to {x[end]:.6g} m",
            "in an integral by Simpson's rule",
            "give each run of equal steps an even number of them",
        )
    third = (x[2::2] - x[:-2:2]) / 6.0
    weights = np.zeros(len(x))
    weights[:-1:2] += third
    weights[1::2] += 4.0 * third
    weights[2::2] += third
    return weights

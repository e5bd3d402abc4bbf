"""Integrals over stations from values at them.

`integrate_stations` integrates the not-a-knot cubic spline through the values, at any spacing.
`integrate_by_simpson` is Simpson's rule in runs of equal spacing, as published tables of section
areas were made with it: it is here to reproduce such tables.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "checked_stations",
    "integrate_by_simpson",
    "integrate_stations",
    "simpson_weights",
]


def integrate_stations(x: ArrayLike, values: ArrayLike) -> FloatArray:
    """Integrate over stations: the integral of the C2 cubic spline through the values.

    The spline is the not-a-knot one, exact for cubics; the parabola through three stations
    and the straight line through two. The integral is linear in the values.

    Parameters
    ----------
    x : (n,), m
        Positions of the stations, ascending, n >= 2.
    values : (n, ...)
        Values at the stations.

    Returns
    -------
    (...)
        The integrals, in the unit of the values times m.

    Raises
    ------
    BadInputError
        Fewer than two stations, positions that do not ascend, numbers that are not finite,
        or not one value per station.

    Examples
    --------
    >>> from assoc_hull.geometry.integrals.stations import integrate_stations
    >>> float(integrate_stations([0, 1, 3, 4], [0, 1, 27, 64]))  # x^3
    64.0
    """
    place, value = checked_stations(x, values)
    rows = value.reshape(len(place), -1)
    step = np.diff(place)[:, None]
    slope = _spline_slopes(step[:, 0], rows)
    parts = step * (rows[:-1] + rows[1:]) / 2.0 + step**2 * (slope[:-1] - slope[1:]) / 12.0
    total: FloatArray = parts.sum(axis=0).reshape(value.shape[1:])
    freeze(total)
    return total


def checked_stations(x: ArrayLike, values: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Take positions of stations and their values, as `integrate_stations` does."""
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


def _spline_slopes(step: FloatArray, rows: FloatArray) -> FloatArray:
    """Give the slopes of the not-a-knot spline at its stations, (n, c)."""
    rise = np.diff(rows, axis=0) / step[:, None]
    if len(step) == 1:
        return np.concatenate([rise, rise])
    matrix, right = _interior_rows(step, rise)
    if len(step) == 2:
        # One parabola: the slope of a chord is the mean of the slopes at its ends.
        matrix[0, :2], matrix[-1, -2:] = 1.0, 1.0
        right[0], right[-1] = 2.0 * rise[0], 2.0 * rise[-1]
    else:
        # One cubic over the two outermost intervals: equal third derivatives.
        matrix[0, :3], right[0] = _joined(step[:2], rise[:2])
        matrix[-1, :-4:-1], right[-1] = _joined(step[:-3:-1], rise[:-3:-1])
    return np.asarray(np.linalg.solve(matrix, right), np.float64)


def _joined(step: FloatArray, rise: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the equation of two intervals that share one cubic: its row and right side."""
    near, far = 1.0 / step**2
    return np.array([near, near - far, -far]), 2.0 * (rise[0] * near - rise[1] * far)


def _interior_rows(step: FloatArray, rise: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the equations of equal second derivatives; the first and last row are zero."""
    count = len(step) + 1
    matrix, right = np.zeros((count, count)), np.zeros((count, rise.shape[1]))
    inner: IntArray = np.arange(1, count - 1)
    matrix[inner, inner - 1] = 1.0 / step[:-1]
    matrix[inner, inner] = 2.0 / step[:-1] + 2.0 / step[1:]
    matrix[inner, inner + 1] = 1.0 / step[1:]
    right[1:-1] = 3.0 * (rise[:-1] / step[:-1, None] + rise[1:] / step[1:, None])
    return matrix, right


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
        As for `integrate_stations`, and a run with an odd number of steps.

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

"""What looks wrong in a table of offsets: lone values, wild values, blanks, wrong units.

A wild value is found by releasing it: the value that makes the third divided differences
of its waterline least is compared with the printed one, likewise along its station. A
turn of the hull, such as the bilge, sticks out along one of the two; a wrong number along
both and to the same side. The worst is set to its released value and the search repeated,
so that one wrong number is reported once.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.offsets.doctor import wild_values
>>> x, z = np.linspace(0, 1, 11), np.linspace(0, 1, 9)
>>> y = 10 * (1 - x[:, None] ** 2) * (0.5 + z - z**2 / 2)
>>> y[4, 3] += 0.2
>>> [(i, j) for i, j, _ in wild_values(x, z, y, np.full(9, 0.0005))]
[(4, 3)]
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["lone_values", "released", "wild_values"]

_SCORE = 5.0
_MOST = 12
_NOISE = 3e-4


def released(place: FloatArray, value: FloatArray) -> FloatArray:
    """Give each value as its neighbours would have it.

    Parameters
    ----------
    place : (n,)
        Ascending.
    value : (n,)
        Finite.

    Returns
    -------
    (n,)
        Value that makes the sum of squared third differences least, all others held; nan
        for the first and the last, and where n < 5.
    """
    count = len(place)
    out = np.full(count, np.nan)
    if count < 5:
        return out
    window = np.arange(count - 3)[:, None] + np.arange(4)
    u = place[window]
    gap = u[:, :, None] - u[:, None, :] + np.eye(4)
    weight = 6.0 * ((u[:, -1] - u[:, 0]) / 3.0)[:, None] ** 3 / np.prod(gap, axis=2)
    rows = np.zeros((count - 3, count))
    np.put_along_axis(rows, window, weight, axis=1)
    out[:] = value - (rows.T @ (rows @ value)) / np.sum(rows**2, axis=0)
    out[[0, -1]] = np.nan
    return out


def _both(x: FloatArray, z: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    along_x, along_z = np.full(y.shape, np.nan), np.full(y.shape, np.nan)
    for j in range(len(z)):
        known = np.isfinite(y[:, j])
        along_x[known, j] = y[known, j] - released(x[known], y[known, j])
    for i in range(len(x)):
        known = np.isfinite(y[i])
        along_z[i, known] = y[i, known] - released(z[known], y[i, known])
    return along_x, along_z


def wild_values(
    x: FloatArray, z: FloatArray, y: FloatArray, rounding: FloatArray
) -> tuple[tuple[int, int, float], ...]:
    """Find values far off what their neighbours along station and waterline say.

    Parameters
    ----------
    x : (s,), m
        Stations, ascending.
    z : (w,), m
        Waterlines, ascending.
    y : (s, w), m
        Half-breadths, nan for blanks. The first and the last of a line are not judged.
    rounding : (w,), m
        Half unit of the last printed digit.

    Returns
    -------
    tuple of (station index, waterline index, released value in m)
        The worst first, 12 at most.
    """
    y = y.copy()
    noise = np.maximum(rounding, _NOISE * np.nanmax(y, initial=0.0))
    found: list[tuple[int, int, float]] = []
    while len(found) < _MOST:
        along_x, along_z = _both(x, z, y)
        agree = along_x * along_z > 0
        off = np.where(agree, np.minimum(np.abs(along_x), np.abs(along_z)), 0.0)
        off[~np.isfinite(along_x * along_z)] = np.nan
        i, j, score = _worst(off, noise)
        if score < _SCORE:
            break
        better = float(y[i, j] - min(along_x[i, j], along_z[i, j], key=abs))
        found.append((i, j, better))
        y[i, j] = better
    return tuple(found)


def _worst(off: FloatArray, noise: FloatArray) -> tuple[int, int, float]:
    best = (0, 0, 0.0)
    for i, j in zip(*np.nonzero(np.nan_to_num(off) > 3.0 * noise), strict=True):
        near = off[max(i - 2, 0) : i + 3, max(j - 2, 0) : j + 3].copy()
        near[min(i, 2), min(j, 2)] = np.nan
        known = near[np.isfinite(near)]
        usual = float(np.percentile(known, 80)) if len(known) else 0.0
        score = float(off[i, j] / (3.0 * noise[j] + usual))
        best = max(best, (int(i), int(j), score), key=lambda item: item[2])
    return best


def lone_values(y: FloatArray) -> tuple[tuple[int, int], ...]:
    """Find values above 0 whose neighbours above and below in the same station are 0.

    Parameters
    ----------
    y : (s, w), m
        Half-breadths, nan for blanks.

    Returns
    -------
    tuple of (station index, waterline index)
    """
    middle = (y[:, 1:-1] > 0) & (y[:, :-2] == 0) & (y[:, 2:] == 0)
    return tuple((int(i), int(j) + 1) for i, j in zip(*np.nonzero(middle), strict=True))

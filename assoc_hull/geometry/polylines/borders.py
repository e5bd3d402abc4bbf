"""A border from places found one by one: put in order, and a smooth curve within their doubt.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.borders import fit_border, order_places
>>> x = np.array([0.0, 4.0, 1.0, 3.0, 2.0])
>>> places = np.column_stack([x, 0.1 * x * x])
>>> order = order_places(places, np.full(5, 0.01), [0, 2, 4])
>>> order
[0, 2, 4, 3, 1]
>>> curve = fit_border(places[order], np.full(5, 0.01))
>>> bool(np.abs(curve[:, 1] - 0.1 * curve[:, 0] ** 2).max() < 0.02)
True
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import cumulative_lengths

__all__ = ["border_bends", "fit_border", "order_places"]


def order_places(places: FloatArray, doubt: FloatArray, first: Sequence[int]) -> list[int]:
    """Put places of one border in order along it.

    Those left out lie on the border within their doubt and tell nothing new.

    Parameters
    ----------
    places : (n, d), m
        Where lines showed it.
    doubt : (n,), m
        How far each may lie off the border.
    first : sequence of int
        Places whose order is known, two or more: the others are put in between and at the ends,
        the surest first, where they lengthen the way least.

    Returns
    -------
    list of int
        Numbers of the places along the border.
    """
    path = list(first)
    rest = [i for i in np.argsort(doubt, kind="stable").tolist() if i not in set(first)]
    for i in rest:
        before, after = places[path[:-1]], places[path[1:]]
        step = after - before
        part = ((places[i] - before) * step).sum(axis=1) / (step * step).sum(axis=1)
        foot = before + np.clip(part, 0.0, 1.0)[:, None] * step
        away = np.sqrt(((foot - places[i]) ** 2).sum(axis=1))
        inside = (part > 0.0) & (part < 1.0)
        if inside.any() and away[inside].min() <= doubt[i]:
            path.insert(int(np.argmin(np.where(inside, away, np.inf))) + 1, i)
            continue
        ends = np.sqrt(((places[i] - places[[path[0], path[-1]]]) ** 2).sum(axis=1))
        if ends.min() <= doubt[i]:
            continue
        path.insert(_cheapest(places, path, i, ends), i)
    return path


def _cheapest(places: FloatArray, path: list[int], i: int, ends: FloatArray) -> int:
    """Give where a place lengthens the way least."""
    to = np.sqrt(((places[path] - places[i]) ** 2).sum(axis=1))
    between = np.sqrt((np.diff(places[path], axis=0) ** 2).sum(axis=1))
    cost = np.concatenate([ends[:1], to[1:] + to[:-1] - between, ends[1:]])
    return int(np.argmin(cost))


def border_bends(places: FloatArray, doubt: FloatArray, least_deg: float) -> list[int]:
    """Give the inner places at which a border turns by more than `least_deg`, surely.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.borders import border_bends
    >>> border_bends(np.array([[0.0, 0], [5, 0], [9, 0], [9, 5]]), np.full(4, 0.01), 40.0)
    [2]
    """
    if len(places) < 3:
        return []
    step = np.diff(places, axis=0)
    length = np.sqrt((step * step).sum(axis=1))
    unit = step / length[:, None]
    turn = np.arccos(np.clip((unit[1:] * unit[:-1]).sum(axis=1), -1.0, 1.0))
    shorter = np.minimum(length[1:], length[:-1])
    unsure = 2.0 * (doubt[1:-1] + np.maximum(doubt[2:], doubt[:-2])) / shorter
    return [int(i) + 1 for i in np.flatnonzero(turn > np.deg2rad(least_deg) + unsure)]


def fit_border(places: FloatArray, doubt: FloatArray, corners: Sequence[int] = ()) -> FloatArray:
    """Give the smoothest curve within the doubt of its places, as a place for each, (n, d), m.

    Parameters
    ----------
    places : (n, d), m
        In order; both ends and the corners are kept.
    doubt : (n,), m
        How far the curve may pass 49 of 50 of them, and half of how far any, if that can be had.
    corners : sequence of int
        Inner places at which it may turn.
    """
    out = places.copy()
    for low, high in pairwise([0, *corners, len(places) - 1]):
        if high - low > 2:
            out[low : high + 1] = _fit(places[low : high + 1], doubt[low : high + 1])
    return out


def _fit(places: FloatArray, doubt: FloatArray) -> FloatArray:
    from assoc_hull.geometry.polylines.smoothing import PenalisedFit

    at = cumulative_lengths(places)
    fit = PenalisedFit(at, places, doubt, at)
    control = fit.solve(fit.largest())
    out, slope = np.asarray(fit.basis @ control), np.asarray(fit.slope @ control)
    # The fit may pass a place a little earlier or later: its nearest point is what is wanted.
    along = ((places - out) * slope).sum(axis=1) / (slope * slope).sum(axis=1)
    out = out + along[:, None] * slope
    out[[0, -1]] = places[[0, -1]]
    return np.asarray(out)

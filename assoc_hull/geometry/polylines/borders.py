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

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import cumulative_lengths
from assoc_hull.geometry.polylines.smoothing import PenalisedFit

__all__ = ["border_bends", "fit_border", "order_places"]

_VAGUE = 0.25
"""A place whose doubt is more than this part of its distance says little of a direction."""

_HOOK = np.cos(np.deg2rad(25.0))
"""A border that turns by more at its last place but one (cosine of 25 degrees) ends in a hook."""


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
    found = []
    for i in range(1, len(places) - 1):
        before, after = _neighbour(places, doubt, i, -1), _neighbour(places, doubt, i, 1)
        steps = np.stack([places[i] - places[before], places[after] - places[i]])
        length = np.sqrt((steps * steps).sum(axis=1))
        cosine = float((steps[0] @ steps[1]) / (length[0] * length[1]))
        turn = float(np.arccos(np.clip(cosine, -1.0, 1.0)))
        unsure = 2.0 * float(doubt[i] + max(doubt[before], doubt[after])) / float(length.min())
        if turn > np.deg2rad(least_deg) + unsure:
            found.append(i)
    return found


def _neighbour(places: FloatArray, doubt: FloatArray, i: int, way: int) -> int:
    """Give the place next to another that tells in which direction the border runs there.

    One that may lie anywhere beside it is passed over for the next, if that is surer.
    """
    near, far = i + way, i + 2 * way
    if not 0 <= far < len(places):
        return near
    step = float(np.sqrt(((places[near] - places[i]) ** 2).sum()))
    vague = doubt[near] > _VAGUE * step and doubt[far] < doubt[near]
    return far if vague else near


def fit_border(
    places: FloatArray, doubt: FloatArray, corners: Sequence[int] = (), apart: float = 0.0
) -> FloatArray:
    """Give the smoothest curve within the doubt of its places, as a place for each, (n, d), m.

    Parameters
    ----------
    places : (n, d), m
        In order; the corners are kept, and so is an end, unless its doubt is a good part of its
        distance from the next place and it would be a hook.
    doubt : (n,), m
        How far the curve may pass 49 of 50 of them, and half of how far any, if that can be had.
        A place that the curve through all others misses by more, and that alone makes it far less
        smooth, is less sure than it says: its doubt counts as what it is missed by.
    corners : sequence of int
        Inner places at which it may turn.
    apart : float, m
        Places nearer to one another count as one: no curve of a net can go through both.
    """
    out = places.copy()
    for low, high in pairwise([0, *corners, len(places) - 1]):
        if high - low > 2:
            out[low : high + 1] = _fit(places[low : high + 1], doubt[low : high + 1], apart)
    for end, way in ((0, 1), (len(places) - 1, -1)):
        if len(places) > 3 and end + way not in corners:
            out[end] = _led_on(out[[end + 2 * way, end + way]], places[end], float(doubt[end]))
    return out


def _led_on(course: FloatArray, place: FloatArray, doubt: float) -> FloatArray:
    """Give the end of a border, beyond the two places before it: its mark, unless that is vague.

    A vague one must not make a hook of the border: it is moved to where that goes straight on, or
    as near to there as its doubt allows. By less, borders of flats bend to their tips themselves.
    """
    before, last = course
    step = float(np.sqrt(((place - last) ** 2).sum()))
    ahead = (last - before) / float(np.sqrt(((last - before) ** 2).sum()))
    if doubt <= _VAGUE * step or float((place - last) @ ahead) >= _HOOK * step:
        return place
    straight = last + ahead * max(float((place - last) @ ahead), 0.0)
    off = straight - place
    size = float(np.sqrt(off @ off))
    return np.asarray(place + off * min(1.0, doubt / max(size, 1e-300)))


_SMOOTHER = 3.0
"""Without an outlier the penalty on change of curvature may be so many times as large."""

_OUTLIERS = 0.25
"""At most this part of the places are outliers."""

_TRIED = 4
"""So many of the places that are passed farthest off are tried for the next outlier."""


def _fit(places: FloatArray, doubt: FloatArray, apart: float) -> FloatArray:
    number = _grouped(places, apart)
    data, near = _means(places, doubt, number)
    if len(data) < 4:
        return places.copy()
    fit, control = _robust(data, near)
    out = np.asarray(fit.basis @ control)[number]
    slope = np.asarray(fit.slope @ control)[number]
    # The fit may pass a place a little earlier or later: its nearest point is what is wanted.
    along = ((places - out) * slope).sum(axis=1) / (slope * slope).sum(axis=1)
    out = out + along[:, None] * slope
    out[[0, -1]] = places[[0, -1]]
    return np.asarray(out)


def _grouped(places: FloatArray, apart: float) -> IntArray:
    """Give each place in order a number, the same to those within `apart` (m) of their first.

    Both ends stay alone.
    """
    number = np.zeros(len(places), np.int64)
    first, last = 0, len(places) - 1
    for i in range(1, last + 1):
        near = float(np.linalg.norm(places[i] - places[first])) < apart
        if i == last or first == 0 or not near:
            number[i], first = number[i - 1] + 1, i
        else:
            number[i] = number[i - 1]
    return number


def _means(
    places: FloatArray, doubt: FloatArray, number: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Give the weighted mean of each group of places, and the doubt of its surest."""
    weight = 1.0 / doubt**2
    total = np.bincount(number, weight)
    columns = [np.bincount(number, weight * column) / total for column in places.T]
    near = np.full(len(total), np.inf)
    np.minimum.at(near, number, doubt)
    return np.stack(columns, axis=1), near


def _robust(places: FloatArray, doubt: FloatArray) -> tuple[PenalisedFit, FloatArray]:
    """Fit places, the doubt of outliers raised to what the curve through the others misses."""
    at, near = cumulative_lengths(places), doubt.copy()
    size, fit, control = _smoothest(at, places, near)
    for _ in range(int(_OUTLIERS * len(places))):
        part = fit.off(control) / near
        part[[0, -1]] = 0.0
        best = size * _SMOOTHER, -1, 0.0
        for i in np.argsort(-part, kind="stable")[:_TRIED].tolist():
            freed = near.copy()
            freed[i] *= _FREE
            larger, other, bent = _smoothest(at, places, freed)
            missed = float(other.off(bent)[i])
            if missed > near[i] and larger > best[0]:
                best = larger, i, missed
        if best[1] < 0:
            break
        near[best[1]] = best[2]
        size, fit, control = _smoothest(at, places, near)
    return fit, control


_FREE = 10.0
"""A place of so many times its doubt does not hold the curve."""


def _smoothest(
    at: FloatArray, places: FloatArray, near: FloatArray
) -> tuple[float, PenalisedFit, FloatArray]:
    fit = PenalisedFit(at, places, near, at)
    size = fit.largest()
    return size, fit, fit.solve(size)

"""Between which bounds area and centroid of a form-parameter curve can lie, by its ends alone.

All bounds are necessary; `centroid_limits` is sharp for curves that rise, or fall, all the way.

Examples
--------
>>> from assoc_hull.geometry.form_curves.limits import area_limits, centroid_limits
>>> area_limits((0.0, 0.25), (2.0, 1.0))
(0.5, 2.0)
>>> [round(each, 6) for each in centroid_limits((0.0, 0.0), (1.0, 1.0), 0.4)]
[0.2, 0.8]
"""

from __future__ import annotations

import math

__all__ = ["area_limits", "centroid_box", "centroid_limits"]

Place = tuple[float, float]
"""Abscissa and ordinate."""


def area_limits(start: Place, finish: Place) -> tuple[float, float]:
    """Give the areas between which a curve can stay between the heights of its ends."""
    low, high = sorted((start[1], finish[1]))
    length = abs(finish[0] - start[0])
    return low * length, high * length


def centroid_box(start: Place, finish: Place, area: float) -> tuple[float, float]:
    """Give the centroids between which the moment about the lower end fits into the box of both.

    Parameters
    ----------
    start, finish : (float, float)
        The ends.
    area : float
        Above 0.
    """
    if finish[1] < start[1]:
        low, high = centroid_box((-finish[0], finish[1]), (-start[0], start[1]), area)
        return -high, -low
    half = 0.5 * (finish[0] - start[0]) ** 2 / area
    return start[0] + half * start[1], start[0] + half * finish[1]


def centroid_limits(start: Place, finish: Place, area: float) -> tuple[float, float]:
    """Give the centroids that curves of an area can have which rise, or fall, all the way.

    Parameters
    ----------
    start, finish : (float, float)
        The ends.
    area : float
        int y dx.

    Returns
    -------
    (float, float)
        nan if the ends are equally high, or the area is not within `area_limits`.
    """
    if finish[1] < start[1]:
        low, high = centroid_limits((-finish[0], finish[1]), (-start[0], start[1]), area)
        return -high, -low
    length, height = finish[0] - start[0], finish[1] - start[1]
    if not (height > 0.0 and length > 0.0 and area > 0.0):
        return math.nan, math.nan
    full = (area / length - start[1]) / height
    if not 0.0 <= full <= 1.0:
        return math.nan, math.nan
    base, rest = 0.5 * start[1] * length * length, height * full * length * length
    low = start[0] + (base + 0.5 * full * rest) / area
    return low, start[0] + (base + rest * (1.0 - 0.5 * full)) / area

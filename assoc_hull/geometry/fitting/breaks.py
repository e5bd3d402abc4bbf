"""Where spans of a fitted surface meet: from given places, and more where it does not follow.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.fitting.breaks import subdivided
>>> subdivided(np.array([0.0, 1.0, 4.0]), np.array([1, 3])).tolist()
[0.0, 1.0, 2.0, 3.0, 4.0]
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["checked_breaks", "even", "halved", "subdivided", "to_halve"]

_SHARE = 0.95
"""The part of the points of a span that must be within the tolerance."""

_NEAR = 1e-9
"""Spans shorter than this part of the domain are an error of the caller."""


def checked_breaks(values: FloatArray, name: str, where: str) -> FloatArray:
    """Take breaks, or say what is wrong with them.

    Raises
    ------
    BadInputError
        Fewer than two, not finite, falling, repeated more than three times within or at all at
        the ends, or so close that only rounding keeps them apart.
    """
    found = np.array(values, np.float64)
    if found.ndim != 1 or len(found) < 2 or not np.isfinite(found).all():
        raise BadInputError(f"{name} is of shape {found.shape}", where, "give two numbers or more")
    steps, room = np.diff(found), _NEAR * abs(found[-1] - found[0])
    if steps[0] <= 0.0 or steps[-1] <= 0.0 or ((steps != 0.0) & (steps < room)).any():
        least = float(steps.min())
        raise BadInputError(f"a span of {name} is {least:g} m long", where, "give rising places")
    if len(found) > 4 and (found[3:] == found[:-3]).any():
        raise BadInputError(f"{name} repeats a place four times", where, "repeat it three times")
    return found


def even(low: float, high: float, spans: int) -> FloatArray:
    """Give equal spans, (spans + 1,), m."""
    return np.linspace(low, high, spans + 1)


def subdivided(places: FloatArray, parts: int | IntArray) -> FloatArray:
    """Divide each bay between places in equal parts.

    Parameters
    ----------
    places : (b,), m
        Rising places.
    parts : int or (b - 1,) int
        Parts of each bay, at least 1.

    Returns
    -------
    (sum of parts + 1,), m
        Breaks; the places are among them to the last bit.
    """
    counts = np.broadcast_to(np.asarray(parts, np.int64), len(places) - 1)
    bay = np.repeat(np.arange(len(counts)), counts)
    part = np.arange(len(bay)) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.append(places[bay] + part / counts[bay] * np.diff(places)[bay], places[-1])


def halved(breaks: FloatArray, which: NDArray[np.bool_]) -> FloatArray:
    """Halve chosen spans (b - 1,) of breaks (b,); the others stay to the last bit."""
    return subdivided(breaks, np.where(which & (np.diff(breaks) > 0.0), 2, 1))


def to_halve(
    breaks: FloatArray, at: FloatArray, residual: FloatArray, tolerance: float
) -> NDArray[np.bool_]:
    """Say which spans do not follow their points and have points in both halves.

    Parameters
    ----------
    breaks : (b,), m
        Breaks of one parameter.
    at, residual : (k,), (k,), m
        That parameter of points, and how far they are from the surface.
    tolerance : float, m
        What 95 % of the points of a span may be off.

    Returns
    -------
    (b - 1,) bool
        Spans.
    """
    count = len(breaks) - 1
    span = np.clip(np.searchsorted(breaks, at, "right") - 1, 0, count - 1)
    off = np.bincount(span, residual > tolerance, count)
    number = np.bincount(span, minlength=count)
    middle = 0.5 * (breaks[:-1] + breaks[1:])
    right = np.bincount(span, at > middle[span], count)
    spread = (right > 0) & (right < number)
    return np.asarray((off > (1.0 - _SHARE) * number) & spread)

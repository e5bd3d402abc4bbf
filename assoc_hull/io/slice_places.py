"""Where to cut a hull: given places checked, or proposed ones that lie closer at the ends.

Examples
--------
>>> from assoc_hull.io.slice_places import propose
>>> propose(0.0, 100.0, 5, dense=True).tolist()
[4.39, 20.92, 50.0, 79.08, 95.61]
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.errors import BadInputError, NoMeetingError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["Places", "places_of", "propose"]

Places = int | Sequence[float] | FloatArray
"""A number of planes to propose, or their places in m."""

_MOST = 2000


def propose(low: float, high: float, count: int, *, dense: bool) -> FloatArray:
    """Give places inside an interval, none at its ends.

    Parameters
    ----------
    low, high : float, m
        The interval.
    count : int
        How many.
    dense : bool
        Whether they lie closer at both ends (there 0.4 of the mean spacing), else evenly.

    Returns
    -------
    (count,), m
        Rounded to 10 mm, or to a thousandth of the spacing where that is less.
    """
    t = (np.arange(count) + 0.5) / count
    if dense:
        t -= 0.6 * np.sin(2.0 * np.pi * t) / (2.0 * np.pi)
    fine = 10.0 ** np.floor(np.log10(max(1e-6, 1e-2 * (high - low) / count)))
    step = min(0.01, float(fine))
    places: FloatArray = np.round(np.round((low + (high - low) * t) / step) * step, 9)
    return places


def places_of(what: str, wanted: Places, low: float, high: float, *, dense: bool) -> FloatArray:
    """Give the places of the planes of a family, ascending.

    Parameters
    ----------
    what : str
        The family, such as "stations".
    wanted : int or sequence of float, m
        How many to propose, or where.
    low, high : float, m
        Extent of the hull across these planes.
    dense : bool
        As for `propose`.

    Raises
    ------
    BadInputError
        A number below 0 or above 2000, places that are not numbers, or two that are one.
    NoMeetingError
        A plane that misses the hull.
    """
    if isinstance(wanted, int | np.integer) and not isinstance(wanted, bool):
        if not 0 <= wanted <= _MOST:
            raise BadInputError(f"{what}={wanted}", "the argument", f"give 0 to {_MOST}")
        return propose(low, high, int(wanted), dense=dense) if wanted else np.zeros(0)
    try:
        places = np.sort(np.array(wanted, np.float64).reshape(-1))
    except (TypeError, ValueError) as error:
        raise BadInputError(
            f"{what}={wanted!r}", "the argument", "give a number of planes, or their places in m"
        ) from error
    if not np.isfinite(places).all() or len(places) > _MOST:
        raise BadInputError(f"{what} has a place that is not finite, or over {_MOST} of them",
                            "the argument", "give places in m")  # fmt: skip
    twice = np.flatnonzero(np.diff(places) < 1e-6)
    if len(twice):
        raise BadInputError(
            f"{what} has {places[twice[0]]:g} m twice", "the argument", "give each place once"
        )
    outside = np.maximum(low - places, places - high)
    if len(places) and outside.max() >= 0.0:
        worst = int(np.argmax(outside))
        raise NoMeetingError(
            f"the plane of {what} at {places[worst]:g} m", float(outside[worst]),
            f"give places between {low:.6g} and {high:.6g} m",
        )  # fmt: skip
    return places

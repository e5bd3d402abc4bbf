"""Where to cut a hull: given places checked, or proposed ones that lie closer at the ends.

Examples
--------
>>> from assoc_hull.io.slicing.cut_planes import propose_places
>>> propose_places(0.0, 100.0, 5, dense=True).tolist()
[4.39, 20.92, 50.0, 79.08, 95.61]
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError, NoMeetingError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.tolerance import at_full_length

__all__ = ["Places", "plane_places", "propose_places"]

Places = int | Sequence[float] | FloatArray
"""A number of planes to propose, or their places in m."""

_MOST = 2000

_APART = 1e-3
"""Places closer than this (m), of a hull under 100 m less in proportion, are one line."""

_TOUCH = 1e-6
"""As much less in proportion: a plane this close (m) to the end of the hull touches it."""


def propose_places(
    low: float, high: float, count: int, *, dense: bool, factor: float = 1.0
) -> FloatArray:
    """Give places inside an interval, none at its ends.

    Parameters
    ----------
    low, high : float, m
        The interval.
    count : int
        How many.
    dense : bool
        Whether they lie closer at both ends (there 0.4 of the mean spacing), else evenly.
    factor : float
        Of lengths, by the size of the hull.

    Returns
    -------
    (count,), m
        Rounded to 10 mm, of a hull under 100 m less in proportion, or to a thousandth of the
        spacing where that is less.
    """
    if factor != 1.0:
        # As for the ship of 100 m; what scaling left of the last bit must not turn a rounding.
        first, last = at_full_length([low, high], factor).tolist()
        return np.asarray(factor * propose_places(first, last, count, dense=dense))
    t = (np.arange(count) + 0.5) / count
    if dense:
        t -= 0.6 * np.sin(2.0 * np.pi * t) / (2.0 * np.pi)
    fine = 10.0 ** np.floor(np.log10(max(1e-6, 1e-2 * (high - low) / count)))
    step = min(0.01, float(fine))
    places: FloatArray = np.round(np.round((low + (high - low) * t) / step) * step, 9)
    return places


def plane_places(
    what: str, wanted: Places, low: float, high: float, *, dense: bool, factor: float = 1.0
) -> FloatArray:
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
    factor : float
        Of lengths, by the size of the hull.

    Raises
    ------
    BadInputError
        A number below 0 or above 2000, places that are not numbers in a list, or two
        less than 1 mm apart.
    NoMeetingError
        A plane that misses the hull, or only touches it.
    """
    if isinstance(wanted, int | np.integer) and not isinstance(wanted, bool):
        if not 0 <= wanted <= _MOST:
            raise BadInputError(f"{what}={wanted}", "the argument", f"give 0 to {_MOST}")
        return (
            propose_places(low, high, int(wanted), dense=dense, factor=factor)
            if wanted
            else np.zeros(0)
        )
    places = _given(what, wanted)
    _refuse_twice(what, places, factor * _APART)
    _refuse_outside(what, places, (low, high), factor * _TOUCH)
    return places


def _given(what: str, wanted: object) -> FloatArray:
    """Take a list of places; a lone number with a point may be meant for a count."""
    given = f"{what}={shown(wanted)}"
    remedy = "give a number of planes, such as 7, or a list of their places in m, such as [7.0]"
    if np.ndim(np.array(wanted, object)) == 0 or isinstance(wanted, str | bytes):
        raise WrongTypeError(given, "the argument", remedy)
    items = np.array(wanted, object).ravel().tolist()
    if any(isinstance(each, str | bytes | bool | np.bool_) for each in items):
        raise WrongTypeError(given, "the argument", remedy)
    try:
        places = np.sort(np.array(wanted, np.float64).reshape(-1))
    except (TypeError, ValueError, OverflowError) as error:
        raise BadInputError(given, "the argument", remedy) from error
    if not np.isfinite(places).all() or len(places) > _MOST:
        raise BadInputError(f"{what} has a place that is not finite, or over {_MOST} of them",
                            "the argument", "give places in m")  # fmt: skip
    return places


def _refuse_twice(what: str, places: FloatArray, least: float) -> None:
    twice = np.flatnonzero(np.diff(places) < least)
    if not len(twice):
        return
    first, second = places[twice[0] : twice[0] + 2].tolist()
    said = f"{first:.9g} m twice" if first == second else f"{first:.9g} m and {second:.9g} m"
    raise BadInputError(
        f"{what} has {said}, less than {1e3 * least:.3g} mm apart",
        "the argument",
        "give each place once",
    )


def _refuse_outside(what: str, places: FloatArray, ends: tuple[float, float], touch: float) -> None:
    """Refuse a plane that misses the hull, or meets it in its end only."""
    low, high = ends
    outside = np.maximum(low - places, places - high)
    if not len(places) or outside.max() < 0.0:
        return
    worst = int(np.argmax(outside))
    away = float(outside[worst])
    raise NoMeetingError(
        f"the plane of {what} at {places[worst]:g} m", away,
        f"give places between {low:.6g} and {high:.6g} m", away < touch,
    )  # fmt: skip

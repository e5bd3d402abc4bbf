"""The sums by which an entrance closes a curve of two halves.

Examples
--------
>>> from assoc_hull.model.forms.closure_sums import closing_area
>>> round(closing_area(0.7536, -0.208, 0.34, 1.0, 1.0, 0.511, 0.0, "here"), 4)
0.4482
"""

from __future__ import annotations

from assoc_hull.errors import BadInputError, OutOfRangeError

__all__ = ["close_sac", "closing_area"]

_CALL = "in a closure"


def close_sac(
    fullness: float,
    centroid: float,
    *,
    run_end: float,
    entrance_start: float,
    run_area: float,
    run_centroid: float,
    top: float = 1.0,
    end_ordinate: float = 0.0,
    entrance_end: float = 1.0,
    where: str = _CALL,
) -> tuple[float, float]:
    """Give area and centroid of the entrance, from fullness and centroid of the whole.

    Parameters
    ----------
    fullness : float
        Of the whole curve, C above: the prismatic or the waterplane coefficient.
    centroid : float
        Of the whole curve, in half lengths from midship, forward positive.
    run_end, entrance_start, entrance_end : float
        Where the run ends, the entrance begins and ends, in half lengths from midship.
    run_area, run_centroid : float
        Area of the run over half the length, and its centroid in half lengths.
    top : float
        Ordinate of the parallel part, Y above.
    end_ordinate : float
        Ordinate at the end of the entrance.
    where : str
        Named in errors.

    Returns
    -------
    float, float

    Raises
    ------
    OutOfRangeError
        No falling curve has this area, or this centroid with it: fullness or centroid lie
        outside of the interval that is told.
    """
    area = closing_area(
        fullness, run_end, entrance_start, entrance_end, top, run_area, end_ordinate, where
    )
    length = entrance_end - entrance_start
    moment = run_area * run_centroid + 0.5 * top * (entrance_start**2 - run_end**2)
    entrance = 2.0 * fullness * centroid - moment
    room = _room(area, length, end_ordinate, top)
    limits = [(moment + area * entrance_start + each) / (2.0 * fullness) for each in room]
    if not limits[0] <= centroid <= limits[1]:
        why = "leaves an entrance that falls and rises"
        raise OutOfRangeError(
            "centroid", centroid, where, why, limits[0], limits[1], "half lengths"
        )
    return area, entrance / area


def closing_area(
    fullness: float,
    run_end: float,
    entrance_start: float,
    entrance_end: float,
    top: float,
    run_area: float,
    end_ordinate: float,
    where: str,
) -> float:
    """Give the area of the entrance, if it fits between its ends."""
    length = entrance_end - entrance_start
    if length <= 0.0:
        what = f"the entrance begins at {entrance_start:g} and ends at {entrance_end:g}"
        raise BadInputError(what, where, "let it begin abaft its end")
    if entrance_start < run_end:
        what = f"the run ends at {run_end:g}, the entrance begins at {entrance_start:g}"
        raise BadInputError(what, where, "let the run end abaft the entrance, or where it begins")
    body = run_area + top * (entrance_start - run_end)
    area = 2.0 * fullness - body
    low, high = (0.5 * (body + each * length) for each in (end_ordinate, top))
    if not low < fullness < high:
        why = "leaves an entrance that does not fit between its ends"
        raise OutOfRangeError("fullness", fullness, where, why, low, high, "")
    return area


def _room(area: float, length: float, low: float, high: float) -> tuple[float, float]:
    """Give the least and the largest moment, about its beginning, of a falling curve."""
    rise = high - low
    full = (area / length - low) / rise
    base = 0.5 * low * length * length
    return base + 0.5 * rise * (full * length) ** 2, base + 0.5 * rise * full * length * length

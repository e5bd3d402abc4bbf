"""Where the stations of an offset table lie: order, origin and sense of x.

Ship axes: x = 0 at the aft perpendicular, forward positive.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.offsets.frame import station_places
>>> from assoc_hull.io.offsets.hints import Hints
>>> from assoc_hull.io.offset_report import Notebook
>>> stations = np.array([0.0, 5.0, 10.0])
>>> station_places(stations, "fp", Hints(), 100.0, Notebook(), "text")
array([100.,  50.,   0.])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offset_report import Notebook
from assoc_hull.io.offsets.hints import Hints

__all__ = ["given_places", "settle_zero", "station_places"]


def settle_zero(station_zero: str, hints: Hints, book: Notebook) -> str | None:
    """Say at which perpendicular station 0 lies: "ap", "fp", or None when nothing says it.

    Raises
    ------
    BadInputError
        The argument is none of "auto", "ap", "fp".
    """
    if station_zero not in ("auto", "ap", "fp"):
        raise BadInputError(
            f"station_zero is {station_zero!r}", "the argument", "give 'ap', 'fp' or 'auto'"
        )
    if station_zero == "auto":
        if hints.station_zero:
            what = f"station 0 at the {hints.station_zero.upper()}, as the comments say"
            book.assume("station zero", "the comments", what)
        return hints.station_zero
    if hints.station_zero and hints.station_zero != station_zero:
        what = f"{station_zero!r} was given and the comments say {hints.station_zero!r}"
        book.suspect("contradiction", "station zero", what)
    return station_zero


def station_places(
    stations: FloatArray,
    zero: str | None,
    hints: Hints,
    length: float | None,
    book: Notebook,
    source: str,
) -> FloatArray:
    """Give x of numbered stations.

    Parameters
    ----------
    stations : (s,)
        Station numbers.
    zero : str or None
        Perpendicular of station 0.
    hints : Hints
        May hold the number of station spacings.
    length : float or None
        Length between perpendiculars, m.
    book, source
        Notebook, and name of the file for messages.

    Returns
    -------
    (s,), m
        In the order of `stations`.

    Raises
    ------
    BadInputError
        The end of station 0, the length or the number of spacings cannot be known.
    """
    if length is None:
        raise BadInputError(
            "the stations are numbers and the length is not known",
            source,
            "give length= (Lpp in m), or a column x_m",
        )
    if zero is None:
        raise BadInputError(
            "nothing says whether station 0 is at the aft or the forward perpendicular",
            source,
            "give station_zero='ap' or 'fp', or a comment '# station 0 = FP'",
        )
    x = stations * (length / _divisions(stations, hints, book, source))
    return x if zero == "ap" else length - x


def _divisions(stations: FloatArray, hints: Hints, book: Notebook, source: str) -> int:
    if hints.divisions:
        what = f"{hints.divisions} station spacings between the perpendiculars, as they say"
        book.assume("station numbers", "the comments", what, hints.divisions)
        return hints.divisions
    for count in (20, 10):
        if count in stations and stations.max() < 1.15 * count:
            what = f"station {count} at the other perpendicular: it is the last full one"
            book.assume("station numbers", "the table", what, count)
            return count
    raise BadInputError(
        f"the stations run from {stations.min():g} to {stations.max():g}, neither 0 to 10 nor "
        "0 to 20",
        source,
        "add a column x_m, or a comment '# spacing: Lpp/<number of spacings>'",
    )


def given_places(
    x: FloatArray, zero: str | None, length: float | None, book: Notebook, source: str
) -> FloatArray:
    """Give x from the AP, forward positive, of stations whose place the file gives.

    Parameters
    ----------
    x : (s,), m
        As in the file.
    zero : str or None
        Perpendicular at which the file has x = 0.
    length : float or None
        Length between perpendiculars, m; needed when x counts from the FP.
    book, source
        Notebook, and name of the file for messages.

    Raises
    ------
    BadInputError
        Most of the ship lies at negative x and nothing says where x = 0 is, or x = 0 is
        amidships, or x counts from the FP and the length is not known.
    """
    low, high = float(x.min()), float(x.max())
    span = high - low
    if min(-low, high) > 0.25 * span:
        raise BadInputError(
            f"x runs from {low:g} to {high:g} m, so x = 0 is amidships",
            source,
            "add half the length to the column, so that x = 0 is the aft perpendicular",
        )
    negative = -low > 0.5 * span
    if zero is None and negative:
        raise BadInputError(
            f"x runs from {low:g} to {high:g} m, and nothing says which end x = 0 is",
            source,
            "give station_zero='ap' (bow at negative x) or 'fp' (stern at negative x)",
        )
    if zero == "fp":
        return _from_forward(x, negative, length, book, source)
    if zero is None:
        book.assume("frame", "column x", "x = 0 is the aft perpendicular, forward positive")
    if negative:
        book.repair("bow at negative x", "column x", f"x turned round; it ran to {low:g} m", low)
        return -x
    return x


def _from_forward(
    x: FloatArray, negative: bool, length: float | None, book: Notebook, source: str
) -> FloatArray:
    if length is None:
        length = float(np.abs(x).max())
        what = f"x = 0 is the FP and the AP is the farthest station, {length:.6g} m off"
        book.assume("length", source, what, length)
    book.repair("frame", "column x", "x was counted from the forward perpendicular", length)
    return length + x if negative else length - x

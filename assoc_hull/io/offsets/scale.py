"""Unit and frame of an offset table: what arguments, comments and numbers say of them.

An argument counts first, then the comments above the table, then the numbers. Where a choice
remains the reader refuses and names the argument to give. Results are in m in ship axes: x = 0 at
the aft perpendicular, forward positive.
"""

from __future__ import annotations

import re

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.reports import Notebook
from assoc_hull.io.units import check_particular

__all__ = [
    "OffsetHints",
    "OffsetScale",
    "column_scale",
    "find_scale",
    "given_places",
    "read_hints",
    "settle_zero",
    "station_places",
]

# --------------------------------------------------------------------------------------
# Comments.

_NUMBER = r"([0-9]+\.?[0-9]*)"
_END = r"(FP|AP|fore?ward perpendicular|aft(?:er)? perpendicular)"
_UNIT = re.compile(
    r"\bunits?\b[^.;]{0,20}?\b(mm|millimetres?|m|metres?|normali[sz]ed)\b|"
    r"\bin (mm|millimetres?|m|metres?)\b|(y/\(B/2\)|\bnormali[sz]ed\b)",
    re.IGNORECASE,
)
_ZERO = re.compile(rf"(?<![0-9.])0\s*(?:=|:|is|at|is at)\s*(?:the\s+)?{_END}", re.IGNORECASE)
_LAST = re.compile(rf"(?<![0-9.])(10|20)\s*(?:=|:|is|at|is at)\s*(?:the\s+)?{_END}", re.IGNORECASE)
_SPACING = re.compile(r"\b(?:Lpp|LBP|L)\s*/\s*([0-9]{1,3})\b", re.IGNORECASE)


@attrs.frozen
class OffsetHints:
    """What the comments say; None where they are silent.

    Attributes
    ----------
    unit : str or None
        "m", "mm" or "normalised".
    station_zero : str or None
        "ap" or "fp".
    divisions : int or None
        Station spacings between the perpendiculars.
    length, breadth, draught : float or None
        Particulars, m.
    length_breadth, breadth_draught : float or None
        Ratios.
    rounding : tuple of float
        Half unit of the last digit per waterline, in the table's unit; empty if not given.
    """

    unit: str | None = None
    station_zero: str | None = None
    divisions: int | None = None
    length: float | None = None
    breadth: float | None = None
    draught: float | None = None
    length_breadth: float | None = None
    breadth_draught: float | None = None
    rounding: tuple[float, ...] = ()


def read_hints(comments: tuple[str, ...]) -> OffsetHints:
    """Read the comments of a table; a statement that occurs twice counts the first time."""
    text = "\n".join(comments)
    last, spacing = _LAST.search(text), _SPACING.search(text)
    divisions = int(last[1]) if last else int(spacing[1]) if spacing else None
    return OffsetHints(
        unit=_unit(text),
        station_zero=_station_zero(text),
        divisions=divisions or None,
        length=_particular(text, "Lpp|LBP"),
        breadth=_particular(text, "B|[Bb]readth"),
        draught=_particular(text, "T|[Dd]raught|[Dd]esign waterline z"),
        length_breadth=_particular(text, r"L(?:pp)?\s*/\s*B"),
        breadth_draught=_particular(text, r"B\s*/\s*T"),
        rounding=_rounding(text),
    )


def _unit(text: str) -> str | None:
    found = _UNIT.search(text)
    if not found:
        return None
    word = next(group for group in found.groups() if group).lower()
    if word.startswith(("y", "n")):
        return "normalised"
    return "mm" if word.startswith("mi") or word == "mm" else "m"


def _station_zero(text: str) -> str | None:
    """Give the perpendicular of station 0, which may be said of the last station instead."""
    zero = _ZERO.search(text)
    if zero:
        return "ap" if zero[1].lower().startswith("a") else "fp"
    last = _LAST.search(text)
    if last:
        return "fp" if last[2].lower().startswith("a") else "ap"
    return None


def _particular(text: str, names: str) -> float | None:
    found = re.search(
        rf"(?<![\w/.])(?:{names})\s*[=:]\s*{_NUMBER}(?:\s*(mm))?(?![\w/]|\.[0-9])", text
    )
    if not found:
        found = re.search(rf"(?<![\w/.])(?:{names})\s*[=:]\s*{_NUMBER}\s*(mm|m)\b", text)
    if not found or not 1e-6 < float(found[1]) < 1e7:
        return None
    return float(found[1]) * (1e-3 if found[2] == "mm" else 1.0)


def _rounding(text: str) -> tuple[float, ...]:
    found = re.search(r"^rounding\s*:((?:[ \t]+[0-9]*\.?[0-9]+)+)[ \t]*$", text, re.MULTILINE)
    return tuple(float(word) for word in found[1].split()) if found else ()


# --------------------------------------------------------------------------------------
# Unit and particulars.

_METRES = {"m": 1.0, "mm": 1e-3}
_WIDEST = 40.0
"""Largest half-breadth (m) of a ship: a larger number is in millimetres."""


@attrs.frozen
class OffsetScale:
    """How the numbers of a table become metres.

    Attributes
    ----------
    unit : str
        "m", "mm" or "normalised".
    x, y, z : float
        Factor to m of lengths, half-breadths and heights without a unit of their own.
    length, breadth, draught : float or None
        Particulars, m; None where nothing gives them.
    """

    unit: str
    x: float
    y: float
    z: float
    length: float | None
    breadth: float
    draught: float | None


def find_scale(
    unit: str,
    largest: float,
    broad: float,
    hints: OffsetHints,
    length: float | None,
    breadth: float | None,
    draught: float | None,
    book: Notebook,
    source: str,
) -> OffsetScale:
    """Settle unit and particulars (m).

    `largest` is the largest half-breadth as printed, `broad` one that only a twentieth exceed: a
    single wrong number must not decide on the unit. `length`, `breadth` and `draught` are the
    caller's.

    Raises
    ------
    BadInputError
        The unit is unknown or cannot be settled, or a normalised table lacks a particular.
    """
    for name, value in (("length", length), ("breadth", breadth), ("draught", draught)):
        check_particular(name, value)
    length = _settle("length", length, hints.length, book)
    by_ratio = length / hints.length_breadth if length and hints.length_breadth else None
    breadth = _settle("breadth", breadth, hints.breadth or by_ratio, book)
    by_ratio = breadth / hints.breadth_draught if breadth and hints.breadth_draught else None
    draught = _settle("draught", draught, hints.draught or by_ratio, book)
    unit = _find_unit(unit, largest, broad, hints, breadth, book, source)
    if unit == "normalised":
        return _normalised(length, breadth, draught, source)
    factor = _METRES[unit]
    if breadth is None:
        breadth = 2.0 * factor * largest
        what = f"taken as twice the largest half-breadth, {breadth:.6g} m"
        book.assume("breadth", "the table", what, breadth)
    return OffsetScale(unit, factor, factor, factor, length, breadth, draught)


def _settle(name: str, given: float | None, said: float | None, book: Notebook) -> float | None:
    """Take a particular (m) from the argument, else from the comments; report a contradiction."""
    if given is None and said is not None:
        book.assume(name, "the comments", f"{said:.6g} m, as the comments say", said)
    if given is None or said is None:
        return said if given is None else given
    if abs(given - said) > 2e-3 * given:
        what = f"{given:.6g} m was given and the comments say {said:.6g} m; the first counts"
        book.suspect("contradiction", name, what, given - said)
    return given


def _find_unit(
    unit: str,
    largest: float,
    broad: float,
    hints: OffsetHints,
    breadth: float | None,
    book: Notebook,
    source: str,
) -> str:
    if unit not in ("auto", "m", "mm", "normalised"):
        raise BadInputError(
            f"the unit {unit!r} is unknown", "argument unit", "give 'm', 'mm' or 'normalised'"
        )
    if unit != "auto":
        if hints.unit and hints.unit != unit:
            what = f"{unit!r} was given and the comments say {hints.unit!r}; the first counts"
            book.suspect("contradiction", "unit", what)
        return unit
    if hints.unit:
        book.assume("unit", "the comments", f"{hints.unit}, as the comments say")
        return hints.unit
    likely = _likely_units(largest, broad, breadth)
    if len(likely) != 1:
        choice = " or ".join(likely) or "none that fits"
        raise BadInputError(
            f"the unit cannot be told from the largest half-breadth {largest:g} ({choice})",
            source,
            "give unit='m', 'mm' or 'normalised' (and breadth=)",
        )
    what = f"{likely[0]}, because the largest half-breadth is {largest:g}"
    book.assume("unit", "the table", what, largest)
    return likely[0]


def _likely_units(largest: float, broad: float, breadth: float | None) -> list[str]:
    """Give the units in which the half-breadths make a ship; as printed, unit not known."""
    if breadth is not None:
        sizes = {"m": breadth / 2.0, "mm": breadth * 500.0, "normalised": 1.0}
        return [unit for unit, size in sizes.items() if 0.6 * size < broad < 1.05 * size]
    if 0.9 <= largest <= 1.001:
        return ["m", "normalised"]
    if largest <= _WIDEST:
        return ["m"]
    return ["mm"] if largest > 5.0 * _WIDEST else ["m", "mm"]


def _normalised(
    length: float | None, breadth: float | None, draught: float | None, source: str
) -> OffsetScale:
    sizes = {"length": length, "breadth": breadth, "draught": draught}
    missing = [f"{name}=" for name, value in sizes.items() if value is None]
    if length is None or breadth is None or draught is None:
        raise BadInputError(
            f"the table is normalised and {' '.join(missing)} is not known",
            source,
            f"give {' and '.join(missing)} in m",
        )
    return OffsetScale("normalised", length, breadth / 2.0, draught, length, breadth, draught)


def column_scale(scale: float, unit: str | None) -> float:
    """Give the factor to m of a column: its own unit where its name says one."""
    return _METRES.get(unit or "", scale)


# --------------------------------------------------------------------------------------
# Stations: order, origin and sense of x.


def settle_zero(station_zero: str, hints: OffsetHints, book: Notebook) -> str | None:
    """Give the perpendicular of station 0, "ap" or "fp"; None when nothing says it.

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
    hints: OffsetHints,
    length: float | None,
    book: Notebook,
    source: str,
) -> FloatArray:
    """Give x (s,), m, of numbered stations, in their order.

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


def _divisions(stations: FloatArray, hints: OffsetHints, book: Notebook, source: str) -> int:
    if hints.divisions:
        what = f"{hints.divisions} station spacings between the perpendiculars, as they say"
        book.assume("station numbers", "the comments", what, hints.divisions)
        return hints.divisions
    for count in (20, 10):
        if count in stations and stations.max() < 1.15 * count:
            # Overhangs are shorter than 15 % of Lpp: stations beyond that belong to another count.
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
    """Give x (s,), m, from the AP, forward positive, of stations whose x the file gives.

    `zero` is the perpendicular at which the file has x = 0; `length` is needed if that is the FP.

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
    """Give x from the AP of stations that are counted from the FP, in either sense."""
    if length is None:
        length = float(np.abs(x).max())
        what = f"x = 0 is the FP and the AP is the farthest station, {length:.6g} m off"
        book.assume("length", source, what, length)
    book.repair("frame", "column x", "x was counted from the forward perpendicular", length)
    return length + x if negative else length - x

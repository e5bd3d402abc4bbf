"""Unit and frame of an offset table: what arguments, comments and numbers say of them.

An argument counts first, then the comments above the table, then the numbers. Where a choice
remains the reader refuses and names the argument to give. Results are in m in ship axes: x = 0 at
the aft perpendicular, forward positive.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.arguments import integer, positive
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.hints import BlockUnits, OffsetHints
from assoc_hull.io.reports import Notebook
from assoc_hull.io.units import METRES, check_particular

__all__ = [
    "OffsetScale",
    "PrintedSizes",
    "column_scale",
    "compare_spacing",
    "find_scale",
    "given_places",
    "given_spacing",
    "given_units",
    "settle_zero",
    "station_places",
]

# --------------------------------------------------------------------------------------
# Particulars.

_WIDEST = 40.0
"""Largest half-breadth (m) of a ship: a larger number is in millimetres."""

_AGREE = 0.02
"""Ratios told and found that differ by more than this part contradict each other."""


@attrs.frozen
class OffsetScale:
    """How the numbers of a table become metres.

    Attributes
    ----------
    unit : str
        Of half-breadths: "m", "mm", "cm", "ft", "in" or "normalised".
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


@attrs.frozen
class PrintedSizes:
    """How large the numbers of a table are, as printed; nan where names tell the unit.

    Attributes
    ----------
    largest : float
        Largest half-breadth that its neighbours bear out.
    broad : float
        One that only a twentieth exceed: a single wrong number must not decide on the unit.
    top, span : float
        Highest waterline; from the first station to the last.
    unit, along : str or None
        Units of the half-breadths where the cells tell it, and of x where its column does.
    """

    largest: float
    broad: float
    top: float = math.nan
    span: float = math.nan
    unit: str | None = None
    along: str | None = None


def find_scale(
    unit: str,
    printed: PrintedSizes,
    hints: OffsetHints,
    length: float | None,
    breadth: float | None,
    draught: float | None,
    book: Notebook,
    source: str,
) -> OffsetScale:
    """Settle units and particulars (m).

    `unit` is one for all, or up to three with commas: of half-breadths, heights, lengths.
    `length`, `breadth` and `draught` are the caller's.

    Raises
    ------
    BadInputError
        A unit is unknown, cannot be settled or contradicts the file, or a normalised table
        lacks a particular.
    """
    for name, value in (("length", length), ("breadth", breadth), ("draught", draught)):
        check_particular(name, value)
    given = given_units(unit)
    told = attrs.evolve(hints.units, y=printed.unit) if printed.unit else hints.units
    _refuse_other(given, told, source)
    length = _settle("length", length, hints.length, book)
    by_ratio = length / hints.length_breadth if length and hints.length_breadth else None
    breadth = _settle("breadth", breadth, hints.breadth or by_ratio, book)
    by_ratio = breadth / hints.breadth_draught if breadth and hints.breadth_draught else None
    draught = _settle("draught", draught, hints.draught or by_ratio, book)
    _compare("L/B", hints.length_breadth, length, breadth, book)
    _compare("B/T", hints.breadth_draught, breadth, draught, book)
    _tell_units(given, told, book)
    across = given.y or told.y or likely_unit(printed, breadth, book, source)
    _tell_mixed(across, given, told, printed.along, book, source)
    if across == "normalised":
        sizes = (length, breadth, draught)
        return _normalised(given, told, printed, sizes, book, source)
    factor = METRES[across]
    if breadth is None:
        breadth = 2.0 * factor * printed.largest
        what = f"taken as twice the largest half-breadth, {breadth:.6g} m"
        book.assume("breadth", "the table", what, breadth)
    up = given.z or told.z or height_unit(across, printed, breadth, draught, book)
    along = given.x or told.x or length_unit((up, across), printed, breadth, length, book)
    heights = _parts(up, draught, "draught", source)
    return OffsetScale(
        across, _parts(along, length, "length", source), factor, heights, length, breadth, draught
    )


def _parts(unit: str, whole: float | None, name: str, source: str) -> float:
    """Give the factor to m of one block, which may be normalised by a particular."""
    if unit != "normalised":
        return METRES[unit]
    if whole is None:
        raise BadInputError(
            f"a block is normalised and the {name} is not known", source, f"give {name}= in m"
        )
    return whole


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


def _compare(
    name: str, told: float | None, one: float | None, other: float | None, book: Notebook
) -> None:
    """Note a ratio that the comments tell and the particulars do not have."""
    if told and one and other and abs(one / other / told - 1.0) > _AGREE:
        what = f"the comments say {told:.4g}; {one:.6g} m to {other:.6g} m is {one / other:.4g}"
        book.suspect("contradiction", name, what, one / other)


def _normalised(
    given: BlockUnits, told: BlockUnits, printed: PrintedSizes,
    sizes: tuple[float | None, float | None, float | None], book: Notebook, source: str,
) -> OffsetScale:  # fmt: skip
    length, breadth, draught = sizes
    named = {"length": length, "breadth": breadth, "draught": draught}
    missing = [name for name, value in named.items() if value is None]
    if length is None or breadth is None or draught is None:
        raise BadInputError(
            f"the table is normalised and {' and '.join(missing)} "
            f"{'is' if len(missing) == 1 else 'are'} not known",
            source,
            f"give {' and '.join(f'{name}=' for name in missing)} in m",
        )
    up = given.z or told.z or height_unit("normalised", printed, breadth, draught, book)
    along = given.x or told.x or "normalised"
    return OffsetScale(
        "normalised", _parts(along, length, "length", source), breadth / 2.0,
        _parts(up, draught, "draught", source), length, breadth, draught,
    )  # fmt: skip


def column_scale(scale: float, unit: str | None) -> float:
    """Give the factor to m of a column: its own unit where its name says one."""
    return METRES.get(unit or "", scale)


# --------------------------------------------------------------------------------------
# Units: given, told, or plain from the sizes.

_EVERY = (*METRES, "normalised")
_HEIGHTS = (0.08, 1.25)  # highest waterline to breadth
_DRAUGHTS = (0.4, 5.0)  # highest waterline to draught
_LENGTHS = (1.5, 20.0)  # span of the stations to breadth
_SPANS = (0.3, 1.4)  # span of the stations to length


def given_units(unit: str) -> BlockUnits:
    """Take ``unit=``: one for all, or with commas those of half-breadths, heights, lengths.

    Raises
    ------
    BadInputError
        A unit is unknown, or there are more than three.
    """
    words = [word.strip().lower() for word in unit.split(",")]
    if words == ["auto"]:
        return BlockUnits()
    wrong = [word for word in words if word not in _EVERY]
    if wrong or len(words) > 3:
        known = ", ".join(map(repr, _EVERY))
        raise BadInputError(
            f"the unit {(wrong or [unit])[0]!r} is unknown",
            "argument unit",
            f"give {known}, or 'mm,m' for half-breadths in mm and heights in m",
        )
    if len(words) == 1:
        return BlockUnits(*words * 3)
    return BlockUnits(words[0], words[1], words[-1])


_BLOCKS = {"y": "half-breadths", "z": "heights", "x": "lengths"}


def _refuse_other(given: BlockUnits, told: BlockUnits, source: str) -> None:
    for block, name in _BLOCKS.items():
        wanted, said = getattr(given, block), getattr(told, block)
        if wanted and said and wanted != said:
            raise BadInputError(
                f"the unit {wanted!r} was given and the file says that {name} are in {said!r}",
                source,
                "leave the unit out, or correct what the file says",
            )


def _tell_units(given: BlockUnits, told: BlockUnits, book: Notebook) -> None:
    said = {name: getattr(told, block) for block, name in _BLOCKS.items()}
    if given.y or not any(said.values()):
        return
    units = set(said.values())
    each = ", ".join(f"{name} {unit}" for name, unit in said.items() if unit)
    words = units.pop() if len(units) == 1 else each
    book.assume("unit", "the table", f"{words}, as its comments or the names of its columns say")


def likely_unit(printed: PrintedSizes, breadth: float | None, book: Notebook, source: str) -> str:
    """Find the unit of half-breadths from their size.

    Raises
    ------
    BadInputError
        None fits, or several do.
    """
    largest = printed.largest
    likely = _likely_units(largest, printed.broad, breadth)
    if len(likely) != 1:
        choice = " or ".join(likely) or "none that fits"
        full = breadth and 0.95 * breadth < largest < 1.05 * breadth
        raise BadInputError(
            f"the unit cannot be told from the largest half-breadth {largest:g} ({choice})",
            source,
            "these may be full breadths: give half of each" if full else
            "give unit='m', 'mm' or 'normalised' (and breadth=)",
        )  # fmt: skip
    what = f"{likely[0]}, because the largest half-breadth is {largest:g}"
    book.assume("unit", "the table", what, largest)
    return likely[0]


_ENGLISH = ("ft", "in")


def _tell_mixed(
    unit: str, given: BlockUnits, told: BlockUnits, along: str | None, book: Notebook, source: str
) -> None:
    """Suspect half-breadths taken as metric beside heights or x that are told to be English."""
    if told.y is not None or unit not in ("m", "mm"):
        return
    if given.y is None and told.z in _ENGLISH:
        what = (
            f"heights are in {told.z} and nothing tells the unit of the half-breadths, taken as "
            f"{unit} by their size: give unit={told.z!r}, or unit='{unit},{told.z}' if it is so"
        )
        book.suspect("unit", source, what)
    elif along in _ENGLISH and given.x != along:
        what = (
            f"x is in {along} by the name of its column, and half-breadths are taken as {unit}: "
            f"give unit={along!r}, or unit='{unit},{unit},{along}' if it is so"
        )
        book.suspect("unit", source, what)


def _likely_units(largest: float, broad: float, breadth: float | None) -> list[str]:
    """Give the units in which the half-breadths make a ship; as printed, unit not known."""
    if breadth is not None:
        half = breadth / 2.0
        likely = [u for u in ("m", "mm") if 0.6 < broad * METRES[u] / half < 1.05]
        likely += ["normalised"] if 0.6 < broad < 1.05 else []
        # Of units a factor of 2 or 3 apart from metres only a close fit is evidence.
        others = [u for u in METRES if u not in ("m", "mm")]
        close = [u for u in others if 0.97 < largest * METRES[u] / half < 1.03]
        return likely or close
    if 0.9 <= largest <= 1.001:
        return ["m", "normalised"]
    if largest <= _WIDEST:
        return ["m"]
    return ["mm"] if largest > 5.0 * _WIDEST else ["m", "mm"]


def height_unit(
    across: str, printed: PrintedSizes, breadth: float, draught: float | None, book: Notebook
) -> str:
    """Find the unit of heights: that of half-breadths unless only another makes a ship."""

    def fits(unit: str) -> bool:
        metres = METRES.get(unit, draught)
        if metres is None:
            return False
        top = printed.top * metres
        low, high = _HEIGHTS
        if draught is None:
            return low < top / breadth < high
        low, high = (min(_HEIGHTS[0], _DRAUGHTS[0] * draught / breadth), high)
        return low < top / breadth < high and _DRAUGHTS[0] < top / draught < _DRAUGHTS[1]

    return _other_unit(across, fits, printed.top, "heights", book)


def length_unit(
    first: tuple[str, ...], printed: PrintedSizes, breadth: float, length: float | None,
    book: Notebook,
) -> str:  # fmt: skip
    """Find the unit of lengths: one of `first` unless only another makes a ship."""

    def fits(unit: str) -> bool:
        span = printed.span * METRES.get(unit, length or math.nan)
        low, high = _LENGTHS
        if length is not None:
            return _SPANS[0] < span / length < _SPANS[1]
        return low < span / breadth < high

    plain = first[0] if fits(first[0]) or not fits(first[1]) else first[1]
    return _other_unit(plain, fits, printed.span, "lengths", book)


def _other_unit(
    plain: str, fits: Callable[[str], bool], size: float, name: str, book: Notebook
) -> str:
    """Give the unit that is plain, or the only one of the others that makes a ship."""
    if math.isnan(size) or fits(plain):
        return plain
    likely = [unit for unit in ("m", "mm", "normalised") if fits(unit)]
    likely = likely[:1] if likely[:1] == ["m"] else likely
    if len(likely) != 1:
        return plain
    what = f"{name} in {likely[0]}, because the largest is {size:g}: in {plain} it makes no ship"
    book.assume("unit", "the table", what, size)
    return likely[0]


# --------------------------------------------------------------------------------------
# Stations: order, origin and sense of x.


def given_spacing(
    hints: OffsetHints, spacings: int | None, frame_spacing: float | None, book: Notebook
) -> OffsetHints:
    """Let what the caller says of stations or frames count before the comments.

    Raises
    ------
    BadInputError
        Both are given, or a number that none of them can be.
    """
    if spacings is None and frame_spacing is None:
        return hints
    if spacings is not None and frame_spacing is not None:
        raise BadInputError(
            "station_spacings and frame_spacing are given", "as arguments",
            "give one: stations are numbered by parts of Lpp, or by frames",
        )  # fmt: skip
    if frame_spacing is not None:
        distance = positive(frame_spacing, "frame_spacing", "as an argument")
        return attrs.evolve(hints, frame_spacing=distance)
    count = integer(spacings, "station_spacings", "as an argument", least=2, most=1000)
    if hints.divisions and hints.divisions != count:
        what = f"{count} were given and the comments say {hints.divisions}; the first counts"
        book.suspect("contradiction", "station numbers", what)
    return attrs.evolve(hints, divisions=count)


_SPACING = 0.01
"""A spacing of stations and that of a column of places agree within this part."""


def compare_spacing(
    name: str, spacing: float, stations: FloatArray, x: FloatArray, source: str, book: Notebook
) -> None:
    """Compare a spacing (m) that was given with the places x (s,), m, that the table has anyway.

    Raises
    ------
    BadInputError
        It is another than that of the places, or the stations have no numbers.
    """
    known = np.isfinite(stations) & np.isfinite(x)
    step = np.abs(np.diff(stations[known]))
    found = np.abs(np.diff(x[known]))[step > 0.0] / step[step > 0.0]
    remedy = f"leave {name} out: the places count"
    if not len(found):
        what = (
            f"{name} cannot be given: a column tells places of stations, and they have no numbers"
        )
        raise BadInputError(what, source, remedy)
    middle = float(np.median(found))
    if abs(spacing / middle - 1.0) > _SPACING:
        what = (
            f"{name} makes a station every {spacing:.6g} m, and its places one every {middle:.6g} m"
        )
        raise BadInputError(what, source, f"{remedy}; or correct them")
    book.assume("station numbers", "column x", f"one every {middle:.6g} m, as given", middle)


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
    if hints.frame_spacing is not None and zero != "fp":
        return stations * hints.frame_spacing
    if length is None or zero is None:
        raise _unplaced(stations, zero, hints, length, source)
    if hints.frame_spacing is not None:
        return length - stations * hints.frame_spacing
    x = stations * (length / _divisions(stations, hints, book, source))
    return x if zero == "ap" else length - x


def _unplaced(
    stations: FloatArray, zero: str | None, hints: OffsetHints, length: float | None, source: str
) -> BadInputError:
    """Give the error that tells all that numbered stations lack: nothing is asked for later."""
    what, remedy = list[str](), list[str]()
    if length is None:
        what.append("the stations are numbers and the length is not known")
        remedy.append("length= (Lpp in m)")
    if zero is None:
        what.append("nothing says whether station 0 is at the aft or the forward perpendicular")
        remedy.append("station_zero='ap' or 'fp', or a comment '# station 0 = FP'")
    if not hints.divisions and hints.frame_spacing is None and not _usual(stations):
        what.append(_unusual(stations))
        remedy.append("station_spacings=, how many lie between the perpendiculars")
    return BadInputError(
        "; ".join(what), source,
        f"give {' and '.join(remedy)}; for numbers of frames frame_spacing= in m, with which frame "
        "0 is at the AP; or a column x_m in place of numbers, m from the AP",
    )  # fmt: skip


def _usual(stations: FloatArray) -> int | None:
    """Give 20 or 10 where so many spacings lie between the perpendiculars, by the numbers alone."""
    # Overhangs are shorter than 15 % of Lpp: stations beyond that belong to another count.
    fitting = (each for each in (20, 10) if each in stations and stations.max() < 1.15 * each)
    return next(fitting, None)


def _unusual(stations: FloatArray) -> str:
    low, high = stations.min(), stations.max()
    return f"the stations run from {low:g} to {high:g}, neither 0 to 10 nor 0 to 20"


def _divisions(stations: FloatArray, hints: OffsetHints, book: Notebook, source: str) -> int:
    if hints.divisions:
        what = f"{hints.divisions} station spacings between the perpendiculars, as they say"
        book.assume("station numbers", "the comments", what, hints.divisions)
        return hints.divisions
    count = _usual(stations)
    if count is not None:
        what = f"station {count} at the other perpendicular: it is the last full one"
        book.assume("station numbers", "the table", what, count)
        return count
    raise BadInputError(
        _unusual(stations),
        source,
        "give station_spacings=, how many lie between the perpendiculars, or frame_spacing= in m "
        "if they are frames; or a column x_m, or a comment '# spacing: Lpp/<number of spacings>'",
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
        amidships and not where it is said to be.
    """
    low, high = float(x.min()), float(x.max())
    span = high - low
    if min(-low, high) > 0.25 * span:
        if zero is not None:
            raise BadInputError(
                f"x runs from {low:g} to {high:g} m, so x = 0 is amidships and not the {zero}",
                source, "leave station_zero out, or give origin='midship'",
            )  # fmt: skip
        book.assume("frame", "column x", f"x = 0 is amidships: x runs from {low:g} to {high:g} m")
        return x
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

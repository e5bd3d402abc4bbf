"""The unit of an offset table and the particulars that give its full scale.

An argument counts first, then what the comments say, then the numbers; where the numbers
leave a choice, the reader refuses and names the argument to give.

Examples
--------
>>> from assoc_hull.io.offsets.hints import Hints
>>> from assoc_hull.io.offset_report import Notebook
>>> from assoc_hull.io.offsets.units import find_scale
>>> scale = find_scale("auto", 16200.0, 16200.0, Hints(), None, 32.4, None, Notebook(), "text")
>>> scale.unit, scale.y, scale.breadth
('mm', 0.001, 32.4)
"""

from __future__ import annotations

import attrs

from assoc_hull.arguments import positive
from assoc_hull.errors import BadInputError
from assoc_hull.io.offset_report import Notebook
from assoc_hull.io.offsets.hints import Hints

__all__ = ["Scale", "check_argument", "column_scale", "find_scale"]

_METRES = {"m": 1.0, "mm": 1e-3}
_WIDEST = 40.0


@attrs.frozen
class Scale:
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


def check_argument(name: str, value: float | None) -> None:
    """Refuse a particular that is not a positive number.

    Raises
    ------
    BadInputError
        The value is nil, negative, NaN or infinite.
    """
    if value is not None:
        positive(value, name, "as an argument")


def find_scale(
    unit: str,
    largest: float,
    broad: float,
    hints: Hints,
    length: float | None,
    breadth: float | None,
    draught: float | None,
    book: Notebook,
    source: str,
) -> Scale:
    """Settle unit and particulars.

    Parameters
    ----------
    unit : str
        "auto", "m", "mm" or "normalised".
    largest, broad : float
        The largest half-breadth as printed, and one that only a twentieth exceed: a single
        wrong number must not decide on the unit.
    hints : Hints
        What the comments say.
    length, breadth, draught : float or None
        What the caller says, m.
    book : Notebook
        Takes the assumptions.
    source : str
        Name of the file, for messages.

    Raises
    ------
    BadInputError
        The unit is unknown or cannot be told, or a normalised table lacks a particular.
    """
    for name, value in (("length", length), ("breadth", breadth), ("draught", draught)):
        check_argument(name, value)
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
    return Scale(unit, factor, factor, factor, length, breadth, draught)


def _settle(name: str, given: float | None, said: float | None, book: Notebook) -> float | None:
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
    hints: Hints,
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
) -> Scale:
    sizes = {"length": length, "breadth": breadth, "draught": draught}
    missing = [f"{name}=" for name, value in sizes.items() if value is None]
    if length is None or breadth is None or draught is None:
        raise BadInputError(
            f"the table is normalised and {' '.join(missing)} is not known",
            source,
            f"give {' and '.join(missing)} in m",
        )
    return Scale("normalised", length, breadth / 2.0, draught, length, breadth, draught)


def column_scale(scale: float, unit: str | None) -> float:
    """Give the factor to m of a column: its own unit where its name says one."""
    return _METRES.get(unit or "", scale)

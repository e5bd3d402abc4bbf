"""Names of columns of a table of offsets, and its numbers as they are printed.

Known, in any case, with blanks or underscores, and with a unit at the end (``x_m``, ``x [mm]``):
stations, x, waterlines (``wl_0.25``, ``WL 2``, ``2.0 m``, ``0.5``, ``base``), buttocks
(``bt_2``), heights of keel and sheer or deck, half-breadth of the deck, and the two columns that
serve as a check: the largest beam (``MaxBm``) and the sectional area or its ratio (``SAR``).

Numbers as tables of offsets print them: decimals, fractions, feet-inches-eighths, commas.

Examples
--------
>>> from assoc_hull.io.tables.column_names import column_name
>>> column_name("WL 2"), column_name("sheer half-breadth [mm]").kind
(ColumnName(kind='waterline', value=2.0, unit=None, named=True), 'deck half-breadth')
>>> from assoc_hull.io.tables.column_names import cell_value, label_number
>>> cell_value("12-6-3+"), cell_value("1.52"), label_number("9 1/2")
(12.536458333333334, 1.52, 9.5)
"""

from __future__ import annotations

import math
import re

import attrs

__all__ = [
    "BLANKS",
    "EIGHTH",
    "ColumnName",
    "cell_value",
    "column_name",
    "is_corner_of_waterlines",
    "is_eighths",
    "is_unit",
    "label_number",
    "number_like",
    "station_label",
    "unit_word",
    "with_points",
]

BLANKS = frozenset({"", "-", "--", "\N{EN DASH}", "\N{EM DASH}"})
"""Cells that hold no number."""

EIGHTH = 1.0 / 96.0
"""An eighth of an inch in feet: the unit of cells such as ``12-6-3``."""

_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?")
_EIGHTHS = re.compile(r"(-?)([0-9]{1,3})-([0-9]{1,2})-([0-9])([-+]?)")
_FRACTION = re.compile(r"(-?)(?:([0-9]{1,4})[ -]?)??([0-9]{1,2})/([0-9]{1,2})")
_SIGNS = {"\N{VULGAR FRACTION ONE HALF}": " 1/2", "\N{VULGAR FRACTION ONE QUARTER}": " 1/4",
          "\N{VULGAR FRACTION THREE QUARTERS}": " 3/4"}  # fmt: skip
_COMMA = re.compile(r"(?<=[0-9]),(?=[0-9]+([eE][-+]?[0-9]{1,3})?$)|^(-?),(?=[0-9]+$)")


_DASH = re.compile(r"\s*-\s*(?=[0-9.])")


def _closed(cell: str) -> str:
    """Give a cell without blanks beside its dashes: ``12 - 6 - 3``."""
    return _DASH.sub("-", cell)


def is_eighths(cell: str) -> bool:
    """Tell whether a cell is in feet, inches and eighths: ``12-6-3``, with ``+`` a sixteenth."""
    found = _EIGHTHS.fullmatch(_closed(cell))
    return found is not None and int(found[3]) < 12 and int(found[4]) < 8


def cell_value(cell: str) -> float | None:
    """Give the number in a cell, nan for a blank, None for anything else.

    Feet-inches-eighths are in feet; ``+`` is a sixteenth of an inch more, ``-`` one less.
    """
    if cell in BLANKS:
        return math.nan
    cell = _closed(cell)
    if _NUMBER.fullmatch(cell):
        return float(cell)
    if not is_eighths(cell):
        return None
    sign, feet, inches, eighths, more = _EIGHTHS.fullmatch(cell).groups()  # type: ignore[union-attr]
    half = {"+": 0.5, "-": -0.5, "": 0.0}[more]
    value = int(feet) + int(inches) / 12.0 + (int(eighths) + half) * EIGHTH
    return -value if sign else value


def number_like(cell: str) -> bool:
    """Say whether a cell is blank or a number."""
    return cell_value(cell) is not None


def label_number(label: str) -> float | None:
    """Give the number that a label shows: as a cell, or with a fraction such as ``9 1/2``."""
    for sign, plain in _SIGNS.items():
        label = label.replace(sign, plain)
    label = label.strip()
    if label in BLANKS:
        return None
    value = cell_value(with_points(label))
    found = _FRACTION.fullmatch(label)
    if value is not None or not found or int(found[4]) == 0:
        return value
    value = int(found[2] or 0) + int(found[3]) / int(found[4])
    return -value if found[1] else value


def with_points(cell: str) -> str:
    """Give a cell with its decimal comma, if it has one, turned into a point."""
    return _COMMA.sub(lambda found: f"{found[2] or ''}.", cell)


_UNITS = {
    "m": ("m", "metre", "metres", "meter", "meters"),
    "mm": ("mm", "millimetre", "millimetres", "millimeter", "millimeters"),
    "cm": ("cm", "centimetre", "centimetres", "centimeter", "centimeters"),
    "ft": ("ft", "feet", "foot", "'"),
    "in": ("in", "inch", "inches", '"'),
    "t": ("t",),
}
_UNIT_OF = {word: unit for unit, words in _UNITS.items() for word in words}
_WORDS = "|".join(sorted((re.escape(word) for word in _UNIT_OF), key=len, reverse=True))
_UNIT_END = re.compile(rf"(?P<name>.*?[a-z0-9.])_?(?P<unit>{_WORDS})")
_UNIT_AFTER = re.compile(rf"(?P<name>.+)_(?P<unit>{_WORDS})")

_FAMILY = {
    "waterline": r"w\.?l\.?|water_?lines?|wasserlinien?|z|height|level|draught|draft",
    "buttock": r"bt|btk|buttocks?|butt",
}
_NUMBERED = {
    kind: re.compile(rf"(?:{words})_?(?P<rest>[-0-9.].*)") for kind, words in _FAMILY.items()
}
_TAIL = re.compile(r"_(?:w\.?l\.?|waterline|dwl|lwl|cwl|abl|above_(?:base|bl|keel)(?:_line)?)$")
_BASE = frozenset({"bl", "b.l", "base", "baseline", "base_line"})
_STATION = frozenset(
    {"station", "stations", "stn", "stns", "sta", "st", "frame", "frames", "fr", "no", "nr",
     "number", "section", "sections", "spant", "spt", "ordinate", "ord"}
)  # fmt: skip
_ROWS_OF_WATERLINES = frozenset(
    {"wl", "w.l", "wls", "waterline", "waterlines", "z", "height", "heights"}
)
_BEAM = frozenset(
    {"maxbm", "maxbeam", "maxb", "maxbreadth", "maxhalfbreadth", "maxhalfbeam", "maximumbeam",
     "maximumbreadth", "maximumhalfbreadth", "maximumhalfbeam", "bmax", "ymax", "maxy"}
)  # fmt: skip
_AREA = frozenset(
    {"sar", "sarraw", "arearatio", "sectionalarearatio", "sectionarearatio", "area", "areas",
     "sectionalarea", "sectionarea", "aam", "aamax", "aax", "axam", "axax", "sac"}
)  # fmt: skip
_KEEL = frozenset({"keel", "profile", "rabbet"})
_DECK = frozenset({"deck", "sheer", "gunwale"})
_ACROSS = frozenset({"half", "hb", "breadth", "halfbreadth", "y", "width", "beam", "breadths"})
_HEIGHT = frozenset(
    {"z", "height", "ht", "h", "of", "the", "at", "above", "base", "line", "bl", "side", "local",
     "main", "upper", "edge", "heights", "centre", "lowest"}
)  # fmt: skip


@attrs.frozen
class ColumnName:
    """What a name says.

    Attributes
    ----------
    kind : str
        "station", "x", "waterline", "buttock", "keel", "deck height", "deck half-breadth",
        "beam" or "area".
    value : float
        Height of a waterline or y of a buttock, in the file's unit; nan for the others.
    unit : str or None
        "m", "mm", "cm", "ft" or "in" where the name says so, "t" for a waterline in draughts.
    named : bool
        Whether a word says the kind; False for a bare number, which is a waterline's height.
    """

    kind: str
    value: float = math.nan
    unit: str | None = None
    named: bool = True


def unit_word(word: str) -> str | None:
    """Give the unit that a word or abbreviation means: "m", "mm", "cm", "ft", "in" or None."""
    unit = _UNIT_OF.get(word.strip(" []().\t").lower())
    return None if unit == "t" else unit


def is_unit(cell: str) -> bool:
    """Tell whether a cell holds a unit and nothing else."""
    return unit_word(cell) is not None


def column_name(label: str) -> ColumnName | None:
    """Give what a name says, None if nothing that is known."""
    name = re.sub(r"(?<=[0-9]),(?=[0-9])", ".", label.lower().strip())
    name = re.sub(r"[\s_\[\]()=:]+", "_", name).strip("_").rstrip(".")
    return _waterline_or_buttock(name) or _single(name)


def _waterline_or_buttock(name: str) -> ColumnName | None:
    if name in _BASE:
        return ColumnName("waterline", 0.0)
    short = _TAIL.sub("", name)
    for kind, pattern in _NUMBERED.items():
        found = pattern.fullmatch(short)
        place = _place(found["rest"]) if found else None
        if place:
            return ColumnName(kind, *place)
    place = _place(short)
    named = short != name or bool(place and place[1])
    return ColumnName("waterline", *place, named=named) if place else None


def _place(text: str) -> tuple[float, str | None] | None:
    """Split a number with a unit, such as ``2.0_m``; feet-inches-eighths are in feet."""
    number = label_number(text.replace("_", " "))
    if number is not None and not math.isnan(number):
        return number, "ft" if re.fullmatch(r"[0-9]+-[0-9]+-[0-9]\+?", text) else None
    found = _UNIT_END.fullmatch(text)
    number = label_number(found["name"].replace("_", " ").strip()) if found else None
    return (number, _UNIT_OF[found["unit"]]) if found and number is not None else None


def _single(name: str) -> ColumnName | None:
    kind = _kind(name)
    found = _UNIT_AFTER.fullmatch(name)
    if kind is None and found:
        kind, unit = _kind(found["name"]), _UNIT_OF[found["unit"]]
        return ColumnName(kind, unit=unit) if kind else None
    return ColumnName(kind) if kind else None


def _kind(name: str) -> str | None:
    letters = re.sub(r"[^a-z]", "", name)
    words = set(re.findall(r"[a-z]+", name))
    if name == "x":
        return "x"
    # Such as "Sta. No."; "2_no" is none.
    if words and words <= _STATION and not re.search(r"[0-9]", name):
        return "station"
    if letters in _BEAM:
        return "beam"
    if letters in _AREA:
        return "area"
    if words & _KEEL and words <= _KEEL | _HEIGHT:
        return "keel"
    if words & _DECK and words <= _DECK | _ACROSS | _HEIGHT:
        return "deck half-breadth" if words & _ACROSS else "deck height"
    return None


def station_label(cell: str) -> bool:
    """Tell whether a cell is named as a station: ``ST 5``, ``Station 9 1/2``, ``Fr. 10``."""
    found = re.fullmatch(r"([a-z]+)\.?[ _]*([-0-9].*)", cell.strip().lower())
    return found is not None and found[1] in _STATION and label_number(found[2]) is not None


def is_corner_of_waterlines(cell: str) -> bool:
    """Tell whether the corner cell says that waterlines go down: stations go across then."""
    return cell.strip().lower().strip("_.") in _ROWS_OF_WATERLINES

"""What the comments of an offset table say: units, particulars, ratios, coefficients, stations.

Numbers in comments may have decimal commas, as cells may. A statement that occurs twice counts the
first time.

Examples
--------
>>> from assoc_hull.io.offsets.hints import read_hints
>>> hints = read_hints(("half-breadths in mm, heights in m", "Lpp = 121,92 m, CB = 0.60"))
>>> hints.units.y, hints.units.z, hints.length, hints.coefficients
('mm', 'm', 121.92, {'CB': 0.6})
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

import attrs

from assoc_hull.io.tables.column_names import unit_word
from assoc_hull.io.units import METRES

__all__ = ["BlockUnits", "OffsetHints", "read_hints"]

_NUMBER = r"([0-9]+(?:[.,][0-9]+)?|[.,][0-9]+)"
_END = r"(FP|AP|fore?ward perpendicular|aft(?:er)? perpendicular)"
_ZERO = re.compile(rf"(?<![0-9.])0\s*(?:=|:|is|at|is at)\s*(?:the\s+)?{_END}", re.IGNORECASE)
_LAST = re.compile(rf"(?<![0-9.])(10|20)\s*(?:=|:|is|at|is at)\s*(?:the\s+)?{_END}", re.IGNORECASE)
_SPACING = re.compile(r"\b(?:Lpp|LBP|L)\s*/\s*([0-9]{1,3})\b", re.IGNORECASE)


@attrs.frozen
class BlockUnits:
    """Units of half-breadths, heights and lengths: "m", "mm", "cm", "ft", "in", "normalised"."""

    y: str | None = None
    z: str | None = None
    x: str | None = None


@attrs.frozen
class OffsetHints:
    """What the comments say; None where they are silent.

    Attributes
    ----------
    units : BlockUnits
        Of each block; one unit for all stands in each.
    station_zero : str or None
        "ap" or "fp".
    divisions : int or None
        Station spacings between the perpendiculars.
    length, breadth, draught, depth : float or None
        Particulars, m.
    length_breadth, breadth_draught : float or None
        Ratios.
    coefficients : mapping of str to float
        Of "CB", "CM", "CP", "CW", those that are told and lie in (0, 1].
    level_spacing : float or None
        Height (m) from one numbered waterline to the next, where "WL 2" is the second.
    rounding : tuple of float
        Half unit of the last digit per waterline, in the table's unit; empty if not given.
    frame_spacing : float or None
        Distance of frames, m, where stations are numbers of frames.
    full : str
        The words by which the numbers are breadths and no half-breadths; "" if there are none.
    """

    units: BlockUnits = BlockUnits()
    station_zero: str | None = None
    divisions: int | None = None
    length: float | None = None
    breadth: float | None = None
    draught: float | None = None
    depth: float | None = None
    length_breadth: float | None = None
    breadth_draught: float | None = None
    coefficients: Mapping[str, float] = attrs.field(factory=dict)
    level_spacing: float | None = None
    rounding: tuple[float, ...] = ()
    frame_spacing: float | None = None
    full: str = ""

    def stated(self) -> Mapping[str, float]:
        """Give all numbers that the comments tell of the hull, by their usual names."""
        every = {
            "Lpp": self.length, "B": self.breadth, "T": self.draught, "D": self.depth,
            "L/B": self.length_breadth, "B/T": self.breadth_draught, **self.coefficients,
        }  # fmt: skip
        found = {name: value for name, value in every.items() if value is not None}
        return MappingProxyType(found)


_LENGTH = r"Lpp|LPP|LBP|L\.?p\.?p\.?|[Ll]ength between perpendiculars"
_BREADTH = r"B|B_?mld|[Bb]readth(?: moulded)?|[Bb]eam(?: moulded)?"
_DRAUGHT = r"T|[Dd]raught|[Dd]raft|[Dd]esign draught|[Dd]esign draft|[Dd]esign waterline z"
_DEPTH = r"D|[Dd]epth(?: moulded)?"


def read_hints(comments: tuple[str, ...]) -> OffsetHints:
    """Read the comments of a table; a statement that occurs twice counts the first time."""
    text = "\n".join(comments)
    last, spacing = _LAST.search(text), _SPACING.search(text)
    divisions = int(last[1]) if last else int(spacing[1]) if spacing else None
    return OffsetHints(
        units=_units(text),
        station_zero=_station_zero(text),
        divisions=divisions or None,
        length=_particular(text, _LENGTH),
        breadth=_particular(text, _BREADTH),
        draught=_particular(text, _DRAUGHT),
        depth=_particular(text, _DEPTH),
        length_breadth=_particular(text, r"L(?:pp)?\s*/\s*B"),
        breadth_draught=_particular(text, r"B\s*/\s*T"),
        coefficients=_coefficients(text),
        level_spacing=_particular(text, r"(?:[Ww]aterline|WL)\s+spacing"),
        rounding=_rounding(text),
        full=_said(_FULL, text),
    )


_FULL = re.compile(
    r"\b(?:full|whole|total)[- ]?(?:breadths|widths|breadth offsets|width offsets)\b", re.IGNORECASE
)


def _said(pattern: re.Pattern[str], text: str) -> str:
    found = pattern.search(text)
    return found[0] if found else ""


# --------------------------------------------------------------------------------------
# Units, of all or of one block.

_WORD = (
    r"mm|millimet(?:re|er)s?|cm|centimet(?:re|er)s?|met(?:re|er)s?|m|feet|foot|ft|inch(?:es)?|"
    r"normali[sz]ed"
)
_STATED = re.compile(
    rf"\bunits?\b[^.;]{{0,20}}?\b(?P<named>{_WORD}|in)(?:\s*[,/]\s*(?P<second>{_WORD}|in))?\b|"
    rf"^\W*(?P<alone>{_WORD})\W*$|"
    rf"\bin (?:the unit )?(?P<plain>{_WORD})\b|(?P<parts>y/\(B/2\)|\bnormali[sz]ed\b)|"
    rf"\b(?P<told>half[- ]?breadths?|heights?|waterlines?)\s*[\[(:=]\s*(?P<of>{_WORD}|in)\b",
    re.IGNORECASE,
)
_OF = {
    "y": re.compile(r"\bhalf[- ]?breadths?|\boffsets?\b|\bordinates?\b|(?<![\w/])y\b", re.I),
    "z": re.compile(r"\bheights?\b|\bwaterlines?\b|(?<![\w/])WLs?\b|(?<![\w/])z\b", re.I),
    "x": re.compile(r"\bstations?\b|\blengths?\b|(?<![\w/])x\b", re.I),
}


def _units(text: str) -> BlockUnits:
    found: dict[str, str] = {}
    for line in text.splitlines():
        end = 0
        for match in _STATED.finditer(line):
            # What a unit belongs to stands in its own clause: "station 0 = AP; unit: mm" is of all.
            marks = "[;.,]" if match["named"] else "[;.]"
            before = re.split(marks, line[end : match.start()])[-1] + (match["told"] or "")
            end = match.end()
            unit = _unit(next(filter(None, match.group("named", "alone", "plain", "parts", "of"))))
            blocks = [block for block, words in _OF.items() if words.search(before)]
            if match["second"]:
                found |= {"y": unit} | found
                found = {"z": _unit(match["second"]), "x": _unit(match["second"])} | found
            for block in ["y", "z", "x"] if match["parts"] or not blocks else blocks:
                found.setdefault(block, unit)
    return BlockUnits(**found)


def _unit(word: str) -> str:
    if word.lower().startswith(("y", "norm")):
        return "normalised"
    return unit_word(word) or "m"


# --------------------------------------------------------------------------------------
# Numbers.


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
    """Give a number behind a name, m; without an equals sign it needs a unit."""
    unit = r"(mm|cm|m|ft|feet|in|inch(?:es)?)"
    head = rf"(?<![\w/.])(?:{names})"
    found = re.search(rf"{head}\s*[=:]\s*{_NUMBER}(?:\s*{unit}\b)?(?![\w/]|[.,][0-9])", text)
    found = found or re.search(rf"{head}\s*(?:[=:]\s*|is\s+|\s){_NUMBER}\s*{unit}\b", text)
    if not found:
        return None
    number, told = found[1], found[2]
    grouped = told == "mm" and re.fullmatch(r"[0-9]{1,3},[0-9]{3}", number)
    value = float(number.replace(",", "" if grouped else "."))
    if not 1e-6 < value < 1e7:
        return None
    metres = METRES[unit_word(told) or "m"] if told else 1.0
    return value * metres


_COEFFICIENTS = {
    "CB": r"CB|Cb|C_B|[Bb]lock coefficient",
    "CM": r"CM|Cm|C_M|CX|Cx|C_X|[Mm]idship (?:section )?coefficient",
    "CP": r"CP|Cp|C_P|[Pp]rismatic coefficient",
    "CW": r"CW|Cw|CWP|Cwp|CWL|C_W|[Ww]aterplane(?: area)? coefficient",
}


def _coefficients(text: str) -> dict[str, float]:
    """Give the coefficients that are told; those outside (0, 1] are kept, to be refused."""
    found = {}
    for name, words in _COEFFICIENTS.items():
        match = re.search(rf"(?<![\w.])(?:{words})\s*(?:=|:|is|of|\s)\s*{_NUMBER}(?![\w])", text)
        if match:
            found[name] = float(match[1].replace(",", "."))
    return found


def _rounding(text: str) -> tuple[float, ...]:
    found = re.search(r"^rounding\s*:((?:[ \t]+[0-9]*[.,]?[0-9]+)+)[ \t]*$", text, re.MULTILINE)
    return tuple(float(word.replace(",", ".")) for word in found[1].split()) if found else ()

"""What the comments above an offset table say about units, frame and particulars.

Examples
--------
>>> from assoc_hull.io.offsets.hints import read_hints
>>> hints = read_hints(("y/(B/2) and z/T; station 0 = FP, 20 = AP", "L/B = 7.5, B/T = 2.5"))
>>> hints.unit, hints.station_zero, hints.divisions, hints.length_breadth
('normalised', 'fp', 20, 7.5)
"""

from __future__ import annotations

import re

import attrs

__all__ = ["Hints", "read_hints"]

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
class Hints:
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


def read_hints(comments: tuple[str, ...]) -> Hints:
    """Read the comments of a table; a statement that occurs twice counts the first time."""
    text = "\n".join(comments)
    last, spacing = _LAST.search(text), _SPACING.search(text)
    divisions = int(last[1]) if last else int(spacing[1]) if spacing else None
    return Hints(
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

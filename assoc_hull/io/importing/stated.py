"""What a file says of its ship in words: ratios, coefficients, LCB, volume, from its comments.

Nothing is taken from here: the readers take unit, frame and dimensions themselves. What was read
is measured, and compared with what the file says of it.

Examples
--------
>>> from assoc_hull.io.importing.stated import read_stated
>>> read_stated("# L/B=7.5, B/T = 2.5, CB 0,60")
{'L/B': (7.5, 0.05), 'B/T': (2.5, 0.05), 'CB': (0.6, 0.005)}
"""

from __future__ import annotations

import re
from pathlib import Path

from assoc_hull.arguments import regular_file
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.table_text import read_text

__all__ = ["read_stated", "stated_in"]

_HEAD = 20_000
"""So many bytes are read: whatever a file says of itself stands at its beginning."""

_WORKBOOK = b"PK\x03\x04"
_BINARY = re.compile(rb"[\x00-\x08]")
_NUMBER = r"([-+]?[0-9]*[.,]?[0-9]+)(?![0-9]|[.,][0-9])"
_SAYS = r"\s*(?:=|:|is|of)?\s*"
_FIGURES = {
    "L/B": r"L(?:pp|wl)?\s*/\s*B", "B/T": r"B\s*/\s*T",
    "CB": r"C_?[Bb]|block coefficient", "CM": r"C_?[Mm]|midship(?: section)? coefficient",
    "CX": r"C_?[Xx]", "CP": r"C_?[Pp]|prismatic coefficient",
    "CW": r"C_?[Ww][Pp]?|waterplane(?: area)? coefficient",
}  # fmt: skip
_PLAIN = {
    name: re.compile(rf"(?<![\w/])(?:{words})(?![\w/]){_SAYS}{_NUMBER}")
    for name, words in _FIGURES.items()
}
_LCB = re.compile(rf"(?<![\w/])(?:LCB|lcb){_SAYS}{_NUMBER}\s*%")
_VOLUME = re.compile(
    rf"(?<![\w/])(?:V|[Vv]ol(?:ume)?|[Dd]isplaced volume|\u2207){_SAYS}([0-9]+(?:[.,][0-9]+)?)"
    r"\s*(?:m3|m\^3|m\u00b3)"
)
_MARK = re.compile(r'^\s*"?\s*(?:#+|//|;|\*|!|%)\s?(.*)$', re.MULTILINE)


def stated_in(path: Path) -> dict[str, tuple[float, float]]:
    """Give what the comments of a file say, as `read_stated`; nothing of one that is no text."""
    with regular_file(path).open("rb") as file:
        head = file.read(_HEAD)
    if head.startswith(_WORKBOOK):
        return read_stated(read_text(path, Notebook())[0])
    return {} if _BINARY.search(head) else read_stated(head.decode("utf-8", "replace"))


def read_stated(text: str) -> dict[str, tuple[float, float]]:
    """Give the figures in the comments of a text by name, each with its half unit of rounding.

    The first statement counts. LCB is in per cent of the length from midship, V in m3.
    """
    said = "\n".join(_MARK.findall(text))
    patterns = {**_PLAIN, "LCB": _LCB, "V": _VOLUME}
    found = {name: pattern.search(said) for name, pattern in patterns.items()}
    return {name: _value(match[1]) for name, match in found.items() if match}


def _value(number: str) -> tuple[float, float]:
    plain = number.replace(",", ".")
    decimals = len(plain.partition(".")[2])
    return float(plain), 0.5 * 10.0**-decimals

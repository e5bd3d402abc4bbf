"""What a file says of its ship in words: ratios, coefficients, LCB, volume, from its comments.

Nothing of that is taken: what was read is measured, and compared with what the file says of it.
Particulars of digitised lines are taken: Lpp, B, T and D as comments, texts of a drawing or the
title of a form state them. The readers of tables take their own.

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
from assoc_hull.io.export.britfair import is_britfair
from assoc_hull.io.export.ghs_geometry import is_gf
from assoc_hull.io.lines.ship_frame import StatedPlaces
from assoc_hull.io.offsets.hints import read_hints
from assoc_hull.io.read_file import as_utf8
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.table_text import read_text

__all__ = ["read_stated", "stated_in", "stated_places"]

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
# Within one line: \s* would run over empty ones, again from each of them.
_MARK = re.compile(r'^[ \t]*"?[ \t]*(?:#+|//|;|\*|!|%)[ \t]?(.*)$', re.MULTILINE)


def stated_in(path: Path) -> dict[str, tuple[float, float]]:
    """Give what the comments of a file say, as `read_stated`; nothing of one that is no text."""
    with regular_file(path).open("rb") as file:
        head = as_utf8(file.read(_HEAD))
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


_DXF = re.compile(r"\A(?:[ \t]*999[ \t]*\r?\n.*\n)*\s*0[ \t]*\r?\n[ \t]*SECTION")
_DXF_TEXT = re.compile(r"^[ \t]*(?:999|1)[ \t]*\r?\n(.*?)\r?$", re.MULTILINE)
_GF_TEXT = re.compile(r"^\\(.*)$", re.MULTILINE)
_MOST = 200_000_000


def stated_places(path: Path) -> StatedPlaces:
    """Give the particulars that comments and titles of digitised lines state, m.

    These are rows of comments, in DXF also the texts that are drawn, in GF comments and in
    BRITFAIR the title. Of other forms nothing is known.
    """
    file = regular_file(path)
    if not file.is_file() or file.stat().st_size > _MOST:
        return StatedPlaces()
    data = as_utf8(file.read_bytes())
    if _BINARY.search(data[:_HEAD]):
        return StatedPlaces()
    text = data.decode("utf-8", "replace").lstrip("\ufeff")
    if _DXF.match(text):
        words = _DXF_TEXT.findall(text)
    elif is_gf(text):
        words = [text.partition("\n")[0], *_GF_TEXT.findall(text)]
    elif is_britfair(text):
        words = [text.partition("\n")[0]]
    else:
        words = _MARK.findall(text[:_HEAD])
    said = read_hints(tuple(words))
    names = ("length", "breadth", "draught", "depth")
    return StatedPlaces(**{name: getattr(said, name) for name in names})


def _value(number: str) -> tuple[float, float]:
    plain = number.replace(",", ".")
    decimals = len(plain.partition(".")[2])
    return float(plain), 0.5 * 10.0**-decimals

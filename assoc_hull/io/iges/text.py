"""An IGES file as lines of five sections, and its free-format text as tokens.

A line has 80 columns: 72 of content, the letter of its section, and its number in the section.
Start (S) is for people, Global (G) holds units and delimiters, Directory (D) two lines an entity,
Parameter (P) what each entity is made of, Terminate (T) the number of lines of all.

Source: IGES 5.3 (US PRO, 1996), sections 2.2.2 and 2.2.4.

Examples
--------
>>> from assoc_hull.io.iges.text import Hollerith, tokens
>>> tokens("1H,,1H;,4Hab,c,1.5D1;", ",", ";", "here")
[',', ';', 'ab,c', '1.5D1']
>>> [isinstance(each, Hollerith) for each in tokens("4H1.5;,1.5;", ",", ";", "here")]
[True, False]
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import attrs

from assoc_hull.errors import BadInputError

__all__ = ["Hollerith", "Sections", "looks_like_iges", "sections_of", "tokens"]

_WIDTH, _CONTENT = 80, 72
_LETTERS = "SGDPT"
_COUNTED = re.compile(r" *([SGDP]) *([0-9]{1,7})")
_TEXT = re.compile(r" *([0-9]{1,6})H")
_NEEDED = {"G": "global", "D": "directory", "P": "parameter"}


class Hollerith(str):
    """Text of a file, which was written with the number of its letters: ``4Hname``."""

    __slots__ = ()


@attrs.frozen(eq=False)
class Sections:
    """The content of a file, 72 columns a line, section by section.

    Attributes
    ----------
    source : str
        Name of the file, for messages.
    lines : mapping of str to list of str
        By letter: S, G, D, P and T. Lines of P have all 80 columns.
    """

    source: str
    lines: dict[str, list[str]]


def looks_like_iges(text: str) -> bool:
    """Tell whether a text begins as an IGES file does, or as one of its two rare forms.

    Examples
    --------
    >>> from assoc_hull.io.iges.text import looks_like_iges
    >>> looks_like_iges(f"{'A plate':72}S      1"), looks_like_iges("patch,i_u,j_v,x,y,z")
    (True, False)
    """
    head = next((line for line in text[:2000].splitlines() if line.strip()), "")
    return len(head) > _CONTENT and re.fullmatch(r"[SCB] *[0-9]+ *", head[72:80]) is not None


def sections_of(text: str, source: str) -> Sections:
    """Part a file into its sections, and see that no line is missing.

    Parameters
    ----------
    text : str
        The whole file.
    source : str
        Its name, for messages.

    Raises
    ------
    BadInputError
        A line of no section, sections out of order, lines missing, a file that is cut short.
    """
    found: dict[str, list[str]] = {letter: [] for letter in _LETTERS}
    last = 0
    for number, line in _numbered(text):
        letter = line[_CONTENT : _CONTENT + 1]
        place = _LETTERS.find(letter) if letter.strip() else -1
        if place < 0:
            raise _unknown_line(number, line, source)
        if place < last:
            what = f"a line of section {letter} comes after section {_LETTERS[last]}"
            raise _damaged(what, f"{source}, line {number}")
        last = place
        _require_next(line, letter, len(found[letter]) + 1, number, source)
        found[letter].append(line if letter == "P" else line[:_CONTENT])
    _require_whole(found, source)
    return Sections(source, found)


def _numbered(text: str) -> Iterator[tuple[int, str]]:
    """Give lines that hold something, with their numbers; records without ends of line too."""
    lines = text.split("\n") if "\n" in text else text.split("\r")
    if len(lines) == 1 and len(text) > 2 * _WIDTH:
        lines = [text[at : at + _WIDTH] for at in range(0, len(text), _WIDTH)]
    for number, line in enumerate(lines, start=1):
        if line.strip(" \r\t\x1a"):
            yield number, line.rstrip("\r\n").ljust(_WIDTH)


def _unknown_line(number: int, line: str, source: str) -> BadInputError:
    where = f"{source}, line {number}"
    if number == 1 and line[_CONTENT] in "CB":
        kind = {"C": "compressed text", "B": "binary"}[line[_CONTENT]]
        return BadInputError(f"this is IGES as {kind}", where, "export it as plain text (ASCII)")
    what = f"column 73 holds {line[_CONTENT : _CONTENT + 1]!r}, no letter of a section"
    return _damaged(what, where)


def _damaged(what: str, where: str) -> BadInputError:
    return BadInputError(what, where, "the file is damaged or cut short: export or copy it again")


def _require_next(line: str, letter: str, wanted: int, number: int, source: str) -> None:
    """See that a line is numbered as the next one of its section."""
    if letter == "T":
        return
    match = _COUNTED.match(line[_CONTENT:_WIDTH])
    if match is None or int(match[2]) != wanted:
        shown = line[_CONTENT + 1 : _WIDTH].strip()
        what = f"line {wanted} of section {letter} is numbered {shown!r}"
        raise _damaged(what, f"{source}, line {number}")


def _require_whole(found: dict[str, list[str]], source: str) -> None:
    """See that all sections are there, with as many lines as the last one says."""
    for letter, name in _NEEDED.items():
        if not found[letter]:
            raise _damaged(f"the {name} section is missing", f"in {source}")
    if not found["T"]:
        raise _damaged("the last line, of section T, is missing", f"in {source}")
    if len(found["D"]) % 2:
        what = f"the directory has {len(found['D'])} lines, and an entity two"
        raise _damaged(what, f"in {source}")
    for letter, count in re.findall(r"([SGDP]) *([0-9]+)", found["T"][0]):
        if int(count) != len(found[letter]):
            what = f"section {letter} has {len(found[letter])} lines, and section T says {count}"
            raise _damaged(what, f"in {source}")


def tokens(text: str, delimiter: str, end: str, where: str) -> list[str]:
    """Part free-format text at its delimiters; text comes as `Hollerith`.

    Parameters
    ----------
    text : str
        From the first value on; what comes after the end is left.
    delimiter, end : str
        What stands between values, and behind the last.
    where : str
        For messages.

    Raises
    ------
    BadInputError
        There is no end, or less text than was announced.
    """
    if "H" not in text:
        body, found, _ = text.partition(end)
        if not found:
            raise _damaged(f"no {end!r} ends the values", where)
        return [each.strip() for each in body.split(delimiter)]
    marks = re.compile(f"[{re.escape(delimiter)}{re.escape(end)}]")
    values: list[str] = []
    at = 0
    while True:
        value, stop = _value(text, at, marks, end, where)
        values.append(value)
        if text[stop] == end:
            return values
        at = stop + 1


def _value(text: str, at: int, marks: re.Pattern[str], end: str, where: str) -> tuple[str, int]:
    """Give the value that begins at a place, and the place of the mark behind it."""
    announced = _TEXT.match(text, at)
    after = at if announced is None else announced.end() + int(announced[1])
    mark = marks.search(text, after)
    if mark is None or after > len(text):
        raise _damaged(f"no {end!r} ends the values", where)
    rest = text[after : mark.start()].strip()
    if announced is None:
        return rest, mark.start()
    if rest:
        what = f"behind a text of {announced[1]} letters stands {rest[:20]!r}"
        raise _damaged(what, where)
    return Hollerith(text[announced.end() : after]), mark.start()

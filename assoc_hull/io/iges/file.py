"""An IGES file: its lines and sections, its directory, and the checked parameters of its entities.

`IgesFile` reads the directory; parameters of an entity (`IgesRecord`) are split and checked when
they are asked for: whole numbers, reals, pointers, text. A damaged file is refused with the line.

Source: IGES 5.3 (US PRO, 1996), sections 2.2.1 to 2.2.4.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Self

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "UNITS",
    "DirectoryEntry",
    "Hollerith",
    "IgesFile",
    "IgesRecord",
    "IgesSections",
    "looks_like_iges",
    "split_sections",
    "split_tokens",
]

# --------------------------------------------------------------------------------------
# Sections and tokens. A line has 80 columns: 72 of content, the letter of its section, and its
# number in the section. Start (S) is for people, Global (G) holds units and delimiters, Directory
# (D) two lines an entity, Parameter (P) what each entity is made of, Terminate (T) the number of
# lines of all.

_WIDTH, _CONTENT = 80, 72
_LETTERS = "SGDPT"
_COUNTED = re.compile(r" *([SGDP]) *([0-9]{1,7})")
_TEXT = re.compile(r" *([0-9]{1,6})H")
_NEEDED = {"G": "global", "D": "directory", "P": "parameter"}


class Hollerith(str):
    """Text of a file, which was written with the number of its letters: ``4Hname``."""

    __slots__ = ()


@attrs.frozen(eq=False)
class IgesSections:
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
    >>> from assoc_hull.io.iges.file import looks_like_iges
    >>> looks_like_iges(f"{'A plate':72}S      1"), looks_like_iges("patch,i_u,j_v,x,y,z")
    (True, False)
    """
    head = next((line for line in text[:2000].splitlines() if line.strip()), "")
    return len(head) > _CONTENT and re.fullmatch(r"[SCB] *[0-9]+ *", head[72:80]) is not None


def split_sections(text: str, source: str) -> IgesSections:
    """Split a file into its sections, and check that no line is missing.

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
    return IgesSections(source, found)


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
    """Check that a line is numbered as the next one of its section."""
    if letter == "T":
        return
    match = _COUNTED.match(line[_CONTENT:_WIDTH])
    if match is None or int(match[2]) != wanted:
        shown = line[_CONTENT + 1 : _WIDTH].strip()
        what = f"line {wanted} of section {letter} is numbered {shown!r}"
        raise _damaged(what, f"{source}, line {number}")


def _require_whole(found: dict[str, list[str]], source: str) -> None:
    """Check that all sections are there, with as many lines as section T says."""
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


def split_tokens(text: str, delimiter: str, end: str, where: str) -> list[str]:
    """Split free-format text at its delimiters, up to `end`; text comes as `Hollerith`.

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
    """Give the value that begins at `at`, and the place of the delimiter behind it."""
    # The letters of a text are counted: delimiters among them do not end it.
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


# --------------------------------------------------------------------------------------
# Parameters of an entity.

_REAL = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][-+]?[0-9]{1,3})?")
_WHOLE = re.compile(r"[-+]?[0-9]{1,9}")
_AGAIN = "export the file again"


@attrs.frozen(eq=False)
class IgesRecord:
    """Values of an entity, its type first; what a file leaves out at the end counts as blank.

    Attributes
    ----------
    values : list of str
        As they stand in the file.
    where : str
        For messages.
    """

    values: list[str]
    where: str

    def __len__(self) -> int:
        """Count the values."""
        return len(self.values)

    def whole(self, place: int, what: str, default: int | None = None) -> int:
        """Give the whole number at `place`, `default` where it is blank; the type has place 0.

        Raises
        ------
        BadInputError
            Something else stands there.
        """
        text = self.values[place] if place < len(self.values) else ""
        if not text and default is not None:
            return default
        if isinstance(text, Hollerith) or not _WHOLE.fullmatch(text):
            raise BadInputError(f"{what} is {text[:20]!r}, no whole number", self.where, _AGAIN)
        return int(text)

    def count(self, place: int, what: str, most: int) -> int:
        """Give a whole number from 0 up to a limit; raises as `whole`."""
        found = self.whole(place, what)
        if not 0 <= found <= most:
            raise BadInputError(f"{what} is {found}", self.where, f"0 to {most} can be read")
        return found

    def pointers(self, place: int, count: int, what: str) -> tuple[int, ...]:
        """Give the numbers of other entities, 0 where there is none; raises as `whole`."""
        self._require(place, count, what)
        return tuple(abs(self.whole(at, what, default=0)) for at in range(place, place + count))

    def reals(self, place: int, count: int, what: str, default: float = 0.0) -> FloatArray:
        """Give real numbers, (count,); what is left out is the default.

        Raises
        ------
        BadInputError
            There are fewer, or something else stands there.
        """
        self._require(place, count, what)
        texts = self.values[place : place + count]
        wrong = next(
            (text for text in texts if text and (
                isinstance(text, Hollerith) or not _REAL.fullmatch(text))), None,
        )  # fmt: skip
        if wrong is not None:
            raise BadInputError(f"{what}: {wrong[:20]!r} is no number", self.where, _AGAIN)
        words = [text.translate(_EXPONENT) if text else repr(default) for text in texts]
        found = np.array(words, dtype=np.float64)
        if not np.isfinite(found).all():
            raise BadInputError(f"{what} holds a number without limit", self.where, _AGAIN)
        return found

    def text(self, place: int) -> str:
        """Give text, empty if there is none."""
        found = self.values[place] if place < len(self.values) else ""
        return found.strip() if isinstance(found, Hollerith) else ""

    def _require(self, place: int, count: int, what: str) -> None:
        if place + count > len(self.values):
            there = max(len(self.values) - place, 0)
            missing = f"{what}: {count} values are wanted, and {there} are there"
            raise BadInputError(missing, self.where, _AGAIN)


_EXPONENT = str.maketrans("dD", "ee")  # Fortran writes 1.5D+01


# --------------------------------------------------------------------------------------
# The directory. Source: IGES 5.3, sections 2.2.4.3 (global) and 2.2.4.4 (directory).

UNITS: Mapping[int, tuple[str, float]] = {
    1: ("in", 0.0254), 2: ("mm", 1e-3), 4: ("ft", 0.3048), 5: ("mi", 1609.344), 6: ("m", 1.0),
    7: ("km", 1e3), 8: ("mil", 2.54e-5), 9: ("um", 1e-6), 10: ("cm", 1e-2), 11: ("uin", 2.54e-8),
}  # fmt: skip
"""Flags of units in the global section: name, and length in m."""

_COLUMN = 8  # columns of a field of the directory
_SCALE, _UNIT = 12, 13
"""Places of two values in the global section, from 0."""

_GLOBALS = 26
"""Values that a global section may have; those at its end may be left out."""


@attrs.frozen
class DirectoryEntry:
    """What the directory says of an entity.

    Attributes
    ----------
    number : int
        Of its first line in the directory: what pointers hold.
    kind, form : int
        Type of entity, as 128, and its form.
    first, count : int
        Its lines in the parameter section: the first, from 1, and how many.
    transformation : int
        Number of the entity 124 that moves it; 0 if none.
    blanked : bool
        Whether it is hidden.
    dependent : bool
        Whether it is but part of another entity.
    label : str
        Up to eight letters; may be empty.
    """

    number: int
    kind: int
    form: int
    first: int
    count: int
    transformation: int
    blanked: bool
    dependent: bool
    label: str


@attrs.frozen(eq=False)
class IgesFile:
    """A file whose directory has been read; parameters are taken apart when they are asked for.

    Attributes
    ----------
    source : str
        Name of the file, for messages.
    entries : mapping of int to DirectoryEntry
        By number.
    unit : int
        The flag of the unit; 0 where the file has none, 3 where it has a name only.
    metres : float or None
        Length of the unit, in m; None if the flag does not tell.
    scale : float
        Lengths in the file over those of the ship.
    """

    source: str
    entries: dict[int, DirectoryEntry]
    unit: int
    metres: float | None
    scale: float
    _lines: list[str]
    _marks: tuple[str, str]

    @classmethod
    def of_text(cls, text: str, source: str) -> Self:
        """Take a file apart.

        Raises
        ------
        BadInputError
            It is damaged, cut short, or no plain IGES.
        """
        sections = split_sections(text, source)
        where = f"{source}, global section"
        head = "".join(sections.lines["G"])
        marks = _marks(head, where)
        values = split_tokens(head, *marks, where)
        given = IgesRecord([*values, *[""] * _GLOBALS], where)
        unit = given.whole(_UNIT, "the flag of the unit", default=0)
        metres = UNITS[unit][1] if unit in UNITS else None
        lines = sections.lines["P"]
        return cls(source, _directory(sections), unit, metres, _scale(given), lines, marks)

    def record(self, number: int) -> IgesRecord:
        """Give the parameters of the entity of a directory number.

        Raises
        ------
        BadInputError
            There is none of this number, or its lines are missing or belong to another.
        """
        if number not in self.entries:
            what = f"there is no entity D{number}"
            raise BadInputError(what, f"in {self.source}", "export the file again")
        entry = self.entries[number]
        where = self.where(entry)
        lines = self._lines[entry.first - 1 : entry.first - 1 + entry.count]
        if entry.first < 1 or not lines or len(lines) < entry.count:
            what = (
                f"its {entry.count} parameter lines from {entry.first} on are not there: the file "
                f"has {len(self._lines)}"
            )
            raise BadInputError(what, where, "export the file again")
        self._require_own(entry, lines, where)
        values = split_tokens("".join(line[:64] for line in lines), *self._marks, where)
        if values[0] != str(entry.kind):
            what = f"its parameters are of an entity {values[0][:8]!r}"
            raise BadInputError(what, where, "export the file again")
        return IgesRecord(values, where)

    def where(self, entry: DirectoryEntry) -> str:
        """Say in a message which entity is meant."""
        return f"{self.source}, entity {entry.kind} (D{entry.number})"

    def _require_own(self, entry: DirectoryEntry, lines: list[str], where: str) -> None:
        """Check that lines name their entity (columns 65 to 72); a blank says nothing."""
        for line in lines:
            owner = line[64:72].strip()
            if owner and owner.lstrip("0") != str(entry.number):
                what = f"parameter line {line[73:80].strip()} belongs to D{owner[:8]}"
                raise BadInputError(what, where, "export the file again")


def _marks(head: str, where: str) -> tuple[str, str]:
    """Read the delimiters that the global section begins with: as given, or comma and semicolon."""
    match = re.match(r" *1H(.)\1", head)
    delimiter = match[1] if match else ","
    at = match.end() if match else 1
    if match is None and not re.match(r" *,", head):
        what = f"the section begins with {head[:10]!r}, which tells no delimiter"
        raise BadInputError(what, where, "export the file again")
    second = re.match(r" *1H(.)", head[at:])
    end = second[1] if second else ";"
    if delimiter == end or set(delimiter + end) & set("0123456789+-.DEH "):
        what = f"{delimiter!r} and {end!r} cannot part values"
        raise BadInputError(what, where, "export the file again")
    return delimiter, end


def _scale(given: IgesRecord) -> float:
    """Give the scale of the model; 1 where it is left out."""
    scale = float(given.reals(_SCALE, 1, "the scale", default=1.0)[0])
    if not 1e-6 <= scale <= 1e6:
        what = f"the scale of the model is {scale:g}"
        raise BadInputError(what, given.where, "give a scale from 1e-6 to 1e6")
    return scale


def _directory(sections: IgesSections) -> dict[int, DirectoryEntry]:
    """Read all entries of the directory."""
    lines = sections.lines["D"]
    return {
        at + 1: _entry(at + 1, lines[at], lines[at + 1], sections.source)
        for at in range(0, len(lines), 2)
    }


def _entry(number: int, first: str, second: str, source: str) -> DirectoryEntry:
    fields = [line[at : at + _COLUMN] for line in (first, second) for at in range(0, 72, _COLUMN)]
    where = f"{source}, directory entry D{number}"

    def whole(place: int, what: str) -> int:
        text = fields[place].strip()
        if not re.fullmatch(r"[-+]?[0-9]*", text) or text in ("+", "-"):
            what = f"{what} is {fields[place]!r}"
            raise BadInputError(what, where, "export the file again")
        return int(text or 0)

    status = f"{whole(8, 'the status'):08d}"
    subscript = fields[17].strip()
    label = fields[16].strip()
    return DirectoryEntry(
        number, whole(0, "the type"), whole(13, "the form"), whole(1, "the parameter pointer"),
        whole(12, "the number of parameter lines"), abs(whole(6, "the transformation")),
        status[-8:-6] == "01", status[-6:-4] in ("01", "03"),
        f"{label} {subscript}".strip() if label and subscript not in ("", "0") else label,
    )  # fmt: skip

"""The entities of an IGES file: the directory, the parameters of each, units and scale.

Source: IGES 5.3 (US PRO, 1996), sections 2.2.4.3 (global) and 2.2.4.4 (directory).

Examples
--------
>>> from assoc_hull.io.iges.file import IgesFile
>>> from assoc_hull.io.iges.write import iges_text
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> file = IgesFile.of_text(iges_text([plate]), "plate.igs")
>>> file.metres, [entry.kind for entry in file.entries.values()]
(1.0, [128, 406])
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Self

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.io.iges.record import Record
from assoc_hull.io.iges.text import Sections, sections_of, tokens

__all__ = ["UNITS", "Entry", "IgesFile"]

UNITS: Mapping[int, tuple[str, float]] = {
    1: ("in", 0.0254), 2: ("mm", 1e-3), 4: ("ft", 0.3048), 5: ("mi", 1609.344), 6: ("m", 1.0),
    7: ("km", 1e3), 8: ("mil", 2.54e-5), 9: ("um", 1e-6), 10: ("cm", 1e-2), 11: ("uin", 2.54e-8),
}  # fmt: skip
"""Flags of units in the global section: name, and length in m."""

_COLUMN = 8
_SCALE, _UNIT = 12, 13
"""Places of two values in the global section, from 0."""

_GLOBALS = 26
"""Values that a global section may have; those at its end may be left out."""


@attrs.frozen
class Entry:
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
    entries : mapping of int to Entry
        By number.
    unit : int
        The flag of the unit; 0 where the file has none, 3 where it has a name only.
    metres : float or None
        Length of the unit, in m; None if the flag does not tell.
    scale : float
        Lengths in the file over those of the ship.
    """

    source: str
    entries: dict[int, Entry]
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
        sections = sections_of(text, source)
        where = f"{source}, global section"
        head = "".join(sections.lines["G"])
        marks = _marks(head, where)
        values = tokens(head, *marks, where)
        given = Record([*values, *[""] * _GLOBALS], where)
        unit = given.whole(_UNIT, "the flag of the unit", default=0)
        metres = UNITS[unit][1] if unit in UNITS else None
        lines = sections.lines["P"]
        return cls(source, _directory(sections), unit, metres, _scale(given), lines, marks)

    def record(self, number: int) -> Record:
        """Give the parameters of an entity.

        Parameters
        ----------
        number : int
            Of its directory entry.

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
        values = tokens("".join(line[:64] for line in lines), *self._marks, where)
        if values[0] != str(entry.kind):
            what = f"its parameters are of an entity {values[0][:8]!r}"
            raise BadInputError(what, where, "export the file again")
        return Record(values, where)

    def where(self, entry: Entry) -> str:
        """Say in a message which entity is meant."""
        return f"{self.source}, entity {entry.kind} (D{entry.number})"

    def _require_own(self, entry: Entry, lines: list[str], where: str) -> None:
        """See that the lines say whose they are; a blank says nothing."""
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


def _scale(given: Record) -> float:
    """Give the scale of the model; 1 where it is left out."""
    scale = float(given.reals(_SCALE, 1, "the scale", default=1.0)[0])
    if not 1e-6 <= scale <= 1e6:
        what = f"the scale of the model is {scale:g}"
        raise BadInputError(what, given.where, "give a scale from 1e-6 to 1e6")
    return scale


def _directory(sections: Sections) -> dict[int, Entry]:
    """Read all entries of the directory."""
    lines = sections.lines["D"]
    return {
        at + 1: _entry(at + 1, lines[at], lines[at + 1], sections.source)
        for at in range(0, len(lines), 2)
    }


def _entry(number: int, first: str, second: str, source: str) -> Entry:
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
    return Entry(
        number, whole(0, "the type"), whole(13, "the form"), whole(1, "the parameter pointer"),
        whole(12, "the number of parameter lines"), abs(whole(6, "the transformation")),
        status[-8:-6] == "01", status[-6:-4] in ("01", "03"),
        f"{label} {subscript}".strip() if label and subscript not in ("", "0") else label,
    )  # fmt: skip

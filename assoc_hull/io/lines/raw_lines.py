"""Lines as a file gives them, before unit and axes are settled.

A `RawPiece` is one polyline in the unit of the file; `RawLines` are all of a text. `TextRows` walks
through the lines of a text and keeps where it stands, so that errors name the place.
"""

from __future__ import annotations

import re

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.lines.ship_frame import StatedPlaces

__all__ = [
    "BOUNDARIES",
    "OTHER_FAMILIES",
    "RawLines",
    "RawPiece",
    "TextRows",
    "boundary_name",
    "plane_name",
    "read_number",
    "refuse_retraced",
    "whole_number",
]

# --------------------------------------------------------------------------------------
# Polylines, and the numbers they are made of.

BOUNDARIES = ("profile", "deck edge", "transom")
"""Names of boundary curves among digitised lines."""

_PART_ENDS = tuple(f"{part} end" for part in ("bossing", "boss", "skeg", "nozzle", "tunnel", "bow"))
"""Edges in which a part ends across the ship, from the centre line to it: boundary curves, too."""

OTHER_FAMILIES = ("diagonals", "boundary")
"""Families whose other curves are drawn beside digitised lines, and are none."""


def boundary_name(name: str) -> str | None:
    """Give the boundary curve that a line is by its name, None for other lines.

    Files of ours put the family before it.

    Examples
    --------
    >>> from assoc_hull.io.lines.raw_lines import boundary_name
    >>> [boundary_name(each) for each in ("Deck edge", "boundary: bossing end", "ST 2")]
    ['deck edge', 'bossing end', None]
    """
    plain = " ".join(name.lower().removeprefix("boundary:").split())
    return plain if plain in (*BOUNDARIES, *_PART_ENDS) else None


_LARGEST = 1e9
"""No coordinate exceeds this in any unit."""

_VISITS = 3
"""A polyline that comes to one place more often than this goes over itself again and again."""


@attrs.frozen(eq=False)
class RawPiece:
    """One polyline as the file gives it.

    Attributes
    ----------
    line : str
        Name of the line it belongs to.
    points : (n, 3)
        In the unit of the file.
    where : str
        Row or entity, for messages.
    knuckles : (k, 3)
        Places that the file marks as knuckles, in its unit.
    """

    line: str
    points: FloatArray
    where: str
    knuckles: FloatArray = attrs.field(factory=lambda: np.zeros((0, 3)))


def read_number(cell: str, where: str, *, comma: bool = False) -> float:
    """Read a finite number that a ship may have; `comma`: a comma may be the decimal sign.

    Raises
    ------
    BadInputError
        The text is no finite number, or one that no ship has.

    Examples
    --------
    >>> from assoc_hull.io.lines.raw_lines import read_number
    >>> read_number("1,5", "row 2", comma=True)
    1.5
    """
    text = cell.strip()
    try:
        value = float(text.replace(",", ".") if comma else text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise BadInputError(f"{shown(cell)} is no number", where, "correct the cell")
    if abs(value) > _LARGEST:
        raise BadInputError(f"{shown(cell)} is too large for a ship", where, "correct the cell")
    return value


def refuse_retraced(piece: RawPiece) -> None:
    """Refuse a polyline that runs over its own points again and again.

    Raises
    ------
    BadInputError
        It does: rows of the file were written many times.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.io.lines.raw_lines import RawPiece, refuse_retraced
    >>> refuse_retraced(RawPiece("WL 1", np.array([[0.0, 0, 1], [5, 2, 1], [9, 0, 1]]), "row 2"))
    """
    apart = np.append(True, (np.diff(piece.points, axis=0) != 0.0).any(axis=1))
    places, counts = np.unique(piece.points[apart], axis=0, return_counts=True)
    most = int(np.argmax(counts))
    if counts[most] > _VISITS:
        x, y, z = places[most].tolist()
        raise BadInputError(
            f"{piece.line} comes to ({x:.4g}, {y:.4g}, {z:.4g}) {counts[most]} times",
            f"in {piece.where}", "take out the rows that were written again",
        )  # fmt: skip


# --------------------------------------------------------------------------------------
# What readers of texts share.

_SHORT = {"sections": "ST", "waterlines": "WL", "buttocks": "BTK"}


@attrs.frozen(eq=False)
class RawLines:
    """All pieces of a text.

    Attributes
    ----------
    pieces : list of RawPiece
        In ship axes, in the unit of the file.
    unit : str or None
        "m" or "ft" where the form has it; None where it does not say.
    told : bool
        Whether the form stands for its unit. Headers of drawings do not: many hold the one with
        which the program began.
    stated : StatedPlaces
        Where the form says that perpendiculars and base line are, in the unit of the file.
    """

    pieces: list[RawPiece]
    unit: str | None = None
    told: bool = True
    stated: StatedPlaces = attrs.field(factory=StatedPlaces)


def plane_name(group: str, offset: float) -> str:
    """Name a line by its place.

    Examples
    --------
    >>> from assoc_hull.io.lines.raw_lines import plane_name
    >>> plane_name("sections", 60.96)
    'ST 60.96'
    """
    return f"{_SHORT[group]} {round(offset, 6) + 0.0:.10g}"


def whole_number(cell: str, where: str) -> int:
    """Read a whole number of at most nine digits.

    Raises
    ------
    BadInputError
        The text is none.

    Examples
    --------
    >>> from assoc_hull.io.lines.raw_lines import whole_number
    >>> whole_number(" 12", "line 3 of a.gf")
    12
    """
    if not re.fullmatch(r"\s*[-+]?[0-9]{1,9}\s*", cell):
        raise BadInputError(f"{shown(cell)} is no whole number", where, "correct the line")
    return int(cell)


@attrs.define
class TextRows:
    """The lines of a text one after the other, without blank ones; says where it stands.

    Attributes
    ----------
    lines : list of (int, str)
        Number in the file, from 1, and text.
    source : str
        The file.
    ending : str
        How a whole file ends, for messages.
    at : int
        The next line.
    """

    lines: list[tuple[int, str]]
    source: str
    ending: str
    at: int = 0

    @classmethod
    def of(cls, text: str, source: str, ending: str) -> TextRows:
        """Take the lines of a text that are not blank."""
        every = enumerate(text.lstrip("\ufeff").splitlines(), start=1)
        return cls([(k, line) for k, line in every if line.strip()], source, ending)

    @property
    def where(self) -> str:
        """Where the line that was read last stands."""
        at = max(min(self.at, len(self.lines)) - 1, 0)
        return f"line {self.lines[at][0]} of {self.source}" if self.lines else f"in {self.source}"

    @property
    def left(self) -> int:
        """How many lines are left."""
        return len(self.lines) - self.at

    def peek(self) -> str:
        """Give the next line without reading it, empty at the end."""
        return self.lines[self.at][1] if self.left > 0 else ""

    def next(self, what: str) -> str:
        """Read a line.

        Raises
        ------
        BadInputError
            The text ends before.
        """
        if self.left <= 0:
            raise BadInputError(
                f"the text ends where {what} is expected", f"at {self.where}",
                f"take a whole file: it ends with {self.ending}",
            )  # fmt: skip
        self.at += 1
        return self.lines[self.at - 1][1]

    def numbers(self, what: str, least: int, mark: str | None = None) -> list[float]:
        """Read a line and give its first `least` numbers.

        `mark` separates them, blanks if None; `what` they are is for messages.

        Raises
        ------
        BadInputError
            Too few, or one that is none.
        """
        cells = self.next(what).split(mark)
        if len(cells) < least:
            raise BadInputError(
                f"{what} has {len(cells)} number(s)", f"at {self.where}", f"give {least}"
            )
        return [read_number(cell, f"at {self.where}") for cell in cells[:least]]

    def points(self, count: int, mark: str | None = None) -> np.typing.NDArray[np.float64]:
        """Read `count` lines of two numbers each, (count, 2).

        Raises
        ------
        BadInputError
            There are not so many lines, or a line has no two numbers.
        """
        if count > self.left:
            raise BadInputError(
                f"{count} points are announced and {max(self.left, 0)} lines are left",
                f"at {self.where}", f"take a whole file: it ends with {self.ending}",
            )  # fmt: skip
        found = [self.numbers("a point", 2, mark) for _ in range(count)]
        return np.array(found, np.float64).reshape(count, 2)

r"""The entities of an ASCII DXF drawing: group codes with their values, one entity after another.

Examples
--------
>>> from assoc_hull.io.dxf.drawing_entities import drawing_entities
>>> rows = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 LINE 8 WL 10 3 0 EOF".split()
>>> found = drawing_entities("\n".join(rows), "text")
>>> [each.kind for each in found], found[2].word(8), found[2].place(10)
(['SECTION', 'ENDSEC', 'LINE', 'EOF'], 'WL', [3.0, 0.0, 0.0])
"""

from __future__ import annotations

import re

import attrs

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError
from assoc_hull.io.lines.digitised_piece import read_number

__all__ = ["DrawingEntity", "drawing_entities", "drawing_unit"]

_OWNER = 1001
"""The group code of an application's name, with which its extended data begin."""

_UNITS = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m"}


@attrs.define(eq=False)
class DrawingEntity:
    """An entity of a drawing.

    Attributes
    ----------
    kind : str
        Such as "LINE".
    where : str
        Where it begins.
    codes : list of (int, str, str)
        Group codes with their values, and where each stands.
    """

    kind: str
    where: str
    codes: list[tuple[int, str, str]] = attrs.field(factory=list)

    def word(self, code: int) -> str:
        """Give the first value of a code, empty if there is none."""
        return next((value for each, value, _ in self.codes if each == code), "")

    def numbers(self, code: int) -> list[float]:
        """Give the values of a code as numbers."""
        return [read_number(value, where) for each, value, where in self.codes if each == code]

    def number(self, code: int) -> float:
        """Give the first value of a code, nil if there is none."""
        return next(iter(self.numbers(code)), 0.0)

    def place(self, first: int = 10, height: float = 0.0) -> list[float]:
        """Give the place that begins with a code."""
        x, y, *z = (self.numbers(first + step)[:1] for step in (0, 10, 20))
        return [*(x or [0.0]), *(y or [0.0]), *(z[0] or [height])]

    def extended(self, owner: str) -> DrawingEntity | None:
        """Give the extended data of an application as codes of their own, None without any."""
        found: DrawingEntity | None = None
        for code, value, where in self.codes:
            if code == _OWNER:
                if found is not None:
                    break
                found = DrawingEntity(self.kind, where) if value == owner else None
            elif found is not None:
                found.codes.append((code, value, where))
        return found


def drawing_entities(text: str, source: str) -> list[DrawingEntity]:
    """Take a drawing apart; heads of sections are entities, too.

    Parameters
    ----------
    text : str
        The drawing.
    source : str
        Name of the file, for messages.

    Raises
    ------
    BadInputError
        A group code that is none.
    """
    rows = text.splitlines()
    found: list[DrawingEntity] = []
    for i in range(0, len(rows) - 1, 2):
        where = f"line {i + 1} of {source}"
        if not re.fullmatch(r"\s*-?[0-9]{1,9}\s*", rows[i]):
            raise BadInputError(f"{shown(rows[i])} is no group code", where, "save it as ASCII DXF")
        code, value = int(rows[i]), rows[i + 1].strip()
        if code == 0:
            found.append(DrawingEntity(value, where))
        elif found:
            found[-1].codes.append((code, value, where))
    return found


def drawing_unit(entities: list[DrawingEntity]) -> str | None:
    r"""Give the unit that the header tells: "m", "mm", "cm", "ft" or "in"; None if it tells none.

    Examples
    --------
    >>> from assoc_hull.io.dxf.drawing_entities import drawing_entities, drawing_unit
    >>> rows = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC".split()
    >>> drawing_unit(drawing_entities("\n".join(rows), "text"))
    'mm'
    """
    for entity in entities:
        for (_, name, _), (code, value, _) in zip(entity.codes, entity.codes[1:], strict=False):
            if name == "$INSUNITS" and code == 70 and value.isascii() and value.isdigit():
                return _UNITS.get(int(value)) if len(value) < 4 else None
    return None

"""IGES files as they are written: sections and entities, and spline surfaces (entity 128).

The same entities give the same bytes: no time, no name of a user. Numbers have all digits, so that
lengths in metres come back to the last bit. `assoc_hull.io.iges.lines` writes lines of a hull.

Source: IGES 5.3 (US PRO, 1996), sections 2.2.2, 2.2.4 and 4.24.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import all_of
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.iges.file import UNITS
from assoc_hull.io.lines.own_lines import MARK, pieces_of
from assoc_hull.io.units import METRES, checked_unit

__all__ = [
    "IgesLayout",
    "iges_text",
    "real_values",
]

# --------------------------------------------------------------------------------------
# Sections, entities with their names, and the global section.

_DATE = "20000101.000000"
"""The format wants a time; one for all makes files comparable."""

_FLAGS = {name: flag for flag, (name, _) in UNITS.items()}
_NAMES = {"m": "M", "mm": "MM", "cm": "CM", "ft": "FT", "in": "IN"}
_VISIBLE, _PROPERTY = "00000000", "00010300"
_STRING, _WORD = "3", 50
"""The type of a text among generic data; letters of a word, which no line breaks."""


@attrs.define
class IgesLayout:
    """Lines of the directory and of the parameters, as entities are added."""

    directory: list[str] = attrs.field(factory=list)
    parameters: list[str] = attrs.field(factory=list)

    def add_named(
        self, kind: int, values: Sequence[str], name: str, level: int = 0, text: str = ""
    ) -> None:
        """Add an entity and its name, as a property (406, form 15) and as a label of eight letters.

        `values` leave out the type and pointers to properties; `level` is the layer, 0: none. What
        is not ASCII in a name is written as ``?``. A `text` of ours follows as another property.
        """
        label = _ascii(name)
        # Two lines of the directory are its own: properties are the next entities.
        first = len(self.directory) + 3
        pointers = [str(first), str(first + 2)] if text else [str(first)]
        ours = [*values, "0", str(len(pointers)), *pointers]
        self._add(kind, 0, ours, label[:8], _VISIBLE, level)
        self._add(406, 15, ["1", _hollerith(label)], "", _PROPERTY, 0)
        if text:
            self.add_text(text, _PROPERTY)

    def add_text(self, text: str, status: str = _VISIBLE) -> None:
        """Add a text of ours as generic data, a property (406, form 27) of words of 50 letters."""
        words = [_hollerith(each) for each in pieces_of(text, _WORD)]
        values = [each for word in words for each in (_STRING, word)]
        head = [str(len(values) + 2), _hollerith(MARK), str(len(words))]
        self._add(406, 27, [*head, *values], "", status, 0)

    def _add(
        self, kind: int, form: int, values: Sequence[str], label: str, status: str, level: int
    ) -> None:
        number, first = len(self.directory) + 1, len(self.parameters) + 1
        lines = _packed([str(kind), *values], 64)
        self.parameters += [f"{line:64}{number:8d}" for line in lines]
        start = f"{kind:8d}{first:8d}{0:8d}{0:8d}{level:8d}{0:8d}{0:8d}{0:8d}{status}"
        shape = f"{kind:8d}{0:8d}{0:8d}{len(lines):8d}{form:8d}{'':16}{label:>8}{0:8d}"
        self.directory += [start, shape]

    def text(self, title: str, unit: str, size: float, more: Sequence[str] = ()) -> str:
        """Give the text, lines of 80 columns; `size` is the greatest coordinate, in `unit`.

        The file begins with a title and `more` lines for people.
        """
        sections = {
            "S": [f"{_ascii(line, 72):72}" for line in (title, *more)],
            "G": _packed(_globals(unit, size), 72), "D": self.directory, "P": self.parameters,
        }  # fmt: skip
        lines = [
            f"{line}{letter}{number:7d}"
            for letter, section in sections.items()
            for number, line in enumerate(section, start=1)
        ]
        counts = "".join(f"{letter}{len(section):7d}" for letter, section in sections.items())
        return "\n".join([*lines, f"{counts:72}T{1:7d}"]) + "\n"


def real_values(values: FloatArray | Sequence[float]) -> Iterable[str]:
    """Give numbers with all digits, the last axis fastest, with a point and D for powers of ten.

    Examples
    --------
    >>> from assoc_hull.io.iges.write import real_values
    >>> list(real_values([2.0, 0.25, 1e-20]))
    ['2.', '0.25', '1.D-20']
    """
    for value in np.asarray(values, np.float64).ravel().tolist():
        digits, power, exponent = repr(value + 0.0).partition("e")
        whole = digits.removesuffix("0") if digits.endswith(".0") else digits
        point = "" if "." in whole else "."
        yield f"{whole}{point}" + (f"D{int(exponent)}" if power else "")


def _globals(unit: str, size: float) -> list[str]:
    """Give the values of the global section."""
    program = _hollerith("assoc-hull")
    words = ["1H,", "1H;", program, _hollerith("surfaces.igs"), program, program]
    words += ["32", "38", "6", "308", "15", program]
    words += ["1.", str(_FLAGS[unit]), _hollerith(_NAMES[unit]), "1", "0.1", _hollerith(_DATE)]
    least, most = real_values([max(size, 1.0) * 1e-15, size])
    return [*words, least, most, "", "", "11", "0", _hollerith(_DATE), ""]


def _hollerith(text: str) -> str:
    return f"{len(text)}H{text}" if text else ""


def _ascii(text: str, most: int = 60) -> str:
    """Give a name in the letters that the format knows, and short enough for a line."""
    return text.encode("ascii", "replace").decode()[:most]


def _packed(values: Iterable[str], width: int) -> list[str]:
    """Put values into lines, none of them split."""
    given = list(values)
    lines = [""]
    for place, value in enumerate(given, start=1):
        word = value + (";" if place == len(given) else ",")
        if len(lines[-1]) + len(word) > width:
            lines.append("")
        lines[-1] += word
    return [f"{line:{width}}" for line in lines]


# --------------------------------------------------------------------------------------
# Spline surfaces.

_TITLE = "Control nets of surfaces, written by assoc-hull"


def iges_text(surfaces: Sequence[SplineSurface], unit: str = "m") -> str:
    """Lay out one or more surfaces as the text of an IGES file, with their names.

    Raises
    ------
    BadInputError
        No surface, something else among them, or another unit.
    """
    where = "in iges_text"
    given = all_of(surfaces, SplineSurface, "surfaces", where)
    factor = 1.0 / METRES[checked_unit(unit, where)]
    if not given:
        raise BadInputError("there are no surfaces", where, "give one or more")
    size = max(float(np.abs(each.net).max()) for each in given) * factor
    layout = IgesLayout()
    for each in given:
        layout.add_named(128, _surface(each, factor), each.name)
    return layout.text(_TITLE, unit, size)


def _surface(surface: SplineSurface, factor: float) -> list[str]:
    """Give the values of an entity 128; u runs fastest in the file, and first in a net."""
    (rows, columns), (m, n) = surface.net.shape[:2], surface.degrees
    net = surface.net if factor == 1.0 else surface.net * factor
    weights = np.ones((rows, columns)) if surface.weights is None else surface.weights
    spans = [end for ends in surface.domain for end in ends]
    flags = [0, 0, int(surface.weights is None), 0, 0]
    return [
        *(str(each) for each in (rows - 1, columns - 1, m, n, *flags)),
        *real_values(surface.knots_u), *real_values(surface.knots_v), *real_values(weights.T),
        *real_values(net.swapaxes(0, 1)), *real_values(spans),
    ]  # fmt: skip

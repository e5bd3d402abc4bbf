"""IGES files as they are written: sections, entities, surfaces (128) and lines (126).

The same entities give the same bytes: no time, no name of a user. Numbers have all digits, so that
lengths in metres come back to the last bit. `assoc_hull.io.iges.write` writes lines of a hull.

Source: IGES 5.3 (US PRO, 1996), sections 2.2.2, 2.2.4 and 4.24.

The lines of a hull as spline curves of IGES, entities 126: the very curves, with their names.

A curve of a line is one entity; lines of several curves give their name to each. Families lie on
levels: sections on 1, waterlines on 2, buttocks on 3, diagonals on 4, boundary lines on 5. Of the
last two all but profile, deck edge and transom are named by their family too, and are not read as
lines again: "boundary: flat of side".

Source: IGES 5.3 (US PRO, 1996), section 4.23.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.iges.curves import curves_of_iges
>>> from assoc_hull.io.iges.write import iges_of_lines
>>> text, report = iges_of_lines(wigley())
>>> report.lines, report.curves
(31, 31)
>>> curves, unit, _ = curves_of_iges(text, "wigley.igs")
>>> curves[0].name, unit
('ST 1', 'm')
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import (
    all_of,
    choice,
    file_path,
    flag,
    instance,
)
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.splines.control_polygon import control_polygon
from assoc_hull.io.iges.file import UNITS
from assoc_hull.io.lines.line_points import splines_of
from assoc_hull.io.lines.own_lines import (
    IMAGE,
    MARK,
    curve_texts,
    hull_text,
    pieces_of,
)
from assoc_hull.io.lines.raw_lines import BOUNDARIES, OTHER_FAMILIES
from assoc_hull.io.units import METRES, checked_unit
from assoc_hull.io.write_file import write_whole
from assoc_hull.model.tables import HullState

__all__ = [
    "FAMILIES",
    "IgesLayout",
    "LinesReport",
    "curve_values",
    "iges_of_lines",
    "iges_text",
    "real_values",
    "write_iges_lines",
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


FAMILIES = ("sections", "waterlines", "buttocks", "diagonals", "boundary")
"""Families of lines, in the order and on the levels of the file."""

_TITLE_OF_LINES = "Lines of a hull, written by assoc-hull"
_WHERE = "in write_iges_lines"
_ACROSS = np.array([1.0, -1.0, 1.0])


@attrs.frozen
class LinesReport:
    """What was written.

    Attributes
    ----------
    path, unit : str
        Where, and in which unit of length.
    half : bool
        Whether it is the half y >= 0 alone.
    lines, curves, points : int
        Lines, the curves they are made of, to both sides if so, and their control points.
    size : int
        Bytes.
    """

    path: str
    unit: str
    half: bool
    lines: int
    curves: int
    points: int
    size: int


def write_iges_lines(
    state: HullState,
    path: str | os.PathLike[str],
    *,
    unit: str = "m",
    half: bool = True,
    families: Sequence[str] = FAMILIES,
) -> LinesReport:
    """Write the lines of a hull as spline curves of IGES.

    Parameters
    ----------
    state : HullState
        The hull.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    unit : {"m", "mm"}
        Of the lengths in the file.
    half : bool
        Whether to write the half y >= 0 alone; else the images to starboard too.
    families : sequence of str
        Which, some of `FAMILIES`.

    Raises
    ------
    BadInputError
        Another unit or family, no line of these, a curve that has failed, or a file that cannot
        be written.
    """
    file_path(path, _WHERE)
    text, report = iges_of_lines(state, unit=unit, half=half, families=families)
    write_whole(path, text.encode())
    return attrs.evolve(report, path=os.fspath(path))


def iges_of_lines(
    state: HullState,
    *,
    unit: str = "m",
    half: bool = True,
    families: Sequence[str] = FAMILIES,
) -> tuple[str, LinesReport]:
    """Lay out the lines of a hull as the text of an IGES file; as `write_iges_lines`."""
    factor = 1.0 / METRES[choice(unit, "unit", ("m", "mm"), _WHERE)]
    alone = flag(half, "half", _WHERE)
    given = all_of(families, str, "families", _WHERE)
    wanted = [choice(each, "family", FAMILIES, _WHERE) for each in given]
    instance(state, HullState, "state", _WHERE)
    layout, size, points, curves = IgesLayout(), 0.0, 0, 0
    lines = list(_lines(state, wanted))
    for family, line in lines:
        name, level = _name(state, family, line), FAMILIES.index(family) + 1
        for spline, told in zip(splines_of(state, line), curve_texts(state, line), strict=True):
            curve = control_polygon(spline)
            for net, words in zip(_sides(curve.points, alone), (told, IMAGE), strict=False):
                values = curve_values(curve.knots, net * factor)
                layout.add_named(126, values, name, level, words)
                curves, points = curves + 1, points + len(net)
                size = max(size, float(np.abs(net).max()) * factor)
    if not lines:
        raise BadInputError("there are no lines of these families", _WHERE, "give others")
    layout.add_text(hull_text(state))
    text = layout.text(_TITLE_OF_LINES, unit, size, _particulars(state))
    return text, LinesReport("", unit, alone, len(lines), curves, points, len(text))


def _particulars(state: HullState) -> list[str]:
    """Give name and particulars for people who look into the file."""
    ship = state.particulars
    sizes = f"Lpp {ship.length:.6g} m, B {ship.breadth:.6g} m, D {ship.depth:.6g} m"
    return [ship.name, f"{sizes}, T {ship.draught:.6g} m, deck {ship.deck}"]


def _lines(state: HullState, families: Sequence[str]) -> Iterator[tuple[str, int]]:
    """Give the lines by family, within a family by place, then by name."""
    live = state.live("lines").tolist()
    for family in FAMILIES:
        mine = [line for line in live if state.family(line).name == family and family in families]
        yield from ((family, line) for line in sorted(mine, key=lambda line: _place(state, line)))


def _name(state: HullState, family: str, line: int) -> str:
    """Name a line; one that no reader of lines would know goes by its family too."""
    name = str(state.lines.name[line])
    plain = family not in OTHER_FAMILIES or name.lower() in BOUNDARIES
    return name if plain else f"{family}: {name}"


def _place(state: HullState, line: int) -> tuple[float, str]:
    planar = bool(state.lines.planar[line])
    offset = float(state.lines.offset[line]) if planar else 0.0
    return offset, str(state.lines.name[line])


def _sides(points: FloatArray, half: bool) -> list[FloatArray]:
    """Give the control points of a curve, and those of its image if there is one to be drawn."""
    centred = not points[:, 1].any()
    return [points] if half or centred else [points, points * _ACROSS]


def curve_values(knots: FloatArray, points: FloatArray) -> list[str]:
    """Give the values of a cubic curve as an entity 126, without pointers.

    Parameters
    ----------
    knots : (n + 4,)
        Not falling.
    points : (n, 3)
        Control points, in units of the file.
    """
    flat = (points == points[0]).all(axis=0)
    planar = bool(flat.any())
    normal = np.arange(3) == np.argmax(flat) if planar else np.zeros(3)
    closed = bool((points[0] == points[-1]).all())
    flags = (len(points) - 1, 3, int(planar), int(closed), 1, 0)
    return [
        *(str(each) for each in flags),
        *real_values(knots),
        *real_values(np.ones(len(points))),
        *real_values(points),
        *real_values([knots[0], knots[-1]]),
        *real_values(normal.astype(np.float64)),
    ]

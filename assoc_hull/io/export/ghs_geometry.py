"""GHS geometry files (.GF): the sections of the hull as one displacing part, written and read.

The form is in feet, x positive aft, y positive to starboard, z up. A section is a closed outline of
at most 255 points; the reader finds the hull among the shapes of the file.

Source: Creative Systems, Inc., GHS User's Manual, appendix A "Geometry File Format"; it is quoted
in the public source of pymeshup, ``ghs_import.py``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.export.sections import CENTRE, count_line
from assoc_hull.io.lines.line_points import LinePolylines
from assoc_hull.io.lines.raw_lines import (
    RawLines,
    RawPiece,
    TextRows,
    plane_name,
    read_number,
    whole_number,
)
from assoc_hull.io.lines.ship_frame import StatedPlaces
from assoc_hull.io.reports import ExportBook, Notebook

__all__ = [
    "FOOT",
    "MOST",
    "dumps_gf",
    "is_gf",
    "parse_gf",
]

# --------------------------------------------------------------------------------------
# Writing. A shape is a list of at most 255 sections from forward aft, each a closed outline that
# runs counterclockwise as seen from abaft: of a symmetric hull the starboard half from the bottom
# up, the rest being implied. A point is ``y, z``, and may have a surface code (2: the stretch to
# the next point is not on the hull), a radius and a line code (``DK``: edge of the deck). The hull
# is one shape, one component of side 0 and one part. Here x = 0 stays at the after perpendicular,
# so that the hull lies at negative x.

FOOT = 0.3048
MOST = 255
"""Sections of a shape, and points of a section."""

_NEAR = 0.01 * FOOT
"""Sections closer than this (m) are not allowed."""

_OFF, _DECK = "2", "0,0,DK"
"""After the coordinates: the stretch to the next point is off the hull; the edge of the deck."""


def dumps_gf(
    name: str, length: float, breadth: float, lines: Sequence[LinePolylines], book: ExportBook
) -> str:
    """Write sections, given from aft; `length` and `breadth` are overall, m.

    `book` has a scale of feet in a metre, and takes what is written and what is changed.

    Raises
    ------
    BadInputError
        More sections than the form holds, or more points in one.
    """
    wanted = _spaced(list(lines)[::-1], book)
    if len(wanted) > MOST:
        raise BadInputError(
            f"there are {len(wanted)} sections", "in the export as GF",
            f"the form holds {MOST}: leave some out, or choose another form",
        )  # fmt: skip
    shape: list[str] = ["*", "HULL", str(len(wanted))]
    for line in wanted:
        count_line(line, book)
        shape += _section(line, book)
    _tell(wanted, book)
    title = book.name(name, " -)+-[\\]-~", 58, "HULL").lstrip("*\\") or "HULL"
    [[long, broad]] = book.rows(np.array([[length, breadth]]))
    head = [
        title, r"\Sections of a net of lines; half of a symmetric hull", f"L:{long}", f"W:{broad}",
        "P:M", "OL:AFTER PERPENDICULAR", "OT:CENTERPLANE", "OV:BASELINE", "N:1",
        r"\Forward is negative; surface code 2: not on the hull",
    ]  # fmt: skip
    tail = [
        "0,0,0", "**", "HULL.C", "0", "1.000", "0,0,0", "HULL",
        "***", "HULL", "SEA WATER", "1", "1.025", "0,0,0", "1", "HULL.C", "****", "",
    ]  # fmt: skip
    return "\n".join([*head, *shape, *tail])


def _spaced(lines: list[LinePolylines], book: ExportBook) -> list[LinePolylines]:
    """Leave out sections that lie too close behind the one before."""
    kept: list[LinePolylines] = []
    for line in lines:
        if kept and kept[-1].offset - line.offset < _NEAR:
            what = f"it lies less than {1e3 * _NEAR:.1f} mm from {kept[-1].name}"
            book.leave_out("twin", line.name, what, line.offset)
        else:
            kept.append(line)
    return kept


def _section(line: LinePolylines, book: ExportBook) -> list[str]:
    count = sum(len(piece.points) for piece in line.pieces)
    if count > MOST:
        raise BadInputError(
            f"{line.name} has {count} points", "in the export as GF",
            f"the form holds {MOST}: give a larger chord",
        )  # fmt: skip
    [[x]] = book.rows(np.array([[-line.offset]]))
    found = [f"{x},{count}"]
    for piece in line.pieces:
        rows = [",".join(row) for row in book.rows(piece.points[:, 1:])]
        last = piece is line.pieces[-1]
        if not last:
            rows[-1] += f",{_OFF}"
        elif piece.points[-1, 1] > CENTRE:
            rows[-1] += f",{_DECK}"
        found += rows
    return found


def _tell(lines: list[LinePolylines], book: ExportBook) -> None:
    several = [line.name for line in lines if len(line.pieces) > 1]
    if several:
        what = f"{', '.join(several)}: their curves are joined by stretches off the hull (code 2)"
        book.mend("several curves", f"{len(several)} sections", what, len(several))
    knuckles = sum(int(piece.knuckle.sum()) for line in lines for piece in line.pieces)
    if knuckles:
        what = f"{knuckles} are points like others: between points the form is straight"
        book.leave_out("knuckles", "the sections", what, knuckles)


# --------------------------------------------------------------------------------------
# Reading.

_SHAPE = re.compile(r"^\*[ \t]*\r?\n[^\r\n*]{1,40}\r?\n[ \t]*[0-9]+[ \t]*\r?$", re.MULTILINE)
_DISPLACES = 1
"""The type of a part that displaces water."""

_AP = re.compile(r"\bA\.?P\.?(?!\w)|\baft(?:er)? perpendicular", re.IGNORECASE)
_FP = re.compile(r"\bF\.?P\.?(?!\w)|\bfore?(?:ward)? perpendicular", re.IGNORECASE)
_BASE = re.compile(r"\bbase ?line|\bB\.?L\.?(?!\w)|\bkeel\b", re.IGNORECASE)
_AFT = re.compile(r"\b(A\.?P\.?|aft|after|stern)\b", re.IGNORECASE)


@attrs.frozen(eq=False)
class _Shape:
    """A shape: its sections as pieces, each with x (feet aft) and its line in the file."""

    name: str
    sections: tuple[tuple[float, tuple[FloatArray, ...], str], ...]
    decks: bool


@attrs.frozen
class _Component:
    """A component: its shape, which side that describes, and the shift of its origin."""

    name: str
    shape: str
    side: int
    shift: tuple[float, float, float]


def is_gf(text: str) -> bool:
    """Tell by a shape near its beginning whether a text is a GHS geometry file."""
    return _SHAPE.search(text) is not None


def parse_gf(text: str, source: str, book: Notebook) -> RawLines:
    """Read the sections of the hull, in feet, into ship axes.

    `book` takes which shape was read, where x = 0 is, and what was left out.

    Raises
    ------
    BadInputError
        A line that is not as the form has it, no shape, or a file that ends before ``****``.
    """
    shapes, components, hull, origins = _scan(TextRows.of(text, source, "****"))
    if not shapes:
        raise BadInputError("there is no shape", f"in {source}", "give a file with sections")
    component = _choose(shapes, components, hull, book, source)
    origin, level = origins
    shape = shapes[component.shape]
    shift = _zero(shape, component, origin, book, source)
    pieces = [
        RawPiece(plane_name("sections", (shift - x) * FOOT), _place(part, shift - x, component), at)
        for x, parts, at in shape.sections for part in parts if len(part) > 1
    ]  # fmt: skip
    if not shape.decks:
        what = "no edge of the deck is marked: a deck, if there is one, is read as part of sections"
        book.assume("deck", source, what)
    return RawLines(pieces, "ft", stated=_stated(origin, level, shift, component))


def _stated(origin: str, level: str, shift: float, component: _Component) -> StatedPlaces:
    """Give what OL and OV say of the file's origin, in the axes of the pieces, feet."""
    found: dict[str, float] = {}
    said = {"ap": f"the file says OL:{origin}", "fp": f"the file says OL:{origin}",
            "base": f"the file says OV:{level}"}  # fmt: skip
    for name, words in (("ap", _AP), ("fp", _FP)):
        if words.search(origin):
            found[name] = shift + component.shift[0]
    if _BASE.search(level):
        found["base"] = component.shift[2]
    return StatedPlaces(**found, evidence={name: said[name] for name in found})


def _place(part: FloatArray, x: float, component: _Component) -> FloatArray:
    """Put a polyline of a section into ship axes: x forward, y to port, in feet.

    Of a half that stands for both sides the image to port is given.
    """
    starboard = (-part[:, 0] if component.side < 0 else part[:, 0]) + component.shift[1]
    y = starboard if component.side == 0 else -starboard
    return np.column_stack([np.full(len(part), x), y, part[:, 1] + component.shift[2]])


def _scan(
    rows: TextRows,
) -> tuple[dict[str, _Shape], dict[str, _Component], list[str], tuple[str, str]]:
    """Read shapes, components, names of those that displace, and where x = 0 and z = 0 are."""
    shapes: dict[str, _Shape] = {}
    components: dict[str, _Component] = {}
    hull: list[str] = []
    origin = level = ""
    rows.next("a title")
    while True:
        line = rows.next("'*' or '****'").strip()
        if line.startswith("****"):
            return shapes, components, hull, (origin, level)
        if line == "***":
            hull += _part(rows)
        elif line == "**":
            component = _component(rows)
            components[component.name] = component
        elif line == "*":
            shape = _shape(rows)
            shapes[shape.name] = shape
        elif line.startswith("OL:"):
            origin = line[3:].strip()
        elif line.startswith("OV:"):
            level = line[3:].strip()


def _shape(rows: TextRows) -> _Shape:
    name = rows.next("the name of a shape").strip()
    count = whole_number(rows.next("the number of sections"), f"at {rows.where}")
    sections: list[tuple[float, tuple[FloatArray, ...], str]] = []
    decks = False
    for _ in range(count):
        cells = rows.next("a section").split(",")
        where = rows.where
        if len(cells) < 2:
            raise BadInputError(
                "a section begins with its place and number of points", f"at {where}",
                "separate them by a comma",
            )  # fmt: skip
        x, many = read_number(cells[0], f"at {where}"), whole_number(cells[1], f"at {where}")
        parts, deck = _outline(rows, many)
        decks |= deck
        sections.append((x, parts, where))
    return _Shape(name, tuple(sections), decks)


def _outline(rows: TextRows, count: int) -> tuple[tuple[FloatArray, ...], bool]:
    """Read the points of a section up to the edge of the deck, split where it is off the hull."""
    if count > rows.left:
        rows.points(count, ",")
    points: list[list[float]] = []
    cuts: list[int] = []
    deck = False
    for k in range(count):
        cells = rows.next("a point").split(",")
        if len(cells) < 2:
            raise BadInputError("a point has one number", f"at {rows.where}", "give two")
        if deck:
            continue
        points.append([read_number(cell, f"at {rows.where}") for cell in cells[:2]])
        if len(cells) > 2 and cells[2].strip() in ("2", "3"):
            cuts.append(k + 1)
        deck = len(cells) > 4 and cells[4].strip() == "DK"
    every = np.array(points, np.float64).reshape(-1, 2)
    return tuple(np.split(every, [cut for cut in cuts if cut < len(every)])), deck


def _component(rows: TextRows) -> _Component:
    name = rows.next("the name of a component").strip()
    side = whole_number(rows.next("the side"), f"at {rows.where}")
    rows.numbers("the effectiveness", 1)
    x, y, z = rows.numbers("the shift of the origin", 3, ",")
    return _Component(name, rows.next("the name of a shape").strip(), side, (x, y, z))


def _part(rows: TextRows) -> list[str]:
    """Give the components of a part, none if it does not displace."""
    rows.next("the name of a part")
    rows.next("the fluid")
    kind = whole_number(rows.next("the type of a part"), f"at {rows.where}")
    rows.numbers("the specific gravity", 1)
    rows.next("the reference point")
    count = whole_number(rows.next("the number of components"), f"at {rows.where}")
    if count > rows.left:
        raise BadInputError(
            f"{count} components are announced", f"at {rows.where}", "take a whole file"
        )
    names = [rows.next("a component").strip() for _ in range(count)]
    return names if kind == _DISPLACES else []


def _choose(
    shapes: dict[str, _Shape], components: dict[str, _Component], hull: list[str],
    book: Notebook, source: str,
) -> _Component:  # fmt: skip
    """Take the component of the hull: of those that displace, the one of most sections."""
    bare = [_Component(name, name, 0, (0.0, 0.0, 0.0)) for name in shapes]
    named = [components[name] for name in hull if name in components]
    known = [each for each in named if each.shape in shapes] or [
        each for each in components.values() if each.shape in shapes
    ]
    candidates = known or bare
    found = max(
        candidates, key=lambda each: (len(shapes[each.shape].sections), each.name == "HULL")
    )
    others = sorted(set(shapes) - {found.shape})
    if others:
        what = f"the shape {found.shape} is read; {', '.join(others[:5])} and {len(others)} in all"
        book.suspect("shapes", source, f"{what} are left out", len(others))
    return found


def _zero(shape: _Shape, component: _Component, origin: str, book: Notebook, source: str) -> float:
    """Give x (ft, forward) of the file's origin: the after perpendicular, or the aftmost place."""
    x = np.array([each[0] for each in shape.sections]) + component.shift[0]
    said = f" ({origin})" if origin else ""
    if len(x) and (_AFT.search(origin) or -x.min() > x.max()):
        what = f"x = 0 of the file{said} is kept as the after perpendicular"
        book.assume("frame", source, what)
        return -component.shift[0]
    aft = float(x.max()) if len(x) else 0.0
    what = f"x = 0 of the file{said} lies forward: x is counted from the aftmost section"
    book.assume("frame", source, what, aft * FOOT)
    return aft - component.shift[0]

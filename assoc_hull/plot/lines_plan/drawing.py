"""What is drawn of a hull: its lines as polylines, and where they cross.

The one place in this package that reads a hull's tables, but for `links`. Everything given
out is frozen, so a drawing is also a snapshot: it stays as it is while the hull is edited.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.plot.lines_plan.drawing import drawing
>>> line = drawing(wigley()).line("WL 2.5")
>>> line.family, line.label, line.offset
('waterlines', '2.5', 2.5)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import UnknownNameError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.hull import Hull
from assoc_hull.model.address import AddressBook
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.kinds import FAMILIES, BoundaryKind
from assoc_hull.model.state import HullState, Particulars

__all__ = [
    "CHORDS",
    "Crossings",
    "Drawing",
    "DrawnLine",
    "Sketchable",
    "drawing",
    "short_name",
    "state_of",
]

CHORDS = 8
"""Chords that stand for one segment of a line, and four times as many for a boundary."""


@attrs.frozen(eq=False)
class DrawnLine:
    """One line of a hull.

    Attributes
    ----------
    name, label : str
        Its name, and the short one without the prefix of its family.
    family : str
        Name of its family.
    boundary : BoundaryKind or None
        What it does to lines that meet it.
    normal : (3,)
        Unit normal of its plane; nan for a space curve.
    offset : float, m
        Offset of its plane; nan for a space curve.
    splines : tuple of SplineBatch
        Its curves, batches of one.
    polylines : tuple of (n, 3), m
        Its curves for drawing.
    """

    name: str
    label: str
    family: str
    boundary: BoundaryKind | None
    normal: FloatArray
    offset: float
    splines: tuple[SplineBatch, ...]
    polylines: tuple[FloatArray, ...]

    @property
    def points(self) -> FloatArray:
        """The points of all its polylines, (k, 3), m."""
        return np.concatenate([np.zeros((0, 3)), *self.polylines])


@attrs.frozen(eq=False)
class Crossings:
    """The crossings of a hull whose normals are known.

    Attributes
    ----------
    key : tuple of k str
        What they are; a key outlives edits.
    line : tuple of k (str, str)
        Names of the lines that cross.
    xyz, normal : (k, 3)
        Place, m, and unit normal of the hull, of either sense.
    """

    key: tuple[str, ...]
    line: tuple[tuple[str, str], ...]
    xyz: FloatArray
    normal: FloatArray


@attrs.frozen(eq=False)
class Drawing:
    """All lines of a hull as they were when it was made.

    Attributes
    ----------
    particulars : Particulars
        Principal dimensions, m.
    lines : tuple of DrawnLine
        By family, along each family by plane.
    crossings : Crossings
        Where they cross.
    """

    particulars: Particulars
    lines: tuple[DrawnLine, ...]
    crossings: Crossings

    def of(self, family: str) -> tuple[DrawnLine, ...]:
        """Give the lines of a family."""
        return tuple(line for line in self.lines if line.family == family)

    def line(self, name: str) -> DrawnLine:
        """Give the line of a name.

        Raises
        ------
        UnknownNameError
            There is none.
        """
        for line in self.lines:
            if line.name == name:
                return line
        raise UnknownNameError("line", name, tuple(line.name for line in self.lines))

    @property
    def profile(self) -> DrawnLine | None:
        """The boundary in the centre plane."""
        for line in self.of("boundary"):
            if line.boundary == BoundaryKind.END and abs(line.normal[1]) == 1.0:
                return line
        return None

    @property
    def bounds(self) -> FloatArray:
        """Least and greatest coordinates, (2, 3), m."""
        points = np.concatenate([line.points for line in self.lines])
        return np.stack([points.min(axis=0), points.max(axis=0)])


Sketchable = Hull | HullState | Drawing
"""What can be drawn."""


def state_of(hull: Hull | HullState) -> HullState:
    """Give the tables of a hull."""
    return hull.document.state if isinstance(hull, Hull) else hull


def drawing(hull: Sketchable) -> Drawing:
    """Take the lines of a hull as they are now; a drawing is given back as it is."""
    if isinstance(hull, Drawing):
        return hull
    state = state_of(hull)
    book = AddressBook(state)
    lines = [_drawn(state, book, line) for line in state.live("lines").tolist()]
    lines.sort(key=lambda line: (FAMILIES[line.family].rank, line.offset, line.name))
    return Drawing(state.particulars, tuple(lines), _crossings(state, book))


def _crossings(state: HullState, book: AddressBook) -> Crossings:
    """Take the crossings where both curves pass and their tangents differ."""
    table, rows = state.rows, state.live("rows")
    rows = rows[
        (table.curve.data[rows, 1] >= 0) & np.isfinite(table.parameter.data[rows]).all(axis=1)
    ]
    curve, at = table.curve.data[rows], table.parameter.data[rows]
    normal = crossing_normals(*(tangents(state, curve[:, i], at[:, i]) for i in (0, 1)))
    known = (normal != 0.0).any(axis=1)
    rows, normal = rows[known], normal[known]
    name = {line: book.line_name(line) for line in state.live("lines").tolist()}
    lines = state.curves.line.data[table.curve.data[rows]]
    return Crossings(
        tuple(table.key.data[row] for row in rows.tolist()),
        tuple((name[a], name[b]) for a, b in lines.tolist()),
        table.spot.data[rows].mean(axis=1),
        normal,
    )


def _drawn(state: HullState, book: AddressBook, line: int) -> DrawnLine:
    table, family = state.lines, state.family(line)
    boundary = int(table.boundary.data[line])
    splines = tuple(state.spline(curve) for curve in state.curves_of(line))
    chords = CHORDS if boundary < 0 else 4 * CHORDS
    normal = table.normal.data[line].copy()
    flat = bool(table.planar.data[line])
    return DrawnLine(
        book.line_name(line),
        short_name(str(table.name.data[line]), family.prefix),
        family.name,
        None if boundary < 0 else BoundaryKind(boundary),
        normal if flat else np.full(3, np.nan),
        float(table.offset.data[line]) if flat else float("nan"),
        splines,
        tuple(sample(spline, chords)[1] for spline in splines),
    )


def short_name(name: str, prefix: str) -> str:
    """Give the name of a line without the prefix of its family, if that leaves anything."""
    found = name.removeprefix(prefix).strip() if prefix else name
    return found or name

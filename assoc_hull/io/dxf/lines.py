"""The lines of a hull in space as a DXF drawing: each curve where it lies, as a spline.

A curve of the net is a cubic spline, and so is SPLINE: nothing is rounded but the last digit.
Programs that know no splines are given polylines.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.reports import ExportBook
>>> from assoc_hull.io.dxf.lines import lines_drawing
>>> text = lines_drawing(wigley(), ExportBook(9))
>>> text.count("AcDbSpline")
31
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.control_polygon import ControlPolygon, control_polygon
from assoc_hull.io.dxf.document import (
    IN_SPACE,
    add_record,
    drawing_text,
    layer_name,
    tag_entity,
)
from assoc_hull.io.lines.line_points import lines_as_points, splines_of
from assoc_hull.io.lines.own_lines import BETWEEN, curve_texts, hull_text, tell_losses
from assoc_hull.io.reports import ExportBook
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.tables import HullState

__all__ = ["SplineLine", "add_spline", "lines_drawing", "spline_lines"]


@attrs.frozen(eq=False)
class SplineLine:
    """A line as B-splines.

    Attributes
    ----------
    group, name, family : str
        Its group, its name, unlike any other's, and its family.
    normal : (3,)
        Of its plane; nan for a curve in space.
    offset : float, m
        Of its plane; nan for a curve in space.
    curves : tuple of ControlPolygon
        Its curves.
    texts : tuple of str
        What is told of each, so that it comes back as it was.
    """

    group: str
    name: str
    family: str
    normal: FloatArray
    offset: float
    curves: tuple[ControlPolygon, ...]
    texts: tuple[str, ...]

    @property
    def axis(self) -> int | None:
        """The coordinate that is constant on it, if one is."""
        found = np.flatnonzero(np.abs(self.normal) == 1.0)
        return int(found[0]) if len(found) else None

    @property
    def place(self) -> float:
        """The constant coordinate, nan if there is none."""
        return float("nan") if self.axis is None else float(self.offset * self.normal[self.axis])


def spline_lines(state: HullState) -> list[SplineLine]:
    """Give all lines as B-splines, family by family, within one by place and name.

    Raises
    ------
    BadInputError
        A curve has failed.
    """
    book = AddressBook(state)
    found = [_line(state, book, line) for line in state.live("lines").tolist()]
    found.sort(key=lambda each: (FAMILIES[each.family].rank, each.offset, each.name))
    return found


def _line(state: HullState, book: AddressBook, line: int) -> SplineLine:
    table, planar = state.lines, bool(state.lines.planar[line])
    return SplineLine(
        str(state.groups.name[table.group[line]]),
        book.line_name(line),
        state.family(line).name,
        table.normal[line].copy() if planar else np.full(3, np.nan),
        float(table.offset[line]) if planar else float("nan"),
        tuple(control_polygon(each) for each in splines_of(state, line)),
        tuple(curve_texts(state, line)),
    )


def lines_drawing(state: HullState, book: ExportBook, *, polylines: bool = False) -> str:
    """Give the text of a drawing of all lines, each in its place.

    Parameters
    ----------
    state : HullState
        The hull.
    book : ExportBook
        Tells the unit, "m" or "mm", and takes what was written.
    polylines : bool
        Straight between points, 0.5 mm off the curves at most, in place of splines.

    Returns
    -------
    str
        DXF, R2000: a layer per group, of polylines per family; name and family of a line in the
        extended data of its curves.

    Raises
    ------
    BadInputError, MissingExtraError
        A curve has failed; ezdxf is not installed.
    """
    return (_polylines if polylines else _splines)(state, book)


def _splines(state: HullState, book: ExportBook) -> str:
    lines = spline_lines(state)
    curves = [(line, curve) for line in lines for curve in line.curves]
    book.lines, book.curves = len(lines), len(curves)
    book.points = sum(len(curve.points) for _, curve in curves)
    tell_losses(state, book)

    def draw(space: Any) -> None:
        for number, (line, curve) in enumerate(curves):
            points, layer = curve.points * book.scale, layer_name(line.group)
            add_spline(space, curve.knots, points, layer, line, IN_SPACE, str(number))
        # Not with the entities: their extended data have room for 16 kB in all.
        texts = [text for line in lines for text in line.texts]
        add_record(space.doc, BETWEEN.join([hull_text(state), *texts]))

    return drawing_text((layer_name(line.group) for line in lines), draw, book.unit)


def _polylines(state: HullState, book: ExportBook) -> str:
    lines = lines_as_points(state, FAMILIES)
    curves = [(line, piece) for line in lines for piece in line.pieces]
    book.lines, book.curves = len(lines), len(curves)
    book.points = sum(len(piece.points) for _, piece in curves)
    book.chord = max((piece.chord for _, piece in curves), default=0.0)

    def draw(space: Any) -> None:
        for line, piece in curves:
            points = (piece.points * book.scale + 0.0).tolist()
            added = space.add_polyline3d(points, dxfattribs={"layer": line.group})
            tag_entity(added, line.name, line.group)

    return drawing_text((line.group for line in lines), draw, book.unit)


def add_spline(
    space: Any, knots: FloatArray, points: FloatArray, layer: str, line: SplineLine, *more: str
) -> None:
    """Add a cubic B-spline, with the name of its line and more words in its extended data."""
    spline = space.add_spline(degree=3, dxfattribs={"layer": layer})
    spline.control_points = (points + 0.0).tolist()
    spline.knots = knots.tolist()
    tag_entity(spline, line.name, line.family, *more)

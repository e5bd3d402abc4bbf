"""The lines of a hull in space as a DXF drawing, and what all our DXF drawings share.

A curve of the net is a cubic spline, and so is SPLINE: nothing is rounded but the last digit.
Programs that know no splines are given polylines.

What all our DXF drawings share: unit, layers, names of lines, and no times in them.

R2000 is the oldest form that holds splines, and the one that most programs read. The name of a
line stands in the extended data of its entity, since layers hold groups.

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

import io
from collections.abc import (
    Callable,
    Iterable,
    Iterator,
    Mapping,
)
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import MissingExtraError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.control_polygon import ControlPolygon, control_polygon
from assoc_hull.io.lines.line_points import lines_as_points, splines_of
from assoc_hull.io.lines.own_lines import (
    BETWEEN,
    MARK,
    curve_texts,
    hull_text,
    pieces_of,
    tell_losses,
)
from assoc_hull.io.reports import ExportBook
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.tables import HullState

__all__ = [
    "DXF_UNITS",
    "IN_SPACE",
    "NAMES",
    "DxfLayer",
    "DxfUnit",
    "SplineLine",
    "add_record",
    "add_spline",
    "drawing_text",
    "layer_name",
    "lines_drawing",
    "spline_lines",
    "tag_entity",
]

NAMES = MARK
"""Application name of the extended data that hold the name of the line."""

IN_SPACE = "in space"
"""Stands behind name and family of a line that is drawn where it lies; then its number."""

_WORD = 240
"""Letters of a word: records have no longer ones than 255."""


@attrs.frozen
class DxfLayer:
    """A layer: its name, the number of its colour, and the width of its lines, 1/100 mm.

    A width of -3 is the default of the program.
    """

    name: str
    colour: int
    weight: int = -3


@attrs.frozen
class DxfUnit:
    """A unit: what $INSUNITS calls it, and how many make a metre."""

    code: int
    scale: float


DXF_UNITS: Mapping[str, DxfUnit] = MappingProxyType({"m": DxfUnit(6, 1.0), "mm": DxfUnit(4, 1e3)})
"""Units of our drawings."""

_COLOURS = 7
_FORBIDDEN = '<>/\\":;?*|=`,'


def drawing_text(
    layers: Iterable[str | DxfLayer],
    draw: Callable[[Any], None],
    unit: str = "m",
    *,
    metric: bool = True,
) -> str:
    """Give the text of a drawing; the same calls give the same text.

    Parameters
    ----------
    layers : iterable of str or DxfLayer
        Layers; those given by name are drawn each in a colour of its own.
    draw : callable
        Adds entities to the model space that it is given.
    unit : {"m", "mm"}
        Declared in the header; lengths are the caller's.
    metric : bool
        Whether $MEASUREMENT is to say so, on which line types depend.

    Raises
    ------
    MissingExtraError
        ezdxf is not installed.
    """
    try:
        import ezdxf
    except ImportError as error:
        raise MissingExtraError("ezdxf", "dxf") from error
    with _no_times(ezdxf):
        drawing = ezdxf.new("R2000")  # type: ignore[attr-defined]
        drawing.units = DXF_UNITS[unit].code
        if metric:
            drawing.header["$MEASUREMENT"] = 1
        drawing.appids.add(NAMES)
        for number, given in enumerate(dict.fromkeys(layers)):
            layer = DxfLayer(given, number % _COLOURS + 1) if isinstance(given, str) else given
            drawing.layers.add(layer.name, color=layer.colour, lineweight=layer.weight)
        draw(drawing.modelspace())
        out = io.StringIO()
        drawing.write(out)
    return _plain(out.getvalue())


def _plain(text: str) -> str:
    """Write letters beyond ASCII by their numbers, as DXF has them in any code page."""
    return text if text.isascii() else "".join(_letter(each) for each in text)


def _letter(each: str) -> str:
    units = each.encode("utf-16-be", "surrogatepass")
    numbers = (units[i] << 8 | units[i + 1] for i in range(0, len(units), 2))
    return each if each.isascii() else "".join(f"\\U+{number:04X}" for number in numbers)


@contextmanager
def _no_times(ezdxf: Any) -> Iterator[None]:
    """Let ezdxf write no times and no random numbers: one hull, one file."""
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


def layer_name(name: str) -> str:
    """Give a name of a layer: without the characters that DXF forbids.

    Examples
    --------
    >>> from assoc_hull.io.dxf.lines import layer_name
    >>> layer_name("deck: upper"), layer_name("")
    ('deck_ upper', 'lines')
    """
    return "".join("_" if each in _FORBIDDEN else each for each in name) or "lines"


def add_record(drawing: Any, text: str) -> None:
    """Add a text of the whole drawing, as a record (XRECORD) of its dictionary."""
    record = drawing.rootdict.add_xrecord(NAMES)
    record.reset([(1, word) for word in (NAMES, *pieces_of(text, _WORD))])


def tag_entity(entity: Any, *words: str) -> None:
    """Give an entity the name of its line, and what else is to be known of it."""
    entity.set_xdata(NAMES, [(1000, word) for word in words])


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

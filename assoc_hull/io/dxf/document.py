"""What all our DXF drawings share: unit, layers, names of lines, and no times in them.

R2000 is the oldest form that holds splines, and the one that most programs read. The name of a
line stands in the extended data of its entity, since layers hold groups.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any

import attrs

from assoc_hull.errors import MissingExtraError
from assoc_hull.io.lines.own_lines import MARK, pieces_of

__all__ = [
    "DXF_UNITS",
    "IN_SPACE",
    "NAMES",
    "DxfLayer",
    "DxfUnit",
    "add_record",
    "drawing_text",
    "layer_name",
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
    >>> from assoc_hull.io.dxf.document import layer_name
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

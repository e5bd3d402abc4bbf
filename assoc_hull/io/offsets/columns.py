"""Which column of an offset table holds what, from the header alone.

Known names (any case, blanks or underscores, a unit at the end as in ``x_m`` or ``x [mm]``):
``station``; ``x``; ``z_keel`` or ``keel``; ``z_sheer``, ``z_deck`` or ``deck``; ``y_deck`` or
``deck_half_breadth``; ``wl_0.25`` (a waterline) and ``bt_2.0`` (a buttock).

Examples
--------
>>> from assoc_hull.io.offsets.columns import classify
>>> from assoc_hull.io.offset_report import Notebook
>>> from assoc_hull.io.tables.offset_text import Block
>>> columns = classify(Block("text", ("station", "x_m", "wl_0", "WL 0.25"), (), ()), Notebook())
>>> columns.single["x"].unit, [column.value for column in columns.waterlines]
('m', [0.0, 0.25])
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import pairwise

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.io.offset_report import Notebook
from assoc_hull.io.tables.offset_text import Block

__all__ = ["Column", "Columns", "classify"]

_NUMBERED = re.compile(
    r"(?P<family>wl|waterline|bt|buttock)_?(?P<value>-?([0-9]+\.?[0-9]*|\.[0-9]+)(e-?[0-9]{1,2})?)"
    r"(_?(?P<unit>mm|m|t))?"
)
_UNIT = re.compile(r"(?P<name>.+)_(?P<unit>mm|m)")
_NAMES = {
    "station": ("station", "stations", "stn", "sta", "st", "frame", "no"),
    "x": ("x",),
    "keel": ("z_keel", "keel", "z_profile", "profile"),
    "deck height": ("z_sheer", "sheer", "z_deck", "deck", "deck_height"),
    "deck half-breadth": ("y_deck", "y_sheer", "deck_half_breadth"),
}
_KIND = {name: kind for kind, names in _NAMES.items() for name in names}


@attrs.frozen
class Column:
    """One column.

    Attributes
    ----------
    index : int
        Its place in the row.
    label : str
        Its name as the file prints it.
    unit : str or None
        "m" or "mm" where the name says so, "t" for a waterline in draughts.
    value : float
        Height of a waterline or y of a buttock, in the file's unit; nan for the others.
    """

    index: int
    label: str
    unit: str | None
    value: float = float("nan")


@attrs.frozen
class Columns:
    """The columns of one block.

    Attributes
    ----------
    single : mapping of str to Column
        By kind: "station", "x", "keel", "deck height", "deck half-breadth".
    waterlines, buttocks : tuple of Column
        In the file's order, which is upward and outward.
    """

    single: Mapping[str, Column]
    waterlines: tuple[Column, ...]
    buttocks: tuple[Column, ...]


def classify(block: Block, book: Notebook) -> Columns:
    """Find the columns of a block by their names; unknown ones are noted and left out.

    Raises
    ------
    BadInputError
        No station and no x column, a column that occurs twice, waterlines or buttocks that
        repeat or decrease.
    """
    single: dict[str, Column] = {}
    families: dict[str, list[Column]] = {"wl": [], "bt": []}
    for index, label in enumerate(block.header):
        name = re.sub(r"[\s_\[\]()=:]+", "_", label.lower()).strip("_.")
        numbered = _NUMBERED.fullmatch(name)
        if numbered:
            column = Column(index, label, numbered["unit"], float(numbered["value"]))
            families["wl" if numbered["family"].startswith("w") else "bt"].append(column)
        else:
            _put(single, block, name, index, book)
    if "station" not in single and "x" not in single:
        raise BadInputError(
            "there is neither a station nor an x column",
            f"{block.source}, header {','.join(block.header)[:60]!r}",
            "name one column 'station' or 'x_m'",
        )
    for family in families.values():
        _increasing(family, block)
    return Columns(single, tuple(families["wl"]), tuple(families["bt"]))


def _put(single: dict[str, Column], block: Block, name: str, index: int, book: Notebook) -> None:
    label = block.header[index]
    with_unit = _UNIT.fullmatch(name)
    unit = None
    if name not in _KIND and with_unit:
        name, unit = with_unit["name"], with_unit["unit"]
    kind = _KIND.get(name)
    if kind is None:
        book.assume("column ignored", f"column {label!r}", "it is no offset and was not read")
    elif kind in single:
        raise BadInputError(
            f"columns {single[kind].label!r} and {label!r} both hold the {kind}",
            block.source,
            "leave one of them out",
        )
    else:
        single[kind] = Column(index, label, unit)


def _increasing(columns: list[Column], block: Block) -> None:
    if len({column.unit for column in columns}) > 1:
        raise BadInputError(
            f"columns {columns[0].label!r} to {columns[-1].label!r} are in several units",
            block.source,
            "give all of them in one unit",
        )
    for before, after in pairwise(columns):
        if after.value <= before.value:
            verb = "repeats" if after.value == before.value else "lies below"
            raise BadInputError(
                f"column {after.label!r} {verb} column {before.label!r}",
                block.source,
                "order the columns upward (waterlines) or outward (buttocks), each once",
            )

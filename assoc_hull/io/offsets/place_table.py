"""A table of offsets in ship axes: where its base line and perpendiculars are, and its particulars.

Stations that go by number stand between the perpendiculars, and waterlines are heights above the
base line: such a table stays as it is. What a column x or a column of keel heights leaves open is
found as for any other form, and all is shifted once.
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.lines.ship_frame import ShipFrame, StatedPlaces
from assoc_hull.io.offsets.complete_table import CLOSING, stem_contour, stern_contour
from assoc_hull.io.offsets.net import flat_ends
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.placing.frame import find_frame
from assoc_hull.io.placing.options import FileAxes, FrameOptions
from assoc_hull.io.placing.outline import HullOutline, outline_of_sections
from assoc_hull.io.reports import Note, Notebook, OffsetReport
from assoc_hull.model.tables import Particulars

__all__ = ["place_table", "table_particulars"]

_WHERE = "the table"

_ORIGIN, _LENGTH, _BREADTH = ("frame", "column x"), ("length", _WHERE), ("breadth", _WHERE)
"""Notes by which a reader tells what it could only suppose: here it is found, and told anew."""


def place_table(
    table: OffsetTable, notes: OffsetReport, options: FrameOptions, axes: FileAxes
) -> tuple[OffsetTable, OffsetReport, ShipFrame]:
    """Put a table (m) into ship axes; `axes` tells how places in the file become m.

    Raises
    ------
    BadInputError
        As for `assoc_hull.io.placing.frame.find_frame`.
    """
    supposed = {(note.kind, note.where) for note in notes.assumptions}
    parts = (notes.repairs, notes.suspicions, notes.faults)
    book = Notebook(list(_kept(notes.assumptions)), *map(list, parts))
    outline = outline_of_table(table)
    frame = find_frame(
        outline, options, book, _WHERE, axes=axes,
        stated=_stated(table, options, supposed, from_fp="frame" in notes.kinds("repairs")),
    )  # fmt: skip
    return _shifted(table, frame), book.report(), frame


def _kept(notes: tuple[Note, ...]) -> tuple[Note, ...]:
    again = (_ORIGIN, _LENGTH, _BREADTH)
    return tuple(note for note in notes if (note.kind, note.where) not in again)


def _stated(
    table: OffsetTable, options: FrameOptions, supposed: set[tuple[str, str]], *, from_fp: bool
) -> StatedPlaces:
    """Give what the table says of itself; `from_fp`: its x was counted from there."""
    found: dict[str, Any] = {}
    evidence = dict.fromkeys(("length", "breadth", "draught"), "")  # told when it was read
    evidence["base"] = "heights in a table are above it"
    if _ORIGIN not in supposed and options.ap is options.fp is None:
        found |= {"ap": 0.0, "fp": table.length}
        if _LENGTH in supposed:  # one end is known; where the other is, the hull tells
            found.pop("ap" if from_fp else "fp")
        evidence |= {name: "by the stations of the table" for name in ("ap", "fp")}
    if _LENGTH not in supposed:
        found["length"] = table.length
    if _BREADTH not in supposed:
        found["breadth"] = table.breadth
    top = float(table.z[-1])
    if "D" in table.stated:
        found["depth"] = table.stated["D"]
    elif table.deck_height is None:
        found["depth"] = top - min(0.0, float(table.z[0]))
        evidence["depth"] = "the highest waterline, because nothing tells it; give depth="
    if table.draught is None and table.z[0] >= 0.0:
        found["draught"] = top
        evidence["draught"] = "the highest waterline, because nothing tells it; give draught="
    elif options.mean_draught is None:
        found["draught"] = table.draught
    if table.keel is None and table.z[0] >= 0.0:
        found["base"] = 0.0
    return StatedPlaces(**found, evidence=evidence)


def outline_of_table(table: OffsetTable) -> HullOutline:
    """Outline a table by its stations, its keel if it has one, and the ends of its waterlines."""
    sections = [
        np.column_stack([np.full(known.sum(), x), y[known], table.z[known]])
        for x, y in zip(table.x.tolist(), table.half_breadth, strict=True)
        for known in (np.isfinite(y),) if known.any()
    ]  # fmt: skip
    sections = [_up_to_deck(table, section) for section in sections]
    if table.keel is None:
        contour = [np.column_stack([end, table.z]) for end in _end_places(table)]
        contour.append(np.array([section[0, [0, 2]] for section in sections]))
    else:
        contour = [_keel_and_ends(table, table.keel)]
    contour = [each[np.isfinite(each).all(axis=1)] for each in contour]
    deck = None
    if table.deck_height is not None and np.isfinite(table.deck_height).sum() > 1:
        known = np.isfinite(table.deck_height)
        deck = np.column_stack([table.x, table.deck_height])[known]
    return outline_of_sections(sections, contour, deck, bare=table.keel is None)


def _up_to_deck(table: OffsetTable, section: FloatArray) -> FloatArray:
    """Carry a section (n, 3) on to the deck edge, where the table has it above: the hull's top."""
    if table.deck_height is None or table.deck_half_breadth is None:
        return section
    i = int(np.flatnonzero(table.x == section[0, 0])[0])
    edge = np.array([table.x[i], table.deck_half_breadth[i], table.deck_height[i]])
    if not np.isfinite(edge).all() or edge[2] <= section[-1, 2]:
        return section
    return np.vstack([section, edge])


def _keel_and_ends(table: OffsetTable, keel: FloatArray) -> FloatArray:
    """Give the keel, carried on by the ends of waterlines where these are higher."""
    known = np.isfinite(keel)
    middle = np.column_stack([table.x[known], keel[known]])
    ends = _end_places(table)
    parts = [middle]
    if len(middle):
        rows = table.z > middle[-1, 1]
        parts.append(np.column_stack([ends[0], table.z])[rows])
    if len(middle) and len(ends) > 1:
        rows = table.z > middle[0, 1]
        parts.insert(0, np.column_stack([ends[1], table.z])[rows][::-1])
    return np.concatenate(parts)


def _end_places(table: OffsetTable) -> list[FloatArray]:
    """Give where each waterline ends, forward and, where the table tells, aft."""
    aft, fore = flat_ends(table)
    found = [np.full(len(table.z), table.x[-1]) if fore else stem_contour(table)]
    try:
        found.append(np.full(len(table.z), table.x[0]) if aft else stern_contour(table))
    except BadInputError:  # the run of the table tells no stern: its stations do
        return found
    return found


def _shifted(table: OffsetTable, frame: ShipFrame) -> OffsetTable:
    """Move a table, and let it have the particulars by which its lines are named."""
    sizes: dict[str, Any] = {"length": frame.length, "draught": frame.draught, "depth": frame.depth}
    if frame.origins["draught"] == "stated" and table.draught is None:
        sizes.pop("draught")
    x, z = frame.shift if frame.moves else (0.0, 0.0)
    if x or frame.length != table.length:
        # A stern that is drawn goes on as far as it did when the perpendiculars were found by it.
        sizes["closing"] = (CLOSING * table.length - x) / frame.length
    if not frame.moves:
        return attrs.evolve(table, **sizes)
    heights = ("keel", "deck_height", "buttock_height")
    moved: dict[str, Any] = {
        name: getattr(table, name) + z for name in heights if getattr(table, name) is not None
    }
    return attrs.evolve(table, x=table.x + x, z=table.z + z, **moved, **sizes)


def table_particulars(table: OffsetTable, frame: ShipFrame, deck: str) -> Particulars:
    """Give the particulars of a placed table."""
    return Particulars(table.name, frame.length, frame.breadth, frame.depth, frame.draught, deck)

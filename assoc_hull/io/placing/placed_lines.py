"""Digitised lines put into ship axes: the frame is found, then all is shifted once."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.io.lines.raw_lines import plane_name
from assoc_hull.io.lines.ship_frame import ShipFrame, StatedPlaces
from assoc_hull.io.lines.slices import AXES, HullSlices, SliceLine
from assoc_hull.io.placing.frame import find_frame, fitting_places
from assoc_hull.io.placing.options import FileAxes, FrameOptions
from assoc_hull.io.placing.outline import outline_of_slices
from assoc_hull.io.reports import Notebook
from assoc_hull.tolerance import settled

__all__ = ["place_slices", "shift_slices"]

_WHERE = "the lines"


def place_slices(
    slices: HullSlices,
    options: FrameOptions,
    axes: FileAxes,
    book: Notebook,
    stated: StatedPlaces | None = None,
) -> HullSlices:
    """Give lines in ship axes, with their frame; `book` holds what was told before.

    Raises
    ------
    BadInputError
        As for `assoc_hull.io.placing.frame.find_frame`.
    """
    outline = outline_of_slices(slices)
    said = None if stated is None else fitting_places(stated, outline, options, book, _WHERE)
    frame = find_frame(outline, options, book, _WHERE, axes=axes, stated=said)
    frame = _rounded(frame, slices.factor)
    moved = shift_slices(slices, frame, book) if frame.moves else slices
    return attrs.evolve(moved, frame=frame, report=book.report())


_DIGITS = 9
"""Places that are found are rounded to so many digits of a metre, at the size of 100 m."""


def _rounded(frame: ShipFrame, factor: float) -> ShipFrame:
    """Round places that were found, so that decimals of a file stay decimals in ship axes."""
    known = ("given", "stated")
    found = {
        name: round(getattr(frame, name) / factor, _DIGITS) * factor
        for name in ("ap", "fp", "base") if frame.origins.get(name, known[0]) not in known
    }  # fmt: skip
    return attrs.evolve(frame, **found)


def shift_slices(slices: HullSlices, frame: ShipFrame, book: Notebook) -> HullSlices:
    """Move all lines of a hull; those named after their plane are named after the new one."""
    by = np.array([frame.shift[0], 0.0, frame.shift[1]])
    factor = slices.factor
    lines = tuple(_shifted(line, frame, factor) for line in slices.lines)
    _tell_names(slices.lines, lines, book)
    joins = tuple(
        attrs.evolve(join, place=tuple((np.array(join.place) + by).tolist()))
        for join in slices.joins
    )
    names = {old.name: new.name for old, new in zip(slices.lines, lines, strict=True)}
    return attrs.evolve(
        slices, lines=lines, joins=joins, low=slices.low + by, high=slices.high + by,
        boundaries=tuple(_shifted(line, frame, factor) for line in slices.boundaries),
        knuckles={names.get(name, name): xyz + by for name, xyz in slices.knuckles.items()},
    )  # fmt: skip


def _shifted(line: SliceLine, frame: ShipFrame, factor: float) -> SliceLine:
    pieces = tuple(
        attrs.evolve(piece, points=settled(frame.moved(piece.points), factor))
        for piece in line.pieces
    )
    if line.group == "boundary":
        return attrs.evolve(line, pieces=pieces)
    by = (frame.shift[0], 0.0, frame.shift[1])[AXES[line.group]]
    offset = round((line.offset + by) / factor, _DIGITS) * factor
    name = plane_name(line.group, offset) if _by_place(line) else line.name
    flat = []
    for piece in pieces:
        points = piece.points.copy()
        points[:, AXES[line.group]] = offset  # the plane and its points stay one to the bit
        flat.append(attrs.evolve(piece, points=points))
    return attrs.evolve(line, offset=offset, name=name, pieces=tuple(flat))


def _by_place(line: SliceLine) -> bool:
    """Tell whether a line goes by the number of its place."""
    return line.name == plane_name(line.group, line.offset)


def _tell_names(
    before: tuple[SliceLine, ...], after: tuple[SliceLine, ...], book: Notebook
) -> None:
    """Say which names changed with the places, and which stay though the lines moved."""
    new = [(a.name, b.name) for a, b in zip(before, after, strict=True) if a.name != b.name]
    if new:
        what = f"{len(new)} lines that go by their place are named after it: {new[0][0]} is now "
        book.repair("names", _WHERE, f"{what}{new[0][1]}", len(new))
    kept = [
        b.name for a, b in zip(before, after, strict=True)
        if a.name == b.name and a.offset != b.offset and any(c.isdigit() for c in a.name)
    ]  # fmt: skip
    if kept:
        what = f"{len(kept)} lines keep their names as {kept[0]}, though they were moved"
        book.assume("names", _WHERE, what, len(kept))

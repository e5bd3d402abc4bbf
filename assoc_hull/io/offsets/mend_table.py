"""A table of offsets with slips put right: its own text, other numbers in those cells alone.

The text stays as it is, with its comments, marks and decimal commas; every change is told in a
comment above it. What was mended is read again: no other number may have changed.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.fairing.offsets_doctor import OffsetFinding
from assoc_hull.io.offsets.printed import rows_in_order
from assoc_hull.io.offsets.read import read_printed
from assoc_hull.io.offsets.sheet import OffsetSheet
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.table_text import read_text
from assoc_hull.io.write_file import write_whole

__all__ = ["mended_text", "write_mended"]


def write_mended(
    source: str | Path, target: str | Path, sheet: OffsetSheet, slips: tuple[OffsetFinding, ...],
    centre: float | str | None, *, replace: bool,
) -> None:  # fmt: skip
    """Write a table with slips put right beside the one it was read from.

    Raises
    ------
    BadInputError
        The place is the table itself, or is taken and is not to be replaced; a cell cannot be
        found in the text.
    """
    place = Path(target)
    if "\n" not in str(source) and place.exists() and place.samefile(source):
        what = "the mended table would be written over the table itself"
        raise BadInputError(what, f"at {place}", "give another name")
    if place.exists() and not replace:
        what = "there is a file of this name"
        raise BadInputError(what, f"at {place}", "give another name, or replace it")
    if place.suffix.lower() in (".xlsx", ".hull", ".json"):
        what = "a mended table is written as text"
        raise BadInputError(what, f"at {place}", "end the name in .csv")
    text, name = read_text(source, Notebook())
    mended = mended_text(text, name, sheet, slips)
    _require_same(mended, sheet, slips, centre)
    write_whole(place, mended.encode())


def mended_text(
    text: str, source: str, sheet: OffsetSheet, slips: tuple[OffsetFinding, ...]
) -> str:
    """Give the text of a table with the likeliest numbers in the cells of slips.

    Raises
    ------
    BadInputError
        A cell does not stand in the text as it was read.
    """
    lines = text.lstrip("\N{ZERO WIDTH NO-BREAK SPACE}").splitlines(keepends=True)
    rows, block = rows_in_order(sheet), sheet.block
    for slip in slips:
        row, column = rows[slip.row], sheet.columns.waterlines[slip.column].index
        line = block.across[column] if block.across else block.lines[row]
        cells, at = (
            ((block.header[column], *(each[column] for each in block.rows)), row + 1)
            if block.across else (block.rows[row], column)
        )  # fmt: skip
        before = lines[line - 1]
        after = _with_cell(before, cells, at, slip.mended)
        if after is None:
            raise BadInputError(
                f"the cell {cells[at]!r} is not found in its line", block.where(row, column),
                f"write {slip.mended} there by hand",
            )  # fmt: skip
        # A row that is repeated was read once; both must stay the same.
        lines = [after if each.strip() == before.strip() else each for each in lines]
    told = [
        f"# mended: station {slip.station}, waterline {slip.waterline}: {slip.printed} to "
        f"{slip.mended}, score {slip.score:.1f}"
        + (f", {slip.numbers[0].slip}" if slip.numbers else ", as its neighbours ask for")
        for slip in slips
    ]  # fmt: skip
    told = told or ["# no slip is called: nothing was mended"]
    return "".join(f"{each}\n" for each in told) + "".join(lines)


def _with_cell(line: str, cells: tuple[str, ...], at: int, number: str) -> str | None:
    """Give a line with another number in one of its cells; None where that is not found."""
    place = 0
    pointed = [each for each in cells if "." in each]
    commas = bool(pointed) and not any(each in line for each in pointed)
    for k, cell in enumerate(cells):
        there = [(line.find(form, place), form) for form in (cell, cell.replace(".", ","))]
        place, shown = min((each for each in there if each[0] >= 0), default=(-1, ""))
        if place < 0:
            return None
        if k == at:
            sign = "-" if cell.startswith("-") else ""
            written = f"{sign}{number.replace('.', ',') if commas else number}"
            return f"{line[:place]}{written}{line[place + len(shown) :]}"
        place += len(shown)
    return None


def _require_same(
    mended: str, sheet: OffsetSheet, slips: tuple[OffsetFinding, ...], centre: float | str | None
) -> None:
    """Read what was mended, and refuse it unless the cells of the slips alone are others."""
    again, _ = read_printed(mended, centre)
    rows = rows_in_order(sheet)
    before, after = sheet.offsets[rows].copy(), again.offsets[rows_in_order(again)]
    same_size = before.shape == after.shape
    for slip in slips if same_size else ():
        before[slip.row, slip.column] = after[slip.row, slip.column] = 0.0
    if not same_size or not np.array_equal(before, after, equal_nan=True):
        what = "the mended table reads otherwise than the table in other cells too"
        raise BadInputError(what, sheet.block.source, "write the numbers by hand")

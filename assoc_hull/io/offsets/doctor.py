"""The doctor of offsets for a file: reads a table as printed, tells its slips, writes a mended one.

Neither unit nor length of the ship need be known: half-breadths are judged in their own unit.
"""

from __future__ import annotations

import os
from pathlib import Path

import attrs
import numpy as np

from assoc_hull.arguments import file_path, flag, integer, regular_file
from assoc_hull.errors import BadInputError
from assoc_hull.fairing.offsets_doctor import DoctorReport, OffsetFinding, examine
from assoc_hull.io.offsets.read import read_printed
from assoc_hull.io.offsets.sheet import OffsetSheet, rows_in_order
from assoc_hull.io.open_databases import is_hull_file
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.table_text import read_text
from assoc_hull.io.write_file import write_whole

__all__ = ["doctor"]

# --------------------------------------------------------------------------------------
# A table of offsets with slips put right: its own text, other numbers in those cells alone.
#
# The text stays as it is, with its comments, marks and decimal commas; every change is told in a
# comment above it. What was mended is read again: no other number may have changed.


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


_MOST_LISTED = 1000


def doctor(
    path: str | os.PathLike[str],
    *,
    top: int = 10,
    centre: float | str | None = None,
    mend: str | os.PathLike[str] | None = None,
    replace: bool = False,
) -> DoctorReport:
    r"""Look for slips of the hand in a table of offsets, before a hull is made of it.

    Each half-breadth is judged by the battens through five neighbouring cells along its station
    and its waterline, and by what these do on the lines beside. A number with a score above 15 is
    called a slip; beside the number that its neighbours ask for stand up to three that one slip
    makes of the printed one: two digits exchanged, one digit other, decimal point, the cell beside.
    Nothing is changed. A run of cells shorter than five, heights of buttocks, keel and deck are not
    looked at.

    The batten is lifted off a point as in the loft; the likelihood is that of Cauchy's
    distribution: P.J. Huber, "Robust Statistics", Wiley, 1981.

    Parameters
    ----------
    path : path or str
        A table of offsets (CSV, TSV, XLSX), or its text, with line breaks. Units, length and
        draught need not be known.
    top : int
        So many findings are listed at least, those that are no slips after those that are.
    centre : float, str or None
        From where half-breadths of one of two hulls are counted, as for `assoc_hull.read`.
    mend : path or None
        Where to write the table with all slips put right, each to the first number of one slip, or
        to the one that its neighbours ask for; comments above it list every change. A table without
        a slip is written as it is.
    replace : bool
        Write over a file at `mend`; the table itself is never written over.

    Returns
    -------
    DoctorReport
        With ``findings``, ``alarms``, ``remarks``, ``unchecked``; as text, all of them.

    Raises
    ------
    BadInputError
        The file cannot be read or is no table of offsets; `mend` is the table itself, or there is
        a file and `replace` is not given; so many slips that whole lines must be wrong.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> rows = [[i, *(round(50 * i * (10 - i) * (1 - (6 - j) ** 2 / 50)) for j in range(7))]
    ...         for i in range(11)]
    >>> rows[4][4] = 948  # for 984
    >>> text = "station,wl_0,wl_1,wl_2,wl_3,wl_4,wl_5,wl_6"
    >>> [slip] = ah.doctor("\n".join([text, *(",".join(map(str, row)) for row in rows)])).alarms
    >>> slip.station, slip.waterline, slip.printed, slip.proposed, slip.numbers[0].slip
    ('4', '3', '948', '984', 'two digits exchanged')
    """
    count = integer(top, "top", "in doctor", least=0, most=_MOST_LISTED)
    over = flag(replace, "replace", "in doctor")
    given = path if isinstance(path, str) and "\n" in path else _file(path)
    sheet, printed = read_printed(given, centre)
    found = examine(printed, count)
    if mend is None:
        return found
    target = file_path(mend, "in doctor, mend")
    if found.overrun:
        raise BadInputError(
            f"{len(found.alarms)} slips are called and more are there: whole rows or columns are "
            "wrong", f"in {found.name}", "put these right by hand; nothing was written",
        )  # fmt: skip
    write_mended(given, target, sheet, found.alarms, centre, replace=over)
    return attrs.evolve(found, written=target)


def _file(path: str | os.PathLike[str]) -> Path:
    file = regular_file(Path(file_path(path, "in doctor")))
    if is_hull_file(file):
        raise BadInputError(
            "this is a hull and no table of offsets", f"at {file}",
            "ask the hull itself: assoc_hull.open(...).doctor()",
        )  # fmt: skip
    return file

"""Blocks of cells out of the text of a table: titles and comments, separators, headers, rows.

`split_blocks` finds comments (lines with ``#``, titles above a header, notes below the rows; unit
and frame often stand there), what parts the cells, and the header rows; a second header row opens a
second block. A block whose stations go across and waterlines down is turned. `cell_number` makes a
number of a cell, nan of a blank.
"""

from __future__ import annotations

import csv
import re
from collections import Counter

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.column_names import (
    cell_value,
    column_name,
    is_corner_of_waterlines,
    is_unit,
    number_like,
    station_label,
    unit_word,
    with_points,
)

__all__ = [
    "TableBlock",
    "cell_number",
    "opens_block",
    "split_blocks",
]

Row = tuple[int, tuple[str, ...]]
"""A line of the file, from 1, and its cells."""

_LARGEST = 1e7  # of any number in a table, in its unit
_PLACES = ("waterline", "buttock")


@attrs.frozen
class TableBlock:
    """One header row and the rows under it, as text.

    Attributes
    ----------
    source : str
        The file, or "text".
    header : tuple of str
        The column names.
    rows : tuple of tuple of str
        The cells, stripped; every row is as long as the header.
    lines : tuple of int
        The line of the file on which each row ends, from 1; of a turned block the column.
    units : tuple of str or None
        Unit of each column where a row under the header tells it; empty without such a row.
    across : tuple of int
        Of a turned block, whose stations go across in the file: the line of each column; else
        empty.
    """

    source: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]
    units: tuple[str | None, ...] = ()
    across: tuple[int, ...] = ()

    def where(self, row: int, column: int) -> str:
        """Say where a cell stands."""
        name = self.rows[row][0]
        if self.across:
            line = f"row {self.across[column]} ({self.header[column]})"
            return f"{self.source}, {line}, column {name or self.lines[row]!r}"
        station = f" (station {name})" if name else ""
        return f"{self.source}, row {self.lines[row]}{station}, column {self.header[column]!r}"

    def row(self, row: int) -> str:
        """Name a row, or the column of the file that became one."""
        return f"{'column' if self.across else 'row'} {self.lines[row]}"


def split_blocks(
    text: str, source: str, book: Notebook
) -> tuple[tuple[str, ...], tuple[TableBlock, ...]]:
    """Split a text into comments and blocks.

    Raises
    ------
    BadInputError
        Ragged rows, a quotation that is never closed, no header, no rows.
    """
    lines = text.lstrip("\N{ZERO WIDTH NO-BREAK SPACE}").splitlines()
    comments = [line.strip().strip(",;\t")[1:].strip() for line in lines if _comment(line)]
    kept = [(k + 1, line) for k, line in enumerate(lines) if line.strip() and not _comment(line)]
    rows, mark = _cells(kept, source)
    rows = [(k, row) for k, row in rows if any(row)]
    if not rows:
        raise BadInputError("there is no row besides comments", source, "give a table of offsets")
    first = _first_header(rows)
    titles = [number for number, _ in rows[:first]]
    rows, notes = _without_notes(rows[first:])
    words = {number: line for number, line in kept if number in {*titles, *notes}}
    if words:
        comments += [_plain_words(line) for line in words.values()]
        shown = ", ".join(f"row {number}" for number in list(words)[:6])
        book.assume("title", shown, "words, no numbers: read as a comment", float(len(words)))
    if not rows:  # as of a header whose marks too few rows have: it is one long word
        what = "there is no row besides words: neither a header nor numbers are parted into cells"
        raise BadInputError(what, source, "part all cells by one mark: commas, semicolons or tabs")
    rows = _decimal_points(rows, mark, source, book)
    starts = [i for i, (_, row) in enumerate(rows) if i == 0 or opens_block(row, within=True)]
    ends = [*starts[1:], len(rows)]
    return tuple(comments), tuple(
        _block(source, rows[a:b], mark, book) for a, b in zip(starts, ends, strict=True)
    )


def _plain_words(line: str) -> str:
    """Give a row of words as a comment: what parts its cells becomes a blank."""
    return " ".join(re.split(r"[\t;|\"]+|,(?![0-9])|(?<![0-9]),", line)).strip()


def _comment(line: str) -> bool:
    return line.lstrip(' \t"').startswith("#")


# --------------------------------------------------------------------------------------
# What parts the cells: tabs, semicolons, bars; commas; else blanks.

_MARKS = ("\t", ";", "|")


def _cells(lines: list[tuple[int, str]], source: str) -> tuple[list[Row], str]:
    """Split rows by the mark that most of them have; " " stands for blanks."""
    mark = _mark([line for _, line in lines])
    if mark == " ":
        width = Counter(len(line.split()) for _, line in lines).most_common(1)[0][0]
        return [(k, _by_blanks(line, width)) for k, line in lines], mark
    try:
        return [(k, _split(line, mark)) for k, line in lines], mark
    except csv.Error as error:
        raise BadInputError(
            f"a row is no {mark!r}-separated text ({error})", source, "mend the quotation marks"
        ) from None


def _mark(lines: list[str]) -> str:
    for mark in _MARKS:
        if 2 * sum(mark in line for line in lines) > len(lines):
            return mark
    # Parted by blanks are rows of which every word is a number: of others a comma ends the word.
    words = [line.split() for line in lines]
    plain = sum(len(row) > 2 and all(number_like(with_points(w)) for w in row) for row in words)
    return " " if 2 * plain > len(lines) else ","


def _split(line: str, mark: str) -> tuple[str, ...]:
    return tuple(cell.strip() for cell in next(csv.reader([line], delimiter=mark, strict=True)))


def _by_blanks(line: str, width: int) -> tuple[str, ...]:
    """Split at blanks; where names hold blanks, at two of them, or not before a number."""
    for pattern in (r"\s+", r"\s{2,}", r"(?<![A-Za-z.])\s+|\s+(?=[A-Za-z])"):
        row = re.split(pattern, line.strip())
        if len(row) == width:
            break
    else:
        row = line.split()
    return tuple(row)


def _decimal_points(rows: list[Row], mark: str, source: str, book: Notebook) -> list[Row]:
    """Turn decimal commas into points: where cells are parted by another mark, a comma is one."""
    mended = [(k, tuple(map(with_points, row))) for k, row in rows]
    changed = [
        (k, old) for (k, row), (_, new) in zip(rows, mended, strict=True)
        for old, after in zip(row, new, strict=True) if old != after
    ]  # fmt: skip
    if not changed:
        return rows
    _refuse_thousands(rows, changed, mark, source)
    count = len(changed)
    book.repair("decimal comma", source, f"{count} cells had a decimal comma", float(count))
    pointed = [(k, c) for k, row in rows[1:] for c in row if re.fullmatch(r"-?[0-9]*\.[0-9]+", c)]
    if pointed:
        fewer = min(changed, pointed, key=len)
        shown = ", ".join(f"{cell} in row {k}" for k, cell in fewer[:3])
        what = f"{count} cells have a decimal comma and {len(pointed)} a point: {shown}"
        book.suspect("decimal comma", f"row {fewer[0][0]}", what, float(len(fewer)))
    return mended


def _refuse_thousands(
    rows: list[Row], changed: list[tuple[int, str]], mark: str, source: str
) -> None:
    """Refuse commas that may part thousands: three digits follow each, beside whole numbers."""
    if not all(re.fullmatch(r"-?[0-9]{1,3},[0-9]{3}", cell) for _, cell in changed):
        return
    whole = any(re.fullmatch(r"[0-9]{2,3}", cell) for _, row in rows[1:] for cell in row[1:])
    if whole or mark == ",":
        line, cell = changed[0]
        raise BadInputError(
            f"{cell} may be {cell.replace(',', '.')} or {cell.replace(',', '')}",
            f"{source}, row {line}",
            "write numbers with a decimal point, and nothing between thousands",
        )


# --------------------------------------------------------------------------------------
# Which row is a header, and which holds words only.


def opens_block(row: tuple[str, ...], *, within: bool = False) -> bool:
    """Tell whether a row is the header of a table: it names stations, or two waterlines.

    `within` a block a row of x over each station is none.
    """
    first = column_name(row[0])
    others = [cell for cell in row[1:] if cell]
    if first and first.kind in ("station", "x") and others:
        return not (within and first.kind == "x" and all(map(number_like, others)))
    names = [column_name(cell) for cell in row if not number_like(cell)]
    return sum(each is not None and each.named and each.kind in _PLACES for each in names) > 1


def _first_header(rows: list[Row]) -> int:
    """Give the number of the first header row; 0 if there is none."""
    for k, (_, row) in enumerate(rows):
        if opens_block(row) or _bare_header(row) or _without_corner(rows, k):
            return k
    return 0


def _bare_header(row: tuple[str, ...]) -> bool:
    """Tell whether a row holds places only, and in its corner a blank or a word."""
    others = [cell for cell in row[1:] if cell]
    if len(others) < 2 or (row[0] and number_like(row[0])):
        return False
    return all(station_label(cell) or column_name(cell) for cell in others)


def _without_corner(rows: list[Row], k: int) -> bool:
    """Tell whether a row of ascending numbers is one cell shorter than all under it."""
    row, under = rows[k][1], rows[k + 1 :]
    values = [cell_value(with_points(cell)) for cell in row]
    numbers = [value for value in values if value is not None]
    rising = len(numbers) == len(row) > 1 and numbers == sorted(set(numbers))
    return rising and bool(under) and all(len(each) == len(row) + 1 for _, each in under)


def _without_notes(rows: list[Row]) -> tuple[list[Row], list[int]]:
    """Take off rows of words alone, below the header; give their lines."""
    kept, notes = [], []
    for number, row in rows:
        name = row[0]
        word = bool(name) and not any(row[1:]) and not number_like(with_points(name))
        if word and not station_label(name) and column_name(name) is None and len(name) > 3:
            notes.append(number)
        else:
            kept.append((number, row))
    return kept, notes


# --------------------------------------------------------------------------------------
# A block.


def _block(source: str, rows: list[Row], mark: str, book: Notebook) -> TableBlock:
    line, header = rows[0]
    header = header[: max((k + 1 for k, cell in enumerate(header) if cell), default=0)]
    if all(number_like(cell) for cell in header) and not _whole_header(rows):
        raise BadInputError(
            "the first row holds numbers only",
            f"{source}, row {line}",
            "put a header such as 'station,wl_0,wl_0.25' above it",
        )
    header = _with_corner(header, rows, source, book)
    _suspect_shift(header, rows, source, book)
    units: tuple[str | None, ...] = ()
    body = rows[1:]
    if body and _is_units(body[0][1]):
        units = tuple(unit_word(cell) for cell in _fit(source, *body[0], len(header), mark, book))
        body = body[1:]
    cells = tuple(_fit(source, k, row, len(header), mark, book) for k, row in body)
    block = TableBlock(source, header, cells, tuple(k for k, _ in body), units)
    return _turned(block, line, book) if _stations_across(block) else block


def _whole_header(rows: list[Row]) -> bool:
    """Tell whether a header of numbers has a blank corner, or lacks it."""
    return (rows[0][1][0] == "" and _bare_header(rows[0][1])) or _without_corner(rows, 0)


def _with_corner(
    header: tuple[str, ...], rows: list[Row], source: str, book: Notebook
) -> tuple[str, ...]:
    """Put a blank corner before a header that begins with a waterline and is a cell too short."""
    first = column_name(header[0]) if header else None
    widths = {len(row) for _, row in rows[1:]}
    if first and first.kind in _PLACES and widths == {len(header) + 1}:
        what = f"the header begins with {header[0]!r}; a cell for the stations was put before it"
        book.repair("missing corner", f"row {rows[0][0]} of {source}", what)
        return ("", *header)
    return header


def _suspect_shift(header: tuple[str, ...], rows: list[Row], source: str, book: Notebook) -> None:
    """Note a header that is a cell shorter than all rows: its names may stand a column off."""
    first = column_name(header[0]) if header else None
    widths = {len(row) for _, row in rows[1:]}
    if first and first.kind != "station" and widths == {len(rows[0][1]) + 1} == {len(header) + 1}:
        what = f"every row has a cell more than the header, which begins with {header[0]!r}"
        where = f"row {rows[0][0]} of {source}"
        book.suspect("missing corner", where, f"{what}: is the name of the first column lost?")


def _is_units(row: tuple[str, ...]) -> bool:
    told = [cell for cell in row if cell not in ("", "-", "--")]
    return bool(told) and all(map(is_unit, told))


def _fit(
    source: str, line: int, row: tuple[str, ...], width: int, mark: str, book: Notebook
) -> tuple[str, ...]:
    """Give a row of the width of the header; surplus cells are dropped if blank."""
    if len(row) > width and not any(row[width:]):
        surplus = len(row) - width
        book.repair("surplus cells", f"row {line}", f"{surplus} empty cells dropped", surplus)
        row = row[:width]
    if len(row) != width:
        comma = "; a decimal comma parts a number in two: part the cells by semicolons then"
        raise BadInputError(
            f"the row has {len(row)} cells and the header {width}",
            f"{source}, row {line} (station {row[0]})",
            "give every row one cell per column; leave a cell empty where there is no offset"
            + (comma if mark == "," and len(row) > width else ""),
        )
    return row


def _stations_across(block: TableBlock) -> bool:
    """Tell whether stations go across and waterlines down: names say so plainly, or numbers."""
    if not block.rows:
        return False
    heads = [column_name(cell) for cell in block.header[1:]]
    if sum(each is not None and each.named for each in heads) > 1:
        return False
    downward = [column_name(row[0]) for row in block.rows]
    named = sum(each is not None and each.named and each.kind in _PLACES for each in downward)
    over = sum(map(station_label, block.header[1:]))
    return (
        2 * named > len(downward)
        or 2 * over > len(block.header) - 1
        or is_corner_of_waterlines(block.header[0])
        or (not any(each is not None and each.named for each in heads) and _runs_across(block))
    )


_RISING, _FALLING = 0.9, 0.5
"""Parts of the columns that rise all the way down, and of the rows that rise and fall again."""

_LOW_END = 0.9
"""A row falls again where both ends lie below this part of its greatest number."""


def _runs_across(block: TableBlock) -> bool:
    """Tell by the numbers: down a section half-breadths rise, along a waterline they fall again."""
    places = [[cell_value(with_points(cell)) for cell in row] for row in block.rows
              if column_name(row[0]) is None or number_like(with_points(row[0]))]  # fmt: skip
    if len(places) < _FEWEST or len(block.header) <= _FEWEST:
        return False
    y = np.array([[np.nan if each is None else each for each in row[1:]] for row in places])
    down = [column[np.isfinite(column)] for column in y.T]
    along = [row[np.isfinite(row)] for row in y]
    rises = [bool((np.diff(each) >= 0.0).all()) for each in down if len(each) > 2]
    falls = [max(each[0], each[-1]) < _LOW_END * each.max() for each in along if len(each) > 2]
    return bool(
        rises and falls
        and sum(rises) >= _RISING * len(rises)
        and sum(falls) >= _FALLING * len(falls)
    )  # fmt: skip


_FEWEST = 3
"""Waterlines and stations of a table whose numbers tell which go across."""


def _across_name(corner: str) -> str:
    """Give the name of what goes across: as the corner says; "" where it names what goes down."""
    name = column_name(corner)
    if name is not None and name.kind in ("station", "x"):
        return corner
    return corner if "\\" in corner or "/" in corner else ""


def _turned(block: TableBlock, line: int, book: Notebook) -> TableBlock:
    """Turn a block about: its rows become columns."""
    book.repair("stations across", block.source, "stations go across and waterlines down: turned")
    words = any(map(station_label, block.header[1:]))
    corner = "station" if words else _across_name(block.header[0])
    header = (corner, *(row[0] for row in block.rows))
    columns = zip(*(row[1:] for row in block.rows), strict=True)
    rows = [(name, *cells) for name, cells in zip(block.header[1:], columns, strict=True)]
    places = tuple(range(2, len(rows) + 2))
    return TableBlock(block.source, header, tuple(rows), places, (), (line, *block.lines))


def cell_number(block: TableBlock, row: int, column: int) -> float:
    """Give the number in a cell, nan for a blank; feet-inches-eighths in feet.

    Raises
    ------
    BadInputError
        The cell holds something else, or a number no ship has.
    """
    cell = block.rows[row][column]
    value = cell_value(cell)
    if value is None:
        raise BadInputError(
            f"{cell!r} is not a number",
            block.where(row, column),
            "write a plain number, or leave the cell empty where there is no offset",
        )
    if abs(value) > _LARGEST:
        raise BadInputError(
            f"{cell} is beyond any ship", block.where(row, column), "correct the number"
        )
    return value

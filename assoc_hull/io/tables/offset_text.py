r"""From a file or a text to blocks of cells: separators, comments, rows and numbers.

A table is one header row and the rows under it. A later row that begins with a header
word again opens a second block. Lines that begin with '#' are comments; they are kept,
because units and frame often stand there.

Examples
--------
>>> from assoc_hull.io.offset_report import Notebook
>>> from assoc_hull.io.tables.offset_text import split_blocks
>>> comments, blocks = split_blocks("# unit: m\nstation,wl_0\n0,1.5\n", "text", Notebook())
>>> comments, blocks[0].header, blocks[0].rows
(('unit: m',), ('station', 'wl_0'), (('0', '1.5'),))
"""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.io.offset_report import Notebook

__all__ = ["Block", "number", "opens_block", "read_text", "split_blocks"]

_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?")
_BLANKS = frozenset({"", "-", "--", "\N{EN DASH}", "\N{EM DASH}"})
_OPENING = re.compile(r"(stations?|stn|sta|st|frame|no|x[ _\[(]*(mm?)?[\])]?)\.?", re.IGNORECASE)
_LARGEST = 1e7
_ARCHIVE = b"PK\x03\x04"
"""What a workbook begins with."""


@attrs.frozen
class Block:
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
        The line of the file on which each row ends, from 1.
    """

    source: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]

    def where(self, row: int, column: int) -> str:
        """Say where a cell stands."""
        station = f" (station {self.rows[row][0]})" if self.rows[row][0] else ""
        return f"{self.source}, row {self.lines[row]}{station}, column {self.header[column]!r}"


def read_text(path_or_text: str | Path, book: Notebook) -> tuple[str, str]:
    """Give the text of a table and the name of its source.

    Parameters
    ----------
    path_or_text : str or Path
        A path, or the text itself: a string with a line break is a text.
    book : Notebook
        Takes a note when the file is not UTF-8.

    Raises
    ------
    BadInputError
        The file is missing, unreadable, binary or empty.
    """
    if isinstance(path_or_text, str) and ("\n" in path_or_text or "\r" in path_or_text):
        text, source = path_or_text, "text"
    else:
        text, source = _read_file(path_or_text, book)
    if re.search(r"[\x00-\x08\x0e-\x1f]", text):
        raise BadInputError("the content is binary", source, "give a CSV or TSV text file")
    if not text.strip():
        raise BadInputError("there is nothing in it", source, "give a table of offsets")
    return text, source


def _read_file(path: str | Path, book: Notebook) -> tuple[str, str]:
    if not str(path).strip():
        raise BadInputError("the name is empty", "path_or_text", "give a file or a text")
    try:
        raw = Path(path).read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise BadInputError(
            f"the file cannot be read ({reason})", str(path), "check the path"
        ) from None
    if raw.startswith(_ARCHIVE):
        from assoc_hull.io.tables.offset_xlsx import text_of_xlsx

        return text_of_xlsx(raw, str(path), book), str(path)
    try:
        return raw.decode("utf-8-sig"), str(path)
    except UnicodeDecodeError:
        book.repair("encoding", str(path), "not UTF-8, read as Latin-1")
        return raw.decode("latin-1"), str(path)


def split_blocks(
    text: str, source: str, book: Notebook
) -> tuple[tuple[str, ...], tuple[Block, ...]]:
    """Split a text into comments and blocks.

    Raises
    ------
    BadInputError
        Ragged rows, a quotation that is never closed, no header, no rows.
    """
    lines = text.lstrip("\N{ZERO WIDTH NO-BREAK SPACE}").splitlines()
    comments = tuple(line.strip().strip(",;\t")[1:].strip() for line in lines if _comment(line))
    kept = [(k + 1, line) for k, line in enumerate(lines) if line.strip() and not _comment(line)]
    rows = _cells(kept, source, book)
    rows = [(k, row) for k, row in rows if any(row)]
    if not rows:
        raise BadInputError("there is no row besides comments", source, "give a table of offsets")
    starts = [i for i, (_, row) in enumerate(rows) if i == 0 or opens_block(row[0])]
    ends = [*starts[1:], len(rows)]
    return comments, tuple(
        _block(source, rows[a:b], book) for a, b in zip(starts, ends, strict=True)
    )


def opens_block(cell: str) -> bool:
    """Tell whether a row that begins with this cell is the header of a table."""
    return _OPENING.fullmatch(cell) is not None


def _comment(line: str) -> bool:
    return line.lstrip(' \t"').startswith("#")


def _cells(
    lines: list[tuple[int, str]], source: str, book: Notebook
) -> list[tuple[int, tuple[str, ...]]]:
    first = lines[0][1] if lines else ""
    mark = max("\t;,", key=first.count)
    try:
        rows = [(k, _split(line, mark)) for k, line in lines]
    except csv.Error as error:
        raise BadInputError(
            f"a row is no {mark!r}-separated text ({error})", source, "mend the quotation marks"
        ) from None
    return rows if mark == "," else _decimal_points(rows, source, book)


def _split(line: str, mark: str) -> tuple[str, ...]:
    return tuple(cell.strip() for cell in next(csv.reader([line], delimiter=mark, strict=True)))


def _decimal_points(
    rows: list[tuple[int, tuple[str, ...]]], source: str, book: Notebook
) -> list[tuple[int, tuple[str, ...]]]:
    comma = re.compile(r"(?<=[0-9]),(?=[0-9]+$)")
    mended = [(k, tuple(comma.sub(".", cell) for cell in row)) for k, row in rows]
    count = sum(
        a != b
        for (_, x), (_, y) in zip(rows, mended, strict=True)
        for a, b in zip(x, y, strict=True)
    )
    if count:
        book.repair("decimal comma", source, f"{count} cells had a decimal comma", float(count))
    return mended


def _block(source: str, rows: list[tuple[int, tuple[str, ...]]], book: Notebook) -> Block:
    line, header = rows[0]
    header = header[: max((k + 1 for k, cell in enumerate(header) if cell), default=0)]
    if all(number_like(cell) for cell in header):
        raise BadInputError(
            "the first row holds numbers only",
            f"{source}, row {line}",
            "put a header such as 'station,wl_0,wl_0.25' above it",
        )
    body = tuple(_fit(source, k, row, len(header), book) for k, row in rows[1:])
    return Block(source, header, body, tuple(k for k, _ in rows[1:]))


def _fit(
    source: str, line: int, row: tuple[str, ...], width: int, book: Notebook
) -> tuple[str, ...]:
    if len(row) > width and not any(row[width:]):
        surplus = len(row) - width
        book.repair("surplus cells", f"row {line}", f"{surplus} empty cells dropped", surplus)
        row = row[:width]
    if len(row) != width:
        raise BadInputError(
            f"the row has {len(row)} cells and the header {width}",
            f"{source}, row {line} (station {row[0]})",
            "give every row one cell per column; leave a cell empty where there is no offset",
        )
    return row


def number_like(cell: str) -> bool:
    """Say whether a cell is blank or a number."""
    return cell in _BLANKS or _NUMBER.fullmatch(cell) is not None


def number(block: Block, row: int, column: int) -> float:
    """Give the number in a cell, nan for a blank.

    Raises
    ------
    BadInputError
        The cell holds something else, or a number no ship has.
    """
    cell = block.rows[row][column]
    if cell in _BLANKS:
        return math.nan
    if not _NUMBER.fullmatch(cell):
        raise BadInputError(
            f"{cell!r} is not a number",
            block.where(row, column),
            "write a plain number, or leave the cell empty where there is no offset",
        )
    value = float(cell)
    if abs(value) > _LARGEST:
        raise BadInputError(
            f"{cell} is beyond any ship", block.where(row, column), "correct the number"
        )
    return value

"""Digitised lines as text: lists of points in CSV, or the polylines of a DXF drawing."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.io.digitised_dxf import parse_dxf
from assoc_hull.io.digitised_piece import RawPiece, read_number
from assoc_hull.io.offset_report import Notebook

__all__ = ["is_digitised", "parse_lines"]

_COLUMNS = ("line", "x", "y", "z")


def is_digitised(text: str) -> bool:
    r"""Tell whether a text holds digitised lines rather than a table of offsets.

    Examples
    --------
    >>> from assoc_hull.io.digitised_text import is_digitised
    >>> is_digitised("line,x,y,z\nST 1,0,0,0\n"), is_digitised("station,wl_0,wl_1\n")
    (True, False)
    """
    if re.search(r"^\s*0\s*\r?\n\s*SECTION\s*$", text[:2000], re.MULTILINE):
        return True
    first = next((row for row in text.splitlines() if row.strip() and row.lstrip()[0] != "#"), "")
    names = {
        word.strip().lower().strip('"') for word in re.split(r"[,;\t]", first.lstrip("\ufeff"))
    }
    return set(_COLUMNS) <= names


def parse_lines(text: str, source: str, book: Notebook) -> list[RawPiece]:
    """Read the pieces of all lines.

    Parameters
    ----------
    text : str
        CSV with the columns line, x, y, z and optionally piece, comma-, semicolon- or
        tab-separated, a blank row beginning another piece; or DXF, the layer of a polyline
        naming its line.
    source : str
        Name of the file, for messages.
    book : Notebook
        Takes what a drawing holds and polylines do not.

    Raises
    ------
    BadInputError
        Neither form, a cell that is no number, or no points.
    """
    if not is_digitised(text):
        raise BadInputError(
            "there are no columns line, x, y, z", f"at {source}",
            "give them in the first row, or a DXF file with polylines",
        )  # fmt: skip
    dxf = "SECTION" in text[:2000] and not text.lstrip().lower().startswith("line")
    found = parse_dxf(text, source, book) if dxf else _parse_csv(text, source)
    if not found:
        told = "".join(f"; {note.what}" for note in book.suspicions)
        raise BadInputError(
            f"there are no points{told}", f"at {source}", "give two or more per line"
        )  # fmt: skip
    return found


def _parse_csv(text: str, source: str) -> list[RawPiece]:
    rows = text.lstrip("\ufeff").splitlines()
    head = next(i for i, row in enumerate(rows) if row.strip() and row.lstrip()[0] != "#")
    mark = next((each for each in ";\t" if each in rows[head]), ",")
    names = [word.strip().lower().strip('"') for word in rows[head].split(mark)]
    for name in _COLUMNS:
        if name not in names:
            raise BadInputError(
                f"the separator is {mark!r}, and there is no column {name}",
                f"row {head + 1} of {source}", "separate all columns in one way",
            )  # fmt: skip
    at = [names.index(name) for name in _COLUMNS]
    piece_at = names.index("piece") if "piece" in names else -1
    found: dict[tuple[str, str, int], list[tuple[float, ...]]] = {}
    first: dict[tuple[str, str, int], int] = {}
    part = 0
    for number, cells in _cells(rows, head + 1, mark, source):
        if not any(cell.strip() for cell in cells):
            part += 1
            continue
        if cells[0].lstrip().startswith("#"):
            continue
        where = f"row {number} of {source}"
        if len(cells) <= max(at):
            raise BadInputError(f"{len(cells)} cells", where, f"give {len(names)}")
        name = cells[at[0]].strip()
        label = cells[piece_at].strip() if 0 <= piece_at < len(cells) else ""
        key = (name, label, part if piece_at < 0 else 0)
        first.setdefault(key, number)
        found.setdefault(key, []).append(
            tuple(read_number(cells[i], where, comma=mark != ",") for i in at[1:])
        )
    return [
        RawPiece(key[0], np.array(points), f"row {first[key]} of {source}")
        for key, points in found.items()
    ]


def _cells(rows: list[str], first: int, mark: str, source: str) -> Iterator[tuple[int, list[str]]]:
    """Give the cells of each row, with its number in the file."""
    reader = csv.reader(io.StringIO("\n".join(rows[first:])), delimiter=mark)
    try:
        yield from enumerate(reader, start=first + 1)
    except csv.Error as error:
        where = f"row {first + reader.line_num} of {source}"
        raise BadInputError(f"the row cannot be read ({error})", where, "correct it") from None

"""Digitised lines as text: points in CSV, curves of DXF or IGES, or a form of another program."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterator

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.io.digitised.dxf import parse_dxf
from assoc_hull.io.digitised.iges import parse_iges
from assoc_hull.io.export.britfair import is_britfair, parse_britfair
from assoc_hull.io.export.delftship import is_delftship, parse_delftship
from assoc_hull.io.export.delftship_offsets import is_delftship_offsets, parse_delftship_offsets
from assoc_hull.io.export.gf_read import is_gf, parse_gf
from assoc_hull.io.iges.text import looks_like_iges
from assoc_hull.io.lines.digitised_piece import RawPiece, read_number
from assoc_hull.io.lines.raw_lines import RawLines
from assoc_hull.io.offset_report import Notebook

__all__ = ["is_digitised", "parse_lines"]

_COLUMNS = ("line", "x", "y", "z")

Parse = Callable[[str, str, Notebook], RawLines]


def is_digitised(text: str) -> bool:
    r"""Tell whether a text holds digitised lines rather than a table of offsets.

    Examples
    --------
    >>> from assoc_hull.io.digitised.text import is_digitised
    >>> is_digitised("line,x,y,z\nST 1,0,0,0\n"), is_digitised("station,wl_0,wl_1\n")
    (True, False)
    """
    return _parser(text) is not None


def parse_lines(text: str, source: str, book: Notebook) -> RawLines:
    """Read the pieces of all lines.

    Parameters
    ----------
    text : str
        CSV with the columns line, x, y, z and optionally piece, comma-, semicolon- or
        tab-separated, a blank row beginning another piece; DXF, the layer of a polyline
        naming its line; BRITFAIR; curves or offsets of DELFTship; or a GHS geometry file.
    source : str
        Name of the file, for messages.
    book : Notebook
        Takes what a form holds and polylines do not.

    Raises
    ------
    BadInputError
        None of these forms, a cell that is no number, or no points.
    """
    parse = _parser(text)
    if parse is None:
        raise BadInputError(
            "there are no columns line, x, y, z", f"at {source}",
            "give them in the first row, or a DXF file with polylines",
        )  # fmt: skip
    found = parse(text, source, book)
    if not found.pieces:
        told = "".join(f"; {note.what}" for note in book.suspicions)
        raise BadInputError(
            f"there are no points{told}", f"at {source}", "give two or more per line"
        )  # fmt: skip
    return found


def _parser(text: str) -> Parse | None:
    """Tell by the content what reads a text; None if it holds no digitised lines."""
    forms: tuple[tuple[Callable[[str], bool], Parse], ...] = (
        (_is_csv, _parse_csv), (_is_dxf, parse_dxf), (is_britfair, parse_britfair),
        (is_delftship, parse_delftship), (is_gf, parse_gf),
        (looks_like_iges, parse_iges),
        (is_delftship_offsets, parse_delftship_offsets),  # tells by one row: a title may look alike
    )  # fmt: skip
    return next((parse for is_form, parse in forms if is_form(text)), None)


def _is_dxf(text: str) -> bool:
    return re.search(r"^\s*0\s*\r?\n\s*SECTION\s*$", text[:2000], re.MULTILINE) is not None


def _is_csv(text: str) -> bool:
    first = next((row for row in text.splitlines() if row.strip() and row.lstrip()[0] != "#"), "")
    names = {
        word.strip().lower().strip('"') for word in re.split(r"[,;\t]", first.lstrip("\ufeff"))
    }
    return set(_COLUMNS) <= names


def _parse_csv(text: str, source: str, book: Notebook) -> RawLines:
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
    return RawLines(
        [
            RawPiece(key[0], np.array(points), f"row {first[key]} of {source}")
            for key, points in found.items()
        ]
    )


def _cells(rows: list[str], first: int, mark: str, source: str) -> Iterator[tuple[int, list[str]]]:
    """Give the cells of each row, with its number in the file."""
    reader = csv.reader(io.StringIO("\n".join(rows[first:])), delimiter=mark)
    try:
        yield from enumerate(reader, start=first + 1)
    except csv.Error as error:
        where = f"row {first + reader.line_num} of {source}"
        raise BadInputError(f"the row cannot be read ({error})", where, "correct it") from None

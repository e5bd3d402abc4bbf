"""Digitised lines as text: lists of points in CSV, or the polylines of a DXF drawing."""

from __future__ import annotations

import csv
import io
import re

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["RawPiece", "is_digitised", "parse_lines"]

_COLUMNS = ("line", "x", "y", "z")
_AXES = {10: 0, 20: 1, 30: 2}


@attrs.frozen(eq=False)
class RawPiece:
    """One polyline as the file gives it.

    Attributes
    ----------
    line : str
        Name of the line it belongs to.
    points : (n, 3)
        In the unit of the file.
    where : str
        Row or entity, for messages.
    """

    line: str
    points: FloatArray
    where: str


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


def parse_lines(text: str, source: str) -> list[RawPiece]:
    """Read the pieces of all lines.

    Parameters
    ----------
    text : str
        CSV with the columns line, x, y, z and optionally piece, comma-, semicolon- or
        tab-separated, a blank row beginning another piece; or DXF, the layer of a polyline
        naming its line.
    source : str
        Name of the file, for messages.

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
    found = _parse_dxf(text, source) if dxf else _parse_csv(text, source)
    if not found:
        raise BadInputError("there are no points", f"at {source}", "give two or more per line")
    return found


def _parse_csv(text: str, source: str) -> list[RawPiece]:
    rows = text.lstrip("\ufeff").splitlines()
    head = next(i for i, row in enumerate(rows) if row.strip() and row.lstrip()[0] != "#")
    mark = next((each for each in ";\t" if each in rows[head]), ",")
    names = [word.strip().lower().strip('"') for word in rows[head].split(mark)]
    at = [names.index(name) for name in _COLUMNS]
    piece_at = names.index("piece") if "piece" in names else -1
    found: dict[tuple[str, str, int], list[tuple[float, ...]]] = {}
    first: dict[tuple[str, str, int], int] = {}
    part = 0
    for number, cells in enumerate(csv.reader(io.StringIO("\n".join(rows[head + 1 :])),
                                              delimiter=mark), start=head + 2):  # fmt: skip
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
        found.setdefault(key, []).append(tuple(_number(cells[i], where, mark) for i in at[1:]))
    return [
        RawPiece(key[0], np.array(points), f"row {first[key]} of {source}")
        for key, points in found.items()
    ]


def _number(cell: str, where: str, mark: str) -> float:
    text = cell.strip()
    try:
        value = float(text.replace(",", ".") if mark != "," else text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise BadInputError(f"{cell!r} is no number", where, "correct the cell")
    return value


def _parse_dxf(text: str, source: str) -> list[RawPiece]:
    """Read POLYLINE, LWPOLYLINE and LINE entities of an ASCII DXF."""
    rows = text.splitlines()
    codes, values = rows[0::2], rows[1::2]
    found: list[RawPiece] = []
    entity, layer, height = "", "", 0.0
    points: list[list[float]] = []
    begun = 1

    def close() -> None:
        if len(points) > 1:
            found.append(RawPiece(layer, np.array(points), f"line {begun} of {source}"))

    for i, (code, value) in enumerate(zip(codes, values, strict=False)):
        where = f"line {2 * i + 1} of {source}"
        if not code.strip().lstrip("-").isdigit():
            raise BadInputError(f"{code!r} is no group code", where, "save it as ASCII DXF")
        group, word = int(code), value.strip()
        if group == 0:
            if word == "VERTEX" and entity == "POLYLINE":
                points.append([0.0, 0.0, height])
                continue
            close()
            entity, points, height, begun = word, [], 0.0, 2 * i + 1
            if word == "LINE":
                points = [[0.0] * 3, [0.0] * 3]
        elif group == 8 and (entity != "POLYLINE" or not points):
            layer = word
        elif group == 38 and entity == "LWPOLYLINE":
            height = _number(word, where, ",")
        elif group in _AXES and entity == "LWPOLYLINE":
            if group == 10:
                points.append([0.0, 0.0, height])
            points[-1][_AXES[group]] = _number(word, where, ",")
        elif group in _AXES and points and entity in ("POLYLINE", "LINE"):
            points[-1 if entity == "POLYLINE" else 0][_AXES[group]] = _number(word, where, ",")
        elif group - 1 in _AXES and entity == "LINE":
            points[1][_AXES[group - 1]] = _number(word, where, ",")
    close()
    return found

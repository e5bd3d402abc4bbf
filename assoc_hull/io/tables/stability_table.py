"""Stability and cross curves as files: text, CSV, XLSX and JSON, with the head of each.

The table of a condition has a row per heel; that of cross curves a row per displacement, with
a column per heel. Names and units are those of the records.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator
from pathlib import Path

from assoc_hull.analysis.stability.cross_curves import CrossCurves
from assoc_hull.analysis.stability.result import Stability
from assoc_hull.errors import BadInputError
from assoc_hull.io.tables.column_table import Column, columns_csv, columns_xlsx
from assoc_hull.io.tables.stability_json import stability_document
from assoc_hull.io.write_file import write_whole

__all__ = ["ENDINGS", "csv_text", "stability_text", "write_stability", "xlsx_bytes"]

ENDINGS = (".txt", ".csv", ".xlsx", ".json")

Told = Stability | CrossCurves

_UNITS = {"heel_deg": ("deg", 2), "arm": ("m rad", 5)}
_TITLE = 20
_ACROSS = 12
"""Columns of figures side by side in text."""


def write_stability(found: Told, path: str | os.PathLike[str]) -> None:
    """Write stability or cross curves; the ending tells the form.

    Raises
    ------
    BadInputError
        Another ending, or a file that cannot be written.
    MissingExtraError
        A workbook was asked, and openpyxl is not installed.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from assoc_hull.analysis.stability.cross_curves import cross_curves
    >>> from assoc_hull.io.tables.stability_table import write_stability
    >>> from assoc_hull.sources import examples
    >>> found = cross_curves(examples.wigley(), draughts=[5.0, 6.0], heels=[10, 20])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_stability(found, Path(folder, "kn.csv"))
    ...     Path(folder, "kn.csv").read_text().splitlines()[-4].split(",")[3:]
    ['KN 10', 'KN 20']
    """
    ending = Path(path).suffix.lower()
    if ending == ".txt":
        write_whole(path, stability_text(found).encode())
    elif ending == ".csv":
        write_whole(path, csv_text(found).encode())
    elif ending == ".xlsx":
        write_whole(path, xlsx_bytes(found))
    elif ending == ".json":
        text = json.dumps(stability_document(found), indent=1, allow_nan=False)
        write_whole(path, f"{text}\n".encode())
    else:
        known = ", ".join(ENDINGS)
        raise BadInputError("the form is unknown", f"at {path}", f"end the name in one of {known}")


def csv_text(found: Told) -> str:
    """Lay out the table as comma-separated text; where she does not float it is blank."""
    return columns_csv(found.lines(), list(_columns(found)))


def xlsx_bytes(found: Told) -> bytes:
    """Lay out the table as a workbook.

    Raises
    ------
    MissingExtraError
        openpyxl is not installed.
    """
    first, title = (1, "stability") if isinstance(found, Stability) else (3, "cross curves")
    return columns_xlsx(title, found.lines(), list(_columns(found)), first)


def stability_text(found: Told) -> str:
    """Lay out head and table as text.

    Examples
    --------
    >>> from assoc_hull.analysis.stability.cross_curves import cross_curves
    >>> from assoc_hull.io.tables.stability_table import stability_text
    >>> from assoc_hull.sources import examples
    >>> found = cross_curves(examples.wigley(), draughts=[5.0, 6.25], heels=[10, 20])
    >>> print(stability_text(found).splitlines()[-1].split())
    ['2846.88', '2777.45', '6.2500', '0.9183', '1.8202']
    """
    lines = [f"{title:{_TITLE}} {' '.join(words.split())}" for title, words in found.lines()]
    return "\n".join([*lines, "", *_laid_out(list(_columns(found)))]) + "\n"


def _columns(found: Told) -> Iterator[Column]:
    if isinstance(found, Stability):
        for name, values in found.columns.items():
            unit, digits = _UNITS.get(name, ("m", 4))
            yield Column(name, unit, digits, values)
        return
    yield Column("displacement", "t", 2, found.displacement)
    yield Column("volume", "m3", 2, found.volume)
    yield Column("draught", "m", 4, found.draught)
    for heel, kn in zip(found.heel_deg.tolist(), found.kn.T, strict=True):
        yield Column(f"KN {heel:g}", "m", 4, kn)


def _laid_out(columns: list[Column]) -> Iterator[str]:
    """Lay out columns side by side, some at a time; what leads a row comes again."""
    lead = 3 if columns[0].name == "displacement" else 1
    step = _ACROSS - lead
    for first in range(lead, len(columns), step):
        part = [*columns[:lead], *columns[first : first + step]]
        cells = [
            [each.name, each.unit, *(_figure(value, each.digits) for value in each.values.tolist())]
            for each in part
        ]
        widths = [max(map(len, column)) for column in cells]
        if first > lead:
            yield ""
        for row in zip(*cells, strict=True):
            yield "  ".join(f"{cell:>{wide}}" for cell, wide in zip(row, widths, strict=True))


def _figure(value: float, digits: int) -> str:
    return "-" if math.isnan(value) else f"{round(value, digits) + 0.0:.{digits}f}"

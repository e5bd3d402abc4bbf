"""Cells of tables and values of documents about plates: what both kinds of plates share.

Examples
--------
>>> from types import SimpleNamespace
>>> from assoc_hull.io.tables.plate_cells import rows_csv
>>> columns = [SimpleNamespace(name="area", unit="m2"), SimpleNamespace(name="kind", unit="")]
>>> print(rows_csv(columns, [{"area": 2.5, "kind": None}]), end="")
area,kind
m2,
2.5,
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

__all__ = ["cell", "plain", "rows_csv"]


def rows_csv(columns: Sequence[Any], rows: Iterable[Mapping[str, object]]) -> str:
    """Lay out rows as comma-separated text: a row of names, a row of units, then each row.

    Numbers have all digits; what a row does not have is blank.

    Parameters
    ----------
    columns : sequence
        Columns, each with `name` and `unit`.
    rows : iterable of mapping
        Values in the order of the columns.
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([column.name for column in columns])
    writer.writerow([column.unit for column in columns])
    for row in rows:
        writer.writerow([cell(value) for value in row.values()])
    return out.getvalue()


def cell(value: object) -> str:
    """Give what stands in a cell."""
    found = plain(value)
    if found is None:
        return ""
    if isinstance(found, bool):
        return "true" if found else "false"
    return repr(found + 0.0) if isinstance(found, float) else str(found)


def plain(value: object) -> object:
    """Give a value as JSON says it: a number that is not finite becomes null."""
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value

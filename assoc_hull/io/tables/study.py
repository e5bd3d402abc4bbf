"""The table of a study as CSV, JSON, a structured array, a frame of pandas, and Parquet.

A CSV has a row of names, a row of units, and a row per variant; numbers have twelve digits, and
what a variant does not have is blank. The JSON has the same columns with all digits, where null
stands for a number that is not there.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import regular_file
from assoc_hull.errors import BadInputError, MissingExtraError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.write_file import write_whole
from assoc_hull.study.run import StudyRun

__all__ = [
    "FORMAT",
    "read_rows",
    "study_array",
    "study_csv",
    "study_document",
    "study_frame",
    "study_json",
    "write_parquet",
]

FORMAT, _VERSION = "assoc-hull study", 1
_UNITS = frozenset(("", "m", "deg"))
"""Of parameters, and of layers."""


Columns = Mapping[str, NDArray[Any]]
"""The table of a study, (n,) by name."""


def study_csv(run: StudyRun, columns: Columns) -> str:
    """Lay out a study as comma-separated text.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> found = ah.examples.wigley().study(set={"breadth": [10.5]}, outputs=["volume"])
    >>> for line in found.to_csv().splitlines():
    ...     print(",".join(line.split(",")[:3]))
    number,breadth,volume
    ,m,m3
    0,10.5,2916.3...
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    writer.writerow([run.units.get(name, "") for name in columns])
    for row in zip(*(column.tolist() for column in columns.values()), strict=True):
        writer.writerow([_cell(value) for value in row])
    return out.getvalue()


def study_json(run: StudyRun, columns: Columns) -> str:
    """Lay out a study as JSON.

    Examples
    --------
    >>> import json
    >>> import assoc_hull as ah
    >>> found = ah.examples.wigley().study(set={"breadth": [10.5]}, outputs=["volume"])
    >>> json.loads(found.to_json())["columns"]["breadth"]
    [10.5]
    """
    return json.dumps(study_document(run, columns), indent=1, allow_nan=False) + "\n"


def study_document(run: StudyRun, columns: Columns) -> Mapping[str, Any]:
    """Give a study as data."""
    design, units = run.design, run.units
    bounds = {
        name: [_plain(each) for each in ends]
        for name, ends in zip(design.free, design.bounds.tolist(), strict=True)
    }
    return {
        "format": FORMAT,
        "version": _VERSION,
        "variants": design.count,
        "drawn": design.drawn,
        "set": list(design.given),
        "free": list(design.free),
        "bounds": bounds,
        "reach": list(design.aims),
        "units": {name: units.get(name, "") for name in columns},
        "columns": {
            name: [_plain(value) for value in column.tolist()] for name, column in columns.items()
        },
    }


def study_array(columns: Columns) -> NDArray[np.void]:
    """Give a structured array, (n,), with a field for each column."""
    flat = {
        name: column.astype(str) if column.dtype == object else column
        for name, column in columns.items()
    }
    found = np.empty(len(flat["number"]), [(name, each.dtype) for name, each in flat.items()])
    for name, each in flat.items():
        found[name] = each
    return found


def study_frame(columns: Columns) -> Any:
    """Give a frame of pandas, whose index is the number of the variant.

    Raises
    ------
    MissingExtraError
        Pandas is not installed.
    """
    try:
        import pandas as pd
    except ImportError:
        raise MissingExtraError("pandas", "frame") from None
    return pd.DataFrame(dict(columns)).set_index("number")


def write_parquet(run: StudyRun, columns: Columns, path: str | PathLike[str]) -> None:
    """Write the table as a Parquet file, with units and the design as its metadata.

    Raises
    ------
    MissingExtraError
        PyArrow is not installed.
    BadInputError
        The file cannot be written.
    """
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        raise MissingExtraError("pyarrow", "frame") from None
    arrays = [pa.array(column, pa.string() if column.dtype == object else None)
              for column in columns.values()]  # fmt: skip
    units = json.dumps({name: unit for name, unit in run.units.items() if name in columns})
    about = {"format": FORMAT, "units": units, "drawn": run.design.drawn}
    table = pa.table(dict(zip(columns, arrays, strict=True))).replace_schema_metadata(about)
    out = io.BytesIO()
    parquet.write_table(table, out)
    write_whole(path, out.getvalue())


def read_rows(path: str | PathLike[str]) -> dict[str, FloatArray]:
    """Read a table of values: names in the first row, then a row of numbers for each variant.

    A row of units below the names, as `study_csv` writes it, is passed over.

    Raises
    ------
    BadInputError
        The file cannot be read, a name stands twice, a row has other cells, a cell is no number.
    """
    file = regular_file(Path(path))
    try:
        with file.open(encoding="utf-8-sig", newline="") as text:
            rows = [(number, row) for number, row in enumerate(csv.reader(text), 1) if any(row)]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        why = getattr(error, "strerror", None) or error
        raise BadInputError(f"it cannot be read ({why})", f"at {path}", "give a CSV") from error
    names = [name.strip() for name in rows[0][1]] if rows else []
    if not names or not all(names) or len(set(names)) < len(names):
        what = "its first row does not name each column once"
        raise BadInputError(what, f"in {path}", "give the names of parameters there")
    told = [(number, row) for number, row in rows[1:] if number > 2 or not _UNITS.issuperset(row)]
    found = np.empty((len(told), len(names)))
    for i, (number, row) in enumerate(told):
        if len(row) != len(names):
            what = f"row {number} has {len(row)} cells, and there are {len(names)} names"
            raise BadInputError(what, f"in {path}", "give a number below each name")
        for k, cell in enumerate(row):
            try:
                found[i, k] = float(cell)
            except ValueError:
                what = f"{cell!r} is no number"
                place = f"in {path}, row {number}, {names[k]}"
                raise BadInputError(what, place, "give one") from None
    return dict(zip(names, found.T, strict=True))


def _plain(value: object) -> object:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _cell(value: object) -> object:
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.12g}"
    return value

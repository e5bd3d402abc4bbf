"""The rows of a study as CSV and JSON.

A CSV has a row of names, a row of units, and a row per variant; numbers have twelve digits, and
what a variant does not have is blank. The JSON has the same columns with all digits, where null
stands for a number that is not there.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

from assoc_hull.study.run import StudyRow, StudyRun, study_columns

__all__ = ["FORMAT", "study_csv", "study_document", "study_json"]

FORMAT, _VERSION = "assoc-hull study", 1


def study_csv(run: StudyRun, rows: Sequence[StudyRow]) -> str:
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
    columns = study_columns(run.design, rows)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    writer.writerow([run.units.get(name, "") for name in columns])
    for row in zip(*(column.tolist() for column in columns.values()), strict=True):
        writer.writerow([_cell(value) for value in row])
    return out.getvalue()


def study_json(run: StudyRun, rows: Sequence[StudyRow]) -> str:
    """Lay out a study as JSON.

    Examples
    --------
    >>> import json
    >>> import assoc_hull as ah
    >>> found = ah.examples.wigley().study(set={"breadth": [10.5]}, outputs=["volume"])
    >>> json.loads(found.to_json())["columns"]["breadth"]
    [10.5]
    """
    return json.dumps(study_document(run, rows), indent=1, allow_nan=False) + "\n"


def study_document(run: StudyRun, rows: Sequence[StudyRow]) -> Mapping[str, Any]:
    """Give a study as data."""
    design, units, columns = run.design, run.units, study_columns(run.design, rows)
    bounds = {
        name: [_plain(each) for each in ends]
        for name, ends in zip(design.free, design.bounds.tolist(), strict=True)
    }
    return {
        "format": FORMAT,
        "version": _VERSION,
        "variants": design.count,
        "set": list(design.given),
        "free": list(design.free),
        "bounds": bounds,
        "reach": list(design.aims),
        "units": {name: units.get(name, "") for name in columns},
        "columns": {
            name: [_plain(value) for value in column.tolist()] for name, column in columns.items()
        },
    }


def _plain(value: object) -> object:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _cell(value: object) -> object:
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.12g}"
    return value

"""Stability and cross curves as text, CSV, XLSX and JSON, with the head of each.

The table of a condition has a row per heel, that of cross curves a row per displacement and a
column per heel. Names and units are those of the records; what is not there is blank, in JSON null.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import attrs

from assoc_hull.analysis.stability.criteria import Criterion
from assoc_hull.analysis.stability.cross_curves import CrossCurves
from assoc_hull.analysis.stability.equilibrium import Equilibrium
from assoc_hull.analysis.stability.stability_report import Stability
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.tables.spreadsheets import TableColumn, columns_csv, columns_xlsx
from assoc_hull.io.write_file import write_whole

__all__ = [
    "ENDINGS",
    "FORMAT",
    "SCHEMA",
    "equilibrium_document",
    "stability_csv",
    "stability_document",
    "stability_text",
    "stability_xlsx",
    "write_stability",
]

# --------------------------------------------------------------------------------------
# JSON.

FORMAT = {"stability": "assoc-hull stability", "cross curves": "assoc-hull cross curves",
          "equilibrium": "assoc-hull equilibrium"}  # fmt: skip
SCHEMA = 1
"""Version of the documents."""


def stability_document(found: Stability | CrossCurves) -> dict[str, Any]:
    """Give stability or cross curves as JSON says it; numbers that there are not are null.

    Examples
    --------
    >>> from assoc_hull.analysis.stability.stability_report import stability
    >>> from assoc_hull.io.tables.stability import stability_document
    >>> from assoc_hull.hull.sources import examples
    >>> found = stability_document(stability(examples.wigley(), kg=5.0, heels=[0, 20]))
    >>> [each["code"] for each in found["criteria"] if each["passed"] is False]
    ['2.2.1', '2.2.1']
    """
    if isinstance(found, CrossCurves):
        return {
            "format": FORMAT["cross curves"],
            "schema": SCHEMA,
            "header": attrs.asdict(found.header),
            "trim": found.trim,
            "conditions": [attrs.asdict(each) for each in found.conditions],
            "heel_deg": found.heel_deg.tolist(),
            "kn": [_numbers(row) for row in found.kn],
            "notes": list(found.notes),
        }
    return {
        "format": FORMAT["stability"],
        "schema": SCHEMA,
        "header": attrs.asdict(found.header),
        "condition": attrs.asdict(found.condition),
        "trim": found.trim,
        "side": found.side,
        "gm": found.gm,
        "gz_max": found.gz_max,
        "angles": {**attrs.asdict(found.angles), "range": found.angles.range},
        "columns": {name: _numbers(values) for name, values in found.columns.items()},
        "criteria": [_criterion(each) for each in found.criteria],
        "passed": found.passed,
        "not_evaluated": [f"{each.code} {each.name}" for each in found.not_evaluated],
        "floodings": [attrs.asdict(each) for each in found.floodings],
        "notes": list(found.notes),
    }


def equilibrium_document(found: Equilibrium) -> dict[str, Any]:
    """Give an equilibrium as JSON says it."""
    return {
        "format": FORMAT["equilibrium"],
        "schema": SCHEMA,
        "position": attrs.asdict(found.position),
        "kind": found.kind,
        "gm": found.gm,
        "gm_upright": found.gm_upright,
        "condition": attrs.asdict(found.condition),
        "notes": list(found.notes),
    }


def _criterion(criterion: Criterion) -> dict[str, Any]:
    return {**attrs.asdict(criterion), "margin": criterion.margin, "passed": criterion.passed}


def _numbers(values: FloatArray) -> list[float | None]:
    return [value if math.isfinite(value) else None for value in values.tolist()]


# --------------------------------------------------------------------------------------
# Text, CSV and XLSX.

ENDINGS = (".txt", ".csv", ".xlsx", ".json")

StabilityOrCrossCurves = Stability | CrossCurves

_UNITS = {"heel_deg": ("deg", 2), "arm": ("m rad", 5)}
_TITLE = 20
_ACROSS = 12
"""Columns of figures side by side in text."""


def write_stability(found: StabilityOrCrossCurves, path: str | os.PathLike[str]) -> None:
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
    >>> from assoc_hull.io.tables.stability import write_stability
    >>> from assoc_hull.hull.sources import examples
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
        write_whole(path, stability_csv(found).encode())
    elif ending == ".xlsx":
        write_whole(path, stability_xlsx(found))
    elif ending == ".json":
        text = json.dumps(stability_document(found), indent=1, allow_nan=False)
        write_whole(path, f"{text}\n".encode())
    else:
        known = ", ".join(ENDINGS)
        raise BadInputError("the form is unknown", f"at {path}", f"end the name in one of {known}")


def stability_csv(found: StabilityOrCrossCurves) -> str:
    """Lay out the table as comma-separated text; where she does not float it is blank."""
    return columns_csv(found.lines(), list(_columns(found)))


def stability_xlsx(found: StabilityOrCrossCurves) -> bytes:
    """Lay out the table as a workbook.

    Raises
    ------
    MissingExtraError
        openpyxl is not installed.
    """
    first, title = (1, "stability") if isinstance(found, Stability) else (3, "cross curves")
    return columns_xlsx(title, found.lines(), list(_columns(found)), first)


def stability_text(found: StabilityOrCrossCurves) -> str:
    """Lay out head and table as text.

    Examples
    --------
    >>> from assoc_hull.analysis.stability.cross_curves import cross_curves
    >>> from assoc_hull.io.tables.stability import stability_text
    >>> from assoc_hull.hull.sources import examples
    >>> found = cross_curves(examples.wigley(), draughts=[5.0, 6.25], heels=[10, 20])
    >>> print(stability_text(found).splitlines()[-1].split())
    ['2846.88', '2777.45', '6.2500', '0.9183', '1.8202']
    """
    lines = [f"{title:{_TITLE}} {' '.join(words.split())}" for title, words in found.lines()]
    return "\n".join([*lines, "", *_laid_out(list(_columns(found)))]) + "\n"


def _columns(found: StabilityOrCrossCurves) -> Iterator[TableColumn]:
    if isinstance(found, Stability):
        for name, values in found.columns.items():
            unit, digits = _UNITS.get(name, ("m", 4))
            yield TableColumn(name, unit, digits, values)
        return
    yield TableColumn("displacement", "t", 2, found.displacement)
    yield TableColumn("volume", "m3", 2, found.volume)
    yield TableColumn("draught", "m", 4, found.draught)
    for heel, kn in zip(found.heel_deg.tolist(), found.kn.T, strict=True):
        yield TableColumn(f"KN {heel:g}", "m", 4, kn)


def _laid_out(columns: list[TableColumn]) -> Iterator[str]:
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

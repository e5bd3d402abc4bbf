"""Form parameters as JSON: the catalogue, and the values of a hull.

Names and units are those of the Python objects. Both documents have a JSON Schema, which ships
with the package; see `assoc_hull.io.tables.form_schema`.

Examples
--------
>>> import json
>>> from assoc_hull.io.tables.form_json import catalogue_json
>>> json.loads(catalogue_json())["entries"][0]["symbol"]
'Lpp'
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

import attrs

from assoc_hull.analysis.form.catalogue import CATALOGUE
from assoc_hull.analysis.form.parameter import Parameter
from assoc_hull.analysis.form.report import FormReport
from assoc_hull.arguments import all_of

__all__ = [
    "CATALOGUE_FORMAT",
    "ENTRY_FIELDS",
    "HEADER_FIELDS",
    "SCHEMA",
    "VALUES_FORMAT",
    "catalogue_document",
    "catalogue_json",
    "form_document",
    "form_json",
]

CATALOGUE_FORMAT, VALUES_FORMAT = "assoc-hull form catalogue", "assoc-hull form parameters"
SCHEMA = 1
"""Version of both forms."""

ENTRY_FIELDS = (
    "symbol", "ittc", "name", "unit", "table", "definition", "datum", "source", "needs", "digits",
)  # fmt: skip
"""What is told of an entry: the attributes of `Parameter` but for its function."""

HEADER_FIELDS = (
    "ship", "length", "breadth", "draught", "rho", "shell_factor", "transom", "deck",
    "fingerprint", "date",
)  # fmt: skip
"""What is told of a header: what form parameters depend on."""


def catalogue_document(entries: Iterable[Parameter] | None = None) -> dict[str, Any]:
    """Give entries as JSON says it.

    Parameters
    ----------
    entries : iterable of Parameter
        The whole catalogue if not given.
    """
    chosen = CATALOGUE.values() if entries is None else all_of(entries, Parameter, "entries")
    return {
        "format": CATALOGUE_FORMAT,
        "schema": SCHEMA,
        "entries": [_entry(each) for each in chosen],
    }


def _entry(entry: Parameter) -> dict[str, Any]:
    told = {name: getattr(entry, name) for name in ENTRY_FIELDS}
    return {**told, "needs": list(entry.needs)}


def form_document(report: FormReport) -> dict[str, Any]:
    """Give the form parameters of a hull as JSON says it."""
    return {
        "format": VALUES_FORMAT,
        "schema": SCHEMA,
        "header": {name: getattr(report.header, name) for name in HEADER_FIELDS},
        "position": attrs.asdict(report.position),
        "even_keel": report.position.trim_by_stern == 0.0,
        "screw": None if report.screw is None else attrs.asdict(report.screw),
        "doubts": list(report.doubts),
        "values": {symbol: attrs.asdict(value) for symbol, value in report.values.items()},
    }


def catalogue_json(entries: Iterable[Parameter] | None = None) -> str:
    """Give the catalogue, or entries of one's own, as JSON text; it ends with a newline.

    Parameters
    ----------
    entries : iterable of Parameter
        The whole catalogue if not given.
    """
    return _dumps(catalogue_document(entries))


def form_json(report: FormReport) -> str:
    """Give the form parameters of a hull as JSON text; it ends with a newline.

    Examples
    --------
    >>> import json
    >>> from assoc_hull.analysis.form.report import form_report
    >>> from assoc_hull.io.tables.form_json import form_json
    >>> from assoc_hull.sources import examples
    >>> found = json.loads(form_json(form_report(examples.wigley(), draught=6.25)))
    >>> round(found["values"]["V"]["number"], 2)
    2777.45
    """
    return _dumps(form_document(report))


def _dumps(document: dict[str, Any]) -> str:
    return json.dumps(document, indent=1, allow_nan=False) + "\n"

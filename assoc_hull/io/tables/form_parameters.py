"""Form parameters of a hull, and their catalogue, as JSON, CSV, XLSX and text.

Names and units are those of the Python objects. The JSON documents have schemas, which ship as
``form_catalogue.schema.json`` and ``form_parameters.schema.json``. In tables a value that a hull
does not have is blank, and its reason stands beside it.
"""

from __future__ import annotations

import csv
import io
import json
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from typing import Any

import attrs

from assoc_hull.analysis.form.form_parameters import (
    CATALOGUE,
    TABLES,
    TITLES,
    FormReport,
    ReportPart,
    ReportRow,
    by_table,
    number_text,
)
from assoc_hull.analysis.form.parameter import FormParameter
from assoc_hull.arguments import all_of
from assoc_hull.io.tables.json_schema import (
    FINGERPRINT,
    NULL,
    NUMBER,
    Schema,
    closed_object,
    document_schema,
    with_description,
)
from assoc_hull.io.tables.spreadsheets import head_on, openpyxl_module, workbook_bytes
from assoc_hull.model.value_schema import (
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    TEXT,
    TRUTH,
    list_of,
    one_of,
    or_none,
)

__all__ = [
    "CATALOGUE_FORMAT",
    "COLUMNS",
    "ENTRY_FIELDS",
    "HEADER_FIELDS",
    "SCHEMA",
    "VALUES_FORMAT",
    "catalogue_document",
    "catalogue_json",
    "catalogue_schema",
    "catalogue_text",
    "form_csv",
    "form_document",
    "form_json",
    "form_schema",
    "form_text",
    "form_xlsx",
    "split_in_two",
]

# --------------------------------------------------------------------------------------
# JSON.

CATALOGUE_FORMAT, VALUES_FORMAT = "assoc-hull form catalogue", "assoc-hull form parameters"
SCHEMA = 1
"""Version of both documents."""

ENTRY_FIELDS = (
    "symbol", "ittc", "name", "unit", "table", "definition", "datum", "source", "needs", "digits",
)  # fmt: skip
"""What is written of an entry: the attributes of `FormParameter` but for its function."""

HEADER_FIELDS = (
    "ship", "length", "breadth", "draught", "rho", "shell_factor", "transom", "deck",
    "fingerprint", "date",
)  # fmt: skip
"""What is written of a header: what form parameters depend on."""


def catalogue_document(entries: Iterable[FormParameter] | None = None) -> dict[str, Any]:
    """Give entries, the whole catalogue if None, as JSON says it."""
    chosen = CATALOGUE.values() if entries is None else all_of(entries, FormParameter, "entries")
    return {
        "format": CATALOGUE_FORMAT,
        "schema": SCHEMA,
        "entries": [_entry(each) for each in chosen],
    }


def _entry(entry: FormParameter) -> dict[str, Any]:
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


def catalogue_json(entries: Iterable[FormParameter] | None = None) -> str:
    """Give entries, the whole catalogue if None, as JSON text; it ends with a newline."""
    return _dumps(catalogue_document(entries))


def form_json(report: FormReport) -> str:
    """Give the form parameters of a hull as JSON text; it ends with a newline.

    Examples
    --------
    >>> import json
    >>> from assoc_hull.analysis.form.form_parameters import form_report
    >>> from assoc_hull.io.tables.form_parameters import form_json
    >>> from assoc_hull.hull.sources import examples
    >>> found = json.loads(form_json(form_report(examples.wigley(), draught=6.25)))
    >>> round(found["values"]["V"]["number"], 2)
    2777.45
    """
    return _dumps(form_document(report))


def _dumps(document: dict[str, Any]) -> str:
    return json.dumps(document, indent=1, allow_nan=False) + "\n"


# --------------------------------------------------------------------------------------
# CSV and XLSX: the head, a line each, behind ``#`` in a CSV; a row of names; a row per entry.

COLUMNS = (
    "symbol", "number", "unit", "name", "table", "reason", "warning", "definition", "datum",
    "ittc", "source",
)  # fmt: skip
"""What stands in a row."""

_NUMBER = COLUMNS.index("number")


def form_csv(report: FormReport) -> str:
    """Lay out form parameters as comma-separated text; numbers have twelve digits.

    Examples
    --------
    >>> from assoc_hull.analysis.form.form_parameters import form_report
    >>> from assoc_hull.io.tables.form_parameters import form_csv
    >>> from assoc_hull.hull.sources import examples
    >>> text = form_csv(form_report(examples.wigley(), draught=6.25, only=["B'"]))
    >>> text.splitlines()[-1].split(",")[:4]
    ["B'", '8.00390529679', 'm', 'reduced breadth']
    """
    out = io.StringIO()
    out.writelines(f"# {title}: {' '.join(words.split())}\n" for title, words in report.lines())
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for row in _table_rows(report):
        number = row.value.number
        cells = _table_cells(row)
        cells[_NUMBER] = "" if number is None else f"{number:.12g}"
        writer.writerow(["" if cell is None else cell for cell in cells])
    return out.getvalue()


def form_xlsx(report: FormReport) -> bytes:
    """Lay out form parameters as a workbook; numbers are whole, shown with their digits.

    Raises
    ------
    MissingExtraError
        openpyxl is not installed.
    """
    book = openpyxl_module().Workbook()
    sheet = book.active
    sheet.title = "form parameters"
    head_on(sheet, report.lines())
    sheet.append(COLUMNS)
    top = sheet.max_row + 1
    for row in _table_rows(report):
        sheet.append(_table_cells(row))
        for cell in sheet[sheet.max_row]:
            if isinstance(cell.value, str):
                cell.data_type = "s"  # words that begin with = are no formula
        shown = sheet.cell(sheet.max_row, _NUMBER + 1)
        shown.number_format = "0." + "0" * row.entry.digits if row.entry.digits else "0"
    sheet.freeze_panes = sheet.cell(top, _NUMBER + 1)
    return workbook_bytes(book)


def _table_rows(report: FormReport) -> Iterator[ReportRow]:
    for part in report.parts:
        yield from part.rows


def _table_cells(row: ReportRow) -> list[Any]:
    """Give the cells of a row; None: blank."""
    entry, value = row.entry, row.value
    return [
        entry.symbol, value.number, value.unit, entry.name, entry.table, value.reason,
        value.warning, entry.definition, entry.datum, entry.ittc, entry.source,
    ]  # fmt: skip


# --------------------------------------------------------------------------------------
# Text: the sheet of a hull in two columns, and the catalogue as a list.

_WIDTH = 100
_COLUMN, _BETWEEN = 48, 4
_TITLE = 15


def form_text(report: FormReport) -> str:
    """Lay out the form parameters of a hull in two columns: symbol, value, unit, notes.

    Lines have at most 100 letters, unless a symbol or unit is longer than its column.

    Examples
    --------
    >>> from assoc_hull.analysis.form.form_parameters import form_report
    >>> from assoc_hull.io.tables.form_parameters import form_text
    >>> from assoc_hull.hull.sources import examples
    >>> report = form_report(examples.wigley(), draught=6.25, only=["Cb", "V"])
    >>> print(form_text(report).splitlines()[-1].split())
    ['V', '2777.45', 'm3', 'Cb', '0.4444', '-']
    """
    given, *parts = report.parts
    lines = ["FORM PARAMETERS", "=" * _WIDTH, *_head(report), "", *_named(given)]
    for part in parts:
        lines += ["", part.title.upper(), "-" * _WIDTH, *_columns(part.rows)]
    if report.notes:
        lines += ["", "NOTES", "-" * _WIDTH, *_notes(report.notes)]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def split_in_two(rows: Sequence[ReportRow]) -> tuple[Sequence[ReportRow], Sequence[ReportRow]]:
    """Split rows into a left and a right column; the left one is the longer."""
    middle = (len(rows) + 1) // 2
    return rows[:middle], rows[middle:]


def _head(report: FormReport) -> Iterator[str]:
    for title, words in report.lines():
        yield from _hung(title, " ".join(words.split()), _TITLE)


def _named(part: ReportPart) -> Iterator[str]:
    """Give lines with the names in words."""
    for row in part.rows:
        name = f"{row.entry.name[:1].upper()}{row.entry.name[1:]}"
        yield f"{name:40} {row.entry.symbol:6} {_amount(row)}"


def _columns(rows: Sequence[ReportRow]) -> Iterator[str]:
    left, right = split_in_two(rows)
    for one, other in zip_longest(left, right):
        second = "" if other is None else _cell(other)
        yield f"{_cell(one):{_COLUMN}}{' ' * _BETWEEN}{second}"


def _cell(row: ReportRow) -> str:
    return f"{row.entry.symbol:14} {_amount(row)}"


def _amount(row: ReportRow) -> str:
    unit = "" if row.value.number is None else row.value.unit
    return f"{number_text(row):>17}  {unit:8} {row.mark}"


def _notes(notes: Sequence[str]) -> Iterator[str]:
    for k, words in enumerate(notes, 1):
        yield from _hung(f"{k})", words, 4)


def _hung(title: str, words: str, room: int) -> list[str]:
    """Wrap words beside a title."""
    return textwrap.wrap(words, _WIDTH, initial_indent=f"{title:{room}} ",
                         subsequent_indent=" " * (room + 1))  # fmt: skip


def catalogue_text(entries: Iterable[FormParameter]) -> str:
    """Lay out entries of the catalogue: symbols, unit, name, and how each is found.

    Examples
    --------
    >>> from assoc_hull.analysis.form.form_parameters import CATALOGUE
    >>> from assoc_hull.io.tables.form_parameters import catalogue_text
    >>> print(catalogue_text([CATALOGUE["Cb"]]))
    HYDROSTATIC VALUES
    Cb (C_B), -: block coefficient
        V / (Lpp B T)
    <BLANKLINE>
    """
    lines: list[str] = []
    for table, some in by_table(entries).items():
        lines += [*([""] if lines else []), TITLES.get(table, table).upper()]
        for each in some:
            lines += _catalogue_entry(each)
    return "\n".join(lines) + "\n"


def _catalogue_entry(entry: FormParameter) -> Iterator[str]:
    ittc = f" ({entry.ittc})" if entry.ittc not in (None, entry.symbol) else ""
    yield f"{entry.symbol}{ittc}, {entry.unit}: {entry.name}"
    datum = "" if entry.datum == "-" else f"; {entry.datum}"
    yield from _hung("   ", entry.definition + datum, 3)


# --------------------------------------------------------------------------------------
# Schemas, which ship beside this module; ``assoc-hull schema --of form-catalogue`` prints one. What
# a schema cannot say holds good besides: a symbol stands once, and what an entry needs is there.

_MAYBE = or_none(NAME).schema

_ENTRY = closed_object(
    {
        "symbol": with_description("under which the catalogue holds it", NAME.schema),
        "ittc": with_description("symbol in the ITTC's list, where it has one", _MAYBE),
        "name": with_description("in words", NAME.schema),
        "unit": with_description("a dash where there is none", NAME.schema),
        "table": with_description("part of the catalogue", one_of(TABLES).schema),
        "definition": with_description("how it is measured or computed", NAME.schema),
        "datum": with_description(
            "from where it counts, which way is plus; a dash: none", NAME.schema
        ),
        "source": with_description("paper, book or standard", NAME.schema),
        "needs": with_description(
            "symbols; shape: it is measured on the hull", list_of(NAME).schema
        ),
        "digits": with_description(
            "after the point", {"type": "integer", "minimum": 0, "maximum": 12}
        ),
    }
)

_HEADER = closed_object(
    {
        "ship": with_description("name", TEXT.schema),
        "length": with_description("between perpendiculars, m", POSITIVE.schema),
        "breadth": with_description("moulded, m", POSITIVE.schema),
        "draught": with_description("moulded, of the design, m", POSITIVE.schema),
        "rho": with_description("density of the water, t/m3", POSITIVE.schema),
        "shell_factor": with_description(
            "displacement over that of the moulded volume", POSITIVE.schema
        ),
        "transom": with_description("an immersed transom counts as wetted surface", TRUTH.schema),
        "deck": one_of(("open", "closed")).schema,
        "fingerprint": FINGERPRINT,
        "date": with_description("as the caller gave it", _MAYBE),
    }
)

_POSITION = closed_object(
    {
        "draught_aft": with_description("T_A, moulded, m", REAL.schema),
        "draught_fore": with_description("T_F, moulded, m", REAL.schema),
        "heel_deg": with_description("of an upright ship", {"const": 0}),
    }
)

_SCREW = closed_object(
    {
        "height": with_description("of the shaft above the base line, m", REAL.schema),
        "diameter": with_description("m", POSITIVE.schema),
        "x": with_description("plane of the screw, from AP, + forward, m", or_none(REAL).schema),
        "spacing": with_description("between two shafts, m; 0: one screw", NOT_NEGATIVE.schema),
        "boss_diameter": with_description("m", or_none(POSITIVE).schema),
        "boss_x": with_description(
            "aft face of the boss, from AP, + forward, m", or_none(REAL).schema
        ),
    }
)


def _value(number: Schema, reason: Schema) -> Schema:
    return closed_object(
        {
            "number": with_description("in the unit", number),
            "unit": with_description("a dash where there is none", NAME.schema),
            "definition": with_description("symbol of the entry of the catalogue", NAME.schema),
            "reason": with_description("why there is no number", reason),
            "warning": with_description("what to mind about the number", _MAYBE),
        }
    )


_VALUE: Schema = {"anyOf": [_value(NUMBER, NULL), _value(NULL, NAME.schema)]}
"""A value has a number, or a reason why there is none."""


def catalogue_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of the catalogue.

    Examples
    --------
    >>> from assoc_hull.io.tables.form_parameters import catalogue_schema
    >>> catalogue_schema()["required"]
    ['format', 'schema', 'entries']
    """
    entries = {"type": "array", "minItems": 1, "items": _ENTRY}
    about = "Definitions of form parameters of ship hulls"
    return document_schema(CATALOGUE_FORMAT, SCHEMA, about, {"entries": entries})


def form_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of the form parameters of a hull.

    Examples
    --------
    >>> from assoc_hull.io.tables.form_parameters import form_schema
    >>> form_schema()["required"]
    ['format', 'schema', 'header', 'position', 'even_keel', 'screw', 'doubts', 'values']
    """
    parts = {
        "header": _HEADER,
        "position": _POSITION,
        "even_keel": with_description(
            "T_A and T_F are equal; if not, T is their mean", TRUTH.schema
        ),
        "screw": with_description("null: not given", {"anyOf": [NULL, _SCREW]}),
        "doubts": with_description("what makes the integrals doubtful", list_of(NAME).schema),
        "values": with_description("by symbol", {"type": "object", "additionalProperties": _VALUE}),
    }
    return document_schema(VALUES_FORMAT, SCHEMA, "Form parameters of a ship hull", parts)

"""The report of form parameters as text, CSV and XLSX: all that it holds stands there."""

from __future__ import annotations

import csv
import io
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.form_parameters import (
    CATALOGUE,
    FormReport,
    ReportRow,
    form_report,
    number_text,
)
from assoc_hull.io.tables.form_parameters import (
    COLUMNS,
    catalogue_text,
    form_csv,
    form_text,
    form_xlsx,
)
from tests.form_entries import bare, doubted, passed_on


@pytest.fixture(scope="module")
def report() -> FormReport:
    """All entries, and some of one's own."""
    hull = ah.examples.wigley()
    own = (bare, doubted, passed_on)
    return form_report(hull, draughts=(6.0, 5.0), date="2026-01-31", further=own)


def rows_of(report: FormReport) -> list[ReportRow]:
    """All lines of a report."""
    return [row for part in report.parts for row in part.rows]


def cells_of(line: str) -> list[list[str]]:
    """Both columns of a line of the text."""
    return [each for each in (line[:52].split(), line[52:].split()) if each]


def test_the_text_has_every_value_once(report: FormReport) -> None:
    """In two columns, with unit and mark; particulars in the head, by name."""
    text = form_text(report)
    head, *parts = text.split("\n" + "-" * 100 + "\n")
    body = "\n".join(parts[:-1])
    found = [cell for line in body.splitlines() for cell in cells_of(line)]
    for row in rows_of(report)[len(report.parts[0].rows) :]:
        unit = [] if row.value.number is None else row.value.unit.split()
        mark = [row.mark] if row.mark else []
        assert found.count([*row.entry.symbol.split(), number_text(row), *unit, *mark]) == 1
    for row in report.parts[0].rows:
        assert f"{row.entry.symbol:6} {number_text(row):>17}  {row.value.unit}" in head
    assert "Length between perpendiculars" in head
    assert "2026-01-31" in head
    assert report.header.fingerprint in head


def test_the_text_is_narrow_and_lists_the_notes(report: FormReport) -> None:
    """No line is longer than 100 letters or ends in blanks; a heading stands over each part."""
    lines = form_text(report).splitlines()
    assert max(map(len, lines)) <= 100
    assert [line for line in lines if line != line.rstrip()] == []
    below = " ".join(" ".join(lines[lines.index("NOTES") :]).split())
    for k, words in enumerate(report.notes, 1):
        assert f"{k}) {words}" in below
    assert [part.title.upper() for part in report.parts[1:]] == [
        line for line in lines if line in {part.title.upper() for part in report.parts}
    ]


def check(names: Any, rows: list[list[Any]], report: FormReport, accuracy: float) -> None:
    """Compare what was read with the report."""
    assert tuple(names) == COLUMNS
    for cells, row in zip(rows, rows_of(report), strict=True):
        found = {name: cell or None for name, cell in zip(COLUMNS, cells, strict=True)}
        assert (found["symbol"], found["name"]) == (row.entry.symbol, row.entry.name)
        assert (found["unit"], found["reason"]) == (row.value.unit, row.value.reason)
        assert (found["warning"], found["definition"]) == (row.value.warning, row.entry.definition)
        number = cells[COLUMNS.index("number")]
        if row.value.number is None:
            assert number in (None, "")
        else:
            assert float(number) == pytest.approx(row.value.number, rel=accuracy, abs=0.0)


def test_a_csv_reads_back(report: FormReport) -> None:
    """To twelve digits; the head stands above."""
    text = form_csv(report)
    above = [line for line in text.splitlines() if line.startswith("# ")]
    names, *rows = csv.reader(io.StringIO("\n".join(text.splitlines()[len(above) :])))
    check(names, rows, report, 1e-11)
    assert "# ship: Wigley" in above
    assert "# screw: not given" in above
    assert f"# fingerprint: {report.header.fingerprint}" in above


def test_a_workbook_reads_back(report: FormReport) -> None:
    """Words are words, also those that begin like a formula; the same bytes each time."""
    openpyxl = pytest.importorskip("openpyxl")
    data = form_xlsx(report)
    assert data == form_xlsx(report)
    sheet = openpyxl.load_workbook(io.BytesIO(data)).active
    cells = [list(row) for row in sheet.iter_rows(max_col=len(COLUMNS), values_only=True)]
    top = next(k for k, row in enumerate(cells) if not str(row[0]).startswith("#"))
    check(cells[top], cells[top + 1 :], report, 1e-14)
    kinds = {cell.data_type for row in sheet.iter_rows() for cell in row}
    assert kinds == {"s", "n"}  # and no "f"


def test_the_catalogue_is_told_in_words() -> None:
    """Every entry by symbol, unit and name, its definition below."""
    lines = catalogue_text(CATALOGUE.values()).splitlines()
    for each in CATALOGUE.values():
        head = [line for line in lines if line.endswith(f", {each.unit}: {each.name}")]
        assert [line for line in head if line.startswith(each.symbol)]
    assert max(map(len, lines)) <= 100

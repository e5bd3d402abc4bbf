"""Form parameters in words: the sheet of a hull in two columns, and the catalogue as a list."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest

from assoc_hull.analysis.form.parameter import Parameter
from assoc_hull.analysis.form.report import FormReport, Part, Row, number_text
from assoc_hull.analysis.form.tables import TITLES, by_table

__all__ = ["catalogue_text", "form_text", "halves"]

_WIDTH = 100
_COLUMN, _BETWEEN = 48, 4
_TITLE = 15


def form_text(report: FormReport) -> str:
    """Lay out the form parameters of a hull in two columns: symbol, value, unit, notes.

    Lines have at most 100 letters, unless a symbol or unit is longer than its column.

    Examples
    --------
    >>> from assoc_hull.analysis.form.report import form_report
    >>> from assoc_hull.io.tables.form_text import form_text
    >>> from assoc_hull.sources import examples
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


def halves(rows: Sequence[Row]) -> tuple[Sequence[Row], Sequence[Row]]:
    """Part lines into a left and a right column; the left one is the longer."""
    middle = (len(rows) + 1) // 2
    return rows[:middle], rows[middle:]


def _head(report: FormReport) -> Iterator[str]:
    for title, words in report.lines():
        yield from _hung(title, " ".join(words.split()), _TITLE)


def _named(part: Part) -> Iterator[str]:
    """Give lines with the names in words."""
    for row in part.rows:
        name = f"{row.entry.name[:1].upper()}{row.entry.name[1:]}"
        yield f"{name:40} {row.entry.symbol:6} {_amount(row)}"


def _columns(rows: Sequence[Row]) -> Iterator[str]:
    left, right = halves(rows)
    for one, other in zip_longest(left, right):
        second = "" if other is None else _cell(other)
        yield f"{_cell(one):{_COLUMN}}{' ' * _BETWEEN}{second}"


def _cell(row: Row) -> str:
    return f"{row.entry.symbol:14} {_amount(row)}"


def _amount(row: Row) -> str:
    unit = "" if row.value.number is None else row.value.unit
    return f"{number_text(row):>17}  {unit:8} {row.mark}"


def _notes(notes: Sequence[str]) -> Iterator[str]:
    for k, words in enumerate(notes, 1):
        yield from _hung(f"{k})", words, 4)


def _hung(title: str, words: str, room: int) -> list[str]:
    """Wrap words beside a title."""
    return textwrap.wrap(words, _WIDTH, initial_indent=f"{title:{room}} ",
                         subsequent_indent=" " * (room + 1))  # fmt: skip


def catalogue_text(entries: Iterable[Parameter]) -> str:
    """Lay out entries of the catalogue: symbols, unit, name, and how each is found.

    Examples
    --------
    >>> from assoc_hull.analysis.form.catalogue import CATALOGUE
    >>> from assoc_hull.io.tables.form_text import catalogue_text
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
            lines += _told(each)
    return "\n".join(lines) + "\n"


def _told(entry: Parameter) -> Iterator[str]:
    ittc = f" ({entry.ittc})" if entry.ittc not in (None, entry.symbol) else ""
    yield f"{entry.symbol}{ittc}, {entry.unit}: {entry.name}"
    datum = "" if entry.datum == "-" else f"; {entry.datum}"
    yield from _hung("   ", entry.definition + datum, 3)

"""The form parameters of a hull as a PDF of upright A4 pages, and as a file of any form.

The pages stand as yards hand them on: conditions first, then parameters by group in two columns.
`write_form_report` writes text, PDF, CSV, workbook or JSON by the ending of the name.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType

import attrs

from assoc_hull.analysis.form.form_parameters import FormReport, ReportRow, number_text
from assoc_hull.arguments import file_path, instance
from assoc_hull.errors import BadInputError
from assoc_hull.io.tables.form_parameters import form_csv, form_json, form_text, form_xlsx
from assoc_hull.io.write_file import write_whole
from assoc_hull.plot.sheet.labels import wrap_words
from assoc_hull.plot.sheet.report_pages import (
    COLUMN,
    GREY,
    LEFT,
    RIGHT,
    PageFlow,
    page_foot,
    page_head,
)
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, pdf_of, require_matplotlib

__all__ = [
    "ENDINGS",
    "form_pdf",
    "form_sheets",
    "write_form_report",
]

# --------------------------------------------------------------------------------------
# The form parameters of a hull as a PDF: upright A4 pages, as yards hand them on.

_LINE, _PAD = 2.7, 1.5  # height of a line of a cell, and what is free above and below, mm
_NAME, _NUMBER, _MARK = 19.0, COLUMN - 16.0, COLUMN  # places in a cell, mm
_SMALL = 0.88
_DATED = ("ship", "date", "fingerprint", "datum")  # told elsewhere than among the conditions
_UNITS: Mapping[str, str] = MappingProxyType(
    {"m2": "m²", "m3": "m³", "m4": "m⁴", "deg": "°", "-": "–"}
)
_TITLE = "Form parameters"


def form_pdf(report: FormReport) -> bytes:
    """Give the form parameters of a hull as a PDF; the same bytes each time.

    Raises
    ------
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> from assoc_hull.analysis.form.form_parameters import form_report
    >>> from assoc_hull.plot.diagrams.form_report import form_pdf
    >>> from assoc_hull.hull.sources import examples
    >>> form_pdf(form_report(examples.wigley(), draught=6.25, only=["Cb"]))[:5]
    b'%PDF-'
    """
    return pdf_of(form_sheets(report), f"Form parameters of {report.header.ship}")


def form_sheets(report: FormReport) -> list[Sheet]:
    """Give the form parameters of a hull as pages; arguments and errors as for `form_pdf`."""
    require_matplotlib()
    flow = PageFlow(lambda sheet, first: _begin(report, sheet, first))
    flow.turn()
    sheet = flow.sheet
    given, *parts = report.parts
    flow.part(given.title, [_Entry.of(sheet, row) for row in given.rows])
    conditions = [_Words.of(sheet, title, words) for title, words in _conditions(report)]
    flow.part("What the numbers hold good for", conditions, ruled=False)
    for part in parts:
        flow.part(part.title, [_Entry.of(sheet, row) for row in part.rows])
    notes = [_Words.of(sheet, f"{k})", words) for k, words in enumerate(report.notes, 1)]
    flow.part("Notes", notes, ruled=False)
    for k, page in enumerate(flow.pages, 1):
        _end(report, page, f"{k} / {len(flow.pages)}")
    return flow.pages


def _conditions(report: FormReport) -> Iterator[tuple[str, str]]:
    yield from ((title, words) for title, words in report.lines() if title not in _DATED)


@attrs.frozen
class _Entry:
    """A line of the report: symbol, name, number, unit, notes."""

    row: ReportRow
    names: tuple[str, ...]

    @classmethod
    def of(cls, sheet: Sheet, row: ReportRow) -> _Entry:
        """Part the name into lines."""
        number = sheet.width(number_text(row))
        room = _NUMBER - _NAME - number - 2.0
        symbol = sheet.width(row.entry.symbol, bold=True)
        name = row.entry.placed_name
        return cls(row, tuple(wrap_words(sheet, name, room - max(symbol - 17.0, 0.0), _SMALL)))

    @property
    def tall(self) -> float:
        return _PAD + _LINE * len(self.names)

    def draw(self, sheet: Sheet, x: float, top: float) -> None:
        entry, value = self.row.entry, self.row.value
        y = top - 0.5 * _PAD - 0.78 * _LINE
        sheet.text((x + 1.0, y), entry.symbol, across="left", up="baseline", bold=True,
                   name=f"label/symbol/{entry.symbol}")  # fmt: skip
        for k, words in enumerate(self.names):
            sheet.text((x + _NAME, y - k * _LINE), words, size=_SMALL, across="left",
                       up="baseline", colour=GREY, name=f"label/name/{entry.symbol}")  # fmt: skip
        sheet.text((x + _NUMBER, y), number_text(self.row).replace("-", "−"), across="right",
                   up="baseline", name=f"label/number/{entry.symbol}")  # fmt: skip
        if value.number is not None:
            sheet.text((x + _NUMBER + 1.2, y), _UNITS.get(value.unit, value.unit), across="left",
                       size=_SMALL, up="baseline", name=f"label/unit/{entry.symbol}")  # fmt: skip
        if self.row.mark:
            sheet.text((x + _MARK, y), self.row.mark, size=0.8, across="right", up="baseline",
                       colour=GREY, name=f"label/mark/{entry.symbol}")  # fmt: skip


@attrs.frozen
class _Words:
    """A title and words beside it."""

    title: str
    words: tuple[str, ...]
    indent: float

    @classmethod
    def of(cls, sheet: Sheet, title: str, words: str) -> _Words:
        """Part the words into lines."""
        indent = 6.0 if title[:1].isdigit() else _NAME + 3.0
        return cls(title, tuple(wrap_words(sheet, words, COLUMN - indent - 1.0, _SMALL)), indent)

    @property
    def tall(self) -> float:
        return 0.6 * _PAD + _LINE * len(self.words)

    def draw(self, sheet: Sheet, x: float, top: float) -> None:
        y = top - 0.3 * _PAD - 0.78 * _LINE
        sheet.text((x + 1.0, y), self.title, size=_SMALL, across="left", up="baseline",
                   name=f"label/title/{self.title}")  # fmt: skip
        for k, words in enumerate(self.words):
            sheet.text((x + self.indent, y - k * _LINE), words, size=_SMALL, across="left",
                       up="baseline", name=f"label/words/{self.title}")  # fmt: skip


def _begin(report: FormReport, sheet: Sheet, first: bool) -> float:
    """Draw what stands at the top of a page."""
    y = page_head(sheet, report.header.ship, _TITLE, first=first)
    if first:
        y -= 4.2
        sheet.text((LEFT, y), _floating(report), across="left", up="baseline", name="label/place")
        date = report.header.date or ""
        sheet.text((RIGHT, y), date, across="right", up="baseline", name="label/date")
    return y - 4.0


def _floating(report: FormReport) -> str:
    """Tell where the ship floats."""
    place = report.position
    if place.trim_by_stern == 0.0:
        return f"At even keel, moulded draught {place.draught_mean:.3f} m"
    return (
        f"Moulded draughts {place.draught_aft:.3f} m at AP, {place.draught_fore:.3f} m at FP: "
        f"trim {place.trim_by_stern:+.3f} m by the stern"
    )


def _end(report: FormReport, sheet: Sheet, number: str) -> None:
    """Draw what stands at the foot of a page."""
    words = wrap_words(sheet, report.header.datum, RIGHT - LEFT - 12.0, 0.72)
    page_foot(sheet, [*words, f"hull {report.header.fingerprint}"], number)


# --------------------------------------------------------------------------------------
# Writing the form parameters of a hull to a file, in the form that its name ends in.

_FORMS: Mapping[str, Callable[[FormReport], bytes]] = MappingProxyType(
    {
        ".txt": lambda report: form_text(report).encode(),
        ".pdf": form_pdf,
        ".csv": lambda report: form_csv(report).encode(),
        ".xlsx": form_xlsx,
        ".json": lambda report: form_json(report).encode(),
    }
)

ENDINGS = tuple(_FORMS)
"""How a name may end."""


def write_form_report(report: FormReport, path: Path_) -> None:
    """Write the form parameters of a hull.

    Parameters
    ----------
    report : FormReport
        Of the hull.
    path : path
        The ending tells the form: ``.txt`` and ``.pdf`` for people, ``.csv``, ``.xlsx`` and
        ``.json`` for programs.

    Raises
    ------
    BadInputError
        Another ending, or a file that cannot be written.
    MissingExtraError
        A PDF was asked and matplotlib is not installed, or a workbook and openpyxl is not.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from assoc_hull.analysis.form.form_parameters import form_report
    >>> from assoc_hull.plot.diagrams.form_report import write_form_report
    >>> from assoc_hull.hull.sources import examples
    >>> report = form_report(examples.wigley(), draught=6.25, only=["Cb"])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_form_report(report, Path(folder) / "wigley.txt")
    ...     (Path(folder) / "wigley.txt").read_text("utf-8")[:15]
    'FORM PARAMETERS'
    """
    instance(report, FormReport, "the report")
    name = file_path(path)
    form = _FORMS.get(Path(name).suffix.lower())
    if form is None:
        known = ", ".join(ENDINGS)
        raise BadInputError("the form is unknown", f"at {path}", f"end the name in one of {known}")
    write_whole(name, form(report))

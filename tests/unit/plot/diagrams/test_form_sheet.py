"""The PDF of form parameters: every value once, words apart and within the page."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import attrs
import numpy as np
import pytest

from assoc_hull.analysis.form.form_parameters import FormReport, form_report, number_text
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.plot.diagrams.form_report import ENDINGS, form_pdf, form_sheets, write_form_report
from assoc_hull.plot.sheet.report_pages import LEFT, PAGE, RIGHT
from assoc_hull.plot.sheet.sheet_figure import Sheet, pdf_of
from tests.form_entries import bare, doubted, many, passed_on

_OVERLAP = 0.35  # mm: boxes of words hold room above and below the letters


@pytest.fixture(scope="module")
def report(wigley: Hull) -> FormReport:
    """More entries than one page holds, with every kind of value."""
    own = (bare, doubted, passed_on, *many(90))
    return form_report(wigley, draughts=(6.0, 5.0), date="2026-01-31", further=own)


@pytest.fixture(scope="module")
def sheets(report: FormReport) -> list[Sheet]:
    """Its pages."""
    return form_sheets(report)


def words(sheets: list[Sheet], begin: str) -> dict[str, list[str]]:
    """Words on all pages whose ids begin like this, by the rest of the id."""
    found: dict[str, list[str]] = {}
    for sheet in sheets:
        for text in sheet.axes.texts:
            if str(text.get_gid()).startswith(begin):
                found.setdefault(str(text.get_gid())[len(begin) :], []).append(text.get_text())
    return found


def test_every_value_stands_there_once(report: FormReport, sheets: list[Sheet]) -> None:
    """With its symbol, name, number, unit and the marks of its notes."""
    numbers, names = words(sheets, "label/number/"), words(sheets, "label/name/")
    marks, units = words(sheets, "label/mark/"), words(sheets, "label/unit/")
    rows = [row for part in report.parts for row in part.rows]
    assert sorted(numbers) == sorted(row.entry.symbol for row in rows)
    for row in rows:
        symbol = row.entry.symbol
        assert numbers[symbol] == [number_text(row).replace("-", "−")]
        assert " ".join(names[symbol]) == row.entry.placed_name
        assert marks.get(symbol, []) == ([row.mark] if row.mark else [])
        assert (symbol in units) == (row.value.number is not None)


def test_notes_and_head_stand_there(report: FormReport, sheets: list[Sheet]) -> None:
    """Every reason and warning by its number; the ship, the fingerprint and the page on each."""
    told = words(sheets, "label/words/")
    for k, note in enumerate(report.notes, 1):
        assert " ".join(told[f"{k})"]) == note
    assert words(sheets, "label/ship")[""] == ["Wigley"] * len(sheets)
    assert words(sheets, "label/page")[""] == [
        f"{k} / {len(sheets)}" for k in range(1, len(sheets) + 1)
    ]
    foot = words(sheets, "label/foot")[""]
    assert foot.count(f"hull {report.header.fingerprint}") == len(sheets)
    assert words(sheets, "label/date")[""] == ["2026-01-31"]
    assert "trim +1.000 m by the stern" in words(sheets, "label/place")[""][0]


def test_a_part_goes_on_upon_the_next_page(sheets: list[Sheet]) -> None:
    """Below a heading that says so."""
    assert len(sheets) >= 2
    headings = words(sheets, "label/heading")[""]
    assert "Hull form" in headings
    assert "Hull form (continued)" in headings
    assert "Notes" in headings
    assert headings[-1].startswith("Notes")


def test_words_lie_apart_and_within_the_page(sheets: list[Sheet]) -> None:
    """No two on a page cover each other, and none leaves the space between the margins."""
    for sheet in sheets:
        boxes = {
            f"{text.get_gid()} {k}": sheet.box(text) for k, text in enumerate(sheet.axes.texts)
        }
        places = np.array(list(boxes.values()))
        assert places[:, 0].min() >= LEFT - _OVERLAP
        assert places[:, 2].max() <= RIGHT + _OVERLAP
        assert places[:, 1].min() >= 5.0
        assert places[:, 3].max() <= PAGE.height - 5.0
        covered = [
            (one, other)
            for (one, a), (other, b) in combinations(boxes.items(), 2)
            if min(a[2], b[2]) - max(a[0], b[0]) > _OVERLAP
            and min(a[3], b[3]) - max(a[1], b[1]) > 2 * _OVERLAP
        ]
        assert covered == []


def test_a_name_that_is_too_long_is_written_smaller(wigley: Hull) -> None:
    """That of the ship keeps clear of the title."""
    report = form_report(wigley, only=["Cb"])
    (sheet,) = form_sheets(report)
    (usual,) = [text for text in sheet.axes.texts if text.get_gid() == "label/ship"]
    long = attrs.evolve(report, header=attrs.evolve(report.header, ship="A long name " * 9))
    (sheet,) = form_sheets(long)
    ship, title = (
        next(text for text in sheet.axes.texts if text.get_gid() == f"label/{name}")
        for name in ("ship", "form")
    )
    assert sheet.box(ship)[2] < sheet.box(title)[0]
    assert float(ship.get_fontsize()) < float(usual.get_fontsize())


def test_a_pdf_has_the_pages_and_the_same_bytes_each_time(wigley: Hull) -> None:
    """It bears no date but the one that is asked."""
    report = form_report(wigley, only=["Cb", "V"])
    data = form_pdf(report)
    assert data == form_pdf(report)
    assert b"/Count 1 " in data
    assert b"/Count 2 " in pdf_of([Sheet("A4"), Sheet("A4")], "two")
    assert b"CreationDate" not in data


def test_a_file_is_told_by_its_ending(wigley: Hull, tmp_path: Path) -> None:
    """Each form is written; another is refused, and so is what is no report."""
    report = form_report(wigley, only=["Cb"])
    for ending in (".txt", ".csv", ".json", ".PDF"):
        write_form_report(report, tmp_path / f"form{ending}")
    assert len(list(tmp_path.iterdir())) == 4
    with pytest.raises(BadInputError, match=ENDINGS[0]):
        write_form_report(report, tmp_path / "form.doc")
    with pytest.raises(BadInputError, match="FormReport"):
        write_form_report({}, tmp_path / "form.txt")  # type: ignore[arg-type]

"""The report of form parameters: parts, notes, what it says of the hull, what it refuses."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.form_parameters import (
    CATALOGUE,
    TABLES,
    TITLES,
    FormReport,
    by_table,
    form_report,
    number_text,
)
from assoc_hull.analysis.form.parameter import FormParameter
from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.errors import BadInputError, UnknownNameError
from tests.form_entries import bare, doubted, passed_on


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A hull that no test edits."""
    return ah.examples.wigley()


def report_of(hull: ah.Hull, only: Iterable[str] | None, *further: FormParameter) -> FormReport:
    """Report with entries of one's own."""
    return form_report(hull, draught=6.25, only=only, further=further)


def test_every_entry_stands_in_one_part(hull: ah.Hull) -> None:
    """Particulars first, then the other parts in their order, each entry once, by its table."""
    report = form_report(hull, draught=6.25)
    found = [row.entry.symbol for part in report.parts for row in part.rows]
    assert sorted(found) == sorted(CATALOGUE)
    tables = [part.table for part in report.parts]
    assert tables == [table for table in TABLES if table in tables]
    assert [part.title for part in report.parts] == [TITLES[table] for table in tables]
    for part in report.parts:
        assert {row.entry.table for row in part.rows} == {part.table}
        assert [row.entry for row in part.rows] == by_table(CATALOGUE.values())[part.table]


def test_the_particulars_stand_there_whatever_is_wanted(hull: ah.Hull) -> None:
    """A sheet that does not say its dimensions and draughts says nothing."""
    report = report_of(hull, ["Cb"])
    assert [part.title for part in report.parts] == ["Principal particulars", "Hydrostatic values"]
    given = {row.entry.symbol: row.value.number for row in report.parts[0].rows}
    assert (given["Lpp"], given["B"], given["T_A"], given["T_F"]) == (100.0, 10.0, 6.25, 6.25)
    assert list(report.values) == ["Cb"]
    assert len(report_of(hull, ["Lpp"]).parts) == 1


def test_values_are_those_of_the_mapping(hull: ah.Hull) -> None:
    """The report computes nothing of its own."""
    report = form_report(hull, draughts=(6.0, 5.5))
    assert dict(report.values) == dict(hull.form_parameters(draughts=(6.0, 5.5)))


def test_a_reason_is_a_note_to_which_the_line_refers(hull: ah.Hull) -> None:
    """The same reason is one note; a warning is one too; what has neither has no mark."""
    report = report_of(hull, ["Cb", "bare", "passed on", "doubted"], bare, passed_on, doubted)
    rows = {row.entry.symbol: row for part in report.parts for row in part.rows}
    assert (rows["Cb"].notes, rows["Cb"].mark) == ((), "")
    for symbol, words in (("bare", "no such thing"), ("doubted", "to be read with care")):
        (number,) = rows[symbol].notes
        assert report.notes[number - 1] == words
        assert rows[symbol].mark == f"{number})"
    assert report.notes[rows["passed on"].notes[0] - 1] == "bare: no such thing"
    assert len(set(report.notes)) == len(report.notes)


def test_numbers_have_the_digits_of_their_entry(hull: ah.Hull) -> None:
    """A number that is nil but for rounding has no sign; what is not there is a dash."""
    report = report_of(hull, ["LCB", "bare", "doubted"], bare, doubted)
    text = {row.entry.symbol: number_text(row) for part in report.parts[1:] for row in part.rows}
    assert text == {"LCB": "0.0000", "bare": "-", "doubted": "2.50"}


def test_a_part_of_the_catalogue_may_be_wanted(hull: ah.Hull) -> None:
    """By its name, or several; one alone needs no list, as with entries."""
    report = form_report(hull, tables=["measures", "hydrostatic"])
    assert {CATALOGUE[symbol].table for symbol in report.values} == {"measures", "hydrostatic"}
    one = form_report(hull, tables="measures", further=bare)  # type: ignore[arg-type]
    assert {CATALOGUE[symbol].table for symbol in one.values} == {"measures"}


def test_the_head_says_what_the_numbers_hold_good_for(hull: ah.Hull) -> None:
    """Ship, datum, water, screw, fingerprint, and the date if there is one."""
    screw = ah.form.Screw(height=2.0, diameter=3.0, x=2.5, spacing=4.0, boss_diameter=0.6)
    report = form_report(hull, only=["Cb"], screw=screw, date="2026-01-31", rho=1.0)
    head = dict(report.lines())
    assert head["ship"] == "Wigley"
    assert head["water"] == "fresh water, 1 t/m3"
    assert head["date"] == "2026-01-31"
    assert head["fingerprint"] == hull.fingerprint
    assert head["screw"] == (
        "diameter 3 m, shaft 2 m above the base line, x 2.5 m, two, 4 m apart, boss 0.6 m"
    )
    without = dict(form_report(hull, only=["Cb"]).lines())
    assert without["screw"] == "not given"
    assert "date" not in without


def test_what_makes_the_integrals_doubtful_is_told(
    hull: ah.Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A sound hull has no doubts; those of another stand in the head."""
    assert form_report(hull, only=["Cb"]).doubts == ()
    monkeypatch.setattr(Flotation, "doubts", lambda *_: ["ST 7 is open"])
    report = form_report(hull, only=["Cb"])
    assert report.doubts == ("ST 7 is open",)
    assert dict(report.lines())["doubt"] == "ST 7 is open"


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"only": ["Cb"], "tables": ["measures"]}, "both given"),
        ({"tables": ["bulb"]}, "'bulb'"),
        ({"date": ""}, "date"),
        ({"date": "1\n2"}, "date"),
        ({"draught": 5.0, "draughts": (5.0, 5.0)}, "both given"),
        ({"further": [3]}, "further"),
    ],
)
def test_what_cannot_be_is_refused(hull: ah.Hull, given: dict[str, Any], words: str) -> None:
    """It is said which argument, and what to do."""
    with pytest.raises(BadInputError, match=words):
        form_report(hull, **given)


def test_a_symbol_that_is_none_is_refused(hull: ah.Hull) -> None:
    """With those that are near."""
    with pytest.raises(UnknownNameError, match="Cb"):
        form_report(hull, only=["Cbb"])

"""What a person meets in the first hour: printed tables, units, errors, names, typed edits."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.cli.problems import UsageError
from assoc_hull.cli.typed_edits import typed_edit
from assoc_hull.errors import BadInputError, UnknownNameError


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """Give a small ship."""
    return ah.examples.wigley()


@pytest.fixture(scope="module")
def series60() -> ah.Hull:
    """Give a ship whose lines reach below the design draught."""
    return ah.examples.series60()


@pytest.fixture
def ship(hull: ah.Hull, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Give its file, in the folder where commands run."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "ship.hull.json"
    hull.save(path)
    return path


def test_a_table_of_hydrostatics_prints_as_a_table_that_fits_a_screen(hull: ah.Hull) -> None:
    """Names, units and a row for each draught; a notebook gets the same as a table."""
    table = hull.hydrostatic_table([3.0, 4.0, 5.0])
    names, units, *rows = str(table).splitlines()
    assert names.split()[:3] == ["T_A", "T_F", "∇"]
    assert units.split()[:3] == ["m", "m", "m3"]
    assert [row.split()[0] for row in rows[:3]] == ["3.000", "4.000", "5.000"]
    assert max(map(len, str(table).splitlines())) <= 110
    assert table._repr_html_().count("<tr>") == 4


def test_coefficients_above_one_are_explained(series60: ah.Hull) -> None:
    """At trim the largest section may exceed its box; at even keel nothing is said."""
    hull = series60
    trimmed = hull.hydrostatics(draughts=(9.0, 0.3), estimate=False)
    assert trimmed.cx > 1.0
    assert any("C_X" in note and "trim or heel" in note for note in trimmed.notes)
    assert hull.hydrostatics(draught=4.0, estimate=False).notes == ()


def test_a_draught_of_a_centimetre_does_not_ask_to_mend_a_sound_hull(series60: ah.Hull) -> None:
    """The message names the position as the cause, and what to do."""
    ship = series60
    with pytest.raises(BadInputError, match="take a larger draught") as told:
        ship.hydrostatics(draught=0.01)
    assert "mend the hull" not in str(told.value)


@pytest.mark.parametrize(
    "ask",
    [
        lambda hull: hull.fair(noise=20),
        lambda hull: hull.vary(set={"breadth": 10.2}, fair=20),
        lambda hull: hull.doctor(noise=20),
        lambda hull: hull.fair_window(at="WL 2.5 x ST 7", radius=(20.0, 5.0)).to(noise=20),
    ],
    ids=["fair", "vary", "doctor", "fair_window"],
)
def test_a_noise_in_millimetres_is_refused_with_the_unit(
    hull: ah.Hull, ask: Callable[[ah.Hull], object]
) -> None:
    """20 is 20 m: the message says so, and how 20 mm are written."""
    before = hull.fingerprint
    with pytest.raises(BadInputError, match=r"20 m, more than a thousandth.*give 0.02 for 20 mm"):
        ask(hull)
    assert hull.fingerprint == before


def test_names_are_found_as_people_write_them(hull: ah.Hull) -> None:
    """Case, spaces, comma, a missing nought, zeros at the end; the nearest names where none is."""
    for name in ("wl 2.50", "WL 2,5", " wl2.5 "):
        assert hull[name].name == "WL 2.5"
    assert str(hull["wl 2.50 X st 7"]) == str(hull["WL 2.5 x ST 7"])
    with pytest.raises(UnknownNameError, match=r"nearest names are 'WL 2\.5'"):
        hull["WL 2.55"]


def test_reprs_fit_a_line_and_hold_no_keys() -> None:
    """Of points, names that there are none of, and what an edit did."""
    hull = ah.examples.wigley()
    with hull.edit("out") as edit:
        edit.pull("WL 2.5 x ST 7", 0.01)
    assert repr(hull.points) == f"<{len(hull.points)} points by address>"
    assert repr(hull.labels) == "<no checkpoint or branch>"
    assert "..." not in repr(hull.groups) or len(hull.groups) > 4
    (report,) = hull.history
    assert repr(report) == f"<EditReport {report}>"
    assert ":" not in str(report).partition(":")[2]


def test_ipython_is_shown_the_callers_line_and_ours_in_one(hull: ah.Hull) -> None:
    """Our frames are folded."""
    with pytest.raises(UnknownNameError) as told:
        hull["WL 2.55"]
    *lines, last = told.value._render_traceback_()
    assert last == f"UnknownNameError: {told.value}"
    assert len(lines) == 1
    assert 'hull["WL 2.55"]' in lines[0]


def test_options_of_a_typed_edit_stand_anywhere(
    ship: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before, between and behind the values."""
    words = ["WL 2.5 x ST 7", "10mm"]
    told = []
    for typed in (
        ["--dry-run", "pull", *words],
        ["pull", words[0], "--dry-run", words[1]],
        ["pull", *words, "--dry-run"],
    ):
        assert main(["edit", str(ship), *typed]) == 0
        told.append(capsys.readouterr().out)
    assert told[0] == told[1] == told[2]
    assert "nothing written" in told[0]
    given = ["edit", str(ship), "pull", "--name", "out", *words, "--dry-run"]
    assert main(given) == 0
    assert capsys.readouterr().out.startswith("out\n")


def test_pairs_of_a_lead_can_be_typed() -> None:
    """A point, the word to, and where it is to come; several with semicolons."""
    typed = typed_edit("lead", ["ST 7", "WL 2.5 x ST 7 to 35,3,2.5; 35,1,1"])
    assert typed["points"] == [["WL 2.5 x ST 7", [35.0, 3.0, 2.5]], [35.0, 1.0, 1.0]]
    with pytest.raises(UsageError):
        typed_edit("lead", [])


def test_a_file_called_like_an_edit_does_not_hide_what_is_typed(
    ship: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With values it is the edit."""
    Path("pull").write_text("[]", "utf-8")
    assert main(["edit", str(ship), "pull", "WL 2.5 x ST 7", "10mm", "--dry-run"]) == 0
    assert "would change" in capsys.readouterr().out

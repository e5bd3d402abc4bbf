"""The command `stability`: what it asks, prints, writes and refuses."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path

import pytest

import assoc_hull.plot.diagrams.hydrostatics  # noqa: F401  what it imports must not be a double
from assoc_hull.analysis.hydrostatics import flotation
from assoc_hull.cli import main
from tests.floating_bodies import StripBody, box_body
from tests.unit.cli.conftest import Json

HEELS = ["--heels", "0:40:10"]


def double(monkeypatch: pytest.MonkeyPatch, body: StripBody) -> None:
    """Measure another body instead of the hull."""
    monkeypatch.setattr(flotation, "flotation", lambda state: body)


@pytest.fixture(autouse=True)
def closed_form(monkeypatch: pytest.MonkeyPatch) -> None:
    """Measure the box of 100 x 20 x 12 m instead, whose numbers are known."""
    double(monkeypatch, box_body())


def test_a_condition_is_told_with_the_names_of_the_record(hull: Path, facts: Json) -> None:
    """Columns, criteria with margins, angles, and whether the deck is open."""
    found = facts("stability", hull, "--draught", 6, "--kg", 5, *HEELS)
    assert found["columns"]["heel_deg"] == [0.0, 10.0, 20.0, 30.0, 40.0]
    assert found["columns"]["kn"][2] == pytest.approx(3.0520303646, abs=1e-10)
    assert found["condition"]["weight"] == pytest.approx(12300.0)
    assert found["gm"] == pytest.approx(3.0 + 400.0 / 72.0 - 5.0)
    assert [each["code"] for each in found["criteria"]][-1] == "2.3"
    assert found["criteria"][5]["margin"] == pytest.approx(found["gm"] - 0.15)
    assert found["criteria"][6]["passed"] is None
    assert (found["passed"], found["header"]["deck"], found["side"]) == (
        True,
        "closed",
        "starboard",
    )
    assert found["angles"]["deck_edge"] == pytest.approx(math.degrees(math.atan(0.6)))
    assert found["angles"]["vanishing"] is None or found["angles"]["range"] is not None
    assert found["header"]["date"]


def test_words_name_what_fails_and_by_how_much(
    hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """KG 8.5 m of the box: GM is 0.0944 m short; the exit code is 0, for that is the answer."""
    assert main(["stability", str(hull), "--draught", "6", "--kg", "8.5", *HEELS]) == 0
    text = capsys.readouterr().out
    assert "2.2.4 initial metacentric height (-0.0944)" in text
    assert "deck                 closed" in text
    assert "phi_f not given, 40 used" in text
    assert "2.3 severe wind and rolling: not evaluated" in text
    assert text.splitlines()[-1].split()[0] == "40.00"


def test_an_open_deck_says_where_levers_stop(
    hull: Path, monkeypatch: pytest.MonkeyPatch, facts: Json
) -> None:
    """And what is not evaluated therefore; heels beyond are null."""
    double(monkeypatch, box_body(closed=False))
    found = facts("stability", hull, "--draught", 8, "--kg", 5, *HEELS)
    assert found["header"]["deck"] == "open"
    assert found["columns"]["gz"][3:] == [None, None]
    assert found["passed"] is None
    assert "edge of the open deck" in found["criteria"][0]["note"]


def test_openings_are_judged(hull: Path, facts: Json) -> None:
    """Both are listed; the first that goes under counts."""
    found = facts("stability", hull, "--draught", 6, "--kg", 5, *HEELS,
                  "--flooding", "hatch, 50, 8, 10", "--flooding", "vent,50,8,11")  # fmt: skip
    assert [each["point"]["name"] for each in found["floodings"]] == ["hatch", "vent"]
    assert found["angles"]["flooding"] == pytest.approx(math.degrees(math.atan(0.5)))


def test_cross_curves_are_told_and_written(hull: Path, facts: Json, tmp_path: Path) -> None:
    """A row per draught, as in the file."""
    out = tmp_path / "kn.csv"
    found = facts("stability", hull, "--cross", "5:7:1", "--heels", "10:20:10", "-o", out)
    assert found["saved"] == [str(out)]
    assert found["kn"][1][1] == pytest.approx(3.0520303646, abs=1e-10)
    rows = [line for line in out.read_text("utf-8").splitlines() if not line.startswith("#")]
    names, units, *numbers = csv.reader(rows)
    assert names == ["displacement", "volume", "draught", "KN 10", "KN 20"]
    assert units == ["t", "m3", "m", "m", "m"]
    assert float(numbers[1][4]) == pytest.approx(found["kn"][1][1], rel=1e-11)


def test_rest_is_told(hull: Path, facts: Json, capsys: pytest.CaptureFixture[str]) -> None:
    """Kind, draughts, heel, GM; in words too."""
    call = ["--rest", "--weight", "12300", "--lcg", "50", "--tcg", "-0.1", "--kg", "5"]
    found = facts("stability", hull, *call)
    assert found["kind"] == "list"
    assert 0.0 < found["position"]["heel_deg"] < 3.0
    assert main(["stability", str(hull), *call]) == 0
    assert "rests    list" in capsys.readouterr().out


@pytest.mark.parametrize("ending", [".txt", ".csv", ".xlsx", ".json"])
def test_a_condition_is_written(hull: Path, facts: Json, tmp_path: Path, ending: str) -> None:
    """In every form; the JSON file is the document that is printed."""
    if ending == ".xlsx":
        pytest.importorskip("openpyxl")
    out = tmp_path / f"gz{ending}"
    found = facts("stability", hull, "--draught", 6, "--kg", 5, *HEELS, "-o", out)
    assert out.stat().st_size > 500
    if ending == ".json":
        assert json.loads(out.read_text("utf-8")) | {"saved": [str(out)]} == found


def test_a_picture_is_drawn(hull: Path, facts: Json, tmp_path: Path) -> None:
    """Of either kind."""
    pytest.importorskip("matplotlib")
    one, other = tmp_path / "gz.svg", tmp_path / "kn.svg"
    facts("stability", hull, "--draught", 6, "--kg", 5, *HEELS, "--plot", one)
    facts("stability", hull, "--cross", "5:7:1", "--heels", "10:20:10", "--plot", other)
    assert b"curve/gz" in one.read_bytes()
    assert b"curve/20" in other.read_bytes()


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ([], "--kg is not given"),
        (["--kg", "nan"], "kg"),
        (["--kg", "5", "--draught", "99"], "above the deck"),
        (["--kg", "5", "--weight", "1e7"], "more than the hull carries"),
        (["--kg", "5", "--lcg", "50"], "lcg is given without a weight"),
        (["--kg", "5", "--heels", "0:95:5"], "turns the ship over"),
        (["--kg", "5", "--heels", "0:90:1e-9"], "heels"),
        (["--kg", "5", "--heels", "ten"], "FROM:TO:STEP"),
        (["--kg", "5", "--flooding", "vent,1,2"], "NAME,X,Y,Z"),
        (["--cross", "5:7:1", "--weight", "100"], "--weight is given with --cross"),
        (["--cross", "5:7:1", "--flooding", "vent,1,2,3"], "--flooding is given with --cross"),
        (["--rest", "--kg", "5", "--weight", "100"], "--weight and --lcg"),
        (["--rest", "--kg", "5", "--weight", "9", "--lcg", "5", "-o", "a.csv"], "--out is given"),
        (["--kg", "5", "-o", "gz.doc"], "gz.doc"),
        (["--kg", "5", "--plot", "gz.doc"], "gz.doc"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(
    hull: Path, given: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2, and a line that says what is wrong."""
    assert main(["stability", str(hull), *given]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert words in error


def test_a_rule_of_trim_has_no_meaning_at_rest(
    hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """She rests at the trim of equilibrium; what would be ignored is refused."""
    call = ["stability", str(hull), "--rest", "--weight", "2000", "--lcg", "50", "--kg", "4"]
    assert main([*call, "--trim", "fixed"]) == 2
    assert "--trim is given with --rest" in capsys.readouterr().err

"""The command `hydrostatics`: what it asks, prints, writes and refuses."""

import csv
import math
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics import flotation
from assoc_hull.analysis.hydrostatics.record import FIELDS
from assoc_hull.cli import main
from tests.floating_bodies import Box
from tests.unit.cli.conftest import Json


@pytest.fixture(autouse=True)
def closed_form(monkeypatch: pytest.MonkeyPatch) -> None:
    """Measure a box of the hull's length and breadth instead, whose numbers are known."""
    body = Box(breadth=10.0, depth=8.0, off=1e-6)
    monkeypatch.setattr(flotation, "flotation", lambda state: body)


def test_one_position_is_told_with_the_names_of_the_record(hull: Path, facts: Json) -> None:
    """The design draught if none is given; head, freeboard and deck edge besides."""
    found = facts("hydrostatics", hull, "--kg", 3)
    (row,) = found["rows"]
    assert list(row) == [*FIELDS, "error", "notes"]
    assert row["volume"] == pytest.approx(6250.0, rel=1e-12)
    assert row["gmt"] == pytest.approx(row["kmt"] - 3.0)
    assert found["header"]["rho"] == 1.025
    assert found["header"]["ship"] == "Wigley"
    assert found["header"]["date"]
    assert found["freeboards"][0]["least"] == pytest.approx(1.75)
    assert found["deck_edge_angle"] == pytest.approx(math.degrees(math.atan(0.35)))
    assert found["positions"] == [{"draught_aft": 6.25, "draught_fore": 6.25, "heel_deg": 0.0}]


def test_a_table_has_both_ends_and_every_trim(hull: Path, facts: Json) -> None:
    """FROM:TO:STEP; the shape tells how to read the rows."""
    found = facts("hydrostatics", hull, "--table", "1:6:0.5", "--trims", -1, 0.5)
    assert found["shape"] == [11, 2]
    assert [row["draught_mean"] for row in found["rows"]] == [
        pytest.approx(1 + 0.5 * (k // 2)) for k in range(22)
    ]
    assert found["rows"][-1]["trim_by_stern"] == pytest.approx(0.5)


def test_a_weight_finds_its_draught(hull: Path, facts: Json) -> None:
    """In fresh water L B T tons float at T; trimmed, if their centre is elsewhere."""
    found = facts("hydrostatics", hull, "--weight", 6250, "--water", "fresh")
    assert found["rows"][0]["draught_mean"] == pytest.approx(6.25, rel=1e-12)
    found = facts("hydrostatics", hull, "--weight", 5000, "--rho", 1, "--lcg", 49, "--kg", 2.5)
    assert found["rows"][0]["displacement"] == pytest.approx(5000, rel=1e-12)
    assert found["rows"][0]["trim_by_stern"] == pytest.approx(0.6, rel=1e-3)


def test_a_ship_that_floats_only_heeled_has_numbers_without_an_angle(
    hull: Path, facts: Json
) -> None:
    """The draught of the centre line lies below the keel: upright she would not float there."""
    found = facts("hydrostatics", hull, "--draught", -1, "--heel", 40)
    assert found["rows"][0]["draught_mean"] == -1.0
    assert found["deck_edge_angle"] is None


def test_draughts_to_the_underside_of_keel(hull: Path, facts: Json) -> None:
    """Are longer than the moulded ones by the keel's thickness."""
    found = facts("hydrostatics", hull, "--draught", 5.02, "--keel-thickness", 0.02,
                  "--draught-to", "keel")  # fmt: skip
    assert found["rows"][0]["draught_mean"] == pytest.approx(5.0)


def test_an_appendage_is_listed_apart(
    hull: Path, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """With its share, in the document and in words."""
    given = "rudder, 27.5, 2.5, 0, 3, 40"
    found = facts("hydrostatics", hull, "--appendage", given)
    assert found["shares"][0]["volume"] == [27.5]
    assert found["header"]["appendages"][0]["centroid"] == [2.5, 0.0, 3.0]
    assert main(["hydrostatics", str(hull), "--appendage", given]) == 0
    assert "rudder: adds 27.5 m3, 0.4381 % of the volume" in capsys.readouterr().out


def test_words_name_value_unit_and_meaning(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of one position, every value of the record; of a table, a column per position."""
    assert main(["hydrostatics", str(hull)]) == 0
    text = capsys.readouterr().out
    rows = [line.split() for line in text.splitlines() if line]
    named = {row[0]: row for row in rows if row[0] in FIELDS}
    assert list(named) == list(FIELDS)
    assert named["volume"][1:3] == ["6250.00", "m3"]
    assert named["gmt"][1] == "-"
    assert "salt water, 1.025 t/m3" in text
    assert main(["hydrostatics", str(hull), "--table", "1:6:0.5"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert sum(line.startswith("volume ") for line in lines) == 2
    assert max(map(len, lines)) <= 160


def test_doubts_are_told_where_they_are_to_be_reported(
    hull: Path, facts: Json, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In words and in the document, which has them of the table and of each record."""
    body = Box(breadth=10.0, depth=8.0, trouble=("ST 7 is open",))
    monkeypatch.setattr(flotation, "flotation", lambda state: body)
    found = facts("hydrostatics", hull, "--on-error", "report")
    assert found["notes"] == found["rows"][0]["notes"] == ["ST 7 is open"]
    assert main(["hydrostatics", str(hull), "--on-error", "report"]) == 0
    assert "note: ST 7 is open" in capsys.readouterr().out


def test_a_table_is_written(hull: Path, facts: Json, tmp_path: Path) -> None:
    """As CSV; the document names the file."""
    out = tmp_path / "table.csv"
    found = facts("hydrostatics", hull, "--table", "2:6:1", "-o", out)
    assert found["saved"] == [str(out)]
    rows = [line for line in out.read_text("utf-8").splitlines() if not line.startswith("#")]
    names, units, *numbers = csv.reader(rows)
    assert units[names.index("i_l")] == "m4"
    assert [float(row[names.index("volume")]) for row in numbers] == pytest.approx(
        [row["volume"] for row in found["rows"]], rel=1e-11
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--draught", "9"], ["draught of 9 m", "from 0 to 8 m"]),
        (["--draught", "-1"], ["draught of -1 m", "below the keel", "from 0 to 8 m"]),
        (["--draught", "nan"], ["draught of nan m", "from 0 to 8 m"]),
        (["--heel", "95"], ["heel of 95 deg"]),
        (["--table", "4:2:1"], ["does not rise"]),
        (["--table", "4:8"], ["FROM:TO:STEP"]),
        (["--table", "0.1:6:1e-9"], ["draughts", "a step of"]),
        (["--table", "2:6:1", "--trims", "1", "0"], ["0 stands after 1"]),
        (["--trims", "1"], ["--trims", "--table"]),
        (["--lcg", "1"], ["--lcg", "--weight"]),
        (["--weight", "1e6"], ["weight of 1000000 t", "more than the hull carries"]),
        (["--weight", "nan"], ["weight of nan t is none", "from 0 to 8200 t"]),
        (["--rho", "0"], ["rho is 0.0"]),
        (["--appendage", "fin,1,2"], ["NAME,VOLUME,X,Y,Z,AREA"]),
        (["--appendage", "fin,nan,0,0,0,0"], ["volume is nan"]),
        (["-o", "table.txt"], [".csv or .xlsx"]),
        (["--plot-of", "areas"], ["--plot-of", "--plot"]),
        (["--draught", "5", "--table", "1:2:1"], ["not allowed with"]),
    ],
    ids=lambda value: " ".join(value),
)
def test_what_cannot_be_is_refused_in_one_line(
    hull: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], words: list[str]
) -> None:
    """Exit code 2, and the value with the admissible range."""
    assert main(["hydrostatics", str(hull), *arguments]) == 2
    text = capsys.readouterr().err
    assert text.count("\n") == 1
    assert [each for each in words if each not in text] == []


class TestOnTheNet:
    """The same command on what the hull itself displaces."""

    @pytest.fixture(autouse=True)
    def closed_form(self) -> None:
        """Nothing stands in for the hull here."""

    def test_json_and_python_say_the_same(self, hull: Path, facts: Json) -> None:
        """Every value and error, at trim and heel."""
        found = facts("hydrostatics", hull, "--draughts", 5.5, 6.5, "--heel", 4, "--kg", 3)
        record = ah.open(hull).hydrostatics(draughts=(5.5, 6.5), heel_deg=4.0, kg=3.0)
        for name in FIELDS:
            value = getattr(record, name)
            expected = value if value is None else pytest.approx(value, rel=1e-9, abs=1e-9)
            assert found["rows"][0][name] == expected, name
        assert found["rows"][0]["error"]["volume"] == pytest.approx(
            record.error["volume"], rel=1e-6
        )

    def test_the_volume_of_the_wigley_hull_is_within_its_error(
        self, hull: Path, facts: Json
    ) -> None:
        """V = 4/9 L B T; the error is told, and is no more than needed."""
        (row,) = facts("hydrostatics", hull)["rows"]
        off = abs(row["volume"] - 4 / 9 * 6250)
        assert off <= row["error"]["volume"] <= 20.0 * off

    def test_files_and_pictures_are_written(self, hull: Path, facts: Json, tmp_path: Path) -> None:
        """Of a table and of one position, all three pictures."""
        pytest.importorskip("matplotlib")
        table, curves = tmp_path / "t.csv", tmp_path / "c.svg"
        found = facts("hydrostatics", hull, "--table", "3:6:1", "--no-estimate", "-o", table,
                      "--plot", curves)  # fmt: skip
        assert found["saved"] == [str(table), str(curves)]
        for name in ("areas", "bonjean"):
            out = tmp_path / f"{name}.png"
            facts("hydrostatics", hull, "--no-estimate", "--plot", out, "--plot-of", name)
            assert out.stat().st_size > 5000
        assert curves.stat().st_size > 5000

"""The command ``doctor``: slips of a table as text and as JSON, the mended table, exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from assoc_hull.cli import main
from tests.damaged_tables import series60_table
from tests.unit.cli.conftest import Json


@pytest.fixture
def spoilt(tmp_path: Path) -> Path:
    """Series 60 .70 with 0.245 for 0.425 at station 18."""
    path = tmp_path / "offsets.csv"
    path.write_text(series60_table("070").text().replace(",0.425,", ",0.245,"))
    return path


def test_a_slip_is_told_and_mended(spoilt: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Exit 1 where there is one, 0 for the mended table; a file that is there is not replaced."""
    mended = spoilt.with_name("mended.csv")
    assert main(["doctor", str(spoilt), "--mend", str(mended), "--top", "2"]) == 1
    told = capsys.readouterr().out
    assert "offsets.csv (normalised): 1 slip called (score above 15)" in told
    assert "0.425: two digits exchanged" in told
    assert "station 18, waterline 0.75: 0.245 to 0.425" in told
    assert main(["doctor", str(mended)]) == 0
    assert "0 slips called" in capsys.readouterr().out
    assert main(["doctor", str(spoilt), "--mend", str(mended)]) == 2
    assert "there is a file of this name" in capsys.readouterr().err
    assert main(["doctor", str(spoilt), "--mend", str(mended), "--replace"]) == 1
    # what stands under a name is always the table that was asked about last
    assert main(["doctor", str(mended), "--mend", str(spoilt.with_name("new.csv"))]) == 0
    assert "is the table as it is" in capsys.readouterr().out
    assert spoilt.with_name("new.csv").read_text().endswith(mended.read_text())


def test_findings_are_one_document(spoilt: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With the names of the Python objects; the number of those called, and the alarm, beside."""
    assert main(["doctor", str(spoilt), "--json", "--top", "3"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert (found["format"], found["schema"]) == ("assoc-hull report", 1)
    assert (found["called"], found["alarm"], len(found["findings"])) == (1, 15.0, 3)
    first = found["findings"][0]
    assert (first["station"], first["printed"]) == ("18", "0.245")
    assert first["numbers"][0] == {"text": "0.425", "slip": "two digits exchanged"}


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        (["--top", "-1"], "top is -1"),
        (["--mend", "mended.xlsx"], "end the name in .csv"),
        (["--mend", "no folder/mended.csv"], "make the folder first"),
        (["--centre", "one"], "centre is 'one'"),
        (["--noise", "1mm"], "--noise cannot be given"),
    ],
)
def test_what_cannot_be_done_is_one_line(
    words: list[str], wanted: str, spoilt: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit 2; what, where, what to do."""
    assert main(["doctor", str(spoilt), *words]) == 2
    told = capsys.readouterr()
    assert wanted in told.err
    assert told.out == ""


def test_a_hull_is_asked_itself(
    hull: Path, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """Points in place of cells; nothing can be mended there."""
    found = facts("doctor", hull, "--noise", "2mm")
    assert (found["called"], found["findings"], found["points"] > 100) == (0, [], True)
    assert main(["doctor", str(hull)]) == 0
    assert "0 points called" in capsys.readouterr().out
    assert main(["doctor", str(hull), "--mend", str(hull.with_name("m.csv"))]) == 2
    assert "--mend cannot be given" in capsys.readouterr().err

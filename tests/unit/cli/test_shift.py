"""The commands `shift`, `swing` and `jumboise`: values met, scripts that repeat them, refusals."""

from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from tests.unit.cli.conftest import Json


def test_a_shifted_hull_is_written(hull: Path, tmp_path: Path, facts: Json) -> None:
    """With its new values; the parent is as it was, and the script repeats it to the last bit."""
    target = tmp_path / "fuller.hull.json"
    found = facts("shift", hull, "--to", "cb=0.45", "--by", "lcb_percent=0.4", "-o", target)
    assert [each["name"] for each in found["targets"]] == ["cb", "lcb_percent"]
    assert found["steps"][-1]["residual"] < 1e-10
    assert found["terminals"] == [0.0, 50.0, 50.0, 100.0]
    shifted = ah.open(target)
    assert shifted.hydrostatics().cb == pytest.approx(0.45, abs=1e-10)
    assert shifted.fingerprint == found["fingerprint"]
    parent = ah.open(hull)
    again = parent.vary_by(found["script"], ship=parent.particulars.name).hull
    assert found["fingerprint"] == again.fingerprint


def test_a_swung_hull_is_written_into_its_file(hull: Path, facts: Json) -> None:
    """Without OUT the hull itself is changed."""
    found = facts("swing", hull, "--draught", "5")
    assert found["saved"] == str(hull)
    ship = ah.open(hull).particulars
    assert ship.draught == 5.0
    assert ship.breadth == pytest.approx(12.5, rel=1e-12)


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (["shift", "--by", "cb=0.3"], "a change of 0.3 in CB makes sections cross at x="),
        (["shift", "--by", "cb"], "--by cb: give NAME=VALUE"),
        (["shift"], "nothing is asked for, in shift_sections"),
        (["shift", "--by", "cb=0.01", "--terminals", "0", "60", "50", "100"], "do not rise"),
        (["swing"], "none of length, breadth, draught are given, in swing"),
        (["jumboise", "3"], "no parallel middle body, in jumboise; give at=50: there"),
    ],
    ids=["sections cross", "no value", "nothing", "terminals", "no dimension", "no body"],
)
def test_a_refusal_is_one_line(
    hull: Path, capsys: pytest.CaptureFixture[str], command: list[str], says: str
) -> None:
    """Exit 2, the file as it was."""
    before = hull.read_bytes()
    assert main([command[0], str(hull), *command[1:]]) == 2
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1
    assert hull.read_bytes() == before


def test_a_longer_hull_is_written(hull: Path, tmp_path: Path, facts: Json) -> None:
    """With its new length, volume, and names by the new length."""
    target = tmp_path / "longer.hull.json"
    found = facts("jumboise", hull, "5", "--at", "50", "--names", "number", "-o", target)
    assert len(found["added"]) == 1
    assert found["renamed"]
    before, after = found["volume"]
    assert after - before == pytest.approx(5.0 * found["area"], rel=1e-8)
    longer = ah.open(target)
    assert (longer.particulars.length, longer.fingerprint) == (105.0, found["fingerprint"])
    assert facts("jumboise", target, "-3")["moved_off"] < 1e-6

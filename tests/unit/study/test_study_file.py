"""The file of a study: what has landed stays, the same call goes on, another call is refused."""

import os
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.io.tables.study_file import StudyFile
from assoc_hull.study import Study
from tests.unit.study.test_design import fuller

OUTPUTS = ["volume", "kmt"]
RANGES = {"breadth": (9.5, 10.5), "draught": (6.0, 6.4)}
SCRIPT = """
import sys
import time
import assoc_hull as ah

drawn = ah.study.sample({"breadth": (9.5, 10.5), "draught": (6.0, 6.4)}, 24, seed=3)
hull = ah.examples.wigley(stations=7, waterlines=5)
say = lambda what, done, of: (print(done, flush=True), time.sleep(0.05))  # to be stopped in time
hull.study(set=drawn, outputs=["volume", "kmt"], file=sys.argv[1], progress=say)
"""


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A hull of few lines; no test changes it."""
    return ah.examples.wigley(stations=7, waterlines=5)


@pytest.fixture(scope="module")
def asked() -> dict[str, Any]:
    """Values of two parameters."""
    return {"set": ah.study.sample(RANGES, 24, seed=3), "outputs": OUTPUTS}


@pytest.fixture(scope="module")
def unbroken(hull: ah.Hull, asked: dict[str, Any]) -> Study:
    """The study in memory, from its first row to its last."""
    return hull.study(**asked)


def in_file(path: Path) -> list[int]:
    """The numbers of the rows that any program finds in the file."""
    database = sqlite3.connect(path)
    found = [number for (number,) in database.execute("SELECT number FROM rows ORDER BY number")]
    database.close()
    return found


def run_until(path: Path, done: int) -> subprocess.Popen[str]:
    """Begin the study in another process, and wait until so many rows have landed."""
    command = [sys.executable, "-c", SCRIPT, str(path)]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=Path.cwd())
    assert child.stdout is not None
    for line in child.stdout:
        if int(line) >= done:
            break
    return child


def end(child: subprocess.Popen[str], how: signal.Signals) -> None:
    """End a child."""
    os.kill(child.pid, how)
    assert child.stdout is not None
    child.stdout.close()
    child.wait()


def test_a_study_that_was_killed_goes_on_with_the_same_bits(
    hull: ah.Hull, asked: dict[str, Any], unbroken: Study, tmp_path: Path
) -> None:
    """What was told to have landed has; twice killed, each row is there once, as if never so."""
    path = tmp_path / "study.sqlite"
    for least in (3, 9):
        end(run_until(path, least), signal.SIGKILL)
        assert least <= len(in_file(path)) < 24
    before = in_file(path)
    found = hull.study(**asked, file=path)
    assert set(before) < set(in_file(path))
    assert in_file(path) == list(range(24))
    assert found.rows == unbroken.rows
    assert found.to_json() == unbroken.to_json()
    assert os.listdir(tmp_path) == ["study.sqlite"]


def test_a_file_that_is_written_to_is_refused_and_can_be_read(
    hull: ah.Hull, asked: dict[str, Any], tmp_path: Path
) -> None:
    """Until the other process has ended."""
    path = tmp_path / "study.sqlite"
    child = run_until(path, 1)
    try:
        with pytest.raises(ah.errors.StudyBusyError, match="another study is writing"):
            hull.study(**asked, file=path)
        assert in_file(path)
    finally:
        end(child, signal.SIGKILL)


def test_a_study_that_is_complete_is_read(
    hull: ah.Hull, asked: dict[str, Any], unbroken: Study, tmp_path: Path
) -> None:
    """No row is made again; what it gives is what the first call gave."""
    path = tmp_path / "study.sqlite"
    told: list[int] = []
    for _ in range(2):
        found = hull.study(**asked, file=path, progress=lambda what, done, of: told.append(done))
    assert told.count(24) == 1
    assert str(found) == "24 of 24 variants"
    assert len(found) == 24
    for name, column in unbroken.table().items():
        assert column.dtype == found.table()[name].dtype
        assert (column == found.table()[name]).all()
    assert found.hull(7).fingerprint == unbroken.hull(7).fingerprint


def test_more_of_the_same_is_added(hull: ah.Hull, tmp_path: Path) -> None:
    """A longer sequence begins with the shorter one, whose rows stay."""
    path = tmp_path / "study.sqlite"
    for count in (4, 7):
        drawn = ah.study.sample(RANGES, count, seed=3)
        found = hull.study(set=drawn, outputs=OUTPUTS, file=path)
        assert len(found) == count
    assert found.rows == hull.study(set=drawn, outputs=OUTPUTS).rows


def test_targets_bounds_and_failures_go_on_too(hull: ah.Hull, tmp_path: Path) -> None:
    """With an interrupt after the first rows; reasons stand in the file as they stand in memory."""
    asked: dict[str, Any] = {
        "reach": {"volume": hull.hydrostatics().volume * np.array([1.001, 1.3, 1.004])},
        "free": ["breadth", fuller()], "bounds": {"breadth": (9.0, 10.02), "fuller": (-2.0, 2.0)},
        "outputs": ["kmt"],
    }  # fmt: skip

    def stop(what: str, done: int, of: int) -> None:
        raise KeyboardInterrupt

    path = tmp_path / "study.sqlite"
    broken = hull.study(**asked, file=path, progress=stop)
    assert broken.interrupted
    assert len(broken) < 3
    found = hull.study(**asked, file=path)
    assert [row.failure for row in found.rows] == ["", "out of range", ""]
    assert found.rows == hull.study(**asked).rows
    assert found.failed == (found.rows[1],)


OTHERS: dict[str, tuple[dict[str, Any], str]] = {
    "value": ({"set": {"breadth": [10.0, 10.2]}}, "breadth of row 1 is 10.1.* there, and 10.2"),
    "fewer": ({"set": {"breadth": [10.0]}}, "2 rows were asked for there, and 1 here"),
    "parameter": ({"set": {"draught": [6.0, 6.1]}}, "parameters that are set.*breadth.*draught"),
    "output": ({"outputs": ["kmt"]}, "outputs are others there"),
    "layer": ({"layers": [fuller()]}, "parameters that are set are others there"),
    "layout": ({"layout": {"stern": 0.2}}, "layout.*stern"),
}


@pytest.mark.parametrize(("change", "words"), OTHERS.values(), ids=OTHERS)
def test_another_design_is_refused(
    hull: ah.Hull, change: dict[str, Any], words: str, tmp_path: Path
) -> None:
    """And told what differs; the file stays as it is."""
    path = tmp_path / "study.sqlite"
    asked: dict[str, Any] = {"set": {"breadth": [10.0, 10.1]}, "outputs": ["volume"]}
    hull.study(**asked, file=path)
    before = path.read_bytes()
    with pytest.raises(ah.errors.BadInputError, match=words) as caught:
        hull.study(**{**asked, **change}, file=path)
    assert str(path) in str(caught.value)
    assert path.read_bytes() == before


def test_layers_that_differ_in_a_number_are_others(hull: ah.Hull, tmp_path: Path) -> None:
    """Though their names are the same."""
    path = tmp_path / "study.sqlite"
    asked: dict[str, Any] = {"set": {"fuller": [0.5]}, "outputs": ["volume"], "file": path}
    hull.study(**asked, layers=[fuller()])
    assert len(hull.study(**asked, layers=[fuller()])) == 1
    with pytest.raises(ah.errors.BadInputError, match="layers are others there"):
        hull.study(**asked, layers=[ah.variation.FieldLayer("fuller", fuller().fields[:0])])


def test_another_hull_is_refused(hull: ah.Hull, tmp_path: Path) -> None:
    """By its fingerprint."""
    path = tmp_path / "study.sqlite"
    asked: dict[str, Any] = {"set": {"breadth": 10.1}, "outputs": ["volume"], "file": path}
    hull.study(**asked)
    with pytest.raises(ah.errors.BadInputError, match="the study there is of another hull"):
        ah.examples.wigley(stations=9, waterlines=6).study(**asked)


def test_another_program_may_read_but_not_add(
    hull: ah.Hull, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Rows of two programs would not have the same last digits."""
    path = tmp_path / "study.sqlite"
    asked: dict[str, Any] = {"outputs": ["volume"], "file": path}
    hull.study(set={"breadth": [10.0]}, **asked)
    theirs = {"assoc-hull": "0.0.1", "numpy": "2.0"}
    monkeypatch.setattr("assoc_hull.io.tables.study_file.versions", lambda: theirs)
    assert len(hull.study(set={"breadth": [10.0]}, **asked)) == 1
    with pytest.raises(ah.errors.BadInputError, match=r"1 rows are missing.*numpy 2\.0"):
        hull.study(set={"breadth": [10.0, 10.1]}, **asked)


def test_a_file_of_another_kind_is_refused(hull: ah.Hull, tmp_path: Path) -> None:
    """Text, another database, a folder that is not there; none is touched."""
    text, other = tmp_path / "notes.txt", tmp_path / "other.sqlite"
    text.write_text("no database, and longer than a header of one" * 10)
    database = sqlite3.connect(other)
    database.execute("CREATE TABLE mine (a)")
    database.close()
    for path in (text, other):
        before = path.read_bytes()
        with pytest.raises(ah.errors.BadInputError, match="it is no file of a study"):
            hull.study(set={"breadth": 10.0}, file=path)
        assert path.read_bytes() == before
    with pytest.raises(ah.errors.HullFileError, match="cannot be written"):
        hull.study(set={"breadth": 10.0}, file=tmp_path / "none" / "study.sqlite")


def test_a_row_that_is_made_twice_lands_once(hull: ah.Hull, tmp_path: Path) -> None:
    """As where a worker was believed dead."""
    found = hull.study(set={"breadth": [10.0, 10.1]}, outputs=["volume"])
    with StudyFile.opened(found.run, tmp_path / "study.sqlite") as table:
        table.land(found.rows[1:])
        table.land(found.rows)
        assert table.landed().tolist() == [True, True]
    assert table.rows() == found.rows


def test_numbers_keep_their_bits(hull: ah.Hull, tmp_path: Path) -> None:
    """Negative zero and nan too, which a column of numbers would not."""
    made = hull.study(set={"breadth": 10.0}, outputs=["volume"])
    changed: dict[str, Any] = {"outputs": np.array([-0.0]), "margin": float("nan"), "shift": -0.0}
    odd = attrs.evolve(made.rows[0], **changed)
    with StudyFile.opened(made.run, tmp_path / "study.sqlite") as table:
        table.land([odd])
    assert table.rows() == (odd,)
    assert np.signbit(table.columns()["volume"]).all()


def test_a_damaged_file_is_refused_and_never_believed(
    hull: ah.Hull, unbroken: Study, asked: dict[str, Any], tmp_path: Path
) -> None:
    """Bytes that change, and ends that are lost: the true rows, or an error of this package."""
    path, dice = tmp_path / "study.sqlite", np.random.default_rng(5)
    hull.study(**asked, file=path)
    sound, refused = path.read_bytes(), 0
    database = sqlite3.connect(path)
    database.execute("UPDATE rows SET numbers = zeroblob(length(numbers)) WHERE number = 3")
    database.commit()
    database.close()
    with pytest.raises(ah.errors.DamagedFileError, match="row 3 is not what was written"):
        hull.study(**asked, file=path)
    for turn in range(60):
        data = np.frombuffer(sound, np.uint8).copy()
        if turn % 2:
            data[dice.integers(0, len(data), 20)] = dice.integers(0, 256, 20)
        else:
            data = data[: dice.integers(1, len(data))]
        path.write_bytes(data.tobytes())
        try:
            found = hull.study(**asked, file=path)
        except (ah.errors.DamagedFileError, ah.errors.HullFileError, ah.errors.BadInputError):
            refused += 1
        else:
            assert found.rows == unbroken.rows
    assert refused > 30


@pytest.mark.parametrize("name", ["study", ":memory:", "file:study?mode=memory", "50%20 off#1"])
def test_the_file_of_a_study_is_found_wherever_the_program_stands(
    hull: ah.Hull, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A name means what it means to the system, and is told from where it was given."""
    monkeypatch.chdir(tmp_path)
    found = hull.study(set={"breadth": 10.0}, outputs=["volume"], file=name)
    monkeypatch.chdir("/")
    assert len(found.rows) == 1
    assert [each.name for each in tmp_path.iterdir()] == [name]

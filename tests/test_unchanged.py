"""Nothing that is computed has changed by a bit, and files of every earlier version open."""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.io.hull_file.database import SCHEMA
from tests.long_forms import LONG, long_form
from tests.unchanged import REPOSITORY, SHIPS, hash_of, main

FILES = REPOSITORY / "tests" / "data" / "hull_files"
RECORDED = json.loads((FILES / "fingerprints.json").read_text(encoding="utf-8"))


def recomputed(*arguments: str, seed: str) -> subprocess.CompletedProcess[str]:
    """The script in a process of its own: numpy is loaded for one thread, names hash otherwise."""
    return subprocess.run(
        [sys.executable, "-m", "tests.unchanged", *arguments],
        cwd=REPOSITORY,
        env=os.environ | {"PYTHONHASHSEED": seed},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.skipif(LONG, reason="the whole is compared")
@pytest.mark.parametrize(
    ("ship", "part"),
    [
        pytest.param("wigley", "1/4", id="Wigley"),
        pytest.param("series60_70", "10/12", id="Series 60"),
    ],
)
def test_some_of_all_that_is_computed_is_as_it_was(ship: str, part: str) -> None:
    """Records and some acts on two hulls give what was recorded, to the last bit."""
    done = recomputed("--only", ship, "--part", part, seed="3")
    assert done.returncode == 0, done.stdout + done.stderr


@long_form
@pytest.mark.parametrize("ship", SHIPS)
def test_all_that_is_computed_is_as_it_was(ship: str) -> None:
    """Every record, file and act of every ship gives what was recorded, to the last bit."""
    done = recomputed("--only", ship, seed="4")
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_difference_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """What differs, is gone or is new is printed by ship and fact, and the script ends in 1."""
    was = {"acts": [], "facts": {"records": {"one": "a", "two": "b", "three": "c"}}}
    file = tmp_path / "unchanged.json"
    file.write_text(json.dumps({"wigley": was}), encoding="utf-8")
    monkeypatch.setattr("tests.unchanged.FILE", file)
    found = {"records": {"one": "a", "two": "x", "four": "d"}}
    monkeypatch.setattr("tests.unchanged._compute", lambda *_: found)
    assert main(["--only", "wigley"]) == 1
    told = capsys.readouterr().out
    assert "wigley: records, two:\n    was b\n    is  x\n" in told
    assert "wigley: records, three:\n    was c\n    is  nothing\n" in told
    assert "wigley: records, four:\n    was nothing\n    is  d\n" in told
    assert told.endswith("3 facts of 3 in 1 ships differ\n")
    assert main(["--only", "wigley", "--write"]) == 0
    assert main(["--only", "wigley"]) == 0
    assert capsys.readouterr().out.endswith("3 facts of 1 ships are the same\n")


def test_last_bits_of_products_are_kept_by_kind_of_machine(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A fact kept for one arithmetic is compared on it alone, and counted elsewhere.

    What is written anew is forgotten for the kinds of machines that were not asked.
    """
    file, found = tmp_path / "unchanged.json", {"records": {"one": "a", "two": "b"}}
    facts = {"records": {"one": "a", "two": {"there": "y"}}}
    file.write_text(json.dumps({"wigley": {"acts": [], "facts": facts}}), encoding="utf-8")
    monkeypatch.setattr("tests.unchanged.FILE", file)
    monkeypatch.setattr("tests.unchanged._compute", lambda *_: found)
    monkeypatch.setattr("tests.unchanged._arithmetic", lambda: "here")
    asked = ["--only", "wigley"]
    assert main(asked) == 0
    assert (
        "1 facts are kept for other kinds of arithmetic than here only\n" in capsys.readouterr().out
    )
    assert main([*asked, "--machine"]) == 0
    found["records"] = {"one": "a", "two": "c"}
    assert main(asked) == 1
    assert "records, two:\n    was b\n    is  c\n" in capsys.readouterr().out
    assert main([*asked, "--write"]) == 0
    kept = json.loads(file.read_text(encoding="utf-8"))["wigley"]["facts"]["records"]
    assert kept == {"one": "a", "two": {"here": "c"}}


@pytest.mark.parametrize(
    ("one", "other"),
    [
        pytest.param(0.1, math.nextafter(0.1, 1.0), id="the last bit"),
        pytest.param(0.0, -0.0, id="the sign of nil"),
        pytest.param({"a": [1.0]}, {"a": [1]}, id="whole number or real"),
        pytest.param(np.zeros((2, 3)), np.zeros((3, 2)), id="shape"),
        pytest.param(np.array([0.1]), np.array([math.nextafter(0.1, 1.0)]), id="bit in an array"),
        pytest.param(("a", ("b",)), ("a", "b"), id="nesting"),
    ],
)
def test_a_hash_tells_every_bit(one: object, other: object) -> None:
    """Values that compare equal, or print alike, have hashes of their own."""
    assert hash_of(one) == hash_of(one)
    assert hash_of(one) != hash_of(other)


def version_in(path: Path) -> int:
    """The version of a hull file, as its head tells it: a database that is opened is changed."""
    return int.from_bytes(path.read_bytes()[60:64], "big")


@pytest.mark.parametrize("name", RECORDED)
def test_files_of_earlier_versions_open(name: str, tmp_path: Path) -> None:
    """A hull file or text of any version gives the hull that was written, and its history.

    The fingerprints are those that the programs of that time gave.
    """
    recorded = RECORDED[name]
    path = Path(shutil.copy(FILES / name, tmp_path))
    hull = ah.open(path)
    assert (hull.fingerprint, len(hull.history)) == (recorded["fingerprint"], recorded["edits"])
    assert hull.check() == ()
    assert hull.verify() == ()
    if hull.history:
        hull.undo(len(hull.history))
        assert hull.fingerprint == recorded["before"]
    hull.close()


def test_there_is_a_file_of_every_version() -> None:
    """Every version of the hull file that is read has a file that was written by it."""
    versions = {version_in(path) for path in FILES.glob("*.hull")}
    assert versions == set(range(1, SCHEMA + 1))
    assert {path.name for path in FILES.iterdir()} == {*RECORDED, "fingerprints.json"}

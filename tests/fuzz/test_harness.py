"""The harness sees what it is there to see."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random
from unittest import mock

import pytest

from assoc_hull import cli
from tests.fuzz.__main__ import main
from tests.fuzz.all_kinds import KINDS
from tests.fuzz.harvest import Tally, small
from tests.fuzz.kind import TARGET, Kind, made
from tests.fuzz.pool import DEAD, HANG, Item, run_all
from tests.fuzz.trial import Outcome, signature, trial


def _error(text: str, code: int = 2) -> int:
    print(text, file=sys.stderr)
    return code


def _left(name: str, code: int) -> int:
    Path(name).write_text("{")
    return code if code != 2 else _error("error: no")


def _both() -> int:
    print("facts")
    return _error("error: no")


def _raise() -> int:
    raise ValueError("odd")


PLANTED: dict[str, tuple[Callable[[], int], str]] = {
    "an exception": (_raise, "ValueError left the program"),
    "a masked one": (lambda: _error("error: KeyError inside the program (3), at a"), "inside"),
    "two lines": (lambda: _error("error: a\nb"), "no single line"),
    "no line": (lambda: 2, "no single line"),
    "another code": (lambda: 4, "exit code 4"),
    "no findings": (lambda: _error("error: not sound", 3), "no findings were told"),
    "an endless message": (lambda: _error("error: " + "x " * 3000), "letters"),
    "a warning": (lambda: _error("beware", 0), "yet said"),
    "facts and failure": (_both, "told facts"),
    "a file left behind": (lambda: _left(".out.part", 2), "left .out.part behind"),
    "a target in spite of failure": (lambda: _left(TARGET, 2), "failed and left"),
    "half a target": (lambda: _left(TARGET, 0), "cannot be read"),
    "no target": (lambda: 0, "wrote no"),
    "a changed input": (lambda: _left("table.csv", 2), "changed table.csv"),
}


@pytest.mark.parametrize(("planted", "told"), PLANTED.values(), ids=PLANTED.keys())
def test_a_planted_fault_is_named(planted: Callable[[], int], told: str, tmp_path: Path) -> None:
    """Whatever a command may not do is found, and the folder is empty afterwards."""
    with mock.patch.object(cli, "main", side_effect=lambda _: planted()):
        outcome = trial(KINDS["offsets"], b"station,wl_0\n", tmp_path)
    assert told in outcome.fault
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", KINDS)
def test_an_input_is_that_of_its_number(name: str) -> None:
    """The same number and seed give the same bytes, others give others."""
    kind = KINDS[name]
    inputs = [made(kind, 1, number) for number in range(20)]
    assert inputs == [made(kind, 1, number) for number in range(20)]
    assert len(set(inputs)) > 10


def test_faults_that_differ_in_names_and_numbers_only_are_one() -> None:
    """A run names each fault once."""
    assert signature("no 'ST 1' at 3.5 in a.py:7") == signature("no 'WL 2' at -1e9 in a.py:7")
    tally = Tally()
    for number in (1, 2):
        item = Item(KINDS["edits"], 1, number)
        tally.add(item, Outcome(2, f"edit: no 'ST {number}'", 0.1 * number))
    assert [len(each) for each in tally.faults.values()] == [2]
    assert tally.line("edits").split() == [
        "edits",
        "2",
        "2",
        *"000000",
        "2",
        "1",
        "0.20",
        "0.00",
        "0",
    ]


def test_a_faulty_input_is_made_small(tmp_path: Path) -> None:
    """What has no part in the fault is left out."""

    def faulty(_: object) -> int:
        return _raise() if b"bad" in Path("table.csv").read_bytes() else _error("error: no")

    data = b"a,b,c\n1,2,3\n" * 20 + b"1,bad,3\n" + b"4,5,6\n" * 20
    with mock.patch.object(cli, "main", faulty):
        fault = trial(KINDS["offsets"], data, tmp_path).fault
        assert fault.startswith("import: ValueError left the program: odd (test_harness.py:")
        assert small(KINDS["offsets"], data, fault) == b"bad"


def _spin(_: Random) -> bytes:
    while True:
        pass


def _die(_: Random) -> bytes:
    os._exit(3)


def _quick(_: Random) -> bytes:
    return b""


def _nothing(_: bytes) -> list[list[str]]:
    return []


def test_an_input_without_end_is_ended_and_the_next_is_tried() -> None:
    """One that hangs twice, or takes its process along, is named; the others are tried."""
    makers = (_spin, _die, _quick)
    items = [Item(Kind(make.__name__, "a", make, _nothing), 1, 0) for make in makers]
    faults = {item.kind.name: each.fault for item, each in run_all(items, limit=1.0)}
    assert faults == {"_spin": HANG, "_die": DEAD, "_quick": ""}


def test_a_run_prints_a_table(capsys: pytest.CaptureFixture[str]) -> None:
    """A row per kind, and exit code 0 where nothing was found."""
    assert main(["--count", "12", "--jobs", "1", "--kind", "offsets,edits"]) == 0
    head, *rows = capsys.readouterr().out.splitlines()[:3]
    assert head.split()[:4] == ["kind", "inputs", "refused", "unsound"]
    assert [row.split()[0:2] for row in rows] == [["offsets", "6"], ["edits", "6"]]

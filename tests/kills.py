"""Killing a process that edits a hull file, again and again: nothing committed may be lost.

``python -m tests.kills --count 1000 --seed 1`` prints kills, commits reported, commits found,
lost. The child says what it is about to do, does it, and says what came of it; it is killed at
a random instant. Then the file must open, check and verify, hold every step that was reported,
and stand where the last report left it, or one act further.
"""

from __future__ import annotations

import argparse
import os
import random
import select
import signal
import sys
import tempfile
import time
from pathlib import Path

import attrs

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.io.hull_file.storage import HullFile
from assoc_hull.model.definition.fingerprint import root_of

__all__ = ["Tally", "run"]

_PER_FILE = 50
"""After so many kills a fresh file is taken."""

_EDITS = ("move", "line", "switch", "lead")
"""Acts that each make one step."""

_LONGEST = 0.25
"""The child lives so long (s) at most once it has opened the file."""


@attrs.define
class Tally:
    """What came of the kills."""

    kills: int = 0
    inside: int = 0
    reported: int = 0
    found: int = 0
    lost: int = 0
    faults: list[str] = attrs.field(factory=list)

    def __str__(self) -> str:
        return (
            f"kills {self.kills} ({self.inside} inside a commit), commits reported "
            f"{self.reported}, commits found {self.found}, lost {self.lost}, "
            f"other faults {len(self.faults)}"
        )


@attrs.frozen
class Word:
    """What the child said after an act: which, the step and fingerprint the hull stands at."""

    act: str
    head: int
    fingerprint: str
    root: str = ""


def make(path: Path) -> None:
    """Write a fresh hull file."""
    hull = ah.examples.wigley(stations=7, waterlines=5)
    hull.save(path)
    hull.close()


def child(path: Path, seed: int, pipe: int) -> None:
    """Edit for ever: move points, lead and switch lines, add and remove some, undo, reopen ..."""
    rng = random.Random(seed)
    _say_when_inside(pipe)
    hull = ah.open(path)
    os.write(pipe, b"ready\n")
    while True:
        acts = ["move"] * 6 + ["line", "switch", "lead", "name", "reopen"]
        acts += ["undo"] if hull.document.history else []
        acts += ["redo"] if hull.document.undone else []
        act = rng.choice(acts)
        os.write(pipe, f"try {act}\n".encode())
        if act == "reopen":
            hull.close()
            hull = ah.open(path)
        else:
            try:
                _perform(hull, act, rng)
            except (ah.errors.RefusedEditError, ah.errors.PointRoleError):
                act = "refused"  # a point is driven since a switch, or a lead would fold
        told = f"did {act} {hull.document.head} {hull.fingerprint} {root_of(hull.state)}\n"
        os.write(pipe, told.encode())


def _say_when_inside(pipe: int) -> None:
    commit = HullFile.commit

    def said(self: HullFile, *args: object) -> None:
        os.write(pipe, b"in\n")
        commit(self, *args)  # type: ignore[arg-type]
        os.write(pipe, b"out\n")

    HullFile.commit = said  # type: ignore[method-assign, assignment]


def _perform(hull: ah.Hull, act: str, rng: random.Random) -> None:
    if act in ("undo", "redo"):
        getattr(hull, act)()
    elif act == "name":
        hull.checkpoint(f"state {len(hull.labels)} {rng.random():.12f}")
    elif act == "line":
        with hull.edit("a line") as edit:
            extra = [name for name in hull.lines if name.startswith("extra")]
            if extra:
                edit.remove_line(extra[0])
            else:
                edit.add_line("waterlines", rng.uniform(1.0, 5.0), f"extra {rng.random():.12f}")
    elif act == "switch":
        with hull.edit("a switch", gaps="report") as edit:
            _switch(edit, hull, rng)
    elif act == "lead":
        with hull.edit("a lead", gaps="report") as edit:
            x, y, z = hull.lines["WL 1.5625"].curves[0].at(rng.uniform(30.0, 70.0))
            edit.lead("WL 1.5625", [(x, y + rng.choice((-0.005, 0.005)), z)])
    else:
        names = [f"WL {z} x ST {n}" for z in ("3.125", "4.6875") for n in (2, 3, 4)]
        point = hull.points[rng.choice(names)]
        with hull.edit("a move") as edit:
            edit.move(point, y=point.y + rng.uniform(-0.01, 0.01))


def _switch(edit: Edit, hull: ah.Hull, rng: random.Random) -> None:
    """Say who rules where, part two groups and join them, or make or change a group."""
    cut, which = rng.uniform(20.0, 80.0), rng.randrange(3)
    if which == 0:
        edit.rule("waterlines", "sections", [("waterlines", {"x": (None, cut)})])
    elif which == 1:
        edit.dissociate("waterlines", "sections")
        edit.associate("waterlines", "sections")
    elif "own" in hull.groups:
        edit.regroup("own", rng.sample(["ST 1", "ST 2", "ST 3"], 2))
    else:
        edit.group("own", ["ST 1"])


def kill_one(path: Path, rng: random.Random) -> tuple[list[Word], str, bool]:
    """Let a child edit, kill it; give what it did, what it was about to do, and if inside."""
    reader, writer = os.pipe()
    seed = rng.randrange(2**32)
    pid = os.fork()
    if not pid:
        os.close(reader)
        try:
            child(path, seed, writer)
        except BaseException as error:
            os.write(writer, f"fault {type(error).__name__} {error}\n".encode())
        finally:
            os._exit(1)
    os.close(writer)
    select.select([reader], [], [], 30.0)
    time.sleep(rng.uniform(0.0, _LONGEST))
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    with os.fdopen(reader, "rb") as pipe:
        lines = [line.decode() for line in pipe.read().split(b"\n") if line]
    words = [line.split() for line in lines]
    done = [Word(each[1], int(each[2]), *each[3:]) for each in words if each[0] == "did"]
    faults = [line for line in lines if line.startswith("fault")]
    if faults:
        raise AssertionError(faults[0])
    after = [each[1] for each in words if each[0] == "try"][len(done) :]
    inside = [each[0] for each in words if each[0] in ("in", "out")][-1:] == ["in"]
    return done, (after or [""])[0], inside


def judge(path: Path, done: list[Word], began: tuple[int, str], act: str, tally: Tally) -> Word:
    """Open the file after a kill and compare it with what was reported."""
    hull = ah.open(path)
    steps = hull.document.steps
    for word in done:
        if word.act in _EDITS:
            tally.reported += 1
            step = steps.get(word.head)
            same = step is not None and step.fingerprint == word.root
            tally.found += same
            tally.lost += not same
    head, last = (done[-1].head, done[-1].fingerprint) if done else began
    now = hull.document.head, hull.fingerprint
    if now != (head, last) and not _one_further(hull, head, act):
        tally.faults.append(f"stands at step {now[0]}, after {head} and {act!r}")
    findings = [*hull.check(), *hull.verify()]
    damages = hull.document.keeper.damages() if isinstance(hull.document.keeper, HullFile) else []
    tally.faults += [f"{each}" for each in (*findings, *damages)]
    hull.close()
    return Word("", *now)


def _one_further(hull: ah.Hull, head: int, act: str) -> bool:
    """Tell whether the hull stands where the act that was cut short would have left it."""
    document = hull.document
    if act in _EDITS:
        return document.head > head and document.steps[document.head].parent == head
    if act == "undo":
        return head > 0 and document.steps[head].parent == document.head
    return act == "redo" and document.steps[document.head].parent == head


def run(count: int, seed: int, folder: Path, *, progress: bool = False) -> Tally:
    """Kill a child so many times."""
    rng, tally = random.Random(seed), Tally()
    path, stand = folder, Word("", 0, "")
    for number in range(count):
        if number % _PER_FILE == 0:
            path = folder / f"ship-{number // _PER_FILE}.hull"
            make(path)
            hull = ah.open(path)
            stand = Word("", 0, hull.fingerprint)
            hull.close()
        done, act, inside = kill_one(path, rng)
        tally.kills += 1
        tally.inside += inside
        stand = judge(path, done, (stand.head, stand.fingerprint), act, tally)
        if progress and (number + 1) % 100 == 0:
            print(tally, flush=True)
    return tally


def main() -> int:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tally = run(given.count, given.seed, Path(folder), progress=True)
    print(tally)
    print(*tally.faults[:20], sep="\n")
    return 1 if tally.lost or tally.faults else 0


if __name__ == "__main__":
    sys.exit(main())

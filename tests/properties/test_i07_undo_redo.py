"""I7: undo^n and redo^n restore the hull bit for bit, across files, processes and refused edits."""

import random
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from tests.long_forms import LONG, draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Act, Task, carry_out, fresh, tasks

ELSEWHERE = """
import sys
import assoc_hull as ah

hull = ah.open(sys.argv[1])
for act in ("redo", "undo"):
    print(hull.fingerprint)
    for _ in range(int(sys.argv[2])):
        getattr(hull, act)()
        print(hull.fingerprint)
    assert hull.check() == (), hull.check()
    assert hull.verify() == (), hull.verify()
    hull.close()
    hull = ah.open(sys.argv[1])
"""
EXAMPLES = {"wigley": "wigley", "series60 0.60": "series60_60"}
if LONG:
    EXAMPLES |= {"series60 0.70": "series60_70", "bulk carrier 207k": "bulk_carrier"}


def elsewhere(path: Path, count: int) -> list[str]:
    """Redo in another process, close, open and undo; the fingerprints on the way."""
    command = [sys.executable, "-c", ELSEWHERE, str(path), str(count)]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()


def edited(hull: ah.Hull, rng: random.Random, count: int) -> list[str]:
    """Make so many random edits of all kinds, refused ones among them; fingerprints on the way."""
    prints = [hull.fingerprint]
    for _ in range(20 * count):
        if len(prints) > count:
            break
        kinds = rng.choices((*SHAPES, *STRUCTURE), k=rng.choice((1, 1, 2)))
        acts = tuple(
            Act(kind, rng.randrange(2**16), rng.randrange(2**16), rng.uniform(-0.02, 0.02))
            for kind in kinds
        )
        if carry_out(hull, Task(acts)) is not None:
            prints.append(hull.fingerprint)
    assert len(prints) == count + 1
    with pytest.raises(ah.AssocHullError), hull.edit("refused") as edit:
        edit.shift_line(next(iter(hull.groups["sections"].lines)), -1e4)
    return prints


@pytest.mark.parametrize("name", EXAMPLES)
def test_undone_saved_and_made_again_elsewhere(
    name: str, tmp_path: Path, shipped: Callable[[str], ah.Hull]
) -> None:
    """Made in memory, undone, saved; made again and undone in another process; long: all hulls."""
    hull, path = shipped(EXAMPLES[name]), tmp_path / "ship.hull"
    prints = edited(hull, random.Random(name), 8)
    hull.undo(8)
    assert hull.fingerprint == prints[0]
    hull.save(path)
    hull.close()
    assert elsewhere(path, 8) == [*prints, *prints[::-1]]


@settings(max_examples=draws(30))
@given(st.integers(0, POOL - 1), tasks((*SHAPES, *STRUCTURE), most=5), st.randoms())
def test_any_way_through_the_history_gives_the_states_back(
    which: int, todo: list[Task], rng: random.Random
) -> None:
    """In a file, reopened at random: edits, undo, redo and branches; each step has its bits."""
    with tempfile.TemporaryDirectory() as folder:
        hull, path = fresh(which), Path(folder) / "ship.hull"
        hull.save(path)
        states = {0: hull.fingerprint}
        for task in todo:
            if hull.history and rng.random() < 0.4:
                hull.undo(rng.randint(1, len(hull.history)))
                assert hull.fingerprint == states[hull.document.head]
            if rng.random() < 0.5:
                hull.close()
                hull = ah.open(path)
            if carry_out(hull, task) is not None:
                states[hull.document.head] = hull.fingerprint
        hull.close()
        hull = ah.open(path)
        for number in rng.sample(sorted(states), len(states)):
            hull.document.go_to(number)
            assert hull.fingerprint == states[number]
            assert hull.verify() == ()
        hull.close()

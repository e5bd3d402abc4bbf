"""I5: the order in which groups, lines and associations are created changes nothing."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

import assoc_hull as ah
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.shipped.bulk_carrier_207k import bulk_carrier_207k_adopted
from assoc_hull.shipped.series60 import series60_adopted
from tests.long_forms import LONG

SHUFFLES = """
import random, sys
from importlib import import_module
import assoc_hull.edit.adoption.adopt_lines as home
from assoc_hull.hull import Hull
from assoc_hull.model.definition.fingerprint import fingerprint

seed, turns = int(sys.argv[1]), int(sys.argv[2])
plain = home.adopt

def shuffled(sources, particulars, associations, tolerances=None, grown=None):
    order = list(range(len(sources)))
    chance.shuffle(order)
    sources, associations = [sources[i] for i in order], list(associations)
    grown = None if grown is None else [grown[i] for i in order]
    chance.shuffle(associations)
    return plain(sources, particulars, associations, tolerances, grown)

for name in ("shipped.wigley", "io.offsets.net", "shipped.bulk_carrier_207k"):
    import_module(f"assoc_hull.{name}").adopt = shuffled
wigley = import_module("assoc_hull.shipped.wigley").wigley
series60 = import_module("assoc_hull.shipped.series60")
makers = {
    "wigley": wigley,
    "series60-060": lambda: series60.series60_adopted(0.60)[0],
    "series60-070": lambda: series60.series60_adopted(0.70)[0],
}
for name, make in makers.items():
    # Ships take long: one shuffle of one of them in every process.
    counts = {"series60-060": seed % 2, "series60-070": 1 - seed % 2, "wigley": turns}
    for turn in range(counts[name]):
        chance = random.Random(1000 * seed + turn)
        state = make()
        print(name, fingerprint(state))
        if name == "wigley":
            hull = Hull(state)
            with hull.edit("lead") as edit:
                edit.lead("WL 2.5", [(36.0, 3.0, 2.5), (58.0, 3.1, 2.5)])
                edit.lead("ST 9", [(45.0, 3.3, 2.8)])
            print("led", hull.fingerprint)
chance = random.Random(seed)
if seed % 2:
    carrier = import_module("assoc_hull.shipped.bulk_carrier_207k").bulk_carrier_207k_adopted
    print("carrier", fingerprint(carrier()[0]))
else:
    print("whole", fingerprint(series60.series60(0.70)))
"""


COUNT = 4 if LONG else 2
"""Processes; half of them shuffle one ship, half the other."""

TURNS = 2 if LONG else 1
"""Shuffles of the small net in each."""


@pytest.fixture(scope="module")
def printed() -> list[list[str]]:
    """Processes with hash seeds of their own, in each some shuffled nets."""
    running = [
        subprocess.Popen(
            [sys.executable, "-c", SHUFFLES, str(seed), str(TURNS)],
            env={**os.environ, "PYTHONHASHSEED": str(seed)},
            stdout=subprocess.PIPE,
            text=True,
        )
        for seed in range(1, COUNT + 1)
    ]
    return [process.communicate(timeout=300)[0].splitlines() for process in running]


def marks(printed: list[list[str]], name: str, count: int) -> set[str]:
    """Give the fingerprints that were printed for a net, once each, of so many shuffles."""
    found = [line.split()[1] for lines in printed for line in lines if line.startswith(f"{name} ")]
    assert len(found) == count
    return set(found)


def test_all_shuffles_of_a_small_net_give_the_fingerprint_of_the_plain_order(
    printed: list[list[str]],
) -> None:
    """Ids come from content, never from a counter or a hash."""
    assert marks(printed, "wigley", COUNT * TURNS) == {ah.examples.wigley().fingerprint}


def test_leads_of_a_shuffled_net_give_one_fingerprint(printed: list[list[str]]) -> None:
    """In every process."""
    assert len(marks(printed, "led", COUNT * TURNS)) == 1


@pytest.mark.parametrize(("name", "cb"), [("series60-060", 0.60), ("series60-070", 0.70)])
def test_shuffled_ships_have_the_fingerprint_of_the_plain_order(
    printed: list[list[str]], name: str, cb: float
) -> None:
    """Each in half of the processes."""
    assert marks(printed, name, COUNT // 2) == {fingerprint(series60_adopted(cb)[0])}


def test_the_whole_net_of_series_60_does_not_depend_on_the_order(printed: list[list[str]]) -> None:
    """Lines cut from a shuffled net, in half of the processes."""
    assert marks(printed, "whole", COUNT // 2) == {ah.examples.series60().fingerprint}


def test_lines_of_several_pieces_do_not_depend_on_the_order(printed: list[list[str]]) -> None:
    """The bulk carrier from shuffled sources, in half of the processes."""
    assert marks(printed, "carrier", COUNT // 2) == {fingerprint(bulk_carrier_207k_adopted()[0])}

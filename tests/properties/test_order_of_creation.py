"""I5: the order in which groups, lines and associations are created changes nothing."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

SHUFFLES = """
import random, sys
from importlib import import_module
import assoc_hull.edit.adoption.adopt_lines as home
from assoc_hull.hull import Hull
from assoc_hull.model.definition.fingerprint import fingerprint

seed = int(sys.argv[1])
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
    for turn in range({"series60-060": seed % 2, "series60-070": 1 - seed % 2, "wigley": 2}[name]):
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


@pytest.fixture(scope="module")
def printed() -> list[list[str]]:
    """Four processes with hash seeds of their own, in each four shuffled nets."""
    running = [
        subprocess.Popen(
            [sys.executable, "-c", SHUFFLES, str(seed)],
            env={**os.environ, "PYTHONHASHSEED": str(seed)},
            stdout=subprocess.PIPE,
            text=True,
        )
        for seed in range(1, 5)
    ]
    return [process.communicate(timeout=300)[0].splitlines() for process in running]


@pytest.mark.parametrize(
    ("name", "count"), [("wigley", 8), ("led", 8), ("series60-060", 2), ("series60-070", 2)]
)
def test_all_shuffles_in_four_processes_give_one_fingerprint(
    printed: list[list[str]], name: str, count: int
) -> None:
    """Ids come from content, never from a counter or a hash."""
    found = [line for lines in printed for line in lines if line.startswith(name)]
    assert len(found) == count
    assert len(set(found)) == 1


def test_the_whole_net_of_series_60_does_not_depend_on_the_order(printed: list[list[str]]) -> None:
    """Lines cut from a shuffled net, in two processes."""
    found = [line for lines in printed for line in lines if line.startswith("whole ")]
    assert len(found) == 2
    assert len(set(found)) == 1


def test_lines_of_several_pieces_do_not_depend_on_the_order(printed: list[list[str]]) -> None:
    """The bulk carrier from shuffled sources, in two processes."""
    found = [line for lines in printed for line in lines if line.startswith("carrier ")]
    assert len(found) == 2
    assert len(set(found)) == 1

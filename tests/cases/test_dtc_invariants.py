"""What must always hold, on the DTC container ship, over seeded edits at shared crossings."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

import assoc_hull as ah
from assoc_hull.model.definition.records import definition
from assoc_hull.model.node import Node
from tests.cases.walk import walk
from tests.independent import closure, relofted, snapshot
from tests.long_forms import LONG
from tests.properties.test_i01_consistency import assert_consistent
from tests.properties.test_i02_locality import assert_local
from tests.properties.test_i03_minimality import passes, quiet
from tests.properties.test_i04_nothing_lost import assert_kept, decide, decided, naming
from tests.properties.test_i09_topology import (
    assert_orders_kept,
    assert_reported,
    assert_senses_kept,
    crossings,
    orders,
    senses,
)
from tests.properties.test_i10_both_directions import assert_both_directions
from tests.properties.test_rebuild import FINGERPRINTS, run_script

STEPS = 12
"""Accepted edits in each walk; every walk has a seed of its own."""


def test_the_ship_is_consistent_over_a_walk(dtc: ah.Hull) -> None:
    """I1: by roots found independently; adopted, amid the edits, and after them."""
    assert_consistent(dtc)
    for number, _ in enumerate(walk(dtc, 1, STEPS), 1):
        if number % 8 == 0:
            assert_consistent(dtc)


def test_an_edit_changes_only_what_it_reaches(dtc: ah.Hull) -> None:
    """I2: all else keeps its bits and its revision, on the way back too."""
    for step in walk(dtc, 2, STEPS):
        assert_local(dtc, step.before)
        assert len(step.report.relofted) < len(dtc.state.live("curves"))
        there = snapshot(dtc)
        dtc.undo()
        assert_local(dtc, there)
        dtc.redo()


def test_an_edit_lofts_only_what_it_must(dtc: ah.Hull) -> None:
    """I3: the curves of a brute-force walk of the tables, each once; a pass does nothing twice.

    In a field of several sub-steps a point may come back to its old bits: no curve that is
    lofted besides has then changed.
    """
    with passes() as heard:
        for step in walk(dtc, 3, STEPS):
            report, wanted = step.report, relofted(step.before, dtc)
            assert len(set(report.relofted)) == len(report.relofted)
            assert wanted <= set(report.relofted)
            assert all(len(np.unique(each.evaluated)) == len(each.evaluated) for each in heard)
            if quiet(report):
                besides, now = set(report.relofted) - wanted, snapshot(dtc).curves
                assert len(heard) > 1 or not besides
                assert all(now[key] == step.before.curves[key] for key in besides)
                seeds = dtc.document.history[-1].seeds.tolist()
                moved = {dtc.state.rows.key[Node.number(node)] for node in seeds}
                assert wanted <= closure(dtc, moved)
            heard.clear()


def test_what_was_decided_stays(dtc: ah.Hull) -> None:
    """I4: placed points, kinds, ends, names, and roles, that no edit names."""
    decide(dtc)
    before = decided(dtc)
    assert before.points
    assert before.overrides
    with naming() as named:
        for _ in walk(dtc, 4, STEPS):
            assert_kept(before, dtc, named)
    dtc.undo()


ANEW = """
import random, sys
from pathlib import Path
import assoc_hull.io.slicing.net as net
from tests.cases.dtc import read_dtc
from tests.cases.walk import walk

plain, chance = net.adopt, random.Random(5)

def shuffled(sources, particulars, associations, tolerances, grown):
    order, associations = list(range(len(sources))), list(associations)
    chance.shuffle(order)
    chance.shuffle(associations)
    sources = [sources[i] for i in order]
    grown = None if grown is None else [grown[i] for i in order]
    return plain(sources, particulars, associations, tolerances, grown)

net.adopt = shuffled
hull = read_dtc(Path(sys.stdin.readline().strip()))
print(hull.fingerprint, *(hull.fingerprint for _ in walk(hull, 5, 8)))
"""


if LONG:  # Series 60 does it always

    def test_another_process_comes_to_the_same_bits(dtc: ah.Hull, data_folder: Path) -> None:
        """I5: read anew with another hash seed, lines in another order, and edited."""
        found = [dtc.fingerprint, *(dtc.fingerprint for _ in walk(dtc, 5, 8))]
        assert run_script(ANEW, f"{data_folder.resolve()}\n", "4711") == found


def test_the_definition_alone_gives_the_edited_ship(dtc: ah.Hull) -> None:
    """I6: rebuilt beside it amid the walk, and at its end in a process that never saw the edits."""
    for number, _ in enumerate(walk(dtc, 6, STEPS), 1):
        if number % 4 == 0:
            assert dtc.verify() == ()
        if number == STEPS:
            text = json.dumps(definition(dtc.state))
            assert run_script(FINGERPRINTS, text) == [dtc.fingerprint]


def test_undo_and_redo_are_exact(dtc: ah.Hull, tmp_path: Path) -> None:
    """I7: every state on the way back and forth, and after it was saved and opened."""
    marks = [dtc.fingerprint]
    for number, _ in enumerate(walk(dtc, 7, STEPS), 1):
        marks.append(dtc.fingerprint)
        if number < STEPS:
            continue
        for mark in reversed(marks[:-1]):
            dtc.undo()
            assert dtc.fingerprint == mark
        for mark in marks[1:]:
            dtc.redo()
            assert dtc.fingerprint == mark
        dtc.save(tmp_path / "dtc.hull.json")
        assert ah.open(tmp_path / "dtc.hull.json").fingerprint == marks[-1]
    assert dtc.fingerprint == marks[0]


def test_no_crossing_is_taken_for_another(dtc: ah.Hull) -> None:
    """I9: what comes and goes is reported; the rest keep their sense and their order."""
    ever, born, before = crossings(dtc), senses(dtc), orders(dtc)
    there = set(ever)
    for number, step in enumerate(walk(dtc, 9, STEPS), 1):
        assert_reported(there, ever, dtc, step.report)
        there = crossings(dtc)
        ever |= there
        assert_orders_kept(before, dtc)
        before = orders(dtc)
        if number % 12 == 0:
            assert_senses_kept(dtc, born)


def test_both_directions_come_to_the_same_bits(dtc: ah.Hull) -> None:
    """I10: through either handle, in either order, with the start visited in between."""
    assert_both_directions(dtc, 12, 10)

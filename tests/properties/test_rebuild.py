"""I5, I6 and I7: the definition says it all, order says nothing, undo and redo are exact."""

from __future__ import annotations

import json
import os
import random
import subprocess
import sys
from pathlib import Path
from unittest import mock

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assoc_hull.edit.document import Document
from assoc_hull.edit.program_edit import ProgramEdit
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import RefusedEditError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.run_update import Readers
from assoc_hull.io.hull_json import dumps_hull_json, read_hull_json
from assoc_hull.model.definition.canonical_columns import canonical_order, point_columns
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.records import definition
from assoc_hull.model.definition.restore import from_definition, verify
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState
from tests.long_forms import draws
from tests.strategies import (
    Move,
    Net,
    PinnedEdit,
    apply_edit,
    documents,
    make_document,
    movable,
    nets,
    pinned_edits,
    wigley_sources,
)

REPOSITORY = Path(__file__).resolve().parents[2]

# What another process does with definitions: make hulls of them, and name their content.
FINGERPRINTS = """
import json, sys
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.restore import from_definition
for line in sys.stdin:
    print(fingerprint(from_definition(json.loads(line))))
"""
EDITED = """
from assoc_hull.model.definition.fingerprint import fingerprint
from tests.strategies import Move, PinnedEdit, apply_edit, make_document, wigley_sources
document = make_document(wigley_sources(5, 3, 2))
for which in range(0, 60, 7):
    apply_edit(document, PinnedEdit((Move(which, 0.01), Move(which + 3, -0.02)), False))
print(fingerprint(document.state))
"""


def run_script(script: str, text: str = "", seed: str = "random") -> list[str]:
    """What a script prints in a process of its own."""
    found = subprocess.run(
        [sys.executable, "-c", script],
        input=text,
        env={**os.environ, "PYTHONPATH": str(REPOSITORY), "PYTHONHASHSEED": seed},
        capture_output=True,
        text=True,
        check=True,
    )
    return found.stdout.split()


def edited_document(seed: int) -> Document:
    """A small Wigley net after some edits."""
    document = make_document(wigley_sources(5, 3, seed % 3))
    rng = random.Random(seed)
    for _ in range(5):
        moves = tuple(Move(rng.randrange(1000), rng.uniform(-0.03, 0.03)) for _ in range(3))
        apply_edit(document, PinnedEdit(moves, False))
    return document


@settings(max_examples=draws(25))
@given(documents(), pinned_edits())
def test_the_definition_alone_gives_the_edited_hull(
    document: Document, edits: list[PinnedEdit]
) -> None:
    """I6: after any edits a rebuild from the definition has the bits of the edited hull."""
    assert verify(document.state) == []
    for edit in edits:
        apply_edit(document, edit)
        assert verify(document.state) == []
    whole = json.loads(json.dumps(definition(document.state)))
    assert fingerprint(from_definition(whole)) == fingerprint(document.state)


@settings(max_examples=draws(15))
@given(documents(), pinned_edits(largest=2.0, moves=2))
def test_rough_edits_leave_nothing_that_the_definition_does_not_give(
    document: Document, edits: list[PinnedEdit]
) -> None:
    """I6: also where edits of metres bear crossings, mend gaps, or are refused."""
    for edit in edits:
        before = fingerprint(document.state)
        if not apply_edit(document, edit):
            assert fingerprint(document.state) == before
        assert verify(document.state) == []


def test_a_process_that_never_saw_the_edits_gives_the_same_hull() -> None:
    """I6: the definition, read in another process, gives the fingerprint of this one."""
    states = [edited_document(seed).state for seed in range(4)]
    text = "\n".join(json.dumps(definition(state)) for state in states)
    assert run_script(FINGERPRINTS, text) == [fingerprint(state) for state in states]


@pytest.mark.parametrize("seed", ["0", "1", "4711"])
def test_the_hash_seed_plays_no_part(seed: str) -> None:
    """I5: the same net and edits give the same fingerprint under every hash seed."""
    document = make_document(wigley_sources(5, 3, 2))
    for which in range(0, 60, 7):
        apply_edit(document, PinnedEdit((Move(which, 0.01), Move(which + 3, -0.02)), False))
    assert run_script(EDITED, seed=seed) == [fingerprint(document.state)]


@settings(max_examples=draws(20))
@given(nets(), st.randoms(use_true_random=False), pinned_edits(most=3))
def test_the_order_of_lines_and_associations_plays_no_part(
    net: Net, rng: random.Random, edits: list[PinnedEdit]
) -> None:
    """I5: lines and associations handed over in any order give one hull, edits included."""
    sources, links = list(net.sources), list(net.associations)
    rng.shuffle(sources)
    rng.shuffle(links)
    shuffled = attrs.evolve(net, sources=tuple(sources), associations=tuple(links))
    one, other = make_document(net), make_document(shuffled)
    assert fingerprint(one.state) == fingerprint(other.state)
    for edit in edits:
        assert apply_edit(one, edit) == apply_edit(other, edit)
        assert fingerprint(one.state) == fingerprint(other.state)


@settings(max_examples=draws(20))
@given(documents(), pinned_edits())
def test_undo_and_redo_give_the_old_fingerprints(
    document: Document, edits: list[PinnedEdit]
) -> None:
    """I7: every state on the way back and forth has the fingerprint it had before."""
    prints = [fingerprint(document.state)]
    prints += [fingerprint(document.state) for edit in edits if apply_edit(document, edit)]
    for old in reversed(prints[:-1]):
        document.undo()
        assert fingerprint(document.state) == old
    for new in prints[1:]:
        document.redo()
        assert fingerprint(document.state) == new
    if prints[1:]:
        document.undo(len(prints) - 1)
        assert fingerprint(document.state) == prints[0]
        assert verify(document.state) == []


@settings(max_examples=draws(15))
@given(documents(), pinned_edits(largest=1.0, most=4))
def test_a_hull_that_was_saved_and_opened_goes_on_as_before(
    document: Document, edits: list[PinnedEdit]
) -> None:
    """I7: an edit has the same outcome, to the last bit, with and without a save before it."""
    for edit in edits:
        opened = Document(read_hull_json(dumps_hull_json(document.state)))
        assert apply_edit(document, edit) == apply_edit(opened, edit)
        assert fingerprint(opened.state) == fingerprint(document.state)


@attrs.define
class Edge:
    """A link of the network whose push is lost; not `alone`: every link into its reader."""

    source: int
    reader: int
    alone: bool = True
    lost: int = 0

    def readers(self, network: HullNetwork, nodes: IntArray) -> Readers:
        """All readers but this one."""
        found = ORIGINAL_READERS(network, nodes)
        keep = found.reader != self.reader
        if self.alone:
            keep |= found.source != self.source
        self.lost += int((~keep).sum())
        return Readers(found.reader[keep], found.source[keep])


ORIGINAL_READERS = HullNetwork.readers


def all_edges(document: Document) -> list[tuple[int, int]]:
    """Every (source, reader) of the network."""
    state = document.state
    nodes = np.concatenate([Node.point(state.live("rows")), Node.curve(state.live("curves"))])
    found = HullNetwork(state, document.index).readers(nodes)
    return sorted(set(zip(found.source.tolist(), found.reader.tolist(), strict=True)))


def nudge(document: Document, row: int, axis: int) -> bool:
    """Move one point by a centimetre along an axis; False if that is refused."""
    value = document.state.rows.xyz[row] + 0.01 * np.eye(3)[axis]
    try:
        with Transaction(document, "nudge", Settings(refuse_gaps=False)) as edit:
            edit.write(np.array([row]), value[None], "nudge")
    except RefusedEditError:
        return False
    return True


def nudges(state: HullState) -> list[tuple[int, int]]:
    """Every point that has a value of its own, with each axis in the planes of its curves."""
    order = canonical_order(state)
    stored = np.asarray(point_columns(state, order)["stored"])
    found = []
    for row in order.rows[stored].tolist():
        lines = [state.line_of(c) for c in state.rows.curve[row].tolist() if c >= 0]
        free = (state.lines.normal[lines] == 0.0).all(axis=0)
        found += [(row, axis) for axis in np.flatnonzero(free).tolist()]
    return found


def edits_that_pass(document: Document) -> dict[tuple[int, int], tuple[bool, tuple[int, int]]]:
    """For each edge, an edit in which its reader changes because of its source.

    And whether because of this source alone: some readers, an adopted point between two
    computed ones for instance, are always evaluated for another one too.
    """
    found = dict[tuple[int, int], tuple[bool, tuple[int, int]]]()
    for row, axis in nudges(document.state):
        if not nudge(document, row, axis):
            continue
        step = document.history[-1]
        pairs = set(zip(step.cause.source.tolist(), step.cause.reader.tolist(), strict=True))
        changed = set(step.changed.tolist())
        readers = [reader for _, reader in pairs]
        for pair in pairs:
            alone = readers.count(pair[1]) == 1
            if set(pair) <= changed and alone >= found.get(pair, (False,))[0]:
                found[pair] = (alone, (row, axis))
        document.undo()
    return found


def caught(document: Document, edge: Edge, edit: tuple[int, int]) -> bool:
    """Whether `verify` sees that a push was lost; the hull is as before afterwards."""
    with mock.patch.object(
        HullNetwork, "readers", lambda network, nodes: edge.readers(network, nodes)
    ):
        done = nudge(document, *edit)
    assert edge.lost
    assert done
    differences = verify(document.state)
    document.undo()
    return bool(differences)


@pytest.mark.parametrize(
    "net",
    [
        pytest.param(wigley_sources(4, 3, 1), id="two-way"),
        pytest.param(
            attrs.evolve(
                wigley_sources(4, 3, 1),
                associations=tuple(
                    attrs.evolve(link, two_way=link.a == "boundary")
                    for link in wigley_sources(4, 3, 1).associations
                ),
            ),
            id="one-way",
        ),
    ],
)
def test_every_lost_dependency_is_seen(net: Net, capsys: pytest.CaptureFixture[str]) -> None:
    """I6: dropping any link of the network, one at a time, makes `verify` report it.

    Where a reader is always evaluated for another one too, all links into it are dropped.
    """
    document = make_document(net)
    before = fingerprint(document.state)
    with mock.patch.object(ProgramEdit, "of", return_value=None):
        edges, edits = all_edges(document), edits_that_pass(document)
        dropped = [edge for edge in edges if edge in edits]
        seen = [caught(document, Edge(*edge, edits[edge][0]), edits[edge][1]) for edge in dropped]
    assert fingerprint(document.state) == before
    with capsys.disabled():
        print(f"\n{len(edges)} links, {len(dropped)} dropped, {sum(seen)} caught")
    assert all(seen)
    assert len(dropped) >= 0.95 * len(edges)


def test_verify_sees_every_number_that_is_tampered_with() -> None:
    """Any derived number that is off by one bit is reported with its object and amount."""
    state = from_definition(definition(edited_document(2).state))
    curve = int(state.live("curves")[3])
    spline = state.spline(curve)
    leave = spline.leave.copy()
    leave[2, 1] = np.nextafter(leave[2, 1], 9.0)
    state.curves.spline.store[curve] = attrs.evolve(spline, leave=leave)
    found = verify(state)
    assert [(each.key, each.field) for each in found] == [(state.curves.key[curve], "spline.leave")]
    assert 0.0 < found[0].amount < 1e-15
    assert verify(state, relative=1e-12) == []


def test_verify_reports_a_lost_driver() -> None:
    """A link that does not follow from the role of its point is a difference."""
    state: HullState = edited_document(1).state
    row = movable(state)[0]
    state.rows.reader.store[row, 0] = -1
    assert any(each.field == "reader" for each in verify(state))

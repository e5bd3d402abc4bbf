"""A nudge: points move by a little that is known, the structure of the hull stays."""

from __future__ import annotations

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.carried_net import Nudge, nudge, nudged
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, RefusedEditError
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.tables import copy_state
from assoc_hull.variation.aiming.hull_problem import HullProblem
from assoc_hull.variation.carrying.carry_hull import carry_out
from tests.aims import FULLER, SHIFTED, problem, small


def by_field(hull: ah.Hull) -> Nudge:
    """Let a hull be wider by a tenth of a per cent."""
    state = hull.state
    move = state.rows.xyz.data * [0.0, 1e-3, 0.0]
    normal = np.where(state.lines.planar[:, None], state.lines.normal.data, 0.0)
    level = np.nan_to_num(state.lines.offset.data) * 1e-3 * normal[:, 1]
    turn = np.zeros((state.rows.count, 3, 3))
    size = attrs.evolve(state.particulars, breadth=1.001 * state.particulars.breadth)
    return Nudge(move, turn, level, {}, size, 1e-3)


def make(hull: ah.Hull, by: Nudge) -> None:
    """Nudge a hull in place."""
    with Transaction(hull.document, "nudge") as edit:
        nudge(edit, by)


def test_everything_follows_and_undo_takes_it_back() -> None:
    """A nudge by a ratio is the ratio: of points, planes, volume, breadth; undo is one step."""
    hull, parent = small(), small()
    make(hull, by_field(hull))
    wider = parent.state.rows.xyz.data * [1.0, 1.001, 1.0]
    assert hull.state.rows.xyz.data == pytest.approx(wider, abs=1e-12)
    assert hull.particulars.breadth == pytest.approx(10.01)
    volume, before = (each.hydrostatics().volume for each in (hull, parent))
    # between points curves are by their chords, which a ratio of breadths changes
    assert volume == pytest.approx(1.001 * before, rel=1e-6)
    assert hull.check() == ()
    hull.undo()
    assert hull.fingerprint == parent.fingerprint


def test_nothing_to_move_is_no_step() -> None:
    """A nudge by nothing changes no bit."""
    hull = small()
    before, by = hull.fingerprint, by_field(hull)
    move, turn, level = (np.zeros_like(each) for each in (by.move, by.turn, by.level))
    make(hull, Nudge(move, turn, level, {}, hull.particulars, 1e-3))
    assert hull.fingerprint == before


def test_a_nudge_beside_other_modifications_is_refused() -> None:
    """It says where all points go: nothing else may move them in the same edit."""
    hull = small()
    before = hull.fingerprint
    rows = np.array([nudged(hull.state)[0]])
    edit = Transaction(hull.document, "both")
    with edit:
        edit.write(rows, hull.state.rows.xyz[rows], "a test")
        with pytest.raises(BadInputError, match="another modification in one edit"):
            nudge(edit, by_field(hull))
    assert hull.fingerprint == before


def test_a_nudge_of_another_hull_is_refused() -> None:
    """Displacements go by rows: those of other tables mean nothing."""
    hull = small()
    by = by_field(ah.examples.wigley())
    with pytest.raises((BadInputError, RefusedEditError), match=r"a nudge of \d+ points"):
        make(hull, by)


@pytest.fixture(scope="module")
def carried() -> HullProblem:
    """A small hull that was carried, whose points are nudged."""
    return problem(small(), ["volume"], ["breadth", SHIFTED, FULLER])


AT, NEAR = np.array([0.2, 0.5, 0.3]), np.array([0.204, 0.49, 0.31])


def test_a_carry_with_a_nudge_is_both_after_one_another_to_the_bit(carried: HullProblem) -> None:
    """A hull that was found by nudging is published in one step."""
    base = carried._carried(AT)
    by = base.nudge_to(NEAR)
    found = carried._nudged(base, NEAR)
    assert by is not None
    assert found is not None
    maps, room = carried.maps, carried.maps.room
    once = ah.Hull(copy_state(maps.state))
    carry_out(once.document, maps.map(AT), room.parent, maps.ask, room.present, maps.values(AT), by)
    assert once.fingerprint == ah.Hull(found.state).fingerprint
    once.undo()
    assert once.fingerprint == ah.Hull(maps.state).fingerprint


def test_a_nudged_hull_is_the_carried_one_to_second_order(carried: HullProblem) -> None:
    """Half the nudge leaves a quarter of what it differs by from a hull carried in full."""
    base, off = carried._carried(AT), []
    for part in (1.0, 0.5):
        there = AT + part * (NEAR - AT)
        found = carried._nudged(base, there)
        assert found is not None
        rows = nudged(found.state)
        away = found.state.rows.xyz.data - carried._carried(there).state.rows.xyz.data
        off.append(float(np.abs(away[rows]).max()))
    assert off[0] < 1e-4
    assert off[1] < 0.3 * off[0]


def test_a_round_end_stays_round(bulk_carrier: ah.Hull) -> None:
    """Moved by less than 1 mm the bossing end lies within 1e-6 m of a circle, at all places."""
    hulls = problem(bulk_carrier, ["volume"], ["shaft_height", "bossing_radius"])
    hulls.at(np.array([0.3, 0.05]))
    found = hulls.at(np.array([0.3006, 0.0504]))
    assert (hulls.carries, hulls.nudges) == (1, 1)
    (end,) = (each for each in found.state.features if each.name == "bossing end")
    assert end.radius == pytest.approx(0.7754, abs=1e-6)
    assert end.centre == pytest.approx((6.0, 0.0, 5.3006), abs=1e-6)
    line = ah.Hull(found.state).lines["bossing end"]
    _, xyz = sample(line.curves[0].spline, 8)
    away = np.sqrt(((xyz - np.array(end.centre)) ** 2).sum(axis=1))
    assert np.abs(away - float(end.radius or 0.0)).max() <= 1e-6

"""A check names every defect that is planted, and finds none in a sound hull."""

import attrs
import numpy as np
import pytest

from assoc_hull.edit.checks import hull_findings as check_hull
from assoc_hull.edit.checks.finding import Finding
from assoc_hull.edit.checks.hull_findings import check
from assoc_hull.edit.document import Document
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.graph.journal import Journal
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.tables import HullState
from tests.unit.edit.planted_defects import POINT, curve_of, every_defect, planted, row_of, sound


@pytest.fixture
def state() -> HullState:
    """A hull of its own, to be spoilt."""
    return sound()


@every_defect
def test_a_planted_defect_is_named(state: HullState, name: str) -> None:
    """Kind and object are told, in words too, each with what to do; notes stumble over none.

    The hull can be opened: what is derived from its tables waits until it is needed.
    """
    defect = planted(name, state)
    found = check(Document(state).state, notes=True)
    mine = [each for each in found if each.kind == defect.kind]
    assert any(defect.object in each.object for each in mine), found
    for each in found:
        assert ":" in each.message or ";" in each.message, each
        assert str(each).startswith(f"{each.kind}: {each.object}")


def test_a_sound_hull_has_no_findings(state: HullState) -> None:
    """Neither when made nor after an edit."""
    document = Document(state)
    assert check(document.state) == ()
    row = row_of(state)
    with Transaction(document, "move") as edit:
        edit.write(np.array([row]), state.rows.xyz[[row]] + [[0.0, 0.01, 0.0]], "move")
    assert check(document.state) == ()


def test_a_fold_is_named_with_its_place(state: HullState) -> None:
    """A spline whose tangent turns back; sharp knuckles on purpose are none."""
    place = state.spline(curve_of(state)).xyz[5]
    planted("a fold", state)
    folds = [each for each in check(state) if each.kind == "fold"]
    assert [each.object for each in folds] == ["WL 2.5"]
    assert folds[0].place == pytest.approx(place)
    assert folds[0].amount is not None
    assert folds[0].amount < 0.0


def test_a_loop_is_named_with_its_place_and_width(state: HullState) -> None:
    """The curve crosses itself where the finding says; no other curve of the hull does."""
    planted("a loop", state)
    (found,) = [each for each in check(state) if each.kind == "loop"]
    assert found.object == "WL 2.5"
    assert found.place is not None
    assert found.amount is not None
    curve = curve_of(state)
    places = sample(state.spline(curve), 400)[1]
    away = np.linalg.norm(places - found.place, axis=1)
    near = np.flatnonzero(away < 0.05 * found.amount)
    assert (np.diff(near) > 1).sum() == 1  # it passes there twice
    assert away[near[0] : near[-1]].max() == pytest.approx(found.amount, rel=0.1)


def test_damage_does_not_hide_other_findings(state: HullState) -> None:
    """A reference that leads nowhere, and a fold elsewhere: both are told."""
    planted("a meeting that is nothing", state)
    curve = curve_of(state, "WL 5")
    spline = state.spline(curve)
    turned = np.concatenate([spline.leave[:5], -spline.leave[5:6], spline.leave[6:]])
    Journal().set(state.curves.spline, [curve], [attrs.evolve(spline, leave=turned)])
    kinds = {(each.kind, each.object) for each in check(state)}
    assert {("tables", "waterlines:2.500000/1"), ("fold", "WL 5")} <= kinds


def test_a_look_that_stumbles_over_a_sound_hull_is_a_fault(
    state: HullState, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is raised, not told as a finding: only damage told before excuses it."""

    def stumble(*_: object) -> list[Finding]:
        raise IndexError("a fault of the program")

    monkeypatch.setattr(check_hull, "_LOOKS", (stumble,))
    with pytest.raises(IndexError, match="a fault"):
        check(state)
    planted("a meeting that is nothing", state)
    assert [each.object for each in check(state)] == ["waterlines:2.500000/1", "stumble"]


def test_lengths_are_given_in_metres(state: HullState) -> None:
    """The amount is the number the message tells."""
    planted("a gap", state)
    finding = next(each for each in check(state) if each.kind == "gap")
    assert finding.amount is not None
    assert finding.amount == pytest.approx(state.rows.gap[row_of(state)])
    assert finding.amount > 0.0
    limit = state.rows.limit[row_of(state)]
    assert f"pass {1e3 * finding.amount:.2f} mm apart" in finding.message
    assert f"limit of {1e3 * limit:.2f} mm" in finding.message


def test_notes_tell_roles_the_rule_would_not_choose(state: HullState) -> None:
    """A crossing crowded by a placed point is noted, and is no finding."""
    curve, maker = curve_of(state), Maker(state, Journal())
    rows = state.curves.rows[curve]
    at = int(np.flatnonzero(rows == row_of(state))[0])
    place = state.spline(curve)
    middle = state.rows.xyz[rows[at]] + 0.02 * (place.xyz[at + 1] - place.xyz[at])
    maker.define(
        curve, np.insert(rows, at + 1, maker.points([PointSpec(curve, middle, Sort.PLACED)])[0])
    )
    assert not any(each.kind == "role" for each in check(state))
    notes = [each for each in check(state, notes=True) if each.kind == "role"]
    assert [each.object for each in notes] == [POINT]


def test_findings_come_in_one_order(state: HullState) -> None:
    """Two checks of one hull are equal."""
    planted("a broken association: one-way, and shared", state)
    first: tuple[Finding, ...] = check(state)
    assert first == check(state)
    assert len(first) == 36

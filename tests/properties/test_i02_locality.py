"""I2: what no moved crossing reaches keeps its bits and its revision."""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import given, settings

import assoc_hull as ah
from assoc_hull.edit.displacement_field import FieldContext, PointDisplacements
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.tables import HullState
from tests.cases import places
from tests.independent import Snapshot, relofted, snapshot
from tests.long_forms import draws
from tests.net_strategies import (
    SHAPES,
    STRUCTURE,
    Task,
    carry_out,
    fresh,
    hulls,
    live_points,
    tasks,
)


def assert_local(hull: ah.Hull, before: Snapshot, published: bool = True) -> None:
    """Curves without a changed input keep bits and revision; revisions count real changes."""
    after, reached = snapshot(hull), relofted(before, hull)
    for key, bits in after.curves.items():
        same = before.curves.get(key) == bits
        assert same or key in reached, f"{key} changed and nothing it is made of did"
        if key in before.curves:
            rise = after.curve_revisions[key] - before.curve_revisions[key]
            assert rise == int(published and not same), f"{key} rose by {rise}"
    for key, bits in after.points.items():
        if key in before.points:
            rise = after.point_revisions[key] - before.point_revisions[key]
            assert rise == int(published and before.points[key] != bits), f"{key} rose by {rise}"


@settings(max_examples=draws(25))
@given(hulls(), tasks((*SHAPES, *STRUCTURE)))
def test_an_edit_changes_only_what_it_reaches(hull: ah.Hull, edits: list[Task]) -> None:
    """Bits and revisions, over random edits of every kind, and on the way back by undo."""
    for task in edits:
        before = snapshot(hull)
        if carry_out(hull, task) is None:
            assert snapshot(hull).curve_revisions == before.curve_revisions
            continue
        assert_local(hull, before)
        there = snapshot(hull)
        hull.undo()
        assert_local(hull, there)
        hull.redo()


@settings(max_examples=draws(15))
@given(hulls(), tasks(("move",), most=3))
def test_a_preview_touches_nothing(hull: ah.Hull, edits: list[Task]) -> None:
    """Neither bits nor revisions."""
    before = snapshot(hull)
    for task in edits:
        points = [each for each in live_points(hull, "crossing") if each.free]
        point = points[task.acts[0].which % len(points)]
        change = {axis: getattr(point, axis) + task.acts[0].amount for axis in point.free}
        try:
            hull.preview([{"op": "move", "point": point, **change}])
        except ah.AssocHullError:
            continue
        assert_local(hull, before, published=False)


def test_writing_the_value_that_is_there_changes_nothing() -> None:
    """No bit, no revision, no curve lofted."""
    hull = fresh(2)
    before = snapshot(hull)
    point = next(p for p in live_points(hull, "crossing") if p.crossing_role == "shared" and p.free)
    with hull.edit("nothing") as edit:
        edit.move(point, lead=False, **{axis: getattr(point, axis) for axis in point.free})
    assert edit.report is not None
    assert edit.report.relofted == ()
    assert_local(hull, before)


@attrs.define(eq=False)
class Swing:
    """A field that moves a point away in its first sub-step, and back to the bit in its last."""

    row: int
    place: FloatArray
    across_flats: bool = False
    calls: int = 0
    strict: bool = False

    def shift(self, ground: FieldContext, part: float) -> PointDisplacements:
        """15 cm when asked for the whole, so that there are sub-steps; then 20 mm."""
        self.calls += 1
        away = {1: 0.15, 2: 0.02, 3: -0.02}[self.calls]
        return PointDisplacements(
            np.array([self.row]), np.array([[0.0, away, 0.0]]), np.zeros(0, np.int64)
        )

    def exact(self) -> tuple[IntArray, FloatArray]:
        """Where it lay."""
        return np.array([self.row]), self.place[None]

    def left(self, state: HullState, done: float) -> float:
        """As much as was not done."""
        return 1.0 - done


@pytest.mark.parametrize("number", [0, 2, 4])
def test_what_goes_away_and_comes_back_in_one_edit_has_not_changed(number: int) -> None:
    """Each sub-step passes on what differs from the one before; revisions tell the net change."""
    hull = fresh(number)
    before, start = snapshot(hull), hull.fingerprint
    point = next(
        each
        for each in live_points(hull, "crossing")
        if each.crossing_role == "shared" and each.free == ("y",) and each.y > 0.5
    )
    with Transaction(hull.document, "swing") as transaction:
        transaction.pending.ask(FieldMoves).fields.append(Swing(point.row, point.position.copy()))
    assert transaction.report is not None
    assert len(transaction.report.relofted) >= 2
    assert hull.fingerprint == start
    assert hull.verify() == ()
    assert_local(hull, before)
    assert not len(hull.document.history[-1].curves)


@pytest.mark.parametrize("family", ["waterlines", "buttocks", "sections"])
def test_a_drag_on_series_60_is_local(series60_70: ah.Hull, family: str) -> None:
    """Of some 77 curves most keep their bits and revisions."""
    hull, before = series60_70, snapshot(series60_70)
    pairs = tuple(pair for pair in places.PAIRS if family in pair)
    for row in places.places(hull, pairs, 2, 5):
        before = snapshot(hull)
        try:
            with hull.edit("drag") as edit:
                places.drag(hull, 0.003)(edit, row)
        except ah.errors.RefusedEditError:
            continue
        assert_local(hull, before)
        assert len(relofted(before, hull)) < len(hull.lines) / 2
        hull.undo()

"""I2: what no moved crossing reaches keeps its bits and its revision."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

import assoc_hull as ah
from tests.cases import series60_places as places
from tests.independent import Snapshot, relofted, snapshot
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


@settings(max_examples=25)
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


@settings(max_examples=15)
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
        edit.move(point, **{axis: getattr(point, axis) for axis in point.free})
    assert edit.report is not None
    assert edit.report.relofted == ()
    assert_local(hull, before)


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
        except ah.RefusedEditError:
            continue
        assert_local(hull, before)
        assert len(relofted(before, hull)) < len(hull.lines) / 2
        hull.undo()

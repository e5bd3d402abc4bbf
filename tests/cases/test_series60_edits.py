"""Edits on Series 60 CB .70 at seeded places of all three pairs of families: one table."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.model.objects import Point
from tests.cases import places
from tests.long_forms import LONG

PLACES = 24
STRICT = 8
SEED = 1
SEEDS = (1, 2, 3) if LONG else (1,)


def _pairs(name: str) -> tuple[tuple[str, str], ...]:
    return tuple(pair for pair in places.PAIRS if name in pair)


def _cases(hull: ah.Hull) -> list[tuple[str, places.Act, tuple[tuple[str, str], ...]]]:
    cases: list[tuple[str, places.Act, tuple[tuple[str, str], ...]]] = [
        ("drag 5 mm", places.drag(hull, 0.005), places.PAIRS),
        ("drag 20 mm", places.drag(hull, 0.020), places.PAIRS),
        ("pull 20 mm, 20 x 8 m", places.pull(hull, 0.020), places.PAIRS),
        ("pull 50 mm, 20 x 8 m", places.pull(hull, 0.050), places.PAIRS),
    ]
    for name in ("waterlines", "buttocks", "sections"):
        act = places.reshape(hull, name, 0.050)
        cases.append((f"re-shape {name} 50 mm", act, _pairs(name)))
    return cases


@pytest.fixture(scope="module", params=SEEDS)
def table(request: pytest.FixtureRequest, series60_70: ah.Hull) -> list[places.Row]:
    """Run every kind of edit at its places."""
    before = series60_70.fingerprint
    rows = []
    for kind, act, pairs in _cases(series60_70):
        at = places.places(series60_70, pairs, PLACES, request.param)
        rows.append(places.run(series60_70, kind, act, at))
    assert series60_70.fingerprint == before
    print(places.table(rows))
    return rows


def test_at_least_22_of_24_edits_of_each_kind_are_accepted(table: list[places.Row]) -> None:
    """Shared crossings of all three pairs, ends of the ship and the bilge among them."""
    assert {row.kind: row.accepted for row in table if row.accepted < 22} == {}
    assert all(row.places == PLACES for row in table)


def test_no_accepted_edit_leaves_a_gap_over_its_limit(table: list[places.Row]) -> None:
    """The limit of a watched gap is 10 mm here: twice the adoption tolerance."""
    assert max(row.largest_gap for row in table) <= 0.010
    assert [row.kind for row in table if row.wide] == []


def test_fields_add_at_most_5_inflections_in_the_mean(table: list[places.Row]) -> None:
    """Pulls and re-shapes; lobes of 0.2 degrees and more."""
    fields = [row for row in table if not row.kind.startswith("drag")]
    assert {row.kind: row.inflections for row in fields if row.inflections > 5.0} == {}


def test_a_drag_puts_its_point_where_it_was_asked(series60_70: ah.Hull) -> None:
    """To 1e-9 m, through the handle on either curve."""
    row = places.places(series60_70, places.PAIRS, 3, 7)[0]
    point = Point.of(series60_70.state, row)
    target = point.y + 0.004
    with series60_70.edit("drag") as edit:
        edit.move(point.friend_point or point, y=target)
    assert abs(point.y - target) < 1e-9
    assert point.friend_point is not None
    assert np.array_equal(point.position, point.friend_point.position)
    series60_70.undo()


def test_a_pull_gives_its_normal_displacement_within_1_percent(series60_70: ah.Hull) -> None:
    """Measured along the outward normal at the pulled point."""
    for row in places.places(series60_70, places.PAIRS, 6, 3):
        normal = hull_normals(series60_70.state)[row]
        before = series60_70.state.rows.xyz[row].copy()
        with series60_70.edit("pull") as edit:
            edit.pull(Point.of(series60_70.state, row), 0.02, (20.0, 8.0))
        moved = float((series60_70.state.rows.xyz[row] - before) @ normal)
        series60_70.undo()
        assert moved == pytest.approx(0.02, rel=0.01)


def test_no_edit_folds_a_curve(table: list[places.Row]) -> None:
    """Counted on every re-lofted curve after each accepted edit."""
    assert {row.kind: row.folds for row in table} == dict.fromkeys((r.kind for r in table), 0)


@pytest.mark.parametrize("name", ["waterlines", "buttocks", "sections"])
def test_the_strict_form_is_refused_with_its_gap_and_can_be_reported(
    series60_70: ah.Hull, name: str
) -> None:
    """fade=None moves the curve alone and mends nothing: a gap over its limit is refused.

    With gaps='report' the defects stay, and check names each. Where a strict re-shape is
    accepted, no gap is over its limit and nothing was mended.
    """
    act = places.reshape(series60_70, name, 0.050, None)
    before, wide = series60_70.fingerprint, 0
    for row in places.places(series60_70, _pairs(name), STRICT, SEED):
        try:
            with series60_70.edit("strict") as edit:
                act(edit, row)
        except ah.errors.RefusedEditError as error:
            if "mm apart at" in str(error):
                wide += 1
                assert _reported(series60_70, act, row)
            continue
        assert edit.report is not None
        assert edit.report.mended == ()
        series60_70.undo()
    print(f"\nstrict re-shape of {name} by 50 mm: {wide} of {STRICT} refused for a gap")
    assert wide >= STRICT // 2
    assert series60_70.fingerprint == before


def _reported(hull: ah.Hull, act: places.Act, row: int) -> bool:
    """Keep the defects of an edit, and tell whether a check names them."""
    with hull.edit("strict", gaps="report") as edit:
        act(edit, row)
    named = any(finding.kind == "gap" for finding in hull.check())
    hull.undo()
    return named


def test_dragging_a_driven_crossing_names_its_driver(series60_70: ah.Hull) -> None:
    """And the three ways out."""
    rows = series60_70.state.rows
    driven = int(np.flatnonzero(rows.alive.data & (rows.driver.data >= 0) & ~rows.contact.data)[0])
    point = Point.of(series60_70.state, driven)
    before = series60_70.fingerprint
    with pytest.raises(ah.errors.PointRoleError) as caught, series60_70.edit("drag") as edit:
        edit.move(point, lead=False, **{axis: 0.0 for axis in point.free})
    assert point.driver is not None
    assert caught.value.driver == point.driver.line.name
    assert all(word in str(caught.value) for word in ("driver", "pull", "shared"))
    assert series60_70.fingerprint == before

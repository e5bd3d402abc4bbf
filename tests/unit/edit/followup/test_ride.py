"""Adopted points ride with their driven neighbours, there and back exactly."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

import assoc_hull as ah
from assoc_hull.model.kinds import Sort
from tests.long_forms import draws
from tests.net_strategies import SHAPES, STRUCTURE, Task, carry_out, fresh, hulls, knuckled, tasks


def unlinked(hull: ah.Hull) -> list[str]:
    """Adopted points whose links are not those to their nearest neighbours, if these are driven."""
    state, rows = hull.state, hull.state.rows
    wrong: list[str] = []
    for curve in state.live("curves").tolist():
        order = state.curves.rows[curve].tolist()
        for place, row in enumerate(order):
            if _rides(hull, row):
                sides = order[:place][::-1], order[place + 1 :]
                wanted = [_first_driven(hull, side) for side in sides]
                # What took the place of a crossing is ridden with where the crossing was.
                linked = [
                    want if each >= 0 and rows.stands_for[each] else each
                    for each, want in zip(rows.anchor[row].tolist(), wanted, strict=True)
                ]
                if linked != wanted:
                    wrong.append(rows.key[row])
    return wrong


def _rides(hull: ah.Hull, row: int) -> bool:
    """Adopted points ride; those that hold a driver in the place of a crossing stay."""
    table = hull.state.rows
    return bool(table.sort[row] == Sort.ADOPTED) and not table.stands_for[row]


def _first_driven(hull: ah.Hull, rows: list[int]) -> int:
    """The nearest point that does not ride, if it is driven; else -1."""
    table = hull.state.rows
    other = next((row for row in rows if not _rides(hull, row)), -1)
    return other if other >= 0 and table.driver[other] >= 0 else -1


@settings(max_examples=draws(25))
@given(hulls(), tasks((*SHAPES, *STRUCTURE), largest=0.1))
def test_every_adopted_point_is_linked_to_its_driven_neighbours(
    hull: ah.Hull, edits: list[Task]
) -> None:
    """After any edits, those that mended gaps among them."""
    assert unlinked(hull) == []
    for task in edits:
        carry_out(hull, task)
        assert unlinked(hull) == []


def test_points_beside_the_crossings_of_a_cut_line_are_linked_to_these(
    series60_70: ah.Hull,
) -> None:
    """A line cut from others comes between their adopted points and what these rode with."""
    assert unlinked(series60_70) == []
    with series60_70.edit("cut") as edit:
        edit.add_line("buttocks", 3.0)
    assert unlinked(series60_70) == []
    series60_70.undo()
    assert unlinked(series60_70) == []


def test_points_made_by_mending_are_linked() -> None:
    """They ride from then on."""
    hull = fresh(4)
    with hull.edit("pull", gaps="report") as edit:
        edit.pull("WL 2.305 x ST 2", 0.4, (25.0, 6.0))
    assert edit.report is not None
    assert edit.report.mended
    assert unlinked(hull) == []


@pytest.fixture
def driven() -> ah.Hull:
    """A hull whose sections drive its waterlines one way, with an adopted point between."""
    hull = ah.Hull(knuckled(5, 4, two_way=False).adopt())
    with hull.edit("insert") as edit:
        line = hull.lines["WL 2.500"].curves[0]
        point = edit.insert(line, line.at(0.42 * line.span))
    with hull.edit("unpin") as edit:
        edit.unpin(point)
    return hull


def test_a_point_between_two_driven_ones_rides_by_a_linear_blend(driven: ah.Hull) -> None:
    """With each neighbour by its part of the way; back to the bits of before."""
    start = driven.fingerprint
    point = driven.points["WL 2.500 @ adopted 1"]
    riding = [
        p
        for p in driven.points.values()
        if p.sort == "adopted" and p.container_curve.name == "WL 2.500"
    ]
    assert point in riding
    before = {p.id: p.position for p in riding}
    where = driven.points["ST 3 @ adopted 2"]
    old = where.y
    with driven.edit("move") as edit:
        edit.move(where, y=old + 0.05, z=where.z, lead=False)
    crossing = driven.points["WL 2.500 x ST 3"]
    moved = [p for p in riding if p.position.tobytes() != before[p.id].tobytes()]
    assert moved
    for each in moved:
        part = float((each.position - before[each.id])[1]) / 0.05
        assert 0.0 < part < 1.0
        assert (each.position - before[each.id])[[0, 2]].tolist() == [0.0, 0.0]
    assert crossing.y == pytest.approx(old + 0.05, abs=1e-12)
    with driven.edit("back") as edit:
        edit.move(where, y=old, z=where.z, lead=False)
    assert all(p.position.tobytes() == before[p.id].tobytes() for p in riding)
    driven.undo(2)
    assert driven.fingerprint == start


def test_a_placed_point_never_rides(driven: ah.Hull) -> None:
    """Pinned, it stays to the last bit."""
    point = next(
        p for p in driven.points.values() if p.sort == "adopted" and "WL 2.500 @" in p.name
    )
    with driven.edit("pin") as edit:
        edit.pin(point)
    before = np.array(point.position)
    where = driven.points["ST 3 @ adopted 2"]
    with driven.edit("move", gaps="report") as edit:
        edit.move(where, y=where.y + 0.05, z=where.z, lead=False)
    assert point.position.tolist() == before.tolist()

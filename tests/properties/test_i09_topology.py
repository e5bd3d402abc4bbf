"""I9: crossings that come and go are reported as such, and none is ever taken for another."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings

import assoc_hull as ah
from assoc_hull.edit.report import EditReport
from assoc_hull.model.family import Role, Sort
from assoc_hull.model.state import HullState
from tests.independent import lost_meetings, roots, trouble
from tests.net_strategies import Act, Task, carry_out, fresh, hulls, tasks

ROUGH = ("move", "pull", "reshape", "insert", "set_end")


def crossings(hull: ah.Hull) -> set[str]:
    """Keys of all live crossings."""
    rows = hull.state.rows
    live = hull.state.live("rows").tolist()
    return {rows.key.data[row] for row in live if rows.sort.data[row] == Sort.CROSSING}


def assert_reported(before: set[str], ever: set[str], hull: ah.Hull, report: EditReport) -> None:
    """The report tells all that came and went; what comes was never there before."""
    after = crossings(hull)
    assert set(report.born) - set(report.gone) == after - before
    assert set(report.gone) - set(report.born) == before - after
    assert not set(report.born) & ever


def assert_branches(hull: ah.Hull) -> None:
    """Signs are those of the curves, and the order is one order on both."""
    state = hull.state
    pairs: dict[tuple[int, int], list[int]] = {}
    for row in state.live("rows").tolist():
        a, b = state.rows.curve.data[row].tolist()
        if state.rows.sort.data[row] == Sort.CROSSING and not state.rows.contact.data[row]:
            pairs.setdefault((a, b), []).append(row)
            assert sign_at(state, row, a, b) == state.rows.sign.data[row]
    for (a, b), rows in pairs.items():
        along = [order_along(state, rows, curve, other) for curve, other in ((a, b), (b, a))]
        assert along[0] in (along[1], along[1][::-1]), [state.rows.key.data[row] for row in rows]


def sign_at(state: HullState, row: int, curve: int, other: int) -> int:
    """In which sense a curve passes the plane of another at a crossing."""
    line = state.line_of(other)
    normal = state.lines.normal.data[line]
    found = roots(state.spline(curve), normal, float(state.lines.offset.data[line]))
    place = place_on(state, row, curve)
    nearest = min(found, key=lambda each: float(np.abs(each.place - place).max()))
    return 1 if float(nearest.tangent @ normal) > 0.0 else -1


def place_on(state: HullState, row: int, curve: int) -> np.typing.NDArray[np.float64]:
    """Where a crossing lies on one of its curves."""
    side = int(state.rows.curve.data[row, 0] != curve)
    watched = state.rows.role.data[row] == Role.WATCHED
    return np.array(state.rows.spot.data[row, side] if watched else state.rows.xyz.data[row])


def order_along(state: HullState, rows: list[int], curve: int, other: int) -> list[int]:
    """Give crossings of one pair of curves in order along one of them."""
    line = state.line_of(other)
    plane = state.lines.normal.data[line], float(state.lines.offset.data[line])
    places = [root.place for root in roots(state.spline(curve), *plane)]

    def at(row: int) -> int:
        return int(np.argmin([np.abs(each - place_on(state, row, curve)).max() for each in places]))

    return sorted(rows, key=at)


@settings(max_examples=25)
@given(hulls(), tasks(ROUGH, largest=0.8, most=4))
def test_births_and_deaths_are_reported_and_ids_never_come_back(
    hull: ah.Hull, edits: list[Task]
) -> None:
    """Over rough edits; undo brings the very crossings back that were there."""
    ever, back = crossings(hull), [hull.fingerprint]
    for task in edits:
        before = crossings(hull)
        report = carry_out(hull, task)
        if report is None:
            continue
        assert_reported(before, ever, hull, report)
        assert_branches(hull)
        ever |= crossings(hull)
        back.append(hull.fingerprint)
    for fingerprint in reversed(back[:-1]):
        hull.undo()
        assert hull.fingerprint == fingerprint


PAIR = "waterlines:2.304980 x buttocks:3.845946"


def swell(hull: ah.Hull, amount: float) -> EditReport:
    """Pull the hull where a waterline just misses a buttock amidships."""
    with hull.edit("swell", gaps="report") as edit:
        edit.pull("WL 2.305 x ST 4", amount, (25.0, 6.0))
    assert edit.report is not None
    return edit.report


def of_pair(hull: ah.Hull) -> set[str]:
    """Keys of the crossings of the waterline with the buttock."""
    return {key for key in crossings(hull) if key.startswith(PAIR)}


def test_a_bump_bears_a_pair_and_undo_takes_it_back() -> None:
    """A waterline bulges over a buttock: an entering and a leaving crossing."""
    hull = fresh(4)
    start = hull.fingerprint
    assert of_pair(hull) == set()
    report = swell(hull, 0.4)
    born = of_pair(hull)
    assert set(report.born) == born
    assert sorted(key.split()[-1][0] for key in born) == ["+", "-"]
    assert list(trouble(hull)) == []
    assert list(lost_meetings(hull)) == []
    hull.undo()
    assert (hull.fingerprint, of_pair(hull)) == (start, set())
    hull.redo()
    assert of_pair(hull) == born


def test_a_dead_id_never_comes_back() -> None:
    """The bump, taken back by an edit and made again, has crossings of new births."""
    hull, seen = fresh(4), set[str]()
    start = hull.fingerprint
    for _ in range(3):
        born = set(swell(hull, 0.4).born)
        assert born == of_pair(hull)
        assert len(born) == 2
        assert not born & seen
        seen |= born
        assert set(swell(hull, -0.4).gone) == born
        assert of_pair(hull) == set()
    hull.undo(6)
    assert hull.fingerprint == start


def test_a_handle_on_a_dead_crossing_knows_it() -> None:
    """It is an error that says so, and the hull stays as it was."""
    hull = fresh(4)
    swell(hull, 0.4)
    point = hull.crossings[f"BTK 3.846 x WL 2.305 #{birth(hull)}"].points[0]
    swell(hull, -0.8)
    before = hull.fingerprint
    assert not point.alive
    with pytest.raises(ah.ForeignPointError), hull.edit("late") as edit:
        edit.set_role(point, "shared")
    assert hull.fingerprint == before


def birth(hull: ah.Hull) -> int:
    """The number of the first birth of the pair that is alive."""
    return min(int(key.split()[-1][1:]) for key in of_pair(hull))


def test_crossings_slide_and_keep_their_ids() -> None:
    """Small pulls in one place move the same two crossings along the buttock."""
    hull = fresh(4)
    swell(hull, 0.4)
    ids, places = of_pair(hull), []
    for _ in range(4):
        report = swell(hull, 0.02)
        assert (report.born, report.gone) == ((), ())
        assert of_pair(hull) == ids
        rows = [hull.state.rows.key.data.index(key) for key in sorted(ids)]
        places.append(hull.state.rows.spot.data[rows, 0, 0].tolist())
    assert all(one != other for one, other in pairwise(places))
    assert_branches(hull)


def test_a_driven_crossing_vanishes_and_its_curve_goes_on() -> None:
    """A buttock is drawn away from a section's plane: the crossing goes, and says so."""
    hull = fresh(2)
    before = {key: hull.points[key].crossing_role for key in crossings(hull)}
    act = Act(op="reshape", which=15722, other=32587, amount=-0.16279186696952455)
    report = carry_out(hull, Task((act,), "report"))
    assert report is not None
    gone = [key for key in report.gone if before[key] == "drives b"]
    assert gone
    keys = hull.state.rows.key.data
    for curve in hull.state.live("curves").tolist():
        assert not {keys[row] for row in hull.state.curves.rows.data[curve]} & set(gone)
    assert hull.verify() == ()
    assert list(trouble(hull, kept=True)) == []


def test_a_crossing_that_comes_near_later_is_born_then() -> None:
    """Two curves meet each other's plane apart, and come together by a later edit.

    At first the relation is latent on both; no root is new when they come near.
    """
    hull = fresh(7)
    pair = "waterlines:4.464112 x buttocks:3.772894"
    for act in (
        Act("insert", 37112, 8765, 0.13940862265357393),
        Act("set_end", 53761, 22250, -0.273),
    ):
        assert carry_out(hull, Task((act,))) is not None
        assert list(lost_meetings(hull)) == []
    found = [key for key in crossings(hull) if key.startswith(pair)]
    assert {key[-2] for key in found} == {"+", "-"}


def test_signs_and_order_of_series_60(series60_70: ah.Hull) -> None:
    """No crossing of the whole net lies on the wrong branch."""
    assert_branches(series60_70)

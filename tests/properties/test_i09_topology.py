"""I9: crossings that come and go are reported as such, and none is ever taken for another."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings

import assoc_hull as ah
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


def assert_reported(before: set[str], ever: set[str], hull: ah.Hull, report: ah.EditReport) -> None:
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
SWELL = Task((Act("move", 58305, 53376, 0.44932279597603964),), "report")


def swelling(amount: float) -> ah.Hull:
    """Give a hull whose waterline was dragged out towards a buttock amidships."""
    hull = fresh(4)
    point = hull.points["WL 2.305 x ST 4"]
    with hull.edit("swell", gaps="report") as edit:
        edit.move(point, y=point.y + amount)
    return hull


def of_pair(hull: ah.Hull) -> set[str]:
    """Keys of the crossings of the pair of lines that is watched here."""
    return {key for key in crossings(hull) if key.startswith(PAIR)}


@pytest.fixture(scope="module")
def amounts() -> tuple[float, float]:
    """A drag that bears a pair of crossings, and one back that lets it vanish."""
    return 0.45, -0.45


def test_a_bump_bears_a_pair_and_its_going_kills_it(amounts: tuple[float, float]) -> None:
    """A waterline bulges over a buttock: an entering and a leaving crossing, and back."""
    hull = fresh(4)
    start, first = hull.fingerprint, of_pair(hull)
    report = carry_out(hull, SWELL)
    assert report is not None
    born = of_pair(hull) - first
    assert set(report.born) == born
    assert sorted(key.split()[-1][0] for key in born) == ["+", "-"]
    assert list(trouble(hull, kept=True)) == []
    assert list(lost_meetings(hull)) == []
    hull.undo()
    assert (hull.fingerprint, of_pair(hull)) == (start, first)
    hull.redo()
    assert of_pair(hull) - first == born


def test_a_dead_id_never_comes_back() -> None:
    """The same bump, taken back by an edit and made again, has crossings of new births."""
    hull = fresh(4)
    first, seen = of_pair(hull), set[str]()
    for _ in range(3):
        assert carry_out(hull, SWELL) is not None
        born = of_pair(hull) - first
        assert len(born) == 2
        assert not born & seen
        seen |= born
        back = Task((Act("move", 58305, 53376, -0.44932279597603964),), "report")
        report = carry_out(hull, back)
        assert report is not None
        assert set(report.gone) >= born
        assert of_pair(hull) == first
    hull.undo(6)
    assert of_pair(hull) == first


def test_old_crossings_keep_their_ids_when_others_are_born_between_them() -> None:
    """They slide; the new pair lies between them on both curves."""
    hull = fresh(4)
    before = {key: hull.state.rows.key.data.index(key) for key in of_pair(hull)}
    carry_out(hull, SWELL)
    assert set(before) <= of_pair(hull)
    assert_branches(hull)
    curve = int(hull.state.rows.curve.data[next(iter(before.values())), 0])
    other = int(hull.state.rows.curve.data[next(iter(before.values())), 1])
    rows = [hull.state.rows.key.data.index(key) for key in of_pair(hull)]
    order = order_along(hull.state, rows, curve, other)
    signs = [int(hull.state.rows.sign.data[row]) for row in order]
    assert all(one == -next_one for one, next_one in pairwise(signs))
    assert {order[0], order[-1]} == set(before.values())

"""I9: crossings that come and go are reported as such, and none is ever taken for another."""

from __future__ import annotations

import random
from itertools import pairwise

import attrs
import numpy as np
import pytest
from hypothesis import given, settings

import assoc_hull as ah
from assoc_hull.edit.step import EditReport
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState
from tests.independent import Root, lost_meetings, roots, trouble
from tests.long_forms import draws
from tests.net_strategies import (
    SHAPES,
    STRUCTURE,
    Act,
    Task,
    carry_out,
    fresh,
    hulls,
    perform,
    refused,
    tasks,
)

ROUGH = ("move", "pull", "reshape", "insert", "set_end")


def crossings(hull: ah.Hull) -> set[str]:
    """Keys of all live crossings."""
    rows = hull.state.rows
    live = hull.state.live("rows").tolist()
    return {rows.key[row] for row in live if rows.sort[row] == Sort.CROSSING}


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
        a, b = state.rows.curve[row].tolist()
        if state.rows.sort[row] == Sort.CROSSING and not state.rows.contact[row]:
            pairs.setdefault((a, b), []).append(row)
            assert sign_at(state, row, a, b) == state.rows.sign[row]
    for (a, b), rows in pairs.items():
        along = [order_along(state, rows, curve, other) for curve, other in ((a, b), (b, a))]
        assert along[0] in (along[1], along[1][::-1]), [state.rows.key[row] for row in rows]


def sign_at(state: HullState, row: int, curve: int, other: int) -> int:
    """In which sense a curve passes the plane of another at a crossing."""
    nearest, normal = root_at(state, row, curve, other)
    return 1 if float(nearest.tangent @ normal) > 0.0 else -1


def root_at(
    state: HullState, row: int, curve: int, other: int
) -> tuple[Root, np.typing.NDArray[np.float64]]:
    """Where a curve meets the plane of another at a crossing, and the normal of the plane."""
    line = state.line_of(other)
    normal = state.lines.normal[line]
    found = roots(state.spline(curve), normal, float(state.lines.offset[line]))
    place = place_on(state, row, curve)
    nearest = min(found, key=lambda each: float(np.abs(each.place - place).max()))
    assert float(np.abs(nearest.place - place).max()) < 1e-6, state.rows.key[row]
    return nearest, normal


def senses(hull: ah.Hull) -> dict[tuple[str, str], int]:
    """In which sense each curve passes its partner at each crossing, found from the splines.

    Left out is what has no sense: where a line ends, turns or leaves a flat, and where a curve
    makes less than 1e-3 with the plane, so that rounding would decide.
    """
    state, rows, found = hull.state, hull.state.rows, dict[tuple[str, str], int]()
    for row in state.live("rows").tolist():
        if rows.sort[row] != Sort.CROSSING or rows.contact[row]:
            continue
        a, b = rows.curve[row].tolist()
        for curve, other in ((a, b), (b, a)):
            root, normal = root_at(state, row, curve, other)
            sine = float(root.tangent @ normal)
            if abs(sine) > 1e-3:
                found[rows.key[row], state.curves.key[curve]] = 1 if sine > 0 else -1
    return found


def assert_senses_kept(hull: ah.Hull, born: dict[tuple[str, str], int]) -> None:
    """Each crossing is passed as at its birth, and as its key and its meetings say."""
    state = hull.state
    number = {key: row for row, key in enumerate(state.rows.key.data)}
    curves = {key: curve for curve, key in enumerate(state.curves.key.data)}
    for (key, name), sense in senses(hull).items():
        row, curve = number[key], curves[name]
        assert born.setdefault((key, name), sense) == sense, f"{key} is passed by {name} as {sense}"
        meets = state.curves.meets[curve]
        assert meets.sign[meets.row == row].tolist() == [sense], f"{key} on {name}"
        if state.rows.curve[row, 0] == curve:
            assert state.rows.sign[row] == sense, f"{key} on {name}"


def place_on(state: HullState, row: int, curve: int) -> np.typing.NDArray[np.float64]:
    """Where a crossing lies on one of its curves."""
    side = int(state.rows.curve[row, 0] != curve)
    watched = state.rows.role[row] == Role.WATCHED
    return np.array(state.rows.spot[row, side] if watched else state.rows.xyz[row])


def order_along(state: HullState, rows: list[int], curve: int, other: int) -> list[int]:
    """Give crossings of one pair of curves in order along one of them."""
    line = state.line_of(other)
    plane = state.lines.normal[line], float(state.lines.offset[line])
    places = [root.place for root in roots(state.spline(curve), *plane)]

    def at(row: int) -> int:
        return int(np.argmin([np.abs(each - place_on(state, row, curve)).max() for each in places]))

    return sorted(rows, key=at)


Orders = dict[tuple[str, str], list[str]]


def orders(hull: ah.Hull) -> Orders:
    """Give the crossings of curves that cross more than once, in order along one and the other.

    Around a bulb and its neck the two orders may differ.
    """
    state, found = hull.state, Orders()
    pairs: dict[tuple[int, int], list[int]] = {}
    for row in state.live("rows").tolist():
        a, b = state.rows.curve[row].tolist()
        if state.rows.sort[row] == Sort.CROSSING and not state.rows.contact[row]:
            pairs.setdefault((a, b), []).append(row)
    name, key = state.curves.key.data, state.rows.key.data
    for (a, b), rows in pairs.items():
        for curve, other in ((a, b), (b, a)) if len(rows) > 1 else ():
            along = order_along(state, rows, curve, other)
            found[name[curve], name[other]] = [key[row] for row in along]
    return found


def assert_orders_kept(before: Orders, hull: ah.Hull) -> None:
    """Crossings that were there before and are there still follow one another as they did."""
    for pair, now in orders(hull).items():
        old = before.get(pair, [])
        assert [key for key in now if key in old] == [key for key in old if key in now], pair


@settings(max_examples=draws(25))
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


BENDS = ("insert", "insert", "insert", "move", "set_end", "reshape", "pull")


@settings(max_examples=draws(25))
@given(hulls(), tasks((*SHAPES, *BENDS), largest=1.5, most=4, acts=1))
def test_a_crossing_is_passed_in_one_sense_all_its_life(hull: ah.Hull, edits: list[Task]) -> None:
    """By both of its curves, over rough edits of every kind: the sense is part of its id."""
    born = senses(hull)
    for task in edits:
        if carry_out(hull, task) is not None:
            assert_senses_kept(hull, born)


@settings(max_examples=draws(25))
@given(hulls(), tasks((*SHAPES, *STRUCTURE), largest=0.2, most=4))
def test_lines_that_come_and_go_turn_no_crossing_round(hull: ah.Hull, edits: list[Task]) -> None:
    """Nor do roles that change; adopted nets are passed as their keys say."""
    born = dict[tuple[str, str], int]()
    assert_senses_kept(hull, born)
    for task in edits:
        if carry_out(hull, task) is not None:
            assert_senses_kept(hull, born)


@pytest.mark.parametrize("number", [5, 10])
def test_points_far_beside_a_curve_turn_no_crossing_round(number: int) -> None:
    """Of forty points a metre off, some would: these are refused, the rest keep all senses."""
    rng = random.Random(number)
    for _ in range(40):
        hull = fresh(number)
        born, (which, other) = senses(hull), (rng.randrange(2**16), rng.randrange(2**16))
        act = Act("insert", which, other, rng.choice((-1.2, -0.75, 0.75, 1.2)))
        if carry_out(hull, Task((act,), "report")) is not None:
            assert_senses_kept(hull, born)


def test_a_curve_bent_through_its_own_crossing_the_other_way_is_refused() -> None:
    """A point far beside a shared crossing makes a section enter where it left: a fold.

    The message names crossing, curve, place, angle and how far off the old sense is.
    """
    hull = fresh(10)
    act = Act("insert", 4, 33376, 0.75)
    text = refused(hull, lambda edit: perform(hull, edit, act), ah.errors.RefusedEditError)
    assert "WL 3.234 x ST 2: ST 2 folds through the plane of WL 3.234" in text
    assert "makes -33.7 degrees with it there" in text
    assert "0.725 m away" in text
    refused(hull, lambda edit: perform(hull, edit, act), ah.errors.RefusedEditError, "report")


def test_check_finds_a_crossing_that_is_passed_the_other_way() -> None:
    """In a hull that came to it otherwise, for instance from a file."""
    hull = fresh(10)
    assert hull.check() == ()
    meets = hull.lines["ST 2"].curves[0]
    table = hull.state.curves.meets.data
    old = table[meets.row]
    place = old.xyz.copy()
    place[old.row == hull.crossings["WL 3.234 x ST 2"].row, 1] += 0.5
    table[meets.row] = attrs.evolve(old, xyz=place)
    assert [(each.kind, each.object) for each in hull.check()] == [("sense", "WL 3.234 x ST 2")]


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
        born = set(swell(hull, 0.2).born)
        assert born == of_pair(hull)
        assert len(born) == 2
        assert not born & seen
        seen |= born
        assert set(swell(hull, -0.2).gone) == born
        assert of_pair(hull) == set()
    hull.undo(6)
    assert hull.fingerprint == start


DENTED = ("WL 2.232", "BTK 1.886")


def dent(hull: ah.Hull, amount: float) -> EditReport:
    """Pull the hull in or out between the two crossings of a waterline with a buttock."""
    with hull.edit("dent", gaps="report") as edit:
        edit.pull("WL 2.232 x ST 4", amount, (12.0, 4.0))
    assert edit.report is not None
    return edit.report


def along(hull: ah.Hull) -> dict[str, float]:
    """Where the crossings of the dented pair lie along the waterline, m, from aft."""
    rows = hull.state.rows
    found = {
        each.id: float(place_on(hull.state, each.row, each.a.row)[0])
        for each in hull.crossings.values()
        if (each.a.line.name, each.b.line.name) == DENTED
    }
    assert all(rows.alive[rows.key.data.index(key)] for key in found)
    return dict(sorted(found.items(), key=lambda item: item[1]))


def test_a_dent_bears_a_pair_between_two_crossings_and_takes_it_back() -> None:
    """The outer crossings stay who they are and where they are, the inner ones come and go.

    By ordinal the forward one would become an inner one as the dent comes, and an inner one
    the forward one as it goes; counted from the other end, the aft one.
    """
    hull = fresh(7)
    start, born = along(hull), senses(hull)
    aft, forward = start
    seen = set(start)
    for amount, count in ((-0.345, 4), (-0.05, 4), (0.03, 4), (0.4, 2), (-0.42, 4), (0.44, 2)):
        before = along(hull)
        report = dent(hull, amount)
        now = along(hull)
        assert (len(now), min(now, key=now.__getitem__), list(now)[-1]) == (count, aft, forward)
        assert now[aft] == pytest.approx(start[aft], abs=4.0)
        assert now[forward] == pytest.approx(start[forward], abs=4.0)
        inner = list(now)[1:-1]
        assert [key.split()[-1][0] for key in now] == list("+-+-"[:count])
        if len(before) == count:
            assert inner == list(before)[1:-1]
        else:
            assert not set(inner) & seen
            assert set(report.born) >= set(inner)
            assert set(report.gone) >= set(before) - {aft, forward} - set(inner)
        seen |= set(now)
        assert_branches(hull)
        assert_senses_kept(hull, born)
        assert list(trouble(hull, kept=True)) == []
    hull.undo(6)
    assert along(hull) == start


def test_a_crossing_is_one_place_on_both_curves_when_two_pairs_come_at_once() -> None:
    """Aligned by themselves the waterline kept it forward and the buttock took it amidships.

    A gap of 597 mm would be told there, where the two curves pass 7 mm apart.
    """
    hull = fresh(7)
    acts = Act("reshape", 0, 69, 0.5), Act("insert", 47083, 1761, 0.5)
    report = carry_out(hull, Task(acts, "report"))
    assert report is not None
    assert report.largest_gap < 0.01
    assert sorted(key[-2] for key in report.born) == ["+", "-"]
    assert_branches(hull)
    assert list(lost_meetings(hull)) == []


def test_a_handle_on_a_dead_crossing_knows_it() -> None:
    """It is an error that says so, and the hull stays as it was."""
    hull = fresh(4)
    swell(hull, 0.4)
    point = hull.crossings[f"BTK 3.846 x WL 2.305 #{birth(hull)}"].points[0]
    swell(hull, -0.8)
    before = hull.fingerprint
    assert not point.alive
    with pytest.raises(ah.errors.ForeignPointError), hull.edit("late") as edit:
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
        places.append(hull.state.rows.spot[rows, 0, 0].tolist())
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
        assert not {keys[row] for row in hull.state.curves.rows[curve]} & set(gone)
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

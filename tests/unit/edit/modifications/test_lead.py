"""A line is led through places, and the hull answers as fairly as it was."""

from __future__ import annotations

from ast import literal_eval
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.edit.net_battens import fairable_rows
from assoc_hull.edit.session import Edit
from assoc_hull.errors import (
    BadInputError,
    PointRoleError,
    RefusedEditError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.hull import Hull
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState
from tests.conftest import Shipped
from tests.taken_back import taken_back


@pytest.fixture
def carrier(bulk_carrier: Hull) -> Iterator[Hull]:
    """The 207k carrier, given back as it was."""
    with taken_back(bulk_carrier) as hull:
        yield hull


@pytest.fixture
def wigley(shipped: Shipped) -> Hull:
    """The Wigley hull, one's own."""
    return shipped("wigley")


# --------------------------------------------------------------------------------------
# The story of the stern: on two buttocks A is moved, B is added, and all ends follow.


def _signs(state: HullState) -> dict[tuple[str, float], int]:
    """Count the sign changes of curvature of all curves, at lobes of .2 and 1 degree."""
    curves = state.live("curves")
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    normals, keys = plane_normals(state, curves), [state.curves.key[each] for each in curves]
    return {
        (key, lobe): count
        for lobe in (0.2, 1.0)
        for key, count in zip(keys, inflections(batch, normals, lobe)[0].tolist(), strict=True)
    }


def _gained(before: dict[tuple[str, float], int], state: HullState) -> dict[object, object]:
    after = _signs(state)
    return {key: (was, after[key]) for key, was in before.items() if after.get(key, was) > was}


def _goals(hull: Hull, name: str) -> FloatArray:
    """Give A, 20 mm above the crossing with ST 0, and B, 25 mm above the line at 2.2 m."""
    curve = hull.lines[name].curves[0]
    met = intersect_planes(
        hull.document.state.spline(curve.number), np.array([1.0, 0, 0]), np.array([2.2])
    )
    first = hull.points[f"{name} x ST 0"].position
    return np.stack([np.add(first, (0.0, 0.0, 0.02)), np.add(met.xyz[0], (0.0, 0.0, 0.025))])


def _misses(hull: Hull, name: str, goals: FloatArray) -> float:
    state = hull.document.state
    xyz = state.rows.xyz[state.curves.rows[hull.lines[name].curves[0].number]]
    return max(float(np.abs(xyz - goal).max(axis=1).min()) for goal in goals)


def _names(hull: Hull, keys: set[str]) -> set[str]:
    return {line.name for line in hull.lines.values() if line.id in keys}


def _refuse_swings(
    hull: Hull, before: FloatArray, normal: FloatArray, free: IntArray, asked: float
) -> None:
    """No free point has gone more than a tenth of what was asked for the other way."""
    step = ((hull.document.state.rows.xyz.data[free] - before[free]) * normal[free]).sum(axis=1)
    assert step.min() >= -1.1 * asked - 1e-6
    assert step.max() <= 0.1 * asked + 1e-6


ENDS = {f"WL {z}" for z in ("12", "13.5", "15", "16.5")}
FRAMES = {f"ST {x}" for x in ("0", "0.28", "0.45", "0.5", "0.62", "0.75")}


@pytest.mark.parametrize(
    "edits",
    [
        (("BTK 0.5", "BTK 1"),),
        (("BTK 1",), ("BTK 0.5",)),
        (("BTK 0.5",), ("BTK 1",)),
    ],
    ids=["one edit", "BTK 1 first", "BTK 0.5 first"],
)
def test_the_ends_of_waterlines_follow_two_buttocks_and_stay_fair(
    carrier: Hull, edits: tuple[tuple[str, ...], ...]
) -> None:
    """After a point of the lowest waterline has moved, A and B of both buttocks are asked for."""
    state = carrier.document.state
    with carrier.edit("a point of WL 0.5") as edit:
        edit.move("WL 0.5 x ST 4", y=carrier.points["WL 0.5 x ST 4"].y + 0.002)
    first, before = carrier.fingerprint, _signs(state)
    goals = {name: _goals(carrier, name) for names in edits for name in names}
    followed: set[str] = set()
    added: list[ah.Point] = []
    for names in edits:
        xyz, normal = state.rows.xyz.data.copy(), hull_normals(state).copy()
        free = fairable_rows(state)
        with carrier.edit("the stern") as edit:
            made = [edit.lead(name, goals[name]) for name in names]
        report = edit.report
        assert report is not None
        assert [len(each) for each in made] == [1] * len(names), "A is a crossing, B is added"
        assert max(_misses(carrier, name, goals[name]) for name in names) < 1e-9
        most = max(abs(amount) for led in report.led for _, amount in led.asked)
        added += [point for points in made for point in points]
        if len(edits) == 1:
            _refuse_swings(carrier, xyz, normal, free, most)
        assert {led.line for led in report.led} == {carrier.lines[name].id for name in names}
        followed |= {key for key, amount in report.followed if abs(amount) > 1e-4}
        assert report.largest_gap <= 2.23e-3 + 1e-3
        assert not carrier.check()
        assert not carrier.verify()
    # B of the first line is there still when the second has led.
    order = [name for names in edits for name in names]
    for name, point in zip(order, added, strict=True):
        assert point.sort == "placed"
        assert np.array_equal(point.position, goals[name][1])
    assert not _gained(before, state)
    assert len(state.live("curves")) == 86
    # Where one line leads after the other, less is asked of each, and ST 0.75 is out of reach.
    assert _names(carrier, followed) >= ENDS | FRAMES - ({"ST 0.75"} if len(edits) > 1 else set())
    carrier.undo(len(edits))
    assert carrier.fingerprint == first


def test_a_waterline_leads_sections_and_buttocks_as_a_buttock_does(carrier: Hull) -> None:
    """The story mirrored: A of WL 11 20 mm out at ST 1, B 25 mm out half-way to the next point."""
    state, before, first = (
        carrier.document.state,
        _signs(carrier.document.state),
        carrier.fingerprint,
    )
    curve, place = carrier.lines["WL 11"].curves[0], carrier.points["WL 11 x ST 1"].position
    after = min(point.x for point in curve.points if point.x > place[0] + 0.01)
    middle = np.array([0.5 * (place[0] + after)])
    met = intersect_planes(state.spline(curve.number), np.array([1.0, 0, 0]), middle)
    goals = np.stack([np.add(place, [0.0, 0.02, 0.0]), np.add(met.xyz[0], (0.0, 0.025, 0.0))])
    with carrier.edit("the waterline") as edit:
        edit.lead("WL 11", goals)
    assert edit.report is not None
    assert not _gained(before, state)
    assert _misses(carrier, "WL 11", goals) < 1e-9
    assert _names(carrier, {key for key, _ in edit.report.followed}) >= {"ST 1", "BTK 6", "BTK 8.5"}
    assert not carrier.check()
    assert not carrier.verify()
    carrier.undo()
    assert carrier.fingerprint == first


# --------------------------------------------------------------------------------------
# What a lead keeps, and what it tells.


@pytest.mark.parametrize("name", ["BTK 1", "WL 13.5", "ST 0.5"])
def test_roles_stay_and_shared_crossings_lie_on_the_new_shape(carrier: Hull, name: str) -> None:
    """Then each crossing of the line can be moved from the line that crosses, and led as well."""
    state = carrier.document.state
    line, table = carrier.lines[name], state.rows
    shared = [
        point for point in line.curves[0].points
        if table.sort[point.number] == Sort.CROSSING
        and table.role[point.number] == Role.SHARED
        and point.number in fairable_rows(state)
    ]  # fmt: skip
    middle = shared[len(shared) // 2]
    roles = table.role.data.copy()
    outward = hull_normals(state)[middle.number]
    axes = {"B": 2, "W": 1, "S": 1}[name[0]]
    goal = np.array(middle.position)
    goal[axes] += 0.01 * np.sign(outward[axes])
    with carrier.edit("lead") as edit:
        edit.lead(name, [(middle, goal)])
    assert np.array_equal(table.role.data[: len(roles)], roles)
    spline = state.spline(line.curves[0].number)
    places = np.array([point.position for point in shared])
    assert closest_points(spline, 0, places)[2].max() < 1e-9
    assert edit.report is not None
    assert {point.id for point in shared} & {key for key, _ in edit.report.led[0].crossings}
    other = next(each for each in middle.name.split(" x ") if each != name)
    with carrier.edit("from the other line") as edit:
        edit.lead(other.split(" #")[0], [(middle, middle.position)])
        edit.move(shared[0], by=(0.0, 0.0, 0.0))


def test_the_report_lists_what_followed_and_a_preview_foretells_it(carrier: Hull) -> None:
    """Stretch, asked points and crossings with their ways stand in both, to the last digit."""
    goals, before = _goals(carrier, "BTK 1"), carrier.fingerprint

    def ask(edit: Edit) -> None:
        edit.lead("BTK 1", goals)

    seen = carrier.preview(ask, measure=False)
    assert carrier.fingerprint == before
    with carrier.edit("preview") as edit:
        ask(edit)
    assert edit.report is not None
    assert seen.report is not None
    assert seen.fingerprint == carrier.fingerprint
    assert seen.report.led == edit.report.led
    assert seen.report.followed == edit.report.followed
    assert seen.report.notes == edit.report.notes
    (led,) = edit.report.led
    assert led.stretch == pytest.approx((-5.0, 26.29), abs=0.01), "from the transom to the flat"
    told = "\n".join(edit.report.notes)
    assert "BTK 1 leads over x -5.00 to 26.29 m: BTK 1 x ST 0 -16.4 mm" in told
    crossings = {carrier.find(key).name: amount for key, amount in led.crossings}
    assert (
        f"WL 15 {1e3 * dict(led.crossings)['waterlines:15.000000 x buttocks:1.000000 +1']:+.1f} mm"
        in told
    )
    assert len(crossings) > 8
    assert "points move by more than 1 mm from x -5.0 to 6.8 m, and by 2.0 mm the other" in told


def test_a_line_that_followed_gets_a_note_until_the_next_checkpoint(shipped: Shipped) -> None:
    """A distance from where it is now would be a second dose."""
    carrier = shipped("bulk_carrier")
    goals = {name: _goals(carrier, name) for name in ("BTK 0.5", "BTK 1")}
    note = "BTK 0.5 has followed BTK 1 by up to -15.7 mm since the last checkpoint"
    for wanted in (True, False):
        with carrier.edit("first") as edit:
            edit.lead("BTK 1", goals["BTK 1"])
        if not wanted:
            carrier.checkpoint("agreed")
        with carrier.edit("second") as edit:
            edit.lead("BTK 0.5", goals["BTK 0.5"])
        assert edit.report is not None
        assert any(each.startswith(note) for each in edit.report.notes) is wanted
        carrier.undo(2)


@pytest.mark.parametrize("how", ["script", "file"])
def test_a_lead_is_repeated_from_what_was_written_down(
    shipped: Shipped, how: str, tmp_path: Path
) -> None:
    """A script solves it anew; a file holds the values and the report. Both give one hull."""
    carrier = shipped("bulk_carrier")
    a, b = _goals(carrier, "BTK 1")
    with carrier.edit("lead") as edit:
        edit.lead(carrier.lines["BTK 1"], [(carrier.points["BTK 1 x ST 0"], a), b])
    wanted, report = carrier.fingerprint, edit.report
    assert report is not None
    if how == "file":
        path = tmp_path / "led.hull"
        carrier.save(path)
        reopened = ah.open(path)
        assert reopened.fingerprint == wanted
        assert reopened.history[-1].led == report.led
        assert reopened.history[-1].followed == report.followed
        reopened.undo()
        reopened.redo()
        assert reopened.fingerprint == wanted
        return
    (said,) = carrier.document.history[-1].script.edits
    assert said == {
        "op": "lead", "line": "BTK 1", "points": [["BTK 1 x ST 0", a.tolist()], b.tolist()],
    }  # fmt: skip
    carrier.undo()
    carrier.apply("again", [said])
    assert carrier.fingerprint == wanted


def test_the_order_of_requests_changes_no_place(carrier: Hull) -> None:
    """Two leads, one of them in two calls, and a pull give the same bits in any order."""
    goals = {name: _goals(carrier, name) for name in ("BTK 0.5", "BTK 1")}
    asked: list[Callable[[Edit], object]] = [
        lambda edit: edit.lead("BTK 1", goals["BTK 1"][:1]),
        lambda edit: edit.lead("BTK 1", goals["BTK 1"][1:]),
        lambda edit: edit.lead("BTK 0.5", goals["BTK 0.5"]),
        lambda edit: edit.pull("WL 9 x ST 17", 0.02, fair=True),
    ]
    found = []
    for order in ((0, 1, 2, 3), (3, 2, 1, 0), (1, 3, 0, 2)):
        with carrier.edit("in an order") as edit:
            for number in order:
                asked[number](edit)
        state = carrier.document.state
        found.append([state.spline(each).xyz.tobytes() for each in state.live("curves").tolist()])
        carrier.undo()
    assert found[0] == found[1] == found[2]


def test_a_placed_point_bounds_no_short_stretch_and_is_named(wigley: Hull) -> None:
    """It stays where it is; at a tenth of Lpp and two free points beyond, the stretch ends."""
    with wigley.edit("near and far") as edit:
        line = wigley.lines["WL 2.5"].curves[0]
        near, far = (edit.insert(line, line.at(t)) for t in (32.0, 42.0))
    places = [near.position, far.position]
    x, y, z = wigley.points["WL 2.5 x ST 6"].position
    with wigley.edit("lead") as edit:
        edit.lead("WL 2.5", [("WL 2.5 x ST 6", (x, y + 0.01, z))])
    assert edit.report is not None
    (led,) = edit.report.led
    assert led.stretch[1] == pytest.approx(far.x)
    assert np.array_equal([near.position, far.position], places)
    assert any("stay, and dent it: WL 2.5 @ placed 1" in each for each in edit.report.notes)


def test_a_short_named_stretch_is_told_of(wigley: Hull) -> None:
    """Outside it nothing moves, and the report says what comes of so few points."""
    state, before = wigley.document.state, wigley.document.state.rows.xyz.data.copy()
    x, y, z = wigley.points["WL 2.5 x ST 6"].position
    with wigley.edit("lead") as edit:
        edit.lead("WL 2.5", [("WL 2.5 x ST 6", (x, y + 0.01, z))], span=(x - 8.0, x + 8.0))
    moved = (state.rows.xyz.data[: len(before)] != before).any(axis=1)
    assert np.abs(before[moved, 0] - x).max() < 8.0
    assert edit.report is not None
    assert any("with less than 2 it makes a dimple" in each for each in edit.report.notes)


def test_radii_go_with_the_length_below_100_m() -> None:
    """A hull of 50 m is answered within half a metre where one of 100 m is within one."""
    told = []
    for length in (100.0, 50.0):
        part = length / 100.0
        hull = ah.examples.wigley(length, 10.0 * part, 6.25 * part)
        point = next(each for each in hull.points if "x ST 6" in each and each.startswith("WL"))
        x, y, z = hull.points[point].position
        with hull.edit("lead") as edit:
            edit.lead(point.split(" x ")[0], [(point, (x, y + 0.002 * part, z))])
        assert edit.report is not None
        told.append(edit.report.notes[0].split(":")[0])
    assert told == ["answered fairly within 1 m", "answered fairly within 0.5 m"]


def test_what_is_so_already_is_no_step(wigley: Hull) -> None:
    """A crossing that is asked to be where it is, and the same lead a second time."""
    before = wigley.fingerprint
    with wigley.edit("where it is") as edit:
        edit.lead("WL 2.5", [wigley.points["WL 2.5 x ST 6"].position])
    assert wigley.fingerprint == before
    assert edit.report is not None
    assert not edit.report.changed
    assert "nothing was changed" in edit.report.notes[-1]
    assert not wigley.history
    line = wigley.lines["WL 2.5"].curves[0]
    place = np.add(line.at(55.0), (0.0, 0.01, 0.0))
    with wigley.edit("once") as edit:
        (made,) = edit.lead("WL 2.5", [place])
    once = wigley.fingerprint
    with wigley.edit("twice") as edit:
        assert edit.lead("WL 2.5", [place]) == ()
        edit.lead("WL 2.5", [(made, place)])
    assert wigley.fingerprint == once


def test_a_batten_that_springs_farther_is_told_of(wigley: Hull) -> None:
    """No sign of curvature changes, and yet the line is less fair by far: both residuals."""
    place = np.add(wigley.lines["WL 2.5"].curves[0].at(55.0), (0.0, 0.02, 0.0))
    with wigley.edit("lead") as edit:
        edit.lead("WL 2.5", [place])
    assert edit.report is not None
    (told,) = (note for note in edit.report.notes if note.startswith("a batten springs"))
    assert "0.8 mm at most before, by 12.7 mm now; it rose most on ST 11 at (55.000, " in told
    assert told.endswith(": more than twice; spread it over more points, or ask for less")


@pytest.mark.parametrize("act", ["lead", "reshape"])
def test_numbers_of_numpy_are_told_as_plain_ones(wigley: Hull, act: str) -> None:
    """A span is often a pair of an array's numbers."""
    place = wigley.lines["WL 2.5"].curves[0].at(55.0)
    span = np.float64(10.0), np.float64(40.5)
    told = r"outside the span \(10\.0, 40\.5\)"
    with pytest.raises(BadInputError, match=told), wigley.edit("outside") as edit:
        getattr(edit, act)("WL 2.5", [place], span=span)


def test_what_is_asked_plainly_beside_a_lead_is_no_gain_of_it(wigley: Hull) -> None:
    """A deep dent far off makes sign changes of its own, which no note lays on the lead."""
    place = np.add(wigley.lines["WL 2.5"].curves[0].at(75.0), (0.0, 0.005, 0.0))
    with wigley.edit("both") as edit:
        edit.pull("WL 5 x ST 5", -0.05)
        edit.lead("WL 2.5", [place])
    assert edit.report is not None
    assert [note for note in edit.report.notes if "changes of the sign of curvature" in note] == []


def test_an_adopted_point_becomes_placed_when_it_is_led(carrier: Hull) -> None:
    """As when it is moved."""
    state = carrier.document.state
    curve = carrier.lines["BTK 1"].curves[0]
    adopted = next(
        each for each in curve.points if state.rows.sort[each.number] == Sort.ADOPTED and each.z > 4
    )
    place = np.add(adopted.position, [0.002, 0.0, 0.0])
    with carrier.edit("lead") as edit:
        assert edit.lead(curve, [(adopted, place)]) == ()
    assert state.rows.sort[adopted.number] == Sort.PLACED
    assert np.array_equal(adopted.position, place)


@pytest.mark.parametrize(
    ("line", "crossing"), [("ST 9", "WL 0.15 x ST 9"), ("WL 0.2", "WL 0.2 x ST 1.25")]
)
def test_a_crossing_that_a_line_drives_or_is_watched_leads_it_by_a_point_there(
    fresh_series60_70: Hull, line: str, crossing: str
) -> None:
    """A placed point of the line lands on the place; a driven crossing too."""
    hull = fresh_series60_70
    state, point = hull.document.state, hull.points[crossing]
    outward = hull_normals(state)[point.number]
    assert abs(outward[1]) > 0.3
    side = int(state.line_of(int(state.rows.curve[point.number, 1])) == hull.lines[line].number)
    goal = state.rows.spot[point.number, side] + np.array([0.0, 0.005, 0.0])
    with hull.edit("lead") as edit:
        (made,) = edit.lead(line, [(point, goal)])
    assert np.array_equal(made.position, goal)
    if state.rows.role[point.number] != Role.WATCHED:
        assert np.abs(state.rows.spot[point.number] - goal).max() < 1e-9
    assert not hull.check(), "a watched gap keeps its limit"


# --------------------------------------------------------------------------------------
# Mistakes.

_PLACE = (60.0, 4.6, 2.5)

_BAD: dict[str, tuple[Callable[[Edit], object], type[Exception], str]] = {
    "no line": (lambda e: e.lead("WL 77", [_PLACE]), UnknownNameError, "WL 77"),
    "a point for a line": (
        lambda e: e.lead("WL 2.5 x ST 6", [_PLACE]), UnknownNameError, "WL 2.5 x ST 6",
    ),
    "a number for a line": (lambda e: e.lead(3, [_PLACE]), WrongTypeError, "line is 3"),  # type: ignore[arg-type]
    "a boundary curve": (
        lambda e: e.lead("profile", [(60.0, 0.0, 0.1)]), BadInputError, "lead the lines that meet",
    ),
    "no place": (lambda e: e.lead("WL 2.5", []), BadInputError, "no place is given"),
    "one place without a list": (lambda e: e.lead("WL 2.5", _PLACE), BadInputError, "item of"),
    "a text": (lambda e: e.lead("WL 2.5", "here"), WrongTypeError, "points is 'here'"),
    "a point without a place": (
        lambda e: e.lead("WL 2.5", ["WL 2.5 x ST 6"]), BadInputError, r"give \(point, \(x, y, z",
    ),
    "a nan": (lambda e: e.lead("WL 2.5", [(60.0, np.nan, 2.5)]), BadInputError, "not finite"),
    "off the plane": (
        lambda e: e.lead("WL 2.5", [(60.0, 4.6, 2.6)]), BadInputError, "off the plane of WL 2.5",
    ),
    "off the plane of a crossing": (
        lambda e: e.lead("WL 2.5", [("WL 2.5 x ST 6", (61.0, 4.6, 2.5))]),
        BadInputError, "off the plane of ST 6",
    ),
    "beyond the ends": (
        lambda e: e.lead("WL 2.5", [(140.0, 0.1, 2.5)]), BadInputError, "beyond the ends",
    ),
    "outside the span": (
        lambda e: e.lead("WL 2.5", [_PLACE], span=(70.0, 80.0)), BadInputError, "outside the span",
    ),
    "a turned span": (
        lambda e: e.lead("WL 2.5", [_PLACE], span=(80.0, 30.0)), BadInputError, "lower, upper",
    ),
    "a point of another line": (
        lambda e: e.lead("WL 2.5", [("WL 5 x ST 6", _PLACE)]), BadInputError, "no point of WL 2.5",
    ),
    "two places of one point": (
        lambda e: e.lead("WL 2.5", [(60.0, 4.6, 2.5), (60.0, 4.61, 2.5)]),
        BadInputError, "in two places",
    ),
    "metres": (
        lambda e: e.lead("WL 2.5", [(55.0, 44.6, 2.5)]), BadInputError, "ask for less than",
    ),
    "an end on the profile": (
        lambda e: e.lead("WL 2.5", [("profile x WL 2.5", (1.0, 0.0, 2.5))]),
        PointRoleError, "WL 2.5 x profile is on a flat or on the profile",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", _BAD)
def test_a_mistake_is_told_and_changes_nothing(wigley: Hull, case: str) -> None:
    """The message says what to do; an edit that goes on holds no trace of it."""
    act, kind, message = _BAD[case]
    before = wigley.fingerprint
    with pytest.raises(kind, match=message), wigley.edit("mistake") as edit:
        act(edit)
    assert wigley.fingerprint == before
    with wigley.edit("the next") as edit:
        edit.lead(
            "WL 2.5",
            [("WL 2.5 x ST 6", np.add(wigley.points["WL 2.5 x ST 6"].position, (0, 0.001, 0)))],
        )
    assert not wigley.check()


def test_a_place_beside_a_placed_point_is_asked_of_that_point(wigley: Hull) -> None:
    """The message gives the call that works."""
    line = wigley.lines["WL 2.5"].curves[0]
    with wigley.edit("P") as edit:
        edit.insert(line, line.at(55.0))
    place = np.add(line.at(55.1), (0.0, 0.01, 0.0))
    told = pytest.raises(BadInputError, match=r"lead that point: \('WL 2.5 @ placed 1', ")
    with told as why, wigley.edit("Q") as edit:
        edit.lead("WL 2.5", [place])
    given = str(why.value).split("lead that point: ")[1]
    with wigley.edit("Q") as edit:
        edit.lead("WL 2.5", [literal_eval(given)])
    assert wigley.points["WL 2.5 @ placed 1"].y == pytest.approx(place[1], abs=1e-6)


def test_a_point_that_is_led_onto_another_is_refused(wigley: Hull) -> None:
    """Line and distance are told."""
    line = wigley.lines["WL 2.5"].curves[0]
    with wigley.edit("P and Q") as edit:
        first, second = (edit.insert(line, line.at(t)) for t in (36.0, 39.0))
    with pytest.raises(RefusedEditError, match="closer than 1e-06"), wigley.edit("x") as edit:
        edit.lead(line, [(second, np.add(first.position, (0.0, 1e-8, 0.0)))])
    assert len(wigley.history) == 1


def test_a_crossing_that_another_line_drives_names_its_driver(fresh_series60_70: Hull) -> None:
    """The message says which line to lead."""
    hull = fresh_series60_70
    place = hull.points["WL 0.15 x ST 9"].position
    with pytest.raises(PointRoleError, match="lead ST 9"), hull.edit("x") as edit:
        edit.lead("WL 0.15", [("WL 0.15 x ST 9", np.add(place, (0, 0.01, 0)))])


def test_a_lead_whose_end_would_carry_a_corner_away_leaves_the_corner(shipped: Shipped) -> None:
    """BTK 6 of the 180 m ship ends on the transom some mm beside the deck edge, and would turn."""
    hull = shipped("bulk_carrier_180m")
    x, y, z = hull.lines["ST 0"].curves[0].at(4.0)
    corner = {name: hull.points[name].position for name in ("ST -0.4 x deck edge",)}
    before = hull.fingerprint
    with hull.edit("lead") as edit:
        edit.lead("ST 0", [(x, y + 0.05, z)])
    assert edit.report is not None
    assert any(note.startswith("boundary curves stay where they are") for note in edit.report.notes)
    assert all((hull.points[name].position == place).all() for name, place in corner.items())
    assert (hull.verify(), edit.report.inflections) == ((), ())
    hull.undo()
    assert hull.fingerprint == before


def test_flats_are_not_led(carrier: Hull) -> None:
    """The refusal names the line."""
    place = np.add(carrier.points["WL 9 x ST 6"].position, (0.0, 0.02, 0.0))
    with pytest.raises(PointRoleError, match="WL 9 x ST 6 is on a flat"), carrier.edit("x") as edit:
        edit.lead("WL 9", [place])


def test_a_mistake_that_is_caught_leaves_the_edit_as_it_was(wigley: Hull) -> None:
    """The second place of a call is wrong: the first is not asked for either."""
    with wigley.edit("goes on") as edit:
        with pytest.raises(BadInputError):
            edit.lead("WL 2.5", [(55.0, 4.6, 2.5), (56.0, 4.6, 2.6)])
        edit.move("WL 5 x ST 6", by=(0.0, 0.001, 0.0))
    assert edit.report is not None
    assert not edit.report.led
    assert not any("placed" in name for name in wigley.points)


@pytest.mark.parametrize("gone", ["ST 7", "WL 2.5"])
def test_a_line_that_goes_after_its_point_was_asked_for_is_refused(wigley: Hull, gone: str) -> None:
    """It says so, and two edits do it."""
    before = wigley.fingerprint
    asked = [("WL 2.5 x ST 7", np.add(wigley.points["WL 2.5 x ST 7"].position, (0, 0.005, 0)))]
    script: list[dict[str, object]] = [
        {"op": "lead", "line": "WL 2.5", "points": asked},
        {"op": "remove_line", "line": gone},
    ]
    with pytest.raises(BadInputError, match="use two edits"):
        wigley.apply("both", script)
    assert wigley.fingerprint == before
    with wigley.edit("lead") as edit:
        edit.lead("WL 2.5", asked)
    with wigley.edit("remove") as edit:
        edit.remove_line(gone)
    assert wigley.check() == ()

"""Pulls and re-shapes that leave the net as fair as it was."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.displacement_field import level_with_flats, on_flat, on_profile
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.edit.net_battens import fairable_rows
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, PointRoleError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.hull import Hull
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import HullState
from tests.conftest import Shipped
from tests.long_forms import long_form
from tests.taken_back import taken_back

_SPAN = (-3.75, 30.0)


@pytest.fixture
def carrier(bulk_carrier: Hull) -> Iterator[Hull]:
    """The 207k carrier, given back as it was."""
    with taken_back(bulk_carrier) as hull:
        yield hull


def _signs(state: HullState, lobe: float) -> dict[str, int]:
    """Count the sign changes of curvature of all curves, by key."""
    curves = state.live("curves")
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    counts = inflections(batch, plane_normals(state, curves), lobe)[0].tolist()
    return dict(zip([state.curves.key[curve] for curve in curves.tolist()], counts, strict=True))


def _gained(before: dict[str, int], after: dict[str, int]) -> dict[str, tuple[int, int]]:
    return {key: (was, after[key]) for key, was in before.items() if after.get(key, was) > was}


def _goals(hull: Hull, name: str) -> FloatArray:
    """Give point A, 20 mm above the crossing with ST 0, and B, 25 mm above the line at 2.2 m."""
    state, curve = hull.document.state, hull.lines[name].curves[0]
    met = intersect_planes(state.spline(curve.number), np.array([1.0, 0, 0]), np.array([2.2]))
    first = np.array(hull.points[f"{name} x ST 0"].position)
    first[2] += 0.02
    return np.stack([first, met.xyz[0] + [0.0, 0.0, 0.025]])


def _lead(edit: Edit, hull: Hull, name: str, goals: FloatArray) -> None:
    edit.reshape(hull.lines[name].curves[0], goals, span=_SPAN, fair=True)


def _misses(hull: Hull, name: str, goals: FloatArray) -> list[float]:
    state = hull.document.state
    xyz = state.rows.xyz[state.curves.rows[hull.lines[name].curves[0].number]]
    return [float(np.abs(xyz - goal).max(axis=1).min()) for goal in goals]


@pytest.mark.parametrize("order", [("BTK 0.5", "BTK 1"), ("BTK 1", "BTK 0.5"), ("BTK 1",)])
def test_buttocks_are_led_without_a_new_sign_change(carrier: Hull, order: tuple[str, ...]) -> None:
    """No line of the stern gains one, at lobes of .2 and 1 degree; the points lie as asked."""
    state, print_before = carrier.document.state, carrier.fingerprint
    before = {lobe: _signs(state, lobe) for lobe in (0.2, 1.0)}
    goals = {name: _goals(carrier, name) for name in order}
    with carrier.edit("lead") as edit:
        for name in order:
            _lead(edit, carrier, name, goals[name])
    for lobe, counts in before.items():
        assert not _gained(counts, _signs(state, lobe))
    assert max(max(_misses(carrier, name, goals[name])) for name in order) < 1e-9
    assert not carrier.check()
    assert not carrier.verify()
    assert edit.report is not None
    assert len(edit.report.relofted) > 20
    carrier.undo()
    assert carrier.fingerprint == print_before


def test_the_order_of_requests_changes_no_place(carrier: Hull) -> None:
    """Two pulls and a re-shape give the same bits in any order."""
    goals = _goals(carrier, "BTK 1")
    asked: list[Callable[[Edit], None]] = [
        lambda edit: _lead(edit, carrier, "BTK 1", goals),
        lambda edit: edit.pull("WL 9 x ST 17", 0.02, fair=True),
        lambda edit: edit.pull("WL 11 x ST 3", -0.01, fair=True),
    ]
    found = []
    for order in ((0, 1, 2), (2, 1, 0), (1, 0, 2)):
        with carrier.edit("in an order") as edit:
            for number in order:
                asked[number](edit)
        state = carrier.document.state
        curves = state.live("curves").tolist()
        found.append([state.spline(curve).xyz.tobytes() for curve in curves])
        carrier.undo()
    assert found[0] == found[1] == found[2]


def test_a_fair_pull_lands_where_it_was_asked_and_nothing_swings_back(carrier: Hull) -> None:
    """The point goes 20 mm along the normal; none goes more than 2 mm the other way."""
    state = carrier.document.state
    row = carrier.points["WL 9 x ST 17"].number
    normal, before = hull_normals(state).copy(), state.rows.xyz.data.copy()
    free = fairable_rows(state)
    with carrier.edit("pull") as edit:
        edit.pull("WL 9 x ST 17", 0.02, fair=True)
    step = ((state.rows.xyz.data - before) * normal).sum(axis=1)
    assert step[row] == pytest.approx(0.02, abs=1e-9)
    assert step[free].min() >= -0.1 * 0.02 - 1e-6
    assert step[free].max() <= 1.1 * 0.02 + 1e-6


def test_what_is_no_free_point_keeps_its_bits(carrier: Hull) -> None:
    """Placed points, flats and the profile stay, and no feature goes."""
    state = carrier.document.state
    with carrier.edit("a placed point") as edit:
        place = _goals(carrier, "BTK 2")[1] - [0.0, 0.0, 0.025]
        edit.insert(carrier.lines["BTK 2"].curves[0], place)
    fixed = on_flat(state) | on_profile(state) | (state.rows.sort.data == Sort.PLACED)
    fixed &= state.rows.alive.data & (state.rows.driver.data < 0)
    before, features = state.rows.xyz.data.copy(), len(carrier.features)
    with carrier.edit("lead") as edit:
        _lead(edit, carrier, "BTK 1", _goals(carrier, "BTK 1"))
    count = len(fixed)
    assert np.array_equal(state.rows.xyz.data[:count][fixed], before[fixed])
    assert len(carrier.features) == features


def test_a_preview_tells_what_the_edit_does(carrier: Hull) -> None:
    """Report and fingerprint of a preview are those of the edit; nothing is published by it."""

    def ask(edit: Edit) -> None:
        edit.pull("WL 9 x ST 17", 0.02, fair=True)

    print_before = carrier.fingerprint
    seen = carrier.preview(ask, measure=False)
    assert carrier.fingerprint == print_before
    with carrier.edit("preview") as edit:
        ask(edit)
    assert seen.fingerprint == carrier.fingerprint
    assert seen.report is not None
    assert edit.report is not None
    assert seen.report.notes == edit.report.notes
    assert "answered fairly within" in edit.report.notes[-2]
    assert "a batten springs there by" in edit.report.notes[-1]


def test_a_driven_crossing_is_pulled_by_its_driver(fresh_series60_70: Hull) -> None:
    """Its driver gets a point there, and the crossing comes about as far as was asked."""
    hull, state = fresh_series60_70, fresh_series60_70.document.state
    table = state.rows
    rows = np.flatnonzero(table.alive.data & (table.driver.data >= 0))
    normal = hull_normals(state)
    row = next(
        int(each) for each in rows
        if 20.0 < table.xyz[each, 0] < 40.0 and 2.0 < table.xyz[each, 2] < 6.0
        and abs(normal[each, 1]) > 0.9
    )  # fmt: skip
    before, outward = table.xyz[row].copy(), normal[row].copy()
    with hull.edit("pull") as edit:
        edit.pull(table.key[row], 0.01, fair=True)
    assert float((table.xyz[row] - before) @ outward) == pytest.approx(0.01, rel=0.05)


def test_lines_that_gain_are_named_with_their_counts(fresh_series60_70: Hull) -> None:
    """Where no fair answer is found, each line that gained stands in the report."""
    hull, state = fresh_series60_70, fresh_series60_70.document.state
    before = _signs(state, 0.2)
    with hull.edit("a bump in the bottom") as edit:
        edit.pull("BTK 0.44 x ST 5", -0.02, fair=True)
    gained = _gained(before, _signs(state, 0.2))
    assert gained, "20 mm so near to the base line cannot be fair"
    assert edit.report is not None
    told = " ".join(edit.report.notes)
    assert "ST 5 has 2 changes of the sign of curvature, 0 before" in told
    assert told.count("changes of the sign") == len(gained)


@pytest.mark.parametrize("how", ["script", "file"])
def test_a_fair_edit_is_repeated_from_what_was_written_down(
    shipped: Shipped, how: str, tmp_path: Path
) -> None:
    """A script solves it anew; a file holds the values. Both give the same hull."""
    carrier = shipped("bulk_carrier")
    with carrier.edit("fair") as edit:
        edit.pull("WL 9 x ST 17", 0.02, fair=True)
    wanted = carrier.fingerprint
    if how == "file":
        path = tmp_path / "fair.hull"
        carrier.save(path)
        reopened = ah.open(path)
        assert reopened.fingerprint == wanted
        reopened.undo()
        reopened.redo()
        assert reopened.fingerprint == wanted
        return
    (said,) = carrier.document.history[-1].script.edits
    assert said["fair"] is True
    carrier.undo()
    carrier.apply("again", [said])
    assert carrier.fingerprint == wanted


def test_a_fair_edit_takes_no_fade_and_leaves_flats(carrier: Hull) -> None:
    """What the answer finds by itself cannot be given beside it; the message says what to do."""
    goals, curve = _goals(carrier, "BTK 1"), carrier.lines["BTK 1"].curves[0]
    refusal = pytest.raises(BadInputError, match="leave fair or across_flats out")
    with refusal, carrier.edit("x") as edit:
        edit.pull("WL 9 x ST 17", 0.02, fair=True, across_flats=True)
    with pytest.raises(BadInputError, match="leave fair or fade out"), carrier.edit("x") as edit:
        edit.reshape(curve, goals, span=_SPAN, fair=True, fade=(5.0, 5.0))
    with pytest.raises(WrongTypeError, match="fair is"), carrier.edit("x") as edit:
        edit.pull("WL 9 x ST 17", 0.02, fair=1)  # type: ignore[arg-type]
    with pytest.raises(PointRoleError), carrier.edit("x") as edit:
        edit.pull("profile x WL 9", 0.02, fair=True)


def test_a_refused_fair_edit_leaves_the_hull_as_it_was(carrier: Hull) -> None:
    """A pull of metres is refused; no bit and no step is left of its trials."""
    print_before, steps = carrier.fingerprint, len(carrier.history)
    with (
        pytest.raises(BadInputError, match="ask for less than"),
        carrier.edit("far too much") as edit,
    ):
        edit.pull("WL 9 x ST 17", 30.0, fair=True)
    assert carrier.fingerprint == print_before
    assert len(carrier.history) == steps
    with carrier.edit("next") as edit:
        edit.pull("WL 9 x ST 17", 0.01, fair=True)
    assert not carrier.check()


_CHANGES: dict[str, Callable[[Edit], object]] = {
    "another place of its line": lambda edit: edit.shift_line("WL 2.5", 2.6),
    "another role": lambda edit: edit.set_role(_POINT, "drives a"),
    "a transformation": lambda edit: edit.transform(
        scale=(1.0, 2.0, 1.0), drivers=["sections", "boundary"]
    ),
}
_POINT = "WL 2.5 x ST 7"


@pytest.mark.parametrize("change", _CHANGES)
@pytest.mark.parametrize("first", [True, False])
def test_what_changes_a_pulled_point_is_refused_in_any_order(change: str, *, first: bool) -> None:
    """Two edits are asked for, and the hull is as it was."""
    hull = ah.examples.wigley()
    before = hull.fingerprint

    def ask(edit: Edit) -> None:
        if first:
            _CHANGES[change](edit)
        edit.pull(_POINT, 0.02, fair=True)
        if not first:
            _CHANGES[change](edit)

    with pytest.raises(BadInputError, match="use two edits"), hull.edit("x") as edit:
        ask(edit)
    assert hull.fingerprint == before


@pytest.mark.parametrize("amounts", [(0.02, -0.02), (1e-17,)])
def test_what_is_so_already_is_no_step(amounts: tuple[float, ...]) -> None:
    """Pulls that undo one another, or that are less than a bit, change nothing."""
    hull = ah.examples.wigley()
    before = hull.fingerprint
    with hull.edit("nothing") as edit:
        for amount in amounts:
            edit.pull(_POINT, amount, fair=True)
    with hull.edit("where it is") as edit:
        line = hull.lines["WL 2.5"].curves[0]
        edit.reshape(line, [hull.points[_POINT].position], span=(20.0, 50.0), fair=True)
    assert hull.fingerprint == before


@pytest.mark.parametrize("amount", [0.02, pytest.param(0.05, marks=long_form)])
@pytest.mark.parametrize(
    "name", ["BTK 0.84 x ST 15.5", pytest.param("BTK 0.76 x ST 15.5", marks=long_form)]
)
def test_a_carried_crossing_comes_as_far_as_it_is_pulled(
    fresh_series60_70: Hull, name: str, amount: float
) -> None:
    """A watched and a driven one, within one in a hundred of what was asked."""
    hull, state = fresh_series60_70, fresh_series60_70.document.state
    row = hull.points[name].number
    normal, spot = hull_normals(state)[row].copy(), state.rows.spot[row, 0].copy()
    with hull.edit("pull") as edit:
        edit.pull(name, amount, fair=True)
    came = float((state.rows.spot[row, 0] - spot) @ normal)
    assert came == pytest.approx(amount, rel=0.0101)
    assert not hull.check()


def test_flats_and_the_profile_are_not_led(carrier: Hull) -> None:
    """A point on the flat of side is refused, and one on the profile, with what was asked for."""
    place = np.array(carrier.points["WL 9 x ST 6"].position)
    place[1] += 0.02
    line = carrier.lines["WL 9"].curves[0]
    with pytest.raises(PointRoleError, match="WL 9 x ST 6 is on a flat"), carrier.edit("x") as edit:
        edit.reshape(line, [place], span=(70.0, 110.0), fair=True)
    with pytest.raises(PointRoleError, match="profile"), carrier.edit("x") as edit:
        edit.pull("ST 0.5 x profile #3", 0.02, fair=True)


def test_a_pull_on_a_flat_is_told_of_one_that_works(fresh_series60_70: Hull) -> None:
    """Across flats only the plain field goes; on the profile that helps nothing."""
    hull = fresh_series60_70
    told = pytest.raises(PointRoleError, match=r"^WL 1 x ST 10 .* across_flats=True, without fair$")
    with told, hull.edit("x") as edit:
        edit.pull("WL 1 x ST 10", 0.01, fair=True)
    with hull.edit("x") as edit:
        edit.pull("WL 1 x ST 10", 0.01, across_flats=True)
    name = next(name for name in hull.points if name.startswith("ST 1 x profile"))
    for fair in (False, True):
        beside = pytest.raises(PointRoleError, match=r"pull a point beside it$")
        with beside, hull.edit("x") as edit:
            edit.pull(name, 0.01, fair=fair)


def test_the_default_radius_is_felt_where_lines_run_along_the_ship() -> None:
    """Amidships chords of waterlines, seen along the ship, are nearly nil: they tell nothing."""
    hull = ah.examples.wigley()
    for name in ("WL 1.25 x ST 10", "WL 2.5 x ST 10", "WL 3.75 x ST 10"):
        with hull.edit("pull") as edit:
            edit.pull(name, 0.02)
        assert edit.report is not None
        assert len(edit.report.relofted) > 3, "more than the lines of the point itself"
        hull.undo()


def test_a_fair_pull_reaches_the_sections_beside_it() -> None:
    """They stand 5 m apart, points of a section half a metre: the radius reaches none of them."""
    hull = ah.examples.wigley()
    beside = ["WL 2.5 x ST 6", "WL 2.5 x ST 8"]
    before = [hull.points[name].y for name in beside]
    with hull.edit("pull") as edit:
        edit.pull("WL 2.5 x ST 7", 0.02, fair=True)
    moved = [hull.points[name].y - y for name, y in zip(beside, before, strict=True)]
    assert min(moved) > 1e-3


def test_a_point_beside_a_flat_by_the_last_digit_is_refused_as_one_on_it() -> None:
    """Measured hulls have such points; what lies off it by more, or at a slope, is none."""
    hull = ah.examples.bulk_carrier_207k()
    state = hull.state
    rows = fairable_rows(state)
    level = level_with_flats(state, rows, hull_normals(state)[rows])
    off = np.abs(state.rows.xyz.data[rows, 1] - 0.5 * hull.particulars.breadth)
    assert level.any()
    assert (off[level] < 1e-3).all()
    assert not level_with_flats(state, rows, np.tile([0.01, 1.0, 0.0], (len(rows), 1))).any()
    name = address(state, int(rows[level][0]))
    with pytest.raises(PointRoleError, match="on a flat"), hull.edit("pull") as edit:
        edit.pull(name, 0.02, fair=True)

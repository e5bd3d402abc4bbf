"""A preview tells what the edit then does: lines, movements, causes, fingerprint."""

import copy
import gc
import pickle
import weakref

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.explain.preview import line_changes
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from tests.properties.test_program_edits import Count, by_program

POINT = "WL 2.5 x ST 7"
PULL = [{"op": "pull", "point": POINT, "d": 0.02, "radius": (25.0, 3.0)}]


@pytest.fixture
def hull() -> ah.Hull:
    """A small net of this test's own."""
    return ah.examples.wigley(stations=11, waterlines=6)


def places(hull: ah.Hull) -> dict[str, tuple[float, ...]]:
    """Where every point is."""
    return {point.id: tuple(point.position.tolist()) for point in hull.points.values()}


def test_lines_are_those_the_edit_changes(hull: ah.Hull) -> None:
    """Group by group in the order of the ranks, along each by position; each by as much."""
    before = places(hull)
    found = hull.preview(PULL)
    assert places(hull) == before
    hull.apply("pull", PULL)
    curves = [hull.find(key) for key in hull.history[-1].relofted]
    names = {each.line.name for each in curves if isinstance(each, ah.Curve)}
    assert {each.line for each in found.lines} == names
    groups = [each.group for each in found.lines]
    assert groups == sorted(groups), "sections come before waterlines"
    sections = [each.line for each in found.lines if each.group == "sections"]
    assert sections == sorted(sections, key=lambda name: int(name.split()[1]))
    for each in found.lines:
        points = [point for point in hull.lines[each.line].points if point.id in before]
        moved = [np.linalg.norm(np.subtract(places(hull)[p.id], before[p.id])) for p in points]
        assert each.distance == pytest.approx(max(moved), abs=1e-12)
        assert each.point is not None
        assert each.place == places(hull)[hull.points[each.point].id]


def test_a_line_on_which_no_point_moves_is_measured_between_them(hull: ah.Hull) -> None:
    """An end condition bends the curve between its points: how far, and where."""
    bend = {"op": "set_end", "curve": "WL 2.5", "end": "start", "tangent": (1, 0.2, 0)}
    found = hull.preview([bend])
    (line,) = found.lines
    assert (line.group, line.line, line.point) == ("waterlines", "WL 2.5", None)
    assert line.distance is not None
    assert line.place is not None
    assert 1e-6 < line.distance < 1.0
    assert hull.lines["WL 2.5"].curves[0].closest(line.place)[2] == pytest.approx(line.distance)


def test_a_new_line_has_no_movement(hull: ah.Hull) -> None:
    """It was nowhere before; what is born on the others is no movement either."""
    found = hull.preview([{"op": "add_line", "group": "waterlines", "position": 3.0}])
    new = [each for each in found.lines if each.line not in hull.lines]
    assert [(each.group, each.distance) for each in new] == [("waterlines", None)]


def test_the_fingerprint_is_that_of_the_edited_hull(hull: ah.Hull) -> None:
    """And the hull keeps its own."""
    before, found = hull.fingerprint, hull.preview(PULL)
    assert hull.fingerprint == before
    hull.apply("pull", PULL)
    assert found.fingerprint == hull.fingerprint


def test_causes_are_those_the_edit_would_leave(hull: ah.Hull) -> None:
    """Asked by address or handle; named by what was asked; the step is the next one."""
    hull.apply("first", [{"op": "move", "point": POINT, "y": hull.points[POINT].y + 0.01}])
    section = hull.lines["ST 7"]
    found = hull.preview(PULL, name="pull", why=["ST 7", section])
    assert set(found.why) == {"ST 7", section.id}
    hull.apply("pull", PULL)
    assert found.why["ST 7"] == found.why[section.id] == hull.why("ST 7")
    assert (found.why["ST 7"].edit, found.why["ST 7"].step) == ("pull", 2)


def test_what_is_asked_for_must_be_there(hull: ah.Hull) -> None:
    """Else nothing has happened, and the next edit can begin."""
    before = hull.fingerprint
    with pytest.raises(UnknownNameError):
        hull.preview(PULL, why=["WL 77"])
    with pytest.raises(WrongTypeError):
        hull.preview(PULL, why="WL 2.5")
    assert hull.fingerprint == before
    assert hull.preview(PULL).refused == ()


def test_a_refused_edit_has_reasons_only(hull: ah.Hull) -> None:
    """No lines, no causes, no fingerprint."""
    found = hull.preview([{"op": "move", "point": POINT, "y": 40.0}], why=["ST 7"])
    assert found.report is None
    assert len(found.refused) > 0
    assert (found.lines, found.why, found.fingerprint) == ((), {}, None)


def test_without_a_step_no_line_changes(hull: ah.Hull) -> None:
    """An edit that asks for what is so already."""
    assert line_changes(hull.state, None) == ()
    found = hull.preview([{"op": "move", "point": POINT, "y": hull.points[POINT].y}])
    assert found.lines == ()
    assert found.fingerprint == hull.fingerprint


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"op": "move", "point": POINT, "x": 1.0}, "x"),
        ({"op": "move", "point": POINT, "y": float("nan")}, "finite"),
        ({"op": "set_role", "crossing": POINT, "role": "sideways"}, "role"),
        ({"op": "delete", "point": POINT}, ""),
    ],
    ids=["not free", "no number", "no role", "delete"],
)
def test_what_an_edit_refuses_is_a_value(
    change: dict[str, object], words: str, hull: ah.Hull
) -> None:
    """With the words of the edit's own error; the hull is as it was."""
    before = hull.fingerprint
    found = hull.preview([change])
    with pytest.raises(ah.AssocHullError) as refused:
        hull.apply("it", [change])
    findings = getattr(refused.value, "findings", (str(refused.value),))
    assert found.refused == tuple(findings)
    assert words in found.refused[0]
    assert hull.fingerprint == before


def test_shapes_are_those_the_edit_would_leave(hull: ah.Hull) -> None:
    """Of the curves that change, when asked; without measuring nothing is known of the volume."""
    found = hull.preview(PULL, shapes=True, measure=False)
    assert found.volume_change is None
    assert found.shapes is not None
    report = hull.apply("pull", PULL)
    assert report is not None
    after = hull.shapes()
    rows = np.searchsorted(after.curves, found.shapes.curves)
    assert {hull.state.curves.key[each] for each in found.shapes.curves} == set(report.relofted)
    want = np.concatenate([after.spline.part(row, row + 1).xyz for row in rows.tolist()])
    np.testing.assert_array_equal(found.shapes.spline.xyz, want)
    assert hull.preview([]).shapes is None


def test_a_fair_answer_is_seen_beside_the_plain_field(series60_70: ah.Hull) -> None:
    """Shapes and sign changes of both: each as if it were asked for alone."""
    asked = {"op": "pull", "point": "WL 0.75 x ST 15", "d": 0.02}
    both = series60_70.preview([{**asked, "fair": True}], shapes=True)
    alone = series60_70.preview([asked], shapes=True)
    assert alone.plain is None
    assert both.plain is not None
    assert (both.plain.fingerprint, both.plain.lines) == (alone.fingerprint, alone.lines)
    one, other = both.plain.shapes, alone.shapes
    assert one is not None
    assert other is not None
    np.testing.assert_array_equal(one.spline.xyz, other.spline.xyz)
    assert both.report is not None
    assert both.plain.report is not None
    assert (both.report.inflections, len(both.plain.report.inflections)) == ((), 2)
    assert str(both).endswith("; 0 new changes of the sign of curvature, 4 with the plain field")
    again = pickle.loads(pickle.dumps(both))
    assert again.plain.report.inflections == both.plain.report.inflections


def test_both_tell_why_they_are_refused(hull: ah.Hull) -> None:
    """By 9 m neither goes: both say why."""
    found = hull.preview([{"op": "pull", "point": POINT, "d": 9.0, "fair": True}], measure=False)
    assert found.refused
    assert found.plain is not None
    assert found.plain.refused


def test_a_preview_waits_for_the_end_of_an_open_edit(hull: ah.Hull) -> None:
    """It would show what that edit has not published."""
    with hull.edit("open"), pytest.raises(BadInputError, match="an edit is open"):
        hull.preview(PULL)


def test_hulls_and_previews_go_to_other_processes() -> None:
    """By pickle or as a copy, with all that they can tell, and are edited there."""
    hull = ah.examples.wigley()
    with by_program(Count(), always=True):
        for number in range(3):
            with hull.edit(f"edit {number}") as edit:
                edit.move("WL 3.75 x ST 9", y=3.9 + 0.01 * number)
    found = hull.preview(PULL)
    again = pickle.loads(pickle.dumps(found))
    assert (again.lines, again.volume_change) == (found.lines, found.volume_change)
    assert again.fingerprint == found.fingerprint
    assert str(again.report) == str(found.report)
    for other in (pickle.loads(pickle.dumps(hull)), copy.deepcopy(hull), hull.snapshot()):
        assert other.fingerprint == hull.fingerprint
        with other.edit("there") as edit:
            edit.move("WL 3.75 x ST 9", y=3.85)
        assert other.points["WL 3.75 x ST 9"].y == 3.85
        assert other.verify() == ()
    assert hull.points["WL 3.75 x ST 9"].y == 3.92


def test_a_preview_that_nobody_has_leaves_the_tables_to_the_next_edit(hull: ah.Hull) -> None:
    """Else what it shares would be copied by whoever writes next, whole columns at a time."""
    point = next(key for key, each in hull.points.items() if each.free == ("y",))
    asked = [{"op": "move", "point": point, "y": hull.points[point].y + 1e-3}]
    gc.disable()
    try:
        seen = hull.preview(asked)
        assert not seen.refused
        assert seen._seen is not None
        states = weakref.ref(seen._seen.after)
        del seen
        assert states() is None
    finally:
        gc.enable()

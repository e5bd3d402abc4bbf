"""Definitions become curves in the units of the ship, or are refused with what would do."""

from __future__ import annotations

import re

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, OutOfRangeError, UnknownNameError
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.courses import course_vertices
from assoc_hull.model.forms.form_values import Forms, chain_of
from assoc_hull.model.tables import Particulars
from tests.form_ship import AREAS, PARTICULARS, course, plain_ship

UNIT = Particulars("two long", 2.0, 2.0, 2.0, 1.0)

TYPE1: dict[str, float | None] = {
    "full": 1.0, "run_start_angle_deg": 60.0, "run_start_curvature": -2.0, "run_end": -0.3,
    "run_area": 0.55, "run_centroid": -0.59, "entrance_start": 0.2, "entrance_area": 0.6,
    "entrance_centroid": 0.52, "entrance_end_angle_deg": -50.0, "entrance_end_curvature": -2.0,
}  # fmt: skip

SHIPS_AREAS = (
    6.080000, 17.968035, 41.267184, 69.655946, 100.138193, 163.836942, 222.351781, 264.215741,
    284.909891, 291.767568, 292.59, 292.59, 292.59, 292.59, 292.59, 292.59, 292.237671, 285.780666,
    262.435107, 216.081681, 150.103105, 111.910901, 71.796116, 31.623908, 0.0,
)  # fmt: skip


def areas(values: dict[str, float | None]) -> FormDefinition:
    """A curve of areas of other values."""
    return FormDefinition("areas", "sectional_area", "halves", values)


def test_printed_vertices_of_two_halves() -> None:
    """Run and entrance of the first printed design have the printed vertices (12 digits)."""
    run, middle, entrance = chain_of(areas(TYPE1), UNIT).vertices
    assert run[:, 0] - 1.0 == pytest.approx(
        [-1.062849536644, -1.006720717977, -0.910267591447, -0.922173590026, -0.452581945197,
         -0.3, -0.147418054803], abs=1e-12)  # fmt: skip
    assert entrance[3] - [1.0, 0.0] == pytest.approx([0.879961592759, 0.750897142971], abs=1e-12)
    assert middle[:, 1].tolist() == [1.0] * 7


def test_printed_areas_of_the_ship() -> None:
    """The curve of areas of the 180 m ship has the printed areas at its 25 sections (6 digits)."""
    stations = np.array([0, 0.5, 1, 1.5, *range(2, 19), 18.5, 19, 19.5, 20]) * 9.0
    found = Forms.of([AREAS], PARTICULARS).value("sectional_area", stations)
    assert found == pytest.approx(SHIPS_AREAS, abs=6e-7)


def test_no_parallel_part_where_the_halves_meet() -> None:
    """Where the run ends where the entrance starts there are two pieces."""
    values = {**TYPE1, "run_end": 0.2, "run_area": 0.75, "run_centroid": None}
    assert chain_of(areas(values), UNIT).count == 2


@pytest.mark.parametrize(
    ("change", "name", "text"),
    [
        pytest.param({"run_end": 0.4}, "run_end", "not between", id="run past the entrance"),
        pytest.param(
            {"entrance_start": -0.9}, "entrance_start", "not between", id="entrance before the run"
        ),
        pytest.param(
            {"run_area": 0.8}, "run_area", "area outside the box", id="area outside the box"
        ),
        pytest.param(
            {"run_centroid": -0.2}, "run_centroid", "moment outside", id="moment outside the box"
        ),
        pytest.param({"run_centroid": -0.62}, "run_centroid", "fold back", id="fold"),
        pytest.param(
            {"entrance_area": 0.79}, "entrance_area", "fold back|outside", id="too full an entrance"
        ),
    ],
)  # fmt: skip
def test_refused_values_of_halves(change: dict[str, float | None], name: str, text: str) -> None:
    """What no curve has is refused; all of the interval that the error tells can be had."""
    values = {**TYPE1, **change}
    with pytest.raises(OutOfRangeError, match="definition 'areas'") as caught:
        chain_of(areas(values), UNIT)
    assert re.search(text, str(caught.value))
    assert caught.value.name == name
    least, most = caught.value.least, caught.value.most
    asked = values[name]
    assert asked is not None
    assert least < most
    for share in np.linspace(0.0, 1.0, 21):
        chain_of(areas({**values, name: float(least + share * (most - least))}), UNIT)


def test_a_tangent_is_a_length() -> None:
    """A tangent below 0 is refused."""
    with pytest.raises(OutOfRangeError, match="run_end_tangent"):
        chain_of(areas({**TYPE1, "run_end_tangent": -1.0}), UNIT)


def test_nothing_can_be_told() -> None:
    """Where no area and no centroid would do, the tangents are named."""
    values = {
        **TYPE1, "run_area": 0.22, "run_start_angle_deg": 64.0, "run_start_curvature": -3.5,
        "run_start_tangent": 0.46, "run_end_tangent": 0.88, "run_centroid": -0.816,
    }  # fmt: skip
    with pytest.raises(BadInputError, match="other tangents than 0"):
        chain_of(areas(values), UNIT)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        pytest.param({"full": None}, "full is None", id="no full"),
        pytest.param({"run_end": None}, "run_end is None", id="a needed value"),
        pytest.param({"run_area": None}, "give both", id="centroid without area"),
    ],
)
def test_missing_values_of_halves(change: dict[str, float | None], text: str) -> None:
    """What is needed and missing is named."""
    with pytest.raises(BadInputError, match=text):
        chain_of(areas({**TYPE1, **change}), UNIT)


def test_run_that_folds_back() -> None:
    """A run with two areas at one abscissa is refused: the second printed design, a trifle."""
    values = {
        **TYPE1, "run_end": -0.1, "run_start_curvature": 0.0, "run_area": 0.775,
        "run_centroid": -0.5,
    }  # fmt: skip
    with pytest.raises(OutOfRangeError, match="fold back"):
        chain_of(areas(values), UNIT)
    chain_of(areas({**values, "run_start_tangent": 0.085, "run_end_tangent": 0.538}), UNIT)


def test_rules_of_courses() -> None:
    """Straight is straight, monotone has no overshoot, a form course keeps angles and corners."""
    nodes = {"a": (0.0, 0.0), "b": (10.0, 4.0), "c": (30.0, 4.0), "d": (40.0, 1.0)}
    x = np.linspace(0.0, 40.0, 161)
    straight = Forms.of([course("deck_side", nodes, "straight")], PARTICULARS)
    assert straight.value("deck_side", x) == pytest.approx(
        np.interp(x, [0, 10, 30, 40], [0, 4, 4, 1]), abs=1e-12
    )
    smooth = Forms.of([course("deck_side", nodes, "monotone")], PARTICULARS).value("deck_side", x)
    assert smooth.max() <= 4.0 + 1e-12
    assert smooth[40:121] == pytest.approx(np.full(81, 4.0), abs=1e-12)
    turned = {**nodes, "c": (30.0, 4.0, 0.0, 0.0, 1.0, -30.0)}
    chain = chain_of(course("deck_side", turned), PARTICULARS)
    before, after = chain.tangent(np.array([1, 2]), np.array([4.0, 0.0]))
    assert before[1] == pytest.approx(0.0, abs=1e-12)
    assert np.degrees(np.arctan2(after[1], after[0])) == pytest.approx(-30.0)


def test_level_between_level_nodes() -> None:
    """A form course with both angles along the chord is straight: a keel needs nothing else."""
    keel = course("profile", {"a": (8.0, 0.0, 0.0), "b": (170.0, 0.0, 0.0)})
    assert np.abs(course_vertices(keel)[..., 1]).max() == 0.0


def test_held_and_ended() -> None:
    """Angles hold beyond their ends; a deck edge does not; one node is a constant."""
    forms = plain_ship(course("keel_tangent", {"all": (0.0, 0.7)}))
    assert forms.value("keel_angle", np.array([-9.0, 300.0])).tolist() == [86.0, 20.0]
    assert np.isnan(forms.value("deck_side", np.array([-9.0])))[0]
    assert forms.value("keel_tangent", np.array([-50.0, 200.0])).tolist() == pytest.approx(
        [0.7, 0.7]
    )


@pytest.mark.parametrize(
    ("definition", "text"),
    [
        pytest.param(
            course("deck_side", {"a": (0.0, 1.0), "b": (0.0, 1.0)}), "in one place", id="one place"
        ),
        pytest.param(
            course("deck_side", {"a": (9.0, 1.0), "b": (0.0, 1.0)}), "folds back", id="backward"
        ),
        pytest.param(
            course("deck_side", {"a": (9.0, 1.0), "b": (0.0, 1.0)}, "monotone"), "not lie ahead",
            id="backward and monotone",
        ),
        pytest.param(
            course("deck_side", {"a": (0.0, 1.0, 5.0), "b": (1.0, 1.0)}, "straight"), "straight",
            id="an angle to a straight one",
        ),
        pytest.param(course("deck_side", {}), "no nodes", id="no nodes"),
        pytest.param(course("deck_side", {"a": (0.0,)}), "a_y is None", id="half a node"),
    ],
)  # fmt: skip
def test_refused_courses(definition: FormDefinition, text: str) -> None:
    """Courses that are none are refused by name."""
    with pytest.raises(BadInputError, match=text):
        chain_of(definition, PARTICULARS)


def test_what_no_use_has_is_no_definition() -> None:
    """A use is one of those that are known, and has its kind."""
    with pytest.raises(UnknownNameError, match="use of a definition"):
        course("no_such_use", {"a": (0.0, 0.0)})
    with pytest.raises(BadInputError, match="is of 'halves'"):
        course("sectional_area", {"a": (0.0, 0.0)})


def test_two_for_one_use() -> None:
    """No two definitions serve one use."""
    with pytest.raises(BadInputError, match="already"):
        Forms.of([AREAS, AREAS], PARTICULARS)


def test_a_spline_has_continuous_second_derivatives_and_none_at_its_ends() -> None:
    """Slopes are those of the natural cubic spline; a given angle parts it, as a corner does."""
    nodes = {"a": (0.0, 1.0), "b": (2.0, 3.0), "c": (3.0, 2.0), "d": (7.0, 4.0)}
    found = course_vertices(spline_course(nodes))
    # Of a piece of width w, by x: 16 / w^2 times the second derivative by t.
    ends = np.stack([found[:, 0] - 2 * found[:, 1] + found[:, 2],
                     found[:, 4] - 2 * found[:, 5] + found[:, 6]], axis=1)[..., 1]  # fmt: skip
    second = ends * 16.0 / np.array([2.0, 1.0, 4.0])[:, None] ** 2
    assert second[1:, 0] == pytest.approx(second[:-1, 1], abs=1e-12)
    assert [second[0, 0], second[-1, 1]] == pytest.approx([0.0, 0.0], abs=1e-12)


def test_a_spline_keeps_the_slope_that_is_given_and_leaves_a_corner_anew() -> None:
    """At the angle of a node, and with another one after a corner."""
    level = FormDefinition(
        "angle", "keel_angle", "course",
        {"a_x": 0.0, "a_y": 1.0, "b_x": 2.0, "b_y": 3.0, "b_angle_deg": 0.0,
         "b_leave_angle_deg": 45.0, "c_x": 3.0, "c_y": 2.0}, "spline", ("a", "b", "c"),
    )  # fmt: skip
    chain = chain_of(level, PARTICULARS)
    assert chain.tangent(0, 4.0)[0, 1] == pytest.approx(0.0, abs=1e-12)
    leaving = chain.tangent(1, 0.0)[0]
    assert leaving[1] == pytest.approx(leaving[0], rel=1e-12)


def test_nodes_of_a_spline_out_of_order_are_refused() -> None:
    """With the node that is."""
    with pytest.raises(BadInputError, match="'b' does not lie ahead"):
        course_vertices(spline_course({"a": (2.0, 1.0), "b": (1.0, 3.0)}))


def spline_course(nodes: dict[str, tuple[float, float]]) -> FormDefinition:
    """A course by the rule spline."""
    values = {
        f"{label}_{axis}": v
        for label, at in nodes.items()
        for axis, v in zip("xy", at, strict=True)
    }
    return FormDefinition("angle", "keel_angle", "course", values, "spline", tuple(nodes))

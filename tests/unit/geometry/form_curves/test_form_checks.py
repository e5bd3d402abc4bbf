"""What is said about the parameters of form-parameter curves, and about their shapes."""

import math

import attrs
import numpy as np
import pytest

from assoc_hull.geometry.form_curves.checks import (
    area_limits,
    centroid_box,
    centroid_limits,
    check_parameters,
    check_shape,
)
from assoc_hull.geometry.form_curves.curve import FormParameters, form_values
from tests.form_curves import CURVES

FINE = FormParameters(0.0, 0.0, 0.5, 0.0, 0.3, 0.0, 1.0, 1.0, 1.1, 0.0, 0.3, 0.0, 0.4, 0.6)


def codes(curve: FormParameters) -> dict[str, str]:
    """Codes and severities."""
    return {each.code: each.severity for each in check_parameters(curve)}


def published(name: str) -> tuple[FormParameters, np.ndarray]:
    """A curve of table 2."""
    vertices = np.array(CURVES[name]["P"])
    return FormParameters.of(form_values(vertices[None])), vertices


@pytest.mark.parametrize(
    ("name", "want"),
    [
        ("T1_run", {"C6": "info"}),
        ("T1_ent", {"C5.1": "info"}),
        ("T2_run", {"C6": "info"}),
        ("T2_ent", {"C5.1": "info"}),
    ],
)
def test_the_published_curves(name: str, want: dict[str, str]) -> None:
    """None violates C1 to C4s, each needs an inflection; one runs back by a trifle."""
    curve, vertices = published(name)
    assert codes(curve) == want
    told = check_shape(vertices)
    shape = {each.code: each.severity for each in told}
    assert ("by a centroid in [-0.4999" in told[0].text) == (name == "T2_run")
    assert shape.pop("inflections") == "warning"
    assert shape == ({"back": "warning"} if name == "T2_run" else {})


def test_the_numbers_of_the_published_conditions() -> None:
    """Chords of 51.340 and 42.274 degrees; areas without inflection up to .41132 and .61132."""
    told = {
        name: " ".join(each.text for each in check_parameters(published(name)[0]))
        for name in CURVES
    }
    assert "its chord at 51.3402 deg" in told["T1_ent"]
    assert "starts at 50 deg" in told["T1_ent"]
    assert "its chord at 42.2737 deg" in told["T2_ent"]
    assert "area 0.55 " in told["T1_run"]
    assert "0.41132487]" in told["T1_run"]
    assert "area 0.775 " in told["T2_run"]
    assert "0.61132487]" in told["T2_run"]


def test_the_moment_is_taken_about_the_start() -> None:
    """About x = 0, as it was printed, all four curves would be refused."""
    for name in CURVES:
        curve = published(name)[0].rising
        squares = curve.finish_x**2 - curve.start_x**2
        low, high = 0.5 * curve.start_y * squares, 0.5 * curve.finish_y * squares
        assert not low <= curve.area * curve.centroid <= high


CASES = {
    "a sound curve": ({}, {}),
    "a finish behind the start": ({"finish_x": -1.0}, {"C0": "error"}),
    "a tangent of nothing": ({"start_tangent": 0.0}, {"C0": "error"}),
    "an angle that folds back": ({"start_angle": -0.1}, {"C1": "warning"}),
    "a level start that bends down": (
        {"start_angle": 0.0, "start_curvature": -0.1}, {"C2": "warning", "C5.1": "info"},
    ),
    "a level start that bends up": ({"start_angle": 0.0, "start_curvature": 0.1}, {}),
    "an upright finish that bends right": (
        {"finish_angle": math.pi / 2, "finish_curvature": -0.1},
        {"C2": "warning", "C5.1": "info"},
    ),
    "an upright start that bends left": (
        {"start_angle": math.pi / 2, "start_curvature": 0.1, "finish_angle": 0.0, "area": 0.6},
        {"C2": "warning", "C5.2": "info"},
    ),
    "a level finish that bends up": (
        {"start_angle": 1.2, "finish_angle": 0.0, "finish_curvature": 0.1, "area": 0.6},
        {"C2": "warning", "C5.2": "info"},
    ),
    "an area outside the box": ({"area": 1.1, "centroid": 0.4}, {"C3": "error", "C6": "info"}),
    "a moment outside the box": (
        {"area": 0.9, "centroid": 0.6}, {"C4": "error", "C4s": "warning", "C6": "info"},
    ),
    "a centroid no rising curve has": ({"centroid": 0.81}, {"C4s": "warning"}),
    "a straight start that does not stay so": ({"start_angle": math.pi / 4}, {"C5.3": "info"}),
    "straight": (
        {"start_angle": math.pi / 4, "finish_angle": math.pi / 4, "area": 0.5, "centroid": 2 / 3},
        {},
    ),
    "nothing known of the area": ({"area": math.nan, "centroid": math.nan}, {}),
}  # fmt: skip


@pytest.mark.parametrize(("changes", "want"), CASES.values(), ids=CASES)
def test_each_condition(changes: dict[str, float], want: dict[str, str]) -> None:
    """One change of a sound curve, and what is said of it; the mirrored curve hears the same."""
    curve = attrs.evolve(FINE, **changes)
    assert codes(curve) == want
    if "C0" not in want:
        assert codes(curve.mirrored()) == want


def test_intervals_are_told_in_the_frame_of_the_curve() -> None:
    """A falling curve is mirrored to be judged; what is allowed is told as it was given."""
    falling = attrs.evolve(FINE, centroid=0.81).mirrored()
    (message,) = check_parameters(falling)
    assert message.text.endswith("allowed in [-0.8, -0.2]")
    assert str(message).startswith("C4s warning: no monotone curve has its centroid at -0.81")


def test_centroid_limits_are_sharp() -> None:
    """Both bounds are those of curves of two steps; within them lie those of a thousand others."""
    rng = np.random.default_rng(1)
    steps = np.sort(rng.uniform(0.0, 1.0, (1000, 40)), axis=1)
    middles = (np.arange(40) + 0.5) / 40
    for row in steps:
        area = row.sum() / 40
        low, high = centroid_limits((0.0, 0.0), (1.0, 1.0), area)
        assert low <= (row * middles).sum() / 40 / area <= high
    assert centroid_limits((0.0, 0.0), (1.0, 1.0), 0.25) == pytest.approx((0.125, 0.875))
    assert centroid_box((0.0, 0.0), (1.0, 1.0), 0.25) == pytest.approx((0.0, 2.0))
    assert area_limits((0.0, 1.0), (2.0, 0.25)) == (0.5, 2.0)
    assert np.isnan(centroid_limits((0.0, 1.0), (1.0, 1.0), 1.0)).all()


def test_shapes_with_faults() -> None:
    """A loop, a curve below its box, one that runs back; and a sound one."""
    loop = np.array([[0, 0], [1, 0], [4, 1], [2, 3], [0, 1], [3, 0], [4, 0]], float)
    assert {each.code for each in check_shape(loop)} >= {"loop", "back", "box"}
    dip = np.array([[0, 0], [1, 0], [2, -1], [3, -1], [4, 1], [5, 2], [6, 3]], float)
    assert [each.code for each in check_shape(dip)] == ["box", "inflections"]
    round_ = np.array([[-1, -1], [0, 0], [1, 1], [2, 1.7], [3, 2.2], [4, 2.4], [5, 2.5]])
    assert check_shape(round_) == ()

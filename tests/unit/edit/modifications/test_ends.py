"""End conditions: a direction, a curvature, or nothing."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, UnknownNameError
from tests.net_strategies import fresh, refused


@pytest.fixture
def hull() -> ah.Hull:
    """A net of three families of its own."""
    return fresh(2)


@pytest.mark.parametrize("end", ["start", "finish"])
def test_a_curve_leaves_in_the_given_direction(hull: ah.Hull, end: str) -> None:
    """Of any length; only this curve and what it drives is lofted."""
    curve = hull.lines["ST 3"].curves[0]
    with hull.edit("end") as edit:
        edit.set_end(curve, end, tangent=(0.0, 3.0, 4.0))
    at = 0.0 if end == "start" else curve.span
    assert curve.tangent(at) == pytest.approx([0.0, 0.6, 0.8], abs=1e-12)
    assert edit.report is not None
    assert curve.id in edit.report.relofted
    assert hull.verify() == ()


def test_a_curve_takes_the_given_curvature(hull: ah.Hull) -> None:
    """The second derivative with respect to chord length."""
    curve = hull.lines["ST 3"].curves[0]
    with hull.edit("end") as edit:
        edit.set_end("ST 3", "finish", curvature=(0.0, 0.05, -0.02))
    spline, h = curve.spline, 1e-3
    last = [curve.at(curve.span - k * h) for k in range(4)]
    second = (2.0 * last[0] - 5.0 * last[1] + 4.0 * last[2] - last[3]) / h**2
    assert len(spline.knot) > 3
    assert second == pytest.approx([0.0, 0.05, -0.02], abs=1e-5)


def test_an_end_is_free_again_without_either(hull: ah.Hull) -> None:
    """To the bits of before."""
    before = hull.lines["ST 3"].curves[0].spline.leave.tobytes()
    with hull.edit("given") as edit:
        edit.set_end("ST 3", "start", tangent=(0.0, 1.0, 1.0))
    with hull.edit("free") as edit:
        edit.set_end("ST 3", "start")
    assert hull.lines["ST 3"].curves[0].spline.leave.tobytes() == before


def test_both_ends_are_kept_apart(hull: ah.Hull) -> None:
    """Setting one leaves the other as it was."""
    curve = hull.lines["ST 3"].curves[0]
    with hull.edit("both") as edit:
        edit.set_end(curve, "start", tangent=(0.0, 1.0, 0.5))
        edit.set_end(curve, "finish", tangent=(0.0, 0.1, 1.0))
    for at, slope in ((0.0, (0.0, 1.0, 0.5)), (curve.span, (0.0, 0.1, 1.0))):
        assert np.cross(curve.tangent(at), slope) == pytest.approx(np.zeros(3), abs=1e-12)


@pytest.mark.parametrize(
    ("given", "word"),
    [
        pytest.param({"end": "middle"}, "middle", id="no end"),
        pytest.param({"tangent": (0, 1, 1), "curvature": (0, 1, 1)}, "both", id="both"),
        pytest.param({"tangent": (0, 0, 0)}, "length", id="no length"),
        pytest.param({"tangent": (0, 1)}, "(x, y, z)", id="two numbers"),
        pytest.param({"curvature": (0, np.nan, 1)}, "not finite", id="not a number"),
    ],
)
def test_bad_ends(hull: ah.Hull, given: dict[str, object], word: str) -> None:
    """Each says what would do."""
    end = given.pop("end", "start")
    text = refused(hull, lambda edit: edit.set_end("ST 3", end, **given), BadInputError)  # type: ignore[arg-type]
    assert word in text


def test_an_unknown_curve(hull: ah.Hull) -> None:
    """Near names are told."""
    text = refused(hull, lambda edit: edit.set_end("ST 33", "start"), UnknownNameError)
    assert "ST 3" in text

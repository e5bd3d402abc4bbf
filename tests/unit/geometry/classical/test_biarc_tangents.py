"""Tangents at points: published angles, straight runs, knuckles, given ends, refusals."""

from collections.abc import Callable
from typing import cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.biarc_chain import TangentForm, biarc_tangents
from assoc_hull.geometry.classical.checked_input import wrap_angle
from assoc_hull.geometry.curves import FloatArray

FIVE = np.array([[0, 0], [1, 0.8], [2.5, 1.5], [4, 1.7], [6, 1.2]])
ROW = [[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]
CORNER = [*ROW, [3.0, 1.0], [3.0, 2.0]]


def test_published_angles_of_five_points() -> None:
    """In chord length: all digits of the five angles; with an upright start, of the second."""
    angles = [
        0.7760269671244119, 0.5709486017665097, 0.2777218976323482, -0.026921837151985498,
        -0.44649097582064984,
    ]  # fmt: skip
    assert_allclose(biarc_tangents(FIVE).leaving_angles, angles, rtol=1e-14)
    upright = biarc_tangents(FIVE, start=(0.0, 3.0))
    assert_allclose(upright.leaving_angles[0], np.pi / 2)
    assert_allclose(upright.leaving_angles[1], -0.22131444234779127, rtol=1e-14)
    assert_allclose(upright.leaving_angles[2:], angles[2:], rtol=1e-14)


def test_published_slopes_of_the_graph() -> None:
    """As y(x): both first slopes; mirrored in x the line has mirrored tangents."""
    found = biarc_tangents(FIVE, form="graph")
    slopes = found.leaving[:, 1] / found.leaving[:, 0]
    assert_allclose(slopes[:2], [0.9333333333333333, 0.6666666666666667], rtol=1e-14)
    back = biarc_tangents(FIVE * [-1, 1], form="graph")
    assert_allclose(back.leaving, found.leaving * [-1, 1], atol=1e-15)


def test_a_graph_takes_given_slopes_linearly() -> None:
    """y2' = 2 D - y1', exact for a parabola at all of its points."""
    x = np.array([0.0, 1.0, 3.0, 4.5])
    points = np.stack([x, x * x], axis=1)
    found = biarc_tangents(points, form="graph", start=(1.0, 0.0), end=(2.0, 18.0))
    assert_allclose(found.leaving[:, 1] / found.leaving[:, 0], 2.0 * x, atol=1e-14)
    back = biarc_tangents(points[::-1], form="graph", start=(-2.0, -18.0))
    assert_allclose(back.leaving[:2], -found.leaving[:1:-1], atol=1e-14)
    two = biarc_tangents(points[:2], form="graph", end=(1.0, 2.0))
    assert_allclose(two.leaving[0], [1.0, 0.0], atol=1e-15)


def on_circle(turns: FloatArray) -> FloatArray:
    """Points of a circle of radius 3 about (1, 2)."""
    return np.array([1.0, 2.0]) + 3.0 * np.stack([np.cos(turns), np.sin(turns)], axis=1)


def along_circle(turns: FloatArray) -> FloatArray:
    """Unit tangents there."""
    return np.stack([-np.sin(turns), np.cos(turns)], axis=1)


@given(
    st.lists(st.floats(0.05, 0.7), min_size=2, max_size=8), st.floats(-3.0, 3.0), st.booleans(),
    st.booleans(),
)  # fmt: skip
def test_on_a_circle_tangents_are_exact(
    steps: list[float], first: float, begins: bool, ends: bool
) -> None:
    """Inside always, however points are spaced; at the ends too where one is given."""
    turns = first + np.concatenate([[0.0], np.cumsum(steps)])
    wanted = along_circle(turns)
    found = biarc_tangents(
        on_circle(turns), start=wanted[0] if begins else None, end=wanted[-1] if ends else None
    )
    inner = slice(None if begins else 1, None if ends else -1)
    assert_allclose(found.leaving[inner], wanted[inner], atol=1e-12)
    assert_allclose(found.arriving[inner], wanted[inner], atol=1e-12)


def test_elsewhere_they_are_of_second_order() -> None:
    """Halving the spacing on an ellipse divides the error by four, at the ends too."""
    errors = []
    for count in (20, 40, 80):
        t = np.linspace(0.0, 1.4, count + 1) + 0.2 / count * np.sin(np.arange(count + 1.0))
        found = biarc_tangents(np.stack([5 * np.cos(t), 2 * np.sin(t)], axis=1))
        true = np.arctan2(2 * np.cos(t), -5 * np.sin(t))
        errors.append(np.abs(wrap_angle(found.leaving_angles - true)).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (orders > 1.7).all()


@given(st.floats(-3.0, 3.0), st.floats(0.01, 100.0), st.booleans())
def test_the_frame_does_not_matter(turn: float, scale: float, mirrored: bool) -> None:
    """Rotated, scaled, mirrored and moved points have tangents that are so."""
    rotation = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    rotation[:, 1] *= -1.0 if mirrored else 1.0
    start = np.array([0.3, 1.0])
    plain = biarc_tangents(FIVE, start=start)
    moved = biarc_tangents(scale * FIVE @ rotation + [7.0, -3.0], start=start @ rotation)
    assert_allclose(moved.leaving, plain.leaving @ rotation, atol=1e-12)


def test_two_points_alone() -> None:
    """The chord without given ends; one given is reflected in the chord; two stay."""
    points, upright, slanted = [[0, 0], [3, 4]], (0.0, 1.0), (1.0, 0.0)
    assert_allclose(biarc_tangents(points).leaving, [[0.6, 0.8]] * 2)
    mirrored = [2 * 0.8 * 0.6, 2 * 0.8 * 0.8 - 1.0]
    assert_allclose(biarc_tangents(points, start=upright).leaving, [upright, mirrored])
    assert_allclose(biarc_tangents(points, end=upright).leaving, [mirrored, upright])
    assert_allclose(biarc_tangents(points, start=upright, end=slanted).leaving, [upright, slanted])


def test_three_points_with_both_ends_given() -> None:
    """The middle has the sum of both predictions, of unit length."""
    points = np.array([[0.0, 0.0], [3.0, 4.0], [8.0, 4.0]])
    found = biarc_tangents(points, start=(0.0, 1.0), end=(1.0, 0.0))
    wanted = np.array([1.96, 0.28])
    assert_allclose(found.leaving[1], wanted / np.hypot(*wanted))


def test_a_straight_run_hands_its_direction_to_all_its_points() -> None:
    """Three points in a row or more; next to it a free end continues as from a known tangent."""
    points = np.array([[-2.0, 1.0], *ROW, [4.0, 1.0], [4.2, 2.0]])
    found = biarc_tangents(points)
    assert found.leaving[1:6].tolist() == [[1.0, 0.0]] * 5
    assert_allclose(found.leaving[0], [0.0, -1.0], atol=1e-15)
    assert (found.leaving == found.arriving).all()


def test_a_given_end_wins_over_a_straight_run() -> None:
    """Only the end itself leaves the run."""
    found = biarc_tangents(ROW, start=(1.0, 1.0))
    assert_allclose(found.leaving, [[0.5**0.5] * 2, *[[1, 0]] * 4])


def test_knuckles_carry_two_tangents() -> None:
    """Each part is estimated by itself; given ends belong to the first and last part."""
    points = np.concatenate([FIVE, FIVE[1:] * [1, -1] + [6, 2.4]])
    found = biarc_tangents(points, knuckles=[4], end=(1.0, 0.5))
    first, second = biarc_tangents(points[:5]), biarc_tangents(points[4:], end=(1.0, 0.5))
    assert np.array_equal(found.arriving[:5], first.leaving)
    assert np.array_equal(found.leaving[4:], second.leaving)
    assert not np.allclose(found.arriving[4], found.leaving[4])
    assert np.array_equal(found.arriving[5:], found.leaving[5:])


def test_neighbours_of_knuckles_may_be_runs() -> None:
    """A corner of two straight runs is allowed where it is marked."""
    found = biarc_tangents(CORNER, knuckles=(4,))
    assert found.arriving[4].tolist() == [1.0, 0.0]
    assert found.leaving[4].tolist() == [0.0, 1.0]


WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "one point": (lambda: biarc_tangents([[1, 2]]), "biarc: at least 2 points; there are 1"),
    "none": (lambda: biarc_tangents(np.empty((0, 2))), "biarc: at least 2 points; there are 0"),
    "twice the same": (
        lambda: biarc_tangents([[0.0, 0.0], [1.0, 0.0], [1.0, 1e-10], [2.0, 0.0]]),
        "biarc: coincident points 1,2; ",
    ),
    "a corner between runs": (
        lambda: biarc_tangents(CORNER),
        "biarc: point 4 belongs to two different straight runs; mark it as a knuckle; ",
    ),
    "turning back": (
        lambda: biarc_tangents([[0, 1], [1, 0], [3, 0], [2, 0], [2, 5]]),
        "biarc: curve reverses at point 2; ",
    ),
    "turning back behind a knuckle": (
        lambda: biarc_tangents([[0, 1], [1, 0], [3, 0], [2, 0], [2, 5]], knuckles=[1]),
        "biarc: curve reverses at point 2; ",
    ),
    "start backwards": (
        lambda: biarc_tangents(FIVE, start=(-1, 0)),
        "biarc: given end tangent points backwards; ",
    ),
    "end across": (
        lambda: biarc_tangents(FIVE, end=(0.5, 2.0)),
        "biarc: given end tangent points backwards; ",
    ),
    "start of no direction": (
        lambda: biarc_tangents(FIVE, start=(0, 0)),
        "biarc: given end tangent points backwards; ",
    ),
    "start in space": (
        lambda: biarc_tangents(FIVE, start=(1, 0, 0)),
        "biarc: expected shape (2), got (3,); ",
    ),
    "knuckle at an end": (
        lambda: biarc_tangents(FIVE, knuckles=[4]),
        "biarc: knuckle 4 is no inner point of 5; give whole numbers from 1 to 3",
    ),
    "knuckle of words": (
        lambda: biarc_tangents(FIVE, knuckles=cast(list[int], ["2"])),
        "biarc: knuckle '2' is no inner point of 5; give whole numbers from 1 to 3",
    ),
    "knuckles that are one number": (
        lambda: biarc_tangents(FIVE, knuckles=cast(list[int], 9)),
        "biarc: knuckle 9 is no inner point of 5; ",
    ),
    "upright graph": (
        lambda: biarc_tangents([[0, 0], [1, 1], [1, 2]], form="graph"),
        "biarc: graph does not go on from point 1 to 2; take the form of chords",
    ),
    "graph with an upright end": (
        lambda: biarc_tangents(FIVE, form="graph", start=(0, 1)),
        "biarc: given end tangent of a graph stands upright; take the form of chords",
    ),
    "no such form": (
        lambda: biarc_tangents(FIVE, form=cast(TangentForm, "cubic")),
        "biarc: no form of tangents is called 'cubic'; there are chord, graph",
    ),
    "form of several words": (
        lambda: biarc_tangents(FIVE, form=cast(TangentForm, np.array(["chord", "graph"]))),
        "biarc: no form of tangents is called a ndarray; there are ",
    ),
    "beyond all measure": (
        lambda: biarc_tangents([[0.0, 0.0], [1e200, 1.0]]),
        "biarc: coordinate 1e+200 at index (1, 0); give metres",
    ),
    "nearer than anything": (
        lambda: biarc_tangents([[0.0, 0.0], [1e-200, 0.0]]), "biarc: coincident points 0,1; ",
    ),
    "not finite": (
        lambda: biarc_tangents([[0.0, 0.0], [np.inf, 1.0]]), "biarc: non-finite value at index (1",
    ),
    "in space": (
        lambda: biarc_tangents(np.zeros((4, 3))), "biarc: expected shape (n, 2), got (4, 3); ",
    ),
    "no tolerance": (
        lambda: biarc_tangents(FIVE, collinear=np.nan), "biarc: non-finite value at index 0; ",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_is_refused(case: str) -> None:
    """One line: what is wrong with its numbers, and what to do."""
    call, message = WRONG[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert str(caught.value).startswith(message)

"""Arc records: points, directions, ends, centres, arcs through points, distances."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs, sinc
from assoc_hull.geometry.curves import FloatArray

FIRST = np.zeros(1, np.int64)
curvatures = st.one_of(
    st.floats(-3.0, 3.0), st.sampled_from([0.0, 1e-11, -1e-9, 1e-15, -1e-300, 5e-324])
)


def one(angle: float, curvature: float, length: float, start: tuple[float, float]) -> PlaneArcs:
    """A batch of one arc."""
    return PlaneArcs.make([start], [angle], [curvature], [length])


@given(st.floats(-7.0, 7.0), curvatures, st.floats(0.01, 20.0))
def test_points_are_the_integral_of_directions(angle: float, bend: float, length: float) -> None:
    """Gauss's rule over the unit tangents gives the point at any arc length."""
    arc = one(angle, bend, length, (3.0, -2.0))
    nodes, weights = np.polynomial.legendre.leggauss(60)
    t = 0.5 * length * (nodes + 1.0)
    way = arc.direction(np.zeros(60, np.int64), t)
    step = 0.5 * length * np.array([weights @ np.cos(way), weights @ np.sin(way)])
    assert_allclose(arc.ends()[0], np.add([3.0, -2.0], step), atol=1e-12)
    assert_allclose(arc.end_angles(), [angle + bend * length])
    assert_allclose(arc.at(FIRST, [0.0])[0], [3.0, -2.0])


@given(st.floats(-3.0, 3.0), st.floats(0.001, 3.0), st.booleans(), st.floats(0.0, 20.0))
def test_points_lie_on_the_circle(angle: float, bend: float, right: bool, t: float) -> None:
    """All points of an arc are one radius away from its centre, left of it where it turns left."""
    arc = one(angle, -bend if right else bend, 20.0, (1.0, 1.0))
    centre = arc.centres()[0]
    assert_allclose(np.hypot(*(arc.at(FIRST, [t])[0] - centre)), 1.0 / bend, rtol=1e-12)
    left = np.array([-np.sin(angle), np.cos(angle)]) @ (centre - 1.0)
    assert (left < 0.0) == right


def test_a_line_has_no_centre() -> None:
    """Both coordinates are infinite, whatever its direction."""
    arcs = PlaneArcs.make([[0, 0]] * 3, [0.0, np.pi / 2, 1.0], [0.0] * 3, [1.0] * 3)
    assert np.isposinf(arcs.centres()).all()


@given(st.floats(-3.0, 3.0), st.floats(0.01, 100.0), st.floats(-0.999, 0.999))
def test_an_arc_through_two_points_is_the_minor_one(way: float, chord: float, sine: float) -> None:
    """It ends where it must, turns by less than half a circle, with the curvature given."""
    end = [chord * np.cos(way) + 4.0, chord * np.sin(way)]
    bend = 2.0 * sine / chord
    arc = PlaneArcs.through([[4.0, 0.0]], [end], [bend])
    assert_allclose(arc.ends()[0], end, atol=1e-13 * chord + 1e-15)
    assert arc.curvature[0] == bend
    assert abs(bend * arc.length[0]) < np.pi


def test_huge_radii_keep_the_digits() -> None:
    """A radius of 1e11 chords: the sagitta of 1.25e-12 chords, and distances from the arc."""
    arc = PlaneArcs.through([[0.0, 0.0]], [[1.0, 0.0]], [-1e-11])
    assert_allclose(arc.at(FIRST, [0.5])[0, 1], 1.25e-12, rtol=1e-12)
    assert_allclose(arc.ends(), [[1.0, 0.0]], rtol=1e-15)
    assert_allclose(arc.distance(FIRST, np.array([[0.5, 0.0]])), 1.25e-12, rtol=1e-12)
    assert_allclose(arc.distance(FIRST, np.array([[0.5, 7e-12]])), 5.75e-12, rtol=1e-12)


def nearest_sample(arc: PlaneArcs, point: FloatArray) -> tuple[float, float]:
    """Distance of a point from 5,001 points of an arc, and half their spacing."""
    t = np.linspace(0.0, float(arc.length[0]), 5_001)
    places = arc.at(np.zeros(len(t), np.int64), t)
    return float(np.hypot(*(places - point).T).min()), float(0.5 * t[1])


@given(
    st.floats(-3.0, 3.0), curvatures, st.floats(0.1, 8.0),
    st.floats(-6.0, 6.0), st.floats(-6.0, 6.0),
)  # fmt: skip
def test_distances_are_those_of_dense_samples(
    angle: float, bend: float, length: float, x: float, y: float
) -> None:
    """The sample's, less what it may miss at most, for turns of up to four circles."""
    arc = one(angle, bend, length, (0.5, -0.5))
    point = np.array([x, y])
    found = float(arc.distance(FIRST, point[None])[0])
    sampled, spacing = nearest_sample(arc, point)
    missed = spacing * min(1.0, spacing / max(found, 1e-9) + 2.0 * abs(bend) * spacing)
    assert sampled - missed - 1e-12 <= found <= sampled + 1e-12


def test_a_distance_beyond_half_a_circle_is_from_the_arc() -> None:
    """Three quarters of a circle: feet on its last quarter count; the open quarter has ends."""
    for bend in (0.5, -0.5):
        arc = one(0.0, bend, 3.0 * np.pi, (0.0, 0.0))
        up = np.sign(bend)
        points = np.array([[-3.0, 2.0 * up], [-1.0, 1.0 * up], [0.0, 2.0 * up], [0.0, 0.0]])
        found = arc.distance(np.zeros(4, np.int64), points)
        assert_allclose(found, [1.0, np.sqrt(2.0), 2.0, 0.0], atol=1e-14)


def test_sinc_is_one_at_nil() -> None:
    """Sin(h) / h to all digits, at nil and beside it."""
    h = np.array([0.0, 1e-300, 1e-8, 0.5])
    assert_allclose(sinc(h), [1.0, 1.0, 1.0, np.sin(0.5) / 0.5], rtol=1e-15)


def test_records_are_frozen() -> None:
    """Neither arrays nor fields can be written to; what was handed in stays the caller's."""
    start = np.zeros((1, 2))
    arcs = PlaneArcs.make(start, [0.0], [0.0], [1.0])
    start[0, 0] = 5.0
    assert arcs.start[0, 0] == 0.0
    assert not any(
        each.flags.writeable for each in (arcs.start, arcs.angle, arcs.curvature, arcs.length)
    )


WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "length of none": (
        lambda: PlaneArcs.make([[0, 0]] * 2, [0, 0], [0, 0], [1, 0]),
        "arcs: length 0 at index 1; give lengths above 0",
    ),
    "other counts": (
        lambda: PlaneArcs.make([[0, 0]], [0, 0], [0], [1]), "arcs: expected shape (1), got (2,); ",
    ),
    "not finite": (
        lambda: PlaneArcs.make([[0, 0]], [0], [np.nan], [1]), "arcs: non-finite value at index 0; ",
    ),
    "other counts of points": (
        lambda: PlaneArcs.through([[0, 0]] * 2, [[1, 1]], [0, 0]),
        "arcs: expected shape (2, 2), got (1, 2); ",
    ),
    "twice the same point": (
        lambda: PlaneArcs.through([[0, 0], [1, 1]], [[1, 0], [1, 1]], [0, 0]),
        "arcs: coincident points at index 1; ",
    ),
    "radius below half the chord": (
        lambda: PlaneArcs.through([[0, 0]], [[2, 0]], [1.5]),
        "arcs: curvature 1.5 over a chord of 2; give a radius above half the chord",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_is_refused(case: str) -> None:
    """One line: what is wrong with its numbers, and what to do."""
    call, message = WRONG[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert str(caught.value).startswith(message)

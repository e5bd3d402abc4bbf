"""Inflections counted exactly, and curvature combs."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.fairness.combs import comb_teeth
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.segments import curvature

UP = np.array([0.0, 0.0, 1.0])


def curve_of(xyz: FloatArray, leave: FloatArray, arrive: FloatArray | None = None) -> SplineBatch:
    """A curve through points with given derivatives with respect to chord length."""
    knot = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(xyz, axis=0), axis=1))])
    ahead = leave.copy() if arrive is None else arrive
    return SplineBatch(np.array([0, len(xyz)]), knot, xyz, leave, ahead)


def graph(x: FloatArray, y: FloatArray, slope: FloatArray) -> SplineBatch:
    """A graph y(x) as Hermite segments whose parameter is x."""
    flat = np.zeros_like(x)
    slopes = np.stack([np.ones_like(x), slope, flat], axis=1)
    return SplineBatch(
        np.array([0, len(x)]), x - x[0], np.stack([x, y, flat], axis=1), slopes, slopes.copy()
    )


def sine(waves: int, per_wave: int, height: float, shift: float) -> SplineBatch:
    """A sine of some waves, beginning and ending off its inflections."""
    x = np.linspace(shift, waves + shift, waves * per_wave + 1)
    return graph(x, height * np.sin(2 * np.pi * x), 2 * np.pi * height * np.cos(2 * np.pi * x))


def straight(length: float) -> SplineBatch:
    """A straight line of three segments in a direction that rounds."""
    way = np.array([np.cos(0.3), np.sin(0.3), 0.0])
    xyz = np.linspace(0.0, length, 4)[:, None] * way
    return curve_of(xyz, np.tile(way, (4, 1)))


@given(st.integers(1, 6), st.integers(12, 24), st.floats(0.02, 3.0), st.floats(0.1, 0.2))
def test_sine(waves: int, per_wave: int, height: float, shift: float) -> None:
    """A sine has two inflections a wave, near the multiples of its half wave."""
    curve = sine(waves, per_wave, height, shift)
    count, places = inflections(curve, UP)
    assert count.tolist() == [2 * waves]
    assert places.t + shift == pytest.approx(np.arange(1, 2 * waves + 1) / 2, abs=0.5 / per_wave)


@given(st.floats(-0.9, 0.9), st.floats(-3.0, 3.0))
def test_a_cubic_is_exact(root: float, tilt: float) -> None:
    """The graph (x - r)^3 + tilt x on [-2, 2] has its one inflection at r, to rounding."""
    x = np.array([-2.0, -1.0, 1.0, 2.0])
    curve = graph(x, (x - root) ** 3 + tilt * x, 3 * (x - root) ** 2 + tilt)
    count, places = inflections(curve, UP)
    assert count.tolist() == [1]
    assert places.t[0] - 2.0 == pytest.approx(root, abs=1e-9)
    # At the place the curvature is nil to rounding.
    assert abs(curvature(curve, UP, ([0], places.t))[0]) < 1e-9


def test_neither_side_nor_sense_matters() -> None:
    """The count is the same for the opposite normal and for the curve run backwards."""
    curve = sine(3, 17, 0.4, 0.1)
    back = SplineBatch(
        curve.start.copy(),
        (curve.knot[-1] - curve.knot)[::-1].copy(),
        curve.xyz[::-1].copy(),
        -curve.arrive[::-1],
        -curve.leave[::-1],
    )
    assert inflections(SplineBatch.join([curve, back]), [UP, -UP])[0].tolist() == [6, 6]


def test_convex_and_straight_curves_have_none() -> None:
    """An arc bends one way only, and rounding of a straight line bends no way."""
    angle = np.linspace(0.0, 1.9 * np.pi, 20)
    arc = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    along = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)
    batch = SplineBatch.join([curve_of(arc, along), straight(100.0)])
    assert inflections(batch, UP, lobe_deg=0.0)[0].tolist() == [0, 0]


def wave_of_turns(*degrees: float) -> SplineBatch:
    """A graph whose tangent turns by these angles in turn, one segment of parabola each."""
    heading = np.deg2rad(np.concatenate([[0.0], np.cumsum(degrees)]))
    slope = np.tan(heading)
    x = np.arange(float(len(slope)))
    y = np.concatenate([[0.0], np.cumsum((slope[:-1] + slope[1:]) / 2)])
    return graph(x, y, slope)


@pytest.mark.parametrize(
    ("degrees", "expected"),
    [
        pytest.param((5, -0.3, 5), 2, id="a lobe just large enough"),
        pytest.param((5, -0.1, 5), 0, id="a small lobe merges its neighbours"),
        pytest.param((5, -0.1), 0, id="a small lobe at the end"),
        pytest.param((-0.1, 5), 0, id="a small lobe at the beginning"),
        pytest.param((5, -0.1, 0.05, -5), 1, id="small lobes inside a change"),
        pytest.param((0.15, -0.05, 0.15, -5), 1, id="merged neighbours become a lobe"),
        pytest.param((5, -0.15, 0.05, -0.15, 5), 2, id="small lobes that make a large one"),
        pytest.param((0.1, -0.1, 0.1, -0.1), 0, id="nothing but small ones"),
        pytest.param((5, -5, 5, -5), 3, id="large ones"),
        pytest.param((5, 0, 0, -5), 1, id="parted by a straight stretch"),
    ],
)
def test_lobes(degrees: tuple[float, ...], expected: int) -> None:
    """Only lobes that turn by a fifth of a degree count, and small ones vanish in others."""
    both = SplineBatch.join([wave_of_turns(*degrees), wave_of_turns(*degrees[::-1])])
    assert inflections(both, UP)[0].tolist() == [expected] * 2


def test_the_middle_of_a_straight_stretch_is_its_place() -> None:
    """Where a straight stretch parts two lobes, the inflection is told in its middle."""
    assert inflections(wave_of_turns(5, 0, 0, -5), UP)[1].t.tolist() == [2.0]


def test_the_least_lobe_is_an_argument() -> None:
    """A lobe of half a degree counts or not, as asked."""
    curve = wave_of_turns(5, -0.5, 5)
    assert inflections(curve, UP, 0.4)[0].tolist() == [2]
    assert inflections(curve, UP, 0.6)[0].tolist() == [0]


def test_a_loop_turns_by_more_than_half_a_circle() -> None:
    """The turn of one looping segment is not taken as its complement to a circle."""
    xyz = np.array([[0, 0, 0], [1, 0, 0.0]])
    loop = curve_of(xyz, np.array([[9, 9, 0.0]] * 2), np.array([[9, -9, 0.0]] * 2))
    hook = curve_of(xyz, np.array([[-9, -4, 0.0]] * 2), np.array([[-9, 4, 0.0]] * 2))
    assert inflections(SplineBatch.join([loop, hook]), UP)[0].tolist() == [0, 0]


def test_a_knuckle_is_neither_lobe_nor_reset() -> None:
    """Two left arcs joined by a knuckle to the right make one lobe; left and right, two."""
    xyz = np.array([[0, 0, 0], [2, 0, 0], [4, 0, 0.0]])
    down, up = [1.0, -0.5, 0.0], [1.0, 0.5, 0.0]
    same = curve_of(xyz, np.array([down, down, down]), np.array([up, up, up]))
    turned = curve_of(xyz, np.array([down, up, down]), np.array([up, up, down]))
    count, places = inflections(SplineBatch.join([same, turned]), UP)
    assert count.tolist() == [0, 1]
    assert (places.curve.tolist(), places.t.tolist()) == ([1], [2.0])


def test_a_space_curve_counts_none() -> None:
    """A row of nan marks a curve without a plane; the others are counted all the same."""
    nan = np.full(3, np.nan)
    batch = SplineBatch.join([sine(2, 20, 0.3, 0.1)] * 3)
    assert inflections(batch, [UP, nan, UP])[0].tolist() == [4, 0, 4]


@given(st.floats(-1.5, 1.5), st.floats(0.0, 6.0))
def test_any_plane(tilt: float, heading: float) -> None:
    """The count belongs to the curve and its plane, however they lie in space."""
    c, s, a, b = np.cos(tilt), np.sin(tilt), np.cos(heading), np.sin(heading)
    turn = np.array([[a, -b, 0], [b, a, 0], [0, 0, 1]]) @ np.array(
        [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    )
    flat = sine(2, 15, 0.5, 0.1)
    curve = SplineBatch(
        flat.start.copy(),
        flat.knot.copy(),
        flat.xyz @ turn.T,
        flat.leave @ turn.T,
        flat.arrive @ turn.T,
    )
    assert inflections(curve, turn @ UP)[0].tolist() == [4]


def test_combs_stand_on_the_curve() -> None:
    """Bases lie on the curve, both ends of a segment included; teeth are scale x curvature."""
    curve = sine(1, 10, 0.3, 0.1)
    base, tip = comb_teeth(curve, UP, per_segment=5, scale=0.2)
    assert base.shape == tip.shape == (10, 5, 3)
    assert base[:, 0].tolist() == curve.xyz[:-1].tolist()
    assert base[:, -1].tolist() == curve.xyz[1:].tolist()
    middle = 0.5 * (curve.knot[1:] + curve.knot[:-1])
    expected = 0.2 * np.abs(curvature(curve, UP, (np.zeros(10, int), middle)))
    assert np.linalg.norm(tip - base, axis=2)[:, 2] == pytest.approx(expected, rel=1e-9)


def test_combs_of_plane_and_space_agree() -> None:
    """In its plane a curve has the same comb as in space, and from either side."""
    curve = sine(1, 10, 0.3, 0.1)
    plane, space = comb_teeth(curve, UP)[1], comb_teeth(curve, np.full(3, np.nan))[1]
    assert plane == pytest.approx(space, abs=1e-10)
    assert comb_teeth(curve, -UP)[1] == pytest.approx(plane, abs=1e-10)


def test_bad_arguments_are_refused() -> None:
    """What makes no sense is an error of the package."""
    curve = straight(1.0)
    with pytest.raises(BadInputError):
        inflections(curve, 2 * UP)
    with pytest.raises(BadInputError):
        inflections(curve, UP, lobe_deg=-1.0)
    with pytest.raises(BadInputError):
        comb_teeth(curve, UP, per_segment=1)

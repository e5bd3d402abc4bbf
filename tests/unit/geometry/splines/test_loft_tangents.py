"""Derivatives of lofted curves, against a loft in complex arithmetic and central differences."""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assoc_hull.errors import BadInputError, CoincidentPointsError
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray, PointKind
from assoc_hull.geometry.integrals.area_moments import line_integral, plane_integrals, section_area
from assoc_hull.geometry.numeric.dual import Dual, as_array, real
from assoc_hull.geometry.numeric.polynomials import differentiate, horner, roots_with_tangents
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.loft_tangents import DualSplines, loft_tangents
from assoc_hull.geometry.splines.segments import bezier_points, power_coefficients
from tests.complex_loft import as_batch
from tests.long_forms import draws

STEP = 1e-100
FIELDS = ("knot", "xyz", "leave", "arrive")
KINDS = [PointKind.SMOOTH, PointKind.SMOOTH, PointKind.TANGENT, PointKind.KNUCKLE]


@attrs.frozen(eq=False)
class Case:
    """Curves, and how everything they are made of changes."""

    data: CurveData
    xyz: FloatArray
    direction: FloatArray
    end_vector: FloatArray

    @property
    def derived(self) -> DualSplines:
        """What is tested."""
        return loft_tangents(self.data, self.xyz, self.direction, self.end_vector)

    def stepped(self, k: int) -> Any:
        """The complex batch of one tangent."""
        step = 1j * STEP
        return as_batch(
            self.data,
            self.data.xyz + step * self.xyz[k],
            self.data.direction + step * self.direction[k],
            self.data.end_vector + step * self.end_vector[k],
        )

    def moved(self, k: int, amount: float) -> Any:
        """The batch moved by a finite amount along one tangent."""
        return loft(
            attrs.evolve(
                self.data,
                xyz=self.data.xyz + amount * self.xyz[k],
                direction=self.data.direction + amount * self.direction[k],
                end_vector=self.data.end_vector + amount * self.end_vector[k],
            )
        )


def random_case(seed: int, sizes: list[int], count: int = 2, few: bool = False) -> Case:
    """Curves that wind about, of all kinds and ends."""
    random = np.random.default_rng(seed)
    n, m = sum(sizes), len(sizes)
    turn = np.cumsum(random.normal(scale=0.7, size=n))
    step = np.column_stack([np.cos(turn), np.sin(turn), 0.5 * random.normal(size=n)])
    step *= random.uniform(0.2, 3.0, (n, 1))
    start = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    ahead = step / np.sqrt((step**2).sum(axis=1))[:, None]
    data = CurveData(
        start,
        np.cumsum(step, axis=0),
        random.choice(KINDS, n).astype(np.int8),
        (ahead + 0.5 * random.normal(size=(n, 3))) * random.uniform(0.3, 4.0, (n, 1)),
        random.integers(0, 3, (m, 2)).astype(np.int8),
        random.normal(size=(m, 2, 3)) + ahead[start[:-1], None],
    )
    shapes = ((n, 3), (n, 3), (m, 2, 3))
    dots = [random.normal(size=(count, *shape)) for shape in shapes]
    if few:
        for each in dots:
            each *= random.random((count, each.shape[1], *(1,) * (each.ndim - 2))) < 0.15
    return Case(data, *dots)


def check(case: Case, tolerance: float = 1e-11) -> None:
    """All tangents are those of the complex step, as far as the arithmetic goes."""
    found = case.derived
    plain = loft(case.data)
    for name in FIELDS:
        value: Dual = getattr(found, name)
        assert value.value.tobytes() == getattr(plain, name).tobytes()
    for k in range(len(case.xyz)):
        stepped = case.stepped(k)
        for name in FIELDS:
            dot = getattr(found, name).dot[k]
            wanted = getattr(stepped, name).imag / STEP
            scale = max(1.0, float(np.abs(wanted).max()))
            np.testing.assert_allclose(dot, wanted, rtol=0, atol=tolerance * scale)


sizes = st.lists(st.integers(2, 9), min_size=1, max_size=4)


@settings(max_examples=draws(150), deadline=None)
@given(seed=st.integers(0, 2**32 - 1), sizes=sizes, few=st.booleans())
def test_the_tangents_are_those_of_the_complex_step(seed: int, sizes: list[int], few: bool) -> None:
    """Of any curves, kinds and ends, whether much or little moves."""
    check(random_case(seed, sizes, few=few))


@settings(max_examples=draws(40), deadline=None)
@given(seed=st.integers(0, 2**32 - 1), sizes=sizes)
def test_the_tangents_are_those_of_central_differences(seed: int, sizes: list[int]) -> None:
    """Of the loft itself."""
    case = random_case(seed, sizes)
    found, step = case.derived, 1e-6
    for k in range(len(case.xyz)):
        ahead, back = (case.moved(k, sign * step) for sign in (1.0, -1.0))
        for name in FIELDS:
            wanted = (getattr(ahead, name) - getattr(back, name)) / (2.0 * step)
            scale = max(1.0, float(np.abs(wanted).max()))
            dot = getattr(found, name).dot[k]
            np.testing.assert_allclose(dot, wanted, rtol=0, atol=1e-6 * scale)


@pytest.mark.parametrize("start", EndKind)
@pytest.mark.parametrize("finish", EndKind)
@pytest.mark.parametrize("inner", PointKind)
@pytest.mark.parametrize("count", [2, 3, 4])
def test_all_ends_and_kinds_together(start: int, finish: int, inner: int, count: int) -> None:
    """Also on the shortest pieces."""
    case = random_case(7, [count])
    kinds = np.full(count, inner, np.int8)
    ends = np.array([[start, finish]], np.int8)
    check(attrs.evolve(case, data=attrs.evolve(case.data, kind=kinds, end_kind=ends)))


def with_points(points: list[list[float]]) -> Case:
    """One free curve through these points; everything moves."""
    case = random_case(3, [len(points)], 3)
    return attrs.evolve(case, data=CurveData.single(np.array(points)))


@pytest.mark.parametrize("turn", [0.17, 0.19, 0.2, 0.201, 0.21, 0.23])
def test_where_the_local_rule_would_fold_back(turn: float) -> None:
    """On both sides of the guard: a given direction at the neighbour that looks away."""
    across = float(np.sqrt(1.0 - turn**2))
    base = with_points([[0.0, 0, 0], [1, 0, 0], [2, 1, 0]])
    data = CurveData.single(
        base.data.xyz,
        [0, PointKind.TANGENT, 0],
        np.array([[0.0] * 3, [turn, across, 0], [0.0] * 3]),
    )
    cosine = data.direction[1] @ [1.0, 0, 0]
    assert (cosine <= 0.2) == (turn <= 0.2)
    check(attrs.evolve(base, data=data))


@pytest.mark.parametrize("aside", [0.0, 1e-12, 1e-9, 1e-4, 0.3])
def test_where_the_parabola_has_no_direction(aside: float) -> None:
    """On both sides of the guard: a curve that runs back on itself, and one that nearly does."""
    case = with_points([[0.0, 0, 0], [1, 0, 0], [0, aside, 0], [-1, 0.5, 0]])
    # The derivative of a direction is that of the vector over its length: 1e9 of it here.
    check(case, 1e-11 if aside in (0.0, 0.3) else 1e-5)


def test_what_no_tangent_moves_costs_nothing_and_stays() -> None:
    """Curves that a tangent leaves alone have nil tangents, exactly."""
    case = random_case(5, [4, 5, 6], 3)
    xyz = np.zeros(case.xyz.shape)
    xyz[1, 4:9] = case.xyz[1, 4:9]
    found = loft_tangents(case.data, xyz)
    for name in FIELDS:
        dot = getattr(found, name).dot
        assert not dot[[0, 2]].any()
        assert not dot[1, :4].any()
        assert not dot[1, 9:].any()
        assert dot[1, 4:9].any()


@settings(max_examples=draws(20), deadline=None)
@given(seed=st.integers(0, 2**31), sizes=sizes)
def test_the_ways_for_few_and_many_moves_agree(seed: int, sizes: list[int]) -> None:
    """One tangent that moves all, alone, and among many that move nothing."""
    case = random_case(seed, sizes, 1)
    zeros = [np.zeros((5, *each.shape[1:])) for each in (case.xyz, case.direction, case.end_vector)]
    moves = [np.concatenate([each, none]) for each, none in zip(
        (case.xyz, case.direction, case.end_vector), zeros, strict=True
    )]  # fmt: skip
    one, many = case.derived, loft_tangents(case.data, *moves)
    for name in FIELDS:
        alone, among = getattr(one, name).dot, getattr(many, name).dot
        np.testing.assert_allclose(among[:1], alone, rtol=1e-12, atol=1e-12)
        assert not among[1:].any()


def test_rigid_motion_is_known() -> None:
    """Shifted curves keep parameters and derivatives; turned ones turn them."""
    case = random_case(11, [6, 5], 2)
    free = attrs.evolve(case.data, end_kind=np.zeros((2, 2), np.int8))
    plain = attrs.evolve(free, kind=np.array([0, 2, 0, 0, 0, 0, 0, 0, 2, 0, 0], np.int8))
    shift = np.tile([1.0, 2.0, 3.0], (11, 1))
    spin = np.cross([0.2, -1.0, 0.5], plain.xyz)
    found = loft_tangents(plain, np.stack([shift, spin]))
    np.testing.assert_allclose(found.knot.dot, 0.0, atol=1e-12)
    for name in ("leave", "arrive"):
        part = getattr(found, name)
        np.testing.assert_allclose(part.dot[0], 0.0, atol=1e-12)
        turned = np.cross([0.2, -1.0, 0.5], part.value)
        np.testing.assert_allclose(part.dot[1], turned, atol=1e-12)


def test_no_tangents_at_all() -> None:
    """Give the loft, with none."""
    case = random_case(2, [4, 3])
    found = loft_tangents(case.data, np.zeros((0, 7, 3)))
    assert (found.count, found.knot.dot.shape, found.leave.dot.shape) == (2, (0, 7), (0, 7, 3))


def test_the_result_is_frozen_and_the_moves_are_not() -> None:
    """Neither values nor tangents can be changed; what was given can."""
    case = random_case(2, [4, 3])
    found = case.derived
    for name in FIELDS:
        assert not getattr(found, name).value.flags.writeable
        assert not getattr(found, name).dot.flags.writeable
    assert case.xyz.flags.writeable


def test_what_does_not_fit_is_refused() -> None:
    """The message names the shape that is wanted; points too close are those of the loft."""
    case = random_case(2, [4, 3])
    for wrong in (np.zeros((2, 6, 3)), np.zeros((7, 3)), np.full((2, 7, 3), np.nan)):
        with pytest.raises(BadInputError, match="tangents of the points"):
            loft_tangents(case.data, wrong)
    with pytest.raises(BadInputError, match="directions"):
        loft_tangents(case.data, case.xyz, np.zeros((1, 7, 3)))
    close = CurveData.single(np.zeros((2, 3)))
    with pytest.raises(CoincidentPointsError):
        loft_tangents(close, np.zeros((1, 2, 3)))


def full_section() -> tuple[CurveData, FloatArray]:
    """A section of seven points with unequal chords, and how it changes as its bilge fills."""
    y = [0.0, 5.2, 8.6, 9.7, 10.0, 10.3, 11.5]
    z = [0.0, 0.3, 1.6, 3.4, 6.5, 9.5, 13.0]
    points = np.column_stack([np.zeros(7), y, z])
    bilge = np.exp(-((points[:, 2] - 1.6) ** 2)) * points[:, 1]
    move = np.column_stack([np.zeros(7), bilge, -0.8 * bilge])
    return CurveData.single(points), move


def test_chord_lengths_vary_too() -> None:
    """Kept as they are they give an area of seven points that is wrong in the third digit."""
    data, move = full_section()
    level = 13.0
    found: Any = section_area(loft_tangents(data, move[None]).batch(), level)

    def exact(chord: Any) -> float:
        batch = as_batch(data, data.xyz + 1j * STEP * move, chord=chord)
        area: Any = section_area(batch, level)
        return float(area[0].imag / STEP)

    wanted = exact(None)
    frozen = exact(np.sqrt((np.diff(data.xyz, axis=0) ** 2).sum(axis=1)))
    assert found.dot[0, 0] == pytest.approx(wanted, rel=1e-12)
    assert abs(frozen / wanted - 1.0) > 1e-3
    ahead, back = (
        section_area(loft(CurveData.single(data.xyz + sign * 1e-4 * move)), level)[0]
        for sign in (1.0, -1.0)
    )
    assert found.dot[0, 0] == pytest.approx((ahead - back) / 2e-4, rel=1e-7)


@pytest.mark.parametrize("level", [0.1, 1.6, 3.0, 6.5, 12.9, 13.0, 20.0])
def test_the_area_below_a_level_by_its_points_and_by_the_level(level: float) -> None:
    """Each coordinate of each point, and the level itself; also where it meets a point."""
    data, _ = full_section()
    moves = np.concatenate([np.eye(21).reshape(21, 7, 3), np.zeros((1, 7, 3))])
    by_level = np.zeros(22)
    by_level[21] = 1.0
    height = as_array(Dual(level, by_level))
    area: Any = section_area(loft_tangents(data, moves).batch(), height)
    plain = section_area(loft(data), level)
    np.testing.assert_allclose(area.value, plain, rtol=1e-14)
    for k in range(22):
        batch = as_batch(data, data.xyz + 1j * STEP * moves[k])
        stepped: Any = section_area(batch, level + 1j * STEP * by_level[k])
        assert area.dot[k, 0] == pytest.approx(stepped[0].imag / STEP, rel=1e-9, abs=1e-10)
    if level < 13.0:
        breadth = section_area(loft(data), level + 1e-5)[0] - plain[0]
        assert area.dot[21, 0] == pytest.approx(breadth / 1e-5, rel=1e-4)


def test_a_section_that_the_level_meets_often() -> None:
    """Down and up again: every crossing moves."""
    points = np.array([[0, 0, 2.0], [0, 1, 0], [0, 2, 2.2], [0, 3, 0.1], [0, 4, 3]])
    data, moves = CurveData.single(points), np.random.default_rng(1).normal(size=(4, 5, 3))
    area: Any = section_area(loft_tangents(data, moves).batch(), 1.3)
    for k in range(4):
        ahead, back = (
            section_area(loft(CurveData.single(points + sign * 1e-5 * moves[k])), 1.3)[0]
            for sign in (1.0, -1.0)
        )
        assert area.dot[k, 0] == pytest.approx((ahead - back) / 2e-5, rel=1e-7)


@settings(max_examples=draws(20), deadline=None)
@given(seed=st.integers(0, 2**31), sizes=sizes)
def test_functions_of_splines_take_tangents_and_complex_numbers(
    seed: int, sizes: list[int]
) -> None:
    """Power and Bezier coefficients, their values, and integrals along curves."""
    case = random_case(seed, sizes)
    batch = case.derived.batch()
    u = np.random.default_rng(seed).random((sum(sizes) - len(sizes), 3))
    for function in (
        power_coefficients, bezier_points,
        lambda b: horner(power_coefficients(b), u),
        lambda b: horner(differentiate(power_coefficients(b)), u),
        lambda b: line_integral(b, (1, 2)),
        lambda b: plane_integrals(b).second_uv,
        lambda b: plane_integrals(b, (0, 2), close=True).moment_u,
    ):  # fmt: skip
        found: Any = function(batch)
        plain = function(loft(case.data))
        np.testing.assert_allclose(real(found), plain, rtol=1e-13, atol=1e-12)
        for k in range(2):
            stepped: Any = function(case.stepped(k))
            wanted = stepped.imag / STEP
            scale = max(1.0, float(np.abs(wanted).max()))
            np.testing.assert_allclose(found.dot[k], wanted, rtol=0, atol=1e-10 * scale)


def test_roots_that_vary() -> None:
    """Plain ones are what they were; others move as their polynomials do, but for marked ones."""
    cubic = np.array([[-6.0, 11.0, -6.0, 1.0]])
    u, simple = np.array([[1.0, 2.0, 2.5]]), np.array([[True, True, False]])
    assert roots_with_tangents(cubic, u, simple) is u
    shift = np.array([[[-1.0, 0, 0, 0]], [[0.0, 0, 0, 1]]])
    found: Any = roots_with_tangents(as_array(Dual(cubic, shift)), u, simple)
    assert found.value.tolist() == u.tolist()
    np.testing.assert_allclose(found.dot[:, 0], [[0.5, -1.0, 0.0], [-0.5, 8.0, 0.0]])
    stepped: Any = roots_with_tangents(cubic + 1j * STEP * shift[0], u, simple)
    np.testing.assert_allclose(stepped.imag / STEP, [[0.5, -1.0, 0.0]])

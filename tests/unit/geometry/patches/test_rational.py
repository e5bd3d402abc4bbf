"""Rational patches: curvature polynomials against whole numbers, exact spheres and tori."""

import math
from fractions import Fraction

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.areas_by_sign import sign_areas
from assoc_hull.geometry.patches.bernstein_polynomials import BoundedPolynomial
from assoc_hull.geometry.patches.bezier_patches import (
    Patches,
    curvatures,
    jets,
    patch_normals,
    patch_points,
)
from assoc_hull.geometry.patches.cell_subdivision import subdivide_patches
from assoc_hull.geometry.patches.curvature_functions import (
    IsoFunction,
    RationalTerms,
    gauss_function,
    gauss_functions,
    mean_function,
    umbilic_function,
)
from assoc_hull.geometry.patches.zero_set_arcs import arcs_of
from tests.curved_patches import nets
from tests.exact_patches import Exact, bernstein, exact_rational, product, total
from tests.rational_surfaces import arc, revolved


def share_of_bound(found: IsoFunction, truth: Exact, unit: int) -> float:
    """The greatest part of its bound that the error of a coefficient uses up."""
    b, err = found.b[0], found.err[0]
    exact = bernstein(truth, b.shape[0] - 1, b.shape[1] - 1)
    values, bounds = (np.array([Fraction(x) for x in each.flat]) for each in (b, err))
    return float(max(abs(values - exact.ravel() / unit) / bounds))


def short(values: FloatArray) -> FloatArray:
    """Numbers of at most 20 bits: products of two of them are floats."""
    return np.round(values * 2.0**12) / 2.0**12


@pytest.mark.parametrize("degrees", [(2, 2), (1, 3), (3, 2)])
def test_rounding_stays_far_below_its_bound(degrees: tuple[int, int]) -> None:
    """In exact arithmetic: errors use less than 5 % of the bounds, with and without a level."""
    rng = np.random.default_rng(1)
    shape = (degrees[0] + 1, degrees[1] + 1)
    net, weight = short(rng.normal(size=(*shape, 3))), short(rng.uniform(0.5, 2.0, shape))
    net[..., 0] += 16.0
    a, quartic, fourth, unit = exact_rational(net, weight)
    zero, band = gauss_functions(Patches.single(net, weight), (0.0, 0.25))
    assert share_of_bound(zero, a, unit**8) <= 0.05
    assert share_of_bound(band, total(4 * product(a, fourth), -quartic), 4 * unit**12) <= 0.05
    m, n = degrees
    assert zero.b.shape == (1, 8 * m - 3, 8 * n - 3)
    assert band.b.shape == (1, 12 * m - 3, 12 * n - 3)


def sphere(radius: float, up_to: float = 1.2) -> Patches:
    """A patch of a sphere about the origin, from its equator up, exact but for rounding."""
    curve, weights = arc(0.0, up_to)
    return Patches.single(*revolved(radius * curve, weights, 0.1, 1.5))


def torus() -> Patches:
    """A patch of a torus, R = 3 and r = 1, with the top of the tube: K = 0 there."""
    curve, weights = arc(np.pi / 6, 5 * np.pi / 6)
    return Patches.single(*revolved(curve + np.array([3.0, 0.0]), weights, 0.0, np.pi / 4))


def test_a_sphere_has_one_curvature() -> None:
    """Below 1 / r**2 the polynomial is positive, above it negative, at it nil to its bound."""
    levels = (0.0, 0.249, 0.25, 0.251)
    zero, below, at, above = gauss_functions(sphere(2.0), levels)
    assert (zero.b > zero.err).all()
    assert (below.b > below.err).all()
    assert (above.b < -above.err).all()
    assert (np.abs(at.b) <= at.err).all()


def test_curvatures_on_a_sphere() -> None:
    """Points at the radius, K = 1 / r**2, normal along the radius, no principal direction."""
    uv = np.random.default_rng(2).uniform(size=(60, 2))
    found = curvatures(sphere(2.0), np.zeros(60, np.intp), uv)
    assert np.sqrt((found.position**2).sum(axis=1)) == pytest.approx(2.0, rel=4e-16)
    assert found.gauss == pytest.approx(0.25, rel=1e-13)
    assert np.abs(found.mean) == pytest.approx(0.5, rel=1e-13)
    assert np.abs(np.cross(found.normal, found.position)).max() <= 1e-14
    assert np.isnan(found.axes).all()


def test_curvatures_on_a_torus() -> None:
    """K = cos(a) / (r (R + r cos(a))), with the polynomial of the same sign."""
    uv = np.random.default_rng(3).uniform(size=(60, 2))
    found = curvatures(torus(), np.zeros(60, np.intp), uv)
    radius = np.hypot(*found.position[:, :2].T)
    truth = (radius - 3.0) / radius
    assert found.gauss == pytest.approx(truth, abs=1e-13)
    assert np.sort(np.abs(found.principal), axis=1) == pytest.approx(
        np.sort(np.stack([np.abs(truth), np.ones(60)], axis=1), axis=1), abs=1e-13
    )
    band = gauss_function(torus(), 0.1)
    assert band.b[0, 0, 0] > band.err[0, 0, 0]
    assert band.b[0, 0, -1] < -band.err[0, 0, -1]


def test_points_and_normals_of_polylines() -> None:
    """What polylines are made of lies on the sphere too, and its normals are as long as it."""
    uv, row = np.random.default_rng(8).uniform(size=(20, 2)), np.zeros(20, np.intp)
    found = patch_points(sphere(2.0), row, uv)
    assert np.sqrt((found**2).sum(axis=1)) == pytest.approx(2.0, rel=4e-16)
    assert patch_normals(sphere(2.0), row, uv) == pytest.approx(
        jets(sphere(2.0), row, uv).s, abs=1e-13
    )


def test_a_cylinder_is_nil_to_its_bound() -> None:
    """A rational arc along a straight line, 100 m before the origin, has no curvature K."""
    curve, weights = arc(0.3, 1.3)
    net = np.zeros((3, 2, 3))
    net[..., 1:] = curve[:, None]
    net[:, 1, 0] = 8.0
    found = gauss_function(Patches.single(net + 100.0, np.stack([weights] * 2, axis=1)), 0.0)
    assert (np.abs(found.b) <= found.err).all()


def test_equal_weights_are_a_polynomial_patch() -> None:
    """With all weights 2 the curvatures are those of the net alone, and A* is 2**8 times A."""
    net = np.random.default_rng(4).normal(size=(3, 4, 3))
    plain, weighted = Patches.single(net), Patches.single(net, np.full((3, 4), 2.0))
    uv, row = np.random.default_rng(5).uniform(size=(20, 2)), np.zeros(20, np.intp)
    assert np.allclose(
        curvatures(plain, row, uv).gauss, curvatures(weighted, row, uv).gauss, rtol=1e-12, atol=0.0
    )
    assert jets(plain, row, uv).element == pytest.approx(jets(weighted, row, uv).element, rel=1e-14)
    low, high = gauss_function(plain, 0.0).b[0], gauss_function(weighted, 0.0).b[0]
    assert high[[0, 0, -1, -1], [0, -1, 0, -1]] == pytest.approx(
        256.0 * low[[0, 0, -1, -1], [0, -1, 0, -1]], rel=1e-12
    )


def test_a_product_is_off_by_its_roundings() -> None:
    """Of exact factors: each coefficient of the product lies within its bound, above nil."""
    rng = np.random.default_rng(11)
    a, b = (BoundedPolynomial(each, np.zeros_like(each)) for each in rng.normal(size=(2, 1, 4, 5)))
    found, exact = a.times(b), np.zeros((7, 9), object)
    scaled = [
        np.array([[Fraction(x) for x in row] for row in each.b[0]]) * weights(3, 4)
        for each in (a, b)
    ]
    for i, j in np.ndindex(4, 5):
        exact[i : i + 4, j : j + 5] += scaled[0][i, j] * scaled[1]
    exact = exact / weights(6, 8)
    values = np.array([[Fraction(x) for x in row] for row in found.b[0]])
    assert (abs(values - exact) <= found.err[0]).all()
    assert (found.err > 0.0).all()


def weights(m: int, n: int) -> Exact:
    """Products of binomial coefficients, whole numbers."""
    rows, columns = ([math.comb(d, i) for i in range(d + 1)] for d in (m, n))
    return np.array([[Fraction(x * y) for y in columns] for x in rows])


def test_uncertain_points_under_very_different_weights() -> None:
    """The normals of 400 bilinear patches, off by delta, reach their bound and stay within."""
    rng, delta = np.random.default_rng(12), 1e-6
    net, weight = rng.normal(size=(2, 2, 3)), np.array([[1.0, 30.0], [30.0, 1.0]])
    net[1, 1] = net[0, 0]
    moved = net + delta * rng.choice([-1.0, 1.0], (400, 2, 2, 3))
    many = Patches(moved, np.zeros((400, 2, 2)), np.zeros(400, np.intp), np.stack([weight] * 400))
    truth = RationalTerms.of(Patches.single(net, weight), delta).plane[:3]
    change = np.abs(RationalTerms.of(many, 0.0).plane[:3].b - truth.b)
    assert (change <= truth.err).all()
    assert (change >= 0.8 * truth.err).any()


def test_derivatives_of_a_rational_patch() -> None:
    """Second derivatives are the limits of differences of the first."""
    rng, h = np.random.default_rng(9), 1e-5
    patch = Patches.single(rng.normal(size=(4, 3, 3)), rng.uniform(0.5, 2.0, (4, 3)))
    uv, row = rng.uniform(0.1, 0.9, (20, 2)), np.zeros(20, np.intp)
    found = jets(patch, row, uv)
    for axis, first, second in ((0, "ru", "ruu"), (1, "rv", "rvv"), (1, "ru", "ruv")):
        step = h * np.eye(2)[axis]
        low, high = (getattr(jets(patch, row, uv + s), first) for s in (-step, step))
        assert np.abs((high - low) / (2 * h) - getattr(found, second)).max() <= 1e-6


def test_uncertain_points_of_equal_weights() -> None:
    """The bound is as close as that of polynomial patches: a pole of a sphere reaches it."""
    net, delta, rng = nets()["P17_pole_sphere"], 1e-5, np.random.default_rng(10)
    for each in (net, net.swapaxes(0, 1)):
        moved = each + delta * rng.choice([-1.0, 1.0], (200, *each.shape))
        weight = np.full((200, 4, 4), 2.0)
        many = Patches(moved, np.zeros((200, 2, 2)), np.zeros(200, np.intp), weight)
        truth = gauss_function(Patches.single(each, weight[0]), 0.0, delta)
        assert 0.85 <= (np.abs(gauss_function(many, 0.0).b - truth.b) / truth.err).max() <= 1.0


@pytest.mark.parametrize("level", [0.0, 0.05])
def test_uncertain_points_stay_within_their_bound(level: float) -> None:
    """400 nets, each coordinate off by delta up or down: no change passes the bound."""
    patch, delta, rng = torus(), 1e-5, np.random.default_rng(6)
    moved = patch.net[0] + delta * rng.choice([-1.0, 1.0], (400, 3, 3, 3))
    assert patch.weight is not None
    many = Patches(
        moved, np.zeros((400, 2, 2)), np.zeros(400, np.intp), np.repeat(patch.weight, 400, axis=0)
    )
    truth = gauss_function(patch, level, delta)
    change = np.abs(gauss_function(many, level).b - truth.b) / truth.err
    assert 0.1 <= change.max() <= 1.0


def test_a_patch_does_not_depend_on_its_batch() -> None:
    """Coefficients and bounds of 70 patches are those of each alone, to the last bit."""
    rng = np.random.default_rng(7)
    net, weight = rng.normal(size=(70, 3, 3, 3)), rng.uniform(0.5, 2.0, (70, 3, 3))
    many = Patches(net, np.zeros((70, 2, 2)), np.zeros(70, np.intp), weight)
    batch = gauss_functions(many, (0.0, 1e-3), 1e-9)
    for row in (0, 33, 69):
        alone = gauss_functions(many[row : row + 1], (0.0, 1e-3), 1e-9)
        for a, b in zip(batch, alone, strict=True):
            assert a.b[row].tobytes() == b.b.tobytes()
            assert a.err[row].tobytes() == b.err.tobytes()


@pytest.mark.parametrize("level", [0.0, 0.1, -0.1])
def test_areas_on_a_torus_are_exact(level: float) -> None:
    """Where K = level the angle of the tube has cos(a) = R r K / (1 - r**2 K): known areas."""
    found = gauss_function(torus(), level, 1e-12)
    cells = subdivide_patches(found)
    area = sign_areas(torus(), cells, arcs_of(cells), 1e-10)
    border = np.arccos(3.0 * level / (1.0 - level))
    low, middle, high = (
        np.pi / 4 * (3.0 * a + np.sin(a)) for a in (np.pi / 6, border, 5 * np.pi / 6)
    )
    assert area.positive[0] == pytest.approx(middle - low, rel=1e-14)
    assert area.negative[0] == pytest.approx(high - middle, rel=1e-14)
    assert area.error_estimate[0] <= 1e-10 * area.total[0]


def test_area_of_an_octant_of_a_sphere() -> None:
    """With a pole: all of it is positive, and pi / 2."""
    curve, weights = arc(0.0, np.pi / 2)
    octant = Patches.single(*revolved(curve, weights, 0.0, np.pi / 2))
    cells = subdivide_patches(gauss_function(octant, 0.5, 1e-12))
    area = sign_areas(octant, cells, arcs_of(cells), 1e-10)
    assert area.positive[0] == pytest.approx(np.pi / 2, rel=1e-14)
    assert area.unresolved[0] == area.zero[0] == area.negative[0] == 0.0


def test_mean_curvature_of_rational_patches_is_refused() -> None:
    """There is no polynomial for it; the error says what there is."""
    for rule in (mean_function, umbilic_function):
        with pytest.raises(BadInputError, match="curvatures"):
            rule(sphere(1.0))

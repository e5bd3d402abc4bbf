"""Polynomials with the sign of curvature: their degrees, their errors, and their values."""

from fractions import Fraction

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches import curvature_terms as terms
from assoc_hull.geometry.patches.bernstein_polynomials import dot_polynomials
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.curvature_functions import (
    IsoFunction,
    gauss_function,
    gauss_functions,
    mean_function,
    umbilic_function,
)
from tests.curved_patches import nets
from tests.exact_patches import Exact, bernstein, degrees, exact_patch, product, total

PAIRS = [(2, 2), (3, 3), (2, 3), (4, 4)]


def whole_net(m: int, n: int) -> FloatArray:
    """A net of small whole numbers: no identity but the general ones."""
    return np.random.default_rng(10 * m + n).integers(-9, 10, (m + 1, n + 1, 3)).astype(np.float64)


def ship_plate(seed: int) -> FloatArray:
    """A bicubic plate of 8 x 2 m, 100 m before the origin, its points a little off a grid."""
    net = np.zeros((4, 4, 3))
    net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] * np.array([8.0, 2.0])[:, None, None] / 3.0
    net += 0.1 * np.random.default_rng(seed).normal(size=(4, 4, 3))
    return np.asarray(net + np.array([100.0, 0.0, 7.0]))


@pytest.mark.parametrize(("m", "n"), PAIRS)
def test_true_degrees(m: int, n: int) -> None:
    """What a general patch has: A one less each way than products make it, |S|**4 all it can."""
    exact = exact_patch(whole_net(m, n))
    assert [degrees(each) for each in (exact.e, exact.f, exact.g)] == [
        (2 * m - 2, 2 * n), (2 * m - 1, 2 * n - 1), (2 * m, 2 * n - 2),
    ]  # fmt: skip
    assert [degrees(each) for each in (exact.l, exact.m, exact.n)] == [
        (3 * m - 4, 3 * n - 1), (3 * m - 3, 3 * n - 3), (3 * m - 1, 3 * n - 4),
    ]  # fmt: skip
    assert degrees(exact.s[0]) == (2 * m - 1, 2 * n - 1)
    assert all(each[2 * m - 1, 2 * n - 1] == 0 for each in exact.s)
    assert degrees(exact.a) == (6 * m - 5, 6 * n - 5)
    assert degrees(exact.area) == (4 * m - 2, 4 * n - 2)
    assert degrees(exact.quartic) == (8 * m - 4, 8 * n - 4)
    assert degrees(exact.b) == (5 * m - 3, 5 * n - 3)


@pytest.mark.parametrize(("m", "n"), [*PAIRS, (1, 1), (1, 3)])
def test_nominal_degrees(m: int, n: int) -> None:
    """What the rules of products give, by the shapes of coefficients."""
    patch = Patches.single(whole_net(m, n))
    found = terms.values(patch)
    shapes = {
        "S": found.s,
        "E": dot_polynomials(found.ru, found.ru),
        "G": dot_polynomials(found.rv, found.rv),
        "M": dot_polynomials(found.s, found.ruv),
        "area": terms.area_squared(found),
        "A": gauss_function(patch, 0.0).b,
        "A - K0 |S|**4": gauss_function(patch, 0.1).b,
        "B": mean_function(patch).b,
        "H0": mean_function(patch, 0.1).b,
        "umbilics": umbilic_function(patch).b,
    }
    assert {key: (each.shape[-2] - 1, each.shape[-1] - 1) for key, each in shapes.items()} == {
        "S": (2 * m - 1, 2 * n - 1), "E": (2 * m - 2, 2 * n), "G": (2 * m, 2 * n - 2),
        "M": (3 * m - 2, 3 * n - 2), "area": (4 * m - 2, 4 * n - 2),
        "A": (6 * m - 4, 6 * n - 4), "A - K0 |S|**4": (8 * m - 4, 8 * n - 4),
        "B": (5 * m - 3, 5 * n - 3), "H0": (12 * m - 6, 12 * n - 6),
        "umbilics": (10 * m - 6, 10 * n - 6),
    }  # fmt: skip
    for second, degree in ((found.ruu, m), (found.rvv, n)):
        assert (second is None) == (degree == 1)
    if min(m, n) > 1:
        assert found.ruu is not None
        assert found.rvv is not None
        nominal = [dot_polynomials(found.s, each).shape[1:] for each in (found.ruu, found.rvv)]
        assert nominal == [(3 * m - 2, 3 * n), (3 * m, 3 * n - 2)]


def share_of_bound(found: IsoFunction, truth: Exact, unit: int) -> float:
    """The greatest part of its bound that the error of a coefficient uses up."""
    b, err = found.b[0], found.err[0]
    exact = bernstein(truth, b.shape[0] - 1, b.shape[1] - 1)
    values, bounds = (np.array([Fraction(x) for x in each.flat]) for each in (b, err))
    return float(max(abs(values - exact.ravel() / unit) / bounds))


NETS = {
    "random": np.random.default_rng(1).normal(size=(4, 4, 3)),
    "plate of a ship": ship_plate(2),
    "bilinear far away": np.random.default_rng(3).normal(size=(2, 2, 3)) + 100.0,
    "quartic": np.random.default_rng(4).normal(size=(5, 5, 3)),
}


@pytest.mark.parametrize("net", NETS.values(), ids=NETS.keys())
def test_rounding_stays_far_below_its_bound(net: FloatArray) -> None:
    """In exact arithmetic: errors use 1 % of the bound of A at most, 3 % of A - K0 |S|**4."""
    exact, (zero, band) = exact_patch(net), gauss_functions(Patches.single(net), (0.0, -0.3))
    level = Fraction(-0.3)
    assert share_of_bound(zero, exact.a, exact.unit**6) <= 0.01
    truth = total(exact.a * exact.unit**2 * level.denominator, -level.numerator * exact.quartic)
    assert share_of_bound(band, truth, exact.unit**8 * level.denominator) <= 0.03
    assert zero.err.max() <= 5e-12 * np.abs(zero.b).max()


def test_rounding_of_mean_curvature_and_umbilics() -> None:
    """B, B**2 - 4 H0**2 |S|**6 and B**2 - 4 A |S|**2 keep to their bounds as well."""
    net, level = ship_plate(5), Fraction(0.05)
    exact, patch = exact_patch(net), Patches.single(net)
    assert share_of_bound(mean_function(patch), exact.b, exact.unit**5) <= 0.01
    square, sextic = product(exact.b, exact.b), product(exact.quartic, exact.area)
    p, q = level.numerator**2, level.denominator**2
    truth = total(square * exact.unit**2 * q, -4 * p * sextic)
    assert share_of_bound(mean_function(patch, 0.05), truth, exact.unit**12 * q) <= 0.01
    truth = total(square, -4 * product(exact.a, exact.area))
    assert share_of_bound(umbilic_function(patch), truth, exact.unit**10) <= 0.01


@pytest.mark.parametrize("level", [0.0, 0.01])
def test_uncertain_points_stay_within_their_bound(level: float) -> None:
    """1200 nets, each coordinate off by delta up or down: changes reach their bound, not more."""
    delta, rng, reached = 1e-5, np.random.default_rng(6), []
    sphere = nets()["P17_pole_sphere"]
    for net in (sphere, sphere.swapaxes(0, 1), whole_net(1, 3)):
        moved = net + delta * rng.choice([-1.0, 1.0], (400, *net.shape))
        many = Patches(moved, np.zeros((400, 2, 2)), np.zeros(400, np.intp))
        truth = gauss_function(Patches.single(net), level, delta)
        change = np.abs(gauss_function(many, level).b - truth.b)
        reached.append((change / truth.err).max())
    assert min(reached[:2]) >= 0.85
    assert max(reached) <= 1.0


def test_a_patch_does_not_depend_on_its_batch() -> None:
    """Coefficients and bounds of 150 patches are those of each alone, to the last bit."""
    rng = np.random.default_rng(7)
    net, delta = (
        rng.normal(size=(150, 4, 4, 3)),
        rng.uniform(0.0, 1e-9, 150) * (rng.random(150) > 0.5),
    )
    many = Patches(net, np.zeros((150, 2, 2)), np.zeros(150, np.intp))
    levels = (0.0, 1e-3, -1e-3)
    batch = gauss_functions(many, levels, delta)
    for row in range(0, 150, 7):
        alone = gauss_functions(many[row : row + 1], levels, delta[row])
        assert all(a.b[row].tobytes() == b.b.tobytes() for a, b in zip(batch, alone, strict=True))
        assert all(
            a.err[row].tobytes() == b.err.tobytes() for a, b in zip(batch, alone, strict=True)
        )


def test_developable_patches_are_nil_to_their_bounds() -> None:
    """Every coefficient of a plane, of cylinders and of a cone lies within its error."""
    for name in ("P13_plane", "P14_cyl", "P15_cyl_rot", "P16_cone_rot"):
        found = gauss_function(Patches.single(nets()[name]), 0.0, 1e-12)
        assert (np.abs(found.b) <= found.err).all(), name


def test_signs_of_a_graph() -> None:
    """On z = (x**2 + y**2) / 2 - x**2 y**2 / 4 the functions are those of the closed form."""
    square = np.array([1.0, -1.0, 1.0])
    net = np.zeros((3, 3, 3))
    net[..., 0], net[..., 1] = np.mgrid[-1:2, -1:2]
    net[..., 2] = (square[:, None] + square) / 2 - np.outer(square, square) / 4
    patch, level = Patches.single(net), 0.5
    zero, band = gauss_functions(patch, (0.0, level))
    zx, zxx, zxy = -0.5, 0.5, -1.0
    numerator, area = zxx**2 - zxy**2, 1.0 + 2.0 * zx**2
    assert zero.b[0, 0, 0] == pytest.approx(2.0**8 * numerator, rel=1e-14)
    truth = 2.0**8 * (numerator - level * area**2)
    assert band.b[0, 0, 0] == pytest.approx(truth, rel=1e-14)
    truth = 2.0**6 * (2.0 * (1.0 + zx**2) * zxx - 2.0 * zx**2 * zxy)
    assert mean_function(patch).b[0, 0, 0] == pytest.approx(truth, rel=1e-14)

"""Curvatures at points of patches, against closed forms."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.bezier_patches import Patches, curvatures, jets
from tests.curved_patches import nets


def at(name: str, count: int = 50) -> tuple[Patches, IntArray, FloatArray]:
    """A reference patch, and points of it."""
    uv = np.random.default_rng(1).uniform(size=(count, 2))
    return Patches.single(nets()[name]), np.zeros(count, np.intp), uv


def test_a_monkey_saddle() -> None:
    """On z = x**3 - 3 x y**2 both curvatures are those of the closed form."""
    patches, row, uv = at("P02_monkey")
    found = curvatures(patches, row, uv)
    x, y = found.position[:, 0], found.position[:, 1]
    zx, zy, zxx, zxy = 3 * x**2 - 3 * y**2, -6 * x * y, 6 * x, -6 * y
    square = 1 + zx**2 + zy**2
    assert found.position[:, 2] == pytest.approx(x**3 - 3 * x * y**2, abs=1e-14)
    assert found.gauss == pytest.approx((-(zxx**2) - zxy**2) / square**2, rel=1e-12)
    mean = ((1 + zy**2) * zxx - 2 * zx * zy * zxy - (1 + zx**2) * zxx) / (2 * square**1.5)
    assert found.mean == pytest.approx(mean, abs=1e-13)


@pytest.mark.parametrize("name", sorted(set(nets()) - {"P13_plane"}))
def test_principal_directions(name: str) -> None:
    """The normal curvature along each is its principal curvature; they are at right angles."""
    patches, row, uv = at(name)
    found, jet = curvatures(patches, row, uv), jets(patches, row, uv)
    second = [(found.normal * each).sum(axis=1) for each in (jet.ruu, jet.ruv, jet.rvv)]
    du, dv = np.moveaxis(found.directions, -1, 0)
    l, m, n = (each[:, None] for each in second)
    bent = l * du**2 + 2 * m * du * dv + n * dv**2
    assert np.abs(bent - found.principal).max() <= 1e-14
    assert np.abs((found.axes[:, 0] * found.axes[:, 1]).sum(axis=1)).max() <= 1e-14
    assert np.abs((found.axes**2).sum(axis=-1) - 1.0).max() <= 1e-14
    assert (found.principal[:, 0] >= found.principal[:, 1]).all()
    assert found.gauss == pytest.approx(found.principal.prod(axis=1), abs=1e-13)


def test_a_plane_far_away_has_no_directions() -> None:
    """On a turned plane at x = 100 m curvature is nil to rounding and no axis is given."""
    turned = nets()["P13_plane"] @ Rotation.from_euler("xyz", [0.3, 0.5, 0.7]).as_matrix().T
    uv = np.random.default_rng(2).uniform(size=(50, 2))
    found = curvatures(Patches.single(turned + 100.0), np.zeros(50, np.intp), uv)
    assert np.abs(found.principal).max() <= 1e-12
    assert np.isnan(found.axes).all()
    assert np.isnan(found.directions).all()


def test_an_umbilic_has_no_direction() -> None:
    """At the bottom of a round bowl no direction is principal; beside it there are two."""
    net = np.zeros((3, 3, 3))
    net[..., 0], net[..., 1] = np.mgrid[-1:2, -1:2]
    square = np.array([1.0, -1.0, 1.0])
    net[..., 2] = 0.1 * (square[:, None] + square)
    found = curvatures(
        Patches.single(net), np.zeros(2, np.intp), np.array([[0.5, 0.5], [0.7, 0.5]])
    )
    assert np.isnan(found.axes[0]).all()
    assert np.isfinite(found.axes[1]).all()
    assert found.principal[0] == pytest.approx([0.2, 0.2], rel=1e-15)


def test_a_pole_has_no_curvature() -> None:
    """Where an edge has shrunk to a point there is a place but no curvature, and no warning."""
    found = curvatures(
        Patches.single(nets()["P17_pole_sphere"]),
        np.zeros(2, np.intp), np.array([[0.5, 1.0], [0.3, 0.5]]),
    )  # fmt: skip
    for each in (found.gauss, found.mean, found.principal, found.axes, found.normal):
        assert np.isnan(each[0]).all()
        assert np.isfinite(each[1]).all()
    assert np.isfinite(found.position).all()
    assert found.element[0] <= 1e-15


def test_a_bilinear_patch() -> None:
    """On z = x y, of degree 1 both ways, K = -1 / (1 + x**2 + y**2)**2 and H = -x y / ...**1.5."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
    uv = np.random.default_rng(3).uniform(size=(50, 2))
    found = curvatures(Patches.single(net), np.zeros(50, np.intp), uv)
    x, y = uv.T
    square = 1 + x**2 + y**2
    assert found.gauss == pytest.approx(-1 / square**2, rel=1e-13)
    assert found.mean == pytest.approx(-x * y / square**1.5, rel=1e-12)


def test_far_away_is_as_good_as_here() -> None:
    """A net of short numbers has the same curvatures, bit for bit, where it is moved by 2**20 m."""
    net = np.random.default_rng(5).integers(-99, 100, (4, 4, 3)) / 16.0
    uv, row = np.random.default_rng(6).uniform(size=(30, 2)), np.zeros(30, np.intp)
    here, there = (curvatures(Patches.single(each), row, uv) for each in (net, net + 2.0**20))
    assert np.array_equal(here.gauss, there.gauss)
    assert np.array_equal(here.mean, there.mean)


def test_a_point_does_not_depend_on_the_others() -> None:
    """Each of many points on many patches has the bits that it has alone."""
    rng = np.random.default_rng(4)
    patches = Patches(rng.normal(size=(9, 4, 4, 3)), np.zeros((9, 2, 2)), np.zeros(9, np.intp))
    row, uv = rng.integers(9, size=80), rng.uniform(size=(80, 2))
    many = curvatures(patches, row, uv)
    for i in range(0, 80, 9):
        alone = curvatures(patches[row[i : i + 1]], np.zeros(1, np.intp), uv[i : i + 1])
        for name in ("position", "normal", "element", "gauss", "mean", "principal", "axes"):
            assert getattr(many, name)[i].tobytes() == getattr(alone, name).tobytes(), name

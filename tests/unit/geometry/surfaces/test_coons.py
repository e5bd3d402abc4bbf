"""The surface through a net: it holds the lines it is made of, and is closed."""

import numpy as np
import pytest

from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.analysis.net.surface_layout import blend_cubics, lay_out_surface
from assoc_hull.geometry.curves import FloatArray, IsoCurves
from assoc_hull.geometry.splines.backend import backend, set_backend
from assoc_hull.geometry.surfaces.coons import CoonsStrips
from assoc_hull.model.tables import HullState
from assoc_hull.shipped.wigley import wigley
from tests.nets import ellipsoid_net

STEP = 1e-6


@pytest.fixture(
    scope="module", params=[lambda: wigley(), lambda: ellipsoid_net(11, 6)], ids=["Wigley", "egg"]
)
def surface(request: pytest.FixtureRequest) -> tuple[HullState, CurveNet, CoonsStrips]:
    """Give a hull, its net and its surface with a closed deck."""
    state: HullState = request.param()
    net = gather_net(state)
    layout = lay_out_surface(net, state.particulars.length, closed=True)
    assert layout.lost == ()
    return state, net, CoonsStrips.on(layout.cells, net.batch)


def _at(curves: IsoCurves, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give P, P_u and P_v at parameters u of every tile, (s, k, 3) each."""
    value = u[:, None] ** np.arange(4)
    slope = np.arange(4) * u[:, None] ** np.maximum(np.arange(4) - 1, 0)
    return (
        np.einsum("kc,scx->skx", value, curves.point),
        np.einsum("kc,scx->skx", slope, curves.point),
        np.einsum("kc,scx->skx", value, curves.across),
    )


def test_across_is_the_derivative_along_the_strip(
    surface: tuple[HullState, CurveNet, CoonsStrips],
) -> None:
    """P_v agrees with central differences of P."""
    strips = surface[2]
    every = np.arange(strips.count)
    v = np.full(strips.count, 0.37)
    u = np.linspace(0.0, 1.0, 5)
    low, high = (_at(strips.curves(every, v + sign * STEP), u)[0] for sign in (-1, 1))
    across = _at(strips.curves(every, v), u)[2]
    assert across == pytest.approx((high - low) / (2.0 * STEP), abs=1e-6)


def test_tiles_of_a_curve_join(surface: tuple[HullState, CurveNet, CoonsStrips]) -> None:
    """Each tile ends where the next begins; a closed deck ends on the centre plane."""
    strips = surface[2]
    for v in (0.0, 0.3, 1.0):
        curves = strips.curves(np.arange(strips.count), np.full(strips.count, v))
        end = curves.point.sum(axis=1)
        inner = np.setdiff1d(np.arange(len(end)), curves.start[1:] - 1)
        assert end[inner] == pytest.approx(curves.point[inner + 1, 0], abs=1e-9)
        assert end[curves.start[1:] - 1, 1] == pytest.approx(0.0, abs=1e-9)
        assert curves.point[curves.start[:-1], 0, 1] == pytest.approx(0.0, abs=1e-9)


def test_curves_between_sections_are_sections(
    surface: tuple[HullState, CurveNet, CoonsStrips],
) -> None:
    """In a strip between two sections x is constant along each curve, and grows evenly with v."""
    strips = surface[2]
    plane = np.flatnonzero(strips.cells.plane)
    assert len(plane) > 5
    v = np.full(len(plane), 0.61)
    middle, ends = strips.curves(plane, v), [
        strips.curves(plane, np.full(len(plane), each)) for each in (0.0, 1.0)
    ]  # fmt: skip
    u = np.linspace(0.0, 1.0, 4)
    x = _at(middle, u)[0][:, :, 0]
    begin, finish = (_at(each, u)[0][:, :1, 0] for each in ends)
    assert x == pytest.approx(np.broadcast_to(begin + 0.61 * (finish - begin), x.shape), abs=1e-9)


def test_the_surface_is_closed(surface: tuple[HullState, CurveNet, CoonsStrips]) -> None:
    """The vector area of both halves with a deck is nil: along x and z; y is odd anyway.

    Both hulls run to a point or an edge at either end, so that there are no faces.
    """
    strips = surface[2]
    v, weight = np.polynomial.legendre.leggauss(24)
    v, weight = 0.5 + 0.5 * v, 0.5 * weight
    u, share = np.polynomial.legendre.leggauss(6)
    total, size = np.zeros(3), 0.0
    for strip in range(strips.count):
        curves = strips.curves(np.full(len(v), strip), v)
        _, along, across = _at(curves, 0.5 + 0.5 * u)
        normal = np.cross(along, across) * (0.5 * share)[:, None]
        rule = weight[np.repeat(np.arange(len(v)), np.diff(curves.start))]
        total += (normal * rule[:, None, None]).sum(axis=(0, 1))
        size += (np.abs(normal) * rule[:, None, None]).sum()
    assert total[[0, 2]] == pytest.approx(0.0, abs=1e-5 * size)


def test_anchors_lie_in_the_surface(surface: tuple[HullState, CurveNet, CoonsStrips]) -> None:
    """Points of waterlines and diagonals between the sections are points of the surface."""
    _, _net, strips = surface
    cells, walked = strips.cells, strips.walked
    v = 0.43
    for strip in np.flatnonzero(cells.plane)[:6].tolist():
        path = cells.anchor[cells.anchor_start[strip] : cells.anchor_start[strip + 1]]
        path = path[path >= 0]
        place = walked.at_part(path, np.full(len(path), v))[0]
        curves = strips.curves(np.array([strip]), np.array([v]))
        joints = np.concatenate([curves.point[:, 0], curves.point[-1:].sum(axis=1)])
        away = np.abs(place[:, None] - joints[None]).max(axis=2).min(axis=1)
        assert away == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("count", [2, 3, 4, 7])
def test_blends_carry_parabolas_on_without_error(count: int) -> None:
    """Values of a parabola at the anchors give the parabola in every cell."""
    height = np.sort(np.random.default_rng(count).uniform(0.0, 1.0, count))
    coefficients = (0.3, -1.2, 0.0 if count == 2 else 2.0)

    def parabola(h: FloatArray) -> FloatArray:
        return coefficients[0] + coefficients[1] * h + coefficients[2] * h * h

    first, cubic = blend_cubics(height)
    value = np.concatenate([parabola(height), np.zeros(4)])
    f = np.linspace(0.0, 1.0, 6)
    for cell in range(count - 1):
        at = height[cell] + f * (height[cell + 1] - height[cell])
        found = (f[:, None] ** np.arange(4)) @ (cubic[cell] @ value[first[cell] : first[cell] + 4])
        assert found == pytest.approx(parabola(at), abs=1e-9)


def test_compiled_code_gives_the_same_surface(
    surface: tuple[HullState, CurveNet, CoonsStrips],
) -> None:
    """To rounding; where numba is not installed there is nothing to compare."""
    pytest.importorskip("numba")
    strips = surface[2]
    every = np.arange(strips.count).repeat(3)
    v = np.tile([0.0, 0.37, 1.0], strips.count)
    before = backend()
    try:
        set_backend("numpy")
        plain = strips.curves(every, v)
        set_backend("numba")
        fast = strips.curves(every, v)
    finally:
        set_backend(before)
    assert fast.start.tolist() == plain.start.tolist()
    assert fast.point == pytest.approx(plain.point, abs=1e-11)
    assert fast.across == pytest.approx(plain.across, abs=1e-9)

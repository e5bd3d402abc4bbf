"""Areas of the regions of a sign: true to the estimate of their error, whatever the patch."""

from collections.abc import Callable
from functools import cache

import attrs
import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.area_integrals import (
    AreaIntegrator,
    areas_over_boxes,
    elements_on_grid,
    integrals_along_lines,
)
from assoc_hull.geometry.patches.areas_by_sign import SignAreas, sign_areas
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cell_subdivision import subdivide_patches
from assoc_hull.geometry.patches.curvature_functions import IsoFunction, gauss_function
from assoc_hull.geometry.patches.zero_set_arcs import arcs_of
from tests.curved_patches import graph_plates, nets, patch, random_nets, references

DEVELOPABLE = ("P13_plane", "P14_cyl", "P15_cyl_rot", "P16_cone_rot")


def batch(net: FloatArray) -> Patches:
    """Patches of nets (k, m + 1, n + 1, 3), each on its own."""
    box = np.broadcast_to([[0.0, 1.0], [0.0, 1.0]], (len(net), 2, 2))
    return Patches(np.array(net), box.copy(), np.arange(len(net)))


def solved(
    net: FloatArray, level: float = 0.0, delta: float = 0.0
) -> Callable[[float, bool], SignAreas]:
    """What gives the areas of nets (k, m + 1, n + 1, 3) at a tolerance, by series or points."""
    patches = batch(net)
    cells = subdivide_patches(gauss_function(patches, level, delta))
    arcs = arcs_of(cells)

    def at(tol: float, by_series: bool = True) -> SignAreas:
        return sign_areas(patches, cells, arcs, tol, AreaIntegrator.of(patches, tol, by_series))

    return at


def found(net: FloatArray, tol: float, level: float = 0.0) -> SignAreas:
    """The areas of nets (k, m + 1, n + 1, 3)."""
    return solved(net, level)(tol, True)


def parts(of: SignAreas) -> FloatArray:
    """Positive, negative, nil and undecided areas and the total, (5, k)."""
    return np.array([of.positive, of.negative, of.zero, of.unresolved, of.total])


@cache
def of_table(name: str) -> Callable[[float, bool], SignAreas]:
    """What gives the areas of a patch of the table."""
    return solved(patch(name)[None], delta=1e-12 if name in DEVELOPABLE else 0.0)


@cache
def reference_areas(name: str, tol: float) -> SignAreas:
    """The areas of a patch of the table."""
    return of_table(name)(tol, True)


def worst(of: SignAreas, positive: FloatArray, negative: FloatArray) -> FloatArray:
    """The larger of both errors, in parts of the whole."""
    off = np.abs([of.positive_estimate - positive, of.negative_estimate - negative])
    return np.asarray(off.max(axis=0) / of.total)


@pytest.mark.parametrize("tol", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10])
@pytest.mark.parametrize("name", sorted(nets()))
def test_the_estimate_is_no_smaller_than_the_error(name: str, tol: float) -> None:
    """On each known patch error <= estimate <= tolerance; at 1e-10 the error is below 1e-12."""
    known, got = references()[name], reference_areas(name, tol)
    error = worst(got, np.array([known.positive]), np.array([known.negative]))[0]
    estimate = got.error_estimate[0] / got.total[0]
    assert error <= estimate + 1e-14
    assert abs(got.zero[0] - known.zero) <= 1e-12 + got.error_estimate[0]
    if name == "P07_double_cross":
        assert got.negative[0] <= known.negative <= got.negative[0] + got.unresolved[0] + 1e-12
        assert got.positive_estimate[0] <= 1e-8
        if tol <= 1e-8:
            assert abs(got.negative_estimate[0] - known.negative) <= 1e-8
        return
    assert estimate <= tol
    if tol == 1e-10:
        assert error <= 1e-12
        assert abs(got.total[0] - known.total) <= 3e-14 * known.total


@pytest.mark.parametrize("tol", [1e-2, 1e-6, 1e-10])
def test_the_parts_make_up_a_total_found_otherwise(tol: float) -> None:
    """Positive, negative, nil and undecided areas add up to the total within 10 tolerances."""
    for name in nets():
        *each, total = parts(reference_areas(name, tol))
        assert abs(sum(each) - total)[0] <= 10.0 * tol * total[0]


@pytest.mark.parametrize("net", [graph_plates(60, 3), random_nets(5, 4)], ids=["plates", "nets"])
def test_estimates_hold_on_random_patches(net: FloatArray) -> None:
    """Against areas at a tolerance of 1e-10 no estimate is too small, and none far too large."""
    of = solved(net)
    true = of(1e-10, True)
    for tol in (1e-2, 1e-4, 1e-6, 1e-8):
        got = of(tol, True)
        error = worst(got, true.positive_estimate, true.negative_estimate)
        error = np.maximum(error, np.abs(got.total - true.total) / true.total)
        estimate = got.error_estimate / got.total
        assert (error <= estimate + 1e-11).all()
        assert (estimate <= 1.5 * tol).all()


def test_series_and_points_agree() -> None:
    """Areas by series and by points of their own differ by no more than both estimates say."""
    of = solved(graph_plates(20, 7))
    a, b = of(1e-8, True), of(1e-8, False)
    assert (np.abs(parts(a) - parts(b)) <= a.error_estimate + b.error_estimate).all()
    assert np.abs(parts(a) - parts(b)).max() > 0.0


def test_a_patch_does_not_depend_on_the_others() -> None:
    """Alone, in a batch and in another order all areas are the same to the last bit."""
    some = [net for net in nets().values() if net.shape == (4, 4, 3)]
    net = np.concatenate([graph_plates(8, 5), random_nets(1, 6), np.array(some[:6])])
    fields = [field.name for field in attrs.fields(SignAreas)]
    whole = found(net, 1e-6)
    order = np.random.default_rng(8).permutation(len(net))
    other = found(net[order], 1e-6)
    alone = [found(net[i : i + 1], 1e-6) for i in range(len(net))]
    for name in fields:
        assert np.array_equal(getattr(whole, name)[order], getattr(other, name))
        assert [getattr(one, name)[0] for one in alone] == getattr(whole, name).tolist()


def turned(net: FloatArray) -> FloatArray:
    """A net rotated and moved to 100 m."""
    axis = np.linalg.qr(np.random.default_rng(1).standard_normal((3, 3)))[0]
    return np.asarray(net @ axis.T + np.array([100.0, 7.0, 3.0]))


def halved(net: FloatArray, axis: int) -> FloatArray:
    """Nets cut in halves, first all lower ones: means of means."""
    rows = np.moveaxis(net, axis, 0)
    low, high = [rows[0]], [rows[-1]]
    while len(rows) > 1:
        rows = 0.5 * (rows[:-1] + rows[1:])
        low.append(rows[0])
        high.append(rows[-1])
    return np.concatenate([np.moveaxis(np.array(p), 0, axis) for p in (low, high[::-1])])


SAME: dict[str, Callable[[FloatArray], FloatArray]] = {
    "moved": turned,
    "exchanged": lambda net: net.swapaxes(1, 2),
    "reversed in u": lambda net: net[:, ::-1],
    "reversed in v": lambda net: net[:, :, ::-1],
    "mirrored": lambda net: net * np.array([1.0, -1.0, 1.0]),
    "in four": lambda net: halved(halved(net, 1), 2),
}


@pytest.mark.parametrize("way", sorted(SAME))
def test_areas_do_not_depend_on_place_or_parameters(way: str) -> None:
    """What leaves the surface as it is changes areas by 1e-12 of the total at most."""
    net = np.concatenate([graph_plates(12, 9), patch("P08_wavy_plate")[None, :4, :4]])
    first, second = parts(found(net, 1e-10)), parts(found(SAME[way](net), 1e-10))
    second = second.reshape(5, -1, len(net)).sum(axis=1)
    assert (first[:2] > 0.0).sum() > len(net)
    assert np.abs(first - second).max() <= 1e-12 * first[4].min()


@pytest.mark.parametrize("shape", [(3, 4), (4, 3), (2, 4), (3, 3), (5, 4)])
def test_degrees_may_differ(shape: tuple[int, int]) -> None:
    """Of any two degrees areas are found, and stay the same with the parameters exchanged."""
    u, v = np.meshgrid(np.linspace(0, 4, shape[0]), np.linspace(0, 2, shape[1]), indexing="ij")
    height = 0.3 * np.random.default_rng(2).standard_normal((6, *shape))
    net = np.stack([np.broadcast_to(u, height.shape), np.broadcast_to(v, height.shape), height], -1)
    first, second = found(net, 1e-10), found(net.swapaxes(1, 2), 1e-10)
    error = worst(first, second.positive_estimate, second.negative_estimate) * first.total
    assert (error <= first.error_estimate + second.error_estimate).all()
    assert np.abs(first.total - second.total).max() <= 1e-12
    if min(shape) > 2:  # A ruled patch has K = -M**2: lines where it is nil are not resolved.
        assert (first.error_estimate <= 1e-10 * first.total).all()


def test_levels_of_curvature_part_a_plate() -> None:
    """What exceeds a level shrinks as this rises; what is below it grows by as much."""
    net = patch("P20_five_arcs")[None]
    levels = (-0.03, -0.01, -0.003, 0.0, 0.0003, 0.001, 0.003)
    got = [found(net, 1e-8, level) for level in levels]
    above = np.array([each.positive[0] for each in got])
    known = [15.232, 14.024, 7.305, 3.594, 3.290, 2.565, 1.362]
    assert np.abs(above - known).max() < 6e-4
    assert np.abs(above + [each.negative[0] for each in got] - got[0].total[0]).max() < 1e-8


def test_the_area_below_a_line_is_known() -> None:
    """A plane patch with a straight border between signs has areas that one can tell."""
    net = np.zeros((1, 2, 2, 3))
    net[0, 1, :, 0], net[0, :, 1, 1] = 2.0, 3.0
    line = np.array([[[-1.0, -2.0], [3.0, 2.0]]])
    cells = subdivide_patches(IsoFunction(line, 1e-15 + 0.0 * line))
    got = sign_areas(batch(net), cells, arcs_of(cells), 1e-9)
    assert got.negative == pytest.approx([2.25], abs=1e-12)
    assert got.positive == pytest.approx([3.75], abs=1e-12)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_arc_too_short_to_count_leaves_its_cell_whole(sign: float) -> None:
    """A polynomial that is nil at a corner, but for 1e-15, has the sign of the rest."""
    net = np.zeros((1, 2, 2, 3))
    net[0, 1, :, 0] = net[0, :, 1, 1] = 1.0
    line = sign * np.array([[[-1e-15, 1.0], [1.0, 2.0]]])
    cells = subdivide_patches(IsoFunction(line, 1e-20 + 0.0 * line))
    assert not len(arcs_of(cells))
    got = sign_areas(batch(net), cells, arcs_of(cells), 1e-9)
    assert got.positive == pytest.approx([float(sign > 0.0)], abs=1e-12)
    assert got.negative == pytest.approx([float(sign < 0.0)], abs=1e-12)


def test_nets_without_area_have_none() -> None:
    """A net that is a point or a line has no area, no error, and ends."""
    net = np.zeros((2, 4, 4, 3))
    net[1, ..., 0] = np.arange(4.0)[:, None]
    assert (parts(found(net, 1e-6)) == 0.0).all()


def test_the_normal_may_vanish_inside() -> None:
    """A plane covered twice, round a point where the normal vanishes, has the area one can tell."""
    u, v = np.meshgrid(*[np.linspace(-1.0, 1.0, 3)] * 2, indexing="ij")
    uu, vv = np.meshgrid(*[np.array([1.0, -1.0, 1.0])] * 2, indexing="ij")
    # (u2 - v2, 2 u v, 0) covers a plane twice: the length of its normal is 4 (u2 + v2).
    net = np.stack([uu - vv, 2.0 * u * v, 0.0 * u], axis=-1)[None]
    got = found(net, 1e-8)
    assert got.total == pytest.approx([32.0 / 3.0], rel=1e-12)


def test_points_halve_what_is_not_smooth() -> None:
    """Over a fold, where the element has a kink, boxes and lines are halved to the tolerance."""
    net = np.zeros((1, 3, 2, 3))
    net[0, :, :, 0] = np.array([0.0, 1.0, 0.4])[:, None]
    net[0, :, 1, 1] = 1.0
    slope = np.array([2.0, -1.2])
    turn = slope[0] / (slope[0] - slope[1])
    true = 0.5 * (slope[0] * turn - slope[1] * (1.0 - turn))
    patches, row = batch(net), np.array([0])
    tolerance = np.array([1e-7])
    value, error = areas_over_boxes(patches, row, np.array([[[0.0, 1.0], [0.0, 1.0]]]), tolerance)
    assert abs(value[0] - true) <= error[0] <= 1e-7
    value, error = integrals_along_lines(
        patches, row, np.array([[0.0, 1.0]]), np.array([0.3]), tolerance
    )
    assert abs(value[0] - true) <= error[0] <= 1e-7


def test_the_element_is_that_of_the_points_themselves() -> None:
    """At 100 m from the origin |r_u x r_v| has lost no more than the points have."""
    net = graph_plates(3, 1)
    t = np.linspace(0.0, 1.0, 9)
    near, far = (elements_on_grid(batch(each), t, t) for each in (net, turned(net)))
    assert np.abs(near / far - 1.0).max() < 1e-13

"""Curvature regions of patches whose areas are known from elsewhere: closed forms, slicing."""

from functools import cache

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.tensor_bernstein import bernstein_basis
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.regions.level_lines import RegionAreas
from assoc_hull.surface.regions.result import RegionResult
from tests.curved_patches import graph_plates, patch, random_nets, references

NAMES = tuple(references())
ENDED_EARLY = "P07_double_cross"


@cache
def found(area_tol: float) -> RegionResult:
    """The reference patches, all in one call; coordinates are known to their rounding."""
    surfaces = [SplineSurface.bezier(patch(name), name) for name in NAMES]
    return ah.surface.curvature_regions(surfaces, zero="exact", delta=1e-14, area_tol=area_tol)


def areas_of(name: str, area_tol: float) -> RegionAreas:
    """The areas of one of them."""
    return found(area_tol).of_surface(NAMES.index(name))


@pytest.mark.parametrize("name", NAMES)
def test_areas_are_those_of_the_reference(name: str) -> None:
    """At a tolerance of 1e-10 every area is within 1e-9 of the total of what it has to be."""
    truth, areas = references()[name], areas_of(name, 1e-10)
    within = 1e-9 * truth.total
    if name == ENDED_EARLY:
        assert areas.positive_estimate == pytest.approx(truth.positive, rel=0, abs=1e-8)
        assert areas.negative_estimate == pytest.approx(truth.negative, rel=0, abs=1e-8)
        # The table has 13 decimals.
        assert areas.negative <= truth.negative <= areas.negative + areas.unresolved + 1e-13
        return
    wanted = truth.positive, truth.negative, truth.zero, truth.total
    got = areas.positive_estimate, areas.negative_estimate, areas.zero, areas.total
    assert got == pytest.approx(wanted, rel=0, abs=within)
    assert areas.positive <= truth.positive + within
    assert truth.positive <= areas.positive + areas.unresolved + within


@pytest.mark.parametrize("area_tol", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10])
def test_the_error_estimate_holds(area_tol: float) -> None:
    """It is above the true error of every area, and below the tolerance unless a search ended."""
    for name in NAMES:
        truth, areas = references()[name], areas_of(name, area_tol)
        off = max(
            abs(areas.positive_estimate - truth.positive),
            abs(areas.negative_estimate - truth.negative),
            abs(areas.zero - truth.zero),
            abs(areas.total - truth.total),
        )
        assert off <= areas.error_estimate + 1e-14 * truth.total, name
        assert areas.error_estimate <= area_tol * truth.total or name == ENDED_EARLY, name


@pytest.mark.parametrize("name", NAMES)
def test_the_four_areas_add_up_to_the_total(name: str) -> None:
    """Positive, negative, zero and unresolved are the whole, which is found by itself."""
    areas = areas_of(name, 1e-10)
    parts = areas.positive + areas.negative + areas.zero + areas.unresolved
    assert parts == pytest.approx(areas.total, rel=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_lines_are_of_the_kinds_of_the_reference(name: str) -> None:
    """So many loops, lines from border to border, junctions and isolated spots, and no others."""
    truth, result = references()[name], found(1e-10)
    kinds = [each.kind for each in result.components if each.surface == NAMES.index(name)]
    counts = {kind: kinds.count(kind) for kind in ("closed", "open", "junction", "isolated")}
    wanted = attrs.asdict(truth)
    assert counts == {kind: wanted[kind] for kind in counts}


def test_polylines_lie_on_the_lines() -> None:
    """K = 0 of x**3 + y**2 is the line x = 0, from border to border; its points are exact."""
    result, number = found(1e-10), NAMES.index("P01_x3_plus_y2")
    (line,) = [each for each in result.components if each.surface == number]
    (xyz,) = line.xyz
    assert np.abs(xyz[:, 0]).max() <= 1e-14
    assert sorted(xyz[[0, -1], 1]) == pytest.approx([-0.8, 0.9], abs=1e-15)
    assert line.ends == 2


def noisy_cylinder(noise: float) -> FloatArray:
    """A cylinder of 6 m x 2 m with control points that are off by up to so much, m."""
    net = patch("P14_cyl")
    return net + noise * np.random.default_rng(11).uniform(-1.0, 1.0, net.shape)


@pytest.mark.parametrize("noise", [1e-15, 1e-9, 1e-6, 1e-4])
def test_a_cylinder_with_noise_is_developable(noise: float) -> None:
    """Where points are known to the noise, or in a band, all of it has no curvature."""
    net = noisy_cylinder(noise)
    for result in (
        ah.surface.curvature_regions(net, zero="exact", delta=max(noise, 1e-12)),
        ah.surface.curvature_regions(net, zero="absolute", k0=1e-4),
        ah.surface.curvature_regions(net),
    ):
        assert (result.positive, result.negative, result.unresolved) == (0.0, 0.0, 0.0)
        assert abs(result.zero - result.total) <= result.error_estimate <= 1e-6 * result.total
        assert result.total == pytest.approx(12.268, abs=1e-3)


@pytest.mark.parametrize("noise", [1e-9, 1e-6, 1e-4])
def test_without_a_band_noise_decides_the_sign(noise: float) -> None:
    """Taken as exact, the same cylinder is convex and a saddle in turn: what the band is for."""
    areas = ah.surface.curvature_regions(noisy_cylinder(noise), zero="exact", delta=0.0).areas
    assert min(areas.positive, areas.negative) > 0.1 * areas.total


def test_a_band_leaves_no_double_lines() -> None:
    """x**2 y**2 has K = 0 along two lines that it only touches; at K = -K0 there are four arcs."""
    result = ah.surface.curvature_regions(patch(ENDED_EARLY), zero="absolute", k0=1e-3)
    assert [each.kind for each in result.components] == ["open"] * 4
    assert {each.level for each in result.components} == {-1e-3}
    assert (result.unresolved, result.notes) == (0.0, ())


def test_the_convex_part_shrinks_as_the_level_rises() -> None:
    """Areas above a level, of a plate with five arcs, fall in the known way."""
    known = {
        -0.03: 15.232, -0.01: 14.024, -0.003: 7.305, 0.0: 3.594, 0.0003: 3.290, 0.001: 2.565,
        0.003: 1.362,
    }  # fmt: skip
    net = patch("P20_five_arcs")
    above: dict[float, float] = {}
    for width in sorted({abs(level) for level in known} - {0.0}):
        areas = ah.surface.curvature_regions(net, zero="absolute", k0=width).areas
        above |= {width: areas.positive, -width: areas.total - areas.negative}
    above[0.0] = ah.surface.curvature_regions(net, zero="exact", delta=0.0).positive
    for level, area in known.items():
        assert above[level] == pytest.approx(area, abs=6e-4), level
    assert np.all(np.diff([above[level] for level in sorted(above)]) < 0.0)


def saddle_with_a_convex_disc(radius: float, across: float = 0.1) -> FloatArray:
    """x**3 - 3 x y**2 + 3 radius (x**2 + y**2): K > 0 in a disc about (across, 0.07), m."""
    at = np.linspace(-1.0, 1.0, 4)
    x, y = np.meshgrid(at, at, indexing="ij")
    a, b = x - across, y - 0.07
    heights = a**3 - 3.0 * a * b**2 + 3.0 * radius * (a**2 + b**2)
    to_net = np.linalg.inv(bernstein_basis(3, (at + 1.0) / 2.0))
    return np.stack([x, y, to_net @ heights @ to_net.T], axis=-1)


@pytest.mark.parametrize("radius", [1e-2, 1e-3, 1e-4])
def test_a_small_loop_is_found(radius: float) -> None:
    """A convex disc of a tenth of a millimetre in a saddle of two metres is closed and measured."""
    result = ah.surface.curvature_regions(
        saddle_with_a_convex_disc(radius), zero="exact", delta=0.0, area_tol=1e-8
    )
    assert [each.kind for each in result.components] == ["closed"]
    assert result.positive == pytest.approx(np.pi * radius**2, rel=1e-3, abs=1e-9)


def test_a_loop_that_touches_a_cut_is_closed() -> None:
    """Where the search cuts first, at u = 0.4871, a line may touch: it is one loop all the same."""
    net = saddle_with_a_convex_disc(0.3, 2.0 * 0.4871 - 1.0 + 0.3)
    result = ah.surface.curvature_regions(net, zero="exact", delta=0.0)
    assert [each.kind for each in result.components] == ["closed"]
    assert (result.unresolved, result.notes) == (0.0, ())


def test_a_loop_below_the_resolution_is_told() -> None:
    """A disc of a hundredth of a millimetre is an unresolved spot, never silently lost."""
    result = ah.surface.curvature_regions(
        saddle_with_a_convex_disc(1e-5), zero="exact", delta=0.0, area_tol=1e-12
    )
    assert [each.kind for each in result.components] == ["isolated"]
    assert result.unresolved > 0.0
    assert any("unresolved" in note for note in result.notes)


def test_the_whole_is_the_sum_of_its_patches() -> None:
    """A B-spline surface of 15 patches has the areas of these as single patches, to the bit."""
    draw = np.random.default_rng(5)
    net = np.moveaxis(np.mgrid[0:8, 0:6], 0, -1) * [1.0, 0.6]
    net = np.concatenate([net, 0.2 * draw.standard_normal((8, 6, 1))], axis=-1)
    along, across = ([0, 0, 0, *range(count - 2), *[count - 3] * 3] for count in (8, 6))
    surface = SplineSurface("spline", (3, 3), np.array(along), np.array(across), net)
    whole = ah.surface.curvature_regions(surface, zero="exact")
    apart = [SplineSurface.bezier(each) for each in surface.patches().net]
    single = [ah.surface.curvature_regions(each, zero="exact").areas for each in apart]
    assert len(single) == 15
    assert RegionAreas.added(attrs.astuple(each) for each in single) == whole.areas


def test_random_patches_have_no_dangling_ends() -> None:
    """Lines of 120 random plates and 60 random nets all end where lines may end."""
    many = [*graph_plates(120, 1), *random_nets(60, 2)]
    result = ah.surface.curvature_regions([SplineSurface.bezier(net) for net in many], zero="exact")
    assert len(result.components) > 180
    areas = result.areas
    parts = areas.positive + areas.negative + areas.zero + areas.unresolved
    assert parts == pytest.approx(areas.total, rel=1e-5)

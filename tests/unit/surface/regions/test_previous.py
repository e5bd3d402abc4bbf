"""Patches taken from an earlier result: exactly those that have not changed, and to the bit."""

from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.regions.result import RegionResult

ROWS, COLUMNS = 9, 8


def heights(seed: int) -> FloatArray:
    """A net over a rectangle of 8 m x 4.2 m with random heights."""
    place = np.moveaxis(np.mgrid[0:ROWS, 0:COLUMNS], 0, -1) * [1.0, 0.6]
    draw = np.random.default_rng(seed).standard_normal((ROWS, COLUMNS, 1))
    return np.concatenate([place, 0.2 * draw], axis=-1)


def spline(net: FloatArray) -> SplineSurface:
    """A bicubic B-spline of 6 x 5 patches, curvature-continuous."""
    along, across = ([0, 0, 0, *range(n - 2), *[n - 3] * 3] for n in (ROWS, COLUMNS))
    return SplineSurface("spline", (3, 3), np.array(along), np.array(across), net)


def moved(net: FloatArray, i: int, j: int) -> FloatArray:
    """The net with one control point a little higher."""
    found = net.copy()
    found[i, j, 2] += 0.01
    return found


def bits(value: object) -> object:
    """A result as bytes and plain values, all of it but what was computed."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if isinstance(value, tuple | list):
        return [bits(each) for each in value]
    kind: type = type(value)
    if attrs.has(kind):
        names = [each.name for each in attrs.fields(kind) if each.name != "computed"]
        return [bits(getattr(value, name)) for name in names]
    return value


@pytest.fixture(scope="module")
def first() -> RegionResult:
    """The regions of a spline surface."""
    return ah.surface.curvature_regions(spline(heights(1)), zero="exact")


@pytest.mark.parametrize(
    ("i", "j", "touched"),
    [
        pytest.param(4, 4, 16, id="inside"),
        pytest.param(0, 0, 1, id="corner"),
        pytest.param(1, 0, 2, id="beside a corner"),
        pytest.param(8, 4, 4, id="border"),
        pytest.param(2, 1, 6, id="near a corner"),
    ],
)
def test_one_control_point_computes_the_patches_it_touches(
    first: RegionResult, i: int, j: int, touched: int
) -> None:
    """So many, no more; and the result has the bits of one from scratch, lines and notes too."""
    changed = spline(moved(heights(1), i, j))
    before, after = spline(heights(1)).patches().net, changed.patches().net
    assert (before != after).any(axis=(1, 2, 3)).sum() == touched
    found = ah.surface.curvature_regions(changed, zero="exact", previous=first)
    scratch = ah.surface.curvature_regions(changed, zero="exact")
    assert (found.computed, scratch.computed) == (touched, len(before))
    assert bits(attrs.evolve(found, surfaces=())) == bits(attrs.evolve(scratch, surfaces=()))


def test_nothing_changed_computes_nothing(first: RegionResult) -> None:
    """The same surface once more is taken whole."""
    again = ah.surface.curvature_regions(spline(heights(1)), zero="exact", previous=first)
    assert again.computed == 0
    assert bits(again.parts) == bits(first.parts)
    assert bits(again.components) == bits(first.components)


def test_patches_are_known_wherever_they_stand() -> None:
    """Surfaces in another order, one left out, another added: only the new one is computed."""
    one, two, three = (spline(heights(seed)) for seed in (1, 2, 3))
    result = ah.surface.curvature_regions([one, two], zero="exact")
    turned = ah.surface.curvature_regions([two, one], zero="exact", previous=result)
    assert turned.computed == 0
    assert [turned.of_surface(i) for i in (0, 1)] == [result.of_surface(i) for i in (1, 0)]
    assert turned.areas == result.areas
    more = ah.surface.curvature_regions([three, two], zero="exact", previous=result)
    assert more.computed == more.count // 2 == 30


def test_a_net_that_occurs_twice_is_computed_once() -> None:
    """Two plates of one shape are one piece of work, and have the same areas."""
    net = heights(1)[:4, :4]
    result = ah.surface.curvature_regions([SplineSurface.bezier(net)] * 2, zero="exact")
    assert (result.computed, result.count) == (1, 2)
    assert result.of_surface(0) == result.of_surface(1)
    assert {piece.patches for piece in result.components} == {(0,), (1,)}


@pytest.mark.parametrize(
    "options",
    [
        pytest.param({"zero": "exact", "delta": 1e-9}, id="delta"),
        pytest.param({"zero": "exact", "area_tol": 1e-7}, id="area_tol"),
        pytest.param({"zero": "exact", "depth": 15}, id="depth"),
        pytest.param({"zero": "exact", "budget": 5000}, id="budget"),
        pytest.param({"zero": "exact", "levels": (1e-3,)}, id="levels"),
        pytest.param({}, id="band"),
    ],
)
def test_other_options_compute_all_anew(first: RegionResult, options: dict[str, Any]) -> None:
    """What was found under other options is not taken."""
    net = heights(1)[:4, :4]
    one = ah.surface.curvature_regions(net, zero="exact")
    assert ah.surface.curvature_regions(net, **options, previous=one).computed == 1


def test_surfaces_of_other_degrees_are_kept_apart() -> None:
    """Batches of several bidegrees find their patches again, each its own."""
    nets = [heights(1)[:m, :n] for m, n in ((4, 4), (3, 4), (2, 2), (4, 4))]
    nets[3] = moved(nets[3], 0, 0)
    surfaces = [SplineSurface.bezier(net) for net in nets]
    result = ah.surface.curvature_regions(surfaces)
    assert len(result.parts) == 3
    later = ah.surface.curvature_regions(surfaces[::-1], previous=result)
    assert later.computed == 0
    for number in range(4):
        alone = ah.surface.curvature_regions(surfaces[number]).areas
        assert later.of_surface(3 - number) == result.of_surface(number) == alone


def test_weights_are_part_of_what_a_patch_is() -> None:
    """A quarter of a cylinder by weights is developable; with other weights it is another patch."""
    corner = np.array([[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    net = np.stack([corner, corner + np.array([0.0, 0.0, 3.0])], axis=1)
    weights = np.repeat([[1.0], [np.sqrt(0.5)], [1.0]], 2, axis=1)
    round_one = SplineSurface.bezier(net, weights=weights)
    result = ah.surface.curvature_regions(round_one)
    assert abs(result.zero - 1.5 * np.pi) <= result.error_estimate
    for other in (SplineSurface.bezier(net), SplineSurface.bezier(net, weights=weights**2)):
        found = ah.surface.curvature_regions([other, round_one], previous=result)
        assert (found.computed, found.of_surface(1)) == (1, result.areas)
        assert found.of_surface(0) == ah.surface.curvature_regions(other).areas != result.areas


def test_what_is_no_result_is_refused() -> None:
    """`previous` takes a result and nothing else."""
    with pytest.raises(WrongTypeError, match="previous is 3"):
        ah.surface.curvature_regions(heights(1)[:4, :4], previous=3)  # type: ignore[arg-type]

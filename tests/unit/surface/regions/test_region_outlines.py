"""Outlines of regions on surfaces: the whole surface between them, on it, as fine as asked."""

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.surface.regions.result import REGIONS, RegionOutline
from tests.curved_patches import patch
from tests.unit.geometry.patches.test_joining import spline


def enclosed(outline: RegionOutline) -> float:
    """What an outline encloses in parameters."""
    (u, v), (next_u, next_v) = outline.uv.T, np.roll(outline.uv, -1, axis=0).T
    return float(0.5 * (u * next_v - next_u * v).sum())


@pytest.mark.parametrize("k0", [0.02, None], ids=["a band", "no band"])
def test_outlines_part_the_surface(k0: float | None) -> None:
    """The three regions of a surface of 15 patches enclose its parameters, and lie on it."""
    surface = spline(3)
    result = ah.surface.curvature_regions(surface, zero="absolute" if k0 else "exact", k0=k0)
    outlines = [each for region in REGIONS for each in result.outlines(region)]
    assert sum(enclosed(each) for each in outlines) == pytest.approx(15.0, abs=1e-12)
    for each in outlines:
        assert (enclosed(each) < 0.0) == each.hole
        place = surface.at(each.uv[:, 0], each.uv[:, 1])
        assert np.array_equal(place, each.xyz)


def test_chords_of_outlines_keep_the_tolerance() -> None:
    """Along the border of a bowl, the polygon strays by no more than the tolerance."""
    result = ah.surface.curvature_regions(patch("P12_bowl"), chord_tol=1e-3)
    (outline,) = result.outlines("positive")
    uv = 0.5 * (outline.uv + np.roll(outline.uv, -1, axis=0))
    middle = 0.5 * (outline.xyz + np.roll(outline.xyz, -1, axis=0))
    stray = np.linalg.norm(result.surfaces[0].at(uv[:, 0], uv[:, 1]) - middle, axis=1)
    assert 2.5e-4 < stray.max() <= 1e-3


def test_a_hole_is_told() -> None:
    """The saddle region about a convex disc has an outline and a hole, in this order."""
    outlines = ah.surface.curvature_regions(patch("P03_circle_loop"), zero="exact").outlines(
        "negative"
    )
    assert [each.hole for each in outlines] == [False, True]


def test_other_regions_are_refused() -> None:
    """A region that is not known is an error that names those that are."""
    result = ah.surface.curvature_regions(patch("P12_bowl"))
    with pytest.raises(BadInputError, match="positive"):
        result.outlines("convex")

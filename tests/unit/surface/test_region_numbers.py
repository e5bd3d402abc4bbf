"""Options and areas of regions: limits that are checked, sums that do not depend on an order."""

import itertools
from typing import Any

import attrs
import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.surface.regions.curvature_regions import band_areas
from assoc_hull.surface.regions.level_lines import RegionAreas
from assoc_hull.surface.regions.options import region_options


@pytest.mark.parametrize(
    ("given", "told"),
    [
        pytest.param({"area_tol": 1e-14}, "area_tol is 1e-14", id="finer than rounding"),
        pytest.param({"area_tol": 0.5}, "area_tol is 0.5", id="coarser than an area"),
        pytest.param({"depth": 0}, "depth is 0", id="no depth"),
        pytest.param({"depth": 31}, "depth is 31", id="too deep"),
        pytest.param({"depth": 3.0}, "depth is 3.0", id="depth that is no whole number"),
        pytest.param({"budget": 0}, "budget is 0", id="no budget"),
        pytest.param({"chord_tol": 0.0}, "chord_tol is 0.0", id="no chord"),
        pytest.param({"chord_tol": 1e-10}, "chord_tol is 1e-10", id="chord finer than rounding"),
        pytest.param({"levels": [1e-3, 0.0, 1e-3]}, "0.001 1/m2 2 times", id="level twice"),
        pytest.param({"levels": [0.0, -0.0]}, "0 1/m2 2 times", id="nil twice"),
        pytest.param({"levels": [np.nan]}, "levels is [nan]", id="level that is no number"),
    ],
)
def test_what_is_out_of_range_is_refused(given: dict[str, Any], told: str) -> None:
    """Each option has its limits; the message names it and its value."""
    with pytest.raises(BadInputError) as caught:
        region_options(**given)
    assert told in str(caught.value)


def test_areas_add_up_in_any_order() -> None:
    """Sums of areas are rounded once: the same bits whatever the order of the patches."""
    rows = np.random.default_rng(3).random((4, 8)) * 10.0 ** np.arange(-6, 10, 4)[:, None]
    sums = {attrs.astuple(RegionAreas.added(each)) for each in itertools.permutations(rows)}
    assert len(sums) == 1


def test_no_area_has_no_shares() -> None:
    """A share of nothing is nan, not an error."""
    assert np.isnan(RegionAreas.added(np.zeros((1, 8))).positive_share)


def test_a_band_parts_what_two_searches_find() -> None:
    """Above K0 and below -K0 come from one search each; the rest lies between, or is unresolved."""
    upper = np.array([[2.0, 6.5, 0.25, 0.25, 2.1, 6.9, 1e-9, 9.0]])
    lower = np.array([[5.0, 3.5, 0.0, 0.5, 5.2, 3.8, 2e-9, 9.0]])
    (found,) = band_areas(upper, lower)
    assert found.tolist() == [2.0, 3.5, 2.75, 0.75, 2.1, 3.8, 1e-9 + 2e-9, 9.0]
    assert found[:4].sum() == 9.0


def test_a_spot_that_neither_search_resolves_is_never_zero() -> None:
    """Where both searches end in the same spot, zero does not fall below nil, and sums hold."""
    upper = np.array([[4.0, 4.0, 0.0, 1.0, 4.5, 4.5, 0.0, 9.0]])
    lower = np.array([[4.0, 4.0, 0.0, 1.0, 4.5, 4.5, 0.0, 9.0]])
    (found,) = band_areas(upper, lower)
    assert found[:4].tolist() == [4.0, 4.0, 0.0, 1.0]
    upper[0, 3] = lower[0, 3] = 0.0
    upper[0, 1] = 4.0 - 1e-15
    assert band_areas(upper, lower)[0].min() == 0.0

"""What counts as no curvature: three modes, each with the numbers it uses and no others."""

from typing import Any

import pytest

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.surface.regions.options import zero_band


def test_the_band_of_a_strain_is_that_of_a_strip() -> None:
    """K0 = 8 strain / b**2, and the band echoes strain, breadth and mode."""
    band = zero_band("strain", strain_tol=2e-3, breadth=2.0)
    assert band.k0 == pytest.approx(4e-3, rel=1e-15)
    assert (band.mode, band.strain_tol, band.breadth, band.delta) == ("strain", 2e-3, 2.0, 0.0)
    assert band.levels == (band.k0, -band.k0)
    assert str(band) == "K0 = 0.004 1/m2 (strain 0.002 over 2 m)"


def test_a_band_as_such_is_taken_as_it_is() -> None:
    """The mode "absolute" uses K0 only."""
    band = zero_band("absolute", k0=1e-4, delta=1e-9)
    assert (band.k0, band.strain_tol, band.breadth, band.delta) == (1e-4, None, None, 1e-9)
    assert str(band) == "K0 = 0.0001 1/m2"


def test_without_a_band_there_is_one_level() -> None:
    """The mode "exact" has one level, nil, and leaves what points are known to to their size."""
    band = zero_band("exact")
    assert (band.levels, band.k0, band.delta) == ((0.0,), 0.0, None)
    assert zero_band("exact", delta=0.0).delta == 0.0


@pytest.mark.parametrize(
    ("given", "told"),
    [
        pytest.param({"zero": "none"}, "zero is 'none'", id="unknown mode"),
        pytest.param({"zero": "absolute"}, "without k0", id="absolute without k0"),
        pytest.param({"k0": 1e-3}, "k0 is given beside zero='strain'", id="k0 beside a strain"),
        pytest.param({"zero": "exact", "k0": 1e-3}, "k0 is given", id="k0 without a band"),
        pytest.param(
            {"zero": "exact", "strain_tol": 2e-3}, "strain_tol is 0.002", id="strain without a band"
        ),
        pytest.param(
            {"zero": "absolute", "k0": 1.0, "breadth": 2.0}, "breadth is 2", id="breadth beside k0"
        ),
        pytest.param({"zero": "absolute", "k0": 0.0}, "k0 is 0.0", id="k0 of nil"),
        pytest.param({"strain_tol": 0.0}, "strain_tol is 0", id="no strain"),
        pytest.param({"breadth": -1.0}, "breadth is -1", id="negative breadth"),
        pytest.param({"breadth": 1e-200}, "8 strain_tol / breadth**2 is", id="vanishing breadth"),
        pytest.param({"delta": -1e-9}, "delta is -1e-09", id="negative delta"),
    ],
)
def test_what_a_mode_does_not_use_is_refused(given: dict[str, Any], told: str) -> None:
    """A number is used or refused, never silently left aside; the message names it."""
    with pytest.raises(BadInputError) as caught:
        zero_band(**given)
    assert told in str(caught.value)
    assert isinstance(caught.value, AssocHullError)

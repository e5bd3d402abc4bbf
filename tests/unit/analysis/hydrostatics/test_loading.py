"""From weights to draughts, freeboard, and the heel at which the deck edge goes under."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.hydrostatics.draughts_from_weight import Load, position_under_load
from assoc_hull.analysis.hydrostatics.floating_body import (
    Appendage,
    FloatingPosition,
    deck_edge_heel,
    least_freeboard,
)
from assoc_hull.errors import BadInputError, OutOfRangeError
from tests.floating_bodies import Box, Wigley

BOX, WIGLEY = Box(), Wigley()


@pytest.mark.parametrize("t", [1.0, 3.5, 6.25])
def test_the_draught_of_a_weight_is_that_at_which_it_is_displaced(t: float) -> None:
    """V of the Wigley hull rises as (2/3) L B (T1^2 / T - T1^3 / 3 T^2)."""
    volume = 2 / 3 * 1000 * (t * t / 6.25 - t**3 / 3 / 6.25**2)
    found = position_under_load(WIGLEY, Load(1.025 * 1.006 * volume, 1.025, 1.006), 100.0)
    assert_allclose([found.draught_aft, found.draught_fore], t, rtol=1e-11)


@pytest.mark.parametrize(("trim", "heel"), [(0.0, 0.0), (1.5, 0.0), (-2.0, 8.0)])
def test_a_given_trim_is_kept(trim: float, heel: float) -> None:
    """A box of 12,000 m3 floats at 6 m in the middle at any trim and heel."""
    load = Load(12000.0, 1.0, trim_by_stern=trim, heel_deg=heel)
    found = position_under_load(BOX, load, 100.0)
    assert found.trim_by_stern == pytest.approx(trim, abs=1e-14)
    assert found.draught_mean == pytest.approx(6.0, rel=1e-13)
    assert found.heel_deg == heel


@pytest.mark.parametrize("kg", [None, 4.0, 9.0])
@pytest.mark.parametrize("heel", [0.0, 10.0])
def test_a_box_trims_until_buoyancy_lies_below_gravity(kg: float | None, heel: float) -> None:
    """x_B = 50 + tt L^2 / 12 T and z_B = T/2 + (tt^2 L^2 + th^2 B^2) / 24 T, in closed form."""
    load = Load(12000.0, 1.0, lcg=52.0, kg=kg, heel_deg=heel)
    found = position_under_load(BOX, load, 100.0)
    tt, th = -found.trim_by_stern / 100, np.tan(np.radians(heel))
    ahead = tt * 1e4 / 72 - 2.0
    high = 3.0 + (tt**2 * 1e4 + th**2 * 400) / 144
    up = 0.0 if kg is None else high - kg
    assert ahead + up * tt == pytest.approx(0.0, abs=1e-11)
    assert found.draught_mean == pytest.approx(6.0, rel=1e-12)
    assert tt > 0.0


@pytest.mark.parametrize("weight", [0.0, -5.0, 25000.0])
def test_a_weight_that_the_hull_does_not_carry_is_refused(weight: float) -> None:
    """The range at that trim and heel is told."""
    with pytest.raises(OutOfRangeError, match="a weight of") as caught:
        position_under_load(BOX, Load(weight, 1.0), 100.0)
    assert_allclose([caught.value.least, caught.value.most], [0.0, 24000.0], rtol=1e-12)


def test_a_centre_of_gravity_beyond_any_trim_is_refused() -> None:
    """No plane puts the buoyancy of half a box at its end."""
    with pytest.raises(BadInputError, match="no trim"):
        position_under_load(Box(closed=False), Load(12000.0, 1.0, lcg=99.0), 100.0)


def test_appendages_carry() -> None:
    """The draught at which hull and appendages displace the weight together."""
    fin = Appendage("fin", 200.0, (20.0, 0.0, -1.0))
    found = position_under_load(BOX, Load(12200.0, 1.0, appendages=(fin,)), 100.0)
    assert found.draught_mean == pytest.approx(6.0, rel=1e-12)


def test_a_weight_that_falls_into_the_jump_of_an_appendage_is_refused() -> None:
    """An appendage counts whole or not at all, so some weights have no draught."""
    pod = Appendage("pod", 200.0, (50.0, 0.0, 6.0))
    with pytest.raises(BadInputError, match="appendage gets wet at once"):
        position_under_load(BOX, Load(12100.0, 1.0, appendages=(pod,)), 100.0)


def test_freeboard_is_least_where_the_deck_is_nearest_to_the_water() -> None:
    """At the heeled side, and at right angles to the water."""
    found = least_freeboard(BOX.limits.deck, FloatingPosition(5.0, 7.0, 10.0), 100.0)
    th = np.tan(np.radians(10.0))
    assert found.least == pytest.approx((12 - 7 - 10 * th) / np.sqrt(1 + 4e-4 + th**2), rel=1e-14)
    assert found.place == (100.0, -10.0, 12.0)
    assert least_freeboard(BOX.limits.deck, FloatingPosition(13.0, 12.5), 100.0).least < 0.0


@pytest.mark.parametrize("closed", [True, False])
def test_the_deck_edge_of_a_box_goes_under_where_its_side_is_used_up(closed: bool) -> None:
    """A box turns about its middle: tan(heel) = 2 (D - T) / B, less what the trim takes."""
    found = deck_edge_heel(Box(closed=closed), FloatingPosition(8.0, 8.0), 100.0)
    assert found == pytest.approx(np.degrees(np.arctan(0.4)), abs=1e-10)
    trimmed = deck_edge_heel(Box(closed=closed), FloatingPosition(8.5, 7.5), 100.0)
    assert trimmed == pytest.approx(np.degrees(np.arctan(0.35)), abs=1e-10)


def test_the_deck_edge_that_is_under_water_upright_goes_under_at_once() -> None:
    """The angle is 0."""
    assert deck_edge_heel(BOX, FloatingPosition(12.5, 11.0), 100.0) == 0.0

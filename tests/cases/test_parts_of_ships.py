"""Parts of the ships that come with the library: they add up, and sections are their rate."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

import assoc_hull as ah
from assoc_hull.analysis.form.form_parameters import form_parameters, shape_of
from assoc_hull.analysis.form.longitudinal_parts import ShipSlices, largest_section, ship_slices
from assoc_hull.geometry.floating.sections import areas_at, integrate_slice
from assoc_hull.geometry.numeric.quadrature import gauss
from tests import twin_skeg
from tests.cases.test_twin_skeg import half_area
from tests.long_forms import draws

SHIPS = ("wigley", "series60_60", "series60_70", "bulk_carrier")

positions = st.tuples(st.floats(0.6, 1.05), st.floats(0.6, 1.05))
"""T_A and T_F, in parts of the design draught."""


@pytest.fixture(scope="module")
def ships(series60_60: ah.Hull, series60_70: ah.Hull, bulk_carrier: ah.Hull) -> dict[str, ah.Hull]:
    """All of them, by name."""
    found = (ah.examples.wigley(), series60_60, series60_70, bulk_carrier)
    return dict(zip(SHIPS, found, strict=True))


def parts(hull: ah.Hull, position: tuple[float, float]) -> ShipSlices:
    """Give a ship at draughts in parts of that of the design."""
    draught = shape_of(hull).header.draught
    shape = shape_of(hull, draughts=(position[0] * draught, position[1] * draught))
    return shape.take(ship_slices)


@pytest.mark.parametrize("name", SHIPS)
@settings(max_examples=draws(12))
@given(place=st.floats(-0.03, 1.04), position=positions)
def test_parts_on_both_sides_of_any_place_are_the_ship(
    ships: dict[str, ah.Hull], name: str, place: float, position: tuple[float, float]
) -> None:
    """Volume, waterplane and moments, even where a raked stem is cut; at even keel and trimmed.

    To 5e-6, which the rule along a strip is good for in which the keel comes out of the water:
    cut in two such a strip is integrated better than as a whole.
    """
    part = parts(ships[name], position)
    shape = part.shape
    x = place * shape.length
    both = part.aft_of(x) + part.forward_of(x)
    whole = shape.body.measure(shape.planes)
    found = {name: getattr(both, name) for name in ("volume", "moment_x", "moment_z", "area")}
    wanted = {name: float(getattr(whole, name)[0]) for name in found}
    assert found == pytest.approx(wanted, rel=5e-6)


@pytest.mark.parametrize("name", SHIPS)
@settings(max_examples=draws(12))
@given(place=st.floats(-0.03, 1.03), position=positions)
def test_a_thin_slice_is_the_integral_of_its_sections(
    ships: dict[str, ah.Hull], name: str, place: float, position: tuple[float, float]
) -> None:
    """dV(x < x0) = A(x0) dx0 over 2 cm, by another rule; to 1e-6 of B T.

    Not where a strip ends in the slice: there the area may jump.
    """
    shape = parts(ships[name], position).shape
    aft, strips, (node, weight) = place * shape.length, shape.body.spans, gauss(6)
    ends = np.concatenate([strips.aft, strips.fore])
    assume(not ((ends > aft) & (ends < aft + 0.02)).any())
    slice_ = integrate_slice(strips, aft, aft + 0.02, shape.planes).volume
    mean = float(areas_at(strips, aft + 0.02 * node, shape.planes) @ weight)
    assert abs(slice_ / 0.02 - mean) <= 1e-6 * shape.breadth * shape.draught


@pytest.mark.parametrize("name", SHIPS)
def test_no_section_is_larger_than_the_largest_section(
    ships: dict[str, ah.Hull], name: str
) -> None:
    """As drawn, or between; nor is it much larger than the largest of those drawn."""
    shape = shape_of(ships[name])
    largest, drawn = shape.take(largest_section).largest, shape.record.a_max
    between_ = areas_at(shape.body.spans, shape.length * np.linspace(0.3, 0.7, 401), shape.planes)
    assert between_.max() <= largest * (1.0 + 1e-12)
    assert drawn * (1.0 - 1e-9) <= largest <= 1.001 * drawn


def test_the_parallel_body_of_the_carrier_lies_between_its_flats(bulk_carrier: ah.Hull) -> None:
    """Its sections from 120 to 210 m are alike; what is as large to 1e-4 reaches a little on."""
    found = form_parameters(bulk_carrier, only=["PMBs", "PMBe", "L_R", "L_E", "V_R", "V_E", "V"])
    begin, end = (15.0 * (found[symbol].number or 0.0) for symbol in ("PMBs", "PMBe"))
    assert 112.5 < begin <= 120.0
    assert 210.0 <= end < 217.5
    assert found["L_R"].number == pytest.approx(begin)
    assert found["L_E"].number == pytest.approx(300.0 - end)
    volume = (found["V_R"].number or 0.0) + (found["V_E"].number or 0.0)
    level = shape_of(bulk_carrier).take(largest_section).largest * (end - begin)
    assert (found["V"].number or 0.0) - volume == pytest.approx(level, rel=1e-4)


def test_a_trim_does_not_take_the_parallel_body_away(bulk_carrier: ah.Hull) -> None:
    """It is told at even keel at the mean draught; what is measured below the water is not."""
    symbols = ["PMBs", "PMBe", "L_R", "V_R", "Amax"]
    level, trimmed = (
        form_parameters(bulk_carrier, draughts=draughts, only=symbols)
        for draughts in ((14.0, 14.0), (16.0, 12.0))
    )
    for symbol in symbols[:3]:
        assert trimmed[symbol].number == level[symbol].number
    for symbol in symbols[3:]:
        assert (trimmed[symbol].number or 0.0) > (level[symbol].number or 0.0) > 0.0


def test_series_60_has_the_parallel_body_and_entrance_of_its_plan(
    series60_60: ah.Hull, series60_70: ah.Hull
) -> None:
    """None at CB .60, 11.9 % of Lpp at .70; half angles of entrance 7.0 and 14.5 deg, printed.

    The angles are drawn by hand in the source: to 1 deg. Shoulders as large to 1e-4 lengthen
    the parallel body by about 1 %.
    """
    fine, full = (
        form_parameters(hull, only=["PMBs", "PMBe", "Eangle"])
        for hull in (series60_60, series60_70)
    )
    assert fine["PMBs"].reason == "no parallel middle body"
    length = 5.0 * ((full["PMBe"].number or 0.0) - (full["PMBs"].number or 0.0))
    assert 11.9 <= length <= 13.5
    assert fine["Eangle"].number == pytest.approx(7.0, abs=1.0)
    assert full["Eangle"].number == pytest.approx(14.5, abs=1.0)


def test_the_after_body_of_a_twin_skeg_ship_is_that_of_her_construction() -> None:
    """Volumes and sections at stations 3 and 2.5 in closed form.

    Sections to 2e-6; volumes to 3e-5, which the net between its sections is off by.
    """
    found = shape_of(twin_skeg.twin_skeg_ship()).take(ship_slices)
    places = [twin_skeg.TRANSOM, twin_skeg.AFT]
    for x in (45.0, 37.5):
        volume = sum(
            quad(lambda at: 2.0 * half_area(at, twin_skeg.DRAUGHT), low, high)[0]
            for low, high in itertools.pairwise([*places, x])
        )
        assert found.aft_of(x).volume == pytest.approx(volume, rel=3e-5)
        assert found.area(x) == pytest.approx(2.0 * half_area(x, twin_skeg.DRAUGHT), rel=2e-6)


def test_a_waterline_in_pieces_has_its_angles() -> None:
    """At half the draught the line runs round the skegs; the run is taken to their after end."""
    ship = twin_skeg.twin_skeg_ship()
    found = form_parameters(ship, only=["Rangle", "Eangle", "PMBs", "b_st5"])
    begin = 15.0 * (found["PMBs"].number or 0.0)
    end = brentq(lambda x: float(twin_skeg.edge(x)) - 9.0, twin_skeg.AFT, twin_skeg.FORE)
    aside = float(twin_skeg.middle(end, 9.0))
    wanted = np.degrees(np.arctan2(25.0 - aside, begin - end))
    assert found["Rangle"].number == pytest.approx(wanted, abs=0.05)
    assert found["b_st5"].number == pytest.approx(25.0, abs=1e-9)
    assert 40.0 < (found["Eangle"].number or 0.0) < 90.0


def test_the_section_of_a_bulb_at_fp_is_found_between_stations(bulk_carrier: ah.Hull) -> None:
    """No station stands at FP: it lies between those at 297 and 300.6 m, both larger and less."""
    area = form_parameters(bulk_carrier, only=["A_FP"])["A_FP"].number or 0.0
    shape = shape_of(bulk_carrier)
    aft, fore = areas_at(shape.body.spans, np.array([297.0, 300.6]), shape.planes).tolist()
    assert fore < area < aft
    assert area == pytest.approx(115.92, abs=0.01)

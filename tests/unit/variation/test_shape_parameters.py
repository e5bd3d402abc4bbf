"""Parameters of shape: length of the body, sheer, character of frames, design waterline."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.variation.carrying.admissible_values import list_parameters
from assoc_hull.variation.parameters.compose_map import compose_map
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.parent import parent_of
from tests.conftest import Shipped
from tests.variation_sets import outcome

SHAPE = (
    "parallel_body_length", "sheer_fore", "sheer_aft", "fore_frame_height", "aft_frame_height",
    "entrance_deg", "run_deg", "waterline_fullness", "bulb_area", "bulb_section_height",
)  # fmt: skip
NOT_THERE = {
    "parallel_body_length": "parent has no parallel middle body",
    "bulb_area": "no profile forward of FP below z=", "bulb_section_height": "no profile forward",
}  # fmt: skip
"""Why a ship may have none."""


def _areas(hull: ah.Hull) -> FloatArray:
    planes = FloatingPlanes(np.array([hull.particulars.draught]), np.zeros(1), np.zeros(1))
    return np.asarray(flotation(hull.document.state).stations(planes).area[0])


@pytest.mark.parametrize(
    ("ship", "changes", "scaled"),
    [
        ("bulk_carrier", {"fore_frame_height": -0.1}, {}),
        ("series60_70", {"parallel_body_length": 0.3, "entrance_deg": 0.5}, {"draught": 1.02}),
        ("series60_70", {"sheer_fore": 0.8, "sheer_aft": 0.4}, {}),
        ("container_ship_225m", {"run_deg": 0.7}, {}),
        ("container_ship_225m", {"waterline_fullness": 0.002}, {}),
        ("bulk_carrier", {"bulb_area": -6.0, "bulb_section_height": 0.1}, {}),
        ("container_ship_225m", {"bulb_area": 1.5, "entrance_deg": 0.3}, {"draught": 1.01}),
    ],
    ids=["frames", "body and entrance", "sheer", "run", "fullness", "bulb", "bulb and draught"],
)
def test_asked_values_are_met(
    shipped: Shipped, ship: str, changes: dict[str, float], scaled: dict[str, float]
) -> None:
    """To 1e-6, alone and beside old parameters; sound, fair, and undone to the bit."""
    hull = shipped(ship)
    now = hull.measure()
    asked = {name: now[name] + change for name, change in changes.items()}
    found = outcome(hull, asked | {name: now[name] * part for name, part in scaled.items()})
    assert found.good, found.words
    assert found.comb < 10.0


def test_frames_change_at_areas_that_stay(series60_70: ah.Hull) -> None:
    """From U to V: area goes up, none is added, no station becomes broader than the ship."""
    now = series60_70.measure()
    varied = series60_70.vary(set={"aft_frame_height": now["aft_frame_height"] + 0.03})
    before, after = _areas(series60_70), _areas(varied.hull)
    assert after == pytest.approx(before, rel=2e-4, abs=1e-3)
    assert varied.hull.measure()["breadth"] == pytest.approx(now["breadth"], abs=1e-9)
    volume = series60_70.hydrostatics().volume
    assert varied.hull.hydrostatics().volume == pytest.approx(volume, rel=2e-5)
    assert varied.report.certificate.least > 0.05
    # What is measured is the centre of area.
    assert varied.hull.hydrostatics().kb > series60_70.hydrostatics().kb


def test_the_list_tells_bounds_or_why_there_are_none(
    series60_70: ah.Hull, shipped: Shipped
) -> None:
    """Of every hull and parameter, with the present value between."""
    for hull in (series60_70, shipped("wigley")):
        listed = {each.name: each for each in list_parameters(hull.document.state)}
        for name in SHAPE:
            each = listed[name]
            if each.value is None:
                assert str(each.reason).startswith(NOT_THERE[name])
                continue
            assert each.low is not None
            assert each.low < each.value
            assert each.high is None or each.value < each.high


def test_two_of_three_give_the_third(bulk_carrier: ah.Hull) -> None:
    """All three are refused; beside one end the length moves the other."""
    three = {
        "parallel_body_start": 116.0, "parallel_body_end": 206.0, "parallel_body_length": 91.0
    }  # fmt: skip
    with pytest.raises(BadInputError, match="two of them give the third"):
        bulk_carrier.vary(set=three)
    del three["parallel_body_end"]
    found = bulk_carrier.vary(set=three).hull.measure()
    assert found["parallel_body_end"] == pytest.approx(207.0, abs=1e-6)


def test_a_measure_is_that_of_the_drawn_hull(shipped: Shipped) -> None:
    """Of the Wigley hull all of them are known: y = B/2 (1 - xi^2)(1 - zeta^2)."""
    found = shipped("wigley").measure(only=SHAPE)
    assert found["waterline_fullness"] == pytest.approx(2.0 / 3.0, rel=2e-4)
    inside = 5.0 * (1.0 - 0.9**2)
    angle = float(np.degrees(np.arctan2(inside, 5.0)))
    assert found["entrance_deg"] == pytest.approx(angle, rel=1e-3)
    assert found["run_deg"] == pytest.approx(angle, rel=1e-3)
    # By z from the keel: y ~ 1 - (1 - z / T)^2, so that its centre is at 5 / 8 T.
    for name in ("fore_frame_height", "aft_frame_height"):
        assert found[name] == pytest.approx(6.25 * 5.0 / 8.0, rel=2e-3)
    assert found["sheer_fore"] == found["sheer_aft"] == 0.0
    for name, reason in NOT_THERE.items():
        assert found.absent[name].startswith(reason)


@pytest.mark.parametrize("ship", ["bulk_carrier", "container_ship_225m"])
def test_the_section_of_a_bulb_is_that_of_the_form_parameters(shipped: Shipped, ship: str) -> None:
    """Cut by slices of the surface, or lofted through waterlines and profile."""
    hull = shipped(ship)
    found, form = hull.measure(), hull.form_parameters()
    assert found["bulb_area"] == pytest.approx(form["A_BT"].number, rel=2e-3)
    assert found["bulb_section_height"] == pytest.approx(form["h_B"].number, rel=2e-3)


def test_a_bulb_is_filled_or_raised_and_not_both(bulk_carrier: ah.Hull) -> None:
    """What one measure gains the other does not; the broad frames behind the bulb stay."""
    parent = parent_of(bulk_carrier.document.state)
    frame, now = parent.bulb(), bulk_carrier.measure()
    for name, change in (("bulb_area", 9.0), ("bulb_section_height", 0.3)):
        vmap = compose_map(parent, {name: now[name] + change}, Layout())
        moved = frame.mapped(vmap)
        area, height = 2.0 * float(moved.areas[0]), float(moved.heights[0])
        if name == "bulb_area":
            assert area == pytest.approx(now["bulb_area"] + change, abs=1e-9)
        else:
            assert area == pytest.approx(now["bulb_area"], abs=1e-9)
            assert height == pytest.approx(now["bulb_section_height"] + change, abs=1e-9)
        side = np.array([[280.0, 18.0, 5.0], [250.0, 5.0, 5.0]])
        assert (vmap(side) == side).all()


def test_area_and_half_breadth_of_a_bulb_are_one_number(bulk_carrier: ah.Hull) -> None:
    """Both widen the section at FP: refused by both names."""
    asked = {"bulb_area": 120.0, "bulb_half_breadth": 6.0}
    with pytest.raises(BadInputError, match="'bulb_area' and 'bulb_half_breadth' cannot be asked"):
        bulk_carrier.vary(set=asked)

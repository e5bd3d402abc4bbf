"""Canoe bodies of yachts from six numbers: what was asked for is met, and the lines are fair."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.fairest_halves import fairest_polynomial, halves_of, maximum_of
from assoc_hull.creation.six_numbers import SixNumbers
from assoc_hull.errors import BadInputError
from assoc_hull.hull.hull import Hull
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.tables import Particulars
from assoc_hull.shipped.yacht_design import draw_yacht

SIX = {
    "length": 11.0, "breadth": 2.72, "draught": 0.36, "depth": 1.19, "cb": 0.408,
    "lcb_percent": -5.0,
}  # fmt: skip


@pytest.fixture(scope="module")
def yacht() -> Hull:
    """Give a shallow canoe body with its buoyancy far aft."""
    return ah.create(**SIX, type="yacht")  # type: ignore[arg-type]


def test_a_yacht_has_the_cb_and_lcb_that_were_asked_for(yacht: Hull) -> None:
    """By the hydrostatics of its net, within 1e-6."""
    found = yacht.hydrostatics()
    assert found.cb == pytest.approx(0.408, abs=1e-6)
    assert found.lcb / 11.0 - 0.5 == pytest.approx(-0.05, abs=1e-6)


def test_a_yacht_is_sound_and_above_its_base_line(yacht: Hull) -> None:
    """Nothing to find by check and verify, no point below the base line or through the centre."""
    assert not yacht.check()
    assert not yacht.verify()
    assert not yacht.history
    places = yacht.state.rows.xyz[yacht.state.live("rows")]
    assert places[:, 2].min() > -1e-3
    assert places[:, 1].min() > -1e-9


def test_notes_name_the_source_and_what_a_yacht_of_the_delft_series_has(yacht: Hull) -> None:
    """Of each coefficient that was not asked for."""
    notes = {each.name: each for each in yacht.notes}
    assert {"CP", "CM", "CW", "LCF", "half angle of entrance", "overhang aft"} <= set(notes)
    assert all(notes[each].others for each in ("CP", "CM", "CW", "LCF"))
    assert notes["CM"].value * notes["CP"].value == pytest.approx(0.408, abs=1e-12)


def test_cm_and_cw_that_are_given_are_those_of_the_design() -> None:
    """CM of the largest section, CW between the ends of the waterline."""
    typed = draw_yacht(SixNumbers(10.0, 3.2, 0.56, 1.75, 0.393, -0.35), cm=0.7, cw=0.7)
    assert typed.held
    forms = Forms.of(typed.design.definitions, typed.design.particulars)
    x = np.linspace(0.0, 10.0, 4001)
    assert forms.value("sectional_area", x).max() == pytest.approx(0.7 * 3.2 * 0.56, rel=1e-6)
    wide = np.nan_to_num(forms.value("design_waterline", x))
    area = 0.0025 * (wide.sum() - 0.5 * (wide[0] + wide[-1]))
    assert area / (10.0 * 1.6) == pytest.approx(0.7, abs=1e-4)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"bilge_radius": 0.2}, "no bilge radius"),
        ({"depth": 0.36}, "no freeboard"),
        ({"cb": 0.75}, "far out of the range"),
    ],
    ids=["bilge", "no freeboard", "full"],
)
def test_mistakes_are_named(more: dict[str, float], words: str) -> None:
    """By an error of the family."""
    with pytest.raises(ah.errors.AssocHullError, match=words):
        ah.create(**(SIX | more), type="yacht canoe body")  # type: ignore[arg-type]


def test_a_middle_section_that_is_not_round_is_refused() -> None:
    """With what to change."""
    with pytest.raises(BadInputError, match=r"flatter than round ones.*another cb or cm"):
        draw_yacht(SixNumbers(10.0, 3.2, 0.56, 1.75, 0.393, -0.35), cm=0.9)


def test_halves_are_the_polynomial() -> None:
    """Areas and centroids exactly, ordinates within .015 of the largest."""
    curve = fairest_polynomial(2, 0.57, -0.06, {})
    assert curve(maximum_of(curve)) == pytest.approx(1.0, abs=1e-9)
    ship = Particulars("yacht", 2.0, 2.0, 2.0, 1.0)
    areas = halves_of(curve, "areas", "sectional_area", 1.0)
    forms = Forms.of([areas], ship)
    s = np.linspace(-1.0, 1.0, 41)
    assert np.abs(forms.value("sectional_area", s + 1.0) - curve(s)).max() < 0.015
    total = sum(areas.values[f"{half}_area"] or 0.0 for half in ("run", "entrance"))
    assert total == pytest.approx(1.14, abs=1e-12)


def test_a_mean_that_no_fair_curve_has_is_refused() -> None:
    """Fuller than a box with rounded ends."""
    with pytest.raises(BadInputError, match="this fullness"):
        maximum_of(fairest_polynomial(2, 0.9, 0.0, {}))

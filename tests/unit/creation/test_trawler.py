"""Trawlers from six numbers: what was asked for is met, on a straight keel, by fair lines."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.fairest_halves import fitted_halves, halves_of, level_polynomial
from assoc_hull.creation.six_numbers import SixNumbers
from assoc_hull.errors import BadInputError
from assoc_hull.hull.hull import Hull
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.tables import Particulars
from assoc_hull.shipped.trawler_design import draw_trawler
from benchmarks.six_numbers import sign_changes

SIX = {
    "length": 40.0, "breadth": 9.5, "draught": 4.0, "depth": 6.0, "cb": 0.56, "lcb_percent": -2.0,
}  # fmt: skip


@pytest.fixture(scope="module")
def trawler() -> Hull:
    """Give a stern trawler of 40 m."""
    return ah.create(**SIX, type="Trawler")  # type: ignore[arg-type]


def test_a_trawler_has_the_cb_and_lcb_that_were_asked_for(trawler: Hull) -> None:
    """By the hydrostatics of its net, within 1e-6."""
    found = trawler.hydrostatics()
    assert found.cb == pytest.approx(0.56, abs=1e-6)
    assert found.lcb / 40.0 - 0.5 == pytest.approx(-0.02, abs=1e-6)


def test_a_trawler_is_sound_and_keeps_within_its_base_line_and_breadth(trawler: Hull) -> None:
    """Nothing to find by check and verify."""
    assert not trawler.check()
    assert not trawler.verify()
    places = trawler.state.rows.xyz[trawler.state.live("rows")]
    assert places[:, 2].min() > -1e-3
    assert places[:, 1].min() > -1e-9
    assert places[:, 1].max() < 4.75 + 1e-3


def test_lines_of_a_trawler_are_fair(trawler: Hull) -> None:
    """Sign changes of a line: of the worst sections 2, waterlines 4, buttocks 5."""
    worst = {family: max(counts) for family, counts in sign_changes(trawler).items()}
    assert worst["sections"] <= 2
    assert worst["waterlines"] <= 4
    assert worst["buttocks"] <= 5


@pytest.mark.parametrize("cb", [0.5, 0.62])
@pytest.mark.parametrize("lcb", [-4.0, -0.5])
def test_designs_at_the_corners_close_and_their_contours_do_not_turn(cb: float, lcb: float) -> None:
    """Keel straight, then up to both ends; CB and LCB to the last digits."""
    breadth = 40.0 / (3.2 if lcb < -2.0 else 5.0)
    draught = breadth / 2.4
    six = SixNumbers(40.0, breadth, draught, 1.5 * draught, cb, 0.4 * lcb)
    design = draw_trawler(six).design
    found = coefficients(design.definition("sectional_area"), design.particulars)
    assert found.block == pytest.approx(cb, abs=1e-12)
    assert found.centroid == pytest.approx(0.4 * lcb, abs=1e-9)
    forms = Forms.of(design.definitions, design.particulars)
    heights = [forms.contour(x) for x in np.linspace(-1.5, 39.9, 60).tolist()]
    assert {len(each) for each in heights} == {1}
    z = np.ravel(heights)
    low = np.flatnonzero(np.abs(z) < 1e-9)
    assert len(low) > 40
    assert (np.diff(z[: low[0] + 1]) < 0.0).all()
    assert (np.diff(z[low[-1] :]) > 0.0).all()


def test_notes_name_the_source_of_each_coefficient(trawler: Hull) -> None:
    """And what the type lacks."""
    notes = {each.name: each for each in trawler.notes}
    assert {"CP", "CM", "CW", "LCF", "half angle of entrance", "rise of floor"} <= set(notes)
    assert notes["CM"].value * notes["CP"].value == pytest.approx(0.56, abs=1e-12)
    assert "no stern frame" in notes["type"].remark
    assert 2.0 < notes["rise of floor"].value < 12.0


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"bilge_radius": 0.2}, "no bilge radius"),
        ({"depth": 4.0}, "no freeboard"),
        ({"cb": 0.9}, "far out of the range"),
    ],
    ids=["bilge", "no freeboard", "full"],
)
def test_mistakes_are_named(more: dict[str, float], words: str) -> None:
    """By an error of the family."""
    with pytest.raises(ah.errors.AssocHullError, match=words):
        ah.create(**(SIX | more), type="trawler")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("cm", "cw", "words"),
    [(0.97, None, "flatter"), (None, 0.6, "this fullness"), (0.7, None, "this fullness")],
    ids=["box", "fine waterline", "wedge"],
)
def test_coefficients_that_leave_no_fair_sections_are_refused(
    cm: float | None, cw: float | None, words: str
) -> None:
    """With what to change."""
    with pytest.raises(BadInputError, match=words):
        draw_trawler(SixNumbers(40.0, 9.5, 4.0, 6.0, 0.56, -0.8), cm=cm, cw=cw)


def test_fitted_halves_are_nearer_to_their_polynomial() -> None:
    """Full aft and hollow ahead: areas exactly, ordinates within .008."""
    curve, at = level_polynomial(2, 0.6, -0.06, {})
    assert curve(at) == pytest.approx(1.0, abs=1e-9)
    ship = Particulars("trawler", 2.0, 2.0, 2.0, 1.0)
    s = np.linspace(-1.0, 1.0, 81)
    even = halves_of(curve, "areas", "sectional_area", 1.0, at=at)
    fitted = fitted_halves(even, curve)
    miss = [
        np.abs(Forms.of([each], ship).value("sectional_area", s + 1.0) - curve(s)).max()
        for each in (even, fitted)
    ]
    assert miss[1] < 0.008 < miss[0]
    assert coefficients(fitted, ship).fullness == pytest.approx(0.6, abs=1e-12)

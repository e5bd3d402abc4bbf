"""Cross curves of stability: KN over displacement and heel."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.stability.condition import ConditionRequest
from assoc_hull.analysis.stability.cross_curves import cross_curves, cross_curves_of
from assoc_hull.analysis.stability.righting_lever import TrimRule
from assoc_hull.errors import BadInputError, OutOfRangeError
from tests.floating_bodies import box_body, head, wigley_body

HEELS = np.array([5.0, 10.0, 20.0, 30.0])


def test_the_reference_stands_in_a_table_of_many() -> None:
    """The row of 2777.777778 m3 has the printed digits; the others are their own ships'."""
    asked = [ConditionRequest(weight=each) for each in (2000.0, 25000.0 / 9.0, 3000.0)]
    header = head(100.0, 10.0, 6.25, rho=1.0)
    found = cross_curves_of(wigley_body(), header, asked, "fixed", HEELS)
    want = [0.4602009129, 0.9182480482, 1.8200848130, 2.6937178386]
    np.testing.assert_allclose(found.kn[1], want, atol=5e-11)
    for k in (0, 2):
        alone = cross_curves_of(wigley_body(), header, [asked[k]], "fixed", HEELS)
        np.testing.assert_allclose(found.kn[k], alone.kn[0], atol=1e-12)
    np.testing.assert_allclose(found.volume, [2000.0, 25000.0 / 9.0, 3000.0], rtol=1e-12)


@pytest.mark.parametrize("trim", ["fixed", "free"])
def test_kn_of_a_box_is_that_of_a_wall_sided_ship(trim: TrimRule) -> None:
    """KN = sin(heel) (KB + BM (1 + tan^2 / 2)) at any draught whose deck stays dry."""
    asked = [ConditionRequest(draughts=(t, t)) for t in (5.0, 6.0, 7.0)]
    found = cross_curves_of(box_body(), head(100.0, 20.0, 6.0), asked, trim, HEELS[:3])
    phi, t = np.radians(HEELS[:3]), np.array([[5.0], [6.0], [7.0]])
    want = np.sin(phi) * (t / 2.0 + 400.0 / 12.0 / t * (1.0 + np.tan(phi) ** 2 / 2.0))
    np.testing.assert_allclose(found.kn, want, atol=1e-10)


def test_where_an_open_deck_would_be_drowned_there_is_no_kn() -> None:
    """And the notes say so."""
    asked = [ConditionRequest(draughts=(t, t)) for t in (6.0, 8.0)]
    heels = np.array([10.0, 20.0, 25.0, 35.0])
    found = cross_curves_of(box_body(False), head(100.0, 20.0, 6.0), asked, "fixed", heels)
    dry = [[True, True, True, False], [True, True, False, False]]
    assert np.isfinite(found.kn).tolist() == dry
    assert "open" in found.notes[0]


def test_free_trim_changes_kn_of_a_ship_that_trims_as_it_heels() -> None:
    """With KG given or not; upright both rules agree."""
    asked = [ConditionRequest(draughts=(5.8, 6.6), kg=kg) for kg in (None, 4.0)]
    header = head(100.0, 10.0, 6.25)
    heels = np.array([-30.0, 0.0, 30.0])
    fixed = cross_curves_of(wigley_body(), header, asked[:1], "fixed", heels)
    free = cross_curves_of(wigley_body(), header, asked[:1], "free", heels)
    assert free.kn[0, 1] == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(free.kn[0], -free.kn[0, ::-1], atol=1e-11)
    assert 1e-6 < abs(free.kn[0, 2] - fixed.kn[0, 2]) < 1e-2
    given = cross_curves_of(wigley_body(), header, asked[1:], "free", heels)
    assert given.kn[0, 2] == pytest.approx(free.kn[0, 2], abs=1e-4)


@pytest.fixture(scope="module")
def wigley() -> ah.Hull:
    """A small net."""
    return ah.examples.wigley(stations=11, waterlines=7)


def test_a_hull_has_cross_curves(wigley: ah.Hull) -> None:
    """By weights and by draughts alike; frozen, and headed by what they hold good for."""
    one = cross_curves(wigley, draughts=[5.0, 6.0], heels=[10.0, 20.0])
    other = cross_curves(wigley, weights=one.displacement.tolist(), heels=[10.0, 20.0])
    np.testing.assert_allclose(one.kn, other.kn, atol=1e-9)
    np.testing.assert_allclose(other.draught, [5.0, 6.0], atol=1e-9)
    assert one.header.deck == "closed"
    assert not one.kn.flags.writeable


def test_trim_by_the_stern_is_draught_aft_less_draught_forward(wigley: ah.Hull) -> None:
    """About the mean draughts that are given."""
    found = cross_curves(wigley, draughts=[5.0, 6.0], trim_by_stern=0.4, heels=[10.0])
    at = [(each.upright.draught_aft, each.upright.draught_fore) for each in found.conditions]
    np.testing.assert_allclose(at, [(5.2, 4.8), (6.2, 5.8)], atol=1e-12)


@pytest.mark.parametrize(
    ("given", "error"),
    [
        ({}, BadInputError),
        ({"weights": [100.0], "draughts": [5.0]}, BadInputError),
        ({"draughts": [5.0, 4.0]}, BadInputError),
        ({"draughts": [5.0, float("nan")]}, BadInputError),
        ({"draughts": [50.0]}, OutOfRangeError),
        ({"weights": [1e5]}, OutOfRangeError),
        ({"weights": [100.0], "trim_by_stern": 1.0}, BadInputError),
        ({"draughts": [5.0], "heels": [91.0]}, OutOfRangeError),
        ({"draughts": [5.0], "heels": []}, BadInputError),
        ({"draughts": [5.0], "heels": [float("nan")]}, BadInputError),
        ({"draughts": [5.0], "trim": "loose"}, BadInputError),
        ({"draughts": [5.0], "kg": "high"}, BadInputError),
        ({"draughts": [5.0], "rho": 0.0}, BadInputError),
    ],
)
def test_what_cannot_be_is_refused(
    wigley: ah.Hull, given: dict[str, object], error: type[Exception]
) -> None:
    """With an error of the family."""
    with pytest.raises(error):
        cross_curves(wigley, **given)  # type: ignore[arg-type]

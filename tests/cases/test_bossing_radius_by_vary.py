"""Radii of the bossing about the 1.0 m buttock: from before it to beyond, by `vary`."""

from __future__ import annotations

import pytest

import assoc_hull as ah
from tests.long_forms import long_form


@pytest.fixture(scope="module")
def touched(bulk_carrier: ah.Hull) -> ah.Hull:
    """The shaft at 6 m and a radius of 1 m: the buttock touches the end of the bossing."""
    return bulk_carrier.vary(set={"shaft_height": 6.0, "bossing_radius": 1.0}).hull


def larger(parent: ah.Hull, radius: float) -> ah.Hull:
    """Vary the radius; what comes is sound, and undo gives the parent to the bit."""
    hull = parent.vary(set={"bossing_radius": radius}).hull
    assert hull.features["bossing end"].parameters["radius"] == radius
    assert not hull.check()
    assert not hull.verify()
    after = hull.fingerprint
    hull.undo()
    assert hull.fingerprint == parent.fingerprint
    hull.redo()
    assert hull.fingerprint == after
    return hull


def assert_two_pieces(hull: ah.Hull, height: float, radius: float) -> None:
    """The buttock ends above and below the shaft on the circle; each crosses ST 0.45 as it did."""
    after, fore = hull.lines["BTK 1"].curves
    away = (radius**2 - 1.0) ** 0.5
    ends = after.points[-1].position.tolist(), fore.points[0].position.tolist()
    assert ends[0] == pytest.approx([6.0, 1.0, height + away], abs=1e-6)
    assert ends[1] == pytest.approx([6.0, 1.0, height - away], abs=1e-6)
    met = [[point.z for point in each.points if point.x == 6.75] for each in (after, fore)]
    assert met[0][0] > 11.0
    assert met[0][1:] + met[1] == pytest.approx([height + away, height - away], abs=1e-5)


def test_a_radius_beyond_the_buttock_cuts_it_into_two_pieces(bulk_carrier: ah.Hull) -> None:
    """The crossings of the piece that is born stay on it, though the other has such crossings."""
    assert_two_pieces(larger(bulk_carrier, 1.01), 5.0, 1.01)


def test_a_touch_that_is_grown_over_by_vary_ends_two_pieces(touched: ah.Hull) -> None:
    """Where the kept run of the buttock ends, the waterline there crosses it once."""
    hull = larger(touched, 1.02)
    assert_two_pieces(hull, 6.0, 1.02)
    there = [point for point in hull.lines["BTK 1"].points if point.z == 2.0 and point.x < 100.0]
    assert len(there) == 1


@long_form
def test_a_radius_just_short_of_the_buttock_is_refused_as_a_fold(bulk_carrier: ah.Hull) -> None:
    """The turn would be sharper than points of the buttock can draw; by its line and place.

    All plans are tried before it is refused, which takes long.
    """
    with pytest.raises(ah.errors.RefusedEditError, match=r"BTK 1 folds back on itself at \(8\.69"):
        bulk_carrier.vary(set={"bossing_radius": 0.99})

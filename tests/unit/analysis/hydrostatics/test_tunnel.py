"""Tunnels: what a cylinder athwartships takes from a hull, against exact references."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from tests.cases.test_box_with_bilges import BILGE, DEPTH, DRAUGHT, HALF, LENGTH, round_box
from tests.long_forms import draws
from tests.taken_back import taken_back


@pytest.fixture(scope="module")
def box() -> ah.Hull:
    """A box with circular bilges of 2 m."""
    return round_box()


@settings(max_examples=draws(10), deadline=None)
@given(x=st.floats(10.0, 90.0), z=st.floats(4.0, 5.0), radius=st.floats(0.1, 1.9))
def test_a_cylinder_through_a_box_is_that_cylinder(
    box: ah.Hull, x: float, z: float, radius: float
) -> None:
    """Volume, centroid, wall, openings, and what it takes of a station, to rounding."""
    found = box.tunnel("thruster", x=x, z=z, radius=radius)
    area = np.pi * radius**2
    assert found.volume == pytest.approx(2.0 * HALF * area, rel=1e-11)
    assert found.centroid == pytest.approx((x, 0.0, z), abs=1e-9)
    assert found.wall == pytest.approx(4.0 * np.pi * radius * HALF, rel=1e-12)
    assert found.opening == pytest.approx(2.0 * area, rel=1e-9)
    assert found.error <= 1e-9
    for name, at in (("ST 1", 25.0), ("ST 2", 50.0), ("ST 3", 75.0)):
        half = np.sqrt(max(radius**2 - (at - x) ** 2, 0.0))
        assert found.sections.get(name, 0.0) == pytest.approx(4.0 * HALF * half, abs=1e-9)
        gap = found.gap(x=at)
        assert gap is None if half == 0.0 else gap == pytest.approx((z - half, z + half))


def test_a_box_barge_with_a_tunnel_has_volume_centroid_and_surface_in_closed_form(
    box: ah.Hull,
) -> None:
    """Box with bilges less cylinder: LCB, KB and wetted surface by hand."""
    x, z, radius = 80.0, 3.5, 1.4
    bare = box.hydrostatics(draught=DRAUGHT)
    tunnel = box.tunnel("thruster", x=x, z=z, radius=radius)
    found = box.hydrostatics(draught=DRAUGHT, appendages=[tunnel.appendage])
    corner = BILGE**2 * (1.0 - 0.25 * np.pi)
    whole = LENGTH * (2.0 * HALF * DRAUGHT - 2.0 * corner)
    less = 2.0 * HALF * np.pi * radius**2
    assert found.volume == pytest.approx(whole - less, rel=1e-6)
    lcb = (whole * 0.5 * LENGTH - less * x) / (whole - less)
    assert found.lcb == pytest.approx(lcb, abs=1e-5)
    kb = (bare.volume * bare.kb - less * z) / (bare.volume - less)
    assert found.kb == pytest.approx(kb, abs=1e-9)
    surface = 4.0 * np.pi * radius * HALF - 2.0 * np.pi * radius**2
    assert found.wetted_surface - bare.wetted_surface == pytest.approx(surface, abs=1e-6)


def test_a_tunnel_in_a_wigley_hull_takes_the_integral_of_its_formula() -> None:
    """As near as the lines of the net are to the formula; the mouth lies on the hull."""
    hull = ah.examples.wigley()
    x, z, radius = 70.0, 3.0, 1.0
    found = hull.tunnel("thruster", x=x, z=z, radius=radius)
    angle, r = np.meshgrid(
        np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False), np.arange(0.0025, 1.0, 0.005)
    )
    at, up = x + r * np.cos(angle), z + r * np.sin(angle)
    half = 5.0 * (1.0 - (2.0 * at / 100.0 - 1.0) ** 2) * (1.0 - (1.0 - up / 6.25) ** 2)
    exact = float((2.0 * half * r).sum()) * 0.005 * 2.0 * np.pi / 64.0
    assert found.volume == pytest.approx(exact, rel=2e-5)
    assert found.error < 1e-6 * found.volume
    for x_at, y, z_at in found.mouth[::8].tolist():
        assert hull.half_breadth(x_at, z_at) == pytest.approx(y, abs=1e-9)


def test_a_tunnel_that_is_asked_for_anew_follows_the_hull() -> None:
    """Its mouth is where the cylinder meets the shell as it is now."""
    hull = ah.examples.wigley()
    before = hull.tunnel("thruster", x=70.0, z=3.0, radius=1.0)
    with taken_back(hull):
        with hull.edit("fuller") as edit:
            edit.pull("WL 3.125 x ST 14", d=0.05, radius=(15.0, 3.0))
        after = hull.tunnel("thruster", x=70.0, z=3.0, radius=1.0)
        assert after.volume > before.volume
        assert after.mouth[:, 1].min() > before.mouth[:, 1].min()
    again = hull.tunnel("thruster", x=70.0, z=3.0, radius=1.0)
    assert again.volume == before.volume


@pytest.mark.parametrize(
    ("x", "z", "radius"),
    [(60.0, 1.0, 1.2), (99.5, 5.0, 1.2), (50.0, DEPTH - 0.5, 1.2), (50.0, 6.0, 7.0)],
    ids=["below the keel", "before the end", "above the deck", "too large"],
)
def test_a_tunnel_that_leaves_the_hull_is_refused(
    box: ah.Hull, x: float, z: float, radius: float
) -> None:
    """The message tells where it does."""
    with pytest.raises(BadInputError, match=r"'thruster' leaves the hull at x .*smaller radius"):
        box.tunnel("thruster", x=x, z=z, radius=radius)


def test_only_a_recess_takes_surface_away() -> None:
    """An appendage that adds volume adds surface."""
    with pytest.raises(BadInputError, match="area"):
        ah.hydro.Appendage("rudder", 2.0, (0.0, 0.0, 3.0), -1.0)
    assert ah.hydro.Appendage("tunnel", -2.0, (0.0, 0.0, 3.0), -1.0).area == -1.0

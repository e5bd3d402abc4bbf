"""Scaling a hull is exact: what is measured of its exact image, and of the net carried by `vary`.

The exact image has the splines of the parent with their knots, multiplied. A net is lofted again:
a similarity gives the same splines, a single ratio others within the tolerance of lofting.
"""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.hull import Hull
from assoc_hull.model.kinds import Role
from benchmarks.affine_exactness import (
    SCALINGS,
    deviation,
    image_row,
    map_row,
    off_image,
    scaled,
)
from benchmarks.affine_image import affine_image
from tests.long_forms import LONG

SHIPS = ("wigley", "series60_70", "bulk_carrier", *(("dtc",) if LONG else ()))


@pytest.fixture(scope="module")
def wigley() -> Hull:
    """The Wigley hull."""
    return ah.examples.wigley()


@pytest.fixture(params=SHIPS)
def ship(request: pytest.FixtureRequest) -> Hull:
    """One ship after the other."""
    hull: Hull = request.getfixturevalue(request.param)
    return hull


@pytest.mark.parametrize("name", ["length", "breadth", "draught"])
def test_the_map_multiplies_the_coordinates_of_a_ship(ship: Hull, name: str) -> None:
    """By the ratio of asked to present value, to one unit in the last place; z up to T."""
    assert map_row(ship, name) <= 1.0


def test_the_map_of_a_depth_leaves_what_is_immersed(ship: Hull) -> None:
    """No point up to T moves by a bit."""
    assert map_row(ship, "depth") == 0.0


@pytest.mark.parametrize("name", ["length", "breadth", "draught"])
def test_the_exact_image_has_the_volume_times_the_ratio(ship: Hull, name: str) -> None:
    """Volume, areas and centroids scale; CB, CM, CP and CW are the parent's: to 1e-12."""
    assert image_row(ship, name) <= 1e-12


def test_three_ratios_at_once_are_exact_as_well(ship: Hull) -> None:
    """To 1e-12, with ratios far from 1."""
    factors = (1.3, 0.7, 1.1)
    found = deviation(ship, affine_image(ship, factors), factors)
    assert max(abs(each) for each in found.values()) <= 1e-12


def test_a_similar_net_is_the_parent_scaled(ship: Hull) -> None:
    """Length, breadth, draught and depth by one factor: V / L^3, CB and the rest to 1e-12."""
    varied = scaled(ship, "similarity")
    found = deviation(ship, varied.hull, SCALINGS["similarity"][1])
    assert max(abs(each) for each in found.values()) <= 1e-12
    assert varied.report.added == 0


@pytest.mark.parametrize(
    ("hull", "name"),
    [
        ("wigley", "length"), ("wigley", "breadth"), ("wigley", "draught"),
        ("series60_70", "breadth"), ("series60_70", "draught"), ("bulk_carrier", "draught"),
        *([("dtc", "length"), ("dtc", "breadth")] if LONG else []),
    ],
)  # fmt: skip
def test_a_single_ratio_changes_the_volume_by_it(
    hull: str, name: str, request: pytest.FixtureRequest
) -> None:
    """But for what lofting again does to it: a millionth at most."""
    parent: Hull = request.getfixturevalue(hull)
    found = deviation(parent, scaled(parent, name).hull, SCALINGS[name][1])
    assert abs(found["volume"]) <= 1e-6


@pytest.mark.parametrize("name", ["length", "breadth", "draught"])
def test_lines_of_a_scaled_net_keep_to_the_exact_image(wigley: Hull, name: str) -> None:
    """Every curve within the 2 mm of lofting."""
    assert off_image(wigley, scaled(wigley, name)).max() <= 2e-3


@pytest.mark.parametrize("hull", ["series60_70", "bulk_carrier", *(["dtc"] if LONG else [])])
def test_a_depth_moves_no_point_of_a_net_below_the_draught(
    hull: str, request: pytest.FixtureRequest
) -> None:
    """Every point up to T that is given has the bits it had; the deck is where it was asked for.

    Crossings that are computed from a line which goes on above T are computed anew.
    """
    parent: Hull = request.getfixturevalue(hull)
    asked = 0.96 * parent.measure(only=["depth"])["depth"]
    varied = parent.vary(set={"depth": asked}).hull
    before, after = parent.state, varied.state
    row_of = {str(after.rows.key[row]): row for row in after.live("rows").tolist()}
    rows = before.live("rows")
    given = (before.rows.driver[rows] < 0) & (before.rows.role[rows] != Role.WATCHED)
    wet = before.rows.xyz[rows, 2] <= parent.particulars.draught
    low = rows[given & wet].tolist()
    there = [row_of[str(before.rows.key[row])] for row in low]
    assert len(low) > 100
    assert np.array_equal(before.rows.xyz[low], after.rows.xyz[there])
    assert varied.measure(only=["depth"])["depth"] == pytest.approx(asked, abs=1e-6)

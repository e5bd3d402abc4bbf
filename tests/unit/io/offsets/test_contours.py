"""Ends, centre profile and flats of the Series 60 tables and of tables made for it."""

from __future__ import annotations

import attrs
import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.complete_table import (
    centre_profile,
    end_contours,
    flat_of_bottom,
    flat_of_side,
    stem_contour,
    stern_contour,
)
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.shipped.series60 import todd_table

LENGTH = 121.92
BLOCKS = pytest.mark.parametrize("cb", [0.60, 0.70])


def made_table(x: FloatArray, z: FloatArray, y: FloatArray, draught: float) -> OffsetTable:
    """A table of given numbers, B = 2."""
    none = np.empty(0)
    rounding = np.full(len(z), 5e-4)
    length = float(x[-1])
    return OffsetTable(
        "made", x, z, y, None, None, None, none, None, length, 2.0, draught, None, rounding
    )


@BLOCKS
def test_waterlines_end_at_the_perpendiculars_below_the_draught(cb: float) -> None:
    """Up to 0.75 T aft and T forward the ends are AP and FP."""
    stern, stem = end_contours(todd_table(cb)[0])
    np.testing.assert_array_equal(stern[:5], 0.0)
    np.testing.assert_allclose(stem[:6], LENGTH)
    assert not stern.flags.writeable
    assert not stem.flags.writeable


@BLOCKS
def test_the_design_waterline_has_the_published_length(cb: float) -> None:
    """LWL is 1.01675 Lpp."""
    stern, stem = end_contours(todd_table(cb)[0])
    assert (stem[5] - stern[5]) / LENGTH == pytest.approx(1.01675, abs=1e-12)


@BLOCKS
def test_higher_waterlines_end_farther_out(cb: float) -> None:
    """Both ends move outward with height, aft ever more steeply upward."""
    stern, stem = end_contours(todd_table(cb)[0])
    assert np.all(np.diff(stern[4:]) < 0)
    assert np.all(np.diff(stem[5:]) > 0)
    assert np.all(np.diff(stern[5:], 2) > 0)


def test_the_stem_carries_the_last_two_offsets_on() -> None:
    """Forward of FP the straight line through stations 0.5 and 0: .076, .020 at 1.25 T."""
    stem = stem_contour(todd_table(0.60)[0])
    half_spacing = LENGTH / 40.0
    assert stem[6] == pytest.approx(LENGTH + half_spacing * 0.020 / 0.056)
    assert stem[7] == pytest.approx(LENGTH + half_spacing * 0.042 / 0.078)


def test_blunt_and_blank_ends() -> None:
    """A line that does not fall ends at its station; before a blank it ends within the bay."""
    x, z = np.array([0.0, 10.0, 20.0, 30.0]), np.array([0.0, 1.0, 2.0])
    y = np.array([[0.0, 0.6, 1.0], [0.5, 1.0, 1.0], [0.4, 1.0, 1.0], [np.nan, 0.9, 1.0]])
    table = made_table(x, z, y, draught=1.0)
    np.testing.assert_allclose(stem_contour(table), [30.0, 40.0, 30.0])
    empty = attrs.evolve(table, half_breadth=np.where(z == 0, np.nan, y), draught=None)
    assert np.isnan(stem_contour(empty)[0])
    np.testing.assert_allclose(stern_contour(empty)[1:], [-10.0, 0.0])


def test_a_closing_forward_of_the_last_station_is_refused() -> None:
    """The message gives both places."""
    with pytest.raises(BadInputError, match="not abaft the last station"):
        stern_contour(todd_table(0.60)[0], closing=0.0)


@BLOCKS
def test_the_centre_profile_is_one_round(cb: float) -> None:
    """From the stern at the deck by AP, keel and FP to the stem at the deck, four knuckles."""
    table = todd_table(cb)[0]
    points, kinds = centre_profile(table)
    stern, stem = end_contours(table)
    np.testing.assert_allclose(points[0], [stern[-1], 0.0, table.z[-1]])
    np.testing.assert_allclose(points[-1], [stem[-1], 0.0, table.z[-1]])
    np.testing.assert_array_equal(points[:, 1], 0.0)
    knuckles = points[kinds == 2]
    assert len(knuckles) == 4
    assert set(kinds) == {0, 2}
    assert table.draught is not None
    assert 0.75 * table.draught < knuckles[0, 2] < table.draught
    np.testing.assert_allclose(knuckles[1:3], [[0.0, 0.0, 0.0], [LENGTH, 0.0, 0.0]])
    np.testing.assert_allclose(knuckles[3], [LENGTH, 0.0, table.draught])
    assert np.all(np.diff(points[:, 0]) >= 0)


@BLOCKS
def test_the_centre_profile_meets_every_waterline_at_its_end(cb: float) -> None:
    """The ends of the overhanging waterlines are points of the profile, to the last bit."""
    table = todd_table(cb)[0]
    points, _ = centre_profile(table)
    rows = {(float(x), float(z)) for x, _, z in points}
    for ends in end_contours(table):
        assert {(float(ends[j]), float(table.z[j])) for j in (6, 7)} <= rows


def test_a_rising_keel_has_no_such_profile() -> None:
    """The profile of a table with keel heights is drawn otherwise; the error says so."""
    table = attrs.evolve(todd_table(0.60)[0], keel=np.zeros(25))
    with pytest.raises(BadInputError, match="keel is not level"):
        centre_profile(table)


@BLOCKS
def test_the_flat_of_side_lies_between_its_neighbours(cb: float) -> None:
    """Each end lies between the first station on the flat and the next one off it."""
    table = todd_table(cb)[0]
    flat = flat_of_side(table)
    on = np.abs(table.half_breadth - table.breadth / 2.0) < 1e-9
    for j, ends in enumerate(zip(flat.x_aft, flat.x_forward, strict=True)):
        rows = np.flatnonzero(on[:, j])
        assert np.isnan(ends).all() == (len(rows) == 0)
        if len(rows):
            assert table.x[rows[0] - 1] <= ends[0] <= table.x[rows[0]]
            assert table.x[rows[-1]] <= ends[1] <= table.x[rows[-1] + 1]
    assert np.array_equal(np.isfinite(flat.z_lower), on.any(axis=1))


@BLOCKS
def test_the_border_of_the_flat_runs_down_and_up(cb: float) -> None:
    """In y = B/2, from the highest waterline aft down, forward, and up to the highest again."""
    table = todd_table(cb)[0]
    border = flat_of_side(table).border
    np.testing.assert_array_equal(border[:, 1], table.breadth / 2.0)
    assert border[0, 2] == border[-1, 2] == table.z[-1]
    lowest = int(np.argmin(border[:, 2]))
    assert np.all(np.diff(border[: lowest + 1, 2]) < 0)
    assert np.all(np.diff(border[lowest:, 2]) > -1e-9)


def test_the_end_of_a_parabola_is_found_exactly() -> None:
    """Where the hull leaves the flat by a parabola the end between stations is exact."""
    x, z = np.arange(0.0, 11.0), np.array([0.0, 1.0])
    line = 1.0 - 0.02 * np.clip(np.abs(x - 5.0) - 1.7, 0.0, None) ** 2
    flat = flat_of_side(made_table(x, z, np.column_stack([line, line]), draught=1.0))
    np.testing.assert_allclose(flat.x_aft, 3.3, atol=1e-9)
    np.testing.assert_allclose(flat.x_forward, 6.7, atol=1e-9)


def test_a_hull_without_flat_of_side() -> None:
    """Nothing at B/2 gives no ends and an empty border."""
    x, z = np.arange(4.0), np.array([0.0, 1.0])
    flat = flat_of_side(made_table(x, z, np.full((4, 2), 0.9), draught=1.0))
    assert np.isnan(flat.x_aft).all()
    assert flat.border.shape == (0, 3)


@BLOCKS
def test_the_flat_of_bottom_runs_from_perpendicular_to_perpendicular(cb: float) -> None:
    """The lowest waterline, in z = 0, pointed at AP and FP."""
    table = todd_table(cb)[0]
    points = flat_of_bottom(table)
    np.testing.assert_array_equal(points[:, 1], table.half_breadth[:, 0])
    np.testing.assert_allclose(points[[0, -1]], [[0.0, 0.0, 0.0], [LENGTH, 0.0, 0.0]])


def test_a_table_that_does_not_reach_the_base_line_has_no_flat_of_bottom() -> None:
    """The error names the height of the lowest waterline."""
    x, z = np.arange(4.0), np.array([0.5, 1.0])
    with pytest.raises(BadInputError, match=r"at 0\.5 m, is no flat of bottom"):
        flat_of_bottom(made_table(x, z, np.full((4, 2), 0.9), draught=1.0))

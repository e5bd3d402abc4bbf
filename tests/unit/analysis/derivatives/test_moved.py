"""Hulls that are measured by the layout that they had before their points moved."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.derivatives.curve_tangents import curve_tangents
from assoc_hull.analysis.derivatives.parameters import PointMove
from assoc_hull.analysis.derivatives.reused_layout import (
    flotation_at_points,
    flotation_with_layout,
    flotation_with_layout_of,
)
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, planes_of
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import values_at
from assoc_hull.analysis.hydrostatics.record import FIELDS, HydrostaticHeader
from assoc_hull.hull import Hull
from assoc_hull.model.network import curve_data

POINT = "WL 0.75 x ST 2"
"""Of Series 60, CB 0.60: some hundred others follow it."""


def values(body: Flotation, header: HydrostaticHeader) -> np.ndarray:
    """All fields of the record, with a trim."""
    position = FloatingPosition(0.93 * header.draught, 0.88 * header.draught)
    found = values_at(body, planes_of([position], header.length), header)
    return np.array([float(found[name][0]) for name in FIELDS])


@pytest.fixture(scope="module")
def hull(shipped: Callable[[str], Hull]) -> Hull:
    """Series 60, to be edited; each test takes its edits back."""
    return shipped("series60_60")


@pytest.fixture(scope="module")
def header(hull: Hull) -> HydrostaticHeader:
    """With a centre of gravity, so that no field lacks."""
    terms: dict[str, object] = {
        "rho": 1.025, "shell_factor": 1.0, "kg": 5.0, "appendages": (), "fingerprint": "",
    }  # fmt: skip
    return header_of(hull, flotation(hull.state), terms)


def test_the_old_layout_gives_the_numbers_of_a_new_one(
    hull: Hull, header: HydrostaticHeader
) -> None:
    """Every field to 1e-12 after an edit that moves over a hundred points, by up to 10 mm."""
    before = flotation(hull.state)
    with hull.edit("a move") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 1e-2)
    found, anew = flotation_with_layout(before, hull.state), flotation(hull.state)
    hull.undo()
    assert found is not None
    assert not np.array_equal(anew.net.batch.xyz, before.net.batch.xyz)
    size = np.maximum(np.abs(values(anew, header)), 1.0)
    assert (np.abs(values(found, header) - values(anew, header)) <= 1e-12 * size).all()
    assert np.abs(found.limits.deck - anew.limits.deck).max() < 1e-9
    assert np.array_equal(found.net.x, anew.net.x, equal_nan=True)


def test_points_alone_say_as_much_as_tables(hull: Hull, header: HydrostaticHeader) -> None:
    """Lofted anew from the points of a hull that was edited, the numbers are those of its lines."""
    before = flotation(hull.state)
    with hull.edit("a move") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 1e-3)
    lines = curve_data(hull.state, before.net.curve)
    found = flotation_at_points(before, lines, hull.state.rows.xyz.data.copy())
    wanted = flotation_with_layout(before, hull.state)
    hull.undo()
    assert wanted is not None
    assert_allclose(values(found, header), values(wanted, header), rtol=1e-13, atol=1e-13)


def test_no_step_changes_nothing(hull: Hull, header: HydrostaticHeader) -> None:
    """The cells are put on the same lines: the numbers are those of the hull as it was."""
    before = flotation(hull.state)
    way, _ = curve_tangents(before, [PointMove(POINT)])
    still = flotation_at_points(before, *way.stepped(0, 0.0))
    assert_allclose(values(still, header), values(before, header), rtol=1e-13, atol=1e-13)


def test_another_structure_is_laid_out_anew(
    shipped: Callable[[str], Hull], header: HydrostaticHeader
) -> None:
    """A line less: the old layout is not used, and the numbers are those of the new one."""
    hull = shipped("series60_60")
    other = shipped("series60_60")
    with other.edit("a line less") as edit:
        edit.remove_line("ST 14")
    assert flotation_with_layout(flotation(hull.state), other.state) is None
    found = flotation_with_layout_of(hull.state, other.state)
    assert np.array_equal(values(found, header), values(flotation(other.state), header))

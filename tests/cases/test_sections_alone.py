"""Hulls given by sections alone: their ends are closed, told, and in doubt."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.record import Hydrostatics
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Particulars
from tests.long_forms import LONG

SPACINGS = [(0.5, 19.5, 0.5), (1.0, 19.0, 1.0)]
"""First and last station, and the step between; of both the wider leaves more of the ends open."""


@pytest.fixture(scope="module")
def whole(shipped: Callable[[str], ah.Hull]) -> tuple[ah.Hull, Hydrostatics]:
    """The container ship with all her lines, and her hydrostatics."""
    hull = shipped("container_ship_225m")
    return hull, hull.hydrostatics()


def _sections_of(hull: ah.Hull, low: float, high: float, step: float) -> ah.Hull:
    """The stations of a hull from one number to another, read as digitised lines, and no more."""
    ship = hull.particulars
    lines = []
    for name, line in hull.groups["sections"].lines.items():
        for curve in line.curves:
            number = 20.0 * float(curve.spline.xyz[0, 0]) / ship.length
            if low <= number <= high and abs(number / step - round(number / step)) < 1e-6:
                lines.append(LineSource.make("sections", name, sample(curve.spline, 6)[1]))
    kept = Particulars("sections", ship.length, ship.breadth, ship.depth, ship.draught, "closed")
    return ah.Hull.from_lines(lines, particulars=kept, associations=[])


@pytest.mark.parametrize(("low", "high", "step"), SPACINGS if LONG else SPACINGS[1:])
def test_the_volume_of_sections_alone_is_off_by_no_more_than_is_stated(
    whole: tuple[ah.Hull, Hydrostatics], low: float, high: float, step: float
) -> None:
    """Of a container ship: V, LCB and S; without the ends V was 1.7 % short, and .5 % stated."""
    ship, truth = whole
    found = _sections_of(ship, low, high, step).hydrostatics()
    for name in ("volume", "lcb", "waterplane_area"):
        off = abs(getattr(found, name) - getattr(truth, name))
        assert off <= (found.error[name] or 0.0), name
    assert found.volume == pytest.approx(truth.volume, rel=0.01)
    assert found.lwl == pytest.approx(225.0)
    aft, fore = found.notes
    assert aft.startswith(f"no line closes the hull beyond ST {low:g} (x ")
    assert "to x 225.00 m, the perpendicular" in fore


def test_a_wedge_at_each_end_is_integrated_exactly() -> None:
    """A box of 80 m between two wedges of 10 m: V, Aw, KMT's inertia, S, heeled and trimmed."""
    half, depth, draught = 5.0, 10.0, 6.0
    outline = [[0.0, 0.0], [half, 0.0], [half, depth]]
    lines = [
        LineSource.make("sections", f"ST {x:g}", [[x, y, z] for y, z in outline], kind=[0, 2, 0])
        for x in (10.0, 50.0, 90.0)
    ]
    ship = Particulars("box", 100.0, 2.0 * half, depth, draught, "closed")
    hull = ah.Hull.from_lines(lines, particulars=ship, associations=[])
    found = hull.hydrostatics()
    assert found.volume == pytest.approx(90.0 * 2.0 * half * draught, rel=1e-9)
    assert found.waterplane_area == pytest.approx(900.0, rel=1e-9)
    assert found.lcb == pytest.approx(50.0, abs=1e-9)
    sides = 2.0 * draught * (80.0 + 2.0 * float(np.hypot(10.0, half)))
    assert found.wetted_surface == pytest.approx(sides + 900.0, rel=1e-6)
    stated = found.error["volume"]
    assert stated is not None
    wedges = 10.0 * 2.0 * half * draught
    assert wedges <= stated <= 3.0 * wedges
    heeled = hull.hydrostatics(draughts=(5.0, 7.0), heel_deg=10.0)
    assert heeled.volume == pytest.approx(found.volume, rel=1e-9)


def test_ends_that_lines_or_extents_close_are_left_alone() -> None:
    """Wigley's profile closes hers; a box whose sections stand at both perpendiculars has none."""
    assert ah.examples.wigley().hydrostatics(on_error="report").notes == ()
    outline = [[0.0, 0.0], [5.0, 0.0], [5.0, 10.0]]
    lines = [
        LineSource.make("sections", f"ST {x:g}", [[x, y, z] for y, z in outline], kind=[0, 2, 0])
        for x in (0.0, 50.0, 100.0)
    ]
    ship = Particulars("box", 100.0, 10.0, 10.0, 6.0, "closed")
    found = ah.Hull.from_lines(lines, particulars=ship, associations=[]).hydrostatics()
    assert found.notes == ()
    assert found.volume == pytest.approx(6000.0, rel=1e-9)

"""A created hull with other definitions: all follows, also where crossings pass one another."""

from __future__ import annotations

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.hull import Hull
from assoc_hull.shipped.plain_ship import plain_ship_design
from tests.conftest import Shipped


@pytest.fixture
def ship(shipped: Shipped) -> Hull:
    """The plain ship, for one test."""
    return shipped("plain_ship")


def test_a_finer_ship(ship: Hull) -> None:
    """Buttocks whose crossings pass one another are put in order; the net has the new closure."""
    was = ship.fingerprint
    with ship.edit("finer") as edit:
        edit.set_form("sectional areas", cb=0.676)
    report = ship.history[-1]
    assert any("in their new order" in note for note in report.notes)
    assert ship.check() == ()
    assert ship.verify() == ()
    state = ship.state
    live = state.live("curves").tolist()
    assert sum(len(curve_folds(state.spline(curve))) for curve in live) == 0
    assert ship.creation.figure("CB").net == pytest.approx(0.676, rel=5e-4)
    assert ship.creation.figure("LCB").net == pytest.approx(-0.6, abs=0.02)
    now = ship.fingerprint
    ship.undo()
    assert ship.fingerprint == was
    ship.redo()
    assert ship.fingerprint == now


def test_a_change_that_keeps_the_order_is_made_at_once(ship: Hull) -> None:
    """No crossing loses its place, no role changes."""
    roles = ship.state.rows.role.data.copy()
    with ship.edit("a little flare") as edit:
        edit.set_form("waterline angle", FP_y=16.2)
    assert not any("new order" in note for note in ship.history[-1].notes)
    assert np.array_equal(ship.state.rows.role[: len(roles)], roles)
    assert ship.check() == ()


def test_an_edit_by_hand_survives(ship: Hull) -> None:
    """A detached section keeps its shape when definitions change, and can be returned."""
    point = next(each for each in ship.points if each.startswith("ST 17 @"))
    with ship.edit("by hand") as edit:
        _, y, z = ship.points[point].position
        edit.move(point, y=y + 0.02, z=z, lead=False)
    (finding,) = ship.check()
    assert (finding.kind, finding.object) == ("detached", "ST 17")
    drawn = ship.lines["ST 17"].curves[0].polyline(8)
    with ship.edit("keel") as edit:
        edit.set_form("keel angle", entrance_y=62.0)
    assert np.array_equal(ship.lines["ST 17"].curves[0].polyline(8), drawn)
    with ship.edit("back") as edit:
        edit.reattach("ST 17")
    assert ship.check() == ()
    keel = plain_ship_design().definition("keel_angle").having({"entrance_y": 62.0})
    few = attrs.evolve(plain_ship_design().having(keel), stations=(10.0, 17.0), waterlines=(3.6,))
    made = ah.create(attrs.evolve(few, buttocks=()))
    back, new = (each.lines["ST 17"].curves[0].polyline(8) for each in (ship, made))
    assert np.array_equal(back, new)

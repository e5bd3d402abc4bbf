"""Mending: which of two curves gives way where they pass each other too far off."""

import numpy as np
import pytest

from assoc_hull.edit.crossings.adopted_points import insert_defining_point, mend_gaps
from assoc_hull.graph.journal import Journal
from assoc_hull.hull import Hull
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.tables import HullState


def _watched(state: HullState, near: bool) -> int:
    """Find a watched crossing whose curve of higher rank has, or has not, a point beside it.

    The point is a crossing within 0.15 m; the other curve has room there.
    """
    rows = state.rows
    watched = np.flatnonzero(rows.alive.data & (rows.role.data == Role.WATCHED))
    for row in watched.tolist():
        held = [_beside(state, row, side) for side in (0, 1)]
        if not held[0] and held[1] == near:
            return row
    pytest.fail("no such crossing")


def _beside(state: HullState, row: int, side: int) -> bool:
    rows = state.rows
    own = state.curves.rows[int(rows.curve[row, side])]
    away = np.linalg.norm(rows.xyz[own] - rows.spot[row, 1 - side], axis=1)
    return bool(away.min() < 0.15) and rows.sort[own[int(away.argmin())]] != Sort.ADOPTED


@pytest.fixture(scope="module")
def state(series60_70: Hull) -> HullState:
    """A net with watched crossings; what a test does to it is taken back."""
    return series60_70.state


@pytest.mark.parametrize("held", [False, True])
def test_the_curve_of_higher_rank_gives_way_unless_it_is_held(state: HullState, held: bool) -> None:
    """A crossing within 0.15 m of the place holds it; then the other curve gets the point."""
    row = _watched(state, held)
    gives = 0 if held else 1
    curve = int(state.rows.curve[row, gives])
    place = state.rows.spot[row, 1 - gives].copy()
    journal = Journal()
    curves, moved = mend_gaps(Maker(state, journal), np.array([row]))
    own = state.curves.rows[curve]
    assert curves.tolist() == [curve]
    assert np.isin(moved, own).all()
    assert (state.rows.xyz[own] == place).all(axis=1).any()
    journal.undo()


def test_a_lone_adopted_point_is_moved_instead_of_getting_one_beside_it(state: HullState) -> None:
    """Two points 0.2 m apart on a curve whose others are metres away would bend it both ways."""
    journal = Journal()
    maker = Maker(state, journal)
    for row in np.flatnonzero(state.rows.alive.data & (state.rows.role.data == Role.WATCHED)):
        curve = int(state.rows.curve[row, 1])
        place = state.rows.spot[row, 0]
        own = state.curves.rows[curve]
        away = np.sort(np.linalg.norm(state.rows.xyz[own] - place, axis=1))
        if away[0] > 1.0:
            break
    else:
        pytest.fail("no crossing with room about it")
    beside = place + 0.2 * np.array([1.0, 0.0, 0.0])
    point = int(maker.points([PointSpec(curve, beside, Sort.ADOPTED)])[0])
    insert_defining_point(maker, curve, point)
    count = len(state.curves.rows[curve])
    _, moved = mend_gaps(maker, np.array([row]))
    assert moved.tolist() == [point]
    assert len(state.curves.rows[curve]) == count
    assert state.rows.xyz[point].tolist() == state.rows.spot[row, 0].tolist()
    journal.undo()

"""I1: every crossing lies on both of its curves, and no meeting is missing.

The tests take the splines alone and intersect them by scipy; the kernel is not asked.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

import assoc_hull as ah
from assoc_hull.model.objects import Crossing, Point
from tests.cases import places
from tests.independent import lost_meetings, trouble
from tests.long_forms import draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, hulls, tasks


def assert_consistent(hull: ah.Hull, kept: bool = False) -> None:
    """All of I1."""
    assert list(trouble(hull, kept)) == []
    assert list(lost_meetings(hull)) == []
    assert_friends_agree(hull)


def assert_friends_agree(hull: ah.Hull) -> None:
    """The two handles on a crossing that has a value give the same bits."""
    for crossing in hull.crossings.values():
        one, other = crossing.points
        if crossing.role != "watched":
            assert one.position.tobytes() == other.position.tobytes()
            assert (one.friend_point, other.friend_point) == (other, one)


@pytest.mark.parametrize("number", range(POOL))
def test_an_adopted_net_is_consistent(number: int) -> None:
    """Every shared and driven crossing to 1e-9 m, every gap within its limit."""
    assert_consistent(fresh(number))


@settings(max_examples=draws(25))
@given(hulls(), tasks(SHAPES))
def test_edits_of_shape_leave_a_consistent_hull(hull: ah.Hull, edits: list[Task]) -> None:
    """After moves, pulls, re-shapes, points inserted and deleted, ends and kinds set."""
    kept = False
    for task in edits:
        done = carry_out(hull, task) is not None
        kept |= done and task.gaps == "report"
        assert_consistent(hull, kept)


@settings(max_examples=draws(25))
@given(hulls(), tasks((*SHAPES, *STRUCTURE, *STRUCTURE)))
def test_edits_of_structure_leave_a_consistent_hull(hull: ah.Hull, edits: list[Task]) -> None:
    """Also when lines come and go and roles change in the same edits."""
    kept = False
    for task in edits:
        done = carry_out(hull, task) is not None
        kept |= done and task.gaps == "report"
        assert_consistent(hull, kept)


@settings(max_examples=draws(15))
@given(hulls(), tasks(("move", "pull", "reshape", "set_end"), largest=0.6, most=3))
def test_rough_edits_leave_a_consistent_hull(hull: ah.Hull, edits: list[Task]) -> None:
    """Edits of half a metre bear crossings and mend gaps, or are refused."""
    kept = False
    for task in edits:
        done = carry_out(hull, task) is not None
        kept |= done and task.gaps == "report"
        assert_consistent(hull, kept)


def test_series_60_is_consistent_before_and_after_edits(series60_70: ah.Hull) -> None:
    """The whole net, after a drag, a pull and a re-shape, each from the start."""
    hull = series60_70
    assert_consistent(hull)
    acts = (
        places.drag(hull, 0.004),
        places.pull(hull, 0.03),
        places.reshape(hull, "waterlines", 0.03),
    )
    for act, row in zip(acts, places.places(hull, places.PAIRS[:1], 3, 11), strict=True):
        try:
            with hull.edit("act") as edit:
                act(edit, row)
        except ah.errors.RefusedEditError:
            continue
        assert list(trouble(hull)) == []
        hull.undo()
    assert_consistent(hull)


def test_a_value_set_through_one_friend_is_read_through_the_other() -> None:
    """There is one value; both curves pass it, to the last bit."""
    hull = fresh(0)
    crossing = next(each for each in hull.crossings.values() if movable(each))
    one, other = crossing.points
    axis = one.free[0]
    for point, value in ((one, getattr(one, axis) + 0.01), (other, getattr(one, axis) - 0.01)):
        with hull.edit("move") as edit:
            edit.move(point, lead=False, **{axis: value})
        assert getattr(one, axis) == getattr(other, axis) == value
        for curve in (crossing.a, crossing.b):
            assert (curve.spline.xyz == one.position).all(axis=1).sum() == 1


def movable(crossing: Crossing) -> bool:
    """Whether a crossing is shared and free in one coordinate."""
    return crossing.role == "shared" and len(crossing.points[0].free) == 1


def test_the_root_finder_sees_what_is_tampered_with() -> None:
    """A shared value that is off by 2e-9 m, and a crossing taken out of the table."""
    hull = fresh(2)
    rows = hull.document.state.rows
    row = next(c.row for c in hull.crossings.values() if movable(c) and not at_boundary(c))
    rows.xyz.store[row, int(np.flatnonzero(_free(hull, row))[0])] += 2e-9
    assert any(hull.state.rows.key[row] in text for text in trouble(hull))
    rows.alive.store[row] = False
    assert len(list(lost_meetings(hull))) == 1


def at_boundary(crossing: Crossing) -> bool:
    """Whether one of the curves is a boundary curve."""
    return any(curve.line.group.family == "boundary" for curve in (crossing.a, crossing.b))


def _free(hull: ah.Hull, row: int) -> np.typing.NDArray[np.bool_]:
    return np.isin(np.array(["x", "y", "z"]), Point.of(hull.state, row).free)

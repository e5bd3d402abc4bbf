"""A point put beside its line leads, unless it is asked to be pinned."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import ArrayLike

import assoc_hull as ah
from assoc_hull.edit.modifications import points as pinned
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import (
    BadInputError,
    CoincidentPointsError,
    PointRoleError,
    WrongTypeError,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.model.objects import Point
from tests.conftest import Shipped

_NOTE = "between points that stay: the line bends there and the hull does not follow"


@pytest.fixture
def wigley(shipped: Shipped) -> Hull:
    """The Wigley hull, one's own."""
    return shipped("wigley")


def _beside(hull: Hull, away: float, at: float = 37.0) -> FloatArray:
    return np.add(hull.lines["WL 2.5"].curves[0].at(at), (0.0, away, 0.0))


def _led(hull: Hull) -> tuple[str, ...]:
    return tuple(led.line for led in hull.history[-1].led)


def test_an_inserted_point_off_its_line_leads_in_one_step(wigley: Hull) -> None:
    """It lands where it was put, sections follow, and one undo takes all back."""
    before, place = wigley.fingerprint, _beside(wigley, 0.01)
    with wigley.edit("insert") as edit:
        point = edit.insert("WL 2.5", place)
    assert np.array_equal(point.position, place)
    assert point.sort == "placed"
    assert _led(wigley) == (wigley.lines["WL 2.5"].id,)
    assert len(wigley.history[-1].followed) > 3
    assert len(wigley.history) == 1
    wigley.undo()
    assert wigley.fingerprint == before


@pytest.mark.parametrize("away", [0.0, 0.9e-3])
def test_a_point_on_its_line_is_pinned(wigley: Hull, away: float) -> None:
    """Within 1e-5 Lpp it is a point on the line, as ever."""
    with wigley.edit("insert") as edit:
        edit.insert("WL 2.5", _beside(wigley, away))
    assert not _led(wigley)
    assert not any(_NOTE in note for note in wigley.history[-1].notes)


@pytest.mark.parametrize("act", ["insert", "move"])
def test_without_lead_it_is_the_pinned_act_to_the_bit_and_says_so(
    shipped: Shipped, act: str
) -> None:
    """The bits are those of the pinned modification itself."""
    prints = []
    for plain in (True, False):
        hull = shipped("wigley")
        place = _beside(hull, 0.01)
        with hull.edit("on the line") as edit:
            point = edit.insert("WL 2.5", _beside(hull, 0.0, 42.0))
        x, y = point.x, point.y
        curve = hull.lines["WL 2.5"].curves[0]
        if plain:
            with Transaction(hull.document, "pinned") as held:
                if act == "insert":
                    pinned.insert(held, curve.number, place)
                else:
                    pinned.move(held, point.number, {"x": x, "y": y + 0.01})
        else:
            with hull.edit("pinned") as edit:
                if act == "insert":
                    edit.insert(curve, place, lead=False)
                else:
                    edit.move(point, x=x, y=y + 0.01, lead=False)
            assert any(_NOTE in note for note in hull.history[-1].notes)
            assert not _led(hull)
        prints.append(hull.fingerprint)
    assert prints[0] == prints[1]


def test_placed_and_adopted_points_lead_when_they_are_moved_and_crossings_do_not(
    wigley: Hull,
) -> None:
    """By a place and by a vector; an adopted one is placed from then on."""
    with wigley.edit("on the line") as edit:
        point = edit.insert("WL 2.5", _beside(wigley, 0.0))
    with wigley.edit("to a place") as edit:
        edit.move(point, x=point.x, y=point.y + 0.01)
    assert _led(wigley)
    with wigley.edit("adopt") as edit:
        edit.unpin(point)
    with wigley.edit("by a vector") as edit:
        edit.move([point, "WL 5 x ST 7"], by=(0.0, 0.005, 0.0))
    assert _led(wigley) == (wigley.lines["WL 2.5"].id,), "the crossing of WL 5 is pinned"
    assert point.sort == "placed"
    with wigley.edit("a crossing") as edit:
        edit.move("WL 2.5 x ST 7", by=(0.0, 0.005, 0.0))
    assert not _led(wigley)
    assert not wigley.check()


def test_a_point_in_the_plane_of_a_crossing_is_asked_of_that_crossing(wigley: Hull) -> None:
    """No second point comes to lie there; the crossing is given back."""
    place = np.add(wigley.points["WL 2.5 x ST 7"].position, (0.0, 0.01, 0.0))
    count = len(wigley.points)
    with wigley.edit("insert") as edit:
        point = edit.insert("WL 2.5", place)
    assert point.name in ("WL 2.5 x ST 7", "ST 7 x WL 2.5")
    assert np.array_equal(point.position, place)
    assert len(wigley.points) == count
    with pytest.raises(CoincidentPointsError), wigley.edit("on it") as edit:
        edit.insert("WL 2.5", place)


def test_boundary_curves_flats_and_features_are_pinned(shipped: Shipped) -> None:
    """They have no fair answer: a point put there is a point of theirs, as ever."""
    wigley = shipped("wigley")
    profile = wigley.lines["profile"].curves[0]
    with wigley.edit("profile") as edit:
        point = edit.insert(profile, np.add(profile.at(0.37 * profile.span), (0.0, 0.0, 0.005)))
    with wigley.edit("move") as edit:
        edit.move(point, x=point.x, z=point.z + 0.005)
    with wigley.edit("straight") as edit:
        edit.straighten("WL 2.5", "WL 2.5 x ST 4", "WL 2.5 x ST 7")
    with wigley.edit("dissolved") as edit:
        edit.insert("WL 2.5", _beside(wigley, 0.002, 27.0))
    assert not any(each.led for each in wigley.history)
    assert "WL 2.5 straight" not in wigley.features


def test_inserts_and_moves_of_one_edit_are_one_lead_to_the_bit(shipped: Shipped) -> None:
    """In any order, and as if they were asked of `edit.lead` at once."""
    prints = []
    for way in ("inserts", "other way round", "one lead"):
        hull = shipped("wigley")
        with hull.edit("on the line") as edit:
            edit.insert("WL 2.5", _beside(hull, 0.0, 57.0))
        (placed,) = [each for each in hull.lines["WL 2.5"].points if each.sort == "placed"]
        places = [_beside(hull, 0.01), np.add(placed.position, (0.0, 0.01, 0.0))]
        with hull.edit(way) as edit:
            if way == "one lead":
                asked: list[ArrayLike | tuple[Point | str, ArrayLike]] = [
                    places[0], (placed, places[1]),
                ]  # fmt: skip
                edit.lead("WL 2.5", asked)
            elif way == "inserts":
                edit.insert("WL 2.5", places[0])
                edit.move(placed, by=(0.0, 0.01, 0.0))
            else:
                edit.move(placed, by=(0.0, 0.01, 0.0))
                edit.insert("WL 2.5", places[0])
        (led,) = hull.history[-1].led
        assert len(led.asked) == 2
        prints.append(hull.fingerprint)
    assert len(set(prints)) == 1


def test_a_point_that_the_same_edit_has_inserted_comes_where_it_is_moved(wigley: Hull) -> None:
    """Others are asked to be in one place only."""
    place = _beside(wigley, 0.02)
    with wigley.edit("insert") as edit:
        point = edit.insert("WL 2.5", _beside(wigley, 0.01))
        edit.move(point, x=place[0], y=place[1])
    assert np.array_equal(point.position, place)
    twice = pytest.raises(BadInputError, match=r"is asked to be in two places, in move on WL 2\.5")
    with twice, wigley.edit("twice") as edit:
        edit.move(point, by=(0.0, 0.01, 0.0))
        edit.move(point, by=(0.0, 0.02, 0.0))


def test_a_move_to_where_a_point_lies_is_no_step(wigley: Hull) -> None:
    """As of a pinned one."""
    with wigley.edit("insert") as edit:
        point = edit.insert("WL 2.5", _beside(wigley, 0.0))
    with wigley.edit("nowhere") as edit:
        edit.move(point, x=point.x, y=point.y)
    assert len(wigley.history) == 1
    assert edit.report is not None
    assert not edit.report.changed


def test_what_is_refused_says_what_to_do_and_that_works(wigley: Hull) -> None:
    """Beside a placed point, and where another line drives."""
    with wigley.edit("insert") as edit:
        edit.insert("WL 2.5", _beside(wigley, 0.0))
    x, y, _ = _beside(wigley, 0.01, 37.1).tolist()
    with pytest.raises(BadInputError) as error, wigley.edit("beside") as edit:
        edit.insert("WL 2.5", (x, y, 2.5))
    assert f"edit.move('WL 2.5 @ placed 1', x={x:.6f}" in str(error.value)
    with wigley.edit("as it says") as edit:
        edit.move("WL 2.5 @ placed 1", x=round(x, 6), y=round(y, 6))
    assert _led(wigley)
    with wigley.edit("or pinned") as edit:
        edit.insert("WL 2.5", (x + 0.1, y, 2.5), lead=False)
    near = pytest.raises(BadInputError, match="leave one of the two out")
    with near, wigley.edit("two") as edit:
        edit.insert("WL 2.5", _beside(wigley, 0.01, 63.0))
        edit.insert("WL 2.5", _beside(wigley, 0.01, 63.1))
    with wigley.edit("one-way") as edit:
        edit.associate("sections", "waterlines", two_way=False)
    place = np.add(wigley.points["WL 5 x ST 7"].position, (0.0, 0.005, 0.0))
    driven = pytest.raises(PointRoleError, match=r"lead ST 7.*or pin a point .*\(lead=False\)$")
    with driven, wigley.edit("driven") as edit:
        edit.insert("WL 5", place)
    with wigley.edit("the driver") as edit:
        edit.lead("ST 7", [place])
    assert np.allclose(wigley.points["WL 5 x ST 7"].position, place, rtol=0.0, atol=1e-9)


def test_a_point_that_the_border_of_a_flat_drives_names_what_can_be_done(shipped: Shipped) -> None:
    """A boundary curve is not led: it is re-shaped, flat and all, and the point goes along."""
    hull = shipped("series60_70")
    point = hull.points["BTK 0.2 x flat of bottom #2"]
    x, y, z = point.position
    place, span = [(x + 0.3, y, z)], (x - 8.0, x + 8.0)
    ways = r"re-shape flat of bottom \(edit.reshape with across_flats=True\), or ask for another"
    with pytest.raises(PointRoleError, match=ways), hull.edit("driven") as edit:
        edit.lead("BTK 0.2", [(point, place[0])])
    flat = pytest.raises(BadInputError, match="lies beside a flat, which stays as it is, in resh")
    with flat, hull.edit("without") as edit:
        edit.reshape("flat of bottom", place, span=span)
    with hull.edit("the border") as edit:
        edit.reshape("flat of bottom", place, span=span, across_flats=True)
    assert hull.points["BTK 0.2 x flat of bottom #2"].x == pytest.approx(x + 0.3, abs=0.005)
    assert hull.verify() == ()


def test_scripts_write_it_out_and_leave_points_pinned_without_it(wigley: Hull) -> None:
    """A script of an older version has no `lead`, and does what it did."""
    place = _beside(wigley, 0.01).tolist()
    with wigley.edit("leads") as edit:
        edit.insert("WL 2.5", place)
    (said,) = wigley.document.history[-1].script.edits
    assert said == {"op": "insert", "curve": "WL 2.5", "place": place, "lead": True}
    leads = wigley.fingerprint
    wigley.undo()
    del said["lead"]
    wigley.apply("of an older version", [said])
    assert not _led(wigley)
    (again,) = wigley.document.history[-1].script.edits
    assert again == {**said, "lead": False}
    wigley.undo()
    wigley.apply("again", [{**said, "lead": True}])
    assert wigley.fingerprint == leads
    other = ah.examples.wigley()
    assert all(each.report is not None for each in other.replay(wigley))
    assert other.fingerprint == leads


def test_a_drag_that_moves_is_pinned(wigley: Hull) -> None:
    """A hand that draws is followed at once; what it commits is what was shown."""
    with wigley.edit("on the line") as edit:
        point = edit.insert("WL 2.5", _beside(wigley, 0.0))
    with wigley.drag(point, how="move") as drag:
        drag.to(x=point.x, y=point.y + 0.01)
        drag.commit("moved")
    assert not _led(wigley)
    assert wigley.document.history[-1].script.edits[0]["lead"] is False


def test_lead_is_true_or_false(wigley: Hull) -> None:
    """Anything else is refused."""
    with pytest.raises(WrongTypeError, match="lead is 1"), wigley.edit("x") as edit:
        edit.insert("WL 2.5", _beside(wigley, 0.01), lead=1)  # type: ignore[arg-type]
    with pytest.raises(WrongTypeError, match="lead is 1"), wigley.edit("x") as edit:
        edit.move("WL 2.5 x ST 7", y=2.9, lead=1)  # type: ignore[arg-type]

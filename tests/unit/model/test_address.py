"""Addresses lead to points, and back."""

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import AddressBook, address, resolve_address
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import CrossingSpec, Maker, PointSpec
from assoc_hull.model.tables import HullState
from assoc_hull.shipped.wigley import wigley


@pytest.fixture
def state() -> HullState:
    """A hull of its own, to be written to."""
    return wigley()


def line_number(state: HullState, name: str) -> int:
    """The number of a line."""
    number: int = state.lines.name.data.index(name)
    return number


def rename(state: HullState, name: str, new: str) -> None:
    """Give a line another name."""
    state.lines.name.store[line_number(state, name)] = new


def add_second_birth(state: HullState) -> int:
    """A second crossing of WL 2.5 and ST 7."""
    row = resolve_address(state, "WL 2.5 x ST 7").row
    a, b = state.rows.curve[row].tolist()
    spec = CrossingSpec(a, b, state.rows.xyz[row], Role.WATCHED, -1)
    return int(Maker(state, Journal()).crossings([spec])[0])


def assert_round_trip(state: HullState) -> None:
    """Every point has an address of its own on each of its curves, and it leads back."""
    book, seen = AddressBook(state), set()
    for row in state.live("rows").tolist():
        for side in (0, 1):
            if state.rows.curve[row, side] < 0:
                continue
            found = book.resolve(text := book.address(row, side))
            crossing = state.rows.curve[row, 1] >= 0
            assert found.row == row
            assert found.side == side or (crossing and text == state.rows.key[row])
            seen.add(text)
    assert len(seen) >= len(state.live("rows"))


def test_every_point_has_an_address_that_leads_back(state: HullState) -> None:
    """The round trip holds for all points of a hull."""
    assert_round_trip(state)


def test_either_order_of_the_lines_leads_to_the_crossing(state: HullState) -> None:
    """The line named first is the one the point lies on; the other is its friend."""
    one, other = resolve_address(state, "WL 2.5 x ST 7"), resolve_address(state, "ST 7 x WL 2.5")
    assert one.row == other.row
    assert (one.side, other.side) == (1, 0)
    assert state.lines.name[one.line] == "WL 2.5"


def test_a_second_birth_is_told_apart(state: HullState) -> None:
    """The first keeps its plain name; the second has a number."""
    row = add_second_birth(state)
    assert address(state, row) == "WL 2.5 x ST 7 #2"
    assert resolve_address(state, "ST 7 x WL 2.5 #2").row == row
    assert resolve_address(state, "WL 2.5 x ST 7").row != row
    assert_round_trip(state)


def test_the_only_crossing_left_needs_no_number(state: HullState) -> None:
    """When the first has gone, the plain name leads to the second."""
    first, second = resolve_address(state, "WL 2.5 x ST 7").row, add_second_birth(state)
    Journal().put(state.rows.alive, [first], [False])
    assert resolve_address(state, "WL 2.5 x ST 7").row == second


@pytest.mark.parametrize("sort", [Sort.PLACED, Sort.ADOPTED])
def test_own_points_are_counted_along_the_line(state: HullState, sort: Sort) -> None:
    """Placed and adopted points have numbers from the start of their line."""
    curve = state.lines.curves[line_number(state, "WL 2.5")][0]
    maker = Maker(state, Journal())
    specs = [PointSpec(curve, (x, 1.0, 2.5), sort) for x in (80.0, 20.0)]
    far, near = maker.points(specs).tolist()
    rows = state.curves.rows[curve]
    maker.define(curve, np.concatenate([rows[:2], [near], rows[2:-1], [far], rows[-1:]]))
    name = sort.name.lower()
    assert address(state, near) == f"WL 2.5 @ {name} 1"
    assert resolve_address(state, f"WL 2.5 @ {name} 2").row == far
    assert_round_trip(state)


def test_equal_names_in_two_groups_need_the_group(state: HullState) -> None:
    """The error names both; addresses carry the group."""
    rename(state, "WL 2.5", "A")
    rename(state, "ST 7", "A")
    with pytest.raises(BadInputError, match="waterlines/A"):
        resolve_address(state, "A x ST 8")
    row = resolve_address(state, "waterlines/A x ST 8").row
    assert address(state, row) == "waterlines/A x ST 8"
    assert_round_trip(state)


@pytest.mark.parametrize("name", ["a x b", "ST 7 #2", "WL 5 x ST 8", "WL 5 @ placed 1", "q [2]"])
def test_confusing_names_still_lead_back(state: HullState, name: str) -> None:
    """Where names could be read in two ways, the key stands in."""
    rename(state, "WL 2.5", name)
    assert_round_trip(state)


@pytest.mark.parametrize(
    ("wrong", "near"),
    [("WL 2.4", "WL 2.5"), ("WL 2.5 x ST 77", "WL 2.5 x ST 7"), ("waterline", "waterlines")],
)
def test_an_unknown_name_is_answered_with_near_ones(
    state: HullState, wrong: str, near: str
) -> None:
    """The message helps."""
    with pytest.raises(UnknownNameError) as caught:
        resolve_address(state, wrong)
    assert repr(near) in str(caught.value)


def test_keys_lines_curves_and_groups_are_addresses_too(state: HullState) -> None:
    """The deepest object that is named is given."""
    row = resolve_address(state, "WL 2.5 x ST 7").row
    assert resolve_address(state, state.rows.key[row]).row == row
    assert resolve_address(state, "waterlines").group >= 0
    assert resolve_address(state, "waterlines/WL 2.5").line == line_number(state, "WL 2.5")
    assert (
        resolve_address(state, "WL 2.5 [1]").curve == resolve_address(state, "WL 2.5 x ST 7").curve
    )
    state.rows.label.store[row] = "shoulder"
    assert resolve_address(state, "shoulder").row == row

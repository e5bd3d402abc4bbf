"""Handles show what the tables hold, frozen, and know when their object has gone."""

import numpy as np
import pytest

from assoc_hull.errors import ForeignPointError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.kinds import Role
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.objects import Crossing, Curve, Group, Line, Point, handle
from assoc_hull.model.tables import Association, HullState
from assoc_hull.shipped.wigley import wigley


@pytest.fixture
def state() -> HullState:
    """A hull of its own, to be written to."""
    return wigley()


def point(state: HullState, address: str) -> Point:
    """The point at an address."""
    found = handle(state, address)
    assert isinstance(found, Point)
    return found


def line(state: HullState, address: str) -> Line:
    """The line at an address."""
    found = handle(state, address)
    assert isinstance(found, Line)
    return found


def group(state: HullState, name: str) -> Group:
    """The group of a name."""
    found = handle(state, name)
    assert isinstance(found, Group)
    return found


def test_friends_are_two_handles_on_one_value(state: HullState) -> None:
    """They are not equal, name one another, and agree bit for bit."""
    one = point(state, "WL 2.5 x ST 7")
    other = one.friend_point
    assert other is not None
    assert other != one
    assert other.friend_point == one
    assert other.id == one.id
    assert other.position.tobytes() == one.position.tobytes()
    assert (other.name, one.name) == ("ST 7 x WL 2.5", "WL 2.5 x ST 7")
    assert one.parent_curve == other.container_curve


def test_equal_handles_are_one_key_in_a_set(state: HullState) -> None:
    """Handles are values; those of another hull are others."""
    names = ["WL 2.5 x ST 7"] * 2
    assert len({point(state, name) for name in names}) == 1
    assert point(state, names[0]) != point(wigley(), names[0])


def test_values_are_frozen(state: HullState) -> None:
    """No value a handle gives can be written to."""
    one = point(state, "WL 2.5 x ST 7")
    curve = one.container_curve
    values: list[FloatArray] = [
        one.position, curve.at(1.0), curve.at([1.0, 2.0]), curve.tangent(1.0),
        curve.curvature(1.0), curve.polyline(), curve.ends, curve.line.meet(((1, 0, 0), 30.0)),
    ]  # fmt: skip
    assert not any(value.flags.writeable for value in values)
    with pytest.raises(AttributeError):
        one.number = 3  # type: ignore[misc]
    with pytest.raises(TypeError):
        group(state, "sections").lines["x"] = curve.line  # type: ignore[index]


@pytest.mark.parametrize(
    ("address", "free"),
    [
        pytest.param("WL 2.5 x ST 7", ("y",), id="section and waterline"),
        pytest.param("WL 2.5 x profile", ("x",), id="waterline and profile"),
        pytest.param("ST 7 x profile", ("z",), id="section and profile"),
        pytest.param("profile @ placed 1", ("x", "z"), id="own point in a plane"),
    ],
)
def test_free_coordinates_are_those_of_no_plane(
    state: HullState, address: str, free: tuple[str, ...]
) -> None:
    """A crossing moves along the line in which its planes meet."""
    if "placed" in address:
        mine = (state.rows.curve[:, 0] == 0) & (state.rows.curve[:, 1] < 0)
        assert Point.of(state, int(np.flatnonzero(mine)[0])).free == free
        return
    assert point(state, address).free == free


def test_a_space_curve_leaves_two_freedoms(state: HullState) -> None:
    """A plane line and a space curve: anywhere in the plane."""
    deck = line(state, "deck edge")
    Journal().put(state.lines.planar, [deck.number], [False])
    assert point(state, "ST 7 x deck edge").free == ("y", "z")
    assert deck.plane is None
    assert deck.position is None


def test_points_stand_in_order_along_the_curve(state: HullState) -> None:
    """Defining and derived, by parameter; defining are those the spline is made of."""
    for curve in line(state, "WL 2.5").curves + line(state, "profile").curves:
        t = [curve.closest(each.position)[0] for each in curve.points]
        assert t == sorted(t)
        assert set(curve.defining) <= set(curve.points)
        places = np.array([each.position for each in curve.defining])
        assert places.tobytes() == curve.spline.xyz.tobytes()


def test_a_curve_tells_its_geometry(state: HullState) -> None:
    """Places, tangents and lengths agree with one another."""
    curve = line(state, "WL 2.5").curves[0]
    assert curve.at(0.0).tolist() == curve.ends[0].tolist()
    assert curve.at([0.0, curve.span]).tolist() == curve.ends.tolist()
    assert np.isclose(np.linalg.norm(curve.tangent(30.0)), 1.0)
    assert np.allclose(curve.tangent([50.0]), [[1, 0, 0]], atol=0.05)
    assert curve.curvature(50.0)[1] < 0.0
    assert 100.0 < curve.length < 103.0
    t, place, distance = curve.closest((50.0, 0.0, 2.5))
    assert curve.at(t) == pytest.approx(place)
    assert distance == pytest.approx(place[1], rel=1e-3)


def test_roles_are_told_by_point_and_crossing(state: HullState) -> None:
    """A crossing that drives b defines b, and lies derived on a."""
    one = point(state, "WL 2.5 x ST 7")
    assert (one.role, one.crossing_role, one.driver) == ("defining", "shared", None)
    Maker(state, Journal()).roles(np.array([one.number]), np.array([Role.DRIVES_B]))
    friend = one.friend_point
    assert friend is not None
    assert (one.role, friend.role) == ("defining", "derived")
    assert one.driver == friend.container_curve
    crossing = one.crossing
    assert isinstance(crossing, Crossing)
    assert (crossing.role, crossing.sign, crossing.birth, crossing.gap) == ("drives b", 1, 1, None)
    assert crossing.points == (friend, one)
    assert (crossing.a, crossing.b) == (friend.container_curve, one.container_curve)


def test_own_points_have_no_parent(state: HullState) -> None:
    """An adopted or placed point is independent."""
    own = next(each for each in line(state, "profile").points if each.sort == "adopted")
    assert (own.parent_curve, own.friend_point, own.crossing_role) == (None, None, None)
    assert own.container_curve.line.name == "profile"


def test_two_way_means_that_each_lists_the_other(state: HullState) -> None:
    """A one-way association leaves one side without the touch."""
    one = point(state, "WL 2.5 x ST 7")
    friend = one.friend_point
    assert friend is not None
    waterline, section = one.container_curve, friend.container_curve
    assert one in section.touch_objects.actual
    assert friend in waterline.touch_objects.actual
    Maker(state, Journal()).associate(Association("sections", "waterlines", two_way=False))
    assert one in section.touch_objects.actual
    assert friend not in waterline.touch_objects.actual
    assert section not in waterline.touch_objects.latent


def test_latent_are_those_it_does_not_meet_now(state: HullState) -> None:
    """A crossing that goes turns its curves latent; parallel planes never are."""
    one = point(state, "WL 2.5 x ST 7")
    waterline, section = one.container_curve, one.parent_curve
    assert section is not None
    assert not waterline.touch_objects.latent
    Maker(state, Journal()).remove_rows([one.number])
    assert waterline.touch_objects.latent == (section,)


def test_lines_and_groups_are_read_by_name(state: HullState) -> None:
    """Mappings by name in the order of the planes; tuples."""
    sections = group(state, "sections")
    assert sections.family == "sections"
    assert list(sections.lines)[:2] == ["ST 1", "ST 2"]
    seven = sections.lines["ST 7"]
    assert (seven.position, seven.boundary, seven.group) == (35.0, None, sections)
    assert isinstance(seven.curves, tuple)
    assert isinstance(seven.curves[0].points, tuple)
    assert line(state, "profile").boundary == "end"
    assert line(state, "WL 2.5").meet(((1, 0, 0), 35.0))[0] == pytest.approx((35, 2.912, 2.5))
    assert line(state, "WL 2.5").meet(((0, 0, 1), 9.0)).shape == (0, 3)


def test_state_and_revision_are_shown(state: HullState) -> None:
    """They are those of the tables."""
    one = point(state, "WL 2.5 x ST 7")
    curve = one.container_curve
    assert (one.state, one.revision, curve.state, curve.revision) == ("clean", 0, "clean", 0)
    state.revision_row[one.number] = 3
    Journal().put(state.curves.state, [curve.number], [1])
    assert (one.revision, curve.state) == (3, "failed")


def test_a_handle_on_what_has_gone_says_so(state: HullState) -> None:
    """Also where its row was taken back, or another object has it now."""
    one, curve = point(state, "WL 2.5 x ST 7"), line(state, "WL 2.5").curves[0]
    Maker(state, Journal()).remove_rows([one.number])
    assert not one.alive
    with pytest.raises(ForeignPointError, match=r"waterlines:2\.500000"):
        _ = one.position
    state.curves.key.store[curve.number] = "another"
    with pytest.raises(ForeignPointError, match="curve"):
        _ = curve.points
    beyond = Curve(state, state.curves.count, "none")
    with pytest.raises(ForeignPointError):
        _ = beyond.length
    assert "gone" in repr(one)

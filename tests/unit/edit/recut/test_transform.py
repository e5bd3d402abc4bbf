"""Transformations: drivers are carried exactly, followers are cut again, nothing is lost."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.recut.transform import transform
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    ForeignPointError,
    RefusedEditError,
    UnknownNameError,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.shipped.wigley import wigley_half_breadth
from tests.independent import lost_meetings, trouble
from tests.long_forms import long_form
from tests.net_strategies import refused
from tests.taken_back import taken_back

Map = Callable[[FloatArray], FloatArray]
MAIN = ["sections", "profile"]


def swell(xyz: FloatArray) -> FloatArray:
    """Broaden amidships by 3 %, fading along the length."""
    bell = np.exp(-(((xyz[:, 0] - 60.0) / 25.0) ** 2))
    return np.column_stack([xyz[:, 0], xyz[:, 1] * (1.0 + 0.03 * bell), xyz[:, 2]])


def lift(xyz: FloatArray) -> FloatArray:
    """Lift the afterbody around z = 3 m by 0.3 m."""
    bell = 0.3 * np.exp(-(((xyz[:, 0] - 20.0) / 15.0) ** 2) - ((xyz[:, 2] - 3.0) / 2.0) ** 2)
    return np.column_stack([xyz[:, 0], xyz[:, 1], xyz[:, 2] + bell])


def rake(xyz: FloatArray) -> FloatArray:
    """Move the hull forward, more above: sections leave their planes."""
    return np.column_stack([xyz[:, 0] + 0.3 * np.sin(xyz[:, 2] / 5.0), xyz[:, 1], xyz[:, 2]])


def small() -> ah.Hull:
    """Give a Wigley hull with buttocks."""
    hull = ah.examples.wigley(stations=13, waterlines=8)
    return hull


def groups(hull: ah.Hull) -> list[str]:
    """Give the names of all groups that have lines."""
    return [name for name, group in hull.groups.items() if group.lines]


def transformed(hull: ah.Hull, mapping: Map, drivers: list[str], **how: str) -> ah.Hull:
    """Carry out one transformation, and check what must always hold."""
    before = hull.fingerprint
    with hull.edit("transform") as edit:
        edit.transform(mapping, drivers, **how)  # type: ignore[arg-type]
    assert list(trouble(hull)) == []
    assert list(lost_meetings(hull)) == []
    assert hull.verify() == ()
    assert hull.check() == ()
    after = hull.fingerprint
    hull.undo()
    assert hull.fingerprint == before
    hull.redo()
    assert hull.fingerprint == after
    return hull


@pytest.fixture(scope="module")
def wigley() -> ah.Hull:
    """A hull to be edited and taken back."""
    return small()


@pytest.fixture(scope="module")
def whole_wigley() -> ah.Hull:
    """The example as it comes."""
    return ah.examples.wigley()


@pytest.fixture
def fresh_wigley(whole_wigley: ah.Hull) -> Iterator[ah.Hull]:
    """The example, to be edited at will: it is taken back when the test is over."""
    with taken_back(whole_wigley) as hull:
        yield hull


@pytest.fixture(params=["wigley", "series60"])
def hull(request: pytest.FixtureRequest) -> Iterator[ah.Hull]:
    """A mathematical hull and a real one."""
    name = "wigley" if request.param == "wigley" else "series60_70"
    with taken_back(request.getfixturevalue(name)) as shared:
        yield shared


@pytest.mark.parametrize("drivers", [MAIN, None], ids=["sections and profile", "all"])
def test_identity_changes_no_bit(hull: ah.Hull, drivers: list[str] | None) -> None:
    """The identity gives the same fingerprint, whatever drives."""
    before = hull.fingerprint
    with hull.edit("identity") as edit:
        edit.transform(lambda xyz: xyz, drivers or groups(hull))
    assert hull.fingerprint == before
    assert edit.report is not None
    assert edit.report.relofted == ()


AFFINE = {
    "broader": [1.0, 1.1, 1.0],
    "longer": [1.05, 1.0, 1.0],
    "higher": [1.0, 1.0, 0.9],
    "all at once": [1.04, 0.95, 1.1],
}


@pytest.mark.parametrize("scale", AFFINE.values(), ids=AFFINE.keys())
def test_affine_with_all_groups_driving_is_exact(hull: ah.Hull, scale: list[float]) -> None:
    """Every shared crossing, own point and plane goes where the mapping sends it, to 1e-9 m.

    A computed crossing lies where its driver, lofted again, meets the plane: the image of a
    spline is the spline through the images only if the factors are equal, else the driver
    stays within 2 mm of the image.
    """
    before, live = hull.state, hull.state.live("rows")
    old, planes = before.rows.xyz[live], before.lines.offset.data
    normals = before.lines.normal.data
    transformed(hull, lambda xyz: xyz * scale, groups(hull))
    table = hull.state.rows
    off = np.abs(table.xyz[live] - old * scale).max(axis=1)
    held = (table.driver[live] < 0) & (
        (table.sort[live] != Sort.CROSSING) | (table.role[live] == Role.SHARED)
    )
    assert table.alive[live].all()
    assert off[held].max() <= 1e-9
    along = np.abs(normals * scale).sum(axis=1)
    assert np.abs(hull.state.lines.offset.data - planes * along).max() <= 1e-9


def test_a_similarity_is_exact_everywhere(hull: ah.Hull) -> None:
    """With equal factors computed crossings are exact too: chord lengths scale as one."""
    table, live = hull.state.rows, hull.state.live("rows")
    live = live[table.role[live] != Role.WATCHED]
    old = table.xyz[live]
    transformed(hull, lambda xyz: xyz * 1.1, groups(hull))
    assert np.abs(hull.state.rows.xyz[live] - 1.1 * old).max() <= 1e-9


def off_formula(hull: ah.Hull, breadth: float, draught: float) -> float:
    """Measure how far the waterlines leave the formula, m."""
    worst = 0.0
    for line in hull.groups["waterlines"].lines.values():
        places = sample(hull.state.spline(line.curves[0].row), 8)[1]
        truth = wigley_half_breadth(places[:, 0], places[:, 2], 100.0, breadth, draught)
        worst = max(worst, float(np.abs(places[:, 1] - truth).max()))
    return worst


def test_breadth_on_wigley_agrees_with_the_formula(fresh_wigley: ah.Hull) -> None:
    """Followers of a broader Wigley hull pass the formula as closely as the hull it came from.

    Sections and profile drive, the waterlines follow. The loft leaves the formula by up to
    4.2 mm beside the ends; scaled, by as much more.
    """
    hull = fresh_wigley
    before = off_formula(hull, 10.0, 6.25)
    transformed(hull, lambda xyz: xyz * [1.0, 1.1, 1.0], MAIN)
    assert off_formula(hull, 11.0, 6.25) < 1.1 * before + 1e-4


def test_depth_on_wigley_agrees_with_the_formula(fresh_wigley: ah.Hull) -> None:
    """Waterlines stay in their planes and are cut where the higher hull passes them."""
    hull = fresh_wigley
    planes = [line.position for line in hull.groups["waterlines"].lines.values()]
    before = off_formula(hull, 10.0, 6.25)
    transformed(hull, lambda xyz: xyz * [1.0, 1.0, 1.05], MAIN)
    assert [line.position for line in hull.groups["waterlines"].lines.values()] == planes
    assert off_formula(hull, 10.0, 6.25 * 1.05) < before + 1e-4


def test_planes_follow_where_the_mapping_moves_them(fresh_wigley: ah.Hull) -> None:
    """Asked to, the planes of followers go along: the waterlines are those of before, scaled."""
    hull = fresh_wigley
    before = [line.position for line in hull.groups["waterlines"].lines.values()]
    names = list(hull.groups["waterlines"].lines)
    transformed(hull, lambda xyz: xyz * [1.0, 1.0, 1.05], MAIN, planes="follow")
    after = hull.groups["waterlines"].lines
    assert [line.position for line in after.values()] == [1.05 * (z or 0.0) for z in before]
    assert list(after) == names


MAPS: dict[str, tuple[Map, str]] = {
    "broader": (lambda xyz: xyz * [1.0, 1.1, 1.0], "stay"),
    "broader, buttocks too": (lambda xyz: xyz * [1.0, 1.1, 1.0], "follow"),
    "higher": (lambda xyz: xyz * [1.0, 1.0, 1.02], "stay"),
    "swollen amidships": (swell, "stay"),
    "lifted aft": (lift, "stay"),
    "bent sections": (rake, "stay"),
}


@pytest.mark.parametrize(("mapping", "planes"), MAPS.values(), ids=MAPS.keys())
def test_series60_keeps_what_must_hold(
    fresh_series60_70: ah.Hull, mapping: Map, planes: str
) -> None:
    """On a real net crossings lie on their curves, gaps keep their limits, nothing is missing.

    Every driver stays within 2 mm of its exact image.
    """
    hull = fresh_series60_70
    old = {
        line.name: sample(hull.state.spline(line.curves[0].row), 8)[1]
        for line in hull.groups["sections"].lines.values()
    }
    transformed(hull, mapping, MAIN, planes=planes)
    report = hull.history[-1]
    assert len(report.carried) == 45
    assert len(report.cut_again) == 32
    assert report.largest_gap <= 10e-3
    for name, places in old.items():
        curve = hull.groups["sections"].lines[name].curves[0]
        away = closest_points(curve.spline, 0, mapping(places))[2]
        assert away.max() <= 2e-3 + 1e-6


def test_contacts_come_with_the_flat(fresh_series60_70: ah.Hull) -> None:
    """A buttock that comes over the flat of bottom gets two tangent points, along the flat."""
    hull = fresh_series60_70
    assert "BTK 0.84 x flat of bottom" not in hull.crossings
    transformed(hull, lambda xyz: xyz * [1.0, 1.1, 1.0], MAIN)
    born = [key for key in hull.history[-1].born if "flat of bottom x buttocks:7.3152" in key]
    assert len(born) == 2
    rows = hull.state.rows
    for key in born:
        row = rows.key.data.index(key)
        assert rows.direction[row, 1].tolist() == [1.0, 0.0, 0.0]
        assert rows.xyz[row, 1:].tolist() == [
            hull.groups["buttocks"].lines["BTK 0.84"].position,
            0.0,
        ]


def hump(xyz: FloatArray) -> FloatArray:
    """Raise the bottom amidships by 0.9 m, fading upward and along the length."""
    x, y, z = xyz.T
    rise = 0.9 * np.exp(-(((x - 55.0) / 22.0) ** 2)) * np.exp(-((z / 4.0) ** 2))
    return np.column_stack([x, y, z + rise])


@pytest.mark.parametrize("name", ["WL 0.625", pytest.param("WL 0.075", marks=long_form)])
def test_a_line_falls_into_pieces(
    fresh_wigley: ah.Hull, fresh_series60_70: ah.Hull, name: str
) -> None:
    """A waterline that the keel rises above is cut anew: two pieces, one of them the old curve."""
    hull = fresh_wigley if name == "WL 0.625" else fresh_series60_70
    line = hull.lines[name]
    curve, crossings = line.curves[0].id, {point.id for point in line.curves[0].points}
    transformed(hull, hump, MAIN)
    pieces = hull.lines[name].curves
    assert len(pieces) == 2
    assert curve in [piece.id for piece in pieces]
    assert any(key.endswith("/2") for key in hull.history[-1].born)
    kept = {point.id for piece in pieces for point in piece.points} & crossings
    assert len(kept) > len(crossings) // 2


def test_a_line_comes_to_end_elsewhere(fresh_series60_70: ah.Hull) -> None:
    """A waterline that the tilted deck edge comes down to ends there."""
    hull = fresh_series60_70

    def tilt(xyz: FloatArray) -> FloatArray:
        return xyz + np.outer(0.015 * (xyz[:, 0] - 60.0), [0.0, 0.0, 1.0])

    assert "WL 1.41 x deck edge" not in hull.crossings
    transformed(hull, tilt, MAIN)
    assert "WL 1.41 x deck edge" in hull.crossings


def test_a_line_that_the_hull_leaves_is_named(wigley: ah.Hull) -> None:
    """A waterline above the deck is refused, with where the hull still is."""
    text = refused(
        wigley, lambda edit: edit.transform(scale=[1, 1, 0.6], drivers=MAIN), RefusedEditError
    )
    assert "of waterlines meets nothing" in text


def test_bent_drivers_become_space_curves(fresh_wigley: ah.Hull) -> None:
    """A section that leaves its plane has none any more; waterlines still end and cross on it."""
    hull = transformed(fresh_wigley, rake, MAIN)
    line = hull.groups["sections"].lines["ST 10"]
    assert line.plane is None
    assert any("curve in space" in note for note in hull.history[-1].notes)
    assert hull.points["WL 2.5 x ST 10"].free == ("x", "y")
    with hull.edit("goes on") as edit:
        edit.move("WL 2.5 x ST 10", x=50.2, y=3.2)
        edit.add_line("waterlines", 2.8)
    assert list(trouble(hull)) == []
    assert hull.verify() == ()


def test_waterlines_drive_sections(fresh_wigley: ah.Hull) -> None:
    """The rank is no matter: sections follow waterlines that are named as drivers."""
    hull = fresh_wigley
    transformed(hull, lambda xyz: xyz * [1.02, 1.0, 1.0], ["waterlines"])
    assert hull.lines["ST 10"].position == 50.0
    assert hull.half_breadth(50.0, 5.0) == pytest.approx(
        wigley_half_breadth(np.array([50.0]), np.array([5.0]), 102.0, 10.0, 6.25)[0], abs=5e-4
    )


class TestPlaced:
    """What the designer placed stays placed, and comes to where it belongs."""

    @staticmethod
    def hull_with_points() -> ah.Hull:
        hull = ah.examples.wigley()
        with hull.edit("place") as edit:
            edit.insert("WL 2.5", (52.5, 3.2, 2.5), lead=False)
            edit.insert("ST 10", (50.0, 2.69, 2.0), lead=False)
        return hull

    def test_in_a_plane_that_is_kept(self) -> None:
        """Placed points of drivers and followers are carried by the mapping, to the bit."""
        hull = transformed(self.hull_with_points(), lambda xyz: xyz * [1.0, 1.1, 1.0], MAIN)
        assert hull.points["WL 2.5 @ placed 1"].position.tolist() == [52.5, 3.2 * 1.1, 2.5]
        assert hull.points["ST 10 @ placed 1"].position.tolist() == [50.0, 2.69 * 1.1, 2.0]
        assert hull.points["WL 2.5 @ placed 1"].sort == "placed"

    def test_in_a_plane_that_slides(self) -> None:
        """A placed point comes to the follower's plane, as far off the hull as it was."""
        hull = self.hull_with_points()
        off = 3.2 - wigley_half_breadth(np.array([52.5]), np.array([2.5]), 100.0, 10.0, 6.25)[0]
        transformed(hull, lambda xyz: xyz * [1.0, 1.0, 1.05], MAIN)
        x, y, z = hull.points["WL 2.5 @ placed 1"].position.tolist()
        truth = wigley_half_breadth(np.array([x]), np.array([2.5]), 100.0, 10.0, 6.25 * 1.05)[0]
        assert z == 2.5
        assert y - truth == pytest.approx(off, abs=5e-3)
        assert hull.points["ST 10 @ placed 1"].position.tolist() == [50.0, 2.69, 2.0 * 1.05]


def test_ends_and_directions_turn_with_the_mapping(wigley: ah.Hull) -> None:
    """A given tangent keeps its slope on the carried curve, a given curvature its radius."""
    hull = small()
    with hull.edit("ends") as edit:
        edit.set_end("ST 5", "start", tangent=(0, 1, 1))
        edit.set_end("ST 6", "start", curvature=(0, 0, 0.04))
    hull = transformed(hull, lambda xyz: xyz * [1.0, 2.0, 1.0], groups(hull))
    ends = {
        name: hull.state.curves.ends[hull.lines[name].curves[0].row] for name in ("ST 5", "ST 6")
    }
    x, y, z = ends["ST 5"].vector[0]
    assert x == 0.0
    assert y / z == pytest.approx(2.0, rel=1e-9)
    assert ends["ST 6"].kind == (2, 0)
    assert ends["ST 6"].vector[0][0] == 0.0


def test_report_why_and_preview_tell(wigley: ah.Hull) -> None:
    """The report says what was carried and cut again; why names the edit; a preview keeps none."""
    before = wigley.fingerprint
    seen = wigley.preview(lambda edit: edit.transform(swell, MAIN))
    assert wigley.fingerprint == before
    assert seen.volume_change is not None
    assert seen.volume_change > 0.0
    with wigley.edit("swell") as edit:
        edit.transform(swell, MAIN)
    report = edit.report
    assert report is not None
    assert "boundary:profile" in report.carried
    assert "boundary:deck edge" in report.carried
    assert all(key.startswith("waterlines") for key in report.cut_again)
    assert report.largest is not None
    assert any("particulars stay" in note for note in report.notes)
    assert "lines carried" in str(report)
    told = str(wigley.why("WL 2.34375 x ST 6")) if "WL 2.34375 x ST 6" in wigley.points else ""
    told = told or str(wigley.why(next(iter(wigley.groups["waterlines"].lines))))
    assert "'swell'" in told
    assert "carried by the mapping" in told
    wigley.undo()
    assert wigley.fingerprint == before


def test_as_data(wigley: ah.Hull) -> None:
    """In a script factors and a shift stand for the mapping, and give the same bits."""
    change = {"op": "transform", "scale": [1.0, 1.05, 1.0], "shift": [0.5, 0.0, 0.0]}
    wigley.apply("data", [change | {"drivers": ["sections", "profile"]}])
    first = wigley.fingerprint
    wigley.undo()
    with wigley.edit("code") as edit:
        edit.transform(
            lambda xyz: xyz * [1.0, 1.05, 1.0] + [0.5, 0.0, 0.0],
            [wigley.groups["sections"], wigley.lines["profile"]],
        )
    assert wigley.fingerprint == first
    wigley.undo()


def _fails(xyz: FloatArray) -> FloatArray:
    raise ZeroDivisionError("no such place")


def _folded(xyz: FloatArray) -> FloatArray:
    return np.column_stack([xyz[:, 0] + 3.0 * np.sin(xyz[:, 0]), xyz[:, 1], xyz[:, 2]])


BAD: dict[str, tuple[object, object, type[AssocHullError], str]] = {
    "wrong shape": (lambda p: p[:, :2], MAIN, BadInputError, "gives an array"),
    "not a number": (lambda p: p * np.nan, MAIN, BadInputError, "finite"),
    "raises": (_fails, MAIN, BadInputError, "ZeroDivisionError: no such place"),
    "no array": (lambda p: "here", MAIN, BadInputError, "the mapping fails"),
    "mirror": (lambda p: p * [1, -1, 1], MAIN, BadInputError, "folds"),
    "folds": (_folded, MAIN, BadInputError, "folds"),
    "turned round": (lambda p: p * [-1, 1, 1], MAIN, BadInputError, "keep the order"),
    "off the centre plane": (lambda p: np.add(p, [0, 0.1, 0]), MAIN, BadInputError, "centre plane"),
    "unknown driver": (lambda p: 1.1 * p, ["nothing"], UnknownNameError, "nothing"),
    "no driver": (lambda p: 1.1 * p, [], BadInputError, "no driver"),
    "boundary curves alone": (lambda p: 1.1 * p, ["profile"], BadInputError, "no driver but"),
    "drivers no list": (lambda p: 1.1 * p, "sections", BadInputError, "give a list"),
    "one line of many": (lambda p: 1.1 * p, ["ST 5"], BadInputError, "no driver defines it"),
    "past its neighbour": (
        lambda p: np.add(p, [20, 0, 0]),
        ["ST 5", "waterlines"],
        BadInputError,
        "order",
    ),
    "no mapping": (None, MAIN, BadInputError, "neither"),
    "off its end": (lambda p: p * [1, 1, 0.5], MAIN, AssocHullError, ""),
}


@pytest.mark.parametrize(("mapping", "drivers", "error", "text"), BAD.values(), ids=BAD.keys())
def test_refusals_change_no_bit(
    wigley: ah.Hull, mapping: Map, drivers: list[str], error: type[AssocHullError], text: str
) -> None:
    """What cannot be carried is refused with its reason; the hull keeps every bit."""
    assert text in refused(wigley, lambda edit: edit.transform(mapping, drivers), error)


def test_bent_waterlines_are_refused_with_the_departure(wigley: ah.Hull) -> None:
    """A driver of higher rank cannot leave a plane that lower ranks keep: it says how far."""

    def trim(xyz: FloatArray) -> FloatArray:
        return xyz + np.column_stack([0.0 * xyz[:, 0], 0.0 * xyz[:, 0], 0.001 * xyz[:, 0]])

    text = refused(
        wigley, lambda edit: edit.transform(trim, ["sections", "waterlines"]), BadInputError
    )
    assert "0.1 m out of its plane" in text


_MOVE = {"op": "move", "point": "deck edge x ST 5", "y": 4.0}
_WIDE: dict[str, object] = {"op": "transform", "scale": [1, 1.1, 1], "drivers": ["sections"]}

OTHER: dict[str, Callable[[ah.Hull], object]] = {
    "beside a move": lambda hull: hull.apply("two", [_MOVE, _WIDE]),
    "before a move": lambda hull: hull.apply("two", [_WIDE, _MOVE]),
    "twice": lambda hull: hull.apply("two", [_WIDE, _WIDE]),
    "foreign group": lambda hull: hull.apply(
        "foreign",
        lambda edit: edit.transform(scale=[1, 2, 1], drivers=[small().groups["sections"]]),
    ),
    "two factors": lambda hull: hull.apply("two", [_WIDE | {"scale": [1, 2]}]),
    "no factor": lambda hull: hull.apply("no", [_WIDE | {"scale": "wide"}]),
    "two lengths": lambda hull: hull.apply("two", [_WIDE | {"shift": [1, 2]}]),
    "factor nil": lambda hull: hull.apply("nil", [_WIDE | {"scale": [1, 0, 1]}]),
    "planes unknown": lambda hull: hull.apply("planes", [_WIDE | {"planes": "go"}]),
}


@pytest.mark.parametrize("act", OTHER.values(), ids=OTHER.keys())
def test_other_refusals(wigley: ah.Hull, act: Callable[[ah.Hull], object]) -> None:
    """A transformation stands alone in its edit, on lines of its own hull."""
    before = wigley.fingerprint
    with pytest.raises((BadInputError, ForeignPointError)):
        act(wigley)
    assert wigley.fingerprint == before
    assert wigley.history == ()


def test_one_factor_is_that_of_all_axes() -> None:
    """As three equal ones; none is refused with both ways to say it."""
    prints = set()
    for scale in (2.0, [2.0, 2.0, 2.0]):
        hull = small()
        with hull.edit("twice as large") as edit:
            edit.transform(scale=scale, drivers=groups(hull))
        prints.add(hull.fingerprint)
    assert len(prints) == 1
    told = "scale is -1.0, in transform; give one factor above 0, or three along x, y and z"
    with pytest.raises(BadInputError, match=told), small().edit("no") as edit:
        edit.transform(scale=-1.0, drivers=["sections"])


def test_a_refused_update_changes_no_bit(fresh_series60_70: ah.Hull) -> None:
    """A buttock whose plane the narrower hull does not reach any more is named, with its place."""
    hull = fresh_series60_70
    narrower: Map = lambda xyz: xyz * [1.0, 0.9, 1.0]  # noqa: E731
    assert "8.01189 m of buttocks" in refused(
        hull, lambda e: e.transform(narrower, MAIN), RefusedEditError
    )


def test_jacobian_by_differences_agrees_with_the_given_one() -> None:
    """Central differences over 1 mm give derivatives to 1e-9, and exactly 1 where all is still."""
    xyz = np.random.default_rng(0).uniform(0.0, 100.0, (50, 3))
    bend = SpaceMap(lambda p: np.column_stack([p[:, 0] + 0.1 * np.sin(p[:, 2] / 9.0), p[:, 1:]]))
    found = bend.jacobians(xyz)
    truth = np.tile(np.eye(3), (50, 1, 1))
    truth[:, 0, 2] = 0.1 / 9.0 * np.cos(xyz[:, 2] / 9.0)
    assert np.abs(found - truth).max() < 1e-9
    assert (SpaceMap(lambda p: p).jacobians(xyz) == np.eye(3)).all()


def test_a_follower_that_the_hull_does_not_reach_any_more_goes_with_a_note() -> None:
    """A lower deck: the waterlines above it go in the same step, and undo brings them back."""
    hull = small()
    names = list(hull.lines)
    state = hull.state
    drivers = [
        line for line in state.live("lines").tolist()
        if state.lines.name[line].startswith(("ST", "profile"))
    ]  # fmt: skip
    with Transaction(hull.document, "lower") as edit:
        lower = SpaceMap(lambda xyz: xyz * [1.0, 1.0, 0.6])
        transform(edit, lower, drivers, lines_may_go=True)
    gone = [name for name in names if name not in hull.lines]
    assert gone
    assert all(name.startswith("WL") for name in gone)
    assert edit.report is not None
    for name in gone:
        assert any(note.startswith(f"{name} is gone") for note in edit.report.notes)
    assert hull.verify() == ()
    assert hull.check() == ()
    hull.undo()
    assert list(hull.lines) == names


def test_a_follower_is_its_image_where_the_map_keeps_its_plane(series60_70: ah.Hull) -> None:
    """Buttocks that bend at one end only: elsewhere they cross waterlines where their images do.

    These follow too, and are made through the same crossings.
    """
    with taken_back(series60_70) as hull:
        length = hull.particulars.length
        names = [line.name for line in hull.groups["buttocks"].lines.values()]
        before = {name: [c.spline for c in hull.lines[name].curves] for name in names}

        def lift_and_squeeze(xyz: FloatArray) -> FloatArray:
            """Lift all by 2 %, and draw the foremost part inward."""
            part = np.clip((xyz[:, 0] - 0.75 * length) / (0.25 * length), 0.0, 1.0) ** 3
            return np.column_stack([xyz[:, 0], xyz[:, 1] * (1.0 - 0.05 * part), 1.02 * xyz[:, 2]])

        with hull.edit("lift") as edit:
            edit.transform(lift_and_squeeze, MAIN)
        away = list[float]()
        for name in names:
            kept = np.array([
                point.position for point in hull.lines[name].points
                if " x WL" in str(point) and point.crossing_role == "shared"
                and point.position[0] < 0.7 * length
            ])  # fmt: skip
            if len(kept):
                feet = [
                    closest_points(each, 0, kept / [1.0, 1.0, 1.02])[2] for each in before[name]
                ]
                away += np.min(feet, axis=0).tolist()
        assert len(away) > 10
        assert max(away) < 1e-9

"""Features of a net: found at adoption, following edits, dissolved by those that bend them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit.followup.settle_features import find_features, followed_feature
from assoc_hull.edit.recut.transform import transform
from assoc_hull.edit.session import Edit
from assoc_hull.edit.space_map import carry_features, space_map
from assoc_hull.edit.transaction import Transaction
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.records import definition, published
from assoc_hull.model.definition.restore import from_definition
from assoc_hull.model.feature_geometry import host_curve, line_numbers, places_off, rounding_of
from assoc_hull.model.kinds import BoundaryKind, Sort
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.tables import copy_state
from tests.cases.test_box_with_bilges import round_box
from tests.long_forms import draws
from tests.taken_back import taken_back

Change = Callable[[Edit], object]


@pytest.fixture(scope="module")
def box() -> ah.Hull:
    """A box with circular bilges of 2 m; a test that edits it takes that back."""
    return round_box()


def names(hull: ah.Hull) -> set[str]:
    """The names of all features."""
    return set(hull.features)


def edited(hull: ah.Hull, change: Change) -> tuple[set[str], str]:
    """Which features an edit dissolved, and all notes of its report."""
    before = names(hull)
    with hull.edit("change") as edit:
        change(edit)
    return before - names(hull), " ".join(hull.history[-1].notes)


def all_on(hull: ah.Hull) -> bool:
    """Whether all owned points lie on their features, and in order on one line."""
    xyz = hull.state.rows.xyz.data
    return all(
        places_off(each, xyz[list(each.points)]).max() <= each.gap + rounding_of(hull.state)
        for each in hull.state.features
    )


@settings(max_examples=draws(8), deadline=None)
@given(radius=st.floats(0.5, 4.0))
def test_a_bilge_circle_is_found_with_its_centre_and_radius(radius: float) -> None:
    """Between its two tangent points; bottom and side beside it are straight runs."""
    hull = round_box(radius)
    for x in (25.0, 50.0, 75.0):
        name = f"ST {x / 25.0:g}"
        arc = hull.features[f"{name} arc"]
        assert arc.kind == "arc"
        assert np.allclose(arc.parameters["centre"], (x, 10.0 - radius, radius), atol=1e-6)
        assert arc.parameters["radius"] == pytest.approx(radius, abs=1e-6)
        assert (len(arc.points), arc.side) == (25, 1)
        assert hull.features[f"{name} straight"].points[-1].position.tolist() == (
            arc.points[0].position.tolist()
        )
        assert [line.name for line in arc.lines] == [name]
    assert all_on(hull)


def test_the_carrier_has_the_features_it_was_drawn_with(bulk_carrier: ah.Hull) -> None:
    """Circles of the bossing, bilge arcs, flats, straight runs; also on lines cut later."""
    found = bulk_carrier.features
    circles = {name: each for name, each in found.items() if each.kind == "circle"}
    assert {name: each.parameters["centre"] for name, each in circles.items()} == {
        "bossing end": (6.0, 0.0, 5.0), "ST 0.45 circle": (6.75, 0.0, 5.0),
        "ST 0.5 circle": (7.5, 0.0, 5.0),
    }  # fmt: skip
    assert {each.parameters["radius"] for each in circles.values()} == {0.725}
    arcs = [each for each in found.values() if each.kind == "arc"]
    assert [each.name for each in arcs] == ["ST 8 arc", "ST 10 arc", "ST 12 arc"]
    assert {each.parameters["radius"] for each in arcs} == {2.4}
    side, bottom = found["flat of side"], found["flat of bottom"]
    assert dict(side.parameters) == {"normal": (0.0, 1.0, 0.0), "offset": 25.0}
    assert dict(bottom.parameters) == {"normal": (0.0, 0.0, 1.0), "offset": 0.0}
    assert (side.side, bottom.side) == (-1, -1)
    assert {"BTK 6 straight", "WL 5 straight", "ST 10 straight 2"} <= set(found)
    assert max(each.gap for each in found.values()) < 1e-6
    assert all_on(bulk_carrier)


def test_no_arc_is_made_of_points_that_happen_to_lie_on_one(bulk_carrier: ah.Hull) -> None:
    """The aperture's corner is within 0.8 mm of a circle, and no tangent says that it is one."""
    assert not any("profile" in each.name for each in bulk_carrier.features.values()
                   if each.kind in ("arc", "circle"))  # fmt: skip
    assert find_features(bulk_carrier.state, lines=["no such line"]) == []


@pytest.mark.parametrize(
    ("change", "gone"),
    [
        (lambda edit: edit.move("ST 2 @ placed 9", y=9.02, z=0.27), {"ST 2 arc"}),
        (lambda edit: edit.move("ST 2 @ placed 1", y=7.9, z=0.0), {"ST 2 arc", "ST 2 straight"}),
        (lambda edit: edit.insert("ST 2", (50.0, 10.0, 7.0)), {"ST 2 straight 2"}),
        (lambda edit: edit.delete("ST 2 @ placed 9"), {"ST 2 arc"}),
        (lambda edit: edit.set_kind("ST 2 @ placed 9", "knuckle"), {"ST 2 arc"}),
        (lambda edit: edit.set_end("ST 2", "start", tangent=(0, 1, 0)), {"ST 2 straight"}),
    ],
)
def test_a_point_set_by_hand_dissolves_its_feature(
    box: ah.Hull, change: Change, gone: set[str]
) -> None:
    """And no other; a note tells, undo brings it back."""
    with taken_back(box):
        found, notes = edited(box, change)
        assert found == gone
        assert all(f"the feature {name!r} is dissolved" in notes for name in gone)
        assert notes.count("set by hand") == len(gone)
        assert (box.check(), box.verify()) == ((), ())


def test_an_edit_of_other_points_leaves_features_alone(bulk_carrier: ah.Hull) -> None:
    """Of a crossing off all of them; of the other line of a shared one."""
    with taken_back(bulk_carrier):
        y = bulk_carrier.find("WL 12 x ST 3").y + 0.001  # type: ignore[union-attr]
        assert edited(bulk_carrier, lambda edit: edit.move("WL 12 x ST 3", y=y)) == (set(), "")


def test_a_field_that_bends_features_dissolves_them(bulk_carrier: ah.Hull) -> None:
    """They are told in one note; a field elsewhere does nothing to any."""
    with taken_back(bulk_carrier):
        gone, notes = edited(bulk_carrier, lambda edit: edit.pull("WL 1 x ST 10", d=0.02))
        assert "ST 10 arc" in gone
        assert "features dissolved, as their points are bent off them: " in notes
        assert all_on(bulk_carrier)
        gone, notes = edited(bulk_carrier, lambda edit: edit.pull("WL 12 x ST 3", d=0.02))
        assert gone == set()


def test_a_new_line_has_its_features_and_gives_others_points(bulk_carrier: ah.Hull) -> None:
    """As if it had been adopted; a line that goes takes its own along, and no others."""
    with taken_back(bulk_carrier):
        count = len(bulk_carrier.features["flat of side"].points)
        edited(bulk_carrier, lambda edit: edit.add_line("sections", 160.0))
        arc = bulk_carrier.features["ST 10.667 arc"]
        assert arc.parameters["radius"] == pytest.approx(2.4, abs=2e-6)
        assert len(bulk_carrier.features["flat of side"].points) == count + 1
        gone, notes = edited(bulk_carrier, lambda edit: edit.remove_line("ST 10.667"))
        assert gone == {"ST 10.667 arc", "ST 10.667 straight", "ST 10.667 straight 2"}
        assert "feature" not in notes
        assert all_on(bulk_carrier)


def test_a_shifted_line_keeps_its_features_where_they_still_are(bulk_carrier: ah.Hull) -> None:
    """In the parallel body a bilge arc goes along, under its old key; abaft it is none any more."""
    with taken_back(bulk_carrier):
        key = bulk_carrier.features["ST 10 arc"].id
        assert edited(bulk_carrier, lambda edit: edit.shift_line("ST 10", 155.0))[0] == set()
        arc = bulk_carrier.features["ST 10 arc"]
        assert arc.id == key
        assert arc.parameters["centre"] == pytest.approx((155.0, 22.6, 2.4), abs=1e-12)
        gone, notes = edited(bulk_carrier, lambda edit: edit.shift_line("ST 10", 250.0))
        assert gone == {"ST 10 arc"}
        assert "'ST 10 arc'" in notes


def test_a_border_that_goes_leaves_the_runs_that_ended_on_it(bulk_carrier: ah.Hull) -> None:
    """An adopted point stands where their end was, and is that end now."""
    with taken_back(bulk_carrier):
        gone, _ = edited(bulk_carrier, lambda edit: edit.remove_line("flat of side"))
        assert gone == {"flat of side"}
        assert all_on(bulk_carrier)


def test_a_similarity_carries_features(box: ah.Hull) -> None:
    """Their numbers are the image's; stretched across, arcs go and straight runs stay."""
    with taken_back(box):
        gone, _ = edited(box, lambda edit: edit.transform(scale=[1.5] * 3, drivers=["sections"]))
        assert gone == set()
        arc = box.features["ST 2 arc"]
        assert arc.parameters["centre"] == pytest.approx((75.0, 12.0, 3.0), abs=1e-9)
        assert arc.parameters["radius"] == pytest.approx(3.0, abs=1e-9)
        gone, notes = edited(
            box, lambda edit: edit.transform(scale=[1.0, 1.1, 1.0], drivers=["sections"])
        )
        assert gone == {"ST 1 arc", "ST 2 arc", "ST 3 arc", "aft end arc", "fore end arc"}
        assert "bent off them" in notes


def test_whoever_makes_features_anew_keeps_them_through_a_mapping(box: ah.Hull) -> None:
    """Then a check tells what is off, until features take their place through the journal."""
    with taken_back(box):
        with Transaction(box.document, "map") as edit:
            lines = [line.number for line in box.groups["sections"].lines.values()]
            stretch = space_map(None, None, [1.0, 1.1, 1.0], None)
            transform(edit, stretch, lines, keep_features=True)
        assert "ST 2 arc" in names(box)
        told = [each for each in box.check() if each.kind == "feature"]
        assert len(told) == 5
        assert "make the feature anew" in told[0].message
        with Transaction(box.document, "anew") as edit:
            edit.maker.features(find_features(box.state))
        assert box.check() == ()
        assert "ST 2 arc" not in names(box)


def test_a_feature_made_anew_takes_the_place_of_the_carried_one(box: ah.Hull) -> None:
    """And is not taken for bent any more: its points will be put on it."""
    carried = carry_features(box.state, space_map(None, None, [1.0, 1.1, 1.0], None), 1e-3)
    arc = next(each for each in carried.features if each.name == "ST 2 arc")
    assert carried.bent == {each.key for each in box.state.features if each.kind == "arc"}
    again = carried.anew([attrs.evolve(arc, radius=3.0)])
    assert carried.bent - again.bent == {arc.key}
    assert [each.radius for each in again.features if each.key == arc.key] == [3.0]
    assert len(again.features) == len(carried.features)


def test_features_are_named_after_their_lines(box: ah.Hull) -> None:
    """Also after a line is renamed; the key stays."""
    with taken_back(box):
        key = box.features["ST 2 arc"].id
        edited(box, lambda edit: edit.rename("ST 2", "midship"))
        assert box.features["midship arc"].id == key
        assert {"midship straight", "midship straight 2"} <= names(box)
        with pytest.raises(ah.errors.UnknownNameError, match="ST 2 arc"):
            box.features["ST 2 arc"]


def test_knuckle_lines_and_joins_are_features() -> None:
    """A line that turns at a boundary curve; a tangent point that ends no straight run."""
    x = np.linspace(0.0, 60.0, 7)
    chine = np.column_stack([x, np.full(7, 5.0), 2.0 + 0.01 * x])
    lines = [LineSource.make("boundary", "chine", chine, boundary=BoundaryKind.KNUCKLE)]
    for i, place in enumerate(x[1:-1].tolist()):
        z = 2.0 + 0.01 * place
        points = [[place, 0, 0], [place, 2, 0.1], [place, 5, z], [place, 5.5, z + 1], [place, 6, 9]]
        lines.append(
            LineSource.make(
                "sections", f"ST {i}", points, kind=[0, 1, 2, 0, 0], direction=[[0, 1, 0]] * 5
            )
        )
    hull = ah.Hull.from_lines(
        lines, particulars=ah.Particulars("S", 60.0, 12.0, 9.0, 5.0),
        associations=[ah.Association("boundary", "sections")],
    )  # fmt: skip
    knuckle = hull.features["chine"]
    assert (knuckle.kind, knuckle.lines) == ("knuckle", (hull.lines["chine"],))
    assert [point.id for point in knuckle.points] == [
        point.id for point in hull.lines["chine"].points
    ]
    join = hull.features["ST 2 tangent"]
    assert (join.parameters["direction"], len(join.points)) == ((0.0, 1.0, 0.0), 1)
    assert edited(hull, lambda edit: edit.set_kind("ST 2 @ adopted 2", "smooth"))[0] == (
        {"ST 2 tangent"}
    )


def test_features_are_kept_in_files_and_in_definitions(box: ah.Hull, tmp_path: Path) -> None:
    """Rebuilt from the definition, read from the text and from the hull file: the same bits."""
    with taken_back(box):
        edited(box, lambda edit: edit.move("ST 2 @ placed 9", y=9.02, z=0.27))
        state = box.state
        assert fingerprint(from_definition(definition(state))) == box.fingerprint
        again = from_definition(definition(state), published(state))
        assert [each.name for each in again.features] == [each.name for each in state.features]
        box.save(tmp_path / "box.hull.json")
        assert ah.open(tmp_path / "box.hull.json").fingerprint == box.fingerprint
        box.save(tmp_path / "box.hull")
        box.detach()
        filed = ah.open(tmp_path / "box.hull")
        assert filed.fingerprint == box.fingerprint
        filed.undo()
        assert "ST 2 arc" in names(filed)
        filed.close()


def test_a_point_off_its_feature_is_a_finding() -> None:
    """A file that other hands wrote may hold one."""
    hull = round_box()
    row = hull.features["ST 2 arc"].points[12].number
    place = hull.state.rows.xyz[row] * [1.0, 1.0, 1.1]
    Journal().put(hull.document.state.rows.xyz, [row], place[None])
    told = [each for each in hull.check() if each.kind == "feature"]
    assert [each.object for each in told] == ["ST 2 @ placed 13"]
    assert told[0].amount == pytest.approx(places_off(
        hull.features["ST 2 arc"].feature, place[None])[0])  # fmt: skip


def test_a_point_that_took_the_place_of_an_end_is_the_end_now(box: ah.Hull) -> None:
    """Where the end was, or where a mapping sent it; anywhere else the end is lost."""
    state = copy_state(box.state)
    arc = next(each for each in state.features if each.name == "ST 2 arc")
    end, numbers = arc.points[0], line_numbers(state)
    curve = host_curve(state, arc)
    rows = state.curves.rows[curve]
    maker = Maker(state, Journal())
    place = state.rows.xyz[end] + [0.0, 0.5, 0.0]
    new = int(maker.points([PointSpec(curve, place, Sort.ADOPTED)])[0])
    maker.define(curve, np.where(rows == end, new, rows))
    maker.remove_rows([end])
    assert followed_feature(state, arc, numbers) is None
    found = followed_feature(state, arc, numbers, {end: place})
    assert found is not None
    assert found.points == (new, *arc.points[1:])


def test_a_feature_that_a_pull_bends_by_little_is_drawn_anew(bulk_carrier: ah.Hull) -> None:
    """Circle and straight run, on the ends that the pull gave them, in its one step of history."""
    first, steps = bulk_carrier.fingerprint, len(bulk_carrier.history)
    with taken_back(bulk_carrier):
        gone, notes = edited(
            bulk_carrier, lambda edit: edit.pull("WL 8 x ST 1", d=0.003, radius=(15.0, 8.0))
        )
        assert "features drawn anew, as their points lay up to " in notes
        assert "'ST 0.5 circle'" in notes
        assert not gone & {"ST 0.5 circle", "BTK 0.5 straight"}
        circle = bulk_carrier.features["ST 0.5 circle"]
        assert circle.gap < 2e-9
        assert len(bulk_carrier.history) == steps + 1
        assert all_on(bulk_carrier)
        assert (bulk_carrier.check(), bulk_carrier.verify()) == ((), ())
    assert bulk_carrier.fingerprint == first


@pytest.mark.parametrize("d", [0.002, -0.01])
def test_an_arc_whose_ends_a_pull_has_moved_gets_another_radius(d: float) -> None:
    """Its points lie on the circle through these ends; the report tells the radius."""
    hull = round_box(placed=False)
    first, end = hull.fingerprint, hull.features["ST 2 arc"].points[-1]
    with hull.edit("rounder") as edit:
        edit.pull(end, d=d, radius=(30.0, 15.0), across_flats=True)
    arc = hull.features["ST 2 arc"]
    xyz = np.array([each.position for each in arc.points])
    away = np.sqrt(((xyz - arc.parameters["centre"]) ** 2).sum(axis=1))
    assert np.abs(away - arc.parameters["radius"]).max() < 2e-9
    assert arc.parameters["radius"] != 2.0
    assert "the radius of 'ST 2 arc' is " in " ".join(hull.history[-1].notes)
    assert (hull.check(), hull.verify()) == ((), ())
    hull.undo()
    assert hull.fingerprint == first
    assert hull.features["ST 2 arc"].parameters["radius"] == 2.0


def test_what_an_edit_bends_on_purpose_is_not_put_back(bulk_carrier: ah.Hull) -> None:
    """The pulled point stays, and the feature that it is of is dissolved."""
    with taken_back(bulk_carrier):
        y = bulk_carrier.find("WL 2 x ST 10").y  # type: ignore[union-attr]
        gone, _ = edited(bulk_carrier, lambda edit: edit.pull("WL 2 x ST 10", d=-0.005))
        assert {"ST 10 arc", "WL 2 straight"} <= gone
        after = bulk_carrier.find("WL 2 x ST 10").y  # type: ignore[union-attr]
        assert y - after > 0.0049

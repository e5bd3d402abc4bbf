"""Features as data: what they hold, where they are kept, what is refused."""

import json
from pathlib import Path
from typing import Any

import attrs
import pytest

import assoc_hull as ah
from assoc_hull.edit.transaction import Transaction
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.records import definition
from assoc_hull.model.definition.restore import from_definition
from assoc_hull.model.features import Feature
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import HullState, copy_state
from assoc_hull.shipped.wigley import wigley


def small() -> HullState:
    """A small hull, its features taken away."""
    return give(wigley(stations=5, waterlines=4))


def on_line(state: HullState, place: int, kind: str = "straight", **more: Any) -> Feature:
    """A feature of the first points of some line."""
    line = str(state.lines.key[place])
    rows = state.curves.rows[state.lines.curves[place][0]][:3]
    return Feature(f"{line} {kind}", kind, f"{kind} {place}", [line], rows.tolist(), **more)


def give(state: HullState, *features: Feature) -> HullState:
    """Give a hull features."""
    Maker(state, Journal()).features(features)
    return state


def circle(state: HullState) -> Feature:
    """A circle, as far as its numbers go."""
    return on_line(
        state, 2, "circle", centre=(1.0, -0.0, 0.1), radius=0.7, normal=(1, 0, 0), side=-1, gap=1e-7
    )


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"kind": "square"}, "square"),
        ({"radius": 2.0}, "radius"),
        ({"points": ()}, "0 points"),
        ({"lines": ()}, "no line"),
        ({"side": 2}, "side"),
        ({"gap": -1.0}, "gap"),
        ({"name": ""}, "name"),
        ({"kind": "circle"}, "centre"),
    ],
)
def test_a_feature_that_contradicts_itself_is_refused(change: dict[str, Any], told: str) -> None:
    """With the argument that is wrong."""
    good = on_line(small(), 2)
    with pytest.raises(ah.errors.BadInputError, match=told):
        attrs.evolve(good, **change)


def test_features_come_in_the_order_of_their_keys() -> None:
    """Not in that in which they were made; the fingerprint does not know that order either."""
    state, other = small(), small()
    found = [on_line(state, place) for place in (4, 2, 3)]
    give(state, *found)
    give(other, found[1])
    give(other, found[1], found[2])
    give(other, *found)
    assert [each.key for each in state.features] == sorted(each.key for each in found)
    assert fingerprint(other) == fingerprint(state)


def test_a_hull_without_features_has_the_fingerprint_it_always_had() -> None:
    """Also when it had one that went."""
    state = small()
    before = fingerprint(state)
    assert "features" not in definition(state)
    give(state, circle(state))
    assert fingerprint(state) != before
    assert fingerprint(copy_state(state)) == fingerprint(state)
    give(state)
    assert fingerprint(state) == before


@pytest.mark.parametrize(
    "change", [{"name": "b"}, {"radius": 0.8}, {"side": 1}, {"gap": 0.0}, {"centre": (1, 0, 0.2)}]
)
def test_the_fingerprint_tells_every_part_of_a_feature(change: dict[str, Any]) -> None:
    """Name, numbers, side and gap."""
    state, other = small(), small()
    give(state, circle(state))
    give(other, attrs.evolve(circle(other), **change))
    assert fingerprint(state) != fingerprint(other)


def test_a_definition_gives_the_features_back() -> None:
    """Through text, too; row numbers may differ."""
    state = small()
    give(state, circle(state), on_line(state, 3), on_line(state, 4, "tangent", direction=(0, 0, 1)))
    again = from_definition(json.loads(json.dumps(definition(state))))
    assert fingerprint(again) == fingerprint(state)
    assert [each.name for each in again.features] == [each.name for each in state.features]


def test_an_edit_of_features_is_undone_redone_and_kept(tmp_path: Path) -> None:
    """In the hull file as well, where it lies behind later edits; and in the text."""
    hull = ah.Hull(small())
    hull.save(tmp_path / "a.hull")
    state = hull.state
    prints = [hull.fingerprint]
    for features in ((circle(state),), (on_line(state, 3),)):
        with Transaction(hull.document, "features") as edit:
            edit.maker.features(features)
        prints.append(hull.fingerprint)
    hull.save(tmp_path / "a.hull.json")
    assert ah.open(tmp_path / "a.hull.json").fingerprint == prints[2]
    hull.undo()
    assert hull.fingerprint == prints[1]
    hull.close()
    again = ah.open(tmp_path / "a.hull")
    assert again.fingerprint == prints[1]
    again.undo()
    assert again.fingerprint == prints[0]
    again.redo(2)
    assert again.fingerprint == prints[2]
    assert again.state.features == (on_line(state, 3),)
    again.close()


def test_features_that_are_there_already_are_no_edit() -> None:
    """Nothing is written for what stays as it is."""
    hull = ah.Hull(give(small(), on_line(small(), 3)))
    with Transaction(hull.document, "same") as edit:
        edit.maker.features(hull.state.features)
    assert len(hull.history) == 0


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"points": ["nowhere"]}, "no point"),
        ({"lines": ["nowhere"]}, "no line"),
        ({"radius": 3.0}, "radius"),
    ],
)
def test_a_feature_that_leads_nowhere_is_refused(change: dict[str, Any], told: str) -> None:
    """When a hull is made of its definition."""
    state = small()
    found = json.loads(json.dumps(definition(give(state, on_line(state, 3)))))
    found["features"][0] |= change
    with pytest.raises(ah.errors.BadInputError, match=told):
        from_definition(found)


def test_two_features_of_one_key_are_refused() -> None:
    """One of them would hide the other."""
    state = small()
    found = json.loads(json.dumps(definition(give(state, on_line(state, 3)))))
    found["features"] *= 2
    with pytest.raises(ah.errors.BadInputError, match="twice"):
        from_definition(found)

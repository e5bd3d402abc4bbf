"""Definitions and generated curves in the tables, the definition, the fingerprint and the files."""

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.io.hull_file.check import require_sound_tables
from assoc_hull.io.hull_json import dumps_hull_json, read_hull_json
from assoc_hull.model import index
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.records import definition, published
from assoc_hull.model.definition.restore import from_definition
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.generated_curves import (
    attached_curves,
    attached_rows,
    points_given,
)
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState, copy_state
from tests.formed import STATIONS, formed, formed_definitions


@pytest.fixture(scope="module")
def made() -> HullState:
    """Give the net, made once."""
    return formed()


@pytest.fixture
def hull(made: HullState) -> ah.Hull:
    """Give a hull of its own for each test."""
    return ah.Hull(copy_state(made))


def test_a_hull_tells_its_definitions(hull: ah.Hull) -> None:
    """By name, with their values; a name that is none names the nearest."""
    assert {each.key for each in hull.definitions.values()} == {
        each.key for each in formed_definitions()
    }
    assert hull.definitions["areas"].value("run_area") == 0.511
    with pytest.raises(ah.errors.UnknownNameError, match="'areas'"):
        hull.definitions["area"]


def test_generated_points_hold_no_values_in_a_definition(made: HullState) -> None:
    """They are derived; those of a detached curve are the designer's own."""
    record: Any = definition(made)
    by_key = {each["key"]: each for each in record["points"]}
    keys = [made.rows.key[row] for row in attached_rows(made).tolist()]
    assert len(keys) > 100
    assert not any("value" in by_key[key] for key in keys)
    values: Any = published(made)
    assert all("value" in values["points"][key] for key in keys)


def test_the_table_of_attached_curves(made: HullState) -> None:
    """By number of the curve; others are not known."""
    known = attached_curves(made)
    assert len(known) == len(STATIONS) + 1
    assert any(each.what == "section" for each in known.values())
    assert 10**6 not in known


def test_nodes_of_definitions_lie_below_nil() -> None:
    """And lead back to the number."""
    numbers = np.arange(5)
    nodes = Node.form(numbers)
    assert Node.is_form(nodes).all()
    assert not (Node.is_point(nodes) | Node.is_curve(nodes)).any()
    assert Node.form_number(nodes).tolist() == numbers.tolist()


def test_canonical_text_and_hull_file_give_it_back(hull: ah.Hull, tmp_path: Path) -> None:
    """With history, undo across the file, detached lines, and the script of a step."""
    start = hull.fingerprint
    hull.save(tmp_path / "a.hull")
    hull.apply("fuller", [{"op": "set_form", "definition": "areas", "run_area": 0.512}])
    with hull.edit("level") as edit:
        edit.set_form("rise", aft_y=60.0)
        edit.shift_line("ST 65", 66.0)
    end = hull.fingerprint
    text = dumps_hull_json(hull.state)
    assert dumps_hull_json(read_hull_json(text)) == text
    hull.close()
    again = ah.open(tmp_path / "a.hull")
    assert again.fingerprint == end
    assert again.history[0].definitions == (("areas", "run_area", 0.511, 0.512),)
    assert again.verify() == ()
    assert "aft_y 89 -> 60" in str(again.why("WL 3"))
    again.undo(2)
    assert again.fingerprint == start
    again.redo(2)
    assert again.fingerprint == end
    assert again.state.definitions == read_hull_json(text).definitions
    again.close()


def test_edits_are_made_again_on_another_hull(hull: ah.Hull, made: HullState) -> None:
    """Step by step, with the same bits."""
    with hull.edit("fuller") as edit:
        edit.set_form(hull.definitions["areas"], run_area=0.512)
        edit.delete("ST 35 @ adopted 5")
    with hull.edit("back") as edit:
        edit.reattach("ST 35")
    other = ah.Hull(copy_state(made))
    assert all(each.report for each in other.replay(hull))
    assert other.fingerprint == hull.fingerprint


def test_hulls_without_definitions_keep_their_fingerprint() -> None:
    """Nothing of definitions stands in what is hashed of them."""
    hull = ah.examples.wigley(stations=5, waterlines=4)
    assert "definitions" not in definition(hull.state)
    assert hull.state.definitions == ()
    assert hull.state.generated == ()
    with pytest.raises(ah.errors.BadInputError, match="no definitions"):
        hull.apply("back", [{"op": "reattach", "line": "ST 1"}])


def test_a_dependency_that_is_left_out_is_found(
    hull: ah.Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Were the graph to forget what reads a definition, or an end, verify would tell."""
    generating = index._generating
    for part, act in enumerate((
        {"op": "set_form", "definition": "sheer", "FP_y": 10.2},
        {"op": "set_form", "definition": "areas", "run_area": 0.512},
    )):  # fmt: skip

        def forgets(state: HullState, part: int = part) -> Any:
            ends, forms = generating(state)
            return (({}, forms), (ends, {}))[part]

        monkeypatch.setattr(index, "_generating", forgets)
        hull.document.refresh()
        hull.apply("changed", [act])
        assert hull.verify() != ()
        monkeypatch.undo()
        hull.document.refresh()
        hull.undo()
        assert hull.verify() == ()


BROKEN: dict[str, Any] = {
    "no such use": lambda r: r["definitions"][0].update(use="nothing"),
    "another kind": lambda r: r["definitions"][0].update(kind="halves"),
    "an unknown value": lambda r: r["definitions"][0]["values"].update(nothing=1.0),
    "a use twice": lambda r: r["definitions"].append(r["definitions"][0]),
    "no such curve": lambda r: r["generated"][0].update(curve="nothing"),
    "no such point": lambda r: r["generated"][0].update(points=["nothing"]),
    "a mark too few": lambda r: r["generated"][0]["marks"].pop(),
    "half a piece": lambda r: r["generated"][0]["marks"].__setitem__(0, [0.5, 0.0]),
    "another order": lambda r: r["generated"][0]["points"].reverse(),
    "nothing of the sort": lambda r: r["generated"][0].update(what="nothing"),
    "a piece beyond": lambda r: r["generated"][-1]["marks"].__setitem__(0, [9.0, 0.0]),
}


@pytest.mark.parametrize("name", BROKEN)
def test_definitions_that_contradict_themselves_are_refused(made: HullState, name: str) -> None:
    """In one line that says what is wrong."""
    record: Any = definition(made)
    BROKEN[name](record)
    with pytest.raises(ah.AssocHullError):
        from_definition(record)


def test_values_are_none_or_numbers_in_every_form(made: HullState) -> None:
    """A value that is None comes back so from text."""
    again = read_hull_json(dumps_hull_json(made))
    found = {each.use: each for each in again.definitions}
    assert isinstance(found["design_waterline"], FormDefinition)
    assert found["design_waterline"].value("run_area") is None


def test_a_hull_with_definitions_goes_through_a_pipe(made: HullState) -> None:
    """Studies hand tables to other processes; what is kept with them goes along."""
    points_given(made, made.generated)
    again = pickle.loads(pickle.dumps(made))
    assert again.definitions == made.definitions
    assert fingerprint(copy.deepcopy(again)) == fingerprint(made)
    points_given(again, again.generated)


def test_a_generated_curve_that_is_not_there_is_found(hull: ah.Hull) -> None:
    """By check and by who opens a file, if other hands have written it."""
    table = hull.document.state.produced
    table.curve.store[1] = table.curve[1].evolve(curve=10**6, attached=False)
    assert "tables" in {each.kind for each in hull.check()}
    with pytest.raises(ValueError, match="does not exist"):
        require_sound_tables(hull.document.state)

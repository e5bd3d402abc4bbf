"""What the parts of `model.definition` give, one small example of each."""

from __future__ import annotations

from numpy.testing import assert_array_equal

from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.fill_tables import (
    ObjectNumbers,
    make_tables,
    meet_order,
    put_features,
    put_forms,
    put_points,
)
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.records import definition, definition_records, generated_records
from assoc_hull.model.definition.restore import from_definition, spline_of
from assoc_hull.model.tables import HullState, Particulars
from assoc_hull.shipped.wigley import wigley


def test_definitions_and_generated_curves_in_the_definition() -> None:
    """Definitions and generated curves in the definition of a hull, and in its fingerprint."""
    state = wigley(stations=5, waterlines=4)
    assert (list(definition_records(state)), list(generated_records(state))) == ([], [])


def test_the_definition_of_a_hull_its_published_values() -> None:
    """The definition of a hull, its published values, and the fingerprint of both."""
    state = HullState(Particulars("Ship", 100.0, 20.0, 10.0, 8.0))
    ship = definition(state)["particulars"]
    assert isinstance(ship, dict)
    assert ship["length"] == 100.0
    assert fingerprint(state) == fingerprint(HullState(Particulars("Ship", 100.0, 20.0, 10.0, 8.0)))


def test_adding_live_rows_to_the_tables_of_a_hull() -> None:
    """Adding live rows to the tables of a hull, and looking up numbers by key."""
    assert (
        ObjectNumbers({"sections": 0}, {}, {}, {}).find("groups", "sections", "an association") == 0
    )


def test_from_a_definition_to_the_features_of_a_hull() -> None:
    """From a definition to the features of a hull, every reference checked."""
    state = HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))
    put_features(state, Journal(), [], ObjectNumbers({}, {}, {}, {}))
    assert state.features == ()


def test_from_a_definition_to_the_form_definitions() -> None:
    """From a definition to the form definitions of a hull and its generated curves, all
    checked."""
    state = HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))
    put_forms(state, Journal(), {}, ObjectNumbers({}, {}, {}, {}))
    assert (state.definitions, state.generated) == ((), ())


def test_the_points_of_a_hull_from_a_definition_places() -> None:
    """The points of a hull from a definition: places, kinds, roles, riding links, curve
    orders."""
    state = HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))
    point = {"key": "p", "sort": "placed", "curves": ["c"], "value": [1.0, 2.0, 3.0]}
    put_points(state, Journal(), [point], ObjectNumbers({}, {}, {"c": 0}, {"p": 0}))
    assert_array_equal(state.rows.xyz.data, [[1.0, 2.0, 3.0]])


def test_meetings_by_the_keys_of_lines_and_crossings() -> None:
    """Meetings by the keys of lines and crossings, and back into the order the update keeps."""
    assert meet_order(HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))) == {}


def test_from_a_definition_to_the_tables_of_a_hull() -> None:
    """From a definition to the tables of a hull, every reference checked; nothing is computed."""
    assert (
        make_tables(definition(HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0)))).particulars.name
        == "S"
    )


def test_published_values_put_back_as_they_are_stored_splines() -> None:
    """Published values put back as they are stored: splines, places of points, gaps."""
    assert_array_equal(
        spline_of(
            {"knot": [0, 1], "leave": [[1, 0, 0]] * 2, "arrive": [[1, 0, 0]] * 2},
            [[0, 0, 0], [1, 0, 0]],
            "c",
        ).knot,
        [0.0, 1.0],
    )


def test_from_a_definition_back_to_a_hull() -> None:
    """From a definition back to a hull."""
    hull = HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))
    assert fingerprint(from_definition(definition(hull))) == fingerprint(hull)

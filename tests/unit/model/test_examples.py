"""What the parts of `model` give, one small example of each."""

from __future__ import annotations

import networkx
import numpy as np

from assoc_hull.model.change import crossing_positions, put_crossing_positions
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.form_definition import USES, FormDefinition
from assoc_hull.model.generated_curves import attached_curves, attached_rows
from assoc_hull.model.object_graph import add_definitions
from assoc_hull.model.objects import Point, features_by_name, handle
from assoc_hull.model.tables import copy_state
from assoc_hull.shipped.wigley import wigley


def test_where_crossings_lie_on_curves_many_curves_in_one() -> None:
    """Where crossings lie on curves, many curves in one batch: taken out, and put back."""
    state = wigley()
    found = crossing_positions(state, np.arange(state.curves.count))
    put_crossing_positions(state, found)
    assert crossing_positions(state, found.curve).same_bits(found)


def test_a_copy_of_a_hulls_tables_which_can_be() -> None:
    """A copy of a hull's tables, which can be changed without the hull."""
    state = wigley()
    assert fingerprint(copy_state(state)) == fingerprint(state)


def test_features_as_a_designer_sees_them_name_kind_numbers() -> None:
    """Features as a designer sees them: name, kind, numbers, and the points and lines as
    handles."""
    assert (
        repr(features_by_name(wigley(stations=5, waterlines=4))["ST 2 straight"])
        == "<straight ST 2 straight, 2 points>"
    )


def test_handles_points_curves_lines_groups_and_crossings() -> None:
    """Handles: points, curves, lines, groups and crossings as a designer sees them."""
    point = handle(wigley(), "WL 2.5 x ST 7")
    assert isinstance(point, Point)
    assert (
        repr((point, point.parent_curve, point.free, point.role))
        == "(<Point WL 2.5 x ST 7>, <Curve ST 7>, ('y',), 'defining')"
    )


def test_what_definitions_are_used_for_each_use_stands_once() -> None:
    """What definitions are used for: each use stands once in a hull."""
    assert (USES["keel_angle"].unit, USES["keel_angle"].kind, USES["sectional_area"].needed) == (
        "deg",
        "course",
        True,
    )


def test_definitions_curves_of_form_parameters_that_generate_points() -> None:
    """Definitions: curves of form parameters that generate points on the lines of a hull."""
    angle = FormDefinition(
        "angle at the waterline",
        "waterline_angle",
        "course",
        rule="straight",
        nodes=("AP", "FP"),
        values={"AP_x": 0.0, "AP_y": 30.0, "FP_x": 180.0, "FP_y": 0.0},
    )
    assert (angle.key, angle.value("AP_y"), angle.having({"AP_y": 25.0}).value("AP_y")) == (
        "form:waterline_angle",
        30.0,
        25.0,
    )


def test_which_points_come_from_definitions_now_those_of_generated() -> None:
    """Which points come from definitions now: those of generated curves that are attached."""
    state = wigley(stations=5, waterlines=4)
    assert (dict(attached_curves(state)), attached_rows(state).tolist()) == ({}, [])


def test_definitions_in_the_graphs_of_a_hull_what_generates() -> None:
    """Definitions in the graphs of a hull: what generates which curves."""
    found: networkx.MultiDiGraph[str] = networkx.MultiDiGraph()
    add_definitions(found, wigley(stations=5, waterlines=4))
    assert found.number_of_nodes() == 0

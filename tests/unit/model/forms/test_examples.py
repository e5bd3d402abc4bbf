"""What the parts of `model.forms` give, one small example of each."""

from __future__ import annotations

import math

import numpy as np
from numpy.testing import assert_allclose

from assoc_hull.geometry.form_curves.curve import FormEnd, form_at
from assoc_hull.geometry.form_curves.integrals import form_integrals
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.forms.closure import close_sac, closing_area
from assoc_hull.model.forms.form_values import Forms, chain_of
from assoc_hull.model.forms.generate_points import MarkedSplines, definitions_read, first_marks
from assoc_hull.model.forms.line_layout import course_layout, joints_of, water_layout
from assoc_hull.model.forms.sections import (
    RADIUS_SLACK,
    SectionArcs,
    SectionEnds,
    SectionShape,
    bilge_area,
    bulb_vertices,
    join_vertices,
    parts_at_draught,
)
from assoc_hull.model.forms.two_halves import (
    HalfCurve,
    half_curve_fault,
    half_curve_vertices,
    halves_vertices,
    reachable,
)
from assoc_hull.model.tables import Particulars


def test_from_a_definition_to_its_curve_in_the_units() -> None:
    """From a definition to its curve in the units of the ship."""
    areas = FormDefinition(
        "areas",
        "sectional_area",
        "halves",
        values={
            "full": 292.59,
            "run_start_angle_deg": 60.0,
            "run_start_curvature": -2.0,
            "run_end": -0.3,
            "run_area": 0.55,
            "run_centroid": -0.59,
            "entrance_start": 0.2,
            "entrance_area": 0.6,
            "entrance_centroid": 0.52,
            "entrance_end_angle_deg": -50.0,
            "entrance_end_curvature": -2.0,
        },
    )
    chain = chain_of(areas, Particulars("ship", 180.0, 28.0, 15.5, 10.5))
    # the prismatic coefficient
    assert round(chain.area() / 180.0 / 292.59, 12) == 0.825


def test_all_definitions_of_a_hull_by_their_use_read() -> None:
    """All definitions of a hull by their use, read where a line stands."""
    flare = FormDefinition(
        "flare",
        "waterline_angle",
        "course",
        rule="straight",
        nodes=("AP", "FP"),
        values={"AP_x": 0.0, "AP_y": 30.0, "FP_x": 180.0, "FP_y": 0.0},
    )
    forms = Forms.of([flare], Particulars("ship", 180.0, 28.0, 15.5, 10.5))
    assert_allclose(
        forms.value("waterline_angle", np.array([90.0, 181.0])), [15.0, 0.0], rtol=0, atol=0.1
    )
    assert_allclose(forms.has("profile"), False, rtol=0, atol=0.1)


def test_the_sums_by_which_an_entrance_closes_a_curve() -> None:
    """The sums by which an entrance closes a curve of two halves."""
    assert round(closing_area(0.7536, -0.208, 0.34, 1.0, 1.0, 0.511, 0.0, "here"), 4) == 0.4482


def test_closure_the_entrance_by_which_a_curve_of_two() -> None:
    """Closure: the entrance by which a curve of two halves has a given fullness and centroid."""
    area, centroid = close_sac(
        0.7536142725315,
        2.9 / 90.0,
        run_end=-0.208,
        entrance_start=0.34,
        run_area=0.511,
        run_centroid=-0.488,
    )
    assert (round(area, 9), round(centroid, 9)) == (0.448228545, 0.584001746)


def test_how_well_splines_through_marked_points_of_shapes_keep() -> None:
    """How well splines through marked points of shapes keep to the shapes."""
    bilge = SectionArcs(np.array([[0.0, 12.0]]), np.array([2.0]))
    shape = SectionShape(np.array([90.0]), (bilge,))
    whole = MarkedSplines.of(shape, "arc", [[(0, 0.0), (0, 2.0), (0, 4.0)]], None)
    assert whole.deviations().round(3).tolist() == [0.059, 0.059]


def test_as_many_points_of_a_shape_as_bring() -> None:
    """As many points of a shape as bring the spline through them within 1 mm, and to its area."""
    assert first_marks("level+arc") == [
        (0, 0.0),
        (1, 0.0),
        (1, 0.5),
        (1, 1.0),
        (1, 1.5),
        (1, 2.0),
        (1, 2.5),
        (1, 3.0),
        (1, 3.5),
        (1, 4.0),
    ]


def test_from_definitions_to_the_points_of_lines() -> None:
    """From definitions to the points of lines: what the update engine asks for."""
    assert definitions_read(GeneratedCurve("profile", 0, "profile", "form", (), ())) == ("profile",)


def test_layouts_and_shapes_of_lines_that_are_courses_themselves() -> None:
    """Layouts and shapes of lines that are courses themselves: profile, deck edge, borders of
    flats."""
    stem = FormDefinition(
        "contour",
        "profile",
        "course",
        nodes=("A", "B", "C"),
        values={
            "A_x": 0.0,
            "A_y": 0.0,
            "A_angle_deg": 0.0,
            "B_x": 170.0,
            "B_y": 0.0,
            "B_angle_deg": 0.0,
            "C_x": 180.0,
            "C_y": 10.0,
            "C_angle_deg": 80.0,
        },
    )
    assert course_layout(stem) == "ahead+form"


def test_where_waterlines_go_onto_a_flat_between_these_places() -> None:
    """Where waterlines go onto a flat: between these places they are straight."""
    assert water_layout(Forms.of([], Particulars("ship", 180.0, 28.0, 15.5, 10.5)), 6.0) == ""


def test_of_which_pieces_a_generated_line_is_made() -> None:
    """Of which pieces a generated line is made where it stands."""
    assert [kind.name for kind, _ in joints_of("level+curve+topside")] == ["TANGENT", "SMOOTH"]


def test_between_which_values_something_can_be_made_found() -> None:
    """Between which values something can be made, found by trying."""
    found = reachable(lambda x: 1.0 <= x <= 2.0, 0.0, 10.0, 9.0)
    assert found is not None
    low, high = found
    assert (round(low, 9), round(high, 9)) == (1.0, 2.0)


def test_one_half_of_a_curve_of_two_made() -> None:
    """One half of a curve of two: made, or refused with what can be had."""
    start = (-1.0, 0.0, math.radians(60.0), -2.0, 0.1525819451966713)
    finish = (-0.3, 1.0, 0.0, 0.0, 0.1525819451966713)
    run = HalfCurve("run", "in an example", start, finish, 0.55, -0.59)
    assert half_curve_vertices(run)[3].round(9).tolist() == [-0.92217359, 0.787861836]
    assert (
        half_curve_fault(HalfCurve("run", "in an example", start, finish, 0.8, -0.59))
        == "asks for an area outside the box between the ends"
    )


def test_curves_of_two_halves_run_parallel_part_and_entrance() -> None:
    """Curves of two halves: run, parallel part and entrance, in the frame of the ship."""
    areas = FormDefinition(
        "areas",
        "sectional_area",
        "halves",
        values={
            "full": 1.0,
            "run_start_angle_deg": 60.0,
            "run_start_curvature": -2.0,
            "run_end": -0.3,
            "run_area": 0.55,
            "run_centroid": -0.59,
            "entrance_start": 0.2,
            "entrance_area": 0.6,
            "entrance_centroid": 0.52,
            "entrance_end_angle_deg": -50.0,
            "entrance_end_curvature": -2.0,
        },
    )
    assert halves_vertices(areas)[0, 3].round(9).tolist() == [-0.92217359, 0.787861836]


def test_the_parallel_middle_body_flat_bottom_a_bilge() -> None:
    """The parallel middle body: flat bottom, a bilge that is an arc of a circle, upright
    sides."""
    assert round(2.0 * bilge_area(14.0, 10.5, 1.8125), 3) == 292.59


def test_sections_of_one_layout_where_they_stand() -> None:
    """Sections of one layout where they stand, and the errors of what cannot stand there."""
    forms = Forms.of([], Particulars("ship", 180.0, 28.0, 15.5, 10.5))
    ends = np.array([[[9.0, 0.0, 0.0], [9.0, 12.0, 15.5]]])
    assert SectionEnds.of(forms, np.array([9.0]), ends).finish.tolist() == [[15.5, 12.0]]


def test_the_immersed_part_of_sections_form_parameter_curves() -> None:
    """The immersed part of sections: form-parameter curves with an area, between flats."""
    assert RADIUS_SLACK == 5e-07


def test_the_part_of_sections_above_the_draught_or_all() -> None:
    """The part of sections above the draught, or all of one whose contour lies above it."""
    below = FormEnd.of(10.5, 8.0, np.radians(15.0), 0.01)
    deck = FormEnd.of(15.0, 9.5, np.radians(10.0))
    assert join_vertices(below, deck)[0, 3].round(9).tolist() == [12.733173599, 8.825001545]


def test_sections_through_a_bulbous_bow_a_bulb_up() -> None:
    """Sections through a bulbous bow: a bulb up to its neck, and what rises from the neck."""
    height, breadth = 9.0, 2.25
    half = np.pi / 4.0 * height * breadth
    closed = bulb_vertices(np.zeros((1, 2)), np.array([[height, 0.0]]), np.array([half]))
    assert round(float(form_integrals(closed).area[0] / half), 12) == 1.0
    # an ellipse, nearly
    assert_allclose(
        form_at(closed, np.array([2.0])).round(2).tolist(), [[4.5, 2.25]], rtol=0, atol=0.01
    )


def test_sections_of_one_layout_as_shapes() -> None:
    """Sections of one layout as shapes."""
    assert parts_at_draught("level+curve+topside+wall") == (("level", "curve"), ("topside", "wall"))

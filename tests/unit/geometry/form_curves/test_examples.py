"""What the parts of `geometry.form_curves` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.form_curves.chain import cubic_vertices, straight_vertices
from assoc_hull.geometry.form_curves.checks import (
    area_limits,
    centroid_limits,
    check_parameters,
    forward_centroids,
)
from assoc_hull.geometry.form_curves.curve import (
    NAMES,
    FormEnd,
    FormParameters,
    end_of,
    end_vertices,
    form_vertices,
)
from assoc_hull.geometry.form_curves.integrals import (
    area_table,
    fair_vertex,
    form_integrals,
    middle_vertex,
    required_middle,
)
from assoc_hull.geometry.form_curves.shape import form_inflections, least_coordinate, least_rate


def test_the_basis_functions_of_form_parameter_curves_and_integrals() -> None:
    """The basis functions of form-parameter curves, and integrals of their products, as
    fractions."""
    assert [int(720 * each) for each in area_table()[0]] == [-10, -9, 18, 1, 0, 0, 0]


def test_integrals_under_form_parameter_curves_exactly_and_how_they() -> None:
    """Integrals under form-parameter curves, exactly, and how they depend on the middle
    vertex."""
    line = np.column_stack([np.arange(-1.0, 6.0), np.full(7, 2.0)])
    found = form_integrals(line[None])
    assert [round(float(each[0]), 12) for each in (found.area, found.moment, found.moment_y)] == [
        8.0,
        16.0,
        8.0,
    ]


def test_between_which_bounds_area_and_centroid_of_a_form() -> None:
    """Between which bounds area and centroid of a form-parameter curve can lie, by its ends
    alone."""
    assert area_limits((0.0, 0.25), (2.0, 1.0)) == (0.5, 2.0)
    assert [round(each, 6) for each in centroid_limits((0.0, 0.0), (1.0, 1.0), 0.4)] == [0.2, 0.8]


def test_between_which_centroids_form_parameter_curves_of_an_area() -> None:
    """Between which centroids form-parameter curves of an area run forward: dx/dt nowhere
    below 0."""
    run = FormEnd.of(-1.0, 0.0, np.radians(60.0), -2.0, 0.1525819451966713)
    body = FormEnd.of(-0.3, 1.0, 0.0, 0.0, 0.1525819451966713)
    ends = np.concatenate([end_vertices(run), end_vertices(body)], axis=1)
    assert forward_centroids(ends, np.array([0.55])).round(4).tolist() == [[-0.5936, -0.5521]]


def test_what_is_wrong_or_merely_worth_knowing_about() -> None:
    """What is wrong, or merely worth knowing, about the parameters of a form-parameter curve."""
    curve = FormParameters(0.0, 0.0, 0.5, 0.0, 0.3, 0.0, 1.0, 1.0, 1.2, 0.0, 0.3, 0.0, 0.4, 0.9)
    assert [(each.code, each.severity) for each in check_parameters(curve)] == [("C4s", "warning")]


def test_form_parameter_curves_a_cubic_b_spline_of_7() -> None:
    """Form-parameter curves: a cubic B-spline of 7 vertices from what its ends and its area
    are to be."""
    run = FormEnd.of(-1.0, 0.0, np.radians(60.0), -2.0, 0.1525819451966713)
    body = FormEnd.of(-0.3, 1.0, 0.0, 0.0, 0.1525819451966713)
    vertices = form_vertices(run, body, area=np.array([0.55]), centroid=np.array([-0.59]))
    assert vertices[0, 3].round(9).tolist() == [-0.92217359, 0.787861836]
    assert form_integrals(vertices).area.round(12).tolist() == [0.55]


def test_from_the_vertices_of_a_form_parameter_curve_back() -> None:
    """From the vertices of a form-parameter curve back to its parameters."""
    found = end_of(end_vertices(FormEnd.of(1.0, 2.0, 0.5, -0.25, 0.75, 0.125)))
    assert [
        round(float(each[0]), 12) for each in (found.angle, found.curvature, found.stretch)
    ] == [0.5, -0.25, 0.125]


def test_the_14_parameters_of_one_form_parameter_curve() -> None:
    """The 14 parameters of one form-parameter curve, by name, and how they go with their
    curve."""
    assert len(NAMES) == 14
    curve = FormParameters(0.0, 1.0, 0.0, 0.0, 0.25, 0.0, 1.0, 0.0, -1.5, 0.0, 0.25, 0.0, 0.5, 0.4)
    assert (curve.rising.start_x, curve.rising.finish_y, curve.rising.start_angle) == (
        -1.0,
        1.0,
        1.5,
    )


def test_least_values_along_form_parameter_curves_one_may_fold() -> None:
    """Least values along form-parameter curves: one may fold back, or fall below an axis."""
    line = straight_vertices((0.0, 1.0), (4.0, 3.0))[None]
    assert (
        least_rate(line, 0).round(12).tolist(),
        least_coordinate(line, 1).round(12).tolist(),
    ) == ([1.0], [1.0])


def test_what_a_form_parameter_curve_is_like_energies_length() -> None:
    """What a form-parameter curve is like: energies, length, inflections, loops."""
    assert form_inflections(cubic_vertices((0.0, 0.0), (4.0, 1.0), (1.0, 0.0), (1.0, 0.0))) == (
        2.0,
    )


def test_the_middle_vertex_of_form_parameter_curves_by_area() -> None:
    """The middle vertex of form-parameter curves: by area and centroid, by area, or fairest."""
    ends = np.array([[[-1.0, 0], [0, 0], [1, 0], [3, 1], [4, 1], [5, 1]]])
    assert fair_vertex(ends).tolist() == [[2.0, 0.5]]
    vertex, _discriminant = middle_vertex(ends, np.array([2.0]), np.array([2.875]))
    assert [round(float(each), 6) for each in vertex[0]] == [2.0, 0.5]


def test_the_middle_vertex_of_form_parameter_curves() -> None:
    """The middle vertex of form-parameter curves, or the reason why there is none."""
    ends = np.array([[[-1.0, 0], [0, 0], [1, 0], [3, 1], [4, 1], [5, 1]]])
    assert [round(float(each), 6) for each in required_middle(ends, np.array([2.0]))[0]] == [
        2.0,
        0.5,
    ]

"""The basis functions of form-parameter curves, and integrals of curves."""

from fractions import Fraction

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from assoc_hull.geometry.form_curves.curve import form_at
from assoc_hull.geometry.form_curves.integrals import (
    area_table,
    form_basis,
    form_integrals,
    middle_terms,
    moment_table,
)

AREAS = [
    [-10, -9, 18, 1, 0, 0, 0],
    [-71, -160, 174, 56, 1, 0, 0],
    [-38, -254, -10, 245, 56, 1, 0],
    [-1, -56, -245, 0, 245, 56, 1],
    [0, -1, -56, -245, 10, 254, 38],
    [0, 0, -1, -56, -174, 160, 71],
    [0, 0, 0, -1, -18, 9, 10],
]
LEVER = {4: Fraction(49, 144), 5: Fraction(7, 90), 6: Fraction(1, 720)}
TWIST = {4: Fraction(5947, 30240), 5: Fraction(3, 140), 6: Fraction(1, 18144)}


def test_the_area_table_is_that_of_the_paper() -> None:
    """720 a_ij, to the last number."""
    assert [[720 * each for each in row] for row in area_table()] == AREAS


def test_denominators_of_the_moment_table() -> None:
    """181440 b_ijk are whole numbers; N_3 alone has no integral with its own slope."""
    table = moment_table()
    assert all((181440 * each).denominator == 1 for rows in table for row in rows for each in row)
    assert table[3][3][3] == 0
    assert area_table()[3][3] == 0


def test_the_middle_vertex_acts_by_differences_of_opposite_vertices() -> None:
    """a_3j and the integrals of N_3^2 N_j' are odd about the middle, with the known fractions."""
    for j in range(7):
        opposite = 6 - j
        assert area_table()[3][j] == (LEVER.get(j, 0) or -LEVER.get(opposite, 0))
        assert moment_table()[3][3][j] == (TWIST.get(j, 0) or -TWIST.get(opposite, 0))


def test_basis_functions_add_up_to_one() -> None:
    """On every segment; with +6 for the second power of the second vertex they would not."""
    for segment in range(4):
        parts = [form_basis(vertex, segment) for vertex in range(segment, segment + 4)]
        sums = [sum(column) for column in zip(*parts, strict=True)]
        assert sums == [1, 0, 0, 0]
        assert parts[1][2] == Fraction(-6, 6)


def test_integrals_are_those_of_the_tables_and_of_quadrature() -> None:
    """On random vertices to 1e-13: by fractions, and by eight Gauss points a segment."""
    vertices = np.random.default_rng(8).uniform(-1.0, 1.0, (200, 7, 2))
    found = form_integrals(vertices)
    x, y = vertices[..., 0], vertices[..., 1]
    a = np.array(area_table(), float)
    b = np.array(moment_table(), float)
    tables = (
        np.einsum("ni,nj,ij->n", y, x, a),
        np.einsum("ni,nj,nk,ijk->n", y, x, x, b),
        0.5 * np.einsum("ni,nj,nk,ijk->n", y, y, x, b),
    )
    for got, want, gauss in zip(
        (found.area, found.moment, found.moment_y), tables, by_gauss(vertices), strict=True
    ):
        assert np.abs(got - want).max() < 1e-13
        assert np.abs(got - gauss).max() < 1e-13


def by_gauss(vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """int y dx, int x y dx and 1/2 int y^2 dx by eight points a segment."""
    nodes, weights = leggauss(8)
    sums = np.zeros((3, len(vertices)))
    for segment in range(4):
        for node, weight in zip(nodes, weights, strict=True):
            t = np.full(len(vertices), segment + 0.5 * (node + 1.0))
            (x, y), pace = form_at(vertices, t).T, form_at(vertices, t, 1)[:, 0]
            sums += 0.5 * weight * pace * np.stack([y, x * y, 0.5 * y * y])
    return sums[0], sums[1], sums[2]


def test_integrals_follow_the_middle_vertex() -> None:
    """Area is affine in it, the moment has two quadratic terms: exact wherever it is moved."""
    vertices = np.random.default_rng(9).uniform(-1.0, 1.0, (50, 7, 2))
    terms = middle_terms(vertices[:, [0, 1, 2, 4, 5, 6]])
    for place in ((0.3, -0.7), (-5.0, 8.0)):
        vertices[:, 3] = place
        gauss = by_gauss(vertices)
        x, y = (np.full(50, each) for each in place)
        assert terms.area_at(x, y) == pytest.approx(gauss[0], abs=1e-13 * 30)
        assert terms.moment_at(x, y) == pytest.approx(gauss[1], abs=1e-13 * 300)

"""What the parts of `geometry.patches` give, one small example of each."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from assoc_hull.geometry.patches.area_integrals import AreaIntegrator, area_series, areas_over_boxes
from assoc_hull.geometry.patches.areas_by_sign import (
    SAMPLES,
    arc_curves,
    arc_rules,
    areas_below_arcs,
    sign_areas,
)
from assoc_hull.geometry.patches.bernstein_polynomials import (
    BoundedPolynomial,
    multiply,
    sign_change_roots,
)
from assoc_hull.geometry.patches.bezier_patches import (
    Patches,
    area_stretch,
    curvatures,
    jets,
    patch_points,
)
from assoc_hull.geometry.patches.cell_subdivision import (
    FIRST_CUT,
    count_sign_changes,
    divide_by_edge_lines,
    signs,
    subdivide_again,
    subdivide_patches,
)
from assoc_hull.geometry.patches.cells import (
    SIDES,
    CellKind,
    Lattice,
    SignCells,
    ZeroSetArcs,
    box_clusters,
)
from assoc_hull.geometry.patches.components import (
    END_KINDS,
    ComponentKind,
    join_arcs,
    rows_by_label,
)
from assoc_hull.geometry.patches.curvature_functions import (
    BoundedTerms,
    IsoFunction,
    RationalTerms,
    gauss_function,
)
from assoc_hull.geometry.patches.line_ends import (
    ZeroSetLinks,
    borders_without_arcs,
    chain_arcs,
    find_joints,
    next_pieces,
)
from assoc_hull.geometry.patches.spline_surface import SplineSurface, checked_net
from assoc_hull.geometry.patches.triangulation import facets_of, stitch_facets
from assoc_hull.geometry.patches.zero_set_arcs import arc_heights, arcs_of, sample_arcs
from assoc_hull.geometry.surfaces.triangles import boundary_edges


def test_polynomials_of_two_parameters_in_bernstein_form_sums_products() -> None:
    """Polynomials of two parameters in Bernstein form: sums, products, derivatives, parts."""
    u, v = np.array([[0.0], [1.0]]), np.array([[0.0, 1.0]])
    assert_array_equal(multiply(u, v), [[0.0, 0.0], [0.0, 1.0]])


def test_polynomials_with_bounds_of_their_errors_that_are_carried() -> None:
    """Polynomials with bounds of their errors that are carried through every operation."""
    x = BoundedPolynomial(np.array([[0.0], [1.0]]), np.full((2, 1), 1e-3))
    assert_array_equal((1e3 * x.times(x).err).ravel().round(2), [0.0, 1.01, 2.02])


def test_where_polynomials_in_bernstein_form_change_sign_once_many() -> None:
    """Where polynomials in Bernstein form change sign once: many at a time."""
    assert_allclose(
        sign_change_roots(np.array([[-1.0, -0.5, 3.0]]), np.array([True])), [0.4], rtol=0, atol=0.1
    )


def test_rules_of_quadrature_on_0_1_that_contain_one() -> None:
    """Rules of quadrature on [0, 1] that contain one another, with measures of their errors."""
    rules = arc_rules()
    assert (len(rules.first), len(rules.second)) == (7, 6)


def test_arcs_as_curves_u_gv_whichever_way_they_run() -> None:
    """Arcs as curves u = g(v), whichever way they run: one batch of both."""
    b = np.array([[[-1.0, -2.0], [3.0, 2.0]]])
    cells = subdivide_patches(IsoFunction(b, 1e-15 + 0.0 * b))
    [(curves, rows)] = arc_curves(cells, arcs_of(cells), np.array([0]))
    assert_array_equal(
        curves.at(rows, np.array([[0.0, 1.0]]), np.array([[0.3, 0.4]])), [[0.25, 0.5]]
    )


def test_areas_below_arcs_of_a_zero_set_height_functions() -> None:
    """Areas below arcs of a zero set: height functions, by rules that contain one another."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
    b = np.array([[[-1.0, -1.0], [3.0, 3.0]]])
    cells = subdivide_patches(IsoFunction(b, 1e-15 + 0.0 * b))
    [(curves, _rows)] = arc_curves(cells, arcs_of(cells), np.array([0]))
    area, _error = areas_below_arcs(
        AreaIntegrator.of(Patches.single(net), 1e-6), curves, np.array([1e-6])
    )
    assert_array_equal(area.round(12), [1.5])


def test_what_samples_tell_of_cells_in_which_the_sign() -> None:
    """What samples tell of cells in which the sign of the polynomial is not decided."""
    assert SAMPLES == 16


def test_areas_of_surface_where_a_polynomial_is_positive_negative() -> None:
    """Areas of surface where a polynomial is positive, negative, nil, and where this is not
    known."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
    patches = Patches.single(net)
    cells = subdivide_patches(gauss_function(patches, 0.0))
    found = sign_areas(patches, cells, arcs_of(cells), 1e-9)
    assert_allclose(found.negative.round(6), [1.280789], rtol=0, atol=1e-06)
    assert_allclose(found.total.round(6), [1.280789], rtol=0, atol=1e-06)


def test_arcs_as_heights_over_a_border_of_their_cell() -> None:
    """Arcs as heights over a border of their cell: at a running parameter t, the other one."""
    b = np.array([[[-1.0, -2.0], [3.0, 2.0]]])
    assert_array_equal(arc_heights(b, np.array([True]), np.array([[0.0, 1.0]])), [[0.25, 0.5]])


def test_the_arc_of_the_zero_set_in_each_simple() -> None:
    """The arc of the zero set in each simple cell: where it starts and ends."""
    b = np.array([[[-1.0, -2.0], [3.0, 2.0]]])
    assert_array_equal(
        arcs_of(subdivide_patches(IsoFunction(b, 1e-15 + 0.0 * b))).ends[0],
        [[0.25, 0.0], [0.5, 1.0]],
    )


def test_arcs_as_polylines_as_many_points_as_a_chord() -> None:
    """Arcs as polylines: as many points as a chord tolerance in space wants, each of them a
    root."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0] = net[:, 1, 1] = 1.0
    b = np.array([[[-1.0, -2.0], [3.0, 2.0]]])
    cells = subdivide_patches(IsoFunction(b, 1e-15 + 0.0 * b))
    start, uv = sample_arcs(Patches.single(net), cells, arcs_of(cells), 0.1)
    assert (start.tolist(), uv[0].tolist(), uv[-1].tolist()) == ([0, 5], [0.25, 0.0], [0.5, 1.0])


def test_areas_under_a_patch_point_by_point_gausss_rules() -> None:
    """Areas under a patch point by point: Gauss's rules of 5 and 8 points on boxes and on
    lines."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
    box = np.array([[[0.0, 1.0], [0.0, 0.5]]])
    area, _error = areas_over_boxes(Patches.single(net), np.array([0]), box, np.array([1e-9]))
    assert_array_equal(area.round(12), [3.0])


def test_areas_under_a_patch_by_one_series_ru_x() -> None:
    """Areas under a patch by one series: |r_u x r_v| in Chebyshev polynomials of both
    parameters."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
    [series] = area_series(Patches.single(net), np.array([1e-9]))
    assert_array_equal(
        series.over(np.array([0]), np.array([[[0.0, 1.0], [0.0, 0.5]]])).round(12), [3.0]
    )


def test_areas_under_patches_by_series_where_there_is_one() -> None:
    """Areas under patches, by series where there is one, point by point elsewhere."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
    assert_array_equal(AreaIntegrator.of(Patches.single(net), 1e-6).total.round(12), [6.0])


def test_components_of_a_zero_set_lines_that_are_joined() -> None:
    """Components of a zero set: lines that are joined, points, edges of patches."""
    assert [kind.value for kind in ComponentKind] == [
        "closed",
        "open",
        "junction",
        "isolated",
        "edge_line",
    ]


def test_components_put_together_from_the_rows_that_belong() -> None:
    """Components put together from the rows that belong to each."""
    assert [rows.tolist() for rows in rows_by_label(np.array([1, -1, 0, 1]), 2)] == [[2], [0, 3]]


def test_edges_of_patches_along_which_the_polynomial_is_nil() -> None:
    """Edges of patches along which the polynomial is nil: no arc runs there, the cells end at
    it."""
    assert SIDES[3] == (1, 1.0)


def test_arcs_joined_into_lines_and_lines_into_the_components() -> None:
    """Arcs joined into lines, and lines into the components of a zero set."""
    patches = Patches.single(np.zeros((2, 2, 3)))
    whole, zero = np.array([[[0.0, 1.0]] * 2]), np.array([0])
    simple, b = np.array([CellKind.U_SIMPLE]), np.array([[[-1.0, -1.0], [1.0, 1.0]]])
    cells = SignCells(zero, whole, zero, simple, zero, b, 0.0 * b, zero > 0)
    ends = np.array([[[0.5, 0.0], [0.5, 1.0]]])
    found = join_arcs(
        patches, cells, ZeroSetArcs(zero, zero, np.array([[0.0, 1.0]]), ends, zero == 0)
    )
    assert (found[0].kind.value, found[0].ends.tolist()) == ("open", [[0.5, 1.0], [0.5, 0.0]])


def test_polynomials_of_curvature_together_with_what_each_of_their() -> None:
    """Polynomials of curvature together with what each of their coefficients may be off by."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
    found = BoundedTerms(Patches.single(net), 0.0).gauss()
    assert (found.b[0, 0, 0].item(), bool(0.0 < found.err[0, 0, 0] < 1e-12)) == (-1.0, True)


def test_what_curvature_is_made_of_on_rational_patches_planes() -> None:
    """What curvature is made of on rational patches: planes T, and products of them."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 2.0, 1.0
    assert (
        RationalTerms.of(Patches.single(net, np.ones((2, 2))), 0.0).area().b[0, 0, 0].item() == 4.0
    )


def test_polynomials_that_have_the_sign_of_gaussian_or_mean() -> None:
    """Polynomials that have the sign of Gaussian or mean curvature less a level, with error
    bounds."""
    net = np.zeros((4, 4, 3))
    net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
    found = gauss_function(Patches.single(net), 0.0)
    assert (found.b.shape, bool((found.b == 0.0).all())) == ((1, 15, 15), True)


def test_parts_of_patches_in_which_the_sign() -> None:
    """Parts of patches in which the sign of a polynomial is known, or changes along one arc."""
    assert (CellKind.POSITIVE.pure, CellKind.U_SIMPLE.pure) == (True, False)


def test_which_ends_of_arcs_coincide() -> None:
    """Which ends of arcs coincide."""
    ends = np.array([[[0.0, 0.0], [0.5, 0.5]], [[0.5, 0.5], [1.0, 0.2]]])
    assert_array_equal(find_joints(ends).joint, [[0, 1], [1, 2]])


def test_arcs_in_a_row_each_follows_the_one() -> None:
    """Arcs in a row: each follows the one that ends where it begins."""
    following = np.array([2, -1, 1, 4, 3])
    assert_array_equal(chain_arcs(following).arcs, [0, 2, 1, 3, 4])


def test_directed_pieces_joined_into_loops() -> None:
    """Directed pieces joined into loops."""
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    pieces = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    assert_array_equal(
        next_pieces(pieces, pieces[:, 1] - pieces[:, 0], pieces[:, 1] - pieces[:, 0]), [1, 2, 0]
    )


def test_bezier_patches_of_one_bidegree_and_where_each_lies() -> None:
    """Bezier patches of one bidegree, and where each lies on its surface."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0] = net[:, 1, 1] = 1.0
    assert Patches.single(net).degrees == (1, 1)


def test_points_of_patches_and_how_much_they_stretch() -> None:
    """Points of patches, and how much they stretch the parameter plane, at scattered
    parameters."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 3.0, 2.0
    here = np.array([[0.5, 0.25]])
    assert_allclose(
        patch_points(Patches.single(net), np.array([0]), here), [[1.5, 0.5, 0.0]], rtol=0, atol=0.1
    )
    assert_allclose(area_stretch(Patches.single(net), np.array([0]), here), [6.0], rtol=0, atol=0.1)


def test_points_of_patches_with_derivatives_what_every_quantity() -> None:
    """Points of patches with derivatives: what every quantity of a surface at a point is made
    of."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1], net[1, 1, 2] = 2.0, 1.0, 1.0
    found = jets(Patches.single(net), np.array([0]), np.array([[0.5, 0.5]]))
    assert_allclose(found.r, [[1.0, 0.5, 0.25]], rtol=0, atol=1e-06)
    assert_allclose(found.element.round(6), [2.291288], rtol=0, atol=1e-06)


def test_curvatures_of_patches_at_points_gaussian_mean_principal_ones() -> None:
    """Curvatures of patches at points: Gaussian, mean, principal ones and their directions."""
    net = np.zeros((3, 2, 3))
    net[..., 0], net[..., 1] = np.mgrid[-1:2, 0:2]
    net[..., 2] = np.array([1.0, -1.0, 1.0])[:, None]
    found = curvatures(Patches.single(net), np.array([0]), np.array([[0.5, 0.5]]))
    assert_allclose(found.gauss, [0.0], rtol=0, atol=0.1)
    assert_allclose(found.principal, [[2.0, 0.0]], rtol=0, atol=0.1)
    assert_allclose(found.axes[0].round(12), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], rtol=0, atol=0.1)


def test_signs_of_bernstein_coefficients_that_are_known_to_some() -> None:
    """Signs of Bernstein coefficients that are known to some error, and what follows from
    them."""
    s = signs(np.array([[2.0, 1e-9, -1.0, -2.0]]), np.array([[1e-6, 1e-6, 1e-6, 1e-6]]))
    assert (s.tolist(), count_sign_changes(s).tolist()) == ([[1, 0, -1, -1]], [1])


def test_divide_polynomials_by_what_makes_them_nil_along_edges() -> None:
    """Divide polynomials by what makes them nil along edges of the square."""
    # 3 u
    b = np.array([[0.0, 0.0], [3.0, 3.0]])
    assert_array_equal(
        divide_by_edge_lines(np.stack([b, 1e-15 + 0 * b])[None])[0, 0], [[3.0, 3.0], [3.0, 3.0]]
    )


def test_cut_patches_into_cells_until_the_sign() -> None:
    """Cut patches into cells until the sign of a polynomial in each is known, or changes in
    one arc."""
    # 3 u - 1
    u = np.array([[-1.0, -1.0], [2.0, 2.0]])
    assert subdivide_patches(IsoFunction(u[None], np.full((1, 2, 2), 1e-15))).kind.tolist() == [2]


def test_patches_solved_again_where_a_cut_of_the_search() -> None:
    """Patches solved again where a cut of the search touches the zero set."""
    in_u, in_v = ([c * c, c * c - c, (1 - c) ** 2] for c in (FIRST_CUT[0] + 0.2, 0.53))
    # a circle that touches the cut
    b = 0.2**2 - np.array(in_u)[:, None] - in_v
    function = IsoFunction(b[None], np.full((1, 3, 3), 1e-15))
    cells = subdivide_patches(function)
    assert [int((each.kind == 4).sum()) for each in (cells, subdivide_again(function, cells))] == [
        2,
        0,
    ]


def test_spline_surfaces_as_triangles_that_know_which_parameters_their() -> None:
    """Spline surfaces as triangles that know which parameters their corners have."""
    net = np.zeros((3, 2, 3))
    net[..., 0], net[..., 1] = np.mgrid[0:3, 0:2]
    net[1, :, 2] = 0.5
    found = facets_of([SplineSurface.bezier(net)], deflection=0.01, longest=1.0)
    assert (len(found.mesh.face), found.uv.shape) == (10, (10, 3, 2))


def test_triangles_of_surfaces_sewn_where_their_borders_run_along() -> None:
    """Triangles of surfaces sewn where their borders run along each other, however each was
    cut."""

    def plate(y: float, count: int) -> SplineSurface:
        net = np.zeros((count, 2, 3))
        net[..., 0], net[..., 1] = np.mgrid[0 : 1 : count * 1j, y : y + 1 : 2j]
        along = np.array([0, *range(count), count - 1], float)
        return SplineSurface("", (1, 1), along, np.array([0.0, 0, 1, 1]), net)

    both = facets_of([plate(0.0, 3), plate(1.0, 4)], 0.01, 2.0)
    assert (
        len(boundary_edges(both.mesh)),
        len(boundary_edges(stitch_facets(both, 1e-3).mesh)),
    ) == (14, 9)


def test_lines_that_run_unseen_along_borders_of_cells() -> None:
    """Lines that run unseen along borders of cells, where a polynomial is nil within its
    error."""
    box = np.array([[[0.0, 0.5], [0.0, 1.0]], [[0.5, 1.0], [0.0, 1.0]]])
    zero, none = np.zeros(2, int), np.zeros((0, 2, 2))
    kind = np.array([CellKind.POSITIVE, CellKind.NEGATIVE])
    cells = SignCells(zero, box, zero, kind, zero - 1, none, none, zero[:1] > 0)
    assert borders_without_arcs(cells, Lattice.apart(1), zero - 1, none).tolist() == [
        [[0.5, 0.0], [0.5, 1.0]]
    ]


def test_what_lines_end_at_borders_of_surfaces_or_patches() -> None:
    """What lines end at: borders of surfaces or patches, undecided cells, other lines."""
    assert [kind.value for kind in END_KINDS] == ["border", "knot-line", "junction"]


def test_what_the_ends_of_arcs_meet_other_arcs_undecided() -> None:
    """What the ends of arcs meet: other arcs, undecided cells, borders; and which arc goes on
    where."""
    zero, none = np.array([0]), np.zeros((0, 2, 2))
    whole, kind = np.array([[[0.0, 1.0]] * 2]), np.array([CellKind.U_SIMPLE])
    cells = SignCells(zero, whole, zero, kind, zero, none, none, zero > 0)
    ends = np.array([[[0.5, 0.0], [0.5, 1.0]]])
    arcs = ZeroSetArcs(zero, zero, np.array([[0.0, 1.0]]), ends, zero == 0)
    assert ZeroSetLinks.of(Lattice.apart(1), cells, arcs).points.uv.tolist() == [
        [0.5, 1.0],
        [0.5, 0.0],
    ]


def test_where_patches_lie_beside_one_another_on_their_surfaces() -> None:
    """Where patches lie beside one another on their surfaces, in whole numbers."""
    box = np.array([[[0.0, 0.5], [0.0, 1.0]], [[0.5, 2.0], [0.0, 1.0]]])
    lattice = Lattice.of(np.zeros(2, int), box)
    assert_array_equal(
        lattice.place(np.array([0, 1]), np.array([[1.0, 0.3], [0.0, 0.3]])),
        [[1.0, 0.3], [1.0, 0.3]],
    )
    assert_array_equal(lattice.neighbours[0], [False, True, False, False])


def test_which_boxes_of_many_touch_by_trees_of_their() -> None:
    """Which boxes of many touch: by trees of their centres, one for boxes of about one size."""
    low = np.array([[0.0, 0.0], [0.5, 0.5], [2.0, 0.0]])
    assert_array_equal(box_clusters(low, low + 0.5, 1e-9), [0, 0, 1])


def test_checks_of_what_a_surface_is_made() -> None:
    """Checks of what a surface is made of, and of parameters on it."""
    assert checked_net([[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]], "in a surface").shape == (
        2,
        2,
        3,
    )


def test_surfaces_as_tensor_products_of_b_splines_their_checks() -> None:
    """Surfaces as tensor products of B-splines: their checks, points, patches and parts."""
    net = np.zeros((4, 4, 3))
    net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
    plane = SplineSurface.bezier(net, "plane")
    assert_array_equal(plane.at(0.5, 0.25), [0.5, 0.25, 0.0])
    assert len(plane.patches()) == 1

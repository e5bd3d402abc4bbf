"""What the parts of `geometry.classical` give, one small example of each."""

from __future__ import annotations

import math

import numpy as np
from numpy.testing import assert_allclose

from assoc_hull.geometry.classical.appendages import AppendageBox, LoftedAppendage
from assoc_hull.geometry.classical.arc_chain_search import FitPieces
from assoc_hull.geometry.classical.arc_curve import ArcBoundary, mean_curvatures, through_points
from assoc_hull.geometry.classical.arc_fit import fit_arcs
from assoc_hull.geometry.classical.biarc_chain import (
    TangentPart,
    biarc_chain,
    biarc_tangents,
    collinear_runs,
)
from assoc_hull.geometry.classical.biarc_family import (
    BiarcChords,
    biarcs_by_ratio,
    biarcs_of_shares,
    one_bend_radii,
    ratio_radii,
)
from assoc_hull.geometry.classical.biarcs import biarc_kinds, biarcs, chords_by_rule
from assoc_hull.geometry.classical.boundary_lines import CodedKnuckleLine, KeelOutline, SpaceCurve
from assoc_hull.geometry.classical.camber import Camber, CamberKind
from assoc_hull.geometry.classical.checked_input import finite_array, numbers, one_of
from assoc_hull.geometry.classical.chord_spline import ChordSpline
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs, arc_area, circle_through
from assoc_hull.geometry.classical.deck import Deck, DeckHouse, Sheer
from assoc_hull.geometry.classical.elastica import Elastica, fit_elastica
from assoc_hull.geometry.classical.frame_section import (
    FrameSection,
    Quadratics,
    deck_corner,
    frame_runs,
    run_bends,
)
from assoc_hull.geometry.classical.ordinate_section import (
    OrdinateSection,
    PairedParabolas,
    area_below,
)
from assoc_hull.geometry.classical.parallel_waterline import GraphPiece, ParallelWaterline
from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import power_coefficients


def test_an_appendage_through_one_two_or_three_sections() -> None:
    """An appendage through one, two or three sections: a prism, a ruled body, a parabolic one."""
    keel = [(0, 0), (0.4, 0), (0.4, 2), (0, 2)]
    skeg = [(0, 0), (0.8, 0.2), (0.7, 2.5), (0, 2.4)]
    assert round(LoftedAppendage.make([keel], (0, 6)).volume, 12) == 4.8
    assert round(LoftedAppendage.make([keel, skeg], (0, 6)).volume, 12) == 7.58


def test_a_box_with_faces_parallel_to_the_axes_added() -> None:
    """A box with faces parallel to the axes, added to a hull or taken from it."""
    box = AppendageBox.make((12, 20), (1, 3), (0.5, 2.5))
    assert (box.volume, box.centroid, box.waterplane_area(1.0)) == (32.0, (16.0, 2.0, 1.5), 16.0)


def test_circular_arcs_and_straight_lines_as_one_record_many() -> None:
    """Circular arcs and straight lines as one record, many at once."""
    quarter = PlaneArcs.make([[0, 0]], [0.0], [0.5], [np.pi])
    assert quarter.ends().round(12).tolist() == [[2.0, 2.0]]


def test_area_and_moment_beside_a_circular_arc_that_turns() -> None:
    """Area and moment beside a circular arc that turns left and rises, as far as a level."""
    quarter = PlaneArcs.make([[3.0, 0.0]], [0.0], [0.5], [math.pi])
    assert round(arc_area(quarter, (3.0, 2.0), 2.0), 9) == round(6.0 + math.pi, 9)


def test_circles_by_three_points_by_a_point_with_its() -> None:
    """Circles by three points, by a point with its tangent and another, and by least squares."""
    circle = circle_through([0, 0], [4, 3], [10, 4])
    assert (circle.centre.round(6).tolist(), round(circle.curvature, 9)) == (
        [8.857143, -7.642857],
        -0.085478752,
    )


def test_plane_curves_cut_at_corners_and_straight_runs_into() -> None:
    """Plane curves cut at corners and straight runs into pieces, each to become arcs."""
    bent = CurveData.single(np.array([[0.0, 0, 0], [1, 0, 0], [2, 1, 0]]), kind=[0, 2, 0])
    cubic = power_coefficients(loft(bent))[:, :, :2]
    pieces = FitPieces.of(cubic, np.array([0, 2]), flat=1e-6)
    assert (pieces.straight.tolist(), np.rad2deg(pieces.angle[:, 0]).round(9).tolist()) == (
        [True, True],
        [0.0, 45.0],
    )


def test_a_plane_curve_of_straight_lines_and_circular_arcs() -> None:
    """A plane curve of straight lines and circular arcs: evaluated, met, measured."""
    curve = through_points([(0, 0), (3, 0), (5, 4)], kind="line")
    assert (round(curve.length, 9), curve.where(1, 2.0).tolist()) == (7.472135955, [[4.0, 2.0]])


def test_curves_through_points_or_round_the_corners() -> None:
    """Curves through points, or round the corners of a polygon, by lines and arcs; the mean
    circle."""
    points = [(0, 0), (6, 0.2), (10, 1.5), (12, 4), (12.4, 8)]
    assert float(mean_curvatures(points)[1].round(10)) == 0.1047945258


def test_a_boundary_curve_of_lines_and_arcs() -> None:
    """A boundary curve of lines and arcs in a plane along the ship: stern, stem, a buttock."""
    stem = ArcBoundary("stem", through_points([(0, 0), (3, 0), (5, 4)], kind="line"))
    assert (stem.x(2.0).tolist(), round(stem.length, 9)) == ([4.0], 7.472135955)


def test_plane_curves_as_chains_of_few_arcs_within() -> None:
    """Plane curves as chains of few arcs within a tolerance, tangents without a break."""
    x = np.linspace(0.0, 10.0, 6)
    curve = loft(CurveData.single(np.stack([x, np.sin(0.5 * x), 0.0 * x], axis=1)))
    fit = fit_arcs(power_coefficients(curve)[:, :, :2], np.array([0, 5]), within=0.001)
    assert (len(fit.arcs), bool(fit.deviation.max() <= 0.001)) == (11, True)


def test_every_biarc_between_two_points_with_their_directions() -> None:
    """Every biarc between two points with their directions, by how its two chords share the
    way."""
    chords = BiarcChords.of([[0, 0]], [0.5], [[10, 0]], [-0.5])
    arcs, _tau = biarcs_of_shares(chords, np.array([0.5]), np.array([0.5]))
    # one circle
    assert (-1 / arcs.curvature).round(6).tolist() == [10.429148, 10.429148]


def test_biarcs_by_the_ratio_of_their_two_chords_every() -> None:
    """Biarcs by the ratio of their two chords: every biarc between two points and directions,
    once."""
    quarter = biarcs_by_ratio(np.array([2.0]), np.array([0.7]), np.array([-0.7]), np.array([0.5]))
    assert_allclose(
        bool(abs(quarter.bend[0, 0] - quarter.bend[1, 0]) < 1e-15), True, rtol=0, atol=0.1
    )
    assert_allclose(quarter.tau.round(12) + 0.0, [0.0], rtol=0, atol=0.1)


def test_biarcs_that_bend_one_way_closed_forms() -> None:
    """Biarcs that bend one way: closed forms in the absolute end angles a, b, mirrored to a
    above nil."""
    a, b = np.radians([60.0]), np.radians([30.0])
    assert [
        each.round(6).tolist() for each in one_bend_radii(np.array([10.0]), a, b, (a - b) / 2)
    ] == [[2.41181], [11.248444]]


def test_biarcs_with_an_inflection_closed_forms_in_the_absolute() -> None:
    """Biarcs with an inflection: closed forms in the absolute end angles a, b, mirrored to a
    above nil."""
    a, b = np.radians([40.0]), np.radians([20.0])
    assert [each.round(6).tolist() for each in ratio_radii(np.array([10.0]), a, b, a / b)] == [
        [3.647448],
        [7.294896],
    ]


def test_straight_runs_among_points_and_where_a_line() -> None:
    """Straight runs among points, and where a line of points turns back."""
    unit = np.array([[1.0, 0.0], [1.0, 0.0], [0.6, 0.8], [0.8, 0.6]])
    assert collinear_runs(unit, 1e-9) == [(0, 2)]


def test_tangents_of_one_part_of_a_line_between_its() -> None:
    """Tangents of one part of a line, between its ends or knuckles; `biarc_tangents` has the
    equations."""
    part = TangentPart.of(np.array([[0.0, 0.0], [3.0, 4.0]]), 0, "chord", 1e-9)
    assert part.tangents(None, None).tolist() == [[0.6, 0.8], [0.6, 0.8]]


def test_tangents_at_points_that_have_none_slopes_of_parabolas() -> None:
    """Tangents at points that have none: slopes of parabolas through three points each."""
    found = biarc_tangents([[0.0, 0.0], [1, 0.8], [2.5, 1.5], [4, 1.7], [6, 1.2]])
    assert found.leaving_angles.round(6).tolist() == [
        0.776027,
        0.570949,
        0.277722,
        -0.026922,
        -0.446491,
    ]


def test_a_line_through_points_as_a_chain_of_biarcs() -> None:
    """A line through points as a chain of biarcs: tangents first, then two arcs for each
    interval."""
    chain = biarc_chain([[0.0, 0.0], [1, 0.8], [2.5, 1.5], [4, 1.7], [6, 1.2]])
    assert round(chain.length, 9) == 6.539769452
    assert chain.at([0.0, chain.length]).round(12).tolist() == [[0.0, 0.0], [6.0, 1.2]]


def test_which_biarc_of_the_family_is_taken_by_rule() -> None:
    """Which biarc of the family is taken: by rule, and where none applies."""
    chords = BiarcChords.of([[0, 0]], [0.4], [[10, 0]], [0.2])
    kind = biarc_kinds(chords)
    assert kind.tolist() == ["S"]
    first, second, _fallback = chords_by_rule(chords, kind, "inverse")
    assert round(float(second[0] / first[0]), 6) == 1.427678


def test_biarcs_whose_radii_are_at_least_what_can_be() -> None:
    """Biarcs whose radii are at least what can be made: the smaller one takes that, the other
    follows."""
    found = biarcs([[0, 0]], np.radians([60]), [[10, 0]], np.radians([-15]), least_radius=1.0)
    assert (1 / np.abs(found.arcs.curvature)).round(6).tolist() == [1.0, 22.381989]


def test_biarcs_between_points_with_directions_two_arcs_of_circles() -> None:
    """Biarcs between points with directions: two arcs of circles each, many at once."""
    found = biarcs([[0, 0]], np.radians([60]), [[10, 0]], np.radians([-30]))
    assert (found.kind.tolist(), (1 / np.abs(found.arcs.curvature)).round(6).tolist()) == (
        ["C"],
        [2.41181, 11.248444],
    )
    assert found.arcs.ends()[1].round(12).tolist() == [10.0, 0.0]


def test_camber_of_decks_hatches_and_deck_houses_by_its() -> None:
    """Camber of decks, hatches and deck houses by its rise from the side to the centre line."""
    deck = Camber.make([0, 100], 15, 18, 0.45, "parabola")
    assert (round(float(deck.height(50, 6)), 9), round(float(deck.area(50)), 9)) == (18.378, 9.0)


def test_camber_by_the_drop_below_the_centre_line() -> None:
    """Camber by the drop below the centre line, in four kinds."""
    kinds = [CamberKind.make(1, 15.0, 0.5), CamberKind.make(2, 15.0, 0.5, joint=6.0)]
    kinds += [CamberKind.make(3, 15.0, 0.5), CamberKind.make(4, 15.0, 0.5, joint=5.0)]
    assert [float(each.drop(9.0).round(12)) for each in kinds] == [0.18, 0.25, 0.3, 0.2]


def test_what_every_classical_curve_asks_of_its_input_finite() -> None:
    """What every classical curve asks of its input: finite numbers, in the shape that is
    wanted."""
    assert finite_array([[0, 1], [2, 3]], "biarc", (None, 2)).shape == (2, 2)


def test_words_and_signs_that_a_curve_is_told() -> None:
    """Words and signs that a curve is told by: one of a few, or an error that names them."""
    assert one_of("line", ("line", "parabola"), "camber: kind is") == "line"


def test_input_of_a_size_that_arithmetic_can_bear_whole() -> None:
    """Input of a size that arithmetic can bear, whole numbers, lists and mappings, or an
    error."""
    assert numbers([1, 1e-200], "offsets", (None,)).tolist() == [1.0, 0.0]


def test_the_mechanical_spline_a_batten_on_supports_its_deflection() -> None:
    """The mechanical spline: a batten on supports, its deflection measured from each chord."""
    batten = ChordSpline.through([(0, 0), (2, 1), (4, 1.5), (7, 1.2), (9, 0)])
    assert batten.angles.round(6).tolist() == [0.510755, 0.369641, 0.126623, -0.37858, -0.621872]


def test_pieces_of_plane_curves_whose_two_coordinates_are_quadratic() -> None:
    """Pieces of plane curves whose two coordinates are quadratic in the length along their
    chord."""
    side = Quadratics.over([(7.5, 0), (11, 0.8), (13.5, 2.5)], [0.0, 0.0])
    assert (round(side.area(), 9), round(side.area_below(0.8), 9)) == (28.225, 7.4)


def test_the_rounded_corner_between_the_side_of_a_frame() -> None:
    """The rounded corner between the side of a frame and the camber of its deck."""
    corner = deck_corner(15.0, 14.0, 0.4, 1.0)
    assert [round(each, 8) for each in (*corner.deck_point, corner.centre[1])] == [
        14.04989296,
        14.04906757,
        13.050313,
    ]


def test_the_points_of_a_frame_in_order() -> None:
    """The points of a frame in order: from the bottom past waterlines and knuckles to the deck
    side."""
    water, knuckle = np.array([[5.0, 1.0], [7.0, 6.0]]), np.array([[6.0, 3.0]])
    runs = frame_runs(np.zeros(2), water, knuckle, np.array([7.5, 8.0]), "frame x=20")
    assert [each.points[:, 1].tolist() for each in runs] == [[0.0, 1.0, 3.0], [3.0, 6.0, 8.0]]


def test_how_far_the_pieces_of_a_frame_bend_between() -> None:
    """How far the pieces of a frame bend between given points: means of parabolas with
    neighbours."""
    run = [(7.5, 0), (11, 0.8), (13.5, 2.5), (14.8, 5), (15, 9), (15, 14)]
    assert run_bends(run)[0].round(9).tolist() == [
        0.121976048,
        0.159228229,
        0.169230056,
        0.075314789,
        0.011111111,
    ]


def test_a_frame_the_section_of_a_hull_where_its() -> None:
    """A frame: the section of a hull where its longitudinal lines are cut at one x."""
    side = [(11, 0.8), (13.5, 2.5), (14.8, 5), (15, 9)]
    frame = FrameSection.make(20.0, side, deck_side=(15, 14), flat=7.5)
    assert (round(frame.area(9.0) / 2, 5), round(frame.largest_jump, 5)) == (124.76609, 0.1275)


def test_a_sheer_of_straight_lines_in_the_centre_line() -> None:
    """A sheer of straight lines in the centre-line plane."""
    sheer = Sheer.make([(-60, 2.2), (-30, 0.6), (0, 0), (30, 0.9), (60, 3.4)])
    assert (float(sheer.at(42.0).round(12)), float(sheer.mean(-50.0, -30.0).round(9))) == (
        1.9,
        1.133333333,
    )


def test_a_deck_a_height_at_the_centre_line_sheer() -> None:
    """A deck: a height at the centre line, sheer along and camber across."""
    sheer = Sheer.make([(-60, 2.2), (-30, 0.6), (0, 0), (30, 0.9), (60, 3.4)])
    deck = Deck.make(1, 12.5, sheer, CamberKind.make(1, 15.0, 0.5))
    assert deck.at([42.0, 0.0, -30.0], [9.0, 0.0, 0.0]).round(12).tolist() == [14.22, 12.5, 13.1]


def test_a_deck_house_a_block_on_a_deck_its() -> None:
    """A deck house: a block on a deck, its roof parallel to it."""
    sheer = Sheer.make([(-60, 2.2), (-30, 0.6), (0, 0), (30, 0.9), (60, 3.4)])
    deck = Deck.make(1, 12.5, sheer, CamberKind.make(1, 15.0, 0.5))
    house = DeckHouse.make([deck], 1, (-50, -30), breadth=12.0, height=2.6)
    assert (house.volume, house.profile_area, round(house.centroid[2], 8)) == (
        624.0,
        52.0,
        14.90666667,
    )


def test_the_elastica_a_thin_rod_bent_by_forces() -> None:
    """The elastica: a thin rod bent by forces at its ends, in closed form by elliptic
    integrals."""
    rod = Elastica.make(k=0.6, phi0=-0.4, phi1=1.9)
    assert (round(rod.length, 9), rod.frame_point(1.9).round(9).tolist()) == (
        2.562086709,
        [1.598496575, 1.493220673],
    )


def test_elastica_through_two_points_with_given_tangents_free_length() -> None:
    """Elastica through two points with given tangents: free length, modulus or length given."""
    rod = fit_elastica([0, 0], [1, 0], 0.5, -0.3)
    assert (round(rod.length, 9), round(rod.energy, 9)) == (1.028556519, 0.736516918)


def test_the_keel_of_a_ship_its_contour() -> None:
    """The keel of a ship: its contour in the centre plane, and the edge of the flat of bottom."""
    keel = KeelOutline.make(
        10,
        120,
        [(0, 8), (5, 3), (10, 0)],
        [(120, 0), (126, 1.5), (130, 9)],
        [(10, 0), (30, 7.5), (90, 7.5), (120, 0)],
    )
    assert (keel.part([7, 20, 128]).tolist(), keel.height([7, 20, 128]).round(9).tolist()) == (
        [1, 2, 3],
        [1.8, 0.0, 5.25],
    )
    assert keel.flat(20).tolist() == 3.75


def test_a_deck_side_or_knuckle_line_through_points_each() -> None:
    """A deck side or knuckle line through points, each interval with its own way to
    interpolate."""
    line = CodedKnuckleLine.make([0, 10, 25, 40], [5, 8, 9.5, 9], [1, 4, 1])
    assert line.at([5, 16]).round(9).tolist() == [6.5, 8.936]


def test_a_curve_in_space_through_given_points_straight_between() -> None:
    """A curve in space through given points: straight between them, or a natural spline."""
    points = [(0, 0, 0), (3, 1, 0.5), (6, 3, 2), (8, 6, 5)]
    assert SpaceCurve.make(points).where(0, 5.0).round(9).tolist() == [[5.0, 2.333333333, 1.5]]
    assert SpaceCurve.make(points, kind="spline").where(0, 5.0).round(9).tolist() == [
        [5.0, 2.149786509, 1.296796321]
    ]


def test_the_curve_that_simpsons_first_rule_integrates_a_parabola() -> None:
    """The curve that Simpson's first rule integrates: a parabola on each pair of equal steps."""
    curve = PairedParabolas.make("areas", 0.0, 8.0, [120, 160, 185, 190, 178])
    assert (round(curve.integral(), 6), round(curve.moment() / curve.integral(), 8)) == (
        5514.666667,
        16.91295938,
    )


def test_the_area_of_a_section_of_ordinates_below_any() -> None:
    """The area of a section of ordinates below any height, in closed form."""
    side = PairedParabolas.make("side", 0.0, 2.0, [3, 3, 3])
    assert round(area_below(None, side, 1.5, 0.0), 12) == 4.5


def test_a_section_of_a_ship_given_directly_heights() -> None:
    """A section of a ship given directly: heights on buttocks below, half-breadths on
    waterlines above."""
    section = OrdinateSection.make(
        hb=0.9,
        sb=3,
        sw=2,
        hd=12.4,
        bd=15.2,
        cam=0.4,
        zb=[0, 0.02, 0.10, 0.31, 0.80],
        yw=[12.3, 14.2, 14.8, 15, 15.1, 15.2, 15.2],
    )
    assert (round(section.area, 7), section.form) == (363.0914583, "bottom+main+camber")


def test_pieces_of_a_waterline_the_cubic_yx_the_level() -> None:
    """Pieces of a waterline: the cubic y(x), the level line, the batten bent over its chords."""
    piece = GraphPiece.through(np.array([[0.0, 0.0], [2.0, 1.0]]), (None, 0.0))
    assert piece.of(np.array([0.0, 2.0]), 1).round(9).tolist() == [0.75, 0.0]


def test_a_waterline_with_end_points_of_its_own() -> None:
    """A waterline with end points of its own and a parallel part: two splines and a line
    between."""
    run = [(0, 0), (5, 5.1), (12, 10.2), (20, 13.6), (30, 15), (50, 15)]
    line = ParallelWaterline.make(6.0, run, parallel=(30, 50), method="graph")
    assert (round(float(line.at(8)), 8), line.slope([30, 40]).round(9).tolist()) == (
        7.58802432,
        [0.0, 0.0],
    )

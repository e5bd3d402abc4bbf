"""What the parts of `creation.classical` give, one small example of each."""

from __future__ import annotations

from assoc_hull.creation.classical.line_outline import (
    PlaneOutline,
    point_kinds_along,
    straight_piece,
)
from assoc_hull.creation.classical.middle_body import Midship
from assoc_hull.creation.classical.prelikon import (
    MAIN_TYPES,
    Prelikon,
    integrate_along,
    require_types,
)
from assoc_hull.creation.classical.prelikon_lines import Station, outline_pieces
from assoc_hull.creation.classical.seaking_parts import MidshipSection
from assoc_hull.creation.classical.sfolds import Sfolds
from assoc_hull.creation.classical.sfolds_portion import Portion
from assoc_hull.geometry.classical.arc_curve import round_corners, through_points
from assoc_hull.geometry.classical.ordinate_section import OrdinateSection
from assoc_hull.model.tables import Particulars


def test_the_main_types_of_a_prelikon_job() -> None:
    """The main types of a PRELIKON job, and which of them needs which."""
    assert (MAIN_TYPES[5], require_types({5, 1})) == ("transverse sections", (1, 5))


def test_volumes_and_centres_of_a_hull_of_sections_exact() -> None:
    """Volumes and centres of a hull of sections: exact areas, parabolas along the ship."""
    found = integrate_along([0.0, 8.0, 16.0, 24.0, 32.0], [120.0, 160.0, 185.0, 190.0, 178.0])
    assert (round(found.total, 6), round(found.moment / found.total, 8)) == (
        5514.666667,
        16.91295938,
    )


def test_a_ship_by_main_types_sections_of_lines() -> None:
    """A ship by main types: sections of lines and arcs, decks, boundaries, boxes and deck
    houses."""
    bilge = through_points(
        [(0, 0), (8, 0), (10, 2), (10, 9)], kind=["line", "arc", "line"], radius=[None, 2.0, None]
    )
    body = Prelikon.make(
        Particulars("Body", 40, 20, 9, 6), [Station(x, bilge) for x in (0.0, 20.0, 40.0)]
    )
    assert round(body.volume_below(6.0).volume, 6) == 4731.327412


def test_the_midship_section_of_a_half_breadth_a_flat() -> None:
    """The midship section of a half-breadth, a flat of bottom, a rise of floor and a bilge
    radius."""
    midship = Midship(16.0, 2.0, 0.3, 2.5)
    assert (round(midship.area(9.0), 7), round(midship.most_radius, 8)) == (
        281.2485565,
        14.30649744,
    )


def test_how_a_line_through_given_points_passes_each() -> None:
    """How a line through given points passes each of them: straight runs stay straight."""
    kinds, _ = point_kinds_along(
        [[0, 0, 5], [10, 0, 1], [20, 0, 0], [30, 0, 0], [40, 0, 0]], corner=30.0
    )
    # tangent where the level keel begins
    assert kinds.tolist() == [0, 0, 1, 0, 0]


def test_a_plane_curve_of_pieces_as_the_points() -> None:
    """A plane curve of pieces as the points of a line: straight, circular, smooth through
    points."""
    box = PlaneOutline.of([straight_piece((0, 0), (8, 0)), straight_piece((8, 0), (8, 6))])
    assert (box.points.tolist(), box.kind.tolist()) == (
        [[0.0, 0.0], [8.0, 0.0], [8.0, 6.0]],
        [0, 2, 0],
    )
    assert box.section("FR 20", 20.0).points[1].tolist() == [20.0, 8.0, 0.0]


def test_the_pieces_of_a_curve_of_lines_and_arcs() -> None:
    """The pieces of a curve of lines and arcs, as an outline of the net takes them."""
    bilge = round_corners([(0, 0), (10, 0), (10, 9)], radius=[2.5])
    assert [len(each.points) for each in outline_pieces(bilge)] == [2, 13, 2]


def test_sections_of_a_ship_by_boundary_data() -> None:
    """Sections of a ship by boundary data, as the net and the report need them."""
    assert (
        round(float(MidshipSection.make(50.0, Midship(16.0, 2.0, 0.3, 2.5), 14.0).area(9.0)), 7)
        == 281.2485565
    )


def test_a_ship_of_portions_each_a_row_of_sections() -> None:
    """A ship of portions, each a row of sections given by ordinates."""
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
    middle = Portion.make(3, [0, 8, 16, 24, 32], [section] * 5)
    ship = Sfolds.make(Particulars("Body", 32, 30.4, 12.4, 9), [middle])
    assert round(ship.volume, 4) == 11618.9267

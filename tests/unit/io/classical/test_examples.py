"""What the parts of `io.classical` give, one small example of each."""

from __future__ import annotations

from assoc_hull.io.classical.cards import read_cards, read_origin, read_particulars
from assoc_hull.io.classical.prelikon import (
    PrelikonUnits,
    read_boundary,
    read_decks,
    read_prelikon,
    read_units,
)


def test_principal_dimensions_in_the_texts_of_definitions_a_card() -> None:
    """Principal dimensions in the texts of definitions: a card each."""
    text = "SFOLDS Ferry\nlength 90\nbreadth 16\ndepth 9\ndraught 6\ndeck closed"
    assert (
        repr(read_particulars(read_cards(text, "a.txt"))) == "Particulars(name='Ferry', "
        "length=90.0, breadth=16.0, depth=9.0, draught=6.0, deck='closed')"
    )


def test_where_x_is_counted_from_texts_may_count() -> None:
    """Where x is counted from: texts may count from midship, the kernel counts from AP."""
    origin = read_origin(read_cards("SFOLDS Ferry\norigin midship", "a.txt"), 120.0)
    assert (float(origin.moved(-12.0)), origin.notes) == (
        48.0,
        ("x counted from midship was moved by +60 m: x is now from AP",),
    )


def test_unit_base_line_and_origin_of_a_text() -> None:
    """Unit, base line and origin of a text of main types: what its numbers mean in metres from
    AP."""
    units = read_units(read_cards("PRELIKON Body\nunit mm\nbase 500", "a.txt"))
    assert (units.height(2500.0), units.notes[1]) == (
        2.0,
        "heights counted from 0.5 m below the base line were lowered by as much",
    )


def test_sections_and_boundary_curves_in_texts_of_main_types() -> None:
    """Sections and boundary curves in texts of main types: rows of points, lines and arcs
    between."""
    cards = read_cards("PRELIKON A\nboundary stem fillet\n0 0\n10 0 2.5\n12 6\n", "a.txt")
    assert len(read_boundary(cards.one("boundary"), PrelikonUnits(shift=60.0)).curve.arcs) == 3


def test_sheer_camber_decks_boxes_deck_houses_and_space_curves() -> None:
    """Sheer, camber, decks, boxes, deck houses and space curves in texts of main types."""
    text = """PRELIKON A
    sheer 1
    -60 2.2
    60 3.4
    camber 1 kind=1 b=15 c=0.5
    deck 1 height=12.5 sheer=1 camber=1
    """
    (deck,) = read_decks(read_cards(text, "a.txt"), PrelikonUnits(shift=60.0))
    assert (deck.sheer.range, round(float(deck.at(0.0, 9.0)), 9)) == ((0.0, 120.0), 14.52)


def test_texts_of_ships_of_main_types_a_card() -> None:
    """Texts of ships of main types: a card for each sheer, camber, deck, section and so on."""
    text = """PRELIKON Body
    length 40
    breadth 20
    depth 9
    draught 6
    section -20
    0 0 line
    8 0 arc 2
    10 2 line
    10 9
    section 20
    0 0 line
    8 0 arc 2
    10 2 line
    10 9
    """
    ship = read_prelikon(read_cards(text, "body.txt"))
    assert ([each.x for each in ship.stations], round(ship.volume_below(6.0).volume, 6)) == (
        [0.0, 40.0],
        4731.327412,
    )
    assert ship.notes == ("x counted from midship was moved by +20 m: x is now from AP",)

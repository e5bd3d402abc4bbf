"""Texts of ships of main types: every card, every unit, every complaint."""

from __future__ import annotations

import contextlib
import random

import numpy as np
import pytest

from assoc_hull.creation.classical.prelikon import Prelikon
from assoc_hull.errors import AssocHullError, BadInputError, GeometryError
from assoc_hull.io.classical.cards import read_cards
from assoc_hull.io.classical.prelikon import read_prelikon
from assoc_hull.shipped.classical_ships import classical_text

SECTION = "0 0 line\n8 0 arc 2\n10 2 line\n10 12\n"
BODY = f"""PRELIKON "A body"
length 40
breadth 20
depth 9
draught 6
sheer 1
-20 0
20 0.4
camber 1 kind=1 b=10 c=0.5
deck 1 height=9.5 sheer=1 camber=1
section -20
{SECTION}section 20
{SECTION}box keel sign=-1 sides=2
-5 5
1 2
-1 0
house "deck house" deck=1 breadth=8 height=2.5 from=-12 to=-4
curve belt
-20 10 7
20 10 7
waterlines 1 4 7
buttocks 4 8
"""


def ship(text: str = BODY) -> Prelikon:
    """The ship of a text."""
    return read_prelikon(read_cards(text, "body.txt"))


def changed(old: str, new: str) -> str:
    """The text with a part of it replaced."""
    assert old in BODY
    return BODY.replace(old, new, 1)


def test_a_text_gives_all_main_types() -> None:
    """x from AP, z from the base line, the deck closed, cuts as given; what was moved is told."""
    found = ship()
    assert [each.x for each in found.stations] == [0.0, 40.0]
    assert (found.particulars.name, found.particulars.deck) == ("A body", "closed")
    assert found.cuts == {"waterlines": (1.0, 4.0, 7.0), "buttocks": (4.0, 8.0)}
    (box,), (house,), (deck,), (curve,) = found.boxes, found.houses, found.decks, found.curves
    assert (box.x, box.volume, box.symmetric) == ((15.0, 25.0), -20.0, True)
    assert (house.x, house.volume) == ((8.0, 16.0), 160.0)
    assert float(deck.at(40.0, 10.0)) == pytest.approx(9.4, rel=1e-14)
    assert curve.points[0].tolist() == [0.0, 10.0, 7.0]
    assert found.notes[0] == "x counted from midship was moved by +20 m: x is now from AP"


def test_a_text_may_count_from_the_after_perpendicular() -> None:
    """Nothing is moved then, nothing told."""
    text = changed("sheer 1", "origin ap\nsheer 1").replace("-20", "0")
    text = text.replace("-12 to=-4", "8 to=16")
    assert ship(text).stations[1].x == 20.0
    assert not any("moved" in note for note in ship(text).notes)


@pytest.mark.parametrize(("unit", "metres"), [("mm", 1e-3), ("ft", 0.3048)])
def test_units_and_a_base_line_change_nothing_but_numbers(unit: str, metres: float) -> None:
    """The same ship in other units, its heights from elsewhere: the same volumes."""
    text = f"""PRELIKON Body
length {40 / metres}
breadth {20 / metres}
depth {9 / metres}
draught {6 / metres}
unit {unit}
base {-0.5 / metres}
"""
    corners = ((0, 0, "line"), (8, 0, f"arc {2 / metres}"), (10, 2, "line"), (10, 9, ""))
    for x in (-20, 20):
        text += f"section {x / metres}\n"
        text += "".join(f"{y / metres} {(z - 0.5) / metres} {w}\n" for y, z, w in corners)
    found = ship(text)
    wanted = 40.0 * 2.0 * (60.0 - (1.0 - 0.25 * np.pi) * 4.0)
    assert found.volume_below(6.0).volume == pytest.approx(wanted, rel=1e-10)
    assert found.particulars.draught == pytest.approx(6.0)
    assert f"lengths were multiplied by {metres:g}: they are now in m" in found.notes
    assert "heights counted from 0.5 m above the base line were raised by as much" in found.notes


def test_points_say_what_runs_on_from_them() -> None:
    """Fillets, mean circles, knuckles, boundaries in other planes, cambers through points."""
    text = changed(SECTION, "0 0\n10 0 2\n10 12\n").replace("section -20", "section -20 fillet")
    assert ship(text).volume_below(6.0).volume == pytest.approx(
        ship().volume_below(6.0).volume, rel=1e-12
    )
    circles = changed(SECTION, "0 0\n6 0.5\n9 3 arc knuckle\n10 12\n")
    assert ship(circles).stations[0].curve.knuckles == {2}
    text = changed("curve", "boundary buttock y=3\n-20 0 line\n20 0\ncurve")
    assert ship(text).boundaries[0].y == 3.0
    camber = changed("camber 1 kind=1 b=10 c=0.5", "camber 1 kind=3\n0 0\n5 0.1\n10 0.5")
    assert ship(camber).decks[0].camber.reading == "half"


BAD = {
    "unknown card": ("section -20", "rudder 1\nsection -20", BadInputError, "'rudder' is no card"),
    "no sections": ("section -20", "waterlines2", BadInputError, "'waterlines2' is no card"),
    "no depth": ("depth 9\n", "", BadInputError, "the card depth is missing"),
    "no sheer": ("sheer 1\n-20 0\n20 0.4\n", "", GeometryError, "main type 4 needs main type 2"),
    "no camber": (
        "camber 1 kind=1 b=10 c=0.5\n", "", GeometryError, "main type 4 needs main type 3"
    ),
    "no deck": (
        "deck 1 height=9.5 sheer=1 camber=1\n", "", GeometryError, "main type 8 needs main type 4"
    ),
    "other sheer": ("sheer=1", "sheer=2", BadInputError, "sheer 2 is not given"),
    "camber of no kind": ("kind=1", "kind=7", GeometryError, "camber: kind 7 not in 1..4"),
    "kind in words": ("kind=1", "kind=one", BadInputError, "kind is 'one'"),
    "camber without sizes": (" b=10 c=0.5", "", BadInputError, "camber lacks b, c"),
    "deck without height": ("height=9.5 ", "", BadInputError, "deck lacks height"),
    "two decks of a number": (
        "house", "deck 1 height=9 sheer=1 camber=1\nhouse", BadInputError, "deck 1 is given twice"
    ),
    "sheer with a word": ("sheer 1\n", "sheer 1 smooth\n", BadInputError, "sheer has the cell"),
    "sheer backward": ("20 0.4", "-20 0.4", GeometryError, "sheer: x not strictly increasing"),
    "section without a place": ("section 20", "section", BadInputError, "a section has no place"),
    "section of a mode": ("section 20", "section 20 spline", BadInputError, "section has 'spline'"),
    "short row": ("10 2 line", "10", BadInputError, "a row of section has 1 cell(s)"),
    "row of two kinds": ("8 0 arc 2", "8 0 arc line", BadInputError, "a row of section has"),
    "line with a radius": ("8 0 arc 2", "8 0 line 2", BadInputError, "a line of section has"),
    "radius in words": ("8 0 arc 2", "8 0 arc big", BadInputError, "'big'"),
    "radius too small": ("8 0 arc 2", "8 0 arc 1", GeometryError, "section: radius 1 smaller"),
    "fillet with a word": (
        "section 20", "section 20 fillet", BadInputError, "a corner of section has a word"
    ),
    "boundary without a name": (
        "box", "boundary\n0 0\nbox", BadInputError, "a boundary has no name"
    ),
    "two stems": (
        "box", "boundary stem\n20 0\n20 12\nboundary Stem\n20 0\n20 12\nbox", BadInputError,
        "boundary 'stem' is given twice",
    ),
    "stem of a point": (
        "box", "boundary stem\n20 0\nbox", GeometryError, "boundary stem: expected shape"
    ),
    "box reversed": ("1 2\n-1 0", "2 1\n-1 0", GeometryError, "appendage box: y limits reversed"),
    "box of two rows": ("1 2\n-1 0\n", "1 2\n", BadInputError, "box has 2 row(s)"),
    "box of four rows": ("-1 0\n", "-1 0\n3 4\n", BadInputError, "box has 4 rows"),
    "box of a sign": ("sign=-1", "sign=0", BadInputError, "sign is '0'"),
    "box without a name": ("box keel sign=-1", "box sign=-1", BadInputError, "a box has no name"),
    "house on no deck": ("deck=1", "deck=2", GeometryError, "deck house: unknown deck 2"),
    "house too wide": (
        "breadth=8", "breadth=20.5", GeometryError,
        "camber: y=10.25 beyond reference half-breadth 10",
    ),
    "house without end": (" to=-4", "", BadInputError, "house lacks to"),
    "curve of a kind": (
        "curve belt", "curve belt arc", GeometryError, "space curve: kind is 'arc'"
    ),
    "curve standing still": ("20 10 7\nwater", "20 10 7\n20 10 7\nwater", GeometryError,
                             "space curve: repeated point 2"),
    "unit": ("sheer 1", "unit yards\nsheer 1", BadInputError, "unit is 'yards'"),
    "base": ("sheer 1", "base low\nsheer 1", BadInputError, "'low'"),
    "origin": ("sheer 1", "origin bow\nsheer 1", BadInputError, "origin has 'bow'"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_a_text_that_is_wrong_is_refused_with_its_line(case: str) -> None:
    """What is wrong, and where: the line, or the text for what concerns all of it."""
    old, new, kind, message = BAD[case]
    with pytest.raises(AssocHullError) as caught:
        ship(changed(old, new))
    assert type(caught.value) is kind
    assert message in str(caught.value)
    assert "body.txt" in str(caught.value)


def test_texts_by_accident_end_in_an_error_of_the_family() -> None:
    """300 texts with a cell or a line changed, doubled or left out: a ship, or one clear error."""
    chance = random.Random(7)
    odd = [
        "",
        "nan",
        "inf",
        "-1",
        "0",
        "1e9",
        "arc",
        "line",
        "fillet",
        "a=b",
        '"',
        "1e-12",
        "kind=4",
    ]
    for _ in range(300):
        lines = [line.split(" ") for line in BODY.splitlines()]
        row = chance.choice(lines)
        act = chance.randrange(4)
        if act == 0:
            lines.remove(row)
        elif act == 1:
            lines.insert(chance.randrange(1, len(lines)), list(row))
        else:
            row[chance.randrange(len(row))] = chance.choice(odd)
        with contextlib.suppress(AssocHullError):
            ship("\n".join(" ".join(cells) for cells in lines))


def test_the_text_that_ships_says_where_x_begins() -> None:
    """Midship, and metres: it is read as it stands."""
    found = ship(classical_text("prelikon_ship"))
    assert found.stations[0].x == -3.0
    assert len(found.knuckles) == 1

"""Texts of ships by boundary data: what is read, and what is refused with its line."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.creation.classical.seaking import Seaking
from assoc_hull.errors import BadInputError, GeometryError
from assoc_hull.io.classical.cards import read_cards
from assoc_hull.io.classical.seaking import read_seaking

TEXT = """SEAKING "Test ship"
length 40
breadth 32
depth 14
draught 9
deck closed
keel 0 40
contour aft
-2 2
0 0
contour forward
40 0
40 14
tangent
0 12
40 12
midship 16 2 0.3 2.5 5 35
waterline 5 parallel=5,35 aft=-1.25,14 slope_forward=-0.1 method=graph
0 16
35 16
40 15
waterline 3 method=chord
-0.75 14
40 14.5
deckside
-2 16 14 1
40 16 14 0
knuckle shelf blend=overhauser
0 14 12 2
10 15 12 4
20 15 12 3
40 15 12 0
camber line
0 0.2
40 0.4
corner
0 0.5
5 0.5
appendage skeg at=-1,3 sides=1
0 0 0 1
1 0 1 1
1 2 1 2
appendage tunnel at=5,8,11 sign=-1
0 0 0 0 0 0
1 0 2 0 1 0
1 1 2 1 1 1
0 1 0 1 0 1
frames -1 2
10 20 30
buttocks 3 9
"""


def read(text: str = TEXT) -> Seaking:
    """The ship of a text."""
    return read_seaking(read_cards(text, "ship.txt"))


def changed(old: str, new: str) -> str:
    """The text with one thing changed."""
    assert old in TEXT
    return TEXT.replace(old, new, 1)


def where(card: str) -> str:
    """The line that a card stands on, or the text."""
    lines = [i for i, each in enumerate(TEXT.splitlines(), 1) if each.startswith(card)]
    return f"line {lines[0]} of ship.txt" if lines else "ship.txt"


def test_every_card_is_read() -> None:
    """With its cells and its rows; waterlines in order of their heights."""
    ship = read()
    assert (ship.particulars.name, ship.particulars.deck) == ("Test ship", "closed")
    assert ship.ends == (-2.0, 40.0)
    assert [each.z for each in ship.waterlines] == [3.0, 5.0]
    assert ship.waterlines[1].points[:, 0].tolist() == [-1.25, 0, 5, 35, 40]
    assert float(ship.waterlines[1].slope(40)) == pytest.approx(-0.1)
    assert ship.parallel is not None
    assert (ship.parallel.first, ship.parallel.last) == (5.0, 35.0)
    assert ship.deck.code.tolist() == [1]
    assert (ship.knuckles[0].name, ship.knuckles[0].line.blend) == ("shelf", "overhauser")
    assert ship.camber.kind == "line"
    assert ship.camber.at(20.0) == pytest.approx((0.2 + 0.2 * 20 / 40, 0.0))
    assert ship.camber.at(2.0)[1] == 0.5
    assert [each.name for each in ship.appendages] == ["skeg", "tunnel"]
    assert ship.appendages[0].volume == pytest.approx(3.0)
    assert ship.appendages[1].volume < 0.0
    assert ship.frames.tolist() == [-1, 2, 10, 20, 30]
    assert ship.buttocks == (3.0, 9.0)


def test_x_from_midship_is_moved_to_ap_with_a_note() -> None:
    """All of it: the two ships are one."""
    ship = read()
    moved = read(shifted(TEXT, 20.0).replace("keel", "origin midship\nkeel", 1))
    assert moved.notes[0] == "x counted from midship was moved by +20 m: x is now from AP"
    assert moved.notes[1:] == ship.notes
    assert moved.frames.tolist() == ship.frames.tolist()
    x = np.linspace(-2, 40, 13)
    assert moved.areas(x).tolist() == pytest.approx(ship.areas(x).tolist(), rel=1e-12)
    for one, other in zip(moved.appendages, ship.appendages, strict=True):
        assert one.body.x.tolist() == other.body.x.tolist()


def shifted(text: str, by: float) -> str:
    """The text with every x less by so much."""
    found, card = [], ""
    for line in text.splitlines():
        words = line.split()
        if words[0][0].isalpha():
            card = words[0]
        elif card in ("contour", "tangent", "waterline", "deckside", "knuckle", "camber", "corner"):
            words[0] = f"{float(words[0]) - by:g}"
        if words[0] == "keel":
            words[1:] = [f"{float(each) - by:g}" for each in words[1:]]
        if words[0] == "midship":
            words[5:] = [f"{float(each) - by:g}" for each in words[5:]]
        if card == "frames":
            words = [each if each == "frames" else f"{float(each) - by:g}" for each in words]
        for i, each in enumerate(words):
            name, sign, value = each.partition("=")
            if sign and name in ("at", "parallel", "aft"):
                parts = value.split(",")
                count = 1 if name == "aft" else len(parts)
                parts[:count] = [f"{float(part) - by:g}" for part in parts[:count]]
                words[i] = name + sign + ",".join(parts)
        found.append(" ".join(words))
    return "\n".join(found)


def test_a_report_tells_volumes_and_centres_of_appendages() -> None:
    """With their sign; what is not in the net stands in a note."""
    report = read().report()
    assert report.figure("volume of skeg").value == pytest.approx(3.0)
    assert report.figure("centre of skeg, x").value == pytest.approx(-1 + 16 / 9)
    assert report.figure("volume of tunnel").value < 0.0
    assert "appendages are outlined beside the net: skeg, tunnel" in report.notes
    assert any(each.startswith("knuckle line 'shelf': is not looked at") for each in report.notes)


REFUSED = {
    "an unknown card": (changed("buttocks", "butlocks"), "'butlocks' is no card", "buttocks"),
    "no frames": (changed("frames -1 2\n10 20 30\n", ""), "the card frames is missing", "ship.txt"),
    "no contour aft": (
        changed("contour aft\n-2 2\n0 0\n", ""),
        "contour aft is missing",
        "ship.txt",
    ),
    "a contour of no side": (
        changed("contour aft", "contour"),
        "contour has the cells",
        "contour aft",
    ),
    "a contour twice": (
        changed("contour forward", "contour aft"),
        "contour has the",
        "contour forward",
    ),
    "a waterline without height": (
        changed("waterline 3 method=chord", "waterline"),
        "waterline has no height",
        "waterline 3",
    ),
    "a waterline of another method": (
        changed("method=chord", "method=best"),
        "method is 'best'",
        "waterline 3",
    ),
    "a pair of one": (changed("parallel=5,35", "parallel=5"), "parallel is '5'", "waterline 5"),
    "a cell that is no option": (
        changed("method=chord", "colour=red"),
        "waterline has the cell 'colour=red'",
        "waterline 3",
    ),
    "a knuckle without a name": (
        changed("knuckle shelf ", "knuckle "),
        "a knuckle has no name",
        "knuckle",
    ),
    "a camber of another kind": (changed("camber line", "camber arc"), "camber is 'arc'", "camber"),
    "an appendage without a name": (
        changed("appendage skeg ", "appendage "),
        "an appendage has no name",
        "appendage skeg",
    ),
    "an appendage without a place": (
        changed("at=-1,3 ", ""),
        "an appendage lacks at",
        "appendage skeg",
    ),
    "an appendage of three sides": (changed("sides=1", "sides=3"), "sides is 3", "appendage skeg"),
    "an appendage of three cells": (
        changed("0 0 0 1\n", "0 0 0\n"),
        "a row of appendage has 3 cell(s)",
        "appendage skeg",
    ),
    "a deck row without a code": (
        changed("-2 16 14 1", "-2 16 14"),
        "a row of deckside has 3 cell(s)",
        "-2 16 14 1",
    ),
    "a number that is none": (changed("frames -1", "frames -1x"), "'-1x' is no number", "frames"),
    "no draught": (changed("draught 9", "draught 0"), "draught is 0 m", "draught"),
    "a deck that is nothing": (
        changed("deck closed", "deck ajar"),
        "deck is 'ajar'",
        "deck closed",
    ),
}

IMPOSSIBLE = {
    "a keel in disorder": (
        changed("keel 0 40", "keel 40 0"),
        "contour: the level keel runs from",
        "keel",
    ),
    "a flat of bottom below nil": (
        changed("0 12\n40 12", "0 12\n40 -2"),
        "bottom tangent line: negative half-width at row 1",
        "keel",
    ),
    "a bilge too round": (
        changed("16 2 0.3 2.5", "16 2 0.3 25"),
        "midship: R=25 exceeds the limit",
        "midship",
    ),
    "a waterline that runs back": (
        changed("35 16\n40 15", "35 16\n34 15"),
        "waterline z=5: x not strictly increasing at row 2",
        "waterline 5",
    ),
    "a code that is none": (
        changed("-2 16 14 1", "-2 16 14 7"),
        "knuckle line: code 7 at interval 0",
        "deckside",
    ),
    "a blend that is none": (
        changed("blend=overhauser", "blend=more"),
        "knuckle line: blend is 'more'",
        "knuckle",
    ),
    "an appendage of no length": (
        changed("at=-1,3", "at=3,3"),
        "appendage: x must be strictly increasing",
        "appendage skeg",
    ),
    "half a sign": (changed("sign=-1", "sign=0.5"), "appendage: sign is 0.5", "appendage tunnel"),
    "a frame beyond the ends": (changed("frames -1", "frames -9"), "frames: x=-9", "ship.txt"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_text_that_is_not_of_its_form_is_refused(case: str) -> None:
    """In one line, with the line of the text."""
    text, message, place = REFUSED[case]
    with pytest.raises(BadInputError) as caught:
        read(text)
    assert message in str(caught.value)
    assert where(place) in str(caught.value)


@pytest.mark.parametrize("case", IMPOSSIBLE)
def test_numbers_of_no_curve_are_refused_with_the_line_of_their_card(case: str) -> None:
    """With the message of the curve itself."""
    text, message, place = IMPOSSIBLE[case]
    with pytest.raises(GeometryError) as caught:
        read(text)
    assert caught.value.what.startswith(message)
    assert where(place) in str(caught.value)

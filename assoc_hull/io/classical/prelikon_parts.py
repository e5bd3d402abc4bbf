r"""Sheer, camber, decks, boxes, deck houses and space curves in texts of main types.

Examples
--------
>>> from assoc_hull.io.classical.cards import read_cards
>>> from assoc_hull.io.classical.prelikon_parts import read_decks
>>> from assoc_hull.io.classical.prelikon_units import Units
>>> text = '''PRELIKON A
... sheer 1
... -60 2.2
... 60 3.4
... camber 1 kind=1 b=15 c=0.5
... deck 1 height=12.5 sheer=1 camber=1
... '''
>>> (deck,) = read_decks(read_cards(text, "a.txt"), Units(shift=60.0))
>>> deck.sheer.range, round(float(deck.at(0.0, 9.0)), 9)
((0.0, 120.0), 14.52)
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.classical.appendage_box import AppendageBox
from assoc_hull.geometry.classical.camber_kinds import CamberKind
from assoc_hull.geometry.classical.deck_house import DeckHouse
from assoc_hull.geometry.classical.deck_surface import Deck
from assoc_hull.geometry.classical.sheer import Sheer
from assoc_hull.geometry.classical.space_curve import SpaceCurve
from assoc_hull.io.classical.cards import Card, Cards
from assoc_hull.io.classical.prelikon_units import Units, placed
from assoc_hull.io.lines.digitised_piece import read_number

__all__ = ["read_box", "read_curve", "read_decks", "read_house"]


def read_decks(cards: Cards, units: Units) -> tuple[Deck, ...]:
    """Read sheers and cambers by number, and the decks that are made of them.

    Raises
    ------
    BadInputError
        Cells that are not of their form, a number given twice, a sheer or camber that is not
        there.
    GeometryError
        Numbers of which no sheer or camber can be made; with the line of the text.
    """
    sheers = {n: _sheer(card, units) for n, card in _numbered(cards, "sheer").items()}
    cambers = {n: _camber(card, units) for n, card in _numbered(cards, "camber").items()}
    found = []
    for number, card in _numbered(cards, "deck").items():
        cells = _options(card, ("height", "sheer", "camber"), needed=("height", "sheer", "camber"))
        height = units.height(read_number(cells["height"], card.where))
        sheer = sheers[_known(cells["sheer"], "sheer", sheers, card)]
        camber = cambers[_known(cells["camber"], "camber", cambers, card)]
        found.append(Deck.make(number, height, sheer, camber))
    return tuple(found)


def read_box(card: Card, units: Units) -> AppendageBox:
    """Read an appendage: its name, then three rows of limits, x, y and z.

    Raises
    ------
    BadInputError
        Cells that are not of this form.
    GeometryError
        ``"appendage box: {axis} limits reversed"``; with the line of the text.
    """
    name = _name(card)
    cells = _options(card, ("sign", "sides"))
    rows = card.table(2, least=3)
    if len(rows) > 3:
        raise BadInputError(f"box has {len(rows)} rows", card.where, "give x, y and z")
    signs, sides = {"+1": 1, "1": 1, "-1": -1}, {"1": False, "2": True}
    for word, known in (("sign", signs), ("sides", sides)):
        if cells.get(word, "1") not in known:
            what = f"{word} is {shown(cells[word])}"
            raise BadInputError(what, card.where, f"use {' or '.join(known)}")
    x, y, z = rows * units.scale
    return placed(
        card,
        lambda: AppendageBox.make(
            x + units.shift, y, z - units.base, sign=signs[cells.get("sign", "1")],
            symmetric=sides[cells.get("sides", "1")], name=name,
        ),
    )  # fmt: skip


def read_house(card: Card, decks: Sequence[Deck], units: Units) -> DeckHouse:
    """Read a deck house: its name, deck, breadth and height, and where it begins and ends.

    Raises
    ------
    BadInputError
        Cells that are not of this form.
    GeometryError
        ``"deck house: unknown deck {n}"``, sizes that are not above 0; with the line of the
        text.
    """
    name = _name(card)
    words = ("deck", "breadth", "height", "from", "to")
    cells = _options(card, words, needed=words)
    deck = _whole(cells["deck"], "deck", card)
    breadth, height, low, high = (
        units.scale * read_number(cells[word], card.where) for word in words[1:]
    )
    ends = (low + units.shift, high + units.shift)
    return placed(
        card,
        lambda: DeckHouse.make(decks, deck, ends, breadth=breadth, height=height, name=name),
    )


def read_curve(card: Card, units: Units) -> SpaceCurve:
    """Read a space curve: its name, spline or polyline, and rows of x, y and z.

    Raises
    ------
    BadInputError
        Cells that are not of this form.
    GeometryError
        ``"space curve: repeated point {i}"``; with the line of the text.
    """
    name = _name(card)
    kind = " ".join(card.cells[1:]).lower() or "polyline"
    points = units.places(card.table(3), "xyz")
    return placed(card, lambda: SpaceCurve.make(points, kind=kind, name=name))


def _sheer(card: Card, units: Units) -> Sheer:
    _options(card, ())
    rows = card.table(2) * units.scale
    rows[:, 0] += units.shift
    return placed(card, lambda: Sheer.make(rows))


def _camber(card: Card, units: Units) -> CamberKind:
    """Read a camber: kind and sizes, or rows of points on the half-breadth."""
    sizes = () if card.rows else ("b", "c")
    joint = () if card.rows else ("joint",)
    cells = _options(card, ("kind", "scale", *sizes, *joint), needed=("kind", *sizes))
    kind, scale = _whole(cells["kind"], "kind", card), cells.get("scale", "fixed")
    if card.rows:
        rows = card.table(2) * units.scale
        return placed(card, lambda: CamberKind.through(kind, rows, scale=scale))
    b, c, y = (
        units.scale * read_number(cells.get(word, "0"), card.where) for word in ("b", "c", "joint")
    )
    return placed(card, lambda: CamberKind.make(kind, b, c, joint=y, scale=scale))


def _numbered(cards: Cards, word: str) -> dict[int, Card]:
    """Give the cards of a word by the number behind it."""
    found: dict[int, Card] = {}
    for card in cards.every(word):
        number = _whole(card.cells[0] if card.cells else "", word, card)
        if number in found:
            raise BadInputError(f"{word} {number} is given twice", card.where, "renumber one")
        found[number] = card
    return found


def _options(card: Card, known: Collection[str], needed: Collection[str] = ()) -> Mapping[str, str]:
    """Give the cells of the form name=text behind the first one; some are needed."""
    if not known and len(card.cells) > 1:
        what = f"{card.word} has the cell {shown(card.cells[1])}"
        raise BadInputError(what, card.where, "leave it out")
    found = card.options(known, first=1)
    missing = [word for word in needed if word not in found]
    if missing:
        what = f"{card.word} lacks {', '.join(missing)}"
        raise BadInputError(what, card.where, "add it as name=value")
    return found


def _whole(cell: str, what: str, card: Card) -> int:
    if not cell.isascii() or not cell.isdigit() or len(cell) > 4:
        remedy = "give a whole number from 0 to 9999"
        raise BadInputError(f"{what} is {shown(cell)}", card.where, remedy)
    return int(cell)


def _known(cell: str, word: str, known: Collection[int], card: Card) -> int:
    number = _whole(cell, word, card)
    if number not in known:
        there = ", ".join(str(each) for each in known) or "none"
        what = f"{word} {number} is not given"
        raise BadInputError(what, card.where, f"those given are: {there}")
    return number


def _name(card: Card) -> str:
    if not card.cells or "=" in card.cells[0]:
        what = f"a {card.word} has no name"
        raise BadInputError(what, card.where, "give it after the word")
    return card.cells[0]

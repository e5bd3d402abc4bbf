r"""Texts of ships of main types: a card for each sheer, camber, deck, section and so on.

Examples
--------
>>> from assoc_hull.io.classical.cards import read_cards
>>> from assoc_hull.io.classical.prelikon_text import read_prelikon
>>> text = '''PRELIKON Body
... length 40
... breadth 20
... depth 9
... draught 6
... section -20
... 0 0 line
... 8 0 arc 2
... 10 2 line
... 10 9
... section 20
... 0 0 line
... 8 0 arc 2
... 10 2 line
... 10 9
... '''
>>> ship = read_prelikon(read_cards(text, "body.txt"))
>>> [each.x for each in ship.stations], round(ship.volume_below(6.0).volume, 6)
([0.0, 40.0], 4731.327412)
>>> ship.notes
('x counted from midship was moved by +20 m: x is now from AP',)
"""

from __future__ import annotations

from collections.abc import Mapping

import attrs

from assoc_hull.arguments import shown
from assoc_hull.creation.classical.main_types import require_types
from assoc_hull.creation.classical.prelikon import Prelikon
from assoc_hull.errors import BadInputError, GeometryError
from assoc_hull.io.classical.cards import Cards
from assoc_hull.io.classical.dimensions import DIMENSIONS, read_particulars
from assoc_hull.io.classical.origin import read_origin
from assoc_hull.io.classical.prelikon_curves import read_boundary, read_section
from assoc_hull.io.classical.prelikon_parts import read_box, read_curve, read_decks, read_house
from assoc_hull.io.classical.prelikon_units import Units, read_units

__all__ = ["TYPES", "WORDS", "read_prelikon"]

TYPES: Mapping[str, int] = {
    **dict.fromkeys(DIMENSIONS, 1),
    "origin": 1,
    "base": 1,
    "unit": 1,
    "sheer": 2,
    "camber": 3,
    "deck": 4,
    "section": 5,
    "boundary": 6,
    "box": 7,
    "house": 8,
    "curve": 9,
}
"""The cards of main types, and the type of each."""

WORDS = (*TYPES, "waterlines", "buttocks")
"""All cards there are."""


def read_prelikon(cards: Cards) -> Prelikon:
    """Make a ship of main types of the cards of a text.

    Parameters
    ----------
    cards : Cards
        The text, as `read_cards` takes it apart. x is counted from midship unless it says else.

    Returns
    -------
    Prelikon
        x is counted from AP; a note says so where it was not.

    Raises
    ------
    BadInputError
        A card that is unknown, missing, given twice or not of its form.
    GeometryError
        ``"main type {t} is required"``, ``"main type {t} needs main type {u}"``; numbers of
        which nothing can be made; with the line of the text.
    """
    cards.require_known(WORDS)
    _require_types(cards)
    units = read_units(cards)
    # The word deck means something else in texts of other kinds.
    others = tuple(card for card in cards.cards if card.word != "deck")
    ship = read_particulars(attrs.evolve(cards, cards=others))
    scaled = attrs.evolve(
        ship, **{name: units.scale * getattr(ship, name) for name in DIMENSIONS},
        deck="closed" if cards.every("deck") else "open",
    )  # fmt: skip
    origin = read_origin(cards, scaled.length, "midship")
    units = attrs.evolve(units, shift=origin.shift)
    decks = read_decks(cards, units)
    stations = [read_section(card, units) for card in cards.every("section")]
    boundaries = [read_boundary(card, units) for card in cards.every("boundary")]
    boxes = [read_box(card, units) for card in cards.every("box")]
    houses = [read_house(card, decks, units) for card in cards.every("house")]
    curves = [read_curve(card, units) for card in cards.every("curve")]
    _require_one_each(cards, "boundary")
    try:
        return Prelikon.make(
            scaled, stations, decks=decks, boundaries=boundaries, boxes=boxes, houses=houses,
            curves=curves, cuts=_cuts(cards, units), notes=(*origin.notes, *units.notes),
        )  # fmt: skip
    except GeometryError as error:
        raise error.at(f"in {cards.source}") from None


def _require_types(cards: Cards) -> None:
    """Check main types before anything is made; the error names the text."""
    words = {card.word for card in cards.cards}
    try:
        require_types({TYPES[word] for word in words if word in TYPES})
    except GeometryError as error:
        raise error.at(f"in {cards.source}") from None


def _require_one_each(cards: Cards, word: str) -> None:
    """Check that no two cards have one name."""
    seen: dict[str, int] = {}
    for card in cards.every(word):
        name = card.cells[0].lower()
        if name in seen:
            what = f"{word} {shown(name)} is given twice"
            raise BadInputError(what, card.where, f"rename it: the first is at line {seen[name]}")
        seen[name] = card.line


def _cuts(cards: Cards, units: Units) -> dict[str, list[float]]:
    """Read where waterlines and buttocks cut the net."""
    found = {}
    for word, base in (("waterlines", units.base), ("buttocks", 0.0)):
        card = cards.maybe(word)
        if card is not None:
            given = card.numbers(len(card.cells))
            found[word] = [units.scale * value - base for value in given]
    return found

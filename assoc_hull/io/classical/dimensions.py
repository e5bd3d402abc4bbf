r"""Principal dimensions in the texts of definitions: a card each.

Examples
--------
>>> from assoc_hull.io.classical.cards import read_cards
>>> from assoc_hull.io.classical.dimensions import read_particulars
>>> text = "SFOLDS Ferry\nlength 90\nbreadth 16\ndepth 9\ndraught 6\ndeck closed"
>>> read_particulars(read_cards(text, "a.txt"))
Particulars(name='Ferry', length=90.0, breadth=16.0, depth=9.0, draught=6.0, deck='closed')
"""

from __future__ import annotations

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.io.classical.cards import Cards
from assoc_hull.model.state import Particulars

__all__ = ["DIMENSIONS", "read_particulars"]

DIMENSIONS = ("length", "breadth", "depth", "draught")
"""Cards of one number above 0, m; the length is that between perpendiculars."""


def read_particulars(cards: Cards) -> Particulars:
    """Read the four dimensions, and the card ``deck``, open or closed; without it open.

    Parameters
    ----------
    cards : Cards
        The text; its title is the name of the ship.

    Raises
    ------
    BadInputError
        A card that is missing, given twice, or holds something else.
    """
    sizes = []
    for word in DIMENSIONS:
        card = cards.one(word)
        (size,) = card.numbers(1)
        if size <= 0.0 or card.rows:
            what = f"{word} is {size:g} m" if size <= 0.0 else f"{word} has rows of numbers"
            raise BadInputError(what, card.where, "give one number above 0")
        sizes.append(size)
    length, breadth, depth, draught = sizes
    made = Particulars(cards.title, length, breadth, depth, draught)
    deck = cards.maybe("deck")
    if deck is None:
        return made
    word = " ".join(deck.cells).lower()
    if word not in ("open", "closed") or deck.rows:
        raise BadInputError(f"deck is {word!r}", deck.where, "let it be open or closed")
    return attrs.evolve(made, deck=word)

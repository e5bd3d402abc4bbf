r"""Texts of ships of portions: the sections by name, then which of them stand in each portion.

Examples
--------
>>> from assoc_hull.io.classical.cards import read_cards
>>> from assoc_hull.io.classical.sfolds import read_sfolds
>>> text = '''SFOLDS Body
... length 32
... breadth 30.4
... depth 12.4
... draught 9
... section middle hb=0.9 sb=3 sw=2 hd=12.4 bd=15.2 cam=0.4 nb=4 nw=7
... 0 0.02 0.10 0.31 0.80
... 12.3 14.2 14.8 15 15.1 15.2 15.2
... portion 3
... 0 middle
... 16 middle
... 32 middle
... '''
>>> round(read_sfolds(read_cards(text, "body.txt")).volume, 4)
11618.9267
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.creation.classical.sfolds import CORNER, Sfolds
from assoc_hull.creation.classical.sfolds_portion import Portion
from assoc_hull.errors import BadInputError, GeometryError
from assoc_hull.geometry.classical.ordinate_section import OrdinateSection
from assoc_hull.io.classical.cards import (
    DIMENSIONS,
    Card,
    CardRow,
    Cards,
    Origin,
    read_origin,
    read_particulars,
)
from assoc_hull.io.lines.raw_lines import read_number

__all__ = ["WORDS", "read_sfolds"]

WORDS = (*DIMENSIONS, "deck", "origin", "corner", "waterlines", "buttocks", "section", "portion")
"""The cards there are."""

_SIZES = ("hb", "sb", "sw", "hd", "bd", "cam")
_COUNTS = ("nb", "nw")


def read_sfolds(cards: Cards) -> Sfolds:
    """Make a ship of portions of the cards of a text.

    Parameters
    ----------
    cards : Cards
        The text, as `read_cards` takes it apart.

    Returns
    -------
    Sfolds
        x is counted from AP; a note says so where it was not.

    Raises
    ------
    BadInputError
        A card that is unknown, missing, given twice or not of its form.
    GeometryError
        Numbers of which no section, portion or ship can be made; with the line of the text.
    """
    cards.require_known(WORDS)
    ship = read_particulars(cards)
    origin = read_origin(cards, ship.length)
    sections = _sections(cards)
    portions = [_portion(card, sections, origin) for card in cards.every("portion")]
    if not portions:
        raise BadInputError("the card portion is missing", f"in {cards.source}", "add one or more")
    corner = cards.maybe("corner")
    angle = CORNER if corner is None else corner.numbers(1)[0]
    if corner is not None and angle < 0.0:
        raise BadInputError(f"corner is {angle:g}", corner.where, "give degrees from 0 on")
    cuts = {
        word: card.numbers(len(card.cells))
        for word in ("waterlines", "buttocks")
        if (card := cards.maybe(word)) is not None
    }
    try:
        return Sfolds.make(ship, portions, corner=angle, cuts=cuts, notes=origin.notes)
    except GeometryError as error:
        raise error.at(f"in {cards.source}") from None


def _sections(cards: Cards) -> dict[str, OrdinateSection]:
    """Read all sections, by name."""
    found: dict[str, OrdinateSection] = {}
    for card in cards.every("section"):
        if not card.cells or "=" in card.cells[0]:
            raise BadInputError("a section has no name", card.where, "give it after the word")
        name = card.cells[0]
        if name in found:
            raise BadInputError(f"section {shown(name)} is given twice", card.where, "rename one")
        found[name] = _section(card)
    return found


def _section(card: Card) -> OrdinateSection:
    """Read a section: eight values by name, then heights and half-breadths row by row."""
    cells = card.options((*_SIZES, *_COUNTS, "form"), first=1)
    missing = [name for name in (*_SIZES, *_COUNTS) if name not in cells]
    if missing:
        what = f"section {shown(card.cells[0])} lacks {', '.join(missing)}"
        raise BadInputError(what, card.where, "add it as name=value")
    sizes = {name: read_number(cells[name], card.where) for name in _SIZES}
    counts = {name: _whole(cells[name], name, card) for name in _COUNTS}
    values = [number for row in card.rows for number in _numbers(row, card)]
    heights = counts["nb"] + 1
    if len(values) != heights + counts["nw"]:
        what = f"section {shown(card.cells[0])} has {len(values)} ordinates"
        remedy = (
            f"give {heights} heights (nb + 1), then {counts['nw']} half-breadths (nw), in rows "
            "below it"
        )
        raise BadInputError(what, card.where, remedy)
    try:
        return OrdinateSection.make(
            **sizes, nb=counts["nb"], nw=counts["nw"], zb=values[:heights], yw=values[heights:],
            form=cells.get("form"),
        )  # fmt: skip
    except GeometryError as error:
        raise error.at(f"section {shown(card.cells[0])}, {card.where}") from None


def _whole(cell: str, name: str, card: Card) -> int:
    value = read_number(cell, card.where)
    if value != int(value) or not 0 <= value <= 1000:
        raise BadInputError(f"{name} is {cell}", card.where, "give a whole number from 0 to 1000")
    return int(value)


def _numbers(row: CardRow, card: Card) -> list[float]:
    where = f"at line {row.line} of {card.source}"
    return [read_number(cell, where) for cell in row.cells]


def _portion(card: Card, sections: Mapping[str, OrdinateSection], origin: Origin) -> Portion:
    """Read a portion: its number, then x and the name of a section in each row."""
    (number,) = card.numbers(1)
    if number != int(number):
        raise BadInputError(f"portion is {number:g}", card.where, "give the number of its kind")
    x, chosen = [], []
    for row in card.rows:
        where = f"at line {row.line} of {card.source}"
        if len(row.cells) != 2:
            what = f"a row of portion has {len(row.cells)} cell(s)"
            raise BadInputError(what, where, "give x and the name of a section")
        if row.cells[1] not in sections:
            what = f"there is no section {shown(row.cells[1])}"
            raise BadInputError(what, where, "give the name of a section card")
        x.append(read_number(row.cells[0], where))
        chosen.append(sections[row.cells[1]])
    try:
        return Portion.make(int(number), origin.moved(np.array(x)), chosen)
    except GeometryError as error:
        raise error.at(card.where) from None

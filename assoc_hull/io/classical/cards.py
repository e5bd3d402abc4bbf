r"""The text of classical definitions: cards with rows of numbers, and what all kinds share.

The first line names the kind of definition and the ship. A line that begins with a word is a card;
one that begins with a number is a row of the card above. All kinds have the principal dimensions
and may count x from midship, where the kernel counts from AP.

Examples
--------
>>> from assoc_hull.io.classical.cards import read_cards
>>> cards = read_cards('SEAKING "A ship"\nlength 40\ncontour aft  # x, z\n0 8\n5 3\n', "a.txt")
>>> cards.kind, cards.title, cards.one("length").numbers(1)
('SEAKING', 'A ship', (40.0,))
>>> cards.one("contour").table(2).tolist()
[[0.0, 8.0], [5.0, 3.0]]
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.io.lines.raw_lines import read_number
from assoc_hull.model.tables import Particulars

__all__ = [
    "DIMENSIONS",
    "KINDS",
    "ORIGINS",
    "Card",
    "CardRow",
    "Cards",
    "Origin",
    "kind_of",
    "read_cards",
    "read_origin",
    "read_particulars",
]

# --------------------------------------------------------------------------------------
# Cards. The first line names the kind of definition, and the ship. Then a line that begins with a
# word is a card: the word, cells after it. A line that begins with a number is a row of the card
# above it. Blank lines do not count; nor does what follows a ``#``. A cell of several words stands
# in quotes.

KINDS = ("SEAKING", "SFOLDS", "PRELIKON")
"""The first words of texts that are read."""

_CELL = re.compile(r'"([^"]*)"|(\S+)')
_NUMBER = re.compile(r"[-+]?\.?[0-9]")


@attrs.frozen
class CardRow:
    """A row of a card: its cells, and the line of the text it stands on, from 1."""

    cells: tuple[str, ...]
    line: int


@attrs.frozen
class Card:
    """A card.

    Attributes
    ----------
    word : str
        Its first word, in small letters.
    cells : tuple of str
        What follows on the same line.
    rows : tuple of CardRow
        The rows below it.
    line : int
        Of the text, from 1.
    source : str
        The text, for messages.
    """

    word: str
    cells: tuple[str, ...]
    rows: tuple[CardRow, ...]
    line: int
    source: str

    @property
    def where(self) -> str:
        """Where it stands, for messages."""
        return f"at line {self.line} of {self.source}"

    def numbers(self, count: int, first: int = 0) -> tuple[float, ...]:
        """Give exactly so many numbers from the cells, from the one numbered `first` on.

        Raises
        ------
        BadInputError
            Another count, or a cell that is no number.
        """
        cells = self.cells[first:]
        if len(cells) != count:
            what = f"{self.word} has {len(cells)} cell(s) where {count} number(s) are wanted"
            raise BadInputError(what, self.where, f"give {count}")
        return tuple(read_number(cell, self.where) for cell in cells)

    def options(self, known: Collection[str], first: int = 0) -> Mapping[str, str]:
        """Give cells of the form ``name=text``, from the one numbered `first` on.

        Raises
        ------
        BadInputError
            A cell of another form, a name that is not `known`, or one given twice.
        """
        found: dict[str, str] = {}
        for cell in self.cells[first:]:
            name, sign, value = cell.partition("=")
            if not sign or name not in known or name in found:
                remedy = f"give each once, as name=value: {', '.join(known)}"
                raise BadInputError(f"{self.word} has the cell {shown(cell)}", self.where, remedy)
            found[name] = value
        return found

    def table(self, columns: int, *, least: int = 0) -> FloatArray:
        """Give the rows as numbers, (n, columns), frozen.

        Raises
        ------
        BadInputError
            A row of another number of cells, a cell that is no number, fewer than `least` rows.
        """
        if len(self.rows) < least:
            what = f"{self.word} has {len(self.rows)} row(s)"
            raise BadInputError(what, self.where, f"give {least} or more below it")
        found = np.empty((len(self.rows), columns))
        for index, row in enumerate(self.rows):
            where = f"at line {row.line} of {self.source}"
            if len(row.cells) != columns:
                what = f"a row of {self.word} has {len(row.cells)} cell(s)"
                raise BadInputError(what, where, f"give {columns}")
            found[index] = [read_number(cell, where) for cell in row.cells]
        freeze(found)
        return found


@attrs.frozen
class Cards:
    """All cards of a text.

    Attributes
    ----------
    kind, title : str
        One of `KINDS`; the name of the ship.
    cards : tuple of Card
        In the order of the text.
    source : str
        The text, for messages.
    """

    kind: str
    title: str
    cards: tuple[Card, ...]
    source: str

    def require_known(self, known: Collection[str]) -> None:
        """Refuse cards of other words.

        Raises
        ------
        BadInputError
            The first of them.
        """
        for card in self.cards:
            if card.word not in known:
                remedy = f"use one of {', '.join(sorted(known))}"
                raise BadInputError(f"{shown(card.word)} is no card", card.where, remedy)

    def every(self, word: str) -> tuple[Card, ...]:
        """Give all cards of a word, none perhaps."""
        return tuple(card for card in self.cards if card.word == word)

    def maybe(self, word: str) -> Card | None:
        """Give the card of a word, or None.

        Raises
        ------
        BadInputError
            There are several.
        """
        found = self.every(word)
        if len(found) > 1:
            raise BadInputError(f"{word} is given twice", found[1].where, "leave one out")
        return found[0] if found else None

    def one(self, word: str) -> Card:
        """Give the card of a word.

        Raises
        ------
        BadInputError
            There is none, or there are several.
        """
        found = self.maybe(word)
        if found is None:
            raise BadInputError(f"the card {word} is missing", f"in {self.source}", "add it")
        return found


def kind_of(text: str) -> str | None:
    r"""Tell the kind of a definition by its first word, None if it is none.

    Examples
    --------
    >>> from assoc_hull.io.classical.cards import kind_of
    >>> kind_of("# a comment\nsfolds Ferry"), kind_of("x,y,z")
    ('SFOLDS', None)
    """
    for line in text.lstrip("\ufeff").splitlines():
        words = line.partition("#")[0].split(maxsplit=1)
        if words:
            return words[0].upper() if words[0].upper() in KINDS else None
    return None


def read_cards(text: str, source: str) -> Cards:
    """Split a text into cards; `source` is what it is called in messages.

    Raises
    ------
    BadInputError
        The first word is none of `KINDS`, or a row stands before the first card.
    """
    kind = kind_of(text)
    if kind is None:
        remedy = f"let its first word be {', '.join(KINDS[:-1])} or {KINDS[-1]}"
        raise BadInputError("the text is no classical definition", f"in {source}", remedy)
    lines = [
        (number, [quoted or bare for quoted, bare in _CELL.findall(line.partition("#")[0])])
        for number, line in enumerate(text.lstrip("\ufeff").splitlines(), start=1)
    ]
    head, *body = ((number, cells) for number, cells in lines if cells)
    found: list[tuple[str, tuple[str, ...], list[CardRow], int]] = []
    for number, cells in body:
        if not _NUMBER.match(cells[0]):
            found.append((cells[0].lower(), tuple(cells[1:]), [], number))
        elif found:
            found[-1][2].append(CardRow(tuple(cells), number))
        else:
            what = "a row of numbers stands before the first card"
            raise BadInputError(what, f"at line {number} of {source}", "begin with a word")
    cards = tuple(Card(word, cells, tuple(rows), k, source) for word, cells, rows, k in found)
    return Cards(kind, " ".join(head[1][1:]) or kind.title(), cards, source)


# --------------------------------------------------------------------------------------
# Principal dimensions: a card each.

DIMENSIONS = ("length", "breadth", "depth", "draught")
"""Cards of one number above 0, m; the length is that between perpendiculars."""


def read_particulars(cards: Cards) -> Particulars:
    """Read the four dimensions (m), and the card ``deck``, open or closed; without it open.

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


# --------------------------------------------------------------------------------------
# Where x is counted from. All readers of definitions use `read_origin` once, `Origin.moved` on
# every x, and `Origin.notes` among the notes of the definition.

ORIGINS = ("ap", "midship")
"""What the card ``origin`` may say."""


@attrs.frozen
class Origin:
    """Where x of a text begins.

    Attributes
    ----------
    shift : float, m
        What is added to x, so that it is counted from AP.
    """

    shift: float

    def moved(self, x: ArrayLike) -> FloatArray:
        """Give x (m) counted from AP, in the shape of `x`."""
        return np.asarray(np.asarray(x, np.float64) + self.shift)

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence, if x was moved."""
        if not self.shift:
            return ()
        return (f"x counted from midship was moved by {self.shift:+g} m: x is now from AP",)


def read_origin(cards: Cards, length: float, default: str = "ap") -> Origin:
    """Read the card ``origin``; `default`, one of `ORIGINS`, is what a text without it means.

    Raises
    ------
    BadInputError
        Another word on the card, or the card twice.
    """
    card = cards.maybe("origin")
    word = default
    if card is not None:
        word = " ".join(card.cells).lower()
        if word not in ORIGINS or card.rows:
            told = shown(word) if not card.rows else "rows of numbers"
            remedy = f"give {' or '.join(ORIGINS)}"
            raise BadInputError(f"origin has {told}", card.where, remedy)
    return Origin(0.5 * length if word == "midship" else 0.0)

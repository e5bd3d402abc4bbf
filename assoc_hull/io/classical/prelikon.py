"""Text files of ships of main types (PRELIKON): cards for sheer, camber, deck, section and so on.

Unit, base line and origin are read first (`PrelikonUnits`): they say what all other numbers mean in
metres, x from the AP and z from the base line. Errors of geometry name the line of the text.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import TypeVar

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.creation.classical.prelikon import Prelikon, require_types
from assoc_hull.creation.classical.prelikon_lines import Station
from assoc_hull.errors import BadInputError, GeometryError
from assoc_hull.geometry.classical.appendages import AppendageBox
from assoc_hull.geometry.classical.arc_curve import (
    ArcBoundary,
    ArcCurve,
    round_corners,
    through_points,
)
from assoc_hull.geometry.classical.boundary_lines import SpaceCurve
from assoc_hull.geometry.classical.camber import CamberKind
from assoc_hull.geometry.classical.checked_input import digits
from assoc_hull.geometry.classical.deck import Deck, DeckHouse, Sheer
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.classical.cards import (
    DIMENSIONS,
    Card,
    CardRow,
    Cards,
    read_origin,
    read_particulars,
)
from assoc_hull.io.lines.raw_lines import read_number

__all__ = [
    "TYPES",
    "UNITS",
    "WORDS",
    "PrelikonUnits",
    "make_on_card",
    "read_boundary",
    "read_box",
    "read_curve",
    "read_decks",
    "read_house",
    "read_prelikon",
    "read_section",
    "read_units",
]

# --------------------------------------------------------------------------------------
# Unit, base line and origin.

UNITS = {"m": 1.0, "mm": 1e-3, "ft": 0.3048}
"""Metres in the units that a text may be in."""

Made = TypeVar("Made")


@attrs.frozen
class PrelikonUnits:
    """How numbers of a text become metres, x from AP and z from the base line.

    Attributes
    ----------
    scale : float
        Metres in a unit.
    base : float, m
        Height of the base line in the text.
    shift : float, m
        Is added to x.
    """

    scale: float = 1.0
    base: float = 0.0
    shift: float = 0.0

    def height(self, z: float) -> float:
        """Give a height above the base line, m."""
        return self.scale * z - self.base

    def places(self, rows: FloatArray, axes: str) -> FloatArray:
        """Give rows of places, each column an axis: ``"xz"``, ``"yz"``, ``"xyz"``; m."""
        moves = {"x": self.shift, "y": 0.0, "z": -self.base}
        return np.asarray(rows * self.scale + np.array([moves[axis] for axis in axes]))

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences, if units or heights were changed."""
        found = []
        if self.scale != 1.0:
            found.append(f"lengths were multiplied by {self.scale:g}: they are now in m")
        if self.base:
            side, way = ("below", "lowered") if self.base > 0.0 else ("above", "raised")
            off = digits(abs(self.base))
            found.append(f"heights counted from {off} m {side} the base line were {way} by as much")
        return tuple(found)


def read_units(cards: Cards) -> PrelikonUnits:
    """Read the cards ``unit`` and ``base``; metres from the base line without them.

    Raises
    ------
    BadInputError
        Another unit, a height that is no number, or a card given twice.
    """
    scale, base = 1.0, 0.0
    unit, height = cards.maybe("unit"), cards.maybe("base")
    if unit is not None:
        word = " ".join(unit.cells).lower()
        if word not in UNITS or unit.rows:
            raise BadInputError(f"unit is {shown(word)}", unit.where, f"use {', '.join(UNITS)}")
        scale = UNITS[word]
    if height is not None:
        base = scale * height.numbers(1)[0]
    return PrelikonUnits(scale, base)


def make_on_card(card: Card, make: Callable[[], Made]) -> Made:
    """Make something of a card; an error of its geometry is reported with its line."""
    try:
        return make()
    except GeometryError as error:
        raise error.at(card.where) from None


# --------------------------------------------------------------------------------------
# Sections and boundary curves: rows of points, with what runs from each to the next.

_MODES = ("through", "fillet")


@attrs.frozen
class _Point:
    """A row: a point, and what runs from it to the next."""

    u: float
    v: float
    kind: str
    radius: float | None
    knuckle: bool


def read_section(card: Card, units: PrelikonUnits) -> Station:
    """Read a section: x behind the word, rows of y and z below.

    Raises
    ------
    BadInputError
        Cells that are not of this form.
    GeometryError
        Points of which no section can be made; with the line of the text.
    """
    if not card.cells:
        raise BadInputError("a section has no place", card.where, "give x after the word")
    x = units.scale * read_number(card.cells[0], card.where) + units.shift
    return Station(x, _curve(card, 1, units, "yz", "section"))


def read_boundary(card: Card, units: PrelikonUnits) -> ArcBoundary:
    """Read a boundary curve: its name behind the word, rows of x and z below.

    Raises
    ------
    BadInputError
        Cells that are not of this form.
    GeometryError
        Points of which no curve can be made; with the line of the text.
    """
    if not card.cells:
        raise BadInputError("a boundary has no name", card.where, "give it after the word")
    first, y = 1, 0.0
    if len(card.cells) > 1 and card.cells[1].startswith("y="):
        y = units.scale * read_number(card.cells[1][2:], card.where)
        first = 2
    name = card.cells[0].lower()
    return ArcBoundary(name, _curve(card, first, units, "xz", f"boundary {name}"), y)


def _curve(card: Card, first: int, units: PrelikonUnits, axes: str, name: str) -> ArcCurve:
    """Read a curve from the rows of a card; "through" or "fillet" may stand in its cells."""
    mode = " ".join(card.cells[first:]) or "through"
    if mode not in _MODES:
        what = f"{card.word} has {shown(mode)}"
        raise BadInputError(what, card.where, f"use {' or '.join(_MODES)}, or nothing")
    points = [_point(row, card) for row in card.rows]
    places = units.places(np.array([[p.u, p.v] for p in points]).reshape(-1, 2), axes)
    radius = [None if p.radius is None else units.scale * p.radius for p in points]
    if mode == "fillet":
        for point, row in zip(points, card.rows, strict=True):
            if point.kind == "line" or point.knuckle:
                where = f"at line {row.line} of {card.source}"
                what = f"a corner of {card.word} has a word"
                raise BadInputError(what, where, "give its radius alone, or nothing")
        return make_on_card(card, lambda: round_corners(places, radius=radius[1:-1], name=name))
    return make_on_card(
        card,
        lambda: through_points(
            places, kind=[p.kind for p in points[:-1]], radius=radius[:-1],
            knuckles=[k for k, p in enumerate(points) if p.knuckle], name=name,
        ),
    )  # fmt: skip


def _point(row: CardRow, card: Card) -> _Point:
    """Read a row: two numbers, then ``line``, ``arc``, a radius, ``knuckle``, in any order."""
    where = f"at line {row.line} of {card.source}"
    if len(row.cells) < 2:
        what = f"a row of {card.word} has {len(row.cells)} cell(s)"
        raise BadInputError(what, where, "give two numbers, and what runs on from there")
    u, v = (read_number(cell, where) for cell in row.cells[:2])
    rest = [cell.lower() for cell in row.cells[2:]]
    words = [cell for cell in rest if cell in ("line", "arc", "knuckle")]
    others = [cell for cell in rest if cell not in words]
    if len(set(words)) < len(words) or {"line", "arc"} <= set(words) or len(others) > 1:
        what = f"a row of {card.word} has {shown(' '.join(rest))}"
        raise BadInputError(what, where, "give line or arc, a radius, knuckle: each once at most")
    radius = read_number(others[0], where) if others else None
    if radius is not None and "line" in words:
        what = f"a line of {card.word} has the radius {radius:g}"
        raise BadInputError(what, where, "leave it out, or make it an arc")
    return _Point(u, v, "line" if "line" in words else "arc", radius, "knuckle" in words)


# --------------------------------------------------------------------------------------
# Sheer, camber, decks, boxes, deck houses and space curves.


def read_decks(cards: Cards, units: PrelikonUnits) -> tuple[Deck, ...]:
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


def read_box(card: Card, units: PrelikonUnits) -> AppendageBox:
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
    return make_on_card(
        card,
        lambda: AppendageBox.make(
            x + units.shift, y, z - units.base, sign=signs[cells.get("sign", "1")],
            symmetric=sides[cells.get("sides", "1")], name=name,
        ),
    )  # fmt: skip


def read_house(card: Card, decks: Sequence[Deck], units: PrelikonUnits) -> DeckHouse:
    """Read a deck house or a hatch: its name, deck, sizes, and from where to where.

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
    return make_on_card(
        card,
        lambda: DeckHouse.make(decks, deck, ends, breadth=breadth, height=height, name=name),
    )


def read_curve(card: Card, units: PrelikonUnits) -> SpaceCurve:
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
    return make_on_card(card, lambda: SpaceCurve.make(points, kind=kind, name=name))


def _sheer(card: Card, units: PrelikonUnits) -> Sheer:
    _options(card, ())
    rows = card.table(2) * units.scale
    rows[:, 0] += units.shift
    return make_on_card(card, lambda: Sheer.make(rows))


def _camber(card: Card, units: PrelikonUnits) -> CamberKind:
    """Read a camber: kind and sizes, or rows of points on the half-breadth."""
    sizes = () if card.rows else ("b", "c")
    joint = () if card.rows else ("joint",)
    cells = _options(card, ("kind", "scale", *sizes, *joint), needed=("kind", *sizes))
    kind, scale = _whole(cells["kind"], "kind", card), cells.get("scale", "fixed")
    if card.rows:
        rows = card.table(2) * units.scale
        return make_on_card(card, lambda: CamberKind.through(kind, rows, scale=scale))
    b, c, y = (
        units.scale * read_number(cells.get(word, "0"), card.where) for word in ("b", "c", "joint")
    )
    return make_on_card(card, lambda: CamberKind.make(kind, b, c, joint=y, scale=scale))


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


# --------------------------------------------------------------------------------------
# The whole text.

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
    "hatch": 8,
    "curve": 9,
}
"""The cards of main types, and the type of each."""

WORDS = (*TYPES, "waterlines", "buttocks")
"""All cards there are."""


def read_prelikon(cards: Cards) -> Prelikon:
    """Make a ship of main types of the cards of a text; x is counted from AP then.

    In the text x is counted from midship unless the card ``origin`` says else; a note says if
    moved.

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
    hatches = [read_house(card, decks, units) for card in cards.every("hatch")]
    curves = [read_curve(card, units) for card in cards.every("curve")]
    _require_one_each(cards, "boundary")
    try:
        return Prelikon.make(
            scaled, stations, decks=decks, boundaries=boundaries, boxes=boxes, houses=houses,
            hatches=hatches, curves=curves, cuts=_cuts(cards, units),
            notes=(*origin.notes, *units.notes),
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


def _cuts(cards: Cards, units: PrelikonUnits) -> dict[str, list[float]]:
    """Read where waterlines and buttocks cut the net."""
    found = {}
    for word, base in (("waterlines", units.base), ("buttocks", 0.0)):
        card = cards.maybe(word)
        if card is not None:
            given = card.numbers(len(card.cells))
            found[word] = [units.scale * value - base for value in given]
    return found

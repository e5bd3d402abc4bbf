r"""Texts of ships by boundary data: contour, waterlines, deck side and what else runs along them.

Examples
--------
>>> from assoc_hull.io.classical.cards import read_cards
>>> from assoc_hull.io.classical.seaking import read_seaking
>>> text = '''SEAKING "Box"
... length 40
... breadth 16
... depth 9
... draught 6
... keel 0 40
... contour aft
... -2 9
... 0 0
... contour forward
... 40 0
... 42 9
... tangent
... 0 4
... 40 4
... waterline 3
... 0 6
... 40 6
... deckside
... -2 8 9 1
... 42 8 9 0
... frames 5 20 35
... '''
>>> ship = read_seaking(read_cards(text, "box.txt"))
>>> ship.ends, len(ship.notes)
((-2.0, 42.0), 3)
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.creation.classical.middle_body import Midship
from assoc_hull.creation.classical.seaking import Seaking
from assoc_hull.creation.classical.seaking_parts import (
    AttachedAppendage,
    DeckBlock,
    DeckCamber,
    Knuckle,
    ParallelPart,
)
from assoc_hull.errors import BadInputError, GeometryError
from assoc_hull.geometry.classical.appendages import LoftedAppendage
from assoc_hull.geometry.classical.boundary_lines import CodedKnuckleLine, KeelOutline
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.classical.cards import (
    DIMENSIONS,
    Card,
    Cards,
    Origin,
    read_origin,
    read_particulars,
)
from assoc_hull.io.lines.raw_lines import read_number

__all__ = ["WORDS", "read_seaking"]

WORDS = (
    *DIMENSIONS, "deck", "deckside", "origin", "keel", "contour", "tangent", "midship",
    "waterline", "knuckle", "camber", "corner", "appendage", "hatch", "house", "frames",
    "buttocks",
)  # fmt: skip
"""The cards there are."""

_LINE = ("parallel", "half", "aft", "forward", "slope_aft", "slope_forward", "method")


def read_seaking(cards: Cards) -> Seaking:
    """Make a ship by boundary data of the cards of a text.

    Parameters
    ----------
    cards : Cards
        The text, as `read_cards` takes it apart.

    Returns
    -------
    Seaking
        x is counted from AP; a note says so where it was not.

    Raises
    ------
    BadInputError
        A card that is unknown, missing, given twice or not of its form.
    GeometryError
        Numbers of which no curve, section or ship can be made; with the line of the text.
    """
    cards.require_known(WORDS)
    ship = read_particulars(cards)
    origin = read_origin(cards, ship.length)
    keel = _keel(cards, origin)
    waterlines = sorted(
        (_waterline(card, origin) for card in cards.every("waterline")), key=lambda each: each.z
    )
    frames, buttocks = cards.one("frames"), cards.maybe("buttocks")
    try:
        return Seaking(
            particulars=ship, keel=keel, waterlines=tuple(waterlines),
            deck=_line(cards.one("deckside"), origin),
            frames=origin.moved(np.sort(_places(frames))),
            parallel=_midship(cards, origin),
            knuckles=tuple(_knuckle(card, origin) for card in cards.every("knuckle")),
            camber=_camber(cards, origin),
            appendages=tuple(_appendage(card, origin) for card in cards.every("appendage")),
            buttocks=() if buttocks is None else tuple(_places(buttocks).tolist()),
            blocks=_blocks(cards, origin), told=origin.notes,
        )  # fmt: skip
    except GeometryError as error:
        raise error.at(f"in {cards.source}") from None


def _keel(cards: Cards, origin: Origin) -> KeelOutline:
    card = cards.one("keel")
    first, last = origin.moved(card.numbers(2)).tolist()
    sides: dict[str, Card] = {}
    for each in cards.every("contour"):
        side = " ".join(each.cells).lower()
        if side not in ("aft", "forward") or side in sides:
            what = f"contour has the cells {shown(' '.join(each.cells))}"
            raise BadInputError(what, each.where, "give one aft and one forward")
        sides[side] = each
    for side in ("aft", "forward"):
        if side not in sides:
            raise BadInputError(f"contour {side} is missing", f"in {cards.source}", "add it")
    aft, forward = (_moved(sides[side].table(2, least=1), origin) for side in ("aft", "forward"))
    tangent = cards.maybe("tangent")
    rows = np.array([[first, 0.0], [last, 0.0]])
    if tangent is not None:
        rows = _moved(tangent.table(2, least=2), origin)
    try:
        return KeelOutline.make(first, last, aft, forward, rows)
    except GeometryError as error:
        raise error.at(card.where) from None


def _moved(rows: FloatArray, origin: Origin) -> FloatArray:
    """Count the first column from AP."""
    return np.column_stack([origin.moved(rows[:, 0]), rows[:, 1:]])


def _waterline(card: Card, origin: Origin) -> ParallelWaterline:
    if not card.cells:
        raise BadInputError("waterline has no height", card.where, "give it after the word")
    height = read_number(card.cells[0], card.where)
    cells = card.options(_LINE, first=1)
    ends = {
        name: origin.moved(pair[0]).tolist() for name in ("aft", "forward")
        if (pair := _pair(cells, name, card)) is not None
    }  # fmt: skip
    points = {name: (ends[name], _pair(cells, name, card)[1]) for name in ends}  # type: ignore[index]
    parallel = _pair(cells, "parallel", card)
    slopes = tuple(
        read_number(cells[name], card.where) if name in cells else None
        for name in ("slope_aft", "slope_forward")
    )
    try:
        return ParallelWaterline.make(
            height, _moved(card.table(2), origin), aft_end=points.get("aft"),
            fwd_end=points.get("forward"),
            parallel=None if parallel is None else tuple(origin.moved(parallel).tolist()),
            parallel_half_breadth=(
                read_number(cells["half"], card.where) if "half" in cells else None
            ),
            end_slope=(slopes[0], slopes[1]), method=_method(cells, card),
        )  # fmt: skip
    except GeometryError as error:
        raise error.at(card.where) from None


def _method(cells: Mapping[str, str], card: Card) -> Literal["graph", "chord"] | None:
    method = cells.get("method")
    if method == "graph":
        return "graph"
    if method == "chord":
        return "chord"
    if method is None:
        return None
    raise BadInputError(f"method is {shown(method)}", card.where, "say graph or chord")


def _pair(cells: Mapping[str, str], name: str, card: Card) -> tuple[float, float] | None:
    """Read ``name=number,number``."""
    if name not in cells:
        return None
    parts = cells[name].split(",")
    if len(parts) != 2:
        what = f"{name} is {shown(cells[name])}"
        raise BadInputError(what, card.where, "give two numbers with a comma between")
    first, last = (read_number(each, card.where) for each in parts)
    return first, last


def _line(card: Card, origin: Origin, blend: str | None = None) -> CodedKnuckleLine:
    """Read rows x, y, z, code; the code of the last row, which begins no interval, is left out."""
    rows = _moved(card.table(4, least=2), origin)
    try:
        return CodedKnuckleLine.make(rows[:, 0], rows[:, 1:3], rows[:-1, 3], blend)  # type: ignore[arg-type]
    except GeometryError as error:
        raise error.at(card.where) from None


def _knuckle(card: Card, origin: Origin) -> Knuckle:
    if not card.cells or "=" in card.cells[0]:
        raise BadInputError("a knuckle has no name", card.where, "give it after the word")
    return Knuckle(card.cells[0], _line(card, origin, card.options(("blend",), 1).get("blend")))


def _midship(cards: Cards, origin: Origin) -> ParallelPart | None:
    card = cards.maybe("midship")
    if card is None:
        return None
    a, b, c, radius, first, last = card.numbers(6)
    try:
        section = Midship(a, b, c, radius)
    except GeometryError as error:
        raise error.at(card.where) from None
    return ParallelPart(section, *origin.moved([first, last]).tolist())


def _camber(cards: Cards, origin: Origin) -> DeckCamber:
    card, corner = cards.maybe("camber"), cards.maybe("corner")
    kind, rise, radii = "parabola", np.zeros((0, 2)), np.zeros((0, 2))
    if card is not None:
        kind = " ".join(card.cells).lower() or "parabola"
        if kind not in ("line", "parabola"):
            raise BadInputError(f"camber is {shown(kind)}", card.where, "say line or parabola")
        rise = _moved(card.table(2, least=1), origin)
    if corner is not None:
        radii = _moved(corner.table(2, least=1), origin)
    return DeckCamber(rise, kind, radii)


def _appendage(card: Card, origin: Origin) -> AttachedAppendage:
    """Read an appendage: rows of y and z of each section, one behind the other."""
    if not card.cells or "=" in card.cells[0]:
        raise BadInputError("an appendage has no name", card.where, "give it after the word")
    cells = card.options(("at", "sign", "sides"), first=1)
    if "at" not in cells:
        raise BadInputError("an appendage lacks at", card.where, "add it as at=x,x or at=x,x,x")
    places = [read_number(each, card.where) for each in cells["at"].split(",")]
    sign = read_number(cells.get("sign", "1"), card.where)
    sides = read_number(cells.get("sides", "2"), card.where)
    if sides not in (1.0, 2.0):
        raise BadInputError(f"sides is {sides:g}", card.where, "give 1 or 2")
    width = len(card.rows[0].cells) if card.rows else 0
    if width % 2:
        what = f"a row of appendage has {width} cell(s)"
        raise BadInputError(what, card.where, "give y and z of each section")
    rows = card.table(width)
    sections = [rows[:, 2 * k : 2 * k + 2] for k in range(width // 2)]
    try:
        made = LoftedAppendage.make(sections, origin.moved(places), sign)
    except GeometryError as error:
        raise error.at(card.where) from None
    return AttachedAppendage(card.cells[0], made, sides == 2.0)


def _blocks(cards: Cards, origin: Origin) -> list[DeckBlock]:
    """Read hatches and deck houses; where the deck does not carry one, its line is named."""
    deck = _line(cards.one("deckside"), origin)
    words = ("from", "to", "breadth", "height")
    found = []
    for group, kind in (("hatches", "hatch"), ("deck houses", "house")):
        for card in cards.every(kind):
            if not card.cells or "=" in card.cells[0]:
                raise BadInputError(f"a {kind} has no name", card.where, "give it after the word")
            cells = card.options((*words, "camber"), first=1)
            missing = [word for word in words if word not in cells]
            if missing or card.rows:
                what = f"{kind} lacks {', '.join(missing)}" if missing else f"{kind} has rows"
                remedy = "add it as name=value" if missing else "leave them out"
                raise BadInputError(what, card.where, remedy)
            low, high, breadth, height = (_field(cells, word, card) for word in words)
            rise = _field(cells, "camber", card) if "camber" in cells else 0.0
            first, last = origin.moved([low, high]).tolist()
            try:
                made = DeckBlock(card.cells[0], group, first, last, breadth, height, rise)
                made.require_deck(deck)
            except GeometryError as error:
                raise error.at(card.where) from None
            found.append(made)
    return found


def _field(cells: Mapping[str, str], word: str, card: Card) -> float:
    """Read the number of a cell; where it is none, the error names the cell too."""
    return read_number(cells[word], f"in {word}, {card.where}")


def _places(card: Card) -> FloatArray:
    """Read numbers from the cells of a card and all its rows."""
    cells = [*card.cells, *(cell for row in card.rows for cell in row.cells)]
    return np.array([read_number(each, card.where) for each in cells])

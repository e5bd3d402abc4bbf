"""Layouts of the named parameters of the whole body: decks, parallel body, shifts."""

from __future__ import annotations

import numpy as np

from assoc_hull.variation.fields.bump import Bump
from assoc_hull.variation.fields.field import Field, Piece, stack
from assoc_hull.variation.fields.piecewise_linear import Chain
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.parameters.parent_places import Parent
from assoc_hull.variation.parameters.share import Share

__all__ = [
    "aft_shift", "deck_height", "depth", "fore_shift", "parallel_body_end", "parallel_body_start",
    "shift_terminals",
]  # fmt: skip

_ALL = Chain.constant(1.0)
_NOTHING = Piece.along(_ALL, 0.0, 0.0)


def depth(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the deck by a ratio of heights, from the design waterline up."""
    name = "depth"
    deck = parent.at("deck", name)
    z = float(deck[2])
    walls = stack(["T", "deck"], [parent.draught, z])
    pieces = _NOTHING, Piece.along(_ALL, asked / z - 1.0, 0.0)
    return Share.at(name, "z", asked - z, deck, Field(name, "z", walls, pieces, layout.curve))


def deck_height(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the deck by a ratio of heights, or by a fade from amidships to a perpendicular."""
    name = "deck_height"
    deck = parent.at({"fore": "deck fore", "aft": "deck aft", "midship": "deck"}[layout.deck], name)
    middle, z = 0.5 * parent.length, float(deck[2])
    course = {
        "fore": Chain.through([middle, parent.length], [0.0, 1.0], layout.curve, name),
        "aft": Chain.through([0.0, middle], [1.0, 0.0], layout.curve, name),
        "midship": _ALL,
    }[layout.deck]
    walls = stack(["T", "deck"], [parent.draught, z])
    pieces = Piece.along(course, 0.0, 0.0), Piece.along(course, asked / z - 1.0, 0.0)
    return Share.at(name, "z", asked - z, deck, Field(name, "z", walls, pieces, layout.curve))


def _shift(name: str, chain: Chain, change: float, place: float, layout: Layout) -> Share:
    """Shift stations by a chain, all heights alike."""
    field = Field(
        name, "x", stack(["base"], [0.0]), (Piece.along(chain, 0.0, change),), layout.curve
    )
    return Share.at(name, "x", change, np.array([place, 0.0, 0.0]), field)


def _middle(parent: Parent, name: str) -> tuple[float, float]:
    start, end = parent.at("body start", name), parent.at("body end", name)
    return float(start[0]), float(end[0])


def parallel_body_start(parent: Parent, asked: float, layout: Layout) -> Share:
    """Move the after end of the parallel middle body; its fore end and the AP stay."""
    name = "parallel_body_start"
    start, end = _middle(parent, name)
    chain = Chain.through([0.0, start, end], [0.0, 1.0, 0.0], layout.curve, name)
    return _shift(name, chain, asked - start, start, layout)


def parallel_body_end(parent: Parent, asked: float, layout: Layout) -> Share:
    """Move the fore end of the parallel middle body; its after end and the FP stay."""
    name = "parallel_body_end"
    start, end = _middle(parent, name)
    chain = Chain.through([start, end, parent.length], [0.0, 1.0, 0.0], layout.curve, name)
    return _shift(name, chain, asked - end, end, layout)


def fore_shift(parent: Parent, asked: float, layout: Layout) -> Share:
    """Shift the sections between the parallel body and where the profile rises, forward."""
    _, _, inner, outer = shift_terminals(parent, "fore_shift")
    return _bump("fore_shift", inner, outer, asked, layout)


def aft_shift(parent: Parent, asked: float, layout: Layout) -> Share:
    """Shift the sections between where the profile rises and the parallel body, aft."""
    outer, inner, _, _ = shift_terminals(parent, "aft_shift")
    return _bump("aft_shift", inner, outer, asked, layout)


def shift_terminals(parent: Parent, name: str) -> tuple[float, float, float, float]:
    """Give between which places sections shift, m from AP, from aft.

    They are where the profile begins to rise and the ends of the parallel body; where there is
    none, the two stations with the largest areas.

    Parameters
    ----------
    parent : Parent
    name : str
        Of the parameter, for the error.

    Raises
    ------
    BadInputError
        The parent has neither.
    """
    largest = parent.has("largest aft") and not parent.has("body start")
    inner = ("largest aft", "largest fore") if largest else ("body start", "body end")
    aft, start, end, fore = (
        float(parent.at(place, name)[0]) for place in ("aft terminal", *inner, "fore terminal")
    )
    return aft, start, end, fore


def _bump(name: str, inner: float, outer: float, asked: float, layout: Layout) -> Share:
    """Shift between two terminals: the bump is full where its shape is."""
    bump = Bump(inner, outer, 1.0, layout.shift)
    full = bump.top
    course = bump.scaled(asked / float(bump.at(np.array(full))))
    field = Field(
        name, "x", stack(["base"], [0.0]), (Piece(Chain.constant(0.0), 0.0, course),), layout.curve
    )
    return Share.at(name, "x", asked, np.array([full, 0.0, 0.0]), field)

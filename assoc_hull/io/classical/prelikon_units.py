r"""Unit, base line and origin of a text of main types: what its numbers mean in metres from AP.

Examples
--------
>>> from assoc_hull.io.classical.cards import read_cards
>>> from assoc_hull.io.classical.prelikon_units import read_units
>>> units = read_units(read_cards("PRELIKON Body\nunit mm\nbase 500", "a.txt"))
>>> units.height(2500.0), units.notes[1]
(2.0, 'heights counted from 0.5 m below the base line were lowered by as much')
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError, GeometryError
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.classical.cards import Card, Cards

__all__ = ["UNITS", "Units", "placed", "read_units"]

UNITS = {"m": 1.0, "mm": 1e-3, "ft": 0.3048}
"""Metres in the units that a text may be in."""

Made = TypeVar("Made")


@attrs.frozen
class Units:
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
            off = figure(abs(self.base))
            found.append(f"heights counted from {off} m {side} the base line were {way} by as much")
        return tuple(found)


def read_units(cards: Cards) -> Units:
    """Read the cards ``unit`` and ``base``; metres from the base line without them.

    Parameters
    ----------
    cards : Cards
        The text.

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
    return Units(scale, base)


def placed(card: Card, make: Callable[[], Made]) -> Made:
    """Make something of a card; what goes wrong with its geometry is told with its line."""
    try:
        return make()
    except GeometryError as error:
        raise error.at(card.where) from None

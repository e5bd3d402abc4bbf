r"""Where x is counted from: texts may count from midship, the kernel counts from AP.

All readers of definitions use this: `read_origin` once, `Origin.moved` on every x, and
`Origin.notes` among the notes of the definition.

Examples
--------
>>> from assoc_hull.io.classical.cards import read_cards
>>> from assoc_hull.io.classical.origin import read_origin
>>> origin = read_origin(read_cards("SFOLDS Ferry\norigin midship", "a.txt"), 120.0)
>>> float(origin.moved(-12.0)), origin.notes
(48.0, ('x counted from midship was moved by +60 m: x is now from AP',))
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.classical.cards import Cards

__all__ = ["ORIGINS", "Origin", "read_origin"]

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
        """Give places (m) from AP, in the shape of `x`."""
        return np.asarray(np.asarray(x, np.float64) + self.shift)

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence, if x was moved."""
        if not self.shift:
            return ()
        return (f"x counted from midship was moved by {self.shift:+g} m: x is now from AP",)


def read_origin(cards: Cards, length: float, default: str = "ap") -> Origin:
    """Read the card ``origin``.

    Parameters
    ----------
    cards : Cards
        The text.
    length : float, m
        Between perpendiculars.
    default : str
        One of `ORIGINS`: what a text without the card means.

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

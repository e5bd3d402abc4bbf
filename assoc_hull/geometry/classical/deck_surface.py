"""A deck: a height at the centre line, sheer along and camber across.

Examples
--------
>>> from assoc_hull.geometry.classical.camber_kinds import CamberKind
>>> from assoc_hull.geometry.classical.deck_surface import Deck
>>> from assoc_hull.geometry.classical.sheer import Sheer
>>> sheer = Sheer.make([(-60, 2.2), (-30, 0.6), (0, 0), (30, 0.9), (60, 3.4)])
>>> deck = Deck.make(1, 12.5, sheer, CamberKind.make(1, 15.0, 0.5))
>>> deck.at([42.0, 0.0, -30.0], [9.0, 0.0, 0.0]).round(12).tolist()
[14.22, 12.5, 13.1]
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import instance
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.camber_kinds import CamberKind
from assoc_hull.geometry.classical.checks import figure, finite, require_together
from assoc_hull.geometry.classical.sheer import Sheer
from assoc_hull.geometry.curves import FloatArray

__all__ = ["Deck", "require_apart"]

_ACROSS = 65
"""Two decks are compared at so many half-breadths of each station."""


@attrs.frozen(eq=False)
class Deck:
    """The surface z(x, y) = height + sheer(x) - camber(|y|).

    The deck of the PRELIKON system in Kim & Chang, "Some Representations of Ship Hulls by
    Mathematical Method for Design and Production", J. SNAK.

    Attributes
    ----------
    number : int
        By which deck houses name it.
    height : float, m
        Of the centre line where the sheer is 0, above the base line.
    sheer : Sheer
        Along the centre line.
    camber : CamberKind
        Across.
    """

    number: int
    height: float
    sheer: Sheer
    camber: CamberKind

    @classmethod
    def make(cls, number: int, height: float, sheer: Sheer, camber: CamberKind) -> Self:
        """Check what is handed in; arguments as the attributes.

        Raises
        ------
        GeometryError
            A height that is no finite number.
        BadInputError
            A sheer or a camber of another type.
        """
        level = float(finite(height, f"deck {number}", ()))
        instance(sheer, Sheer, "sheer", "of a deck")
        instance(camber, CamberKind, "camber", "of a deck")
        return cls(number, level, sheer, camber)

    def centre(self, x: ArrayLike) -> FloatArray:
        """Give the height (m) of the centre line at places, in their shape.

        Raises
        ------
        GeometryError
            ``"deck {n}: sheer does not cover x={x}"``.
        """
        asked = finite(x, f"deck {self.number}", None)
        least, most = self.sheer.range
        slack = 1e-9 * (most - least)
        outside = (asked < least - slack) | (asked > most + slack)
        if outside.any():
            first = float(asked[outside].flat[0])
            raise GeometryError(
                f"deck {self.number}: sheer does not cover x={figure(first)}",
                f"give it beyond [{figure(least)}, {figure(most)}]",
                {"deck": self.number, "x": first},
            )  # fmt: skip
        return np.asarray(self.height + self.sheer.at(asked))

    def at(self, x: ArrayLike, y: ArrayLike, half_breadth: ArrayLike | None = None) -> FloatArray:
        """Give the height (m) at places, `x` and `y` broadcast.

        Parameters
        ----------
        x, y : array_like, m
            Along, and to either side.
        half_breadth : array_like, m, optional
            Of the deck at `x`, for a camber that is scaled to it.

        Raises
        ------
        GeometryError
            ``"deck {n}: sheer does not cover x={x}"``;
            ``"camber: y={y} beyond reference half-breadth {B}"``.
        """
        centre, drop = self.centre(x), self.camber.drop(y, half_breadth)
        require_together(f"deck {self.number}", centre, drop)
        return np.asarray(centre - drop)

    def moved(self, by: float) -> Self:
        """Give the same deck with `by` (m) added to x."""
        return attrs.evolve(self, sheer=self.sheer.moved(by))


def require_apart(decks: Sequence[Deck], x: ArrayLike, half_breadth: ArrayLike) -> None:
    """Check at stations that no two decks meet.

    Parameters
    ----------
    decks : sequence of Deck
        In any order.
    x, half_breadth : (m,), m
        Stations, and how far out the decks are looked at there; no farther than both cambers
        are given.

    Raises
    ------
    GeometryError
        ``"decks {i} and {j} intersect near x={x}"``.
    """
    places = finite(x, "decks", (None,))
    widths = finite(half_breadth, "decks", (len(places),))
    for k, first in enumerate(decks):
        for second in decks[k + 1 :]:
            most = np.minimum(widths, _reach(first, second, widths))
            across = most[:, None] * np.linspace(0.0, 1.0, _ACROSS)
            heights = [
                deck.at(places[:, None], across, np.maximum(widths, 1e-9)[:, None])
                for deck in (first, second)
            ]
            above = heights[0] - heights[1]
            met = (above * above[:1, :1] <= 0.0).any(axis=1)
            if met.any():
                at = float(places[np.argmax(met)])
                raise GeometryError(
                    f"decks {first.number} and {second.number} intersect near x={figure(at)}",
                    "change a height, a sheer or a camber",
                    {"decks": (first.number, second.number), "x": at},
                )  # fmt: skip


def _reach(first: Deck, second: Deck, widths: FloatArray) -> FloatArray:
    """Give how far out both cambers are given, (m,), m."""
    reach = np.full(len(widths), np.inf)
    for deck in (first, second):
        if deck.camber.scale == "fixed":
            reach = np.minimum(reach, deck.camber.half_breadth)
    return reach

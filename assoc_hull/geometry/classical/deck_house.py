"""A deck house: a block on a deck, its roof parallel to it.

Examples
--------
>>> from assoc_hull.geometry.classical.camber_kinds import CamberKind
>>> from assoc_hull.geometry.classical.deck_house import DeckHouse
>>> from assoc_hull.geometry.classical.deck_surface import Deck
>>> from assoc_hull.geometry.classical.sheer import Sheer
>>> sheer = Sheer.make([(-60, 2.2), (-30, 0.6), (0, 0), (30, 0.9), (60, 3.4)])
>>> deck = Deck.make(1, 12.5, sheer, CamberKind.make(1, 15.0, 0.5))
>>> house = DeckHouse.make([deck], 1, (-50, -30), breadth=12.0, height=2.6)
>>> house.volume, house.profile_area, round(house.centroid[2], 8)
(624.0, 52.0, 14.90666667)
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of, shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.classical.deck_surface import Deck

__all__ = ["DeckHouse"]


@attrs.frozen(eq=False)
class DeckHouse:
    """A block symmetric about the centre line; its height is measured vertically.

    Several breadths or heights are several deck houses. After the PRELIKON system in Kim &
    Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
    Production", J. SNAK.

    Attributes
    ----------
    deck : Deck
        It stands on.
    x : (float, float), m
        After and fore end.
    breadth, height : float, m
        Over both sides; above the deck.
    name : str
        For tables.
    deck_half_breadth : float, m, or None
        Of the deck under it, for a camber that is scaled to the deck.
    """

    deck: Deck
    x: tuple[float, float]
    breadth: float
    height: float
    name: str = "deck house"
    deck_half_breadth: float | None = None

    @classmethod
    def make(
        cls,
        decks: Sequence[Deck],
        deck: int,
        x: ArrayLike,
        *,
        breadth: float,
        height: float,
        name: str = "deck house",
        deck_half_breadth: float | None = None,
    ) -> Self:
        """Check what is handed in.

        Parameters
        ----------
        decks : sequence of Deck
            All decks there are.
        deck : int
            Number of the one it stands on.
        x, breadth, height, name, deck_half_breadth
            As the attributes.

        Raises
        ------
        GeometryError
            ``"deck house: unknown deck {n}"``; sizes that are not above 0; a deck or a camber
            that does not reach as far.
        """
        known = all_of(decks, Deck, "decks", "in a deck house")
        found = next((each for each in known if shown(each.number) == shown(deck)), None)
        if found is None:
            there = ", ".join(str(each.number) for each in known) or "none"
            raise GeometryError(
                f"deck house: unknown deck {shown(deck)}", f"decks are {there}", {"deck": deck}
            )
        low, high = finite(x, "deck house", (2,)).tolist()
        width, tall = (float(finite(each, "deck house", ())) for each in (breadth, height))
        for size, value in (("length", high - low), ("breadth", width), ("height", tall)):
            if not value > 0.0:
                raise GeometryError(
                    f"deck house: {size} {figure(value)}", "give one above 0", {size: value}
                )
        found.centre([low, high])
        found.camber.mean(0.5 * width, deck_half_breadth)
        return cls(found, (low, high), width, tall, str(name), deck_half_breadth)

    def require_breadth(self, x: ArrayLike, half_breadth: ArrayLike) -> None:
        """Check that the deck is wide enough for it.

        Parameters
        ----------
        x, half_breadth : (m,), m
            The deck edge, x increasing; straight between, and looked at from end to end of
            the house. Beyond its ends the deck has no breadth.

        Raises
        ------
        GeometryError
            ``"deck house: breadth {b} exceeds the deck breadth at x={x}"``.
        """
        places = finite(x, "deck edge", (None,))
        halves = finite(half_breadth, "deck edge", (len(places),))
        within = places[(places > self.x[0]) & (places < self.x[1])]
        asked = np.concatenate([[self.x[0]], within, [self.x[1]]])
        wide = 2.0 * np.interp(asked, places, halves, left=0.0, right=0.0)
        narrow = np.flatnonzero(wide < self.breadth * (1.0 - 1e-12))
        if len(narrow):
            at = float(asked[narrow[0]])
            raise GeometryError(
                f"deck house: breadth {figure(self.breadth)} exceeds the deck breadth at "
                f"x={figure(at)}",
                f"give at most {figure(float(wide[narrow[0]]))}",
                {"breadth": self.breadth, "x": at, "deck_breadth": float(wide[narrow[0]])},
            )  # fmt: skip

    @property
    def volume(self) -> float:
        """Breadth by height by length, m3."""
        return self.breadth * self.profile_area

    @property
    def profile_area(self) -> float:
        """Height by length, m2, as wind sees it from the side."""
        return self.height * (self.x[1] - self.x[0])

    @property
    def centroid(self) -> tuple[float, float, float]:
        """Of its volume, m: height + mean sheer - mean drop + half its own height."""
        middle = 0.5 * (self.x[0] + self.x[1])
        drop = self.deck.camber.mean(0.5 * self.breadth, self.deck_half_breadth)
        z = self.deck.height + float(self.deck.sheer.mean(*self.x))
        return middle, 0.0, z - drop + 0.5 * self.height

    def moved(self, by: float) -> Self:
        """Give the same house with `by` (m) added to x, its deck with it."""
        step = float(finite(by, "deck house", ()))
        ends = (self.x[0] + step, self.x[1] + step)
        return attrs.evolve(self, deck=self.deck.moved(step), x=ends)

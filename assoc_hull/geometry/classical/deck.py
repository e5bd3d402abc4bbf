"""Decks: a height at the centre line, sheer along and camber across; and houses on them.

`Sheer` is a polyline over x, `Deck` the surface z(x, y), `DeckHouse` a block whose roof is parallel
to its deck. Volumes and areas are exact. x in the datum of whoever gives it, heights from the base
line, m. All are those of the PRELIKON system in Kim & Chang, "Some Representations of Ship Hulls by
Mathematical Method for Design and Production", J. SNAK.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of, instance, shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.camber import CamberKind
from assoc_hull.geometry.classical.checked_input import (
    digits,
    finite_array,
    require_broadcast,
    within_range,
)
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "Deck",
    "DeckHouse",
    "Sheer",
    "require_decks_apart",
]


@attrs.frozen(eq=False)
class Sheer:
    """Rise of a deck's centre line along the ship, straight between given points (C0).

    The sheer of the PRELIKON system in Kim & Chang, "Some Representations of Ship Hulls by
    Mathematical Method for Design and Production", J. SNAK.

    Attributes
    ----------
    x : (n,), m
        Increasing, in the datum of whoever gives it.
    rise : (n,), m
        Above the height of the deck, positive upward.
    """

    x: FloatArray
    rise: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.rise)

    @classmethod
    def make(cls, points: ArrayLike) -> Self:
        """Check and take given points.

        Parameters
        ----------
        points : (n, 2), m
            Rows (x, rise), two or more, x increasing.

        Raises
        ------
        GeometryError
            ``"sheer: x not strictly increasing at row {i}"``; fewer than two rows, another
            shape or numbers that are not finite.
        """
        rows = finite_array(points, "sheer", (None, 2))
        if len(rows) < 2:
            raise GeometryError(
                f"sheer: expected shape (n >= 2, 2), got {rows.shape}", "give two points or more",
                {"got": rows.shape},
            )  # fmt: skip
        bad = np.flatnonzero(np.diff(rows[:, 0]) <= 0.0)
        if len(bad):
            row = int(bad[0]) + 1
            raise GeometryError(
                f"sheer: x not strictly increasing at row {row}", "sort the rows by x",
                {"row": row, "x": float(rows[row, 0])},
            )  # fmt: skip
        return cls(rows[:, 0].copy(), rows[:, 1].copy())

    @property
    def range(self) -> tuple[float, float]:
        """Between which x (m) it is given."""
        return float(self.x[0]), float(self.x[-1])

    def at(self, x: ArrayLike) -> FloatArray:
        """Give the rise (m) at places, in their shape.

        Raises
        ------
        GeometryError
            ``"sheer: x={x} outside [{a}, {b}]"``.
        """
        asked = within_range(x, "sheer", *self.range, slack=1e-9 * (self.x[-1] - self.x[0]))
        return np.asarray(np.interp(asked, self.x, self.rise))

    def mean(self, a: float, b: float) -> FloatArray:
        """Give the mean rise (m) between two places a < b, exactly; a 0-d array.

        Raises
        ------
        GeometryError
            Places outside, or in another order.
        """
        ends = self.at([a, b])
        if not a < b:
            raise GeometryError(
                f"sheer: mean between {digits(a)} and {digits(b)}", "give a below b",
                {"a": a, "b": b},
            )  # fmt: skip
        between = (self.x > a) & (self.x < b)
        x = np.concatenate([[a], self.x[between], [b]])
        rise = np.concatenate([ends[:1], self.rise[between], ends[1:]])
        return np.asarray(np.trapezoid(rise, x) / (b - a))

    def moved(self, by: float) -> Self:
        """Give the same sheer with `by` (m) added to every x."""
        step = float(finite_array(by, "sheer", ()))
        return type(self)(self.x + step, self.rise.copy())


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
        """Check the arguments, which are as the attributes.

        Raises
        ------
        GeometryError
            A height that is no finite number.
        BadInputError
            A sheer or a camber of another type.
        """
        level = float(finite_array(height, f"deck {number}", ()))
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
        asked = finite_array(x, f"deck {self.number}", None)
        least, most = self.sheer.range
        slack = 1e-9 * (most - least)
        outside = (asked < least - slack) | (asked > most + slack)
        if outside.any():
            first = float(asked[outside].flat[0])
            raise GeometryError(
                f"deck {self.number}: sheer does not cover x={digits(first)}",
                f"give it beyond [{digits(least)}, {digits(most)}]",
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
        require_broadcast(f"deck {self.number}", centre, drop)
        return np.asarray(centre - drop)

    def moved(self, by: float) -> Self:
        """Give the same deck with `by` (m) added to x."""
        return attrs.evolve(self, sheer=self.sheer.moved(by))


def require_decks_apart(decks: Sequence[Deck], x: ArrayLike, half_breadth: ArrayLike) -> None:
    """Check at stations x (m,), m, that no two decks intersect; raises GeometryError where they do.

    `half_breadth` (m,), m, is how far out the decks are compared there; no farther than both
    cambers are given.
    """
    places = finite_array(x, "decks", (None,))
    widths = finite_array(half_breadth, "decks", (len(places),))
    for k, first in enumerate(decks):
        for second in decks[k + 1 :]:
            most = np.minimum(widths, _reach(first, second, widths))
            across = most[:, None] * np.linspace(0.0, 1.0, _ACROSS)
            heights = [
                deck.at(places[:, None], across, np.maximum(widths, 1e-9)[:, None])
                for deck in (first, second)
            ]
            above = heights[0] - heights[1]
            # All places must lie on the side of the first: a change of sign is an intersection.
            crossed = (above * above[:1, :1] <= 0.0).any(axis=1)
            if crossed.any():
                at = float(places[np.argmax(crossed)])
                raise GeometryError(
                    f"decks {first.number} and {second.number} intersect near x={digits(at)}",
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
        """Check the arguments.

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
        low, high = finite_array(x, "deck house", (2,)).tolist()
        width, tall = (float(finite_array(each, "deck house", ())) for each in (breadth, height))
        for size, value in (("length", high - low), ("breadth", width), ("height", tall)):
            if not value > 0.0:
                raise GeometryError(
                    f"deck house: {size} {digits(value)}", "give one above 0", {size: value}
                )
        # Both raise where deck or camber do not reach as far as the house.
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
        places = finite_array(x, "deck edge", (None,))
        halves = finite_array(half_breadth, "deck edge", (len(places),))
        within = places[(places > self.x[0]) & (places < self.x[1])]
        asked = np.concatenate([[self.x[0]], within, [self.x[1]]])
        wide = 2.0 * np.interp(asked, places, halves, left=0.0, right=0.0)
        narrow = np.flatnonzero(wide < self.breadth * (1.0 - 1e-12))
        if len(narrow):
            at = float(asked[narrow[0]])
            raise GeometryError(
                f"deck house: breadth {digits(self.breadth)} exceeds the deck breadth at "
                f"x={digits(at)}",
                f"give at most {digits(float(wide[narrow[0]]))}",
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
        step = float(finite_array(by, "deck house", ()))
        ends = (self.x[0] + step, self.x[1] + step)
        return attrs.evolve(self, deck=self.deck.moved(step), x=ends)

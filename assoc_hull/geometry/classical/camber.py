"""Camber of decks, hatches and deck houses by its rise from the side to the centre line.

With t the part of the half-breadth: a parabola z = zs + c (1 - t t), or a straight line
z = zs + c (1 - t). Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method
for Design and Production", J. SNAK.

Examples
--------
>>> from assoc_hull.geometry.classical.camber import Camber
>>> deck = Camber.make([0, 100], 15, 18, 0.45, "parabola")
>>> round(float(deck.height(50, 6)), 9), round(float(deck.area(50)), 9)
(18.378, 9.0)
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["KINDS", "Camber"]

KINDS = ("line", "parabola")
"""What a camber is between side and centre line."""

_SLACK = 1e-9
"""So far (as a part of the half-breadth) beyond the side counts as the side, by rounding."""


@attrs.frozen(eq=False)
class Camber:
    """Camber over x; between stations all goes in straight lines.

    Attributes
    ----------
    x : (n,), m
        Increasing.
    half_breadth, side_height, rise : (n,), m
        Of the side, and from there to the centre line.
    kind : {"line", "parabola"}
        Its curve athwartships.
    notes : tuple of str
        A rise below nil.
    """

    x: FloatArray
    half_breadth: FloatArray
    side_height: FloatArray
    rise: FloatArray
    kind: str
    notes: tuple[str, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.half_breadth, self.side_height, self.rise)

    @classmethod
    def make(
        cls, x: ArrayLike, half_breadth: ArrayLike, side_height: ArrayLike, rise: ArrayLike,
        kind: str = "parabola",
    ) -> Self:  # fmt: skip
        """Check what is handed in.

        Parameters
        ----------
        x : (n,) array_like, m
            Stations, increasing; one stands for its own place only.
        half_breadth, side_height, rise : (n,) array_like or float, m
            One for all stations, or one each.
        kind : {"line", "parabola"}
            Its curve athwartships.

        Raises
        ------
        GeometryError
            ``"camber: half-breadth must be positive"``; stations out of order, another kind.
        """
        one_of(kind, KINDS, "camber: kind is")
        places = finite(x, "camber", (None,))
        if not len(places) or (np.diff(places) <= 0.0).any():
            row = int(np.argmax(np.diff(places) <= 0.0)) + 1 if len(places) else 0
            what = f"camber: x not strictly increasing at row {row}"
            raise GeometryError(what, "put the stations in order from aft", {"row": row})
        breadth, side, bow = (
            _each(part, len(places)) for part in (half_breadth, side_height, rise)
        )
        if (breadth <= 0.0).any():
            row = int(np.argmax(breadth <= 0.0))
            told = {"row": row, "b": float(breadth[row])}
            raise GeometryError("camber: half-breadth must be positive", "give one above 0", told)
        return cls(places, breadth, side, bow, kind, _hollow(places, bow))

    def height(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Give heights above the base line (m).

        Parameters
        ----------
        x, y : array_like, m
            Places, of shapes that broadcast; y to either side.

        Raises
        ------
        GeometryError
            ``"camber: |y|={y} exceeds half-breadth {b}"``, x beyond the stations.
        """
        _place, half, side, rise = self._at(x)
        off = np.abs(finite(y, "camber", None))
        off, half, side, rise = np.broadcast_arrays(off, half, side, rise)
        beyond = off > half * (1.0 + _SLACK)
        if beyond.any():
            first = float(off[beyond].flat[0]), float(half[beyond].flat[0])
            raise GeometryError(
                f"camber: |y|={figure(first[0])} exceeds half-breadth {figure(first[1])}",
                "ask between the sides", {"y": first[0], "b": first[1]},
            )  # fmt: skip
        part = np.minimum(off / half, 1.0)
        drop = part * part if self.kind == "parabola" else part
        return np.asarray(side + rise * (1.0 - drop))

    def area(self, x: ArrayLike) -> FloatArray:
        """Give areas of both sides above the height of the side, m2, at x (m).

        4 b c / 3 for a parabola, b c for a line.
        """
        _, half, _, rise = self._at(x)
        return np.asarray((4.0 / 3.0 if self.kind == "parabola" else 1.0) * half * rise)

    def _at(self, x: ArrayLike) -> tuple[FloatArray, ...]:
        place = inside(x, "camber", float(self.x[0]), float(self.x[-1]))
        columns = (self.half_breadth, self.side_height, self.rise)
        return (place, *(np.asarray(np.interp(place, self.x, each)) for each in columns))


def _each(value: ArrayLike, count: int) -> FloatArray:
    """Take one number for all stations, or one each."""
    if isinstance(value, int | float | np.number):
        return np.full(count, finite(value, "camber", ()))
    return finite(value, "camber", (count,))


def _hollow(x: FloatArray, rise: FloatArray) -> tuple[str, ...]:
    below = np.flatnonzero(rise < 0.0)
    if not len(below):
        return ()
    row = int(below[0])
    return (
        f"camber: c={figure(rise[row])} at x={figure(x[row])} is negative: the deck is lower at "
        "the centre line than at the side",
    )

"""A sheer of straight lines in the centre-line plane.

Examples
--------
>>> from assoc_hull.geometry.classical.sheer import Sheer
>>> sheer = Sheer.make([(-60, 2.2), (-30, 0.6), (0, 0), (30, 0.9), (60, 3.4)])
>>> float(sheer.at(42.0).round(12)), float(sheer.mean(-50.0, -30.0).round(9))
(1.9, 1.133333333)
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Sheer"]


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
        rows = finite(points, "sheer", (None, 2))
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
        asked = inside(x, "sheer", *self.range, slack=1e-9 * (self.x[-1] - self.x[0]))
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
                f"sheer: mean between {figure(a)} and {figure(b)}", "give a below b",
                {"a": a, "b": b},
            )  # fmt: skip
        between = (self.x > a) & (self.x < b)
        x = np.concatenate([[a], self.x[between], [b]])
        rise = np.concatenate([ends[:1], self.rise[between], ends[1:]])
        return np.asarray(np.trapezoid(rise, x) / (b - a))

    def moved(self, by: float) -> Self:
        """Give the same sheer with `by` (m) added to every x."""
        step = float(finite(by, "sheer", ()))
        return type(self)(self.x + step, self.rise.copy())

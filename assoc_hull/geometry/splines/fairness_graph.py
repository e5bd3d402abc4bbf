"""Graphs y(x) as the criteria of fairness look at them, and distances found by search."""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
from scipy.interpolate import PPoly

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.splines.fairness_pieces import Seen

__all__ = ["GraphPieces", "searched_distance"]


@attrs.frozen(eq=False, slots=False)
class GraphPieces:
    """The graph of a piecewise polynomial y(x), with the derivatives that it has."""

    curve: PPoly

    @classmethod
    def of(cls, curve: PPoly) -> GraphPieces:
        """Take a piecewise polynomial of one variable and value.

        Raises
        ------
        GeometryError
            It has more than one value.
        """
        if curve.c.ndim != 2:
            raise GeometryError("fairness: a graph has one value of y at each x", "give one curve")
        return cls(curve)

    @property
    def owner(self) -> IntArray:
        """All pieces belong to one curve."""
        return np.zeros(self.curve.c.shape[1], np.int64)

    @property
    def signed(self) -> np.typing.NDArray[np.bool_]:
        """The curvature of a graph has a sign."""
        return np.ones(1, np.bool_)

    @property
    def of_arcs(self) -> bool:
        """Curvature changes along a polynomial."""
        return False

    def seen(self, u: FloatArray) -> Seen:
        """Look at all pieces at parameters u (k,)."""
        width = np.diff(self.curve.x)[:, None]
        table = self.curve.c[::-1].T  # ascending powers of x - x_i
        rows = []
        for _ in range(3):
            table = differentiate(table) if table.shape[1] > 1 else 0.0 * table
            rows.append(horner(table, u * width))
        slope, second, third = rows
        stretch = 1.0 + slope * slope
        tangent = np.stack([np.ones_like(slope), slope], axis=-1) / np.sqrt(stretch)[..., None]
        curvature = second / stretch**1.5
        left = np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)
        rate = (third * stretch - 3.0 * slope * second**2) / stretch**3
        speed = np.sqrt(stretch) * width
        return Seen(tangent, curvature, rate, speed, curvature[..., None] * left, third)

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of points (k, 2) from the graph, (k,)."""
        x = self.curve.x

        def place(t: FloatArray) -> FloatArray:
            return np.stack([t, self.curve(t)], axis=-1)

        return searched_distance(place, x, points)


def searched_distance(
    place: Callable[[FloatArray], FloatArray],
    edges: FloatArray,
    points: FloatArray,
    per_piece: int = 32,
) -> FloatArray:
    """Give the distance of points (k, 2) from a curve place(t) by search, (k,), m.

    The nearest of samples is taken, and improved by golden sections of the interval around it.
    """
    part = np.linspace(0.0, 1.0, per_piece, endpoint=False)
    t = np.append((edges[:-1, None] + np.diff(edges)[:, None] * part).ravel(), edges[-1])
    away = np.hypot(*(points[:, None] - place(t)).transpose(2, 0, 1))
    nearest = away.argmin(axis=1)
    low, high = t[np.maximum(nearest - 1, 0)], t[np.minimum(nearest + 1, len(t) - 1)]
    golden = 0.5 * (np.sqrt(5.0) - 1.0)
    for _ in range(70):
        one, two = high - golden * (high - low), low + golden * (high - low)
        left = np.hypot(*(points - place(one)).T) < np.hypot(*(points - place(two)).T)
        low, high = np.where(left, low, one), np.where(left, two, high)
    found = np.hypot(*(points - place(0.5 * (low + high))).T)
    freeze(found)
    return np.asarray(found)

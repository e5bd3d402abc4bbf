"""Pieces of a waterline: the cubic y(x), the level line, the batten bent over its chords.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.waterline_piece import Graph
>>> piece = Graph.through(np.array([[0.0, 0.0], [2.0, 1.0]]), (None, 0.0))
>>> piece.of(np.array([0.0, 2.0]), 1).round(9).tolist()
[0.75, 0.0]
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from scipy.interpolate import CubicSpline

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.chord_spline import ChordSpline
from assoc_hull.geometry.curves import FloatArray

__all__ = ["Chorded", "Graph", "Level", "Piece"]


@attrs.frozen
class Level:
    """A line along the ship: from `first` to `last`, at a half-breadth, m."""

    first: float
    last: float
    half_breadth: float

    def of(self, x: FloatArray, order: int) -> FloatArray:
        """Give half-breadths (m), or with `order` 1 slopes, at x (n,), m."""
        return np.full(len(x), 0.0 if order else self.half_breadth)


@attrs.frozen(eq=False)
class Graph:
    """A cubic spline y(x) from `first` to `last`, m."""

    first: float
    last: float
    spline: CubicSpline

    @classmethod
    def through(cls, points: FloatArray, ends: tuple[float | None, float | None]) -> Self:
        """Lay it through points (n, 2), m; an end has a slope, or no second derivative."""
        first, last = ((2, 0.0) if each is None else (1, each) for each in ends)
        x, y = points.T
        spline = CubicSpline(x, y, bc_type=(first, last))  # type: ignore[arg-type]
        return cls(float(x[0]), float(x[-1]), spline)

    def of(self, x: FloatArray, order: int) -> FloatArray:
        """Give half-breadths (m), or with `order` 1 slopes, at x (n,), m."""
        return np.asarray(self.spline(x, order))


@attrs.frozen(eq=False)
class Chorded:
    """A batten over chords from `first` to `last`, m."""

    first: float
    last: float
    spline: ChordSpline
    name: str

    @classmethod
    def through(
        cls, points: FloatArray, ends: tuple[float | None, float | None], name: str
    ) -> Self:
        """Bend it over points (n, 2), m; an end has a slope, or is free.

        Raises
        ------
        GeometryError
            The points turn it too sharply; what is wrong begins with `name`.
        """
        first, last = (None if each is None else float(np.arctan(each)) for each in ends)
        try:
            spline = ChordSpline.through(points, first, last)
        except GeometryError as error:
            raise GeometryError(f"{name}: {error.what}", error.remedy, error.values) from None
        return cls(float(points[0, 0]), float(points[-1, 0]), spline, name)

    def of(self, x: FloatArray, order: int) -> FloatArray:
        """Give half-breadths (m), or with `order` 1 slopes, at x (n,), m.

        Raises
        ------
        GeometryError
            The batten passes an x more than once.
        """
        met = self.spline.where("x", x)
        if len(met) != len(x):
            twice = np.flatnonzero(np.bincount(met.index, minlength=len(x)) > 1)
            place = float(x[twice[0]])
            what = f"{self.name}: the batten turns back and passes x={place:.10g} more than once"
            raise GeometryError(what, "give more points near the end", {"x": place})
        if order:
            return np.asarray(np.tan(self.spline.direction(met.t)))
        return np.asarray(met.points[:, 1])


Piece = Level | Graph | Chorded
"""Any of them."""

"""Pieces of sections in their plane, z over y, and shapes that lines are generated from.

A shape is a batch of curves of like pieces, each piece run through from t = 0 to t = 4.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.model.forms.section_pieces import SectionArcs, SectionShape
>>> bilge = SectionArcs(np.array([[0.0, 12.0]]), np.array([2.0]))
>>> shape = SectionShape(np.array([90.0]), (bilge,))
>>> shape.at(np.zeros(2, int), np.zeros(2, int), np.array([0.0, 4.0])).round(9).tolist()
[[90.0, 12.0, 0.0], [90.0, 14.0, 2.0]]
"""

from __future__ import annotations

import math
from typing import Protocol

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.form_curves.curve import FormEnd, form_at

__all__ = [
    "LineShape",
    "SectionArcs",
    "SectionCurves",
    "SectionPieces",
    "SectionShape",
    "end_points_2d",
]


class LineShape(Protocol):
    """Curves of like pieces in space."""

    def at(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 3), m."""
        ...

    def tangent(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 3), m."""
        ...


class SectionPieces(Protocol):
    """One piece of each section of a batch, in the plane (z, y)."""

    def at(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 2), m."""
        ...

    def tangent(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 2), m."""
        ...


@attrs.frozen(eq=False)
class SectionCurves:
    """Form-parameter curves.

    Attributes
    ----------
    vertices : (n, 7, 2), m
        One curve a row.
    start, finish : (n, 2), m
        Their ends, without the rounding of the vertices.
    """

    vertices: FloatArray
    start: FloatArray
    finish: FloatArray

    def at(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 2), m."""
        found = form_at(self.vertices[row], t)
        found = np.where((t == 0.0)[:, None], self.start[row], found)
        return np.where((t == 4.0)[:, None], self.finish[row], found)

    def tangent(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 2), m."""
        return form_at(self.vertices[row], t, 1)


@attrs.frozen(eq=False)
class SectionArcs:
    """Quarters of circles, from level to upright: a bilge.

    Attributes
    ----------
    start : (n, 2), m
        Where each begins: z, y.
    radius : (n,), m
        Of each.
    """

    start: FloatArray
    radius: FloatArray

    def at(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 2), m."""
        cos, sin = _unit(t)
        z, y = self.start[row].T
        radius = self.radius[row]
        return np.stack([z + radius * (1.0 - cos), y + radius * sin], axis=1)

    def tangent(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 2), m."""
        cos, sin = _unit(t)
        pace = self.radius[row] * (math.pi / 8.0)
        return np.stack([pace * sin, pace * cos], axis=1)


def _unit(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give cosine and sine of the angle run through, exact where the arc ends."""
    angle = [each * (math.pi / 8.0) for each in t.tolist()]
    cos, sin = (np.array([f(each) for each in angle]) for f in (math.cos, math.sin))
    return np.where(t == 4.0, 0.0, cos), sin


@attrs.frozen(eq=False)
class SectionShape:
    """Sections of like pieces.

    Attributes
    ----------
    x : (n,), m
        Where they stand.
    pieces : tuple of SectionPieces
        From the contour upward.
    """

    x: FloatArray
    pieces: tuple[SectionPieces, ...]

    def at(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 3), m; no half-breadth is negative."""
        found = self._in_space(self.x[row], row, piece, t, 0)
        found[:, 1] = np.maximum(found[:, 1], 0.0) + 0.0
        return found

    def tangent(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 3), m."""
        return self._in_space(np.zeros(len(row)), row, piece, t, 1)

    def _in_space(
        self, x: FloatArray, row: IntArray, piece: IntArray, t: FloatArray, order: int
    ) -> FloatArray:
        found = np.empty((len(row), 3))
        found[:, 0] = x
        for number, each in enumerate(self.pieces):
            mine = np.flatnonzero(piece == number)
            if len(mine):
                give = each.tangent if order else each.at
                found[mine, 2], found[mine, 1] = give(row[mine], t[mine]).T
        return found


def end_points_2d(start: FormEnd, finish: FormEnd) -> tuple[FloatArray, FloatArray]:
    """Give the points, (n, 2), of the two ends of curves."""
    return np.stack([start.x, start.y], axis=1), np.stack([finish.x, finish.y], axis=1)

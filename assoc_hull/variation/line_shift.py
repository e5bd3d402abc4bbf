"""How far a line of a variant lies from the parent's: its plane, and its course within the plane.

A plane that went along its normal is told apart from what the line did in it: the line is laid
into the parent's plane first. There the distance is that of two curves: of every place of
either the nearest of the other, and of these pairs the farthest (`assoc_hull.geometry.farthest`). A
line in space, or one whose plane has turned, is compared as it lies. A line in which nothing
but its ends moved has their distance: what is longer or shorter counts, too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.farthest import Owned, farthest
from assoc_hull.model.state import HullState

__all__ = ["LEAST", "LineShift", "line_shifts"]

LEAST = 1e-6
"""A line that lies less than this (m) from the parent's has not moved."""

_TURNED = 1e-9
"""Unit normals that differ by more belong to planes that are not parallel."""

_SIDE = 0.4
"""A coordinate with less than this part of the largest one is not told as a direction."""

_WAYS = (("forward", "aft"), ("out", "in"), ("up", "down"))

Place = tuple[float, float, float]


@attrs.frozen
class LineShift:
    """The largest shift of a line.

    Attributes
    ----------
    before, after : (float, float, float), m
        A place of the parent's line and one of the variant's, each the nearest of the other,
        or of all places of its line the farthest.
    plane : float or None, m
        How far the plane went along its normal (the coordinate that the lines of a family
        share); None for a line in space, or where the plane has turned.
    course : float, m
        The distance of both places within the plane, or in space.
    """

    before: Place
    after: Place
    plane: float | None
    course: float

    @property
    def vector(self) -> Place:
        """From the place before to that after, m: x forward, y out, z up."""
        x, y, z = (b - a for a, b in zip(self.before, self.after, strict=True))
        return x, y, z

    @property
    def length(self) -> float:
        """The distance of both places, m: of plane and course together."""
        return math.hypot(self.plane or 0.0, self.course)

    @property
    def moved(self) -> bool:
        """Tell whether the line has moved at all."""
        return self.length > LEAST

    @property
    def direction(self) -> str:
        """The direction in words, as "out" or "up and forward"; "-" where nothing moved."""
        if not self.moved:
            return "-"
        most = max(map(abs, self.vector))
        told = [
            (abs(part), ways[part < 0.0])
            for part, ways in zip(self.vector, _WAYS, strict=True)
            if abs(part) >= _SIDE * most
        ]
        return " and ".join(word for _, word in sorted(told, key=lambda each: -each[0]))


def line_shifts(
    parent: HullState, variant: HullState, pairs: Sequence[tuple[int, int]]
) -> list[LineShift]:
    """Measure how far lines lie from those of a parent, all in one go.

    Parameters
    ----------
    parent, variant : HullState
        The tables.
    pairs : sequence of (int, int)
        Numbers of a line of the parent and of that of the variant; both have a shape.

    Returns
    -------
    list of LineShift
        Pair by pair.

    Examples
    --------
    >>> from assoc_hull.examples.wigley import wigley
    >>> from assoc_hull.variation.line_shift import line_shifts
    >>> old, new = wigley(), wigley(breadth=11.0)
    >>> line = old.lines.name.data.index("WL 6.25")
    >>> (shift,) = line_shifts(old, new, [(line, line)])
    >>> shift.direction, [round(part, 9) for part in shift.vector]
    ('out', [0.0, 0.5, 0.0])
    """
    planes = [_plane(parent, old, variant, new) for old, new in pairs]
    moves = [np.zeros(3) if by is None else by * variant.lines.normal.data[new]
             for by, (_, new) in zip(planes, pairs, strict=True)]  # fmt: skip
    before = Owned.of([_splines(parent, old) for old, _ in pairs])
    after = Owned.of(
        [
            [_laid(spline, move) for spline in _splines(variant, new)]
            for move, (_, new) in zip(moves, pairs, strict=True)
        ]
    )
    found = farthest(before, after)
    back = found.other + np.reshape(moves, (-1, 3))
    return [
        LineShift(_place(old), _place(new), by, float(course))
        for old, new, by, course in zip(found.one, back, planes, found.distance, strict=True)
    ]


def _splines(state: HullState, line: int) -> list[SplineBatch]:
    return [state.spline(curve) for curve in state.curves_of(line)]


def _plane(parent: HullState, old: int, variant: HullState, new: int) -> float | None:
    """Give how far a plane went along its normal, m; None if it turned, or there is none."""
    was, now = parent.lines, variant.lines
    if not (was.planar.data[old] and now.planar.data[new]):
        return None
    if np.abs(was.normal.data[old] - now.normal.data[new]).max() > _TURNED:
        return None
    return float(now.offset.data[new] - was.offset.data[old])


def _laid(spline: SplineBatch, move: FloatArray) -> SplineBatch:
    """Take a curve back by a move."""
    return attrs.evolve(spline, xyz=spline.xyz - move, home=None) if move.any() else spline


def _place(point: FloatArray) -> Place:
    x, y, z = point.tolist()
    return x, y, z

"""How far a line of a variant lies from the parent's: its plane, and its course within the plane.

A plane that went along its normal is told apart from what the line did in it: the line is laid
into the parent's plane first. There the distance is that of two curves: of every place of
either the nearest of the other, and of these pairs the farthest
(`assoc_hull.geometry.splines.farthest`). A
line in space, or one whose plane has turned, is compared as it lies. A line in which nothing
but its ends moved has their distance: what is longer or shorter counts, too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.farthest import Owned, farthest, same_bits
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
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.comparing.line_shift import line_shifts
    >>> old, new = wigley(), wigley(breadth=11.0)
    >>> line = old.lines.name.data.index("WL 6.25")
    >>> (shift,) = line_shifts(old, new, [(line, line)])
    >>> shift.direction, [round(part, 9) for part in shift.vector]
    ('out', [0.0, 0.5, 0.0])
    """
    laid = [_Laid.of(parent, old, variant, new) for old, new in pairs]
    shifts = [each.unmoved for each in laid]
    apart = [i for i, each in enumerate(laid) if not same_bits(each.before, each.after)]
    found = farthest(
        Owned.of([laid[i].before for i in apart]), Owned.of([laid[i].after for i in apart])
    )
    for i, *places in zip(apart, found.one, found.other, found.distance.tolist(), strict=True):
        shifts[i] = laid[i].shift(*places)
    return shifts


@attrs.frozen(eq=False)
class _Laid:
    """A line of the parent and of the variant, both in the parent's plane.

    Attributes
    ----------
    before, after : list of SplineBatch
        Their curves.
    plane : float or None, m
        How far the plane went along its normal.
    back : (3,), m
        From the parent's plane to the variant's.
    """

    before: list[SplineBatch]
    after: list[SplineBatch]
    plane: float | None
    back: FloatArray

    @classmethod
    def of(cls, parent: HullState, old: int, variant: HullState, new: int) -> _Laid:
        plane = _plane(parent, old, variant, new)
        back = np.zeros(3) if plane is None else plane * variant.lines.normal.data[new]
        after = [_moved(spline, -back) for spline in _splines(variant, new)]
        return cls(_splines(parent, old), after, plane, back)

    def shift(self, before: FloatArray, after: FloatArray, course: float) -> LineShift:
        """Tell the shift between two places in the parent's plane."""
        return LineShift(_place(before), _place(after + self.back), self.plane, course)

    @property
    def unmoved(self) -> LineShift:
        """The shift of a line that has the same bits in the parent's plane."""
        start = self.before[0].xyz[0]
        return self.shift(start, start, 0.0)


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


def _moved(spline: SplineBatch, by: FloatArray) -> SplineBatch:
    return attrs.evolve(spline, xyz=spline.xyz + by, home=None) if by.any() else spline


def _place(point: FloatArray) -> Place:
    x, y, z = point.tolist()
    return x, y, z

"""Take the curves and crossings of a hull from its tables, as plain arrays."""

from __future__ import annotations

import itertools
from bisect import bisect_left, bisect_right
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.paths import Bit
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.state import HullState

__all__ = ["Net", "Part", "gather", "walk"]

Part = tuple[int, float, float]
"""A curve of the net and the chord parameters (m) between which it is walked, in that sense."""

_SNAP = 1e-9
"""A parameter so near to a knot (m) is the knot."""


@attrs.frozen(eq=False)
class Net:
    """The curves of a hull, and where they cross.

    Attributes
    ----------
    batch : SplineBatch
        All live curves, in the order of their keys.
    curve : (m,) int
        Their numbers in the tables.
    name : tuple of str
        The names of their lines.
    family : tuple of str
        The families of their lines.
    end : (m,) bool
        Boundary curves at which the hull ends.
    flat, knuckle : (m,) bool
        Borders of flats, to which the hull is tangent; and knuckles.
    x : (m,), m
        Where a curve that lies in a plane across the ship stands; nan for the others.
    centre : (m,) bool
        The line lies in the centre plane.
    normal : (m, 3)
        Of the plane of the line; nan where it lies in none.
    meets : (k, 2) int
        The two curves of each crossing.
    place : (k, 2), m
        Where on each of the two it lies.
    watched : (k,) bool
        It defines neither: the curves may pass one another, along a flat by much.
    row : (k,) int
        The point that it is.
    """

    batch: SplineBatch
    curve: IntArray
    name: tuple[str, ...]
    family: tuple[str, ...]
    end: NDArray[np.bool_]
    flat: NDArray[np.bool_]
    knuckle: NDArray[np.bool_]
    x: FloatArray
    centre: NDArray[np.bool_]
    normal: FloatArray
    meets: IntArray
    place: FloatArray
    watched: NDArray[np.bool_]
    row: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.end, self.flat, self.knuckle, self.x, self.centre)
        freeze(self.normal)
        freeze(self.meets, self.place, self.watched, self.row)

    @cached_property
    def knots(self) -> tuple[list[float], ...]:
        """The chord parameters of the knots of each curve, m."""
        knot, start = self.batch.knot.tolist(), self.batch.start.tolist()
        return tuple(knot[a:b] for a, b in itertools.pairwise(start))

    def length(self, curve: int) -> float:
        """Give the chord length of a curve, m."""
        return self.knots[curve][-1]


def gather(state: HullState) -> Net:
    """Take all live curves and their crossings from the tables.

    Parameters
    ----------
    state : HullState
        The tables.
    """
    keys = state.curves.key.data
    curves = np.array(sorted(state.live("curves").tolist(), key=lambda c: str(keys[c])), np.int64)
    lines = state.curves.line.data[curves]
    table = state.lines
    normal, boundary = table.normal.data[lines], table.boundary.data[lines]
    family = tuple(state.family(line).name for line in lines.tolist())
    flat = table.planar.data[lines]
    end = boundary == BoundaryKind.END
    across = flat & (np.abs(normal[:, 0]) == 1.0) & (end | (np.array(family) == "sections"))
    offset = table.offset.data[lines]
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    row, meets, place = _crossings(state, curves, batch)
    return Net(
        batch,
        curves,
        tuple(str(table.name.data[line]) for line in lines.tolist()),
        family,
        end,
        boundary == BoundaryKind.FLAT,
        boundary == BoundaryKind.KNUCKLE,
        np.where(across, offset * normal[:, 0], np.nan),
        flat & (np.abs(normal[:, 1]) == 1.0) & (offset == 0.0),
        np.where(flat[:, None], normal, np.nan),
        meets,
        place,
        state.rows.role.data[row] == Role.WATCHED,
        row,
    )


def _crossings(
    state: HullState, curves: IntArray, batch: SplineBatch
) -> tuple[IntArray, IntArray, FloatArray]:
    """Give all crossings, which two curves of the net cross there, and where on them.

    Watched crossings count: a surface within their gap is as good as the net itself.
    """
    number = np.full(state.curves.count + 1, -1, np.int64)
    number[curves] = np.arange(len(curves))
    table = state.rows
    place = table.parameter.data[: table.count].copy()
    # Where a line ends on another it has no meeting, but a defining point: a knot.
    row = np.concatenate([state.curves.rows.data[curve] for curve in curves.tolist()])
    side = np.concatenate([state.curves.side.data[curve] for curve in curves.tolist()])
    place[row, side] = batch.knot
    rows = state.live("rows")
    rows = rows[table.sort.data[rows] == Sort.CROSSING]
    both = number[table.curve.data[rows]]
    place = place[rows]
    good = (both >= 0).all(axis=1) & np.isfinite(place).all(axis=1)
    return rows[good], both[good], place[good]


def walk(net: Net, part: Part) -> list[Bit]:
    """Give the bits of segments that a part of a curve consists of."""
    curve, begin, finish = part
    knot = net.knots[curve]
    low, high = (_snapped(knot, t) for t in (min(begin, finish), max(begin, finish)))
    first = min(bisect_right(knot, low), len(knot) - 1) - 1
    last = max(bisect_left(knot, high), first + 1) - 1
    base = int(net.batch.start[curve]) - curve
    bits = []
    for i in range(first, last + 1):
        length = knot[i + 1] - knot[i]
        a = max((low - knot[i]) / length, 0.0)
        b = 1.0 if i < last else min((high - knot[i]) / length, 1.0)
        bits.append((base + i, a, b))
    return bits if begin <= finish else [(s, b, a) for s, a, b in reversed(bits)]


def _snapped(knot: list[float], t: float) -> float:
    """Take the knot for a parameter that is as good as there."""
    i = bisect_left(knot, t)
    for near in knot[max(i - 1, 0) : i + 1]:
        if abs(near - t) <= _SNAP:
            return near
    return t

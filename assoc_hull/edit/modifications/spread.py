"""Spread a hollow or a bump of a line: it becomes longer and shallower, and keeps its area.

A hollow (or a bump: the same from the other side) bends against what lies on both sides of it. The
line that touches both sides spans it; between the two places of touch it is taken away, and as much
area is laid along a greater length by a curve with flat ends.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.displacement_field import quintic_fade
from assoc_hull.edit.field_moves import SpreadArea, SpreadAreas, area_beside
from assoc_hull.edit.hull_normals import normals_at
from assoc_hull.edit.lines.line_planes import checked_in_planes
from assoc_hull.edit.modifications.line_parts import LinePart, Mark, designed, held_marks, lead
from assoc_hull.edit.modifications.reshape import Fade, fade_radii
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.numeric.polynomials import brent_root
from assoc_hull.geometry.splines.segments import derivative, evaluate
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Sort

__all__ = ["spread"]

_SAMPLES = 400
"""So many places show where a line touches both sides of a hollow."""

_TURNS = 8
"""The height of the new hollow is mended so often, until its area is that of the old."""

_LONGER = 1.1
"""A length that proves too short is told with one that is longer by this, at least."""

_EQUAL = 1e-9
"""Part of the area that may be left over then."""


def spread(edit: Transaction, row: int, side: int, length: float, fade: Fade = "auto") -> None:
    """Make the hollow or the bump of a line at one of its points longer and shallower.

    Parameters
    ----------
    edit : Transaction
        The edit.
    row, side : int
        A point in the hollow, and which of its curves is meant.
    length : float, m
        Along the line that touches both sides of the hollow.
    fade : "auto" or (r_x, r_g) in m
        How the change of the hull around fades.

    Raises
    ------
    BadInputError
        There is no hollow or bump, or it reaches beyond an end of the line.
    OutOfRangeError
        The length would not make it longer and shallower.
    BlockedRunError
        Placed points, features, flats or the centre plane within the length.
    """
    state, curve = edit.state, int(edit.state.rows.curve[row, side])
    whole = LinePart.of_curve(edit, curve, 0, len(state.curves.rows[curve]) - 1, "spread")
    hollow = _Hollow.at(whole, state.rows.xyz[row])
    least = max(hollow.length, 2.0 * hollow.area / hollow.depth)
    if length <= least:
        raise hollow.too_short(whole, length, least)
    inside = np.flatnonzero(np.abs(hollow.along(whole.old.xyz)) < 0.5 * length)
    if not len(inside) or inside[0] == 0 or inside[-1] == len(whole.rows) - 1:
        what = f"a length of {length:g} m reaches beyond an end of {whole.name}"
        raise BadInputError(what, whole.where, "give less")
    asked = attrs.evolve(whole, first=int(inside[0]) - 1, last=int(inside[-1]) + 1)
    asked.refuse_blocked(knuckles=False)
    radius, normals = fade_radii(state, fade, hollow.middle[None]), normals_at(state, asked.rows)
    marks, new = _equal(asked, hollow, length)
    held = held_marks(edit, asked, marks, drop=False)
    lead(edit, asked, [mark for mark in held if mark.moves(state)], new, radius, normals)
    edit.pending.ask(SpreadAreas).areas.append(
        SpreadArea(curve, asked.old, hollow.way, hollow.up, hollow.area)
    )


@attrs.frozen(eq=False)
class _Hollow:
    """A hollow or a bump, seen from the line that touches both its sides.

    Attributes
    ----------
    ends : (2,), m
        Parameters at which that line touches.
    middle : (3,), m
        Half-way between these places.
    way, up : (3,)
        Unit vectors along the line, and across it in the plane of the curve.
    length, depth : float, m
        From touch to touch, and how far the curve goes off the bridge over it.
    area : float, m2
        Between the curve and its bridge.
    old : SplineBatch
        The curve.
    slopes : (2,)
        Of the curve at both places.
    """

    ends: tuple[float, float]
    middle: FloatArray
    way: FloatArray
    up: FloatArray
    length: float
    depth: float
    area: float
    old: SplineBatch
    slopes: tuple[float, float]

    @classmethod
    def at(cls, part: LinePart, place: FloatArray) -> _Hollow:
        """Find the hollow about a place on a curve, m."""
        old, state = part.old, part.state
        normal = state.lines.normal[state.line_of(part.curve)]
        here = float(old.knot[int(((old.xyz - place) ** 2).sum(axis=1).argmin())])
        found = inflections(old, normal)[1].t
        turn = int(np.searchsorted(found, here))
        if not 0 < turn < len(found):
            what = f"{part.name} bends one way there up to an end of it"
            raise BadInputError(what, part.where, "choose a point in a hollow, or on a bump")
        around = np.concatenate([[old.knot[0]], found, [old.knot[-1]]])[turn - 1 : turn + 3]
        at = np.linspace(around[0], around[3], _SAMPLES)
        first, last = _touches(_places(old, at), normal, np.searchsorted(at, around[1:3]))
        return cls._between(part, normal, float(at[first]), float(at[last]))

    @classmethod
    def _between(cls, part: LinePart, normal: FloatArray, first: float, last: float) -> _Hollow:
        old = part.old
        low, high = _places(old, np.array([first, last]))
        chord = high - low
        length = float(np.sqrt((chord * chord).sum()))
        way = chord / length
        up = np.cross(normal, way)
        slope = derivative(old, np.zeros(2, np.int64), np.array([first, last]))
        slopes = (slope * up).sum(axis=1) / (slope * way).sum(axis=1)
        found = cls(
            (first, last), 0.5 * (low + high), way, up, length, 0.0, 0.0, old,
            (float(slopes[0]), float(slopes[1])),
        )  # fmt: skip
        at = np.linspace(first, last, _SAMPLES)
        xyz = _places(old, at)
        u = found.along(xyz)
        if (np.diff(u) <= 0.0).any():
            what = f"{part.name} turns back between the sides of the hollow"
            raise BadInputError(what, part.where, "choose a point in another hollow")
        off = found.beyond(xyz)
        area = float((0.5 * (off[1:] + off[:-1]) * np.diff(u)).sum())
        if float(off[np.abs(off).argmax()]) < 0.0:
            found = attrs.evolve(found, up=-up, slopes=(-found.slopes[0], -found.slopes[1]))
        return attrs.evolve(found, depth=float(np.abs(off).max()), area=abs(area))

    def too_short(self, asked: LinePart, length: float, least: float) -> OutOfRangeError:
        """Say that a length would not make it longer and shallower; `least` would hardly."""
        low = float(np.ceil(1e3 * least + 1.0) / 1e3)
        why = f"does not make a hollow of {self.length:.4g} m longer and shallower"
        most = asked.state.particulars.length
        return OutOfRangeError("a length", length, asked.where, why, low, most, "m")

    def along(self, xyz: FloatArray) -> FloatArray:
        """Give how far along the line places are from its middle, (k,), m."""
        found: FloatArray = ((xyz - self.middle) * self.way).sum(axis=1)
        return found

    def beyond(self, xyz: FloatArray) -> FloatArray:
        """Give how far places of the curve lie off the bridge, (k,), m; 0 outside it."""
        part = self.along(xyz) / self.length + 0.5
        inside = (part > 0.0) & (part < 1.0)
        s = np.where(inside, part, 0.0)
        bridge = self.length * s * (1.0 - s) * (self.slopes[0] * (1.0 - s) - self.slopes[1] * s)
        height = ((xyz - self.middle) * self.up).sum(axis=1)
        return np.where(inside, height - bridge, 0.0)

    def change(self, xyz: FloatArray, length: float, part: float) -> FloatArray:
        """Give by how much places of the curve go `up`, (k,), m; `part` scales the new hollow."""
        new = 2.0 * part * self.area / length * quintic_fade(2.0 * self.along(xyz) / length)
        return np.asarray(new - self.beyond(xyz))


def _places(spline: SplineBatch, at: FloatArray) -> FloatArray:
    return evaluate(spline, np.zeros(len(at), np.int64), at)


def _touches(xyz: FloatArray, normal: FloatArray, inner: IntArray) -> tuple[int, int]:
    """Give the two of some places (k, 3) that a line touches from one side, over the hollow.

    `inner` are the two places between which it is; the line touches before and behind them.
    """
    first, last = int(inner[0]), int(inner[1])
    up = np.cross(normal, xyz[last] - xyz[first])
    middle = xyz[(first + last) // 2] - xyz[first]
    up = -up if float((middle * up).sum()) > 0.0 else up
    for _ in range(_SAMPLES):
        before = first, last
        first = _steepest(xyz, up, last, np.arange(first + 1))
        last = _steepest(xyz, up, first, np.arange(last, len(xyz)))
        if (first, last) == before:
            break
    return first, last


def _steepest(xyz: FloatArray, up: FloatArray, pivot: int, others: IntArray) -> int:
    """Give the one of some places above the lines from a pivot to all others of them."""
    step = xyz[others] - xyz[pivot]
    height = (step * up).sum(axis=1)
    along = np.sqrt(np.maximum((step * step).sum(axis=1) * (up * up).sum() - height**2, 1e-300))
    return int(others[int((height / along).argmax())])


# --------------------------------------------------------------------------------------
# The new hollow. The line is lofted through its points, so the area is not quite that of what the
# points are taken from; the height is changed until it is.


def _equal(asked: LinePart, hollow: _Hollow, length: float) -> tuple[list[Mark], SplineBatch]:
    """Give the points of the part where they are to be, and the curve; its area is the old."""
    low, high = 0.0, 1.0
    marks = _marks(asked, hollow, length, low)
    off = [area_beside(asked.old, designed(asked.state, asked.curve, marks), hollow.way, hollow.up)]
    for _ in range(_TURNS):
        marks = _marks(asked, hollow, length, high)
        new = designed(asked.state, asked.curve, marks)
        off.append(area_beside(asked.old, new, hollow.way, hollow.up))
        if abs(off[-1]) <= _EQUAL * hollow.area:
            height = 2.0 * high * hollow.area / length
            if height >= hollow.depth:
                raise hollow.too_short(asked, length, _LONGER * length * height / hollow.depth)
            return marks, new
        if off[-1] == off[-2]:
            break
        low, high = high, high - off[-1] * (high - low) / (off[-1] - off[-2])
    what = f"too few points of {asked.name} lie within {length:g} m to keep the area"
    raise BadInputError(what, asked.where, "give another length, or add points (edit.insert)")


def _marks(asked: LinePart, hollow: _Hollow, length: float, part: float) -> list[Mark]:
    """Give where the points of the part go when the new hollow has a part of its height."""
    state, old = asked.state, asked.old
    found = list[Mark]()
    for place in range(asked.first + 1, asked.last):
        row, at = int(asked.rows[place]), float(old.knot[place])
        here = old.xyz[place]
        goal = here + hollow.change(here[None], length, part)[0] * hollow.up
        lines = [state.line_of(asked.curve)]
        if state.rows.sort[row] == Sort.CROSSING:
            other = state.line_of(int(state.rows.curve[row, 1 - asked.side(row)]))
            if not state.lines.planar[other]:
                asked.blocked([row], "a curve in space crosses the hollow", "give less length")
            at = _crossed(asked, hollow, length, part, place, other)
            there = _places(old, np.array([at]))
            goal = there[0] + hollow.change(there, length, part)[0] * hollow.up
            lines.append(other)
        goal = checked_in_planes(state, lines, goal, asked.where)
        found.append(Mark(row, goal, at, float(old.knot[place])))
    return found


def _crossed(
    asked: LinePart, hollow: _Hollow, length: float, part: float, place: int, other: int
) -> float:
    """Give the parameter of the old curve that comes to the plane of a line that crosses."""
    state, old = asked.state, asked.old
    normal, offset = state.lines.normal[other], float(state.lines.offset[other])

    def height(at: float) -> float:
        xyz = _places(old, np.array([at]))
        moved = xyz + hollow.change(xyz, length, part)[:, None] * hollow.up
        return float((moved[0] * normal).sum()) - offset

    here, low, high = (float(old.knot[at]) for at in (place, place - 1, place + 1))
    if height(here) == 0.0:
        return here
    if height(low) * height(high) >= 0.0:
        name = address(state, int(asked.rows[place]))
        what = f"{name} would pass a neighbouring point"
        raise BadInputError(what, asked.where, "give more length: the hollow is shallower then")
    return brent_root(height, low, high, xtol=1e-13)

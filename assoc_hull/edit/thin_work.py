"""The state of the thinning of a net: what lies on each curve, and what was chosen of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import attrs
import numpy as np

from assoc_hull.edit.match import Contact, Meeting
from assoc_hull.geometry.curves import CurveData, FloatArray, PointKind, SplineBatch
from assoc_hull.geometry.spline import loft
from assoc_hull.model.family import Role
from assoc_hull.model.source import LineSource
from assoc_hull.model.state import HullState

__all__ = [
    "SAME", "Item", "Left", "Net", "PointItem", "Thinned", "Work", "add_point", "kind_of",
    "knots_of", "loft_orders", "thinned_at", "xyz_of",
]  # fmt: skip


@attrs.frozen(eq=False)
class Net:
    """Given lines with their references and all that meets."""

    state: HullState
    sources: tuple[LineSource, ...]
    reference: SplineBatch
    contacts: tuple[Contact, ...]
    meetings: tuple[Meeting, ...]


@attrs.frozen(eq=False)
class PointItem:
    """A given point that defines its curve by itself."""

    curve: int
    xyz: FloatArray
    placed: bool
    kind: int
    direction: FloatArray


@attrs.frozen(eq=False)
class Thinned:
    """The outcome: roles in the order of contacts and meetings, points, and curve orders.

    `order` lists, per curve, indices into contacts, then meetings, then points. `left` tells
    the given points that a curve passes too far off and that could not be adopted.
    """

    contact_role: tuple[Role, ...]
    meeting_role: tuple[Role, ...]
    points: tuple[PointItem, ...]
    order: tuple[tuple[int, ...], ...]
    left: tuple[Left, ...]


@attrs.frozen
class Left:
    """A given point left out: the curve passes it `away` (m), more than the line's tolerance.

    It lies `beside` (m) a point the curve is made through, too close to adopt it; or, where
    `bends`, a point there would give the curve an inflection that its line lacks.
    """

    curve: int
    point: int
    away: float
    beside: float
    bends: bool = False


SAME = 1e-4
"""Places closer than this (m) are one place of the net."""


class Item(NamedTuple):
    """Something on a curve: a contact, a meeting, or a given point; `number` counts them all."""

    at: float
    number: int
    fixed: bool
    angle_deg: float


@attrs.define(eq=False)
class Work:
    """What lies on each curve, what of it was chosen, and the points that were added.

    Attributes
    ----------
    net : Net
        What was given.
    items : list of list of Item
        By curve, in order along it.
    chosen : list of set of int
        By curve, the numbers of the crossings that define it.
    points : list of PointItem
        Points by themselves.
    held : dict of int to list of int
        By curve, the numbers through which it was last found to hold its line.
    """

    net: Net
    items: list[list[Item]]
    chosen: list[set[int]]
    points: list[PointItem]
    held: dict[int, list[int]]

    @property
    def fixed_count(self) -> int:
        """Number of contacts and meetings; points are counted after them."""
        return len(self.net.contacts) + len(self.net.meetings)


def add_point(work: Work, curve: int, point: int) -> Item:
    """Put a given point on its curve as a point by itself."""
    source = work.net.sources[curve]
    at = float(work.net.reference.knot[work.net.reference.start[curve] + point])
    item = Item(at, work.fixed_count + len(work.points), True, 90.0)
    work.points.append(
        PointItem(
            curve,
            source.points[point],
            source.placed,
            int(source.kind[point]),
            source.direction[point],
        )
    )
    work.items[curve].append(item)
    work.items[curve].sort()
    return item


def xyz_of(work: Work, index: int) -> FloatArray:
    """Give the place of an item, (3,), m."""
    net = work.net
    if index < len(net.contacts):
        return net.contacts[index].xyz
    if index < work.fixed_count:
        return net.meetings[index - len(net.contacts)].spots[0]
    return work.points[index - work.fixed_count].xyz


def loft_orders(work: Work, curves: Sequence[int], orders: Sequence[Sequence[Item]]) -> SplineBatch:
    """Loft curves through the items that define them, one order to each curve named."""
    net = work.net
    start = np.zeros(len(orders) + 1, np.int64)
    np.cumsum([len(order) for order in orders], out=start[1:])
    pairs = list(zip(curves, orders, strict=True))
    kinds = [kind_of(work, curve, item.number) for curve, order in pairs for item in order]
    ends = [net.sources[curve].ends for curve in curves]
    return loft(
        CurveData(
            start,
            np.array([xyz_of(work, item.number) for order in orders for item in order]),
            np.array([kind for kind, _ in kinds], np.int8),
            np.array([direction for _, direction in kinds]),
            np.array([each.kind for each in ends], np.int8),
            np.array([each.vector for each in ends], np.float64),
        ),
        [net.state.curves.key.data[curve] for curve in curves],
    )


def kind_of(work: Work, curve: int, index: int) -> tuple[int, FloatArray]:
    """Give the `PointKind` of an item on a curve, and its direction, (3,)."""
    net = work.net
    if index < len(net.contacts) and net.contacts[index].curve == curve:
        source, point = net.sources[curve], net.contacts[index].point
        return int(source.kind[point]), source.direction[point]
    if index >= work.fixed_count:
        item = work.points[index - work.fixed_count]
        return item.kind, item.direction
    return int(PointKind.SMOOTH), np.zeros(3)


def knots_of(work: Work, curve: int) -> FloatArray:
    """Give the parameters of the given points of a curve, m."""
    reference = work.net.reference
    return reference.knot[int(reference.start[curve]) : int(reference.start[curve + 1])]


def is_thinned(work: Work, curve: int, item: Item) -> bool:
    """Tell whether an item is a crossing left out for its spacing alone.

    One that meets the other's plane at a small angle may define the curve under no rule: it
    slides along the hull by metres where the hull moves by millimetres.
    """
    steep = item.angle_deg >= work.net.state.tolerances.transversal_deg
    return steep and item.number < work.fixed_count and item.number not in work.chosen[curve]


def thinned_at(work: Work, curve: int, point: int) -> int | None:
    """Give the number of the crossing at a given point that does not define the curve."""
    place = work.net.sources[curve].points[point]
    for item in work.items[curve]:
        near = is_thinned(work, curve, item)
        if near and float(np.abs(xyz_of(work, item.number) - place).max()) < SAME:
            return item.number
    return None

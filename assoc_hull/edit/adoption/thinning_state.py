"""The state of the thinning of a net, and short hulls that are thinned at 100 m.

Lines of a short hull adopted at 100 m: grown before, and what was chosen brought back.

Which crossings and points define a curve hangs on comparisons by the hundred. Made at one size for
all hulls, of lines that are the same to the last bit, they come out the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.adoption.match_crossings import (
    Contact,
    LineIntersection,
    snap_to_coordinate_planes,
)
from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    PointKind,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.kinds import Role
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import Tolerances, at_full_length

__all__ = [
    "CurveItem",
    "OmittedPoint",
    "PointItem",
    "ReferenceNet",
    "ThinnedNet",
    "ThinningState",
    "add_point",
    "brought_back",
    "grown_sources",
    "grown_tolerances",
    "is_thinned",
    "knots_of",
    "loft_orders",
    "thinned_at",
]


@attrs.frozen(eq=False)
class ReferenceNet:
    """Given lines with their references and all that meets."""

    state: HullState
    sources: tuple[LineSource, ...]
    reference: SplineBatch
    contacts: tuple[Contact, ...]
    meetings: tuple[LineIntersection, ...]


@attrs.frozen(eq=False)
class PointItem:
    """A given point that defines its curve by itself."""

    curve: int
    xyz: FloatArray
    placed: bool
    kind: int
    direction: FloatArray


@attrs.frozen(eq=False)
class ThinnedNet:
    """The outcome: roles in the order of contacts and meetings, points, and curve orders.

    `order` lists, per curve, indices into contacts, then meetings, then points. `left` tells
    the given points that a curve passes too far off and that could not be adopted.
    """

    contact_role: tuple[Role, ...]
    meeting_role: tuple[Role, ...]
    points: tuple[PointItem, ...]
    order: tuple[tuple[int, ...], ...]
    left: tuple[OmittedPoint, ...]


@attrs.frozen
class OmittedPoint:
    """A given point left out: the curve passes it `away` (m), more than the line's tolerance.

    It lies `beside` (m) a point the curve is made through, too close to adopt it; or, where
    `bends`, a point there would give the curve an inflection that its line lacks.
    """

    curve: int
    point: int
    away: float
    beside: float
    bends: bool = False


_SAME_PLACE = 1e-4
"""Times `Tolerances.factor`: places closer than this (m) are one place of the net."""


class CurveItem(NamedTuple):
    """Something on a curve: a contact, a meeting, or a given point; `number` counts them all."""

    at: float
    number: int
    fixed: bool
    angle_deg: float


@attrs.define(eq=False)
class NumberedItems:
    """Contacts, then meetings, then points, by their numbers.

    Attributes
    ----------
    xyz : (n, 3), m
        Their places.
    curve : (n,) int
        The curve on which they have a kind of their own; on another one they are smooth.
    kind : (n,) int8
        Their `PointKind` on it.
    direction : (n, 3)
        Their direction on it.
    """

    xyz: FloatArray
    curve: IntArray
    kind: NDArray[np.int8]
    direction: FloatArray

    def add(self, point: PointItem) -> None:
        """Append a point."""
        self.xyz = np.concatenate([self.xyz, point.xyz[None]])
        self.curve = np.append(self.curve, point.curve)
        self.kind = np.append(self.kind, np.int8(point.kind))
        self.direction = np.concatenate([self.direction, point.direction[None]])

    def on(self, curve: IntArray, numbers: IntArray) -> tuple[NDArray[np.int8], FloatArray]:
        """Give the kinds, (k,), and directions, (k, 3), that items have on a curve each."""
        own = self.curve[numbers] == curve
        kind = np.where(own, self.kind[numbers], np.int8(PointKind.SMOOTH))
        return kind, np.where(own[:, None], self.direction[numbers], 0.0)


@attrs.define(eq=False)
class ThinningState:
    """What lies on each curve, what of it was chosen, and the points that were added.

    Attributes
    ----------
    net : ReferenceNet
        What was given.
    items : list of list of CurveItem
        By curve, in order along it.
    chosen : list of set of int
        By curve, the numbers of the crossings that define it.
    points : list of PointItem
        Points by themselves.
    held : dict of int to list of int
        By curve, the numbers through which it was last found to hold its line.
    given : NumberedItems
        All that has a number, as columns.
    barred : set of (int, int)
        Curves and the numbers of crossings at which they would fold.
    fixed_count : int
        Number of contacts and meetings; points are counted after them.
    """

    net: ReferenceNet
    items: list[list[CurveItem]]
    chosen: list[set[int]]
    points: list[PointItem]
    held: dict[int, list[int]]
    given: NumberedItems = attrs.field(init=False)
    barred: set[tuple[int, int]] = attrs.field(factory=set, init=False)
    fixed_count: int = attrs.field(init=False)

    def __attrs_post_init__(self) -> None:
        self.given = _given(self.net)
        self.fixed_count = len(self.net.contacts) + len(self.net.meetings)

    @property
    def same_place(self) -> float:
        """How close (m) places are one place of the net."""
        return _SAME_PLACE * self.net.state.tolerances.factor

    def numbers(self, order: Sequence[CurveItem]) -> IntArray:
        """Give the numbers of items, (k,)."""
        return np.array([item.number for item in order], np.int64)


def _given(net: ReferenceNet) -> NumberedItems:
    """Put contacts and meetings into columns.

    A contact has the kind that its plane curve was given there; all else, of the boundary too,
    is smooth.
    """
    count = len(net.contacts) + len(net.meetings)
    xyz = [each.xyz for each in net.contacts] + [each.spots[0] for each in net.meetings]
    curve, kind = np.full(count, -1), np.full(count, PointKind.SMOOTH, np.int8)
    direction = np.zeros((count, 3))
    for i, each in enumerate(net.contacts):
        source = net.sources[each.curve]
        curve[i], kind[i] = each.curve, source.kind[each.point]
        direction[i] = source.direction[each.point]
    return NumberedItems(np.array(xyz).reshape(-1, 3), curve, kind, direction)


def add_point(work: ThinningState, curve: int, point: int) -> CurveItem:
    """Put a given point on its curve as a point by itself."""
    source = work.net.sources[curve]
    at = float(work.net.reference.knot[work.net.reference.start[curve] + point])
    item = CurveItem(at, work.fixed_count + len(work.points), True, 90.0)
    added = PointItem(
        curve,
        source.points[point],
        source.placed,
        int(source.kind[point]),
        source.direction[point],
    )
    work.points.append(added)
    work.given.add(added)
    work.items[curve].append(item)
    work.items[curve].sort()
    return item


def loft_orders(
    work: ThinningState, curves: Sequence[int], orders: Sequence[Sequence[CurveItem]]
) -> SplineBatch:
    """Loft curves through the items that define them, one order to each curve named."""
    net, sizes = work.net, [len(order) for order in orders]
    start = np.zeros(len(orders) + 1, np.int64)
    np.cumsum(sizes, out=start[1:])
    numbers = work.numbers([item for order in orders for item in order])
    kind, direction = work.given.on(np.repeat(np.asarray(curves, np.int64), sizes), numbers)
    ends = [net.sources[curve].ends for curve in curves]
    return loft(
        CurveData(
            start,
            work.given.xyz[numbers],
            kind,
            direction,
            np.array([each.kind for each in ends], np.int8),
            np.array([each.vector for each in ends], np.float64),
        ),
        [net.state.curves.key[curve] for curve in curves],
    )


def knots_of(work: ThinningState, curve: int) -> FloatArray:
    """Give the parameters of the given points of a curve, m."""
    reference = work.net.reference
    return reference.knot[int(reference.start[curve]) : int(reference.start[curve + 1])]


def is_thinned(work: ThinningState, curve: int, item: CurveItem) -> bool:
    """Tell whether an item is a crossing left out for its spacing alone.

    One that meets the other's plane at a small angle may define the curve under no rule: it
    slides along the hull by metres where the hull moves by millimetres.
    """
    steep = item.angle_deg >= work.net.state.tolerances.transversal_deg
    left = item.number not in work.chosen[curve] and (curve, item.number) not in work.barred
    return steep and item.number < work.fixed_count and left


def thinned_at(work: ThinningState, curve: int, point: int) -> int | None:
    """Give the number of the crossing at a given point that does not define the curve."""
    place = work.net.sources[curve].points[point]
    for item in work.items[curve]:
        near = is_thinned(work, curve, item)
        if near and float(np.abs(work.given.xyz[item.number] - place).max()) < work.same_place:
            return item.number
    return None


def grown_sources(sources: Sequence[LineSource], factor: float) -> Sequence[LineSource]:
    """Give lines at 100 m, decimals as decimals; the lines themselves where the factor is 1."""
    return sources if factor == 1.0 else [_grown(each, factor) for each in sources]


def _grown(source: LineSource, factor: float) -> LineSource:
    points = at_full_length(source.points, factor)
    near = at_full_length(source.tolerance, factor)
    freeze(points, near)
    return attrs.evolve(
        source, points=points, offset=float(at_full_length(source.offset, factor)),
        tolerance=near if near.ndim else float(near),
    )  # fmt: skip


def grown_tolerances(tolerances: Tolerances) -> Tolerances:
    """Give the tolerances of the hull at 100 m."""
    factor = tolerances.factor
    grown = tolerances.scaled(1.0 / factor)
    lengths = {
        name: float(at_full_length(getattr(tolerances, name), factor))
        for name in attrs.asdict(grown) if getattr(grown, name) != getattr(tolerances, name)
    }  # fmt: skip
    return attrs.evolve(grown, **lengths)


def brought_back(
    net: ReferenceNet,
    thinned: ThinnedNet,
    state: HullState,
    sources: Sequence[LineSource],
    reference: SplineBatch,
) -> tuple[ReferenceNet, ThinnedNet]:
    """Give a net of grown lines, and what was chosen, at the size of a hull's own lines.

    `state` holds the lines and tolerances of the hull, `reference` the splines of `sources`.
    """
    factor = state.tolerances.factor
    own = ReferenceNet(
        state, tuple(sources), reference,
        tuple(_contact(net, each, state, sources, factor) for each in net.contacts),
        tuple(_meeting(each, state, factor) for each in net.meetings),
    )  # fmt: skip
    points = tuple(
        attrs.evolve(each, xyz=_given_place(net, each, sources)) for each in thinned.points
    )
    left = tuple(_left(each, factor) for each in thinned.left)
    return own, attrs.evolve(thinned, points=points, left=left)


def _contact(
    net: ReferenceNet,
    contact: Contact,
    state: HullState,
    sources: Sequence[LineSource],
    factor: float,
) -> Contact:
    """Bring a contact back; where it is the very point of its line it stays that."""
    given = net.sources[contact.curve].points[contact.point]
    mine = sources[contact.curve].points[contact.point]
    place = np.where(contact.xyz == given, mine, factor * contact.xyz)
    xyz = _in_planes(state, (contact.boundary, contact.curve), place)
    return attrs.evolve(contact, at=factor * contact.at, xyz=xyz)


def _meeting(meeting: LineIntersection, state: HullState, factor: float) -> LineIntersection:
    first, second = (
        _in_planes(state, (meeting.a, meeting.b), factor * each) for each in meeting.spots
    )
    at = (factor * meeting.at[0], factor * meeting.at[1])
    return attrs.evolve(meeting, at=at, spots=(first, second), gap=factor * meeting.gap)


def _in_planes(state: HullState, curves: tuple[int, int], place: FloatArray) -> FloatArray:
    """Put a place exactly into the planes of two curves, as it is at 100 m."""
    lines = tuple(
        line for line in map(state.line_of, curves) if state.lines.planar[line]
    )  # fmt: skip
    return snap_to_coordinate_planes(state, lines, place)


def _given_place(net: ReferenceNet, point: PointItem, sources: Sequence[LineSource]) -> FloatArray:
    """Give the point of a hull's own line that was adopted at 100 m."""
    grown = net.sources[point.curve].points
    number = int(np.flatnonzero((grown == point.xyz).all(axis=1))[0])
    found: FloatArray = sources[point.curve].points[number]
    return found


def _left(point: OmittedPoint, factor: float) -> OmittedPoint:
    return attrs.evolve(point, away=factor * point.away, beside=factor * point.beside)

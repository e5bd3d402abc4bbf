"""Which crossings define which curves of an adopted net, and where points must be added.

The role rule chooses; then, as long as a given point lies farther from its curve than the
tolerance, the thinned crossing there is taken back in, or else the point itself is adopted,
unless it would stand so close beside another point that the curve had to turn between them.
"""

from __future__ import annotations

from collections import defaultdict
from typing import NamedTuple

import attrs
import numpy as np

from assoc_hull.edit.dense import amid, near, room, sharp
from assoc_hull.edit.match import Contact, Meeting
from assoc_hull.edit.thin_gaps import wide_gaps
from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.curves import CurveData, FloatArray, PointKind, SplineBatch
from assoc_hull.geometry.spline import derivative, loft
from assoc_hull.model.family import Role
from assoc_hull.model.roles import Candidates, choose, role_of
from assoc_hull.model.source import LineSource
from assoc_hull.model.state import HullState

__all__ = ["Left", "Net", "PointItem", "Thinned", "thin"]


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
    """A given point left out: it lies `beside` (m) a point its curve is made through.

    The curve passes it `away` (m), which is more than the tolerance of the line.
    """

    curve: int
    point: int
    away: float
    beside: float


_GAP = 0.4
"""Densely drawn curves are held so that watched gaps keep below this part of the tolerance."""

_SAME = 1e-4
"""Places closer than this (m) are one place of the net."""


class _Item(NamedTuple):
    """Something on a curve: a contact, a meeting, or a given point; `number` counts them all."""

    at: float
    number: int
    fixed: bool
    angle_deg: float


@attrs.define(eq=False)
class _Thinning:
    net: Net
    items: list[list[_Item]]
    chosen: list[set[int]]
    points: list[PointItem]
    point_at: list[tuple[int, float]]
    held: dict[int, list[int]]

    @property
    def fixed_count(self) -> int:
        return len(self.net.contacts) + len(self.net.meetings)


def thin(net: Net) -> Thinned:
    """Choose the defining crossings and the adopted points of a net."""
    work = _Thinning(net, [[] for _ in net.sources], [set() for _ in net.sources], [], [], {})
    _collect(work)
    for curve in range(len(net.sources)):
        work.chosen[curve] = _rule(work, curve)
    for _ in range(200):
        roles = _roles(work)
        orders = _orders(work, roles)
        splines = _loft_orders(net, orders, work)
        worst, left = _worst(net, splines, orders, work)
        worst = worst or _wide(net, splines, orders, work, roles)
        if not worst:
            break
        for curve, point in worst:
            _take_in(work, curve, point, orders[curve])
    return _outcome(work, roles, orders, left)


def _outcome(
    work: _Thinning, roles: list[Role], orders: list[list[_Item]], left: list[Left]
) -> Thinned:
    """Put the outcome together, with numbers for the points that are used only."""
    contacts, first = len(work.net.contacts), work.fixed_count
    used = sorted({item.number for order in orders for item in order if item.number >= first})
    number = {old: first + new for new, old in enumerate(used)}
    return Thinned(
        tuple(roles[:contacts]),
        tuple(roles[contacts:]),
        tuple(work.points[index - first] for index in used),
        tuple(tuple(number.get(item.number, item.number) for item in order) for order in orders),
        tuple(left),
    )


def _collect(work: _Thinning) -> None:
    """Put contacts, meetings and points that stand by themselves on their curves."""
    net = work.net
    held: set[tuple[int, int]] = set()
    for index, contact in enumerate(net.contacts):
        knot = float(net.reference.knot[net.reference.start[contact.curve] + contact.point])
        work.items[contact.curve].append(_Item(knot, index, True, 90.0))
        angle = _angle_on_boundary(net, contact)
        work.items[contact.boundary].append(_Item(contact.at, index, False, angle))
        held.add((contact.curve, contact.point))
    for index, meeting in enumerate(net.meetings, len(net.contacts)):
        for curve, at, angle in zip(
            (meeting.a, meeting.b), meeting.at, meeting.angle_deg, strict=True
        ):
            work.items[curve].append(_Item(at, index, False, angle))
    for curve, source in enumerate(net.sources):
        last = len(source.points) - 1
        for point in range(last + 1):
            alone = source.placed or point in (0, last) or source.kind[point] != PointKind.SMOOTH
            if alone and (curve, point) not in held:
                _add_point(work, curve, point)
    for curve in range(len(net.sources)):
        work.items[curve].sort()


def _angle_on_boundary(net: Net, contact: Contact) -> float:
    line = net.state.line_of(contact.curve)
    slope = derivative(net.reference, np.array([contact.boundary]), np.array([contact.at]))[0]
    cosine = abs(float(slope @ net.state.lines.normal.data[line])) / float(np.linalg.norm(slope))
    return float(np.degrees(np.arcsin(min(1.0, cosine))))


def _add_point(work: _Thinning, curve: int, point: int) -> None:
    source = work.net.sources[curve]
    at = float(work.net.reference.knot[work.net.reference.start[curve] + point])
    index = work.fixed_count + len(work.points)
    work.points.append(
        PointItem(
            curve,
            source.points[point],
            source.placed,
            int(source.kind[point]),
            source.direction[point],
        )
    )
    work.point_at.append((curve, at))
    work.items[curve].append(_Item(at, index, True, 90.0))
    work.items[curve].sort()


def _rule(work: _Thinning, curve: int) -> set[int]:
    """Apply the role rule to all that lies on one curve."""
    items = work.items[curve]
    at = np.array([item.at for item in items])
    slope = derivative(work.net.reference, np.full(len(items), curve), at)
    tangent = slope / np.linalg.norm(slope, axis=1)[:, None]
    candidates = Candidates(
        at,
        np.array([item.angle_deg for item in items]),
        tangent,
        np.array([item.fixed for item in items]),
    )
    picked = choose(candidates, work.net.state.tolerances)
    return {item.number for item, take in zip(items, picked.tolist(), strict=True) if take}


def _roles(work: _Thinning) -> list[Role]:
    net, chosen = work.net, work.chosen
    roles = [
        Role.SHARED if i in chosen[contact.boundary] else Role.DRIVES_B
        for i, contact in enumerate(net.contacts)
    ]
    for i, meeting in enumerate(net.meetings, len(net.contacts)):
        generates = _generates(net.state, meeting)
        roles.append(role_of(i in chosen[meeting.a], i in chosen[meeting.b], generates))
    return roles


def _generates(state: HullState, meeting: Meeting) -> tuple[bool, bool]:
    """Tell whether the group of a generates on that of b, and back."""
    names = [
        state.groups.name.data[int(state.lines.group.data[state.line_of(curve)])]
        for curve in (meeting.a, meeting.b)
    ]
    found = [False, False]
    for link in state.associations:
        if [link.a, link.b] == names:
            found = [True, link.two_way]
        elif [link.b, link.a] == names:
            found = [link.two_way, True]
    return found[0], found[1]


def _orders(work: _Thinning, roles: list[Role]) -> list[list[_Item]]:
    """List what defines each curve, in order along it."""
    net = work.net
    defines: defaultdict[int, set[int]] = defaultdict(set)
    for i, role in enumerate(roles):
        link = net.contacts[i] if i < len(net.contacts) else net.meetings[i - len(net.contacts)]
        first, second = (
            (link.boundary, link.curve) if isinstance(link, Contact) else (link.a, link.b)
        )
        if role in (Role.SHARED, Role.DRIVES_A):
            defines[first].add(i)
        if role in (Role.SHARED, Role.DRIVES_B):
            defines[second].add(i)
    for i, point in enumerate(work.points, work.fixed_count):
        defines[point.curve].add(i)
    return [
        _apart(work, [item for item in items if item.number in defines[curve]])
        for curve, items in enumerate(work.items)
    ]


def _apart(work: _Thinning, order: list[_Item]) -> list[_Item]:
    """Leave out adopted points at which a crossing has come to define the curve."""
    crossings = [item.number for item in order if item.number < work.fixed_count]
    if len(crossings) in (0, len(order)):
        return order
    held = np.array([_xyz(work, number) for number in crossings])
    return [
        item
        for item in order
        if item.number < work.fixed_count
        or np.abs(held - _xyz(work, item.number)).max(axis=1).min() >= _SAME
    ]


def _xyz(work: _Thinning, index: int) -> FloatArray:
    net = work.net
    if index < len(net.contacts):
        return net.contacts[index].xyz
    if index < work.fixed_count:
        return net.meetings[index - len(net.contacts)].spots[0]
    return work.points[index - work.fixed_count].xyz


def _loft_orders(net: Net, orders: list[list[_Item]], work: _Thinning) -> SplineBatch:
    start = np.zeros(len(orders) + 1, np.int64)
    np.cumsum([len(order) for order in orders], out=start[1:])
    kinds, directions = [], []
    for curve, order in enumerate(orders):
        for item in order:
            kind, direction = _kind(work, curve, item.number)
            kinds.append(kind)
            directions.append(direction)
    return loft(
        CurveData(
            start,
            np.array([_xyz(work, item.number) for order in orders for item in order]),
            np.array(kinds, np.int8),
            np.array(directions),
            np.array([source.ends.kind for source in net.sources], np.int8),
            np.array([source.ends.vector for source in net.sources], np.float64),
        ),
        list(net.state.curves.key.data),
    )


def _kind(work: _Thinning, curve: int, index: int) -> tuple[int, FloatArray]:
    net = work.net
    if index < len(net.contacts) and net.contacts[index].curve == curve:
        source, point = net.sources[curve], net.contacts[index].point
        return int(source.kind[point]), source.direction[point]
    if index >= work.fixed_count:
        item = work.points[index - work.fixed_count]
        return item.kind, item.direction
    return int(PointKind.SMOOTH), np.zeros(3)


def _wide(
    net: Net, splines: SplineBatch, orders: list[list[_Item]], work: _Thinning, roles: list[Role]
) -> list[tuple[int, int]]:
    """Give, per curve, a given point to be taken in because a watched gap is wide."""
    watched = [
        meeting
        for meeting, role in zip(net.meetings, roles[len(net.contacts) :], strict=True)
        if role is Role.WATCHED and all(net.sources[each].dense for each in (meeting.a, meeting.b))
    ]
    tolerances = net.state.tolerances
    pairs = iter(wide_gaps(net.reference, splines, watched, _GAP * tolerances.adoption))
    found: dict[int, int] = {}
    for pair in zip(pairs, pairs, strict=True):
        for curve, at in pair:
            edges = np.array([item.at for item in orders[curve]])
            point = near(edges, _knots(work, curve), at, tolerances.adopted_spacing)
            if point >= 0:
                found.setdefault(curve, point)
                break
    return sorted(found.items())


def _worst(
    net: Net, splines: SplineBatch, orders: list[list[_Item]], work: _Thinning
) -> tuple[list[tuple[int, int]], list[Left]]:
    """Give, per curve that passes given points too far off, the worst one to be taken in.

    Also given are the points that cannot be: beside a point that defines the curve already a
    second one would only make it turn.
    """
    found: list[tuple[int, int]] = []
    left: list[Left] = []
    for curve, source in enumerate(net.sources):
        numbers = [item.number for item in orders[curve]]
        if work.held.get(curve) == numbers:  # made through the same points as when it held
            continue
        known = np.array([_xyz(work, number) for number in numbers])
        step = source.points[:, None, :] - known[None, :, :]
        open_ = np.flatnonzero(np.abs(step).max(axis=2).min(axis=1) > _SAME)
        away = np.zeros(len(source.points))
        away[open_] = closest(splines, curve, source.points[open_])[2]
        beside = np.sqrt((step * step).sum(axis=2)).min(axis=1)
        if source.dense:
            edges = np.array([item.at for item in orders[curve]])
            away[~room(edges, _knots(work, curve), net.state.tolerances.adopted_spacing)] = 0.0
        for point in np.flatnonzero(away > source.tolerance).tolist():
            close = beside[point] < net.state.tolerances.adopted_spacing
            if close and not source.dense and _thinned(work, curve, point) is None:
                left.append(Left(curve, point, float(away[point]), float(beside[point])))
                away[point] = 0.0
        worst = int((away / source.tolerance).argmax())
        if not (away > source.tolerance).any():
            worst = _sharp(work, curve, orders[curve], known) if source.dense else -1
        if worst >= 0:
            found.append((curve, worst))
        elif not any(each.curve == curve for each in left):
            work.held[curve] = numbers
    return found, left


def _thinned(work: _Thinning, curve: int, point: int) -> int | None:
    """Give the number of the crossing at a given point that does not define the curve."""
    place = work.net.sources[curve].points[point]
    for item in work.items[curve]:
        near = item.number < work.fixed_count and item.number not in work.chosen[curve]
        if near and float(np.abs(_xyz(work, item.number) - place).max()) < _SAME:
            return item.number
    return None


def _sharp(work: _Thinning, curve: int, order: list[_Item], known: FloatArray) -> int:
    """Give a given point where the chords of a dense line would fold; -1 if nowhere."""
    edges = np.array([item.at for item in order])
    kinds = [_kind(work, curve, item.number)[0] == PointKind.KNUCKLE for item in order]
    return sharp(known, edges, _knots(work, curve), np.array(kinds))


def _knots(work: _Thinning, curve: int) -> FloatArray:
    """Give the parameters of the given points of a curve, m."""
    reference = work.net.reference
    return reference.knot[int(reference.start[curve]) : int(reference.start[curve + 1])]


def _take_in(work: _Thinning, curve: int, point: int, order: list[_Item]) -> None:
    """Take the thinned crossing at a given point back in, or adopt the point.

    Of a dense line a point or crossing amid the interval will do.
    """
    crossing = _thinned(work, curve, point)
    if crossing is None and work.net.sources[curve].dense:
        edges = np.array([item.at for item in order])
        point, target, reach = amid(edges, _knots(work, curve), point)
        for item in sorted(work.items[curve], key=lambda each: abs(each.at - target)):
            thinned = item.number < work.fixed_count and item.number not in work.chosen[curve]
            if thinned and abs(item.at - target) < reach:
                crossing = item.number
                break
    if crossing is None:
        _add_point(work, curve, point)
    else:
        work.chosen[curve].add(crossing)

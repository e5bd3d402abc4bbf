"""Which crossings define which curves of an adopted net, and where points must be added.

The role rule chooses; then, as long as a given point lies farther from its curve than the
tolerance, the thinned crossing there is taken back in, or else the point itself is adopted,
unless it would stand so close beside another point that the curve had to turn between them.
"""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from assoc_hull.edit.adoption.dense_lines import amid
from assoc_hull.edit.adoption.match_crossings import Contact, Meeting
from assoc_hull.edit.adoption.thin_polish import polish
from assoc_hull.edit.adoption.thin_worst import find_wide, find_worst
from assoc_hull.edit.adoption.thinning_state import (
    SAME,
    Item,
    Left,
    Net,
    Thinned,
    Work,
    add_point,
    is_thinned,
    knots_of,
    loft_orders,
    thinned_at,
)
from assoc_hull.geometry.curves import PointKind
from assoc_hull.geometry.splines.evaluation import derivative
from assoc_hull.model.kinds import Role
from assoc_hull.model.roles import Candidates, choose, role_of
from assoc_hull.model.state import HullState

__all__ = ["thin"]


def thin(net: Net) -> Thinned:
    """Choose the defining crossings and the adopted points of a net."""
    work = Work(net, [[] for _ in net.sources], [set() for _ in net.sources], [], {})
    _collect(work)
    for curve in range(len(net.sources)):
        work.chosen[curve] = _rule(work, curve)
    generates = [_generates(net.state, meeting) for meeting in net.meetings]
    for _ in range(200):
        roles = _roles(work, generates)
        orders = _orders(work, roles)
        splines = loft_orders(work, range(len(orders)), orders)
        worst, left = find_worst(net, splines, orders, work)
        worst = worst or find_wide(net, splines, orders, work, roles)
        if not worst:
            break
        for curve, point in worst:
            _take_in(work, curve, point, orders[curve])
    orders = [_spread(work, curve, order) for curve, order in enumerate(orders)]
    orders, more = polish(work, orders)
    return _outcome(work, roles, orders, [*left, *more])


def _spread(work: Work, curve: int, order: list[Item]) -> list[Item]:
    """Leave out adopted points of a dense curve that stand beside a crossing.

    A crossing may have come to define the curve after the point was adopted.
    """
    if not work.net.sources[curve].dense:
        return order
    first, last = len(work.net.contacts), work.fixed_count
    held = np.array([item.at for item in order if first <= item.number < last])
    if not len(held):
        return order
    spacing = work.net.state.tolerances.adopted_spacing

    def crowded(item: Item) -> bool:
        if item.number < last:
            return False
        point = work.points[item.number - last]
        free = point.kind == PointKind.SMOOTH and not point.placed
        return (
            free
            and item not in (order[0], order[-1])
            and float(np.abs(held - item.at).min()) < spacing
        )

    return [item for item in order if not crowded(item)]


def _outcome(work: Work, roles: list[Role], orders: list[list[Item]], left: list[Left]) -> Thinned:
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


def _collect(work: Work) -> None:
    """Put contacts, meetings and points that stand by themselves on their curves."""
    net = work.net
    held: set[tuple[int, int]] = set()
    for index, contact in enumerate(net.contacts):
        knot = float(net.reference.knot[net.reference.start[contact.curve] + contact.point])
        work.items[contact.curve].append(Item(knot, index, True, 90.0))
        angle = _angle_on_boundary(net, contact)
        work.items[contact.boundary].append(Item(contact.at, index, False, angle))
        held.add((contact.curve, contact.point))
    for index, meeting in enumerate(net.meetings, len(net.contacts)):
        for curve, at, angle in zip(
            (meeting.a, meeting.b), meeting.at, meeting.angle_deg, strict=True
        ):
            work.items[curve].append(Item(at, index, False, angle))
    for curve, source in enumerate(net.sources):
        last = len(source.points) - 1
        for point in range(last + 1):
            alone = source.placed or point in (0, last) or source.kind[point] != PointKind.SMOOTH
            if alone and (curve, point) not in held:
                add_point(work, curve, point)
    for curve in range(len(net.sources)):
        work.items[curve].sort()


def _angle_on_boundary(net: Net, contact: Contact) -> float:
    line = net.state.line_of(contact.curve)
    slope = derivative(net.reference, np.array([contact.boundary]), np.array([contact.at]))[0]
    cosine = abs(float(slope @ net.state.lines.normal.data[line])) / float(np.linalg.norm(slope))
    return float(np.degrees(np.arcsin(min(1.0, cosine))))


def _rule(work: Work, curve: int) -> set[int]:
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


def _roles(work: Work, generates: list[tuple[bool, bool]]) -> list[Role]:
    net, chosen = work.net, work.chosen
    roles = [
        Role.SHARED
        if i in chosen[contact.boundary] and _may_define(net.state, contact)
        else Role.DRIVES_B
        for i, contact in enumerate(net.contacts)
    ]
    pairs = zip(net.meetings, generates, strict=True)
    for i, (meeting, given) in enumerate(pairs, len(net.contacts)):
        roles.append(role_of(i in chosen[meeting.a], i in chosen[meeting.b], given))
    return roles


def _may_define(state: HullState, contact: Contact) -> bool:
    """Tell whether the line that ends, turns or leaves a flat may define the boundary curve."""
    return _between(state, contact.boundary, contact.curve)[1]


def _generates(state: HullState, meeting: Meeting) -> tuple[bool, bool]:
    """Tell whether the group of a generates on that of b, and back."""
    return _between(state, meeting.a, meeting.b)


def _between(state: HullState, a: int, b: int) -> tuple[bool, bool]:
    """Tell whether the group of one curve generates on that of another, and back."""
    names = [
        state.groups.name.data[int(state.lines.group.data[state.line_of(curve)])]
        for curve in (a, b)
    ]
    found = [False, False]
    for link in state.associations:
        if [link.a, link.b] == names:
            found = [True, link.two_way]
        elif [link.b, link.a] == names:
            found = [link.two_way, True]
    return found[0], found[1]


def _orders(work: Work, roles: list[Role]) -> list[list[Item]]:
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


def _apart(work: Work, order: list[Item]) -> list[Item]:
    """Leave out adopted points at which a crossing has come to define the curve."""
    numbers = work.numbers(order)
    crossing = numbers < work.fixed_count
    if crossing.all() or not crossing.any():
        return order
    xyz = work.given.xyz[numbers]
    apart = np.abs(xyz[:, None] - xyz[crossing][None]).max(axis=2).min(axis=1) >= SAME
    return [item for item, kept in zip(order, (crossing | apart).tolist(), strict=True) if kept]


def _take_in(work: Work, curve: int, point: int, order: list[Item]) -> None:
    """Take the thinned crossing at a given point back in, or adopt the point.

    Of a dense line a point or crossing amid the interval will do.
    """
    crossing = thinned_at(work, curve, point)
    if crossing is None and work.net.sources[curve].dense:
        edges = np.array([item.at for item in order])
        point, target, reach = amid(edges, knots_of(work, curve), point)
        for item in sorted(work.items[curve], key=lambda each: abs(each.at - target)):
            thinned = is_thinned(work, curve, item)
            if thinned and abs(item.at - target) < reach:
                crossing = item.number
                break
    if crossing is None:
        add_point(work, curve, point)
    else:
        work.chosen[curve].add(crossing)

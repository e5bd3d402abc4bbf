"""Choose which crossings define which curves of an adopted net, and where points are added.

The role rule chooses; then, as long as a given point lies farther from its curve than the
tolerance, the thinned crossing there is taken back in, or the point itself is adopted, unless it
stands so close beside another point that the curve would have to turn between them. At last adopted
points of dense curves are moved or dropped that give an inflection which the given line lacks.
"""

from __future__ import annotations

from collections import defaultdict

import attrs
import numpy as np

from assoc_hull.edit.adoption.match_crossings import Contact, LineIntersection
from assoc_hull.edit.adoption.thinned_deviations import (
    chord_cosines,
    distances,
    find_wide,
    find_worst,
    point_amid_interval,
)
from assoc_hull.edit.adoption.thinning_state import (
    CurveItem,
    OmittedPoint,
    ReferenceNet,
    ThinnedNet,
    ThinningState,
    add_point,
    is_thinned,
    knots_of,
    loft_orders,
    thinned_at,
)
from assoc_hull.geometry.curves import PointKind, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.model.kinds import Role
from assoc_hull.model.roles import Candidates, choose, role_of
from assoc_hull.model.tables import HullState

__all__ = [
    "remove_added_inflections",
    "thin_net",
]

# --------------------------------------------------------------------------------------
# Added inflections. A neighbouring given point often does as well without one; else the adopted
# point is dropped where the curve still passes its line by less than `_MOST`, and that is reported.

_MOST = 2.0
"""A point is dropped for an inflection where the line is passed by less than this many times
its tolerance."""

_TRIES = 6
"""Given points to each side of an adopted one that are tried in its place."""


@attrs.frozen
class _Change:
    """A change of one adopted point: to another given point, or none; what is then allowed."""

    place: int
    point: int
    allowed: float


@attrs.frozen
class _Shape:
    """A curve against its line: inflections too many, and the largest part of the tolerance."""

    excess: int
    part: float


def remove_added_inflections(
    work: ThinningState, orders: list[list[CurveItem]]
) -> tuple[list[list[CurveItem]], list[OmittedPoint]]:
    """Move or drop adopted points of dense plane curves that add inflections.

    Points that take the place of others are added to `work`. Gives what defines each curve with
    the changes, and the given points passed farther off than the tolerance for it.
    """
    out, left = list(orders), []
    for curve, source in enumerate(work.net.sources):
        if not source.dense or source.normal is None:
            continue
        goal = int(inflections(work.net.reference.curve(curve), source.normal)[0][0])
        shape = _shape(work, curve, out[curve], goal)
        before = shape
        while shape.excess > 0:
            better = _better(work, curve, out[curve], goal, shape)
            if better is None:
                break
            out[curve], shape = better
        if shape.part > max(1.0, before.part):
            left.append(_left(work, curve, out[curve]))
    return out, left


def _better(
    work: ThinningState, curve: int, order: list[CurveItem], goal: int, shape: _Shape
) -> tuple[list[CurveItem], _Shape] | None:
    """Change the one adopted point that leaves the fewest inflections; None if none does."""
    normal = work.net.sources[curve].normal
    assert normal is not None
    changes = [
        change
        for place in range(1, len(order) - 1)
        if _may_go(work, order[place])
        for change in _changes(work, curve, order, place)
    ]
    trials = [_changed(work, curve, order, change) for change in changes]
    if not trials:
        return None
    splines = loft_orders(work, [curve] * len(trials), trials)
    excess = np.maximum(inflections(splines, np.tile(normal, (len(trials), 1)))[0] - goal, 0)
    found = None
    for i in np.argsort(excess, kind="stable").tolist():
        if excess[i] >= shape.excess or (found and excess[i] > found[1].excess):
            break
        part = _part(work, curve, trials[i], splines, i)
        if part <= max(changes[i].allowed, shape.part) and (not found or part < found[1].part):
            found = trials[i], _Shape(int(excess[i]), part)
    return found


def _may_go(work: ThinningState, item: CurveItem) -> bool:
    """Tell whether an item is an adopted point, no crossing and no placed point or knuckle."""
    if item.number < work.fixed_count:
        return False
    point = work.points[item.number - work.fixed_count]
    return point.kind == PointKind.SMOOTH and not point.placed


def _changes(work: ThinningState, curve: int, order: list[CurveItem], place: int) -> list[_Change]:
    """List the given points that may take the place of one, and the change that drops it."""
    knots = knots_of(work, curve)
    low, high = order[place - 1].at, order[place + 1].at
    here = int(np.abs(knots - order[place].at).argmin())
    spacing = work.net.state.tolerances.adopted_spacing
    near = range(max(here - _TRIES, 1), min(here + _TRIES + 1, len(knots) - 1))
    moves = [
        _Change(place, point, 1.0)
        for point in near
        if point != here and low + spacing < float(knots[point]) < high - spacing
    ]
    return [*moves, _Change(place, -1, _MOST)]


def _changed(
    work: ThinningState, curve: int, order: list[CurveItem], change: _Change
) -> list[CurveItem]:
    before, after = order[: change.place], order[change.place + 1 :]
    if change.point < 0:
        return [*before, *after]
    return [*before, add_point(work, curve, change.point), *after]


def _shape(work: ThinningState, curve: int, order: list[CurveItem], goal: int) -> _Shape:
    source = work.net.sources[curve]
    spline = loft_orders(work, [curve], [order])
    assert source.normal is not None
    excess = int(inflections(spline, source.normal)[0][0]) - goal
    return _Shape(max(excess, 0), _part(work, curve, order, spline, 0))


def _part(
    work: ThinningState, curve: int, order: list[CurveItem], splines: SplineBatch, number: int
) -> float:
    """Give the largest distance of a given point from a curve in parts of its tolerance."""
    away = distances(work, [curve], [order], splines, [number])[0][0]
    return float((away / work.net.sources[curve].tolerance).max())


def _left(work: ThinningState, curve: int, order: list[CurveItem]) -> OmittedPoint:
    """Say which given point is passed farthest off for its tolerance."""
    spline = loft_orders(work, [curve], [order])
    away, beside = distances(work, [curve], [order], spline, [0])[0]
    point = int((away / work.net.sources[curve].tolerance).argmax())
    return OmittedPoint(curve, point, float(away[point]), float(beside[point]), True)


# --------------------------------------------------------------------------------------
# The choice.


def thin_net(net: ReferenceNet) -> ThinnedNet:
    """Choose the defining crossings and the adopted points of a net."""
    work = ThinningState(net, [[] for _ in net.sources], [set() for _ in net.sources], [], {})
    _collect(work)
    for curve in range(len(net.sources)):
        work.chosen[curve] = _rule(work, curve)
    generates = [_generates(net.state, meeting) for meeting in net.meetings]
    for _ in range(200):
        roles = _roles(work, generates)
        orders = _orders(work, roles)
        splines = loft_orders(work, range(len(orders)), orders)
        worst, left = find_worst(net, splines, orders, work)
        # gaps come last, when every curve holds its own points
        worst = worst or find_wide(net, splines, orders, work, roles)
        if not worst and not _unfold(work, orders):
            break
        for curve, point in worst:
            _take_in(work, curve, point, orders[curve])
    orders = [_spread(work, curve, order) for curve, order in enumerate(orders)]
    orders, more = remove_added_inflections(work, orders)
    return _outcome(work, roles, orders, [*left, *more])


def _unfold(work: ThinningState, orders: list[list[CurveItem]]) -> bool:
    """Bar crossings at which dense curves fold; False if there are none.

    Where the line that drives a crossing passes the other's plane at a small angle, the place is
    off along that plane by far more than the lines are off one another.
    """
    found = False
    for curve, order in enumerate(orders):
        if work.net.sources[curve].dense and len(order) > _SMALLEST:
            item = _folding(work, curve, order)
            if item is not None:
                work.chosen[curve].discard(item.number)
                work.barred.add((curve, item.number))
                found = True
    return found


_SMALLEST = 4
"""A curve through so few points folds whichever is left out."""


def _folding(work: ThinningState, curve: int, order: list[CurveItem]) -> CurveItem | None:
    """Give the crossing without which the chords of a curve fold no more; None if none does."""
    numbers = work.numbers(order)
    xyz = work.given.xyz[numbers]
    kind = work.given.on(np.full(len(order), curve), numbers)[0]
    folds = np.flatnonzero((chord_cosines(xyz) < 0.0) & (kind[1:-1] == PointKind.SMOOTH)) + 1
    for place in folds.tolist():
        near = range(max(place - 1, 1), min(place + 2, len(order) - 1))
        free = [i for i in near if _is_free(work, curve, order[i])]
        part = slice(max(place - 3, 0), place + 4)
        left = {
            i: float(chord_cosines(np.delete(xyz, i, axis=0)[part]).min(initial=1.0)) for i in free
        }
        best = max(left, key=lambda i: left[i], default=-1)
        if best >= 0 and left[best] > 0.0:
            return order[best]
    return None


def _is_free(work: ThinningState, curve: int, item: CurveItem) -> bool:
    """Tell whether an item is a crossing that defines a curve by the rule alone."""
    meeting = len(work.net.contacts) <= item.number < work.fixed_count
    return meeting and not item.fixed and item.number in work.chosen[curve]


_BADLY, _TIGHT = 1.0, 0.25
"""A curve that would pass its line by more than this part of what it may keeps points beside a
crossing, but for those nearer than this part of the least spacing."""


def _spread(work: ThinningState, curve: int, order: list[CurveItem]) -> list[CurveItem]:
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

    def crowded(item: CurveItem, least: float) -> bool:
        if item.number < last:
            return False
        point = work.points[item.number - last]
        free = point.kind == PointKind.SMOOTH and not point.placed
        return (
            free
            and item not in (order[0], order[-1])
            and float(np.abs(held - item.at).min()) < least
        )

    for least in (spacing, _TIGHT * spacing):
        found = [item for item in order if not crowded(item, least)]
        if len(found) == len(order):
            return order
        # A tip or a narrow strip may need points that stand closer than is usual.
        if _part(work, curve, found, loft_orders(work, [curve], [found]), 0) <= _BADLY:
            break
    return found


def _outcome(
    work: ThinningState, roles: list[Role], orders: list[list[CurveItem]], left: list[OmittedPoint]
) -> ThinnedNet:
    """Put the outcome together, with numbers for the points that are used only."""
    contacts, first = len(work.net.contacts), work.fixed_count
    used = sorted({item.number for order in orders for item in order if item.number >= first})
    number = {old: first + new for new, old in enumerate(used)}
    return ThinnedNet(
        tuple(roles[:contacts]),
        tuple(roles[contacts:]),
        tuple(work.points[index - first] for index in used),
        tuple(tuple(number.get(item.number, item.number) for item in order) for order in orders),
        tuple(left),
    )


def _collect(work: ThinningState) -> None:
    """Put contacts, intersections and points that stand by themselves on their curves."""
    net = work.net
    held: set[tuple[int, int]] = set()
    for index, contact in enumerate(net.contacts):
        knot = float(net.reference.knot[net.reference.start[contact.curve] + contact.point])
        work.items[contact.curve].append(CurveItem(knot, index, True, 90.0))
        angle = _angle_on_boundary(net, contact)
        work.items[contact.boundary].append(CurveItem(contact.at, index, False, angle))
        held.add((contact.curve, contact.point))
    for index, meeting in enumerate(net.meetings, len(net.contacts)):
        for curve, at, angle in zip(
            (meeting.a, meeting.b), meeting.at, meeting.angle_deg, strict=True
        ):
            work.items[curve].append(CurveItem(at, index, False, angle))
    for curve, source in enumerate(net.sources):
        last = len(source.points) - 1
        for point in range(last + 1):
            alone = source.placed or point in (0, last) or source.kind[point] != PointKind.SMOOTH
            if alone and (curve, point) not in held:
                add_point(work, curve, point)
    for curve in range(len(net.sources)):
        work.items[curve].sort()


def _angle_on_boundary(net: ReferenceNet, contact: Contact) -> float:
    line = net.state.line_of(contact.curve)
    slope = derivative(net.reference, np.array([contact.boundary]), np.array([contact.at]))[0]
    cosine = abs(float(slope @ net.state.lines.normal[line])) / float(np.linalg.norm(slope))
    return float(np.degrees(np.arcsin(min(1.0, cosine))))


def _rule(work: ThinningState, curve: int) -> set[int]:
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


def _roles(work: ThinningState, generates: list[tuple[bool, bool]]) -> list[Role]:
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


def _generates(state: HullState, meeting: LineIntersection) -> tuple[bool, bool]:
    """Tell whether the group of a generates on that of b, and back."""
    return _between(state, meeting.a, meeting.b)


def _between(state: HullState, a: int, b: int) -> tuple[bool, bool]:
    """Tell whether the group of one curve generates on that of another, and back."""
    names = [state.groups.name[int(state.lines.group[state.line_of(curve)])] for curve in (a, b)]
    found = [False, False]
    for link in state.associations:
        if [link.a, link.b] == names:
            found = [True, link.two_way]
        elif [link.b, link.a] == names:
            found = [link.two_way, True]
    return found[0], found[1]


def _orders(work: ThinningState, roles: list[Role]) -> list[list[CurveItem]]:
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


def _apart(work: ThinningState, order: list[CurveItem]) -> list[CurveItem]:
    """Leave out adopted points at which a crossing has come to define the curve."""
    numbers = work.numbers(order)
    crossing = numbers < work.fixed_count
    if crossing.all() or not crossing.any():
        return order
    xyz = work.given.xyz[numbers]
    apart = np.abs(xyz[:, None] - xyz[crossing][None]).max(axis=2).min(axis=1) >= work.same_place
    return [item for item, kept in zip(order, (crossing | apart).tolist(), strict=True) if kept]


def _take_in(work: ThinningState, curve: int, point: int, order: list[CurveItem]) -> None:
    """Take the thinned crossing at a given point back in, or adopt the point.

    Of a dense line a point or crossing amid the interval will do.
    """
    crossing = thinned_at(work, curve, point)
    if crossing is None and work.net.sources[curve].dense:
        edges = np.array([item.at for item in order])
        point, target, reach = point_amid_interval(edges, knots_of(work, curve), point)
        for item in sorted(work.items[curve], key=lambda each: abs(each.at - target)):
            thinned = is_thinned(work, curve, item)
            if thinned and abs(item.at - target) < reach:
                crossing = item.number
                break
    if crossing is None:
        add_point(work, curve, point)
    else:
        work.chosen[curve].add(crossing)

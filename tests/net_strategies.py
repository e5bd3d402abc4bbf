"""Small nets kept ready, and random edits of every kind, for the properties of the update.

A net takes half a second to adopt, so each is adopted once per process; every example gets a twin
of what was read.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from functools import lru_cache
from typing import TypeVar

import attrs
import numpy as np
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

import assoc_hull as ah
from assoc_hull.edit.script import GapsName, PolicyName
from assoc_hull.edit.session import Edit
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.io.hull_json import dumps_hull_json, read_hull_json
from assoc_hull.model.kinds import OWN, BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.objects import Curve, Line, Point
from tests.strategies import Form, Net, net_of, wigley_sources
from tests.twins import packed, twin

__all__ = [
    "POOL",
    "SHAPES",
    "STRUCTURE",
    "Act",
    "Task",
    "carry_out",
    "fresh",
    "hulls",
    "knuckled",
    "live_points",
    "loose",
    "perform",
    "refused",
    "tasks",
]

_SEEDS = (0, 1, 4, 14, 13, 16, 3, 7, 29, 35, 8, 12)
"""Which nets: Wigley, one with a knuckle line, and random ones that are sound to begin with."""

POOL = len(_SEEDS)
"""Number of nets kept ready."""

SHAPES = (
    "move", "move", "move_by", "pull", "reshape", "insert", "lead", "delete", "set_end",
    "set_kind",
)  # fmt: skip
STRUCTURE = (
    "add_line", "remove_line", "shift_line", "set_role", "set_role", "renew_roles", "pin", "unpin",
    "associate", "rejoin", "rule", "rule", "group", "regroup", "ungroup", "straighten", "round",
    "spread", "knuckle_line",
)  # fmt: skip
Item = TypeVar("Item")
_ROLES = ("shared", "drives a", "drives b", "watched")


@attrs.frozen
class Act:
    """One modification: what kind, of which object (modulo their number), and how much."""

    op: str
    which: int
    other: int
    amount: float


@attrs.frozen
class Task:
    """One edit of one to three modifications."""

    acts: tuple[Act, ...]
    gaps: GapsName = "refuse"
    policy: PolicyName = "all_or_nothing"


def tasks(
    operations: tuple[str, ...] = SHAPES, largest: float = 0.02, most: int = 4, acts: int = 3
) -> SearchStrategy[list[Task]]:
    """Give sequences of edits of at most `largest` metres each."""
    number = st.integers(0, 2**16)
    act = st.builds(Act, st.sampled_from(operations), number, number, st.floats(-largest, largest))
    each = st.lists(act, min_size=1, max_size=acts).map(tuple)
    gaps: SearchStrategy[GapsName] = st.sampled_from(("refuse", "report"))
    return st.lists(st.builds(Task, each, gaps), min_size=1, max_size=most)


def knuckled(stations: int, waterlines: int, two_way: bool = True) -> Net:
    """Give a net whose sections turn at a knuckle line, a boundary curve in space."""
    form = Form(breadth=16.0, up=2.5, twist=0.2)
    net = net_of(form, stations, waterlines, two_way=(two_way, True, True))
    along = np.linspace(0.0, form.length, stations + 2)
    height = 0.62 * form.draught + 0.004 * along
    chine = np.column_stack([along, 1.06 * form.half_breadth(along, height), height])
    chine[[0, -1], 1] = 0.0
    sources = [_with_knuckle(source, chine) for source in net.sources]
    line = LineSource.make("boundary", "chine", chine, boundary=BoundaryKind.KNUCKLE)
    return attrs.evolve(net, sources=(*sources, line))


def _with_knuckle(source: LineSource, chine: FloatArray) -> LineSource:
    """Let a section pass the knuckle line in a knuckle."""
    if source.group != "sections":
        return source
    at = chine[np.isclose(chine[:, 0], source.offset)][0]
    index = int(np.searchsorted(source.points[:, 2], at[2]))
    points = np.insert(source.points, index, at, axis=0)
    kind = np.zeros(len(points), np.int64)
    kind[index] = PointKind.KNUCKLE
    return LineSource.make("sections", source.name, points, kind=kind.tolist())


def _net(number: int) -> Net:
    """Give the net of a seed."""
    if number == 0:
        return loose(wigley_sources(5, 4), 0.02)
    if number == 1:
        return knuckled(5, 4)
    rng = random.Random(number)
    form = Form(
        rng.uniform(60.0, 200.0), rng.uniform(8.0, 30.0), rng.uniform(4.0, 15.0),
        rng.uniform(2.0, 3.5), rng.uniform(1.6, 2.8), rng.uniform(-0.3, 0.3),
        rng.uniform(-0.08, 0.08),
    )  # fmt: skip
    points = None if rng.random() < 0.5 else (rng.randint(9, 13), rng.randint(21, 29))
    two_way = (number % 4 != 3, rng.random() < 0.7, rng.random() < 0.7)
    buttocks = rng.randint(2, 3) if number % 3 else 0
    net = net_of(form, rng.randint(5, 7), rng.randint(3, 5), buttocks, points, two_way)
    return loose(net, 0.03)


def loose(net: Net, tolerance: float) -> Net:
    """Let the lines pass their points farther off, so that crossings rule and points are few."""
    return attrs.evolve(
        net, sources=tuple(attrs.evolve(each, tolerance=tolerance) for each in net.sources)
    )


@lru_cache
def _pack(number: int) -> bytes:
    text = dumps_hull_json(_net(_SEEDS[number]).adopt())
    return packed(ah.Hull(read_hull_json(text)))


def fresh(number: int) -> ah.Hull:
    """Give a hull of its own with the net of a number."""
    found: ah.Hull = twin(_pack(number))
    return found


def hulls() -> SearchStrategy[ah.Hull]:
    """Give small hulls: two or three families, one-way and two-way, with boundary curves."""
    return st.integers(0, POOL - 1).map(fresh)


def carry_out(hull: ah.Hull, task: Task) -> EditReport | None:
    """Carry an edit out; None if nothing has changed: it was refused, or asked for what was so."""
    before, done = hull.fingerprint, len(hull.history)
    try:
        with hull.edit("task", task.policy, task.gaps) as edit:
            for act in task.acts:
                perform(hull, edit, act)
    except AssocHullError:
        assert hull.fingerprint == before
        assert len(hull.history) == done
        return None
    assert edit.report is not None
    if not edit.report.changed:
        assert (hull.fingerprint, len(hull.history)) == (before, done)
        assert edit.report.relofted == ()
        return None
    return edit.report


def perform(hull: ah.Hull, edit: Edit, act: Act) -> None:
    """Ask an edit for one modification."""
    _OPERATIONS[act.op](hull, edit, act)


def live_points(hull: ah.Hull, *sorts: str) -> list[Point]:
    """Give the points of some sorts by key; of crossings those on the line of higher rank."""
    rows = hull.state.rows
    order = sorted(hull.state.live("rows").tolist(), key=rows.key.data.__getitem__)
    points = [Point(hull.state, row, rows.key[row], int(rows.curve[row, 1] >= 0)) for row in order]
    return [point for point in points if point.sort in sorts]


def _curves(hull: ah.Hull, boundaries: bool = False) -> list[Curve]:
    state = hull.state
    curves = [Curve.of(state, curve) for curve in state.live("curves").tolist()]
    plain = [each for each in curves if each.line.group.family != "boundary" or boundaries]
    return sorted(plain, key=lambda each: each.id)


def _lines(hull: ah.Hull) -> list[Line]:
    lines = [Line.of(hull.state, line) for line in hull.state.live("lines").tolist()]
    return sorted(
        (line for line in lines if line.group.family != "boundary"), key=lambda each: each.id
    )


def _pick(items: list[Item], which: int) -> Item | None:
    return items[which % len(items)] if items else None


def _move(hull: ah.Hull, edit: Edit, act: Act) -> None:
    points = live_points(hull, "crossing", "placed", "adopted")
    point = _pick([each for each in points if each.free and each.driver is None], act.which)
    if point is not None:
        shift = {axis: float(getattr(point, axis)) + act.amount for axis in point.free}
        edit.move(point, lead=False, **shift)


def _move_by(hull: ah.Hull, edit: Edit, act: Act) -> None:
    points = live_points(hull, "crossing", "placed", "adopted")
    free = [each for each in points if each.free and each.driver is None]
    chosen = free[act.which % max(len(free), 1) :][:3]
    by = [[act.amount * (axis in each.free) for axis in "xyz"] for each in chosen]
    if chosen:
        edit.move(chosen, by=by, lead=False)


def _pull(hull: ah.Hull, edit: Edit, act: Act) -> None:
    point = _pick(live_points(hull, "crossing"), act.which)
    assert point is not None
    size = hull.particulars
    edit.pull(point, act.amount, (0.2 * size.length, 0.4 * size.breadth))


def _free_way(curve: Curve) -> FloatArray:
    """Give the direction of the plane of a curve in which it may bulge."""
    axes: FloatArray = np.eye(3)
    return np.asarray(axes[2 if curve.line.group.family == "buttocks" else 1])


def _reshape(hull: ah.Hull, edit: Edit, act: Act) -> None:
    curve = _pick(_curves(hull), act.which)
    assert curve is not None
    place = curve.at((0.3 + 0.4 * (act.other % 100) / 100.0) * curve.span)
    axis = 2 if curve.line.group.family == "sections" else 0
    reach = 0.3 * abs(float(curve.ends[1, axis] - curve.ends[0, axis]))
    span = (float(place[axis]) - reach, float(place[axis]) + reach)
    edit.reshape(curve, [place + act.amount * _free_way(curve)], span=span)


def _run(hull: ah.Hull, act: Act) -> tuple[Curve, Point, Point]:
    """Give a line and two of its points with one to three others between them."""
    curve = _pick([each for each in _curves(hull) if len(each.defining) > 2], act.which)
    assert curve is not None
    points = list(curve.defining)
    first = act.other % (len(points) - 2)
    return curve, points[first], points[min(first + 2 + act.other % 3, len(points) - 1)]


def _straighten(hull: ah.Hull, edit: Edit, act: Act) -> None:
    edit.straighten(*_run(hull, act))


def _round(hull: ah.Hull, edit: Edit, act: Act) -> None:
    edit.round(*_run(hull, act), radius=100.0 * abs(act.amount) + 0.1)


def _spread(hull: ah.Hull, edit: Edit, act: Act) -> None:
    point = _pick(live_points(hull, "crossing"), act.which)
    assert point is not None
    edit.spread(point, length=(0.05 + 0.4 * (act.other % 100) / 100.0) * hull.particulars.length)


def _knuckle_line(hull: ah.Hull, edit: Edit, act: Act) -> None:
    chine = [each for each in hull.lines.values() if each.name == "chine"]
    if chine and act.other % 2:
        edit.remove_knuckle_line(chine[0])
        return
    offset = hull.state.lines.offset
    lines = sorted(hull.groups["sections"].lines.values(), key=lambda each: offset[each.number])
    first = act.which % max(len(lines) - 2, 1)
    points = [list(each.curves[0].defining)[1:-1] for each in lines[first : first + 3]]
    edit.knuckle_line("chine", [each[act.other % len(each)] for each in points if each])


def _insert(hull: ah.Hull, edit: Edit, act: Act) -> None:
    curve = _pick(_curves(hull), act.which)
    assert curve is not None
    place = curve.at((0.1 + 0.8 * (act.other % 100) / 100.0) * curve.span)
    edit.insert(curve, place + act.amount * _free_way(curve), lead=False)


def _lead(hull: ah.Hull, edit: Edit, act: Act) -> None:
    """Lead a line through a place, a point of it, or by what leads unless it is said otherwise."""
    if act.other % 4 == 0:
        point = _pick(live_points(hull, "crossing", "placed", "adopted"), act.which)
        assert point is not None
        shift = [act.amount * (axis in point.free) for axis in "xyz"]
        edit.lead(point.container_curve, [(point, point.position + shift)])
        return
    if act.other % 4 == 1:
        own = _pick(
            [each for each in live_points(hull, "placed", "adopted") if each.free], act.which
        )
        if own is not None:
            to = {own.free[0]: float(getattr(own, own.free[0])) + act.amount}
            edit.move(own, lead=True, **to)
        return
    curve = _pick(_curves(hull), act.which)
    assert curve is not None
    place = curve.at((0.1 + 0.8 * (act.other % 100) / 100.0) * curve.span)
    place = place + act.amount * _free_way(curve)
    if act.other % 4 == 2:
        edit.insert(curve, place)
    else:
        edit.lead(curve, [place])


def _delete(hull: ah.Hull, edit: Edit, act: Act) -> None:
    point = _pick(live_points(hull, "placed", "adopted"), act.which)
    if point is not None:
        edit.delete(point)


def _set_end(hull: ah.Hull, edit: Edit, act: Act) -> None:
    curve = _pick(_curves(hull), act.which)
    assert curve is not None
    at = 0.0 if act.other % 2 else curve.span
    tilt = curve.tangent(at) + 2.0 * act.amount * _free_way(curve)
    edit.set_end(
        curve, "start" if act.other % 2 else "finish", tangent=tilt if act.other % 3 else None
    )


def _set_kind(hull: ah.Hull, edit: Edit, act: Act) -> None:
    points = live_points(hull, "crossing", "placed", "adopted")
    point = _pick([each for each in points if each.role == "defining"], act.which)
    if point is not None:
        edit.set_kind(point, ("smooth", "tangent", "knuckle")[act.other % 3])


def _add_line(hull: ah.Hull, edit: Edit, act: Act) -> None:
    names = [name for name in _families(hull) if name != "boundary"]
    group, size = names[act.which % len(names)], hull.particulars
    part = 0.05 + 0.9 * (act.other % 997) / 997.0
    reach = {"sections": size.length, "waterlines": size.draught, "buttocks": 0.5 * size.breadth}
    edit.add_line(group, part * reach[group])


def _remove_line(hull: ah.Hull, edit: Edit, act: Act) -> None:
    line = _pick(_lines(hull), act.which)
    if line is not None:
        edit.remove_line(line)


def _set_role(hull: ah.Hull, edit: Edit, act: Act) -> None:
    point = _pick(live_points(hull, "crossing"), act.which)
    assert point is not None
    edit.set_role(point, (*_ROLES, None)[act.other % 5])


def _pin(hull: ah.Hull, edit: Edit, act: Act) -> None:
    point = _pick(live_points(hull, "adopted"), act.which)
    if point is not None:
        edit.pin(point)


def _unpin(hull: ah.Hull, edit: Edit, act: Act) -> None:
    point = _pick(live_points(hull, "placed"), act.which)
    if point is not None:
        edit.unpin(point)


def _shift_line(hull: ah.Hull, edit: Edit, act: Act) -> None:
    line = _pick(_lines(hull), act.which)
    if line is not None:
        edit.shift_line(line, float(hull.state.lines.offset[line.number]) + 5.0 * act.amount)


def _renew_roles(hull: ah.Hull, edit: Edit, act: Act) -> None:
    line = _pick(_lines(hull), act.which)
    if line is not None:
        edit.renew_roles([line])


def _pair(hull: ah.Hull, which: int) -> tuple[str, str]:
    """Give two groups of families, associated or not any more."""
    names = sorted(name for name in _families(hull) if name != "boundary")
    pair = _pick([(a, b) for a in names for b in names if a < b], which)
    assert pair is not None
    return pair


def _families(hull: ah.Hull) -> list[str]:
    return [name for name, group in hull.groups.items() if group.family != OWN]


def _own(hull: ah.Hull) -> list[str]:
    return sorted(name for name, group in hull.groups.items() if group.family == OWN)


def _associate(hull: ah.Hull, edit: Edit, act: Act) -> None:
    a, b = _pair(hull, act.which)
    way = act.other % 4
    if way == 0:
        edit.dissociate(a, b)
    elif way == 3:
        edit.associate(b, a, two_way=False)
    else:
        edit.associate(a, b, two_way=way == 1)


def _rejoin(hull: ah.Hull, edit: Edit, act: Act) -> None:
    a, b = _pair(hull, act.which)
    edit.dissociate(a, b)
    edit.associate(*((a, b) if act.other % 2 else (b, a)), two_way=act.other % 3 == 0)


def _rule(hull: ah.Hull, edit: Edit, act: Act) -> None:
    """Say who rules where: by a cut along an axis, everywhere, or nothing any more."""
    pair = list(_pair(hull, act.which))
    own = _pick(_own(hull), act.other)
    if own is not None and act.other % 3 == 0:
        pair[act.other % 2] = own
    if act.other % 5 == 0:
        line = _pick(list(hull.groups[pair[0]].lines), act.other)
        pair[0] = pair[0] if line is None else line
    size = hull.particulars
    axis, long = (("x", size.length), ("y", 0.5 * size.breadth), ("z", size.draught))[act.which % 3]
    cut = (0.1 + 0.8 * (act.other % 89) / 89.0) * long
    first, second = ((None, pair[0]), (pair[0], pair[1]), (pair[1], None))[act.other % 3]
    boxes: tuple[list[tuple[str | None, dict[str, tuple[float | None, float | None]]]], ...] = (
        [],
        [(pair[act.which % 2], {})],
        [(first, {axis: (None, cut)}), (second, {axis: (cut, None)})],
        [(first, {axis: (None, cut)})],
    )
    edit.rule(pair[0], pair[1], boxes[act.other % 7 % 4])


def _members(hull: ah.Hull, act: Act) -> list[str]:
    """Name two lines of any families, and a group of one's own where there is one."""
    lines = [line.name for line in _lines(hull)]
    own = _pick(_own(hull), act.which)
    chosen = {lines[act.which % len(lines)], lines[act.other % len(lines)]}
    return sorted(chosen | ({own} if own is not None and act.other % 2 else set[str]()))


def _group(hull: ah.Hull, edit: Edit, act: Act) -> None:
    edit.group(f"set {act.which % 5}", _members(hull, act))


def _regroup(hull: ah.Hull, edit: Edit, act: Act) -> None:
    name = _pick(_own(hull), act.other)
    if name is not None:
        edit.regroup(name, _members(hull, act))


def _ungroup(hull: ah.Hull, edit: Edit, act: Act) -> None:
    name = _pick(_own(hull), act.which)
    if name is not None:
        edit.ungroup(name)


_OPERATIONS = {
    "move": _move,
    "move_by": _move_by,
    "pull": _pull,
    "reshape": _reshape,
    "insert": _insert,
    "lead": _lead,
    "delete": _delete,
    "set_end": _set_end,
    "set_kind": _set_kind,
    "add_line": _add_line,
    "remove_line": _remove_line,
    "set_role": _set_role,
    "pin": _pin,
    "unpin": _unpin,
    "shift_line": _shift_line,
    "renew_roles": _renew_roles,
    "straighten": _straighten,
    "round": _round,
    "spread": _spread,
    "knuckle_line": _knuckle_line,
    "associate": _associate,
    "rejoin": _rejoin,
    "rule": _rule,
    "group": _group,
    "regroup": _regroup,
    "ungroup": _ungroup,
}


def refused(
    hull: ah.Hull,
    act: Callable[[Edit], object],
    error: type[AssocHullError],
    gaps: GapsName = "refuse",
) -> str:
    """Carry out an edit that must fail; gives the message. The hull must be as it was."""
    before, names = hull.fingerprint, [report.name for report in hull.history]
    revisions = dict(hull.state.revision_row), dict(hull.state.revision_curve)
    counts = [table.count for table in (hull.state.rows, hull.state.curves, hull.state.lines)]
    try:
        with hull.edit("bad", gaps=gaps) as edit:
            act(edit)
    except error as caught:
        assert hull.fingerprint == before
        assert [report.name for report in hull.history] == names
        assert (hull.state.revision_row, hull.state.revision_curve) == revisions
        assert counts == [
            table.count for table in (hull.state.rows, hull.state.curves, hull.state.lines)
        ]
        return str(caught)
    raise AssertionError(f"no {error.__name__} was raised")

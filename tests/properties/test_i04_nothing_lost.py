"""I4: nothing the designer placed is lost by an edit of something else."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from unittest import mock

import attrs
import numpy as np
from hypothesis import given, settings

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.model.kinds import Role, Sort
from tests.long_forms import draws
from tests.net_strategies import (
    SHAPES,
    STRUCTURE,
    Task,
    carry_out,
    fresh,
    hulls,
    live_points,
    tasks,
)


@attrs.frozen
class Placed:
    """What the designer decided, by what it was decided of."""

    points: dict[str, bytes]
    kinds: dict[tuple[str, str], tuple[int, bytes]]
    ends: dict[tuple[str, str], str]
    names: dict[str, str]
    overrides: dict[str, int]


def decided(hull: ah.Hull) -> Placed:
    """Read it from the tables."""
    state, rows = hull.state, hull.state.rows
    live = state.live("rows").tolist()
    curve = state.curves.key.data
    return Placed(
        {rows.key[i]: rows.xyz[i].tobytes() for i in live if rows.sort[i] == Sort.PLACED},
        {
            (rows.key[i], curve[int(rows.curve[i, side])]): (
                int(rows.kind[i, side]),
                rows.direction[i, side].tobytes(),
            )
            for i in live
            for side in (0, 1)
            if rows.kind[i, side] and rows.curve[i, side] >= 0
        },
        {
            (curve[i], end): repr((ends.kind[at], ends.vector[at]))
            for i in state.live("curves").tolist()
            for ends in [state.curves.ends[i]]
            for at, end in enumerate(("start", "finish"))
        },
        {state.lines.key[i]: state.lines.name[i] for i in state.live("lines").tolist()},
        {rows.key[i]: int(rows.override[i]) for i in live if rows.override[i] >= 0},
    )


@contextmanager
def naming() -> Iterator[Named]:
    """Listen to what edits name, for instance a point that is moved, or one end of a curve."""
    heard = Named()
    with ExitStack() as stack:
        for method, note in _NOTES.items():
            stack.enter_context(_listen(method, note, heard))
        yield heard


@attrs.define
class Named:
    """What an edit named: of all that was decided only this may be otherwise after it."""

    points: set[object] = attrs.field(factory=set)
    kinds: set[object] = attrs.field(factory=set)
    ends: set[object] = attrs.field(factory=set)
    names: set[object] = attrs.field(factory=set)
    overrides: set[object] = attrs.field(factory=set)


def _listen(method: str, note: Note, heard: Named) -> AbstractContextManager[object]:
    original = getattr(Edit, method)

    def call(self: Edit, thing: ah.Point | ah.Curve, *given: object, **named: object) -> object:
        note(heard, thing, *given)
        return original(self, thing, *given, **named)

    return mock.patch.object(Edit, method, call)


def _kind(heard: Named, point: ah.Point, *_: object) -> None:
    heard.kinds.add((point.id, point.container_curve.id))


def _delete(heard: Named, point: ah.Point) -> None:
    heard.points.add(point.id)
    _kind(heard, point)


def _move(heard: Named, points: ah.Point | list[ah.Point]) -> None:
    every = points if isinstance(points, list) else [points]
    heard.points |= {point.id for point in every}


def _lead(heard: Named, _: object, points: list[object]) -> None:
    _move(heard, [each[0] for each in points if isinstance(each, tuple)])


def _run(heard: Named, curve: ah.Curve, *_: object) -> None:
    """A run makes tangent points, may take knuckles away, and gives an end its direction."""
    heard.kinds |= {(point.id, curve.id) for point in curve.defining}
    heard.ends |= {(curve.id, end) for end in ("start", "finish")}


def _knuckles(heard: Named, _: object, points: list[ah.Point]) -> None:
    """Points become knuckles, and crossings of theirs are driven meanwhile."""
    for point in points:
        heard.points.add(point.id)
        heard.overrides.add(point.id)
        for side in (point, point.friend_point):
            if side is not None:
                heard.kinds.add((point.id, side.container_curve.id))


def _smooth(heard: Named, line: ah.Line) -> None:
    for contact in line.curves[0].defining:
        section = contact.friend_point
        for point in [] if section is None else section.container_curve.points:
            _knuckles(heard, None, [point])


Note = Callable[..., None]
_NOTES: dict[str, Note] = {
    "move": _move,
    "lead": _lead,
    "straighten": _run,
    "round": _run,
    "knuckle_line": _knuckles,
    "remove_knuckle_line": _smooth,
    "delete": _delete,
    "unpin": lambda heard, point: heard.points.add(point.id),
    "set_kind": _kind,
    "set_role": lambda heard, point, *_: heard.overrides.add(point.id),
    "set_end": lambda heard, curve, end: heard.ends.add((curve.id, end)),
}


def decide(hull: ah.Hull) -> None:
    """Place points, set kinds, ends, a name and a role, as a designer may."""
    lines = list(hull.groups["waterlines"].lines.values())
    with hull.edit("decide") as edit:
        for line in lines[:2]:
            curve = line.curves[0]
            edit.insert(curve, curve.at(0.37 * curve.span))
        section = next(iter(hull.groups["sections"].lines.values())).curves[0]
        edit.set_end(section, "finish", tangent=section.tangent(section.span))
        edit.rename(lines[0], "the one")
        shared = [p for p in live_points(hull, "crossing") if p.crossing_role == "shared"]
        inner = [p for p in shared if p.container_curve.defining[1:-1].count(p)] or shared
        edit.set_kind(inner[len(inner) // 3], "tangent")
        edit.set_role(inner[-1], "shared")


@settings(max_examples=draws(40))
@given(hulls(), tasks((*SHAPES, *STRUCTURE)))
def test_what_was_decided_stays(hull: ah.Hull, edits: list[Task]) -> None:
    """Placed points to the last bit, kinds with directions, each end, names, roles.

    Only the very point, end, kind or role that an edit names may be otherwise after it; what
    stands on a line or a crossing that has gone goes with it. The placed points of a line that
    is shifted are carried along.
    """
    decide(hull)
    for task in edits:
        before = decided(hull)
        with naming() as named:
            done = carry_out(hull, task) is not None
        if not done:
            assert decided(hull) == before
        elif all(act.op != "shift_line" for act in task.acts):
            assert_kept(before, hull, named)


def assert_kept(before: Placed, hull: ah.Hull, named: Named) -> None:
    """What was decided and not named is what it was; nothing was decided by itself."""
    after, gone = decided(hull), _gone(hull)
    for name in ("points", "kinds", "ends", "names", "overrides"):
        old, new, free = getattr(before, name), getattr(after, name), getattr(named, name)
        for key, value in old.items():
            if key not in free and not {key, *(key if isinstance(key, tuple) else ())} & gone:
                assert new.get(key) == value, f"{name} of {key}"
    assert set(after.overrides) <= set(before.overrides) | named.overrides


def _gone(hull: ah.Hull) -> set[object]:
    """Keys of lines, curves and crossings that are no more, and of points on such curves."""
    state, rows = hull.state, hull.state.rows
    gone: set[object] = set()
    for table in (state.lines, state.curves):
        alive = table.alive.data.tolist()
        gone |= {key for key, lives in zip(table.key.data, alive, strict=True) if not lives}
    for row in np.flatnonzero(~rows.alive.data).tolist():
        curve_lives = state.curves.alive[int(rows.curve[row, 0])]
        if rows.sort[row] == Sort.CROSSING or not curve_lives:
            gone.add(rows.key[row])
    return gone


GIVES_ROLES = {
    "set_role", "renew_roles", "associate", "dissociate", "shift_line", "straighten", "round",
    "knuckle_line", "rule", "rejoin", "regroup", "ungroup",
}  # fmt: skip


@settings(max_examples=draws(20))
@given(hulls(), tasks((*SHAPES, *STRUCTURE)))
def test_a_role_changes_only_by_its_own_edit(hull: ah.Hull, edits: list[Task]) -> None:
    """An edit of shape never changes a role."""
    for task in edits:
        before = _roles(hull)
        if carry_out(hull, task) is None or any(act.op in GIVES_ROLES for act in task.acts):
            continue
        after = _roles(hull)
        assert {key: after[key] for key in before if key in after} == {
            key: role for key, role in before.items() if key in after
        }


def _roles(hull: ah.Hull) -> dict[str, Role]:
    rows = hull.state.rows
    live = hull.state.live("rows").tolist()
    return {rows.key[i]: Role(int(rows.role[i])) for i in live if rows.sort[i] == Sort.CROSSING}


def test_placed_points_stay_to_the_last_bit_where_the_hull_is_pulled() -> None:
    """A dent is allowed; the point does not move."""
    hull = fresh(0)
    lines = hull.groups["waterlines"].lines
    curve = lines["WL 2.083" if "WL 2.083" in lines else next(iter(lines))].curves[0]
    with hull.edit("insert") as edit:
        placed = edit.insert(curve, curve.at(0.4 * curve.span))
    before = placed.position.tobytes()
    near = min(
        (p for p in live_points(hull, "crossing") if p.crossing_role == "shared"),
        key=lambda p: abs(p.x - placed.x) + abs(p.z - placed.z) + (p.y == 0.0) * 1e3,
    )
    with hull.edit("pull") as edit:
        edit.pull(near, 0.03, (30.0, 6.0))
    assert placed.position.tobytes() == before
    assert placed.sort == "placed"
    hull.undo()
    assert placed.position.tobytes() == before

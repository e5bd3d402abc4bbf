"""I4: nothing the designer placed is lost by an edit of something else."""

from __future__ import annotations

import attrs
from hypothesis import given, settings

import assoc_hull as ah
from assoc_hull.model.family import Role, Sort
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
    """What the designer decided, by key of the object."""

    points: dict[str, bytes]
    kinds: dict[tuple[str, str], tuple[int, bytes]]
    ends: dict[str, str]
    names: dict[str, str]
    overrides: dict[str, int]


def decided(hull: ah.Hull) -> Placed:
    """Read it from the tables."""
    state, rows = hull.state, hull.state.rows
    live = state.live("rows").tolist()
    curve = state.curves.key.data
    return Placed(
        {
            rows.key.data[i]: rows.xyz.data[i].tobytes()
            for i in live
            if rows.sort.data[i] == Sort.PLACED
        },
        {
            (rows.key.data[i], curve[int(rows.curve.data[i, side])]): (
                int(rows.kind.data[i, side]),
                rows.direction.data[i, side].tobytes(),
            )
            for i in live
            for side in (0, 1)
            if rows.kind.data[i, side] and rows.curve.data[i, side] >= 0
        },
        {curve[i]: repr(state.curves.ends.data[i]) for i in state.live("curves").tolist()},
        {state.lines.key.data[i]: state.lines.name.data[i] for i in state.live("lines").tolist()},
        {rows.key.data[i]: int(rows.override.data[i]) for i in live if rows.override.data[i] >= 0},
    )


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


@settings(max_examples=25)
@given(hulls(), tasks(("move", "pull", "reshape", "add_line", "remove_line", "set_end")))
def test_what_was_decided_stays(hull: ah.Hull, edits: list[Task]) -> None:
    """Points keep their bits; kinds, directions, ends, names and roles stay as they were set.

    What an edit names itself, or what goes with a line that is removed, is left out.
    """
    decide(hull)
    for task in edits:
        before = decided(hull)
        if carry_out(hull, task) is None:
            assert decided(hull) == before
            continue
        after, gone, mine = decided(hull), _gone(hull), _own(hull)
        for name in ("points", "kinds", "names", "overrides"):
            old, new = getattr(before, name), getattr(after, name)
            for key, value in old.items():
                if not {key, *(key if isinstance(key, tuple) else ())} & (gone | mine):
                    assert new.get(key) == value, f"{name} of {key}"
        if all(act.op != "set_end" for act in task.acts):
            assert {
                key: value for key, value in before.ends.items() if key not in gone
            }.items() <= (after.ends.items())


def _gone(hull: ah.Hull) -> set[str]:
    """Keys of lines, curves and points that were removed."""
    state = hull.state
    tables = (state.lines, state.curves, state.rows)
    dead = {
        key
        for table in tables
        for key, alive in zip(table.key.data, table.alive.data.tolist(), strict=True)
        if not alive
    }
    return dead - {row for row in dead if _placed(hull, row) and not _with_its_curve(hull, row)}


def _placed(hull: ah.Hull, key: str) -> bool:
    rows = hull.state.rows
    return key in rows.key.data and rows.sort.data[rows.key.data.index(key)] == Sort.PLACED


def _with_its_curve(hull: ah.Hull, key: str) -> bool:
    """Whether the curve of a placed point has gone too: only then may the point be gone."""
    rows = hull.state.rows
    curve = int(rows.curve.data[rows.key.data.index(key), 0])
    return not bool(hull.state.curves.alive.data[curve])


def _own(hull: ah.Hull) -> set[str]:
    """Points that the last edit set itself."""
    step = hull.document.history[-1]
    return {hull.state.rows.key.data[node >> 1] for node in step.seeds.tolist()}


GIVES_ROLES = {"set_role", "renew_roles", "associate", "dissociate", "shift_line"}


@settings(max_examples=20)
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
    return {
        rows.key.data[i]: Role(int(rows.role.data[i]))
        for i in live
        if rows.sort.data[i] == Sort.CROSSING
    }


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

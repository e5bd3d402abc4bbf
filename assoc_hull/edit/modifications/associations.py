"""Declaring and taking back associations between groups."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.arguments import flag, word
from assoc_hull.edit.lines.plane_intersections import intersect_groups, remove_planes
from assoc_hull.edit.modifications.switch_crossings import (
    follow_ways,
    leave_stand_ins,
    take_up_stand_ins,
)
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.links import crossing_ways, crossings_between, named_lines
from assoc_hull.model.tables import Association, HullState, Ruling

__all__ = ["associate", "dissociate", "rule", "ruled_crossings"]


def associate(edit: Transaction, a: str, b: str, *, two_way: bool = True) -> None:
    """Declare that the lines of one group generate points on those of another.

    A one-way association makes every crossing of the pair define `b` only, driven by `a`,
    whatever the family ranks. Making one two-way again leaves the roles as they are: they
    may then be renewed crossing by crossing.

    Raises
    ------
    UnknownNameError
        A group that does not exist.
    BadInputError
        A group with itself, or with the boundary curves: contacts are made with the lines.
    RingError
        When the edit ends, if driven links would run in a ring.
    """
    state = edit.state
    _check_pair(edit, word(a, "group"), word(b, "group"))
    flag(two_way, "two_way", "in associate")
    known = any({link.a, link.b} == {a, b} for link in state.associations)
    before = crossing_ways(state, _crossings(state, a, b)) if known else None
    edit.maker.associate(_declared(state, a, b, two_way=two_way))
    _drop_rulings(edit, a, b)
    edit.pending.structural = True
    if not known:
        take_up_stand_ins(edit, intersect_groups(edit, a, b))
    rows = _crossings(state, a, b)
    follow_ways(edit, rows, np.ones((len(rows), 2), np.bool_) if before is None else before)


def rule(edit: Transaction, a: str, b: str, where: Sequence[Ruling]) -> None:
    """Say which of two groups or lines rules where; the hull keeps every bit of its shape.

    `where` takes the place of what was said of the two before; what none of it holds follows the
    association of the groups.

    Raises
    ------
    BadInputError
        A thing with itself, or no two that are associated and meet.
    RingError
        When the edit ends, if driven links would run in a ring.
    """
    state = edit.state
    lines = [named_lines(state, name) for name in (a, b)]
    both = np.intersect1d(lines[0], lines[1])
    if a != b and len(both):
        what = f"{state.lines.name[int(both[0])]} is of both, {a!r} and {b!r}"
        raise BadInputError(what, "in rule", "name two that share no line")
    rows = crossings_between(state, *lines)
    rows = rows[~state.rows.contact[rows]]
    said = any({each.a, each.b} == {a, b} for each in state.rulings)
    if a == b or not (len(rows) or (said and not where)):
        one, other = (_title(state, each, name) for each, name in zip(lines, (a, b), strict=True))
        what = f"{one!r} with itself" if a == b else f"{one!r} and {other!r} have no crossing"
        raise BadInputError(what, "in rule", "name two groups or lines that are associated")
    before = crossing_ways(state, rows)
    kept = [each for each in state.rulings if {each.a, each.b} != {a, b}]
    edit.journal.set(state.settings.rulings, [0], [(*where, *kept)])
    edit.pending.structural = True
    follow_ways(edit, rows, before)


def _title(state: HullState, lines: IntArray, name: str) -> str:
    """Give the name of a line that was named by its key; a group's own name."""
    line = int(lines[0]) if len(lines) else -1
    return str(state.lines.name[line]) if line >= 0 and state.lines.key[line] == name else name


def ruled_crossings(state: HullState) -> IntArray:
    """Give the crossings (k,) of all pairs of which is said who rules where."""
    found = [
        crossings_between(state, named_lines(state, each.a), named_lines(state, each.b))
        for each in state.rulings
    ]
    return np.unique(np.concatenate([np.zeros(0, np.int64), *found]))


def _drop_rulings(edit: Transaction, a: str, b: str) -> None:
    """Let what is said of two groups now hold for all of their lines."""
    state = edit.state
    lines = [set(named_lines(state, name).tolist()) for name in (a, b)]

    def within(each: Ruling) -> bool:
        mine = [set(named_lines(state, name).tolist()) for name in (each.a, each.b)]
        return (mine[0] <= lines[0] and mine[1] <= lines[1]) or (
            mine[0] <= lines[1] and mine[1] <= lines[0]
        )

    kept = tuple(each for each in state.rulings if not within(each))
    if kept != state.rulings:
        edit.journal.set(state.settings.rulings, [0], [kept])


def _declared(state: HullState, a: str, b: str, *, two_way: bool) -> Association:
    """Give the association; one that runs both ways is told from the lower rank to the higher."""
    names = state.groups.name.data
    if two_way and {a, b} <= set(names):
        a, b = sorted(
            (a, b), key=lambda name: FAMILIES[state.groups.family[names.index(name)]].rank
        )
    return Association(a, b, two_way)


def _check_pair(edit: Transaction, a: str, b: str) -> None:
    """Refuse a group with itself, and to change what lines end on."""
    names = edit.state.groups.name.data
    if a == b:
        raise BadInputError(f"the group {a!r} with itself", "in associate", "name two groups")
    for name in (a, b):
        if name in names and edit.state.groups.family[names.index(name)] == "boundary":
            raise BadInputError(
                f"lines are made to end and turn on the curves of {name!r}",
                "in an association of a hull that has lines",
                "declare it when the hull is made, and leave it",
            )


def _crossings(state: HullState, a: str, b: str) -> IntArray:
    """Give the crossings of two groups, (k,)."""
    return crossings_between(state, named_lines(state, a), named_lines(state, b))


def dissociate(edit: Transaction, a: str, b: str) -> None:
    """Take an association back; its crossings stay behind as adopted points.

    Raises
    ------
    BadInputError
        The two groups are not associated, or one holds the boundary curves.
    """
    state = edit.state
    _check_pair(edit, word(a, "group"), word(b, "group"))
    left = tuple(link for link in state.associations if {link.a, link.b} != {a, b})
    if len(left) == len(state.associations):
        raise BadInputError(
            f"{a!r} and {b!r} are not associated", "in dissociate", "check the names"
        )
    edit.pending.structural = True
    rows = _crossings(state, a, b)
    leave_stand_ins(edit, rows)
    edit.journal.set(state.settings.associations, [0], [left])
    _drop_rulings(edit, a, b)
    for group, other in ((a, b), (b, a)):
        _remove_planes(edit, group, other)


def _remove_planes(edit: Transaction, group: str, other: str) -> None:
    """Take the planes of one group out of the meetings of another's curves."""
    state, names = edit.state, edit.state.groups.name.data
    planes = np.flatnonzero(state.lines.group.data == names.index(other))
    curves = state.live("curves")
    owner = state.lines.group[state.curves.line[curves]]
    remove_planes(edit, planes, curves[owner == names.index(group)])

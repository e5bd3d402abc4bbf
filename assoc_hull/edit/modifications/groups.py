"""Groups of a designer's own: they hold lines of any family, and groups."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from assoc_hull.arguments import plain_name
from assoc_hull.edit.modifications.associations import ruled_crossings
from assoc_hull.edit.modifications.names import taken_names
from assoc_hull.edit.modifications.switch_crossings import follow_ways
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, NameTakenError
from assoc_hull.model.kinds import OWN
from assoc_hull.model.links import crossing_ways, holders, live_group
from assoc_hull.model.tables import HullState

__all__ = ["group", "regroup", "ungroup"]


def group(edit: Transaction, name: str, members: tuple[str, ...]) -> int:
    """Make a group of lines, by key, and groups, by name; give its number.

    Raises
    ------
    NameTakenError
        A group, a line or a point has the name.
    """
    plain = plain_name(name)
    if any(plain_name(each) == plain for each in taken_names(edit.state)):
        raise NameTakenError("group, line or point", name)
    edit.pending.structural = True
    return edit.maker.own_group(name, members)


def regroup(edit: Transaction, name: str, members: tuple[str, ...]) -> None:
    """Let a group hold other lines and groups; where it rules, what it gains or loses is switched.

    Raises
    ------
    BadInputError
        It is the group of a family, or would hold itself.
    """
    state, number = edit.state, _own(edit.state, name, "in regroup")
    for each in members:
        path = _path(state, each, name)
        if path:
            what = f"the group {name!r} would hold itself: {' -> '.join((name, *path))}"
            raise BadInputError(what, "in regroup", "leave one of them out")
    with _rulings_followed(edit):
        edit.journal.set(state.groups.members, [number], [members])
    edit.pending.structural = True


def ungroup(edit: Transaction, name: str) -> None:
    """Take a group away; its lines stay, and it leaves the groups that held it.

    Raises
    ------
    BadInputError
        It is the group of a family, or rules somewhere.
    """
    state, number = edit.state, _own(edit.state, name, "in ungroup")
    for each in state.rulings:
        if name in (each.a, each.b):
            other = each.b if each.a == name else each.a
            what = f"the group {name!r} is named where lines rule"
            raise BadInputError(
                what, "in ungroup", f"take that back before: edit.rule({name!r}, {other!r}, [])"
            )
    with _rulings_followed(edit):
        for holder in holders(state, name).tolist():
            left = tuple(each for each in state.groups.members[holder] if each != name)
            edit.journal.set(state.groups.members, [holder], [left])
    edit.journal.put(state.groups.alive, [number], False)
    edit.journal.set(state.groups.members, [number], [()])
    edit.journal.set(state.groups.name, [number], [""])
    edit.pending.structural = True


@contextmanager
def _rulings_followed(edit: Transaction) -> Iterator[None]:
    """Switch, behind what is done inside, the crossings of lines that left or joined a ruler."""
    state = edit.state
    if not state.rulings:
        yield
        return
    rows = ruled_crossings(state)
    yield
    rows = np.union1d(rows, ruled_crossings(state))
    follow_ways(edit, rows, crossing_ways(state, rows))


def _own(state: HullState, name: str, where: str) -> int:
    """Give the number of a designer's own group."""
    number = live_group(state, name)
    if number is None or state.groups.family[number] != OWN:
        what = f"{name!r} is {'no group' if number is None else 'the group of a family'}"
        raise BadInputError(what, where, "name a group that edit.group made")
    return number


def _path(state: HullState, begin: str, to: str) -> tuple[str, ...]:
    """Give the groups from one that holds another down to that, both named; none if it does not."""
    if begin == to:
        return (to,)
    number = live_group(state, begin)
    for each in () if number is None else state.groups.members[number]:
        if rest := _path(state, each, to):
            return (begin, *rest)
    return ()

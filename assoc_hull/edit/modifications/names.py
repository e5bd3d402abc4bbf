"""Giving lines, points and the hull other names and particulars, and groups of a designer's own.

Groups of a designer's own: they hold lines of any family, and groups.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

import attrs
import numpy as np

from assoc_hull.arguments import choice, plain_name, positive, shown, word
from assoc_hull.edit.arguments import line_name
from assoc_hull.edit.modifications.associations import ruled_crossings
from assoc_hull.edit.modifications.switch_crossings import follow_ways
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, NameTakenError, OutOfRangeError
from assoc_hull.model.address import ResolvedAddress
from assoc_hull.model.attachments import attachment_names
from assoc_hull.model.kinds import OWN
from assoc_hull.model.links import crossing_ways, holders, live_group
from assoc_hull.model.tables import DECKS, HullState

__all__ = [
    "group",
    "regroup",
    "rename",
    "rename_hull",
    "rename_lines",
    "set_particulars",
    "taken_names",
    "ungroup",
]


def rename(edit: Transaction, what: ResolvedAddress, name: object) -> None:
    """Give a line or a point another name.

    Parameters
    ----------
    edit : Transaction
        The edit.
    what : ResolvedAddress
        A line, its only curve, or a point: both friends of a crossing then have the name.
    name : str
        The name; nothing that could be read as an address.

    Raises
    ------
    NameTakenError
        Another line of the group, or another object, has that name.
    BadInputError
        It is no name; a group, or one of several curves of a line.
    """
    state = edit.state
    if what.row >= 0:
        _rename_point(edit, what.row, line_name(name))
    elif what.line < 0:
        own = state.groups.family[what.group] == OWN
        remedy = "associations and the keys of its lines are made of it; rename its lines"
        if own:
            remedy = "make another one that holds what it holds, by edit.group, and ungroup this"
        title = f"the group {state.groups.name[what.group]!r}"
        raise BadInputError(f"{title} keeps its name", "in rename", remedy)
    elif what.curve >= 0 and len(state.lines.curves[what.line]) > 1:
        title = state.lines.name[what.line]
        remedy = f"a curve has the name of its line; rename {title!r}"
        raise BadInputError(f"one of several curves of {title!r}", "in rename", remedy)
    else:
        _rename_line(edit, what.line, line_name(name))


def _rename_line(edit: Transaction, line: int, name: str) -> None:
    state = edit.state
    group = state.lines.group[line]
    others = {
        state.lines.name[other]
        for other in state.live("lines").tolist()
        if state.lines.group[other] == group and other != line
    }
    fixed = _fixed(state) | _labels(state, -1)
    if plain_name(name) in _plain_groups(state):
        raise NameTakenError("group, tunnel or body", name)
    if name in others | fixed:
        raise NameTakenError(f"line of {state.groups.name[int(group)]}", name)
    _rename_features(edit, str(state.lines.key[line]), state.lines.name[line], name)
    edit.journal.set(state.lines.name, [line], [name])


def rename_lines(edit: Transaction, names: Mapping[int, str]) -> None:
    """Give several lines other names at once; one may take what another gives up.

    Raises
    ------
    NameTakenError
        Two lines of one group come to have one name, or another object has it.
    BadInputError
        One of them is no name.
    """
    state, wanted = edit.state, {line: line_name(name) for line, name in names.items()}
    fixed = _fixed(state) | _labels(state, -1)
    taken, own = set[tuple[int, str]](), _plain_groups(state)
    for line in state.live("lines").tolist():
        name = wanted.get(line, str(state.lines.name[line]))
        group = int(state.lines.group[line])
        if (group, name) in taken or (
            line in wanted and (name in fixed or plain_name(name) in own)
        ):
            raise NameTakenError(f"line of {state.groups.name[group]}", name)
        taken.add((group, name))
    for line, name in wanted.items():
        _rename_features(edit, str(state.lines.key[line]), str(state.lines.name[line]), name)
    edit.journal.set(state.lines.name, list(wanted), list(wanted.values()))


def _rename_features(edit: Transaction, key: str, old: str, new: str) -> None:
    """Let the features of a line that are named after it be so still."""
    edit.maker.features(
        attrs.evolve(each, name=new + each.name[len(old) :])
        if key in each.lines and (each.name == old or each.name.startswith(f"{old} "))
        else each
        for each in edit.state.features
    )


def _rename_point(edit: Transaction, row: int, name: str) -> None:
    state = edit.state
    lines = {state.lines.name[line] for line in state.live("lines").tolist()}
    if name in lines | _fixed(state) | _labels(state, row):
        raise NameTakenError("line or point", name)
    edit.journal.set(state.rows.label, [row], [name])


def taken_names(state: HullState) -> set[str]:
    """Give all names and keys of groups, lines and things beside the net, and labels of points."""
    lines = {state.lines.name[line] for line in state.live("lines").tolist()}
    return (lines | _fixed(state) | set(state.rows.label.data.given.values())) - {""}


def _fixed(state: HullState) -> set[str]:
    """Give the names that no object can lay down."""
    return {*state.groups.name.data, *state.lines.key.data, *attachment_names(state)}


def _plain_groups(state: HullState) -> set[str]:
    """Give names of groups and of things beside the net as they are looked up."""
    groups = {plain_name(state.groups.name[each]) for each in state.live("groups").tolist()}
    return groups | {plain_name(each) for each in attachment_names(state)}


def _labels(state: HullState, but: int) -> set[str]:
    """Give the names of points, without one."""
    rows = state.live("rows").tolist()
    return {state.rows.label[row] for row in rows if row != but} - {""}


def rename_hull(edit: Transaction, name: object) -> None:
    """Give the ship another name, in its particulars.

    Raises
    ------
    BadInputError
        It is no name.
    """
    given = word(name, "the name", "in rename")
    if not given.strip() or not given.isprintable():
        remedy = "give printable text in one line"
        raise BadInputError(f"the name {shown(name)}", "in rename", remedy)
    state = edit.state
    new = attrs.evolve(state.particulars, name=given)
    edit.journal.set(state.settings.particulars, [0], [new])


def set_particulars(edit: Transaction, draught: float | None, deck: str | None) -> None:
    """Say the design draught (m), and whether the deck is open or closed; no line moves.

    Raises
    ------
    BadInputError
        Nothing is given, another word for the deck; the lines are made for their draught.
    OutOfRangeError
        A draught above the highest point of the hull.
    """
    where, state = "in set_particulars", edit.state
    if draught is None and deck is None:
        raise BadInputError("nothing is given", where, "give draught or deck")
    new = state.particulars
    if deck is not None:
        choice(deck, "deck", DECKS, where)
        new = attrs.evolve(new, deck=deck)
        edit.pending.notes.append(f"the deck is {deck} now")
    if draught is not None:
        given = positive(draught, "draught", where)
        top = float(state.rows.xyz[state.live("rows"), 2].max(initial=0.0))
        if given > top:
            why = "is above the highest point of the hull"
            raise OutOfRangeError("draught", given, where, why, 0.0, top, "m")
        if len(state.live("formed")) and given != new.draught:
            # Areas of their definitions are those below the design draught.
            what = "the lines are made from form parameters for their draught"
            remedy = "vary the draught, or give one where it is asked, as hydrostatics(draught=...)"
            raise BadInputError(what, where, remedy)
        new = attrs.evolve(new, draught=given)
        edit.pending.notes.append(f"the design draught is {given:.6g} m now")
    edit.journal.set(state.settings.particulars, [0], [new])


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

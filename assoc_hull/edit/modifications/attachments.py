"""Things beside the net, by name: put there, renamed, taken away; tunnels and bodies alike."""

from __future__ import annotations

from typing import TypeVar

import attrs

from assoc_hull.arguments import plain_name, shown_name
from assoc_hull.edit.modifications.names import taken_names
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import NameTakenError, UnknownNameError
from assoc_hull.model.attachments import (
    ATTACHMENTS,
    Attachment,
    attachment_named,
    attachments_in_order,
)
from assoc_hull.model.tables import HullState

__all__ = ["held_by_name", "is_attachment", "put", "refuse_taken", "remove", "rename_attachment"]

Held = TypeVar("Held", bound=Attachment)


def is_attachment(state: HullState, name: object) -> bool:
    """Tell whether something beside the net is called so."""
    return isinstance(name, str) and attachment_named(state, name) is not None


def held_by_name(state: HullState, made: type[Held], name: object) -> Held:
    """Give the thing of a class that a name stands for.

    Raises
    ------
    UnknownNameError
        There is none of that name.
    """
    found = attachment_named(state, name) if isinstance(name, str) else None
    if found is None or not isinstance(found[1], made):
        kind = next(each for each in ATTACHMENTS if each.made is made)
        names = tuple(each.name for each in kind.of(state)[0])
        raise UnknownNameError(kind.word, shown_name(name), names)
    return found[1]


def refuse_taken(state: HullState, name: str, but: Attachment | None = None) -> None:
    """Refuse a name that something else has, `but` aside, however a person writes it.

    Raises
    ------
    NameTakenError
        A group, a line, a point or a thing beside the net has it.
    """
    plain = plain_name(name)
    taken = taken_names(state) - ({but.name} if but else set())
    if any(plain_name(each) == plain for each in taken):
        raise NameTakenError("group, line, point, tunnel or body", name)


def put(edit: Transaction, old: Attachment | None, new: Attachment | None) -> None:
    """Put one thing in the place of another of its kind; of equal ones nothing is written."""
    made = type(old if new is None else new)
    column = next(each for each in ATTACHMENTS if each.made is made).of(edit.state)
    if old != new:
        kept = [each for each in column[0] if each is not old]
        found = attachments_in_order([*kept, *(() if new is None else (new,))])
        edit.journal.set(column, [0], [found])


def remove(edit: Transaction, made: type[Attachment], name: str) -> None:
    """Take a thing of a class away; `UnknownNameError` if there is none of that name."""
    put(edit, held_by_name(edit.state, made, name), None)


def rename_attachment(edit: Transaction, name: str, new: str) -> None:
    """Give a thing beside the net another name.

    Raises
    ------
    NameTakenError
        Something else has the new one.
    """
    found = attachment_named(edit.state, name)
    assert found is not None, "its name was looked up before"
    if new != found[1].name:
        refuse_taken(edit.state, new, but=found[1])
        put(edit, found[1], attrs.evolve(found[1], name=new))

"""Edits given as data or as a function, and edits of one hull made again on another.

A script is a list of modifications, each a method of `Edit` and its arguments by name; every
committed step carries the script that it was asked for by. `replay` finds the objects by their
addresses, so it works on any hull that has them, and says of each step why it could not be made.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Literal

import attrs

from assoc_hull.arguments import shown, shown_name
from assoc_hull.edit.document import Document
from assoc_hull.edit.recording import WRITTEN_OUT, Script, Settings
from assoc_hull.edit.session import Edit
from assoc_hull.edit.step import EditReport, Step
from assoc_hull.errors import AssocHullError, UnknownNameError, WrongTypeError

__all__ = [
    "Changes",
    "GapsName",
    "PolicyName",
    "Replayed",
    "carry_out",
    "operations",
    "replay",
]

Changes = Callable[[Edit], object] | Sequence[Mapping[str, object]]
PolicyName = Literal["all_or_nothing", "keep_going"]
GapsName = Literal["refuse", "report"]


def carry_out(edit: Edit, changes: Changes | None) -> None:
    """Put modifications into an edit.

    Parameters
    ----------
    edit : Edit
        The edit, entered.
    changes : callable, or sequence of mappings
        Called with the edit; or each ``{"op": "move", "point": "WL 0.5 x ST 7", "y": 3.21}``:
        the method and its arguments by name.

    Raises
    ------
    UnknownNameError
        No such modification.
    WrongTypeError
        A mapping without ``op``, or arguments that do not fit.
    """
    if callable(changes):
        changes(edit)
        return
    if not isinstance(changes, Sequence) or isinstance(changes, str | bytes):
        what = f"the edits are {shown(changes)}"
        raise WrongTypeError(what, "in an edit", 'give a function, or [{"op": "move", ...}, ...]')
    for number, change in enumerate(changes, start=1):
        _modify(edit, change, f"in modification {number}")


def _modify(edit: Edit, change: object, where: str) -> None:
    """Put one modification into an edit: a method and its arguments by name."""
    if not isinstance(change, Mapping) or not all(isinstance(key, str) for key in change):
        raise WrongTypeError(f"it is {shown(change)}", where, 'give {"op": "move", "point": ...}')
    arguments = dict(change)
    name, known = arguments.pop("op", ""), operations()
    if not isinstance(name, str) or name not in known:
        raise UnknownNameError("modification", shown_name(name), tuple(known))
    method, takes = getattr(edit, name), known[name]
    arguments |= {
        each: False for each in WRITTEN_OUT if each in takes.parameters and each not in arguments
    }
    any_name = any(each.kind is each.VAR_KEYWORD for each in takes.parameters.values())
    for given in arguments:
        if given not in takes.parameters and not any_name:
            remedy = f"it takes {', '.join(takes.parameters)}"
            raise WrongTypeError(f"{name} takes no {given!r}", where, remedy)
    try:
        takes.bind(**arguments)
    except TypeError as error:
        raise WrongTypeError(f"{name}: {error}", where, "add it") from error
    method(**arguments)


@cache
def operations() -> Mapping[str, inspect.Signature]:
    """Give what the public methods of an edit take, by name."""
    found = dict[str, inspect.Signature]()
    for name in sorted(vars(Edit)):
        method = getattr(Edit, name)
        if not name.startswith("_") and callable(method):
            takes = inspect.signature(method)
            found[name] = takes.replace(parameters=tuple(takes.parameters.values())[1:])
    return found


# --------------------------------------------------------------------------------------
# Replay.

Vary = Callable[[Mapping[str, object]], EditReport]
"""Varies the hull in place by a script of `Hull.vary_by`."""


@attrs.frozen
class Replayed:
    """What became of one edit.

    Attributes
    ----------
    name : str
        Name of the edit.
    report : EditReport or None
        Its report on this hull; None if it was not made.
    why : str
        Why it was not made.
    """

    name: str
    report: EditReport | None
    why: str = ""

    def __str__(self) -> str:
        return f"{self.name}: {'made again' if self.report else self.why}"


def replay(
    document: Document, steps: Sequence[Step], *, skip: bool = False, vary: Vary | None = None
) -> tuple[Replayed, ...]:
    """Make edits of this or another hull again, each as one step, in their order.

    Stops at the first that cannot be made, or goes on behind it if `skip`. Variations are made by
    `vary`.
    """
    found: list[Replayed] = []
    for step in tuple(steps):  # on the same hull, the history grows meanwhile
        found.append(_again(document, step, vary))
        if found[-1].report is None and not skip:
            break
    return tuple(found)


def _again(document: Document, step: Step, vary: Vary | None) -> Replayed:
    script = step.script
    try:
        if script.variation is not None and vary is not None:
            return Replayed(step.name, vary(script.variation))
        if not script.repeatable:
            return Replayed(step.name, None, _untold(script))
        with Edit(document, step.name, Settings.named(script.policy, script.gaps)) as edit:
            carry_out(edit, script.edits)
    except AssocHullError as error:
        return Replayed(step.name, None, str(error))
    return Replayed(step.name, edit.report)


def _untold(script: Script) -> str:
    """Say why nothing tells what an edit was asked for, and what makes it all the same."""
    if script.with_function:
        return "it was given a function, and a function cannot be told: edit this hull with it"
    if script.varied:
        asked = " ".join(f"{name}={value:.10g}" for name, value in script.varied.set.items())
        return (
            "the file does not tell all that this variation was asked for (layers given in Python, "
            f"or a file of an older version): vary this hull again{asked and f', by {asked}'}"
        )
    return (
        "it is made of no modifications, as jumboise and edits inside the program are: make it "
        "again by the command or method that made it"
    )

"""Edits given as data or as a function, and how they are to be carried out."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal

from assoc_hull.arguments import choice, shown, shown_name
from assoc_hull.edit.pending_changes import Settings
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.graph.run_update import Policy

__all__ = ["Changes", "GapsName", "PolicyName", "carry_out", "settings_of"]

Changes = Callable[[Edit], object] | Sequence[Mapping[str, Any]]
PolicyName = Literal["all_or_nothing", "keep_going"]
GapsName = Literal["refuse", "report"]


def settings_of(policy: str, gaps: str) -> Settings:
    """Give the settings by their public names.

    Raises
    ------
    BadInputError
        An unknown name.

    Examples
    --------
    >>> from assoc_hull.edit.script import settings_of
    >>> settings_of("keep_going", "report").refuse_gaps
    False
    """
    for what, given, known in (
        ("policy", policy, [each.value for each in Policy]),
        ("gaps", gaps, ["refuse", "report"]),
    ):
        choice(given, what, known, "in an edit")
    return Settings(Policy(policy), gaps == "refuse")


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
    BadInputError
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
    name, known = arguments.pop("op", ""), _operations(edit)
    if not isinstance(name, str) or name not in known:
        raise UnknownNameError("modification", shown_name(name), known)
    method = getattr(edit, name)
    takes = inspect.signature(method)
    any_name = any(each.kind is each.VAR_KEYWORD for each in takes.parameters.values())
    for given in arguments:
        if given not in takes.parameters and not any_name:
            remedy = f"it takes {', '.join(takes.parameters)}"
            raise BadInputError(f"{name} takes no {given!r}", where, remedy)
    try:
        takes.bind(**arguments)
    except TypeError as error:
        raise BadInputError(f"{name}: {error}", where, "add it") from error
    method(**arguments)


def _operations(edit: Edit) -> tuple[str, ...]:
    return tuple(
        name
        for name in sorted(vars(type(edit)))
        if not name.startswith("_") and callable(getattr(type(edit), name))
    )

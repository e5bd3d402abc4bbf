"""Edits given as data or as a function, and how they are to be carried out."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal

from assoc_hull.edit.pending import Settings
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.graph.run import Policy

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
        if given not in known:
            raise BadInputError(f"{what}={given!r}", "in an edit", f"use {' or '.join(known)}")
    return Settings(Policy(policy), gaps == "refuse")


def carry_out(edit: Edit, changes: Changes) -> None:
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
    for number, change in enumerate(changes, start=1):
        arguments = dict(change)
        name = str(arguments.pop("op", ""))
        if name not in (known := _operations(edit)):
            raise UnknownNameError("modification", name, known)
        try:
            getattr(edit, name)(**arguments)
        except TypeError as error:
            raise BadInputError(str(error), f"in modification {number}", "mend it") from error


def _operations(edit: Edit) -> tuple[str, ...]:
    return tuple(
        name
        for name in sorted(vars(type(edit)))
        if not name.startswith("_") and callable(getattr(type(edit), name))
    )

"""What an edit was asked for: as data that can be asked for again, and in words.

Handles are written as addresses, as they were when the call was made.

What an edit was asked for, in the words in which causes name it.

Examples
--------
>>> from assoc_hull.edit.recording import said
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.objects import handle
>>> said(handle(wigley(), "ST 7 x WL 2.5"))
'ST 7 x WL 2.5'
>>> from assoc_hull.edit.recording import asked_words
>>> asked_words({"op": "pull", "point": "WL 1 x ST 4", "d": 0.02})
'the pull at WL 1 x ST 4'
"""

from __future__ import annotations

import contextlib
import inspect
from collections.abc import (
    Callable,
    Iterable,
    Iterator,
    Mapping,
    Sequence,
)
from functools import wraps
from typing import (
    Concatenate,
    ParamSpec,
    Protocol,
    Self,
    TypeVar,
)

import attrs
import numpy as np

from assoc_hull.arguments import choice
from assoc_hull.errors import AssocHullError
from assoc_hull.graph.run_update import FailurePolicy
from assoc_hull.model.address import AddressBook, address
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.objects import (
    Crossing,
    Curve,
    Group,
    Line,
    Point,
)

__all__ = [
    "ANY_FUNCTION",
    "WRITTEN_OUT",
    "Recording",
    "Said",
    "Script",
    "Settings",
    "VariedValues",
    "asked_words",
    "field_words",
    "joined_words",
    "recorded",
    "said",
]

ANY_FUNCTION = "<a function>"
"""Stands where a function was given: nothing tells it, so the edit cannot be repeated."""

Said = None | bool | int | float | str | list["Said"] | dict[str, "Said"]
"""A value as JSON can say it."""

WRITTEN_OUT = ("lead",)
"""Arguments that scripts always say. Where a script does not, it means False."""

_DEEPEST = 8

P = ParamSpec("P")
T = TypeVar("T")


@attrs.frozen
class Settings:
    """How an edit is carried out.

    Attributes
    ----------
    policy : FailurePolicy
        What becomes of an edit when a curve cannot be made.
    refuse_gaps : bool
        Whether a watched gap that stays over its limit refuses the edit; else it is kept
        as a defect that a check names.
    """

    policy: FailurePolicy = FailurePolicy.ALL_OR_NOTHING
    refuse_gaps: bool = True

    @classmethod
    def named(cls, policy: str | None, gaps: str | None, else_as: Settings | None = None) -> Self:
        """Give settings by their public names; what is not named is as in `else_as`.

        Raises
        ------
        BadInputError
            An unknown name.

        Examples
        --------
        >>> from assoc_hull.edit.recording import Settings
        >>> Settings.named("keep_going", "report").refuse_gaps
        False
        """
        usual = else_as or _USUAL
        if policy is not None:
            choice(policy, "policy", [each.value for each in FailurePolicy], "in an edit")
        if gaps is not None:
            choice(gaps, "gaps", ["refuse", "report"], "in an edit")
        return cls(
            usual.policy if policy is None else FailurePolicy(policy),
            usual.refuse_gaps if gaps is None else gaps == "refuse",
        )


_USUAL = Settings()


@attrs.frozen
class VariedValues:
    """Values by name that a variation gave a hull; nothing for an edit that is none.

    Attributes
    ----------
    set, reached : dict of str to float
        Parameters that were set, and outputs that were reached, in their units.
    spent : dict of str to float
        By how much each parameter was changed, set or free; strengths of layers.
    """

    set: dict[str, float] = attrs.field(factory=dict)
    reached: dict[str, float] = attrs.field(factory=dict)
    spent: dict[str, float] = attrs.field(factory=dict)

    def __bool__(self) -> bool:
        return bool(self.set or self.reached or self.spent)

    def then(self, later: VariedValues) -> VariedValues:
        """Give what both together gave: of a value that both set, the later one."""
        spent = dict(self.spent)
        for name, amount in later.spent.items():
            spent[name] = spent.get(name, 0.0) + amount
        return VariedValues(self.set | later.set, self.reached | later.reached, spent)


@attrs.frozen
class Script:
    """What an edit was asked for.

    Attributes
    ----------
    edits : tuple of dict
        Each ``{"op": "move", "point": "WL 0.5 x ST 7", "y": 3.21}``: a method of
        `assoc_hull.edit.session.Edit` and its arguments by name.
    policy, gaps : str
        How it was to be carried out, as `assoc_hull.hull.Hull.edit` takes it.
    varied : VariedValues
        What it gave the hull as a variation.
    before : VariedValues
        What the hull had been given before its history began, in that of the hull it was copied
        from; told by the first variation alone.
    variation : dict or None
        What it was asked for as a variation, as `Hull.vary_by` takes it; None if it is none, or
        if nothing tells it.
    """

    edits: tuple[dict[str, Said], ...] = ()
    policy: str = FailurePolicy.ALL_OR_NOTHING.value
    gaps: str = "refuse"
    varied: VariedValues = attrs.field(factory=VariedValues)
    before: VariedValues = attrs.field(factory=VariedValues)
    variation: dict[str, object] | None = None

    @classmethod
    def of(
        cls, edits: Sequence[dict[str, Said]], settings: Settings, varied: VariedValues,
        before: VariedValues, variation: Mapping[str, object] | None = None,
    ) -> Self:  # fmt: skip
        """Put a script together."""
        gaps = "refuse" if settings.refuse_gaps else "report"
        asked = None if variation is None else dict(variation)
        return cls(tuple(edits), settings.policy.value, gaps, varied, before, asked)

    @property
    def repeatable(self) -> bool:
        """Whether modifications tell all that was asked for, so that it can be asked again."""
        return bool(self.edits) and not self.with_function

    @property
    def with_function(self) -> bool:
        """Whether a modification was given a function, which nothing tells."""
        return ANY_FUNCTION in _all_values(self.edits)


def _all_values(value: object) -> Iterator[object]:
    """Give every value in nested lists and dicts."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list | tuple):
        for each in value:
            yield from _all_values(each)
    else:
        yield value


class Recording(Protocol):
    """An edit that keeps what it was asked for."""

    def _note(self, change: dict[str, Said]) -> None:
        """Keep a modification."""


R = TypeVar("R", bound=Recording)


def recorded(method: Callable[Concatenate[R, P], T]) -> Callable[Concatenate[R, P], T]:
    """Let a method of an edit keep each call that it accepted."""
    takes = inspect.signature(method).parameters
    names = list(takes)[1:]
    # What an older script leaves out may have another meaning than what a call does.
    always = {name: takes[name].default for name in WRITTEN_OUT if name in takes}

    @wraps(method)
    def asked(self: R, /, *args: P.args, **named: P.kwargs) -> T:
        given = {**dict(zip(names, args, strict=False)), **named}
        given |= {name: value for name, value in always.items() if name not in given}
        change = {name: said(value) for name, value in given.items()}
        found = method(self, *args, **named)
        self._note({"op": method.__name__, **change})
        return found

    return asked


def said(value: object, depth: int = 0) -> Said:
    """Give a value as JSON can say it, and as the same argument accepts it."""
    if depth > _DEEPEST:
        return ANY_FUNCTION  # no argument is nested so deeply: it will be refused
    if isinstance(value, Point):
        return address(value.tables, value.number, value.side) if value.alive else value.id
    if isinstance(value, Crossing):
        return address(value.tables, value.number) if value.alive else value.id
    if isinstance(value, FormDefinition):
        return value.use
    if isinstance(value, Group | Line | Curve):
        return _named(value)
    if isinstance(value, np.ndarray | np.generic):
        plain: Said = value.tolist()
        return plain
    if isinstance(value, list | tuple):
        return [said(each, depth + 1) for each in value]
    if isinstance(value, Mapping):
        return {str(said(key, depth + 1)): said(each, depth + 1) for key, each in value.items()}
    if getattr(value, "document", None) is not None:
        return None  # the hull itself
    if isinstance(value, str | int | float | bool | None):
        return value
    return ANY_FUNCTION


def _named(thing: Group | Line | Curve) -> str:
    """Give the name of a line or curve if it leads back, else its key."""
    if isinstance(thing, Group) or not thing.alive:
        return thing.id
    book = AddressBook(thing.tables)
    curve = isinstance(thing, Curve)
    name = book.curve_name(thing.number) if curve else book.line_name(thing.number)
    with contextlib.suppress(AssocHullError):
        found = book.resolve(name)
        numbers = {found.line, *thing.tables.lines.curves[found.line]} if curve else {found.line}
        if thing.number in numbers:
            return name
    return thing.id


_WORDS = {
    "move": "the move of {point}",
    "insert": "the point put into {curve}",
    "delete": "the deletion of {point}",
    "pull": "the pull at {point}",
    "reshape": "the re-shaping of {curve}",
    "lead": "the lead of {line}",
    "fair": "the fairing of {lines}",
    "straighten": "the straightening of {line}",
    "round": "the rounding of {line}",
    "transform": "the transformation",
    "set_particulars": "the new particulars",
    "tunnel": "the tunnel {name}",
    "set_tunnel": "the new axis or radius of {name}",
    "remove_tunnel": "the removal of {name}",
    "body": "the body {name}",
    "set_body": "the new place or shape of {name}",
    "remove_body": "the removal of {name}",
    "set_form": "the new values of {definition}",
}
"""By modification, with names of its arguments."""

_FIELDS = frozenset({"pull", "reshape", "lead", "fair", "transform"})
"""Of these an edit sets points that nobody named."""

_MOST = 3
"""So many are named where several are."""


def asked_words(change: Mapping[str, Said]) -> str:
    """Say a modification in words; of one without words of its own, its name and first argument."""
    op = str(change.get("op", ""))
    if op in _WORDS:
        named = {name: _argument_words(value) for name, value in change.items()}
        if change.get("lines") is None:
            named["lines"] = "the hull"
        return _WORDS[op].format_map(named)
    first = next((value for name, value in change.items() if name != "op"), None)
    title = op.replace("_", " ")
    return f"{title} of {_argument_words(first)}" if isinstance(first, str | list) else title


def field_words(script: Iterable[Mapping[str, Said]], *, leads: bool) -> tuple[str, ...]:
    """Say those modifications of a script that set points which nobody named, each once.

    `leads`: whether lines led; else what may lead, and says so, was pinned.
    """
    chosen = (each for each in script if each.get("op") in _FIELDS or (leads and each.get("lead")))
    return tuple(dict.fromkeys(map(asked_words, chosen)))


def joined_words(words: Sequence[str]) -> str:
    """Name several things, the first of them where they are many."""
    if len(words) > _MOST:
        return f"{', '.join(words[:_MOST])} and {len(words) - _MOST} more"
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def _argument_words(value: Said) -> str:
    """Name an argument; of a list its first items."""
    if isinstance(value, list):
        return joined_words([_argument_words(each) for each in value])
    return str(value)

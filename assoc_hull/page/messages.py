"""What the browser asks: one class for each message, and `parse`, which takes them from text.

Whatever is sent, the answer is a message or one sentence (`BadInputError`): numbers are finite,
names are known, texts are short, nothing else is in it.
"""

from __future__ import annotations

import json
from typing import Any, NoReturn, get_args

import attrs

from assoc_hull.arguments import choice, flag, integer, number, once, pair, shown, shown_name
from assoc_hull.arguments import text as one_line
from assoc_hull.errors import BadInputError, WrongTypeError

__all__ = [
    "LONGEST",
    "Apply",
    "AskFairness",
    "AskHydrostatics",
    "AskPreview",
    "AskSteps",
    "AskWhy",
    "Begin",
    "Cancel",
    "Check",
    "Checkpoint",
    "Commit",
    "Compare",
    "Export",
    "Go",
    "Hello",
    "Message",
    "Parameters",
    "Question",
    "Redo",
    "Sign",
    "Stop",
    "To",
    "Undo",
    "Vary",
    "Window",
    "parse",
]

LONGEST = 65_536
"""Bytes of a message; it holds a few hundred edits."""

_WHERE = "in a message of the page"
_MOST = 2**31 - 1
_NAME = 200  # letters


def _count(_: object, field: attrs.Attribute[Any], value: object) -> None:
    integer(value, field.name, _WHERE, least=0, most=_MOST)


def _name(_: object, field: attrs.Attribute[Any], value: object) -> None:
    if len(one_line(value, field.name, _WHERE)) > _NAME:
        what = f"{field.name} has {len(str(value))} letters"
        raise BadInputError(what, _WHERE, f"give {_NAME} at most")


def _coordinate(_: object, field: attrs.Attribute[Any], value: object) -> None:
    if value is None:
        return
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise WrongTypeError(f"{field.name} is {shown(value)}", _WHERE, "give a number")
    number(value, field.name, _WHERE)


def _radius(_: object, field: attrs.Attribute[Any], value: object) -> None:
    if value is not None:
        pair(value, field.name, _WHERE, positive=True)


def _way(_: object, field: attrs.Attribute[Any], value: object) -> None:
    choice(value, field.name, ("pull", "move"), _WHERE)


def _operations(_: object, field: attrs.Attribute[Any], value: object) -> None:
    fits = isinstance(value, list) and bool(value) and all(isinstance(e, dict) for e in value)
    if not fits:
        raise WrongTypeError(f"{field.name} is {shown(value)}", _WHERE, "give a list of edits")


def _values(_: object, field: attrs.Attribute[Any], value: object) -> None:
    if not isinstance(value, dict) or not value:
        raise WrongTypeError(f"{field.name} is {shown(value)}", _WHERE, "give values by name")
    for name, each in value.items():
        if isinstance(each, bool) or not isinstance(each, int | float):
            what = f"{shown_name(name)} of {field.name} is {shown(each)}"
            raise WrongTypeError(what, _WHERE, "give a number")
        number(each, f"{shown_name(name)} of {field.name}", _WHERE)


def _flag(_: object, field: attrs.Attribute[Any], value: object) -> None:
    flag(value, field.name, _WHERE)


@attrs.frozen
class Hello:
    """The first message: who it is, and that it was let in."""

    version: int = attrs.field(validator=_count)
    token: str = attrs.field(validator=_name)
    author: str = attrs.field(validator=_name)


@attrs.frozen
class Sign:
    """Edits are signed by this name from now on."""

    author: str = attrs.field(validator=_name)


@attrs.frozen
class Begin:
    """Take hold of a point."""

    gesture: int = attrs.field(validator=_count)
    row: int = attrs.field(validator=_count)
    how: str = attrs.field(validator=_way)
    radius: list[float] | None = attrs.field(default=None, validator=_radius)


@attrs.frozen
class To:
    """How far it is held now."""

    gesture: int = attrs.field(validator=_count)
    seq: int = attrs.field(validator=_count)
    d: float | None = attrs.field(default=None, validator=_coordinate)
    x: float | None = attrs.field(default=None, validator=_coordinate)
    y: float | None = attrs.field(default=None, validator=_coordinate)
    z: float | None = attrs.field(default=None, validator=_coordinate)

    @property
    def amounts(self) -> dict[str, float]:
        """What is given."""
        found = {name: getattr(self, name) for name in ("d", "x", "y", "z")}
        return {name: float(value) for name, value in found.items() if value is not None}


@attrs.frozen
class Commit(To):
    """Let go: the edit is to be made."""

    name: str = attrs.field(default="drag", validator=_name)


@attrs.frozen
class Cancel:
    """Let go: nothing is to be made."""

    gesture: int = attrs.field(validator=_count)


@attrs.frozen
class Apply:
    """Carry out edits, as `Hull.apply` takes them, as one step."""

    id: int = attrs.field(validator=_count)
    name: str = attrs.field(validator=_name)
    ops: list[dict[str, object]] = attrs.field(validator=_operations)


@attrs.frozen
class Undo:
    """Take back the last edit of whoever asks."""

    id: int = attrs.field(validator=_count)


@attrs.frozen
class Redo:
    """Make the edit again that was taken back last."""

    id: int = attrs.field(validator=_count)


@attrs.frozen
class AskSteps:
    """List the steps and names of the history."""

    id: int = attrs.field(validator=_count)


@attrs.frozen
class Go:
    """Bring the hull to the state after a step; 0 for the hull as it came."""

    id: int = attrs.field(validator=_count)
    step: int = attrs.field(validator=_count)


@attrs.frozen
class Compare:
    """Show the hull as it was after a step."""

    id: int = attrs.field(validator=_count)
    step: int = attrs.field(validator=_count)


@attrs.frozen
class Checkpoint:
    """Name the present state."""

    id: int = attrs.field(validator=_count)
    name: str = attrs.field(validator=_name)


@attrs.frozen
class AskWhy:
    """Tell why a point or a line lies where it does."""

    id: int = attrs.field(validator=_count)
    of: str = attrs.field(validator=_name)


@attrs.frozen
class AskHydrostatics:
    """Measure the hull at its design draught, beside what it was when the server began."""

    id: int = attrs.field(validator=_count)


@attrs.frozen
class AskFairness:
    """List the waviest lines, and points that their lines do not bear out."""

    id: int = attrs.field(validator=_count)


@attrs.frozen
class Window:
    """Show the hull as it would be, if a window of it were faired."""

    id: int = attrs.field(validator=_count)
    row: int = attrs.field(validator=_count)
    noise: float = attrs.field(validator=_coordinate)
    radius: list[float] = attrs.field(validator=_radius)


@attrs.frozen
class AskPreview:
    """Show the hull as it would be after edits, which are given as for `Apply`."""

    id: int = attrs.field(validator=_count)
    ops: list[dict[str, object]] = attrs.field(validator=_operations)


@attrs.frozen
class Export:
    """Write the hull for another program; the form is the ending of the file."""

    id: int = attrs.field(validator=_count)
    form: str = attrs.field(validator=_name)


@attrs.frozen
class Stop:
    """Give up the answer to a question; it is not waited for any more."""

    id: int = attrs.field(validator=_count)


@attrs.frozen
class Check:
    """Look for what is wrong with the hull."""

    id: int = attrs.field(validator=_count)


@attrs.frozen
class Parameters:
    """List the named parameters of the hull; the limits of one of them."""

    id: int = attrs.field(validator=_count)
    of: str | None = attrs.field(default=None, validator=attrs.validators.optional(_name))


@attrs.frozen
class Vary:
    """Set named parameters: to be shown, or to be made."""

    id: int = attrs.field(validator=_count)
    set: dict[str, float] = attrs.field(validator=_values)
    apply: bool = attrs.field(default=False, validator=_flag)
    accept: bool = attrs.field(default=False, validator=_flag)


Message = (
    Hello
    | Sign
    | Begin
    | To
    | Commit
    | Cancel
    | Apply
    | Undo
    | Redo
    | AskSteps
    | Go
    | Compare
    | Checkpoint
    | AskWhy
    | AskHydrostatics
    | AskFairness
    | Window
    | AskPreview
    | Export
    | Stop
    | Check
    | Parameters
    | Vary
)

Question = Parameters | Vary | Compare | AskHydrostatics | AskFairness | Window | AskPreview
"""What is answered from a copy of the hull: the newest of a kind wins."""

_KINDS: dict[str, type[Message]] = {
    kind.__name__.removeprefix("Ask").lower(): kind for kind in get_args(Message)
}


def parse(text: str) -> Message:
    """Take a message from text.

    Raises
    ------
    BadInputError
        It is none, in one sentence.

    Examples
    --------
    >>> from assoc_hull.page.messages import parse
    >>> parse('{"t": "cancel", "gesture": 3}')
    Cancel(gesture=3)
    """
    if len(text) > LONGEST:
        raise BadInputError(f"it has {len(text)} letters", _WHERE, f"send {LONGEST} at most")
    try:
        found = json.loads(text, parse_constant=_not_finite, object_pairs_hook=once)
    except BadInputError:
        raise
    except (ValueError, RecursionError):
        raise BadInputError("it is no JSON", _WHERE, "send an object") from None
    if not isinstance(found, dict):
        raise BadInputError(f"it is {shown(found)}", _WHERE, "send an object")
    name = found.pop("t", None)
    kind = _KINDS.get(name) if isinstance(name, str) else None
    if kind is None:
        raise BadInputError(f"t is {shown(name)}", _WHERE, f"use one of {', '.join(_KINDS)}")
    fields = {each.name: each for each in attrs.fields(kind)}
    for key in found:
        if key not in fields:
            raise BadInputError(f"{shown_name(key)} is no field of {name}", _WHERE, "leave it out")
    for each in fields.values():
        if each.default is attrs.NOTHING and each.name not in found:
            raise BadInputError(f"{each.name} of {name} is missing", _WHERE, "give it")
    return kind(**found)


def _not_finite(text: str) -> NoReturn:
    raise BadInputError(f"a number is {text}", _WHERE, "give finite ones")

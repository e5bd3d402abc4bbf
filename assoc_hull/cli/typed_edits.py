"""An edit typed on the command line instead of in a file: a method of the edit, and its values.

Words stand for the arguments of the method in their order, ``name=value`` for those with a name.
A length may have a unit, numbers with commas are a place, places with semicolons are several;
``POINT to x,y,z`` is a point and where it is to come; ``--radius 20 8`` is ``radius=20,8``.

Examples
--------
>>> from assoc_hull.cli.typed_edits import typed_edit
>>> typed_edit("pull", ["WL 0.5 x ST 16", "50mm", "radius=20,8"])
{'op': 'pull', 'point': 'WL 0.5 x ST 16', 'd': 0.05, 'radius': [20.0, 8.0]}
>>> typed_edit("lead", ["BTK 1", "2.2,1,15.2; 6,1,13"])
{'op': 'lead', 'line': 'BTK 1', 'points': [[2.2, 1.0, 15.2], [6.0, 1.0, 13.0]]}
>>> typed_edit("lead", ["ST 7", "WL 0.5 x ST 7 to 42.67,8.66,3.48"])["points"]
[['WL 0.5 x ST 7', [42.67, 8.66, 3.48]]]
"""

from __future__ import annotations

import difflib
import inspect
import math
import re
from collections import deque
from collections.abc import Mapping, Sequence

from assoc_hull.cli.command_table import COMMANDS
from assoc_hull.cli.problems import UsageError
from assoc_hull.edit.recording import WRITTEN_OUT
from assoc_hull.edit.script import operations

__all__ = ["is_operation", "options_as_values", "typed_edit", "unknown_edit"]

_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(mm|cm|m|)", re.IGNORECASE)
_POWERS = {"mm": -3, "cm": -2}
_WORDS = {"true": True, "yes": True, "false": False, "no": False, "none": None}
_IN_FILES = ("rule",)
"""Modifications whose values are nested too deeply to be typed."""

_SYNONYMS = {
    "add": "insert", "bend": "reshape", "chine": "knuckle_line", "drag": "pull", "fillet": "round",
    "fix": "pin", "flatten": "straighten", "knuckle": "knuckle_line", "push": "pull",
    "release": "unpin", "remove": "delete", "scale": "transform", "set": "move", "smooth": "fair",
}  # fmt: skip
"""Words of other programs, and the modification that is meant."""

_COMMANDS_OWN = ("--out", "--name", "--why", "--wait", "--dry-run", "--replace", "--json", "--help")

_NAMED = re.compile(r"(\w+)=(.*)", re.DOTALL)


def is_operation(word: str) -> bool:
    """Tell whether a word is a modification that can be typed."""
    return word in operations()


def unknown_edit(word: str) -> UsageError:
    """Say what may have been meant by a word that is neither a modification nor a file."""
    name = word.lower()
    if name in COMMANDS:
        return UsageError(
            f"there is no modification {name!r}: it is a command of its own; "
            f"see: assoc-hull {name} --help"
        )
    near = [_SYNONYMS[name]] if name in _SYNONYMS else []
    near += difflib.get_close_matches(name, operations(), 2, 0.6)
    ask = f"; did you mean {' or '.join(map(repr, dict.fromkeys(near)))}?" if near else ";"
    return UsageError(
        f"there is no modification {word[:60]!r}{ask} write behind the hull a .json file, or one "
        f"of {', '.join(operations())}"
    )


def options_as_values(words: Sequence[str]) -> list[str]:
    """Write options of the modification that is typed as values: `--radius 20 8` as `radius=20,8`.

    Options of the command itself, and words of a modification that there is not, stay as they are.
    """
    operation = next((each for each in words[2:] if each in operations()), None)
    if operation is None:
        return list(words)
    signature = operations()[operation]
    takes = signature.parameters
    free = any(each.kind is each.VAR_KEYWORD for each in takes.values())
    found, rest = list[str](), deque(words)
    while rest:
        word = rest.popleft()
        option, given, text = word.partition("=")
        name = option[2:].replace("-", "_")
        own = any(each.startswith(option) for each in _COMMANDS_OWN)
        mine = (name in takes and option not in _COMMANDS_OWN) or (free and name and not own)
        if not word.startswith("--") or (own and not mine):
            found.append(word)
            continue
        if not mine:
            raise UsageError(
                f"{operation} takes no {option}: {operation} takes {_usage(signature)}"
            )
        if not given:
            text = _taken(option, takes.get(name), rest)
        found.append(f"{name}={text}")
    return found


def _taken(option: str, into: inspect.Parameter | None, rest: deque[str]) -> str:
    """Take the words that belong to an option; an option that is true or false needs none."""
    kind = "float" if into is None else str(into.annotation)
    if "bool" in kind:
        return rest.popleft() if rest and rest[0].lower() in _WORDS else "yes"
    # As many numbers as it takes: the next one may be a value of the modification.
    most = 3 if "ArrayLike" in kind else max(kind.count("float"), 1) if "tuple[" in kind else 1
    numbers = list[str]()
    while rest and len(numbers) < most and _number(rest[0].strip()) is not None:
        numbers.append(rest.popleft().strip())
    if numbers:
        return ",".join(numbers)
    if not rest or rest[0].startswith("-"):
        raise UsageError(f"{option} has no value; write it behind, as {option} 20 8")
    return rest.popleft()


def _with_units(words: Sequence[str]) -> list[str]:
    """Join a number and its unit that were typed with a blank between them: ``20 mm``."""
    found = list[str]()
    for word in words:
        if word in ("m", *_POWERS) and found and _NUMBER.fullmatch(found[-1].rpartition("=")[2]):
            found[-1] += word
        else:
            found.append(word)
    return found


def typed_edit(operation: str, words: Sequence[str]) -> Mapping[str, object]:
    """Give what was typed as a modification of a script.

    Parameters
    ----------
    operation : str
        A method of the edit.
    words : sequence of str
        Its values, in the order of its arguments, or ``name=value``.

    Raises
    ------
    UsageError
        More values than arguments, too few, an argument twice or unknown; it says what is taken.
    """
    if operation in _IN_FILES:
        raise UsageError(f"what {operation} takes cannot be typed; give it in a .json file")
    signature = operations()[operation]
    takes = signature.parameters
    usage = f"{operation} takes {_usage(signature)}"
    order = [name for name, each in takes.items() if each.kind is not each.VAR_KEYWORD]
    free = any(each.kind is each.VAR_KEYWORD for each in takes.values())
    left = [name for name in order if takes[name].kind is not takes[name].KEYWORD_ONLY]
    given = dict[str, object]()
    for typed in _with_units(words):
        word = typed.strip()
        named = _NAMED.fullmatch(word)
        if named and (named[1] in order or free):
            name, text = named[1], named[2]
        elif named and " x " not in word:
            raise UsageError(f"{operation} takes no {named[1]!r}: {usage}")
        elif left:
            name, text = left.pop(0), word
        else:
            raise UsageError(f"{word!r} is one value too many: {usage}")
        if name in given:
            raise UsageError(f"{name!r} of {operation} is given twice: {usage}")
        given[name] = _read(text, takes.get(name))
    try:
        signature.bind(**given)
    except TypeError as error:
        raise UsageError(f"{operation}: {error}: {usage}") from None
    # What a file of an older version leaves out means another thing than what is typed now.
    always = {name: takes[name].default for name in WRITTEN_OUT if name in takes}
    return {"op": operation, **always, **given}


def _usage(signature: inspect.Signature) -> str:
    """Write the arguments as they are typed."""
    parts = list[str]()
    for name, each in signature.parameters.items():
        if each.kind is each.VAR_KEYWORD:
            parts.append("[NAME=VALUE ...]")
        elif each.kind is each.KEYWORD_ONLY:
            parts.append(f"{name}=" if each.default is each.empty else f"[{name}=]")
        else:
            parts.append(name.upper() if each.default is each.empty else f"[{name.upper()}]")
    return " ".join(parts)


def _read(text: str, into: inspect.Parameter | None) -> object:
    """Read a value as its argument wants it: names stay as they are typed."""
    kind = "float" if into is None else str(into.annotation)
    plain = not any(word in kind for word in ("float", "ArrayLike", "bool"))
    several = into is not None and into.name == "points"
    if several or kind.startswith("Sequence[") or ("Sequence[" in kind and ";" in text):
        items = [part.strip() for part in text.split(";") if part.strip()]
        return items if plain else [_value(item) for item in items]
    if plain:
        return None if "None" in kind and into and into.name != "name" and text == "none" else text
    return _value(text)


_PAIR = re.compile(r"(.+?)\s+to\s+([^;]+)", re.IGNORECASE)


def _value(text: str) -> object:
    """Read a number with a unit, a place, a pair, a word that stands for something, or a name."""
    if ";" not in text and (pair := _PAIR.fullmatch(text)):
        return [pair[1].strip(), _value(pair[2].strip())]
    if ";" in text:
        return [_value(part.strip()) for part in text.split(";") if part.strip()]
    if "," in text:
        parts = [_number(part.strip()) for part in text.split(",")]
        if all(part is not None for part in parts):
            return parts
    found = _number(text)
    return _WORDS.get(text.lower(), text) if found is None else found


def _number(text: str) -> float | None:
    """Read a length in m, or a plain number; None if it is none."""
    match = _NUMBER.fullmatch(text)
    if match is None:
        return None
    # Through its decimal digits, so that 50mm is the number 0.05.
    mantissa, _, power = match[1].lower().partition("e")
    found = float(f"{mantissa}e{int(power or 0) + _POWERS.get(match[2].lower(), 0)}")
    return found if math.isfinite(found) else None

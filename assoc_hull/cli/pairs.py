"""What is typed as NAME=VALUE, or as NAME=LOW:HIGH."""

from __future__ import annotations

from collections.abc import Container
from typing import Any

from assoc_hull.cli.problems import UsageError

__all__ = ["limits", "pairs"]


def pairs(given: list[str], option: str) -> dict[str, Any]:
    """Take ``NAME=VALUE``; what is no number is a word.

    Raises
    ------
    UsageError
        Another form, or a name that is given twice.

    Examples
    --------
    >>> from assoc_hull.cli.pairs import pairs
    >>> pairs(["breadth=51.5", "shift=c1"], "set")
    {'breadth': 51.5, 'shift': 'c1'}
    """
    found: dict[str, Any] = {}
    for each in given:
        name, equals, value = each.partition("=")
        if not equals or not name or not value:
            raise UsageError(f"--{option} {each}: give NAME=VALUE")
        _once(name, found, option)
        found[name] = _value(value)
    return found


def _once(name: str, found: Container[str], option: str) -> None:
    if name in found:
        raise UsageError(f"--{option} {name} is given twice")


def _value(text: str) -> float | bool | str:
    if text in ("true", "false"):
        return text == "true"
    try:
        return float(text)
    except ValueError:
        return text


def limits(given: list[str], option: str) -> dict[str, list[float | None] | None]:
    """Take ``NAME`` or ``NAME=LOW:HIGH``; an end that is left out is open.

    Raises
    ------
    UsageError
        Another form, or a name that is given twice.

    Examples
    --------
    >>> from assoc_hull.cli.pairs import limits
    >>> limits(["breadth", "fore_shift=-2:2", "draught=:19"], "free")
    {'breadth': None, 'fore_shift': [-2.0, 2.0], 'draught': [None, 19.0]}
    """
    found: dict[str, list[float | None] | None] = {}
    for each in given:
        name, equals, span = each.partition("=")
        low, colon, high = span.partition(":")
        if not name or (equals and not colon):
            raise UsageError(f"--{option} {each}: give NAME or NAME=LOW:HIGH")
        _once(name, found, option)
        try:
            ends = [float(end) if end else None for end in (low, high)]
        except ValueError:
            raise UsageError(f"--{option} {each}: LOW and HIGH are numbers") from None
        found[name] = ends if equals else None
    return found

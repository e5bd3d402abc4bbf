"""Changes of nested values, as JSON holds them: what a change of letters seldom reaches."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random
from typing import Any

from tests.fuzz.odd import odd_number, odd_text, odd_value

__all__ = ["change_value"]

Place = tuple[Any, Any]
"""A list or mapping, and the index or key in it."""


def change_value(rng: Random, value: Any, count: int = 1) -> Any:
    """Change a value in place, so many times; gives it, or what took its place."""
    for _ in range(count):
        spots = _walk(rng, value)
        if spots is None:
            return odd_value(rng)
        _change(rng, value, *spots)
    return value


def _walk(rng: Random, value: Any) -> Place | None:
    """A random place: down from the top, a step at a time, so that all depths are met."""
    spot: Place | None = None
    while isinstance(value, (dict, list)) and value:
        key = rng.choice(list(value)) if isinstance(value, dict) else rng.randrange(len(value))
        spot = (value, key)
        if rng.random() < 0.12:
            break
        value = value[key]
    return spot


def _change(rng: Random, whole: Any, inside: Any, key: Any) -> None:
    """One change at a place."""
    match rng.randrange(9):
        case 0:
            inside[key] = odd_value(rng)
        case 1:
            del inside[key]
        case 2 if isinstance(inside, dict):
            inside[odd_text(rng) if rng.random() < 0.5 else f"{key}_"] = inside.pop(key)
        case 2 | 3 if isinstance(inside, list):
            inside.insert(rng.randrange(len(inside) + 1), inside[key])
        case 3:
            inside[odd_text(rng)] = odd_value(rng)
        case 4:
            _swap(rng, inside, key)
        case 5:
            inside[key] = _nested(inside[key], rng.choice((1, 2, 50, 300, 900, 3000)))
        case 6:
            spot = _like(rng, whole, inside[key])
            if spot is not None:
                inside[key] = spot
        case _:
            inside[key] = _near(rng, inside[key])


def _swap(rng: Random, inside: Any, key: Any) -> None:
    keys = list(inside) if isinstance(inside, dict) else range(len(inside))
    other = rng.choice(keys)
    inside[key], inside[other] = inside[other], inside[key]


def _nested(value: Any, depth: int) -> Any:
    for _ in range(depth):
        value = [value]
    return value


def _like(rng: Random, whole: Any, value: Any) -> Any:
    """Another value of the same type from somewhere else."""
    found = [each for each in _all(whole) if type(each) is type(value) and each is not value]
    return rng.choice(found) if found and not isinstance(value, (dict, list)) else None


def _all(value: Any) -> Iterator[Any]:
    """Every plain value, however deep."""
    stack = [value]
    while stack:
        each = stack.pop()
        if isinstance(each, (dict, list)):
            stack.extend(each.values() if isinstance(each, dict) else each)
        else:
            yield each


def _near(rng: Random, value: Any) -> Any:
    """A value of the same type, a little or far off."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, (int, float)):
        if abs(value) > 1e300:
            return odd_number(rng)
        return rng.choice((odd_number(rng), -value, 2 * value, value + rng.gauss(0.0, 1.0)))
    if isinstance(value, str):
        return rng.choice((odd_text(rng), value[:-1], value + "x", value.upper(), value * 2))
    if isinstance(value, list) and value:
        return rng.choice(([], value[:-1], value[::-1], value * 2))
    return odd_value(rng)

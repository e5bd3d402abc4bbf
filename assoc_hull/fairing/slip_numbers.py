"""The numbers that one slip of the hand makes of a printed one, or makes it of.

A slip goes both ways: whoever typed 3258 for 3528 exchanged two digits, and exchanging them again
gives the number that was meant.

Examples
--------
>>> from assoc_hull.fairing.slip_numbers import exchanged_digits, moved_points
>>> exchanged_digits("3258"), moved_points("15.2")[:4]
(('2358', '3528', '3285'), ('1.52', '152', '0.152', '1520'))
"""

from __future__ import annotations

import re
from itertools import pairwise

__all__ = ["SLIPS", "exchanged_digits", "moved_points", "other_digits", "single_slips"]

SLIPS = ("two digits exchanged", "one digit other", "decimal point", "the cell beside")
"""What may have happened, the commonest first, as it is told."""


def exchanged_digits(text: str) -> tuple[str, ...]:
    """Give the numbers with two neighbouring digits exchanged, the point between them or not."""
    digits = _digits(text)
    found = []
    for a, b in pairwise(digits):
        if text[a] != text[b]:
            found.append(f"{text[:a]}{text[b]}{text[a + 1 : b]}{text[a]}{text[b + 1 :]}")
    return tuple(each for each in found if _natural(each, text))


def other_digits(text: str) -> tuple[str, ...]:
    """Give the numbers with one digit in place of another."""
    found = [
        f"{text[:k]}{digit}{text[k + 1 :]}"
        for k in _digits(text) for digit in "0123456789" if digit != text[k]
    ]  # fmt: skip
    return tuple(each for each in found if _natural(each, text))


_PLACES = 3

_DECIMAL = re.compile(r"(-?)([0-9]*)(?:\.([0-9]*))?")


def moved_points(text: str) -> tuple[str, ...]:
    """Give the numbers with the decimal point up to three places farther left and right.

    A point that was forgotten has moved by as many places as there are decimals.
    """
    found = _DECIMAL.fullmatch(text)
    if found is None or not _digits(text):
        return ()
    sign, whole, part = found[1], found[2], found[3] or ""
    moved = []
    for by in range(1, _PLACES + 1):
        before = whole.rjust(by + 1, "0")
        moved.append(f"{sign}{before[:-by]}.{before[-by:]}{part}")
        after = part.ljust(by, "0")
        right = f"{whole}{after[:by]}".lstrip("0") or "0"
        moved.append(f"{sign}{right}.{after[by:]}" if after[by:] else f"{sign}{right}")
    return tuple(moved)


def single_slips(text: str, beside: tuple[str, ...]) -> tuple[tuple[str, str], ...]:
    """Give every number that one slip makes of a printed one, each with what the slip was.

    `beside` are the numbers in the cells beside. A number that two slips make is that of the
    commoner one.
    """
    every = (exchanged_digits(text), other_digits(text), moved_points(text), beside)
    found: dict[str, str] = {}
    for slip, numbers in zip(SLIPS, every, strict=True):
        for number in numbers:
            if number != text:
                found.setdefault(number, slip)
    return tuple(found.items())


def _digits(text: str) -> list[int]:
    """Give where the digits stand; none of a number with a power of ten, which no hand types."""
    if "e" in text.lower():
        return []
    return [k for k, letter in enumerate(text) if letter.isdigit()]


def _natural(text: str, printed: str) -> bool:
    """Tell whether a number begins as no printed one does: with a 0 before another digit."""
    return not re.match(r"-?0[0-9]", text) or bool(re.match(r"-?0[0-9]", printed))

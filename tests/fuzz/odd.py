"""Odd words and odd values: what no reader expects and every reader must stand."""

from __future__ import annotations

from random import Random
from typing import Any

__all__ = ["odd_number", "odd_text", "odd_value", "odd_word"]

NUMBERS = (
    0.0, -0.0, 1.0, -1.0, 1e308, -1e308, 1e-308, 5e-324, 1e154, 1e16, 1e7, 1e6, -1e6, 1e-9, 1e-5,
    0.5, 90.0, 360.0, float("nan"), float("inf"), float("-inf"),
)  # fmt: skip
WHOLES = (0, 1, -1, 2, 3, 2**31, 2**53, 2**53 + 1, 2**63, -(2**63), 10**400)
WORDS = (
    "", " ", "-", "+", ".", "e", "nan", "inf", "-inf", "NaN", "1e999", "-1e999", "1e-999", "1,5",
    "1.5.2", "1 000", "1_000", "0x10", "1e", "--1", "1/2", "½", "٣", "１２", "−3", "1d3", "1'000",
    "null", "true", "#", '"', "'", '""', '"1', "=1+1", "%s", "{}", "\\", "\0", "\ufeff", "\u2028",
    "é", "船", "🚢", "\u202e", "x" * 5000, "9" * 400, "0." + "3" * 400, "WL 1", "ST 1", "BTK 1",
    "station", "x", "wl_1", "wl_nan", "wl_1e999", "profile", "AP", "FP", "\ud800",
)  # fmt: skip


def odd_word(rng: Random) -> str:
    """A word for the cell of a table."""
    if rng.random() < 0.3:
        return repr(odd_number(rng))
    return rng.choice(WORDS)


def odd_text(rng: Random) -> str:
    """A text for a name."""
    return rng.choice(WORDS)


def odd_number(rng: Random) -> float | int:
    """A number that is special, huge, tiny or of no finite size."""
    return rng.choice(NUMBERS) if rng.random() < 0.7 else rng.choice(WHOLES)


def odd_value(rng: Random, depth: int = 0) -> Any:
    """Any value that JSON can say, and some that it cannot."""
    kind = rng.randrange(8)
    if kind == 0:
        return rng.choice((None, True, False))
    if kind <= 2:
        return odd_text(rng)
    if kind <= 5 or depth > 2:
        return odd_number(rng)
    inner = [odd_value(rng, depth + 1) for _ in range(rng.randrange(4))]
    return inner if kind == 6 else {odd_text(rng): each for each in inner}

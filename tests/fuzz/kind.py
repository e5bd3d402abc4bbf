"""What is fuzzed: a kind of input, how one is made, and which commands take it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from random import Random

import attrs

__all__ = ["TARGET", "Kind", "made"]

TARGET = "out.hull.json"
"""The file that commands write; it must be whole or absent."""

Commands = list[list[str]]


def _nothing() -> dict[str, bytes]:
    return {}


@attrs.frozen
class Kind:
    """A kind of input.

    All functions are those of a module, so that a kind can be sent to another process.

    Attributes
    ----------
    name : str
        How it is called; the folder of its corpus.
    file : str
        Name of the file that holds the input.
    make : callable
        Takes a source of chance and gives an input.
    commands : callable
        Takes the input and gives the commands that are run on it, one after another while
        they end with 0; what they write is `TARGET`, or `extra`.
    beside : callable
        Gives the other files that the commands need.
    extra : tuple of str
        Files besides `TARGET` that a command may write.
    rewrites : tuple of str
        Commands that may change the input itself: it must be whole when they end with 0, and
        is never changed when they do not.
    weight : int
        Its share of the inputs when all kinds are run.
    """

    name: str
    file: str
    make: Callable[[Random], bytes]
    commands: Callable[[bytes], Commands]
    beside: Callable[[], Mapping[str, bytes]] = _nothing
    extra: tuple[str, ...] = ()
    rewrites: tuple[str, ...] = ()
    weight: int = 1


def made(kind: Kind, seed: int, number: int) -> bytes:
    """The input of a number: the same on every machine."""
    return kind.make(Random(f"{kind.name}/{seed}/{number}"))

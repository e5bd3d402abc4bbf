r"""Texts of classical definitions, of whichever kind their first word says.

Examples
--------
>>> from assoc_hull.io.classical.read import READERS
>>> "SFOLDS" in READERS
True
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TypeGuard

from assoc_hull.arguments import file_path, regular_file, word
from assoc_hull.creation.classical.classical_net import ClassicalDefinition
from assoc_hull.errors import BadInputError
from assoc_hull.io.classical.cards import Cards, kind_of, read_cards
from assoc_hull.io.classical.prelikon import read_prelikon
from assoc_hull.io.classical.seaking import read_seaking
from assoc_hull.io.classical.sfolds import read_sfolds

__all__ = [
    "READERS",
    "holds_definition",
    "is_definition",
    "read_definition",
    "read_definition_file",
]

READERS: Mapping[str, Callable[[Cards], ClassicalDefinition]] = {
    "SEAKING": read_seaking,
    "SFOLDS": read_sfolds,
    "PRELIKON": read_prelikon,
}
"""What makes a definition of cards, by the kind of the text."""

_HEAD = 20_000
"""So many bytes of a file tell what it holds."""

_MOST = 20_000_000
"""A larger file is no definition by hand."""


def holds_definition(path: str | os.PathLike[str]) -> bool:
    """Tell whether a file begins as a text of a definition does.

    Raises
    ------
    BadInputError
        What is handed in is no name of a file.
    """
    given = Path(file_path(path, "in holds_definition"))
    if not given.is_file():
        return False
    with given.open("rb") as file:
        head = file.read(_HEAD)
    return b"\0" not in head and kind_of(head.decode("utf-8", "replace")) is not None


def is_definition(value: object) -> TypeGuard[ClassicalDefinition]:
    """Tell whether something is a definition of a whole hull."""
    return all(hasattr(value, name) for name in ("particulars", "cuts", "lines", "report"))


def read_definition(text: str, source: str) -> ClassicalDefinition:
    """Make the definition that a text holds.

    Parameters
    ----------
    text : str
        The text.
    source : str
        What it is called in messages.

    Raises
    ------
    BadInputError
        No such text, or a card that is not of its form.
    GeometryError
        Numbers of which no hull can be made.
    """
    where = "in read_definition"
    cards = read_cards(word(text, "text", where), word(source, "source", where))
    if cards.kind not in READERS:
        remedy = f"give one of {', '.join(READERS)}"
        raise BadInputError(f"texts of the kind {cards.kind} are not read", f"in {source}", remedy)
    return READERS[cards.kind](cards)


def read_definition_file(path: str | os.PathLike[str]) -> ClassicalDefinition:
    """Make the definition that a file holds; errors as `read_definition`, or no such file."""
    file = Path(file_path(path, "in read_classical"))
    try:
        if file.is_file() and file.stat().st_size > _MOST:
            raise BadInputError("the file is too large", f"at {file}", "give a text of cards")
        raw = regular_file(file).read_bytes()
    except OSError as error:
        what = f"the file cannot be read ({error.strerror})"
        raise BadInputError(what, f"at {file}", "check the path") from None
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    if "\0" in text:
        raise BadInputError("the content is binary", f"at {file}", "give a text of cards")
    return read_definition(text, file.name)

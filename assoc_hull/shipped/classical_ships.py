"""Ships defined in the classical ways, as texts that come with the package."""

from __future__ import annotations

from importlib.resources import files

from assoc_hull.arguments import choice
from assoc_hull.creation.classical.classical_net import ClassicalDefinition
from assoc_hull.io.classical.read import read_definition

__all__ = ["SHIPS", "classical_ship", "classical_text"]

SHIPS = ("prelikon_ship", "seaking_ship", "sfolds_ship")
"""Their names; each is the name of its text."""


def classical_text(name: str) -> str:
    """Give the text of a ship, one of `SHIPS`."""
    known = choice(name, "name", SHIPS, "in classical_text")
    return files("assoc_hull.shipped").joinpath(f"data/{known}.txt").read_text("utf-8")


def classical_ship(name: str) -> ClassicalDefinition:
    """Give the definition of a ship, one of `SHIPS`.

    Examples
    --------
    >>> from assoc_hull.shipped.classical_ships import classical_ship
    >>> classical_ship("sfolds_ship").particulars.name
    'Ferry of 90 m'
    """
    return read_definition(classical_text(name), f"{name}.txt")

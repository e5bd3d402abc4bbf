"""Families of lines, kinds of boundary, and the small codes the tables hold.

The rank of a family decides only ties: who gives a value when a net is made, and which of
two curves drives the other. Boundary curves come first, then sections, which carry the net.

Examples
--------
>>> from assoc_hull.model.kinds import FAMILIES
>>> FAMILIES["waterlines"].axis, FAMILIES["sections"].rank
(2, 1)
"""

from __future__ import annotations

from enum import IntEnum
from typing import NoReturn

import attrs

from assoc_hull.arguments import no_member

__all__ = ["FAMILIES", "OWN", "BoundaryKind", "Family", "Role", "Sort", "State"]


class Sort(IntEnum):
    """Where a point comes from."""

    CROSSING = 0
    PLACED = 1
    ADOPTED = 2


class Role(IntEnum):
    """Which of the two curves a and b a crossing defines."""

    SHARED = 0
    DRIVES_A = 1
    DRIVES_B = 2
    WATCHED = 3

    @property
    def text(self) -> str:
        """The name used in the public interface."""
        return self.name.lower().replace("_", " ")


class State(IntEnum):
    """Whether an object is up to date."""

    CLEAN = 0
    FAILED = 1
    BLOCKED = 2


class BoundaryKind(IntEnum):
    """What a boundary curve does to the lines that meet it."""

    END = 0
    FLAT = 1
    KNUCKLE = 2

    @classmethod
    def _missing_(cls, value: object) -> NoReturn:
        raise no_member(cls, value)


@attrs.frozen
class Family:
    """A family of lines.

    Attributes
    ----------
    name : str
        Name of the family, plural.
    prefix : str
        Begins the name of its lines.
    rank : int
        Lower ranks give values to higher ones.
    axis : int or None
        Coordinate that is constant on each line; None for space curves and inclined planes.
    """

    name: str
    prefix: str
    rank: int
    axis: int | None


OWN = "own"
"""Stands for the family of a group that a designer made: its lines are of several."""

FAMILIES = {
    family.name: family
    for family in (
        Family("boundary", "", 0, None),
        Family("sections", "ST", 1, 0),
        Family("waterlines", "WL", 2, 2),
        Family("buttocks", "BTK", 3, 1),
        Family("diagonals", "DIA", 4, None),
        Family("frames", "FR", 5, 0),
    )
}

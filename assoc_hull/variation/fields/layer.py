"""A layer of a map: displacements that are evaluated at the places before it."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.field import Region

__all__ = ["Layer"]


@runtime_checkable
class Layer(Protocol):
    """What a map is composed of.

    Outside its regions a layer's displacement is exactly nil and its Jacobian exactly the unit
    matrix, so that places there stay the same to the last bit.
    """

    @property
    def name(self) -> str:
        """For reports and messages."""
        ...

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give by how much places (n, 3), m, move, (n, 3), m."""
        ...

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        ...

    def regions(self) -> tuple[Region, ...]:
        """Give the boxes of the profile plane outside which nothing moves."""
        ...

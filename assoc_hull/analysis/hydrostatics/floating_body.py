"""What hydrostatics asks of a hull: integrals below planes, areas of stations and transom."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import attrs

from assoc_hull.analysis.hydrostatics.floating import Limits
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.immersed import Immersed, Planes

__all__ = ["Change", "FloatingBody", "Floats", "Measurable", "StationAreas"]


@attrs.frozen(eq=False)
class StationAreas:
    """Immersed areas of the stations of a hull.

    Attributes
    ----------
    x : (n,), m
        Where the stations are, rising.
    area : (d, n), m2
        Of both sides, below each of d planes.
    names : tuple of n str
        Of the stations.
    """

    x: FloatArray
    area: FloatArray
    names: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.area)


@attrs.frozen(eq=False)
class Change:
    """By how much what is measured may be off: changes that come together, with their signs.

    Attributes
    ----------
    immersed : Immersed
        Changes of the integrals: what a second rule or route gives, less what is published.
    areas : (d, n), m2, or None
        Changes of the areas of the stations; None: not known.
    transom : (d,), m2, or None
        Change of the transom's area.
    """

    immersed: Immersed
    areas: FloatArray | None = None
    transom: FloatArray | None = None


class Measurable(Protocol):
    """A hull that can be cut by planes; both sides of it, m."""

    def measure(self, planes: Planes) -> Immersed:
        """Give the integrals below each plane."""
        ...

    def stations(self, planes: Planes) -> StationAreas:
        """Give the areas of the stations below each plane."""
        ...

    def transom(self, planes: Planes) -> FloatArray:
        """Give the area of transom and other flat ends below each plane, (d,), m2."""
        ...


class Floats(Protocol):
    """What can be floated: integrals below planes, and what planes must lie between."""

    @property
    def limits(self) -> Limits:
        """What a waterplane must lie between, and the deck edge."""
        ...

    def measure(self, planes: Planes) -> Immersed:
        """Give the integrals below each plane."""
        ...


class FloatingBody(Measurable, Protocol):
    """One that also knows where it floats, and how far its numbers can be trusted."""

    @property
    def limits(self) -> Limits:
        """What a waterplane must lie between, and the deck edge."""
        ...

    def changes(self, planes: Planes) -> Sequence[Change]:
        """Give by how much the integrals may be off; the amounts of several items add up."""
        ...

    def doubts(self, planes: Planes, numbers: bool = True) -> Sequence[str]:
        """Name what makes the integrals doubtful; `numbers` compares them by other routes too."""
        ...

"""What is known of a block before it is fitted: samples of its lines, sides, neighbours."""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.fitting.samples import Samples

__all__ = ["Block", "Stretch"]


@attrs.frozen
class Stretch:
    """A part of a side of a block.

    Attributes
    ----------
    low, high : float, m
        Where along the side it lies: v on ``"u0"`` and ``"u1"``, u on the others.
    centre : bool
        It lies on the centreline: y = 0.
    master : str
        The block whose border it takes over; empty if it is free.
    master_side : str
        The side of that block.
    master_low, master_high : float, m
        Where along that side; between them both parameters run in proportion.
    """

    low: float
    high: float
    centre: bool = False
    master: str = ""
    master_side: str = ""
    master_low: float = 0.0
    master_high: float = 0.0


@attrs.frozen(eq=False)
class Block:
    """A part of the half hull that one surface is fitted to.

    u runs forward, v from the deck edge down to the keel, so that S_u x S_v points out of the hull;
    both are lengths.

    Attributes
    ----------
    name : str
        ``"body"``, ``"bow"``, ``"bow stem"``, ``"bow bulb"``, ``"stern"``, ``"stern counter"``,
        ``"stern boss"``.
    kind : {"body", "bow", "stern"}
        Where it lies.
    extent : (2, 2), m
        Least and greatest u, least and greatest v of the block.
    reach : (2, 2), m
        The same with the bays beyond its sides, for which it has samples as well.
    samples : Samples
        Points on its lines and on those in the bays; `line` numbers the curves of the net.
    inside : (k,) bool
        Which of them lie on the block itself.
    sides : dict of str to tuple of Stretch
        The sides ``"u0"``, ``"u1"``, ``"v0"``, ``"v1"``, towards rising parameters.
    stations, levels : (n,), m
        Mean u of sections and mean v of waterlines and buttocks: where knots are worth most.
    corners : (4, 3), m
        The places of the corners: least u and v, greatest u, both greatest, greatest v.
    turns : (4,), degrees
        By how much the border turns there, 90 for a rectangle, little where it is round.
    singular : tuple of (float, float), m
        Parameters of corners at which the sides are tangent, or nearly.
    notes : tuple of str
        What is to be known.
    """

    name: str
    kind: str
    extent: FloatArray
    reach: FloatArray
    samples: Samples
    inside: NDArray[np.bool_]
    sides: Mapping[str, tuple[Stretch, ...]]
    stations: FloatArray
    levels: FloatArray
    corners: FloatArray
    turns: FloatArray
    singular: tuple[tuple[float, float], ...]
    notes: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.extent, self.reach, self.inside, self.stations, self.levels)
        freeze(self.corners, self.turns)

    @property
    def area(self) -> float:
        """The area of its rectangle, m2."""
        return float(np.prod(np.diff(self.extent, axis=1)))

    @property
    def masters(self) -> tuple[str, ...]:
        """The blocks whose borders it takes over, each once."""
        every = [stretch.master for side in self.sides.values() for stretch in side]
        return tuple(dict.fromkeys(name for name in every if name))

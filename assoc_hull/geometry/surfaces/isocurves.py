"""Curves across a surface: what every integral over a hull is taken on.

One half of a hull (port, y >= 0) is a few *strips*: patches ``P(u, v)`` in which u runs up,
from keel to deck, and v forward, so that ``P_u x P_v`` points out of the ship. For a fixed v
a strip gives one curve, cut into *tiles* along u; on each tile both P and the derivative
P_v are cubics in u. In most strips the curve is a section (x is constant); at a raked stem
it need not be.

Whoever gives such curves at any v is a `Strips`: a net of lofted lines does, and so does a
hull known by a formula. The integration is the same for both.
"""

from __future__ import annotations

from typing import Protocol

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["IsoCurves", "Strips"]


@attrs.frozen(eq=False)
class IsoCurves:
    """Curves v = const of strips, tile by tile.

    Attributes
    ----------
    start : (k + 1,) int
        Where the tiles of each curve begin; the tiles of one curve follow one another from
        keel to deck and join without a gap.
    point : (s, 4, 3), m
        Coefficients of P in 1, u, u^2, u^3, with u from 0 to 1 along each tile.
    across : (s, 4, 3), m
        The same of the derivative P_v.
    deck : (s,) bool
        The tile is a closed deck, which is hull for volumes but no part of the shell.
    """

    start: IntArray
    point: FloatArray
    across: FloatArray
    deck: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.point, self.across, self.deck)

    @property
    def count(self) -> int:
        """Number of curves."""
        return len(self.start) - 1


class Strips(Protocol):
    """One half of a hull as strips, each with v from 0 to 1."""

    @property
    def count(self) -> int:
        """Number of strips."""
        ...

    @property
    def order(self) -> IntArray:
        """How many Gauss points along v each strip wants where nothing happens inside, (count,)."""
        ...

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """Give one curve for each pair of a strip and a v, (k,) each, in that order."""
        ...

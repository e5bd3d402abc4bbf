"""Regions with four corners: sides, and what a rectangle they are laid out on."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.surface.blocks.region import Region

__all__ = ["SIDES", "Quad"]

SIDES = ("u0", "u1", "v0", "v1")


@attrs.frozen(eq=False)
class Quad:
    """A disc and four nodes of its border.

    Attributes
    ----------
    region : Region
        The disc.
    corner : (int, int, int, int)
        Nodes at (u, v) least and least, greatest and least, both greatest, least and greatest:
        counter-clockwise from outside the hull, u forward and v from the deck down.
    """

    region: Region
    corner: tuple[int, int, int, int]

    def side(self, name: str) -> IntArray:
        """Give the half-edges of a side, towards rising parameters."""
        a, b, c, d = self.corner
        first, last, turned = {
            "v0": (a, b, False), "u1": (b, c, False), "v1": (c, d, True), "u0": (d, a, True),
        }[name]  # fmt: skip
        run = self._run(first, last)
        return run[::-1] ^ 1 if turned else run

    def _run(self, first: int, last: int) -> IntArray:
        loop = self.region.loop
        node = self.region.begin(loop)
        i, j = (int(np.flatnonzero(node == each)[0]) for each in (first, last))
        order = np.arange(i, j if j > i else j + len(loop)) % len(loop)
        return np.asarray(loop[order])

    def nodes(self, name: str) -> IntArray:
        """Give the nodes of a side, towards rising parameters."""
        half = self.side(name)
        return np.append(self.region.begin(half), self.region.end(half[-1:]))

    def along(self, name: str, grid: float = 0.0) -> FloatArray:
        """Give how far along a side its nodes are, m; edges in steps of a grid, one at least."""
        length = self.region.graph.length[self.side(name) >> 1]
        if grid:
            length = np.maximum(np.round(length / grid), 1.0) * grid
        return np.append(0.0, np.cumsum(length))

    def extent(self) -> tuple[float, float]:
        """Give the mean lengths of opposite sides in u and in v, m."""
        u0, u1, v0, v1 = (float(self.along(name)[-1]) for name in SIDES)
        return 0.5 * (v0 + v1), 0.5 * (u0 + u1)

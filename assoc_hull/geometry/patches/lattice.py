"""Where patches lie beside one another on their surfaces, in whole numbers.

Each patch becomes a unit square of one plane: the patches of a surface side by side, as they are on
it, surfaces apart from one another. Points on a border that patches share have one place there,
whichever patch they were found on; distances are in parameters of a patch, so that one tolerance
serves all.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.lattice import Lattice
>>> box = np.array([[[0.0, 0.5], [0.0, 1.0]], [[0.5, 2.0], [0.0, 1.0]]])
>>> lattice = Lattice.of(np.zeros(2, int), box)
>>> lattice.place(np.array([0, 1]), np.array([[1.0, 0.3], [0.0, 0.3]]))
array([[1. , 0.3],
       [1. , 0.3]])
>>> lattice.neighbours[0]
array([False,  True, False, False])
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["SIDES", "Lattice"]

# The sides of a patch: which parameter is constant there, and its value.
SIDES = ((0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0))

_CORNERS = np.array([[0, 0], [0, 1], [1, 0], [1, 1]])
_STEPS = np.array([[-1, 0], [1, 0], [0, -1], [0, 1]])


@attrs.frozen(eq=False)
class Lattice:
    """Places of patches in whole numbers.

    Attributes
    ----------
    corner : (k, 2) int
        Where the corner u = v = 0 of each patch lies.
    neighbours : (k, 4) bool
        Whether another patch lies across each side: u = 0, u = 1, v = 0, v = 1.
    """

    corner: IntArray
    neighbours: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.corner, self.neighbours)

    @classmethod
    def of(cls, surface: IntArray, box: FloatArray) -> Self:
        """Lay out patches by their surfaces (k,) and their boxes (k, 2, 2) on these."""
        corner = np.stack([_positions(surface, box[:, axis]) for axis in range(2)], axis=1)
        return cls(corner, _beside(corner))

    @classmethod
    def apart(cls, count: int) -> Self:
        """Lay out patches that have nothing to do with one another."""
        corner = np.repeat(3 * np.arange(count)[:, None], 2, axis=1)
        return cls(corner, np.zeros((count, 4), bool))

    def place(self, patch: IntArray, uv: FloatArray) -> FloatArray:
        """Give the places (n, 2) of points, by their patches (n,) and parameters (n, 2) there."""
        return np.asarray(self.corner[patch] + uv)

    def squares(self) -> FloatArray:
        """Give the sides (k, 4, 2, 2) of patches, walked with them on the left."""
        corners = self.corner[:, None, :] + np.array(
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        )
        return np.stack([corners, np.roll(corners, -1, axis=1)], axis=2)

    def patch_at(self, places: FloatArray) -> IntArray:
        """Give a patch that has each of some places (n, 2) in it or on its border."""
        codes = _codes(self.corner, self.corner)
        order = np.argsort(codes)
        floor = np.floor(places)
        beside = floor[:, None, :] - _CORNERS * (places == floor)[:, None, :]
        wanted = _codes(self.corner, beside)
        at = np.minimum(np.searchsorted(codes[order], wanted), max(len(order) - 1, 0))
        found = order[at]
        hit = (codes[found] == wanted).argmax(axis=1)
        return np.asarray(found[np.arange(len(places)), hit])

    def on_surface(self, box: FloatArray, places: FloatArray) -> FloatArray:
        """Give the parameters (n, 2) on their surfaces of places, by the boxes of all patches."""
        found = np.empty_like(places)
        for axis in range(2):
            ends = self.corner[:, axis, None] + [0, 1]
            at, first = np.unique(ends, return_index=True)
            found[:, axis] = np.interp(places[:, axis], at, box[:, axis].reshape(-1)[first])
        return found

    def borders(self, places: FloatArray) -> IntArray:
        """Tell where places (n, 2) lie: 0 on a border of a surface, 1 between patches, else -1."""
        floor = np.floor(places)
        on = places == floor
        beside = floor[:, None, :] - _CORNERS * on[:, None, :]
        outer = ~np.isin(_codes(self.corner, beside), _codes(self.corner, self.corner)).all(axis=1)
        return np.where(on.any(axis=1), np.where(outer, 0, 1), -1)

    def sides(self, uv: FloatArray) -> NDArray[np.bool_]:
        """Tell which sides of their patch points (n, 2) lie on, to the last bit, (n, 4)."""
        return np.stack([uv[:, axis] == value for axis, value in SIDES], axis=1)


def _positions(surface: IntArray, span: FloatArray) -> IntArray:
    """Give numbers to spans (k, 2): those that meet differ by one, others by more."""
    keys = np.stack([surface.astype(np.float64), span[:, 0]])
    distinct, first, which = np.unique(keys, axis=1, return_index=True, return_inverse=True)
    last = span[first, 1]
    meets = (distinct[0, 1:] == distinct[0, :-1]) & (distinct[1, 1:] == last[:-1])
    numbers = np.concatenate([[0], np.cumsum(np.where(meets, 1, 3))])
    return np.asarray(numbers[which.reshape(-1)], np.intp)


def _codes(corner: IntArray, places: FloatArray | IntArray) -> FloatArray | IntArray:
    """Give one number for each place (..., 2) in whole numbers, those of `corner` and beside."""
    width = corner[:, 1].max(initial=0) + 3
    return np.asarray((places[..., 0] + 1) * width + places[..., 1] + 1)


def _beside(corner: IntArray) -> NDArray[np.bool_]:
    """Tell whether there is a patch one step away in each of four directions."""
    return np.isin(_codes(corner, corner[:, None, :] + _STEPS), _codes(corner, corner))

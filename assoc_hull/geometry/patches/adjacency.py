"""Which patches lie beside one another on their surfaces, and which boxes of many touch.

The lattice counts in whole numbers, so places on a shared border are equal and not only near.
Boxes are found by trees of their centres, one tree for boxes of about one size.
"""

from __future__ import annotations

from itertools import combinations
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "SIDES",
    "Lattice",
    "box_clusters",
    "connected_labels",
    "touching_pairs",
]

# Each patch becomes a unit square of one plane: the patches of a surface side by side, as they are
# on it, surfaces apart. Points on a shared border have one place there, whichever patch they were
# found on; distances are in parameters of a patch, so that one tolerance serves all.

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


# --------------------------------------------------------------------------------------
# Boxes that touch.


def touching_pairs(low: FloatArray, high: FloatArray, tolerance: float) -> IntArray:
    """Give the pairs (p, 2) of boxes that touch, by their corners (n, 2), or are `tolerance` apart.

    A point is a box of no size.
    """
    centre, size = 0.5 * (low + high), (high - low).max(axis=1, initial=0.0)
    classes = np.frexp(size)[1]
    classes[size == 0.0] = np.iinfo(classes.dtype).min
    groups = [np.flatnonzero(classes == one) for one in np.unique(classes)]
    trees = [cKDTree(centre[rows]) for rows in groups]
    reach = [0.5 * size[rows].max() + tolerance for rows in groups]
    found = [np.zeros((0, 2), np.intp)]
    for rows, tree, half in zip(groups, trees, reach, strict=True):
        found.append(rows[tree.query_pairs(2.0 * half, p=np.inf, output_type="ndarray")])
    for i, j in combinations(range(len(groups)), 2):
        near = trees[i].sparse_distance_matrix(
            trees[j], reach[i] + reach[j], p=np.inf, output_type="ndarray"
        )
        found.append(np.stack([groups[i][near["i"]], groups[j][near["j"]]], axis=1))
    pairs = np.concatenate(found)
    a, b = pairs.T
    meet = (low[a] <= high[b] + tolerance) & (low[b] <= high[a] + tolerance)
    return np.asarray(pairs[meet.all(axis=1)])


def connected_labels(count: int, pairs: IntArray) -> IntArray:
    """Give numbers (count,) to the parts into which pairs (p, 2) connect, by their first ones."""
    ones = np.ones(len(pairs), bool)
    graph = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    labels = connected_components(graph, directed=False)[1]
    _, first, which = np.unique(labels, return_index=True, return_inverse=True)
    return np.asarray(np.argsort(np.argsort(first))[which], np.intp)


def box_clusters(low: FloatArray, high: FloatArray, tolerance: float) -> IntArray:
    """Give numbers to the clusters of boxes (n, 2) that touch."""
    return connected_labels(len(low), touching_pairs(low, high, tolerance))

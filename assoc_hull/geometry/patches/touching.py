"""Which boxes of many touch: by trees of their centres, one for boxes of about one size.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.touching import clusters
>>> low = np.array([[0.0, 0.0], [0.5, 0.5], [2.0, 0.0]])
>>> clusters(low, low + 0.5, 1e-9)
array([0, 0, 1])
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["clusters", "connected", "touching"]


def touching(low: FloatArray, high: FloatArray, tolerance: float) -> IntArray:
    """Give the pairs of boxes that touch.

    Parameters
    ----------
    low, high : (n, 2)
        The corners of each box; a point is a box of no size.
    tolerance : float
        Boxes so far apart still touch.

    Returns
    -------
    (p, 2) int
        Rows of boxes.
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


def connected(count: int, pairs: IntArray) -> IntArray:
    """Give numbers (count,) to the parts into which pairs (p, 2) connect, by their first ones."""
    ones = np.ones(len(pairs), bool)
    graph = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    labels = connected_components(graph, directed=False)[1]
    _, first, which = np.unique(labels, return_index=True, return_inverse=True)
    return np.asarray(np.argsort(np.argsort(first))[which], np.intp)


def clusters(low: FloatArray, high: FloatArray, tolerance: float) -> IntArray:
    """Give numbers to the clusters of boxes (n, 2) that touch."""
    return connected(len(low), touching(low, high, tolerance))

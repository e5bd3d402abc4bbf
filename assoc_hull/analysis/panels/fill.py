"""Panels between the points of neighbouring arcs."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["between", "blended", "grid_panels"]

_LEVEL = 0.25
"""Points of two arcs whose fractions differ by less of a step face one another."""


def between(aft: IntArray, fore: IntArray) -> IntArray:
    """Join two rows of vertices by panels, (p, 4), that face to port if the rows run up.

    Rows of equal length are joined by quadrilaterals, a row and a single vertex by triangles;
    others by quadrilaterals where their points face one another and triangles between.

    Parameters
    ----------
    aft, fore : (m,) and (n,) int
        Vertices, from keel to deck.

    Returns
    -------
    (p, 4) int
        Vertices of each panel; those of a triangle end with the third one twice.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.panels.fill import between
    >>> between(np.array([0, 1]), np.array([2, 3])).tolist()
    [[0, 1, 3, 2]]
    >>> between(np.array([0, 1]), np.array([2])).tolist()
    [[0, 1, 2, 2]]
    """
    m, n = len(aft) - 1, len(fore) - 1
    if m == n:
        return np.stack([aft[:-1], aft[1:], fore[1:], fore[:-1]], axis=1)
    if n == 0:
        return np.stack([aft[:-1], aft[1:], *[np.full(m, fore[0])] * 2], axis=1)
    if m == 0:
        return np.stack([np.full(n, aft[0]), fore[1:], fore[:-1], fore[:-1]], axis=1)
    return _zipped(aft, fore)


def _zipped(aft: IntArray, fore: IntArray) -> IntArray:
    m, n = len(aft) - 1, len(fore) - 1
    near = _LEVEL / max(m, n)
    i = j = 0
    found = []
    while i < m or j < n:
        up, across = (i + 1) / m, (j + 1) / n
        if i < m and j < n and abs(up - across) <= near:
            found.append((aft[i], aft[i + 1], fore[j + 1], fore[j]))
            i, j = i + 1, j + 1
        elif j >= n or (i < m and up < across):
            found.append((aft[i], aft[i + 1], fore[j], fore[j]))
            i += 1
        else:
            found.append((aft[i], fore[j + 1], fore[j], fore[j]))
            j += 1
    return np.array(found, np.int64)


def grid_panels(grid: IntArray) -> IntArray:
    """Make panels of a grid of vertices, (m, n), that face along first times second direction."""
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    return np.stack([a, b, c, d], axis=2).reshape(-1, 4)


def blended(low: FloatArray, right: FloatArray, high: FloatArray, left: FloatArray) -> FloatArray:
    """Fill four sides with a grid of places, (m, n, 3): Coons's bilinear patch.

    `low` and `high` (m, 3) run to the right, `left` and `right` (n, 3) up.
    """
    u = np.linspace(0.0, 1.0, len(low))[:, None, None]
    v = np.linspace(0.0, 1.0, len(left))[None, :, None]
    across = (1.0 - v) * low[:, None] + v * high[:, None]
    along = (1.0 - u) * left[None] + u * right[None]
    corners = (1.0 - v) * ((1.0 - u) * low[0] + u * low[-1]) + v * (
        (1.0 - u) * high[0] + u * high[-1]
    )
    found: FloatArray = across + along - corners
    # The sides themselves, without the rounding of the blend.
    found[:, 0], found[:, -1], found[0], found[-1] = low, high, left, right
    return found

"""Sides of patches as polylines.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.surface.regions.edge_polylines import edge_polyline
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0] = net[:, 1, 1] = 1.0
>>> edge_polyline(Patches.single(net), 0, 1, 0.001)[0]
array([[1., 0.],
       [1., 1.]])
"""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.lattice import SIDES
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.points import points

__all__ = ["edge_polyline"]

_MOST = 1000


def edge_polyline(
    patches: Patches, patch: int, side: int, chord_tol: float
) -> tuple[FloatArray, FloatArray]:
    """Give a polyline along one side of a patch.

    Parameters
    ----------
    patches : Patches
        The patches.
    patch, side : int
        Which; side 0 is u = 0, 1 is u = 1, 2 is v = 0, 3 is v = 1.
    chord_tol : float, m
        How far chords may stray.

    Returns
    -------
    (n, 2), (n, 3)
        Parameters of the surface; points, m.
    """
    axis, value = SIDES[side]
    count = _count(patches.net[patch].take(int(value) * -1, axis), chord_tol)
    uv = np.full((count, 2), float(value))
    uv[:, 1 - axis] = np.linspace(0.0, 1.0, count)
    rows = np.full(count, patch)
    return patches.parameters(rows, uv), points(patches, rows, uv)


def _count(control: FloatArray, chord_tol: float) -> int:
    """Give how many points keep chords of a curve of control points (d + 1, 3) to a tolerance."""
    degree = len(control) - 1
    if degree < 2:
        return 2
    bend = degree * (degree - 1) * np.linalg.norm(np.diff(control, 2, axis=0), axis=1).max()
    return 1 + min(max(math.ceil(math.sqrt(bend / (8.0 * chord_tol))), 1), _MOST)

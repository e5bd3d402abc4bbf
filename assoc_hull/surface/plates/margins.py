"""Patches beside borders of blocks and tangent corners: there curvature is that of the joint.

Across a border two fits were joined: normals agree there, curvature need not. So what lies within
one span of it tells nothing about the hull.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.surface.plates.margins import margins
>>> x, z = np.mgrid[0:3:4j, 0:3:4j]
>>> net = np.stack([x, 0.0 * x, z], axis=-1)
>>> apart = net + np.array([3.0, 0.0, 0.0])
>>> box = np.tile([[0.0, 1.0], [0.0, 1.0]], (2, 1, 1))
>>> margins(Patches(np.stack([net, apart]), box, np.array([0, 1])), ()).tolist()
[True, True]
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.tensor_bernstein import basis
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["margins"]

_TOUCH = 0.01
"""m: sides that come so near one another are a common border; chords of them stray by less."""

_LOOKS = 9
"""Places on a side."""

_AT_ONCE = 1 << 21
"""Distances at a time."""


def margins(
    patches: Patches, singular: Sequence[Sequence[tuple[float, float]]]
) -> NDArray[np.bool_]:
    """Tell which patches lie beside a border of two surfaces, or at a tangent corner.

    Parameters
    ----------
    patches : Patches
        Those of all surfaces.
    singular : sequence of sequences of (float, float)
        Parameters of tangent corners, surface by surface; empty for none.

    Returns
    -------
    (k,) bool
    """
    found = np.zeros(len(patches), np.bool_)
    for number, corners in enumerate(singular):
        for corner in corners:
            inside = (patches.box[..., 0] <= corner) & (corner <= patches.box[..., 1])
            found |= inside.all(axis=1) & (patches.surface == number)
    row, points = _outer_sides(patches)
    for number in np.unique(patches.surface).tolist():
        own = patches.surface[row] == number
        if own.all():
            continue
        near = _near(points[own], points[~own])
        found[row[own][near]] = True
    return found


def _outer_sides(patches: Patches) -> tuple[IntArray, FloatArray]:
    """Give sides of patches on the borders of their surfaces: patch, and places (s, looks, 3)."""
    count = int(patches.surface.max()) + 1
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(low, patches.surface, patches.box[..., 0])
    np.maximum.at(high, patches.surface, patches.box[..., 1])
    net, rows, sides = patches.net, [], []
    polygons = ((net[:, 0], net[:, -1]), (net[:, :, 0], net[:, :, -1]))
    for axis, (first, last) in enumerate(polygons):
        along = basis(first.shape[1] - 1, np.linspace(0.0, 1.0, _LOOKS))
        at_low = patches.box[:, axis, 0] == low[patches.surface, axis]
        at_high = patches.box[:, axis, 1] == high[patches.surface, axis]
        for chosen, polygon in ((at_low, first), (at_high, last)):
            rows.append(np.flatnonzero(chosen))
            sides.append(along @ polygon[chosen])
    return np.concatenate(rows), np.concatenate(sides)


def _near(sides: FloatArray, others: FloatArray) -> NDArray[np.bool_]:
    """Tell of which sides (s, looks, 3) two places or more lie on other sides (t, looks, 3)."""
    start, step = others[:, :-1].reshape(-1, 3), np.diff(others, axis=1).reshape(-1, 3)
    length = np.maximum((step * step).sum(axis=1), 1e-30)
    points = sides.reshape(-1, 3)
    touch = np.zeros(len(points), np.bool_)
    size = max(1, _AT_ONCE // len(start))
    for first in range(0, len(points), size):
        off = points[first : first + size, None] - start
        t = np.clip((off * step).sum(axis=2) / length, 0.0, 1.0)
        far = ((off - t[..., None] * step) ** 2).sum(axis=2)
        touch[first : first + size] = far.min(axis=1) <= _TOUCH**2
    return np.asarray(touch.reshape(sides.shape[:2]).sum(axis=1) >= 2)

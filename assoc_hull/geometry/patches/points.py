"""Points of patches, and how much they stretch the parameter plane, at scattered parameters.

Everything is elementwise in the points, so that the bits of one do not depend on the others.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.geometry.patches.points import points, stretch
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 3.0, 2.0
>>> here = np.array([[0.5, 0.25]])
>>> points(Patches.single(net), np.array([0]), here), stretch(Patches.single(net), [0], here)
(array([[1.5, 0.5, 0. ]]), array([6.]))
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.pointwise import jets
from assoc_hull.geometry.tensor_bernstein import basis

__all__ = ["points", "stretch"]


def points(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Give the points (n, 3), m, at parameters (n, 2) of some patches (n,)."""
    if patches.weight is not None:
        return jets(patches, patch, uv).r
    return _value(patches.net[patch], uv)


def stretch(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Give the area per area of parameters, ``|r_u x r_v|``, m2, at parameters of some patches."""
    if patches.weight is not None:
        return jets(patches, patch, uv).element
    net = patches.net[patch]
    m, n = patches.degrees
    along_u = _value(m * np.diff(net, axis=1), uv) if m else np.zeros((len(net), 3))
    along_v = _value(n * np.diff(net, axis=2), uv) if n else np.zeros((len(net), 3))
    return np.asarray(np.sqrt((np.cross(along_u, along_v) ** 2).sum(axis=-1)))


def _value(net: FloatArray, uv: FloatArray) -> FloatArray:
    """Evaluate nets (n, m + 1, n + 1, 3), each at its own parameters (n, 2)."""
    u, v = basis(net.shape[1] - 1, uv[:, 0]), basis(net.shape[2] - 1, uv[:, 1])
    found = np.zeros((len(net), 3))
    for i in range(net.shape[1]):
        row = np.zeros((len(net), 3))
        for j in range(net.shape[2]):
            row += v[:, j, None] * net[:, i, j]
        found += u[:, i, None] * row
    return found

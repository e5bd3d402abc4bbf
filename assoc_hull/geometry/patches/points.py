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
from assoc_hull.geometry.numeric.tensor_bernstein import basis
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["normals", "points", "stretch"]


def points(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Give the points (n, 3), m, at parameters (n, 2) of some patches (n,)."""
    value = _value(_homogeneous(patches, patch), uv)
    return np.asarray(value[:, :3] / value[:, 3:])


def normals(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Give the vectors ``r_u x r_v`` (n, 3), m2, at parameters (n, 2) of some patches."""
    net = _homogeneous(patches, patch)
    value = _value(net, uv)
    point, weight = value[:, :3] / value[:, 3:], value[:, 3:]
    slopes = []
    for axis, degree in zip((1, 2), patches.degrees, strict=True):
        slope = _value(degree * np.diff(net, axis=axis), uv) if degree else 0.0 * value
        slopes.append((slope[:, :3] - point * slope[:, 3:]) / weight)
    return np.cross(slopes[0], slopes[1])


def stretch(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Give the area per area of parameters, ``|r_u x r_v|``, m2, at parameters of some patches."""
    return np.asarray(np.sqrt((normals(patches, patch, uv) ** 2).sum(axis=-1)))


def _homogeneous(patches: Patches, patch: IntArray) -> FloatArray:
    """Give the nets of some patches times their weights, with the weights: (n, m + 1, n + 1, 4)."""
    net = patches.net[patch]
    weight = np.ones(net.shape[:-1]) if patches.weight is None else patches.weight[patch]
    return np.concatenate([net * weight[..., None], weight[..., None]], axis=-1)


def _value(net: FloatArray, uv: FloatArray) -> FloatArray:
    """Evaluate nets (n, m + 1, n + 1, 4), each at its own parameters (n, 2)."""
    u, v = basis(net.shape[1] - 1, uv[:, 0]), basis(net.shape[2] - 1, uv[:, 1])
    found = np.zeros((len(net), net.shape[-1]))
    for i in range(net.shape[1]):
        row = np.zeros_like(found)
        for j in range(net.shape[2]):
            row += v[:, j, None] * net[:, i, j]
        found += u[:, i, None] * row
    return found

"""How long and how broad a plate is, and the axes that directions on it are told by.

The axes are those of the second moments of area: e1 along the plate, e2 across, to the right of e1
for who looks at the side that r_u x r_v points to, e3 = e1 x e2 away from him. Length and breadth
are what the control points extend along e1 and e2, so never less than what the plate itself does;
or the lengths of its seams where these are known.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.surface.plates.curvature_nodes import curvature_nodes
>>> from assoc_hull.surface.plates.plate_extents import plate_axes, plate_extents
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 6.0, 2.0
>>> axes = plate_axes(curvature_nodes(Patches.single(net)))
>>> axes.round(12) + 0.0
array([[ 1.,  0.,  0.],
       [ 0., -1.,  0.],
       [ 0.,  0., -1.]])
>>> plate_extents(net, axes).round(12).tolist()
[6.0, 2.0]
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plates.curvature_nodes import CurvatureNodes

__all__ = ["plate_axes", "plate_extents", "seam_lengths"]

_LOOKS = 257
"""Places along a seam; its length is off by a few millionths."""


def plate_axes(nodes: CurvatureNodes) -> FloatArray:
    """Give the axes of a plate.

    Parameters
    ----------
    nodes : CurvatureNodes
        Those of all its patches.

    Returns
    -------
    (3, 3)
        e1, e2, e3 as rows, right-handed. Of e1 the component with the largest amount is positive.
    """
    weight = nodes.area.ravel() / nodes.area.sum()
    place = nodes.place.reshape(-1, 3)
    off = place - weight @ place
    _, vectors = np.linalg.eigh((off * weight[:, None]).T @ off)
    e1 = vectors[:, 2] * np.sign(vectors[np.abs(vectors[:, 2]).argmax(), 2])
    e2 = vectors[:, 1]
    e3 = np.cross(e1, e2)
    if e3 @ nodes.normal.sum(axis=(0, 1, 2)) > 0.0:
        e2, e3 = -e2, -e3
    return np.stack([e1, e2, e3])


def plate_extents(net: FloatArray, axes: FloatArray) -> FloatArray:
    """Give what control points (..., 3), m, extend along e1 and e2, (2,), m."""
    return np.asarray(np.ptp(net.reshape(-1, 3) @ axes[:2].T, axis=0))


def seam_lengths(surface: SplineSurface) -> FloatArray:
    """Give the mean lengths of opposite borders of a surface: along u and along v, (2,), m."""
    (u0, u1), (v0, v1) = surface.domain
    u, v = np.linspace(u0, u1, _LOOKS), np.linspace(v0, v1, _LOOKS)
    along_u = surface.at(u[:, None], np.array([v0, v1]))
    along_v = np.swapaxes(surface.at(np.array([[u0], [u1]]), v), 0, 1)
    steps = np.diff(np.stack([along_u, along_v]), axis=1)
    return np.asarray(np.linalg.norm(steps, axis=-1).sum(axis=1).mean(axis=1))

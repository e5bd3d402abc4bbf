"""Volume, its first moments and the area of what a surface encloses below a level.

By the divergence theorem the volume between a surface and the plane y = 0 is the flux of (0, y, 0)
through the surface: caps on which the normal has no y, as a waterplane, a transom or a deck, need
not be there. So an open half of a hull has a volume, without any mesh.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.volume_below import integrate_below
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> net = np.zeros((2, 2, 3))  # a wall at y = 3, 10 m long, 4 m high, its normal to +y
>>> net[1, :, 0], net[..., 1], net[:, 0, 2] = 10.0, 3.0, 4.0
>>> found = integrate_below([SplineSurface.bezier(net)], 1.0)
>>> found.volume, found.moment.tolist(), found.area
(30.0, [150.0, 15.0], 10.0)
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.polynomials import unit_roots
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.patches.bezier_patches import Patches, jets
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["VolumeBelow", "integrate_below"]

_NODES = 6
"""Gauss points each way: exact to the 11th power, which y S_y x of a bicubic has."""

_STRIPS = 3
"""Patches that the level cuts are parted into so many strips, as the cut may bend at a border."""

_MIRRORED = np.array([-1.0, -1.0, -1.0, 1.0])
"""With u and v exchanged the normal points the other way."""


@attrs.frozen(eq=False)
class VolumeBelow:
    """What lies between surfaces and the plane y = 0, below a level.

    Attributes
    ----------
    volume : float, m3
        Its volume; of one side of a hull.
    moment : (2,), m4
        The moments of that volume in x and in z.
    area : float, m2
        The area of the surfaces.
    """

    volume: float
    moment: FloatArray
    area: float

    def __attrs_post_init__(self) -> None:
        freeze(self.moment)


def integrate_below(surfaces: Iterable[SplineSurface], level: float) -> VolumeBelow:
    """Integrate over the part of surfaces that lies below a level.

    Parameters
    ----------
    surfaces : iterable of SplineSurface
        Polynomial surfaces with normals S_u x S_v away from the plane y = 0.
    level : float, m
        The height z.

    Returns
    -------
    VolumeBelow
        Volume, moments and area.
    """
    total = np.zeros(4)
    for each in surfaces:
        patches = each.patches()
        high = patches.net[..., 2].max(axis=(1, 2)) <= level
        cut = ~high & (patches.net[..., 2].min(axis=(1, 2)) < level)
        steep = _rises_along_u(patches)
        total += _whole(patches, np.flatnonzero(high))
        total += _cut(patches, np.flatnonzero(cut & ~steep), level)
        total += _MIRRORED * _cut(_turned(patches), np.flatnonzero(cut & steep), level)
    return VolumeBelow(float(total[0]), total[1:3].copy(), float(total[3]))


def _rises_along_u(patches: Patches) -> NDArray[np.bool_]:
    """Say which patches rise more along u than along v: the level is cut best by such lines."""
    z = patches.net[..., 2]
    along, across = (
        np.abs(z[:, -1] - z[:, 0]).sum(axis=1),
        np.abs(z[:, :, -1] - z[:, :, 0]).sum(axis=1),
    )
    return np.asarray(along * z.shape[1] > across * z.shape[2])


def _turned(patches: Patches) -> Patches:
    """Give patches with u and v exchanged."""
    net, box = np.swapaxes(patches.net, 1, 2), patches.box[:, ::-1]
    return Patches(np.ascontiguousarray(net), np.ascontiguousarray(box), patches.surface)


def _whole(patches: Patches, rows: IntArray) -> FloatArray:
    """Integrate over whole patches."""
    node, weight = gauss(_NODES)
    uv = np.stack(np.meshgrid(node, node, indexing="ij"), axis=-1).reshape(-1, 2)
    both = np.outer(weight, weight).ravel()
    return _summed(
        patches, np.repeat(rows, len(uv)), np.tile(uv, (len(rows), 1)), np.tile(both, len(rows))
    )


def _cut(patches: Patches, rows: IntArray, level: float) -> FloatArray:
    """Integrate over what of patches lies below the level, along lines of constant u."""
    node, weight = gauss(_NODES)
    u = ((np.arange(_STRIPS)[:, None] + node) / _STRIPS).ravel()
    across = np.tile(weight / _STRIPS, _STRIPS)
    row, u = np.repeat(rows, len(u)), np.tile(u, len(rows))
    heights = _lines(patches.net[row, :, :, 2] - level, u)
    edge = np.concatenate(
        [np.zeros((len(u), 1)), unit_roots(_powers(heights)), np.ones((len(u), 1))], 1
    )
    low, length = edge[:, :-1], np.diff(edge, axis=1)
    line, part = np.nonzero((_height(heights, low + 0.5 * length) < 0.0) & (length > 0.0))
    low, length = low[line, part], length[line, part]
    v = low[:, None] + length[:, None] * node
    places = np.stack([np.repeat(u[line], _NODES), v.ravel()], axis=1)
    weights = (np.tile(across, len(rows))[line] * length)[:, None] * weight
    return _summed(patches, np.repeat(row[line], _NODES), places, weights.ravel())


def _lines(heights: FloatArray, u: FloatArray) -> FloatArray:
    """Give Bezier heights (k, n + 1) of the lines u = const of nets (k, m + 1, n + 1)."""
    at = u[:, None, None]
    while heights.shape[1] > 1:
        heights = (1.0 - at) * heights[:, :-1] + at * heights[:, 1:]
    return heights[:, 0]


def _powers(bezier: FloatArray) -> FloatArray:
    """Give the ascending powers, of degree 2 at least, of Bezier polynomials (k, n + 1)."""
    degree = bezier.shape[1] - 1
    found, rows = np.zeros((len(bezier), max(degree, 2) + 1)), bezier
    for power in range(degree + 1):
        found[:, power] = math.comb(degree, power) * rows[:, 0]
        rows = np.diff(rows, axis=1)
    return found


def _height(bezier: FloatArray, v: FloatArray) -> FloatArray:
    """Evaluate Bezier polynomials (k, n + 1) at several places each, (k, p)."""
    rows = np.broadcast_to(bezier[:, None], (*v.shape, bezier.shape[1]))
    while rows.shape[2] > 1:
        rows = (1.0 - v[..., None]) * rows[..., :-1] + v[..., None] * rows[..., 1:]
    return np.asarray(rows[..., 0])


def _summed(patches: Patches, row: IntArray, uv: FloatArray, weight: FloatArray) -> FloatArray:
    """Add up flux, its two moments and area at points with weights."""
    if not len(row):
        return np.zeros(4)
    found = jets(patches, row, uv)
    flux = weight * found.r[:, 1] * found.s[:, 1]
    moments = (flux * found.r[:, 0]).sum(), (flux * found.r[:, 2]).sum()
    return np.array([flux.sum(), *moments, (weight * found.element).sum()])

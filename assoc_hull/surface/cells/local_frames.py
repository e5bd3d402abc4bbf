"""Cells seen along their mean normals: places in a tangent plane, and a height over it.

The height of a smooth surface over a cell of its net is close to a cubic polynomial. What is
filled in between the edges is what they differ from it by, which is next to nothing.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.vectors import dot

__all__ = ["LocalFrames", "local_frames"]

_RIDGE = 1e-4
_NORMALS = 0.5
"""Weight of the slopes at the nodes, beside points on the edges."""
_STEEP = 0.3
"""With a smaller cosine between the normal of a node and the mean no heights are fitted."""
_POWERS = np.array([(i, j) for i in range(4) for j in range(4 - i)])


@attrs.frozen(eq=False)
class LocalFrames:
    """A frame for each of some cells.

    Attributes
    ----------
    origin : (c, 3), m
        In the midst of each cell.
    axes : (c, 3, 3), 1/m
        Rows: two across the mean normal, and that normal, by the size of the cell.
    height : (c, 10)
        The cubic polynomial of the height; nil where the cell is bent too much.
    """

    origin: FloatArray
    axes: FloatArray
    height: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.origin, self.axes, self.height)

    def flattened(self, place: FloatArray) -> FloatArray:
        """Give two places across and what is left of the height, (c, k, 3), of points (c, k, 3)."""
        found = _seen(self.origin, self.axes, place)
        found[..., 2] -= _value(self.height, found[..., :2])
        return found

    def restored(self, flat: FloatArray) -> FloatArray:
        """Give the points, (c, k, 3), m, from what `flattened` gives."""
        flat = flat.copy()
        flat[..., 2] += _value(self.height, flat[..., :2])
        # The rows of the axes are at right angles and of one length.
        size = dot(self.axes[:, 0], self.axes[:, 0])[:, None, None]
        found = self.origin[:, None] + np.einsum("ckj,cji->cki", flat, self.axes) / size
        return np.asarray(found)


def local_frames(rim: FloatArray, corner: FloatArray, normal: FloatArray) -> LocalFrames:
    """Lay a frame over each of some cells with equally many corners.

    Parameters
    ----------
    rim : (c, r, 3), m
        Points on the edges.
    corner : (c, k, 3), m
        The corners.
    normal : (c, k, 3)
        Unit normals of the hull there.

    Returns
    -------
    LocalFrames
        With heights fitted to the points, and to the slopes that the normals have.
    """
    mean = normal.sum(axis=1)
    size = np.sqrt(dot(mean, mean))
    up = np.where(size[:, None] > 1e-6, mean / np.maximum(size, 1e-6)[:, None], [0.0, 0.0, 1.0])
    least = np.abs(up).argmin(axis=1)
    across = np.cross(np.eye(3)[least], up)
    across /= np.sqrt(dot(across, across))[:, None]
    origin = rim.mean(axis=1)
    away = rim - origin[:, None]
    reach = np.maximum(np.sqrt(dot(away, away)).max(axis=1), 1e-12)
    unit = np.stack([across, np.cross(up, across), up], axis=1)
    axes = unit / reach[:, None, None]
    tilted = np.einsum("cki,cji->ckj", normal, unit)
    good = (size > 1e-6) & (tilted[..., 2] >= _STEEP).all(axis=1)
    height = np.zeros((len(rim), len(_POWERS)))
    height[good] = _fitted(
        _seen(origin, axes, rim)[good], _seen(origin, axes, corner)[good], tilted[good]
    )
    return LocalFrames(origin, axes, height)


def _seen(origin: FloatArray, axes: FloatArray, place: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("cki,cji->ckj", place - origin[:, None], axes))


def _terms(ab: FloatArray) -> FloatArray:
    """Give the ten terms, (c, k, 10), at places (c, k, 2)."""
    power = ab[..., None, :] ** np.arange(4)[:, None]
    return np.asarray(power[..., _POWERS[:, 0], 0] * power[..., _POWERS[:, 1], 1])


def _value(height: FloatArray, ab: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("ckt,ct->ck", _terms(ab), height))


def _slopes(ab: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the derivatives of the terms in both directions, (c, k, 10) each."""
    power = ab[..., None, :] ** np.arange(4)[:, None]
    rate = np.zeros_like(power)
    rate[..., 1:, :] = power[..., :-1, :] * np.arange(1, 4)[:, None]
    i, j = _POWERS.T
    return rate[..., i, 0] * power[..., j, 1], power[..., i, 0] * rate[..., j, 1]


def _fitted(rim: FloatArray, corner: FloatArray, normal: FloatArray) -> FloatArray:
    """Fit heights, (c, 10)."""
    along, up = _slopes(corner[..., :2])
    row = np.concatenate([_terms(rim[..., :2]), _NORMALS * along, _NORMALS * up], axis=1)
    slope = -normal[..., :2] / normal[..., 2:]
    wanted = np.concatenate(
        [rim[..., 2], _NORMALS * slope[..., 0], _NORMALS * slope[..., 1]], axis=1
    )
    normal_matrix = np.einsum("crs,crt->cst", row, row) + _RIDGE * np.eye(row.shape[2])
    return np.asarray(
        np.linalg.solve(normal_matrix, np.einsum("crs,cr->cs", row, wanted)[..., None])[..., 0]
    )

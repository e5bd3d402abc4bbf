"""Surfaces that rational patches are without error: arcs turned about an axis."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray


def arc(start: float, end: float) -> tuple[FloatArray, FloatArray]:
    """A part of the unit circle between two angles less than half a turn apart: (3, 2) and (3,)."""
    half = (end - start) / 2.0
    angles = np.array([start, start + half, end])
    points = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    points[1] /= np.cos(half)
    return points, np.array([1.0, np.cos(half), 1.0])


def revolved(
    points: FloatArray, weights: FloatArray, start: float, end: float
) -> tuple[FloatArray, FloatArray]:
    """A curve of (radius, height) turned about the z axis: a net (3, k, 3) and weights (3, k)."""
    circle, turned = arc(start, end)
    net = np.empty((3, len(points), 3))
    net[..., :2] = circle[:, None] * points[None, :, :1]
    net[..., 2] = points[:, 1]
    return net, np.outer(turned, weights)

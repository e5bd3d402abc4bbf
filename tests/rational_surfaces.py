"""Surfaces that rational patches are without error: arcs turned about an axis."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface


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


def circle() -> tuple[FloatArray, FloatArray, FloatArray]:
    """The unit circle as a rational quadratic spline: points (9, 2), weights (9,), knots (12,)."""
    points = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    weights = np.where(np.arange(9) % 2, np.sqrt(0.5), 1.0)
    knots = np.array([0.0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4])
    return np.array(points, np.float64), weights, knots


def turned(
    points: FloatArray, weights: FloatArray, knots: FloatArray, degree: int, name: str
) -> SplineSurface:
    """A spline curve of (radius, height) turned once about the z axis."""
    round_, round_weights, round_knots = circle()
    net = np.empty((9, len(points), 3))
    net[..., :2] = round_[:, None] * points[None, :, :1]
    net[..., 2] = points[:, 1]
    weight = np.outer(round_weights, weights)
    return SplineSurface(name, (2, degree), round_knots, knots, net, weight)

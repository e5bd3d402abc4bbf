"""The wetted surface by triangles: what of a dense grid of points lies below a draught."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["area_below", "triangles_below"]


def area_below(grid: FloatArray, level: float) -> float:
    """Area (m2) below z = level of the triangles on a grid of points (n, m, 3), m."""
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    return sum(
        triangles_below(np.stack(corners, axis=-2).reshape(-1, 3, 3), level)
        for corners in ((a, b, c), (a, c, d))
    )


def triangles_below(corner: FloatArray, level: float, heel_deg: float = 0.0) -> float:
    """Area (m2) of triangles (k, 3, 3), m, below z = level - y tan(heel)."""
    area = 0.5 * np.linalg.norm(
        np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1
    )
    over = corner[:, :, 2] + np.tan(np.radians(heel_deg)) * corner[:, :, 1] - level
    low, middle, high = np.sort(over, axis=1).T
    with np.errstate(divide="ignore", invalid="ignore"):
        # Two corners above: what is wet is similar to the whole, about the lowest; one: the rest.
        tip = low * low / ((middle - low) * (high - low))
        rest = 1.0 - high * high / ((high - low) * (high - middle))
    wet = np.where(high <= 0.0, 1.0, np.where(middle <= 0.0, rest, np.where(low < 0.0, tip, 0.0)))
    return float((area * wet).sum())

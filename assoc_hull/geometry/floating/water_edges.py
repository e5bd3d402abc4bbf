"""Straight pieces of the edges of waterplanes: areas, moments and extents from them."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["WaterEdges", "edge_extents", "edge_moments", "joined"]


@attrs.frozen(eq=False)
class WaterEdges:
    """Straight pieces of the edge of waterplanes.

    Attributes
    ----------
    plane : (k,) int
        The plane of each; ascending for `edge_extents`.
    ends : (k, 2, 3), m
        Begin and end, the waterplane to the left.
    """

    plane: IntArray
    ends: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.plane, self.ends)


def edge_moments(cuts: WaterEdges, count: int) -> tuple[FloatArray, ...]:
    """Give area, first and second moments of waterplanes by Green's theorem, (count,) each."""
    (x, y), (to_x, to_y) = cuts.ends[:, 0, :2].T, cuts.ends[:, 1, :2].T
    swept = 0.5 * (x * to_y - y * to_x)
    columns = [
        swept,
        swept * (x + to_x) / 3.0,
        swept * (y + to_y) / 3.0,
        swept * (x * x + x * to_x + to_x * to_x) / 6.0,
        swept * (2.0 * (x * y + to_x * to_y) + x * to_y + to_x * y) / 12.0,
        swept * (y * y + y * to_y + to_y * to_y) / 6.0,
    ]
    return tuple(np.asarray(np.bincount(cuts.plane, each, count), np.float64) for each in columns)


def edge_extents(cuts: WaterEdges, count: int) -> tuple[FloatArray, ...]:
    """Give the least and most x, then y, of waterplanes; nan where there is none."""
    found = np.full((count, 4), np.nan)
    if len(cuts.plane):
        first = np.flatnonzero(np.append(True, np.diff(cuts.plane) != 0))
        low = np.minimum.reduceat(cuts.ends.min(axis=1), first)
        high = np.maximum.reduceat(cuts.ends.max(axis=1), first)
        rows = np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1)
        found[cuts.plane[first]] = rows
    return tuple(column.copy() for column in found.T)


def joined(one: WaterEdges, other: WaterEdges) -> WaterEdges:
    """Give the pieces of both, sorted by plane; those given need not be."""
    plane = np.concatenate([one.plane, other.plane])
    order = np.argsort(plane, kind="stable")
    return WaterEdges(plane[order], np.concatenate([one.ends, other.ends])[order])

"""Putting a point among those that define a curve."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.make import Maker

__all__ = ["interval_of", "thread"]


def interval_of(xyz: FloatArray, place: FloatArray) -> int:
    """Give the index before which a place belongs: the least detour from neighbour to neighbour.

    Parameters
    ----------
    xyz : (n, 3), m
        The points of a curve, in order.
    place : (3,), m
        The new point.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.thread import interval_of
    >>> interval_of(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0]]), np.array([1.0, 0.5, 0]))
    2
    """
    to = np.sqrt(((xyz - place) ** 2).sum(axis=1))
    step = np.sqrt((np.diff(xyz, axis=0) ** 2).sum(axis=1))
    return int((to[:-1] + to[1:] - step).argmin()) + 1


def thread(maker: Maker, curve: int, row: int) -> None:
    """Let a point define a curve, between the two points it lies between."""
    rows: IntArray = maker.state.curves.rows.data[curve]
    place = maker.state.rows.xyz.data[row]
    index = interval_of(maker.state.rows.xyz.data[rows], place)
    maker.define(curve, np.insert(rows, index, row))

"""Putting a point among those that define a curve."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.make_objects import Maker

__all__ = ["detour", "interval_of", "thread"]


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
    >>> from assoc_hull.edit.followup.thread import interval_of
    >>> interval_of(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0]]), np.array([1.0, 0.5, 0]))
    2
    """
    return int(_detours(xyz, place).argmin()) + 1


def detour(xyz: FloatArray, place: FloatArray) -> float:
    """Give the least detour (m) through a place, from one point of a curve (n, 3) to the next."""
    return float(_detours(xyz, place).min())


def _detours(xyz: FloatArray, place: FloatArray) -> FloatArray:
    to = np.sqrt(((xyz - place) ** 2).sum(axis=1))
    step = np.sqrt((np.diff(xyz, axis=0) ** 2).sum(axis=1))
    found: FloatArray = to[:-1] + to[1:] - step
    return found


def thread(maker: Maker, curve: int, row: int) -> None:
    """Let a point define a curve, between the two points it lies between."""
    rows: IntArray = maker.state.curves.rows.data[curve]
    place = maker.state.rows.xyz.data[row]
    index = interval_of(maker.state.rows.xyz.data[rows], place)
    maker.define(curve, np.insert(rows, index, row))

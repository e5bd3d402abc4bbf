"""What an edit of several passes changed in the end: a point may go away and come back."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.graph.journal import Journal
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.network import bits_differ
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["net_difference", "points_elsewhere"]


def net_difference(
    elsewhere: tuple[IntArray, FloatArray],
    before: Mapping[int, SplineBatch],
    spline: Callable[[int], SplineBatch],
    nodes: IntArray,
    moved: FloatArray,
) -> tuple[IntArray, FloatArray]:
    """Keep the nodes that differ by a bit from what they were before the edit.

    Parameters
    ----------
    elsewhere : (k,) int, (k,) float, m
        What `points_elsewhere` gives.
    before : mapping of int to SplineBatch
        The splines of the curves before the edit; a new curve has none.
    spline : callable
        Gives that of a curve after it.
    nodes, moved : (k,) int, (k,) float
        Nodes that changed in any pass, and by how much; a node may stand more than once.

    Returns
    -------
    nodes, moved : (n,) int, (n,) float, m
        Each node once, points first; nan where the edit itself set the point.
    """
    odd = Node.is_curve(nodes)
    rows, away = elsewhere
    away = np.where(np.isin(Node.point(rows), nodes), away, np.nan)
    curves = [
        curve
        for curve in np.unique(Node.number(nodes[odd])).tolist()
        if curve not in before or not _same(before[curve], spline(curve))
    ]
    widest = np.array([np.max(moved[nodes == Node.curve(curve)]) for curve in curves], np.float64)
    numbers = np.array(curves, np.int64)
    return np.concatenate([Node.point(rows), Node.curve(numbers)]), np.concatenate([away, widest])


def points_elsewhere(state: HullState, journal: Journal) -> tuple[IntArray, FloatArray]:
    """Give the points that lie elsewhere than before an edit, and how far.

    Points that the edit made are left out, and watched ones, which have no value.
    """
    table = state.rows
    rows, old = journal.before(table.xyz)
    marked, was_alive = journal.before(table.alive)
    watched = (table.sort[rows] == Sort.CROSSING) & (table.role[rows] == Role.WATCHED)
    differs = table.alive[rows] & ~watched & bits_differ(old, table.xyz[rows])
    differs &= ~np.isin(rows, marked[~was_alive.astype(bool)])
    step = table.xyz[rows[differs]] - old[differs]
    return rows[differs], np.sqrt((step * step).sum(axis=1))


def _same(one: SplineBatch, other: SplineBatch) -> bool:
    return all(
        np.array_equal(getattr(one, name), getattr(other, name))
        for name in ("knot", "xyz", "leave", "arrive")
    )

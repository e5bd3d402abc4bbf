"""What an edit of several passes changed in the end: a point may go away and come back."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.graph.journal import Journal
from assoc_hull.model.network import bits_differ
from assoc_hull.model.state import HullState, curve_node, row_node

__all__ = ["net_change"]


def net_change(
    state: HullState,
    journal: Journal,
    before: dict[int, SplineBatch],
    nodes: IntArray,
    moved: FloatArray,
) -> tuple[IntArray, FloatArray]:
    """Keep the nodes that differ by a bit from what they were before the edit.

    Parameters
    ----------
    state : HullState
        The tables after the edit.
    journal : Journal
        All writes of the edit.
    before : dict of int to SplineBatch
        The splines of the curves before the edit; a new curve has none.
    nodes, moved : (k,) int, (k,) float
        Nodes that changed in any pass, and by how much; a node may stand more than once.

    Returns
    -------
    nodes, moved : (n,) int, (n,) float, m
        Each node once, points first. Points that the edit made are left out.
    """
    odd = (nodes & 1).astype(bool)
    rows, away = _points(state, journal, np.unique(nodes[~odd]) >> 1)
    curves = [
        curve
        for curve in np.unique(nodes[odd] >> 1).tolist()
        if curve not in before or not _same(before[curve], state.spline(curve))
    ]
    widest = np.array([np.max(moved[nodes == 2 * curve + 1]) for curve in curves], np.float64)
    numbers = np.array(curves, np.int64)
    return np.concatenate([row_node(rows), curve_node(numbers)]), np.concatenate([away, widest])


def _points(state: HullState, journal: Journal, rows: IntArray) -> tuple[IntArray, FloatArray]:
    """Give the points that lie elsewhere than before, and how far."""
    written, old = journal.before(state.rows.xyz)
    marked, was_alive = journal.before(state.rows.alive)
    made = marked[~was_alive.astype(bool)]
    rows = rows[np.isin(rows, written) & ~np.isin(rows, made)]
    place = old[np.searchsorted(written, rows)]
    now = state.rows.xyz.data[rows]
    differs = bits_differ(place, now)
    step = now[differs] - place[differs]
    return rows[differs], np.sqrt((step * step).sum(axis=1))


def _same(one: SplineBatch, other: SplineBatch) -> bool:
    return all(
        np.array_equal(getattr(one, name), getattr(other, name))
        for name in ("knot", "xyz", "leave", "arrive")
    )

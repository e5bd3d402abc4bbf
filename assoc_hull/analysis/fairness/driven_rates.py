"""How far points that are computed from curves go when the points move that define the curves.

The rates are those of the loft itself. A curve hardly feels a point that is six points away, so
twelve moves, each of every twelfth point of all curves at once, give them all.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csr_array

from assoc_hull.analysis.derivatives.driven_points import DrivenPoints
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.loft_tangents import loft_tangents
from assoc_hull.geometry.splines.segments import segment_start
from assoc_hull.model.lofting import curve_data
from assoc_hull.model.tables import HullState

__all__ = ["driven_rates", "follow"]

_BESIDE = 6
"""So many points of its curve on either side move a computed point."""

_DEEPEST = 32
"""Computed points of computed points of ... so often; a net has four or five."""


def driven_rates(
    state: HullState, curves: IntArray, batch: SplineBatch, normals: FloatArray,
    moves: FloatArray, least: float,
) -> csr_array:  # fmt: skip
    """Give how much each computed or riding point moves with each point beside it, (rows, rows).

    Parameters
    ----------
    state : HullState
        The tables.
    curves, batch, normals : (m,) int, SplineBatch, (m, 3)
        All curves, their shapes, and the normals of their planes, nan where there is none.
    moves : (rows, 3)
        Where a unit displacement leads each point; zero for those that stay.
    least : float
        Smaller rates are left out.
    """
    size = len(moves)
    square = (moves * moves).sum(axis=1)
    back = moves / np.where(square > 0.0, square, 1.0)[:, None]
    parts = [_computed(state, curves, batch, normals, moves, back), _riding(state, moves, back)]
    row, column, rate = (np.concatenate(each) for each in zip(*parts, strict=True))
    some = np.abs(rate) > least
    return csr_array(coo_array((rate[some], (row[some], column[some])), shape=(size, size)))


_Entries = tuple[IntArray, IntArray, FloatArray]


def _computed(
    state: HullState, curves: IntArray, batch: SplineBatch, normals: FloatArray,
    moves: FloatArray, back: FloatArray,
) -> _Entries:  # fmt: skip
    """Give rates of crossings that a curve carries, with the points that define the curve."""
    driven = DrivenPoints.among(state, curves, batch, normals)
    if not len(driven.row):
        return _nothing()
    data = curve_data(state, curves)
    row = np.concatenate([state.curves.rows.data[each] for each in curves.tolist()])
    local = np.arange(len(row)) - np.repeat(data.start[:-1], np.diff(data.start))
    colours = 2 * _BESIDE
    turns = np.zeros((colours, len(row), 3))
    turns[local % colours, np.arange(len(row))] = moves[row]
    gone = driven.moves(loft_tangents(data, turns).batch())
    away = (gone * back[driven.row]).sum(axis=2)
    knot = segment_start(batch)[driven.segment]
    owner = np.searchsorted(batch.start, knot, side="right") - 1
    near = knot[:, None] + np.arange(1 - _BESIDE, _BESIDE + 1)
    here = (near >= batch.start[owner][:, None]) & (near < batch.start[owner + 1][:, None])
    near = np.where(here, near, knot[:, None])
    rate = np.where(here, away[local[near] % colours, np.arange(len(knot))[:, None]], 0.0)
    return np.repeat(driven.row, colours), row[near].ravel(), rate.ravel()


def _riding(state: HullState, moves: FloatArray, back: FloatArray) -> _Entries:
    """Give rates of adopted points that ride with those beside them."""
    table = state.rows
    anchor = table.anchor.data
    row = np.flatnonzero(table.alive.data & (anchor >= 0).any(axis=1))
    if not len(row):
        return _nothing()
    pair, weight = anchor[row], table.anchor_weight[row]
    share = np.stack([1.0 - weight, weight], axis=1)
    along = (moves[pair] * back[row][:, None]).sum(axis=2)
    rate = np.where(pair >= 0, share * along, 0.0)
    return np.repeat(row, 2), np.maximum(pair, 0).ravel(), rate.ravel()


def _nothing() -> _Entries:
    none = np.zeros(0, np.int64)
    return none, none, np.zeros(0)


def follow(rates: csr_array, rows: IntArray) -> csr_array:
    """Give how far all points go with points (k,) that are moved, (rows, k), each by its own."""
    size = rates.shape[0]
    own = csr_array(
        coo_array((np.ones(len(rows)), (rows, np.arange(len(rows)))), shape=(size, len(rows)))
    )
    stays = np.ones(size)
    stays[rows] = 0.0
    rates = csr_array(rates.multiply(stays[:, None]))
    found = own
    for _ in range(_DEEPEST):
        before, found = found, csr_array(own + rates @ found)
        if found.nnz == before.nnz and not (found - before).count_nonzero():
            break
    return found

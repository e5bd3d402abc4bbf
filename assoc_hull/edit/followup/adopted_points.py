"""Adopted points ride: when a driven neighbour moves, the shape between goes along.

An adopted point holds a shape that crossings alone cannot. Its place is its base plus a
linear blend of the displacements of its nearest driven neighbours since they were last
linked; so there and back is exact. A generated point does not ride, and none that was one:
definitions place it, or a designer did.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.generated import kept_rows
from assoc_hull.model.kinds import Sort
from assoc_hull.model.state import HullState

__all__ = ["rebase", "ride_links"]


def ride_links(state: HullState, curves: IntArray, journal: Journal) -> None:
    """Link the adopted points of curves to their driven neighbours as these lie now."""
    for curve in curves.tolist():
        rows: IntArray = state.curves.rows.data[curve]
        rides = state.rows.sort.data[rows] == Sort.ADOPTED
        rides &= ~np.isin(rows, kept_rows(state))
        adopted, others = np.flatnonzero(rides), np.flatnonzero(~rides)
        if not len(adopted):
            continue
        if not len(others):
            journal.put(state.rows.anchor, rows[adopted], -1)
            continue
        after = np.searchsorted(others, adopted)
        pair = np.column_stack(
            [
                np.where(after > 0, others[np.maximum(after - 1, 0)], -1),
                np.where(after < len(others), others[np.minimum(after, len(others) - 1)], -1),
            ]
        )
        anchor = np.where(pair >= 0, rows[np.maximum(pair, 0)], -1)
        driven = (anchor >= 0) & (state.rows.driver.data[anchor] >= 0)
        anchor = np.where(driven, anchor, -1)
        journal.put(state.rows.anchor, rows[adopted], anchor)
        journal.put(state.rows.anchor_weight, rows[adopted], _weights(state, rows, adopted, pair))
        rebase(state, rows[adopted], journal)


def _weights(
    state: HullState, rows: IntArray, adopted: IntArray, pair: IntArray
) -> np.typing.NDArray[np.float64]:
    """Give the part of the way from the first to the second neighbour, by chords."""
    step = np.diff(state.rows.xyz.data[rows], axis=0)
    chord = np.concatenate([[0.0], np.cumsum(np.sqrt((step * step).sum(axis=1)))])
    low, high = chord[np.maximum(pair[:, 0], 0)], chord[np.maximum(pair[:, 1], 0)]
    whole = np.where(high > low, high - low, 1.0)
    weight = np.where(
        pair[:, 0] < 0, 1.0, np.where(pair[:, 1] < 0, 0.0, (chord[adopted] - low) / whole)
    )
    return np.asarray(weight, np.float64)


def rebase(state: HullState, rows: IntArray, journal: Journal) -> None:
    """Take the present places of adopted points and of their neighbours as the base."""
    if not len(rows):
        return
    anchor = state.rows.anchor.data[rows]
    at = np.where((anchor >= 0)[:, :, None], state.rows.xyz.data[anchor], 0.0)
    journal.put(state.rows.base, rows, state.rows.xyz.data[rows])
    journal.put(state.rows.anchor_from, rows, at)

"""How directions that are given at points and ends turn with a map, to first order."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.edit.mapped_planes import flat_borders
from assoc_hull.geometry.curves import EndKind, FloatArray, IntArray
from assoc_hull.model.tables import Ends, HullState
from assoc_hull.variation.carrying.hull_maps import LaidMap
from assoc_hull.variation.carrying.slide_rates import SlideSurface

__all__ = ["turn_rates"]

_ALIKE = 1e-3
"""Directions at one point that differ by no more (of their size) turn alike."""


def turn_rates(
    state: HullState,
    ground: SlideSurface,
    here: LaidMap,
    pair: Sequence[LaidMap],
    source: FloatArray,
    span: float,
) -> FloatArray:
    """Give how given directions turn with one amplitude.

    Parameters
    ----------
    state : HullState
        The tables of the carried hull.
    ground : SlideSurface
        Planes that directions stay in.
    here : LaidMap
        The map by which the hull was carried.
    pair : sequence of LaidMap
        Maps on both sides of it.
    source : (rows, 3), m
        Where points come from.
    span : float
        How far the pair is apart in the amplitude.

    Returns
    -------
    (rows, 3, 3)
        A direction t at a point changes by turn t per unit: its length stays, and it stays in
        the plane of its line, and in the flat that this borders.
    """
    found, given = np.zeros((state.rows.count, 3, 3)), _given(state)
    rows = np.array(sorted(given), np.int64)
    if not len(rows):
        return found
    slopes = [each.map.jacobian(source[rows]) for each in pair]
    rate = (slopes[0] - slopes[1]) / span @ np.linalg.inv(here.map.jacobian(source[rows]))
    flats = flat_borders(state, pair[0].planes)
    moving = rate.any(axis=(1, 2))
    for row, each in zip(rows[moving].tolist(), rate[moving], strict=True):
        new = [_turned(ground, flats, row, one, each) for one in given[row]]
        old = np.array([vector for _, vector in given[row]])
        found[row] = np.array(new).T @ np.linalg.pinv(old.T, rcond=_ALIKE)
    return found


def _turned(
    ground: SlideSurface, flats: IntArray, row: int, given: tuple[int, FloatArray], rate: FloatArray
) -> FloatArray:
    """Give how one direction changes: across itself, in its plane and in the flat it borders."""
    side, vector = given
    new: FloatArray = rate @ vector
    new = new - vector * ((vector * new).sum() / (vector * vector).sum())
    own, other = ground.plane[row, side], ground.plane[row, 1 - side]
    new = new - own * (own * new).sum()
    if ground.line[row, 1 - side] in flats:
        new = new - other * (other * new).sum()
    return new


def _given(state: HullState) -> dict[int, list[tuple[int, FloatArray]]]:
    """Give the directions that are given at points and ends of curves, each with its side."""
    table, found = state.rows, dict[int, list[tuple[int, FloatArray]]]()
    for side in (0, 1):
        there = table.alive.data & table.direction[:, side].any(axis=1)
        for row in np.flatnonzero(there).tolist():
            found.setdefault(row, []).append((side, table.direction[row, side]))
    for curve in state.live("curves").tolist():
        ends: Ends = state.curves.ends[curve]
        for at in (0, 1):
            if ends.kind[at] == EndKind.TANGENT:
                row = int(state.curves.rows[curve][-at])
                side = int(table.curve[row, 0] != curve)
                found.setdefault(row, []).append((side, np.array(ends.vector[at])))
    return found

"""Fields of displacement carried out: in sub-steps where they are large, each with one update."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from assoc_hull.edit.displacement_field import (
    CLOSE,
    FieldContext,
    NormalField,
    add_displacements,
    land_points,
    sub_step_count,
)
from assoc_hull.edit.followup.adopted_points import rebase_adopted_points
from assoc_hull.edit.pending_changes import Pending
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Sort
from assoc_hull.model.network import bits_differ
from assoc_hull.model.tables import HullState

__all__ = ["run_fields"]

_MORE = 4
"""Sub-steps a field may have in addition."""


def run_fields(
    state: HullState,
    journal: Journal,
    pending: Pending,
    rows: IntArray,
    origin: FloatArray,
    update: Callable[[IntArray], bool],
    detach: Callable[[IntArray], None] | None = None,
) -> tuple[IntArray, FloatArray] | None:
    """Run the fields of an edit; give all points that were set, and how far they are away.

    Parameters
    ----------
    state, journal, pending : HullState, Journal, Pending
        What is edited, and how. Its `held` become the adopted points that were carried; they ride
        from where they are then.
    rows : (k,) int
        Points that the edit has set by itself.
    origin : (n, 3), m
        Where all points lay before the edit.
    update : callable
        Brings all up to date with points that were set. Where it gives False, nothing more is done,
        and None is given.
    detach : callable or None
        Called with the points of a sub-step before they are written.
    """
    fields, held = pending.fields, pending.held
    across = any(field.across_flats for field in fields)
    pinned, touched = set(pending.values), set(rows.tolist())
    ground = FieldContext(state, across)
    shift = add_displacements([field.shift(ground, 1.0) for field in fields], pinned)
    steps, whole = sub_step_count(state, shift), shift
    landing = np.concatenate([field.exact()[0] for field in fields])
    for step in range(steps + _MORE):
        part = _part(state, fields, step, steps)
        if part == 0.0:
            break
        if step:
            ground = FieldContext(state, across)
        shift = whole
        if step or part != 1.0:
            shift = add_displacements([field.shift(ground, part) for field in fields], pinned)
        reached = np.union1d(shift.rows, landing)
        before = state.rows.xyz[reached]
        if detach is not None:
            detach(shift.rows)
        journal.put(state.rows.xyz, shift.rows, state.rows.xyz[shift.rows] + shift.delta)
        if step == steps - 1:
            land_points(state, journal, fields)
        shifted = reached[bits_differ(before, state.rows.xyz[reached])]
        held |= set(shifted[state.rows.sort[shifted] == Sort.ADOPTED].tolist())
        touched |= set(shifted.tolist())
        if not update(np.union1d(shifted, rows) if step == 0 else shifted):
            return None
    pending.notes += [
        f"{address(state, row)}: left alone, it is free almost along the hull only"
        for row in shift.left.tolist()
    ]
    rebase_adopted_points(state, np.array(sorted(held), np.int64), journal)
    every = np.array(sorted(touched), np.int64)
    every = every[every < len(origin)]
    every = every[bits_differ(state.rows.xyz[every], origin[every])]
    moved = state.rows.xyz[every] - origin[every]
    return every, np.sqrt((moved * moved).sum(axis=1))


def _part(state: HullState, fields: list[NormalField], step: int, steps: int) -> float:
    """Give the part of the fields to run in a sub-step; nil when they are where they should be.

    A field that knows what it lacks spreads that over the sub-steps left, and has a few more.
    """
    done = min(step, steps) / steps
    left = fields[0].left(state, done) if len(fields) == 1 else 1.0 - done
    if step >= steps and abs(left) <= CLOSE:
        return 0.0
    return float(np.clip(left / max(steps - step, 1), -1.0 / steps, 1.0 / steps))

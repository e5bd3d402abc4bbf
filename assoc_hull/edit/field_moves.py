"""Fields of displacement: carried out together, in sub-steps where they are large."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import rebase_adopted_points
from assoc_hull.edit.displacement_field import (
    CLOSE,
    FieldContext,
    NormalField,
    add_displacements,
    land_points,
    sub_step_count,
    unreached,
)
from assoc_hull.edit.followup.detach_curves import detach_rows
from assoc_hull.edit.modification import Modification, Pending, Work
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import Journal, distinct
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.network import bits_differ
from assoc_hull.model.node import Node
from assoc_hull.model.program.structure import Program, Values
from assoc_hull.model.tables import HullState

__all__ = ["FieldMoves"]

_MORE = 4
"""Sub-steps a field may have in addition."""


@attrs.define(eq=False)
class FieldMoves(Modification):
    """Displacements of the hull that an edit asks for; several add.

    `faired` are points (k,), and by how much (k, 3), m, these are farther from their given values.
    """

    fields: list[NormalField] = attrs.field(factory=list)
    faired: list[tuple[IntArray, FloatArray]] = attrs.field(factory=list)

    @property
    def idle(self) -> bool:
        """Whether there is no field."""
        return not self.fields

    @property
    def displaces(self) -> bool:
        """Whether points move that were not asked for one by one."""
        return bool(self.fields)

    @property
    def strict(self) -> bool:
        """Whether nothing but its own points may move."""
        return any(field.strict for field in self.fields)

    @property
    def asked_for(self) -> int:
        """How many fields there are."""
        return len(self.fields)

    def reached(self, state: HullState) -> Sequence[IntArray]:
        """Give the points that each field moves."""
        ground = FieldContext(state, any(field.across_flats for field in self.fields))
        return [
            Node.point(np.concatenate([field.shift(ground, 1.0).rows, field.exact()[0]]))
            for field in self.fields
        ]

    def landing(self) -> Iterable[tuple[IntArray, FloatArray]]:
        """Give the points that fields put to given places."""
        return [field.exact() for field in self.fields]

    def run(
        self, work: Work, rows: IntArray, origin: FloatArray
    ) -> tuple[IntArray, FloatArray] | None:
        """Run the fields, each sub-step with an update of its own."""
        if not self.fields:
            return None
        first, none = np.array(sorted(work.pending.curves), np.int64), rows[:0]

        def update(seeds: IntArray) -> bool:
            work.go(seeds, none if work.passes else first)
            work.settle()
            return True

        def detach(moved: IntArray) -> None:
            if detach_rows(Maker(work.state, work.journal), work.pending, moved):
                work.renew()

        found = self.carry_out(work.state, work.journal, work.pending, rows, origin, update, detach)
        work.pending.held.clear()
        return found

    def check(self, work: Work) -> Iterable[str]:
        """Say which point did not come where it was pulled, or where the edit moved it."""
        state, values = work.state, work.pending.values
        yield from unreached(state, self.fields, values.keys())
        for row in sorted(values.keys() & {row for each, _ in self.landing() for row in each}):
            if state.rows.alive[row] and (state.rows.xyz[row] != values[row]).any():
                yield (
                    f"{address(state, row)} is moved, and given another place by the new shape of "
                    "a line: leave one of the two out, or use two edits"
                )

    def carry_out(
        self, state: HullState, journal: Journal, pending: Pending, rows: IntArray,
        origin: FloatArray, update: Callable[[IntArray], bool],
        detach: Callable[[IntArray], None] | None = None,
        numbers: tuple[Program, Values] | None = None,
    ) -> tuple[IntArray, FloatArray] | None:  # fmt: skip
        """Run the fields; give all points that were set, and how far they lie from before, m.

        Parameters
        ----------
        state, journal, pending : HullState, Journal, Pending
            What is edited, and how. Its `held` become the adopted points that were carried; they
            ride from where they are then.
        rows : (k,) int
            Points that the edit has set by itself.
        origin : (n, 3), m
            Where all points lay before the edit.
        update : callable
            Brings all up to date with points that were set. Where it gives False, nothing more is
            done, and None is given.
        detach : callable or None
            Called with the points of a sub-step before they are written.
        numbers : (Program, Values) or None
            A program, whose numbers `update` brings to what is in the tables.
        """
        fields, held = self.fields, pending.held
        across = any(field.across_flats for field in fields)
        pinned, touched = set(pending.values), [rows]
        ground = FieldContext(state, across, numbers)
        shift = add_displacements([field.shift(ground, 1.0) for field in fields], pinned)
        steps, whole = sub_step_count(state, shift), shift
        landing = np.concatenate([field.exact()[0] for field in fields])
        xyz = state.rows.xyz
        for step in range(steps + _MORE):
            part = _part(state, fields, step, steps)
            if part == 0.0:
                break
            if step:
                ground = FieldContext(state, across, numbers)
            shift = whole
            if step or part != 1.0:
                shift = add_displacements([field.shift(ground, part) for field in fields], pinned)
            reached = (
                distinct(np.concatenate([shift.rows, landing])) if len(landing) else shift.rows
            )
            before = xyz.data.take(reached, axis=0)
            if detach is not None:
                detach(shift.rows)
            journal.put(xyz, shift.rows, xyz.data.take(shift.rows, axis=0) + shift.delta)
            if step == steps - 1 and len(landing):
                land_points(state, journal, fields)
            shifted = reached[bits_differ(before, xyz.data.take(reached, axis=0))]
            held |= set(shifted[state.rows.sort.data.take(shifted) == Sort.ADOPTED].tolist())
            touched.append(shifted)
            first = step == 0 and len(rows) > 0
            if not update(distinct(np.concatenate([shifted, rows])) if first else shifted):
                return None
        pending.notes += [
            f"{address(state, row)}: left alone, it is free almost along the hull only"
            for row in shift.left.tolist()
        ]
        rebase_adopted_points(state, np.array(sorted(held), np.int64), journal)
        self._note_faired(state, journal, pinned)
        every = distinct(np.concatenate(touched))
        every = every[every < len(origin)]
        now, then = xyz.data.take(every, axis=0), origin.take(every, axis=0)
        odd = np.flatnonzero(bits_differ(now, then))
        moved = now.take(odd, axis=0) - then.take(odd, axis=0)
        return every[odd], np.sqrt((moved * moved).sum(axis=1))

    def _note_faired(self, state: HullState, journal: Journal, pinned: set[int]) -> None:
        """Write how far fairing has taken points; what an edit set itself was given anew."""
        column = state.rows.faired
        for rows, more in self.faired:
            mine = ~np.isin(rows, sorted(pinned)) & state.rows.alive.data[rows]
            journal.put(column, rows[mine], column.take(rows[mine]) + more[mine])


def _part(state: HullState, fields: list[NormalField], step: int, steps: int) -> float:
    """Give the part of the fields to run in a sub-step; nil when they are where they should be.

    A field that knows what it lacks spreads that over the sub-steps left, and has a few more.
    """
    done = min(step, steps) / steps
    left = fields[0].left(state, done) if len(fields) == 1 else 1.0 - done
    if step >= steps and abs(left) <= CLOSE:
        return 0.0
    return float(np.clip(left / max(steps - step, 1), -1.0 / steps, 1.0 / steps))

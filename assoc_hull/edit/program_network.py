"""An edit that keeps the structure of the net: its numbers come from one run of the program.

The run gives the bits of the full way, or says that it does not answer for the edit: then curves
are lofted and cut as ever. What it gives is written to the tables in the order in which the engine
would have evaluated it, so that causes, report and undo are those of any other edit.
"""

from __future__ import annotations

import itertools

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import WideGaps
from assoc_hull.edit.document import Document
from assoc_hull.edit.pending_changes import Pending
from assoc_hull.edit.published_program import LiveNumbers, published_program
from assoc_hull.geometry.curves import IntArray, freeze
from assoc_hull.graph.journal import Journal, PickedRows
from assoc_hull.graph.network import Evaluation
from assoc_hull.model.network import HullNetwork, moved_curves, placed
from assoc_hull.model.node import Node
from assoc_hull.model.program.engine import is_compiled
from assoc_hull.model.program.structure import PublishedProgram
from assoc_hull.model.tables import HullState

__all__ = ["ProgramNetwork", "ProgramRuns"]

_STEADY = 3
"""After so many edits that kept the structure a program is compiled for the next ones."""


@attrs.define(eq=False)
class ProgramNetwork(HullNetwork):
    """The hull as the engine sees it, with curves that a run of the program has made."""

    numbers: LiveNumbers = attrs.field(kw_only=True)

    def _curves(self, curves: IntArray, journal: Journal) -> Evaluation:
        """Take splines and meetings from the run; the meetings are those that were there."""
        table, numbers, program = self.state.curves, curves.tolist(), self.numbers.published.program
        old = [table.spline.data[curve] for curve in numbers]
        met = [table.meets.data[curve] for curve in numbers]
        local = program.local[curves]
        batch = self.numbers.splines(local)
        splines = batch.single()
        for curve, spline in zip(numbers, old, strict=True):
            if spline is not None:
                self.before.setdefault(curve, spline)
        moved = moved_curves(old, None, splines, batch)
        journal.set(table.spline, numbers, splines)
        first, stop = program.meet_start[local], program.meet_start[local + 1]
        bounds = np.concatenate([[0], np.cumsum(stop - first)])
        where = np.arange(bounds[-1]) + np.repeat(first - bounds[:-1], stop - first)
        values = self.numbers.values
        at, xyz = values.at[where], values.place[where]
        freeze(at, xyz)
        spans = itertools.pairwise(bounds.tolist())
        journal.set(
            table.meets, numbers,
            [placed(each, at[a:b], xyz[a:b]) for each, (a, b) in zip(met, spans, strict=True)],
        )  # fmt: skip
        self._write_places(curves, where, PickedRows(at), PickedRows(xyz), journal)
        differs = moved != 0.0
        return Evaluation(Node.curve(curves[differs]), moved[differs])

    def _write_places(
        self, curves: IntArray, where: IntArray, at: PickedRows, xyz: PickedRows, journal: Journal
    ) -> None:
        """Write where crossings lie on curves; a latent meeting (-1) is none yet."""
        program, rows = self.numbers.published.program, self.state.rows
        row, owner = program.meet_row[where], program.number[program.meet_curve[where]]
        actual = np.flatnonzero(row >= 0)
        part = 2 * row[actual] + (rows.curve[row[actual], 0] != owner[actual])
        pick = None if len(actual) == len(row) else actual
        journal.put_parts(rows.spot, part, attrs.evolve(xyz, pick=pick), None)
        journal.put_parts(rows.parameter, part, attrs.evolve(at, pick=pick), None)
        guess = self.index.guess.reshape(-1)
        if len(guess) == 2 * rows.count:
            guess[part] = self.numbers.values.segment[where[actual]]


@attrs.define(eq=False)
class ProgramRuns:
    """The runs of one edit."""

    state: HullState
    numbers: LiveNumbers
    watched: IntArray = attrs.field(factory=lambda: np.zeros(0, np.int64))

    @classmethod
    def of(cls, document: Document, pending: Pending) -> ProgramRuns | None:
        """Give what runs an edit; None where it is not at hand, or more than points is set."""
        steps = document.history[-_STEADY:]
        steady = len(steps) == _STEADY and not any(each.structural for each in steps)
        if not (pending.places_only and steady and is_compiled()):
            return None
        published = published_program(document)
        return None if published is None else cls(document.state, LiveNumbers.of(published))

    def run(self, rows: IntArray, held: IntArray) -> bool:
        """Run with points as they are in the tables now; tell whether it answers for the edit."""
        values = self.numbers.values
        values.xyz[rows] = self.state.rows.xyz[rows]
        found = self.numbers.run(rows, held)
        self.watched = np.union1d(self.watched, found.watched)
        return found.kept

    def network(self, other: HullNetwork) -> ProgramNetwork:
        """Give the network that takes its curves from here, for another one that lofts them."""
        return ProgramNetwork(
            other.state, other.index, other.realigned, other.before, numbers=self.numbers
        )

    def write_gaps(self, journal: Journal) -> WideGaps:
        """Write the gaps that the runs have measured; none is over its limit."""
        numbers = self.numbers
        rows: IntArray = numbers.published.program.watch[self.watched]
        gap = numbers.values.gap[self.watched]
        table, nothing = self.state.rows, np.zeros(0)
        journal.put(table.gap, rows, gap)
        # A watched crossing is published where it lies on curve a.
        journal.put(table.xyz, rows, table.spot[rows, 0])
        return WideGaps(rows[:0], nothing, nothing, float(gap.max(initial=0.0)), rows[:0])

    def published(self) -> PublishedProgram:
        """Give the numbers of the tables as the edit leaves them."""
        values, rows = self.numbers.values, self.state.rows
        # Points that a field carries ride from where they are now.
        values.base[:], values.anchor_from[:] = rows.base.data, rows.anchor_from.data
        return PublishedProgram(self.numbers.published.program, values)

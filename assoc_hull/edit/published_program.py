"""The program of a hull and its published numbers, at hand until the tables change.

What runs on it works on a copy of the numbers of its own, so any number of drags stand beside one
another and beside the tables, which are only read.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.geometry.curves import IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.graph.derived import Objects
from assoc_hull.model.index import Index
from assoc_hull.model.program import Program, PublishedProgram, Values, compile_program
from assoc_hull.model.program_engine import runner_of
from assoc_hull.model.run_program import ProgramRun, RunProgram
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = ["LiveNumbers", "keep_numbers", "published_program"]


@attrs.define(eq=False)
class LiveNumbers:
    """Numbers of a hull that are tried and put back."""

    published: PublishedProgram
    values: Values
    runner: RunProgram
    written: bool = False

    @classmethod
    def of(cls, published: PublishedProgram) -> LiveNumbers:
        """Begin with the published numbers."""
        return cls(published, published.values.copy(), runner_of(published.program))

    def begin(self) -> None:
        """Say that they will be written to; what was broken off before is swept away."""
        if self.written:
            self.values = self.published.values.copy()
            self.runner = runner_of(self.published.program)
        self.written = True

    def run(self, rows: IntArray, held: IntArray) -> ProgramRun:
        """Bring all up to date with points that were written."""
        return self.runner.run(self.values, self.published.values, rows, held)

    def restore(self, run: ProgramRun) -> None:
        """Put the published numbers back where a run has written."""
        self.runner.restore(self.values, self.published.values, run)
        self.written = False

    def splines(self, curves: IntArray) -> SplineBatch:
        """Give curves, as the program counts them, as they are in these numbers; there is one."""
        program, values = self.published.program, self.values
        spans = [(int(program.start[c]), int(program.start[c + 1])) for c in curves.tolist()]
        start = np.zeros(len(spans) + 1, np.int64)
        np.cumsum([b - a for a, b in spans], out=start[1:])
        blocks = [values.block[9 * a : 9 * b].reshape(9, b - a) for a, b in spans]
        block = np.concatenate(blocks, axis=1)
        knot = np.concatenate([values.knot[a:b] for a, b in spans])
        return SplineBatch(start, knot, block[:3].T, block[3:6].T, block[6:].T)


def published_program(document: Document) -> PublishedProgram | None:
    """Give the program of the present state; None of a hull with curves that cannot be made."""
    state, index = document.state.published(), document.index
    program = state.derived(
        ("program",), _structure(state, index), lambda: compile_program(state, index), most=1
    )
    if program is None:
        return None
    return PublishedProgram(program, _numbers(state, program, lambda: _published(state, program)))


def keep_numbers(document: Document, found: PublishedProgram) -> None:
    """Keep the numbers of what has just been published: they are known, and need not be read."""
    values = found.values
    freeze(*(getattr(values, each.name) for each in attrs.fields(Values)))
    _numbers(document.state.published(), found.program, lambda: values)


def _numbers(state: HullState, program: Program, make: Callable[[], Values]) -> Values:
    """Give the numbers of the tables as they were read or kept last, if they still hold."""
    rows, curves = state.rows, state.curves
    columns = rows.xyz, rows.base, rows.anchor_from, rows.gap, curves.spline, curves.meets
    return state.derived(("published numbers",), (program, *columns), make, most=1)


def _structure(state: HullState, index: Index) -> tuple[object, ...]:
    """Give all that the structure is made of: columns, and objects in them."""
    rows, lines, curves = state.rows, state.lines, state.curves
    meets = [state.curves.meets[curve] for curve in state.live("curves").tolist()]
    return (
        index, rows.alive, rows.sort, rows.kind, rows.direction, rows.curve, rows.role,
        rows.reader, rows.driver, rows.contact, rows.limit, rows.anchor, rows.anchor_weight,
        curves.alive, curves.line, curves.rows, curves.side, curves.ends, lines.alive,
        lines.planar, lines.normal, lines.offset, state.featured.alive, state.featured.feature,
        state.produced.alive, state.produced.curve, state.settings.failed,
        # An intersection that changes its crossing or its place in the order is another array.
        Objects([part for each in meets for part in (each.line, each.sign, each.row)]),
    )  # fmt: skip


def _published(state: HullState, program: Program) -> Values:
    """Read the numbers of the tables."""
    values = Values.blank(program, state)
    met: list[CurveIntersections] = [state.curves.meets[curve] for curve in program.number.tolist()]
    splines = [state.spline(curve) for curve in program.number.tolist()]
    values.at[:] = np.concatenate([each.parameter for each in met])
    values.place[:] = np.concatenate([each.xyz for each in met])
    spans, meetings = (
        itertools.pairwise(each.tolist()) for each in (program.start, program.meet_start)
    )
    for (a, b), (first, stop), spline in zip(spans, meetings, splines, strict=True):
        block = values.block[9 * a : 9 * b].reshape(9, b - a)
        block[:3], block[3:6], block[6:] = spline.xyz.T, spline.leave.T, spline.arrive.T
        values.knot[a:b] = spline.knot
        inner = spline.knot[1:-1]
        values.segment[first:stop] = inner.searchsorted(values.at[first:stop], "right")
    batch = SplineBatch.join(splines)
    values.folds[:] = np.bincount(curve_folds(batch).curve, minlength=program.curves)
    values.lowest[:] = np.minimum.reduceat(batch.xyz[:, 1], batch.start[:-1])
    values.gap[:] = state.rows.gap[program.watch]
    freeze(*(getattr(values, each.name) for each in attrs.fields(Values)))
    return values

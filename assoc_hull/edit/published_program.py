"""The program of a hull and its published numbers, at hand until the tables change.

What runs on it works on a copy of the numbers of its own, so any number of drags stand beside one
another and beside the tables, which are only read.
"""

from __future__ import annotations

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
    last = _last(state, program)
    values = _numbers(state, program, lambda: _read(state, program, last.read))
    last.read = _Read(values, *_objects(state, program))
    return PublishedProgram(program, values)


def keep_numbers(document: Document, found: PublishedProgram) -> None:
    """Keep the numbers of what has just been published: they are known, and need not be read."""
    values, state = found.values, document.state.published()
    freeze(*(getattr(values, each.name) for each in attrs.fields(Values)))
    _numbers(state, found.program, lambda: values)
    _last(state, found.program).read = _Read(values, *_objects(state, found.program))


@attrs.frozen(eq=False)
class _Read:
    """Numbers, and the splines and meetings that they were read of."""

    values: Values
    splines: list[SplineBatch]
    met: list[CurveIntersections]


@attrs.define(eq=False)
class _Last:
    """What was read last of a structure; another state of it differs in a few curves."""

    read: _Read | None = None


def _last(state: HullState, program: Program) -> _Last:
    return state.derived(("numbers read last",), (program,), _Last, most=1)


def _objects(
    state: HullState, program: Program
) -> tuple[list[SplineBatch], list[CurveIntersections]]:
    curves = program.number.tolist()
    return [state.spline(each) for each in curves], [state.curves.meets[each] for each in curves]


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


def _read(state: HullState, program: Program, last: _Read | None) -> Values:
    """Read the numbers of the tables; of curves that are as they were, take what was read last."""
    splines, met = _objects(state, program)
    table = state.rows
    if last is None:
        values, odd = Values.blank(program, state), list(range(program.curves))
    else:
        values = last.values.copy()
        values.xyz[:], values.base[:] = table.xyz.data, table.base.data
        values.anchor_from[:] = table.anchor_from.data
        was = zip(last.splines, last.met, strict=True)
        odd = [
            i for i, (spline, meets) in enumerate(was)
            if spline is not splines[i] or meets is not met[i]
        ]  # fmt: skip
    for i in odd:
        a, b = program.start[i : i + 2].tolist()
        first, stop = program.meet_start[i : i + 2].tolist()
        spline, block = splines[i], values.block[9 * a : 9 * b].reshape(9, b - a)
        block[:3], block[3:6], block[6:] = spline.xyz.T, spline.leave.T, spline.arrive.T
        values.knot[a:b] = spline.knot
        values.at[first:stop], values.place[first:stop] = met[i].parameter, met[i].xyz
        values.segment[first:stop] = spline.knot[1:-1].searchsorted(met[i].parameter, "right")
    if odd:
        batch = SplineBatch.join([splines[i] for i in odd])
        values.folds[odd] = np.bincount(curve_folds(batch).curve, minlength=len(odd))
        values.lowest[odd] = np.minimum.reduceat(batch.xyz[:, 1], batch.start[:-1])
    values.gap[:] = table.gap[program.watch]
    freeze(*(getattr(values, each.name) for each in attrs.fields(Values)))
    return values

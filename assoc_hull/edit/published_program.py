"""The program of a hull and its published numbers, at hand until the tables change.

What runs on it works on a copy of the numbers of its own, so any number of drags stand beside one
another and beside the tables, which are only read.
"""

from __future__ import annotations

import itertools
from collections.abc import Hashable

import attrs
import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.geometry.curves import IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.model.index import Index, Objects
from assoc_hull.model.program import Program, Values, compile_program
from assoc_hull.model.program_engine import runner_of
from assoc_hull.model.run_program import ProgramRun, RunProgram
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = ["LiveNumbers", "PublishedProgram", "published_program"]

_KEPT = "program"


@attrs.frozen(eq=False)
class PublishedProgram:
    """The structure of a hull, and its numbers as they are published; never written to."""

    program: Program
    values: Values


@attrs.define(eq=False)
class LiveNumbers:
    """Numbers of a hull that are tried and put back."""

    published: PublishedProgram
    values: Values
    runner: RunProgram

    @classmethod
    def of(cls, published: PublishedProgram) -> LiveNumbers:
        """Begin with the published numbers."""
        return cls(published, published.values.copy(), runner_of(published.program))

    def run(self, rows: IntArray, held: IntArray) -> ProgramRun:
        """Bring all up to date with points that were written."""
        return self.runner.run(self.values, self.published.values, rows, held)

    def restore(self, run: ProgramRun) -> None:
        """Put the published numbers back where a run has written."""
        self.runner.restore(self.values, self.published.values, run)

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
    state, index = document.state, document.index
    known: _Known | None = state.kept.get(_KEPT)
    structure, numbers = _structure(state, index), _numbers(state)
    if known is None or known.structure != structure or known.numbers != numbers:
        program = known.program if known and known.structure == structure else None
        known = _Known.of(state, index, program, structure, numbers)
        state.kept[_KEPT] = known
    if known.program is None or known.values is None:
        return None
    return PublishedProgram(known.program, known.values)


@attrs.frozen(eq=False)
class _Known:
    """What was made last, and of what."""

    structure: Hashable
    numbers: Hashable
    program: Program | None
    values: Values | None

    @classmethod
    def of(
        cls, state: HullState, index: Index, program: Program | None, *stamps: Hashable
    ) -> _Known:
        """Compile the structure, unless it is known, and read the numbers."""
        values = None if program is None else _published(state, program)
        if values is None:
            program = compile_program(state, index)
            values = None if program is None else _published(state, program)
        return cls(stamps[0], stamps[1], program, values)


def _structure(state: HullState, index: Index) -> Hashable:
    """Give what the structure is made of: numbers of writes, and objects."""
    rows, lines, curves = state.rows, state.lines, state.curves
    columns = (
        rows.alive, rows.sort, rows.kind, rows.direction, rows.curve, rows.role, rows.reader,
        rows.driver, rows.contact, rows.limit, rows.anchor, rows.anchor_weight, curves.alive,
        curves.line, lines.alive, lines.planar, lines.normal, lines.offset, state.featured.alive,
    )  # fmt: skip
    objects = (
        index, state.settings.failed[0], *curves.rows.data, *curves.side.data,
        *curves.ends.data, *state.featured.feature.data, *state.produced.curve.data,
    )  # fmt: skip
    return tuple(column.writes for column in columns), Objects(objects)


def _numbers(state: HullState) -> Hashable:
    """Give what the numbers are read from."""
    rows = state.rows
    columns = (rows.xyz, rows.base, rows.anchor_from, rows.gap)
    objects = (*state.curves.spline.data, *state.curves.meets.data)
    return tuple(column.writes for column in columns), Objects(objects)


def _published(state: HullState, program: Program) -> Values | None:
    """Read the numbers of the tables; None if the program is not of their structure."""
    values = Values.blank(program, state)
    met: list[CurveIntersections] = [state.curves.meets[curve] for curve in program.number.tolist()]
    splines = [state.spline(curve) for curve in program.number.tolist()]
    if not _same_meetings(program, met):
        return None
    values.at[:] = np.concatenate([each.parameter for each in met])
    values.place[:] = np.concatenate([each.xyz for each in met])
    bounds = zip(program.start.tolist(), program.meet_start.tolist(), splines, strict=False)
    spans = list(itertools.pairwise([*bounds, (len(program.row), len(program.meet_row), None)]))
    for (a, first, spline), (b, stop, _) in spans:
        if spline is None or len(spline.knot) != b - a:
            return None
        block = values.block[9 * a : 9 * b].reshape(9, b - a)
        block[:3], block[3:6], block[6:] = spline.xyz.T, spline.leave.T, spline.arrive.T
        values.knot[a:b] = spline.knot
        values.segment[first:stop] = (spline.knot[1:-1]).searchsorted(
            values.at[first:stop], "right"
        )
    batch = SplineBatch.join(splines)
    values.folds[:] = np.bincount(curve_folds(batch).curve, minlength=program.curves)
    values.lowest[:] = np.minimum.reduceat(batch.xyz[:, 1], batch.start[:-1])
    values.gap[:] = state.rows.gap[program.watch]
    freeze(*(getattr(values, each.name) for each in attrs.fields(Values)))
    return values


def _same_meetings(program: Program, met: list[CurveIntersections]) -> bool:
    """Tell whether curves meet what they met when the program was compiled."""
    rows = np.concatenate([each.row for each in met])
    signs = np.concatenate([each.sign for each in met])
    return np.array_equal(rows, program.meet_row) and np.array_equal(signs, program.meet_sign)

"""An edit that keeps the structure of the net: its numbers come from runs of the program.

The runs give the bits of the full way, or say that they do not answer for the edit: then all is
taken back, and the edit goes the full way. The tables are written to in one piece a run. Causes and
report are told when somebody asks: the engine then goes once more through the net as it was, and
takes what each node became from what was noted here, so that they are those of any other edit.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Mapping, Sequence
from typing import cast

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.document import Document
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.followup.settle_features import settle_features
from assoc_hull.edit.modification import Pending, Work
from assoc_hull.edit.outcome import (
    Movements,
    changed_nodes,
    joined_causes,
    largest_movements,
    net_difference,
    points_elsewhere,
)
from assoc_hull.edit.past_states import late_report
from assoc_hull.edit.published_program import LiveNumbers, numbers_for_edit
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.step import EditReport, Fairness, Notes, Past, Step, StepBody, Writes
from assoc_hull.errors import RefusedEditError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.graph.journal import Journal, PickedRows, each_once
from assoc_hull.graph.run_update import Evaluation, UpdatePass, distinct, run_update
from assoc_hull.model.change import TableChange, net_bits
from assoc_hull.model.index import build_index, index_columns
from assoc_hull.model.network import HullNetwork, moved_curves, placed
from assoc_hull.model.node import Node
from assoc_hull.model.packed_change import change_of_shape
from assoc_hull.model.program.engine import is_asked_often, is_compiled
from assoc_hull.model.program.run_program import ProgramRun, spans
from assoc_hull.model.program.structure import Program
from assoc_hull.model.tables import HullState

__all__ = ["ProgramEdit"]

_STEADY = 3
"""After so many edits or previews of one structure a program is compiled for the next ones."""

_NONE: IntArray = np.zeros(0, np.int64)


@attrs.frozen(eq=False)
class _Pass:
    """One run: the points that were set, those that moved for it, the curves that were lofted.

    `held` are adopted points that did not ride; `was` and `now` (k, 3), m, is where `rows` lay
    before and after; `odd` (c,) tells which curves differ from the published ones.
    """

    seeds: IntArray
    held: IntArray
    rows: IntArray
    was: FloatArray
    now: FloatArray
    curves: IntArray
    old: Sequence[SplineBatch]
    new: Sequence[SplineBatch]
    odd: NDArray[np.bool_]

    def distances(self) -> dict[int, float]:
        """Give how far each node moved, m; curves that came out as they were are left out."""
        step = self.now - self.was
        point = np.sqrt(step[:, 0] * step[:, 0] + step[:, 1] * step[:, 1] + step[:, 2] * step[:, 2])
        found = dict(zip(Node.point(self.rows).tolist(), point.tolist(), strict=True))
        if len(self.curves):
            batch = SplineBatch.join(self.new)
            curve = moved_curves(self.old, self.new, batch)
            differs = curve != 0.0
            nodes = Node.curve(self.curves[differs]).tolist()
            found |= dict(zip(nodes, curve[differs].tolist(), strict=True))
        return found

    def changed_curves(self) -> IntArray:
        """Give the curves that differ from the published ones, ascending."""
        return np.sort(self.curves[self.odd])


@attrs.frozen(eq=False)
class _Meetings:
    """Where the meetings of some curves stand in a program and in the tables.

    Attributes
    ----------
    where : (k,) int
        Their numbers in the program.
    spans : list of (int, int)
        Which of them are those of each curve.
    pick, part : (n,) int or None, (n,) int
        Which are crossings, all if None; and the parts of the rows of these, as
        `Column.put_parts` counts them.
    """

    where: IntArray
    spans: list[tuple[int, int]]
    pick: IntArray | None
    part: IntArray

    @classmethod
    def of(cls, program: Program, curve: IntArray, local: IntArray) -> _Meetings:
        """Find them; `curve` (rows, 2) are the curves of all points."""
        count = program.meet_start[local + 1] - program.meet_start[local]
        bounds, where = np.concatenate([[0], np.cumsum(count)]), spans(program.meet_start, local)
        row = program.meet_row[where]
        actual = np.flatnonzero(row >= 0)  # a latent meeting (-1) is no crossing yet
        owner = program.number[program.meet_curve[where[actual]]]
        part = 2 * row[actual] + (curve[row[actual], 0] != owner)
        pick = None if len(actual) == len(row) else actual
        return cls(where, list(itertools.pairwise(bounds.tolist())), pick, part)


@attrs.define(eq=False)
class _NotedNetwork(HullNetwork):
    """A net whose nodes have become already what they are to be, and by how much they moved."""

    noted: Mapping[int, float] = attrs.field(kw_only=True)

    def evaluate(self, nodes: IntArray, journal: Journal) -> Evaluation:
        """Tell which of the nodes changed."""
        distance = [self.noted.get(node, np.nan) for node in nodes.tolist()]
        moved = np.array(distance)
        changed = ~np.isnan(moved)
        return Evaluation(nodes[changed], moved[changed])


@attrs.frozen(eq=False)
class _Notes:
    """All that is told of an edit later on; nothing of it changes when the tables do."""

    net: HullNetwork
    name: str
    journal: Writes
    passes: Sequence[_Pass]
    rows: IntArray
    away: FloatArray
    movements: Movements
    elsewhere: tuple[IntArray, FloatArray]
    notes: tuple[str, ...]
    largest_gap: float
    seconds: dict[str, float]

    lasting = False  # the net lives in this process

    def packed(self, past: Past, step: Step, writes: Writes) -> Notes:
        """Give what of this cannot be found again, of an edit in one run."""
        (run,) = self.passes
        return _PackedNotes(
            past, step.number, writes, self.name, run.seeds, run.held, run.rows, run.curves,
            self.rows, self.away, self.movements.rows, self.notes, self.largest_gap, self.seconds,
        )  # fmt: skip

    def body(self) -> StepBody:
        """Tell what changed, and why."""
        parts = [self._replayed(each) for each in self.passes]
        nodes, moved = changed_nodes(parts, self.rows, self.away, _NONE)
        before, after = self._splines()
        if len(parts) > 1:
            every = np.concatenate([nodes, *(part.changed for part in parts)])
            known = np.concatenate([moved, *(part.moved for part in parts)])
            nodes, moved = net_difference(
                self.elsewhere, before, after.__getitem__, every, known
            )  # fmt: skip
        report = self._report(parts, nodes, moved, before, after)
        return StepBody(
            self.journal, joined_causes(parts), nodes, moved, Node.point(self.rows), report
        )

    def _replayed(self, noted: _Pass) -> UpdatePass:
        """Let the engine go through the net once more."""
        net = _NotedNetwork(self.net.state, self.net.index, noted=noted.distances())
        return run_update(net, Node.point(noted.seeds), Journal(), held=Node.point(noted.held))

    def _splines(self) -> tuple[dict[int, SplineBatch], dict[int, SplineBatch]]:
        """Give the curves that were lofted as they were before, and as they are after."""
        before, after = dict[int, SplineBatch](), dict[int, SplineBatch]()
        for each in self.passes:
            after |= zip(each.curves.tolist(), each.new, strict=True)
            for curve, spline in zip(each.curves.tolist(), each.old, strict=True):
                before.setdefault(curve, spline)
        return before, after

    def _report(
        self, parts: Sequence[UpdatePass], nodes: IntArray, moved: FloatArray,
        before: dict[int, SplineBatch], after: dict[int, SplineBatch],
    ) -> EditReport:  # fmt: skip
        state = self.net.state
        evaluated = np.concatenate([_NONE, *(part.evaluated for part in parts)])
        every = Node.number(evaluated[Node.is_curve(evaluated)])
        curves = every[np.sort(np.unique(every, return_index=True)[1])]
        keys = tuple(state.curves.key.data[curve] for curve in curves.tolist())
        largest, normal = largest_movements(state, self.movements, nodes, moved)
        return EditReport(
            self.name,
            planned=self.net.reached(Node.point(self.passes[0].seeds)),
            relofted=keys,
            cut_off=sum(len(part.cut_off) for part in parts),
            largest=largest,
            largest_normal=normal,
            largest_gap=self.largest_gap,
            notes=self.notes,
            seconds=self.seconds,
            fairness=Fairness(
                before, {curve: after[curve] for curve in curves.tolist()},
                plane_normals(state, curves), curves, keys,
            ),
        )  # fmt: skip


@attrs.frozen(eq=False)
class _Before:
    """What was before an edit: places of some points and all curves."""

    xyz: FloatArray
    spline: Sequence[SplineBatch | None]


@attrs.frozen(eq=False)
class _PackedNotes:
    """All that is told of an old edit in one run, but what is found again in the tables of then.

    `set_by` are points that were set, `changed` all that moved; else as in `_Notes` and `_Pass`.
    """

    past: Past
    number: int
    writes: Writes
    name: str
    seeds: IntArray
    held: IntArray
    rows: IntArray
    curves: IntArray
    set_by: IntArray
    away: FloatArray
    changed: IntArray
    notes: tuple[str, ...]
    largest_gap: float
    seconds: dict[str, float]

    lasting = True

    def body(self) -> StepBody:
        """Tell what changed, and why, from the tables as they were."""
        return self.past.tell(self.number, self._before, self._body)

    def packed(self, past: Past, step: Step, writes: Writes) -> Notes:
        """Give them as they are."""
        return self

    def _before(self, state: HullState) -> _Before:
        return _Before(state.rows.xyz.data.copy(), tuple(state.curves.spline.data))

    def _body(self, state: HullState, before: _Before) -> StepBody:
        index = state.derived(
            ("look-ups",), index_columns(state), lambda: build_index(state), most=2
        )
        xyz, numbers = state.rows.xyz, self.curves.tolist()
        old = [spline for each in numbers if (spline := before.spline[each]) is not None]
        new = [state.spline(each) for each in numbers]
        odd = moved_curves(old, new, SplineBatch.join(new)) != 0.0 if new else np.zeros(0, np.bool_)
        run = _Pass(
            self.seeds, self.held, self.rows, before.xyz[self.rows], xyz[self.rows], self.curves,
            old, new, odd,
        )  # fmt: skip
        movements = Movements.of(state, self.changed, before.xyz[self.changed])
        body = _Notes(
            HullNetwork(state, index), self.name, self.writes, (run,), self.set_by, self.away,
            movements, (_NONE, self.away[:0]), self.notes, self.largest_gap, self.seconds,
        ).body()  # fmt: skip
        return attrs.evolve(body, report=late_report(body.report, self.past, self.number))


@attrs.define(eq=False)
class ProgramEdit:
    """One edit while the program carries it out.

    `net` is the net as the engine sees it; of its tables only the structure is looked at.
    """

    document: Document
    pending: Pending
    numbers: LiveNumbers
    net: HullNetwork
    journal: Journal = attrs.field(factory=Journal)
    runs: list[ProgramRun] = attrs.field(factory=list)
    passes: list[_Pass] = attrs.field(factory=list)
    ridden: IntArray = attrs.field(factory=lambda: _NONE)

    @classmethod
    def of(cls, document: Document, pending: Pending) -> ProgramEdit | None:
        """Give what carries out an edit; None where it is not at hand, or not for such an edit."""
        if not cls.serves(pending) or document.program.asked_for(document.index) <= _STEADY:
            return None
        # In numpy a run of few curves takes as long as the full way; a field reaches many.
        good = is_compiled() or (pending.displaces and is_asked_often())
        return cls.begun(document, pending) if good else None

    @classmethod
    def serves(cls, pending: Pending) -> bool:
        """Tell whether nothing but places of points is set, each by itself or by a field."""
        other = (
            pending.curves, pending.computed, pending.structural, pending.fresh, pending.alone,
            pending.features,
        )  # fmt: skip
        more = [each for kind, each in pending.modifications.items() if kind is not FieldMoves]
        some = bool(pending.values) or pending.displaces
        return some and not any(other) and all(each.idle for each in more)

    @classmethod
    def begun(cls, document: Document, pending: Pending) -> ProgramEdit | None:
        """Take numbers to write to; None for a hull with curves that a program does not make."""
        found = None if document.index.generated else numbers_for_edit(document)
        return None if found is None else cls(document, pending, *found)

    def run(
        self, name: str, journal: Journal, settings: Settings, rows: IntArray, away: FloatArray
    ) -> Step | None:
        """Carry out the edit, of which the points `rows` are set already, and give its step.

        None where the runs do not answer for it; what is in the journal is to be taken back then.

        Raises
        ------
        RefusedEditError
            It was stopped, or a point did not come where it was pulled.
        """
        begin, state, pending = time.perf_counter(), self.document.state, self.pending
        self.journal = journal
        self.numbers.begin()
        if pending.stopped():
            raise RefusedEditError(name, ("it was stopped",))
        moves = pending.asked(FieldMoves)
        if moves is not None and moves.fields:
            origin = self.numbers.published.values.xyz
            numbers = self.numbers.published.program, self.numbers.values
            found = moves.carry_out(
                state, journal, pending, rows, origin, self._run, numbers=numbers
            )
            if found is None:
                return None
            rows, away = found
            self._note_riding()
        elif not self._run(rows):
            return None
        ran = time.perf_counter()
        largest_gap = self._write_gaps()
        work = Work(self.document, name, journal, pending, settings, self.net)
        findings = () if moves is None else tuple(moves.check(work))
        if findings:
            raise RefusedEditError(name, findings)
        changed = distinct(np.concatenate([rows, *(each.rows for each in self.passes)]))
        written = len(journal.entries)
        if self.numbers.published.program.features.own(changed):
            settle_features(work, rows, changed)
        if len(journal.entries) == written:  # else the structure is another one from here on
            pending.numbers = self
        seconds = {"run": ran - begin, "check": time.perf_counter() - ran}
        return self._step(name, rows, away, changed, largest_gap, seconds)

    def _run(self, rows: IntArray) -> bool:
        """Run with points as they are in the tables now; tell whether that is the whole edit."""
        if self.pending.stopped():
            return False  # the full way says so
        held = np.array(sorted(self.pending.held), np.int64)
        self.numbers.values.xyz[rows] = self.document.state.rows.xyz.take(rows)
        found = self.numbers.run(rows, held)
        self.runs.append(found)
        if found.kept:
            self._write(found, rows, held)
        return found.kept

    def _write(self, run: ProgramRun, seeds: IntArray, held: IntArray) -> None:
        """Write what a run has made; each meeting is the crossing that it was."""
        state, values, program = (
            self.document.state, self.numbers.values, self.numbers.published.program,
        )  # fmt: skip
        others = np.ones(len(run.rows), np.bool_)
        others[run.rows.searchsorted(seeds)] = False
        rows = run.rows[others]
        was, now = state.rows.xyz.take(rows), values.xyz.take(rows, axis=0)
        self.journal.put(state.rows.xyz, rows, now)
        curves = program.number.take(run.curves)
        numbers, table, shape = curves.tolist(), state.curves, state.curves.spline.data
        # A program has a shape of every curve.
        old = cast("list[SplineBatch]", [shape[curve] for curve in numbers])
        new, odd = list[SplineBatch](), np.zeros(0, np.bool_)
        if numbers:
            batch, odd = self.numbers.told_splines(run.curves)
            new = batch.single()
            self.journal.set(table.spline, numbers, new)
            self._write_meetings(run.curves, numbers)
        self.passes.append(_Pass(seeds, held, rows, was, now, curves, old, new, odd))

    def _write_meetings(self, local: IntArray, numbers: list[int]) -> None:
        """Write where curves meet the planes of others, and crossings lie on them."""
        state, values, program = (
            self.document.state, self.numbers.values, self.numbers.published.program,
        )  # fmt: skip
        # A hand that drags moves the same curves again and again.
        to = self.net.state.derived(
            ("written meetings", local.tobytes()), (program,),
            lambda: _Meetings.of(program, self.net.state.rows.curve.data, local),
            most=8,  # each of them keeps its program, which is as large as the hull
        )  # fmt: skip
        at, xyz = values.at.take(to.where), values.place.take(to.where, axis=0)
        freeze(at, xyz)
        met = state.curves.meets.data
        self.journal.set(
            state.curves.meets, numbers,
            [placed(met[c], at[a:b], xyz[a:b])
             for c, (a, b) in zip(numbers, to.spans, strict=True)],
        )  # fmt: skip
        rows, guess = state.rows, self.document.index.guess.reshape(-1)
        self.journal.put_parts(rows.spot, to.part, PickedRows(xyz, to.pick))
        self.journal.put_parts(rows.parameter, to.part, PickedRows(at, to.pick))
        if len(guess) == rows.curve.data.size:
            guess[to.part] = values.segment.take(to.where if to.pick is None else to.where[to.pick])

    def _note_riding(self) -> None:
        """Let points that a field has carried ride from where they are now."""
        table, values = self.document.state.rows, self.numbers.values
        self.ridden = np.array(sorted(self.pending.held), np.int64)
        self.pending.held.clear()
        values.base[self.ridden] = table.base[self.ridden]
        values.anchor_from[self.ridden] = table.anchor_from[self.ridden]

    def _write_gaps(self) -> float:
        """Write the gaps that the runs have measured, none over its limit; give the largest."""
        values, rows = self.numbers.values, self.document.state.rows
        watched = each_once([each.watched for each in self.runs])
        gap = values.gap.take(watched)
        crossings: IntArray = self.numbers.published.program.watch.take(watched)
        self.journal.put(rows.gap, crossings, gap)
        # A watched crossing is published where it lies on curve a.
        self.journal.put(rows.xyz, crossings, values.xyz.take(crossings, axis=0))
        return float(gap.max(initial=0.0))

    def _step(
        self, name: str, rows: IntArray, away: FloatArray, changed: IntArray, largest_gap: float,
        seconds: dict[str, float],
    ) -> Step:  # fmt: skip
        """Put the finished step together; only what the history needs is told now."""
        state = self.document.state
        curves, elsewhere = self.passes[0].changed_curves(), (_NONE, away[:0])
        if len(self.passes) > 1:
            elsewhere = points_elsewhere(state, self.journal)
            changed = elsewhere[0]
        movements = Movements.of(state, changed, self.numbers.published.values.xyz[changed])
        notes = _Notes(
            self.net, name, self.journal, tuple(self.passes), rows, away, movements, elsewhere,
            tuple(self.pending.notes), largest_gap, seconds,
        )  # fmt: skip
        if len(self.passes) > 1:  # a curve may have gone away and come back
            return Step(name, structural=False, body=notes.body())
        return Step.told_later(name, self.journal, changed, curves, notes)

    def change(self) -> TableChange:
        """Give what the edit has changed: of numbers, and of how far fairing took points."""
        numbers, faired = self.numbers, self.document.state.rows.faired
        found = change_of_shape(
            numbers.runner, numbers.published.values, numbers.values, self.runs, self.ridden
        )
        if any(each is faired for each in self.journal.columns()):
            rows, bits = net_bits(self.journal, faired)
            if len(rows):
                found = attrs.evolve(found, bits={**found.bits, "rows.faired": (rows, bits)})
        return found

    def publish(self) -> None:
        """Keep the numbers of what has just been published."""
        self.document.program.publish(
            self.document.state.published(), self.numbers, self.runs, self.ridden
        )

    def take_back(self) -> None:
        """Put the published numbers back, for the next edit."""
        values, published = self.numbers.values, self.numbers.published.values
        values.base[self.ridden] = published.base[self.ridden]
        values.anchor_from[self.ridden] = published.anchor_from[self.ridden]
        for each in self.runs:
            self.numbers.restore(each)
        self.numbers.written = False
        self.document.program.spare = self.numbers

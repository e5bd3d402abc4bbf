"""The program of a hull and its published numbers, at hand until the tables change.

What runs on it works on numbers of its own, so any number of drags stand beside one another and
beside the tables, which are only read. The edits of a hull share one set of such numbers: when one
is published its numbers become the published ones, and those before are brought up to date where it
has written, so that nothing as large as the hull is copied. Numbers that a drag looks at are left.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from operator import attrgetter, is_not
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.graph.derived import Gate, Objects
from assoc_hull.graph.journal import each_once
from assoc_hull.model.index import Index
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.program.engine import runner_of
from assoc_hull.model.program.run_program import NumpyProgram, ProgramRun, RunProgram
from assoc_hull.model.program.structure import Program, PublishedProgram, Values, compile_program
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "HasProgram",
    "KeptProgram",
    "LiveNumbers",
    "known_numbers",
    "numbers_for_edit",
    "published_program",
]


@attrs.define(eq=False)
class LiveNumbers:
    """Numbers of a hull that are tried, and put back or published."""

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
        return self.told_splines(curves)[0]

    def told_splines(self, curves: IntArray) -> tuple[SplineBatch, NDArray[np.bool_]]:
        """Give these curves, and which differ from the published ones."""
        return self.runner.splines(self.values, self.published.values, curves)


@attrs.define(eq=False)
class _AtHand:
    """A published state, what runs on it, and the net as it was when that was compiled.

    `lent`: so many others may look at the numbers, which stay as they are until none does.
    """

    state: HullState
    found: PublishedProgram
    net: HullNetwork
    lent: int


@attrs.define(eq=False)
class KeptProgram:
    """What a hull keeps of its program: the numbers published last, and those for the next edit.

    `asked` counts how often edits have asked for the program of one structure.
    """

    at_hand: _AtHand | None = None
    spare: LiveNumbers | None = None
    asked: int = 0
    index: Index | None = None
    gate: Gate = attrs.field(factory=Gate)

    def __reduce__(self) -> tuple[type[KeptProgram], tuple[()]]:
        # In another process, or in a copy, it is made anew.
        return KeptProgram, ()

    def numbers_of(self, published: PublishedProgram) -> LiveNumbers:
        """Give numbers to be tried by somebody who has the published ones, until `give_back`."""

        def take() -> LiveNumbers | None:
            spare = self.spare
            if spare is None or spare.written or spare.published is not published:
                return None
            self.spare = None
            return spare

        return self.gate.alone(take) or LiveNumbers.of(published)

    def give_back(self, numbers: LiveNumbers) -> None:
        """Take numbers back of somebody who looks at them and at the published ones no more."""

        def act() -> None:
            at = self.at_hand
            if at is None or at.found is not numbers.published or not at.lent:
                return
            at.lent -= 1
            if self.spare is None and not numbers.written:
                self.spare = numbers

        self.gate.alone(act)

    def asked_for(self, index: Index) -> int:
        """Count that an edit asks for the program; look-ups are made anew with the structure."""
        self.asked = self.asked + 1 if index is self.index else 1
        self.index = index
        return self.asked

    def replace(self, one: _AtHand, other: _AtHand) -> bool:
        """Put other numbers in place of some; tell whether nobody else has these, or can get them.

        Then they may become those that the next edit writes.
        """

        def act() -> bool:
            if self.at_hand is not one:
                return False
            self.at_hand = other
            return one.lent == 0

        return self.gate.alone(act)

    def publish(
        self, state: HullState, numbers: LiveNumbers, runs: Sequence[ProgramRun], ridden: IntArray
    ) -> None:
        """Say that the tables have just been published with numbers that runs have made.

        `ridden` (k,) are points that ride from elsewhere than before.
        """
        before, values = numbers.published, numbers.values
        found = PublishedProgram(before.program, values)
        freeze(*_arrays(values))

        at, self.spare = self.at_hand, None
        if at is None or at.found is not before:
            return
        if not self.replace(at, _AtHand(state, found, at.net, lent=0)):
            return
        spare = before.values
        _make_writeable(spare)
        for run in runs:
            numbers.runner.restore(spare, values, run)
        spare.base[ridden], spare.anchor_from[ridden] = (
            values.base[ridden], values.anchor_from[ridden],
        )  # fmt: skip
        self.spare = LiveNumbers(found, spare, numbers.runner)


class HasProgram(Protocol):
    """A hull that keeps its program."""

    program: KeptProgram

    @property
    def state(self) -> HullState:
        """The tables."""

    def index_of(self, state: HullState) -> Index:
        """Look-ups derived from a published state of them."""


def published_program(
    document: HasProgram, state: HullState | None = None
) -> PublishedProgram | None:
    """Give the program of a published state; None of a hull with curves that cannot be made.

    That is the present one if none is given. Its numbers stay as they are for ever.
    """
    at = _at_hand(document, document.state.published() if state is None else state, lend=True)
    return None if at is None else at.found


def known_numbers(document: HasProgram) -> tuple[Program, Values] | None:
    """Give the program with its published numbers if they are at hand, to be read at once.

    For whoever has the right to write, and has not written yet.
    """
    kept, state = document.program, document.state.published()

    def known() -> tuple[Program, Values] | None:
        at = kept.at_hand
        return (at.found.program, at.found.values) if at and at.state is state else None

    return kept.gate.alone(known)


def numbers_for_edit(document: HasProgram) -> tuple[LiveNumbers, HullNetwork] | None:
    """Give numbers for whoever writes the tables, and the net as the engine sees it.

    Of the net only the structure is looked at: its numbers may be those of an earlier state.
    """
    at = _at_hand(document, document.state.published(), lend=False)
    if at is None:
        return None
    spare, document.program.spare = document.program.spare, None
    if spare is None or spare.published is not at.found or spare.written:
        spare = LiveNumbers.of(at.found)
    if isinstance(spare.runner, NumpyProgram):  # the compiled form may have come meanwhile
        spare.runner = runner_of(at.found.program)
    return spare, at.net


def _at_hand(document: HasProgram, state: HullState, *, lend: bool) -> _AtHand | None:
    """Give the program with the numbers of a published state."""
    kept = document.program

    def known() -> _AtHand | None:
        at = kept.at_hand
        if at is None or at.state is not state:
            return None
        at.lent += lend
        return at

    carried = None if lend else partial(_carry, document, state)
    return kept.gate.alone(known) or (carried and carried()) or _find(document, state, lend)


def _net_of(state: HullState, index: Index) -> HullNetwork:
    """Give the net that a structure was compiled of; the very same while it stays."""
    return state.derived(
        ("net",), _structure(state, index), lambda: HullNetwork(state, index), most=1
    )


def _carry(document: HasProgram, state: HullState) -> _AtHand | None:
    """Bring the numbers at hand to another state of the same net, as after undo: where it differs.

    None if there are none that may be written to. For whoever has the right to write.
    """
    kept = document.program

    def take() -> tuple[_AtHand, LiveNumbers] | None:
        at, spare, kept.spare = kept.at_hand, kept.spare, None
        if at is None or spare is None or spare.written or spare.published is not at.found:
            return None
        return at, spare

    taken = kept.gate.alone(take)
    if taken is None or taken[0].net is not _net_of(state, document.index_of(state)):
        return None
    at, spare = taken
    differs = _Difference.between(at.found.program, at.state, state)
    differs.put(spare.values)
    freeze(*_arrays(spare.values))
    found = PublishedProgram(at.found.program, spare.values)
    now = _AtHand(state, found, at.net, lent=0)
    if kept.replace(at, now):
        before = at.found.values
        _make_writeable(before)
        differs.put(before)
        kept.spare = LiveNumbers(found, before, spare.runner)
    return now


@attrs.frozen(eq=False)
class _Difference:
    """Where a state differs from another one of the same net.

    Attributes
    ----------
    rows : (k,) int
        Points that may lie elsewhere.
    curves : (l,) int
        Curves, as the program counts them, with another shape or other meetings.
    ridden : (m,) int
        Points that ride from elsewhere.
    """

    program: Program
    state: HullState
    rows: IntArray
    curves: IntArray
    ridden: IntArray

    @classmethod
    def between(cls, program: Program, one: HullState, other: HullState) -> _Difference:
        """Compare objects by their identity, and places by the notes of writes."""
        odd = np.zeros(other.curves.count, np.bool_)
        for name in ("spline", "meets"):
            pair = (getattr(each.curves, name).data for each in (one, other))
            odd |= np.fromiter(map(is_not, *pair), np.bool_, len(odd))
        mine, old = other.rows, one.rows
        ridden = mine.base.differing(old.base), mine.anchor_from.differing(old.anchor_from)
        return cls(
            program, other, mine.xyz.differing(old.xyz), np.flatnonzero(odd[program.number]),
            each_once(ridden),
        )  # fmt: skip

    def put(self, values: Values) -> None:
        """Bring numbers of the one to the other."""
        program, table = self.program, self.state.rows
        values.xyz[self.rows] = table.xyz.take(self.rows)
        values.base[self.ridden] = table.base.take(self.ridden)
        values.anchor_from[self.ridden] = table.anchor_from.take(self.ridden)
        _put_curves(values, program, self.state, self.curves.tolist())
        on_curves = [
            program.watched[a:b] for a, b in zip(
                program.watch_start[self.curves].tolist(),
                program.watch_start[self.curves + 1].tolist(), strict=True,
            )
        ]  # fmt: skip
        watched = np.concatenate([np.zeros(0, np.int64), *on_curves])
        values.gap[watched] = table.gap[program.watch[watched]]


def _find(document: HasProgram, state: HullState, lend: bool) -> _AtHand | None:
    """Compile, where the structure is another than before; and read what has changed."""
    index, kept = document.index_of(state), document.program
    net = _net_of(state, index)
    program = state.derived(("program",), (net,), lambda: compile_program(state, index), most=1)
    if program is None:
        return None
    last = _last(state, program)
    values = _numbers(state, program, lambda: _read(state, program, last.read))
    last.read = _Read(values, *_objects(state, program))
    # Derived numbers are kept by the tables as well, so they are never written to again.
    at = _AtHand(state, PublishedProgram(program, values), net, lent=1 + lend)

    def keep() -> None:
        kept.at_hand = at

    kept.gate.alone(keep)
    return at


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


_arrays: Callable[[Values], tuple[NDArray[np.generic], ...]] = attrgetter(
    *(each.name for each in attrs.fields(Values))
)


def _numbers(state: HullState, program: Program, make: Callable[[], Values]) -> Values:
    """Give the numbers of the tables as they were read last, if they still hold."""
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
    _put_curves(values, program, state, odd)
    values.gap[:] = table.gap[program.watch]
    freeze(*_arrays(values))
    return values


def _put_curves(values: Values, program: Program, state: HullState, odd: Sequence[int]) -> None:
    """Write curves, as the program counts them, and their meetings as they are in the tables."""
    numbers = [int(program.number[i]) for i in odd]
    splines, met = [state.spline(each) for each in numbers], state.curves.meets.data
    for i, number, spline in zip(odd, numbers, splines, strict=True):
        a, b = program.start[i : i + 2].tolist()
        first, stop = program.meet_start[i : i + 2].tolist()
        block, meets = values.block[9 * a : 9 * b].reshape(9, b - a), met[number]
        block[:3], block[3:6], block[6:] = spline.xyz.T, spline.leave.T, spline.arrive.T
        values.knot[a:b] = spline.knot
        values.at[first:stop], values.place[first:stop] = meets.parameter, meets.xyz
        values.segment[first:stop] = spline.knot[1:-1].searchsorted(meets.parameter, "right")
    if splines:
        batch = SplineBatch.join(splines)
        values.folds[odd] = np.bincount(curve_folds(batch).curve, minlength=len(odd))
        values.lowest[odd] = np.minimum.reduceat(batch.xyz[:, 1], batch.start[:-1])


def _make_writeable(values: Values) -> None:
    """Let numbers be written to that nobody else has."""
    for each in _arrays(values):
        each.setflags(write=True)

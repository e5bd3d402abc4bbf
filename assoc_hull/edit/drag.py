"""The live drag: a point is moved or pulled again and again, and nothing is published.

Each `Drag.to` runs the program of the net on numbers of its own: the tables are only read. Where
the structure would change, or the run has a doubt, it carries out the whole edit on the tables,
reads what came of it, and takes it back to the last bit: no step, no revision, no write to a file.
Both ways give the same bits. `Drag.commit` makes the edit that the last `to` asked for.
"""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Callable, Iterator
from functools import cached_property
from types import TracebackType
from typing import Literal, Self

import attrs
import numpy as np

from assoc_hull.arguments import choice, flag, pair, shown, text
from assoc_hull.edit.arguments import GivenObjects
from assoc_hull.edit.dirty_objects import Dirty
from assoc_hull.edit.displacement_field import (
    CLOSE,
    FieldContext,
    PullField,
    sub_step_count,
)
from assoc_hull.edit.document import Document
from assoc_hull.edit.hull_normals import normals_at
from assoc_hull.edit.modifications.points import PointFreedom
from assoc_hull.edit.modifications.pull import curves_to_hold, pull_field
from assoc_hull.edit.published_program import LiveNumbers, published_program
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.session import Edit, refusal_of
from assoc_hull.edit.shapes import HullShapes, chosen_curves, joined, section_areas
from assoc_hull.edit.step import EditReport, Step
from assoc_hull.edit.write_lock import PATIENCE, WriteLock
from assoc_hull.errors import AssocHullError, BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import address
from assoc_hull.model.dirty_nodes import CLEAN
from assoc_hull.model.gaps import watched_on
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import free_axes
from assoc_hull.model.objects import Point
from assoc_hull.model.program.run_program import Doubt, ProgramRun, features_left, write_points
from assoc_hull.model.program.structure import KEEP_THEIR_SHAPE
from assoc_hull.model.tables import HullState

__all__ = ["Drag", "DragWay", "Live"]

DragWay = Literal["pull", "move"]


@attrs.frozen(eq=False, slots=False)
class Live:
    """What a hull would be if the drag ended here; relative to the published state.

    Attributes
    ----------
    refused : tuple of str
        Why the edit would be refused; then all else is empty.
    curves : (k,) int
        Numbers of the curves that changed, ascending, as `Hull.shapes` has them.
    spline : SplineBatch
        Of exactly these, in that order.
    born, gone : tuple of str
        Keys of points that the hull would have more, and would have no more; a drag makes and
        takes no curves.
    rows, xyz : (n,) int, (n, 3) m
        Points of the published hull that changed their place, watched crossings too, and where
        they would be.
    relofted : int
        Curves that were lofted.
    report : EditReport or None
        The report that the edit would have; made when it is first asked for, and None where the
        hull has been changed by then, or another thread is at work on it.
    seconds : float
        How long it took, by the clock.
    """

    refused: tuple[str, ...]
    curves: IntArray
    spline: SplineBatch
    born: tuple[str, ...]
    gone: tuple[str, ...]
    rows: IntArray
    xyz: FloatArray
    relofted: int
    seconds: float
    _before: HullShapes = attrs.field(repr=False)
    _tell: Callable[[], EditReport | None] = attrs.field(repr=False)
    _told: list[EditReport] = attrs.field(factory=list, init=False, repr=False)

    @property
    def report(self) -> EditReport | None:
        """The report that the edit would have."""
        # None is not kept: somebody may just be writing who takes it all back.
        if not self._told and (found := self._tell()) is not None:
            self._told.append(found)
        return self._told[0] if self._told else None

    @cached_property
    def moved(self) -> FloatArray:
        """How far each of `curves` lies off its published shape at most, (k,), m.

        Of its defining points the distance of the farthest from the curve as it is published: what
        slides along the curve has not moved. nan for a curve that is new.
        """
        return self._before.distances(self.curves, self.spline)

    @cached_property
    def sections(self) -> IntArray:
        """Those of `curves` that belong to plane sections across the ship, ascending."""
        found: IntArray = self.curves[np.isin(self.curves, self._before.section_curves)]
        return found

    @cached_property
    def areas(self) -> FloatArray:
        """Area of the half section within each of `sections`, below the design draught, m2."""
        chosen = np.flatnonzero(np.isin(self.curves, self.sections))
        return section_areas(chosen_curves(self.spline, chosen), self._before.draught)

    @cached_property
    def volume_change(self) -> float:
        """About how much the volume below the design draught changes, both sides, m3.

        Trapezes between the sections that changed and those beside them; the exact number is that
        of `Hull.preview`.
        """
        return self._changes[0]

    @cached_property
    def lcb_change(self) -> float:
        """About how much the centre of buoyancy moves, m, forward positive; nan at no volume."""
        return self._changes[1]

    @cached_property
    def _changes(self) -> tuple[float, float]:
        return self._before.changes(self.curves, self.spline)


def _moved(rows: IntArray, watched: IntArray, before: FloatArray, now: FloatArray) -> IntArray:
    """Add the watched crossings that have moved with their curves to points that changed."""
    # The run measures them anyway; nothing depends on them, so it does not count them.
    watched = watched[(now[watched] != before[watched]).any(axis=1)]
    found: IntArray = np.sort(np.concatenate([rows, watched]))
    return found


def _come_and_gone(step: Step, state: HullState) -> tuple[IntArray, IntArray]:
    """Give the points that a step has made, and those that it has taken away."""
    assert isinstance(step.journal, Journal), "a step that has just been made holds its writes"
    lives = step.journal.net(state.rows.alive)
    return lives.rows[lives.new & ~lives.old], lives.rows[lives.old & ~lives.new]


@attrs.frozen(eq=False)
class _QuickWay:
    """What a drag reads once of the hull as it is, so that each step is one run of the program."""

    numbers: LiveNumbers
    state: HullState
    row: int
    freedom: PointFreedom | None
    pull: PullField | None
    ground: FieldContext | None

    @classmethod
    def of(
        cls, document: Document, state: HullState, row: int, how: DragWay,
        radius: tuple[float, float] | None, across_flats: bool,
    ) -> Self | None:  # fmt: skip
        """Give what is read of a published state; None where every step has to go the full way."""
        published = published_program(document, state)
        if published is None:
            return None
        numbers = document.program.numbers_of(published)
        found = None
        try:
            if how == "move":
                # An adopted point becomes a placed one: another structure.
                if state.rows.sort[row] != Sort.ADOPTED:
                    found = cls(numbers, state, row, PointFreedom.of(state, row), None, None)
            else:
                mine = published.program, published.values
                pull = pull_field(state, row, 1.0, radius, across_flats=across_flats, numbers=mine)
                if not curves_to_hold(state, row):
                    ground = FieldContext(state, across_flats, mine)
                    found = cls(numbers, state, row, None, pull, ground)
        except AssocHullError:
            found = None  # each step says why
        finally:
            if found is None:
                document.program.give_back(numbers)
        return found

    def written(self, asked: dict[str, float]) -> tuple[IntArray, FloatArray] | None:
        """Give the points that an edit writes, and their places; None if it is refused or large."""
        table = self.state.rows
        try:
            if self.freedom is not None:
                return np.array([self.row]), self.freedom.place(asked)[None]
            if self.pull is None or self.ground is None or asked["d"] == 0.0:
                return np.array([self.row]), table.xyz[[self.row]]
            shift = attrs.evolve(self.pull, amount=asked["d"]).shift(self.ground, 1.0)
            if sub_step_count(self.state, shift) > 1:
                return None
        except (AssocHullError, ArithmeticError):
            return None
        return shift.rows, table.xyz[shift.rows] + shift.delta

    @contextlib.contextmanager
    def tried(
        self, rows: IntArray, places: FloatArray, amount: float
    ) -> Iterator[ProgramRun | None]:
        """Run with points elsewhere; None where the run does not answer for the edit.

        `amount` is how far the point was pulled, m; nil where it was moved.
        """
        numbers, table = self.numbers, self.state.rows
        numbers.begin()
        moved = write_points(numbers.values, rows, places)
        # What a field has moved does not ride in the same edit.
        held = moved[table.sort[moved] == Sort.ADOPTED] if self.pull else moved[:0]
        run = numbers.run(moved, held)
        try:
            yield run if self._answers(run) and self._has_arrived(amount) else None
        finally:
            numbers.restore(run)

    def _answers(self, run: ProgramRun) -> bool:
        """Tell whether the numbers of a run are those of the edit.

        What has come off a feature by little is drawn anew by the edit, which the run knows
        nothing of; farther off, the edit only lets go of the feature.
        """
        if run.doubt is not Doubt.FEATURE:
            return run.kept
        program, values = self.numbers.published.program, self.numbers.values
        left, off = features_left(program, values, run.rows)
        # An arc is drawn on its moved ends, and measured off there: only the edit itself can tell.
        known = np.isin(program.features.shape[left], KEEP_THEIR_SHAPE)
        return bool(known.all() and (off > self.state.tolerances.adoption).all())

    def _has_arrived(self, amount: float) -> bool:
        """Tell whether the point came where it was pulled, so that no more sub-steps follow."""
        if self.pull is None or amount == 0.0:
            return True
        way = self.numbers.values.xyz[self.row] - self.pull.place
        reached = float((way * self.pull.normal).sum())
        return abs(1.0 - reached / amount) <= CLOSE


_NUMBERS = (float, int, np.floating, np.integer)

_LARGEST = 1e6
"""What an edit takes at most, m: see `assoc_hull.arguments.number`."""


def _as_float(value: float) -> float:
    """Give a number; one that is too large for one is infinite, and refused as that is."""
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


class _SeenError(Exception):
    """Ends an edit of which all has been seen before it is carried out."""


class Drag:
    """One point of a hull while it is dragged, to be used in a ``with`` statement.

    `Hull.drag` makes it. Leaving the block without `commit` changes nothing.

    Attributes
    ----------
    start : (3,), m
        Where the point lies.
    free : tuple of str
        The coordinates it may be moved in; empty for one that is computed, which may be pulled.
    normal : (3,) or None
        Outward unit normal of the hull there; None where it is not known.
    radius : (float, float) or None, m
        Of a pull: how far along the length and the girth it is felt; None of a move, and where the
        hull cannot be pulled.
    """

    def __init__(
        self,
        document: Document,
        point: Point | str,
        how: DragWay = "pull",
        radius: tuple[float, float] | None = None,
        *,
        across_flats: bool = False,
        settings: Settings | None = None,
    ) -> None:
        choice(how, "how", ("pull", "move"), "in drag")
        flag(across_flats, "across_flats", "in drag")
        if radius is not None:
            if how == "move":
                what, remedy = "a radius was given to a drag that moves", "leave it out, or pull"
                raise BadInputError(what, "in drag", remedy)
            radius = pair(radius, "radius", "in drag", positive=True)
        self._how: DragWay = how
        self._document, self._settings = document, settings
        document.require_ended("drag")
        state = document.state.published()
        row, _ = GivenObjects(state).point(point)
        self._name = address(state, row)
        self._radius, self._across_flats = radius, across_flats
        self.start: FloatArray = state.rows.xyz[row].copy()
        computed = state.rows.sort[row] == Sort.CROSSING
        computed &= state.rows.role[row] != Role.SHARED
        self.free = () if computed else free_axes(state, row)
        normal = normals_at(state, np.array([row]))[0]
        self.normal: FloatArray | None = normal.copy() if (normal != 0.0).any() else None
        freeze(self.start, *([] if self.normal is None else [self.normal]))
        self._row, self._number, self._last = row, state.number, dict[str, float]()
        self._quick = self._quick_way(state)
        self._given_back = False
        self.radius = self._felt(state, radius, across_flats)
        self._published = HullShapes.of(state)
        self._over, self._stop_asked, self._turn = False, False, WriteLock()

    def _felt(
        self, state: HullState, radius: tuple[float, float] | None, across_flats: bool
    ) -> tuple[float, float] | None:
        """Give how far a pull is felt; None where each `to` will say why it is refused."""
        if self._how == "move":
            return None
        field = None if self._quick is None else self._quick.pull
        try:
            if field is None:
                field = pull_field(state, self._row, 1.0, radius, across_flats=across_flats)
        except AssocHullError:
            return None
        return field.radius

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._over = True
        # Where another thread is in the middle of a step, that one keeps what it works on.
        with contextlib.suppress(AssocHullError), self._one_at_a_time("the end", wait=0.0):
            self._give_back()

    def _give_back(self) -> None:
        """Let go of the numbers and of the tables of the published hull: an edit may use them."""
        # First, so that whoever breaks in leaves a drag that takes them again.
        self._given_back = self._given_back or self._quick is not None
        quick, self._quick = self._quick, None
        if quick is not None:
            self._document.program.give_back(quick.numbers)

    def _quick_way(self, state: HullState) -> _QuickWay | None:
        """Give what makes steps quick, of the published hull."""
        return _QuickWay.of(
            self._document, state, self._row, self._how, self._radius, self._across_flats
        )

    def _take_again(self) -> None:
        """Begin anew on the hull, which is as it was; after a commit that was refused."""
        state, self._given_back = self._document.state.published(), False
        if state.number == self._number:
            self._quick = self._quick_way(state)

    def to(
        self,
        d: float | None = None,
        *,
        x: float | None = None,
        y: float | None = None,
        z: float | None = None,
    ) -> Live:
        """Carry out the edit, read it, and take it back.

        Parameters
        ----------
        d : float, m
            How far to pull, outward positive; of a drag that pulls.
        x, y, z : float, m
            Where to move to; of a drag that moves, exactly the coordinates of `free`.

        Returns
        -------
        Live
            What changed, or why it is refused.

        Raises
        ------
        BadInputError
            The drag has ended, another edit is open or was made meanwhile, or arguments do not
            fit the drag.
        WrongTypeError
            An argument is no number.
        """
        with self._one_at_a_time("to"):
            self._require_open("to")
            self._last = self._arguments({"d": d, "x": x, "y": y, "z": z})
            self._stop_asked = False
            begin = time.perf_counter()
            found = self._run() or self._full()
            return attrs.evolve(found, seconds=time.perf_counter() - begin)

    @contextlib.contextmanager
    def _one_at_a_time(self, act: str, wait: float = PATIENCE) -> Iterator[None]:
        """Let another thread wait until this one's step is over: they work on the same numbers."""
        holder, where = object(), f"in {act} of the drag of {self._name}"
        try:
            self._turn.take(holder, f"the drag of {self._name}", where=where, wait=wait)
            yield
        finally:
            self._turn.give_back(holder)

    def _run(self) -> Live | None:
        """Run the program; None where that does not answer for the whole edit."""
        if self._given_back:
            self._take_again()
        if self._quick is None or self._document.lock.held:
            return None
        asked = self._last
        if not all(abs(value) <= _LARGEST for value in asked.values()):
            return None  # also of nan: the full way says what is wrong
        written = self._quick.written(asked)
        if written is None:
            return None
        with self._quick.tried(*written, asked.get("d", 0.0)) as run:
            if run is None:
                return None
            return self._live(run, self._quick.numbers) if len(run.rows) else self._nothing(())

    def _live(self, run: ProgramRun, numbers: LiveNumbers) -> Live:
        """Read what a run has made of the numbers."""
        program = numbers.published.program
        number = program.number[run.curves]
        order = np.argsort(number)
        curves, asked = number[order], dict(self._last)
        before = numbers.published.values.xyz
        rows = _moved(run.rows, program.watch[run.watched], before, numbers.values.xyz)
        spline, xyz = numbers.splines(run.curves[order]), numbers.values.xyz[rows]
        freeze(curves, rows, xyz)
        return Live((), curves, spline, (), (), rows, xyz, len(curves), 0.0, self._published,
                    lambda: self._report_of(asked))  # fmt: skip

    def _report_of(self, asked: dict[str, float]) -> EditReport | None:
        """Give the report of an edit that was tried, if the hull is as it was then."""
        document = self._document
        if document.lock.held or document.state_number != self._number:
            return None
        seen = list[Step | None]()
        with Edit(document, "drag", self._settings, look=seen.append) as trial:
            self._ask(trial, asked)
        return None if seen[0] is None else seen[0].report

    def _full(self) -> Live:
        """Carry out the whole edit, read it, and take it back."""
        seen = list[Live]()
        trial = Edit(
            self._document, "drag", self._settings,
            look=lambda step: seen.append(self._look(step)), stopped=lambda: self._stop_asked,
        )  # fmt: skip
        try:
            with trial:
                self._ask(trial, self._last)
        except AssocHullError as error:
            seen = [self._nothing(refusal_of(error))]
        return seen[0]

    def commit(self, name: str) -> EditReport:
        """Make the edit that the last `to` asked for, and end the drag.

        Raises
        ------
        BadInputError
            Nothing was asked for; as for `to`.
        RefusedEditError, PointRoleError, FreedomError
            What the last `to` told as refused; the hull is as it was.
        """
        text(name, "the name", "in commit")
        with self._one_at_a_time("commit"):
            self._require_open("commit")
            if not self._last:
                what, remedy = "nothing was asked for", "call to before"
                raise BadInputError(what, f"in the drag of {self._name}", remedy)
            edit = Edit(self._document, name, self._settings)
            self._give_back()
            with edit:
                # Another may have come first while this one waited for the hull.
                self._require_its_ground("commit")
                self._ask(edit, self._last)
            self._over = True
        assert edit.report is not None
        return edit.report

    @property
    def dirty(self) -> Dirty:
        """What the last `to` asked for reaches, as `Hull.dirty` tells of an edit; first nothing.

        Raises
        ------
        BadInputError
            As of `to`: the drag has ended, or the hull was changed meanwhile.
        """
        with self._one_at_a_time("dirty"):
            self._require_open("dirty")
            state, found = self._document.state, Dirty(self._document.state, CLEAN)
            if self._last:
                trial = Edit(self._document, "drag", self._settings, look=lambda _: None)
                with contextlib.suppress(_SeenError), trial:
                    with contextlib.suppress(AssocHullError):
                        self._ask(trial, self._last)
                    found = Dirty(state, state.dirty_here())
                    raise _SeenError
            return found

    def stop(self) -> None:
        """End a `to` that is in progress, at its next sub-step; from any thread.

        It is told as refused. The next `to` runs as usual.
        """
        self._stop_asked = True

    def _require_open(self, act: str) -> None:
        """Refuse a drag that is over, or whose ground has changed."""
        self._document.require_ended(act)
        if self._over:
            where = f"in {act} of the drag of {self._name}"
            raise BadInputError("it has ended", where, "begin another one (hull.drag)")
        self._require_its_ground(act)

    def _require_its_ground(self, act: str) -> None:
        if self._document.state_number != self._number:
            what, where = "the hull was changed since the drag began", f"in {act} of the drag of"
            raise BadInputError(what, f"{where} {self._name}", "begin another one (hull.drag)")

    def _arguments(self, given: dict[str, float | None]) -> dict[str, float]:
        """Take what was given; a drag takes d, or coordinates."""
        asked: dict[str, float] = {
            name: value for name, value in given.items() if value is not None
        }
        fits = set(asked) == {"d"} if self._how == "pull" else bool(asked) and "d" not in asked
        if not fits:
            wanted = "d" if self._how == "pull" else ", ".join(self.free) or "no coordinate"
            what = f"{', '.join(asked) or 'nothing'} was given to a drag that {self._how}s"
            raise BadInputError(what, f"in to of the drag of {self._name}", f"give {wanted}")
        for name, value in asked.items():
            if isinstance(value, bool | np.timedelta64) or not isinstance(value, _NUMBERS):
                what = f"{name} is {shown(value)}"
                raise WrongTypeError(what, f"in to of the drag of {self._name}", "give a number")
            asked[name] = _as_float(value)
        return asked

    def _ask(self, edit: Edit, asked: dict[str, float]) -> None:
        """Ask an edit for what a `to` asked for."""
        if self._how == "pull":
            edit.pull(self._name, asked["d"], self._radius, across_flats=self._across_flats)
        else:
            edit.move(self._name, lead=False, **asked)

    def _nothing(self, refused: tuple[str, ...]) -> Live:
        none, nowhere = np.zeros(0, np.int64), np.zeros((0, 3))
        return Live(refused, none, joined([]), (), (), none, nowhere, 0, 0.0, self._published,
                    lambda: None)  # fmt: skip

    def _look(self, step: Step | None) -> Live:
        """Read what an edit has done to the tables, before it is taken back."""
        if step is None:
            return self._nothing(())
        state = self._document.state
        curves = step.curves[state.curves.alive[step.curves]]
        rows = step.rows[state.rows.alive[step.rows]]
        born, gone = _come_and_gone(step, state)
        known = rows[~np.isin(rows, born)]
        watched = np.setdiff1d(watched_on(state, curves), np.concatenate([known, born]))
        known = _moved(known, watched, state.published().rows.xyz.data, state.rows.xyz.data)
        key = state.rows.key.data
        spline = joined([state.spline(curve) for curve in curves.tolist()])
        xyz = state.rows.xyz[known]
        freeze(curves, known, xyz)
        return Live(
            (), curves, spline, tuple(key[row] for row in born.tolist()),
            tuple(key[row] for row in gone.tolist()), known, xyz, len(step.report.relofted),
            0.0, self._published, lambda: step.report,
        )  # fmt: skip

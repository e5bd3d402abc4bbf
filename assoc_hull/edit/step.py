"""One committed edit and its report: what undo and redo run, and what tells why.

What an edit did, as data: what was re-lofted and why, what moved, what remains.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol, TypeVar

import attrs

from assoc_hull.display import (
    Printer,
    ShownAsText,
    counted,
    html_room,
    html_table,
    screenful,
    shortened,
)
from assoc_hull.edit.recording import Script
from assoc_hull.errors import DamagedFileError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.graph.derived import Gate
from assoc_hull.graph.run_update import Readers, distinct
from assoc_hull.model.change import TableChange, apply_change
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = [
    "SAME_MOVEMENT",
    "Counting",
    "EditReport",
    "EditReports",
    "Fairness",
    "FormChange",
    "Led",
    "Movement",
    "Notes",
    "Past",
    "Rerun",
    "Step",
    "StepBody",
    "Writes",
    "change_text",
    "movement_words",
]

Inflections = tuple[tuple[str, int], ...]

FormChange = tuple[str, str, float | None, float | None]
"""Name of a definition, name of a value, what it was, what it is."""


class Counting(Protocol):
    """What can count inflections when asked."""

    def added(self) -> Inflections:
        """Give the curves with more curvature sign changes than before, and how many."""


@attrs.frozen(eq=False)
class Fairness:
    """Splines of the re-lofted curves before and after an edit, for counting when asked.

    Attributes
    ----------
    before, after : dict of int to SplineBatch
        By number of curve; a new curve has no spline before.
    normals : (k, 3)
        Unit normals of the planes of `curves`.
    curves, keys : (k,) int, tuple of str
        The curves.
    """

    before: dict[int, SplineBatch]
    after: dict[int, SplineBatch]
    normals: FloatArray
    curves: IntArray
    keys: tuple[str, ...]

    def added(self) -> tuple[tuple[str, int], ...]:
        """Give the curves with more curvature sign changes than before, and how many."""
        known = [i for i, curve in enumerate(self.curves.tolist()) if curve in self.before]
        if not known:
            return ()
        numbers, normals = self.curves[known].tolist(), self.normals[known]
        old = SplineBatch.join([self.before[curve] for curve in numbers])
        new = SplineBatch.join([self.after[curve] for curve in numbers])
        more = inflections(new, normals)[0] - inflections(old, normals)[0]
        return tuple(
            (self.keys[i], int(count))
            for i, count in zip(known, more.tolist(), strict=True)
            if count > 0
        )


def change_text(change: FormChange) -> str:
    """Say how a value of a definition was changed.

    Examples
    --------
    >>> from assoc_hull.edit.step import change_text
    >>> change_text(("areas", "run_area", 0.51, None))
    'run_area 0.51 -> free'
    """
    _, name, old, new = change
    told = ["free" if value is None else f"{value:.10g}" for value in (old, new)]
    return f"{name} {told[0]} -> {told[1]}"


@attrs.frozen
class Movement:
    """The largest movement of an edit.

    Attributes
    ----------
    point : str
        Key of the point that moved farthest.
    distance : float, m
        How far.
    place : (float, float, float), m
        Where it lies now.
    name : str
        Its address, as ``WL 0.5 x ST 16``; empty in steps that older versions kept.
    """

    point: str
    distance: float
    place: tuple[float, float, float]
    name: str = ""


SAME_MOVEMENT = 0.05e-3
"""A slide that adds less (m) to the movement along the normal is not told: it prints alike."""


def movement_words(largest: Movement, normal: Movement | None) -> list[str]:
    """Say how far the hull moved along its normal, and by how much more a point slid on it.

    Examples
    --------
    >>> from assoc_hull.edit.step import Movement, movement_words
    >>> slid = Movement("P", 0.0813, (50.0, 4.0, 2.0))
    >>> movement_words(slid, Movement("Q", 0.01, (48.0, 4.1, 2.5)))[0]
    'largest movement 10.0 mm along the normal at Q (48.000, 4.100, 2.500) m'
    """
    if normal is None:
        return [f"largest movement {_movement_words(largest)}"]
    slid = largest.distance > normal.distance + SAME_MOVEMENT
    if slid and largest.point == normal.point:
        way = f" along the normal and {1e3 * largest.distance:.1f} mm in all"
        return [f"largest movement {_movement_words(normal, way)}"]
    told = [f"largest movement {_movement_words(normal, ' along the normal')}"]
    return [*told, f"with slides on the hull {_movement_words(largest)}"] if slid else told


def _movement_words(movement: Movement, way: str = "") -> str:
    x, y, z = movement.place
    distance = f"{1e3 * movement.distance:.1f} mm"
    # A key of the tables ("sections:97.536 x ...") is no word: the place alone says where.
    name = movement.name or ("" if ":" in movement.point else movement.point)
    return f"{distance}{way} at {name}{' ' * bool(name)}({x:.3f}, {y:.3f}, {z:.3f}) m"


@attrs.frozen
class Led:
    """A line that led, and what of its own followed.

    Attributes
    ----------
    line : str
        Key of the line.
    along : {"x", "z", "girth"}
        What the stretch is measured along.
    stretch : (float, float), m
        Where it could change.
    asked : tuple of (str, float)
        Keys of the points that were asked for, and how far each came along the outward normal, m.
    crossings : tuple of (str, float)
        Keys of the crossings of the line that followed, in their order along it, each so.
    """

    line: str
    along: str
    stretch: tuple[float, float]
    asked: tuple[tuple[str, float], ...]
    crossings: tuple[tuple[str, float], ...]


@attrs.frozen
class EditReport(ShownAsText):
    """The report of one committed edit.

    Attributes
    ----------
    name : str
        Name of the edit.
    changed : bool
        Whether the edit changed anything; if not, it added no step to the history.
    planned : int
        Curves that could at most be lofted in the main pass: the closure of what was set.
    relofted : tuple of str
        Keys of the curves that were lofted again, in order of the update.
    cut_off : int
        Nodes that were evaluated and came out as they were.
    born, gone : tuple of str
        Crossings that appeared and vanished.
    mended : tuple of str
        Curves that were given a point to close a gap.
    failed, blocked : tuple of str
        Objects that could not be made, and those made from them.
    largest : Movement or None
        The largest movement of any point; a crossing may only have slid along its curves.
    largest_normal : Movement or None
        The largest movement along the normal of the hull, or across the curve of a point that is
        on one alone; None if no point moved, and in steps that older versions kept.
    largest_gap : float, m
        The largest gap at the watched crossings that were checked.
    notes : tuple of str
        What was left alone, and why.
    carried, cut_again : tuple of str
        Keys of the lines that a mapping carried, and of those that were cut again from them.
    definitions : tuple of (str, str, float or None, float or None)
        Values of definitions that were set: name of the definition, name of the value, what it
        was, what it is.
    seconds : dict of str to float
        Time per phase.
    number : int
        Number of the step in the history, which it keeps; 0 before it is committed.
    author : str
        Who made the edit.
    time : str
        When it was committed, ISO 8601, UTC.
    fairness : Counting or None
        Counts `inflections`; None where it is `counted` already.
    counted : tuple of (str, int)
        What was counted.
    led : tuple of Led
        The lines that led.
    followed : tuple of (str, float)
        Keys of the lines that followed those, and the farthest way of a point of each along the
        outward normal, m.
    """

    name: str
    planned: int = 0
    relofted: tuple[str, ...] = ()
    cut_off: int = 0
    born: tuple[str, ...] = ()
    gone: tuple[str, ...] = ()
    mended: tuple[str, ...] = ()
    failed: tuple[str, ...] = ()
    blocked: tuple[str, ...] = ()
    largest: Movement | None = None
    largest_gap: float = 0.0
    notes: tuple[str, ...] = ()
    carried: tuple[str, ...] = ()
    cut_again: tuple[str, ...] = ()
    definitions: tuple[FormChange, ...] = ()
    seconds: dict[str, float] = attrs.field(factory=dict, eq=False)
    fairness: Counting | None = attrs.field(default=None, eq=False, repr=False)
    counted: Inflections = attrs.field(default=(), eq=False, repr=False)
    changed: bool = True
    largest_normal: Movement | None = None
    number: int = attrs.field(default=0, eq=False)
    author: str = attrs.field(default="", eq=False)
    time: str = attrs.field(default="", eq=False)
    led: tuple[Led, ...] = ()
    followed: tuple[tuple[str, float], ...] = ()

    @property
    def inflections(self) -> tuple[tuple[str, int], ...]:
        """Curves with more curvature sign changes than before, and how many more."""
        return self.counted if self.fairness is None else self.fairness.added()

    def __repr__(self) -> str:
        return f"<EditReport {self}>"

    def __str__(self) -> str:
        if not self.changed:
            return f"{self.name}: nothing changed, no step was added"
        parts = [f"{self.name}: {counted(len(self.relofted), 'curve')} re-lofted"]
        parts += [f"{each[0]}: {change_text(each)}" for each in self.definitions]
        if self.largest is not None:
            parts += movement_words(self.largest, self.largest_normal)
        parts.append(f"largest gap {1e3 * self.largest_gap:.2f} mm")
        if self.carried:
            parts.append(f"{len(self.carried)} lines carried, {len(self.cut_again)} cut again")
        for title in ("born", "gone", "mended", "failed", "blocked"):
            found = getattr(self, title)
            if found:
                parts.append(f"{len(found)} {title}")
        return "; ".join(parts)


class EditReports(tuple[EditReport, ...]):
    """Reports of edits, oldest first; a notebook shows them as a table."""

    __slots__ = ()

    def __repr__(self) -> str:
        count = counted(len(self), "edit")
        return f"<{count}: {shortened(', '.join(each.name for each in self))}>" if self else "()"

    def __str__(self) -> str:
        return "\n".join(f"{each.number:>4}  {each}" for each in self)

    def _repr_pretty_(self, printer: Printer, cycle: bool) -> None:
        printer.text(screenful(str(self) or "()") if not cycle else "...")

    def _repr_html_(self) -> str:
        rows = (
            (
                str(each.number), each.name, each.author, each.time[:16].replace("T", " "),
                str(len(each.relofted)),
                "" if each.largest is None else f"{1e3 * each.largest.distance:.1f}",
            )
            for each in self
        )  # fmt: skip
        head = ("step", "edit", "author", "time, UTC", "curves that followed", "most, mm")
        return html_room(html_table(head, rows, right=(0, 4, 5)))


B = TypeVar("B")
T = TypeVar("T")

_GATE = Gate()
"""For steps that one thread lets go of while another one makes their body."""


class Writes(Protocol):
    """All that an edit wrote, to be run backward and forward."""

    def back(self) -> None:
        """Take it back."""

    def forth(self) -> None:
        """Make it again."""


@attrs.frozen(eq=False)
class Rerun:
    """A change together with the tables that it runs over."""

    state: HullState
    change: TableChange

    def back(self) -> None:
        """Take it back."""
        self._run(forward=False)

    def forth(self) -> None:
        """Make it again."""
        self._run(forward=True)

    def _run(self, *, forward: bool) -> None:
        try:
            apply_change(self.state, self.change, forward=forward)
        except (ValueError, TypeError, LookupError, ArithmeticError, AttributeError) as error:
            what = f"the change of a step does not fit the hull ({type(error).__name__}: {error})"
            remedy = (
                "it is as it was; take it from another copy, or, if it is a copy, make it again "
                "while nobody edits, or by hull.save(other)"
            )
            raise DamagedFileError(what, "in the history", remedy) from error


@attrs.frozen(eq=False)
class StepBody:
    """The large part of a step.

    Attributes
    ----------
    journal : Writes
        All writes.
    cause : Readers
        Which node was evaluated because of which.
    changed : (k,) int
        Nodes that changed.
    moved : (k,) float, m
        By how much; nan for what the edit itself set.
    seeds : (s,) int
        Nodes that the edit set.
    report : EditReport
        The report.
    """

    journal: Writes
    cause: Readers
    changed: IntArray
    moved: FloatArray
    seeds: IntArray
    report: EditReport


class Past(Protocol):
    """Finds again how the tables were."""

    def tell(
        self, number: int, before: Callable[[HullState], B], after: Callable[[HullState, B], T]
    ) -> T:
        """Tell of a step from the tables before it and after it."""


class Notes(Protocol):
    """What makes the body of a step."""

    @property
    def lasting(self) -> bool:
        """Whether it holds nothing of this process alone."""

    def body(self) -> StepBody:
        """Make it."""

    def packed(self, past: Past, step: Step, writes: Writes) -> Notes:
        """Give notes that hold nothing which `past` finds again; `writes` are those of the step."""


@attrs.frozen(eq=False)
class _ToldLater:
    """What the history needs of a step whose body has not been asked for, and what makes that."""

    writes: Writes
    rows: IntArray
    curves: IntArray
    notes: Notes


@attrs.define(eq=False)
class Step:
    """One committed edit.

    Attributes
    ----------
    name : str
        Name of the edit.
    structural : bool
        Whether lines, points or roles came or went.
    number, parent : int
        Number of the step, and of the one it was made upon; 0 is the hull as it came. A step
        keeps its number, whatever is undone.
    script : Script
        What was asked for, so that it can be asked for again.
    fingerprint : str
        That of the hull after the step; empty where it has not been taken.
    load : callable or None
        Gives the body; the step then need not hold it.
    tell : callable or None
        Gives the report alone, which is a small part of the body.
    change : TableChange or None
        What it changed, of a hull in memory.
    """

    name: str
    structural: bool
    number: int = 0
    parent: int = 0
    script: Script = attrs.field(factory=Script)
    fingerprint: str = ""
    load: Callable[[], StepBody] | None = None
    tell: Callable[[], EditReport] | None = None
    change: TableChange | None = None
    _body: StepBody | None = None
    _later: _ToldLater | None = None
    _entry: tuple[str, str] | None = attrs.field(default=None, init=False)

    @classmethod
    def told_later(
        cls, name: str, writes: Writes, rows: IntArray, curves: IntArray, notes: Notes
    ) -> Step:
        """Give a step that keeps the structure, of which the body is made when it is asked for.

        `rows` and `curves` are the points and curves that changed, ascending.
        """
        return cls(name, structural=False, later=_ToldLater(writes, rows, curves, notes))

    def __getstate__(self) -> dict[str, object]:
        # What looks at the net of this process tells the body now.
        if self._later is not None and not self._later.notes.lasting:
            self.replace(self.body)
        return {each.name: getattr(self, each.name) for each in attrs.fields(Step)}

    def __setstate__(self, state: dict[str, object]) -> None:
        for name, value in state.items():
            setattr(self, name, value)

    @property
    def body(self) -> StepBody:
        """The large part; made or loaded where it is not held."""
        body, later = self._body, self._later
        if body is None:
            if later is not None:
                body = self._entered(later.notes.body())
                _GATE.alone(partial(self._hold, body, later))
            else:
                assert self.load is not None, "a step holds its body, or can load it"
                body = self.load()
                self.replace(body)
        return body

    def _hold(self, body: StepBody, later: _ToldLater) -> None:
        """Hold a body, unless what made it has been let go of meanwhile."""
        if self._later is later:
            self._body, self._later = body, None

    def replace(self, body: StepBody) -> None:
        """Hold another body."""
        # What is known besides goes last: another thread may be asking.
        self._body, self._later = self._entered(body), None

    def release(self) -> None:
        """Let go of the body, if it can be loaded again."""
        if self.load is not None:
            self._body, self._later, self.change = None, None, None

    @property
    def notes(self) -> Notes | None:
        """What makes the body, where that has not been asked for."""
        return None if self._later is None else self._later.notes

    def let_go(self, writes: Writes, notes: Notes) -> None:
        """Hold writes that run as those it has, and what makes the body anew, and no more."""
        later = _ToldLater(writes, self.rows, self.curves, notes)
        _GATE.alone(partial(self._let_go, later))

    def _let_go(self, later: _ToldLater) -> None:
        # What is known besides goes last: another thread may be asking.
        self._later, self._body, self.change = later, None, None

    def enter(self, number: int, parent: int, author: str, time: str) -> None:
        """Note under which number it enters the history, and who made it when."""
        self.number, self.parent, self._entry = number, parent, (author, time)
        if self._body is not None:
            self._body = self._entered(self._body)

    def _entered(self, body: StepBody) -> StepBody:
        """Give a body whose report says what was noted."""
        if self._entry is None:
            return body
        author, time = self._entry
        report = attrs.evolve(body.report, number=self.number, author=author, time=time)
        return attrs.evolve(body, report=report)

    @property
    def author(self) -> str:
        """Who made the edit."""
        return self.report.author if self._entry is None else self._entry[0]

    @property
    def report(self) -> EditReport:
        """The report."""
        if self._body is None and self.tell is not None:
            return self.tell()
        return self.body.report

    @property
    def journal(self) -> Writes:
        """All writes."""
        later = self._later
        return self.body.journal if later is None else later.writes

    @property
    def cause(self) -> Readers:
        """Which node was evaluated because of which."""
        return self.body.cause

    @property
    def changed(self) -> IntArray:
        """Nodes that changed."""
        return self.body.changed

    @property
    def moved(self) -> FloatArray:
        """By how much the nodes changed (m); nan for what the edit itself set."""
        return self.body.moved

    @property
    def seeds(self) -> IntArray:
        """Nodes that the edit set."""
        return self.body.seeds

    @property
    def rows(self) -> IntArray:
        """Points that changed."""
        later = self._later
        if later is not None:
            return later.rows
        return distinct(Node.number(self.changed[Node.is_point(self.changed)]))

    @property
    def forms(self) -> IntArray:
        """Numbers of the definitions that the edit set."""
        return Node.form_number(distinct(self.seeds[Node.is_form(self.seeds)]))

    @property
    def curves(self) -> IntArray:
        """Curves that changed."""
        later = self._later
        if later is not None:
            return later.curves
        return distinct(Node.number(self.changed[Node.is_curve(self.changed)]))

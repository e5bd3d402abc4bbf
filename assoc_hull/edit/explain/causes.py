"""Why an object is as it is: the edit, the objects through which it came, and where it stopped.

The engine keeps for every step which node was evaluated because of which; `why` reads that back as
a tree of `Why`, the cause that moved most first, and names nodes as addresses. A step that is
loaded from a file answers as one in memory does.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import integer, shown
from assoc_hull.display import ShownAsText
from assoc_hull.edit.document import Document
from assoc_hull.edit.modifications.definitions import definition_meant
from assoc_hull.edit.recording import field_words, joined_words
from assoc_hull.edit.step import Step, change_text
from assoc_hull.errors import BadInputError, ForeignPointError, WrongTypeError
from assoc_hull.graph.run_update import CauseTracer, CauseTree
from assoc_hull.model.address import AddressBook
from assoc_hull.model.dirty_cause import cause_of
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.generated_curves import attached_rows
from assoc_hull.model.kinds import Role, Sort, State
from assoc_hull.model.node import Node
from assoc_hull.model.objects import Crossing, Curve, Group, Line, Point, handle
from assoc_hull.model.tables import HullState

__all__ = [
    "Thing",
    "Why",
    "node_of",
    "spelled",
    "step_numbered",
    "why",
    "why_after",
]

# --------------------------------------------------------------------------------------
# The answer, as text and as a drawn tree.

_STOPS = 4
"""So many of the places where a change stopped are named in the text."""

_SLIGHT = 0.01
"""Causes below this part of the largest are left out where an edit set points nobody named."""

# what goes on beside a branch, below the last one, at a branch, at the last one
_INDENT = ("  ", "  ", "  ", "  ")
_BRANCH = ("│  ", "   ", "├─ ", "└─ ")
_PLAIN = ("|  ", "   ", "|- ", "`- ")


@attrs.frozen(repr=False)
class Why(ShownAsText):
    """The causes of the last change of one object, a tree.

    Attributes
    ----------
    object, name : str
        Key and address of the object.
    edit : str or None
        Name of the edit; None if none has reached the object.
    step : int
        Number of the edit, which it keeps in the history, the graph and in files; 0 if none.
    moved : float or None, m
        By how much the object changed; None where the edit itself set it, or nothing is
        known.
    what : str
        What happened to it.
    causes : tuple of Why
        The objects whose change made this one be evaluated, the one that moved most first.
    stopped : tuple of str
        Where it stopped: objects made from this one that came out as they were.
    because : str
        What the edit was asked for, in words, where it set points that nobody named.
    left : int
        Causes that are left out, as they moved less than the least that was asked.
    dirty : str
        Because of what the object is dirty in the edit that is open; empty where it is clean.
    """

    object: str
    name: str
    edit: str | None
    step: int
    moved: float | None
    what: str
    causes: tuple[Why, ...] = ()
    stopped: tuple[str, ...] = ()
    because: str = ""
    left: int = 0
    dirty: str = ""

    def chain(self) -> list[str]:
        """Give the keys from the object back to the edit, by the causes that moved most."""
        found = [self.object]
        link = self
        while link.causes:
            link = link.causes[0]
            found.append(link.object)
        return found

    def __str__(self) -> str:
        return self._text(_INDENT)

    def tree(self, *, plain: bool = False) -> str:
        """Draw the tree of causes, each below what it made change; stops come first.

        Parameters
        ----------
        plain : bool
            Whether to draw with characters of ASCII only.

        Examples
        --------
        >>> from assoc_hull.edit.explain.causes import Why
        >>> point = Why("p", "WL 1 x ST 7", "fair", 1, 0.01, "set by the edit")
        >>> print(Why("c", "ST 7", "fair", 1, None, "followed", (point,), ("WL 2 x ST 7",)).tree())
        edit 1, 'fair':
        ST 7: followed
        ├─ stopped at WL 2 x ST 7: same bits as before
        └─ WL 1 x ST 7: set by the edit, moved 10.000 mm
        """
        return self._text(_PLAIN if plain else _BRANCH)

    def _text(self, marks: tuple[str, str, str, str]) -> str:
        head = [f"{self.name} is dirty {self.dirty}"] if self.dirty else []
        if self.edit is not None:
            because = f", because of {self.because}" if self.because else ""
            head.append(f"edit {self.step}, {self.edit!r}{because}:")
        return "\n".join([*head, *self._lines(marks, "", "", set())])

    def _lines(
        self, marks: tuple[str, str, str, str], here: str, below: str, seen: set[str]
    ) -> Iterator[str]:
        """Give the lines of this part of the tree; objects `seen` before are not opened again.

        `here` stands before the first line, `below` before all others.
        """
        amount = "" if self.moved is None else f", moved {1e3 * self.moved:.3f} mm"
        again = self.object in seen and bool(self.causes)
        yield f"{here}{self.name}: {self.what}{amount}" + (" (see above)" if again else "")
        if again:
            return
        seen.add(self.object)
        beside, after, branch, last = marks
        if self.stopped:
            mark = branch if self.causes or self.left else last
            yield f"{below}{mark}stopped at {self._stops()}: same bits as before"
        for cause in self.causes:
            final = cause is self.causes[-1] and not self.left
            mark, rest = (last, after) if final else (branch, beside)
            yield from cause._lines(marks, below + mark, below + rest, seen)
        if self.left:
            yield f"{below}{last}and {self.left} that moved less"

    def _stops(self) -> str:
        more = f" and {len(self.stopped) - _STOPS} more" if len(self.stopped) > _STOPS else ""
        return ", ".join(self.stopped[:_STOPS]) + more


# --------------------------------------------------------------------------------------
# The question.

Thing = Group | Line | Curve | Point | Crossing

_MADE = "as it was made: no edit has reached it"
_SET = "set by the edit"
_CARRIED = "carried by the mapping of the edit, or found where a carried line meets a plane"
_RECIPE = "its points, kinds or end conditions were changed by the edit"
_FOLLOWED = "followed"
_CUT_OFF = "dirty, and came out with the same bits: what is made from it stayed clean"
_NOT_REACHED = "not reached by this edit"
_BLOCKED = "not evaluated: something it is made from has failed"
_FAILED = "could not be made: it keeps its last good shape"
_GONE = "an object that is not there"


def why(document: Document, node: int, step: int | None = None, least: float | None = None) -> Why:
    """Explain a change of a node.

    Parameters
    ----------
    document : Document
        The hull with its history.
    node : int
        Twice the row of a point, or twice the number of a curve and one.
    step : int or None
        Number of an edit of the history; -1 is the last one. None: the last that reached it.
    least : float or None, m
        Causes that moved less are left out, but for the first. None: where the edit set points that
        nobody named, as a pull does, those below a hundredth of the first.

    Returns
    -------
    Why
        The edit that changed or evaluated the node, and the causes back to what the designer set.
        A watched crossing has no value of its own: its causes are its curves.

    Raises
    ------
    BadInputError
        The history has no such edit.

    Examples
    --------
    >>> from assoc_hull.edit.document import Document
    >>> from assoc_hull.edit.explain.causes import why
    >>> from assoc_hull.shipped.wigley import wigley
    >>> print(why(Document(wigley()), 0))
    ST 1 x profile: as it was made: no edit has reached it
    """
    steps = list(document.history) if step is None else [step_numbered(document, step, "in why")]
    state = document.state.published()
    found = why_after(state, steps, node, least)
    if step is not None and found.edit is None:
        found = attrs.evolve(
            found, edit=steps[0].name, step=steps[0].number, what=_NOT_REACHED, causes=()
        )
    cause = cause_of(document.state.seen_here(), document.state.dirty_here(), node)
    return found if cause is None else attrs.evolve(found, dirty=str(cause))


def step_numbered(document: Document, number: int, where: str) -> Step:
    """Give the step of the history that has a number; -1 is the last one, -2 that before it.

    Raises
    ------
    BadInputError
        The history has none.
    """
    integer(number, "step", where, least=-(10**6))
    steps = document.history
    found = [each for each in steps if each.number == number]
    if not found and -len(steps) <= number < 0:
        found = [steps[number]]
    if found:
        return found[0]
    numbers = [each.number for each in steps]
    whole = numbers == list(range(1, len(steps) + 1))
    known = f"a number from 1 to {len(steps)}" if whole else f"one of {spelled(numbers)}"
    remedy = f"give {known}" if steps else "make an edit first"
    raise BadInputError(f"edit {number} was asked", f"in a history of {len(steps)}", remedy)


def spelled(numbers: Sequence[int]) -> str:
    """Give whole numbers in words, runs of them as one: ``1, 3 to 5``."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and runs[-1][-1] == number - 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(f"{run[0]} to {run[-1]}" if len(run) > 2 else
                     ", ".join(map(str, run)) for run in runs)  # fmt: skip


def why_after(
    state: HullState, steps: Sequence[Step], node: int, least: float | None = None, coming: int = 0
) -> Why:
    """Explain the last change of a node by steps that led to the state, oldest first.

    For a look at an edit that is not in the history, whose number will be `coming`; otherwise as
    `why`.
    """
    book = AddressBook(state)
    if _is_watched(state, node):
        return _watched(state, steps, book, node, least, coming)
    for step in reversed(steps):
        traces = _NamedTraces(state, book, step, step.number or coming, least)
        if traces.tracer.knows(node):
            return attrs.evolve(
                traces.name(traces.tracer.trace(node)), because=joined_words(traces.fields)
            )
    return Why(_key(state, node), _name(book, node), None, 0, None, _still(state, node))


def node_of(state: HullState, thing: Thing | FormDefinition | str) -> int:
    """Give the engine's node of a point, a curve, the first curve of a line, or a definition.

    Parameters
    ----------
    state : HullState
        The tables.
    thing : handle, address, FormDefinition, or a name or key of one
        The object; where a line and a definition have one name, the line.

    Raises
    ------
    ForeignPointError
        A handle of another hull, or of an object that has gone.
    BadInputError
        A group, or a line without curves.

    Examples
    --------
    >>> from assoc_hull.edit.explain.causes import node_of
    >>> from assoc_hull.shipped.wigley import wigley
    >>> node_of(wigley(), "ST 1") % 2  # curves have odd nodes
    1
    """
    definition = definition_meant(state, thing)
    if definition is not None:
        formed = state.formed.definition.data
        number: int = next(
            n for n in state.live("formed").tolist() if formed[n].key == definition.key
        )
        return Node.form(number)
    found = handle(state, thing) if isinstance(thing, str) else thing
    if not isinstance(found, Thing):
        what = f"the object is {shown(found)}"
        raise WrongTypeError(what, "in why", "give a handle or an address")
    if found.home is not state.live_tables:
        raise ForeignPointError(f"{type(found).__name__.lower()} {found.id!r}")
    number = found.row
    if isinstance(found, Line) and found.curves:
        return Node.curve(found.curves[0].row)
    if isinstance(found, Group | Line):
        raise BadInputError(f"{found.name!r} is no point or curve", "in why", "name one of them")
    return Node.curve(number) if isinstance(found, Curve) else Node.point(number)


def _is_watched(state: HullState, node: int) -> bool:
    if not Node.is_point(node):
        return False
    row = Node.number(node)
    crossing = state.rows.sort[row] == Sort.CROSSING
    return bool(crossing and state.rows.role[row] == Role.WATCHED)


def _watched(
    state: HullState, steps: Sequence[Step], book: AddressBook, node: int, least: float | None,
    coming: int,
) -> Why:  # fmt: skip
    curves = state.rows.curve[Node.number(node)].tolist()
    causes = [why_after(state, steps, Node.curve(curve), least, coming) for curve in curves]
    causes.sort(key=lambda each: -each.step)
    last = causes[0]
    return Why(
        _key(state, node), _name(book, node), last.edit, last.step, None,
        "watched, it lies where its curves pass", tuple(causes), because=last.because,
    )  # fmt: skip


def _key(state: HullState, node: int) -> str:
    if Node.is_form(node):
        return str(_form(state, node).key)
    table, number = state.curves if Node.is_curve(node) else state.rows, Node.number(node)
    return str(table.key[number]) if number < table.count else _GONE


def _form(state: HullState, node: int) -> FormDefinition:
    return state.formed.definition[Node.form_number(node)]


def _name(book: AddressBook, node: int) -> str:
    if Node.is_form(node):
        return f"the definition {_form(book.state, node).name!r}"
    curve, number = Node.is_curve(node), Node.number(node)
    table = book.state.curves if curve else book.state.rows
    if number >= table.count:
        return _GONE
    if curve:
        return book.curve_name(number)
    if not table.alive[number]:
        return _key(book.state, node)
    return book.address(number)


def _still(state: HullState, node: int) -> str:
    return {State.BLOCKED: _BLOCKED, State.FAILED: _FAILED}.get(_state(state, node), _MADE)


def _state(state: HullState, node: int) -> State:
    if Node.is_form(node):
        return State.CLEAN
    table, number = state.curves if Node.is_curve(node) else state.rows, Node.number(node)
    return State(int(table.state[number])) if number < table.count else State.CLEAN


def _without_alike(causes: Sequence[CauseTree], made: Collection[int]) -> list[CauseTree]:
    """Of generated points of the same definitions keep only the one that moved most, the first."""
    found, known = list[CauseTree](), set[tuple[int, ...]]()
    for each in causes:
        roots = tuple(sorted(cause.node for cause in each.causes))
        if each.node not in made or roots not in known:
            found.append(each)
        if each.node in made:
            known.add(roots)
    return found


class _NamedTraces:
    """Puts the traces of one step into names."""

    def __init__(
        self, state: HullState, book: AddressBook, step: Step, number: int, least: float | None
    ) -> None:
        self.state, self.book, self.step, self.number = state, book, step, number
        self._least = least
        self.fields = field_words(step.script.edits, leads=bool(step.report.led))
        self.tracer = CauseTracer(step.cause, step.changed, step.moved, step.seeds)
        self._done: dict[int, Why] = {}
        self._made = frozenset((2 * attached_rows(state)).tolist())

    def name(self, trace: CauseTree) -> Why:
        """Put a trace into names; each node once, as many readers share it."""
        node = trace.node
        if node not in self._done:
            every = _without_alike(trace.causes, self._made)
            kept = self._felt(every)
            self._done[node] = Why(
                _key(self.state, node), _name(self.book, node), self.step.name, self.number,
                None if np.isnan(trace.moved) else trace.moved, self._what(trace),
                tuple(map(self.name, kept)), self._stopped(node), left=len(every) - len(kept),
            )  # fmt: skip
        return self._done[node]

    def _felt(self, causes: Sequence[CauseTree]) -> list[CauseTree]:
        """Leave out causes that moved less than the least that was asked, but for the first."""
        least = self._least
        if least is None:
            least = _SLIGHT * causes[0].moved if self.fields and causes else 0.0
        # What the edit set by itself has no amount, and is kept.
        return [each for i, each in enumerate(causes) if i == 0 or not each.moved < least]

    def _stopped(self, node: int) -> tuple[str, ...]:
        """Name where a change stopped; for a definition, the curves of which it moved no point."""
        quiet = self.tracer.cut_off(node)
        if not Node.is_form(node):
            return tuple(_name(self.book, each) for each in quiet)
        reached = Node.number(self.step.cause.reader[self.step.cause.source == node])
        still = Node.number(np.array(quiet, np.int64))
        curve = self.state.rows.curve[:, 0]
        moved = set(curve[np.setdiff1d(reached, still)].tolist())
        left = dict.fromkeys(each for each in curve[still].tolist() if each not in moved)
        return tuple(self.book.curve_name(each) for each in left)

    def _what(self, trace: CauseTree) -> str:
        if Node.is_form(trace.node):
            return f"{_SET}: {self._values(trace.node)}"
        if trace.seed:
            return _CARRIED if self.step.report.carried else _SET
        if trace.node not in self.tracer.moved:
            halted = {State.BLOCKED: _BLOCKED, State.FAILED: _FAILED}
            return halted.get(_state(self.state, trace.node), _CUT_OFF)
        return _FOLLOWED if trace.causes else _RECIPE

    def _values(self, node: int) -> str:
        """Say which values of a definition the edit set."""
        name = _form(self.state, node).name
        texts = [change_text(each) for each in self.step.report.definitions if each[0] == name]
        return ", ".join(texts)

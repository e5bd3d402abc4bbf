"""Why an object is as it is: the edit, the objects through which it came, and where it stopped.

The engine keeps for every step which node was evaluated because of which; `why` reads that back as
a tree of `Why`, the cause that moved most first, and names nodes as addresses. A step that is
loaded from a file answers as one in memory does.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.display import ShownAsText
from assoc_hull.edit.document import Document
from assoc_hull.edit.modifications.definitions import definition_meant
from assoc_hull.edit.report import change_text
from assoc_hull.edit.step import Step
from assoc_hull.errors import BadInputError, ForeignPointError, WrongTypeError
from assoc_hull.graph.trace_causes import CauseTracer, CauseTree
from assoc_hull.model.address import AddressBook
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
    "why",
    "why_after",
]

# --------------------------------------------------------------------------------------
# The answer, as text and as a drawn tree.

_STOPS = 4
"""So many of the places where a change stopped are named in the text."""

# what goes on beside a branch, below the last one, at a branch, at the last one
_INDENT = ("  ", "  ", "  ", "  ")
_BRANCH = ("│  ", "   ", "├─ ", "└─ ")
_PLAIN = ("|  ", "   ", "|- ", "`- ")


@attrs.frozen
class Why(ShownAsText):
    """The causes of the last change of one object, a tree.

    Attributes
    ----------
    object, name : str
        Key and address of the object.
    edit : str or None
        Name of the edit; None if none has reached the object.
    step : int
        Number of the edit in the history, from 1; 0 if none.
    moved : float or None, m
        By how much the object changed; None where the edit itself set it, or nothing is
        known.
    what : str
        What happened to it.
    causes : tuple of Why
        The objects whose change made this one be evaluated, the one that moved most first.
    stopped : tuple of str
        Where it stopped: objects made from this one that came out as they were.
    """

    object: str
    name: str
    edit: str | None
    step: int
    moved: float | None
    what: str
    causes: tuple[Why, ...] = ()
    stopped: tuple[str, ...] = ()

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
        head = [] if self.edit is None else [f"edit {self.step}, {self.edit!r}:"]
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
            mark = branch if self.causes else last
            yield f"{below}{mark}stopped at {self._stops()}: same bits as before"
        for cause in self.causes:
            final = cause is self.causes[-1]
            mark, rest = (last, after) if final else (branch, beside)
            yield from cause._lines(marks, below + mark, below + rest, seen)

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
_CUT_OFF = "evaluated again, and came out with the same bits: nothing was told to its readers"
_BLOCKED = "not evaluated: something it is made from has failed"
_FAILED = "could not be made: it keeps its last good shape"
_GONE = "an object that is not there"


def why(document: Document, node: int) -> Why:
    """Explain the last change of a node.

    Parameters
    ----------
    document : Document
        The hull with its history.
    node : int
        Twice the row of a point, or twice the number of a curve and one.

    Returns
    -------
    Why
        The last committed edit that changed or evaluated the node, and the causes back to
        what the designer set. A watched crossing has no value of its own: its causes are
        its curves.

    Examples
    --------
    >>> from assoc_hull.edit.document import Document
    >>> from assoc_hull.edit.explain.causes import why
    >>> from assoc_hull.shipped.wigley import wigley
    >>> print(why(Document(wigley()), 0))
    ST 1 x profile: as it was made: no edit has reached it
    """
    return why_after(document.state.published(), list(document.history), node)


def why_after(state: HullState, steps: Sequence[Step], node: int) -> Why:
    """Explain the last change of a node by steps that led to the state, oldest first.

    For a look at an edit that is not in the history; otherwise as `why`.
    """
    book = AddressBook(state)
    if _is_watched(state, node):
        return _watched(state, steps, book, node)
    for number in range(len(steps), 0, -1):
        traces = _NamedTraces(state, book, steps[number - 1], number)
        if traces.tracer.knows(node):
            return traces.name(traces.tracer.trace(node))
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


def _watched(state: HullState, steps: Sequence[Step], book: AddressBook, node: int) -> Why:
    curves = state.rows.curve[Node.number(node)].tolist()
    causes = [why_after(state, steps, Node.curve(curve)) for curve in curves]
    causes.sort(key=lambda each: -each.step)
    last = causes[0]
    return Why(
        _key(state, node), _name(book, node), last.edit, last.step, None,
        "watched, it lies where its curves pass", tuple(causes),
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

    def __init__(self, state: HullState, book: AddressBook, step: Step, number: int) -> None:
        self.state, self.book, self.step, self.number = state, book, step, number
        self.tracer = CauseTracer(step.cause, step.changed, step.moved, step.seeds)
        self._done: dict[int, Why] = {}
        self._made = frozenset((2 * attached_rows(state)).tolist())

    def name(self, trace: CauseTree) -> Why:
        """Put a trace into names; each node once, as many readers share it."""
        node = trace.node
        if node not in self._done:
            self._done[node] = Why(
                _key(self.state, node), _name(self.book, node), self.step.name, self.number,
                None if np.isnan(trace.moved) else trace.moved, self._what(trace),
                tuple(self.name(each) for each in _without_alike(trace.causes, self._made)),
                self._stopped(node),
            )  # fmt: skip
        return self._done[node]

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

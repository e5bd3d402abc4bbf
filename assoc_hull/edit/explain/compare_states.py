"""Two states of a hull side by side: which lines differ, how far, and the principal numbers.

Lines are matched by their keys. A state of the history is reached by walking: the writes of steps
are run backward and forward over the tables of the hull, and at the end these are as they were,
whatever happens in between. The document is not changed.
"""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterator, Sequence

import attrs

from assoc_hull.analysis.hydrostatics.flotation import even_keel_displacement
from assoc_hull.display import ShownAsText
from assoc_hull.edit.document import Document
from assoc_hull.edit.past_states import run_together, steps_together
from assoc_hull.edit.step import Step
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.geometry.splines.distance import OwnedCurves, farthest_points, identical_curves
from assoc_hull.model.address import AddressBook
from assoc_hull.model.attachments import ATTACHMENTS, AttachmentKind
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import HullState, copy_state

__all__ = [
    "PRESENT_STATE",
    "Comparison",
    "LineDifference",
    "StateWalk",
    "compare_labelled",
    "compare_states",
    "state_at",
    "walk_states",
]


@attrs.frozen(repr=False)
class LineDifference(ShownAsText):
    """How a line differs between two states.

    Attributes
    ----------
    line : str
        Its name.
    what : {"moved", "added", "removed", "renamed"}
        How it differs; a line that moved may have another name as well.
    distance : float, m
        The largest distance of either form of it from the other; 0 if it did not move.
    place : (float, float, float) or None, m
        Where that is, on the line as it is after.
    """

    line: str
    what: str
    distance: float = 0.0
    place: tuple[float, float, float] | None = None

    def __str__(self) -> str:
        if self.place is None:
            return f"{self.line}: {self.what}"
        x, y, z = self.place
        return f"{self.line}: {1e3 * self.distance:.3f} mm at ({x:.3f}, {y:.3f}, {z:.3f}) m"


@attrs.frozen
class BesideDifference:
    """How a tunnel or a body beside the net differs between two states.

    Attributes
    ----------
    kind, name : str
        ``"tunnel"`` or ``"body"``; what it is called, ``"old -> new"`` if that changed alone.
    what : {"added", "removed", "renamed", "changed"}
        The difference.
    before, after : str
        What it is in both; blank where it is not there.
    """

    kind: str
    name: str
    what: str
    before: str = ""
    after: str = ""

    def __str__(self) -> str:
        differ = self.what == "changed" and self.before != self.after
        there = f": {self.before} -> {self.after}" if differ else ""
        return f"the {self.kind} {self.name}: {self.what}{there}"


@attrs.frozen(repr=False)
class Comparison(ShownAsText):
    """Two states of a hull side by side.

    Attributes
    ----------
    states : (str, str)
        What they are called.
    lines : tuple of LineDifference
        Lines that differ, those that moved farthest first.
    numbers : dict of str to (float or None, float or None)
        Principal numbers in both states, those that differ: dimensions (m), ``volume`` (m3)
        and ``lcb`` (m from AP, + forward) at the design draught, less tunnels, counts of lines,
        tunnels, bodies and points. None where there are not sections enough.
    names : (str, str)
        Name of the ship in both.
    decks : (str, str)
        The deck in both: open or closed.
    beside : tuple of BesideDifference
        Tunnels and bodies that differ, by kind and name.
    """

    states: tuple[str, str]
    lines: tuple[LineDifference, ...]
    numbers: dict[str, tuple[float | None, float | None]]
    names: tuple[str, str]
    decks: tuple[str, str]
    beside: tuple[BesideDifference, ...] = ()

    def __str__(self) -> str:
        many = "1 line differs" if len(self.lines) == 1 else f"{len(self.lines)} lines differ"
        head = f"{self.states[0]} -> {self.states[1]}: {many}"
        text = [head, *(f"  {each}" for each in (*self.lines, *self.beside))]
        for name, (old, new) in self.numbers.items():
            change = "" if old is None or new is None else f" ({new - old:+.6g})"
            text.append(f"  {name}: {_plain(old)} -> {_plain(new)}{change}")
        for name, (was, now) in (("name", self.names), ("deck", self.decks)):
            if was != now:
                text.append(f"  {name}: {was} -> {now}")
        return "\n".join(text)


def _plain(number: float | None) -> str:
    return "unknown" if number is None else f"{number:.10g}"


def compare_states(before: HullState, after: HullState, states: tuple[str, str]) -> Comparison:
    """Compare two states of a hull, or two hulls; `states` is what they are called."""
    old, new = (_lines(state) for state in (before, after))
    found = [LineDifference(old[key][0], "removed") for key in old if key not in new]
    found += [LineDifference(new[key][0], "added") for key in new if key not in old]
    found += _differences([(old[key], new[key]) for key in new if key in old])
    order = sorted(found, key=lambda each: (-each.distance, each.what, each.line))
    one, two = _numbers(before), _numbers(after)
    numbers = {name: (one[name], two[name]) for name in one if one[name] != two[name]}
    ship, other = before.particulars, after.particulars
    words = (ship.name, other.name), (ship.deck, other.deck)
    beside = tuple(each for kind in ATTACHMENTS for each in _beside(kind, before, after))
    return Comparison(states, tuple(order), numbers, *words, beside)


Pieces = tuple[str, list[SplineBatch]]


def _lines(state: HullState) -> dict[str, Pieces]:
    """Give name and splines of each line that has a shape, by key."""
    book, found = AddressBook(state), dict[str, Pieces]()
    for line in state.live("lines").tolist():
        splines = [state.spline(curve) for curve in state.curves_of(line)]
        if splines:
            found[str(state.lines.key[line])] = book.line_name(line), splines
    return found


def _differences(pairs: Sequence[tuple[Pieces, Pieces]]) -> Iterator[LineDifference]:
    """Say how lines of both differ, those that do."""
    moved = [pair for pair in pairs if not identical_curves(pair[0][1], pair[1][1])]
    far = farthest_points(*(OwnedCurves.of([pair[k][1] for pair in moved]) for k in (0, 1)))
    for (_, new), place, distance in zip(moved, far.other.tolist(), far.distance, strict=True):
        x, y, z = place
        yield LineDifference(new[0], "moved", float(distance), (x, y, z))
    for old, new in pairs:
        if old[0] != new[0]:
            yield LineDifference(f"{old[0]} -> {new[0]}", "renamed")


def _beside(
    kind: AttachmentKind, before: HullState, after: HullState
) -> Iterator[BesideDifference]:
    """Say how things of one kind differ; one that has another name alone is paired by the rest."""
    old, new = ({each.name: each for each in kind.of(state)[0]} for state in (before, after))
    gone = [name for name in old if name not in new]
    for name, each in new.items():
        like = [was for was in gone if attrs.evolve(old[was], name=name) == each]
        if name not in old and like:
            was = like[0]
            gone.remove(was)
            yield BesideDifference(kind.word, f"{was} -> {name}", "renamed")
        elif name not in old:
            yield BesideDifference(kind.word, name, "added", after=each.summary)
        elif each != old[name]:
            yield BesideDifference(kind.word, name, "changed", old[name].summary, each.summary)
    for name in gone:
        yield BesideDifference(kind.word, name, "removed", before=old[name].summary)


def _numbers(state: HullState) -> dict[str, float | None]:
    """Give the principal numbers of a state."""
    ship, sort = state.particulars, state.rows.sort[state.live("rows")]
    found: dict[str, float | None] = {
        name: getattr(ship, name) for name in ("length", "breadth", "depth", "draught")
    }
    try:
        measured = even_keel_displacement(state, tunnels=True)
        found |= {"volume": measured.volume, "lcb": measured.lcb}
    except BadInputError:
        found |= {"volume": None, "lcb": None}
    found["lines"] = float(len(state.live("lines")))
    found |= {kind.column: float(len(kind.of(state)[0])) for kind in ATTACHMENTS}
    for each in Sort:
        found[f"{each.name.lower()} points"] = float((sort == each).sum())
    return found


# --------------------------------------------------------------------------------------
# States of the history.

PRESENT_STATE = "the present state"


class StateWalk:
    """Brings the tables of a hull from one state of its history to another, step by step."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.way: list[Step] = list(document.history)

    def go(self, number: int) -> None:
        """Go to the state after the step with a number, 0 for the hull as it came."""
        target = self.document.path(number)
        there = {step.number for step in target}
        back = list(itertools.takewhile(lambda step: step.number not in there, self.way[::-1]))
        for run in steps_together(back):
            run_together(run, forward=False)
            del self.way[-len(run) :]
        for run in steps_together(target[len(self.way) :]):
            run_together(run, forward=True)
            self.way += run


@contextlib.contextmanager
def walk_states(document: Document) -> Iterator[StateWalk]:
    """Walk through the history; at the end the tables are as they were, whatever happens.

    Raises
    ------
    BadInputError
        An edit is open.
    """
    document.require_ended("the history")
    with document.held("the history", keep=False):
        walk = StateWalk(document)
        # Some steps cannot be run from the middle: broken off there, all is copied back.
        with document.unharmed():
            try:
                yield walk
            finally:
                walk.go(document.head)


def state_at(document: Document, number: int) -> HullState:
    """Give a copy of the tables as they were after a step, 0 for the hull as it came."""
    with walk_states(document) as walk:
        walk.go(number)
        return copy_state(document.state)


def compare_labelled(document: Document, before: str, after: str | None = None) -> Comparison:
    """Compare two named states, or one with the present state if `after` is None.

    Raises
    ------
    UnknownNameError
        There is no such checkpoint or branch.
    """
    old = state_at(document, document.labelled(before))
    if after is None:
        return compare_states(old, document.state.published(), (before, PRESENT_STATE))
    return compare_states(old, state_at(document, document.labelled(after)), (before, after))

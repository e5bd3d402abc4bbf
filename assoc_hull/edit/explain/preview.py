"""Preview of an edit: everything runs, nothing is published.

The update runs on the hull itself and is taken back by its journal. Before that, the tables are
shared as they are then: which lines change and how far, volume and fingerprint are found when
somebody asks. `line_changes` works on any committed step as well.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Literal, cast

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import EvenKeelDisplacement, even_keel_displacement
from assoc_hull.arguments import all_of, flag, text
from assoc_hull.display import ShownAsText
from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.causes import Thing, Why, node_of, why_after
from assoc_hull.edit.recording import Script, Settings
from assoc_hull.edit.script import carry_out as carry_out_script
from assoc_hull.edit.session import Edit, refusal_of
from assoc_hull.edit.shapes import HullShapes, Shapes, joined
from assoc_hull.edit.step import EditReport, Fairness, Step
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.address import AddressBook
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = [
    "LineChange",
    "Measure",
    "Preview",
    "line_changes",
    "preview",
]

# --------------------------------------------------------------------------------------
# Changes of lines.

_PER_SEGMENT = 8
"""So many places of each segment are measured, where no point of the curve has moved."""


@attrs.frozen
class LineChange:
    """One line that an edit changes.

    Attributes
    ----------
    group, line : str
        Their names.
    distance : float or None, m
        The largest movement of a point on it; where none moved, how far the curve lies from
        where it was. None for a new curve.
    point : str or None
        Address of the point that moved farthest; None where none did.
    place : (float, float, float) or None, m
        Where that is now.
    """

    group: str
    line: str
    distance: float | None
    point: str | None
    place: tuple[float, float, float] | None


def line_changes(state: HullState, step: Step | None) -> tuple[LineChange, ...]:
    """Give the lines that a step has changed, for the tables as the step leaves them.

    Group by group in the order of the ranks, along each group by plane, then by name.
    """
    if step is None:
        return ()
    # a point whose movement is not known counts for none
    known = Node.is_point(step.changed) & np.isfinite(step.moved)
    rows, away = Node.number(step.changed[known]), step.moved[known]
    alive = state.rows.alive[rows]
    found = _Movements(state, AddressBook(state), step, rows[alive], away[alive])
    curves: dict[int, list[int]] = {}
    for curve in step.curves[state.curves.alive[step.curves]].tolist():
        curves.setdefault(state.line_of(curve), []).append(curve)
    return tuple(found.of_line(line, curves[line]) for line in sorted(curves, key=found.order))


@attrs.frozen(eq=False)
class _Movements:
    """Movements of the points of one step."""

    state: HullState
    book: AddressBook
    step: Step
    rows: IntArray
    away: FloatArray

    def order(self, line: int) -> tuple[int, str, float, str]:
        """Give what lines are sorted by."""
        table = self.state.lines
        place = float(table.offset[line]) if table.planar[line] else 0.0
        return self.state.family(line).rank, self._group(line), place, self.book.line_name(line)

    def _group(self, line: int) -> str:
        return str(self.state.groups.name[int(self.state.lines.group[line])])

    def of_line(self, line: int, curves: list[int]) -> LineChange:
        """Tell the movement of a line: of the points on its curves, or of these themselves."""
        name, group = self.book.line_name(line), self._group(line)
        mine = np.isin(self.state.rows.curve[self.rows], curves).any(axis=1)
        if mine.any():
            best = int(np.argmax(np.where(mine, self.away, -1.0)))
            row = int(self.rows[best])
            x, y, z = self.state.rows.xyz[row].tolist()
            return LineChange(
                group, name, float(self.away[best]), self.book.address(row), (x, y, z)
            )
        off, place = max(map(self._between, curves), key=lambda each: each[0] or 0.0)
        return LineChange(group, name, off, None, place)

    def _between(self, curve: int) -> tuple[float | None, tuple[float, float, float] | None]:
        """Give how far a curve lies from where it was, m, and where that is most; None if new."""
        fairness = self.step.report.fairness
        # A trial was just made, and holds the splines that it counts on.
        old = fairness.before.get(curve) if isinstance(fairness, Fairness) else None
        if old is None:
            return None, None
        places = sample(self.state.spline(curve), _PER_SEGMENT)[1]
        away = closest_points(old, 0, places)[2]
        best = int(np.argmax(away))
        x, y, z = places[best].tolist()
        return float(away[best]), (x, y, z)


# --------------------------------------------------------------------------------------
# Previews.


Measure = bool | Literal["about"]
"""Whether volume and LCB are measured: exactly, or about, as those of a drag."""


@attrs.frozen(eq=False)
class _Seen:
    """A hull before an edit, and as it would be after; nothing of it changes any more."""

    before: HullState
    after: HullState
    step: Step | None
    measure: Measure


_FOUND = ("report", "lines", "fingerprint", "_measured")
"""What a preview finds when it is read."""

_KEPT = ("refused", "why", "shapes", "plain", *_FOUND)


@attrs.frozen(eq=False, slots=False, repr=False)
class Preview(ShownAsText):
    """What an edit would do.

    Attributes
    ----------
    refused : tuple of str
        Every reason why the edit would be refused; empty if it would not.
    why : mapping of str to Why
        Why each object that was asked for would change.
    shapes : Shapes or None
        The curves that would change, as they would be, if that was asked for.
    plain : Preview or None
        What the plain field would do in place of a fair answer; None where nothing is asked to be
        answered fairly, or where a function stands in what is asked.
    """

    refused: tuple[str, ...]
    why: Mapping[str, Why] = attrs.field(factory=dict, repr=False)
    shapes: Shapes | None = attrs.field(default=None, repr=False)
    plain: Preview | None = attrs.field(default=None, repr=False)
    _seen: _Seen | None = attrs.field(default=None, repr=False)
    _tell: Callable[[], EditReport | None] = attrs.field(default=lambda: None, repr=False)

    def __getstate__(self) -> dict[str, object]:
        """Give all values: what they are found from stays here."""
        found = {name: getattr(self, name) for name in _KEPT}
        return found | {"_seen": None, "_tell": None}

    def __setstate__(self, state: dict[str, object]) -> None:
        self.__dict__.update(state)

    @cached_property
    def report(self) -> EditReport | None:
        """The report that the edit would have; None if it would be refused."""
        return self._tell()

    @cached_property
    def lines(self) -> tuple[LineChange, ...]:
        """The lines that would change, how far each would move, and where."""
        return () if self._seen is None else line_changes(self._seen.after, self._seen.step)

    @cached_property
    def fingerprint(self) -> str | None:
        """That of the hull after the edit; None if it would be refused."""
        return None if self._seen is None else fingerprint(self._seen.after)

    @property
    def volume_change(self) -> float | None:
        """At the design draught, both sides, m3; None without two sections, or if refused."""
        return self._measured[0]

    @property
    def lcb_change(self) -> float | None:
        """How far the centre of buoyancy would move, m, + forward; None likewise."""
        return self._measured[1]

    @cached_property
    def _measured(self) -> tuple[float | None, float | None]:
        seen = self._seen
        if seen is None or not seen.measure:
            return None, None
        if seen.measure == "about":
            return _about(seen)
        before, after = _displacement(seen.before), _displacement(seen.after)
        if before is None or after is None:
            return None, None
        return after.volume - before.volume, after.lcb - before.lcb

    def __str__(self) -> str:
        if self.report is None:
            return "would be refused: " + "; ".join(self.refused)
        words = str(self.report)
        if self.volume_change is not None and self.lcb_change is not None:
            words += f"; volume {self.volume_change:+.4g} m3, LCB {1e3 * self.lcb_change:+.4g} mm"
        if self.plain is not None:
            words += f"; {_beside(self.report, self.plain)}"
        return words


def _beside(report: EditReport, plain: Preview) -> str:
    """Say how many changes of the sign of curvature would come, and with the plain field."""
    if plain.report is None:
        return f"the plain field would be refused: {'; '.join(plain.refused)}"
    counts = [sum(more for _, more in each.inflections) for each in (report, plain.report)]
    return f"{counts[0]} new changes of the sign of curvature, {counts[1]} with the plain field"


def _about(seen: _Seen) -> tuple[float, float]:
    """Take the differences of sectional areas."""
    before, changed = seen.before, _changed_shapes(seen.after, seen.step)
    shapes = before.derived(
        ("hull shapes",), (before.curves.spline, before.curves.alive, before.lines.offset),
        lambda: HullShapes.of(before),
    )  # fmt: skip
    return shapes.changes(changed.curves, changed.spline)


def preview(
    document: Document,
    carry_out: Callable[[Edit], None],
    settings: Settings | None = None,
    name: str = "preview",
    why: Sequence[Thing | str] = (),
    *,
    shapes: bool = False,
    measure: Measure = True,
) -> Preview:
    """Run an edit beside the published state, and take it back.

    Parameters
    ----------
    document : Document
        The hull.
    carry_out : callable
        Called with the edit.
    settings : Settings or None
        As for an edit.
    name : str
        Name of the edit, for its report.
    why : sequence of objects or addresses
        Objects whose causes are reported: why they would change.
    shapes : bool
        Whether the curves that would change are given.
    measure : bool or "about"
        Whether volume and LCB are measured, when somebody asks for them; about, as a drag does.

    Returns
    -------
    Preview
        Where something is asked to be answered fairly, with what the plain field would do.

    Raises
    ------
    BadInputError
        An edit is open.
    WrongTypeError, UnknownNameError, AbsentParameterError, ForeignPointError
        What was asked for is not there, or is of another kind.
    """
    # whatever is neither a thing of the hull nor an address, `node_of` refuses
    asked = cast("list[Thing | str]", all_of(why, object, "why", "in preview"))
    flag(shapes, "shapes", "in preview")
    if not (isinstance(measure, str) and measure == "about"):
        flag(measure, "measure", "in preview")
    document.require_ended("preview")
    before, found = document.state.published(), list[Preview]()

    def look(step: Step | None) -> None:
        seen = _Seen(before, document.state.as_written(), step, measure)
        steps = [*document.history, *([] if step is None else [step])]
        causes, coming = dict[str, Why](), len(document.steps) + 1
        for thing in asked:
            node = node_of(document.state, thing)
            known = thing if isinstance(thing, str) else thing.id
            causes[known] = why_after(document.state, steps, node, coming=coming)
        drawn = _changed_shapes(seen.after, step) if shapes else None
        found.append(Preview((), causes, drawn, None, seen, lambda: trial.report))

    trial = Edit(document, text(name, "the name", "in preview"), settings, look=look)
    try:
        with trial:
            carry_out(trial)
    except AssocHullError as error:
        refused = refusal_of(error)
        plain = _plain(document, trial.asked, settings, name, shapes=shapes, measure=measure)
        return Preview(refused, plain=plain)
    plain = _plain(document, trial.asked, settings, name, shapes=shapes, measure=measure)
    # Taken out of the list that `look` knows, it goes with its columns when nobody has it.
    return attrs.evolve(found.pop(), plain=plain)


def _plain(
    document: Document, asked: Script, settings: Settings | None, name: str, *, shapes: bool,
    measure: Measure,
) -> Preview | None:  # fmt: skip
    """Give what the plain field would do in place of all fair answers; None without one."""
    if not asked.repeatable or not any(each.get("fair") for each in asked.edits):
        return None
    edits = [{**each, "fair": False} if each.get("fair") else each for each in asked.edits]
    try:
        return preview(
            document, lambda edit: carry_out_script(edit, edits), settings, name, shapes=shapes,
            measure=measure,
        )  # fmt: skip
    except AssocHullError as error:
        # a later modification may name a point that the fair answer places
        return Preview((str(error),))


def _changed_shapes(state: HullState, step: Step | None) -> Shapes:
    """Give the curves that a step has changed."""
    curves = np.zeros(0, np.int64) if step is None else np.sort(step.curves)
    curves = curves[state.curves.alive[curves]]
    freeze(curves)
    return Shapes(curves, joined([state.spline(curve) for curve in curves.tolist()]))


def _displacement(state: HullState) -> EvenKeelDisplacement | None:
    try:
        return even_keel_displacement(state, tunnels=True)
    except BadInputError:
        return None

"""Preview of an edit: everything runs, nothing is published.

The update runs on the hull itself and is taken back by its journal. Before that, its outcome is
read: the report, which lines change and how far, the volume, and why an object moves.
`line_changes` works on any committed step as well.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import cast

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import EvenKeelDisplacement, even_keel_displacement
from assoc_hull.arguments import all_of, flag, text
from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.causes import Thing, Why, node_of, why_after
from assoc_hull.edit.pending_changes import Settings
from assoc_hull.edit.report import EditReport, Fairness
from assoc_hull.edit.session import Edit, refusal_of
from assoc_hull.edit.shapes import Shapes, joined
from assoc_hull.edit.step import Step
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.model.address import AddressBook
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = [
    "LineChange",
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


@attrs.frozen
class Preview:
    """What an edit would do.

    Attributes
    ----------
    report : EditReport or None
        The report that the edit would have; None if it would be refused.
    refused : tuple of str
        Every reason why the edit would be refused; empty if it would not.
    volume_change : float or None, m3
        At the design draught, both sides; None without two sections, or if refused.
    lcb_change : float or None, m
        + forward; None likewise.
    lines : tuple of LineChange
        The lines that would change, how far each would move, and where.
    why : mapping of str to Why
        Why each object that was asked for would change.
    fingerprint : str or None
        That of the hull after the edit; None if refused.
    shapes : Shapes or None
        The curves that would change, as they would be, if that was asked for.
    """

    report: EditReport | None
    refused: tuple[str, ...]
    volume_change: float | None
    lcb_change: float | None
    lines: tuple[LineChange, ...] = ()
    why: Mapping[str, Why] = attrs.field(factory=dict, repr=False)
    fingerprint: str | None = None
    shapes: Shapes | None = attrs.field(default=None, eq=False, repr=False)

    def __str__(self) -> str:
        if self.report is None:
            return "would be refused: " + "; ".join(self.refused)
        words = str(self.report)
        if self.volume_change is not None and self.lcb_change is not None:
            words += f"; volume {self.volume_change:+.4g} m3, LCB {1e3 * self.lcb_change:+.4g} mm"
        return words


def preview(
    document: Document,
    carry_out: Callable[[Edit], None],
    settings: Settings | None = None,
    name: str = "preview",
    why: Sequence[Thing | str] = (),
    *,
    shapes: bool = False,
    measure: bool = True,
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
    shapes, measure : bool
        Whether the curves that would change are given, and volume and LCB measured.

    Returns
    -------
    Preview

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
    flag(measure, "measure", "in preview")
    document.require_ended("preview")
    before = _measure(document.state.published()) if measure else None
    after = list[_After]()
    trial = Edit(
        document, text(name, "the name", "in preview"), settings,
        look=lambda step: after.append(
            _look(document, step, asked, shapes=shapes, measure=before is not None)
        ),
    )  # fmt: skip
    try:
        with trial:
            carry_out(trial)
    except AssocHullError as error:
        return Preview(None, refusal_of(error), None, None)
    now, volume, lcb = after[0], None, None
    if before is not None and now.displaced is not None:
        volume = now.displaced.volume - before.volume
        lcb = now.displaced.lcb - before.lcb
    return Preview(trial.report, (), volume, lcb, now.lines, now.why, now.fingerprint, now.shapes)


@attrs.frozen
class _After:
    """What is read of a hull before an edit is taken back."""

    displaced: EvenKeelDisplacement | None
    lines: tuple[LineChange, ...]
    why: dict[str, Why]
    fingerprint: str
    shapes: Shapes | None


def _look(
    document: Document,
    step: Step | None,
    asked: Sequence[Thing | str],
    *,
    shapes: bool,
    measure: bool,
) -> _After:
    state, steps = document.state, [*document.history, *([] if step is None else [step])]
    causes = dict[str, Why]()
    for thing in asked:
        node = node_of(state, thing)
        causes[thing if isinstance(thing, str) else thing.id] = why_after(state, steps, node)
    displaced = _measure(state) if measure else None
    drawn = _shapes(state, step) if shapes else None
    return _After(displaced, line_changes(state, step), causes, fingerprint(state), drawn)


def _shapes(state: HullState, step: Step | None) -> Shapes:
    curves = np.zeros(0, np.int64) if step is None else np.sort(step.curves)
    curves = curves[state.curves.alive[curves]]
    freeze(curves)
    return Shapes(curves, joined([state.spline(curve) for curve in curves.tolist()]))


def _measure(state: HullState) -> EvenKeelDisplacement | None:
    try:
        return even_keel_displacement(state)
    except BadInputError:
        return None

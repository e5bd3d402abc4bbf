"""What an edit did: the nodes that changed and why, its report, the finished step.

All is told from arrays of the edit's own, so that it may be told when somebody asks for it, long
after the tables have changed again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.followup.take_up_definitions import form_changes
from assoc_hull.edit.modification import Work
from assoc_hull.edit.step import EditReport, Fairness, Led, Movement, Step, StepBody
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.graph.journal import Journal, distinct
from assoc_hull.graph.run_update import Readers, UpdatePass
from assoc_hull.model.address import AddressBook
from assoc_hull.model.gaps import along_normal, sides_held
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.network import bits_differ, moved_curve
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = [
    "Movements",
    "changed_nodes",
    "joined_causes",
    "joined_step",
    "largest_movements",
    "net_difference",
    "points_elsewhere",
    "step_of",
]


@attrs.frozen(eq=False)
class Movements:
    """Points that may have moved, and where they lie on their curves.

    Attributes
    ----------
    rows : (k,) int
        The points, ascending.
    old, new : (k, 3), m
        Where they lay, and lie now.
    curve, parameter : (k, 2) int, (k, 2) m
        Their curves, -1 for none, and where on these.
    spline : mapping of int to SplineBatch
        The curves, as far as they have a shape.
    """

    rows: IntArray
    old: FloatArray
    new: FloatArray
    curve: IntArray
    parameter: FloatArray
    spline: Mapping[int, SplineBatch]

    @classmethod
    def of(cls, state: HullState, rows: IntArray, old: FloatArray) -> Movements:
        """Read where points lie now."""
        table, shape = state.rows, state.curves.spline.data
        curve = table.curve[rows]
        splines = {each: shape[each] for each in set(curve.ravel().tolist()) if each >= 0}
        held = {each: spline for each, spline in splines.items() if spline is not None}
        return cls(rows, old, table.xyz[rows], curve, table.parameter[rows], held)

    def take(self, rows: IntArray) -> Movements:
        """Give some of the points, in another order; those that are not among them are left out."""
        place = self.rows.searchsorted(rows)
        place = place[self.rows.take(place, mode="clip") == rows] if len(self.rows) else place[:0]
        return Movements(
            self.rows[place], self.old[place], self.new[place], self.curve[place],
            self.parameter[place], self.spline,
        )  # fmt: skip


def step_of(work: Work, rows: IntArray, away: FloatArray) -> Step:
    """Put the finished step together."""
    parts, fresh = work.passes, np.array(work.pending.fresh, np.int64)
    nodes, distance = changed_nodes(parts, rows, away, fresh)
    if len(parts) > 1 or work.pending.structural:
        every = np.concatenate([nodes, *(part.changed for part in parts)])
        known = np.concatenate([distance, *(part.moved for part in parts)])
        nodes, distance = net_difference(
            points_elsewhere(work.state, work.journal),
            work.network.before, work.state.spline, every, known,
        )  # fmt: skip
    nodes = np.concatenate([nodes, work.forms])
    distance = np.concatenate([distance, np.full(len(work.forms), np.nan)])
    report = _report(work, nodes, distance)
    seeds = np.concatenate([Node.point(rows), work.forms])
    body = StepBody(work.journal, joined_causes(parts), nodes, distance, seeds, report)
    return Step(work.name, work.pending.structural, body=body)


def joined_step(
    state: HullState, name: str, stages: Sequence[Step], *, notes: tuple[str, ...] = (),
    led: tuple[Led, ...] = (), followed: tuple[tuple[str, float], ...] = (),
) -> Step:  # fmt: skip
    """Give the one step of an edit that was carried out in stages, from the steps of these.

    `notes` are told after those of the stages; `led` and `followed` are as its report has them.
    """
    bodies = [step.body for step in stages]
    journal = Journal()
    for step in stages:
        assert isinstance(step.journal, Journal), "a step that was just made holds its journal"
        journal.entries += step.journal.entries
    before, curves = _shapes_before(state, bodies)
    nodes = np.concatenate([body.changed for body in bodies])
    moved = np.concatenate([body.moved for body in bodies])
    point, curve, form = Node.is_point(nodes), Node.is_curve(nodes), Node.is_form(nodes)
    number = np.where(form, 0, Node.number(nodes))
    here = np.zeros(len(nodes), np.bool_)  # what a later stage took out is no more
    here[point] = state.rows.alive[number[point]]
    here[curve] = state.curves.alive[number[curve]]
    changed, distance = net_difference(
        points_elsewhere(state, journal), before, state.spline, nodes[here], moved[here]
    )
    changed = np.concatenate([changed, distinct(nodes[form])])
    distance = np.concatenate([distance, np.full(len(changed) - len(distance), np.nan)])
    cause = _joined([body.cause for body in bodies])
    seeds = distinct(np.concatenate([body.seeds for body in bodies]))
    report = _joined_report(
        state, name, [body.report for body in bodies], _fairness(state, before, curves),
        _largest_written(state, journal, changed, distance),
    )  # fmt: skip
    notes = (*report.notes, *notes)
    report = attrs.evolve(report, notes=notes, led=led, followed=followed)
    structural = any(step.structural for step in stages)
    body = StepBody(journal, cause, changed, distance, seeds, report)
    return Step(name, structural, body=body)


def _shapes_before(
    state: HullState, bodies: Sequence[StepBody]
) -> tuple[dict[int, SplineBatch], IntArray]:
    """Give splines as before the first stage, and all curves that were lofted and are there."""
    before, seen = dict[int, SplineBatch](), list[int]()
    for body in bodies:
        told = body.report.fairness
        assert isinstance(told, Fairness), "a step that was just made holds its splines"
        # A curve that a stage made has no shape before, whatever later stages found there.
        fresh = [curve for curve in told.curves.tolist() if curve not in seen]
        before |= {curve: told.before[curve] for curve in fresh if curve in told.before}
        seen += fresh
    there = [curve for curve in seen if state.curves.alive[curve]]
    return before, np.array(there, np.int64)


def changed_nodes(
    parts: Sequence[UpdatePass], rows: IntArray, away: FloatArray, fresh: IntArray
) -> tuple[IntArray, FloatArray]:
    """Give the nodes that changed, and by how much: points that were set, then pass by pass."""
    changed, moved = [Node.point(rows), Node.curve(fresh)], [away, np.full(len(fresh), np.nan)]
    for part in parts:
        told = np.isfinite(part.moved) | Node.is_curve(part.changed)
        changed.append(part.changed[told])
        moved.append(part.moved[told])
    return np.concatenate(changed), np.concatenate(moved)


def joined_causes(parts: Sequence[UpdatePass]) -> Readers:
    """Give which node was evaluated because of which, pass by pass."""
    return _joined([part.cause for part in parts])


def _joined(causes: Sequence[Readers]) -> Readers:
    return Readers(
        np.concatenate([cause.reader for cause in causes]),
        np.concatenate([cause.source for cause in causes]),
    )


# --------------------------------------------------------------------------------------
# What an edit of several passes changed in the end: a point may go away and come back.


def net_difference(
    elsewhere: tuple[IntArray, FloatArray],
    before: Mapping[int, SplineBatch],
    spline: Callable[[int], SplineBatch],
    nodes: IntArray,
    moved: FloatArray,
) -> tuple[IntArray, FloatArray]:
    """Keep the nodes that differ by a bit from what they were before the edit.

    Parameters
    ----------
    elsewhere : (k,) int, (k,) float, m
        What `points_elsewhere` gives.
    before : mapping of int to SplineBatch
        The splines of the curves before the edit; a new curve has none.
    spline : callable
        Gives that of a curve after it.
    nodes, moved : (k,) int, (k,) float
        Nodes that changed in any pass, and by how much; a node may stand more than once.

    Returns
    -------
    nodes, moved : (n,) int, (n,) float, m
        Each node once, points first; nan where the edit itself set the point.
    """
    odd = Node.is_curve(nodes)
    rows, away = elsewhere
    away = np.where(np.isin(Node.point(rows), nodes), away, np.nan)
    curves = [
        curve
        for curve in np.unique(Node.number(nodes[odd])).tolist()
        if curve not in before or not _same(before[curve], spline(curve))
    ]
    # Over the whole edit, not in the largest of its sub-steps.
    widest = np.array([moved_curve(before.get(curve), spline(curve)) for curve in curves])
    for place in np.flatnonzero(np.isnan(widest)).tolist():
        widest[place] = np.max(moved[nodes == Node.curve(curves[place])])
    numbers = np.array(curves, np.int64)
    return np.concatenate([Node.point(rows), Node.curve(numbers)]), np.concatenate([away, widest])


def points_elsewhere(state: HullState, journal: Journal) -> tuple[IntArray, FloatArray]:
    """Give the points that lie elsewhere than before an edit, and how far.

    Points that the edit made are left out, and watched ones, which have no value.
    """
    table = state.rows
    rows, old = journal.before(table.xyz)
    marked, was_alive = journal.before(table.alive)
    watched = (table.sort[rows] == Sort.CROSSING) & (table.role[rows] == Role.WATCHED)
    differs = table.alive[rows] & ~watched & bits_differ(old, table.xyz[rows])
    differs &= ~np.isin(rows, marked[~was_alive.astype(bool)])
    step = table.xyz[rows[differs]] - old[differs]
    return rows[differs], np.sqrt((step * step).sum(axis=1))


def _same(one: SplineBatch, other: SplineBatch) -> bool:
    return all(
        np.array_equal(getattr(one, name), getattr(other, name))
        for name in ("knot", "xyz", "leave", "arrive")
    )


# --------------------------------------------------------------------------------------
# The report.


def _report(work: Work, changed: IntArray, moved: FloatArray) -> EditReport:
    state, parts = work.state, work.passes
    curves = work.touched()
    if work.pending.fresh:
        curves = curves[np.sort(np.unique(curves, return_index=True)[1])]
    fairness = _fairness(state, work.network.before, curves)
    largest, normal = _largest_written(state, work.journal, changed, moved)
    return EditReport(
        work.name,
        planned=work.planned,
        relofted=fairness.keys,
        cut_off=sum(len(part.cut_off) for part in parts),
        born=(*work.pending.born, *work.born),
        gone=(*work.pending.gone, *work.gone),
        mended=tuple(work.mended),
        failed=tuple(f"{work.network.name(node)}: {why}" for node, why in work.failed.items()),
        blocked=tuple(work.network.name(node) for part in parts for node in part.blocked.tolist()),
        largest=largest,
        largest_normal=normal,
        largest_gap=0.0 if work.wide is None else work.wide.largest,
        notes=tuple(work.pending.notes),
        carried=tuple(work.pending.carried),
        cut_again=tuple(work.pending.cut_again),
        definitions=form_changes(state, work.journal),
        seconds=work.seconds,
        fairness=fairness,
    )


def _joined_report(
    state: HullState, name: str, reports: Sequence[EditReport], fairness: Fairness,
    largest: tuple[Movement | None, Movement | None],
) -> EditReport:  # fmt: skip
    """Put the reports of stages together; what one made and a later one took out is not told."""
    born = _once(reports, "born")
    gone = _once(reports, "gone")
    phases = dict.fromkeys(phase for each in reports for phase in each.seconds)
    cut_again = _once(reports, "cut_again")
    return EditReport(
        name,
        planned=max(each.planned for each in reports),
        relofted=fairness.keys,
        cut_off=sum(each.cut_off for each in reports),
        born=tuple(each for each in born if each not in gone),
        gone=tuple(each for each in gone if each not in born),
        mended=_once(reports, "mended"),
        failed=reports[-1].failed,
        blocked=reports[-1].blocked,
        largest=largest[0],
        largest_normal=largest[1],
        largest_gap=reports[-1].largest_gap,
        notes=_once(reports, "notes"),
        # Carried is what no stage cut again.
        carried=tuple(each for each in _once(reports, "carried") if each not in cut_again),
        cut_again=cut_again,
        definitions=tuple(each for report in reports for each in report.definitions),
        seconds={phase: sum(each.seconds.get(phase, 0.0) for each in reports) for phase in phases},
        fairness=fairness,
    )


def _once(reports: Sequence[EditReport], field: str) -> tuple[str, ...]:
    """Give the words of a field of all reports, each once, in order."""
    return tuple(dict.fromkeys(each for report in reports for each in getattr(report, field)))


def _fairness(state: HullState, before: dict[int, SplineBatch], curves: IntArray) -> Fairness:
    """Hold the shapes of curves before and after, for counting when asked."""
    after = {curve: state.curves.spline[curve] for curve in curves.tolist()}
    keys = tuple(state.curves.key[curve] for curve in curves.tolist())
    return Fairness(before, after, plane_normals(state, curves), curves, keys)


def _largest_written(
    state: HullState, journal: Journal, changed: IntArray, moved: FloatArray
) -> tuple[Movement | None, Movement | None]:
    """Find the largest movements of an edit that has just been carried out."""
    places = journal.net(state.rows.xyz)
    alive = state.rows.alive[places.rows]
    movements = Movements.of(state, places.rows[alive], places.old[alive])
    return largest_movements(state, movements, changed, moved)


def largest_movements(
    state: HullState, movements: Movements, changed: IntArray, moved: FloatArray
) -> tuple[Movement | None, Movement | None]:
    """Find the largest movement of a point, and the largest along the normal of the hull.

    `changed` and `moved` are nodes and how far they moved; the hull is as its curves lie after the
    edit.
    """
    point = Node.is_point(changed)
    told = point & np.isfinite(moved)
    largest = _largest(state, movements.take(Node.number(changed[told])), moved[told])
    mine = movements.take(Node.number(changed[point & (moved > 0.0)]))
    held = sides_held(mine.curve, mine.parameter, mine.spline)
    distance = along_normal(mine.curve, mine.parameter, held, mine.spline, mine.new - mine.old)
    return largest, _largest(state, mine, distance)


def _largest(state: HullState, movements: Movements, distance: FloatArray) -> Movement | None:
    if not np.isfinite(distance).any():
        return None
    best = int(np.nanargmax(distance))
    x, y, z = movements.new[best].tolist()
    row = int(movements.rows[best])
    key, name = state.rows.key.data[row], AddressBook(state).address(row)
    return Movement(key, float(distance[best]), (x, y, z), name if name != key else "")

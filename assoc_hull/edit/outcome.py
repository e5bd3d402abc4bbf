"""What an edit did: the nodes that changed and why, its report, the finished step.

All is told from arrays of the edit's own, so that it may be told when somebody asks for it, long
after the tables have changed again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.followup.take_up_definitions import form_changes
from assoc_hull.edit.net_difference import net_difference, points_elsewhere
from assoc_hull.edit.report import EditReport, Fairness, Movement
from assoc_hull.edit.step import Step, StepBody
from assoc_hull.edit.update_passes import Work
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.graph.network import Readers
from assoc_hull.graph.run_update import UpdatePass
from assoc_hull.model.gaps import along_normal, sides_held
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["Movements", "changed_nodes", "joined_causes", "largest_movements", "step_of"]

Sequenced = Sequence[UpdatePass]


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


def changed_nodes(
    parts: Sequenced, rows: IntArray, away: FloatArray, fresh: IntArray
) -> tuple[IntArray, FloatArray]:
    """Give the nodes that changed, and by how much: points that were set, then pass by pass."""
    changed, moved = [Node.point(rows), Node.curve(fresh)], [away, np.full(len(fresh), np.nan)]
    for part in parts:
        told = np.isfinite(part.moved) | Node.is_curve(part.changed)
        changed.append(part.changed[told])
        moved.append(part.moved[told])
    return np.concatenate(changed), np.concatenate(moved)


def joined_causes(parts: Sequenced) -> Readers:
    """Give which node was evaluated because of which, pass by pass."""
    return Readers(
        np.concatenate([part.cause.reader for part in parts]),
        np.concatenate([part.cause.source for part in parts]),
    )


def _report(work: Work, changed: IntArray, moved: FloatArray) -> EditReport:
    state, parts = work.state, work.passes
    curves = work.touched()
    if work.pending.fresh:
        curves = curves[np.sort(np.unique(curves, return_index=True)[1])]
    key = state.curves.key.data
    after = {curve: state.curves.spline[curve] for curve in curves.tolist()}
    keys = tuple(key[curve] for curve in curves.tolist())
    places = work.journal.net(state.rows.xyz)
    alive = state.rows.alive[places.rows]
    movements = Movements.of(state, places.rows[alive], places.old[alive])
    largest, normal = largest_movements(state.rows.key.data, movements, changed, moved)
    return EditReport(
        work.name,
        planned=work.planned,
        relofted=keys,
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
        fairness=Fairness(work.network.before, after, plane_normals(state, curves), curves, keys),
    )


def largest_movements(
    key: Sequence[str], movements: Movements, changed: IntArray, moved: FloatArray
) -> tuple[Movement | None, Movement | None]:
    """Find the largest movement of a point, and the largest along the normal of the hull.

    `changed` and `moved` are nodes and how far they moved; the hull is as its curves lie after the
    edit.
    """
    point = Node.is_point(changed)
    told = point & np.isfinite(moved)
    largest = _largest(key, movements.take(Node.number(changed[told])), moved[told])
    mine = movements.take(Node.number(changed[point & (moved > 0.0)]))
    held = sides_held(mine.curve, mine.parameter, mine.spline)
    distance = along_normal(mine.curve, mine.parameter, held, mine.spline, mine.new - mine.old)
    return largest, _largest(key, mine, distance)


def _largest(key: Sequence[str], movements: Movements, distance: FloatArray) -> Movement | None:
    if not np.isfinite(distance).any():
        return None
    best = int(np.nanargmax(distance))
    x, y, z = movements.new[best].tolist()
    return Movement(key[int(movements.rows[best])], float(distance[best]), (x, y, z))

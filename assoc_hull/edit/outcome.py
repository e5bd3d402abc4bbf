"""The finished step of an update, and its report."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.followup.take_up_definitions import form_changes
from assoc_hull.edit.net_difference import net_difference
from assoc_hull.edit.report import EditReport, Fairness, Movement
from assoc_hull.edit.step import Step, StepBody
from assoc_hull.edit.update_passes import Work
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.network import Readers
from assoc_hull.model.gaps import along_normal
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["step_of"]


def step_of(work: Work, rows: IntArray, away: FloatArray) -> Step:
    """Put the finished step together."""
    parts, fresh = work.passes, np.array(work.pending.fresh, np.int64)
    changed, moved = [Node.point(rows), Node.curve(fresh)], [away, np.full(len(fresh), np.nan)]
    for part in parts:
        told = np.isfinite(part.moved) | Node.is_curve(part.changed)
        changed.append(part.changed[told])
        moved.append(part.moved[told])
    nodes, distance = np.concatenate(changed), np.concatenate(moved)
    if len(parts) > 1 or work.pending.structural:
        every = np.concatenate([nodes, *(part.changed for part in parts)])
        known = np.concatenate([distance, *(part.moved for part in parts)])
        nodes, distance = net_difference(
            work.state, work.journal, work.network.before, every, known
        )
    nodes = np.concatenate([nodes, work.forms])
    distance = np.concatenate([distance, np.full(len(work.forms), np.nan)])
    cause = Readers(
        np.concatenate([part.cause.reader for part in parts]),
        np.concatenate([part.cause.source for part in parts]),
    )
    report = _report(work, nodes, distance)
    seeds = np.concatenate([Node.point(rows), work.forms])
    body = StepBody(work.journal, cause, nodes, distance, seeds, report)
    return Step(work.name, work.pending.structural, body=body)


def _report(work: Work, changed: IntArray, moved: FloatArray) -> EditReport:
    state, parts = work.state, work.passes
    curves = work.touched()
    if work.pending.fresh:
        curves = curves[np.sort(np.unique(curves, return_index=True)[1])]
    key = state.curves.key.data
    after = {curve: state.curves.spline[curve] for curve in curves.tolist()}
    keys = tuple(key[curve] for curve in curves.tolist())
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
        largest=_largest(state, changed, moved),
        largest_normal=_largest_normal(work, changed, moved),
        largest_gap=0.0 if work.wide is None else work.wide.largest,
        notes=tuple(work.pending.notes),
        carried=tuple(work.pending.carried),
        cut_again=tuple(work.pending.cut_again),
        definitions=form_changes(state, work.journal),
        seconds=work.seconds,
        fairness=Fairness(work.network.before, after, plane_normals(state, curves), curves, keys),
    )


def _largest(state: HullState, changed: IntArray, moved: FloatArray) -> Movement | None:
    points = Node.is_point(changed) & np.isfinite(moved)
    if not points.any():
        return None
    best = int(np.nanargmax(moved[points]))
    row = Node.number(int(changed[points][best]))
    place = tuple(state.rows.xyz[row].tolist())
    return Movement(state.rows.key[row], float(moved[points][best]), place)


def _largest_normal(work: Work, changed: IntArray, moved: FloatArray) -> Movement | None:
    """Find the largest movement along the normal of the hull, as its curves lie after the edit."""
    state = work.state
    rows = Node.number(changed[Node.is_point(changed) & (moved > 0.0)])
    places = work.journal.net(state.rows.xyz)
    known = np.isin(rows, places.rows)
    rows = rows[known & state.rows.alive[np.where(known, rows, 0)]]
    if not len(rows):
        return None
    away = state.rows.xyz[rows] - places.old[np.searchsorted(places.rows, rows)]
    distance = along_normal(state, rows, away)
    if not np.isfinite(distance).any():
        return None
    best = int(np.nanargmax(distance))
    x, y, z = state.rows.xyz[rows[best]].tolist()
    return Movement(state.rows.key[int(rows[best])], float(distance[best]), (x, y, z))

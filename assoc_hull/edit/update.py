"""From pending modifications to a finished step: plan, run, mend, check.

The main pass lofts each curve at most once. A second pass follows only for crossings that
came or went, and for gaps that are mended; it lofts only the curves these touch.
"""

from __future__ import annotations

import time

import attrs
import numpy as np

from assoc_hull.edit.check import (
    Wide,
    find_beyond,
    find_folds,
    find_unbounded,
    find_unmet,
    measure_gaps,
    plane_normals,
    splines_of,
)
from assoc_hull.edit.document import Document
from assoc_hull.edit.field import Field, add_shifts, context, land, sub_steps
from assoc_hull.edit.mend import mend
from assoc_hull.edit.net_change import net_change
from assoc_hull.edit.report import EditReport, Fairness, Movement, Step
from assoc_hull.edit.ride import rebase, ride_links
from assoc_hull.edit.topology import latent_meetings, settle
from assoc_hull.edit.trouble import blocked_nodes, note_states
from assoc_hull.errors import AssocHullError, RefusedEditError, RingError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.node import Readers
from assoc_hull.graph.run import Pass, Policy, run
from assoc_hull.model.address import address
from assoc_hull.model.family import Sort, State
from assoc_hull.model.make import Maker
from assoc_hull.model.network import HullNetwork, bits_differ
from assoc_hull.model.state import HullState, curve_node, row_node

__all__ = ["Pending", "Settings", "update"]

_NONE: IntArray = np.zeros(0, np.int64)
_ROUNDS = 6
"""Crossings that come make others come, seldom more than twice."""


@attrs.frozen
class Settings:
    """How an edit is carried out.

    Attributes
    ----------
    policy : Policy
        What becomes of an edit when a curve cannot be made.
    refuse_gaps : bool
        Whether a watched gap that stays over its limit refuses the edit; else it is kept
        as a defect that a check names.
    """

    policy: Policy = Policy.ALL_OR_NOTHING
    refuse_gaps: bool = True


@attrs.define(eq=False)
class Pending:
    """What the modifications of a transaction ask for.

    Attributes
    ----------
    values : dict of int to (3,), m
        New places of points.
    curves : set of int
        Curves whose recipe changed.
    computed : set of int
        Crossings that have come to be computed from another curve than before, or from one.
    held : set of int
        Adopted points that a field moves: they do not ride in this update.
    structural : bool
        Whether lines, points, roles or associations came or went.
    moved_curves : set of int
        Curves that the designer edited: births take their value from these.
    fields : list of Field
        Displacements of the hull; several add.
    born, gone : list of str
        Keys of curves and crossings that the modifications made or unmade.
    fresh : list of int
        Curves that were made in this transaction.
    notes : list of str
        What was left alone, and why.
    """

    values: dict[int, FloatArray] = attrs.field(factory=dict)
    curves: set[int] = attrs.field(factory=set)
    computed: set[int] = attrs.field(factory=set)
    held: set[int] = attrs.field(factory=set)
    structural: bool = False
    moved_curves: set[int] = attrs.field(factory=set)
    fields: list[Field] = attrs.field(factory=list)
    born: list[str] = attrs.field(factory=list)
    gone: list[str] = attrs.field(factory=list)
    fresh: list[int] = attrs.field(factory=list)
    notes: list[str] = attrs.field(factory=list)


@attrs.define(eq=False)
class _Work:
    """One update while it runs."""

    document: Document
    name: str
    journal: Journal
    pending: Pending
    settings: Settings
    network: HullNetwork
    passes: list[Pass] = attrs.field(factory=list)
    born: list[str] = attrs.field(factory=list)
    gone: list[str] = attrs.field(factory=list)
    mended: list[str] = attrs.field(factory=list)
    seconds: dict[str, float] = attrs.field(factory=dict)
    failed: dict[int, str] = attrs.field(factory=dict)
    wide: Wide | None = None
    planned: int = 0

    @property
    def state(self) -> HullState:
        return self.document.state

    def evaluated(self) -> IntArray:
        """Curves evaluated in any pass, in order, each once."""
        nodes = np.concatenate([_NONE, *(part.evaluated for part in self.passes)])
        curves: IntArray = nodes[(nodes & 1) == 1] >> 1
        if len(self.passes) == 1:
            return curves  # in one pass no node stands twice
        once: IntArray = curves[np.sort(np.unique(curves, return_index=True)[1])]
        return once

    def touched(self) -> IntArray:
        """Curves evaluated in any pass or made in this edit, but for those removed since."""
        fresh = np.array(self.pending.fresh, np.int64)
        curves = np.concatenate([self.evaluated(), fresh]) if len(fresh) else self.evaluated()
        alive: IntArray = curves[self.state.curves.alive.data[curves]]
        return alive

    def go(self, rows: IntArray, curves: IntArray) -> None:
        """Run one pass from points that were set and curves whose recipe changed."""
        if not self.passes:
            seeds = np.concatenate([row_node(rows), curve_node(curves)])
            self.planned = self.network.reached(seeds)
        held = row_node(np.array(sorted(self.pending.held), np.int64))
        blocked = blocked_nodes(self.network, self.state.failed)
        result = run(
            self.network, row_node(rows), self.journal, self.settings.policy,
            also=self._also(curves), held=np.concatenate([held, blocked]),
        )  # fmt: skip
        self.passes.append(result)
        self.failed |= result.failed
        note_states(self.network, result, self.journal)
        freed = blocked
        if len(blocked):
            freed = np.setdiff1d(blocked, blocked_nodes(self.network, self.state.failed))
        if len(freed):
            self.passes.append(
                run(self.network, _NONE, self.journal, self.settings.policy, also=freed, held=held)
            )

    def _also(self, curves: IntArray) -> IntArray:
        """Give the nodes to evaluate although nothing they read has changed; each only once."""
        rows, table = np.array(sorted(self.pending.computed), np.int64), self.state.rows
        self.pending.computed.clear()
        rows = rows[table.alive.data[rows] & (table.driver.data[rows] >= 0)]
        return np.concatenate([curve_node(curves), row_node(rows)])

    def renew(self) -> None:
        """Derive the look-ups anew after crossings or points came or went."""
        self.pending.structural = True
        self.document.refresh()
        self.network.index = self.document.index


def update(
    document: Document, name: str, journal: Journal, pending: Pending, settings: Settings
) -> Step:
    """Carry out what is pending, and give the finished step.

    Raises
    ------
    RefusedEditError
        With all findings: a curve that cannot be lofted or folds, a gap over its limit.
    RingError
        If driven links would run in a ring.
    """
    begin = time.perf_counter()
    origin = document.state.rows.xyz.data.copy() if pending.fields else np.zeros((0, 3))
    rows, away = _set_values(document.state, journal, pending)
    if pending.structural:
        _link_riders(document.state, journal, pending)
        document.refresh()
    network = HullNetwork(document.state, document.index)
    work = _Work(document, name, journal, pending, settings, network)
    try:
        if pending.fields:
            rows, away = _run_fields(work, rows, origin)
        else:
            work.go(rows, np.array(sorted(pending.curves), np.int64))
            _settle(work)
        for curve in pending.fresh:
            network.before.pop(curve, None)
        ran = time.perf_counter()
        findings = _check(work)
    except RingError:
        raise
    except (AssocHullError, ArithmeticError) as error:
        raise RefusedEditError(name, (str(error),)) from error
    if findings:
        raise RefusedEditError(name, findings)
    work.seconds |= {"run": ran - begin, "check": time.perf_counter() - ran}
    return _step(work, rows, away)


def _set_values(
    state: HullState, journal: Journal, pending: Pending
) -> tuple[IntArray, FloatArray]:
    """Write the new places that differ from the old by a bit; give them with the distances."""
    rows = np.array(sorted(pending.values), np.int64)
    rows = rows[state.rows.alive.data[rows]]
    if not len(rows):
        return rows, np.zeros(0)
    value = np.array([pending.values[row] for row in rows.tolist()]) + 0.0
    old = state.rows.xyz.data[rows]
    differs = bits_differ(old, value)
    journal.put(state.rows.xyz, rows[differs], value[differs])
    step = value[differs] - old[differs]
    return rows[differs], np.sqrt((step * step).sum(axis=1))


def _link_riders(state: HullState, journal: Journal, pending: Pending) -> None:
    """Link adopted points to their neighbours, which may be others than before."""
    curves = np.array(sorted(pending.curves | set(pending.fresh)), np.int64)
    ride_links(state, curves[state.curves.alive.data[curves]], journal)


def _run_fields(work: _Work, rows: IntArray, origin: FloatArray) -> tuple[IntArray, FloatArray]:
    """Run the fields, in sub-steps where they are large; give all points that were set.

    `origin` holds where all points lay before; the distances are from there.
    """
    state, fields = work.state, work.pending.fields
    across = any(field.across_flats for field in fields)
    pinned = set(work.pending.values)
    ground = context(state, across_flats=across)
    shift = add_shifts([field.shift(ground, 1.0) for field in fields], pinned)
    steps = sub_steps(state, shift)
    curves = np.array(sorted(work.pending.curves), np.int64)
    touched: set[int] = set(rows.tolist())
    for step in range(steps):
        if step:
            ground = context(state, across_flats=across)
        shift = add_shifts([field.shift(ground, 1.0 / steps) for field in fields], pinned)
        before = state.rows.xyz.data.copy()
        work.journal.put(state.rows.xyz, shift.rows, state.rows.xyz.data[shift.rows] + shift.delta)
        if step == steps - 1:
            land(state, work.journal, fields)
        shifted = np.flatnonzero(bits_differ(before, state.rows.xyz.data))
        adopted = state.rows.sort.data[shifted] == Sort.ADOPTED
        work.pending.held |= set(shifted[adopted].tolist())
        touched |= set(shifted.tolist())
        seeds = np.union1d(shifted, rows) if step == 0 else shifted
        work.go(seeds, curves if step == 0 else _NONE)
        _settle(work)
    work.pending.notes += [
        f"{address(state, row)}: left alone, it is free almost along the hull only"
        for row in shift.left.tolist()
    ]
    rebase(state, np.array(sorted(work.pending.held), np.int64), work.journal)
    work.pending.held.clear()
    every = np.array(sorted(touched), np.int64)
    every = every[every < len(origin)]
    every = every[bits_differ(state.rows.xyz.data[every], origin[every])]
    moved = state.rows.xyz.data[every] - origin[every]
    return every, np.sqrt((moved * moved).sum(axis=1))


def _settle(work: _Work) -> None:
    """Let crossings come and go until every meeting has its place."""
    for _ in range(_ROUNDS):
        alignments, work.network.realigned = work.network.realigned, []
        latent = latent_meetings(work.state, work.touched())
        if not alignments and not latent:
            return
        maker = Maker(work.state, work.journal)
        change = settle(maker, alignments, latent, work.pending.moved_curves)
        work.born += change.born
        work.gone += change.gone
        curves = np.array(change.curves, np.int64)
        if change.born or change.gone:
            ride_links(work.state, curves, work.journal)
            work.renew()
        if not len(curves):
            return
        work.go(_NONE, curves)


def _check(work: _Work) -> tuple[str, ...]:
    """Check what was evaluated; mend gaps once; give all findings that refuse the edit."""
    curves = work.touched()
    wide = measure_gaps(work.state, curves, work.journal, work.network.index)
    if len(wide.rows) and not any(field.strict for field in work.pending.fields):
        touched, moved = mend(Maker(work.state, work.journal), wide.mend)
        if len(touched):
            work.mended += [work.state.curves.key.data[curve] for curve in touched.tolist()]
            work.renew()
            work.go(moved, touched)
            _settle(work)
            curves = work.touched()
            wide = measure_gaps(work.state, curves, work.journal, work.network.index)
    work.wide = wide
    clean = curves[work.state.curves.state.data[curves] == State.CLEAN]
    batch = splines_of(work.state, clean)
    findings = find_unbounded(work.state, clean, batch)
    findings += find_folds(work.state, clean, batch, work.network.before)
    findings += find_beyond(work.state, clean, batch)
    if work.pending.structural:
        findings += find_unmet(work.state, clean)
    if work.settings.refuse_gaps:
        findings += tuple(_gap_text(work, i) for i in range(len(wide.rows)))
    return findings


def _gap_text(work: _Work, index: int) -> str:
    wide = work.wide
    assert wide is not None
    row = int(wide.rows[index])
    x, y, z = work.state.rows.spot.data[row, 0].tolist()
    return (
        f"{address(work.state, row)}: the two curves pass {1e3 * wide.gap[index]:.1f} mm apart "
        f"at ({x:.3f}, {y:.3f}, {z:.3f}) m, over the limit of {1e3 * wide.limit[index]:.1f} mm; "
        "make the move smaller, use a field, or ask for gaps='report'"
    )


def _step(work: _Work, rows: IntArray, away: FloatArray) -> Step:
    """Put the finished step together."""
    parts, fresh = work.passes, np.array(work.pending.fresh, np.int64)
    changed, moved = [row_node(rows), curve_node(fresh)], [away, np.full(len(fresh), np.nan)]
    for part in parts:
        told = np.isfinite(part.moved) | ((part.changed & 1) == 1)
        changed.append(part.changed[told])
        moved.append(part.moved[told])
    nodes, distance = np.concatenate(changed), np.concatenate(moved)
    if len(parts) > 1 or work.pending.structural:
        every = np.concatenate([nodes, *(part.changed for part in parts)])
        known = np.concatenate([distance, *(part.moved for part in parts)])
        nodes, distance = net_change(work.state, work.journal, work.network.before, every, known)
    cause = Readers(
        np.concatenate([part.cause.reader for part in parts]),
        np.concatenate([part.cause.source for part in parts]),
    )
    return Step(
        work.name, work.journal, cause, nodes, distance, row_node(rows),
        work.pending.structural, _report(work, nodes, distance),
    )  # fmt: skip


def _report(work: _Work, changed: IntArray, moved: FloatArray) -> EditReport:
    state, parts = work.state, work.passes
    curves = work.touched()
    if work.pending.fresh:
        curves = curves[np.sort(np.unique(curves, return_index=True)[1])]
    key = state.curves.key.data
    after = {curve: state.curves.spline.data[curve] for curve in curves.tolist()}
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
        largest_gap=0.0 if work.wide is None else work.wide.largest,
        notes=tuple(work.pending.notes),
        seconds=work.seconds,
        fairness=Fairness(work.network.before, after, plane_normals(state, curves), curves, keys),
    )


def _largest(state: HullState, changed: IntArray, moved: FloatArray) -> Movement | None:
    points = ((changed & 1) == 0) & np.isfinite(moved)
    if not points.any():
        return None
    best = int(np.nanargmax(moved[points]))
    row = int(changed[points][best]) >> 1
    place = tuple(state.rows.xyz.data[row].tolist())
    return Movement(state.rows.key.data[row], float(moved[points][best]), place)

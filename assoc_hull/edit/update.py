"""From pending modifications to a finished step: plan, run, mend, check.

The main pass lofts each curve at most once. A second pass follows only for crossings that
came or went, and for gaps that are mended; it lofts only the curves these touch.
"""

from __future__ import annotations

import time

import attrs
import numpy as np

from assoc_hull.edit.checks.shape_findings import find_turned
from assoc_hull.edit.checks.update_findings import (
    ends_at_risk,
    find_beyond,
    find_endless,
    find_folds,
    find_unbounded,
    find_unmet,
    measure_gaps,
    note_new_ends,
    splines_of,
)
from assoc_hull.edit.displacement_field import unreached
from assoc_hull.edit.document import Document
from assoc_hull.edit.followup.adopted_points import (
    link_adopted_points,
    mend_gaps,
)
from assoc_hull.edit.followup.crossings import (
    latent_intersections,
    rejoin_crossings,
    settle_crossings,
)
from assoc_hull.edit.followup.detach_curves import (
    detach,
    detach_rows,
    detached_note,
    off_definitions,
    tidy,
)
from assoc_hull.edit.followup.refine_curves import refine_forms
from assoc_hull.edit.followup.reorder_crossings import limit_watched, renew_followers, widen_limits
from assoc_hull.edit.followup.settle_features import settle_features
from assoc_hull.edit.followup.take_up_definitions import take_up_forms
from assoc_hull.edit.mapped_features import CarriedFeatures
from assoc_hull.edit.nudge import Nudge, write_nudge
from assoc_hull.edit.outcome import step_of
from assoc_hull.edit.pending_changes import Pending, Settings
from assoc_hull.edit.program_edit import ProgramEdit
from assoc_hull.edit.run_fields import run_fields
from assoc_hull.edit.step import Step
from assoc_hull.edit.update_passes import Work
from assoc_hull.errors import AssocHullError, RefusedEditError, RingError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import address
from assoc_hull.model.generated_curves import attached_curves
from assoc_hull.model.kinds import Sort, State
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.network import HullNetwork, bits_differ
from assoc_hull.model.tables import HullState

__all__ = ["update"]

_NONE: IntArray = np.zeros(0, np.int64)
_ROUNDS = 6
"""Crossings that come make others come, seldom more than twice."""


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
    # What was written by now (a role, a limit, a name) the program does not know of.
    program = None if journal.entries else ProgramEdit.of(document, pending)
    if program is not None:
        rows, away = _set_values(document.state, journal, pending)
        step = program.run(name, journal, settings, rows, away)
        if step is not None:
            return step
        journal.undo()
        pending.held.clear()
        program.take_back()
    begin = time.perf_counter()
    origin = document.state.rows.xyz.data.copy() if pending.fields else np.zeros((0, 3))
    try:
        forms = take_up_forms(document.state, journal, pending)
    except AssocHullError as error:
        raise RefusedEditError(name, (str(error),)) from error
    rows, away = _set_values(document.state, journal, pending)
    if pending.structural:
        _link_riders(document.state, journal, pending)
        document.refresh()
    network = HullNetwork(document.state, document.index)
    work = Work(document, name, journal, pending, settings, network, forms=forms)
    try:
        if pending.fields:
            rows, away = _run_fields(work, rows, origin)
        else:
            work.go(rows, np.array(sorted(pending.curves), np.int64))
            _in_order(work)
            _settle(work)
            _relink(work)
            _follow_up(work)
        _refine(work)
        limit_watched(work)
        for curve in pending.fresh:
            network.before.pop(curve, None)
        ran = time.perf_counter()
        findings = _check(work)
        if pending.nudge is not None and not findings:
            _run_nudge(work, pending.nudge)  # gaps have been mended: points are all there
            findings = _check(work)
        _confirm(work)
    except (RingError, RefusedEditError):
        raise
    except (AssocHullError, ArithmeticError) as error:
        raise RefusedEditError(name, (str(error),)) from error
    if findings:
        raise RefusedEditError(name, findings)
    settle_features(work, rows, np.concatenate([rows, work.changed_points()]))
    work.seconds |= {"run": ran - begin, "check": time.perf_counter() - ran}
    return step_of(work, rows, away)


def _set_values(
    state: HullState, journal: Journal, pending: Pending
) -> tuple[IntArray, FloatArray]:
    """Write the new places that differ from the old by a bit; give them with the distances."""
    rows = np.array(sorted(pending.values), np.int64)
    rows = rows[state.rows.alive[rows]]
    if not len(rows):
        return rows, np.zeros(0)
    value = np.array([pending.values[row] for row in rows.tolist()]) + 0.0
    old = state.rows.xyz[rows]
    differs = bits_differ(old, value)
    journal.put(state.rows.xyz, rows[differs], value[differs])
    step = value[differs] - old[differs]
    return rows[differs], np.sqrt((step * step).sum(axis=1))


def _link_riders(state: HullState, journal: Journal, pending: Pending) -> None:
    """Link adopted points to their neighbours, which may be others than before."""
    curves = np.array(sorted(pending.curves | set(pending.fresh)), np.int64)
    link_adopted_points(state, curves[state.curves.alive[curves]], journal)


def _run_fields(work: Work, rows: IntArray, origin: FloatArray) -> tuple[IntArray, FloatArray]:
    """Run the fields; give all points that were set, and how far they are from where they lay."""
    first = np.array(sorted(work.pending.curves), np.int64)

    def go(seeds: IntArray) -> bool:
        work.go(seeds, _NONE if work.passes else first)
        _settle(work)
        return True

    def detach_from(rows: IntArray) -> None:
        if detach_rows(Maker(work.state, work.journal), work.pending, rows):
            work.renew()

    found = run_fields(work.state, work.journal, work.pending, rows, origin, go, detach_from)
    assert found is not None, "every update says that it goes on"
    work.pending.held.clear()
    return found


def _settle(work: Work) -> None:
    """Let crossings come and go until every meeting has its place."""
    for _ in range(_ROUNDS):
        alignments, work.network.realigned = work.network.realigned, []
        maker = Maker(work.state, work.journal)
        rejoin_crossings(maker, alignments)
        latent = latent_intersections(work.state, work.touched())
        if not alignments and not latent:
            return
        work.ends += ends_at_risk(work.state, alignments)
        change = settle_crossings(maker, alignments, latent, work.pending.moved_curves)
        work.pending.notes += note_new_ends(work.state, alignments)
        work.born += change.born
        work.gone += change.gone
        curves = np.array(change.curves, np.int64)
        if change.born or change.gone:
            link_adopted_points(work.state, curves, work.journal)
            work.renew()
        if not len(curves):
            return
        work.go(_NONE, curves)


def _relink(work: Work) -> None:
    """Let adopted points that were carried ride from where they and their neighbours are now."""
    held, curves = work.pending.held, np.array(sorted(work.pending.relink), np.int64)
    curves = curves[work.state.curves.alive[curves]]
    link_adopted_points(work.state, curves, work.journal)
    if len(curves):
        work.renew()
    held.clear()


def _follow_up(work: Work) -> None:
    """Do what waits for the main pass, and run a second pass for the curves that it touches."""
    pending = work.pending
    if not pending.after:
        return
    pending.curves.clear()
    for act in pending.after:
        act()
    _link_riders(work.state, work.journal, pending)
    work.renew()
    live = [curve for curve in sorted(pending.curves) if work.state.curves.alive[curve]]
    work.go(_NONE, np.array(live, np.int64))
    _settle(work)


def _refine(work: Work) -> None:
    """Give generated curves the points that they have come to need, and let others follow."""
    if not attached_curves(work.state) or work.pending.alone:
        return
    curves = refine_forms(work, work.touched())
    if curves:
        work.go(_NONE, np.array(curves, np.int64))
        _in_order(work)
        _settle(work)


def _in_order(work: Work) -> None:
    """Choose anew what defines lines on which crossings have passed one another."""
    if not (work.pending.forms or work.pending.attach):
        return
    for _ in range(_ROUNDS):
        curves, watched = renew_followers(work)
        work.watched += watched
        if not curves:
            return
        work.go(_NONE, np.array(curves, np.int64))


def _confirm(work: Work) -> None:
    """Detach what this update has bent off its definitions, and tell what has been detached."""
    pending, state = work.pending, work.state
    maker = Maker(state, work.journal)
    if attached_curves(state) and (pending.structural or pending.fields):
        off = off_definitions(state, work.touched().tolist())
        detach(maker, pending, off)
        if off:
            work.renew()
    if pending.structural and state.generated:
        tidy(maker)
    pending.notes += detached_note(state, pending.detached)


def _run_nudge(work: Work, by: Nudge) -> None:
    """Move the hull as it has become by a little, and let what is computed follow."""
    pending, state = work.pending, work.state
    curves = state.live("curves")
    carried = pending.features or CarriedFeatures(state.features, frozenset(), by.within)
    rows, moved = write_nudge(state, work.journal, by, carried.features)
    pending.features = attrs.evolve(carried, features=moved)
    live = state.live("rows")
    pending.held |= set(live[state.rows.sort[live] == Sort.ADOPTED].tolist())
    pending.relink |= set(curves.tolist())
    pending.computed |= set(live[state.rows.driver[live] >= 0].tolist())
    work.renew()
    work.go(rows, curves)
    _settle(work)
    _relink(work)


def _check(work: Work) -> tuple[str, ...]:
    """Check what was evaluated; mend gaps once; give all findings that refuse the edit."""
    curves = work.touched()
    wide = measure_gaps(work.state, curves, work.journal, work.network.index)
    if len(wide.rows) and not any(field.strict for field in work.pending.fields):
        touched, moved = mend_gaps(Maker(work.state, work.journal), wide.mend)
        if len(touched):
            work.mended += [work.state.curves.key[curve] for curve in touched.tolist()]
            work.renew()
            work.go(moved, touched)
            _settle(work)
            curves = work.touched()
            wide = measure_gaps(work.state, curves, work.journal, work.network.index)
    if len(wide.rows) and work.pending.forms and widen_limits(work, wide):
        wide = measure_gaps(work.state, curves, work.journal, work.network.index)
    work.wide = wide
    clean = curves[work.state.curves.state[curves] == State.CLEAN]
    batch = splines_of(work.state, clean)
    findings = find_unbounded(work.state, clean, batch)
    findings += find_folds(work.state, clean, batch, work.network.before)
    findings += find_turned(work.state, clean) + find_beyond(
        work.state, clean, batch, work.network.before
    )
    findings += tuple(unreached(work.state, work.pending.fields, work.pending.values.keys()))
    findings += find_endless(work.state, work.ends)
    if work.pending.structural:
        findings += find_unmet(work.state, clean)
    if work.settings.refuse_gaps:
        findings += tuple(_gap_text(work, i) for i in range(len(wide.rows)))
    return findings


def _gap_text(work: Work, index: int) -> str:
    wide = work.wide
    assert wide is not None
    row = int(wide.rows[index])
    x, y, z = work.state.rows.spot[row, 0].tolist()
    return (
        f"{address(work.state, row)}: the two curves pass {1e3 * wide.gap[index]:.1f} mm apart "
        f"at ({x:.3f}, {y:.3f}, {z:.3f}) m, over the limit of {1e3 * wide.limit[index]:.1f} mm; "
        "make the move smaller, use a field, or ask for gaps='report'"
    )

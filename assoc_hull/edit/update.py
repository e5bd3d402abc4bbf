"""From pending modifications to a finished step: plan, run, mend, check.

The main pass lofts each curve at most once. A second pass follows only for crossings that
came or went, and for gaps that are mended; it lofts only the curves these touch.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np

from assoc_hull.edit.carried_net import CarriedNet, Nudged
from assoc_hull.edit.checks.update_findings import (
    find_beyond,
    find_endless,
    find_folds,
    find_turned,
    find_unbounded,
    find_unmet,
    measure_gaps,
    splines_of,
)
from assoc_hull.edit.crossings.adopted_points import mend_gaps
from assoc_hull.edit.displacement_field import PullField
from assoc_hull.edit.document import Document
from assoc_hull.edit.field_moves import DrawnRuns, FieldMoves, SpreadAreas
from assoc_hull.edit.followup.redraw_features import redraw_features
from assoc_hull.edit.followup.settle_features import affected_features, settle_features
from assoc_hull.edit.followup.take_up_definitions import DefinitionValues
from assoc_hull.edit.modification import Modification, Pending, Work
from assoc_hull.edit.outcome import step_of
from assoc_hull.edit.program_edit import ProgramEdit
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.step import Step
from assoc_hull.errors import AssocHullError, RefusedEditError, RingError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import address
from assoc_hull.model.kinds import State
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.network import HullNetwork, bits_differ
from assoc_hull.model.tables import HullState

__all__ = ["KINDS", "update"]

KINDS: tuple[type[Modification], ...] = (
    Nudged, DefinitionValues, FieldMoves, CarriedNet, DrawnRuns, SpreadAreas,
)  # fmt: skip
"""Kinds of modification that take more than places and recipes, in the order in which each stage
of an update turns to them: a nudge moves a hull before curves are found to be off definitions."""


def update(
    document: Document, name: str, journal: Journal, pending: Pending, settings: Settings,
    *, by_program: bool = True,
) -> Step:  # fmt: skip
    """Carry out what is pending, and give the finished step; by the program, where that can.

    Raises
    ------
    RefusedEditError
        With all findings: a curve that cannot be lofted or folds, a gap over its limit.
    RingError
        If driven links would run in a ring.
    """
    # What was written by now (a role, a limit, a name) the program does not know of.
    quick = by_program and not journal.entries
    program = ProgramEdit.of(document, pending) if quick else None
    if program is not None:
        try:
            set_by = _set_values(document.state, journal, pending)
            step = program.run(name, journal, settings, *set_by)
        except RefusedEditError:
            raise
        except (AssocHullError, ArithmeticError):
            step = None  # the full way says what is wrong, in its words
        if step is not None:
            return step
        journal.undo()
        pending.held.clear()
        program.take_back()
    for kind in KINDS:
        if kind.concerns(document.state):
            pending.ask(kind)
    network = HullNetwork(document.state, document.index)
    work = Work(document, name, journal, pending, settings, network)
    asked = [pending.modifications[kind] for kind in KINDS if kind in pending.modifications]
    try:
        rows, away, findings = _carry_out(work, asked)
    except (RingError, RefusedEditError):
        raise
    except (AssocHullError, ArithmeticError) as error:
        raise RefusedEditError(name, (str(error),)) from error
    if findings:
        raise RefusedEditError(name, findings)
    rows, away = _redraw_features(work, rows, away, asked)
    settle_features(work, rows, np.concatenate([rows, work.changed_points()]))
    return step_of(work, rows, away)


def _redraw_features(
    work: Work, rows: IntArray, away: FloatArray, asked: Sequence[Modification]
) -> tuple[IntArray, FloatArray]:
    """Draw bent features anew; give all points that were set, and how far they moved, m."""
    pending, state = work.pending, work.state
    changed = np.concatenate([rows, work.changed_points()])
    if not affected_features(work, rows, changed)[0]:
        return rows, away
    fixed = set(pending.values).union(
        *(each.tolist() for kind in asked for each, _ in kind.landing())
    )
    moves = pending.asked(FieldMoves)
    fields = () if moves is None else moves.fields
    fixed |= {each.row for each in fields if isinstance(each, PullField)}
    drawn = redraw_features(work, rows, fixed, lambda: not _findings(work, asked, work.touched()))
    drawn = np.setdiff1d(drawn, rows)
    if not len(drawn):
        return rows, away
    known, old = work.journal.before(state.rows.xyz)
    step = state.rows.xyz[drawn] - old[np.searchsorted(known, drawn)]
    return np.concatenate([rows, drawn]), np.concatenate([away, np.sqrt((step * step).sum(axis=1))])


def _carry_out(
    work: Work, asked: Sequence[Modification]
) -> tuple[IntArray, FloatArray, tuple[str, ...]]:
    """Run all passes; give the points that were set, how far they moved, m, and what is wrong."""
    begin, pending = time.perf_counter(), work.pending
    origin = work.state.rows.xyz.data.copy() if pending.displaces else np.zeros((0, 3))
    for each in asked:
        each.plan(work)
    rows, away = _set_values(work.state, work.journal, pending)
    if pending.structural:
        work.link_riders()
        work.renew()
    found = [by for each in asked if (by := each.run(work, rows, origin)) is not None]
    if found:
        rows, away = found[0]
    else:
        work.go(rows, np.array(sorted(pending.curves), np.int64))
        for each in asked:
            each.arrange(work)
        work.settle()
        for each in asked:
            each.follow(work)
    for each in asked:
        each.refine(work)
    for curve in pending.fresh:
        work.network.before.pop(curve, None)
    ran = time.perf_counter()
    findings = _check(work, asked)
    for each in asked:
        if not findings and each.finish(work):
            findings = _check(work, asked)
    work.seconds |= {"run": ran - begin, "check": time.perf_counter() - ran}
    return rows, away, findings


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
    # A point that was set by hand is given there: fairing has not moved it any more. A mapping has
    # carried what was given.
    faired = rows[state.rows.faired.take(rows).any(axis=1)]
    if len(faired) and not pending.alone:
        journal.put(state.rows.faired, faired, 0.0)
    step = value[differs] - old[differs]
    return rows[differs], np.sqrt((step * step).sum(axis=1))


def _check(work: Work, asked: Sequence[Modification]) -> tuple[str, ...]:
    """Check what was evaluated; mend gaps once; give all findings that refuse the edit."""
    curves = work.touched()
    wide = measure_gaps(work.state, curves, work.journal, work.network.index)
    if len(wide.rows) and not any(each.strict for each in asked):
        touched, moved = mend_gaps(Maker(work.state, work.journal), wide.mend)
        if len(touched):
            work.mended += [work.state.curves.key[curve] for curve in touched.tolist()]
            work.renew()
            work.go(moved, touched)
            work.settle()
            curves = work.touched()
            wide = measure_gaps(work.state, curves, work.journal, work.network.index)
    if len(wide.rows) and sum(each.allow(work, wide) for each in asked):
        wide = measure_gaps(work.state, curves, work.journal, work.network.index)
    work.wide = wide
    return _findings(work, asked, curves)


def _findings(work: Work, asked: Sequence[Modification], curves: IntArray) -> tuple[str, ...]:
    """Give what stands against the curves as they are, gaps as they were measured last."""
    wide = work.wide
    assert wide is not None, "gaps are measured before"
    clean = curves[work.state.curves.state[curves] == State.CLEAN]
    batch = splines_of(work.state, clean)
    findings = find_unbounded(work.state, clean, batch)
    findings += find_folds(work.state, clean, batch, work.network.before)
    findings += find_turned(work.state, clean) + find_beyond(
        work.state, clean, batch, work.network.before
    )
    for each in asked:
        findings += tuple(each.check(work))
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

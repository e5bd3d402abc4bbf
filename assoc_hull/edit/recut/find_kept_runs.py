"""Which points of lines that are cut wholly anew a mapping leaves where they are."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.newline.kept_runs import Run, Stays
from assoc_hull.edit.recut.carried_points import Carried
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.state import HullState, Meets

__all__ = ["find_stays"]

_SHORTEST = 2
"""A run has at least so many points."""


def find_stays(work: Carried) -> None:
    """Find what stays of the lines that are to be cut anew.

    A crossing of two such lines stays if it does on both.
    """
    state = work.state
    spans = {line: _spans(work, line) for line in work.anew}
    found = {line: {row for run in runs for row in run.every()} for line, runs in spans.items()}
    both = {
        row for line, rows in found.items() for row in rows
        if all(row in found.get(state.line_of(curve), rows)
               for curve in state.rows.curve.data[row].tolist() if curve >= 0)
    }  # fmt: skip
    work.held |= both
    for line, runs in spans.items():
        work.stays[line] = Stays(tuple(_left(run, both) for run in runs), _roles(state, both, line))


def _spans(work: Carried, line: int) -> list[Run]:
    """Give the runs of a line that the mapping leaves where they are."""
    found = list[Run]()
    for curve in work.state.lines.curves.data[line]:
        rows: IntArray = work.state.curves.rows.data[curve]
        knot = work.state.spline(curve).knot
        edge = np.diff(np.concatenate([[False], work.still[rows], [False]]).astype(np.int64))
        for first, last in zip(
            np.flatnonzero(edge == 1).tolist(), np.flatnonzero(edge == -1).tolist(), strict=True
        ):
            if last - first >= _SHORTEST:
                span = float(knot[first]), float(knot[last - 1])
                found.append(Run(curve, rows[first:last], _passed(work, curve, span), span))
    return found


def _passed(work: Carried, curve: int, span: tuple[float, float]) -> IntArray:
    """Give the crossings within a span of a curve that do not define it, and stay."""
    meets: Meets = work.state.curves.meets.data[curve]
    inside = (meets.parameter >= span[0]) & (meets.parameter <= span[1]) & (meets.row >= 0)
    rows = np.setdiff1d(meets.row[inside], work.state.curves.rows.data[curve])
    found: IntArray = rows[work.still[rows]]
    return found


def _left(run: Run, rows: set[int]) -> Run:
    """Leave out the points of a run that do not stay."""
    kept = np.array(sorted(rows), np.int64)
    return attrs.evolve(
        run, rows=run.rows[np.isin(run.rows, kept)], passed=run.passed[np.isin(run.passed, kept)]
    )


def _roles(state: HullState, rows: set[int], line: int) -> dict[int, int]:
    """Give the roles of crossings on a line that are computed from a curve."""
    table = state.rows
    return {
        row: int(table.role.data[row]) for row in sorted(rows)
        if table.driver.data[row] >= 0
        and line in [state.line_of(curve) for curve in table.curve.data[row].tolist()]
    }  # fmt: skip

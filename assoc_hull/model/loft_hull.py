"""From a definition to a hull: loft everything, and find again which intersection is which.

Used once when a net is made and when lines come or go. Afterwards each curve keeps its
intersections with their signs and crossings, and the update only checks that they are as before.
"""

from __future__ import annotations

from collections import defaultdict

import attrs
import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.index import build_index
from assoc_hull.model.kinds import Sort
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = ["attach_curves", "loft_all", "set_limits"]

_LOOK = 2.0
"""Times `Tolerances.factor`: how far (m) a meeting may lie from where its crossing was when it is
looked for."""


def loft_all(state: HullState, journal: Journal) -> IntArray:
    """Loft every curve in the order of the driven links, and attach its crossings.

    Returns
    -------
    (k,) int
        Crossings that have no intersection on a curve that they need one on.
    """
    curves = state.live("curves")
    index = build_index(state)
    missing: list[IntArray] = []
    for level in np.unique(index.level[curves]).tolist():
        batch = curves[index.level[curves] == level]
        network = HullNetwork(state, index)
        riding = np.unique(np.concatenate([np.zeros(0, np.int64), *_riding_on(state, batch)]))
        if len(riding):
            network.evaluate(Node.point(riding), journal)
        network.evaluate(Node.curve(batch), journal)
        missing.append(attach_curves(state, batch, journal))
        driven = np.concatenate([np.zeros(0, np.int64), *_driven_by(index.drives, batch)])
        driven = np.setdiff1d(driven, missing[-1])
        if len(driven):
            network.evaluate(Node.point(driven), journal)
    return np.unique(np.concatenate(missing))


def _driven_by(drives: dict[int, IntArray], curves: IntArray) -> list[IntArray]:
    return [drives[curve] for curve in curves.tolist() if curve in drives]


def _riding_on(state: HullState, curves: IntArray) -> list[IntArray]:
    parts = [state.curves.rows[curve] for curve in curves.tolist()]
    return [part[(state.rows.anchor[part] >= 0).any(axis=1)] for part in parts]


def attach_curves(
    state: HullState, curves: IntArray, journal: Journal, line: int | None = None
) -> IntArray:
    """Match each intersection of the curves to its crossing, by sign and least distance.

    With `line`, only those with the plane of that line.

    Returns
    -------
    (k,) int
        Crossings computed from or watched on these curves that found no intersection.
    """
    expected = _expected(state, curves, line)
    missing: list[int] = []
    for curve in curves.tolist():
        meets: CurveIntersections = state.curves.meets[curve]
        mine = np.full(len(meets.line), True) if line is None else meets.line == line
        row = np.where(mine, -1, meets.row)
        for other, rows in sorted(expected[curve].items()):
            missing += _match(state, curve, meets, other, rows, row)
        found = attrs.evolve(meets, row=row)
        journal.set(state.curves.meets, [curve], [found])
        _write(state, curve, found, np.flatnonzero(mine & (row >= 0)), journal)
    return np.array(sorted(missing), np.int64)


def _expected(
    state: HullState, curves: IntArray, line: int | None
) -> dict[int, defaultdict[int, list[int]]]:
    """List the crossings of each curve by the line on the other side."""
    found = {curve: defaultdict[int, list[int]](list) for curve in curves.tolist()}
    table = state.rows
    wanted = table.alive.data & (table.sort.data == Sort.CROSSING)
    wanted &= np.isin(table.curve.data, curves).any(axis=1)
    if line is not None:
        wanted &= np.isin(table.curve.data, state.lines.curves[line]).any(axis=1)
    for row in np.flatnonzero(wanted).tolist():
        a, b = table.curve[row].tolist()
        if a in found:
            found[a][state.line_of(b)].append(row)
        if b in found and not table.contact[row]:
            found[b][state.line_of(a)].append(row)
    return found


def _match(
    state: HullState,
    curve: int,
    meets: CurveIntersections,
    line: int,
    rows: list[int],
    out: IntArray,
) -> list[int]:
    """Give the meetings with one plane to the crossings, nearest first."""
    spots = np.flatnonzero(meets.line == line)
    table = state.rows
    place = {row: table.spot[row, int(table.curve[row, 0] != curve)] for row in rows}
    pairs = sorted(
        (float(np.abs(meets.xyz[spot] - place[row]).max()), table.key[row], spot, row)
        for spot in spots.tolist()
        for row in rows
    )
    left, look = set(rows), state.tolerances.factor * _LOOK
    for distance, _, spot, row in pairs:
        if row in left and out[spot] < 0 and distance <= look:
            out[spot] = row
            left.discard(row)
    return [row for row in sorted(left) if not _defines(state, row, curve)]


def _defines(state: HullState, row: int, curve: int) -> bool:
    return bool((state.rows.reader[row] == curve).any())


def _write(
    state: HullState, curve: int, meets: CurveIntersections, actual: IntArray, journal: Journal
) -> None:
    """Note on the crossings at some meetings where they lie on the curve."""
    rows = meets.row[actual]
    if not len(rows):
        return
    side = (state.rows.curve[rows, 0] != curve).astype(np.int64)
    spot, at = state.rows.spot[rows].copy(), state.rows.parameter[rows].copy()
    spot[np.arange(len(rows)), side] = meets.xyz[actual]
    at[np.arange(len(rows)), side] = meets.parameter[actual]
    journal.put(state.rows.spot, rows, spot)
    journal.put(state.rows.parameter, rows, at)


def set_limits(state: HullState, journal: Journal, rows: IntArray | None = None) -> None:
    """Measure watched gaps and store their limits: twice the tolerance, or 1.5 x the gap."""
    watched = watched_on(state, state.live("curves")) if rows is None else rows
    if not len(watched):
        return
    gap = gap_at(state, watched)
    journal.put(state.rows.gap, watched, gap)
    least = 2.0 * state.tolerances.adoption
    journal.put(state.rows.limit, watched, np.maximum(least, 1.5 * gap))
    journal.put(state.rows.xyz, watched, state.rows.spot[watched, 0])

"""A line comes or goes: the curves it is associated with meet one plane more or fewer."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.crossings.adopted_points import mend_gaps
from assoc_hull.edit.crossings.settle_crossings import make_crossing
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.index import Index
from assoc_hull.model.loft_hull import attach_curves, set_limits
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "enter_line_plane",
    "intersect_groups",
    "partner_curves",
    "remove_line_plane",
    "remove_planes",
]

_ROUNDS = 4
_NO_POINTS: IntArray = np.zeros(0, np.int64)


def enter_line_plane(edit: Transaction, line: int, stay: IntArray = _NO_POINTS) -> None:
    """Loft the curves of a new line, and enter its plane with the curves it may meet.

    At crossings that `stay` the line is as it was, and needs no points to be held there.
    """
    state, journal = edit.state, edit.journal
    edit.document.refresh()
    mine = np.array(state.lines.curves[line], np.int64)
    network = HullNetwork(state, edit.document.index)
    network.evaluate(Node.curve(mine), journal)
    partners = partner_curves(state, edit.document.index, line)
    _add_meets(edit, partners, line)
    attach_curves(state, partners, journal, line)
    attach_curves(state, mine, journal)
    for curve in mine.tolist():
        meets: CurveIntersections = state.curves.meets[curve]
        for spot in np.flatnonzero(meets.row < 0).tolist():
            make_crossing(edit.maker, curve, spot, set(), watch=True)
    _hold_shape(edit, network, mine, stay)
    set_limits(state, journal, watched_on(state, mine))
    edit.pending.fresh += mine.tolist()


def intersect_groups(edit: Transaction, a: str, b: str) -> IntArray:
    """Let the lines of two groups that were strangers meet; all crossings (k,) are watched."""
    state = edit.state
    edit.document.refresh()
    names = state.groups.name.data
    owner = state.lines.group[state.curves.line.data]
    for mine, theirs in ((a, b), (b, a)):
        curves = state.live("curves")
        curves = curves[owner[curves] == names.index(mine)]
        lines = state.live("lines")
        lines = lines[state.lines.group[lines] == names.index(theirs)]
        for line in lines[state.lines.boundary[lines] < 0].tolist():
            _add_meets(edit, curves, line)
    first = state.live("curves")
    born: list[int] = []
    for curve in first[owner[first] == names.index(a)].tolist():
        meets: CurveIntersections = state.curves.meets[curve]
        for spot in np.flatnonzero(meets.row < 0).tolist():
            row = make_crossing(edit.maker, curve, spot, set(), watch=True)
            born += [] if row is None else [row]
    rows: IntArray = np.array(born, np.int64)
    set_limits(state, edit.journal, rows)
    return rows


def _hold_shape(edit: Transaction, network: HullNetwork, mine: IntArray, stay: IntArray) -> None:
    """Give a new line adopted points where it would else pass the others too far off."""
    state = edit.state
    for _ in range(_ROUNDS):
        rows = np.setdiff1d(watched_on(state, mine), stay)
        wide = rows[gap_at(state, rows) > 0.5 * state.tolerances.adoption]
        if not len(wide):
            return
        sides = np.isin(state.rows.curve[wide], mine)
        on = state.rows.curve[wide][np.arange(len(wide)), sides.argmax(axis=1)]
        touched, _ = mend_gaps(edit.maker, wide, on)
        if not len(touched):
            return
        network.evaluate(Node.curve(touched), edit.journal)


def partner_curves(state: HullState, index: Index, line: int) -> IntArray:
    """Give the curves that are cut with the plane of a line, (k,) int, ascending."""
    groups = [
        group
        for group, planes in index.partners.items()
        if any((each.lines == line).any() for each in planes)
    ]
    curves = state.live("curves")
    owner = state.lines.group[state.curves.line[curves]]
    found: IntArray = curves[np.isin(owner, groups)]
    return found


def _add_meets(edit: Transaction, curves: IntArray, line: int) -> None:
    """Add the meetings of curves with a new plane to those they have."""
    state = edit.state
    if not len(curves):
        return
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    plane = state.lines.normal[line].copy(), state.lines.offset[[line]].copy()
    met = intersect_planes(batch, *plane, state.tolerances.factor)
    for local, curve in enumerate(curves.tolist()):
        mine = met.curve == local
        if not mine.any():
            continue
        old: CurveIntersections = state.curves.meets[curve]
        xyz = _in_own_plane(state, curve, met.xyz[mine])
        new = CurveIntersections(
            np.concatenate([old.line, np.full(int(mine.sum()), line)]),
            np.concatenate([old.sign, met.sign[mine]]),
            np.concatenate([old.row, np.full(int(mine.sum()), -1)]),
            np.concatenate([old.parameter, met.t[mine]]),
            np.concatenate([old.xyz, xyz]),
        )
        edit.journal.set(
            state.curves.meets, [curve], [_sorted(state, edit.document.index, curve, new)]
        )


def _in_own_plane(state: HullState, curve: int, xyz: FloatArray) -> FloatArray:
    line = state.line_of(curve)
    out = np.array(xyz)
    if state.lines.planar[line]:
        exact = state.lines.normal[line] == 1.0
        out[:, exact] = state.lines.offset[line]
    return out


def _sorted(
    state: HullState, index: Index, curve: int, meets: CurveIntersections
) -> CurveIntersections:
    """Bring meetings into the order in which the update finds them."""
    group = int(state.lines.group[state.line_of(curve)])
    place = {
        int(line): i
        for i, line in enumerate(
            np.concatenate([each.lines for each in index.partners.get(group, ())]).tolist()
        )
    }
    rank = np.array([place[line] for line in meets.line.tolist()], np.int64)
    return meets.take(np.lexsort((meets.parameter, rank)))


def remove_planes(edit: Transaction, planes: IntArray, curves: IntArray) -> None:
    """Take the planes of lines out of the meetings of curves."""
    column = edit.state.curves.meets
    for curve in curves.tolist():
        meets: CurveIntersections = column.data[curve]
        keep = ~np.isin(meets.line, planes)
        if not keep.all():
            edit.journal.set(column, [curve], [meets.take(keep)])


def remove_line_plane(edit: Transaction, line: int) -> None:
    """Take the plane of a line out of the meetings of all curves."""
    remove_planes(edit, np.array([line]), edit.state.live("curves"))

"""Lines and associations that go: what they held stays behind as adopted points.

Removing a line is no change of shape. On Series 60 with 8 waterlines dropping one would
move a section by 50 mm in the median, were its crossings simply deleted.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.crossings.settle_crossings import make_latent
from assoc_hull.edit.lines.curve_deviation import quick_deviation
from assoc_hull.edit.lines.plane_intersections import remove_line_plane
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import TooFewPointsError
from assoc_hull.geometry.curves import CurveData, IntArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.kinds import Sort
from assoc_hull.model.links import holders
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState

__all__ = ["prune_points", "remove_line", "replace_crossings"]


def remove_line(edit: Transaction, line: int) -> None:
    """Remove a line; its crossings stay on the other curves as adopted points.

    Such a point is dropped again where its curve stays within 1 mm without it.

    Raises
    ------
    TooFewPointsError
        It is the last line of the hull.
    """
    state = edit.state
    if len(state.live("lines")) < 2:
        raise TooFewPointsError("the hull without its last line", 0)
    edit.pending.structural = True
    mine = np.array(state.lines.curves[line], np.int64)
    crossings, own = _crossings_and_points(state, mine)
    edit.pending.gone += sorted(state.rows.key[row] for row in crossings.tolist())
    replace_crossings(edit, crossings, mine)
    edit.maker.remove_rows(np.concatenate([crossings, own]))
    remove_line_plane(edit, line)
    edit.journal.put(state.curves.alive, mine, False)
    edit.journal.put(state.lines.alive, [line], False)
    key = state.lines.key[line]
    for group in holders(state, key).tolist():
        left = tuple(each for each in state.groups.members[group] if each != key)
        edit.journal.set(state.groups.members, [group], [left])
    kept = tuple(each for each in state.rulings if key not in (each.a, each.b))
    if kept != state.rulings:
        edit.journal.set(state.settings.rulings, [0], [kept])
    edit.pending.curves -= set(mine.tolist())


def _crossings_and_points(state: HullState, curves: IntArray) -> tuple[IntArray, IntArray]:
    """Give the crossings of curves, and their own points."""
    table = state.rows
    mine = table.alive.data & np.isin(table.curve.data, curves).any(axis=1)
    crossing = table.sort.data == Sort.CROSSING
    return np.flatnonzero(mine & crossing), np.flatnonzero(mine & ~crossing)


def replace_crossings(edit: Transaction, crossings: IntArray, going: IntArray) -> None:
    """Replace crossings by adopted points on the curves they define, but for those going."""
    state, touched = edit.state, dict[int, list[int]]()
    edit.refuse_moved(crossings)
    for row in crossings.tolist():
        for side, curve in enumerate(state.rows.curve[row].tolist()):
            make_latent(edit.maker, curve, row)
            if state.rows.reader[row, side] != curve or curve in going:
                continue
            point = PointSpec(
                curve, state.rows.xyz[row].copy(), Sort.ADOPTED,
                int(state.rows.kind[row, side]), state.rows.direction[row, side].copy(),
            )  # fmt: skip
            new = int(edit.maker.points([point])[0])
            rows: IntArray = state.curves.rows[curve]
            edit.maker.define(curve, np.where(rows == row, new, rows))
            touched.setdefault(curve, []).append(new)
    for curve in sorted(touched):
        prune_points(edit, curve, np.array(touched[curve]))
        edit.pending.curves.add(curve)


def prune_points(edit: Transaction, curve: int, points: IntArray) -> None:
    """Drop adopted points one by one, as long as the curve stays within the tolerance.

    Parameters
    ----------
    edit : Transaction
        The edit.
    curve : int
        The curve.
    points : (k,) int
        The points that may go; ends, knuckles and tangent points stay in any case.
    """
    state = edit.state
    published = state.spline(curve)
    rows: IntArray = state.curves.rows[curve]
    known = np.array(published.knot)
    if len(known) != len(rows):
        known = np.array(closest_points(published, 0, state.rows.xyz[rows])[0])
    inner = rows[1:-1]
    inner = inner[np.isin(inner, points)]
    for row in inner[state.rows.kind[inner, 0] == 0].tolist():
        data = curve_data(state, np.array([curve]))
        place = int(np.flatnonzero(state.curves.rows[curve] == row)[0])
        if data.start[1] < 4:
            return
        trial = loft(
            CurveData(
                data.start - np.array([0, 1]),
                np.delete(data.xyz, place, axis=0),
                np.delete(data.kind, place),
                np.delete(data.direction, place, axis=0),
                data.end_kind.copy(),
                data.end_vector.copy(),
            )
        )
        at = np.delete(known, place)
        if float(quick_deviation(published, trial, at)[0]) <= state.tolerances.prune:
            known = at
            kept: IntArray = state.curves.rows[curve]
            edit.maker.define(curve, kept[kept != row])
            edit.maker.remove_rows([row])

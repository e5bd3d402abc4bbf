"""The outward normal of the hull at every point of the net, and how far points are free."""

from __future__ import annotations

from collections.abc import Hashable

import attrs
import numpy as np

from assoc_hull.edit.outward import turn_outward
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.interpolation import interpolate
from assoc_hull.graph.table import ListColumn
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.index import Objects
from assoc_hull.model.kinds import Sort
from assoc_hull.model.lofting import loft_curves
from assoc_hull.model.state import HullState

__all__ = ["curve_tangents", "free_normals", "hull_normals", "shape_stamp"]


def hull_normals(state: HullState) -> FloatArray:
    """Give the unit outward normal at every point, (rows, 3); nil where it is not known.

    At a crossing it is the cross product of the two tangents; at points that have one curve
    only it is interpolated along that curve between its crossings. An edit asks for them again
    and again: they are kept, read-only, until something changes that they are made from.
    """
    stamp = shape_stamp(state)
    known: tuple[Hashable, FloatArray] | None = state.kept.get(_KEPT)
    if known is not None and known[0] == stamp:
        return known[1]
    normal = _normals(state)
    freeze(normal)
    state.kept[_KEPT] = stamp, normal
    return normal


_KEPT = "hull normals"


def shape_stamp(state: HullState) -> Hashable:
    """Give what is another one when points, curves, or planes have become others.

    Arrays tell how often they were written; what the curves hold is never written to, but
    replaced.
    """
    rows, curves, lines = state.rows, state.curves, state.lines
    held = (curves.spline, curves.rows, curves.side, curves.meets, curves.ends, lines.curves)
    return (
        Objects([each for column in held for each in column.data]),
        *(each.writes for each in (rows.alive, rows.sort, rows.kind, rows.direction, rows.curve)),
        *(each.writes for each in (rows.parameter, rows.xyz, curves.alive, curves.line)),
        *(each.writes for each in (lines.planar, lines.normal, lines.offset, lines.boundary)),
        lines.alive.writes,
        state.particulars,
    )


def _normals(state: HullState) -> FloatArray:
    table = state.rows
    tangent = curve_tangents(state)
    crossing = np.flatnonzero(table.alive.data & (table.sort.data == Sort.CROSSING))
    normal = np.zeros((table.count, 3))
    normal[crossing] = crossing_normals(tangent[crossing, 0], tangent[crossing, 1])
    normal = turn_outward(state, normal, tangent)
    _interpolate(state, normal)
    return normal


def curve_tangents(state: HullState) -> FloatArray:
    """Give the unit tangents of both curves at every point, (rows, 2, 3); nil where unknown."""
    table, curves = state.rows, state.live("curves").tolist()
    found = np.zeros((table.count, 2, 3))
    known = np.zeros((table.count, 2), bool)
    if curves:
        batch = SplineBatch.join([_present(state, curve) for curve in curves])
        slope, first, last = batch.leave + batch.arrive, batch.start[:-1], batch.start[1:] - 1
        slope[first], slope[last] = batch.leave[first], batch.arrive[last]
        length = np.sqrt((slope * slope).sum(axis=1))
        there = _joined(state.curves.rows, curves), _joined(state.curves.side, curves)
        found[there] = slope / np.where(length > 0.0, length, 1.0)[:, None]
        known[there] = True
    for side in (0, 1):
        missing = table.alive.data & ~known[:, side] & np.isfinite(table.parameter.data[:, side])
        rows = np.flatnonzero(missing & (table.curve.data[:, side] >= 0))
        found[rows, side] = tangents(
            state, table.curve.data[rows, side], table.parameter.data[rows, side]
        )
    return found


def _joined(column: ListColumn, curves: list[int]) -> IntArray:
    """Put the arrays that a column holds for curves one behind the other."""
    return np.concatenate([column.data[curve] for curve in curves])


def _present(state: HullState, curve: int) -> SplineBatch:
    """Give the spline through a curve's points as they are, in mid-transaction too."""
    spline = state.spline(curve)
    same = len(spline.knot) == len(state.curves.rows.data[curve])
    return spline if same else loft_curves(state, np.array([curve]))


def _interpolate(state: HullState, normal: FloatArray) -> None:
    """Fill in the normals at points that have one curve only, from those at its crossings."""
    curves = state.live("curves").tolist()
    if not curves:
        return
    splines = [_present(state, curve) for curve in curves]
    knot = np.concatenate([spline.knot for spline in splines])
    curve = np.repeat(np.arange(len(curves)), [len(spline.knot) for spline in splines])
    rows = _joined(state.curves.rows, curves)
    own = state.rows.sort.data[rows] != Sort.CROSSING
    meets = [state.curves.meets.data[each] for each in curves]
    meeting = np.repeat(np.arange(len(curves)), [len(each.row) for each in meets])
    where = np.concatenate([curve[~own], meeting])
    known = np.concatenate([rows[~own], *(each.row for each in meets)])
    at = np.concatenate([knot[~own], *(each.parameter for each in meets)])
    values = normal[known]
    good = (known >= 0) & (values != 0.0).any(axis=1)
    blend, told = interpolate(where[good], at[good], values[good], curve[own], knot[own])
    length = np.sqrt((blend * blend).sum(axis=1))
    normal[rows[own][told]] = blend / np.where(length > 1e-12, length, 1.0)[:, None]


@attrs.frozen(eq=False)
class _Planes:
    normal: FloatArray
    planar: np.typing.NDArray[np.bool_]


def free_normals(state: HullState, rows: IntArray, normal: FloatArray) -> FloatArray:
    """Project normals on the freedom of points: U U^T n.

    Parameters
    ----------
    state : HullState
        The tables.
    rows : (k,) int
        The points.
    normal : (k, 3)
        A normal each.

    Returns
    -------
    (k, 3)
        Along the line where two planes meet, or in the one plane a point must stay in.
    """
    free = np.array(normal)
    first, second = (_plane(state, rows, side) for side in (0, 1))
    both = first.planar & second.planar
    along = crossing_normals(first.normal, second.normal)
    free = np.where(both[:, None], (normal * along).sum(axis=1)[:, None] * along, free)
    for side in (first, second):
        one = side.planar & ~both
        off = (free * side.normal).sum(axis=1)[:, None] * side.normal
        free = np.where(one[:, None], free - off, free)
    return free


def _plane(state: HullState, rows: IntArray, side: int) -> _Planes:
    curve = state.rows.curve.data[rows, side]
    line = state.curves.line.data[np.maximum(curve, 0)]
    planar = (curve >= 0) & state.lines.planar.data[line]
    return _Planes(np.where(planar[:, None], state.lines.normal.data[line], 0.0), planar)

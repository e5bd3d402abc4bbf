"""The outward unit normal of the hull at every point of the net.

At a crossing the normal is the cross product of the tangents of its two curves; points on one
curve get theirs by interpolation between the crossings beside them. Which of the two senses is
outward follows from the way plane lines run (a section from the keel up, others from aft forward),
not from where they lie: near a stern post or in a hollow the skin may face the centre plane.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.interpolation import interpolate_linear
from assoc_hull.graph.table import ValueColumn
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.kinds import Sort
from assoc_hull.model.lofting import loft_curves
from assoc_hull.model.tables import HullState

__all__ = [
    "curve_tangents",
    "free_normals",
    "hull_normals",
    "shape_columns",
    "turn_outward",
]

_SHORT = 1e-6
"""Times `Tolerances.factor`: ends nearer than this (m) along a curve's course do not tell its
direction."""


def turn_outward(state: HullState, normal: FloatArray, tangent: FloatArray) -> FloatArray:
    """Turn unit normals (rows, 3) out of the hull.

    `tangent` (rows, 2, 3) are the unit tangents of the two curves at every point, as the curves
    are stored; zero where not known. Where both curves are boundary or space curves, normals are
    turned away from the line of the deck in the centre plane.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.hull_normals import hull_normals
    >>> from assoc_hull.shipped.wigley import wigley
    >>> normal = hull_normals(wigley())
    >>> bool((normal[:, 1] > -1e-12).all())
    True
    """
    reference = _references(state, tangent)
    cosine = (normal[:, None, :] * reference).sum(axis=2)
    # of two plane curves, the one to which the normal is less oblique decides
    surer = np.abs(cosine[:, 1]) > np.abs(cosine[:, 0])
    away = np.where(surer, cosine[:, 1], cosine[:, 0])
    unknown = ~(reference != 0.0).any(axis=(1, 2))
    away[unknown] = _from_deck(state, normal)[unknown]
    return np.where((away < 0.0)[:, None], -normal, normal)


def _references(state: HullState, tangent: FloatArray) -> FloatArray:
    """Give the direction out of the hull in the plane of each curve, (rows, 2, 3)."""
    curve = state.rows.curve.data
    line = np.where(curve >= 0, state.curves.line[np.maximum(curve, 0)], 0)
    known = (curve >= 0) & state.lines.planar[line]
    known &= state.lines.boundary[line] < 0
    plane = np.where(known[:, :, None], state.lines.normal[line], 0.0)
    out = np.cross(plane, tangent)
    sense = np.where(known, _course(state)[np.maximum(curve, 0)], 0.0)
    return np.asarray(out * sense[:, :, None])


def _course(state: HullState) -> FloatArray:
    """Give 1 or -1 by curve, so that plane x tangent points outward with it."""
    found = np.ones(state.curves.count)
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        xyz, normal = state.rows.xyz.data[state.curves.rows.data[curve]], state.lines.normal.data
        if not state.lines.planar.data[line] or len(xyz) < 2:
            continue
        across = abs(normal[line, 0]) > 0.5
        run = float(xyz[-1, 2] - xyz[0, 2]) if across else float(xyz[-1, 0] - xyz[0, 0])
        if (
            abs(run) < state.tolerances.factor * _SHORT
        ):  # a closed curve: the sense in which it goes round decides
            run = _turn(xyz, normal[line]) * (1.0 if across else -1.0)
        found[curve] = np.copysign(1.0, -run if across else run)
    return found


def _turn(xyz: FloatArray, normal: FloatArray) -> float:
    """Give the area a closed curve goes round, counted positive about the normal, m2."""
    areas = 0.5 * np.cross(xyz[:-1] - xyz[0], xyz[1:] - xyz[0]).sum(axis=0)
    return float((areas * normal).sum())


def _from_deck(state: HullState, normal: FloatArray) -> FloatArray:
    """Tell by its sign whether a normal points away from the deck's line in the centre plane."""
    xyz = state.rows.xyz.data
    top = max(state.particulars.depth, float(xyz[state.live("rows"), 2].max(initial=0.0)))
    found: FloatArray = normal[:, 1] * xyz[:, 1] + normal[:, 2] * (xyz[:, 2] - top)
    return found


# --------------------------------------------------------------------------------------
# Normals at all points.


def hull_normals(state: HullState) -> FloatArray:
    """Give the unit outward normal at every point, (rows, 3); zero where it is not known.

    An edit asks for them again and again: they are kept, read-only, until something changes that
    they are made from.
    """
    return state.derived(("hull normals",), shape_columns(state), lambda: _normals(state))


def shape_columns(state: HullState) -> tuple[object, ...]:
    """Give what the shape of a hull depends on: points, curves and planes."""
    rows, curves, lines = state.rows, state.curves, state.lines
    return (
        curves.spline, curves.rows, curves.side, curves.meets, curves.ends, lines.curves,
        rows.alive, rows.sort, rows.kind, rows.direction, rows.curve, rows.parameter, rows.xyz,
        curves.alive, curves.line, lines.planar, lines.normal, lines.offset, lines.boundary,
        lines.alive, state.particulars,
    )  # fmt: skip


def _normals(state: HullState) -> FloatArray:
    table = state.rows
    tangent = curve_tangents(state)
    crossing = np.flatnonzero(table.alive.data & (table.sort.data == Sort.CROSSING))
    normal = np.zeros((table.count, 3))
    normal[crossing] = crossing_normals(tangent[crossing, 0], tangent[crossing, 1])
    normal = turn_outward(state, normal, tangent)
    _interpolate(state, normal)
    freeze(normal)
    return normal


def curve_tangents(state: HullState) -> FloatArray:
    """Give the unit tangents of both curves at every point, (rows, 2, 3); zero where unknown."""
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


def _joined(column: ValueColumn[IntArray], curves: list[int]) -> IntArray:
    """Put the arrays that a column holds for curves one behind the other."""
    return np.concatenate([column.data[curve] for curve in curves])


def _present(state: HullState, curve: int) -> SplineBatch:
    """Give the spline through a curve's points as they are, in mid-transaction too."""
    spline = state.spline(curve)
    same = len(spline.knot) == len(state.curves.rows[curve])
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
    own = state.rows.sort[rows] != Sort.CROSSING
    meets = [state.curves.meets.data[each] for each in curves]
    meeting = np.repeat(np.arange(len(curves)), [len(each.row) for each in meets])
    where = np.concatenate([curve[~own], meeting])
    known = np.concatenate([rows[~own], *(each.row for each in meets)])
    at = np.concatenate([knot[~own], *(each.parameter for each in meets)])
    values = normal[known]
    good = (known >= 0) & (values != 0.0).any(axis=1)
    blend, found = interpolate_linear(where[good], at[good], values[good], curve[own], knot[own])
    length = np.sqrt((blend * blend).sum(axis=1))
    normal[rows[own][found]] = blend / np.where(length > 1e-12, length, 1.0)[:, None]


@attrs.frozen(eq=False)
class _Planes:
    normal: FloatArray
    planar: np.typing.NDArray[np.bool_]


def free_normals(state: HullState, rows: IntArray, normal: FloatArray) -> FloatArray:
    """Project normals (k, 3) on the freedom of points (k,): U U^T n.

    That is along the line where two planes meet, or in the one plane a point must stay in.
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
    curve = state.rows.curve[rows, side]
    line = state.curves.line[np.maximum(curve, 0)]
    planar = (curve >= 0) & state.lines.planar[line]
    return _Planes(np.where(planar[:, None], state.lines.normal[line], 0.0), planar)

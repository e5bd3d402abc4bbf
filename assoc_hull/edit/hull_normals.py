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
from assoc_hull.graph.run_update import distinct
from assoc_hull.model.gaps import crossing_normals, numbered, tangents
from assoc_hull.model.kinds import Sort
from assoc_hull.model.network import loft_curves
from assoc_hull.model.tables import HullState

__all__ = [
    "SHORT",
    "curve_tangents",
    "free_normals",
    "hull_normals",
    "normals_at",
    "shape_columns",
]

SHORT = 1e-6
"""Times `Tolerances.factor`: ends nearer than this (m) along a curve's course do not tell its
direction."""


def _turn_outward(
    state: HullState, rows: IntArray, normal: FloatArray, tangent: FloatArray
) -> FloatArray:
    """Turn unit normals (k, 3) at points (k,) out of the hull.

    `tangent` (k, 2, 3) are the unit tangents of the two curves at every point, as the curves are
    stored; zero where not known. Where both curves are boundary or space curves, normals are
    turned away from the line of the deck in the centre plane.
    """
    reference = _references(state, rows, tangent)
    cosine = (normal[:, None, :] * reference).sum(axis=2)
    # of two plane curves, the one to which the normal is less oblique decides
    surer = np.abs(cosine[:, 1]) > np.abs(cosine[:, 0])
    away = np.where(surer, cosine[:, 1], cosine[:, 0])
    unknown = ~(reference != 0.0).any(axis=(1, 2))
    if unknown.any():
        away[unknown] = _from_deck(state, rows[unknown], normal[unknown])
    return np.where((away < 0.0)[:, None], -normal, normal)


def _references(state: HullState, rows: IntArray, tangent: FloatArray) -> FloatArray:
    """Give the direction out of the hull in the plane of each curve, (k, 2, 3)."""
    curve = state.rows.curve.data.take(rows, axis=0)
    line = np.where(curve >= 0, state.curves.line.data.take(np.maximum(curve, 0)), 0)
    known = (curve >= 0) & state.lines.planar.data.take(line)
    known &= state.lines.boundary.data.take(line) < 0
    plane = np.where(known[:, :, None], state.lines.normal.data.take(line, axis=0), 0.0)
    out = np.cross(plane, tangent)
    sense = np.zeros(known.shape)
    sense[known] = _course(state, curve[known])
    return np.asarray(out * sense[:, :, None])


def _course(state: HullState, curves: IntArray) -> FloatArray:
    """Give 1 or -1 for plane curves (k,), so that plane x tangent points outward with it."""
    ends = state.rows.xyz.data.take(_defining_points(state).ends.take(curves, axis=0), axis=0)
    line = state.curves.line.data.take(curves)
    across = np.abs(state.lines.normal.data.take(line, axis=0)[:, 0]) > 0.5
    away = ends[:, 1] - ends[:, 0]
    run = np.where(across, away[:, 2], away[:, 0])
    short = np.abs(run) < state.tolerances.factor * SHORT
    # A closed curve: the sense in which it goes round decides.
    for i in np.flatnonzero(short).tolist():
        xyz = state.rows.xyz.data[state.curves.rows.data[int(curves[i])]]
        turn = _turn(xyz, state.lines.normal.data[int(line[i])])
        run[i] = turn * (1.0 if across[i] else -1.0)
    return np.copysign(1.0, np.where(across, -run, run))


def _turn(xyz: FloatArray, normal: FloatArray) -> float:
    """Give the area a closed curve goes round, counted positive about the normal, m2."""
    areas = 0.5 * np.cross(xyz[:-1] - xyz[0], xyz[1:] - xyz[0]).sum(axis=0)
    return float((areas * normal).sum())


def _from_deck(state: HullState, rows: IntArray, normal: FloatArray) -> FloatArray:
    """Tell by its sign whether a normal points away from the deck's line in the centre plane."""
    xyz = state.rows.xyz.data
    top = max(state.particulars.depth, float(xyz[state.live("rows"), 2].max(initial=0.0)))
    y, z = xyz[rows, 1], xyz[rows, 2]
    found: FloatArray = normal[:, 1] * y + normal[:, 2] * (z - top)
    return found


# --------------------------------------------------------------------------------------
# Normals at all points, and at some: at each they are the same, to the bit.


def hull_normals(state: HullState) -> FloatArray:
    """Give the unit outward normal at every point, (rows, 3); zero where it is not known.

    They are kept, read-only, until something changes that they are made from.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.hull_normals import hull_normals
    >>> from assoc_hull.shipped.wigley import wigley
    >>> normal = hull_normals(wigley())
    >>> bool((normal[:, 1] > -1e-12).all())
    True
    """
    return state.derived(
        ("hull normals",), shape_columns(state),
        lambda: normals_at(state, np.arange(state.rows.count)),
    )  # fmt: skip


def shape_columns(state: HullState) -> tuple[object, ...]:
    """Give what the shape of a hull depends on: points, curves and planes."""
    rows, curves, lines = state.rows, state.curves, state.lines
    return (
        curves.spline, curves.rows, curves.side, curves.meets, curves.ends, lines.curves,
        rows.alive, rows.sort, rows.kind, rows.direction, rows.curve, rows.parameter, rows.xyz,
        curves.alive, curves.line, lines.planar, lines.normal, lines.offset, lines.boundary,
        lines.alive, state.particulars,
    )  # fmt: skip


def normals_at(state: HullState, rows: IntArray) -> FloatArray:
    """Give the unit outward normals at points (k,): (k, 3), zero where not known."""
    table, found = state.rows, np.zeros((len(rows), 3))
    crosses = _cross(state, rows)
    own = np.flatnonzero(~crosses & (_defining_points(state).place.take(rows, axis=0)[:, 0] >= 0))
    along = _Along.of_curves(state, table.curve[rows[own], 0]) if len(own) else None
    every = distinct(rows[crosses])
    if along is not None:
        every = distinct(np.concatenate([every, along.row[along.row >= 0]]))
        every = every[_cross(state, every)]
    tangent = _tangents_at(state, every)
    normal = crossing_normals(tangent[:, 0], tangent[:, 1])
    normal = _turn_outward(state, every, normal, tangent)
    place = every.searchsorted(rows[crosses])
    found[crosses] = normal.take(place, axis=0)
    if along is not None and len(every):
        found[own] = along.interpolate(state, rows[own], every, normal)
    freeze(found)
    return found


def _cross(state: HullState, rows: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell which points are crossings, and there."""
    found: np.typing.NDArray[np.bool_] = state.rows.alive.data.take(rows)
    found &= state.rows.sort.data.take(rows) == Sort.CROSSING
    return found


@attrs.frozen(eq=False)
class _DefiningPoints:
    """Where points stand among those that define their curves.

    `place` (rows, 2) int is the number of a point on its curve on each side, -1 where it does not
    define that; `ends` (curves, 2) int are the first and the last point of a curve.
    """

    place: IntArray
    ends: IntArray

    @classmethod
    def of(cls, state: HullState) -> _DefiningPoints:
        """Read the tables."""
        curves = state.live("curves").tolist()
        rows = [state.curves.rows.data[curve] for curve in curves]
        place = np.full((state.rows.count, 2), -1)
        for row, curve in zip(rows, curves, strict=True):
            place[row, state.curves.side.data[curve]] = np.arange(len(row))
        ends = np.zeros((state.curves.count, 2), np.int64)
        ends[curves] = np.array([row[[0, -1]] for row in rows], np.int64).reshape(-1, 2)
        return cls(place, ends)


def _defining_points(state: HullState) -> _DefiningPoints:
    curves = state.curves
    depends_on = curves.rows, curves.side, curves.alive, state.rows.alive
    return state.derived(("defining points",), depends_on, lambda: _DefiningPoints.of(state))


def curve_tangents(state: HullState) -> FloatArray:
    """Give the unit tangents of both curves at every point, (rows, 2, 3); zero where unknown."""
    return _tangents_at(state, np.arange(state.rows.count))


def _tangents_at(state: HullState, rows: IntArray) -> FloatArray:
    """Give the unit tangents of both curves at points (k,): (k, 2, 3), zero where unknown."""
    table, found = state.rows, np.zeros((len(rows), 2, 3))
    curve, at = table.curve.data.take(rows, axis=0), table.parameter.data.take(rows, axis=0)
    place = _defining_points(state).place.take(rows, axis=0)
    defines = place >= 0
    passes = ~defines & (curve >= 0) & np.isfinite(at) & table.alive.data.take(rows)[:, None]
    if defines.any():
        numbers, local = numbered(curve[defines])
        batch = SplineBatch.join([_present(state, each) for each in numbers])
        knot = batch.start.take(local) + place[defines]
        slope = batch.leave.take(knot, axis=0) + batch.arrive.take(knot, axis=0)
        first, last = place[defines] == 0, knot == batch.start.take(local + 1) - 1
        slope[first], slope[last] = batch.leave[knot[first]], batch.arrive[knot[last]]
        length = np.sqrt((slope * slope).sum(axis=1))
        found[defines] = slope / np.where(length > 0.0, length, 1.0)[:, None]
    found[passes] = tangents(state, curve[passes], at[passes])
    return found


def _present(state: HullState, curve: int) -> SplineBatch:
    """Give the spline through a curve's points as they are, in mid-transaction too."""
    spline = state.spline(curve)
    same = len(spline.knot) == len(state.curves.rows[curve])
    return spline if same else loft_curves(state, np.array([curve]))


@attrs.frozen(eq=False)
class _Along:
    """Curves on which there are points that lie on no other, and the crossings there.

    Attributes
    ----------
    curves : list of int
        The curves, ascending.
    batch : SplineBatch
        As they are.
    of, row, at : (q,) int, (q,) int, (q,) m
        Crossings: on which of the curves, which, and where; those that define a curve first.
    """

    curves: list[int]
    batch: SplineBatch
    of: IntArray
    row: IntArray
    at: FloatArray

    @classmethod
    def of_curves(cls, state: HullState, curves: IntArray) -> _Along:
        """Find them."""
        numbers = distinct(curves).tolist()
        batch = SplineBatch.join([_present(state, each) for each in numbers])
        owner = np.repeat(np.arange(len(numbers)), np.diff(batch.start))
        rows = np.concatenate([state.curves.rows.data[each] for each in numbers])
        crossing = state.rows.sort.data.take(rows) == Sort.CROSSING
        meets = [state.curves.meets.data[each] for each in numbers]
        meeting = np.repeat(np.arange(len(numbers)), [len(each.row) for each in meets])
        return cls(
            numbers, batch, np.concatenate([owner[crossing], meeting]),
            np.concatenate([rows[crossing], *(each.row for each in meets)]),
            np.concatenate([batch.knot[crossing], *(each.parameter for each in meets)]),
        )  # fmt: skip

    def interpolate(
        self, state: HullState, rows: IntArray, every: IntArray, normal: FloatArray
    ) -> FloatArray:
        """Give normals at points (k,) of the curves from those at crossings: `every`, `normal`."""
        place = every.searchsorted(self.row)
        known = every.take(place, mode="clip") == self.row
        values = np.where(known[:, None], normal.take(place, axis=0, mode="clip"), 0.0)
        good = (values != 0.0).any(axis=1)
        curve = np.searchsorted(self.curves, state.rows.curve.data[rows, 0])
        knot = self.batch.start[curve] + _defining_points(state).place[rows, 0]
        blend, told = interpolate_linear(
            self.of[good], self.at[good], values[good], curve, self.batch.knot[knot]
        )
        length, found = np.sqrt((blend * blend).sum(axis=1)), np.zeros((len(rows), 3))
        found[told] = blend / np.where(length > 1e-12, length, 1.0)[:, None]
        return found


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

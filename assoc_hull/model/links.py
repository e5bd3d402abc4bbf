"""Where points lie on curves, how they may move, and which curves may meet which."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.plane import AXES
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState

__all__ = [
    "PointsOnCurve",
    "crossing_ways",
    "defines",
    "free_axes",
    "generates",
    "generates_on",
    "latent_curves",
    "point_positions",
    "points_on",
]


def generates(state: HullState, line_a: int, line_b: int) -> tuple[bool, bool]:
    """Tell whether line a generates points on line b, and b on a."""
    names = [state.groups.name[int(state.lines.group[line])] for line in (line_a, line_b)]
    for link in state.associations:
        if [link.a, link.b] == names:
            return True, link.two_way
        if [link.b, link.a] == names:
            return link.two_way, True
    return False, False


def crossing_ways(state: HullState, rows: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell of crossings (k,) whether a generates points on b, and b on a, (k, 2)."""
    lines = state.curves.line[state.rows.curve[rows]]
    known: dict[tuple[int, int], tuple[bool, bool]] = {}
    for a, b in {(int(one), int(two)) for one, two in lines}:
        known[a, b] = generates(state, a, b)
    found = [known[int(a), int(b)] for a, b in lines]
    return np.array(found, np.bool_).reshape(-1, 2)


_PARALLEL = 1e-9
"""Two planes whose normals have a shorter cross product are parallel."""


@attrs.frozen(eq=False)
class PointsOnCurve:
    """The points of one curve, in order along it.

    Attributes
    ----------
    row, side : (k,) int
        Row of the table of points, and on which of its sides the curve stands.
    parameter : (k,), m
        Chord parameter.
    defining : (k,) bool
        Whether the curve is made through the point.
    """

    row: IntArray
    side: IntArray
    parameter: FloatArray
    defining: np.typing.NDArray[np.bool_]


def defines(state: HullState, row: int, side: int) -> bool:
    """Tell whether a point defines the curve on one of its sides."""
    curve = int(state.rows.curve[row, side])
    return curve >= 0 and bool((state.rows.reader[row] == curve).any())


def point_positions(state: HullState, row: IntArray, side: IntArray) -> FloatArray:
    """Give the places of points on curves, (k, 3), m.

    A crossing is one value for both of its curves; a watched one has none, it lies on each
    curve where that curve passes.
    """
    table = state.rows
    spot = table.spot[row, side]
    watched = (table.sort[row] == Sort.CROSSING) & (table.role[row] == Role.WATCHED)
    own = watched & np.isfinite(spot).all(axis=1)
    found: FloatArray = np.where(own[:, None], spot, table.xyz[row])
    return found


def points_on(state: HullState, curve: int) -> PointsOnCurve:
    """Give all points of a curve in order along it, ties by the key.

    Parameters
    ----------
    state : HullState
        The tables.
    curve : int
        Number of the curve.

    Returns
    -------
    PointsOnCurve
    """
    table = state.rows
    row = np.flatnonzero(table.alive.data & (table.curve.data == curve).any(axis=1))
    side = (table.curve[row, 0] != curve).astype(np.int64)
    defining = (table.reader[row] == curve).any(axis=1)
    at = table.parameter[row, side].copy()
    _put_knots(state, curve, row, at)
    lost = np.flatnonzero(~np.isfinite(at))
    if len(lost) and state.curves.spline[curve] is not None:
        at[lost] = closest_points(
            state.spline(curve), 0, point_positions(state, row[lost], side[lost])
        )[0]
    keys = [table.key[each] for each in row.tolist()]
    order = np.array(sorted(range(len(row)), key=lambda i: (at[i], keys[i])), np.int64)
    return PointsOnCurve(row[order], side[order], at[order], defining[order])


def _put_knots(state: HullState, curve: int, row: IntArray, at: FloatArray) -> None:
    """Write the knots of the defining points, unless the curve has failed since."""
    rows: IntArray = state.curves.rows[curve]
    spline: SplineBatch | None = state.curves.spline[curve]
    if spline is None or len(spline.knot) != len(rows):
        return
    knot = dict(zip(rows.tolist(), spline.knot.tolist(), strict=True))
    for i, each in enumerate(row.tolist()):
        at[i] = knot.get(each, at[i])


def free_axes(state: HullState, row: int) -> tuple[str, ...]:
    """Name the coordinates along which a point may move.

    Parameters
    ----------
    state : HullState
        The tables.
    row : int
        Number of the point.

    Returns
    -------
    tuple of str
        As many as the point has freedoms. Where a plane is oblique, these fix the others:
        of two planes the coordinate along which their common line runs most, of one plane
        all but the one its normal runs along most; ties by the order x, y, z.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import resolve_address
    >>> from assoc_hull.model.links import free_axes
    >>> state = wigley()
    >>> free_axes(state, resolve_address(state, "WL 2.5 x ST 7").row)
    ('y',)
    """
    curves = [curve for curve in state.rows.curve[row].tolist() if curve >= 0]
    lines = [state.line_of(curve) for curve in curves]
    planar, normal = state.lines.planar.data, state.lines.normal.data
    normals: list[list[float]] = [normal[line].tolist() for line in lines if planar[line]]
    if len(normals) == 2:
        a, b = normals
        along = [abs(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2]) for i in range(3)]
        if max(along) > _PARALLEL:
            return (AXES[along.index(max(along))],)
    if normals:
        sizes = [abs(part) for part in normals[0]]
        steepest = sizes.index(max(sizes))
        return tuple(axis for i, axis in enumerate(AXES) if i != steepest)
    return AXES


def generates_on(state: HullState, group: int) -> IntArray:
    """Give the groups on whose lines those of a group generate points, (k,) int."""
    names = state.groups.name.data
    mine = names[group]
    wanted = {link.b for link in state.associations if link.a == mine}
    wanted |= {link.a for link in state.associations if link.b == mine and link.two_way}
    return np.array([i for i, name in enumerate(names) if name in wanted], np.int64)


def latent_curves(state: HullState, curve: int) -> IntArray:
    """Give the curves that a curve may come to generate points on and now does not, (k,) int.

    A curve in a parallel plane is none: the two can never meet.
    """
    table = state.rows
    group = int(state.lines.group[state.line_of(curve)])
    live = state.live("curves")
    owner = state.lines.group[state.curves.line[live]]
    reach = live[np.isin(owner, generates_on(state, group)) & ~_parallel(state, curve, live)]
    met = table.alive.data & (table.curve.data == curve).any(axis=1)
    found: IntArray = np.setdiff1d(reach, table.curve[met])
    return found


def _parallel(state: HullState, curve: int, others: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell which curves lie in planes parallel to that of a curve."""
    mine, theirs = state.line_of(curve), state.curves.line[others]
    across = np.cross(state.lines.normal[mine], state.lines.normal[theirs])
    both = state.lines.planar[mine] & state.lines.planar[theirs]
    found: np.typing.NDArray[np.bool_] = both & (np.abs(across).max(axis=1) <= _PARALLEL)
    return found

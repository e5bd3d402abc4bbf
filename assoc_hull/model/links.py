"""Where points lie on curves, how they may move, and which curves may meet which."""

from __future__ import annotations

from itertools import groupby

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.plane import AXES
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState, Ruling

__all__ = [
    "PointsOnCurve",
    "crossing_ways",
    "crossings_between",
    "defines",
    "free_axes",
    "generates",
    "generates_on",
    "holders",
    "latent_curves",
    "live_group",
    "named_lines",
    "point_positions",
    "points_on",
]


def generates(
    state: HullState, line_a: int, line_b: int, place: FloatArray | None = None
) -> tuple[bool, bool]:
    """Tell whether line a generates points on line b, and b on a.

    Where lines rule by regions it hangs on the place (3,), m; without one the association of the
    groups tells.
    """
    names = [state.groups.name[int(state.lines.group[line])] for line in (line_a, line_b)]
    found = False, False
    for link in state.associations:
        if [link.a, link.b] == names:
            found = True, link.two_way
        if [link.b, link.a] == names:
            found = link.two_way, True
    if place is None or not state.rulings or found == (False, False):
        return found
    ways = np.array([found])
    _rule(state, np.array([[line_a, line_b]]), place[None], ways)
    return bool(ways[0, 0]), bool(ways[0, 1])


def crossing_ways(state: HullState, rows: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell of crossings (k,) whether a generates points on b, and b on a, (k, 2)."""
    lines = state.curves.line[state.rows.curve[rows]].reshape(-1, 2)
    pairs, which = np.unique(lines, axis=0, return_inverse=True)
    known = [generates(state, a, b) for a, b in pairs.tolist()]
    found = np.array(known, np.bool_).reshape(-1, 2)[which.reshape(-1)]
    if state.rulings and len(rows):
        _rule(state, lines, point_positions(state, rows, np.zeros(len(rows), np.int64)), found)
    return found


def crossings_between(state: HullState, a: IntArray, b: IntArray) -> IntArray:
    """Give the crossings of lines with others, (k,)."""
    table = state.rows
    rows = np.flatnonzero(table.alive.data & (table.sort.data == Sort.CROSSING))
    one, other = state.curves.line[table.curve[rows]].reshape(-1, 2).T
    ahead = np.isin(one, a) & np.isin(other, b)
    found: IntArray = rows[ahead | (np.isin(one, b) & np.isin(other, a))]
    return found


def named_lines(state: HullState, name: str) -> IntArray:
    """Give the lines (k,) of a group, by its name, or one line, by its key; ascending."""
    live, table = state.live("lines"), state.groups
    keys = {state.lines.key[line]: line for line in live.tolist()}
    found, names, seen = set[int](), [name], set[str]()
    while names:
        each = names.pop()
        if each in keys:
            found.add(keys[each])
            continue
        group = live_group(state, each)
        if group is None or each in seen:
            continue
        seen.add(each)
        names += table.members[group]
        found |= set(live[state.lines.group[live] == group].tolist())
    return np.array(sorted(found), np.int64)


def live_group(state: HullState, name: str) -> int | None:
    """Give the number of a group; None if there is none of the name."""
    live = state.live("groups").tolist()
    return next((group for group in live if state.groups.name[group] == name), None)


def holders(state: HullState, name: str) -> IntArray:
    """Give a designer's own groups that hold a line, by its key, or a group, by its name."""
    live = state.live("groups").tolist()
    mine = [group for group in live if name in state.groups.members[group]]
    return np.array(sorted(mine, key=lambda group: str(state.groups.name[group])), np.int64)


def _rule(
    state: HullState, lines: IntArray, places: FloatArray, ways: np.typing.NDArray[np.bool_]
) -> None:
    """Let rulings change the ways (k, 2) of pairs of associated lines (k, 2) at places (k, 3)."""
    open_ = ways.any(axis=1)
    for _, statement in groupby(state.rulings, key=lambda each: frozenset((each.a, each.b))):
        rulings = list(statement)
        members = {n: named_lines(state, n) for n in (rulings[0].a, rulings[0].b)}
        # On a border the box below goes first; what is left may lie on the lowest one of all.
        for closed in (False, True):
            for each in rulings:
                a, b = members[each.a], members[each.b]
                ahead = np.isin(lines[:, 0], a) & np.isin(lines[:, 1], b)
                back = np.isin(lines[:, 0], b) & np.isin(lines[:, 1], a)
                hit = open_ & (ahead | back) & _held(each, places, closed=closed)
                ways[hit, 0] = ahead[hit] | each.two_way
                ways[hit, 1] = back[hit] | each.two_way
                open_ &= ~hit


def _held(ruling: Ruling, places: FloatArray, *, closed: bool) -> np.typing.NDArray[np.bool_]:
    """Tell which places lie in the box of a ruling; its lower sides count if it is `closed`."""
    found = np.ones(len(places), np.bool_)
    for axis, (low, high) in enumerate(zip(ruling.low, ruling.high, strict=True)):
        at = places[:, axis]
        if low is not None:
            found &= (at >= low) if closed else (at > low)
        if high is not None:
            found &= at <= high
    return found


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

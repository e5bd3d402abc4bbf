"""The batten residuals of a hull, and which of its points fairing may move.

These are the points that a field may move, less those of features and all between the ends of a
feature on its curve, and those that such points are computed from: a straight run or an arc would
be bent off its shape. All others stay in the windows as they are, so that lines run smoothly into
flats, knuckles and the profile.
"""

from __future__ import annotations

import attrs
import numpy as np
from scipy.sparse import csr_array, diags_array

from assoc_hull.analysis.fairness.batten_problem import BattenProblem, batten_problem
from assoc_hull.edit.displacement_field import FieldContext, on_flat, on_profile
from assoc_hull.edit.hull_normals import free_normals, hull_normals, shape_columns
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.feature_geometry import host_curve
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState

__all__ = [
    "MendingPoint",
    "fairable_rows",
    "feature_rows",
    "mending_points",
    "mending_ties",
    "net_battens",
    "reasons_to_stay",
    "volume_weights",
]


_FINE = 1e-6
"""By this part of what is given a point on a feature may go along with others."""

_CLOSED = 1e-3
"""m: so near an adopted point lies to the curve whose gap it closes."""


def net_battens(state: HullState, also: IntArray | None = None) -> BattenProblem:
    """Give the residuals of a whole net and how they change with all points that may be faired.

    `also` (k,) are points that may move besides, as they are asked for.
    """
    depends_on = (
        *shape_columns(state), state.rows.role, state.rows.driver, state.rows.anchor,
        state.rows.anchor_weight, state.rows.key, state.featured.alive, state.featured.feature,
    )  # fmt: skip
    rows = state.derived(("fairable rows",), depends_on, lambda: fairable_rows(state), most=1)
    found = state.derived(("battens",), depends_on, lambda: _battens(state, rows), most=1)
    if also is None or np.isin(also, found.rows).all():
        return found
    return _battens(state, _by_key(state, np.union1d(rows, also)), also)


def _battens(state: HullState, rows: IntArray, also: IntArray | None = None) -> BattenProblem:
    """Put the problem together, less the points that lead others of a feature; `also` stay in."""
    normal, features = hull_normals(state), feature_rows(state)
    along = free_normals(state, np.arange(state.rows.count), normal)
    found = batten_problem(state, rows, normal, along)
    if found.rates[features].count_nonzero():
        # Points of features that are computed would be bent off them by the least rate.
        fine = batten_problem(state, rows, normal, along, _FINE)
        away = np.unique(fine.rates[features].indices)
        if also is not None:
            away = away[~np.isin(rows[away], also)]
        found = batten_problem(state, np.delete(rows, away), normal, along)
    return found


def fairable_rows(state: HullState) -> IntArray:
    """Give the points that fairing may move, by key."""
    ground = FieldContext(state, across_flats=False)
    free = ground.free()
    free = free[ground.freedoms(free).good]
    return _by_key(state, np.setdiff1d(free, feature_rows(state)))


def _by_key(state: HullState, rows: IntArray) -> IntArray:
    return np.array(sorted(rows.tolist(), key=state.rows.key.__getitem__), np.int64)


def feature_rows(state: HullState) -> IntArray:
    """Give the points of features, and all between the ends of each on its curve, ascending."""
    found: list[IntArray] = []
    for feature in state.features:
        points = np.array(feature.points, np.int64)
        found.append(points)
        curve = host_curve(state, feature)
        if curve >= 0:
            rows = state.curves.rows.data[curve]
            on = np.flatnonzero(np.isin(rows, points))
            if len(on) > 1:
                found.append(rows[on[0] : on[-1] + 1])
    return np.unique(np.concatenate([np.zeros(0, np.int64), *found]))


def mending_ties(state: HullState, problem: BattenProblem) -> tuple[IntArray, csr_array]:
    """Let adopted points that close the gap of a watched crossing go along with the other curve.

    Moved by themselves they would open the gap again. Gives the places (c,) in the rows of a
    problem of all other points, and displacements of all (k,) as parts (k, c) of theirs.
    """
    rows = problem.rows.tolist()
    holds = mending_points(state)
    chosen = np.array([n for n, row in enumerate(rows) if row not in holds], np.int64)
    own = csr_array(
        (np.ones(len(chosen)), (chosen, np.arange(len(chosen)))), (len(rows), len(chosen))
    )
    held = [n for n, row in enumerate(rows) if row in holds]
    if not held:
        return chosen, own
    beside = np.array([holds[rows[n]].beside for n in held])
    part = np.array([holds[rows[n]].part for n in held])
    free = csr_array(problem.rates[:, chosen])
    # What a held point itself would do to its neighbours is left out: two may hold each other.
    follows = csr_array(
        diags_array(1.0 - part) @ free[beside[:, 0]] + diags_array(part) @ free[beside[:, 1]]
    )
    put = csr_array((np.ones(len(held)), (held, np.arange(len(held)))), (len(rows), len(held)))
    return chosen, csr_array(own + put @ follows)


@attrs.frozen
class MendingPoint:
    """What an adopted point closes the gap of.

    Attributes
    ----------
    crossing, side : int
        The watched crossing, and which of its two curves is led to the other.
    beside : (int, int)
        The points of the other curve before and after the crossing.
    part : float
        Its part of the way from the one to the other.
    """

    crossing: int
    side: int
    beside: tuple[int, int]
    part: float


def mending_points(state: HullState) -> dict[int, MendingPoint]:
    """Find adopted points that lie where another curve passes that their own one is watched for."""
    table, found = state.rows, dict[int, MendingPoint]()
    watched = table.alive.data & (table.sort.data == Sort.CROSSING)
    watched &= table.role.data == Role.WATCHED
    for row in np.flatnonzero(watched & (table.curve.data >= 0).all(axis=1)).tolist():
        for side, curve in enumerate(table.curve.data[row].tolist()):
            other = int(table.curve.data[row, 1 - side])
            points = state.curves.rows.data[curve]
            mine = points[table.sort.data[points] == Sort.ADOPTED]
            step = table.xyz.data[mine] - table.spot.data[row, 1 - side]
            away = np.sqrt((step * step).sum(axis=1))
            if not len(mine) or away.min() > _CLOSED * state.tolerances.factor:
                continue
            knot, at = state.spline(other).knot, table.parameter.data[row, 1 - side]
            before = min(max(int(np.searchsorted(knot, at, side="right")) - 1, 0), len(knot) - 2)
            part = float((at - knot[before]) / (knot[before + 1] - knot[before]))
            first, last = state.curves.rows.data[other][before : before + 2].tolist()
            found[int(mine[away.argmin()])] = MendingPoint(row, side, (first, last), part)
    return found


def reasons_to_stay(state: HullState, lines: IntArray | None) -> dict[str, int]:
    """Count the points that fairing may not move, by reason: of some lines, or of all if None."""
    table = state.rows
    rows = np.flatnonzero(table.alive.data & (table.reader.data >= 0).any(axis=1))
    if lines is not None:
        curve = table.curve.data[rows]
        line = np.where(curve >= 0, state.curves.line.data[np.maximum(curve, 0)], -1)
        rows = rows[np.isin(line, lines).any(axis=1)]
    rows = np.setdiff1d(rows, net_battens(state).rows)
    crossing = table.sort.data[rows] == Sort.CROSSING
    left, found = np.ones(len(rows), np.bool_), dict[str, int]()
    for why, mine in (
        ("placed", table.sort.data[rows] == Sort.PLACED),
        ("computed from another line", crossing & (table.role.data[rows] != Role.SHARED)),
        ("on the profile", on_profile(state)[rows]),
        ("on a flat", on_flat(state)[rows]),
        ("of a feature", np.isin(rows, feature_rows(state))),
        ("that lead points of a feature", np.isin(rows, fairable_rows(state))),
        ("free almost along the hull only", left),
    ):
        here = left & mine
        if here.any():
            found[why] = int(here.sum())
        left = left & ~here
    return found


def volume_weights(state: HullState) -> tuple[FloatArray, FloatArray]:
    """Give by how much the displaced volume grows with displacements, (rows,), m2; and x, m.

    Both sides, about: a point stands for the strip of girth around it on its section, over the
    spacing of the sections, as far as that lies below the design draught.
    """
    weight, x = np.zeros(state.rows.count), state.rows.xyz.data[:, 0]
    lines = [line for line in state.live("lines").tolist() if state.family(line).name == "sections"]
    offset = np.array([state.lines.offset[line] for line in lines])
    order = np.argsort(offset, kind="stable")
    half = np.diff(offset[order], prepend=offset[order][:1], append=offset[order][-1:])
    for place, number in enumerate(order.tolist()):
        spacing = 0.5 * float(half[place] + half[place + 1])
        for curve in state.curves_of(lines[number]):
            spline = state.spline(curve)
            below = np.minimum(spline.xyz[:, 2], state.particulars.draught)
            rise = np.diff(spline.xyz[:, 2])
            wet = np.where(
                rise == 0.0, spline.xyz[:-1, 2] <= state.particulars.draught,
                np.diff(below) / np.where(rise == 0.0, 1.0, rise),
            )  # fmt: skip
            girth = np.diff(spline.knot) * wet
            share = np.zeros(len(spline.knot))
            share[:-1] += 0.5 * girth
            share[1:] += 0.5 * girth
            weight[state.curves.rows.data[curve]] += 2.0 * spacing * share
    return weight, x

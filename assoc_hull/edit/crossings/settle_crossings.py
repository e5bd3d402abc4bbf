"""Crossings that come and go when a plane meets a curve more or fewer times than before.

A crossing exists only where both curves reach each other's plane at one place; elsewhere the
relation stays latent: the curve has an intersection with the plane, its `row` is -1. The role of a
new crossing is what the role rule gives there now. `settle_crossings` runs after each pass of an
update.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import insert_defining_point, runs_along_tangency
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import generates
from assoc_hull.model.make_objects import CrossingSpec, Maker
from assoc_hull.model.network import Alignment
from assoc_hull.model.roles import Candidates, choose, role_of
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "CrossingChange",
    "intersection_gap",
    "latent_intersections",
    "make_crossing",
    "make_latent",
    "may_define",
    "one_place",
    "rejoin_crossings",
    "role_by_rule",
    "settle_crossings",
]

_ONE_PLACE = 2.0
"""Times `Tolerances.factor`: intersections farther apart than this (m) are not one place,
whatever the gap between them."""

_SAME = 1e-3
"""Times the same: points of a curve as near as this (m) along it are one."""


def one_place(state: HullState) -> float:
    """Give the distance (m) beyond which intersections are not one place of the hull."""
    return _ONE_PLACE * state.tolerances.factor


@attrs.frozen
class CrossingChange:
    """What settling did: keys that came and went, and curves whose points changed."""

    born: tuple[str, ...]
    gone: tuple[str, ...]
    curves: tuple[int, ...]


def latent_intersections(state: HullState, curves: IntArray) -> list[tuple[int, int]]:
    """Give the intersections of curves at which the other line did not pass so far.

    Each is a curve, and the index of the intersection on it.
    """
    met = [state.curves.meets[curve].row for curve in curves.tolist()]
    if not met or np.concatenate(met).min(initial=0) >= 0:
        return []
    return [
        (curve, spot)
        for curve, row in zip(curves.tolist(), met, strict=True)
        for spot in np.flatnonzero(row < 0).tolist()
    ]


def settle_crossings(
    maker: Maker, alignments: list[Alignment], latent: list[tuple[int, int]], edited: set[int]
) -> CrossingChange:
    """Take out crossings that have no place any more, and make those that have come.

    `latent` are intersections as of `latent_intersections`, `edited` curves that the designer
    edited. In the order of keys, so that the outcome does not depend on row numbers.
    """
    born: list[str] = []
    gone: list[str] = []
    curves: set[int] = set()
    keys = maker.state.curves.key.data
    for alignment in sorted(alignments, key=lambda each: str(keys[each.curve])):
        for row in alignment.gone.tolist():
            if maker.state.rows.alive[row] and not _holds(maker.state, row, alignment.curve):
                gone.append(maker.state.rows.key[row])
                curves |= _remove(maker, row)
    for curve, spot in sorted(latent, key=lambda each: (str(keys[each[0]]), each[1])):
        row = make_crossing(maker, curve, spot, edited)
        if row is not None:
            born.append(maker.state.rows.key[row])
            curves |= {int(each) for each in maker.state.rows.reader[row] if each >= 0}
    return CrossingChange(tuple(sorted(born)), tuple(sorted(gone)), tuple(sorted(curves)))


def _holds(state: HullState, row: int, curve: int) -> bool:
    """Tell whether a curve is made through a crossing: then it is there by construction."""
    return bool((state.rows.reader[row] == curve).any())


def _remove(maker: Maker, row: int) -> set[int]:
    """Take a crossing out of the curves it defines and of the intersections of both."""
    state = maker.state
    touched: set[int] = set()
    for curve in state.rows.reader[row].tolist():
        if curve >= 0:
            rows = state.curves.rows[curve]
            maker.define(curve, rows[rows != row])
            touched.add(curve)
    for curve in state.rows.curve[row].tolist():
        if curve >= 0:
            make_latent(maker, curve, row)
    maker.remove_rows([row])
    return touched


def make_latent(maker: Maker, curve: int, row: int) -> None:
    """Make the intersection of a curve at a crossing latent."""
    meets: CurveIntersections = maker.state.curves.meets[curve]
    if (meets.row == row).any():
        left = np.where(meets.row == row, -1, meets.row)
        maker.journal.set(maker.state.curves.meets, [curve], [attrs.evolve(meets, row=left)])


def make_crossing(
    maker: Maker, curve: int, spot: int, edited: set[int], *, watch: bool = False
) -> int | None:
    """Make the crossing at intersection `spot` of a curve; None if the other line is not there.

    Its value comes from a curve of `edited`, those that the designer edited, if one is. If
    `watch`, it defines neither curve, whatever the role rule says.
    """
    state = maker.state
    meets: CurveIntersections = state.curves.meets[curve]
    if meets.row[spot] >= 0 or runs_along_tangency(state, curve, spot):
        return None
    best: tuple[float, int, int] | None = None
    least = 0.0
    for other in state.lines.curves[int(meets.line[spot])]:
        theirs: CurveIntersections = state.curves.meets[other]
        free = np.flatnonzero((theirs.line == state.line_of(curve)) & (theirs.row < 0))
        for there in free.tolist():
            gap, apart = intersection_gap(state, (curve, spot), (other, there))
            near = gap <= 2.0 * state.tolerances.adoption and apart <= one_place(state)
            near = near and not runs_along_tangency(state, other, there)
            if near and (best is None or gap + 0.01 * apart < best[0]):
                best, least = (gap + 0.01 * apart, other, there), gap
    if best is None:
        return None
    return _write_crossing(maker, (curve, spot), (best[1], best[2]), least, edited, watch)


def intersection_gap(
    state: HullState, one: tuple[int, int], other: tuple[int, int]
) -> tuple[float, float]:
    """Give the gap along the hull's normal, and the distance of the two places, m.

    Each is a curve, and the index of the intersection on it.
    """
    places, slopes = [], []
    for curve, spot in (one, other):
        meets: CurveIntersections = state.curves.meets[curve]
        places.append(meets.xyz[spot])
        slopes.append(_tangent(state, curve, float(meets.parameter[spot])))
    normal = crossing_normals(slopes[0][None], slopes[1][None])[0]
    step = places[0] - places[1]
    return abs(float((step * normal).sum())), float(np.sqrt((step * step).sum()))


def _tangent(state: HullState, curve: int, at: float) -> FloatArray:
    found: FloatArray = tangents(state, np.array([curve]), np.array([at]))[0]
    return found


def _write_crossing(
    maker: Maker,
    one: tuple[int, int],
    other: tuple[int, int],
    gap: float,
    edited: set[int],
    watch: bool,
) -> int:
    """Make a crossing of two intersections, with the role the rule gives it now."""
    state = maker.state
    (a, spot_a), (b, spot_b) = sorted((one, other), key=lambda each: state.rank(each[0]))
    meets_a: CurveIntersections = state.curves.meets[a]
    meets_b: CurveIntersections = state.curves.meets[b]
    at = float(meets_a.parameter[spot_a]), float(meets_b.parameter[spot_b])
    line_a, line_b = state.line_of(a), state.line_of(b)
    spots = meets_a.xyz[spot_a], meets_b.xyz[spot_b]
    role = Role.WATCHED
    if not watch:
        role = _role(state, (a, b), (line_a, line_b), at, spots[0])
    value = spots[1] if b in edited and a not in edited and role is Role.SHARED else spots[0]
    row = int(
        maker.crossings([CrossingSpec(a, b, value, role, int(meets_a.sign[spot_a]), spots)])[0]
    )
    for curve, spot in ((a, spot_a), (b, spot_b)):
        meets: CurveIntersections = state.curves.meets[curve]
        marked = meets.row.copy()
        marked[spot] = row
        maker.journal.set(state.curves.meets, [curve], [attrs.evolve(meets, row=marked)])
    for curve in (a, b):
        if (state.rows.reader[row] == curve).any():
            insert_defining_point(maker, curve, row)
    # at birth the gap may be at its limit already: it has half as much again
    maker.journal.put(state.rows.limit, [row], [max(2.0 * state.tolerances.adoption, 1.5 * gap)])
    maker.journal.put(state.rows.gap, [row], [gap])
    maker.journal.put(state.rows.parameter, [row], [at])
    return row


def _role(
    state: HullState,
    curves: tuple[int, int],
    lines: tuple[int, int],
    at: tuple[float, float],
    place: FloatArray,
    row: int = -1,
) -> Role:
    return role_of(
        _may_define(state, curves[0], lines[1], at[0], row),
        _may_define(state, curves[1], lines[0], at[1], row),
        generates(state, *lines, place),
    )


def _spot(state: HullState, row: int, side: int) -> FloatArray:
    """Give where a crossing lies on a curve: its one value, unless it is watched."""
    watched = state.rows.role[row] == Role.WATCHED
    spot: FloatArray = state.rows.spot[row, side] if watched else state.rows.xyz[row]
    return spot


def role_by_rule(state: HullState, row: int) -> Role:
    """Give the role that the rule chooses for a crossing, the rest of its curves as it is."""
    a, b = state.rows.curve[row].tolist()
    places = [
        float(closest_points(state.spline(curve), 0, _spot(state, row, side)[None])[0][0])
        for side, curve in enumerate((a, b))
    ]
    lines = state.line_of(a), state.line_of(b)
    if state.rows.contact[row]:
        both_ways = generates(state, *lines)[1]
        shared = both_ways and _may_define(state, a, lines[1], places[0], row)
        return Role.SHARED if shared else Role.DRIVES_B
    return _role(state, (a, b), lines, (places[0], places[1]), _spot(state, row, 0), row)


def may_define(state: HullState, curve: int, partner: int, row: int, side: int) -> bool:
    """Tell whether the role rule lets a crossing define a curve, a stand-in there counted as it."""
    at = closest_points(state.spline(curve), 0, _spot(state, row, side)[None])[0]
    return _may_define(state, curve, partner, float(at[0]), row)


def _may_define(state: HullState, curve: int, partner: int, at: float, row: int = -1) -> bool:
    """Apply the role rule to one crossing; what else defines the curve already stays."""
    knots, rows = state.spline(curve).knot, state.curves.rows[curve]
    least = _SAME * state.tolerances.factor
    if len(knots) == len(rows):
        # a point adopted where the crossing is stands in for it, and goes when it defines
        adopted = state.rows.sort[rows] == Sort.ADOPTED
        stands_in = adopted & (np.abs(knots - at) < least) & (row >= 0)
        knots = knots[(rows != row) & ~stands_in]
    if float(np.abs(knots - at).min()) < least:
        return False
    position = int(np.searchsorted(knots, at))
    places = np.insert(knots, position, at)
    slopes = tangents(state, np.full(len(places), curve), places)
    fixed = np.ones(len(places), bool)
    fixed[position] = False
    sine = abs(float((slopes[position] * state.lines.normal[partner]).sum()))
    angle = np.full(len(places), 90.0)
    angle[position] = float(np.degrees(np.arcsin(min(1.0, sine))))
    return bool(choose(Candidates(places, angle, slopes, fixed), state.tolerances)[position])


# --------------------------------------------------------------------------------------
# Watched crossings aligned apart. The intersections of a curve are aligned with those it had, curve
# by curve. Where several come at once, the least displacements on one curve and on the other may
# take a crossing to different places. One of the two curves then passes at the place of the other
# too, in the same sense and unclaimed: that is the crossing.

_Intersection = tuple[int, int]
"""A curve, and the index of an intersection on it."""


def rejoin_crossings(maker: Maker, alignments: list[Alignment]) -> None:
    """Put watched crossings of realigned curves back to where both of their curves pass."""
    state = maker.state
    keys = state.rows.key.data
    rows = {row for each in alignments for row in each.row.tolist() if row >= 0}
    for row in sorted(rows, key=lambda each: str(keys[each])):
        watched = state.rows.role[row] == Role.WATCHED
        if watched and state.rows.alive[row] and state.rows.sort[row] == Sort.CROSSING:
            _rejoin_crossing(maker, row)


def _rejoin_crossing(maker: Maker, row: int) -> None:
    """Move a crossing on one of its curves, if that brings its two places together."""
    state = maker.state
    here = [_intersection_of(state, curve, row) for curve in state.rows.curve[row].tolist()]
    if here[0] is None or here[1] is None or _one_place(state, here[0], here[1]) is not None:
        return
    found: list[tuple[float, int, int, int]] = []
    for side, stays in ((0, here[1]), (1, here[0])):
        curve, spot = here[0] if side == 0 else here[1]
        for other in _unclaimed_like(state, curve, spot):
            cost = _one_place(state, (curve, other), stays)
            if cost is not None:
                found.append((cost, side, spot, other))
    if found:
        _, side, spot, other = min(found)
        _attach(maker, row, side, spot, other)


def _intersection_of(state: HullState, curve: int, row: int) -> _Intersection | None:
    spots = np.flatnonzero(state.curves.meets[curve].row == row)
    return (curve, int(spots[0])) if len(spots) else None


def _unclaimed_like(state: HullState, curve: int, spot: int) -> list[int]:
    """Give the intersections of a curve with the same plane and sign that are of no crossing."""
    meets: CurveIntersections = state.curves.meets[curve]
    like = (meets.line == meets.line[spot]) & (meets.sign == meets.sign[spot]) & (meets.row < 0)
    return list(np.flatnonzero(like).tolist())


def _one_place(state: HullState, one: _Intersection, other: _Intersection) -> float | None:
    """Give how far two intersections are from fitting, m; None if they are not one place."""
    gap, apart = intersection_gap(state, one, other)
    near = gap <= 2.0 * state.tolerances.adoption and apart <= one_place(state)
    return gap + 0.01 * apart if near else None


def _attach(maker: Maker, row: int, side: int, spot: int, other: int) -> None:
    """Let another intersection of a curve be the crossing; the one it was becomes latent."""
    table, curve = maker.state.rows, int(maker.state.rows.curve[row, side])
    meets: CurveIntersections = maker.state.curves.meets[curve]
    rows = meets.row.copy()
    rows[spot], rows[other] = -1, row
    maker.journal.set(maker.state.curves.meets, [curve], [attrs.evolve(meets, row=rows)])
    place, at = table.spot[[row]].copy(), table.parameter[[row]].copy()
    place[0, side], at[0, side] = meets.xyz[other], meets.parameter[other]
    maker.journal.put(table.spot, [row], place)
    maker.journal.put(table.parameter, [row], at)

"""Followers of a transformation: cut again from the drivers, then from one another by rank.

A follower is made through its crossings with drivers and with the followers cut before it. Where
the mapping keeps its plane, its own points are carried as they are. Where another part of the hull
comes to lie in the plane, placed points slide there along the hull, adopted ones that held the
old shape go, and `follower_points` finds new ones that hold the new shape.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from assoc_hull.edit.crossings.adopted_points import least_detour
from assoc_hull.edit.mapped_planes import IN_PLANE, plane_heights, snap_into_planes
from assoc_hull.edit.recut.carried_points import (
    DefiningPoints,
    TransformationState,
    loft_through,
)
from assoc_hull.edit.recut.driver_image import CurveImages, ImageIntersections, gaps_across
from assoc_hull.edit.recut.follower_points import (
    OptionalPoint,
    choose_fair_points,
    free_points,
    insert_by_detour,
    into_curve_plane,
    loose_points,
    round_turns,
    slide_own_points,
    tie_to_crossings,
    tie_to_own_points,
)
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.network import align_plane_roots
from assoc_hull.model.tables import CurveIntersections

__all__ = [
    "cut_followers",
    "cut_kept",
    "settle_stand_ins",
]

# --------------------------------------------------------------------------------------
# Stand-ins: where a crossing is watched, an adopted point may lie at its place and define the line
# instead. When a mapping carries the drivers, it goes where the crossing goes.

_SAME = 1e-3
"""Times `Tolerances.factor`: a point as near as this (m) to a crossing stands in for it."""


def settle_stand_ins(work: TransformationState) -> None:
    """Give stand-ins of followers the places that their crossings with drivers have come to."""
    state = work.state
    for curve in state.live("curves").tolist():
        if work.drives(curve) or state.line_of(curve) in work.anew:
            continue
        own, crossing = _own(work, curve), _settled(work, curve)
        if not len(own) or not len(crossing):
            continue
        side = (state.rows.curve[crossing, 0] != curve).astype(np.int64)
        spot = state.rows.spot[crossing, side]
        away = np.sqrt(((state.rows.xyz[own][:, None] - spot[None]) ** 2).sum(axis=2))
        near = away.argmin(axis=1)
        mine = away.min(axis=1) <= state.tolerances.factor * _SAME
        work.value[own[mine]] = work.value[crossing[near[mine]]]
        work.known[own[mine]] = True


def _own(work: TransformationState, curve: int) -> IntArray:
    """Give the adopted points of a follower that are not settled, and that the mapping moves."""
    rows: IntArray = work.state.curves.rows[curve]
    adopted = work.state.rows.sort[rows] == Sort.ADOPTED
    found: IntArray = rows[adopted & ~work.known[rows] & ~work.still[rows]]
    return found


def _settled(work: TransformationState, curve: int) -> IntArray:
    """Give the crossings on a follower that do not define it and whose new places are known."""
    meets: CurveIntersections = work.state.curves.meets[curve]
    rows = meets.row[meets.row >= 0]
    rows = rows[work.known[rows] & ~(work.state.rows.reader[rows] == curve).any(axis=1)]
    return np.array([row for row in rows.tolist() if row not in work.gone], np.int64)


# --------------------------------------------------------------------------------------
# Exact parts of followers. A line follows as a whole as soon as the mapping bends its plane
# anywhere, be it round one feature. Elsewhere its image lies in its plane, to rounding, and is the
# hull itself: crossings with other followers are taken from it, not from curves between drivers.


def cut_kept(work: TransformationState) -> None:
    """Find where images of followers that lie in their planes meet the planes of others."""
    state = work.state
    wanted = {
        curve: rows
        for curve in sorted(_curves(work), key=lambda c: str(state.curves.key[c]))
        if len(rows := _unknown(work, curve))
    }
    if not wanted:
        return
    curves = list(wanted)
    batch = SplineBatch.join([state.spline(curve) for curve in curves])
    image = CurveImages.of(work.space, batch, tuple(curves))
    lines = {state.line_of(work.other(row, c)) for c, rows in wanted.items() for row in rows}
    ordered = sorted(lines, key=lambda each: str(state.lines.key[each]))
    met = image.meet(work.planes.normal[ordered], work.planes.offset[ordered])
    for line, roots in zip(ordered, met, strict=True):
        for local, curve in enumerate(curves):
            if any(state.line_of(work.other(row, curve)) == line for row in wanted[curve]):
                _settle(work, curve, line, roots, np.flatnonzero(roots.curve == local))


def _curves(work: TransformationState) -> list[int]:
    """Give the curves of planar followers that are not cut wholly anew."""
    state = work.state
    return [
        curve for curve in state.live("curves").tolist()
        if not work.drives(curve) and state.line_of(curve) not in work.anew
        and work.planes.planar[state.line_of(curve)]
    ]  # fmt: skip


def _unknown(work: TransformationState, curve: int) -> list[int]:
    """Give the crossings of a follower with other followers that have no place yet."""
    meets: CurveIntersections = work.state.curves.meets[curve]
    rows: IntArray = meets.row[meets.row >= 0]
    return [
        row for row in rows[~work.known[rows]].tolist()
        if row not in work.gone and not work.apart(row) and not work.drives(work.other(row, curve))
    ]  # fmt: skip


def _settle(
    work: TransformationState, curve: int, line: int, roots: ImageIntersections, new: IntArray
) -> None:
    """Give crossings of a curve with a line their places where its image lies in its plane."""
    own = work.state.line_of(curve)
    off = plane_heights(roots.xyz[new], work.planes.normal[own]) - work.planes.offset[own]
    meets: CurveIntersections = work.state.curves.meets[curve]
    old = np.flatnonzero(meets.line == line)
    carried = work.met_images(curve)[old]
    for one, other in align_plane_roots(meets.sign[old], carried, roots.sign[new], roots.xyz[new]):
        row = int(meets.row[old[one]])
        if row >= 0 and not work.known[row] and abs(float(off[other])) <= IN_PLANE:
            place = roots.xyz[[new[other]]]
            work.value[row] = snap_into_planes(work.state, work.planes, np.array([row]), place)[0]
            work.known[row] = work.slid[row] = True
            work.kept.add(row)


# --------------------------------------------------------------------------------------
# All followers by rank.

_NEAR = 0.15
"""Times the same: no point is added as near as this (m) to another one."""

_ROUNDS = 6
"""Rounds of adding points to hold a follower; each adds at most one to a segment."""


def cut_followers(work: TransformationState) -> None:
    """Find where all followers pass.

    Raises
    ------
    BadInputError
        A follower is cut from nothing.
    """
    state = work.state
    curves = [
        curve for curve in state.live("curves").tolist()
        if not work.drives(curve) and state.line_of(curve) not in work.anew
    ]  # fmt: skip
    for row in state.live("rows").tolist():
        if work.anew and work.apart(row):
            work.known[row] = False
    for curve in sorted(curves, key=state.rank):
        _check_cut(work, curve)
        _carry_own(work, curve)
        _give(work, curve)
    for curve in curves:
        work.made[curve] = _points(work, curve)


def _crossings(work: TransformationState, curve: int) -> list[int]:
    """Give the crossings that define a curve and are still there."""
    rows: IntArray = work.state.curves.rows[curve]
    mine = rows[work.state.rows.sort[rows] == Sort.CROSSING]
    return [row for row in mine.tolist() if row not in work.gone and not work.apart(row)]


def _check_cut(work: TransformationState, curve: int) -> None:
    """Require that a follower is defined by a driver, or by a follower cut before it.

    A crossing whose image lies in the planes of both lines is known whatever drives.
    """
    state = work.state
    boundary = state.lines.boundary.data >= 0
    inner = [
        row for row in _crossings(work, curve)
        if not boundary[state.line_of(work.other(row, curve))]
    ]  # fmt: skip
    given = [row for row in inner if work.known[row] or _before(work, row, curve)]
    own = len(state.curves.rows[curve]) - len(inner)
    if (inner and not given) or own + len(given) < 2:
        name = state.lines.name[state.line_of(curve)]
        raise BadInputError(
            f"{name} follows, but no driver defines it", "in transform",
            f"name {name} or its group as a driver too, or another group that crosses it; or "
            "change one end of the ship after the other",
        )  # fmt: skip


def _before(work: TransformationState, row: int, curve: int) -> bool:
    """Tell whether the other curve of a crossing is cut before a follower."""
    other = work.other(row, curve)
    return work.drives(other) or work.state.rank(other) < work.state.rank(curve)


def _carry_own(work: TransformationState, curve: int) -> None:
    """Give the own points of a follower whose plane is kept the places of their images."""
    rows: IntArray = work.state.curves.rows[curve]
    mine = rows[work.state.rows.sort[rows] != Sort.CROSSING]
    if not _slides(work, curve):
        work.known[mine] = True
        return
    _carry_free_ends(work, rows)
    slide_own_points(work, curve)


def _carry_free_ends(work: TransformationState, rows: IntArray) -> None:
    """Carry ends that lie on no boundary curve: they go along with the crossing beside them."""
    for order in (rows, rows[::-1]):
        end = int(order[0])
        if work.state.rows.sort[end] == Sort.CROSSING:
            continue
        beside = order[(work.state.rows.sort[order] == Sort.CROSSING) & work.known[order]]
        slip = work.value[beside[0]] - work.image[beside[0]] if len(beside) else np.zeros(3)
        place = (work.image[end] + slip)[None]
        place = snap_into_planes(work.state, work.planes, np.array([end]), place)[0]
        if len(beside):
            place = _off_centre(place, work.value[beside[0]])
        work.value[end], work.known[end] = place, True


def _off_centre(end: FloatArray, beside: FloatArray) -> FloatArray:
    """Let a free end that comes to lie beyond the centre plane end on it, on the way it came."""
    if not end[1] < 0.0 < beside[1]:
        return end
    found: FloatArray = end + (beside - end) * (end[1] / (end[1] - beside[1]))
    found[1] = 0.0
    return found


def _slides(work: TransformationState, curve: int) -> bool:
    """Tell whether another part of the hull comes to lie in the plane of a follower."""
    rows: IntArray = work.state.curves.rows[curve]
    own = work.state.rows.sort[rows] != Sort.CROSSING
    new = any(curve in work.state.rows.curve[row] for _, row in work.contacts)
    return new or bool(work.slid[rows].any() or (~work.direct[rows[own]]).any())


def _points(work: TransformationState, curve: int) -> DefiningPoints:
    """Put the points of a follower that are known into order.

    Where crossings slid, those of one family and the ends keep their order, and the others
    are put between them by the least detour.
    """
    state = work.state
    order = _ordered(work, curve)
    if not _slides(work, curve):
        return DefiningPoints(order, [work.value[row].copy() for row in order], [])
    # `_give` has ordered some curves before: what it put aside is open again.
    work.watched -= set(order)
    loose = loose_points(work, curve, order)
    order = [row for row in order if row not in set(loose)]
    _refuse_doubled(work, curve, [work.value[row] for row in order])
    new = [row for _, row in work.contacts if curve in state.rows.curve[row]]
    # Those that are ends stand in the order already.
    new = [row for row in new if row not in work.new_ends.values()]
    base = _base(work, curve, order)
    found = DefiningPoints(base, [work.value[row].copy() for row in base], [])
    for row in [*new, *(each for each in order if each not in set(base))]:
        insert_by_detour(found, row, work.value[row])
    least = state.tolerances.factor * _NEAR
    for place in _coming(work, curve):
        insert_by_detour(found, -1, into_curve_plane(work, curve, place), least=least)
    # Not before all stand in order: the sense follows from the neighbours.
    for row in new:
        _direct(work, curve, found, row)
    own = [row for row in loose if state.rows.sort[row] == Sort.ADOPTED]
    ties = [row for row in loose if row not in set(own)]
    # Before own points: where these slip to is less certain.
    tie_to_crossings(work, curve, found, ties)
    # A new contact may have come where another point is.
    _refuse_doubled(work, curve, found.place, apart=1)
    options = _hold(work, curve, found)
    tie_to_own_points(work, curve, found, own)
    options += free_points(work, own, [*ties, *_smooth(work, curve, found, ties)])
    choose_fair_points(work, curve, found, options)
    round_turns(work, curve, found)
    return found


def _refuse_doubled(
    work: TransformationState, curve: int, chosen: Sequence[FloatArray], apart: int | None = None
) -> None:
    """Refuse points of a follower that have come together: its plane touches the hull there.

    `apart`: only those so many places apart in their order; None: any two.
    """
    places = np.array(chosen)
    near = ((places[:, None] - places[None]) ** 2).sum(axis=2)
    near[np.tril_indices(len(places))] = np.inf
    if apart is not None:
        near[np.triu_indices(len(places), apart + 1)] = np.inf
    doubled = np.argwhere(near <= work.state.tolerances.coincident**2)
    if len(doubled):
        name = work.state.lines.name[work.state.line_of(curve)]
        x, y, z = places[doubled[0, 0]].tolist()
        raise BadInputError(
            f"two points of {name} come to lie in one place, ({x:.3f}, {y:.3f}, {z:.3f}) m: its "
            "plane touches the hull there", "in transform", "ask for a little more or less",
        )  # fmt: skip


def _smooth(
    work: TransformationState, curve: int, found: DefiningPoints, ties: list[int]
) -> list[int]:
    """Give the crossings with drivers, where these slid, that need not define a follower."""
    table = work.state.rows
    return [
        row for row in found.row[1:-1]
        if row >= 0 and row not in ties and work.slid[row] and work.other(row, curve) >= 0
        and work.drives(work.other(row, curve)) and not table.contact[row]
        and table.role[row] == Role.SHARED
    ]  # fmt: skip


def _hold(work: TransformationState, curve: int, found: DefiningPoints) -> list[OptionalPoint]:
    """Add points that hold a follower where lines cut before it pass its plane undefined by it.

    Gives these places, less the gaps at which it passed them before, each with its tolerance.
    """
    rows = _passed(work, curve)
    if not len(rows):
        return []
    limit = 0.5 * work.state.tolerances.adoption
    places = np.zeros((0, 3))
    for _ in range(_ROUNDS):
        work.made[curve] = found
        spline = loft_through(work, [curve])
        if not len(places):
            places = _as_before(work, curve, rows, spline)
        at, _, away = closest_points(spline, 0, places)
        segment = np.searchsorted(spline.knot, at, side="right")
        wide = np.flatnonzero(away > limit * _share(work, curve, rows, spline, at))
        wide = wide[np.argsort(-away[wide], kind="stable")]
        first = np.unique(segment[wide], return_index=True)[1]
        added = [
            insert_by_detour(found, -1, places[i], least=work.state.tolerances.factor * _NEAR)
            for i in wide[np.sort(first)].tolist()
        ]
        if not any(added):
            break
    share = _share(work, curve, rows, spline, at)
    return [
        OptionalPoint(-1, place, 2.0 * limit * part, work.state.tolerances.factor * _NEAR)
        for place, part in zip(places, share, strict=True)
    ]


def _as_before(
    work: TransformationState, curve: int, rows: IntArray, spline: SplineBatch
) -> FloatArray:
    """Give the places of lines that pass a follower, less the gaps at which they did before."""
    at, _, _ = closest_points(spline, 0, work.value[rows])
    slope = derivative(spline, np.zeros(len(at), np.int64), at)
    left = np.cross(work.planes.normal[work.state.line_of(curve)], slope)
    left = left / np.sqrt((left * left).sum(axis=1))[:, None]
    places = work.value[rows] - gaps_across(work, curve, rows, left)[:, None] * left
    return np.array([into_curve_plane(work, curve, place) for place in places])


def _share(
    work: TransformationState, curve: int, rows: IntArray, spline: SplineBatch, at: FloatArray
) -> FloatArray:
    """Give the share of the usual tolerance by which a follower may miss places, (k,); 1 at most.

    Where it runs along the plane of the line there, a little off is far along that line.
    """
    state = work.state
    share = np.ones(len(rows))
    for i in np.flatnonzero(state.rows.driver[rows] == curve).tolist():
        slope = derivative(spline, np.zeros(1, np.int64), at[[i]])[0]
        normal = work.planes.normal[state.line_of(work.other(int(rows[i]), curve))]
        sine = abs(float((slope * normal).sum())) / float(np.sqrt((slope * slope).sum()))
        share[i] = min(1.0, sine)
    return share


def _passed(work: TransformationState, curve: int) -> IntArray:
    """Give the crossings at which lines cut before a follower pass it without defining it."""
    table, meets = work.state.rows, work.state.curves.meets[curve]
    rows = meets.row[meets.row >= 0]
    rows = rows[work.known[rows] & ~(table.reader[rows] == curve).any(axis=1)]
    kept = [
        row
        for row in rows.tolist()
        if row not in work.gone and (row in work.kept or _before(work, row, curve))
    ]
    return np.array(kept, np.int64)


def _direct(work: TransformationState, curve: int, found: DefiningPoints, row: int) -> None:
    """Give a new contact with the border of a flat its direction: along the flat."""
    table = work.state.rows
    if table.kind[row, 1] != PointKind.TANGENT:
        return
    flat, own = (work.planes.normal[work.state.line_of(c)] for c in table.curve[row].tolist())
    along = np.cross(flat, own)
    at = found.row.index(row)
    chord = found.place[min(at + 1, len(found.place) - 1)] - found.place[max(at - 1, 0)]
    along = along if float((along * chord).sum()) >= 0.0 else -along
    work.maker.journal.put(table.direction, [row], [[np.zeros(3), along]])


def _coming(work: TransformationState, curve: int) -> list[FloatArray]:
    """Give the new places (3,), m, at which drivers have come to meet the plane of a piece."""
    line = work.state.line_of(curve)
    places = [place for other, place in work.come if other == line]
    if len(work.state.lines.curves[line]) == 1:
        return places
    return [place for place in places if _piece(work, line, place) == curve]


def _piece(work: TransformationState, line: int, place: FloatArray) -> int:
    """Give the piece of a line that makes the least detour through a place."""
    state, least = work.state, (np.inf, -1)
    for curve in state.lines.curves[line]:
        known = _ordered(work, curve)
        if len(known) > 1:
            least = min(least, (least_detour(work.value[known], place), int(curve)))
    return least[1]


def _ordered(work: TransformationState, curve: int) -> list[int]:
    """Give the points of a curve that are known, in the order of before, with its new ends."""
    rows: IntArray = work.state.curves.rows[curve]
    inner = [row for row in rows.tolist() if work.known[row] and row not in work.gone]
    ends = [work.new_ends.get((curve, side)) for side in (0, 1)]
    return [row for row in (ends[0], *inner, ends[1]) if row is not None]


def _base(work: TransformationState, curve: int, order: list[int]) -> list[int]:
    """Give the points of a curve that keep their order: ends, and the group with most crossings."""
    state = work.state
    group = {
        row: int(state.lines.group[state.line_of(work.other(row, curve))])
        for row in order
        if work.other(row, curve) >= 0 and not state.rows.contact[row]
    }
    count = Counter(group.values())
    names = state.groups.name.data
    main = min(count, key=lambda each: (-count[each], str(names[each]))) if count else -1
    ends = {order[0], order[-1]}
    return [
        row for row in order
        if row in ends or group.get(row) == main
        or (state.rows.contact[row] and not work.slid[row])
    ]  # fmt: skip


def _give(work: TransformationState, curve: int) -> None:
    """Cut a follower with the planes of those that come after it, where these have to slide."""
    state = work.state
    meets: CurveIntersections = state.curves.meets[curve]
    rows = meets.row[meets.row >= 0]
    wanted = [
        row for row in rows[~work.known[rows]].tolist()
        if row not in work.gone and not work.apart(row) and not _before(work, row, curve)
    ]  # fmt: skip
    if not wanted:
        return
    work.made[curve] = _points(work, curve)
    spline = loft_through(work, [curve])
    for line in sorted({state.line_of(work.other(row, curve)) for row in wanted}):
        _cut_one(work, curve, spline, line, set(wanted))


def _cut_one(
    work: TransformationState, curve: int, spline: SplineBatch, line: int, wanted: set[int]
) -> None:
    """Cut one follower with the plane of one after it, and match the crossings to the places."""
    meets: CurveIntersections = work.state.curves.meets[curve]
    old = np.flatnonzero(meets.line == line)
    met = intersect_planes(spline, work.planes.normal[line], work.planes.offset[[line]])
    pairs = align_plane_roots(meets.sign[old], work.met_images(curve)[old], met.sign, met.xyz)
    found = {int(meets.row[old[one]]): other for one, other in pairs}
    for row in meets.row[old].tolist():
        if row in found and row in wanted:
            place = met.xyz[[found[row]]]
            work.value[row] = snap_into_planes(work.state, work.planes, np.array([row]), place)[0]
            work.known[row] = work.slid[row] = True
        elif row >= 0 and row in wanted:
            work.gone.add(row)

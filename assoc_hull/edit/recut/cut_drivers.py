"""Drivers of a transformation: bent out of their planes, and cut with the planes of followers.

A driver is made through the images of its own points and the places where its image meets the
planes of followers; adopted points hold it where the spline through these would leave the image by
more than the tolerance. A driver that is bent out of its plane becomes a space curve.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.crossings.adopted_points import tangency_rows
from assoc_hull.edit.lines.plane_intersections import remove_line_plane
from assoc_hull.edit.mapped_planes import IN_PLANE, snap_into_planes
from assoc_hull.edit.recut.carried_points import (
    DefiningPoints,
    TransformationState,
    loft_through,
)
from assoc_hull.edit.recut.changed_ends import (
    aligned_pairs,
    find_kept_runs,
    hand_over_ends,
    has_changed_ends,
    recognise_crossings,
)
from assoc_hull.edit.recut.driver_image import CurveImages, ImageIntersections, image_misfit
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.model.address import address
from assoc_hull.model.index import Index
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.make_objects import CrossingSpec
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "bend_lines",
    "cut_drivers",
    "drop_bent_planes",
    "hold_to_images",
]

# --------------------------------------------------------------------------------------
# Bent drivers. A space curve has no plane that other lines could be cut with. What it crosses
# passes through it as through a knuckle line without a knuckle: the crossing lies on the space
# curve where that meets the other line's plane, with two freedoms, and always defines the line.

_SAME = 1e-3
"""Times `Tolerances.factor`: two points of a boundary curve as near as this (m) are one."""


def bend_lines(work: TransformationState) -> None:
    """Give the crossings of lines that become space curves the roles they can have.

    Raises
    ------
    BadInputError
        A bent line is cut from one of lower rank that stays in its plane.
    """
    state = work.state
    for line in _bent(work):
        for row in _crossings(work, line).tolist():
            a, b = (state.line_of(c) for c in state.rows.curve[row].tolist())
            role = int(state.rows.role[row])
            if state.lines.boundary[a] >= 0:
                _share(work, row)
            elif b == line and a not in work.planes.bent:
                _refuse(work, line, int(state.rows.curve[row, 0]))
            elif role == Role.DRIVES_A or (role == Role.DRIVES_B and b in work.planes.bent):
                work.gone.add(row)
            else:
                work.maker.journal.put(state.rows.contact, [row], role != Role.WATCHED)


def _bent(work: TransformationState) -> list[int]:
    """Give the lines that become space curves, except boundary curves, by key."""
    lines = work.state.lines
    inner = [line for line in work.planes.bent if lines.boundary[line] < 0]
    return sorted(inner, key=lambda line: str(lines.key[line]))


def _crossings(work: TransformationState, line: int) -> IntArray:
    table = work.state.rows
    mine = np.isin(table.curve.data, work.state.lines.curves[line]).any(axis=1)
    found: IntArray = np.flatnonzero(table.alive.data & mine & (table.sort.data == Sort.CROSSING))
    return found


def _share(work: TransformationState, row: int) -> None:
    """Let a contact define its boundary curve too, which cannot meet the line's plane now.

    An adopted point of the boundary curve in the same place gives way, with its kind.
    """
    table, put = work.state.rows, work.maker.journal.put
    if table.role[row] == Role.SHARED:
        return
    boundary = int(table.curve[row, 0])
    rows: IntArray = work.state.curves.rows[boundary]
    step = table.xyz[rows] - table.xyz[row]
    least = work.state.tolerances.factor * _SAME
    near = rows[np.sqrt((step * step).sum(axis=1)) < least]
    for other in near.tolist():
        if table.sort[other] != Sort.ADOPTED:
            _refuse(work, work.state.line_of(int(table.curve[row, 1])), boundary)
        side = int(table.curve[other, 0] != boundary)
        kind, direction = table.kind[row].copy(), table.direction[row].copy()
        kind[0], direction[0] = table.kind[other, side], table.direction[other, side]
        put(table.kind, [row], [kind])
        put(table.direction, [row], [direction])
        work.gone.add(other)
    work.extra.setdefault(boundary, []).append((float(table.parameter[row, 0]), row))
    work.maker.roles(np.array([row]), np.array([int(Role.SHARED)]))


def _refuse(work: TransformationState, line: int, curve: int) -> None:
    names = work.state.lines.name.data
    other = names[work.state.line_of(curve)]
    raise BadInputError(
        f"the mapping bends {names[line]} {work.planes.bent[line]:.3g} m out of its plane, and "
        f"{other} cannot meet it as a curve in space", "in transform",
        f"leave {names[line]} a follower, or use a mapping that keeps its plane",
    )  # fmt: skip


def drop_bent_planes(edit: Transaction, work: TransformationState) -> None:
    """Take out the planes of bent lines, and the crossings that only they measured."""
    table = edit.state.rows
    for line in sorted(work.planes.bent):
        remove_line_plane(edit, line)
        if edit.state.lines.boundary[line] < 0:
            rows = _crossings(work, line)
            watched = rows[table.role[rows] == Role.WATCHED]
            work.gone |= set(watched.tolist())
            if len(watched):
                edit.pending.notes.append(
                    f"{edit.state.lines.name[line]}: {len(watched)} watched crossings are "
                    "watched no more: a curve in space has no plane to measure them by"
                )


# --------------------------------------------------------------------------------------
# Cutting the exact images of drivers, and holding drivers to them.

_ROUNDS = 8
"""Rounds of adding points; each halves the intervals that are too far off."""

_LEAST = 0.1
"""Times `Tolerances.factor`: least interval (m) that is given a point: at keel and stem
parents turn as sharply."""

_LEAST_FINE = 0.01
"""The same of a feature, of which it is known how it is to turn."""

_NEAR = 0.15
"""Times the same: an adopted point as near as this (m) to a crossing that slid adds nothing."""


def cut_drivers(work: TransformationState, index: Index) -> CurveImages:
    """Find where drivers cross followers, and in what order their points now come.

    Raises
    ------
    BadInputError
        A line would end elsewhere on the boundary curves than it does.
    """
    state = work.state
    mine = [curve for curve in state.live("curves").tolist() if work.drives(curve)]
    curves = np.array(sorted(mine, key=lambda c: str(state.curves.key[c])), np.int64)
    batch = SplineBatch.join([state.spline(c) for c in curves.tolist()])
    image = CurveImages.of(work.space, batch, tuple(curves.tolist()))
    slid: dict[int, float] = {}
    cuts = [
        (line, some, needed) for line in _followers(work)
        if len(some := _partners(work, index, line, curves))
        and (needed := _to_be_cut(work, image, curves, some, line))
    ]  # fmt: skip
    lines = [line for line, _, _ in cuts]
    met = image.meet(work.planes.normal[lines], work.planes.offset[lines])
    for (line, some, needed), roots in zip(cuts, met, strict=True):
        _cut_with(work, curves, some, needed, line, roots, slid)
    find_kept_runs(work)
    for local, curve in enumerate(curves.tolist()):
        knots = image.batch.knot[image.batch.start[local] : image.batch.start[local + 1]]
        _order(work, curve, knots, slid)
    return image


def _followers(work: TransformationState) -> list[int]:
    """Give the planar lines that follow, by key."""
    state = work.state
    live = state.live("lines")
    chosen = live[~work.driver[live] & work.planes.planar[live]]
    return sorted(chosen.tolist(), key=lambda line: str(state.lines.key[line]))


def _partners(work: TransformationState, index: Index, line: int, curves: IntArray) -> IntArray:
    """Give the places in `curves` of those that are cut with the plane of a line."""
    groups = [
        group
        for group, planes in index.partners.items()
        if any((each.lines == line).any() for each in planes)
    ]
    owner = work.state.lines.group[work.state.curves.line[curves]]
    return np.flatnonzero(np.isin(owner, groups))


def _to_be_cut(
    work: TransformationState, image: CurveImages, curves: IntArray, some: IntArray, line: int
) -> list[int]:
    """Give the places in `curves` of drivers whose meetings with a follower have changed."""
    old, new = float(work.state.lines.offset[line]), float(work.planes.offset[line])
    other = image.changed(work.planes.normal[line], old, new, IN_PLANE)
    return [
        local for local in some.tolist()
        if other[local] or _off(work, curves[local], line)
        or (int(curves[local]), line) in work.touches
    ]  # fmt: skip


def _cut_with(
    work: TransformationState, curves: IntArray, some: IntArray, needed: list[int], line: int,
    roots: ImageIntersections, slid: dict[int, float],
) -> None:  # fmt: skip
    """Cut drivers with the plane of one follower, at the roots of their images.

    `slid` takes the new parameters (m) of crossings on their drivers.
    """
    other = any(has_changed_ends(work, int(curves[local]), line, local, roots) for local in needed)
    if other and not hand_over_ends(work, curves, some, line, roots):
        work.anew[line] = {}
        for local in some.tolist():
            recognise_crossings(work, int(curves[local]), line, local, roots)
        return
    for local in needed:
        _match(work, int(curves[local]), line, local, roots, slid)


def _off(work: TransformationState, curve: int, line: int) -> bool:
    """Tell whether a crossing of a curve with a line has left its plane."""
    meets: CurveIntersections = work.state.curves.meets[int(curve)]
    rows = meets.row[(meets.line == line) & (meets.row >= 0)]
    return not bool(work.direct[rows].all())


def _match(
    work: TransformationState,
    curve: int,
    line: int,
    local: int,
    roots: ImageIntersections,
    slid: dict[int, float],
) -> None:
    """Match the intersections of one image with one plane to the crossings there."""
    meets: CurveIntersections = work.state.curves.meets[curve]
    old, new, pairs = aligned_pairs(work, curve, line, local, roots)
    if (curve, line) in work.touches:
        for row in tangency_rows(work.state, curve, line):
            work.value[row] = work.touches[curve, line].xyz
            work.known[row] = work.slid[row] = True
    for one, other in pairs:
        row = int(meets.row[old[one]])
        if row >= 0 and not work.direct[row]:
            place = roots.xyz[[new[other]]]
            work.value[row] = snap_into_planes(work.state, work.planes, np.array([row]), place)[0]
            work.known[row] = work.slid[row] = True
            slid[row] = float(roots.t[new[other]])
    lost = sorted(set(range(len(old))) - {one for one, _ in pairs})
    work.gone |= set(meets.row[old[lost]].tolist()) - {-1}
    for other in sorted(set(range(len(new))) - {other for _, other in pairs}):
        _add_intersection(work, curve, line, roots, int(new[other]))


def _add_intersection(
    work: TransformationState, curve: int, line: int, roots: ImageIntersections, at: int
) -> None:
    """Store a place at which a driver has come to meet a follower's plane.

    At the border of a flat and at a knuckle line the follower gets a contact.
    """
    if work.state.lines.boundary[work.state.line_of(curve)] < 0:
        work.come.append((line, roots.xyz[at]))
    else:
        _add_contact(work, curve, line, roots, at)


def _add_contact(
    work: TransformationState, curve: int, line: int, roots: ImageIntersections, at: int
) -> None:
    """Make a contact of a follower with a boundary curve that has come to it."""
    state, xyz = work.state, roots.xyz[at]
    border = state.line_of(curve)
    kind = PointKind.KNUCKLE
    end = work.ends.get((curve, at))
    if state.lines.boundary[border] == BoundaryKind.END:
        kind = PointKind.SMOOTH
    elif state.lines.boundary[border] == BoundaryKind.FLAT:
        kind = PointKind.TANGENT if work.planes.planar[border] else PointKind.SMOOTH
    sign = int(roots.sign[at])
    piece = work.piece(line, xyz) if end is None else end[0]
    spec = CrossingSpec(curve, piece, xyz, Role.DRIVES_B, sign, None, contact=True, kind_b=kind)
    row = int(work.maker.crossings([spec])[0])
    work.add(snap_into_planes(state, work.planes, np.array([row]), xyz[None])[0])
    work.contacts.append((line, row))
    if end is not None:
        work.new_ends[end] = row
    meets: CurveIntersections = state.curves.meets[curve]
    before = np.flatnonzero(meets.line == line)
    where = int(before[0]) if len(before) else len(meets.line)
    where += int((meets.parameter[before] < roots.t[at]).sum())
    work.maker.journal.set(
        state.curves.meets, [curve],
        [CurveIntersections(
            np.insert(meets.line, where, line), np.insert(meets.sign, where, roots.sign[at]),
            np.insert(meets.row, where, row), np.insert(meets.parameter, where, roots.t[at]),
            np.insert(meets.xyz, where, xyz, axis=0),
        )],
    )  # fmt: skip


def _order(
    work: TransformationState, curve: int, knots: FloatArray, slid: dict[int, float]
) -> None:
    """Order the points of a driver as its image passes them; leave out those in one place."""
    state = work.state
    more = work.extra.get(curve, [])
    rows = np.append(state.curves.rows[curve], [row for _, row in more]).astype(np.int64)
    knots = np.append(knots, [t for t, _ in more])
    numbers = rows.tolist()
    untouched = slid.keys().isdisjoint(numbers) and work.gone.isdisjoint(numbers)
    if untouched and not work.anew and not more and work.known[rows].all():
        # All stand to one another as they did before.
        work.made[curve] = DefiningPoints(numbers, list(work.value[rows]), knots.tolist())
        return
    apart = {row for row in numbers if work.apart(row)} if work.anew else set[int]()
    for row in rows[~work.known[rows]].tolist():
        if row not in work.gone and row not in apart:
            _settle(work, curve, row)
    kept = [
        # Points at one parameter keep the order of before.
        (slid.get(row, t), i, row)
        for i, (row, t) in enumerate(zip(rows.tolist(), knots.tolist(), strict=True))
        if row not in work.gone and row not in apart
    ]
    kept.sort()
    order = [row for _, _, row in kept]
    # Where nothing slid the points stand to one another as they did before.
    drop = _crowded(state, work, order) if any(row in slid for row in order) else set[int]()
    work.gone |= drop
    kept = [each for each in kept if each[2] not in drop]
    if any(row in slid for row in order):
        # After the drop: a crossing whose neighbour has just gone can still define the driver.
        held = _doubled(work, curve, [row for _, _, row in kept], slid)
        kept = [each for each in kept if each[2] not in held]
    work.made[curve] = DefiningPoints(
        [row for _, _, row in kept],
        [work.value[row].copy() for _, _, row in kept],
        [t for t, _, _ in kept],
    )


def _settle(work: TransformationState, curve: int, row: int) -> None:
    """Give a point of a driver that nothing has placed yet the place of its image.

    A crossing that is computed from a follower starts there too.
    """
    table = work.state.rows
    if table.contact[row] and not work.direct[row]:
        raise BadInputError(
            f"{address(work.state, row)}: the boundary leaves the plane of the line, and never "
            "met it in one place", "in transform",
            "remove the line before, or let the planes of followers follow",
        )  # fmt: skip
    if table.driver[row] >= 0 or work.other(row, curve) < 0:
        work.known[row] = True
    else:
        work.gone.add(row)


def _doubled(
    work: TransformationState, curve: int, order: list[int], slid: dict[int, float]
) -> set[int]:
    """Let a driver drive crossings that slid onto another of its points, instead of passing it.

    Two points of a curve cannot lie at one place. The follower is made through the crossing as
    before, which is now computed from the driver.
    """
    table, place = work.state.rows, work.value[order]
    step = np.sqrt((np.diff(place, axis=0) ** 2).sum(axis=1))
    found: set[int] = set()
    for i in np.flatnonzero(step < work.state.tolerances.coincident).tolist():
        for row in (order[i], order[i + 1]):
            first, other = table.curve[row].tolist()
            beside = order[i + 1] if row == order[i] else order[i]
            free = not table.contact[row] or table.sort[beside] == Sort.ADOPTED
            if row in slid and first == curve and other >= 0 and free:
                found.add(row)
                break
    if found:
        rows = np.array(sorted(found), np.int64)
        work.maker.roles(rows, np.full(len(rows), int(Role.DRIVES_B)))
        work.driven |= found
    return found


def _crowded(state: HullState, work: TransformationState, order: list[int]) -> set[int]:
    """Give the smooth adopted points that a crossing has slid beside."""
    place = work.value[order]
    step = np.sqrt((np.diff(place, axis=0) ** 2).sum(axis=1))
    found: set[int] = set()
    for i in np.flatnonzero(step < state.tolerances.factor * _NEAR).tolist():
        for one, other in ((order[i], order[i + 1]), (order[i + 1], order[i])):
            adopted = state.rows.sort[one] == Sort.ADOPTED
            if adopted and not state.rows.kind[one, 0] and work.slid[other]:
                found.add(one)
    return found


def hold_to_images(work: TransformationState, image: CurveImages, tolerance: float) -> int:
    """Give drivers adopted points until they stay within the tolerance of their images.

    Returns
    -------
    int
        How many points were added.
    """
    keys = work.state.curves.key.data
    curves = sorted((c for c in work.made if work.drives(c)), key=lambda curve: str(keys[curve]))
    added, left = 0, np.arange(len(curves))
    limit = np.array([work.fine.get(curve, tolerance) for curve in curves])
    least = np.array([_LEAST_FINE if curve in work.fine else _LEAST for curve in curves])
    least *= work.state.tolerances.factor
    for _ in range(_ROUNDS):
        now = [curves[i] for i in left.tolist()]
        batch = loft_through(work, now)
        at = np.concatenate([np.array(work.made[curve].at) for curve in now])
        away, middle = image_misfit(image, left, batch, at)
        count = np.diff(batch.start) - 1
        local = np.repeat(np.arange(len(left)), count)
        owner = left[local]
        chord = np.delete(np.diff(batch.knot), batch.start[1:-1] - 1)
        wide = np.flatnonzero((away > limit[owner]) & (chord > least[owner]))
        if not len(wide):
            break
        places = image.at(owner[wide], middle[wide])
        segment = wide - np.concatenate([[0], np.cumsum(count)])[local[wide]]
        for i in range(len(wide) - 1, -1, -1):
            part, before = work.made[curves[owner[wide[i]]]], int(segment[i]) + 1
            part.row.insert(before, -1)
            part.place.insert(before, _in_plane(work, curves[owner[wide[i]]], places[i]))
            part.at.insert(before, float(middle[wide[i]]))
            added += 1
        left = np.unique(owner[wide])  # the others stay as they are
    return added


def _in_plane(work: TransformationState, curve: int, place: FloatArray) -> FloatArray:
    """Put a new point of a curve exactly into the curve's plane."""
    line, out = work.state.line_of(curve), place.copy()
    if work.planes.planar[line]:
        exact = work.planes.normal[line] == 1.0
        out[exact] = work.planes.offset[line]
    return out

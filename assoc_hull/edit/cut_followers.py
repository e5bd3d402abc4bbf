"""Followers of a transformation: cut again from the drivers, then from one another by rank.

A follower is made through its crossings with drivers and with the followers cut before it,
and through its own points, which the mapping carries; where the crossings beside such a
point were carried out of the plane and found again elsewhere, it goes along with them.
"""

from __future__ import annotations

from collections import Counter

import numpy as np

from assoc_hull.edit.carry import Carried, Through, through
from assoc_hull.edit.carry_planes import into_planes
from assoc_hull.edit.thread import interval_of
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.crossing import meet_planes
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.spline import loft
from assoc_hull.model.align import align_roots
from assoc_hull.model.family import Sort
from assoc_hull.model.state import Meets

__all__ = ["cut_followers"]

_NEAR = 0.15
"""An own point as near as this (m) to one that a follower is threaded through is dropped."""


def cut_followers(work: Carried) -> None:
    """Find where all followers pass.

    Raises
    ------
    BadInputError
        A follower is cut from nothing.
    """
    state = work.state
    curves = [curve for curve in state.live("curves").tolist() if not work.drives(curve)]
    for curve in sorted(curves, key=state.rank):
        _check_cut(work, curve)
        _carry_own(work, curve)
        _give(work, curve)
    for curve in curves:
        work.made[curve] = _points(work, curve)


def _crossings(work: Carried, curve: int) -> list[int]:
    """Give the crossings that define a curve and are still there."""
    rows: IntArray = work.state.curves.rows.data[curve]
    mine = rows[work.state.rows.sort.data[rows] == Sort.CROSSING]
    return [row for row in mine.tolist() if row not in work.gone]


def _check_cut(work: Carried, curve: int) -> None:
    """See that a follower is defined by a driver, or by a follower cut before it."""
    state = work.state
    inner = [row for row in _crossings(work, curve) if not state.rows.contact.data[row]]
    given = [row for row in inner if _before(work, row, curve)]
    if (inner and not given) or len(_given_ends(work, curve)) + len(given) < 2:
        name = state.lines.name.data[state.line_of(curve)]
        raise BadInputError(
            f"{name} follows, but no driver defines it", "in transform",
            f"name {name} or its group as a driver too, or another group that crosses it",
        )  # fmt: skip


def _given_ends(work: Carried, curve: int) -> list[int]:
    """Give contacts and own points: what a follower has beside its inner crossings."""
    rows: IntArray = work.state.curves.rows.data[curve]
    own = work.state.rows.sort.data[rows] != Sort.CROSSING
    found: list[int] = rows[own | work.state.rows.contact.data[rows]].tolist()
    return found


def _before(work: Carried, row: int, curve: int) -> bool:
    """Tell whether the other curve of a crossing is cut before a follower."""
    other = work.other(row, curve)
    return work.drives(other) or work.state.rank(other) < work.state.rank(curve)


def _carry_own(work: Carried, curve: int) -> None:
    """Carry the own points of a follower, along with the crossings beside them.

    These slip by the way from the image to the new place; between two of them the slip is
    blended by the chords of the curve as it was.
    """
    state = work.state
    rows: IntArray = state.curves.rows.data[curve]
    own = state.rows.sort.data[rows] != Sort.CROSSING
    if not own.any():
        return
    step = np.sqrt((np.diff(state.rows.xyz.data[rows], axis=0) ** 2).sum(axis=1))
    chord = np.concatenate([[0.0], np.cumsum(step)])
    held = np.flatnonzero(~own & work.known[rows])
    mine = rows[own]
    if len(held):
        slip = work.value[rows[held]] - work.image[rows[held]]
        for axis in range(3):
            along = np.interp(chord[own], chord[held], slip[:, axis])
            work.value[mine, axis] = work.image[mine, axis] + along
    work.value[mine] = into_planes(state, work.planes, mine, work.value[mine])
    work.known[mine] = True


def _points(work: Carried, curve: int) -> Through:
    """Put the points of a follower that are known into order.

    Where crossings slid, those of one family and the ends keep their order, and the others
    are put between them by the least detour.
    """
    rows: IntArray = work.state.curves.rows.data[curve]
    order = [row for row in rows.tolist() if work.known[row] and row not in work.gone]
    come = [place for line, place in work.come if line == work.state.line_of(curve)]
    come = come if _nearest(work, curve, come) else []
    if not any(work.slid[row] for row in order) and not come:
        return Through(order, [work.value[row].copy() for row in order], [])
    base = _base(work, curve, order)
    found = Through(base, [work.value[row].copy() for row in base], [])
    for row in [each for each in order if each not in set(base)]:
        smooth = work.state.rows.sort.data[row] == Sort.ADOPTED
        smooth = bool(smooth) and not work.state.rows.kind.data[row, 0]
        if not _insert(found, row, work.value[row], least=_NEAR if smooth else 0.0):
            work.gone.add(row)
    for place in come:
        _insert(found, -1, into_own_plane(work, curve, place), least=_NEAR)
    return found


def _nearest(work: Carried, curve: int, come: list[FloatArray]) -> bool:
    """Tell whether a line has one piece only: then what comes to it comes to this piece."""
    return bool(come) and work.state.lines.curves.data[work.state.line_of(curve)] == (curve,)


def into_own_plane(work: Carried, curve: int, place: FloatArray) -> FloatArray:
    """Put a place exactly into the plane of a curve."""
    line, out = work.state.line_of(curve), place.copy()
    exact = work.planes.normal[line] == 1.0
    out[exact] = work.planes.offset[line]
    return out


def _insert(found: Through, row: int, place: FloatArray, least: float) -> bool:
    """Put a point where it makes the least detour, unless one is nearer than `least`."""
    places = np.array(found.place)
    if least and float(np.sqrt(((places - place) ** 2).sum(axis=1)).min()) < least:
        return False
    index = interval_of(places, place)
    found.row.insert(index, row)
    found.place.insert(index, place.copy())
    return True


def _base(work: Carried, curve: int, order: list[int]) -> list[int]:
    """Give the points of a curve that keep their order: ends, and the family that cuts most."""
    state = work.state
    group = {
        row: int(state.lines.group.data[state.line_of(work.other(row, curve))])
        for row in order
        if work.other(row, curve) >= 0 and not state.rows.contact.data[row]
    }
    count = Counter(group.values())
    main = min(count, key=lambda each: (-count[each], each)) if count else -1
    ends = {order[0], order[-1]}
    return [
        row for row in order
        if row in ends or state.rows.contact.data[row] or group.get(row) == main
    ]  # fmt: skip


def _give(work: Carried, curve: int) -> None:
    """Cut a follower with the planes of those that come after it, where these have to slide."""
    state, table = work.state, work.state.rows
    meets: Meets = state.curves.meets.data[curve]
    rows = meets.row[meets.row >= 0]
    rows = rows[~work.known[rows]]
    wanted = [
        row for row in rows.tolist()
        if row not in work.gone and (table.reader.data[row] >= 0).any()
        and not _before(work, row, curve)
    ]  # fmt: skip
    if not wanted:
        return
    work.made[curve] = _points(work, curve)
    spline = loft(through(work, [curve]), [str(state.curves.key.data[curve])])
    for line in sorted({state.line_of(work.other(row, curve)) for row in wanted}):
        _cut_one(work, curve, spline, line, set(wanted))


def _cut_one(
    work: Carried, curve: int, spline: SplineBatch, line: int, wanted: set[int]
) -> None:
    """Cut one follower with the plane of one after it, and say which crossing is which."""
    meets: Meets = work.state.curves.meets.data[curve]
    old = np.flatnonzero(meets.line == line)
    met = meet_planes(spline, work.planes.normal[line], work.planes.offset[[line]])
    pairs = align_roots(meets.sign[old], work.space.places(meets.xyz[old]), met.sign, met.xyz)
    found = {int(meets.row[old[one]]): other for one, other in pairs}
    for row in meets.row[old].tolist():
        if row in found and row in wanted:
            place = met.xyz[[found[row]]]
            work.value[row] = into_planes(work.state, work.planes, np.array([row]), place)[0]
            work.known[row] = work.slid[row] = True
        elif row >= 0 and row in wanted:
            work.gone.add(row)

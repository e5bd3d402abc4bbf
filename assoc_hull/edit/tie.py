"""What a follower whose plane slides over the hull is tied to, beside the family it is cut from.

Lines of two families agree where they cross, and within the tolerance of adoption between. A
line through new crossings with both would waver between them. So it is made through those with
one family, and through other places only where it would pass them too far off: crossings with
drivers that rank behind, and its own adopted points, which slip over the hull as the crossings
beside them do.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.carry import Carried, Through, through
from assoc_hull.edit.carry_planes import into_planes
from assoc_hull.edit.thread import interval_of
from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind
from assoc_hull.geometry.spline import loft
from assoc_hull.model.family import Sort

__all__ = ["insert", "loose_points", "slip_along", "tie"]

_ROUNDS = 12

_DOUBT = 0.3
"""Where a point slips to is uncertain by this part of the way."""

_SHARP = 0.5
"""Where the chords of a line make an angle of a lower cosine, its adopted points are needed."""

_NEAR = 0.15
"""An adopted point as near as this (m) to another point adds nothing."""


def insert(found: Through, row: int, place: FloatArray, least: float = 0.0) -> bool:
    """Put a point where it makes the least detour, unless one is nearer than `least` (m)."""
    places = np.array(found.place)
    if least and float(np.sqrt(((places - place) ** 2).sum(axis=1)).min()) < least:
        return False
    index = interval_of(places, place)
    found.row.insert(index, row)
    found.place.insert(index, place.copy())
    return True


def _adopted(work: Carried, curve: int) -> IntArray:
    """Give the smooth adopted points of a follower, without its ends."""
    state = work.state
    rows: IntArray = state.curves.rows.data[curve][1:-1]
    smooth = state.rows.kind.data[rows, 0] == PointKind.SMOOTH
    found: IntArray = rows[(state.rows.sort.data[rows] == Sort.ADOPTED) & smooth]
    return found


def slip_along(work: Carried, curve: int) -> None:
    """Let the adopted points of a follower slip over the hull as the crossings beside them.

    How far a crossing has slid off its image changes slowly along the curve.
    """
    state = work.state
    rows: IntArray = state.curves.rows.data[curve]
    mine = _adopted(work, curve)
    mine = mine[~work.still[mine]]
    given = [row for row in rows.tolist() if _gives(work, curve, row)]
    if not len(mine):
        return
    if len(given) < 2:
        work.gone |= set(mine.tolist())
        return
    knot = dict(zip(rows.tolist(), state.spline(curve).knot.tolist(), strict=True))
    at = np.array([knot[row] for row in given])
    slip = _between(at, work.value[given] - work.image[given], np.array([knot[r] for r in mine]))
    work.value[mine] = into_planes(state, work.planes, mine, work.image[mine] + slip)
    work.known[mine] = True


def _gives(work: Carried, curve: int, row: int) -> bool:
    """Tell whether a crossing shows how far the hull slips: one of the family of least rank."""
    table = work.state.rows
    if not work.known[row] or row in work.gone or table.sort.data[row] != Sort.CROSSING:
        return False
    if table.contact.data[row]:
        return row in work.state.curves.rows.data[curve][[0, -1]].tolist()
    return True


def _between(at: FloatArray, values: FloatArray, where: FloatArray) -> FloatArray:
    """Interpolate values (k, 3) given at ascending parameters (k,): cubics with slopes (p, 3)."""
    step = np.diff(at)
    chord = np.diff(values, axis=0) / step[:, None]
    slope = np.empty_like(values)
    if len(at) > 2:
        part = (step[1:] / (step[1:] + step[:-1]))[:, None]
        slope[1:-1] = part * chord[:-1] + (1.0 - part) * chord[1:]
    slope[0], slope[-1] = chord[0], chord[-1]
    low = np.clip(np.searchsorted(at, where, side="right") - 1, 0, len(step) - 1)
    h = step[low][:, None]
    s = np.clip((where - at[low])[:, None] / h, 0.0, 1.0)
    here, there = values[low], values[low + 1]
    blend = s * s * (3.0 - 2.0 * s)
    found: FloatArray = here + (there - here) * blend
    found = found + h * s * (1.0 - s) * ((1.0 - s) * slope[low] - s * slope[low + 1])
    return found


def loose_points(work: Carried, curve: int, order: list[int]) -> list[int]:
    """Give the points that a follower need not pass.

    These are crossings where drivers slid that rank behind the family it is cut from, and its
    own adopted points that slipped.
    """
    state = work.state
    rank = {
        row: state.family(state.line_of(work.other(row, curve))).rank
        for row in order
        if work.other(row, curve) >= 0 and work.drives(work.other(row, curve))
        and not state.rows.contact.data[row]
    }  # fmt: skip
    least = min(rank.values(), default=0)
    own = set(_adopted(work, curve).tolist())
    return [
        row for row in order
        if (row in own and not work.still[row]) or (rank.get(row, least) > least and work.slid[row])
    ]  # fmt: skip


def tie(work: Carried, curve: int, found: Through, loose: list[int]) -> None:
    """Tie a follower to points that it would pass too far off, the farthest of each segment first.

    Crossings that it passes anyway define it too; others are watched from now on, and adopted
    points go.
    """
    state, left = work.state, list(loose)
    away = np.zeros(len(left))
    for _ in range(_ROUNDS):
        if not left:
            return
        work.made[curve] = found
        spline = loft(through(work, [curve]))
        at, _, away = closest(spline, 0, work.value[left])
        segment = np.searchsorted(spline.knot, at, side="right")
        wide = np.flatnonzero(away > _limit(work, left))
        wide = wide[np.argsort(-away[wide], kind="stable")]
        first = wide[np.sort(np.unique(segment[wide], return_index=True)[1])].tolist()
        for i in first:
            _take(work, found, left[i])
        left = [row for i, row in enumerate(left) if i not in set(first)]
        if not first:
            break
    for row, off in zip(left, away.tolist(), strict=False):
        if state.rows.sort.data[row] == Sort.ADOPTED:
            if _at_turn(found, work.value[row]):
                _take(work, found, row)
            else:
                work.gone.add(row)
        elif off <= state.tolerances.keep:
            insert(found, row, work.value[row])
        else:
            work.watched.add(row)


def _at_turn(found: Through, place: FloatArray) -> bool:
    """Tell whether a place lies beside a point at which the chords of a line turn sharply."""
    places = np.array(found.place)
    chord = np.diff(places, axis=0)
    unit = chord / np.sqrt((chord * chord).sum(axis=1))[:, None]
    cosine = np.concatenate([[1.0], (unit[1:] * unit[:-1]).sum(axis=1), [1.0]])
    index = interval_of(places, place)
    return bool(cosine[index - 1 : index + 1].min() < _SHARP)


def _limit(work: Carried, rows: list[int]) -> FloatArray:
    """Give how far off points may be passed, (k,), m.

    Where an adopted point has slipped to is known the less the farther it slipped.
    """
    slip = np.sqrt(((work.value[rows] - work.image[rows]) ** 2).sum(axis=1))
    own = work.state.rows.sort.data[rows] == Sort.ADOPTED
    least = 0.5 * work.state.tolerances.adoption
    return np.asarray(least + np.where(own, _DOUBT * slip, 0.0))


def _take(work: Carried, found: Through, row: int) -> None:
    """Put a point among those of a follower; an adopted one beside another adds nothing."""
    adopted = work.state.rows.sort.data[row] == Sort.ADOPTED
    if not insert(found, row, work.value[row], _NEAR if adopted else 0.0):
        work.gone.add(row)

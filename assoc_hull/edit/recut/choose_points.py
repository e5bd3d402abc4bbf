"""What a follower whose plane slides over the hull is tied to, beside the family it is cut from.

Lines of two families agree where they cross, and within the tolerance of adoption between. A
line through new crossings with both would waver between them. So it is made through those with
one family, and through other places only where it would pass them too far off: crossings with
drivers that rank behind, and its own adopted points, which slip over the hull as the crossings
beside them do.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.thread import interval_of
from assoc_hull.edit.mapped_planes import into_planes
from assoc_hull.edit.recut.carried_points import Carried, Through, through
from assoc_hull.edit.recut.fairest_choice import Option, choose_fair, too_near
from assoc_hull.edit.recut.projected_image import Shadow, shadow_of
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.curve_order import folds
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.model.kinds import Sort
from assoc_hull.model.state import Meets

__all__ = [
    "choose",
    "free_points",
    "insert",
    "into_own_plane",
    "loose_points",
    "round_turns",
    "slip_along",
    "tie",
    "tie_own",
]

_ROUNDS = 12

_DOUBTS = (1.0, 0.3, 0.0)
"""How much of the doubt about where own points slip to is minded, first to last."""

_STEPS = 2.0
"""An end that is handed over changes the course up to so many times the way between the two."""

_NEAR = 0.15
"""An adopted point as near as this (m) to another point adds nothing."""


def insert(found: Through, row: int, place: FloatArray, least: float = 0.0) -> bool:
    """Put a point where it makes the least detour, unless one is nearer than `least` (m).

    Nor is it put where it would lie too near to one for the chord it comes into.
    """
    places = np.array(found.place)
    index = interval_of(places, place)
    if least and too_near(places, index, place, least):
        return False
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
    """Let the own points of a follower slip over the hull as the crossings beside them."""
    state = work.state
    rows: IntArray = state.curves.rows.data[curve]
    own = rows[state.rows.sort.data[rows] != Sort.CROSSING]
    work.known[own[work.direct[own]]] = True
    mine = own[~work.known[own]]
    if not len(mine):
        return
    knot = dict(zip(rows.tolist(), state.spline(curve).knot.tolist(), strict=True))
    lost = _at_new_ends(work, curve, mine, knot)
    work.gone |= set(lost)
    mine = mine[~np.isin(mine, lost)]
    shadow = shadow_of(work, curve)
    if shadow is None or not len(mine):
        work.gone |= set(mine.tolist())
        return
    at = np.array([knot[row] for row in mine.tolist()])
    places = shadow.at(at)
    work.doubt |= dict(zip(mine.tolist(), shadow.doubt(at).tolist(), strict=True))
    work.value[mine] = into_planes(state, work.planes, mine, places)
    work.known[mine] = True


def _at_new_ends(work: Carried, curve: int, mine: IntArray, knot: dict[int, float]) -> list[int]:
    """Give the own points beside ends that were handed over: they held another course."""
    rows: IntArray = work.state.curves.rows.data[curve]
    inner = [knot[row] for row in rows.tolist() if work.known[row] and row not in work.gone]
    last = float(work.state.spline(curve).knot[-1])
    low, high = 0.0, last
    if (curve, 0) in work.new_ends:
        low = max(min(inner, default=last), _STEPS * _handed(work, curve, 0))
    if (curve, 1) in work.new_ends:
        high = min(max(inner, default=0.0), last - _STEPS * _handed(work, curve, 1))
    return [row for row in mine.tolist() if not low <= knot[row] <= high]


def _handed(work: Carried, curve: int, side: int) -> float:
    """Give how far an end is from where it would be had it not been handed over, m."""
    rows: IntArray = work.state.curves.rows.data[curve]
    step = work.value[work.end(curve, side)] - work.image[int(rows[-side])]
    return float(np.sqrt((step * step).sum()))


def round_turns(work: Carried, curve: int, found: Through) -> None:
    """Give a follower a point on either side of where it would turn by more than 90 degrees."""
    state = work.state
    knot = dict(
        zip(state.curves.rows.data[curve].tolist(), state.spline(curve).knot.tolist(), strict=True)
    )
    work.made[curve] = found
    turns = folds(loft(through(work, [curve]))).knot.tolist()
    if len(turns) <= len(folds(state.spline(curve))):
        return
    shadow: Shadow | None = None
    for low in sorted({max(turn - side, 0) for turn in turns for side in (0, 1)}, reverse=True):
        pair = [knot.get(row) for row in found.row[low : low + 2]]
        if len(pair) < 2 or pair[0] is None or pair[1] is None or not pair[0] < pair[1]:
            continue
        at = np.array([0.5 * (pair[0] + pair[1])])
        shadow = shadow or shadow_of(work, curve)
        if shadow is not None:
            found.row.insert(low + 1, -1)
            found.place.insert(low + 1, into_own_plane(work, curve, shadow.at(at)[0]))


def into_own_plane(work: Carried, curve: int, place: FloatArray) -> FloatArray:
    """Put a place exactly into the plane of a curve."""
    line, out = work.state.line_of(curve), place.copy()
    exact = work.planes.normal[line] == 1.0
    out[exact] = work.planes.offset[line]
    return out


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
        if (row in own and not work.direct[row])
        or (rank.get(row, least) > least and work.slid[row])
    ]  # fmt: skip


def tie(work: Carried, curve: int, found: Through, loose: list[int]) -> None:
    """Tie a follower to crossings that it would pass too far off.

    Those that it passes anyway define it too; the others are watched from now on.
    """
    state = work.state
    left, away = _taken(work, curve, found, loose, 0.0)
    for row, off in zip(left, away.tolist(), strict=True):
        if off <= state.tolerances.keep:
            insert(found, row, work.value[row])
        else:
            work.watched.add(row)


def tie_own(work: Carried, curve: int, found: Through, own: list[int]) -> None:
    """Tie a follower to those of its adopted points that it would pass too far off.

    Where they slip to is known the less the farther they slip, so few are needed. All are,
    where without them the follower would fold, or meet another plane more often than it may.
    """
    if not own:
        return
    trials = list[Through]()
    for doubt in _DOUBTS:
        trials.append(Through(list(found.row), list(found.place), []))
        _taken(work, curve, trials[-1], own, doubt)
        if _sound(work, curve, trials[-1]):
            break
    trial = trials[-1] if _sound(work, curve, trials[-1]) else trials[0]
    work.gone |= set(own) - set(trial.row)
    found.row, found.place = trial.row, trial.place


def free_points(work: Carried, own: list[int], ties: list[int]) -> list[Option]:
    """Give the points that a follower need not pass, and how far it may pass them off."""
    most = work.state.tolerances.adoption
    found = [Option(row, work.value[row], most + work.doubt.get(row, 0.0)) for row in own]
    return found + [Option(row, work.value[row], most, near=0.0) for row in ties]


def choose(work: Carried, curve: int, found: Through, options: list[Option]) -> None:
    """Let a follower pass the points that make it fair, and leave the others."""
    before = Through(list(found.row), list(found.place), [])
    taken = choose_fair(work, curve, found, options)
    if not _sound(work, curve, found):
        found.row, found.place = before.row, before.place
        return
    for i, option in enumerate(options):
        if option.row < 0:
            continue
        away = work.gone if work.state.rows.sort.data[option.row] == Sort.ADOPTED else work.watched
        (away.discard if i in taken else away.add)(option.row)


def _taken(
    work: Carried, curve: int, found: Through, loose: list[int], doubt: float
) -> tuple[list[int], FloatArray]:
    """Take in points passed too far off, the farthest of each segment first; give the others.

    An adopted point beside another one adds nothing.
    """
    sort = work.state.rows.sort.data
    left, away = list(loose), np.zeros(len(loose))
    for _ in range(_ROUNDS):
        if not left:
            break
        work.made[curve] = found
        spline = loft(through(work, [curve]))
        at, _, away = closest(spline, 0, work.value[left])
        vague = np.array([work.doubt.get(row, 0.0) for row in left])
        segment = np.searchsorted(spline.knot, at, side="right")
        wide = np.flatnonzero(away > 0.5 * work.state.tolerances.adoption + doubt * vague)
        wide = wide[np.argsort(-away[wide], kind="stable")]
        first = wide[np.sort(np.unique(segment[wide], return_index=True)[1])].tolist()
        if not first:
            break
        for i in first:
            least = _NEAR if sort[left[i]] == Sort.ADOPTED else 0.0
            insert(found, left[i], work.value[left[i]], least)
        left = [row for i, row in enumerate(left) if i not in set(first)]
        away = np.zeros(len(left))
    return left, away


def _sound(work: Carried, curve: int, found: Through) -> bool:
    """Tell whether a follower does not fold, and meets lines that it drives as often as it may."""
    state = work.state
    work.made[curve] = found
    spline = loft(through(work, [curve]))
    if len(folds(spline)) > len(folds(state.spline(curve))):
        return False
    meets: Meets = state.curves.meets.data[curve]
    here = [row for row in meets.row.tolist() if row >= 0 and row not in work.gone]
    lines = {row: state.line_of(work.other(row, curve)) for row in here}
    driven = sorted({lines[row] for row in here if state.rows.driver.data[row] == curve})
    for line in driven:
        met = meet_planes(spline, work.planes.normal[line], work.planes.offset[[line]])
        if met.count > sum(lines[row] == line for row in here):
            return False
    return True

"""The points that a follower is made through when its plane slides over the hull.

Lines of two families agree where they cross, and within the tolerance of adoption between, so a
line through new crossings with both would waver. It is made through those with one family, and tied
to other places (crossings with drivers that rank behind, its own adopted points) only where it
would pass them too far off. Among optional places, those are taken that make it as fair as it was.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import insertion_index
from assoc_hull.edit.mapped_planes import snap_into_planes
from assoc_hull.edit.recut.carried_points import (
    DefiningPoints,
    TransformationState,
    loft_through,
)
from assoc_hull.edit.recut.driver_image import ProjectedImage, projected_image
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.fairness.combs import DEAD_BAND, comb_integrals, curvature_sign_changes
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.geometry.splines.distance import closest_points, closest_points_each
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import CurveIntersections

__all__ = [
    "OptionalPoint",
    "choose_fair_options",
    "choose_fair_points",
    "free_points",
    "insert_by_detour",
    "into_curve_plane",
    "is_too_near",
    "loose_points",
    "round_turns",
    "slide_own_points",
    "tie_to_crossings",
    "tie_to_own_points",
]

# --------------------------------------------------------------------------------------
# Optional points, chosen one after the other, each time the one that makes the curve fairest.

_COMB = 1.5
"""A comb integral may grow to so many times what it was."""

_ROUNDS = 12
"""Rounds of choosing, and trials looked at in each; rounds of tying, too."""

_NEAR = 0.15
"""Times `Tolerances.factor`: no option is taken as near as this (m) to a point of the follower."""

_PART = 0.2
"""Nor nearer to an end of the chord that it comes into than this part of it."""


@attrs.frozen(eq=False)
class OptionalPoint:
    """A place that a follower may pass.

    Attributes
    ----------
    row : int
        The point; -1 for a new adopted one.
    place : (3,), m
        Where it is.
    limit : float, m
        How far the follower may pass it off where it is not made through it.
    near : float, m
        Not taken where a point of the follower is as near as this, or nearly so; 0: anywhere.
    """

    row: int
    place: FloatArray
    limit: float
    near: float


@attrs.frozen(eq=False)
class _Trial:
    """Points of a follower, and which of the options are among them."""

    points: DefiningPoints
    taken: frozenset[int]


def is_too_near(places: FloatArray, index: int, place: FloatArray, least: float) -> bool:
    """Tell whether a place is too near to points of a curve to come before the one at an index.

    A curve through two near points that are a little off waves more than it strays without one.
    """
    away = np.sqrt(((places - place) ** 2).sum(axis=1))
    step = places[index] - places[index - 1]
    chord = float(np.sqrt((step * step).sum()))
    beside = float(min(away[index], away[index - 1]))
    return float(away.min()) <= least or beside < _PART * chord


def choose_fair_options(
    work: TransformationState, curve: int, found: DefiningPoints, options: Sequence[OptionalPoint]
) -> tuple[int, ...]:
    """Take and leave options until a follower is as fair as it was, or none helps any more.

    `found` are its points, options among them; changed in place. Gives the options that it is
    made through now, by their index.
    """
    best = _Trial(found, frozenset(i for i, each in enumerate(options) if _is_in(found, each)))
    normal = work.planes.normal[work.state.line_of(curve)]
    was = _unfair(work.state.spline(curve), normal)
    cost = _costs(_lofted(work, curve, [best]), normal, was)[0]
    most = 0 if cost == (0, 0.0) else len(curve_folds(work.state.spline(curve)))
    for _ in range(_ROUNDS):
        trials = [] if cost == (0, 0.0) else _toggled(best, options)
        if not trials:
            break
        splines = _lofted(work, curve, trials)
        costs = _costs(splines, normal, was)
        folds = np.bincount(curve_folds(splines).curve, minlength=len(trials))
        order = sorted(range(len(trials)), key=lambda i: costs[i])
        better = [i for i in order if costs[i] < cost][:_ROUNDS]
        better = [i for i in better if folds[i] <= most]
        passing = _passing(splines, better, [trials[i].taken for i in better], options)
        if not passing:
            break
        chosen = passing[0]
        best, cost = trials[chosen], costs[chosen]
    found.row, found.place = best.points.row, best.points.place
    return tuple(sorted(best.taken))


def _is_in(found: DefiningPoints, option: OptionalPoint) -> bool:
    """Tell whether a follower is made through an option."""
    if option.row >= 0:
        return option.row in found.row
    return any(
        row < 0 and bool((place == option.place).all())
        for row, place in zip(found.row, found.place, strict=True)
    )


def _toggled(best: _Trial, options: Sequence[OptionalPoint]) -> list[_Trial]:
    """Give the trials that differ by one option."""
    trials = list[_Trial]()
    for i, option in enumerate(options):
        if i in best.taken:
            trials.append(_Trial(_without(best.points, option), best.taken - {i}))
            continue
        places = np.array(best.points.place)
        index = insertion_index(places, option.place)
        if not option.near or not is_too_near(places, index, option.place, option.near):
            trials.append(_Trial(_with(best.points, option, index), best.taken | {i}))
    return trials


def _with(points: DefiningPoints, option: OptionalPoint, index: int) -> DefiningPoints:
    row, place = list(points.row), list(points.place)
    row.insert(index, option.row)
    place.insert(index, option.place.copy())
    return DefiningPoints(row, place, [])


def _without(points: DefiningPoints, option: OptionalPoint) -> DefiningPoints:
    left = [
        (row, place) for row, place in zip(points.row, points.place, strict=True)
        if row != option.row or (row < 0 and not bool((place == option.place).all()))
    ]  # fmt: skip
    return DefiningPoints([row for row, _ in left], [place for _, place in left], [])


def _unfair(spline: SplineBatch, normal: FloatArray) -> tuple[IntArray, FloatArray]:
    """Give changes of sign of the curvature, and comb integrals, curve by curve."""
    normals = np.broadcast_to(normal, (spline.count, 3))
    return curvature_sign_changes(spline, normals, DEAD_BAND), comb_integrals(spline, normals)


def _lofted(work: TransformationState, curve: int, trials: Sequence[_Trial]) -> SplineBatch:
    """Make a follower through the points of each trial."""
    return loft_through(work, [curve] * len(trials), [each.points for each in trials])


def _costs(
    splines: SplineBatch, normal: FloatArray, was: tuple[IntArray, FloatArray]
) -> list[tuple[int, float]]:
    """Give how much less fair trials are than the follower was: (0, 0.0) where they are not.

    First counts the changes of sign of the curvature that are more, then the comb integral.
    """
    signs, comb = _unfair(splines, normal)
    more = np.maximum(signs - was[0][0], 0)
    grown = np.where((more > 0) | (comb > _COMB * was[1][0]), comb, 0.0)
    return list(zip(more.tolist(), grown.tolist(), strict=True))


def _passing(
    splines: SplineBatch, chosen: Sequence[int], taken: Sequence[frozenset[int]],
    options: Sequence[OptionalPoint],
) -> list[int]:  # fmt: skip
    """Give those of chosen curves that pass all options but those taken within their limits."""
    pairs = [
        (curve, i) for curve, without in zip(chosen, taken, strict=True)
        for i in range(len(options)) if i not in without
    ]  # fmt: skip
    if not pairs:
        return list(chosen)
    curve, option = np.array(pairs, np.int64).T
    places = np.array([each.place for each in options])[option]
    # All at once: one call for each curve costs more than what it finds.
    _, _, away = closest_points_each(splines, curve, places)
    far = away > np.array([each.limit for each in options])[option]
    failing = set(curve[far].tolist())
    return [each for each in chosen if each not in failing]


# --------------------------------------------------------------------------------------
# Ties, beside the family that a follower is cut from.

_DOUBTS = (1.0, 0.3, 0.0)
"""Parts of the doubt about where own points slip to that are added to the tolerance, in turn."""

_STEPS = 2.0
"""An end that is handed over changes the course up to so many times the way between the two."""


def insert_by_detour(
    found: DefiningPoints, row: int, place: FloatArray, least: float = 0.0
) -> bool:
    """Insert a point where it makes the least detour; False if it is too near to another one.

    `least` (m) is as of `is_too_near`; 0 for anywhere.
    """
    places = np.array(found.place)
    index = insertion_index(places, place)
    if least and is_too_near(places, index, place, least):
        return False
    found.row.insert(index, row)
    found.place.insert(index, place.copy())
    return True


def _adopted(work: TransformationState, curve: int) -> IntArray:
    """Give the smooth adopted points of a follower, without its ends."""
    state = work.state
    rows: IntArray = state.curves.rows[curve][1:-1]
    smooth = state.rows.kind[rows, 0] == PointKind.SMOOTH
    found: IntArray = rows[(state.rows.sort[rows] == Sort.ADOPTED) & smooth]
    return found


def slide_own_points(work: TransformationState, curve: int) -> None:
    """Let the own points of a follower slip over the hull as the crossings beside them do."""
    state = work.state
    rows: IntArray = state.curves.rows[curve]
    own = rows[state.rows.sort[rows] != Sort.CROSSING]
    work.known[own[work.direct[own]]] = True
    mine = own[~work.known[own]]
    if not len(mine):
        return
    knot = dict(zip(rows.tolist(), state.spline(curve).knot.tolist(), strict=True))
    lost = _at_new_ends(work, curve, mine, knot)
    work.gone |= set(lost)
    mine = mine[~np.isin(mine, lost)]
    shadow = projected_image(work, curve)
    if shadow is None or not len(mine):
        work.gone |= set(mine.tolist())
        return
    at = np.array([knot[row] for row in mine.tolist()])
    places = shadow.at(at)
    work.doubt |= dict(zip(mine.tolist(), shadow.doubt(at).tolist(), strict=True))
    work.value[mine] = snap_into_planes(state, work.planes, mine, places)
    work.known[mine] = True


def _at_new_ends(
    work: TransformationState, curve: int, mine: IntArray, knot: dict[int, float]
) -> list[int]:
    """Give the own points beside ends that were handed over: they held another course."""
    rows: IntArray = work.state.curves.rows[curve]
    inner = [knot[row] for row in rows.tolist() if work.known[row] and row not in work.gone]
    last = float(work.state.spline(curve).knot[-1])
    low, high = 0.0, last
    if (curve, 0) in work.new_ends:
        low = max(min(inner, default=last), _STEPS * _handed(work, curve, 0))
    if (curve, 1) in work.new_ends:
        high = min(max(inner, default=0.0), last - _STEPS * _handed(work, curve, 1))
    return [row for row in mine.tolist() if not low <= knot[row] <= high]


def _handed(work: TransformationState, curve: int, side: int) -> float:
    """Give how far an end is from where it would be had it not been handed over, m."""
    rows: IntArray = work.state.curves.rows[curve]
    step = work.value[work.end(curve, side)] - work.image[int(rows[-side])]
    return float(np.sqrt((step * step).sum()))


def round_turns(work: TransformationState, curve: int, found: DefiningPoints) -> None:
    """Give a follower a point on either side of where it would fold: turn by over 90 degrees."""
    state = work.state
    knot = dict(
        zip(state.curves.rows[curve].tolist(), state.spline(curve).knot.tolist(), strict=True)
    )
    work.made[curve] = found
    turns = curve_folds(loft_through(work, [curve])).knot.tolist()
    if len(turns) <= len(curve_folds(state.spline(curve))):
        return
    shadow: ProjectedImage | None = None
    for low in sorted({max(turn - side, 0) for turn in turns for side in (0, 1)}, reverse=True):
        pair = [knot.get(row) for row in found.row[low : low + 2]]
        if len(pair) < 2 or pair[0] is None or pair[1] is None or not pair[0] < pair[1]:
            continue
        at = np.array([0.5 * (pair[0] + pair[1])])
        shadow = shadow or projected_image(work, curve)
        if shadow is not None:
            found.row.insert(low + 1, -1)
            found.place.insert(low + 1, into_curve_plane(work, curve, shadow.at(at)[0]))


def into_curve_plane(work: TransformationState, curve: int, place: FloatArray) -> FloatArray:
    """Put a place exactly into the plane of a curve."""
    line, out = work.state.line_of(curve), place.copy()
    exact = work.planes.normal[line] == 1.0
    out[exact] = work.planes.offset[line]
    return out


def loose_points(work: TransformationState, curve: int, order: list[int]) -> list[int]:
    """Give the points that a follower need not pass.

    These are crossings where drivers slid that rank behind the family it is cut from, and its
    own adopted points that slipped.
    """
    state = work.state
    rank = {
        row: state.family(state.line_of(work.other(row, curve))).rank
        for row in order
        if work.other(row, curve) >= 0 and work.drives(work.other(row, curve))
        and not state.rows.contact[row]
    }  # fmt: skip
    least = min(rank.values(), default=0)
    own = set(_adopted(work, curve).tolist())
    return [
        row for row in order
        if (row in own and not work.direct[row])
        or (rank.get(row, least) > least and work.slid[row])
    ]  # fmt: skip


def tie_to_crossings(
    work: TransformationState, curve: int, found: DefiningPoints, loose: list[int]
) -> None:
    """Tie a follower to crossings that it would pass too far off.

    Those that it passes anyway define it too; the others are watched from now on.
    """
    state = work.state
    left, away = _taken(work, curve, found, loose, 0.0)
    for row, off in zip(left, away.tolist(), strict=True):
        if off <= state.tolerances.keep:
            insert_by_detour(found, row, work.value[row])
        else:
            work.watched.add(row)


def tie_to_own_points(
    work: TransformationState, curve: int, found: DefiningPoints, own: list[int]
) -> None:
    """Tie a follower to those of its adopted points that it would pass too far off.

    Where they slip to is known the less the farther they slip, so few are needed. All are,
    where without them the follower would fold, or meet another plane more often than it may.
    """
    if not own:
        return
    trials, sound = list[DefiningPoints](), False
    for doubt in _DOUBTS:
        trials.append(DefiningPoints(list(found.row), list(found.place), []))
        _taken(work, curve, trials[-1], own, doubt)
        sound = _sound(work, curve, trials[-1])
        if sound:
            break
    trial = trials[-1] if sound else trials[0]
    work.gone |= set(own) - set(trial.row)
    found.row, found.place = trial.row, trial.place


def free_points(work: TransformationState, own: list[int], ties: list[int]) -> list[OptionalPoint]:
    """Give the points that a follower need not pass, and how far it may pass them off."""
    most = work.state.tolerances.adoption
    near = work.state.tolerances.factor * _NEAR
    found = [
        OptionalPoint(row, work.value[row], most + work.doubt.get(row, 0.0), near) for row in own
    ]
    return found + [OptionalPoint(row, work.value[row], most, near=0.0) for row in ties]


def choose_fair_points(
    work: TransformationState, curve: int, found: DefiningPoints, options: list[OptionalPoint]
) -> None:
    """Let a follower pass the points that make it fair, and leave the others."""
    before = DefiningPoints(list(found.row), list(found.place), [])
    taken = choose_fair_options(work, curve, found, options)
    if not _sound(work, curve, found):
        found.row, found.place = before.row, before.place
        return
    for i, option in enumerate(options):
        if option.row < 0:
            continue
        away = work.gone if work.state.rows.sort[option.row] == Sort.ADOPTED else work.watched
        (away.discard if i in taken else away.add)(option.row)


def _taken(
    work: TransformationState, curve: int, found: DefiningPoints, loose: list[int], doubt: float
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
        spline = loft_through(work, [curve])
        at, _, away = closest_points(spline, 0, work.value[left])
        vague = np.array([work.doubt.get(row, 0.0) for row in left])
        segment = np.searchsorted(spline.knot, at, side="right")
        wide = np.flatnonzero(away > 0.5 * work.state.tolerances.adoption + doubt * vague)
        wide = wide[np.argsort(-away[wide], kind="stable")]
        first = wide[np.sort(np.unique(segment[wide], return_index=True)[1])].tolist()
        if not first:
            break
        for i in first:
            near = work.state.tolerances.factor * _NEAR
            least = near if sort[left[i]] == Sort.ADOPTED else 0.0
            insert_by_detour(found, left[i], work.value[left[i]], least)
        left = [row for i, row in enumerate(left) if i not in set(first)]
        away = np.zeros(len(left))
    return left, away


def _sound(work: TransformationState, curve: int, found: DefiningPoints) -> bool:
    """Tell whether a follower does not fold, and meets lines that it drives as often as it may."""
    state = work.state
    work.made[curve] = found
    spline = loft_through(work, [curve])
    if len(curve_folds(spline)) > len(curve_folds(state.spline(curve))):
        return False
    meets: CurveIntersections = state.curves.meets[curve]
    here = [row for row in meets.row.tolist() if row >= 0 and row not in work.gone]
    lines = {row: state.line_of(work.other(row, curve)) for row in here}
    driven = sorted({lines[row] for row in here if state.rows.driver[row] == curve})
    for line in driven:
        met = intersect_planes(spline, work.planes.normal[line], work.planes.offset[[line]])
        if met.count > sum(lines[row] == line for row in here):
            return False
    return True

"""Features that an edit has bent by a little are drawn anew, on the ends that it gave them.

A straight run is drawn on the chord of its ends, an arc on the circle through its ends whose
tangents turn as before, a circle on the one that its mirror image closes, a flat in its plane. The
points between the ends are put there, within the planes of the lines that cross: crossings and
adopted points; what was asked for by hand, and what another line drives, stays. It is a try: where
something stands against it (a gap, a crossing that comes, another feature that would be bent) it is
taken back, and `settle_features` dissolves the feature.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import measure_gaps
from assoc_hull.edit.crossings.adopted_points import rebase_adopted_points
from assoc_hull.edit.crossings.settle_crossings import latent_intersections
from assoc_hull.edit.followup.settle_features import (
    affected_features,
    followed_feature,
    set_by_hand,
)
from assoc_hull.edit.modification import Work
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.polylines.circular_arcs import circle_on_ends
from assoc_hull.model.feature_geometry import line_numbers, places_off, rounded_gap, rounding_of
from assoc_hull.model.features import Feature
from assoc_hull.model.generated_curves import attached_curves
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import round_at_size

__all__ = ["redraw_features", "redrawable_points"]

_TURN = 0.01
"""The tangents at the ends of an arc are those of before within this angle, rad."""

_STEEP = 0.1
"""A shape meets the plane of a line that crosses at this sine of an angle at least."""

_BACK = 0.1
"""No point is taken back by more than this part of the largest movement of the edit: what was bent
on purpose is not to be undone."""

_ROUNDS = 3
"""A feature that is drawn anew may bend one beside it, seldom more."""

_ON_THEIR_ENDS = frozenset({"straight", "arc", "circle"})
"""Kinds that are drawn anew from their ends."""

_TOLD = 3
"""So many features a note names."""


@attrs.frozen(eq=False)
class _Redrawn:
    """A feature as it is to be, and where its points (k,) go, (k, 3), m; `off`: the farthest, m."""

    key: str
    name: str
    new: Feature
    rows: IntArray
    goal: FloatArray
    off: float


@attrs.frozen(eq=False)
class _Edit:
    """The edit whose features are drawn anew.

    Attributes
    ----------
    work : Work
        The update, which has run.
    rows : (k,) int
        Points that were set.
    asked : collection of int
        Points whose places were asked for.
    sound : callable
        Tells whether nothing stands against the hull as it is now.
    before : dict of str to Feature
        The features before the edit.
    moved, origin : (m,) int, (m, 3), m
        Points that were written, ascending, and where they lay before.
    largest : float, m
        How far the edit has moved the one that it moved farthest.
    """

    work: Work
    rows: IntArray
    asked: Collection[int]
    sound: Callable[[], bool]
    before: Mapping[str, Feature]
    moved: IntArray
    origin: FloatArray
    largest: float

    def was(self, row: int) -> FloatArray:
        """Give where a point lay before the edit, (3,), m."""
        at = int(np.searchsorted(self.moved, row))
        if at < len(self.moved) and self.moved[at] == row:
            old: FloatArray = self.origin[at]
            return old
        place: FloatArray = self.work.state.rows.xyz[row]
        return place


def redraw_features(
    work: Work, rows: IntArray, asked: Collection[int], sound: Callable[[], bool]
) -> IntArray:
    """Draw features anew that an edit has bent by no more than the adoption tolerance.

    Parameters
    ----------
    work : Work
        The update, which has run and was found good.
    rows : (k,) int
        Points that were set.
    asked : collection of int
        Points whose places were asked for: these stay.
    sound : callable
        Tells whether nothing stands against the hull as it is now.

    Returns
    -------
    (k,) int
        Points that were put elsewhere, ascending.
    """
    state, pending = work.state, work.pending
    if pending.features is not None or not state.features:
        return rows[:0]
    before = {each.key: each for each in state.features}
    moved, origin = work.journal.before(state.rows.xyz)
    away = state.rows.xyz[moved] - origin
    largest = float(np.sqrt(dot(away, away)).max(initial=0.0))
    edit = _Edit(work, rows, asked, sound, before, moved, origin, largest)
    done = dict[str, _Redrawn]()
    found, held = _bent(edit)
    # all at once, else one by one: what stands against one does not stand against all
    for some in [found, *([each] for each in found if len(found) > 1)]:
        if some and not done.keys() >= {each.key for each in some}:
            more = _try(edit, some, held | done.keys())
            done |= {each.key: each for each in more}
    told = list(done.values())
    pending.notes += _notes(before, told)
    return np.unique(np.concatenate([rows[:0], *(each.rows for each in told)]))


def redrawable_points(state: HullState, curves: IntArray) -> IntArray:
    """Give the points that may be put elsewhere because some curves (k,) change, ascending.

    Those between the ends of a straight run, an arc or a circle on such a curve; in a flat, whose
    plane stays, only what moved is put back.
    """
    lines = {str(state.lines.key[state.line_of(curve)]) for curve in curves.tolist()}
    inner = {
        row
        for feature in state.features
        if feature.kind in _ON_THEIR_ENDS and not lines.isdisjoint(feature.lines)
        for row in feature.points[1:-1]
        if _is_free(state, row)
    }
    return np.array(sorted(inner), np.int64)


def _bent(edit: _Edit) -> tuple[list[_Redrawn], frozenset[str]]:
    """Give the features that can be drawn anew, and the keys of those that need not be."""
    work, state = edit.work, edit.work.state
    changed = np.concatenate([edit.rows, work.changed_points()])
    numbers, found, held = line_numbers(state), list[_Redrawn](), set[str]()
    affected, hand = affected_features(work, edit.rows, changed)
    for old in affected:
        new = followed_feature(state, old, numbers) if work.pending.structural else old
        if new is None or set_by_hand(state, old, hand) or set_by_hand(state, new, hand):
            continue
        off = float(places_off(new, state.rows.xyz[list(new.points)]).max())
        if off <= new.gap + rounding_of(state):
            held.add(old.key)
        elif (made := _redrawn(edit, new)) is not None:
            found.append(made)
    return found, frozenset(held)


def _try(edit: _Edit, some: Sequence[_Redrawn], held: Collection[str]) -> list[_Redrawn]:
    """Draw features anew, and those that this bends; give all of them.

    None, and all is taken back, where something stands against it.
    """
    work, drawn = edit.work, list[_Redrawn]()
    entries, passes = len(work.journal.entries), len(work.passes)
    failed, wide = dict(work.failed), work.wide
    wanted = {each.key for each in some} | set(held)
    try:
        for _ in range(_ROUNDS):
            if not some or not _put(work, some):
                break
            drawn += some
            bent, good = _bent(edit)
            if good >= wanted:
                if edit.sound():
                    return drawn
                break
            some = [each for each in bent if each.key in wanted]
    except AssocHullError:
        pass  # a curve that cannot be lofted so: as it was it can
    work.journal.undo(keep=entries)
    del work.passes[passes:]
    work.network.realigned, work.failed, work.wide = [], failed, wide
    return []


def _put(work: Work, some: Sequence[_Redrawn]) -> bool:
    """Put the points there, and let all follow; tell whether the net is the one it was."""
    state, journal = work.state, work.journal
    goals, near = dict[int, FloatArray](), rounding_of(state)
    for each in some:
        for row, goal in zip(each.rows.tolist(), each.goal, strict=True):
            if float(np.abs(goals.setdefault(row, goal) - goal).max()) > near:
                return False  # two features want one point at two places
    rows = np.array(sorted(goals), np.int64)
    journal.put(state.rows.xyz, rows, np.array([goals[row] for row in rows.tolist()]))
    adopted = rows[state.rows.sort[rows] == Sort.ADOPTED]
    work.pending.held |= set(adopted.tolist())
    try:
        work.go(rows, rows[:0])
    finally:
        work.pending.held.clear()
    if work.network.realigned or latent_intersections(state, work.touched()):
        return False
    rebase_adopted_points(state, adopted, journal)
    drawn = {each.key: each.new for each in some}
    Maker(state, journal).features([drawn.get(each.key, each) for each in state.features])
    work.wide = measure_gaps(state, work.touched(), journal, work.network.index)
    return not len(work.wide.rows)


# --------------------------------------------------------------------------------------
# Shapes.


def _redrawn(edit: _Edit, feature: Feature) -> _Redrawn | None:
    """Draw one feature anew; None where it cannot be, or only far from where its points are."""
    state = edit.work.state
    points = np.array(feature.points, np.int64)
    shape = _reshaped(edit, feature)
    if shape is None or _is_generated(state, points):
        return None
    xyz, limit = state.rows.xyz[points], state.tolerances.adoption
    away = places_off(shape, xyz)
    if float(away.max()) > limit:
        return None
    ends = set[int]() if feature.kind == "flat" else {feature.points[0], feature.points[-1]}
    rows, goals, stays = list[int](), list[FloatArray](), np.ones(len(points), np.bool_)
    for at, row in enumerate(feature.points):
        # the plane of a flat stays: of its points only those are put back that have moved
        stays_there = feature.kind == "flat" and not (xyz[at] != edit.was(row)).any()
        free = row not in ends and row not in edit.asked and _is_free(state, row)
        goal = _goal(state, shape, row, (xyz[0], xyz[-1])) if free and not stays_there else None
        if goal is None:
            continue
        stays[at] = False
        step, went = goal - xyz[at], xyz[at] - edit.was(row)
        back = -float((step * went).sum())
        if float((step * step).sum()) > limit * limit or back > _BACK * edit.largest * float(
            np.sqrt((went * went).sum())
        ):
            return None
        if (goal != xyz[at]).any():
            rows.append(row)
            goals.append(goal)
    # what cannot move lies on the shape as it did before
    left = float(away[stays].max(initial=0.0))
    if left > feature.gap + rounding_of(state) or not rows:
        return None
    new = attrs.evolve(shape, gap=rounded_gap(state, left))
    found = np.array(rows, np.int64), np.array(goals)
    return _Redrawn(feature.key, feature.name, new, *found, float(away.max()))


def _reshaped(edit: _Edit, feature: Feature) -> Feature | None:
    """Give the exact shape that a feature has on its moved ends."""
    if feature.kind in ("straight", "flat"):
        return feature
    old = edit.before.get(feature.key, feature)
    if feature.normal is None or old.centre is None:
        return None
    state, ends = edit.work.state, [feature.points[0], feature.points[-1]]
    found = circle_on_ends(
        np.array(old.centre), np.array(feature.normal), state.rows.xyz[ends],
        np.array([edit.was(row) for row in ends]), side=feature.side,
    )  # fmt: skip
    if found is None or found.turned > _TURN:
        return None
    # in whole nanometres: another machine's last bit must not show in it
    factor = state.tolerances.factor
    x, y, z = (round_at_size(each, 9, factor) for each in found.centre.tolist())
    y = 0.0 if feature.kind == "circle" else y
    return attrs.evolve(feature, centre=(x, y, z), radius=round_at_size(found.radius, 9, factor))


def _is_generated(state: HullState, points: IntArray) -> bool:
    """Tell whether definitions give one of the points: to move it would detach its curve."""
    known = attached_curves(state)
    return any(set(made.rows) & set(points.tolist()) for made in known.values())


def _is_free(state: HullState, row: int) -> bool:
    """Tell whether a point may be put elsewhere: no other line drives it, nobody placed it."""
    table = state.rows
    return bool(
        table.driver[row] < 0 and table.sort[row] != Sort.PLACED and not table.contact[row]
        and table.alive[row]
    )  # fmt: skip


def _goal(
    state: HullState, shape: Feature, row: int, ends: tuple[FloatArray, FloatArray]
) -> FloatArray | None:
    """Give where a point comes to lie on a shape, in the planes of its lines; None for nowhere."""
    place = state.rows.xyz[row]
    curves = [int(each) for each in state.rows.curve[row] if each >= 0]
    lines = [state.line_of(each) for each in curves]
    host = [line for line in lines if str(state.lines.key[line]) in shape.lines]
    others = [line for line in lines if line not in host]
    if any(not state.lines.planar[line] for line in others):
        return None
    normal = state.lines.normal[others[0]] if others else None
    level = float(state.lines.offset[others[0]]) if others else 0.0
    if shape.kind == "straight":
        found = _on_chord(place, ends, normal, level)
    elif shape.kind == "flat":
        found = _on_flat(place, shape, [state.lines.normal[line] for line in lines
                                        if state.lines.planar[line]])  # fmt: skip
    else:
        found = _on_circle(place, shape, normal, level)
    return None if found is None else _in_planes(state, lines, found)


def _in_planes(state: HullState, lines: Sequence[int], place: FloatArray) -> FloatArray:
    """Put a place into the planes of lines to the bit, as far as these are normal to an axis."""
    found = place.copy()
    for line in lines:
        if state.lines.planar[line]:
            found[state.lines.normal[line] == 1.0] = state.lines.offset[line]
    return found


def _on_chord(
    place: FloatArray, ends: tuple[FloatArray, FloatArray], normal: FloatArray | None, level: float
) -> FloatArray | None:
    start, chord = ends[0], ends[1] - ends[0]
    if normal is None:
        part = float(((place - start) * chord).sum() / (chord * chord).sum())
    else:
        rise = float((normal * chord).sum())
        if abs(rise) < _STEEP * float(np.sqrt((chord * chord).sum())):
            return None
        part = (level - float((normal * start).sum())) / rise
    found: FloatArray = start + part * chord
    return found if 0.0 < part < 1.0 else None


def _on_flat(place: FloatArray, shape: Feature, planes: Sequence[FloatArray]) -> FloatArray | None:
    """Go into the plane of a flat, along the planes of the lines."""
    normal, offset = np.array(shape.parameters["normal"]), float(shape.offset or 0.0)
    way = normal
    if len(planes) == 1:
        way = normal - float((normal * planes[0]).sum()) * planes[0]
    elif planes:
        way = np.cross(planes[0], planes[1])
    steep = float((way * normal).sum())
    if abs(steep) < _STEEP * float(np.sqrt((way * way).sum())) or not way.any():
        return None
    found: FloatArray = place + (offset - float((normal * place).sum())) / steep * way
    return found


def _on_circle(
    place: FloatArray, shape: Feature, normal: FloatArray | None, level: float
) -> FloatArray | None:
    """Go to the nearest place of a circle, or where it meets a plane near by."""
    centre, axis = (np.array(shape.parameters[name]) for name in ("centre", "normal"))
    radius = float(shape.radius or 0.0)
    away = place - centre
    away = away - float((away * axis).sum()) * axis
    if normal is None:
        found: FloatArray = centre + radius * away / np.sqrt((away * away).sum())
        return found
    along = np.cross(axis, normal)
    sine = float(np.sqrt((along * along).sum()))
    if sine < _STEEP:
        return None
    along /= sine
    across = np.cross(along, axis)
    height = (level - float((normal * centre).sum())) / float((normal * across).sum())
    half = radius * radius - height * height
    # near its outermost place the circle does not meet the plane, or slides along it
    if half < (_STEEP * radius) ** 2:
        return None
    sign = 1.0 if float((away * along).sum()) > 0.0 else -1.0
    met: FloatArray = centre + height * across + sign * np.sqrt(half) * along
    return met


# --------------------------------------------------------------------------------------
# What is told.


def _notes(before: Mapping[str, Feature], drawn: Sequence[_Redrawn]) -> Iterator[str]:
    """Say in one note which features were drawn anew, and in one each what radii they have."""
    if not drawn:
        return
    shown = ", ".join(repr(each.name) for each in drawn[:_TOLD])
    more = f" and {len(drawn) - _TOLD} more" if len(drawn) > _TOLD else ""
    most = 1e3 * max(each.off for each in drawn)
    yield f"features drawn anew, as their points lay up to {most:.3g} mm off them: {shown}{more}"
    for each in drawn:
        old = before[each.key].radius
        if each.new.radius is not None and old is not None and each.new.radius != old:
            yield f"the radius of {each.name!r} is {each.new.radius:.9g} m now, it was {old:.9g} m"

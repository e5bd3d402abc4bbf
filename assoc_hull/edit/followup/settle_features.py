"""Features: how they are found, and what becomes of them when an edit has run.

A feature is dissolved, with a note, where a point that it owns was set by hand on its line, where
it has lost an end, and where its points have been bent off it and `redraw_features` could not put
them back. All else follows: points that came between its ends are its own now, and it lies in the
plane of its line.

Features of a net: how they are found, and how one lies after its line has changed.

A curve is taken apart at its tangent points and knuckles; a piece is a straight run or an arc
where its points say so and its tangents agree. `find_features` looks at whole lines, when a net
is adopted or a line is cut; `followed_feature` gives a known feature the points that lie between
its ends now, or None where an end has gone.
"""

from __future__ import annotations

from collections.abc import (
    Collection,
    Iterator,
    Mapping,
    Sequence,
)
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.edit.modification import Work
from assoc_hull.edit.space_map import CarriedFeatures
from assoc_hull.geometry.curves import (
    EndKind,
    FloatArray,
    IntArray,
    PointKind,
)
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.polylines.circular_arcs import fit_circle_in_plane
from assoc_hull.geometry.polylines.flats import fit_plane
from assoc_hull.model.address import address
from assoc_hull.model.feature_geometry import (
    host_curve,
    line_numbers,
    places_off,
    rounded_gap,
    rounding_of,
)
from assoc_hull.model.features import FEATURE_LEAST, Feature
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import HullState

__all__ = [
    "Hand",
    "affected_features",
    "circle_side",
    "drawn_feature",
    "feature_in_plane",
    "find_features",
    "flat_side",
    "followed_feature",
    "loose_of",
    "set_by_hand",
    "settle_features",
]

# --------------------------------------------------------------------------------------
# Sides of features: left (1) or right (-1) of their points, seen against the plane's normal.


def circle_side(xyz: FloatArray, centre: FloatArray, normal: FloatArray) -> int:
    """Tell whether the centre lies left of an arc, 1, or right of it, -1.

    `xyz` (n, 3), m, are its points in order, `normal` is of unit length.
    """
    left = np.cross(normal, xyz[1] - xyz[0])
    return 1 if float((left * (centre - xyz[0])).sum()) > 0.0 else -1


def flat_side(state: HullState, edge: IntArray, normal: FloatArray, offset: float) -> int:
    """Tell on which side of its edge a flat lies, by the other points of the hull in its plane.

    `edge` (n,) are the points of the edge in order; the plane is normal . place = offset (m).
    Gives 0 where no point lies in the plane, or as many on either side.
    """
    rows = np.setdiff1d(state.live("rows"), edge)
    xyz = state.rows.xyz.data
    inside = rows[np.abs(dot(xyz[rows], normal) - offset) <= rounding_of(state)]
    along = np.diff(xyz[edge], axis=0)
    middle = xyz[edge[:-1]] + 0.5 * along
    away = xyz[inside][:, None] - middle
    nearest = np.argmin(dot(away, away), axis=1) if len(inside) else np.zeros(0, np.int64)
    left = np.cross(normal, along[nearest])
    sides = np.sign(dot(left, away[np.arange(len(inside)), nearest]))
    return int(np.sign(sides.sum()))


# --------------------------------------------------------------------------------------
# Finding features, where kinds of points say they are. A free end of a curve proves nothing, for
# any three points lie on some circle.

_LOOSE = 1e-3
"""Times `Tolerances.factor`: points of a straight run lie this near to it (m), those of an
arc within its line's tolerance."""

_ALONG = 0.01
"""The tangent at an end of a straight run is along it within this angle."""

_SHORTEST = 1e-3
"""A straight run has this part of the length of the ship at least."""

_LEAST, _TURN = 5, np.radians(10.0)
"""So many points, and this angle between its ends, an arc has at least."""

_CENTRE = 1e-9
"""Times the same: a point this near (m) to the centre plane lies in it."""


def loose_of(state: HullState) -> float:
    """Give how near (m) points of a straight run or a flat lie to it."""
    return _LOOSE * state.tolerances.factor


@attrs.frozen(eq=False)
class _Piece:
    """A part of a curve between two ends, tangent points or knuckles."""

    line: int
    rows: IntArray
    xyz: FloatArray
    tangents: tuple[FloatArray | None, FloatArray | None]
    """The given directions of its ends, None where there is none."""
    ending: tuple[bool, bool]
    """Whether it begins and ends with its curve."""
    held: tuple[bool, bool]
    """Whether the curve has a given direction as an end condition there."""


def find_features(
    state: HullState,
    tolerance: Sequence[float] | None = None,
    lines: Collection[str] | None = None,
) -> list[Feature]:
    """Find the features of a hull.

    Parameters
    ----------
    state : HullState
        The tables, lofted.
    tolerance : sequence of float or None, m
        By curve: how far the points of an arc between two tangent points may lie off it;
        1 mm if None.
    lines : collection of str or None
        Keys of the lines to look at; all if None.

    Returns
    -------
    list of Feature
        By key. Named after their lines; several of one line are numbered along it.
    """
    found: list[Feature] = []
    for line in state.live("lines").tolist():
        if lines is not None and state.lines.key[line] not in lines:
            continue
        whole = _whole_line(state, line)
        mine: list[Feature] = [] if whole is None else [whole]
        for curve in state.lines.curves[line]:
            allowed = loose_of(state) if tolerance is None else tolerance[curve]
            mine += _of_curve(state, line, int(curve), allowed)
        found += _told_apart(mine)
    return sorted(found, key=lambda each: each.key)


def _told_apart(found: Sequence[Feature]) -> list[Feature]:
    """Give the features of one line names and keys that no other of them has."""
    names, keys, out = set[str](), set[str](), list[Feature]()
    for each in found:
        name, key = _free(each.name, " ", names), _free(each.key, "~", keys)
        names.add(name)
        keys.add(key)
        out.append(attrs.evolve(each, name=name, key=key))
    return out


def _free(wish: str, mark: str, taken: set[str]) -> str:
    name, number = wish, 1
    while name in taken:
        number += 1
        name = f"{wish}{mark}{number}"
    return name


def _make(state: HullState, line: int, kind: str, rows: IntArray, **more: object) -> Feature:
    """Make a feature; its key is of the place of its first point, unless it is a whole line."""
    title, key = str(state.lines.name[line]), str(state.lines.key[line])
    if kind in ("flat", "knuckle"):
        name, key = title, f"{key} {kind}"
    else:
        x, y, z = (np.round(state.rows.xyz[rows[0]], 4) + 0.0).tolist()
        whole = kind == "circle" and state.lines.boundary[line] >= 0
        name = title if whole else f"{title} {kind}"
        key = f"{key} {kind} @ ({x:.4f}, {y:.4f}, {z:.4f})"
    made = Feature(key, kind, name, (state.lines.key[line],), rows.tolist(), **more)  # type: ignore[arg-type]
    # in whole nanometres: another machine's last bit must not show in it
    off = float(places_off(made, state.rows.xyz[rows]).max())
    return attrs.evolve(made, gap=rounded_gap(state, off))


def drawn_feature(
    state: HullState, curve: int, kind: str, rows: IntArray, **more: object
) -> Feature:
    """Make a feature of points of a curve that were drawn as one; name and key are free ones."""
    made = _make(state, state.line_of(curve), kind, rows, **more)
    others = [each for each in state.features if set(each.lines) & set(made.lines)]
    name = _free(made.name, " ", {each.name for each in others})
    return attrs.evolve(made, name=name, key=_free(made.key, "~", {each.key for each in others}))


def _whole_line(state: HullState, line: int) -> Feature | None:
    """Give the flat that a boundary curve borders, or the knuckle line that it is."""
    boundary = state.lines.boundary[line]
    parts = [state.curves.rows[curve] for curve in state.lines.curves[line]]
    rows: IntArray = np.concatenate([np.zeros(0, np.int64), *parts])
    if boundary == BoundaryKind.KNUCKLE and len(rows) >= FEATURE_LEAST["knuckle"]:
        return _make(state, line, "knuckle", rows)
    if boundary != BoundaryKind.FLAT or len(rows) < 3:
        return None
    normal, offset = state.lines.normal[line], float(state.lines.offset[line])
    if not state.lines.planar[line]:
        normal, offset, worst = fit_plane(state.rows.xyz[rows], loose_of(state))
        if worst > loose_of(state):
            return None
    side = flat_side(state, rows, normal, offset)
    return _make(state, line, "flat", rows, normal=normal.tolist(), offset=offset, side=side)


def _of_curve(state: HullState, line: int, curve: int, tolerance: float) -> Iterator[Feature]:
    """Find straight runs and arcs; tangent points that end none of them are joins."""
    joined = set[int]()
    for piece in _pieces(state, line, curve):
        found = _straight(state, piece) or _round(state, piece, tolerance)
        if found is not None:
            joined |= {found.points[0], found.points[-1]}
            yield found
    rows, side = state.curves.rows[curve], state.curves.side[curve]
    tangent = state.rows.kind[rows, side] == PointKind.TANGENT
    for row, at in zip(rows[tangent].tolist(), side[tangent].tolist(), strict=True):
        along = state.rows.direction[row, at]
        if row not in joined and along.any():
            unit = along / np.sqrt((along * along).sum())
            yield _make(state, line, "tangent", np.array([row]), direction=unit)


def _pieces(state: HullState, line: int, curve: int) -> Iterator[_Piece]:
    """Divide a curve at tangent points and knuckles; no pieces without tangent or held start."""
    rows, side = state.curves.rows[curve], state.curves.side[curve]
    kind = state.rows.kind[rows, side]
    if not (kind == PointKind.TANGENT).any() and not _held_tangent(state, curve, 0):
        return
    breaks = np.unique(np.concatenate([[0], np.flatnonzero(kind), [len(rows) - 1]])).tolist()
    for first, last in pairwise(breaks):
        mine = rows[first : last + 1]
        given = [
            state.rows.direction[rows[i], side[i]] if kind[i] == PointKind.TANGENT else None
            for i in (first, last)
        ]
        ending = first == 0, last == len(rows) - 1
        held = (
            ending[0] and _held_tangent(state, curve, 0),
            ending[1] and _held_tangent(state, curve, 1),
        )
        yield _Piece(line, mine, state.rows.xyz[mine], (given[0], given[1]), ending, held)


def _held_tangent(state: HullState, curve: int, end: int) -> bool:
    return bool(state.curves.ends[curve].kind[end] == EndKind.TANGENT)


def _straight(state: HullState, piece: _Piece) -> Feature | None:
    """Give a straight run between tangent points, or from one to an end of the curve."""
    known = [each for each in piece.tangents if each is not None]
    open_end = any(
        tangent is None and not ending
        for tangent, ending in zip(piece.tangents, piece.ending, strict=True)
    )
    chord = piece.xyz[-1] - piece.xyz[0]
    length = float(np.sqrt((chord * chord).sum()))
    if not known or open_end or length < _SHORTEST * state.particulars.length:
        return None
    for each in known:
        square = (each * each).sum() * length * length
        if (each * chord).sum() < np.cos(_ALONG) * np.sqrt(square):
            return None
    found = _make(state, piece.line, "straight", piece.rows)
    return found if found.gap <= loose_of(state) else None


def _round(state: HullState, piece: _Piece, tolerance: float) -> Feature | None:
    """Give an arc between tangent points, or a circle that its mirror image closes."""
    planar = state.lines.planar[piece.line]
    if not (planar and len(piece.xyz) >= _LEAST and all(_tangent(state, piece))):
        return None
    normal = state.lines.normal[piece.line]
    factor, least = state.tolerances.factor, rounding_of(state)
    found = fit_circle_in_plane(piece.xyz, normal, factor=factor)
    both = all(each is not None for each in piece.tangents)
    if found.turn < _TURN or found.off > (max(tolerance, least) if both else least):
        return None
    ends = np.abs(piece.xyz[[0, -1], 1]) <= factor * _CENTRE
    closed = bool(ends.all() and abs(found.centre[1]) <= least)
    if closed:
        found = fit_circle_in_plane(piece.xyz, normal, closed=True, factor=factor)
    return _make(
        state, piece.line, "circle" if closed else "arc", piece.rows, centre=found.centre,
        radius=found.radius, normal=normal, side=circle_side(piece.xyz, found.centre, normal),
    )  # fmt: skip


def _tangent(state: HullState, piece: _Piece) -> list[bool]:
    """Tell for both ends whether they are tangent: a tangent point, or an end held upright."""
    near = state.tolerances.factor * _CENTRE
    return [
        tangent is not None or (held and abs(float(place[1])) <= near)
        for tangent, held, place in zip(piece.tangents, piece.held, piece.xyz[[0, -1]], strict=True)
    ]


# --------------------------------------------------------------------------------------
# Features after their lines have changed.


def followed_feature(
    state: HullState,
    feature: Feature,
    numbers: Mapping[str, int],
    places: Mapping[int, FloatArray] | None = None,
) -> Feature | None:
    """Give a feature as it lies on its line now; None if its line, an end or too much has gone.

    `numbers` are the live lines by key; `places` (3,), m, by point, are where a mapping has sent
    points that may have gone, as in the tables if None.
    """
    lines = [numbers[key] for key in feature.lines if key in numbers]
    if len(lines) < len(feature.lines):
        return None
    if feature.kind in ("flat", "knuckle"):
        parts = [state.curves.rows[c] for line in lines for c in state.lines.curves[line]]
        rows: IntArray | None = np.concatenate([np.zeros(0, np.int64), *parts])
    else:
        rows = _between_ends(state, feature, lines, places or {})
    if rows is None or len(rows) < FEATURE_LEAST[feature.kind]:
        return None
    points = tuple(rows.tolist())
    as_now = feature if points == feature.points else attrs.evolve(feature, points=points)
    return feature_in_plane(state, as_now, lines[0])


def _between_ends(
    state: HullState, feature: Feature, lines: list[int], places: Mapping[int, FloatArray]
) -> IntArray | None:
    """Give the points of the line between the ends of a feature, the ends included."""
    for line in lines:
        for curve in state.lines.curves[line]:
            rows: IntArray = state.curves.rows[curve]
            first = _stands(state, rows, feature.points[0], places)
            last = _stands(state, rows, feature.points[-1], places)
            if 0 <= first <= last:
                return rows[first : last + 1]
    return None


def _stands(state: HullState, rows: IntArray, row: int, places: Mapping[int, FloatArray]) -> int:
    """Give the index among a curve's points of a point, or of what took its place; -1 if none."""
    at = np.flatnonzero(rows == row)
    if not len(at) and not state.rows.alive[row]:
        away = state.rows.xyz[rows] - places.get(row, state.rows.xyz[row])
        at = np.flatnonzero(dot(away, away) <= rounding_of(state) ** 2)
    return int(at[0]) if len(at) else -1


def feature_in_plane(state: HullState, feature: Feature, line: int) -> Feature | None:
    """Put a feature into the plane of its line; turn a join as its point is turned.

    None for a join whose point is no tangent point any more.
    """
    if feature.kind == "tangent":
        return _turned(state, feature)
    if feature.normal is None or not state.lines.planar[line]:
        return feature
    normal, offset = state.lines.normal[line], float(state.lines.offset[line])
    if feature.centre is None:
        return attrs.evolve(feature, normal=normal.tolist(), offset=offset)
    centre = np.array(feature.centre)
    beside = float((centre * normal).sum()) - offset
    if beside != 0.0:
        centre = centre - beside * normal
    return attrs.evolve(feature, normal=normal.tolist(), centre=centre.tolist())


def _turned(state: HullState, feature: Feature) -> Feature | None:
    """Give a join the direction of its point; None if that is no tangent point any more."""
    row, curve = feature.points[0], host_curve(state, feature)
    on = np.flatnonzero(state.rows.curve[row] == curve)
    if curve < 0 or state.rows.kind[row, on[0]] != PointKind.TANGENT:
        return None
    along = state.rows.direction[row, on[0]]
    return attrs.evolve(feature, direction=along / np.sqrt((along * along).sum()))


_TOLD = 3
"""So many features a note names."""

Hand = set[tuple[int, int]]
"""Points that were set by hand, each with a curve."""


@attrs.define(eq=False)
class _Settling:
    """Features while they are settled: those kept, by key, and what is told of the others.

    `lines` holds the numbers of the live lines by key.
    """

    kept: dict[str, Feature]
    lines: dict[str, int]
    notes: list[str] = attrs.field(factory=list)
    lost: list[str] = attrs.field(factory=list)
    bent: list[str] = attrs.field(factory=list)


def settle_features(work: Work, rows: IntArray, changed: IntArray) -> None:
    """Bring the features of a hull up to date with an edit, through its journal.

    Parameters
    ----------
    work : Work
        The update, which has run and was found good.
    rows : (k,) int
        Points that were set, and differ from before by a bit.
    changed : (k,) int
        All points that changed, these included.
    """
    state, pending = work.state, work.pending
    before = state.features if pending.features is None else pending.features.features
    fresh = _fresh_lines(work)
    whole = pending.structural or pending.alone
    affected, hand = affected_features(work, rows, changed)
    if not affected and not fresh:
        return
    found = _Settling({each.key: each for each in before}, line_numbers(state))
    for each in affected:
        _settle(work, found, each, hand, whole=whole)
    _find_anew(state, found, before, fresh)
    Maker(state, work.journal).features(found.kept.values())
    pending.notes += [
        *found.notes, *_told("they have lost an end", found.lost),
        *_told("their points are bent off them", found.bent),
    ]  # fmt: skip


def affected_features(
    work: Work, rows: IntArray, changed: IntArray
) -> tuple[Sequence[Feature], Hand]:
    """Give the features that an edit may have changed, and the points that were set by hand.

    `rows` and `changed` are as `settle_features` takes them.
    """
    pending = work.pending
    hand = pending.by_hand | _moved_by_hand(work, rows)
    every = work.state.features if pending.features is None else pending.features.features
    if pending.structural or pending.alone:
        return every, hand
    return [every[number] for number in _affected(work, changed)], hand


def _fresh_lines(work: Work) -> set[str]:
    """Give the keys of lines that were cut, or cut again, in this edit."""
    state = work.state
    curves = [curve for curve in work.pending.fresh if state.curves.alive[curve]]
    return {str(state.lines.key[state.line_of(curve)]) for curve in curves}


def _moved_by_hand(work: Work, rows: IntArray) -> Hand:
    """Give the points that the edit itself moved, each with both its curves."""
    if work.pending.alone:
        return set()
    moved = work.pending.values.keys() & set(rows.tolist())
    curve = work.state.rows.curve.data
    return {(row, int(each)) for row in moved for each in curve[row]}


def _affected(work: Work, changed: IntArray) -> list[int]:
    """Give the numbers of the features that own a point which changed."""
    point, owner = _owners(work.state)
    if not len(point):
        return []
    hand = np.array([row for row, _ in work.pending.by_hand], np.int64)
    every = np.concatenate([changed, hand])
    found: list[int] = np.unique(owner[np.isin(point, every)]).tolist()
    return found


def _owners(state: HullState) -> tuple[IntArray, IntArray]:
    """Give each owned point with the number of its feature; kept until the features change."""
    table = state.featured
    return state.derived(("owners",), (table.feature, table.alive), lambda: _find_owners(state))


def _find_owners(state: HullState) -> tuple[IntArray, IntArray]:
    points = [np.array(each.points, np.int64) for each in state.features]
    owner = np.repeat(np.arange(len(points)), [len(part) for part in points])
    return np.concatenate([np.zeros(0, np.int64), *points]), owner


def _settle(work: Work, found: _Settling, old: Feature, hand: Hand, *, whole: bool) -> None:
    """Keep a feature, as it has become, or dissolve it."""
    state = work.state
    carried = work.pending.features
    places = None if carried is None else carried.places
    new = followed_feature(state, old, found.lines, places) if whole else old
    touched = set_by_hand(state, old, hand) or (set_by_hand(state, new, hand) if new else "")
    if touched:
        found.notes.append(f"the feature {old.name!r} is dissolved: {touched} was set by hand")
    elif new is None:
        found.lost += [old.name] if set(old.lines) & found.lines.keys() else []
    else:
        stays = _held(state, new, carried)
        if stays is not None:
            found.kept[old.key] = stays
            return
        found.bent.append(old.name)
    del found.kept[old.key]


def _held(state: HullState, feature: Feature, carried: CarriedFeatures | None) -> Feature | None:
    """Give a feature, None if its points are off it; after a mapping its gap may be wider."""
    off = float(places_off(feature, state.rows.xyz[list(feature.points)]).max())
    if off <= feature.gap + rounding_of(state):
        return feature
    if carried is None:
        return None
    if np.isinf(carried.within):
        return feature
    stays = feature.key not in carried.bent and off <= carried.within
    return attrs.evolve(feature, gap=rounded_gap(state, off)) if stays else None


def set_by_hand(state: HullState, feature: Feature, hand: Hand) -> str:
    """Name a point of a feature that was set by hand on its line; empty if there is none."""
    for row, curve in sorted(hand):
        if curve < 0 or row not in feature.points:
            continue
        if state.lines.key[state.line_of(curve)] in feature.lines:
            return address(state, row) if state.rows.alive[row] else "a point of it"
    return ""


def _find_anew(
    state: HullState, found: _Settling, before: Sequence[Feature], fresh: set[str]
) -> None:
    """Find the features of lines that were cut; one of a name that was there keeps its key."""
    if not fresh:
        return
    known = {(each.lines, each.name): each for each in before if fresh.issuperset(each.lines)}
    old = {each.key for each in found.kept.values() if fresh.issuperset(each.lines)}
    found.kept = {key: each for key, each in found.kept.items() if key not in old}
    names = set[tuple[tuple[str, ...], str]]()
    for each in find_features(state, lines=fresh):
        new = _as_before(state, found.lines, known.get((each.lines, each.name)), each)
        found.kept[new.key] = new
        names.add((each.lines, each.name))
    told = {*found.lost, *found.bent}
    found.lost = [each for each in found.lost if each not in {name for _, name in names}]
    found.bent = [each for each in found.bent if each not in {name for _, name in names}]
    found.bent += [name for lines, name in known if (lines, name) not in names and name not in told]


def _as_before(
    state: HullState, lines: Mapping[str, int], old: Feature | None, new: Feature
) -> Feature:
    """Give a feature found anew the key it had, and the circle it had where that fits as well."""
    if old is None or old.kind != new.kind:
        return new
    again = feature_in_plane(state, attrs.evolve(old, points=new.points), lines[new.lines[0]])
    off = places_off(again, state.rows.xyz[list(new.points)]) if again else np.ones(1)
    if again is None or off.max() > loose_of(state):
        return attrs.evolve(new, key=old.key)
    return attrs.evolve(again, gap=rounded_gap(state, float(off.max())))


def _told(reason: str, names: Sequence[str]) -> list[str]:
    """Say in one note which features are dissolved."""
    if not names:
        return []
    shown = ", ".join(repr(name) for name in names[:_TOLD])
    more = f" and {len(names) - _TOLD} more" if len(names) > _TOLD else ""
    return [f"features dissolved, as {reason}: {shown}{more}"]

"""Features of a net: how they are found, and how one lies after its line has changed.

A curve is taken apart at its tangent points and knuckles; a piece is a straight run or an arc
where its points say so and its tangents agree. `find_features` looks at whole lines, when a net
is adopted or a line is cut; `followed_feature` gives a known feature the points that lie between
its ends now, or None where an end has gone.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.geometry.curves import EndKind, FloatArray, IntArray, PointKind
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.polylines.fitted_circle import fit_circle_in_plane
from assoc_hull.geometry.polylines.flats import fit_plane
from assoc_hull.model.feature_geometry import host_curve, places_off, rounded_gap, rounding_of
from assoc_hull.model.features import FEATURE_LEAST, Feature
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.tables import HullState

__all__ = [
    "circle_side",
    "drawn_feature",
    "feature_in_plane",
    "find_features",
    "flat_side",
    "followed_feature",
    "loose_of",
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
    if not (kind == PointKind.TANGENT).any() and not _held(state, curve, 0):
        return
    breaks = np.unique(np.concatenate([[0], np.flatnonzero(kind), [len(rows) - 1]])).tolist()
    for first, last in pairwise(breaks):
        mine = rows[first : last + 1]
        given = [
            state.rows.direction[rows[i], side[i]] if kind[i] == PointKind.TANGENT else None
            for i in (first, last)
        ]
        ending = first == 0, last == len(rows) - 1
        held = ending[0] and _held(state, curve, 0), ending[1] and _held(state, curve, 1)
        yield _Piece(line, mine, state.rows.xyz[mine], (given[0], given[1]), ending, held)


def _held(state: HullState, curve: int, end: int) -> bool:
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

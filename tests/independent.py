"""What the tests know of splines and links by themselves, without asking the kernel.

Roots come from `scipy.interpolate.PPoly`, closures from a plain walk of the role table.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import attrs
import numpy as np
from scipy.interpolate import PPoly

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState

__all__ = [
    "Root",
    "Snapshot",
    "closure",
    "curve_bits",
    "distance",
    "gap_between",
    "lost_meetings",
    "relofted",
    "roots",
    "snapshot",
    "trouble",
]

_SAME = 1e-6
"""Roots of one curve and plane closer than this (m) are one; so are a root and a crossing."""

_PLACE = 0.5
"""Two roots farther apart than this (m) are not the same place of a hull."""

_ROUNDED = 1e-12
"""So far (m) from an inclined plane the rounding of coordinates alone may leave a place."""


@attrs.frozen(eq=False)
class Root:
    """Where a curve meets a plane."""

    place: FloatArray
    tangent: FloatArray


@lru_cache(maxsize=1024)
def polynomial(spline: SplineBatch) -> PPoly:
    """Give a spline of the kernel, which nobody can change, as a piecewise polynomial of scipy."""
    h = np.diff(spline.knot)[:, None]
    p, q = spline.xyz[:-1], spline.xyz[1:]
    u, v = spline.leave[:-1], spline.arrive[1:]
    secant = (q - p) / h
    cubic, square = (u + v - 2.0 * secant) / h**2, (3.0 * secant - 2.0 * u - v) / h
    return PPoly(np.array([cubic, square, u, p]), spline.knot)


@lru_cache(maxsize=1024)
def _slope(spline: SplineBatch) -> PPoly:
    return polynomial(spline).derivative()


@lru_cache(maxsize=4096)
def _heights(
    spline: SplineBatch, normal: tuple[float, float, float]
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give a spline's height over a plane through the origin, and what each segment lies within."""
    around = _bezier(spline) @ np.array(normal)
    return polynomial(spline).c @ normal, around.min(axis=0) - _SAME, around.max(axis=0) + _SAME


def roots(spline: SplineBatch, normal: FloatArray, offset: float) -> tuple[Root, ...]:
    """Meet a spline with a plane; touching it without passing is no meeting."""
    return _roots(spline, tuple(normal.tolist()), offset)


@lru_cache(maxsize=16384)
def _roots(
    spline: SplineBatch, normal: tuple[float, float, float], offset: float
) -> tuple[Root, ...]:
    """Kept, as most splines of a hull are the very same after an edit.

    A segment whose Bezier points lie on one side of the plane is not looked at.
    """
    curve = polynomial(spline)
    height, low, high = _heights(spline, normal)
    near = np.flatnonzero((low <= offset) & (high >= offset)).tolist()
    if not near:
        return ()
    found = [spline.knot[spline.xyz @ normal == offset]]
    for i in near:
        segment = height[:, i : i + 1].copy()
        segment[3] -= offset
        part = PPoly.construct_fast(segment, curve.x[i : i + 2])
        found.append(part.roots(discontinuity=False, extrapolate=False))
    at = np.sort(np.concatenate(found))
    at = at[np.isfinite(at)]
    at = at[np.concatenate([[True], np.diff(at) > _SAME])] if len(at) else at
    if not len(at):
        return ()
    slope = _slope(spline)(at)
    length = np.sqrt((slope * slope).sum(axis=1))
    places = curve(at)
    return tuple(
        Root(place, part / size)
        for place, part, size in zip(places, slope, length, strict=True)
        if size
    )


def distance(spline: SplineBatch, place: FloatArray) -> float:
    """Measure how far a place lies from a spline.

    A segment lies in the box round its Bezier points: one whose box is farther than what is
    found already is left out.
    """
    curve = polynomial(spline)
    best = float(np.linalg.norm(spline.xyz - place, axis=1).min())
    low, high = _boxes(spline)
    apart = np.linalg.norm(np.maximum(np.maximum(low - place, place - high), 0.0), axis=1)
    for i in np.flatnonzero(apart <= best).tolist():
        width = float(curve.x[i + 1] - curve.x[i])
        parts = [np.poly1d(curve.c[:, i, axis] - [0, 0, 0, place[axis]]) for axis in range(3)]
        still = np.roots(sum((part * part.deriv() for part in parts), np.poly1d([0.0])))
        inside = still.real[(np.abs(still.imag) < 1e-6) & (still.real > 0.0) & (still.real < width)]
        for t in inside.tolist():
            best = min(best, float(np.linalg.norm([part(t) for part in parts])))
    return best


def _boxes(spline: SplineBatch) -> tuple[FloatArray, FloatArray]:
    """Give the lowest and highest corner of the box round each segment, (n - 1, 3) each, m."""
    around = _bezier(spline)
    return np.min(around, axis=0) - _SAME, np.max(around, axis=0) + _SAME


def _bezier(spline: SplineBatch) -> FloatArray:
    """Give the Bezier points of each segment, (4, n - 1, 3)."""
    third = np.diff(spline.knot)[:, None] / 3.0
    first, last = spline.xyz[:-1], spline.xyz[1:]
    return np.array(
        [first, first + third * spline.leave[:-1], last - third * spline.arrive[1:], last]
    )


def gap_between(one: Root, other: Root) -> float:
    """Measure how far two curves pass each other along the normal of the hull."""
    normal = np.cross(one.tangent, other.tangent)
    length = float(np.linalg.norm(normal))
    return abs(float((one.place - other.place) @ normal)) / length if length > 1e-12 else np.inf


def _plane(state: HullState, curve: int) -> tuple[FloatArray, float] | None:
    line = state.line_of(curve)
    if not state.lines.planar[line]:
        return None
    return state.lines.normal[line], float(state.lines.offset[line])


def _meet(state: HullState, curve: int, other: int) -> tuple[Root, ...]:
    """Meet a curve with the plane of another."""
    plane = _plane(state, other)
    return () if plane is None else roots(state.spline(curve), *plane)


def trouble(hull: ah.Hull, kept: bool = False) -> Iterator[str]:
    """Say where a hull is not consistent, each crossing from the splines alone.

    `kept` allows gaps over their limit, for hulls whose edits were told to keep these.
    """
    state, rows = hull.state, hull.state.rows
    for row in state.live("rows").tolist():
        if rows.sort[row] != Sort.CROSSING:
            continue
        curves = rows.curve[row].tolist()
        if rows.role[row] == Role.WATCHED:
            yield from _watched(state, row, curves, kept)
        else:
            yield from _on_curves(state, row, curves)


def _on_curves(state: HullState, row: int, curves: list[int]) -> Iterator[str]:
    place, key = state.rows.xyz[row], state.rows.key[row]
    for curve, other in (curves, curves[::-1]):
        plane = _plane(state, curve)
        exact = plane is not None and np.abs(plane[0]).max() == 1.0
        if plane and abs(float(place @ plane[0]) - plane[1]) > (0.0 if exact else _ROUNDED):
            yield f"{key} lies out of the plane of {state.curves.key[curve]}"
        near = [np.linalg.norm(each.place - place) for each in _meet(state, curve, other)]
        away = min(near, default=np.inf)
        if away > 1e-9:
            away = distance(state.spline(curve), place)
        if away > 1e-9:
            yield f"{key} lies {away:.2e} m off {state.curves.key[curve]}"


def _watched(state: HullState, row: int, curves: list[int], kept: bool) -> Iterator[str]:
    key, limit = state.rows.key[row], float(state.rows.limit[row])
    found: list[Root] = []
    for side, (curve, other) in enumerate((curves, curves[::-1])):
        spot = state.rows.spot[row, side]
        near = sorted(_meet(state, curve, other), key=lambda each: np.abs(each.place - spot).max())
        if not near or np.abs(near[0].place - spot).max() > 1e-8:
            yield f"{key} is not where {state.curves.key[curve]} meets the plane"
            return
        found.append(near[0])
    gap = gap_between(found[0], found[1])
    if abs(gap - float(state.rows.gap[row])) > 1e-8:
        yield f"{key} has a gap of {gap:.6f} m and says {state.rows.gap[row]:.6f}"
    if gap > limit + 1e-12 and not kept:
        yield f"{key} has a gap of {gap:.6f} m, its limit is {limit:.6f}"


def lost_meetings(hull: ah.Hull) -> Iterator[str]:
    """Intersect every pair of associated curves afresh; name meetings without a crossing."""
    state = hull.state
    taken = _taken(state)
    for one, other in _associated(state):
        free = [
            [
                root
                for root in _meet(state, curve, partner)
                if not _is_taken(root, taken, curve, partner)
            ]
            for curve, partner in ((one, other), (other, one))
        ]
        for first in free[0]:
            for second in free[1]:
                apart = float(np.linalg.norm(first.place - second.place))
                gap = gap_between(first, second)
                if apart <= _PLACE and gap <= 2.0 * state.tolerances.adoption:
                    names = f"{state.curves.key[one]} and {state.curves.key[other]}"
                    yield f"{names} meet at {first.place.round(4).tolist()}, gap {gap:.5f}"


def _associated(state: HullState) -> Iterator[tuple[int, int]]:
    """All pairs of curves of associated groups, but for boundary curves: these are contacts."""
    group = {curve: _group(state, curve) for curve in state.live("curves").tolist()}
    for link in state.associations:
        for one in group:
            for other in group:
                pair = (group[one], group[other])
                if pair == (link.a, link.b) and "boundary" not in pair:
                    yield one, other


def _group(state: HullState, curve: int) -> str:
    return str(state.groups.name[int(state.lines.group[state.line_of(curve)])])


def _taken(state: HullState) -> dict[tuple[int, int], list[FloatArray]]:
    """Where the live crossings lie, by curve and partner."""
    found: dict[tuple[int, int], list[FloatArray]] = {}
    rows = state.rows
    for row in state.live("rows").tolist():
        a, b = rows.curve[row].tolist()
        if b >= 0:
            watched = rows.role[row] == Role.WATCHED
            for side, pair in enumerate(((a, b), (b, a))):
                place = rows.spot[row, side] if watched else rows.xyz[row]
                found.setdefault(pair, []).append(place)
    return found


def _is_taken(
    root: Root, taken: dict[tuple[int, int], list[FloatArray]], curve: int, partner: int
) -> bool:
    places = taken.get((curve, partner), [])
    return any(float(np.abs(root.place - place).max()) < 10.0 * _SAME for place in places)


def curve_bits(state: HullState, curve: int) -> bytes:
    """Give all that a spline is made of, as bytes."""
    spline = state.spline(curve)
    return b"".join(
        part.tobytes() for part in (spline.knot, spline.xyz, spline.leave, spline.arrive)
    )


@attrs.frozen(eq=False)
class Snapshot:
    """A hull as it was: by key of the object, its bits, its recipe, and its revision."""

    curves: dict[str, bytes]
    points: dict[str, bytes]
    recipes: dict[str, tuple[object, ...]]
    curve_revisions: dict[str, int]
    point_revisions: dict[str, int]


def snapshot(hull: ah.Hull) -> Snapshot:
    """Note everything that locality and minimality are about."""
    state, rows = hull.state, hull.state.rows
    curves = {state.curves.key[i]: i for i in state.live("curves").tolist()}
    points = {rows.key[i]: i for i in state.live("rows").tolist() if _has_value(state, i)}
    return Snapshot(
        {key: curve_bits(state, i) for key, i in curves.items()},
        {key: rows.xyz[i].tobytes() for key, i in points.items()},
        {key: _recipe(state, i) for key, i in curves.items()},
        {key: state.revision_curve.get(i, 0) for key, i in curves.items()},
        {key: state.revision_row.get(i, 0) for key, i in points.items()},
    )


def _has_value(state: HullState, row: int) -> bool:
    crossing = state.rows.sort[row] == Sort.CROSSING
    return not (crossing and state.rows.role[row] == Role.WATCHED)


def _recipe(state: HullState, curve: int) -> tuple[object, ...]:
    """What a curve is made from, but for the places of its points."""
    rows, side = state.curves.rows[curve], state.curves.side[curve]
    table = state.rows
    return (
        tuple(table.key[row] for row in rows.tolist()),
        table.kind[rows, side].tobytes(),
        table.direction[rows, side].tobytes(),
        repr(state.curves.ends[curve]),
    )


def relofted(before: Snapshot, hull: ah.Hull) -> set[str]:
    """Say which curves had to be lofted again: those with an input that differs by a bit.

    Walked over the tables before and after; the update is not asked.
    """
    after, state = snapshot(hull), hull.state
    moved = {key for key, bits in after.points.items() if before.points.get(key) != bits}
    keys = state.rows.key.data
    return {
        key
        for curve in state.live("curves").tolist()
        if before.recipes.get(key := state.curves.key[curve]) != after.recipes[key]
        or any(keys[row] in moved for row in state.curves.rows[curve].tolist())
    }


def closure(hull: ah.Hull, points: set[str]) -> set[str]:
    """Give the curves that a change of points can reach, by a walk of the role table."""
    state, rows = hull.state, hull.state.rows
    live = state.live("rows").tolist()
    driven: dict[int, list[int]] = {}
    riding: dict[int, list[int]] = {}
    for row in live:
        driven.setdefault(_driver(state, row), []).append(row)
        for anchor in rows.anchor[row].tolist():
            riding.setdefault(anchor, []).append(row)
    front = [row for row in live if rows.key[row] in points]
    seen, curves = set[int](), set[int]()
    while front:
        row = front.pop()
        if row in seen:
            continue
        seen.add(row)
        front += riding.get(row, [])
        for curve in _defined_by(state, row) - curves:
            curves.add(curve)
            front += driven.get(curve, [])
    return {state.curves.key[curve] for curve in curves}


def _defined_by(state: HullState, row: int) -> set[int]:
    """Which curves a point defines, from its sort and role alone."""
    a, b = state.rows.curve[row].tolist()
    if state.rows.sort[row] != Sort.CROSSING:
        return {a}
    role = Role(int(state.rows.role[row]))
    return {Role.SHARED: {a, b}, Role.DRIVES_A: {a}, Role.DRIVES_B: {b}, Role.WATCHED: set()}[role]


def _driver(state: HullState, row: int) -> int:
    """Which curve a point is computed from, from its sort and role alone; -1 if from none."""
    a, b = state.rows.curve[row].tolist()
    if state.rows.sort[row] != Sort.CROSSING:
        return -1
    drivers: dict[Role, int] = {Role.DRIVES_A: b, Role.DRIVES_B: a}
    return drivers.get(Role(int(state.rows.role[row])), -1)

"""Findings on shape: what is wrong with curves and points as geometry.

Numbers that are not finite, folds, points too close to one another, points off their curves or
out of their planes; and crossings that a curve no longer passes in the sense it did.
`find_turned` serves the update, `find_sense` and `find_shape` the check of a whole hull.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeGuard

import attrs
import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.polylines.operations import crossing_segments
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.geometry.splines.distance import closest_points_each
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "TurnedCrossings",
    "bounded",
    "find_sense",
    "find_shape",
    "find_turned",
    "turned_crossings",
]


def find_shape(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give all findings on the shape of curves and the places of points.

    Examples
    --------
    >>> from assoc_hull.edit.checks.shape_findings import find_shape
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> list(find_shape(state, AddressBook(state)))
    []
    """
    yield from _unbounded_points(state, book)
    yield from _off_planes(state, book)
    lofted = list[int]()
    for curve in state.live("curves").tolist():
        yield from _close(state, book, curve)
        spline = state.curves.spline[curve]
        if not bounded(spline):
            yield _unbounded(state, book, curve)
            continue
        yield from _folds(book, curve, spline)
        lofted.append(curve)
    yield from _off_curves(state, book, lofted)
    yield from _loops(state, book, lofted)


def _unbounded_points(state: HullState, book: AddressBook) -> Iterator[Finding]:
    rows = state.live("rows")
    for row in rows[~np.isfinite(state.rows.xyz[rows]).all(axis=1)].tolist():
        yield row_finding(state, book, row, "not finite", "has no finite place: undo the edit")


def bounded(spline: SplineBatch | None) -> TypeGuard[SplineBatch]:
    """Tell whether a curve has a spline, and all its numbers are finite."""
    return spline is not None and all(
        np.isfinite(part).all() for part in (spline.xyz, spline.leave, spline.arrive)
    )


def _unbounded(state: HullState, book: AddressBook, curve: int) -> Finding:
    name = book.curve_name(curve)
    return Finding("not finite", name, None, None, "has no finite spline: undo the edit")


def _folds(book: AddressBook, curve: int, spline: SplineBatch) -> Iterator[Finding]:
    found = curve_folds(spline)
    for knot, cosine in zip(found.knot.tolist(), found.cosine.tolist(), strict=True):
        x, y, z = spline.xyz[knot].tolist()
        text = f"folds back on itself (cosine {cosine:.2f}): move the points beside it, or undo"
        yield Finding("fold", book.curve_name(curve), (x, y, z), cosine, text)


def _close(state: HullState, book: AddressBook, curve: int) -> Iterator[Finding]:
    """Neighbouring points of one curve, so near that their chord has no direction."""
    rows = state.curves.rows[curve]
    step = np.diff(state.rows.xyz[rows], axis=0)
    away = np.sqrt((step * step).sum(axis=1))
    for i in np.flatnonzero(away < state.tolerances.coincident).tolist():
        other = book.address(int(rows[i + 1]))
        text = (
            f"lies {away[i]:.3g} m from {other} on {book.curve_name(curve)}, closer than "
            f"{state.tolerances.coincident:g} m: delete one, or give one another role"
        )
        yield row_finding(state, book, int(rows[i]), "close", text, float(away[i]))


def _off_curves(state: HullState, book: AddressBook, curves: list[int]) -> Iterator[Finding]:
    """Points that should lie on a curve and do not."""
    if not curves:
        return
    number = np.full(state.curves.count, -1)
    number[curves] = np.arange(len(curves))
    rows, curve = _points_of(state, number)
    batch = SplineBatch.join([state.spline(each) for each in curves])
    away = closest_points_each(batch, number[curve], state.rows.xyz[rows])[2]
    for i in np.flatnonzero(away > state.tolerances.consistent).tolist():
        text = f"lies {away[i]:.3g} m off {book.curve_name(int(curve[i]))}: undo the edit"
        yield row_finding(state, book, int(rows[i]), "off curve", text, float(away[i]))


_CHORDS = 8
"""Chords that stand for a segment where a curve is looked at for crossings."""


def _loops(state: HullState, book: AddressBook, curves: list[int]) -> Iterator[Finding]:
    """Plane curves that cross themselves: the widest loop of each, with the place it closes at.

    Ends that touch, as of a closed curve, are no crossing, nor are loops less than a gap wide.
    """
    known = [curve for curve in curves if state.line_of(curve) >= 0]
    plane = [curve for curve in known if state.lines.planar[state.line_of(curve)]]
    if not plane:
        return
    begin, xyz = sample(SplineBatch.join([state.spline(each) for each in plane]), _CHORDS)
    owner = np.repeat(np.arange(len(plane)), np.diff(begin))
    lines = np.array([state.line_of(curve) for curve in plane])
    flat = _in_planes(xyz, state.lines.normal[lines][owner])
    # Curve beside curve, apart from one another: one sweep finds the crossings of all.
    flat -= np.minimum.reduceat(flat, begin[:-1])[owner]
    flat[:, 0] += (1.0 + float(flat.max(initial=0.0))) * owner
    first = np.flatnonzero(owner[:-1] == owner[1:])
    i, j, t = crossing_segments(flat[first], flat[first + 1])
    widest: dict[int, tuple[float, FloatArray]] = {}
    for a, b, part in zip(first[np.minimum(i, j)], first[np.maximum(i, j)],
                          np.where(i < j, t, -t), strict=True):  # fmt: skip
        k = int(a if part >= 0.0 else b)
        place = xyz[k] + abs(part) * (xyz[k + 1] - xyz[k])
        size = float(np.linalg.norm(xyz[a + 1 : b + 1] - place, axis=1).max())
        if size > max(state.tolerances.gap_floor, widest.get(int(owner[a]), (0.0,))[0]):
            widest[int(owner[a])] = size, place
    for number, (size, place) in sorted(widest.items()):
        x, y, z = place.tolist()
        text = f"crosses itself in a loop of {size:.3g} m: move the points of the loop, or undo"
        yield Finding("loop", book.curve_name(plane[number]), (x, y, z), size, text)


def _in_planes(xyz: FloatArray, normal: FloatArray) -> FloatArray:
    """Give places (n, 3) in the planes with their normals, (n, 2), m."""
    # The axis that the plane is most nearly along is its first direction.
    axis = np.eye(3)[np.abs(normal).argmin(axis=1)]
    one = np.cross(normal, axis)
    one /= np.linalg.norm(one, axis=1)[:, None]
    other = np.cross(normal, one)
    return np.stack([(xyz * one).sum(axis=1), (xyz * other).sum(axis=1)], axis=1)


def _points_of(state: HullState, number: IntArray) -> tuple[IntArray, IntArray]:
    """Give the points that should lie on curves that have a number, with their curves."""
    rows = state.live("rows")
    watched = (state.rows.sort[rows] == Sort.CROSSING) & (state.rows.role[rows] == Role.WATCHED)
    rows = rows[np.isfinite(state.rows.xyz[rows]).all(axis=1) & ~watched]
    curve = state.rows.curve[rows]
    known = (curve >= 0) & (curve < len(number))
    known[known] = number[curve[known]] >= 0
    known[:, 1] &= curve[:, 1] != curve[:, 0]
    order, side = np.nonzero(known)
    return rows[order], curve[order, side]


def _off_planes(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Points out of the plane of a curve they lie on: exact where it is a coordinate plane."""
    rows = state.live("rows")
    for side in (0, 1):
        mine = rows[state.rows.curve[rows, side] >= 0]
        lines = state.curves.line[state.rows.curve[mine, side]]
        mine, lines = mine[state.lines.planar[lines]], lines[state.lines.planar[lines]]
        normal = state.lines.normal[lines]
        terms = state.rows.xyz[mine] * normal
        off = np.abs(terms[:, 0] + terms[:, 1] + terms[:, 2] - state.lines.offset[lines])
        exact = (np.abs(normal) == 1.0).any(axis=1)
        wrong = off > np.where(exact, 0.0, state.tolerances.consistent)
        for i in np.flatnonzero(wrong).tolist():
            name = book.line_name(int(lines[i]))
            text = f"lies {off[i]:.3g} m out of the plane of {name}: undo the edit"
            yield row_finding(state, book, int(mine[i]), "off plane", text, float(off[i]))


# --------------------------------------------------------------------------------------
# Whether curves pass, at the crossings they are made through, in the sense they did. A crossing
# keeps its sign: the curve enters the half space of its partner there, or leaves it. Bent the other
# way there, the curve has its intersection of that sign elsewhere, or none: the crossing would
# stand for two places at once.


@attrs.frozen(eq=False)
class TurnedCrossings:
    """Crossings at which a curve made through them does not pass as it did.

    Attributes
    ----------
    row, curve : (k,) int
        The crossing, and the curve.
    apart : (k,), m
        How far from the crossing the curve passes in the old sense; inf if nowhere.
    """

    row: IntArray
    curve: IntArray
    apart: FloatArray


def turned_crossings(state: HullState, curves: IntArray) -> TurnedCrossings:
    """Find the crossings of curves that are not their intersections where they lie.

    An intersection has the sign its crossing was born with, so one that lies where the crossing
    does, within `Tolerances.coincident`, says that the sense is kept. Contacts are left out on
    the side of the line that ends, turns or leaves a flat there; on that of the boundary curve
    where it has no intersection, as it may run in the plane of the line.
    """
    if not len(curves):
        return TurnedCrossings(curves, curves, np.zeros(0))
    table, defining = state.rows, [state.curves.rows[curve] for curve in curves.tolist()]
    row, owner = np.concatenate(defining), np.repeat(curves, [len(each) for each in defining])
    part = _parts(state, row, owner)
    met, place = _met(state, curves)
    contact, hit = table.contact[row], _positions(met, part)
    needed = (table.sort[row] == Sort.CROSSING) & ~(contact & ((part & 1 == 1) | (hit < 0)))
    row, owner, hit = row[needed], owner[needed], hit[needed]
    apart, found = np.full(len(row), np.inf), hit >= 0
    apart[found] = np.abs(place[hit[found]] - table.xyz[row[found]]).max(axis=1, initial=0.0)
    wrong = apart > state.tolerances.coincident
    return TurnedCrossings(row[wrong], owner[wrong], apart[wrong])


def _positions(known: IntArray, wanted: IntArray) -> IntArray:
    """Give where each wanted number stands among the known ones; -1 where it does not."""
    if not len(known):
        return np.full(len(wanted), -1)
    order = np.argsort(known, kind="stable")
    place = np.minimum(np.searchsorted(known, wanted, sorter=order), len(known) - 1)
    found: IntArray = order[place]
    return np.where(known[found] == wanted, found, -1)


def _parts(state: HullState, row: IntArray, curve: IntArray) -> IntArray:
    """Give one number for point and curve: twice the point, plus the side of the curve."""
    found: IntArray = 2 * row + (state.rows.curve[row, 0] != curve)
    return found


def _met(state: HullState, curves: IntArray) -> tuple[IntArray, FloatArray]:
    """Give the crossings that curves have intersections at, as `_parts`, and their places, m."""
    meets: list[CurveIntersections] = [state.curves.meets[curve] for curve in curves.tolist()]
    row = np.concatenate([each.row for each in meets])
    owner = np.repeat(curves, [len(each.row) for each in meets])
    actual = row >= 0
    place = np.concatenate([each.xyz for each in meets])
    return _parts(state, row[actual], owner[actual]), place[actual]


def find_turned(state: HullState, curves: IntArray) -> tuple[str, ...]:
    """Say for the update where curves pass a plane in another sense than their crossing has."""
    found = turned_crossings(state, curves)
    if not len(found.row):
        return ()
    book = AddressBook(state)
    return tuple(
        f"{book.address(row)}: {_text(state, book, row, curve, apart)}: make the move smaller, "
        "or move the neighbouring points too"
        for row, curve, apart in _each(found)
    )


def find_sense(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give the findings on the sense of crossings of a whole hull."""
    live = state.live("curves")
    lofted = [state.curves.spline[curve] is not None for curve in live.tolist()]
    for row, curve, apart in _each(turned_crossings(state, live[lofted])):
        text = f"{_text(state, book, row, curve, apart)}: undo the edit, or move the points beside"
        yield row_finding(state, book, row, "sense", text, apart)


def _each(found: TurnedCrossings) -> Iterator[tuple[int, int, float]]:
    return zip(found.row.tolist(), found.curve.tolist(), found.apart.tolist(), strict=True)


def _text(state: HullState, book: AddressBook, row: int, curve: int, apart: float) -> str:
    """Say how a curve passes at a crossing, and where it passes as it did."""
    a, b = state.rows.curve[row].tolist()
    partner = state.line_of(b if curve == a else a)
    x, y, z = state.rows.xyz[row].tolist()
    sine = float((_slope(state, row, curve) * state.lines.normal[partner]).sum())
    angle = float(np.degrees(np.arcsin(np.clip(sine, -1.0, 1.0))))
    there = f"{apart:.3g} m away" if np.isfinite(apart) else "nowhere near"
    return (
        f"{book.curve_name(curve)} folds through the plane of {book.line_name(partner)} at "
        f"({x:.3f}, {y:.3f}, {z:.3f}) m, it makes {angle:.1f} degrees with it there and passes "
        f"in the sense of this crossing {there}"
    )


def _slope(state: HullState, row: int, curve: int) -> FloatArray:
    """Give the unit tangent of a curve where it goes on from a point, at its end as it comes."""
    spline: SplineBatch = state.spline(curve)
    place: FloatArray = state.rows.xyz[row]
    knot = int(np.argmin(np.abs(spline.xyz - place).max(axis=1)))
    slope: FloatArray = spline.arrive[knot] if knot == len(spline.knot) - 1 else spline.leave[knot]
    size = float(np.sqrt((slope * slope).sum()))
    unit: FloatArray = slope / (size or 1.0)
    return unit

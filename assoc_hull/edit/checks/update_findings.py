"""What must hold after an update before it is published: shape of curves, points, gaps.

Each function looks at the curves that the update has evaluated and gives findings as text; all
are collected before the edit is refused. Gaps of watched crossings are stored on the way.

Findings on shape: what is wrong with curves and points as geometry.

Numbers that are not finite, folds, points too close to one another, points off their curves or
out of their planes; and crossings that a curve no longer passes in the sense it did.
`find_turned` serves the update, `find_sense` and `find_shape` the check of a whole hull.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeGuard

import attrs
import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.polylines.operations import crossing_segments
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.geometry.splines.distance import closest_points_each
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.graph.derived import Objects
from assoc_hull.graph.journal import Journal, distinct
from assoc_hull.model.address import AddressBook, address
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.index import Index
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.network import Alignment
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "MOVE_ADVICE",
    "TurnedCrossings",
    "WideGaps",
    "bounded",
    "curve_title",
    "ends_at_risk",
    "find_beyond",
    "find_endless",
    "find_folds",
    "find_sense",
    "find_shape",
    "find_turned",
    "find_unbounded",
    "find_unmet",
    "measure_gaps",
    "note_new_ends",
    "plane_normals",
    "splines_of",
    "turned_crossings",
]

_CENTRE = 1e-6
"""Times `Tolerances.factor`: how far (m) a point may lie beyond the centre plane by rounding."""


@attrs.frozen(eq=False)
class WideGaps:
    """Watched crossings whose gap exceeds their limit.

    Attributes
    ----------
    rows : (k,) int
        The crossings.
    gap, limit : (k,), m
        Gap and limit of each.
    largest : float, m
        The largest gap of all that were measured, wide or not.
    mend : (n,) int
        What to mend if any are wide: these, and the crossings on the same giving curves
        whose gap is over half its limit, as a point in one place moves its neighbours. The
        widest first, ties by key.
    """

    rows: IntArray
    gap: FloatArray
    limit: FloatArray
    largest: float
    mend: IntArray


MOVE_ADVICE = ": make the move smaller"
"""Where the advice begins that fits who moves points, and nobody else."""


def splines_of(state: HullState, curves: IntArray) -> SplineBatch | None:
    """Give the splines of curves as one batch, for the findings below; None of no curves."""
    if not len(curves):
        return None
    spline = state.curves.spline.data
    return SplineBatch.join([spline[curve] for curve in curves.tolist()])


def find_folds(
    state: HullState,
    curves: IntArray,
    batch: SplineBatch | None,
    before: dict[int, SplineBatch],
) -> tuple[str, ...]:
    """Say where curves turn back on themselves and did not before the edit."""
    if batch is None:
        return ()
    found = curve_folds(batch)
    if not len(found.curve):
        return ()
    findings: list[str] = []
    for local in np.unique(found.curve).tolist():
        curve = int(curves[local])
        mine = found.curve == local
        old = before.get(curve)
        # a hull that was taken in with folds may be edited, but gets no more of them
        if old is not None and len(curve_folds(old).curve) >= int(mine.sum()):
            continue
        x, y, z = batch.xyz[batch.start[local] + found.knot[mine][0]].tolist()
        findings.append(
            f"{curve_title(state, curve)} folds back on itself at ({x:.3f}, {y:.3f}, {z:.3f}) m "
            f"(cosine {float(found.cosine[mine].min()):.2f}){MOVE_ADVICE} or move the "
            "neighbouring points too"
        )
    return tuple(findings)


def curve_title(state: HullState, curve: int) -> str:
    """Name a curve by its line, with its number where the line has several."""
    line = state.line_of(curve)
    pieces = state.lines.curves[line]
    name = str(state.lines.name[line])
    return name if len(pieces) < 2 else f"{name} [{pieces.index(curve) + 1}]"


def find_unbounded(
    state: HullState, curves: IntArray, batch: SplineBatch | None
) -> tuple[str, ...]:
    """Say which curves hold numbers that are not finite."""
    if batch is None or np.isfinite(batch.leave).all():
        return ()
    return tuple(
        f"{curve_title(state, curve)} has a derivative that is not finite"
        for curve in curves.tolist()
        if not np.isfinite(state.spline(curve).leave).all()
    )


def find_beyond(
    state: HullState,
    curves: IntArray,
    batch: SplineBatch | None,
    before: dict[int, SplineBatch],
) -> tuple[str, ...]:
    """Say which curves have points beyond the centre plane, farther than they had before the edit.

    Only y >= 0 is stored; but a hull that was taken in with such points may be edited.
    """
    if batch is None:
        return ()
    least = state.tolerances.factor * _CENTRE
    lowest = np.minimum.reduceat(batch.xyz[:, 1], batch.start[:-1])
    beyond = [
        local
        for local in np.flatnonzero(lowest < -least).tolist()
        if (old := before.get(int(curves[local]))) is None
        or lowest[local] < float(old.xyz[:, 1].min()) - least
    ]
    return tuple(
        f"{curve_title(state, curve)} passes the centre plane by {-low:.3g} m: "
        "make the move smaller"
        for curve, low in zip(curves[beyond].tolist(), lowest[beyond].tolist(), strict=True)
    )


def _held_at_contact(state: HullState, rows: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell which contacts a boundary curve is made through: it may run in the line's plane there.

    Such a contact needs no intersection on the boundary curve.
    """
    made = state.rows.reader[rows, 0] == state.rows.curve[rows, 0]
    return np.asarray(state.rows.contact[rows] & made)


def find_unmet(state: HullState, curves: IntArray) -> tuple[str, ...]:
    """Say which crossings of curves have no meeting on a curve that they need one on."""
    table = state.rows
    rows = np.flatnonzero(table.alive.data & np.isin(table.curve.data, curves).any(axis=1))
    rows = rows[table.sort[rows] == Sort.CROSSING]
    findings: list[str] = []
    for side in (0, 1):
        owner = table.curve.data[rows, side]
        held = table.contact.data[rows] if side else _held_at_contact(state, rows)
        lacks = ~held
        lacks[lacks] = ~_is_met(state, rows[lacks], owner[lacks])
        findings += [
            f"{address(state, row)} is not reached by {curve_title(state, curve)}: "
            "choose another place for the line"
            for row, curve in zip(rows[lacks].tolist(), owner[lacks].tolist(), strict=True)
        ]
    return tuple(findings)


def _is_met(state: HullState, rows: IntArray, on: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell which crossings (k,) are meetings of the curves (k,)."""
    curves = distinct(on)
    met = [state.curves.meets.data[curve].row for curve in curves.tolist()]
    owner = np.repeat(curves, np.array([len(each) for each in met], np.int64))
    row = np.concatenate([rows[:0], *met])
    known = (owner * state.rows.count + row)[row >= 0]  # a latent meeting (-1) is no crossing
    return np.isin(on * state.rows.count + rows, known)


def measure_gaps(
    state: HullState,
    curves: IntArray,
    journal: Journal,
    index: Index | None = None,
) -> WideGaps:
    """Measure the watched gaps of curves, store them, and give those over their limit.

    `index` may say which crossings are watched and in which segments they lie.
    """
    rows = watched_on(state, curves) if index is None else _watched(state, curves)
    if not len(rows):
        return WideGaps(rows, np.zeros(0), np.zeros(0), 0.0, rows)
    known = index.guess if index is not None and len(index.guess) == state.rows.count else None
    gap = gap_at(state, rows, known)
    journal.put(state.rows.gap, rows, gap)
    # a watched crossing is published where it lies on curve a
    journal.put(state.rows.xyz, rows, state.rows.spot[rows, 0])
    limit = state.rows.limit.take(rows)
    wide = gap > limit
    mend = _to_mend(state, rows, gap / limit) if wide.any() else rows[:0]
    return WideGaps(rows[wide], gap[wide], limit[wide], float(gap.max()), mend)


def _watched(state: HullState, curves: IntArray) -> IntArray:
    """Give the watched crossings of curves: the same as before while these meet the same."""
    met, table = state.curves.meets.data, state.rows
    rows = Objects([met[curve].row for curve in curves.tolist()])
    depends_on = rows, table.role, table.sort, table.alive
    return state.derived(
        ("watched", curves.tobytes()), depends_on, lambda: watched_on(state, curves)
    )


def _to_mend(state: HullState, rows: IntArray, part: FloatArray) -> IntArray:
    """Give `WideGaps.mend` from the gaps in parts of their limits, (n,)."""
    giving = state.rows.curve[rows, 1]
    chosen = (part > 0.5) & np.isin(giving, giving[part > 1.0])
    keys = state.rows.key.data
    order = sorted(np.flatnonzero(chosen).tolist(), key=lambda i: (-part[i], keys[rows[i]]))
    found: IntArray = rows[np.array(order, np.int64)]
    return found


def plane_normals(state: HullState, curves: IntArray) -> FloatArray:
    """Give the unit normals of the planes of curves, (m, 3); nan for space curves."""
    lines = state.curves.line[curves]
    normal: FloatArray = np.where(
        state.lines.planar[lines][:, None], state.lines.normal[lines], np.nan
    )
    return normal


# --------------------------------------------------------------------------------------
# Boundary curves that come to meet the plane of a line more or fewer times than before. A line has
# a piece between every two intersections of its plane with the boundary curves that it ends on.
# An edit of such a curve makes and unmakes no pieces: a new pair of intersections stays latent and
# is noted; an edit by which a piece would lose its end is refused.


def _bounding(state: HullState, alignments: Sequence[Alignment]) -> list[Alignment]:
    """Select the alignments of boundary curves on which lines end."""
    kind = state.lines.boundary.data
    return [each for each in alignments if kind[state.line_of(each.curve)] == BoundaryKind.END]


def ends_at_risk(state: HullState, alignments: Sequence[Alignment]) -> list[tuple[int, int]]:
    """Give the contacts that have no meeting on their boundary curve, with the curves they end."""
    return [
        (row, int(state.rows.curve.data[row, 1]))
        for each in _bounding(state, alignments)
        for row in each.gone.tolist()
        if state.rows.alive.data[row] and state.rows.contact.data[row]
    ]


def find_endless(state: HullState, ends: Sequence[tuple[int, int]]) -> tuple[str, ...]:
    """Say which curves have lost one of the given ends."""
    lost = sorted({curve for row, curve in ends if not state.rows.alive.data[row]})
    return tuple(
        f"{curve_title(state, curve)} has no end any more on the boundary curve that moved away: "
        "make the move smaller, or shift or remove the line first"
        for curve in lost
        if state.curves.alive.data[curve]
    )


def note_new_ends(state: HullState, alignments: Sequence[Alignment]) -> list[str]:
    """Note where boundary curves have come to meet planes of lines that have no piece there."""
    notes: list[str] = []
    for each in _bounding(state, alignments):
        meets: CurveIntersections = state.curves.meets.data[each.curve]
        fresh = each.come[each.come < len(meets.row)]
        for spot in fresh[meets.row[fresh] < 0].tolist():
            x, y, z = np.asarray(meets.xyz[spot]).tolist()
            notes.append(
                f"{curve_title(state, each.curve)} has come to meet the plane of "
                f"{state.lines.name.data[int(meets.line[spot])]} at ({x:.3f}, {y:.3f}, {z:.3f}) m, "
                "where that has no piece: shift it, or remove and add it, to cut it anew"
            )
    return notes


def find_shape(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give all findings on the shape of curves and the places of points.

    Examples
    --------
    >>> from assoc_hull.edit.checks.update_findings import find_shape
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

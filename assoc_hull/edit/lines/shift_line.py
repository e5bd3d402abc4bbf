"""Shift a line to another position of its plane: the shape of the hull does not change.

The line is cut anew from the hull as it is. Its crossings keep their identity as long as they can
be followed along the other curves while the plane moves; what they held at the old place stays
behind there as adopted points. A piece keeps the curve that most of its crossings were on (ties:
the first in the line); pieces without one are born, curves without one die.
"""

from __future__ import annotations

from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import NO_ROOT, insert_defining_point
from assoc_hull.edit.crossings.settle_crossings import make_latent
from assoc_hull.edit.lines.add_line import make_piece, ordered_pieces
from assoc_hull.edit.lines.kept_runs import (
    NO_KEPT_RUNS,
    KeptRuns,
    assign_runs,
    compute_kept_crossings,
    release_points,
    restore_roles,
)
from assoc_hull.edit.lines.line_planes import shifted_plane
from assoc_hull.edit.lines.marks import Marks, distinct_marks, find_marks
from assoc_hull.edit.lines.plane_intersections import enter_line_plane, remove_line_plane
from assoc_hull.edit.lines.remove_line import replace_crossings
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_heights import heights_over_plane, nodes_of
from assoc_hull.geometry.splines.plane_intersections import PlaneIntersections, intersect_planes
from assoc_hull.geometry.splines.segments import segment_start
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.network import align_plane_roots
from assoc_hull.model.tables import CurveIntersections, Ends, HullState

__all__ = [
    "crossings_and_placed",
    "gather_crossings",
    "match_pieces",
    "recut_line",
    "shift_line",
    "track_intersections",
    "track_intersections_of_each",
]

# --------------------------------------------------------------------------------------
# Which intersection is which while a plane moves along its normal, however far. The curve keeps its
# shape, so an intersection slides along a stretch on which the height over the plane rises or
# falls; where the height turns, a pair is born or dies. Ordinals along the curve were measured to
# be wrong at every birth and death, and steps of whatever length leap over a death and a birth.

_LEAST_TURN = 1e-3
"""The height turns only where it goes back by more than this (m): a pair of intersections whose
excursion is less is none, as no line is known more closely."""


def track_intersections(
    spline: SplineBatch, normal: FloatArray, start: float, stop: float
) -> dict[int, int]:
    """Follow the intersections of one curve with a plane that is shifted along its unit normal.

    Gives, for an intersection at the offset `start` (m), counted along the curve, the one at
    `stop` that it becomes; one that has gone on the way is missing.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.lines.shift_line import track_intersections
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> hill = np.array([[0.0, 0, 0], [1, 0, 2], [2, 0, 1], [3, 0, 3]])
    >>> curve = loft(CurveData.single(hill))
    >>> track_intersections(curve, np.array([0.0, 0, 1]), 1.5, 2.6)
    {2: 0}
    """
    return track_intersections_of_each(spline, normal, start, stop)[0]


def track_intersections_of_each(
    batch: SplineBatch, normal: FloatArray, start: float, stop: float
) -> list[dict[int, int]]:
    """Follow the intersections of many curves: `track_intersections` for each."""
    before, after = (intersect_planes(batch, normal, np.array([at])) for at in (start, stop))
    found: list[dict[int, int]] = []
    for curve, turns in enumerate(_turns(batch, normal)):
        mine = [np.flatnonzero(met.curve == curve) for met in (before, after)]
        here, there = (
            np.searchsorted(turns, before.t[mine[0]]),
            np.searchsorted(turns, after.t[mine[1]]),
        )
        path: dict[int, int] = {}
        for stretch in np.intersect1d(here, there).tolist():
            first, second = mine[0][here == stretch], mine[1][there == stretch]
            path |= _paired(before, first, after, second)
        found.append({one - int(mine[0][0]): two - int(mine[1][0]) for one, two in path.items()})
    return found


def _paired(
    before: PlaneIntersections, first: IntArray, after: PlaneIntersections, second: IntArray
) -> dict[int, int]:
    """Pair the intersections on one stretch: one each, except where the height hardly goes back."""
    pairs = align_plane_roots(
        before.sign[first], before.xyz[first], after.sign[second], after.xyz[second]
    )
    return {int(first[i]): int(second[j]) for i, j in pairs}


def _turns(batch: SplineBatch, normal: FloatArray) -> list[FloatArray]:
    """Give the parameters at which the height of each curve turns, ascending, m."""
    segments = segment_start(batch)
    fraction, height = nodes_of(heights_over_plane(batch, normal), segments)
    begin, end = batch.knot[segments], batch.knot[segments + 1]
    at = (begin + (end - begin) * fraction).T
    found: list[FloatArray] = []
    for first, last in pairwise(np.searchsorted(segments, batch.start).tolist()):
        kept = _extremes(height.T[first:last].ravel().tolist())
        found.append(at[first:last].ravel()[np.array(kept[1:-1], np.int64)])
    return found


def _extremes(height: list[float]) -> list[int]:
    """Give the first index, those where the height (m) turns for good, and the last."""
    kept, sense = [0], 0
    best = 0
    for i in range(1, len(height)):
        step = height[i] - height[best]
        if sense == 0:
            if abs(step) > _LEAST_TURN:
                sense, best = (1 if step > 0.0 else -1), i
        elif step * sense >= 0.0:
            best = i
        elif abs(step) > _LEAST_TURN:
            kept.append(best)
            sense, best = -sense, i
    return [*kept, len(height) - 1]


# --------------------------------------------------------------------------------------
# Which curve is which piece, when a line comes to have more or fewer of them.


def match_pieces(
    edit: Transaction, line: int, pieces: list[Marks], known: dict[tuple[int, int], int]
) -> list[tuple[int, Marks]]:
    """Give each piece of a line its curve, in the order of the pieces; make and unmake curves.

    `known` are crossings that are there already, by the other curve and the mark's `root`; they
    go over to the curve of their piece.
    """
    state = edit.state
    old = [int(curve) for curve in state.lines.curves[line]]
    rows = [_rows_of(piece, known) for piece in pieces]
    kept = _keep(state, old, rows)
    for curve in old:
        if curve not in kept.values():
            _end(edit, curve)
    found: list[tuple[int, Marks]] = []
    for i, piece in enumerate(pieces):
        curve = kept.get(i, -1)
        if curve < 0:
            curve = edit.maker.curve(line, Ends())
            edit.pending.born.append(state.curves.key[curve])
        _take_over(edit, curve, piece, known)
        found.append((curve, piece))
    edit.journal.set(state.lines.curves, [line], [tuple(curve for curve, _ in found)])
    return found


def _rows_of(piece: Marks, known: dict[tuple[int, int], int]) -> list[int]:
    marks = zip(piece.curve.tolist(), piece.root.tolist(), strict=True)
    return [known[mark] for mark in marks if mark in known]


def _keep(state: HullState, old: list[int], rows: list[list[int]]) -> dict[int, int]:
    """Pair pieces with curves by the number of crossings they share, the most first."""
    shared = [
        (
            -int(np.isin(state.rows.curve[np.array(part, np.int64)], curve).any(axis=1).sum()),
            j,
            i,
        )
        for i, part in enumerate(rows)
        for j, curve in enumerate(old)
        if part
    ]
    kept: dict[int, int] = {}
    for count, j, i in sorted(shared):
        if count < 0 and i not in kept and old[j] not in kept.values():
            kept[i] = old[j]
    return kept


def _end(edit: Transaction, curve: int) -> None:
    """Unmake a curve that has no piece any more."""
    edit.journal.put(edit.state.curves.alive, [curve], False)
    edit.pending.curves.discard(curve)
    edit.pending.gone.append(edit.state.curves.key[curve])


def _take_over(
    edit: Transaction, curve: int, piece: Marks, known: dict[tuple[int, int], int]
) -> None:
    """Let the crossings of a piece be on its curve, and look for them at their new place."""
    state = edit.state
    line = state.line_of(curve)
    marks = zip(piece.curve.tolist(), piece.root.tolist(), piece.xyz, strict=True)
    for other, root, place in marks:
        row = known.get((other, root))
        if row is None:
            continue
        pair = state.rows.curve[row].tolist()
        side = int(state.line_of(pair[1]) == line)
        pair[side] = curve
        edit.journal.put(state.rows.curve, [row], [pair])
        edit.journal.put(state.rows.spot, [row], [(place, place)])


def gather_crossings(
    edit: Transaction, line: int, pieces: list[tuple[int, Marks]], known: dict[tuple[int, int], int]
) -> None:
    """Let followed crossings that mark no piece go over to the nearest piece.

    These are the crossings with lines of higher rank, from which the line is not cut. `known` are
    crossings by the other curve and its intersection with the plane; their spots are there already.
    """
    state = edit.state
    marked = {
        mark
        for _, piece in pieces
        for mark in zip(piece.curve.tolist(), piece.root.tolist(), strict=True)
    }
    rows = [row for mark, row in sorted(known.items()) if mark not in marked]
    if not rows or not pieces:
        return
    shapes = SplineBatch.join([loft(CurveData.single(piece.xyz)) for _, piece in pieces])
    spots = state.rows.spot[rows, 0]
    away = np.array([closest_points(shapes, i, spots)[2] for i in range(len(pieces))])
    for row, nearest in zip(rows, away.argmin(axis=0).tolist(), strict=True):
        pair = state.rows.curve[row].tolist()
        pair[int(state.line_of(pair[1]) == line)] = pieces[nearest][0]
        edit.journal.put(state.rows.curve, [row], [pair])


# --------------------------------------------------------------------------------------
# The shift itself.


def shift_line(edit: Transaction, line: int, position: float) -> None:
    """Shift a line of a plane family to a position along the family's axis, m.

    The position of a diagonal, which keeps its angle, is the height at the centre plane. Placed
    points go along to the new plane.

    Raises
    ------
    BadInputError
        No parallel plane, a number that is not finite, or a plane that is taken.
    NoMeetingError
        The new plane meets fewer than two places.
    """
    state = edit.state
    cut = shifted_plane(state, line, position)
    position = cut.offset
    if position == float(state.lines.offset[line]):
        return
    marks = find_marks(state, cut.group, cut.normal, position)
    mine = np.array(state.lines.curves[line], np.int64)
    crossings, placed = crossings_and_placed(state, mine)
    known = _followed(state, line, crossings, position)
    edit.refuse_moved(placed)
    edit.pending.structural = True
    replace_crossings(edit, crossings, mine)
    remove_line_plane(edit, line)
    edit.journal.put(state.lines.offset, [line], [position])
    recut_line(edit, line, marks, known)


def recut_line(
    edit: Transaction,
    line: int,
    marks: Marks,
    known: dict[tuple[int, int], int],
    stays: KeptRuns = NO_KEPT_RUNS,
) -> None:
    """Cut a line again where its plane now meets the hull; nothing else may read it.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        The line; its plane stands in the tables, and no intersection of other curves names it.
    marks : Marks
        Where its plane meets the lines it is cut from.
    known : dict of (int, int) to int
        Crossings that keep their identity, by the other curve and the intersection, counted
        along it.
    stays : KeptRuns
        Runs of the line that stay as they are.
    """
    state = edit.state
    mine = np.array(state.lines.curves[line], np.int64)
    every, placed = crossings_and_placed(state, mine)
    parts = ordered_pieces(edit, line, marks)
    left = stays.on(state, [distinct_marks(state, part) for part in parts])
    edit.pending.curves |= release_points(edit.maker, stays, left)
    crossings, placed = (np.setdiff1d(rows, left.rows()) for rows in (every, placed))
    edit.maker.roles(crossings, np.full(len(crossings), int(Role.WATCHED)))
    _drop_adopted(edit, mine, left.rows())
    pieces = match_pieces(edit, line, parts, known)
    assign_runs(edit.maker, left, pieces)
    for curve, piece in pieces:
        make_piece(
            edit, line, distinct_marks(state, piece), state.tolerances.keep, curve, known, left
        )
    restore_roles(edit.maker, left)
    kept = set(known.values())
    edit.maker.remove_rows([row for row in crossings.tolist() if row not in kept])
    _bring_along(edit, line, known)
    gather_crossings(edit, line, pieces, known)
    _leave_to_others(edit, [curve for curve, _ in pieces])
    enter_line_plane(edit, line, left.rows())
    edit.pending.curves |= compute_kept_crossings(edit.maker, left)
    _carry(edit, np.array([curve for curve, _ in pieces]), placed)
    _drop_lost(edit, np.array([curve for curve, _ in pieces]), np.array(sorted(kept), np.int64))
    _report(edit, every, np.array([curve for curve, _ in pieces]))


def _leave_to_others(edit: Transaction, curves: list[int]) -> None:
    """Let intersections of pieces forget crossings that went over to another piece.

    Else each would take them, of equal sense on the same line, to where the piece is now.
    """
    state = edit.state
    for curve in curves:
        meets: CurveIntersections = state.curves.meets[curve]
        others = (meets.row >= 0) & ~(state.rows.curve[meets.row] == curve).any(axis=1)
        if others.any():
            row = np.where(others, -1, meets.row)
            edit.journal.set(state.curves.meets, [curve], [attrs.evolve(meets, row=row)])


def _report(edit: Transaction, before: IntArray, curves: IntArray) -> None:
    """Put the crossings that came and went on the way into the report."""
    keys = edit.state.rows.key.data
    after = crossings_and_placed(edit.state, curves)[0]
    edit.pending.born += sorted(keys[row] for row in np.setdiff1d(after, before).tolist())
    edit.pending.gone += sorted(keys[row] for row in np.setdiff1d(before, after).tolist())


def _drop_adopted(edit: Transaction, mine: IntArray, stay: IntArray) -> None:
    """Take the line's own adopted points out: they held the shape of another place."""
    table = edit.state.rows
    on = table.alive.data & np.isin(table.curve[:, 0], mine)
    own = np.flatnonzero(on & (table.sort.data == Sort.ADOPTED))
    edit.maker.remove_rows(np.setdiff1d(own, stay))


def crossings_and_placed(state: HullState, mine: IntArray) -> tuple[IntArray, IntArray]:
    """Give the crossings of the line's curves, and their placed points."""
    table = state.rows
    on = table.alive.data & np.isin(table.curve.data, mine).any(axis=1)
    crossings = np.flatnonzero(on & (table.sort.data == Sort.CROSSING))
    return crossings, np.flatnonzero(on & (table.sort.data == Sort.PLACED))


def _followed(
    state: HullState, line: int, crossings: IntArray, position: float
) -> dict[tuple[int, int], int]:
    """Follow each crossing along the other curve; give it by that curve and its new root."""
    normal, start = state.lines.normal[line].copy(), float(state.lines.offset[line])
    others = _partners_of(state, line, crossings)
    batch = SplineBatch.join([state.spline(curve) for curve in others])
    known: dict[tuple[int, int], int] = {}
    for other, path in zip(
        others, track_intersections_of_each(batch, normal, start, position), strict=True
    ):
        meets: CurveIntersections = state.curves.meets[other]
        rows = meets.row[meets.line == line].tolist()
        known |= {(other, new): rows[old] for old, new in path.items() if rows[old] >= 0}
    return known


def _partners_of(state: HullState, line: int, crossings: IntArray) -> list[int]:
    """Give the curves on the other side of a line's crossings, ascending."""
    pairs = state.rows.curve[crossings]
    mine = state.curves.line[pairs] == line
    return sorted(set(pairs[~mine].tolist()))


def _bring_along(edit: Transaction, line: int, known: dict[tuple[int, int], int]) -> None:
    """Store the new spots of followed crossings, so that both curves find them there."""
    if not known:
        return
    state = edit.state
    plane = state.lines.normal[line], state.lines.offset[[line]]
    others = sorted({other for other, _ in known})
    met = intersect_planes(SplineBatch.join([state.spline(curve) for curve in others]), *plane)
    first = np.searchsorted(met.curve, np.arange(len(others))).tolist()
    start = dict(zip(others, first, strict=True))
    for (other, root), row in sorted(known.items()):
        if root == NO_ROOT:
            continue  # a tangency: its crossing has no intersection on the other curve
        place = met.xyz[start[other] + root]
        edit.journal.put(state.rows.spot, [row], [[place, place]])


def _carry(edit: Transaction, curves: IntArray, placed: IntArray) -> None:
    """Carry placed points along the hull into the new plane, each to the nearest piece."""
    state = edit.state
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    for row in placed.tolist():
        exact = state.lines.normal[state.line_of(int(curves[0]))] == 1.0  # the plane's axis
        start = state.rows.xyz[row].copy()
        start[exact] = state.lines.offset[state.line_of(int(curves[0]))]
        feet = [closest_points(batch, i, start[None]) for i in range(batch.count)]
        best = int(np.argmin([float(foot[2][0]) for foot in feet]))
        place, curve = feet[best][1][0].copy(), int(curves[best])
        place[exact] = start[exact]
        edit.journal.put(state.rows.xyz, [row], [place])
        edit.journal.put(state.rows.curve, [row], [(curve, -1)])
        edit.journal.put(state.rows.reader, [row], [(curve, -1)])
        insert_defining_point(edit.maker, curve, row)
        edit.pending.curves.add(curve)


def _drop_lost(edit: Transaction, mine: IntArray, kept: IntArray) -> None:
    """Remove crossings that were followed, but that the new curve does not reach."""
    state = edit.state
    met = [state.curves.meets[curve].row for curve in mine.tolist()]
    made = [state.curves.rows[curve] for curve in mine.tolist()]
    lost = np.setdiff1d(kept, np.concatenate([*met, *made]))
    for row in lost.tolist():
        for curve in state.rows.curve[row].tolist():
            make_latent(edit.maker, curve, row)
    edit.maker.remove_rows(lost)

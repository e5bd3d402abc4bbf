"""Followers of a transformation that come to end elsewhere on boundary curves.

Which these are follows from the intersections of the images of boundary curves with the planes of
followers. Where there are as many ends as before, each lost one is handed over to one that is
gained. Else the line is taken out while the others are carried and cut, and then cut wholly anew,
as a shifted line; runs of its points that the mapping leaves still stay with all they define.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import permutations

import attrs
import numpy as np

from assoc_hull.edit.carried_net import CarriedNet
from assoc_hull.edit.crossings.adopted_points import (
    NO_ROOT,
    PlaneTangency,
    clear_at_tangencies,
    hold_along_tangencies,
    tangency_rows,
    without_double_roots,
)
from assoc_hull.edit.crossings.settle_crossings import one_place
from assoc_hull.edit.lines.kept_runs import NO_KEPT_RUNS, KeptRun, KeptRuns, suspend_roles
from assoc_hull.edit.lines.marks import find_marks, with_tangencies
from assoc_hull.edit.lines.plane_intersections import remove_line_plane
from assoc_hull.edit.lines.shift_line import crossings_and_placed, recut_line
from assoc_hull.edit.recut.carried_points import TransformationState
from assoc_hull.edit.recut.driver_image import ImageIntersections
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import NoMeetingError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.geometry.splines.segments import derivative, evaluate
from assoc_hull.model.kinds import BoundaryKind, Role
from assoc_hull.model.network import align_plane_roots
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "aligned_pairs",
    "bring_back_line",
    "double_root_crossings",
    "find_kept_runs",
    "hand_over_ends",
    "has_changed_ends",
    "recognise_crossings",
    "runs_along_plane",
    "take_out_lines",
]

# --------------------------------------------------------------------------------------
# Which followers these are. Such a line has another course there than its image.

_ALONG = 0.02
"""A curve that rises through a plane by a smaller part of its length runs along it."""


def aligned_pairs(
    work: TransformationState, curve: int, line: int, local: int, roots: ImageIntersections
) -> tuple[IntArray, IntArray, list[tuple[int, int]]]:
    """Align the old intersections of a driver with a plane and the new ones of its image.

    `local` is the number of the driver in `roots`. Gives the old ones by their place in the
    driver's `meets`, the new ones by theirs in `roots`, and pairs of places in these two.
    """
    meets: CurveIntersections = work.state.curves.meets[curve]
    old = np.flatnonzero(meets.line == line)
    new = np.flatnonzero(roots.curve == local)
    touch = work.touches.get((curve, line))
    new = new[without_double_roots(work.state, roots.xyz[new], touch.xyz if touch else None)]
    carried = work.met_images(curve)[old]
    return old, new, align_plane_roots(meets.sign[old], carried, roots.sign[new], roots.xyz[new])


def double_root_crossings(state: HullState, curve: int, line: int) -> set[int]:
    """Give the crossings at double roots: the curve does not pass through the plane there.

    An intersection of sign 0 is none of these: a line may end squarely on it. Rounding may make two
    of a double root, to and fro, and attach the crossing to one of them.
    """
    meets: CurveIntersections = state.curves.meets[curve]
    passed = (meets.line == line) & (meets.sign != 0)
    double = set[int]()
    for row in tangency_rows(state, curve, line):
        here = passed & ~without_double_roots(state, meets.xyz, state.rows.xyz[row])
        if row not in meets.row[passed] or (here.any() and not meets.sign[here].sum()):
            double.add(row)
    return double


def has_changed_ends(
    work: TransformationState, curve: int, line: int, local: int, roots: ImageIntersections
) -> bool:
    """Tell whether a follower would end on a boundary curve more or fewer times, or far off."""
    state = work.state
    if state.lines.boundary[state.line_of(curve)] != BoundaryKind.END:
        return False
    meets: CurveIntersections = state.curves.meets[curve]
    if bool(double_root_crossings(state, curve, line)) != ((curve, line) in work.touches):
        return True
    old, new, pairs = aligned_pairs(work, curve, line, local, roots)
    lost = np.setdiff1d(np.arange(len(old)), [one for one, _ in pairs])
    if len(pairs) < len(new) or bool((meets.row[old[lost]] >= 0).any()):
        return True
    carried = work.met_images(curve)[old]
    slip = [carried[i] - roots.xyz[new[j]] for i, j in pairs]
    far = [float((step * step).sum()) > one_place(state) ** 2 for step in slip]
    ends = new[[j for (_, j), away in zip(pairs, far, strict=True) if away]]
    return bool(runs_along_plane(work, curve, line, roots.t[ends]).any())


def runs_along_plane(
    work: TransformationState, curve: int, line: int, t: FloatArray
) -> np.typing.NDArray[np.bool_]:
    """Tell where the image of a curve runs along the plane of a line, or nearly: it touches it.

    An end that has slid there stands anywhere along the touch, as rounding has it.
    """
    spline, none = work.state.spline(curve), np.zeros(len(t), np.int64)
    slope = derivative(spline, none, t)
    turned = (work.space.jacobians(evaluate(spline, none, t)) * slope[:, None, :]).sum(axis=2)
    rise = (turned * work.planes.normal[line]).sum(axis=1)
    return np.asarray(np.abs(rise) <= _ALONG * np.sqrt((turned * turned).sum(axis=1)))


def recognise_crossings(
    work: TransformationState, curve: int, line: int, local: int, roots: ImageIntersections
) -> None:
    """Store in `work.anew` which crossings of a line are which intersections of a driver."""
    meets: CurveIntersections = work.state.curves.meets[curve]
    old, _, pairs = aligned_pairs(work, curve, line, local, roots)
    for one, other in pairs:
        row = int(meets.row[old[one]])
        if row >= 0:
            work.anew[line][curve, other] = row
    if (curve, line) in work.touches:
        for row in tangency_rows(work.state, curve, line):
            work.anew[line][curve, NO_ROOT] = row


# --------------------------------------------------------------------------------------
# As many ends as before, on other boundary curves: the line need not be cut anew, and what the
# mapping leaves still along it keeps its bits.

_FAR = 0.1
"""No end is handed over farther than this part of the piece's length."""

_MOST = 3
"""More ends than this are not told apart."""


def hand_over_ends(
    work: TransformationState,
    curves: IntArray,
    some: IntArray,
    line: int,
    roots: ImageIntersections,
) -> bool:
    """Match each lost end of a follower with a gained intersection; False if that is not clear.

    `curves` (m,) are the drivers, `some` (k,) the places among them of those that are cut with
    the plane of the line, `roots` where their images meet it. `work.ends` takes the matches.
    """
    lost, won = list[int](), list[int]()
    for local in some.tolist():
        curve = int(curves[local])
        # Lines end on curves of this kind only.
        if work.state.lines.boundary[work.state.line_of(curve)] != BoundaryKind.END:
            continue
        meets: CurveIntersections = work.state.curves.meets[curve]
        # A touch has no intersection that it could be matched by.
        if double_root_crossings(work.state, curve, line) or any(
            touched == curve for touched, _ in work.touches
        ):
            return False
        old, new, pairs = aligned_pairs(work, curve, line, local, roots)
        gained = np.delete(new, [other for _, other in pairs])
        # There an end stands anywhere along the touch, as rounding has it.
        if runs_along_plane(work, curve, line, roots.t[gained]).any():
            return False
        lost += meets.row[np.delete(old, [one for one, _ in pairs])].tolist()
        won += gained.tolist()
    # Where no crossing was, no line ended.
    lost = [row for row in lost if row >= 0]
    ends = [_end_of(work, line, row) for row in lost]
    if not lost or len(lost) != len(won) or len(lost) > _MOST or None in ends:
        return False
    order = _nearest(work.image[lost], roots.xyz[won])
    for end, row, root in zip(ends, lost, order, strict=True):
        assert end is not None
        step = roots.xyz[won[root]] - work.image[row]
        length = float(work.state.spline(end[0]).knot[-1])
        if float(np.sqrt((step * step).sum())) > _FAR * length:
            return False
    # Not before all are seen to be near: if refused, `work` stays as it was.
    for end, root in zip(ends, order, strict=True):
        assert end is not None
        work.ends[int(curves[roots.curve[won[root]]]), won[root]] = end
    return True


def _end_of(work: TransformationState, line: int, row: int) -> tuple[int, int] | None:
    """Give the piece of a line that begins (0) or ends (1) at a crossing; None if none does."""
    for curve in work.state.lines.curves[line]:
        rows: IntArray = work.state.curves.rows[curve]
        for side in (0, 1):
            if int(rows[-side]) == row:
                return int(curve), side
    return None


def _nearest(before: FloatArray, after: FloatArray) -> tuple[int, ...]:
    """Pair places (k, 3), m, by the least total distance: the place after of each one before."""
    away = np.sqrt(((before[:, None] - after[None]) ** 2).sum(axis=2))
    every = np.arange(len(before))
    return min(permutations(every.tolist()), key=lambda order: float(away[every, order].sum()))


# --------------------------------------------------------------------------------------
# Points of lines that are cut wholly anew which the mapping leaves where they are.

_SHORTEST = 2
"""A run has at least so many points."""


def find_kept_runs(work: TransformationState) -> None:
    """Find what stays of the lines that are to be cut anew.

    A crossing of two such lines stays if it does on both.
    """
    state = work.state
    spans = {line: _spans(work, line) for line in work.anew}
    found = {line: {row for run in runs for row in run.every()} for line, runs in spans.items()}
    both = {
        row for line, rows in found.items() for row in rows
        if all(row in found.get(state.line_of(curve), rows)
               for curve in state.rows.curve[row].tolist() if curve >= 0)
    }  # fmt: skip
    work.held |= both
    for line, runs in spans.items():
        work.stays[line] = KeptRuns(
            tuple(_left(run, both) for run in runs), _roles(state, both, line)
        )


def _spans(work: TransformationState, line: int) -> list[KeptRun]:
    """Give the runs of a line that the mapping leaves where they are."""
    found = list[KeptRun]()
    for curve in work.state.lines.curves[line]:
        rows: IntArray = work.state.curves.rows[curve]
        knot = work.state.spline(curve).knot
        edge = np.diff(np.concatenate([[False], work.still[rows], [False]]).astype(np.int64))
        for first, last in zip(
            np.flatnonzero(edge == 1).tolist(), np.flatnonzero(edge == -1).tolist(), strict=True
        ):
            if last - first >= _SHORTEST:
                span = float(knot[first]), float(knot[last - 1])
                found.append(KeptRun(curve, rows[first:last], _passed(work, curve, span), span))
    return found


def _passed(work: TransformationState, curve: int, span: tuple[float, float]) -> IntArray:
    """Give the crossings within a span (chord parameters, m) that do not define it, and stay."""
    meets: CurveIntersections = work.state.curves.meets[curve]
    inside = (meets.parameter >= span[0]) & (meets.parameter <= span[1]) & (meets.row >= 0)
    rows = np.setdiff1d(meets.row[inside], work.state.curves.rows[curve])
    found: IntArray = rows[work.still[rows]]
    return found


def _left(run: KeptRun, rows: set[int]) -> KeptRun:
    """Leave out the points of a run that do not stay."""
    kept = np.array(sorted(rows), np.int64)
    return attrs.evolve(
        run, rows=run.rows[np.isin(run.rows, kept)], passed=run.passed[np.isin(run.passed, kept)]
    )


def _roles(state: HullState, rows: set[int], line: int) -> dict[int, int]:
    """Give the roles of crossings on a line that are computed from a curve."""
    table = state.rows
    return {
        row: int(table.role[row]) for row in sorted(rows)
        if table.driver[row] >= 0
        and line in [state.line_of(curve) for curve in table.curve[row].tolist()]
    }  # fmt: skip


# --------------------------------------------------------------------------------------
# Cut wholly anew: the line comes back when the others are lofted, and crossings with drivers that
# are still there keep their identity.


def take_out_lines(edit: Transaction, work: TransformationState, *, may_go: bool = False) -> None:
    """Take lines that are cut anew out of the net, and note that they come back.

    Those that the hull does not reach any more go for good where they may.
    """
    state, put = edit.state, edit.journal.put
    keys = state.lines.key.data
    # those of lower rank come back first, as the others are cut from them too
    for line in sorted(work.anew, key=lambda each: (state.family(each).rank, str(keys[each]))):
        mine = np.array(state.lines.curves[line], np.int64)
        stays = work.stays[line]
        crossings, placed = (
            np.setdiff1d(rows, stays.rows()) for rows in crossings_and_placed(state, mine)
        )
        edit.maker.roles(crossings, np.full(len(crossings), int(Role.WATCHED)))
        suspend_roles(edit.maker, stays)
        remove_line_plane(edit, line)
        put(state.rows.xyz, placed, work.image[placed])
        put(state.curves.alive, mine, False)
        put(state.lines.alive, [line], False)
        touches = work.touched(line)
        known = work.anew[line]
        edit.pending.ask(CarriedNet).after.append(
            partial(bring_back_line, edit, line, known, touches, stays, may_go=may_go)
        )


def bring_back_line(
    edit: Transaction,
    line: int,
    known: dict[tuple[int, int], int],
    touches: Sequence[PlaneTangency] = (),
    stays: KeptRuns = NO_KEPT_RUNS,
    *,
    may_go: bool = False,
) -> None:
    """Cut a line that was taken out from the others as they are now; what stays joins the cut.

    Where the hull does not reach its plane any more, the line goes if it may, with a note.

    Raises
    ------
    NoMeetingError
        The hull does not reach the plane, and the line may not go or has placed points.
    """
    state, put = edit.state, edit.journal.put
    edit.document.refresh()
    normal, offset = state.lines.normal[line].copy(), float(state.lines.offset[line])
    try:
        marks = find_marks(state, int(state.lines.group[line]), normal, offset)
    except NoMeetingError as error:
        if not may_go:
            raise
        _let_go(edit, line, error)
        return
    if touches:
        every = set(zip(marks.curve.tolist(), marks.root.tolist(), strict=True))
        marks = with_tangencies(state, marks, line, touches)
        clear_at_tangencies(edit.maker, [each for each in touches if _bounds(state, each)])
        left = set(zip(marks.curve.tolist(), marks.root.tolist(), strict=True))
        known = {mark: row for mark, row in known.items() if mark not in every - left}
    put(state.lines.alive, [line], True)
    put(state.curves.alive, state.lines.curves[line], True)
    recut_line(edit, line, marks, _still_there(edit, line, known), stays)
    hold_along_tangencies(edit.maker, line, touches)


def _let_go(edit: Transaction, line: int, error: NoMeetingError) -> None:
    """Remove a line that was taken out for good, unless it holds what the designer placed."""
    state = edit.state
    mine = np.array(state.lines.curves[line], np.int64)
    crossings, placed = crossings_and_placed(state, mine)
    if len(placed):
        raise error
    on = state.rows.alive.data & np.isin(state.rows.curve.data, mine).any(axis=1)
    edit.pending.gone += sorted(str(state.rows.key[row]) for row in crossings.tolist())
    edit.maker.remove_rows(np.flatnonzero(on))
    edit.pending.curves -= set(mine.tolist())
    edit.pending.notes.append(f"{state.lines.name[line]} is gone: {error}")


def _bounds(state: HullState, touch: PlaneTangency) -> bool:
    """Tell whether a tangency is of a boundary curve that lines end on."""
    kind = state.lines.boundary[state.line_of(touch.curve)]
    return bool(kind == BoundaryKind.END)


def _still_there(
    edit: Transaction, line: int, known: dict[tuple[int, int], int]
) -> dict[tuple[int, int], int]:
    """Leave out crossings with curves that, lofted, meet the plane fewer times than their image."""
    table = edit.state.lines
    plane = table.normal[line].copy(), table.offset[[line]].copy()
    count = {curve: intersect_planes(edit.state.spline(curve), *plane).count for curve, _ in known}
    rows = edit.state.rows
    return {
        (curve, root): row for (curve, root), row in known.items()
        if root < count[curve] and rows.alive[row]
    }  # fmt: skip

"""What must hold after an update, before it is published.

Each function looks at the curves that the update has evaluated and gives findings as text; all
are collected before the edit is refused. Gaps of watched crossings are stored on the way.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.graph.derived import Objects
from assoc_hull.graph.journal import Journal, distinct
from assoc_hull.model.address import address
from assoc_hull.model.align_intersections import Alignment
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.index import Index
from assoc_hull.model.kinds import BoundaryKind, Sort
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "MOVE_ADVICE",
    "WideGaps",
    "curve_title",
    "ends_at_risk",
    "find_beyond",
    "find_endless",
    "find_folds",
    "find_unbounded",
    "find_unmet",
    "measure_gaps",
    "note_new_ends",
    "plane_normals",
    "splines_of",
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

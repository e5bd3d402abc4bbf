"""Lines that follow sections get their crossings chosen anew where a definition makes these pass.

A buttock is made through its crossings with sections and waterlines. Change a definition by a
little, and a waterline may come to cross the buttock ahead of a section where it did so abaft
it: the three lines have passed through one point. Made in the old order the buttock would fold;
made through both, a millimetre apart, it would be bent. So where that happens the crossings are
put into their new order, and the role rule chooses again which of them define the line.
"""

from __future__ import annotations

from collections.abc import Iterable

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import WideGaps
from assoc_hull.edit.crossings.adopted_points import link_adopted_points
from assoc_hull.edit.modification import Work
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.gaps import gap_at
from assoc_hull.model.generated_curves import kept_rows
from assoc_hull.model.kinds import Role, Sort, State
from assoc_hull.model.links import crossing_ways
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.roles import Candidates, choose
from assoc_hull.model.tables import HullState

__all__ = ["limit_watched", "renew_followers", "widen_limits"]

_MOST = 0.05
"""Times `Tolerances.factor`: no gap wider than this (m) is taken for the fineness of a net."""

_OPEN = 1e3
"""A gap (m) that no crossing has, until its own has been measured."""

BoolArray = np.typing.NDArray[np.bool_]


@attrs.frozen(eq=False)
class _Points:
    """All that may define a curve, in the order in which it lies along it now."""

    rows: IntArray
    xyz: FloatArray
    crossing: BoolArray
    fixed: BoolArray


def renew_followers(work: Work) -> tuple[list[int], list[int]]:
    """Choose anew what defines the lowest lines on which crossings have passed one another.

    Parameters
    ----------
    work : Work
        The update, whose main pass has run.

    Returns
    -------
    list of int, list of int
        The curves, and all above them that were evaluated, to be evaluated again; crossings
        that have come to be watched. What these curves meet is as it was before the edit.
    """
    state = work.state
    touched = [curve for curve in work.touched().tolist() if _has_passed(state, curve)]
    level = work.network.index.level
    least = min((int(level[curve]) for curve in touched), default=0)
    curves = [curve for curve in touched if level[curve] == least]
    if not curves:
        return [], []
    watched = [row for curve in curves for row in _renew(work, curve)]
    above = [curve for curve in work.touched().tolist() if level[curve] > least]
    _meet_as_before(work, [*curves, *above])
    work.renew()
    return [*curves, *above], watched


def _meet_as_before(work: Work, curves: list[int]) -> None:
    """Let curves that have run through one another find their meetings from where they were."""
    column, again = work.state.curves.meets, set(curves)
    net = work.journal.net(column)
    old = dict(zip(net.rows.tolist(), net.old, strict=True))
    known = [curve for curve in curves if curve in old and curve in work.network.before]
    work.journal.set(column, known, [old[curve] for curve in known])
    left = [each for each in work.network.realigned if each.curve not in again]
    work.network.realigned[:] = left


def _has_passed(state: HullState, curve: int) -> bool:
    """Tell whether a line that others make has points in the wrong order, or too close."""
    if state.curves.state[curve] != State.CLEAN or not _follows(state, curve):
        return False
    spline, limits = state.spline(curve), state.tolerances
    if len(curve_folds(spline).curve):
        return True
    step = np.diff(spline.knot)
    rows: IntArray = state.curves.rows[curve]
    loose = ~_fixed(state, curve, rows)
    near = step < max(limits.turn_spacing, limits.turn_spacing_part * float(np.median(step)))
    return bool((near & loose[1:] & loose[:-1]).any())


def _follows(state: HullState, curve: int) -> bool:
    """Tell whether all that crosses a curve from below drives it, by one-way associations."""
    mine = _crossings(state, curve)
    if not len(mine):
        return False
    return bool((crossing_ways(state, mine) == (True, False)).all())


def _crossings(state: HullState, curve: int) -> IntArray:
    """Give the crossings of a curve with those of lower rank, contacts left out."""
    table = state.rows
    mine = table.alive.data & (table.curve[:, 1] == curve) & ~table.contact.data
    found: IntArray = np.flatnonzero(mine & (table.sort.data == Sort.CROSSING))
    return found


def _fixed(state: HullState, curve: int, rows: IntArray) -> BoolArray:
    """Tell which points a curve cannot do without: ends, tangents, knuckles, placed ones."""
    table = state.rows
    side = (table.curve[rows, 0] != curve).astype(np.int64)
    found: BoolArray = table.kind[rows, side] != PointKind.SMOOTH
    found |= (table.sort[rows] == Sort.PLACED) | np.isin(rows, kept_rows(state))
    found |= table.contact[rows] | (table.override[rows] >= 0)
    return found | np.isin(rows, state.curves.rows[curve][[0, -1]])


def _renew(work: Work, curve: int) -> list[int]:
    """Put what may define a curve in order, and choose; give crossings that are watched now."""
    state, maker = work.state, Maker(work.state, work.journal)
    points = _points(state, curve, work.network.before.get(curve, state.spline(curve)))
    chosen = _choose(state, points)
    table, free = state.rows, points.crossing & ~points.fixed
    roles = np.where(chosen, int(Role.DRIVES_B), int(Role.WATCHED))
    turned = free & (table.role[points.rows] != roles)
    maker.roles(points.rows[turned], roles[turned])
    driven, lost = points.rows[turned & chosen], points.rows[turned & ~chosen]
    work.journal.put(table.limit, driven, np.nan)
    work.journal.put(table.gap, driven, np.nan)
    work.journal.put(table.limit, lost, _OPEN)
    maker.define(curve, points.rows[chosen])
    maker.remove_rows(points.rows[~chosen & ~points.crossing])
    link_adopted_points(state, np.array([curve]), work.journal)
    work.pending.computed |= set(driven.tolist())
    name = state.lines.name[state.line_of(curve)]
    work.pending.notes.append(
        f"{name}: crossings that have passed one another stand in their new order"
        + (f"; {len(lost)} no longer define it" if len(lost) else "")
    )
    found: list[int] = lost.tolist()
    return found


def _points(state: HullState, curve: int, before: SplineBatch) -> _Points:
    """Give all that may define a curve, in the order in which it lies along what it was."""
    table = state.rows
    own: IntArray = state.curves.rows[curve]
    watched = np.setdiff1d(_crossings(state, curve), own)
    watched = watched[np.isfinite(table.parameter[watched]).all(axis=1)]
    rows = np.concatenate([own, watched])
    xyz = np.concatenate([table.xyz[own], table.spot[watched, 0]])
    at = closest_points(before, 0, xyz)[0].copy()
    at[0], at[len(own) - 1] = -np.inf, np.inf
    order = np.argsort(at, kind="stable")
    rows, xyz = rows[order], xyz[order]
    crossing = (table.sort[rows] == Sort.CROSSING) & ~table.contact[rows]
    return _Points(rows, xyz, crossing, _fixed(state, curve, rows))


def _choose(state: HullState, points: _Points) -> BoolArray:
    """Apply the role rule; a point that was adopted gives way to any crossing."""
    step = np.diff(points.xyz, axis=0)
    chord = np.sqrt((step * step).sum(axis=1))
    position = np.concatenate([[0.0], np.cumsum(chord)])
    slope = np.zeros_like(points.xyz)
    slope[1:-1] = points.xyz[2:] - points.xyz[:-2]
    slope[[0, -1]] = step[[0, -1]]
    slope /= np.maximum(np.sqrt((slope * slope).sum(axis=1)), 1e-12)[:, None]
    giver = state.curves.line[state.rows.curve[points.rows, 0]]
    sine = np.abs((slope * state.lines.normal[giver]).sum(axis=1))
    angle = np.degrees(np.arcsin(np.minimum(sine, 1.0)))
    angle = np.where(points.crossing, angle, state.tolerances.transversal_deg)
    return choose(Candidates(position, angle, slope, points.fixed), state.tolerances)


def limit_watched(work: Work, crossings: Iterable[int]) -> None:
    """Give crossings that have come to be watched their gaps, and limits as at a birth."""
    state = work.state
    watched = np.array(sorted(crossings), np.int64)
    watched = watched[state.rows.role[watched] == Role.WATCHED]
    if len(watched):
        gap = gap_at(state, watched)
        least = 2.0 * state.tolerances.adoption
        work.journal.put(state.rows.gap, watched, gap)
        work.journal.put(state.rows.limit, watched, np.maximum(least, 1.5 * gap))


def widen_limits(work: Work, wide: WideGaps) -> bool:
    """Give watched crossings of lines that others make limits as at a birth; tell whether any.

    How near such lines pass one another between the crossings that make them is a matter of how
    close these lie; a hull made of the new definitions would have these gaps from the beginning.
    """
    state = work.state
    curve = state.rows.curve[wide.rows, 1]
    follows = np.array([_follows(state, each) for each in curve.tolist()], np.bool_)
    chosen = follows & (wide.gap <= state.tolerances.factor * _MOST)
    rows, gap = wide.rows[chosen], wide.gap[chosen]
    if len(rows):
        work.journal.put(state.rows.limit, rows, 1.5 * gap)
        work.pending.notes.append(
            f"{len(rows)} watched crossings pass up to {1e3 * gap.max():.1f} mm apart, over their "
            "limits: these are set anew, as of a net that is made of the new definitions"
        )
    return bool(len(rows))

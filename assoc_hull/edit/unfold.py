"""Lines that would fold when a definition changes: the role rule is applied to them again.

A line that only follows is made through crossings with sections, which keep their x, and with
other lines, whose crossings slide. A definition moves these past one another, and the line would
turn back. So its crossings are put in order anew, and those that stand too close to others cease to
define it: they are watched from now on. Points that were adopted between them are dropped.
"""

from __future__ import annotations

import copy

import attrs
import numpy as np

from assoc_hull.edit.chain import chain
from assoc_hull.edit.pending import Pending
from assoc_hull.edit.work import Work
from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray
from assoc_hull.geometry.order import folds
from assoc_hull.geometry.spline import derivative, loft
from assoc_hull.model.family import Role, Sort
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.generated import attached, unmade_rows
from assoc_hull.model.make import Maker
from assoc_hull.model.roles import Candidates, choose
from assoc_hull.model.state import HullState

__all__ = ["Trial", "copied", "loosen", "put_in_order"]


@attrs.frozen(eq=False)
class Trial:
    """What an update that was refused found.

    Attributes
    ----------
    xyz : (n, 3), m
        Where all points came to lie.
    curves : tuple of int
        Followers that folded.
    """

    xyz: FloatArray
    curves: tuple[int, ...]

    @classmethod
    def of(cls, state: HullState) -> Trial:
        """Take it from the tables as the update left them."""
        live = state.live("curves").tolist()
        found = [
            curve
            for curve in live
            if state.curves.spline.data[curve] is not None
            and _follows(state, curve)
            and len(folds(state.spline(curve)))
        ]
        return cls(state.rows.xyz.data.copy(), tuple(found))


def copied(pending: Pending) -> Pending:
    """Give a copy of what is pending, with containers of its own."""
    names = [field.name for field in attrs.fields(Pending)]
    return Pending(**{name: copy.copy(getattr(pending, name)) for name in names})


def put_in_order(maker: Maker, pending: Pending, trial: Trial) -> bool:
    """Let followers that folded in a trial be made through crossings in order.

    Parameters
    ----------
    maker : Maker
        Writes into the tables as they were before the trial.
    pending : Pending
        Of the update that comes.
    trial : Trial
        What the trial found.

    Returns
    -------
    bool
        Whether anything was done.
    """
    state, names, count = maker.state, list[str](), 0
    for curve in trial.curves:
        rows: IntArray = state.curves.rows.data[curve]
        stood_in = rows[state.rows.sort.data[rows] == Sort.ADOPTED]
        order = _ordered(state, curve, rows[~np.isin(rows, stood_in)], trial.xyz)
        if order is None:
            continue
        kept = _kept(state, curve, order, trial.xyz)
        maker.remove_rows(stood_in)
        maker.define(curve, order[kept])
        maker.roles(order[~kept], np.full(int((~kept).sum()), int(Role.WATCHED)))
        maker.journal.put(state.rows.limit, order[~kept], np.inf)
        pending.curves.add(curve)
        names.append(str(state.lines.name.data[state.line_of(curve)]))
        count += int((~kept).sum())
    if names:
        pending.structural = True
        pending.notes.append(
            f"{', '.join(sorted(set(names)))}: crossings come in another order with these "
            f"definitions, {count} stand too close to others and define no line any more"
        )
    return bool(names)


def loosen(work: Work, curves: IntArray) -> None:
    """Give watched crossings of followers the gaps that new definitions leave them.

    Where definitions or other lines give all of a curve, it has come away from nothing.
    """
    state = work.state
    rows = watched_on(state, curves)
    rows = rows[np.isfinite(state.rows.parameter.data[rows]).all(axis=1)]
    pairs = state.rows.curve.data[rows]
    made = attached(state)
    follows = {each: each in made or _follows(state, each) for each in np.unique(pairs).tolist()}
    rows = rows[[follows[a] or follows[b] for a, b in pairs.tolist()]]
    if not len(rows):
        return
    gap, limit = gap_at(state, rows), state.rows.limit.data[rows]
    wide = (gap > limit) | ~np.isfinite(limit)
    least = 2.0 * state.tolerances.adoption
    work.journal.put(state.rows.limit, rows[wide], np.maximum(least, 1.5 * gap[wide]))


def _follows(state: HullState, curve: int) -> bool:
    """Tell whether a curve is made through crossings that others drive, and what rides on these."""
    rows: IntArray = state.curves.rows.data[curve]
    driven = state.rows.driver.data[rows]
    crossing = (state.rows.sort.data[rows] == Sort.CROSSING) & (driven >= 0) & (driven != curve)
    adopted = state.rows.sort.data[rows] == Sort.ADOPTED
    rides = adopted & unmade_rows(state, rows) & (state.rows.kind.data[rows, 0] == 0)
    return bool((crossing | rides).all() and crossing[0] and crossing[-1])


def _ordered(state: HullState, curve: int, rows: IntArray, xyz: FloatArray) -> IntArray | None:
    """Give points of a curve in order from end to end; None if they do not make one piece."""
    first, last = state.curves.rows.data[curve][[0, -1]].tolist()
    axis = 2 if state.family(state.line_of(curve)).axis == 0 else 0
    pieces = chain(xyz[rows], (rows == first) | (rows == last), axis)
    if len(pieces) != 1 or len(pieces[0]) != len(rows):
        return None
    found: IntArray = rows[pieces[0]]
    return found if found[0] == first else found[::-1]


def _kept(
    state: HullState, curve: int, rows: IntArray, xyz: FloatArray
) -> np.typing.NDArray[np.bool_]:
    """Apply the role rule to points in order along a curve, but for those that its shape needs."""
    side = (state.rows.curve.data[rows, 0] != curve).astype(np.int64)
    kind, direction = state.rows.kind.data[rows, side], state.rows.direction.data[rows, side]
    spline = loft(CurveData.single(xyz[rows], kind, direction))
    slope = derivative(spline, np.zeros(len(rows), np.int64), spline.knot)
    tangent: FloatArray = slope / np.sqrt((slope * slope).sum(axis=1))[:, None]
    other = state.curves.line.data[state.rows.curve.data[rows, 1 - side]]
    normal = np.nan_to_num(state.lines.normal.data[other])
    sine = np.minimum(np.abs((tangent * normal).sum(axis=1)), 1.0)
    fixed = np.asarray(state.rows.contact.data[rows], bool)
    fixed[[0, -1]] = True
    angle = np.degrees(np.arcsin(sine))
    kept = choose(Candidates(spline.knot, angle, tangent, fixed), state.tolerances)
    refused = np.zeros(len(rows), bool)
    for _ in range(len(rows)):
        through = loft(CurveData.single(xyz[rows[kept]], kind[kept], direction[kept]))
        left = np.flatnonzero(~kept & ~refused)
        if not len(left):
            break
        away = closest(through, 0, xyz[rows[left]])[2]
        if float(away.max()) <= state.tolerances.adoption:
            break
        worst = left[int(away.argmax())]
        more = kept.copy()
        more[worst] = True
        waves = loft(CurveData.single(xyz[rows[more]], kind[more], direction[more]))
        refused[worst] = len(folds(waves)) > len(folds(through))
        kept = kept if refused[worst] else more
    return kept

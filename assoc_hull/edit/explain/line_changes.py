"""Which lines an edit changes, how far each moves, and where."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.step import Step
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.model.address import AddressBook
from assoc_hull.model.state import HullState

__all__ = ["LineChange", "line_changes"]

_PER_SEGMENT = 8
"""So many places of each segment are measured, where no point of the curve has moved."""


@attrs.frozen
class LineChange:
    """One line that an edit changes.

    Attributes
    ----------
    group, line : str
        Their names.
    distance : float or None, m
        The largest movement of a point on it; where none moved, how far the curve lies from
        where it was. None for a new curve.
    point : str or None
        Address of the point that moved farthest; None where none did.
    place : (float, float, float) or None, m
        Where that is now.
    """

    group: str
    line: str
    distance: float | None
    point: str | None
    place: tuple[float, float, float] | None


def line_changes(state: HullState, step: Step | None) -> tuple[LineChange, ...]:
    """Tell which lines a step has changed.

    Parameters
    ----------
    state : HullState
        The tables as the step leaves them.
    step : Step or None
        The step; None if nothing changed.

    Returns
    -------
    tuple of LineChange
        Group by group in the order of the ranks, along each group by plane, then by name.
    """
    if step is None:
        return ()
    told = ((step.changed & 1) == 0) & np.isfinite(step.moved)
    rows, away = step.changed[told] >> 1, step.moved[told]
    alive = state.rows.alive.data[rows]
    found = _Movements(state, AddressBook(state), step, rows[alive], away[alive])
    curves: dict[int, list[int]] = {}
    for curve in step.curves[state.curves.alive.data[step.curves]].tolist():
        curves.setdefault(state.line_of(curve), []).append(curve)
    return tuple(found.of_line(line, curves[line]) for line in sorted(curves, key=found.order))


@attrs.frozen(eq=False)
class _Movements:
    """Movements of the points of one step."""

    state: HullState
    book: AddressBook
    step: Step
    rows: IntArray
    away: FloatArray

    def order(self, line: int) -> tuple[int, str, float, str]:
        """Give what lines are sorted by."""
        table = self.state.lines
        place = float(table.offset.data[line]) if table.planar.data[line] else 0.0
        return self.state.family(line).rank, self._group(line), place, self.book.line_name(line)

    def _group(self, line: int) -> str:
        return str(self.state.groups.name.data[int(self.state.lines.group.data[line])])

    def of_line(self, line: int, curves: list[int]) -> LineChange:
        """Tell the movement of a line: of the points on its curves, or of these themselves."""
        name, group = self.book.line_name(line), self._group(line)
        mine = np.isin(self.state.rows.curve.data[self.rows], curves).any(axis=1)
        if mine.any():
            best = int(np.argmax(np.where(mine, self.away, -1.0)))
            row = int(self.rows[best])
            x, y, z = self.state.rows.xyz.data[row].tolist()
            return LineChange(
                group, name, float(self.away[best]), self.book.address(row), (x, y, z)
            )
        off, place = max(map(self._between, curves), key=lambda each: each[0] or 0.0)
        return LineChange(group, name, off, None, place)

    def _between(self, curve: int) -> tuple[float | None, tuple[float, float, float] | None]:
        """Give how far a curve lies from where it was, and where that is most."""
        fairness = self.step.report.fairness
        old: SplineBatch | None = None if fairness is None else fairness.before.get(curve)
        if old is None:
            return None, None
        places = sample(self.state.spline(curve), _PER_SEGMENT)[1]
        away = closest(old, 0, places)[2]
        best = int(np.argmax(away))
        x, y, z = places[best].tolist()
        return float(away[best]), (x, y, z)

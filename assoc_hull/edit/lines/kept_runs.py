"""What of a line that is cut wholly anew stays as it was: the runs that a mapping leaves alone.

A line that comes to end elsewhere is taken out and cut again. Where the mapping moves nothing,
that would still exchange its points for others within the tolerance of adoption, and those of all
lines that it crosses. So runs of points which the mapping leaves where they are, to the last bit,
stay with all they define, and the new cut is joined to them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.edit.crossings.settle_crossings import one_place
from assoc_hull.edit.lines.marks import Marks
from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.network import bits_differ
from assoc_hull.model.tables import HullState

__all__ = [
    "NO_KEPT_RUNS",
    "KeptRun",
    "KeptRuns",
    "assign_runs",
    "compute_kept_crossings",
    "release_points",
    "restore_roles",
    "suspend_roles",
]

_END = 1e-6
"""Times `Tolerances.factor`: a place as near as this (m) to an end of a run, along the line, is
in it."""


@attrs.frozen(eq=False)
class KeptRun:
    """Points of one curve, in order along it, that stay.

    Attributes
    ----------
    curve : int
        The curve.
    rows : (n,) int
        The points that define it.
    passed : (m,) int
        Crossings between the ends of the run that do not define the curve.
    span : (float, float), m
        Parameters of its ends on the curve as it was.
    """

    curve: int
    rows: IntArray
    passed: IntArray
    span: tuple[float, float]

    def every(self) -> list[int]:
        """Give all its points."""
        return [*self.rows.tolist(), *self.passed.tolist()]


@attrs.frozen(eq=False)
class KeptRuns:
    """The runs of a line that stay.

    Attributes
    ----------
    runs : tuple of KeptRun
    roles : mapping of int to int
        Roles of crossings among them while the line is taken out: they define nothing meanwhile.
    """

    runs: tuple[KeptRun, ...] = ()
    roles: Mapping[int, int] = attrs.field(factory=dict)

    def rows(self) -> IntArray:
        """Give all points that stay."""
        return np.array([row for run in self.runs for row in run.every()], np.int64)

    def of(self, state: HullState, marks: Marks) -> IntArray:
        """Tell on which run each mark lies, (k,) int; -1 on none.

        A guide between two marks of a run is of no use, and counts to it.
        """
        found = np.full(len(marks.curve), -1)
        for number, run in enumerate(self.runs):
            at, _, away = closest_points(state.spline(run.curve), 0, marks.xyz)
            slack = state.tolerances.factor * _END
            inside = (at >= run.span[0] - slack) & (at <= run.span[1] + slack)
            found[inside & (away <= state.tolerances.adoption)] = number
            found[_marks_of_ends(state, run, marks)] = number
        for number in range(len(self.runs)):
            mine = np.flatnonzero(found == number)
            if len(mine):
                between = np.arange(mine[0], mine[-1])
                found[between[marks.guide[between] & (found[between] < 0)]] = number
        return found

    def on(self, state: HullState, pieces: list[Marks]) -> KeptRuns:
        """Leave out runs that come to lie on no piece, on two, or not side by side on one."""
        owners = [self.of(state, piece) for piece in pieces]
        kept = [
            run for number, run in enumerate(self.runs)
            if [_together(owner == number) for owner in owners if (owner == number).any()]
            == [True]
        ]  # fmt: skip
        return attrs.evolve(self, runs=tuple(kept))

    def splice(self, state: HullState, order: list[int]) -> list[int]:
        """Put runs where marks on them stand in the order of a curve.

        Parameters
        ----------
        state : HullState
            The tables.
        order : list of int
            Points; for a mark on a run what `stand_in` gives.

        Returns
        -------
        list of int
            What stands between the first and the last mark of a run is exchanged for it.
        """
        for number, run in enumerate(self.runs):
            at = [i for i, row in enumerate(order) if row == self.stand_in(number)]
            if at:
                before, after = order[: at[0]], order[at[-1] + 1 :]
                order = [*before, *_turned(state, run.rows.tolist(), before, after), *after]
        return order

    @staticmethod
    def stand_in(number: int) -> int:
        """Give what stands for a mark on a run until that is put there."""
        return -2 - number


NO_KEPT_RUNS = KeptRuns()


def _marks_of_ends(state: HullState, run: KeptRun, marks: Marks) -> list[int]:
    """Give the marks that are the crossings at which a run ends.

    A curve that changes beyond the run may pass there a little outside of it.
    """
    table, found = state.rows, list[int]()
    for row in run.rows[[0, -1]].tolist() if len(run.rows) else []:
        pair = table.curve[row]
        others = pair[(pair >= 0) & (pair != run.curve)]
        mine = np.flatnonzero(np.isin(marks.curve, others))
        step = marks.xyz[mine] - table.xyz[row]
        away = np.sqrt((step * step).sum(axis=1))
        if len(mine) and away.min() <= one_place(state):
            found.append(int(mine[away.argmin()]))
    return found


def _together(mask: np.typing.NDArray[np.bool_]) -> bool:
    """Tell whether what is marked stands side by side."""
    at = np.flatnonzero(mask)
    return int(at[-1] - at[0]) == len(at) - 1


def _turned(state: HullState, rows: list[int], before: list[int], after: list[int]) -> list[int]:
    """Give a run in the sense in which it joins its neighbours by the shorter way."""
    xyz, straight, turned = state.rows.xyz.data, 0.0, 0.0
    for beside, near, far in ((before[-1:], rows[0], rows[-1]), (after[:1], rows[-1], rows[0])):
        for row in beside:
            if row >= 0:
                straight += float(np.sqrt(((xyz[row] - xyz[near]) ** 2).sum()))
                turned += float(np.sqrt(((xyz[row] - xyz[far]) ** 2).sum()))
    return rows if straight <= turned else rows[::-1]


def suspend_roles(maker: Maker, stays: KeptRuns) -> None:
    """Let crossings that stay define nothing by a computed place while their line is away."""
    rows = np.array(sorted(stays.roles), np.int64)
    maker.roles(rows, np.full(len(rows), int(Role.WATCHED)))


def release_points(maker: Maker, stays: KeptRuns, left: KeptRuns) -> set[int]:
    """Take what does not stay after all out of the curves that it defines; tell which these are."""
    state = maker.state
    lost = np.setdiff1d(stays.rows(), left.rows())
    lost = lost[state.rows.sort[lost] == Sort.CROSSING]
    maker.roles(lost, np.full(len(lost), int(Role.WATCHED)))
    curves, changed = np.unique(state.rows.curve[lost]), set[int]()
    for curve in curves[curves >= 0].tolist():
        rows: IntArray = state.curves.rows[curve]
        if np.isin(rows, lost).any():
            maker.define(curve, rows[~np.isin(rows, lost)])
            changed.add(curve)
    return changed


def assign_runs(maker: Maker, stays: KeptRuns, pieces: Sequence[tuple[int, Marks]]) -> None:
    """Let the points of runs be on the curves whose pieces the runs lie on now."""
    state, table, put = maker.state, maker.state.rows, maker.journal.put
    for new, piece in pieces:
        owner = stays.of(state, piece)
        for run in [run for number, run in enumerate(stays.runs) if (owner == number).any()]:
            for row in run.every() if new != run.curve else []:
                pair = table.curve[row].tolist()
                put(table.curve, [row], [[new if each == run.curve else each for each in pair]])
                reader = table.reader[row].tolist()
                put(table.reader, [row], [[new if each == run.curve else each for each in reader]])


def restore_roles(maker: Maker, stays: KeptRuns) -> None:
    """Let crossings that stay be computed as they were, once both their lines are there."""
    state = maker.state
    for row in sorted(stays.roles.keys() & set(stays.rows().tolist())):
        lines = [state.line_of(curve) for curve in state.rows.curve[row].tolist()]
        if state.lines.alive[lines].all():
            maker.roles(np.array([row]), np.array([stays.roles[row]]))


def compute_kept_crossings(maker: Maker, stays: KeptRuns) -> set[int]:
    """Give crossings that stay and are computed the places of their drivers; tell what they change.

    Returns
    -------
    set of int
        Curves that are made through one whose place differs by a bit.
    """
    table = maker.state.rows
    rows = np.array(sorted(stays.roles.keys() & set(stays.rows().tolist())), np.int64)
    rows = rows[table.driver[rows] >= 0]
    side = (table.curve[rows, 0] != table.driver[rows]).astype(np.int64)
    value = np.ascontiguousarray(table.spot[rows, side])
    differs = bits_differ(table.xyz[rows], value)
    maker.journal.put(table.xyz, rows[differs], value[differs])
    return set(table.reader[rows[differs]].ravel().tolist()) - {-1}

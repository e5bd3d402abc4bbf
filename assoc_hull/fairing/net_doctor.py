"""The doctor of nets: which points of a hull its lines do not bear out.

As for a table of offsets (`assoc_hull.fairing.offsets_doctor`): every residual of a line
(`assoc_hull.analysis.fairness.batten_problem`) is expected as on the lines of its family beside it,
at the place next to its own, and a point is judged by all residuals that change when it moves along
the normal of the hull, also those of lines that follow it.
"""

from __future__ import annotations

import attrs
import numpy as np
from scipy.sparse import csc_array
from scipy.spatial import cKDTree

from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.display import ShownAsText, counted
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.fairing.offsets_doctor import ALARM
from assoc_hull.fairing.table_residuals import best_change, robust_scale
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.address import address
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import length_factor

__all__ = ["NOISE", "NetDoctorReport", "PointFinding", "examine_battens", "examine_net"]

NOISE = 1e-3
"""Points of a hull of 100 m and more are known to no less than this, m."""

_MOST = 50
_SOME = 1.0
_BESIDE, _LOOKED_AT = 6, 24
"""Lines beside a residual that are asked, and the residuals nearest to it among which they are."""

_ALONG_SHIP = 0.25
"""Lengths along the ship count so much less than across: stations are that much farther apart."""


@attrs.frozen(repr=False)
class PointFinding(ShownAsText):
    """A point that its lines do not bear out.

    Attributes
    ----------
    point : str
        Its address.
    place : (float, float, float), m
    off : float, m
        How far it lies outside of where its lines ask for it, along the normal of the hull;
        inside: less than 0.
    proposed : (float, float, float), m
        Where they ask for it.
    score : float
        How much likelier all residuals become there; above 15 it is called wrong.
    """

    point: str
    place: tuple[float, float, float]
    off: float
    proposed: tuple[float, float, float]
    score: float

    @property
    def alarm(self) -> bool:
        """Whether it is called wrong."""
        return self.score > ALARM

    def __str__(self) -> str:
        x, y, z = self.proposed
        side = "out" if self.off > 0.0 else "in"
        return (
            f"score {self.score:.1f}: {self.point}: {1e3 * abs(self.off):.1f} mm too far {side}; "
            f"its lines ask for ({x:.3f}, {y:.3f}, {z:.3f}) m"
        )


@attrs.frozen(repr=False)
class NetDoctorReport(ShownAsText):
    """What the doctor found in a net; nothing was changed.

    Attributes
    ----------
    name : str
        Of the ship.
    findings : tuple of PointFinding
        All that are called wrong, and the next highest scores; the worst first, each point once.
    points, residuals : int
        Points that were judged, and residuals of lines that judge them. Placed points, profile,
        flats and features are not judged.
    noise : float, m
        To what points are known.
    """

    name: str
    findings: tuple[PointFinding, ...]
    points: int
    residuals: int
    noise: float

    @property
    def alarms(self) -> tuple[PointFinding, ...]:
        """The findings that are called wrong."""
        return tuple(each for each in self.findings if each.alarm)

    def __str__(self) -> str:
        number = len(self.alarms)
        lines = [f"{self.name}: {counted(number, 'point')} called (score above 15)"]
        lines += [f"  {each}" for each in self.alarms]
        rest = [each for each in self.findings if not each.alarm]
        if rest:
            lines += ["not called, the highest scores", *(f"  {each}" for each in rest)]
        lines.append(
            f"judged: {self.points} points by {self.residuals} residuals, known to "
            f"{1e3 * self.noise:.3g} mm; not placed points, profile, flats, features"
        )
        return "\n".join(lines)


def examine_net(state: HullState, top: int = 10, noise: float | None = None) -> NetDoctorReport:
    """Look for points of a net that their lines do not bear out; nothing is changed.

    `noise` (m): to what points are known; 1 mm of a hull of 100 m and more if None.
    """
    known = NOISE * length_factor(state.particulars.length) if noise is None else noise
    return examine_battens(state, net_battens(state), top, known)


def examine_battens(
    state: HullState, problem: BattenProblem, top: int, noise: float
) -> NetDoctorReport:
    """Look for points that the residuals of a problem do not bear out; `noise` in m."""
    count = len(problem.rows)
    found: dict[int, PointFinding] = {}
    if count and len(problem.residual):
        search = _Search.of(state, problem, noise)
        residual = problem.residual.copy()
        score, change = search.scores(residual)
        while len(found) < _MOST:
            score[list(found)] = 0.0
            worst = int(score.argmax())
            if score[worst] <= ALARM:
                break
            found[worst] = _finding(state, problem, worst, score[worst], change[worst])
            moved = np.zeros(count)
            moved[worst] = change[worst]
            residual += problem.matrix @ moved
            score, change = search.scores(residual)
        score[list(found)] = 0.0
        for each in np.argsort(-score, kind="stable")[: max(top - len(found), 0)].tolist():
            if score[each] > _SOME:
                found[each] = _finding(state, problem, each, score[each], change[each])
    return NetDoctorReport(
        state.particulars.name, tuple(found.values()), count, len(problem.residual), noise
    )


def _finding(
    state: HullState, problem: BattenProblem, which: int, score: float, change: float
) -> PointFinding:
    row = int(problem.rows[which])
    place = state.rows.xyz.data[row]
    x, y, z = place.tolist()
    to = (place + change * problem.moves[which]).tolist()
    return PointFinding(
        address(state, row), (x, y, z), -float(change), (to[0], to[1], to[2]), float(score)
    )


@attrs.frozen(eq=False)
class _Search:
    """Residuals beside each residual (r, 6), and those that each point changes, (k, m)."""

    beside: IntArray
    touched: IntArray
    coefficient: FloatArray
    noise: float

    @classmethod
    def of(cls, state: HullState, problem: BattenProblem, noise: float) -> _Search:
        columns = csc_array(problem.matrix)
        columns.sort_indices()
        many = np.diff(columns.indptr)
        owner = np.repeat(np.arange(len(many)), many)
        place = np.arange(len(owner)) - columns.indptr[owner]
        touched = np.full((len(many), int(many.max(initial=1))), -1)
        coefficient = np.zeros(touched.shape)
        touched[owner, place] = columns.indices
        coefficient[owner, place] = columns.data
        return cls(_residuals_beside(state, problem), touched, coefficient, noise)

    def scores(self, residual: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give score and change of every point, (k,) each, for residuals (r,)."""
        expected, scale = robust_scale(residual, self.beside, self.noise)
        there = self.touched >= 0
        off = np.where(there, (residual - expected)[self.touched], 0.0)
        return best_change(off, np.where(there, scale[self.touched], 1.0), self.coefficient)


def _residuals_beside(state: HullState, problem: BattenProblem) -> IntArray:
    """Give the residuals on other curves of its family next to each residual, (r, 6), -1: none."""
    families = [str(state.family(int(each)).name) for each in state.curves.line[problem.curve]]
    family = np.unique(families, return_inverse=True)[1]
    place = state.rows.xyz.data[problem.centre] * np.array([_ALONG_SHIP, 1.0, 1.0])
    found = np.full((len(family), _BESIDE), -1)
    for each in range(int(family.max(initial=-1)) + 1):
        own = np.flatnonzero(family == each)
        near = cKDTree(place[own]).query(place[own], min(_LOOKED_AT, len(own)))[1]
        near = own[near.reshape(len(own), -1)]
        curve = problem.curve[near]
        # Of each other curve the residual that is nearest: the first that is met of it.
        fresh = curve != problem.curve[own][:, None]
        for k in range(1, curve.shape[1]):
            fresh[:, k] &= (curve[:, :k] != curve[:, k : k + 1]).all(axis=1)
        rank = np.cumsum(fresh, axis=1) - 1
        row, column = np.nonzero(fresh & (rank < _BESIDE))
        found[own[row], rank[row, column]] = near[row, column]
    return found

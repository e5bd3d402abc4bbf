"""Where lines of a net are unfair: battens spring more than those of the lines beside.

A residual is judged by those of the lines of its family beside it, at the same place. Compared are
divided differences, r times the sharpness of its window: those of two lines that run alike are
alike, however their points are spaced. e is the median of the nearest ones of two lines on either
side; s is 1.75 times what nine tenths of |r - e| stay below, over three lines on either side and
three places of each. A line is unfair at a place where

    |r - e| > 3 max(s, 1.4 x noise)

so a bilge or a shoulder, which all lines there have, is none. Where fewer than three lines run
beside, a residual is not judged: at the bow and the stern, on boundary curves, one or two in ten.

[own], measured: of the lines of the 207k carrier and of a Wigley hull as they are 2 of 79 and none
are called; of 100 dents of 8 times s, one at a time, 97 or more stand among the first five places,
on those two and on Series 60. The median of |r - e| for s would call 12 lines of the carrier.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np
from scipy.spatial import cKDTree

from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState

__all__ = ["BattenFigures", "BattenJudgement", "UnfairPlace", "judge_battens"]

_BESIDE, _PLACES, _LEAST = 3, 3, 3
"""Lines on each side, places of each, and lines that are needed."""

_SPREAD, _SHARE, _NOISE, _CALLED = 1.75, 0.9, 1.4, 3.0

_REST = 2e-6
"""Of Lpp: the noise of a net whose source tells none; its own adoption waves by as much."""

_APART = 3.0
"""Times the spacing of residuals on the line itself: one beside that is farther off is at another
place; the second and third nearest may lie two and three times as far."""


@attrs.frozen
class UnfairPlace:
    """A place at which a line is unfair.

    Attributes
    ----------
    line, point : str
        The line, and the point that its batten springs off.
    place : (float, float, float), m
        Where that is.
    residual, expected : float, m
        How far the batten springs, outward positive, and those of the lines beside.
    ratio : float
        |residual - expected| over what is usual there; above 3.
    """

    line: str
    point: str
    place: tuple[float, float, float]
    residual: float
    expected: float
    ratio: float

    def __str__(self) -> str:
        x, y, z = self.place
        return (
            f"{self.point} on {self.line}: the batten springs {1e3 * self.residual:+.2f} mm, "
            f"{1e3 * self.expected:+.2f} mm on the lines beside; {self.ratio:.1f} times the usual, "
            f"at ({x:.3f}, {y:.3f}, {z:.3f}) m"
        )


@attrs.frozen
class BattenFigures:
    """How far the batten springs along one curve.

    Attributes
    ----------
    median, largest : float, m
        Of |r| at its points.
    ratio : float
        The largest |r - e| over the usual; 0 where none is judged.
    at : str
        The point where that is; where none is judged, that of the largest |r|.
    there : float, m
        r at that point, outward positive; |there| may be less than `largest`.
    """

    median: float
    largest: float
    ratio: float
    at: str
    there: float


@attrs.frozen(eq=False)
class BattenJudgement:
    """All residuals of a net with what is expected of them.

    Attributes
    ----------
    problem : BattenProblem
        The residuals.
    expected, usual : (r,), m
        e, and max(s, 1.4 x noise); infinite where a residual is not judged.
    """

    problem: BattenProblem
    expected: FloatArray
    usual: FloatArray

    @property
    def ratio(self) -> FloatArray:
        """|r - e| over the usual, (r,)."""
        found: FloatArray = np.abs(self.problem.residual - self.expected) / self.usual
        return found

    def figures(self, state: HullState, curves: IntArray) -> tuple[BattenFigures | None, ...]:
        """Give those of curves (m,); None for one without a residual."""
        problem, ratio, book = self.problem, self.ratio, AddressBook(state)
        found: list[BattenFigures | None] = []
        for curve in curves.tolist():
            mine = np.flatnonzero(problem.curve == curve)
            if not len(mine):
                found.append(None)
                continue
            size = np.abs(problem.residual[mine])
            worst = mine[int(np.argmax(ratio[mine] if ratio[mine].any() else size))]
            found.append(
                BattenFigures(
                    float(np.median(size)),
                    float(size.max()),
                    float(ratio[mine].max()),
                    book.address(int(problem.centre[worst])),
                    float(problem.residual[worst]),
                )
            )
        return tuple(found)

    def places(self, state: HullState, least: float = _CALLED) -> tuple[UnfairPlace, ...]:
        """Give the places whose ratio is above `least`, the largest first."""
        ratio, problem = self.ratio, self.problem
        order = np.argsort(-ratio, kind="stable")
        book = AddressBook(state)
        return tuple(
            UnfairPlace(
                book.line_name(state.line_of(int(problem.curve[i]))),
                book.address(int(problem.centre[i])),
                tuple(state.rows.xyz[int(problem.centre[i])].tolist()),
                float(problem.residual[i]),
                float(self.expected[i]),
                float(ratio[i]),
            )
            for i in order[ratio[order] > least].tolist()
        )


def judge_battens(
    state: HullState, problem: BattenProblem, noise: float | None = None
) -> BattenJudgement:
    """Judge the residuals of a net by those of the lines beside.

    Parameters
    ----------
    state, problem : HullState, BattenProblem
        The net and its residuals.
    noise : float or None, m
        That of the source, as a standard deviation; None: 2e-6 Lpp.
    """
    sharpness, count = problem.sharpness, len(problem.residual)
    value, beside = problem.residual * sharpness, _beside(state, problem)
    # the last of these stands for none
    values = np.append(value, np.nan)[beside]
    judged = np.flatnonzero(np.isfinite(values[:, :, 0]).sum(axis=1) >= _LEAST)
    near, every = (
        values[judged, 1 : 2 * _BESIDE - 1, 0],
        values[judged].reshape(len(judged), 2 * _BESIDE * _PLACES),
    )
    expected, usual = np.zeros(count), np.full(count, np.inf)
    middle = _below(near, 0.5)
    expected[judged] = middle / sharpness[judged]
    off = _below(np.abs(every - middle[:, None]), _SHARE)
    usual[judged] = _SPREAD * off / sharpness[judged]
    floor = _NOISE * (_REST * state.particulars.length if noise is None else noise)
    return BattenJudgement(problem, expected, np.maximum(usual, floor))


def _below(values: FloatArray, share: float) -> FloatArray:
    """Give what a share of each row of values (k, n) stays below, (k,); nan are none."""
    ordered = np.sort(values, axis=1)  # nan come last
    last = np.isfinite(ordered).sum(axis=1) - 1
    at = share * np.maximum(last, 0)
    low = np.floor(at).astype(np.int64)
    rows = np.arange(len(values))
    first, second = ordered[rows, low], ordered[rows, np.minimum(low + 1, np.maximum(last, 0))]
    found: FloatArray = first + (at - low) * (second - first)
    return found


def _beside(state: HullState, problem: BattenProblem) -> IntArray:
    """Give the residuals of the lines beside at the same place, (r, 6, 3); -1 for none.

    The lines stand from the third on one side to the third on the other, their places nearest
    first.
    """
    found = np.full((len(problem.residual), 2 * _BESIDE, _PLACES), -1)
    line = state.curves.line[problem.curve]
    group, planar = state.lines.group[line], state.lines.planar[line]
    inner = planar & (state.lines.boundary[line] < 0)
    for family in np.unique(group[inner]).tolist():
        mine = np.flatnonzero(inner & (group == family))
        axis = int(np.argmax(np.abs(state.lines.normal[int(line[mine[0]])])))
        across = [each for each in range(3) if each != axis]
        numbers = np.unique(line[mine])
        numbers = numbers[np.argsort(state.lines.offset[numbers], kind="stable")]
        place = state.rows.xyz[problem.centre[mine]][:, across]
        reach = _APART * _spacings(problem.curve[mine], place)
        own = [np.flatnonzero(line[mine] == each) for each in numbers.tolist()]
        trees = [cKDTree(place[each]) for each in own]
        for first, second, column in _pairs(len(own)):
            away, which = trees[second].query(place[own[first]], k=list(range(1, _PLACES + 1)))
            good = away <= reach[own[first]][:, None] * np.arange(1, _PLACES + 1)
            at = own[second][np.minimum(which, len(own[second]) - 1)]
            found[mine[own[first]], column] = np.where(good, mine[at], -1)
    return found


def _pairs(count: int) -> Iterator[tuple[int, int, int]]:
    """Give each line, one beside it, and which of those beside it is."""
    for first in range(count):
        for step in range(1, _BESIDE + 1):
            if first >= step:
                yield first, first - step, _BESIDE - step
            if first + step < count:
                yield first, first + step, _BESIDE + step - 1


def _spacings(curve: IntArray, place: FloatArray) -> FloatArray:
    """Give how far the residuals of a curve lie apart, about each, m."""
    step = np.sqrt(((place[1:] - place[:-1]) ** 2).sum(axis=1))
    step[curve[1:] != curve[:-1]] = 0.0
    before, after = np.concatenate([[0.0], step]), np.concatenate([step, [0.0]])
    found: FloatArray = np.maximum(before, after)
    return found

"""Points that a map has moved, led back to the signs of curvature that the lines of the parent had.

A map is smooth, and yet a line that was straight may bend both ways where the map begins or ends;
lines that are cut again wave between their points. Here the points that have moved are displaced
once more, by the least change of the batten residuals that keeps the sign of the curvature at every
knot as the parent has it there, and by no more than is stated. What is placed, features, flats,
boundary curves and all that the map left alone stay. [own]
"""

from __future__ import annotations

import sys
from collections.abc import Mapping

import attrs
import numpy as np
from scipy.sparse import csr_array, vstack

from assoc_hull.analysis.fairness.batten_problem import (
    BattenProblem,
    BentCurves,
    CurvatureRates,
    end_curvatures,
)
from assoc_hull.analysis.fairness.fair_solution import KeptSigns
from assoc_hull.edit.displacement_field import SolvedField
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.net_battens import MendingPoint, mending_points, mending_ties, net_battens
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import RefusedEditError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.combs import (
    DEAD_BAND,
    comb_integrals,
    sampled_curvatures,
    signs_without_waves,
)
from assoc_hull.model.tables import HullState
from assoc_hull.variation.comparing.line_fairness import (
    FairnessComparison,
    LineFairness,
    compare_fairness,
    measure_fairness,
)

__all__ = ["FairedFollowers", "ParentLines", "fair_followers", "repeat_fairing"]

_PARTS = (0.25, 0.5, 0.8, 1.0)
"""Of what is stated: most lines come back by little, and what a search finds jumps with it."""

_PASSES = 3
"""So often, from what was carried out: it differs a little from what was foretold."""

_TURNS = 6
"""So often curvatures are taken anew in the search of one pass."""

_VAIN = 3
"""After so many turns that bring nothing a search ends."""

_SCALE, _DIGIT = 1e-3, 1e-6
"""m: of residuals, and displacements are whole micrometres."""

_WITHIN, _OTHERS = 0.7, 0.95
"""Parts of the dead band that curvature of lines that gain, and of others, is kept within."""

_SHARP = 0.25
"""Part of the dead band that costs 1 if a bound is passed by it."""

_HEAVIER, _STIFFER = 2.0, 6.0
"""How much more lines weigh that gain again; residuals of lines whose comb becomes too large."""

_COMB, _LARGER = 2.5, 1.1
"""A comb may become so many times the parent's, or so many times what the map made of it."""

_OPEN = 9e-4
"""m: a gap that was closed, and is wider after a step, is closed again."""

_FORETOLD = 1.6
"""Times that it may be foretold to become: what is carried out mends some of it."""

_PLACES = np.linspace(-1.0, 1.0, 9)
"""Where the parent is looked at, from the middle to one neighbour to that to the other."""


# --------------------------------------------------------------------------------------
# The parent, and what came of it.


@attrs.frozen(eq=False)
class ParentLines:
    """The lines of a parent: an edit changes the hull in place.

    Attributes
    ----------
    fairness : mapping of str to LineFairness
        By the keys of lines.
    shapes : mapping of str to (SplineBatch, tuple of str)
        Curves, and the keys of their points, by key.
    places : mapping of str to (float, float, float), m
        Points by key.
    """

    fairness: Mapping[str, LineFairness]
    shapes: Mapping[str, tuple[SplineBatch, tuple[str, ...]]]
    places: Mapping[str, tuple[float, float, float]]

    @classmethod
    def of(cls, state: HullState, fairness: Mapping[str, LineFairness]) -> ParentLines:
        """Keep what is needed of a hull as it is."""
        keys, live = state.rows.key.data, state.live("rows")
        xyz = state.rows.xyz[live].tolist()
        places = {str(keys[row]): tuple(at) for row, at in zip(live.tolist(), xyz, strict=True)}
        shapes = {
            str(state.curves.key[curve]): (
                state.spline(curve),
                tuple(str(keys[row]) for row in state.curves.rows.data[curve].tolist()),
            )
            for curve in state.live("curves").tolist()
            if state.curves.spline.data[curve] is not None
        }
        return cls(fairness, shapes, places)


_Bools = np.typing.NDArray[np.bool_]

Step = Mapping[str, FloatArray]
"""How points are moved at once, (3,), m, by their keys."""


@attrs.frozen(eq=False)
class FairedFollowers:
    """What fairing the followers of a variation has done.

    Attributes
    ----------
    within : float, m
        How far points could move from where the map took them.
    points : int
        How many have moved; adopted points that close a gap follow the line that they close it to,
        as crossings that are computed follow, and are not counted.
    largest : float, m
        The farthest of them.
    before, after : int
        Changes of sign of curvature that lines have more than those of the parent, summed over the
        lines that have more: by the map alone, and now.
    lines : tuple of (str, int, int)
        Lines that have more still: name, changes in the parent, and now.
    steps : tuple of mapping of str to (3,), m
        How points were moved, by their keys, one step after the other.
    """

    within: float
    points: int
    largest: float
    before: int
    after: int
    lines: tuple[tuple[str, int, int], ...]
    steps: tuple[Step, ...] = attrs.field(repr=False)

    def without(self) -> FairedFollowers:
        """Give the same where nothing is moved; it is to be repeated, which counts anew."""
        return attrs.evolve(self, points=0, largest=0.0, steps=())

    def __str__(self) -> str:
        told = (
            f"followers faired within {1e3 * self.within:.3g} mm: {self.points} points moved, by "
            f"{1e3 * self.largest:.1f} mm at most; new changes of curvature sign {self.before} -> "
            f"{self.after}"
        )
        lines = ", ".join(f"{name} ({was} -> {now})" for name, was, now in self.lines)
        return f"{told}, left on {lines}" if lines else told


def fair_followers(edit: Transaction, parent: ParentLines, within: float) -> FairedFollowers:
    """Fair the followers of a hull that a map has carried, as further stages of its edit.

    Parameters
    ----------
    edit : Transaction
        The edit; the stage of the map has ended.
    parent : ParentLines
        The hull before.
    within : float, m
        How far points may move.
    """
    first = best = found = _Judged.of(edit.state, parent)
    keep, kept, steps, led = edit.stages, list[Step](), list[Step](), set[str]()
    closers = mending_points(edit.state)
    for part in _PARTS:
        if not best.may_gain:
            break
        edit.take_back(keep)
        found, steps, tighter = first, [], dict[str, float]()
        for _ in range(_PASSES):
            search = _Search.of(edit.state, parent, first, found, part * within, steps, tighter)
            step, stages = search.step(), edit.stages
            led |= search.led
            made = _carried(edit, step, closers) if step else ()
            if not made:
                break
            now = _Judged.of(edit.state, parent)
            too_large = now.sharper(first)
            if now.count >= found.count or too_large:
                edit.take_back(stages)
                if now.count >= found.count or too_large.keys() <= tighter.keys():
                    break
                tighter |= too_large
                continue
            found, steps = now, [*steps, *made]
            if not found.may_gain:
                break
        if found.count < best.count:
            best, kept = found, steps
    if best is not found:
        edit.take_back(keep)
        for step in kept:
            _carry(edit, step)
    return _told(within, kept, led, first, best)


def repeat_fairing(
    edit: Transaction, parent: ParentLines, before: FairedFollowers
) -> FairedFollowers:
    """Move followers as they were moved when a map that was nearly the same had carried the hull.

    What the search finds hangs on counts and may jump; so it is made once, and values are corrected
    about what it has found.

    Raises
    ------
    RefusedEditError
        A line would fold or lose its order.
    """
    for step in before.steps:
        _carry(edit, step)
    now = _Judged.of(edit.state, parent)
    alone = before.before if before.steps else now.count
    return attrs.evolve(before, before=alone, after=now.count, lines=now.lines)


def _told(
    within: float, steps: list[Step], led: set[str], first: _Judged, best: _Judged
) -> FairedFollowers:
    """Say what was done; points that are `led` follow others, as computed ones do."""
    moves = [move for key, move in _summed(steps).items() if key not in led]
    size = [float(np.sqrt(each @ each)) for each in moves]
    return FairedFollowers(
        within, len(size), max(size, default=0.0), first.count, best.count, best.lines,
        tuple(steps),
    )  # fmt: skip


def _summed(steps: list[Step]) -> dict[str, FloatArray]:
    found = dict[str, FloatArray]()
    for step in steps:
        for key, move in step.items():
            found[key] = found[key] + move if key in found else move
    return found


def _carry(edit: Transaction, step: Step) -> None:
    """Move the points of a step that there are."""
    state = edit.state
    rows = np.array(
        [row for row in state.live("rows").tolist() if str(state.rows.key[row]) in step], np.int64
    )
    if len(rows):
        moves = np.array([step[str(state.rows.key[row])] for row in rows.tolist()])
        edit.pending.ask(FieldMoves).fields.append(SolvedField(rows, moves))
        edit.end_stage()


def _carried(
    edit: Transaction, step: Step, closers: Mapping[int, MendingPoint]
) -> tuple[Step, ...]:
    """Carry a step, and then what closes gaps to where these are; nothing where it is refused."""
    stages = edit.stages
    try:
        _carry(edit, step)
        closing = _closing(edit.state, closers)
        if closing:
            _carry(edit, closing)
    except RefusedEditError:
        edit.take_back(stages)
        return ()
    return (step, closing) if closing else (step,)


def _closing(state: HullState, closers: Mapping[int, MendingPoint]) -> Step:
    """Give the moves of adopted points to where the other curve passes now.

    They have gone along to first order only, and slide where the two curves meet at a small angle.
    """
    table, found = state.rows, dict[str, FloatArray]()
    for row, closer in closers.items():
        there = table.alive[row] and table.alive[closer.crossing]
        if there and table.gap[closer.crossing] > _OPEN * state.tolerances.factor:
            found[str(table.key[row])] = (
                table.spot[closer.crossing, 1 - closer.side] - table.xyz[row]
            )
    return found


# --------------------------------------------------------------------------------------
# How a hull compares with its parent.


@attrs.frozen(eq=False)
class _Judged:
    """The lines of a hull beside those of the parent.

    `inner` are the keys of lines that are no boundary curves.
    """

    compared: FairnessComparison
    inner: frozenset[str]

    @classmethod
    def of(cls, state: HullState, parent: ParentLines) -> _Judged:
        lines = state.live("lines")
        inner = lines[state.lines.boundary[lines] < 0].tolist()
        after = measure_fairness(state, like=parent.fairness)
        keys = frozenset(str(state.lines.key[line]) for line in inner)
        return cls(compare_fairness(parent.fairness, after), keys)

    @property
    def count(self) -> int:
        """How many changes of sign lines have more, over those that have more."""
        return sum(max(each.added, 0) for each in self.compared.lines)

    @property
    def may_gain(self) -> bool:
        """Whether a line that can be faired has more."""
        return any(each.added > 0 and each.before.key in self.inner for each in self.compared.lines)

    @property
    def lines(self) -> tuple[tuple[str, int, int], ...]:
        """Lines that have more: name, changes in the parent, and now."""
        return tuple(
            (each.name, each.before.sign_changes, each.after.sign_changes)
            for each in self.compared.lines if each.added > 0
        )  # fmt: skip

    @property
    def changes(self) -> dict[str, int]:
        """Changes of sign by line."""
        return {each.before.key: each.after.sign_changes for each in self.compared.lines}

    @property
    def combs(self) -> dict[str, float]:
        """Comb integrals by line, 1/m3."""
        return {each.before.key: each.after.comb for each in self.compared.lines}

    def limits(self) -> dict[str, float]:
        """Give how large combs may become, by line, 1/m3, if this is what the map alone made."""
        return {
            each.before.key: np.inf if each.before.is_straight
            else max(_COMB * each.before.comb, _LARGER * each.after.comb)
            for each in self.compared.lines
        }  # fmt: skip

    def sharper(self, first: _Judged) -> dict[str, float]:
        """Give by what factor combs of lines are larger than they may become."""
        limits = first.limits()
        parts = {key: size / limits.get(key, np.inf) for key, size in self.combs.items()}
        return {key: part for key, part in parts.items() if part > 1.0}


# --------------------------------------------------------------------------------------
# The search of one pass.


@attrs.define(eq=False)
class _Search:
    """The search for displacements that leave no line more changes of sign than the parent's.

    Attributes
    ----------
    state : HullState
        The hull as it is.
    every, ties : BattenProblem, (k, c) sparse
        The points that may move, and what they do with those that move by themselves.
    problem : BattenProblem
        The points that move by themselves.
    bent : BentCurves or None
        The plane curves that they bend; None if there are none.
    lines : (m,) int
        The line of each curve, as a place in `keys`.
    keys : tuple of str
        Keys of these lines.
    low, high : (n,), 1/m
        Least and greatest curvature of the parent about the place of each knot.
    kept : KeptSigns
    parent, rest, limit, spare : (l,)
        By line: changes of sign in the parent, and those of curves that do not bend; how large the
        comb may become, 1/m3, and what is in such curves.
    """

    state: HullState
    every: BattenProblem
    ties: csr_array
    problem: BattenProblem
    bent: BentCurves | None
    lines: IntArray
    keys: tuple[str, ...]
    low: FloatArray
    high: FloatArray
    kept: KeptSigns
    parent: IntArray
    rest: IntArray
    limit: FloatArray
    spare: FloatArray

    @classmethod
    def of(
        cls, state: HullState, parent: ParentLines, first: _Judged, now: _Judged, within: float,
        steps: list[Step], tighter: Mapping[str, float],
    ) -> _Search:  # fmt: skip
        """Lay out the search on a hull that some steps have moved already.

        Combs of lines are held `tighter` by a factor where one that was carried out was too large.
        """
        every = _movable(state, parent)
        chosen, ties = mending_ties(state, every)
        problem = every.tied(chosen, ties)
        curves = _bending(state, parent, problem)
        gone, reach = _gone(state, problem, steps), within * problem.freedom
        kept = KeptSigns(
            problem, _SCALE * state.tolerances.factor, reach, -reach - gone, reach - gone
        )
        line_keys = [str(state.lines.key[state.line_of(curve)]) for curve in curves]
        keys = tuple(dict.fromkeys(line_keys))
        lines = np.array([keys.index(key) for key in line_keys], np.int64)
        was = np.array([parent.fairness[key].sign_changes for key in keys], np.int64)
        limits = first.limits()
        limit = np.array([_FORETOLD * limits[key] / tighter.get(key, 1.0) ** 2 for key in keys])
        none = np.zeros(len(keys))
        found = cls(
            state, every, ties, problem, None, lines, keys, none, none, kept, was,
            np.zeros_like(was), limit, none,
        )  # fmt: skip
        if not len(curves) or not len(problem.rows):
            return found
        normals = np.array([parent.fairness[key].views[0] for key in line_keys])
        found.bent = BentCurves.of(state, problem, np.array(curves, np.int64), normals)
        found.low, found.high = _ranges(state, parent, curves, normals)
        changes, combs = found._counted(np.zeros(len(problem.rows)))
        found.rest = np.array([now.changes[key] for key in keys], np.int64) - changes
        found.spare = np.array([now.combs[key] for key in keys]) - combs
        return found

    @property
    def led(self) -> set[str]:
        """Keys of the points that others lead."""
        rows = np.setdiff1d(self.every.rows, self.problem.rows)
        return {str(self.state.rows.key[row]) for row in rows.tolist()}

    def step(self) -> Step:
        """Give the best step that is found; empty where there is none."""
        delta = self.ties @ self._found()
        state, some = self.state, np.flatnonzero(delta != 0.0)
        moves = self.every.moves[some] * delta[some][:, None]
        rows = self.every.rows[some].tolist()
        return {str(state.rows.key[row]): move for row, move in zip(rows, moves, strict=True)}

    def _found(self) -> FloatArray:
        """Give displacements (k,), m, with the fewest new changes that are foretold."""
        still = np.zeros(len(self.problem.rows))
        if self.bent is None:
            return still
        first = self.bent.rates(still)
        known = self.low[first.knot] > -DEAD_BAND, self.high[first.knot] < DEAD_BAND
        best, least = self._searched(first, *known)
        if least:
            # Where the map has given a line another shape, the signs of the parent are no measure.
            other, fewer = self._searched(first, *self._without_small_waves(first))
            best = other if fewer < least else best
        return best

    def _searched(self, first: CurvatureRates, up: _Bools, down: _Bools) -> tuple[FloatArray, int]:
        """Search; where `up` (b,) the curvature is not to be negative, where `down` not positive.

        Gives displacements (k,), m, and how many new changes are foretold with them.
        """
        assert self.bent is not None, "curves bend"
        delta = best = np.zeros(len(self.problem.rows))
        least, vain, rates = sys.maxsize, 0, first
        weight, stiffer = np.ones(len(self.keys)), np.ones(len(self.keys))
        ever = np.zeros(len(self.keys), np.bool_)
        digit = _DIGIT * self.state.tolerances.factor
        for _ in range(_TURNS):
            gained, sharp = self._wanting(np.round(delta / digit) * digit)
            count = int(np.maximum(gained, 0).sum())
            vain += 1
            if count < least and not sharp.any():
                vain, least, best = 0, count, np.round(delta / digit) * digit
            if (not count and not sharp.any()) or vain == _VAIN:
                break
            weight[(gained > 0) & ever] *= _HEAVIER
            stiffer[sharp] *= _STIFFER
            ever |= gained > 0
            rates = self.bent.rates(delta) if delta.any() else first
            delta = self._answer(rates, first.value, (up, down), ever, weight, stiffer, delta)
        return best, least

    def _without_small_waves(self, first: CurvatureRates) -> tuple[_Bools, _Bools]:
        """Say where curvature has to stay of its sign, and of that of the neighbours in waves.

        A wave is a run of one sign; the smallest of a line, by how much they turn, are to go, until
        it has no more changes of sign than the parent.
        """
        assert self.bent is not None, "curves bend"
        count = len(first.value) // 2  # starts of all segments, then ends
        order = np.arange(2 * count).reshape(2, count).T.ravel()
        owner = self.bent.owner[first.knot[order]]
        place = self.bent.lofted(np.zeros(len(self.problem.rows))).xyz
        chord = place[first.knot[count:]] - place[first.knot[:count]]
        turn = np.abs(first.value[order]) * np.sqrt((chord * chord).sum(axis=1)).repeat(2)
        aimed = np.zeros(2 * count, np.int8)
        for line, most in enumerate((self.parent - self.rest).tolist()):
            some = np.flatnonzero(self.lines[owner] == line)
            aimed[order[some]] = signs_without_waves(
                first.value[order[some]], turn[some], owner[some], most
            )
        return aimed > 0, aimed < 0

    def _answer(
        self, rates: CurvatureRates, first: FloatArray, sides: tuple[_Bools, _Bools],
        ever: _Bools, weight: FloatArray, stiffer: FloatArray, delta: FloatArray,
    ) -> FloatArray:  # fmt: skip
        """Solve about displacements (k,), m, for others that keep curvature within bounds."""
        assert self.bent is not None, "curves bend"
        line = self.lines[self.bent.owner[rates.knot]]
        inner, outer = _WITHIN * DEAD_BAND, _OTHERS * DEAD_BAND
        high = np.where(ever[line], inner, np.maximum(outer, first))
        low = np.where(ever[line], -inner, np.minimum(-outer, first))
        felt = np.diff(rates.rate.indptr) > 0
        down, up = (np.flatnonzero(felt & side) for side in sides)
        rate = csr_array(vstack([rates.rate[up], -rates.rate[down]]))
        beyond = np.concatenate([(rates.value - high)[up], (low - rates.value)[down]])
        cost = weight[line[np.concatenate([up, down])]] / (_SHARP * DEAD_BAND) ** 2
        heavy = dict(zip(self.keys, stiffer.tolist(), strict=True))
        stiff = np.array([
            heavy.get(str(self.state.lines.key[self.state.line_of(curve)]), 1.0)
            for curve in self.problem.curve.tolist()
        ])  # fmt: skip
        return self.kept.answer(stiff, rate, beyond - rate @ delta, cost, delta)

    def _counted(self, delta: FloatArray) -> tuple[IntArray, FloatArray]:
        """Count changes of sign, and give the combs, of the curves that bend, by line."""
        assert self.bent is not None, "curves bend"
        batch, normals, count = self.bent.lofted(delta), self.bent.normals, len(self.keys)
        changes = sampled_curvatures(batch, normals).sign_changes(DEAD_BAND)
        combs = np.bincount(self.lines, comb_integrals(batch, normals), count)
        return np.bincount(self.lines, changes, count).astype(np.int64), np.asarray(combs, float)

    def _wanting(self, delta: FloatArray) -> tuple[IntArray, np.typing.NDArray[np.bool_]]:
        """Give how many changes lines gain, and which combs become too large."""
        changes, combs = self._counted(delta)
        return changes + self.rest - self.parent, combs + self.spare > self.limit


def _movable(state: HullState, parent: ParentLines) -> BattenProblem:
    """Give the problem of the points that the map has moved, less those of boundary curves."""
    problem = net_battens(state)
    curve = state.rows.curve.data[problem.rows]
    line = np.where(curve >= 0, state.curves.line.data[np.maximum(curve, 0)], -1)
    outer = ((line >= 0) & (state.lines.boundary.data[np.maximum(line, 0)] >= 0)).any(axis=1)
    moved = np.array([
        parent.places.get(str(state.rows.key[row])) != at
        for row, at in zip(
            problem.rows.tolist(), map(tuple, state.rows.xyz[problem.rows].tolist()), strict=True
        )
    ], np.bool_)  # fmt: skip
    return problem.part(np.flatnonzero(moved & ~outer))


def _bending(state: HullState, parent: ParentLines, problem: BattenProblem) -> list[int]:
    """Give the plane curves that the parent has too, and that points bend; no boundary curves."""
    felt = np.diff(problem.rates.indptr) > 0
    found = list[int]()
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        before = parent.fairness.get(str(state.lines.key[line]))
        known = before is not None and len(before.views) == 1
        if (
            known and state.lines.planar[line] and state.lines.boundary[line] < 0
            and str(state.curves.key[curve]) in parent.shapes
            and felt[state.curves.rows.data[curve]].any()
        ):  # fmt: skip
            found.append(curve)
    return found


def _gone(state: HullState, problem: BattenProblem, steps: list[Step]) -> FloatArray:
    """Give how far points (k,) have gone along the normal by some steps, m."""
    gone, none = _summed(steps), np.zeros(3)
    keys = [str(state.rows.key[row]) for row in problem.rows.tolist()]
    moved = np.array([gone.get(key, none) for key in keys]).reshape(-1, 3)
    square = (problem.moves * problem.moves).sum(axis=1)
    found: FloatArray = (moved * problem.moves).sum(axis=1) / square
    return found


def _ranges(
    state: HullState, parent: ParentLines, curves: list[int], normals: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give least and greatest curvature of the parent about the knots of curves, (n,), 1/m."""
    low, high = list[FloatArray](), list[FloatArray]()
    for curve, normal in zip(curves, normals, strict=True):
        shape, keys = parent.shapes[str(state.curves.key[curve])]
        knot = state.spline(curve).knot
        at = _places_in_parent(state, curve, knot, shape, keys)
        if at is None:
            low.append(np.full(len(knot), -np.inf))
            high.append(np.full(len(knot), np.inf))
            continue
        before, after = np.concatenate([at[:1], at[:-1]]), np.concatenate([at[1:], at[-1:]])
        # half of the way to the neighbour before, and all of that to the one after
        back, forth = 0.5 * (at - before), 0.5 * (after - at)
        places = at[:, None] + np.where(_PLACES < 0.0, back[:, None], forth[:, None]) * _PLACES
        found = _curvature_at(shape, normal, places)
        low.append(found.min(axis=(1, 2)))
        high.append(found.max(axis=(1, 2)))
    return np.concatenate(low), np.concatenate(high)


def _places_in_parent(
    state: HullState, curve: int, knot: FloatArray, shape: SplineBatch, keys: tuple[str, ...]
) -> FloatArray | None:
    """Give the parameters on the parent's curve that answer knots; None where nothing tells."""
    place = {key: index for index, key in enumerate(keys)}
    known, there = list[int](), list[int]()
    for index, row in enumerate(state.curves.rows.data[curve].tolist()):
        found = place.get(str(state.rows.key[row]), -1)
        if found > (there[-1] if there else -1):
            known.append(index)
            there.append(found)
    if len(known) < 2:
        return None
    at: FloatArray = np.interp(knot, knot[known], shape.knot[there])
    return at


def _curvature_at(shape: SplineBatch, normal: FloatArray, places: FloatArray) -> FloatArray:
    """Give the curvature of a curve at parameters (n, p), on both sides of knots, (n, p, 2)."""
    start, end = end_curvatures(shape, normal[None])
    found = list[FloatArray]()
    for before in (
        np.searchsorted(shape.knot, places, "left"), np.searchsorted(shape.knot, places, "right")
    ):  # fmt: skip
        segment = np.clip(before - 1, 0, len(start) - 1)
        part = (places - shape.knot[segment]) / np.diff(shape.knot)[segment]
        found.append((1.0 - part) * start[segment] + part * end[segment])
    return np.stack(found, axis=2)

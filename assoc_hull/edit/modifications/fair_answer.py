"""Fair edits: what is asked of a few points is held, and the hull around them answers fairly.

One linear solve stands in the place of the bell of a pull or the blend of a re-shaped curve: the
least change of the batten residuals of all lines near by (`analysis.fairness.fair_solution`). How
far it reaches is searched for: the smallest radius whose net, as it would be published, has no new
change of the sign of curvature in any line. All that one edit asks for is answered at once, after
all else that it asks for, so the order of its modifications changes no bit.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Protocol

import attrs
import numpy as np

from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.analysis.fairness.fair_solution import LeastChange
from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.displacement_field import (
    PointDisplacements,
    PullField,
    SolvedField,
    level_with_flats,
    on_flat,
    on_profile,
    quintic_fade,
    station_spacing,
    sub_step_count,
)
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.edit.led_lines import LineLed, NetBefore, Stretch, find_stretch, second_doses
from assoc_hull.edit.net_battens import fairable_rows, net_battens
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, CoincidentPointsError, PointRoleError, RefusedEditError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Sort
from assoc_hull.model.network import curve_data
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["FairAnswer", "PullAsked", "ShapeAsked"]

_SCALES = (1e-3, 0.25e-3, 0.05e-3)
"""Of the residuals, m, in the order in which they are tried."""

_TRIALS = 14
"""So many answers are carried out at most, before the best of them is taken."""

_HEAVIER = (6.0, 6.0, 6.0, 2.5, 2.5, 1.6, 1.6)
_GENTLER = (6.0, 6.0, 2.5, 2.5, 1.6, 1.6, 1.3, 1.3, 1.15, 1.15)
"""How much more lines weigh that gained a sign change, one solve after the other, before an answer
is carried out. The later ones find what lies between two lines that gain in turns; the gentler
series is gone through where the other has found nothing."""

_AGAIN, _NEARLY = 5, 0.01
"""So often a pull of a point that is carried is mended, until it comes so near to its goal."""

_LOBES = (0.2, 1.0)
"""Least turns, degrees, of the lobes that are counted."""

_ROUNDED = 6
"""Decimals of displacements, m: so the last bits of a solver change nothing."""

_STRAIGHT = 540.0
"""A dent of depth d in a straight line turns by less than the smaller lobe over this times d."""


# --------------------------------------------------------------------------------------
# What is asked.


class Asked(Protocol):
    """Displacements of points that an edit asks for, and how the answer fades around them."""

    @property
    def name(self) -> str:
        """What was asked for, as errors call it."""

    @property
    def rows(self) -> IntArray:
        """The points."""

    def lacking(self, state: HullState) -> float:
        """Give by what what is asked of the points is to be multiplied; 1 where it is there."""

    @property
    def point(self) -> int:
        """The point that was named, or one of them."""

    def times(self, factor: float) -> Asked:
        """Ask for that."""

    def goals(self, state: HullState, moves: FloatArray) -> FloatArray:
        """Give where they are to come, (k, 3), m; `moves` (k, 3) are theirs for 1 m of normal."""

    def fade(self, state: HullState, xyz: FloatArray, turn: int) -> FloatArray:
        """Give how far points (n, 3), m, may go, of 1, at the radius of a turn of the search."""

    def reach(self, state: HullState, turn: int) -> str:
        """Say what the radius is."""


_FACTORS = (1.0, 1.5, 2.25, 3.4, 5.0, 7.6, 12.0)


@attrs.frozen(eq=False)
class PullAsked:
    """A pull: points come out by an amount along the normal.

    Attributes
    ----------
    name : str
        The address of the point.
    rows : (k,) int
        The point, or those that hold the curves that carry it.
    field : PullField
        The pull; its radius is that of the first turn.
    amount : float, m
        By how much the points are to come out, so that the point comes as far as it is pulled.
    stations : float, m
        How far the answer reaches along the length at least: where sections stand far apart, the
        radius reaches none of them, and a point that comes out alone is too flat a dent to be seen.
    """

    name: str
    rows: IntArray
    field: PullField
    amount: float
    stations: float = 0.0

    def lacking(self, state: HullState) -> float:
        """Give the pull over how far a point that is carried has come."""
        if self.field.row in self.rows:
            return 1.0
        reached = self.field.reached(state)
        return self.field.amount / reached if reached * self.field.amount > 0.0 else 1.0

    @property
    def point(self) -> int:
        """The point that is pulled."""
        return self.field.row

    def times(self, factor: float) -> PullAsked:
        """Ask for so many times the displacement."""
        return attrs.evolve(self, amount=factor * self.amount)

    def goals(self, state: HullState, moves: FloatArray) -> FloatArray:
        """Give where the points are to come, (k, 3), m."""
        found: FloatArray = state.rows.xyz[self.rows] + self.amount * moves
        return found

    def fade(self, state: HullState, xyz: FloatArray, turn: int) -> FloatArray:
        """Fade along the length and the girth."""
        (length, around), step = self._radius(turn), xyz - self.field.place
        girth = np.sqrt(step[:, 1] * step[:, 1] + step[:, 2] * step[:, 2])
        return quintic_fade(step[:, 0] / length) * quintic_fade(girth / around)

    def _radius(self, turn: int) -> tuple[float, float]:
        factor = _FACTORS[min(turn, len(_FACTORS) - 1)]
        along, girth = self.field.radius
        return factor * max(along, self.stations), factor * girth

    def reach(self, state: HullState, turn: int) -> str:
        """Say the radii."""
        along, girth = self._radius(turn)
        return f"{along:.3g} x {girth:.3g} m"


_RADII = (1.0, 1.5, 2.5, 4.0, 6.0, 9.0, 14.0)
"""m, of a ship of 100 m and more."""

_BENT = 0.02
"""Part of a stretch by which its ends may come out otherwise than foretold."""

_FULL_SIZE = 100.0
_RIM, _LEAST = 0.15, 0.02


@attrs.frozen(eq=False)
class ShapeAsked:
    """A line that is led through given places within a stretch.

    Attributes
    ----------
    name : str
        The line.
    rows, to : (k,) int, (k, 3), m
        Points of the line, and where they are to come.
    curve : int
        The curve.
    stretch : (float, float), m
        Where it may change: x; z of a section.
    spacing : float or None, m
        Of a section: the radii are multiples of three such spacings along the length.
    girth : bool
        Whether the stretch is measured along the section.
    rim : (float, float) or None, m
        How far from each end it fades; None: a part of the stretch.
    """

    name: str
    rows: IntArray
    to: FloatArray
    curve: int
    stretch: tuple[float, float]
    spacing: float | None
    girth: bool = False
    rim: tuple[float, float] | None = None
    _known: dict[bytes, tuple[FloatArray, FloatArray]] = attrs.field(factory=dict, init=False)

    @property
    def point(self) -> int:
        """One of its points."""
        return int(self.rows[0])

    def lacking(self, state: HullState) -> float:
        """Nothing: the points land in their places."""
        return 1.0

    def times(self, factor: float) -> ShapeAsked:
        """Ask for the same."""
        return self

    def goals(self, state: HullState, moves: FloatArray) -> FloatArray:
        """Give the places."""
        return self.to

    def fade(self, state: HullState, xyz: FloatArray, turn: int) -> FloatArray:
        """Fade away from the line, and towards the ends of the stretch."""
        low, high = self.stretch
        place, away = self._measured(state, xyz)
        inside = (place > low) & (place < high)
        first, last = (_RIM * (high - low),) * 2 if self.rim is None else self.rim
        end = np.minimum((place - low).clip(0.0) / first, (high - place).clip(0.0) / last)
        along = np.maximum(1.0 - quintic_fade(np.minimum(end, 1.0)), _LEAST)
        return np.where(inside, quintic_fade(away / self._radius(state, turn)) * along, 0.0)

    def _measured(self, state: HullState, xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give where points lie along the stretch, and how far from the line; once for places."""
        places = xyz.tobytes()
        if places not in self._known:
            self._known.clear()
            self._known[places] = self._along(state, xyz), self._away(state, xyz)
        return self._known[places]

    def _along(self, state: HullState, xyz: FloatArray) -> FloatArray:
        """Give where points lie along the stretch."""
        if not self.girth:
            place: FloatArray = xyz[:, 0 if self.spacing is None else 2]
            return place
        seen, spline = xyz.copy(), state.spline(self.curve)
        seen[:, 0] = spline.xyz[0, 0]
        return closest_points(spline, 0, seen)[0]

    def _away(self, state: HullState, xyz: FloatArray) -> FloatArray:
        """Give the distance from the line, seen along x at the same x; along x of a section."""
        course = sample(state.spline(self.curve), 16)[1]
        if self.spacing is not None:
            apart: FloatArray = np.abs(xyz[:, 0] - course[0, 0])
            return apart
        here = course[(course[:, 0] >= self.stretch[0]) & (course[:, 0] <= self.stretch[1])]
        here = here if len(here) else course
        step = xyz[:, None, :] - here
        girth = np.sqrt(step[:, :, 1] ** 2 + step[:, :, 2] ** 2)
        # the place at the same x; of several, as where a line turns back, the nearest
        nearest = np.argmin(np.abs(step[:, :, 0]) + 1e-3 * girth, axis=1)
        found: FloatArray = girth[np.arange(len(xyz)), nearest]
        return found

    def _radius(self, state: HullState, turn: int) -> float:
        if self.spacing is not None:
            return 3.0 * self.spacing * _FACTORS[min(turn, len(_FACTORS) - 1)]
        return _RADII[turn] * min(1.0, state.particulars.length / _FULL_SIZE)

    def reach(self, state: HullState, turn: int) -> str:
        """Say the radius."""
        if self.spacing is not None:
            factor = _FACTORS[min(turn, len(_FACTORS) - 1)]
            return f"{3.0 * self.spacing * factor:.1f} m along the length"
        return f"{self._radius(state, turn):g} m"


# --------------------------------------------------------------------------------------
# The answer.


@attrs.frozen(eq=False)
class _Candidate:
    """An answer of one radius, before it is carried out; `count` sign changes are foretold."""

    turn: int
    scale: float
    fade: FloatArray
    weight: FloatArray
    delta: FloatArray
    count: int


@attrs.frozen(eq=False)
class _Trial:
    """An answer that was carried out.

    `gained` is by curve: sign changes before and now at the smaller lobe, or at the larger where
    the smaller has none more, and how many came at both together.
    """

    answer: _Candidate
    gained: Mapping[int, tuple[int, int, int]]

    @property
    def count(self) -> int:
        """How many sign changes came."""
        return sum(each[2] for each in self.gained.values())


def _better(one: _Trial | None, other: _Trial | None) -> _Trial | None:
    """Give the trial with fewer new sign changes; of two alike the first."""
    if one is None or other is None:
        return other if one is None else one
    return other if other.count < one.count else one


@attrs.define(eq=False)
class FairAnswer:
    """All that one edit asks to be answered fairly; carried out when all else has been.

    Attributes
    ----------
    edit : Transaction
        The edit.
    asked : list of Asked
        What is asked, in the order of the calls.
    leads : list of LineLed
        The curves that lead; what is asked of them is known when all else has been carried out.
    """

    edit: Transaction
    asked: list[Asked] = attrs.field(factory=list)
    leads: list[LineLed] = attrs.field(factory=list)

    @classmethod
    def of(cls, edit: Transaction) -> FairAnswer:
        """Give that of an edit, made when it is first asked for."""
        found = edit.pending.answer
        if not isinstance(found, FairAnswer):
            found = edit.pending.answer = cls(edit)
        return found

    @property
    def idle(self) -> bool:
        """Whether all that is asked of points is so already."""
        xyz = self.edit.state.rows.xyz
        return not self.asked and all((xyz[each.rows] == each.to).all() for each in self.leads)

    def reached(self) -> Iterator[tuple[str, IntArray]]:
        """Give what is asked in words, with the points that the widest answer to it may move."""
        state = self.edit.state
        free = fairable_rows(state)
        last, xyz = max(len(_RADII), len(_FACTORS)) - 1, state.rows.xyz[free]
        for each in self.asked:
            title = "pull at" if isinstance(each, PullAsked) else "re-shaping of"
            inside = each.fade(state, xyz, last) != 0.0
            yield f"the {title} {each.name}", Node.point(np.concatenate([each.rows, free[inside]]))
        for lead in self.leads:
            widest = _widest(state, lead, free)
            inside = np.ones(len(free), np.bool_)
            if widest is not None:
                inside = widest.fade(state, xyz, last) != 0.0
            yield f"the lead of {lead.name}", Node.point(np.concatenate([lead.rows, free[inside]]))

    def goals(self) -> Mapping[int, FloatArray]:
        """Give where the points of curves that lead are to come."""
        return {row: goal for each in self.leads for row, goal in each.goals().items()}

    def carry_out(self) -> None:
        """Search for the answer, and leave it as the last stage of the edit.

        Raises
        ------
        PointRoleError
            A point that is asked for can move almost along the hull only.
        BadInputError
            One is asked to be in two places.
        RefusedEditError
            As the update refused the last answer that was tried.
        """
        self.edit.end_stage()
        # What was asked plainly in the same edit is there already: it is no gain of the answer's.
        before, state = _shapes(self.edit.state), self.edit.state
        net, stretches = NetBefore.of(state), self._lead()
        every = np.concatenate([each.rows for each in self.asked])
        if not state.rows.alive[every].all():
            raise self._gone()
        self._refuse_changed(np.concatenate([every, [each.point for each in self.asked]]))
        self.asked.sort(key=_order)
        keep, lacks = self.edit.stages, 1.0
        best: _Trial | None = None
        for _ in range(_AGAIN):
            search = _Search.of(self.edit, self.asked, before)
            if not search.moves:
                names = ", ".join(dict.fromkeys(each.name for each in self.asked))
                self.edit.notes.append(f"{names}: the hull is there already, no point moves")
                return
            best = search.find(best)
            search.carry_out(best)
            # Several pulls add: then none of their points goes where one of them pulls.
            lacks = self.asked[0].lacking(state) if len(self.asked) == 1 else 1.0
            if abs(lacks - 1.0) <= _NEARLY:
                self.edit.notes += search.notes(best)
                self._tell(net, stretches)
                return
            # A point that is carried comes less far than those that hold its curves.
            self.asked = [each.times(lacks) for each in self.asked]
            self.edit.take_back(keep)
        short = (
            f"{self.asked[0].name} came {100.0 / lacks:.0f} % of the way along the normal that was "
            "asked: pull a point beside it, or by less"
        )
        raise RefusedEditError(self.edit.name, (short,))

    def _lead(self) -> list[Stretch]:
        """Ask for what leads; give the stretches of all."""
        if not self.leads:
            return []
        state = self.edit.state
        rows = np.unique(np.concatenate([each.rows for each in self.leads]))
        self._refuse_changed(rows)
        for each in self.leads:
            if not np.isin(each.rows, state.curves.rows.data[each.curve]).all():
                raise self._gone()
        free = fairable_rows(state)
        self.leads.sort(key=lambda each: (each.rows.tolist(), str(each.span)))
        stretches = [find_stretch(state, each, rows, free) for each in self.leads]
        pairs = zip(self.leads, stretches, strict=True)
        self.asked += [_led_shape(state, each, found) for each, found in pairs]
        return stretches

    def _tell(self, net: NetBefore, stretches: list[Stretch]) -> None:
        """Tell the report what led, and what followed."""
        if not self.leads:
            return
        edit, state = self.edit, self.edit.state
        pairs = list(zip(self.leads, stretches, strict=True))
        edit.led = tuple(net.led(state, *each) for each in pairs)
        edit.followed = net.followed(state, self.leads)
        for (lead, stretch), led in zip(pairs, edit.led, strict=True):
            edit.notes += net.notes(state, lead, stretch, led)
        edit.notes.append(net.reach(state, self.leads))
        lines = {str(state.lines.key[state.line_of(each.curve)]): each.name for each in self.leads}
        edit.notes += second_doses(edit.document, lines)

    def _gone(self) -> BadInputError:
        """Give the error of a point that the same edit has taken away, or off its line."""
        what = "a point that is asked to move has gone in the same edit"
        return BadInputError(what, f"in the edit {self.edit.name!r}", "use two edits")

    def _refuse_changed(self, rows: IntArray) -> None:
        """Refuse points whose lines or role the same edit has changed, before or after it asked.

        Raises
        ------
        BadInputError
            Naming the first one.
        """
        state = self.edit.state
        was = self.edit.document.state.published()
        for row in np.unique(rows[rows < was.rows.count]).tolist():
            if was.rows.alive[row] and _stands(was, row) != _stands(state, row):
                raise BadInputError(
                    "a point is pulled or led fairly and its line or role is changed in one edit",
                    address(state, row), "use two edits",
                )  # fmt: skip


@attrs.define(eq=False)
class _Search:
    """The search for an answer: the smallest radius with no new sign change in any line."""

    edit: Transaction
    asked: list[Asked]
    counts: _SignChanges
    keep: int
    problem: BattenProblem
    least: LeastChange
    rows: IntArray
    places: FloatArray
    held: np.typing.NDArray[np.bool_]
    trials: int = 0
    shown: _Trial | None = None
    refusal: RefusedEditError | None = None

    @classmethod
    def of(cls, edit: Transaction, asked: list[Asked], before: dict[int, SplineBatch]) -> _Search:
        """Lay out the problem of a net, with all that is asked of it."""
        state = edit.state
        rows = np.unique(np.concatenate([each.rows for each in asked]))
        problem, normals = net_battens(state, rows), hull_normals(state)
        order = np.argsort(problem.rows)
        index = order[np.searchsorted(problem.rows[order], rows)]
        slack = problem.freedom[index] < state.tolerances.field_normal
        fixed = (on_profile(state) | on_flat(state))[rows]
        fixed |= level_with_flats(state, rows, normals[rows])
        for lost, kind in (
            (fixed, "on a flat or on the profile, which a fair answer leaves as they are"),
            (slack, "free almost along the hull only"),
        ):
            if lost.any():
                first = int(rows[lost][0])
                mine = next(each for each in asked if first in each.rows.tolist())
                name = mine.name
                if state.rows.sort[first] == Sort.CROSSING:
                    name = address(state, first)
                elif isinstance(mine, ShapeAsked):
                    x, y, z = state.rows.xyz[first].tolist()
                    name = f"the place of {name} at ({x:.3f}, {y:.3f}, {z:.3f}) m"
                ways = "ask for another point, or pin this one (lead=False in insert and move)"
                raise PointRoleError(name, kind, None, ways)
        places = _places(state, asked, rows, problem.moves[index])
        step = places - state.rows.xyz[rows]
        sub_step_count(state, PointDisplacements(rows, step, rows[:0]))  # refuses what is too far
        amount = (step * normals[rows]).sum(axis=1)
        return cls(
            edit, asked, _SignChanges(before), edit.stages, problem,
            LeastChange(problem, index, amount), rows, places,
            np.zeros(len(problem.rows), np.bool_),
        )  # fmt: skip

    @property
    def moves(self) -> bool:
        """Whether anything is asked for that is not so already."""
        return bool((self.places != self.edit.state.rows.xyz[self.rows]).any())

    def find(self, like: _Trial | None = None) -> _Trial:
        """Give the first answer that is fair, by scale and radius; else the fairest that is found.

        An answer like one to nearly the same is enough, if it is no less fair. Where each answer
        is refused, boundary curves are held: a line that ends beside a corner of two of them can
        come to end on the other one by a few mm of what dies out there.
        """
        if like is not None:
            trial = self._try(self._solved(like.answer, like.answer.weight))
            if trial is not None and trial.count <= like.count:
                return trial
        best = self._fairest()
        if best is None:
            self.held, self.trials = _on_boundaries(self.edit.state, self.problem.rows), 0
            best = self._fairest()
        if best is None:
            assert self.refusal is not None, "each answer was taken or refused"
            raise self.refusal
        return best

    def _fairest(self) -> _Trial | None:
        """Give the first fair answer, else the fairest that was tried; None where all are refused.

        What is foretold to be fair is tried at once; the others when none of these was, the
        fairest first.
        """
        best: _Trial | None = None
        waiting: list[_Candidate] = []
        for heavier, scale, turn in product((_HEAVIER, _GENTLER), _SCALES, range(len(_RADII))):
            candidate = self._foretold(turn, scale, heavier)
            if candidate is None:
                continue
            if candidate.count:
                waiting.append(candidate)
                continue
            best = self._tried(candidate, best)
            if best is not None and not best.count:
                return best
        for candidate in sorted(waiting, key=lambda each: each.count):
            if self.trials >= _TRIALS:
                break
            best = self._tried(candidate, best)
            if best is not None and not best.count:
                return best
        return best

    def _tried(self, candidate: _Candidate, best: _Trial | None) -> _Trial | None:
        """Carry a candidate out, and once more where lines gained; give the better of all."""
        trial = None if self.trials >= _TRIALS else self._try(candidate)
        best = _better(best, trial)
        if trial is not None and trial.count and self.trials < _TRIALS:
            weight = self._heavier(candidate.weight, trial.gained, _HEAVIER[0])
            best = _better(best, self._try(self._solved(candidate, weight)))
        return best

    def _foretold(self, turn: int, scale: float, heavier: tuple[float, ...]) -> _Candidate | None:
        """Give the answer of a radius that is foretold to gain the fewest sign changes.

        None where a curve could not pass the points, as where two come to lie in one place.
        """
        self._take_back()  # what is foretold starts from the hull as it is
        problem, state = self.problem, self.edit.state
        xyz = state.rows.xyz[problem.rows]
        fade = np.max([each.fade(state, xyz, turn) for each in self.asked], axis=0)
        fade[self.held] = 0.0
        weight = np.ones(len(problem.residual))
        best: _Candidate | None = None
        side: IntArray | None = None
        for times in (*heavier, 1.0):
            answer, side = self.least.answer(fade, scale, weight, side)
            delta = np.round(answer, _ROUNDED)
            try:
                gained = self.counts.gained(state, self._lofted(delta))
            except CoincidentPointsError as error:
                self.refusal = RefusedEditError(self.edit.name, (str(error),))
                return best
            count = sum(each[2] for each in gained.values())
            if best is None or count < best.count:
                best = _Candidate(turn, scale, fade, weight, delta, count)
            if not count:
                break
            weight = self._heavier(weight, gained, times)
        assert best is not None, "the first one is one"
        return best

    def _solved(self, candidate: _Candidate, weight: FloatArray) -> _Candidate:
        """Give the answer of the same radius with other weights."""
        answer, _ = self.least.answer(candidate.fade, candidate.scale, weight)
        delta = np.round(answer, _ROUNDED)
        return attrs.evolve(candidate, weight=weight, delta=delta)

    def _heavier(
        self, weight: FloatArray, gained: Mapping[int, object], times: float
    ) -> FloatArray:
        """Give residuals of curves that gained sign changes more weight."""
        mine = np.isin(self.problem.curve, list(gained))
        return np.where(mine, times * weight, weight)

    def _lofted(self, delta: FloatArray) -> dict[int, SplineBatch]:
        """Loft the curves whose points an answer moves, before anything is carried out."""
        problem, state = self.problem, self.edit.state
        xyz = problem.places(state.rows.xyz.data, delta)
        xyz[self.rows] = self.places
        moved = (xyz != state.rows.xyz.data).any(axis=1)
        live = state.live("curves").tolist()
        through = [curve for curve in live if moved[state.curves.rows.data[curve]].any()]
        if not through:
            return {}
        curves = np.array(through, np.int64)
        data = curve_data(state, curves)
        points = np.concatenate([state.curves.rows.data[curve] for curve in curves.tolist()])
        names = [str(state.curves.key[curve]) for curve in curves.tolist()]
        batch = loft(attrs.evolve(data, xyz=xyz[points]), names)
        return {curve: batch.curve(place) for place, curve in enumerate(curves.tolist())}

    def _try(self, candidate: _Candidate) -> _Trial | None:
        """Carry an answer out, in the place of the one before; None where it is refused."""
        self.trials += 1
        self._take_back()
        try:
            lofted = self._run(candidate.delta)
        except RefusedEditError as error:
            self.refusal = error
            self._take_back()
            return None
        gained = self.counts.gained(self.edit.state, lofted)
        self.shown = _Trial(candidate, gained)
        return self.shown

    def _take_back(self) -> None:
        self.edit.take_back(self.keep)
        self.shown = None

    def _run(self, delta: FloatArray) -> dict[int, SplineBatch]:
        """Run the update; give the curves that it lofted."""
        problem, pending = self.problem, self.edit.pending
        moved = (delta != 0.0) & ~np.isin(problem.rows, self.rows)
        own = self.places - self.edit.state.rows.xyz[self.rows]
        rows = np.concatenate([problem.rows[moved], self.rows])
        shift = np.concatenate([problem.moves[moved] * delta[moved][:, None], own])
        order = np.argsort(rows)
        field = SolvedField(rows[order], shift[order], self.rows, self.places)
        pending.ask(FieldMoves).fields.append(field)
        self.edit.end_stage()
        state = self.edit.state
        return {curve: state.spline(curve) for curve in self.edit.lofted().tolist()}

    def carry_out(self, best: _Trial) -> None:
        """Carry out the answer that was found, where it is not the last one that was tried."""
        if best is not self.shown:
            self._take_back()
            self._run(best.answer.delta)

    def notes(self, best: _Trial) -> Iterator[str]:
        """Say what the answer is, and which lines gained sign changes."""
        reach = ", ".join(
            dict.fromkeys(each.reach(self.edit.state, best.answer.turn) for each in self.asked)
        )
        deepest = float(np.abs(self.least.amount).max())
        far = np.abs(best.answer.delta) > 1e-3
        yield (
            f"answered fairly within {reach}: {int(far.sum())} points move by more than 1 mm, "
            f"{self.trials} tried"
        )
        if self.held.any():
            yield "boundary curves stay where they are: each answer that moved them was refused"
        yield from self._springs(best.answer.delta)
        state = self.edit.state
        for curve, (was, now, _) in best.gained.items():
            line = state.lines.name[state.line_of(curve)]
            yield (
                f"{line} has {now} changes of the sign of curvature, {was} before: where it is "
                f"straight, {1e3 * deepest:.0f} mm want a radius of {_STRAIGHT * deepest:.0f} m"
            )

    def _springs(self, delta: FloatArray) -> Iterator[str]:
        """Say how far a batten springs at most where points moved, before and now."""
        problem, state = self.problem, self.edit.state
        more = problem.matrix @ delta
        felt = np.flatnonzero(np.abs(more) > _FELT)
        if not len(felt):
            return
        was, now = np.abs(problem.residual[felt]), np.abs(problem.residual[felt] + more[felt])
        worst = int((now - was).argmax())
        line = state.lines.name[state.line_of(int(problem.curve[felt][worst]))]
        x, y, z = state.rows.xyz[int(problem.centre[felt][worst])].tolist()
        told = (
            f"a batten springs there by {1e3 * was.max():.1f} mm at most before, by "
            f"{1e3 * now.max():.1f} mm now; it rose most on {line} at ({x:.3f}, {y:.3f}, {z:.3f}) "
            f"m, from {1e3 * was[worst]:.1f} to {1e3 * now[worst]:.1f} mm"
        )
        deepest = float(np.abs(self.least.amount).max())
        if now[worst] > max(_SPRINGS * was[worst], _DEEP * deepest):
            told += ": more than twice; spread it over more points, or ask for less"
        yield told


def _on_boundaries(state: HullState, rows: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell which points (k,) lie on boundary curves."""
    curves = state.rows.curve[rows]
    boundary = state.lines.boundary[state.curves.line[np.maximum(curves, 0)]] >= 0
    one, other = ((curves >= 0) & boundary).T
    found: np.typing.NDArray[np.bool_] = one | other
    return found


def _stands(state: HullState, row: int) -> tuple[object, ...]:
    """Give what a point is, and the planes of its lines."""
    table = state.rows
    lines = [state.line_of(curve) for curve in table.curve[row].tolist() if curve >= 0]
    planes = [(state.lines.offset[line], *state.lines.normal[line].tolist()) for line in lines]
    return (
        int(table.role[row]), int(table.driver[row]), table.sort[row] == Sort.CROSSING,
        tuple(table.curve[row].tolist()), str(planes),
    )  # fmt: skip


def _order(each: Asked) -> tuple[str, list[int]]:
    """Give what requests are sorted by: their order in the edit is to change no bit."""
    return type(each).__name__, each.rows.tolist()


def _places(state: HullState, asked: list[Asked], rows: IntArray, moves: FloatArray) -> FloatArray:
    """Give where points (k,) are to come, (k, 3), m: pulls of one point add."""
    places, led = state.rows.xyz[rows], np.zeros(len(rows), np.bool_)
    now = places.copy()
    for each in asked:
        index = np.searchsorted(rows, each.rows)
        goals = each.goals(state, moves[index])
        if isinstance(each, ShapeAsked):
            twice = led[index] & (places[index] != goals).any(axis=1)
            twice |= ~led[index] & (places[index] != now[index]).any(axis=1)
            if twice.any():
                raise BadInputError(
                    "a point is asked to be in two places in one edit",
                    address(state, int(each.rows[twice][0])), "leave one of the two out",
                )  # fmt: skip
            places[index] = goals
            led[index] = True
        else:
            places[index] += goals - now[index]
    return places


def _led_shape(state: HullState, lead: LineLed, stretch: Stretch) -> ShapeAsked:
    """Give what a line that leads is asked for over a stretch."""
    spacing = None if stretch.along == "x" else station_spacing(state)
    girth = stretch.along == "girth"
    return ShapeAsked(
        lead.name, lead.rows, lead.to, lead.curve, stretch.bounds, spacing, girth, stretch.rim
    )


def _widest(state: HullState, lead: LineLed, free: IntArray) -> ShapeAsked | None:
    """Give a lead over a stretch that holds that which it will have; None of a new curve.

    Points that the same edit has made are not on the curve yet: their neighbours stand for them.
    """
    was, curve = state.published(), lead.curve
    if curve >= was.curves.count or not was.curves.alive[curve]:
        return None
    order, before = state.curves.rows.data[curve], was.curves.rows.data[curve]
    old = np.flatnonzero(np.isin(order, before))
    at = np.flatnonzero(np.isin(order, lead.rows))
    if not len(at) or not len(old):
        return None  # what was asked has gone in the same edit, which its end refuses
    beside = np.searchsorted(old, at)
    low, high = (beside - ~np.isin(at, old)).clip(0), beside.clip(None, len(old) - 1)
    rows = np.unique(order[old[np.concatenate([low, high])]])
    mine = attrs.evolve(lead, rows=rows, to=state.rows.xyz[rows])
    found = _led_shape(state, lead, find_stretch(was, mine, rows, free))
    # The point that is put beside the line bends it, and with it what is measured along it.
    begin, end = found.stretch
    more = _BENT * (end - begin)
    return attrs.evolve(found, stretch=(begin - more, end + more))


def _shapes(state: HullState) -> dict[int, SplineBatch]:
    """Give the curves as they are, by number."""
    live = state.live("curves").tolist()
    shapes = state.curves.spline.data
    return {curve: found for curve in live if (found := shapes[curve]) is not None}


_FELT = 1e-6
"""m: a residual that changes by less has not changed."""

_SPRINGS, _DEEP = 2.0, 0.25
"""A batten is told of that springs so many times as far, and by so much of what is asked."""


@attrs.frozen(eq=False)
class _SignChanges:
    """Counts the changes of the sign of curvature that curves gain over those before the edit."""

    before: dict[int, SplineBatch]
    _known: dict[int, tuple[int, ...]] = attrs.field(factory=dict)

    def gained(
        self, state: HullState, now: Mapping[int, SplineBatch]
    ) -> dict[int, tuple[int, int, int]]:
        """Give, by curve, how many there were and are at the lobe that gained, and what came."""
        curves = [curve for curve in now if curve in self.before]
        fresh = [curve for curve in curves if curve not in self._known]
        self._known.update(self._count(state, {curve: self.before[curve] for curve in fresh}))
        found: dict[int, tuple[int, int, int]] = {}
        for curve, counts in self._count(state, {curve: now[curve] for curve in curves}).items():
            was = self._known[curve]
            more = sum(max(new - old, 0) for new, old in zip(counts, was, strict=True))
            if more:
                lobe = next(i for i, old in enumerate(was) if counts[i] > old)
                found[curve] = was[lobe], counts[lobe], more
        return found

    @staticmethod
    def _count(state: HullState, splines: Mapping[int, SplineBatch]) -> dict[int, tuple[int, ...]]:
        if not splines:
            return {}
        curves = np.array(sorted(splines), np.int64)
        batch = SplineBatch.join([splines[curve] for curve in curves.tolist()])
        normals = plane_normals(state, curves)
        counts = np.stack([inflections(batch, normals, lobe)[0] for lobe in _LOBES], axis=1)
        return {
            curve: tuple(each) for curve, each in zip(curves.tolist(), counts.tolist(), strict=True)
        }

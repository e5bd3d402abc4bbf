"""What is carried out in sub-steps: fields of displacement, drawn runs, areas that are kept.

Runs that an edit draws: whether the hull has taken them, and the features that they are.

A run is asked for as places of points, kinds and a field. What an update does besides (a crossing
that comes, a gap that is mended) may put a point beside it: that refuses the edit.

Hollows that an edit spreads: whether their areas are kept once all has followed.
"""

from __future__ import annotations

from collections.abc import (
    Callable,
    Iterable,
    Iterator,
    Sequence,
)

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import rebase_adopted_points
from assoc_hull.edit.displacement_field import (
    CLOSE,
    FieldContext,
    NormalField,
    add_displacements,
    land_points,
    sub_step_count,
    unreached,
)
from assoc_hull.edit.followup.settle_features import circle_side, drawn_feature
from assoc_hull.edit.followup.take_up_definitions import detach_rows
from assoc_hull.edit.modification import Modification, Pending, Work
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.polylines.drawn_run import DrawnRun
from assoc_hull.geometry.splines.segments import derivative, evaluate
from assoc_hull.graph.journal import Journal, distinct
from assoc_hull.model.address import address
from assoc_hull.model.features import Feature
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.network import bits_differ
from assoc_hull.model.node import Node
from assoc_hull.model.program.structure import Program, Values
from assoc_hull.model.tables import HullState

__all__ = [
    "AskedRun",
    "DrawnRuns",
    "FieldMoves",
    "SpreadArea",
    "SpreadAreas",
    "area_beside",
    "features_on",
    "points_between",
]

_ON = 1e-9
"""Times `Tolerances.factor`: points of a run lie on it within this (m)."""

_SHORTEST = 1e-3
"""A straight run of this part of the length of the ship is a feature."""


@attrs.frozen(eq=False)
class AskedRun:
    """A run that is asked for.

    Attributes
    ----------
    curve : int
        Its curve.
    breaks : tuple of int
        The points at which its straight pieces and its arc begin and end, in order.
    arc : int
        Which piece is the arc; -1 of a straight run.
    drawn : DrawnRun
        Its shape.
    """

    curve: int
    breaks: tuple[int, ...]
    arc: int
    drawn: DrawnRun


@attrs.define(eq=False)
class DrawnRuns(Modification):
    """The runs of an edit."""

    runs: list[AskedRun] = attrs.field(factory=list)

    @property
    def idle(self) -> bool:
        """Whether there is none."""
        return not self.runs

    def check(self, work: Work) -> Iterable[str]:
        """Say which point lies off its run."""
        for run in self.runs:
            yield from _off_run(work.state, run)

    def finish(self, work: Work) -> bool:
        """Make the features; the points have come to stay."""
        state = work.state
        for run in self.runs:
            for number, (first, last) in enumerate(zip(run.breaks, run.breaks[1:], strict=False)):
                rows = points_between(state, run.curve, first, last)
                made = _feature(state, run, number, rows)
                if made is not None:
                    Maker(state, work.journal).features([*state.features, made])
        return False


def points_between(state: HullState, curve: int, first: int, last: int) -> IntArray:
    """Give the points of a curve from one to another, both included; none if one has gone."""
    rows: IntArray = state.curves.rows[curve]
    found = [np.flatnonzero(rows == row) for row in (first, last)]
    if not all(len(at) for at in found):
        return rows[:0]
    return rows[found[0][0] : found[1][0] + 1]


def _off_run(state: HullState, run: AskedRun) -> Iterator[str]:
    rows = points_between(state, run.curve, run.breaks[0], run.breaks[-1])
    title = state.lines.name[state.line_of(run.curve)]
    if not len(rows):
        yield f"{title}: an end of the run has gone; draw it between other points"
        return
    off = run.drawn.off(state.rows.xyz[rows])
    worst = int(off.argmax())
    if off[worst] > _ON * state.tolerances.factor:
        name = address(state, int(rows[worst]))
        yield (
            f"{name} came to lie {1e3 * off[worst]:.3g} mm off the run of {title}: another "
            "change of the edit holds it, or what crosses there does not follow so far; draw the "
            "run in an edit of its own, shorter, or nearer to the line"
        )


def _feature(state: HullState, run: AskedRun, number: int, rows: IntArray) -> Feature | None:
    """Give the feature of one piece; None of a straight one that is too short for one."""
    xyz, drawn = state.rows.xyz[rows], run.drawn
    if number != run.arc:
        chord = xyz[-1] - xyz[0]
        short = float(np.sqrt((chord * chord).sum())) < _SHORTEST * state.particulars.length
        return None if short else drawn_feature(state, run.curve, "straight", rows)
    normal = state.lines.normal[state.line_of(run.curve)]
    return drawn_feature(
        state, run.curve, "arc", rows, centre=drawn.centre.tolist(), radius=drawn.radius,
        normal=normal.tolist(), side=circle_side(xyz, drawn.centre, normal),
    )  # fmt: skip


def features_on(state: HullState, curve: int, rows: Sequence[int]) -> list[Feature]:
    """Give the features of a curve's line that own one of some points."""
    key = state.lines.key[state.line_of(curve)]
    return [each for each in state.features if key in each.lines and set(rows) & set(each.points)]


_KEPT = 0.02
"""Part of its area by which a hollow may be off when lines that drive it have followed."""

_GAUSS = np.array([0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)]), np.array([5.0, 8.0, 5.0]) / 18.0
"""Places and weights that integrate polynomials of degree 5 from 0 to 1."""


@attrs.frozen(eq=False)
class SpreadArea:
    """A hollow that is spread.

    Attributes
    ----------
    curve : int
        Its curve.
    old : SplineBatch
        The curve before.
    way, up : (3,)
        Unit vectors along the hollow and across it.
    area : float, m2
        Of the hollow.
    """

    curve: int
    old: SplineBatch
    way: FloatArray
    up: FloatArray
    area: float


@attrs.define(eq=False)
class SpreadAreas(Modification):
    """The hollows that an edit spreads."""

    areas: list[SpreadArea] = attrs.field(factory=list)

    @property
    def idle(self) -> bool:
        """Whether there is none."""
        return not self.areas

    def check(self, work: Work) -> Iterable[str]:
        """Say whose area was not kept."""
        for each in self.areas:
            off = area_beside(each.old, work.state.spline(each.curve), each.way, each.up)
            if abs(off) > _KEPT * each.area:
                name = work.state.lines.name[work.state.line_of(each.curve)]
                yield (
                    f"{name}: the hollow has come to another area, by {100 * off / each.area:.1f} %"
                    ", as lines drive it that follow not so far; make their crossings shared "
                    "(edit.set_role), or give another length"
                )


def area_beside(old: SplineBatch, new: SplineBatch, way: FloatArray, up: FloatArray) -> float:
    """Give the area (m2) between two curves with the same ends, above the old one positive."""
    return _area_below(new, way, up) - _area_below(old, way, up)


def _area_below(spline: SplineBatch, way: FloatArray, up: FloatArray) -> float:
    """Integrate the height over the length of a curve, exactly: a polynomial piece by piece."""
    step = np.diff(spline.knot)
    at = (spline.knot[:-1, None] + step[:, None] * _GAUSS[0]).ravel()
    curve: IntArray = np.zeros(len(at), np.int64)
    height = ((evaluate(spline, curve, at) - spline.xyz[0]) * up).sum(axis=1)
    speed = (derivative(spline, curve, at) * way).sum(axis=1)
    weight = (step[:, None] * _GAUSS[1]).ravel()
    return float((height * speed * weight).sum())


_MORE = 4
"""Sub-steps a field may have in addition."""


@attrs.define(eq=False)
class FieldMoves(Modification):
    """Displacements of the hull that an edit asks for; several add.

    `faired` are points (k,), and by how much (k, 3), m, these are farther from their given values.
    """

    fields: list[NormalField] = attrs.field(factory=list)
    faired: list[tuple[IntArray, FloatArray]] = attrs.field(factory=list)

    @property
    def idle(self) -> bool:
        """Whether there is no field."""
        return not self.fields

    @property
    def displaces(self) -> bool:
        """Whether points move that were not asked for one by one."""
        return bool(self.fields)

    @property
    def strict(self) -> bool:
        """Whether nothing but its own points may move."""
        return any(field.strict for field in self.fields)

    @property
    def asked_for(self) -> int:
        """How many fields there are."""
        return len(self.fields)

    def reached(self, state: HullState) -> Sequence[IntArray]:
        """Give the points that each field moves."""
        ground = FieldContext(state, any(field.across_flats for field in self.fields))
        return [
            Node.point(np.concatenate([field.shift(ground, 1.0).rows, field.exact()[0]]))
            for field in self.fields
        ]

    def landing(self) -> Iterable[tuple[IntArray, FloatArray]]:
        """Give the points that fields put to given places."""
        return [field.exact() for field in self.fields]

    def run(
        self, work: Work, rows: IntArray, origin: FloatArray
    ) -> tuple[IntArray, FloatArray] | None:
        """Run the fields, each sub-step with an update of its own."""
        if not self.fields:
            return None
        first, none = np.array(sorted(work.pending.curves), np.int64), rows[:0]

        def update(seeds: IntArray) -> bool:
            work.go(seeds, none if work.passes else first)
            work.settle()
            return True

        def detach(moved: IntArray) -> None:
            if detach_rows(Maker(work.state, work.journal), work.pending, moved):
                work.renew()

        found = self.carry_out(work.state, work.journal, work.pending, rows, origin, update, detach)
        work.pending.held.clear()
        return found

    def check(self, work: Work) -> Iterable[str]:
        """Say which point did not come where it was pulled, or where the edit moved it."""
        state, values = work.state, work.pending.values
        yield from unreached(state, self.fields, values.keys())
        for row in sorted(values.keys() & {row for each, _ in self.landing() for row in each}):
            if state.rows.alive[row] and (state.rows.xyz[row] != values[row]).any():
                yield (
                    f"{address(state, row)} is moved, and given another place by the new shape of "
                    "a line: leave one of the two out, or use two edits"
                )

    def carry_out(
        self, state: HullState, journal: Journal, pending: Pending, rows: IntArray,
        origin: FloatArray, update: Callable[[IntArray], bool],
        detach: Callable[[IntArray], None] | None = None,
        numbers: tuple[Program, Values] | None = None,
    ) -> tuple[IntArray, FloatArray] | None:  # fmt: skip
        """Run the fields; give all points that were set, and how far they lie from before, m.

        Parameters
        ----------
        state, journal, pending : HullState, Journal, Pending
            What is edited, and how. Its `held` become the adopted points that were carried; they
            ride from where they are then.
        rows : (k,) int
            Points that the edit has set by itself.
        origin : (n, 3), m
            Where all points lay before the edit.
        update : callable
            Brings all up to date with points that were set. Where it gives False, nothing more is
            done, and None is given.
        detach : callable or None
            Called with the points of a sub-step before they are written.
        numbers : (Program, Values) or None
            A program, whose numbers `update` brings to what is in the tables.
        """
        fields, held = self.fields, pending.held
        across = any(field.across_flats for field in fields)
        pinned, touched = set(pending.values), [rows]
        ground = FieldContext(state, across, numbers)
        shift = add_displacements([field.shift(ground, 1.0) for field in fields], pinned)
        steps, whole = sub_step_count(state, shift), shift
        landing = np.concatenate([field.exact()[0] for field in fields])
        xyz = state.rows.xyz
        for step in range(steps + _MORE):
            part = _part(state, fields, step, steps)
            if part == 0.0:
                break
            if step:
                ground = FieldContext(state, across, numbers)
            shift = whole
            if step or part != 1.0:
                shift = add_displacements([field.shift(ground, part) for field in fields], pinned)
            reached = (
                distinct(np.concatenate([shift.rows, landing])) if len(landing) else shift.rows
            )
            before = xyz.data.take(reached, axis=0)
            if detach is not None:
                detach(shift.rows)
            journal.put(xyz, shift.rows, xyz.data.take(shift.rows, axis=0) + shift.delta)
            if step == steps - 1 and len(landing):
                land_points(state, journal, fields)
            shifted = reached[bits_differ(before, xyz.data.take(reached, axis=0))]
            held |= set(shifted[state.rows.sort.data.take(shifted) == Sort.ADOPTED].tolist())
            touched.append(shifted)
            first = step == 0 and len(rows) > 0
            if not update(distinct(np.concatenate([shifted, rows])) if first else shifted):
                return None
        pending.notes += [
            f"{address(state, row)}: left alone, it is free almost along the hull only"
            for row in shift.left.tolist()
        ]
        rebase_adopted_points(state, np.array(sorted(held), np.int64), journal)
        self._note_faired(state, journal, pinned)
        every = distinct(np.concatenate(touched))
        every = every[every < len(origin)]
        now, then = xyz.data.take(every, axis=0), origin.take(every, axis=0)
        odd = np.flatnonzero(bits_differ(now, then))
        moved = now.take(odd, axis=0) - then.take(odd, axis=0)
        return every[odd], np.sqrt((moved * moved).sum(axis=1))

    def _note_faired(self, state: HullState, journal: Journal, pinned: set[int]) -> None:
        """Write how far fairing has taken points; what an edit set itself was given anew."""
        column = state.rows.faired
        for rows, more in self.faired:
            mine = ~np.isin(rows, sorted(pinned)) & state.rows.alive.data[rows]
            journal.put(column, rows[mine], column.take(rows[mine]) + more[mine])


def _part(state: HullState, fields: list[NormalField], step: int, steps: int) -> float:
    """Give the part of the fields to run in a sub-step; nil when they are where they should be.

    A field that knows what it lacks spreads that over the sub-steps left, and has a few more.
    """
    done = min(step, steps) / steps
    left = fields[0].left(state, done) if len(fields) == 1 else 1.0 - done
    if step >= steps and abs(left) <= CLOSE:
        return 0.0
    return float(np.clip(left / max(steps - step, 1), -1.0 / steps, 1.0 / steps))

"""A run of the program of a net: new numbers through the same structure, level by level.

Points that were set mark the curves made through them; each marked curve is lofted, once, and meets
the planes that it is cut with; points computed from its meetings, and those that ride with these,
mark further curves only where a bit of theirs has changed. Afterwards everything is checked that an
edit may be refused for, or that would change the structure. What looks doubtful is told, and
nothing is decided here: the edit then goes the full way, which finds out and says why.

This is the reference in numpy. The compiled form gives the same bits and the same answer.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from enum import IntEnum
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.model.feature_geometry import off_shapes
from assoc_hull.model.gaps import crossing_normals
from assoc_hull.model.program.structure import Program, Values
from assoc_hull.tolerance import Tolerances

__all__ = [
    "Doubt",
    "NetEffect",
    "NumpyProgram",
    "ProgramRun",
    "RunProgram",
    "begins",
    "curve_data",
    "features_left",
    "ranges",
    "run_program",
    "run_tile",
    "spans",
    "write_points",
]

_COINCIDENT = Tolerances().coincident
_BEYOND = 1e-6
"""Times `Program.factor`: how far (m) a curve may lie beyond the centre plane by rounding."""


class Doubt(IntEnum):
    """Why a run does not answer for itself."""

    NONE = 0
    UNSURE = 1
    NOT_MADE = 2
    MEETINGS = 3
    SENSE = 4
    GAP = 5
    FOLD = 6
    BEYOND = 7
    LATENT = 8
    FEATURE = 9


@attrs.frozen(eq=False)
class ProgramRun:
    """What a run has done.

    Attributes
    ----------
    doubt : Doubt
        `NONE` if the structure is kept and nothing stands against the edit.
    where : int
        The curve, or for a feature its number, that raised the doubt; -1 if none.
    curves : (k,) int
        Curves that were lofted, as the program counts them, ascending.
    rows : (r,) int
        Points whose place changed by a bit, the ones that were set included, ascending.
    watched : (w,) int
        Numbers of the watched crossings that were measured, ascending.
    """

    doubt: Doubt
    where: int
    curves: IntArray
    rows: IntArray
    watched: IntArray

    @property
    def kept(self) -> bool:
        """Whether the edit is nothing but these numbers."""
        return self.doubt is Doubt.NONE


@attrs.frozen(eq=False)
class NetEffect:
    """What tells two sets of numbers of one net apart, to the bit.

    Attributes
    ----------
    rows, xyz : (k,) int, (k, 3) int
        Points that lie elsewhere, ascending, and the exclusive or of the bits of their coordinates.
    watched, gap : (w,) int, (w, 1) int
        The same of gaps of watched crossings.
    curves, met : (c,) int, (q, 4) int
        The same of curves whose meetings lie elsewhere: chord parameters and places, curve by
        curve.
    """

    rows: IntArray
    xyz: IntArray
    watched: IntArray
    gap: IntArray
    curves: IntArray
    met: IntArray


class RunProgram(Protocol):
    """A program with the arithmetic that runs it; for one thread at a time."""

    @property
    def program(self) -> Program:
        """The structure."""

    def run(
        self, values: Values, before: Values, rows: IntArray, held: IntArray,
        curves: IntArray | None = None,
    ) -> ProgramRun:  # fmt: skip
        """Bring all numbers up to date with points that were written: see `run_program`."""

    def restore(self, values: Values, before: Values, run: ProgramRun) -> None:
        """Put back what a run has written, from numbers as they were."""

    def splines(
        self, values: Values, before: Values, curves: IntArray
    ) -> tuple[SplineBatch, NDArray[np.bool_]]:
        """Give curves as they are in the numbers, and which differ from what they were before.

        That is: in a point or a slope behind one; zeros of two signs are equal. There is a curve.
        """

    def compare(
        self, values: Values, before: Values, rows: IntArray, watched: IntArray, curves: IntArray
    ) -> NetEffect:
        """Tell which of these points, crossings and curves, in their order, differ from before."""


@attrs.frozen(eq=False)
class NumpyProgram:
    """A program, run in numpy."""

    program: Program

    def run(
        self, values: Values, before: Values, rows: IntArray, held: IntArray,
        curves: IntArray | None = None,
    ) -> ProgramRun:  # fmt: skip
        """Bring all numbers up to date with points that were written."""
        return run_program(self.program, values, before, rows, held, curves)

    def restore(self, values: Values, before: Values, run: ProgramRun) -> None:
        """Put back what a run has written."""
        program, curves = self.program, run.curves
        rows = np.concatenate([run.rows, program.watch[run.watched]])
        knots, met = spans(program.start, curves), spans(program.meet_start, curves)
        blocks = spans(9 * program.start, curves)
        for name, items in (
            ("xyz", rows), ("knot", knots), ("block", blocks), ("at", met), ("place", met),
            ("segment", met), ("gap", run.watched), ("folds", curves), ("lowest", curves),
        ):  # fmt: skip
            getattr(values, name)[items] = getattr(before, name)[items]

    def splines(
        self, values: Values, before: Values, curves: IntArray
    ) -> tuple[SplineBatch, NDArray[np.bool_]]:
        """Give curves, and which differ from before."""
        begin, start = begins(self.program.start, curves), self.program.start
        bounds = [(int(start[c]), int(start[c + 1])) for c in curves.tolist()]
        block, old = (
            np.concatenate([each.block[9 * a : 9 * b].reshape(9, -1) for a, b in bounds], axis=1)
            for each in (values, before)
        )
        knot = np.concatenate([values.knot[a:b] for a, b in bounds])
        odd = np.logical_or.reduceat((block[:6] != old[:6]).any(axis=0), begin[:-1])
        return SplineBatch(begin, knot, block[:3].T, block[3:6].T, block[6:].T), odd

    def compare(
        self, values: Values, before: Values, rows: IntArray, watched: IntArray, curves: IntArray
    ) -> NetEffect:
        """Tell what differs from before."""
        begin = begins(self.program.meet_start, curves)
        where, size = spans(self.program.meet_start, curves), np.diff(begin)
        xyz = _apart(before.xyz, values.xyz, rows)
        gap = _apart(before.gap, values.gap, watched)
        met = np.concatenate(
            [_apart(before.at, values.at, where), _apart(before.place, values.place, where)], axis=1
        )
        count = np.zeros(len(curves), np.int64)
        np.add.at(count, np.repeat(np.arange(len(curves)), size), met.any(axis=1))
        moved, elsewhere, wider = count > 0, xyz.any(axis=1), gap.any(axis=1)
        return NetEffect(
            rows[elsewhere], xyz[elsewhere], watched[wider], gap[wider], curves[moved],
            met[np.repeat(moved, size)],
        )  # fmt: skip


def _apart(old: FloatArray, new: FloatArray, items: IntArray) -> IntArray:
    """Give the exclusive or of the bits of items of two arrays, (k, numbers of an item)."""
    bits = old[items].view(np.int64) ^ new[items].view(np.int64)
    return bits if old.ndim > 1 else bits[:, None]


def differs(old: FloatArray, new: FloatArray) -> NDArray[np.bool_]:
    """Tell for each row of two (k, 3) arrays whether a bit differs."""
    found: NDArray[np.bool_] = (old.view(np.int64) != new.view(np.int64)).any(axis=1)
    return found


def write_points(values: Values, rows: IntArray, places: FloatArray) -> IntArray:
    """Put points (k,) to places (k, 3), m; give those that differ by a bit from before."""
    places = np.ascontiguousarray(places) + 0.0
    odd = differs(values.xyz[rows], places)
    values.xyz[rows[odd]] = places[odd]
    return rows[odd]


def run_program(
    program: Program,
    values: Values,
    before: Values,
    rows: IntArray,
    held: IntArray,
    curves: IntArray | None = None,
) -> ProgramRun:
    """Bring all numbers up to date with points that were written.

    Parameters
    ----------
    program : Program
        The structure.
    values : Values
        The numbers; they are written to, whatever comes of it.
    before : Values
        The published ones, with which what was doubtful already is compared.
    rows : (k,) int
        Points that were written and differ by a bit.
    held : (h,) int
        Riding points that stay where they were put.
    curves : (c,) int, optional
        Curves to make anew whatever has changed; nothing is doubted of them beforehand.

    Returns
    -------
    ProgramRun
    """
    return run_tile(program, values, before, rows, held, curves, 1)[0]


def run_tile(
    tile: Program, values: Values, before: Values, rows: IntArray, held: IntArray,
    curves: IntArray | None, count: int,
) -> tuple[ProgramRun, ...]:  # fmt: skip
    """Run `count` variants of a net, whose structures and numbers stand one behind the other.

    `level` is that of one variant; all that is counted in curves, points or meetings goes on from
    one variant to the next. A variant in doubt stands still while the others go on.
    """
    work = _Work.of(tile, values, rows, held, count)
    if curves is not None:
        work.dirty[curves], work.whole = True, True
    for first, stop in itertools.pairwise(tile.level.tolist()):
        mine = work.level(first, stop)
        if not len(mine):
            break
        work.ride(mine)
        chosen = mine[work.dirty[mine]]
        if len(chosen):
            work.evaluate(chosen)
    watched = work.check(before)
    return work.runs(watched)


def begins(start: IntArray, owners: IntArray) -> IntArray:
    """Give where the items of each owner begin if they stand one behind the other, and the end."""
    found = np.zeros(len(owners) + 1, np.int64)
    np.cumsum(start.take(owners + 1) - start.take(owners), out=found[1:])
    return found


def spans(start: IntArray, owners: IntArray) -> IntArray:
    """Give where the items of some owners stand, one owner after the other."""
    count = start[owners + 1] - start[owners]
    ends = np.cumsum(count)
    total = int(ends[-1]) if len(ends) else 0
    place: IntArray = np.arange(total) + np.repeat(start[owners] - (ends - count), count)
    return place


def ranges(start: IntArray, items: IntArray, owners: IntArray) -> IntArray:
    """Give the items of some owners, one owner after the other."""
    found: IntArray = items[spans(start, owners)]
    return found


@attrs.define(eq=False)
class _Work:
    """A run of variants under way: what is to be made, what has changed, who is in doubt.

    `size` and `points` are the numbers of curves and points of one variant.
    """

    program: Program
    values: Values
    count: int
    size: int
    points: int
    dirty: NDArray[np.bool_]
    changed: NDArray[np.bool_]
    due: NDArray[np.bool_]
    held: NDArray[np.bool_]
    doubt: IntArray
    where: IntArray
    whole: bool = False

    @classmethod
    def of(
        cls, program: Program, values: Values, rows: IntArray, held: IntArray, count: int
    ) -> _Work:
        points, size = len(values.xyz), int(program.level[-1])
        changed, due, held_back = (np.zeros(points, np.bool_) for _ in range(3))
        dirty = np.zeros(count * size, np.bool_)
        doubt, where = np.full(count, int(Doubt.NONE)), np.full(count, -1)
        work = cls(program, values, count, size, points // count, dirty, changed, due, held_back,
                   doubt, where)  # fmt: skip
        work.held[held] = True
        work.mark(rows)
        return work

    def level(self, first: int, stop: int) -> IntArray:
        """Give the curves of a level, of the variants that are not in doubt."""
        kept = np.flatnonzero(self.doubt == Doubt.NONE)
        curves: IntArray = (kept[:, None] * self.size + np.arange(first, stop)).ravel()
        return curves

    def kept(self, curves: IntArray) -> IntArray:
        """Give those of curves whose variants are not in doubt."""
        found: IntArray = curves[self.doubt[curves // self.size] == Doubt.NONE]
        return found

    def note(self, doubt: Doubt, where: IntArray, size: int) -> None:
        """Raise a doubt at curves or features, ascending; the first of each variant is told."""
        if len(where):
            variant, first = np.unique(where // size, return_index=True)
            new = self.doubt[variant] == Doubt.NONE
            self.doubt[variant[new]] = int(doubt)
            self.where[variant[new]] = where[first[new]] % size

    def mark(self, rows: IntArray) -> None:
        """Note that points have changed: what is made of them is to be made anew."""
        self.changed[rows] = True
        readers = self.program.reader[rows].ravel()
        self.dirty[readers[readers >= 0]] = True
        self.due[ranges(self.program.rider_start, self.program.rider, rows)] = True

    def ride(self, curves: IntArray) -> None:
        """Move the points that ride on curves."""
        program, values = self.program, self.values
        rows = ranges(program.riding_start, program.riding, curves)
        rows = rows[self.due[rows] & ~self.held[rows]]
        if not len(rows):
            return
        anchor = program.anchor[rows]
        shift = values.xyz[anchor] - values.anchor_from[rows]
        shift = np.where((anchor >= 0)[:, :, None], shift, 0.0)
        weight = program.weight[rows][:, None]
        place = values.base[rows] + ((1.0 - weight) * shift[:, 0] + weight * shift[:, 1])
        self.publish(rows, place)

    def publish(self, rows: IntArray, places: FloatArray) -> None:
        """Write the points that differ by a bit, and mark what is made of them."""
        odd = differs(self.values.xyz[rows], np.ascontiguousarray(places))
        self.values.xyz[rows[odd]] = places[odd]
        self.mark(rows[odd])

    def evaluate(self, curves: IntArray) -> None:
        """Loft curves of one level, cut them, and write what is computed from them."""
        program, values = self.program, self.values
        if not self.whole and program.unsure[curves].any():
            self.note(Doubt.UNSURE, curves[program.unsure[curves] != 0], self.size)
            curves = self.kept(curves)
        curves, batch = self.lofted(curves)
        if batch is None:
            return
        _store(program, values, curves, batch)
        met = _met(program, curves, batch)
        odd = _odd(program, curves, met)
        if odd.any():
            self.note(Doubt.MEETINGS, curves[odd], self.size)
            met = met.take(self.doubt[curves[met.curve] // self.size] == Doubt.NONE)
            curves = self.kept(curves)
        _write(program, values, curves, met)
        meetings = ranges(program.drive_start, program.drive, curves)
        self.publish(program.meet_row[meetings], values.place[meetings])

    def lofted(self, curves: IntArray) -> tuple[IntArray, SplineBatch | None]:
        """Loft curves of the variants of which all can be made; give these curves."""
        batch = _lofted(self.program, self.values, curves) if len(curves) else None
        if batch is not None or not len(curves):
            return curves, batch
        parts = np.split(curves, np.flatnonzero(np.diff(curves // self.size)) + 1)
        for part in parts:
            # Of a single variant it is known already.
            if len(parts) == 1 or _lofted(self.program, self.values, part) is None:
                self.note(Doubt.NOT_MADE, part[:1], self.size)
        return self.lofted(self.kept(curves))

    def check(self, before: Values) -> IntArray:
        """Look for what a run cannot answer for; give the watched crossings that were measured."""
        program = self.program
        if not self.whole:
            doubtful = np.flatnonzero(self.changed & (program.unsure_row[: len(self.changed)] != 0))
            variants = np.unique(doubtful // self.points)
            self.doubt[variants[self.doubt[variants] == Doubt.NONE]] = int(Doubt.UNSURE)
        if (self.doubt != Doubt.NONE).all():
            return np.zeros(0, np.int64)
        touched = self.kept(np.flatnonzero(self.dirty))
        watched = np.unique(ranges(program.watch_start, program.watched, touched))
        rows = np.flatnonzero(self.changed)
        rows = rows[self.doubt[rows // self.points] == Doubt.NONE]
        features = len(program.features.shape) * self.size // program.curves
        for doubt, where in _doubts(program, self.values, before, touched, watched, rows):
            self.note(doubt, where, features if doubt is Doubt.FEATURE else self.size)
            if (self.doubt != Doubt.NONE).all():
                break
        return watched

    def runs(self, watched: IntArray) -> tuple[ProgramRun, ...]:
        """Tell what was done, variant by variant."""
        dirty = self.dirty.reshape(self.count, -1)
        changed = self.changed.reshape(self.count, -1)
        crossings = len(self.program.watch) * self.size // self.program.curves
        span = np.searchsorted(watched, np.arange(self.count + 1) * crossings).tolist()
        return tuple(
            ProgramRun(
                Doubt(doubt), where, np.flatnonzero(dirty[v]), np.flatnonzero(changed[v]),
                watched[span[v] : span[v + 1]] - v * crossings,
            )
            for v, (doubt, where) in enumerate(
                zip(self.doubt.tolist(), self.where.tolist(), strict=True)
            )
        )  # fmt: skip


def curve_data(program: Program, values: Values, curves: IntArray) -> CurveData:
    """Give what curves are made from."""
    count = program.start[curves + 1] - program.start[curves]
    start = np.zeros(len(curves) + 1, np.int64)
    np.cumsum(count, out=start[1:])
    knots = spans(program.start, curves)
    return CurveData(
        start, values.xyz[program.row[knots]], program.kind[knots], program.direction[knots],
        program.end_kind[curves], program.end_vector[curves],
    )  # fmt: skip


def _lofted(program: Program, values: Values, curves: IntArray) -> SplineBatch | None:
    """Make curves through their points; None if one cannot be made, or is not finite."""
    try:
        batch = loft(curve_data(program, values, curves))
    except (AssocHullError, ArithmeticError):
        return None
    return batch if np.isfinite(batch.leave).all() else None


def _store(program: Program, values: Values, curves: IntArray, batch: SplineBatch) -> None:
    """Write the splines of curves into the values."""
    knots = spans(program.start, curves)
    count = np.diff(batch.start)
    first = np.repeat(program.start[curves], count)
    width = np.repeat(count, count)
    values.knot[knots] = batch.knot
    for part, vectors in enumerate((batch.xyz, batch.leave, batch.arrive)):
        for axis in range(3):
            slot = 9 * first + (3 * part + axis) * width + (knots - first)
            values.block[slot] = vectors[:, axis]
    found = curve_folds(batch)
    values.folds[curves] = np.bincount(found.curve, minlength=len(curves))
    values.lowest[curves] = np.minimum.reduceat(batch.xyz[:, 1], batch.start[:-1])


@attrs.frozen(eq=False)
class _Met:
    """Where curves meet planes, by curve, plane and parameter; curves by their place in a batch."""

    curve: IntArray
    plane: IntArray
    sign: IntArray
    segment: IntArray
    at: FloatArray
    place: FloatArray

    def take(self, items: IntArray | NDArray[np.bool_]) -> _Met:
        return _Met(*(each[items] for each in attrs.astuple(self, recurse=False)))


def _met(program: Program, curves: IntArray, batch: SplineBatch) -> _Met:
    """Cut curves with their planes."""
    sets = ranges(program.set_start, program.sets, curves)
    owner = np.repeat(np.arange(len(curves)), np.diff(program.set_start)[curves])
    nothing = np.zeros(0, np.int64)
    pieces = [_Met(nothing, nothing, nothing, nothing, np.zeros(0), np.zeros((0, 3)))]
    for each in np.unique(sets).tolist():
        mine = owner[sets == each]
        part = _taken(batch, mine)
        first, stop = program.first[each : each + 2].tolist()
        met = intersect_planes(part, program.normal[each], program.offset[first:stop],
                               program.factor, tell_tangential=False)  # fmt: skip
        segment = met.segment - part.start[met.curve]
        sign = met.sign.astype(np.int64)
        pieces.append(_Met(mine[met.curve], met.plane + first, sign, segment, met.t, met.xyz))
    columns = zip(*(attrs.astuple(each, recurse=False) for each in pieces), strict=True)
    found = _Met(*(np.concatenate(each) for each in columns))
    return found.take(np.lexsort((found.plane, found.curve)))


def _taken(batch: SplineBatch, curves: IntArray) -> SplineBatch:
    """Give some curves of a batch, ascending."""
    if len(curves) == batch.count:
        return batch
    knots = spans(batch.start, curves)
    start = np.zeros(len(curves) + 1, np.int64)
    np.cumsum(np.diff(batch.start)[curves], out=start[1:])
    return SplineBatch(
        start, batch.knot[knots], batch.xyz[knots], batch.leave[knots], batch.arrive[knots]
    )


def _odd(program: Program, curves: IntArray, met: _Met) -> NDArray[np.bool_]:
    """Tell which curves meet other planes, or in other senses, than they did."""
    wanted = program.meet_start[curves + 1] - program.meet_start[curves]
    odd: NDArray[np.bool_] = np.bincount(met.curve, minlength=len(curves)) != wanted
    expected = spans(program.meet_start, curves[~odd])
    like = ~odd[met.curve]
    differ = met.plane[like] != program.meet_plane[expected]
    differ |= met.sign[like] != program.meet_sign[expected]
    odd[met.curve[like][differ]] = True
    return odd


def _write(program: Program, values: Values, curves: IntArray, met: _Met) -> None:
    """Write the meetings of curves, which are those that were expected, into the values."""
    expected, xyz = spans(program.meet_start, curves), met.place
    axis = program.own_axis[program.meet_curve[expected]]
    flat = np.flatnonzero(axis >= 0)
    xyz[flat, axis[flat]] = program.own_offset[program.meet_curve[expected[flat]]]
    values.at[expected], values.place[expected], values.segment[expected] = met.at, xyz, met.segment


# --------------------------------------------------------------------------------------
# What must hold. All of it is asked of the curves that were made, and of the points that moved.


def _doubts(
    program: Program, values: Values, before: Values, touched: IntArray, watched: IntArray,
    rows: IntArray,
) -> Iterator[tuple[Doubt, IntArray]]:  # fmt: skip
    """Measure the gaps of curves; give doubts by their rank, with the curves or features."""
    values.gap[watched] = _gaps(program, values, watched)
    values.xyz[program.watch[watched]] = values.place[program.watch_a[watched]]
    sense = ranges(program.sense_start, program.sense, touched)
    apart = np.abs(values.place[sense] - values.xyz[program.meet_row[sense]]).max(
        axis=1, initial=0.0
    )
    yield Doubt.SENSE, program.meet_curve[sense[apart > _COINCIDENT]]
    wide = ~(values.gap[watched] <= program.limit[watched])
    yield Doubt.GAP, program.meet_curve[program.watch_b[watched[wide]]]
    yield Doubt.FOLD, touched[values.folds[touched] > before.folds[touched]]
    lowest, least = values.lowest[touched], _BEYOND * program.factor
    beyond = (lowest < -least) & (lowest < before.lowest[touched] - least)
    yield Doubt.BEYOND, touched[beyond]
    pairs = np.unique(ranges(program.pair_start, program.paired, touched))
    away = values.place[program.pair_a[pairs]] - values.place[program.pair_b[pairs]]
    near = (away * away).sum(axis=1) <= program.near**2
    yield Doubt.LATENT, program.meet_curve[program.pair_a[pairs[near]]]
    yield Doubt.FEATURE, features_left(program, values, rows)[0]


def _gaps(program: Program, values: Values, watched: IntArray) -> FloatArray:
    """Measure watched crossings along the normal of their two curves, (w,), m."""
    one, other = program.watch_a[watched], program.watch_b[watched]
    normal = crossing_normals(_tangents(program, values, one), _tangents(program, values, other))
    product = ((values.place[one] - values.place[other]) * normal).T
    gap: FloatArray = np.abs(product[0] + product[1] + product[2])
    return gap


def _tangents(program: Program, values: Values, meeting: IntArray) -> FloatArray:
    """Give the unit tangents of curves where they meet planes, (k, 3); at a knot that after it."""
    curve = program.meet_curve[meeting]
    start, count = program.start[curve], program.start[curve + 1] - program.start[curve]
    segment, at = values.segment[meeting], values.at[meeting]
    after = (values.knot[start + segment + 1] <= at) & (segment + 2 < count)
    segment = segment + after
    begin, end = values.knot[start + segment], values.knot[start + segment + 1]
    length = end - begin
    u = np.where(at == end, 1.0, (at - begin) / length)
    slope = np.empty((3, len(meeting)))
    for axis in range(3):
        here = 9 * start + axis * count + segment
        step = values.block[here + 1] - values.block[here]
        first = values.block[here + 3 * count] * length
        both = first + values.block[here + 6 * count + 1] * length
        second = 3.0 * step - first - both
        third = both - step * 2.0
        slope[axis] = (first + u * (2.0 * second + u * (3.0 * third))) / length
    size = np.sqrt(slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2])
    found: FloatArray = (slope / size).T
    return found


def features_left(program: Program, values: Values, rows: IntArray) -> tuple[IntArray, FloatArray]:
    """Give the features that points (k,) which own them have come off, and how far, m."""
    features, off = program.features, list[float]()
    found = np.unique(ranges(features.owner_start, features.owner, rows))
    for each in found.tolist():
        span = slice(features.start[each], features.start[each + 1])
        shape, numbers = int(features.shape[each]), features.numbers[each]
        off.append(off_shapes(shape, numbers, values.xyz[features.point[span]]).max())
    far = np.array(off, np.float64)
    # A point that is at the limit, but for rounding, is left to the full way.
    left = ~(far <= features.limit[found] * (1.0 - 1e-9))
    return found[left], far[left]

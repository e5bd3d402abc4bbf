"""A run of the program of a net: new numbers through the same structure, level by level.

Points that were set mark the curves made through them; each marked curve is lofted, once, and meets
the planes that it is cut with; points computed from its meetings, and those that ride with these,
mark further curves only where a bit of theirs has changed. Afterwards everything is checked that an
edit may be refused for, or that would change the structure. What looks doubtful is told, and
nothing is decided here: the edit then goes the full way, which finds out and says why.

This is the reference in numpy. The compiled form gives the same bits and the same answer.
"""

from __future__ import annotations

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
from assoc_hull.model.program import Program, Values
from assoc_hull.tolerance import Tolerances

__all__ = ["Doubt", "NumpyProgram", "ProgramRun", "RunProgram", "run_program", "write_points"]

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

    @property
    def sound(self) -> bool:
        """Whether the numbers are those of the edit; it may have more to say of features."""
        return self.doubt in (Doubt.NONE, Doubt.FEATURE)


class RunProgram(Protocol):
    """A program with the arithmetic that runs it; for one thread at a time."""

    def run(self, values: Values, before: Values, rows: IntArray, held: IntArray) -> ProgramRun:
        """Bring all numbers up to date with points that were written: see `run_program`."""

    def restore(self, values: Values, before: Values, run: ProgramRun) -> None:
        """Put back what a run has written, from numbers as they were."""


@attrs.frozen(eq=False)
class NumpyProgram:
    """A program, run in numpy."""

    program: Program

    def run(self, values: Values, before: Values, rows: IntArray, held: IntArray) -> ProgramRun:
        """Bring all numbers up to date with points that were written."""
        return run_program(self.program, values, before, rows, held)

    def restore(self, values: Values, before: Values, run: ProgramRun) -> None:
        """Put back what a run has written."""
        program, curves = self.program, run.curves
        rows = np.concatenate([run.rows, program.watch[run.watched]])
        knots = _ranges(program.start, np.arange(len(program.row)), curves)
        blocks = _ranges(9 * program.start, np.arange(len(values.block)), curves)
        met = _ranges(program.meet_start, np.arange(len(program.meet_row)), curves)
        for name, items in (
            ("xyz", rows), ("knot", knots), ("block", blocks), ("at", met), ("place", met),
            ("segment", met), ("gap", run.watched), ("folds", curves), ("lowest", curves),
        ):  # fmt: skip
            getattr(values, name)[items] = getattr(before, name)[items]


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
    work = _Work.of(program, values, rows, held)
    if curves is not None:
        work.dirty[curves], work.whole = True, True
    doubt, where = Doubt.NONE, -1
    for first, stop in zip(program.level[:-1].tolist(), program.level[1:].tolist(), strict=True):
        work.ride(first, stop)
        chosen = np.flatnonzero(work.dirty[first:stop]) + first
        if len(chosen):
            doubt, where = work.evaluate(chosen)
            if doubt:
                break
    if not doubt and program.unsure_row[work.changed].any() and not work.whole:
        doubt, where = Doubt.UNSURE, -1
    touched = np.flatnonzero(work.dirty)
    watched = np.zeros(0, np.int64)
    if not doubt:
        watched = np.unique(_ranges(program.watch_start, program.watched, touched))
        doubt, where = _checked(program, values, before, work, touched, watched)
    moved = np.flatnonzero(work.changed)
    return ProgramRun(doubt, where, touched, moved, watched)


def _ranges(start: IntArray, items: IntArray, owners: IntArray) -> IntArray:
    """Give the items of some owners, one owner after the other."""
    count = start[owners + 1] - start[owners]
    ends = np.cumsum(count)
    total = int(ends[-1]) if len(ends) else 0
    place = np.arange(total) + np.repeat(start[owners] - (ends - count), count)
    found: IntArray = items[place]
    return found


@attrs.define(eq=False)
class _Work:
    """A run under way: which curves are to be made, which points have changed."""

    program: Program
    values: Values
    dirty: NDArray[np.bool_]
    changed: NDArray[np.bool_]
    due: NDArray[np.bool_]
    held: NDArray[np.bool_]
    whole: bool = False

    @classmethod
    def of(cls, program: Program, values: Values, rows: IntArray, held: IntArray) -> _Work:
        points = len(values.xyz)
        changed, due, held_back = (np.zeros(points, np.bool_) for _ in range(3))
        dirty = np.zeros(program.curves, np.bool_)
        work = cls(program, values, dirty, changed, due, held_back)
        work.held[held] = True
        work.mark(rows)
        return work

    def mark(self, rows: IntArray) -> None:
        """Note that points have changed: what is made of them is to be made anew."""
        self.changed[rows] = True
        readers = self.program.reader[rows].ravel()
        self.dirty[readers[readers >= 0]] = True
        self.due[_ranges(self.program.rider_start, self.program.rider, rows)] = True

    def ride(self, first: int, stop: int) -> None:
        """Move the points that ride on the curves of a level."""
        program, values = self.program, self.values
        begin, end = program.riding_start[first], program.riding_start[stop]
        rows = program.riding[begin:end]
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

    def evaluate(self, curves: IntArray) -> tuple[Doubt, int]:
        """Loft curves of one level, cut them, and write what is computed from them."""
        program, values = self.program, self.values
        if program.unsure[curves].any() and not self.whole:
            return Doubt.UNSURE, int(curves[np.argmax(program.unsure[curves])])
        batch = _lofted(program, values, curves)
        if batch is None:
            return Doubt.NOT_MADE, int(curves[0])
        _store(program, values, curves, batch)
        odd = _cut(program, values, curves, batch)
        if odd >= 0:
            return Doubt.MEETINGS, odd
        meetings = _ranges(program.drive_start, program.drive, curves)
        self.publish(program.meet_row[meetings], values.place[meetings])
        return Doubt.NONE, -1


def _lofted(program: Program, values: Values, curves: IntArray) -> SplineBatch | None:
    """Make curves through their points; None if one cannot be made, or is not finite."""
    count = program.start[curves + 1] - program.start[curves]
    start = np.zeros(len(curves) + 1, np.int64)
    np.cumsum(count, out=start[1:])
    knots = _ranges(program.start, np.arange(len(program.row)), curves)
    data = CurveData(
        start, values.xyz[program.row[knots]], program.kind[knots], program.direction[knots],
        program.end_kind[curves], program.end_vector[curves],
    )  # fmt: skip
    try:
        batch = loft(data)
    except (AssocHullError, ArithmeticError):
        return None
    return batch if np.isfinite(batch.leave).all() else None


def _store(program: Program, values: Values, curves: IntArray, batch: SplineBatch) -> None:
    """Write the splines of curves into the values."""
    knots = _ranges(program.start, np.arange(len(program.row)), curves)
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


def _cut(program: Program, values: Values, curves: IntArray, batch: SplineBatch) -> int:
    """Cut curves with their planes; give the first that meets others than before, -1 if none."""
    sets = _ranges(program.set_start, program.sets, curves)
    owner = np.repeat(np.arange(len(curves)), np.diff(program.set_start)[curves])
    pieces: list[tuple[IntArray, ...]] = []
    places: list[tuple[FloatArray, FloatArray]] = []
    for each in np.unique(sets).tolist():
        mine = owner[sets == each]
        part = SplineBatch.join([batch.part(i, i + 1) for i in mine.tolist()])
        first, stop = program.first[each : each + 2].tolist()
        met = intersect_planes(part, program.normal[each], program.offset[first:stop],
                               program.factor)  # fmt: skip
        segment = met.segment - part.start[met.curve]
        pieces.append((mine[met.curve], met.plane + first, met.sign.astype(np.int64), segment))
        places.append((met.t, met.xyz))
    expected = _ranges(program.meet_start, np.arange(len(program.meet_row)), curves)
    if not pieces:
        return -1 if not len(expected) else int(curves[0])
    local, plane, sign, segment = (np.concatenate([piece[i] for piece in pieces]) for i in range(4))
    order = np.lexsort((plane, local))
    local, plane, sign, segment = (each[order] for each in (local, plane, sign, segment))
    wanted = program.meet_curve[expected], program.meet_plane[expected]
    same = len(expected) == len(local) and bool(
        ((curves[local] == wanted[0]) & (plane == wanted[1])).all()
        and (sign == program.meet_sign[expected]).all()
    )
    if not same:
        return _first_odd(program, curves, local, plane, sign)
    at = np.concatenate([each[0] for each in places])[order]
    xyz = np.concatenate([each[1] for each in places])[order]
    axis = program.own_axis[wanted[0]]
    flat = np.flatnonzero(axis >= 0)
    xyz[flat, axis[flat]] = program.own_offset[wanted[0][flat]]
    values.at[expected], values.place[expected], values.segment[expected] = at, xyz, segment
    return -1


def _first_odd(
    program: Program, curves: IntArray, local: IntArray, plane: IntArray, sign: IntArray
) -> int:
    """Find the first curve that meets other planes, or in other senses, than it did."""
    for i, curve in enumerate(curves.tolist()):
        span = slice(program.meet_start[curve], program.meet_start[curve + 1])
        mine = local == i
        if not (
            np.array_equal(plane[mine], program.meet_plane[span])
            and np.array_equal(sign[mine], program.meet_sign[span])
        ):
            return int(curve)
    raise AssertionError("some curve meets other planes")


# --------------------------------------------------------------------------------------
# What must hold. All of it is asked of the curves that were made, and of the points that moved.


def _checked(
    program: Program, values: Values, before: Values, work: _Work, touched: IntArray,
    watched: IntArray,
) -> tuple[Doubt, int]:  # fmt: skip
    """Measure the gaps of curves and look for what a run cannot answer for."""
    values.gap[watched] = _gaps(program, values, watched)
    values.xyz[program.watch[watched]] = values.place[program.watch_a[watched]]
    sense = _ranges(program.sense_start, program.sense, touched)
    apart = np.abs(values.place[sense] - values.xyz[program.meet_row[sense]]).max(
        axis=1, initial=0.0
    )
    if (apart > _COINCIDENT).any():
        return Doubt.SENSE, int(program.meet_curve[sense[np.argmax(apart > _COINCIDENT)]])
    wide = ~(values.gap[watched] <= program.limit[watched])
    if wide.any():
        return Doubt.GAP, int(program.meet_curve[program.watch_b[watched[np.argmax(wide)]]])
    folds = (values.folds[touched] > before.folds[touched]).nonzero()[0]
    if len(folds):
        return Doubt.FOLD, int(touched[folds[0]])
    lowest, least = values.lowest[touched], _BEYOND * program.factor
    beyond = ((lowest < -least) & (lowest < before.lowest[touched] - least)).nonzero()[0]
    if len(beyond):
        return Doubt.BEYOND, int(touched[beyond[0]])
    pairs = np.unique(_ranges(program.pair_start, program.paired, touched))
    away = values.place[program.pair_a[pairs]] - values.place[program.pair_b[pairs]]
    near = ((away * away).sum(axis=1) <= program.near**2).nonzero()[0]
    if len(near):
        return Doubt.LATENT, int(program.meet_curve[program.pair_a[pairs[near[0]]]])
    return _features_kept(program, values, np.flatnonzero(work.changed))


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


def _features_kept(program: Program, values: Values, rows: IntArray) -> tuple[Doubt, int]:
    """Look whether points have come off the features that own them."""
    features = program.features
    for each in np.unique(_ranges(features.owner_start, features.owner, rows)).tolist():
        span = slice(features.start[each], features.start[each + 1])
        off = off_shapes(int(features.shape[each]), features.numbers[each],
                         values.xyz[features.point[span]])  # fmt: skip
        # A point that is at the limit, but for rounding, is left to the full way.
        if not off.max() <= features.limit[each] * (1.0 - 1e-9):
            return Doubt.FEATURE, each
    return Doubt.NONE, -1

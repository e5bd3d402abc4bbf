"""The image of curves under a mapping: where it meets planes, and followers laid into theirs.

The image of a spline is not the spline through the images of its points. Cuts are made
with the image itself, so a crossing does not depend on how the curve is lofted again.

The image of a follower laid into its plane, and how far the hull lies off it there.

A follower whose plane slides over the hull keeps its character: its new shape is its image,
laid into the plane, and moved across itself by a distance that changes slowly along it. Where
lines cut before come through the plane, that distance is known.
"""

from __future__ import annotations

from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.edit.mapped_planes import plane_heights
from assoc_hull.edit.recut.carried_points import TransformationState
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    SplineBatch,
)
from assoc_hull.geometry.numeric.polynomials import false_position
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import derivative, evaluate, segment_start
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import CurveIntersections

__all__ = [
    "CurveImages",
    "ImageIntersections",
    "ProjectedImage",
    "gaps_across",
    "image_misfit",
    "projected_image",
]

_SIDE_SAMPLES = 16
"""Places a segment at which the side of a plane is asked."""

_PROBES = 5
"""Places an interval at which a curve is compared with the image."""

BoolArray = np.typing.NDArray[np.bool_]


@attrs.frozen(eq=False)
class ImageIntersections:
    """Where images meet one plane, sorted by curve and parameter.

    Attributes
    ----------
    curve : (k,) int
        Curve of the batch.
    t : (k,), m
        Parameter on the curve before the mapping.
    xyz : (k, 3), m
        Places on the image.
    sign : (k,) int8
        +1 where the image rises through the plane, else -1.
    """

    curve: IntArray
    t: FloatArray
    xyz: FloatArray
    sign: np.typing.NDArray[np.int8]


@attrs.frozen(eq=False)
class CurveImages:
    """The image of a batch of curves.

    Attributes
    ----------
    space : SpaceMap
        The mapping.
    batch : SplineBatch
        The curves before it.
    curves : tuple of int
        Which curves of the hull these are.
    owner, t : (n,) int, (n,), m
        Sampled places: curve of the batch and parameter.
    before, after : (n, 3), m
        These places, and their images.
    """

    space: SpaceMap
    batch: SplineBatch
    curves: tuple[int, ...]
    owner: IntArray
    t: FloatArray
    before: FloatArray
    after: FloatArray

    @classmethod
    def of(cls, space: SpaceMap, batch: SplineBatch, curves: tuple[int, ...]) -> CurveImages:
        """Sample a batch of curves and map the samples."""
        first = segment_start(batch)
        part = np.arange(_SIDE_SAMPLES) / _SIDE_SAMPLES
        begin, end = batch.knot[first][:, None], batch.knot[first + 1][:, None]
        inner = (begin + (end - begin) * part).ravel()
        curve = np.searchsorted(batch.start, first, side="right") - 1
        owner = np.concatenate([np.repeat(curve, _SIDE_SAMPLES), np.arange(batch.count)])
        t = np.concatenate([inner, batch.knot[batch.start[1:] - 1]])
        order = np.lexsort((t, owner))
        owner, t = owner[order], t[order]
        before = evaluate(batch, owner, t)
        return cls(space, batch, curves, owner, t, before, space.places(before))

    def at(self, curve: IntArray, t: FloatArray) -> FloatArray:
        """Give places of the image, (k, 3), m, by curve and parameter before the mapping."""
        return self.space.places(evaluate(self.batch, curve, t))

    def changed(self, normal: FloatArray, old: float, new: float, near: float) -> BoolArray:
        """Tell which curves pass a plane otherwise than before, (m,) bool.

        Parameters
        ----------
        normal : (3,)
            Unit normal of the plane.
        old, new : float, m
            Its offset before and after.
        near : float, m
            Places as near to the plane as this do not count.
        """
        was, now = plane_heights(self.before, normal) - old, plane_heights(self.after, normal) - new
        other = ((was >= 0.0) != (now >= 0.0)) & ~((np.abs(was) <= near) & (np.abs(now) <= near))
        return np.bincount(self.owner[other], minlength=self.batch.count) > 0

    def meet(self, normals: FloatArray, offsets: FloatArray) -> list[ImageIntersections]:
        """Meet the images with planes, (p, 3) and (p,), m: plane by plane."""
        lows, levels = list[IntArray](), list[FloatArray]()
        same = self.owner[1:] == self.owner[:-1]
        for normal, offset in zip(normals, offsets.tolist(), strict=True):
            level = plane_heights(self.after, normal) - offset
            above = level >= 0.0
            lows.append(np.flatnonzero((above[1:] != above[:-1]) & same))
            levels.append(np.stack([level[lows[-1]], level[lows[-1] + 1]]))
        if not lows:
            return []
        # All planes at once: each call of a mapping costs more than the places that it maps.
        low, level = np.concatenate(lows), np.concatenate(levels, axis=1)
        plane = np.repeat(np.arange(len(lows)), [len(each) for each in lows])
        curve, sign = self.owner[low], np.where(level[0] >= 0.0, -1, 1).astype(np.int8)
        t = false_position(
            lambda rows, at: (
                plane_heights(self.at(curve[rows], at), normals[plane[rows]]) - offsets[plane[rows]]
            ),
            self.t[low], self.t[low + 1], level[0], level[1],
        )  # fmt: skip
        xyz = self.at(curve, t) if len(t) else np.zeros((0, 3))
        ends = np.searchsorted(plane, np.arange(len(lows) + 1))
        return [
            ImageIntersections(curve[a:b], t[a:b], xyz[a:b], sign[a:b])
            for a, b in pairwise(ends.tolist())
        ]


def image_misfit(
    image: CurveImages, curve: IntArray, batch: SplineBatch, at: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Compare curves with images between the points they were made through.

    Parameters
    ----------
    image : CurveImages
        The images.
    curve : (m,) int
        Which of them each curve of `batch` is to be.
    batch : SplineBatch
        Curves through points of the images.
    at : (n,), m
        Parameter, before the mapping, of every knot of `batch`.

    Returns
    -------
    away : (s,), m
        Per segment of `batch` the largest distance across the curve.
    middle : (s,), m
        Parameter, before the mapping, halfway along each segment.
    """
    first = segment_start(batch)
    owner = np.searchsorted(batch.start, first, side="right") - 1
    part: FloatArray = np.arange(1.0, _PROBES + 1.0) / (_PROBES + 1.0)
    many = np.repeat(owner, _PROBES)
    there = _within_segment(batch.knot, first, part)
    source = _within_segment(at, first, part)
    target = image.at(curve[many], source)
    for _ in range(2):
        slope = derivative(batch, many, there)
        step = target - evaluate(batch, many, there)
        along = (step * slope).sum(axis=1) / (slope * slope).sum(axis=1)
        there = np.clip(there + along, 0.0, batch.knot[batch.start[1:] - 1][many])
    step = target - evaluate(batch, many, there)
    slope = derivative(batch, many, there)
    step = step - ((step * slope).sum(axis=1) / (slope * slope).sum(axis=1))[:, None] * slope
    away = np.sqrt((step * step).sum(axis=1)).reshape(-1, _PROBES).max(axis=1)
    return away, 0.5 * (at[first] + at[first + 1])


def _within_segment(values: FloatArray, first: IntArray, part: FloatArray) -> FloatArray:
    low, high = values[first][:, None], values[first + 1][:, None]
    found: FloatArray = (low + (high - low) * part[None, :]).ravel()
    return found


_SAMPLES = 4
"""Places a segment through which the image is made."""

_APART = 0.05
"""Times `Tolerances.factor`: of places nearer than this (m) along the image one is enough."""

_FAR = 4.0
"""A foot farther along than so many slips from where it should be lies on another branch."""

_DOUBT = 0.05
"""Between two known places the distance is uncertain by this part of how much it changes."""


@attrs.frozen(eq=False)
class ProjectedImage:
    """The image of a curve in its plane, with the distances that are known.

    Attributes
    ----------
    spline : SplineBatch
        The image.
    t : (n,), m
        Parameter on the curve before the mapping, at the knots of the image.
    normal : (3,)
        Of the plane.
    knot, across : (k,), m
        Where distances are known, by the parameter of the image, and these: to the left of it.
    ends : (float, float), m
        How far its two ends slide along it, + onward.
    apart : float, m
        Of places nearer than this along the image one is enough.
    """

    spline: SplineBatch
    t: FloatArray
    normal: FloatArray
    knot: FloatArray
    across: FloatArray
    ends: tuple[float, float]
    apart: float

    def at(self, t: FloatArray) -> FloatArray:
        """Give where places of the curve come to, (k, 3), m, by the parameter before."""
        there = self._slid(np.interp(t, self.t, self.spline.knot))
        on = np.clip(there, 0.0, self.spline.knot[-1])
        off = _between(self.knot, self.across, there)
        curve = np.zeros(len(t), np.int64)
        slope = derivative(self.spline, curve, on)
        slope = slope / np.sqrt((slope * slope).sum(axis=1))[:, None]
        beyond = (there - on)[:, None] * slope
        left = _left(self.spline, self.normal, on)
        found: FloatArray = evaluate(self.spline, curve, on) + beyond + off[:, None] * left
        return found

    def doubt(self, t: FloatArray) -> FloatArray:
        """Give how uncertain these places are, (k,), m: what the way of interpolating changes."""
        there = self._slid(np.interp(t, self.t, self.spline.knot))
        straight = np.interp(there, self.knot, self.across)
        low = np.clip(np.searchsorted(self.knot, there, side="right") - 1, 0, len(self.knot) - 2)
        step = np.abs(np.diff(self.across))[low] if len(self.knot) > 1 else np.abs(self.across)
        found: FloatArray = np.abs(_between(self.knot, self.across, there) - straight)
        return found + _DOUBT * step

    def _slid(self, there: FloatArray) -> FloatArray:
        """Let places beside an end slide with it: less and less, to the first known place."""
        last = float(self.spline.knot[-1])
        first, final = float(self.knot[0]), float(self.knot[-1])
        found = there.copy()
        inner = self.knot[(self.knot > max(self.ends[0], 0.0) + self.apart)]
        if len(inner):
            first = float(inner[0])
        inner = self.knot[self.knot < last + min(self.ends[1], 0.0) - self.apart]
        if len(inner):
            final = float(inner[-1])
        near = (there < first) & (first > 0.0)
        found[near] += self.ends[0] * (1.0 - there[near] / first)
        near = (there > final) & (final < last)
        found[near] += self.ends[1] * (there[near] - final) / (last - final)
        return found


def projected_image(work: TransformationState, curve: int) -> ProjectedImage | None:
    """Lay the image of a follower into its plane; None where the hull is known nowhere there."""
    state, line = work.state, work.state.line_of(curve)
    apart = state.tolerances.factor * _APART
    normal, offset = work.planes.normal[line], float(work.planes.offset[line])
    t, before = _dense(state.spline(curve))
    image = work.space.places(before)
    image = image - ((image * normal).sum(axis=1) - offset)[:, None] * normal
    spline = loft(CurveData.single(image))
    rows, at = _known(work, curve)
    if not len(rows):
        return None
    there, foot, _ = closest_points(spline, 0, work.value[rows])
    step = work.value[rows] - foot
    beyond = _along(spline, there, step)
    slip = np.sqrt(((work.value[rows] - work.space.places(_places(work, curve, at))) ** 2).sum(1))
    good = np.abs(there - np.interp(at, t, spline.knot)) <= _FAR * slip + apart
    left = _left(spline, normal, there)
    across = (step * left).sum(axis=1) - gaps_across(work, curve, rows, left)
    there = there + np.where((there <= 0.0) | (there >= spline.knot[-1]), beyond, 0.0)
    order = np.flatnonzero(good)
    order = order[np.argsort(there[order], kind="stable")]
    if not len(order):
        return None
    order = order[np.concatenate([[True], np.diff(there[order]) > apart])]
    ends = _ends(work, curve, spline)
    return ProjectedImage(spline, t, normal, there[order], across[order], ends, apart)


def _ends(work: TransformationState, curve: int, spline: SplineBatch) -> tuple[float, float]:
    """Give how far the ends of a follower slide along its image, + onward."""
    found = [0.0, 0.0]
    for i, row in enumerate((work.end(curve, 0), work.end(curve, 1))):
        if not work.known[row]:
            continue
        at = np.array([0.0 if i == 0 else float(spline.knot[-1])])
        there, foot, _ = closest_points(spline, 0, work.value[[row]])
        along = _along(spline, there, work.value[[row]] - foot)
        found[i] = float(there[0] - at[0] + along[0])
    return found[0], found[1]


def _along(spline: SplineBatch, t: FloatArray, step: FloatArray) -> FloatArray:
    """Give how far steps (k, 3) from places of a curve lead along it, (k,), m."""
    slope = derivative(spline, np.zeros(len(t), np.int64), t)
    found: FloatArray = (step * slope).sum(axis=1) / np.sqrt((slope * slope).sum(axis=1))
    return found


def gaps_across(
    work: TransformationState, curve: int, rows: IntArray, left: FloatArray
) -> FloatArray:
    """Give how far lines that pass a follower unheard lay beside it before, (k,), m.

    Parameters
    ----------
    work : TransformationState
        The transformation.
    curve : int
        The follower.
    rows : (k,) int
        Crossings on it.
    left : (k, 3)
        Unit vectors across it there: the gap is given along these.
    """
    table = work.state.rows
    own = (table.curve[rows, 0] != curve).astype(np.int64)
    spot, every = table.spot[rows], np.arange(len(rows))
    heard = (table.reader[rows] == curve).any(axis=1)
    gap = ((spot[every, 1 - own] - spot[every, own]) * left).sum(axis=1)
    found: FloatArray = np.where(heard, 0.0, gap)
    return found


def _dense(spline: SplineBatch) -> tuple[FloatArray, FloatArray]:
    """Sample a curve: parameters and places, knots among them, each once."""
    part = np.arange(_SAMPLES) / _SAMPLES
    inner = spline.knot[:-1, None] + np.diff(spline.knot)[:, None] * part
    t = np.append(inner.ravel(), spline.knot[-1])
    return t, evaluate(spline, np.zeros(len(t), np.int64), t)


def _places(work: TransformationState, curve: int, t: FloatArray) -> FloatArray:
    return evaluate(work.state.spline(curve), np.zeros(len(t), np.int64), t)


def _left(spline: SplineBatch, normal: FloatArray, t: FloatArray) -> FloatArray:
    """Give unit vectors across a curve in its plane, (k, 3)."""
    slope = derivative(spline, np.zeros(len(t), np.int64), t)
    left = np.cross(normal, slope)
    found: FloatArray = left / np.sqrt((left * left).sum(axis=1))[:, None]
    return found


def _known(work: TransformationState, curve: int) -> tuple[IntArray, FloatArray]:
    """Give the points of a follower that are known already, and their parameters on it before."""
    state, table = work.state, work.state.rows
    meets: CurveIntersections = state.curves.meets[curve]
    own: IntArray = state.curves.rows[curve]
    at = dict(zip(meets.row.tolist(), meets.parameter.tolist(), strict=True))
    at |= dict(zip(own.tolist(), state.spline(curve).knot.tolist(), strict=True))
    ends = {work.end(curve, 0), work.end(curve, 1)}
    at |= {work.end(curve, side): float(state.spline(curve).knot[-side]) for side in (0, 1)}
    rows = [
        row for row in at
        if row >= 0 and work.known[row] and row not in work.gone
        and (row in ends or not table.contact[row]) and _first(work, row, curve)
    ]  # fmt: skip
    return np.array(rows, np.int64), np.array([at[row] for row in rows])


def _first(work: TransformationState, row: int, curve: int) -> bool:
    """Tell whether a point does not wait for its follower to be cut."""
    if work.state.rows.sort[row] != Sort.CROSSING or row in work.kept:
        return bool(work.direct[row]) or row in work.kept
    other = work.other(row, curve)
    return work.drives(other) or work.state.rank(other) < work.state.rank(curve)


def _between(at: FloatArray, values: FloatArray, where: FloatArray) -> FloatArray:
    """Interpolate values (k,) given at ascending parameters by cubics; constant beyond."""
    if len(at) == 1:
        return np.full(len(where), float(values[0]))
    step = np.diff(at)
    chord = np.diff(values) / step
    slope = np.empty_like(values)
    part = step[1:] / (step[1:] + step[:-1])
    slope[1:-1] = part * chord[:-1] + (1.0 - part) * chord[1:]
    slope[0], slope[-1] = chord[0], chord[-1]
    low = np.clip(np.searchsorted(at, where, side="right") - 1, 0, len(step) - 1)
    s = np.clip((where - at[low]) / step[low], 0.0, 1.0)
    found: FloatArray = values[low] + (values[low + 1] - values[low]) * (s * s * (3.0 - 2.0 * s))
    turn = (1.0 - s) * slope[low] - s * slope[low + 1]
    return np.asarray(found + step[low] * s * (1.0 - s) * turn)

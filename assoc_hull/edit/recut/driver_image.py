"""The exact image of curves under a mapping: where it meets planes, how well a curve fits it.

The image of a spline is not the spline through the images of its points. Cuts are made
with the image itself, so a crossing does not depend on how the curve is lofted again.
"""

from __future__ import annotations

from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.edit.mapped_planes import plane_heights
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.numeric.roots import false_position
from assoc_hull.geometry.splines.evaluation import derivative, evaluate
from assoc_hull.geometry.splines.segments import segment_start

__all__ = ["CurveImages", "ImageIntersections", "image_misfit"]

_SAMPLES = 16
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
        part = np.arange(_SAMPLES) / _SAMPLES
        begin, end = batch.knot[first][:, None], batch.knot[first + 1][:, None]
        inner = (begin + (end - begin) * part).ravel()
        curve = np.searchsorted(batch.start, first, side="right") - 1
        owner = np.concatenate([np.repeat(curve, _SAMPLES), np.arange(batch.count)])
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
    there = _between(batch.knot, first, part)
    source = _between(at, first, part)
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


def _between(values: FloatArray, first: IntArray, part: FloatArray) -> FloatArray:
    low, high = values[first][:, None], values[first + 1][:, None]
    found: FloatArray = (low + (high - low) * part[None, :]).ravel()
    return found

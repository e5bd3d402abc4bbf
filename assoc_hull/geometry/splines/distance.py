"""Distances between points and curves, and between curves and curves.

`closest_points` finds the point of a curve with the least distance over the whole curve, not the
next minimum of a search: on each segment all roots of a quintic are found. `farthest_points` gives
the Hausdorff distance of pairs of curves: of every place of one the nearest of the other, both
ways round, and the farthest of these. It looks in steps and then ever closer.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner, unit_roots
from assoc_hull.geometry.splines.segments import (
    bezier_points,
    positions,
    power_coefficients,
    segment_start,
)

__all__ = [
    "FarthestPoints",
    "OwnedCurves",
    "closest_points",
    "closest_points_each",
    "farthest_points",
    "identical_curves",
]

# --------------------------------------------------------------------------------------
# The closest point of a curve. Segments whose box is farther than the nearest knot are left out.

_PAIRS = 200_000  # pairs of point and segment that are looked at together
_TIE = 16 * np.finfo(np.float64).eps  # of the coordinates: rounding of a distance


def closest_points(
    batch: SplineBatch, curve_index: int, points: ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Find the closest point of one curve, its ends included, for each of many points.

    Of several places at the same distance (to rounding) the first along the curve is taken.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    curve_index : int
        The curve.
    points : (k, 3), m
        The points.

    Returns
    -------
    t : (k,), m
        Chord-length parameter of the closest point.
    xyz : (k, 3), m
        The closest point.
    distance : (k,), m
        Its distance.

    Raises
    ------
    BadInputError
        There is no such curve, or the points are not rows of three finite numbers.
    TooFewPointsError
        The curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.distance import closest_points
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> xyz = np.array([[0.0, 0, 0], [4, 0, 0]])
    >>> along = np.array([[1.0, 0, 0], [1, 0, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 4]), xyz, along, along.copy())
    >>> t, foot, distance = closest_points(line, 0, [[1, 2, 0], [7, 4, 0]])
    >>> t.tolist(), distance.tolist()
    ([1.0, 4.0], [2.0, 5.0])
    """
    if not 0 <= curve_index < batch.count:
        raise BadInputError(
            f"curve {curve_index} of a batch of {batch.count}",
            "where the closest point was asked",
            "give an index from 0",
        )
    rows = _checked(points)
    curve = batch if batch.count == 1 else batch.part(int(curve_index), int(curve_index) + 1)
    return _nearest(curve, np.zeros(len(rows), np.int64), rows)


def closest_points_each(
    batch: SplineBatch, curves: IntArray, points: ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Find for each of many points (k, 3), m, the closest point of a curve of its own, curves (k,).

    Gives t (k,), points (k, 3) and distances (k,), m, as `closest_points` does, to the last bit.

    Raises
    ------
    BadInputError
        There is no such curve, or the points are not rows of three finite numbers.
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.distance import closest_points_each
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> xyz = np.array([[0.0, 0, 0], [4, 0, 0], [0, 3, 0], [4, 3, 0]])
    >>> along = np.ones((4, 1)) * [1.0, 0, 0]
    >>> lines = SplineBatch(np.array([0, 2, 4]), np.array([0.0, 4, 0, 4]), xyz, along, along)
    >>> closest_points_each(lines, np.array([1, 0]), [[1, 2, 0], [1, 2, 0]])[2].tolist()
    [1.0, 2.0]
    """
    rows, curves = _checked(points), np.asarray(curves, np.int64)
    if curves.shape != rows.shape[:1] or np.any((curves < 0) | (curves >= batch.count)):
        raise BadInputError(
            f"{len(rows)} points, and curves {curves.tolist()[:9]} of a batch of {batch.count}",
            "where the closest points were asked",
            "give each point an index from 0",
        )
    order = np.argsort(curves, kind="stable")
    found = _nearest(batch, curves[order], rows[order])
    back = np.empty(len(order), np.int64)
    back[order] = np.arange(len(order))
    t, xyz, distance = (part[back] for part in found)
    freeze(t, xyz, distance)
    return t, xyz, distance


def _checked(points: ArrayLike) -> FloatArray:
    """Give points as an array, or say what is wrong with them."""
    rows = np.asarray(points, np.float64)
    if rows.ndim != 2 or rows.shape[1] != 3 or not np.isfinite(rows).all():
        raise BadInputError(
            f"points of shape {rows.shape}, or with numbers that are not finite",
            "where the closest point was asked",
            "give rows of three finite coordinates",
        )
    return rows


def _nearest(
    batch: SplineBatch, curves: IntArray, points: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give t, position and distance of the closest points; the curves ascend."""
    parts = [_nearest_of(batch, runs, points) for runs in _portions(batch, curves)]
    none = (np.zeros(0), np.zeros((0, 3)), np.zeros(0))
    t, xyz, distance = (np.concatenate(each) for each in zip(none, *parts, strict=True))
    freeze(t, xyz, distance)
    return t, xyz, distance


_Run = tuple[int, int, int]
"""A curve, its first point, and the one after its last."""


def _portions(batch: SplineBatch, curves: IntArray) -> Iterator[list[_Run]]:
    """Divide points by their curves, and into portions that need little memory."""
    portion, room = list[_Run](), _PAIRS
    edges = [0, *(np.flatnonzero(np.diff(curves)) + 1).tolist(), len(curves)]
    for first, last in itertools.pairwise(edges if len(curves) else []):
        curve = int(curves[first])
        segments = max(1, int(batch.start[curve + 1] - batch.start[curve]) - 1)
        size = max(1, _PAIRS // segments)
        for begin in range(first, last, size):
            end = min(begin + size, last)
            if portion and (end - begin) * segments > room:
                yield portion
                portion, room = [], _PAIRS
            portion.append((curve, begin, end))
            room -= (end - begin) * segments
    if portion:
        yield portion


def _nearest_of(
    batch: SplineBatch, runs: list[_Run], points: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give the closest points of a portion."""
    low = runs[0][1]
    points = points[low : runs[-1][2]]
    items, segments, slack = [], [], np.abs(points).max(axis=1)
    for number, begin, end in runs:
        curve = batch if batch.count == 1 else batch.part(number, number + 1)
        mine = slice(begin - low, end - low)
        item, segment = _candidates(curve, points[mine])
        items.append(item + (begin - low))
        segments.append(segment + (int(batch.start[number]) - number))
        slack[mine] = _TIE * (np.abs(curve.xyz).max() + slack[mine])
    item, segment = np.concatenate(items), np.concatenate(segments)
    t, xyz, distance = _extremes(batch, segment, points[item])
    begins = np.searchsorted(item, np.arange(len(points)))
    least = np.minimum.reduceat(distance.min(axis=1), begins)
    # Pairs and their places run along the curve, so the first good one has the lowest t.
    good = distance <= (least + slack)[item][:, None]
    rank = np.where(good, np.arange(good.size).reshape(good.shape), good.size)
    chosen = np.minimum.reduceat(rank.min(axis=1), begins)
    return t.ravel()[chosen], xyz.reshape(-1, 3)[chosen], distance.ravel()[chosen]


def _candidates(curve: SplineBatch, points: FloatArray) -> tuple[IntArray, IntArray]:
    """Pair each point with the segments that may hold its closest point."""
    control = bezier_points(curve)
    low, high = control.min(axis=1), control.max(axis=1)
    box, knot = np.zeros((len(points), len(low))), np.zeros((len(points), len(low) + 1))
    for axis in range(3):
        at = points[:, axis, None]
        outside = np.maximum(np.maximum(low[:, axis] - at, at - high[:, axis]), 0.0)
        box += outside * outside
        knot += (curve.xyz[:, axis] - at) ** 2
    near = knot.min(axis=1, keepdims=True) * (1.0 + 1e-9)
    slack = (_TIE * np.abs(control).max()) ** 2
    item, segment = np.nonzero(box <= near + slack)
    return item, segment


def _extremes(
    batch: SplineBatch, segment: IntArray, points: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give t, position and distance of all extremes and ends, (p, 7) for p pairs."""
    local, knot = power_coefficients(batch)[segment], segment_start(batch)[segment]
    local[:, 0] -= points
    roots = unit_roots(_quintic(local, differentiate(local)))
    end = np.ones((len(segment), 1))
    u = np.concatenate([0.0 * end, roots, end], axis=1)
    place, at = points[:, None], u[:, :, None]
    begin, finish = batch.xyz[knot, None], batch.xyz[knot + 1, None]
    offset = np.where(at == 1.0, finish - place, horner(local, u))
    distance = np.sqrt((offset * offset).sum(axis=2))
    # At a knot the defining point itself, whatever rounding says.
    xyz = np.where(at == 0.0, begin, np.where(at == 1.0, finish, offset + place))
    low, high = batch.knot[knot, None], batch.knot[knot + 1, None]
    t = np.where(u == 1.0, high, low + u * (high - low))
    return t, xyz, distance


def _quintic(offset: FloatArray, slopes: FloatArray) -> FloatArray:
    """Give the coefficients of (P(u) - q) . P'(u), (p, 6)."""
    product = np.zeros((len(offset), 6))
    for i in range(4):
        for j in range(3):
            product[:, i + j] += (offset[:, i] * slopes[:, j]).sum(axis=1)
    return product


# --------------------------------------------------------------------------------------
# The largest of all nearest distances of two families of curves, pair by pair.

_PARTS = 4
"""Places on each segment at which distances are first taken."""

_LOOKS, _FAN = 4, np.linspace(-1.0, 1.0, 9)
"""How often it is looked closer, and at which places within the step last taken."""

_NONE = SplineBatch(np.zeros(1, np.int64), np.zeros(0), *np.zeros((3, 0, 3)))


@attrs.frozen(eq=False)
class OwnedCurves:
    """Curves that belong to things: several may make up one.

    Attributes
    ----------
    curves : SplineBatch
        The curves, those of one thing behind one another.
    owner : (m,) int
        The thing that each belongs to; ascending.
    """

    curves: SplineBatch
    owner: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.owner)
        if self.owner.shape != (self.curves.count,) or np.any(np.diff(self.owner) < 0):
            raise BadInputError(
                f"owners {self.owner.tolist()[:9]} of {self.curves.count} curves",
                "where distances of curves were asked",
                "give each curve one, ascending",
            )

    @classmethod
    def of(cls, things: Sequence[Sequence[SplineBatch]]) -> OwnedCurves:
        """Put the curves of things behind one another; each has at least one."""
        owner = [i for i, curves in enumerate(things) for each in curves for _ in range(each.count)]
        every = [each for curves in things for each in curves]
        return cls(SplineBatch.join(every) if every else _NONE, np.array(owner, np.int64))


@attrs.frozen(eq=False)
class FarthestPoints:
    """Where things lie farthest apart, one by one.

    Attributes
    ----------
    one, other : (n, 3), m
        A place on either, each the nearest of the other or of all places the farthest.
    distance : (n,), m
        Between the two.
    """

    one: FloatArray
    other: FloatArray
    distance: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.one, self.other, self.distance)


def farthest_points(one: OwnedCurves, other: OwnedCurves) -> FarthestPoints:
    """Find where each thing lies farthest from its partner, both ways round; sorted by owner.

    `one` and `other` are the same things in two shapes: both have the owners 0 to n - 1. A place
    found is the summit of what steps of a quarter of a segment show, to a thousandth of a segment.

    Raises
    ------
    BadInputError
        Owners that are not the same, or do not begin at 0.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.geometry.splines.distance import farthest_points, OwnedCurves
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> level = loft(CurveData.single(np.array([[0.0, 0, 0], [4, 0, 0]])))
    >>> raised = loft(CurveData.single(np.array([[0.0, 1, 0], [4, 3, 0]])))
    >>> found = farthest_points(
    ...     OwnedCurves(level, np.array([0])), OwnedCurves(raised, np.array([0]))
    ... )
    >>> found.one.tolist(), found.other.tolist(), found.distance.tolist()
    ([[4.0, 0.0, 0.0]], [[4.0, 3.0, 0.0]], [3.0])
    """
    names = np.unique(one.owner)
    if not np.array_equal(names, np.unique(other.owner)) or np.any(names != np.arange(len(names))):
        raise BadInputError(
            f"owners {names.tolist()[:9]} and {np.unique(other.owner).tolist()[:9]}",
            "where distances of curves were asked",
            "give both the same ones, from 0",
        )
    if not len(names):
        return FarthestPoints(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))
    there, back = _one_way(one, other), _one_way(other, one)
    outward = (there.distance >= back.distance)[:, None]
    return FarthestPoints(
        np.where(outward, there.one, back.other),
        np.where(outward, there.other, back.one),
        np.maximum(there.distance, back.distance),
    )


def identical_curves(one: Sequence[SplineBatch], other: Sequence[SplineBatch]) -> bool:
    """Say whether two things are of the same curves, to the last bit.

    Examples
    --------
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.geometry.splines.distance import identical_curves
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [4, 0, 0]])))
    >>> identical_curves([line], [line]), identical_curves([line], [line, line])
    (True, False)
    """
    names = ("knot", "xyz", "leave", "arrive")
    return len(one) == len(other) and all(
        getattr(a, name).tobytes() == getattr(b, name).tobytes()
        for a, b in zip(one, other, strict=True)
        for name in names
    )


@attrs.frozen(eq=False)
class _Places:
    """Places on curves.

    Attributes
    ----------
    curve : (k,) int
        The curve of each.
    at : (k,)
        Number of the knot before it in the batch, and the part of the segment behind that.
    """

    curve: IntArray
    at: FloatArray


def _one_way(mine: OwnedCurves, theirs: OwnedCurves) -> FarthestPoints:
    """Find the place of each thing that lies farthest from its partner."""
    places, reach = _steps(mine.curves), 1.0 / _PARTS
    chosen, found = _farthest_of(mine, theirs, places)
    for _ in range(_LOOKS):
        places = _around(mine.curves, places.curve[chosen], places.at[chosen], reach)
        chosen, found = _farthest_of(mine, theirs, places)
        reach *= _FAN[-1] - _FAN[-2]
    return found


def _steps(curves: SplineBatch) -> _Places:
    """Take every knot, and places between."""
    count = _PARTS * (np.diff(curves.start) - 1) + 1
    curve = np.repeat(np.arange(curves.count), count)
    step = np.arange(len(curve)) - (np.cumsum(count) - count)[curve]
    return _Places(curve, curves.start[curve] + step / _PARTS)


def _around(curves: SplineBatch, curve: IntArray, at: FloatArray, reach: float) -> _Places:
    """Take places about one on each curve; those beyond its ends are the ends."""
    low, high = curves.start[curve], curves.start[curve + 1] - 1
    fan = np.clip(at[:, None] + reach * _FAN, low[:, None], high[:, None])
    return _Places(np.repeat(curve, len(_FAN)), fan.ravel())


def _farthest_of(
    mine: OwnedCurves, theirs: OwnedCurves, places: _Places
) -> tuple[IntArray, FarthestPoints]:
    """Choose of places the farthest of each thing: their numbers, and what they are."""
    knot = np.minimum(places.at.astype(np.int64), mine.curves.start[places.curve + 1] - 2)
    points = positions(mine.curves, knot, places.at - knot).T
    owner = mine.owner[places.curve]
    first = np.searchsorted(theirs.owner, owner)
    count = np.searchsorted(theirs.owner, owner, side="right") - first
    begin = np.cumsum(count) - count
    item = np.repeat(np.arange(len(points)), count)
    partner = first[item] + np.arange(len(item)) - begin[item]
    _, foot, distance = closest_points_each(theirs.curves, partner, points[item])
    near = _first_of(distance, begin, np.minimum)
    things = np.flatnonzero(np.diff(owner, prepend=-1))
    far = _first_of(distance[near], things, np.maximum)
    return far, FarthestPoints(points[far], foot[near[far]], distance[near[far]])


def _first_of(values: FloatArray, begin: IntArray, choose: np.ufunc) -> IntArray:
    """Give for each run of values the number of its first least, or greatest, one."""
    best = np.repeat(choose.reduceat(values, begin), np.diff(begin, append=len(values)))
    ranks = np.where(values == best, np.arange(len(values)), len(values))
    found: IntArray = np.minimum.reduceat(ranks, begin)
    return found

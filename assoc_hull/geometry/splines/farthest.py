"""How far two families of curves lie apart, pair by pair: the largest of all nearest distances.

Of every place of one curve the nearest place of the other is sought, both ways round; the
farthest of these pairs is the Hausdorff distance of the two curves. Curves are first looked at in
steps, then ever closer about the place that was found; all pairs go through together.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.closest import closest_each
from assoc_hull.geometry.splines.evaluation import positions

__all__ = ["Farthest", "Owned", "farthest", "same_bits"]

_PARTS = 4
"""Places on each segment at which distances are first taken."""

_LOOKS, _FAN = 4, np.linspace(-1.0, 1.0, 9)
"""How often it is looked closer, and at which places within the step last taken."""

_NONE = SplineBatch(np.zeros(1, np.int64), np.zeros(0), *np.zeros((3, 0, 3)))


@attrs.frozen(eq=False)
class Owned:
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
    def of(cls, things: Sequence[Sequence[SplineBatch]]) -> Owned:
        """Put the curves of things behind one another; each has at least one."""
        owner = [i for i, curves in enumerate(things) for each in curves for _ in range(each.count)]
        every = [each for curves in things for each in curves]
        return cls(SplineBatch.join(every) if every else _NONE, np.array(owner, np.int64))


@attrs.frozen(eq=False)
class Farthest:
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


def farthest(one: Owned, other: Owned) -> Farthest:
    """Find where each thing lies farthest from its partner, both ways round.

    A place found is the summit of what steps of a quarter of a segment show, to a thousandth of
    a segment.

    Parameters
    ----------
    one, other : Owned
        The same things in two shapes: both have the owners 0 to n - 1.

    Returns
    -------
    Farthest
        By owner.

    Raises
    ------
    BadInputError
        Owners that are not the same, or begin not at 0.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.geometry.splines.farthest import farthest, Owned
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> level = loft(CurveData.single(np.array([[0.0, 0, 0], [4, 0, 0]])))
    >>> raised = loft(CurveData.single(np.array([[0.0, 1, 0], [4, 3, 0]])))
    >>> found = farthest(Owned(level, np.array([0])), Owned(raised, np.array([0])))
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
        return Farthest(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))
    there, back = _one_way(one, other), _one_way(other, one)
    outward = (there.distance >= back.distance)[:, None]
    return Farthest(
        np.where(outward, there.one, back.other),
        np.where(outward, there.other, back.one),
        np.maximum(there.distance, back.distance),
    )


def same_bits(one: Sequence[SplineBatch], other: Sequence[SplineBatch]) -> bool:
    """Tell whether two things are of the same curves, to the last bit.

    Examples
    --------
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.geometry.splines.farthest import same_bits
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [4, 0, 0]])))
    >>> same_bits([line], [line]), same_bits([line], [line, line])
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


def _one_way(mine: Owned, theirs: Owned) -> Farthest:
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


def _farthest_of(mine: Owned, theirs: Owned, places: _Places) -> tuple[IntArray, Farthest]:
    """Choose of places the farthest of each thing: their numbers, and what they are."""
    knot = np.minimum(places.at.astype(np.int64), mine.curves.start[places.curve + 1] - 2)
    points = positions(mine.curves, knot, places.at - knot).T
    owner = mine.owner[places.curve]
    first = np.searchsorted(theirs.owner, owner)
    count = np.searchsorted(theirs.owner, owner, side="right") - first
    begin = np.cumsum(count) - count
    item = np.repeat(np.arange(len(points)), count)
    partner = first[item] + np.arange(len(item)) - begin[item]
    _, foot, distance = closest_each(theirs.curves, partner, points[item])
    near = _first_of(distance, begin, np.minimum)
    things = np.flatnonzero(np.diff(owner, prepend=-1))
    far = _first_of(distance[near], things, np.maximum)
    return far, Farthest(points[far], foot[near[far]], distance[near[far]])


def _first_of(values: FloatArray, begin: IntArray, choose: np.ufunc) -> IntArray:
    """Give for each run of values the number of its first least, or greatest, one."""
    best = np.repeat(choose.reduceat(values, begin), np.diff(begin, append=len(values)))
    ranks = np.where(values == best, np.arange(len(values)), len(values))
    found: IntArray = np.minimum.reduceat(ranks, begin)
    return found

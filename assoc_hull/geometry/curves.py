"""Ragged batches of curves: data of splines, the splines, and isocurves of surfaces.

Many curves of different lengths lie one behind the other in flat arrays. ``start`` holds where each
begins: curve ``i`` owns the rows ``start[i]:start[i + 1]``, as in the offsets of an Arrow list
array. All arrays are frozen (``writeable=False``). `Strips` is who gives curves across a surface at
any parameter v along it: a net of lofted lines, or a hull known by a formula.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.curves import CurveData
>>> CurveData.single(np.array([[0.0, 0, 0], [1, 0, 0], [2, 1, 0]])).count
1
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from enum import IntEnum
from functools import lru_cache
from typing import NoReturn, Protocol, Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import no_member

__all__ = [
    "CurveData",
    "EndKind",
    "FloatArray",
    "IntArray",
    "IsoCurves",
    "PointKind",
    "SplineBatch",
    "Strips",
    "freeze",
]

# --------------------------------------------------------------------------------------
# Ragged batches of curves: the data the splines are made from, and the splines.
#
# Many curves of different lengths lie one behind the other in flat arrays. ``start`` holds
# where each begins: curve ``i`` owns the rows ``start[i]:start[i + 1]``, as in the offsets of
# an Arrow list array. All arrays are frozen (``writeable=False``).

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


class PointKind(IntEnum):
    """How a curve passes through a defining point."""

    SMOOTH = 0
    TANGENT = 1
    KNUCKLE = 2

    @classmethod
    def _missing_(cls, value: object) -> NoReturn:
        raise no_member(cls, value)


class EndKind(IntEnum):
    """What is given at an end of a curve."""

    FREE = 0
    TANGENT = 1
    CURVATURE = 2


def freeze(*arrays: NDArray[np.generic]) -> None:
    """Make arrays read-only."""
    for array in arrays:
        array.setflags(write=False)


@attrs.frozen(eq=False)
class CurveData:
    """What a batch of curves is made from.

    Attributes
    ----------
    start : (m + 1,) int
        Where each curve begins; the last entry is n.
    xyz : (n, 3), m
        The defining points, curve by curve, in order.
    kind : (n,) int8
        A `PointKind` per point; what is said of the first and last point of a curve is
        ignored, its end is governed by `end_kind`.
    direction : (n, 3)
        Given direction at tangent points (any length but zero, along the sense of the
        curve); ignored elsewhere.
    end_kind : (m, 2) int8
        An `EndKind` for the first and last point of each curve.
    end_vector : (m, 2, 3)
        The direction along the sense of the curve (`TANGENT`), or the second derivative
        with respect to chord length, 1/m (`CURVATURE`); ignored at free ends.
    """

    start: IntArray
    xyz: FloatArray
    kind: NDArray[np.int8]
    direction: FloatArray
    end_kind: NDArray[np.int8]
    end_vector: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.xyz, self.kind, self.direction, self.end_kind, self.end_vector)

    @property
    def count(self) -> int:
        """Number of curves."""
        return len(self.start) - 1

    @classmethod
    def single(
        cls,
        xyz: FloatArray,
        kind: Sequence[int] | NDArray[np.int8] | None = None,
        direction: FloatArray | None = None,
        end_kind: tuple[int, int] = (EndKind.FREE, EndKind.FREE),
        end_vector: FloatArray | None = None,
    ) -> Self:
        """Give the data of one curve; arrays as in the class, without the leading batch axis."""
        n = len(xyz)
        return cls(
            np.array([0, n], np.int64),
            np.array(xyz, np.float64),
            np.zeros(n, np.int8) if kind is None else np.array(kind, np.int8),
            np.zeros((n, 3)) if direction is None else np.array(direction, np.float64),
            np.array([end_kind], np.int8),
            np.zeros((1, 2, 3)) if end_vector is None else np.array(end_vector, np.float64)[None],
        )

    def through(self, keep: NDArray[np.bool_]) -> CurveData:
        """Give the curves through some of their points (n,); a curve of none is left out.

        The end conditions are those that were: they hold at the ends that stay.
        """
        size = np.add.reduceat(keep.astype(np.int64), self.start[:-1])
        some = np.flatnonzero(size)
        start = np.zeros(len(some) + 1, np.int64)
        np.cumsum(size[some], out=start[1:])
        return CurveData(
            start, self.xyz[keep], self.kind[keep], self.direction[keep], self.end_kind[some],
            self.end_vector[some],
        )  # fmt: skip


@attrs.frozen(eq=False)
class SplineBatch:
    """Cubic composite splines, segment by segment in Hermite form.

    Between the knots i and i + 1 of one curve lies the cubic with the end points
    ``xyz[i], xyz[i + 1]`` and the end derivatives ``leave[i], arrive[i + 1]`` with respect
    to the chord-length parameter ``knot``.

    Attributes
    ----------
    start : (m + 1,) int
        Where each curve's knots begin.
    knot : (n,), m
        Chord-length parameter, from 0 at the first point of each curve.
    xyz : (n, 3), m
        The defining points.
    leave, arrive : (n, 3)
        Derivative after and before each knot; they differ at knuckles only.
    home, place : SplineBatch or None, int
        The batch that a single curve is a view of, and its place there; `join` then need not
        copy. The two are no tuple: the collector of garbage would have one more thing to look at.
    """

    start: IntArray
    knot: FloatArray
    xyz: FloatArray
    leave: FloatArray
    arrive: FloatArray
    home: SplineBatch | None = attrs.field(default=None, repr=False)
    place: int = attrs.field(default=0, repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.knot, self.xyz, self.leave, self.arrive)

    @property
    def count(self) -> int:
        """Number of curves."""
        return len(self.start) - 1

    def curve(self, index: int) -> SplineBatch:
        """Give one curve of the batch as a batch of one; the arrays are copies."""
        a, b = int(self.start[index]), int(self.start[index + 1])
        return SplineBatch(
            np.array([0, b - a], np.int64),
            self.knot[a:b].copy(),
            self.xyz[a:b].copy(),
            self.leave[a:b].copy(),
            self.arrive[a:b].copy(),
        )

    def part(self, first: int, stop: int) -> SplineBatch:
        """Give the curves from `first` to before `stop`, without copying."""
        if first == 0 and stop == self.count:
            return self
        a, b = int(self.start[first]), int(self.start[stop])
        return SplineBatch(
            self.start[first : stop + 1] - a,
            self.knot[a:b],
            self.xyz[a:b],
            self.leave[a:b],
            self.arrive[a:b],
        )

    def take(self, places: IntArray) -> SplineBatch:
        """Give some of the curves, in any order; the arrays are copies."""
        count = (self.start[1:] - self.start[:-1]).take(places)
        start = np.zeros(len(places) + 1, np.int64)
        np.cumsum(count, out=start[1:])
        knots = np.arange(start[-1]) + np.repeat(self.start.take(places) - start[:-1], count)
        return SplineBatch(
            start, self.knot.take(knots), self.xyz.take(knots, axis=0),
            self.leave.take(knots, axis=0), self.arrive.take(knots, axis=0),
        )  # fmt: skip

    def single(self) -> list[SplineBatch]:
        """Give each curve as a batch of one; the arrays are views."""
        knot, xyz, leave, arrive = self.knot, self.xyz, self.leave, self.arrive
        found: list[SplineBatch] = []
        for place, (a, b) in enumerate(itertools.pairwise(self.start.tolist())):
            # Views of frozen arrays are frozen: the checks of a constructor are not needed.
            one = _new(SplineBatch)
            _set_start(one, _span(b - a))
            _set_knot(one, knot[a:b])
            _set_xyz(one, xyz[a:b])
            _set_leave(one, leave[a:b])
            _set_arrive(one, arrive[a:b])
            _set_home(one, self)
            _set_place(one, place)
            found.append(one)
        return found

    @classmethod
    def join(cls, parts: Sequence[SplineBatch]) -> SplineBatch:
        """Put batches one behind the other; neighbours in one batch need no copy."""
        batch = parts[0].home if len(parts) > 1 else None
        if batch is not None and all(part.home is batch for part in parts):
            places = [part.place for part in parts]
            first, last = places[0], places[-1]
            if places == list(range(first, last + 1)):
                return batch.part(first, last + 1)
            return batch.take(np.array(places))
        runs = list(_runs(parts))
        if len(runs) == 1:
            return runs[0]
        counts = np.concatenate([np.diff(part.start) for part in runs])
        start = np.zeros(len(counts) + 1, np.int64)
        np.cumsum(counts, out=start[1:])
        return cls(
            start,
            np.concatenate([part.knot for part in runs]),
            np.concatenate([part.xyz for part in runs]),
            np.concatenate([part.leave for part in runs]),
            np.concatenate([part.arrive for part in runs]),
        )


_new = object.__new__
_set_start, _set_knot, _set_xyz, _set_leave, _set_arrive, _set_home, _set_place = (
    getattr(SplineBatch, field.name).__set__ for field in attrs.fields(SplineBatch)
)


@lru_cache(maxsize=1024)
def _span(count: int) -> IntArray:
    start = np.array([0, count], np.int64)
    freeze(start)
    return start


def _runs(parts: Sequence[SplineBatch]) -> Iterator[SplineBatch]:
    """Put curves that are neighbours in the batch they come from together again."""
    i = 0
    while i < len(parts):
        batch, first = parts[i].home, parts[i].place
        stop = i + 1
        if batch is None:
            yield parts[i]
        else:
            while stop < len(parts):
                other = parts[stop]
                if other.home is not batch or other.place != first + stop - i:
                    break
                stop += 1
            yield batch.part(first, first + stop - i)
        i = stop


# --------------------------------------------------------------------------------------
# Curves across a surface: what every integral over a hull is taken on.
#
# One half of a hull (port, y >= 0) is a few *strips*: patches ``P(u, v)`` in which u runs up,
# from keel to deck, and v forward, so that ``P_u x P_v`` points out of the ship. For a fixed v
# a strip gives one curve, cut into *tiles* along u; on each tile both P and the derivative
# P_v are cubics in u. In most strips the curve is a section (x is constant); at a raked stem
# it need not be.
#
# Whoever gives such curves at any v is a `Strips`: a net of lofted lines does, and so does a
# hull known by a formula. The integration is the same for both.


@attrs.frozen(eq=False)
class IsoCurves:
    """Curves v = const of strips, tile by tile.

    Attributes
    ----------
    start : (k + 1,) int
        Where the tiles of each curve begin; the tiles of one curve follow one another from
        keel to deck and join without a gap.
    point : (s, 4, 3), m
        Coefficients of P in 1, u, u^2, u^3, with u from 0 to 1 along each tile.
    across : (s, 4, 3), m
        The same of the derivative P_v.
    deck : (s,) bool
        The tile is a closed deck, which is hull for volumes but no part of the shell.
    """

    start: IntArray
    point: FloatArray
    across: FloatArray
    deck: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.point, self.across, self.deck)

    @property
    def count(self) -> int:
        """Number of curves."""
        return len(self.start) - 1


class Strips(Protocol):
    """One half of a hull as strips, each with v from 0 to 1."""

    @property
    def count(self) -> int:
        """Number of strips."""
        ...

    @property
    def order(self) -> IntArray:
        """How many Gauss points along v each strip wants where nothing happens inside, (count,)."""
        ...

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """Give one curve for each pair of a strip and a v, (k,) each, in that order."""
        ...

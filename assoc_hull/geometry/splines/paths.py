"""Paths: parts of splines put one behind the other, walked from 0 to 1.

A path is a run of *bits*, each a stretch of one segment of a batch of splines, in either
sense. Its fraction w grows with chord length, so that a path over several segments is as
smooth as the splines are. `StripTiles` says of which paths the tiles of curves across strips of a
Coons surface consist; it stands here because the compiled kernels take it.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.geometry.splines.segments import power_coefficients, segment_start

__all__ = [
    "QUICK",
    "SMALL",
    "Bit",
    "PathShapes",
    "Paths",
    "StripTiles",
    "bit_lengths",
    "shape_paths",
]


@attrs.frozen(eq=False)
class StripTiles:
    """What curves across given strips are made of, whatever the shape.

    Attributes
    ----------
    start : (k + 1,) int
        Where the tiles of each curve begin.
    curve, tile : (s,) int
        The curve of each tile, and the tile of the cells it is.
    first : (s,) int
        The first of the four anchors that shape it, counted through all curves.
    deck : (s,) bool
        It is closed deck.
    anchors : int
        Number of anchors of all curves.
    plane, other : ((a,), (a,), (a,)) int
        Anchors that are walked by x, and by their length: their numbers, paths and curves.
    """

    start: IntArray
    curve: IntArray
    tile: IntArray
    first: IntArray
    deck: NDArray[np.bool_]
    anchors: int
    plane: tuple[IntArray, IntArray, IntArray]
    other: tuple[IntArray, IntArray, IntArray]


Bit = tuple[int, float, float]
"""A segment, and the parameters (0 to 1) between which it is walked; backward if they fall."""

_STEPS = 60
"""Halvings of a bracket at most; Newton's rule needs four or five steps."""

_DONE = 1e-15

QUICK, SMALL = 8, 1e-9
"""Steps of Newton's rule without a bracket, and the last of them at most."""


@attrs.frozen(eq=False)
class Paths:
    """Many paths over the segments of one batch.

    Attributes
    ----------
    start : (p + 1,) int
        Where the bits of each path begin.
    segment : (b,) int
        The segment each bit lies on, numbered through the batch.
    low, high : (b,)
        The parameter of the segment where the bit begins and ends.
    """

    start: IntArray
    segment: IntArray
    low: FloatArray
    high: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.segment, self.low, self.high)

    @property
    def count(self) -> int:
        """Number of paths."""
        return len(self.start) - 1

    @classmethod
    def of(cls, paths: Sequence[Sequence[Bit]]) -> Paths:
        """Make paths from lists of bits."""
        start = np.zeros(len(paths) + 1, np.int64)
        np.cumsum([len(path) for path in paths], out=start[1:])
        bits = [bit for path in paths for bit in path]
        return cls(
            start,
            np.array([bit[0] for bit in bits], np.int64),
            np.array([bit[1] for bit in bits], np.float64),
            np.array([bit[2] for bit in bits], np.float64),
        )


@attrs.frozen(eq=False)
class PathShapes:
    """The shapes of paths on given splines.

    Attributes
    ----------
    paths : Paths
        The paths.
    cubic : (b, 4, 3), m
        Each bit as a cubic in its own parameter from 0 to 1, in the sense of the path.
    begin, finish : (b,)
        The fractions of the path at which each bit begins and ends, from 0 to 1.
    """

    paths: Paths
    cubic: FloatArray
    begin: FloatArray
    finish: FloatArray

    @cached_property
    def ends(self) -> tuple[FloatArray, FloatArray]:
        """The first and the last place of each path, (p, 3) each, m."""
        last = self.paths.start[1:] - 1
        return self.cubic[self.paths.start[:-1], 0], self.cubic[last].sum(axis=1)

    def at(self, path: IntArray, w: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give places and derivatives by the fraction, (k, 3) each, m."""
        return self._on(self._bit(path, w, self._begins), w)

    def at_part(self, path: IntArray, part: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the places that lie by given parts of the way along x.

        Parameters
        ----------
        path : (k,) int
            Paths along which x only grows, or only falls.
        part : (k,)
            From 0 to 1.

        Returns
        -------
        place, slope : (k, 3), m
            The places, and their derivatives by `part`.
        """
        first, last = (end[path, 0] for end in self.ends)
        span = last - first
        cubic = self.cubic[self._bit(path, part, self._reached)]
        u = _solve(cubic[:, :, 0], first + part * span)[:, None]
        place = ((cubic[:, 3] * u + cubic[:, 2]) * u + cubic[:, 1]) * u + cubic[:, 0]
        slope = (3.0 * cubic[:, 3] * u + 2.0 * cubic[:, 2]) * u + cubic[:, 1]
        return place, slope * (span / slope[:, 0])[:, None]

    @cached_property
    def _begins(self) -> FloatArray:
        return self._keys(real(self.begin))

    @cached_property
    def _reached(self) -> FloatArray:
        """Say what part of the way along x lies before each bit, as keys."""
        first, last = (real(end)[self._owner, 0] for end in self.ends)
        span = np.where(last == first, 1.0, last - first)
        return self._keys((real(self.cubic)[:, 0, 0] - first) / span)

    @cached_property
    def _owner(self) -> IntArray:
        return np.arange(self.paths.count).repeat(np.diff(self.paths.start))

    def _keys(self, begins: FloatArray) -> FloatArray:
        """Give fractions as keys: those of one path lie between its number and the next."""
        key: FloatArray = np.asarray(2.0 * self._owner + np.clip(begins, 0.0, 1.0), np.float64)
        return key

    def _bit(self, path: IntArray, w: FloatArray, key: FloatArray) -> IntArray:
        """Find the bit of each path on which a fraction lies."""
        start = self.paths.start
        found = np.searchsorted(key, 2.0 * path + real(w), side="right") - 1
        return np.clip(found, start[path], start[path + 1] - 1)

    def _on(self, bit: IntArray, w: FloatArray) -> tuple[FloatArray, FloatArray]:
        span = self.finish[bit] - self.begin[bit]
        u = ((w - self.begin[bit]) / span)[:, None]
        cubic = self.cubic[bit]
        place = ((cubic[:, 3] * u + cubic[:, 2]) * u + cubic[:, 1]) * u + cubic[:, 0]
        slope = (3.0 * cubic[:, 3] * u + 2.0 * cubic[:, 2]) * u + cubic[:, 1]
        return place, slope / span[:, None]


def shape_paths(paths: Paths, batch: SplineBatch) -> PathShapes:
    """Give paths their shapes on a batch of splines.

    Parameters
    ----------
    paths : Paths
        Over the segments of the batch.
    batch : SplineBatch
        The splines.
    """
    length = bit_lengths(paths, batch)
    owner = np.arange(paths.count).repeat(np.diff(paths.start))
    total = np.concatenate([np.zeros(1), np.cumsum(length)])
    base = total[paths.start[:-1]]
    whole = (total[paths.start[1:]] - base)[owner]
    base = base[owner]
    cubic = restrict_cubics(power_coefficients(batch)[paths.segment], paths.low, paths.high)
    # A path that is a point has one bit, from 0 to 1 like any other.
    point = real(whole) == 0.0
    whole = np.where(point, 1.0, whole)
    finish = np.where(point, 1.0, (total[1:] - base) / whole)
    return PathShapes(paths, cubic, (total[:-1] - base) / whole, finish)


def bit_lengths(paths: Paths, batch: SplineBatch) -> FloatArray:
    """Give the chord lengths of the bits, (b,), m."""
    first = segment_start(batch)
    part = paths.high - paths.low
    part = np.where(real(part) < 0.0, -part, part)
    length: FloatArray = (batch.knot[first + 1] - batch.knot[first])[paths.segment] * part
    return length


def restrict_cubics(cubic: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Give cubics (k, 4, 3) on the stretch between two parameters, as cubics from 0 to 1."""
    a = low[:, None]
    h = (high - low)[:, None]
    c0, c1, c2, c3 = (cubic[:, i] for i in range(4))
    return np.stack(
        [
            ((c3 * a + c2) * a + c1) * a + c0,
            ((3.0 * c3 * a + 2.0 * c2) * a + c1) * h,
            (3.0 * c3 * a + c2) * (h * h),
            c3 * (h * h * h),
        ],
        axis=1,
    )


def _solve(cubic: FloatArray, target: FloatArray) -> FloatArray:
    """Find where monotone cubics (k, 4) reach a value, in the arithmetic of both."""
    u = _solve_plain(real(cubic), real(target))
    if is_plain(cubic) and is_plain(target):
        return u
    missed = ((cubic[:, 3] * u + cubic[:, 2]) * u + cubic[:, 1]) * u + cubic[:, 0] - target
    rate = real((3.0 * cubic[:, 3] * u + 2.0 * cubic[:, 2]) * u + cubic[:, 1])
    # What is left of the residual is rounding: only its derivative is wanted.
    found: FloatArray = u - (missed - real(missed)) / np.where(rate == 0.0, 1.0, rate)
    return found


def _solve_plain(cubic: FloatArray, target: FloatArray) -> FloatArray:
    """Find where monotone cubics (k, 4) reach a value: Newton's rule, else within a bracket."""
    shifted = cubic[:, 0] - target
    first, second, third = cubic[:, 1], cubic[:, 2], cubic[:, 3]
    double, triple = 2.0 * second, 3.0 * third
    slope = first + second + third
    u = -shifted / np.where(slope == 0.0, 1.0, slope)
    with np.errstate(all="ignore"):
        for _ in range(QUICK):
            step = ((third * u + second) * u + first) * u
            step += shifted
            step /= (triple * u + double) * u + first
            u -= step
            # The rule squares an error: what is left after such a step is rounding.
            if np.abs(step).max(initial=0.0) <= SMALL:
                break
    good = (u >= -SMALL) & (u <= 1.0 + SMALL) & (np.abs(step) <= SMALL)
    if not good.all():
        lost = np.flatnonzero(~good)
        u[lost] = _bracketed(cubic[lost], shifted[lost])
    return np.clip(u, 0.0, 1.0)


def _bracketed(cubic: FloatArray, shifted: FloatArray) -> FloatArray:
    """Find the root in [0, 1] of monotone cubics with the given constants, step by safe step."""
    slope = cubic[:, 1] + cubic[:, 2] + cubic[:, 3]
    rising = slope >= 0.0
    low, high = np.zeros(len(shifted)), np.ones(len(shifted))
    u = np.clip(-shifted / np.where(slope == 0.0, 1.0, slope), 0.0, 1.0)
    for _ in range(_STEPS):
        value = ((cubic[:, 3] * u + cubic[:, 2]) * u + cubic[:, 1]) * u + shifted
        above = (value > 0.0) == rising
        high, low = np.where(above, u, high), np.where(above, low, u)
        rate = (3.0 * cubic[:, 3] * u + 2.0 * cubic[:, 2]) * u + cubic[:, 1]
        step = u - value / np.where(rate == 0.0, 1.0, rate)
        new = np.where((rate != 0.0) & (step >= low) & (step <= high), step, 0.5 * (low + high))
        moved = np.abs(new - u).max(initial=0.0)
        u = new
        if moved <= _DONE:
            break
    return u

"""Plane curves cut at corners and straight runs into pieces, each to become arcs.

A piece is a run of cubics without a corner, or one straight line. Its parameter is the number of
the cubic and the part of it: 7.25 lies a quarter along the eighth cubic of the batch. At a corner
the pieces on both sides keep their own directions. A run of cubics that leave its chord by no more
than `flat` is a straight line, and what goes on from it begins in the direction of the line.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.arc_pieces import Pieces
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.segments import power
>>> from assoc_hull.geometry.splines.loft import loft
>>> bent = CurveData.single(np.array([[0.0, 0, 0], [1, 0, 0], [2, 1, 0]]), kind=[0, 2, 0])
>>> cubic = power(loft(bent))[:, :, :2]
>>> pieces = Pieces.of(cubic, np.array([0, 2]), flat=1e-6)
>>> pieces.straight.tolist(), np.rad2deg(pieces.angle[:, 0]).round(9).tolist()
([True, True], [0.0, 45.0])
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.classical.checks import wrap
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate

__all__ = ["CORNER", "Pieces"]

_EXACT = 1e-9  # m
CORNER = 1e-10  # rad: a curve that turns by more at a point has a corner there


@attrs.frozen(eq=False)
class Pieces:
    """Pieces of plane curves, in the order of the curves.

    Attributes
    ----------
    cubic : (p, 4, 2), m
        Coefficients of 1, u, u^2, u^3, u from 0 to 1 along each cubic.
    curve : (k,) int
        The curve of each piece.
    first, stop : (k,) int
        Its first cubic, and the one behind its last.
    angle : (k, 2), rad
        Directions at its two ends.
    straight : (k,) bool
        Whether it is a straight line.
    """

    cubic: FloatArray
    curve: IntArray
    first: IntArray
    stop: IntArray
    angle: FloatArray
    straight: NDArray[np.bool_]
    tables: tuple[FloatArray, ...] = attrs.field(init=False, repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(self.cubic, self.curve, self.first, self.stop, self.angle, self.straight)
        one = differentiate(self.cubic)
        tables = tuple(_table(each) for each in (self.cubic, one, differentiate(one)))
        object.__setattr__(self, "tables", tables)

    def __len__(self) -> int:
        return len(self.curve)

    @classmethod
    def of(cls, cubic: FloatArray, start: IntArray, flat: float) -> Self:
        """Cut curves into pieces.

        Parameters
        ----------
        cubic : (p, 4, 2), m
            Cubics of all curves, in order.
        start : (m + 1,) int
            Where those of each curve begin.
        flat : float, m
            How far a straight run may be off its chord.
        """
        leave, arrive = _directions(cubic)
        turn = wrap(leave[1:] - arrive[:-1])
        cuts = np.zeros(len(cubic) + 1, bool)
        cuts[1:-1] = np.abs(turn) > CORNER
        cuts[start] = True
        straight = np.zeros(len(cubic), bool)
        for low, high in straight_runs(cubic, cuts, flat):
            cuts[[low, high]] = True
            straight[low:high] = True
        edge = np.flatnonzero(cuts)
        first, stop = edge[:-1], edge[1:]
        angle = np.stack([leave[first], arrive[stop - 1]], axis=1)
        line = straight[first]
        step = _ends(cubic)[stop - 1] - cubic[first, 0]
        angle[line] = np.arctan2(step[line, 1], step[line, 0])[:, None]
        _follow(angle, line, np.abs(turn)[first[1:] - 1] <= CORNER, np.isin(first[1:], start))
        curve = np.searchsorted(start, first, "right") - 1
        return cls(cubic, curve, first, stop, angle, line)

    def at(self, piece: IntArray, w: FloatArray) -> FloatArray:
        """Give places at parameters w, (...), of pieces, (...): (..., 2), m."""
        number, u = self._split(piece, w)
        return _value(self.tables[0], number, u)

    def slope(self, piece: IntArray, w: FloatArray) -> FloatArray:
        """Give the derivatives by w, (..., 2), m."""
        number, u = self._split(piece, w)
        return _value(self.tables[1], number, u)

    def direction(self, piece: IntArray, w: FloatArray) -> FloatArray:
        """Give directions (rad) at parameters w; at the ends of a piece those it keeps."""
        slope = self.slope(piece, w)
        found = np.arctan2(slope[..., 1], slope[..., 0])
        found = np.where(w == self.first[piece], self.angle[piece, 0], found)
        return np.where(w == self.stop[piece], self.angle[piece, 1], found)

    def tilt(self, piece: IntArray, w: FloatArray, angle: FloatArray) -> FloatArray:
        """Give how far directions (rad) are turned from those of the curve, to the left."""
        return wrap(angle - self.direction(piece, w))

    def curvature(self, piece: IntArray, w: FloatArray) -> FloatArray:
        """Give the curvature (1/m), positive to the left, at parameters w."""
        number, u = self._split(piece, w)
        first, second = (_value(table, number, u) for table in self.tables[1:])
        cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
        return np.asarray(cross / (first * first).sum(axis=-1) ** 1.5)

    def _split(self, piece: IntArray, w: FloatArray) -> tuple[IntArray, FloatArray]:
        number = np.minimum(np.asarray(w, np.float64).astype(np.int64), self.stop[piece] - 1)
        return number, w - number


def straight_runs(cubic: FloatArray, cuts: NDArray[np.bool_], flat: float) -> list[tuple[int, int]]:
    """Give (first, stop) of runs of cubics that lie on a straight line.

    One cubic by itself is a run if it is straight to rounding; near an inflection many are nearly
    so, and a line there would only part what is one arc.
    """
    control = _control(cubic)
    near = _off(control, control[:, 0], control[:, 3]) <= flat
    runs: list[tuple[int, int]] = []
    low = 0
    while low < len(cubic):
        high = low + 1
        if near[low]:
            while high < len(cubic) and near[high] and not cuts[high]:
                line = control[low : high + 1]
                if _off(line, line[0, 0], line[-1, 3]).max() > flat:
                    break
                high += 1
            alone = _off(control[low : low + 1], control[low, 0], control[low, 3]).max()
            # Two lines that meet without a corner would make one.
            parted = not runs or runs[-1][1] < low or cuts[low]
            if parted and (high - low > 1 or alone <= _EXACT):
                runs.append((low, high))
        low = high
    return runs


def _off(control: FloatArray, begin: FloatArray, end: FloatArray) -> FloatArray:
    """Give how far the farthest control point of each cubic is off a chord, m."""
    step = end - begin
    away = control - (begin if begin.ndim == 1 else begin[:, None])
    ahead = step if step.ndim == 1 else step[:, None]
    cross = away[..., 0] * ahead[..., 1] - away[..., 1] * ahead[..., 0]
    found: FloatArray = np.abs(cross).max(axis=-1) / np.hypot(step[..., 0], step[..., 1])
    return found


def _control(cubic: FloatArray) -> FloatArray:
    """Give the Bezier points, (p, 4, 2), m."""
    c0, c1, c2, c3 = (cubic[:, i] for i in range(4))
    first = c0 + c1 / 3.0
    return np.stack([c0, first, 2.0 * first - c0 + c2 / 3.0, c0 + c1 + c2 + c3], axis=1)


def _ends(cubic: FloatArray) -> FloatArray:
    found: FloatArray = cubic.sum(axis=1)
    return found


def _directions(cubic: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the directions (rad) at the beginning and end of each cubic."""
    leave = cubic[:, 1]
    arrive = cubic[:, 1] + 2.0 * cubic[:, 2] + 3.0 * cubic[:, 3]
    return np.arctan2(leave[:, 1], leave[:, 0]), np.arctan2(arrive[:, 1], arrive[:, 0])


def _follow(
    angle: FloatArray, line: NDArray[np.bool_], smooth: NDArray[np.bool_], new: NDArray[np.bool_]
) -> None:
    """Let what is smooth beside a straight line begin and end in its direction."""
    joined = smooth & ~new
    after = np.flatnonzero(joined & line[:-1] & ~line[1:])
    angle[after + 1, 0] = angle[after, 1]
    before = np.flatnonzero(joined & ~line[:-1] & line[1:])
    angle[before, 1] = angle[before + 1, 0]


def _value(table: FloatArray, number: IntArray, u: FloatArray) -> FloatArray:
    """Give the values of polynomials, (k, 2, p), at parts u of some: (..., 2), parts contiguous."""
    found = np.empty((2, *number.shape))
    term = np.empty(number.shape)
    for axis in (0, 1):
        sums = found[axis, ...]
        np.take(table[-1, axis], number, out=sums, mode="clip")
        for power in range(len(table) - 2, -1, -1):
            sums *= u
            np.take(table[power, axis], number, out=term, mode="clip")
            sums += term
    return np.moveaxis(found, 0, -1)


def _table(cubic: FloatArray) -> FloatArray:
    """Lay coefficients (p, k, 2) out so that those of one power lie side by side, (k, 2, p)."""
    return np.ascontiguousarray(np.moveaxis(cubic, 0, -1))

"""How well the spline through marked points of a shape keeps to the shape.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.model.forms.composite import Composite
>>> from assoc_hull.model.forms.pieces import ArcPieces, SectionShape
>>> bilge = ArcPieces(np.array([[0.0, 12.0]]), np.array([2.0]))
>>> shape = SectionShape(np.array([90.0]), (bilge,))
>>> whole = Composite.of(shape, "arc", [(0, 0.0), (0, 2.0), (0, 4.0)], None)
>>> whole.deviations().round(3).tolist()
[0.059, 0.059]
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.spline import loft
from assoc_hull.model.forms.definition import Mark
from assoc_hull.model.forms.layout import ends_for, joints_of
from assoc_hull.model.forms.pieces import Shape

__all__ = ["Composite", "given_at"]

_FRACTIONS = np.arange(1, 8) / 8.0
"""Where, in parts of an interval, its distance is measured."""

_STEPS = 4
"""Steps of Newton's rule to the nearest place on the shape."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
"""Exact for y dz of two cubics; on an arc beyond all need."""


def given_at(layout: str, marks: Sequence[Mark]) -> tuple[list[int], FloatArray]:
    """Give kinds, and directions (k, 3), of points at marks.

    Parameters
    ----------
    layout : str
        Of the line.
    marks : sequence of Mark
        A joint is named by the piece that begins there.

    Returns
    -------
    list of int, (k, 3)
    """
    joints = joints_of(layout)
    kinds, directions = [0] * len(marks), np.zeros((len(marks), 3))
    for number, (piece, t) in enumerate(marks):
        if piece and t == 0.0:
            kinds[number] = int(joints[piece - 1][0])
            directions[number] = joints[piece - 1][1]
    return kinds, directions


@attrs.frozen(eq=False)
class Composite:
    """A shape and the spline through its points at marks.

    Attributes
    ----------
    shape : Shape
        Of one curve.
    spline : SplineBatch
        One.
    piece : (k,) int
        Of each interval of the spline.
    low, high : (k,)
        Between which t of the piece.
    """

    shape: Shape
    spline: SplineBatch
    piece: IntArray
    low: FloatArray
    high: FloatArray

    @classmethod
    def of(cls, shape: Shape, layout: str, marks: Sequence[Mark], ends: FloatArray | None) -> Self:
        """Loft through all marks, the first and the last among them; these lie where ends say."""
        piece = np.array([mark[0] for mark in marks], np.int64)
        t = np.array([mark[1] for mark in marks])
        xyz = shape.at(np.zeros(len(t), np.int64), piece, t)
        if ends is not None:
            xyz[[0, -1]] = ends
        kinds, directions = given_at(layout, marks)
        finish = ends_for(layout)
        data = CurveData.single(
            xyz, kinds, directions, (finish.kind[0], finish.kind[1]), np.array(finish.vector)
        )
        high = np.where(piece[1:] == piece[:-1], t[1:], 4.0)
        return cls(shape, loft(data), piece[:-1], t[:-1], high)

    def deviations(self) -> FloatArray:
        """Give the largest distance of each interval from its piece, (k,) m."""
        count = len(self.piece)
        points = self._spline_at(_FRACTIONS)[0].reshape(-1, 3)
        piece = np.repeat(self.piece, len(_FRACTIONS))
        low, high = (np.repeat(each, len(_FRACTIONS)) for each in (self.low, self.high))
        t = low + (high - low) * np.tile(_FRACTIONS, count)
        rows = np.zeros(len(t), np.int64)
        for _ in range(_STEPS):
            along = self.shape.tangent(rows, piece, t)
            off = points - self.shape.at(rows, piece, t)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = (off * along).sum(axis=1) / (along * along).sum(axis=1)
            t = np.clip(t + np.nan_to_num(step), low, high)
        off = points - self.shape.at(rows, piece, t)
        found = np.sqrt((off * off).sum(axis=1)).reshape(count, -1)
        return np.asarray(found.max(axis=1))

    def areas(self, last: int) -> tuple[FloatArray, FloatArray]:
        """Give int y dz over each interval, (k,) m2: of the pieces, and of the spline.

        Parameters
        ----------
        last : int
            The first piece that does not count.
        """
        counts = self.piece < last
        share = 0.5 * (1.0 + _NODES)
        points, rates = self._spline_at(share)
        weights = 0.5 * _WEIGHTS
        spline = (points[..., 1] * rates[..., 2] * weights).sum(axis=1)
        width = self.high - self.low
        t = (self.low[:, None] + width[:, None] * share).ravel()
        rows, piece = np.zeros(len(t), np.int64), np.repeat(self.piece, len(share))
        y = self.shape.at(rows, piece, t)[:, 1].reshape(-1, len(share))
        dz = self.shape.tangent(rows, piece, t)[:, 2].reshape(-1, len(share))
        exact = (y * dz * weights).sum(axis=1) * width
        return np.where(counts, exact, 0.0), np.where(counts, spline, 0.0)

    def _spline_at(self, share: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give points and derivatives by the share of each interval, (k, len(share), 3)."""
        one = self.spline
        width = np.diff(one.knot)[:, None]
        start, finish = one.xyz[:-1], one.xyz[1:]
        leave, arrive = width * one.leave[:-1], width * one.arrive[1:]
        c2 = 3.0 * (finish - start) - 2.0 * leave - arrive
        c3 = 2.0 * (start - finish) + leave + arrive
        a, b, c, d = (each[:, None] for each in (start, leave, c2, c3))
        u = share[None, :, None]
        return a + u * (b + u * (c + u * d)), b + u * (2.0 * c + 3.0 * u * d)

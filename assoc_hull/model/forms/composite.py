"""How well splines through marked points of shapes keep to the shapes.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.model.forms.composite import Composite
>>> from assoc_hull.model.forms.section_pieces import ArcPieces, SectionShape
>>> bilge = ArcPieces(np.array([[0.0, 12.0]]), np.array([2.0]))
>>> shape = SectionShape(np.array([90.0]), (bilge,))
>>> whole = Composite.of(shape, "arc", [[(0, 0.0), (0, 2.0), (0, 4.0)]], None)
>>> whole.deviations().round(3).tolist()
[0.059, 0.059]
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.definition_part import Mark
from assoc_hull.model.forms.layout import ends_for, joints_of
from assoc_hull.model.forms.section_pieces import Shape

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
    """Shapes of one layout, and the splines through their points at marks.

    Attributes
    ----------
    shape : Shape
        Of n curves.
    spline : SplineBatch
        One of each.
    row, piece : (k,) int
        Of each interval of the splines.
    low, high : (k,)
        Between which t of the piece.
    """

    shape: Shape
    spline: SplineBatch
    row: IntArray
    piece: IntArray
    low: FloatArray
    high: FloatArray

    @classmethod
    def of(
        cls, shape: Shape, layout: str, marks: Sequence[Sequence[Mark]], ends: FloatArray | None
    ) -> Self:
        """Loft curves through all marks, the first and the last among them.

        Parameters
        ----------
        shape : Shape
            Of n curves.
        layout : str
            Of all of them.
        marks : sequence of n sequences of Mark
            Of each.
        ends : (n, 2, 3), m, or None
            Where the ends lie; on the shape if None.
        """
        start = np.concatenate([[0], np.cumsum([len(each) for each in marks])]).astype(np.int64)
        row = np.repeat(np.arange(len(marks)), np.diff(start))
        flat = [mark for each in marks for mark in each]
        piece, t = np.array([mark[0] for mark in flat]), np.array([mark[1] for mark in flat])
        xyz = shape.at(row, piece, t)
        if ends is not None:
            xyz[start[:-1]], xyz[start[1:] - 1] = ends[:, 0], ends[:, 1]
        kinds, directions = given_at(layout, flat)
        finish = ends_for(layout)
        data = CurveData(
            start, xyz, np.array(kinds, np.int8), directions,
            np.tile(np.array(finish.kind, np.int8), (len(marks), 1)),
            np.tile(np.array(finish.vector), (len(marks), 1, 1)),
        )  # fmt: skip
        inner = row[1:] == row[:-1]
        high = np.where(piece[1:] == piece[:-1], t[1:], 4.0)
        return cls(
            shape, loft(data), row[:-1][inner], piece[:-1][inner], t[:-1][inner], high[inner]
        )

    def deviations(self) -> FloatArray:
        """Give the largest distance of each interval from its piece, (k,) m."""
        count = len(self.piece)
        points = self._spline_at(_FRACTIONS)[0].reshape(-1, 3)
        size = len(_FRACTIONS)
        row, piece = np.repeat(self.row, size), np.repeat(self.piece, size)
        low, high = np.repeat(self.low, size), np.repeat(self.high, size)
        t = low + (high - low) * np.tile(_FRACTIONS, count)
        for _ in range(_STEPS):
            along = self.shape.tangent(row, piece, t)
            off = points - self.shape.at(row, piece, t)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = (off * along).sum(axis=1) / (along * along).sum(axis=1)
            t = np.clip(t + np.nan_to_num(step), low, high)
        off = points - self.shape.at(row, piece, t)
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
        row, piece = np.repeat(self.row, len(share)), np.repeat(self.piece, len(share))
        y = self.shape.at(row, piece, t)[:, 1].reshape(-1, len(share))
        dz = self.shape.tangent(row, piece, t)[:, 2].reshape(-1, len(share))
        exact = (y * dz * weights).sum(axis=1) * width
        return np.where(counts, exact, 0.0), np.where(counts, spline, 0.0)

    def _spline_at(self, share: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give points and derivatives by the share of each interval, (k, len(share), 3)."""
        one = self.spline
        begin = np.delete(np.arange(len(one.knot)), one.start[1:] - 1)
        width = (one.knot[begin + 1] - one.knot[begin])[:, None]
        start, finish = one.xyz[begin], one.xyz[begin + 1]
        leave, arrive = width * one.leave[begin], width * one.arrive[begin + 1]
        c2 = 3.0 * (finish - start) - 2.0 * leave - arrive
        c3 = 2.0 * (start - finish) + leave + arrive
        a, b, c, d = (each[:, None] for each in (start, leave, c2, c3))
        u = share[None, :, None]
        return a + u * (b + u * (c + u * d)), b + u * (2.0 * c + 3.0 * u * d)

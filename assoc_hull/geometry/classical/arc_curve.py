"""A plane curve of straight lines and circular arcs: evaluated, met, measured.

Examples
--------
>>> from assoc_hull.geometry.classical.arc_section import through_points
>>> curve = through_points([(0, 0), (3, 0), (5, 4)], kind="line")
>>> round(curve.length, 9), curve.where(1, 2.0).tolist()
(7.472135955, [[4.0, 2.0]])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arcs import Arcs
from assoc_hull.geometry.classical.checks import figure, finite, wrap
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["ArcCurve"]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
"""Integrals over arcs that turn by up to half a circle are exact to rounding with so many."""

_MOST = 1_000_000
"""So many points of a curve are enough."""

_TOLERANCE = 1e-9
"""Of places, as a part of the diagonal of the bounding box."""


@attrs.frozen(eq=False)
class ArcCurve:
    """A chain of lines and arcs, end to end.

    Attributes
    ----------
    arcs : Arcs
        Its pieces, in order.
    points : (n, 2), m
        The given points: the ends of the pieces, or the corners of the polygon.
    name : str
        Of the curve, for messages.
    knuckles : frozenset of int
        Joints that are meant as corners, whatever the angle: 1 between the first two pieces.
    """

    arcs: Arcs
    points: FloatArray
    name: str = "section"
    knuckles: frozenset[int] = frozenset()

    def __attrs_post_init__(self) -> None:
        freeze(self.points)

    @property
    def length(self) -> float:
        """Of all pieces, m."""
        return float(self.arcs.length.sum())

    @property
    def tolerance(self) -> float:
        """Places nearer than this (m) are one: 1e-9 of the diagonal of the given points."""
        return _TOLERANCE * float(np.hypot(*np.ptp(self.points, axis=0)))

    @property
    def starts(self) -> FloatArray:
        """Arc lengths (m) at which the pieces begin, and the end, (pieces + 1,)."""
        return np.concatenate([[0.0], np.cumsum(self.arcs.length)])

    def joints(self) -> FloatArray:
        """Give the ends of the pieces, (pieces + 1, 2), m."""
        return np.vstack([self.arcs.start, self.arcs.ends()[-1:]])

    def turns(self) -> FloatArray:
        """Give by how much (rad) the tangent jumps at the joints between pieces, left positive."""
        return wrap(self.arcs.angle[1:] - self.arcs.end_angles()[:-1])

    def at(self, s: ArrayLike) -> FloatArray:
        """Give points (..., 2), m, at arc lengths `s` (m) from the start, of any shape.

        Raises
        ------
        GeometryError
            An arc length outside the curve.
        """
        asked = finite(s, self.name, None)
        starts = self.starts
        if ((asked < -self.tolerance) | (asked > starts[-1] + self.tolerance)).any():
            far = float(asked.flat[np.argmax(np.abs(asked - 0.5 * starts[-1]))])
            raise GeometryError(
                f"{self.name}: s={figure(far)} outside [0, {figure(starts[-1])}]",
                "ask between these", {"s": far},
            )  # fmt: skip
        piece = np.clip(np.searchsorted(starts, asked, "right") - 1, 0, len(self.arcs) - 1)
        return self.arcs.at(piece, asked - starts[piece])

    def sampled(self, most: float) -> FloatArray:
        """Give points (k, 2), m, on the curve, its joints among them, none farther than `most`.

        Raises
        ------
        GeometryError
            A step that is not above 0, or that makes more than a million points.
        """
        step = float(finite(most, self.name, ()))
        if not step > 0.0:
            raise GeometryError(f"{self.name}: step {figure(step)}", "give one above 0")
        if self.length / step > _MOST:
            what = f"{self.name}: step {figure(step)} for a length of {figure(self.length)}"
            raise GeometryError(what, f"give one of at least {figure(self.length / _MOST)}")
        count = np.maximum(np.ceil(self.arcs.length / step), 1).astype(np.int64)
        piece = np.repeat(np.arange(len(count)), count)
        within = np.arange(len(piece)) - np.repeat(np.cumsum(count) - count, count)
        inner = self.arcs.at(piece, within * (self.arcs.length / count)[piece])
        return np.vstack([inner, self.arcs.ends()[-1:]])

    def meet(self, axis: int, value: float) -> tuple[IntArray, FloatArray]:
        """Find where one coordinate has a value: all places, in order along the curve.

        Parameters
        ----------
        axis : int
            0 or 1: which coordinate.
        value : float, m
            Its value.

        Returns
        -------
        piece, t
            Numbers of pieces, and arc lengths (m) from their starts. A piece that lies in
            that line gives both its ends; a joint comes once.

        Raises
        ------
        GeometryError
            Another axis, or a value that is no finite number.
        """
        if shown(axis) not in ("0", "1"):
            what = f"{self.name}: axis is {shown(axis)}"
            raise GeometryError(what, "use 0 or 1", {"axis": axis})
        arcs, slack, value = self.arcs, self.tolerance, float(finite(value, self.name, ()))
        every = np.arange(len(arcs))
        # t = 2 atan(k p) / k, and k (cos a - k d / 2) p^2 + sin a p - d / 2 = 0: no digits are
        # lost as k goes to nil.
        turned = arcs.angle if axis == 1 else arcs.angle + 0.5 * np.pi
        away = value - arcs.start[:, axis]
        square = arcs.curvature * (np.cos(turned) - 0.5 * arcs.curvature * away)
        linear = np.sin(turned)
        roots = _roots(square, linear, -0.5 * away)
        bend = np.where(arcs.curvature == 0.0, 1.0, arcs.curvature)[:, None]
        t = np.where(
            arcs.curvature[:, None] == 0.0, 2.0 * roots, 2.0 * np.arctan(bend * roots) / bend
        )
        ends = np.column_stack([np.zeros(len(every)), arcs.length])
        at_ends = np.stack([arcs.start[:, axis], arcs.ends()[:, axis]], axis=1)
        ends = np.where(np.abs(at_ends - value) <= slack, ends, np.nan)
        t = np.concatenate([t, ends], axis=1)
        found = np.isfinite(t) & (t >= -slack) & (t <= arcs.length[:, None] + slack)
        piece, column = np.nonzero(found)
        along = np.clip(t[piece, column], 0.0, arcs.length[piece])
        return self._once(piece, along)

    def where(self, axis: int, value: float) -> FloatArray:
        """Give all points (k, 2), m, at which a coordinate has a value, sorted by the other.

        Parameters
        ----------
        axis : int
            0 or 1: which coordinate.
        value : float, m
            Its value.

        Raises
        ------
        GeometryError
            Another axis, or a value that is no finite number.
        """
        points = self.arcs.at(*self.meet(axis, value))
        points[:, axis] = value
        points = points[np.argsort(points[:, 1 - axis], kind="stable")]
        apart = np.ones(len(points), bool)
        apart[1:] = np.diff(points[:, 1 - axis]) > self.tolerance
        return points[apart]

    def cut(self, piece: int, t: float) -> ArcCurve:
        """Give what lies before a place: piece number, arc length (m) from its start.

        Raises
        ------
        GeometryError
            A place that is not on the curve, or its very start.
        """
        arcs, t = self.arcs, float(finite(t, self.name, ()))
        if (
            shown(piece) not in map(str, range(len(arcs)))
            or t > arcs.length[piece] + self.tolerance
        ):
            what = f"{self.name}: no place {figure(t)} m along piece {shown(piece)}"
            raise GeometryError(what, f"there are {len(arcs)} pieces, from 0")
        if piece == 0 and t <= self.tolerance:
            raise GeometryError(f"{self.name}: nothing lies before its start", "cut it farther on")
        count = piece + 1 if t > self.tolerance or piece == 0 else piece
        length = arcs.length[:count].copy()
        if count == piece + 1:
            length[-1] = t
        part = Arcs(arcs.start[:count].copy(), arcs.angle[:count].copy(),
                    arcs.curvature[:count].copy(), length)  # fmt: skip
        return attrs.evolve(self, arcs=part, points=self.points.copy())

    def moments_below(self, level: float) -> tuple[float, float, float]:
        """Integrate between the second axis and the curve, below a level of the second coordinate.

        Parameters
        ----------
        level : float, m
            Infinite for all of the curve.

        Returns
        -------
        area, first, second : m2, m3, m3
            Integrals of u dv, u^2/2 dv and u v dv, for the curve (u, v): positive where the
            curve runs upward with u above 0. Exact: with arcs, not with polygons.

        Raises
        ------
        GeometryError
            A level that is no number.
        """
        arcs = self.arcs
        piece, low, high = np.arange(len(arcs)), np.zeros(len(arcs)), arcs.length
        if shown(level) not in ("inf", "np.float64(inf)"):
            level = float(finite(level, self.name, ()))
            piece, low, high = self._parts(level)
        middle = arcs.at(piece, 0.5 * (low + high))
        under = middle[:, 1] < level
        piece, low, high = piece[under], low[under], high[under]
        half = 0.5 * (high - low)
        t = low[:, None] + half[:, None] * (1.0 + _NODES)
        every = np.repeat(piece, len(_NODES))
        u, v = arcs.at(every, t.ravel()).T.reshape(2, *t.shape)
        rise = np.sin(arcs.direction(every, t.ravel())).reshape(t.shape)
        weight = half[:, None] * _WEIGHTS * rise
        return (
            float((u * weight).sum()),
            float((0.5 * u * u * weight).sum()),
            float((u * v * weight).sum()),
        )

    def _parts(self, level: float) -> tuple[IntArray, FloatArray, FloatArray]:
        """Cut pieces where they meet a level: number of the piece, from, to."""
        piece, along = self.meet(1, level)
        every = np.arange(len(self.arcs))
        number = np.concatenate([every, every, piece])
        place = np.concatenate([np.zeros(len(every)), self.arcs.length, along])
        order = np.lexsort([place, number])
        number, place = number[order], place[order]
        same = (number[1:] == number[:-1]) & (place[1:] > place[:-1])
        return number[:-1][same], place[:-1][same], place[1:][same]

    def _once(self, piece: IntArray, t: FloatArray) -> tuple[IntArray, FloatArray]:
        """Sort places along the curve and drop those that are the place before."""
        s = self.starts[piece] + t
        order = np.argsort(s, kind="stable")
        s, piece, t = s[order], piece[order], t[order]
        new = np.ones(len(s), bool)
        new[1:] = np.diff(s) > 4.0 * self.tolerance
        return piece[new], t[new]


def _roots(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Solve a p^2 + b p + c = 0, (n, 2); nan where there is no root, inf for one far away."""
    disc = b * b - 4.0 * a * c
    # A line that touches an arc from outside by rounding touches it.
    disc = np.where((disc < 0.0) & (disc > -1e-14), 0.0, disc)
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(disc)
        sum_ = -0.5 * (b + np.where(b < 0.0, -root, root))
        return np.stack([c / sum_, sum_ / a], axis=1)

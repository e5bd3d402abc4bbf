"""A curve in space through given points: straight between them, or a natural spline.

Examples
--------
>>> from assoc_hull.geometry.classical.space_curve import SpaceCurve
>>> points = [(0, 0, 0), (3, 1, 0.5), (6, 3, 2), (8, 6, 5)]
>>> SpaceCurve.make(points).where(0, 5.0).round(9).tolist()
[[5.0, 2.333333333, 1.5]]
>>> SpaceCurve.make(points, kind="spline").where(0, 5.0).round(9).tolist()
[[5.0, 2.149786509, 1.296796321]]
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline, PPoly

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import finite, inside
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["SpaceCurve"]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)


@attrs.frozen(eq=False)
class SpaceCurve:
    """A polyline (C0), or a natural cubic spline per coordinate over the chord length (C2).

    The space curve of the PRELIKON system in Kim & Chang, "Some Representations of Ship Hulls
    by Mathematical Method for Design and Production", J. SNAK.

    Attributes
    ----------
    points : (n, 3), m
        Given points.
    kind : {"polyline", "spline"}
        How it runs between them.
    t : (n,), m
        Chord length at each, from 0.
    pieces : scipy.interpolate.PPoly
        All three coordinates over `t`.
    name : str
        For messages and tables.
    """

    points: FloatArray
    kind: str
    t: FloatArray
    pieces: PPoly
    name: str = "space curve"

    def __attrs_post_init__(self) -> None:
        freeze(self.points, self.t)

    @classmethod
    def make(cls, points: ArrayLike, *, kind: str = "polyline", name: str = "space curve") -> Self:
        """Check what is handed in; arguments as the attributes.

        Raises
        ------
        GeometryError
            ``"space curve: repeated point {i}"``; fewer than two points, another kind.
        """
        given = finite(points, "space curve", (None, 3))
        if len(given) < 2:
            what = f"space curve: expected shape (n >= 2, 3), got {given.shape}"
            raise GeometryError(what, "give two points or more", {"got": given.shape})
        if shown(kind) not in ("'polyline'", "'spline'"):
            what = f"space curve: kind is {shown(kind)}"
            raise GeometryError(what, 'use "polyline" or "spline"')
        chord = np.linalg.norm(np.diff(given, axis=0), axis=1)
        same = np.flatnonzero(chord == 0.0)
        if len(same):
            index = int(same[0]) + 1
            what = f"space curve: repeated point {index}"
            raise GeometryError(what, "leave it out", {"index": index})
        t = np.concatenate([[0.0], np.cumsum(chord)])
        return cls(given, kind, t, _pieces(given, t, kind), str(name))

    @property
    def length(self) -> float:
        """Along the curve, m; of a spline by 20 Gauss points an interval."""
        if self.kind == "polyline":
            return float(self.t[-1])
        half = 0.5 * np.diff(self.t)
        at = self.t[:-1, None] + half[:, None] * (1.0 + _NODES)
        speed = np.linalg.norm(self.pieces(at, 1), axis=-1)
        return float((speed @ _WEIGHTS * half).sum())

    def at(self, t: ArrayLike) -> FloatArray:
        """Give points (..., 3), m, at chord lengths (m).

        Raises
        ------
        GeometryError
            ``"space curve: x={x} outside [{a}, {b}]"``, where x is the chord length.
        """
        asked = inside(t, "space curve", 0.0, float(self.t[-1]), slack=1e-9 * float(self.t[-1]))
        return np.asarray(self.pieces(asked))

    def where(self, axis: int, value: float) -> FloatArray:
        """Give all points (k, 3), m, at which a coordinate has a value, in order along the curve.

        Parameters
        ----------
        axis : int
            0, 1 or 2: which coordinate.
        value : float, m
            Its value. An interval that lies in the plane gives both its ends.

        Raises
        ------
        GeometryError
            Another axis, or a value that is no finite number.
        """
        asked = float(finite(value, "space curve", ()))
        if shown(axis) not in ("0", "1", "2"):
            what = f"space curve: axis is {shown(axis)}"
            raise GeometryError(what, "use 0, 1 or 2", {"axis": axis})
        slack = 1e-9 * float(np.linalg.norm(np.ptp(self.points, axis=0)))
        one = PPoly(self.pieces.c[:, :, axis], self.pieces.x, extrapolate=False)
        roots = np.asarray(one.solve(asked, discontinuity=False, extrapolate=False))
        given = self.t[np.abs(self.points[:, axis] - asked) <= slack]
        t = np.sort(np.concatenate([roots[np.isfinite(roots)], given]))
        new = np.ones(len(t), bool)
        new[1:] = np.diff(t) > 4.0 * slack
        points = self.at(t[new])
        points[:, axis] = asked
        return points

    def moved(self, by: float) -> Self:
        """Give the same curve with `by` (m) added to every x."""
        step = float(finite(by, "space curve", ()))
        return type(self).make(
            self.points + np.array([step, 0.0, 0.0]), kind=self.kind, name=self.name
        )


def _pieces(points: FloatArray, t: FloatArray, kind: str) -> PPoly:
    if kind == "spline":
        return CubicSpline(t, points, bc_type="natural")
    slope = np.diff(points, axis=0) / np.diff(t)[:, None]
    return PPoly(np.stack([slope, points[:-1]]), t)

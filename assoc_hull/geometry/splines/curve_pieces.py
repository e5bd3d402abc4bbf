"""Curves in pieces, seen by direction, curvature and its slope.

`PiecewiseCurves` is what the criteria of fairness ask of any curve, whatever it is made of, at
places u from 0 to 1 on each piece. `SplinePieces` are the composite splines of the kernel,
`GraphPieces` a graph y(x) of scipy; chains of arcs, chord splines and elastica are given so by
`assoc_hull.fairing.line_fairness`. `searched_distance` gives distances where no
formula does.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.vectors import check_normals, dot
from assoc_hull.geometry.splines.distance import closest_points_each
from assoc_hull.geometry.splines.segments import power_coefficients, segment_curve, space_curvature

if TYPE_CHECKING:
    # Only named here: every hull loads this module, and half a second of scipy would come with it.
    from scipy.interpolate import PPoly

__all__ = [
    "GraphPieces",
    "PieceDerivatives",
    "PiecewiseCurves",
    "SplinePieces",
    "searched_distance",
]


@attrs.frozen(eq=False)
class PieceDerivatives:
    """How pieces of curves run at places on them.

    Attributes
    ----------
    tangent : (p, k, d)
        Unit vectors along the curve, in the plane (d = 2) or in space.
    curvature : (p, k), 1/m
        Signed in a plane, else the amount.
    rate : (p, k), 1/m2
        Its derivative by arc length.
    speed : (p, k), m
        Arc length by the parameter u of the piece.
    bend : (p, k, d), 1/m
        The vector of curvature.
    third : (p, k)
        What jumps where a support pushes: y''' of a graph, else `rate`; 1/m2.
    """

    tangent: FloatArray
    curvature: FloatArray
    rate: FloatArray
    speed: FloatArray
    bend: FloatArray
    third: FloatArray


class PiecewiseCurves(Protocol):
    """Curves in pieces; at the joints they may be anything, within they are smooth."""

    @property
    def owner(self) -> IntArray:
        """The curve (from 0) that each piece belongs to, (p,), ascending."""
        ...

    @property
    def signed(self) -> np.typing.NDArray[np.bool_]:
        """Whether the curvature of each curve has a sign, (m,)."""
        ...

    @property
    def of_arcs(self) -> bool:
        """Whether curvature is constant along each piece, so that only its steps count."""
        ...

    def seen(self, u: FloatArray) -> PieceDerivatives:
        """Look at all pieces at parameters u (k,) of each."""
        ...

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of points (k, d) from one curve each, (k,)."""
        ...


@attrs.frozen(eq=False, slots=False)
class SplinePieces:
    """Composite splines.

    Attributes
    ----------
    batch : SplineBatch
        The curves.
    normals : (m, 3)
        Unit normal of the plane that each is seen in; a row of nan for a curve in space, whose
        curvature has no sign.
    """

    batch: SplineBatch
    normals: FloatArray

    @classmethod
    def of(cls, batch: SplineBatch, normals: ArrayLike) -> SplinePieces:
        """Check normals, (3,) or (m, 3), and take curves.

        Raises
        ------
        BadInputError
            A normal is not of unit length.
        """
        return cls(batch, check_normals(normals, batch.count))

    @property
    def owner(self) -> IntArray:
        """The curve that each segment belongs to, (p,)."""
        return segment_curve(self.batch)

    @property
    def signed(self) -> np.typing.NDArray[np.bool_]:
        """Whether each curve is seen in a plane, (m,)."""
        return np.asarray(~np.isnan(self.normals[:, 0]))

    @property
    def of_arcs(self) -> bool:
        """Curvature changes along a cubic."""
        return False

    def seen(self, u: FloatArray) -> PieceDerivatives:
        """Look at all segments at parameters u (k,)."""
        normal = self.normals[self.owner][:, None]
        flat = ~np.isnan(normal[..., 0])
        axis = np.nan_to_num(normal)
        slopes = differentiate(power_coefficients(self.batch))
        bends = differentiate(slopes)
        at = np.broadcast_to(u, (len(slopes), len(u)))
        first, second, third = (
            each - dot(each, axis)[..., None] * axis
            for each in (horner(table, at) for table in (slopes, bends, differentiate(bends)))
        )
        square = dot(first, first)
        cross, next_cross = np.cross(first, second), np.cross(first, third)
        size = np.sqrt(dot(cross, cross))
        with np.errstate(invalid="ignore", divide="ignore"):
            growth = np.where(
                size > 0.0, dot(cross, next_cross) / size, np.sqrt(dot(next_cross, next_cross))
            )
            turn = np.where(flat, dot(axis, cross), size)
            growth = np.where(flat, dot(axis, next_cross), growth)
            rate = (growth * square - 3.0 * turn * dot(first, second)) / square**3
            speed = np.sqrt(square)
            tangent, curvature = first / speed[..., None], turn / speed**3
        bend = np.nan_to_num(space_curvature(first, second))
        # Where a curve stands still (a cusp) it has no direction: zero there, not nan.
        clean = [np.nan_to_num(each) for each in (tangent, curvature, rate)]
        return PieceDerivatives(clean[0], clean[1], clean[2], speed, bend, clean[2])

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of points (k, 2) or (k, 3) from one curve each, (k,)."""
        flat = np.zeros((len(points), 3 - points.shape[1]))
        return closest_points_each(self.batch, curve, np.hstack([points, flat]))[2]


# --------------------------------------------------------------------------------------
# Graphs y(x), and distances found by search.


@attrs.frozen(eq=False, slots=False)
class GraphPieces:
    """The graph of a piecewise polynomial y(x), with the derivatives that it has."""

    curve: PPoly

    @classmethod
    def of(cls, curve: PPoly) -> GraphPieces:
        """Take a piecewise polynomial of one variable and value.

        Raises
        ------
        GeometryError
            It has more than one value.
        """
        if curve.c.ndim != 2:
            raise GeometryError("fairness: a graph has one value of y at each x", "give one curve")
        return cls(curve)

    @property
    def owner(self) -> IntArray:
        """All pieces belong to one curve."""
        return np.zeros(self.curve.c.shape[1], np.int64)

    @property
    def signed(self) -> np.typing.NDArray[np.bool_]:
        """The curvature of a graph has a sign."""
        return np.ones(1, np.bool_)

    @property
    def of_arcs(self) -> bool:
        """Curvature changes along a polynomial."""
        return False

    def seen(self, u: FloatArray) -> PieceDerivatives:
        """Look at all pieces at parameters u (k,)."""
        width = np.diff(self.curve.x)[:, None]
        table = self.curve.c[::-1].T  # ascending powers of x - x_i
        rows = []
        for _ in range(3):
            table = differentiate(table) if table.shape[1] > 1 else 0.0 * table
            rows.append(horner(table, u * width))
        slope, second, third = rows
        stretch = 1.0 + slope * slope
        tangent = np.stack([np.ones_like(slope), slope], axis=-1) / np.sqrt(stretch)[..., None]
        curvature = second / stretch**1.5
        left = np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)
        rate = (third * stretch - 3.0 * slope * second**2) / stretch**3
        speed = np.sqrt(stretch) * width
        return PieceDerivatives(tangent, curvature, rate, speed, curvature[..., None] * left, third)

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of points (k, 2) from the graph, (k,)."""
        x = self.curve.x

        def place(t: FloatArray) -> FloatArray:
            return np.stack([t, self.curve(t)], axis=-1)

        return searched_distance(place, x, points)


def searched_distance(
    place: Callable[[FloatArray], FloatArray],
    edges: FloatArray,
    points: FloatArray,
    per_piece: int = 32,
) -> FloatArray:
    """Give the distance of points (k, 2) from a curve place(t) by search, (k,), m.

    The nearest of samples is taken, and improved by golden sections of the interval around it.
    """
    part = np.linspace(0.0, 1.0, per_piece, endpoint=False)
    t = np.append((edges[:-1, None] + np.diff(edges)[:, None] * part).ravel(), edges[-1])
    away = np.hypot(*(points[:, None] - place(t)).transpose(2, 0, 1))
    nearest = away.argmin(axis=1)
    low, high = t[np.maximum(nearest - 1, 0)], t[np.minimum(nearest + 1, len(t) - 1)]
    golden = 0.5 * (np.sqrt(5.0) - 1.0)
    for _ in range(70):
        one, two = high - golden * (high - low), low + golden * (high - low)
        left = np.hypot(*(points - place(one)).T) < np.hypot(*(points - place(two)).T)
        low, high = np.where(left, low, one), np.where(left, two, high)
    found = np.hypot(*(points - place(0.5 * (low + high))).T)
    freeze(found)
    return np.asarray(found)

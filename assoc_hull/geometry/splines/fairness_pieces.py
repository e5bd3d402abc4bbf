"""What the criteria of fairness look at: pieces of curves with direction, curvature, its slope.

Any curve can be looked at that gives these at places on its pieces, u from 0 to 1 on each. Here
are the composite splines of the kernel, many at once; in
`assoc_hull.geometry.splines.fairness_graph`
graphs y(x) of scipy, in `assoc_hull.analysis.fairness.classical_pieces` chains of arcs, chord
splines and elastica.
"""

from __future__ import annotations

from typing import Protocol

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.vectors import check_normals, dot
from assoc_hull.geometry.splines.closest import closest_each
from assoc_hull.geometry.splines.curvature import space_curvature
from assoc_hull.geometry.splines.segments import power, segment_curve

__all__ = ["Pieces", "Seen", "SplinePieces"]


@attrs.frozen(eq=False)
class Seen:
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


class Pieces(Protocol):
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

    def seen(self, u: FloatArray) -> Seen:
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

    def seen(self, u: FloatArray) -> Seen:
        """Look at all segments at parameters u (k,)."""
        normal = self.normals[self.owner][:, None]
        flat = ~np.isnan(normal[..., 0])
        axis = np.nan_to_num(normal)
        slopes = differentiate(power(self.batch))
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
        told = [np.nan_to_num(each) for each in (tangent, curvature, rate)]
        return Seen(told[0], told[1], told[2], speed, bend, told[2])

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of points (k, 2) or (k, 3) from one curve each, (k,)."""
        flat = np.zeros((len(points), 3 - points.shape[1]))
        return closest_each(self.batch, curve, np.hstack([points, flat]))[2]

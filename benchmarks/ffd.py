"""A free-form deformation to compare with: a lattice of 5 x 5 x 5 control points, Bernstein basis.

Reference: T.W. Sederberg, S.R. Parry, "Free-form deformation of solid geometric models",
SIGGRAPH 1986. It is written with as much care as the fields: weights of the places are computed
once, only places inside the lattice are touched, only coordinates that a control point moves are
computed, a variant is one matrix product, and so are a thousand.
"""

from __future__ import annotations

from math import comb

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.variation.fields.field import FieldRegion

__all__ = ["DEGREE", "Lattice", "LatticeLayer", "LatticePlan"]

DEGREE = 4
SIDE = DEGREE + 1


@attrs.frozen(eq=False)
class Lattice:
    """A box, (2, 3), m, with control points at equal steps."""

    box: FloatArray

    def inside(self, xyz: FloatArray) -> IntArray:
        """Give which places lie in the box."""
        return np.flatnonzero(((xyz >= self.box[0]) & (xyz <= self.box[1])).all(axis=1))

    def weights(self, xyz: FloatArray, along: int | None = None) -> FloatArray:
        """Give weights of the control points (n, 125); `along` differentiates by a coordinate."""
        size = self.box[1] - self.box[0]
        st = (xyz - self.box[0]) / size
        rows = [_slopes(st[:, i]) / size[i] if i == along else _values(st[:, i]) for i in range(3)]
        found: FloatArray = np.einsum("ni,nj,nk->nijk", *rows).reshape(len(xyz), SIDE**3)
        return found


def _values(t: FloatArray) -> FloatArray:
    """Give the Bernstein polynomials, (n, 5)."""
    k = np.arange(SIDE)
    many = np.array([comb(DEGREE, i) for i in range(SIDE)])
    found: FloatArray = many * t[:, None] ** k * (1.0 - t[:, None]) ** (DEGREE - k)
    return found


def _slopes(t: FloatArray) -> FloatArray:
    """Give their derivatives, (n, 5)."""
    k = np.arange(SIDE - 1)
    many = DEGREE * np.array([comb(DEGREE - 1, i) for i in range(SIDE - 1)])
    lower = many * t[:, None] ** k * (1.0 - t[:, None]) ** (DEGREE - 1 - k)
    nil = np.zeros((len(t), 1))
    found: FloatArray = np.hstack([nil, lower]) - np.hstack([lower, nil])
    return found


@attrs.frozen(eq=False)
class LatticeLayer:
    """A lattice whose control points have moved, as a layer of a map; it has an exact Jacobian."""

    lattice: Lattice
    moves: FloatArray
    """(5, 5, 5, 3), m"""

    @property
    def name(self) -> str:
        """For reports."""
        return "lattice"

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the box of the profile plane outside which nothing moves."""
        (x0, _, z0), (x1, _, z1) = self.lattice.box.tolist()
        return (FieldRegion(self.name, (x0, x1), (z0, z1)),)

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give by how much places (n, 3) move, m."""
        inside = self.lattice.inside(xyz)
        moved = np.zeros_like(xyz)
        moved[inside] = self.lattice.weights(xyz[inside]) @ self.moves.reshape(-1, 3)
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        inside = self.lattice.inside(xyz)
        found = np.tile(np.eye(3), (len(xyz), 1, 1))
        for axis in range(3):
            rows = self.lattice.weights(xyz[inside], axis)
            found[inside, :, axis] += rows @ self.moves.reshape(-1, 3)
        return found


@attrs.frozen(eq=False)
class LatticePlan:
    """Weights of given places, kept.

    Attributes
    ----------
    rows : (t,) int
        The places inside.
    axis : int
        The coordinate that moves.
    weights : (c + 1, t)
        Of the control points that may move, and last the coordinate in the parent.
    """

    rows: IntArray
    axis: int
    weights: FloatArray

    @classmethod
    def of(
        cls, lattice: Lattice, xyz: FloatArray, axis: int, active: IntArray | None = None
    ) -> LatticePlan:
        """Compute the weights of places; of all control points if none are named."""
        rows = lattice.inside(xyz)
        chosen = np.arange(SIDE**3) if active is None else active
        return cls(rows, axis, np.vstack([lattice.weights(xyz[rows]).T[chosen], xyz[rows, axis]]))

    def moved(self, moves: FloatArray) -> FloatArray:
        """Give the coordinate that moves in one variant, (t,), by moves (c,) of control points."""
        found: FloatArray = moves @ self.weights[:-1]
        found += self.weights[-1]
        return found

    def batch(self, moves: FloatArray, out: FloatArray | None = None) -> FloatArray:
        """Give the coordinate that moves in variants, (m, t), by moves (m, c)."""
        factors = np.ones((len(moves), len(self.weights)))
        factors[:, :-1] = moves
        found: FloatArray = np.matmul(factors, self.weights, out=out)
        return found

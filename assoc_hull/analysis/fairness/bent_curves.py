"""Curvature of the curves of a net at their knots, and how it changes when points move.

The curvature of a cubic in its plane is almost linear from knot to knot, so knots show what it does
in between. The rates are those of the loft itself: a curve hardly feels a point that is six points
away, so twelve moves, each of every twelfth point of all curves at once, give them all.
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
from scipy.sparse import coo_array, csr_array

from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.dual import Dual
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.loft_tangents import loft_tangents
from assoc_hull.geometry.splines.segments import segment_start
from assoc_hull.model.lofting import curve_data
from assoc_hull.model.tables import HullState

__all__ = ["BentCurves", "CurvatureRates", "end_curvatures"]

_BESIDE = 6
"""So many points of its curve on either side change the curvature at a knot."""


def end_curvatures(batch: SplineBatch, normals: FloatArray) -> tuple[Any, Any]:
    """Give the signed curvature at the start and at the end of each segment, (s,) each, 1/m.

    `normals` (m, 3) are those of the planes of the curves. Of a batch whose arrays are `Dual` the
    curvatures are `Dual`.
    """
    first = segment_start(batch)
    normal = normals[np.searchsorted(batch.start, first, side="right") - 1]
    last = first + 1
    length = (batch.knot[last] - batch.knot[first]).reshape(len(first), 1)
    chord = (batch.xyz[last] - batch.xyz[first]) / length
    leave, arrive = batch.leave[first], batch.arrive[last]
    start = (6.0 * chord - 4.0 * leave - 2.0 * arrive) / length
    end = (2.0 * leave + 4.0 * arrive - 6.0 * chord) / length
    return _curvature(leave, start, normal), _curvature(arrive, end, normal)


def _curvature(first: Any, second: Any, normal: FloatArray) -> Any:
    """Give n . (P' x P'') / |P'|^3."""
    x, y, z = (first[:, axis] for axis in range(3))
    u, v, w = (second[:, axis] for axis in range(3))
    across = (
        (y * w - z * v) * normal[:, 0] + (z * u - x * w) * normal[:, 1]
        + (x * v - y * u) * normal[:, 2]
    )  # fmt: skip
    square = x * x + y * y + z * z
    return across / (square * np.sqrt(square))


@attrs.frozen(eq=False)
class CurvatureRates:
    """Curvature at both ends of each segment, about some displacements of the points that move.

    Attributes
    ----------
    knot : (b,) int
        The knot of each, as a place among the points of all curves.
    value : (b,), 1/m
        The curvature there.
    rate : (b, k) sparse, 1/m2
        How it changes with the displacements.
    """

    knot: IntArray
    value: FloatArray
    rate: csr_array

    def __attrs_post_init__(self) -> None:
        freeze(self.knot, self.value)


@attrs.frozen(eq=False)
class BentCurves:
    """Plane curves of a net whose curvature is looked at, while points of a problem move.

    Attributes
    ----------
    problem : BattenProblem
        The points that move.
    xyz : (rows, 3), m
        All points of the table as they are.
    normals : (m, 3)
        Normals of the planes of the curves.
    data : CurveData
        What the curves are lofted from.
    row, owner : (n,) int, (n,) int
        The points of all curves one after the other, and the curve of each, as its place.
    """

    problem: BattenProblem
    xyz: FloatArray
    normals: FloatArray
    data: CurveData
    row: IntArray
    owner: IntArray

    @classmethod
    def of(
        cls, state: HullState, problem: BattenProblem, curves: IntArray, normals: FloatArray
    ) -> BentCurves:
        """Gather curves (m,) of a net, at least one."""
        rows = [state.curves.rows.data[curve] for curve in curves.tolist()]
        owner = np.repeat(np.arange(len(rows)), [len(each) for each in rows])
        data = curve_data(state, curves)
        return cls(problem, state.rows.xyz.data.copy(), normals, data, np.concatenate(rows), owner)

    def _moved(self, displacement: FloatArray) -> CurveData:
        places = self.problem.places(self.xyz, displacement)
        return attrs.evolve(self.data, xyz=places[self.row])

    def lofted(self, displacement: FloatArray) -> SplineBatch:
        """Loft the curves with the points displaced by (k,), m; what is computed goes along."""
        return loft(self._moved(displacement))

    def rates(self, displacement: FloatArray) -> CurvatureRates:
        """Give the curvatures with the points displaced by (k,), m, and their rates."""
        colours, count = 2 * _BESIDE, len(self.row)
        start, every = self.data.start, np.arange(count)
        turns = np.zeros((colours, count, 3))
        turns[(every - start[self.owner]) % colours, every] = self.problem.all_moves[self.row]
        batch = loft_tangents(self._moved(displacement), turns).batch()
        found = end_curvatures(batch, self.normals)
        assert all(isinstance(each, Dual) for each in found), "the splines have tangents"
        first = segment_start(batch)
        knot = np.concatenate([first, first + 1])
        dot = np.concatenate([each.dot for each in found], axis=1)
        near = knot[:, None] + np.arange(1 - _BESIDE, _BESIDE + 1)
        low, high = start[self.owner[knot]], start[self.owner[knot] + 1]
        here = (near >= low[:, None]) & (near < high[:, None])
        near = np.where(here, near, knot[:, None])
        each = np.arange(len(knot))[:, None]
        rate = np.where(here, dot[(near - low[:, None]) % colours, each], 0.0)
        index = np.repeat(each[:, 0], colours), self.row[near].ravel()
        direct = csr_array(coo_array((rate.ravel(), index), shape=(len(knot), len(self.xyz))))
        value = np.concatenate([each.value for each in found])
        return CurvatureRates(knot, value, csr_array(direct @ self.problem.rates))

"""How points that are computed from curves follow, to first order, when the curves move.

Such a point lies where its driver passes the plane of the line that it defines. The driver
may be defined by computed points itself, so tangents are handed on until nothing changes:
as often as lines stand behind one another, as lines never drive one another in a ring.
"""

from __future__ import annotations

from typing import cast

import attrs
import numpy as np

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.analysis.net.moved_layout import evaluate_cubics
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.dual import Dual, real
from assoc_hull.geometry.splines.segments import locate_parameters, power_coefficients
from assoc_hull.model.tables import HullState

__all__ = ["DrivenPoints"]


@attrs.frozen(eq=False)
class DrivenPoints:
    """Points that are computed from curves, (d,).

    Attributes
    ----------
    row : int
        Their rows in the table of points.
    segment : int
        Segments of their drivers, numbered through the net.
    u : from 0 to 1
        Where on these they lie.
    normal : (d, 3)
        Of the planes of the lines that they define.
    """

    row: IntArray
    segment: IntArray
    u: FloatArray
    normal: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.row, self.segment, self.u, self.normal)

    @classmethod
    def of(cls, state: HullState, net: CurveNet) -> DrivenPoints:
        """Take them from the tables; one without a plane or a place on its driver stays."""
        return cls.among(state, net.curve, net.batch, net.normal)

    @classmethod
    def among(
        cls, state: HullState, curves: IntArray, batch: SplineBatch, normals: FloatArray
    ) -> DrivenPoints:
        """Take those between given curves (m,), with their shapes and normals of planes (m, 3)."""
        table, number = state.rows, np.full(state.curves.count + 1, -1)
        number[curves] = np.arange(len(curves))
        row = state.live("rows")
        row = row[table.driver[row] >= 0]
        side = (table.curve[row, 0] != table.driver[row]).astype(np.int64)
        driver, reader = (number[table.curve[row, each]] for each in (side, 1 - side))
        place, normal = table.parameter[row, side], normals[reader]
        good = (driver >= 0) & (reader >= 0) & np.isfinite(place) & np.isfinite(normal).all(axis=1)
        segment, u = locate_parameters(batch, driver[good], place[good])
        return cls(row[good], segment, u, normal[good])

    def rates(self, points: FloatArray) -> FloatArray:
        """Give how fast the planes move along their normals, (k, d).

        Planes go as the points do that are given with them: `points` (k, r, 3), by row.
        """
        found: FloatArray = (points[:, self.row] * self.normal).sum(axis=2)
        return found

    def moves(self, batch: SplineBatch, rates: FloatArray | float = 0.0) -> FloatArray:
        """Give how they move with drivers that carry k tangents, (k, d, 3).

        `rates` (k, d) tells how fast the planes of the lines move along their normals.
        """
        place, slope = evaluate_cubics(power_coefficients(batch)[self.segment], self.u)
        dot, along = cast("Dual", place).dot, real(slope)
        steep = (along * self.normal).sum(axis=1)
        share = ((dot * self.normal).sum(axis=2) - rates) / np.where(steep == 0.0, np.inf, steep)
        moved: FloatArray = dot - share[..., None] * along
        return moved

"""How points and curves of a hull change with parameters of its shape, to first order.

How points that are computed from curves follow, to first order, when the curves move.

Such a point lies where its driver passes the plane of the line that it defines. The driver
may be defined by computed points itself, so tangents are handed on until nothing changes:
as often as lines stand behind one another, as lines never drive one another in a ring.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.parameters import ShapeParameter
from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.analysis.net.net_surface import evaluate_cubics
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import (
    CurveData,
    EndKind,
    FloatArray,
    IntArray,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.numeric.dual import Dual, real
from assoc_hull.geometry.splines.loft_tangents import loft_tangents
from assoc_hull.geometry.splines.segments import locate_parameters, power_coefficients
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState

__all__ = ["CurveTangents", "DrivenPoints", "curve_tangents", "defining_rows"]


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


_WHERE = "in hydrostatic_derivatives"


@attrs.frozen(eq=False)
class CurveTangents:
    """Curves, and how all that they are made of changes with k parameters.

    Attributes
    ----------
    data : CurveData
        The curves of the net.
    row : (n,) int
        The point of each defining one, in the table of points.
    place : (r, 3), m
        All points of the table.
    points : (k, r, 3), m per unit
        How they move.
    direction : (k, n, 3)
        How given directions change.
    end_vector : (k, m, 2, 3)
        How what is given at ends changes.
    """

    data: CurveData
    row: IntArray
    place: FloatArray
    points: FloatArray
    direction: FloatArray
    end_vector: FloatArray

    def batch(self) -> SplineBatch:
        """Loft the curves, with tangents."""
        xyz = self.points[:, self.row]
        return loft_tangents(self.data, xyz, self.direction, self.end_vector).batch()

    def stepped(self, k: int, step: float) -> tuple[CurveData, FloatArray]:
        """Give curves to be lofted, and all points (r, 3), where parameter k has changed so much.

        Everything goes straight on as its tangent says.
        """
        points = self.place + step * self.points[k]
        data = attrs.evolve(
            self.data,
            xyz=points[self.row],
            direction=self.data.direction + step * self.direction[k],
            end_vector=self.data.end_vector + step * self.end_vector[k],
        )
        return data, points


def defining_rows(state: HullState, curves: IntArray) -> IntArray:
    """Give the rows of the points that define curves, one curve after the other."""
    return np.concatenate([state.curves.rows[each] for each in curves.tolist()])


def curve_tangents(
    base: Flotation, shapes: Sequence[ShapeParameter]
) -> tuple[CurveTangents, SplineBatch]:
    """Give how a hull moves with parameters, and its curves with tangents.

    Parameters
    ----------
    base : Flotation
        The hull.
    shapes : sequence of k ShapeParameter
        The parameters; computed points follow where they say so.

    Raises
    ------
    BadInputError
        A curve of the hull has failed; a parameter that cannot be used.
    """
    found = _given(base, shapes)
    batch = found.batch()
    follows = np.flatnonzero([each.follows for each in shapes])
    if len(follows):
        driven = DrivenPoints.of(base.state, base.net)
        here, rates = np.ix_(follows, driven.row), driven.rates(found.points)
        for _ in range(base.net.batch.count):
            gone = driven.moves(batch, rates)[follows]
            if np.array_equal(found.points[here], gone):
                break
            found.points[here] = gone
            batch = found.batch()
    return found, batch


def _given(base: Flotation, shapes: Sequence[ShapeParameter]) -> CurveTangents:
    """Take how points and directions move by themselves."""
    state, curve = base.state, base.net.curve
    data = curve_data(state, curve)
    if not np.array_equal(data.xyz, base.net.batch.xyz):
        raise BadInputError("a curve has failed", _WHERE, "mend it, or take back the edit")
    row, place = defining_rows(state, curve), state.rows.xyz.data
    points = np.zeros((len(shapes), *place.shape))
    direction = np.zeros((len(shapes), *data.xyz.shape))
    end = np.zeros((len(shapes), *data.end_vector.shape))
    for k, each in enumerate(shapes):
        points[k], gradient = each.moves(state)
        if gradient is not None:
            direction[k], end[k] = _turned(data, gradient[row])
    return CurveTangents(data, row, place, points, direction, end)


def _turned(data: CurveData, gradient: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give how given directions turn: by the gradient at their points, (n, 3, 3)."""
    ends = gradient[np.stack([data.start[:-1], data.start[1:] - 1], axis=1)]
    turned = np.einsum("meij,mej->mei", ends, data.end_vector)
    tangent = (data.end_kind == EndKind.TANGENT)[..., None]
    return np.einsum("nij,nj->ni", gradient, data.direction), np.where(tangent, turned, 0.0)

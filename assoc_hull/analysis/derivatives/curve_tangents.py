"""How all that a hull's curves are made of changes with some parameters of its shape."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.driven_points import DrivenPoints
from assoc_hull.analysis.derivatives.parameters import ShapeParameter
from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.loft_tangents import loft_tangents
from assoc_hull.model.lofting import curve_data
from assoc_hull.model.tables import HullState

__all__ = ["CurveTangents", "curve_tangents", "defining_rows"]

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

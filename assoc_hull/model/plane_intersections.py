"""Cutting a batch of curves with all planes of its partners."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.plane_intersections import PlaneIntersections, intersect_planes
from assoc_hull.model.index import Index, PlaneSet
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = ["PartnerIntersections", "cut_curves"]

Scalar = TypeVar("Scalar", bound=np.generic)


@attrs.frozen(eq=False)
class PartnerIntersections:
    """Meetings of a batch of curves, sorted by curve, then as in `CurveIntersections`.

    Attributes
    ----------
    curve, line : (k,) int
        Place of the curve in the batch, and the line whose plane it meets.
    sign : (k,) int8
        As in `CurveIntersections`.
    segment : (k,) int
        Number of the segment along its curve.
    parameter, xyz : (k,), (k, 3), m
        As in `CurveIntersections`; frozen.
    bounds : list of int
        Where the meetings of each curve begin; the last entry is k.
    """

    curve: IntArray
    line: IntArray
    sign: np.typing.NDArray[np.int8]
    segment: IntArray
    parameter: FloatArray
    xyz: FloatArray
    bounds: list[int]

    def take(self, first: int, stop: int) -> CurveIntersections:
        """Give the meetings of one curve; of which crossings they are is not known yet."""
        span = slice(first, stop)
        return CurveIntersections(
            self.line[span].copy(), self.sign[span].copy(), np.full(stop - first, -1),
            self.parameter[span].copy(), self.xyz[span].copy(),
        )  # fmt: skip


@attrs.frozen(eq=False)
class _Piece:
    """The meetings of the curves of one group with one set of planes."""

    met: PlaneIntersections
    local: IntArray
    segment: IntArray
    planes: PlaneSet


def cut_curves(
    state: HullState, index: Index, curves: IntArray, splines: Sequence[SplineBatch]
) -> PartnerIntersections:
    """Meet the planes of the partners of each curve.

    Parameters
    ----------
    state : HullState
        The tables.
    index : Index
        Holds the planes.
    curves : (m,) int
        The curves.
    splines : sequence of SplineBatch
        Their splines, singly.
    """
    lines = state.curves.line[curves]
    groups = state.lines.group[lines]
    pieces: list[_Piece] = []
    for group in sorted(set(groups.tolist())):
        partners = index.partners.get(group, ())
        if partners:
            mine = np.flatnonzero(groups == group)
            batch = SplineBatch.join([splines[i] for i in mine.tolist()])
            factor = state.tolerances.factor
            pieces += [_cut(mine, batch, planes, factor) for planes in partners]
    return _merge(state, lines, pieces)


def _cut(mine: IntArray, batch: SplineBatch, planes: PlaneSet, factor: float) -> _Piece:
    """Meet one set of planes."""
    met = intersect_planes(batch, planes.normal, planes.offsets, factor)
    segment = met.segment - batch.start.take(met.curve)
    return _Piece(met, mine.take(met.curve), segment, planes)


def _merge(state: HullState, lines: IntArray, pieces: Sequence[_Piece]) -> PartnerIntersections:
    """Sort the meetings of all pieces by curve; along a curve the order of the pieces stays.

    The places are put exactly into the plane of their own curve too.
    """
    if not pieces:
        none, whole = CurveIntersections.none(), np.zeros(0, np.int64)
        bounds = [0] * (len(lines) + 1)
        return PartnerIntersections(
            whole, none.line, none.sign, whole, none.parameter, none.xyz, bounds
        )
    curve = _all([piece.local for piece in pieces], None)
    order = np.argsort(curve, kind="stable") if len(pieces) > 1 else None
    curve = curve if order is None else curve.take(order)
    line = _all([piece.planes.lines.take(piece.met.plane) for piece in pieces], order)
    sign = _all([piece.met.sign for piece in pieces], order)
    bounds = np.searchsorted(curve, np.arange(len(lines) + 1)).tolist()
    segment = _all([piece.segment for piece in pieces], order)
    parameter = _all([piece.met.t for piece in pieces], order)
    xyz = np.concatenate([piece.met.xyz for piece in pieces])
    xyz = xyz if order is None else xyz.take(order, axis=0)
    own = (state.lines.normal[lines] == 1.0).take(curve, axis=0)
    xyz = np.where(own, state.lines.offset[lines].take(curve)[:, None], xyz)
    freeze(line, sign, parameter, xyz)
    return PartnerIntersections(curve, line, sign, segment, parameter, xyz, bounds)


def _all(
    parts: list[np.typing.NDArray[Scalar]], order: IntArray | None
) -> np.typing.NDArray[Scalar]:
    joined = parts[0] if len(parts) == 1 else np.concatenate(parts)
    return joined if order is None else joined.take(order, axis=0)

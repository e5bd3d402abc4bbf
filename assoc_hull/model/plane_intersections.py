"""Cutting a batch of curves with all planes of its partners.

What one cut found is kept, and compared with what the next one finds: where the same curves
meet the same planes in the same senses, as nearly always, the order of the meetings and
their crossings are those of before and only the places are new.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.plane_intersections import PlaneIntersections, intersect_planes
from assoc_hull.graph.derived import same_objects
from assoc_hull.graph.journal import PickedRows
from assoc_hull.model.index import Index, PlaneSet
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = ["LastIntersections", "PartnerIntersections", "cut_curves"]

Scalar = TypeVar("Scalar", bound=np.generic)


@attrs.frozen(eq=False)
class _Piece:
    """The meetings of the curves of one group with one set of planes."""

    met: PlaneIntersections
    local: IntArray
    segment: IntArray
    planes: PlaneSet

    def same(self, other: _Piece) -> bool:
        """Tell whether the same curves meet the same planes in the same senses."""
        mine, theirs = self.met, other.met
        return (
            mine.count == theirs.count
            and bool((mine.plane == theirs.plane).all())
            and bool((mine.curve == theirs.curve).all())
            and bool((mine.sign == theirs.sign).all())
        )


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
    _pieces: tuple[_Piece, ...]
    _order: IntArray | None
    _own: tuple[IntArray, IntArray]
    """Coordinates along the normal of the own plane: numbers into the flat `xyz`, and `curve`."""


@attrs.frozen(eq=False)
class LastIntersections:
    """What the last evaluation of a batch of curves left in the tables.

    Attributes
    ----------
    splines, meets : list
        The objects it wrote; while the tables hold these, all the rest is true.
    batch : SplineBatch
        The splines as one batch.
    found : PartnerIntersections
        Their meetings.
    row : (k,) int
        The crossing at each meeting, -1 if none.
    actual : (a,) int or None
        Meetings that have one; None if all have.
    part : (a,) int
        Where the table of points holds the place of each: twice the row, plus the side.
    spot, at : PickedRows
        What was written there: places and parameters.
    """

    splines: list[SplineBatch]
    meets: list[CurveIntersections]
    batch: SplineBatch
    found: PartnerIntersections
    row: IntArray
    actual: IntArray | None
    part: IntArray
    spot: PickedRows
    at: PickedRows

    def holds(self, splines: Sequence[object], meets: Sequence[object]) -> bool:
        """Tell whether the tables still hold what was written then."""
        return same_objects(self.splines, splines) and same_objects(self.meets, meets)


def cut_curves(
    state: HullState,
    index: Index,
    curves: IntArray,
    splines: Sequence[SplineBatch],
    known: PartnerIntersections | None,
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
    known : PartnerIntersections or None
        What was found for the same curves before.

    Returns
    -------
    PartnerIntersections
        With the arrays `line` and `sign` of `known`, the very objects, where these agree.
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
    return _merge(state, lines, tuple(pieces), known)


def _cut(mine: IntArray, batch: SplineBatch, planes: PlaneSet, factor: float) -> _Piece:
    """Meet one set of planes."""
    met = intersect_planes(batch, planes.normal, planes.offsets, factor)
    segment = met.segment - batch.start.take(met.curve)
    return _Piece(met, mine.take(met.curve), segment, planes)


def _merge(
    state: HullState,
    lines: IntArray,
    pieces: tuple[_Piece, ...],
    known: PartnerIntersections | None,
) -> PartnerIntersections:
    """Sort the meetings of all pieces by curve; along a curve the order of the pieces stays.

    The places are put exactly into the plane of their own curve too.
    """
    count = len(lines)
    if not pieces:
        none = CurveIntersections.none()
        whole, bounds = none.line.copy(), [0] * (count + 1)
        return PartnerIntersections(
            whole,
            none.line,
            none.sign,
            whole,
            none.parameter,
            none.xyz,
            bounds,
            (),
            None,
            (whole, whole),
        )
    if known is not None and all(a.same(b) for a, b in zip(pieces, known._pieces, strict=True)):
        curve, line, sign = known.curve, known.line, known.sign
        bounds, order, own = known.bounds, known._order, known._own
    else:
        curve = _all([piece.local for piece in pieces], None)
        order = np.argsort(curve, kind="stable") if len(pieces) > 1 else None
        curve = curve if order is None else curve.take(order)
        line = _all([piece.planes.lines.take(piece.met.plane) for piece in pieces], order)
        sign = _all([piece.met.sign for piece in pieces], order)
        bounds = np.searchsorted(curve, np.arange(count + 1)).tolist()
        flat = np.flatnonzero((state.lines.normal[lines] == 1.0).take(curve, axis=0))
        own = flat, curve.take(flat // 3)
    segment = _all([piece.segment for piece in pieces], order)
    parameter = _all([piece.met.t for piece in pieces], order)
    xyz = np.concatenate([piece.met.xyz for piece in pieces], out=np.empty((len(curve), 3)))
    xyz = xyz if order is None else xyz.take(order, axis=0)
    xyz.reshape(-1)[own[0]] = state.lines.offset[lines].take(own[1])
    freeze(line, sign, parameter, xyz)
    return PartnerIntersections(
        curve, line, sign, segment, parameter, xyz, bounds, pieces, order, own
    )


def _all(
    parts: list[np.typing.NDArray[Scalar]], order: IntArray | None
) -> np.typing.NDArray[Scalar]:
    joined = parts[0] if len(parts) == 1 else np.concatenate(parts)
    return joined if order is None else joined.take(order, axis=0)

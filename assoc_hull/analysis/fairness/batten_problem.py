"""Batten residuals and curvatures of a whole net, and how they change when its points move.

At each defining point r = m . sum_j c_j P_j, in metres normal to the hull: c are the coefficients
of `assoc_hull.geometry.fairness.criteria`, at fixed chord parameters; m = e (e . n), e the normal
of the curve in its plane and n that of the hull. So r = A d + b for displacements d of the points
that may move, each along its own freedom; points that are computed from curves follow these.
No window runs across a knuckle or a tangent point.

Curvature of the curves of a net at their knots, and how it changes when points move.

The curvature of a cubic in its plane is almost linear from knot to knot, so knots show what it does
in between. The rates are those of the loft itself: a curve hardly feels a point that is six points
away, so twelve moves, each of every twelfth point of all curves at once, give them all.
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
from scipy.sparse import coo_array, csr_array

from assoc_hull.analysis.derivatives.curve_tangents import DrivenPoints
from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.fairness.criteria import WINDOW, batten_coefficients, batten_sharpness
from assoc_hull.geometry.numeric.dual import Dual
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.loft_tangents import loft_tangents
from assoc_hull.geometry.splines.segments import segment_start
from assoc_hull.model.kinds import Sort
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState

__all__ = [
    "BattenProblem",
    "BentCurves",
    "CurvatureRates",
    "batten_problem",
    "end_curvatures",
    "follow",
]

# --------------------------------------------------------------------------------------
# How far points that are computed from curves go when the points move that define the curves.
#
# The rates are those of the loft itself. A curve hardly feels a point that is six points away, so
# twelve moves, each of every twelfth point of all curves at once, give them all.

_BESIDE = 6
"""So many points of its curve on either side move a computed point."""

_DEEPEST = 32
"""Computed points of computed points of ... so often; a net has four or five."""


def driven_rates(
    state: HullState, curves: IntArray, batch: SplineBatch, normals: FloatArray,
    moves: FloatArray, least: float,
) -> csr_array:  # fmt: skip
    """Give how much each computed or riding point moves with each point beside it, (rows, rows).

    Parameters
    ----------
    state : HullState
        The tables.
    curves, batch, normals : (m,) int, SplineBatch, (m, 3)
        All curves, their shapes, and the normals of their planes, nan where there is none.
    moves : (rows, 3)
        Where a unit displacement leads each point; zero for those that stay.
    least : float
        Smaller rates are left out.
    """
    size = len(moves)
    square = (moves * moves).sum(axis=1)
    back = moves / np.where(square > 0.0, square, 1.0)[:, None]
    parts = [_computed(state, curves, batch, normals, moves, back), _riding(state, moves, back)]
    row, column, rate = (np.concatenate(each) for each in zip(*parts, strict=True))
    some = np.abs(rate) > least
    return csr_array(coo_array((rate[some], (row[some], column[some])), shape=(size, size)))


_Entries = tuple[IntArray, IntArray, FloatArray]


def _computed(
    state: HullState, curves: IntArray, batch: SplineBatch, normals: FloatArray,
    moves: FloatArray, back: FloatArray,
) -> _Entries:  # fmt: skip
    """Give rates of crossings that a curve carries, with the points that define the curve."""
    driven = DrivenPoints.among(state, curves, batch, normals)
    if not len(driven.row):
        return _nothing()
    data = curve_data(state, curves)
    row = np.concatenate([state.curves.rows.data[each] for each in curves.tolist()])
    local = np.arange(len(row)) - np.repeat(data.start[:-1], np.diff(data.start))
    colours = 2 * _BESIDE
    turns = np.zeros((colours, len(row), 3))
    turns[local % colours, np.arange(len(row))] = moves[row]
    gone = driven.moves(loft_tangents(data, turns).batch())
    away = (gone * back[driven.row]).sum(axis=2)
    knot = segment_start(batch)[driven.segment]
    owner = np.searchsorted(batch.start, knot, side="right") - 1
    near = knot[:, None] + np.arange(1 - _BESIDE, _BESIDE + 1)
    here = (near >= batch.start[owner][:, None]) & (near < batch.start[owner + 1][:, None])
    near = np.where(here, near, knot[:, None])
    rate = np.where(here, away[local[near] % colours, np.arange(len(knot))[:, None]], 0.0)
    return np.repeat(driven.row, colours), row[near].ravel(), rate.ravel()


def _riding(state: HullState, moves: FloatArray, back: FloatArray) -> _Entries:
    """Give rates of adopted points that ride with those beside them."""
    table = state.rows
    anchor = table.anchor.data
    row = np.flatnonzero(table.alive.data & (anchor >= 0).any(axis=1))
    if not len(row):
        return _nothing()
    pair, weight = anchor[row], table.anchor_weight[row]
    share = np.stack([1.0 - weight, weight], axis=1)
    along = (moves[pair] * back[row][:, None]).sum(axis=2)
    rate = np.where(pair >= 0, share * along, 0.0)
    return np.repeat(row, 2), np.maximum(pair, 0).ravel(), rate.ravel()


def _nothing() -> _Entries:
    none = np.zeros(0, np.int64)
    return none, none, np.zeros(0)


def follow(rates: csr_array, rows: IntArray) -> csr_array:
    """Give how far all points go with points (k,) that are moved, (rows, k), each by its own."""
    size = rates.shape[0]
    own = csr_array(
        coo_array((np.ones(len(rows)), (rows, np.arange(len(rows)))), shape=(size, len(rows)))
    )
    stays = np.ones(size)
    stays[rows] = 0.0
    rates = csr_array(rates.multiply(stays[:, None]))
    found = own
    for _ in range(_DEEPEST):
        before, found = found, csr_array(own + rates @ found)
        if found.nnz == before.nnz and not (found - before).count_nonzero():
            break
    return found


_LEAST = 0.15
"""|e . n| is taken as no less: where a curve is almost square to the hull it says little."""

_SHORT = 1e-9


@attrs.frozen(eq=False)
class BattenProblem:
    """Residuals r = `matrix` d + `residual` of a net, for displacements d of points that move.

    Attributes
    ----------
    rows : (k,) int
        The points that may move, by key.
    moves : (k, 3)
        Where a unit displacement, 1 m along the hull's normal, leads each: U U^T n / |U^T n|^2.
    freedom : (k,)
        |U^T n|: a displacement d is a move of d / |U^T n| along the point's freedom.
    matrix : (r, k) sparse
        How residuals change with displacements.
    residual : (r,), m
        The residuals as the net is.
    curve, centre : (r,) int, (r,) int
        Curve and point of each residual.
    sharpness : (r,), 1/m4
        A residual times this is a divided difference of order four.
    rates : (rows, k) sparse
        Displacements of all points of the table, computed ones too, with those that move.
    all_moves : (rows, 3)
        As `moves`, of all points of the table.
    """

    rows: IntArray
    moves: FloatArray
    freedom: FloatArray
    matrix: csr_array
    residual: FloatArray
    curve: IntArray
    centre: IntArray
    sharpness: FloatArray
    rates: csr_array
    all_moves: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.rows, self.moves, self.freedom, self.residual, self.curve, self.centre)
        freeze(self.sharpness)
        freeze(self.all_moves)

    def part(self, chosen: IntArray) -> BattenProblem:
        """Give the problem in which only some of the points move, by their places in `rows`.

        Residuals that none of these changes are left out.
        """
        matrix = csr_array(self.matrix[:, chosen])
        some = np.flatnonzero(np.diff(matrix.indptr))
        return BattenProblem(
            self.rows[chosen], self.moves[chosen], self.freedom[chosen], csr_array(matrix[some]),
            self.residual[some], self.curve[some], self.centre[some], self.sharpness[some],
            csr_array(self.rates[:, chosen]), self.all_moves,
        )  # fmt: skip

    def tied(self, chosen: IntArray, ties: csr_array) -> BattenProblem:
        """Give the problem in which some points alone move, and all displacements follow theirs.

        `chosen` (c,) are places in `rows`; displacements (k,) are `ties` (k, c) times theirs.
        """
        return attrs.evolve(
            self, rows=self.rows[chosen], moves=self.moves[chosen], freedom=self.freedom[chosen],
            matrix=csr_array(self.matrix @ ties), rates=csr_array(self.rates @ ties),
        )  # fmt: skip

    def residuals_of(self, chosen: IntArray) -> BattenProblem:
        """Give the problem of some of the residuals, by their places."""
        return attrs.evolve(
            self, matrix=csr_array(self.matrix[chosen]), residual=self.residual[chosen],
            curve=self.curve[chosen], centre=self.centre[chosen],
        )  # fmt: skip

    def shifted(self, displacement: FloatArray) -> BattenProblem:
        """Give the problem about the net displaced by (k,), m; weights and directions stay."""
        residual = self.residual + self.matrix @ displacement
        return attrs.evolve(self, residual=residual)

    def places(self, xyz: FloatArray, displacement: FloatArray) -> FloatArray:
        """Give where all points (rows, 3), m, come to with displacements (k,), to first order."""
        found: FloatArray = xyz + self.all_moves * (self.rates @ displacement)[:, None]
        return found


def batten_problem(
    state: HullState, rows: IntArray, normal: FloatArray, along: FloatArray, least: float = 1e-2
) -> BattenProblem:
    """Put the residuals of all curves of a net together.

    Parameters
    ----------
    state : HullState
        The tables.
    rows : (k,) int
        The points that may move, in the order wanted.
    normal, along : (rows, 3)
        Of all points of the table: the unit outward normal of the hull, and what a point's freedom
        is of it, U U^T n.
    least : float
        Computed points go along where they do by more than this part; a tenth of what it is changed
        what is left of noise by 1e-4.
    """
    curves = np.array(
        [each for each in state.live("curves").tolist() if state.curves.spline.data[each]],
        np.int64,
    )
    batch = SplineBatch.join([state.spline(each) for each in curves.tolist()])
    line = state.curves.line[curves]
    flat = state.lines.planar[line]
    planes = np.where(flat[:, None], state.lines.normal[line], np.nan)
    freedom, moves = _moves(state, rows, along)
    rates = follow(driven_rates(state, curves, batch, planes, moves, least), rows)
    window = _windows(state, curves, batch, np.diff(rates.indptr) > 0)
    row = _defining(state, curves)
    point = row[window]
    owner = np.searchsorted(batch.start, window[:, 2], side="right") - 1
    measure = _measures(batch, window[:, 2], planes[owner], normal[point[:, 2]])
    weight = batten_coefficients(batch.knot[window])
    residual = np.einsum("rj,rji,ri->r", weight, state.rows.xyz.data[point], measure)
    change = weight * np.einsum("rji,ri->rj", moves[point], measure)
    index = np.repeat(np.arange(len(window)), WINDOW), point.ravel()
    shape = len(window), len(moves)
    direct = csr_array(coo_array((change.ravel(), index), shape=shape))
    return BattenProblem(
        rows, moves[rows], freedom, csr_array(direct @ rates), residual,
        curves[owner], point[:, 2], batten_sharpness(batch.knot[window]), rates, moves,
    )  # fmt: skip


def _defining(state: HullState, curves: IntArray) -> IntArray:
    return np.concatenate([state.curves.rows.data[each] for each in curves.tolist()])


def _moves(state: HullState, rows: IntArray, along: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give |U^T n| of the points that may move, and where a unit displacement leads all points.

    Computed points whose freedom is almost tangential are moved by 1 m along it.
    """
    length = np.sqrt((along * along).sum(axis=1))
    good = length >= state.tolerances.field_normal
    divisor = np.where(good, length * length, np.where(length > _SHORT, length, np.inf))
    moves = along / divisor[:, None]
    table = state.rows
    follows = (table.driver.data >= 0) | (table.anchor.data >= 0).any(axis=1)
    follows &= table.alive.data & (table.sort.data != Sort.PLACED)
    follows[rows] = True
    moves[~follows] = 0.0
    return length[rows], moves


def _windows(
    state: HullState, curves: IntArray, batch: SplineBatch, moved: np.typing.NDArray[np.bool_]
) -> IntArray:
    """Give the windows of five points, as places in the batch, in which some point is moved."""
    row = _defining(state, curves)
    side = np.concatenate([state.curves.side.data[each] for each in curves.tolist()])
    broken = state.rows.kind.data[row, side] != 0
    first = np.arange(max(len(row) - WINDOW + 1, 0))
    owner = np.repeat(np.arange(len(curves)), np.diff(batch.start))
    whole = owner[first] == owner[first + WINDOW - 1]
    for inner in range(1, WINDOW - 1):
        whole &= ~broken[first + inner]
    window = first[whole][:, None] + np.arange(WINDOW)
    found: IntArray = window[moved[row[window]].any(axis=1)]
    return found


def _measures(
    batch: SplineBatch, knot: IntArray, plane: FloatArray, normal: FloatArray
) -> FloatArray:
    """Give m = e (e . n) at knots (r,): in the plane of the curve, or square to it in space."""
    tangent = batch.leave[knot] + batch.arrive[knot]
    tangent /= np.sqrt((tangent * tangent).sum(axis=1))[:, None]
    planar = np.isfinite(plane[:, 0])
    across = np.cross(np.where(planar[:, None], plane, 0.0), tangent)
    beside = normal - (normal * tangent).sum(axis=1)[:, None] * tangent
    e = np.where(planar[:, None], across, beside)
    length = np.sqrt((e * e).sum(axis=1))
    e /= np.where(length > _SHORT, length, 1.0)[:, None]
    cosine = (e * normal).sum(axis=1)
    unknown = ~(normal != 0.0).any(axis=1)
    size = np.where(unknown, 1.0, np.maximum(np.abs(cosine), _LEAST))
    return e * np.where(cosine < 0.0, -size, size)[:, None]


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

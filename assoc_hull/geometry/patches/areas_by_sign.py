"""Areas of surface where a polynomial is positive, negative, zero, and where this is not known.

Cells of one sign are integrated whole, cells with an arc are parted along it.
Arcs are taken as curves u = g(v), with rules that contain one another and so measure their error.
Undecided cells are shared out by samples, and their area is reported by itself.
"""

from __future__ import annotations

from functools import cache
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.area_integrals import (
    AreaIntegrator,
    bernstein_values,
    pairwise_sum,
)
from assoc_hull.geometry.patches.bernstein_polynomials import transform_coefficients
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cells import CellKind, SignCells, ZeroSetArcs
from assoc_hull.geometry.patches.zero_set_arcs import arc_heights

__all__ = [
    "SAMPLES",
    "ArcCurves",
    "ArcRules",
    "SignAreas",
    "arc_curves",
    "arc_rules",
    "areas_below_arcs",
    "sampled_signs",
    "sign_areas",
]

# Quadrature rules on [0, 1] that contain one another: Lobatto's of 4 points, its extension by 3
# points, and that of this one by 6; exact to the degrees 5, 9 and 19.
# Source: W. Gander and W. Gautschi, "Adaptive quadrature - revisited", BIT 40, 2000.


@attrs.frozen(eq=False)
class ArcRules:
    """Nodes, weights, and how values at some nodes give those at others.

    Attributes
    ----------
    first : (7,)
        Nodes of the smaller rule, in rising order, both ends included.
    second : (6,)
        Nodes that the larger one adds.
    few, many : (3, 7), (3, 13)
        Weights of the two rules, and those of the last two terms of a series in polynomials:
        degrees 5 and 6, 11 and 12. The rules leave out terms of degrees beyond 9 and 19 only, so
        these two tell how large their errors are at most. One is zero for all even functions, the
        other for all odd ones; so not both vanish by chance.
    between : (6, 7)
        The polynomial through values at the first nodes, at the second.
    inside : (10, 13)
        That through all, at the 5 inner nodes of the smaller rule on both halves.
    """

    first: FloatArray
    second: FloatArray
    few: FloatArray
    many: FloatArray
    between: FloatArray
    inside: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*(getattr(self, field.name) for field in attrs.fields(type(self))))


@cache
def arc_rules() -> ArcRules:
    """Give the rules.

    Returns
    -------
    ArcRules
        Made once.

    Examples
    --------
    >>> abs(arc_rules().few.sum(axis=1)).round(12)
    array([1., 0., 0.])
    """
    inner, outer = 1.0 / np.sqrt(5.0), np.sqrt(2.0 / 3.0)
    more = np.array([0.942882415695480, 0.641853342345781, 0.236383199662150])
    first = np.array([-1.0, -outer, -inner, 0.0, inner, outer, 1.0])
    second = np.concatenate([-more, more[::-1]])
    every = np.concatenate([first, second])
    few, many = (_measured(t, _weights(t)) for t in (first, every))
    halves = np.concatenate([0.5 * first[1:-1] - 0.5, 0.5 * first[1:-1] + 0.5])
    return ArcRules(
        0.5 + 0.5 * first, 0.5 + 0.5 * second, few, many,
        _through(first, second), _through(every, halves),
    )  # fmt: skip


def _through(nodes: FloatArray, places: FloatArray) -> FloatArray:
    """Give the matrix from values at nodes to values at places of the polynomial through them."""
    degree = len(nodes) - 1
    at = (np.polynomial.legendre.legvander(t, degree).T for t in (nodes, places))
    return np.array(np.linalg.solve(*at).T, np.float64)


def _measured(nodes: FloatArray, rule: FloatArray) -> FloatArray:
    """Give the weights of a rule, and those that give the last two terms of a series.

    The terms are those of polynomials that are orthonormal with respect to the rule itself.
    """
    root = np.sqrt(rule)
    values = np.polynomial.legendre.legvander(nodes, len(nodes) - 1)
    basis = np.linalg.qr(values * root[:, None])[0]
    return np.concatenate([rule[None], (basis * root[:, None]).T[-2:]])


def _weights(nodes: FloatArray) -> FloatArray:
    """Give the weights, on [0, 1], of the rule that is exact for as many powers as it has nodes."""
    moments = np.zeros(len(nodes))
    moments[0] = 1.0
    values = np.polynomial.legendre.legvander(nodes, len(nodes) - 1).T
    return np.asarray(np.linalg.solve(values, moments), np.float64)


# Arcs at a time, so that their values stay in the cache.
_ROOT_BLOCK = 512


@attrs.frozen(eq=False)
class ArcCurves:
    """Arcs u = g(v), one a row, with what is needed to find g.

    Attributes
    ----------
    patch : (a,) int
        The patch of each.
    flip : (a,) int
        1 where the parameters are exchanged, here and in all that follows; else 0.
    box : (a, 2, 2)
        Its cell, ``[[u0, u1], [v0, v1]]`` in parameters of the patch.
    b : (a, M + 1, N + 1)
        The polynomial in the cell.
    rising : (a,) bool
        Whether it is positive on the side of larger u.
    span : (a, 2)
        v at both ends of the arc.
    ends : (a, 2)
        u there.
    """

    patch: IntArray
    flip: IntArray
    box: FloatArray
    b: FloatArray
    rising: NDArray[np.bool_]
    span: FloatArray
    ends: FloatArray

    def __len__(self) -> int:
        """Count the arcs."""
        return len(self.patch)

    def at(self, row: IntArray, v: FloatArray, start: FloatArray) -> FloatArray:
        """Find g, (c, q), at places v (c, q) of arcs `row` (c,), from rough values `start` (c, q).

        All in parameters of the patch.
        """
        found = np.empty_like(v)
        for first in range(0, len(row), _ROOT_BLOCK):
            part = slice(first, first + _ROOT_BLOCK)
            found[part] = self._at(row[part], v[part], start[part])
        return found

    def _at(self, row: IntArray, v: FloatArray, start: FloatArray) -> FloatArray:
        box = self.box[row]
        low, size = box[..., :1], box[..., 1:] - box[..., :1]
        t = np.clip((v - low[:, 1]) / size[:, 1], 0.0, 1.0)
        rough = (start - low[:, 0]) / size[:, 0]
        return low[:, 0] + size[:, 0] * arc_heights(self.b[row], self.rising[row], t, rough)


def arc_curves(
    cells: SignCells, arcs: ZeroSetArcs, chosen: IntArray
) -> list[tuple[ArcCurves, IntArray]]:
    """Turn chosen arcs (c,) into curves u = g(v), with the rows of `arcs` that they are, (a,).

    One batch if the polynomial has one degree in u and v, else one for each way that arcs run.
    """
    if cells.b.shape[1] == cells.b.shape[2]:
        parts = [chosen]
    else:
        parts = [chosen[arcs.across[chosen] == way] for way in (0, 1)]
    return [(_curves(cells, arcs, rows), rows) for rows in parts if len(rows)]


def _curves(cells: SignCells, arcs: ZeroSetArcs, rows: IntArray) -> ArcCurves:
    cell, flip = arcs.cell[rows], arcs.across[rows]
    box, b = cells.box[cell], cells.b[cells.row[cell]]
    flipped = (flip == 1)[:, None, None]
    box = np.where(flipped, box[:, ::-1], box)
    if flip.all():
        b = np.ascontiguousarray(b.swapaxes(1, 2))
    elif flip.any():
        b = np.where(flipped, b.swapaxes(1, 2), b)
    ends = arcs.ends[rows, :, flip]
    return ArcCurves(cells.patch[cell], flip, box, b, arcs.rising[rows], arcs.span[rows], ends)


# --------------------------------------------------------------------------------------
# Areas below arcs u = g(v) as height functions (R. I. Saye, SIAM J. Sci. Comput. 37(2), 2015, and
# J. Comput. Phys. 448, 2022): the integral over v of that of the area element from the border of
# the cell to g(v). Each g(v) is a root of the polynomial itself, so the integrand is smooth.

_ROUNDS = 30


def areas_below_arcs(
    ground: AreaIntegrator, curves: ArcCurves, tolerance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Integrate from the lower border in u of each cell to its arc, as far as the arc goes.

    Gives areas and estimates of their errors, (a,) and (a,), m2; each estimate is to stay below its
    `tolerance` (a,), m2. The `error` of `ground` is not counted.
    """
    count = len(curves)
    value, error = np.zeros((2, count))
    pieces = _Pieces.whole(ground, curves, tolerance)
    for turn in range(_ROUNDS):
        found, off, u = pieces.integrate()
        good = off <= pieces.allowed
        if turn == _ROUNDS - 1:
            good[:] = True
        value += np.bincount(pieces.row[good], found[good], count)
        error += np.bincount(pieces.row[good], off[good], count)
        if good.all():
            break
        pieces = pieces.halved(np.flatnonzero(~good), u)
    return value, error


@attrs.frozen(eq=False)
class _Pieces:
    """Pieces of arcs, c of them: v and u of their ends, and u between them, roughly.

    The first rule has 7 points, two of them the ends, which are known. Where its error is too large
    6 more make the rule of 13; where that is not enough the piece is halved. Roots are looked for
    from the polynomial through those that are known.
    """

    ground: AreaIntegrator
    curves: ArcCurves
    row: IntArray
    span: FloatArray
    ends: FloatArray
    rough: FloatArray
    allowed: FloatArray

    @classmethod
    def whole(cls, ground: AreaIntegrator, curves: ArcCurves, tolerance: FloatArray) -> Self:
        """Begin with all of each arc, and what is between its ends on a straight line."""
        nodes = arc_rules().first[1:-1]
        ends, rows = curves.ends, np.arange(len(curves))
        rough = ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * nodes
        return cls(ground, curves, rows, curves.span, ends, rough, tolerance)

    def integrate(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Integrate each by 7 points, or by 13; give the u of these, too."""
        rules, every = arc_rules(), np.arange(len(self.row))
        u = np.zeros((len(every), 13))
        u[:, 0], u[:, 6] = self.ends.T
        u[:, 1:6] = self._heights(every, rules.first[1:-1], self.rough)
        values, slack = self._values(every, rules.first, u[:, :7])
        width = self.span[:, 1] - self.span[:, 0]
        found, off = _judged(values, rules.few, width)
        off += slack * width
        more = np.flatnonzero(off > self.allowed)
        if len(more):
            rough = _mixed(rules.between, u[more, :7])
            u[more, 7:] = self._heights(more, rules.second, rough)
            further, slack = self._values(more, rules.second, u[more, 7:])
            width = width[more]
            found[more], off[more] = _judged(
                np.concatenate([values[:, more], further]), rules.many, width
            )
            off[more] += slack * width
        return found, off, u

    def _heights(self, part: IntArray, nodes: FloatArray, rough: FloatArray) -> FloatArray:
        return self.curves.at(self.row[part], self._places(part, nodes), rough)

    def _places(self, part: IntArray, nodes: FloatArray) -> FloatArray:
        span = self.span[part]
        return span[:, :1] + (span[:, 1:] - span[:, :1]) * nodes

    def _values(
        self, part: IntArray, nodes: FloatArray, u: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Give the inner integrals (q, c), and the most they may be off by, (c,)."""
        curves, row = self.curves, self.row[part]
        width = self.span[part, 1] - self.span[part, 0]
        allowed = 0.25 * self.allowed[part] / np.where(width > 0.0, width, 1.0)
        values, off = self.ground.between(
            curves.patch[row], curves.flip[row], curves.box[row, 0, 0], u,
            self._places(part, nodes), allowed,
        )  # fmt: skip
        return values.T.copy(), off.max(axis=1)

    def halved(self, chosen: IntArray, u: FloatArray) -> Self:
        """Halve the chosen ones, of which the u of 13 points are known."""
        span, ends = self.span[chosen].repeat(2, axis=0), self.ends[chosen].repeat(2, axis=0)
        half = 0.5 * (self.span[chosen, 0] + self.span[chosen, 1])
        for place, at in ((span, half), (ends, u[chosen, 3])):
            place[::2, 1], place[1::2, 0] = at, at
        rough = _mixed(arc_rules().inside, u[chosen]).reshape(-1, 5)
        return attrs.evolve(
            self, row=self.row[chosen].repeat(2), span=span, ends=ends, rough=rough,
            allowed=(0.5 * self.allowed[chosen]).repeat(2),
        )  # fmt: skip


def _mixed(matrix: FloatArray, values: FloatArray) -> FloatArray:
    """Multiply each row by a matrix, all in the same way however many rows there are."""
    return np.asarray((matrix @ values[..., None])[..., 0])


def _judged(
    values: FloatArray, rules: FloatArray, width: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give integrals by a rule, and the last two terms of the series through the values.

    These terms are far larger than those that the rule leaves out, so the error is less than they.
    """
    found, *terms = (width * pairwise_sum(values * weights[:, None]) for weights in rules)
    return found, np.abs(terms[0]) + np.abs(terms[1])


# --------------------------------------------------------------------------------------
# Cells in which the sign is not decided: what samples tell of them.

SAMPLES = 16
"""Samples in each parameter of a cell."""

# Cells at a time, so that the values stay in the cache.
_SAMPLE_BLOCK = 256


def sampled_signs(cells: SignCells, rows: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give the shares of samples of each sign in cells `rows` (c,) in which it is not decided.

    Positive, negative and in doubt, (c,) each: zero to the error of the polynomial, or beside one
    of another sign. A sample that is zero to the error counts as the others of its cell do if these
    are of one sign, as beside a line without change of sign; else by its value, as the error is a
    bound far above what rounding does.
    """
    found = np.empty((3, len(rows)))
    for first in range(0, len(rows), _SAMPLE_BLOCK):
        part = slice(first, first + _SAMPLE_BLOCK)
        found[:, part] = _shares(*(a[cells.row[rows[part]]] for a in (cells.b, cells.err)))
    return found[0], found[1], found[2]


def _shares(b: FloatArray, err: FloatArray) -> FloatArray:
    places = (np.arange(SAMPLES) + 0.5) / SAMPLES
    in_u, in_v = (bernstein_values(size - 1, places).T for size in b.shape[1:])
    value, error = transform_coefficients(in_u, b, in_v), transform_coefficients(in_u, err, in_v)
    sign = np.where(value > error, 1, np.where(value < -error, -1, 0))
    doubt = sign == 0
    differ = sign[:, 1:] != sign[:, :-1]
    doubt[:, 1:] |= differ
    doubt[:, :-1] |= differ
    differ = sign[..., 1:] != sign[..., :-1]
    doubt[..., 1:] |= differ
    doubt[..., :-1] |= differ
    above, below = ((sign == side).any(axis=(1, 2))[:, None, None] for side in (1, -1))
    positive = np.where(above == below, value > 0.0, above)
    negative = np.where(above == below, value < 0.0, below)
    return np.array([part.mean(axis=(1, 2)) for part in (positive, negative, doubt)])


# --------------------------------------------------------------------------------------
# Areas by sign: cells whole, parted along arcs, or shared out by samples.

# What rounding may leave of the area of a patch.
_ROUNDING = 4e-15
# Arcs at a time: their polynomials take room.
_ARC_BLOCK = 2048


@attrs.frozen(eq=False)
class SignAreas:
    """Areas of each patch of a batch.

    Attributes
    ----------
    positive, negative, zero : (k,) float, m2
        Where the polynomial has this sign, or is zero to its error; cells without a decision in
        none of them.
    unresolved : (k,) float, m2
        The area of the cells without a decision. What is positive lies between `positive` and
        `positive` + `unresolved`, but for `error_estimate`; and so on.
    positive_estimate, negative_estimate : (k,) float, m2
        The same areas with what samples in the cells without a decision add.
    error_estimate : (k,) float, m2
        What these two, and `total`, may be off by: the differences of the rules, the samples with a
        neighbour of the other sign, and by how much all parts do not make up the total.
    total : (k,) float, m2
        The area of each patch, by a rule of its own.
    """

    positive: FloatArray
    negative: FloatArray
    zero: FloatArray
    unresolved: FloatArray
    positive_estimate: FloatArray
    negative_estimate: FloatArray
    error_estimate: FloatArray
    total: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*(getattr(self, field.name) for field in attrs.fields(type(self))))

    def __len__(self) -> int:
        """Count the patches."""
        return len(self.total)


def sign_areas(
    patches: Patches,
    cells: SignCells,
    arcs: ZeroSetArcs,
    area_tol: float = 1e-6,
    ground: AreaIntegrator | None = None,
) -> SignAreas:
    """Find the areas of the regions of each sign.

    Parameters
    ----------
    patches : Patches
        The patches, k of them.
    cells : SignCells
        Their cells, for one polynomial.
    arcs : ZeroSetArcs
        The arcs in these cells, at most one in each.
    area_tol : float
        How large the estimate of the error may be, in parts of the area of a patch.
    ground : AreaIntegrator, optional
        What areas are taken from, if it was made before: ``AreaIntegrator.of(patches, area_tol)``.
        It serves any polynomial on the same patches.

    Returns
    -------
    SignAreas
        For each patch; what is found for one does not depend on the others, to the last bit. All
        errors are estimates of the rules themselves, none is a guess from a grid.
    """
    count = len(patches)
    ground = AreaIntegrator.of(patches, area_tol) if ground is None else ground
    allowed = area_tol * ground.scale
    number = np.bincount(cells.patch, minlength=count)
    cell_tol = (0.25 * allowed / np.maximum(number, 1))[cells.patch]
    whole, off = ground.over(cells.patch, cells.box, cell_tol)
    whole = np.maximum(whole, 0.0)
    low, low_off = _low_parts(ground, cells, arcs, allowed, whole)
    low = np.clip(low, 0.0, whole[arcs.cell])
    sign = _signs(cells)
    parted = np.zeros(len(cells), np.bool_)
    parted[arcs.cell] = True
    positive = np.where(sign == 1, whole, 0.0)
    positive[arcs.cell] = np.where(arcs.rising, whole[arcs.cell] - low, low)
    negative = np.where((sign < 0) | parted, whole - positive, 0.0)
    unknown = np.nonzero(cells.kind == CellKind.UNRESOLVED)[0]
    above, under, doubt = (part * whole[unknown] for part in sampled_signs(cells, unknown))
    off[arcs.cell] += low_off
    off[unknown] += doubt

    def summed(values: FloatArray, rows: IntArray | slice = slice(None)) -> FloatArray:
        return np.asarray(np.bincount(cells.patch[rows], values, count), np.float64)

    found = summed(positive), summed(negative), summed(np.where(sign == 0, whole, 0.0))
    rest = summed(whole[unknown], unknown)
    error = summed(off) + ground.error + _ROUNDING * ground.total
    error += np.abs(found[0] + found[1] + found[2] + rest - ground.total)
    return SignAreas(
        *found, rest, found[0] + summed(above, unknown), found[1] + summed(under, unknown),
        error, ground.total.copy(),
    )  # fmt: skip


def _signs(cells: SignCells) -> IntArray:
    """Give the sign of each cell, 2 where there is none; a simple cell without arc has one."""
    sign = np.where(cells.kind == CellKind.UNRESOLVED, 2, cells.kind)
    simple = np.nonzero((cells.kind == CellKind.U_SIMPLE) | (cells.kind == CellKind.V_SIMPLE))[0]
    mean = cells.b[cells.row[simple]].sum(axis=(1, 2))
    sign[simple] = np.where(mean > 0.0, 1, -1)
    return sign


def _low_parts(
    ground: AreaIntegrator,
    cells: SignCells,
    arcs: ZeroSetArcs,
    allowed: FloatArray,
    whole: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Give the area of the part of smaller u (or v) of each cell with an arc, and its error."""
    patch = cells.patch[arcs.cell]
    number = np.bincount(patch, minlength=len(allowed))
    # The tolerance goes half by area, half by number of arcs.
    share = whole[arcs.cell] / ground.scale[patch] + 1.0 / number[patch]
    tolerance = np.maximum(0.3 * allowed, 1e-15 * ground.scale)[patch] * share
    value, error = np.zeros((2, len(arcs)))
    for first in range(0, len(arcs), _ARC_BLOCK):
        chosen = np.arange(first, min(first + _ARC_BLOCK, len(arcs)))
        for curves, rows in arc_curves(cells, arcs, chosen):
            value[rows], error[rows] = _low(ground, curves, tolerance[rows])
    return value, error


def _low(
    ground: AreaIntegrator, curves: ArcCurves, tolerance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Add what lies below the arcs, and beyond their ends where they leave a cell sideways."""
    value, error = areas_below_arcs(ground, curves, tolerance)
    beyond = np.empty((2, len(value), 2, 2))
    beyond[:, :, 0, 0] = curves.box[:, 0, 0]
    beyond[:, :, 0, 1] = curves.ends.T
    beyond[0, :, 1], beyond[1, :, 1] = curves.box[:, 1], curves.box[:, 1]
    beyond[0, :, 1, 1], beyond[1, :, 1, 0] = curves.span.T
    beyond = np.where((curves.flip == 1)[:, None, None], beyond[:, :, ::-1], beyond)
    side, row = np.nonzero((beyond[..., 1] > beyond[..., 0]).all(axis=2))
    part, off = ground.over(curves.patch[row], beyond[side, row], 0.25 * tolerance[row])
    value += np.bincount(row, part, len(value))
    error += np.bincount(row, off, len(value))
    return value, error

"""Patches cut into cells until the sign of a polynomial in each is known, or changes along one arc.

Signs follow from coefficients outside the dead band of their errors, and from nothing else.
Factors that vanish along edges of the square are divided out: rounding would be cut without end.
Where a cut of the search touches the zero set, the patch is cut again at other places.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import TypeVar

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.bernstein_polynomials import (
    binomials,
    elevation,
    restriction_matrices,
)
from assoc_hull.geometry.patches.cells import (
    CellKind,
    Lattice,
    SignCells,
    ZeroSetArcs,
    select_patches,
)
from assoc_hull.geometry.patches.clusters import find_clusters
from assoc_hull.geometry.patches.curvature_functions import IsoFunction

__all__ = [
    "FIRST_CUT",
    "OTHER_CUT",
    "cell_kinds",
    "count_sign_changes",
    "divide_by_edge_lines",
    "first_and_last",
    "signs",
    "subdivide_again",
    "subdivide_patches",
    "zero_edges",
]

# A coefficient has a sign where it exceeds its error; else it lies in the dead band and has none.

Signs = NDArray[np.int8]
_Scalar = TypeVar("_Scalar", bound=np.generic)


def signs(b: FloatArray, err: FloatArray) -> Signs:
    """Give 1 above the dead band, -1 below it, 0 within."""
    return np.asarray((b > err).astype(np.int8) - (b < -err).astype(np.int8))


def carry_signs(s: Signs) -> Signs:
    """Give each coefficient in the dead band the sign of the one before it, if any."""
    place = np.where(s != 0, np.arange(s.shape[-1]), 0)
    return np.take_along_axis(s, np.maximum.accumulate(place, axis=-1), axis=-1)


def count_sign_changes(s: Signs) -> NDArray[np.intp]:
    """Count the changes of sign along the last axis; the dead band is passed over."""
    full = carry_signs(s)
    return np.asarray(np.count_nonzero(full[..., 1:] * full[..., :-1] < 0, axis=-1))


def first_and_last(s: Signs) -> tuple[Signs, Signs]:
    """Give the first and the last sign along the last axis; 0 where there is none."""
    full, back = carry_signs(s), carry_signs(s[..., ::-1])
    return back[..., -1], full[..., -1]


def zero_edges(b: FloatArray, err: FloatArray) -> NDArray[np.bool_]:
    """Tell on which edges a polynomial is zero: all its coefficients in the dead band, (k, 4).

    In the order u = 0, u = 1, v = 0, v = 1.
    """
    return np.stack([edge.all(axis=1) for edge in _edges(signs(b, err) == 0)], axis=1)


def _edges(a: NDArray[_Scalar]) -> tuple[NDArray[_Scalar], ...]:
    """Give the coefficients on the edges u = 0, u = 1, v = 0 and v = 1."""
    return a[:, 0], a[:, -1], a[:, :, 0], a[:, :, -1]


def cell_kinds(b: FloatArray, err: FloatArray, outer: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Tell what the coefficients prove of the signs in a cell.

    Coefficients of one sign prove that the polynomial has it. Where all differences in u have one
    sign, beyond their error, and each of the edges u = 0 and u = 1 changes sign at most once, a
    line v = constant meets the zero set at most once, no loop has room, and there is one arc.

    Coefficients in the dead band prove nothing on an edge that is shared with another cell: the
    two might see an arc cross it in one and not in the other. Elsewhere they do no harm.

    Parameters
    ----------
    b, err : (c, M + 1, N + 1)
        Coefficients and their errors.
    outer : (c, 2, 2) bool
        Whether the edges u = 0, u = 1 and v = 0, v = 1 of a cell are shared with no other.

    Returns
    -------
    (c,) int
        A `CellKind` each; UNRESOLVED where nothing is proved.
    """
    least, most = b - err, b + err
    flat = len(b), b.shape[1] * b.shape[2]
    above = (least > 0.0).reshape(flat).any(axis=1)
    below = (most < 0.0).reshape(flat).any(axis=1)
    found = np.where(above, 1, 0) - np.where(below, 1, 0)
    pure = np.flatnonzero(found)
    found[pure[_doubtful_edges(least[pure], most[pure], outer[pure])]] = CellKind.UNRESOLVED
    open_ = np.flatnonzero(above & below)
    found[open_] = _simple(least[open_], most[open_], outer[open_])
    return found


def _doubtful_edges(
    least: FloatArray, most: FloatArray, outer: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Tell where coefficients on a shared edge lie in the dead band."""
    lines = [
        ((low <= 0.0) & (high >= 0.0)).any(axis=1)
        for low, high in zip(_edges(least), _edges(most), strict=True)
    ]
    return np.asarray((np.stack(lines, axis=1) & ~outer.reshape(-1, 4)).any(axis=1))


def _doubtful_corners(
    least: FloatArray, most: FloatArray, outer: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Tell where a corner at a shared edge lies in the dead band."""
    corners = np.ix_([0, least.shape[1] - 1], [0, least.shape[2] - 1])
    dead = (least[:, *corners] <= 0.0) & (most[:, *corners] >= 0.0)
    alone = outer[:, 0, :, None] & outer[:, 1, None, :]
    return np.asarray((dead & ~alone).any(axis=(1, 2)))


def _simple(least: FloatArray, most: FloatArray, outer: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Tell what is proved where both signs occur: simple the way the polynomial changes more."""
    u = _change(least, most)
    v = _change(least.swapaxes(1, 2), most.swapaxes(1, 2))
    found = np.where(v > u, int(CellKind.V_SIMPLE), int(CellKind.U_SIMPLE))
    found[np.maximum(u, v) < 0.0] = CellKind.UNRESOLVED
    found[_doubtful_corners(least, most, outer)] = CellKind.UNRESOLVED
    return found


def _change(least: FloatArray, most: FloatArray) -> FloatArray:
    """Tell how much cells change along their first axis; -1 where they are not simple that way.

    Most cells that are not are known by their first column.
    """
    found = np.full(len(least), -1.0)
    rows = np.flatnonzero(_monotone(least[:, :, :1], most[:, :, :1]))
    rows = rows[_monotone(least[rows], most[rows])]
    low, high = least[rows][:, [0, -1]], most[rows][:, [0, -1]]
    once = (
        count_sign_changes((low > 0.0).astype(np.int8) - (high < 0.0).astype(np.int8)) <= 1
    ).all(axis=1)
    low, high = low[once], high[once]
    found[rows[once]] = np.abs(low[:, 1] + high[:, 1] - low[:, 0] - high[:, 0]).sum(axis=1)
    return found


def _monotone(least: FloatArray, most: FloatArray) -> NDArray[np.bool_]:
    """Tell which cells rise, or fall, along their first axis by more than their errors."""
    rising = (least[:, 1:] > most[:, :-1]).all(axis=(1, 2))
    return np.asarray(rising | (most[:, 1:] < least[:, :-1]).all(axis=(1, 2)))


# --------------------------------------------------------------------------------------
# Factors of edges. Along an edge that is drawn together in one point, S = O(u) and A = O(u**3);
# rounding there has both signs and would be cut without end. Where the first k rows of coefficients
# lie in the dead band, the polynomial is u**k times another, which has the same sign inside.

_EPS = 2.0**-53


@cache
def _quotients(degree: int) -> FloatArray:
    """Give the matrices that divide by u**k, for k = 0 ... degree: (degree + 1,) * 3.

    With p = u**k q:  q_i = p_(i + k) C(n, i + k) / C(n - k, i), then written with the degree n
    again, so that patches with and without such edges stay one batch.
    """
    found = np.zeros((degree + 1, degree + 1, degree + 1))
    for k in range(degree + 1):
        scale = binomials(degree)[k:] / binomials(degree - k)
        found[k, :, k:] = elevation(degree - k, k) * scale
    freeze(found)
    return found


def _leading(dead: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Count the leading true values of each row; none where all are true."""
    return np.asarray(np.argmin(dead, axis=1))


def divide_by_edge_lines(pair: FloatArray) -> FloatArray:
    """Divide by u**k, (1 - u)**k, v**k and (1 - v)**k where a polynomial is zero along an edge.

    `pair` (c, layers, M + 1, N + 1) holds coefficients and errors, of which the last says what is
    zero. A polynomial that is zero everywhere stays as it is.
    """
    for axis in (2, 3):
        for flipped in (False, True):
            pair = _divided(pair, axis, flipped)
    return pair


def _divided(pair: FloatArray, axis: int, flipped: bool) -> FloatArray:
    """Divide by the factor of one edge."""
    dead = signs(pair[:, 0], pair[:, -1]) == 0
    lines = dead.all(axis=2 if axis == 2 else 1)
    order = _leading(lines[:, ::-1] if flipped else lines)
    rows = np.flatnonzero(order)
    if not len(rows):
        return pair
    part = pair[rows] if axis == 2 else pair[rows].swapaxes(2, 3)
    if flipped:
        part = part[:, :, ::-1]
    part = part.copy()
    degree = part.shape[2] - 1
    # The rounding of the product, charged to the errors before it.
    part[:, 1:] += 16 * degree * _EPS * np.abs(part[:, :1])
    part = _quotients(degree)[order[rows], None] @ part
    if flipped:
        part = part[:, :, ::-1]
    found = pair.copy()
    found[rows] = part if axis == 2 else part.swapaxes(2, 3)
    return found


# --------------------------------------------------------------------------------------
# The search: a tree of cells, cut in four where nothing is proved (`cell_kinds`), a whole level of
# many patches at a time. What is left at the last level, or when a patch has used up its cells, is
# unresolved: all that the search does not know lies there, and is reported.

# Not in the middle: zero sets of shapes with symmetry lie on lines like u = 1/2, where each side of
# a cut would see coefficients of one sign only, and no arc. A cell in which a cut meets such a line
# all the same takes the other cut.
FIRST_CUT = (0.4871, 0.5137)
OTHER_CUT = (0.4583, 0.5391)
# From this level on, cells with no coefficient above so many errors are not cut: round a place
# where the polynomial is zero by much, thousands would tell where it begins to exceed its error.
_FINE, _FAINT = 8, 8.0
# Patches at a time, and numbers that are cut at a time: they shall stay in the cache.
_BATCH, _SLICE = 64, 1 << 18


def subdivide_patches(
    function: IsoFunction,
    depth: int = 16,
    budget: int = 6000,
    split: tuple[float, float] = FIRST_CUT,
    nil: FloatArray | None = None,
) -> SignCells:
    """Cover each patch with cells in which the sign is known, changes along one arc, or neither.

    Parameters
    ----------
    function : IsoFunction
        A polynomial a patch, on the unit square, with errors of its coefficients.
    depth : int
        How often a patch is cut at most; a cell is about 2**-depth of the patch.
    budget : int
        When more cells than this were looked at in a patch, none is cut any more.
    split : tuple of float
        Where u and v are cut first; later always in the middle.
    nil : (k, M + 1, N + 1), optional
        A polynomial whose coefficients are no larger than this counts as zero, in a cell and along
        an edge: what they are known to, which may be more than rounding. Elsewhere the polynomial
        is taken as it is, so that the arcs of neighbouring cells meet.

    Returns
    -------
    SignCells
        They tile each patch, and depend on the polynomial of that patch only, to the last bit.

    Raises
    ------
    BadInputError
        A coefficient is not finite.
    """
    _check(function)
    count = len(function.b)
    parts = []
    for first in range(0, max(count, 1), _BATCH):
        rows = slice(first, first + _BATCH)
        layers = [function.b[rows], function.err[rows]]
        layers += [] if nil is None else [np.maximum(nil[rows], function.err[rows])]
        pair = np.stack(layers, axis=1)
        parts.append(_batch(divide_by_edge_lines(pair), first, depth, budget, split))
    return _together(parts)


def _check(function: IsoFunction) -> None:
    """Refuse what would be taken for a polynomial that is zero."""
    finite = np.isfinite(function.b) & np.isfinite(function.err)
    if not finite.all():
        patch, i, j = np.argwhere(~finite)[0].tolist()
        raise BadInputError(
            f"coefficient {i}, {j} of the curvature polynomial is not a finite number",
            f"patch {patch}",
            "give a patch of finite control points, in m",
        )


@attrs.define(eq=False)
class _Part:
    """Cells of one level: what is proved of each, and the coefficients of those not pure.

    `pair` holds coefficients, errors and, where it was given, what is zero: (., 2 or 3, M + 1,
    N + 1).
    """

    patch: IntArray
    box: FloatArray
    kind: IntArray
    pair: FloatArray

    def at(self, rows: NDArray[np.bool_]) -> _Part:
        """Take some of the cells."""
        pair = self.pair[rows[self.kind > CellKind.POSITIVE]]
        return _Part(self.patch[rows], self.box[rows], self.kind[rows], pair)


def _judged(patch: IntArray, box: FloatArray, pair: FloatArray) -> _Part:
    """Tell what is proved of cells, and let go of the coefficients of pure ones."""
    # Edges on the border of the patch are shared with no other cell of it.
    kind = cell_kinds(pair[:, 0], pair[:, 1], box == [0.0, 1.0])
    if pair.shape[1] == 3:
        kind[(np.abs(pair[:, 0]) <= pair[:, 2]).all(axis=(1, 2))] = CellKind.ZERO
    return _Part(patch, box, kind, pair[kind > CellKind.POSITIVE])


def _joined(parts: list[_Part]) -> _Part:
    """Put parts behind one another."""
    return _Part(
        np.concatenate([part.patch for part in parts]),
        np.concatenate([part.box for part in parts]),
        np.concatenate([part.kind for part in parts]),
        np.concatenate([part.pair for part in parts]),
    )  # fmt: skip


def _cut(cells: _Part, u: float, v: float) -> _Part:
    """Cut each cell, none of which is pure, in four; elsewhere where a cut lies on the zero set."""
    parts = []
    size = 1 + _SLICE // (4 * cells.pair[0].size)
    for first in range(0, len(cells.patch), size):
        rows = slice(first, first + size)
        some = _Part(cells.patch[rows], cells.box[rows], cells.kind[rows], cells.pair[rows])
        grown = _grown(some.pair, u, v)
        vain = _on_zero_set(grown)
        if vain.any():
            again = some.at(vain)
            parts.append(_parted(again, _grown(again.pair, *OTHER_CUT), *OTHER_CUT))
            some, grown = some.at(~vain), grown[~vain]
        parts.append(_parted(some, grown, u, v))
    return _joined(parts)


def _parted(cells: _Part, grown: FloatArray, u: float, v: float) -> _Part:
    """Judge the four parts of each cell."""
    return _judged(np.repeat(cells.patch, 4), _quarters(cells.box, u, v), _quartered(grown))


def _batch(
    pair: FloatArray, first: int, depth: int, budget: int, split: tuple[float, float]
) -> SignCells:
    """Solve some patches, the first of which has this number."""
    count = len(pair)
    whole = np.broadcast_to([[0.0, 1.0], [0.0, 1.0]], (count, 2, 2))
    cells, found = _judged(np.arange(count), whole, pair), []
    seen = np.ones(count, np.intp)
    stopped = np.zeros(count, np.bool_)
    for level in range(depth + 1):
        stopped |= seen > budget
        more = (cells.kind == CellKind.UNRESOLVED) & ~stopped[cells.patch] & (level < depth)
        if level >= _FINE:
            more[np.flatnonzero(cells.kind > CellKind.POSITIVE)[_faint(cells.pair)]] = False
        found.append(cells.at(~more))
        if not more.any():
            break
        seen += 4 * np.bincount(cells.patch[more], minlength=count)
        cells = _cut(cells.at(more), *(split if level == 0 else (0.5, 0.5)))
    return _sorted(found, first, stopped)


def _faint(pair: FloatArray) -> NDArray[np.bool_]:
    """Tell where no coefficient stands out of its errors."""
    size = np.abs(pair).max(axis=(2, 3))
    return np.asarray(size[:, 0] <= _FAINT * size[:, 1])


@cache
def _both(degree: int, at: float) -> FloatArray:
    """Give the matrix to both parts, one above the other: (2 degree + 2, degree + 1)."""
    found = np.concatenate(restriction_matrices(degree, at))
    freeze(found)
    return found


def _grown(pair: FloatArray, u: float, v: float) -> FloatArray:
    """Cut coefficients at u and v: (c, layers, 2, M + 1, 2, N + 1).

    Errors are multiplied by the same matrices, whose entries are positive, and gain the rounding of
    the products. One product per cell: what a cell gets does not depend on how many there are.
    """
    count, layers, rows, columns = pair.shape
    pair = pair.copy()
    pair[:, 1:] += 16 * (rows + columns - 2) * _EPS * np.abs(pair[:, :1])
    found = _both(rows - 1, u) @ pair @ _both(columns - 1, v).T
    return found.reshape(count, layers, 2, rows, 2, columns)


def _on_zero_set(grown: FloatArray) -> NDArray[np.bool_]:
    """Tell where the polynomial is zero along a cut: each part would see one sign, and no arc."""
    dead = [np.abs(line[:, 0]) <= line[:, 1] for line in (grown[:, :, 0, -1], grown[..., 0, -1])]
    return np.asarray(dead[0].all(axis=(1, 2)) | dead[1].all(axis=(1, 2)))


def _quartered(grown: FloatArray) -> FloatArray:
    """Put the parts behind one another, in the order of `_quarters`."""
    count, layers, _, rows, _, columns = grown.shape
    parts = grown.transpose(0, 2, 4, 1, 3, 5)
    return np.ascontiguousarray(parts).reshape(4 * count, layers, rows, columns)


def _quarters(box: FloatArray, u: float, v: float) -> FloatArray:
    """Cut boxes: low-low, low-high, high-low, high-high."""
    low, high = box[:, :, 0], box[:, :, 1]
    middle = low + np.array([u, v]) * (high - low)
    lines = np.stack([low, middle, high], axis=2)
    found = np.empty((len(box), 2, 2, 2, 2))
    for i in range(2):
        found[:, i, :, 0] = lines[:, None, 0, i : i + 2]
        found[:, :, i, 1] = lines[:, None, 1, i : i + 2]
    return found.reshape(-1, 2, 2)


def _sorted(found: list[_Part], first: int, stopped: NDArray[np.bool_]) -> SignCells:
    """Put cells in the order of patch, level and box."""
    cells = _joined(found)
    level = np.repeat(np.arange(len(found)), [len(part.patch) for part in found])
    order = np.lexsort((cells.box[:, 1, 0], cells.box[:, 0, 0], level, cells.patch))
    kept = cells.kind > CellKind.POSITIVE
    rows = (np.cumsum(kept) - 1)[order[kept[order]]]
    kept = kept[order]
    return SignCells(
        cells.patch[order] + first, cells.box[order], level[order], cells.kind[order],
        np.where(kept, np.cumsum(kept) - 1, -1),
        cells.pair[rows, 0], cells.pair[rows, 1], stopped,
    )  # fmt: skip


def _together(parts: Iterable[SignCells]) -> SignCells:
    """Put batches of patches one behind the other."""
    parts = list(parts)
    if len(parts) == 1:
        return parts[0]
    before = np.cumsum([0, *(len(part.b) for part in parts[:-1])])
    rows = [np.where(part.row < 0, -1, part.row + n) for part, n in zip(parts, before, strict=True)]
    names = "patch", "box", "level", "kind", "b", "err", "stopped"
    joint = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
    return SignCells(row=np.concatenate(rows), **joint)


# --------------------------------------------------------------------------------------
# Patches solved again. A line that touches a cut without crossing it has a double root there: no
# cell along the cut can be proven to hold one arc, at any level. What is left undecided is a
# regular cluster, whose cells prove that the line is a graph; other cuts do away with it.

# Where patches are cut first instead, one try after the other.
_CUTS = ((0.4583, 0.5391), (0.5227, 0.4673))


def subdivide_again(
    function: IsoFunction,
    cells: SignCells,
    depth: int = 16,
    budget: int = 6000,
    nil: FloatArray | None = None,
) -> SignCells:
    """Solve patches again, with other cuts, that have undecided cells in which the line is a graph.

    Parameters
    ----------
    function : IsoFunction
        The polynomials.
    cells : SignCells
        What `subdivide_patches` has found for them.
    depth, budget, nil : int, int, (k, M + 1, N + 1)
        As for `subdivide_patches`.

    Returns
    -------
    SignCells
        The same for all other patches; the new ones where fewer such clusters are left. What is
        found for a patch depends on its polynomial only.
    """
    touched = _touched(cells)
    for cut in _CUTS:
        rows = np.flatnonzero(touched)
        if not len(rows):
            break
        part = IsoFunction(function.b[rows], function.err[rows])
        again = subdivide_patches(part, depth, budget, cut, None if nil is None else nil[rows])
        left = _touched(again)
        better = left < touched[rows]
        cells = _replaced(cells, again, rows, better)
        touched[rows[better]] = left[better]
    return cells


def _touched(cells: SignCells) -> IntArray:
    """Count the regular clusters of each patch that was searched to the end."""
    count = len(cells.stopped)
    found = find_clusters(cells, Lattice.apart(count))
    patch = np.zeros(len(found), np.intp)
    patch[found.cluster] = cells.patch[found.cell]
    counts = np.bincount(patch[found.regular], minlength=count)
    return np.where(cells.stopped, 0, counts)


def _replaced(cells: SignCells, again: SignCells, rows: IntArray, better: np.ndarray) -> SignCells:
    """Take the new cells of some patches."""
    chosen = np.arange(len(cells.stopped))
    chosen[rows[better]] = len(chosen) + np.flatnonzero(better)
    none = np.zeros(0, np.intp)
    arcs = ZeroSetArcs(none, none, np.zeros((0, 2)), np.zeros((0, 2, 2)), none > 0)
    return select_patches([cells, again], [arcs, arcs], chosen)[0]

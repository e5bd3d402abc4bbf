"""Cut patches into cells until the sign of a polynomial in each is known, or changes in one arc.

A tree of cells, cut in four where nothing is proved (`signs.kinds`), level by level, a whole
level of many patches at a time. What is left at the last level, or when a patch has used up its
cells, is *unresolved*: all that the search does not know lies there, and is told.

The first cut is not in the middle: zero sets of shapes with symmetry lie on lines like u = 1/2,
where each side of a cut would see coefficients of one sign only, and no arc. A cell in which a
cut meets such a line all the same is cut elsewhere.

A cut multiplies by matrices; the error of the result is that of the coefficients multiplied by
the same matrices (their entries are positive), and the rounding of the products.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.curvature_functions import IsoFunction
>>> from assoc_hull.geometry.patches.solve import solve
>>> u = np.array([[-1.0, -1.0], [2.0, 2.0]])  # 3 u - 1
>>> solve(IsoFunction(u[None], np.full((1, 2, 2), 1e-15))).kind.tolist()
[2]
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.algebra import split as split_matrices
from assoc_hull.geometry.patches.cells import CellKind, Cells
from assoc_hull.geometry.patches.curvature_functions import IsoFunction
from assoc_hull.geometry.patches.edge_factors import without_edge_lines
from assoc_hull.geometry.patches.signs import kinds

__all__ = ["FIRST_CUT", "OTHER_CUT", "solve"]

FIRST_CUT = (0.4871, 0.5137)
OTHER_CUT = (0.4583, 0.5391)
_EPS = 2.0**-53
# From this level on, cells with no coefficient above so many errors are not cut: round a place
# where the polynomial is nil by much, thousands would tell where it begins to exceed its error.
_FINE, _FAINT = 8, 8.0
# Patches at a time, and numbers that are cut at a time: they shall stay in the cache.
_BATCH, _SLICE = 64, 1 << 18


def solve(
    function: IsoFunction,
    depth: int = 16,
    budget: int = 6000,
    split: tuple[float, float] = FIRST_CUT,
    nil: FloatArray | None = None,
) -> Cells:
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
        A polynomial whose coefficients are no larger than this counts as nil, in a cell and along
        an edge: what they are known to, which may be more than rounding. Elsewhere the polynomial
        is taken as it is, so that the arcs of neighbouring cells meet.

    Returns
    -------
    Cells
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
        parts.append(_batch(without_edge_lines(pair), first, depth, budget, split))
    return _together(parts)


def _check(function: IsoFunction) -> None:
    """Refuse what would be taken for a polynomial that is nil."""
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

    `pair` holds coefficients, errors and, where it was given, what is nil: (., 2 or 3, M + 1,
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
    kind = kinds(pair[:, 0], pair[:, 1], box == [0.0, 1.0])
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
) -> Cells:
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
    found = np.concatenate(split_matrices(degree, at))
    freeze(found)
    return found


def _grown(pair: FloatArray, u: float, v: float) -> FloatArray:
    """Cut coefficients at u and v: (c, layers, 2, M + 1, 2, N + 1).

    One product per cell: what a cell gets does not depend on how many there are.
    """
    count, layers, rows, columns = pair.shape
    pair = pair.copy()
    pair[:, 1:] += 16 * (rows + columns - 2) * _EPS * np.abs(pair[:, :1])
    found = _both(rows - 1, u) @ pair @ _both(columns - 1, v).T
    return found.reshape(count, layers, 2, rows, 2, columns)


def _on_zero_set(grown: FloatArray) -> NDArray[np.bool_]:
    """Tell where the polynomial is nil along a cut: each part would see one sign, and no arc."""
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


def _sorted(found: list[_Part], first: int, stopped: NDArray[np.bool_]) -> Cells:
    """Put cells in the order of patch, level and box."""
    cells = _joined(found)
    level = np.repeat(np.arange(len(found)), [len(part.patch) for part in found])
    order = np.lexsort((cells.box[:, 1, 0], cells.box[:, 0, 0], level, cells.patch))
    kept = cells.kind > CellKind.POSITIVE
    rows = (np.cumsum(kept) - 1)[order[kept[order]]]
    kept = kept[order]
    return Cells(
        cells.patch[order] + first, cells.box[order], level[order], cells.kind[order],
        np.where(kept, np.cumsum(kept) - 1, -1),
        cells.pair[rows, 0], cells.pair[rows, 1], stopped,
    )  # fmt: skip


def _together(parts: Iterable[Cells]) -> Cells:
    """Put batches of patches one behind the other."""
    parts = list(parts)
    if len(parts) == 1:
        return parts[0]
    before = np.cumsum([0, *(len(part.b) for part in parts[:-1])])
    rows = [np.where(part.row < 0, -1, part.row + n) for part, n in zip(parts, before, strict=True)]
    names = "patch", "box", "level", "kind", "b", "err", "stopped"
    joint = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
    return Cells(row=np.concatenate(rows), **joint)

"""Tiles of one colour each that fill a patch, with the borders of curvature as their edges.

A cell of one sign gives a grid of tiles. In a cell with one arc u = g(v) every line v = constant
meets the arc at most once, so it is filled by strips on both sides of g: no tile lies across a
border, however coarse the tiles are.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.tensor_bernstein import basis
from assoc_hull.geometry.patches.cells import CellKind, Cells
from assoc_hull.geometry.patches.roots import crossing

__all__ = ["Tiles", "tiles_of"]

_LEAST = 8
"""Strips along an arc in the smallest of cells."""

_MOVES = 3
"""How often places on an arc are moved to lie equally far apart."""

_SLIVER = 1e-9
"""Of a cell: what is thinner is left out."""


@attrs.frozen(eq=False)
class Tiles:
    """Four-sided tiles that fill patches.

    Attributes
    ----------
    patch : (k,) int
        The patch of each.
    uv : (k, 4, 2)
        Corners in parameters of the patch, going round anticlockwise.
    sign : (k,) int
        1 where the polynomial is positive, -1 where it is negative, 0 where it is nil.
    """

    patch: IntArray
    uv: FloatArray
    sign: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.patch, self.uv, self.sign)

    def __len__(self) -> int:
        """Count the tiles."""
        return len(self.patch)


def tiles_of(cells: Cells, steps: int) -> Tiles:
    """Fill all cells whose sign is known, or changes along one arc; the unresolved stay free.

    Parameters
    ----------
    cells : Cells
        Of any patches.
    steps : int
        About so many tiles lie along a side of a patch.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.curvature_functions import gauss_function
    >>> from assoc_hull.geometry.patches.patches import Patches
    >>> from assoc_hull.geometry.patches.solve import solve
    >>> from assoc_hull.plot.plates.curvature_tiles import tiles_of
    >>> net = np.zeros((3, 3, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:3, 0:3]
    >>> net[1, 1, 2] = 1.0
    >>> tiles = tiles_of(solve(gauss_function(Patches.single(net), 0.0)), 8)
    >>> tiles.uv.shape[1:], sorted(set(tiles.sign.tolist()))
    ((4, 2), [-1, 1])
    """
    parts = [*_pure(cells, steps), *_simple(cells, steps)]
    if not parts:
        return Tiles(np.zeros(0, np.intp), np.zeros((0, 4, 2)), np.zeros(0, np.intp))
    patch, uv, sign = (np.concatenate(each) for each in zip(*parts, strict=True))
    return Tiles(patch, uv, sign)


_Part = tuple[IntArray, FloatArray, IntArray]


def _groups(cells: Cells, chosen: NDArray[np.bool_]) -> Iterator[tuple[int, IntArray]]:
    """Give cells level by level: those of one level get equally many tiles."""
    for level in np.unique(cells.level[chosen]).tolist():
        yield level, np.flatnonzero(chosen & (cells.level == level))


def _pure(cells: Cells, steps: int) -> Iterator[_Part]:
    for level, rows in _groups(cells, cells.kind <= 1):
        count = max(1, -(-steps // 2**level))
        side = np.linspace(0.0, 1.0, count + 1)
        grid = np.broadcast_arrays(side[:, None], side)
        local = np.broadcast_to(np.stack(grid, axis=-1), (len(rows), count + 1, count + 1, 2))
        sign = np.repeat(cells.kind[rows], count * count)
        yield np.repeat(cells.patch[rows], count * count), _placed(cells, rows, local), sign


def _simple(cells: Cells, steps: int) -> Iterator[_Part]:
    for kind, swapped in ((CellKind.U_SIMPLE, False), (CellKind.V_SIMPLE, True)):
        for level, rows in _groups(cells, cells.kind == kind):
            b = cells.b[cells.row[rows]]
            count = -(-steps // 2**level)
            yield from _strips(cells, rows, np.swapaxes(b, 1, 2) if swapped else b, count, swapped)


def _strips(
    cells: Cells, rows: IntArray, b: FloatArray, count: int, swapped: bool
) -> Iterator[_Part]:
    """Fill both sides of u = g(v), or swapped of v = g(u)."""
    rising = b[:, -1].sum(axis=-1) > b[:, 0].sum(axis=-1)
    across = np.linspace(0.0, 1.0, count + 1)[None, :, None]
    t, g = _arc(np.where(rising[:, None, None], b, -b), max(_LEAST, count))
    for low, high, side in ((np.zeros_like(g), g, -1), (g, np.ones_like(g), 1)):
        u = low[:, None] + across * (high - low)[:, None]
        local = np.stack(np.broadcast_arrays(u, t[:, None]), axis=-1)
        # Exchanged parameters turn the corners round; all are to go the same way.
        uv = (
            _placed(cells, rows, local[..., ::-1])[:, ::-1]
            if swapped
            else _placed(cells, rows, local)
        )
        each = count * (t.shape[1] - 1)
        sign = np.repeat(np.where(rising, side, -side), each)
        patch = np.repeat(cells.patch[rows], each)
        width = np.repeat((high - low)[:, None], count, axis=1)
        wide = ((width[..., 1:] + width[..., :-1]) > _SLIVER).ravel() & _long(t, count)
        yield patch[wide], uv[wide], sign[wide]


def _long(t: FloatArray, count: int) -> NDArray[np.bool_]:
    """Tell the tiles of strips that are not of no length."""
    return np.repeat((np.diff(t) > _SLIVER)[:, None], count, axis=1).ravel()


def _arc(b: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
    """Give v from 0 to 1 and g there, (c, count + 3), of polynomials that rise with u.

    Where the arc leaves the cell through u = 0 or 1 stands a place of its own; the others are
    moved so that they lie equally far apart along the arc, which may run along v = constant.
    """
    ends = np.stack([_leaving(b[:, 0]), _leaving(b[:, -1])], axis=-1)
    even = np.broadcast_to(np.linspace(0.0, 1.0, count + 1), (len(b), count + 1))
    t = np.sort(np.concatenate([even, ends], axis=1), axis=1)
    for _ in range(_MOVES):
        t = np.sort(np.concatenate([_apart(t, _heights(b, t), even), ends], axis=1), axis=1)
    return t, _heights(b, t)


def _apart(t: FloatArray, g: FloatArray, even: FloatArray) -> FloatArray:
    """Give places at these shares of the lengths of polylines (t, g), row by row."""
    steps = np.hypot(np.diff(t, axis=1), np.diff(g, axis=1))
    way = np.concatenate([np.zeros((len(t), 1)), np.cumsum(steps, axis=1)], axis=1)
    start = 4.0 * np.arange(len(t))[:, None]  # rows one behind the other: none is longer
    wanted = start + even * way[:, -1:]
    found = np.interp(wanted.ravel(), (start + way).ravel(), t.ravel())
    return np.asarray(found.reshape(even.shape))


def _heights(b: FloatArray, t: FloatArray) -> FloatArray:
    """Give g at places (c, k): 0 where a polynomial is positive all along, 1 where negative."""
    lines = _along(b, t)
    g = np.where(lines[..., 0] >= 0.0, 0.0, 1.0)
    inner = (lines[..., 0] < 0.0) & (lines[..., -1] > 0.0)
    if inner.any():
        g[inner] = crossing(lines[inner], np.ones(int(inner.sum()), np.bool_))
    return g


def _leaving(edge: FloatArray) -> FloatArray:
    """Give where polynomials (c, n + 1) on an edge change sign; 0 for those that do not."""
    found = np.zeros(len(edge))
    cut = edge[:, 0] * edge[:, -1] < 0.0
    if cut.any():
        found[cut] = crossing(edge[cut], edge[cut, -1] > 0.0)
    return found


def _along(b: FloatArray, t: FloatArray) -> FloatArray:
    """Restrict polynomials (c, m + 1, n + 1) to lines v = t, (c, k): (c, k, m + 1)."""
    values = basis(b.shape[-1] - 1, t.ravel()).reshape(*t.shape, -1)
    return np.asarray(values @ np.swapaxes(b, 1, 2))


def _placed(cells: Cells, rows: IntArray, local: FloatArray) -> FloatArray:
    """Give the tiles (k, 4, 2) between places (c, p, q, 2) of cells, in parameters of the patch."""
    box = cells.box[rows][:, None, None]
    uv = box[..., 0] + (box[..., 1] - box[..., 0]) * local
    corners = uv[:, :-1, :-1], uv[:, 1:, :-1], uv[:, 1:, 1:], uv[:, :-1, 1:]
    return np.stack(corners, axis=3).reshape(-1, 4, 2)

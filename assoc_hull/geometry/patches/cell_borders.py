"""The borders of regions that run along cells: along a patch's border, or around undecided cells.

The border of each cell is walked with the cell on the left. Where it is cut by the arc in it, one
part belongs to the positive side and the other to the negative. Pieces that two cells of one region
walk in opposite directions cancel; what is left over bounds the region.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.cell_borders import cancel_opposite_walks
>>> one = np.array([[0.0, 0.0], [1.0, 0.0]])
>>> other = np.array([[2.0, 0.0], [0.5, 0.0]])
>>> cancel_opposite_walks(np.array([one, other])).tolist()
[[[0.0, 0.0], [0.5, 0.0]], [[2.0, 0.0], [1.0, 0.0]]]
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.adjacency import Lattice
from assoc_hull.geometry.patches.cells import CellKind, SignCells

__all__ = [
    "SHORT",
    "cancel_opposite_walks",
    "cells_of_both_signs",
    "cells_without_arc",
    "region_borders",
    "shared_borders",
]

# The corners of a cell in the order of the walk: which end of the box in u and in v.
_WALK = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
SHORT = 3e-8
"""In parameters of a patch: what is shorter is a point."""


def region_borders(
    cells: SignCells, lattice: Lattice, kind: CellKind, arc_of: IntArray, ends: FloatArray
) -> FloatArray:
    """Give the pieces of the borders of cells that belong to a region.

    Parameters
    ----------
    cells, lattice : SignCells, Lattice
        The cells, and where their patches lie.
    kind : CellKind
        The region: positive, negative, zero or unresolved.
    arc_of : (c,) int
        The arc in each cell, or -1.
    ends : (a, 2, 2)
        Where arcs begin and end, in the lattice, walked with the positive side on the left.

    Returns
    -------
    (p, 2, 2)
        Where pieces begin and end, in the lattice, walked with the region on the left.
    """
    corner = lattice.corner[cells.patch][:, None, None, :]
    whole = _whole(cells, kind, arc_of)
    box = np.moveaxis(cells.box[:, [0, 1], :], 1, 2)  # (c, low or high, axis)
    corners = np.stack([box[:, _WALK[:, axis], axis] for axis in range(2)], axis=-1)
    corners = corners + corner[:, 0]
    full = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2)[whole].reshape(-1, 2, 2)
    if kind not in (CellKind.POSITIVE, CellKind.NEGATIVE):
        return full
    cut = np.flatnonzero(arc_of >= 0)
    arc = ends[arc_of[cut]] if kind is CellKind.POSITIVE else ends[arc_of[cut], ::-1]
    return np.concatenate([full, _cut(corners[cut], arc)])


def cells_without_arc(cells: SignCells, arc_of: IntArray) -> IntArray:
    """Give the simple cells without an arc."""
    simple = (cells.kind == CellKind.U_SIMPLE) | (cells.kind == CellKind.V_SIMPLE)
    return np.flatnonzero(simple & (arc_of < 0))


def _whole(cells: SignCells, kind: CellKind, arc_of: IntArray) -> NDArray[np.bool_]:
    """Tell which cells belong to a region as a whole."""
    found = cells.kind == kind
    if kind in (CellKind.POSITIVE, CellKind.NEGATIVE):
        rows = cells_without_arc(cells, arc_of)
        found[rows] = _sign(cells, rows) == kind
    return np.asarray(found)


def _corner_values(cells: SignCells, rows: IntArray) -> tuple[FloatArray, FloatArray]:
    """Give polynomials and their errors at the corners of cells, (n, 4)."""
    b, err = cells.b[cells.row[rows]], cells.err[cells.row[rows]]
    corners = [np.s_[:, i, j] for i in (0, -1) for j in (0, -1)]
    return np.stack([b[at] for at in corners], axis=1), np.stack(
        [err[at] for at in corners], axis=1
    )


def _sign(cells: SignCells, rows: IntArray) -> IntArray:
    """Tell the sign in simple cells that no arc crosses: that of the surest corner."""
    values, err = _corner_values(cells, rows)
    sure = (np.abs(values) - err).argmax(axis=1)
    return np.asarray(np.sign(values[np.arange(len(rows)), sure]), np.intp)


def cells_of_both_signs(cells: SignCells, rows: IntArray) -> NDArray[np.bool_]:
    """Tell which simple cells have corners of both signs for certain, so that an arc is there."""
    values, err = _corner_values(cells, rows)
    return np.asarray((values > err).any(axis=1) & (values < -err).any(axis=1))


def _cut(corners: FloatArray, arc: FloatArray) -> FloatArray:
    """Give the pieces of cells' borders on the left of an arc: from its end to its beginning.

    A piece runs over up to five sides of a cell; sides that it does not reach have no length.
    """
    stop, start = (_position(corners, arc[:, i]) for i in (0, 1))
    length = np.where(stop < start, stop - start + 4.0, stop - start)
    side = np.floor(start)[:, None] + np.arange(6)
    low = np.clip(side, start[:, None], (start + length)[:, None])
    high = np.clip(side + 1.0, start[:, None], (start + length)[:, None])
    which = side.astype(np.intp) % 4
    begin = np.take_along_axis(corners, which[..., None], axis=1)
    after = np.take_along_axis(corners, ((which + 1) % 4)[..., None], axis=1)
    first = np.where((low > side)[..., None], arc[:, None, 1], begin)
    last = np.where((high < side + 1.0)[..., None], arc[:, None, 0], after)
    first, last = (_kept_on(point, begin, after) for point in (first, last))
    return np.asarray(np.stack([first, last], axis=2)[high > low])


def _position(corners: FloatArray, point: FloatArray) -> FloatArray:
    """Tell where on the border of its cell each point lies: the side, and how far along it."""
    after = np.roll(corners, -1, axis=1)
    along = after - corners
    axis = np.abs(along).argmax(axis=2)
    to = point[:, None, :] - corners
    off = np.abs(np.take_along_axis(to, (1 - axis)[..., None], axis=2)[..., 0])
    part = np.take_along_axis(to, axis[..., None], axis=2)[..., 0]
    part = np.clip(part / np.take_along_axis(along, axis[..., None], axis=2)[..., 0], 0.0, 1.0)
    side = off.argmin(axis=1)
    return np.asarray((side + part[np.arange(len(side)), side]) % 4.0)


def _kept_on(point: FloatArray, begin: FloatArray, after: FloatArray) -> FloatArray:
    """Put points on their sides, to the last bit."""
    return np.clip(point, np.minimum(begin, after), np.maximum(begin, after))


def cancel_opposite_walks(pieces: FloatArray) -> FloatArray:
    """Cancel what is walked in both directions.

    Parameters
    ----------
    pieces : (p, 2, 2)
        Where pieces begin and end, each along u or along v.

    Returns
    -------
    (q, 2, 2)
        What is left, each as long as it goes.
    """
    spans, depth = _spans(pieces, np.zeros(len(pieces), np.intp), 1)
    return _walked(spans, depth[0])


def shared_borders(pieces: FloatArray, others: FloatArray) -> FloatArray:
    """Give where two regions share a border that both are left with.

    Parameters
    ----------
    pieces, others : (p, 2, 2), (q, 2, 2)
        Borders of both, each along u or along v, walked with the region on the left.

    Returns
    -------
    (r, 2, 2)
        Walked with the first region on the left.
    """
    of = np.repeat([0, 1], [len(pieces), len(others)])
    spans, depth = _spans(np.concatenate([pieces, others]), of, 2)
    return _walked(spans, np.where(depth[0] == -depth[1], depth[0], 0))


def _spans(pieces: FloatArray, of: IntArray, sets: int) -> tuple[FloatArray, IntArray]:
    """Cut lines wherever a piece begins or ends.

    Returns the ends (s, 2, 2) of spans in rising order, and (sets, s) how often pieces of each set
    run along them, those that run backward counted negative.
    """
    rows, axis = np.arange(len(pieces)), np.abs(pieces[:, 1] - pieces[:, 0]).argmax(axis=1)
    ends = pieces[rows, :, axis]
    across = pieces[rows, 0, 1 - axis]
    columns = np.stack([ends.T.reshape(-1), np.tile(across, 2), np.tile(axis, 2)])
    order = np.lexsort(columns)
    columns = columns[:, order]
    step = np.repeat([1, -1], len(pieces))[order]
    new = np.ones(len(order), bool)
    new[1:] = (columns[:, 1:] != columns[:, :-1]).any(axis=0)
    event = np.cumsum(new) - 1
    change = np.zeros((sets, int(event.max(initial=-1)) + 1), np.intp)
    np.add.at(change, (np.tile(of, 2)[order], event), step)
    kept = (change != 0).any(axis=0)
    at, across, along = columns[:, new][:, kept]
    depth = np.cumsum(change[:, kept], axis=1)[:, :-1]
    spans = np.stack([at[:-1], at[1:]], axis=1)
    found = np.where(
        (along == 0)[:-1, None, None], _points(spans, across, 0), _points(spans, across, 1)
    )
    # Behind the last event of a line nothing runs along it, and its end is that of another line.
    return found, depth


def _points(spans: FloatArray, across: FloatArray, axis: int) -> FloatArray:
    """Give the ends (s, 2, 2) of spans along an axis."""
    other = np.broadcast_to(across[:-1, None], spans.shape)
    return np.stack([spans, other] if axis == 0 else [other, spans], axis=2)


def _walked(spans: FloatArray, depth: IntArray) -> FloatArray:
    """Give the spans that are walked, each in its direction, but for very short ones."""
    kept = (depth != 0) & (np.abs(spans[:, 1] - spans[:, 0]).max(axis=1) > SHORT)
    return np.asarray(np.where((depth > 0)[:, None, None], spans, spans[:, ::-1])[kept])

"""The arc of the zero set in each simple cell: where it starts and ends.

In a u-simple cell the polynomial f rises, or falls, along all lines v = constant. Say it rises:
then the arc u = g(v) runs where f < 0 on the edge of the smaller u and f > 0 on the other. Each of
these edges changes sign at most once, so both conditions hold in intervals from one end of the
edge, and together in one interval or none. Its ends lie on the edge that changes sign there, or
else on a border v = constant of the cell.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.arcs import arcs_of
>>> from assoc_hull.geometry.patches.curvature_functions import IsoFunction
>>> from assoc_hull.geometry.patches.solve import solve
>>> b = np.array([[[-1.0, -2.0], [3.0, 2.0]]])
>>> arcs_of(solve(IsoFunction(b, 1e-15 + 0.0 * b))).ends[0]
array([[0.25, 0.  ],
       [0.5 , 1.  ]])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.cells import Arcs, CellKind, Cells
from assoc_hull.geometry.patches.heights import polynomials_over
from assoc_hull.geometry.patches.roots import crossing
from assoc_hull.geometry.patches.signs import first_and_last, signs

__all__ = ["arcs_of", "placed"]

# An arc with its ends nearer than this cuts a corner of its cell by rounding, and is none.
_LEAST, _LEAST_SHARE = 2e-12, 1e-6


def arcs_of(cells: Cells) -> Arcs:
    """Find the arcs in simple cells.

    Parameters
    ----------
    cells : Cells
        The cells.

    Returns
    -------
    Arcs
        In the order of their cells; each cell has one at most.
    """
    kinds = enumerate((CellKind.U_SIMPLE, CellKind.V_SIMPLE))
    parts = [_arcs(cells, np.flatnonzero(cells.kind == kind), across) for across, kind in kinds]
    order = np.argsort(np.concatenate([part.cell for part in parts]), kind="stable")
    names = "cell", "across", "span", "ends", "rising"
    return Arcs(*(np.concatenate([getattr(part, name) for part in parts])[order] for name in names))


def placed(box: FloatArray, t: FloatArray) -> FloatArray:
    """Give parameters of the patch at t between 0 and 1 of boxes (..., 2); borders to the bit."""
    low, high = box[..., 0], box[..., 1]
    return np.where(t == 1.0, high, low + t * (high - low))


@attrs.frozen(eq=False)
class _Edge:
    """Where a condition holds along an edge: between `low` and `high`, which are 0, 1 or a root."""

    low: FloatArray
    high: FloatArray


def _edge(b: FloatArray, err: FloatArray, negative: bool) -> _Edge:
    """Tell where edge polynomials (c, d + 1) are negative, or positive; nowhere: from 1 to 0."""
    first, last = first_and_last(signs(b, err))
    if not negative:
        first, last, b = -first, -last, -b
    turning = first * last < 0
    root = np.ones(len(b))
    root[turning] = crossing(b[turning], first[turning] < 0)
    low = np.where(first < 0, 0.0, np.where(turning, root, 1.0))
    high = np.where(last < 0, 1.0, np.where(turning, root, 0.0))
    return _Edge(low, high)


def _arcs(cells: Cells, rows: NDArray[np.intp], across: int) -> Arcs:
    """Find the arcs of cells of one kind."""
    b = polynomials_over(cells, rows, across)
    err = cells.err[cells.row[rows]]
    err = err.swapaxes(1, 2) if across else err
    rising = b[:, -1, 0] > b[:, 0, 0]
    low, high = np.where(rising, 0, -1), np.where(rising, -1, 0)
    each = np.arange(len(rows))
    lower = _edge(b[each, low], err[each, low], True)
    upper = _edge(b[each, high], err[each, high], False)
    start, end = np.maximum(lower.low, upper.low), np.minimum(lower.high, upper.high)
    there = np.flatnonzero(start < end)
    bottom = np.where(rising, 0.0, 1.0)
    first = _height(b, rising, bottom, start, lower.low, 0)
    last = _height(b, rising, bottom, end, lower.high, -1)
    found = _placed_arcs(
        cells, rows[there], across,
        np.stack([start, end], axis=1)[there], np.stack([first, last], axis=1)[there],
    )  # fmt: skip
    kept, ends, span = found
    return Arcs(
        rows[there][kept], np.full(np.count_nonzero(kept), across), span, ends, rising[there][kept]
    )


def _height(
    b: FloatArray, rising: NDArray[np.bool_], bottom: FloatArray, t: FloatArray,
    owner: FloatArray, border: int,
) -> FloatArray:  # fmt: skip
    """Give the heights of ends: on the edge that changes sign there, or on a border."""
    on_border = t == (0.0 if border == 0 else 1.0)
    found = np.where(owner == t, bottom, 1.0 - bottom)
    found[on_border] = crossing(b[on_border][:, :, border], rising[on_border])
    return found


def _placed_arcs(
    cells: Cells, rows: IntArray, across: int, t: FloatArray, height: FloatArray
) -> tuple[NDArray[np.bool_], FloatArray, FloatArray]:
    """Put ends into the parameters of the patch; tell which arcs are long enough."""
    box = cells.box[rows]
    span = placed(box[:, None, 1 - across], t)
    other = placed(box[:, None, across], height)
    ends = np.stack([span, other] if across else [other, span], axis=2)
    length = np.abs(ends[:, 1] - ends[:, 0]).max(axis=1)
    size = (box[:, :, 1] - box[:, :, 0]).min(axis=1)
    kept = length > np.minimum(_LEAST, _LEAST_SHARE * size)
    return kept, ends[kept], span[kept]

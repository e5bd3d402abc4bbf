"""Arcs of the zero set: where they start and end, how they run, and polylines along them.

In a simple cell every line across meets the zero set at most once, so an arc is a height function.
`arcs_of` finds the ends, `arc_heights` the height at a running parameter.
`sample_arcs` gives as many points as a chord tolerance in space wants, each of them a root.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.bernstein_polynomials import (
    binomials,
    power_table,
    sign_change_roots,
)
from assoc_hull.geometry.patches.bezier_patches import Patches, patch_points
from assoc_hull.geometry.patches.cell_subdivision import first_and_last, signs
from assoc_hull.geometry.patches.cells import CellKind, SignCells, ZeroSetArcs

__all__ = [
    "arc_heights",
    "arcs_of",
    "bernstein_table",
    "patch_parameters",
    "polynomials_over",
    "sample_arcs",
]


def polynomials_over(cells: SignCells, rows: NDArray[np.intp], across: int) -> FloatArray:
    """Give the polynomials (c, A + 1, T + 1) of simple cells (c,), the running parameter last.

    All are u-simple (`across` 0) or v-simple (1: u runs, the parameters are exchanged).
    """
    b = cells.b[cells.row[rows]]
    return np.ascontiguousarray(b.swapaxes(1, 2)) if across else b


def bernstein_table(t: FloatArray, degree: int) -> FloatArray:
    """Give the Bernstein polynomials of a degree at places t (r,): (degree + 1, r)."""
    if degree == 0:
        return np.ones((1, len(t)))
    table = power_table(t, degree + 1) * power_table(1.0 - t, degree + 1)[::-1]
    return np.asarray(table * binomials(degree)[:, None])


def arc_heights(
    b: FloatArray, rising: NDArray[np.bool_], t: FloatArray, start: FloatArray | None = None
) -> FloatArray:
    """Find the heights of arcs: where sum over j of b[:, j] B_j(t) has its one change of sign.

    For polynomials b (c, A + 1, T + 1) as `polynomials_over` gives them, at running parameters t
    (c, q) in [0, 1] from the start to the end of the cell; heights (c, q) likewise. `rising` (c,)
    says whether they rise with the height; `start` (c, q) are heights known roughly.
    """
    count, places = t.shape
    table = bernstein_table(t.reshape(-1), b.shape[2] - 1)
    lines = b @ np.ascontiguousarray(table.reshape(-1, count, places).swapaxes(0, 1))
    rows = lines.swapaxes(1, 2).reshape(count * places, -1)
    rough = None if start is None else start.reshape(-1)
    return sign_change_roots(rows, np.repeat(rising, places), rough).reshape(count, places)


# --------------------------------------------------------------------------------------
# Ends of arcs. Say the polynomial f of a u-simple cell rises along all lines v = constant: the arc
# u = g(v) runs where f < 0 on the edge of the smaller u and f > 0 on the other. Each of these edges
# changes sign at most once, so both hold together in one interval of v or none; its ends lie on the
# edge that changes sign there, or on a border v = constant of the cell.

# An arc with its ends nearer than this cuts a corner of its cell by rounding, and is none.
_LEAST, _LEAST_SHARE = 2e-12, 1e-6


def arcs_of(cells: SignCells) -> ZeroSetArcs:
    """Find the arcs in simple cells, at most one in each, in the order of their cells."""
    kinds = enumerate((CellKind.U_SIMPLE, CellKind.V_SIMPLE))
    parts = [_arcs(cells, np.flatnonzero(cells.kind == kind), across) for across, kind in kinds]
    order = np.argsort(np.concatenate([part.cell for part in parts]), kind="stable")
    names = "cell", "across", "span", "ends", "rising"
    return ZeroSetArcs(
        *(np.concatenate([getattr(part, name) for part in parts])[order] for name in names)
    )


def patch_parameters(box: FloatArray, t: FloatArray) -> FloatArray:
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
    root[turning] = sign_change_roots(b[turning], first[turning] < 0)
    low = np.where(first < 0, 0.0, np.where(turning, root, 1.0))
    high = np.where(last < 0, 1.0, np.where(turning, root, 0.0))
    return _Edge(low, high)


def _arcs(cells: SignCells, rows: NDArray[np.intp], across: int) -> ZeroSetArcs:
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
    return ZeroSetArcs(
        rows[there][kept], np.full(np.count_nonzero(kept), across), span, ends, rising[there][kept]
    )


def _height(
    b: FloatArray, rising: NDArray[np.bool_], bottom: FloatArray, t: FloatArray,
    owner: FloatArray, border: int,
) -> FloatArray:  # fmt: skip
    """Give the heights of ends: on the edge that changes sign there, or on a border."""
    on_border = t == (0.0 if border == 0 else 1.0)
    found = np.where(owner == t, bottom, 1.0 - bottom)
    found[on_border] = sign_change_roots(b[on_border][:, :, border], rising[on_border])
    return found


def _placed_arcs(
    cells: SignCells, rows: IntArray, across: int, t: FloatArray, height: FloatArray
) -> tuple[NDArray[np.bool_], FloatArray, FloatArray]:
    """Put ends into the parameters of the patch; tell which arcs are long enough."""
    box = cells.box[rows]
    span = patch_parameters(box[:, None, 1 - across], t)
    other = patch_parameters(box[:, None, across], height)
    ends = np.stack([span, other] if across else [other, span], axis=2)
    length = np.abs(ends[:, 1] - ends[:, 0]).max(axis=1)
    size = (box[:, :, 1] - box[:, :, 0]).min(axis=1)
    kept = length > np.minimum(_LEAST, _LEAST_SHARE * size)
    return kept, ends[kept], span[kept]


# --------------------------------------------------------------------------------------
# Polylines: a chord is halved, at the middle of the running parameter, until the point found there
# lies within the tolerance of it. What an arc gets does not depend on the other arcs.

# A chord is halved so often in any case, for an arc may meet its chord in the middle; and at most.
_LEAST_HALVINGS, _MOST_HALVINGS = 2, 14
# Chords at a time, so that their polynomials stay in the cache.
_BLOCK = 1024


@attrs.frozen(eq=False)
class _Chords:
    """Chords of arcs: the arc, local running parameters (c, 2), parameters (c, 2, 2), points."""

    arc: IntArray
    t: FloatArray
    uv: FloatArray
    xyz: FloatArray

    def at(self, rows: NDArray[np.bool_]) -> _Chords:
        """Take some of the chords."""
        return _Chords(self.arc[rows], self.t[rows], self.uv[rows], self.xyz[rows])

    def halved(self, t: FloatArray, uv: FloatArray, xyz: FloatArray) -> _Chords:
        """Put a point into each."""
        return _Chords(
            np.repeat(self.arc, 2), _between(self.t, t), _between(self.uv, uv),
            _between(self.xyz, xyz),
        )  # fmt: skip


def sample_arcs(
    patches: Patches, cells: SignCells, arcs: ZeroSetArcs, chord_tol: float
) -> tuple[IntArray, FloatArray]:
    """Give points of arcs, whose chords stray from them by no more than `chord_tol`, m.

    Where the points of each arc begin, (a + 1,), and parameters of the patch, (p, 2), from the
    start of an arc to its end, both included.
    """
    chords = _whole(patches, cells, arcs)
    arc, t, uv = [np.repeat(chords.arc, 2)], [chords.t.reshape(-1)], [chords.uv.reshape(-1, 2)]
    for turn in range(_MOST_HALVINGS):
        if not len(chords.arc):
            break
        middle = 0.5 * (chords.t[:, 0] + chords.t[:, 1])
        rough = 0.5 * (chords.uv[:, 0] + chords.uv[:, 1])
        place = _places(cells, arcs, chords.arc, middle, rough)
        xyz = patch_points(patches, cells.patch[arcs.cell[chords.arc]], place)
        stray, length = _strays(chords.xyz, xyz)
        open_ = (stray > chord_tol) | ((turn < _LEAST_HALVINGS) & (length > chord_tol))
        chords, middle, place, xyz = chords.at(open_), middle[open_], place[open_], xyz[open_]
        arc.append(chords.arc)
        t.append(middle)
        uv.append(place)
        chords = chords.halved(middle, place, xyz)
    return _in_order(np.concatenate(arc), np.concatenate(t), np.concatenate(uv), len(arcs))


def _whole(patches: Patches, cells: SignCells, arcs: ZeroSetArcs) -> _Chords:
    """Give the chords from end to end."""
    number = np.arange(len(arcs))
    box = cells.box[arcs.cell, 1 - arcs.across]
    t = (arcs.span - box[:, :1]) / (box[:, 1:] - box[:, :1])
    patch = np.repeat(cells.patch[arcs.cell], 2)
    xyz = patch_points(patches, patch, arcs.ends.reshape(-1, 2)).reshape(-1, 2, 3)
    return _Chords(number, t, arcs.ends, xyz)


def _places(
    cells: SignCells, arcs: ZeroSetArcs, arc: IntArray, t: FloatArray, rough: FloatArray
) -> FloatArray:
    """Find the points (c, 2) of some arcs at local running parameters (c,), near rough ones."""
    found = np.empty((len(arc), 2))
    for across in (0, 1):
        rows = np.flatnonzero(arcs.across[arc] == across)
        for first in range(0, len(rows), _BLOCK):
            some = rows[first : first + _BLOCK]
            found[some] = _places_over(cells, arcs, arc[some], t[some], rough[some], across)
    return found


def _places_over(
    cells: SignCells,
    arcs: ZeroSetArcs,
    arc: IntArray,
    t: FloatArray,
    rough: FloatArray,
    across: int,
) -> FloatArray:
    """Find points of arcs that run the same way."""
    cell = arcs.cell[arc]
    b, (low, high) = polynomials_over(cells, cell, across), cells.box[cell, across].T
    start = (rough[:, across] - low) / (high - low)
    height = arc_heights(b, arcs.rising[arc], t[:, None], start[:, None])[:, 0]
    found = np.empty((len(arc), 2))
    found[:, 1 - across] = patch_parameters(cells.box[cell, 1 - across], t)
    found[:, across] = patch_parameters(cells.box[cell, across], height)
    return found


def _between(pair: FloatArray, middle: FloatArray) -> FloatArray:
    """Give (2 c, 2, ...): from the first of each pair to the middle, from there to the second."""
    found = np.stack([pair[:, 0], middle, middle, pair[:, 1]], axis=1)
    return found.reshape(2 * len(pair), *pair.shape[1:])


def _strays(chord: FloatArray, xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give how far points lie from their chords (c, 2, 3), and how long these are, m."""
    along, away = chord[:, 1] - chord[:, 0], xyz - chord[:, 0]
    square = (along * along).sum(axis=1)
    share = np.clip((along * away).sum(axis=1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    rest = away - share[:, None] * along
    return np.asarray(np.sqrt((rest * rest).sum(axis=1))), np.asarray(np.sqrt(square))


def _in_order(
    arc: IntArray, t: FloatArray, uv: FloatArray, count: int
) -> tuple[IntArray, FloatArray]:
    """Put points behind one another, arc by arc."""
    order = np.lexsort((t, arc))
    start = np.concatenate([[0], np.cumsum(np.bincount(arc, minlength=count))])
    return start, uv[order]

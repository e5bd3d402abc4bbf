"""Cells of patches: their signs, their neighbours and the borders of what they make up.

`SignCells` cover all patches of a batch, `ZeroSetArcs` are the arcs within them.
`select_patches` takes the cells and arcs of some patches out of one batch or of several.

Which patches lie beside one another on their surfaces, and which boxes of many touch.

The lattice counts in whole numbers, so places on a shared border are equal and not only near.
Boxes are found by trees of their centres, one tree for boxes of about one size.

The borders of regions that run along cells: along a patch's border, or around undecided cells.

The border of each cell is walked with the cell on the left. Where it is cut by the arc in it, one
part belongs to the positive side and the other to the negative. Pieces that two cells of one region
walk in opposite directions cancel; what is left over bounds the region.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.cells import rows_of_groups
>>> rows_of_groups(np.array([2, 0, 3]), np.array([2, 0]))
(array([2, 3, 4, 0, 1]), array([0, 0, 0, 1, 1]))
>>> from assoc_hull.geometry.patches.cells import cancel_opposite_walks
>>> one = np.array([[0.0, 0.0], [1.0, 0.0]])
>>> other = np.array([[2.0, 0.0], [0.5, 0.0]])
>>> cancel_opposite_walks(np.array([one, other])).tolist()
[[[0.0, 0.0], [0.5, 0.0]], [[2.0, 0.0], [1.0, 0.0]]]
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from itertools import combinations
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "SHORT",
    "SIDES",
    "CellKind",
    "Lattice",
    "SignCells",
    "ZeroSetArcs",
    "box_clusters",
    "cancel_opposite_walks",
    "cells_of_both_signs",
    "cells_without_arc",
    "connected_labels",
    "region_borders",
    "rows_of_groups",
    "select_patches",
    "shared_borders",
    "touching_pairs",
]

# Each patch becomes a unit square of one plane: the patches of a surface side by side, as they are
# on it, surfaces apart. Points on a shared border have one place there, whichever patch they were
# found on; distances are in parameters of a patch, so that one tolerance serves all.

# The sides of a patch: which parameter is constant there, and its value.
SIDES = ((0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0))

_CORNERS = np.array([[0, 0], [0, 1], [1, 0], [1, 1]])
_STEPS = np.array([[-1, 0], [1, 0], [0, -1], [0, 1]])


@attrs.frozen(eq=False)
class Lattice:
    """Places of patches in whole numbers.

    Attributes
    ----------
    corner : (k, 2) int
        Where the corner u = v = 0 of each patch lies.
    neighbours : (k, 4) bool
        Whether another patch lies across each side: u = 0, u = 1, v = 0, v = 1.
    """

    corner: IntArray
    neighbours: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.corner, self.neighbours)

    @classmethod
    def of(cls, surface: IntArray, box: FloatArray) -> Self:
        """Lay out patches by their surfaces (k,) and their boxes (k, 2, 2) on these."""
        corner = np.stack([_positions(surface, box[:, axis]) for axis in range(2)], axis=1)
        return cls(corner, _beside(corner))

    @classmethod
    def apart(cls, count: int) -> Self:
        """Lay out patches that have nothing to do with one another."""
        corner = np.repeat(3 * np.arange(count)[:, None], 2, axis=1)
        return cls(corner, np.zeros((count, 4), bool))

    def place(self, patch: IntArray, uv: FloatArray) -> FloatArray:
        """Give the places (n, 2) of points, by their patches (n,) and parameters (n, 2) there."""
        return np.asarray(self.corner[patch] + uv)

    def squares(self) -> FloatArray:
        """Give the sides (k, 4, 2, 2) of patches, walked with them on the left."""
        corners = self.corner[:, None, :] + np.array(
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        )
        return np.stack([corners, np.roll(corners, -1, axis=1)], axis=2)

    def patch_at(self, places: FloatArray) -> IntArray:
        """Give a patch that has each of some places (n, 2) in it or on its border."""
        codes = _codes(self.corner, self.corner)
        order = np.argsort(codes)
        floor = np.floor(places)
        beside = floor[:, None, :] - _CORNERS * (places == floor)[:, None, :]
        wanted = _codes(self.corner, beside)
        at = np.minimum(np.searchsorted(codes[order], wanted), max(len(order) - 1, 0))
        found = order[at]
        hit = (codes[found] == wanted).argmax(axis=1)
        return np.asarray(found[np.arange(len(places)), hit])

    def on_surface(self, box: FloatArray, places: FloatArray) -> FloatArray:
        """Give the parameters (n, 2) on their surfaces of places, by the boxes of all patches."""
        found = np.empty_like(places)
        for axis in range(2):
            ends = self.corner[:, axis, None] + [0, 1]
            at, first = np.unique(ends, return_index=True)
            found[:, axis] = np.interp(places[:, axis], at, box[:, axis].reshape(-1)[first])
        return found

    def borders(self, places: FloatArray) -> IntArray:
        """Tell where places (n, 2) lie: 0 on a border of a surface, 1 between patches, else -1."""
        floor = np.floor(places)
        on = places == floor
        beside = floor[:, None, :] - _CORNERS * on[:, None, :]
        outer = ~np.isin(_codes(self.corner, beside), _codes(self.corner, self.corner)).all(axis=1)
        return np.where(on.any(axis=1), np.where(outer, 0, 1), -1)

    def sides(self, uv: FloatArray) -> NDArray[np.bool_]:
        """Tell which sides of their patch points (n, 2) lie on, to the last bit, (n, 4)."""
        return np.stack([uv[:, axis] == value for axis, value in SIDES], axis=1)


def _positions(surface: IntArray, span: FloatArray) -> IntArray:
    """Give numbers to spans (k, 2): those that meet differ by one, others by more."""
    keys = np.stack([surface.astype(np.float64), span[:, 0]])
    distinct, first, which = np.unique(keys, axis=1, return_index=True, return_inverse=True)
    last = span[first, 1]
    meets = (distinct[0, 1:] == distinct[0, :-1]) & (distinct[1, 1:] == last[:-1])
    numbers = np.concatenate([[0], np.cumsum(np.where(meets, 1, 3))])
    return np.asarray(numbers[which.reshape(-1)], np.intp)


def _codes(corner: IntArray, places: FloatArray | IntArray) -> FloatArray | IntArray:
    """Give one number for each place (..., 2) in whole numbers, those of `corner` and beside."""
    width = corner[:, 1].max(initial=0) + 3
    return np.asarray((places[..., 0] + 1) * width + places[..., 1] + 1)


def _beside(corner: IntArray) -> NDArray[np.bool_]:
    """Tell whether there is a patch one step away in each of four directions."""
    return np.isin(_codes(corner, corner[:, None, :] + _STEPS), _codes(corner, corner))


# --------------------------------------------------------------------------------------
# Boxes that touch.


def touching_pairs(low: FloatArray, high: FloatArray, tolerance: float) -> IntArray:
    """Give the pairs (p, 2) of boxes that touch, by their corners (n, 2), or are `tolerance` apart.

    A point is a box of no size.
    """
    centre, size = 0.5 * (low + high), (high - low).max(axis=1, initial=0.0)
    classes = np.frexp(size)[1]
    classes[size == 0.0] = np.iinfo(classes.dtype).min
    groups = [np.flatnonzero(classes == one) for one in np.unique(classes)]
    trees = [cKDTree(centre[rows]) for rows in groups]
    reach = [0.5 * size[rows].max() + tolerance for rows in groups]
    found = [np.zeros((0, 2), np.intp)]
    for rows, tree, half in zip(groups, trees, reach, strict=True):
        found.append(rows[tree.query_pairs(2.0 * half, p=np.inf, output_type="ndarray")])
    for i, j in combinations(range(len(groups)), 2):
        near = trees[i].sparse_distance_matrix(
            trees[j], reach[i] + reach[j], p=np.inf, output_type="ndarray"
        )
        found.append(np.stack([groups[i][near["i"]], groups[j][near["j"]]], axis=1))
    pairs = np.concatenate(found)
    a, b = pairs.T
    meet = (low[a] <= high[b] + tolerance) & (low[b] <= high[a] + tolerance)
    return np.asarray(pairs[meet.all(axis=1)])


def connected_labels(count: int, pairs: IntArray) -> IntArray:
    """Give numbers (count,) to the parts into which pairs (p, 2) connect, by their first ones."""
    ones = np.ones(len(pairs), bool)
    graph = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    labels = connected_components(graph, directed=False)[1]
    _, first, which = np.unique(labels, return_index=True, return_inverse=True)
    return np.asarray(np.argsort(np.argsort(first))[which], np.intp)


def box_clusters(low: FloatArray, high: FloatArray, tolerance: float) -> IntArray:
    """Give numbers to the clusters of boxes (n, 2) that touch."""
    return connected_labels(len(low), touching_pairs(low, high, tolerance))


class CellKind(IntEnum):
    """What is known of the sign of the polynomial in a cell.

    U_SIMPLE: every line v = constant meets the zero set at most once, and there is at most one
    arc, u = g(v). V_SIMPLE likewise, with v = g(u). UNRESOLVED: the search ended here.
    """

    POSITIVE = 1
    NEGATIVE = -1
    ZERO = 0
    U_SIMPLE = 2
    V_SIMPLE = 3
    UNRESOLVED = 4

    @property
    def pure(self) -> bool:
        """Whether the polynomial has one sign, or is zero, in the whole cell."""
        return -1 <= self.value <= 1


@attrs.frozen(eq=False)
class SignCells:
    """Cells that cover all patches of a batch, in the order of patch, level and box.

    Attributes
    ----------
    patch : (c,) int
        The patch of each.
    box : (c, 2, 2)
        ``[[u0, u1], [v0, v1]]`` in parameters of the patch, 0 to 1.
    level : (c,) int
        How often the patch was split to get it.
    kind : (c,) int
        A `CellKind` each.
    row : (c,) int
        For cells that are simple or unresolved, which row of `b` and `err` holds their
        polynomial; else -1.
    b, err : (s, M + 1, N + 1)
        The polynomial restricted to these cells, and the bound of its error.
    stopped : (k,) bool
        Of each patch, whether the budget of cells ended the search.
    """

    patch: IntArray
    box: FloatArray
    level: IntArray
    kind: IntArray
    row: IntArray
    b: FloatArray
    err: FloatArray
    stopped: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.patch, self.box, self.level, self.kind, self.row, self.b, self.err)
        freeze(self.stopped)

    def __len__(self) -> int:
        """Count the cells."""
        return len(self.patch)


@attrs.frozen(eq=False)
class ZeroSetArcs:
    """Arcs of the zero set, one a row, each in one simple cell.

    Attributes
    ----------
    cell : (a,) int
        The row of `SignCells`.
    across : (a,) int
        0 where u = g(v), 1 where v = g(u).
    span : (a, 2)
        The running parameter (v, or u) at both ends, in parameters of the patch.
    ends : (a, 2, 2)
        (u, v) of the start and the end, in parameters of the patch; an end that lies on a
        border of its cell has that parameter to the last bit.
    rising : (a,) bool
        Whether the polynomial is positive on the side of the larger g.
    """

    cell: IntArray
    across: IntArray
    span: FloatArray
    ends: FloatArray
    rising: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.cell, self.across, self.span, self.ends, self.rising)

    def __len__(self) -> int:
        """Count the arcs."""
        return len(self.cell)


def rows_of_groups(counts: IntArray, chosen: IntArray) -> tuple[IntArray, IntArray]:
    """Give the rows (r,) of chosen groups, which lie one behind the other with `counts` rows (g,).

    Also, for each row, the place of its group in `chosen`, (r,); one may be chosen several times.
    """
    start = np.cumsum(counts) - counts
    sizes = counts[chosen]
    owner = np.repeat(np.arange(len(chosen)), sizes)
    within = np.arange(len(owner)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return start[chosen][owner] + within, owner


def select_patches(
    cells: Sequence[SignCells], arcs: Sequence[ZeroSetArcs], chosen: IntArray
) -> tuple[SignCells, ZeroSetArcs]:
    """Give cells and arcs of chosen patches.

    What is found for a patch does not depend on its neighbours in the batch; so results of several
    batches may be put together as if they had been one.

    Parameters
    ----------
    cells : sequence of SignCells
        Batches for polynomials of one degree; the cells of each in the order of their patches.
    arcs : sequence of ZeroSetArcs
        The arcs of each batch, in the order of their cells.
    chosen : (k,) int
        Patches, numbered through all batches, in the order they are wanted.

    Returns
    -------
    cells : SignCells
        Patch ``i`` is ``chosen[i]``; polynomials lie in the order of their cells.
    arcs : ZeroSetArcs
        Their arcs.
    """
    many, lines = _one_behind_the_other(cells, arcs)
    counts = np.bincount(many.patch, minlength=len(many.stopped))
    rows, owner = rows_of_groups(counts, chosen)
    polynomial = many.row[rows]
    held = polynomial >= 0
    row = np.where(held, np.cumsum(held) - 1, -1)
    used = polynomial[held]
    found = SignCells(
        owner, many.box[rows], many.level[rows], many.kind[rows], row,
        many.b[used], many.err[used], many.stopped[chosen],
    )  # fmt: skip
    return found, _gathered_arcs(lines, many, chosen, counts)


def _gathered_arcs(
    arcs: ZeroSetArcs, cells: SignCells, chosen: IntArray, cell_counts: IntArray
) -> ZeroSetArcs:
    """Give the arcs of chosen patches, with the rows their cells have come to."""
    patch = cells.patch[arcs.cell]
    rows, owner = rows_of_groups(np.bincount(patch, minlength=len(cells.stopped)), chosen)
    before = np.cumsum(cell_counts) - cell_counts
    after = np.cumsum(cell_counts[chosen]) - cell_counts[chosen]
    cell = arcs.cell[rows] - before[patch[rows]] + after[owner]
    return ZeroSetArcs(cell, arcs.across[rows], arcs.span[rows], arcs.ends[rows], arcs.rising[rows])


def _one_behind_the_other(
    cells: Sequence[SignCells], arcs: Sequence[ZeroSetArcs]
) -> tuple[SignCells, ZeroSetArcs]:
    """Make one batch of several."""
    if len(cells) == 1:
        return cells[0], arcs[0]
    patches = np.cumsum([0, *(len(each.stopped) for each in cells[:-1])])
    rows = np.cumsum([0, *(len(each.b) for each in cells[:-1])])
    counts = np.cumsum([0, *(len(each) for each in cells[:-1])])
    moved = [
        attrs.evolve(each, patch=each.patch + p, row=np.where(each.row >= 0, each.row + r, -1))
        for each, p, r in zip(cells, patches, rows, strict=True)
    ]
    lines = [attrs.evolve(each, cell=each.cell + c) for each, c in zip(arcs, counts, strict=True)]
    return SignCells(*_joined(moved)), ZeroSetArcs(*_joined(lines))


def _joined(tables: Sequence[SignCells] | Sequence[ZeroSetArcs]) -> list[np.ndarray]:
    """Put the columns of tables one behind the other."""
    columns = zip(*(attrs.astuple(each, recurse=False) for each in tables), strict=True)
    return [np.concatenate(column) for column in columns]


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

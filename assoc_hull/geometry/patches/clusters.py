"""Clusters: cells that touch in which the sign is undecided or nil, and what can be said of them.

In a *regular* cluster one derivative has one sign for certain, in all its cells: the zero set is a
graph there, without loop or crossing. It is undecided only because a border of cells touches the
line. A *singular* cluster lies where the surface stretches its parameters to nothing: the
polynomial is nil there whatever the curvature.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.cells import CellKind, SignCells
>>> from assoc_hull.geometry.patches.clusters import find_clusters
>>> from assoc_hull.geometry.patches.cells import Lattice
>>> whole, none = np.array([[[0.0, 1.0]] * 2]), np.zeros((0, 2, 2))
>>> zero = np.array([0])
>>> cells = SignCells(zero, whole, zero, np.array([CellKind.ZERO]), zero - 1, none, none, zero > 0)
>>> len(find_clusters(cells, Lattice.apart(1)))
1
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.bezier_patches import Patches, area_stretch, patch_normals
from assoc_hull.geometry.patches.cells import (
    CellKind,
    Lattice,
    SignCells,
    box_clusters,
    touching_pairs,
)

__all__ = ["Clusters", "find_clusters", "singular_clusters"]

TOUCHING = 1e-9

# Where |r_u x r_v| is less than this part of its mean over the patch, the surface is singular.
_SINGULAR = 1e-4
# In a cell smaller than this a surface is as good as plane, unless it is singular there.
_SMALL = 1e-3

# Nil cells that cover less than this part of a patch are no region.
_NARROW = 1e-4


@attrs.frozen(eq=False)
class Clusters:
    """Clusters of cells, and the points that touch them.

    Attributes
    ----------
    cell : (c,) int
        The cells that are in clusters.
    cluster : (c,) int
        The cluster of each.
    at_point : (p,) int
        The cluster that each of the given points touches, or -1.
    unresolved : (n,) bool
        Whether a cluster has a cell in which the sign is undecided.
    flat : (n,) bool
        Whether it has a cell in which the polynomial is nil.
    regular : (n,) bool
        Whether the zero set is a graph in the cluster.
    size : (n,) float
        Its area in parameters of its patch.
    """

    cell: IntArray
    cluster: IntArray
    at_point: IntArray
    unresolved: NDArray[np.bool_]
    flat: NDArray[np.bool_]
    regular: NDArray[np.bool_]
    size: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.cell, self.cluster, self.at_point, self.unresolved)
        freeze(self.flat, self.regular, self.size)

    def __len__(self) -> int:
        """Count the clusters."""
        return len(self.regular)

    def touched(
        self, cells: SignCells, lattice: Lattice, points: FloatArray, near: float
    ) -> IntArray:
        """Give the cluster that each of some points (p, 2) of the lattice is so near to, or -1."""
        low, high = _corners(cells, lattice, self.cell)
        count = len(low)
        pairs = touching_pairs(np.concatenate([low, points]), np.concatenate([high, points]), near)
        pairs = np.sort(pairs, axis=1)
        pairs = pairs[(pairs[:, 0] < count) & (pairs[:, 1] >= count)]
        found = np.full(len(points), -1)
        found[pairs[:, 1] - count] = self.cluster[pairs[:, 0]]
        return found

    @property
    def small(self) -> NDArray[np.bool_]:
        """Which clusters (n,) are widths of lines, no regions."""
        return np.asarray(self.size < _NARROW)

    @property
    def narrow(self) -> NDArray[np.bool_]:
        """Which clusters (n,) are small, and nil throughout."""
        return np.asarray(~self.unresolved & self.small)

    def merged(self, number: IntArray) -> Clusters:
        """Give clusters by new numbers (n,), those of one number made one."""
        count = int(number.max(initial=-1)) + 1
        unresolved, flat, winding = (
            np.bincount(number[marks], minlength=count) > 0
            for marks in (self.unresolved, self.flat, ~self.regular)
        )
        at_point = np.append(number, -1)[self.at_point]
        size = np.bincount(number, self.size, minlength=count).astype(np.float64)
        return Clusters(
            self.cell, number[self.cluster], at_point, unresolved, flat, ~winding, size
        )  # fmt: skip


def find_clusters(cells: SignCells, lattice: Lattice, points: FloatArray | None = None) -> Clusters:
    """Merge undecided and nil cells that touch.

    Parameters
    ----------
    cells : SignCells
        All cells.
    lattice : Lattice
        Where their patches lie.
    points : (p, 2), optional
        Places, in the lattice, of which to tell the cluster that they touch.

    Returns
    -------
    Clusters
        Numbered by their first cells.
    """
    rows = np.flatnonzero((cells.kind == CellKind.ZERO) | (cells.kind == CellKind.UNRESOLVED))
    points = np.zeros((0, 2)) if points is None else points
    low, high = _corners(cells, lattice, rows)
    found = box_clusters(np.concatenate([low, points]), np.concatenate([high, points]), TOUCHING)
    cluster, at_point = np.split(found, [len(rows)])
    count = int(cluster.max(initial=-1)) + 1
    nil = cells.kind[rows] == CellKind.ZERO
    return Clusters(
        rows, cluster, np.where(at_point < count, at_point, -1),
        np.bincount(cluster[~nil], minlength=count) > 0,
        np.bincount(cluster[nil], minlength=count) > 0,
        _regular(cells, rows, cluster, count),
        np.bincount(cluster, np.prod(high - low, axis=1), minlength=count).astype(np.float64),
    )  # fmt: skip


def _corners(cells: SignCells, lattice: Lattice, rows: IntArray) -> tuple[FloatArray, FloatArray]:
    """Give the corners of some cells in the lattice."""
    corner = lattice.corner[cells.patch[rows]]
    return corner + cells.box[rows, :, 0], corner + cells.box[rows, :, 1]


def _regular(cells: SignCells, rows: IntArray, cluster: IntArray, count: int) -> NDArray[np.bool_]:
    """Tell in which clusters one derivative has one sign in all cells."""
    row, found = cells.row[rows], np.zeros(count, bool)
    known, every = row >= 0, np.bincount(cluster, minlength=count)
    for axis in (1, 2):
        sign = _monotone(cells.b[row[known]], cells.err[row[known]], axis)
        total = np.bincount(cluster[known], sign, minlength=count)
        found |= np.abs(total) == every
    return found


def _monotone(b: FloatArray, err: FloatArray, axis: int) -> IntArray:
    """Tell the certain sign of a derivative of polynomials (n, M + 1, N + 1), or 0."""
    slope, off = np.diff(b, axis=axis), _sums(err, axis)
    rises, falls = (slope > off).all(axis=(1, 2)), (slope < -off).all(axis=(1, 2))
    return np.asarray(rises.astype(np.intp) - falls)


def _sums(err: FloatArray, axis: int) -> FloatArray:
    """Add neighbours along an axis."""
    last = err.shape[axis] - 1
    return np.asarray(err.take(range(1, last + 1), axis) + err.take(range(last), axis))


def singular_clusters(patches: Patches, cells: SignCells, found: Clusters) -> NDArray[np.bool_]:
    """Tell at which clusters the surface has no tangent plane.

    Parameters
    ----------
    patches : Patches
        The patches.
    cells : SignCells
        Their cells.
    found : Clusters
        The clusters of these.

    Returns
    -------
    (n,) bool
        Whether in one of the cells ``|r_u x r_v|`` falls below 1e-4 of its mean over the patch, or
        changes so much from the middle to a corner that it may be nil in between.
    """
    patch, box = cells.patch[found.cell], cells.box[found.cell]
    middle = patch_normals(patches, patch, box.mean(axis=2))
    corners = [
        patch_normals(patches, patch, np.stack([box[:, 0, i], box[:, 1, j]], axis=1))
        for i in (0, 1)
        for j in (0, 1)
    ]
    here = np.linalg.norm(middle, axis=1)
    change = np.max([np.linalg.norm(each - middle, axis=1) for each in corners], axis=0)
    concerned, which = np.unique(patch, return_inverse=True)
    low = here < _SINGULAR * _means(patches, concerned)[which.reshape(-1)]
    small = (box[:, :, 1] - box[:, :, 0]).max(axis=1, initial=0.0) < _SMALL
    low |= small & (here < 2.0 * change)
    return np.asarray(np.bincount(found.cluster[low], minlength=len(found)) > 0)


def _means(patches: Patches, concerned: IntArray) -> FloatArray:
    """Give the mean stretch of some patches, over the midpoints of 6 x 6 parts."""
    middles = (np.arange(6) + 0.5) / 6.0
    uv = np.stack(np.meshgrid(middles, middles, indexing="ij"), axis=-1).reshape(-1, 2)
    patch = np.repeat(concerned, len(uv))
    values = area_stretch(patches, patch, np.tile(uv, (len(concerned), 1)))
    return np.asarray(values.reshape(-1, len(uv)).mean(axis=1))

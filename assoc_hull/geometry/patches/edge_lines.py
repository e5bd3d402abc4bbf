"""Edges of patches along which the polynomial is nil: no arc runs there, the cells end at it.

Examples
--------
>>> from assoc_hull.geometry.patches.lattice import SIDES
>>> SIDES[3]
(1, 1.0)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.assembling import groups
from assoc_hull.geometry.patches.cells import CellKind, Cells
from assoc_hull.geometry.patches.components import Component, ComponentKind, EndKind
from assoc_hull.geometry.patches.lattice import SIDES, Lattice
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.touching import connected

__all__ = ["edge_components", "edge_points"]

# The corners at both ends of each side: u = 0, u = 1, v = 0, v = 1.
_CORNERS = np.array([[[0, 0], [0, 1]], [[1, 0], [1, 1]], [[0, 0], [1, 0]], [[0, 1], [1, 1]]])


def edge_components(
    patches: Patches, lattice: Lattice, cells: Cells, edges: NDArray[np.bool_]
) -> tuple[Component, ...]:
    """Join edges along which the polynomial is nil.

    Parameters
    ----------
    patches, lattice, cells : Patches, Lattice, Cells
        The patches, where they lie, their cells.
    edges : (k, 4) bool
        Where the polynomial is nil; left aside where it is nil in the cells along the edge as
        well, or of the other patch there.

    Returns
    -------
    tuple of Component
        Edge lines; an edge that two patches share is that of the first.
    """
    patch, side = np.nonzero(edges & ~_flat(cells, len(edges)))
    corners = lattice.corner[patch][:, None, :] + _CORNERS[side]
    kept = np.sort(np.unique(corners.reshape(-1, 4), axis=0, return_index=True)[1])
    patch, side, corners = patch[kept], side[kept], corners[kept]
    _, corner = np.unique(corners.reshape(-1, 2), axis=0, return_inverse=True)
    corner = corner.reshape(-1, 2)
    count = len(kept)
    rows = np.arange(count)
    pairs = np.concatenate([np.stack([rows, count + corner[:, i]], axis=1) for i in (0, 1)])
    label = connected(count + int(corner.max(initial=-1)) + 1, pairs)[:count]
    return tuple(
        _component(patches, patch[rows], side[rows], corner[rows])
        for rows in groups(label, int(label.max(initial=-1)) + 1)
    )


def _flat(cells: Cells, count: int) -> NDArray[np.bool_]:
    """Tell along which sides of patches the polynomial is nil in every cell, (k, 4)."""
    zero = cells.kind == CellKind.ZERO
    found = np.zeros((count, 4), bool)
    for side, (axis, value) in enumerate(SIDES):
        at = cells.box[:, axis, int(value)] == value
        other = np.bincount(cells.patch[at & ~zero], minlength=count)
        found[:, side] = other == 0
    return found


def _component(patches: Patches, patch: IntArray, side: IntArray, corner: IntArray) -> Component:
    """Put one edge line together; its ends are the corners where a single edge of it ends."""
    uses = np.bincount(corner.reshape(-1))[corner]
    row, which = np.nonzero(uses == 1)
    ends = patches.parameters(patch[row], _CORNERS[side[row], which].astype(np.float64))
    nothing = np.zeros(0, np.intp)
    return Component(
        ComponentKind.EDGE_LINE, (), (), nothing, np.stack([patch, side], axis=1),
        np.unique(patch), ends, (EndKind.BORDER,) * len(ends), (),
    )  # fmt: skip


def edge_points(patches: Patches, edges: IntArray) -> FloatArray:
    """Give the parameters (e, 2, 2), on the surface, of both corners of edges (e, 2)."""
    uv = _CORNERS[edges[:, 1]].astype(np.float64).reshape(-1, 2)
    return patches.parameters(np.repeat(edges[:, 0], 2), uv).reshape(-1, 2, 2)

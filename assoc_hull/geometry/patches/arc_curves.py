"""Arcs as curves u = g(v), whichever way they run: one batch of both.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.arc_curves import arc_curves
>>> from assoc_hull.geometry.patches.arcs import arcs_of
>>> from assoc_hull.geometry.patches.curvature_functions import IsoFunction
>>> from assoc_hull.geometry.patches.solve import solve
>>> b = np.array([[[-1.0, -2.0], [3.0, 2.0]]])
>>> cells = solve(IsoFunction(b, 1e-15 + 0.0 * b))
>>> [(curves, rows)] = arc_curves(cells, arcs_of(cells), np.array([0]))
>>> curves.at(rows, np.array([[0.0, 1.0]]), np.array([[0.3, 0.4]]))
array([[0.25, 0.5 ]])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.heights import heights

__all__ = ["ArcCurves", "arc_curves"]

# Arcs at a time, so that their values stay in the cache.
_BLOCK = 512


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
        """Find g at places.

        Parameters
        ----------
        row : (c,) int
            The arc of each row of places.
        v : (c, q)
            The places.
        start : (c, q)
            What g is there, roughly.

        Returns
        -------
        (c, q) float
            The values of g, in parameters of the patch.
        """
        found = np.empty_like(v)
        for first in range(0, len(row), _BLOCK):
            part = slice(first, first + _BLOCK)
            found[part] = self._at(row[part], v[part], start[part])
        return found

    def _at(self, row: IntArray, v: FloatArray, start: FloatArray) -> FloatArray:
        box = self.box[row]
        low, size = box[..., :1], box[..., 1:] - box[..., :1]
        t = np.clip((v - low[:, 1]) / size[:, 1], 0.0, 1.0)
        rough = (start - low[:, 0]) / size[:, 0]
        return low[:, 0] + size[:, 0] * heights(self.b[row], self.rising[row], t, rough)


def arc_curves(cells: Cells, arcs: Arcs, chosen: IntArray) -> list[tuple[ArcCurves, IntArray]]:
    """Turn arcs into curves u = g(v), in one batch if the polynomial has one degree in u and v.

    Parameters
    ----------
    cells : Cells
        The cells.
    arcs : Arcs
        Their arcs.
    chosen : (c,) int
        Which of these.

    Returns
    -------
    list of (ArcCurves, (a,) int)
        Curves, and which rows of `arcs` they are.
    """
    if cells.b.shape[1] == cells.b.shape[2]:
        parts = [chosen]
    else:
        parts = [chosen[arcs.across[chosen] == way] for way in (0, 1)]
    return [(_curves(cells, arcs, rows), rows) for rows in parts if len(rows)]


def _curves(cells: Cells, arcs: Arcs, rows: IntArray) -> ArcCurves:
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

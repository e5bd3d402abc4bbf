"""Patches solved again where a cut of the search touches the zero set.

A line that touches a cut, without crossing it, has a double root there: no cell along the cut can
be proven to hold one arc, at any level. What is left undecided is a regular cluster: its cells
prove that the line is a graph. Other cuts do away with it.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.curvature_functions import IsoFunction
>>> from assoc_hull.geometry.patches.refining import refined
>>> from assoc_hull.geometry.patches.solve import FIRST_CUT, solve
>>> in_u, in_v = ([c * c, c * c - c, (1 - c) ** 2] for c in (FIRST_CUT[0] + 0.2, 0.53))
>>> b = 0.2**2 - np.array(in_u)[:, None] - in_v  # a circle that touches the cut
>>> function = IsoFunction(b[None], np.full((1, 3, 3), 1e-15))
>>> cells = solve(function)
>>> [int((each.kind == 4).sum()) for each in (cells, refined(function, cells))]
[2, 0]
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.clusters import clusters_of
from assoc_hull.geometry.patches.curvature_functions import IsoFunction
from assoc_hull.geometry.patches.gathering import gathered
from assoc_hull.geometry.patches.lattice import Lattice
from assoc_hull.geometry.patches.solve import solve

__all__ = ["refined"]

# Where patches are cut first instead, one try after the other.
_CUTS = ((0.4583, 0.5391), (0.5227, 0.4673))


def refined(
    function: IsoFunction,
    cells: Cells,
    depth: int = 16,
    budget: int = 6000,
    nil: FloatArray | None = None,
) -> Cells:
    """Solve patches again, with other cuts, that have undecided cells in which the line is a graph.

    Parameters
    ----------
    function : IsoFunction
        The polynomials.
    cells : Cells
        What `solve` has found for them.
    depth, budget, nil : int, int, (k, M + 1, N + 1)
        As for `solve`.

    Returns
    -------
    Cells
        The same for all other patches; the new ones where fewer such clusters are left. What is
        found for a patch depends on its polynomial only.
    """
    touched = _touched(cells)
    for cut in _CUTS:
        rows = np.flatnonzero(touched)
        if not len(rows):
            break
        part = IsoFunction(function.b[rows], function.err[rows])
        again = solve(part, depth, budget, cut, None if nil is None else nil[rows])
        left = _touched(again)
        better = left < touched[rows]
        cells = _replaced(cells, again, rows, better)
        touched[rows[better]] = left[better]
    return cells


def _touched(cells: Cells) -> IntArray:
    """Count the regular clusters of each patch that was searched to the end."""
    count = len(cells.stopped)
    found = clusters_of(cells, Lattice.apart(count))
    patch = np.zeros(len(found), np.intp)
    patch[found.cluster] = cells.patch[found.cell]
    counts = np.bincount(patch[found.regular], minlength=count)
    return np.where(cells.stopped, 0, counts)


def _replaced(cells: Cells, again: Cells, rows: IntArray, better: np.ndarray) -> Cells:
    """Take the new cells of some patches."""
    chosen = np.arange(len(cells.stopped))
    chosen[rows[better]] = len(chosen) + np.flatnonzero(better)
    none = np.zeros(0, np.intp)
    arcs = Arcs(none, none, np.zeros((0, 2)), np.zeros((0, 2, 2)), none > 0)
    return gathered([cells, again], [arcs, arcs], chosen)[0]

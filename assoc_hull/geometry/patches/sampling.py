"""Arcs as polylines: as many points as a chord tolerance in space wants, each of them a root.

A chord is halved, at the middle of the running parameter, until the point found there lies within
the tolerance of it. What an arc gets does not depend on the other arcs.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.arcs import arcs_of
>>> from assoc_hull.geometry.patches.curvature_functions import IsoFunction
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.geometry.patches.sampling import sampled
>>> from assoc_hull.geometry.patches.solve import solve
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0] = net[:, 1, 1] = 1.0
>>> b = np.array([[[-1.0, -2.0], [3.0, 2.0]]])
>>> cells = solve(IsoFunction(b, 1e-15 + 0.0 * b))
>>> start, uv = sampled(Patches.single(net), cells, arcs_of(cells), 0.1)
>>> start.tolist(), uv[0].tolist(), uv[-1].tolist()
([0, 5], [0.25, 0.0], [0.5, 1.0])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.arcs import placed
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.heights import heights, polynomials_over
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.points import points

__all__ = ["sampled"]

# A chord is halved so often in any case, for an arc may meet its chord in the middle; and at most.
_LEAST, _MOST = 2, 14
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


def sampled(
    patches: Patches, cells: Cells, arcs: Arcs, chord_tol: float
) -> tuple[IntArray, FloatArray]:
    """Give points of arcs.

    Parameters
    ----------
    patches : Patches
        The patches.
    cells : Cells
        Their cells.
    arcs : Arcs
        The arcs of these.
    chord_tol : float, m
        How far a chord may stray from its arc.

    Returns
    -------
    start : (a + 1,) int
        Where the points of each arc begin.
    uv : (p, 2)
        Parameters of the patch, from the start of an arc to its end, both included.
    """
    chords = _whole(patches, cells, arcs)
    arc, t, uv = [np.repeat(chords.arc, 2)], [chords.t.reshape(-1)], [chords.uv.reshape(-1, 2)]
    for turn in range(_MOST):
        if not len(chords.arc):
            break
        middle = 0.5 * (chords.t[:, 0] + chords.t[:, 1])
        rough = 0.5 * (chords.uv[:, 0] + chords.uv[:, 1])
        place = _places(cells, arcs, chords.arc, middle, rough)
        xyz = points(patches, cells.patch[arcs.cell[chords.arc]], place)
        stray, length = _strays(chords.xyz, xyz)
        open_ = (stray > chord_tol) | ((turn < _LEAST) & (length > chord_tol))
        chords, middle, place, xyz = chords.at(open_), middle[open_], place[open_], xyz[open_]
        arc.append(chords.arc)
        t.append(middle)
        uv.append(place)
        chords = chords.halved(middle, place, xyz)
    return _in_order(np.concatenate(arc), np.concatenate(t), np.concatenate(uv), len(arcs))


def _whole(patches: Patches, cells: Cells, arcs: Arcs) -> _Chords:
    """Give the chords from end to end."""
    number = np.arange(len(arcs))
    box = cells.box[arcs.cell, 1 - arcs.across]
    t = (arcs.span - box[:, :1]) / (box[:, 1:] - box[:, :1])
    patch = np.repeat(cells.patch[arcs.cell], 2)
    xyz = points(patches, patch, arcs.ends.reshape(-1, 2)).reshape(-1, 2, 3)
    return _Chords(number, t, arcs.ends, xyz)


def _places(
    cells: Cells, arcs: Arcs, arc: IntArray, t: FloatArray, rough: FloatArray
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
    cells: Cells, arcs: Arcs, arc: IntArray, t: FloatArray, rough: FloatArray, across: int
) -> FloatArray:
    """Find points of arcs that run the same way."""
    cell = arcs.cell[arc]
    b, (low, high) = polynomials_over(cells, cell, across), cells.box[cell, across].T
    start = (rough[:, across] - low) / (high - low)
    height = heights(b, arcs.rising[arc], t[:, None], start[:, None])[:, 0]
    found = np.empty((len(arc), 2))
    found[:, 1 - across] = placed(cells.box[cell, 1 - across], t)
    found[:, across] = placed(cells.box[cell, across], height)
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

"""Lines that run unseen along borders of cells, where a polynomial is nil within its error.

A cell counts as positive where no coefficient lies below its error, so a line may run in it where
the polynomial is no larger than that. There an arc breaks off. Then positive and negative cells
have a border with no arc between them: the line runs along it, as far as anyone can tell.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.cells import CellKind, Cells
>>> from assoc_hull.geometry.patches.gaps import unseen
>>> from assoc_hull.geometry.patches.lattice import Lattice
>>> box = np.array([[[0.0, 0.5], [0.0, 1.0]], [[0.5, 1.0], [0.0, 1.0]]])
>>> zero, none = np.zeros(2, int), np.zeros((0, 2, 2))
>>> kind = np.array([CellKind.POSITIVE, CellKind.NEGATIVE])
>>> cells = Cells(zero, box, zero, kind, zero - 1, none, none, zero[:1] > 0)
>>> unseen(cells, Lattice.apart(1), zero - 1, none).tolist()
[[[0.5, 0.0], [0.5, 1.0]]]
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.cell_borders import SHORT, between, of_both_signs, plain, sides_of
from assoc_hull.geometry.patches.cells import CellKind, Cells
from assoc_hull.geometry.patches.chains import chained
from assoc_hull.geometry.patches.clusters import Clusters
from assoc_hull.geometry.patches.lattice import Lattice
from assoc_hull.geometry.patches.loops import followers
from assoc_hull.geometry.patches.touching import connected

__all__ = ["Gaps", "gaps_of", "unseen"]


def unseen(cells: Cells, lattice: Lattice, arc_of: IntArray, ends: FloatArray) -> FloatArray:
    """Give the borders of positive and negative cells that no arc runs along.

    Cells that lack an arc which must be there are left out: that is no gap, but an error.

    Parameters
    ----------
    cells, lattice : Cells, Lattice
        The cells, and where their patches lie.
    arc_of : (c,) int
        The arc in each cell, or -1.
    ends : (a, 2, 2)
        Where arcs begin and end, in the lattice, walked with the positive side on the left.

    Returns
    -------
    (p, 2, 2)
        Where pieces begin and end, walked likewise.
    """
    kept, rows = np.ones(len(cells), bool), plain(cells, arc_of)
    kept[rows] = ~of_both_signs(cells, rows)
    cells, arc_of = _some(cells, np.flatnonzero(kept)), arc_of[kept]
    positive = sides_of(cells, lattice, CellKind.POSITIVE, arc_of, ends)
    return between(positive, sides_of(cells, lattice, CellKind.NEGATIVE, arc_of, ends))


@attrs.frozen(eq=False)
class Gaps:
    """What ends of arcs lead to along the borders of cells.

    Attributes
    ----------
    cluster : (n,) int
        The new number of the cluster that each end leads to, or -1. Ends that lead to one another
        have a number of their own.
    number : (c,) int
        The new number of each cluster; those between which an unseen line runs are one.
    border : (n,) int
        0 for an end that leads to the border of its surface, 1 for one between patches, else -1.
    """

    cluster: IntArray
    number: IntArray
    border: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.cluster, self.number, self.border)


def gaps_of(
    lattice: Lattice, cells: Cells, clusters: Clusters, arc_patch: IntArray, arc_of: IntArray,
    ends: FloatArray, lost: NDArray[np.bool_],
) -> Gaps:  # fmt: skip
    """Find what ends that break off lead to.

    Parameters
    ----------
    lattice, cells, clusters : Lattice, Cells, Clusters
        All cells, where they lie, what is undecided.
    arc_patch : (a,) int
        The patch of each arc.
    arc_of : (c,) int
        The arc in each cell, or -1.
    ends : (a, 2, 2)
        Where arcs begin and end, in the lattice, walked with the positive side on the left.
    lost : (a, 2) bool
        Which of these lead to nothing; ``np.flatnonzero(lost)`` numbers them.

    Returns
    -------
    Gaps
        What they lead to.
    """
    troubled = np.unique(arc_patch[lost.any(axis=1)])
    rows = np.flatnonzero(np.isin(cells.patch, troubled))
    pieces = unseen(_some(cells, rows), lattice, arc_of[rows], ends)
    arcs = np.flatnonzero(np.isin(arc_patch, troubled))
    before, after, chain_ends, pairs = _followed(ends[arcs], pieces)
    end = np.full(lost.shape, -1)
    end[lost] = np.arange(np.count_nonzero(lost))
    heads, tails = end[arcs, 1], end[arcs, 0]
    count, chains = int(lost.sum()), len(chain_ends)
    chain, first = np.repeat(np.arange(chains), 2), count + chains
    places = np.concatenate([chain_ends.reshape(-1, 2), ends[lost]])
    touched = clusters.touched(cells, lattice, places, SHORT)
    touched = np.where(touched >= 0, touched + first, -1)
    who = np.concatenate([count + chain, np.arange(count)])
    links = [
        np.stack([heads[pairs[:, 0]], tails[pairs[:, 1]]], axis=1),
        np.stack([_of(heads, before), count + np.arange(chains)], axis=1),
        np.stack([_of(tails, after), count + np.arange(chains)], axis=1),
        np.stack([touched, who], axis=1),
    ]
    joined = np.concatenate(links)
    joined = joined[(joined >= 0).all(axis=1)]
    label = connected(count + chains + len(clusters), joined)
    border = lattice.borders(chain_ends.reshape(-1, 2))
    return _numbered(label, count, chains, np.stack([chain, border], axis=1))


def _of(values: IntArray, rows: IntArray) -> IntArray:
    """Give the values of rows, -1 for row -1."""
    return np.append(values, -1)[rows]


def _some(cells: Cells, rows: IntArray) -> Cells:
    """Give some cells, with the polynomials of all."""
    names = "patch", "box", "level", "kind", "row"
    return attrs.evolve(cells, **{name: getattr(cells, name)[rows] for name in names})


def _followed(
    arcs: FloatArray, pieces: FloatArray
) -> tuple[IntArray, IntArray, FloatArray, IntArray]:
    """Chain unseen pieces (p, 2, 2).

    Returns the arcs before and after each chain that is not closed, or -1, the ends (c, 2, 2) of
    these chains, and the pairs of arcs that follow one another at once.
    """
    count = len(arcs)
    items = np.concatenate([arcs, pieces])
    along = items[:, 1] - items[:, 0]
    following = followers(items, along, along)
    after = following[count:]
    chains = chained(np.where(after >= count, after - count, -1))
    kept = ~chains.closed
    first, last = chains.firsts[kept], chains.lasts[kept]
    preceding = np.full(len(items), -1)
    numbers = np.flatnonzero(following[:count] >= 0)
    preceding[following[numbers]] = numbers
    real = np.where(after[last] < count, after[last], -1)
    at_once = numbers[following[numbers] < count]
    return (
        preceding[count + first], real, np.stack([pieces[first, 0], pieces[last, 1]], axis=1),
        np.stack([at_once, following[at_once]], axis=1),
    )  # fmt: skip


def _numbered(label: IntArray, count: int, chains: int, borders: IntArray) -> Gaps:
    """Give numbers to what hangs together: ends, chains, clusters; and the borders reached."""
    mine, theirs = label[:count], label[count + chains :]
    together = np.bincount(mine, minlength=len(label) + 1)
    shared = np.setdiff1d(mine[together[mine] > 1], theirs)
    order = np.concatenate([np.unique(theirs), shared])
    number = np.full(len(label) + 1, -1)
    number[order] = np.arange(len(order))
    reached = np.full(len(label) + 1, -1)
    at = borders[borders[:, 1] >= 0]
    reached[label[count + at[:, 0]]] = at[:, 1]
    return Gaps(number[mine], number[theirs], np.where(number[mine] < 0, reached[mine], -1))

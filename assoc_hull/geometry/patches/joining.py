"""Arcs joined into lines, and lines into the components of a zero set.

Ends of arcs that coincide are joined, also across the borders of patches. An end that is left alone
lies on the border of its surface, or on undecided or nil cells, or on a border of patches where the
curvature jumps; if none of these, something is wrong, and that is an error.

Source: joining along shared edges, by changes of sign there, follows "Curvature Region Analysis for
Application of Plates Forming", J. SNAK, which links neighbouring cells; what ends may meet and what
is to be done at undecided cells is our own.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.cells import Arcs, CellKind, Cells
>>> from assoc_hull.geometry.patches.joining import joined
>>> from assoc_hull.geometry.patches.patches import Patches
>>> patches = Patches.single(np.zeros((2, 2, 3)))
>>> whole, zero = np.array([[[0.0, 1.0]] * 2]), np.array([0])
>>> simple, b = np.array([CellKind.U_SIMPLE]), np.array([[[-1.0, -1.0], [1.0, 1.0]]])
>>> cells = Cells(zero, whole, zero, simple, zero, b, 0.0 * b, zero > 0)
>>> ends = np.array([[[0.5, 0.0], [0.5, 1.0]]])
>>> found = joined(patches, cells, Arcs(zero, zero, np.array([[0.0, 1.0]]), ends, zero == 0))
>>> found[0].kind.value, found[0].ends.tolist()
('open', [[0.5, 1.0], [0.5, 0.0]])
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.patches.assembling import Parts
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.components import Component
from assoc_hull.geometry.patches.edge_lines import edge_components
from assoc_hull.geometry.patches.landings import JUNCTION
from assoc_hull.geometry.patches.lattice import Lattice
from assoc_hull.geometry.patches.links import Links
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.touching import connected

__all__ = ["joined"]


def joined(
    patches: Patches, cells: Cells, arcs: Arcs, edges: NDArray[np.bool_] | None = None
) -> tuple[Component, ...]:
    """Join arcs into components.

    Parameters
    ----------
    patches : Patches
        The patches of any number of surfaces; those of one surface are joined with one another.
    cells, arcs : Cells, Arcs
        The cells of these patches, and the arcs in the cells.
    edges : (k, 4) bool, optional
        On which sides of each patch (u = 0, u = 1, v = 0, v = 1) the polynomial is nil.

    Returns
    -------
    tuple of Component
        Lines in the order of their first arcs, then isolated cells, then edge lines.

    Raises
    ------
    DanglingArcError
        If a line breaks off inside a patch, at nothing that explains it.
    """
    lattice = Lattice.of(patches.surface, patches.box)
    links = Links.of(lattice, cells, arcs)
    links.check(patches)
    found = _components(patches, cells, arcs, links)
    return found if edges is None else found + edge_components(patches, lattice, cells, edges)


def _components(patches: Patches, cells: Cells, arcs: Arcs, links: Links) -> tuple[Component, ...]:
    """Put together what hangs together."""
    label, cluster_label, count = _labels(links)
    parts = Parts.of(patches, cells, arcs, links, label, cluster_label, count)
    return tuple(parts.component(i) for i in range(count))


def _labels(links: Links) -> tuple[IntArray, IntArray, int]:
    """Give numbers of components to arcs and to clusters; -1 to those that are of none."""
    clusters = links.landings.clusters
    joints, arcs, count = links.joints, len(links.following), len(links.joints)
    numbers, on = np.arange(arcs), links.following >= 0
    shared = (links.landings.kind == JUNCTION) | (links.landings.cluster >= 0)
    meets = shared[joints.joint] & ~joints.short[:, None]
    at = np.flatnonzero(links.landings.cluster >= 0)
    pairs = [np.stack([numbers[on], links.following[on]], axis=1)]
    pairs += [np.stack([numbers, arcs + joints.joint[:, i]], axis=1)[meets[:, i]] for i in (0, 1)]
    pairs += [np.stack([arcs + at, arcs + count + links.landings.cluster[at]], axis=1)]
    label = connected(arcs + count + len(links.passed), np.concatenate(pairs))
    mine, theirs = label[:arcs], label[arcs + count :]
    wanted = np.concatenate(
        [
            mine[~joints.short],
            theirs[: len(clusters)][clusters.unresolved | clusters.narrow],
        ]
    )
    kept = np.unique(wanted)
    number = np.full(len(label), -1)
    number[kept] = np.arange(len(kept))
    return np.where(joints.short, -1, number[mine]), number[theirs], len(kept)

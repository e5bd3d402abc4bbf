"""Components put together from the rows that belong to each.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.assembling import groups
>>> [rows.tolist() for rows in groups(np.array([1, -1, 0, 1]), 2)]
[[2], [0, 3]]
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.clusters import singular
from assoc_hull.geometry.patches.components import Component, ComponentKind, EndKind
from assoc_hull.geometry.patches.landings import END_KINDS
from assoc_hull.geometry.patches.links import Links
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["Parts", "groups"]


def groups(label: IntArray, count: int) -> list[IntArray]:
    """Give the rows of each label from 0 to count - 1, in rising order."""
    order = np.argsort(label, kind="stable")
    return np.split(order, np.searchsorted(label[order], np.arange(count + 1)))[1:-1]


@attrs.frozen(eq=False)
class Parts:
    """What components are made of, each by its rows.

    Attributes
    ----------
    links : Links
        Arcs and what they meet.
    chains, cells : list of (n,) int
        The lines of each component; its rows of ``links.landings.clusters.cell``.
    clusters : list of (n,) int
        The clusters of each component.
    marks : dict of str to (n,) bool
        Of which clusters a tag is true.
    patch : (a,) int
        The patch of each arc.
    cell_patch : (c,) int
        The patch of each cell in a cluster.
    uv : (j, 2)
        Where joints lie on their surface.
    """

    links: Links
    chains: list[IntArray]
    cells: list[IntArray]
    clusters: list[IntArray]
    marks: dict[str, NDArray[np.bool_]]
    patch: IntArray
    cell_patch: IntArray
    uv: FloatArray

    @classmethod
    def of(
        cls, patches: Patches, cells: Cells, arcs: Arcs, links: Links, label: IntArray,
        at: IntArray, count: int,
    ) -> Parts:  # fmt: skip
        """Sort lines and cells by the components of arcs (a,) and of clusters (n,)."""
        found, over_gaps = links.landings.clusters, links.landings.over_gaps
        more = np.zeros(len(at) - len(found), bool)
        marks = {
            "singular": np.append(singular(patches, cells, found), more),
            "tangent": links.passed & np.append(found.regular, more),
            "flat": np.append(found.flat, more),
            "gap": over_gaps,
        }
        return cls(
            links, groups(label[links.chains.firsts], count), groups(at[found.cluster], count),
            groups(at, count), marks, cells.patch[arcs.cell], cells.patch[found.cell],
            patches.parameters(links.points.patch, links.points.uv),
        )  # fmt: skip

    def component(self, number: int) -> Component:
        """Give one component."""
        chains, rows, cells = self.links.chains, self.chains[number], self.cells[number]
        arcs = tuple(chains.of(i) for i in rows.tolist())
        loops = tuple(chains.closed[rows].tolist())
        joints = self._ends(arcs, loops)
        ends = tuple(END_KINDS[i] for i in self.links.landings.kind[joints].tolist())
        touched = [self.patch[one] for one in arcs] + [self.cell_patch[cells]]
        return Component(
            _kind(loops, ends), arcs, loops, self.links.landings.clusters.cell[cells],
            np.zeros((0, 2), np.intp), np.unique(np.concatenate(touched)),
            self.uv[joints], ends, self._tags(self.clusters[number], ends),
        )  # fmt: skip

    def _ends(self, arcs: tuple[IntArray, ...], loops: tuple[bool, ...]) -> IntArray:
        """Give the joints at both ends of each line that is not closed."""
        joint = self.links.joints.joint
        found = [
            joint[[one[0], one[-1]], [0, 1]]
            for one, loop in zip(arcs, loops, strict=True)
            if not loop
        ]
        return np.concatenate([np.zeros(0, np.intp), *found])

    def _tags(self, clusters: IntArray, ends: tuple[EndKind, ...]) -> tuple[str, ...]:
        """Tell what is special of a component."""
        tags = [name for name, marked in self.marks.items() if marked[clusters].any()]
        return (*tags, "knot-line") if EndKind.KNOT_LINE in ends else tuple(tags)


def _kind(loops: tuple[bool, ...], ends: tuple[EndKind, ...]) -> ComponentKind:
    """Tell what a component is."""
    if not loops:
        return ComponentKind.ISOLATED
    if EndKind.JUNCTION in ends:
        return ComponentKind.JUNCTION
    return ComponentKind.CLOSED if all(loops) else ComponentKind.OPEN

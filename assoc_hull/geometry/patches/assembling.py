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
from assoc_hull.geometry.patches.links import END_KINDS, Links, on_surface
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
        The lines of each component; its rows of ``links.clusters.cell``.
    marks : dict of str to (n,) bool
        Which clusters are singular, passed through, flat.
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
        found = links.clusters
        marks = {
            "singular": singular(patches, cells, found),
            "tangent": links.passed,
            "flat": found.flat,
        }
        return cls(
            links, groups(label[links.chains.firsts], count), groups(at[found.cluster], count),
            marks, cells.patch[arcs.cell], cells.patch[found.cell],
            on_surface(patches, links.patch, links.uv),
        )  # fmt: skip

    def component(self, number: int) -> Component:
        """Give one component."""
        chains, rows, cells = self.links.chains, self.chains[number], self.cells[number]
        arcs = tuple(chains.of(i) for i in rows.tolist())
        loops = tuple(chains.closed[rows].tolist())
        joints = self._ends(arcs, loops)
        ends = tuple(END_KINDS[i] for i in self.links.kind[joints].tolist())
        touched = [self.patch[one] for one in arcs] + [self.cell_patch[cells]]
        return Component(
            _kind(loops, ends), arcs, loops, self.links.clusters.cell[cells],
            np.zeros((0, 2), np.intp), np.unique(np.concatenate(touched)),
            self.uv[joints], ends, self._tags(cells, ends),
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

    def _tags(self, cells: IntArray, ends: tuple[EndKind, ...]) -> tuple[str, ...]:
        """Tell what is special of a component."""
        mine = np.unique(self.links.clusters.cluster[cells])
        tags = [name for name, marked in self.marks.items() if marked[mine].any()]
        return (*tags, "knot-line") if EndKind.KNOT_LINE in ends else tuple(tags)


def _kind(loops: tuple[bool, ...], ends: tuple[EndKind, ...]) -> ComponentKind:
    """Tell what a component is."""
    if not loops:
        return ComponentKind.ISOLATED
    if EndKind.JUNCTION in ends:
        return ComponentKind.JUNCTION
    return ComponentKind.CLOSED if all(loops) else ComponentKind.OPEN

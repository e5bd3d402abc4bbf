"""Arcs joined into the connected components of a zero set.

A component is a closed line, an open one, a point, or a cluster that could not be decided.
Edges of patches along which the polynomial is zero are lines too, though no arc runs there.
`join_arcs` is what is called from outside.
"""

from __future__ import annotations

from enum import StrEnum

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cells import (
    SIDES,
    CellKind,
    Lattice,
    SignCells,
    ZeroSetArcs,
    connected_labels,
)
from assoc_hull.geometry.patches.clusters import singular_clusters
from assoc_hull.geometry.patches.line_ends import JUNCTION, ZeroSetLinks

__all__ = [
    "END_KINDS",
    "ComponentKind",
    "ComponentParts",
    "LineEndKind",
    "ZeroSetComponent",
    "edge_components",
    "edge_points",
    "join_arcs",
    "rows_by_label",
]


class ComponentKind(StrEnum):
    """What a component is.

    CLOSED: a loop. OPEN: a line with two ends. JUNCTION: lines that meet at cells in which the
    sign is undecided or zero, or at a point. ISOLATED: such cells alone, with no line: a point
    contact, a loop smaller than they are, or a line that the curvature touches without changing
    sign; which of these is not decided. EDGE_LINE: edges of patches along which the polynomial
    is zero.
    """

    CLOSED = "closed"
    OPEN = "open"
    JUNCTION = "junction"
    ISOLATED = "isolated"
    EDGE_LINE = "edge_line"


class LineEndKind(StrEnum):
    """Where a line ends.

    BORDER: on the border of its surface. KNOT_LINE: on a border of two patches, where the
    curvature jumps and the line does not go on. JUNCTION: at undecided or zero cells, or at a
    point where other lines end as well.
    """

    BORDER = "border"
    KNOT_LINE = "knot-line"
    JUNCTION = "junction"


@attrs.frozen(eq=False)
class ZeroSetComponent:
    """One connected part of the zero set.

    Attributes
    ----------
    kind : ComponentKind
        What it is.
    chains : tuple of (n,) int
        The arcs of each of its lines, in the order of a walk with the positive side on the left
        (`positive_on_left` tells which arcs are walked as they run).
    loops : tuple of bool
        Whether each of these lines is closed.
    cells : (c,) int
        The undecided and zero cells that belong to it.
    edges : (e, 2) int
        Of an edge line, the patch and the side (0: u = 0, 1: u = 1, 2: v = 0, 3: v = 1).
    patches : (p,) int
        The patches it touches, in rising order.
    ends : (k, 2)
        Parameters, on the surface, of the beginning and the end of each line that is not closed.
    end_kinds : tuple of LineEndKind
        What each of these ends is; as many of them as are junctions meet there.
    tags : tuple of str
        "singular": the surface has no tangent plane there, so that this is no feature of its
        curvature. "knot-line": a line ends where the curvature jumps. "tangent": a line was
        followed through undecided cells in which it is proven to be a graph. "flat": it touches
        cells in which the polynomial is zero. "gap": a line was followed over a gap in which the
        polynomial is zero within its error.
    """

    kind: ComponentKind
    chains: tuple[IntArray, ...]
    loops: tuple[bool, ...]
    cells: IntArray
    edges: IntArray
    patches: IntArray
    ends: FloatArray
    end_kinds: tuple[LineEndKind, ...]
    tags: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.cells, self.edges, self.patches, self.ends, *self.chains)

    @property
    def meetings(self) -> int:
        """How many ends of lines meet at junctions: 4 where two lines cross."""
        return self.end_kinds.count(LineEndKind.JUNCTION)


# What an end is, by number, in the order of those in `line_ends`.
END_KINDS = (LineEndKind.BORDER, LineEndKind.KNOT_LINE, LineEndKind.JUNCTION)


def rows_by_label(label: IntArray, count: int) -> list[IntArray]:
    """Give the rows of each label from 0 to count - 1, in rising order."""
    order = np.argsort(label, kind="stable")
    return np.split(order, np.searchsorted(label[order], np.arange(count + 1)))[1:-1]


@attrs.frozen(eq=False)
class ComponentParts:
    """What components are made of, each by its rows.

    Attributes
    ----------
    links : ZeroSetLinks
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

    links: ZeroSetLinks
    chains: list[IntArray]
    cells: list[IntArray]
    clusters: list[IntArray]
    marks: dict[str, NDArray[np.bool_]]
    patch: IntArray
    cell_patch: IntArray
    uv: FloatArray

    @classmethod
    def of(
        cls,
        patches: Patches,
        cells: SignCells,
        arcs: ZeroSetArcs,
        links: ZeroSetLinks,
        label: IntArray,
        at: IntArray,
        count: int,
    ) -> ComponentParts:
        """Sort lines and cells by the components of arcs (a,) and of clusters (n,)."""
        found, over_gaps = links.landings.clusters, links.landings.over_gaps
        more = np.zeros(len(at) - len(found), bool)
        marks = {
            "singular": np.append(singular_clusters(patches, cells, found), more),
            "tangent": links.passed & np.append(found.regular, more),
            "flat": np.append(found.flat, more),
            "gap": over_gaps,
        }
        return cls(
            links,
            rows_by_label(label[links.chains.firsts], count),
            rows_by_label(at[found.cluster], count),
            rows_by_label(at, count),
            marks,
            cells.patch[arcs.cell],
            cells.patch[found.cell],
            patches.parameters(links.points.patch, links.points.uv),
        )

    def component(self, number: int) -> ZeroSetComponent:
        """Give one component."""
        chains, rows, cells = self.links.chains, self.chains[number], self.cells[number]
        arcs = tuple(chains.of(i) for i in rows.tolist())
        loops = tuple(chains.closed[rows].tolist())
        joints = self._ends(arcs, loops)
        ends = tuple(END_KINDS[i] for i in self.links.landings.kind[joints].tolist())
        touched = [self.patch[one] for one in arcs] + [self.cell_patch[cells]]
        return ZeroSetComponent(
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

    def _tags(self, clusters: IntArray, ends: tuple[LineEndKind, ...]) -> tuple[str, ...]:
        """Tell what is special of a component."""
        tags = [name for name, marked in self.marks.items() if marked[clusters].any()]
        return (*tags, "knot-line") if LineEndKind.KNOT_LINE in ends else tuple(tags)


def _kind(loops: tuple[bool, ...], ends: tuple[LineEndKind, ...]) -> ComponentKind:
    """Tell what a component is."""
    if not loops:
        return ComponentKind.ISOLATED
    if LineEndKind.JUNCTION in ends:
        return ComponentKind.JUNCTION
    return ComponentKind.CLOSED if all(loops) else ComponentKind.OPEN


# --------------------------------------------------------------------------------------
# Edge lines: no arc runs along an edge on which the polynomial is zero, the cells end at it.

# The corners at both ends of each side: u = 0, u = 1, v = 0, v = 1.
_CORNERS = np.array([[[0, 0], [0, 1]], [[1, 0], [1, 1]], [[0, 0], [1, 0]], [[0, 1], [1, 1]]])


def edge_components(
    patches: Patches, lattice: Lattice, cells: SignCells, edges: NDArray[np.bool_]
) -> tuple[ZeroSetComponent, ...]:
    """Join edges (k, 4) along which the polynomial is zero.

    An edge that two patches share is that of the first. Left aside are edges where it is zero in
    the cells along the edge as well, or of the other patch.
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
    label = connected_labels(count + int(corner.max(initial=-1)) + 1, pairs)[:count]
    return tuple(
        _component(patches, patch[rows], side[rows], corner[rows])
        for rows in rows_by_label(label, int(label.max(initial=-1)) + 1)
    )


def _flat(cells: SignCells, count: int) -> NDArray[np.bool_]:
    """Tell along which sides of patches the polynomial is zero in every cell, (k, 4)."""
    zero = cells.kind == CellKind.ZERO
    found = np.zeros((count, 4), bool)
    for side, (axis, value) in enumerate(SIDES):
        at = cells.box[:, axis, int(value)] == value
        other = np.bincount(cells.patch[at & ~zero], minlength=count)
        found[:, side] = other == 0
    return found


def _component(
    patches: Patches, patch: IntArray, side: IntArray, corner: IntArray
) -> ZeroSetComponent:
    """Put one edge line together; its ends are the corners where a single edge of it ends."""
    uses = np.bincount(corner.reshape(-1))[corner]
    row, which = np.nonzero(uses == 1)
    ends = patches.parameters(patch[row], _CORNERS[side[row], which].astype(np.float64))
    nothing = np.zeros(0, np.intp)
    return ZeroSetComponent(
        ComponentKind.EDGE_LINE, (), (), nothing, np.stack([patch, side], axis=1),
        np.unique(patch), ends, (LineEndKind.BORDER,) * len(ends), (),
    )  # fmt: skip


def edge_points(patches: Patches, edges: IntArray) -> FloatArray:
    """Give the parameters (e, 2, 2), on the surface, of both corners of edges (e, 2)."""
    uv = _CORNERS[edges[:, 1]].astype(np.float64).reshape(-1, 2)
    return patches.parameters(np.repeat(edges[:, 0], 2), uv).reshape(-1, 2, 2)


# --------------------------------------------------------------------------------------
# Joining. An end that is left alone lies on the border of its surface, or on undecided or zero
# cells, or on a border of patches where the curvature jumps; if none of these, it is an error.
# Source: joining along shared edges, by changes of sign there, follows "Curvature Region Analysis
# for Application of Plates Forming", J. SNAK; what ends may meet, and undecided cells, are our own.


def join_arcs(
    patches: Patches, cells: SignCells, arcs: ZeroSetArcs, edges: NDArray[np.bool_] | None = None
) -> tuple[ZeroSetComponent, ...]:
    """Join arcs into components.

    Parameters
    ----------
    patches : Patches
        The patches of any number of surfaces; those of one surface are joined with one another.
    cells, arcs : SignCells, ZeroSetArcs
        The cells of these patches, and the arcs in the cells.
    edges : (k, 4) bool, optional
        On which sides of each patch (u = 0, u = 1, v = 0, v = 1) the polynomial is zero.

    Returns
    -------
    tuple of ZeroSetComponent
        Lines in the order of their first arcs, then isolated cells, then edge lines.

    Raises
    ------
    DanglingArcError
        If a line breaks off inside a patch, at nothing that explains it.
    """
    lattice = Lattice.of(patches.surface, patches.box)
    links = ZeroSetLinks.of(lattice, cells, arcs)
    links.check(patches)
    found = _components(patches, cells, arcs, links)
    return found if edges is None else found + edge_components(patches, lattice, cells, edges)


def _components(
    patches: Patches, cells: SignCells, arcs: ZeroSetArcs, links: ZeroSetLinks
) -> tuple[ZeroSetComponent, ...]:
    """Put together what hangs together."""
    label, cluster_label, count = _labels(links)
    parts = ComponentParts.of(patches, cells, arcs, links, label, cluster_label, count)
    return tuple(parts.component(i) for i in range(count))


def _labels(links: ZeroSetLinks) -> tuple[IntArray, IntArray, int]:
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
    label = connected_labels(arcs + count + len(links.passed), np.concatenate(pairs))
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

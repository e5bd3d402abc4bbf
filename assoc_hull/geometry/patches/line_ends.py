"""What the ends of lines lead to: other arcs, undecided cells, borders, gaps.

A line may run unseen along the border of cells, where the polynomial is zero within its error.
Such gaps are followed from end to end, so that a line is not reported as broken.
`ZeroSetLinks` says for every arc what it meets at both ends, and which arc goes on.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import DanglingArcError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.adjacency import Lattice, connected_labels
from assoc_hull.geometry.patches.arc_chains import (
    ArcChains,
    ArcJoints,
    chain_arcs,
    directed_ends,
    find_joints,
    next_pieces,
)
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cell_borders import (
    SHORT,
    cells_of_both_signs,
    cells_without_arc,
    region_borders,
    shared_borders,
)
from assoc_hull.geometry.patches.cells import CellKind, SignCells, ZeroSetArcs
from assoc_hull.geometry.patches.clusters import Clusters, find_clusters

__all__ = [
    "JUNCTION",
    "NOWHERE",
    "BorderGaps",
    "JointPoints",
    "LineEnds",
    "ZeroSetLinks",
    "borders_without_arcs",
    "find_gaps",
]

# Gaps. A cell counts as positive where no coefficient lies below its error, so a line may run in it
# where the polynomial is no larger than that. There an arc breaks off, and positive and negative
# cells have a border with no arc between them: the line runs along it, as far as anyone can tell.


def borders_without_arcs(
    cells: SignCells, lattice: Lattice, arc_of: IntArray, ends: FloatArray
) -> FloatArray:
    """Give the borders (p, 2, 2) of positive and negative cells that no arc runs along.

    They are walked with the positive side on the left, in the lattice, as arcs are between their
    `ends` (a, 2, 2); `arc_of` (c,) is the arc in each cell, or -1. Cells that lack an arc which
    must be there are left out: that is no gap, but an error.
    """
    kept, rows = np.ones(len(cells), bool), cells_without_arc(cells, arc_of)
    kept[rows] = ~cells_of_both_signs(cells, rows)
    cells, arc_of = _some(cells, np.flatnonzero(kept)), arc_of[kept]
    positive = region_borders(cells, lattice, CellKind.POSITIVE, arc_of, ends)
    return shared_borders(positive, region_borders(cells, lattice, CellKind.NEGATIVE, arc_of, ends))


@attrs.frozen(eq=False)
class BorderGaps:
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


def find_gaps(
    lattice: Lattice, cells: SignCells, clusters: Clusters, arc_patch: IntArray, arc_of: IntArray,
    ends: FloatArray, lost: NDArray[np.bool_],
) -> BorderGaps:  # fmt: skip
    """Find what ends that break off lead to.

    Parameters
    ----------
    lattice, cells, clusters : Lattice, SignCells, Clusters
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
    BorderGaps
        What they lead to.
    """
    troubled = np.unique(arc_patch[lost.any(axis=1)])
    rows = np.flatnonzero(np.isin(cells.patch, troubled))
    pieces = borders_without_arcs(_some(cells, rows), lattice, arc_of[rows], ends)
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
    label = connected_labels(count + chains + len(clusters), joined)
    border = lattice.borders(chain_ends.reshape(-1, 2))
    return _numbered(label, count, chains, np.stack([chain, border], axis=1))


def _of(values: IntArray, rows: IntArray) -> IntArray:
    """Give the values of rows, -1 for row -1."""
    return np.append(values, -1)[rows]


def _some(cells: SignCells, rows: IntArray) -> SignCells:
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
    following = next_pieces(items, along, along)
    after = following[count:]
    chains = chain_arcs(np.where(after >= count, after - count, -1))
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


def _numbered(label: IntArray, count: int, chains: int, borders: IntArray) -> BorderGaps:
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
    return BorderGaps(number[mine], number[theirs], np.where(number[mine] < 0, reached[mine], -1))


# --------------------------------------------------------------------------------------
# Line ends: borders of surfaces or patches, undecided cells, other lines.

# What an end is, by number, in the order of `END_KINDS`; NOWHERE stands for none of them.
_BORDER, _KNOT_LINE, JUNCTION, NOWHERE = range(4)


@attrs.frozen(eq=False)
class JointPoints:
    """Joints as points.

    Attributes
    ----------
    patch : (j,) int
        The patch on which the first end of each joint was found.
    uv : (j, 2)
        Where it lies on that patch.
    place : (j, 2)
        Where it lies in the lattice.
    """

    patch: IntArray
    uv: FloatArray
    place: FloatArray


@attrs.frozen(eq=False)
class LineEnds:
    """What lines end at, joint by joint.

    Attributes
    ----------
    kind : (j,) int
        What an end is that lies there: a number of `END_KINDS`, or `NOWHERE`.
    clusters : Clusters
        Undecided and zero cells.
    cluster : (j,) int
        The cluster at which a line ends, or -1. Ends that lead to one another over a gap have a
        number of their own, behind those of `clusters`.
    over_gaps : (n,) bool
        Clusters to which lines lead over gaps.
    """

    kind: IntArray
    clusters: Clusters
    cluster: IntArray
    over_gaps: NDArray[np.bool_]

    @classmethod
    def of(
        cls,
        lattice: Lattice,
        cells: SignCells,
        arcs: ZeroSetArcs,
        joints: ArcJoints,
        points: JointPoints,
    ) -> LineEnds:
        """Find out what ends meet; where that is nothing, look into gaps."""
        clusters = find_clusters(cells, lattice, points.place[joints.free])
        cluster = np.full(len(joints), -1)
        cluster[joints.free] = clusters.at_point
        kind = _kinds(joints, lattice, points)
        kind[cluster >= 0] = JUNCTION
        found = cls(kind, clusters, cluster, np.zeros(len(clusters), bool))
        lost = joints.free & (kind == NOWHERE)
        if lost.any():
            found = found._over_gaps(lattice, cells, arcs, joints, points, lost)
        return found._on_borders(lattice, cells, joints)

    @property
    def leads_on(self) -> NDArray[np.bool_]:
        """Clusters (n,) through which a line goes on if it is the only one there."""
        found = np.ones(len(self.over_gaps), bool)
        found[: len(self.clusters)] = self.clusters.regular | self.clusters.narrow
        return found

    def _over_gaps(
        self,
        lattice: Lattice,
        cells: SignCells,
        arcs: ZeroSetArcs,
        joints: ArcJoints,
        points: JointPoints,
        lost: NDArray[np.bool_],
    ) -> LineEnds:
        """Give what ends meet when gaps are followed."""
        arc_of = np.full(len(cells), -1)
        arc_of[arcs.cell] = np.arange(len(arcs))
        lost_ends = lost[joints.joint] & ~joints.short[:, None]
        ends, patch = points.place[joints.joint], cells.patch[arcs.cell]
        gaps = find_gaps(lattice, cells, self.clusters, patch, arc_of, ends, lost_ends)
        at = joints.joint[lost_ends]
        cluster = np.append(gaps.number, -1)[self.cluster]
        cluster[at] = gaps.cluster
        kind = self.kind.copy()
        kind[at] = np.where(gaps.border >= 0, gaps.border, NOWHERE)
        kind[cluster >= 0] = JUNCTION
        clusters = self.clusters.merged(gaps.number)
        over_gaps = np.zeros(max(len(clusters), int(cluster.max(initial=-1)) + 1), bool)
        over_gaps[gaps.cluster[gaps.cluster >= 0]] = True
        return LineEnds(kind, clusters, cluster, over_gaps)

    def _on_borders(self, lattice: Lattice, cells: SignCells, joints: ArcJoints) -> LineEnds:
        """Let a line that is the only one at a small cluster on a border end on that border."""
        count = len(self.clusters)
        at = np.flatnonzero((self.cluster >= 0) & (self.cluster < count))
        lines = np.bincount(self.cluster[at], (joints.heads + joints.tails)[at], minlength=count)
        border = _borders(lattice, cells, self.clusters)
        border[(lines != 1) | ~self.clusters.small] = -1
        kind = self.kind.copy()
        kind[at] = np.where(border[self.cluster[at]] >= 0, border[self.cluster[at]], kind[at])
        return LineEnds(kind, self.clusters, self.cluster, self.over_gaps)


def _borders(lattice: Lattice, cells: SignCells, clusters: Clusters) -> IntArray:
    """Tell on which border each cluster lies: that of a surface, that of patches, or -1."""
    patch, box = cells.patch[clusters.cell], cells.box[clusters.cell]
    sides = lattice.sides(box[:, :, 0]) | lattice.sides(box[:, :, 1])
    found = np.full(len(clusters), -1)
    inner, outer = sides & lattice.neighbours[patch], sides & ~lattice.neighbours[patch]
    found[clusters.cluster[inner.any(axis=1)]] = _KNOT_LINE
    found[clusters.cluster[outer.any(axis=1)]] = _BORDER
    return found


def _kinds(joints: ArcJoints, lattice: Lattice, points: JointPoints) -> IntArray:
    """Tell what an end is that lies at each joint, by its place alone."""
    sides, neighbours = lattice.sides(points.uv), lattice.neighbours[points.patch]
    outer, inner = (sides & ~neighbours).any(axis=1), (sides & neighbours).any(axis=1)
    kind = np.where(outer, _BORDER, np.where(inner, _KNOT_LINE, NOWHERE))
    # Two lines that end at one point of a border of patches met there by chance.
    chance = inner & (joints.heads + joints.tails == 2)
    kind[joints.meeting & ~chance] = JUNCTION
    return kind


@attrs.frozen(eq=False)
class ZeroSetLinks:
    """Arcs with what they meet.

    Attributes
    ----------
    joints : ArcJoints
        Where arcs begin and end.
    points : JointPoints
        Where joints lie.
    landings : LineEnds
        What lines end at.
    passed : (n,) bool
        Clusters through which a single line leads.
    following : (a,) int
        The arc that goes on where each ends, or -1.
    chains : ArcChains
        Arcs in order.
    """

    joints: ArcJoints
    points: JointPoints
    landings: LineEnds
    passed: NDArray[np.bool_]
    following: IntArray
    chains: ArcChains

    @classmethod
    def of(cls, lattice: Lattice, cells: SignCells, arcs: ZeroSetArcs) -> ZeroSetLinks:
        """Find out what meets."""
        ends, patch = directed_ends(arcs).reshape(-1, 2), np.repeat(cells.patch[arcs.cell], 2)
        places = lattice.place(patch, ends)
        joints = find_joints(places.reshape(-1, 2, 2))
        points = JointPoints(patch[joints.first], ends[joints.first], places[joints.first])
        found = LineEnds.of(lattice, cells, arcs, joints, points)
        passed = found.leads_on & _one_each(joints, found.cluster, len(found.over_gaps))
        following = _following(joints, found.cluster, passed)
        return cls(joints, points, found, passed, following, chain_arcs(following))

    def check(self, patches: Patches) -> None:
        """Refuse ends that nothing explains."""
        lost = np.flatnonzero(self.joints.free & (self.landings.kind == NOWHERE))
        if not len(lost):
            return
        first, points = lost[:1], self.points
        patch = int(points.patch[first[0]])
        apart = np.abs(points.place - points.place[first]).max(axis=1)
        apart[first] = np.inf
        u, v = patches.parameters(points.patch[first], points.uv[first])[0].tolist()
        surface = int(patches.surface[patch])
        raise DanglingArcError(len(lost), surface, patch, (u, v), float(apart.min()))


def _one_each(joints: ArcJoints, cluster: IntArray, count: int) -> NDArray[np.bool_]:
    """Tell at which clusters one line ends and one begins."""
    at = cluster >= 0
    heads = np.bincount(cluster[at], joints.heads[at], minlength=count)
    tails = np.bincount(cluster[at], joints.tails[at], minlength=count)
    return np.asarray((heads == 1) & (tails == 1))


def _following(joints: ArcJoints, cluster: IntArray, passed: NDArray[np.bool_]) -> IntArray:
    """Give the arc that goes on where each ends, or -1."""
    count = len(joints)
    # Where a line passes through a cluster, its two joints are one.
    at = cluster >= 0
    at[at] = passed[cluster[at]]
    met = np.where(at, count + cluster, np.arange(count))
    open_to = joints.through | at
    tail, head = joints.joint.T
    starts = np.full(count + len(passed), -1)
    real = np.flatnonzero((tail != head) & open_to[tail])
    starts[met[tail[real]]] = real
    return np.asarray(np.where((tail != head) & open_to[head], starts[met[head]], -1))

"""What lines within patches lead to, and how their arcs are joined.

A line may run unseen along the border of cells, where the polynomial is zero within its error.
Such gaps are followed from end to end, so that a line is not reported as broken.
`ZeroSetLinks` says for every arc what it meets at both ends, and which arc goes on.

Ends of arcs that coincide, arcs in a row, and pieces joined into loops.

Arcs are walked with the positive side on the left, so an end of one begins the next.
Where several loops touch in a point, each keeps to its own side.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from assoc_hull.errors import DanglingArcError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cells import (
    SHORT,
    CellKind,
    Lattice,
    SignCells,
    ZeroSetArcs,
    cells_of_both_signs,
    cells_without_arc,
    connected_labels,
    region_borders,
    shared_borders,
)
from assoc_hull.geometry.patches.clusters import Clusters, find_clusters

__all__ = [
    "JUNCTION",
    "NOWHERE",
    "ArcChains",
    "ArcJoints",
    "BorderGaps",
    "JointPoints",
    "LineEnds",
    "ZeroSetLinks",
    "borders_without_arcs",
    "chain_arcs",
    "directed_ends",
    "find_gaps",
    "find_joints",
    "next_pieces",
    "positive_on_left",
]


@attrs.frozen(eq=False)
class ArcJoints:
    """Points where arcs begin and end.

    Attributes
    ----------
    joint : (a, 2) int
        Where each arc begins and where it ends.
    first : (j,) int
        The first end of each joint: arc * 2 for a beginning, arc * 2 + 1 for an end.
    heads, tails : (j,) int
        How many arcs end and begin there. An arc that is shorter than the tolerance, so that
        both its ends are one joint, does neither.
    """

    joint: IntArray
    first: IntArray
    heads: IntArray
    tails: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.joint, self.first, self.heads, self.tails)

    @classmethod
    def numbered(cls, joint: IntArray) -> Self:
        """Count what meets where, of the numbers of joints at both ends (a, 2)."""
        flat, count = joint.reshape(-1), int(joint.max(initial=-1)) + 1
        first = np.full(count, len(flat))
        np.minimum.at(first, flat, np.arange(len(flat)))
        long = joint[joint[:, 0] != joint[:, 1]]
        heads = np.bincount(long[:, 1], minlength=count)
        return cls(joint, first, heads, np.bincount(long[:, 0], minlength=count))

    def __len__(self) -> int:
        """Count the joints."""
        return len(self.first)

    @property
    def through(self) -> NDArray[np.bool_]:
        """Where one arc ends and one begins, (j,)."""
        return np.asarray((self.heads == 1) & (self.tails == 1))

    @property
    def free(self) -> NDArray[np.bool_]:
        """Where a single arc ends or begins, (j,)."""
        return np.asarray(self.heads + self.tails == 1)

    @property
    def short(self) -> NDArray[np.bool_]:
        """Which arcs (a,) are shorter than the tolerance."""
        return np.asarray(self.joint[:, 0] == self.joint[:, 1])

    @property
    def meeting(self) -> NDArray[np.bool_]:
        """Where arcs meet that are not each other's continuation, (j,)."""
        return np.asarray((self.heads + self.tails > 1) & ~self.through)


def find_joints(places: FloatArray, tolerance: float = 1e-9) -> ArcJoints:
    """Find which ends coincide, within `tolerance` in each parameter, by their places (a, 2, 2).

    Joints are numbered by their first ends.
    """
    ends = places.reshape(-1, 2)
    pairs = cKDTree(ends).query_pairs(tolerance, p=np.inf, output_type="ndarray")
    return ArcJoints.numbered(connected_labels(len(ends), pairs).reshape(-1, 2))


@attrs.frozen(eq=False)
class ArcChains:
    """Chains of arcs, one after the other.

    Attributes
    ----------
    arcs : (a,) int
        The arcs in the order in which they are walked, chain by chain.
    start : (c + 1,) int
        Chain i is ``arcs[start[i] : start[i + 1]]``.
    closed : (c,) bool
        Whether the last arc of a chain leads to its first.
    """

    arcs: IntArray
    start: IntArray
    closed: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.arcs, self.start, self.closed)

    def __len__(self) -> int:
        """Count the chains."""
        return len(self.closed)

    @property
    def firsts(self) -> IntArray:
        """The first arc of each chain."""
        return np.asarray(self.arcs[self.start[:-1]])

    @property
    def lasts(self) -> IntArray:
        """The last arc of each chain."""
        return np.asarray(self.arcs[self.start[1:] - 1])

    def of(self, chain: int) -> IntArray:
        """Give the arcs of one chain."""
        return self.arcs[self.start[chain] : self.start[chain + 1]]


def positive_on_left(arcs: ZeroSetArcs) -> NDArray[np.bool_]:
    """Tell which arcs (a,) have the positive side on the left as they run.

    With u to the right and v upward, an arc u = g(v) runs upward, and the larger u lie on its
    right; an arc v = g(u) runs to the right, and the larger v lie on its left.
    """
    return np.asarray(np.where(arcs.across == 0, ~arcs.rising, arcs.rising))


def directed_ends(arcs: ZeroSetArcs) -> FloatArray:
    """Give the ends (a, 2, 2) of arcs in the order in which they are walked."""
    return np.where(positive_on_left(arcs)[:, None, None], arcs.ends, arcs.ends[:, ::-1])


def chain_arcs(following: IntArray) -> ArcChains:
    """Put arcs in order, by the arc after each, (a,), or -1; none follows two.

    Chains come in the order of their least arcs; a closed one begins with its least arc.
    """
    count = len(following)
    arcs = np.arange(count)
    before = np.full(count, -1)
    has = following >= 0
    before[following[has]] = arcs[has]
    chain = connected_labels(count, np.stack([arcs[has], following[has]], axis=1))
    least = np.unique(chain, return_index=True)[1]
    closed = np.bincount(chain[before < 0], minlength=len(least)) == 0
    before[least[closed]] = -1
    order = np.lexsort([_ranks(before), chain])
    start = np.searchsorted(chain[order], np.arange(len(least) + 1))
    return ArcChains(order, start, closed)


def _ranks(before: IntArray) -> IntArray:
    """Count the arcs that come before each, up to the one that has none.

    By doubling: in log2(n) passes over all arcs at once.
    """
    rank = (before >= 0).astype(np.intp)
    jump = np.where(before >= 0, before, np.arange(len(before)))
    while True:
        further = rank[jump]
        if not further.any():
            return rank
        rank = rank + further
        jump = jump[jump]


def next_pieces(pieces: FloatArray, leaving: FloatArray, arriving: FloatArray) -> IntArray:
    """Give the piece (p,) that begins where each of some pieces (p, 2, 2) ends, or -1.

    What pieces bound lies on their left; `leaving`, `arriving` (p, 2) are the directions at the
    beginning and at the end. Where several loops touch in a point, a piece is followed by the one
    that bounds the same sector.
    """
    tail, head = find_joints(pieces, SHORT).joint.T
    count, rows = len(pieces), np.arange(len(pieces))
    # Round each point, counter-clockwise: the sector between a piece that leaves and the next
    # that arrives is what both bound.
    out = np.arctan2(leaving[:, 1], leaving[:, 0])
    back = np.arctan2(-arriving[:, 1], -arriving[:, 0])
    joint, angle = np.concatenate([tail, head]), np.concatenate([out, back])
    arrives = np.repeat([0, 1], count)
    order = np.lexsort([1 - arrives, angle, joint])
    joint, piece, arrives = joint[order], np.tile(rows, 2)[order], arrives[order]
    starts = np.searchsorted(joint, joint)
    stops = np.searchsorted(joint, joint, side="right")
    here = np.arange(2 * count)
    before = np.where(here > starts, here - 1, stops - 1)
    found = np.full(count, -1)
    paired = (arrives == 1) & (arrives[before] == 0)
    found[piece[paired]] = piece[before[paired]]
    return _matched(found, piece, arrives, joint)


def _matched(found: IntArray, piece: IntArray, arrives: IntArray, joint: IntArray) -> IntArray:
    """Match what angles left over, point by point, in order."""
    taken = np.zeros(len(found), bool)
    taken[found[found >= 0]] = True
    late = (arrives == 1) & (found[piece] < 0)
    free = (arrives == 0) & ~taken[piece]
    both = np.intersect1d(joint[late], joint[free])
    for one in both.tolist():
        ends, begins = piece[late & (joint == one)], piece[free & (joint == one)]
        pairs = min(len(ends), len(begins))
        found[ends[:pairs]] = begins[:pairs]
    return found


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

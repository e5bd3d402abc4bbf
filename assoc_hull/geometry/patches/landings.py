"""What lines end at: borders of surfaces or patches, undecided cells, other lines.

Examples
--------
>>> from assoc_hull.geometry.patches.landings import END_KINDS
>>> [kind.value for kind in END_KINDS]
['border', 'knot-line', 'junction']
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.clusters import Clusters, clusters_of
from assoc_hull.geometry.patches.components import EndKind
from assoc_hull.geometry.patches.gaps import gaps_of
from assoc_hull.geometry.patches.joints import Joints
from assoc_hull.geometry.patches.lattice import Lattice

__all__ = ["END_KINDS", "JUNCTION", "NOWHERE", "Landings", "Points"]

# What an end is, by number; NOWHERE stands for none of them.
END_KINDS = (EndKind.BORDER, EndKind.KNOT_LINE, EndKind.JUNCTION)
_BORDER, _KNOT_LINE, JUNCTION, NOWHERE = range(4)


@attrs.frozen(eq=False)
class Points:
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
class Landings:
    """What lines end at, joint by joint.

    Attributes
    ----------
    kind : (j,) int
        What an end is that lies there: a number of `END_KINDS`, or `NOWHERE`.
    clusters : Clusters
        Undecided and nil cells.
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
        cls, lattice: Lattice, cells: Cells, arcs: Arcs, joints: Joints, points: Points
    ) -> Landings:
        """Find out what ends meet; where that is nothing, look into gaps."""
        clusters = clusters_of(cells, lattice, points.place[joints.free])
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
        self, lattice: Lattice, cells: Cells, arcs: Arcs, joints: Joints, points: Points,
        lost: NDArray[np.bool_],
    ) -> Landings:  # fmt: skip
        """Give what ends meet when gaps are followed."""
        arc_of = np.full(len(cells), -1)
        arc_of[arcs.cell] = np.arange(len(arcs))
        lost_ends = lost[joints.joint] & ~joints.short[:, None]
        ends, patch = points.place[joints.joint], cells.patch[arcs.cell]
        gaps = gaps_of(lattice, cells, self.clusters, patch, arc_of, ends, lost_ends)
        at = joints.joint[lost_ends]
        cluster = np.append(gaps.number, -1)[self.cluster]
        cluster[at] = gaps.cluster
        kind = self.kind.copy()
        kind[at] = np.where(gaps.border >= 0, gaps.border, NOWHERE)
        kind[cluster >= 0] = JUNCTION
        clusters = self.clusters.merged(gaps.number)
        over_gaps = np.zeros(max(len(clusters), int(cluster.max(initial=-1)) + 1), bool)
        over_gaps[gaps.cluster[gaps.cluster >= 0]] = True
        return Landings(kind, clusters, cluster, over_gaps)

    def _on_borders(self, lattice: Lattice, cells: Cells, joints: Joints) -> Landings:
        """Let a line that is the only one at a small cluster on a border end on that border."""
        count = len(self.clusters)
        at = np.flatnonzero((self.cluster >= 0) & (self.cluster < count))
        lines = np.bincount(self.cluster[at], (joints.heads + joints.tails)[at], minlength=count)
        border = _borders(lattice, cells, self.clusters)
        border[(lines != 1) | ~self.clusters.small] = -1
        kind = self.kind.copy()
        kind[at] = np.where(border[self.cluster[at]] >= 0, border[self.cluster[at]], kind[at])
        return Landings(kind, self.clusters, self.cluster, self.over_gaps)


def _borders(lattice: Lattice, cells: Cells, clusters: Clusters) -> IntArray:
    """Tell on which border each cluster lies: that of a surface, that of patches, or -1."""
    patch, box = cells.patch[clusters.cell], cells.box[clusters.cell]
    sides = lattice.sides(box[:, :, 0]) | lattice.sides(box[:, :, 1])
    found = np.full(len(clusters), -1)
    inner, outer = sides & lattice.neighbours[patch], sides & ~lattice.neighbours[patch]
    found[clusters.cluster[inner.any(axis=1)]] = _KNOT_LINE
    found[clusters.cluster[outer.any(axis=1)]] = _BORDER
    return found


def _kinds(joints: Joints, lattice: Lattice, points: Points) -> IntArray:
    """Tell what an end is that lies at each joint, by its place alone."""
    sides, neighbours = lattice.sides(points.uv), lattice.neighbours[points.patch]
    outer, inner = (sides & ~neighbours).any(axis=1), (sides & neighbours).any(axis=1)
    kind = np.where(outer, _BORDER, np.where(inner, _KNOT_LINE, NOWHERE))
    # Two lines that end at one point of a border of patches met there by chance.
    chance = inner & (joints.heads + joints.tails == 2)
    kind[joints.meeting & ~chance] = JUNCTION
    return kind

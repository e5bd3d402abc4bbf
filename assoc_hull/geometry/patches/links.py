"""What the ends of arcs meet: other arcs, undecided cells, borders; and which arc goes on where.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.links import on_surface
>>> from assoc_hull.geometry.patches.patches import Patches
>>> patches = Patches(np.zeros((1, 2, 2, 3)), np.array([[[2.0, 4.0], [0.0, 1.0]]]), np.array([0]))
>>> on_surface(patches, np.array([0]), np.array([[0.5, 0.5]]))
array([[3. , 0.5]])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import DanglingArcError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.chains import Chains, chained, directed
from assoc_hull.geometry.patches.clusters import Clusters, clusters_of
from assoc_hull.geometry.patches.components import EndKind
from assoc_hull.geometry.patches.joints import Joints, joints_of
from assoc_hull.geometry.patches.lattice import Lattice
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["END_KINDS", "Links", "on_surface"]

# What an end is, by number; the last stands for none of them.
END_KINDS = (EndKind.BORDER, EndKind.KNOT_LINE, EndKind.JUNCTION)
_BORDER, _KNOT_LINE, _JUNCTION, _DANGLING = range(4)


@attrs.frozen(eq=False)
class Links:
    """Arcs with what they meet.

    Attributes
    ----------
    joints : Joints
        Where arcs begin and end.
    patch : (j,) int
        The patch on which the first end of each joint was found.
    uv : (j, 2)
        Where it lies on that patch.
    place : (j, 2)
        Where it lies in the lattice.
    cluster : (j,) int
        The cluster that a joint touches at which a line ends, or -1.
    kind : (j,) int
        What an end is that lies there.
    clusters : Clusters
        Undecided and nil cells.
    passed : (n,) bool
        Which clusters one line passes through for certain.
    following : (a,) int
        The arc that goes on where each ends, or -1.
    chains : Chains
        Arcs in order.
    """

    joints: Joints
    patch: IntArray
    uv: FloatArray
    place: FloatArray
    cluster: IntArray
    kind: IntArray
    clusters: Clusters
    passed: NDArray[np.bool_]
    following: IntArray
    chains: Chains

    @property
    def is_junction(self) -> NDArray[np.bool_]:
        """At which joints lines of one component meet, (j,)."""
        return np.asarray(self.kind == _JUNCTION)

    @classmethod
    def of(cls, lattice: Lattice, cells: Cells, arcs: Arcs) -> Links:
        """Find out what meets."""
        ends, patch = directed(arcs), np.repeat(cells.patch[arcs.cell], 2)
        places = lattice.place(patch, ends.reshape(-1, 2))
        joints = joints_of(places.reshape(-1, 2, 2))
        patch, uv = patch[joints.first], ends.reshape(-1, 2)[joints.first]
        place = places[joints.first]
        cluster = np.full(len(joints), -1)
        clusters = clusters_of(cells, lattice, place[joints.free])
        cluster[joints.free] = clusters.at_point
        passed = clusters.regular & _one_each(joints, cluster, len(clusters))
        following = _following(joints, cluster, passed)
        kind = _end_kinds(joints, cluster, lattice, patch, uv)
        chains = chained(following)
        return cls(joints, patch, uv, place, cluster, kind, clusters, passed, following, chains)

    def check(self, patches: Patches, lattice: Lattice) -> None:
        """Refuse ends that nothing explains."""
        lost = np.flatnonzero(self.joints.free & (self.kind == _DANGLING))
        if not len(lost):
            return
        one = lost[0]
        patch = int(self.patch[one])
        apart = np.abs(self.place - self.place[one]).max(axis=1)
        apart[one] = np.inf
        u, v = on_surface(patches, self.patch[lost[:1]], self.uv[lost[:1]])[0].tolist()
        surface = int(patches.surface[patch])
        raise DanglingArcError(len(lost), surface, patch, (u, v), float(apart.min()))


def on_surface(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Give the parameters (n, 2) on the surface of points that lie on some patches."""
    low, high = patches.box[patch, :, 0], patches.box[patch, :, 1]
    # Both ends of a span are met to the last bit, so that patches agree on their border.
    return np.asarray((1.0 - uv) * low + uv * high)


def _one_each(joints: Joints, cluster: IntArray, count: int) -> NDArray[np.bool_]:
    """Tell at which clusters one line ends and one begins."""
    at = cluster >= 0
    heads = np.bincount(cluster[at], joints.heads[at], minlength=count)
    tails = np.bincount(cluster[at], joints.tails[at], minlength=count)
    return np.asarray((heads == 1) & (tails == 1))


def _following(joints: Joints, cluster: IntArray, passed: NDArray[np.bool_]) -> IntArray:
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


def _end_kinds(
    joints: Joints, cluster: IntArray, lattice: Lattice, patch: IntArray, uv: FloatArray
) -> IntArray:
    """Tell what an end is that lies at each joint."""
    sides = lattice.sides(uv)
    outer = (sides & ~lattice.neighbours[patch]).any(axis=1)
    inner = (sides & lattice.neighbours[patch]).any(axis=1)
    kind = np.where(outer, _BORDER, np.where(inner, _KNOT_LINE, _DANGLING))
    # Two lines that end at one point of a border of patches met there by chance.
    chance = inner & (joints.heads + joints.tails == 2)
    kind[joints.meeting & ~chance] = _JUNCTION
    kind[cluster >= 0] = _JUNCTION
    return kind

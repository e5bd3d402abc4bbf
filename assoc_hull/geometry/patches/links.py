"""What the ends of arcs meet: other arcs, undecided cells, borders; and which arc goes on where.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.cells import Arcs, CellKind, Cells
>>> from assoc_hull.geometry.patches.lattice import Lattice
>>> from assoc_hull.geometry.patches.links import Links
>>> zero, none = np.array([0]), np.zeros((0, 2, 2))
>>> whole, kind = np.array([[[0.0, 1.0]] * 2]), np.array([CellKind.U_SIMPLE])
>>> cells = Cells(zero, whole, zero, kind, zero, none, none, zero > 0)
>>> ends = np.array([[[0.5, 0.0], [0.5, 1.0]]])
>>> arcs = Arcs(zero, zero, np.array([[0.0, 1.0]]), ends, zero == 0)
>>> Links.of(Lattice.apart(1), cells, arcs).points.uv.tolist()
[[0.5, 1.0], [0.5, 0.0]]
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import DanglingArcError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.chains import Chains, chained, directed
from assoc_hull.geometry.patches.joints import Joints, joints_of
from assoc_hull.geometry.patches.landings import NOWHERE, Landings, Points
from assoc_hull.geometry.patches.lattice import Lattice
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["Links"]


@attrs.frozen(eq=False)
class Links:
    """Arcs with what they meet.

    Attributes
    ----------
    joints : Joints
        Where arcs begin and end.
    points : Points
        Where joints lie.
    landings : Landings
        What lines end at.
    passed : (n,) bool
        Clusters through which a single line leads.
    following : (a,) int
        The arc that goes on where each ends, or -1.
    chains : Chains
        Arcs in order.
    """

    joints: Joints
    points: Points
    landings: Landings
    passed: NDArray[np.bool_]
    following: IntArray
    chains: Chains

    @classmethod
    def of(cls, lattice: Lattice, cells: Cells, arcs: Arcs) -> Links:
        """Find out what meets."""
        ends, patch = directed(arcs).reshape(-1, 2), np.repeat(cells.patch[arcs.cell], 2)
        places = lattice.place(patch, ends)
        joints = joints_of(places.reshape(-1, 2, 2))
        points = Points(patch[joints.first], ends[joints.first], places[joints.first])
        found = Landings.of(lattice, cells, arcs, joints, points)
        passed = found.leads_on & _one_each(joints, found.cluster, len(found.over_gaps))
        following = _following(joints, found.cluster, passed)
        return cls(joints, points, found, passed, following, chained(following))

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

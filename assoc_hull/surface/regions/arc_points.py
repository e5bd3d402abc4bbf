"""Points along the arcs of patches, kept with what else is known of each patch.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.surface.regions.arc_points import ArcPoints
>>> place = np.array([[0.0, 0.5], [1.0, 0.5], [0.5, 0.0], [0.5, 1.0]])
>>> points = ArcPoints(np.array([2, 2]), place, np.zeros((4, 3)))
>>> chosen = ArcPoints.gathered([points], np.array([0, 1]), np.array([1]))
>>> chosen.count.tolist(), chosen.place.tolist()
([2], [[0.5, 0.0], [0.5, 1.0]])
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.chains import forward
from assoc_hull.geometry.patches.gathering import rows_of
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.points import points
from assoc_hull.geometry.patches.sampling import sampled

__all__ = ["ArcPoints"]

_MIDDLE = 0.8
"""Of the tolerance: chords are judged by a point near their middle, not by the farthest one."""


@attrs.frozen(eq=False)
class ArcPoints:
    """Points of arcs, those of each in the direction of a walk with the greater K on the left.

    Attributes
    ----------
    count : (a,) int
        How many points each arc has; they lie one behind the other.
    place : (p, 2)
        Parameters of the patch, 0 to 1.
    xyz : (p, 3), m
        The points in space.
    """

    count: IntArray
    place: FloatArray
    xyz: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.count, self.place, self.xyz)

    @classmethod
    def of(cls, patches: Patches, cells: Cells, arcs: Arcs, chord_tol: float) -> Self:
        """Sample arcs as finely as a chord tolerance (m) wants."""
        start, place = sampled(patches, cells, arcs, _MIDDLE * chord_tol)
        count = np.diff(start)
        rows, arc = rows_of(count, np.arange(len(arcs)))
        last = start[arc] + start[arc + 1] - 1
        place = place[np.where(forward(arcs)[arc], rows, last - rows)]
        return cls(count, place, points(patches, cells.patch[arcs.cell][arc], place))

    @classmethod
    def gathered(cls, tables: Sequence[Self], patch: IntArray, chosen: IntArray) -> Self:
        """Give the points of chosen patches.

        Parameters
        ----------
        tables : sequence of ArcPoints
            Batches.
        patch : (a,) int
            The patch of each arc, numbered through all batches, rising.
        chosen : (k,) int
            Patches, numbered likewise, in the order they are wanted.
        """
        count = np.concatenate([each.count for each in tables])
        most = int(max(patch.max(initial=-1), chosen.max(initial=-1))) + 1
        arcs, _ = rows_of(np.bincount(patch, minlength=most), chosen)
        rows, _ = rows_of(count, arcs)
        place, xyz = (
            np.concatenate([getattr(t, name) for t in tables]) for name in ("place", "xyz")
        )
        return cls(count[arcs], place[rows], xyz[rows])

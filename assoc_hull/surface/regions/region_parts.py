"""What is kept of each patch: cells and arcs by level, areas; chosen and put in another order.

All of it depends on the control net of the patch and the options only, to the last bit. So it may
be taken from an earlier result wherever a patch has the same net.

Examples
--------
>>> from assoc_hull.surface.regions.region_parts import AREAS
>>> AREAS[:3]
('positive', 'negative', 'zero')
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.surface.regions.arc_points import ArcPoints
from assoc_hull.surface.regions.region_areas import RegionAreas

__all__ = ["AREAS", "RegionPart", "Solution"]

AREAS = tuple(field.name for field in attrs.fields(RegionAreas))
"""Names of the columns of areas."""


@attrs.frozen(eq=False)
class Solution:
    """Cells and arcs of all patches of a part, for one level.

    Attributes
    ----------
    level : float, 1/m2
        The Gaussian curvature.
    cells : Cells
        Where K exceeds the level, where it is below, where neither is known.
    arcs : Arcs
        Where it has this value.
    points : ArcPoints
        Points along the arcs.
    edges : (k, 4) bool
        Along which sides of each patch (u = 0, u = 1, v = 0, v = 1) it has this value.
    """

    level: float
    cells: Cells
    arcs: Arcs
    points: ArcPoints
    edges: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.edges)


@attrs.frozen(eq=False)
class RegionPart:
    """What is known of all patches of one bidegree.

    Attributes
    ----------
    patches : Patches
        The patches; `Patches.surface` numbers the surfaces of the result.
    number : (k,) int
        The numbers of the patches, counted through all surfaces of the result.
    solutions : tuple of Solution
        By level: those of the band, then the further ones.
    areas : (k, 8), m2
        Of each patch; the columns are `AREAS`.
    delta : (k,), m
        What a coordinate of a control point was taken to be off by.
    """

    patches: Patches
    number: IntArray
    solutions: tuple[Solution, ...]
    areas: FloatArray
    delta: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.number, self.areas, self.delta)

    def __len__(self) -> int:
        """Count the patches."""
        return len(self.number)

"""What is kept of each patch: cells and arcs by level, points along arcs, areas by sign.

All of it depends on the control net of the patch and the options only, to the last bit.
So a patch with the same net may be taken from an earlier result.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.arc_chains import positive_on_left
from assoc_hull.geometry.patches.bezier_patches import Patches, patch_points
from assoc_hull.geometry.patches.cells import SignCells, ZeroSetArcs, rows_of_groups
from assoc_hull.geometry.patches.zero_set_arcs import sample_arcs

__all__ = [
    "AREAS",
    "ArcPoints",
    "LevelSolution",
    "RegionAreas",
    "RegionPart",
]


@attrs.frozen
class RegionAreas:
    """Areas of regions, m2; the first four add up to the total, within the tolerance.

    Attributes
    ----------
    positive : float, m2
        Where K > K0 for certain.
    negative : float, m2
        Where K < -K0 for certain.
    zero : float, m2
        Where |K| <= K0; without a band, where K is zero to what the control points are known to.
    unresolved : float, m2
        Where the search ended; it may belong to any region.
    positive_estimate, negative_estimate : float, m2
        The areas with what samples give of the unresolved part; they need not lie within the
        error estimate.
    error_estimate : float, m2
        What quadrature may be off by, in any of the areas.
    total : float, m2
        The whole area, found by itself.
    """

    positive: float
    negative: float
    zero: float
    unresolved: float
    positive_estimate: float
    negative_estimate: float
    error_estimate: float
    total: float

    @classmethod
    def added(cls, rows: Iterable[Iterable[float]]) -> Self:
        """Add up rows of these eight numbers, exactly rounded: the order does not matter."""
        return cls(*(math.fsum(column) for column in zip(*rows, strict=True)))

    @property
    def positive_share(self) -> float:
        """The part of the total where K > K0, nan of no area."""
        return self._share(self.positive)

    @property
    def negative_share(self) -> float:
        """The part of the total where K < -K0, nan of no area."""
        return self._share(self.negative)

    @property
    def zero_share(self) -> float:
        """The part of the total where |K| <= K0, nan of no area."""
        return self._share(self.zero)

    @property
    def unresolved_share(self) -> float:
        """The part of the total that is not resolved, nan of no area."""
        return self._share(self.unresolved)

    def _share(self, area: float) -> float:
        return area / self.total if self.total > 0.0 else np.nan

    def __str__(self) -> str:
        """Give shares and the total in a line."""
        return (
            f"{self.total:.6g} m2: {100 * self.positive_share:.4g} % convex, "
            f"{100 * self.negative_share:.4g} % saddle, {100 * self.zero_share:.4g} % developable, "
            f"{100 * self.unresolved_share:.2g} % unresolved"
        )


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
    def of(cls, patches: Patches, cells: SignCells, arcs: ZeroSetArcs, chord_tol: float) -> Self:
        """Sample arcs as finely as a chord tolerance (m) wants."""
        start, place = sample_arcs(patches, cells, arcs, _MIDDLE * chord_tol)
        count = np.diff(start)
        rows, arc = rows_of_groups(count, np.arange(len(arcs)))
        last = start[arc] + start[arc + 1] - 1
        place = place[np.where(positive_on_left(arcs)[arc], rows, last - rows)]
        return cls(count, place, patch_points(patches, cells.patch[arcs.cell][arc], place))

    @classmethod
    def gathered(cls, tables: Sequence[Self], patch: IntArray, chosen: IntArray) -> Self:
        """Give the points of chosen patches, in their order, out of several batches.

        `patch` (a,) is the patch of each arc, rising; patches are numbered through all batches.
        """
        count = np.concatenate([each.count for each in tables])
        most = int(max(patch.max(initial=-1), chosen.max(initial=-1))) + 1
        arcs, _ = rows_of_groups(np.bincount(patch, minlength=most), chosen)
        rows, _ = rows_of_groups(count, arcs)
        place, xyz = (
            np.concatenate([getattr(t, name) for t in tables]) for name in ("place", "xyz")
        )
        return cls(count[arcs], place[rows], xyz[rows])


AREAS = tuple(field.name for field in attrs.fields(RegionAreas))
"""Names of the columns of areas."""


@attrs.frozen(eq=False)
class LevelSolution:
    """Cells and arcs of all patches of a part, for one level.

    Attributes
    ----------
    level : float, 1/m2
        The Gaussian curvature.
    cells : SignCells
        Where K exceeds the level, where it is below, where neither is known.
    arcs : ZeroSetArcs
        Where it has this value.
    points : ArcPoints
        Points along the arcs.
    edges : (k, 4) bool
        Along which sides of each patch (u = 0, u = 1, v = 0, v = 1) it has this value.
    """

    level: float
    cells: SignCells
    arcs: ZeroSetArcs
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
    solutions : tuple of LevelSolution
        By level: those of the band, then the further ones.
    areas : (k, 8), m2
        Of each patch; the columns are `AREAS`.
    delta : (k,), m
        What a coordinate of a control point was taken to be off by.
    """

    patches: Patches
    number: IntArray
    solutions: tuple[LevelSolution, ...]
    areas: FloatArray
    delta: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.number, self.areas, self.delta)

    def __len__(self) -> int:
        """Count the patches."""
        return len(self.number)

"""Areas of regions, of one surface or of many.

Examples
--------
>>> from assoc_hull.surface.regions.region_areas import RegionAreas
>>> areas = RegionAreas(2.0, 1.0, 1.0, 0.0, 2.0, 1.0, 1e-9, 4.0)
>>> areas.positive_share
0.5
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Self

import attrs
import numpy as np

__all__ = ["RegionAreas"]


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
        Where |K| <= K0; without a band, where K is nil to what the control points are known to.
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

"""What other fits of the same net make of the curvature of a plate.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.surface.plates.doubt import Doubt
>>> gauss, area = np.array([0.0, 1.0]), np.ones(2)
>>> found = Doubt.of(gauss, (gauss + 0.25,), area)
>>> found.dk, found.changed(gauss, area, 0.2, 2.0, 0.5)
(0.25, 0.5)
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["Doubt"]

_PART = 0.95
"""The change of curvature is what this part of the area stays below."""


@attrs.frozen(eq=False)
class Doubt:
    """By how much other fits change the Gaussian curvature of a plate.

    Attributes
    ----------
    dk : float or None, 1/m2
        What the change stays below on 95 % of the area that is told; None without other fits.
    part : float
        The part of the area that is told.
    others : tuple of (...) float, 1/m2
        The curvatures of the other fits at the nodes; nan where they are not told.
    """

    dk: float | None
    part: float
    others: tuple[FloatArray, ...]

    @classmethod
    def of(cls, gauss: FloatArray, others: Sequence[FloatArray], area: FloatArray) -> Self:
        """Compare.

        Parameters
        ----------
        gauss : (...) float, 1/m2
            Curvature at nodes.
        others : sequence of (...) float, 1/m2
            That of other fits there; nan where there is none.
        area : (...) float, m2
            What each node stands for; nil outside the plate.
        """
        if not others:
            return cls(None, 0.0, ())
        change = np.stack([np.abs(each - gauss) for each in others])
        told = np.isfinite(change).all(axis=0) & (area > 0.0)
        size, weight = change[:, told].max(axis=0), area[told]
        whole = float(area.sum())
        if not len(size):
            return cls(None, 0.0, ())
        order = np.argsort(size, kind="stable")
        share = np.cumsum(weight[order]) / weight.sum()
        place = min(int(np.searchsorted(share, _PART)), len(share) - 1)
        return cls(float(size[order[place]]), float(weight.sum()) / whole, tuple(others))

    def changed(
        self, gauss: FloatArray, area: FloatArray, k0: float, wide: float, most: float
    ) -> float:
        """Give the part of the area of which another fit tells another region, or quite another K.

        What is contested by its own curvature, K0 / wide <= |K| <= wide K0, is not counted again.

        Parameters
        ----------
        gauss, area : (...) float, 1/m2 and m2
            As they were compared.
        k0 : float, 1/m2
            What parts the regions.
        wide : float
            By which factor of it curvature is contested.
        most : float, 1/m2
            A change above this counts, too: that K0 which was asked for.
        """
        if not self.others:
            return 0.0
        size = np.abs(gauss)
        clear = (size < k0 / wide) | (size > wide * k0)
        own = _region(gauss, k0)
        differs = [
            np.isfinite(each) & ((_region(each, k0) != own) | (np.abs(each - gauss) > most))
            for each in self.others
        ]
        found = clear & np.any(differs, axis=0)
        return float(area[found].sum()) / float(area.sum())


def _region(gauss: FloatArray, k0: float) -> FloatArray:
    """Give 1 where K > K0, -1 where K < -K0, else 0."""
    return np.where(np.abs(gauss) > k0, np.sign(gauss), 0.0)

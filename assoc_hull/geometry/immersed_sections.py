"""Areas of single curves across a hull below planes: sectional areas."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.dual import is_plain
from assoc_hull.geometry.immersed import Planes
from assoc_hull.geometry.immersion_half import curve_by_curve
from assoc_hull.geometry.immersion_tiles import Tiles, from_curves
from assoc_hull.geometry.isocurves import IsoCurves

__all__ = ["sections_below"]


def sections_below(curves: IsoCurves, planes: Planes) -> FloatArray:
    """Give the area that each curve and its mirror image enclose below each plane.

    Parameters
    ----------
    curves : IsoCurves
        k curves in planes x = const; what they have of `across` does not matter.
    planes : Planes
        d planes.

    Returns
    -------
    (d, k), m2
        Areas of both sides, in the plane of the section.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.immersed import Planes
    >>> from assoc_hull.geometry.immersed_sections import sections_below
    >>> from assoc_hull.geometry.isocurves import IsoCurves
    >>> wedge = np.zeros((1, 4, 3))
    >>> wedge[0, 1] = [0.0, 2.0, 3.0]  # 3 m deep, 2 m wide at either side
    >>> curves = IsoCurves(np.array([0, 1]), wedge, np.zeros((1, 4, 3)), np.array([False]))
    >>> planes = Planes(np.array([1.5]), np.zeros(1), np.zeros(1))
    >>> sections_below(curves, planes).round(12).tolist()
    [[1.5]]
    """
    forward = np.zeros_like(curves.across)
    forward[:, 0, 0] = 1.0
    tiles = from_curves(attrs.evolve(curves, across=forward))
    found = np.stack([_one(tiles, planes, row) for row in range(len(planes.height))])
    freeze(found)
    return found


def _one(tiles: Tiles, planes: Planes, row: int) -> FloatArray:
    """Take each curve as a strip of its own: its volume per metre is the area."""
    level = np.repeat(planes.height[row : row + 1], tiles.curves)
    trim, heel = planes.tan_trim[row : row + 1], planes.tan_heel[row : row + 1]
    port = curve_by_curve(tiles, level, trim, heel)[0]
    upright = is_plain(heel) and heel[0] == 0.0
    area: FloatArray = port + (port if upright else curve_by_curve(tiles, level, trim, -heel)[0])
    return area

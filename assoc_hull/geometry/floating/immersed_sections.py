"""Areas of single curves across a hull below planes, and their moments: sectional areas."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.floating.immersion_half import curve_by_curve
from assoc_hull.geometry.floating.tiles import Tiles, from_curves, subset
from assoc_hull.geometry.numeric.dual import is_plain
from assoc_hull.geometry.surfaces.isocurves import IsoCurves

__all__ = ["sections_and_moments_below", "sections_below"]

_AREA, _MOMENT = 0, 3
"""Among the columns of a strip: volume and its moment about the base line."""

_MOST = 20_000
"""So many tiles are looked at together, which bounds the memory."""


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
    >>> from assoc_hull.geometry.floating.immersed import Planes
    >>> from assoc_hull.geometry.floating.immersed_sections import sections_below
    >>> from assoc_hull.geometry.surfaces.isocurves import IsoCurves
    >>> wedge = np.zeros((1, 4, 3))
    >>> wedge[0, 1] = [0.0, 2.0, 3.0]  # 3 m deep, 2 m wide at either side
    >>> curves = IsoCurves(np.array([0, 1]), wedge, np.zeros((1, 4, 3)), np.array([False]))
    >>> planes = Planes(np.array([1.5]), np.zeros(1), np.zeros(1))
    >>> sections_below(curves, planes).round(12).tolist()
    [[1.5]]
    """
    return sections_and_moments_below(curves, planes)[0]


def sections_and_moments_below(curves: IsoCurves, planes: Planes) -> tuple[FloatArray, FloatArray]:
    """Give areas as `sections_below` does, and their moments about the base line.

    Parameters
    ----------
    curves : IsoCurves
        k curves in planes x = const.
    planes : Planes
        d planes.

    Returns
    -------
    areas, moments : (d, k), m2 and m3
        Of both sides; the integral of dA and of z dA.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.floating.immersed import Planes
    >>> from assoc_hull.geometry.floating.immersed_sections import sections_and_moments_below
    >>> from assoc_hull.geometry.surfaces.isocurves import IsoCurves
    >>> wedge = np.zeros((1, 4, 3))
    >>> wedge[0, 1] = [0.0, 2.0, 3.0]  # 3 m deep, 2 m wide at either side
    >>> curves = IsoCurves(np.array([0, 1]), wedge, np.zeros((1, 4, 3)), np.array([False]))
    >>> planes = Planes(np.array([1.5]), np.zeros(1), np.zeros(1))
    >>> sections_and_moments_below(curves, planes)[1].round(12).tolist()  # 1.5 m2 at z = 1 m
    [[1.5]]
    """
    forward = np.zeros_like(curves.across)
    forward[:, 0, 0] = 1.0
    tiles = from_curves(attrs.evolve(curves, across=forward))
    runs = _runs(planes, max(1, _MOST // max(len(tiles.curve), 1)))
    several = [_several(tiles, planes, rows) for rows in runs]
    area = np.concatenate([each[0] for each in several])
    moment = np.concatenate([each[1] for each in several])
    freeze(area, moment)
    return area, moment


def _runs(planes: Planes, most: int) -> list[IntArray]:
    """Part planes into runs of one inclination, of `most` at the utmost."""
    count = len(planes.height)
    inclined = planes.tan_trim, planes.tan_heel
    if not all(map(is_plain, inclined)):
        # The derivatives that inclinations carry along may be different ones.
        return [np.array([row]) for row in range(count)]
    new = np.zeros(count, np.bool_)
    new[1:] = (np.diff(inclined[0]) != 0.0) | (np.diff(inclined[1]) != 0.0)
    parts = np.split(np.arange(count), np.flatnonzero(new))
    return [part[i : i + most] for part in parts for i in range(0, len(part), most)]


def _several(tiles: Tiles, planes: Planes, rows: IntArray) -> tuple[FloatArray, FloatArray]:
    """Take each curve as a strip of its own: what it has per metre; (r, k) each."""
    count = tiles.curves
    many = tiles if len(rows) == 1 else subset(tiles, np.tile(np.arange(count), len(rows)))
    level = np.repeat(planes.height[rows], count)
    trim, heel = planes.tan_trim[rows[:1]], planes.tan_heel[rows[:1]]
    port = curve_by_curve(many, level, trim, heel)
    upright = is_plain(heel) and heel[0] == 0.0
    starboard = port if upright else curve_by_curve(many, level, trim, -heel)
    shape = len(rows), count
    area, moment = (port[i] + starboard[i] for i in (_AREA, _MOMENT))
    return area.reshape(shape), moment.reshape(shape)

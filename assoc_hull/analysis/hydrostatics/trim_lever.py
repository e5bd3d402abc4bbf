"""How far buoyancy lies ahead of gravity along a waterplane, and how that grows with the trim."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Immersed, Planes

__all__ = ["STEEPEST", "trim_lever"]

STEEPEST = 0.25
"""Tangent of the largest trim that is tried."""


def trim_lever(
    found: Immersed, planes: Planes, lcg: FloatArray | float, kg: float | None
) -> tuple[FloatArray, FloatArray]:
    """Give ``(x_B - x_G) + (z_B - z_G) tt``, and how it grows with tt at constant volume.

    The plane turns about the centroid of the waterplane, so that the moments of the volume
    change by its second moments about that centroid: dM_x/dtt = I_L, dM_z/dtt = tt I_L - th I_LT.

    Parameters
    ----------
    found : Immersed
        Below d planes.
    planes : Planes
        They.
    lcg : (d,) or float, m
        Centre of gravity from AP.
    kg : float or None, m
        Above base; None: as high as the centre of buoyancy.

    Returns
    -------
    lever, growth : (d,), m
        The growth is per unit of tt; nan where there is no waterplane.
    """
    slope = planes.tan_trim
    area = np.where(found.area > 0.0, found.area, np.nan)
    x, y = found.area_x / area, found.area_y / area
    i_l = found.area_xx - area * x * x
    ahead, turn = found.moment_x / found.volume - lcg, i_l / found.volume
    if kg is None:
        return ahead, turn
    up = found.moment_z / found.volume - kg
    rise = slope * i_l - planes.tan_heel * (found.area_xy - area * x * y)
    return ahead + up * slope, turn + slope * rise / found.volume + up

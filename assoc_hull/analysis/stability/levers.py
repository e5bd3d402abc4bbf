"""Righting levers of a ship below planes, and how they grow with the heel.

With the tangents tt of trim and th of heel the water's normal is n = (-tt, th, 1) / N, the
direction along the ship e1 = (1, 0, tt) / M, and e2 = n x e1 = (th tt, 1 + tt^2, -th) / (N M).
The righting lever is GZ = (G - B).e2, positive where it rights a heel to starboard. With
K = (x_G, 0, 0) it is KN + KG e2_z + y_G e2_y, KN = (K - B).e2.
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.trim_lever import trim_lever
from assoc_hull.analysis.stability.afloat import Afloat
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.immersed import Immersed, Planes

__all__ = ["Case", "TrimRule", "levers_of"]

TrimRule = Literal["fixed", "free"]


@attrs.frozen(eq=False)
class Case:
    """What floats: n displacements of one hull.

    Attributes
    ----------
    afloat : Afloat
        The hull.
    volume : (n,), m3
        Displaced.
    mean, slope : (n,), m and 1
        Mean draughts and tangents of the trim upright; the trim is kept at fixed trim.
    lcg : (n,), m
        Centres of gravity from AP.
    tcg : float, m
        Centre of gravity to port.
    kg : float or None, m
        Above base; None: levers are KN only, and free trim takes G to lie as high as B.
    trim : "fixed" or "free"
        Whether the trim stays, or is that of equilibrium at each heel.
    """

    afloat: Afloat
    volume: FloatArray
    mean: FloatArray
    slope: FloatArray
    lcg: FloatArray
    tcg: float
    kg: float | None
    trim: TrimRule

    def __attrs_post_init__(self) -> None:
        freeze(self.volume, self.mean, self.slope, self.lcg)


def levers_of(case: Case, lcg: FloatArray, planes: Planes, f: Immersed) -> tuple[FloatArray, ...]:
    """Give kn, gz, growth, energy, normal and distance, as a heeled ship has them.

    Parameters
    ----------
    case : Case
        The ship.
    lcg : (d,), m
        Centres of gravity from AP.
    planes : Planes
        Where she floats.
    f : Immersed
        Below them.
    """
    tt, th, one = planes.tan_trim, planes.tan_heel, np.ones(len(lcg))
    b = np.stack([f.moment_x, f.moment_y, f.moment_z], axis=1) / f.volume[:, None]
    across = np.stack([th * tt, 1.0 + tt * tt, -th], axis=1)
    size = np.linalg.norm(across, axis=1)[:, None]
    e2 = across / size
    normal = np.stack([-tt, th, one], axis=1)
    length = np.linalg.norm(normal, axis=1)
    normal, distance = normal / length[:, None], planes.height / length
    k = np.stack([lcg, 0.0 * one, 0.0 * one], axis=1)
    kn = _dot(k - b, e2)
    if case.kg is None:
        none = np.full(len(lcg), np.nan)
        return kn, none, none.copy(), none.copy(), normal, distance
    arm = k + np.array([0.0, case.tcg, case.kg]) - b
    turn_trim, b_turn = _turning(case, lcg, planes, f)
    turn_heel = 1.0 + th * th
    across_turn = np.stack(
        [turn_heel * tt + th * turn_trim, 2.0 * tt * turn_trim, -turn_heel], axis=1
    )
    e2_turn = (across_turn - e2 * _dot(e2, across_turn)[:, None]) / size
    growth = _dot(arm, e2_turn) - _dot(b_turn, e2)
    return kn, _dot(arm, e2), growth, _dot(arm, normal), normal, distance


def _turning(
    case: Case, lcg: FloatArray, planes: Planes, f: Immersed
) -> tuple[FloatArray, FloatArray]:
    """Give by how much tt (d,) and the centre of buoyancy (d, 3) change per radian of heel.

    The plane turns about the centroid of the waterplane, whose second moments move B.
    """
    tt, th = planes.tan_trim, planes.tan_heel
    x, y = f.area_x / f.area, f.area_y / f.area
    i_l, i_lt = f.area_xx - f.area_x * x, f.area_xy - f.area_x * y
    i_t = f.area_yy - f.area_y * y
    turn_heel, turn_trim = 1.0 + th * th, np.zeros(len(tt))
    if case.trim == "free":
        growth = trim_lever(f, planes, lcg, case.kg)[1]
        pull = ((1.0 + tt * tt) * i_lt - tt * th * i_t) / f.volume
        turn_trim = turn_heel * pull / growth
    ahead = i_l * turn_trim - i_lt * turn_heel
    aside = i_lt * turn_trim - i_t * turn_heel
    return turn_trim, np.stack([ahead, aside, tt * ahead - th * aside], axis=1) / f.volume[:, None]


def _dot(one: FloatArray, other: FloatArray) -> FloatArray:
    found: FloatArray = (one * other).sum(axis=1)
    return found

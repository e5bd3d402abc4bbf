"""From integrals to the values of a hydrostatics record: algebra only, for many planes at once.

The inclined waterplane lies over its plan (x, y) by an affine map. With n the upward normal,
its longitudinal axis is ``e1 = (1, 0, tt) / c``, the direction of the ship's x-axis in the
plane; its transverse axis ``e2 = n x e1`` is perpendicular to it in the plane. From the
centroid a place in plan (x, y) has in these axes the coordinates

    xi = c x - (tt th / c) y,   eta = (s / c) y,   and dA = s dx dy,

with tt, th the tangents of trim and heel, ``c^2 = 1 + tt^2``, ``s^2 = 1 + tt^2 + th^2``.
For pure heel the transverse second moment is that in plan over the cube of the cosine.

Nothing here takes an absolute value or a maximum, so a complex step through it gives exact
derivatives: `propagate` turns changes of the integrals into changes of every value.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.record_fields import FIELDS
from assoc_hull.analysis.hydrostatics.sums import Sums
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Planes

__all__ = ["Setting", "Values", "propagate", "values_of"]

Values = dict[str, NDArray[Any]]

_STEP = 1e-100


@attrs.frozen
class Setting:
    """What else the values depend on.

    Attributes
    ----------
    length, breadth : float, m
        Lpp and moulded breadth.
    rho : float, t/m3
        Of the water.
    shell_factor : float
        Displacement over that of the moulded volume.
    kg : float or None, m
        Centre of gravity above the base line.
    """

    length: float
    breadth: float
    rho: float
    shell_factor: float
    kg: float | None


def values_of(sums: Sums, planes: Planes, setting: Setting) -> Values:
    """Give every value of the record, (d,) each, by name.

    A value that a position does not have (KM when heeled, GM without KG) is nan.

    Parameters
    ----------
    sums : Sums
        The integrals below d planes.
    planes : Planes
        The planes.
    setting : Setting
        Dimensions, water, KG.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        found = _draughts(planes, setting) | _buoyancy(sums, setting) | _plan(sums)
        found |= _waterplane(found, planes)
        found |= _heights(found, planes, setting)
        found |= _extent(sums)
        found |= _coefficients(found, setting)
    return {name: found[name] for name in FIELDS}


def _draughts(planes: Planes, setting: Setting) -> Values:
    rise = planes.tan_trim * setting.length
    return {"draught_mean": planes.height + 0.5 * rise, "trim_by_stern": -rise + 0.0}


def _buoyancy(sums: Sums, setting: Setting) -> Values:
    volume = sums.volume
    lcb = sums.moment_x / volume
    return {
        "volume": volume,
        "displacement": setting.rho * setting.shell_factor * volume,
        "lcb": lcb,
        "lcb_percent": 100.0 * (lcb - 0.5 * setting.length) / setting.length,
        "tcb": sums.moment_y / volume,
        "kb": sums.moment_z / volume,
    }


def _plan(sums: Sums) -> Values:
    area = sums.area
    lcf, tcf = sums.area_x / area, sums.area_y / area
    return {
        "waterplane_area_proj": area,
        "lcf": lcf,
        "tcf": tcf,
        "i_t_proj": sums.area_yy - tcf * sums.area_y,
        "i_l_proj": sums.area_xx - lcf * sums.area_x,
        "i_lt_proj": sums.area_xy - lcf * sums.area_y,
    }


def _waterplane(found: Values, planes: Planes) -> Values:
    """Map the waterplane from its plan to itself; see above."""
    c2 = 1.0 + planes.tan_trim**2
    s2 = c2 + planes.tan_heel**2
    s, skew = np.sqrt(s2), planes.tan_trim * planes.tan_heel
    yy, xx, xy = (found[f"i_{each}_proj"] for each in ("t", "l", "lt"))
    i_t = s * (s2 / c2) * yy
    i_l = s * (c2 * xx - 2.0 * skew * xy + skew**2 / c2 * yy)
    return {
        "waterplane_area": s * found["waterplane_area_proj"],
        "i_t": i_t,
        "i_l": i_l,
        "i_lt": s2 * (xy - skew / c2 * yy),
        "bmt": i_t / found["volume"],
        "bml": i_l / found["volume"],
    }


def _heights(found: Values, planes: Planes, setting: Setting) -> Values:
    upright = np.where(planes.tan_heel == 0.0, 0.0, np.nan)
    kmt, kml = (found["kb"] + found[each] + upright for each in ("bmt", "bml"))
    kg = np.nan if setting.kg is None else setting.kg
    gml = kml - kg
    lever = np.where(np.isnan(gml), found["bml"], gml)
    rho = setting.rho
    return {
        "kmt": kmt,
        "kml": kml,
        "gmt": kmt - kg,
        "gml": gml,
        "tpc": rho * found["waterplane_area"] / 100.0,
        "mtc": rho * found["volume"] * lever / (100.0 * setting.length),
    }


def _extent(sums: Sums) -> Values:
    return {
        "wetted_surface": sums.shell,
        "wetted_surface_girth": sums.girth,
        "transom_area": sums.transom,
        "lwl": sums.x_most - sums.x_least,
        "bwl": sums.y_most - sums.y_least,
        "a_max": sums.a_max,
        "x_a_max": sums.x_a_max,
        "a_midship": sums.a_midship,
    }


def _coefficients(found: Values, setting: Setting) -> Values:
    length, breadth, volume = setting.length, setting.breadth, found["volume"]
    frame = breadth * found["draught_mean"]
    cb, cw = volume / (length * frame), found["waterplane_area"] / (length * breadth)
    return {
        "cb": cb,
        "cm": found["a_midship"] / frame,
        "cx": found["a_max"] / frame,
        "cp": volume / (found["a_max"] * length),
        "cvp": cb / cw,
        "cw": cw,
        "cb_lwl": volume / (found["lwl"] * found["bwl"] * found["draught_mean"]),
        "cp_lwl": volume / (found["a_max"] * found["lwl"]),
    }


def propagate(
    sums: Sums, changes: Iterable[Sums], planes: Planes, setting: Setting
) -> dict[str, FloatArray]:
    """Tell by how much every value may be off, to first order.

    Parameters
    ----------
    sums : Sums
        The integrals.
    changes : iterable of Sums
        Each holds changes of all integrals that come together, with their signs: moments and
        volume are mostly off together, and the centroid is not. Changes of several items count
        as if each could have either sign. nan: not known.
    planes, setting
        As for `values_of`.

    Returns
    -------
    dict of (d,)
        By name; nan where it is not known.
    """
    found: dict[str, FloatArray] = {}
    for change in changes:
        moved = {
            name: value + 1j * _STEP * getattr(change, name)
            for name, value in attrs.asdict(sums, recurse=False).items()
        }
        for name, value in values_of(Sums(**moved), planes, setting).items():
            amount = np.where(np.isnan(value.real), np.nan, np.abs(value.imag) / _STEP)
            found[name] = found[name] + amount if name in found else amount
    return found

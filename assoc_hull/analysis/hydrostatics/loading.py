"""From weights to draughts: at what plane a hull floats that carries a given weight.

For a fixed trim the volume rises with the draught, dV/dT = A_W in plan. For a fixed volume
the plane turns about the centroid of the waterplane, so that the moments change by its second
moments in plan about that centroid,

    dM_x/dtt = I_L,   dM_z/dtt = tt I_L - th I_LT,

with tt, th the tangents of trim and heel. Both equations are solved by Newton's rule within
a bracket, which is halved wherever the rule fails.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.appendage import Appendage, require_volume, with_appendages
from assoc_hull.analysis.hydrostatics.bracketed import newton
from assoc_hull.analysis.hydrostatics.floating import FloatingPosition
from assoc_hull.analysis.hydrostatics.floating_body import FloatingBody
from assoc_hull.analysis.hydrostatics.trim_lever import STEEPEST, trim_lever
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersed import Immersed, Planes

__all__ = ["Load", "immersion"]

_WHERE = "in an immersion by weight"


@attrs.frozen
class Load:
    """What a hull is to carry.

    Attributes
    ----------
    weight : float, t
        All of it, ship and cargo.
    rho, shell_factor : float
        Density of the water, t/m3; displacement over that of the moulded volume.
    lcg : float or None, m
        Centre of gravity from AP, + forward; None: the trim is given instead.
    kg : float or None, m
        Centre of gravity above base. Under trim it moves by its height: without it, it is taken
        to lie as high as the centre of buoyancy.
    trim_by_stern : float, m
        Where `lcg` is not given.
    heel_deg : float, degrees
        + starboard down.
    appendages : tuple of Appendage
        That carry as well.
    """

    weight: float
    rho: float
    shell_factor: float = 1.0
    lcg: float | None = None
    kg: float | None = None
    trim_by_stern: float = 0.0
    heel_deg: float = 0.0
    appendages: tuple[Appendage, ...] = ()

    @property
    def volume(self) -> float:
        """Moulded volume that carries the weight, m3."""
        return self.weight / (self.rho * self.shell_factor)


@attrs.frozen
class _Sought:
    """The hull and what it is to carry."""

    body: FloatingBody
    load: Load
    length: float

    def plane(self, draught: float, slope: float) -> Planes:
        """Give the plane of a mean draught (m) and a tangent of trim."""
        height = draught - 0.5 * self.length * slope
        heel = np.tan(np.radians(self.load.heel_deg))
        return Planes(np.array([height]), np.array([slope]), np.array([heel]))

    def measure(self, planes: Planes) -> Immersed:
        return with_appendages(self.body.measure(planes), self.load.appendages, planes)

    def range(self, slope: float) -> tuple[float, float]:
        """Give the admissible mean draughts at a trim."""
        low, high = self.body.limits.mean_draughts(self.plane(0.0, slope), self.length)
        return float(low[0]), float(high[0])


def immersion(body: FloatingBody, load: Load, length: float) -> FloatingPosition:
    """Find where a hull floats that carries a weight.

    Parameters
    ----------
    body : FloatingBody
        The hull.
    load : Load
        The weight, and either where its centre is or the trim.
    length : float, m
        Between perpendiculars.

    Returns
    -------
    FloatingPosition
        Draughts moulded.

    Raises
    ------
    OutOfRangeError
        A weight that the hull does not carry at this trim and heel, with the range.
    BadInputError
        No trim brings the centre of buoyancy below that of gravity.
    """
    sought = _Sought(body, load, length)
    if load.lcg is None:
        slope = -load.trim_by_stern / length
        draught = _draught(sought, slope, 0.5 * sum(sought.range(slope)))
    else:
        slope, draught = _trim(sought, load.lcg)
    lift = 0.5 * length * slope
    return FloatingPosition(draught - lift, draught + lift, load.heel_deg)


def _root(
    value: Callable[[float], tuple[float, float]], start: float, low: float, high: float
) -> float:
    """Find the root of one rising function, given with its slope, in a bracket."""

    def rising(x: FloatArray, _: IntArray) -> tuple[FloatArray, FloatArray]:
        height, slope = value(float(x[0]))
        return np.array([height]), np.array([slope])

    return float(newton(rising, np.array([start]), np.array([low]), np.array([high]))[0])


def _draught(sought: _Sought, slope: float, start: float) -> float:
    """Find the mean draught at which the volume is that of the load, at a fixed trim."""
    low, high = sought.range(slope)
    _require_in_range(sought, slope, low, high)
    want = sought.load.volume

    def missing(draught: float) -> tuple[float, float]:
        found = sought.measure(sought.plane(draught, slope))
        return float(found.volume[0]) - want, float(found.area[0])

    root = _root(missing, start if low < start < high else 0.5 * (low + high), low, high)
    if abs(missing(root)[0]) > 1e-9 * want:
        raise BadInputError(
            f"{sought.load.weight:g} t lies where an appendage gets wet at once", _WHERE,
            "leave the appendage out",
        )  # fmt: skip
    return root


def _require_in_range(sought: _Sought, slope: float, low: float, high: float) -> None:
    """Refuse a weight beyond what the hull carries between two mean draughts."""
    load = sought.load
    if not low < high:
        what = f"no draught keeps the deck dry at heel {load.heel_deg:g} deg"
        raise BadInputError(what, _WHERE, "give less trim or heel, or close the deck")
    deepest = sought.plane(high, slope)
    largest = sought.measure(deepest)
    require_volume(largest.volume, load.appendages, deepest, _WHERE)
    most = float(largest.volume[0]) * load.rho * load.shell_factor
    if not 0.0 < load.weight <= most:
        why = "is more than the hull carries" if load.weight > most else "is none"
        where = f"at trim {-slope * sought.length + 0.0:g} m, heel {load.heel_deg:g} deg"
        raise OutOfRangeError("a weight", load.weight, where, why, 0.0, most, "t")


def _trim(sought: _Sought, lcg: float) -> tuple[float, float]:
    """Find trim (tangent) and mean draught at which buoyancy lies below gravity."""
    load, draughts = sought.load, [0.5 * sum(sought.range(0.0))]

    def lever(slope: float) -> tuple[float, float]:
        """Give how far the centre of buoyancy is ahead of that of gravity in the waterplane."""
        try:
            draughts.append(_draught(sought, slope, draughts[-1]))
        except (OutOfRangeError, BadInputError):
            if slope == 0.0:
                raise
            return (np.inf if slope > 0.0 else -np.inf), 0.0
        planes = sought.plane(draughts[-1], slope)
        ahead, growth = trim_lever(sought.measure(planes), planes, lcg, load.kg)
        return float(ahead[0]), float(growth[0])

    slope = _root(lever, 0.0, -STEEPEST, STEEPEST)
    draught = _draught(sought, slope, draughts[-1])
    planes = sought.plane(draught, slope)
    off = float(trim_lever(sought.measure(planes), planes, lcg, load.kg)[0][0])
    if not abs(off) <= 1e-8 * sought.length:
        raise BadInputError(
            f"no trim brings the centre of buoyancy nearer than {abs(off):.4g} m to LCG {lcg:g} m",
            _WHERE, f"give an LCG nearer to {lcg + off:.6g} m, or less weight",
        )  # fmt: skip
    return slope, draught

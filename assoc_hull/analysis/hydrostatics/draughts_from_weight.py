"""From weights to draughts: at what plane a hull floats that carries a given weight.

For a fixed trim the volume rises with the draught; with a centre of gravity the trim is found as
well, until buoyancy lies below gravity: both by Newton's rule within a bracket. `immersion` takes a
hull, `position_under_load` a floating body. Slopes are tangents of trim, positive with the bow down
(T_F > T_A).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.bracketed_roots import bracketed_newton
from assoc_hull.analysis.hydrostatics.demihulls import checked_separation, ship_of
from assoc_hull.analysis.hydrostatics.floating_body import (
    CLOSE_DECK,
    Appendage,
    FloatingBody,
    FloatingPosition,
    Freeboard,
    deck_edge_heel,
    least_freeboard,
    require_afloat,
    require_volume,
    with_appendages,
)
from assoc_hull.analysis.hydrostatics.flotation import body_of, header_of
from assoc_hull.analysis.hydrostatics.record import SALT
from assoc_hull.arguments import all_of, instance, number, plain, shown
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.model.tables import HasState, state_of

__all__ = [
    "STEEPEST",
    "Load",
    "deck_edge_angle",
    "freeboard",
    "immersion",
    "position_under_load",
    "trim_lever",
    "weight_in_tons",
]

# --------------------------------------------------------------------------------------
# The lever of trim.

STEEPEST = 0.25
"""Tangent of the largest trim that is tried."""


def trim_lever(
    found: ImmersedIntegrals, planes: FloatingPlanes, lcg: FloatArray | float, kg: float | None
) -> tuple[FloatArray, FloatArray]:
    """Give ``(x_B - x_G) + (z_B - z_G) tt``, and how it grows with tt at constant volume, (d,), m.

    tt and th are the tangents of trim and heel. The plane turns about the centroid of the
    waterplane, so that the moments of the volume change by its second moments in plan about that
    centroid: dM_x/dtt = I_L, dM_z/dtt = tt I_L - th I_LT. `lcg` is (d,) or a number; `kg` None: as
    high as the centre of buoyancy. The growth is per unit of tt; nan where there is no waterplane.
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


# --------------------------------------------------------------------------------------
# Draughts under a load. For a fixed trim dV/dT = A_W in plan; for a fixed volume see `trim_lever`.

_IN_IMMERSION = "in an immersion by weight"


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

    def plane(self, draught: float, slope: float) -> FloatingPlanes:
        """Give the plane of a mean draught (m) and a tangent of trim."""
        height = draught - 0.5 * self.length * slope
        heel = np.tan(np.radians(self.load.heel_deg))
        return FloatingPlanes(np.array([height]), np.array([slope]), np.array([heel]))

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        return with_appendages(self.body.measure(planes), self.load.appendages, planes)

    def range(self, slope: float) -> tuple[float, float]:
        """Give the admissible mean draughts at a trim."""
        low, high = self.body.limits.mean_draughts(self.plane(0.0, slope), self.length)
        return float(low[0]), float(high[0])


def position_under_load(body: FloatingBody, load: Load, length: float) -> FloatingPosition:
    """Find where a hull floats that carries a weight; moulded draughts, `length` in m.

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
    """Find the root of a rising function, given with its slope, in a bracket."""

    def rising(x: FloatArray, _: IntArray) -> tuple[FloatArray, FloatArray]:
        height, slope = value(float(x[0]))
        return np.array([height]), np.array([slope])

    return float(bracketed_newton(rising, np.array([start]), np.array([low]), np.array([high]))[0])


def _draught(sought: _Sought, slope: float, start: float) -> float:
    """Find the mean draught at which the volume is that of the load, at a fixed trim."""
    low, high = sought.range(slope)
    _require_in_range(sought, slope, low, high)
    want = sought.load.volume

    def missing(draught: float) -> tuple[float, float]:
        found = sought.measure(sought.plane(draught, slope))
        return float(found.volume[0]) - want, float(found.area[0])

    root = _root(missing, start if low < start < high else 0.5 * (low + high), low, high)
    # The volume jumps where the centroid of an appendage gets wet.
    if abs(missing(root)[0]) > 1e-9 * want:
        raise BadInputError(
            f"{sought.load.weight:g} t lies where an appendage gets wet at once", _IN_IMMERSION,
            "leave the appendage out",
        )  # fmt: skip
    return root


def _require_in_range(sought: _Sought, slope: float, low: float, high: float) -> None:
    """Refuse a weight beyond what the hull carries between two mean draughts."""
    load = sought.load
    if not low < high:
        what = f"no draught keeps the deck dry at heel {load.heel_deg:g} deg"
        raise BadInputError(what, _IN_IMMERSION, f"give less trim or heel, or {CLOSE_DECK}")
    deepest = sought.plane(high, slope)
    largest = sought.measure(deepest)
    require_volume(largest.volume, load.appendages, deepest, _IN_IMMERSION)
    most = float(largest.volume[0]) * load.rho * load.shell_factor
    if not 0.0 < load.weight <= most:
        why, remedy = "is more than the hull carries" if load.weight > most else "is none", ""
        limits = sought.body.limits
        if load.weight > most and not limits.closed:
            why += (
                f" with its open deck dry, whose edge is lowest at {limits.lowest_edge(deepest, 0)}"
            )
            remedy = CLOSE_DECK
        where = f"at trim {-slope * sought.length + 0.0:g} m, heel {load.heel_deg:g} deg"
        raise OutOfRangeError("a weight", load.weight, where, why, 0.0, most, "t", remedy)


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
            # Too steep for any draught: the root lies nearer to level.
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
            _IN_IMMERSION, f"give an LCG nearer to {lcg + off:.6g} m, or less weight",
        )  # fmt: skip
    return slope, draught


# --------------------------------------------------------------------------------------
# A hull: draughts, freeboard, the heel at which the deck edge goes under.

_WHERE = "in hydrostatics"


def immersion(
    hull: HasState,
    weight: float,
    *,
    lcg: float | None = None,
    kg: float | None = None,
    trim_by_stern: float = 0.0,
    heel_deg: float = 0.0,
    rho: float = SALT,
    shell_factor: float = 1.0,
    appendages: Iterable[Appendage] = (),
) -> FloatingPosition:
    """Find the draughts at which a hull carries a weight.

    The arguments and what is raised are those of `Hull.immersion`.
    """
    body = body_of(hull)
    terms: dict[str, object] = {
        "rho": rho,
        "shell_factor": shell_factor,
        "kg": kg,
        "appendages": appendages,
    }
    header = header_of(hull, body, terms)
    trim = number(trim_by_stern, "trim_by_stern", _WHERE)
    if lcg is not None and trim != 0.0:
        what = f"lcg and a trim_by_stern of {trim:g} m are both given"
        raise BadInputError(what, _WHERE, "give one of them: with lcg the trim is found")
    load = Load(
        # What is no finite number is refused with the range, which needs the hull.
        weight_in_tons(weight),
        header.rho,
        header.shell_factor,
        None if lcg is None else number(lcg, "lcg", _WHERE),
        header.kg,
        trim,
        FloatingPosition(0.0, 0.0, heel_deg).heel_deg,
        header.appendages,
    )
    return position_under_load(body, load, header.length)


def weight_in_tons(weight: object) -> float:
    """Take a weight, t; any number will do: the hull tells what is in its range."""
    found: object = plain(weight)  # type: ignore[arg-type]
    if isinstance(found, int) and not isinstance(found, bool):
        return math.inf if found > 0 else -math.inf  # beyond what a float can be
    if not isinstance(found, float):
        raise BadInputError(f"weight is {shown(weight)}", _WHERE, "give a number, t")
    return found


def freeboard(hull: HasState, position: FloatingPosition) -> Freeboard:
    """Give the least height of the deck edge above the water, and where.

    The arguments and what is raised are those of `Hull.freeboard`.
    """
    body, length = body_of(hull), hull.state.particulars.length
    require_afloat([instance(position, FloatingPosition, "position", _WHERE)], body.limits, length)
    return least_freeboard(body.limits.deck, position, length)


def deck_edge_angle(
    hull: HasState,
    position: FloatingPosition,
    appendages: Iterable[Appendage] = (),
    *,
    demihulls: int = 1,
    separation: float | None = None,
) -> float | None:
    """Give the heel (degrees) at which the deck edge goes under, at this displacement and trim.

    The arguments and what is raised are those of `Hull.deck_edge_angle`; `demihulls` and
    `separation` (m) those of `Hull.hydrostatics`.
    """
    ship = state_of(hull, _WHERE).particulars
    length = ship.length
    body = ship_of(body_of(hull), checked_separation(demihulls, separation, ship.breadth))
    given = instance(position, FloatingPosition, "position", _WHERE)
    carriers = tuple(all_of(appendages, Appendage, "appendages", _WHERE))
    upright = FloatingPosition(given.draught_aft, given.draught_fore)
    require_afloat([upright], body.limits, length)
    return deck_edge_heel(body, upright, length, carriers)

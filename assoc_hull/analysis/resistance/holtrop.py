"""Holtrop's regression of the resistance in calm deep water, and the ships it is valid for.

`hull_coefficients` are all numbers that do not vary with the speed, `holtrop` adds what does. The
total is

    R = R_F (1 + k_1) + R_APP + R_W + R_B + R_TR + R_A

The method of 1984 has a form factor of its own, another m_4, and another wave resistance for Froude
numbers above 0.55 (between 0.4 and 0.55 it goes straight from one to the other); all else is that
of 1982. Speeds in knots, forces in kN.

Sources: J. Holtrop, "A statistical re-analysis of resistance and propulsion data", International
Shipbuilding Progress 31 (1984) no. 363, pp. 272-276; J. Holtrop and G.G.J. Mennen, "An approximate
power prediction method", International Shipbuilding Progress 29 (1982) no. 335, pp. 166-170.

For which ships Holtrop's regression was made, and what to mind where another is asked about.

The sample has five types of ships, each with a range of Froude numbers, prismatic coefficients and
proportions. A ship that lies within none of them is told of the type to which she comes nearest.

Source: J. Holtrop and G.G.J. Mennen, "A statistical power prediction method", International
Shipbuilding Progress 25 (1978) no. 290, pp. 253-256, for Froude number, CP and L/B; limits of B/T
as programs that follow it print them. The papers of 1982 and 1984 enlarge the sample by faster
ships and repeat no table.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal, get_args

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.analysis.resistance.calm_water_resistance import (
    KNOT,
    Resistance,
    Source,
    inputs_of,
)
from assoc_hull.analysis.resistance.holtrop_ship import NU, WHERE, HoltropShip
from assoc_hull.arguments import (
    choice,
    instance,
    numbers,
    shown,
    word,
)
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "TYPES",
    "Method",
    "SampledShips",
    "holtrop",
    "hull_coefficients",
    "method_of",
    "nearest_type",
    "speeds_of",
    "types_of",
    "warnings_of",
]


@attrs.frozen
class SampledShips:
    """Ships of one type in the sample.

    Attributes
    ----------
    name : str
        In the plural, lower case.
    froude : float
        The greatest Froude number.
    cp, slender, wide : (float, float)
        Least and greatest CP, L/B and B/T.
    """

    name: str
    froude: float
    cp: tuple[float, float]
    slender: tuple[float, float]
    wide: tuple[float, float]

    def beyond(self, ship: HoltropShip, froude: float) -> list[tuple[str, float]]:
        """Give in what a ship lies outside, in words, and by how much of the limit."""
        given = {
            "Fn": (froude, 0.0, self.froude),
            "CP": (ship.cp, *self.cp),
            "L/B": (ship.length / ship.breadth, *self.slender),
            "B/T": (ship.breadth / ship.draught, *self.wide),
        }
        found = []
        for name, (value, least, most) in given.items():
            if not least <= value <= most:
                far, limit = (value - most, most) if value > most else (least - value, least)
                words = f"{name} {value:.3g} is {'above' if value > most else 'below'} {limit:g}"
                found.append((words, far / limit))
        return found


TYPES: tuple[SampledShips, ...] = (
    SampledShips("tankers and bulk carriers", 0.24, (0.73, 0.85), (5.1, 7.1), (2.4, 3.2)),
    SampledShips("trawlers, coasters and tugs", 0.38, (0.55, 0.65), (3.9, 6.3), (2.1, 3.0)),
    SampledShips("container ships and destroyers", 0.45, (0.55, 0.67), (6.0, 9.5), (3.0, 4.0)),
    SampledShips("cargo liners", 0.30, (0.56, 0.75), (5.3, 8.0), (2.4, 4.0)),
    SampledShips("ro-ro ships and car ferries", 0.35, (0.55, 0.67), (5.3, 8.0), (3.2, 4.0)),
)
"""The types of the sample."""


def types_of(ship: HoltropShip, froude: float) -> tuple[str, ...]:
    """Give the types within whose ranges a ship lies, up to a Froude number.

    Examples
    --------
    >>> from assoc_hull.analysis.resistance.holtrop_ship import HoltropShip
    >>> from assoc_hull.analysis.resistance.holtrop import types_of
    >>> ship = HoltropShip(length=205.0, breadth=32.0, draught_fore=10.0, draught_aft=10.0,
    ...                    volume=37500.0, lcb=-0.75, cm=0.98, cwp=0.75)
    >>> types_of(ship, 0.287)
    ('container ships and destroyers', 'cargo liners', 'ro-ro ships and car ferries')
    """
    return tuple(each.name for each in TYPES if not each.beyond(ship, froude))


def nearest_type(ship: HoltropShip, froude: float) -> SampledShips:
    """Give the type to which a ship comes nearest: by all that she lies outside, of the limits."""
    return min(TYPES, key=lambda each: sum(far for _, far in each.beyond(ship, froude)))


_BULB = 0.2
"""Of the total: more of it than a bulb costs that lies as deep as those of the sample."""


def warnings_of(ship: HoltropShip, froude: float, bulb: float = 0.0) -> tuple[str, ...]:
    """Say what to mind about the resistance of a ship, up to a Froude number.

    `bulb` is the greatest part of the total that is RB.
    """
    found = []
    nearest = nearest_type(ship, froude)
    beyond = nearest.beyond(ship, froude)
    if beyond:
        words = ", ".join(each for each, _ in beyond)
        found.append(
            f"outside the ranges of all types of ships of the regression; nearest are "
            f"{nearest.name}: {words}"
        )
    if ship.bulb_centre < ship.bulb_height:
        found.append(
            f"the centre of the bulb's section is {ship.bulb_height:.3f} m above the base line; "
            f"0.6 T_F, {ship.bulb_centre:.3f} m, is taken, as the papers ask, and RB is doubtful"
        )
    if bulb > _BULB:
        found.append(
            f"RB is up to {100.0 * bulb:.0f} % of R: the bulb lies near the surface, where the "
            "regression overrates it"
        )
    if ship.rho < 1.01 and ship.nu == NU:
        found.append(
            "rho is that of fresh water, nu that of salt water; fresh water of 15 degrees has "
            "nu 1.139e-6 m2/s"
        )
    return tuple(found)


Method = Literal["1984", "1982"]
"""The paper whose formulas are used."""

_GRAVITY = 9.81
"""m/s2, as in the papers' examples."""

_SLOW, _FAST = 0.4, 0.55
"""Froude numbers between which the method of 1984 goes from one wave resistance to the other."""

_LEAST_REYNOLDS = 1e5
"""The line of the ITTC is for turbulent flow."""

_POWER = -0.9
"""d, the exponent of the Froude number in the wave resistance."""


# --------------------------------------------------------------------------------------
# What does not vary with the speed.


def hull_coefficients(ship: HoltropShip, method: Method = "1984") -> dict[str, float]:
    """Give the coefficients of a ship that do not vary with her speed.

    Parameters
    ----------
    ship : HoltropShip
        The ship.
    method : "1984" or "1982"
        The paper.

    Returns
    -------
    dict of str to float
        By the symbols of the papers: ``CB``, ``CP``, ``LR`` (m), ``S`` (m2) and ``S regression``,
        ``iE`` (degrees) and ``iE regression``, ``1+k1``, ``c1`` ..., ``m1``, ``lambda``, ``PB``,
        ``CA``; of 1984 also ``m3`` and ``c17``, where L/B is above 2. What the regression cannot
        tell is not there.

    Raises
    ------
    OutOfRangeError
        A ship of which the regression cannot tell them.

    Examples
    --------
    >>> from assoc_hull.analysis.resistance.holtrop import hull_coefficients
    >>> from assoc_hull.analysis.resistance.holtrop_ship import HoltropShip
    >>> ship = HoltropShip(length=205.0, breadth=32.0, draught_fore=10.0, draught_aft=10.0,
    ...                    volume=37500.0, lcb=-0.75, cm=0.98, cwp=0.75, bulb_area=20.0,
    ...                    bulb_height=4.0, transom_area=16.0, c_stern=10.0)
    >>> found = hull_coefficients(ship, "1982")
    >>> round(found["1+k1"], 3), round(found["iE"], 2)  # as the paper prints them
    (1.156, 12.08)
    """
    found = {"CB": ship.cb, "CP": ship.cp, "LR": ship.run}
    found |= _surface(ship) | _entrance(ship)
    found |= _form_1984(ship) if method == "1984" else _form_1982(ship)
    found |= _bulb(ship) | _waves(ship, found["iE"])
    if method == "1984" and ship.length > 2.0 * ship.breadth:
        found |= _fast_waves(ship)
    return found | _correlation(ship, found["c2"])


def _surface(ship: HoltropShip) -> dict[str, float]:
    """Give the wetted surface of the bare hull, m2, and what the regression says of it."""
    b, t, cb, cm = ship.breadth, ship.draught, ship.cb, ship.cm
    form = 0.453 + 0.4425 * cb - 0.2862 * cm - 0.003467 * b / t + 0.3696 * ship.cwp
    found = ship.length * (2.0 * t + b) * math.sqrt(cm) * form + 2.38 * ship.bulb_area / cb
    return {"S": ship.wetted_surface or found, "S regression": found}


def _entrance(ship: HoltropShip) -> dict[str, float]:
    """Give half the angle of entrance, degrees, and what the regression says of it."""
    l, b, cp, run = ship.length, ship.breadth, ship.cp, ship.run
    fine = 1.0 - cp - 0.0225 * ship.lcb
    known = fine > 0.0 and ship.cwp < 1.0
    if not known:
        if ship.entrance_deg is None:
            raise BadInputError(
                f"the regression knows no angle of entrance of a ship with CP {cp:.4g}, "
                f"lcb {ship.lcb:.4g} and cwp {ship.cwp:.4g}", WHERE, "give entrance_deg",
            )  # fmt: skip
        return {"iE": ship.entrance_deg}
    found = 1.0 + 89.0 * math.exp(
        -((l / b) ** 0.80856) * (1.0 - ship.cwp) ** 0.30484 * fine**0.6367
        * (run / b) ** 0.34574 * (100.0 * ship.volume / l**3) ** 0.16302
    )  # fmt: skip
    return {"iE": ship.entrance_deg or found, "iE regression": found}


def _form_1984(ship: HoltropShip) -> dict[str, float]:
    """Give the form factor of 1984."""
    l, b = ship.length, ship.breadth
    c14 = 1.0 + 0.011 * ship.c_stern
    factor = 0.93 + 0.487118 * c14 * (
        (b / l) ** 1.06806 * (ship.draught / l) ** 0.46106 * (l / ship.run) ** 0.121563
        * (l**3 / ship.volume) ** 0.36486 * (1.0 - ship.cp) ** -0.604247
    )  # fmt: skip
    return {"c14": c14, "1+k1": factor}


def _form_1982(ship: HoltropShip) -> dict[str, float]:
    """Give the form factor of 1982."""
    ratio, cp, aft = ship.draught / ship.length, ship.cp, 1.0 - ship.cp + 0.0225 * ship.lcb
    for name, value, most in (("CP", cp, 0.95), ("1 - CP + 0.0225 lcb", aft, math.inf)):
        if not (0.0 < value < most):
            why = "is none that the form factor of 1982 can be had of"
            raise OutOfRangeError(name, value, WHERE, why, 0.0, most, "", "take method='1984'")
    c12 = 0.479948
    if ratio > 0.05:
        c12 = ratio**0.2228446
    elif ratio > 0.02:
        c12 += 48.20 * (ratio - 0.02) ** 2.078
    c13 = 1.0 + 0.003 * ship.c_stern
    rest = (0.95 - cp) ** -0.521448 * aft**0.6906
    factor = c13 * (0.93 + c12 * (ship.breadth / ship.run) ** 0.92497 * rest)
    return {"c12": c12, "c13": c13, "1+k1": factor}


def _bulb(ship: HoltropShip) -> dict[str, float]:
    """Give how a bulb diminishes waves (c2), and how it emerges (PB)."""
    area, fore, height = ship.bulb_area, ship.draught_fore, ship.bulb_centre
    root = math.sqrt(area)
    c3 = 0.56 * area * root / (ship.breadth * ship.draught * (0.31 * root + fore - height))
    found = {"c2": math.exp(-1.89 * math.sqrt(c3)), "c3": c3}
    return found | ({"PB": 0.56 * root / (fore - 1.5 * height)} if area else {})


def _waves(ship: HoltropShip, entrance: float) -> dict[str, float]:
    """Give the coefficients of the wave resistance at Froude numbers up to 0.4."""
    l, b, t, cp = ship.length, ship.breadth, ship.draught, ship.cp
    slim, third = l / b, ship.volume ** (1.0 / 3.0)
    c7 = b / l
    if c7 < 0.11:
        c7 = 0.229577 * c7**0.33333
    elif c7 > 0.25:
        c7 = 0.5 - 0.0625 * slim
    c15 = -1.69385
    if l**3 / ship.volume > 1726.91:
        c15 = 0.0
    elif l**3 / ship.volume > 512.0:
        c15 += (l / third - 8.0) / 2.36
    full = 1.73014 - 0.7067 * cp
    c16 = 8.07981 * cp - 13.8673 * cp**2 + 6.984388 * cp**3 if cp < 0.80 else full
    decay = 1.75254 * third / l + 4.79323 * b / l + c16
    if 0.0140407 * l / t >= decay:
        why = "is so great that waves would grow as she slows down"
        raise OutOfRangeError(
            "length / draught", l / t, WHERE, why, 0.0, decay / 0.0140407, "",
            "take a greater draught",
        )  # fmt: skip
    return {
        "c1": 2223105.0 * c7**3.78613 * (t / b) ** 1.07961 * (90.0 - entrance) ** -1.37565,
        "c5": 1.0 - 0.8 * ship.transom_area / (b * t * ship.cm),
        "c7": c7,
        "c15": c15,
        "c16": c16,
        "lambda": 1.446 * cp - (0.03 * slim if slim < 12.0 else 0.36),
        "m1": 0.0140407 * l / t - decay,
    }


def _fast_waves(ship: HoltropShip) -> dict[str, float]:
    """Give the coefficients of the wave resistance of 1984 at Froude numbers from 0.55 up."""
    slim, b = ship.length / ship.breadth, ship.breadth
    light = (ship.volume / ship.length**3) ** 2.00977
    return {
        "c17": 6919.3 * ship.cm**-1.3346 * light * (slim - 2.0) ** 1.40692,
        "m3": -7.2035 * slim**-0.326869 * (ship.draught / b) ** 0.605375,
    }


def _correlation(ship: HoltropShip, c2: float) -> dict[str, float]:
    """Give the allowance between model and ship, with that for a rough shell."""
    l = ship.length
    c4 = min(ship.draught_fore / l, 0.04)
    smooth = 0.006 * (l + 100.0) ** -0.16 - 0.00205
    allowance = smooth + 0.003 * math.sqrt(l / 7.5) * ship.cb**4 * c2 * (0.04 - c4)
    rough = (0.105 * ship.roughness ** (1.0 / 3.0) - 0.005579) / l ** (1.0 / 3.0)
    return {"c4": c4, "CA": allowance + max(rough, 0.0)}


# --------------------------------------------------------------------------------------
# What varies with the speed.


def method_of(method: object) -> Method:
    """Take the name of a method.

    Raises
    ------
    BadInputError
        Another one.
    """
    chosen = choice(method, "method", get_args(Method), WHERE)
    return "1982" if chosen == "1982" else "1984"


def speeds_of(speeds: ArrayLike) -> FloatArray:
    """Take one speed or some, kn, (n,).

    Raises
    ------
    BadInputError
        No speed, or one that is not above 0.
    """
    found = np.atleast_1d(numbers(speeds, "speeds", WHERE)) + 0.0
    if not len(found) or not (found > 0.0).all():
        raise BadInputError(f"speeds is {shown(speeds)}", WHERE, "give speeds above 0, kn")
    return found


def holtrop(
    ship: HoltropShip,
    speeds: ArrayLike,
    method: Method = "1984",
    *,
    name: str = "",
    sources: Mapping[str, tuple[Source, str]] = MappingProxyType({}),
) -> Resistance:
    """Give the resistance of a ship in calm deep water by Holtrop's regression.

    Parameters
    ----------
    ship : HoltropShip
        The ship.
    speeds : float or (n,), kn
        Above 0, in any order.
    method : "1984" or "1982"
        The paper.
    name : str
        Of the ship, for the table.
    sources : mapping of str to (Source, str)
        By the fields of `ship`: where each number came from, and a note; what is not named was
        given.

    Returns
    -------
    Resistance
        The parts at each speed, kN, with coefficients, inputs and warnings.

    Raises
    ------
    BadInputError
        A speed or a method that is none; an angle of entrance that the regression does not know.
    OutOfRangeError
        A ship or a speed of which the regression cannot tell the resistance.

    See Also
    --------
    assoc_hull.Hull.resistance : the same of a hull as she floats.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> ship = ah.hydro.HoltropShip(
    ...     length=50.0, breadth=12.0, draught_fore=3.1, draught_aft=3.3, volume=900.0, lcb=-4.5,
    ...     cm=0.78, cwp=0.80, transom_area=10.0, appendage_area=50.0, appendage_factor=3.0,
    ...     wetted_surface=584.9, entrance_deg=25.0)
    >>> found = ah.hydro.holtrop(ship, [25.0, 27.0])
    >>> found.waves.round().tolist()  # as the paper prints them
    [475.0, 512.0]
    """
    instance(ship, HoltropShip, "ship", WHERE)
    word(name, "name", WHERE)
    method = method_of(method)
    knots = speeds_of(speeds)
    velocity = knots * KNOT
    hull = hull_coefficients(ship, method)
    froude = velocity / math.sqrt(_GRAVITY * ship.length)
    reynolds = _reynolds(ship, knots, velocity)
    line = 0.075 / (np.log10(reynolds) - 2.0) ** 2
    pressure = 0.5 * ship.rho * velocity**2
    waves, m4 = _wave_resistance(ship, hull, froude, method)
    by_speed = {"CF": line, "m4" if method == "1984" else "m2": m4}
    transom, by_speed["c6"] = _transom_resistance(ship, velocity, pressure)
    friction = pressure * hull["S"] * line
    found = Resistance(
        name=name,
        method=method,
        ship=ship,
        inputs=inputs_of(ship, hull, sources),
        coefficients=hull,
        by_speed=by_speed,
        speeds=knots,
        froude=froude,
        reynolds=reynolds,
        friction=friction,
        form=friction * (hull["1+k1"] - 1.0),
        appendages=_appendage_resistance(ship, velocity, pressure * line),
        waves=waves,
        bulb=_bulb_resistance(ship, hull, velocity),
        transom=transom,
        correlation=pressure * hull["S"] * hull["CA"],
        warnings=(),
    )
    bulb = float((found.bulb / found.total).max())
    return attrs.evolve(found, warnings=warnings_of(ship, float(froude.max()), bulb))


def _reynolds(ship: HoltropShip, knots: FloatArray, velocity: FloatArray) -> FloatArray:
    found = velocity * (ship.length / ship.nu)
    if (found < _LEAST_REYNOLDS).any():
        least = _LEAST_REYNOLDS * ship.nu / ship.length / KNOT
        why = "is so low that the line of the ITTC has no meaning"
        slow = float(knots.min())
        raise OutOfRangeError("a speed", slow, WHERE, why, least, math.inf, "kn")
    return found


def _wave_resistance(
    ship: HoltropShip, hull: Mapping[str, float], froude: FloatArray, method: Method
) -> tuple[FloatArray, FloatArray]:
    """Give the resistance by waves, kN, and the factor of its humps and hollows."""
    m4 = _humps(ship, hull, froude, method)
    slow = _formula(ship, hull["c1"], hull["m1"], hull, froude, m4)
    if method == "1982" or not (froude > _SLOW).any():
        return slow, m4
    if "c17" not in hull:
        why = "is too little for the wave resistance at Froude numbers above 0.4"
        ratio = ship.length / ship.breadth
        raise OutOfRangeError(
            "length / breadth", ratio, WHERE, why, 2.0, math.inf, "",
            "take slower speeds, or method='1982'",
        )  # fmt: skip
    fast = _formula(ship, hull["c17"], hull["m3"], hull, froude, m4)
    ends = np.array([_SLOW, _FAST])
    humps = _humps(ship, hull, ends, method)
    begin = _formula(ship, hull["c1"], hull["m1"], hull, ends, humps)[0]
    finish = _formula(ship, hull["c17"], hull["m3"], hull, ends, humps)[1]
    between = begin + (10.0 * froude - 4.0) * (finish - begin) / 1.5
    return np.where(froude <= _SLOW, slow, np.where(froude > _FAST, fast, between)), m4


def _humps(
    ship: HoltropShip, hull: Mapping[str, float], froude: FloatArray, method: Method
) -> FloatArray:
    """Give m4 of 1984, or m2 of 1982."""
    if method == "1984":
        return hull["c15"] * 0.4 * np.exp(-0.034 * froude**-3.29)
    return hull["c15"] * ship.cp**2 * np.exp(-0.1 * froude**-2.0)


def _formula(
    ship: HoltropShip,
    size: float,
    decay: float,
    hull: Mapping[str, float],
    froude: FloatArray,
    humps: FloatArray,
) -> FloatArray:
    """Give the resistance by waves by one of the two formulas, kN."""
    weight = ship.volume * ship.rho * _GRAVITY * hull["c2"] * hull["c5"]
    turns = np.cos(hull["lambda"] * froude**-2.0)
    return size * weight * np.exp(decay * froude**_POWER + humps * turns)


def _appendage_resistance(
    ship: HoltropShip, velocity: FloatArray, stress: FloatArray
) -> FloatArray:
    """Give the resistance of appendages, and of the opening of a bow thruster, kN."""
    found = stress * ship.appendage_area * (ship.appendage_factor or 0.0)
    opening = math.pi * ship.thruster_diameter**2 * (ship.thruster_coefficient or 0.0)
    return found + ship.rho * velocity**2 * opening


def _bulb_resistance(
    ship: HoltropShip, hull: Mapping[str, float], velocity: FloatArray
) -> FloatArray:
    """Give the resistance by the pressure of a bulb near the surface, kN."""
    area = ship.bulb_area
    if not area:
        return np.zeros_like(velocity)
    depth = ship.draught_fore - ship.bulb_centre - 0.25 * math.sqrt(area)
    immersed = velocity / np.sqrt(_GRAVITY * depth + 0.15 * velocity**2)
    size = 0.11 * math.exp(-3.0 * hull["PB"] ** -2) * area**1.5 * ship.rho * _GRAVITY
    found: FloatArray = size * immersed**3 / (1.0 + immersed**2)
    return found


def _transom_resistance(
    ship: HoltropShip, velocity: FloatArray, pressure: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give the resistance of an immersed transom, kN, and c6; none once it runs clear."""
    area = ship.transom_area
    if not area:
        return np.zeros_like(velocity), np.zeros_like(velocity)
    width = ship.breadth + ship.breadth * ship.cwp
    froude = velocity / math.sqrt(2.0 * _GRAVITY * area / width)
    c6 = np.where(froude < 5.0, 0.2 * (1.0 - 0.2 * froude), 0.0)
    return pressure * area * c6, c6

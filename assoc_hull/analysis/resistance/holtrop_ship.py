"""A ship as Holtrop's regression sees her: main dimensions, coefficients, ends, water.

`HoltropShip` can be filled in by hand from a table of particulars, or from a hull as she floats
(`assoc_hull.analysis.resistance.hull_resistance`). Lengths are those of the waterline, and so are
coefficients.

Sources: J. Holtrop, ISP 31 (1984) no. 363, pp. 272-276; J. Holtrop and G.G.J. Mennen, ISP 29 (1982)
no. 335, pp. 166-170.
"""

from __future__ import annotations

import math
from typing import Any

import attrs

from assoc_hull.arguments import checked, not_negative, number, plain, positive
from assoc_hull.errors import BadInputError, OutOfRangeError

__all__ = ["NU", "ROUGHNESS", "WHERE", "HoltropShip"]

WHERE = "in resistance"

NU = 1.18831e-6
"""Kinematic viscosity of salt water of 15 degrees, as in the example of 1982, m2/s."""

ROUGHNESS = 150e-6
"""Roughness of the shell for which the correlation allowance holds good as it is, m."""

_ROUGHEST = 5e-3
_HIGHEST_BULB = 0.6
"""Of T_F: the centre of the bulb's section is not taken to lie higher."""

_FULLEST = 1.05
"""A trimmed ship has a largest section deeper than her mean draught."""


def _within(least: float, most: float, unit: str, why: str) -> Any:
    """Give a validator of a number that lies within limits, both included."""

    def validator(_: object, field: attrs.Attribute[Any], value: object) -> None:
        found = number(value, field.name, WHERE, unit=unit)
        if not least <= found <= most:
            raise OutOfRangeError(field.name, found, WHERE, why, least, most, unit)

    return validator


def _maybe(value: object, name: str, where: str) -> None:
    if value is not None:
        positive(value, name, where)


def _positive() -> Any:
    return attrs.field(converter=plain, validator=checked(positive, WHERE))


def _not_negative() -> Any:
    return attrs.field(default=0.0, converter=plain, validator=checked(not_negative, WHERE))


def _optional() -> Any:
    return attrs.field(default=None, converter=plain, validator=checked(_maybe, WHERE))


@attrs.frozen(kw_only=True)
class HoltropShip:
    """What the resistance of a ship is computed from.

    Attributes
    ----------
    length : float, m
        L, on the waterline.
    breadth : float, m
        B, moulded.
    draught_fore, draught_aft : float, m
        T_F and T_A, moulded, at the perpendiculars; T is their mean.
    volume : float, m3
        Of displacement, moulded.
    lcb : float, % of L
        Centre of buoyancy from the middle of L, + forward.
    cm : float
        Coefficient of the midship section, on B and T.
    cwp : float
        Coefficient of the waterplane, on L and B.
    bulb_area : float, m2
        A_BT, of the section of the bulb at FP, both sides.
    bulb_height : float, m
        h_B, of the centre of that section above the base line. Above 0.6 T_F it counts as that.
    transom_area : float, m2
        A_T, of the immersed transom, the ship at rest.
    c_stern : float
        -25 pram with gondola, -10 V-shaped sections, 0 normal, +10 U-shaped with Hogner stern.
    wetted_surface : float or None, m2
        S, of the bare hull; None: by the regression.
    entrance_deg : float or None, degrees
        i_E, half angle of entrance; None: by the regression.
    appendage_area : float, m2
        S_APP, wetted surface of all appendages.
    appendage_factor : float or None
        1 + k_2 of them, the mean by area: rudder behind a skeg 1.5 to 2, behind a stern 1.3 to 1.5,
        twin-screw rudders 2.8, shaft brackets 3, skegs 1.5 to 2, bossings 2 to 3, shafts 2 to 4,
        fins 2.8, domes 2.7, bilge keels 1.4.
    thruster_diameter : float, m
        d, of the opening of a bow thruster; 0: none.
    thruster_coefficient : float or None
        C_BTO, from 0.003 (in the cylindrical part of a bulb) to 0.012.
    rho : float, t/m3
        Density of the water.
    nu : float, m2/s
        Its kinematic viscosity.
    roughness : float, m
        k_s, of the shell; from 150e-6, that of new ships, up.

    Raises
    ------
    BadInputError
        A number that cannot be used; an area of appendages without their factor, or a bulb without
        its height.
    OutOfRangeError
        A number with which the formulas have no meaning, and between which they have one.

    Examples
    --------
    >>> from assoc_hull.analysis.resistance.holtrop_ship import HoltropShip
    >>> ship = HoltropShip(length=205.0, breadth=32.0, draught_fore=10.0, draught_aft=10.0,
    ...                    volume=37500.0, lcb=-0.75, cm=0.98, cwp=0.75)
    >>> round(ship.cb, 4), round(ship.cp, 4)
    (0.5716, 0.5833)
    """

    length: float = _positive()
    breadth: float = _positive()
    draught_fore: float = _positive()
    draught_aft: float = _positive()
    volume: float = _positive()
    lcb: float = attrs.field(
        converter=plain, validator=_within(-25.0, 25.0, "% of L", "is that of no ship")
    )
    cm: float = attrs.field(
        converter=plain, validator=_within(0.2, _FULLEST, "", "is that of no ship")
    )
    cwp: float = attrs.field(
        converter=plain, validator=_within(0.2, _FULLEST, "", "is that of no ship")
    )
    bulb_area: float = _not_negative()
    bulb_height: float = _not_negative()
    transom_area: float = _not_negative()
    c_stern: float = attrs.field(
        default=0.0,
        converter=plain,
        validator=_within(-25.0, 10.0, "", "is none of the regression's"),
    )
    wetted_surface: float | None = _optional()
    entrance_deg: float | None = _optional()
    appendage_area: float = _not_negative()
    appendage_factor: float | None = _optional()
    thruster_diameter: float = _not_negative()
    thruster_coefficient: float | None = _optional()
    rho: float = attrs.field(
        default=1.025,
        converter=plain,
        validator=_within(0.9, 1.2, "t/m3", "is that of no water"),
    )
    nu: float = attrs.field(
        default=NU, converter=plain, validator=_within(5e-7, 3e-6, "m2/s", "is that of no water")
    )
    roughness: float = attrs.field(
        default=ROUGHNESS,
        converter=plain,
        validator=_within(ROUGHNESS, _ROUGHEST, "m", "is not what the regression corrects for"),
    )

    def __attrs_post_init__(self) -> None:
        self._check_parts()
        self._check_bulb()
        self._require("volume / (length breadth draught cm)", self.cp, 0.25, 1.0)
        self._require("a length of the run (by cp and lcb)", self.run, 0.0, math.inf, "m")
        most = self.breadth * self.draught * self.cm
        self._require("transom_area", self.transom_area, -math.inf, most, "m2")
        if self.entrance_deg is not None:
            self._require("entrance_deg", self.entrance_deg, 0.0, 90.0, "deg")

    def _check_parts(self) -> None:
        for area, factor, least in (
            ("appendage_area", "appendage_factor", 1.0),
            ("thruster_diameter", "thruster_coefficient", 0.0),
        ):
            size, value = getattr(self, area), getattr(self, factor)
            if (size > 0.0) != (value is not None):
                one, other = (area, factor) if value is None else (factor, area)
                raise BadInputError(
                    f"{one} is given without {other}", WHERE, "give both, or neither"
                )
            if value is not None and value < least:
                raise OutOfRangeError(factor, value, WHERE, "is too small", least, math.inf, "")

    def _check_bulb(self) -> None:
        if (self.bulb_area > 0.0) != (self.bulb_height > 0.0):
            given, other = "bulb_area", "bulb_height"
            if self.bulb_area == 0.0:
                given, other = other, given
            raise BadInputError(f"{given} is given without {other}", WHERE, "give both, or neither")
        most = (4.0 * (self.draught_fore - self.bulb_centre)) ** 2
        self._require("bulb_area", self.bulb_area, -math.inf, most, "m2")

    def _require(self, name: str, value: float, least: float, most: float, unit: str = "") -> None:
        """Refuse a number that does not lie between two others."""
        if not least < value < most:
            why = "is none that the regression can be used with"
            raise OutOfRangeError(name, value, WHERE, why, least, most, unit)

    @property
    def draught(self) -> float:
        """T, the mean of both draughts, m."""
        return 0.5 * (self.draught_fore + self.draught_aft)

    @property
    def cb(self) -> float:
        """Block coefficient C_B, on L, B and T."""
        return self.volume / (self.length * self.breadth * self.draught)

    @property
    def cp(self) -> float:
        """Prismatic coefficient C_P, on L."""
        return self.cb / self.cm

    @property
    def run(self) -> float:
        """L_R, length of the run as the regression has it, m."""
        cp = self.cp
        return self.length * (1.0 - cp + 0.06 * cp * self.lcb / (4.0 * cp - 1.0))

    @property
    def bulb_centre(self) -> float:
        """h_B as the formulas take it: at most 0.6 T_F, m."""
        return min(self.bulb_height, _HIGHEST_BULB * self.draught_fore)

"""The midship section of a half-breadth, a flat of bottom, a rise of floor and a bilge radius.

From the centre line it is level to the edge of the flat, rises straight to the bilge, turns on a
circle that floor and side touch, and goes straight up. Source: Kim & Chang, "Some Representations
of Ship Hulls by Mathematical Method for Design and Production", J. SNAK; the rise of floor is
measured at the side.

Examples
--------
>>> from assoc_hull.creation.classical.midship import Midship
>>> midship = Midship(16.0, 2.0, 0.3, 2.5)
>>> round(midship.area(9.0), 7), round(midship.most_radius, 8)
(281.2485565, 14.30649744)
"""

from __future__ import annotations

import math

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_area import arc_area, arc_moment
from assoc_hull.geometry.classical.arcs import Arcs
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.curves import FloatArray

__all__ = ["Midship"]

_HIGHEST = 1e6
"""No draught (m) reaches up to here."""


def _number(value: object) -> float:
    return float(finite(value, "midship", ()))  # type: ignore[arg-type]


@attrs.frozen
class Midship:
    """A midship section; y outward from the centre line, z up from the base line, m.

    Attributes
    ----------
    half_breadth : float, m
        Of the upright side, above 0.
    flat : float, m
        Half-width of the flat of bottom, from 0 to below the half-breadth.
    rise : float, m
        Rise of floor at the side, not below 0.
    radius : float, m
        Of the bilge; 0 is a chine.
    depth : float or None, m
        Height of the side, if it is to be looked whether the bilge ends below it.

    Raises
    ------
    GeometryError
        ``"midship: b={b} must lie in [0, a)"``, ``"midship: R={R} exceeds the limit {Rmax}"``
        where the bilge would pass the edge of the flat, ``"midship: bilge centre z={zc} above
        the side height {D}"``, and a half-breadth, rise or radius of no section.
    """

    half_breadth: float = attrs.field(converter=_number)
    flat: float = attrs.field(converter=_number)
    rise: float = attrs.field(converter=_number)
    radius: float = attrs.field(converter=_number)
    depth: float | None = attrs.field(
        default=None, converter=attrs.converters.optional(_number)
    )  # fmt: skip

    def __attrs_post_init__(self) -> None:
        a, b = self.half_breadth, self.flat
        _least("a", a, above=True)
        if not 0.0 <= b < a:
            raise GeometryError(
                f"midship: b={figure(b)} must lie in [0, a)",
                f"give a flat narrower than the half-breadth of {figure(a)}", {"b": b, "a": a},
            )  # fmt: skip
        _least("c", self.rise)
        _least("R", self.radius)
        if self.radius > self.most_radius * (1.0 + 1e-12):
            raise GeometryError(
                f"midship: R={figure(self.radius)} exceeds the limit {figure(self.most_radius)}",
                "give a smaller radius: the bilge would pass the edge of the flat",
                {"R": self.radius, "Rmax": self.most_radius},
            )
        if self.depth is not None and self.centre[1] > self.depth:
            raise GeometryError(
                f"midship: bilge centre z={figure(self.centre[1])} above the side height "
                f"{figure(self.depth)}",
                "give a smaller radius or rise", {"zc": self.centre[1], "D": self.depth},
            )  # fmt: skip

    @property
    def floor_angle(self) -> float:
        """Of the floor above the horizontal, rad."""
        return math.atan2(self.rise, self.half_breadth - self.flat)

    @property
    def most_radius(self) -> float:
        """The radius at which the bilge begins at the edge of the flat, m."""
        return (self.half_breadth - self.flat) / (1.0 - math.sin(self.floor_angle))

    @property
    def centre(self) -> tuple[float, float]:
        """Of the bilge circle, (y, z), m."""
        slope, y = self.floor_angle, self.half_breadth - self.radius
        z = (y - self.flat) * math.tan(slope) + self.radius / math.cos(slope)
        return y, z

    @property
    def floor_point(self) -> tuple[float, float]:
        """Where the bilge leaves the floor, (y, z), m."""
        (y, z), slope = self.centre, self.floor_angle
        return y + self.radius * math.sin(slope), z - self.radius * math.cos(slope)

    @property
    def side_point(self) -> tuple[float, float]:
        """Where the bilge comes to the side, (y, z), m."""
        return self.half_breadth, self.centre[1]

    def area(self, draught: float) -> float:
        """Give the area of both sides below a draught (m), m2.

        Raises
        ------
        GeometryError
            A draught below the base line.
        """
        level = float(inside(finite(draught, "midship area", ()), "midship area", 0.0, _HIGHEST))
        a, b, top = self.half_breadth, self.flat, self.centre[1]
        if level >= top:
            turn = 0.5 * math.pi - self.floor_angle
            corner = self.radius**2 * (math.tan(0.5 * turn) - 0.5 * turn)
            return 2.0 * (a * level - 0.5 * self.rise * (a - b) - corner)
        floor = min(level, self.floor_point[1])
        width = b + (floor / math.tan(self.floor_angle) if self.rise else 0.0)
        bilge = self.bilge()
        arc = 0.0 if bilge is None else arc_area(bilge, self.centre, level)
        return (b + width) * floor + 2.0 * arc

    def moment(self, draught: float) -> float:
        """Give the moment of that area about the base line, m3."""
        level = float(inside(finite(draught, "midship area", ()), "midship area", 0.0, _HIGHEST))
        top, bilge = self.centre[1], self.bilge()
        floor = min(level, self.floor_point[1])
        lean = 1.0 / math.tan(self.floor_angle) if self.rise else 0.0
        found = self.flat * floor**2 / 2.0 + lean * floor**3 / 3.0
        if bilge is not None:
            found += arc_moment(bilge, self.centre, level)
        if level > top:
            found += 0.5 * self.half_breadth * (level**2 - top**2)
        return 2.0 * found

    def bilge(self) -> Arcs | None:
        """Give the bilge, from the floor up; None of a chine."""
        if self.radius == 0.0:
            return None
        turn = 0.5 * math.pi - self.floor_angle
        return Arcs.make(
            [self.floor_point], [self.floor_angle], [1.0 / self.radius], [self.radius * turn]
        )

    def half_breadths(self, z: ArrayLike) -> FloatArray:
        """Give half-breadths (m) at heights (m) not below 0, of the same shape.

        At nil it is the outer edge of what is level there.

        Raises
        ------
        GeometryError
            A height below the base line.
        """
        height = inside(z, "midship", 0.0, _HIGHEST)
        (yc, zc), slope = self.centre, self.floor_angle
        low = self.floor_point[1]
        with np.errstate(divide="ignore", invalid="ignore"):
            floor = self.flat + height / math.tan(slope) if slope else np.full_like(height, yc)
        reach = np.sqrt(np.maximum(self.radius**2 - (zc - height) ** 2, 0.0))
        found = np.where(height < low, floor, np.where(height < zc, yc + reach, self.half_breadth))
        return np.asarray(found)


def _least(name: str, value: float, *, above: bool = False) -> None:
    if value < 0.0 or (above and value == 0.0):
        rule = "above 0" if above else "0 or more"
        raise GeometryError(
            f"midship: {name}={figure(value)} must be {rule}", f"give {rule}", {name: value}
        )

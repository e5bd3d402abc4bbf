"""Two demihulls side by side as one floating body: integrals, stations, limits and doubts.

Each demihull is the hull itself with its centre plane at half the separation off the ship's. What
is measured of it below the plane that it meets there is carried over to the ship's axes and added.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.analysis.hydrostatics.demihulls import Demihulls
>>> from assoc_hull.analysis.hydrostatics.flotation import flotation
>>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
>>> from assoc_hull.shipped.wigley import wigley
>>> one = flotation(wigley())
>>> plane = FloatingPlanes(np.array([6.25]), np.zeros(1), np.zeros(1))
>>> both = Demihulls(one, 30.0).measure(plane)
>>> round(float(both.volume[0] / one.measure(plane).volume[0]), 12)
2.0
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import (
    FloatingBody,
    IntegralChange,
    StationAreas,
    WaterplaneLimits,
)
from assoc_hull.arguments import integer, positive
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals

__all__ = ["Demihulls", "checked_separation", "ship_of"]

_WHERE = "in hydrostatics"


def checked_separation(demihulls: object, separation: object, breadth: float) -> float:
    """Take how many demihulls a ship has and how far apart (m) their centre planes are; 0: one.

    Raises
    ------
    BadInputError
        Neither 1 nor 2; two without a separation, or with one less than their breadth (m).
    """
    count = integer(demihulls, "demihulls", _WHERE, least=1, most=2)
    if count == 1:
        if separation is not None:
            what = "separation is given for one hull"
            raise BadInputError(what, _WHERE, "give demihulls=2 too, or leave it out")
        return 0.0
    if separation is None:
        what = "two demihulls, and no separation of their centre planes"
        raise BadInputError(what, _WHERE, "give separation=, m")
    found = positive(separation, "separation", _WHERE)
    if found < breadth:
        what = f"separation is {found:g} m, and each demihull is {breadth:g} m broad"
        raise BadInputError(what, _WHERE, "give the distance between their centre planes, m")
    return found


def ship_of(body: FloatingBody, separation: float) -> FloatingBody:
    """Give the ship of two demihulls; the hull itself if the separation (m) is 0."""
    return Demihulls(body, separation) if separation else body


@attrs.frozen(eq=False)
class Demihulls:
    """A ship of two equal demihulls; implements `FloatingBody`.

    Attributes
    ----------
    body : FloatingBody
        One of them, in its own axes.
    separation : float, m
        Between their centre planes.
    """

    body: FloatingBody
    separation: float

    @property
    def limits(self) -> WaterplaneLimits:
        """What a waterplane must lie between, and the deck edges, inner and outer."""
        one = self.body.limits
        return WaterplaneLimits(self._both(one.bottom), self._both(one.deck), one.closed)

    def _both(self, points: FloatArray) -> FloatArray:
        """Give the points of the port demihull, both sides of it, in the ship's axes."""
        half = np.array([0.0, 0.5 * self.separation, 0.0])
        return np.concatenate([points + half, points * [1.0, -1.0, 1.0] + half])

    def _planes(self, planes: FloatingPlanes) -> list[tuple[FloatingPlanes, float]]:
        """Give the planes as each demihull meets them, in its own axes, and where it stands."""
        half = 0.5 * self.separation
        return [
            (attrs.evolve(planes, height=planes.height - planes.tan_heel * y), y)
            for y in (half, -half)
        ]

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Give the integrals below each plane."""
        port, starboard = (_shifted(self.body.measure(own), y) for own, y in self._planes(planes))
        return _added(port, starboard)

    def stations(self, planes: FloatingPlanes) -> StationAreas:
        """Give the areas of the stations below each plane, of both demihulls."""
        port, starboard = (self.body.stations(own) for own, _ in self._planes(planes))
        return StationAreas(port.x.copy(), port.area + starboard.area, port.names)

    def transom(self, planes: FloatingPlanes) -> FloatArray:
        """Give the area of both transoms below each plane, (d,), m2."""
        port, starboard = (self.body.transom(own) for own, _ in self._planes(planes))
        return np.asarray(port + starboard)

    def changes(self, planes: FloatingPlanes) -> Sequence[IntegralChange]:
        """Give by how much the integrals may be off: what one demihull is off, the other is too."""
        (one, y), (other, z) = self._planes(planes)
        pairs = zip(self.body.changes(one), self.body.changes(other), strict=True)
        return tuple(
            IntegralChange(
                _added(_shifted(port.immersed, y, change=True),
                       _shifted(starboard.immersed, z, change=True), change=True),
                _sum(port.areas, starboard.areas),
                _sum(port.transom, starboard.transom),
            )
            for port, starboard in pairs
        )  # fmt: skip

    def doubts(self, planes: FloatingPlanes, numbers: bool = True) -> Sequence[str]:
        """Name what makes the integrals doubtful, each once."""
        found: list[str] = []
        for own, _ in self._planes(planes):
            # Of a demihull that has come out of the water there is nothing to be compared.
            wet = self.body.measure(own).volume > 0.0
            if wet.any():
                rows = [each[wet] for each in attrs.astuple(own, recurse=False)]
                found += self.body.doubts(FloatingPlanes(*rows), numbers)
        return tuple(dict.fromkeys(found))


def _sum(one: FloatArray | None, other: FloatArray | None) -> FloatArray | None:
    return None if one is None or other is None else one + other


def _shifted(found: ImmersedIntegrals, y: float, *, change: bool = False) -> ImmersedIntegrals:
    """Carry integrals to axes in which the body stands at y; changes of its extent stay."""
    reach = 0.0 if change else y
    return attrs.evolve(
        found,
        moment_y=found.moment_y + y * found.volume,
        area_y=found.area_y + y * found.area,
        area_xy=found.area_xy + y * found.area_x,
        # The transfer term of the parallel axis theorem is y y A.
        area_yy=found.area_yy + 2.0 * y * found.area_y + y * y * found.area,
        y_least=found.y_least + reach,
        y_most=found.y_most + reach,
    )


def _added(
    port: ImmersedIntegrals, starboard: ImmersedIntegrals, *, change: bool = False
) -> ImmersedIntegrals:
    """Add integrals; the extent is that of both, its change that of the outer sides."""
    sums = {
        each.name: getattr(port, each.name) + getattr(starboard, each.name)
        for each in attrs.fields(ImmersedIntegrals)
    }
    if change:
        ends = {"x_least": port.x_least, "x_most": port.x_most}
        sides = {"y_least": starboard.y_least, "y_most": port.y_most}
        return ImmersedIntegrals(**{**sums, **{k: v + 0.0 for k, v in (ends | sides).items()}})
    # A demihull that has come out of the water has no extent: fmin and fmax leave nan out.
    least = {
        name: np.fmin(getattr(port, name), getattr(starboard, name))
        for name in ("x_least", "y_least")
    }
    most = {
        name: np.fmax(getattr(port, name), getattr(starboard, name))
        for name in ("x_most", "y_most")
    }
    return ImmersedIntegrals(**{**sums, **least, **most})

"""A hull at its floating position, with its screw, as the entries of the catalogue measure it.

What several entries need is measured once: `FloatingShape.take` keeps what a measure returned.
Measures are functions of a shape, so that a new one needs no change here. A `Screw` holds what the
lines do not tell of screw and shaft. Lengths in m, x from the AP.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TypeVar, cast

import attrs

from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, require_afloat
from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import table_of
from assoc_hull.analysis.hydrostatics.record import HydrostaticHeader, Hydrostatics
from assoc_hull.arguments import checked, not_negative, number, positive
from assoc_hull.geometry.floating.immersion import FloatingPlanes

__all__ = [
    "FloatingShape",
    "Screw",
]

# --------------------------------------------------------------------------------------
# Screw and shaft.

_WHERE = "in a screw"


def _maybe_positive(value: object, name: str, where: str) -> None:
    if value is not None:
        positive(value, name, where)


def _maybe_number(value: object, name: str, where: str) -> None:
    if value is not None:
        number(value, name, where)


@attrs.frozen
class Screw:
    """Screw and shaft, port side where there are two.

    Attributes
    ----------
    height : float, m
        Of the shaft's centre above the base line, in the plane of the screw.
    diameter : float, m
        Of the screw.
    x : float or None, m
        Plane of the screw, from AP, + forward.
    spacing : float, m
        Between the centres of the shafts of two screws; 0: one screw on the centre line.
    boss_diameter : float or None, m
        Of the stern boss at its aft face.
    boss_x : float or None, m
        Aft face of the stern boss, from AP, + forward.

    Raises
    ------
    BadInputError
        A number that cannot be used.

    Examples
    --------
    >>> from assoc_hull.analysis.form.floating_shape import Screw
    >>> Screw(height=4.2, diameter=6.0, spacing=16.9).spacing
    16.9
    """

    height: float = attrs.field(validator=checked(number, _WHERE))
    diameter: float = attrs.field(validator=checked(positive, _WHERE))
    x: float | None = attrs.field(default=None, validator=checked(_maybe_number, _WHERE))
    spacing: float = attrs.field(default=0.0, validator=checked(not_negative, _WHERE))
    boss_diameter: float | None = attrs.field(
        default=None, validator=checked(_maybe_positive, _WHERE)
    )
    boss_x: float | None = attrs.field(default=None, validator=checked(_maybe_number, _WHERE))


# --------------------------------------------------------------------------------------
# The hull.

STATIONS = 20
"""Station spacings between the perpendiculars, AP being station 0."""

Measured = TypeVar("Measured")


@attrs.frozen(eq=False)
class FloatingShape:
    """A hull at an upright floating position.

    Attributes
    ----------
    body : Flotation
        The surface through the lines, and the lines (`body.net`).
    header : HydrostaticHeader
        Dimensions (length between perpendiculars, moulded breadth, draught of the design), water.
    position : FloatingPosition
        Upright.
    depth : float, m
        Moulded.
    screw : Screw or None
        None: not given.
    """

    body: Flotation
    header: HydrostaticHeader
    position: FloatingPosition
    depth: float
    screw: Screw | None = None
    _kept: dict[object, object] = attrs.field(factory=dict, init=False, repr=False)

    @property
    def length(self) -> float:
        """Lpp, m."""
        return self.header.length

    @property
    def breadth(self) -> float:
        """B, moulded, m."""
        return self.header.breadth

    @property
    def draught(self) -> float:
        """T, the mean of T_A and T_F, m."""
        return self.position.draught_mean

    @property
    def even_keel(self) -> bool:
        """T_A and T_F are equal."""
        return self.position.trim_by_stern == 0.0

    def x_of(self, station: float) -> float:
        """Give where a station is, m from AP: 0 is AP, 20 is FP."""
        return station * self.length / STATIONS

    def station_of(self, x: float) -> float:
        """Give the station at a place, m from AP."""
        return x * STATIONS / self.length

    @cached_property
    def planes(self) -> FloatingPlanes:
        """The floating plane."""
        return require_afloat([self.position], self.body.limits, self.length)

    @cached_property
    def record(self) -> Hydrostatics:
        """Hydrostatics, without estimates."""
        return table_of(self.body, [self.position], self.header, estimate=False)[0]

    def take(self, measure: Callable[[FloatingShape], Measured]) -> Measured:
        """Give what a measure returns for this hull; it is called once."""
        if measure not in self._kept:
            self._kept[measure] = measure(self)
        return cast(Measured, self._kept[measure])

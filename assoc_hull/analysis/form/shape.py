"""A hull at its floating position, as the entries of the catalogue measure it.

What several entries need is measured once: `Shape.take` keeps what a measure gave. Measures
are functions of a shape, so that a new one needs no change here.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TypeVar, cast

import attrs

from assoc_hull.analysis.form.screw import Screw
from assoc_hull.analysis.hydrostatics.compute import table_of
from assoc_hull.analysis.hydrostatics.floating import FloatingPosition, require_afloat
from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.analysis.hydrostatics.hydrostatic_header import HydrostaticHeader
from assoc_hull.analysis.hydrostatics.record import Hydrostatics
from assoc_hull.geometry.floating.immersed import Planes

__all__ = ["Shape"]

STATIONS = 20
"""Of a ship, AP being station 0."""

Measured = TypeVar("Measured")


@attrs.frozen(eq=False)
class Shape:
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
    def planes(self) -> Planes:
        """The floating plane."""
        return require_afloat([self.position], self.body.limits, self.length)

    @cached_property
    def record(self) -> Hydrostatics:
        """Hydrostatics, without estimates."""
        return table_of(self.body, [self.position], self.header, estimate=False)[0]

    def take(self, measure: Callable[[Shape], Measured]) -> Measured:
        """Give what a measure says of this hull; it is asked once."""
        if measure not in self._kept:
            self._kept[measure] = measure(self)
        return cast(Measured, self._kept[measure])

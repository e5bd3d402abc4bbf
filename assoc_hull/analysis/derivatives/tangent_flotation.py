"""A hull whose lines carry derivatives along, put together as it was without them.

The layout is that of the hull as it stands: which lines bound which cell, what is decided. So
the sums are differentiated, not the decisions.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.curve_tangents import CurveTangents, curve_tangents
from assoc_hull.analysis.derivatives.parameters import ShapeParameter
from assoc_hull.analysis.hydrostatics.floating_body import StationAreas
from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.analysis.net.curve_net import CurveNet, sections_of, transom_areas_below
from assoc_hull.analysis.net.moved_layout import move_cells
from assoc_hull.analysis.net.open_ends import with_ends
from assoc_hull.geometry.curves import FloatArray, SplineBatch, Strips
from assoc_hull.geometry.floating.immersed_strips import PreparedStrips, prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from assoc_hull.geometry.floating.sections import sections_below
from assoc_hull.geometry.numeric.dual import Dual, as_array, is_plain
from assoc_hull.geometry.surfaces.coons import CoonsStrips

__all__ = ["TangentFlotation", "tangent_flotation"]


@attrs.frozen(eq=False)
class TangentFlotation:
    """The surface of a net whose splines are of any arithmetic; implements `Measurable`.

    Attributes
    ----------
    base : Flotation
        The hull in plain numbers, which gives the layout.
    batch : SplineBatch
        Its splines: with tangents, complex, or of points that have moved a little.
    points : (n, 3), m
        All points of its tables, in the same arithmetic.
    moving : CurveTangents or None
        What the tangents come from, if these are such.
    """

    base: Flotation
    batch: SplineBatch
    points: FloatArray
    moving: CurveTangents | None = None

    @cached_property
    def net(self) -> CurveNet:
        """The lines."""
        return attrs.evolve(self.base.net, batch=self.batch)

    @cached_property
    def prepared(self) -> PreparedStrips:
        """The surface with its integrals."""
        cells = move_cells(self.base.layout, self.base.net, self.batch, self.points)
        strips: Strips = CoonsStrips.on(cells, self.batch)
        if self.base.ends:
            strips = with_ends(strips, self.net, self.base.closed, self.base.ends)
        return prepare_strips(strips, plain=None if is_plain(self.batch.xyz) else self.base.strips)

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Give the integrals below each plane."""
        return integrate_immersed(self.prepared, planes)

    def stations(self, planes: FloatingPlanes) -> StationAreas:
        """Give the areas of the stations below each plane."""
        found = sections_of(self.net, self.base.closed)
        area = found.per_station(sections_below(found.curves, planes))
        return StationAreas(self._places(found.x), area, found.names)

    def _places(self, x: FloatArray) -> FloatArray:
        """Give where the stations are: where the first points of their first pieces have gone."""
        sections = self.base.sections
        first = sections.curve[np.searchsorted(sections.station, np.arange(len(x)))]
        row = self.batch.start[first]
        was = self.base.net.batch.xyz[row, 0]
        gone: FloatArray = x + (self.batch.xyz[row, 0] - was)
        return gone

    def transom(self, planes: FloatingPlanes) -> FloatArray:
        """Give the area of transoms below each plane, (d,), m2; no end of a bossing is one."""
        return transom_areas_below(self.net, self.base.closed, planes)


def tangent_flotation(base: Flotation, shapes: Sequence[ShapeParameter]) -> TangentFlotation:
    """Give a hull whose lines carry tangents, one per parameter.

    Parameters
    ----------
    base : Flotation
        The hull.
    shapes : sequence of ShapeParameter
        The parameters.

    Raises
    ------
    BadInputError
        A curve of the hull has failed; a parameter that cannot be used.
    """
    found, batch = curve_tangents(base, shapes)
    return TangentFlotation(base, batch, as_array(Dual(found.place, found.points)), found)

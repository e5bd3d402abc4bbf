"""Measures of parts of the ship: what lies between two planes across it, and single sections."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.form.shape import Shape
from assoc_hull.geometry.floating.between_planes import Between, between
from assoc_hull.geometry.floating.cross_sections import cross_section
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.floating.immersed_sections import (
    sections_and_moments_below,
    sections_below,
)
from assoc_hull.geometry.floating.immersion_roots import candidates, cuts, tilt
from assoc_hull.geometry.floating.tiles import from_curves, powers
from assoc_hull.geometry.surfaces.isocurves import IsoCurves

__all__ = ["Slices", "slices"]


@attrs.frozen(eq=False)
class Slices:
    """A hull below its floating plane, part by part; each part is measured once.

    Attributes
    ----------
    shape : Shape
        The hull.
    """

    shape: Shape
    _between: dict[tuple[float, float], Between] = attrs.field(factory=dict, init=False)
    _sections: dict[float, IsoCurves] = attrs.field(factory=dict, init=False)

    def aft_of(self, x: float) -> Between:
        """Give all that lies aft of a place, m from AP, overhang included."""
        return self._part(-np.inf, x)

    def forward_of(self, x: float) -> Between:
        """Give all that lies forward of a place, m from AP, bulb included."""
        return self._part(x, np.inf)

    def _part(self, aft: float, fore: float) -> Between:
        if (aft, fore) not in self._between:
            found = between(self.shape.body.spans, aft, fore, self.shape.planes)
            self._between[aft, fore] = found
        return self._between[aft, fore]

    def section(self, x: float) -> IsoCurves:
        """Give the section at a place, port side."""
        if x not in self._sections:
            self._sections[x] = cross_section(self.shape.body.spans, x)
        return self._sections[x]

    def area(self, x: float) -> float:
        """Give the immersed area of the section at a place, both sides, m2."""
        return float(sections_below(self.section(x), self.shape.planes).sum())

    def centre(self, x: float) -> float:
        """Give the height of the centre of the immersed section at a place, m."""
        area, moment = sections_and_moments_below(self.section(x), self.shape.planes)
        return float(moment.sum() / area.sum())

    def half_breadth(self, x: float, plane: Planes) -> float | None:
        """Give the outermost place of a waterline at x, m; None where there is none."""
        tiles = from_curves(self.section(x))
        tilted = tilt(tiles, plane.tan_trim, plane.tan_heel)
        tile, _ = candidates(tilted, plane.height)
        met = cuts(tilted, tile, np.repeat(plane.height, len(tile)))
        y = (tiles.coefficients[1][:, tile[met.pair]] * powers(met.u)).sum(axis=0)
        return float(y.max()) if len(y) else None

    def runs_back(self, x: float) -> bool:
        """Tell whether a raked end of the surface is there that runs back somewhere."""
        strips = self.shape.body.spans
        met = np.flatnonzero((strips.aft < x) & (strips.fore > x) & ~strips.flat)
        return not all(strips.raked[strip].forward for strip in met.tolist())


def slices(shape: Shape) -> Slices:
    """Give the parts of a hull; to be asked by `Shape.take`."""
    return Slices(shape)

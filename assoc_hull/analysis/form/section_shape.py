"""Measures of half sections anywhere along the ship."""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np

from assoc_hull.analysis.form.half_section import half_section
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent, Found
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.integrals.area_moments import section_area
from assoc_hull.geometry.integrals.beside import area_along, beside, one_way
from assoc_hull.geometry.splines.plane_places import across, turning_places
from assoc_hull.geometry.splines.segments import power

__all__ = ["Section", "radius_of_three", "section_at"]


@attrs.frozen(eq=False)
class Section:
    """A half section, port side.

    Attributes
    ----------
    x : float, m
        Where it stands.
    curves : SplineBatch
        Its pieces, each from keel to deck.
    """

    x: float
    curves: SplineBatch

    @cached_property
    def lowest(self) -> FloatArray:
        """Its lowest place, (3,), m; the one nearest to the centre plane if there are several."""
        places = np.concatenate(turning_places(self.curves, 2))
        low = places[places[:, 2] <= places[:, 2].min() + 1e-9]
        found: FloatArray = low[int(np.abs(low[:, 1]).argmin())]
        return found

    @property
    def at_centre(self) -> float | None:
        """Lowest height at which it stands on the centre plane, m; None if it does not."""
        places = self.curves.xyz[np.abs(self.curves.xyz[:, 1]) <= 1e-4]
        return float(places[:, 2].min()) if len(places) else None

    def half_breadth(self, z: float) -> float | None:
        """Give the greatest half-breadth at a height: that of the outer skin; None if none."""
        found = across(self.curves, 2, z).xyz[:, 1]
        return float(found.max()) if len(found) else None

    def heights(self, y: float) -> FloatArray:
        """Give the heights at a half-breadth, ascending, m."""
        return np.sort(across(self.curves, 1, y).xyz[:, 2])

    def skins(self, z: float) -> FloatArray:
        """Give the half-breadths at a height, ascending, m."""
        return np.sort(across(self.curves, 2, z).xyz[:, 1])

    def greatest_below(self, z: float) -> float | None:
        """Give the greatest half-breadth at or below a height, m; None if nothing is there."""
        places = np.concatenate([*turning_places(self.curves, 1), across(self.curves, 2, z).xyz])
        low = places[places[:, 2] <= z + 1e-9]
        return float(low[:, 1].max()) if len(low) else None

    def area_below(self, z: float) -> float:
        """Give the area of both sides below a height, m2."""
        return 2.0 * float(section_area(self.curves, z).sum())

    def outside(self, low: float, high: float) -> float:
        """Integrate the half-breadth of the outer skin between two heights, m2.

        The outer skin goes up from the lowest place.
        """
        total = 0.0
        for i in range(self.curves.count):
            cubic = one_way(power(self.curves.part(i, i + 1)), 2)
            cubic = cubic[int(cubic[:, 0, 2].argmin()) :]
            for normal, offset in ((1.0, high), (-1.0, -low)):
                cubic = beside(cubic, np.array([0.0, 0.0, normal]), offset)
            total += area_along(cubic, (1, 2))
        return total


def section_at(shape: Shape, x: float) -> Section | None:
    """Give the half section at a place, m from AP; None where there is none."""
    known = shape.take(_known)
    if x not in known:
        curves = half_section(shape.body, x)
        known[x] = None if curves is None else Section(x, curves)
    return known[x]


def _known(shape: Shape) -> dict[float, Section | None]:
    """Keep the sections of a hull that were asked for."""
    return {}


def radius_of_three(section: Section | None, draught: float) -> Found:
    """Give the radius through three places at quarters of the draught, m; + if convex."""
    heights = np.array([0.25, 0.5, 0.75]) * draught
    found = [None if section is None else section.half_breadth(z) for z in heights.tolist()]
    breadths = [each for each in found if each is not None]
    if len(breadths) < 3:
        return Absent("no section there at a quarter, half or three quarters of the draught")
    a, b, c = np.column_stack([breadths, heights])
    chord, side = c - a, b - a
    # Twice the triangle's area, + where the place between lies outside the chord.
    double = float(side[0] * chord[1] - side[1] * chord[0])
    sides = float(np.hypot(*chord) * np.hypot(*side) * np.hypot(*(c - b)))
    if abs(double) <= 1e-9 * float(chord @ chord):
        return Absent("the section is straight there")
    return sides / (2.0 * double)

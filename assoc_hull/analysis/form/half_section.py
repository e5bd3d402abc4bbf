"""Half sections anywhere along a hull, and what is measured of them.

At a station or an end the section is the drawn one, elsewhere it is cut from the surface through
the lines. Half sections are to port, from keel to deck, m, x from the AP. `section_at` keeps those
that a shape was asked for.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.parameter import Absent, MeasuredValue
from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves, SplineBatch
from assoc_hull.geometry.floating.sections import cross_section
from assoc_hull.geometry.integrals.area_moments import section_area
from assoc_hull.geometry.integrals.chains import area_along, clip_cubics, monotone_cubics
from assoc_hull.geometry.splines.paths import restrict_cubics
from assoc_hull.geometry.splines.plane_intersections import coordinate_turns, points_at_coordinate
from assoc_hull.geometry.splines.segments import power_coefficients

__all__ = [
    "HalfSection",
    "half_section",
    "radius_of_three",
    "section_at",
]

# --------------------------------------------------------------------------------------
# As drawn, or cut from the surface.

_ON = 1e-4
"""A section this near to a station (m) is the drawn one."""


def half_section(body: Flotation, x: float) -> SplineBatch | None:
    """Give the half section at x (m), one curve for each piece; None where the hull has none.

    A closed deck is no part of it.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.analysis.form.half_section import half_section
    >>> from assoc_hull.shipped.wigley import wigley
    >>> section = half_section(flotation(wigley()), 50.0)
    >>> round(float(section.xyz[:, 1].max()), 6)  # B / 2
    5.0
    """
    pieces = _drawn(body, x) or _end(body, x) or _between(body, x)
    return SplineBatch.join([_spline(each) for each in pieces]) if pieces else None


def _spline(cubic: FloatArray) -> SplineBatch:
    """Make a spline of cubics one behind the other, (s, 4, 3); its knots are their chords."""
    first, last = cubic[:, 0], cubic[-1:].sum(axis=1)
    xyz = np.concatenate([first, last])
    chord = np.sqrt((np.diff(xyz, axis=0) ** 2).sum(axis=1))
    whole = chord > 0.0
    if not whole.all():
        return _spline(cubic[whole])
    leave = cubic[:, 1] / chord[:, None]
    arrive = (cubic[:, 1] + 2.0 * cubic[:, 2] + 3.0 * cubic[:, 3]) / chord[:, None]
    knot = np.concatenate([[0.0], np.cumsum(chord)])
    return SplineBatch(
        np.array([0, len(xyz)]),
        knot,
        xyz,
        np.concatenate([leave, arrive[-1:]]),
        np.concatenate([leave[:1], arrive]),
    )


def _drawn(body: Flotation, x: float) -> list[FloatArray]:
    """Give the pieces of a station, if one stands there."""
    found = body.sections
    near = np.flatnonzero(np.abs(found.x - x) <= _ON)
    if not len(near):
        return []
    return _pieces(found.curves, np.flatnonzero(found.station == near[0]))


def _end(body: Flotation, x: float) -> list[FloatArray]:
    """Give the curves of a transom or another end across the ship, if one stands there."""
    net = body.net
    chosen = np.flatnonzero(net.end & (np.abs(net.x - x) <= _ON))
    return [_upward(power_coefficients(net.batch.part(i, i + 1))) for i in chosen.tolist()]


def _upward(cubic: FloatArray) -> FloatArray:
    """Turn cubics (s, 4, 3) one behind the other to run upward, each from end to beginning."""
    if cubic[0, 0, 2] <= cubic[-1].sum(axis=0)[2]:
        return cubic
    one = np.ones(len(cubic))
    return restrict_cubics(cubic[::-1], one, 0.0 * one)


def _between(body: Flotation, x: float) -> list[FloatArray]:
    """Give the pieces of the surface's section between two stations, or beyond the last ones."""
    found = cross_section(body.spans, x)
    return _pieces(found, np.arange(found.count))


def _pieces(curves: IsoCurves, chosen: IntArray) -> list[FloatArray]:
    """Give the cubics of curves, without their decks; a curve that is but a point has none."""
    long = ~curves.deck & (np.abs(curves.point[:, 1:]).max(axis=(1, 2), initial=0.0) > 0.0)
    bounds = curves.start[:-1], curves.start[1:]
    spans = [slice(int(bounds[0][i]), int(bounds[1][i])) for i in chosen.tolist()]
    pieces = [curves.point[span][long[span]] for span in spans]
    return [piece for piece in pieces if len(piece)]


# --------------------------------------------------------------------------------------
# Measures.


@attrs.frozen(eq=False)
class HalfSection:
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
        """Its lowest point, (3,), m; the one nearest to the centre plane if there are several."""
        places = np.concatenate(coordinate_turns(self.curves, 2))
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
        found = points_at_coordinate(self.curves, 2, z).xyz[:, 1]
        return float(found.max()) if len(found) else None

    def heights(self, y: float) -> FloatArray:
        """Give the heights at a half-breadth, ascending, m."""
        return np.sort(points_at_coordinate(self.curves, 1, y).xyz[:, 2])

    def skins(self, z: float) -> FloatArray:
        """Give the half-breadths at a height, ascending, m."""
        return np.sort(points_at_coordinate(self.curves, 2, z).xyz[:, 1])

    def greatest_below(self, z: float) -> float | None:
        """Give the greatest half-breadth at or below a height, m; None if nothing is there."""
        places = np.concatenate(
            [*coordinate_turns(self.curves, 1), points_at_coordinate(self.curves, 2, z).xyz]
        )
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
            cubic = monotone_cubics(power_coefficients(self.curves.part(i, i + 1)), 2)
            cubic = cubic[int(cubic[:, 0, 2].argmin()) :]
            for normal, offset in ((1.0, high), (-1.0, -low)):
                cubic = clip_cubics(cubic, np.array([0.0, 0.0, normal]), offset)
            total += area_along(cubic, (1, 2))
        return total


def section_at(shape: FloatingShape, x: float) -> HalfSection | None:
    """Give the half section at a place, m from AP; None where there is none."""
    known = shape.take(_known)
    if x not in known:
        curves = half_section(shape.body, x)
        known[x] = None if curves is None else HalfSection(x, curves)
    return known[x]


def _known(shape: FloatingShape) -> dict[float, HalfSection | None]:
    """Keep the sections of a hull that were asked for."""
    return {}


def radius_of_three(section: HalfSection | None, draught: float) -> MeasuredValue:
    """Give the radius (m) through three points at quarters of the draught; + if convex."""
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

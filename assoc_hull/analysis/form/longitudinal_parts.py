"""Measures of parts of the ship: between transverse planes, its largest section, its parallel body.

Parts and single sections are those of the surface, measured once each (`ShipSlices`). The largest
section may stand between stations; how far others are as large makes the parallel middle body. All
are measures for `FloatingShape.take`; x is from the AP, m.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.raked_strips import StripSpans
from assoc_hull.geometry.floating.sections import (
    SliceIntegrals,
    areas_at,
    cross_section,
    integrate_slice,
    sections_and_moments_below,
    sections_below,
)
from assoc_hull.geometry.floating.tiles import (
    candidate_pairs,
    cubic_powers,
    cut_tiles,
    tiles_of_curves,
    tilt_tiles,
)

__all__ = [
    "EQUAL",
    "LargestSection",
    "ShipSlices",
    "largest_section",
    "parallel_body",
    "ship_slices",
]

# --------------------------------------------------------------------------------------
# Parts and single sections.


@attrs.frozen(eq=False)
class ShipSlices:
    """A hull below its floating plane, part by part; each part is measured once.

    Attributes
    ----------
    shape : FloatingShape
        The hull.
    """

    shape: FloatingShape
    _between: dict[tuple[float, float], SliceIntegrals] = attrs.field(factory=dict, init=False)
    _sections: dict[float, IsoCurves] = attrs.field(factory=dict, init=False)

    def aft_of(self, x: float) -> SliceIntegrals:
        """Give all that lies aft of a place, m from AP, overhang included."""
        return self._part(-np.inf, x)

    def forward_of(self, x: float) -> SliceIntegrals:
        """Give all that lies forward of a place, m from AP, bulb included."""
        return self._part(x, np.inf)

    def _part(self, aft: float, fore: float) -> SliceIntegrals:
        if (aft, fore) not in self._between:
            found = integrate_slice(self.shape.body.spans, aft, fore, self.shape.planes)
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

    def half_breadth(self, x: float, plane: FloatingPlanes) -> float | None:
        """Give the half-breadth of a waterline at x, m; None where there is none."""
        tiles = tiles_of_curves(self.section(x))
        tilted = tilt_tiles(tiles, plane.tan_trim, plane.tan_heel)
        tile, _ = candidate_pairs(tilted, plane.height)
        met = cut_tiles(tilted, tile, np.repeat(plane.height, len(tile)))
        y = (tiles.coefficients[1][:, tile[met.pair]] * cubic_powers(met.u)).sum(axis=0)
        return float(y.max()) if len(y) else None

    def runs_back(self, x: float) -> bool:
        """Tell whether a raked end of the surface is there that runs back somewhere."""
        strips = self.shape.body.spans
        met = np.flatnonzero((strips.aft < x) & (strips.fore > x) & ~strips.flat)
        return not all(strips.raked[strip].forward for strip in met.tolist())


def ship_slices(shape: FloatingShape) -> ShipSlices:
    """Give the parts of a hull; a measure for `FloatingShape.take`."""
    return ShipSlices(shape)


# --------------------------------------------------------------------------------------
# The largest section, and how far others are as large.

EQUAL = 1e-4
"""Areas of sections of the parallel middle body differ by less, in parts of the largest."""

_SHORT = 0.02
"""Of Lpp: what is level over less is no parallel middle body."""

_WIDE = 1e-2
_RATIO = 0.25
"""The top of a parabola that is level to `_WIDE` over some length is level to `EQUAL` over 1/10
of it; a stretch that is more than this part of it does not come from a rounded top."""

_SAME = 1e-12
_COARSE = 4  # parts of each strip, at whose ends it is looked at first
_SAMPLES = 9  # on each bracket
_ROUNDS = 7


@attrs.frozen
class LargestSection:
    """Where the sectional-area curve is greatest, and where it is level.

    Attributes
    ----------
    largest : float, m2
        A_max, of all sections, also between stations.
    x_largest : float, m
        Where it is; of several places that nearest to midship.
    level : (float, float) or None, m
        The parallel middle body: first and last place at which the area is that of the largest
        section but for 1e-4 of it; None if it is too short for one.
    """

    largest: float
    x_largest: float
    level: tuple[float, float] | None

    @property
    def run(self) -> float:
        """Where the run ends: the parallel middle body begins, or the largest section is; m."""
        return self.x_largest if self.level is None else self.level[0]

    @property
    def entrance(self) -> float:
        """Where the entrance begins: behind it the parallel middle body or largest section; m."""
        return self.x_largest if self.level is None else self.level[1]


def largest_section(shape: FloatingShape) -> LargestSection:
    """Look along a hull below its floating plane; a measure for `FloatingShape.take`."""
    return _along(shape, shape.planes)


def parallel_body(shape: FloatingShape) -> LargestSection:
    """Look along a hull at even keel at the mean draught; a measure for `FloatingShape.take`.

    With a trim the sections of a parallel middle body have different areas.
    """
    if shape.even_keel:
        return shape.take(largest_section)
    return _along(shape, FloatingPlanes(np.array([shape.draught]), np.zeros(1), np.zeros(1)))


def _along(shape: FloatingShape, plane: FloatingPlanes) -> LargestSection:
    strips = shape.body.spans

    def areas(x: FloatArray) -> FloatArray:
        return areas_at(strips, x, plane)

    x = _samples(strips)
    area = areas(x)
    for _ in range(_ROUNDS):
        tops = _tops(area)
        # The neighbours of a top bracket it: more samples go between them.
        ends = x[np.maximum(tops - 1, 0)], x[np.minimum(tops + 1, len(x) - 1)]
        more = np.setdiff1d(np.linspace(*ends, _SAMPLES), x)
        order = np.argsort(np.concatenate([x, more]))
        area = np.concatenate([area, areas(more)])[order]
        x = np.concatenate([x, more])[order]
    largest = float(area.max())
    near = np.where(area >= (1.0 - _SAME) * largest, np.abs(x - 0.5 * shape.length), np.inf)
    place = float(x[near.argmin()])
    least = (1.0 - np.array([EQUAL, _WIDE])) * largest
    level, wide = _level(areas, x, area, least)
    length = level[1] - level[0]
    parallel = length >= _SHORT * shape.length and length >= _RATIO * (wide[1] - wide[0])
    return LargestSection(largest, place, level if parallel else None)


def _samples(strips: StripSpans) -> FloatArray:
    """Give places along the ship from the first section to the last, ascending, m.

    None inside raked strips, which lie at the ends and whose sections must be traced.
    """
    flat = strips.flat & (strips.fore > strips.aft)
    if not flat.any():
        return np.linspace(strips.aft.min(), strips.fore.max(), 5 * _COARSE + 1)
    edge = np.unique(np.concatenate([strips.aft[flat], strips.fore[flat]]))
    part = np.arange(_COARSE) / _COARSE
    x = np.append((edge[:-1, None] + np.diff(edge)[:, None] * part).ravel(), edge[-1:])
    low, high = strips.aft[~strips.flat], strips.fore[~strips.flat]
    inside = ((x[:, None] > low) & (x[:, None] < high)).any(axis=1)
    return x[~inside | np.isin(x, edge)]


def _tops(area: FloatArray) -> IntArray:
    """Give where areas along the ship are greatest, or nearly: also both ends of what is level.

    Next to a parallel middle body the surface may rise above it by less than a line shows.
    """
    most = float(area.max())
    around = np.concatenate([[-np.inf], area, [-np.inf]])
    low = np.minimum(around[:-2], around[2:])
    high = np.maximum(around[:-2], around[2:])
    same = _SAME * most
    top = (area >= (1.0 - EQUAL) * most) & (area >= high - same) & (area > low + same)
    return np.flatnonzero(top) if top.any() else np.array([int(area.argmax())])


def _level(
    areas: Callable[[FloatArray], FloatArray], x: FloatArray, area: FloatArray, least: FloatArray
) -> list[tuple[float, float]]:
    """Give the first and the last place at which areas are not less than some areas (k,)."""
    outside, inside = [], []
    for each in least.tolist():
        above = np.flatnonzero(area >= each)
        first, last = int(above[0]), int(above[-1])
        inside += [x[first], x[last]]
        outside += [x[max(first - 1, 0)], x[min(last + 1, len(x) - 1)]]
    out, within, rows = np.array(outside), np.array(inside), np.arange(len(inside))
    part = np.linspace(0.0, 1.0, _SAMPLES)
    for _ in range(_ROUNDS):
        tried = out[:, None] + (within - out)[:, None] * part
        enough = areas(tried.ravel()).reshape(tried.shape) >= least.repeat(2)[:, None]
        enough[:, 0], enough[:, -1] = False, True
        # The first sample that is enough, and the one before, are the next bracket.
        k = enough.argmax(axis=1)
        out, within = tried[rows, k - 1], tried[rows, k]
    return [(float(a), float(b)) for a, b in within.reshape(-1, 2)]

"""The shapes of many curves as one batch, for pictures and measures that look at all of them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, partial
from typing import Self, cast

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.integrals.area_moments import section_area
from assoc_hull.geometry.splines.distance import closest_points_each
from assoc_hull.model.tables import HullState

__all__ = [
    "HullShapes",
    "Shapes",
    "chosen_curves",
    "joined",
    "lofted_curves",
    "section_areas",
    "shapes_of",
]


@attrs.frozen(eq=False)
class Shapes:
    """Curves of a hull as one batch.

    Attributes
    ----------
    curves : (m,) int
        Their numbers, ascending.
    spline : SplineBatch
        Their splines, in that order.
    """

    curves: IntArray
    spline: SplineBatch


def shapes_of(state: HullState) -> Shapes:
    """Give all curves that have a shape."""
    curves = lofted_curves(state)
    freeze(curves)
    return Shapes(curves, joined([state.spline(curve) for curve in curves.tolist()]))


def lofted_curves(state: HullState) -> IntArray:
    """Give the curves that have a shape, ascending."""
    held = state.curves.spline.data
    return np.array([each for each in state.live("curves").tolist() if held[each] is not None], int)


def joined(splines: Sequence[SplineBatch]) -> SplineBatch:
    """Put curves into one batch; there may be none."""
    if splines:
        return SplineBatch.join(list(splines))
    nowhere = np.zeros((0, 3))
    return SplineBatch(np.zeros(1, np.int64), np.zeros(0), nowhere, nowhere.copy(), nowhere.copy())


# --------------------------------------------------------------------------------------
# A hull that other shapes are measured against.


@attrs.frozen(eq=False, slots=False)
class HullShapes:
    """The curves of a hull, and what is about its volume: what other shapes are measured against.

    Attributes
    ----------
    splines : sequence of SplineBatch or None
        By the numbers of curves: their shapes.
    draught : float, m
        The design draught.
    section_curves, station_of : (k,) int
        Curves of plane sections across the ship, ascending, and at which of `stations` they lie.
    stations : (s,), m
        Where these are, ascending.
    """

    splines: Sequence[SplineBatch | None]
    draught: float
    section_curves: IntArray
    station_of: IntArray
    stations: FloatArray

    @classmethod
    def of(cls, state: HullState) -> Self:
        """Take what is there; splines are frozen, so that later edits leave them alone."""
        curves, lines, splines = state.curves, state.lines, state.curves.spline.data
        depends_on = (
            curves.alive, curves.line, curves.state, lines.planar, lines.normal, lines.boundary,
            lines.offset,
        )  # fmt: skip
        sections = state.derived(("plane sections",), depends_on, partial(_plane_sections, state))
        if any(splines[curve] is None for curve in sections[1]):  # that could not be made
            sections = _plane_sections(state)
        return cls(splines, state.particulars.draught, sections[0], *sections[2:])

    def shapes(self, curves: IntArray) -> SplineBatch:
        """Give some curves that have a shape, in their order; there is one."""
        # Those of a state that is published all have one, or the callers have asked.
        return SplineBatch.join(
            cast("list[SplineBatch]", [self.splines[i] for i in curves.tolist()])
        )

    @cached_property
    def areas(self) -> FloatArray:
        """Area of the half section within each of the section curves, below the draught, m2."""
        if not len(self.section_curves):
            return np.zeros(0)
        return section_areas(self.shapes(self.section_curves), self.draught)

    def changes(self, curves: IntArray, spline: SplineBatch) -> tuple[float, float]:
        """Give about how much volume, m3, and its centre, m, change with other shapes of curves.

        Of both sides, below the design draught: trapezes between the sections that changed and
        those beside them. The centre is nan where there is no volume.
        """
        chosen = np.flatnonzero(np.isin(curves, self.section_curves))
        where = np.searchsorted(self.section_curves, curves[chosen])
        change = np.zeros(len(self.stations))
        areas = section_areas(chosen_curves(spline, chosen), self.draught)
        np.add.at(change, self.station_of[where], areas - self.areas[where])
        more, moment = (
            2.0 * float(np.trapezoid(change * self.stations**power, self.stations))
            for power in (0, 1)
        )
        volume, first = self.volume
        after = volume + more
        if not after > 0.0 or not volume > 0.0:
            return more, float("nan")
        return more, (first + moment) / after - first / volume

    @cached_property
    def volume(self) -> tuple[float, float]:
        """Volume of both sides by trapezes, m3, and its moment about x = 0, m4."""
        area = np.zeros(len(self.stations))
        np.add.at(area, self.station_of, self.areas)
        return tuple(  # type: ignore[return-value]
            2.0 * float(np.trapezoid(area * self.stations**power, self.stations))
            for power in (0, 1)
        )

    def distances(self, curves: IntArray, spline: SplineBatch) -> FloatArray:
        """Give the distance of the farthest defining point of each curve from what is published."""
        found = np.full(len(curves), np.nan)
        count = len(self.splines)
        known = np.array(
            [curve < count and self.splines[curve] is not None for curve in curves.tolist()], bool
        )
        if not known.any():
            return found
        old = self.shapes(curves[known])
        new = chosen_curves(spline, np.flatnonzero(known))
        owner = np.repeat(np.arange(new.count), np.diff(new.start))
        away = closest_points_each(old, owner, new.xyz)[2]
        found[known] = np.maximum.reduceat(away, new.start[:-1])
        return found


def _plane_sections(state: HullState) -> tuple[IntArray, list[int], IntArray, FloatArray]:
    """Give plane sections that have a shape, ascending, and as a list; their stations, and those.

    The third are numbers of stations, one for each section; the last are where they lie, m.
    """
    curves, splines = state.live("curves"), state.curves.spline.data
    line = state.curves.line[curves]
    across = state.lines.planar[line] & (np.abs(state.lines.normal[line, 0]) == 1.0)
    # An end plate in a plane of its own is a boundary curve: it is no section.
    across &= state.lines.boundary[line] < 0
    mine = np.array([i for i in curves[across].tolist() if splines[i] is not None], np.int64)
    line = state.curves.line[mine]
    x = state.lines.offset[line] * state.lines.normal[line, 0]
    stations, station_of = np.unique(x, return_inverse=True)
    freeze(mine, stations, station_of)
    return mine, mine.tolist(), station_of, stations


def chosen_curves(batch: SplineBatch, places: IntArray) -> SplineBatch:
    """Give some curves of a batch; none may be chosen."""
    if len(places) == batch.count:
        return batch
    return batch.take(places)


def section_areas(batch: SplineBatch, draught: float) -> FloatArray:
    """Give the area of the half section within each curve, below a draught (m), m2."""
    return section_area(batch, draught) if batch.count else np.zeros(0)

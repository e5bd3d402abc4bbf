"""The largest section of the surface, also between stations, and how far others are as large."""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.analysis.form.shape import Shape
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.cross_sections import areas_at
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.floating.strip_spans import Spans

__all__ = ["EQUAL", "LargestSection", "largest_section", "parallel_body"]

EQUAL = 1e-4
"""Areas of sections of the parallel middle body differ by less, in parts of the largest."""

_SHORT = 0.02
"""Of Lpp: what is level over less is no parallel middle body."""

_WIDE = 1e-2
_RATIO = 0.25
"""The top of a parabola that is level to `_WIDE` over some length is level to `EQUAL` over 1/10
of it; a stretch that is more than so much of it does not come from a rounded top."""

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


def largest_section(shape: Shape) -> LargestSection:
    """Look along a hull below its floating plane; to be asked by `Shape.take`."""
    return _along(shape, shape.planes)


def parallel_body(shape: Shape) -> LargestSection:
    """Look along a hull at even keel at the mean draught; to be asked by `Shape.take`.

    With a trim the sections of a parallel middle body have different areas.
    """
    if shape.even_keel:
        return shape.take(largest_section)
    return _along(shape, Planes(np.array([shape.draught]), np.zeros(1), np.zeros(1)))


def _along(shape: Shape, plane: Planes) -> LargestSection:
    strips = shape.body.spans

    def areas(x: FloatArray) -> FloatArray:
        return areas_at(strips, x, plane)

    x = _samples(strips)
    area = areas(x)
    for _ in range(_ROUNDS):
        tops = _tops(area)
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


def _samples(strips: Spans) -> FloatArray:
    """Give places along the ship from the first section to the last, ascending, m.

    None inside of raked strips, which lie at the ends and must be traced.
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
        k = enough.argmax(axis=1)
        out, within = tried[rows, k - 1], tried[rows, k]
    return [(float(a), float(b)) for a, b in within.reshape(-1, 2)]

"""The benchmark form: a closed formula, its sections, and the lines cut from them.

L 100 m, B 16 m, D 10 m, x from -50 to 50 m; 60 sections of 40 points, 40 waterlines equally
spaced over the depth and 30 buttocks over the half-breadth. Waterlines and buttocks run
through the meetings of the sections with their planes, and on to where the form ends: to
x = -50 and 50 m, a buttock to the deck edge if that comes before.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes

__all__ = ["BUTTOCKS", "FAMILIES", "SECTIONS", "WATERLINES", "Shape", "shape"]

HALF_LENGTH = 50.0
SECTIONS = HALF_LENGTH * np.linspace(-0.98, 0.98, 60)
WATERLINES = np.linspace(0.0, 10.0, 42)[1:-1]
BUTTOCKS = np.linspace(0.0, 8.0, 32)[1:-1]
FAMILIES = (("sections", 0, SECTIONS), ("waterlines", 2, WATERLINES), ("buttocks", 1, BUTTOCKS))
"""Name, axis of the normal, and offsets (m) of the planes."""

POINTS = 40
"""On each section."""

BEYOND = 4
"""Points of a line beyond the outermost section that it meets, at either end."""

Point = tuple[float, float, float]


@attrs.frozen(eq=False)
class Shape:
    """Points of all lines, by family.

    Attributes
    ----------
    sections, waterlines, buttocks : tuple of (n, 3), m
        Points in order: sections upward, the others from aft forward.
    """

    sections: tuple[FloatArray, ...]
    waterlines: tuple[FloatArray, ...]
    buttocks: tuple[FloatArray, ...]

    def families(self) -> tuple[tuple[FloatArray, ...], ...]:
        return self.sections, self.waterlines, self.buttocks


def _parameters(s: float) -> tuple[float, float, float, float, float]:
    keel = 0.2 * abs(s) ** 3 + 7.5 * max(0.0, s - 0.8) ** 2
    return 8.0 * (1 - 0.92 * s**4), 10.0 + 2 * s * s, keel, 0.55 + 0.8 * s * s, 0.55 + 0.35 * s * s


def section(s: float) -> FloatArray:
    """Give the points of the section at s = x / 50 m."""
    t = np.linspace(0.0, np.pi / 2, POINTS)
    breadth, deck, keel, a, b = _parameters(s)
    y, z = breadth * np.sin(t) ** a, deck - (deck - keel) * np.abs(np.cos(t)) ** b
    y[0], z[-1] = 0.0, deck
    return np.column_stack([np.full(POINTS, HALF_LENGTH * s), y, z])


def _waterline(s: float, z: float) -> list[Point]:
    """Give the point of a waterline at s, if it reaches so far."""
    breadth, deck, keel, a, b = _parameters(s)
    if z <= keel:
        return []
    t = np.arccos(((deck - z) / (deck - keel)) ** (1 / b))
    return [(HALF_LENGTH * s, float(breadth * np.sin(t) ** a), z)]


def _buttock(s: float, y: float) -> list[Point]:
    """Give the point of a buttock at s."""
    breadth, deck, keel, a, b = _parameters(s)
    cosine = np.sqrt(max(0.0, 1.0 - (y / breadth) ** (2.0 / a)))
    return [(HALF_LENGTH * s, y, float(deck - (deck - keel) * cosine**b))]


def _completed(
    line: FloatArray, last: float, point: Callable[[float, float], list[Point]], place: float
) -> FloatArray:
    """Carry a line on from its outermost sections to where the form ends, at -last and last."""
    aft, forward = (line[[0, -1], 0] / HALF_LENGTH).tolist()
    parts = np.linspace(0.0, 1.0, BEYOND + 1)[1:]
    ends = []
    for outermost, tip, order in ((aft, -last, -1), (forward, last, 1)):
        steps = (outermost + (tip - outermost) * parts[::order]).tolist()
        found = [xyz for s in steps for xyz in point(s, place)]
        ends.append(np.array(found).reshape(-1, 3))
    return np.concatenate([ends[0], line, ends[1]])


def batch_of(lines: tuple[FloatArray, ...]) -> CurveData:
    """Give smooth curves with free ends through points."""
    size = sum(len(line) for line in lines)
    start = np.concatenate([[0], np.cumsum([len(line) for line in lines])])
    free = np.zeros((len(lines), 2), np.int8), np.zeros((len(lines), 2, 3))
    return CurveData(
        start, np.concatenate(lines), np.zeros(size, np.int8), np.zeros((size, 3)), *free
    )


def _through(sections: SplineBatch, axis: int, offsets: FloatArray) -> list[FloatArray]:
    """Give the places where the sections meet each plane, from aft forward."""
    met = intersect_planes(sections, np.eye(3)[axis], offsets)
    return [met.xyz[met.plane == plane] for plane in range(len(offsets))]


def shape() -> Shape:
    """Make the points of all lines."""
    sections = tuple(section(x / HALF_LENGTH) for x in SECTIONS.tolist())
    lofted = loft(batch_of(sections))
    waterlines = [
        _completed(line, 1.0, _waterline, z)
        for z, line in zip(WATERLINES.tolist(), _through(lofted, 2, WATERLINES), strict=True)
    ]
    buttocks = [
        _completed(line, min(1.0, ((1.0 - y / 8.0) / 0.92) ** 0.25), _buttock, y)
        for y, line in zip(BUTTOCKS.tolist(), _through(lofted, 1, BUTTOCKS), strict=True)
    ]
    return Shape(sections, tuple(waterlines), tuple(buttocks))

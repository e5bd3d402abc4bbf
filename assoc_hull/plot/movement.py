"""How far lines lie from where they were.

Examples
--------
>>> from assoc_hull.examples.wigley import wigley
>>> from assoc_hull.plot.drawing import drawing
>>> from assoc_hull.plot.movement import movements
>>> movements(drawing(wigley()), drawing(wigley()))
()
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.spline import sample
from assoc_hull.plot.drawing import Drawing, DrawnLine

__all__ = ["LineMovement", "movements"]

_FINE = 64
"""Chords per segment of the line as it was, against which the distance is taken."""

_LEAST = 5e-5
"""Movements below this (m) are not told."""


@attrs.frozen
class LineMovement:
    """How far a line lies from where it was.

    Attributes
    ----------
    line : str
        Its name.
    distance : float, m
        The largest distance, at right angles to the line; nan for a new line.
    place : (float, float, float), m
        Where that is now.
    """

    line: str
    distance: float
    place: tuple[float, float, float]


def movements(before: Drawing, after: Drawing) -> tuple[LineMovement, ...]:
    """Give the lines that moved, the farthest first, then those that are new.

    A line whose points only slid along it has not moved.
    """
    old = {line.name: line for line in before.lines}
    found = []
    for line in after.lines:
        if line.name not in old:
            found.append(LineMovement(line.name, float("nan"), _place(line.points[0])))
        elif not _same(old[line.name], line):
            moved = _moved(old[line.name], line)
            found += [moved] if moved.distance > _LEAST else []
    return tuple(sorted(found, key=lambda each: (np.isnan(each.distance), -each.distance, each.line)))


def _same(old: DrawnLine, new: DrawnLine) -> bool:
    return len(old.polylines) == len(new.polylines) and all(
        np.array_equal(a, b) for a, b in zip(old.polylines, new.polylines, strict=True)
    )


def _moved(old: DrawnLine, new: DrawnLine) -> LineMovement:
    points = new.points
    distance = np.min([_distance(spline, points) for spline in old.splines], axis=0)
    worst = int(np.argmax(distance))
    return LineMovement(new.name, float(distance[worst]), _place(points[worst]))


def _place(point: FloatArray) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z


def _distance(spline: SplineBatch, points: FloatArray) -> FloatArray:
    """Give the distance of points (k, 3) from a curve, (k,), m."""
    from scipy.spatial import cKDTree

    course = sample(spline, _FINE)[1]
    nearest = cKDTree(course).query(points)[1]
    last = len(course) - 1
    before = _to_chord(course[np.maximum(nearest - 1, 0)], course[nearest], points)
    after = _to_chord(course[nearest], course[np.minimum(nearest + 1, last)], points)
    return np.minimum(before, after)


def _to_chord(start: FloatArray, end: FloatArray, points: FloatArray) -> FloatArray:
    along, step = end - start, points - start
    square = (along * along).sum(axis=1)
    part = (step * along).sum(axis=1) / np.where(square > 0.0, square, 1.0)
    off = step - np.clip(part, 0.0, 1.0)[:, None] * along
    found: FloatArray = np.sqrt((off * off).sum(axis=1))
    return found

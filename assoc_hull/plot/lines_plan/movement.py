"""How far lines lie from where they were.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.plot.lines_plan.drawing import drawing
>>> from assoc_hull.plot.lines_plan.movement import movements
>>> movements(drawing(wigley()), drawing(wigley()))
()
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.plot.lines_plan.drawing import Crossings, Drawing, DrawnLine

__all__ = ["LEAST", "LineMovement", "moved_parts", "movements", "same"]

LEAST = 5e-4
"""Movements below this (m) are not shown."""

_FINE = 64
"""Chords per segment of the line as it was, against which distances are taken."""


@attrs.frozen
class LineMovement:
    """How far a line lies from where it was.

    Attributes
    ----------
    line : str
        Its name.
    distance : float, m
        The largest movement along the hull's normal; nan for a new line.
    place : (float, float, float), m
        Where that is now.
    """

    line: str
    distance: float
    place: tuple[float, float, float]


def movements(before: Drawing, after: Drawing) -> tuple[LineMovement, ...]:
    """Give the lines that moved, the farthest first, then those that are new.

    Movement is taken at the crossings, along the hull's normal there; for a line without
    crossings it is the distance between the line and what it was.
    """
    old = {line.name: line for line in before.lines}
    at_crossings = _at_crossings(before.crossings, after.crossings)
    found = []
    for line in after.lines:
        if line.name not in old:
            found.append(LineMovement(line.name, float("nan"), _place(line.points[0])))
        elif not same(old[line.name], line):
            moved = at_crossings.get(line.name) or _moved(old[line.name], line)
            found += [moved] if moved.distance > LEAST else []
    return tuple(
        sorted(found, key=lambda each: (np.isnan(each.distance), -each.distance, each.line))
    )


def same(old: DrawnLine, new: DrawnLine) -> bool:
    """Tell whether a line is the same, to the bit."""
    return len(old.polylines) == len(new.polylines) and all(
        np.array_equal(a, b) for a, b in zip(old.polylines, new.polylines, strict=True)
    )


def moved_parts(old: DrawnLine | None, new: DrawnLine) -> Iterator[FloatArray]:
    """Give the stretches of a line that lie away from what it was, (k, 3), m."""
    for points in new.polylines:
        if old is None or not old.splines:
            yield points
            continue
        away = _from_all(old, points) > LEAST
        begins = np.flatnonzero(away & ~np.concatenate([[False], away[:-1]]))
        ends = np.flatnonzero(away & ~np.concatenate([away[1:], [False]]))
        for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
            yield points[max(begin - 1, 0) : end + 2]


def _at_crossings(old: Crossings, new: Crossings) -> dict[str, LineMovement]:
    """Give for each line the largest movement along the normal of any of its crossings.

    With the mean of the normals before and after, sliding along a curved hull counts in the
    third order only.
    """
    where = {key: i for i, key in enumerate(old.key)}
    pairs = [(where[key], i) for i, key in enumerate(new.key) if key in where]
    then, now = np.array(pairs, np.int64).reshape(-1, 2).T
    sense = np.sign((old.normal[then] * new.normal[now]).sum(axis=1))
    normal = 0.5 * (new.normal[now] + sense[:, None] * old.normal[then])
    distance = np.abs(((new.xyz[now] - old.xyz[then]) * normal).sum(axis=1))
    found: dict[str, LineMovement] = {}
    for i in np.argsort(distance, kind="stable").tolist():
        row = int(now[i])
        for line in new.line[row]:
            found[line] = LineMovement(line, float(distance[i]), _place(new.xyz[row]))
    return found


def _moved(old: DrawnLine, new: DrawnLine) -> LineMovement:
    points = new.points
    distance = _from_all(old, points)
    worst = int(np.argmax(distance))
    return LineMovement(new.name, float(distance[worst]), _place(points[worst]))


def _place(point: FloatArray) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z


def _from_all(line: DrawnLine, points: FloatArray) -> FloatArray:
    """Give the distance of points (k, 3) from a line, (k,), m."""
    found: FloatArray = np.min([_distance(spline, points) for spline in line.splines], axis=0)
    return found


def _distance(spline: SplineBatch, points: FloatArray) -> FloatArray:
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

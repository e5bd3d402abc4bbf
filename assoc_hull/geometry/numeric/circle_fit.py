"""Circles fitted to points of a plane, and lengths along them.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.circle_fit import CircleFit, fit_circle, unroll_on_circle
>>> t = np.linspace(0.0, 1.0, 9)
>>> points = 3.0 * np.column_stack([np.cos(t), np.sin(t)])
>>> circle = fit_circle(points)
>>> round(circle.radius, 9), unroll_on_circle(points, circle)[0][-1].round(9)
(3.0, np.float64(3.0))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "CircleFit",
    "fit_circle",
    "quick_circle_residuals",
    "three_point_residuals",
    "unroll_on_circle",
]


@attrs.frozen(eq=False)
class CircleFit:
    """A circle fitted to points.

    Attributes
    ----------
    centre : (2,), m
        Its centre.
    radius : float, m
        Its radius.
    spread : float
        Standard deviation of the radius over the scatter of the points.
    """

    centre: FloatArray
    radius: float
    spread: float

    def __attrs_post_init__(self) -> None:
        freeze(self.centre)


def fit_circle(points: FloatArray) -> CircleFit:
    """Fit a circle: least squares of the distances.

    Parameters
    ----------
    points : (n, 2), m
        Three or more, not on one line.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.circle_fit import fit_circle
    >>> t = np.linspace(0.0, 1.0, 9)
    >>> circle = fit_circle(3.0 * np.column_stack([np.cos(t), np.sin(t)]))
    >>> bool(abs(circle.centre).max() < 1e-9), round(circle.radius, 9)
    (True, 3.0)
    """
    middle, size, guess = _first_circle(points)
    local = (points - middle) / size
    inverse = np.eye(3)
    for _ in range(6):
        away = local - guess[:2]
        length = np.maximum(np.sqrt((away * away).sum(axis=1)), 1e-12)
        slopes = np.column_stack([away / length[:, None], np.ones(len(local))])
        inverse = np.linalg.pinv(slopes.T @ slopes)
        step = inverse @ (slopes.T @ (length - guess[2]))
        guess = guess + step
        if float(np.abs(step).max()) < 1e-10 * float(guess[2]):
            break
    spread = float(np.sqrt(max(float(inverse[2, 2]), 0.0)))
    return CircleFit(middle + size * guess[:2], size * float(guess[2]), spread)


def _first_circle(points: FloatArray) -> tuple[FloatArray, float, FloatArray]:
    """Fit a circle by squared distances: middle and size of the points, centre and radius there."""
    middle = points.mean(axis=0)
    local = points - middle
    square = (local * local).sum(axis=1)
    size = float(np.sqrt(square.mean())) or 1.0
    local, square = local / size, square / (size * size)
    table = np.column_stack([2.0 * local, np.ones(len(local))])
    normal = table.T @ table + 1e-14 * np.eye(3)
    known = np.linalg.solve(normal, table.T @ square)
    radius = np.sqrt(max(float(known[2] + known[:2] @ known[:2]), 1e-12))
    return middle, size, np.array([known[0], known[1], radius])


def quick_circle_residuals(points: FloatArray, first: int, last: int) -> FloatArray:
    """Give how far all points lie off a circle quickly fitted to those from first to last, m."""
    middle, size, circle = _first_circle(points[first : last + 1])
    away = (points - middle) / size - circle[:2]
    return np.asarray(size * (np.sqrt((away * away).sum(axis=1)) - circle[2]))


def unroll_on_circle(
    points: FloatArray, circle: CircleFit
) -> tuple[FloatArray, FloatArray, float, float]:
    """Give lengths along a circle, distances off it (positive outside), first angle and sense."""
    away = points - circle.centre
    angle = np.unwrap(np.arctan2(away[:, 1], away[:, 0]))
    sense = 1.0 if angle[-1] >= angle[0] else -1.0
    off = np.sqrt((away * away).sum(axis=1)) - circle.radius
    return sense * circle.radius * (angle - angle[0]), off, float(angle[0]), sense


def three_point_residuals(
    points: FloatArray, first: IntArray, last: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Give how far the quarter points of windows lie off the circle through three, and depths."""
    a, b, c = points[first], points[(first + last) // 2], points[last]
    chord, side = c - a, b - a
    double = chord[:, 0] * side[:, 1] - chord[:, 1] * side[:, 0]
    depth = double / np.maximum(np.sqrt((chord * chord).sum(axis=1)), 1e-12)
    bottom = 2.0 * np.where(np.abs(double) > 1e-12, double, 1e-12)
    long, short = (chord * chord).sum(axis=1), (side * side).sum(axis=1)
    x = (side[:, 1] * long - chord[:, 1] * short) / bottom
    y = (chord[:, 0] * short - side[:, 0] * long) / bottom
    centre = a + np.column_stack([x, y])
    radius = np.sqrt(x * x + y * y)
    off = np.zeros(len(first))
    for part in (0.25, 0.75):
        point = points[(first + part * (last - first)).astype(np.int64)]
        away = np.sqrt(((point - centre) ** 2).sum(axis=1))
        off = np.maximum(off, np.abs(away - radius))
    return off, np.asarray(depth)

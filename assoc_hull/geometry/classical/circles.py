"""Circles by three points, by a point with its tangent and another, and by least squares.

``(y - A)^2 + (u - B)^2 = r^2`` is a circle in true lengths only: where u is a fraction of a
length, go to lengths first.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK.

Examples
--------
>>> from assoc_hull.geometry.classical.circles import circle_through
>>> circle = circle_through([0, 0], [4, 3], [10, 4])
>>> circle.centre.round(6).tolist(), round(circle.curvature, 9)
([8.857143, -7.642857], -0.085478752)
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import flag
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import bearable
from assoc_hull.geometry.classical.checks import finite
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.circle_fit import fit_circle

__all__ = [
    "TrueCircle",
    "circle_by_tangent",
    "circle_through",
    "fitted_circle",
    "tangent_curvature",
]

_FLAT = 1e-12
"""Sine of the angle between two chords up to which three points are on one line."""


@attrs.frozen(eq=False)
class TrueCircle:
    """A circle in true lengths.

    Attributes
    ----------
    centre : (2,), m
        Its centre.
    curvature : float, 1/m
        Positive where the points, in their order, turn left.
    residual : float, m
        Root of the mean square of the distances of fitted points; 0 where they are met.
    """

    centre: FloatArray
    curvature: float
    residual: float = 0.0

    def __attrs_post_init__(self) -> None:
        freeze(self.centre)

    @property
    def radius(self) -> float:
        """Radius, m."""
        return 1.0 / abs(self.curvature)


def circle_through(p: ArrayLike, q: ArrayLike, r: ArrayLike) -> TrueCircle:
    """Give the circle through three points (2,), m.

    Raises
    ------
    GeometryError
        ``"circle: points are collinear"``.
    """
    first, second, third = (_point(each) for each in (p, q, r))
    a, b, c = second - first, third - first, third - second
    cross = float(a[0] * b[1] - a[1] * b[0])
    square_a, square_b, square_c = (float(each @ each) for each in (a, b, c))
    if abs(cross) <= _FLAT * np.sqrt(square_a * square_b) or square_a * square_b * square_c == 0.0:
        raise _collinear()
    away = np.array([b[1] * square_a - a[1] * square_b, a[0] * square_b - b[0] * square_a])
    bend = 2.0 * cross / float(np.sqrt(square_a * square_b * square_c))
    return TrueCircle(first + away / (2.0 * cross), bend)


def _point(place: ArrayLike) -> FloatArray:
    return bearable(finite(place, "circle", (2,)), "circle")


def _collinear() -> GeometryError:
    return GeometryError(
        "circle: points are collinear", "give points off one line, or take a straight line"
    )


def tangent_curvature(start: ArrayLike, direction: ArrayLike, end: ArrayLike) -> float:
    """Give the curvature (1/m) of the arc from a point with its direction to another.

    Parameters
    ----------
    start, end : (2,), m
        Points apart.
    direction : (2,)
        Of the arc at its start, of any length but nil.

    Returns
    -------
    float, 1/m
        Positive to the left; 0 where the end lies straight ahead.

    Raises
    ------
    GeometryError
        Coincident points, or a direction that is nil.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.circles import tangent_curvature
    >>> round(tangent_curvature([0, 0], [1, 0], [4, 1]), 9)
    0.117647059
    """
    first, way, last = (_point(each) for each in (start, direction, end))
    step, size = last - first, float(np.hypot(*way))
    if size == 0.0 or not step.any():
        raise GeometryError("circle: no direction, or one point twice", "give two points apart")
    return float(2.0 * (way[0] * step[1] - way[1] * step[0]) / size / (step @ step))


def circle_by_tangent(start: ArrayLike, direction: ArrayLike, end: ArrayLike) -> TrueCircle:
    """Give the circle through a point with its direction and another point.

    Parameters
    ----------
    start, direction, end
        As for `tangent_curvature`.

    Raises
    ------
    GeometryError
        ``"circle: points are collinear"`` where the end lies along the direction; and as
        `tangent_curvature`.
    """
    bend = tangent_curvature(start, direction, end)
    first, way, last = (_point(each) for each in (start, direction, end))
    if abs(bend) * float(np.hypot(*(last - first))) <= 2.0 * _FLAT:
        raise _collinear()
    left = np.array([-way[1], way[0]]) / float(np.hypot(*way))
    return TrueCircle(first + left / bend, bend)


def fitted_circle(points: ArrayLike, *, polish: bool = False) -> TrueCircle:
    """Fit a circle by least squares.

    Parameters
    ----------
    points : (n, 2), m
        Three or more, in order.
    polish : bool
        Whether to go on from the least squares of ``r^2``, one linear system, to those of the
        distances from the circle: on a short arc that is scattered the first makes it too small.

    Raises
    ------
    GeometryError
        ``"circle: points are collinear"``, or fewer than three.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.circles import fitted_circle
    >>> round(fitted_circle([(0, 0), (1, 0.95), (2, 1.35), (3, 1.05), (4, 0.1)]).radius, 9)
    2.213672362
    """
    found = bearable(finite(points, "circle", (None, 2)), "circle")
    flag(polish, "polish", "in fitted_circle")
    if len(found) < 3:
        raise GeometryError("circle: at least 3 points", "give more", {"points": len(found)})
    middle = found.mean(axis=0)
    local = found - middle
    spread = np.linalg.svd(local, compute_uv=False)
    if spread[1] <= _FLAT * spread[0]:
        raise _collinear()
    if polish:
        best = fit_circle(found)
        centre, radius = best.centre.copy(), best.radius
    else:
        table = np.column_stack([2.0 * local, np.ones(len(local))])
        known = np.linalg.lstsq(table, (local * local).sum(axis=1), rcond=None)[0]
        centre, radius = middle + known[:2], float(np.sqrt(known[2] + known[:2] @ known[:2]))
    off = np.hypot(*(found - centre).T) - radius
    turn = np.unwrap(np.arctan2(*(found - centre).T[::-1]))
    side = 1.0 if turn[-1] >= turn[0] else -1.0
    return TrueCircle(centre, side / radius, float(np.sqrt((off * off).mean())))

"""The circle on which the points of a plane curve lie.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.fitted_circle import fit_circle_in_plane
>>> t = np.linspace(-1.5, 1.5, 9)
>>> points = np.column_stack([np.full(9, 6.0), 0.725 * np.cos(t), 5.0 + 0.725 * np.sin(t)])
>>> found = fit_circle_in_plane(points, np.array([1.0, 0.0, 0.0]), closed=True)
>>> found.centre.tolist(), found.radius
([6.0, 0.0, 5.0], 0.725)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.circle_fit import fit_circle
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.plane import plane_axes
from assoc_hull.tolerance import round_at_size

__all__ = ["EndCircle", "FeatureCircle", "circle_on_ends", "fit_circle_in_plane"]

_DIGITS = 6
"""Centre and radius are told to this digit of a metre: points that make a feature lie on it within
as much, and another machine's last bit must not show."""


@attrs.frozen(eq=False)
class FeatureCircle:
    """A circle through points, as nearly as they allow.

    Attributes
    ----------
    centre : (3,), m
    radius : float, m
        Both rounded to 1e-6 m, of a short hull finer.
    off : float, m
        How far the farthest point lies off the circle, before it is rounded.
    turn : float, rad
        The angle over which the points stretch, seen from the centre.
    """

    centre: FloatArray
    radius: float
    off: float
    turn: float

    def __attrs_post_init__(self) -> None:
        freeze(self.centre)


def fit_circle_in_plane(
    xyz: FloatArray, normal: FloatArray, *, closed: bool = False, factor: float = 1.0
) -> FeatureCircle:
    """Fit a circle to points in a plane.

    Parameters
    ----------
    xyz : (n, 3), m
        The points in order, three or more that are not on one line.
    normal : (3,)
        Unit normal of their plane.
    closed : bool
        Whether the mirror image closes it: then the centre lies in the centre plane.
    factor : float
        Of lengths, of the hull; see `assoc_hull.tolerance.length_factor`.
    """
    axes = plane_axes(normal)
    flat = np.column_stack([dot(xyz, axis) for axis in axes])
    found = fit_circle(flat)
    away = flat - found.centre
    off = np.abs(np.sqrt((away * away).sum(axis=1)) - found.radius)
    turn = np.ptp(np.unwrap(np.arctan2(away[:, 1], away[:, 0])))
    height = float((normal * xyz[0]).sum())
    centre = height * normal + found.centre[0] * axes[0] + found.centre[1] * axes[1]
    centre = factor * np.round(centre / factor, _DIGITS) + 0.0
    if closed:
        centre[1] = 0.0
    radius = round_at_size(found.radius, _DIGITS, factor)
    return FeatureCircle(centre, radius, float(off.max()), float(turn))


@attrs.frozen(eq=False)
class EndCircle:
    """A circle through two given ends.

    Attributes
    ----------
    centre : (3,), m
    radius : float, m
    turned : float, rad
        How far its tangents at the ends are turned from those of before, by as much at both.
    """

    centre: FloatArray
    radius: float
    turned: float

    def __attrs_post_init__(self) -> None:
        freeze(self.centre)


def circle_on_ends(
    centre: FloatArray, normal: FloatArray, ends: FloatArray, before: FloatArray, *, side: int
) -> EndCircle | None:
    """Give the circle that an arc lies on when its ends have moved in its plane.

    Its tangents at both ends are those of before, or where no circle has both, turned from them
    by one angle at both ends, as little as can be.

    Parameters
    ----------
    centre, normal : (3,), m, and (3,)
        Of the circle before.
    ends, before : (2, 3), m
        The ends of the arc now and before, in the plane of the circle.
    side : int
        1 where the centre lies left of the arc, seen against the normal, -1 to the right.

    Returns
    -------
    EndCircle or None
        None where the ends have fallen together, or the arc would turn to the other side.
    """
    chord = ends[1] - ends[0]
    length = float(np.sqrt((chord * chord).sum()))
    if length == 0.0:
        return None
    way = chord / length
    inward = side * np.cross(normal, way)
    angles = list[float]()
    for place, sign in zip(before, (1.0, -1.0), strict=True):
        tangent = side * np.cross(centre - place, normal)
        ahead, across = (tangent * way).sum(), (tangent * inward).sum()
        angles.append(float(np.arctan2(-sign * across, ahead)))
    half = 0.5 * (angles[0] + angles[1])
    if not 0.0 < half < np.pi:
        return None
    radius = 0.5 * length / float(np.sin(half))
    middle = 0.5 * (ends[0] + ends[1]) + radius * float(np.cos(half)) * inward
    return EndCircle(middle, radius, abs(0.5 * (angles[0] - angles[1])))

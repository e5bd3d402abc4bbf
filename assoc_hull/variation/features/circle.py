"""Circles that are made anew after a map: the end of a bossing, any round end.

A map blurs a circle. What it was drawn as is known, so it is drawn again: about the image of
its centre with the radius that is asked for, or else with one of as much area as the image has.
Each point keeps its angle. How far the drawn circle lies off the image is the correction, which
the neighbourhood takes part in (see `features_map`).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import place, positive, text
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray, freeze
from assoc_hull.geometry.splines.evaluation import positions
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import segment_start

__all__ = ["Circle", "Redrawn", "enough", "redraw", "touch"]

_Map = Callable[[FloatArray], FloatArray]

TOUCH = 1e-6
"""A plane as near as this (m) to being tangent to a circle touches it."""

GAP = 5e-6
"""A spline through points of a circle lies as near (m) to it."""

_ROUNDING = 1e-13
"""A correction by less than so many radii is rounding."""

_LARGEST = 0.1
"""A circle may lie off the image by so many of its radii."""

_WITHIN = 1e-6
"""A curve through points of a circle is to be the circle within this (m)."""

_ROUNDS = 12


@attrs.frozen(eq=False)
class Circle:
    """A circle in space.

    Attributes
    ----------
    centre : (3,), m
    radius : float, m
    normal : (3,)
        Unit normal of its plane.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.features.circle import Circle
    >>> boss = Circle.of([6, 0, 5], 0.725, [1, 0, 0])
    >>> boss.foot(np.array([[6.0, 2.0, 5.0]]))[0].tolist()
    [[6.0, 0.725, 5.0]]
    """

    centre: FloatArray
    radius: float
    normal: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.centre, self.normal)

    @classmethod
    def of(cls, centre: ArrayLike, radius: float, normal: ArrayLike) -> Circle:
        """Take a circle as plain numbers.

        Raises
        ------
        BadInputError
            Not finite, or a radius that is not above 0.
        """
        where = "in a circle"
        across, middle = place(normal, "normal", where), place(centre, "centre", where)
        across = across / np.sqrt((across * across).sum())
        return cls(middle.copy(), positive(radius, "radius", where), across)

    def unit(self, xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the directions (n, 3) in which places lie from the axis, and how far, (n,), m.

        The direction stands for the angle. Places on the axis have none: they are given nil.
        """
        away = xyz - self.centre
        flat = away - (away * self.normal).sum(axis=1)[:, None] * self.normal
        size = np.sqrt((flat * flat).sum(axis=1))
        return flat / np.where(size > 0.0, size, 1.0)[:, None], size

    def at(self, unit: FloatArray) -> FloatArray:
        """Give the places (n, 3), m, in directions (n, 3)."""
        return self.centre + self.radius * unit

    def foot(self, xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the places (n, 3) of the circle next to places, and how far they are, (n,), m."""
        foot = self.at(self.unit(xyz)[0])
        step = xyz - foot
        return foot, np.sqrt((step * step).sum(axis=1))


@attrs.frozen(eq=False)
class Redrawn:
    """A circle before a map, and what is drawn for it afterwards.

    Attributes
    ----------
    name : str
    before, after : Circle
        Of the same plane direction.
    image : callable
        The map.
    slope : callable
        Its Jacobian.
    gap : float, m
        Places as near as this to the circle lie on it.
    """

    name: str
    before: Circle
    after: Circle
    image: _Map
    slope: _Map
    gap: float = GAP

    @cached_property
    def carried(self) -> bool:
        """Whether the map itself makes the circle, so that nothing is to be corrected."""
        return self.most() <= _ROUNDING * self.after.radius

    @property
    def idle(self) -> bool:
        """Whether the map leaves the circle where it is, and nothing else is asked for."""
        places = self.before.at(self._around())
        same = (self.before.centre == self.after.centre).all()
        same &= self.before.radius == self.after.radius
        return bool(same) and bool((self.image(places) == places).all())

    def _around(self, count: int = 72) -> FloatArray:
        one, two = _across(self.before.normal)
        angle = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)[:, None]
        return np.asarray(np.cos(angle) * one + np.sin(angle) * two)

    def correction(self, unit: FloatArray) -> FloatArray:
        """Give what is to be added to the image (n, 3), m, in directions (n, 3)."""
        return self.after.at(unit) - self.image(self.before.at(unit))

    def most(self) -> float:
        """Give how far the new circle lies off the image at most, m."""
        step = self.correction(self._around())
        return float(np.sqrt((step * step).sum(axis=1)).max())

    def turning(self, unit: FloatArray) -> FloatArray:
        """Give the derivatives of the correction by the direction, (n, 3, 3)."""
        slope = self.slope(self.before.at(unit))
        return self.after.radius * np.eye(3) - self.before.radius * slope


def redraw(
    name: str,
    before: Circle,
    image: _Map,
    slope: _Map,
    *,
    radius: float | None = None,
    centre: ArrayLike | None = None,
    gap: float = GAP,
) -> Redrawn:
    """Draw a circle again after a map.

    Parameters
    ----------
    name : str
        For messages.
    before : Circle
        The circle.
    image, slope : callable
        The map of places (n, 3), m, and its Jacobian, (n, 3, 3).
    radius : float or None, m
        Asked for; else the circle gets the area of its image: r sqrt|det J| in its plane.
    centre : (3,) or None, m
        Asked for; else the image of the centre.
    gap : float, m
        How far places of the circle may lie off it.

    Raises
    ------
    BadInputError
        The map leaves the image too far from any circle: it is to be laid out wider.

    Examples
    --------
    >>> from assoc_hull.edit.space_map import affine
    >>> from assoc_hull.variation.features.circle import Circle, redraw
    >>> boss, up = Circle.of([6, 0, 5], 0.5, [1, 0, 0]), affine([1, 1, 1], [0, 0, 1])
    >>> after = redraw("boss", boss, up, up.jacobian).after
    >>> after.centre.tolist(), after.radius
    ([6.0, 0.0, 6.0], 0.5)
    """
    name = text(name, "name", "in a circle")
    where = f"of the feature '{name}'"
    middle = image(before.centre[None])[0] if centre is None else place(centre, "centre", where)
    size = _same_area(before, slope) if radius is None else positive(radius, "radius", where)
    after = Circle.of(middle, size, before.normal)
    found = Redrawn(name, before, after, image, slope, gap)
    _refuse_far(found)
    return found


def _same_area(circle: Circle, slope: _Map) -> float:
    """Give the radius of a circle of as much area as the image has, to first order."""
    one, two = _across(circle.normal)
    both = np.stack([one, two])
    part = both @ slope(circle.centre[None])[0] @ both.T
    area = abs(float(part[0, 0] * part[1, 1] - part[0, 1] * part[1, 0]))
    return circle.radius * float(np.sqrt(area))


def _across(normal: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give two unit vectors across a normal and across one another."""
    aside = np.eye(3)[int(np.argmin(np.abs(normal)))]
    one = np.cross(normal, aside)
    one = one / np.sqrt((one * one).sum())
    return one, np.cross(normal, one)


def _refuse_far(found: Redrawn) -> None:
    most = found.most()
    if most > _LARGEST * found.after.radius:
        raise BadInputError(
            f"feature '{found.name}' differs {most:.2f} m from the varied curve", "in vary",
            "enlarge its region",
        )  # fmt: skip


def touch(circle: Circle, normal: ArrayLike, offset: float) -> FloatArray | None:
    """Give where a plane touches a circle, (3,), m; None where it passes by or through.

    A tangent plane meets a circle in a double root, which rounding would decide on. So what is
    within 1e-6 m of tangent touches, at the circle's own place.

    Parameters
    ----------
    circle : Circle
    normal : (3,)
        Unit normal of the plane.
    offset : float, m
        Its offset.

    Examples
    --------
    >>> from assoc_hull.variation.features.circle import Circle, touch
    >>> boss = Circle.of([6, 0, 6], 1.0, [1, 0, 0])
    >>> touch(boss, [0, 1, 0], 1.0).tolist(), touch(boss, [0, 1, 0], 0.5)
    ([6.0, 1.0, 6.0], None)
    """
    across = place(normal, "normal", "in vary")
    flat = across - float((across * circle.normal).sum()) * circle.normal
    size = float(np.sqrt((flat * flat).sum()))
    if size == 0.0:
        return None
    away = (offset - float((circle.centre * across).sum())) / size
    if abs(abs(away) - circle.radius) > TOUCH:
        return None
    found: FloatArray = circle.at(np.copysign(1.0, away) * (flat / size)[None])[0]
    exact = np.abs(across) == 1.0
    found[exact] = offset * across[exact]
    return found


def enough(circle: Circle, units: FloatArray) -> FloatArray:
    """Give the directions to add so that the curve through the points is the circle.

    The curve ends with the circle's tangents; it may leave the circle by 1e-6 m.

    Parameters
    ----------
    circle : Circle
    units : (n, 3)
        Directions of the points that are there, in order along the arc, less than half a turn
        from one to the next.

    Returns
    -------
    (k, 3)
        Directions of points to add, each half-way between two others.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.features.circle import Circle, enough
    >>> boss, angle = Circle.of([6, 0, 6], 1.0, [1, 0, 0]), np.linspace(-1.57, 1.57, 17)
    >>> units = np.column_stack([0.0 * angle, np.cos(angle), np.sin(angle)])
    >>> len(enough(boss, units))
    16
    """
    new = np.zeros(len(units), bool)
    for _ in range(_ROUNDS):
        wide = np.flatnonzero(off(circle, units) > _WITHIN)
        if not len(wide):
            break
        middle = units[wide] + units[wide + 1]
        middle = middle / np.sqrt((middle * middle).sum(axis=1))[:, None]
        units = np.insert(units, wide + 1, middle, axis=0)
        new = np.insert(new, wide + 1, True)
    return units[new]


def off(circle: Circle, units: FloatArray) -> FloatArray:
    """Give how far the curve through points of an arc leaves the circle, per interval, (n-1,), m.

    Clamped: it ends with the circle's tangents.
    """
    turn = np.cross(units[:-1], units[1:]).sum(axis=0)
    tangent = np.cross(turn / np.sqrt((turn * turn).sum()), units[[0, -1]])
    batch = loft(
        CurveData.single(
            circle.at(units), end_kind=(EndKind.TANGENT, EndKind.TANGENT), end_vector=tangent
        )
    )
    part = np.arange(1.0, 8.0) / 8.0
    segment = segment_start(batch)
    many = np.repeat(segment, len(part))
    places = positions(batch, many, np.tile(part, len(segment))).T
    away = circle.unit(places)[1] - circle.radius
    return np.asarray(np.abs(away).reshape(len(segment), -1).max(axis=1))

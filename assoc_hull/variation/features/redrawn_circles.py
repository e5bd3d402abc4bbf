"""Circles that are drawn again after a map, and the map that takes their neighbourhood along.

A map blurs a circle, the end of a bossing for instance. It is drawn again about the image of its
centre, with the radius that is asked for or that of as much area; each point keeps its angle. The
correction, from the image to the drawn circle, is spread over the neighbourhood: in full on the
circle, and fading with the distance, so that joins stay smooth. Lengths in m.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property, lru_cache

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import place, positive, text
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.variation.fields.bounded_functions import QUINTIC
from assoc_hull.variation.fields.field import FieldRegion

__all__ = [
    "JOIN",
    "FeatureMap",
    "RedrawnCircle",
    "SpaceCircle",
    "changed_circles",
    "distance_fade",
    "redraw_circle",
    "same_area",
    "tangent_point",
]

_Map = Callable[[FloatArray], FloatArray]

TOUCH = 1e-6
"""A plane as near as this (m) to a tangent plane of a circle touches it."""

GAP = 5e-6
"""Places as near as this (m) lie on a circle: a spline through points of it leaves it by less."""

_ROUNDING = 1e-13
"""A correction by less than this part of the radius is rounding."""

_LARGEST = 0.1
"""A circle may lie off the image by this part of its radius."""

_MANY = 72
"""At so many places around a circle it is compared with the image."""


@attrs.frozen(eq=False)
class SpaceCircle:
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
    >>> from assoc_hull.variation.features.redrawn_circles import SpaceCircle
    >>> boss = SpaceCircle.of([6, 0, 5], 0.725, [1, 0, 0])
    >>> boss.foot(np.array([[6.0, 2.0, 5.0]]))[0].tolist()
    [[6.0, 0.725, 5.0]]
    """

    centre: FloatArray
    radius: float
    normal: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.centre, self.normal)

    @classmethod
    def of(cls, centre: ArrayLike, radius: float, normal: ArrayLike) -> SpaceCircle:
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

        The direction stands for the angle. Places on the axis have none: they are given zero.
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
class RedrawnCircle:
    """A circle before a map, and what is drawn for it afterwards.

    Attributes
    ----------
    name : str
    before, after : SpaceCircle
        Of the same plane direction.
    image : callable
        The map.
    slope : callable
        Its Jacobian.
    gap : float, m
        Places as near as this to the circle lie on it.
    """

    name: str
    before: SpaceCircle
    after: SpaceCircle
    image: _Map
    slope: _Map
    gap: float = GAP

    @cached_property
    def carried(self) -> bool:
        """Whether the map itself makes the circle, so that nothing is to be corrected."""
        return self.most <= _ROUNDING * self.after.radius

    @property
    def idle(self) -> bool:
        """Whether the map leaves the circle where it is, and nothing else is asked for."""
        places = self.before.at(_around(*self.before.normal.tolist()))
        same = (self.before.centre == self.after.centre).all()
        same &= self.before.radius == self.after.radius
        return bool(same) and bool((self.image(places) == places).all())

    def correction(self, unit: FloatArray) -> FloatArray:
        """Give what is to be added to the image (n, 3), m, in directions (n, 3)."""
        return self.after.at(unit) - self.image(self.before.at(unit))

    @cached_property
    def most(self) -> float:
        """How far the new circle lies off the image at most, m."""
        step = self.correction(_around(*self.before.normal.tolist()))
        return float(np.sqrt((step * step).sum(axis=1)).max())

    def turning(self, unit: FloatArray) -> FloatArray:
        """Give the derivatives of the correction by the direction, (n, 3, 3)."""
        slope = self.slope(self.before.at(unit))
        return self.after.radius * np.eye(3) - self.before.radius * slope


def redraw_circle(
    name: str,
    before: SpaceCircle,
    image: _Map,
    slope: _Map,
    *,
    radius: float | None = None,
    centre: ArrayLike | None = None,
    gap: float = GAP,
) -> RedrawnCircle:
    """Draw a circle again after a map.

    Parameters
    ----------
    name : str
        For messages.
    before : SpaceCircle
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
    >>> from assoc_hull.variation.features.redrawn_circles import redraw_circle, SpaceCircle
    >>> boss, up = SpaceCircle.of([6, 0, 5], 0.5, [1, 0, 0]), affine([1, 1, 1], [0, 0, 1])
    >>> after = redraw_circle("boss", boss, up, up.jacobian).after
    >>> after.centre.tolist(), after.radius
    ([6.0, 0.0, 6.0], 0.5)
    """
    name = text(name, "name", "in a circle")
    where = f"of the feature '{name}'"
    middle = image(before.centre[None])[0] if centre is None else place(centre, "centre", where)
    size = same_area(before, slope) if radius is None else positive(radius, "radius", where)
    after = SpaceCircle.of(middle, size, before.normal)
    found = RedrawnCircle(name, before, after, image, slope, gap)
    _refuse_far(found)
    return found


def same_area(circle: SpaceCircle, slope: _Map) -> float:
    """Give the radius (m) of a circle of as much area as the image has, to first order."""
    both = np.stack(_across(*circle.normal.tolist()))
    part = both @ slope(circle.centre[None])[0] @ both.T
    area = abs(float(part[0, 0] * part[1, 1] - part[0, 1] * part[1, 0]))
    return circle.radius * float(np.sqrt(area))


@lru_cache(maxsize=64)
def _across(*normal: float) -> tuple[FloatArray, FloatArray]:
    """Give two unit vectors across a normal and across one another."""
    across = np.array(normal)
    aside = np.eye(3)[int(np.argmin(np.abs(across)))]
    one = np.cross(across, aside)
    one = one / np.sqrt((one * one).sum())
    two = np.cross(across, one)
    freeze(one, two)
    return one, two


@lru_cache(maxsize=64)
def _around(*normal: float) -> FloatArray:
    """Give directions (n, 3) evenly around a circle with a normal."""
    one, two = _across(*normal)
    angle = np.linspace(0.0, 2.0 * np.pi, _MANY, endpoint=False)[:, None]
    found = np.asarray(np.cos(angle) * one + np.sin(angle) * two)
    freeze(found)
    return found


def _refuse_far(found: RedrawnCircle) -> None:
    """Refuse a circle that lies off its image by more than a tenth of its radius."""
    most = found.most
    if most > _LARGEST * found.after.radius:
        raise BadInputError(
            f"feature '{found.name}' differs {most:.2f} m from the varied curve", "in vary",
            "enlarge its region",
        )  # fmt: skip


def tangent_point(circle: SpaceCircle, normal: ArrayLike, offset: float) -> FloatArray | None:
    """Give where a plane touches a circle, (3,), m; None where it passes by or through.

    A tangent plane intersects a circle in a double root, which rounding would decide on. So what
    is within 1e-6 m of tangent touches, at the circle's own place.

    Parameters
    ----------
    circle : SpaceCircle
    normal : (3,)
        Unit normal of the plane.
    offset : float, m
        Its offset.

    Examples
    --------
    >>> from assoc_hull.variation.features.redrawn_circles import SpaceCircle, tangent_point
    >>> boss = SpaceCircle.of([6, 0, 6], 1.0, [1, 0, 0])
    >>> tangent_point(boss, [0, 1, 0], 1.0).tolist(), tangent_point(boss, [0, 1, 0], 0.5)
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
    # a plane x, y or z = const gets its coordinate to the last bit
    found[exact] = offset * across[exact]
    return found


# --------------------------------------------------------------------------------------
# Put into the circle's points alone, the correction would dent what joins the circle. Its weight w
# = 1 - b5(distance / (6 r)) falls so slowly that the fade turns no more than the hull does.
# Between two circles the shares add up to one: what is straight between two that move alike stays
# straight.

JOIN = 6.0
"""A correction fades within so many radii of its circle."""


def distance_fade(away: FloatArray, reach: float) -> FloatArray:
    """Give the part of a correction that is left at a distance: 1 at 0, zero from `reach` on.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.features.redrawn_circles import distance_fade
    >>> distance_fade(np.array([0.0, 3.0, 6.0, 7.0]), 6.0).tolist()
    [1.0, 0.5, 0.0, 0.0]
    """
    return np.asarray(1.0 - QUINTIC.value(np.asarray(away) / reach))


@attrs.frozen(eq=False)
class FeatureMap:
    """A map and the circles that are drawn again after it.

    Attributes
    ----------
    image, slope : callable
        The map of places (n, 3), m, and its Jacobian, (n, 3, 3).
    circles : tuple of RedrawnCircle
        Apart from one another.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.space_map import affine
    >>> from assoc_hull.variation.features.redrawn_circles import redraw_circle, SpaceCircle
    >>> from assoc_hull.variation.features.redrawn_circles import FeatureMap
    >>> wide, boss = affine([1, 1.1, 1], [0, 0, 0]), SpaceCircle.of([6, 0, 5], 0.725, [1, 0, 0])
    >>> drawn = redraw_circle("boss", boss, wide, wide.jacobian, radius=0.75)
    >>> FeatureMap(wide, wide.jacobian, (drawn,))(np.array([[6.0, 0.725, 5.0]])).tolist()
    [[6.0, 0.75, 5.0]]
    """

    image: _Map
    slope: _Map
    circles: tuple[RedrawnCircle, ...]

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places (n, 3), m; those on a circle to the bits of the new one."""
        found = self.image(xyz)
        away = self._away(xyz)
        near = self._near(away)
        shares = self._shares(away, near)
        for i in np.flatnonzero(near.any(axis=1)).tolist():
            some, circle = np.flatnonzero(near[i]), self.circles[i]
            unit, size = circle.before.unit(xyz[some])
            moved = found[some]
            if not circle.carried:
                moved = moved + shares[i, some][:, None] * circle.correction(unit)
            # on the circle its own place, not the image with a correction: bits of the new circle
            moved[away[i, some] == 0.0] = circle.after.at(unit[away[i, some] == 0.0])
            level = np.abs(((xyz[some] - circle.before.centre) * circle.before.normal).sum(axis=1))
            moved[np.maximum(size, level) <= circle.gap] = circle.after.centre
            found[some] = moved
        return found

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = self.slope(xyz)
        away = self._away(xyz)
        near = self._near(away)
        for i in np.flatnonzero(near.any(axis=1)).tolist():
            some, circle = np.flatnonzero(near[i]), self.circles[i]
            if circle.carried:
                continue
            weight, turn = self._weight(i, away[:, some])
            unit, size = circle.before.unit(xyz[some])
            # derivative of the direction by the place: across axis and direction, over the
            # distance
            about = np.eye(3) - circle.before.normal[:, None] * circle.before.normal
            about = about - unit[:, :, None] * unit[:, None, :]
            about = about / np.where(size > 0.0, size, np.inf)[:, None, None]
            spin = (circle.turning(unit)[:, :, :, None] * about[:, None, :, :]).sum(axis=2)
            grow = (turn[:, :, None] * self._ahead(xyz[some], away[:, some])).sum(axis=0)
            found[some] += weight[:, None, None] * spin
            found[some] += circle.correction(unit)[:, :, None] * grow[:, None, :]
        return found

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the boxes of the profile plane in which features change the map."""
        return tuple(_region(each) for each in self.circles if not each.carried)

    def _away(self, xyz: FloatArray) -> FloatArray:
        """Give how far places lie from each circle, (c, n), m."""
        if not self.circles:
            return np.zeros((0, len(xyz)))
        return np.array([_distance(each, xyz) for each in self.circles])

    def _near(self, away: FloatArray) -> np.typing.NDArray[np.bool_]:
        """Tell which circles (c) reach which places (n): the fade is not zero there."""
        return np.asarray(away < self._reach()[:, None])

    def _reach(self) -> FloatArray:
        """Give how far each circle's correction fades, (c,), m."""
        return np.array([JOIN * each.before.radius for each in self.circles])

    def _shares(self, away: FloatArray, near: np.typing.NDArray[np.bool_]) -> FloatArray:
        """Give the weights of all circles at places, (c, n), zero where none is near."""
        found = np.zeros(away.shape)
        some = np.flatnonzero(near.any(axis=0))
        if not len(some) or all(each.carried for each in self.circles):
            return found
        close = away[:, some]
        part = np.array([self._part_alone(k, close)[0] for k in range(len(close))])
        total = _total(part)
        total[total == 0.0] = 1.0
        gone = QUINTIC.value(close / self._reach()[:, None])
        found[:, some] = (1.0 - np.prod(gone, axis=0)) * (part / total)
        return found

    def _weight(self, i: int, away: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the weight of a circle at places, (n,), and its slopes by the distances, (c, n).

        It is the fade of all circles together, divided among them.
        """
        each = [self._part(k, away) for k in range(len(away))]
        part, turn = np.array([p for p, _ in each]), np.array([t for _, t in each])
        left, sink = self._left(away)
        total, slope = _total(part), turn.sum(axis=0)
        total[total == 0.0] = 1.0
        share = part[i] / total
        bend = (turn[i] - share * slope) / total
        return left * share, sink * share + left * bend

    def _left(self, away: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give what the fades of all circles leave of corrections, (n,), and its slopes, (c, n)."""
        reach = self._reach()[:, None]
        gone, rise = QUINTIC.value(away / reach), QUINTIC.slope(away / reach) / reach
        rest = [np.prod(np.delete(gone, j, axis=0), axis=0) for j in range(len(away))]
        return 1.0 - np.prod(gone, axis=0), -rise * np.array(rest)

    def _part_alone(self, i: int, away: FloatArray) -> tuple[FloatArray, ...]:
        """Give how much a circle counts beside the others, (n,), and what that is made of."""
        reach, own = float(self._reach()[i]), away[i]
        both = own + away
        both[both == 0.0] = 1.0
        share = away / both
        part = QUINTIC.value(share)
        part[i] = distance_fade(own, reach)
        return np.prod(part, axis=0), part, share, both

    def _part(self, i: int, away: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give how much a circle counts beside the others, (n,), and its slopes, (c, n)."""
        reach, own = float(self._reach()[i]), away[i]
        whole, part, share, both = self._part_alone(i, away)
        slope = QUINTIC.slope(share) / both
        slope[i] = -QUINTIC.slope(own / reach) / reach
        turn = np.zeros_like(away)
        for j in range(len(away)):
            by = slope[j] * np.prod(np.delete(part, j, axis=0), axis=0)
            turn[j] += by if j == i else by * (1.0 - share[j])
            turn[i] -= 0.0 if j == i else by * share[j]
        return whole, turn

    def _ahead(self, xyz: FloatArray, away: FloatArray) -> FloatArray:
        """Give the unit vectors in which the distances grow, (c, n, 3); zero on a circle."""
        steps = np.array([xyz - each.before.foot(xyz)[0] for each in self.circles])
        return np.asarray(steps / np.where(away > 0.0, away, np.inf)[:, :, None])


def _total(part: FloatArray) -> FloatArray:
    """Sum parts (c, n) in their order: `sum` has another one where there is a single place."""
    return np.asarray(np.add.accumulate(part)[-1])


def _distance(circle: RedrawnCircle, xyz: FloatArray) -> FloatArray:
    """Give how far places lie from a circle; zero for those that count as on it."""
    away = circle.before.foot(xyz)[1]
    return np.asarray(np.where(away <= circle.gap, 0.0, away))


def _region(circle: RedrawnCircle) -> FieldRegion:
    """Give the box around the fade of a circle; a radius more for what it lies around."""
    reach = (JOIN + 1.0) * circle.before.radius
    x, _, z = circle.before.centre.tolist()
    return FieldRegion(circle.name, (x - reach, x + reach), (z - reach, z + reach))


def changed_circles(circles: Sequence[RedrawnCircle]) -> tuple[RedrawnCircle, ...]:
    """Leave out circles that stay as they are: what is on them keeps its bits."""
    return tuple(each for each in circles if not each.idle)

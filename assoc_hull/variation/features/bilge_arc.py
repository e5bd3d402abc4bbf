"""The bilge arcs of sections, drawn anew after a map that bends the corner they lie in.

An arc between a straight bottom and an upright side is a fillet. Turned, the bottom is straight
again, and the side upright, but the arc's image is no arc: it is drawn again between the two,
with the radius that the map gives it. The ends of the new arc lie elsewhere on bottom and side
than the images of the old ones do; that is spread along both, where it moves nothing off them.
Fore and aft of the arcs it fades as well.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.features.bilge import Bilge
from assoc_hull.variation.features.map import JOIN
from assoc_hull.variation.fields.blend import QUINTIC
from assoc_hull.variation.fields.field import Region
from assoc_hull.variation.fields.piecewise_linear import Chain

__all__ = ["Arc", "BilgeMap"]

_Map = Callable[[FloatArray], FloatArray]


_CURVE = 1e-4
"""The curve through the points of an arc lies as near to it, in radii; all that does is put on
the new one."""


@attrs.frozen(eq=False)
class Arc:
    """The bilge of a section before a map, and what is drawn for it afterwards.

    Attributes
    ----------
    key, name : str
        Of the feature.
    x : float, m
        Of the section, before.
    before, after : Bilge
    reach : (float, float), m
        How far along the bottom and up the side the correction fades, before the map.
    image, slope : callable
        The map and its Jacobian.
    """

    key: str
    name: str
    x: float
    before: Bilge
    after: Bilge
    reach: tuple[float, float]
    image: _Map
    slope: _Map

    @property
    def centre(self) -> FloatArray:
        """The centre afterwards, (3,), m."""
        x = self.image(self._places(np.ones(1)))[0, 0]
        return np.array([x, self.after.y, self.after.z])

    def step(self, part: FloatArray) -> FloatArray:
        """Give y and z (n, 2), m, from the image to the new arc, at parts of the arc."""
        return np.asarray(self.after.at(part) - self.image(self._places(part))[:, 1:])

    def turning(self, part: FloatArray) -> FloatArray:
        """Give the derivatives of `step` by the part, (n, 2)."""
        slope = self.slope(self._places(part))[:, 1:, 1:]
        old, new = self.before.ahead(part), self.after.ahead(part)
        return np.asarray(new - (slope * old[:, None, :]).sum(axis=2))

    def _places(self, part: FloatArray) -> FloatArray:
        return np.column_stack([np.full(len(part), self.x), self.before.at(part)])

    def most(self) -> float:
        """Give how far the new arc lies off the image at most, m."""
        step = self.step(np.linspace(0.0, 1.0, 33))
        return float(np.sqrt((step * step).sum(axis=1)).max())

    def correction(self, y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the correction (n, 2), m, at places of the section, and its slopes (n, 2, 2).

        It is whole on the arc, fades along bottom and side, and as it leaves them; the centre
        and what lies farther in it leaves alone.
        """
        old = self.before
        away = np.column_stack([y - old.y, z - old.z])
        size = np.sqrt((away * away).sum(axis=1))
        unit = away / np.where(size > 0.0, size, 1.0)[:, None]
        down = (old.floor - [old.y, old.z]) / old.radius
        keelward = np.array([down[1], -down[0]])
        inward, upward = away @ keelward, away[:, 1]
        floor = inward > 0.0
        side = ~floor & (upward > 0.0)
        past = np.where(floor, inward, np.where(side, upward, 0.0))
        reach = np.where(floor, self.reach[0], self.reach[1])
        angle = np.arctan2(away[:, 1], away[:, 0])
        part = np.clip(1.0 - angle / old.first, 0.0, 1.0)
        part = np.where(floor, 0.0, np.where(side, 1.0, part))
        across = np.where(floor[:, None], down, np.where(side[:, None], [1.0, 0.0], unit))
        off = (away * across).sum(axis=1) - old.radius
        near, sink = _fade(np.abs(off), np.full(len(off), old.radius))
        left, fall = _fade(past, reach)
        step, turn = self.step(part), self.turning(part)
        on = ~floor & ~side & (np.abs(off) <= _CURVE * old.radius)
        if on.any():
            own = np.column_stack([np.full(int(on.sum()), self.x), y[on], z[on]])
            step[on] = self.after.at(part[on]) - self.image(own)[:, 1:]
        spin = np.column_stack([-unit[:, 1], unit[:, 0]])
        spin = spin / np.where(size > 0.0, size, np.inf)[:, None] / -old.first
        spin[floor | side] = 0.0
        along = np.where(floor[:, None], keelward, np.where(side[:, None], [0.0, 1.0], 0.0))
        weight = (near * left)[:, None]
        grow = (near * fall)[:, None] * along + (left * sink * np.sign(off))[:, None] * across
        slope = weight[:, :, None] * turn[:, :, None] * spin[:, None, :]
        return weight * step, slope + step[:, :, None] * grow[:, None, :]


def _fade(away: FloatArray, reach: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give what is left at a distance, and its slope."""
    t = away / reach
    return 1.0 - QUINTIC.value(t), -QUINTIC.slope(t) / reach


@attrs.frozen(eq=False)
class BilgeMap:
    """A map after which the bilge arcs of sections are arcs again.

    Attributes
    ----------
    image, slope : callable
        The map of places (n, 3), m, and its Jacobian, (n, 3, 3).
    arcs : tuple of Arc
        From aft forward; without any it is the map.
    """

    image: _Map
    slope: _Map
    arcs: tuple[Arc, ...] = ()

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places (n, 3), m; those that no arc reaches keep the bits of the map."""
        found = self.image(xyz)
        for arc, course in zip(self.arcs, self._courses(), strict=True):
            some = np.flatnonzero(course.at(xyz[:, 0]) != 0.0)
            if len(some):
                x, y, z = xyz[some].T
                step = course.at(x)[:, None] * arc.correction(np.abs(y), z)[0]
                step[:, 0] = np.where(y < 0.0, -step[:, 0], step[:, 0])
                found[some, 1:] = np.where(step != 0.0, found[some, 1:] + step, found[some, 1:])
        return found

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = self.slope(xyz)
        for arc, course in zip(self.arcs, self._courses(), strict=True):
            some = np.flatnonzero(course.at(xyz[:, 0]) != 0.0)
            if len(some):
                x, y, z = xyz[some].T
                step, slope = arc.correction(np.abs(y), z)
                more = np.zeros((len(some), 3, 3))
                more[:, 1:, 0] = course.slope(x)[:, None] * step
                more[:, 1:, 1:] = course.at(x)[:, None, None] * slope
                mirror = np.where((y < 0.0)[:, None], [1.0, -1.0, 1.0], 1.0)
                found[some] += mirror[:, :, None] * more * mirror[:, None, :]
        return found

    def regions(self) -> tuple[Region, ...]:
        """Give the boxes of the profile plane in which arcs change the map."""
        return tuple(
            Region(arc.name, (float(course.nodes[0]), float(course.nodes[-1])), _heights(arc))
            for arc, course in zip(self.arcs, self._courses(), strict=True)
        )

    def _courses(self) -> list[Chain]:
        """Give how much each arc counts along the ship: between two they add up to one."""
        x = [arc.x for arc in self.arcs]
        low = [arc.x - JOIN * arc.before.radius for arc in self.arcs[:1]] + x[:-1]
        high = x[1:] + [arc.x + JOIN * arc.before.radius for arc in self.arcs[-1:]]
        return [
            Chain.through(nodes, [0.0, 1.0, 0.0], QUINTIC, "bilge")
            for nodes in zip(low, x, high, strict=True)
        ]


def _heights(arc: Arc) -> tuple[float, float]:
    old = arc.before
    low = min(float(old.floor[1]), float(old.floor[1]) - arc.reach[0]) - old.radius
    return low, float(old.side[1]) + arc.reach[1]

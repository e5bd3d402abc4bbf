"""A layer of fields that add: all read the places before the map."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.blend import QUINTIC, Blend
from assoc_hull.variation.fields.field import Axis, Field, Region
from assoc_hull.variation.fields.piecewise_linear import Course

__all__ = ["FieldLayer", "Rake"]


@attrs.frozen(eq=False)
class Rake:
    """An x-field that grows upward as a ramp: ``A(x) q w ramp((z - z0) / w)``.

    Attributes
    ----------
    name : str
    course : Course
        A(x).
    q : float
        Tangent of the angle that is added, aft to fore.
    z0, w : float, m
        Where the ramp begins, and over what height it becomes straight.
    blend : Blend
    """

    name: str
    course: Course
    q: float
    z0: float
    w: float
    blend: Blend = QUINTIC

    @property
    def axis(self) -> Axis:
        """The coordinate that it moves."""
        return "x"

    def scaled(self, factor: float) -> Rake:
        """Give the field times a factor."""
        return attrs.evolve(self, q=self.q * factor)

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give u, (n,), m, at places (n, 3), m."""
        t = (xyz[:, 2] - self.z0) / self.w
        u: FloatArray = self.course.at(xyz[:, 0]) * (self.q * self.w) * self.blend.ramp(t)
        return u

    def gradient(self, xyz: FloatArray) -> FloatArray:
        """Give du/dx, du/dy, du/dz, (n, 3)."""
        t = (xyz[:, 2] - self.z0) / self.w
        found = np.zeros((len(xyz), 3))
        slope = self.course.slope(xyz[:, 0])
        found[:, 0] = slope * (self.q * self.w) * self.blend.ramp(t)
        found[:, 2] = self.course.at(xyz[:, 0]) * self.q * self.blend.value(t)
        return found

    def region(self) -> Region:
        """Give the box of the profile plane outside which u is exactly nil."""
        nodes, value = self.course.nodes, self.course.at(self.course.nodes)
        first = -np.inf if value[0] != 0.0 else float(nodes[0])
        last = np.inf if value[-1] != 0.0 else float(nodes[-1])
        return Region(self.name, (first, last), (self.z0, np.inf))


@attrs.frozen(eq=False)
class FieldLayer:
    """Fields that add, a layer of a map.

    Attributes
    ----------
    name : str
    fields : tuple of Field or Rake

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.fields_layer import FieldLayer
    >>> from assoc_hull.variation.fields.hat import hat
    >>> fade = Chain.through([6, 66], [1, 0])
    >>> shaft = hat("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> FieldLayer("local", (shaft,)).displacement(np.array([[6.0, 0.7, 5.0]])).tolist()
    [[0.0, 0.0, 1.0]]
    """

    name: str
    fields: tuple[Field | Rake, ...]

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give by how much places (n, 3), m, move, (n, 3), m."""
        moved = np.zeros_like(xyz)
        for field in self.fields:
            moved[:, "xyz".index(field.axis)] += field.displacement(xyz)
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = np.tile(np.eye(3), (len(xyz), 1, 1))
        for field in self.fields:
            found[:, "xyz".index(field.axis)] += field.gradient(xyz)
        return found

    def regions(self) -> tuple[Region, ...]:
        """Give the boxes of the profile plane outside which nothing moves."""
        return tuple(field.region() for field in self.fields)

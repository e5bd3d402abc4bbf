"""Additive functions: displacements that are products of functions of one coordinate each.

    x' = x + F1(x)
    y' = y + F2(x) F3(y) F4(z)
    z' = z + F5(x) F6(y) F7(z)

Each F is a chain, a ramp or a polynomial. This is the method of Soeding and Rabien, "Hull surface
design by modifying an existing hull", First International Symposium on Computer-Aided Hull
Surface Definition, Annapolis 1977. It moves a place by what is asked and needs no pivot, but
knows no affine part, unless ``F3(y) = y``: a half-breadth that fades in over the half-breadth
by a blend leaves the scaled hull by a tenth of what the side moves.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.field import Region, span
from assoc_hull.variation.fields.piecewise_linear import Course
from assoc_hull.variation.fields.ramps_and_polynomials import Polynomial

__all__ = ["AdditiveLayer", "Factors"]

Factors = tuple[Course, Course, Course]
"""Functions of x, of the half-breadth, and of z."""


@attrs.frozen(eq=False)
class AdditiveLayer:
    """A layer of additive functions; of y the half-breadth counts, so both sides stay alike.

    Attributes
    ----------
    name : str
    x : Course or None
        F1, m.
    y : (Course, Course, Course) or None
        F2, F3, F4: their product is m. F3 is nil at the centre plane, which stays.
    z : (Course, Course, Course) or None
        F5, F6, F7: their product is m.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.additive import AdditiveLayer
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> fade, hump = Chain.through([6, 66], [1, 0]), Chain.through([0, 5, 18], [0, 1, 0])
    >>> shaft = AdditiveLayer("shaft", z=(fade, Chain.constant(1.0), hump))
    >>> shaft.displacement(np.array([[6.0, 0.7, 5.0], [6.0, 0.7, 18.0]])).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]
    """

    name: str
    x: Course | None = None
    y: Factors | None = None
    z: Factors | None = None

    def __attrs_post_init__(self) -> None:
        if self.y is not None and float(self.y[1].at(np.zeros(1))[0]) != 0.0:
            raise BadInputError(
                f"layer '{self.name}' moves the centre plane", "in vary",
                "give an F3 that is nil at y = 0",
            )  # fmt: skip

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give by how much places (n, 3), m, move, (n, 3), m."""
        moved = np.zeros_like(xyz)
        side, at = _sided(xyz)
        if self.x is not None:
            moved[:, 0] = self.x.at(xyz[:, 0])
        if self.y is not None:
            moved[:, 1] = side * _product(self.y, at)
        if self.z is not None:
            moved[:, 2] = _product(self.z, at)
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = np.tile(np.eye(3), (len(xyz), 1, 1))
        side, at = _sided(xyz)
        one = np.ones_like(side)
        if self.x is not None:
            found[:, 0, 0] += self.x.slope(xyz[:, 0])
        if self.y is not None:
            found[:, 1] += _gradient(self.y, at) * np.stack([side, one, side], axis=1)
        if self.z is not None:
            found[:, 2] += _gradient(self.z, at) * np.stack([one, side, one], axis=1)
        return found

    def regions(self) -> tuple[Region, ...]:
        """Give the boxes of the profile plane outside which nothing moves."""
        found = []
        if self.x is not None:
            found.append(Region(f"{self.name} x", _span(self.x), (-np.inf, np.inf)))
        for axis, factors in (("y", self.y), ("z", self.z)):
            if factors is not None:
                title = f"{self.name} {axis}"
                found.append(Region(title, _span(factors[0]), _span(factors[2])))
        return tuple(found)


def _sided(xyz: FloatArray) -> tuple[FloatArray, tuple[FloatArray, FloatArray, FloatArray]]:
    """Give the side, 1 to port and at the centre, and x, half-breadth and z."""
    side = np.where(xyz[:, 1] < 0.0, -1.0, 1.0)
    return side, (xyz[:, 0], np.abs(xyz[:, 1]), xyz[:, 2])


def _product(factors: Factors, at: tuple[FloatArray, FloatArray, FloatArray]) -> FloatArray:
    first, second, third = (course.at(c) for course, c in zip(factors, at, strict=True))
    return np.asarray(first * second * third)


def _gradient(factors: Factors, at: tuple[FloatArray, FloatArray, FloatArray]) -> FloatArray:
    """Give the derivatives of a product by x, half-breadth and z, (n, 3)."""
    first, second, third = (course.at(c) for course, c in zip(factors, at, strict=True))
    by_x, by_y, by_z = (course.slope(c) for course, c in zip(factors, at, strict=True))
    return np.stack([by_x * second * third, first * by_y * third, first * second * by_z], axis=1)


def _span(course: Course) -> tuple[float, float]:
    """Give between which places a course is other than nil."""
    if isinstance(course, Polynomial):
        return (-np.inf, np.inf) if course.c.any() else (np.inf, -np.inf)
    return span(course)

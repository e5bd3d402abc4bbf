"""Planes in space.

Examples
--------
>>> from assoc_hull.geometry.plane import Plane
>>> Plane.across("z", 5.5).axis
'z'
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, Self

import attrs
import numpy as np

from assoc_hull.arguments import choice, number, shown
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["AXES", "Axis", "Plane", "as_plane", "plane_asked", "plane_axes", "unit_normal"]

Axis = Literal["x", "y", "z"]
AXES: tuple[Axis, Axis, Axis] = ("x", "y", "z")

_UNIT_SLACK = 1e-9
"""A normal may be off unit length by this."""


def unit_normal(normal: FloatArray) -> FloatArray:
    """Check that a normal is a unit vector.

    Parameters
    ----------
    normal : (3,)
        The normal.

    Returns
    -------
    (3,)
        The same numbers, frozen.

    Raises
    ------
    BadInputError
        If it has not three finite components or not length 1 within 1e-9.

    Examples
    --------
    >>> unit_normal(np.array([0.0, 0.6, 0.8]))
    array([0. , 0.6, 0.8])
    """
    try:
        vector = np.array(normal, np.float64)
    except (TypeError, ValueError, OverflowError):
        vector = np.zeros(0)
    square = sum(part * part for part in vector.tolist()) if vector.shape == (3,) else np.nan
    if not abs(square - 1.0) <= 2 * _UNIT_SLACK:
        raise BadInputError(
            f"normal {shown(normal)} is not a unit vector of three numbers",
            "in a plane",
            "divide it by its length",
        )
    freeze(vector)
    return vector


def plane_axes(normal: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give two unit vectors in a plane that are a right-handed set with its normal.

    Parameters
    ----------
    normal : (3,)
        Unit normal.

    Returns
    -------
    (3,), (3,)
        Coordinate axes where the normal is one.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.plane import plane_axes
    >>> [axis.tolist() for axis in plane_axes(np.array([1.0, 0.0, 0.0]))]
    [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    main = int(np.argmax(np.abs(normal)))
    guess = np.eye(3)[(main + 1) % 3]
    first = guess - float(normal[(main + 1) % 3]) * normal
    first = first / np.sqrt((first * first).sum())
    return first + 0.0, np.cross(normal, first) + 0.0


def _offset(value: object) -> float:
    return number(value, "the offset", "in a plane")


@attrs.frozen(eq=False)
class Plane:
    """The points P with ``normal . P = offset``.

    Attributes
    ----------
    normal : (3,)
        Unit normal.
    offset : float, m
        Distance from the origin along the normal.

    Examples
    --------
    >>> Plane(np.array([0.0, 0.6, 0.8]), 2.0).axis is None
    True
    """

    normal: FloatArray = attrs.field(converter=unit_normal)
    offset: float = attrs.field(converter=_offset)

    @classmethod
    def across(cls, axis: Axis, offset: float) -> Self:
        """Give the plane normal to a coordinate axis.

        Parameters
        ----------
        axis : "x", "y" or "z"
            The axis.
        offset : float, m
            The coordinate that all points of the plane share.

        Returns
        -------
        Plane
            The plane.

        Raises
        ------
        BadInputError
            If the axis is none of these.

        Examples
        --------
        >>> Plane.across("x", 3.0).normal
        array([1., 0., 0.])
        """
        choice(axis, "the axis", AXES, "in a plane")
        return cls(np.eye(3)[AXES.index(axis)], offset)

    @property
    def axis(self) -> Axis | None:
        """The coordinate axis that the normal points along, if any."""
        for index, name in enumerate(AXES):
            if self.normal[index] == 1.0 and np.count_nonzero(self.normal) == 1:
                return name
        return None

    def height(self, xyz: FloatArray) -> FloatArray:
        """Give the signed distance of points from the plane.

        Parameters
        ----------
        xyz : (..., 3), m
            The points.

        Returns
        -------
        (...,), m
            Positive on the side the normal points to.

        Examples
        --------
        >>> Plane.across("z", 1.0).height(np.array([[0.0, 0.0, 3.0]]))
        array([2.])
        """
        products = xyz * self.normal
        result: FloatArray = products[..., 0] + products[..., 1] + products[..., 2] - self.offset
        return result


def plane_asked(
    plane: object, x: float | None, y: float | None, z: float | None, where: str
) -> Plane:
    """Give the one plane that is asked for: as such, or by the coordinate that its points share.

    Raises
    ------
    BadInputError
        None, several, or what is no plane.
    """
    given = [(axis, at) for axis, at in zip(AXES, (x, y, z), strict=True) if at is not None]
    if (plane is not None) + len(given) != 1:
        what = "several planes are given" if given else "no plane is given"
        raise BadInputError(what, where, "give a plane, or one of x=, y= and z= in m")
    if plane is not None:
        return as_plane(plane)
    axis, at = given[0]
    return Plane.across(axis, number(at, axis, where))


def as_plane(value: object) -> Plane:
    """Take a plane, or its normal and offset.

    Parameters
    ----------
    value : Plane, or (normal (3,) of unit length, offset m)
        The plane.

    Raises
    ------
    BadInputError
        Neither.

    Examples
    --------
    >>> from assoc_hull.geometry.plane import as_plane
    >>> as_plane(((0, 0, 1), 7.0)).offset
    7.0
    """
    if isinstance(value, Plane):
        return value
    if not isinstance(value, Sequence) or isinstance(value, str | bytes) or len(value) != 2:
        remedy = "give a Plane, or its unit normal and offset in m"
        raise WrongTypeError(f"the plane is {shown(value)}", "in a plane", remedy)
    return Plane(value[0], value[1])

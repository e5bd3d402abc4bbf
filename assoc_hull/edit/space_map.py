"""A map of space as a transformation uses it: called in batches, checked, differentiated.

Whatever a designer's function does wrong becomes one error that says what, where and how
much; nothing of a hull is touched before all its points have been mapped.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import numbers, shown
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["Affine", "Jacobian", "PointMapping", "SpaceMap", "affine", "space_map"]

PointMapping = Callable[[FloatArray], ArrayLike]
"""Takes places (n, 3), m, and gives where they come to, (n, 3), m."""

Jacobian = Callable[[FloatArray], ArrayLike]
"""Takes places (n, 3), m, and gives d M_i / d x_j as (n, 3, 3)."""

_STEP = 1e-3
"""Half the span (m) of a central difference: a map bends over metres, and rounds at 1e-14."""

_LARGEST = 1e6


@attrs.frozen(eq=False)
class Affine:
    """Scaling along the axes about the origin (AP, centre plane, base line), then a shift.

    Attributes
    ----------
    scale : (3,)
        Factors along x, y and z, above 0.
    shift : (3,), m
        Added afterwards; along y zero, as the centre plane stays.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.space_map import affine
    >>> affine([1, 1.1, 1], [0, 0, 0.5])(np.array([[7.0, 2.0, 3.0]])).tolist()
    [[7.0, 2.2, 3.5]]
    """

    scale: FloatArray
    shift: FloatArray

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places, (n, 3), m."""
        moved: FloatArray = xyz * self.scale + self.shift
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives, (n, 3, 3): the factors."""
        return np.tile(np.eye(3) * self.scale, (len(xyz), 1, 1))


def affine(scale: ArrayLike | None, shift: ArrayLike | None) -> Affine:
    """Take factors and a shift as data.

    Raises
    ------
    BadInputError
        Not one or three factors above 0, or not three lengths.
    """
    where = "in transform"
    factor = numbers(1.0 if scale is None else scale, "scale", where)
    if factor.shape not in ((), (1,), (3,)) or not (factor > 0.0).all():
        remedy = "give one factor above 0, or three along x, y and z"
        raise BadInputError(f"scale is {shown(scale)}", where, remedy)
    offset = numbers(np.zeros(3) if shift is None else shift, "shift", where)
    if offset.shape != (3,):
        raise BadInputError(f"shift is {shown(shift)}", where, "give three lengths, m: x, y and z")
    return Affine(np.broadcast_to(factor, (3,)) + 0.0, offset + 0.0)


@attrs.frozen(eq=False)
class SpaceMap:
    """A mapping with its derivatives.

    Attributes
    ----------
    call : callable
        The mapping.
    slope : callable or None
        Its Jacobian; central differences over +- 1 mm if None.
    moves : (bool, bool, bool)
        Whether it may change x, y and z of any place by a bit.
    """

    call: PointMapping
    slope: Jacobian | None = None
    moves: tuple[bool, bool, bool] = (True, True, True)

    def places(self, xyz: FloatArray) -> FloatArray:
        """Map places, (n, 3), m.

        Raises
        ------
        BadInputError
            The mapping fails, gives another shape, or numbers that are no lengths.
        """
        moved = _checked(self.call, xyz, (len(xyz), 3), "the mapping")
        bad = ~(np.abs(moved) <= _LARGEST).all(axis=1)
        if bad.any():
            raise _unusable("the mapping", xyz[bad][0], moved[bad][0].tolist())
        return moved

    def jacobians(self, xyz: FloatArray) -> FloatArray:
        """Give d M_i / d x_j at places, (n, 3, 3).

        Exactly the unit matrix where no place of the difference moves by a bit.

        Raises
        ------
        BadInputError
            As `places`.
        """
        if not len(xyz):
            return np.zeros((0, 3, 3))
        if self.slope is not None:
            slope = _checked(self.slope, xyz, (len(xyz), 3, 3), "the Jacobian")
            bad = ~np.isfinite(slope).all(axis=(1, 2))
            if bad.any():
                raise _unusable("the Jacobian", xyz[bad][0], slope[bad][0].tolist())
            return slope
        step = np.concatenate([_STEP * np.eye(3), -_STEP * np.eye(3)])
        stencil = (xyz[:, None, :] + step).reshape(-1, 3)
        image = self.places(stencil)
        still = (image == stencil).reshape(len(xyz), -1).all(axis=1)
        image = image.reshape(len(xyz), 2, 3, 3)
        found = np.swapaxes((image[:, 0] - image[:, 1]) / (2.0 * _STEP), 1, 2)
        return np.where(still[:, None, None], np.eye(3), found)

    def bends(self, xyz: FloatArray, along: FloatArray) -> FloatArray:
        """Give the second derivative at places along unit vectors, (n, 3), 1/m.

        Nil where it is lost in the rounding of the difference.
        """
        reach = 100.0 * _STEP
        middle = self.places(xyz)
        sides = self.places(np.concatenate([xyz + reach * along, xyz - reach * along]))
        bend = (sides[: len(xyz)] + sides[len(xyz) :] - 2.0 * middle) / (reach * reach)
        noise = 16.0 * np.finfo(np.float64).eps * (np.abs(xyz).max() + 1.0) / (reach * reach)
        return np.where(np.abs(bend) > noise, bend, 0.0)


def space_map(
    mapping: PointMapping | None,
    jacobian: Jacobian | None,
    scale: ArrayLike | None,
    shift: ArrayLike | None,
) -> SpaceMap:
    """Take a designer's mapping, or factors and a shift instead of one.

    Raises
    ------
    BadInputError
        Neither or both are given.
    """
    if (mapping is None) == (scale is None and shift is None):
        raise BadInputError(
            "neither or both of a mapping and factors", "in transform",
            "give mapping, or scale and shift",
        )  # fmt: skip
    if mapping is not None:
        return SpaceMap(mapping, jacobian)
    linear = affine(scale, shift)
    return SpaceMap(linear, linear.jacobian)


def _checked(
    call: PointMapping | Jacobian, xyz: FloatArray, shape: tuple[int, ...], what: str
) -> FloatArray:
    """Call a designer's function with a copy, and see to the shape of what it gives."""
    try:
        given = np.asarray(call(np.array(xyz)))
        if given.dtype.kind == "c":
            raise BadInputError(
                f"{what} gives numbers of type {given.dtype}", "in transform",
                "give real numbers, m",
            )  # fmt: skip
        found = given.astype(np.float64)
    except AssocHullError:
        raise
    except Exception as error:
        raise BadInputError(
            f"{what} fails: {type(error).__name__}: {error}", "in transform",
            "give a function of an array (n, 3) in m",
        ) from error  # fmt: skip
    if found.shape != shape:
        raise BadInputError(
            f"{what} gives an array {found.shape} for places {xyz.shape}", "in transform",
            f"give {shape}",
        )  # fmt: skip
    return found


def _unusable(what: str, place: FloatArray, found: object) -> BadInputError:
    x, y, z = place.tolist()
    return BadInputError(
        f"{what} gives {found}", f"at ({x:.3f}, {y:.3f}, {z:.3f}) m in transform",
        "give finite numbers of at most 1e6 m",
    )  # fmt: skip

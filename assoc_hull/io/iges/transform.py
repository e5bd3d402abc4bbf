"""How entities of an IGES file are moved: chains of transformations, entity 124.

A point x becomes R x + T, and then what the transformation of the transformation makes of it.

Source: IGES 5.3 (US PRO, 1996), section 4.21.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.iges.transform import Motion
>>> turn = Motion(np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]), np.zeros(3))
>>> shift = Motion(np.eye(3), np.array([0.0, 0, 5]))
>>> turn.then(shift).of(np.array([[1.0, 0, 0]])).tolist()
[[0.0, 1.0, 5.0]]
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.io.iges.file import IgesFile

__all__ = ["NOTHING", "Motion", "motion_of"]

_RIGID = 1e-6
"""So far a matrix may be from a rotation: files with nine digits have less."""


@attrs.frozen(eq=False)
class Motion:
    """A matrix (3, 3) and a shift (3,), in units of the file."""

    matrix: FloatArray
    shift: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.matrix, self.shift)

    def of(self, points: FloatArray) -> FloatArray:
        """Move points (..., 3)."""
        if self is NOTHING:
            return points
        moved: FloatArray = np.einsum("ij,...j->...i", self.matrix, points) + self.shift
        return moved

    def then(self, other: Motion) -> Motion:
        """Give this motion and another after it."""
        if self is NOTHING or other is NOTHING:
            return other if self is NOTHING else self
        return Motion(other.matrix @ self.matrix, other.matrix @ self.shift + other.shift)

    @property
    def stretch(self) -> float:
        """By which part it changes lengths at most; rotations and reflections do not."""
        sizes = np.linalg.svd(self.matrix, compute_uv=False)
        found = float(np.abs(sizes - 1.0).max())
        return found if found > _RIGID else 0.0

    @classmethod
    def still(cls) -> Self:
        """Give the motion that moves nothing."""
        return cls(np.eye(3), np.zeros(3))


NOTHING = Motion.still()


def motion_of(file: IgesFile, number: int) -> Motion:
    """Give the motion of an entity 124, with those that it is moved by itself.

    Parameters
    ----------
    file : IgesFile
        The file.
    number : int
        Of the directory entry of the transformation; 0 moves nothing.

    Raises
    ------
    BadInputError
        The chain runs in a ring, leads to something else, or its matrix flattens space.
    """
    found, met = NOTHING, list[int]()
    while number:
        if number in met:
            ring = " -> ".join(f"D{each}" for each in [*met, number])
            what = f"transformations run in a ring: {ring}"
            raise BadInputError(what, f"in {file.source}", "export the file again")
        met.append(number)
        found = found.then(_one(file, number))
        number = file.entries[number].transformation
    return found


def _one(file: IgesFile, number: int) -> Motion:
    record = file.record(number)
    if file.entries[number].kind != 124:
        what = "this is to be a transformation, and is none"
        raise BadInputError(what, record.where, "export the file again")
    rows = record.reals(1, 12, "the matrix").reshape(3, 4)
    found = Motion(rows[:, :3].copy(), rows[:, 3].copy())
    sizes = np.linalg.svd(found.matrix, compute_uv=False)
    if not 1e-6 < sizes[-1] <= sizes[0] < 1e6:
        what = f"the matrix stretches by {sizes[-1]:.3g} to {sizes[0]:.3g}"
        raise BadInputError(what, record.where, "a matrix that turns is wanted")
    return found

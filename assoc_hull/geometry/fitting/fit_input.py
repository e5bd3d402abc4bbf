"""What a fit is given: points with parameters and weights, and control points it may not change.

`Samples` are points of lines; `HeldControls` fixes single coordinates, as y on the centre plane.
Rows of control points are numbered from a side of the surface inward.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import choice
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "SIDES",
    "HeldControls",
    "Samples",
    "row_of",
]


@attrs.frozen(eq=False)
class Samples:
    """Points on lines, for one surface.

    Attributes
    ----------
    uv : (k, 2), m
        Their parameters; those of a block run over lengths, so that a penalty on derivatives has
        units of its own.
    point : (k, 3), m
        Where they lie.
    weight : (k,), m
        The length of line that each stands for, more on borders.
    line : (k,) int
        The line each was taken from, a number of the caller's.
    held : (k, 2) bool
        Parameters that no correction may change: those of points on a border.
    """

    uv: FloatArray
    point: FloatArray
    weight: FloatArray
    line: IntArray
    held: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.uv, self.point, self.weight, self.line, self.held)

    def __len__(self) -> int:
        """How many points there are."""
        return len(self.point)

    @classmethod
    def of(
        cls,
        uv: FloatArray,
        point: FloatArray,
        weight: FloatArray | float = 1.0,
        line: IntArray | None = None,
        held: NDArray[np.bool_] | None = None,
    ) -> Self:
        """Give samples of copies of these; all of one line, and free, unless given otherwise."""
        count = len(point)
        return cls(
            np.array(uv, np.float64).reshape(count, 2),
            np.array(point, np.float64),
            np.array(np.broadcast_to(weight, count), np.float64),
            np.zeros(count, np.int64) if line is None else np.array(line, np.int64),
            np.zeros((count, 2), np.bool_) if held is None else np.array(held, np.bool_),
        )


SIDES = ("u0", "u1", "v0", "v1")
"""The sides of a surface: where u is least, where it is greatest, and so for v."""


def row_of(side: str, depth: int) -> tuple[int | slice, int | slice]:
    """Give the index of a row of control points: that of a side, or one behind it.

    Examples
    --------
    >>> from assoc_hull.geometry.fitting.fit_input import row_of
    >>> row_of("v1", 1)
    (slice(None, None, None), -2)
    """
    place = depth if side[1] == "0" else -1 - depth
    return (place, slice(None)) if side[0] == "u" else (slice(None), place)


@attrs.frozen(eq=False)
class HeldControls:
    """Given coordinates of control points.

    Attributes
    ----------
    mask : (nu, nv, 3) bool
        Which are given.
    value : (nu, nv, 3), m
        What they are; zero where nothing is given.
    """

    mask: NDArray[np.bool_]
    value: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.mask, self.value)

    @classmethod
    def none(cls, shape: tuple[int, int]) -> Self:
        """Hold nothing of a net of nu by nv control points."""
        return cls(np.zeros((*shape, 3), np.bool_), np.zeros((*shape, 3)))

    def on(
        self, side: str, value: FloatArray | float, *, depth: int = 0,
        axes: tuple[int, ...] = (0, 1, 2),
    ) -> Self:  # fmt: skip
        """Hold a row of control points as well; what is held already stays as it is.

        Parameters
        ----------
        side : {"u0", "u1", "v0", "v1"}
            The side that the row belongs to.
        value : (n, 3) or number, m
            Its points, or what all coordinates are.
        depth : int
            0 for the border itself, 1 for the row behind it.
        axes : tuple of int
            Which of x, y, z are held.

        Raises
        ------
        BadInputError
            No side, or points that are not as many as the row has.

        Examples
        --------
        >>> import numpy as np
        >>> from assoc_hull.geometry.fitting.fit_input import HeldControls
        >>> HeldControls.none((4, 4)).on("u0", np.ones((4, 3))).value[0, 0].tolist()
        [1.0, 1.0, 1.0]
        """
        where = "in what a fit holds"
        index = row_of(choice(side, "side", SIDES, where), depth)
        mask, given = self.mask.copy(), self.value.copy()
        points = np.asarray(value, np.float64)
        if points.ndim and points.shape != given[index].shape:
            raise BadInputError(
                f"points of side {side} are of shape {points.shape}",
                where, f"give one for each control point, {given[index].shape}",
            )  # fmt: skip
        new = ~mask[index]
        new[:, [axis for axis in range(3) if axis not in axes]] = False
        mask[index] |= new
        given[index] = np.where(new, points, given[index])
        return type(self)(mask, given)

    def and_(self, other: Self) -> Self:
        """Hold what another one holds as well; where both do, this one tells the value."""
        mask = self.mask | other.mask
        return type(self)(mask, np.where(self.mask, self.value, other.value))

    def turned(self) -> Self:
        """Give the same with u and v exchanged."""
        return type(self)(
            np.ascontiguousarray(self.mask.swapaxes(0, 1)),
            np.ascontiguousarray(self.value.swapaxes(0, 1)),
        )

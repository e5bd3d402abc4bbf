"""Points that a surface is fitted to, with the parameters they are thought to have.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.fitting.samples import Samples
>>> uv = np.array([[0.0, 0.0], [1.0, 0.5]])
>>> found = Samples.of(uv, np.zeros((2, 3)), weight=0.6)
>>> len(found), found.held.tolist()
(2, [[False, False], [False, False]])
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["Samples"]


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
        """Give samples of copies of these; all of one line and free unless told otherwise.

        Parameters
        ----------
        uv : (k, 2), m
            Parameters.
        point : (k, 3), m
            Points.
        weight : (k,) or number, m
            Lengths they stand for.
        line : (k,) int, optional
            Numbers of their lines.
        held : (k, 2) bool, optional
            Parameters that stay.
        """
        count = len(point)
        return cls(
            np.array(uv, np.float64).reshape(count, 2),
            np.array(point, np.float64),
            np.array(np.broadcast_to(weight, count), np.float64),
            np.zeros(count, np.int64) if line is None else np.array(line, np.int64),
            np.zeros((count, 2), np.bool_) if held is None else np.array(held, np.bool_),
        )

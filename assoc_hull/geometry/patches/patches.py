"""Polynomial Bezier patches of one bidegree, and where each lies on its surface.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0] = net[:, 1, 1] = 1.0
>>> Patches.single(net).degrees
(1, 1)
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["Patches"]


@attrs.frozen(eq=False)
class Patches:
    """Bezier patches of one bidegree (m, n).

    Attributes
    ----------
    net : (k, m + 1, n + 1, 3), m
        Control points; the first axis after the patch is u.
    box : (k, 2, 2)
        The parameters of the surface that the unit square of each patch covers:
        ``[[u0, u1], [v0, v1]]``.
    surface : (k,) int
        Which surface each belongs to.
    """

    net: FloatArray
    box: FloatArray
    surface: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.net, self.box, self.surface)

    @classmethod
    def single(cls, net: FloatArray) -> Self:
        """Give one patch, on the unit square, of a net (m + 1, n + 1, 3)."""
        return cls(
            np.array(net, np.float64)[None], np.array([[[0.0, 1.0]] * 2]), np.zeros(1, np.intp)
        )

    @property
    def degrees(self) -> tuple[int, int]:
        """The degrees in u and v."""
        return self.net.shape[1] - 1, self.net.shape[2] - 1

    def __len__(self) -> int:
        """Count the patches."""
        return len(self.net)

    @property
    def components(self) -> FloatArray:
        """The control points as coefficients of vectors, (k, 3, m + 1, n + 1), m."""
        return np.moveaxis(self.net, -1, 1)

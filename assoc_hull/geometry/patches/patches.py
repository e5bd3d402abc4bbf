"""Bezier patches of one bidegree, and where each lies on its surface.

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

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["Patches"]


@attrs.frozen(eq=False)
class Patches:
    """Bezier patches of one bidegree (m, n), all polynomial or all rational.

    Attributes
    ----------
    net : (k, m + 1, n + 1, 3), m
        Control points; the first axis after the patch is u.
    box : (k, 2, 2)
        The parameters of the surface that the unit square of each patch covers:
        ``[[u0, u1], [v0, v1]]``.
    surface : (k,) int
        Which surface each belongs to.
    weight : (k, m + 1, n + 1) or None
        Weights of the control points, above 0; None for polynomial patches.
    """

    net: FloatArray
    box: FloatArray
    surface: IntArray
    weight: FloatArray | None = None

    def __attrs_post_init__(self) -> None:
        freeze(self.net, self.box, self.surface)
        if self.weight is not None:
            freeze(self.weight)

    @classmethod
    def single(cls, net: FloatArray, weight: FloatArray | None = None) -> Self:
        """Give one patch, on the unit square, of a net (m + 1, n + 1, 3)."""
        return cls(
            np.array(net, np.float64)[None],
            np.array([[[0.0, 1.0]] * 2]),
            np.zeros(1, np.intp),
            None if weight is None else np.array(weight, np.float64)[None],
        )

    @classmethod
    def joined(cls, batches: Sequence[Patches]) -> Self:
        """Put batches of one bidegree behind each other: all polynomial, or all rational."""
        weights = [each.weight for each in batches if each.weight is not None]
        return cls(
            np.concatenate([each.net for each in batches]),
            np.concatenate([each.box for each in batches]),
            np.concatenate([each.surface for each in batches]),
            np.concatenate(weights) if weights else None,
        )

    @property
    def degrees(self) -> tuple[int, int]:
        """The degrees in u and v."""
        return self.net.shape[1] - 1, self.net.shape[2] - 1

    def __len__(self) -> int:
        """Count the patches."""
        return len(self.net)

    def __getitem__(self, rows: IntArray | slice) -> Self:
        """Take some patches, by their numbers, by a mask or a slice."""
        weight = None if self.weight is None else self.weight[rows]
        return type(self)(self.net[rows], self.box[rows], self.surface[rows], weight)

    @property
    def components(self) -> FloatArray:
        """The control points as coefficients of vectors, (k, 3, m + 1, n + 1), m."""
        return np.moveaxis(self.net, -1, 1)

    def parameters(self, row: IntArray, uv: FloatArray) -> FloatArray:
        """Turn parameters of patches, 0 to 1, into those of their surfaces.

        Parameters
        ----------
        row : (p,) int
            The patch of each.
        uv : (p, 2)
            Parameters in it.

        Returns
        -------
        (p, 2)
            Parameters of the surface; 0 and 1 give those of the border, to the last bit.

        Examples
        --------
        >>> import numpy as np
        >>> from assoc_hull.geometry.patches.patches import Patches
        >>> Patches.single(np.zeros((2, 2, 3))).parameters(np.array([0]), np.array([[0.25, 1.0]]))
        array([[0.25, 1.  ]])
        """
        box = self.box[row]
        return np.asarray((1.0 - uv) * box[..., 0] + uv * box[..., 1])

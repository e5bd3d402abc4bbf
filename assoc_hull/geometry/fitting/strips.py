"""What one surface hands to another at a border: its row, and how it goes on across it.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.fitting.strips import strip_of
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> net = np.zeros((4, 4, 3))
>>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4]
>>> knots = [0, 0, 0, 0, 3, 3, 3, 3]
>>> strip = strip_of(SplineSurface("plane", (3, 3), knots, knots, net), "u1")
>>> strip.row[0].tolist(), strip.across[0].tolist()
([3.0, 0.0, 0.0], [1.0, 0.0, 0.0])
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.arguments import choice
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.fitting.basis import DEGREE, basis_rows
from assoc_hull.geometry.fitting.held_controls import SIDES, row_of
from assoc_hull.geometry.patches.knots import cut, inserted
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["Strip", "strip_of"]

_SAME = 1e-9
"""Knots nearer than this part of the border are the same."""


@attrs.frozen(eq=False)
class Strip:
    """A border curve of a bicubic surface and the derivative across it, on the same knots.

    Attributes
    ----------
    knots : (n + 4,), m
        Clamped knots along the border.
    row : (n, 3), m
        Control points of the border.
    across : (n, 3)
        Those of the derivative by the parameter across it.
    """

    knots: FloatArray
    row: FloatArray
    across: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.knots, self.row, self.across)

    @property
    def breaks(self) -> FloatArray:
        """Knots along the border, its ends once, (n - 2,), m."""
        return self.knots[DEGREE:-DEGREE]

    def over(self, low: float, high: float) -> Self:
        """Give the same curves with another parameter along them, an affine function of theirs."""
        old = self.breaks
        share = (self.knots - old[0]) / (old[-1] - old[0])
        knots = low + share * (high - low)
        knots[-DEGREE - 1 :] = high
        return type(self)(knots, self.row, self.across)

    def on(self, breaks: FloatArray) -> Self:
        """Give the same curves on more knots, by knot insertion.

        Parameters
        ----------
        breaks : (b,), m
            Where spans meet, with both ends; knots of the strip are among them.

        Raises
        ------
        BadInputError
            A knot of the strip is missing.
        """
        both, knots = np.concatenate([self.row, self.across], axis=1), self.knots
        room = _SAME * (breaks[-1] - breaks[0])
        near = breaks[np.abs(breaks[:, None] - knots[None, :]).argmin(axis=0)]
        if (np.abs(near - knots) > room).any():
            worst = int(np.abs(near - knots).argmax())
            raise BadInputError(
                f"the border has a knot at {knots[worst]:g} m and the surface beside it has none",
                "where two surfaces are joined", "give both the same knots along the border",
            )  # fmt: skip
        knots = near
        for t in breaks[1:-1]:
            # Those given twice are inserted twice.
            if np.count_nonzero(knots == t) < np.count_nonzero(breaks == t):
                both, knots = inserted(both, knots, DEGREE, float(t))
        return type(self)(knots, both[:, :3].copy(), both[:, 3:].copy())

    def at(self, t: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Give points of the border (k, 3), m, its tangents, and derivatives across it."""
        first, (value, slope) = basis_rows(self.knots, t, 1)
        number = first[:, None] + np.arange(DEGREE + 1)
        point = (value[..., None] * self.row[number]).sum(axis=1)
        tangent = (slope[..., None] * self.row[number]).sum(axis=1)
        return point, tangent, (value[..., None] * self.across[number]).sum(axis=1)


def strip_of(surface: SplineSurface, side: str, part: tuple[float, float] | None = None) -> Strip:
    """Give what a bicubic surface hands to a neighbour at one of its sides.

    Parameters
    ----------
    surface : SplineSurface
        A bicubic B-spline with clamped knots.
    side : {"u0", "u1", "v0", "v1"}
        The side.
    part : (float, float), m, optional
        The part of the side, in parameters along it; the whole side without it. A part is cut out
        by knot insertion: its curves are those of the surface.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.fitting.strips import strip_of
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> net = np.zeros((4, 4, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4]
    >>> knots = [0, 0, 0, 0, 3, 3, 3, 3]
    >>> strip = strip_of(SplineSurface("plane", (3, 3), knots, knots, net), "v0", (1.0, 2.0))
    >>> strip.breaks.tolist(), strip.row[:, 0].round(9).tolist()
    ([1.0, 2.0], [1.0, 1.333333333, 1.666666667, 2.0])
    """
    choice(side, "side", SIDES, surface.where)
    across, along = (
        (surface.knots_u, surface.knots_v) if side[0] == "u" else (surface.knots_v, surface.knots_u)
    )
    row, behind = (surface.net[row_of(side, depth)] for depth in (0, 1))
    if side[1] == "0":
        slope = DEGREE / (across[DEGREE + 1] - across[1]) * (behind - row)
    else:
        slope = DEGREE / (across[-2] - across[-2 - DEGREE]) * (row - behind)
    if part is None:
        return Strip(along.copy(), row.copy(), slope)
    both, knots = cut(np.concatenate([row, slope], axis=1), along, DEGREE, *part)
    return Strip(knots, both[:, :3].copy(), both[:, 3:].copy())

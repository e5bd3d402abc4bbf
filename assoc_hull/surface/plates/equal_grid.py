"""Grids on a surface with nearly equal steps: along its longer way and across.

Parameters are chosen so that the mean lengths of the pieces of the lines between them are the
same. The longer way comes first; the normal r_u x r_v points to who sees the second axis lie to
the left of the first.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.surface.plates.equal_grid import equal_grid
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 6.0
>>> grid = equal_grid(SplineSurface.bezier(net))
>>> grid.shape, grid.place[0, 0].tolist(), grid.place[-1, 0].tolist()
((49, 17), [2.0, 0.0, 0.0], [2.0, 6.0, 0.0])
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["EqualGrid", "equal_grid"]

_ACROSS = 17
"""Nodes across by default."""

_LEAST, _MOST = 17, 145
"""Nodes along by default: as many as make square cells, within these."""

_LOOKS = 129
"""Places each way at which lengths are measured."""


@attrs.frozen(eq=False)
class EqualGrid:
    """A grid of r by c nodes on a surface, and the points half-way between them.

    Attributes
    ----------
    u, v : (2r - 1, 2c - 1)
        Parameters; nodes are every other one.
    fine : (2r - 1, 2c - 1, 3), m
        Points of the surface there.
    sides : (2,), m
        Mean lengths of the surface along and across.
    """

    u: FloatArray
    v: FloatArray
    fine: FloatArray
    sides: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.u, self.v, self.fine, self.sides)

    @property
    def shape(self) -> tuple[int, int]:
        """The numbers r and c of nodes along and across."""
        return self.place.shape[0], self.place.shape[1]

    @property
    def place(self) -> FloatArray:
        """The nodes, (r, c, 3), m."""
        return self.fine[::2, ::2]


def equal_grid(surface: SplineSurface, count: tuple[int, int] | None = None) -> EqualGrid:
    """Lay a grid on a surface.

    Parameters
    ----------
    surface : SplineSurface
        The surface.
    count : (r, c), optional
        Nodes along and across; 17 across and square cells by default.

    Returns
    -------
    EqualGrid
        The grid.

    Raises
    ------
    BadInputError
        A surface without length one way.
    """
    (u0, u1), (v0, v1) = surface.domain
    u, v = np.linspace(u0, u1, _LOOKS), np.linspace(v0, v1, _LOOKS)
    point = surface.at(u[:, None], v)
    along_u = _travelled(point)
    along_v = _travelled(np.swapaxes(point, 0, 1))
    turned = bool(along_v[-1] > along_u[-1])
    sides = np.array([along_u[-1], along_v[-1]])[:: -1 if turned else 1]
    if not sides[1] > 1e-9 * sides[0]:
        raise BadInputError(
            f"it is {sides[0]:.3g} m long and {sides[1]:.3g} m broad", surface.where,
            "give a surface, not a line",
        )  # fmt: skip
    r, c = count if count is not None else _counts(sides)
    counts = (c, r) if turned else (r, c)
    u = np.interp(_even(counts[0], along_u[-1]), along_u, u)
    v = np.interp(_even(counts[1], along_v[-1]), along_v, v)
    uu, vv = np.meshgrid(u, v, indexing="ij")
    if turned:  # (v, -u) is as right-handed as (u, v)
        uu, vv = uu.T[:, ::-1], vv.T[:, ::-1]
    return EqualGrid(uu, vv, surface.at(uu, vv), sides)


def _travelled(point: FloatArray) -> FloatArray:
    """Give the mean way along the first axis from its start, (n,), m."""
    steps = np.linalg.norm(np.diff(point, axis=0), axis=-1).mean(axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _even(count: int, length: float) -> FloatArray:
    """Give even steps of a way, with those half-way."""
    return np.linspace(0.0, length, 2 * count - 1)


def _counts(sides: FloatArray) -> tuple[int, int]:
    """Give the numbers of nodes that make square cells."""
    along = round(float(sides[0] / sides[1]) * (_ACROSS - 1)) + 1
    return min(max(along, _LEAST), _MOST), _ACROSS

"""The surface of a hull in small tiles, for pictures: places, girth, normals, curvature.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.bezier_patches import Patches
>>> from assoc_hull.plot.plates.hull_tiles import hull_tiles
>>> x, z = np.mgrid[0:30:4j, 0:3:4j]
>>> tiles = hull_tiles(Patches.single(np.stack([x, 1.0 + 0.0 * x, z], axis=-1)), aim=4)
>>> tiles.corner.shape, tiles.contour(tiles.grid[..., 0], 7.5)[0].shape
((4, 4, 4), (4, 2, 4))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.tensor_bernstein import bernstein_basis
from assoc_hull.geometry.patches.bezier_patches import Patches, curvatures
from assoc_hull.surface.plating.hull_shell import girth_of

__all__ = ["AIM", "HullTiles", "hull_tiles"]

AIM = 24_000
"""So many tiles are seen as a smooth surface."""

_LEAST, _MOST = 2, 12


@attrs.frozen(eq=False)
class HullTiles:
    """Tiles of half a hull: each of k patches is cut in n by n.

    Attributes
    ----------
    grid : (k, n + 1, n + 1, 4), m
        x, y, z and girth of their corners.
    normal : (k, n + 1, n + 1, 3)
        Unit normals, out of the hull.
    gauss : (k, n + 1, n + 1), 1/m2
        Gaussian curvature; nil where there is no normal.
    """

    grid: FloatArray
    normal: FloatArray
    gauss: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.grid, self.normal, self.gauss)

    @property
    def corner(self) -> FloatArray:
        """The corners of each tile in turn, (t, 4, 4), m."""
        return _corners(self.grid)

    @property
    def patch(self) -> IntArray:
        """The patch of each tile, (t,)."""
        k, n = self.grid.shape[:2]
        return np.repeat(np.arange(k), (n - 1) ** 2)

    @property
    def facing(self) -> FloatArray:
        """The mean normal of each tile, (t, 3)."""
        return np.asarray(_corners(self.normal).mean(axis=1))

    @property
    def middle_gauss(self) -> FloatArray:
        """The mean curvature of the corners of each tile, (t,) 1/m2."""
        return np.asarray(_corners(self.gauss[..., None]).mean(axis=(1, 2)))

    def contour(self, values: FloatArray, level: float) -> tuple[FloatArray, FloatArray]:
        """Give where values at the corners of tiles have a level.

        Parameters
        ----------
        values : (k, n + 1, n + 1)
            The values; linear on both halves of a tile.
        level : float
            The level.

        Returns
        -------
        (s, 2, 4), m, and (s, 3)
            Pieces of line, and the normals of their tiles.
        """
        place, off = self.corner, _corners(values[..., None])[..., 0] - level
        halves = [(0, 1, 2), (0, 2, 3)]
        found = [_crossed(place[:, half], off[:, half]) for half in halves]
        pieces = np.concatenate([piece for piece, _ in found])
        return pieces, np.concatenate([self.facing[rows] for _, rows in found])


def _corners(grid: FloatArray) -> FloatArray:
    """Give the four corners of each tile in turn, (t, 4, ...)."""
    parts = grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:]
    return np.stack(parts, axis=3).reshape(-1, 4, grid.shape[-1])


def _crossed(place: FloatArray, off: FloatArray) -> tuple[FloatArray, IntArray]:
    """Give where triangles (t, 3, d) are crossed by the zero of a linear function, and which."""
    above = off > 0.0
    count = above.sum(axis=1)
    rows = np.flatnonzero((count == 1) | (count == 2))
    alone = np.where(count[rows] == 1, above[rows].argmax(axis=1), above[rows].argmin(axis=1))
    ends = []
    for step in (1, 2):
        other = (alone + step) % 3
        a, b = off[rows, alone], off[rows, other]
        t = (a / (a - b))[:, None]
        ends.append(place[rows, alone] + t * (place[rows, other] - place[rows, alone]))
    return np.stack(ends, axis=1), rows


def hull_tiles(patches: Patches, aim: int = AIM) -> HullTiles:
    """Cut patches into tiles.

    Parameters
    ----------
    patches : Patches
        Those of half a hull, polynomial.
    aim : int
        About how many tiles there are to be.
    """
    steps = int(np.clip(round((aim / len(patches)) ** 0.5), _LEAST, _MOST))
    at = np.arange(steps + 1) / steps
    uv = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2)
    rows = np.repeat(np.arange(len(patches)), len(uv))
    found = curvatures(patches, rows, np.tile(uv, (len(patches), 1)))
    shape = (len(patches), steps + 1, steps + 1)
    along = bernstein_basis(3, at)
    girth = along @ girth_of(patches).b @ along.T
    place = found.position.reshape(*shape, 3)
    return HullTiles(
        np.concatenate([place, girth[..., None]], axis=-1),
        np.nan_to_num(found.normal).reshape(*shape, 3),
        np.nan_to_num(found.gauss).reshape(shape),
    )

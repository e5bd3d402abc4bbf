"""Points cut from triangles of surfaces, put on the surfaces themselves, each in its plane.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.slicing.surface_points import Motion
>>> xyz = np.random.default_rng(1).random((9, 3))
>>> Motion.between(xyz, xyz[:, [1, 0, 2]] * [1, 1, -1] + 2.0).turn.tolist()
[[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.facets import Facets
from assoc_hull.geometry.patches.plane_intersection import meet_plane
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["Motion", "on_surfaces"]

_FAR = 0.02
"""A place of a surface farther (m) from the triangles is not the one meant."""

_LEAST_SINE = 0.03
"""Where a plane cuts at a smaller angle (sine), a point stays on its triangle."""


@attrs.frozen(eq=False)
class Motion:
    """From the file to the ship: ``xyz @ turn + shift``; `turn` exchanges and mirrors axes."""

    turn: FloatArray
    shift: FloatArray

    @classmethod
    def between(cls, before: FloatArray, after: FloatArray) -> Motion:
        """Tell how vertices were moved."""
        middle = before.mean(axis=0)
        turn = np.rint(np.linalg.lstsq(before - middle, after - after.mean(axis=0))[0])
        return cls(turn + 0.0, np.median(after - before @ turn, axis=0))

    def back(self, xyz: FloatArray) -> FloatArray:
        """Give places of the file."""
        return np.asarray((xyz - self.shift) @ self.turn.T)

    def ahead(self, xyz: FloatArray) -> FloatArray:
        """Give places in ship axes."""
        return np.asarray(xyz @ self.turn + self.shift)

    def plane(self, axis: IntArray, offset: FloatArray) -> tuple[IntArray, FloatArray]:
        """Give axis and place in the file of planes across axes of the ship."""
        column = np.abs(self.turn).argmax(axis=0)
        sign = self.turn[column, np.arange(3)]
        return column[axis], (offset - self.shift[axis]) * sign[axis]


def on_surfaces(
    xyz: FloatArray,
    axis: IntArray,
    offset: FloatArray,
    owner: IntArray,
    facets: Facets,
    surfaces: Sequence[SplineSurface | None],
    motion: Motion,
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Put places that were cut from triangles on their surfaces.

    Parameters
    ----------
    xyz : (n, 3), m
        Places in ship axes.
    axis : (n,) int
        The coordinate that is constant on the line of each.
    offset : (n,), m
        What it is there.
    owner : (n,) int
        The triangle of each.
    facets : Facets
        The triangles, in axes of the file.
    surfaces : sequence of SplineSurface or None
        What they stand for.
    motion : Motion
        From the file to the ship.

    Returns
    -------
    (n, 3) m, (n,), (n,) bool
        Places, the sine of the angle between plane and surface, and which lie on a surface now.
    """
    there = motion.back(xyz)
    uv = _parameters(there, facets.mesh.corners[owner], facets.uv[owner])
    column, place = motion.plane(axis, offset)
    centre = xyz[:, 1] == 0.0
    middle, nil = motion.plane(np.array([1]), np.zeros(1))
    out, sine, good = xyz.copy(), np.ones(len(xyz)), np.zeros(len(xyz), np.bool_)
    for number in np.unique(facets.surface[owner]).tolist():
        rows = np.flatnonzero(facets.surface[owner] == number)
        second = centre[rows], int(middle[0]), float(nil[0])
        surface = surfaces[number]
        if surface is None:
            continue
        found = meet_plane(surface, uv[rows], column[rows], place[rows], second)
        away = np.sqrt(((found.xyz - there[rows]) ** 2).sum(axis=1))
        mine = (found.off < 1e-7) & (found.sine > _LEAST_SINE) & (away < _FAR)
        good[rows] = mine
        out[rows[mine]] = motion.ahead(found.xyz[mine])
        sine[rows] = found.sine
    out[np.arange(len(out)), axis] = offset
    out[centre, 1] = 0.0
    return out, sine, good


def _parameters(xyz: FloatArray, corner: FloatArray, uv: FloatArray) -> FloatArray:
    """Give parameters (n, 2) of places on triangles (n, 3, 3), from those of the corners."""
    b, c, p = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0], xyz - corner[:, 0]
    bb, bc, cc = ((one * other).sum(axis=1) for one, other in ((b, b), (b, c), (c, c)))
    pb, pc = (p * b).sum(axis=1), (p * c).sum(axis=1)
    det = np.maximum(bb * cc - bc * bc, 1e-300)
    part = np.clip(np.stack([cc * pb - bc * pc, bb * pc - bc * pb], axis=1) / det[:, None], 0, 1)
    part[np.abs(part) < 1e-9] = 0.0
    part /= np.maximum(part.sum(axis=1), 1.0)[:, None]
    first = 1.0 - part.sum(axis=1)
    return np.asarray(first[:, None] * uv[:, 0] + part[:, :1] * uv[:, 1] + part[:, 1:] * uv[:, 2])

"""Whether a mesh is closed, found edge by edge; and how good its triangles are."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.surfaces.triangles import Triangles

__all__ = ["MeshReport", "examined"]

_NIL = 1e-14
"""Triangles of an area this part of the square of the length of the mesh are nil."""
_ALIKE = 1e-9
"""Volumes by x, by y and by z of a closed mesh agree to this part."""


@attrs.frozen(eq=False)
class MeshReport:
    """What was found of a mesh.

    Attributes
    ----------
    vertices, edges, triangles : int
        Of the mesh.
    open_edges : int
        Edges that are not those of two triangles, once in each sense.
    off_centre : int
        How many of these do not lie in the centre plane.
    first_open : (3,), m
        The middle of the first of them; nan where there is none.
    euler : int
        Vertices - edges + triangles: 2 for one closed surface without a hole through it.
    fluxes : (3,), m3
        The volume by x, by y and by z: alike if, and only if, the mesh is closed.
    area : float, m2
        Of all triangles.
    nil : int
        Triangles without area.
    collapsed : int
        Triangles taken away because two of their corners coincide.
    slenderness : (3,)
        Longest side by the height over it, of half, of 95 % and of 99 % of the triangles no more.
    """

    vertices: int
    edges: int
    triangles: int
    open_edges: int
    off_centre: int
    first_open: FloatArray
    euler: int
    fluxes: FloatArray
    area: float
    nil: int
    collapsed: int
    slenderness: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.first_open, self.fluxes, self.slenderness)

    @property
    def closed(self) -> bool:
        """Whether every edge is that of two triangles, once in each sense."""
        return self.open_edges == 0

    @property
    def sound(self) -> bool:
        """Whether it is closed, one body without a hole through it, and faces outward."""
        least, most = float(self.fluxes.min()), float(self.fluxes.max())
        return self.closed and self.euler == 2 and least > 0.0 and most - least <= _ALIKE * most


def examined(xyz: FloatArray, triangle: IntArray, collapsed: int = 0) -> MeshReport:
    """Examine a mesh.

    Parameters
    ----------
    xyz : (v, 3), m
        Vertices, each of a triangle.
    triangle : (f, 3) int
        Triangles.
    collapsed : int
        How many were taken away before.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.surface.cells.mesh_report import examined
    >>> corner = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> face = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> examined(corner, face).sound, examined(corner, face[:3]).open_edges
    (True, 3)
    """
    mesh = Triangles(xyz, triangle)
    ends, key = mesh.edges(), mesh.edge_keys()
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.append(True, np.diff(key[order]) != 0))
    sense = np.where(ends[:, 0] < ends[:, 1], 1, -1)[order]
    count = np.diff(np.append(first, len(order)))
    lost = ends[order[first[(count != 2) | (np.add.reduceat(sense, first) != 0)]]]
    vector = mesh.area_vectors()
    area = np.sqrt(dot(vector, vector))
    centroid = mesh.corners.mean(axis=1)
    return MeshReport(
        len(xyz), len(first), len(triangle), len(lost),
        int((xyz[lost, 1] != 0.0).any(axis=1).sum()),
        xyz[lost[0]].mean(axis=0) if len(lost) else np.full(3, np.nan),
        len(xyz) - len(first) + len(triangle),
        np.asarray((vector * centroid).sum(axis=0)),
        float(area.sum()),
        int((area <= _NIL * float(np.ptp(xyz[:, 0])) ** 2).sum()),
        collapsed,
        _slenderness(mesh, area),
    )  # fmt: skip


def _slenderness(mesh: Triangles, area: FloatArray) -> FloatArray:
    """Give quantiles of the longest side by the height over it."""
    corner = mesh.corners
    side = corner - np.roll(corner, 1, axis=1)
    longest = dot(side, side).max(axis=1)
    ratio = np.divide(longest, 2.0 * area, out=np.full(len(area), np.inf), where=area > 0.0)
    return np.asarray(np.quantile(ratio, [0.5, 0.95, 0.99], method="higher"))

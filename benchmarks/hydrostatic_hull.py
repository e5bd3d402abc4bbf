"""What the benchmark of hydrostatics measures: a Wigley hull, its panels, and the values asked for.

L 100 m, B 10 m, T 6.25 m, wall-sided above, with a deck at 10.25 m so that others can close it.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.mesh_flotation import mesh_flotation
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.surfaces.triangles import Triangles

__all__ = ["EVEN", "INCLINED", "Measured", "Position", "exact", "measured", "panels", "triangles"]

L, B, T, DECK = 100.0, 10.0, 6.25, 10.25


@attrs.frozen
class Position:
    """A floating position; the plane is ``z = height + tan_trim x - tan_heel y``."""

    name: str
    height: float
    tan_trim: float
    tan_heel: float

    def planes(self, heights: FloatArray | None = None) -> FloatingPlanes:
        """Give the plane, or those through other heights, as our integrals take it."""
        height = np.array([self.height]) if heights is None else heights
        return FloatingPlanes(
            height, np.full(len(height), self.tan_trim), np.full(len(height), self.tan_heel)
        )

    def frame(self) -> FloatArray:
        """Give the unit vectors forward and to port in the plane, and its normal, as rows."""
        forward = np.array([1.0, 0.0, self.tan_trim])
        normal = np.array([-self.tan_trim, self.tan_heel, 1.0])
        forward, normal = forward / np.linalg.norm(forward), normal / np.linalg.norm(normal)
        return np.stack([forward, np.cross(normal, forward), normal])


EVEN = Position("even keel", T, 0.0, 0.0)
_TRIM = float(np.tan(np.deg2rad(1.0)))
INCLINED = Position(
    "trim 1, heel 10 degrees", T - 0.5 * L * _TRIM, _TRIM, float(np.tan(np.deg2rad(10.0)))
)


@attrs.frozen(eq=False)
class Measured:
    """What all give: V, B in ship axes, and area and inertias of the waterplane in its plane."""

    volume: float
    centre: FloatArray
    area: float
    i_t: float
    i_l: float

    def off(self, true: Measured) -> dict[str, float]:
        """Give relative errors; of the centre the largest, as a part of the length."""
        names = ("volume", "area", "i_t", "i_l")
        rows = {name: abs(getattr(self, name) / getattr(true, name) - 1.0) for name in names}
        return rows | {"centre": float(np.abs(self.centre - true.centre).max()) / L}


def measured(found: ImmersedIntegrals, position: Position) -> Measured:
    """Turn our integrals into the values asked for."""
    volume, area = float(found.volume[0]), float(found.area[0])
    sums = (found.moment_x, found.moment_y, found.moment_z)
    x, y = float(found.area_x[0]) / area, float(found.area_y[0]) / area
    xx = float(found.area_xx[0]) - x * x * area
    xy = float(found.area_xy[0]) - x * y * area
    yy = float(found.area_yy[0]) - y * y * area
    forward, port, normal = position.frame().tolist()
    rows = []
    for unit in (forward, port):
        a = unit[0] + unit[2] * position.tan_trim
        b = unit[1] - unit[2] * position.tan_heel
        rows.append((a * a * xx + 2.0 * a * b * xy + b * b * yy) / normal[2])
    centre = np.array([float(each[0]) / volume for each in sums])
    return Measured(volume, centre, area / normal[2], i_t=rows[1], i_l=rows[0])


def panels(n: int) -> tuple[FloatArray, np.typing.NDArray[np.int64]]:
    """Give vertices and outward quadrilaterals, 2 n along by n up on each side, and a deck.

    Of all divisions in so many panels this one gives the least error of the volume.
    """
    rows = np.append(np.linspace(0.0, T, n + 1), DECK)
    x, z = np.meshgrid(np.linspace(0.0, L, 2 * n + 1), rows, indexing="ij")
    t = np.minimum(z / T, 1.0)
    y = 0.5 * B * (1.0 - (x / (0.5 * L) - 1.0) ** 2) * t * (2.0 - t)
    port = np.stack([x, y, z], axis=2).reshape(-1, 3)
    both = np.concatenate([port, port * [1.0, -1.0, 1.0]])
    number = np.arange(len(port)).reshape(x.shape)
    a, b, c, d = (
        each.ravel()
        for each in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:])
    )
    side = np.stack([a, d, c, b], axis=1)
    aft, fore = number[:-1, -1], number[1:, -1]
    deck = np.stack([aft + len(port), fore + len(port), fore, aft], axis=1)
    return both, np.concatenate([side, side[:, ::-1] + len(port), deck])


def triangles(n: int) -> Triangles:
    """Give the same as triangles, without those that have no area; equal places are one."""
    xyz, quads = panels(n)
    first, number = np.unique(xyz + 0.0, axis=0, return_inverse=True)
    quads = number.reshape(-1)[quads]
    face = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    i, j, k = face.T
    return Triangles(first, face[(i != j) & (j != k) & (k != i)])


def exact(position: Position) -> Measured:
    """Give the values of the hull itself: from our meshes, the error of second order taken off."""
    rows = []
    for n in (128, 256):
        mesh = triangles(n)
        found = measured(mesh_flotation(mesh.xyz, mesh.face).measure(position.planes()), position)
        rows.append([found.volume, *found.centre.tolist(), found.area, found.i_t, found.i_l])
    volume, x, y, z, area, i_t, i_l = (
        ((4.0 * fine - coarse) / 3.0) for coarse, fine in zip(*rows, strict=True)
    )
    return Measured(volume, np.array([x, y, z]), area, i_t, i_l)

"""A whole hull that lies heeled or yawed in its file: found by its plane of symmetry, and turned.

A surface that mirrors in a plane has the normal of that plane for a principal axis, whatever its
form; which plane it is the surface itself tells, by how well it mirrors there.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.io.mesh.frame import mirror_error
from assoc_hull.io.reports import Notebook

__all__ = ["Tilt", "find_tilt", "levelled", "refuse_tilt"]

_WHERE = "the mesh"

_LEAST, _MOST = 0.02, 15.0
"""Degrees by which a plane of symmetry may be off that of the file to be looked at."""

_OFF = 5e-5
"""A hull farther from mirroring in axes of its file, in parts of its length, may be tilted."""

_BETTER = 0.2
"""About its own plane a tilted hull mirrors with less than this part of that error."""


@attrs.frozen(eq=False)
class Tilt:
    """How a hull lies in its file: `turn` (3, 3) brings points there to upright about `pivot`, m.

    `words` tell the angles.
    """

    turn: FloatArray
    pivot: FloatArray
    words: str

    def upright(self, xyz: FloatArray) -> FloatArray:
        """Give points (n, 3), m, turned upright."""
        return np.asarray((xyz - self.pivot) @ self.turn.T + self.pivot)


def find_tilt(mesh: Triangles) -> Tilt | None:
    """Find by how much a whole hull (m) is heeled or yawed; None where it is not."""
    corner = mesh.corners
    area = np.linalg.norm(mesh.area_vectors(), axis=1)
    if not area.sum() > 0.0:
        return None
    centroid = np.asarray((corner.mean(axis=1) * area[:, None]).sum(axis=0) / area.sum())
    normals = np.linalg.eigh(_second_moments(corner - centroid, area))[1].T
    long = int(np.ptp(mesh.xyz, axis=0).argmax())
    for axis in range(3):
        if axis == long:
            continue
        normal = normals[int(np.abs(normals[:, axis]).argmax())]
        normal = normal * np.sign(normal[axis])
        angle = float(np.degrees(np.arccos(min(1.0, normal[axis]))))
        if not _LEAST < angle < _MOST:
            continue
        tilt = _tilt(normal, centroid, axis, long)
        off = mirror_error(mesh, axis)
        if off > _OFF and mirror_error(mesh.moved(tilt.upright(mesh.xyz)), axis) < _BETTER * off:
            return tilt
    return None


def _second_moments(corner: FloatArray, area: FloatArray) -> FloatArray:
    """Give the integrals of x_i x_j over triangles (n, 3, 3), exactly."""
    sums = corner.sum(axis=1)
    each = np.einsum("nki,nkj->nij", corner, corner) + sums[:, :, None] * sums[:, None, :]
    return np.asarray((area[:, None, None] * each).sum(axis=0) / 12.0)


def _tilt(normal: FloatArray, centroid: FloatArray, axis: int, long: int) -> Tilt:
    """Turn a plane's normal into an axis of the file, about where the plane cuts that axis."""
    target = np.eye(3)[axis]
    about = np.cross(normal, target)
    sine, cosine = float(np.linalg.norm(about)), float(normal @ target)
    k = about / max(sine, 1e-300)
    cross = np.array([[0.0, -k[2], k[1]], [k[2], 0.0, -k[0]], [-k[1], k[0], 0.0]])
    turn = np.eye(3) + sine * cross + (1.0 - cosine) * (cross @ cross)
    pivot = target * float(normal @ centroid) / cosine
    up = 3 - axis - long
    told = [
        f"{name} by {abs(angle):.3g} degrees"
        for name, angle in (
            ("heeled", float(np.degrees(np.arctan2(normal[up], normal[axis])))),
            ("yawed", float(np.degrees(np.arctan2(normal[long], normal[axis])))),
        )
        if abs(angle) > _LEAST
    ]
    return Tilt(turn, pivot, " and ".join(told))


def levelled(mesh: Triangles, book: Notebook) -> Triangles:
    """Turn a whole hull that lies heeled or yawed in its file upright, and tell it."""
    tilt = find_tilt(mesh)
    if tilt is None:
        return mesh
    x, y, z = (float(v) for v in tilt.pivot)
    what = (
        f"the hull lies {tilt.words} in the file, by its plane of symmetry; turned upright about "
        f"({x:.4g}, {y:.4g}, {z:.4g}) m: places that are given count after that"
    )
    book.repair("tilt", _WHERE, what)
    return mesh.moved(tilt.upright(mesh.xyz))


def refuse_tilt(mesh: Triangles, where: str) -> None:
    """Refuse a hull that lies heeled or yawed in its file, where its surfaces would have to turn.

    Raises
    ------
    BadInputError
        It lies so.
    """
    tilt = find_tilt(mesh)
    if tilt is not None:
        raise BadInputError(
            f"the hull lies {tilt.words} in the file, by its plane of symmetry", f"in {where}",
            "turn it upright where it was made, or export a mesh, which is turned here",
        )  # fmt: skip

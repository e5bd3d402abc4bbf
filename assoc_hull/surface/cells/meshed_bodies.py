"""Bodies beside the net in a closed mesh: each side of one is a closed surface of its own.

They share no vertex with the hull, nor with one another, however near they stand: what touches
would have edges of four triangles. For a half of the mesh they are cut in the centre plane.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.surfaces.triangles import Triangles, merge_vertices
from assoc_hull.model.attached_body import AttachedBody

__all__ = ["BodySurface", "surfaces_of", "welded"]


@attrs.frozen(eq=False)
class BodySurface:
    """One closed surface of a body.

    Attributes
    ----------
    name : str
        Of the body.
    xyz : (v, 3), m
        Vertices, each of a triangle.
    triangle : (f, 3) int
        Facing outward from the body; turned for one that is taken from the hull. None at all
        where all its points coincide.
    sign : int
        -1 where they are turned.
    """

    name: str
    xyz: FloatArray
    triangle: IntArray
    sign: int

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz, self.triangle)


def surfaces_of(bodies: Sequence[AttachedBody], *, half: bool) -> Iterator[BodySurface]:
    """Give the surfaces of bodies, of both sides; or what of them stands to port."""
    for body in bodies:
        xyz, triangle = body.points.reshape(-1, 3), body.triangles
        sides = [Triangles(xyz, triangle)]
        if body.both:
            sides.append(Triangles(xyz * [1.0, -1.0, 1.0], triangle[:, ::-1]))
        for side in sides:
            if half and (side.xyz[:, 1] <= 0.0).all():
                continue
            whole = welded(side.xyz, side.face)
            found = _to_port(whole) if half and len(whole.face) else whole
            yield BodySurface(body.name, found.xyz, found.face[:, :: body.sign], body.sign)


def welded(xyz: FloatArray, triangle: IntArray) -> Triangles:
    """Make vertices one that coincide, and take away triangles and vertices that this leaves over.

    `Triangles.origin` of the answer tells of each triangle which one it was.
    """
    used, number = np.unique(triangle, return_inverse=True)
    merged = merge_vertices(xyz[used], number.reshape(-1, 3))
    first, second, third = merged.face.T
    kept = np.flatnonzero((first != second) & (second != third) & (third != first))
    used, number = np.unique(merged.face[kept], return_inverse=True)
    return Triangles(merged.xyz[used], number.reshape(-1, 3), kept)


def _to_port(mesh: Triangles) -> Triangles:
    """Cut off what of a closed surface lies beyond the centre plane; it is open there."""
    xyz, face = mesh.xyz, mesh.face
    y = xyz[:, 1]
    pieces = [face[(y[face] >= 0.0).all(axis=1) & (y[face] > 0.0).any(axis=1)]]
    mixed = face[(y[face] > 0.0).any(axis=1) & (y[face] < 0.0).any(axis=1)]
    # An edge has one place in the plane, whichever triangle asks: it is cut from its lower number.
    edge = np.sort(np.concatenate([mixed[:, [0, 1]], mixed[:, [1, 2]], mixed[:, [2, 0]]]), axis=1)
    edge = edge[y[edge[:, 0]] * y[edge[:, 1]] < 0.0]
    edge = np.unique(edge, axis=0) if len(edge) else edge
    part = (y[edge[:, 0]] / (y[edge[:, 0]] - y[edge[:, 1]]))[:, None]
    cuts = xyz[edge[:, 0]] + part * (xyz[edge[:, 1]] - xyz[edge[:, 0]])
    cuts[:, 1] = 0.0
    at = {(a, b): len(xyz) + k for k, (a, b) in enumerate(edge.tolist())}
    for corners in mixed.tolist():
        ring = list[int]()
        for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
            ring += [a] if y[a] >= 0.0 else []
            ring += [at[min(a, b), max(a, b)]] if y[a] * y[b] < 0.0 else []
        pieces.append(np.array([[ring[0], *ring[k : k + 2]] for k in range(1, len(ring) - 1)]))
    return welded(np.concatenate([xyz, cuts]), np.concatenate(pieces))

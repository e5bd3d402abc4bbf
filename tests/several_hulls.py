"""Ships of several hulls, made of shipped ones or of formulas, and what only looks like them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.triangles import Triangles, merge_vertices
from assoc_hull.shipped.wigley import wigley_half_breadth
from tests import meshes

OFF = 8.0
"""Centre planes of the demihulls, m off that of the ship."""

ROOF = 5.5
"""Height of the wet deck, m."""


def joined(parts: Sequence[Triangles]) -> Triangles:
    """All triangles of some meshes, each mesh by itself."""
    start = np.cumsum([0, *(len(each.xyz) for each in parts[:-1])])
    face = [each.face + first for each, first in zip(parts, start.tolist(), strict=True)]
    return Triangles(np.concatenate([each.xyz for each in parts]), np.concatenate(face))


def shifted(mesh: Triangles, *shift: float) -> Triangles:
    """A mesh elsewhere, m."""
    return meshes.moved(mesh, lambda xyz: xyz + np.array(shift))


def box(low: Sequence[float], high: Sequence[float]) -> Triangles:
    """A closed box between two corners, outward."""
    grid = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float64)
    xyz = np.array(low) + grid * (np.array(high) - np.array(low))
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    face = [each for a, b, c, d in quads for each in ((a, b, c), (a, c, d))]
    return Triangles(xyz, np.array(face))


def bridge(inner: float, roof: float = ROOF) -> Triangles:
    """A bridge deck from one side's hull to the other's, over most of the length."""
    return box([10.0, -inner, roof], [90.0, inner, meshes.T + 0.5])


def catamaran(*, deck: bool, demihull: Triangles | None = None, off: float = OFF) -> Triangles:
    """Two Wigley hulls (or others), with a bridge deck between them or without."""
    one = meshes.closed_wigley() if demihull is None else demihull
    other = meshes.moved(one, lambda xyz: xyz * [1.0, -1.0, 1.0])
    other = Triangles(other.xyz, other.face[:, ::-1].copy())
    parts = [shifted(one, 0.0, off, 0.0), shifted(other, 0.0, -off, 0.0)]
    return joined([*parts, bridge(off)] if deck else parts)


def trimaran() -> Triangles:
    """A Wigley hull and two of a third of its length, 12 m to either side."""
    small = meshes.moved(meshes.closed_wigley(41, 15), lambda xyz: xyz * [0.35, 0.3, 0.7])
    sides = [shifted(small, 20.0, y, 0.3 * meshes.T) for y in (12.0, -12.0)]
    return joined([meshes.closed_wigley(), *sides])


def one_sided(nx: int = 81, nz: int = 31) -> Triangles:
    """A demihull that is fuller outward: its inner side has 60 % of the other's breadth."""
    mesh = meshes.closed_wigley(nx, nz)
    return meshes.moved(
        mesh, lambda xyz: np.column_stack([xyz[:, 0], np.where(xyz[:, 1] < 0, 0.6, 1) * xyz[:, 1],
                                           xyz[:, 2]])
    )  # fmt: skip


def grooved(fore: float, top: float = 4.0) -> Triangles:
    """A Wigley hull whose bottom parts abaft `fore` (m): a tunnel of 1.6 m breadth to a height."""
    mesh = meshes.mirrored(meshes.wigley_half(161, 61))
    x, y, z = mesh.xyz.T
    ahead = np.clip((fore - x) / 8.0, 0.0, 1.0)
    lift = top * ahead * np.clip((0.8 - np.abs(y)) / 0.2, 0.0, 1.0)
    high = np.maximum(z, lift)
    return Triangles(np.column_stack([x, y, high]), mesh.face.copy())


def with_thruster() -> Triangles:
    """A Wigley hull with a transverse tube of 1 m diameter near the bow."""
    turn = np.linspace(0.0, 2.0 * np.pi, 25)
    ring = np.column_stack([88.0 + 0.5 * np.cos(turn), 0.0 * turn, 2.0 + 0.5 * np.sin(turn)])
    half = wigley_half_breadth(ring[:, 0], ring[:, 2], meshes.L, meshes.B, meshes.T)
    ends = [np.column_stack([ring[:, 0], side * half, ring[:, 2]]) for side in (-1.0, 1.0)]
    face = [t for i in range(24) for t in ((i, i + 1, i + 26), (i, i + 26, i + 25))]
    tube = merge_vertices(np.concatenate(ends), np.array(face))
    return joined([meshes.closed_wigley(), tube])


def digitised(xs: FloatArray, off: float, *, deck: bool, half: bool = False) -> str:
    """Sections and waterlines of two Wigley hulls as digitised lines, with a wet deck or without.

    `half` draws the outer half of the port demihull only.
    """
    rows = ["line,piece,x,y,z"]

    def put(name: str, piece: int, x: FloatArray, y: FloatArray, z: FloatArray) -> None:
        points = np.broadcast_arrays(x, y, z)
        places = zip(*points, strict=True)
        rows.extend(f"{name},{piece},{a:.5f},{b:.5f},{c:.5f}" for a, b, c in places)

    z = np.linspace(0.0, meshes.T, 41)
    for x in xs.tolist():
        y = meshes.wigley_y(np.full(41, x), z)
        if half:
            put(f"ST {x:g}", 0, np.array(x), off + y, z)
            continue
        for piece, side in enumerate((1.0, -1.0)):
            around = np.concatenate([-y[::-1], y[1:]])
            put(f"ST {x:g}", piece, np.array(x), side * off + around, np.append(z[::-1], z[1:]))
        if deck and 10.0 < x < 90.0:
            put(f"ST {x:g}", 2, np.array(x), np.linspace(-off, off, 9), np.array(ROOF))
    along = np.linspace(0.0, meshes.L, 101)
    for height in (1.0, 2.5, 4.0):
        y = meshes.wigley_y(along, np.full(101, height))
        for piece, (mid, side) in enumerate([(off, 1.0), (off, -1.0), (-off, 1.0), (-off, -1.0)]):
            if not half or piece == 0:
                put(f"WL {height:g}", piece, along, mid + side * y, np.array(height))
    return "\n".join(rows) + "\n"

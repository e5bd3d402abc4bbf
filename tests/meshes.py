"""Meshes of hulls with a formula, for tests."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles, merge_vertices
from assoc_hull.shipped.wigley import wigley_half_breadth

L, B, T = 100.0, 10.0, 6.25
"""Main dimensions of the Wigley hull here, m."""


def wigley_y(x: FloatArray, z: FloatArray) -> FloatArray:
    """Half-breadth of the Wigley hull, m."""
    return wigley_half_breadth(x, z, L, B, T)


def wigley_half(nx: int = 81, nz: int = 31) -> Triangles:
    """Half a Wigley hull to z = T, open at the deck."""
    x, z = np.meshgrid(np.linspace(0.0, L, nx), np.linspace(0.0, T, nz), indexing="ij")
    return grid_triangles(np.stack([x, wigley_y(x, z), z], axis=2))


def mirrored(mesh: Triangles) -> Triangles:
    """Both halves of a hull; triangles that lie in the centre plane are in its inside."""
    face = mesh.face[(mesh.corners[:, :, 1] != 0.0).any(axis=1)]
    other = mesh.xyz * np.array([1.0, -1.0, 1.0])
    face = np.concatenate([face, face[:, ::-1] + len(mesh.xyz)])
    return merge_vertices(np.concatenate([mesh.xyz, other]), face)


def closed_wigley(nx: int = 81, nz: int = 31) -> Triangles:
    """A whole Wigley hull with a deck."""
    x, t = np.meshgrid(np.linspace(0.0, L, nx), np.linspace(1.0, -1.0, 9), indexing="ij")
    y = wigley_y(x, np.full_like(x, T)) * t
    deck = grid_triangles(np.stack([x, y, np.full_like(x, T)], axis=2))
    shell = mirrored(wigley_half(nx, nz))
    face = np.concatenate([shell.face, deck.face + len(shell.xyz)])
    return merge_vertices(np.concatenate([shell.xyz, deck.xyz]), face)


def moved(mesh: Triangles, change: Callable[[FloatArray], FloatArray]) -> Triangles:
    """A mesh with its places changed, the triangles as they were."""
    return Triangles(change(mesh.xyz), mesh.face.copy())


def write(mesh: Triangles, path: Path) -> Path:
    """Write a mesh in the form that the name of the file tells."""
    import gzip

    import trimesh

    name = path.name.removesuffix(".gz")
    data = trimesh.Trimesh(mesh.xyz, mesh.face, process=False).export(
        file_type=name.rpartition(".")[2]
    )
    raw = data.encode() if isinstance(data, str) else bytes(data)
    path.write_bytes(gzip.compress(raw) if path.suffix == ".gz" else raw)
    return path


A_X, A_Y, A_Z = 50.0, 8.0, 7.0
"""Half-axes of the ellipsoid, m; its centre at (50, 0, 7)."""


def ellipsoid_half(nx: int = 121, nt: int = 41) -> Triangles:
    """The lower port quarter of an ellipsoid, open at the deck z = 7 m."""
    u, t = np.meshgrid(np.linspace(0.0, np.pi, nx), np.linspace(0.0, np.pi / 2, nt), indexing="ij")
    x = A_X - A_X * np.cos(u)
    y, z = A_Y * np.sin(u) * np.sin(t), A_Z - A_Z * np.sin(u) * np.cos(t)
    y[:, 0] = 0.0
    y[[0, -1]] = 0.0
    return grid_triangles(np.stack([x, y, z], axis=2))


def ellipsoid_off(xyz: FloatArray) -> FloatArray:
    """How far places lie off the ellipsoid, to first order, m."""
    local = (xyz - [A_X, 0.0, A_Z]) / [A_X, A_Y, A_Z]
    value = (local**2).sum(axis=1) - 1.0
    slope = 2.0 * local / [A_X, A_Y, A_Z]
    return np.asarray(np.abs(value) / np.linalg.norm(slope, axis=1))


def wigley_off(xyz: FloatArray) -> FloatArray:
    """How far places lie off the Wigley hull, to first order, m."""
    x, y, z = xyz.T
    h = 1e-5
    along = (wigley_y(x + h, z) - wigley_y(x - h, z)) / (2 * h)
    down = (wigley_y(x, z + h) - wigley_y(x, z - h)) / (2 * h)
    return np.asarray(np.abs(y - wigley_y(x, z)) / np.sqrt(1.0 + along**2 + down**2))


def wigley_sheet(family: str, offset: float) -> FloatArray:
    """400 places of a line of the Wigley hull in its plane, (n, 2), m."""
    t = np.linspace(0.0, 1.0, 400)
    if family == "sections":
        return np.column_stack([wigley_y(np.full(400, offset), T * t), T * t])
    if family == "waterlines":
        return np.column_stack([L * t, wigley_y(L * t, np.full(400, offset))])
    reach = np.sqrt(1.0 - 2.0 * offset / B)
    part = reach * (2.0 * t - 1.0)
    depth = np.sqrt(np.maximum(1.0 - 2.0 * offset / B / (1.0 - part**2), 0.0))
    return np.column_stack([0.5 * L * (1.0 + part), T * (1.0 - depth)])[1:-1]


def ellipsoid_sheet(family: str, offset: float) -> FloatArray:
    """400 places of a line of the ellipsoid in its plane, (n, 2), m: ellipses or halves of them."""
    axes = {"sections": (A_Y, A_Z), "waterlines": (A_X, A_Y), "buttocks": (A_X, A_Z)}[family]
    local = {"sections": (offset - A_X) / A_X, "waterlines": (offset - A_Z) / A_Z,
             "buttocks": offset / A_Y}[family]  # fmt: skip
    angle = np.linspace(0.0, np.pi, 400)
    shrink = np.sqrt(1.0 - local**2)
    return np.asarray(shrink * np.column_stack([axes[0] * np.cos(angle), axes[1] * np.sin(angle)]))


def box(x: FloatArray, y: FloatArray, z: FloatArray) -> Triangles:
    """A closed box with rows of vertices at the places given, ascending."""
    sides: list[FloatArray] = []
    for axis, rows in enumerate((x, y, z)):
        u, v = ((y, z), (z, x), (x, y))[axis]
        for end, turned in ((rows[0], True), (rows[-1], False)):
            first, second = np.meshgrid(u, v, indexing="ij")
            grid = np.empty((*first.shape, 3))
            grid[:, :, axis], grid[:, :, axis - 2], grid[:, :, axis - 1] = end, first, second
            # The triangles of a grid face against the cross product of its directions.
            sides.append(grid if turned else grid.transpose(1, 0, 2))
    parts = [grid_triangles(side) for side in sides]
    start = np.cumsum([0, *(len(part.xyz) for part in parts)])
    face = np.concatenate([p.face + n for p, n in zip(parts, start, strict=False)])
    return merge_vertices(np.concatenate([part.xyz for part in parts]), face)


def wigley_walled(nx: int, nz: int) -> Triangles:
    """Half a Wigley hull, wall-sided above z = T up to 4 m more, open at the top."""
    rows = np.append(np.linspace(0.0, T, nz), np.linspace(T, T + 4.0, 5)[1:])
    x, z = np.meshgrid(np.linspace(0.0, L, nx), rows, indexing="ij")
    return grid_triangles(np.stack([x, wigley_y(x, np.minimum(z, T)), z], axis=2))


def ellipsoid_port(nx: int, nt: int) -> Triangles:
    """The port half of a whole ellipsoid of half-axes 50, 8 and 6 m about (50, 0, 6)."""
    u, t = np.meshgrid(np.linspace(0.0, np.pi, nx), np.linspace(0.0, np.pi, nt), indexing="ij")
    radius = np.sin(u)
    radius[[0, -1]] = 0.0
    y = 8.0 * radius * np.sin(t)
    y[:, [0, -1]] = 0.0
    places = [50.0 - 50.0 * np.cos(u), y, 6.0 - 6.0 * radius * np.cos(t)]
    return grid_triangles(np.stack(places, axis=2))

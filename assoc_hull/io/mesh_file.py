"""Triangles from a file: STL, OBJ or PLY, also packed with gzip, through trimesh."""

from __future__ import annotations

import gzip
import io
import logging
from pathlib import Path

import attrs
import numpy as np

from assoc_hull.errors import BadInputError, MissingExtraError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "MESH_ENDINGS",
    "Triangles",
    "grid_triangles",
    "is_mesh_name",
    "merge_vertices",
    "read_triangles",
]

MESH_ENDINGS = (".stl", ".obj", ".ply")
_MOST_BYTES = 2_000_000_000

# Without a handler, what trimesh logs of a file it cannot read would go to standard error.
logging.getLogger("trimesh").addHandler(logging.NullHandler())


@attrs.frozen(eq=False)
class Triangles:
    """A triangulated surface.

    Attributes
    ----------
    xyz : (v, 3)
        Places of the vertices.
    face : (f, 3) int
        Vertices of each triangle.
    """

    xyz: FloatArray
    face: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz, self.face)

    @property
    def corners(self) -> FloatArray:
        """The corners of each triangle, (f, 3, 3)."""
        return self.corners_of(self.face)

    def corners_of(self, face: IntArray) -> FloatArray:
        """Give the corners of some triangles, (k, 3, 3)."""
        return np.asarray(self.xyz[face])

    def area_vectors(self) -> FloatArray:
        """Give half the cross product of two sides of each triangle, (f, 3)."""
        corner = self.corners
        return np.asarray(0.5 * np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]))

    def edges(self) -> IntArray:
        """Give the directed edges, (3 f, 2): all first ones, all second, all third."""
        return np.concatenate([self.face[:, [0, 1]], self.face[:, [1, 2]], self.face[:, [2, 0]]])

    def edge_keys(self) -> IntArray:
        """Give a number for each of the `edges`, the same for both directions."""
        low, high = np.sort(self.edges(), axis=1).T
        return np.asarray(low * len(self.xyz) + high)

    def volume(self) -> float:
        """Give the signed volume, positive for a closed surface with outward normals."""
        a, b, c = (self.corners[:, i] for i in range(3))
        return float((a * np.cross(b, c)).sum() / 6.0)


def is_mesh_name(path: Path) -> bool:
    """Tell whether the name of a file is one of a mesh.

    Examples
    --------
    >>> from pathlib import Path
    >>> from assoc_hull.io.mesh_file import is_mesh_name
    >>> is_mesh_name(Path("Hull.STL.gz")), is_mesh_name(Path("offsets.csv"))
    (True, False)
    """
    return _ending(path) in MESH_ENDINGS


def _ending(path: Path) -> str:
    name = path.name.lower()
    return Path(name.removesuffix(".gz")).suffix


def read_triangles(path: Path) -> Triangles:
    """Read the triangles of a file as they stand; equal vertices are one.

    Raises
    ------
    BadInputError
        The file cannot be read, is no mesh, holds no triangle or numbers that are not finite.
    MissingExtraError
        trimesh is not installed.
    """
    try:
        import trimesh
    except ImportError as error:
        raise MissingExtraError("trimesh", "mesh") from error
    ending = _ending(path).removeprefix(".")
    data = _recoded(_unpack(path), ending)
    try:
        loaded = trimesh.load(io.BytesIO(data), file_type=ending, process=False, force="mesh")
        xyz = np.array(getattr(loaded, "vertices", np.zeros((0, 3))), np.float64)
        face = np.array(getattr(loaded, "faces", ()), np.int64).reshape(-1, 3)
    except Exception as error:  # trimesh raises whatever its parsers meet
        raise BadInputError(
            f"no triangles could be read ({type(error).__name__})", f"at {path}",
            "check that the file is whole and its ending tells its form",
        ) from error  # fmt: skip
    if not len(face):
        raise _no_triangles(path, data, ending)
    if not np.isfinite(xyz).all() or face.min() < 0 or face.max() >= len(xyz):
        raise BadInputError("a vertex is missing or not finite", f"at {path}", "export it again")
    return merge_vertices(xyz, face)


def _recoded(data: bytes, ending: str) -> bytes:
    """Give text in UTF-8, whatever its comments and names are written in.

    Places and numbers are ASCII in every form, so reading the rest as Latin-1 loses none.
    """
    if ending == "stl" and not _is_text_stl(data):
        return data
    if ending == "ply" and b"format ascii" not in data[:200]:
        return data
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("latin-1").encode("utf-8")
    return data


def _is_text_stl(data: bytes) -> bool:
    """Tell text from the binary form, whose header may begin with the same word."""
    count = int.from_bytes(data[80:84], "little")
    return data[:5] == b"solid" and len(data) != 84 + 50 * count


def _no_triangles(path: Path, data: bytes, ending: str) -> BadInputError:
    where = f"at {path}"
    if ending == "stl" and not (_is_text_stl(data) and b"endsolid" in data[-400:]):
        return BadInputError(
            "the file is cut short, or is no STL", where, "export or copy it again, whole"
        )
    return BadInputError("there are no triangles", where, "export a mesh, not curves")


def _unpack(path: Path) -> bytes:
    if _ending(path) not in MESH_ENDINGS:
        raise BadInputError(
            "the form is unknown", f"at {path}", f"give one of {', '.join(MESH_ENDINGS)} (.gz)"
        )
    try:
        data = path.read_bytes()
        packed = gzip.GzipFile(fileobj=io.BytesIO(data)) if data[:2] == b"\x1f\x8b" else None
        text = packed.read(_MOST_BYTES + 1) if packed else data
    except (OSError, EOFError) as error:
        raise BadInputError(
            f"the file cannot be read ({error})", f"at {path}", "check name and file"
        ) from error
    if len(text) > _MOST_BYTES:
        raise BadInputError("the mesh is larger than 2 GB", f"at {path}", "thin it first")
    return text


def merge_vertices(xyz: FloatArray, face: IntArray) -> Triangles:
    """Make equal places one vertex; the order of the vertices is that of their places."""
    places = xyz + 0.0
    order = np.lexsort(places.T[::-1])
    new = np.append(True, (np.diff(places[order], axis=0) != 0.0).any(axis=1))
    number = np.empty(len(places), np.int64)
    number[order] = np.cumsum(new) - 1
    return Triangles(places[order[new]], number[face])


def grid_triangles(grid: FloatArray) -> Triangles:
    """Make two triangles of each cell of a grid of places, (m, n, 3); nil ones are left out.

    Outward where the first direction of the grid points forward, the second upward and the
    places lie to port.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.io.mesh_file import grid_triangles
    >>> x, z = np.meshgrid([0.0, 1, 2], [0.0, 1], indexing="ij")
    >>> grid_triangles(np.stack([x, 0 * x, z], axis=2)).face.shape
    (4, 3)
    """
    number = np.arange(grid.shape[0] * grid.shape[1]).reshape(grid.shape[:2])
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    first = np.stack([a, c, b], axis=2).reshape(-1, 3)
    second = np.stack([a, d, c], axis=2).reshape(-1, 3)
    merged = merge_vertices(grid.reshape(-1, 3), np.concatenate([first, second]))
    i, j, k = merged.face.T
    return Triangles(merged.xyz, merged.face[(i != j) & (j != k) & (k != i)])

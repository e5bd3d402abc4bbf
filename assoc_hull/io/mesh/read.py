"""Triangles from a file: STL, OBJ or PLY, also packed with gzip, through trimesh."""

from __future__ import annotations

import gzip
import io
import logging
from pathlib import Path

import numpy as np

from assoc_hull.arguments import regular_file
from assoc_hull.errors import BadInputError, MissingExtraError
from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles, merge_vertices

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


def is_mesh_name(path: Path) -> bool:
    """Tell whether the name of a file is one of a mesh.

    Examples
    --------
    >>> from pathlib import Path
    >>> from assoc_hull.io.mesh.read import is_mesh_name
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
        data = regular_file(path).read_bytes()
        packed = gzip.GzipFile(fileobj=io.BytesIO(data)) if data[:2] == b"\x1f\x8b" else None
        text = packed.read(_MOST_BYTES + 1) if packed else data
    except (OSError, EOFError) as error:
        raise BadInputError(
            f"the file cannot be read ({error})", f"at {path}", "check name and file"
        ) from error
    if len(text) > _MOST_BYTES:
        raise BadInputError("the mesh is larger than 2 GB", f"at {path}", "thin it first")
    return text

"""Triangles from a file: STL, OBJ or PLY, also packed with gzip, through trimesh."""

from __future__ import annotations

import io
import logging
import re
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from assoc_hull.arguments import regular_file
from assoc_hull.errors import BadInputError, MissingExtraError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles, merge_vertices
from assoc_hull.io.child_process import limits_for, run_in_child
from assoc_hull.io.read_file import too_large, unpacked

__all__ = [
    "MESH_ENDINGS",
    "Triangles",
    "grid_triangles",
    "is_mesh_name",
    "merge_vertices",
    "parse_triangles",
    "read_triangles",
]

MESH_ENDINGS = (".stl", ".obj", ".ply")
_MOST_BYTES = 500_000_000
_FIRST_BYTES, _DENSE = 50_000_000, 60


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

    trimesh reads it in a process of its own, with limits of memory and time.

    Raises
    ------
    BadInputError
        The file cannot be read, is no mesh, holds no triangle or numbers that are not finite, or
        takes more than the limits.
    MissingExtraError
        trimesh is not installed.
    """
    regular_file(path)
    if find_spec("trimesh") is None:
        raise MissingExtraError("trimesh", "mesh")
    xyz, face = run_in_child(
        f"{__name__}:parse_triangles",
        (str(path),),
        limits_for(path),
        f"at {path}",
        (__name__, "trimesh"),
    )
    return merge_vertices(xyz, face)


def parse_triangles(name: str) -> tuple[FloatArray, IntArray]:
    """Give vertices (n, 3) and triangles (m, 3) of a file; called in a child.

    Raises
    ------
    BadInputError
        As for `read_triangles`.
    """
    import trimesh

    # Without a handler, what trimesh logs of a file it cannot read would go to standard error.
    logging.getLogger("trimesh").addHandler(logging.NullHandler())
    path = Path(name)
    ending = _ending(path).removeprefix(".")
    data = _recoded(_unpack(path), ending)
    told = _told_faces(data, ending)
    if ending == "stl" and told is not None and len(data) < 84 + 50 * told:
        raise _cut_short(path, told, max(len(data) - 84, 0) // 50)
    try:
        loaded = trimesh.load(io.BytesIO(data), file_type=ending, process=False, force="mesh")
        xyz = np.array(getattr(loaded, "vertices", np.zeros((0, 3))), np.float64)
        face = np.array(getattr(loaded, "faces", ()), np.int64).reshape(-1, 3)
    except MemoryError:
        raise
    except Exception as error:  # trimesh raises whatever its parsers meet
        raise BadInputError(
            f"no triangles could be read ({type(error).__name__})", f"at {path}",
            "check that the file is whole and its ending tells its form",
        ) from error  # fmt: skip
    if not len(face):
        raise _no_triangles(path, data, ending)
    # A text that ends early reads as a mesh with a hole.
    if told is not None and len(face) < told:
        raise _cut_short(path, told, len(face))
    if not np.isfinite(xyz).all() or face.min() < 0 or face.max() >= len(xyz):
        raise BadInputError("a vertex is missing or not finite", f"at {path}", "export it again")
    return xyz, face


def _told_faces(data: bytes, ending: str) -> int | None:
    """Give how many faces a file says it holds, where its form says so."""
    if ending == "stl" and len(data) >= 84 and not _is_text_stl(data):
        return int.from_bytes(data[80:84], "little")
    if ending == "ply":
        found = re.search(rb"^element\s+face\s+(\d{1,18})\s*$", data[:_HEAD], re.MULTILINE)
        return int(found[1]) if found else None
    return None


_HEAD = 20_000
"""So many bytes hold the header of a PLY."""


def _cut_short(path: Path, told: int, held: int) -> BadInputError:
    what = f"the file says that it holds {told} faces, and has {held}"
    return BadInputError(what, f"at {path}", "it was cut short: export or copy it again, whole")


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
    where = f"at {path}"
    if _ending(path) not in MESH_ENDINGS:
        raise BadInputError(
            "the form is unknown", where, f"give one of {', '.join(MESH_ENDINGS)} (.gz)"
        )
    try:
        data = regular_file(path).read_bytes()
    except OSError as error:
        what = f"the file cannot be read ({error})"
        raise BadInputError(what, where, "check name and file") from error
    if len(data) > _MOST_BYTES:
        raise too_large(_MOST_BYTES, where)
    # No mesh packs as densely as this: places differ from one another.
    return unpacked(data, min(_MOST_BYTES, _FIRST_BYTES + _DENSE * len(data)), where)

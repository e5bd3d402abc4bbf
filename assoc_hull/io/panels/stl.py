"""Panels as triangles, STL: binary, in single precision, or text.

The form knows no symmetry: the whole is written, with its mirror images. A panel of four corners
becomes two triangles along its shorter diagonal.
"""

from __future__ import annotations

import re

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
from assoc_hull.io.panels.text import DECIMALS, mesh_of, real

__all__ = ["dumps_stl", "dumps_stl_text", "is_stl", "loads_stl"]

_RECORD = np.dtype([("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("more", "<u2")])
_HEAD = 84
_VERTEX = re.compile(r"\bvertex\b", re.IGNORECASE)


def dumps_stl(mesh: PanelMesh) -> bytes:
    """Write a mesh as binary STL.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> from assoc_hull.io.panels.stl import dumps_stl
    >>> side = np.array([[0.0, 1, -2], [5, 1, -2], [5, 1, 0]])
    >>> len(dumps_stl(PanelMesh(side, np.array([[2, 1, 0, 0]]))))
    134
    """
    corner, normal = _triangles(mesh)
    records = np.zeros(len(corner), _RECORD)
    records["corner"], records["normal"] = corner, normal
    # A title that begins with "solid" would make it text.
    title = ("panels " + mesh.title).encode("ascii", "replace")[:80].ljust(80)
    return title + len(corner).to_bytes(4, "little") + records.tobytes()


def dumps_stl_text(mesh: PanelMesh) -> str:
    """Write a mesh as STL text."""
    corner, normal = _triangles(mesh)
    rounded = np.round(corner, DECIMALS) + 0.0
    lines = ["solid panels"]
    for face, out in zip(rounded.tolist(), normal.tolist(), strict=True):
        lines.append(" facet normal " + " ".join(f"{each:.6f}" for each in out))
        lines.append("  outer loop")
        lines += ["   vertex " + " ".join(f"{x:.{DECIMALS}f}" for x in each) for each in face]
        lines += ["  endloop", " endfacet"]
    return "\n".join([*lines, "endsolid panels", ""])


def is_stl(data: bytes) -> bool:
    """Tell whether bytes are such a file, binary or text."""
    count = int.from_bytes(data[80:_HEAD], "little")
    binary = len(data) >= _HEAD and len(data) == _HEAD + _RECORD.itemsize * count
    return binary or data.lstrip()[:5].lower() == b"solid"


def loads_stl(data: bytes, path: str) -> PanelMesh:
    """Read a mesh of triangles.

    Raises
    ------
    BadInputError
        It is cut short, or holds no number where one must be, or no triangle.
    """
    count = int.from_bytes(data[80:_HEAD], "little")
    if len(data) >= _HEAD and len(data) == _HEAD + _RECORD.itemsize * count:
        records = np.frombuffer(data, _RECORD, count, _HEAD)
        with np.errstate(invalid="ignore"):  # some bytes are no number, and signal it
            xyz = records["corner"].reshape(-1, 3).astype(np.float64)
    else:
        xyz = _text_vertices(data.decode("latin-1"), path)
    if not len(xyz):
        raise BadInputError("there are no triangles", f"at {path}", "export the hull")
    first = np.arange(0, len(xyz), 3)
    panel = np.stack([first, first + 1, first + 2, first + 2], axis=1)
    if not np.isfinite(xyz).all():
        raise BadInputError("a corner is not finite", f"at {path}", "export it again")
    return mesh_of(xyz, panel, (False, False), "", path)


def _text_vertices(text: str, path: str) -> FloatArray:
    """Take the vertices of a text, three to a triangle."""
    found = []
    for number, line in enumerate(text.splitlines(), start=1):
        at = _VERTEX.search(line)
        if at:
            words = line[at.end() :].split()
            if len(words) < 3:
                what = "a vertex has fewer than three numbers"
                raise BadInputError(what, f"at {path}, line {number}", "export it again")
            found.append([real(word, number, path) for word in words[:3]])
    if len(found) % 3 or "endsolid" not in text.lower():
        raise BadInputError("the file is cut short", f"at {path}", "copy it again, whole")
    return np.array(found, np.float64).reshape(-1, 3)


def _triangles(mesh: PanelMesh) -> tuple[FloatArray, FloatArray]:
    """Give corners (t, 3, 3) and normals (t, 3) of the whole."""
    full = mesh.whole()
    corner = full.xyz[full.panel]
    first = ((corner[:, 2] - corner[:, 0]) ** 2).sum(axis=1)
    second = ((corner[:, 3] - corner[:, 1]) ** 2).sum(axis=1)
    shorter = (first <= second) | full.triangle
    one = np.where(shorter[:, None], [0, 1, 2], [0, 1, 3])
    other = np.where(shorter[:, None], [0, 2, 3], [1, 2, 3])[~full.triangle]
    number = np.concatenate([
        np.take_along_axis(full.panel, one, axis=1),
        np.take_along_axis(full.panel[~full.triangle], other, axis=1),
    ])  # fmt: skip
    found = full.xyz[number]
    vector = np.cross(found[:, 1] - found[:, 0], found[:, 2] - found[:, 0])
    size = np.sqrt((vector**2).sum(axis=1))[:, None]
    return found, vector / np.where(size > 0.0, size, 1.0)

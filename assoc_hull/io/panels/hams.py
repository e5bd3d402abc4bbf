"""Panels as HAMS reads them, ``HullMesh.pnl``.

Three lines of comment, then the numbers of panels and vertices and the symmetries about x = 0 and
y = 0; comments; a line per vertex, number and coordinates, m; comments; a line per panel: its
number, 3 or 4, and as many vertex numbers. HAMS counts the lines of comment, so they are written
where its own files have them.

Source: the input files of HAMS (Y. Liu), github.com/YingyiLiu/HAMS.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
from assoc_hull.io.panels.nemoh import corners
from assoc_hull.io.panels.text import Row, mesh_of, rows_of, shown_rows, table, whole

__all__ = ["dumps_pnl", "is_pnl", "loads_pnl"]

_TITLE = "Hull Mesh File"


def dumps_pnl(mesh: PanelMesh) -> str:
    """Write a mesh.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> from assoc_hull.io.panels.hams import dumps_pnl, loads_pnl
    >>> side = np.array([[0.0, 1, -2], [5, 1, -2], [5, 1, 0]])
    >>> text = dumps_pnl(PanelMesh(side, np.array([[2, 1, 0, 0]]), mirror_y=True))
    >>> text.splitlines()[3].split()
    ['1', '3', '0', '1']
    >>> loads_pnl(text, "plate.pnl").mirror_y
    True
    """
    flags = f"{int(mesh.mirror_x):12d}{int(mesh.mirror_y):12d}"
    lines = [
        f"    --------------{_TITLE}---------------",
        "",
        "    # Number of Panels, Nodes, X-Symmetry and Y-Symmetry",
        f"{mesh.count:12d}{len(mesh.xyz):12d}{flags}",
        "",
        "    # Start Definition of Node Coordinates     ! node_number   x   y   z",
    ]
    places = shown_rows(mesh.xyz, 18)
    lines += [f"{number:8d}{place}" for number, place in enumerate(places, start=1)]
    lines += [
        "    # End Definition of Node Coordinates",
        "",
        "    # Start Definition of Node Relations   ! panel_number  number_of_vertices   "
        "Vertex1_ID   Vertex2_ID   Vertex3_ID   (Vertex4_ID)",
    ]
    sizes = np.where(mesh.triangle, 3, 4).tolist()
    for number, (size, panel) in enumerate(zip(sizes, (mesh.panel + 1).tolist(), strict=True), 1):
        lines.append(f"{number:8d}{size:8d}" + "".join(f"{each:8d}" for each in panel[:size]))
    return "\n".join([*lines, "    # End Definition of Node Relations", ""])


def is_pnl(text: str) -> bool:
    """Tell whether a text begins as such a file does."""
    head = text[:500].lower()
    return "mesh file" in head and "#" in head


def loads_pnl(text: str, path: str) -> PanelMesh:
    """Read a mesh.

    Raises
    ------
    BadInputError
        It is cut short, or holds no number where one must be, or names vertices that are not
        there.
    """
    # Comments may say anything; the other lines begin with a number without a sign.
    rows = [row for row in rows_of(text) if row[1][0][0].isdigit()]
    if not rows or len(rows[0][1]) < 4:
        what = "there is no line of four numbers before the vertices"
        raise BadInputError(what, f"at {path}", "check the form")
    line, words = rows[0]
    panels, nodes, *flags = (whole(word, line, path) for word in words[:4])
    if not set(flags) <= {0, 1}:
        what = f"the symmetries are {words[2]} and {words[3]}"
        raise BadInputError(what, f"at {path}, line {line}", "give 0 or 1")
    if panels < 1 or nodes < 3 or len(rows) - 1 < panels + nodes:
        what = f"there are {len(rows) - 1} lines for {nodes} vertices and {panels} panels"
        raise BadInputError(what, f"at {path}", "copy it again, whole")
    xyz = table(_numbered(rows[1 : 1 + nodes], "vertex", path), 1, 3, path)
    wanted = _numbered(rows[1 + nodes : 1 + nodes + panels], "panel", path)
    panel = np.empty((panels, 4), np.int64)
    sizes = np.array([_size(each, path) for each in wanted])
    for size in (3, 4):
        chosen = np.flatnonzero(sizes == size)
        panel[chosen[:, None], np.arange(size)] = corners(
            [wanted[i] for i in chosen.tolist()], 2, size, nodes, path
        )
    panel[sizes == 3, 3] = panel[sizes == 3, 2]
    return mesh_of(xyz, panel, (bool(flags[0]), bool(flags[1])), "", path)


def _numbered(rows: list[Row], what: str, path: str) -> list[Row]:
    """Refuse lines that are not numbered one after another."""
    for i, (line, words) in enumerate(rows):
        if whole(words[0], line, path) != i + 1:
            found = f"{what} {i + 1} has the number {words[0]}"
            raise BadInputError(found, f"at {path}, line {line}", "number them from 1")
    return rows


def _size(row: Row, path: str) -> int:
    line, words = row
    if len(words) < 2 or words[1] not in ("3", "4"):
        what = "the panel has neither 3 nor 4 vertices"
        raise BadInputError(what, f"at {path}, line {line}", "export it again")
    return int(words[1])

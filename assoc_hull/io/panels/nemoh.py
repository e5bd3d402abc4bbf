"""Panels as Nemoh reads them, ``.mar``.

First line ``2 s``, with s 1 if the mesh is one half, to be mirrored in the plane y = 0; then a
line per vertex, number and coordinates (m), closed by a line that begins with 0; then a line of
four vertex numbers per panel, closed by zeros. A triangle names one vertex twice.

Source: the manual of Nemoh 3 (LHEEA, Ecole Centrale de Nantes), mesh file.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
from assoc_hull.io.panels.text import Row, mesh_of, rows_of, shown_rows, table, whole

__all__ = ["dumps_mar", "is_mar", "loads_mar"]


def dumps_mar(mesh: PanelMesh) -> str:
    """Write a mesh; one that is mirrored in x = 0 too is written with that image.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> from assoc_hull.io.panels.nemoh import dumps_mar
    >>> side = np.array([[0.0, 1, -2], [5, 1, -2], [5, 1, 0]])
    >>> print(dumps_mar(PanelMesh(side, np.array([[2, 1, 0, 0]]), mirror_y=True)), end="")
         2     1
         1        0.000000        1.000000       -2.000000
         2        5.000000        1.000000       -2.000000
         3        5.000000        1.000000        0.000000
         0        0.000000        0.000000        0.000000
         3     2     1     1
         0     0     0     0
    """
    if mesh.mirror_x:
        half = mesh.mirror_y
        mesh = attrs.evolve(attrs.evolve(mesh, mirror_y=False).whole(), mirror_y=half)
    lines = [f"{2:6d}{int(mesh.mirror_y):6d}"]
    places = shown_rows(np.vstack([mesh.xyz, np.zeros(3)]))
    numbers = [*range(1, len(mesh.xyz) + 1), 0]
    wide = max(6, len(str(len(mesh.xyz))) + 1)  # so that numbers never run together
    lines += [f"{number:{wide}d}{place}" for number, place in zip(numbers, places, strict=True)]
    panels = [*(mesh.panel + 1).tolist(), [0, 0, 0, 0]]
    lines += ["".join(f"{corner:{wide}d}" for corner in panel) for panel in panels]
    return "\n".join(lines) + "\n"


def is_mar(text: str) -> bool:
    """Tell whether a text begins as such a file does."""
    rows = rows_of(text[:2000])[:2]
    return (
        len(rows) == 2
        and rows[0][1][0] == "2"
        and len(rows[0][1]) >= 2
        and rows[0][1][1] in ("0", "1")
        and rows[1][1][0] == "1"
        and len(rows[1][1]) >= 4
    )


def loads_mar(text: str, path: str) -> PanelMesh:
    """Read a mesh.

    Raises
    ------
    BadInputError
        It is cut short, or holds no number where one must be, or names vertices that are not
        there.
    """
    rows = rows_of(text)
    if not rows or len(rows[0][1]) < 2 or rows[0][1][1] not in ("0", "1"):
        raise BadInputError("the first line is not '2 0' or '2 1'", f"at {path}", "check the form")
    body = rows[1:]
    ends = [i for i, (_, words) in enumerate(body) if words[0] == "0"]
    if not ends:
        what = "the list of vertices is not closed by a line of zeros"
        raise BadInputError(what, f"at {path}", "copy it again, whole")
    last = ends[1] if len(ends) > 1 else len(body)
    nodes, panels = body[: ends[0]], body[ends[0] + 1 : last]
    for i, (line, words) in enumerate(nodes):
        if whole(words[0], line, path) != i + 1:
            what = f"vertex {i + 1} has the number {words[0]}"
            raise BadInputError(what, f"at {path}, line {line}", "number them from 1")
    xyz = table(nodes, 1, 3, path)
    panel = corners(panels, 0, 4, len(xyz), path)
    return mesh_of(xyz, panel, (False, rows[0][1][1] == "1"), "", path)


def corners(rows: list[Row], first: int, count: int, vertices: int, path: str) -> IntArray:
    """Take `count` vertex numbers of each line, from 1, as numbers from 0.

    Raises
    ------
    BadInputError
        A line is too short, or a vertex is not there.
    """
    found = np.zeros((len(rows), count), np.int64)
    for i, (line, words) in enumerate(rows):
        if len(words) < first + count:
            what = f"the panel names {max(len(words) - first, 0)} of {count} vertices"
            raise BadInputError(what, f"at {path}, line {line}", "export it again")
        for j in range(count):
            number = whole(words[first + j], line, path)
            if not 1 <= number <= vertices:
                what = f"the panel names vertex {number}"
                remedy = f"there are vertices 1 to {vertices}: export it again"
                raise BadInputError(what, f"at {path}, line {line}", remedy)
            found[i, j] = number - 1
    return found

"""Panels as WAMIT reads them, ``.gdf`` of the low-order method.

A line of title, the characteristic length and gravity, the symmetries ISX (plane x = 0) and ISY
(plane y = 0), the number of panels, then four vertices per panel, m. A triangle gives one vertex
twice. Seen from the water vertices go round counter-clockwise.

Source: WAMIT user manual, chapter 6, geometric data file.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
from assoc_hull.io.panels.text import Row, mesh_of, real, rows_of, shown_rows, whole

__all__ = ["dumps_gdf", "is_gdf", "loads_gdf"]

_GRAVITY = 9.80665


def dumps_gdf(mesh: PanelMesh, length: float = 1.0) -> str:
    """Write a mesh; `length` is the characteristic length ULEN, m.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> from assoc_hull.io.panels.wamit import dumps_gdf
    >>> side = np.array([[0.0, 1, -2], [5, 1, -2], [5, 1, 0]])
    >>> print(dumps_gdf(PanelMesh(side, np.array([[2, 1, 0, 0]]), title="plate")), end="")
    plate
            1.000000        9.806650  ULEN GRAV
         0     0  ISX ISY
         1
            5.000000        1.000000        0.000000
            5.000000        1.000000       -2.000000
            0.000000        1.000000       -2.000000
            0.000000        1.000000       -2.000000
    """
    lines = [
        " ".join(mesh.title.split()) or "panels",
        f"{length:16.6f}{_GRAVITY:16.6f}  ULEN GRAV",
        f"{int(mesh.mirror_x):6d}{int(mesh.mirror_y):6d}  ISX ISY",
        f"{mesh.count:6d}",
    ]
    lines += shown_rows(mesh.xyz[mesh.panel].reshape(-1, 3))
    return "\n".join(lines) + "\n"


def is_gdf(text: str) -> bool:
    """Tell whether a text begins as such a file does: a title, two numbers, two flags."""
    lines = text[:4000].split("\n", 4)
    if len(lines) < 4:
        return False
    flags, count = lines[2].split(), lines[3].split()
    numbers = lines[1].replace(",", " ").split()
    return (
        len(numbers) >= 2
        and len(flags) >= 2
        and set(flags[:2]) <= {"0", "1"}
        and bool(count)
        and count[0].isdigit()
    )


def loads_gdf(text: str, path: str) -> PanelMesh:
    """Read a mesh; vertices may stand in any lines, four times three numbers to a panel.

    Raises
    ------
    BadInputError
        It is cut short, or holds no number where one must be, or no panel.
    """
    title, _, rest = text.partition("\n")
    rows = [(line + 1, words) for line, words in rows_of(rest)]
    head = [_take(rows, i, 2 if i < 2 else 1, path) for i in range(3)]
    for line, word in ((head[0][0], each) for each in head[0][1][:2]):
        real(word, line, path)
    first, second = (_flag(word, head[1][0], path) for word in head[1][1][:2])
    count = whole(head[2][1][0], head[2][0], path)
    # A number of panels and what is behind it, or the vertices at once.
    words = [(head[2][0], word) for word in head[2][1][1:]]
    words += [(line, word) for line, every in rows[3:] for word in every]
    if count < 1:
        raise BadInputError(f"there are {count} panels", f"at {path}", "export the hull")
    if len(words) < 12 * count:
        what = f"there are {len(words)} numbers of {12 * count} for {count} panels"
        raise BadInputError(
            what, f"at {path}", "copy it again, whole; only low-order files are read"
        )
    every = np.array([real(word, line, path) for line, word in words[: 12 * count]])
    panel = np.arange(4 * count).reshape(-1, 4)
    return mesh_of(
        every.reshape(-1, 3), panel, (first, second), " ".join(title.split())[:200], path
    )


def _take(rows: list[Row], i: int, least: int, path: str) -> Row:
    if i >= len(rows) or len(rows[i][1]) < least:
        raise BadInputError("the head of four lines is not whole", f"at {path}", "check the form")
    return rows[i]


def _flag(word: str, line: int, path: str) -> bool:
    if word not in ("0", "1"):
        what, where = f"the symmetry is {word[:20]!r}", f"at {path}, line {line}"
        raise BadInputError(what, where, "give 0 or 1")
    return word == "1"

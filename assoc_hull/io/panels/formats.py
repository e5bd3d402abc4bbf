"""Panel meshes in the formats of WAMIT, Nemoh, HAMS and STL, and the files that hold them.

Each format has three functions: ``dumps_`` writes a mesh, ``is_`` recognises the format by its
content, ``loads_`` reads it. Vertices are in m, z = 0 at the water surface; planes of symmetry
(x = 0, y = 0) are kept where a format has them. A triangle names one vertex twice.

Panels in files of seakeeping codes: written whole or not at all, and read back.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.analysis.panels.hull_panels import panels
>>> from assoc_hull.io.panels.formats import read_panels, write_panels
>>> from assoc_hull.hull.sources import examples
>>> mesh = panels(examples.wigley(), count=200)
>>> with tempfile.TemporaryDirectory() as folder:
...     write_panels(mesh, Path(folder) / "wigley.gdf")
...     again = read_panels(Path(folder) / "wigley.gdf")
>>> again.count, again.mirror_y
(200, True)
"""

from __future__ import annotations

import gzip
import io
import os
import re
import zlib
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

import attrs
import numpy as np

from assoc_hull.arguments import (
    choice,
    file_path,
    instance,
    regular_file,
)
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh, merge_equal_vertices
from assoc_hull.io.write_file import form_by_ending, write_whole

__all__ = [
    "DECIMALS",
    "PANEL_FORMS",
    "Row",
    "dumps_gdf",
    "dumps_mar",
    "dumps_pnl",
    "dumps_stl",
    "dumps_stl_text",
    "is_gdf",
    "is_mar",
    "is_pnl",
    "is_stl",
    "loads_gdf",
    "loads_mar",
    "loads_pnl",
    "loads_stl",
    "mesh_of",
    "number_table",
    "panel_bytes",
    "panel_form_of",
    "read_panels",
    "read_real",
    "read_whole",
    "rows_of",
    "shown_rows",
    "write_panels",
]

DECIMALS = 6
"""Coordinates are written to the micrometre."""

_LARGEST = 1e6
"""No number of such a file is larger (m): a coordinate beyond it is damage."""

Row = tuple[int, list[str]]
"""Number of a line, and its words."""


def rows_of(text: str) -> list[Row]:
    r"""Give the lines that hold anything, as words; commas part words too.

    Examples
    --------
    >>> from assoc_hull.io.panels.formats import rows_of
    >>> rows_of("2 1\n\n1, 0.5 0 0\n")
    [(1, ['2', '1']), (3, ['1', '0.5', '0', '0'])]
    """
    lines = enumerate(text.splitlines(), start=1)
    every = ((number, line.replace(",", " ").split()) for number, line in lines)
    return [(number, words) for number, words in every if words]


def read_whole(word: str, line: int, path: str) -> int:
    """Take a whole number of at most nine digits.

    Raises
    ------
    BadInputError
        Anything else.
    """
    digits = word.lstrip("+-")
    if not (digits.isascii() and digits.isdigit() and len(digits) <= 9) or len(word) > 10:
        raise _not("a whole number", word, line, path)
    return int(word)


def read_real(word: str, line: int, path: str) -> float:
    """Take a finite number; the exponents of Fortran, as in 1.5D+01, are known.

    Raises
    ------
    BadInputError
        Anything else, and what is no length in metres.
    """
    try:
        # Python would take digits with "_" between them; nan fails the comparison below.
        found = float(word.lower().replace("d", "e")) if "_" not in word else np.nan
    except ValueError:
        found = np.nan
    if not abs(found) <= _LARGEST:
        raise _not(f"a number up to {_LARGEST:g}", word, line, path)
    return found


def _not(what: str, word: str, line: int, path: str) -> BadInputError:
    given = word if len(word) <= 20 else word[:20] + "..."
    return BadInputError(f"{given!r} is not {what}", f"at {path}, line {line}", "export it again")


def number_table(rows: list[Row], first: int, count: int, path: str) -> FloatArray:
    """Take `count` numbers of each line, behind its first words, as an array.

    Raises
    ------
    BadInputError
        A line is too short, or holds no number.
    """
    found = np.empty((len(rows), count))
    for i, (line, words) in enumerate(rows):
        if len(words) < first + count:
            what = f"there are {len(words)} of {first + count} numbers"
            raise BadInputError(what, f"at {path}, line {line}", "export it again")
        for j in range(count):
            found[i, j] = read_real(words[first + j], line, path)
    return found


def mesh_of(
    xyz: FloatArray, panel: IntArray, mirrors: tuple[bool, bool], title: str, path: str
) -> PanelMesh:
    """Make a mesh of what a file holds; equal vertices become one, panels without area go.

    Raises
    ------
    BadInputError
        Nothing is left, or it is no mesh.
    """
    places, corners = merge_equal_vertices(xyz + 0.0, panel)
    if not len(corners):
        raise BadInputError("there are no panels", f"at {path}", "export the hull, not an outline")
    return PanelMesh(places, corners, *mirrors, title)


def shown_rows(values: FloatArray, width: int = 16) -> list[str]:
    """Write rows of coordinates, (n, 3), m, in columns; there is no -0."""
    rounded = np.round(values, DECIMALS) + 0.0
    return ["".join(f"{each:{width}.{DECIMALS}f}" for each in row) for row in rounded.tolist()]


# --------------------------------------------------------------------------------------
# WAMIT, low-order method: a line of title, the characteristic length and gravity, the symmetries
# ISX (plane x = 0) and ISY (plane y = 0), the number of panels, then four vertices per panel,
# counter-clockwise seen from the water. Source: WAMIT user manual, chapter 6, geometric data file.

_GRAVITY = 9.80665  # m/s2


def dumps_gdf(mesh: PanelMesh, length: float = 1.0) -> str:
    """Write a mesh; `length` is the characteristic length ULEN, m.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> from assoc_hull.io.panels.formats import dumps_gdf
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
        read_real(word, line, path)
    first, second = (_flag(word, head[1][0], path) for word in head[1][1][:2])
    count = read_whole(head[2][1][0], head[2][0], path)
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
    every = np.array([read_real(word, line, path) for line, word in words[: 12 * count]])
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


# --------------------------------------------------------------------------------------
# Nemoh: first line ``2 s``, with s 1 if the mesh is one half, to be mirrored in the plane y = 0;
# then a line per vertex, number and coordinates, closed by a line that begins with 0; then a line
# of four vertex numbers per panel, closed by zeros.
# Source: the manual of Nemoh 3 (LHEEA, Ecole Centrale de Nantes), mesh file.


def dumps_mar(mesh: PanelMesh) -> str:
    """Write a mesh; one that is mirrored in x = 0 too is written with that image.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> from assoc_hull.io.panels.formats import dumps_mar
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
        if read_whole(words[0], line, path) != i + 1:
            what = f"vertex {i + 1} has the number {words[0]}"
            raise BadInputError(what, f"at {path}, line {line}", "number them from 1")
    xyz = number_table(nodes, 1, 3, path)
    panel = vertex_numbers(panels, 0, 4, len(xyz), path)
    return mesh_of(xyz, panel, (False, rows[0][1][1] == "1"), "", path)


def vertex_numbers(rows: list[Row], first: int, count: int, vertices: int, path: str) -> IntArray:
    """Take `count` vertex numbers of each line, behind its `first` words; counted from 0 then.

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
            number = read_whole(words[first + j], line, path)
            if not 1 <= number <= vertices:
                what = f"the panel names vertex {number}"
                remedy = f"there are vertices 1 to {vertices}: export it again"
                raise BadInputError(what, f"at {path}, line {line}", remedy)
            found[i, j] = number - 1
    return found


# --------------------------------------------------------------------------------------
# HAMS, ``HullMesh.pnl``: three lines of comment, the numbers of panels and vertices and the
# symmetries about x = 0 and y = 0; a line per vertex; a line per panel: its number, 3 or 4, and as
# many vertex numbers. HAMS counts the lines of comment between, so they are written where its own
# files have them. Source: the input files of HAMS (Y. Liu), github.com/YingyiLiu/HAMS.

_TITLE = "Hull Mesh File"


def dumps_pnl(mesh: PanelMesh) -> str:
    """Write a mesh.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> from assoc_hull.io.panels.formats import dumps_pnl, loads_pnl
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
    panels, nodes, *flags = (read_whole(word, line, path) for word in words[:4])
    if not set(flags) <= {0, 1}:
        what = f"the symmetries are {words[2]} and {words[3]}"
        raise BadInputError(what, f"at {path}, line {line}", "give 0 or 1")
    if panels < 1 or nodes < 3 or len(rows) - 1 < panels + nodes:
        what = f"there are {len(rows) - 1} lines for {nodes} vertices and {panels} panels"
        raise BadInputError(what, f"at {path}", "copy it again, whole")
    xyz = number_table(_numbered(rows[1 : 1 + nodes], "vertex", path), 1, 3, path)
    wanted = _numbered(rows[1 + nodes : 1 + nodes + panels], "panel", path)
    panel = np.empty((panels, 4), np.int64)
    sizes = np.array([_size(each, path) for each in wanted])
    for size in (3, 4):
        chosen = np.flatnonzero(sizes == size)
        panel[chosen[:, None], np.arange(size)] = vertex_numbers(
            [wanted[i] for i in chosen.tolist()], 2, size, nodes, path
        )
    panel[sizes == 3, 3] = panel[sizes == 3, 2]
    return mesh_of(xyz, panel, (bool(flags[0]), bool(flags[1])), "", path)


def _numbered(rows: list[Row], what: str, path: str) -> list[Row]:
    """Refuse lines that are not numbered one after another."""
    for i, (line, words) in enumerate(rows):
        if read_whole(words[0], line, path) != i + 1:
            found = f"{what} {i + 1} has the number {words[0]}"
            raise BadInputError(found, f"at {path}, line {line}", "number them from 1")
    return rows


def _size(row: Row, path: str) -> int:
    line, words = row
    if len(words) < 2 or words[1] not in ("3", "4"):
        what = "the panel has neither 3 nor 4 vertices"
        raise BadInputError(what, f"at {path}, line {line}", "export it again")
    return int(words[1])


# --------------------------------------------------------------------------------------
# STL, binary (single precision) or text. It has no symmetry: the whole is written, with its mirror
# images. A panel of four corners becomes two triangles along its shorter diagonal.

_RECORD = np.dtype([("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("more", "<u2")])
_HEAD = 84  # bytes: 80 of title, 4 of the number of triangles
_VERTEX = re.compile(r"\bvertex\b", re.IGNORECASE)


def dumps_stl(mesh: PanelMesh) -> bytes:
    """Write a mesh as binary STL.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> from assoc_hull.io.panels.formats import dumps_stl
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
            found.append([read_real(word, number, path) for word in words[:3]])
    if len(found) % 3 or "endsolid" not in text.lower():
        raise BadInputError("the file is cut short", f"at {path}", "copy it again, whole")
    return np.array(found, np.float64).reshape(-1, 3)


def _triangles(mesh: PanelMesh) -> tuple[FloatArray, FloatArray]:
    """Give corners (t, 3, 3), m, and unit normals (t, 3) of the whole; 0 for no area."""
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


PANEL_FORMS: Mapping[str, str] = MappingProxyType({
    "nemoh": ".mar", "wamit": ".gdf", "hams": ".pnl", "stl": ".stl", "stl-text": "",
})  # fmt: skip
"""The forms, and the ending of a file that means each."""

_MOST_BYTES = 500_000_000


def panel_form_of(path: str | os.PathLike[str], form: str | None = None) -> str:
    """Tell in which form a file is to be written: the one asked for, else by its ending.

    Raises
    ------
    BadInputError
        Neither says one.

    Examples
    --------
    >>> from assoc_hull.io.panels.formats import panel_form_of
    >>> panel_form_of("HullMesh.pnl"), panel_form_of("mesh.dat", "nemoh")
    ('hams', 'nemoh')
    """
    endings = {ending: name for name, ending in PANEL_FORMS.items() if ending}
    return form_by_ending(path, form, tuple(PANEL_FORMS), endings, "in panels")


def panel_bytes(mesh: PanelMesh, form: str) -> bytes:
    """Give the content of a file in a form, one of `PANEL_FORMS`."""
    instance(mesh, PanelMesh, "the mesh", "in panels")
    if choice(form, "format", tuple(PANEL_FORMS), "in panels") == "stl":
        return dumps_stl(mesh)
    write = {"nemoh": dumps_mar, "wamit": dumps_gdf, "hams": dumps_pnl, "stl-text": dumps_stl_text}
    return write[form](mesh).encode("utf-8")


def write_panels(mesh: PanelMesh, path: str | os.PathLike[str], form: str | None = None) -> None:
    """Write a mesh for a seakeeping code.

    Parameters
    ----------
    mesh : PanelMesh
        The mesh.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : str or None
        "nemoh", "wamit", "hams", "stl" or "stl-text"; by the ending of the file if None.

    Raises
    ------
    BadInputError
        A form that is not known, or a file that cannot be written.
    """
    write_whole(path, panel_bytes(mesh, panel_form_of(path, form)))


def read_panels(path: str | os.PathLike[str]) -> PanelMesh:
    """Read a mesh of panels; its content tells the form, and it may be packed with gzip.

    Parameters
    ----------
    path : path
        A file for Nemoh, WAMIT (low order) or HAMS, or an STL.

    Returns
    -------
    PanelMesh
        Equal vertices are one; panels that have no area because of it are left out. Nothing is
        known of what it was made of.

    Raises
    ------
    BadInputError
        The file cannot be read, is of none of these forms, or is damaged; with the line.
    """
    name = file_path(path, "in panels")
    data = _unpacked(Path(name))
    if is_stl(data):
        return loads_stl(data, name)
    text = data.decode("utf-8", "replace").removeprefix("\ufeff")
    for known, loads in ((is_pnl, loads_pnl), (is_mar, loads_mar), (is_gdf, loads_gdf)):
        if known(text):
            return loads(text, name)
    remedy = "give a file for Nemoh, WAMIT (low order) or HAMS, or an STL, whole"
    raise BadInputError("this is no file of panels", f"at {name}", remedy)


def _unpacked(path: Path) -> bytes:
    try:
        with regular_file(path).open("rb") as file:
            data = file.read(_MOST_BYTES + 1)
        if data[:2] == b"\x1f\x8b":
            data = gzip.GzipFile(fileobj=io.BytesIO(data)).read(_MOST_BYTES + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise BadInputError(
            f"the file cannot be read ({error})", f"at {path}", "check name and file"
        ) from error
    if len(data) > _MOST_BYTES:
        raise BadInputError("the file is larger than 500 MB", f"at {path}", "thin the mesh first")
    return data

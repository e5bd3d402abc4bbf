"""A closed mesh as a file: STL, OBJ, PLY or glTF, whole or not at all.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.io.mesh.closed_mesh_file import write_mesh
>>> from assoc_hull.sources import examples
>>> from assoc_hull.surface.cells.hull_mesh import closed_mesh
>>> mesh = closed_mesh(examples.wigley(stations=5, waterlines=4), points=2)
>>> with tempfile.TemporaryDirectory() as folder:
...     report = write_mesh(mesh, Path(folder) / "wigley.stl", unit="mm")
>>> report.form, report.unit, report.groups
('stl', 'mm', ('shell', 'deck'))
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from types import MappingProxyType

import attrs

from assoc_hull.arguments import choice, instance, text
from assoc_hull.io.mesh.closed_mesh_forms import MESH_FORMS, FiledMesh
from assoc_hull.io.write_file import form_by_ending, write_whole
from assoc_hull.surface.cells.closed_mesh import ClosedMesh

__all__ = ["MESH_ENDINGS", "MeshFile", "mesh_form_of", "write_mesh"]

MESH_ENDINGS: Mapping[str, str] = MappingProxyType(
    {ending: name for name, form in MESH_FORMS.items() for ending in form.endings}
)
"""The form that the ending of a file means."""

_SCALES = {"m": 1.0, "mm": 1e3}
_WHERE = "in a mesh file"


@attrs.frozen
class MeshFile:
    """What was written of a mesh.

    Attributes
    ----------
    path, form, unit : str
        The file; one of `assoc_hull.io.mesh.closed_mesh_forms.MESH_FORMS`; "m" or "mm".
    half : bool
        Whether it is the port half, open in the centre plane.
    vertices, triangles : int
        As they are in the file, equal vertices counted once.
    left_out : int
        Triangles of the mesh that have no area in the numbers of the file.
    groups : tuple of str
        Shell, deck, other covers. STL tells them in its text only.
    volume : float or None, m3
        What it encloses; None of a half, which encloses nothing.
    size : int
        Bytes.
    """

    path: str
    form: str
    unit: str
    half: bool
    vertices: int
    triangles: int
    left_out: int
    groups: tuple[str, ...]
    volume: float | None
    size: int


def mesh_form_of(path: str | os.PathLike[str], form: str | None = None) -> str:
    """Tell in which form a mesh is to be written: the one asked for, else by the ending.

    Raises
    ------
    BadInputError
        Neither says one.

    Examples
    --------
    >>> from assoc_hull.io.mesh.closed_mesh_file import mesh_form_of
    >>> mesh_form_of("ship.PLY"), mesh_form_of("ship.stl", "stl-text")
    ('ply', 'stl-text')
    """
    return form_by_ending(path, form, tuple(MESH_FORMS), MESH_ENDINGS, _WHERE)


def write_mesh(
    mesh: ClosedMesh,
    path: str | os.PathLike[str],
    form: str | None = None,
    *,
    unit: str | None = None,
    name: str = "hull",
) -> MeshFile:
    """Write a mesh.

    Parameters
    ----------
    mesh : ClosedMesh
        Both sides of a hull, or one.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : str or None
        "stl", "stl-text", "obj", "ply" or "glb"; by the ending of the file if None.
    unit : {"m", "mm"} or None
        Of the file, m if None. No form but glTF, which is in m, says which.
    name : str
        What the mesh is, for forms that can say so.

    Returns
    -------
    MeshFile
        How much was written.

    Raises
    ------
    OpenMeshError
        The mesh does not close, as it is or in the numbers of the file.
    BadInputError, MissingExtraError
        A form or unit that is not known, a file that cannot be written; glTF without trimesh.
    """
    instance(mesh, ClosedMesh, "the mesh", _WHERE)
    chosen = mesh_form_of(path, form)
    known = MESH_FORMS[chosen]
    used = known.units[0] if unit is None else choice(unit, "unit", known.units, _WHERE)
    side = "port half, open in the centre plane; " if mesh.half else ""
    title = f"{' '.join(text(name, 'the name', _WHERE).split())}: {side}unit {used}"
    filed = FiledMesh.of(mesh, _SCALES[used], known.rounded, title)
    data = known.dumps(filed)
    write_whole(path, data)
    return MeshFile(
        os.fspath(path), chosen, used, mesh.half, len(filed.xyz), len(filed.triangle),
        len(mesh.triangle) - len(filed.triangle), mesh.names,
        None if mesh.half else mesh.volume, len(data),
    )  # fmt: skip

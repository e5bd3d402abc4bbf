"""The surface of a hull as a file: its patches for CAD programs, or the closed mesh of its lines.

Examples
--------
>>> from assoc_hull.io.surfaces.hull_surface_file import surface_form_of
>>> surface_form_of("ship.stp"), surface_form_of("ship.stl"), surface_form_of("a", "iges-brep")
('step', 'stl', 'iges-brep')
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from types import MappingProxyType

from assoc_hull.arguments import flag, instance
from assoc_hull.io.cad.write import CAD_ENDINGS, CAD_FORMS, CadReport, write_cad
from assoc_hull.io.mesh.closed_mesh_file import MESH_ENDINGS, MeshFile, write_mesh
from assoc_hull.io.mesh.closed_mesh_forms import MESH_FORMS
from assoc_hull.io.write_file import form_by_ending
from assoc_hull.surface.blocks.net_surface import NetSurface
from assoc_hull.surface.cells.closed_mesh import mesh_of_net

__all__ = ["SURFACE_ENDINGS", "SURFACE_FORMS", "surface_form_of", "write_surface"]

SURFACE_FORMS: tuple[str, ...] = (*CAD_FORMS, *MESH_FORMS)
"""All forms by name."""

SURFACE_ENDINGS: Mapping[str, str] = MappingProxyType({**CAD_ENDINGS, **MESH_ENDINGS})
"""The form that the ending of a file means."""

_WHERE = "in the surface"


def surface_form_of(path: str | os.PathLike[str], form: str | None = None) -> str:
    """Tell in which form a surface is to be written: the one asked for, else by the ending.

    Raises
    ------
    BadInputError
        Neither says one.
    """
    return form_by_ending(path, form, SURFACE_FORMS, SURFACE_ENDINGS, _WHERE)


def write_surface(
    found: NetSurface,
    path: str | os.PathLike[str],
    form: str | None = None,
    *,
    unit: str | None = None,
    half: bool = False,
) -> CadReport | MeshFile:
    """Write the surface of a hull.

    Parameters
    ----------
    found : NetSurface
        The surface.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : str or None
        "step", "iges", "iges-brep" or "iges-surfaces": the patches. "stl", "stl-text", "obj",
        "ply" or "glb": the closed mesh, which comes from the lines. By the ending if None.
    unit : {"m", "mm"} or None
        Of the file: mm of CAD files if None, m of meshes.
    half : bool
        The half y >= 0 only; both sides are joined on the centre plane otherwise.

    Returns
    -------
    CadReport or MeshFile
        How much was written, and what was found when it was read back.

    Raises
    ------
    BadInputError
        A form or unit that is not known; a file that cannot be written, or is not sound.
    MissingExtraError
        The form needs a library that is not installed; its extra is named.
    OpenNetError, OpenMeshError
        The mesh does not close.
    """
    instance(found, NetSurface, "the surface", _WHERE)
    chosen, name = surface_form_of(path, form), found.particulars.name or "hull"
    alone = flag(half, "half", _WHERE)
    if chosen in CAD_FORMS:
        return write_cad(found.patches, path, chosen, unit=unit or "mm", half=alone, name=name)
    return write_mesh(mesh_of_net(found.net, half=alone), path, chosen, unit=unit, name=name)

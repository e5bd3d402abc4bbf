"""The surface of a hull as a file, and the schema of the report on it.

Patches go to CAD programs (STEP, IGES), the closed mesh of the lines to STL, OBJ, PLY or glTF. The
schema of the report ships as ``hull_surface.schema.json``.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from types import MappingProxyType

import attrs

from assoc_hull.arguments import flag, instance
from assoc_hull.io.cad.write import CAD_ENDINGS, CAD_FORMS, CadReport, write_cad
from assoc_hull.io.mesh.closed_mesh import MESH_ENDINGS, MESH_FORMS, MeshFile, write_mesh
from assoc_hull.io.tables.json_schema import (
    NULL,
    NUMBER,
    Schema,
    closed_object,
    document_schema,
    with_description,
)
from assoc_hull.io.write_file import form_by_ending
from assoc_hull.model.value_schema import NAME, NOT_NEGATIVE, POSITIVE, REAL, TEXT, list_of, one_of
from assoc_hull.surface.blocks.fit_quality import LEFT_OUT, residual_place
from assoc_hull.surface.blocks.fitted_surface import (
    FORMAT,
    SCHEMA,
    FittedSurface,
    require_sound_surface,
    surface_faults,
)
from assoc_hull.surface.cells.closed_mesh import mesh_of_net

__all__ = [
    "SURFACE_ENDINGS",
    "SURFACE_FORMS",
    "fitted_surface_schema",
    "surface_form_of",
    "write_surface",
]

# --------------------------------------------------------------------------------------
# The file.

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
    found: FittedSurface,
    path: str | os.PathLike[str],
    form: str | None = None,
    *,
    unit: str | None = None,
    half: bool = False,
    accept: bool = False,
) -> CadReport | MeshFile:
    """Write the surface of a hull.

    Parameters
    ----------
    found : FittedSurface
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
    accept : bool
        Write patches too that cross the centre plane or leave their limits, and a mesh that
        holds another volume than hydrostatics find.

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
    NotSoundError
        The halves cross or a limit is left, and that was not accepted; where and how far is told.
    OpenNetError, OpenMeshError
        The mesh does not close.
    """
    instance(found, FittedSurface, "the surface", _WHERE)
    chosen, name = surface_form_of(path, form), found.particulars.name or "hull"
    alone = flag(half, "half", _WHERE)
    taken = flag(accept, "accept", _WHERE)
    if chosen in CAD_FORMS:
        require_sound_surface(found, accept=taken)
        report = write_cad(found.patches, path, chosen, unit=unit or "mm", half=alone, name=name)
        worst = found.whole[0]
        missing = tuple(each for each in found.notes if each.startswith(LEFT_OUT))
        return attrs.evolve(
            report, residual=worst.largest, residual_place=residual_place(found.net, worst),
            left_out=missing, faults=surface_faults(found) if taken else (),
        )  # fmt: skip
    return write_mesh(
        mesh_of_net(found.net, half=alone), path, chosen, unit=unit, name=name,
        by_lines=found.displaced, net=found.net, accept=taken,
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# The schema, which ships beside this module as ``hull_surface.schema.json``; ``assoc-hull schema
# --of hull-surface`` prints it.

_WHOLE: Schema = {"type": "integer", "minimum": 0}
_PLACE: Schema = {"anyOf": [NULL, list_of(REAL, 3, 3).schema]}
_QUANTILES = list_of(NOT_NEGATIVE, 3, 3).schema
_OR_NONE: Schema = {"type": ["number", "null"], "minimum": 0}

_SHIP = closed_object(
    {
        "name": TEXT.schema,
        "length": with_description("between perpendiculars, m", POSITIVE.schema),
        "breadth": with_description("moulded, m", POSITIVE.schema),
        "depth": with_description("m", POSITIVE.schema),
        "draught": with_description("design, m", POSITIVE.schema),
        "deck": one_of(("open", "closed")).schema,
    }
)

_RESIDUALS = closed_object(
    {
        "kind": one_of(("fitted", "left out")).schema,
        "count": with_description("points of lines", _WHOLE),
        "median": with_description("distance from the surface, m", _OR_NONE),
        "p95": with_description("m", _OR_NONE),
        "p99": with_description("m", _OR_NONE),
        "largest": with_description("m", _OR_NONE),
        "place": with_description("of the largest, m; null: no points", _PLACE),
        "line": with_description("that it is on", TEXT.schema),
    }
)

_BLOCK = closed_object(
    {
        "name": NAME.schema,
        "kind": one_of(("body", "bow", "stern")).schema,
        "control_points": with_description("in u and in v", {"type": "array", "items": _WHOLE}),
        "spans": with_description("in u and in v", {"type": "array", "items": _WHOLE}),
        "smoothing": with_description("factor of the penalty, m3", NOT_NEGATIVE.schema),
        "limit": with_description("what 95 % of the distances should keep, m", NOT_NEGATIVE.schema),
        "least_element": with_description("least |S_u x S_v|, as a part of the median", NUMBER),
        "singular": with_description(
            "parameters of corners with tangent sides",
            {"type": "array", "items": list_of(REAL, 2, 2).schema},
        ),
        "residuals": {"type": "array", "minItems": 1, "items": _RESIDUALS},
        "notes": list_of(NAME).schema,
    }
)

_BORDER = closed_object(
    {
        "names": with_description("the two blocks", list_of(NAME, 2, 2).schema),
        "gap": with_description("median, 95 %, largest before joining, m", _QUANTILES),
        "joined_gap": with_description("largest after it, m", NOT_NEGATIVE.schema),
        "angle": with_description(
            "between the normals: median, 95 %, largest, degrees", _QUANTILES
        ),
        "place": with_description("of the largest angle, m", _PLACE),
        "limit": with_description("what the angle should keep, degrees", NOT_NEGATIVE.schema),
    }
)


def fitted_surface_schema() -> Schema:
    """Give the JSON Schema (draft 2020-12) of the report of a surface.

    Examples
    --------
    >>> from assoc_hull.io.surfaces.hull_surface import fitted_surface_schema
    >>> fitted_surface_schema()["required"][:4]
    ['format', 'schema', 'ship', 'blocks']
    """
    parts = {
        "ship": _SHIP,
        "blocks": {"type": "array", "minItems": 1, "items": _BLOCK},
        "whole": with_description(
            "all blocks together", {"type": "array", "minItems": 1, "items": _RESIDUALS}
        ),
        "borders": {"type": "array", "items": _BORDER},
        "left_out": with_description("lines that nothing was fitted to", list_of(NAME).schema),
        "refitted": with_description("blocks fitted in this call", list_of(NAME).schema),
        "notes": list_of(NAME).schema,
    }
    return document_schema(FORMAT, SCHEMA, "How a surface fits the lines of a hull", parts)

"""Files of a hull in any form: its lines, its surface, its closed mesh. `Hull.export` comes here.

The command `assoc-hull export` calls the same, so that both write the same file.
"""

from __future__ import annotations

import os
from collections.abc import Collection

from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.arguments import all_of, flag
from assoc_hull.errors import BadInputError
from assoc_hull.hull.results import surface_of_hull
from assoc_hull.io.cad.write import CadReport
from assoc_hull.io.export.write import ENDINGS, FORMS, export_hull
from assoc_hull.io.mesh.closed_mesh import MESH_FORMS, MeshFile, write_mesh
from assoc_hull.io.reports import ExportReport
from assoc_hull.io.surfaces.hull_surface import SURFACE_ENDINGS, SURFACE_FORMS
from assoc_hull.io.write_file import form_by_ending
from assoc_hull.model.tables import HasState, state_of
from assoc_hull.surface.cells.closed_mesh import fine_mesh_of_state, mesh_of_state
from assoc_hull.surface.volume_check import displaced_of, mesh_off

__all__ = ["export_file"]


def export_file(
    hull: HasState,
    path: str | os.PathLike[str],
    form: str | None = None,
    unit: str | None = None,
    *,
    scale: float | None = None,
    half: bool = False,
    points: int | None = None,
    accept: bool = False,
    leave_out: Collection[str] = (),
) -> ExportReport | CadReport | MeshFile:
    """Write a hull in a form of lines, surfaces or meshes; arguments as of `Hull.export`."""
    forms, endings = (*FORMS, *SURFACE_FORMS), {**ENDINGS, **SURFACE_ENDINGS}
    chosen = form_by_ending(path, form, forms, endings, "in export")
    alone, state = flag(half, "half", "in export"), state_of(hull, "in export")
    _refuse("points", "meshes", given=points is not None and chosen not in MESH_FORMS)
    names = set(all_of(leave_out, str, "leave_out", "in export"))
    _refuse("leave_out", "meshes", given=bool(names) and chosen not in MESH_FORMS)
    taken = flag(accept, "accept", "in export")
    _refuse("accept", "surfaces and meshes", given=taken and chosen not in (*SURFACE_FORMS, "3dm"))
    if chosen in FORMS:
        _refuse("half", "surfaces and meshes", given=alone)
        return export_hull(state, path, chosen, unit, scale=scale, accept=taken)
    _refuse("scale", "a lines plan", given=scale is not None)
    if chosen in MESH_FORMS:
        # The mesh comes from the lines: it needs no surface, which takes longer.
        by_lines = displaced_of(state, tunnels=not {each.name for each in state.tunnels} & names)
        mesh = (
            fine_mesh_of_state(
                state, lambda made: mesh_off(made, by_lines), half=alone, leave_out=names
            )
            if points is None
            else mesh_of_state(state, half=alone, points=points, leave_out=names)
        )
        return write_mesh(
            mesh, path, chosen, unit=unit, name=state.particulars.name or "hull",
            by_lines=by_lines, net=gather_net(state), accept=taken,
        )  # fmt: skip
    return surface_of_hull(hull).write(path, chosen, unit=unit, half=alone, accept=taken)


def _refuse(name: str, what: str, *, given: bool) -> None:
    if given:
        raise BadInputError(f"{name} is for {what}", "in export", "leave it out")

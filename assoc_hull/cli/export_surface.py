"""What `export` does and says of surfaces and meshes."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from assoc_hull.cli.output import emit, progress
from assoc_hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.hull import Hull
    from assoc_hull.io.cad.write import CadReport
    from assoc_hull.io.mesh.closed_mesh_file import MeshFile

__all__ = ["cad_words", "export_surface", "file_words", "mesh_words"]


def export_surface(arguments: argparse.Namespace, form: str) -> int:
    """Write patches for CAD programs, or the closed mesh, and say what was written."""
    from assoc_hull.io.mesh.closed_mesh_forms import MESH_FORMS

    hull = open_hull(arguments.hull)
    write = _mesh if form in MESH_FORMS else _patches
    report = write(arguments, hull, form)
    emit(arguments, {"export": report}, file_words(report))
    return 0


def _mesh(arguments: argparse.Namespace, hull: Hull, form: str) -> MeshFile:
    """Write the mesh: it needs no surface, which takes longer."""
    from assoc_hull.io.mesh.closed_mesh_file import write_mesh
    from assoc_hull.surface.cells.hull_mesh import closed_mesh

    with progress(f"writing {arguments.out}"):
        points = 4 if arguments.points is None else arguments.points
        mesh = closed_mesh(hull, half=arguments.half, points=points)
        name = hull.particulars.name or "hull"
        return write_mesh(mesh, arguments.out, form, unit=arguments.unit, name=name)


def _patches(arguments: argparse.Namespace, hull: Hull, form: str) -> CadReport | MeshFile:
    from assoc_hull.shell import surface

    with progress("fitting the surface"):
        found = surface(hull)
    with progress(f"writing {arguments.out}"):
        return found.write(arguments.out, form, unit=arguments.unit, half=arguments.half)


def file_words(report: CadReport | MeshFile) -> str:
    """Say what was written of a surface."""
    from assoc_hull.io.mesh.closed_mesh_file import MeshFile

    return mesh_words(report) if isinstance(report, MeshFile) else cad_words(report)


def mesh_words(report: MeshFile) -> str:
    """Say what was written of a mesh.

    Examples
    --------
    >>> from assoc_hull.cli.export_surface import mesh_words
    >>> from assoc_hull.io.mesh.closed_mesh_file import MeshFile
    >>> groups = ("shell", "deck")
    >>> print(mesh_words(MeshFile("a.stl", "stl", "m", False, 9, 14, 0, groups, 8.0, 784)))
    9 vertices, 14 triangles: shell, deck
    closed, 8.000 m3
    written: a.stl (stl, m)
    """
    rows = [
        f"{report.vertices} vertices, {report.triangles} triangles: {', '.join(report.groups)}",
        "the port half, open in the centre plane"
        if report.volume is None
        else f"closed, {report.volume:.3f} m3",
    ]
    if report.left_out:
        rows.append(f"{report.left_out} triangles have no area in the numbers of the file")
    return "\n".join([*rows, f"written: {report.path} ({report.form}, {report.unit})"])


def cad_words(report: CadReport) -> str:
    """Say what was written for CAD programs."""
    side = "the port half" if report.half else "both sides"
    rows = [f"{report.faces} faces, {side}, {report.area:.3f} m2"]
    if report.shells:
        shells = "1 shell" if report.shells == 1 else f"{report.shells} shells"
        rows.append(f"{shells}, {report.joined_edges} joined edges, {report.free_edges} free")
    rows.append(f"read back: control points within {1e3 * report.control_point_error:.1e} mm")
    return "\n".join([*rows, f"written: {report.path} ({report.form}, {report.unit})"])

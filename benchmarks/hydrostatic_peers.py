"""The same hydrostatics by others: trimesh, and capytaine.

Each is a job in two parts: what is made before, untimed, and what is timed. Both are treated as
kindly as can be: trimesh keeps what it has cached of the hull from run to run, and the panels of
capytaine are placed, and its body with all degrees of freedom made, before the clock starts.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any

import attrs
import numpy as np

from benchmarks.hydrostatic_hull import Measured, Position, panels, triangles

__all__ = ["Job", "capytaine_job", "trimesh_job"]


@attrs.frozen
class Job:
    """A measurement: what is timed takes what was prepared for it."""

    prepare: Callable[[], Any]
    run: Callable[[Any], Measured]

    def once(self) -> Measured:
        """Run it without a clock."""
        return self.run(self.prepare())


def trimesh_job(n: int, position: Position) -> Job:
    """Slice with a cap, take volume and centre; cut a section, and take its moments."""
    import trimesh
    from trimesh.path.polygons import second_moments

    mesh = triangles(n)
    body = trimesh.Trimesh(mesh.xyz, mesh.face, process=False)
    frame = position.frame()
    origin = np.array([0.0, 0.0, position.height])
    flat = np.eye(4)
    flat[:3, :3], flat[:3, 3] = frame, -frame @ origin

    def run(_: object) -> Measured:
        below = trimesh.intersections.slice_mesh_plane(body, -frame[2], origin, cap=True)
        section, _ = body.section(frame[2], origin).to_2D(to_2D=flat)
        area, first, second = 0.0, np.zeros(2), np.zeros(2)
        for polygon in section.polygons_full:
            area += polygon.area
            first += polygon.area * np.array(polygon.centroid.coords[0])
            second += second_moments(polygon)[:2]
        i_t, i_l = second - first[::-1] ** 2 / area
        return Measured(float(below.volume), below.center_mass, area, float(i_t), float(i_l))

    return Job(lambda: None, run)


def capytaine_job(n: int, position: Position) -> Job:
    """Compute the full hydrostatics of a body."""
    import capytaine

    # It warns of the waterplane of any body without a lid.
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    xyz, quads = panels(n)
    frame, origin = position.frame(), np.array([0.0, 0.0, position.height])
    placed = (xyz - origin) @ frame.T

    def prepare() -> Any:
        mesh = capytaine.Mesh(placed, quads)
        return capytaine.FloatingBody(
            mesh, dofs=capytaine.rigid_body_dofs(rotation_center=(50.0, 0.0, 0.0)),
            center_of_mass=(50.0, 0.0, 0.0),
        ).immersed_part()  # fmt: skip

    def run(body: Any) -> Measured:
        found = body.compute_hydrostatics(rho=1025.0)
        volume = float(found["disp_volume"])
        centre = origin + found["center_of_buoyancy"] @ frame
        # Its radii are about its origin; both inertias are wanted about the centre.
        area = float(found["waterplane_area"])
        x, y = found["waterplane_center"][:2].tolist()
        i_t = volume * float(found["transversal_metacentric_radius"]) - area * y * y
        i_l = volume * float(found["longitudinal_metacentric_radius"]) - area * x * x
        return Measured(volume, centre, area, i_t, i_l)

    return Job(prepare, run)

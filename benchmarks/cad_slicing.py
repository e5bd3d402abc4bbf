"""Lines out of surfaces: triangles once and Newton in each plane, against sections by OpenCASCADE.

The peer takes `BRepAlgoAPI_Section` plane by plane, as one would write it; it gives splines that
approximate the section, ours points that lie on the surface.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.faces import HullFaces, sew_surfaces
from assoc_hull.io.cad.kernel import MILLIMETRES, quiet_kernel
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.slicing.surface_lines import slice_surfaces
from benchmarks.cad_files import LENGTH, blocks
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures"]

FEW, MANY = 10, 60


def stations(count: int) -> list[float]:
    """Give places of stations within the hull, m."""
    return [round(each, 3) for each in np.linspace(0.05 * LENGTH, 0.95 * LENGTH, count).tolist()]


def ours(surfaces: Sequence[SplineSurface], places: list[float]) -> HullSlices:
    """Cut the surfaces as `ah.read` does."""
    return slice_surfaces(
        HullFaces.of(surfaces, "m"), stations=places, waterlines=0, buttocks=0, axes="+x+y+z"
    )


def by_sections(shell: object, places: list[float]) -> int:
    """Cut a shell by OpenCASCADE; count the edges that came."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Section
    from OCP.gp import gp_Dir, gp_Pln, gp_Pnt
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    count = 0
    with quiet_kernel():
        for place in places:
            plane = gp_Pln(gp_Pnt(place * MILLIMETRES, 0.0, 0.0), gp_Dir(1.0, 0.0, 0.0))
            section = BRepAlgoAPI_Section(shell, plane)
            walk = TopExp_Explorer(section.Shape(), TopAbs_ShapeEnum.TopAbs_EDGE)
            while walk.More():
                count += 1
                walk.Next()
    return count


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    surfaces = blocks(40)
    with quiet_kernel():
        shell = sew_surfaces(surfaces).shell
    few, many = stations(FEW), stations(MANY)
    times = side_by_side(
        {
            "few": partial(ours, surfaces, few),
            "many": partial(ours, surfaces, many),
            "peer": partial(by_sections, shell, few),
        },
        3 if quick else 7,
    )
    plane = (times["many"] - times["few"]) / (MANY - FEW)
    peer = times["peer"] / FEW
    return [
        Figure("slicing: OpenCASCADE / ours, per plane", peer / plane, goal=3.0),
        Figure(f"slicing: OpenCASCADE / ours, {FEW} planes in all", times["peer"] / times["few"]),
        Figure("slicing: a plane of ours", 1e3 * plane, "ms"),
        Figure("slicing: a plane by OpenCASCADE", 1e3 * peer, "ms"),
        Figure(
            f"slicing: {MANY} planes / {FEW} planes", times["many"] / times["few"],
            goal=MANY / FEW, sense="most",
        ),
    ]  # fmt: skip

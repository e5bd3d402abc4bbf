"""Closed meshes of ships: time, growth with cells, volumes beside hydrostatics and panels.

Peers: trimesh for the checks, `panels` of as many elements for the mesh. The first checks less
and the second does less (the immersed hull only, in strips), so both ratios are on the safe side.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import trimesh

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.analysis.panels.mesh_quality import panel_report
from assoc_hull.hull import Hull
from assoc_hull.surface.cells.closed_mesh import examine_mesh, mesh_of_net
from benchmarks.clock import Figure, side_by_side
from benchmarks.ships import duisburg_test_case

__all__ = ["figures"]

POINTS = 4
_GRIDS = ((21, 11), (41, 21), (81, 41))
"""Stations and waterlines of hulls with a formula, each with four times the cells of the last."""


def ships() -> dict[str, Hull]:
    """Give the ships by name; the Duisburg Test Case if its mesh is at hand."""
    found = {
        "bulk carrier 207,000 TDW": ah.examples.bulk_carrier_207k(),
        "Series 60": ah.examples.series60(),
    }
    tested = duisburg_test_case()
    return found if tested is None else {**found, "Duisburg Test Case": tested}


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    rounds = 3 if quick else 9
    every = ships()
    jobs: dict[str, Callable[[], object]] = {
        name: partial(ah.Hull.mesh, hull, points=POINTS) for name, hull in every.items()
    }
    grids = [gather_net(ah.examples.wigley(stations=n, waterlines=m).state) for n, m in _GRIDS]
    for i, net in enumerate(grids):
        jobs[f"grid {i}"] = partial(mesh_of_net, net, points=POINTS)
    carrier = every["bulk carrier 207,000 TDW"]
    mesh = carrier.mesh(points=POINTS)
    plain = carrier.mesh(points=2)
    jobs["plain"] = partial(ah.Hull.mesh, carrier, points=2)
    jobs["panels"] = partial(ah.Hull.panels, carrier, draught=18.0, count=len(plain.triangle) // 2)
    jobs["examined"] = partial(examine_mesh, mesh.xyz, mesh.triangle)
    jobs["trimesh"] = partial(_by_trimesh, mesh.xyz, mesh.triangle)
    found = side_by_side(jobs, rounds)
    result = [
        Figure(f"{name}, {POINTS} points to an edge", found[name], "s", 1.5, "most")
        for name in every
    ]
    for i in (1, 2):
        ratio = found[f"grid {i}"] / found[f"grid {i - 1}"]
        cells = mesh_of_net(grids[i], points=2).cells
        result.append(Figure(f"Wigley, {cells} cells / a quarter of them", ratio, "x", 6.0, "most"))
    return [
        *result,
        Figure("checks by trimesh / by us", found["trimesh"] / found["examined"], "x", 1.0),
        Figure("panels of as many elements / 2 points", found["panels"] / found["plain"], "x", 1.0),
        *(figure for name, hull in every.items() for figure in _volumes(name, hull)),
        _panel_error(carrier, len(plain.triangle) // 2),
    ]


def _by_trimesh(xyz: np.ndarray, triangle: np.ndarray) -> tuple[bool, bool, int, float]:
    """Ask of trimesh what a report holds."""
    mesh = trimesh.Trimesh(xyz, triangle, process=False)
    return mesh.is_watertight, mesh.is_winding_consistent, mesh.euler_number, mesh.volume


def _volumes(name: str, hull: Hull) -> list[Figure]:
    """Give volumes and centres below the design draught beside those of the splines."""
    draught, length = hull.particulars.draught, hull.particulars.length
    wanted = hull.hydrostatics(draught=draught)
    found = list[Figure]()
    for points in (2, 4, 8):
        mesh = hull.mesh(points=points)
        below = mesh.below(draught)
        off = 100.0 * abs(below.volume / wanted.volume - 1.0)
        aside = 100.0 * abs(below.lcb - wanted.lcb) / length
        asked = 0.02 + 0.15 * 1600 / mesh.cells if points == POINTS else None
        told = f"{name}, {points} points: "
        found.append(Figure(told + "volume off by", off, "%", asked, "most"))
        limit = 0.01 if points == POINTS else None
        found.append(Figure(told + "LCB off by", aside, "% Lpp", limit, "most"))
    return found


def _panel_error(hull: Hull, count: int) -> Figure:
    """Give the error of the volume of panels, as their report has it."""
    report = panel_report(hull.panels(draught=hull.particulars.draught, count=count))
    return Figure(f"{count} panels: volume off by", 100.0 * abs(report.volume_error or 0.0), "%")

"""Hydrostatics of one floating position: V, B, Aw, I_T and I_L, ours beside trimesh and capytaine.

All measure the same Wigley hull in the same position. Of each peer the coarsest panels are taken
whose volume is right to 3e-4. Times are the least of many runs by the clock, the jobs taking
turns: what others do on the machine only ever adds, and some of the sums use both cores.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Mapping
from time import perf_counter
from typing import Any

import numpy as np

from assoc_hull.analysis.hydrostatics.mesh_flotation import mesh_flotation
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import integrate_immersed
from assoc_hull.geometry.splines.backend import backend, set_backend
from benchmarks.clock import Figure
from benchmarks.hydrostatic_hull import (
    EVEN,
    INCLINED,
    Measured,
    Position,
    exact,
    measured,
    triangles,
)
from benchmarks.hydrostatic_net import net
from benchmarks.hydrostatic_peers import Job, capytaine_job, trimesh_job

__all__ = ["figures", "ours", "ours_at_heights"]

ALLOWED = 3e-4
"""What the volume of a peer may be off, relatively."""

MESH = 41
"""Rows of panels of our own mesh route: the volume is off by no more than that."""

DRAUGHTS = 200
TABLE_NET = (21, 11)
"""Stations and waterlines of the hull of which many draughts are asked: those of the example."""

PEERS = {"trimesh": trimesh_job, "capytaine": capytaine_job}
NEEDED = {"trimesh": ("trimesh", "shapely", "mapbox_earcut"), "capytaine": ("capytaine",)}
GOALS = {"trimesh": 8, "capytaine": 500}


def ours(position: Position) -> Job:
    """Give our side: from the points of a net to the values, lofting included.

    What points to what in the net is known before, as the peers know their triangles.
    """
    lines = net()
    return Job(lambda: None, lambda _: measured(lines.measure(position.planes()), position))


def ours_at_heights(position: Position) -> Callable[[FloatArray], Any]:
    """Give our side for many heights of the plane in one call, and so for one."""
    body = net(*TABLE_NET).fitted()
    return lambda heights: integrate_immersed(body, position.planes(heights))


def mesh_route(n: int, position: Position) -> Job:
    """Give our own measurement of panels: the mesh made ready before, as that of trimesh is."""
    mesh = triangles(n)
    hull = mesh_flotation(mesh.xyz, mesh.face)
    return Job(lambda: None, lambda _: measured(hull.measure(position.planes()), position))


def figures(quick: bool = False) -> list[Figure]:
    """Measure; our lofting is compiled if the extra `fast` is installed."""
    found: list[Figure] = []
    before = backend()
    set_backend("numba" if importlib.util.find_spec("numba") else "numpy")
    found.append(Figure("compiled by numba", float(backend() == "numba"), ""))
    try:
        for position in (EVEN, INCLINED):
            found += _one_position(position, quick)
        return found + _batch(quick)
    finally:
        set_backend(before)


def fastest(jobs: Mapping[str, Job], rounds: Mapping[str, int]) -> dict[str, float]:
    """Give the least time of each job, s; all take turns until each had its rounds."""
    best = dict.fromkeys(jobs, float("inf"))
    for turn in range(max(rounds.values())):
        for name, job in jobs.items():
            # Those that need fewer rounds are spread over all turns.
            if turn % max(1, max(rounds.values()) // rounds[name]):
                continue
            prepared = job.prepare()
            begin = perf_counter()
            job.run(prepared)
            best[name] = min(best[name], perf_counter() - begin)
    return best


def _one_position(position: Position, quick: bool) -> list[Figure]:
    true = exact(position)
    jobs = {"ours": ours(position), "our mesh route": mesh_route(MESH, position)}
    rows = {"ours": 0, "our mesh route": MESH}
    for name, make in PEERS.items():
        if all(importlib.util.find_spec(needed) for needed in NEEDED[name]):
            rows[name] = _coarsest(make, position, true)
            jobs[name] = make(rows[name], position)
    few = 1 if quick else 5
    rounds = {"ours": 40 * few, "our mesh route": 40 * few, "trimesh": 10 * few, "capytaine": few}
    times = fastest(jobs, {name: rounds[name] for name in jobs})
    off = {name: job.once().off(true) for name, job in jobs.items()}
    return _told(position.name, times, off, rows)


def _coarsest(make: Callable[[int, Position], Job], position: Position, true: Measured) -> int:
    """Find how many rows of panels the volume needs: its error falls with their square."""
    n = 16
    n = int(np.ceil(n * np.sqrt(make(n, position).once().off(true)["volume"] / ALLOWED)))
    while make(n, position).once().off(true)["volume"] > ALLOWED:
        n += 1
    return n


def _told(
    where: str, times: dict[str, float], off: dict[str, dict[str, float]], rows: dict[str, int]
) -> list[Figure]:
    found = []
    for name, time in times.items():
        panels = f", {2 * rows[name]} x {rows[name]} panels a side" if rows[name] else ""
        found.append(Figure(f"{where}: {name}{panels}", 1e3 * time, "ms"))
        goal = 2e-6 if name == "ours" else None
        found.append(Figure(f"{where}: {name}: error of V", off[name]["volume"], "", goal, "most"))
        worst = max((value, key) for key, value in off[name].items())
        found.append(Figure(f"{where}: {name}: largest error, {worst[1]}", worst[0], ""))
    found += [
        Figure(f"{where}: {name} / ours", times[name] / times["ours"], goal=goal)
        for name, goal in GOALS.items()
        if name in times
    ]
    return found


def _batch(quick: bool) -> list[Figure]:
    """Measure many draughts in one call against as many calls."""
    measure = ours_at_heights(INCLINED)
    heights = INCLINED.height + np.linspace(-2.0, 1.0, DRAUGHTS)
    single = heights[:, None].copy()
    times = {"batch": float("inf"), "calls": float("inf")}
    for _ in range(3 if quick else 10):
        begin = perf_counter()
        measure(heights)
        middle = perf_counter()
        for row in single:
            measure(row)
        times["batch"] = min(times["batch"], middle - begin)
        times["calls"] = min(times["calls"], perf_counter() - middle)
    return [
        Figure(f"{DRAUGHTS} draughts in one batch", 1e3 * times["batch"], "ms"),
        Figure(f"{DRAUGHTS} calls / the batch", times["calls"] / times["batch"], goal=10),
    ]

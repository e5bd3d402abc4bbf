"""From nothing to the first re-loft, in new processes, against importing numpy alone."""

from __future__ import annotations

import subprocess
import sys
from time import perf_counter

from benchmarks.clock import Figure

__all__ = ["figures"]

BARE = "import numpy"
FIRST = """
import assoc_hull
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from benchmarks.full_reloft import kernel
from benchmarks.shape import shape
"""
"""The first re-loft is that of the benchmark net; its lines are made here too."""
EDIT = """
import assoc_hull
hull = assoc_hull.examples.wigley()
with hull.edit("move") as edit:
    edit.move("WL 2.5 x ST 7", y=hull.find("WL 2.5 x ST 7").y + 0.01)
"""
"""All that a session needs: the modules of whole hulls, a hull made, and one edit of it."""


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    jobs = {"numpy": BARE, "first": FIRST + "kernel(shape())()", "package": "import assoc_hull"}
    jobs["edit"] = EDIT
    times: dict[str, list[float]] = {name: [] for name in jobs}
    for _ in range(7 if quick else 25):
        for name, code in jobs.items():
            begin = perf_counter()
            subprocess.run([sys.executable, "-c", code], check=True)
            times[name].append(perf_counter() - begin)
    numpy, first, package, edit = (sorted(taken)[len(taken) // 2] for taken in times.values())
    return [
        Figure("start: import numpy", 1e3 * numpy, "ms"),
        Figure("start: import assoc_hull", 1e3 * package, "ms"),
        Figure("start: import and first re-loft", 1e3 * first, "ms"),
        Figure("start: import and first re-loft / numpy", first / numpy, goal=2.5, sense="most"),
        Figure("start: import, a hull made and edited / numpy", edit / numpy),
    ]

"""Re-loft of the whole net and all its crossings: the kernel against one curve at a time.

All 130 curves are lofted; the sections are cut with the planes of all waterlines and
buttocks, and the waterlines with those of all buttocks: so each crossing is found once.
(From the other side many meetings lie on knots, where others find them twice.)
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.backend import Backend, backend, set_backend
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from benchmarks.clock import Figure, side_by_side
from benchmarks.loops import Job, opencascade, scipy_loop
from benchmarks.shape import FAMILIES, Shape, batch_of, shape

__all__ = ["figures", "kernel"]

CUTS: tuple[tuple[int, ...], ...] = ((1, 2), (2,), ())
"""For sections, waterlines and buttocks the families whose planes they are cut with."""

GOALS = (
    ("numpy", "scipy", 150),
    ("numpy", "OpenCASCADE", 30),
    ("fast", "scipy", 700),
    ("fast", "OpenCASCADE", 120),
)


def kernel(lines: Shape) -> Callable[[], int]:
    """Give a job that lofts and cuts the net with the kernel, and counts the crossings."""
    families = lines.families()
    data = batch_of(tuple(line for family in families for line in family))
    bounds = np.cumsum([0, *(len(family) for family in families)]).tolist()
    planes = [(np.eye(3)[axis], offsets) for _, axis, offsets in FAMILIES]

    def job() -> int:
        batch, count = loft(data), 0
        for place, partners in enumerate(CUTS):
            part = batch.part(bounds[place], bounds[place + 1])
            count += sum(intersect_planes(part, *planes[other]).count for other in partners)
        return count

    return job


def one_by_one(lines: Shape) -> Job:
    """Give the same work for the loops."""
    points: list[FloatArray] = []
    planes: list[tuple[tuple[int, FloatArray], ...]] = []
    for family, partners in zip(lines.families(), CUTS, strict=True):
        points += family
        planes += [tuple(FAMILIES[other][1:] for other in partners)] * len(family)
    return Job(tuple(points), tuple(planes))


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    lines = shape()
    work, job = kernel(lines), one_by_one(lines)
    work()
    lean = "scipy" not in sys.modules
    jobs: dict[str, Callable[[], int]] = {"numpy": lambda: _with("numpy", work)}
    if importlib.util.find_spec("numba"):
        jobs["fast"] = lambda: _with("numba", work)
    jobs["scipy"] = lambda: scipy_loop(job)
    if importlib.util.find_spec("OCP"):
        jobs["OpenCASCADE"] = lambda: opencascade(job)
    counts = {name: run() for name, run in jobs.items()}
    if len(set(counts.values())) > 1:
        raise AssertionError(f"not the same number of crossings: {counts}")
    times = side_by_side(jobs, 3 if quick else 15, {"numpy": 30, "fast": 50})
    set_backend("numpy")
    found = [Figure(f"{name} found", counts[name], "crossings") for name in jobs]
    found += [Figure(name, 1e3 * times[name], "ms") for name in jobs]
    for mine, theirs, goal in GOALS:
        if mine in times and theirs in times:
            found.append(Figure(f"{theirs} / {mine}", times[theirs] / times[mine], goal=goal))
    found.append(Figure("ran before scipy was imported", float(lean), "", 1.0, "equal"))
    return [attrs.evolve(each, name=f"full re-loft: {each.name}") for each in found]


def _with(wanted: Backend, job: Callable[[], int]) -> int:
    if backend() != wanted:
        set_backend(wanted)
    return job()

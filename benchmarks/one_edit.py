"""The edit of one section: the whole engine, alone and in a large hull, and the bare sum.

The edit moves three points of the midship section; 71 curves are lofted, and some 8,200
meetings found. `benchmarks/bare.py` is the yardstick, and is held against scipy itself.
"""

from __future__ import annotations

import gc
import tracemalloc
from collections.abc import Callable

import attrs

from benchmarks.bare import Bare
from benchmarks.clock import Figure, side_by_side
from benchmarks.copies import copies_of
from benchmarks.drag import MOVED, Dragging, places
from benchmarks.loops import Job, scipy_loop
from benchmarks.net import MIDSHIP, make_net
from benchmarks.shape import BUTTOCKS, FAMILIES, WATERLINES, Shape, shape

__all__ = ["figures"]

COPIES = 100
CURVES = 1 + len(WATERLINES) + len(BUTTOCKS)


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    lines = shape()
    net = make_net(lines)
    alone, bare = Dragging(net), _bare_drags(lines)
    lofted = {len(alone().relofted) for _ in range(3)}
    if lofted != {CURVES}:
        raise AssertionError(f"{lofted} curves were lofted, not {CURVES}")
    jobs: dict[str, Callable[[], object]] = {
        "engine": _bounded(alone),
        "bare": bare,
        "scipy": lambda: scipy_loop(_scipy_job(lines)),
    }
    rounds = 5 if quick else 15
    times = side_by_side(jobs, rounds, {"engine": 20, "bare": 20})
    found = [Figure("curves lofted", CURVES, "", CURVES, "equal")]
    found += [Figure(name, 1e3 * times[name], "ms") for name in jobs]
    found += [
        Figure("engine / bare", times["engine"] / times["bare"], goal=3.0, sense="most"),
        Figure("engine / bare, the aim", times["engine"] / times["bare"], goal=1.5, sense="most"),
        Figure("scipy / bare", times["scipy"] / times["bare"], goal=20.0),
    ]
    found += _among_copies(alone, 10 if quick else COPIES, rounds)
    return [attrs.evolve(each, name=f"one edit: {each.name}") for each in found]


def _bounded(drag: Dragging) -> Callable[[], object]:
    """Let go of the history now and then, as 20 drags keep some 10 MB."""

    def job() -> object:
        if len(drag.document.history) >= 50:
            drag.forget()
        return drag()

    return job


def _bare_drags(lines: Shape) -> Callable[[], object]:
    bare, count = Bare(lines, MIDSHIP), iter(range(10**9))
    section = lines.sections[MIDSHIP]
    start = section[list(MOVED)]

    def job() -> object:
        points = section.copy()
        points[list(MOVED)] = places(start, next(count))
        return bare.edit(points)

    return job


def _scipy_job(lines: Shape) -> Job:
    """Give the same lofts and cuts for scipy; the knots are taken as they stand."""
    level = tuple(FAMILIES[place][1:] for place in (0, 2))
    upright = tuple(FAMILIES[place][1:] for place in (0, 1))
    across = tuple(FAMILIES[place][1:] for place in (1, 2))
    return Job(
        (lines.sections[MIDSHIP], *lines.waterlines, *lines.buttocks),
        (across, *[level] * len(lines.waterlines), *[upright] * len(lines.buttocks)),
    )


def _among_copies(alone: Dragging, count: int, rounds: int) -> list[Figure]:
    """Drag the same section in a hull that holds the net many times."""
    gc.collect()
    tracemalloc.start()
    many = Dragging(copies_of(alone.document.state, count))
    gc.collect()
    held = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    jobs = {"alone": _bounded(alone), "many": _bounded(many)}
    times = side_by_side(jobs, rounds, {"alone": 20, "many": 20})
    crossings = int((many.document.state.rows.curve[:, 1] >= 0).sum())
    name = f"among {count} copies"
    return [
        Figure(f"{name}: crossings in the hull", crossings, ""),
        Figure(name, 1e3 * times["many"], "ms"),
        Figure(f"{name} / alone", times["many"] / times["alone"], goal=1.3, sense="most"),
        Figure("memory per crossing, all of the hull included", held / crossings, "bytes"),
    ]

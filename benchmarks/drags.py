"""Twenty thousand drags: how evenly they run, and what they leave behind.

The history is let go every 500 drags, between two drags: every step keeps all values that it
changed, so that undo need not compute, and 20,000 of them fill the memory of a large machine.

On a machine that others use as well the slowest drags are those during which it worked for
others; the time of the processor, printed too, leaves out the waiting for it.
"""

from __future__ import annotations

import gc
import tracemalloc
from time import perf_counter, thread_time

import attrs
import numpy as np

from assoc_hull.edit.quiet import settle
from benchmarks.clock import Figure
from benchmarks.drag import Dragging
from benchmarks.net import make_net

__all__ = ["figures"]

DRAGS, QUICK = 20_000, 2_000
KEPT = 500


class Collections:
    """Counts garbage collections that fall into a drag."""

    def __init__(self) -> None:
        self.inside = False
        self.count = 0

    def __call__(self, phase: str, _: dict[str, int]) -> None:
        self.count += phase == "start" and self.inside


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    drag = Dragging(make_net())
    for _ in range(20):
        drag()
    kept = _bytes_per_step(drag, 50)
    drag.forget()
    settle()
    watch = Collections()
    gc.callbacks.append(watch)
    try:
        taken = _run(drag, QUICK if quick else DRAGS, watch)
    finally:
        gc.callbacks.remove(watch)
        gc.unfreeze()
    found = [Figure("median", 1e3 * float(np.median(taken[0])), "ms")]
    for clock, times in zip(("", ", processor time"), taken, strict=True):
        goal = 3.0 if clock == "" else None
        p50, p99, p999 = np.percentile(times, [50, 99, 99.9]).tolist()
        found += [
            Figure(f"p99 / median{clock}", p99 / p50),
            Figure(f"p99.9 / median{clock}", p999 / p50, goal=goal, sense="most"),
            Figure(f"largest / median{clock}", float(times.max()) / p50),
        ]
    found += [
        Figure("garbage collections inside", watch.count, "", 0.0, "equal"),
        Figure("kept in the history for each", kept / 1024, "KiB"),
    ]
    return [attrs.evolve(each, name=f"{taken.shape[1]} drags: {each.name}") for each in found]


def _run(drag: Dragging, count: int, watch: Collections) -> np.typing.NDArray[np.float64]:
    taken = np.empty((2, count))
    for number in range(count):
        watch.inside = True
        begin, worked = perf_counter(), thread_time()
        drag()
        taken[:, number] = perf_counter() - begin, thread_time() - worked
        watch.inside = False
        gc.collect(1)  # what had to wait comes now, as when a program waits for the pointer
        if number % KEPT == KEPT - 1:
            drag.forget()
    return taken


def _bytes_per_step(drag: Dragging, count: int) -> float:
    gc.collect()
    tracemalloc.start()
    for _ in range(count):
        drag()
    gc.collect()
    held = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    return held / count

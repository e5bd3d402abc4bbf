"""Twenty thousand drags: how evenly they run, and what they leave behind.

The history is let go every 500 drags, between two drags: every step keeps all values that it
changed, so that undo need not compute, and 20,000 of them fill the memory of a large machine.

On a machine that others use as well the slowest drags are those during which it worked for
others. Three figures tell these from slow drags of our own: the time of the processor, which
leaves out the waiting for it; how many drags were interrupted, as the operating system counts
(involuntary context switches); and the wall time of the drags that were not.
"""

from __future__ import annotations

import gc
import tracemalloc
from collections.abc import Callable
from time import perf_counter, thread_time

import attrs
import numpy as np

from assoc_hull.edit.garbage_collection import freeze_loaded_objects
from benchmarks.clock import Figure
from benchmarks.drag import Dragging
from benchmarks.net import make_net

__all__ = ["figures"]

DRAGS, QUICK = 20_000, 2_000
KEPT = 500
_ENOUGH = 1_000
"""So many drags that were not interrupted say something of the slowest thousandth."""


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
    freeze_loaded_objects()
    watch = Collections()
    gc.callbacks.append(watch)
    try:
        taken = _run(drag, QUICK if quick else DRAGS, watch)
    finally:
        gc.callbacks.remove(watch)
        gc.unfreeze()
    wall, worked, switches = taken
    found = [Figure("median", 1e3 * float(np.median(wall)), "ms")]
    found += _quantiles(wall, "")
    found += _quantiles(worked, ", processor time")
    quiet = wall[switches == 0]
    found.append(Figure("interrupted by other work", len(wall) - len(quiet), "drags"))
    if len(quiet) >= _ENOUGH:
        found += _quantiles(quiet, ", not interrupted", goal=None)
    found += [
        Figure("garbage collections inside", watch.count, "", 0.0, "equal"),
        Figure("kept in the history for each", kept / 1024, "KiB"),
    ]
    return [attrs.evolve(each, name=f"{taken.shape[1]} drags: {each.name}") for each in found]


def _quantiles(
    times: np.typing.NDArray[np.float64], which: str, goal: float | None = 3.0
) -> list[Figure]:
    p50, p99, p999 = np.percentile(times, [50, 99, 99.9]).tolist()
    return [
        Figure(f"p99 / median{which}", p99 / p50),
        Figure(f"p99.9 / median{which}", p999 / p50, goal=goal, sense="most"),
        Figure(f"largest / median{which}", float(times.max()) / p50),
    ]


def _switch_counter() -> Callable[[], float]:
    """Count how often this thread was interrupted, if the operating system tells."""
    try:
        import resource
    except ModuleNotFoundError:
        return lambda: 0.0
    who = getattr(resource, "RUSAGE_THREAD", resource.RUSAGE_SELF)
    return lambda: float(resource.getrusage(who).ru_nivcsw)


def _run(drag: Dragging, count: int, watch: Collections) -> np.typing.NDArray[np.float64]:
    """Give wall time, time of the processor (s) and interruptions of each drag."""
    taken, switches = np.empty((3, count)), _switch_counter()
    for number in range(count):
        watch.inside = True
        before, begin, worked = switches(), perf_counter(), thread_time()
        drag()
        taken[:2, number] = perf_counter() - begin, thread_time() - worked
        taken[2, number] = switches() - before
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

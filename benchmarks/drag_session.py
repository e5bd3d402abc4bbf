"""Live drags of hulls: what a step costs beside the bare update and its taking back.

Both do the same to the same hull in turns, at random points and by random amounts; the bare one is
the edit through the engine with nothing read of it. Processor time; medians of the ratios.
"""

from __future__ import annotations

from collections.abc import Callable
from time import process_time

import numpy as np

import assoc_hull as ah
from assoc_hull.edit.drag import Drag
from assoc_hull.edit.session import Edit
from assoc_hull.errors import AssocHullError
from assoc_hull.model.address import address
from benchmarks.clock import Figure

__all__ = ["figures"]

HULLS: dict[str, Callable[[], ah.Hull]] = {
    "Wigley": ah.examples.wigley,
    "Series 60": lambda: ah.examples.series60(0.70),
    "container ship": ah.examples.container_ship_225m,
}
POINTS, QUICK = 40, 8
STEPS = 5
GOAL = 1.15
"""A step may cost so many times the bare update that it shows (contract of the live drag)."""


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    found: list[Figure] = []
    for name, make in HULLS.items():
        hull = make()
        for how in ("pull", "move"):
            steps, bare = _measured(hull, how, QUICK if quick else POINTS)
            ratio = float(np.median(steps / bare))
            found += [
                Figure(f"{name}, {how}: step over bare update", ratio, "x", GOAL, "most"),
                Figure(f"{name}, {how}: a step", 1e3 * float(np.median(steps)), "ms"),
            ]
    return found


def _measured(
    hull: ah.Hull, how: str, points: int
) -> tuple[np.typing.NDArray[np.float64], np.typing.NDArray[np.float64]]:
    """Give the times of steps and of bare updates, pair by pair, s."""
    draw = np.random.default_rng(len(how))
    rows = hull.state.live("rows")
    steps, bare = list[float](), list[float]()
    while len(steps) < points * STEPS:
        point = address(hull.state, int(draw.choice(rows)))
        with hull.drag(point, how) as drag:  # type: ignore[arg-type]
            if how == "move" and not drag.free:
                continue
            for number in range(STEPS + 1):
                asked = _asked(drag, how, float(draw.uniform(0.002, 0.02)))
                begin = process_time()
                live = drag.to(**asked)
                middle = process_time()
                _update(hull, point, how, asked)
                end = process_time()
                # The first step of a drag makes what all of them read.
                if number and not live.refused:
                    steps.append(middle - begin)
                    bare.append(end - middle)
    return np.array(steps), np.array(bare)


def _asked(drag: Drag, how: str, size: float) -> dict[str, float]:
    if how == "pull":
        return {"d": size}
    return {axis: float(drag.start["xyz".index(axis)]) + size for axis in drag.free}


def _update(hull: ah.Hull, point: str, how: str, asked: dict[str, float]) -> None:
    """Carry out the edit on the engine, and take it back."""
    edit = Edit(hull.document, "bare", look=lambda step: None)
    try:
        with edit:
            if how == "pull":
                edit.pull(point, asked["d"])
            else:
                edit.move(point, lead=False, **asked)
    except AssocHullError:
        pass

"""Moves, pulls, drags and previews of ships, by the program of the net and the full way.

The figures of what was there before the program stand beside them, as they were measured then on
another day of the same machine; the full way of today runs in turns with the program.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from unittest import mock

import attrs

import assoc_hull as ah
from assoc_hull.edit.program_edit import ProgramEdit
from assoc_hull.model.program.engine import is_compiled, wait_for_engine
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures"]

SHIPS: Mapping[str, tuple[Callable[[], ah.Hull], str]] = {
    "Series 60": (ah.examples.series60, "WL 1.08 x ST 4"),
    "carrier": (ah.examples.bulk_carrier_207k, "WL 9 x ST 4"),
}
BEFORE = {
    ("Series 60", "move"): 8.2, ("Series 60", "pull"): 23.2, ("Series 60", "preview"): 298.0,
    ("carrier", "move"): 6.7, ("carrier", "pull"): 26.8, ("carrier", "preview"): 348.0,
}  # fmt: skip
"""Milliseconds of a commit before the program."""

GOALS = {"move": 0.25, "pull": 0.5, "preview": 65.0}
"""Milliseconds."""

_SELDOM = 25
"""Asked so often, the program is compiled."""


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    for _ in range(_SELDOM):
        is_compiled()
    wait_for_engine()
    found = list[Figure]()
    for name, (make, point) in SHIPS.items():
        found += _of_ship(name, make(), point, 3 if quick else 9)
    return [attrs.evolve(each, name=f"edits: {each.name}") for each in found]


def _of_ship(ship: str, hull: ah.Hull, point: str, rounds: int) -> list[Figure]:
    jobs = _jobs(hull, point)
    for _ in range(5):  # a program serves after a few edits that kept the structure
        jobs["move"]()
    every: dict[str, Callable[[], object]] = dict(jobs)
    every |= {f"{name}, the full way": _without(jobs[name]) for name in ("move", "pull")}
    times = side_by_side(every, rounds, dict.fromkeys(every, 8) | {"preview": 1})
    found = list[Figure]()
    for name, seconds in times.items():
        taken, goal = 1e3 * seconds, GOALS.get(name)
        found.append(Figure(f"{ship}, {name}", taken, "ms", goal, "most"))
    found += [
        Figure(f"{ship}, {name}: before / now", BEFORE[ship, name] / (1e3 * times[name]))
        for name in ("move", "pull", "preview")
    ]
    return found


def _jobs(hull: ah.Hull, point: str) -> dict[str, Callable[[], object]]:
    """Edits to and fro, of which a history of hundreds is let go."""
    place, turn = hull.points[point].y, iter(range(10**9))

    def move() -> None:
        with hull.edit("move") as edit:
            edit.move(point, y=place + 1e-3 * (next(turn) % 3))

    def pull() -> None:
        with hull.edit("pull") as edit:
            edit.pull(point, 4e-3 * (-1) ** next(turn), (20.0, 8.0))

    def preview() -> None:
        hull.preview([{"op": "pull", "point": point, "d": 0.02, "radius": [20.0, 8.0]}])

    drag, begun = hull.drag(point, radius=(20.0, 8.0)), hull.state_number

    def step() -> None:
        nonlocal drag, begun
        if hull.state_number != begun:  # an edit came between: a drag stands on one state
            drag, begun = hull.drag(point, radius=(20.0, 8.0)), hull.state_number
        drag.to(d=1e-3 * (1 + next(turn) % 5))

    return {"move": move, "pull": pull, "preview": preview, "step of a drag": step}


def _without(job: Callable[[], object]) -> Callable[[], object]:
    """Give a job that takes no program."""

    def run() -> object:
        with mock.patch.object(ProgramEdit, "of", return_value=None):
            return job()

    return run

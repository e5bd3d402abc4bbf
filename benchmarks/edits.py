"""Moves, pulls, drags, previews and commits of ships, by the program of the net and the full way.

Hot is the same gesture again and again; cold is in turns with hydrostatics of the same hull, which
leave little of it in the caches. The figures of before the program stand beside, as they were
measured then, on another day of the same machine; the full way of
today runs in turns with the program. In numpy alone a child process measures.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from time import process_time
from unittest import mock

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.edit.program_edit import ProgramEdit
from assoc_hull.model.program.engine import is_compiled, wait_for_engine
from benchmarks.clock import Figure, side_by_side
from benchmarks.copies import copies_of

__all__ = ["figures"]


@attrs.frozen
class Ship:
    """A ship with a point to be moved and pulled, and a move that a gap has to be mended for."""

    make: Callable[[], ah.Hull]
    point: str
    mended: str
    away: float


SHIPS: Mapping[str, Ship] = {
    "Series 60": Ship(ah.examples.series60, "WL 1.08 x ST 4", "WL 0.35 x ST 14.5", -0.0472),
    "carrier": Ship(ah.examples.bulk_carrier_207k, "WL 9 x ST 4", "WL 0.5 x ST 2", 0.0503),
}
RADIUS = (20.0, 8.0)
BEFORE = {
    "move": {"Series 60": 8.2, "carrier": 6.7},
    "pull": {"Series 60": 23.2, "carrier": 26.8},
    "preview": {"Series 60": 298.0, "carrier": 348.0},
    "preview, about": {"Series 60": 298.0, "carrier": 348.0},
    "commit of a move, on top": {"Series 60": 6.0, "carrier": 9.0},
    "commit of a pull, on top": {"Series 60": 18.0, "carrier": 26.0},
    "move with mending": {"Series 60": 100.0, "carrier": 100.0},
}
"""Milliseconds before the program; of commits and mending the least that was met."""

GOALS = {
    "move": (0.25, 0.5), "pull": (0.5, 0.9), "preview, about": (0.7, 1.2), "preview": (65.0, 65.0),
    "step of a drag": (0.25, 0.5), "commit of a move, on top": (0.8, None),
    "commit of a pull, on top": (0.8, None), "move with mending": (20.0, None),
}  # fmt: skip
"""Milliseconds, hot and cold."""

NUMPY_GOALS = {"move": 2.5, "pull": 5.0, "preview, about": 6.0, "preview": 65.0}
_SELDOM = 25
"""Asked so often, the program is compiled."""


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    _compile()
    rounds, found = 3 if quick else 9, list[Figure]()
    for name, ship in SHIPS.items():
        found += _of_ship(name, ship, rounds)
    found += _in_numpy(rounds)
    found += _among_copies((1, 16) if quick else (1, 16, 100))
    return [attrs.evolve(each, name=f"edits: {each.name}") for each in found]


def _compile() -> None:
    for _ in range(_SELDOM):
        is_compiled()
    wait_for_engine()


def _of_ship(name: str, ship: Ship, rounds: int) -> list[Figure]:
    hull = ship.make()
    jobs = _jobs(hull, ship)
    for _ in range(5):  # a program serves after a few edits that kept the structure
        jobs["move"]()
    # Mending changes the structure, and the next edits go the full way: it has its own turns.
    mending = {"move with mending": jobs.pop("move with mending")}
    hot: dict[str, Callable[[], object]] = dict(jobs)
    hot |= {f"{each}, the full way": _without(jobs[each]) for each in ("move", "pull")}
    times = side_by_side(hot, rounds, dict.fromkeys(hot, 8) | {"preview": 1})
    cold = _cold(hull, jobs, rounds)
    times |= side_by_side(mending, rounds, dict.fromkeys(mending, 8))
    found = [_figure(f"{name}, {each}", each, seconds, 0) for each, seconds in times.items()]
    found += [_figure(f"{name}, {each}, cold", each, seconds, 1) for each, seconds in cold.items()]
    times |= _commits(ship, rounds)
    late = ("commit of a move, on top", "commit of a pull, on top")
    found += [_figure(f"{name}, {each}", each, times[each], 0) for each in late]
    found += [
        Figure(f"{name}, {each}: before / now", before[name] / (1e3 * times[each]))
        for each, before in BEFORE.items()
    ]
    return found


def _figure(name: str, job: str, seconds: float, cold: int) -> Figure:
    goal = GOALS.get(job, (None, None))[cold]
    return Figure(name, 1e3 * seconds, "ms", goal, "most")


def _cold(hull: ah.Hull, jobs: Mapping[str, Callable[[], object]], rounds: int) -> dict[str, float]:
    """Measure each job right after hydrostatics of the hull at some draught."""
    names, draught = ("move", "pull", "step of a drag", "preview, about"), hull.particulars.draught
    times: dict[str, list[float]] = {name: [] for name in names}
    for number in range(3 * rounds):
        for name in names:
            if name == "step of a drag":
                jobs[name]()  # an edit came between: it begins another drag
            hull.hydrostatics(draught=draught * (1.0 - 1e-4 * (number + 1)))
            begin = process_time()
            jobs[name]()
            times[name].append(process_time() - begin)
    return {name: float(np.median(taken)) for name, taken in times.items()}


def _jobs(hull: ah.Hull, ship: Ship) -> dict[str, Callable[[], object]]:
    """Edits to and fro; the mending one is taken back, and that is not counted."""
    point, turn = ship.point, iter(range(10**9))
    place, mended = hull.points[point].y, hull.points[ship.mended].y
    asked = [{"op": "pull", "point": point, "d": 0.02, "radius": list(RADIUS)}]

    def move() -> None:
        with hull.edit("move") as edit:
            edit.move(point, y=place + 1e-3 * (next(turn) % 3))

    def pull() -> None:
        with hull.edit("pull") as edit:
            edit.pull(point, 4e-3 * (-1) ** next(turn), RADIUS)

    drag, begun = hull.drag(point, radius=RADIUS), hull.state_number

    def step() -> None:
        nonlocal drag, begun
        if hull.state_number != begun:  # an edit came between: a drag stands on one state
            drag, begun = hull.drag(point, radius=RADIUS), hull.state_number
        drag.to(d=1e-3 * (1 + next(turn) % 5))

    def mend() -> None:
        with hull.edit("move") as edit:
            edit.move(ship.mended, y=mended + ship.away)
        assert edit.report is not None
        assert edit.report.mended
        hull.undo()

    return {
        "move": move, "pull": pull, "step of a drag": step,
        "preview": lambda: hull.preview(asked).volume_change,
        "preview, about": lambda: hull.preview(asked, measure="about").volume_change,
        "move with mending": mend,
    }  # fmt: skip


def _without(job: Callable[[], object]) -> Callable[[], object]:
    """Give a job that takes no program."""

    def run() -> object:
        with mock.patch.object(ProgramEdit, "of", return_value=None):
            return job()

    return run


def _commits(ship: Ship, rounds: int) -> dict[str, float]:
    """Measure edits of a saved hull beside the same in memory; processor time counts no waits."""
    with tempfile.TemporaryDirectory() as folder:
        saved, plain = ship.make(), ship.make()
        saved.save(Path(folder) / "ship.hull")
        jobs: dict[str, Callable[[], object]] = {}
        for where, hull in (("saved", saved), ("plain", plain)):
            mine = _jobs(hull, ship)
            jobs |= {f"{each} {where}": mine[each] for each in ("move", "pull")}
            for _ in range(5):
                mine["move"]()
        times = side_by_side(jobs, rounds, dict.fromkeys(jobs, 8))
    return {
        f"commit of a {each}, on top": times[f"{each} saved"] - times[f"{each} plain"]
        for each in ("move", "pull")
    }


def _in_numpy(rounds: int) -> list[Figure]:
    """Let a process without numba measure."""
    told = subprocess.run(
        [sys.executable, "-c", _CHILD, str(rounds)],
        env={**os.environ, "ASSOC_HULL_FAST": "0"}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    found = list[Figure]()
    for name, times in json.loads(told.stdout.splitlines()[-1]).items():
        found += [
            Figure(f"{name}, {each}, numpy alone", 1e3 * times[each], "ms", goal, "most")
            for each, goal in NUMPY_GOALS.items()
        ]
    return found


_CHILD = """
import json, sys
from benchmarks.edits import times_in_numpy
print(json.dumps(times_in_numpy(int(sys.argv[1]))))
"""


def times_in_numpy(rounds: int) -> dict[str, dict[str, float]]:
    """Give the times of each ship's jobs, s, as this process has them."""
    _compile()
    found = {}
    for name, ship in SHIPS.items():
        hull = ship.make()
        jobs = _jobs(hull, ship)
        for _ in range(5):
            jobs["move"]()
        chosen = {each: jobs[each] for each in NUMPY_GOALS}
        found[name] = side_by_side(chosen, rounds, dict.fromkeys(chosen, 8) | {"preview": 1})
    return found


def _among_copies(counts: tuple[int, ...]) -> list[Figure]:
    """Edit one net in a hull that holds it many times, and alone."""
    base, times = ah.examples.series60(), dict[int, dict[str, float]]()
    with tempfile.TemporaryDirectory() as folder:
        for count in counts:
            hull = base if count == 1 else ah.Hull(copies_of(base.state, count))
            times[count] = _times_among(hull, base.points[SHIPS["Series 60"].point])
            # Without the edits made by now, which would all be written.
            file = ah.Hull(hull.document.state.snapshot())
            file.save(Path(folder) / f"{count}.hull")
            saved = _times_among(file, base.points[SHIPS["Series 60"].point])
            times[count] |= {f"{each} of a saved hull": saved[each] for each in _SAVED}
    return [
        Figure(f"{name} among {count} copies / alone", taken / times[1][name], goal=1.2,
               sense="most")
        for count in counts[1:] for name, taken in times[count].items()
    ]  # fmt: skip


def _times_among(hull: ah.Hull, point: ah.Point) -> dict[str, float]:
    """Give the times of edits, s, of the point that lies where another one does."""
    away = np.abs(hull.state.rows.xyz.data - np.array([point.x, point.y, point.z])).sum(axis=1)
    name, turn = str(hull.state.rows.key[int(np.argmin(away))]), iter(range(10**9))
    place = float(point.y)

    def move() -> None:
        with hull.edit("move") as edit:
            edit.move(name, y=place + 1e-3 * (next(turn) % 3))

    def pull() -> None:
        with hull.edit("pull") as edit:
            edit.pull(name, 4e-3 * (-1) ** next(turn), RADIUS)

    def preview() -> None:
        asked = [{"op": "pull", "point": name, "d": 0.02, "radius": list(RADIUS)}]
        hull.preview(asked, measure=False)

    def undo() -> None:
        hull.undo()
        hull.redo()

    def gesture() -> None:
        with hull.drag(name, radius=RADIUS) as drag:
            for part in range(1, 4):
                drag.to(1e-3 * part * (-1) ** next(turn))
            drag.commit("drag")

    drag, begun = hull.drag(name, radius=RADIUS), hull.state_number

    def step() -> None:
        nonlocal drag, begun
        if hull.state_number != begun:
            drag, begun = hull.drag(name, radius=RADIUS), hull.state_number
            drag.to(d=1e-3)
        drag.to(d=1e-3 * (1 + next(turn) % 5))

    for _ in range(8):
        move()
    jobs = {"move": move, "pull": pull, "preview": preview, "undo and redo": undo,
            "drag of three steps and its commit": gesture}  # fmt: skip
    times = side_by_side(jobs, 5, dict.fromkeys(jobs, 8))
    # By itself: whoever holds a drag open lets the next edit copy what it looks at.
    step()
    return times | side_by_side({"step of a drag": step}, 5, {"step of a drag": 8})


_SAVED = ("move", "pull", "undo and redo", "drag of three steps and its commit")

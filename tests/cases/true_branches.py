"""The true branches of the hull with a bulb: where a moving plane meets its lines, and since when.

A plane that moves meets a fixed line where the line has the plane's coordinate. So the
branches are the stretches of the line on which that coordinate rises or falls; where it
turns, two of them meet, and that is where a pair is born or dies. The lines are traced from
the function of the hull, in steps of 1 cm, of 0.1 mm where they turn. The kernel is not asked.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise

import attrs
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from tests.cases.bulb import (
    ALONG,
    DEPTH,
    UP,
    Floats,
    breadth_at,
    contour,
    girth,
    gradient,
    onto,
    outline,
    pieces,
)

__all__ = ["Branch", "branches_of", "neck", "on_ring"]

COARSE, FINE = 0.01, 1e-4

Project = Callable[[Floats], Floats]


@attrs.frozen(eq=False)
class Branch:
    """A stretch of a line on which the coordinate of a moving plane rises or falls.

    Attributes
    ----------
    name : str
        The line, and the number of the stretch along it.
    number : int
        That number.
    at : (n,), m
        The coordinate, ascending.
    place : (n, 3), m
        The points.
    """

    name: str
    number: int
    at: Floats
    place: Floats

    @property
    def low(self) -> float:
        """The plane that is the first to meet it."""
        return float(self.at[0])

    @property
    def high(self) -> float:
        """The plane that is the last to meet it."""
        return float(self.at[-1])

    def where(self, plane: float) -> Floats:
        """Give the place at which a plane meets it, or its end nearest to the plane."""
        return np.array([np.interp(plane, self.at, part) for part in self.place.T])


def branches_of(group: str, position: float, name: str, axis: int) -> list[Branch]:
    """Give the branches of a line for planes across an axis (1: buttocks, 2: waterlines)."""
    found: list[Branch] = []
    for line, project, lift in _traced(group, position, name):
        points = _refined(line, project, lift, axis)
        for part in _monotone(points[:, axis]):
            stretch = points[part]
            if stretch[-1, axis] < stretch[0, axis]:
                stretch = stretch[::-1]
            number = len(found) + 1
            found.append(Branch(f"{name} #{number}", number, stretch[:, axis].copy(), stretch))
    return found


def _slope(at: Floats) -> Floats:
    found: Floats = gradient(breadth_at, at[None])[0]
    return found


def neck() -> float:
    """Give the breadth (m) at which a buttock falls in two: that of the saddle of the neck."""
    found = root(_slope, np.array([86.0, 2.7]), tol=1e-12)
    assert found.success
    return float(breadth_at(found.x[:1], found.x[1:])[0])


def on_ring(breadth: float, places: Floats) -> NDArray[np.bool_]:
    """Tell which places (n, 3) of a buttock are on the ring round the bulb, not on the rest."""
    rest = contour(breadth)
    step = places[:, None, ::2] - rest[None]
    near = np.hypot(step[:, :, 0], step[:, :, 1]).min(axis=1)
    return np.asarray(near > 0.06)


def _lift(at: Floats) -> Floats:
    return np.column_stack([at[:, 0], breadth_at(at[:, 0], at[:, 1]), at[:, 1]])


def _flat(at: Floats, breadth: float = 0.0) -> Floats:
    return np.column_stack([at[:, 0], 0.0 * at[:, 0] + breadth, at[:, 1]])


def _traced(group: str, position: float, name: str) -> list[tuple[Floats, Project, Project]]:
    """Give the pieces of a line in the centre plane, how to stay on it, and its points."""
    if name == "profile":
        post = np.column_stack([0.0 * UP, UP])
        return [(post, _same, _flat), (contour(0.0), partial(onto, 0.0), _flat)]
    if group == "buttocks":
        return [(contour(position), partial(onto, position), partial(_flat, breadth=position))]
    upright = group == "sections"
    still = DEPTH if name == "deck edge" else position
    found: list[tuple[Floats, Project, Project]] = []
    for part in pieces(girth(still), UP) if upright else pieces(outline(still), ALONG):
        s = np.linspace(part[0], part[-1], int(np.ceil((part[-1] - part[0]) / COARSE)) + 1)
        line = np.column_stack([0.0 * s + still, s] if upright else [s, 0.0 * s + still])
        found.append((line, _same, _lift))
    return found


def _same(at: Floats) -> Floats:
    return at


def _refined(line: Floats, project: Project, lift: Project, axis: int) -> Floats:
    """Trace a line again in fine steps where the coordinate turns."""
    away = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    points = lift(line)
    step = np.diff(points[:, axis])
    turn = np.flatnonzero(step[:-1] * step[1:] < 0.0) + 1
    more = [np.arange(away[i - 1], away[i + 1], FINE) for i in turn.tolist()]
    if not more:
        return points
    every = np.unique(np.concatenate([away, *more]))
    every = every[np.concatenate([[True], np.diff(every) > 0.5 * FINE])]
    between = np.column_stack([np.interp(every, away, part) for part in line.T])
    return lift(project(between))


def _monotone(value: Floats) -> list[slice]:
    """Give the stretches over which values rise or fall, each with both its ends."""
    step = np.diff(value)
    turn = (np.flatnonzero(step[:-1] * step[1:] < 0.0) + 1).tolist()
    ends = [0, *turn, len(value) - 1]
    return [slice(a, b + 1) for a, b in pairwise(ends)]

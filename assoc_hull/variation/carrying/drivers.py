"""Which planes of a net a map keeps, and which lines therefore drive.

A line whose plane is kept has an image that lies in a plane again, so it can be carried
exactly. One whose plane would bend is better cut again: a designer's sections stay plane.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.mapped_planes import PLANE, most_in_one
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.model.state import HullState

__all__ = ["Driving", "Keeps", "default_drivers", "driving", "keeps", "planes_go"]

_SAMPLES = 4
"""Places a segment at which a map is asked."""


@attrs.frozen(eq=False)
class Keeps:
    """What becomes of lines in planes x, y and z = const under a map, by number and axis.

    Attributes
    ----------
    plane : (l, 3) bool
        Whether they come to lie in such planes again.
    place : (l, 3) bool
        Whether they stay in their planes.
    """

    plane: np.typing.NDArray[np.bool_]
    place: np.typing.NDArray[np.bool_]


@attrs.frozen(eq=False)
class Driving:
    """Which lines carry a hull under a map.

    Attributes
    ----------
    lines : tuple of int
        Their numbers; boundary curves drive besides.
    follow : bool
        Whether planes of waterlines and buttocks go along.
    keeps : Keeps
        Which planes the map keeps.
    """

    lines: tuple[int, ...]
    follow: bool
    keeps: Keeps


def driving(
    state: HullState, space: SpaceMap, given: Sequence[int] | None, stations: str, *, follow: bool
) -> Driving:
    """Choose the lines that carry a hull.

    Parameters
    ----------
    state : HullState
        The tables.
    space : SpaceMap
        The map.
    given : sequence of int or None
        Lines that drive; None for all whose planes the map keeps.
    stations : {"number", "x"}
        Whether sections may go with the map.
    follow : bool
        Whether waterlines and buttocks may, if the map sends them to parallel planes.

    Raises
    ------
    BadInputError
        Nothing can drive.
    """
    kept, goes = keeps(state, space), follow and planes_go(state, space)
    if given is not None:
        return Driving(tuple(sorted(given)), goes, kept)
    return Driving(default_drivers(state, kept, stations, follow=goes), goes, kept)


def keeps(state: HullState, space: SpaceMap) -> Keeps:
    """Find which planes a map keeps on the lines of a net, line by line.

    Parameters
    ----------
    state : HullState
        The tables.
    space : SpaceMap
        The map.

    Returns
    -------
    Keeps
        Nil along lines that are not alive, and for axes that are not theirs.
    """
    curves = state.live("curves")
    start, xyz = sample(SplineBatch.join([state.spline(c) for c in curves.tolist()]), _SAMPLES)
    line = np.repeat(state.curves.line.data[curves], np.diff(start))
    slope, image = space.jacobians(xyz), space.places(xyz)
    moved = np.abs(image - xyz) > PLANE
    bent, gone = np.zeros((state.lines.count, 3), bool), np.zeros((state.lines.count, 3), bool)
    for axis in range(3):
        others = [each for each in range(3) if each != axis]
        np.logical_or.at(bent[:, axis], line, (slope[:, axis, others] != 0.0).any(axis=1))
        np.logical_or.at(gone[:, axis], line, moved[:, axis])
        bent[:, axis] |= _spread(line, image[:, axis], state.lines.count) > PLANE
    return Keeps(~bent, ~gone)


def _spread(line: IntArray, level: FloatArray, count: int) -> FloatArray:
    """Give how far apart places of each line lie along an axis, (l,), m; nil without places.

    A circle drawn anew moves its own points by less than a slope tells.
    """
    low, high = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(low, line, level)
    np.maximum.at(high, line, level)
    found: FloatArray = np.maximum(high - low, 0.0)
    return found


def planes_go(state: HullState, space: SpaceMap) -> bool:
    """Tell whether a map sends at least half of each waterline and buttock to a parallel plane.

    If some went and others stayed, lines of one sort could pass each other.
    """
    for line in state.live("lines").tolist():
        axis = state.family(line).axis
        if axis is None or axis == 0 or state.lines.boundary.data[line] >= 0:
            continue
        splines = [state.spline(curve) for curve in state.lines.curves.data[line]]
        xyz = space.places(sample(SplineBatch.join(splines), _SAMPLES)[1])
        if not most_in_one(np.sort(xyz[:, axis])):
            return False
    return True


def default_drivers(
    state: HullState, kept: Keeps, stations: str, *, follow: bool
) -> tuple[int, ...]:
    """Give the lines whose planes are kept, and stay or may go.

    Parameters
    ----------
    state : HullState
        The tables.
    kept : Keeps
        What the map keeps.
    stations : {"number", "x"}
        Whether sections may go with the map.
    follow : bool
        Whether waterlines and buttocks may.

    Raises
    ------
    BadInputError
        No family of lines is left to drive.
    """
    chosen = list[int]()
    for line in state.live("lines").tolist():
        axis = state.family(line).axis
        if axis is None or state.lines.boundary.data[line] >= 0:
            continue
        may = stations == "number" if axis == 0 else follow
        if kept.plane[line, axis] and (may or kept.place[line, axis]):
            chosen.append(line)
    if not chosen:
        raise BadInputError(
            "the map bends the planes of all lines", "in vary",
            "vary in two steps, or name the drivers that may become curves in space",
        )  # fmt: skip
    return tuple(chosen)

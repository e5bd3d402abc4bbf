"""Which planes of a net a map keeps, and which lines therefore drive.

A line whose plane is kept has an image that lies in a plane again, so it can be carried
exactly. One whose plane would bend is better cut again: a designer's sections stay plane.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.mapping import SpaceMap
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.spline import sample
from assoc_hull.model.state import HullState

__all__ = ["Keeps", "default_drivers", "keeps"]

_SAMPLES = 4
"""Places a segment at which a map is asked."""

_AXES = {"sections": 0, "frames": 0, "buttocks": 1, "waterlines": 2}


@attrs.frozen
class Keeps:
    """What becomes of planes x, y and z = const under a map.

    Attributes
    ----------
    plane : (bool, bool, bool)
        Whether they come to be such planes again.
    place : (bool, bool, bool)
        Whether they stay where they are.
    """

    plane: tuple[bool, bool, bool]
    place: tuple[bool, bool, bool]


def keeps(state: HullState, space: SpaceMap) -> Keeps:
    """Find which planes a map keeps on the lines of a net."""
    xyz = _places(state)
    slope, moved = space.jacobians(xyz), space.places(xyz) != xyz
    plane, place = list[bool](), list[bool]()
    for axis in range(3):
        others = [each for each in range(3) if each != axis]
        plane.append(not slope[:, axis, others].any())
        place.append(not moved[:, axis].any())
    return Keeps((plane[0], plane[1], plane[2]), (place[0], place[1], place[2]))


def _places(state: HullState) -> FloatArray:
    curves = state.live("curves").tolist()
    return np.array(sample(SplineBatch.join([state.spline(c) for c in curves]), _SAMPLES)[1])


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
        axis = _AXES.get(state.family(line).name)
        if axis is None or state.lines.boundary.data[line] >= 0:
            continue
        may = stations == "number" if axis == 0 else follow
        if kept.plane[axis] and (may or kept.place[axis]):
            chosen.append(line)
    if not chosen:
        raise BadInputError(
            "the map bends the planes of all lines", "in vary",
            "vary in two steps, or name the drivers that may become curves in space",
        )  # fmt: skip
    return tuple(chosen)

"""The points of a frame in order: from the bottom past waterlines and knuckles to the deck side.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.frame_points import runs_of
>>> water, knuckle = np.array([[5.0, 1.0], [7.0, 6.0]]), np.array([[6.0, 3.0]])
>>> runs = runs_of(np.zeros(2), water, knuckle, np.array([7.5, 8.0]), "frame x=20")
>>> [each.points[:, 1].tolist() for each in runs]
[[0.0, 1.0, 3.0], [3.0, 6.0, 8.0]]
"""

from __future__ import annotations

import itertools

import attrs
import numpy as np

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["MOST_RATIO", "Run", "runs_of", "spacing_notes"]

MOST_RATIO = 4.0
"""Beyond this ratio of neighbouring spacings of waterlines a frame bends badly."""

_SAME = 1e-9
"""Points (m) that differ by less are one."""


@attrs.frozen(eq=False)
class Run:
    """Points (n, 2), m, from one end or knuckle to the next, upward."""

    points: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.points)


def runs_of(
    first: FloatArray, water: FloatArray, knuckles: FloatArray, top: FloatArray, name: str
) -> tuple[Run, ...]:
    """Put points in order and part them at knuckles.

    Parameters
    ----------
    first, top : (2,), m
        The lowest point, and the deck side.
    water, knuckles : (n, 2), (k, 2), m
        Points (y, z) of waterlines and knuckle lines; only those above the first and below the
        deck side count, and of knuckles also those level with either.
    name : str
        What the frame is called in messages.

    Raises
    ------
    GeometryError
        ``"{name}: fewer than 2 points on the section"``, ``"{name}: section points not increasing
        in z at {z}"``: two points at one height that are not both knuckle, edge of the flat or
        deck side.
    """
    water = water[(water[:, 1] > first[1] + _SAME) & (water[:, 1] < top[1] - _SAME)]
    inner = (knuckles[:, 1] >= first[1] - _SAME) & (knuckles[:, 1] <= top[1] + _SAME)
    corners = np.concatenate([first[None], knuckles[inner], top[None]])
    corners = corners[_distinct(corners)]
    water = water[[not _near(corners, each) for each in water]] if len(water) else water
    points = np.concatenate([corners, water])
    corner = np.arange(len(points)) < len(corners)
    # The first and the last stay where they are among points of one height.
    rank = np.where(corner, np.arange(len(points)), 0.5)
    order = np.lexsort([rank, points[:, 1]])
    points, corner = points[order], corner[order]
    if len(points) < 2 or top[1] < first[1] - _SAME:
        what = f"{name}: fewer than 2 points on the section"
        raise GeometryError(what, "let lines reach it above its keel", {"points": len(points)})
    level = np.diff(points[:, 1]) <= _SAME
    bad = np.flatnonzero(level & ~(corner[1:] & corner[:-1]))
    if len(bad):
        z = float(points[bad[0] + 1, 1])
        what = f"{name}: section points not increasing in z at {figure(z)}"
        raise GeometryError(what, "leave one of the two lines out there", {"z": z})
    ends = np.flatnonzero(corner)
    return tuple(Run(points[a : b + 1].copy()) for a, b in itertools.pairwise(ends))


def _distinct(points: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Tell which points are none of those before them."""
    return np.array([not _near(points[:i], each) for i, each in enumerate(points)], bool)


def _near(points: FloatArray, place: FloatArray) -> bool:
    return bool((np.abs(points - place).max(axis=1, initial=0.0) <= _SAME).any())


def spacing_notes(
    water: FloatArray, first: FloatArray, top: FloatArray, name: str
) -> tuple[str, ...]:
    """Tell of neighbouring waterlines whose spacings differ too much.

    Between the first point and the deck side; ``"{name}: waterline spacing ratio {r} exceeds 4"``.
    """
    inner = np.unique(water[(water[:, 1] > first[1]) & (water[:, 1] < top[1]), 1])
    gap = np.diff(inner)
    if len(gap) < 2:
        return ()
    ratio = np.maximum(gap[1:] / gap[:-1], gap[:-1] / gap[1:])
    worst = int(ratio.argmax())
    if ratio[worst] <= MOST_RATIO:
        return ()
    return (
        f"{name}: waterline spacing ratio {figure(ratio[worst])} exceeds {figure(MOST_RATIO)} at "
        f"z={figure(inner[worst + 1])}",
    )

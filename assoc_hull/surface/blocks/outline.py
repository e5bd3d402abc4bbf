"""The outline of a half hull, and where it bends: round corners of a part, or into the ship.

A neck between bulb and stem, or an aperture, is no corner on paper: it has a radius. What counts is
by how much the outline turns over a stretch that is short beside the ship.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.surface.blocks.region import Region

__all__ = ["Bend", "Course", "bends_inward", "course", "turns"]

WINDOW = 0.012
"""Over this part of the ship's length the turn of the profile is taken."""
LEAST = 60.0
"""From so many degrees on it is a corner: the radius is below 1.2 % of the length."""
_STEPS = 16
_AWAY = 0.3
"""What turns about an axis this far against the normal turns outward; less is undecided."""


@attrs.frozen(eq=False)
class Course:
    """Places round the border of a region.

    Attributes
    ----------
    node : (k,) int
        The node at which each half-edge of the border begins.
    start : (k + 1,), m
        How far round the border these are, and the whole length.
    along : (p,), m
        How far places are, rising.
    place : (p, 3), m
        The places.
    centre : (p,) bool
        Which lie on the centreline of the hull.
    """

    node: IntArray
    start: FloatArray
    along: FloatArray
    place: FloatArray
    centre: np.typing.NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.node, self.start, self.along, self.place, self.centre)

    @property
    def length(self) -> float:
        """The whole length, m."""
        return float(self.start[-1])

    def at(self, along: FloatArray) -> FloatArray:
        """Give places so far round the border, (k, 3), m; it closes."""
        turned = np.mod(along, self.length)
        return np.stack([np.interp(turned, self.along, c) for c in self.place.T], axis=-1)


@attrs.frozen
class Bend:
    """A place where the profile bends into the ship.

    Attributes
    ----------
    along : float, m
        How far round the outline.
    turn : float, degrees
        By how much it turns over the window.
    place : (float, float, float), m
        Where.
    """

    along: float
    turn: float
    place: tuple[float, float, float]


def course(region: Region) -> Course:
    """Give places round a region, sixteen an edge."""
    loop = region.loop
    place = region.path(loop, _STEPS)
    step = np.diff(place, axis=0)
    along = np.append(0.0, np.cumsum(np.sqrt(dot(step, step))))
    on = region.graph.net.centre[region.graph.curve[loop >> 1]]
    centre = np.append(on.repeat(_STEPS), on[-1])
    return Course(region.begin(loop), along[::_STEPS].copy(), along, place, centre)


def turns(
    found: Course, along: FloatArray, window: float, normal: FloatArray | None = None
) -> FloatArray:
    """Give by how much a border turns at places, (k,), degrees.

    Parameters
    ----------
    found : Course
        The border.
    along : (k,), m
        How far round it.
    window : float, m
        Chords of half of it, before and behind, are compared.
    normal : (k, 3), optional
        Outward normals: where the border turns away from what it goes round, it counts as nil.
    """
    here = found.at(along)
    before, behind = here - found.at(along - 0.5 * window), found.at(along + 0.5 * window) - here
    sine = np.cross(before, behind)
    size = np.sqrt(dot(sine, sine))
    angle: FloatArray = np.degrees(np.arctan2(size, dot(before, behind)))
    if normal is not None:
        angle = np.where(dot(sine, normal) < -_AWAY * size, 0.0, angle)
    return angle


def bends_inward(found: Course, length: float, least: float = LEAST) -> tuple[Bend, ...]:
    """Find where the profile bends into the ship, round the outline.

    Parameters
    ----------
    found : Course
        The outline of the half hull: the deck forward, the keel aft.
    length : float, m
        Of the ship.
    least : float, degrees
        What counts.
    """
    half = 0.5 * WINDOW * length
    along = np.arange(0.0, found.length, 0.05 * half)
    index = np.searchsorted(found.along, along, side="right") - 1
    centre = found.centre[np.clip(index, 0, len(found.centre) - 1)]
    tip = 0.2 * half
    ends = [found.at(along + x) for x in (-half - tip, -half, half, half + tip)]
    before, behind = ends[1] - ends[0], ends[3] - ends[2]
    # The outline runs clockwise in the side view: what turns to the left bends into the ship.
    sine = before[:, 0] * behind[:, 2] - before[:, 2] * behind[:, 0]
    turn = np.degrees(np.arctan2(sine, dot(before, behind)))
    flat = np.maximum.reduce([np.abs(each[:, 1]) for each in ends]) <= 1e-4 * length
    good = centre & flat & (turn >= least)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(np.int8)))
    bends = []
    for low, high in edges.reshape(-1, 2).tolist():
        best = turn[low:high]
        at = float(along[low:high][best >= best.max() - 1.0].mean())
        x, y, z = found.at(np.array([at]))[0].tolist()
        bends.append(Bend(at, float(best.max()), (x, y, z)))
    return tuple(bends)

"""The bilge of a section: where the bottom ends and the side begins, and how round it is."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.circle_fit import Circle, fit_circle
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.geometry.splines.plane_places import places_on
from assoc_hull.variation.parameters.drawn_curves import Drawn

__all__ = ["Bilge", "bilge_of"]

_ROUND = 1e-4
"""Defining points of an arc lie so near to its circle, in parts of the radius."""

_STRAIGHT = 1e-6
"""A segment whose slopes are those of its chord to this is straight."""

_TURN = 1.0
"""Bottom and side differ in direction by more than this (radians)."""

_CORNER = 1e-3
"""A bilge whose ends are nearer (m) is a corner."""

_KNOT = 1e-9
"""A knot so near (m) to an end of the bilge is that end."""


@attrs.frozen(eq=False)
class Bilge:
    """The bilge of a section.

    Attributes
    ----------
    section : int
        The curve of the net.
    low, high : (3,), m
        Where the bottom ends, and where the side begins.
    centre : (2,), m
        y and z of the centre of its circle.
    radius : float, m
        Of the circle.
    off : float, m
        The farthest that a defining point of the bilge lies off the circle.
    arc : bool
        It is an arc; else the circle passes `low`, `high` and the place half-way between.
    """

    section: int
    low: FloatArray
    high: FloatArray
    centre: FloatArray
    radius: float
    off: float
    arc: bool

    def __attrs_post_init__(self) -> None:
        freeze(self.low, self.high, self.centre)


def bilge_of(hull: Drawn) -> Bilge | str:
    """Give the bilge of the section nearest to midship, or say why there is none."""
    section = hull.section_amidships
    if section is None:
        return "parent has no section across the ship"
    curve = hull.one(section)
    found = _between_flats(hull, section) or _between_straights(curve)
    if found is None:
        return "parent has no bilge between a flat bottom and a flat side amidships"
    ends = evaluate(curve, np.zeros(2, np.int64), np.array(found))
    if np.abs(ends[1] - ends[0]).max() <= _CORNER:
        return "the bilge of the parent is a corner"
    within = (curve.knot >= min(found) - _KNOT) & (curve.knot <= max(found) + _KNOT)
    knots = np.concatenate([ends, curve.xyz[within]])[:, 1:]
    circle = fit_circle(knots) if within.sum() > 3 else None
    if circle is not None and _off(circle, knots) <= _ROUND * circle.radius:
        return _bilge(section, ends, circle, knots, arc=True)
    three = _through_three(curve, ends, (min(found), max(found)))
    if three is None:
        return "the bilge of the parent is not round"
    return _bilge(section, ends, three, knots, arc=False)


def _bilge(
    section: int, ends: FloatArray, circle: Circle, knots: FloatArray, *, arc: bool
) -> Bilge:
    low, high = ends[0].copy(), ends[1].copy()
    off = _off(circle, knots)
    return Bilge(section, low, high, circle.centre.copy(), circle.radius, off, arc)


def _off(circle: Circle, places: FloatArray) -> float:
    """Give the farthest that places (n, 2) lie off a circle, m."""
    off = np.sqrt(((places - circle.centre) ** 2).sum(axis=1)) - circle.radius
    return float(np.abs(off).max())


def _between_flats(hull: Drawn, section: int) -> tuple[float, float] | None:
    """Give where a section meets the border of the flat of bottom, and lowest that of side."""
    bottom = _meets(hull, section, hull.flats_of_bottom)
    side = _meets(hull, section, hull.flats_of_side)
    if not len(bottom) or not len(side):
        return None
    curve = hull.one(section)
    at_bottom = evaluate(curve, np.zeros(len(bottom), np.int64), bottom)
    at_side = evaluate(curve, np.zeros(len(side), np.int64), side)
    low, high = int(at_bottom[:, 1].argmax()), int(at_side[:, 2].argmin())
    return float(bottom[low]), float(side[high])


def _meets(hull: Drawn, section: int, borders: list[int]) -> FloatArray:
    """Give where a section crosses borders of flats, (k,), m along it."""
    meets, place = hull.net.meets, hull.net.place
    found = [
        place[(meets[:, side] == section) & np.isin(meets[:, 1 - side], borders), side]
        for side in (0, 1)
    ]
    return np.concatenate(found)


def _between_straights(curve: SplineBatch) -> tuple[float, float] | None:
    """Give where the straight run from the keel ends, and where the next of another sense begins.

    Places along the curve, m.
    """
    chord = np.diff(curve.xyz, axis=0)
    ahead = chord / np.sqrt((chord * chord).sum(axis=1))[:, None]
    straight = np.abs(curve.leave[:-1] - ahead).max(axis=1) <= _STRAIGHT
    straight &= np.abs(curve.arrive[1:] - ahead).max(axis=1) <= _STRAIGHT
    begin, end = curve.knot[:-1], curve.knot[1:]
    if curve.xyz[0, 2] > curve.xyz[-1, 2]:
        straight, ahead = straight[::-1], -ahead[::-1]
        begin, end = end[::-1], begin[::-1]
    if not straight[0]:
        return None
    turn = np.arccos(np.clip(ahead @ ahead[0], -1.0, 1.0))
    bottom = int(np.append(straight & (turn <= _STRAIGHT), False).argmin()) - 1
    side = np.flatnonzero(straight & (turn > _TURN))
    return (float(end[bottom]), float(begin[side[0]])) if len(side) else None


def _through_three(
    curve: SplineBatch, ends: FloatArray, within: tuple[float, float]
) -> Circle | None:
    """Give the circle through the ends of a bilge and the place of it above their middle.

    It takes no notice of where the curve has its defining points, and grows with the bilge if
    that is enlarged about the corner of bottom and side.
    """
    chord = ends[1] - ends[0]
    length = float(np.sqrt(chord @ chord))
    ahead, middle = chord / length, 0.5 * (ends[0] + ends[1])
    found = places_on(curve, ahead, float(ahead @ middle))
    inside = (found.t > within[0]) & (found.t < within[1])
    if not inside.any():
        return None
    outward = np.array([0.0, ahead[2], -ahead[1]])
    sagitta = float(((found.xyz[inside] - middle) @ outward).max())
    if sagitta <= _CORNER * length:
        return None
    radius = (0.25 * length * length + sagitta * sagitta) / (2.0 * sagitta)
    centre = middle + (sagitta - radius) * outward
    return Circle(centre[1:].copy(), radius, 0.0)

"""At which heel water reaches a place: the deck edge, or an opening through which it comes in."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.bracketed_roots import sign_changes
from assoc_hull.analysis.hydrostatics.floating_body import (
    Floatable,
    WaterplaneLimits,
    deck_edge_heel,
)
from assoc_hull.analysis.stability.condition import Condition
from assoc_hull.analysis.stability.lever_curve import LeverCurve
from assoc_hull.analysis.stability.righting_lever import StabilityCase, float_at_heels
from assoc_hull.arguments import checked, flag, place, text
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals

__all__ = ["Flooding", "FloodingPoint", "immersion_heels", "mirrored_places", "open_deck_limit"]

_WHERE = "in a down-flooding point"
_STEP, _STEEPEST = 5.0, 85.0


def _three(value: object) -> tuple[float, float, float]:
    x, y, z = place(value, "place", _WHERE).tolist()
    return x, y, z


@attrs.frozen
class FloodingPoint:
    """An opening that cannot be closed weathertight: where water comes in once it is under.

    Attributes
    ----------
    name : str
        Of the opening.
    place : (float, float, float), m
        x from AP, y + to port, z from the base line.
    both_sides : bool
        There is one like it on the other side.

    Examples
    --------
    >>> from assoc_hull.analysis.stability.flooding import FloodingPoint
    >>> FloodingPoint("engine room vent", (30.0, 4.0, 16.5)).both_sides
    True
    """

    name: str = attrs.field(validator=checked(text, _WHERE))
    place: tuple[float, float, float] = attrs.field(converter=_three)
    both_sides: bool = attrs.field(default=True, validator=checked(flag, _WHERE))

    @property
    def places(self) -> FloatArray:
        """Where it is, (1 or 2, 3), m."""
        one = np.array([self.place])
        return mirrored_places(one) if self.both_sides else one


@attrs.frozen
class Flooding:
    """When water reaches an opening.

    Attributes
    ----------
    point : FloodingPoint
        The opening.
    heel_deg : float or None, degrees
        To the side on which the ship is judged; None: it stays dry as far as the curve goes.
    """

    point: FloodingPoint
    heel_deg: float | None


def mirrored_places(places: FloatArray) -> FloatArray:
    """Give places, (k, 3), and those of the other side."""
    return np.concatenate([places, places * [1.0, -1.0, 1.0]])


def immersion_heels(curve: LeverCurve, groups: Sequence[FloatArray]) -> list[float | None]:
    """Tell at which heel the first place of each group goes under.

    Parameters
    ----------
    curve : LeverCurve
        The ship, and the side to which she heels.
    groups : sequence of (k, 3), m
        Places.

    Returns
    -------
    list of float or None, degrees
        0 if one is under water upright, None if all stay dry as far as the curve goes.
    """
    side, heels = curve.side, curve.heels
    judged = np.flatnonzero(side * heels.heel_deg >= 0.0)
    judged = judged[np.argsort(side * heels.heel_deg[judged])]
    at = side * heels.heel_deg[judged]
    dry = np.stack([heels.dry(each).min(axis=1)[judged] for each in groups], axis=1)
    wet = dry <= 0.0
    first = wet.argmax(axis=0)
    found: list[float | None] = [0.0 if wet[0, i] else None for i in range(len(groups))]
    some = np.flatnonzero(wet.any(axis=0) & ~wet[0])

    def height(heel: FloatArray, rows: IntArray) -> FloatArray:
        here = float_at_heels(curve.case, side * heel, near=heels)
        return np.array(
            [here.dry(groups[some[row]])[k].min() for k, row in enumerate(rows.tolist())]
        )

    angles = sign_changes(height, at[first[some] - 1], at[first[some]])
    for i, angle in zip(some.tolist(), angles.tolist(), strict=True):
        found[i] = angle
    return found


def open_deck_limit(case: StabilityCase, condition: Condition, side: int) -> float | None:
    """Tell to which heel (degrees) the edge of an open deck stays dry; None: to the end.

    Parameters
    ----------
    case, condition : StabilityCase, Condition
        The ship.
    side : int
        To which side she heels.
    """
    afloat = case.afloat
    if case.trim == "fixed":
        return deck_edge_heel(afloat.body, condition.upright, afloat.length, afloat.appendages)
    edge = mirrored_places(afloat.body.limits.deck)
    over = attrs.evolve(case, afloat=attrs.evolve(afloat, body=_Lidded(afloat.body)))

    def dry(heel: FloatArray, _: IntArray) -> FloatArray:
        least = float_at_heels(over, side * heel).dry(edge).min(axis=1)
        return np.where(np.isfinite(least), least, -np.inf)

    low = 0.0
    while low < _STEEPEST:
        high = min(low + _STEP, _STEEPEST)
        if dry(np.array([high]), np.zeros(1, np.int64))[0] <= 0.0:
            return float(sign_changes(dry, np.array([low]), np.array([high]))[0])
        low = high
    return None


@attrs.frozen
class _Lidded:
    """An open hull whose integrals are taken a little beyond its deck edge as well.

    They are not those of a ship there, but go on smoothly: where the edge touches the water
    is found from both sides.
    """

    body: Floatable

    @property
    def limits(self) -> WaterplaneLimits:
        return attrs.evolve(self.body.limits, closed=True)

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        return self.body.measure(planes)

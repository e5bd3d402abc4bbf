"""The views of a lines plan in a drawing: which coordinates each shows, and where it lies.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.dxf.plan_views import PlanView
>>> view = PlanView("aft body", (60.0, 40.0))
>>> flat = view.flat(np.array([[10.0, 3.0, 7.0]]))
>>> flat.tolist(), view.in_space(flat, 10.0).tolist()
([[57.0, 47.0]], [[10.0, 3.0, 7.0]])
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["SHOWN", "PlanView", "Shown", "home_of"]


@attrs.frozen
class Shown:
    """What a view shows: two coordinates, to the right and up, and which one not.

    Attributes
    ----------
    right, up, hidden : int
        The coordinates.
    sign : float
        -1 where the first one is counted to the left.
    """

    right: int
    up: int
    hidden: int
    sign: float = 1.0


SHOWN: Mapping[str, Shown] = MappingProxyType({
    "profile": Shown(0, 2, 1),
    "half-breadth": Shown(0, 1, 2),
    "fore body": Shown(1, 2, 0),
    "aft body": Shown(1, 2, 0, -1.0),
})  # fmt: skip
"""The views by name: bow to the right, fore body on the right."""


@attrs.frozen
class PlanView:
    """A view in its place.

    Attributes
    ----------
    name : str
        One of `SHOWN`.
    origin : (float, float)
        Where its origin lies in the drawing: base line, centre line, after perpendicular.
    """

    name: str
    origin: tuple[float, float]

    @property
    def shown(self) -> Shown:
        """What it shows."""
        return SHOWN[self.name]

    def flat(self, points: FloatArray) -> FloatArray:
        """Give places in the drawing, (n, 2), of places in space, (n, 3)."""
        shown = self.shown
        return np.column_stack([
            self.origin[0] + shown.sign * points[:, shown.right],
            self.origin[1] + points[:, shown.up],
        ])  # fmt: skip

    def in_space(self, flat: FloatArray, place: float | FloatArray) -> FloatArray:
        """Give places in space, (n, 3), of places in the drawing and what it does not show."""
        shown, found = self.shown, np.empty((len(flat), 3))
        found[:, shown.right] = shown.sign * (flat[:, 0] - self.origin[0])
        found[:, shown.up] = flat[:, 1] - self.origin[1]
        found[:, shown.hidden] = place
        return found + 0.0


def home_of(axis: int | None, place: float, middle: float) -> tuple[str, ...]:
    """Give the views from which a line can be read: the one in true shape, or two.

    Parameters
    ----------
    axis : int or None
        The coordinate that is constant on it; None for curves in space.
    place : float, m
        Its constant coordinate.
    middle : float, m
        Where aft and fore body meet.
    """
    if axis is None:
        return ("profile", "half-breadth")
    return ("aft body" if place < middle else "fore body", "profile", "half-breadth")[axis:][:1]

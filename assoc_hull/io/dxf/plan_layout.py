"""Views of a lines plan: which coordinates each shows, where it lies, how large letters are.

A drawing has the size of the ship, in m here; the scale counts for letters only. Profile and
half-breadth plan lie one above the other with the bow to the right, the body plan above them. The
views serve both the writer (`io.dxf.lines_plan`) and the reader (`io.dxf.read_lines_plan`).
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from types import MappingProxyType

import attrs
import numpy as np

from assoc_hull.arguments import positive
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "VIEW_AXES",
    "PlanLayout",
    "PlanView",
    "ViewAxes",
    "lay_out",
    "views_of_line",
]

# --------------------------------------------------------------------------------------
# Views.


@attrs.frozen
class ViewAxes:
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


VIEW_AXES: Mapping[str, ViewAxes] = MappingProxyType({
    "profile": ViewAxes(0, 2, 1),
    "half-breadth": ViewAxes(0, 1, 2),
    "fore body": ViewAxes(1, 2, 0),
    "aft body": ViewAxes(1, 2, 0, -1.0),
})  # fmt: skip
"""The views by name: bow to the right, fore body on the right."""


@attrs.frozen
class PlanView:
    """A view in its place.

    Attributes
    ----------
    name : str
        A key of `VIEW_AXES`.
    origin : (float, float)
        Where its origin lies in the drawing: base line, centre line, after perpendicular.
    """

    name: str
    origin: tuple[float, float]

    @property
    def shown(self) -> ViewAxes:
        """What it shows."""
        return VIEW_AXES[self.name]

    def flat(self, points: FloatArray) -> FloatArray:
        """Give points in the drawing, (n, 2), of points in space, (n, 3)."""
        shown = self.shown
        return np.column_stack([
            self.origin[0] + shown.sign * points[:, shown.right],
            self.origin[1] + points[:, shown.up],
        ])  # fmt: skip

    def in_space(self, flat: FloatArray, place: float | FloatArray) -> FloatArray:
        """Give points in space, (n, 3), of points in the drawing and the hidden coordinate."""
        shown, found = self.shown, np.empty((len(flat), 3))
        found[:, shown.right] = shown.sign * (flat[:, 0] - self.origin[0])
        found[:, shown.up] = flat[:, 1] - self.origin[1]
        found[:, shown.hidden] = place
        return found + 0.0


def views_of_line(axis: int | None, place: float, middle: float) -> tuple[str, ...]:
    """Give the views from which a line can be read: the one in true shape, or two.

    `axis` is the coordinate that is constant on it, None for curves in space, `place` (m) its
    value; aft and fore body join at `middle` (m).
    """
    if axis is None:
        return ("profile", "half-breadth")
    return ("aft body" if place < middle else "fore body", "profile", "half-breadth")[axis:][:1]


# --------------------------------------------------------------------------------------
# Layout.

_SCALES = (5, 10, 20, 25, 50, 75, 100, 150, 200, 250, 300, 400, 500, 750, 1000)
_WIDTH = 0.82
"""Room across a sheet of A1 inside its frame, m."""

_LETTER = 2.5e-3
"""Height of letters on paper, m."""

_ROOM = 14.0
"""Letters that fit between two views, one above the other, and between a view and the frame."""


@attrs.frozen(eq=False)
class PlanLayout:
    """A drawing of three views; all lengths in m at full size.

    Attributes
    ----------
    low, high : (3,), m
        Extent of the hull and the base line; y of one side.
    middle : float, m
        Half the length between perpendiculars.
    depth : float, m
        How far diagonals reach below the centre line.
    scale : float
        At which it is meant to be printed.
    """

    low: FloatArray
    high: FloatArray
    middle: float
    depth: float
    scale: float

    @property
    def letter(self) -> float:
        """Height of letters, m."""
        return _LETTER * self.scale

    @property
    def room(self) -> float:
        """Between views, m."""
        return _ROOM * self.letter

    @cached_property
    def views(self) -> tuple[PlanView, ...]:
        """The views: the profile lies at its true coordinates."""
        half = float(self.low[2] - self.room - self.high[1])
        body = (self.middle, float(self.high[2] + 1.5 * self.room - self.low[2]))
        return (
            PlanView("profile", (0.0, 0.0)), PlanView("half-breadth", (0.0, half)),
            PlanView("fore body", body), PlanView("aft body", body),
        )  # fmt: skip

    def view(self, name: str) -> PlanView:
        """Give a view by its name."""
        return next(each for each in self.views if each.name == name)

    @property
    def frame(self) -> FloatArray:
        """Lower left and upper right corner of the frame, (2, 2), m."""
        half, body = self.view("half-breadth").origin[1], self.view("fore body").origin[1]
        lower = [self.low[0] - self.room, half - self.depth - self.room]
        upper = [self.high[0] + self.room, body + self.high[2] + self.room]
        return np.array([lower, upper])


def lay_out(bounds: FloatArray, middle: float, depth: float, scale: float | None) -> PlanLayout:
    """Lay out a plan of lines between `bounds` (2, 3), m; `middle` is Lpp / 2.

    Diagonals reach `depth` (m) below the centre line. `scale` is a denominator, such as 200; None
    chooses one for a sheet of A1.

    Raises
    ------
    BadInputError
        A scale that is not positive.
    """
    low, high = np.minimum(bounds[0], 0.0), np.asarray(bounds[1])
    if scale is None:
        width = float(high[0] - low[0])
        fits = (each for each in _SCALES if width + 2.0 * _ROOM * _LETTER * each <= _WIDTH * each)
        scale = next(fits, _SCALES[-1])
    return PlanLayout(low, high, middle, depth, positive(scale, "scale", "in a lines plan"))

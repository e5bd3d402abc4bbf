"""Where the views of a lines plan lie in a drawing, and how large its letters are.

A drawing has the size of the ship; the scale says only at which it is to be printed, and so how
large letters must be. Profile and half-breadth plan lie one above the other with the bow to the
right, the body plan above them, all on one scale.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.dxf.plan_layout import lay_out
>>> plan = lay_out(np.array([[-5.0, 0, 0], [305, 25, 27]]), 150.0, 0.0, None)
>>> plan.scale, plan.letter, plan.view("half-breadth").origin
(500.0, 1.25, (0.0, -42.5))
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np

from assoc_hull.arguments import positive
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.dxf.plan_views import PlanView

__all__ = ["PlanLayout", "lay_out"]

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
    """Lay out a plan.

    Parameters
    ----------
    bounds : (2, 3), m
        Least and greatest coordinates of all lines.
    middle : float, m
        Half the length between perpendiculars.
    depth : float, m
        How far diagonals reach below the centre line.
    scale : float or None
        Denominator, such as 200; None chooses one for a sheet of A1.

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

"""Lines of a hull as chains of arcs, each in its plane, and what is said of them."""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.classical.arcs import Arcs
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["ArcLine", "ArcLines"]


@attrs.frozen(eq=False)
class ArcLine:
    """One curve of a line as arcs.

    Attributes
    ----------
    name : str
        Address of the curve: the line, with a number if it is one of several; of a space curve
        with the view: "deck edge (plan)".
    group : str
        Group of its line.
    axes : (3, 3)
        Unit vectors of the drawing plane, to the right and up, and its normal, which points to
        whoever looks at it: (y, z) for sections, (x, y) for waterlines, (x, z) for buttocks.
    height : float, m
        Of the plane along the normal.
    arcs : Arcs
        In the plane, in order.
    smooth : (n,) bool
        Whether an arc begins in the direction in which the one before it ends; false for the
        first, and at knuckles.
    deviation : (2,), m
        Largest distance of the curve from the arcs, and of the arcs from the curve.
    place : (3,), m
        Where the curve is farthest from its arcs.
    points : int
        Points of the net on the curve.
    """

    name: str
    group: str
    axes: FloatArray
    height: float
    arcs: Arcs
    smooth: NDArray[np.bool_]
    deviation: FloatArray
    place: FloatArray
    points: int

    def __attrs_post_init__(self) -> None:
        freeze(self.axes, self.smooth, self.deviation, self.place)

    @property
    def least_radius(self) -> float:
        """Of its arcs, m; infinite if all are straight."""
        sharpest = float(np.abs(self.arcs.curvature).max())
        return 1.0 / sharpest if sharpest > 0.0 else float("inf")

    def in_space(self, places: FloatArray) -> FloatArray:
        """Give places of the plane, (n, 2), m, in the axes of the hull, (n, 3), m."""
        found: FloatArray = places @ self.axes[:2] + self.height * self.axes[2]
        return found

    def starts(self) -> FloatArray:
        """Give where the arcs begin, (n, 3), m."""
        return self.in_space(self.arcs.start)

    def directions(self) -> FloatArray:
        """Give unit vectors along the arcs where they begin, (n, 3)."""
        angle = self.arcs.angle
        found: FloatArray = np.stack([np.cos(angle), np.sin(angle)], axis=1) @ self.axes[:2]
        return found

    def centres(self) -> FloatArray:
        """Give the centres, (n, 3), m; not a number for straight lines."""
        found = self.arcs.centres()
        return self.in_space(np.where(np.isfinite(found), found, np.nan))

    def facts(self) -> dict[str, Any]:
        """Give what is reported of it."""
        return {
            "line": self.name, "group": self.group, "arcs": len(self.arcs),
            "straight": int((self.arcs.curvature == 0.0).sum()),
            "deviation": float(self.deviation.max()),
            "deviation_of_curve": float(self.deviation[0]),
            "deviation_of_arcs": float(self.deviation[1]),
            "place": self.place.tolist(), "least_radius": self.least_radius,
            "net_points": self.points,
        }  # fmt: skip


@attrs.frozen(eq=False)
class ArcLines:
    """Lines of a hull as arcs.

    Attributes
    ----------
    ship : str
        Name of the hull.
    within : float, m
        Tolerance that was asked for.
    allowed_radius : float, m
        Least radius that was asked for; 0 if none was.
    lines : tuple of ArcLine
        In the order of the hull.
    left_out : tuple of str
        What is not among them, and why; a sentence each.
    notes : tuple of str
        What stands for a line that lies in no plane; a sentence each.
    """

    ship: str
    within: float
    allowed_radius: float
    lines: tuple[ArcLine, ...]
    left_out: tuple[str, ...]
    notes: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number of arcs."""
        return sum(len(line.arcs) for line in self.lines)

    @property
    def deviation(self) -> float:
        """Largest distance of a line and its arcs, both ways, m."""
        return max((float(line.deviation.max()) for line in self.lines), default=0.0)

    @property
    def least_radius(self) -> float:
        """Of all arcs, m; infinite if all are straight."""
        return min((line.least_radius for line in self.lines), default=float("inf"))

    @property
    def one_per_interval(self) -> int:
        """Arcs that one biarc between neighbouring points of the net would take."""
        return sum(2 * max(line.points - 1, 1) for line in self.lines)

    def facts(self) -> dict[str, Any]:
        """Give the report as data."""
        return {
            "ship": self.ship, "within": self.within, "least_radius_asked": self.allowed_radius,
            "arcs": self.count, "deviation": self.deviation, "least_radius": self.least_radius,
            "one_biarc_per_interval": self.one_per_interval,
            "lines": [line.facts() for line in self.lines], "left_out": list(self.left_out),
            "notes": list(self.notes),
        }  # fmt: skip

    def __str__(self) -> str:
        return (
            f"{len(self.lines)} curves, {self.count} arcs, at most {1e3 * self.deviation:.3f} mm "
            f"off, least radius {self.least_radius:.3f} m"
        )

"""The main piece of a waterline: from where it is broadest to its end, forward or aft.

A waterline may be in several pieces (a bulb's top, skegs). The main one is that which holds the
greatest half breadth; its arcs are joined end to end from there.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.waterlines import Arcs

__all__ = ["OuterLine", "outer_line"]

_SAME = 1e-9
"""Half breadths that differ by a smaller part are both the greatest."""

_SPECK = 1e-3
"""m: arcs that are no longer are left out, and ends that lie no farther apart are one."""


@attrs.frozen(eq=False)
class OuterLine:
    """A line in plan from where it is broadest to its end, as m arcs of n places.

    Attributes
    ----------
    point : (m, n, 2), m
        x and y; the line runs along the first axis, then along the second.
    slope : (m, n, 2), m
        Their derivatives along each arc, from 0 to 1, in the direction in which the line runs.
    weight : (n,)
        Shares of the places in integrals along an arc.
    """

    point: FloatArray
    slope: FloatArray
    weight: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.point, self.slope, self.weight)

    @property
    def end(self) -> tuple[float, float]:
        """Where the line ends: x and y, m."""
        x, y = self.point[-1, -1].tolist()
        return x, y

    @property
    def aftmost(self) -> tuple[float, float]:
        """Where the line is farthest aft: x and y, m; of several places that first met."""
        places = self.point.reshape(-1, 2)
        x, y = places[int((places[:, 0] <= places[:, 0].min() + _SPECK).argmax())].tolist()
        return x, y

    @property
    def angle(self) -> FloatArray:
        """By how much the line runs inward, (m, n), radians: pi / 2 where it runs across."""
        inward: FloatArray = np.arctan2(-self.slope[..., 1], np.abs(self.slope[..., 0]))
        return inward

    def entrance(self, near: float, step: float) -> float:
        """Give the angle at the end of the line, or where it leaves the radius there; radians.

        The line is rounded there if, within `near` (m) of y = 0, it turns over a length of `step`
        (m) as much as a circle of radius `near` or more. It has left the radius at the end of the
        first such length, seen from the end of the line, over which it turns by no more than half
        of the most. So short waves of the curvature do not count, and behind a circle the angle is
        that of the tangent there.
        """
        angle = np.unwrap(self.angle.ravel()[::-1])
        place = self.point.reshape(-1, 2)[::-1]
        along = np.append(0.0, np.cumsum(np.hypot(*np.diff(place, axis=0).T)))
        behind = np.interp(along + step, along, angle)
        turn = np.where(along + step <= along[-1], angle - behind, 0.0)
        most = int(np.where(place[:, 1] <= near, turn, -np.inf).argmax())
        slack = np.flatnonzero(turn[most:] <= 0.5 * turn[most])
        if turn[most] * near < step or not len(slack):
            return float(angle[0])
        k = most + int(slack[0])
        share = (turn[k - 1] - 0.5 * turn[most]) / (turn[k - 1] - turn[k])
        return float(behind[k - 1] + share * (behind[k] - behind[k - 1]))

    def angle_beside(self, half_breadth: float) -> float:
        """Give the angle where the line, seen from its end, is first so far out (m); radians."""
        angle = np.unwrap(self.angle.ravel()[::-1])
        y = self.point[..., 1].ravel()[::-1]
        k = int((y >= half_breadth).argmax())
        if k == 0:
            return float(angle[0])
        share = (half_breadth - y[k - 1]) / (y[k] - y[k - 1])
        return float(angle[k - 1] + share * (angle[k] - angle[k - 1]))

    def bluntness(self) -> float:
        """Integral of the square of the sine of `angle` over -y, m; a flat end has sine 1."""
        dx, dy = self.slope[..., 0], self.slope[..., 1]
        square = dx * dx + dy * dy
        each = -dy * dy * dy / np.where(square > 0.0, square, 1.0)
        return float((each @ self.weight).sum()) + self.end[1]


def outer_line(arcs: Arcs, *, forward: bool) -> OuterLine | None:
    """Follow a waterline from where it is broadest.

    Parameters
    ----------
    arcs : Arcs
        All arcs of the waterline.
    forward : bool
        To its forward end; else to its after end.

    Returns
    -------
    OuterLine or None
        Of places equally broad it begins at that next to the end; None without a waterline.
    """
    size = np.ptp(arcs.point, axis=1).max(axis=1, initial=0.0)
    some = np.flatnonzero(size > _SPECK)
    if not len(some):
        return None
    point, slope = arcs.point[some], arcs.slope[some]
    if not forward:
        point, slope = point[:, ::-1], -slope[:, ::-1]
    way = [(_broadest(point, 1.0 if forward else -1.0), False)]
    left = set(range(len(some))) - {way[0][0]}
    while left:
        last, turned = way[-1]
        end = point[last, 0 if turned else -1]
        chosen = np.array(sorted(left))
        away = np.abs(point[chosen][:, [0, -1]] - end).max(axis=2)
        row, side = np.unravel_index(int(away.argmin()), away.shape)
        if not away[row, side] <= 2.0 * _SPECK:
            break
        way.append((int(chosen[row]), bool(side == 1)))
        left.remove(way[-1][0])
    return _joined(point, slope, way, arcs.weight)


def _broadest(point: FloatArray, sense: float) -> int:
    """Give the arc to begin with: of those that reach the greatest breadth the farthest."""
    most = point[..., 1].max()
    held = point[..., 1] >= most * (1.0 - _SAME)
    ahead = sense * point[..., 0]
    place = np.where(held, ahead, -np.inf).max(axis=1)
    return int(np.lexsort((ahead.mean(axis=1), np.round(place / _SPECK)))[-1])


def _joined(
    point: FloatArray, slope: FloatArray, way: list[tuple[int, bool]], weight: FloatArray
) -> OuterLine:
    places = [point[arc, ::-1] if turned else point[arc] for arc, turned in way]
    slopes = [-slope[arc, ::-1] if turned else slope[arc] for arc, turned in way]
    return OuterLine(np.stack(places), np.stack(slopes), weight.copy())

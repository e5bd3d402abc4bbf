"""A map that makes features anew: after it circles are circles, and what joins them follows.

A circle that is drawn anew lies a little off the image of the old one. That correction is not
put into the circle's points alone, which would dent what joins it: it is spread over the
neighbourhood, in full on the circle, and fading with the distance from it,

    w = 1 - b5(distance / (6 r))

so that the join stays smooth and the fade turns nowhere more than the hull does. Between two
circles each counts in full at its own and not at all at the other, and their shares add up: what
is straight between two that move alike stays straight. Beyond the fade nothing is added, and
places keep the bits of the map. The tangent of the image of the circle is that of
the new circle.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.features.circle import Redrawn
from assoc_hull.variation.fields.blend import QUINTIC
from assoc_hull.variation.fields.field import Region

__all__ = ["JOIN", "FeatureMap", "acting", "fade"]

JOIN = 6.0
"""A correction fades within so many radii of its circle."""

_Map = Callable[[FloatArray], FloatArray]


def fade(away: FloatArray, reach: float) -> FloatArray:
    """Give the part of a correction that is left at a distance: 1 at 0, nil from `reach` on.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.features.map import fade
    >>> fade(np.array([0.0, 3.0, 6.0, 7.0]), 6.0).tolist()
    [1.0, 0.5, 0.0, 0.0]
    """
    return np.asarray(1.0 - QUINTIC.value(np.asarray(away) / reach))


@attrs.frozen(eq=False)
class FeatureMap:
    """A map and the circles that are drawn anew after it.

    Attributes
    ----------
    image, slope : callable
        The map of places (n, 3), m, and its Jacobian, (n, 3, 3).
    circles : tuple of Redrawn
        Apart from one another.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.space_map import affine
    >>> from assoc_hull.variation.features.circle import Circle, redraw
    >>> from assoc_hull.variation.features.map import FeatureMap
    >>> wide, boss = affine([1, 1.1, 1], [0, 0, 0]), Circle.of([6, 0, 5], 0.725, [1, 0, 0])
    >>> drawn = redraw("boss", boss, wide, wide.jacobian, radius=0.75)
    >>> FeatureMap(wide, wide.jacobian, (drawn,))(np.array([[6.0, 0.725, 5.0]])).tolist()
    [[6.0, 0.75, 5.0]]
    """

    image: _Map
    slope: _Map
    circles: tuple[Redrawn, ...]

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places (n, 3), m; those on a circle to the bits of the new one."""
        found = self.image(xyz)
        away = self._away(xyz)
        for i in np.flatnonzero(self._near(away).any(axis=1)).tolist():
            some, circle = np.flatnonzero(self._near(away)[i]), self.circles[i]
            unit, size = circle.before.unit(xyz[some])
            moved = found[some]
            if not circle.carried:
                weight = self._weight(i, away[:, some])[0][:, None]
                moved = moved + weight * circle.correction(unit)
            moved[away[i, some] == 0.0] = circle.after.at(unit[away[i, some] == 0.0])
            level = np.abs((xyz[some] - circle.before.centre) @ circle.before.normal)
            moved[np.maximum(size, level) <= circle.gap] = circle.after.centre
            found[some] = moved
        return found

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = self.slope(xyz)
        away = self._away(xyz)
        for i in np.flatnonzero(self._near(away).any(axis=1)).tolist():
            some = np.flatnonzero(self._near(away)[i])
            circle, (weight, turn) = self.circles[i], self._weight(i, away[:, some])
            if circle.carried:
                continue
            unit, size = circle.before.unit(xyz[some])
            about = np.eye(3) - circle.before.normal[:, None] * circle.before.normal
            about = about - unit[:, :, None] * unit[:, None, :]
            about = about / np.where(size > 0.0, size, np.inf)[:, None, None]
            spin = np.einsum("nij,njk->nik", circle.turning(unit), about)
            grow = np.einsum("jn,jnk->nk", turn, self._ahead(xyz[some], away[:, some]))
            found[some] += weight[:, None, None] * spin
            found[some] += circle.correction(unit)[:, :, None] * grow[:, None, :]
        return found

    def regions(self) -> tuple[Region, ...]:
        """Give the boxes of the profile plane in which features change the map."""
        return tuple(_region(each) for each in self.circles if not each.carried)

    def _away(self, xyz: FloatArray) -> FloatArray:
        """Give how far places lie from each circle, (c, n), m."""
        if not self.circles:
            return np.zeros((0, len(xyz)))
        return np.array([_distance(each, xyz) for each in self.circles])

    def _near(self, away: FloatArray) -> np.typing.NDArray[np.bool_]:
        return np.asarray(away < self._reach()[:, None])

    def _reach(self) -> FloatArray:
        return np.array([JOIN * each.before.radius for each in self.circles])

    def _weight(self, i: int, away: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the weight of a circle at places, (n,), and its slopes by the distances, (c, n).

        The fade of all circles together, parted among them.
        """
        each = [self._part(k, away) for k in range(len(away))]
        part, turn = np.array([p for p, _ in each]), np.array([t for _, t in each])
        left, sink = self._left(away)
        total, slope = part.sum(axis=0), turn.sum(axis=0)
        total[total == 0.0] = 1.0
        share = part[i] / total
        bend = (turn[i] - share * slope) / total
        return left * share, sink * share + left * bend

    def _left(self, away: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give what the fades of all circles leave of corrections, (n,), and its slopes, (c, n)."""
        reach = self._reach()[:, None]
        gone, rise = QUINTIC.value(away / reach), QUINTIC.slope(away / reach) / reach
        rest = [np.prod(np.delete(gone, j, axis=0), axis=0) for j in range(len(away))]
        return 1.0 - np.prod(gone, axis=0), -rise * np.array(rest)

    def _part(self, i: int, away: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give how much a circle counts beside the others, (n,), and its slopes, (c, n)."""
        reach, own = float(self._reach()[i]), away[i]
        both = own + away
        both[both == 0.0] = 1.0
        share = away / both
        part, slope = QUINTIC.value(share), QUINTIC.slope(share) / both
        part[i], slope[i] = fade(own, reach), -QUINTIC.slope(own / reach) / reach
        turn = np.zeros_like(away)
        for j in range(len(away)):
            by = slope[j] * np.prod(np.delete(part, j, axis=0), axis=0)
            turn[j] += by if j == i else by * (1.0 - share[j])
            turn[i] -= 0.0 if j == i else by * share[j]
        return np.prod(part, axis=0), turn

    def _ahead(self, xyz: FloatArray, away: FloatArray) -> FloatArray:
        """Give the unit vectors in which the distances grow, (c, n, 3); nil on a circle."""
        steps = np.array([xyz - each.before.foot(xyz)[0] for each in self.circles])
        return np.asarray(steps / np.where(away > 0.0, away, np.inf)[:, :, None])


def _distance(circle: Redrawn, xyz: FloatArray) -> FloatArray:
    """Give how far places lie from a circle; nil for those that count as on it."""
    away = circle.before.foot(xyz)[1]
    return np.asarray(np.where(away <= circle.gap, 0.0, away))


def _region(circle: Redrawn) -> Region:
    reach = (JOIN + 1.0) * circle.before.radius
    x, _, z = circle.before.centre.tolist()
    return Region(circle.name, (x - reach, x + reach), (z - reach, z + reach))


def acting(circles: Sequence[Redrawn]) -> tuple[Redrawn, ...]:
    """Leave out circles that stay as they are: what is on them keeps its bits."""
    return tuple(each for each in circles if not each.idle)

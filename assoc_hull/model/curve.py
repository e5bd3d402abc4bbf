"""Handles on curves, and what a curve generates on others.

Reference: Choi & Lee, "A Study on the Hull Form Design System on the Basis of the
Associative Geometry Objects", J. SNAK 36(4), 1999.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, ClassVar

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import integer, numbers
from assoc_hull.arguments import place as one_place
from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.curvature import curvature
from assoc_hull.geometry.splines.evaluation import evaluate, sample
from assoc_hull.geometry.splines.length import arc_length
from assoc_hull.model.address import AddressBook
from assoc_hull.model.gaps import tangents
from assoc_hull.model.handle import Handle
from assoc_hull.model.kinds import State
from assoc_hull.model.links import generates_on, latent_curves, points_on
from assoc_hull.model.point import Point

if TYPE_CHECKING:
    from assoc_hull.model.line import Line

__all__ = ["Curve", "Touch"]


@attrs.frozen
class Touch:
    """What a curve generates on others.

    Attributes
    ----------
    actual : tuple of Point
        The points it has generated on other curves.
    latent : tuple of Curve
        The curves it may come to meet.
    """

    actual: tuple[Point, ...]
    latent: tuple[Curve, ...]


@attrs.frozen(repr=False)
class Curve(Handle):
    """One connected curve of a line.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.line import Line
    >>> line = Line.of(wigley(), 3)
    >>> line.curves[0].at(0.0)
    array([10.,  0.,  0.])
    """

    _table: ClassVar[str] = "curves"

    @property
    def name(self) -> str:
        """The name of its line, with a number if it is one of several."""
        return AddressBook(self.tables).curve_name(self.row)

    @property
    def line(self) -> Line:
        """The line it belongs to."""
        from assoc_hull.model.line import Line

        return Line.of(self.tables, self.tables.line_of(self.row))

    @property
    def points(self) -> tuple[Point, ...]:
        """All its points in order along it, those that define it and those that lie on it."""
        on = points_on(self.tables, self.row)
        return self._handles(zip(on.row.tolist(), on.side.tolist(), strict=True))

    @property
    def defining(self) -> tuple[Point, ...]:
        """The points it is made through, in order."""
        rows, side = (getattr(self.tables.curves, name).data[self.row] for name in ("rows", "side"))
        return self._handles(zip(rows.tolist(), side.tolist(), strict=True))

    def _handles(self, places: Iterable[tuple[int, int]]) -> tuple[Point, ...]:
        keys = self.tables.rows.key.data
        return tuple(Point(self.tables, row, keys[row], side) for row, side in places)

    @property
    def touch_objects(self) -> Touch:
        """The points it has generated on other curves, and the curves it may come to meet."""
        group = self.tables.lines.group.data[self.tables.line_of(self.row)]
        reach = set(generates_on(self.tables, int(group)).tolist())
        friends = [point.friend_point for point in self.points]
        actual = tuple(
            friend
            for friend in friends
            if friend is not None and friend.container_curve.line.group.number in reach
        )
        latent = latent_curves(self.tables, self.number).tolist()
        return Touch(actual, tuple(Curve.of(self.tables, curve) for curve in latent))

    @property
    def spline(self) -> SplineBatch:
        """The published spline, a batch of one."""
        return self.tables.spline(self.row)

    @property
    def length(self) -> float:
        """Length along the curve, m."""
        return float(arc_length(self.spline)[0])

    @property
    def ends(self) -> FloatArray:
        """First and last point, (2, 3), m; frozen."""
        found = self.spline.xyz[[0, -1]]
        freeze(found)
        return found

    @property
    def span(self) -> float:
        """Largest chord parameter, m; the least is 0."""
        return float(self.spline.knot[-1])

    def at(self, t: ArrayLike) -> FloatArray:
        """Give the place at chord parameter t (m): (3,), or (k, 3) for k parameters."""
        many, one = self._parameters(t)
        return self._shaped(evaluate(self.spline, np.zeros(len(many), np.int64), many), one)

    def tangent(self, t: ArrayLike) -> FloatArray:
        """Give the unit tangent at chord parameter t (m): (3,) or (k, 3)."""
        many, one = self._parameters(t)
        return self._shaped(tangents(self.tables, np.full(len(many), self.row), many), one)

    def curvature(self, t: ArrayLike) -> FloatArray:
        """Give the curvature vector at chord parameter t (m), 1/m: (3,) or (k, 3)."""
        many, one = self._parameters(t)
        place = np.zeros(len(many), np.int64), many
        return self._shaped(curvature(self.spline, at=place), one)

    def _parameters(self, t: object) -> tuple[FloatArray, bool]:
        """Take parameters as an array, and tell whether it was but one."""
        found = numbers(t, "t", f"on {self.name}")
        return np.atleast_1d(found), found.ndim == 0

    @staticmethod
    def _shaped(found: FloatArray, one: bool) -> FloatArray:
        out: FloatArray = np.array(found[0] if one else found)
        freeze(out)
        return out

    def closest(self, p: ArrayLike) -> tuple[float, FloatArray, float]:
        """Give parameter, place (3,) and distance of the point closest to p (3,), m."""
        place = one_place(p, "p", f"in closest of {self.name}")
        t, xyz, distance = closest(self.spline, 0, place[None])
        return float(t[0]), xyz[0], float(distance[0])

    def polyline(self, per_segment: int = 8) -> FloatArray:
        """Give places along the curve for drawing, (n, 3), m; frozen."""
        where = f"in polyline of {self.name}"
        return sample(self.spline, integer(per_segment, "per_segment", where, least=1, most=1000))[
            1
        ]

    @property
    def state(self) -> str:
        """``"clean"``, ``"failed"`` or ``"blocked"``."""
        return State(int(self.tables.curves.state.data[self.row])).name.lower()

    @property
    def revision(self) -> int:
        """Rises by one each time its geometry really changed."""
        return self.tables.revision_curve.get(self.row, 0)

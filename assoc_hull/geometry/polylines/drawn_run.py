"""A run as a loftsman draws it: a straight one, or a corner of two sides rounded by an arc.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.drawn_run import DrawnRun
>>> run = DrawnRun.rounded(
...     np.zeros(3), np.array([1.0, 0, 0]), np.array([4.0, 4, 0]), np.array([0.0, 1, 0]), 2.0
... )
>>> run.joins.tolist(), run.meet(np.array([1.0, 0, 0]), 1.0).tolist()
([[2.0, 0.0, 0.0], [4.0, 2.0, 0.0]], [[1.0, 0.0, 0.0]])
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Self

import attrs
import numpy as np

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.vectors import dot

__all__ = ["DrawnRun"]

_LEAST_TURN = np.radians(0.1)
"""Sides that turn by less than this are one straight line."""

_WITHIN = 1e-9
"""Of the length of a run: a place as near as this to an end of a piece is on it."""


@attrs.frozen(eq=False)
class DrawnRun:
    """A straight run, or two straight sides and the arc between them that touches both.

    Attributes
    ----------
    start, end : (3,), m
        Its ends.
    first, last : (3,)
        Unit directions there, along the run.
    joins : (2, 3), m
        Where the arc begins and ends; both at the end of a straight run.
    centre : (3,), m
        Of the arc; of a straight run its end.
    radius : float, m
        0 of a straight run.
    """

    start: FloatArray
    end: FloatArray
    first: FloatArray
    last: FloatArray
    joins: FloatArray
    centre: FloatArray
    radius: float

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.end, self.first, self.last, self.joins, self.centre)

    @classmethod
    def straight(cls, start: FloatArray, end: FloatArray) -> Self:
        """Give the straight run between two places."""
        chord = end - start
        way = chord / np.sqrt((chord * chord).sum())
        return cls(start.copy(), end.copy(), way, way.copy(), np.array([end, end]), end.copy(), 0.0)

    @classmethod
    def rounded(
        cls, start: FloatArray, first: FloatArray, end: FloatArray, last: FloatArray, radius: float
    ) -> Self:
        """Give the run along one side, round an arc, and along the other side.

        Parameters
        ----------
        start, first : (3,), m, and (3,)
            A place on the first side, and its unit direction there, towards the corner.
        end, last : (3,), m, and (3,)
            A place on the second side, and its unit direction there, away from the corner.
        radius : float, m
            Of the arc.

        Raises
        ------
        GeometryError
            The sides do not turn, do not meet between the two places, or the arc does not fit
            between them; the message says which radius does.
        """
        cosine = float((first * last).sum())
        across = last - cosine * first
        sine = float(np.sqrt((across * across).sum()))
        turn = float(np.arctan2(sine, cosine))
        degrees = float(np.degrees(turn))
        told: dict[str, object] = {"turn_deg": degrees}
        if not _LEAST_TURN < turn < np.pi - _LEAST_TURN:
            what = f"the sides turn by {degrees:.3f} degrees from one point to the other"
            raise GeometryError(what, "choose points on sides that meet in a corner", told)
        inward = across / sine
        chord = end - start
        second = float((chord * inward).sum()) / sine
        ahead = float((chord * first).sum()) - second * cosine
        if min(ahead, second) <= 0.0:
            what = "the two sides, carried on straight, do not meet between the points"
            raise GeometryError(what, "choose points on sides that meet in a corner", told)
        half = float(np.tan(0.5 * turn))
        least, back = min(ahead, second), radius * half
        if back > least * (1.0 + _WITHIN):
            what = (
                f"an arc of radius {radius:g} m begins {back:.4g} m before the corner of its "
                f"sides, and the nearer point lies {least:.4g} m from it"
            )
            most = float(np.floor(1e4 * least / half) / 1e4)
            remedy = f"give a radius up to {most:.8g} m, or points farther apart"
            raise GeometryError(what, remedy, told | {"radius": radius, "most": most})
        corner = start + ahead * first
        joins = np.array([corner - back * first, corner + back * last])
        return cls(
            start.copy(), end.copy(), first.copy(), last.copy(), joins,
            joins[0] + radius * inward, radius,
        )  # fmt: skip

    @property
    def turn(self) -> float:
        """The angle of the arc, rad."""
        ahead, inward = (self.last * self.first).sum(), (self.last * self._inward).sum()
        return float(np.arctan2(inward, ahead))

    @property
    def _inward(self) -> FloatArray:
        found: FloatArray = (self.centre - self.joins[0]) / (self.radius or 1.0)
        return found

    def _pieces(self) -> Iterator[tuple[FloatArray, FloatArray]]:
        """Give both ends of each straight piece that has a length."""
        for low, high in ((self.start, self.joins[0]), (self.joins[1], self.end)):
            if (low != high).any():
                yield low, high

    def on_arc(self, angle: FloatArray) -> FloatArray:
        """Give places on the arc, (k, 3), m, at angles (k,) from its begin, rad."""
        cosine, sine = np.cos(angle)[:, None], np.sin(angle)[:, None]
        found: FloatArray = self.centre + self.radius * (sine * self.first - cosine * self._inward)
        return found

    def angle(self, places: FloatArray) -> FloatArray:
        """Give the angles (k,) of places (k, 3) seen from the centre, from the arc's begin, rad."""
        away = places - self.centre
        return np.asarray(np.arctan2(dot(away, self.first), -dot(away, self._inward)))

    def meet(self, normal: FloatArray, offset: float) -> FloatArray:
        """Give where the run meets the plane normal . P = offset (m), (k, 3), along the run."""
        found = list[FloatArray]()
        for low, high in self._pieces():
            a, b = float(normal @ low) - offset, float(normal @ high) - offset
            if a != b and -_WITHIN <= a / (a - b) <= 1.0 + _WITHIN:
                found.append(low + min(max(a / (a - b), 0.0), 1.0) * (high - low))
        if self.radius:
            found += list(self.on_arc(self._angles(normal, offset)))
        places = np.array(found).reshape(-1, 3)
        return places[np.argsort(self.length(places), kind="stable")]

    def _angles(self, normal: FloatArray, offset: float) -> FloatArray:
        """Give the angles at which the arc meets a plane."""
        level = float(normal @ self.centre)
        ahead = self.radius * float(normal @ self.first)
        inward = -self.radius * float(normal @ self._inward)
        size = float(np.sqrt(ahead * ahead + inward * inward))
        if size == 0.0 or abs(offset - level) > size:
            return np.zeros(0)
        middle, half = np.arctan2(ahead, inward), np.arccos((offset - level) / size)
        angles = np.array([middle - half, middle + half])
        angles = np.mod(angles + np.pi, 2.0 * np.pi) - np.pi
        return angles[(angles > 0.0) & (angles < self.turn)]

    def length(self, places: FloatArray) -> FloatArray:
        """Give how far along the run places (k, 3) on it are, (k,), m."""
        first = dot(self.joins[0] - self.start, self.first)
        along: FloatArray = np.minimum(dot(places - self.start, self.first), first)
        if not self.radius:
            return along
        turn = self.turn
        angle = self.angle(places)
        arc = self.radius * np.clip(np.where(angle < -0.5 * np.pi, turn, angle), 0.0, turn)
        beyond = np.maximum(dot(places - self.joins[1], self.last), 0.0)
        past = dot(places - self.joins[0], self.first) > 0.0
        return np.where(
            past, first + np.where(beyond > 0.0, self.radius * turn, arc) + beyond, along
        )

    def off(self, places: FloatArray) -> FloatArray:
        """Measure how far places (k, 3) lie off the run, (k,), m."""
        found = np.full(len(places), np.inf)
        for low, high in self._pieces():
            chord, away = high - low, places - low
            part = np.clip(dot(away, chord) / float((chord * chord).sum()), 0.0, 1.0)
            step = away - part[:, None] * chord
            found = np.minimum(found, np.sqrt(dot(step, step)))
        if self.radius:
            angle = np.clip(self.angle(places), 0.0, self.turn)
            step = places - self.on_arc(angle)
            found = np.minimum(found, np.sqrt(dot(step, step)))
        return found

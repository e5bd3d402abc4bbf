"""Circular arcs and straight lines as one record, many at once.

An arc is stored by its start, direction, signed curvature and length, never by centre and radius:
these lose their digits where the radius is large, and a straight line has none. With
h = k t / 2, the point at arc length t is p0 + t sinc(h) (cos(angle + h), sin(angle + h)), stable
as k goes to nil. Positive curvature turns left.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.arcs import Arcs
>>> quarter = Arcs.make([[0, 0]], [0.0], [0.5], [np.pi])
>>> quarter.ends().round(12).tolist()
[[2.0, 2.0]]
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import finite
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["Arcs", "sinc"]

_STRAIGHT = 1e-290
"""A turn (rad) below this has lost digits of its own."""


def sinc(h: ArrayLike) -> FloatArray:
    """Give sin(h) / h, 1 at nil; h in rad.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.arcs import sinc
    >>> sinc([0.0, 1e-9]).tolist()
    [1.0, 1.0]
    """
    found: FloatArray = np.sinc(np.asarray(h, np.float64) / np.pi)
    return found


@attrs.frozen(eq=False)
class Arcs:
    """Arcs and straight lines of a plane.

    Attributes
    ----------
    start : (n, 2), m
        Where each begins.
    angle : (n,), rad
        Direction at the start, from the first axis to the left.
    curvature : (n,), 1/m
        Positive turns left; 0 is a straight line.
    length : (n,), m
        Above 0.
    """

    start: FloatArray
    angle: FloatArray
    curvature: FloatArray
    length: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.angle, self.curvature, self.length)

    def __len__(self) -> int:
        return len(self.angle)

    @classmethod
    def make(
        cls, start: ArrayLike, angle: ArrayLike, curvature: ArrayLike, length: ArrayLike
    ) -> Self:
        """Check what is handed in; arguments as the attributes.

        Raises
        ------
        GeometryError
            Numbers that are not finite, of other counts, or a length that is not above 0.
        """
        first = finite(start, "arcs", (None, 2))
        angles, bends, lengths = (
            finite(each, "arcs", (len(first),)) for each in (angle, curvature, length)
        )
        bad = np.flatnonzero(lengths <= 0.0)
        if len(bad):
            raise GeometryError(
                f"arcs: length {lengths[bad[0]]:g} at index {bad[0]}", "give lengths above 0",
                {"index": int(bad[0]), "length": float(lengths[bad[0]])},
            )  # fmt: skip
        return cls(first, angles, bends, lengths)

    @classmethod
    def through(cls, start: ArrayLike, end: ArrayLike, curvature: ArrayLike) -> Self:
        """Give the minor arcs between pairs of points, of given signed curvatures.

        Parameters
        ----------
        start, end : (n, 2), m
            Pairs of points, not coincident.
        curvature : (n,), 1/m
            With abs(curvature) chord / 2 below 1; 0 gives the chord.

        Raises
        ------
        GeometryError
            No such circle, or coincident points.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.arcs import Arcs
        >>> arc = Arcs.through([[0, 0]], [[2, 2]], [0.5])
        >>> float(arc.length[0].round(6)), float(arc.angle[0].round(6)) + 0.0
        (3.141593, 0.0)
        """
        first = finite(start, "arcs", (None, 2))
        last = finite(end, "arcs", first.shape)
        bends = finite(curvature, "arcs", (len(first),))
        step = last - first
        chord = np.hypot(step[:, 0], step[:, 1])
        if (chord == 0.0).any():
            index = int(np.argmin(chord))
            what, told = f"arcs: coincident points at index {index}", {"index": index}
            raise GeometryError(what, "leave one of them out", told)
        sine = 0.5 * bends * chord
        if (np.abs(sine) >= 1.0).any():
            index = int(np.argmax(np.abs(sine)))
            what = f"arcs: curvature {bends[index]:g} over a chord of {chord[index]:g}"
            raise GeometryError(what, "give a radius above half the chord", {"index": index})
        half = np.arcsin(sine)
        return cls(first, np.arctan2(step[:, 1], step[:, 0]) - half, bends, chord / sinc(half))

    def at(self, arc: IntArray, t: ArrayLike) -> FloatArray:
        """Give points at arc lengths `t` (k,), m, of the arcs numbered `arc` (k,): (k, 2), m."""
        along = np.asarray(t, np.float64)
        half = 0.5 * self.curvature[arc] * along
        chord, way = along * sinc(half), self.angle[arc] + half
        return np.asarray(
            self.start[arc] + np.stack([chord * np.cos(way), chord * np.sin(way)], axis=-1)
        )

    def direction(self, arc: IntArray, t: ArrayLike) -> FloatArray:
        """Give directions (rad), not wrapped, at arc lengths `t` (k,), m."""
        return np.asarray(self.angle[arc] + self.curvature[arc] * np.asarray(t, np.float64))

    def ends(self) -> FloatArray:
        """Give where each ends, (n, 2), m."""
        return self.at(np.arange(len(self)), self.length)

    def end_angles(self) -> FloatArray:
        """Give the direction at the end of each, (n,), rad."""
        return self.direction(np.arange(len(self)), self.length)

    def centres(self) -> FloatArray:
        """Give centres for output, (n, 2), m; infinite for straight lines."""
        with np.errstate(divide="ignore", invalid="ignore"):
            radius = 1.0 / self.curvature
            normal = np.stack([-np.sin(self.angle), np.cos(self.angle)], axis=1)
            centre = self.start + normal * radius[:, None]
        return np.asarray(np.where(np.isfinite(radius)[:, None], centre, np.inf))

    def distance(self, arc: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of each point (k, 2) from one arc each, (k,).

        Beyond its ends an arc is as far as the nearer of them.
        """
        bend, length = self.curvature[arc], self.length[arc]
        away = points - self.start[arc]
        cosine, sine = np.cos(self.angle[arc]), np.sin(self.angle[arc])
        along = cosine * away[:, 0] + sine * away[:, 1]
        left = cosine * away[:, 1] - sine * away[:, 0]
        on = self._abreast(bend, length, along, left)
        # How far off the circle a point is follows without the centre, for a straight line too.
        root = np.hypot(bend * along, 1.0 - bend * left)
        off = np.abs(bend * (along * along + left * left) - 2.0 * left) / (1.0 + root)
        far = np.hypot(*away.T)
        last = np.hypot(*(points - self.at(arc, length)).T)
        return np.asarray(np.where(on, off, np.minimum(far, last)))

    @staticmethod
    def _abreast(
        bend: FloatArray, length: FloatArray, along: FloatArray, left: FloatArray
    ) -> NDArray[np.bool_]:
        """Whether the foot on the circle lies on the arc, seen in axes of the tangent."""
        turn = np.sign(bend) * np.arctan2(bend * along, 1.0 - bend * left)
        turn = np.where(turn < 0.0, turn + 2.0 * np.pi, turn)
        straight = (along >= 0.0) & (along <= length)
        turned = np.abs(bend) * length
        return np.asarray(np.where(turned < _STRAIGHT, straight, turn <= turned))

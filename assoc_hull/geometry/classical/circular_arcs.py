"""Circular arcs and straight lines as one record, their areas, and circles through points.

`PlaneArcs` holds many arcs by start, direction, signed curvature and length; a straight line has
curvature zero. No centre is stored, because it loses its digits where a radius is large.
`TrueCircle` is the other view, by centre and curvature, for circles that are given by points.
"""

from __future__ import annotations

import math
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.arguments import flag
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import check_magnitude, finite_array
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.circle_fit import fit_circle

__all__ = [
    "PlaneArcs",
    "TrueCircle",
    "arc_area",
    "arc_moment",
    "circle_by_tangent",
    "circle_through",
    "fitted_circle",
    "sinc",
    "tangent_curvature",
]

# --------------------------------------------------------------------------------------
# Arcs and straight lines.
#
# With h = k t / 2, the point at arc length t is p0 + t sinc(h) (cos(angle + h), sin(angle + h)),
# stable as k goes to zero. Positive curvature turns left.

_STRAIGHT = 1e-290
"""rad: a turn below this has lost digits of its own."""


def sinc(h: ArrayLike) -> FloatArray:
    """Give sin(h) / h, 1 at 0; h in rad.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.circular_arcs import sinc
    >>> sinc([0.0, 1e-9]).tolist()
    [1.0, 1.0]
    """
    found: FloatArray = np.sinc(np.asarray(h, np.float64) / np.pi)
    return found


@attrs.frozen(eq=False)
class PlaneArcs:
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
        """Check the arguments, which are as the attributes.

        Raises
        ------
        GeometryError
            Numbers that are not finite, of other counts, or a length that is not above 0.
        """
        first = finite_array(start, "arcs", (None, 2))
        angles, bends, lengths = (
            finite_array(each, "arcs", (len(first),)) for each in (angle, curvature, length)
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
        >>> from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
        >>> arc = PlaneArcs.through([[0, 0]], [[2, 2]], [0.5])
        >>> float(arc.length[0].round(6)), float(arc.angle[0].round(6)) + 0.0
        (3.141593, 0.0)
        """
        first = finite_array(start, "arcs", (None, 2))
        last = finite_array(end, "arcs", first.shape)
        bends = finite_array(curvature, "arcs", (len(first),))
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
        """Tell whether the foot on the circle lies on the arc, seen in axes of the tangent."""
        turn = np.sign(bend) * np.arctan2(bend * along, 1.0 - bend * left)
        turn = np.where(turn < 0.0, turn + 2.0 * np.pi, turn)
        straight = (along >= 0.0) & (along <= length)
        turned = np.abs(bend) * length
        return np.asarray(np.where(turned < _STRAIGHT, straight, turn <= turned))


# --------------------------------------------------------------------------------------
# Areas and moments beside an arc that turns left and rises, as the corner of a deck does.

_GAUSS = np.polynomial.legendre.leggauss(24)
"""Nodes and weights, over a quarter of a circle at most: moments to rounding."""


def arc_area(arc: PlaneArcs, centre: tuple[float, float], level: float) -> float:
    """Give the integral of y dz over one arc up to a level (m), infinite for all of it, m2.

    The arc has positive curvature and rises to at most the top of its circle; `centre` is (y, z).
    """
    radius, first, last = _angles(arc, centre, level)

    def swept(angle: float) -> float:
        sine, cosine = math.sin(angle), math.cos(angle)
        return centre[0] * sine + 0.5 * radius * (angle + sine * cosine)

    return radius * (swept(last) - swept(first))


def arc_moment(arc: PlaneArcs, centre: tuple[float, float], level: float) -> float:
    """Give the integral of y z dz over an arc up to a level (m), m3; arguments as of `arc_area`."""
    radius, first, last = _angles(arc, centre, level)
    node, weight = _GAUSS
    half = 0.5 * (last - first)
    angle = first + half * (1.0 + node)
    y, z = centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)
    return float((y * z * radius * np.cos(angle)) @ weight * half)


def _angles(
    arc: PlaneArcs, centre: tuple[float, float], level: float
) -> tuple[float, float, float]:
    """Give radius, and the polar angles at which the part below a level begins and ends."""
    radius = 1.0 / float(arc.curvature[0])
    first = float(arc.angle[0]) - 0.5 * math.pi
    last = first + float(arc.length[0]) / radius
    height = (level - centre[1]) / radius
    if height <= math.sin(first):
        return radius, first, first
    if height < math.sin(min(last, 0.5 * math.pi)):
        last = math.asin(height)
    return radius, first, last


# --------------------------------------------------------------------------------------
# Circles through points. ``(y - A)^2 + (u - B)^2 = r^2`` is a circle in true lengths only: where u
# is a fraction of a length, go to lengths first. Source: Kim & Chang, "Some Representations of Ship
# Hulls by Mathematical Method for Design and Production", J. SNAK.

_FLAT = 1e-12
"""Sine of the angle between two chords up to which three points are on one line."""


@attrs.frozen(eq=False)
class TrueCircle:
    """A circle in true lengths.

    Attributes
    ----------
    centre : (2,), m
        Its centre.
    curvature : float, 1/m
        Positive where the points, in their order, turn left.
    residual : float, m
        Root mean square of the distances of fitted points; 0 where it passes through them.
    """

    centre: FloatArray
    curvature: float
    residual: float = 0.0

    def __attrs_post_init__(self) -> None:
        freeze(self.centre)

    @property
    def radius(self) -> float:
        """Radius, m."""
        return 1.0 / abs(self.curvature)


def circle_through(p: ArrayLike, q: ArrayLike, r: ArrayLike) -> TrueCircle:
    """Give the circle through three points (2,), m.

    Raises
    ------
    GeometryError
        ``"circle: points are collinear"``.
    """
    first, second, third = (_point(each) for each in (p, q, r))
    a, b, c = second - first, third - first, third - second
    cross = float(a[0] * b[1] - a[1] * b[0])
    square_a, square_b, square_c = (float(each @ each) for each in (a, b, c))
    if abs(cross) <= _FLAT * np.sqrt(square_a * square_b) or square_a * square_b * square_c == 0.0:
        raise _collinear()
    away = np.array([b[1] * square_a - a[1] * square_b, a[0] * square_b - b[0] * square_a])
    bend = 2.0 * cross / float(np.sqrt(square_a * square_b * square_c))
    return TrueCircle(first + away / (2.0 * cross), bend)


def _point(place: ArrayLike) -> FloatArray:
    return check_magnitude(finite_array(place, "circle", (2,)), "circle")


def _collinear() -> GeometryError:
    return GeometryError(
        "circle: points are collinear", "give points off one line, or take a straight line"
    )


def tangent_curvature(start: ArrayLike, direction: ArrayLike, end: ArrayLike) -> float:
    """Give the curvature (1/m) of the arc from a point with its direction to another.

    Parameters
    ----------
    start, end : (2,), m
        Points apart.
    direction : (2,)
        Of the arc at its start, of any length but zero.

    Returns
    -------
    float, 1/m
        Positive to the left; 0 where the end lies straight ahead.

    Raises
    ------
    GeometryError
        Coincident points, or a direction of zero length.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.circular_arcs import tangent_curvature
    >>> round(tangent_curvature([0, 0], [1, 0], [4, 1]), 9)
    0.117647059
    """
    first, way, last = (_point(each) for each in (start, direction, end))
    step, size = last - first, float(np.hypot(*way))
    if size == 0.0 or not step.any():
        raise GeometryError("circle: no direction, or one point twice", "give two points apart")
    return float(2.0 * (way[0] * step[1] - way[1] * step[0]) / size / (step @ step))


def circle_by_tangent(start: ArrayLike, direction: ArrayLike, end: ArrayLike) -> TrueCircle:
    """Give the circle through a point with its direction and another point.

    Parameters
    ----------
    start, direction, end
        As for `tangent_curvature`.

    Raises
    ------
    GeometryError
        ``"circle: points are collinear"`` where the end lies along the direction; and as
        `tangent_curvature`.
    """
    bend = tangent_curvature(start, direction, end)
    first, way, last = (_point(each) for each in (start, direction, end))
    if abs(bend) * float(np.hypot(*(last - first))) <= 2.0 * _FLAT:
        raise _collinear()
    left = np.array([-way[1], way[0]]) / float(np.hypot(*way))
    return TrueCircle(first + left / bend, bend)


def fitted_circle(points: ArrayLike, *, polish: bool = False) -> TrueCircle:
    """Fit a circle by least squares.

    Parameters
    ----------
    points : (n, 2), m
        Three or more, in order.
    polish : bool
        Whether to go on from the least squares of ``r^2``, one linear system, to those of the
        distances from the circle: on a short arc that is scattered the first makes it too small.

    Raises
    ------
    GeometryError
        ``"circle: points are collinear"``, or fewer than three.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.circular_arcs import fitted_circle
    >>> round(fitted_circle([(0, 0), (1, 0.95), (2, 1.35), (3, 1.05), (4, 0.1)]).radius, 9)
    2.213672362
    """
    found = check_magnitude(finite_array(points, "circle", (None, 2)), "circle")
    flag(polish, "polish", "in fitted_circle")
    if len(found) < 3:
        raise GeometryError("circle: at least 3 points", "give more", {"points": len(found)})
    middle = found.mean(axis=0)
    local = found - middle
    spread = np.linalg.svd(local, compute_uv=False)
    if spread[1] <= _FLAT * spread[0]:
        raise _collinear()
    if polish:
        best = fit_circle(found)
        centre, radius = best.centre.copy(), best.radius
    else:
        table = np.column_stack([2.0 * local, np.ones(len(local))])
        known = np.linalg.lstsq(table, (local * local).sum(axis=1), rcond=None)[0]
        centre, radius = middle + known[:2], float(np.sqrt(known[2] + known[:2] @ known[:2]))
    off = np.hypot(*(found - centre).T) - radius
    turn = np.unwrap(np.arctan2(*(found - centre).T[::-1]))
    side = 1.0 if turn[-1] >= turn[0] else -1.0
    return TrueCircle(centre, side / radius, float(np.sqrt((off * off).mean())))

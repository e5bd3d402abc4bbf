"""Plane curves of straight lines and circular arcs, as PRELIKON draws sections and boundaries.

`ArcCurve` is a chain that is evaluated, intersected, cut and measured exactly. `through_points`
passes all points and may turn sharply at each; `round_corners` rounds the corners of a polygon and
passes the ends only. Curvatures are positive where a curve turns left. Source: Kim & Chang, "Some
Representations of Ship Hulls by Mathematical Method for Design and Production", J. SNAK.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, Self, TypeGuard

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, finite_array, wrap_angle
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs, sinc
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "ArcBoundary",
    "ArcCurve",
    "mean_curvatures",
    "round_corners",
    "three_point_curvatures",
    "through_points",
]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
"""Integrals over arcs that turn by up to half a circle are exact to rounding with so many."""

_MOST = 1_000_000
"""More points of a sampled curve than this are a mistake."""

_TOLERANCE = 1e-9
"""Distance of points that are one, as a part of the diagonal of the bounding box."""


@attrs.frozen(eq=False)
class ArcCurve:
    """A chain of lines and arcs, end to end.

    Attributes
    ----------
    arcs : PlaneArcs
        Its pieces, in order.
    points : (n, 2), m
        The given points: the ends of the pieces, or the corners of the polygon.
    name : str
        Of the curve, for messages.
    knuckles : frozenset of int
        Joints that are meant as corners, whatever the angle: 1 between the first two pieces.
    """

    arcs: PlaneArcs
    points: FloatArray
    name: str = "section"
    knuckles: frozenset[int] = frozenset()

    def __attrs_post_init__(self) -> None:
        freeze(self.points)

    @property
    def length(self) -> float:
        """Of all pieces, m."""
        return float(self.arcs.length.sum())

    @property
    def tolerance(self) -> float:
        """Places nearer than this (m) are one: 1e-9 of the diagonal of the given points."""
        return _TOLERANCE * float(np.hypot(*np.ptp(self.points, axis=0)))

    @property
    def starts(self) -> FloatArray:
        """Arc lengths (m) at which the pieces begin, and the end, (pieces + 1,)."""
        return np.concatenate([[0.0], np.cumsum(self.arcs.length)])

    def joints(self) -> FloatArray:
        """Give the ends of the pieces, (pieces + 1, 2), m."""
        return np.vstack([self.arcs.start, self.arcs.ends()[-1:]])

    def turns(self) -> FloatArray:
        """Give by how much (rad) the tangent jumps at the joints between pieces, left positive."""
        return wrap_angle(self.arcs.angle[1:] - self.arcs.end_angles()[:-1])

    def at(self, s: ArrayLike) -> FloatArray:
        """Give points (..., 2), m, at arc lengths `s` (m) from the start, of any shape.

        Raises
        ------
        GeometryError
            An arc length outside the curve.
        """
        asked = finite_array(s, self.name, None)
        starts = self.starts
        if ((asked < -self.tolerance) | (asked > starts[-1] + self.tolerance)).any():
            far = float(asked.flat[np.argmax(np.abs(asked - 0.5 * starts[-1]))])
            raise GeometryError(
                f"{self.name}: s={digits(far)} outside [0, {digits(starts[-1])}]",
                "ask between these", {"s": far},
            )  # fmt: skip
        piece = np.clip(np.searchsorted(starts, asked, "right") - 1, 0, len(self.arcs) - 1)
        return self.arcs.at(piece, asked - starts[piece])

    def sampled(self, most: float) -> FloatArray:
        """Give points (k, 2), m, on the curve, its joints among them, none farther than `most`.

        Raises
        ------
        GeometryError
            A step that is not above 0, or that makes more than a million points.
        """
        step = float(finite_array(most, self.name, ()))
        if not step > 0.0:
            raise GeometryError(f"{self.name}: step {digits(step)}", "give one above 0")
        if self.length / step > _MOST:
            what = f"{self.name}: step {digits(step)} for a length of {digits(self.length)}"
            raise GeometryError(what, f"give one of at least {digits(self.length / _MOST)}")
        count = np.maximum(np.ceil(self.arcs.length / step), 1).astype(np.int64)
        piece = np.repeat(np.arange(len(count)), count)
        within = np.arange(len(piece)) - np.repeat(np.cumsum(count) - count, count)
        inner = self.arcs.at(piece, within * (self.arcs.length / count)[piece])
        return np.vstack([inner, self.arcs.ends()[-1:]])

    def meet(self, axis: int, value: float) -> tuple[IntArray, FloatArray]:
        """Intersect the curve with a line parallel to an axis: all places, in order along it.

        Parameters
        ----------
        axis : int
            0 or 1: which coordinate.
        value : float, m
            Its value.

        Returns
        -------
        piece, t
            Numbers of pieces, and arc lengths (m) from their starts. A piece that lies in
            that line gives both its ends; a joint comes once.

        Raises
        ------
        GeometryError
            Another axis, or a value that is no finite number.
        """
        if shown(axis) not in ("0", "1"):
            what = f"{self.name}: axis is {shown(axis)}"
            raise GeometryError(what, "use 0 or 1", {"axis": axis})
        arcs, slack, value = self.arcs, self.tolerance, float(finite_array(value, self.name, ()))
        every = np.arange(len(arcs))
        # t = 2 atan(k p) / k, and k (cos a - k d / 2) p^2 + sin a p - d / 2 = 0: no digits are
        # lost as k goes to zero. For axis 0 the curve is turned by a right angle.
        turned = arcs.angle if axis == 1 else arcs.angle + 0.5 * np.pi
        away = value - arcs.start[:, axis]
        square = arcs.curvature * (np.cos(turned) - 0.5 * arcs.curvature * away)
        linear = np.sin(turned)
        roots = _roots(square, linear, -0.5 * away)
        bend = np.where(arcs.curvature == 0.0, 1.0, arcs.curvature)[:, None]
        t = np.where(
            arcs.curvature[:, None] == 0.0, 2.0 * roots, 2.0 * np.arctan(bend * roots) / bend
        )
        # Ends are compared themselves: rounding must not let a joint slip between its pieces.
        ends = np.column_stack([np.zeros(len(every)), arcs.length])
        at_ends = np.stack([arcs.start[:, axis], arcs.ends()[:, axis]], axis=1)
        ends = np.where(np.abs(at_ends - value) <= slack, ends, np.nan)
        t = np.concatenate([t, ends], axis=1)
        found = np.isfinite(t) & (t >= -slack) & (t <= arcs.length[:, None] + slack)
        piece, column = np.nonzero(found)
        along = np.clip(t[piece, column], 0.0, arcs.length[piece])
        return self._sort_distinct(piece, along)

    def where(self, axis: int, value: float) -> FloatArray:
        """Give all points (k, 2), m, at which a coordinate has a value, sorted by the other.

        Parameters
        ----------
        axis : int
            0 or 1: which coordinate.
        value : float, m
            Its value.

        Raises
        ------
        GeometryError
            Another axis, or a value that is no finite number.
        """
        points = self.arcs.at(*self.meet(axis, value))
        points[:, axis] = value
        points = points[np.argsort(points[:, 1 - axis], kind="stable")]
        apart = np.ones(len(points), bool)
        apart[1:] = np.diff(points[:, 1 - axis]) > self.tolerance
        return points[apart]

    def cut(self, piece: int, t: float) -> ArcCurve:
        """Give what lies before a place: piece number, arc length (m) from its start.

        Raises
        ------
        GeometryError
            A place that is not on the curve, or its very start.
        """
        arcs, t = self.arcs, float(finite_array(t, self.name, ()))
        if (
            shown(piece) not in map(str, range(len(arcs)))
            or t > arcs.length[piece] + self.tolerance
        ):
            what = f"{self.name}: no place {digits(t)} m along piece {shown(piece)}"
            raise GeometryError(what, f"there are {len(arcs)} pieces, from 0")
        if piece == 0 and t <= self.tolerance:
            raise GeometryError(f"{self.name}: nothing lies before its start", "cut it farther on")
        count = piece + 1 if t > self.tolerance or piece == 0 else piece
        length = arcs.length[:count].copy()
        if count == piece + 1:
            length[-1] = t
        part = PlaneArcs(arcs.start[:count].copy(), arcs.angle[:count].copy(),
                    arcs.curvature[:count].copy(), length)  # fmt: skip
        return attrs.evolve(self, arcs=part, points=self.points.copy())

    def moments_below(self, level: float) -> tuple[float, float, float]:
        """Integrate between the second axis and the curve, below a level of the second coordinate.

        Parameters
        ----------
        level : float, m
            Infinite for all of the curve.

        Returns
        -------
        area, first, second : m2, m3, m3
            Integrals of u dv, u^2/2 dv and u v dv, for the curve (u, v): positive where the
            curve runs upward with u above 0. Exact: with arcs, not with polygons.

        Raises
        ------
        GeometryError
            A level that is no number.
        """
        arcs = self.arcs
        piece, low, high = np.arange(len(arcs)), np.zeros(len(arcs)), arcs.length
        if shown(level) not in ("inf", "np.float64(inf)"):
            level = float(finite_array(level, self.name, ()))
            piece, low, high = self._parts(level)
        # A part between two intersections lies on one side of the level, so its middle tells which.
        middle = arcs.at(piece, 0.5 * (low + high))
        under = middle[:, 1] < level
        piece, low, high = piece[under], low[under], high[under]
        half = 0.5 * (high - low)
        t = low[:, None] + half[:, None] * (1.0 + _NODES)
        every = np.repeat(piece, len(_NODES))
        u, v = arcs.at(every, t.ravel()).T.reshape(2, *t.shape)
        rise = np.sin(arcs.direction(every, t.ravel())).reshape(t.shape)
        weight = half[:, None] * _WEIGHTS * rise
        return (
            float((u * weight).sum()),
            float((0.5 * u * u * weight).sum()),
            float((u * v * weight).sum()),
        )

    def _parts(self, level: float) -> tuple[IntArray, FloatArray, FloatArray]:
        """Cut pieces at their intersections with a level: number of the piece, from, to (m)."""
        piece, along = self.meet(1, level)
        every = np.arange(len(self.arcs))
        number = np.concatenate([every, every, piece])
        place = np.concatenate([np.zeros(len(every)), self.arcs.length, along])
        order = np.lexsort([place, number])
        number, place = number[order], place[order]
        same = (number[1:] == number[:-1]) & (place[1:] > place[:-1])
        return number[:-1][same], place[:-1][same], place[1:][same]

    def _sort_distinct(self, piece: IntArray, t: FloatArray) -> tuple[IntArray, FloatArray]:
        """Sort places along the curve, and keep one of those that are the same point."""
        s = self.starts[piece] + t
        order = np.argsort(s, kind="stable")
        s, piece, t = s[order], piece[order], t[order]
        new = np.ones(len(s), bool)
        new[1:] = np.diff(s) > 4.0 * self.tolerance
        return piece[new], t[new]


def _roots(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Solve a p^2 + b p + c = 0, (n, 2); nan where there is no root, inf for one far away."""
    disc = b * b - 4.0 * a * c
    # An arc that misses the line by no more than rounding touches it.
    disc = np.where((disc < 0.0) & (disc > -1e-14), 0.0, disc)
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(disc)
        sum_ = -0.5 * (b + np.where(b < 0.0, -root, root))
        return np.stack([c / sum_, sum_ / a], axis=1)


# --------------------------------------------------------------------------------------
# Curves through points, or round the corners of a polygon.

_STRAIGHT = 1e-12
"""A curvature times a chord below this is a line."""

_ROUNDING = 1e-12
"""A radius may be smaller than half its chord by this part."""


def three_point_curvatures(points: ArrayLike, *, name: str = "section") -> FloatArray:
    """Give the signed curvature (1/m) of the circle through each three points in a row, (n - 2,).

    Left turns are positive; 0 where three points are in line. `points` are (n, 2), m, in order.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.arc_curve import three_point_curvatures
    >>> three_point_curvatures([(1, 0), (0, 1), (-1, 0)]).round(12).tolist()
    [1.0]
    """
    given = _points(points, name)
    step, across = np.diff(given, axis=0), given[2:] - given[:-2]
    length, base = np.hypot(*step.T), np.hypot(*across.T)
    cross = step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]
    back = np.flatnonzero(base == 0.0)
    if len(back):
        raise _coincident(name, int(back[0]), int(back[0]) + 2)
    return np.asarray(2.0 * cross / (length[:-1] * length[1:] * base))


def mean_curvatures(
    points: ArrayLike, knuckles: Collection[int] = (), *, name: str = "section"
) -> FloatArray:
    """Give the curvature (1/m) of the mean circle of each interval, (n - 1,).

    It is the mean of the curvatures of the circles through three points at its two ends; at an
    end of the curve and at a knuckle (an index of `points`, (n, 2), m) the one that there is, 0
    where there is none. The mean is that of curvatures, not of radii: so it is known for points in
    line and at inflections, and it is exact on circles. The rule of Kim & Chang, "Some
    Representations of Ship Hulls by Mathematical Method for Design and Production", J. SNAK, as it
    is read here.
    """
    given = _points(points, name)
    at = np.full(len(given), np.nan)
    at[1:-1] = three_point_curvatures(given, name=name)
    at[_indices(knuckles, len(given), name)] = np.nan
    known = np.isfinite(at)
    value = np.where(known, at, 0.0)
    count = np.maximum(known[:-1].astype(np.int64) + known[1:], 1)
    return np.asarray((value[:-1] + value[1:]) / count)


def through_points(
    points: ArrayLike,
    *,
    kind: str | Sequence[str] = "arc",
    radius: Sequence[float | None] | None = None,
    knuckles: Collection[int] = (),
    name: str = "section",
) -> ArcCurve:
    """Give the curve through points (C0), a line or a minor arc in each interval.

    Parameters
    ----------
    points : (n, 2), m
        (y, z) of a transverse section, (x, z) of a boundary curve.
    kind : {"line", "arc"} or sequence of such
        Of all intervals, or of each.
    radius : sequence of (float or None), m, optional
        Of each interval, positive where it turns left; None for the mean circle.
    knuckles : collection of int
        Indices of points at which the mean circles of the two sides do not know each other.
    name : str
        For messages.

    Returns
    -------
    ArcCurve
        Keeps the points; circles and lines are reproduced.

    Raises
    ------
    GeometryError
        ``"section: radius {R} smaller than half the chord {l/2} at interval {i}"``;
        ``"section: mean circle at interval {i} has |K| l/2 >= 1"``;
        ``"section: coincident points {i},{i+1}"``; kinds or radii that do not fit the points.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.arc_curve import through_points
    >>> bilge = through_points([(0, 0), (8, 0), (10, 2), (10, 9)],
    ...                        kind=["line", "arc", "line"], radius=[None, 2.0, None])
    >>> round(bilge.moments_below(9.0)[0], 9)
    89.141592654
    """
    given = _points(points, name)
    kinds, radii = _kinds(kind, len(given) - 1, name), _radii(radius, len(given) - 1, name)
    step = np.diff(given, axis=0)
    chord, way = np.hypot(*step.T), np.arctan2(step[:, 1], step[:, 0])
    arc = np.array([each == "arc" for each in kinds])
    free = arc & np.isnan(radii)
    mean = mean_curvatures(given, knuckles, name=name) if free.any() else np.zeros(len(chord))
    with np.errstate(divide="ignore"):
        bend = np.where(free, mean, np.where(arc, 1.0 / radii, 0.0))
    sine = 0.5 * bend * chord
    _require_circles(sine, free, radii, chord, name)
    bend = np.where(np.abs(2.0 * sine) < _STRAIGHT, 0.0, bend)
    # The tangent of an arc leaves its chord by half the angle it turns by, to the outside.
    half = np.arcsin(np.clip(0.5 * bend * chord, -1.0, 1.0))
    arcs = PlaneArcs(given[:-1].copy(), way - half, bend, chord / sinc(half))
    return ArcCurve(arcs, given, name, frozenset(_indices(knuckles, len(given), name)))


def round_corners(
    points: ArrayLike, *, radius: Sequence[float | None] | None = None, name: str = "section"
) -> ArcCurve:
    """Give the polygon of the points with its corners rounded: tangents without a jump (G1).

    The points between the ends are left, but where the curve runs straight on.

    Parameters
    ----------
    points : (n, 2), m
        Corners of the polygon.
    radius : sequence of (float or None), m, optional
        Of the n - 2 corners, positive where they turn left; None for the largest that uses
        half of the shorter leg.
    name : str
        For messages.

    Raises
    ------
    GeometryError
        ``"section: fillets {i} and {j} overlap"`` (by index of points; the ends count as fillets
        of no length); coincident points; a radius that turns to the other side.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.arc_curve import round_corners
    >>> curve = round_corners([(0, 0), (10, 0), (12, 6)], radius=[2.5])
    >>> curve.arcs.centres()[1].round(8).tolist()
    [8.19810195, 2.5]
    """
    given = _points(points, name)
    step = np.diff(given, axis=0)
    legs, way = np.hypot(*step.T), np.arctan2(step[:, 1], step[:, 0])
    turn = wrap_angle(np.diff(way))
    radii = _radii(radius, len(given) - 2, name)
    reach = np.zeros(len(given))
    reach[1:-1] = _reaches(radii, turn, legs, name)
    over = np.flatnonzero(reach[:-1] + reach[1:] > legs * (1.0 + _ROUNDING))
    if len(over):
        i = int(over[0])
        raise GeometryError(
            f"{name}: fillets {i} and {i + 1} overlap",
            f"their tangents of {digits(reach[i])} and {digits(reach[i + 1])} have "
            f"{digits(legs[i])}: give smaller radii",
            {"i": i, "j": i + 1},
        )  # fmt: skip
    return ArcCurve(_rounded(given, legs, way, turn, reach), given, name)


def _rounded(
    given: FloatArray, legs: FloatArray, way: FloatArray, turn: FloatArray, reach: FloatArray
) -> PlaneArcs:
    """Give straight pieces and fillets in turn, without those of no length."""
    along = np.stack([np.cos(way), np.sin(way)], axis=1)
    straight = np.maximum(legs - reach[:-1] - reach[1:], 0.0)
    inner = reach[1:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = np.where(inner > 0.0, np.tan(0.5 * turn) / inner, 0.0)
        round_ = np.where(inner > 0.0, turn / bend, 0.0)
    count = 2 * len(legs) - 1
    start, angle = np.empty((count, 2)), np.empty(count)
    curvature, length = np.zeros(count), np.empty(count)
    start[::2] = given[:-1] + along * reach[:-1, None]
    start[1::2] = given[1:-1] - along[:-1] * inner[:, None]
    angle[::2], angle[1::2] = way, way[:-1]
    curvature[1::2] = bend
    length[::2], length[1::2] = straight, round_
    keep = length > 1e-12 * float(legs.max())
    return PlaneArcs(start[keep], angle[keep], curvature[keep], length[keep])


def _reaches(radii: FloatArray, turn: FloatArray, legs: FloatArray, name: str) -> FloatArray:
    """Give the tangent length (m) of each corner; half the shorter leg where no radius is given."""
    wrong = np.flatnonzero((np.abs(turn) > _STRAIGHT) & (radii * turn < 0.0))
    if len(wrong):
        corner = int(wrong[0]) + 1
        raise GeometryError(
            f"{name}: radius {digits(radii[wrong[0]])} turns against the corner at point {corner}",
            "change its sign", {"point": corner},
        )  # fmt: skip
    back = np.flatnonzero(np.abs(turn) > np.pi - 1e-9)
    if len(back):
        corner = int(back[0]) + 1
        what = f"{name}: the polygon turns back on itself at point {corner}"
        raise GeometryError(what, "leave the point out", {"point": corner})
    half = 0.5 * np.minimum(legs[:-1], legs[1:])
    asked = np.abs(radii) * np.tan(0.5 * np.abs(turn))
    reach = np.where(np.isnan(radii), half, asked)
    return np.asarray(np.where(np.abs(turn) <= _STRAIGHT, 0.0, reach))


def _require_circles(
    sine: FloatArray,
    free: np.typing.NDArray[np.bool_],
    radii: FloatArray,
    chord: FloatArray,
    name: str,
) -> None:
    over = np.abs(sine) > np.where(free, 1.0 - 1e-15, 1.0 + _ROUNDING)
    if not over.any():
        return
    i = int(np.argmax(over))
    if free[i]:
        raise GeometryError(
            f"{name}: mean circle at interval {i} has |K| l/2 >= 1",
            "give a radius there, a knuckle, or a point between", {"interval": i},
        )  # fmt: skip
    raise GeometryError(
        f"{name}: radius {digits(radii[i])} smaller than half the chord {digits(0.5 * chord[i])} "
        f"at interval {i}",
        "give a larger one", {"radius": float(radii[i]), "interval": i},
    )  # fmt: skip


def _points(points: ArrayLike, name: str) -> FloatArray:
    given = finite_array(points, name, (None, 2))
    if len(given) < 2:
        what = f"{name}: expected shape (n >= 2, 2), got {given.shape}"
        raise GeometryError(what, "give two points or more", {"got": given.shape})
    same = np.flatnonzero((np.diff(given, axis=0) == 0.0).all(axis=1))
    if len(same):
        raise _coincident(name, int(same[0]), int(same[0]) + 1)
    return given


def _coincident(name: str, i: int, j: int) -> GeometryError:
    return GeometryError(
        f"{name}: coincident points {i},{j}", "leave one of them out", {"i": i, "j": j}
    )


def _kinds(kind: object, count: int, name: str) -> list[str]:
    found: list[Any] = [kind] * count if isinstance(kind, str) else []
    if _listed(kind):
        found = list(kind)
    bad = [each for each in found if shown(each) not in ("'line'", "'arc'")]
    if bad or len(found) != count:
        what = f"{name}: kind is {shown(kind)}"
        raise GeometryError(what, f'give "line" or "arc" for {count} interval(s)')
    return found


def _radii(radius: object, count: int, name: str) -> FloatArray:
    """Give radii, nan where there is none."""
    if radius is None:
        return np.full(count, np.nan)
    if not _listed(radius) or len(radius) != count:
        what = f"{name}: radius is {shown(radius)}"
        raise GeometryError(what, f"give a list of {count}, None where there is none")
    given = [each is not None for each in radius]
    found = np.full(count, np.nan)
    found[given] = finite_array([each for each in radius if each is not None], name, (None,))
    if (found == 0.0).any():
        index = int(np.argmax(found == 0.0))
        what = f"{name}: radius 0 at interval {index}"
        raise GeometryError(what, "leave it out, or give a knuckle", {"interval": index})
    return found


def _indices(knuckles: object, count: int, name: str) -> list[int]:
    found: list[Any] = [None]
    if _listed(knuckles) or isinstance(knuckles, set | frozenset):
        found = list(knuckles)
    if any(isinstance(k, bool) or not isinstance(k, int) or not 0 <= k < count for k in found):
        what = f"{name}: knuckles are {shown(knuckles)}"
        raise GeometryError(what, f"give indices of points, 0 to {count - 1}")
    return found


def _listed(value: object) -> TypeGuard[Sequence[Any]]:
    return isinstance(value, list | tuple) or (isinstance(value, np.ndarray) and value.ndim > 0)


@attrs.frozen(eq=False)
class ArcBoundary:
    """A curve (x, z) in any direction of travel; x may turn back.

    The boundary curve of the PRELIKON system in Kim & Chang, "Some Representations of Ship
    Hulls by Mathematical Method for Design and Production", J. SNAK.

    Attributes
    ----------
    name : str
        "stern", "stem" ..., for messages.
    curve : ArcCurve
        Its lines and arcs, m.
    y : float, m
        Of the plane it lies in; 0 is the centre line.
    """

    name: str
    curve: ArcCurve
    y: float = 0.0

    @property
    def length(self) -> float:
        """Along the curve, m."""
        return self.curve.length

    def x(self, z: float) -> FloatArray:
        """Give x (k,), m, of all intersections with a height (m), sorted.

        Raises
        ------
        GeometryError
            ``"boundary {name}: does not reach z={z}"``.
        """
        return self._all(1, z)

    def z(self, x: float) -> FloatArray:
        """Give z (k,), m, of all intersections with a plane x (m), sorted.

        Raises
        ------
        GeometryError
            ``"boundary {name}: does not reach x={x}"``.
        """
        return self._all(0, x)

    def _all(self, axis: int, value: float) -> FloatArray:
        found = self.curve.where(axis, value)[:, 1 - axis]
        if not len(found):
            letter = "xz"[axis]
            raise GeometryError(
                f"boundary {self.name}: does not reach {letter}={digits(value)}",
                "extend it, or ask elsewhere", {letter: float(value)},
            )  # fmt: skip
        return np.asarray(found)

    def moved(self, by: float) -> Self:
        """Give the same curve with `by` (m) added to every x."""
        step = float(finite_array(by, f"boundary {self.name}", ()))
        arcs, shift = self.curve.arcs, np.array([step, 0.0])
        moved = PlaneArcs(
            arcs.start + shift, arcs.angle.copy(), arcs.curvature.copy(), arcs.length.copy()
        )
        curve = attrs.evolve(self.curve, arcs=moved, points=self.curve.points + shift)
        return attrs.evolve(self, curve=curve)

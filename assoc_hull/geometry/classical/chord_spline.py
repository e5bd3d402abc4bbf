"""The mechanical spline: a batten on supports, its deflection measured from each chord.

Its bending moment is continuous at the supports and linear between them. As the deflection is
measured from the chord of each interval, only the slope to the chord must be small; the curve may
turn by any angle in all. Splines are solved many at once, lengths in m, angles in rad. Source: Kim
& Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and Production",
J. SNAK, eqs 1 to 7.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Literal, Self, cast

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import LinAlgError, solve_banded

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import (
    check_magnitude,
    digits,
    finite_array,
    one_of,
    within_range,
    wrap_angle,
)
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner, unit_roots
from assoc_hull.geometry.splines.segments import (
    derivative,
    evaluate,
    plane_curvature,
    power_coefficients,
)

__all__ = [
    "ChordSpline",
    "Chords",
    "CoordinateIntersections",
    "Mode",
    "check_clamps",
    "check_slopes",
    "check_turns",
    "checked_points",
    "chord_slopes",
    "chord_splines",
    "clamp_direction",
    "curve_label",
    "make_chords",
    "solve_directions",
]

# --------------------------------------------------------------------------------------
# Directions at the points. On chord i, of length l, let m0 and m1 be the slopes of the spline to
# the chord at its ends. Moments over the stiffness are Ms = -(4 m0 + 2 m1) / l at its start and
# Me = (2 m0 + 4 m1) / l at its end. At an inner point the moments of both chords agree, or the
# curvatures, Me / (1 + m1^2)^1.5 and Ms / (1 + m0^2)^1.5. A free end has no moment, a clamped one
# a given direction. The slopes are tangents of angles, so this is not linear, but each equation
# knows its neighbours only. Many splines are solved as one system: nothing couples them, and each
# has the same bits as alone.

Mode = Literal["moment", "curvature"]

_MOST_STEP = 0.3  # rad: the most that a direction turns in one step
_AGREED = 1e-13  # rad: a step below this ends the search
_MOST_STEPS = 50


@attrs.frozen(eq=False)
class Chords:
    """Chords of many splines, one behind the other.

    Attributes
    ----------
    start : (m + 1,) int
        Where the points of each spline begin; the last entry is n.
    owner : (n,) int
        The spline that each point belongs to.
    begin : (c,) int
        The point at which each chord begins; it ends at the next.
    length : (c,), m
        Of the chords.
    angle : (c,), rad
        Their directions, unwrapped along each spline.
    clamp : (m, 2), rad
        Directions given at both ends; nan where an end is free.
    """

    start: IntArray
    owner: IntArray
    begin: IntArray
    length: FloatArray
    angle: FloatArray
    clamp: FloatArray

    @property
    def ends(self) -> tuple[IntArray, IntArray]:
        """First and last point of each spline, (m,) each."""
        return self.start[:-1], self.start[1:] - 1


def chord_slopes(chords: Chords, phi: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the slopes to each chord at its start and end, (c,) each, for directions `phi` (n,)."""
    at = chords.begin
    return np.tan(phi[at] - chords.angle), np.tan(phi[at + 1] - chords.angle)


def solve_directions(chords: Chords, mode: Mode) -> FloatArray:
    """Find the directions at all points, (n,), rad, by Newton's rule on one banded system.

    `mode` says what is continuous at inner points. Raises GeometryError where it does not converge.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.chord_spline import Chords, solve_directions
    >>> free = np.full((1, 2), np.nan)
    >>> zero = np.zeros(3, int)
    >>> up_and_down = Chords(
    ...     np.array([0, 3]), zero, np.array([0, 1]), np.ones(2), np.array([0.2, -0.2]), free
    ... )
    >>> phi = solve_directions(up_and_down, "curvature")
    >>> float(phi[1]) + 0.0, bool(phi[0] > 0.2)
    (0.0, True)
    """
    phi = _first_guess(chords)
    alive = np.ones(len(chords.start) - 1, np.bool_)
    scale = np.maximum(1.0, np.maximum.reduceat(np.abs(phi), chords.start[:-1]))
    for _ in range(_MOST_STEPS):
        step = _step(chords, phi, mode)
        size = np.maximum.reduceat(np.abs(step), chords.start[:-1])
        # A spline that has settled stays: its bits must not depend on its neighbours.
        factor = np.where(alive, np.minimum(1.0, _MOST_STEP / np.maximum(size, _AGREED)), 0.0)
        phi = phi + factor[chords.owner] * step
        alive &= ~(size <= _AGREED * scale)
        if not alive.any():
            return phi
    raise _no_convergence(int(np.argmax(alive)))


def _no_convergence(spline: int) -> GeometryError:
    return GeometryError(
        "spline: Newton did not converge", "give points closer together, or other end directions",
        {"spline": spline},
    )  # fmt: skip


def _first_guess(chords: Chords) -> FloatArray:
    """Give about the directions of circles through three points; free ends mirror theirs."""
    first, last = chords.ends
    phi = np.zeros(len(chords.owner))
    inner = _inner(chords)
    # Each spline has one chord fewer than points, so numbers of chords lag by those before it.
    before, after = inner - chords.owner[inner] - 1, inner - chords.owner[inner]
    length, angle = chords.length, chords.angle
    phi[inner] = (length[after] * angle[before] + length[before] * angle[after]) / (
        length[before] + length[after]
    )
    # Of a spline of one chord both ends lie on it: their neighbour is no inner point.
    opening, closing = _end_chords(chords)
    lone = last - first == 1
    phi[first] = np.where(lone, angle[opening], 2.0 * angle[opening] - phi[first + 1])
    phi[last] = np.where(lone, angle[closing], 2.0 * angle[closing] - phi[last - 1])
    phi[first] = np.where(np.isnan(chords.clamp[:, 0]), phi[first], chords.clamp[:, 0])
    phi[last] = np.where(np.isnan(chords.clamp[:, 1]), phi[last], chords.clamp[:, 1])
    return phi


def _inner(chords: Chords) -> IntArray:
    is_end = np.zeros(len(chords.owner), np.bool_)
    is_end[chords.start[:-1]] = True
    is_end[chords.start[1:] - 1] = True
    return np.flatnonzero(~is_end)


def _end_chords(chords: Chords) -> tuple[IntArray, IntArray]:
    """Give the first and the last chord of each spline."""
    first, last = chords.ends
    number = np.arange(len(first))
    return first - number, last - number - 1


def _step(chords: Chords, phi: FloatArray, mode: Mode) -> FloatArray:
    """Give one step of Newton's rule, (n,), rad."""
    residual, table = _equations(chords, phi, mode)
    try:
        with np.errstate(all="ignore"):
            found = np.asarray(solve_banded((1, 1), table, -residual, check_finite=False))
    except LinAlgError:
        raise _no_convergence(0) from None
    if not np.isfinite(found).all():
        raise _no_convergence(int(chords.owner[np.argmin(np.isfinite(found))]))
    return found


def _equations(chords: Chords, phi: FloatArray, mode: Mode) -> tuple[FloatArray, FloatArray]:
    """Give the residual of each equation, (n,), and its derivatives as bands, (3, n)."""
    residual, table = np.zeros(len(phi)), np.zeros((3, len(phi)))
    m0, m1 = chord_slopes(chords, phi)
    turn0, turn1 = 1.0 + m0 * m0, 1.0 + m1 * m1
    start, by0_start, by1_start = _bend(m0, m1, chords.length, mode)
    # Seen from its end a chord bends the other way.
    end, by1_end, by0_end = (-each for each in _bend(m1, m0, chords.length, mode))
    inner = _inner(chords)
    before, after = inner - chords.owner[inner] - 1, inner - chords.owner[inner]
    residual[inner] = end[before] - start[after]
    table[2, inner - 1] = (by0_end * turn0)[before]
    table[1, inner] = (by1_end * turn1)[before] - (by0_start * turn0)[after]
    table[0, inner + 1] = -(by1_start * turn1)[after]
    first, last = chords.ends
    opening, closing = _end_chords(chords)
    free = np.isnan(chords.clamp)
    residual[first] = np.where(free[:, 0], 2.0 * m0[opening] + m1[opening], 0.0)
    table[1, first] = np.where(free[:, 0], 2.0 * turn0[opening], 1.0)
    table[0, first + 1] = np.where(free[:, 0], turn1[opening], 0.0)
    residual[last] = np.where(free[:, 1], m0[closing] + 2.0 * m1[closing], 0.0)
    table[1, last] = np.where(free[:, 1], 2.0 * turn1[closing], 1.0)
    table[2, last - 1] = np.where(free[:, 1], turn0[closing], 0.0)
    return residual, table


def _bend(
    near: FloatArray, far: FloatArray, length: FloatArray, mode: Mode
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give moment or curvature at an end of chords, and its derivatives by both slopes."""
    moment = -(4.0 * near + 2.0 * far) / length
    if mode == "moment":
        return moment, -4.0 / length, -2.0 / length
    square = 1.0 + near * near
    shrink = square**-1.5
    by_near = -4.0 / length * shrink - 3.0 * near * moment * shrink / square
    return moment * shrink, by_near, -2.0 / length * shrink


# --------------------------------------------------------------------------------------
# What is refused of points: coincident, in a sharp turn, far from their chords.

_STEEP = 0.35
"""Slope to a chord beyond which a batten is bent more than a little."""

_SAME = 1e-9
"""Part of the extent of the points: neighbours that lie closer coincide."""


def curve_label(number: int, count: int) -> str:
    """Name a curve among many; a single one needs no name."""
    return f"curve {number}" if count > 1 else ""


def checked_points(points: ArrayLike, where: str) -> FloatArray:
    """Take points (n, 2), m: two or more, neighbours apart."""
    try:
        found = check_magnitude(finite_array(points, "spline", (None, 2)), "spline")
    except GeometryError as error:
        raise error.at(where) from None
    if len(found) < 2:
        raise GeometryError("spline: at least 2 points", "give more", {"points": len(found)}, where)
    step = np.hypot(*np.diff(found, axis=0).T)
    close = step <= _SAME * float(np.hypot(*np.ptp(found, axis=0)))
    if close.any():
        first = int(np.argmax(close))
        raise GeometryError(
            f"spline: coincident points {first}", "leave one of the two out", {"index": first},
            where,
        )  # fmt: skip
    return found


def clamp_direction(angle: float | None) -> float:
    """Take the direction of an end, rad; nan stands for a free one."""
    return np.nan if angle is None else float(finite_array(angle, "spline", ()))


def make_chords(points: Sequence[FloatArray], clamp: FloatArray) -> Chords:
    """Make the chords of splines; clamped directions are wrapped to within pi of their chord."""
    sizes = np.array([len(each) for each in points])
    start = np.concatenate([[0], np.cumsum(sizes)])
    owner = np.repeat(np.arange(len(points)), sizes)
    steps = [np.diff(each, axis=0) for each in points]
    length = np.concatenate([np.hypot(*each.T) for each in steps])
    angle = np.concatenate([_unwrapped(each) for each in steps])
    begin = np.delete(np.arange(start[-1]), start[1:] - 1)
    number = np.arange(len(points))
    beside = angle[np.stack([start[:-1] - number, start[1:] - number - 2], axis=1)]
    return Chords(start, owner, begin, length, angle, beside + wrap_angle(clamp - beside))


def _unwrapped(steps: FloatArray) -> FloatArray:
    angle = np.arctan2(steps[:, 1], steps[:, 0])
    turns = wrap_angle(np.diff(angle))
    return np.asarray(angle[0] + np.concatenate([[0.0], np.cumsum(turns)]))


def check_turns(chords: Chords) -> None:
    """Refuse turns of more than 90 degrees between neighbouring chords."""
    turn = np.degrees(np.abs(np.diff(chords.angle)))
    # The next chord of the same spline begins where this one ends.
    turn[np.diff(chords.begin) > 1] = 0.0
    if (turn > 90.0 + 1e-9).any():
        at = int(np.argmax(turn > 90.0 + 1e-9))
        spline = int(chords.owner[chords.begin[at]])
        own = at - int(chords.start[spline]) + spline
        raise GeometryError(
            f"spline: turn of {digits(turn[at])} deg between chords {own},{own + 1}; limit 90 "
            "(insert a knuckle or points)", "cut the curve in two there, or give more points",
            {"turn_deg": float(turn[at]), "chord": own, "limit_deg": 90.0},
            curve_label(spline, len(chords.start) - 1),
        )  # fmt: skip


def check_clamps(chords: Chords) -> None:
    """Refuse ends clamped at more than 45 degrees to their chord, before anything is solved."""
    number = np.arange(len(chords.start) - 1)
    first, last = chords.start[:-1], chords.start[1:] - 1
    phi = np.full(len(chords.owner), np.nan)
    phi[first], phi[last] = chords.clamp.T
    size = np.zeros(len(phi))
    for node, chord in ((first, first - number), (last, last - number - 1)):
        size[node] = _steepness(phi[node] - chords.angle[chord])
    _refuse_steep(chords, size)


def check_slopes(chords: Chords, phi: FloatArray) -> list[tuple[str, ...]]:
    """Refuse slopes above 1; report those above .35, a tuple of notes for each spline."""
    size = np.zeros(len(phi))
    for node in (chords.begin, chords.begin + 1):
        np.maximum.at(size, node, _steepness(phi[node] - chords.angle))
    _refuse_steep(chords, size)
    notes: list[tuple[str, ...]] = [()] * (len(chords.start) - 1)
    own = np.arange(len(phi)) - chords.start[chords.owner]
    for at in np.flatnonzero(size > _STEEP).tolist():
        said = (
            f"spline: slope {digits(size[at])} to the chord at node {own[at]} exceeds 0.35, up to "
            "which a batten is bent but little"
        )
        notes[chords.owner[at]] = (*notes[chords.owner[at]], said)
    return notes


def _steepness(away: FloatArray) -> FloatArray:
    """Give amounts of slopes: infinite where a direction runs back, 0 where none is given."""
    steep = np.where(np.abs(away) < 0.5 * np.pi, np.abs(np.tan(away)), np.inf)
    return np.asarray(np.where(np.isnan(away), 0.0, steep))


def _refuse_steep(chords: Chords, size: FloatArray) -> None:
    if not (size > 1.0 + 1e-9).any():
        return
    at = int(np.argmax(size > 1.0 + 1e-9))
    own = at - int(chords.start[chords.owner[at]])
    raise GeometryError(
        f"spline: slope {digits(size[at])} to the chord at node {own} exceeds 1",
        "give points closer together there", {"slope": float(size[at]), "node": own},
        curve_label(int(chords.owner[at]), len(chords.start) - 1),
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# The curve. With u from 0 to 1 along a chord of length l, the deflection is
# l (m0 u - (2 m0 + m1) u^2 + (m0 + m1) u^3), m0 and m1 the slopes to the chord at its ends: a
# composite cubic with a direction of its own at each point.

_UP = np.array([0.0, 0.0, 1.0])


@attrs.frozen(eq=False)
class CoordinateIntersections:
    """Where a curve has given coordinates.

    Attributes
    ----------
    index : (r,) int
        Which of the given values.
    t : (r,), m
        Chord-length parameters, ascending for each value.
    points : (r, 2), m
        The points.
    """

    index: IntArray
    t: FloatArray
    points: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.index, self.t, self.points)

    def __len__(self) -> int:
        return len(self.index)


@attrs.frozen(eq=False, slots=False)
class ChordSpline:
    """A mechanical spline through points of a plane.

    Attributes
    ----------
    points : (n, 2), m
        The supports.
    angles : (n,), rad
        Direction of the curve at each, unwrapped along it.
    mode : "moment" or "curvature"
        What is continuous at inner points. With "moment", as the paper has it, the moments
        agree but stand in frames of two chords: true curvature jumps a little. With
        "curvature" it does not.
    notes : tuple of str
        Where a slope to a chord is beyond .35, so that the batten is bent more than a little.
    """

    points: FloatArray
    angles: FloatArray
    mode: Mode
    notes: tuple[str, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.points, self.angles)

    @classmethod
    def through(
        cls,
        points: ArrayLike,
        angle0: float | None = None,
        angle1: float | None = None,
        mode: Mode = "curvature",
    ) -> Self:
        """Bend a batten through points.

        Parameters
        ----------
        points : (n, 2), m
            Two or more, in order.
        angle0, angle1 : float or None, rad
            Direction in which an end is clamped; None leaves it free, without moment.
        mode : "moment" or "curvature"
            As the attribute.

        Raises
        ------
        GeometryError
            ``"spline: coincident points {i}"``, ``"spline: turn of {deg} deg between chords
            {i},{i+1}; limit 90 (insert a knuckle or points)"``, ``"spline: slope {m} to the
            chord at node {i} exceeds 1"``, ``"spline: Newton did not converge"``.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.chord_spline import ChordSpline
        >>> half_wave = ChordSpline.through([(0, 0), (1, 0)], angle0=0.2)
        >>> half_wave.at(0.5).round(4).tolist()
        [0.5, 0.0380]
        """
        made = _solved([points], [(angle0, angle1)], mode)
        return cls(*made[0])

    @cached_property
    def batch(self) -> SplineBatch:
        """The same curve as a composite spline of the kernel, in the plane z = 0."""
        chords = make_chords([self.points], np.full((1, 2), np.nan))
        m0, m1 = chord_slopes(chords, self.angles)
        along = np.diff(self.points, axis=0) / chords.length[:, None]
        leave, arrive = np.zeros((2, len(self.points), 3))
        leave[:-1, :2], arrive[1:, :2] = (along + m[:, None] * _left(along) for m in (m0, m1))
        leave[-1], arrive[0] = arrive[-1], leave[0]
        xyz = np.column_stack([self.points, np.zeros(len(self.points))])
        knot = np.concatenate([[0.0], np.cumsum(chords.length)])
        return SplineBatch(chords.start, knot, xyz, leave, arrive)

    @property
    def knots(self) -> FloatArray:
        """Chord-length parameter of each point, (n,), m; the last one is where the curve ends."""
        return self.batch.knot

    def at(self, t: ArrayLike) -> FloatArray:
        """Give points at chord-length parameters t of any shape, (..., 2), m.

        Raises
        ------
        GeometryError
            ``"spline: x={x} outside [{a}, {b}]"`` where a parameter is off the curve.
        """
        curve, where, shape = self._places(t)
        return evaluate(self.batch, curve, where)[:, :2].reshape(*shape, 2)

    def direction(self, t: ArrayLike) -> FloatArray:
        """Give directions at parameters t of any shape, rad, from -pi to pi."""
        curve, where, shape = self._places(t)
        slope = derivative(self.batch, curve, where)
        return np.arctan2(slope[:, 1], slope[:, 0]).reshape(shape)

    def curvature(self, t: ArrayLike) -> FloatArray:
        """Give curvature at parameters t of any shape, 1/m, positive to the left."""
        curve, where, shape = self._places(t)
        first, second = (derivative(self.batch, curve, where, order=n) for n in (1, 2))
        return plane_curvature(first, second, _UP).reshape(shape)

    def _places(self, t: ArrayLike) -> tuple[IntArray, FloatArray, tuple[int, ...]]:
        last = float(self.knots[-1])
        where = within_range(t, "spline", 0.0, last, slack=1e-12 * last)
        return np.zeros(where.size, np.int64), where.ravel(), where.shape

    @cached_property
    def node_curvatures(self) -> FloatArray:
        """Curvature before and after each point, (2, n), 1/m; at an end both are the same."""
        chords = make_chords([self.points], np.full((1, 2), np.nan))
        m0, m1 = chord_slopes(chords, self.angles)
        after = -(4.0 * m0 + 2.0 * m1) / chords.length / (1.0 + m0 * m0) ** 1.5
        before = (2.0 * m0 + 4.0 * m1) / chords.length / (1.0 + m1 * m1) ** 1.5
        both = np.array([[after[0], *before], [*after, before[-1]]])
        freeze(both)
        return both

    def where(self, axis: Literal["x", "y"], values: ArrayLike) -> CoordinateIntersections:
        """Find all points of given x or y.

        Parameters
        ----------
        axis : "x" or "y"
            Which coordinate is given.
        values : float or (k,), m
            Its values.

        Raises
        ------
        GeometryError
            ``"spline: x={x} outside [{a}, {b}]"`` where the curve has no such point.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.chord_spline import ChordSpline
        >>> arch = ChordSpline.through([(0, 0), (1, 0.3), (2, 0)])
        >>> found = arch.where("y", 0.2)
        >>> found.points[:, 0].round(4).tolist()
        [0.4651, 1.5349]
        """
        one_of(axis, ("x", "y"), "spline: no axis")
        column = 0 if axis == "x" else 1
        cubics = power_coefficients(self.batch)[:, :, column]
        wanted = within_range(values, "spline", *_extent(cubics)).ravel()
        if not len(wanted):
            return CoordinateIntersections(np.zeros(0, np.int64), np.zeros(0), np.zeros((0, 2)))
        index, segment, u = _roots(cubics, wanted)
        knot = self.knots
        t = np.clip(knot[segment] + u * (knot[segment + 1] - knot[segment]), 0.0, knot[-1])
        # A summit is as flat as rounding: both its sides may be found.
        index, t = _distinct_intersections(index, t, 4e-6 * float(knot[-1]))
        points = self.at(t).copy()
        points[:, column] = wanted[index]
        return CoordinateIntersections(index, t, points)


def chord_splines(
    curves: Sequence[ArrayLike],
    ends: Sequence[tuple[float | None, float | None]] | None = None,
    mode: Mode = "curvature",
) -> tuple[ChordSpline, ...]:
    """Bend many battens at once; each has the same bits as when bent alone.

    Parameters
    ----------
    curves : sequence of (n, 2), m
        The points of each.
    ends : sequence of (float or None, float or None), rad
        Clamped directions of each; all ends are free by default.
    mode : "moment" or "curvature"
        As for `ChordSpline`.

    Raises
    ------
    GeometryError
        As `ChordSpline.through`, with the curve it is about.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.chord_spline import chord_splines
    >>> both = chord_splines([[(0, 0), (1, 0.2), (2, 0)], [(0, 0), (3, 1)]])
    >>> [len(each.points) for each in both]
    [3, 2]
    """
    each = _as_list(curves)
    given = [(None, None)] * len(each) if ends is None else _as_pairs(ends)
    if len(given) != len(each):
        raise GeometryError(
            f"spline: {len(given)} pairs of end directions for {len(each)} curves",
            "give one pair a curve", {"ends": len(given), "curves": len(each)},
        )  # fmt: skip
    return tuple(ChordSpline(*made) for made in _solved(each, given, mode))


def _as_list(curves: object) -> list[ArrayLike]:
    """Take curves one by one."""
    many = isinstance(curves, Sequence) and not isinstance(curves, str | bytes)
    if many or (isinstance(curves, np.ndarray) and curves.ndim):
        return list(cast("Sequence[ArrayLike]", curves))
    what = f"spline: {shown(curves)} are no curves"
    raise GeometryError(what, "give a list of points for each")


def _as_pairs(ends: object) -> list[tuple[float | None, float | None]]:
    """Take pairs of directions."""
    if isinstance(ends, Sequence) and all(
        isinstance(each, Sequence) and not isinstance(each, str | bytes) and len(each) == 2
        for each in ends
    ):
        return [(each[0], each[1]) for each in ends]
    raise GeometryError(f"spline: ends are {shown(ends)}", "give a pair of directions a curve")


def _solved(
    curves: Sequence[ArrayLike],
    ends: Sequence[tuple[float | None, float | None]],
    mode: Mode,
) -> list[tuple[FloatArray, FloatArray, Mode, tuple[str, ...]]]:
    """Check points, solve for directions, check slopes; give the arguments of each spline."""
    one_of(mode, ("moment", "curvature"), "spline: no mode")
    if not curves:
        return []
    points = [checked_points(each, curve_label(i, len(curves))) for i, each in enumerate(curves)]
    clamp = np.array([[clamp_direction(end) for end in pair] for pair in ends], np.float64)
    chords = make_chords(points, clamp)
    check_turns(chords)
    check_clamps(chords)
    phi = solve_directions(chords, mode)
    notes = check_slopes(chords, phi)
    parts = np.split(phi, chords.start[1:-1])
    return [
        (xy, angle.copy(), mode, said) for xy, angle, said in zip(points, parts, notes, strict=True)
    ]


def _left(along: FloatArray) -> FloatArray:
    return np.stack([-along[:, 1], along[:, 0]], axis=1)


def _extent(cubics: FloatArray) -> tuple[float, float]:
    """Give the least and greatest value of cubics (s, 4) on [0, 1]."""
    turns = unit_roots(differentiate(cubics))
    at = np.concatenate([np.zeros((len(cubics), 1)), turns, np.ones((len(cubics), 1))], axis=1)
    heights = horner(cubics, at)
    return float(heights.min()), float(heights.max())


def _roots(cubics: FloatArray, values: FloatArray) -> tuple[IntArray, IntArray, FloatArray]:
    """Find where cubics (s, 4) take values (k,): number of the value, segment, u on it."""
    table = np.repeat(cubics[None], len(values), axis=0)
    table[:, :, 0] -= values[:, None]
    flat = table.reshape(-1, 4)
    # A touch changes no sign: places where the cubic is stationary, and both ends, count as well.
    turns = unit_roots(differentiate(flat))
    edges = np.zeros((len(flat), 2))
    edges[:, 1] = 1.0
    u = np.concatenate([unit_roots(flat), turns, edges], axis=1)
    size = 1e-12 * max(float(np.abs(cubics).max()), float(np.abs(values).max()))
    near = np.abs(horner(flat, u)) <= size
    row, column = np.nonzero(near)
    return row // len(cubics), row % len(cubics), u[row, column]


def _distinct_intersections(
    index: IntArray, t: FloatArray, least: float
) -> tuple[IntArray, FloatArray]:
    """Sort by value and place, and keep one of those that lie closer than `least`."""
    order = np.lexsort([t, index])
    index, t = index[order], t[order]
    keep = np.ones(len(t), np.bool_)
    keep[1:] = (np.diff(index) > 0) | (np.diff(t) > least)
    return index[keep], t[keep]

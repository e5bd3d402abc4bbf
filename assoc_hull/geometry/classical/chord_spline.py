"""The mechanical spline: a batten on supports, its deflection measured from each chord.

The bending moment of a batten is continuous at its supports and linear between them. As the
deflection is measured from the chord of each interval, only the slope to the chord must be
small; the curve may turn by any angle in all. With u from 0 to 1 along a chord of length l, the
deflection is l (m0 u - (2 m0 + m1) u^2 + (m0 + m1) u^3), m0 and m1 the slopes to the chord at
its ends. A chord spline is thus a composite cubic, with a direction of its own at each point.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, eqs 1 to 7.

Examples
--------
>>> from assoc_hull.geometry.classical.chord_spline import ChordSpline
>>> batten = ChordSpline.through([(0, 0), (2, 1), (4, 1.5), (7, 1.2), (9, 0)])
>>> batten.angles.round(6).tolist()
[0.510755, 0.369641, 0.126623, -0.37858, -0.621872]
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Literal, Self, cast

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import inside
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.classical.chord_spline_checks import (
    check_clamps,
    check_slopes,
    check_turns,
    checked_points,
    chords_of,
    clamped,
    place_of,
)
from assoc_hull.geometry.classical.chord_spline_solve import Mode, slopes, solve_directions
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.roots import unit_roots
from assoc_hull.geometry.splines.curvature import plane_curvature
from assoc_hull.geometry.splines.evaluation import derivative, evaluate
from assoc_hull.geometry.splines.segments import power

__all__ = ["ChordSpline", "Meets", "chord_splines"]

_UP = np.array([0.0, 0.0, 1.0])


@attrs.frozen(eq=False)
class Meets:
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
        made = _made([points], [(angle0, angle1)], mode)
        return cls(*made[0])

    @cached_property
    def batch(self) -> SplineBatch:
        """The same curve as a composite spline of the kernel, in the plane z = 0."""
        chords = chords_of([self.points], np.full((1, 2), np.nan))
        m0, m1 = slopes(chords, self.angles)
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
        where = inside(t, "spline", 0.0, last, slack=1e-12 * last)
        return np.zeros(where.size, np.int64), where.ravel(), where.shape

    @cached_property
    def node_curvatures(self) -> FloatArray:
        """Curvature before and after each point, (2, n), 1/m; at an end both are the same."""
        chords = chords_of([self.points], np.full((1, 2), np.nan))
        m0, m1 = slopes(chords, self.angles)
        after = -(4.0 * m0 + 2.0 * m1) / chords.length / (1.0 + m0 * m0) ** 1.5
        before = (2.0 * m0 + 4.0 * m1) / chords.length / (1.0 + m1 * m1) ** 1.5
        both = np.array([[after[0], *before], [*after, before[-1]]])
        freeze(both)
        return both

    def where(self, axis: Literal["x", "y"], values: ArrayLike) -> Meets:
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
        cubics = power(self.batch)[:, :, column]
        wanted = inside(values, "spline", *_extent(cubics)).ravel()
        if not len(wanted):
            return Meets(np.zeros(0, np.int64), np.zeros(0), np.zeros((0, 2)))
        index, segment, u = _roots(cubics, wanted)
        knot = self.knots
        t = np.clip(knot[segment] + u * (knot[segment + 1] - knot[segment]), 0.0, knot[-1])
        # A summit is as flat as rounding: both its sides may be found.
        index, t = _apart(index, t, 4e-6 * float(knot[-1]))
        points = self.at(t).copy()
        points[:, column] = wanted[index]
        return Meets(index, t, points)


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
    each = _each(curves)
    given = [(None, None)] * len(each) if ends is None else _pairs(ends)
    if len(given) != len(each):
        raise GeometryError(
            f"spline: {len(given)} pairs of end directions for {len(each)} curves",
            "give one pair a curve", {"ends": len(given), "curves": len(each)},
        )  # fmt: skip
    return tuple(ChordSpline(*made) for made in _made(each, given, mode))


def _each(curves: object) -> list[ArrayLike]:
    """Take curves one by one."""
    many = isinstance(curves, Sequence) and not isinstance(curves, str | bytes)
    if many or (isinstance(curves, np.ndarray) and curves.ndim):
        return list(cast("Sequence[ArrayLike]", curves))
    what = f"spline: {shown(curves)} are no curves"
    raise GeometryError(what, "give a list of points for each")


def _pairs(ends: object) -> list[tuple[float | None, float | None]]:
    """Take pairs of directions."""
    if isinstance(ends, Sequence) and all(
        isinstance(each, Sequence) and not isinstance(each, str | bytes) and len(each) == 2
        for each in ends
    ):
        return [(each[0], each[1]) for each in ends]
    raise GeometryError(f"spline: ends are {shown(ends)}", "give a pair of directions a curve")


def _made(
    curves: Sequence[ArrayLike],
    ends: Sequence[tuple[float | None, float | None]],
    mode: Mode,
) -> list[tuple[FloatArray, FloatArray, Mode, tuple[str, ...]]]:
    """Check points, solve for directions, check slopes; what each spline is made of."""
    one_of(mode, ("moment", "curvature"), "spline: no mode")
    if not curves:
        return []
    points = [checked_points(each, place_of(i, len(curves))) for i, each in enumerate(curves)]
    clamp = np.array([[clamped(end) for end in pair] for pair in ends], np.float64)
    chords = chords_of(points, clamp)
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
    """Find which value lies where: its number, the segment, and the place on it."""
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


def _apart(index: IntArray, t: FloatArray, least: float) -> tuple[IntArray, FloatArray]:
    """Sort by value and place, and keep one of those that lie closer than `least`."""
    order = np.lexsort([t, index])
    index, t = index[order], t[order]
    keep = np.ones(len(t), np.bool_)
    keep[1:] = (np.diff(index) > 0) | (np.diff(t) > least)
    return index[keep], t[keep]

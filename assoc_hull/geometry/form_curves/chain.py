"""Courses: form-parameter curves, straight pieces and cubics joined end to end in a plane.

A piece has seven vertices of a uniform cubic B-spline and runs from t = 0 to t = 4. A straight
piece and a single cubic have such vertices too, exactly; so a course of mixed pieces is one
array. Places on it are (piece, t).

Whatever is asked at many places is found at each for itself: the same bits alone and in company.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.form_curves.chain import cubic_vertices, FormChain, straight_vertices
>>> rise = cubic_vertices((0.0, 0.0), (4.0, 1.0), (1.0, 0.0), (1.0, 0.0))
>>> course = FormChain.of([rise, straight_vertices((4.0, 1.0), (8.0, 1.0))])
>>> course.ordinate(np.array([2.0, 6.0, 9.0]))
array([0.5, 1. , nan])
>>> course.meets(1, 0.5)
((0, 2.0),)
>>> float(course.area())
6.0
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.form_curves.curve import form_at
from assoc_hull.geometry.form_curves.integrals import form_integrals, power_form
from assoc_hull.geometry.numeric.polynomials import (
    bracketed_roots,
    differentiate,
    horner,
    unit_roots,
)

__all__ = ["LENGTH", "FormChain", "cubic_vertices", "straight_vertices"]

LENGTH = 4.0
"""The parameter of a piece runs from 0 to this."""

_TOUCH = 1e-12
"""Of the size of a course: so near to a value the coordinate has it."""
_ONE_PLACE = 1e-6
"""Intersections nearer than this in t are one."""


def straight_vertices(start: ArrayLike, finish: ArrayLike) -> FloatArray:
    """Give the vertices of straight pieces that run at an even pace.

    Parameters
    ----------
    start, finish : (..., 2)
        The ends.

    Returns
    -------
    (..., 7, 2)

    Examples
    --------
    >>> from assoc_hull.geometry.form_curves.chain import straight_vertices
    >>> straight_vertices((0.0, 1.0), (4.0, 1.0))[:, 0].tolist()
    [-1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
    """
    begin, end = np.asarray(start, np.float64), np.asarray(finish, np.float64)
    share = (np.arange(-1.0, 6.0) / LENGTH)[:, None]
    return np.asarray((1.0 - share) * begin[..., None, :] + share * end[..., None, :])


def cubic_vertices(
    start: ArrayLike, finish: ArrayLike, leave: ArrayLike, arrive: ArrayLike
) -> FloatArray:
    """Give the vertices of single cubics, by their ends and the derivatives by t there.

    Parameters
    ----------
    start, finish : (..., 2)
        The ends.
    leave, arrive : (..., 2)
        Derivatives by t, which runs from 0 to 4: a quarter of the chord is an even pace.

    Returns
    -------
    (..., 7, 2)

    Examples
    --------
    >>> from assoc_hull.geometry.form_curves.chain import cubic_vertices
    >>> cubic_vertices((0.0, 0.0), (4.0, 1.0), (1.0, 0.0), (1.0, 0.0))[:3, 1].tolist()
    [0.125, -0.0625, 0.125]
    """
    begin, end, first, last = (np.asarray(e, np.float64) for e in (start, finish, leave, arrive))
    rise = (end - begin) / LENGTH
    bend = (3.0 * rise - 2.0 * first - last) / LENGTH
    twist = (first + last - 2.0 * rise) / LENGTH**2
    # The vertex j has the blossom of the cubic at its knots j - 2, j - 1, j.
    knot = np.arange(-1.0, 6.0)
    weights = (knot, (3.0 * knot * knot - 1.0) / 3.0, knot * (knot * knot - 1.0))
    found = begin[..., None, :] + 0.0 * knot[:, None]
    for weight, part in zip(weights, (first, bend, twist), strict=True):
        found = found + weight[:, None] * part[..., None, :]
    return np.asarray(found)


def _vertices(given: object) -> FloatArray:
    found = np.array(given, np.float64)
    freeze(found)
    return found


@attrs.frozen(eq=False, slots=False)
class FormChain:
    """A course of pieces, each beginning where the one before ends.

    Attributes
    ----------
    vertices : (m, 7, 2)
        Of the pieces, in the unit of the plane: abscissa, ordinate.
    """

    vertices: FloatArray = attrs.field(converter=_vertices)

    @classmethod
    def of(cls, pieces: Sequence[FloatArray]) -> Self:
        """Join pieces, (7, 2) each."""
        return cls(np.stack(list(pieces)))

    @property
    def count(self) -> int:
        """The number of pieces."""
        return len(self.vertices)

    @cached_property
    def _knots(self) -> FloatArray:
        """The points at the knots, (m, 5, 2)."""
        v = self.vertices
        return np.asarray((v[:, :5] + 4.0 * v[:, 1:6] + v[:, 2:]) / 6.0)

    @cached_property
    def _powers(self) -> FloatArray:
        """The segments in powers, (m, 4 segments, 4 powers, 2)."""
        return power_form(self.vertices)

    @property
    def start(self) -> FloatArray:
        """The first point, (2,)."""
        return np.asarray(self._knots[0, 0])

    @property
    def finish(self) -> FloatArray:
        """The last point, (2,)."""
        return np.asarray(self._knots[-1, 4])

    def at(self, piece: ArrayLike, t: ArrayLike) -> FloatArray:
        """Give points, (k, 2), at places (piece, t), (k,) each."""
        return self._derivative(piece, t, 0)

    def tangent(self, piece: ArrayLike, t: ArrayLike) -> FloatArray:
        """Give the derivatives by t, (k, 2); their length is the pace."""
        return self._derivative(piece, t, 1)

    def bend(self, piece: ArrayLike, t: ArrayLike) -> FloatArray:
        """Give the signed curvatures, (k,): positive where the course turns left."""
        first, second = self._derivative(piece, t, 1), self._derivative(piece, t, 2)
        return _curvature(first, second)

    def _derivative(self, piece: ArrayLike, t: ArrayLike, order: int) -> FloatArray:
        numbers, at = np.broadcast_arrays(
            np.atleast_1d(np.asarray(piece, np.int64)), np.atleast_1d(np.asarray(t, np.float64))
        )
        return form_at(self.vertices[numbers], at, order)

    def place(self, x: ArrayLike) -> tuple[IntArray, FloatArray]:
        """Find the places of abscissae on a course whose abscissa runs one way.

        Parameters
        ----------
        x : (k,)
            Abscissae. At a joint the later piece is taken.

        Returns
        -------
        (k,) int, (k,)
            Piece and t; -1 and nan where the course is not.
        """
        want = np.atleast_1d(np.asarray(x, np.float64))
        sign = 1.0 if self.finish[0] >= self.start[0] else -1.0
        knots = sign * self._knots[..., 0]
        near = _TOUCH * max(1.0, abs(knots[0, 0]), abs(knots[-1, 4]))
        u = sign * want
        inside = (u >= knots[0, 0] - near) & (u <= knots[-1, 4] + near)
        begins = np.maximum.accumulate(knots[:, 0])
        piece = np.clip(np.searchsorted(begins, u, side="right") - 1, 0, self.count - 1)
        own = knots[piece]
        u = np.clip(u, own[:, 0], np.maximum(own[:, 0], own[:, 4]))
        # The first segment that ends above: it begins below, wherever rounding has put the knots.
        segment = np.minimum((own[:, 1:4] < u[:, None]).cumprod(axis=1).sum(axis=1), 3)
        rows = np.arange(len(u))
        cubic = sign * self._powers[piece, segment, :, 0].T
        below, above = own[rows, segment] - u, own[rows, segment + 1] - u
        cubic[0] -= u
        with np.errstate(invalid="ignore", divide="ignore"):
            root = bracketed_roots(cubic, np.zeros(len(u)), np.ones(len(u)), below, above)
        root = np.where(below == above, 0.0, root)
        return np.where(inside, piece, -1), np.where(inside, segment + root, np.nan)

    def _along(self, x: ArrayLike, orders: Sequence[int]) -> list[FloatArray]:
        piece, t = self.place(x)
        off = piece < 0
        vertices, at = self.vertices[np.where(off, 0, piece)], np.where(off, 0.0, t)
        return [np.where(off[:, None], np.nan, form_at(vertices, at, each)) for each in orders]

    def ordinate(self, x: ArrayLike) -> FloatArray:
        """Give ordinates at abscissae, (k,); nan where the course is not.

        The abscissa must run one way along the course. Where it jumps back by a trifle inside
        a piece, the first intersection counts.
        """
        return np.asarray(self._along(x, (0,))[0][:, 1])

    def slope(self, x: ArrayLike) -> FloatArray:
        """Give dy/dx at abscissae, (k,); infinite where the course is upright."""
        (first,) = self._along(x, (1,))
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(first[:, 1] / first[:, 0])

    def curvature(self, x: ArrayLike) -> FloatArray:
        """Give signed curvatures at abscissae, (k,): positive where the course turns left."""
        first, second = self._along(x, (1, 2))
        return _curvature(first, second)

    def meets(self, axis: int, value: float) -> tuple[tuple[int, float], ...]:
        """Find all intersections with a line x = value (axis 0) or y = value (axis 1).

        Parameters
        ----------
        axis : int
            0 for the abscissa, 1 for the ordinate.
        value : float
            Of the line.

        Returns
        -------
        tuple of (int, float)
            Places (piece, t) in order along the course. A joint is given once, as the end of
            the earlier piece; of a stretch that lies in the line, its knots.
        """
        cubic = self._powers[..., axis].reshape(-1, 4).copy()
        cubic[:, 0] -= value
        size = max(1.0, abs(value), float(np.abs(self._knots[..., axis]).max()))
        ends = np.zeros((len(cubic), 2))
        ends[:, 1] = 1.0
        u = np.concatenate([unit_roots(cubic), unit_roots(differentiate(cubic)), ends], axis=1)
        segment, column = np.nonzero(np.abs(horner(cubic, u)) <= _TOUCH * size)
        along = np.sort(segment + u[segment, column])
        kept = [p for n, p in enumerate(along) if n == 0 or p - along[n - 1] > _ONE_PLACE]
        return tuple(self._named(float(each)) for each in kept)

    def _named(self, along: float) -> tuple[int, float]:
        """Give piece and t of a place, counted in t from the start of the course."""
        piece = min(max(int(np.ceil(along / LENGTH)) - 1, 0), self.count - 1)
        return piece, along - LENGTH * piece

    def area(self) -> float:
        """Give int y dx along the course."""
        return float(sum(form_integrals(self.vertices).area.tolist()))

    def moment(self) -> float:
        """Give int x y dx along the course."""
        return float(sum(form_integrals(self.vertices).moment.tolist()))


def _curvature(first: FloatArray, second: FloatArray) -> FloatArray:
    pace = np.sqrt(first[:, 0] * first[:, 0] + first[:, 1] * first[:, 1])
    turn = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(turn / (pace * pace * pace))

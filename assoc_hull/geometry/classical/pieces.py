"""Curves y(x) made of pieces: polynomials, and roots of polynomials (conics, circles).

A piece runs from `first` to `last` in x. It is a polynomial in u = (x - first)/(last - first),
which is a line or a quintic, or stands upright at a level A = `base`,

    (y - A)^2 = b0 + b1 v + b2 v^2 + b3 v^3,      v = (last - x)/(last - first),

which is a conic (b0 = b3 = 0), a cubic conic (b0 = 0) or a circle.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, the combined method.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Literal, Self

import attrs
import numpy as np
from numpy.polynomial.polynomial import polyder, polyint, polyval
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import numbers, whole_number
from assoc_hull.geometry.classical.checks import figure, inside
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Join", "Piece", "PiecedCurve"]

Formula = Literal["line", "quintic", "conic", "cubic conic", "circle"]

_SLACK = 1e-12
"""So far outside, in parts of the length, an abscissa counts as the end."""


@attrs.frozen(eq=False)
class Piece:
    """One formula between two abscissae.

    Attributes
    ----------
    formula : str
        "line", "quintic", "conic", "cubic conic" or "circle".
    first, last : float, m
        The range in x.
    coefficients : (k,)
        Ascending powers of u (m), or of v (m2).
    base : float or None, m
        A of a root; None for a polynomial.
    """

    formula: Formula
    first: float
    last: float
    coefficients: FloatArray
    base: float | None = None

    def __attrs_post_init__(self) -> None:
        freeze(self.coefficients)

    @property
    def length(self) -> float:
        """Last - first, m."""
        return self.last - self.first

    def at(self, x: ArrayLike, order: int = 0) -> FloatArray:
        """Give y (m), dy/dx or d2y/dx2 (1/m) in the shape of `x`.

        Where a root stands upright its slope is infinite.

        Raises
        ------
        GeometryError
            ``"{formula}: x={x} outside [{a}, {b}]"``.
        """
        slack = _SLACK * self.length
        places = inside(x, self.formula, self.first, self.last, slack)
        if self.base is None:
            u = (places - self.first) / self.length
            return np.asarray(polyval(u, polyder(self.coefficients, order)) / self.length**order)
        return self._root((self.last - places) / self.length, order)

    def _root(self, v: FloatArray, order: int) -> FloatArray:
        assert self.base is not None
        under, step = self.coefficients, -self.length
        height = np.sqrt(np.maximum(polyval(v, under), 0.0))
        if not order:
            return np.asarray(self.base + height)
        with np.errstate(divide="ignore", invalid="ignore"):
            rise = polyval(v, polyder(under)) / (2.0 * height)
            if order == 1:
                return np.asarray(rise / step)
            return np.asarray((0.5 * polyval(v, polyder(under, 2)) - rise**2) / height / step**2)

    def area(self) -> float:
        """Give the area under the piece, m2."""
        if self.base is None:
            return float(polyval(1.0, polyint(self.coefficients))) * self.length
        from scipy.integrate import quad

        def strip(s: float) -> float:
            # v = s^2 takes the upright tangent out of the integrand.
            return 2.0 * s * math.sqrt(max(float(polyval(s * s, self.coefficients)), 0.0))

        return (self.base + float(quad(strip, 0.0, 1.0, epsabs=0.0, epsrel=1e-13)[0])) * self.length

    def nose_radius(self) -> float:
        """Give the radius at `last`, where a conic stands upright, m; 0 for other pieces."""
        upright = self.base is not None and self.coefficients[0] == 0.0
        return float(self.coefficients[1]) / (2.0 * self.length) if upright else 0.0


@attrs.frozen
class Join:
    """How two pieces meet.

    Attributes
    ----------
    x : float, m
    gap, turn : float, m and 1
        By how much y and dy/dx differ, after less before.
    before, after : float, 1/m
        d2y/dx2 on both sides.
    """

    x: float
    gap: float
    turn: float
    before: float
    after: float


@attrs.frozen(eq=False)
class PiecedCurve:
    """Pieces one behind the other.

    Attributes
    ----------
    pieces : tuple of Piece
        In order; each begins where the one before ends.
    notes : tuple of str
        What is to be known: warnings, each a whole sentence.
    name : str
        For messages.
    """

    pieces: tuple[Piece, ...]
    notes: tuple[str, ...] = ()
    name: str = "waterline"

    @classmethod
    def make(
        cls, pieces: tuple[Piece, ...], notes: tuple[str, ...] = (), name: str = "waterline"
    ) -> Self:
        """Check that there is a piece, and that each begins where the last one ended.

        Raises
        ------
        GeometryError
            No piece, or a gap between two.
        """
        if not pieces:
            raise GeometryError(f"{name}: no pieces", "give one or more")
        for one, other in pairwise(pieces):
            if one.last != other.first:
                what = f"{name}: a piece ends at x={figure(one.last)}, the next begins at "
                what += figure(other.first)
                raise GeometryError(what, "let them meet", {"x": one.last, "next": other.first})
        return cls(tuple(pieces), notes, name)

    @property
    def first(self) -> float:
        """Where the curve begins, m."""
        return self.pieces[0].first

    @property
    def last(self) -> float:
        """Where it ends, m."""
        return self.pieces[-1].last

    def at(self, x: ArrayLike, order: int = 0) -> FloatArray:
        """Give y (m), dy/dx or d2y/dx2 (1/m) in the shape of `x`; at a join, of the piece after.

        Raises
        ------
        GeometryError
            ``"{name}: x={x} outside [{a}, {b}]"``; an order that is not 0, 1 or 2.
        """
        whole_number(order, f"{self.name}: derivative of order", 0, 2)
        slack = _SLACK * (self.last - self.first)
        places = inside(x, self.name, self.first, self.last, slack)
        breaks = np.array([piece.first for piece in self.pieces[1:]])
        which = np.searchsorted(breaks, places, "right")
        found = np.empty(places.shape)
        for number, piece in enumerate(self.pieces):
            mine = which == number
            found[mine] = piece.at(places[mine], order)
        return found

    def joins(self) -> tuple[Join, ...]:
        """Tell of each join by how much value and slope differ, and both second derivatives."""
        found = list[Join]()
        for one, other in pairwise(self.pieces):
            ends = [(float(one.at(one.last, k)), float(other.at(one.last, k))) for k in range(3)]
            gap, turn = (after - before for before, after in ends[:2])
            found.append(Join(one.last, gap, turn, *ends[2]))
        return tuple(found)

    def area(self) -> float:
        """Give the area under the curve, m2."""
        return sum(piece.area() for piece in self.pieces)

    def off(self, offsets: ArrayLike) -> FloatArray:
        """Give by how much the curve passes above offsets (n, 2), m: (n,), m."""
        points = numbers(offsets, self.name, (None, 2))
        return self.at(points[:, 0]) - points[:, 1]

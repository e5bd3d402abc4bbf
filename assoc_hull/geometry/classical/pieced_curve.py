"""Curves y(x) made of pieces: polynomials, and roots of polynomials (conics, circles).

`FormulaPiece` is one formula between two abscissae, `PiecedCurve` a row of them. The other
functions make the pieces that go on from a curve with its value and slope: a conic, a cubic conic,
which agrees in curvature too, and a circle. Conics stand upright at their end. Source: Kim & Chang,
"Some Representations of Ship Hulls by Mathematical Method for Design and Production", J. SNAK, the
combined method.
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
from assoc_hull.geometry.classical.checked_input import (
    broadcast_numbers,
    digits,
    number,
    numbers,
    whole_number,
    within_range,
)
from assoc_hull.geometry.classical.linear_least_squares import held_fit, linear_fit
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "FormulaPiece",
    "PieceJoin",
    "PiecedCurve",
    "circle_piece",
    "conic",
    "conic_coefficients",
    "conic_notes",
    "cubic_conic",
    "cubic_conic_coefficients",
    "fit_cubic_conic",
]

_STRAIGHT_CONIC = 1e-12
"""A conic whose slope is that of the straight line to this part is that line."""


def conic_coefficients(height: ArrayLike, slope: ArrayLike) -> FloatArray:
    """Give b1 and b2 of many conics (y - A)^2 = b1 v + b2 v^2, (..., 2), m2.

    v runs from 0 at the end to 1 at the join; `height` is y - A and `slope` dy/dv there, m.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.pieced_curve import conic_coefficients
    >>> conic_coefficients([2.0, 2.0], [1.0, 0.0]).tolist()
    [[4.0, 0.0], [8.0, -4.0]]
    """
    y, s = broadcast_numbers((height, slope), "waterline")
    return np.stack([2.0 * y * (y - s), y * (2.0 * s - y)], axis=-1)


def conic(first: float, last: float, y: float, slope: float, end: float = 0.0) -> FormulaPiece:
    """Make the conic that goes on from a curve with value and slope.

    Parameters
    ----------
    first, last : float, m
        The join, and the end, where the tangent is upright.
    y, slope : float, m and 1
        y and dy/dx at `first`.
    end : float, m
        A, half-breadth at `last`.

    Returns
    -------
    FormulaPiece
        A line, if the slope is that of the straight line to the end.

    Raises
    ------
    GeometryError
        ``"waterline: y1' = {s} >= y1 = {y1}: conic is not real near the end; move x1"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.pieced_curve import conic
    >>> nose = conic(60.0, 75.0, 6.5, -0.2628518890)
    >>> float(nose.at(70.0).round(6)), round(nose.nose_radius(), 6)
    (3.475913, 1.108129)
    """
    given = numbers([first, last, y, slope, end], "waterline", (5,))
    begin, finish, value, rise, level = given.tolist()
    if not begin < finish:
        what = f"waterline: conic from x={digits(begin)} to x={digits(finish)}"
        raise GeometryError(what, "let it end beyond its beginning")
    height, s = value - level, -rise * (finish - begin)
    if not height > 0.0:
        what = f"waterline: half-breadth {digits(value)} not above {digits(level)} at the end"
        raise GeometryError(what, "give a conic that narrows", {"y1": value, "end": level})
    if abs(s - height) <= _STRAIGHT_CONIC * height:
        return FormulaPiece("line", begin, finish, np.array([value, level - value]))
    if s > height:
        over = "y1" if level == 0.0 else "y1 - A"
        what = f"waterline: y1' = {digits(s)} >= {over} = {digits(height)}: conic is not real "
        raise GeometryError(
            what + "near the end; move x1", "let it lie nearer to the end, or take less slope",
            {"slope": s, "y1": height},
        )  # fmt: skip
    b1, b2 = conic_coefficients(height, s).tolist()
    return FormulaPiece("conic", begin, finish, np.array([0.0, b1, b2]), level)


def conic_notes(slope: float) -> tuple[str, ...]:
    """Report a conic that bulges beyond its beginning; slope is dy/dv at v = 1, m."""
    s = number(slope, "waterline")
    return () if s >= 0.0 else (f"waterline: y1'<0: conic bulges beyond y1 (y1' = {digits(s)}).",)


def circle_piece(first: float, last: float, y: float, slope: float, end: float) -> FormulaPiece:
    """Make the arc that goes on from a curve with value and slope to a point.

    Parameters
    ----------
    first, last : float, m
        Where it begins and ends.
    y, slope : float, m and 1
        y and dy/dx at `first`.
    end : float, m
        y at `last`.

    Raises
    ------
    GeometryError
        No arc that is one function of x and bends downward: a line, one that bends upward, one
        that turns back.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.pieced_curve import circle_piece
    >>> round(float(circle_piece(0.0, 4.0, 5.0, 0.0, 3.0).at(3.0)), 9)
    4.0
    """
    begin, finish, value, rise, level = numbers(
        [first, last, y, slope, end], "circle", (5,)
    ).tolist()
    length, fall = finish - begin, level - value
    # Tangent (1, rise) and chord (length, fall): k = 2 (t x d)/|d|^2 with a unit tangent.
    cross = fall - rise * length
    steep = float(np.hypot(1.0, rise))
    if not (length > 0.0 and cross < -1e-12 * float(np.hypot(length, fall)) * steep):
        what = f"circle: no arc bends down from slope {digits(rise)} over a fall of {digits(-fall)}"
        raise GeometryError(what, "use a line, or a quintic", {"slope": rise, "fall": -fall})
    radius = (length * length + fall * fall) * steep / (-2.0 * cross)
    middle = (begin + radius * rise / steep, value - radius / steep)
    if level < middle[1]:
        what = f"circle: the arc turns back before x={digits(finish)}"
        raise GeometryError(what, "let it end higher, or further on", {"radius": radius})
    far = finish - middle[0]
    under = np.array([radius**2 - far**2, 2.0 * far * length, -(length**2)])
    return FormulaPiece("circle", begin, finish, under, middle[1])


# --------------------------------------------------------------------------------------
# Pieces, and curves made of them.
#
# A piece runs from `first` to `last` in x. It is a polynomial in u = (x - first)/(last - first),
# which is a line or a quintic, or stands upright at a level A = `base`,
#
#     (y - A)^2 = b0 + b1 v + b2 v^2 + b3 v^3,      v = (last - x)/(last - first),
#
# which is a conic (b0 = b3 = 0), a cubic conic (b0 = 0) or a circle.

Formula = Literal["line", "quintic", "conic", "cubic conic", "circle"]

_SLACK = 1e-12
"""An abscissa so far outside, in parts of the length, counts as the end."""


@attrs.frozen(eq=False)
class FormulaPiece:
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
        places = within_range(x, self.formula, self.first, self.last, slack)
        if self.base is None:
            u = (places - self.first) / self.length
            return np.asarray(polyval(u, polyder(self.coefficients, order)) / self.length**order)
        return self._root((self.last - places) / self.length, order)

    def _root(self, v: FloatArray, order: int) -> FloatArray:
        assert self.base is not None
        # Derivatives by x: v falls as x rises.
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
class PieceJoin:
    """What value, slope and second derivative do where two pieces join.

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
    pieces : tuple of FormulaPiece
        In order; each begins where the one before ends.
    notes : tuple of str
        What is to be known: warnings, each a whole sentence.
    name : str
        For messages.
    """

    pieces: tuple[FormulaPiece, ...]
    notes: tuple[str, ...] = ()
    name: str = "waterline"

    @classmethod
    def make(
        cls, pieces: tuple[FormulaPiece, ...], notes: tuple[str, ...] = (), name: str = "waterline"
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
                what = f"{name}: a piece ends at x={digits(one.last)}, the next begins at "
                what += digits(other.first)
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
        places = within_range(x, self.name, self.first, self.last, slack)
        breaks = np.array([piece.first for piece in self.pieces[1:]])
        which = np.searchsorted(breaks, places, "right")
        found = np.empty(places.shape)
        for index, piece in enumerate(self.pieces):
            mine = which == index
            found[mine] = piece.at(places[mine], order)
        return found

    def joins(self) -> tuple[PieceJoin, ...]:
        """Give for each join by how much value and slope differ, and both second derivatives."""
        found = list[PieceJoin]()
        for one, other in pairwise(self.pieces):
            ends = [(float(one.at(one.last, k)), float(other.at(one.last, k))) for k in range(3)]
            gap, turn = (after - before for before, after in ends[:2])
            found.append(PieceJoin(one.last, gap, turn, *ends[2]))
        return tuple(found)

    def area(self) -> float:
        """Give the area under the curve, m2."""
        return sum(piece.area() for piece in self.pieces)

    def off(self, offsets: ArrayLike) -> FloatArray:
        """Give by how much the curve passes above offsets (n, 2), m: (n,), m."""
        points = numbers(offsets, self.name, (None, 2))
        return self.at(points[:, 0]) - points[:, 1]


# --------------------------------------------------------------------------------------
# Cubic conics have one term more, so that they join what is before them with the same curvature,
#
#     (y - A)^2 = b1 v + b2 v^2 + b3 v^3,      v from 0 at the end to 1 at the join.
#
# Height Y1 = y - A, slope s and second derivative c by v at the join give, with
# z = Y1^2, z' = 2 Y1 s, z'' = 2 (s^2 + Y1 c):
#
#     b3 = z - z' + z''/2,    b2 = z''/2 - 3 b3,    b1 = z - b2 - b3.


def cubic_conic_coefficients(height: ArrayLike, slope: ArrayLike, bend: ArrayLike) -> FloatArray:
    """Give b1, b2, b3 of many cubic conics, (..., 3), m2.

    `height` is y - A at the join, `slope` and `bend` are dy/dv and d2y/dv2 there, m; d2y/dv2 is
    d2y/dx2 times the square of the length.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.pieced_curve import cubic_conic_coefficients
    >>> cubic_conic_coefficients(2.0, 1.0, -0.5).tolist()
    [4.0, 0.0, 0.0]
    """
    y, s, c = broadcast_numbers((height, slope, bend), "cubic conic")
    z, first, half = y * y, 2.0 * y * s, s * s + y * c
    b3 = z - first + half
    b2 = half - 3.0 * b3
    return np.stack([z - b2 - b3, b2, b3], axis=-1)


def cubic_conic(
    first: float, last: float, y: float, slope: float, second: float, end: float = 0.0
) -> FormulaPiece:
    """Make the cubic conic that goes on from a curve with value, slope and second derivative.

    Parameters
    ----------
    first, last : float, m
        The join, and the end, where the tangent is upright.
    y, slope, second : float, m, 1, 1/m
        y, dy/dx and d2y/dx2 at `first`.
    end : float, m
        A, half-breadth at `last`.

    Returns
    -------
    FormulaPiece
        Joins with continuous second derivative.

    Raises
    ------
    GeometryError
        ``"cubic conic: b1 <= 0 at the end"``, ``"cubic conic: radicand negative at v={v}"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.pieced_curve import cubic_conic
    >>> piece = cubic_conic(60.0, 75.0, 6.5, -0.2628518890, -0.0042571462)
    >>> piece.coefficients[1:].round(6).tolist(), float(piece.at(67.5).round(6))
    ([33.557188, 8.379506, 0.313306], 4.348866)
    """
    given = numbers([first, last, y, slope, second, end], "cubic conic", (6,))
    begin, finish, value, rise, bend, level = given.tolist()
    if not begin < finish:
        what = f"cubic conic: from x={digits(begin)} to x={digits(finish)}"
        raise GeometryError(what, "let it end beyond its beginning")
    length = finish - begin
    b = cubic_conic_coefficients(value - level, -rise * length, bend * length**2)
    return _checked(begin, finish, b, level)


def fit_cubic_conic(
    x: ArrayLike,
    y: ArrayLike,
    first: float,
    last: float,
    end: float = 0.0,
    value: float | None = None,
    slope: float | None = None,
) -> FormulaPiece:
    """Fit a cubic conic to offsets.

    Squares of heights are fitted, weighted by 1/(2 (y - A))^2, so that to first order the sum of
    squares of distances in y is least.

    Parameters
    ----------
    x, y : (n,), m
        Offsets; y above `end`.
    first, last : float, m
        Where it begins and ends.
    end : float, m
        A, half-breadth at `last`.
    value, slope : float or None, m and 1
        y and dy/dx at `first`, held where given; a slope only beside a value.

    Raises
    ------
    GeometryError
        As `cubic_conic`; offsets outside the piece or not above `end`, too few of them.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.pieced_curve import fit_cubic_conic
    >>> x = np.array([1.0, 4.0, 7.0, 9.5])
    >>> fit_cubic_conic(x, np.sqrt(4.0 * (10.0 - x)), 0.0, 10.0).coefficients.round(9).tolist()
    [0.0, 40.0, 0.0, 0.0]
    """
    limits = numbers([first, last, end], "cubic conic", (3,)).tolist()
    begin, finish, level = limits
    if not begin < finish:
        what = f"cubic conic: from x={digits(begin)} to x={digits(finish)}"
        raise GeometryError(what, "let it end beyond its beginning")
    places = numbers(x, "cubic conic", (None,))
    heights = numbers(y, "cubic conic", (len(places),)) - level
    v = (finish - places) / (finish - begin)
    bad = np.flatnonzero((v <= 0.0) | (v > 1.0) | (heights <= 0.0))
    if len(bad):
        what = f"cubic conic: offset at x={digits(places[bad[0]])} outside the piece"
        raise GeometryError(what, "leave it out", {"x": float(places[bad[0]])})
    columns = np.stack([v, v * v, v**3], axis=1)
    weights = 1.0 / (2.0 * heights) ** 2
    held, values = _held(value, slope, level, finish - begin)
    if len(held):
        fit = held_fit(columns, heights**2, held, values, weights, "cubic conic")
    else:
        fit = linear_fit(columns, heights**2, weights, "cubic conic")
    return _checked(begin, finish, fit.coefficients, level)


def _held(
    value: float | None, slope: float | None, level: float, length: float
) -> tuple[list[list[float]], list[float]]:
    """Give the equations of b1, b2, b3 at v = 1."""
    if value is None:
        if slope is not None:
            raise GeometryError("cubic conic: a slope without a value", "give both, or neither")
        return [], []
    height = number(value, "cubic conic") - level
    held, values = [[1.0, 1.0, 1.0]], [height * height]
    if slope is not None:
        rise = -number(slope, "cubic conic") * length
        held.append([1.0, 2.0, 3.0])
        values.append(2.0 * height * rise)
    return held, values


def _checked(first: float, last: float, b: FloatArray, level: float) -> FormulaPiece:
    """Make the piece of b1, b2, b3 (m2); refuse one that is not real all the way."""
    b1, b2, b3 = b.tolist()
    if b1 <= 0.0:
        what = f"cubic conic: b1 <= 0 at the end (b1 = {digits(b1)})"
        raise GeometryError(what, "move the join, or take less slope or bend", {"b1": b1})
    # The radicand is v times b1 + b2 v + b3 v^2: where that is least decides.
    places = [1.0]
    if b3 != 0.0 and 0.0 < -b2 / (2.0 * b3) < 1.0:
        places.append(-b2 / (2.0 * b3))
    for v in places:
        if b1 + b2 * v + b3 * v * v < 0.0:
            what = f"cubic conic: radicand negative at v={digits(v)}"
            raise GeometryError(what, "move the join, or take less slope or bend", {"v": v})
    return FormulaPiece("cubic conic", first, last, np.array([0.0, b1, b2, b3]), level)

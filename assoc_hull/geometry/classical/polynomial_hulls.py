"""Waterlines and whole hulls as polynomials, from form parameters or fitted to offsets.

Three ways, none of which needs another: polynomials that satisfy conditions (Taylor's quintic,
Chapman's parabola, Weinblum's product); series of Legendre's or Chebyshev's polynomials in x and z
by least squares; and a polynomial for each waterline whose coefficients are functions of draught.
Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, Table 1, which names them; the equations are the well-known ones.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal

import attrs
import numpy as np
from numpy.polynomial import chebyshev, legendre, polynomial
from numpy.polynomial.polynomial import polyval
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import (
    argument_text,
    broadcast_numbers,
    checked_list,
    digits,
    number,
    number_array,
    numbers,
    one_of,
    whole_number,
    within_range,
)
from assoc_hull.geometry.classical.linear_least_squares import linear_fit
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "DraftFunctions",
    "PolynomialHull",
    "SeriesHull",
    "chapman_parabola",
    "fit_polynomial_hull",
    "fit_series",
    "fit_series_hull",
    "form_polynomial",
    "product_hull",
    "series_columns",
    "taylor_quintic",
]

# --------------------------------------------------------------------------------------
# Polynomials of form parameters. D.W. Taylor's quintic runs from the end of the ship (x = 0) to
# midship (x = 1),
#
#     y = t x + a x^2 + b x^3 + c x^4 + d x^5,     y(1) = 1, y'(1) = 0, y''(1) = p, area C;
#
# t is the angle of the end, p the bend amidships, C the fullness. Any other set of linear
# conditions on any powers is `form_polynomial`. Products and parabolas stand at the end: Chapman's
# 1 - x^n, Weinblum's and Thieme's (1 - sum a_n |x|^n)(1 - sum b_m zeta^m), x from amidships, zeta
# from the waterline downward.

Condition = tuple[Literal["value", "slope", "bend", "area", "moment"], float, float]

_CONDITIONS = ("value", "slope", "bend", "area", "moment")


def taylor_quintic(t: ArrayLike, p: ArrayLike, c: ArrayLike) -> FloatArray:
    """Give Taylor's quintics.

    Parameters
    ----------
    t : (...)
        Slope at the end, in half-breadths by half length.
    p : (...)
        Second derivative amidships, in the same unit.
    c : (...)
        Area under the curve: the waterplane or prismatic coefficient of this half.

    Returns
    -------
    (..., 6)
        Ascending powers of x: 0, t, a, b, c, d. Evaluate by `numpy.polynomial`.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.polynomial_hulls import taylor_quintic
    >>> taylor_quintic(1.8, -2.2, 0.7).round(9).tolist()
    [0.0, 1.8, 2.3, -8.8, 8.5, -2.8]
    """
    end, bend, full = broadcast_numbers((t, p, c), "Taylor quintic")
    power = np.arange(2.0, 6.0)
    rows = np.stack([np.ones(4), power, power * (power - 1.0), 1.0 / (power + 1.0)])
    right = np.stack([1.0 - end, -end, bend, full - 0.5 * end], axis=-1)
    solved = np.linalg.solve(rows, right[..., None])[..., 0]
    return np.concatenate([np.stack([np.zeros_like(end), end], axis=-1), solved], axis=-1)


def form_polynomial(powers: Sequence[int], conditions: Sequence[Condition]) -> FloatArray:
    """Give the polynomial of some powers of x that satisfies conditions.

    Parameters
    ----------
    powers : sequence of int
        Of which it is made, 0 or more; as many as there are conditions.
    conditions : sequence of (str, float, float)
        What, where, how much: "value", "slope" or "bend" (second derivative) at x; "area" or
        "moment" (integral of x y) from 0 to x.

    Returns
    -------
    (n,)
        Ascending powers, up to the highest.

    Raises
    ------
    GeometryError
        Powers and conditions of other counts, conditions that no such polynomial or more than
        one satisfies.

    Examples
    --------
    A run that begins at 0.1 with slope 2 and has area 0.7 and moment 0.4 up to midship:

    >>> from assoc_hull.geometry.classical.polynomial_hulls import form_polynomial
    >>> run = form_polynomial(range(6), [("value", 0, 0.1), ("slope", 0, 2), ("value", 1, 1),
    ...                                  ("slope", 1, 0), ("area", 1, 0.7), ("moment", 1, 0.4)])
    >>> round(float(run.sum()), 9)
    1.0
    """
    kinds = [_condition(each) for each in checked_list(conditions, "form polynomial")]
    power = numbers(checked_list(powers, "form polynomial"), "form polynomial", (None,))
    if len(power) != len(kinds) or not len(power):
        what = f"form polynomial: {len(power)} powers, {len(kinds)} conditions"
        raise GeometryError(what, "give as many conditions as powers")
    if (power < 0.0).any() or (power % 1.0 != 0.0).any() or (power > 50.0).any():
        raise GeometryError("form polynomial: powers are not whole", "give 0 to 50")
    x = np.array([place for _, place, _ in kinds])[:, None]
    rows = np.empty((len(power), len(power)))
    for row, (kind, _, _), place in zip(rows, kinds, x, strict=True):
        row[:] = _row(kind, float(place[0]), power)
    # Rows are scaled before the rank is taken: powers far from x = 1 differ by many orders.
    size = np.abs(rows).max(axis=1, keepdims=True)
    if not (size > 0.0).all() or np.linalg.matrix_rank(rows / size) < len(power):
        what = "form polynomial: the conditions do not make one polynomial"
        raise GeometryError(what, "leave out a condition that says what another says")
    found = np.linalg.solve(rows / size, np.array([v for *_, v in kinds]) / size[:, 0])
    whole = np.zeros(int(power.max()) + 1)
    whole[power.astype(int)] = found
    return whole


def chapman_parabola(x: ArrayLike, n: float = 2.0) -> FloatArray:
    """Give Chapman's parabola 1 - x^n, x from 0 amidships to 1 at the end; in half-breadths.

    Raises
    ------
    GeometryError
        An x outside; a power that is not above 0.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.polynomial_hulls import chapman_parabola
    >>> round(float(chapman_parabola(0.4)), 12)
    0.84
    """
    power = number(n, "Chapman parabola")
    if power <= 0.0:
        what = f"Chapman parabola: power {digits(power)}"
        raise GeometryError(what, "give one above 0", {"n": power})
    return np.asarray(1.0 - within_range(x, "Chapman parabola", 0.0, 1.0) ** power)


def product_hull(x: ArrayLike, zeta: ArrayLike, a: ArrayLike, b: ArrayLike) -> FloatArray:
    """Give half-breadths y = (1 - sum a_n |x|^n)(1 - sum b_m zeta^m), in half beams.

    Parameters
    ----------
    x : (...)
        From -1 to 1, from midship in half lengths.
    zeta : (...)
        From 0 at the waterline to 1 at the keel.
    a, b : (n,), (m,)
        Coefficients of powers 1, 2, 3 ...

    Raises
    ------
    GeometryError
        Places outside.

    Examples
    --------
    Wigley's hull, a = b = (0, 1):

    >>> from assoc_hull.geometry.classical.polynomial_hulls import product_hull
    >>> float(product_hull(-0.5, 0.5, [0, 1], [0, 1]))
    0.5625
    """
    along = np.abs(within_range(x, "product hull", -1.0, 1.0))
    down = within_range(zeta, "product hull", 0.0, 1.0)
    first, second = (
        np.concatenate([[1.0], -numbers(each, "product hull", (None,))]) for each in (a, b)
    )
    along, down = broadcast_numbers((along, down), "product hull")
    return np.asarray(polyval(along, first) * polyval(down, second))


def _condition(given: Condition) -> Condition:
    try:
        kind, place, value = given
    except (TypeError, ValueError):
        what = f"form polynomial: condition {argument_text(given)}"
        raise GeometryError(what, "give (what, where, how much)") from None
    one_of(kind, tuple(_CONDITIONS), "form polynomial: no condition is called")
    x, wanted = numbers([place, value], "form polynomial", (2,)).tolist()
    return kind, x, wanted


def _row(kind: str, x: float, power: FloatArray) -> FloatArray:
    """Give what each power contributes to a condition at x, or from 0 to x."""
    match kind:
        case "value":
            row = x**power
        case "slope":
            row = power * x ** np.maximum(power - 1.0, 0.0)
        case "bend":
            row = power * (power - 1.0) * x ** np.maximum(power - 2.0, 0.0)
        case "area":
            row = x ** (power + 1.0) / (power + 1.0)
        case _:
            row = x ** (power + 2.0) / (power + 2.0)
    return np.asarray(row)


# --------------------------------------------------------------------------------------
# Series, by least squares (Kerwin, Lidbro, Martin, Kantorowitz):
#
#     y(x) = sum c_k P_k(xi),      y(x, z) = sum c_kl P_k(xi) P_l(zeta),
#
# xi and zeta run from -1 to 1 over the range. Further columns may be added, such as the root of the
# distance from an end where waterlines are round. `linear_least_squares` has fits with bounds, with
# edges held, and in discrete orthogonal polynomials, for the matrix of `series_columns`.

Basis = Literal["legendre", "chebyshev"]
Column = Callable[[FloatArray, FloatArray], FloatArray]

_VANDER = {"legendre": legendre.legvander, "chebyshev": chebyshev.chebvander}

_SLACK = 1e-12
"""So far outside, in parts of the span, a place counts as the end."""

_MOST = 60
"""Degrees above this say nothing about a hull."""


def fit_series(
    x: ArrayLike, y: ArrayLike, degree: int, basis: Basis = "legendre",
    span: tuple[float, float] = (-1.0, 1.0),
) -> FloatArray:  # fmt: skip
    """Fit a curve by a series.

    Parameters
    ----------
    x, y : (n,)
        More places than the degree.
    degree : int
    basis : str
        "legendre" or "chebyshev".
    span : (float, float)
        Of x; mapped to -1 ... 1.

    Returns
    -------
    (degree + 1,), the unit of y

    Raises
    ------
    GeometryError
        ``"series: rank-deficient (points too close together)"``, x outside the span, an
        unknown basis.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.polynomial_hulls import fit_series
    >>> x = np.linspace(-1.0, 1.0, 21)
    >>> round(float(fit_series(x, (1 - x**2) * (1 + 0.2 * x), 3, "chebyshev")[2]), 9)
    -0.5
    """
    places = numbers(x, "series", (None,))
    return linear_fit(series_columns(places, degree, basis, span), y, name="series").coefficients


def series_columns(
    x: ArrayLike, degree: int, basis: Basis = "legendre", span: tuple[float, float] = (-1.0, 1.0)
) -> FloatArray:
    """Give the values of the polynomials of a series at x (n,), (n, degree + 1).

    Raises GeometryError for x outside the span and for an unknown basis.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.polynomial_hulls import series_columns
    >>> series_columns([0.0, 10.0], 2, span=(0.0, 10.0)).tolist()
    [[1.0, -1.0, 1.0], [1.0, 1.0, 1.0]]
    """
    one = _VANDER[_known(basis)]
    return np.asarray(one(_mapped(numbers(x, "series", (None,)), span), _degree(degree)))


@attrs.frozen(eq=False)
class SeriesHull:
    """Half-breadths y(x, z) as a series in both.

    Attributes
    ----------
    coefficients : (m + 1, n + 1), m
        Of P_k(xi) P_l(zeta).
    extra : (e,)
        Of the further columns.
    basis : str
    x_span, z_span : (float, float), m
    columns : tuple of callable
        Further columns, each of x and z.
    rms : float, m
        Root mean square of the residuals at the offsets.
    """

    coefficients: FloatArray
    extra: FloatArray
    basis: Basis
    x_span: tuple[float, float]
    z_span: tuple[float, float]
    columns: tuple[Column, ...]
    rms: float

    def __attrs_post_init__(self) -> None:
        freeze(self.coefficients, self.extra)

    def at(self, x: ArrayLike, z: ArrayLike) -> FloatArray:
        """Give half-breadths at places of one shape, m.

        Raises
        ------
        GeometryError
            ``"series: x={x} outside [{a}, {b}]"``; shapes that do not go together.
        """
        along, up = _pair(x, z, self.x_span, self.z_span)
        degrees = (self.coefficients.shape[0] - 1, self.coefficients.shape[1] - 1)
        rows = _matrix(
            along.ravel(), up.ravel(), degrees, self.basis, (self.x_span, self.z_span), self.columns
        )
        found = rows @ np.concatenate([self.coefficients.ravel(), self.extra])
        return np.asarray(found.reshape(along.shape))


def fit_series_hull(
    x: ArrayLike,
    z: ArrayLike,
    y: ArrayLike,
    degrees: tuple[int, int],
    x_span: tuple[float, float],
    z_span: tuple[float, float],
    *,
    basis: Basis = "legendre",
    columns: Sequence[Column] = (),
    weights: ArrayLike | None = None,
) -> SeriesHull:
    """Fit a surface of half-breadths to offsets, which need not lie on a grid.

    Parameters
    ----------
    x, z, y : (n,), m
        Offsets.
    degrees : (int, int)
        In x and in z.
    x_span, z_span : (float, float), m
        Ranges that are mapped to -1 ... 1.
    basis : str
        "legendre" or "chebyshev".
    columns : sequence of callable
        Further columns: functions of x and z (n,) that give (n,).
    weights : (n,) or None

    Returns
    -------
    SeriesHull

    Raises
    ------
    GeometryError
        ``"series: rank-deficient (points too close together)"``; offsets outside, an unknown
        basis.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.polynomial_hulls import fit_series_hull
    >>> x, z = (each.ravel() for each in np.meshgrid(np.linspace(0, 9, 7), np.linspace(0, 4, 6)))
    >>> hull = fit_series_hull(x, z, x * (9 - x) * z, (2, 1), (0.0, 9.0), (0.0, 4.0))
    >>> round(float(hull.at(3.0, 1.0)), 9), hull.rms < 1e-12
    (18.0, True)
    """
    places = numbers(x, "series", (None,))
    levels = numbers(z, "series", (len(places),))
    along, up = _pair(places, levels, x_span, z_span)
    pair = checked_list(degrees, "series: degrees")
    if len(pair) != 2:
        raise GeometryError(f"series: {len(pair)} degrees", "give one in x and one in z")
    size = _degree(pair[0]), _degree(pair[1])
    further = tuple(checked_list(columns, "series: columns"))
    for column in further:
        if not callable(column):
            raise GeometryError(
                f"series: column {argument_text(column)}", "give a function of x and z"
            )
    rows = _matrix(along, up, size, _known(basis), (x_span, z_span), further)
    fit = linear_fit(rows, y, weights, "series")
    count = (size[0] + 1) * (size[1] + 1)
    table = fit.coefficients[:count].reshape(size[0] + 1, size[1] + 1).copy()
    extra = fit.coefficients[count:].copy()
    return SeriesHull(table, extra, basis, _span(x_span), _span(z_span), further, fit.rms)


def _matrix(
    x: FloatArray,
    z: FloatArray,
    degrees: tuple[int, int],
    basis: Basis,
    spans: tuple[tuple[float, float], tuple[float, float]],
    columns: tuple[Column, ...],
) -> FloatArray:
    """Give a row per place: products of polynomials, x outside, then further columns."""
    one = _VANDER[basis]
    across, up = one(_mapped(x, spans[0]), degrees[0]), one(_mapped(z, spans[1]), degrees[1])
    rows = (across[:, :, None] * up[:, None, :]).reshape(len(x), across.shape[1] * up.shape[1])
    more = [numbers(column(x, z), "series", (len(x),)) for column in columns]
    return np.column_stack([rows, *more])


def _pair(
    x: ArrayLike, z: ArrayLike, x_span: tuple[float, float], z_span: tuple[float, float]
) -> tuple[FloatArray, FloatArray]:
    along, up = broadcast_numbers((_within(x, x_span), _within(z, z_span)), "series")
    return along, up


def _mapped(x: FloatArray, span: tuple[float, float]) -> FloatArray:
    low, high = _span(span)
    return np.asarray(2.0 * (_within(x, span) - low) / (high - low) - 1.0)


def _within(x: ArrayLike, span: tuple[float, float]) -> FloatArray:
    low, high = _span(span)
    return within_range(x, "series", low, high, _SLACK * (high - low))


def _span(span: tuple[float, float]) -> tuple[float, float]:
    low, high = numbers(span, "series", (2,)).tolist()
    if not low < high:
        what = f"series: span from {digits(low)} to {digits(high)}"
        raise GeometryError(what, "give the lesser end first")
    return low, high


def _degree(degree: int) -> int:
    return whole_number(degree, "series: degree", 0, _MOST)


def _known(basis: Basis) -> Basis:
    one_of(basis, tuple(_VANDER), "series: no basis is called")
    return basis


# --------------------------------------------------------------------------------------
# Draft functions, the old way from waterlines to a hull (Taylor, Taggart, Williams, Miller and Kuo;
# Pien for sections over the length: levels are then stations). A waterline formula has coefficients
# c_k; each is fitted on its own over the draught, by a spline or by a polynomial. This is not the
# surface that fits the offsets best: errors of different coefficients add up where the formula
# amplifies them.

_NOTE = (
    "draft functions: each coefficient is fitted over the levels on its own, which is not the same"
    " as fitting a surface to the offsets."
)


@attrs.frozen(eq=False)
class DraftFunctions:
    """Coefficients of one formula at some levels, and between them.

    Attributes
    ----------
    levels : (n,), m
        Rising.
    values : (n, k)
        Coefficients at each.
    degree : int or None
        Of polynomials over the levels; None for splines through all values.
    notes : tuple of str
    """

    levels: FloatArray
    values: FloatArray
    degree: int | None
    notes: tuple[str, ...]
    _pieces: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.levels, self.values, self._pieces)

    @classmethod
    def make(
        cls, levels: ArrayLike, values: ArrayLike, degree: int | None = None
    ) -> DraftFunctions:
        """Fit each coefficient over the levels.

        Parameters
        ----------
        levels : (n,), m
            Two or more, rising.
        values : (n, k)
            Coefficients at each level.
        degree : int or None
            Of polynomials of least squares; None for a cubic spline through all, its
            ends free (no knot beside them).

        Raises
        ------
        GeometryError
            Levels that do not rise, too few of them.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.polynomial_hulls import DraftFunctions
        >>> functions = DraftFunctions.make([0, 2, 5], [[1, 0], [1, 4], [1, 25]], degree=2)
        >>> functions.at(3.0).round(9).tolist()
        [1.0, 9.0]
        """
        from scipy.interpolate import CubicSpline

        z = numbers(levels, "draft functions", (None,))
        table = numbers(values, "draft functions", (len(z), None))
        if len(z) < 2 or not (np.diff(z) > 0.0).all():
            what = f"draft functions: {len(z)} levels that do not all rise"
            raise GeometryError(what, "give two or more, from below upward")
        if degree is None:
            pieces = CubicSpline(z, table).c
        else:
            pieces = _polynomials(z, table, degree)
        return cls(z, table, degree, (_NOTE,), np.array(pieces))

    def at(self, z: ArrayLike) -> FloatArray:
        """Give the coefficients on levels of any shape, (..., k).

        Raises
        ------
        GeometryError
            ``"draft functions: x={z} outside [{a}, {b}]"``.
        """
        from scipy.interpolate import PPoly

        low, high = self.levels[[0, -1]].tolist()
        places = within_range(z, "draft functions", low, high, _SLACK * (high - low))
        if self.degree is None:
            return np.asarray(PPoly(self._pieces, self.levels)(places))
        found = polynomial.polyval(_unit(places, self.levels), self._pieces)
        return np.asarray(np.moveaxis(found, 0, -1))


@attrs.frozen(eq=False)
class PolynomialHull:
    """Waterlines y = sum c_k(z) x^k (or sections, with the roles of x and z exchanged).

    Attributes
    ----------
    functions : DraftFunctions
    span : (float, float)
        The range of x.
    rms : (n,), m
        Root mean square residual of each waterline at its own level, before draft functions.
    """

    functions: DraftFunctions
    span: tuple[float, float]
    rms: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.rms)

    def at(self, x: ArrayLike, z: ArrayLike) -> FloatArray:
        """Give half-breadths at places of one shape, m; x in the unit of the fit.

        Raises
        ------
        GeometryError
            ``"polynomial hull: x={x} outside [{a}, {b}]"``; levels outside; other shapes.
        """
        low, high = self.span
        along = within_range(x, "polynomial hull", low, high, _SLACK * (high - low))
        level = number_array(z, "polynomial hull")
        if along.shape != level.shape:
            what = f"polynomial hull: x of shape {along.shape}, z of shape {level.shape}"
            raise GeometryError(what, "give places of one shape")
        power = np.arange(self.functions.values.shape[1])
        return np.asarray(np.sum(self.functions.at(level) * along[..., None] ** power, axis=-1))


def fit_polynomial_hull(
    x: ArrayLike, levels: ArrayLike, y: ArrayLike, degree: int, draft_degree: int | None = None
) -> PolynomialHull:
    """Fit a polynomial to each waterline of a table, and draft functions to its coefficients.

    Parameters
    ----------
    x : (m,), 1
        Stations, scaled so that they run from -1 to 1 or from 0 to 1.
    levels : (n,), m
        Waterlines.
    y : (n, m), m
        Half-breadths.
    degree, draft_degree : int, int or None
        Of waterlines, and of draft functions (None: splines).

    Raises
    ------
    GeometryError
        As `linear_fit` and `DraftFunctions.make`.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.polynomial_hulls import fit_polynomial_hull
    >>> x, z = np.linspace(-1.0, 1.0, 9), np.linspace(0.0, 4.0, 5)
    >>> hull = fit_polynomial_hull(x, z, np.outer(z, 1.0 - x**2), 2, 1)
    >>> round(float(hull.at(0.5, 3.0)), 9)
    2.25
    """
    at = within_range(numbers(x, "polynomial hull", (None,)), "polynomial hull", -1.0, 1.0)
    z = numbers(levels, "polynomial hull", (None,))
    table = numbers(y, "polynomial hull", (len(z), len(at)))
    whole_number(degree, "polynomial hull: degree", 0, len(at) - 1)
    rows = polynomial.polyvander(at, degree)
    fits = [linear_fit(rows, each, name="polynomial hull") for each in table]
    values = np.array([fit.coefficients for fit in fits])
    return PolynomialHull(
        DraftFunctions.make(z, values, draft_degree),
        (float(at.min()), float(at.max())),
        np.array([fit.rms for fit in fits]),
    )


def _unit(z: FloatArray, levels: FloatArray) -> FloatArray:
    """Map the range of levels (m) to 0 ... 1."""
    return np.asarray((z - levels[0]) / (levels[-1] - levels[0]))


def _polynomials(z: FloatArray, table: FloatArray, degree: int) -> FloatArray:
    most = whole_number(degree, "draft functions: degree", 0, len(z) - 1)
    return np.asarray(polynomial.polyfit(_unit(z, z), table, most), np.float64)

"""Curves and surfaces as series of Legendre's or Chebyshev's polynomials, by least squares.

    y(x) = sum c_k P_k(xi),      y(x, z) = sum c_kl P_k(xi) P_l(zeta),

xi and zeta run from -1 to 1 over the range. Further columns may be added, such as the root of the
distance from an end where waterlines are round. `linear_fits` has fits with bounds, with edges
held, and in discrete orthogonal polynomials, for the matrix of `series_columns`.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, Table 1 (Kerwin, Lidbro, Martin, Kantorowitz).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal

import attrs
import numpy as np
from numpy.polynomial import chebyshev, legendre
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import listed, numbers, together, whole_number
from assoc_hull.geometry.classical.checks import called, figure, inside
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.classical.linear_least_squares import linear_fit
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["SeriesHull", "fit_series", "fit_series_hull", "series_columns"]

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
    >>> from assoc_hull.geometry.classical.series_hulls import fit_series
    >>> x = np.linspace(-1.0, 1.0, 21)
    >>> round(float(fit_series(x, (1 - x**2) * (1 + 0.2 * x), 3, "chebyshev")[2]), 9)
    -0.5
    """
    places = numbers(x, "series", (None,))
    return linear_fit(series_columns(places, degree, basis, span), y, name="series").coefficients


def series_columns(
    x: ArrayLike, degree: int, basis: Basis = "legendre", span: tuple[float, float] = (-1.0, 1.0)
) -> FloatArray:
    """Give the values of the polynomials of a series, (n, degree + 1).

    Raises
    ------
    GeometryError
        x outside the span, an unknown basis.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.series_hulls import series_columns
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
        Root of the mean square of what the offsets are off.
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
    >>> from assoc_hull.geometry.classical.series_hulls import fit_series_hull
    >>> x, z = (each.ravel() for each in np.meshgrid(np.linspace(0, 9, 7), np.linspace(0, 4, 6)))
    >>> hull = fit_series_hull(x, z, x * (9 - x) * z, (2, 1), (0.0, 9.0), (0.0, 4.0))
    >>> round(float(hull.at(3.0, 1.0)), 9), hull.rms < 1e-12
    (18.0, True)
    """
    places = numbers(x, "series", (None,))
    levels = numbers(z, "series", (len(places),))
    along, up = _pair(places, levels, x_span, z_span)
    pair = listed(degrees, "series: degrees")
    if len(pair) != 2:
        raise GeometryError(f"series: {len(pair)} degrees", "give one in x and one in z")
    size = _degree(pair[0]), _degree(pair[1])
    further = tuple(listed(columns, "series: columns"))
    for column in further:
        if not callable(column):
            raise GeometryError(f"series: column {called(column)}", "give a function of x and z")
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
    along, up = together((_within(x, x_span), _within(z, z_span)), "series")
    return along, up


def _mapped(x: FloatArray, span: tuple[float, float]) -> FloatArray:
    low, high = _span(span)
    return np.asarray(2.0 * (_within(x, span) - low) / (high - low) - 1.0)


def _within(x: ArrayLike, span: tuple[float, float]) -> FloatArray:
    low, high = _span(span)
    return inside(x, "series", low, high, _SLACK * (high - low))


def _span(span: tuple[float, float]) -> tuple[float, float]:
    low, high = numbers(span, "series", (2,)).tolist()
    if not low < high:
        what = f"series: span from {figure(low)} to {figure(high)}"
        raise GeometryError(what, "give the lesser end first")
    return low, high


def _degree(degree: int) -> int:
    return whole_number(degree, "series: degree", 0, _MOST)


def _known(basis: Basis) -> Basis:
    one_of(basis, tuple(_VANDER), "series: no basis is called")
    return basis

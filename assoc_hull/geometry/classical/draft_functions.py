"""Coefficients of a formula as functions of draught: the old way from waterlines to a hull.

A waterline formula (Taylor's quintic, a polynomial of least squares, an expansion) has coefficients
c_k. Each is fitted on its own over the draught, by a spline through its values or by a polynomial;
formula and functions are then a surface. This is not the surface that fits the offsets best: errors
of different coefficients add up where the formula amplifies them.

The same works for sections over the length: levels are then stations.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, Table 1 (Taylor, Taggart, Williams, Miller and Kuo; Pien for sections).
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import numbers, places, whole_number
from assoc_hull.geometry.classical.checks import inside
from assoc_hull.geometry.classical.linear_least_squares import linear_fit
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["DraftFunctions", "PolynomialHull", "fit_polynomial_hull"]

_NOTE = (
    "draft functions: each coefficient is fitted over the levels on its own, which is not the same"
    " as fitting a surface to the offsets."
)


_SLACK = 1e-12
"""So far outside, in parts of the range, a level counts as the end."""


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
        >>> from assoc_hull.geometry.classical.draft_functions import DraftFunctions
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
        places = inside(z, "draft functions", low, high, _SLACK * (high - low))
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
        Of each waterline at its own level, before draft functions.
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
        along = inside(x, "polynomial hull", low, high, _SLACK * (high - low))
        level = places(z, "polynomial hull")
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
    >>> from assoc_hull.geometry.classical.draft_functions import fit_polynomial_hull
    >>> x, z = np.linspace(-1.0, 1.0, 9), np.linspace(0.0, 4.0, 5)
    >>> hull = fit_polynomial_hull(x, z, np.outer(z, 1.0 - x**2), 2, 1)
    >>> round(float(hull.at(0.5, 3.0)), 9)
    2.25
    """
    at = inside(numbers(x, "polynomial hull", (None,)), "polynomial hull", -1.0, 1.0)
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
    return np.asarray((z - levels[0]) / (levels[-1] - levels[0]))


def _polynomials(z: FloatArray, table: FloatArray, degree: int) -> FloatArray:
    most = whole_number(degree, "draft functions: degree", 0, len(z) - 1)
    return np.asarray(polynomial.polyfit(_unit(z, z), table, most), np.float64)

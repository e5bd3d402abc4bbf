"""A polynomial of degree five by least squares, its end values and end slopes held.

With u from 0 to 1 and slopes by u (that by x times the length),

    y = S(u) + q(u) (r0 + r1 (2u - 1) + ...),        q = u^2 (1 - u)^2,

S is the cubic through both end values with both slopes, q and its multiples change neither. Where a
slope is not given, its factor is of first order only, S is of a lower degree, and one more
coefficient is free. What is printed as a4 u^2 (1-u)^2 + a5 u^2 (1-u)^2 (u+2), with the normal
equations of a4 and a5, is the same space of polynomials in a basis of worse condition:
a4 = r0 - 5 r1, a5 = 2 r1.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, eqs 22 to 31. Errors of print there: S has y1 u in place of the slope at 0
times u, and the last formula of a4 has a product of two sums where their
difference belongs.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.polynomial.polynomial import polyder, polyval, polyvander
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import (
    number,
    numbers,
    places,
    weights_of,
    whole_number,
)
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.classical.linear_least_squares import linear_fit
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Quintic", "fit_quintic"]

_SHAPES = ([1.0], [-1.0, 2.0], [1.0, -6.0, 6.0], [-1.0, 12.0, -30.0, 20.0])
"""Legendre's polynomials of 2u - 1 in ascending powers of u."""


@attrs.frozen(eq=False)
class Quintic:
    """A polynomial of degree five over u from 0 to 1.

    Attributes
    ----------
    coefficients : (6,), m
        Ascending powers of u.
    rms : float, m
        Root of the (weighted) mean square of what the data are off.
    """

    coefficients: FloatArray
    rms: float

    def __attrs_post_init__(self) -> None:
        freeze(self.coefficients)

    def at(self, u: ArrayLike, order: int = 0) -> FloatArray:
        """Give values, or derivatives by u, in the shape of `u`; m.

        Raises
        ------
        GeometryError
            ``"quintic: u={u} outside [0,1]"``.
        """
        n = whole_number(order, "quintic: derivative of order", 0, 5)
        return np.asarray(polyval(_unit(u), polyder(self.coefficients, n)))


def fit_quintic(
    u: ArrayLike,
    y: ArrayLike,
    y0: float,
    y1: float,
    d0: float | None,
    d1: float | None,
    weights: ArrayLike | None = None,
) -> Quintic:
    """Fit a polynomial of degree five to data.

    Parameters
    ----------
    u : (n,)
        Places from 0 to 1.
    y : (n,), m
        Values there; approximated, not met.
    y0, y1 : float, m
        Values at u = 0 and u = 1, met.
    d0, d1 : float or None, m
        Slopes dy/du at both ends, met: dy/dx times (x_end - x_start). None leaves a slope to
        the data, and wants one more of them.
    weights : (n,) or None
        Above 0; 1 if None.

    Returns
    -------
    Quintic

    Raises
    ------
    GeometryError
        ``"quintic: u={u} outside [0,1]"``, ``"quintic: needs 2 distinct interior u, got {k}"``
        (3 or 4 if slopes are not given), ``"quintic: rank-deficient (points too close
        together)"``, ``"quintic: weights must be positive"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.quintic import fit_quintic
    >>> u, y = (0.1, 0.25, 0.4, 0.55, 0.7, 0.85), (7.93, 7.58, 6.94, 6, 4.7, 2.95)
    >>> fit = fit_quintic(u, y, 8.0, 1.0, 0.0, -14.0)
    >>> float(fit.at(0.5).round(9)), round(fit.rms, 9)
    (6.351096452, 0.020009596)
    """
    at = _unit(numbers(u, "quintic", (None,)))
    values = numbers(y, "quintic", (len(at),))
    w = weights_of(weights, len(at), "quintic")
    base, factor = _base(*_ends(y0, y1, d0, d1))
    count = 7 - len(factor)
    interior = len(np.unique(at[(at > 0.0) & (at < 1.0)]))
    if interior < count:
        raise GeometryError(
            f"quintic: needs {count} distinct interior u, got {interior}", "give more points",
            {"needed": count, "got": interior},
        )  # fmt: skip
    powers = np.zeros((6, count))
    for column, shape in zip(powers.T, _SHAPES, strict=False):
        product = np.convolve(factor, shape)
        column[: len(product)] = product
    vander = polyvander(at, 5)
    columns = polyval(at, factor)[:, None] * legvander(2.0 * at - 1.0, count - 1)
    fit = linear_fit(columns, values - vander @ base, w, "quintic")
    return Quintic(base + powers @ fit.coefficients, fit.rms)


def _unit(u: ArrayLike) -> FloatArray:
    found = places(u, "quintic")
    outside = found[(found < 0.0) | (found > 1.0)]
    if outside.size:
        first = float(outside.flat[0])
        what = f"quintic: u={figure(first)} outside [0,1]"
        raise GeometryError(what, "ask between the ends", {"u": first})
    return found


def _ends(
    y0: float, y1: float, d0: float | None, d1: float | None
) -> tuple[float, float, float | None, float | None]:
    first, last = (number(each, "quintic") for each in (y0, y1))
    slopes = (None if each is None else number(each, "quintic") for each in (d0, d1))
    return first, last, *slopes  # type: ignore[return-value]


def _base(
    y0: float, y1: float, d0: float | None, d1: float | None
) -> tuple[FloatArray, list[float]]:
    """Give S of the least degree with the ends as given, (6,), and q, which leaves them so."""
    rise = y1 - y0
    base = np.zeros(6)
    if d0 is None and d1 is None:
        base[:2], factor = (y0, rise), [0.0, 1.0, -1.0]
    elif d1 is None:
        assert d0 is not None
        base[:3], factor = (y0, d0, rise - d0), [0.0, 0.0, 1.0, -1.0]
    elif d0 is None:
        base[:3], factor = (y0, 2.0 * rise - d1, d1 - rise), [0.0, 1.0, -2.0, 1.0]
    else:
        base[:4] = y0, d0, 3.0 * rise - 2.0 * d0 - d1, d0 + d1 - 2.0 * rise
        factor = [0.0, 0.0, 1.0, -2.0, 1.0]
    return base, factor

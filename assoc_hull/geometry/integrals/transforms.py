"""Chebyshev and sine series of functions that are smooth between breaks.

A function y of xi in [-1, 1] is expanded as

    y = sum_k c_k T_k(xi),                  k = 0, 1, ...   (Chebyshev)
    y = sum_k b_k sin(k pi (xi + 1) / 2),   k = 1, 2, ...   (half-range sine)

A rule over the whole range would see a kink as a wave of any length: each piece between breaks
is integrated for itself, with ever more nodes, until the coefficients stand still.

Sources: T.J. Rivlin, "The Chebyshev Polynomials", Wiley 1974; J.P. Boyd, "Chebyshev and Fourier
Spectral Methods", 2nd ed., Dover 2001.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeVar

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.arguments import integer, positive
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.quadrature import bunched

__all__ = [
    "MOST_TERMS",
    "ComplexArray",
    "Series",
    "Truncation",
    "angle",
    "basis",
    "chebyshev",
    "checked_terms",
    "composite",
    "edges_of",
    "evaluate_series",
    "settled",
    "sine",
    "spread",
    "truncation",
]

Series = Literal["chebyshev", "sine"]
Values = Callable[[FloatArray], FloatArray]
ComplexArray = NDArray[np.complex128]
Sums = TypeVar("Sums", FloatArray, ComplexArray)

MOST_TERMS = 500
"""Beyond, a series says nothing about a curve that its points do not say better."""

_WHERE = "in a transform"
_POINTS = 32  # nodes of a panel
_PER_PANEL = 8  # so many half waves of the last term may lie in one
_DOUBLINGS = 6
_NIL = 1e-290  # below, numbers lose their digits: such a curve is nil
_EDGE = 1e-15  # so near to an end of the range xi is at it


@attrs.frozen(eq=False)
class Truncation:
    """What is left of a curve when its series ends after n terms, n = 1, 2, ...

    Attributes
    ----------
    rms : (terms,), the unit of the curve
        Root of the mean square of the difference.
    largest : (terms,), the unit of the curve
        Largest difference among the places that were compared.
    """

    rms: FloatArray
    largest: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.rms, self.largest)


def angle(xi: FloatArray) -> FloatArray:
    """Give theta of ``xi = cos(theta)``; what rounding has put off an end is at the end."""
    inside = np.clip(xi, -1.0, 1.0)
    at_end = np.abs(inside) > 1.0 - _EDGE
    found: FloatArray = np.arccos(np.where(at_end, np.sign(inside), inside))
    return found


def basis(kind: Series, place: int, xi: FloatArray) -> FloatArray:
    """Give one function of a series; `place` counts from 0 in both kinds.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.transforms import basis
    >>> basis("chebyshev", 2, np.array([0.5])).round(12).tolist()  # 2 xi^2 - 1
    [-0.5]
    """
    if kind == "chebyshev":
        found: FloatArray = np.cos(place * angle(xi))
    else:
        found = np.sin((place + 1) * (0.5 * np.pi) * (xi + 1.0))
    return found


def checked_terms(terms: object) -> int:
    """Take the number of terms of a series."""
    return integer(terms, "terms", _WHERE, least=1, most=MOST_TERMS)


def composite(panels: int) -> tuple[FloatArray, FloatArray]:
    """Give nodes and weights on [0, 1] of the bunched rule on equal panels."""
    nodes, weights = bunched(_POINTS)
    places = (np.arange(panels)[:, None] + nodes) / panels
    return places.ravel(), np.tile(weights / panels, panels)


def settled(
    integrate: Callable[[FloatArray, FloatArray], tuple[Sums, float]],
    waves: float,
    tolerance: float,
) -> Sums:
    """Integrate with ever more nodes until nothing changes.

    Parameters
    ----------
    integrate : callable
        From nodes and weights on [0, 1], used on every piece, to integrals (of any shape) and
        the size of what is integrated.
    waves : float
        Half waves of the last term on the widest piece: by these the first rule is chosen.
    tolerance : float
        By this part of the size integrals may still change.

    Raises
    ------
    BadInputError
        They go on changing: there is a break that was not given.
    """
    panels = 1 + int(waves / _PER_PANEL)
    coarse, size = integrate(*composite(panels))
    change = np.inf
    for _ in range(_DOUBLINGS):
        panels *= 2
        fine, size = integrate(*composite(panels))
        if not np.isfinite(fine).all():
            raise BadInputError("a value that is not finite", _WHERE, "give finite values")
        change = float(np.abs(fine - coarse).max(initial=0.0))
        if change <= tolerance * max(size, _NIL):
            freeze(fine)
            return fine
        coarse = fine
    what = f"coefficients still change by {change / size:.2g} of the largest value"
    raise BadInputError(what, _WHERE, "give the places where the curve bends or jumps as breaks")


def chebyshev(
    values: Values, terms: int, breaks: ArrayLike = (), tolerance: float = 1e-12
) -> FloatArray:
    """Give Chebyshev coefficients of a function that is smooth between breaks.

    Parameters
    ----------
    values : callable, (q,) -> (..., q)
        The function, or several with the same breaks, at q places in [-1, 1].
    terms : int
        Number of coefficients, c_0 to c_(terms - 1).
    breaks : (b,)
        Places inside [-1, 1] where it bends or jumps, in any order.
    tolerance : float
        Error of the coefficients, in parts of the largest value.

    Returns
    -------
    (..., terms), the unit of the function
        ``c_k = (2 - delta_k0) / pi * integral of y(cos th) cos(k th) over th from 0 to pi``.

    Raises
    ------
    BadInputError
        A break outside, no whole number of terms, or values that are not smooth between breaks.

    Examples
    --------
    >>> from assoc_hull.geometry.integrals.transforms import chebyshev
    >>> (chebyshev(lambda xi: 1.0 - xi**2, 3) + 0.0).round(12).tolist()
    [0.5, 0.0, -0.5]
    """
    count, allowed = checked_terms(terms), positive(tolerance, "tolerance", _WHERE)
    edges = np.arccos(edges_of(breaks))[::-1]
    factor = np.where(np.arange(count) == 0, 1.0, 2.0) / np.pi

    def integrate(nodes: FloatArray, weights: FloatArray) -> tuple[FloatArray, float]:
        theta, step = spread(edges, nodes, weights)
        xi = np.clip(np.cos(theta), -1.0, 1.0)
        return _sums("chebyshev", values(xi), step, xi, count, factor)

    return settled(integrate, count * np.diff(edges).max() / np.pi, allowed)


def sine(
    values: Values, terms: int, breaks: ArrayLike = (), tolerance: float = 1e-12
) -> FloatArray:
    """Give half-range sine coefficients of a function that is smooth between breaks.

    Parameters
    ----------
    values, breaks, tolerance
        As in `chebyshev`.
    terms : int
        Number of coefficients, b_1 to b_terms.

    Returns
    -------
    (..., terms), the unit of the function
        ``b_k = integral of y sin(k pi (xi + 1) / 2) over xi from -1 to 1``.

    Raises
    ------
    BadInputError
        As `chebyshev` does.

    Examples
    --------
    >>> from assoc_hull.geometry.integrals.transforms import sine
    >>> round(float(sine(lambda xi: 1.0 - xi**2, 1)[0]), 10)  # 32 / pi^3
    1.0320491019
    """
    count, allowed = checked_terms(terms), positive(tolerance, "tolerance", _WHERE)
    edges, factor = edges_of(breaks), np.ones(count)

    def integrate(nodes: FloatArray, weights: FloatArray) -> tuple[FloatArray, float]:
        xi, step = spread(edges, nodes, weights)
        return _sums("sine", values(xi), step, xi, count, factor)

    return settled(integrate, count * np.diff(edges).max() / 2.0, allowed)


def evaluate_series(kind: Series, coefficients: FloatArray, xi: ArrayLike) -> FloatArray:
    """Add up a series.

    Parameters
    ----------
    kind : "chebyshev" or "sine"
        Of which functions.
    coefficients : (..., terms)
        From c_0, or from b_1.
    xi : (q,)
        Places in [-1, 1].

    Returns
    -------
    (..., q), the unit of the coefficients
        The values.

    Raises
    ------
    BadInputError
        A place outside.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.transforms import evaluate_series
    >>> evaluate_series("chebyshev", np.array([0.5, 0.0, -0.5]), [0.0, 0.5]).round(12).tolist()
    [1.0, 0.75]
    """
    at = np.asarray(xi, np.float64)
    if at.ndim != 1 or not (np.abs(at) <= 1.0 + 1e-12).all():
        raise BadInputError("a place outside -1 to 1", _WHERE, "give places of the range")
    total = np.zeros((*coefficients.shape[:-1], len(at)))
    for place in range(coefficients.shape[-1]):
        total += coefficients[..., place, None] * basis(kind, place, at)
    freeze(total)
    return total


def truncation(
    kind: Series, coefficients: FloatArray, xi: FloatArray, y: FloatArray, weights: FloatArray
) -> Truncation:
    """Compare the first n terms of a series with the curve, for every n.

    Parameters
    ----------
    kind : "chebyshev" or "sine"
        Of which functions.
    coefficients : (terms,)
        Of the series.
    xi, y, weights : (q,)
        Places and values of the curve, and weights of a rule for integrals over xi.

    Returns
    -------
    Truncation
        The rms is ``sqrt(1/2 integral of (y - y_n)^2 dxi)``.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.transforms import truncation
    >>> xi = np.array([-1.0, 0.0, 1.0])
    >>> left = truncation("chebyshev", np.array([0.0, 1.0]), xi, xi, np.array([1.0, 4.0, 1.0]) / 3)
    >>> left.rms.round(4).tolist(), left.largest.tolist()
    ([0.5774, 0.0], [1.0, 0.0])
    """
    rest = y.copy()
    rms, largest = np.zeros(len(coefficients)), np.zeros(len(coefficients))
    for place, coefficient in enumerate(coefficients.tolist()):
        rest -= coefficient * basis(kind, place, xi)
        rms[place] = np.sqrt(0.5 * (weights * rest**2).sum())
        largest[place] = np.abs(rest).max()
    return Truncation(rms, largest)


def _sums(
    kind: Series, y: FloatArray, step: FloatArray, xi: FloatArray, terms: int, factor: FloatArray
) -> tuple[FloatArray, float]:
    """Give the integrals of y times each function, and the largest value."""
    given = np.asarray(y, np.float64)
    if given.shape[-1:] != xi.shape:
        what = f"values of shape {given.shape} at {len(xi)} places"
        raise BadInputError(what, _WHERE, "give a function of an array")
    weighted = given * step
    parts = [(weighted * basis(kind, place, xi)).sum(axis=-1) for place in range(terms)]
    return np.stack(parts, axis=-1) * factor, float(np.abs(given).max(initial=0.0))


def edges_of(breaks: ArrayLike) -> FloatArray:
    """Give the ends of the pieces, ascending, from -1 to 1."""
    given = np.asarray(breaks, np.float64)
    if given.ndim != 1 or not (np.abs(given) <= 1.0).all():
        raise BadInputError("a break outside -1 to 1", _WHERE, "give places inside the range")
    return np.unique(np.concatenate([[-1.0], given, [1.0]]))


def spread(
    edges: FloatArray, nodes: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Put a rule on every piece between edges: places and weights, (q,)."""
    wide = np.diff(edges)[:, None]
    places = edges[:-1, None] + wide * nodes
    return places.ravel(), (wide * weights).ravel()

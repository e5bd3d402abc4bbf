"""Chebyshev and sine series of curves, and Fourier descriptors of closed ones.

A function that is smooth between breaks is expanded piece by piece: a rule over the whole range
would see a kink as a wave of any length. For chains of cubics the integrals run along the curve,
not over the abscissa, so that upright steps and vertical tangents at the ends are as good as any
other place. `Truncation` says what is left of a curve when its series ends early.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeVar

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.arguments import integer, positive
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.integrals.chains import PlaneChains
from assoc_hull.geometry.numeric.quadrature import bunched_rule
from assoc_hull.geometry.splines.arc_length import arc_length, length_at

__all__ = [
    "MOST_TERMS",
    "ComplexArray",
    "Series",
    "Truncation",
    "chebyshev_of_chains",
    "chebyshev_of_function",
    "checked_terms",
    "composite_rule",
    "descriptor_truncation",
    "evaluate_descriptors",
    "evaluate_series",
    "fourier_descriptors",
    "function_samples",
    "integrate_until_settled",
    "length_of_chains",
    "piece_edges",
    "rule_on_pieces",
    "series_angle",
    "series_function",
    "sine_of_chains",
    "sine_of_function",
    "truncation",
]

# --------------------------------------------------------------------------------------
# Series of functions that are smooth between breaks: y of xi in [-1, 1] is expanded as
#
#     y = sum_k c_k T_k(xi),                  k = 0, 1, ...   (Chebyshev)
#     y = sum_k b_k sin(k pi (xi + 1) / 2),   k = 1, 2, ...   (half-range sine)
#
# Each piece is integrated for itself, with ever more nodes, until the coefficients settle.
# Sources: T.J. Rivlin, "The Chebyshev Polynomials", Wiley 1974; J.P. Boyd, "Chebyshev and Fourier
# Spectral Methods", 2nd ed., Dover 2001.

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
_SMALLEST = 1e-290  # below, numbers lose their digits: such a curve counts as zero
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


def series_angle(xi: FloatArray) -> FloatArray:
    """Give theta of ``xi = cos(theta)``; what rounding has put off an end is at the end."""
    inside = np.clip(xi, -1.0, 1.0)
    at_end = np.abs(inside) > 1.0 - _EDGE
    found: FloatArray = np.arccos(np.where(at_end, np.sign(inside), inside))
    return found


def series_function(kind: Series, place: int, xi: FloatArray) -> FloatArray:
    """Give one function of a series; `place` counts from 0 in both kinds.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.series import series_function
    >>> series_function("chebyshev", 2, np.array([0.5])).round(12).tolist()  # 2 xi^2 - 1
    [-0.5]
    """
    if kind == "chebyshev":
        found: FloatArray = np.cos(place * series_angle(xi))
    else:
        found = np.sin((place + 1) * (0.5 * np.pi) * (xi + 1.0))
    return found


def checked_terms(terms: object) -> int:
    """Take the number of terms of a series."""
    return integer(terms, "terms", _WHERE, least=1, most=MOST_TERMS)


def composite_rule(panels: int) -> tuple[FloatArray, FloatArray]:
    """Give nodes and weights on [0, 1] of the bunched rule on equal panels."""
    nodes, weights = bunched_rule(_POINTS)
    places = (np.arange(panels)[:, None] + nodes) / panels
    return places.ravel(), np.tile(weights / panels, panels)


def integrate_until_settled(
    integrate: Callable[[FloatArray, FloatArray], tuple[Sums, float]],
    waves: float,
    tolerance: float,
) -> Sums:
    """Integrate with ever more nodes until the integrals settle.

    `integrate` gives integrals (of any shape) and the size of what is integrated, from nodes and
    weights on [0, 1] that it uses on every piece. `waves` are half waves of the last term on the
    widest piece: by these the first rule is chosen. By the part `tolerance` of the size the
    integrals may still change.

    Raises
    ------
    BadInputError
        They go on changing: there is a break that was not given.
    """
    panels = 1 + int(waves / _PER_PANEL)
    coarse, size = integrate(*composite_rule(panels))
    change = np.inf
    for _ in range(_DOUBLINGS):
        panels *= 2
        fine, size = integrate(*composite_rule(panels))
        if not np.isfinite(fine).all():
            raise BadInputError("a value that is not finite", _WHERE, "give finite values")
        change = float(np.abs(fine - coarse).max(initial=0.0))
        if change <= tolerance * max(size, _SMALLEST):
            freeze(fine)
            return fine
        coarse = fine
    what = f"coefficients still change by {change / size:.2g} of the largest value"
    raise BadInputError(what, _WHERE, "give the places where the curve bends or jumps as breaks")


def chebyshev_of_function(
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
    >>> from assoc_hull.geometry.integrals.series import chebyshev_of_function
    >>> (chebyshev_of_function(lambda xi: 1.0 - xi**2, 3) + 0.0).round(12).tolist()
    [0.5, 0.0, -0.5]
    """
    count, allowed = checked_terms(terms), positive(tolerance, "tolerance", _WHERE)
    edges = np.arccos(piece_edges(breaks))[::-1]
    factor = np.where(np.arange(count) == 0, 1.0, 2.0) / np.pi

    def integrate(nodes: FloatArray, weights: FloatArray) -> tuple[FloatArray, float]:
        theta, step = rule_on_pieces(edges, nodes, weights)
        xi = np.clip(np.cos(theta), -1.0, 1.0)
        return _sums("chebyshev", values(xi), step, xi, count, factor)

    return integrate_until_settled(integrate, count * np.diff(edges).max() / np.pi, allowed)


def sine_of_function(
    values: Values, terms: int, breaks: ArrayLike = (), tolerance: float = 1e-12
) -> FloatArray:
    """Give half-range sine coefficients of a function that is smooth between breaks.

    Parameters
    ----------
    values, breaks, tolerance
        As in `chebyshev_of_function`.
    terms : int
        Number of coefficients, b_1 to b_terms.

    Returns
    -------
    (..., terms), the unit of the function
        ``b_k = integral of y sin(k pi (xi + 1) / 2) over xi from -1 to 1``.

    Raises
    ------
    BadInputError
        As `chebyshev_of_function` does.

    Examples
    --------
    >>> from assoc_hull.geometry.integrals.series import sine_of_function
    >>> round(float(sine_of_function(lambda xi: 1.0 - xi**2, 1)[0]), 10)  # 32 / pi^3
    1.0320491019
    """
    count, allowed = checked_terms(terms), positive(tolerance, "tolerance", _WHERE)
    edges, factor = piece_edges(breaks), np.ones(count)

    def integrate(nodes: FloatArray, weights: FloatArray) -> tuple[FloatArray, float]:
        xi, step = rule_on_pieces(edges, nodes, weights)
        return _sums("sine", values(xi), step, xi, count, factor)

    return integrate_until_settled(integrate, count * np.diff(edges).max() / 2.0, allowed)


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
    >>> from assoc_hull.geometry.integrals.series import evaluate_series
    >>> evaluate_series("chebyshev", np.array([0.5, 0.0, -0.5]), [0.0, 0.5]).round(12).tolist()
    [1.0, 0.75]
    """
    at = np.asarray(xi, np.float64)
    if at.ndim != 1 or not (np.abs(at) <= 1.0 + 1e-12).all():
        raise BadInputError("a place outside -1 to 1", _WHERE, "give places of the range")
    total = np.zeros((*coefficients.shape[:-1], len(at)))
    for place in range(coefficients.shape[-1]):
        total += coefficients[..., place, None] * series_function(kind, place, at)
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
    >>> from assoc_hull.geometry.integrals.series import truncation
    >>> xi = np.array([-1.0, 0.0, 1.0])
    >>> left = truncation("chebyshev", np.array([0.0, 1.0]), xi, xi, np.array([1.0, 4.0, 1.0]) / 3)
    >>> left.rms.round(4).tolist(), left.largest.tolist()
    ([0.5774, 0.0], [1.0, 0.0])
    """
    rest = y.copy()
    rms, largest = np.zeros(len(coefficients)), np.zeros(len(coefficients))
    for place, coefficient in enumerate(coefficients.tolist()):
        rest -= coefficient * series_function(kind, place, xi)
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
    parts = [(weighted * series_function(kind, place, xi)).sum(axis=-1) for place in range(terms)]
    return np.stack(parts, axis=-1) * factor, float(np.abs(given).max(initial=0.0))


def piece_edges(breaks: ArrayLike) -> FloatArray:
    """Give the ends of the pieces, ascending, from -1 to 1."""
    given = np.asarray(breaks, np.float64)
    if given.ndim != 1 or not (np.abs(given) <= 1.0).all():
        raise BadInputError("a break outside -1 to 1", _WHERE, "give places inside the range")
    return np.unique(np.concatenate([[-1.0], given, [1.0]]))


def rule_on_pieces(
    edges: FloatArray, nodes: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Put a rule on every piece between edges: places and weights, (q,)."""
    wide = np.diff(edges)[:, None]
    places = edges[:-1, None] + wide * nodes
    return places.ravel(), (wide * weights).ravel()


# --------------------------------------------------------------------------------------
# Series of chains of cubics. Integrated by parts along the curve, with theta = arccos(xi),
#
#     c_0 = y(-1) + (1 / pi) integral of theta dy,
#     c_k = 2 / (pi k) integral of sin(k theta) dy,
#     X_k = 1 / (2 pi i k) integral of exp(-2 pi i k s / L) dw,   w = u + i v,
#
# in which nothing is infinite where the abscissa turns into theta, and the speed of the parameter
# is not needed.
# Sources: H.J. Son, H.C. Kim, "hull form parameter modules for performance analysis", J. of CAD/CAM
# (Korea) 13(6), 2008, for the two series of curves of a hull; C.T. Zahn, R.Z. Roskies, "Fourier
# descriptors for plane closed curves", IEEE Trans. Computers C-21(3), 1972, and G.H. Granlund,
# "Fourier preprocessing for hand print character recognition", ibid. C-21(2), 1972, for w(s).

_CLOSED = 1e-9  # of the length: so far apart the ends of a closed chain may be
_ENDS = np.array([0.0, 1.0])
_PANELS = 2  # on each cubic, where a series is compared with the curve


def chebyshev_of_chains(chains: PlaneChains, terms: int, tolerance: float = 1e-12) -> FloatArray:
    """Give Chebyshev coefficients of v over u.

    Parameters
    ----------
    chains : PlaneChains
        m chains along each of which u runs from xi = -1 at the beginning to 1 at the end.
    terms : int
        Number of coefficients, from c_0.
    tolerance : float
        Error of the coefficients, in parts of the largest v.

    Returns
    -------
    (m, terms), m
        The coefficients.

    Raises
    ------
    BadInputError
        A chain that does not run forward from its first u, or no whole number of terms.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.series import chebyshev_of_chains
    >>> from assoc_hull.geometry.integrals.chains import PlaneChains
    >>> cubic = np.array([[[0.0, 0.0], [10.0, 4.0], [0.0, -4.0], [0.0, 0.0]]])  # 1 - xi^2
    >>> (chebyshev_of_chains(PlaneChains.single(cubic), 3)[0] + 0.0).round(10).tolist()
    [0.5, 0.0, -0.5]
    """
    count, allowed = checked_terms(terms), positive(tolerance, "tolerance", _WHERE)
    first = chains.ends[:, 0, 1]

    def integrate(nodes: FloatArray, weights: FloatArray) -> tuple[FloatArray, float]:
        xi, v = _function(chains, nodes)
        theta, rise = series_angle(xi), chains.slope(nodes)[..., 1] * weights
        found = np.empty((chains.count, count))
        found[:, 0] = first + chains.total((theta * rise).sum(axis=1)) / np.pi
        for k in range(1, count):
            part = chains.total((np.sin(k * theta) * rise).sum(axis=1))
            found[:, k] = 2.0 / (np.pi * k) * part
        return found, float(np.abs(v).max())

    return integrate_until_settled(
        integrate, count * _widest(series_angle(_edges(chains))) / np.pi, allowed
    )


def sine_of_chains(chains: PlaneChains, terms: int, tolerance: float = 1e-12) -> FloatArray:
    """Give half-range sine coefficients of v over u.

    Parameters
    ----------
    chains, tolerance
        As in `chebyshev_of_chains`.
    terms : int
        Number of coefficients, from b_1.

    Returns
    -------
    (m, terms), m
        The coefficients.

    Raises
    ------
    BadInputError
        As `chebyshev_of_chains` does.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.series import sine_of_chains
    >>> from assoc_hull.geometry.integrals.chains import PlaneChains
    >>> cubic = np.array([[[0.0, 0.0], [10.0, 4.0], [0.0, -4.0], [0.0, 0.0]]])  # 1 - xi^2
    >>> round(float(sine_of_chains(PlaneChains.single(cubic), 1)[0, 0]), 10)
    1.0320491019
    """
    count, allowed = checked_terms(terms), positive(tolerance, "tolerance", _WHERE)
    ends = chains.ends[:, :, 0]
    wide = (ends[:, 1] - ends[:, 0])[chains.owner, None]

    def integrate(nodes: FloatArray, weights: FloatArray) -> tuple[FloatArray, float]:
        xi, v = _function(chains, nodes)
        phase = 0.5 * np.pi * (xi + 1.0)
        strip = v * chains.slope(nodes)[..., 0] * (2.0 / wide) * weights
        parts = [chains.total((strip * np.sin(k * phase)).sum(axis=1)) for k in range(1, count + 1)]
        return np.stack(parts, axis=1), float(np.abs(v).max())

    return integrate_until_settled(integrate, count * _widest(_edges(chains)) / 2.0, allowed)


def function_samples(chains: PlaneChains) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give xi, v and weights for integrals over xi at places of one chain, (q,) each."""
    nodes, weights = composite_rule(_PANELS)
    xi, v = _function(chains, nodes)
    ends = chains.ends[0, :, 0]
    step = chains.slope(nodes)[..., 0] * (2.0 / (ends[1] - ends[0])) * weights
    return np.clip(xi, -1.0, 1.0).ravel(), v.ravel(), step.ravel()


def _edges(chains: PlaneChains) -> FloatArray:
    """Give xi at both ends of every cubic, (p, 2)."""
    return _function(chains, _ENDS)[0]


def _widest(edges: FloatArray) -> float:
    return float(np.abs(edges[:, 1] - edges[:, 0]).max())


def _function(chains: PlaneChains, nodes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give xi and v at nodes of every cubic, (p, n) each."""
    ends = chains.ends[:, :, 0]
    if not (ends[:, 1] > ends[:, 0]).all():
        what = "a chain that ends behind where it begins"
        raise BadInputError(what, _WHERE, "run through it forward")
    place = chains.at(nodes)
    begin, wide = ends[chains.owner, :1], (ends[:, 1] - ends[:, 0])[chains.owner, None]
    return 2.0 * (place[..., 0] - begin) / wide - 1.0, place[..., 1]


def fourier_descriptors(chains: PlaneChains, terms: int, tolerance: float = 1e-12) -> ComplexArray:
    """Give Fourier coefficients of closed curves over their arc length.

    Parameters
    ----------
    chains : PlaneChains
        m closed chains.
    terms : int
        Harmonics to each side.
    tolerance : float
        Error of the coefficients, in parts of the largest coordinate.

    Returns
    -------
    (m, 2 terms + 1) complex, m
        ``X_k = 1/L integral of (u + i v) exp(-2 pi i k s / L) ds``, k from -terms to terms.

    Raises
    ------
    BadInputError
        A chain that is open, or no whole number of terms.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.series import fourier_descriptors
    >>> from assoc_hull.geometry.integrals.chains import closed_loop, PlaneChains, straight_chain
    >>> square = closed_loop(straight_chain(np.array([1.0, -1]), np.array([1.0, 1])), 0)
    >>> abs(fourier_descriptors(PlaneChains.single(square), 1)[0]).round(4).tolist()
    [0.0, 0.0, 1.1463]
    """
    count, allowed = checked_terms(terms), positive(tolerance, "tolerance", _WHERE)
    length, before = _lengths(chains)
    ends = chains.ends
    if not (np.abs(ends[:, 0] - ends[:, 1]).max(axis=1) <= _CLOSED * length).all():
        raise BadInputError("an open curve", _WHERE, "close it, for instance by its mirror image")
    first = ends[:, 0, 0] + 1j * ends[:, 0, 1]

    def integrate(nodes: FloatArray, weights: FloatArray) -> tuple[ComplexArray, float]:
        fraction = _fractions(chains, length, before, nodes)
        slope = chains.slope(nodes)
        step = (slope[..., 0] + 1j * slope[..., 1]) * weights
        found = np.empty((chains.count, 2 * count + 1), np.complex128)
        # X_0 by parts: the last place, which is the first, less the integral of (s / L) dw.
        found[:, count] = first - chains.total((fraction * step).sum(axis=1))
        for k in range(1, count + 1):
            wave = np.exp(-2j * np.pi * k * fraction)
            for sign, turn in ((1, wave), (-1, wave.conj())):
                part = chains.total((turn * step).sum(axis=1))
                found[:, count + sign * k] = part / (2j * np.pi * k * sign)
        return found, float(np.abs(chains.cubic[:, 0]).max())

    return integrate_until_settled(
        integrate, 2.0 * count * _widest(_fractions(chains, length, before, _ENDS)), allowed
    )


def evaluate_descriptors(descriptors: ComplexArray, fraction: ArrayLike) -> FloatArray:
    """Add up the Fourier series of a closed curve.

    Parameters
    ----------
    descriptors : (2 n + 1,) complex, m
        X_k for k from -n to n.
    fraction : (q,)
        s / L: places along the curve, from 0 to 1 once around.

    Returns
    -------
    (q, 2), m
        The places.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.series import evaluate_descriptors
    >>> circle = np.array([0.0, 0.0, 2.0], complex)
    >>> evaluate_descriptors(circle, [0.25]).round(12).tolist()
    [[0.0, 2.0]]
    """
    at = np.asarray(fraction, np.float64)
    most = len(descriptors) // 2
    waves = np.exp(2j * np.pi * at[:, None] * np.arange(-most, most + 1))
    total = (waves * descriptors).sum(axis=1)
    found = np.stack([total.real, total.imag], axis=1)
    freeze(found)
    return found


def descriptor_truncation(chains: PlaneChains, descriptors: ComplexArray) -> Truncation:
    """Compare the first n harmonics of one closed chain with the curve, for every n.

    Parameters
    ----------
    chains : PlaneChains
        One closed chain.
    descriptors : (2 terms + 1,) complex, m
        Of it.

    Returns
    -------
    Truncation
        The rms is ``sqrt(1/L integral of |w - w_n|^2 ds)``, w_n with k from -n to n.
    """
    nodes, weights = composite_rule(_PANELS)
    length, before = _lengths(chains)
    fraction = _fractions(chains, length, before, nodes)
    place, slope = chains.at(nodes), chains.slope(nodes)
    weight = np.hypot(slope[..., 0], slope[..., 1]) * weights / length[0]
    most = len(descriptors) // 2
    rest = place[..., 0] + 1j * place[..., 1] - descriptors[most]
    rms, largest = np.zeros(most), np.zeros(most)
    for k in range(1, most + 1):
        wave = np.exp(2j * np.pi * k * fraction)
        rest = rest - descriptors[most + k] * wave - descriptors[most - k] * wave.conj()
        square = rest.real**2 + rest.imag**2
        rms[k - 1], largest[k - 1] = np.sqrt((weight * square).sum()), np.sqrt(square.max())
    return Truncation(rms, largest)


def length_of_chains(chains: PlaneChains) -> FloatArray:
    """Give the arc length of each chain, (m,), m."""
    return _lengths(chains)[0]


def _lengths(chains: PlaneChains) -> tuple[FloatArray, FloatArray]:
    """Give the length of each chain, (m,), and that before each cubic, (p,)."""
    own = arc_length(_single_cubics(chains))
    running = np.concatenate([[0.0], np.cumsum(own)])
    return chains.total(own), running[:-1] - running[chains.start[chains.owner]]


def _fractions(
    chains: PlaneChains, length: FloatArray, before: FloatArray, nodes: FloatArray
) -> FloatArray:
    """Give s / L at nodes of every cubic, (p, n)."""
    cubics = _single_cubics(chains)
    which: IntArray = np.repeat(np.arange(cubics.count), len(nodes))
    along = length_at(cubics, which, np.tile(nodes, cubics.count)).reshape(-1, len(nodes))
    found: FloatArray = (before[:, None] + along) / length[chains.owner, None]
    return found


def _single_cubics(chains: PlaneChains) -> SplineBatch:
    """Give every cubic as a curve of its own, with a parameter from 0 to 1."""
    count = len(chains.cubic)
    space = np.zeros((count, 4, 3))
    space[..., :2] = chains.cubic
    ends = np.stack([space[:, 0], space.sum(axis=1)], axis=1).reshape(-1, 3)
    slopes = np.stack([space[:, 1], space[:, 1] + 2.0 * space[:, 2] + 3.0 * space[:, 3]], axis=1)
    both = slopes.reshape(-1, 3)
    start = 2 * np.arange(count + 1, dtype=np.int64)
    return SplineBatch(start, np.tile([0.0, 1.0], count), ends, both, both.copy())

"""Series of chains of cubics: Chebyshev, sine, and Fourier descriptors of closed ones.

The integrals run along the curve, not over the abscissa: so ends with a vertical tangent and
upright steps are as good as any other place. Integrated by parts, with theta = arccos(xi),

    c_0 = y(-1) + (1 / pi) integral of theta dy,
    c_k = 2 / (pi k) integral of sin(k theta) dy,
    X_k = 1 / (2 pi i k) integral of exp(-2 pi i k s / L) dw,   w = u + i v,

in which nothing is infinite where the abscissa turns into theta, and the speed of the parameter
is not needed.

Sources: H.J. Son, H.C. Kim, "hull form parameter modules for performance analysis", J. of CAD/CAM
(Korea) 13(6), 2008, for the two series of curves of a hull; C.T. Zahn, R.Z. Roskies, "Fourier
descriptors for plane closed curves", IEEE Trans. Computers C-21(3), 1972, and G.H. Granlund,
"Fourier preprocessing for hand print character recognition", ibid. C-21(2), 1972, for w(s).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import positive
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.integrals.plane_chains import PlaneChains
from assoc_hull.geometry.integrals.transforms import (
    ComplexArray,
    Truncation,
    angle,
    checked_terms,
    composite,
    settled,
)
from assoc_hull.geometry.splines.length import arc_length, length_at

__all__ = [
    "chebyshev_of_chains",
    "descriptor_truncation",
    "evaluate_descriptors",
    "fourier_descriptors",
    "function_samples",
    "length_of_chains",
    "sine_of_chains",
]

_WHERE = "in a transform"
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
    >>> from assoc_hull.geometry.integrals.chain_transforms import chebyshev_of_chains
    >>> from assoc_hull.geometry.integrals.plane_chains import PlaneChains
    >>> cubic = np.array([[[0.0, 0.0], [10.0, 4.0], [0.0, -4.0], [0.0, 0.0]]])  # 1 - xi^2
    >>> (chebyshev_of_chains(PlaneChains.single(cubic), 3)[0] + 0.0).round(10).tolist()
    [0.5, 0.0, -0.5]
    """
    count, allowed = checked_terms(terms), positive(tolerance, "tolerance", _WHERE)
    first = chains.ends[:, 0, 1]

    def integrate(nodes: FloatArray, weights: FloatArray) -> tuple[FloatArray, float]:
        xi, v = _function(chains, nodes)
        theta, rise = angle(xi), chains.slope(nodes)[..., 1] * weights
        found = np.empty((chains.count, count))
        found[:, 0] = first + chains.total((theta * rise).sum(axis=1)) / np.pi
        for k in range(1, count):
            part = chains.total((np.sin(k * theta) * rise).sum(axis=1))
            found[:, k] = 2.0 / (np.pi * k) * part
        return found, float(np.abs(v).max())

    return settled(integrate, count * _widest(angle(_edges(chains))) / np.pi, allowed)


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
    >>> from assoc_hull.geometry.integrals.chain_transforms import sine_of_chains
    >>> from assoc_hull.geometry.integrals.plane_chains import PlaneChains
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

    return settled(integrate, count * _widest(_edges(chains)) / 2.0, allowed)


def function_samples(chains: PlaneChains) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give xi, v and weights for integrals over xi at places of one chain, (q,) each."""
    nodes, weights = composite(_PANELS)
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
    >>> from assoc_hull.geometry.integrals.chain_transforms import fourier_descriptors
    >>> from assoc_hull.geometry.integrals.plane_chains import loop, PlaneChains, straight
    >>> square = loop(straight(np.array([1.0, -1]), np.array([1.0, 1])), 0)
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
        found[:, count] = first - chains.total((fraction * step).sum(axis=1))
        for k in range(1, count + 1):
            wave = np.exp(-2j * np.pi * k * fraction)
            for sign, turn in ((1, wave), (-1, wave.conj())):
                part = chains.total((turn * step).sum(axis=1))
                found[:, count + sign * k] = part / (2j * np.pi * k * sign)
        return found, float(np.abs(chains.cubic[:, 0]).max())

    return settled(
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
    >>> from assoc_hull.geometry.integrals.chain_transforms import evaluate_descriptors
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
    nodes, weights = composite(_PANELS)
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

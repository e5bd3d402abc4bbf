"""Rules for integrals along a strip, from v = 0 to 1.

Where nothing happens inside a strip, Lobatto's rule is used: its first and last curve lie at
the ends, where it is seen what happens there. Where something does (a piece of the section
appears), the integrands go like half-integer powers of the distance to that place; with
``v = sin^2(pi t / 2)`` they are smooth in t, and Gauss's rule in t converges fast.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.polynomial import Legendre
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["bunched_rule", "gauss", "lobatto", "root_walk"]


@lru_cache
def gauss(count: int) -> tuple[FloatArray, FloatArray]:
    """Give the nodes and weights of Gauss's rule on [0, 1].

    Parameters
    ----------
    count : int
        Points; exact to the degree 2 count - 1.

    Returns
    -------
    (count,), (count,)
        Nodes and weights.

    Examples
    --------
    >>> nodes, weights = gauss(2)
    >>> round(float((weights * nodes**3).sum()), 12)
    0.25
    """
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return _frozen(0.5 + 0.5 * nodes, 0.5 * weights)


@lru_cache
def lobatto(count: int) -> tuple[FloatArray, FloatArray]:
    """Give the nodes and weights of Lobatto's rule on [0, 1], both ends included.

    Parameters
    ----------
    count : int
        Points, at least two; exact to the degree 2 count - 3.

    Returns
    -------
    (count,), (count,)
        Nodes and weights.

    Examples
    --------
    >>> nodes, weights = lobatto(3)  # Simpson's rule
    >>> nodes.tolist(), weights.round(12).tolist()
    ([0.0, 0.5, 1.0], [0.166666666667, 0.666666666667, 0.166666666667])
    """
    top = Legendre.basis(count - 1)
    slope, bend = top.deriv(), top.deriv(2)
    inner = _extremes(count)
    for _ in range(3):
        inner = inner - slope(inner) / bend(inner)
    nodes = np.concatenate([[-1.0], inner, [1.0]])
    nodes = 0.5 * (nodes - nodes[::-1])
    weights = 1.0 / (count * (count - 1) * top(nodes) ** 2)
    return _frozen(0.5 + 0.5 * nodes, weights)


def _extremes(count: int) -> FloatArray:
    """Give the roots of the slope of a Legendre polynomial, rising: Gegenbauer's, of 3/2.

    They are eigenvalues of the symmetric matrix of its recurrence, which are found many times
    as fast as those of a companion matrix (G. Golub, J. Welsch, "Calculation of Gauss quadrature
    rules", Mathematics of Computation 23, 1969).
    """
    k = np.arange(1.0, count - 2.0)
    beside = np.sqrt(k * (k + 2.0) / ((2.0 * k + 1.0) * (2.0 * k + 3.0)))
    recurrence = np.zeros((count - 2, count - 2))
    recurrence.flat[count - 2 :: count - 1] = beside
    return np.asarray(np.linalg.eigvalsh(recurrence), np.float64)


@lru_cache
def bunched_rule(count: int) -> tuple[FloatArray, FloatArray]:
    """Give a rule on [0, 1] for half-integer powers of the distance to either end.

    Parameters
    ----------
    count : int
        Points.

    Returns
    -------
    (count,), (count,)
        Nodes and weights.

    Examples
    --------
    >>> nodes, weights = bunched_rule(12)
    >>> round(float((weights * np.sqrt(nodes * (1.0 - nodes))).sum() * 8.0 / np.pi), 12)
    1.0
    """
    t, weights = gauss(count)
    return _frozen(np.sin(0.5 * np.pi * t) ** 2, 0.5 * np.pi * np.sin(np.pi * t) * weights)


def root_walk(
    t: FloatArray, starts: NDArray[np.bool_], ends: NDArray[np.bool_]
) -> tuple[FloatArray, FloatArray]:
    """Walk parts from 0 to 1, slowly towards an end from which something goes as a root.

    Parameters
    ----------
    t : (n,)
        Places from 0 to 1.
    starts, ends : (p,) bool
        It does so from the beginning of a part, from its end.

    Returns
    -------
    (p, n), (p, n)
        How far along the parts t leads, and the derivative.

    Examples
    --------
    >>> root_walk(np.array([0.0, 0.5, 1.0]), np.array([True]), np.array([False]))[0].tolist()
    [[0.0, 0.25, 1.0]]
    """
    first, last = starts[:, None], ends[:, None]
    walked = np.where(last, t * t * (3.0 - 2.0 * t), t * t)
    walked = np.where(first, walked, np.where(last, t * (2.0 - t), t))
    rate = np.where(last, 6.0 * t * (1.0 - t), 2.0 * t)
    rate = np.where(first, rate, np.where(last, 2.0 - 2.0 * t, 1.0))
    return walked, rate


def _frozen(nodes: FloatArray, weights: FloatArray) -> tuple[FloatArray, FloatArray]:
    freeze(nodes, weights)
    return nodes, weights

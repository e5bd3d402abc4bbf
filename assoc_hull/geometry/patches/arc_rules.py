"""Rules of quadrature on [0, 1] that contain one another, with measures of their errors.

Lobatto's rule of 4 points, its extension by 3 points, and the extension of that by 6; exact to the
degrees 5, 9 and 19.

Source: W. Gander and W. Gautschi, "Adaptive quadrature - revisited", BIT 40, 2000.

Examples
--------
>>> from assoc_hull.geometry.patches.arc_rules import arc_rules
>>> rules = arc_rules()
>>> len(rules.first), len(rules.second)
(7, 6)
"""

from __future__ import annotations

from functools import cache

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["ArcRules", "arc_rules"]


@attrs.frozen(eq=False)
class ArcRules:
    """Nodes, weights, and how values at some nodes give those at others.

    Attributes
    ----------
    first : (7,)
        Nodes of the smaller rule, in rising order, both ends included.
    second : (6,)
        Nodes that the larger one adds.
    few, many : (3, 7), (3, 13)
        Weights of the two rules, and those of the last two terms of a series in polynomials:
        degrees 5 and 6, 11 and 12. The rules leave out terms of degrees beyond 9 and 19 only, so
        these two tell how large their errors are at most. One is nil for all even functions, the
        other for all odd ones; so not both vanish by chance.
    between : (6, 7)
        The polynomial through values at the first nodes, at the second.
    inside : (10, 13)
        That through all, at the 5 inner nodes of the smaller rule on both halves.
    """

    first: FloatArray
    second: FloatArray
    few: FloatArray
    many: FloatArray
    between: FloatArray
    inside: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*(getattr(self, field.name) for field in attrs.fields(type(self))))


@cache
def arc_rules() -> ArcRules:
    """Give the rules.

    Returns
    -------
    ArcRules
        Made once.

    Examples
    --------
    >>> abs(arc_rules().few.sum(axis=1)).round(12)
    array([1., 0., 0.])
    """
    inner, outer = 1.0 / np.sqrt(5.0), np.sqrt(2.0 / 3.0)
    more = np.array([0.942882415695480, 0.641853342345781, 0.236383199662150])
    first = np.array([-1.0, -outer, -inner, 0.0, inner, outer, 1.0])
    second = np.concatenate([-more, more[::-1]])
    every = np.concatenate([first, second])
    few, many = (_measured(t, _weights(t)) for t in (first, every))
    halves = np.concatenate([0.5 * first[1:-1] - 0.5, 0.5 * first[1:-1] + 0.5])
    return ArcRules(
        0.5 + 0.5 * first, 0.5 + 0.5 * second, few, many,
        _through(first, second), _through(every, halves),
    )  # fmt: skip


def _through(nodes: FloatArray, places: FloatArray) -> FloatArray:
    """Give the matrix from values at nodes to values at places of the polynomial through them."""
    degree = len(nodes) - 1
    at = (np.polynomial.legendre.legvander(t, degree).T for t in (nodes, places))
    return np.array(np.linalg.solve(*at).T, np.float64)


def _measured(nodes: FloatArray, rule: FloatArray) -> FloatArray:
    """Give the weights of a rule, and those that give the last two terms of a series.

    The terms are those of polynomials that are orthonormal with respect to the rule itself.
    """
    root = np.sqrt(rule)
    values = np.polynomial.legendre.legvander(nodes, len(nodes) - 1)
    basis = np.linalg.qr(values * root[:, None])[0]
    return np.concatenate([rule[None], (basis * root[:, None]).T[-2:]])


def _weights(nodes: FloatArray) -> FloatArray:
    """Give the weights, on [0, 1], of the rule that is exact for as many powers as it has nodes."""
    moments = np.zeros(len(nodes))
    moments[0] = 1.0
    values = np.polynomial.legendre.legvander(nodes, len(nodes) - 1).T
    return np.asarray(np.linalg.solve(values, moments), np.float64)

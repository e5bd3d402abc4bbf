"""Parts of curves on one side of planes, and what they enclose.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.integrals.beside import area_along, beside
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.segments import power
>>> from assoc_hull.geometry.splines.loft import loft
>>> flare = loft(CurveData.single(np.array([[0.0, 0, 0], [0, 4, 8]])))
>>> below = beside(power(flare), np.array([0.0, 0.0, 1.0]), 6.0)  # z <= 6
>>> round(area_along(below, (1, 2)), 12)  # y dz
9.0
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.numeric.roots import unit_roots
from assoc_hull.geometry.splines.paths import stretch

__all__ = ["area_along", "beside", "one_way", "runs"]

_GAP = 1e-9
"""Cubics whose ends lie farther apart (m) do not join."""

_SLIVER = 1e-12
"""Parts of a smaller part of a cubic are not made."""

_POINTS = 6
"""Gauss points: exact for all that is integrated here, up to the degree 11."""


def beside(cubic: FloatArray, normal: FloatArray, offset: float) -> FloatArray:
    """Keep what lies on one side of a plane, ``normal . P <= offset``.

    Parameters
    ----------
    cubic : (s, 4, 3), m
        Cubics in power form, the parameter from 0 to 1; (s, 4, 2) in a plane.
    normal : (3,)
        Of the plane, of any length.
    offset : float
        Of the plane.

    Returns
    -------
    (k, 4, 3), m
        What is left, as cubics from 0 to 1 again, in order.
    """
    height = cubic @ normal
    height[:, 0] -= offset
    one = np.ones((len(cubic), 1))
    edge = np.concatenate([0.0 * one, unit_roots(height), one], axis=1)
    inside = horner(height, 0.5 * (edge[:, :-1] + edge[:, 1:])) <= 0.0
    inside &= np.diff(edge, axis=1) > _SLIVER
    segment, part = np.nonzero(inside)
    found = stretch(cubic[segment], edge[segment, part], edge[segment, part + 1])
    freeze(found)
    return found


def one_way(cubic: FloatArray, axis: int) -> FloatArray:
    """Part cubics where a coordinate turns, so that along each it only rises or only falls."""
    one = np.ones((len(cubic), 1))
    edge = np.concatenate([0.0 * one, unit_roots(differentiate(cubic)[:, :, axis]), one], axis=1)
    segment, part = np.nonzero(np.diff(edge, axis=1) > _SLIVER)
    return stretch(cubic[segment], edge[segment, part], edge[segment, part + 1])


def runs(cubic: FloatArray) -> list[FloatArray]:
    """Part cubics into runs, each of which goes on without a gap."""
    if not len(cubic):
        return []
    gap = np.abs(cubic[1:, 0] - cubic[:-1].sum(axis=1)).max(axis=1)
    return np.split(cubic, np.flatnonzero(gap > _GAP) + 1)


def area_along(cubic: FloatArray, axes: tuple[int, int], power: tuple[int, int] = (1, 0)) -> float:
    """Integrate ``a^p b^q db`` along cubics.

    Parameters
    ----------
    cubic : (s, 4, 3), m
        Cubics in power form, the parameter from 0 to 1.
    axes : (int, int)
        Which coordinates a and b are.
    power : (int, int)
        p and q; together up to 2.

    Returns
    -------
    float, m to the power p + q + 1
    """
    nodes, weights = gauss(_POINTS)
    places = np.broadcast_to(nodes, (len(cubic), _POINTS))
    a, b = (horner(cubic[:, :, axis], places) for axis in axes)
    step = horner(differentiate(cubic)[:, :, axes[1]], places)
    return float((a ** power[0] * b ** power[1] * step * weights).sum())

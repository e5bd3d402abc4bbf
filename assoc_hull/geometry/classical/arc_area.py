"""Area and moment beside a circular arc that turns left and rises, as far as a level.

Examples
--------
>>> import math
>>> from assoc_hull.geometry.classical.arc_area import arc_area
>>> from assoc_hull.geometry.classical.arcs import Arcs
>>> quarter = Arcs.make([[3.0, 0.0]], [0.0], [0.5], [math.pi])
>>> round(arc_area(quarter, (3.0, 2.0), 2.0), 9) == round(6.0 + math.pi, 9)
True
"""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.geometry.classical.arcs import Arcs

__all__ = ["arc_area", "arc_moment"]

_GAUSS = np.polynomial.legendre.leggauss(24)
"""Nodes and weights, over a quarter of a circle at most: moments to rounding."""


def arc_area(arc: Arcs, centre: tuple[float, float], level: float) -> float:
    """Give the integral of y dz over an arc up to a level (m), m2.

    Parameters
    ----------
    arc : Arcs
        One arc, of positive curvature, that rises to at most the top of its circle.
    centre : (float, float), m
        Of its circle, (y, z).
    level : float, m
        Height at which it is cut off; infinite for all of it.
    """
    radius, first, last = _angles(arc, centre, level)

    def swept(angle: float) -> float:
        sine, cosine = math.sin(angle), math.cos(angle)
        return centre[0] * sine + 0.5 * radius * (angle + sine * cosine)

    return radius * (swept(last) - swept(first))


def arc_moment(arc: Arcs, centre: tuple[float, float], level: float) -> float:
    """Give the integral of y z dz over an arc up to a level (m), m3; arguments as of `arc_area`."""
    radius, first, last = _angles(arc, centre, level)
    node, weight = _GAUSS
    half = 0.5 * (last - first)
    angle = first + half * (1.0 + node)
    y, z = centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)
    return float((y * z * radius * np.cos(angle)) @ weight * half)


def _angles(arc: Arcs, centre: tuple[float, float], level: float) -> tuple[float, float, float]:
    """Give radius, and the polar angles at which the part below a level begins and ends."""
    radius = 1.0 / float(arc.curvature[0])
    first = float(arc.angle[0]) - 0.5 * math.pi
    last = first + float(arc.length[0]) / radius
    height = (level - centre[1]) / radius
    if height <= math.sin(first):
        return radius, first, first
    if height < math.sin(min(last, 0.5 * math.pi)):
        last = math.asin(height)
    return radius, first, last

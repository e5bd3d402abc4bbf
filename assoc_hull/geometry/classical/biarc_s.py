"""Biarcs with an inflection: closed forms in the absolute end angles a, b, mirrored to a above nil.

With the chord P they fulfil P^2 - 2 P (R1 sin a + R2 sin b) - 4 R1 R2 sin((a - b)/2)^2 = 0. For a
given ratio q = R2 / R1, E = sin a + q sin b and D = -2 q sin((a - b)/2)^2,

    R1 = P / (E + sqrt(E^2 - 2 D)),   R2 = q R1

which keeps its digits where the printed quotient of small numbers does not: D is nil, not below
it, where the tangents are parallel.

The paper (Kim and Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK) says twice that radii are inversely proportional to the angles, q = a / b, and
prints the opposite, q = b / a. The text agrees with its aim, a small jump of curvature. The
least jump of all is

    1/R1 = 2 (sin a + sin((a + b)/2)) / P,   1/R2 = 2 (sin b + sin((a + b)/2)) / P

whose join has the direction -(a + b)/2: both chords are equally long.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.biarc_s import ratio_radii
>>> a, b = np.radians([40.0]), np.radians([20.0])
>>> [each.round(6).tolist() for each in ratio_radii(np.array([10.0]), a, b, a / b)]
[[3.647448], [7.294896]]
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["chords_of_radii", "other_radius", "ratio_radii"]


def ratio_radii(
    chord: FloatArray, a: FloatArray, b: FloatArray, q: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give both radii (m), the second q times the first; q = 1 gives the largest smaller one.

    Parameters
    ----------
    chord : (n,), m
    a, b : (n,), rad
        Absolute end angles to the chord; not both nil.
    q : (n,)
        Above 0.
    """
    e = np.sin(a) + q * np.sin(b)
    first = chord / (e + np.sqrt(e * e + 4.0 * q * np.sin(0.5 * (a - b)) ** 2))
    return first, q * first


def other_radius(
    chord: FloatArray, own: FloatArray, other: FloatArray, radius: FloatArray
) -> FloatArray:
    """Give the radius (m) of the arc at the angle `other`, where that at `own` is given (m)."""
    apart = np.sin(0.5 * (own - other)) ** 2
    free = chord * (chord - 2.0 * radius * np.sin(own))
    return np.asarray(free / (2.0 * chord * np.sin(other) + 4.0 * radius * apart))


def chords_of_radii(
    chord: FloatArray, a: FloatArray, b: FloatArray, first: FloatArray, second: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give the chords of both arcs (m), from radii (m) that fulfil the condition."""
    across = chord - second * np.sin(b) - first * np.sin(a)
    tau = np.arctan2(-across, second * np.cos(b) + first * np.cos(a))
    return 2.0 * first * np.sin(0.5 * (a - tau)), 2.0 * second * np.sin(0.5 * (b - tau))

"""Biarcs that bend one way: closed forms in the absolute end angles a, b, mirrored to a above nil.

With sigma = (a + b) / 2 and the direction tau of the join, both measured from the chord P,

    R1 = P sin((b - tau)/2) / (2 sin sigma sin((a - tau)/2))
    R2 = P sin((a + tau)/2) / (2 sin sigma sin((b + tau)/2))

are the biarcs without loops of P^2 - 2 P (R1 sin a + R2 sin b) + 2 B R1 R2 = 0,
B = 2 sin(sigma)^2. Both radii are above nil where abs(tau) is below the smaller angle.

The paper (Kim and Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK) takes the biarc at which R1 - R2 is stationary. It has tau = (a - b) / 2; both
arcs turn by sigma. The sign of the root that the paper picks is right, though the other
root has the smaller difference: that one runs through a whole loop. Radii are above nil where the
angles differ by less than a factor of three.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.biarc_c import one_bend_radii
>>> a, b = np.radians([60.0]), np.radians([30.0])
>>> [each.round(6).tolist() for each in one_bend_radii(np.array([10.0]), a, b, (a - b) / 2)]
[[2.41181], [11.248444]]
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["direction_of_radius", "one_bend_limit", "one_bend_radii", "stationary_chords"]


def one_bend_radii(
    chord: FloatArray, a: FloatArray, b: FloatArray, tau: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give both radii (m) of biarcs that join at a direction.

    Parameters
    ----------
    chord : (n,), m
    a, b : (n,), rad
        Absolute end angles to the chord.
    tau : (n,), rad
        Of the join, from the chord, on the side to which the start leads.
    """
    double = 2.0 * np.sin(0.5 * (a + b))
    first = chord * np.sin(0.5 * (b - tau)) / (double * np.sin(0.5 * (a - tau)))
    second = chord * np.sin(0.5 * (a + tau)) / (double * np.sin(0.5 * (b + tau)))
    return first, second


def stationary_chords(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the chords of both arcs, in any unit, at which R1 - R2 is stationary.

    Not above nil where one angle is three times the other, or more.
    """
    return np.sin(0.25 * (3.0 * b - a)), np.sin(0.25 * (3.0 * a - b))


def one_bend_limit(chord: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """Give the radius (m) which the smaller one of a biarc of one bend cannot reach."""
    return np.asarray(chord * np.sin(np.minimum(a, b)) / (2.0 * np.sin(0.5 * (a + b)) ** 2))


def direction_of_radius(
    chord: FloatArray, a: FloatArray, b: FloatArray, radius: FloatArray
) -> FloatArray:
    """Give the join direction (rad) at which the smaller radius has a value below the limit.

    The smaller one stands at the end of the larger angle.
    """
    low, high = 0.5 * np.minimum(a, b), 0.5 * np.maximum(a, b)
    k = 2.0 * radius * np.sin(0.5 * (a + b)) / chord
    tau = 2.0 * np.arctan2(np.sin(low) - k * np.sin(high), np.cos(low) - k * np.cos(high))
    return np.where(a > b, tau, -tau)

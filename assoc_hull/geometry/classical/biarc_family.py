"""Every biarc between two points with their directions, and closed forms for its radii.

A biarc is two arcs that are tangent where they join; two points and two directions leave one
freedom, the ratio of both chords. Nothing is chosen here: `biarcs` chooses, and `arc_chain_search`
tries many. Angles are taken from the chord of the whole, positive to the left. Source: Kim and
Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and Production",
J. SNAK.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, finite_array, wrap_angle
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs, sinc
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "BiarcChords",
    "RatioBiarcs",
    "biarc_elements",
    "biarc_label",
    "biarc_points",
    "biarcs_by_ratio",
    "biarcs_of_shares",
    "chords_of_radii",
    "direction_of_radius",
    "directions_to_shares",
    "one_bend_limit",
    "one_bend_radii",
    "one_sided_shares",
    "other_radius",
    "ratio_radii",
    "stationary_chords",
]

# --------------------------------------------------------------------------------------
# The family. With the directions alpha at its start and beta at its end, both from the chord of the
# whole, the chords of the two arcs always differ in direction by (beta - alpha) / 2, wherever they
# join: all joins lie on one circle through both points. So the ratio of these chords is the one
# freedom that is left, for curves of one bend as for those of two:
#
#     delta = (beta - alpha) / 2,     f1 + f2 = 1, shares of the two chords
#     phi1  = -arg(f1 + f2 exp(i delta)),     phi2 = phi1 + delta
#     l1, l2 = f1, f2 times chord / |f1 + f2 exp(i delta)|
#     tau   = 2 phi1 - alpha, the direction of the join from the chord
#
# Nothing of it is a quotient of small numbers, whether tangents are parallel or lie along the
# chord. By the direction of the join instead the parallel case would be singular.

_BACK = np.pi - 1e-9
"""rad: an end angle from here on points back along the chord."""

_ZERO_CHORD = 4.0 * np.finfo(np.float64).eps
"""A chord is zero below this part of the coordinates."""
_SMALLEST, _LARGEST = 1e-150, 1e150
"""Of chords and coordinates, m: squares of what lies beyond have no digits."""


def biarc_label(index: int, count: int) -> str:
    """Say which of several biarcs is meant; nothing where there is one only."""
    return f"interval {index}" if count > 1 else ""


def biarc_points(points: ArrayLike, count: int | None = None) -> FloatArray:
    """Take points (n, 2), m, of a count if one is given; raises GeometryError beyond 1e150."""
    found = finite_array(points, "biarc", (count, 2))
    large = np.argwhere(np.abs(found) > _LARGEST)
    if len(large):
        index = tuple(large[0].tolist())
        raise GeometryError(
            f"biarc: coordinate {found[index]:g} at index {index}", "give metres",
            {"index": index, "coordinate": float(found[index])},
        )  # fmt: skip
    return found


@attrs.frozen(eq=False)
class BiarcChords:
    """Chords that biarcs are to span, with the end directions seen from them.

    Attributes
    ----------
    start : (n, 2), m
        First points.
    chord : (n,), m
        From first to last point.
    way : (n,), rad
        Direction of the chord.
    alpha, beta : (n,), rad
        Directions at first and last point, less that of the chord, in [-pi, pi).
    """

    start: FloatArray
    chord: FloatArray
    way: FloatArray
    alpha: FloatArray
    beta: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.chord, self.way, self.alpha, self.beta)

    def __len__(self) -> int:
        return len(self.chord)

    @classmethod
    def of(
        cls, start: ArrayLike, start_angle: ArrayLike, end: ArrayLike, end_angle: ArrayLike
    ) -> Self:
        """Check points (n, 2), m, and directions (n,), rad, and see them from the chord.

        Raises
        ------
        GeometryError
            ``"biarc: zero chord"``, ``"biarc: end angle {} to the chord exceeds 90 deg"`` where it
            is 180 degrees; shapes, and numbers that are not finite.
        """
        first = biarc_points(start)
        last = biarc_points(end, len(first))
        one, other = (
            finite_array(each, "biarc", (len(first),)) for each in (start_angle, end_angle)
        )
        step = last - first
        chord = np.hypot(step[:, 0], step[:, 1])
        size = np.maximum(np.abs(first), np.abs(last)).max(axis=1, initial=0.0)
        zero = np.flatnonzero(chord <= np.maximum(_ZERO_CHORD * size, _SMALLEST))
        if len(zero):
            index = int(zero[0])
            raise GeometryError(
                "biarc: zero chord", "give two different points",
                {"index": index, "chord": float(chord[index])}, biarc_label(index, len(first)),
            )  # fmt: skip
        way = np.arctan2(step[:, 1], step[:, 0])
        found = cls(first, chord, way, wrap_angle(one - way), wrap_angle(other - way))
        found._refuse_backward()
        return found

    @property
    def steepest(self) -> FloatArray:
        """The larger of both end angles to the chord, (n,), rad."""
        return np.maximum(np.abs(self.alpha), np.abs(self.beta))

    @property
    def one_bend(self) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        """Whether both tangents turn the same way, (n,): no inflection is needed."""
        return np.asarray(self.alpha * self.beta < 0.0)

    def _refuse_backward(self) -> None:
        back = np.flatnonzero(self.steepest >= _BACK)
        if len(back):
            index = int(back[0])
            angle = float(self.steepest[index])
            raise GeometryError(
                f"biarc: end angle {digits(np.degrees(angle))} deg to the chord exceeds 90 deg",
                "it leads straight back: give another direction, or a point between",
                {"index": index, "angle": angle}, biarc_label(index, len(self)),
            )  # fmt: skip


def biarc_elements(
    chord: FloatArray, alpha: FloatArray, beta: FloatArray, first: FloatArray, second: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Give what biarcs are made of, from arrays that are broadcast; nothing is checked.

    `first` and `second` are lengths of both chords in any common unit. Gives tau (...), the
    direction at the join, and phi (...), that of the first chord, both rad from the whole chord;
    lengths of both chords (2, ...), m; half of what each arc turns to the left (2, ...), rad.
    """
    f1, f2 = first / (first + second), second / (first + second)
    delta = 0.5 * (beta - alpha)
    cosine, sine = np.cos(delta), np.sin(delta)
    phi1 = -np.arctan2(f2 * sine, f1 + f2 * cosine)
    phi2 = np.arctan2(f1 * sine, f2 + f1 * cosine)
    whole = chord / np.hypot(f1 + f2 * cosine, f2 * sine)
    half = np.stack([phi1 - alpha, beta - phi2])
    return 2.0 * phi1 - alpha, phi1, np.stack([f1 * whole, f2 * whole]), half


def biarcs_of_shares(
    chords: BiarcChords, first: FloatArray, second: FloatArray
) -> tuple[PlaneArcs, FloatArray]:
    """Give the biarcs whose two chords are as `first` to `second`, in any unit, above 0, (n,).

    2 n arcs in order along each biarc; and tau (n,), rad, the direction at the join from the chord.
    """
    tau, phi, chord, half = biarc_elements(chords.chord, chords.alpha, chords.beta, first, second)
    way = chords.way + phi
    join = chords.start + chord[0, :, None] * np.stack([np.cos(way), np.sin(way)], axis=1)
    arcs = PlaneArcs(
        np.stack([chords.start, join], axis=1).reshape(-1, 2),
        np.stack([chords.way + chords.alpha, chords.way + tau], axis=1).ravel(),
        (2.0 * np.sin(half) / chord).T.ravel(),
        (chord / sinc(half)).T.ravel(),
    )
    return arcs, tau


def one_sided_shares(chords: BiarcChords) -> tuple[FloatArray, FloatArray]:
    """Give between which shares of the first chord, (n,) each, a biarc bends no more than it must.

    With one bend the join direction lies within the smaller end angle on either side of the chord;
    with two bends every share from 0 to 1 will do. The limits do not belong to the range.
    """
    a, b = np.abs(chords.alpha), np.abs(chords.beta)
    low, apart = np.sin(np.minimum(a, b)), np.sin(0.5 * np.abs(a - b))
    with np.errstate(invalid="ignore"):
        edge = np.where(low > 0.0, low / (low + apart), 1.0)
    bent = chords.one_bend
    return np.where(bent & (b > a), 1.0 - edge, 0.0), np.where(bent & (a > b), edge, 1.0)


def directions_to_shares(chords: BiarcChords, tau: FloatArray) -> FloatArray:
    """Give the share of the first chord, (n,), where the join is to have the direction `tau`, rad.

    tau (n,) is taken from the chord. Outside 0 to 1 there is no such biarc; where tangents are
    parallel only one direction is possible, and there is no answer: nan.
    """
    one, other = np.sin(0.5 * (tau + chords.beta)), -np.sin(0.5 * (tau + chords.alpha))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(one / (one + other))


@attrs.frozen(eq=False)
class RatioBiarcs:
    """Biarcs in the axes of their chords: from the origin to (chord, 0).

    Attributes
    ----------
    tau : (...), rad
        Direction at the join.
    join : (2, ...), m
        The join, along and left of the chord.
    bend : (2, ...), 1/m
        Curvatures of the two arcs, positive to the left.
    length : (2, ...), m
        Their lengths.
    """

    tau: FloatArray
    join: FloatArray
    bend: FloatArray
    length: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.tau, self.join, self.bend, self.length)


def biarcs_by_ratio(
    chord: FloatArray, alpha: FloatArray, beta: FloatArray, ratio: FloatArray
) -> RatioBiarcs:
    """Give biarcs by the part of the first chord, between 0 and 1; the arguments are broadcast.

    `alpha` and `beta` (rad, to the left) are less than a half turn from the chord (m); then every
    ratio gives one biarc without a loop, and 1/2 the one of equal chords. Where there is no such
    biarc, curvatures are not finite.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.biarc_family import biarcs_by_ratio
    >>> found = biarcs_by_ratio(np.array(10.0), np.array(0.0), np.array(0.5), np.array(0.5))
    >>> found.bend.round(8).tolist(), round(float(found.tau), 12)
    ([-0.04948079, 0.1453659], -0.25)
    """
    tau, first, chords, half = biarc_elements(chord, alpha, beta, ratio, 1.0 - ratio)
    join = chords[0] * np.stack([np.cos(first), np.sin(first)])
    return RatioBiarcs(tau, join, 2.0 * np.sin(half) / chords, chords / sinc(half))


# --------------------------------------------------------------------------------------
# Biarcs that bend one way, in the absolute end angles a, b, mirrored so that a is positive. With
# sigma = (a + b) / 2 and the direction tau of the join, both measured from the chord P,
#
#     R1 = P sin((b - tau)/2) / (2 sin sigma sin((a - tau)/2))
#     R2 = P sin((a + tau)/2) / (2 sin sigma sin((b + tau)/2))
#
# are the biarcs without loops of P^2 - 2 P (R1 sin a + R2 sin b) + 2 B R1 R2 = 0,
# B = 2 sin(sigma)^2. Both radii are positive where abs(tau) is below the smaller angle.
#
# The paper takes the biarc at which R1 - R2 is stationary. It has tau = (a - b) / 2; both arcs turn
# by sigma. The sign of the root that the paper picks is right, though the other root has the
# smaller difference: that one runs through a whole loop. Radii are positive where the angles differ
# by less than a factor of three.


def one_bend_radii(
    chord: FloatArray, a: FloatArray, b: FloatArray, tau: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give both radii (m) of biarcs that join at the direction `tau` (n,), rad, from the chord.

    `a` and `b` (n,), rad, are absolute end angles; tau is positive on the side to which the start
    leads.
    """
    double = 2.0 * np.sin(0.5 * (a + b))
    first = chord * np.sin(0.5 * (b - tau)) / (double * np.sin(0.5 * (a - tau)))
    second = chord * np.sin(0.5 * (a + tau)) / (double * np.sin(0.5 * (b + tau)))
    return first, second


def stationary_chords(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the chords of both arcs, in any unit, at which R1 - R2 is stationary.

    Not positive where one angle is three times the other, or more.
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


# --------------------------------------------------------------------------------------
# Biarcs with an inflection, in the absolute end angles a, b, mirrored so that a is positive. With
# the chord P they fulfil P^2 - 2 P (R1 sin a + R2 sin b) - 4 R1 R2 sin((a - b)/2)^2 = 0. For a
# given ratio q = R2 / R1, E = sin a + q sin b and D = -2 q sin((a - b)/2)^2,
#
#     R1 = P / (E + sqrt(E^2 - 2 D)),   R2 = q R1
#
# which keeps its digits where the printed quotient of small numbers does not: D is zero, not
# negative, where the tangents are parallel.
#
# The paper says twice that radii are inversely proportional to the angles, q = a / b, and prints
# the opposite, q = b / a. The text agrees with its aim, a small jump of curvature. The least jump
# of all is
#
#     1/R1 = 2 (sin a + sin((a + b)/2)) / P,   1/R2 = 2 (sin b + sin((a + b)/2)) / P
#
# whose join has the direction -(a + b)/2: both chords are equally long.


def ratio_radii(
    chord: FloatArray, a: FloatArray, b: FloatArray, q: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give both radii (m), the second q times the first; q = 1 gives the largest smaller one.

    `a` and `b` (n,), rad, are absolute end angles to the chord, not both zero; q is positive.
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

"""Every biarc between two points with their directions, by how its two chords share the way.

A biarc is two arcs of circles, tangent where they join. Seen from the chord of the whole, with the
directions alpha at its start and beta at its end, the chords of the two arcs always differ in
direction by (beta - alpha) / 2, wherever they join: all joins lie on one circle through both
points. So the ratio of these chords is the one freedom that is left, for curves of one bend
as for those of two:

    delta = (beta - alpha) / 2,     f1 + f2 = 1, shares of the two chords
    phi1  = -arg(f1 + f2 exp(i delta)),     phi2 = phi1 + delta
    l1, l2 = f1, f2 times chord / |f1 + f2 exp(i delta)|
    tau   = 2 phi1 - alpha, the direction of the join from the chord

Nothing of it is a quotient of small numbers, whether tangents are parallel or lie along the chord.

The biarcs are those of Kim and Chang, "Some Representations of Ship Hulls by Mathematical Method
for Design and Production", J. SNAK.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.biarc_family import BiarcChords, shared
>>> chords = BiarcChords.of([[0, 0]], [0.5], [[10, 0]], [-0.5])
>>> arcs, tau = shared(chords, np.array([0.5]), np.array([0.5]))
>>> (-1 / arcs.curvature).round(6).tolist()     # one circle
[10.429148, 10.429148]
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arcs import Arcs, sinc
from assoc_hull.geometry.classical.checks import figure, finite, wrap
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "BiarcChords", "biarc_points", "directions_to_shares", "interval", "one_sided_shares", "shared",
    "spanned",
]  # fmt: skip

_BACK = np.pi - 1e-9
"""End angles from here on: the tangent points back along the chord."""

_NIL = 4.0 * np.finfo(np.float64).eps
_SMALLEST, _LARGEST = 1e-150, 1e150
"""Of chords and coordinates, m: squares of what lies beyond have no digits."""


def interval(index: int, count: int) -> str:
    """Say which of several biarcs is meant; nothing where there is one only."""
    return f"interval {index}" if count > 1 else ""


def biarc_points(points: ArrayLike, count: int | None = None) -> FloatArray:
    """Take points (n, 2), m, of a count if one is given.

    Raises
    ------
    GeometryError
        Another shape, a number that is not finite, or one beyond 1e150.
    """
    found = finite(points, "biarc", (count, 2))
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
        one, other = (finite(each, "biarc", (len(first),)) for each in (start_angle, end_angle))
        step = last - first
        chord = np.hypot(step[:, 0], step[:, 1])
        size = np.maximum(np.abs(first), np.abs(last)).max(axis=1, initial=0.0)
        nil = np.flatnonzero(chord <= np.maximum(_NIL * size, _SMALLEST))
        if len(nil):
            index = int(nil[0])
            raise GeometryError(
                "biarc: zero chord", "give two different points",
                {"index": index, "chord": float(chord[index])}, interval(index, len(first)),
            )  # fmt: skip
        way = np.arctan2(step[:, 1], step[:, 0])
        found = cls(first, chord, way, wrap(one - way), wrap(other - way))
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
                f"biarc: end angle {figure(np.degrees(angle))} deg to the chord exceeds 90 deg",
                "it leads straight back: give another direction, or a point between",
                {"index": index, "angle": angle}, interval(index, len(self)),
            )  # fmt: skip


def spanned(
    chord: FloatArray, alpha: FloatArray, beta: FloatArray, first: FloatArray, second: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Give what biarcs are made of, from arrays that are broadcast; nothing is checked.

    Parameters
    ----------
    chord : (...), m
        Distance of both points.
    alpha, beta : (...), rad
        Directions at both ends, from the chord.
    first, second : (...)
        Lengths of both chords in any common unit.

    Returns
    -------
    tau : (...), rad
        Direction at the join, from the chord.
    phi : (...), rad
        Direction of the first chord, from the whole.
    chord : (2, ...), m
        Lengths of both chords.
    half : (2, ...), rad
        Half of what each arc turns, to the left.
    """
    f1, f2 = first / (first + second), second / (first + second)
    delta = 0.5 * (beta - alpha)
    cosine, sine = np.cos(delta), np.sin(delta)
    phi1 = -np.arctan2(f2 * sine, f1 + f2 * cosine)
    phi2 = np.arctan2(f1 * sine, f2 + f1 * cosine)
    whole = chord / np.hypot(f1 + f2 * cosine, f2 * sine)
    half = np.stack([phi1 - alpha, beta - phi2])
    return 2.0 * phi1 - alpha, phi1, np.stack([f1 * whole, f2 * whole]), half


def shared(chords: BiarcChords, first: FloatArray, second: FloatArray) -> tuple[Arcs, FloatArray]:
    """Give the biarcs whose two chords are as `first` to `second`.

    Parameters
    ----------
    chords : BiarcChords, n of them
        What is spanned.
    first, second : (n,)
        Lengths of both chords in any common unit, above 0.

    Returns
    -------
    arcs : Arcs, 2 n of them
        In order along each biarc.
    tau : (n,), rad
        Direction at the join, from the chord.
    """
    tau, phi, chord, half = spanned(chords.chord, chords.alpha, chords.beta, first, second)
    way = chords.way + phi
    join = chords.start + chord[0, :, None] * np.stack([np.cos(way), np.sin(way)], axis=1)
    arcs = Arcs(
        np.stack([chords.start, join], axis=1).reshape(-1, 2),
        np.stack([chords.way + chords.alpha, chords.way + tau], axis=1).ravel(),
        (2.0 * np.sin(half) / chord).T.ravel(),
        (chord / sinc(half)).T.ravel(),
    )
    return arcs, tau


def one_sided_shares(chords: BiarcChords) -> tuple[FloatArray, FloatArray]:
    """Give between which shares of the first chord a biarc bends no more often than it must.

    With one bend the join direction lies within the smaller end angle m on either side of the
    chord; with two bends every share from 0 to 1 will do.

    Returns
    -------
    least, most : (n,)
        Neither belongs to the range.
    """
    a, b = np.abs(chords.alpha), np.abs(chords.beta)
    low, apart = np.sin(np.minimum(a, b)), np.sin(0.5 * np.abs(a - b))
    with np.errstate(invalid="ignore"):
        edge = np.where(low > 0.0, low / (low + apart), 1.0)
    bent = chords.one_bend
    return np.where(bent & (b > a), 1.0 - edge, 0.0), np.where(bent & (a > b), edge, 1.0)


def directions_to_shares(chords: BiarcChords, tau: FloatArray) -> FloatArray:
    """Give the share of the first chord where the join is to have a direction.

    Parameters
    ----------
    chords : BiarcChords, n of them
        Those whose tangents are parallel have one such direction only and no answer: NaN.
    tau : (n,), rad
        From the chord.

    Returns
    -------
    (n,)
        Outside 0 to 1 there is no such biarc.
    """
    one, other = np.sin(0.5 * (tau + chords.beta)), -np.sin(0.5 * (tau + chords.alpha))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(one / (one + other))

"""Biarcs between points with directions: two circular arcs each, many at once.

What two arcs leave free is settled by a rule (`BiarcRule`), where none applies by equal chords;
radii below the least that can be made are repaired, the smaller one first. All end as the ratio of
two chords, of which `biarc_family` makes the arcs; closed forms stand there too. Source: Kim and
Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and Production",
J. SNAK.
"""

from __future__ import annotations

from typing import Literal, cast, get_args

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.biarc_family import (
    BiarcChords,
    biarc_label,
    biarcs_of_shares,
    chords_of_radii,
    direction_of_radius,
    one_bend_limit,
    other_radius,
    ratio_radii,
    stationary_chords,
)
from assoc_hull.geometry.classical.checked_input import digits, finite_array, one_of
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "BiarcRule",
    "Biarcs",
    "biarc_kinds",
    "biarcs",
    "check_rule",
    "chords_by_rule",
    "free_biarcs",
    "least_radii",
    "radius_limits",
    "repaired_chords",
]

# --------------------------------------------------------------------------------------
# Which biarc of the family is taken.

BiarcRule = Literal["inverse", "as_printed", "min_jump", "equal_chord"]

BoolArray = NDArray[np.bool_]
StrArray = NDArray[np.str_]

_LEAST_ANGLE = 1e-11
"""rad: an end angle below this is zero."""


def check_rule(rule: object) -> BiarcRule:
    """Take the name of a rule; raises GeometryError for another."""
    return cast(BiarcRule, one_of(rule, get_args(BiarcRule), "biarc: no rule is called"))


def biarc_kinds(chords: BiarcChords) -> StrArray:
    """Tell "line", "circle", "C" (one bend) or "S" (an inflection), for each of n.

    An angle below 1e-11 rad counts as 0, and two of the same side that differ by less are one
    circle. Where one angle is 0 and the other is not, it is an "S".
    """
    a, b = np.abs(chords.alpha), np.abs(chords.beta)
    bent = chords.one_bend
    return np.select(
        [
            chords.steepest < _LEAST_ANGLE,
            np.minimum(a, b) < _LEAST_ANGLE,
            bent & (np.abs(a - b) < _LEAST_ANGLE),
            bent,
        ],
        ["line", "S", "circle", "C"],
        "S",
    )


def chords_by_rule(
    chords: BiarcChords, kind: StrArray, rule: BiarcRule
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Give the chords of both arcs (n,), in any unit, by a rule.

    The last array tells where the rule would need a negative radius, and equal chords replace it.
    """
    first, second = np.ones((2, len(chords)))
    fallback = np.zeros(len(chords), bool)
    if rule == "equal_chord":
        return first, second, fallback
    a, b = np.abs(chords.alpha), np.abs(chords.beta)
    low, high = np.minimum(a, b), np.maximum(a, b)
    fallback = (kind == "C") & (3.0 * low - high < _LEAST_ANGLE)
    c = np.flatnonzero((kind == "C") & ~fallback)
    first[c], second[c] = stationary_chords(a[c], b[c])
    if rule != "min_jump":
        s = np.flatnonzero((kind == "S") & (low >= _LEAST_ANGLE))
        q = a[s] / b[s] if rule == "inverse" else b[s] / a[s]
        radii = ratio_radii(chords.chord[s], a[s], b[s], q)
        first[s], second[s] = chords_of_radii(chords.chord[s], a[s], b[s], *radii)
    return first, second, fallback


# --------------------------------------------------------------------------------------
# Radii that are at least what can be made: the smaller one becomes that, the other follows. The
# paper repairs negative radii in this way.

ChordPair = tuple[FloatArray, FloatArray]

_SLACK = 1e-12
"""Part of a radius that is rounding."""

_LEAST = 1e-12
"""A length below this part of a chord is zero."""


def least_radii(radius: ArrayLike, chords: BiarcChords) -> FloatArray:
    """Take one radius for all, or one each, m, 0 asks for none; raises GeometryError for others."""
    count = len(chords)
    flat = not isinstance(radius, list | tuple) and np.ndim(radius) == 0
    found = np.broadcast_to(finite_array(radius, "biarc", () if flat else (count,)), (count,))
    if (found < 0.0).any():
        index = int(np.flatnonzero(found < 0.0)[0])
        what = f"biarc: least radius {digits(found[index])} is below 0"
        raise GeometryError(what, "give 0 for none", {"index": index, "radius": found[index]})
    minute = np.flatnonzero((found > 0.0) & (found < _LEAST * chords.chord))
    if len(minute):
        index = int(minute[0])
        what = f"biarc: least radius {digits(found[index])} is none beside the chord"
        told = {"index": index, "radius": float(found[index])}
        raise GeometryError(what, "give 0 for none", told, biarc_label(index, count))
    return found


def radius_limits(chords: BiarcChords, kind: StrArray) -> FloatArray:
    """Give the least radius (m) that each could be asked for; infinite for lines."""
    a, b = np.abs(chords.alpha), np.abs(chords.beta)
    found = np.full(len(chords), np.inf)
    for rows, limit in (
        (np.flatnonzero(np.isin(kind, ("C", "circle"))), one_bend_limit),
        (np.flatnonzero(kind == "S"), _balanced),
    ):
        found[rows] = limit(chords.chord[rows], a[rows], b[rows])
    return found


def _balanced(chord: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    return ratio_radii(chord, a, b, np.ones_like(a))[0]


def repaired_chords(
    chords: BiarcChords, kind: StrArray, rows: IntArray, radius: FloatArray, at_start: BoolArray
) -> ChordPair:
    """Give the chords (k,), m, of both arcs of biarcs `rows` (k,) whose smaller radius is given.

    `radius` (n,) is in m. With an inflection `at_start` tells whether it is the first of the two
    radii; without one it is that at the larger angle. `rows` holds no lines. Raises GeometryError
    for a radius that cannot be had.
    """
    _refuse_unattainable(chords, kind, rows, radius)
    a, b = np.abs(chords.alpha[rows]), np.abs(chords.beta[rows])
    chord, least = chords.chord[rows], radius[rows]
    tau = direction_of_radius(chord, a, b, least)
    bent = np.sin(0.5 * (b - tau)), np.sin(0.5 * (a + tau))
    begin = at_start[rows]
    far = other_radius(chord, np.where(begin, a, b), np.where(begin, b, a), least)
    radii = np.where(begin, least, far), np.where(begin, far, least)
    inflected = chords_of_radii(chord, a, b, *radii)
    winds = kind[rows] == "S"
    return np.where(winds, inflected[0], bent[0]), np.where(winds, inflected[1], bent[1])


def _refuse_unattainable(
    chords: BiarcChords, kind: StrArray, rows: IntArray, radius: FloatArray
) -> None:
    limit = radius_limits(chords, kind)
    # Only with an inflection the limit itself can be had.
    reached = np.where(kind == "S", radius <= limit * (1.0 + _SLACK), radius < limit)
    bad = rows[~reached[rows]]
    if len(bad):
        index = int(bad[0])
        raise GeometryError(
            f"biarc: r_min={digits(radius[index])} not attainable, limit {digits(limit[index])}",
            "ask for less, or move the points", {
                "index": index, "r_min": float(radius[index]), "limit": float(limit[index]),
            }, biarc_label(index, len(chords)),
        )  # fmt: skip


# --------------------------------------------------------------------------------------
# The biarcs.

_SHARP = 1.0 + 1e-12
"""Factor by which a curvature or an angle is beyond its limit, not only by rounding."""


@attrs.frozen(eq=False)
class Biarcs:
    """Biarcs of a plane.

    Attributes
    ----------
    arcs : PlaneArcs, 2 n of them
        First and second arc of each biarc, in order.
    tau : (n,), rad
        Direction at the join, from the chord.
    kind : (n,) str
        "line", "circle", "C" (one bend) or "S" (an inflection), by the end angles.
    fallback : (n,) bool
        Where equal chords replace a rule that would need a negative radius. Such a biarc
        has an inflection although its end angles need none.
    repaired : (n,) bool
        Where the smaller radius is the least one that was asked for.
    notes : tuple of str
        What is to be said, whole sentences.
    """

    arcs: PlaneArcs
    tau: FloatArray
    kind: StrArray
    fallback: BoolArray
    repaired: BoolArray
    notes: tuple[str, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.tau, self.kind, self.fallback, self.repaired)

    def __len__(self) -> int:
        return len(self.tau)

    @property
    def joins(self) -> FloatArray:
        """Where both arcs join, (n, 2), m."""
        return self.arcs.start[1::2]

    @property
    def directions(self) -> FloatArray:
        """Direction at the join, (n,), rad, not wrapped."""
        return self.arcs.angle[1::2]

    @property
    def curvatures(self) -> FloatArray:
        """Both curvatures of each, (n, 2), 1/m, positive to the left."""
        return self.arcs.curvature.reshape(-1, 2)

    @property
    def lengths(self) -> FloatArray:
        """Length of each, (n,), m."""
        return np.asarray(self.arcs.length.reshape(-1, 2).sum(axis=1))


def biarcs(
    start: ArrayLike,
    start_angle: ArrayLike,
    end: ArrayLike,
    end_angle: ArrayLike,
    *,
    rule: BiarcRule = "inverse",
    least_radius: ArrayLike = 0.0,
) -> Biarcs:
    """Span pairs of points with given directions by two arcs each.

    Parameters
    ----------
    start, end : (n, 2), m
        First and last points.
    start_angle, end_angle : (n,), rad
        Directions of travel there, from the first axis to the left.
    rule : "inverse", "as_printed", "min_jump" or "equal_chord"
        For biarcs with an inflection: radii inversely proportional to the angles, as the paper
        says; proportional to them, as it prints; or the least jump of curvature, which has equal
        chords. With one bend the three are one: R1 - R2 stationary. "equal_chord" takes equal
        chords everywhere, so that curvatures depend smoothly on the angles.
    least_radius : float or (n,), m
        Where a radius is smaller, it becomes this one and the other arc follows; 0 for none.

    Returns
    -------
    Biarcs
        Frozen. Where one angle is three times the other or more, on the same side, and no
        least radius is given, chords are equal and `fallback` says so.

    Raises
    ------
    GeometryError
        ``"biarc: zero chord"``; ``"biarc: end angle {} to the chord exceeds 90 deg"`` from 180 deg
        on, a note below that; ``"biarc: r_min={} not attainable, limit {}"``; no such rule; shapes,
        and numbers that are not finite.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.biarcs import biarcs
    >>> found = biarcs([[0, 0]], [0.0], [[10, 0]], [0.5])
    >>> found.arcs.curvature.round(8).tolist(), found.tau.tolist()
    ([-0.04948079, 0.1453659], [-0.25])
    """
    chords = BiarcChords.of(start, start_angle, end, end_angle)
    taken = check_rule(rule)
    least = least_radii(least_radius, chords)
    kind = biarc_kinds(chords)
    chords = _straightened(chords, kind)
    first, second, fallback = chords_by_rule(chords, kind, taken)
    arcs, tau = biarcs_of_shares(chords, first, second)
    bends = np.abs(arcs.curvature.reshape(-1, 2))
    repaired = (bends.max(axis=1, initial=0.0) * least > _SHARP) | (fallback & (least > 0.0))
    if repaired.any():
        rows = np.flatnonzero(repaired)
        at_start = bends[:, 0] >= bends[:, 1]
        first[rows], second[rows] = repaired_chords(chords, kind, rows, least, at_start)
        arcs, tau = biarcs_of_shares(chords, first, second)
        fallback &= ~repaired
    notes = (*_wide(chords), *_fallbacks(fallback), *_repairs(repaired, least))
    return Biarcs(arcs, tau, kind, fallback, repaired, notes)


def free_biarcs(
    start: ArrayLike, start_angle: ArrayLike, end: ArrayLike, end_angle: ArrayLike, share: ArrayLike
) -> Biarcs:
    """Span pairs of points with given directions, the place of the joins being free.

    Parameters
    ----------
    start, start_angle, end, end_angle
        As `biarcs` takes them.
    share : (n,)
        Length of the first chord as a part of both, between 0 and 1. Within
        `biarc_family.one_sided_shares` a biarc bends no more often than it must;
        `biarc_family.directions_to_shares` gives shares of join directions.

    Raises
    ------
    GeometryError
        A share that is not between 0 and 1; else as `biarcs`.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.biarcs import free_biarcs
    >>> free_biarcs([[0, 0]], [0.6], [[10, 0]], [-0.4], [0.3]).arcs.length.round(6).tolist()
    [3.112089, 7.263709]
    """
    chords = BiarcChords.of(start, start_angle, end, end_angle)
    part = finite_array(share, "biarc", (len(chords),))
    bad = np.flatnonzero((part < _LEAST) | (1.0 - part < _LEAST))
    if len(bad):
        index = int(bad[0])
        what = f"biarc: share {digits(part[index])} of the first chord"
        told = {"index": index, "share": float(part[index])}
        raise GeometryError(
            what, "give one between 0 and 1, each by 1e-12", told, biarc_label(index, len(part))
        )
    arcs, tau = biarcs_of_shares(chords, part, 1.0 - part)
    none = np.zeros(len(chords), bool)
    return Biarcs(arcs, tau, biarc_kinds(chords), none, none.copy(), _wide(chords))


def _straightened(chords: BiarcChords, kind: StrArray) -> BiarcChords:
    """Let lines run along their chord, so that rounding leaves them no curvature."""
    line = kind == "line"
    if not line.any():
        return chords
    alpha, beta = (np.where(line, 0.0, each) for each in (chords.alpha, chords.beta))
    return attrs.evolve(chords, alpha=alpha, beta=beta)


def _wide(chords: BiarcChords) -> tuple[str, ...]:
    rows = np.flatnonzero(chords.steepest > 0.5 * np.pi * _SHARP)
    if not len(rows):
        return ()
    angle = digits(np.degrees(chords.steepest[rows].max()))
    return (f"biarc: end angle {angle} deg to the chord exceeds 90 deg{_where(rows)}.",)


def _fallbacks(fallback: BoolArray) -> tuple[str, ...]:
    rows = np.flatnonzero(fallback)
    if not len(rows):
        return ()
    why = "one end angle is three times the other or more"
    return (f"biarc: fallback to equal chords, {why}{_where(rows)}.",)


def _repairs(repaired: BoolArray, least: FloatArray) -> tuple[str, ...]:
    rows = np.flatnonzero(repaired)
    if not len(rows):
        return ()
    radius = digits(least[rows].max())
    return (f"biarc: the smaller radius is the least radius {radius}{_where(rows)}.",)


def _where(rows: NDArray[np.int64]) -> str:
    more = f" and {len(rows) - 1} more" if len(rows) > 1 else ""
    return f" (interval {rows[0]}{more})"

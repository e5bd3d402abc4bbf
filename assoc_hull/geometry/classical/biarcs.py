"""Biarcs between points with directions: two arcs of circles each, many at once.

What two arcs still leave free is settled by a rule, after Kim and Chang, "Some Representations of
Ship Hulls by Mathematical Method for Design and Production", J. SNAK. The closed forms stand in
`biarc_c` (one bend) and `biarc_s` (with an inflection); all end as the ratio of two chords, of
which `biarc_family` makes the arcs.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.biarcs import biarcs
>>> found = biarcs([[0, 0]], np.radians([60]), [[10, 0]], np.radians([-30]))
>>> found.kind.tolist(), (1 / np.abs(found.arcs.curvature)).round(6).tolist()
(['C'], [2.41181, 11.248444])
>>> found.arcs.ends()[1].round(12).tolist()
[10.0, 0.0]
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arcs import Arcs
from assoc_hull.geometry.classical.biarc_family import BiarcChords, interval, shared
from assoc_hull.geometry.classical.biarc_repair import least_radii, repaired_chords
from assoc_hull.geometry.classical.biarc_rules import (
    BiarcRule,
    biarc_kinds,
    known_rule,
    ruled_chords,
)  # fmt: skip
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Biarcs", "biarcs", "free_biarcs"]

BoolArray = NDArray[np.bool_]
StrArray = NDArray[np.str_]

_SHARP = 1.0 + 1e-12
_LEAST = 1e-12
"""Share of a chord below which an arc is none."""


@attrs.frozen(eq=False)
class Biarcs:
    """Biarcs of a plane.

    Attributes
    ----------
    arcs : Arcs, 2 n of them
        First and second arc of each biarc, in order.
    tau : (n,), rad
        Direction at the join, from the chord.
    kind : (n,) str
        "line", "circle", "C" (one bend) or "S" (an inflection), by the end angles.
    fallback : (n,) bool
        Where equal chords stand in for a rule that would need a radius below nil. Such a biarc
        has an inflection although its end angles need none.
    repaired : (n,) bool
        Where the smaller radius is the least one that was asked for.
    notes : tuple of str
        What is to be said, whole sentences.
    """

    arcs: Arcs
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
    taken = known_rule(rule)
    least = least_radii(least_radius, chords)
    kind = biarc_kinds(chords)
    chords = _straightened(chords, kind)
    first, second, fallback = ruled_chords(chords, kind, taken)
    arcs, tau = shared(chords, first, second)
    bends = np.abs(arcs.curvature.reshape(-1, 2))
    repaired = (bends.max(axis=1, initial=0.0) * least > _SHARP) | (fallback & (least > 0.0))
    if repaired.any():
        rows = np.flatnonzero(repaired)
        at_start = bends[:, 0] >= bends[:, 1]
        first[rows], second[rows] = repaired_chords(chords, kind, rows, least, at_start)
        arcs, tau = shared(chords, first, second)
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
    part = finite(share, "biarc", (len(chords),))
    bad = np.flatnonzero((part < _LEAST) | (1.0 - part < _LEAST))
    if len(bad):
        index = int(bad[0])
        what = f"biarc: share {figure(part[index])} of the first chord"
        told = {"index": index, "share": float(part[index])}
        raise GeometryError(
            what, "give one between 0 and 1, each by 1e-12", told, interval(index, len(part))
        )
    arcs, tau = shared(chords, part, 1.0 - part)
    none = np.zeros(len(chords), bool)
    return Biarcs(arcs, tau, biarc_kinds(chords), none, none.copy(), _wide(chords))


def _straightened(chords: BiarcChords, kind: StrArray) -> BiarcChords:
    """Let lines run along their chord: no curvature at all is left to rounding."""
    line = kind == "line"
    if not line.any():
        return chords
    alpha, beta = (np.where(line, 0.0, each) for each in (chords.alpha, chords.beta))
    return attrs.evolve(chords, alpha=alpha, beta=beta)


def _wide(chords: BiarcChords) -> tuple[str, ...]:
    rows = np.flatnonzero(chords.steepest > 0.5 * np.pi * _SHARP)
    if not len(rows):
        return ()
    angle = figure(np.degrees(chords.steepest[rows].max()))
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
    radius = figure(least[rows].max())
    return (f"biarc: the smaller radius is the least radius {radius}{_where(rows)}.",)


def _where(rows: NDArray[np.int64]) -> str:
    more = f" and {len(rows) - 1} more" if len(rows) > 1 else ""
    return f" (interval {rows[0]}{more})"

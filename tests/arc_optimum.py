"""The fewest arcs of a plane curve, by dynamic programming over many break points.

Straightforward, and independent of the search that ships: every pair of break points is tried,
biarcs are those of `biarc_family`, distances those of `Arcs`. Chains are of two kinds:

- biarcs that keep the tangents of the curve at the break points (`fewest_exact`);
- single arcs that end on the curve in any direction (`fewest_tilted`), the states being a break
  point and a range of directions there.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.classical.biarc_family import BiarcChords, biarcs_of_shares
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["PlaneCurve", "fewest_exact", "fewest_tilted", "fits_one"]

SHARES = np.linspace(0.1, 0.9, 17)
_BLOCK = 16


class PlaneCurve:
    """A smooth run of cubics (p, 4, 2): break points, and places between them."""

    def __init__(self, cubic: FloatArray, breaks: int, between: int) -> None:
        self.between = between
        u = np.arange(breaks * between) / (breaks * between)
        powers = np.stack([u**k for k in range(4)], axis=1)
        slopes = np.stack([k * u ** max(k - 1, 0) for k in range(4)], axis=1)
        last = cubic[-1].sum(axis=0)[None]
        self.places = np.concatenate([(powers @ cubic).reshape(-1, 2), last])
        end = (cubic[-1] * np.arange(4)[:, None]).sum(axis=0)[None]
        tangent = np.concatenate([(slopes @ cubic).reshape(-1, 2), end])
        self.angle = np.arctan2(tangent[:, 1], tangent[:, 0])[::between]
        self.breaks = self.places[::between]

    def inner(self, i: int, j: int, most: int = 60) -> FloatArray:
        """Places between two break points."""
        inside = self.places[i * self.between + 1 : j * self.between]
        return inside[:: max(1, len(inside) // most)]


def fewest_exact(
    curve: PlaneCurve, within: float, samples: int = 40, shares: FloatArray = SHARES
) -> int:
    """Arcs of the fewest biarcs that keep the tangents of the curve at their ends."""
    count = len(curve.breaks)
    best = np.full(count, 10**6)
    best[0] = 0
    for i in range(count - 1):
        for first in range(i + 1, count, _BLOCK):
            ends = np.arange(first, min(first + _BLOCK, count))
            fits = _biarcs_fit(curve, i, ends, within, samples, shares)
            best[ends[fits]] = np.minimum(best[ends[fits]], best[i] + 2)
            if not fits.any():
                break
    return int(best[-1])


def fits_one(curve: PlaneCurve, i: int, j: int, within: float, samples: int = 40) -> bool:
    """Whether one biarc fits between two break points, whatever its join."""
    return bool(_biarcs_fit(curve, i, np.array([j]), within, samples, SHARES)[0])


def _biarcs_fit(
    curve: PlaneCurve, i: int, ends: IntArray, within: float, samples: int, shares: FloatArray
) -> NDArray[np.bool_]:
    """Which of the stretches from one break point to others one biarc fits, whatever its join."""
    n, k = len(ends), len(shares)
    shape = np.ones((n, k))
    step = curve.breaks[ends] - curve.breaks[i]
    course = np.arctan2(step[:, 1], step[:, 0])
    turn = np.abs(np.angle(np.exp(1j * (curve.angle[[i]] - course))))
    turn = np.maximum(turn, np.abs(np.angle(np.exp(1j * (curve.angle[ends] - course)))))
    own = np.repeat(ends, k)
    chords = BiarcChords.of(
        curve.breaks[i] * np.ones((n * k, 1)), np.full(n * k, curve.angle[i]),
        curve.breaks[own], curve.angle[own],
    )  # fmt: skip
    share = (shares * shape).ravel()
    arcs, _ = biarcs_of_shares(chords, share, 1.0 - share)
    part = np.linspace(0.0, 1.0, samples + 2)[1:-1]
    number = np.round((i + (ends - i)[:, None] * part) * curve.between).astype(int)
    places = np.repeat(curve.places[number], k, axis=0).reshape(-1, 2)
    arc = 2 * np.repeat(np.arange(n * k), samples)
    off = np.minimum(arcs.distance(arc, places), arcs.distance(arc + 1, places))
    most = off.reshape(n, k, samples).max(axis=2).min(axis=1)
    return np.asarray((most <= within) & (turn < 1.5))


def _course(curve: PlaneCurve, i: int, j: int) -> float:
    step = curve.breaks[j] - curve.breaks[i]
    return float(np.arctan2(step[1], step[0]))


def _off(arcs: PlaneArcs, per: int, places: FloatArray) -> FloatArray:
    """The largest distance of places from each of several chains of `per` arcs."""
    chains = len(arcs) // per
    number = np.arange(len(arcs)).reshape(chains, per)
    flat = np.tile(places, (chains, 1))
    found = [arcs.distance(np.repeat(number[:, k], len(places)), flat) for k in range(per)]
    off: FloatArray = np.min(found, axis=0).reshape(chains, -1).max(axis=1)
    return off


def fewest_tilted(
    curve: PlaneCurve, within: float, widest: float, ranges: int, misses: int = 3
) -> int:
    """Arcs of the shortest chain of single arcs through break points, in any direction there.

    `widest` (rad) bounds tilts, of which there are so many ranges. The chain begins in the
    direction of the curve and ends in it by a biarc, as those that ship do.
    """
    count = len(curve.breaks)
    front: dict[tuple[int, int], float] = {(0, 0): 0.0}
    seen = np.zeros((count, 2 * ranges + 1), bool)
    for arcs_so_far in itertools.count():
        following: dict[tuple[int, int], float] = {}
        for (i, _), tilt in front.items():
            if _lands(curve, i, tilt, within):
                return arcs_so_far + 2
            for j, end in _singles(curve, i, tilt, within, misses):
                mark = round(end / widest * ranges)
                if abs(mark) <= ranges and not seen[j, mark + ranges]:
                    seen[j, mark + ranges] = True
                    following[(j, mark)] = end
        if not following:
            return 10**6
        front = following
    raise AssertionError


def _lands(curve: PlaneCurve, i: int, tilt: float, within: float) -> bool:
    """Whether a biarc leads from a state to the end, and its direction."""
    j = len(curve.breaks) - 1
    if j - i > 4 * 60 or i == j:
        return False
    ends = np.array([curve.angle[i] + tilt, curve.angle[j]]) - _course(curve, i, j)
    if np.abs(np.angle(np.exp(1j * ends))).max() > 1.5:
        return False
    ones = np.ones(len(SHARES))
    chords = BiarcChords.of(
        curve.breaks[i] * ones[:, None], (curve.angle[i] + tilt) * ones,
        curve.breaks[j] * ones[:, None], curve.angle[j] * ones,
    )  # fmt: skip
    arcs, _ = biarcs_of_shares(chords, SHARES, 1.0 - SHARES)
    return bool(_off(arcs, 2, curve.inner(i, j)).min() <= within)


def _singles(
    curve: PlaneCurve, i: int, tilt: float, within: float, misses: int
) -> list[tuple[int, float]]:
    """Break points that one arc reaches from a state, and the tilts there."""
    angle = curve.angle[i] + tilt
    found, missed = [], 0
    for j in range(i + 1, len(curve.breaks) - 1):
        course = _course(curve, i, j)
        alpha = float(np.angle(np.exp(1j * (angle - course))))
        chord = float(np.hypot(*(curve.breaks[j] - curve.breaks[i])))
        bend = -2.0 * np.sin(alpha) / chord
        away = curve.inner(i, j, 24) - curve.breaks[i]
        left = 2.0 * (np.cos(angle) * away[:, 1] - np.sin(angle) * away[:, 0])
        across = bend * (away * away).sum(axis=1) - left
        off = np.abs(across) / (1.0 + np.sqrt(np.maximum(1.0 + bend * across, 0.0)))
        if abs(alpha) < 1.5 and off.max(initial=0.0) <= within:
            end = float(np.angle(np.exp(1j * (course - alpha - curve.angle[j]))))
            found.append((j, end))
            missed = 0
        else:
            missed += 1
            if missed > misses:
                break
    return found

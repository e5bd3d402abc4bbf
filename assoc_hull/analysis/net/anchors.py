"""The lines that run along a strip: from a place on one rail to a place on the other."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import Net, Part
from assoc_hull.analysis.net.loops import Frame

__all__ = ["Anchor", "Spans", "anchors", "spans"]

_PLACES = ("boundary", "waterlines", "buttocks", "diagonals", "frames")
"""Where two lines cross one another between sections, the family that stands first is taken."""

_APART = 1e-5
"""Anchors lie so far apart on both rails, in lengths of the rail."""

Spot = tuple[int, float]
"""A part of a rail by its number, and the parameter (m) on its curve."""


@attrs.frozen
class Anchor:
    """A line along a strip.

    Attributes
    ----------
    parts : tuple of Part
        The line, from aft forward; none for a straight one.
    aft, fore : (int, float)
        Where it lies on the rails.
    low, high : float
        How far up the rails that is, from 0 to 1.
    """

    parts: tuple[Part, ...]
    aft: Spot
    fore: Spot
    low: float
    high: float


@attrs.frozen
class Spans:
    """Stretches of lines between neighbouring crossings with sections or ends of the hull.

    Attributes
    ----------
    span : tuple of (Part, (int, float), (int, float), int)
        The stretch, the curve and parameter (m) that it comes from and goes to, and the place
        of its family.
    of : dict of (int, int) to tuple of int
        Which spans run between two curves.
    """

    span: tuple[tuple[Part, Spot, Spot, int], ...]
    of: dict[tuple[int, int], tuple[int, ...]]


def spans(net: Net) -> Spans:
    """Cut all lines along the ship at sections and ends."""
    rail = net.end | np.isfinite(net.x)
    found: list[tuple[Part, Spot, Spot, int]] = []
    marks: dict[int, list[tuple[float, int, float]]] = {}
    for both, place in zip(net.meets.tolist(), net.place.tolist(), strict=True):
        for own, other in ((0, 1), (1, 0)):
            if rail[both[other]] and not rail[both[own]]:
                marks.setdefault(both[own], []).append((place[own], both[other], place[other]))
    for curve in sorted(marks):
        order = sorted(marks[curve])
        rank = _PLACES.index(net.family[curve])
        for (t0, c0, s0), (t1, c1, s1) in itertools.pairwise(order):
            if t1 > t0:
                found.append(((curve, t0, t1), (c0, s0), (c1, s1), rank))
    of: dict[tuple[int, int], tuple[int, ...]] = {}
    for i, (_, (c0, _s0), (c1, _s1), _) in enumerate(found):
        key = (min(c0, c1), max(c0, c1))
        of[key] = (*of.get(key, ()), i)
    return Spans(tuple(found), of)


def anchors(net: Net, frame: Frame, every: Spans) -> list[Anchor]:
    """Give the anchors of a strip from keel to deck, its sides included.

    Where lines cross between the rails those of the family that stands first stay; the others
    go through the rails' points all the same.
    """
    aft, fore = _Rail.of(frame.aft), _Rail.of(frame.fore)
    found: list[tuple[int, Anchor]] = []
    for a in aft.curves:
        for f in fore.curves:
            for i in every.of.get((min(a, f), max(a, f)), ()):
                part, begin, finish, rank = every.span[i]
                for one, other, way in ((begin, finish, part), (finish, begin, _turned(part))):
                    low, high = aft.spot(one), fore.spot(other)
                    if low is not None and high is not None:
                        at = aft.height(low), fore.height(high)
                        found.append((rank, Anchor((way,), low, high, *at)))
                        break
    keel = Anchor(frame.keel, aft.begin, fore.begin, 0.0, 0.0)
    deck = Anchor(frame.deck, aft.finish, fore.finish, 1.0, 1.0)
    return _in_order(keel, deck, found)


def _in_order(keel: Anchor, deck: Anchor, found: Sequence[tuple[int, Anchor]]) -> list[Anchor]:
    """Take anchors one after the other that do not cross those taken."""
    taken = [keel, deck]
    for _, anchor in sorted(found, key=lambda each: (each[0], each[1].low, each[1].high)):
        place = sum(other.low <= anchor.low for other in taken[:-1])
        below, above = taken[place - 1], taken[place]
        apart = min(
            anchor.low - below.low,
            above.low - anchor.low,
            anchor.high - below.high,
            above.high - anchor.high,
        )
        if apart > _APART:
            taken.insert(place, anchor)
    return taken


def _turned(part: Part) -> Part:
    return part[0], part[2], part[1]


@attrs.frozen
class _Rail:
    """A rail, to find places on it."""

    parts: tuple[Part, ...]
    base: tuple[float, ...]
    length: float

    @classmethod
    def of(cls, parts: tuple[Part, ...]) -> _Rail:
        sizes = [abs(part[2] - part[1]) for part in parts]
        base = tuple(float(sum(sizes[:i])) for i in range(len(sizes)))
        return cls(parts, base, float(sum(sizes)))

    @property
    def curves(self) -> list[int]:
        return list(dict.fromkeys(part[0] for part in self.parts))

    @property
    def begin(self) -> Spot:
        return 0, self.parts[0][1]

    @property
    def finish(self) -> Spot:
        return len(self.parts) - 1, self.parts[-1][2]

    def spot(self, place: Spot) -> Spot | None:
        """Find a place on a curve on the rail, None if it is not there."""
        curve, t = place
        for i, (c, t0, t1) in enumerate(self.parts):
            if c == curve and min(t0, t1) <= t <= max(t0, t1):
                return i, t
        return None

    def height(self, spot: Spot) -> float:
        """Say how far up the rail a place is, from 0 to 1."""
        return (self.base[spot[0]] + abs(spot[1] - self.parts[spot[0]][1])) / self.length

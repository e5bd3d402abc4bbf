"""The lines that run along a strip: from a place on one rail to a place on the other."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.net.curve_net import CurveNet, CurvePart
from assoc_hull.analysis.net.strip_boundaries import StripBoundary
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.evaluation import derivative, evaluate

__all__ = ["LineSpans", "StripAnchor", "line_spans", "strip_anchors"]

_PLACES = ("boundary", "waterlines", "buttocks", "diagonals", "frames")
"""Where two lines cross one another between sections, the family that stands first is taken.

Borders of flats come last: a waterline that leaves the flat between two sections says more of
the hull there than the border, along which nothing bends.
"""

_APART = 1e-5
"""Anchors lie so far apart on both rails, in lengths of the rail."""

_SAMPLES = np.linspace(1e-6, 1.0 - 1e-6, 9)  # a knuckle at the end belongs to what follows
_STEADY = 0.02
"""Along an anchor x grows everywhere by this part of its mean growth at least."""

_SAME = 1e-6
"""Places on one curve so near to one another (m) are one."""

CurvePlace = tuple[int, float]
"""A part of a rail by its number, and the parameter (m) on its curve."""


@attrs.frozen
class StripAnchor:
    """A line along a strip.

    Attributes
    ----------
    parts : tuple of Part
        The line, from aft forward; none for a straight one.
    aft, fore : (int, float)
        Where it lies on the rails.
    low, high : float
        How far up the rails that is, from 0 to 1.
    course : (5, 3) or None, m
        Its ends and three places between, evenly spaced in x, from aft forward; None for a
        side of the strip.
    """

    parts: tuple[CurvePart, ...]
    aft: CurvePlace
    fore: CurvePlace
    low: float
    high: float
    course: FloatArray | None = attrs.field(default=None, eq=False)


@attrs.frozen
class LineSpans:
    """Stretches of lines between neighbouring crossings with sections or ends of the hull.

    Attributes
    ----------
    span : tuple of (Part, (int, float), (int, float), int)
        The stretch, the curve and parameter (m) that it comes from and goes to, and the place
        of its family.
    steady : tuple of bool
        Along the stretch x only grows, or only falls.
    of : dict of (int, int) to tuple of int
        Which spans run between two curves.
    course : (n, 5, 3), m
        The ends of each stretch and three places between, evenly spaced in x.
    """

    span: tuple[tuple[CurvePart, CurvePlace, CurvePlace, int], ...]
    steady: tuple[bool, ...]
    of: dict[tuple[int, int], tuple[int, ...]]
    course: FloatArray


def line_spans(net: CurveNet) -> LineSpans:
    """Cut all lines along the ship at sections and ends."""
    rail = net.end | np.isfinite(net.x)
    found: list[tuple[CurvePart, CurvePlace, CurvePlace, int]] = []
    marks: dict[int, list[tuple[float, int, float]]] = {}
    for both, place in zip(net.meets.tolist(), net.place.tolist(), strict=True):
        for own, other in ((0, 1), (1, 0)):
            if rail[both[other]] and not rail[both[own]]:
                marks.setdefault(both[own], []).append((place[own], both[other], place[other]))
    for curve in sorted(marks):
        order = sorted(marks[curve])
        rank = len(_PLACES) if net.flat[curve] else _place(net, curve)
        for (t0, c0, s0), (t1, c1, s1) in itertools.pairwise(order):
            if t1 > t0:
                found.append(((curve, t0, t1), (c0, s0), (c1, s1), rank))
    of: dict[tuple[int, int], tuple[int, ...]] = {}
    for i, (_, (c0, _s0), (c1, _s1), _) in enumerate(found):
        key = (min(c0, c1), max(c0, c1))
        of[key] = (*of.get(key, ()), i)
    parts = [each[0] for each in found]
    return LineSpans(tuple(found), runs_monotonic(net, parts), of, _courses(net, parts))


def _place(net: CurveNet, curve: int) -> int:
    """Give the place of a line's family among those that run along the ship."""
    family = net.family[curve]
    if family not in _PLACES:
        raise BadInputError(
            f"{net.name[curve]} of the {family} is a curve in space, in no plane across the ship",
            "in the surface through the lines", "replace it by lines that lie in planes",
        )  # fmt: skip
    return _PLACES.index(family)


def runs_monotonic(net: CurveNet, parts: Sequence[CurvePart]) -> tuple[bool, ...]:
    """Tell along which parts of curves x only grows, or only falls, and nowhere hardly at all."""
    curve, t = _sampled(parts)
    slope = derivative(net.batch, curve.repeat(t.shape[1]), t.ravel())[:, 0].reshape(t.shape)
    ends = evaluate(net.batch, np.tile(curve, 2), np.concatenate([t[:, 0], t[:, -1]]))[:, 0]
    mean = (ends[len(curve) :] - ends[: len(curve)])[:, None] / (t[:, -1:] - t[:, :1])
    return tuple(
        ((slope * np.sign(mean) > _STEADY * np.abs(mean)) & (mean != 0.0)).all(axis=1).tolist()
    )


def _courses(net: CurveNet, parts: Sequence[CurvePart]) -> FloatArray:
    """Give ends of parts of curves and the places at 1/4, 1/2 and 3/4 of their length, (n, 5, 3).

    The length is that along the ship; places lie on straight lines between samples.
    """
    curve, t = _sampled(parts)
    flat: FloatArray = evaluate(net.batch, curve.repeat(t.shape[1]), t.ravel())
    place = flat.reshape(*t.shape, 3)
    ahead = np.where((place[:, -1:, :1] >= place[:, :1, :1]), place, place[:, ::-1])
    x, rows = ahead[..., 0], np.arange(len(place))[:, None]
    at = place[:, :1, 0] + (place[:, -1:, 0] - place[:, :1, 0]) * np.array([0.25, 0.5, 0.75])
    after = np.clip((x[:, None, :] <= at[..., None]).sum(axis=2), 1, x.shape[1] - 1)
    low, high = ahead[rows, after - 1], ahead[rows, after]
    width = high[..., 0] - low[..., 0]
    part = np.divide(at - low[..., 0], width, out=np.zeros_like(width), where=width > 0.0)
    between = low + (high - low) * np.clip(part, 0.0, 1.0)[..., None]
    return np.concatenate([place[:, :1], between, place[:, -1:]], axis=1)


def _sampled(parts: Sequence[CurvePart]) -> tuple[IntArray, FloatArray]:
    """Give the curves of parts, (n,), and parameters along them, (n, k), m."""
    begin, finish = (np.array([part[i] for part in parts], np.float64)[:, None] for i in (1, 2))
    return np.array([part[0] for part in parts], np.int64), begin + (finish - begin) * _SAMPLES


def strip_anchors(
    frame: StripBoundary, every: LineSpans
) -> tuple[StripBoundary, list[StripAnchor]]:
    """Give the anchors of a strip from keel to deck, its sides included.

    Where lines cross between the rails those of the family that stands first stay; the others
    go through the rails' points all the same. Where all lines run to one point of a rail (the
    tip of an ellipsoid) the rail is that point, and what lay on either side of it becomes a
    side: the frame is given back as it is then.
    """
    found = _found(frame, every)
    pointed = _pointed(frame, [anchor for _, anchor in found])
    if pointed is not None:
        frame = pointed
        found = _found(frame, every)
    aft, fore = _rails(frame)
    keel = StripAnchor(frame.keel, aft.begin, fore.begin, 0.0, 0.0)
    deck = StripAnchor(frame.deck, aft.finish, fore.finish, 1.0, 1.0)
    return frame, _in_order(keel, deck, found)


def _rails(frame: StripBoundary) -> tuple[_Rail, _Rail]:
    return (
        _Rail.of(frame.aft, frame.keel[:1], frame.deck[:1], 1),
        _Rail.of(frame.fore, frame.keel[-1:], frame.deck[-1:], 2),
    )


def _found(frame: StripBoundary, every: LineSpans) -> list[tuple[int, StripAnchor]]:
    """Find the stretches of lines from one rail to the other."""
    aft, fore = _rails(frame)
    found: list[tuple[int, StripAnchor]] = []
    for i in (
        i
        for a in aft.curves
        for f in fore.curves
        for i in every.of.get((min(a, f), max(a, f)), ())
        if every.steady[i] or not frame.plane
    ):
        part, begin, finish, rank = every.span[i]
        course = every.course[i]
        for one, other, way, run in (
            (begin, finish, part, course),
            (finish, begin, _turned(part), course[::-1]),
        ):
            low, high = aft.spot(one), fore.spot(other)
            if low is not None and high is not None:
                at = aft.height(low), fore.height(high)
                at = (at[1] if aft.is_point else at[0], at[0] if fore.is_point else at[1])
                found.append((rank, StripAnchor((way,), low, high, *at, run)))
                break
    return found


def _pointed(frame: StripBoundary, run: Sequence[StripAnchor]) -> StripBoundary | None:
    """Give the frame with a rail that is a point, if all anchors run to one."""
    if frame.plane or len(run) < 2:
        return None
    if len(frame.fore) == 1 and np.ptp([each.fore[1] for each in run]) <= _SAME:
        (curve, t0, t1), tip = frame.fore[0], run[0].fore[1]
        return attrs.evolve(
            frame,
            fore=((curve, tip, tip),),
            keel=(*frame.keel, (curve, t0, tip)),
            deck=(*frame.deck, (curve, t1, tip)),
        )
    if len(frame.aft) == 1 and np.ptp([each.aft[1] for each in run]) <= _SAME:
        (curve, t0, t1), tip = frame.aft[0], run[0].aft[1]
        return attrs.evolve(
            frame,
            aft=((curve, tip, tip),),
            keel=((curve, tip, t0), *frame.keel),
            deck=((curve, tip, t1), *frame.deck),
        )
    return None


def _in_order(
    keel: StripAnchor, deck: StripAnchor, found: Sequence[tuple[int, StripAnchor]]
) -> list[StripAnchor]:
    """Take anchors one after the other that do not cross those taken."""
    taken = [keel, deck]
    for _, anchor in sorted(found, key=lambda each: (each[0], each[1].low, each[1].high)):
        place = sum(other.low + other.high <= anchor.low + anchor.high for other in taken[:-1])
        below, above = taken[place - 1], taken[place]
        if _fits(below, anchor) and _fits(anchor, above):
            taken.insert(place, anchor)
    return taken


def _fits(below: StripAnchor, above: StripAnchor) -> bool:
    """Tell whether one anchor lies above another: apart on both rails, or joined at one end.

    A waterline that begins at the keel of a section makes a cell of three sides.
    """
    low, high = above.low - below.low, above.high - below.high
    corner = (below.low == below.high == 0.0) or (above.low == above.high == 1.0)
    least, most = min(low, high), max(low, high)
    apart = most > _APART and (least > _APART or (corner and least >= -_APART))
    return apart and not _cross(below, above)


def _cross(below: StripAnchor, above: StripAnchor) -> bool:
    """Tell whether two anchors change places on their way: there the surface would fold.

    Looked at is at which side one lies of the other, at three places between the rails.
    """
    if below.course is None or above.course is None:
        return False
    apart = above.course - below.course
    return bool((apart[1:-1] @ (apart[0] + apart[-1]) <= 0.0).any())


def _turned(part: CurvePart) -> CurvePart:
    return part[0], part[2], part[1]


@attrs.frozen
class _Rail:
    """A rail, to find places on it."""

    parts: tuple[CurvePart, ...]
    base: tuple[float, ...]
    length: float
    corner: tuple[tuple[CurvePlace, CurvePlace], ...]
    """Places on the sides at which the rail begins and ends, and where on the rail that is."""

    @classmethod
    def of(
        cls,
        parts: tuple[CurvePart, ...],
        keel: Sequence[CurvePart],
        deck: Sequence[CurvePart],
        end: int,
    ) -> _Rail:
        """Make a rail; `end` says which end of the sides it joins: 1 their begin, 2 their end."""
        sizes = [abs(part[2] - part[1]) for part in parts]
        base = tuple(float(sum(sizes[:i])) for i in range(len(sizes)))
        begin, finish = (0, parts[0][1]), (len(parts) - 1, parts[-1][2])
        corner = [((part[0], part[end]), begin) for part in keel]
        corner += [((part[0], part[end]), finish) for part in deck]
        return cls(parts, base, float(sum(sizes)), tuple(corner))

    @property
    def curves(self) -> list[int]:
        every = [part[0] for part in self.parts] + [place[0] for place, _ in self.corner]
        return list(dict.fromkeys(every))

    @property
    def is_point(self) -> bool:
        return self.length == 0.0

    @property
    def begin(self) -> CurvePlace:
        return 0, self.parts[0][1]

    @property
    def finish(self) -> CurvePlace:
        return len(self.parts) - 1, self.parts[-1][2]

    def spot(self, place: CurvePlace) -> CurvePlace | None:
        """Find a place on a curve on the rail, None if it is not there."""
        curve, t = place
        for i, (c, t0, t1) in enumerate(self.parts):
            if c == curve and min(t0, t1) - _SAME <= t <= max(t0, t1) + _SAME:
                return i, float(np.clip(t, min(t0, t1), max(t0, t1)))
        for (c, at), spot in self.corner:
            if c == curve and abs(at - t) <= _SAME:
                return spot
        return None

    def height(self, spot: CurvePlace) -> float:
        """Say how far up the rail a place is, from 0 to 1."""
        if self.is_point:
            return 0.0
        if spot == self.finish:
            return 1.0
        return (self.base[spot[0]] + abs(spot[1] - self.parts[spot[0]][1])) / self.length

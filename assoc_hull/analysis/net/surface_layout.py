"""How the surface through a net is put together: strips and anchors become Coons cells.

A strip lies between two sections, rails aft and forward; anchors, lines along the ship, run across
it from a place on one rail to a place on the other. `lay_out_surface` decides the structure, which
is kept while lines only move; the cells themselves are values of `assoc_hull.geometry`.
`areas_between` gives areas of sections anywhere between two stations.
"""

from __future__ import annotations

import itertools
from bisect import bisect_right
from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import (
    CurveNet,
    CurvePart,
    sections_of,
    segments_of_part,
    station_planes,
)
from assoc_hull.analysis.net.strip_boundaries import (
    StripBoundary,
    UnboundedCurves,
    boundary_arcs,
    closes_end,
    strip_boundaries,
)
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, Strips, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.sections import sections_below
from assoc_hull.geometry.integrals.area_moments import section_area
from assoc_hull.geometry.numeric.generic_sums import common_zeros
from assoc_hull.geometry.numeric.polynomials import hermite
from assoc_hull.geometry.splines.evaluation import derivative, evaluate
from assoc_hull.geometry.splines.paths import Bit, Paths, PathShapes, shape_paths
from assoc_hull.geometry.surfaces.coons import CoonsCells

__all__ = [
    "BROAD_END",
    "NEAR_END",
    "LineSpans",
    "OpenEnd",
    "StripAnchor",
    "SurfaceLayout",
    "areas_between",
    "blend_cubics",
    "lay_out_surface",
    "line_spans",
    "open_ends",
    "parallel_slabs",
    "strip_anchors",
    "strip_extents",
]

BROAD_END, NEAR_END = 0.4, 0.5
"""Where lines end at this part of the greatest half-breadth the hull ends, too; but not where a
station may be missing: farther than this part of a spacing from the end."""

_LEAST_END = 1e-4
"""Parts of the length: where the extent goes on by less, the section is the end."""

# --------------------------------------------------------------------------------------
# The lines that run along a strip: from a place on one rail to a place on the other.

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
"""Places on one curve so near to one another (m, of a short hull less) are one."""

_CORNER = 1e-4
"""A line that ends on a side this near to the rail, in lengths of the rail, ends at its corner.

Three curves of digitised lines that run to one place miss it by the rounding of their points.
"""

CurvePlace = tuple[int, float]
"""A part of a rail by its number, and the parameter (m) on its curve."""


@attrs.frozen
class StripAnchor:
    """A line along a strip.

    Attributes
    ----------
    parts : tuple of CurvePart
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
    span : tuple of (CurvePart, (int, float), (int, float), int)
        The stretch, the curve and parameter (m) that it comes from and goes to, and the place
        of its family.
    steady : tuple of bool
        Along the stretch x only grows, or only falls.
    of : dict of (int, int) to tuple of int
        Which spans run between two curves.
    course : (n, 5, 3), m
        The ends of each stretch and three places between, evenly spaced in x.
    same : float, m
        Places on one curve so near to one another are one.
    """

    span: tuple[tuple[CurvePart, CurvePlace, CurvePlace, int], ...]
    steady: tuple[bool, ...]
    of: dict[tuple[int, int], tuple[int, ...]]
    course: FloatArray
    same: float = _SAME


def line_spans(net: CurveNet) -> LineSpans:
    """Cut all lines along the ship at sections and ends."""
    passed = net.ends_on_transom
    rail = (net.end | np.isfinite(net.x)) & ~passed
    found: list[tuple[CurvePart, CurvePlace, CurvePlace, int]] = []
    marks: dict[int, list[tuple[float, int, float]]] = {}
    for both, place in zip(net.meets.tolist(), net.place.tolist(), strict=True):
        for own, other in ((0, 1), (1, 0)):
            if rail[both[other]] and not (rail[both[own]] or passed[both[own]]):
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
    return LineSpans(tuple(found), runs_monotonic(net, parts), of, _courses(net, parts),
                     net.factor * _SAME)  # fmt: skip


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
    pointed = _pointed(frame, [anchor for _, anchor in found], every.same)
    if pointed is not None:
        frame = pointed
        found = _found(frame, every)
    aft, fore = _rails(frame, every.same)
    keel = StripAnchor(frame.keel, aft.begin, fore.begin, 0.0, 0.0)
    deck = StripAnchor(frame.deck, aft.finish, fore.finish, 1.0, 1.0)
    return frame, _in_order(keel, deck, found)


def _rails(frame: StripBoundary, same: float) -> tuple[_Rail, _Rail]:
    return (
        _Rail.of(frame.aft, frame.keel[:1], frame.deck[:1], 1, same),
        _Rail.of(frame.fore, frame.keel[-1:], frame.deck[-1:], 2, same),
    )


def _found(frame: StripBoundary, every: LineSpans) -> list[tuple[int, StripAnchor]]:
    """Find the stretches of lines from one rail to the other."""
    aft, fore = _rails(frame, every.same)
    found: list[tuple[int, StripAnchor]] = []
    for i in (
        i
        for a in aft.curves
        for f in fore.curves
        for i in every.of.get((min(a, f), max(a, f)), ())
        # A line that sets off almost athwartships, as over the bottom of a flat run, would skew
        # the surface between sections and transoms.
        if every.steady[i] or not frame.across
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


def _pointed(frame: StripBoundary, run: Sequence[StripAnchor], same: float) -> StripBoundary | None:
    """Give the frame with a rail that is a point, if all anchors run to one within `same`, m."""
    if frame.plane or len(run) < 2:
        return None
    if len(frame.fore) == 1 and np.ptp([each.fore[1] for each in run]) <= same:
        (curve, t0, t1), tip = frame.fore[0], run[0].fore[1]
        return attrs.evolve(
            frame,
            fore=((curve, tip, tip),),
            keel=(*frame.keel, (curve, t0, tip)),
            deck=(*frame.deck, (curve, t1, tip)),
        )
    if len(frame.aft) == 1 and np.ptp([each.aft[1] for each in run]) <= same:
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
    same: float
    """Places on one curve so near to one another (m) are one."""

    @classmethod
    def of(
        cls,
        parts: tuple[CurvePart, ...],
        keel: Sequence[CurvePart],
        deck: Sequence[CurvePart],
        end: int,
        same: float,
    ) -> _Rail:
        """Make a rail; `end` says which end of the sides it joins: 1 their begin, 2 their end."""
        sizes = [abs(part[2] - part[1]) for part in parts]
        base = tuple(float(sum(sizes[:i])) for i in range(len(sizes)))
        begin, finish = (0, parts[0][1]), (len(parts) - 1, parts[-1][2])
        corner = [((part[0], part[end]), begin) for part in keel]
        corner += [((part[0], part[end]), finish) for part in deck]
        return cls(parts, base, float(sum(sizes)), tuple(corner), same)

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
            if c == curve and min(t0, t1) - self.same <= t <= max(t0, t1) + self.same:
                return i, min(max(t, min(t0, t1)), max(t0, t1))
        for (c, at), spot in self.corner:
            if c == curve and abs(at - t) <= max(self.same, _CORNER * self.length):
                return spot
        return None

    def height(self, spot: CurvePlace) -> float:
        """Say how far up the rail a place is, from 0 to 1."""
        if self.is_point:
            return 0.0
        if spot == self.finish:
            return 1.0
        return (self.base[spot[0]] + abs(spot[1] - self.parts[spot[0]][1])) / self.length


# --------------------------------------------------------------------------------------
# The parallel body. Lines through stations that are equal, and then are not, swing a little past
# them: by 1 or 2 cm on a ship of 120 m, over one station spacing. The area of the sections would
# swell there beyond that of the largest, which no parallel body does. Where two neighbouring
# sections of a hull with flats are both as large as the largest, the surface runs straight between
# them.

_EQUAL = 1e-4
"""Areas of sections of the parallel body differ by less, in parts of the largest."""


def parallel_slabs(net: CurveNet, x: FloatArray) -> frozenset[int]:
    """Give the slabs between sections of the parallel body; none for a hull without flats.

    Sections stand at x (n,), m, ascending; slab i lies between x[i - 1] and x[i].
    """
    curves = np.flatnonzero(np.isfinite(net.x) & ~net.end)
    if not net.flat.any() or len(x) < 2:
        return frozenset()
    batch = SplineBatch.join([net.batch.part(i, i + 1) for i in curves.tolist()])
    station = np.abs(net.x[curves][:, None] - x).argmin(axis=1)
    top = np.full(len(x), -np.inf)
    np.maximum.at(top, station, np.maximum.reduceat(batch.xyz[:, 2], batch.start[:-1]))
    # Below a common level: sheer must not make equal sections differ.
    level = np.minimum(top[:-1], top[1:])
    found = []
    for slab in _large_slabs(batch, station, level).tolist():
        area = np.bincount(station, section_area(batch, level[slab - 1]), len(x))
        if area[slab - 1 : slab + 1].min() >= (1.0 - _EQUAL) * area.max():
            found.append(slab)
    return frozenset(found)


def _large_slabs(batch: SplineBatch, station: IntArray, level: FloatArray) -> IntArray:
    """Give the slabs of which neither section is less than one large section, below `level` (n,).

    Most are told to be no parallel body by this one, and need not be held against all sections.
    """
    count = len(level) + 1
    whole = np.bincount(station, section_area(batch, float(level.min())), count)
    slab = np.arange(count - 1)
    sections = np.stack([slab, slab + 1, np.full(count - 1, whole.argmax())])
    number, row = np.nonzero(station == sections.T.reshape(-1, 1))
    parts = SplineBatch.join([batch.part(i, i + 1) for i in row.tolist()])
    area = section_area(parts, level.repeat(3)[number])
    one, other, large = np.bincount(number, area, 3 * len(level)).reshape(-1, 3).T
    # Twice the limit: what rounding could turn is left to the comparison with all.
    kept: IntArray = 1 + np.flatnonzero(np.minimum(one, other) >= (1.0 - 2.0 * _EQUAL) * large)
    return kept


# --------------------------------------------------------------------------------------
# Cells from strips and anchors.

_ORDER, _END_ORDER = 4, 6
"""Gauss points along a strip between sections, and along one at an end of the ship, where
lines are steeper."""

_BULB = 0.25
"""A bulb is narrower than this part of the ship."""

_DECK_PLACES = 5
"""Places on a part of the deck edge at which it is looked at."""

_SLIVER = 1e-10
"""Tiles of a smaller part of a cell are not made."""


@attrs.frozen(eq=False)
class SurfaceLayout:
    """How the surface through a net is put together.

    Attributes
    ----------
    cells : CoonsCells
        The cells.
    frames : tuple of StripBoundary
        The strips, in the order of the cells.
    lost : tuple of UnboundedCurves
        What could not be understood.
    edge : (n,) bool
        The upper side of the strip lies off the centre plane: a deck edge.
    cell_start : (n + 1,) int
        Where the cells of each strip begin.
    rails : (c, 2) int
        The paths of each cell along its rails, with v = 0 and 1.
    cell : (t,) int
        The cell of each tile.
    flat, knuckle : (a,) bool
        Anchors that are borders of flats, and knuckles.
    """

    cells: CoonsCells
    frames: tuple[StripBoundary, ...]
    lost: tuple[UnboundedCurves, ...]
    edge: NDArray[np.bool_]
    cell_start: IntArray
    rails: IntArray
    cell: IntArray
    flat: NDArray[np.bool_]
    knuckle: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.edge, self.cell_start, self.rails, self.cell, self.flat, self.knuckle)

    def deck_edge(self, net: CurveNet) -> FloatArray:
        """Give places along the deck edge, (k, 3), m; the top of the hull if it has none.

        The profile and the transom bound strips above as well, and are no deck edge; nor is the
        top of a section that closes on the centre plane below the deck, as that of a bulb does.
        """
        parts = [
            part
            for frame, edge in zip(self.frames, self.edge.tolist(), strict=True)
            if edge
            for part in _top(net, frame)
        ]
        if not parts:
            return net.batch.xyz[[int(net.batch.xyz[:, 2].argmax())]]
        curve = np.array([part[0] for part in parts]).repeat(_DECK_PLACES)
        t = np.concatenate([np.linspace(part[1], part[2], _DECK_PLACES) for part in parts])
        found: FloatArray = evaluate(net.batch, curve, t)
        return found


@attrs.define(eq=False)
class _Draft:
    """Cells in the making: lists that grow strip by strip."""

    net: CurveNet
    paths: list[list[Bit]] = attrs.field(factory=list)
    anchor_start: list[int] = attrs.field(factory=lambda: [0])
    anchor: list[int] = attrs.field(factory=list)
    blend: list[FloatArray] = attrs.field(factory=list)
    flat: list[bool] = attrs.field(factory=list)
    knuckle: list[bool] = attrs.field(factory=list)
    cell: list[tuple[int, int, int]] = attrs.field(factory=list)
    cell_start: list[int] = attrs.field(factory=lambda: [0])

    def add(self, parts: Sequence[CurvePart]) -> int:
        """Add a path; give its number."""
        self.paths.append([bit for part in parts for bit in segments_of_part(self.net, part)])
        return len(self.paths) - 1


def lay_out_surface(net: CurveNet, length: float, closed: bool) -> SurfaceLayout:
    """Find the strips and cells of a net of a ship of `length` m; `closed`: it has a deck."""
    x = station_planes(net)
    found, lost = strip_boundaries(net, boundary_arcs(net, x), len(x), length)
    every = line_spans(net)
    parallel = parallel_slabs(net, x)
    draft = _Draft(net)
    for i, given in enumerate(found):
        # The strip comes back changed where all lines run to one point of a rail.
        found[i], run = strip_anchors(given, every)
        if given.plane and given.slab in parallel:
            # Straight: no anchors but keel and deck, and these without curves of their own.
            run = [attrs.evolve(each, parts=()) for each in (run[0], run[-1])]
        for anchor in run:
            # -1: nothing is drawn there, so it is straight from rail to rail.
            draft.anchor.append(draft.add(anchor.parts) if anchor.parts else -1)
        flat = [_side(net, each, net.flat) for each in run]
        knuckle = [_side(net, each, net.knuckle) for each in run]
        draft.flat += flat
        draft.knuckle += knuckle
        # An anchor may pass the two rails at different parts of their height.
        height = np.array([0.5 * (each.low + each.high) for each in run])
        first, blend = blend_cubics(height, flat, knuckle)
        for j, (below, above) in enumerate(itertools.pairwise(run)):
            aft = draft.add(_between(found[i].aft, below.aft, above.aft))
            fore = draft.add(_between(found[i].fore, below.fore, above.fore))
            draft.cell.append((int(first[j]), aft, fore))
            draft.blend.append(blend[j])
        draft.anchor_start.append(len(draft.anchor))
        draft.cell_start.append(len(draft.cell))
    paths = Paths.of(draft.paths)
    edge = np.array([_is_edge(net, frame, found) for frame in found], np.bool_)
    # An open ship has a deck edge too, but no deck to be closed by.
    cells, cell = _cells(net, draft, found, shape_paths(paths, net.batch), edge & closed)
    rails = np.array([each[1:] for each in draft.cell], np.int64).reshape(-1, 2)
    start = np.array(draft.cell_start, np.int64)
    sides = np.array(draft.flat, np.bool_), np.array(draft.knuckle, np.bool_)
    return SurfaceLayout(cells, tuple(found), tuple(lost), edge, start, rails, cell, *sides)


def _top(net: CurveNet, frame: StripBoundary) -> list[CurvePart]:
    """Give the deck edge at the upper side of a strip: what is drawn, or the ends of its rails.

    Of rails, one that ends in the centre plane counts as a stem head if it reaches as high as the
    other; lower, it is the top of a bulb, or the foot of a transom that is not drawn.
    """
    if frame.deck:
        return [part for part in frame.deck if not closes_end(net, part[0])]
    ends = [(rail[-1][0], rail[-1][2], rail[-1][2]) for rail in (frame.aft, frame.fore)]
    place = _tops(net, frame)
    aside = np.abs(place[:, 1]) > net.on_centre
    level = float(place[aside, 2].min())
    high = (aside | (place[:, 2] >= level)).tolist()
    return [end for end, keep in zip(ends, high, strict=True) if keep]


def _side(net: CurveNet, anchor: StripAnchor, which: NDArray[np.bool_]) -> bool:
    """Tell whether an anchor runs along curves of a kind."""
    return any(which[part[0]] for part in anchor.parts)


def blend_cubics(
    height: FloatArray,
    flat: Sequence[bool] | NDArray[np.bool_] = (),
    knuckle: Sequence[bool] | NDArray[np.bool_] = (),
) -> tuple[IntArray, FloatArray]:
    """Give how the cells of a strip carry on between anchors at ascending heights (a,), as cubics.

    Each cubic has the values of the two anchors at its ends, and there the slopes of the parabolas
    through three neighbouring anchors. At the border of a flat, to which the hull is tangent, the
    slope is zero; at a knuckle each side has its own, that of the straight line. `first` (a - 1,)
    is the first of the four anchors that have weight in a cell, `cubic` (a - 1, 4, 4) the weights:
    ``sum_j cubic[:, i, j] value[first + j]`` is the coefficient of f^i.
    """
    count = len(height)
    slope = _slopes(height)
    slope[np.flatnonzero(flat)] = 0.0
    first = np.clip(np.arange(count - 1) - 1, 0, max(count - 4, 0))
    column = first[:, None] + np.arange(4)
    inside = column < count
    column = np.minimum(column, count - 1)
    cell = np.arange(count - 1)
    one = np.eye(count)
    below, above = (one[(cell + k)[:, None], column] * inside for k in (0, 1))
    width = np.diff(height)[:, None]
    leave, arrive = (slope[(cell + k)[:, None], column] * width * inside for k in (0, 1))
    step = above - below
    sharp = np.zeros(count, np.bool_)
    sharp[np.flatnonzero(knuckle)] = True
    leave = np.where(sharp[:-1, None], step, leave)
    arrive = np.where(sharp[1:, None], step, arrive)
    return first, np.stack(hermite(below, above, leave, arrive), axis=1)


def _slopes(height: FloatArray) -> FloatArray:
    """Give the weights (a, a) by which slopes at anchors follow from values there."""
    count = len(height)
    if count == 2:
        both: FloatArray = np.array([[-1.0, 1.0], [-1.0, 1.0]]) / (height[1] - height[0])
        return both
    found: FloatArray = common_zeros((count, count), height)
    at = np.arange(count)
    three = np.clip(at, 1, count - 2)[:, None] + np.array([-1, 0, 1])
    p = height[three]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        weight = (2.0 * height - p[:, j] - p[:, k]) / ((p[:, i] - p[:, j]) * (p[:, i] - p[:, k]))
        found[at, three[:, i]] = weight
    return found


def _between(rail: tuple[CurvePart, ...], low: CurvePlace, high: CurvePlace) -> list[CurvePart]:
    """Give the parts of a rail between two points on it."""
    if low[0] == high[0]:
        return [(rail[low[0]][0], low[1], high[1])]
    first, last = rail[low[0]], rail[high[0]]
    parts = [
        (first[0], low[1], first[2]),
        *rail[low[0] + 1 : high[0]],
        (last[0], last[1], high[1]),
    ]
    return [part for part in parts if part[1] != part[2]] or parts[:1]


def _cells(
    net: CurveNet,
    draft: _Draft,
    found: list[StripBoundary],
    walked: PathShapes,
    deck: NDArray[np.bool_],
) -> tuple[CoonsCells, IntArray]:
    """Cut the cells into tiles; also give the cell of each tile."""
    tiles: list[tuple[int, int, int, int, int]] = []
    tile_start, cell = [0], list[int]()
    # Lists: they are read place by place.
    start, begin = walked.paths.start.tolist(), walked.begin.tolist()
    for i in range(len(found)):
        for j in range(draft.cell_start[i], draft.cell_start[i + 1]):
            first, aft, fore = draft.cell[j]
            tiles += [(first, *tile) for tile in _tiles(start, begin, aft, fore)]
            cell += [j] * (len(tiles) - len(cell))
        if deck[i]:
            # The deck is one more tile above the last: -2 says so.
            tiles.append((*tiles[-1][:3], -2, -1))
            cell.append(cell[-1])
        tile_start.append(len(tiles))
    table = np.array(tiles, np.int64).reshape(-1, 5)
    anchor_start = np.array(draft.anchor_start, np.int64)
    anchor = np.array(draft.anchor, np.int64)
    plane = np.array(
        [frame.plane and all(runs_monotonic(net, frame.keel + frame.deck)) for frame in found],
        np.bool_,
    )
    column = [table[:, i].copy() for i in range(5)]
    cells = CoonsCells(
        walked.paths,
        anchor_start,
        anchor,
        np.array(tile_start, np.int64),
        column[0],
        np.array(draft.blend, np.float64).reshape(-1, 4, 4)[cell],
        column[1],
        column[2],
        column[3],
        column[4],
        plane,
        column[3] == -2,
        np.where(plane, _ORDER, _END_ORDER).astype(np.int64),
    )
    return cells, np.array(cell, np.int64)


def _tiles(
    start: list[int], begin: list[float], aft: int, fore: int
) -> list[tuple[int, int, int, int]]:
    """Cut a cell at the knots of both rails: bits aft and fore, and what begins and ends it.

    `start` and `begin` say where the bits of each path begin, in all bits and along the path.
    """
    knots = [(0.0, -1)]
    for path in (aft, fore):
        knots += [(begin[bit], bit) for bit in range(start[path] + 1, start[path + 1])]
    knots.sort()
    kept = knots[:1]
    for knot in knots[1:]:
        if knot[0] - kept[-1][0] > _SLIVER and knot[0] < 1.0 - _SLIVER:
            kept.append(knot)
    tiles = []
    for i, (low, bit) in enumerate(kept):
        high, end = kept[i + 1] if i + 1 < len(kept) else (1.0, -1)
        middle = 0.5 * (low + high)
        one, other = (
            bisect_right(begin, middle, start[path], start[path + 1]) - 1 for path in (aft, fore)
        )
        tiles.append((one, other, bit, end))
    return tiles


def _is_edge(net: CurveNet, frame: StripBoundary, every: Sequence[StripBoundary]) -> bool:
    """Tell whether the upper side of a strip is a deck edge, not the centre plane.

    Where no side is drawn only the uppermost strip of a slab has one: below it lie a bulb or a
    bossing that nothing closes.
    """
    if frame.deck:
        return not all(closes_end(net, part[0]) for part in frame.deck)
    place = _tops(net, frame)
    if float(np.abs(place[:, 1]).max()) <= net.on_centre or _is_bulb(net, frame, place, every):
        return False
    others = [_tops(net, each) for each in every if each.slab == frame.slab]
    return float(place[:, 2].max()) >= max(float(each[:, 2].max()) for each in others)


def _is_bulb(
    net: CurveNet, frame: StripBoundary, place: FloatArray, every: Sequence[StripBoundary]
) -> bool:
    """Tell whether a strip that nothing is drawn over is a bulb or a bossing beyond the deck's end.

    It is narrow, lies ahead or abaft of all that has a deck edge drawn, and is lower than that. A
    table has no line that closes it.
    """
    decks = [each for each in every if each.deck and not closes_end(net, each.deck[0][0])]
    if not decks:
        return False
    beyond = not min(each.slab for each in decks) <= frame.slab <= max(each.slab for each in decks)
    low = min(float(_tops(net, each)[:, 2].min()) for each in decks)
    half = float(np.abs(net.batch.xyz[:, 1]).max())
    narrow = float(np.abs(place[:, 1]).max()) <= _BULB * half
    return beyond and narrow and float(place[:, 2].max()) < low


def _tops(net: CurveNet, frame: StripBoundary) -> FloatArray:
    """Give the upper ends of the rails of a strip, (2, 3), m."""
    parts = [rail[-1] for rail in (frame.aft, frame.fore)]
    curve = np.array([part[0] for part in parts])
    found: FloatArray = evaluate(net.batch, curve, np.array([part[2] for part in parts]))
    return found


# --------------------------------------------------------------------------------------
# Sections between two stations, as the surface through a net has them.


def areas_between(
    layout: SurfaceLayout,
    strips: Strips,
    station: FloatArray,
    x: FloatArray,
    planes: FloatingPlanes,
) -> FloatArray | None:
    """Give the areas (d, n), m2, both sides, of sections at x (n,), m, between two stations.

    Stations are at `station` (k,), m, ascending. None beyond the last ones, and where a strip
    begins or ends at a raked line between the two, so that no curve of it is transverse.
    """
    slab = int(np.searchsorted(station, x[0]))
    strip = np.array([i for i, each in enumerate(layout.frames) if each.slab == slab], np.int64)
    if not (0 < slab < len(station) and len(strip) and layout.cells.plane[strip].all()):
        return None
    reach = strip_extents(strips, strip)
    v = (x[:, None] - reach[:, 0]) / (reach[:, 1] - reach[:, 0])
    place, which = np.nonzero((v >= 0.0) & (v <= 1.0))
    total = np.zeros((len(planes.height), len(x)))
    if len(place):
        curves = strips.curves(strip[which], v[place, which])
        np.add.at(total.T, place, sections_below(curves, planes).T)
    return total


def strip_extents(strips: Strips, strip: IntArray) -> FloatArray:
    """Give x (k, 2), m, of both ends of transverse strips: some end between two stations."""
    curves = strips.curves(np.repeat(strip, 2), np.tile([0.0, 1.0], len(strip)))
    found: FloatArray = curves.point[curves.start[:-1], 0, 0].reshape(-1, 2)
    return found


# --------------------------------------------------------------------------------------
# Ends that no line closes: a hull given by sections alone has neither profile nor transom.


@attrs.frozen
class OpenEnd:
    """An end that no line closes.

    Attributes
    ----------
    fore : bool
        It is the forward one.
    name : str
        The section beyond which nothing is drawn.
    x, end : float, m
        Where it stands, and where the hull is taken to end.
    source : str
        Whence that is known.
    """

    fore: bool
    name: str
    x: float
    end: float
    source: str

    def __str__(self) -> str:
        return (
            f"no line closes the hull beyond {self.name} (x {self.x:.2f} m): closed by straight "
            f"lines to x {self.end:.2f} m, {self.source}; what that adds is in the errors, too"
        )


def open_ends(net: CurveNet, layout: SurfaceLayout, length: float) -> tuple[OpenEnd, ...]:
    """Find the ends that no line closes; `length` between perpendiculars, m."""
    found = sections_of(net, closed=False)
    # Slabs are counted between these: parts of sections that end on a raked transom are none.
    stations = station_planes(net)
    slabs = {frame.slab for frame in layout.frames}
    every = net.batch.xyz[_tells_extent(net), 0]
    ends = []
    for fore in (False, True):
        x = float(stations[-1 if fore else 0])
        at = int(np.abs(found.x - x).argmin())
        drawn = float(every.max() if fore else every.min())
        sign = 1.0 if fore else -1.0
        by_lines = sign * drawn > sign * (length if fore else 0.0)
        end = drawn if by_lines else (length if fore else 0.0)
        covered = net.end & np.isfinite(net.x) & (sign * net.x >= sign * x - net.on_plane)
        closed = (len(stations) if fore else 0) in slabs or covered.any()
        if closed or sign * (end - x) <= _LEAST_END * length:
            continue
        spacing = abs(float(np.diff(stations[-2:] if fore else stations[:2])[0]))
        if sign * (end - x) < NEAR_END * spacing and _is_transom(net, x):
            continue
        source = "where its lines end" if by_lines else "the perpendicular"
        ends.append(OpenEnd(fore, found.names[at], x, end, source))
    return tuple(ends)


def _is_transom(net: CurveNet, x: float) -> bool:
    """Tell whether lines along the ship end broad at its last section: it is a transom.

    Sections alone do not tell: there the hull goes on to the perpendicular.
    """
    last = net.batch.start[1:] - 1
    ends = net.batch.xyz[np.concatenate([net.batch.start[:-1], last])]
    along = np.tile(np.isin(net.family, ("waterlines", "buttocks")), 2)
    here = along & (np.abs(ends[:, 0] - x) <= net.on_plane)
    widest = float(np.abs(net.batch.xyz[:, 1]).max())
    return bool(here.any() and float(np.abs(ends[here, 1]).max()) >= BROAD_END * widest)


def _tells_extent(net: CurveNet) -> NDArray[np.bool_]:
    """Tell which points of the lines say how far the hull reaches.

    A knuckle traced through sections is carried a little beyond the last of them, to cross it:
    only where it ends in the centre plane does the hull end there.
    """
    traced = np.repeat(net.knuckle, np.diff(net.batch.start))
    told: NDArray[np.bool_] = ~traced | (np.abs(net.batch.xyz[:, 1]) <= net.on_centre)
    return told

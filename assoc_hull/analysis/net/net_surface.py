"""The surface through a net: laid out, kept on the same lines, or put on lines that have moved.

The layout of a surface whose lines have moved: the same cells, where the lines are now.

Which lines bound which cell stays. Where a line ends between the knots of another, the place
moves with the point in which they cross; how cells carry on between their anchors depends on
how far up the rails these lie. Both are computed in the arithmetic of the moved lines.

A layout that is kept while its lines become others: whence all its places on lines come.

A place at which a bit of a path begins is a knot, or lies inside a segment where another line
crosses. So it is known of other lines of the same structure, too, from the places of their
crossings: nothing is searched, and what is made is what a new layout of these lines would make, to
the bit, as long as that decides the same.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, overload

import attrs
import numpy as np

from assoc_hull.analysis.net.curve_net import SNAP, CurveNet, CurvePart
from assoc_hull.analysis.net.strip_boundaries import StripBoundary, closes_end
from assoc_hull.analysis.net.surface_layout import (
    DECK_PLACES,
    SLIVER,
    AnchorRuns,
    SurfaceLayout,
    blend_cubics,
    cut_cells,
)
from assoc_hull.geometry.curves import (
    FloatArray,
    IntArray,
    SplineBatch,
    Strips,
    freeze,
)
from assoc_hull.geometry.numeric.dual import common_zeros, real
from assoc_hull.geometry.splines.paths import (
    Paths,
    PathShapes,
    bit_lengths,
    shape_paths,
)
from assoc_hull.geometry.splines.segments import (
    evaluate,
    last_not_above,
    locate_parameters,
    power_coefficients,
    segment_curve,
    segment_start,
)
from assoc_hull.geometry.surfaces.coons import CoonsCells, CoonsStrips
from assoc_hull.model.program.engine import is_compiled

if TYPE_CHECKING:
    from assoc_hull.geometry.floating.compiled_immersion import SurfaceRows
    from assoc_hull.geometry.surfaces.compiled_cells import CellStructure, PutCells

__all__ = ["KeptLayout", "KnownPlaces", "NetSurface", "evaluate_cubics", "move_cells"]

_INSIDE = 1e-12
"""An end of a bit that is not so near to a knot, in parts of the segment, lies inside."""

_SAME = 1e-7
"""A crossing is at a place if it is so near, m along the curve, of a short hull less."""

_STEPS = 3
"""Towards the point on a curve that is nearest: points hardly leave their curves."""


def move_cells(
    layout: SurfaceLayout, net: CurveNet, batch: SplineBatch, points: FloatArray
) -> CoonsCells:
    """Put the cells of a net on its lines as they have become.

    Parameters
    ----------
    layout : SurfaceLayout
        Of the net.
    net : CurveNet
        The lines in plain numbers.
    batch : SplineBatch
        The lines as they have become, in any arithmetic.
    points : (n, 3), m
        Places of all points of the tables, in the same arithmetic.
    """
    paths = _moved(layout.cells.paths, net, batch, points)
    length = np.add.reduceat(bit_lengths(paths, batch), paths.start[:-1])
    height = []
    for begin, end in itertools.pairwise(layout.cell_start.tolist()):
        aft, fore = (_heights(length[layout.rails[begin:end, i]]) for i in (0, 1))
        either = [each for each in (aft, fore) if each is not None]
        height.append(0.5 * (either[0] + either[-1]))
    start = layout.cells.anchor_start
    blend = blend_cubics(np.concatenate(height), layout.flat, layout.knuckle, start)[1]
    return attrs.evolve(layout.cells, paths=paths, blend=blend[layout.cell])


def _heights(length: FloatArray) -> FloatArray | None:
    """Give how far up a rail its cells begin and end, from 0 to 1; None if it is a point."""
    up = np.concatenate([np.zeros(1), np.cumsum(length)])
    return None if real(up)[-1] == 0.0 else up / up[-1]


def _moved(paths: Paths, net: CurveNet, batch: SplineBatch, points: FloatArray) -> Paths:
    """Move the ends of bits that lie inside segments, with the crossings there."""
    bits = len(paths.segment)
    end = np.concatenate([paths.low, paths.high])
    inside = np.flatnonzero((end > _INSIDE) & (end < 1.0 - _INSIDE))
    segment = paths.segment[inside % bits]
    crossing, side = _crossings(net, segment, end[inside])
    # Where no crossing is known the place stays.
    inside, segment, side = (each[crossing >= 0] for each in (inside, segment, side))
    crossing = crossing[crossing >= 0]
    if not len(inside):
        return paths
    target, normal = _targets(net, batch, points, crossing, side)
    u = _nearest(power_coefficients(batch)[segment], target, normal, end[inside])
    moved = common_zeros((2 * bits,), u) + end
    moved[inside] = u
    return attrs.evolve(paths, low=moved[:bits], high=moved[bits:])


def _crossings(net: CurveNet, segment: IntArray, u: FloatArray) -> tuple[IntArray, IntArray]:
    """Give the crossings at places of segments, and on which side; -1 where there is none."""
    first = segment_start(net.batch)[segment]
    t = net.batch.knot[first] + u * (net.batch.knot[first + 1] - net.batch.knot[first])
    own = segment_curve(net.batch)[segment]
    curve, place = net.meets.T.ravel(), net.place.T.ravel()
    order = np.lexsort((place, curve))
    curve, place = curve[order], place[order]
    begin, end = np.searchsorted(curve, own), np.searchsorted(curve, own, "right")
    # Places of one curve lie between its number and the next: one search for all.
    scale = 1.0 + max(place.max(initial=0.0), t.max(initial=0.0))
    near = np.searchsorted(curve + place / scale, own + t / scale)
    found = np.full(len(own), -1)
    for at in (near - 1, near):
        good = (at >= begin) & (at < end)
        good[good] &= np.abs(place[at[good]] - t[good]) <= net.factor * _SAME
        found[good] = order[at[good]]
    count = len(net.meets)
    return np.where(found < 0, -1, found % max(count, 1)), found // max(count, 1)


def _targets(
    net: CurveNet, batch: SplineBatch, points: FloatArray, crossing: IntArray, side: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Give what places of crossings keep to: points, and normals of planes through them.

    A defining crossing is a point of both lines. A watched one lies on each line in the plane
    of the other; there the normal is given, which is nan for the others.
    """
    other = net.meets[crossing, 1 - side]
    segment, u = locate_parameters(net.batch, other, net.place[crossing, 1 - side])
    watched = net.watched[crossing]
    beside = evaluate_cubics(power_coefficients(batch)[segment], u)[0]
    target = np.where(watched[:, None], beside, points[net.row[crossing]])
    return target, np.where(watched[:, None], net.normal[other], np.nan)


def _nearest(cubic: FloatArray, point: FloatArray, normal: FloatArray, u: FloatArray) -> FloatArray:
    """Give where cubics (k, 4, 3) meet planes through points (k, 3), from places nearby.

    Where there is no normal: where they come nearest to the points.
    """
    for _ in range(_STEPS):
        place, slope = evaluate_cubics(cubic, u)
        across = np.where(np.isnan(normal), slope, normal)
        u = u + ((point - place) * across).sum(axis=1) / (slope * across).sum(axis=1)
    return u


def evaluate_cubics(cubic: FloatArray, u: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give places and slopes of cubics (k, 4, 3) at one u each, (k, 3); in any arithmetic."""
    w = u[:, None]
    place = ((cubic[:, 3] * w + cubic[:, 2]) * w + cubic[:, 1]) * w + cubic[:, 0]
    return place, (3.0 * cubic[:, 3] * w + 2.0 * cubic[:, 2]) * w + cubic[:, 1]


@attrs.frozen(eq=False)
class KnownPlaces:
    """Places on curves, (k,): at parts of segments, or where other lines cross.

    Attributes
    ----------
    knot : (k,) int
        Where the segment of each begins.
    part : (k,)
        Where on it it lies, from 0 to 1,
    crossing : (k,) int
        or which of all places of crossings it is; -1 for none.
    """

    knot: IntArray
    part: FloatArray
    crossing: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.knot, self.part, self.crossing)

    @classmethod
    def of(cls, net: CurveNet, curve: IntArray, knot: IntArray, part: FloatArray) -> KnownPlaces:
        """Find crossings at parts of segments of curves, (k,) each; none is needed at a knot."""
        t = net.batch.knot[knot] + part * (net.batch.knot[knot + 1] - net.batch.knot[knot])
        crossing = np.full(len(t), -1, np.int64)
        inside = np.flatnonzero((part != 0.0) & (part != 1.0))
        crossing[inside] = _crossing_at(net, curve[inside], t[inside])
        return cls(knot, part, crossing)

    @classmethod
    def at(cls, net: CurveNet, curve: IntArray, t: FloatArray) -> KnownPlaces:
        """Find whence parameters t (k,), m, of curves come."""
        first, last = net.batch.start[curve], net.batch.start[curve + 1] - 2
        knot, at = last_not_above(net.batch.knot, first, last, t), net.batch.knot
        begin, end = at[knot], at[knot + 1]
        return cls.of(net, curve, knot, np.where(t == end, 1.0, (t - begin) / (end - begin)))

    def parts(self, net: CurveNet) -> FloatArray | None:
        """Give parts of segments of other lines, (k,); None where one has left its segment."""
        some = np.flatnonzero(self.crossing >= 0)
        begin, found = self.knot[some], self.part.copy()
        first, t = net.batch.knot[begin], net.place.ravel()[self.crossing[some]]
        found[some] = (t - first) / (net.batch.knot[begin + 1] - first)
        return found if ((found >= 0.0) & (found <= 1.0)).all() else None

    def parameters(self, net: CurveNet) -> FloatArray:
        """Give places on other lines, (k,), m."""
        first, last = net.batch.knot[self.knot], net.batch.knot[self.knot + 1]
        known = net.place.ravel()[self.crossing]
        found = np.where(self.part == 1.0, last, first + self.part * (last - first))
        return np.where(self.crossing >= 0, known, found)


def _crossing_at(net: CurveNet, own: IntArray, t: FloatArray) -> IntArray:
    """Give the crossing at places t (k,), m, of curves, as one of all places; -1 for none.

    Of several the nearest counts: so a place is the crossing that it comes from, to the bit.
    """
    curve, place = net.meets.ravel(), net.place.ravel()
    order = np.lexsort((place, curve))
    curve, place = curve[order], place[order]
    begin, end = np.searchsorted(curve, own), np.searchsorted(curve, own, "right")
    found, least = np.full(len(own), -1, np.int64), np.full(len(own), net.factor * _SAME)
    if not len(place):
        return found
    first = np.minimum(begin, len(place) - 1)
    near = last_not_above(place, first, np.maximum(end - 1, first), t)
    for step in (-1, 0, 1):
        at = near + step
        good = (at >= begin) & (at < end)
        at = np.where(good, at, 0)
        away = np.where(good, np.abs(place[at] - t), np.inf)
        better = away <= least
        found, least = np.where(better, order[at], found), np.where(better, away, least)
    return found


def crossings_at_knots(net: CurveNet) -> IntArray:
    """Give the knot at which each crossing lies on either line, (2 k,); -1 for those at none."""
    curve, place, knot = net.meets.ravel(), net.place.ravel(), net.batch.knot
    if not len(curve):
        return curve
    first, last = net.batch.start[curve], net.batch.start[curve + 1] - 1
    below = last_not_above(knot, first, last, place)
    above = np.minimum(below + 1, last)
    near = net.factor * SNAP
    found = np.where(np.abs(knot[above] - place) <= near, above, -1)
    return np.where(np.abs(knot[below] - place) <= near, below, found)


@attrs.frozen(eq=False)
class _MovedFrames(Sequence[StripBoundary]):
    """Strips on other lines; made when one is asked for."""

    was: Sequence[StripBoundary]
    known: KnownPlaces
    net: CurveNet

    @cached_property
    def _made(self) -> tuple[StripBoundary, ...]:
        ends = iter(self.known.parameters(self.net).reshape(-1, 2).tolist())
        found = []
        for each in self.was:
            aft, fore, keel, deck = (
                tuple(_between(part[0], *next(ends)) for part in side) for side in _sides(each)
            )
            found.append(attrs.evolve(each, aft=aft, fore=fore, keel=keel, deck=deck))
        return tuple(found)

    def __len__(self) -> int:
        return len(self.was)

    @overload
    def __getitem__(self, place: int) -> StripBoundary: ...

    @overload
    def __getitem__(self, place: slice) -> Sequence[StripBoundary]: ...

    def __getitem__(self, place: int | slice) -> StripBoundary | Sequence[StripBoundary]:
        return self._made[place]

    def __iter__(self) -> Iterator[StripBoundary]:
        return iter(self._made)


def _between(curve: int, low: float, high: float) -> CurvePart:
    return curve, low, high


def _sides(frame: StripBoundary) -> tuple[tuple[CurvePart, ...], ...]:
    return frame.aft, frame.fore, frame.keel, frame.deck


@attrs.frozen(eq=False)
class KeptLayout:
    """A layout, ready to be put on other lines of the same structure.

    Attributes
    ----------
    layout : SurfaceLayout
        As it was laid out.
    net : CurveNet
        Through these lines.
    runs : AnchorRuns
        What of it does not depend on where lines are.
    ends : KnownPlaces
        Where bits of its paths begin, then where they end.
    """

    layout: SurfaceLayout
    net: CurveNet
    runs: AnchorRuns
    ends: KnownPlaces

    @classmethod
    def of(cls, layout: SurfaceLayout, net: CurveNet, closed: bool) -> KeptLayout:
        """Find whence the places of a layout come."""
        cells, paths = layout.cells, layout.cells.paths
        knot = np.tile(segment_start(net.batch)[paths.segment], 2)
        curve = np.tile(segment_curve(net.batch)[paths.segment], 2)
        ends = KnownPlaces.of(net, curve, knot, np.concatenate([paths.low, paths.high]))
        runs = AnchorRuns(
            cells.anchor_start, cells.anchor, layout.cell_start, layout.rails, layout.flat,
            layout.knuckle, layout.edge & closed, cells.plane,
        )  # fmt: skip
        return cls(layout, net, runs, ends)

    @cached_property
    def structure(self) -> CellStructure:
        """What of its cells does not depend on where lines are, for compiled code."""
        from assoc_hull.geometry.surfaces.compiled_cells import CellStructure

        cells, runs = self.layout.cells, self.runs
        both = 2, len(cells.paths.segment)
        return CellStructure(
            cells, self.ends.knot[: both[1]], self.ends.crossing.reshape(both),
            self.ends.part.reshape(both), runs.cell_start, runs.rails, runs.flat, runs.knuckle,
            runs.deck, SLIVER,
        )  # fmt: skip

    @cached_property
    def frames(self) -> KnownPlaces:
        """Whence the ends of all parts of sides and rails of its strips come."""
        parts = [part for each in self.layout.frames for side in _sides(each) for part in side]
        curve = np.array([part[0] for part in parts], np.int64).repeat(2)
        return KnownPlaces.at(self.net, curve, np.array([part[1:] for part in parts]).ravel())

    @cached_property
    def _deck(self) -> tuple[IntArray, KnownPlaces] | None:
        """The curves of the deck edge, and whence the ends of their parts come, (p,) and (2 p,).

        None where the ends of rails are a part of it: which of them, numbers tell.
        """
        frames = self.layout.frames
        edges = [frames[k] for k in np.flatnonzero(self.layout.edge).tolist()]
        if not edges or not all(frame.deck for frame in edges):
            return None
        parts = [p for frame in edges for p in frame.deck if not closes_end(self.net, p[0])]
        curve = np.array([part[0] for part in parts], np.int64)
        t = np.array([part[1:] for part in parts], np.float64).ravel()
        return (curve, KnownPlaces.at(self.net, curve.repeat(2), t)) if parts else None

    def deck_edge(self, net: CurveNet) -> FloatArray | None:
        """Give places along the deck edge on other lines, (k, 3), m; None: ask the layout."""
        if self._deck is None:
            return None
        curve, known = self._deck
        low, high = known.parameters(net).reshape(-1, 2).T[..., None]
        t = np.arange(DECK_PLACES) * ((high - low) / (DECK_PLACES - 1)) + low
        t[:, -1:] = high
        return evaluate(net.batch, curve.repeat(DECK_PLACES), t.ravel())

    def laid(self, net: CurveNet) -> tuple[SurfaceLayout, PathShapes] | None:
        """Put it on other lines; None where it does not fit these.

        So it is where a crossing has passed a point of its line, or lines across the ship one
        another. Also gives its paths.
        """
        if not self.fits(net):
            return None
        part = self.ends.parts(net)
        if part is None:
            return None
        paths, count = self.layout.cells.paths, len(self.layout.cells.paths.segment)
        paths = attrs.evolve(paths, low=part[:count], high=part[count:])
        walked = shape_paths(paths, net.batch)
        cells, cell = cut_cells(walked, net.batch, self.runs)
        frames = self.moved_frames(net)
        return attrs.evolve(self.layout, cells=cells, cell=cell, frames=frames), walked

    def moved_frames(self, net: CurveNet) -> Sequence[StripBoundary]:
        """Give its strips on other lines; they are made when one is asked for."""
        return _MovedFrames(self.layout.frames, self.frames, net)

    def fits(self, net: CurveNet) -> bool:
        """Tell whether lines stand in the same order along the ship, and end where they did.

        And cross at points of theirs, or between these, as they did: that is where bits begin.
        """
        was = self.net
        return (
            np.array_equal(net.batch.start, was.batch.start)
            and np.array_equal(np.isnan(net.x), np.isnan(was.x))
            and np.array_equal(np.sign(np.diff(net.x[self._order])), self._steps)
            and np.array_equal(net.transom, was.transom)
            and np.array_equal(net.ends_on_transom, was.ends_on_transom)
            and np.array_equal(crossings_at_knots(net), self._at_knots)
        )

    @cached_property
    def _at_knots(self) -> IntArray:
        """At which knot of its line each crossing lies."""
        return crossings_at_knots(self.net)

    @cached_property
    def _order(self) -> IntArray:
        """Lines in planes across the ship, from aft forward."""
        across = np.flatnonzero(np.isfinite(self.net.x))
        return across[np.argsort(self.net.x[across], kind="stable")]

    @cached_property
    def _steps(self) -> FloatArray:
        """Which of them stand before the next, and which at the same place."""
        return np.sign(np.diff(self.net.x[self._order]))


@attrs.frozen(eq=False)
class NetSurface:
    """A surface; arrays that compiled code has made are brought into other forms when one asks.

    Attributes
    ----------
    known : SurfaceLayout
        Its layout; what it was before it was put on other lines, if `put` says how.
    given : Strips or None
        The surface itself.
    put : (PutCells, KeptLayout, CurveNet) or None
        Its cells on other lines; and what tells where its strips are there.
    """

    known: SurfaceLayout
    given: Strips | None
    put: tuple[PutCells, KeptLayout, CurveNet] | None = None

    @classmethod
    def on_lines(cls, kept: KeptLayout, net: CurveNet) -> NetSurface | None:
        """Put a layout on lines; None where it does not fit. Compiled or not, the bits agree."""
        if not is_compiled():
            found = kept.laid(net)
            if found is None:
                return None
            layout, walked = found
            return cls(layout, CoonsStrips.on(layout.cells, net.batch, walked))
        from assoc_hull.geometry.surfaces.compiled_cells import put_cells

        cells = put_cells(kept.structure, net.batch, net.place) if kept.fits(net) else None
        return None if cells is None else cls(kept.layout, None, (cells, kept, net))

    @cached_property
    def layout(self) -> SurfaceLayout:
        """Which lines bound which cell."""
        if self.put is None:
            return self.known
        cells, kept, net = self.put
        return attrs.evolve(
            self.known, cells=cells.cells, cell=cells.cell.copy(), frames=kept.moved_frames(net)
        )

    @cached_property
    def strips(self) -> Strips:
        """The surface as strips."""
        if self.given is not None:
            return self.given
        assert self.put is not None
        return self.put[0].strips

    def deck_edge(self, net: CurveNet) -> FloatArray:
        """Give places along the deck edge, as `SurfaceLayout.deck_edge`."""
        found = self.put[1].deck_edge(net) if self.put is not None else None
        return self.layout.deck_edge(net) if found is None else found

    @cached_property
    def rows(self) -> SurfaceRows | None:
        """The surface as compiled code takes it; None if there is more to it than cells."""
        from assoc_hull.geometry.floating.compiled_immersion import SurfaceRows

        if self.given is None and self.put is not None:
            return SurfaceRows.put(self.put[0])
        return SurfaceRows.of(self.given) if isinstance(self.given, CoonsStrips) else None

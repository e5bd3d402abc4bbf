"""The lines of a hull as plain arrays: curves, crossings, sections, and the net with fewer lines.

`gather_net` takes live curves and crossings from the tables; all else here reads its `CurveNet`,
one of m curves, port side, ship axes, m. Sections are those drawn, as curves that planes can cut,
not those of the surface through the lines. `thinned_net` leaves lines out: what the numbers of such
a net differ by shows how far they are off.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    IsoCurves,
    PointKind,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.sections import sections_below
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.geometry.splines.distance import closest_points_each
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import last_not_above, power_coefficients, segment_start
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState

__all__ = [
    "ON_CENTRE",
    "ON_PLANE",
    "CurveNet",
    "CurvePart",
    "NetSections",
    "NetStations",
    "areas_of_flat_ends",
    "bits_of_parts",
    "every_other_line",
    "every_other_section",
    "flat_ends_below",
    "gather_net",
    "sections_of",
    "station_planes",
    "stations_of",
    "sum_pieces",
    "sum_transoms",
    "thinned_net",
    "transom_areas_below",
    "transom_ends",
]

ON_PLANE = 1e-6
"""A boundary curve this near to a section's plane (m, of a short hull less) lies in it."""


def station_planes(net: CurveNet) -> FloatArray:
    """Give where sections stand between which the surface is laid, ascending, m."""
    every = np.sort(net.x[np.isfinite(net.x) & ~net.end & ~net.ends_on_transom])
    found: FloatArray = every[np.diff(every, prepend=-np.inf) > net.on_plane]
    return found


# --------------------------------------------------------------------------------------
# Curves and crossings from the tables.

ON_CENTRE = 1e-4
"""A curve that ends this near to the centre plane (m, of a short hull less) ends on it."""

_STEEP = 0.25
"""The edge of a transom rises at least by this part of what it spans along or across."""

_ON_EDGE = 1e-2
"""A section that ends this near to the edge of a transom (m, of a short hull less) ends on it."""

CurvePart = tuple[int, float, float]
"""A curve of the net and the chord parameters (m) between which it is walked, in that sense."""

SNAP = 1e-9
"""A parameter this near to a knot (m, of a short hull less) is the knot."""


@attrs.frozen(eq=False)
class CurveNet:
    """The curves of a hull, and where they cross.

    Attributes
    ----------
    batch : SplineBatch
        All live curves, in the order of their keys.
    curve : (m,) int
        Their numbers in the tables.
    name : tuple of str
        The names of their lines.
    family : tuple of str
        The families of their lines.
    end : (m,) bool
        Boundary curves at which the hull ends.
    flat, knuckle : (m,) bool
        Borders of flats, to which the hull is tangent; and knuckles.
    x : (m,), m
        Where a curve that lies in a plane across the ship stands; nan for the others.
    centre : (m,) bool
        The line lies in the centre plane.
    normal : (m, 3)
        Of the plane of the line; nan where it lies in none.
    meets : (k, 2) int
        The two curves of each crossing.
    place : (k, 2), m
        Where on each of the two it lies.
    watched : (k,) bool
        It defines neither: the curves may pass one another, along a flat by much.
    row : (k,) int
        The point that it is.
    factor : float
        Of lengths, by the size of the hull: those fixed here are of hulls of 100 m and more.
    """

    batch: SplineBatch
    curve: IntArray
    name: tuple[str, ...]
    family: tuple[str, ...]
    end: NDArray[np.bool_]
    flat: NDArray[np.bool_]
    knuckle: NDArray[np.bool_]
    x: FloatArray
    centre: NDArray[np.bool_]
    normal: FloatArray
    meets: IntArray
    place: FloatArray
    watched: NDArray[np.bool_]
    row: IntArray
    factor: float = 1.0

    @property
    def on_plane(self) -> float:
        """How near to a section's plane (m) a boundary curve lies in it."""
        return self.factor * ON_PLANE

    @property
    def on_centre(self) -> float:
        """How near to the centre plane (m) a curve ends on it."""
        return self.factor * ON_CENTRE

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.end, self.flat, self.knuckle, self.x, self.centre)
        freeze(self.normal)
        freeze(self.meets, self.place, self.watched, self.row)

    @cached_property
    def knots(self) -> tuple[list[float], ...]:
        """The chord parameters of the knots of each curve, m."""
        knot, start = self.batch.knot.tolist(), self.batch.start.tolist()
        return tuple(knot[a:b] for a, b in itertools.pairwise(start))

    @cached_property
    def transom(self) -> NDArray[np.bool_]:
        """Edges of raked or rounded transoms, (m,): no deck edge leaves the centre so steeply.

        Those of upright transoms stand in planes across the ship; `x` tells these.
        """
        found = np.zeros(self.batch.count, bool)
        for curve in np.flatnonzero(self.end & ~self.centre & ~np.isfinite(self.x)).tolist():
            xyz = real(self.batch.xyz[self.batch.start[curve] : self.batch.start[curve + 1]])
            foot, head = (xyz[0], xyz[-1]) if xyz[0, 2] <= xyz[-1, 2] else (xyz[-1], xyz[0])
            along, across, up = np.ptp(xyz, axis=0).tolist()
            outward = bool(abs(foot[1]) <= self.on_centre < abs(head[1]))
            found[curve] = outward and up > _STEEP * max(along, across) and along < across + up
        return found

    @cached_property
    def ends_on_transom(self) -> NDArray[np.bool_]:
        """Sections that begin or end on the edge of a raked transom, (m,).

        They are parts of a section; the surface runs past them, to the transom itself.
        """
        found = np.zeros(self.batch.count, bool)
        edges = np.flatnonzero(self.transom)
        own = np.flatnonzero(np.isfinite(self.x) & ~self.end)
        for edge in edges.tolist():
            for at in (self.batch.start[own], self.batch.start[own + 1] - 1):
                place = self.batch.xyz[at]
                away = closest_points_each(self.batch, np.full(len(own), edge), place)[2]
                found[own] |= (away <= self.factor * _ON_EDGE) & (
                    np.abs(place[:, 1]) > self.on_centre
                )
        # Something has to bound the surface.
        enough = len(np.unique(self.x[own][~found[own]])) >= 2
        return found if enough else np.zeros(self.batch.count, bool)

    def length(self, curve: int) -> float:
        """Give the chord length of a curve, m."""
        return self.knots[curve][-1]


def gather_net(state: HullState) -> CurveNet:
    """Take all live curves and their crossings from the tables."""
    keys = state.curves.key.data
    curves = np.array(sorted(state.live("curves").tolist(), key=lambda c: str(keys[c])), np.int64)
    lines = state.curves.line[curves]
    table = state.lines
    normal, boundary = table.normal[lines], table.boundary[lines]
    family = tuple(state.family(line).name for line in lines.tolist())
    flat = table.planar[lines]
    end = boundary == BoundaryKind.END
    across = flat & (np.abs(normal[:, 0]) == 1.0) & (end | (np.array(family) == "sections"))
    offset = table.offset[lines]
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    row, meets, place = _crossings(state, curves, batch)
    return CurveNet(
        batch,
        curves,
        tuple(str(table.name[line]) for line in lines.tolist()),
        family,
        end,
        boundary == BoundaryKind.FLAT,
        boundary == BoundaryKind.KNUCKLE,
        np.where(across, offset * normal[:, 0], np.nan),
        flat & (np.abs(normal[:, 1]) == 1.0) & (offset == 0.0),
        np.where(flat[:, None], normal, np.nan),
        meets,
        place,
        state.rows.role[row] == Role.WATCHED,
        row,
        state.tolerances.factor,
    )


def _crossings(
    state: HullState, curves: IntArray, batch: SplineBatch
) -> tuple[IntArray, IntArray, FloatArray]:
    """Give the point of each crossing, its two curves, and where on them it lies (k, 2), m.

    Watched crossings count: a surface within their gap is as good as the net itself.
    """
    number = np.full(state.curves.count + 1, -1, np.int64)
    number[curves] = np.arange(len(curves))
    table = state.rows
    place = table.parameter[: table.count].copy()
    # Where a line ends on another it has no intersection, but a defining point: a knot.
    row = np.concatenate([state.curves.rows[curve] for curve in curves.tolist()])
    side = np.concatenate([state.curves.side[curve] for curve in curves.tolist()])
    place[row, side] = batch.knot
    rows = state.live("rows")
    rows = rows[table.sort[rows] == Sort.CROSSING]
    both = number[table.curve[rows]]
    place = place[rows]
    good = (both >= 0).all(axis=1) & np.isfinite(place).all(axis=1)
    return rows[good], both[good], place[good]


def bits_of_parts(
    net: CurveNet, curve: IntArray, begin: FloatArray, finish: FloatArray
) -> tuple[IntArray, IntArray, FloatArray, FloatArray]:
    """Give the bits of segments that parts of curves consist of; backward where they run so.

    Parts are those of curves (k,) from `begin` to `finish` (k,), m. Given are the number of bits of
    each, and segment, low and high of all.
    """
    knot, start = net.batch.knot, net.batch.start
    first, last = start[curve], start[curve + 1] - 1
    low = _snapped(net, first, last, np.minimum(begin, finish))
    high = _snapped(net, first, last, np.maximum(begin, finish))
    lower = np.minimum(last_not_above(knot, first, last, low), last - 1)
    upper = np.clip(_not_below(knot, first, last, high) - 1, lower, last - 1)
    count = upper - lower + 1
    part = np.arange(len(curve)).repeat(count)
    step = np.arange(len(part)) - (np.cumsum(count) - count)[part]
    back = (begin > finish)[part]
    at = np.where(back, upper[part] - step, lower[part] + step)
    length = knot[at + 1] - knot[at]
    a = np.maximum((low[part] - knot[at]) / length, 0.0)
    b = np.where(at < upper[part], 1.0, np.minimum((high[part] - knot[at]) / length, 1.0))
    return count, at - curve[part], np.where(back, b, a), np.where(back, a, b)


def _not_below(knot: FloatArray, first: IntArray, last: IntArray, t: FloatArray) -> IntArray:
    """Find the first knot of curves that is not below t (k,), m; one more than the last if none."""
    found = last_not_above(knot, first, last, t)
    return np.where(knot[found] >= t, found, found + 1)


def _snapped(net: CurveNet, first: IntArray, last: IntArray, t: FloatArray) -> FloatArray:
    """Give parameters (k,), m, that are almost at a knot as that knot."""
    knot, near = net.batch.knot, net.factor * SNAP
    after = _not_below(knot, first, last, t)
    one, other = knot[np.maximum(after - 1, first)], knot[np.minimum(after, last)]
    close = np.where(np.abs(other - t) <= near, other, t)
    return np.where(np.abs(one - t) <= near, one, close)


# --------------------------------------------------------------------------------------
# Sections as drawn.


@attrs.frozen(eq=False)
class NetSections:
    """Sections, piece by piece.

    Attributes
    ----------
    curves : IsoCurves
        k pieces, from keel to deck, with the closed deck where there is one.
    curve : (k,) int
        Their curves in the net.
    station : (k,) int
        The station of each piece.
    x : (n,), m
        Where the stations are, rising.
    names : tuple of n str
        Their names.
    """

    curves: IsoCurves
    curve: IntArray
    station: IntArray
    x: FloatArray
    names: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.station, self.x)

    def per_station(self, values: FloatArray) -> FloatArray:
        """Sum values of the pieces of each station: (d, k) to (d, n)."""
        return sum_pieces(values, self.station, len(self.x))


def sum_pieces(values: FloatArray, station: IntArray, count: int) -> FloatArray:
    """Sum values of the pieces of each station: (d, k) to (d, n)."""
    member = (station[:, None] == np.arange(count)).astype(np.float64)
    found: FloatArray = values @ member
    return found


def sections_of(net: CurveNet, closed: bool) -> NetSections:
    """Take the sections of a net; `closed` joins deck edges to the centre plane."""
    stations = stations_of(net)
    curves = _curves(_chosen(net.batch, stations.curve), closed, net.on_centre)
    return NetSections(curves, stations.curve, stations.station, stations.x, stations.names)


@attrs.frozen(eq=False)
class NetStations:
    """The sections of a net without their shapes; all as in `NetSections`."""

    curve: IntArray
    station: IntArray
    x: FloatArray
    names: tuple[str, ...]


def stations_of(net: CurveNet) -> NetStations:
    """Tell which curves are sections, and at which station each stands."""
    chosen = np.flatnonzero(np.isfinite(net.x) & ~net.end)
    chosen = chosen[np.argsort(net.x[chosen], kind="stable")]
    x, station = np.unique(net.x[chosen], return_inverse=True)
    first = np.searchsorted(station, np.arange(len(x))).tolist()
    return NetStations(chosen, station, x, tuple(net.name[int(chosen[i])] for i in first))


def _chosen(batch: SplineBatch, curves: IntArray) -> SplineBatch:
    """Give some of the curves, in any arithmetic."""
    if is_plain(batch.xyz):
        return batch.take(curves)
    return SplineBatch.join([batch.part(curve, curve + 1) for curve in curves.tolist()])


_OUTERMOST = 1e-3
"""An end across the ship beyond which lines reach no farther than this (m) is the ship's own."""


def transom_ends(net: CurveNet) -> IntArray:
    """Give the curves of transoms: ends across the ship but those of bossings, skegs and nozzles.

    Such an end goes from the centre plane to it, or round, and the hull goes on beyond it.
    """
    xyz = real(net.batch.xyz)  # with tangents or without, the same ends are taken
    aft, fore = float(xyz[:, 0].min()), float(xyz[:, 0].max())
    found = []
    for curve in np.flatnonzero(np.isfinite(net.x) & net.end).tolist():
        x = float(net.x[curve])
        ends = xyz[[net.batch.start[curve], net.batch.start[curve + 1] - 1]]
        round_it = bool(np.abs(ends[1] - ends[0]).max() <= net.on_centre)
        central = bool(np.abs(ends[:, 1]).max() <= net.on_centre)
        if min(x - aft, fore - x) <= net.factor * _OUTERMOST or not (round_it or central):
            found.append(curve)
    return np.array(found, np.int64)


def transom_areas_below(net: CurveNet, closed: bool, planes: FloatingPlanes) -> FloatArray:
    """Give the area of transoms, at either end of the ship, (d,), m2, both sides.

    A raked one is measured in its own plane; of a rounded one, its projection across the ship.
    """
    return sum_transoms(
        net, transom_ends(net), lambda some: _areas_below(net, some, closed, planes)
    )


def sum_transoms(
    net: CurveNet, ends: IntArray, areas: Callable[[IntArray], FloatArray]
) -> FloatArray:
    """Add up the areas that transoms have: those in planes across the ship, and the raked ones."""
    total = areas(ends)
    for curve in np.flatnonzero(net.transom).tolist():
        upright = abs(float(net.normal[curve, 0]))
        raked = areas(np.array([curve]))
        total = total + (raked / upright if upright > 0.0 else raked)
    return total


def flat_ends_below(
    net: CurveNet, closed: bool, planes: FloatingPlanes, x: float | None = None
) -> FloatArray:
    """Give the area of all ends across the ship, those of bossings too, (d,), m2, both sides.

    Of those at `x` (m) only, where it is given.
    """
    chosen = np.isfinite(net.x) & net.end
    if x is not None:
        chosen &= np.abs(net.x - x) <= net.factor * _OUTERMOST
    return _areas_below(net, np.flatnonzero(chosen), closed, planes)


def _areas_below(
    net: CurveNet, chosen: IntArray, closed: bool, planes: FloatingPlanes
) -> FloatArray:
    if not len(chosen):
        return np.zeros(len(planes.height))
    return areas_of_flat_ends(_chosen(net.batch, chosen), closed, planes, net.on_centre)


def areas_of_flat_ends(
    edges: SplineBatch, closed: bool, planes: FloatingPlanes, on_centre: float = ON_CENTRE
) -> FloatArray:
    """Give the area inside the edges of transverse ends, (d,), m2, both sides."""
    curves = _curves(edges, closed, on_centre)
    area: FloatArray = sections_below(curves, planes).sum(axis=1)
    return area


def _curves(batch: SplineBatch, closed: bool, on_centre: float) -> IsoCurves:
    """Give curves as tiles from keel to deck, with a deck where they end off the centre plane."""
    if is_plain(batch.xyz):
        return _plain_curves(batch, closed, on_centre)
    tiles: list[FloatArray] = []
    start, deck = [0], []
    for curve in range(batch.count):
        cubic = _upward(power_coefficients(batch.part(curve, curve + 1)))
        last = cubic[-1].sum(axis=0)
        covered = bool(closed and abs(last[1]) > on_centre)
        if covered:
            across = last * np.array([0.0, -1.0, 0.0])
            lid = np.stack([last, across, 0.0 * last, 0.0 * last])
            cubic = np.concatenate([cubic, lid[None]])
        tiles.append(cubic)
        deck += [False] * (len(cubic) - covered) + [True] * covered
        start.append(len(deck))
    point = np.concatenate(tiles)
    return IsoCurves(np.array(start), point, np.zeros_like(point), np.array(deck, np.bool_))


def _plain_curves(batch: SplineBatch, closed: bool, on_centre: float) -> IsoCurves:
    """Do what `_curves` does, of plain numbers, for all curves at once."""
    size = np.diff(batch.start) - 1
    start = np.concatenate([[0], np.cumsum(size)])
    own = np.arange(len(size)).repeat(size)
    cubic = power_coefficients(batch)
    low, high = cubic[:, 0], batch.xyz[segment_start(batch) + 1]
    swept = np.bincount(own, 0.5 * (low[:, 1] + high[:, 1]) * (high[:, 2] - low[:, 2]), len(size))
    # A curve that encloses its area on the other side is reversed: c(u) becomes c(1 - u).
    back = np.flatnonzero((swept < 0.0)[own])
    order = np.arange(len(own))
    order[back] = (start[own] + start[own + 1] - 1 - order)[back]
    cubic = cubic[order]
    c0, c1, c2, c3 = (cubic[back, i] for i in range(4))
    cubic[back, 0], cubic[back, 1] = c0 + c1 + c2 + c3, -(c1 + 2.0 * c2 + 3.0 * c3)
    cubic[back, 2], cubic[back, 3] = c2 + 3.0 * c3, -c3
    last = cubic[start[1:] - 1].sum(axis=1)
    covered = np.flatnonzero((np.abs(last[:, 1]) > on_centre) & closed)
    point, deck = cubic, np.zeros(len(cubic), np.bool_)
    if len(covered):
        lid = np.zeros((len(covered), 4, 3))
        lid[:, 0], lid[:, 1, 1] = last[covered], -last[covered, 1]
        point = np.insert(cubic, start[covered + 1], lid, axis=0)
        deck = np.insert(deck, start[covered + 1], True)
        more = np.zeros(len(start), np.int64)
        more[covered + 1] = 1
        start = start + np.cumsum(more)
    return IsoCurves(start, point, np.zeros_like(point), deck)


def _upward(cubic: FloatArray) -> FloatArray:
    """Turn a curve so that it runs from keel to deck: it encloses area to port.

    The integral of y dz is positive then. Reversed, c(u) becomes c(1 - u), expanded below.
    """
    first, last = cubic[:, 0], cubic.sum(axis=1)
    swept = (0.5 * (first[:, 1] + last[:, 1]) * (last[:, 2] - first[:, 2])).sum()
    if real(swept) >= 0.0:
        return cubic
    c0, c1, c2, c3 = (cubic[::-1, i] for i in range(4))
    return np.stack([c0 + c1 + c2 + c3, -(c1 + 2.0 * c2 + 3.0 * c3), c2 + 3.0 * c3, -c3], axis=1)


# --------------------------------------------------------------------------------------
# The net with fewer lines. A line that is left out takes with it the points at which it crossed the
# others, unless these are ends, knuckles or tangent points; the lines that stay are lofted again
# without them.


def every_other_section(net: CurveNet, first: int) -> NDArray[np.bool_]:
    """Choose every other section, (m,), from the second or the first on (`first` 0 or 1).

    Those that stand beside one of another number of pieces stay: there something begins or ends.
    The outermost are left out too when it is their turn, or how much lies between the ends of
    the ship and the next section would not show.
    """
    section = np.isfinite(net.x) & ~net.end
    place, number, pieces = np.unique(net.x[section], return_inverse=True, return_counts=True)
    alike = np.ones(len(place), bool)
    alike[1:] &= pieces[1:] == pieces[:-1]
    alike[:-1] &= pieces[1:] == pieces[:-1]
    alike[(np.arange(len(place)) + first) % 2 == 0] = False
    chosen = np.zeros(net.batch.count, bool)
    chosen[np.flatnonzero(section)] = alike[number]
    return chosen


def every_other_line(net: CurveNet) -> NDArray[np.bool_]:
    """Choose every other line of each family that runs along the ship, (m,)."""
    chosen = np.zeros(net.batch.count, bool)
    for family in ("waterlines", "buttocks", "diagonals"):
        own = [i for i, each in enumerate(net.family) if each == family]
        names = sorted({net.name[i] for i in own}, key=lambda name: _height(net, own, name))
        for i in own:
            chosen[i] = names.index(net.name[i]) % 2 == 0
    return chosen


def _height(net: CurveNet, own: list[int], name: str) -> tuple[float, str]:
    """Give a key that orders the lines of a family: upward, or inward.

    Diagonals go by how far up the sections they lie on average: heights and breadths of two
    neighbours may change their order from bottom to side.
    """
    mine = np.array([i for i in own if net.name[i] == name])
    family = net.family[mine[0]]
    rows = np.concatenate([np.arange(net.batch.start[i], net.batch.start[i + 1]) for i in mine])
    if family == "waterlines":
        return float(net.batch.xyz[rows, 2].mean()), name
    if family == "buttocks":
        return -float(net.batch.xyz[rows, 1].mean()), name
    part = [
        net.place[k, 1 - side] / net.length(int(net.meets[k, 1 - side]))
        for side in (0, 1)
        for k in np.flatnonzero(np.isin(net.meets[:, side], mine)).tolist()
        if np.isfinite(net.x[net.meets[k, 1 - side]])
    ]
    return float(np.mean(part)) if part else np.inf, name


def thinned_net(
    state: HullState, net: CurveNet, without: NDArray[np.bool_], data: CurveData | None = None
) -> CurveNet:
    """Give the net without the curves chosen by `without` (m,); `state` is its source.

    `data` is what its curves are made of, if the tables have other numbers.
    """
    data = curve_data(state, net.curve) if data is None else data
    keep = _points(state, net, data, without)
    size = np.add.reduceat(keep, data.start[:-1])
    # A curve of fewer than two points is none: it keeps them all.
    short = np.repeat(size < 2, np.diff(data.start))
    keep |= short & ~np.repeat(without, np.diff(data.start))
    stay = np.flatnonzero(~without)
    batch = loft(data.through(keep))
    number = np.full(net.batch.count, -1)
    number[stay] = np.arange(len(stay))
    good = ~without[net.meets].any(axis=1)
    meets = number[net.meets[good]]
    place = _places(net, keep, batch, net.meets[good], meets, net.place[good])
    return attrs.evolve(
        net,
        batch=batch,
        curve=net.curve[stay],
        name=tuple(net.name[i] for i in stay.tolist()),
        family=tuple(net.family[i] for i in stay.tolist()),
        end=net.end[stay],
        flat=net.flat[stay],
        knuckle=net.knuckle[stay],
        x=net.x[stay],
        centre=net.centre[stay],
        normal=net.normal[stay],
        meets=meets,
        place=place,
        watched=net.watched[good],
        row=net.row[good],
    )


def _points(
    state: HullState, net: CurveNet, data: CurveData, without: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Tell which defining points stay."""
    row = np.concatenate([state.curves.rows[curve] for curve in net.curve.tolist()])
    own = np.repeat(np.arange(net.batch.count), np.diff(data.start))
    gone = np.zeros(state.curves.count + 1, bool)
    gone[net.curve[without]] = True
    gone[-1] = False
    crossed = gone[state.rows.curve[row]].any(axis=1)
    fixed = data.kind != PointKind.SMOOTH
    fixed[data.start[:-1]] = fixed[data.start[1:] - 1] = True
    keep: NDArray[np.bool_] = (fixed | ~crossed) & ~without[own]
    return keep


def _places(
    net: CurveNet,
    keep: NDArray[np.bool_],
    batch: SplineBatch,
    old: IntArray,
    new: IntArray,
    place: FloatArray,
) -> FloatArray:
    """Carry parameters on curves over: in proportion between the points that stayed."""
    found = np.empty_like(place)
    start = net.batch.start
    for side in (0, 1):
        for curve in np.unique(old[:, side]).tolist():
            mine = np.flatnonzero(old[:, side] == curve)
            target = int(new[mine[0], side])
            kept = np.flatnonzero(keep[start[curve] : start[curve + 1]]) + start[curve]
            knot = batch.knot[batch.start[target] : batch.start[target + 1]]
            found[mine, side] = np.interp(place[mine, side], net.batch.knot[kept], knot)
    return found
